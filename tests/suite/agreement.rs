//! Every answer agrees with `overlaps`, which is exact: separations, distances, contact points, records, events.
//!
//! Most checks run where numbers are of no use: on pairs for which the first tier's sign is wrong, and on bodies that
//! pass through touching one ulp at a time.

mod sides;
mod walks;

use asunder::{Collider, Event, Plane, Volume, World};
use sides::{Side, pair};

/// Number of pairs of each hard family, spread over all levels.
const EACH: usize = 96;

/// Pairs for which the first tier alone is wrong or undecided: `guess` differs, or the reported number is zero.
fn hardest<S: Side>() -> (Vec<[Collider<S>; 2]>, usize) {
    let (mut found, mut misled) = (Vec::new(), 0);
    for bodies in S::hard_pairs(EACH, 90) {
        let facts = S::facts(&bodies);
        if facts.guess != facts.overlaps {
            misled += 1;
        }
        if facts.guess != facts.overlaps || facts.separation == 0.0 {
            found.push(bodies);
        }
    }
    (found, misled)
}

/// Checks a pair by itself. Returns whether it overlaps.
fn check_pair<S: Side>(bodies: &[Collider<S>; 2]) -> bool {
    let (facts, exact) = (S::facts(bodies), S::exactly_overlap(bodies));
    assert_eq!(facts.overlaps, exact, "exact arithmetic disagrees: {bodies:?}");
    assert_eq!(facts.separation <= 0.0, exact, "{} of {bodies:?}", facts.separation);
    assert_eq!(facts.within_nothing.is_some_and(|s| s <= 0.0), exact, "a limit of zero: {bodies:?}");
    assert_eq!(facts.distance.is_none(), exact, "{bodies:?}");
    assert!(facts.distance.is_none_or(|distance| distance > 0.0), "{bodies:?}");
    if !S::are_endless(bodies) {
        assert_eq!(facts.points > 0, exact, "{} points: {bodies:?}", facts.points);
    }
    exact
}

fn every_answer_goes_with_overlaps<S: Side>() {
    let cases = S::hard_pairs(EACH, 91);
    let overlapping = cases.iter().filter(|bodies| check_pair::<S>(bodies)).count();
    assert!(
        (cases.len() / 5..4 * cases.len() / 5).contains(&overlapping),
        "{overlapping} of {}",
        cases.len()
    );
}

#[test]
fn every_answer_about_solids_goes_with_overlaps() {
    every_answer_goes_with_overlaps::<Volume>();
}

#[test]
fn every_answer_in_the_plane_goes_with_overlaps() {
    every_answer_goes_with_overlaps::<Plane>();
}

/// A world without margins on the hardest pairs: apart, in place, and apart again.
fn a_world_says_what_is_exact<S: Side>(least: usize) {
    let (cases, misled) = hardest::<S>();
    eprintln!("{misled} pairs with a wrong guess, {} with a sign that no number shows", cases.len());
    assert!(misled >= least, "only {misled} pairs show what rounding does");
    let mut overlapping = 0;
    for bodies in &cases {
        let exact = check_pair::<S>(bodies);
        overlapping += usize::from(exact);
        let mut world = World::<S>::new();
        let keys = bodies.clone().map(|body| S::insert(&mut world, body));
        for (visible, frame) in [true, false, true, true].into_iter().zip(0..) {
            let away = S::stepped(&S::pose_of(&bodies[1]), if visible { 0.0 } else { 1e7 });
            assert!(S::set_pose(&mut world, keys[1], away));
            let was = S::is_touching(&world, keys[0], keys[1]);
            world.update();
            let now = [bodies[0].clone(), S::moved(bodies[1].clone(), away)];
            let now = if visible { exact } else { S::exactly_overlap(&now) };
            check_frame::<S>(&world, keys, [was, now], &format!("frame {frame} of {bodies:?}"));
        }
    }
    assert!(overlapping >= 12 && cases.len() - overlapping >= 12, "{overlapping} of {} overlap", cases.len());
}

/// Checks a world of two bodies without margins after an update.
fn check_frame<S: Side>(world: &World<S>, keys: [S::Key; 2], [was, is]: [bool; 2], place: &str) {
    let [a, b] = keys;
    assert_eq!(S::is_touching(world, a, b), is, "{place}");
    assert_eq!(S::touching(world, a), if is { vec![b] } else { vec![] }, "{place}");
    assert_eq!(S::contacts_of(world, b).len(), usize::from(is), "{place}");
    let contact = S::contact(world, a, b);
    assert_eq!(
        contact.as_ref().map(|contact| (contact.overlapping, contact.is_new)),
        is.then_some((true, !was)),
        "{place}"
    );
    let bodies = keys.map(|key| S::get(world, key).expect("both are there").clone());
    if is && !S::are_endless(&bodies) {
        assert!(contact.is_some_and(|contact| !contact.manifolds.is_empty()), "{place}");
    }
    let expected = match [was, is] {
        [false, true] => vec![Event::Began { a, b, user_data_a: 0, user_data_b: 0, sensor: false }],
        [true, false] => vec![Event::Ended { a, b, user_data_a: 0, user_data_b: 0, sensor: false }],
        _ => vec![],
    };
    assert_eq!(S::events(world), expected, "{place}");
}

#[test]
fn a_world_of_solids_says_what_is_exact() {
    a_world_says_what_is_exact::<Volume>(48);
}

#[test]
fn a_flat_world_says_what_is_exact() {
    a_world_says_what_is_exact::<Plane>(24);
}

/// Overlap is decided from an f64, which cannot be fine enough for every pair: some tier must detect a wrong sign.
#[test]
fn a_wrong_guess_is_never_the_answer() {
    let mut tiers = [0; 3];
    for bodies in hardest::<Volume>().0 {
        let verdict = pair(&bodies).verdict();
        assert_eq!(verdict.overlapping, pair(&bodies).overlaps(), "{bodies:?}");
        tiers[verdict.tier as usize] += 1;
        if pair(&bodies).guess() != verdict.overlapping {
            assert!(verdict.tier > asunder::Tier::Bound, "a bound was broken: {bodies:?}");
        }
    }
    assert!(tiers[2] >= 24, "exact arithmetic was asked {tiers:?} times");
}
