//! Stage 3: candidate pairs to contacts.
//!
//! ```text
//! walk the pairs beside last update's candidates:
//!   neither body moved: the pair is carried on, with its hint, contact and manifolds
//!   they were apart, and have not gone as far since as they would have to: it is carried on too
//!   else: it is asked about, with the hint and the persistent manifold that it has
//! ask about batches of pairs, in parallel: see `ask`
//! walk the pairs once more, and put what was carried and what was answered together
//! ```

use super::ask::{Asked, Outcome, Outcomes, ask, manifolds_at};
use crate::collider::Collider;
use crate::contact::{Candidate, Place, Record};
use crate::odometer::Odometer;
use crate::slab::{NOWHERE, Slab};
use crate::space::Space;
use crate::world::{ASKED, Scratch, World};
use asunder_broad::PairId;
use asunder_narrow::{Answer, Hint};

/// Brings candidates and contacts up to date.
pub(super) fn collide<S: Space>(world: &mut World<S>) {
    if world.stats.overflow {
        return;
    }
    let World { candidates, records, askings, carried, scratch, .. } = world;
    core::mem::swap(candidates, &mut scratch.last_candidates);
    core::mem::swap(records, &mut scratch.last_records);
    core::mem::swap(askings, &mut scratch.last_askings);
    core::mem::swap(carried, &mut scratch.last_carried);
    world.reshaped.sort_unstable();
    choose(world);
    ask(world);
    gather(world);
    for slot in world.moved.drain(..) {
        world.is_moved[slot as usize] = false;
        world.odometers[slot as usize].close();
    }
}

/// Which pairs are carried on and which are asked about. Pairs are sorted, and so are last update's: one walk.
fn choose<S: Space>(world: &mut World<S>) {
    let World { keys, is_moved, reshaped, odometers, persistent, scratch, .. } = world;
    let Scratch { pairs, carried, asked, last_candidates, .. } = scratch;
    carried.clear();
    asked.clear();
    let mut vacate = |known: &Candidate<S::Key>| persistent.vacate(known.persistent);
    let mut last = last_candidates.iter().enumerate().peekable();
    for &pair in &*pairs {
        while let Some((_, gone)) = last.next_if(|(_, known)| known.pair < pair) {
            vacate(gone);
        }
        let (a, b) = (pair.a as usize, pair.b as usize);
        let known = last.next_if(|(_, known)| known.pair == pair);
        // A reused slot is a new body.
        let is_same = |known: &Candidate<S::Key>| known.keys == (keys[a], keys[b]);
        let Some((index, known)) = known.filter(|(_, known)| is_same(known)) else {
            known.inspect(|(_, gone)| vacate(gone));
            carried.push(ASKED);
            asked.push(Asked { pair, hint: Hint::NONE, persistent: NOWHERE });
            continue;
        };
        let are_apart = || Odometer::are_before([odometers[a], odometers[b]], known.until);
        if (!is_moved[a] && !is_moved[b]) || are_apart() {
            carried.push(index as u32);
        } else if of_another_shape(reshaped, pair) {
            vacate(known);
            carried.push(ASKED);
            asked.push(Asked { pair, hint: Hint::NONE, persistent: NOWHERE });
        } else {
            carried.push(ASKED);
            asked.push(Asked { pair, hint: known.hint, persistent: known.persistent });
        }
    }
    last.for_each(|(_, gone)| vacate(gone));
}

/// Whether what was learnt of a pair is about another shape than the one a body has now.
pub(super) fn of_another_shape(reshaped: &[u32], pair: PairId) -> bool {
    !reshaped.is_empty()
        && (reshaped.binary_search(&pair.a).is_ok() || reshaped.binary_search(&pair.b).is_ok())
}

/// Puts candidates and contacts of this update together, in order of the pairs.
fn gather<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, candidates, records, askings, carried, persistent, .. } = world;
    let World { motions, odometers, scratch, .. } = world;
    let Scratch { pairs, asked, last_candidates, last_records, last_askings, last_carried, .. } = scratch;
    candidates.clear();
    records.clear();
    carried.clear();
    let mut outcomes = Outcomes::new(askings);
    let (mut asked, mut last) = (asked.iter(), 0);
    for (&pair, &known) in pairs.iter().zip(&scratch.carried) {
        if let Some(known) = last_candidates.get(known as usize) {
            candidates.push(known.clone());
            while last_records.get(last).is_some_and(|record| record.pair < pair) {
                last += 1;
            }
            if let Some(record) = last_records.get(last).filter(|record| record.pair == pair) {
                let start = carried.len();
                carried.extend_from_slice(manifolds_at(&record.manifolds, last_askings, last_carried));
                let manifolds = Place::carried(start, carried);
                let begun = record.overlapping;
                records.push(Record { manifolds, begun, is_new: false, ..record.clone() });
            }
            continue;
        }
        let Some((asked, (outcome, place))) = asked.next().zip(outcomes.next()) else { break };
        let both = [pair.a, pair.b].map(|slot| odometers[slot as usize]);
        let keys = (keys[pair.a as usize], keys[pair.b as usize]);
        let found = bodies.get(keys.0).zip(bodies.get(keys.1));
        // What motions may bring is looked for within other margins in every frame.
        let is_going = !motions.is_empty() && [pair.a, pair.b].iter().any(|&slot| motions.of(slot).is_some());
        let lasting = found.filter(|_| !is_going);
        let (candidate, overlapping) =
            candidate_of::<S>((asked, keys), &outcome, (both, lasting), persistent);
        candidates.push(candidate);
        if let Some((overlapping, (a, b))) = overlapping.zip(found) {
            // Only that is beyond the margins: else no manifold need be read.
            let is_sought = !overlapping && lasting.is_none();
            let found = manifolds_at(&place, askings, carried);
            let is_beyond = is_sought && S::least_separation(found) > a.margin + b.margin;
            let speculative = is_beyond && !found.is_empty();
            records.push(record_of::<S>((pair, keys), [a, b], (overlapping, speculative), place));
        }
    }
}

/// Two bodies.
type Both<'a, S> = (&'a Collider<S>, &'a Collider<S>);

/// What is kept of a pair that was asked about, by how far its bodies went; and whether they overlap, if they are within
/// the margin. Manifolds of bodies that last are kept to be moved along.
fn candidate_of<S: Space>(
    (asked, keys): (&Asked, (S::Key, S::Key)),
    outcome: &Outcome<'_, S>,
    (both, lasting): ([Odometer; 2], Option<Both<'_, S>>),
    persistent: &mut Slab<S::Persistent>,
) -> (Candidate<S::Key>, Option<bool>) {
    let Asked { pair, hint, persistent: place } = *asked;
    let (hint, place, until, overlapping) = match *outcome {
        Outcome::Moved => (hint, place, f64::NEG_INFINITY, persistent.get(place).map(S::overlapping)),
        Outcome::Answered(&Answer::Apart { hint, beyond }, _) => {
            (hint, persistent.put(place, None), Odometer::until(both, beyond), None)
        }
        Outcome::Answered(answer @ &Answer::Contact { hint, overlapping, .. }, manifolds) => {
            let step = both[0].step() + both[1].step();
            let kept = lasting.and_then(|(a, b)| {
                S::persistent(&S::job(a, b, a.margin + b.margin, hint), answer, manifolds, step)
            });
            (hint, persistent.put(place, kept), f64::NEG_INFINITY, Some(overlapping))
        }
    };
    (Candidate { pair, keys, hint, persistent: place, until }, overlapping)
}

/// A contact, as the narrow phase alone knows it, by whether they overlap, and whether they are beyond the margins; its
/// past is merged in later.
fn record_of<S: Space>(
    (pair, keys): (PairId, (S::Key, S::Key)),
    [a, b]: [&Collider<S>; 2],
    (overlapping, speculative): (bool, bool),
    manifolds: Place,
) -> Record<S::Key> {
    Record {
        pair,
        keys,
        user_data: (a.user_data, b.user_data),
        sensor: a.sensor || b.sensor,
        overlapping,
        begun: overlapping,
        is_new: false,
        speculative,
        manifolds,
    }
}
