//! Hooks that panic.

use asunder::{Collider3, Event3, Hooks3, Meeting3, Motion3, Pose3, Side3, Sphere, Stats, World3};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Symptom: after a contact hook panicked, `contacts()` panicked too, and pairs that had begun to touch were never
/// reported. Cause: the lists passed to the hook were truncated in place, and the report stage came after it.
#[test]
fn a_hook_that_panics_loses_no_event_and_no_contact() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap());
    for x in 0..5 {
        world.insert(ball.clone().at(Pose3::at([0.75 * f64::from(x), 0.0, 0.0]).unwrap()));
    }
    for known in [0, 4] {
        let fails = |_: Meeting3<'_>| panic!("a game's own mistake");
        let update = AssertUnwindSafe(|| world.update_with(&Hooks3::new().contact(&fails)));
        assert!(catch_unwind(update).is_err());
        assert_eq!(world.events().iter().filter(|event| event.is_began()).count(), 4 - known);
        assert!(world.contacts().all(|contact| contact.overlapping && contact.manifolds.len() == 1));
        assert_eq!((world.contacts().count(), world.stats().manifolds), (4, 4));
    }
    world.update_with(&Hooks3::new().contact(&|meeting| meeting.manifolds.clear()));
    assert!(world.events().is_empty() && world.contacts().all(|contact| contact.manifolds.is_empty()));
    world.update();
    assert!(world.events().is_empty() && world.contacts().all(|contact| contact.manifolds.len() == 1));
}

/// Symptom: after a hook panicked, `impacts()` still had those of the previous update. Cause: they were cleared by the
/// stage that fills them.
#[test]
fn a_hook_that_panics_leaves_no_impact_of_the_update_before() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap());
    let bullet = world.insert(ball.clone().bullet());
    for x in [0.75, 4.0] {
        world.insert(ball.clone().at(Pose3::at([x, 0.0, 0.0]).unwrap()));
    }
    world.set_motion(bullet, Motion3::shift([9.0, 0.0, 0.0]).unwrap()).unwrap();
    world.update();
    assert_eq!(world.impacts().len(), 1);
    let fails = |_: Meeting3<'_>| panic!("a game's own mistake");
    assert!(catch_unwind(AssertUnwindSafe(|| world.update_with(&Hooks3::new().contact(&fails)))).is_err());
    assert!(world.impacts().is_empty());
}

/// Symptom: a world that was saved after a hook panicked forgot the effects of its pending motions. Cause: restoring
/// made AABBs at the bodies' poses only, and those that include a kept motion are made once.
#[test]
fn a_world_saved_after_a_hook_panicked_keeps_what_its_motions_bring() {
    let pair = |_: Side3<'_>, _: Side3<'_>| panic!("a game's own mistake");
    let contact = |_: Meeting3<'_>| panic!("a game's own mistake");
    for hooks in [Hooks3::new().pair(&pair), Hooks3::new().contact(&contact)] {
        let mut world = World3::new();
        let ball = Collider3::new(Sphere::new(0.5).unwrap());
        let bullet = world.insert(ball.clone().bullet());
        world.insert(ball.at(Pose3::at([5.0, 0.0, 0.0]).unwrap()));
        world.update();
        world.set_motion(bullet, Motion3::shift([8.0, 0.0, 0.0]).unwrap()).unwrap();
        assert!(catch_unwind(AssertUnwindSafe(|| world.update_with(&hooks))).is_err());
        let mut restored = World3::restore(&world.snapshot()).unwrap();
        for world in [&mut world, &mut restored] {
            world.update();
            assert_eq!((world.contacts().len(), world.impacts_of(bullet).count()), (1, 1));
        }
        assert_eq!(world.snapshot(), restored.snapshot());
    }
}

/// Symptom: after a pair hook panicked, events were those of the previous update, so that a game handled them twice,
/// and contacts were reported as new twice; counts were zero though there were candidates and contacts. Cause: all of
/// these were left to the stages after the hook.
#[test]
fn a_pair_hook_that_panics_tells_nothing_twice_and_loses_nothing() {
    let mut world = World3::new();
    let ball = Collider3::new(Sphere::new(0.5).unwrap());
    let at = |x: f64| Pose3::at([x, 0.0, 0.0]).unwrap();
    let [_, parts, comes] = [0.0, 0.75, 9.0].map(|x| world.insert(ball.clone().at(at(x))));
    world.update();
    assert_eq!((world.events().len(), world.contacts().filter(|contact| contact.is_new).count()), (1, 1));
    // One body leaves and another arrives in an update that panics; twice.
    let fails = |_: Side3<'_>, _: Side3<'_>| panic!("a game's own mistake");
    for x in [-5.0, -0.5] {
        world.set_pose(parts, at(5.0)).unwrap();
        world.set_pose(comes, at(x)).unwrap();
        // A pair for which the hook is called in any case.
        let [one, other] = [20.0, 20.5].map(|x| world.insert(ball.clone().at(at(x))));
        assert!(catch_unwind(AssertUnwindSafe(|| world.update_with(&Hooks3::new().pair(&fails)))).is_err());
        assert!(world.events().is_empty() && world.contacts().all(|contact| !contact.is_new));
        let Stats { candidates, contacts, overlapping, manifolds, .. } = *world.stats();
        assert_eq!((candidates, contacts, overlapping, manifolds), (1, 1, 1, 1));
        assert_eq!((world.candidates().len(), world.contacts().len()), (1, 1));
        [one, other].into_iter().for_each(|key| drop(world.remove(key)));
    }
    world.update();
    let told: Vec<bool> = world.events().iter().map(Event3::is_began).collect();
    assert_eq!(told, [false, true], "what parted has ended, what came has begun");
    world.update();
    assert!(world.events().is_empty());
}
