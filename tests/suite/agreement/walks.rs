//! Bodies that pass through touching, one ulp at a time.

use super::check_frame;
use super::sides::{Side, ulps_up};
use asunder::{Collider, Event, Plane, Volume, World};

/// B's position in ulps from where the walk starts: out and in again, never by more than two at once.
const WALK: [i64; 15] = [2, 1, 0, -1, 0, 1, 0, 0, 1, -1, -2, -1, 1, 2, 3];

/// A square or cube of side 1 beside another: one ulp decides, and where it does is known without any arithmetic.
fn a_kiss_lasts_for_the_frames_it_lasts<S: Side>() {
    for origin in [0.0, -3.0, 1e3, 1e6, -1e8, 9e8] {
        let mut world = World::<S>::new();
        let keys = [origin, origin + 7.0].map(|x| S::insert(&mut world, S::unit_at(x)));
        let mut was = false;
        for ulps in WALK {
            // One ulp is a step outwards, also below zero: `next_up` always increases the coordinate.
            assert!(S::set_pose(&mut world, keys[1], S::pose_at(ulps_up(origin + 1.0, ulps))));
            world.update();
            let is = ulps <= 0;
            check_frame::<S>(&world, keys, [was, is], &format!("{ulps} ulps from touching at {origin}"));
            was = is;
        }
    }
}

#[test]
fn a_kiss_of_cubes_lasts_for_the_frames_it_lasts() {
    a_kiss_lasts_for_the_frames_it_lasts::<Volume>();
}

#[test]
fn a_kiss_of_squares_lasts_for_the_frames_it_lasts() {
    a_kiss_lasts_for_the_frames_it_lasts::<Plane>();
}

/// Hard pairs that touch up to rounding.
fn touching_pairs<S: Side>(count: usize, seed: u64) -> Vec<[Collider<S>; 2]> {
    let near = |bodies: &[Collider<S>; 2]| {
        let facts = S::facts(bodies);
        !S::are_endless(bodies) && facts.separation.abs() <= facts.error
    };
    S::hard_pairs(count, seed).into_iter().filter(near).collect()
}

fn a_walk_through_touching_is_told_frame_by_frame<S: Side>() {
    let cases = touching_pairs::<S>(32, 92);
    let (mut frames, mut changes) = (0, 0);
    for bodies in &cases {
        let mut world = World::<S>::new();
        let keys = bodies.clone().map(|body| S::insert(&mut world, body));
        let mut was = false;
        for ulps in WALK {
            let pose = S::ulps_along(bodies, ulps);
            assert!(S::set_pose(&mut world, keys[1], pose));
            world.update();
            let is = S::exactly_overlap(&[bodies[0].clone(), S::moved(bodies[1].clone(), pose)]);
            check_frame::<S>(&world, keys, [was, is], &format!("{ulps} ulps: {bodies:?}"));
            (frames, changes) = (frames + 1, changes + usize::from(was != is));
            was = is;
        }
    }
    eprintln!("{} walks, {frames} frames, {changes} of them change", cases.len());
    assert!(cases.len() >= 100 && changes >= 400, "{} walks, {changes} changes", cases.len());
}

#[test]
fn a_walk_of_solids_through_touching_is_told_frame_by_frame() {
    a_walk_through_touching_is_told_frame_by_frame::<Volume>();
}

#[test]
fn a_walk_through_touching_in_the_plane_is_told_frame_by_frame() {
    a_walk_through_touching_is_told_frame_by_frame::<Plane>();
}

/// B's position in a frame of the next test.
#[derive(Clone, Copy, Debug)]
enum Stop {
    /// A gap along the normal, as a share of the reach.
    Gap(f64),
    /// A number of ulps from where it was built.
    Ulps(i64),
}

const STOPS: [Stop; 13] = [
    Stop::Gap(0.5),
    Stop::Gap(0.02),
    Stop::Ulps(2),
    Stop::Ulps(0),
    Stop::Ulps(-2),
    Stop::Ulps(2),
    Stop::Gap(0.02),
    Stop::Gap(0.5),
    Stop::Gap(0.02),
    Stop::Gap(0.5),
    Stop::Ulps(-2),
    Stop::Ulps(2),
    Stop::Gap(0.5),
];

/// With a margin of a tenth of the reach, a record is kept as long as the separation is within it. It begins with an
/// overlap, and ends only when the record does.
fn a_margin_keeps_the_record_and_not_the_beginning<S: Side>() {
    let (mut records, mut apart, mut begun_late) = (0, 0, 0);
    for bodies in touching_pairs::<S>(16, 93) {
        // On both bodies, and the two add up.
        let margin = (0.05 * S::reach(&bodies)) as f32;
        let mut world = World::<S>::new();
        let keys = bodies.clone().map(|body| S::insert(&mut world, body.margin(margin).unwrap()));
        let (mut was_kept, mut has_begun) = (false, false);
        for stop in STOPS {
            let pose = match stop {
                Stop::Gap(share) => S::along_normal(&bodies, share * S::reach(&bodies)),
                Stop::Ulps(ulps) => S::ulps_along(&bodies, ulps),
            };
            assert!(S::set_pose(&mut world, keys[1], pose));
            world.update();
            let now = [bodies[0].clone(), S::moved(bodies[1].clone(), pose)];
            let (facts, exact) = (S::facts(&now), S::exactly_overlap(&now));
            let contact = S::contact(&world, keys[0], keys[1]);
            let kept = contact.is_some();
            if f64::from(facts.separation) - f64::from(facts.error) > 2.0 * f64::from(margin) {
                assert!(!kept, "beyond the margin at {stop:?}: {bodies:?}");
            }
            if f64::from(facts.separation) + f64::from(facts.error) <= 2.0 * f64::from(margin) {
                assert!(kept, "within the margin at {stop:?}: {bodies:?}");
            }
            assert_eq!(
                contact.as_ref().is_some_and(|contact| contact.overlapping),
                exact,
                "{stop:?}: {bodies:?}"
            );
            let [a, b] = keys;
            let expected = if exact && !has_begun {
                vec![Event::Began { a, b, user_data_a: 0, user_data_b: 0, sensor: false }]
            } else if !kept && has_begun {
                vec![Event::Ended { a, b, user_data_a: 0, user_data_b: 0, sensor: false }]
            } else {
                vec![]
            };
            assert_eq!(S::events(&world), expected, "{stop:?}: {bodies:?}");
            begun_late += usize::from(exact && !has_begun && was_kept);
            has_begun = kept && (has_begun || exact);
            (records, apart) = (records + usize::from(kept), apart + usize::from(kept && !exact));
            was_kept = kept;
        }
    }
    eprintln!("{records} records, {apart} of them of bodies apart; {begun_late} began after their record");
    assert!(records >= 500 && apart >= 200 && begun_late >= 50, "{records}, {apart}, {begun_late}");
}

#[test]
fn a_margin_of_solids_keeps_the_record_and_not_the_beginning() {
    a_margin_keeps_the_record_and_not_the_beginning::<Volume>();
}

#[test]
fn a_margin_in_the_plane_keeps_the_record_and_not_the_beginning() {
    a_margin_keeps_the_record_and_not_the_beginning::<Plane>();
}
