//! Cases that physics engines are known to get wrong: the story of each, and our answer against exact arithmetic.

mod floors;

use super::hull;
use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{Measured3, Pair3, Separation3};
use asunder_tests::cases::prism;
use asunder_tests::exact_overlap::{Relation, exact_overlap3, exact_relation3};
use asunder_tests::precise::{along3, separation3};
use glam::{DVec3, Quat, Vec2, Vec3};

fn cuboid(x: f32, y: f32, z: f32) -> Shape3 {
    Cuboid::from_half_extents(Vec3::new(x, y, z)).unwrap().into()
}

fn turned(place: DVec3, x: f32, y: f32, z: f32, w: f32) -> Pose3 {
    Pose3::new(place, Quat::from_xyzw(x, y, z, w)).unwrap()
}

type Posed<'a> = (&'a Shape3, &'a Pose3);

/// Checks everything that is reported for a pair against exact arithmetic and double-double.
fn judged(a: Posed, b: Posed) -> Measured3 {
    let pair = Pair3::new(a.0, a.1, b.0, b.1);
    let exact = exact_overlap3(a, b);
    assert_eq!(pair.overlaps(), exact, "{a:?} {b:?}");
    let Separation3::Measured(found) = pair.separation(f32::INFINITY) else { panic!("there is no limit") };
    let truth = separation3(a, b);
    let miss = (f64::from(found.separation) - truth.separation).abs();
    assert!(miss <= f64::from(found.error) + truth.bound, "{found:?}, true {truth:?}: {a:?} {b:?}");
    assert_eq!(found.separation <= 0.0, exact, "{found:?}: {a:?} {b:?}");
    assert_eq!(pair.distance().is_none(), exact, "{a:?} {b:?}");
    assert_eq!(pair.manifold(0.0).is_some(), exact, "{a:?} {b:?}");
    let bounded = [a.0, b.0].map(|shape| f64::from(shape.outer_radius()));
    let size = bounded.iter().filter(|radius| radius.is_finite()).sum::<f64>();
    assert!(f64::from(found.error) <= 1e-6 * size, "{found:?}: {a:?} {b:?}");
    assert!(along3(a, b, found.normal) >= truth.separation - 1e-6 * size, "{found:?}: {a:?} {b:?}");
    found
}

/// Symptom: two crates spawned in one place flew off along a diagonal, by NaN, or not at all. Cause: an iteration that
/// starts from the difference of their centres starts with a zero vector, and on the way out of a simplex around the
/// origin every choice is a tie. parry3d 0.31, for two hulls with the corners of one cube: depth 0 m at half a metre,
/// no contact at a millimetre, and 0.44 mm instead of 2 mm when both are turned.
#[test]
fn identical_cubes_in_one_pose_are_as_deep_as_they_are_wide() {
    for half in [1e-5_f32, 0.001, 0.5, 3e4] {
        let cube = cuboid(half, half, half);
        for q in [[0.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0, 4.0], [0.6, 0.0, 0.0, 0.8], [0.1, -0.7, 0.3, 0.2]] {
            for place in [DVec3::ZERO, DVec3::new(1e8 / 3.0, -7.1, 1e-9)] {
                let pose = turned(place, q[0], q[1], q[2], q[3]);
                let found = judged((&cube, &pose), (&cube, &pose));
                assert!((found.separation + 2.0 * half).abs() <= found.error, "{half} m: {found:?}");
                let local = pose.turn_back(found.normal.as_dvec3()).abs();
                assert!((local.max_element() - 1.0).abs() < 1e-7, "no face looks along {local}");
            }
        }
    }
}

/// Symptom: pebbles of 2 mm hung in the air around each other. Cause: tolerances in metres (a skin of 1 mm, an epsilon
/// of 1e-4 m) that are negligible for a crate and huge for a pebble. parry3d 0.31, for hulls: those of 1 mm touch
/// across a gap of a thousandth of that, those of 0.01 mm across a tenth.
#[test]
fn small_cubes_with_a_small_gap_are_apart() {
    let half = 1e-3_f32;
    let cube = cuboid(half, half, half);
    for q in [[0.0, 0.0, 0.0, 1.0], [1.0, 2.0, 3.0, 4.0]] {
        let here = turned(DVec3::new(3.0, -2.0, 5.0), q[0], q[1], q[2], q[3]);
        let up = here.basis().y;
        for share in [0.1, 1e-3, 1e-6] {
            let gap = share * f64::from(half);
            let there = turned(here.position() + up * (2.0 * f64::from(half) + gap), q[0], q[1], q[2], q[3]);
            let found = judged((&cube, &here), (&cube, &there));
            // Positions of some metres are rounded to 1e-15 m.
            assert!((f64::from(found.separation) - gap).abs() <= f64::from(found.error) + 1e-15, "{found:?}");
            assert!(found.separation > 0.0 && found.error < 1e-6 * half, "{found:?}");
        }
    }
}

/// Symptom: crossed planks jumped apart, in the wrong direction. Cause: the cross product of almost parallel edges is
/// normalised rounding noise, and it seemed to be the best separating axis. parry3d 0.31, for hulls 1e-5 rad from
/// parallel and 1e-6 m deep: they intersect, with a contact 4e-7 m apart.
#[test]
fn edges_a_millionth_from_parallel_give_no_axis_of_noise() {
    let plank = cuboid(0.5, 0.5, 4.0);
    // Half of 45 degrees: ridge upon ridge, along z.
    let (sin, cos) = (0.382_683_43_f32, 0.923_879_5_f32);
    let ridge = turned(DVec3::ZERO, 0.0, 0.0, sin, cos);
    let mut overlapping = 0;
    for angle in [1e-8_f32, 1e-7, 1e-6, 1e-5] {
        for gap in [-1e-3, -1e-6, -1e-9, 1e-9, 1e-6, 1e-3] {
            // q = (a turn of `angle` about y) (half of 45 degrees about z), to first order.
            let half = 0.5 * angle;
            let place = DVec3::new(0.0, f64::sqrt(2.0) + gap, 0.3);
            let there = turned(place, half * sin, half * cos, sin, cos);
            let found = judged((&plank, &ridge), (&plank, &there));
            overlapping += usize::from(found.separation <= 0.0);
            // Apart or slightly sunk in, the axis is across the ridges, and never along them.
            assert!(found.normal.z.abs() < 1e-3, "{angle} rad, gap {gap}: {found:?}");
            let beside = turned(DVec3::new(1.0 + gap, 0.25, 0.3), half, 0.0, 0.0, 1.0);
            let found = judged((&plank, &Pose3::IDENTITY), (&plank, &beside));
            assert!(found.normal.x > 0.999, "{angle} rad, gap {gap}: {found:?}");
        }
    }
    assert!((8..=20).contains(&overlapping), "{overlapping} of 24");
}

/// Symptom: whether bricks laid side by side touched depended on where the wall stood. Cause: f32 positions, and an
/// overlap test with a tolerance. parry3d 0.31, with a gap of one f32 ulp: its normal is (1 -1 -2) / sqrt 6.
#[test]
fn kissing_boxes_touch_and_a_unit_in_the_last_place_parts_them() {
    let brick = cuboid(0.5, 0.25, 0.125);
    for origin in [0.0, -1.0, 40.0, 1e6, 9e8] {
        let here = Pose3::at([origin, 2.0, -3.0]).unwrap();
        let at = |x: f64| Pose3::at([x, 2.125, -3.0625]).unwrap();
        let kiss = at(origin + 1.0);
        assert_eq!(exact_relation3((&brick, &here), (&brick, &kiss)), Relation::Touching);
        let found = judged((&brick, &here), (&brick, &kiss));
        assert_eq!((found.separation, found.normal), (0.0, Vec3::X));
        assert_eq!(Pair3::new(&brick, &here, &brick, &kiss).manifold(0.0).unwrap().points.len(), 4);
        let (out, sunk) = (at((origin + 1.0).next_up()), at((origin + 1.0).next_down()));
        assert!(judged((&brick, &here), (&brick, &out)).separation > 0.0, "at {origin}");
        let found = judged((&brick, &here), (&brick, &sunk));
        assert!(found.separation <= 0.0 && found.normal == Vec3::X, "at {origin}: {found:?}");
    }
}

/// Symptom: a floorboard of 128 to 1 let crates through near its ends. Cause: tolerances relative to its length, which
/// are large compared with its thickness, and an EPA (expanding polytope) that ran out of iterations. parry3d 0.31, for
/// two boards that cross 1 mm apart: a distance of 26 m, and as hulls they intersect.
#[test]
fn boxes_of_128_to_1_are_as_good_as_cubes() {
    let board = cuboid(64.0, 0.5, 0.5);
    let mut overlapping = 0;
    for [x, y, z, w] in
        [[0.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 1.0], [0.0, 0.31, 0.0, 0.95], [0.2, 0.3, 0.01, 0.9]]
    {
        for along in [0.0, 17.3, 63.0, 64.25] {
            for gap in [-0.3, -1e-3, -1e-6, 1e-6, 1e-3] {
                let there = turned(DVec3::new(along, 1.0 + gap, 0.2), x, y, z, w);
                let found = judged((&board, &Pose3::IDENTITY), (&board, &there));
                overlapping += usize::from(found.separation <= 0.0);
            }
        }
    }
    assert!((30..70).contains(&overlapping), "{overlapping} of 80");
}

/// Symptom: a hull built from a subdivided mesh was reported apart from what it stood in. Cause: several collinear or
/// coplanar support points make a flat simplex, whose normal is rounding noise.
#[test]
fn support_points_on_a_line_make_no_flat_simplex() {
    let circle: Vec<Vec2> =
        [(5.0, 0.0), (4.0, 3.0), (3.0, 4.0), (0.0, 5.0), (-3.0, 4.0), (-4.0, 3.0), (-5.0, 0.0)]
            .into_iter()
            .chain([(-4.0, -3.0), (-3.0, -4.0), (0.0, -5.0), (3.0, -4.0), (4.0, -3.0)])
            .map(|(x, y)| Vec2::new(x, y) * 0.125)
            .collect();
    let drum = prism(&circle, 0.5);
    // A cube whose faces are grids of points: all but its corners lie on edges and faces.
    let grid: Vec<[f32; 3]> = (0..125)
        .map(|i| [i % 5, i / 5 % 5, i / 25].map(|c| 0.25 * c as f32 - 0.5))
        .filter(|p| p.iter().any(|c| c.abs() == 0.5))
        .collect();
    let block = hull(&grid);
    let mut touching = 0;
    for (a, b) in [(&drum, &drum), (&drum, &block), (&block, &drum), (&block, &block)] {
        for spin in [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 2.0], [0.0, 0.0, 1e-7, 1.0]] {
            for gap in [-0.5, -1e-3, -1e-9, -2e-16, 0.0, 3e-16, 1e-9, 1e-3] {
                let there = turned(DVec3::new(0.125, -0.25, 1.0 + gap), spin[0], spin[1], spin[2], spin[3]);
                let found = judged((a, &Pose3::IDENTITY), (b, &there));
                // The caps are at z = 1/2 whatever the spin about z, and B's position is exact: so is the gap.
                assert_eq!(found.separation <= 0.0, gap <= 0.0, "gap {gap}: {found:?}");
                touching += usize::from(gap == 0.0 && found.separation == 0.0);
            }
        }
    }
    assert_eq!(touching, 12);
}

/// Symptom: a tile balanced on the edge of a step slid through it. Cause: where a corner meets an edge, face normals,
/// edge pairs and corners all tie, and each case was left to another.
#[test]
fn a_corner_on_an_edge_touches_it() {
    let step = cuboid(3.0, 3.0, 3.0);
    // A cube of side 6 whose axes are (1 2 2) (2 1 -2) (2 -2 1): its corners are whole numbers.
    let axes = [Vec3::new(1.0, 2.0, 2.0), Vec3::new(2.0, 1.0, -2.0), Vec3::new(2.0, -2.0, 1.0)];
    let corners = (0..8).map(|i| {
        let signs = [1, 2, 4].map(|bit| if i & bit == 0 { -1.0 } else { 1.0 });
        (axes[0] * signs[0] + axes[1] * signs[1] + axes[2] * signs[2]).to_array()
    });
    let tile = hull(&corners.collect::<Vec<_>>());
    // The corner -(5 1 1) is the only support point of the tile along -(2 1 0), and the edge x = y = 3 that of the step
    // along (2 1 0).
    for origin in [DVec3::ZERO, DVec3::new(1e6, -2e5, 12.0)] {
        let here = Pose3::at(origin).unwrap();
        for height in [-2.5, 0.5, 3.0] {
            let at = |x: f64, y: f64| Pose3::at(DVec3::new(x, y, origin.z + height + 1.0)).unwrap();
            let (x, y) = (origin.x + 8.0, origin.y + 4.0);
            let touch = at(x, y);
            assert_eq!(exact_relation3((&step, &here), (&tile, &touch)), Relation::Touching);
            assert_eq!(judged((&step, &here), (&tile, &touch)).separation, 0.0);
            for out in [at(x.next_up(), y), at(x, y.next_up())] {
                assert!(judged((&step, &here), (&tile, &out)).separation > 0.0, "{out:?}");
            }
            for sunk in [at(x.next_down(), y), at(x, y.next_down()), at(x.next_down(), y.next_down())] {
                assert!(judged((&step, &here), (&tile, &sunk)).separation <= 0.0, "{sunk:?}");
            }
        }
    }
}
