//! A world whose pairs come and go by tens of thousands: contacts and events are those of a double loop over balls.
//!
//! Lists of operations elsewhere are long, and their worlds small: here pairs fill many chunks of the frame, fewer in
//! the next one, or none.

use asunder::glam::DVec3;
use asunder::{BodyKey3, Collider3, Event3, Hooks, Pose3, Sphere, World3};
use asunder_scenes::random::Random;
use std::collections::{BTreeMap, BTreeSet};

/// A ball in the model.
#[derive(Clone, Copy)]
struct Ball {
    at: DVec3,
    radius: f64,
    user_data: u64,
}

/// The pairs that overlap, the lower slot first, as the world reports them.
type Touching = BTreeSet<(BodyKey3, BodyKey3)>;

/// Bodies, and the pairs that touch; keys are compared by slot: a key that is reused has the slot of the one before.
struct Model {
    balls: BTreeMap<BodyKey3, Ball>,
    touching: Touching,
}

impl Model {
    /// Pairs that overlap now. The seed is chosen so that none is so close to touching that rounding matters.
    fn look(&self) -> Touching {
        let balls: Vec<_> = self.balls.iter().collect();
        let mut found = Touching::new();
        for (place, &(a, one)) in balls.iter().enumerate() {
            for &(b, other) in &balls[place + 1..] {
                let gap = (one.at - other.at).length() - one.radius - other.radius;
                assert!(gap.abs() > 1e-12, "too close to call");
                if gap < 0.0 {
                    found.insert(ordered(*a, *b));
                }
            }
        }
        found
    }
}

fn ordered(a: BodyKey3, b: BodyKey3) -> (BodyKey3, BodyKey3) {
    if a < b { (a, b) } else { (b, a) }
}

fn check(world: &World3, model: &mut Model, story: &str) -> [usize; 3] {
    let now = model.look();
    let told = |is_began: bool| -> Vec<(BodyKey3, BodyKey3)> {
        let events = world.events().iter().filter(|event| event.is_began() == is_began);
        events.map(|event| event.bodies()).map(|(a, b)| ordered(a, b)).collect()
    };
    let (began, ended) = (told(true), told(false));
    let expected: Vec<_> = now.difference(&model.touching).copied().collect();
    let over: Vec<_> = model.touching.difference(&now).copied().collect();
    let sorted = |mut list: Vec<(BodyKey3, BodyKey3)>| {
        list.sort_unstable();
        list
    };
    assert_eq!(sorted(began.clone()), expected, "{story}: what began");
    assert_eq!(sorted(ended.clone()), over, "{story}: what ended");
    for event in world.events() {
        if let Event3::Began { a, b, user_data_a, user_data_b, .. } = *event {
            let known = [a, b].map(|key| model.balls[&key].user_data);
            assert_eq!([user_data_a, user_data_b], known, "{story}");
        }
    }
    // Without a margin, contacts are overlapping balls.
    let contacts: Touching = world.contacts().map(|contact| ordered(contact.a, contact.b)).collect();
    assert!(contacts == now && world.contacts().len() == now.len(), "{story}: contacts");
    let stats = world.stats();
    assert_eq!([stats.contacts, stats.overlapping, stats.manifolds], [now.len(); 3], "{story}");
    for (&key, ball) in model.balls.iter().step_by(29) {
        let of = now.iter().filter(|(a, b)| *a == key || *b == key).count();
        assert_eq!(world.contacts_of(key).count(), of, "{story}");
        for contact in world.contacts_of(key) {
            let other = model.balls[&if contact.a == key { contact.b } else { contact.a }];
            let depth = (ball.at - other.at).length() - ball.radius - other.radius;
            assert!((f64::from(contact.manifolds[0].separation) - depth).abs() < 1e-5, "{story}");
            assert_eq!(world.contact(contact.b, contact.a).as_ref(), Some(&contact), "{story}");
        }
    }
    model.touching = now;
    [began.len(), ended.len(), model.touching.len()]
}

#[test]
fn pairs_by_tens_of_thousands_come_and_go_as_a_double_loop_says() {
    let mut random = Random::new(77);
    let (mut world, mut model) = (World3::new(), Model { balls: BTreeMap::new(), touching: Touching::new() });
    let (mut most, mut changes) = (0, 0);
    for frame in 0..48_u64 {
        // From all balls in one heap to a cloud without a contact, and back.
        let spread = [6.0, 1.0, 0.3, 2.0, 40.0, 0.7, 6.0, 5.0][frame as usize % 8];
        let (comes, goes) = (random.range(0.0, 40.0) as u64, if frame < 10 { 0.0 } else { 0.1 });
        let keys: Vec<BodyKey3> = model.balls.keys().copied().collect();
        for key in keys {
            if random.unit() < goes {
                assert!(world.remove(key).is_some());
                model.balls.remove(&key);
            } else if frame % 8 == 0 || random.unit() < 0.7 {
                let at = random.direction() * spread * random.unit();
                world.set_pose(key, Pose3::at(at).unwrap()).unwrap();
                model.balls.get_mut(&key).unwrap().at = at;
            }
        }
        for number in 0..comes + if frame == 0 { 300 } else { 0 } {
            let (at, radius) = (random.direction() * spread, random.range(0.2, 0.6) as f32);
            let (user_data, ball) = (frame * 1000 + number, Sphere::new(radius).unwrap());
            let key = world.insert(Collider3::new(ball).at(Pose3::at(at).unwrap()).user_data(user_data));
            model.balls.insert(key, Ball { at, radius: radius.into(), user_data });
        }
        match frame % 5 {
            // Hooks see every contact, and change none here; a copy goes on as the world would have.
            0 => world.update_with(&Hooks::new().contact(&|_| {})),
            1 => {
                world = world.clone();
                world.update();
            }
            _ => world.update(),
        }
        let [began, ended, touching] = check(&world, &mut model, &format!("frame {frame}"));
        (most, changes) = (most.max(touching), changes + began + ended);
    }
    // More pairs than the number from which chunks grow, and often.
    assert!(most > 30_000 && changes > 200_000, "{most} {changes}");
}
