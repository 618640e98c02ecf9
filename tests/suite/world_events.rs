//! Events and look-ups step by step: what a game sees when bodies come, go, move and take over a slot.

use asunder::slotmap::{Key, SecondaryMap};
use asunder::{
    Collider2, Collider3, Event, Layers, MarginError, Plane, Rect, Volume, World, World2, glam::Vec2,
};
use asunder_tests::engine::{Engine, slot_of};

/// Runs one story in both dimensions.
macro_rules! in_both_worlds {
    ($($name:ident)*) => {$(
        #[test]
        fn $name() {
            stories::$name::<Volume>();
            stories::$name::<Plane>();
        }
    )*};
}

in_both_worlds! {
    touch_stay_and_part
    events_come_in_pair_order
    removal_in_the_frame_after_insertion
    removal_ends_every_contact
    a_reused_slot_is_a_new_body
    a_stale_key_never_reaches_another_body
    coming_and_going_between_updates_leaves_no_event
    leaving_and_returning_between_updates_leaves_no_event
    a_margin_is_a_contact_before_and_a_hysteresis_after
    sensors_report_without_manifolds
    who_may_not_meet
    too_many_pairs_keep_the_last_contacts
    bodies_that_vanish_during_an_overflow
    clear_ends_everything
    the_same_pose_is_no_move
    keys_serve_in_secondary_maps
    kissing_bodies_are_found_however_far_out
}

fn began<K>(a: K, b: K, user_data_a: u64, user_data_b: u64) -> Event<K> {
    Event::Began { a, b, user_data_a, user_data_b, sensor: false }
}

fn ended<K>(a: K, b: K, user_data_a: u64, user_data_b: u64) -> Event<K> {
    Event::Ended { a, b, user_data_a, user_data_b, sensor: false }
}

/// The same event, for a pair with a sensor.
fn sensed<K>(mut event: Event<K>) -> Event<K> {
    let (Event::Began { sensor, .. } | Event::Ended { sensor, .. }) = &mut event;
    *sensor = true;
    event
}

/// Unit bodies at these places, numbered from 10 in their user data, after one update.
fn row<S: Engine>(places: &[f64]) -> (World<S>, Vec<S::Key>) {
    let mut world = World::new();
    let body = |(i, &x): (usize, &f64)| S::unit_at(x).user_data(10 + i as u64);
    let keys = places.iter().enumerate().map(body).map(|body| S::insert(&mut world, body)).collect();
    world.update();
    (world, keys)
}

fn go<S: Engine>(world: &mut World<S>, key: S::Key, x: f64) {
    assert!(S::set_pose(world, key, S::pose_at(x)));
}

mod stories {
    use super::*;

    pub(super) fn touch_stay_and_part<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 5.0]);
        let (a, b) = (keys[0], keys[1]);
        assert!(S::events(&world).is_empty() && S::contacts(&world).is_empty());
        go(&mut world, b, 0.75);
        assert!(!S::is_touching(&world, a, b), "what is read is as of the last update");
        world.update();
        assert_eq!(S::events(&world), [began(a, b, 10, 11)]);
        assert!(S::contacts(&world)[0].is_new && S::is_touching(&world, b, a));
        for x in [0.75, 0.8, -0.3] {
            go(&mut world, b, x);
            world.update();
            assert!(S::events(&world).is_empty(), "staying is no event");
            assert!(!S::contacts(&world)[0].is_new && S::contacts(&world)[0].overlapping);
        }
        go(&mut world, b, 1.0);
        world.update();
        assert!(S::is_touching(&world, a, b), "a shared side is a touch");
        go(&mut world, b, 1.0_f64.next_up());
        world.update();
        assert_eq!(S::events(&world), [ended(a, b, 10, 11)]);
        assert!(S::contacts(&world).is_empty() && !S::is_touching(&world, a, b));
        world.update();
        assert!(S::events(&world).is_empty());
    }

    pub(super) fn events_come_in_pair_order<S: Engine>() {
        // 0 and 1 touch, 3 touches nothing; then 3 moves to 0 while 1 leaves.
        let (mut world, keys) = row::<S>(&[0.0, 0.9, 10.0, 20.0]);
        assert_eq!(S::events(&world), [began(keys[0], keys[1], 10, 11)]);
        go(&mut world, keys[1], 10.5);
        go(&mut world, keys[3], 0.5);
        world.update();
        let expected = [
            ended(keys[0], keys[1], 10, 11),
            began(keys[0], keys[3], 10, 13),
            began(keys[1], keys[2], 11, 12),
        ];
        assert_eq!(S::events(&world), expected);
    }

    pub(super) fn removal_in_the_frame_after_insertion<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0]);
        let guest = S::insert(&mut world, S::unit_at(0.5).user_data(99));
        world.update();
        assert_eq!(S::events(&world), [began(keys[0], guest, 10, 99)]);
        assert_eq!(S::remove(&mut world, guest).unwrap().get_user_data(), 99);
        world.update();
        assert_eq!(S::events(&world), [ended(keys[0], guest, 10, 99)], "both user data, though one is gone");
        assert!(S::contacts(&world).is_empty());
    }

    pub(super) fn removal_ends_every_contact<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5, 1.0, 1.5]);
        let middle = keys[1];
        S::remove(&mut world, middle);
        assert!(S::contacts_of(&world, middle).is_empty() && S::touching(&world, middle).is_empty());
        assert!(!S::is_touching(&world, keys[0], middle) && S::contact(&world, keys[0], middle).is_none());
        assert!(S::candidates_of(&world, middle).is_empty());
        assert_eq!(
            S::candidates_of(&world, keys[2]),
            [(keys[0], keys[2]), (keys[2], keys[3])],
            "who is left"
        );
        world.update();
        let gone =
            [(0, 1), (1, 2), (1, 3)].map(|(i, j)| ended(keys[i], keys[j], 10 + i as u64, 10 + j as u64));
        assert_eq!(S::events(&world), gone);
    }

    pub(super) fn a_reused_slot_is_a_new_body<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5]);
        S::remove(&mut world, keys[1]);
        let tenant = S::insert(&mut world, S::unit_at(0.5).user_data(77));
        assert_eq!(slot_of(tenant), slot_of(keys[1]), "the story needs a reused slot");
        assert_ne!(tenant, keys[1]);
        assert!(!S::is_touching(&world, keys[0], tenant), "its predecessor's contact is not its own");
        assert!(S::contacts_of(&world, tenant).is_empty() && S::contact(&world, keys[0], tenant).is_none());
        assert!(S::candidates_of(&world, tenant).is_empty() && S::candidates_of(&world, keys[0]).is_empty());
        world.update();
        let expected = [ended(keys[0], keys[1], 10, 11), began(keys[0], tenant, 10, 77)];
        assert_eq!(S::events(&world), expected, "what ended comes first");
        assert!(S::contacts(&world)[0].is_new);
    }

    pub(super) fn a_stale_key_never_reaches_another_body<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 5.0]);
        let stale = keys[1];
        S::remove(&mut world, stale);
        let tenant = S::insert(&mut world, S::unit_at(0.5).user_data(77));
        assert_eq!(slot_of(tenant), slot_of(stale));
        world.update();
        assert!(S::get(&world, stale).is_none() && S::remove(&mut world, stale).is_none());
        assert!(!S::set_pose(&mut world, stale, S::pose_at(40.0)));
        assert!(!S::is_touching(&world, keys[0], stale) && S::contact(&world, keys[0], stale).is_none());
        assert!(S::contacts_of(&world, stale).is_empty() && S::touching(&world, stale).is_empty());
        world.update();
        assert!(S::is_touching(&world, keys[0], tenant), "the tenant was not moved");
        assert_eq!(S::contacts_of(&world, tenant).len(), 1);
        let null = S::Key::null();
        assert!(S::get(&world, null).is_none() && !S::set_pose(&mut world, null, S::pose_at(0.0)));
    }

    pub(super) fn coming_and_going_between_updates_leaves_no_event<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0]);
        let guest = S::insert(&mut world, S::unit_at(0.5));
        S::remove(&mut world, guest);
        world.update();
        assert!(S::events(&world).is_empty() && S::contacts(&world).is_empty());
        assert_eq!((world.len(), world.stats().bodies, world.stats().candidates), (1, 1, 0));
        // A body that leaves its slot to another between two updates causes no event either.
        let guest = S::insert(&mut world, S::unit_at(0.5));
        S::remove(&mut world, guest);
        let tenant = S::insert(&mut world, S::unit_at(0.5).user_data(5));
        world.update();
        assert_eq!(S::events(&world), [began(keys[0], tenant, 10, 5)]);
    }

    pub(super) fn leaving_and_returning_between_updates_leaves_no_event<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5]);
        go(&mut world, keys[1], 50.0);
        go(&mut world, keys[1], 0.5);
        world.update();
        assert!(S::events(&world).is_empty() && S::is_touching(&world, keys[0], keys[1]));
    }

    pub(super) fn a_margin_is_a_contact_before_and_a_hysteresis_after<S: Engine>() {
        let mut world = World::<S>::new();
        let a = S::insert(&mut world, S::unit_at(0.0).margin(0.125).unwrap());
        let b = S::insert(&mut world, S::unit_at(3.0).margin(0.25).unwrap());
        let mut at = |x: f64| {
            go(&mut world, b, x);
            world.update();
            let contacts = S::contacts(&world);
            let flags = contacts.first().map(|contact| (contact.overlapping, contact.is_new));
            assert!(contacts.iter().all(|contact| contact.manifolds.len() == 1));
            (flags, S::events(&world).to_vec(), S::is_touching(&world, a, b))
        };
        let nothing = Vec::new;
        assert_eq!(at(1.376), (None, nothing(), false), "beyond both margins");
        assert_eq!(at(1.375), (Some((false, false)), nothing(), false), "within: a contact, no event");
        assert_eq!(at(1.1), (Some((false, false)), nothing(), false));
        assert_eq!(at(0.9), (Some((true, true)), vec![began(a, b, 0, 0)], true));
        assert_eq!(at(1.1), (Some((false, false)), nothing(), true), "apart, yet within: it goes on");
        assert_eq!(at(0.9), (Some((true, false)), nothing(), true), "and does not begin again");
        assert_eq!(at(1.375), (Some((false, false)), nothing(), true));
        assert_eq!(at(1.376), (None, vec![ended(a, b, 0, 0)], false));
        assert_eq!(at(1.3), (Some((false, false)), nothing(), false), "once ended, only a touch begins it");
        assert_eq!(at(2.0), (None, nothing(), false), "what never began does not end");
    }

    pub(super) fn sensors_report_without_manifolds<S: Engine>() {
        let mut world = World::<S>::new();
        let door = S::insert(&mut world, S::unit_at(0.0).sensor().fixed().user_data(1));
        let eye = S::insert(&mut world, S::unit_at(0.25).sensor().user_data(2));
        let body = S::insert(&mut world, S::unit_at(0.5).user_data(3));
        world.update();
        let expected = [began(door, eye, 1, 2), began(door, body, 1, 3), began(eye, body, 2, 3)].map(sensed);
        assert_eq!(S::events(&world), expected, "sensors sense solids and each other");
        for contact in S::contacts(&world) {
            assert!(contact.sensor && contact.overlapping && contact.manifolds.is_empty());
        }
        assert_eq!(S::touching(&world, door), [eye, body]);
        assert_eq!(world.stats().manifolds, 0);
        go(&mut world, body, 9.0);
        world.update();
        assert_eq!(S::events(&world), [ended(door, body, 1, 3), ended(eye, body, 2, 3)].map(sensed));
    }

    pub(super) fn who_may_not_meet<S: Engine>() {
        let layers = |member_of, collides_with| Layers { member_of, collides_with };
        let here = || S::unit_at(0.0);
        let pairs = [
            (here(), here(), true),
            (here().fixed(), here(), true),
            (here().fixed(), here().fixed(), false),
            (here().owner(0), here().owner(0), false),
            (here().owner(0), here().owner(1), true),
            (here().owner(0), here(), true),
            (here().layers(layers(0b01, 0b10)), here().layers(layers(0b10, 0b01)), true),
            (here().layers(layers(0b01, 0b10)), here().layers(layers(0b10, 0b10)), false),
            (here().layers(layers(0b01, 0b01)), here().layers(layers(0b10, 0b01)), false),
            (here().layers(layers(0, u32::MAX)), here(), false),
            (here().sensor().fixed(), here().fixed(), false),
        ];
        for (i, (one, other, meet)) in pairs.into_iter().enumerate() {
            let mut world = World::<S>::new();
            let (a, b) = (S::insert(&mut world, one), S::insert(&mut world, other));
            world.update();
            assert_eq!(S::candidates(&world), if meet { vec![(a, b)] } else { vec![] }, "pair {i}");
            assert_eq!(S::is_touching(&world, a, b), meet, "pair {i}");
            assert_eq!(S::events(&world).len(), usize::from(meet), "pair {i}");
        }
    }

    pub(super) fn too_many_pairs_keep_the_last_contacts<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5, 9.0, 20.0]);
        let before = format!("{:?}", S::contacts(&world)).replace("is_new: true", "is_new: false");
        world.set_max_pairs(2);
        go(&mut world, keys[2], 0.25);
        for _ in 0..3 {
            world.update();
            assert!(world.stats().overflow);
            assert!(S::events(&world).is_empty(), "no events in a frame that was given up");
            assert_eq!(format!("{:?}", S::contacts(&world)), before, "last frame's contacts");
            assert!(S::is_touching(&world, keys[0], keys[1]) && !S::is_touching(&world, keys[0], keys[2]));
        }
        world.set_max_pairs(3);
        world.update();
        assert!(!world.stats().overflow);
        // What began while updates were given up begins now; what went on all the time has no event.
        assert_eq!(S::events(&world), [began(keys[0], keys[2], 10, 12), began(keys[1], keys[2], 11, 12)]);
        assert_eq!(S::contacts(&world).len(), 3);
    }

    pub(super) fn bodies_that_vanish_during_an_overflow<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5, 0.25]);
        world.set_max_pairs(0);
        S::remove(&mut world, keys[0]);
        world.update();
        assert!(world.stats().overflow && S::events(&world).is_empty());
        let tenant = S::insert(&mut world, S::unit_at(0.5).user_data(44));
        assert_eq!(slot_of(tenant), slot_of(keys[0]));
        world.update();
        assert!(world.stats().overflow);
        assert!(S::contacts_of(&world, tenant).is_empty(), "the old contacts are not the tenant's");
        assert!(S::contacts_of(&world, keys[0]).is_empty(), "nor reached by a stale key");
        world.set_max_pairs(100);
        world.update();
        let expected = [
            ended(keys[0], keys[1], 10, 11),
            began(tenant, keys[1], 44, 11),
            ended(keys[0], keys[2], 10, 12),
            began(tenant, keys[2], 44, 12),
        ];
        assert_eq!(S::events(&world), expected, "an end always arrives, however late");
    }

    pub(super) fn clear_ends_everything<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5, 9.0]);
        world.clear();
        assert!(world.is_empty() && S::get(&world, keys[2]).is_none());
        let newcomer = S::insert(&mut world, S::unit_at(0.0));
        world.update();
        assert_eq!(S::events(&world), [ended(keys[0], keys[1], 10, 11)]);
        assert_eq!((world.len(), S::contacts(&world).len()), (1, 0));
        assert!(!keys.contains(&newcomer), "a cleared world gives no key twice");
        go(&mut world, newcomer, 0.1);
        let other = S::insert(&mut world, S::unit_at(0.3));
        world.update();
        assert!(S::is_touching(&world, newcomer, other));
    }

    pub(super) fn the_same_pose_is_no_move<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5, 1.5]);
        assert_eq!(world.stats().moved, 3, "all of them are new");
        world.update();
        assert_eq!(world.stats().moved, 0);
        go(&mut world, keys[0], 0.0);
        go(&mut world, keys[2], 1.25);
        world.update();
        assert_eq!(world.stats().moved, 1, "the same bits are no move");
        go(&mut world, keys[0], -0.0);
        world.update();
        assert_eq!(world.stats().moved, 1, "other bits are, whatever they mean");
    }

    /// AABBs are f32 and coarse far out, where one ulp is 64 m: they must be rounded outwards.
    pub(super) fn kissing_bodies_are_found_however_far_out<S: Engine>() {
        for origin in [0.0, 1.0 / 3.0, 4096.1, 1e6 + 0.7, -1e6 - 0.3, 1e8 + 0.9, -9e8 + 0.4] {
            // On a grid of 2^-20 m, so that the two are exactly a metre apart.
            let x = (f64::round(origin * 1_048_576.0)) / 1_048_576.0;
            for side in [1.0, -1.0] {
                let (mut world, keys) = row::<S>(&[x, x + side]);
                assert_eq!(S::events(&world), [began(keys[0], keys[1], 10, 11)], "at {x}, side {side}");
                go(&mut world, keys[1], x + side * 1.000_01);
                world.update();
                assert_eq!(S::events(&world), [ended(keys[0], keys[1], 10, 11)], "at {x}, side {side}");
            }
            // A margin is added before the AABB is rounded.
            let mut world = World::<S>::new();
            for place in [x, x + 1.75] {
                S::insert(&mut world, S::unit_at(place).margin(0.375).unwrap());
            }
            world.update();
            assert_eq!(S::contacts(&world).len(), 1, "margins meet at {x}");
        }
    }

    pub(super) fn keys_serve_in_secondary_maps<S: Engine>() {
        let (mut world, keys) = row::<S>(&[0.0, 0.5]);
        let mut names: SecondaryMap<S::Key, &str> = SecondaryMap::new();
        names.insert(keys[0], "crate");
        names.insert(keys[1], "barrel");
        S::remove(&mut world, keys[1]);
        let tenant = S::insert(&mut world, S::unit_at(2.0));
        assert_eq!((names.get(keys[0]), names.get(tenant)), (Some(&"crate"), None));
    }
}

/// What only concrete worlds have: many bodies in one call.
macro_rules! many_at_once {
    ($($name:ident $space:ident)*) => {$(
        #[test]
        fn $name() {
            let mut world = World::<$space>::new();
            assert!(world.insert_many([]).is_empty());
            let places = [0.0, 5.0, 10.0, 15.0];
            let keys = world.insert_many((10..).zip(places).map(|(number, x)| $space::unit_at(x).user_data(number)));
            let numbers = keys.iter().map(|&key| world.get(key).unwrap().get_user_data());
            assert_eq!(numbers.collect::<Vec<_>>(), [10, 11, 12, 13], "keys come in the order of bodies");
            world.update();
            let (stale, null) = (keys[1], <$space as asunder::Space>::Key::null());
            world.remove(stale);
            let tenant = world.insert_many([$space::unit_at(20.0).user_data(14)])[0];
            assert_eq!(slot_of(tenant), slot_of(stale), "the story needs a reused slot");
            let at = $space::pose_at;
            for stale in [stale, null] {
                // First, in the middle and last; and one body twice, where the later pose counts.
                let fresh = [(keys[0], at(40.0)), (keys[2], at(1.0)), (keys[3], at(60.0)), (keys[2], at(40.5))];
                for place in [0, 2, 4] {
                    for key in [keys[0], keys[2], keys[3]] {
                        world.set_pose(key, at(-70.0)).unwrap();
                    }
                    let mut poses = fresh.to_vec();
                    poses.insert(place, (stale, at(7.0)));
                    assert_eq!(world.set_poses(poses), Err(asunder::StaleKey), "at {place}");
                    let found = [keys[0], keys[2], keys[3], tenant].map(|key| *world.get(key).unwrap().pose());
                    assert_eq!(found, [40.0, 40.5, 60.0, 20.0].map(at), "at {place}");
                }
            }
            world.update();
            assert_eq!($space::events(&world), [began(keys[0], keys[2], 10, 12)]);
            assert_eq!(world.set_poses([(keys[3], at(20.5)), (keys[0], at(0.0))]), Ok(()));
            assert_eq!(world.set_poses([]), Ok(()));
            world.update();
            let expected = [ended(keys[0], keys[2], 10, 12), began(tenant, keys[3], 14, 13)];
            assert_eq!($space::events(&world), expected);
        }
    )*};
}

many_at_once! {
    a_stale_key_among_many_keeps_none_from_moving_in_space Volume
    a_stale_key_among_many_keeps_none_from_moving_in_the_plane Plane
}

#[test]
fn margins_that_are_no_margins_are_refused() {
    let (unit2, unit3) = (Plane::unit_at(0.0), Volume::unit_at(0.0));
    for value in [-0.5, f32::NEG_INFINITY, f32::INFINITY, 1.1e6] {
        assert_eq!(Collider2::margin(unit2.clone(), value).unwrap_err(), MarginError { value });
        assert_eq!(Collider3::margin(unit3.clone(), value).unwrap_err(), MarginError { value });
    }
    assert!(unit2.clone().margin(f32::NAN).unwrap_err().value.is_nan());
    for value in [0.0, 1e-6, 1e6] {
        assert_eq!(unit2.clone().margin(value).unwrap().get_margin(), value);
    }
}

/// Both worlds live in one program, and their keys do not mix: a claim about types, checked by compiling.
#[test]
fn both_worlds_in_one_program() {
    let mut flat = World2::new();
    let (mut deep, keys) = row::<Volume>(&[0.0, 0.5]);
    let square = Rect::from_half_extents(Vec2::ONE).unwrap();
    let a = flat.insert(Collider2::new(square));
    let b = flat.insert(Collider2::new(square));
    flat.update();
    deep.update();
    assert!(flat.is_touching(a, b) && deep.is_touching(keys[0], keys[1]));
}
