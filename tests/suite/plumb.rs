//! Contact points of solids in space: one end is the other's foot along the normal, bit for bit, and manifolds that are
//! kept return them unchanged.

use asunder_geometry::{Compound3, Cuboid, Pose3, Shape3, Sphere};
use asunder_narrow::{Batch3, Hint, Job3, Manifold3, Pair3, Persistent3, collide3};
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, pairs3};
use asunder_scenes::random::Random;
use glam::{DVec3, Quat, Vec3};

/// Which end is the other's foot, for all points alike: from the reported numbers alone, in the documented order of
/// operations.
fn stays_on(manifold: &Manifold3, offset: DVec3) -> [bool; 2] {
    let normal = manifold.normal.as_dvec3();
    [true, false].map(|on_a| {
        manifold.points.iter().all(|point| {
            let out = normal * f64::from(point.separation);
            if on_a {
                (point.anchor_a.as_dvec3() - offset + out).as_vec3() == point.anchor_b
            } else {
                (point.anchor_b.as_dvec3() + offset - out).as_vec3() == point.anchor_a
            }
        })
    })
}

/// Asserts that all manifolds are plumb; returns whether one was kept, in which case it must come back in every bit.
fn check(pair: &PosedPair3, margin: f32) -> (usize, bool) {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    let offset = pose_b.position() - pose_a.position();
    let job = Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint: Hint::NONE, ahead: 0.0, sensor: false };
    let mut batch = Batch3::default();
    // Eight jobs take the wide path, which must give the same.
    collide3(&[job; 8], &mut batch);
    let alone = Pair3::new(shape_a, pose_a, shape_b, pose_b).manifolds(margin);
    assert_eq!(alone.len() * 8, batch.manifolds.len());
    for manifold in alone.iter().chain(&batch.manifolds) {
        let stays = stays_on(manifold, offset);
        assert!(stays[0] || stays[1], "{manifold:?}: {pair:?}");
    }
    let kept = Persistent3::of(&job, &batch.answers[0], &batch.manifolds);
    if let Some(kept) = &kept {
        assert!(kept.manifolds().eq(batch.manifolds[..1].iter().copied()), "{kept:?}: {pair:?}");
        let mut shown = Vec::new();
        assert!(kept.carry_on([pose_a, pose_b], &mut shown) && shown == batch.manifolds[..1]);
    }
    (alone.len(), kept.is_some())
}

#[test]
fn points_of_all_solids_are_plumb_and_come_back_as_they_were() {
    let (mut manifolds, mut kept) = (0, 0);
    let mut count = |pair: &PosedPair3, margin: f32| {
        let (more, is_kept) = check(pair, margin);
        manifolds += more;
        kept += usize::from(is_kept);
    };
    for kind in SolidKind::ALL {
        for set in [PairSet::Rest, PairSet::Touch, PairSet::Mixed, PairSet::Slide] {
            for pair in pairs3(kind, set, 150, 411) {
                count(&pair, 0.0);
                count(&pair, 0.05);
                let far = |pose: &Pose3| pose.shifted([3e5, -2e6, 7e4]).unwrap();
                count(&PosedPair3 { pose_a: far(&pair.pose_a), pose_b: far(&pair.pose_b), ..pair }, 0.01);
            }
        }
    }
    assert!(manifolds > 2000 && kept > 1000, "{manifolds} manifolds, of which {kept} are kept");
}

/// The end much further from its body's position is rounded more coarsely, and must not move the other end with it.
#[test]
fn on_a_floor_as_wide_as_a_town_the_small_body_keeps_its_ends() {
    let mut random = Random::new(412);
    let floor = Shape3::from(Cuboid::from_half_extents(Vec3::new(7e4, 0.5, 7e4)).unwrap());
    let ball = Shape3::from(Sphere::new(0.01).unwrap());
    let chip = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.02, 0.01, 0.015)).unwrap());
    let mut kept = 0;
    for round in 0..200 {
        let two = || {
            Compound3::new([
                (Pose3::IDENTITY, chip.clone()),
                (Pose3::at([0.3, 0.0, 0.0]).unwrap(), ball.clone()),
            ])
        };
        let small = [chip.clone(), ball.clone(), two().unwrap().into()][round % 3].clone();
        let rotation = Quat::from_xyzw(0.0, random.range(-1.0, 1.0) as f32, 0.0, 1.0);
        let at = DVec3::new(random.range(-6.9e4, 6.9e4), 0.51 - 1e-5, random.range(-6.9e4, 6.9e4));
        let pose = Pose3::new(at, rotation).unwrap();
        let pair = PosedPair3 {
            shape_a: floor.clone(),
            pose_a: Pose3::IDENTITY,
            shape_b: small.clone(),
            pose_b: pose,
        };
        let swapped =
            PosedPair3 { shape_a: small, pose_a: pose, shape_b: floor.clone(), pose_b: Pose3::IDENTITY };
        for (pair, on_a) in [(pair, false), (swapped, true)] {
            kept += usize::from(check(&pair, 0.0).1);
            let found = Pair3::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b).manifolds(0.0);
            assert!(!found.is_empty());
            for point in found.iter().flat_map(|manifold| &manifold.points) {
                let own = if on_a { point.anchor_a } else { point.anchor_b };
                // At a corner of the chip, or under the ball: it would be off by millimetres if it had been moved with
                // the other end.
                let own = pose.turn_back(own.as_dvec3());
                let is_corner = (own.abs() - DVec3::new(0.02, 0.01, 0.015)).length() < 1e-8;
                let is_under = [0.0, 0.3].map(|x| (own - DVec3::new(x, -0.01, 0.0)).length() < 1e-7);
                assert!(is_corner || is_under[0] || is_under[1], "{own} of {point:?}: {pair:?}");
            }
        }
    }
    assert!(kept > 50, "{kept}");
}
