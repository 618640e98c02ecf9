//! Keys of bodies that were removed.

use asunder::{
    BodyKey2, BodyKey3, Circle, Collider2, Collider3, Hit2, Hit3, Motion2, Motion3, Pose2, Pose3, Sphere,
    World2, World3,
};

fn others3<'h>(hits: impl IntoIterator<Item = &'h Hit3>) -> Vec<BodyKey3> {
    hits.into_iter().map(|hit| hit.other).collect()
}

fn others2<'h>(hits: impl IntoIterator<Item = &'h Hit2>) -> Vec<BodyKey2> {
    hits.into_iter().map(|hit| hit.other).collect()
}

/// Symptom: `impacts_of` listed impacts of a bullet that had been removed, even after another body took its slot, and
/// impacts with bodies removed since; `contacts_of` and all other calls about one body leave both out. Cause: it
/// compared keys only with those of the last update.
#[test]
fn a_bullet_that_is_gone_has_no_impacts_and_none_is_with_whom_is_gone() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap());
    let at = |x: f64| ball.clone().at(Pose3::at([x, 0.0, 0.0]).unwrap());
    let [gate, door] = [3.0, 5.0].map(|x| world.insert(at(x).sensor()));
    let wall = world.insert(at(8.0));
    let shot = world.insert(ball.clone().bullet());
    world.set_motion(shot, Motion3::shift([9.0, 0.0, 0.0]).unwrap()).unwrap();
    world.update();
    assert_eq!(others3(world.impacts_of(shot)), [gate, door, wall]);

    world.remove(door);
    assert_eq!(others3(world.impacts_of(shot)), [gate, wall]);
    let next = world.insert(ball.clone().bullet());
    assert_eq!(others3(world.impacts_of(shot)), [gate, wall], "the slot is another body's");
    assert!(others3(world.impacts_of(next)).is_empty());
    world.remove(shot);
    assert!(others3(world.impacts_of(shot)).is_empty());
    let next = world.insert(ball.clone().bullet());
    assert!(others3(world.impacts_of(shot)).is_empty() && others3(world.impacts_of(next)).is_empty());
    assert_eq!(world.impacts().len(), 3, "what the update found, as contacts() has it");
}

#[test]
fn a_bullet_of_the_plane_that_is_gone_has_no_impacts_and_none_is_with_whom_is_gone() {
    let mut world = World2::new();
    let ball = Collider2::new(Circle::new(0.5).unwrap());
    let gate = world.insert(ball.clone().sensor().at(Pose2::at([3.0, 0.0]).unwrap()));
    let wall = world.insert(ball.clone().at(Pose2::at([6.0, 0.0]).unwrap()));
    let shot = world.insert(ball.clone().bullet());
    world.set_motion(shot, Motion2::shift([9.0, 0.0]).unwrap()).unwrap();
    world.update();
    assert_eq!(others2(world.impacts_of(shot)), [gate, wall]);
    world.remove(wall);
    assert_eq!(others2(world.impacts_of(shot)), [gate]);
    world.remove(shot);
    let next = world.insert(ball.bullet());
    assert!(others2(world.impacts_of(shot)).is_empty() && others2(world.impacts_of(next)).is_empty());
    assert_eq!(world.impacts().len(), 2);
}

/// All other calls about one or two bodies, before and after another body takes the slot.
#[test]
fn no_call_about_a_body_that_is_gone_tells_anything() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(1.0).unwrap());
    let [a, b] = [(); 2].map(|()| world.insert(ball.clone()));
    world.update();
    assert!(world.is_touching(a, b));
    world.remove(b);
    for is_reused in [false, true] {
        if is_reused {
            world.insert(ball.clone());
        }
        assert!(!world.contains(b) && world.get(b).is_none() && world.pose(b).is_none());
        assert!(world.contact(a, b).is_none() && world.contact(b, a).is_none() && !world.is_touching(a, b));
        for key in [a, b] {
            assert_eq!(world.contacts_of(key).count() + world.candidates_of(key).count(), 0);
            assert_eq!(world.touching(key).count(), 0);
        }
        let stand = Motion3::shift([1.0, 0.0, 0.0]).unwrap();
        assert!(world.impact(a, b, &stand, &stand).is_err() && world.set_motion(b, stand).is_err());
        assert!(world.set_pose(b, Pose3::IDENTITY).is_err() && world.wake(b).is_err());
        assert!(world.remove(b).is_none() && world.replace(b, ball.clone()).is_err());
    }
    assert_eq!((world.contacts().len(), world.candidates().len()), (1, 1), "what the update found");
}
