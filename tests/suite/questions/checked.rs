//! Answers compared with what the narrow phase reports for each body.

use super::asked::{Answers, Asked, Judged, Near, Questioned};
use super::sieve::{Allowed, Sieve};
use asunder::{Collider, World};
use asunder_tests::engine::slot_of;

/// Bodies that pass a filter, in order of their slots.
fn passing<S: Questioned>(world: &World<S>, allowed: &Allowed<S>) -> Vec<(S::Key, Collider<S>)> {
    S::bodies(world).into_iter().filter(|(key, body)| allowed(*key, body)).collect()
}

/// Asserts that the world agrees with the narrow phase about every body.
pub(super) fn check<S: Questioned>(world: &World<S>, asked: &Asked<S>, sieve: &Sieve<S>, found: &Answers<S>) {
    let bodies = passing(world, &sieve.allowed);
    let mut touches = Vec::new();
    for (_, body) in bodies.iter().filter(|(_, body)| !body.is_sensor()) {
        S::touches_of(asked, body, &mut touches);
    }
    let judge = |(key, body): (S::Key, Collider<S>)| {
        let judged = S::judge(asked, &body, &touches);
        (key, body, judged)
    };
    let passing: Vec<(S::Key, Collider<S>, Judged)> = bodies.into_iter().map(judge).collect();
    check_casts(asked, &passing, found);
    check_onwards(asked, &passing, found);
    let keys = |is_wanted: fn(&Judged) -> bool| -> Vec<S::Key> {
        passing.iter().filter(|(_, _, judged)| is_wanted(judged)).map(|(key, _, _)| *key).collect()
    };
    assert_eq!(found.boxes, keys(|judged| judged.boxes), "boxes that overlap {asked:?}");
    assert_eq!(found.holding, keys(|judged| judged.holding), "bodies that hold the point of {asked:?}");
    assert_eq!(found.over, keys(|judged| judged.over), "bodies that overlap {asked:?}");
    let met = passing.iter().flat_map(|(key, body, _)| {
        S::manifolds_with(asked, body).into_iter().map(|manifold| (*key, manifold))
    });
    assert_eq!(found.manifolds, met.collect::<Vec<_>>(), "how bodies are met by {asked:?}");
    let to_point: Vec<_> = passing.iter().map(|(key, _, judged)| (*key, judged.to_point)).collect();
    let to_shape: Vec<_> = passing.iter().map(|(key, _, judged)| (*key, judged.to_shape)).collect();
    check_near::<S>(asked, &to_point, &found.near_point);
    check_near::<S>(asked, &to_shape, &found.near_shape);
    let firsts = [found.near_point.first(), found.near_shape.first()];
    assert_eq!(found.closest.each_ref().map(Option::as_ref), firsts, "the closest is the first of all");
    for (near, point) in found.near_point.iter().map(|near| (near, asked.point)) {
        assert_eq!(near.from, point);
        assert!(!near.overlapping || near.point == point, "a point in a body is the closest of it");
    }
}

/// Asserts that rays and moving shapes hit the bodies that the narrow phase says they do.
fn check_casts<S: Questioned>(
    asked: &Asked<S>,
    judged: &[(S::Key, Collider<S>, Judged)],
    found: &Answers<S>,
) -> usize {
    let ranks: Vec<_> = found.rays.iter().map(|hit| (hit.distance, slot_of(hit.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by slot: {ranks:?}");
    let ranks: Vec<_> = found.casts.iter().map(|hit| (hit.fraction, slot_of(hit.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by fraction, then by slot: {ranks:?}");
    assert_eq!(
        (found.first_ray, found.first_cast),
        (found.rays.first().copied(), found.casts.first().copied())
    );
    let (mut grazes, mut known) = (0, 0);
    for (key, body, judged) in judged {
        match (found.rays.iter().find(|hit| hit.body == *key), judged.along_ray) {
            (None, None) => {}
            (None, Some((distance, error, inside))) => {
                grazes += usize::from(judged.is_beside[0]);
                let is_late = distance + error > asked.limit;
                assert!(!inside && (judged.is_beside[0] || is_late), "lost {key:?} at {distance}: {asked:?}");
            }
            (Some(hit), None) => panic!("{hit:?}, of which the narrow phase knows nothing: {asked:?}"),
            (Some(hit), Some((distance, error, inside))) => {
                known += 1;
                assert_eq!((hit.inside, hit.inside && hit.distance > 0.0), (inside, false));
                let is_near = hit.distance >= distance && hit.distance <= distance + error;
                assert!(
                    is_near && hit.distance <= asked.limit,
                    "{hit:?} for {distance} +- {error}: {asked:?}"
                );
            }
        }
        match (found.casts.iter().find(|hit| hit.body == *key), judged.along) {
            (None, None) => {}
            (None, Some((fraction, overlapping))) => {
                grazes += 1;
                assert!(!overlapping && judged.is_beside[1], "lost {key:?} at {fraction}: {asked:?}");
            }
            (Some(hit), None) => panic!("{hit:?}, of which the narrow phase knows nothing: {asked:?}"),
            (Some(hit), Some((fraction, overlapping))) => {
                known += 1;
                assert_eq!((hit.overlapping, hit.overlapping && hit.fraction > 0.0), (overlapping, false));
                assert!(hit.fraction >= fraction && hit.fraction <= 1.0, "{hit:?} for {fraction}: {asked:?}");
                if hit.fraction > fraction {
                    S::check_free(asked, hit.fraction, body);
                }
            }
        }
    }
    assert!(grazes == 0 || grazes * 100 < known, "{grazes} grazes of {known}: too many to be rounding");
    known
}

/// Asserts that a moving shape runs into the first body by the narrow phase, apart from those that it touches.
fn check_onwards<S: Questioned>(
    asked: &Asked<S>,
    judged: &[(S::Key, Collider<S>, Judged)],
    found: &Answers<S>,
) {
    // The AABB test may give a later time for a hit than a cast does, by no more than the cast's error.
    let is_same = |told: f64, truth: f64| told >= truth && told <= truth + 1e-5;
    let first = found.onwards.map_or(f64::INFINITY, |hit| hit.fraction);
    for (key, _, judged) in judged.iter().filter(|(.., judged)| !judged.is_beside[1]) {
        let is_first = judged.onwards.is_none_or(|fraction| first <= fraction || is_same(first, fraction));
        assert!(is_first, "{key:?} is met at {:?}: {:?} {asked:?}", judged.onwards, found.onwards);
    }
    if let Some(hit) = found.onwards {
        let truth = judged.iter().find(|(key, ..)| *key == hit.body).and_then(|(.., judged)| judged.onwards);
        assert!(truth.is_some_and(|truth| is_same(hit.fraction, truth)), "{hit:?} for {truth:?}: {asked:?}");
    }
}

/// A body, and its distance with the oracle's error, if it is apart.
type Truth<S> = (<S as asunder::Space>::Key, Option<(f32, f32)>);

fn check_near<S: Questioned>(asked: &Asked<S>, judged: &[Truth<S>], found: &[Near<S>]) {
    let ranks: Vec<_> = found.iter().map(|near| (near.distance, slot_of(near.body))).collect();
    assert!(ranks.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by slot: {ranks:?}");
    let limit = f64::from(asked.within.max(0.0));
    for &(key, truth) in judged {
        let near = found.iter().find(|near| near.body == key);
        let (distance, error) =
            truth.map_or((0.0, 0.0), |(distance, error)| (distance.into(), f64::from(error)));
        let Some(near) = near else {
            assert!(distance + error > limit, "lost {key:?}, {distance} +- {error} m away, of {asked:?}");
            continue;
        };
        assert_eq!(near.overlapping, truth.is_none(), "{near:?} of {asked:?}");
        assert_eq!(f64::from(near.error), error);
        assert!(
            near.distance <= limit && near.distance >= distance && near.distance <= distance + error,
            "{near:?}"
        );
        let (apart, most) = S::apart(near.from, near.point);
        // Anchors are f32, and some metres long, those of half-spaces tens of metres; points are rounded to f64.
        let lost = 1e-6 * (near.distance + 20.0) + 4.0 * f64::EPSILON * most;
        assert!(
            near.overlapping || (apart - near.distance).abs() <= error + lost,
            "{apart}: {near:?} of {asked:?}"
        );
    }
    assert!(
        found.iter().all(|near| judged.iter().any(|(key, _)| *key == near.body)),
        "somebody who may not be found"
    );
}
