//! AABBs of posed shapes: no vertex outside, and no wider than rounding requires.

use asunder_geometry::{Aabb2, Aabb3, Pose2, Pose3, Shape3};
use asunder_tests::cases::Random;
use asunder_tests::placed::{Placed2, Placed3};
use asunder_tests::solid::Solid;
use glam::{DVec2, DVec3};

/// Near the origin, a kilometre out, and as far as a body may be.
const DISTANCES: [f64; 5] = [0.0, 1.0, 1e3, 1e6, 9e8];

/// Checks one side of an AABB against true extents: outside them, by at most two f32 ulps there, and `room`.
fn check_side(side: (f32, f32), [low, high]: [f64; 2], room: f64, what: &str) {
    // The oracles' own vertices are off by a few f64 ulps of their coordinates.
    let noise = 8.0 * f64::EPSILON * low.abs().max(high.abs());
    let (least, greatest) = (f64::from(side.0), f64::from(side.1));
    assert!(least <= low + noise && greatest >= high - noise, "{side:?} loses {low}..{high}: {what}");
    let steps =
        |v: f64| 2.0 * f64::from((v.abs() as f32).next_up() - v.abs() as f32) + 1e-6 * (high - low) + room;
    assert!(
        least >= low - steps(low) && greatest <= high + steps(high),
        "{side:?} for {low}..{high}: {what}"
    );
}

/// Vertices of hulls are rotated in f32, eight at a time: four units of 2^-24 of a sum of three terms.
fn room(shape: &Shape3) -> f64 {
    let Shape3::Hull(hull) = shape else { return 0.0 };
    5e-7 * hull.vertices().iter().map(|vertex| f64::from(vertex.abs().max_element())).fold(0.0, f64::max)
}

fn extent(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
}

#[test]
fn boxes_of_solids_hold_every_vertex() {
    let mut random = Random::new(1100);
    for round in 0..4000 {
        let shape = random.shape3();
        let at = random.vector() * DISTANCES[round % DISTANCES.len()];
        let pose = Pose3::new(at, random.quaternion()).unwrap();
        let placed = Placed3::new(&Solid::of(&shape), &pose, DVec3::ZERO);
        let margin = random.pick(&[0.0_f32, 0.25]);
        let Aabb3 { min, max } = shape.bounds(&pose, margin);
        for axis in 0..3 {
            let (low, high) = extent(placed.vertices.iter().map(|v| v[axis]));
            let (low, high) = (low - f64::from(margin), high + f64::from(margin));
            let what = format!("axis {axis} of {shape:?} at {pose:?}");
            check_side((min[axis], max[axis]), [low, high], room(&shape), &what);
        }
    }
}

#[test]
fn boxes_of_polygons_hold_every_vertex() {
    let mut random = Random::new(1101);
    for round in 0..4000 {
        let shape = random.shape2();
        let at = random.vector().truncate() * DISTANCES[round % DISTANCES.len()];
        let pose = Pose2::new(at, random.rotation2()).unwrap();
        let placed = Placed2::new(&shape, &pose, DVec2::ZERO);
        let margin = random.pick(&[0.0_f32, 0.25]);
        let Aabb2 { min, max } = shape.bounds(&pose, margin);
        for axis in 0..2 {
            let (low, high) = extent(placed.vertices.iter().map(|v| v[axis]));
            let (low, high) = (low - f64::from(margin), high + f64::from(margin));
            let what = format!("axis {axis} of {shape:?} at {pose:?}");
            check_side((min[axis], max[axis]), [low, high], 0.0, &what);
        }
    }
}
