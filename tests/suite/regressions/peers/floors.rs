//! A box on a floor a thousand times as wide.

use super::{cuboid, judged};
use asunder_geometry::{HalfSpace, Pose3, Shape3};
use asunder_narrow::Pair3;
use glam::{DVec3, Vec3};

/// Symptom: a crate on a floor of 500 m sank in, or hovered, and stood on one point instead of four. Cause: a
/// coordinate of 500 m is rounded by 3e-5 m in f32, and tolerances grew with the floor.
#[test]
fn a_box_on_a_floor_of_500_metres_stands_on_four_points() {
    let half_space: Shape3 = HalfSpace::new(Vec3::Y).unwrap().into();
    let grounds = [(cuboid(250.0, 0.5, 250.0), -0.5), (half_space, 0.0)];
    let crate_ = cuboid(0.25, 0.25, 0.25);
    for (ground, level) in &grounds {
        let here = Pose3::at([0.0, *level, 0.0]).unwrap();
        for place in [DVec3::ZERO, DVec3::new(200.1, 0.0, -249.7), DVec3::new(-123.456, 0.0, 77.7)] {
            for sunk in [0.0, 1e-6, 1e-3, -1e-7, -1e-3] {
                let there = Pose3::at(place + DVec3::Y * (0.25 - sunk)).unwrap();
                let found = judged((ground, &here), (&crate_, &there));
                assert_eq!(found.normal, Vec3::Y, "{sunk} m in at {place}");
                // The oracle checked this too, but here the truth is known beforehand: 0.25 - sunk is rounded by 3e-17
                // m.
                let miss = (f64::from(found.separation) + sunk).abs();
                assert!(miss <= f64::from(found.error) + 3e-17, "{sunk} m in at {place}: {found:?}");
                let manifold = Pair3::new(ground, &here, &crate_, &there).manifold(0.0);
                let heights = manifold.map(|m| m.points.iter().map(|p| p.anchor_b.y).collect::<Vec<_>>());
                assert_eq!(heights, (sunk >= 0.0).then_some(vec![-0.25; 4]), "{sunk} m in at {place}");
            }
        }
    }
}
