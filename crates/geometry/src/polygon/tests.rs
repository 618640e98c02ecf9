//! Which outlines are polygons, and which vertices a hull keeps.

use super::*;

fn points(list: &[(f32, f32)]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

#[test]
fn refuses_each_kind_of_bad_outline() {
    let refused = |list: &[(f32, f32)]| Polygon::new(&points(list)).unwrap_err();
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0)]), PolygonError::TooFewPoints { count: 2 });
    assert_eq!(refused(&[(0.0, 0.0), (1.0, f32::NAN), (0.0, 1.0)]), PolygonError::NotFinite { index: 1 });
    assert_eq!(refused(&[(0.0, 0.0), (2e6, 0.0), (0.0, 1.0)]), PolygonError::TooLarge { index: 1 });
    assert_eq!(
        refused(&[(0.0, 0.0), (1e-9, 0.0), (0.0, 1e-9)]),
        PolygonError::TooSmall { radius: 7.45356e-10 }
    );
    assert_eq!(
        refused(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (-0.0, 0.0)]),
        PolygonError::Repeated { first: 0, second: 3 }
    );
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0), (2.0, 2.0)]), PolygonError::Collinear);
    assert_eq!(refused(&[(0.0, 0.0), (0.0, 1.0), (1.0, 0.0)]), PolygonError::Clockwise);
    assert_eq!(
        refused(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)]),
        PolygonError::Concave { vertex: 1 },
        "a spike that doubles back on itself"
    );
    let star = [(0.0, 1.0), (-0.6, -0.8), (0.95, 0.3), (-0.95, 0.3), (0.6, -0.8)];
    assert_eq!(refused(&star), PolygonError::WindsRepeatedly);
}

#[test]
fn one_ulp_decides_between_convex_and_concave() {
    // The middle vertex lies on the chord, one ulp outside it, one ulp inside it.
    let outline = |y: f32| points(&[(0.0, 0.0), (1.0, y), (2.0, 2.0), (0.0, 2.0)]);
    assert_eq!(Polygon::new(&outline(1.0)).unwrap().vertices().len(), 3, "on the line: left out");
    assert_eq!(Polygon::new(&outline(1.0_f32.next_down())).unwrap().vertices().len(), 4);
    assert_eq!(Polygon::new(&outline(1.0_f32.next_up())), Err(PolygonError::Concave { vertex: 1 }));
}

#[test]
fn hull_keeps_bits_and_ignores_order() {
    let cloud = points(&[(0.1, 0.7), (0.3, 0.2), (0.3, 0.2), (0.9, 0.4), (0.5, 0.45), (0.6, 0.95)]);
    let hull = Polygon::hull_of(&cloud).unwrap();
    assert!(hull.vertices().iter().all(|v| cloud.contains(v)));
    assert_eq!(hull.vertices().len(), 4);
    let reversed: Vec<Vec2> = cloud.iter().rev().copied().collect();
    assert_eq!(Polygon::hull_of(&reversed).unwrap().vertices(), hull.vertices());
    assert_eq!(
        Polygon::hull_of(&points(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)])),
        Err(PolygonError::Collinear)
    );
}
