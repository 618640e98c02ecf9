//! Motions with an impact where there is none, or without one where there is.

use asunder::glam::{DVec3, Quat, Vec2, Vec3};
use asunder::{
    Chain, Cuboid, HalfPlane, Hull, Motion2, Motion3, Pair2, Pair3, Polygon, Pose2, Pose3, Rect, Rotation2,
    Shape2, Shape3, Sphere,
};

/// Symptom: a wheel of many sides that spins above its road had an impact with it, 0.1 mm apart. Cause: a turning body
/// needs more advancement steps than are allowed to get away from so small a gap, and when they ran out an impact was
/// reported.
#[test]
fn a_wheel_that_spins_beside_its_road_does_not_hit_it() {
    let (gap, road) = (1.384e-4, Vec2::new(3.0, 0.5));
    let wheel = Shape2::from(Polygon::regular(1.0, 256).unwrap());
    let roads: [(Shape2, f64); 3] = [
        (Rect::from_half_extents(road).unwrap().into(), 0.5),
        (HalfPlane::new(Vec2::Y).unwrap().into(), 0.0),
        (Chain::open([Vec2::X * 3.0, Vec2::X * -3.0]).unwrap().into(), 0.0),
    ];
    let spin = Rotation2::new(-1.0, 0.0).unwrap();
    let pole = Shape2::from(Rect::from_half_extents(Vec2::new(0.1, 1.0)).unwrap());
    for (road, top) in &roads {
        for way in [0.0, 1.0] {
            let motion = Motion2::new([way, 0.0], spin).unwrap();
            let here = Pose2::at([0.0, 1.0 + top + gap]).unwrap();
            let told = Pair2::new(&wheel, &here, road, &Pose2::IDENTITY).impact(&motion, &Motion2::STILL);
            assert_eq!(told, None, "{way}");
            let ahead = Pose2::at([1.6, 1.0 + top + gap]).unwrap();
            let pole = Pair2::new(&wheel, &here, &pole, &ahead).impact(&motion, &Motion2::STILL);
            assert_eq!(pole.is_some(), way > 0.5);
        }
    }
    let lying = Pose3::new(DVec3::Y * (1.5 + gap), Quat::from_xyzw(0.5_f32.sqrt(), 0.0, 0.0, 0.5_f32.sqrt()))
        .unwrap();
    let wheel = Shape3::from(Hull::prism(0.3, 1.0, 128).unwrap());
    let road = Shape3::from(Cuboid::from_half_extents(Vec3::new(3.0, 0.5, 3.0)).unwrap());
    for way in [0.0, 1.0] {
        let half = Quat::from_xyzw(0.0, 0.0, 1.0, 0.0) * lying.rotation();
        let motion = Motion3::new([way, 0.0, 0.0], half).unwrap();
        let told = Pair3::new(&wheel, &lying, &road, &Pose3::IDENTITY).impact(&motion, &Motion3::STILL);
        assert_eq!(told, None, "{way}");
    }
}

/// Symptom: at the edge of the world, poses along a body's motion overlapped another body without an impact. Cause:
/// each pose was clamped to the edge by itself, so that the path bent there, while impacts assume a straight path.
#[test]
fn poses_and_impacts_agree_at_the_edge_of_the_world() {
    let ball = Shape3::from(Sphere::new(2.0).unwrap());
    let (here, motion) = (Pose3::at([9e8, 0.0, 0.0]).unwrap(), Motion3::shift([9e8, 100.0, 0.0]).unwrap());
    assert_eq!(motion.pose_at(&here, 1.0).position(), DVec3::new(1e9, 100.0, 0.0));
    assert_eq!(motion.pose_at(&here, 0.5).position(), DVec3::new(9.5e8, 50.0, 0.0));
    for (at, is_met) in [([9.5e8, 50.0, 0.0], true), ([1e9, 50.0, 0.0], false), ([1e9, 100.0, 0.0], true)] {
        let other = Pose3::at(at).unwrap();
        let told = Pair3::new(&ball, &here, &ball, &other).impact(&motion, &Motion3::STILL);
        assert_eq!(told.is_some(), is_met, "{at:?}");
        let overlaps = |i: u32| {
            Pair3::new(&ball, &motion.pose_at(&here, f64::from(i) / 100.0), &ball, &other).overlaps()
        };
        assert_eq!((0..=100).any(overlaps), is_met, "{at:?}");
    }
}
