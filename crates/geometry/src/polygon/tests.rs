//! Tests of which outlines are polygons, and which vertices a hull keeps.

use super::*;
use crate::tolerance::MAX_POLYGON_VERTICES;

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

/// A small seeded source of integers: a multiplicative congruential generator (Lehmer).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, count: i64) -> i64 {
        self.0 = self.0 * 48_271 % 2_147_483_647;
        self.0 as i64 % count
    }

    /// Points of a square lattice, and the same as integers.
    fn lattice(&mut self, count: usize, side: i64) -> (Vec<[i128; 2]>, Vec<Vec2>) {
        let whole: Vec<[i128; 2]> =
            (0..count).map(|_| [0; 2].map(|_: i128| self.below(side).into())).collect();
        let points = whole.iter().map(|p| Vec2::new(p[0] as f32, p[1] as f32)).collect();
        (whole, points)
    }
}

fn turn(a: [i128; 2], b: [i128; 2], c: [i128; 2]) -> i128 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A point is a corner of the hull exactly if it is in no triangle of the others and on no segment between them.
#[test]
fn hulls_on_lattices_have_exactly_the_extreme_points() {
    let mut numbers = Numbers(77);
    let mut hulls = 0;
    for round in 0..3000 {
        let (mut whole, points) = numbers.lattice(3 + round % 12, 2 + (round % 5) as i64);
        whole.sort_unstable();
        whole.dedup();
        let is_extreme = |&p: &[i128; 2]| {
            let others: Vec<[i128; 2]> = whole.iter().copied().filter(|&q| q != p).collect();
            let holds = |a: [i128; 2], b: [i128; 2], c: [i128; 2]| {
                let turns = [turn(a, b, p), turn(b, c, p), turn(c, a, p)];
                let within = (0..2).all(|axis| {
                    let of = [a, b, c].map(|q| q[axis]);
                    of.iter().min() <= Some(&p[axis]) && Some(&p[axis]) <= of.iter().max()
                });
                within && (turns.iter().all(|&t| t >= 0) || turns.iter().all(|&t| t <= 0))
            };
            !others.iter().any(|&a| others.iter().any(|&b| others.iter().any(|&c| holds(a, b, c))))
        };
        let mut extreme: Vec<[i128; 2]> = whole.iter().copied().filter(is_extreme).collect();
        let spans = whole.len() > 2 && whole[2..].iter().any(|&p| turn(whole[0], whole[1], p) != 0);
        match Polygon::hull_of(&points) {
            Ok(hull) => {
                let mut found: Vec<[i128; 2]> =
                    hull.vertices().iter().map(|v| [v.x as i128, v.y as i128]).collect();
                assert!((0..found.len()).all(|i| {
                    let n = found.len();
                    turn(found[i], found[(i + 1) % n], found[(i + 2) % n]) > 0
                }));
                found.sort_unstable();
                extreme.sort_unstable();
                assert_eq!(found, extreme, "{points:?}");
                hulls += 1;
            }
            Err(error) => assert!(error == PolygonError::Collinear && !spans, "{error}: {points:?}"),
        }
    }
    assert!(hulls > 2000, "{hulls}");
}

#[test]
fn simplifying_keeps_the_far_corners() {
    // A square with a blunt corner on each side: these four should be dropped.
    let square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    let blunt = [(2.0, -0.125), (4.25, 2.0), (2.0, 4.5), (-0.0625, 2.0)];
    let all = points(&[square, blunt].concat());
    let kept = |limit: usize| Polygon::simplify(&all, limit).unwrap();
    assert_eq!((kept(8).vertices().len(), kept(8).error()), (8, 0.0));
    let seven = kept(7);
    assert!(!seven.vertices().contains(&all[7]) && seven.vertices().len() == 7);
    assert!((0.0625..0.0626).contains(&seven.error()), "{}", seven.error());
    let six = kept(6);
    assert!(!six.vertices().contains(&all[4]) && (0.125..0.1251).contains(&six.error()), "{six:?}");
    assert_eq!(kept(4).rounded(0.5).unwrap().error(), kept(4).error());
    for max_vertices in [2, MAX_POLYGON_VERTICES + 1] {
        let refused = Polygon::simplify(&all, max_vertices).unwrap_err();
        assert_eq!(refused, PolygonError::LimitOutOfRange { max_vertices });
    }
}

/// The error bounds every chord's cap, whatever is left out: checked against each vertex and each side in turn.
#[test]
fn the_error_of_a_simplified_lattice_hull_bounds_every_point() {
    let mut numbers = Numbers(78);
    for round in 0..2000 {
        let (_, points) = numbers.lattice(40, 40);
        let Ok(simple) = Polygon::simplify(&points, 3 + round % 6) else { continue };
        let outside = |p: DVec2| {
            let sides = corners(simple.vertices()).map(|[_, a, b]| (a.as_dvec2(), b.as_dvec2()));
            let distance = |(a, b): (DVec2, DVec2)| {
                let place = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                (p - a - (b - a) * place).length()
            };
            if simple.contains(p) { 0.0 } else { sides.map(distance).fold(f64::INFINITY, f64::min) }
        };
        let furthest = points.iter().map(|p| outside(p.as_dvec2())).fold(0.0, f64::max);
        let error = f64::from(simple.error());
        // f32 rounds up by at most 1.2e-7; the sums before it by far less.
        assert!(error >= furthest * (1.0 - 1e-15) && error <= furthest * (1.0 + 2e-7) + 1e-11, "{points:?}");
    }
}

#[test]
fn a_sliver_that_f64_cannot_tell_from_a_line_has_a_centre_in_its_box() {
    let (one, ulp) = (1.0_f32, f32::EPSILON);
    for list in [
        [(-one, -one), (one / 3.0, (one / 3.0).next_up()), (one, one)],
        [(0.0, 0.0), (1e-45, 0.0), (1e6, 1e-45)],
        [(9e5, 3e5), (-9e5 + ulp, -3e5), (0.0, 1e-30)],
    ] {
        let sliver = Polygon::hull_of(&points(&list)).unwrap();
        assert!(sliver.center().is_finite() && sliver.inner_radius() >= 0.0, "{sliver:?}");
        assert!(sliver.normals().iter().all(|normal| (normal.length() - 1.0).abs() < 1e-12), "{sliver:?}");
        let reach = f64::from(sliver.outer_radius());
        assert!(sliver.vertices().iter().all(|v| v.as_dvec2().distance(sliver.center().into()) <= reach));
    }
}

#[test]
fn regular_polygons_have_their_corners_and_refuse_what_has_none() {
    for sides in (3..1500).chain([2048, 4096]) {
        let regular = Polygon::regular(2.5, sides).unwrap();
        let count = regular.vertices().len();
        assert!(count <= sides && (count == sides || sides > 1000), "{sides} sides: {count}");
        assert!(regular.vertices().iter().all(|v| (v.as_dvec2().length() - 2.5).abs() < 3e-7));
        let within = 2.5 * libm::cos(core::f64::consts::PI / sides as f64);
        assert!((f64::from(regular.inner_radius()) - within).abs() < 2e-6, "{sides} sides");
    }
    for sides in [0, 2, 4097, usize::MAX] {
        assert_eq!(Polygon::regular(1.0, sides).unwrap_err(), PolygonError::Sides { sides });
    }
    for value in [0.0, -1.0, f32::INFINITY] {
        assert_eq!(Polygon::regular(value, 5).unwrap_err(), PolygonError::NotPositive { value });
    }
    assert!(matches!(Polygon::regular(f32::NAN, 5), Err(PolygonError::NotPositive { .. })));
}

#[test]
fn regular_polygons_are_as_large_as_circles() {
    let most = crate::tolerance::MAX_RADIUS;
    for sides in (3..200).chain([1000, 4095, 4096]) {
        let regular = Polygon::regular(most, sides).unwrap();
        assert!(regular.vertices().len() * 10 >= sides * 9, "{sides} sides");
        let off = regular.vertices().iter().map(|v| f64::from(most) - v.as_dvec2().length());
        assert!(off.fold(0.0, |most: f64, off| most.max(off.abs())) < 0.1, "{sides} sides");
        assert!(Polygon::regular(most.next_up(), sides).is_err());
    }
}
