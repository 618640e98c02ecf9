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
//! Most of a frame of bodies that rest is waiting for memory. What bought what, of heaps and pyramids of boxes (AMD EPYC,
//! Zen 4, 2026-11-22):
//!
//! 1. manifolds stay in the list of the batch that made them: 17 % of the time was copying, and 3 % is;
//! 2. bodies are read once, while a pair is asked about: what is told of them then stands beside the answer. A twentieth.
//!
//! Kernels here and below shun `map`, `zip` and `from_fn` on arrays: with `lto = "off"` they are calls, a third of the time
//! of such a frame and half of a sweep's; by default they are not, and nothing is gained.

use super::ask::{Asked, Moved, Outcome, Outcomes, ask, manifolds_at};
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
    let Scratch { pairs, asked, spare, .. } = scratch;
    let Scratch { last_candidates, last_records, last_askings, last_carried, .. } = scratch;
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
        let (Some(asked), Some((outcome, place))) = (asked.next(), outcomes.next()) else { break };
        let keys = (keys[pair.a as usize], keys[pair.b as usize]);
        // What motions may bring is looked for within other margins in every frame.
        let is_going = !motions.is_empty() && (motions.of(pair.a).is_some() || motions.of(pair.b).is_some());
        // Bodies lie all over memory: of what is apart, or moved along, nobody reads them again.
        let is_new = matches!(outcome, Outcome::Answered(Answer::Contact { .. }, _));
        let both = if is_new || is_going { bodies.get(keys.0).zip(bodies.get(keys.1)) } else { None };
        let ways = [odometers[pair.a as usize], odometers[pair.b as usize]];
        let lasting = both.filter(|_| !is_going);
        candidates.push(candidate_of::<S>((asked, keys), &outcome, (ways, lasting), (persistent, spare)));
        if let Some(met) = met_of(&outcome, both) {
            // Only that is beyond the margins: else no manifold need be read.
            let found = manifolds_at(&place, askings, carried);
            let is_beyond = |(a, b): Both<'_, S>| S::least_separation(found) > a.margin + b.margin;
            let is_sought = is_going && !met.overlapping && !found.is_empty();
            let speculative = is_sought && both.is_some_and(is_beyond);
            records.push(record_of((pair, keys), met, speculative, place));
        }
    }
}

/// Two bodies.
type Both<'a, S> = (&'a Collider<S>, &'a Collider<S>);

/// What is kept of a pair that was asked about, by how far its bodies went. Manifolds of bodies that last are kept to be
/// moved along.
fn candidate_of<S: Space>(
    (asked, keys): (&Asked, (S::Key, S::Key)),
    outcome: &Outcome<'_, S>,
    (ways, lasting): ([Odometer; 2], Option<Both<'_, S>>),
    (persistent, spare): (&mut Slab<S::Persistent>, &mut S::Spare),
) -> Candidate<S::Key> {
    let Asked { pair, hint, persistent: place } = *asked;
    let (hint, place, until) = match *outcome {
        Outcome::Moved(_) => (hint, place, f64::NEG_INFINITY),
        Outcome::Answered(&Answer::Apart { hint, beyond }, _) => {
            (hint, persistent.put(place, None).0, Odometer::until(ways, beyond))
        }
        Outcome::Answered(answer @ &Answer::Contact { hint, .. }, manifolds) => {
            let step = ways[0].step() + ways[1].step();
            let kept = lasting.and_then(|(a, b)| {
                let job = S::job(a, b, a.margin + b.margin, hint);
                S::persistent(&job, answer, manifolds, step, spare)
            });
            let (place, before) = persistent.put(place, kept);
            if let Some(before) = before {
                S::reclaim(spare, before);
            }
            (hint, place, f64::NEG_INFINITY)
        }
    };
    Candidate { pair, keys, hint, persistent: place, until }
}

/// Two bodies within their margins.
struct Met {
    overlapping: bool,
    sensor: bool,
    user_data: (u64, u64),
}

/// How a pair that was asked about met, if it did.
fn met_of<S: Space>(outcome: &Outcome<'_, S>, both: Option<Both<'_, S>>) -> Option<Met> {
    match *outcome {
        Outcome::Moved(Moved { overlapping, user_data, .. }) => {
            Some(Met { overlapping, sensor: false, user_data })
        }
        Outcome::Answered(Answer::Apart { .. }, _) => None,
        Outcome::Answered(&Answer::Contact { overlapping, .. }, _) => both.map(|(a, b)| Met {
            overlapping,
            sensor: a.sensor || b.sensor,
            user_data: (a.user_data, b.user_data),
        }),
    }
}

/// A contact, as the narrow phase alone knows it, and whether it is beyond the margins; its past is merged in later.
fn record_of<K>((pair, keys): (PairId, (K, K)), met: Met, speculative: bool, manifolds: Place) -> Record<K> {
    let Met { overlapping, sensor, user_data } = met;
    Record {
        pair,
        keys,
        user_data,
        sensor,
        overlapping,
        begun: overlapping,
        is_new: false,
        speculative,
        manifolds,
    }
}
