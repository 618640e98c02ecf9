//! Large worlds in which hardly anything moves: whole chunks of pairs are carried from one update to the next without
//! being processed, and the results must not differ.
//!
//! The world is compared with a clone made just before the update: it has no chunk to carry over, and processes every
//! pair.

use crate::stored::Stored;
use asunder::{Collider, Hooks, Plane, Volume, World};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Change, Traits};

/// A crowd of bodies that touch one another; a few things happen in most frames, and nothing in some.
fn live<S: Stored>(seed: u128, (count, room): (usize, f64), frames: usize) {
    let mut random = Random::new(seed);
    let mut world = World::<S>::new();
    let body = |random: &mut Random| -> Collider<S> {
        let body = S::random_body(random, room);
        S::with_traits(&body, Traits { fixed: false, ..Traits::of(&body) })
    };
    let mut keys: Vec<S::Key> = (0..count).map(|_| S::insert(&mut world, body(&mut random))).collect();
    world.update();
    assert!(world.stats().candidates > 3000, "many chunks: {:?}", world.stats());
    let (mut events, mut impacts) = (0, 0);
    for frame in 0..frames {
        for _ in 0..[0, 1, 2, 5, 0, 40][random.below(6)] {
            let place = random.below(keys.len());
            let fresh = body(&mut random);
            match random.below(8) {
                0 => keys.push(S::insert(&mut world, fresh)),
                1 => assert!(S::remove(&mut world, keys.swap_remove(place)).is_some()),
                2 => assert!(S::change(&mut world, keys[place], &Change::random(&mut random))),
                3 => {
                    assert!(S::change(&mut world, keys[place], &Change::Bullet(true)));
                    assert!(S::set_motion(&mut world, keys[place], S::random_motion(&mut random, 3.0)));
                }
                _ => assert!(S::set_pose(&mut world, keys[place], S::pose_of(&fresh))),
            }
        }
        let mut copy = world.clone();
        // Now and then there is less room for pairs than needed: everything stays, and is processed later.
        let most = if frame % 17 == 16 { 10 } else { 1 << 24 };
        // And a hook whose answer depends on the bodies alone, too; it is called for each pair.
        let hooks =
            Hooks::new().pair(&|a, b| a.body.get_user_data() % 19 != 3 || b.body.get_user_data() % 2 == 0);
        for world in [&mut world, &mut copy] {
            world.set_max_pairs(most);
            if frame % 13 == 12 {
                world.update_with(&hooks);
            } else {
                world.update();
            }
        }
        assert_eq!(S::events(&world), S::events(&copy), "frame {frame}");
        assert_eq!(S::impacts(&world), S::impacts(&copy), "frame {frame}");
        assert_eq!(S::candidates(&world), S::candidates(&copy), "frame {frame}");
        assert_eq!(S::contacts(&world), S::contacts(&copy), "frame {frame}");
        let key = keys[random.below(keys.len())];
        assert_eq!(S::contacts_of(&world, key), S::contacts_of(&copy, key), "frame {frame}");
        assert_eq!(S::candidates_of(&world, key), S::candidates_of(&copy, key), "frame {frame}");
        let counts = |world: &World<S>| {
            let stats = world.stats();
            [stats.bodies, stats.moved, stats.candidates, stats.contacts, stats.overlapping, stats.manifolds]
        };
        assert_eq!(counts(&world), counts(&copy), "frame {frame}");
        assert_eq!(S::checksum(&world), S::checksum(&copy), "frame {frame}: all that a future depends on");
        events += S::events(&world).len();
        impacts += S::impacts(&world).len();
    }
    assert!(events > 200 && impacts > 10, "{events} events, {impacts} impacts");
}

#[test]
fn nobody_can_tell_what_was_not_looked_at_in_space() {
    live::<Volume>(4100, (700, 4.0), 160);
}

#[test]
fn nobody_can_tell_what_was_not_looked_at_in_the_plane() {
    live::<Plane>(4101, (700, 9.0), 160);
}
