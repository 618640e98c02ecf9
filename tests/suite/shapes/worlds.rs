//! Worlds of bodies of every kind: unbounded floors, balls that fall on them, compounds with several manifolds.

use asunder::{
    Circle, Collider2, Collider3, Compound2, Compound3, Cuboid, Event, HalfPlane, HalfSpace, Pose2, Pose3,
    Rect, Shape2, Shape3, Sphere, World2, World3,
};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::{Bodies2, Bodies3};
use asunder_tests::cases::{Case2, Case3, Random};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use glam::{Vec2, Vec3};

/// Down a metre per step and up again: one `Began` where it reaches the floor, one `Ended` where it leaves.
#[test]
fn a_ball_that_bounces_off_an_endless_floor() {
    for far in [0.0, 1e6, 9e8] {
        let mut world = World3::new();
        let floor = world.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()).fixed().user_data(1));
        let at = |height: f64| Pose3::at([far, height, -far]).unwrap();
        let ball = Collider3::new(Sphere::new(0.5).unwrap()).at(at(3.25)).user_data(2).margin(0.125).unwrap();
        let ball = world.insert(ball);
        let mut story = Vec::new();
        for height in [3.25, 1.0, 0.625, 0.5, 0.375, -9.0, 0.5, 0.5625, 0.75, 4.0] {
            world.set_pose(ball, at(height)).unwrap();
            world.update();
            let candidates: Vec<_> = world.candidates().collect();
            // The floor's AABB ends at its plane, since its normal is an axis.
            assert_eq!(candidates.contains(&(floor, ball)), height <= 0.625 + 1e-6, "at {height} m");
            let contact = world.contact(floor, ball);
            assert_eq!(contact.is_some(), height <= 0.625, "at {height} m");
            if let Some(contact) = contact {
                let [manifold] = contact.manifolds else { panic!("one manifold at {height}: {contact:?}") };
                assert_eq!(contact.overlapping, height <= 0.5);
                assert!((f64::from(manifold.separation) - (height - 0.5)).abs() <= f64::from(manifold.error));
                assert_eq!((manifold.normal, manifold.points.len()), (Vec3::Y, 1));
                assert_eq!(manifold.points[0].anchor_b, Vec3::NEG_Y * 0.5);
            }
            story.extend(world.events().iter().map(|event| match event {
                Event::Began { user_data_a, user_data_b, .. } => (true, *user_data_a, *user_data_b, height),
                Event::Ended { user_data_a, user_data_b, .. } => (false, *user_data_a, *user_data_b, height),
            }));
        }
        assert_eq!(story, [(true, 1, 2, 0.5), (false, 1, 2, 0.75)], "{far} m out");
    }
}

#[test]
fn a_compound_makes_one_contact_with_several_manifolds() {
    let leg = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.1, 0.5, 0.1)).unwrap());
    let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
    let legs = corners.map(|(x, z)| (Pose3::at([x, 0.5, z]).unwrap(), leg.clone()));
    let top = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.2, 0.1, 1.2)).unwrap());
    let parts = legs.into_iter().chain([(Pose3::at([0.0, 1.1, 0.0]).unwrap(), top)]);
    let table = Compound3::new(parts).unwrap();
    let mut world = World3::new();
    let floor = world.insert(Collider3::new(HalfSpace::new(Vec3::Y).unwrap()).fixed());
    let table = world.insert(Collider3::new(table));
    let ball = Collider3::new(Sphere::new(0.5).unwrap()).at(Pose3::at([0.0, 1.7, 0.0]).unwrap());
    let ball = world.insert(ball);
    world.update();
    assert_eq!(world.events().len(), 2, "one for each pair of bodies: {:?}", world.events());
    let contact = world.contact(floor, table).unwrap();
    let parts: Vec<u32> = contact.manifolds.iter().map(|manifold| manifold.part_b).collect();
    assert_eq!(parts, [0, 1, 2, 3], "four legs stand");
    assert!(
        contact.manifolds.iter().all(|manifold| manifold.points.len() == 4 && manifold.separation == 0.0)
    );
    let contact = world.contact(table, ball).unwrap();
    assert_eq!(contact.manifolds.iter().map(|m| (m.part_a, m.part_b)).collect::<Vec<_>>(), [(4, 0)]);
    assert!(world.contact(floor, ball).is_none());
    // In the plane: a dumbbell on a line.
    let disc = Shape2::from(Circle::new(0.5).unwrap());
    let parts = [-2.0, 2.0].map(|x| (Pose2::at([x, 0.5]).unwrap(), disc.clone()));
    let bar = Shape2::from(Rect::from_half_extents(Vec2::new(2.0, 0.1)).unwrap());
    let dumbbell = Compound2::new(parts.into_iter().chain([(Pose2::at([0.0, 0.5]).unwrap(), bar)])).unwrap();
    let mut world = World2::new();
    let line = world.insert(Collider2::new(HalfPlane::new(Vec2::Y).unwrap()).fixed());
    let dumbbell = world.insert(Collider2::new(dumbbell));
    world.update();
    let contact = world.contact(line, dumbbell).unwrap();
    assert_eq!(contact.manifolds.iter().map(|manifold| manifold.part_b).collect::<Vec<_>>(), [0, 1]);
}

/// A crowd of all kinds and a floor: the contacts are those of all pairs, by the oracles and without any AABB.
#[test]
fn contacts_of_a_crowd_of_every_kind_are_those_of_all_pairs() {
    let (mut contacts, mut overlapping) = (0, 0);
    for seed in 0..12 {
        let mut random = Random::new(7500 + seed);
        let mut world = World3::new();
        let mut plane = World2::new();
        let bodies: Vec<Collider3> = (0..60)
            .map(|i| {
                let kind = if i == 0 { KINDS3.len() - 1 } else { i % (KINDS3.len() - 1) };
                let shape = KINDS3[kind].1(&mut Clay::new(&mut random, 0.6));
                Collider3::new(shape).at(Pose3::new(random.vector() * 2.5, random.quaternion()).unwrap())
            })
            .collect();
        let flat: Vec<Collider2> = (0..60)
            .map(|i| {
                let kind = if i == 0 { KINDS2.len() - 1 } else { i % (KINDS2.len() - 1) };
                let shape = KINDS2[kind].1(&mut Clay::new(&mut random, 0.6));
                let at = random.vector().truncate() * 6.0;
                Collider2::new(shape).at(Pose2::new(at, random.rotation2()).unwrap())
            })
            .collect();
        let keys: Vec<_> = bodies.iter().map(|body| world.insert(body.clone())).collect();
        let flat_keys: Vec<_> = flat.iter().map(|body| plane.insert(body.clone())).collect();
        world.update();
        plane.update();
        for b in 0..bodies.len() {
            for a in 0..b {
                let judged = Bodies3::new(Case3 {
                    shape_a: bodies[a].shape().clone(),
                    pose_a: *bodies[a].pose(),
                    shape_b: bodies[b].shape().clone(),
                    pose_b: *bodies[b].pose(),
                });
                let truth = judged.true_separation();
                if truth.abs() > 1e-13 * judged.reach() {
                    let contact = world.contact(keys[a], keys[b]);
                    assert_eq!(contact.is_some(), truth < 0.0, "true {truth}: {judged:?}");
                    overlapping += usize::from(contact.is_some());
                }
                let judged = Bodies2::new(Case2 {
                    shape_a: flat[a].shape().clone(),
                    pose_a: *flat[a].pose(),
                    shape_b: flat[b].shape().clone(),
                    pose_b: *flat[b].pose(),
                });
                let truth = judged.true_separation();
                if truth.abs() > 1e-13 * judged.reach() {
                    let contact = plane.contact(flat_keys[a], flat_keys[b]);
                    assert_eq!(contact.is_some(), truth < 0.0, "true {truth}: {judged:?}");
                    overlapping += usize::from(contact.is_some());
                }
            }
        }
        contacts += world.contacts().count() + plane.contacts().count();
    }
    assert!(contacts > 1000 && overlapping > 1000, "{contacts} contacts, {overlapping} judged in overlap");
}
