//! Bugs with round, flat and unbounded shapes.

use super::{hull, separation};
use asunder::{Collider3, World3};
use asunder_geometry::{Capsule3, Cuboid, HalfSpace, Pose3, Segment3, Shape3, Sphere};
use asunder_narrow::Pair3;
use glam::{DVec3, Quat, Vec3};

fn floor() -> Shape3 {
    HalfSpace::new(Vec3::Y).unwrap().into()
}

fn cube(half: f32) -> Shape3 {
    Cuboid::from_half_extents(Vec3::splat(half)).unwrap().into()
}

/// Symptom: two rocks a thousand kilometres apart were reported 158 m too close, with a small error. Cause: the
/// barycentric weights of the closest point of a triangle were products of its far corners, and did not sum to one.
#[test]
fn a_small_triangle_far_away_keeps_its_distance() {
    let rock = hull(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    for distance in [1e4, 1e5, 7.5e5, 1e8] {
        let there = Pose3::new(DVec3::splat(distance), Quat::from_xyzw(-2.0, 4.0, 3.0, 1.0)).unwrap();
        let closest = Pair3::new(&rock, &Pose3::IDENTITY, &rock, &there).distance().unwrap();
        // Bounds of the distance: that of the nearest and of the furthest corners.
        let (low, high) = (distance * 3_f64.sqrt() - 2.0, distance * 3_f64.sqrt() + 2.0);
        let (reported, error) = (f64::from(closest.distance), f64::from(closest.error));
        assert!((low - error..=high + error).contains(&reported), "{distance}: {closest:?}");
        assert!(
            closest.anchor_a.length() < 1.01 && closest.anchor_b.length() < 1.01,
            "{distance}: {closest:?}"
        );
    }
}

/// Symptom: a die five metres under the floor touched it with its side. Cause: the threshold for "counts as deepest"
/// was stored in f32, whose half ulp was more than the die's tolerance; no corner was deep enough, and face 0 was
/// taken.
#[test]
fn a_die_deep_under_the_floor_touches_it_with_four_corners() {
    let (floor, die) = (floor(), cube(0.01));
    for depth in [0.02, 0.3, 1.0, 4.999, 40.7] {
        for there in [-depth, -1.1 * depth, -1.3 * depth] {
            let there = Pose3::at([0.0, there, 0.0]).unwrap();
            let manifold = Pair3::new(&floor, &Pose3::IDENTITY, &die, &there).manifold(0.0).unwrap();
            let heights: Vec<f32> = manifold.points.iter().map(|point| point.anchor_b.y).collect();
            assert_eq!(heights, [-0.01; 4], "{there:?}");
        }
    }
}

/// Symptom: a ball touched its floor as a pair, and not in a world. Cause: the pair's rounding error was bounded with
/// all coordinates, that of the AABBs with those on one axis.
#[test]
fn what_touches_as_a_pair_touches_in_a_world() {
    let ball: Shape3 = Sphere::new(0.5).unwrap().into();
    let slab: Shape3 = Cuboid::from_half_extents(Vec3::new(50.0, 0.5, 50.0)).unwrap().into();
    let (mut touching, mut apart) = (0, 0);
    for (ground, level) in [(floor(), 0.0), (slab, -0.5)] {
        let here = Pose3::at([0.0, level, 0.0]).unwrap();
        for place in [0.0, 40.0, 1e3, 1e6, 1e9] {
            for gap in [0.0, -1e-16, -3e-13, -3e-9, -1e-4, 1e-15, 3e-13, 1e-11, 3e-9, 1e-6, 1e-4] {
                let there = Pose3::at([place, 0.5 + gap, 0.0]).unwrap();
                let overlaps = Pair3::new(&ground, &here, &ball, &there).overlaps();
                // Nothing touches by rounding: no gap does, and the slab ends at 50 m.
                assert_eq!(
                    overlaps,
                    gap <= 0.0 && (level == 0.0 || place < 50.0),
                    "{place} m out, gap {gap}"
                );
                let mut world = World3::new();
                let keys = [(&ground, here), (&ball, there)]
                    .map(|(shape, pose)| world.insert(Collider3::new(shape.clone()).at(pose)));
                world.update();
                assert_eq!(world.is_touching(keys[0], keys[1]), overlaps, "{place} m out, gap {gap}");
                touching += usize::from(overlaps);
                apart += usize::from(!overlaps);
            }
        }
    }
    assert_eq!((touching, apart), (5 * 7, 6 * 7 + 11 * 3));
}

/// Symptom: for two half-spaces face to face, a picometre apart, `overlaps` was false, `separation` zero, and
/// `distance` had no points. Cause: this kernel was the only one that compared with the limit itself, without the
/// rounding error added.
#[test]
fn half_spaces_face_to_face_have_one_answer() {
    let (up, down) = (floor(), Shape3::from(HalfSpace::new(Vec3::NEG_Y).unwrap()));
    for gap in [-1.0, -1e-12, 0.0, 1e-12, 1e-9, 1.0] {
        let there = Pose3::at([1e3, gap, 0.0]).unwrap();
        let pair = Pair3::new(&up, &Pose3::IDENTITY, &down, &there);
        assert_eq!(pair.overlaps(), separation(&pair) <= 0.0, "gap {gap}");
        assert_eq!(pair.overlaps(), pair.distance().is_none(), "gap {gap}");
        assert_eq!(pair.overlaps(), pair.manifold(0.0).is_some(), "gap {gap}");
    }
}

/// Symptom: a capsule on the edge of a table rocked endlessly. Cause: its one contact point jumped from end to end.
#[test]
fn a_capsule_along_an_edge_rests_on_both_ends() {
    let table = cube(0.5);
    let capsule: Shape3 = Capsule3::new(Vec3::X * -0.5, Vec3::X * 0.5, 0.1).unwrap().into();
    let rod: Shape3 = Segment3::new(Vec3::X * -0.5, Vec3::X * 0.5).unwrap().into();
    let out = DVec3::new(0.0, 0.8, 0.6);
    // A capsule that leans against the edge is beside it at the ends. A sharp segment touches only where the two cross.
    for (shape, radius, leans) in [(&capsule, 0.1, [0.0, 1e-7, -1e-4]), (&rod, 0.0, [0.0, 1e-7, -2e-7])] {
        for lean in leans {
            let place = DVec3::new(0.0, 0.5, 0.5) + out * (radius + 0.001);
            let there = Pose3::new(place, Quat::from_xyzw(0.0, 0.0, lean, 1.0)).unwrap();
            let manifold = Pair3::new(&table, &Pose3::IDENTITY, shape, &there).manifold(0.01).unwrap();
            let places: Vec<f32> = manifold.points.iter().map(|point| point.anchor_a.x).collect();
            let ends = places.iter().fold([0.0_f32; 2], |[low, high], &x| [low.min(x), high.max(x)]);
            assert!(places.len() == 2 && ends[1] - ends[0] > 0.99, "lean {lean}: {places:?}");
        }
    }
}

/// Symptom: whether a mountain of 20 km and a speck touched depended on the order of the arguments. Cause: close to
/// touching, the iteration searched along a vector that was rounding noise, found no new support point, and stopped
/// with a wide gap between its bounds.
#[test]
fn nearly_touching_is_told_alike_from_both_sides() {
    let ends = [Vec3::new(-5e-6, 1.9471157e-5, -6.2244644e-6), Vec3::new(-1.5e-5, 2e-5, 7.3082783e-6)];
    let speck: Shape3 = Capsule3::new(ends[0], ends[1], 4.6307036e-6).unwrap().into();
    let mountain = hull(&[
        [-10000.0, -5000.0, 4756.701],
        [-20000.0, 20000.0, -15000.0],
        [-10630.665, 17750.08, -20000.0],
        [20000.0, 5000.0, -15000.0],
        [18624.465, -16650.047, -5993.6987],
        [5000.0, -15000.0, 20000.0],
        [-5000.0, -8191.9644, -13287.725],
    ]);
    let place = DVec3::new(339.482_687_354_087_83, 905.287_166_357_040_4, 662.799_557_430_816_5);
    for step in -20..20 {
        let there = Pose3::at(place + place.normalize() * (1e-7 * f64::from(step))).unwrap();
        let one = Pair3::new(&mountain, &Pose3::IDENTITY, &speck, &there);
        let other = Pair3::new(&speck, &there, &mountain, &Pose3::IDENTITY);
        let (from_one, from_other) = (separation(&one), separation(&other));
        // 64 roundings of 30 km are 2e-10 m.
        assert!((from_one - from_other).abs() < 1e-9, "step {step}: {from_one}, {from_other}");
    }
}

/// Symptom: of a capsule lying on another, a third of the poses had one contact point, the others two. Cause: whether a
/// point lay past the end of a segment was tested without tolerance, for points that lie exactly on the end.
#[test]
fn a_lean_of_a_hair_costs_no_point() {
    let below: Shape3 = Capsule3::new(Vec3::NEG_X, Vec3::X, 0.25).unwrap().into();
    let above: Shape3 = Capsule3::new(Vec3::X * -0.8, Vec3::X * 0.8, 0.1).unwrap().into();
    for lean in [0.0, 1e-5, -1e-3, 1e-2] {
        for step in 0..300 {
            let place = DVec3::new(0.3, 0.33 + 1e-9 * f64::from(step), 0.003);
            let there = Pose3::new(place, Quat::from_xyzw(0.0, 0.0, 0.5 * lean, 1.0)).unwrap();
            let manifold = Pair3::new(&below, &Pose3::IDENTITY, &above, &there).manifold(0.1).unwrap();
            assert_eq!(manifold.points.len(), 2, "lean {lean}, step {step}");
        }
    }
}

/// Symptom: an upright capsule had a contact point at its own centre. Cause: the far end of its segment was within a
/// wide margin, and the surface point was searched perpendicular to a segment that points at the floor.
#[test]
fn an_upright_capsule_stands_on_its_lower_end_alone() {
    let pill: Shape3 = Capsule3::from_half_height(0.1, 0.1).unwrap().into();
    let grounds = [(floor(), 0.0), (cube(0.5), -0.5)];
    for (ground, level) in grounds {
        for turn in [0.0, 1e-9, 1e-3] {
            let here = Pose3::at([0.0, level, 0.0]).unwrap();
            let there = Pose3::new(DVec3::Y * 0.21, Quat::from_xyzw(0.0, 0.0, turn, 1.0)).unwrap();
            let manifold = Pair3::new(&ground, &here, &pill, &there).manifold(0.35).unwrap();
            let heights: Vec<f32> = manifold.points.iter().map(|point| point.anchor_b.y).collect();
            assert!(heights.len() == 1 && heights[0] < -0.19, "turn {turn}: {heights:?}");
        }
    }
}

/// Symptom: a box that touched a box at a corner had three contact points there. Cause: points were compared by their
/// feature ids alone.
#[test]
fn a_place_is_one_point_whatever_meets_there() {
    let boxes = [Vec3::new(0.58761305, 0.4661633, 0.1709751), Vec3::new(0.5592223, 0.69282347, 0.15741427)];
    let [a, b] = boxes.map(|half| Shape3::from(Cuboid::from_half_extents(half).unwrap()));
    let here = Pose3::new(DVec3::ZERO, Quat::from_xyzw(0.008610252, 0.0, 0.0, 0.9999629)).unwrap();
    let place = DVec3::new(0.36914862153427636, 1.1669343495264553, -0.35940147500106884);
    let turn = Quat::from_xyzw(0.001102973, 0.9938608, 0.009948812, 0.11018416);
    let manifold = Pair3::new(&a, &here, &b, &Pose3::new(place, turn).unwrap()).manifold(0.05).unwrap();
    for (i, point) in manifold.points.iter().enumerate() {
        for other in &manifold.points[..i] {
            assert!((point.anchor_a - other.anchor_a).length() > 1e-5, "{manifold:?}");
        }
    }
}
