//! Bugs with half-spaces.

use asunder::glam::Vec3;
use asunder::{Collider3, HalfSpace, Pair3, Pose3, Shape3, TriMesh, World3};
use asunder_tests::cases::Random;

/// Symptom: a tilted level that touched a half-space with one corner only had a contact without a place and with an
/// infinite error; a save of that world as JSON could not be loaded. Cause: exact arithmetic decided that they touch,
/// rounding put the corner 1e-16 m outside, and the half-space's support vertex, which it does not have, took the place
/// of the missing point.
#[test]
fn ground_that_touches_a_half_space_with_one_corner_is_told_that_corner() {
    let sheet = TriMesh::new(vec![Vec3::ZERO, Vec3::Z, Vec3::X], vec![[0, 1, 2]]).unwrap();
    let ground = Shape3::from(sheet);
    let half_space = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let below = Pose3::at([1.0, 0.0, 1.0]).unwrap();
    let (mut random, mut touching) = (Random::new(214), 0);
    for turn in 0..500 {
        // The corner at the mesh's origin is in the plane, bit for bit; the others are above or below it.
        let tilted = Pose3::new([0.5, 0.0, 3.0], random.quaternion()).unwrap();
        let is_alone = [Vec3::X, Vec3::Z].iter().all(|corner| tilted.transform(corner.as_dvec3()).y > 1e-3);
        for is_swapped in [false, true] {
            let ((one, at), (other, there)) = if is_swapped {
                ((&half_space, &below), (&ground, &tilted))
            } else {
                ((&ground, &tilted), (&half_space, &below))
            };
            let found = Pair3::new(one, at, other, there).manifolds(0.0);
            assert_eq!(found.len(), 1, "turn {turn}: the origin touches");
            let (up, manifold) = (if is_swapped { Vec3::Y } else { Vec3::NEG_Y }, &found[0]);
            assert!((manifold.normal - up).length() < 1e-6, "turn {turn}: {manifold:?}");
            assert!(manifold.error < 1e-6 && manifold.points.iter().all(|point| point.anchor_a.is_finite()));
            if is_alone {
                touching += 1;
                assert!(manifold.separation.abs() <= 1e-12, "turn {turn}: {manifold:?}");
                let of_ground =
                    if is_swapped { manifold.points[0].anchor_b } else { manifold.points[0].anchor_a };
                assert!(manifold.points.len() == 1 && of_ground.length() < 1e-6, "turn {turn}: {manifold:?}");
            }
        }
        let mut world = World3::new();
        let level = world.insert(Collider3::new(ground.clone()).at(tilted));
        let floor = world.insert(Collider3::new(half_space.clone()).at(below));
        world.update();
        let contact = world.contact(level, floor).unwrap();
        assert!(contact.overlapping && contact.manifolds.iter().all(|manifold| manifold.error < 1e-6));
        let file = serde_json::to_string(&world.snapshot()).unwrap();
        assert!(World3::restore(&serde_json::from_str(&file).unwrap()).is_ok(), "turn {turn}");
    }
    assert!(touching > 100, "by one corner alone: {touching}");
}
