//! Tests of rejected outlines, and of the parts of others.

use super::*;
use crate::tolerance::MIN_RADIUS;

fn outline(list: &[(f32, f32)]) -> Vec<Vec2> {
    list.iter().copied().map(Vec2::from).collect()
}

fn polygons(parts: &Compound2) -> Vec<Vec<[i128; 2]>> {
    let whole = |v: &Vec2| [v.x as i128, v.y as i128];
    let vertices = |part: &crate::Part2| match part.shape() {
        Shape2::Polygon(polygon) => polygon.vertices().iter().map(whole).collect(),
        other => panic!("{other:?} is no polygon"),
    };
    parts.parts().iter().map(vertices).collect()
}

fn doubled_area(round: &[[i128; 2]]) -> i128 {
    let next = round.iter().cycle().skip(1);
    round.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum()
}

#[test]
fn an_outline_is_split_the_same_whichever_way_it_winds() {
    let cross = outline(&[
        (1.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (3.0, 1.0),
        (3.0, 2.0),
        (2.0, 2.0),
        (2.0, 3.0),
        (1.0, 3.0),
        (1.0, 2.0),
        (0.0, 2.0),
        (0.0, 1.0),
        (1.0, 1.0),
    ]);
    let mut clockwise = cross.clone();
    clockwise.reverse();
    for points in [&cross, &clockwise] {
        let parts = decompose(points).unwrap();
        assert_eq!(parts.parts().len(), 3, "a bar and two arms");
        assert_eq!(polygons(&parts).iter().map(|part| doubled_area(part)).sum::<i128>(), 10);
        assert!(parts.parts().iter().all(|part| part.pose() == &Pose2::IDENTITY));
    }
}

#[test]
fn a_convex_outline_is_one_part_without_its_flat_vertices() {
    let square = outline(&[(0.0, 2.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0)]);
    assert_eq!(polygons(&decompose(&square).unwrap()), [[[0, 2], [0, 0], [2, 0], [2, 2]]]);
}

/// Flat vertices are kept in the triangulation, where other parts may need them, and dropped from each part.
#[test]
fn flat_vertices_of_concave_outlines_are_no_corners() {
    let step = outline(&[
        (0.0, 0.0),
        (1.0, 0.0),
        (2.0, 0.0),
        (4.0, 0.0),
        (4.0, 1.0),
        (3.0, 1.0),
        (2.0, 1.0),
        (2.0, 2.0),
        (2.0, 3.0),
        (0.0, 3.0),
        (0.0, 1.0),
    ]);
    let parts = polygons(&decompose(&step).unwrap());
    assert_eq!(parts.len(), 2);
    assert_eq!(parts.iter().map(|part| doubled_area(part)).sum::<i128>(), 16);
    for part in &parts {
        for i in 0..part.len() {
            let [a, b, c] = [0, 1, 2].map(|k| part[(i + k) % part.len()]);
            assert!((b[0] - a[0]) * (c[1] - b[1]) > (b[1] - a[1]) * (c[0] - b[0]), "{part:?}");
        }
    }
}

/// Coordinates too small for spade without scaling, and as large as an outline may be.
#[test]
fn subnormal_and_large_coordinates_are_split_exactly() {
    let tiny = f32::from_bits(1);
    let dart = |dent: f32| outline(&[(0.0, tiny), (-5e5, -5e5), (0.0, dent), (5e5, -5e5)]);
    assert_eq!(decompose(&dart(-tiny)).unwrap().parts().len(), 2);
    assert_eq!(decompose(&dart(0.0)).unwrap().parts().len(), 2);
    assert_eq!(decompose(&dart(tiny)), Err(DecomposeError::Repeated { first: 0, second: 2 }));
    assert_eq!(decompose(&dart(2.0 * tiny)).unwrap().parts().len(), 2, "tip and dent have changed places");
}

#[test]
fn edges_that_meet_are_named_with_how_they_meet() {
    let refused = |list: &[(f32, f32)]| decompose(&outline(list)).unwrap_err();
    let star = [(0.0, 4.0), (-2.0, -3.0), (4.0, 1.0), (-4.0, 1.0), (2.0, -3.0)];
    assert!(matches!(refused(&star), DecomposeError::Crossing { first, second } if first + 2 <= second));
    let turned_in = [(0.0, 0.0), (6.0, 0.0), (6.0, 4.0), (3.0, 0.0), (0.0, 4.0)];
    assert_eq!(refused(&turned_in), DecomposeError::Touching { vertex: 3, edge: 0 });
    let doubles_back = [(0.0, 0.0), (6.0, -6.0), (6.0, 4.0), (6.0, -4.0)];
    assert!(matches!(refused(&doubles_back), DecomposeError::Overlapping { first: 1, second: 2 }));
    let upright = [(0.0, 0.0), (0.0, 4.0), (0.0, 2.0), (-2.0, 2.0)];
    assert_eq!(refused(&upright), DecomposeError::Overlapping { first: 0, second: 1 });
}

#[test]
fn a_part_below_the_least_radius_is_left_out_beside_a_larger_one() {
    let small = 0.25 * MIN_RADIUS;
    let bump =
        [(-1.0, 0.0), (0.0, 0.0), (0.0, -small), (small, -small), (small, 0.0), (1.0, 0.0), (0.0, 1.0)];
    assert_eq!(decompose(&outline(&bump)).unwrap().parts().len(), 1);
    let larger = bump.map(|(x, y)| (if x == small { 16.0 * small } else { x }, y));
    assert_eq!(decompose(&outline(&larger)).unwrap().parts().len(), 2, "wide enough to be a shape");
    let dust = bump.map(|(x, y)| (x * small, y));
    let Err(DecomposeError::TooSmall { radius }) = decompose(&outline(&dust.map(|(x, y)| (x, y * small))))
    else {
        panic!("the whole is smaller than a shape may be")
    };
    assert!(radius > 0.0 && radius < MIN_RADIUS);
}

/// The check of the triangulation rejects triangles that miss a piece, cover one twice or wind wrongly.
#[test]
fn triangles_that_are_not_the_outline_are_not_believed() {
    let square = outline(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
    let believed = |triangles: &[[usize; 3]]| triangulate::checked(&square, triangles).is_some();
    assert!(believed(&[[0, 1, 2], [0, 2, 3]]));
    assert!(!believed(&[[0, 1, 2]]), "half is missing");
    assert!(!believed(&[]));
    assert!(!believed(&[[0, 1, 2], [0, 2, 3], [0, 1, 3]]), "a side twice");
    assert!(!believed(&[[0, 2, 1], [0, 2, 3]]), "clockwise");
    assert!(!believed(&[[0, 1, 2], [1, 2, 3]]), "overlapping");
}
