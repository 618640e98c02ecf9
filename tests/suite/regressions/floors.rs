//! Floors many times larger than the bodies that leave them.

use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{Capsule3, Cuboid, Hull, Motion3, Pair3, Pose3, Shape3, Sphere, TriMesh};

/// Symptom: a ball 2e-10 m above a cuboid of 1 km that moved away from it was reported to hit it at once; so were four
/// of ten bodies within 1e-10 m of such a floor. Cause: whether they separate was decided on one axis, that between the
/// closest points. It is off by the rounding of the larger size over the smaller one, and shows an overlap.
#[test]
fn what_leaves_a_large_floor_does_not_meet_it() {
    let half = 500.0_f32;
    let corners =
        [[-half, -half], [-half, half], [half, half], [half, -half]].map(|[x, z]| Vec3::new(x, 0.5, z));
    let floors: [Shape3; 3] = [
        Cuboid::from_half_extents(Vec3::new(half, 0.5, half)).unwrap().into(),
        Hull::prism(0.5, half, 8).unwrap().into(),
        TriMesh::new(corners, [[0, 1, 2], [0, 2, 3]]).unwrap().into(),
    ];
    let bodies: [(Shape3, f64); 4] = [
        (Sphere::new(0.25).unwrap().into(), 0.25),
        (Capsule3::from_half_height(0.2, 0.25).unwrap().into(), 0.45),
        (Cuboid::from_half_extents(Vec3::splat(0.25)).unwrap().into(), 0.25),
        (Hull::prism(0.25, 0.1, 5).unwrap().into(), 0.25),
    ];
    for (x, y, z) in [(-0.1197, 0.1618, 0.1334), (0.3, -0.2, 0.7), (0.01, 0.9, -0.4), (-0.6, 0.5, 0.2)] {
        let base = Pose3::new([3.0, 4.0, 5.0], Quat::from_xyzw(x, y, z, 1.0)).unwrap();
        for floor in &floors {
            for (body, low) in &bodies {
                for gap in [1e-12, 1e-11, 1e-10, 2e-10, 5e-10, 1e-9, 1e-7] {
                    let place = DVec3::new(7.0, 0.5 + low + gap, -31.0);
                    let here = base.compose(&Pose3::at(place).unwrap()).unwrap();
                    let pair = Pair3::new(body, &here, floor, &base);
                    if pair.overlaps() {
                        continue;
                    }
                    for up in [0.01, 0.3] {
                        let way = base.turn(DVec3::new(0.08, up, 0.02));
                        let motion = Motion3::shift(way).unwrap();
                        let told = [pair.cast(way.as_vec3()), pair.impact(&motion, &Motion3::STILL)];
                        assert_eq!(told, [None; 2], "{gap} m above {floor:?}, {up}: {body:?}");
                        // A body that moves into it does hit it.
                        let down = base.turn(DVec3::new(0.08, -up, 0.02)).as_vec3();
                        assert!(pair.cast(down).is_some_and(|met| met.fraction < 1e-3), "{gap} {body:?}");
                    }
                }
            }
        }
    }
}
