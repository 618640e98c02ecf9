//! Works through the candidate pairs, chunk by chunk.
//!
//! ```text
//! walk the pairs of a chunk beside its candidates of last update:                           (choose)
//!   neither body moved: the pair is carried over, with its hint, contact and manifolds
//!   they were apart, and have not moved far enough since to meet: it is carried over too
//! for the other pairs:                                                                      (answer)
//!   the bodies hardly drifted since the manifold was made: it is moved along
//!   else: the narrow phase, with the pair's hint
//! write candidates and contacts of all pairs, in order                                      (settle)
//! ```
//! A chunk's result is a function of its pairs and of last update's lists.

use super::settle::{Bodies, Settled};
use crate::collider::Collider;
use crate::contact::{Candidate, ContactNumber, Place, Record};
use crate::motion::{Motions, approach};
use crate::odometer::Odometer;
use crate::records::{Candidates, Records};
use crate::slab::{NOWHERE, Slab};
use crate::space::Space;
use asunder_broad::PairId;
use asunder_narrow::{ArrayVec, Batch, Hint};
use slotmap::{Key, SlotMap};
use std::sync::Mutex;

/// Jobs handed to the narrow phase at once: enough to fill wide kernels, few enough to stay on the stack.
const JOBS: usize = 64;

/// The manifolds that stand in a place.
#[inline]
pub(crate) fn manifolds_at<'a, M>(place: &Place, chunks: &'a [Batch<M>]) -> &'a [M] {
    let range = place.start as usize..place.end as usize;
    chunks.get(place.chunk as usize).and_then(|answered| answered.manifolds.get(range)).unwrap_or_default()
}

/// A chunk of pairs, by its number, and where its results go.
pub(super) struct Chunk<'c, S: Space> {
    pub(super) number: usize,
    pub(super) candidates: &'c mut Vec<Candidate<S::Key>>,
    pub(super) records: &'c mut Vec<Record<S::Key>>,
    pub(super) answered: &'c mut Batch<S::Manifold>,
    pub(super) settled: &'c mut Settled<S>,
}

/// The data that all chunks need, shared by all threads.
pub(super) struct CollideStage<'a, S: Space> {
    pub(super) bodies: &'a SlotMap<S::Key, Collider<S>>,
    pub(super) keys: &'a [S::Key],
    pub(super) is_moved: &'a [bool],
    pub(super) reshaped: &'a [u32],
    pub(super) odometers: &'a [Odometer],
    pub(super) motions: &'a Motions<S>,
    /// All pairs; where those of each chunk end, and the least that each may hold.
    pub(super) pairs: &'a [PairId],
    pub(super) chunk_ends: &'a [usize],
    pub(super) firsts: &'a [PairId],
    /// Whether chunks may be skipped in the next update.
    pub(super) do_most_rest: bool,
    /// Last update's lists, in chunks of their own.
    pub(super) last_candidates: &'a Candidates<S::Key>,
    pub(super) last_records: &'a Records<S::Key>,
    pub(super) last_answered: &'a [Batch<S::Manifold>],
    /// Memory of persistent manifolds that are no longer kept.
    pub(super) spare: Mutex<&'a mut S::Spare>,
    pub(super) persistent: &'a Slab<S::Persistent>,
}

/// How a pair is processed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Way {
    /// Nothing can have changed: carried over.
    Carried,
    /// Not decided yet. Stays so only where a body does not exist, as in no pair that the sweep finds: no contact.
    Open,
    /// Its manifolds were moved along: `count` of them, from `at` on. With the bodies' user data, as they have just
    /// been read.
    Moved { at: u32, count: u32, overlapping: bool, user_data: (u64, u64) },
    /// Computed by the narrow phase.
    Computed,
}

/// Last update's candidates in pair order, beside which this update's pairs are walked.
struct LastCandidates<'a, K, I> {
    next: &'a [Candidate<K>],
    /// What comes after those, slice by slice.
    later: I,
}

impl<'a, K: Key, I: Iterator<Item = &'a [Candidate<K>]>> LastCandidates<'a, K, I> {
    /// The candidate of a pair, if it was one last update. Those before it are no longer candidates.
    #[inline(always)]
    fn advance_to(&mut self, pair: PairId, mut lose: impl FnMut(&Candidate<K>)) -> Option<&'a Candidate<K>> {
        loop {
            match self.next.split_first() {
                Some((known, others)) if known.pair <= pair => {
                    self.next = others;
                    if known.pair == pair {
                        return Some(known);
                    }
                    lose(known);
                }
                Some(_) => return None,
                None => self.next = self.later.next()?,
            }
        }
    }

    /// Those after the last pair.
    fn rest(self) -> impl Iterator<Item = &'a Candidate<K>> {
        self.next.iter().chain(self.later.flatten())
    }
}

impl<S: Space> CollideStage<'_, S> {
    /// Works through a chunk.
    pub(super) fn collide_chunk(&self, mut chunk: Chunk<'_, S>) {
        let start = chunk.number.checked_sub(1).map_or(0, |before| self.chunk_ends[before]);
        let pairs = &self.pairs[start..self.chunk_ends[chunk.number]];
        chunk.answered.clear();
        chunk.records.clear();
        chunk.settled.begin_with(pairs, self.do_most_rest);
        self.choose(pairs, &mut chunk);
        self.answer(&mut chunk);
        self.settle(chunk);
    }

    /// Decides which pairs are carried over, and collects what is known of the others. Pairs are sorted, and so are
    /// last update's: one walk.
    fn choose(&self, pairs: &[PairId], chunk: &mut Chunk<'_, S>) {
        let Chunk { number, candidates, settled, .. } = chunk;
        // Last update's candidates before the first chunk's first pair belong to it, too.
        let first = if *number == 0 { None } else { self.firsts.get(*number).copied() };
        let end = self.firsts.get(*number + 1).copied();
        let mut last = LastCandidates { next: &[], later: self.last_candidates.between(first, end) };
        // Elements that are there already are overwritten.
        candidates.resize(pairs.len(), blank());
        for (&pair, candidate) in pairs.iter().zip(candidates.iter_mut()) {
            let known = last.advance_to(pair, |lost| settled.give_up(lost));
            let (now, way) = self.taken_over(pair, known, settled);
            *candidate = now;
            settled.ways.push(way);
        }
        last.rest().for_each(|lost| settled.give_up(lost));
    }

    /// A pair's candidate, with what last update's is still good for, and whether the pair is carried over.
    #[inline(always)]
    fn taken_over(
        &self,
        pair: PairId,
        known: Option<&Candidate<S::Key>>,
        settled: &mut Settled<S>,
    ) -> (Candidate<S::Key>, Way) {
        let new =
            Candidate { pair, keys: (self.keys[pair.a as usize], self.keys[pair.b as usize]), ..blank() };
        let Some(known) = known else { return (new, Way::Open) };
        // A reused slot is a new body.
        if known.keys != new.keys {
            settled.give_up(known);
            return (new, Way::Open);
        }
        if self.is_as_before(known) {
            return (*known, Way::Carried);
        }
        if of_another_shape(self.reshaped, pair) {
            settled.vacate(known.persistent);
            return (Candidate { contact: known.contact, ..new }, Way::Open);
        }
        (Candidate { until: f64::NEG_INFINITY, ..*known }, Way::Open)
    }

    /// Whether neither body moved, or they were apart and have not moved far enough since to meet.
    #[inline(always)]
    fn is_as_before(&self, known: &Candidate<S::Key>) -> bool {
        let (a, b) = (known.pair.a as usize, known.pair.b as usize);
        !self.is_moved[a] && !self.is_moved[b]
            || Odometer::are_before([self.odometers[a], self.odometers[b]], known.until)
    }

    /// Moves manifolds along, or calls the narrow phase.
    ///
    /// A loop of its own, and a short one: bodies and persistent manifolds lie all over memory, and the processor
    /// fetches the next ones while it waits for these. In one loop with the choice, moving along took 13 to 19 % more
    /// samples (2026-11-23). Tried: the margins of 32 pairs' bodies read ahead, in a loop of its own: boxes at rest 10
    /// % slower, mixed 2 % (AMD EPYC, Zen 4, 2026-11-25).
    fn answer(&self, chunk: &mut Chunk<'_, S>) {
        let Chunk { candidates, answered, settled, .. } = chunk;
        let Settled { ways, bullets, .. } = &mut **settled;
        let mut jobs: ArrayVec<S::Job<'_>, JOBS> = ArrayVec::new_const();
        for (way, candidate) in ways.iter_mut().zip(candidates.iter()) {
            let Way::Open = way else { continue };
            let Candidate { pair, keys, hint, persistent, .. } = *candidate;
            let Some((a, b)) = self.bodies.get(keys.0).zip(self.bodies.get(keys.1)) else { continue };
            // A body with a motion counts as changed, so none of its pairs is carried over: all of them get here.
            if (a.bullet || b.bullet) && self.is_going(pair) {
                let orders = [(a.bullet, keys), (b.bullet, (keys.1, keys.0))];
                bullets.extend(orders.into_iter().filter_map(|(is_bullet, keys)| is_bullet.then_some(keys)));
            }
            let ahead = self.approach(pair, (a, b));
            let margin = a.margin + b.margin + ahead;
            let kept = self.persistent.get(persistent);
            let to = &mut answered.manifolds;
            let at = to.len() as u32;
            if let Some(overlapping) = kept.and_then(|kept| S::carry_on(kept, [a, b], margin, to)) {
                let user_data = (a.user_data, b.user_data);
                *way = Way::Moved { at, count: to.len() as u32 - at, overlapping, user_data };
                continue;
            }
            *way = Way::Computed;
            jobs.push(S::job([a, b], [margin, ahead], hint));
            if jobs.is_full() {
                S::collide(&jobs, answered);
                jobs.clear();
            }
        }
        S::collide(&jobs, answered);
    }

    /// By how much the bodies' motions may bring them nearer. Neither sensors nor bodies of which only impacts are wanted
    /// have speculative contacts.
    #[inline]
    fn approach(&self, pair: PairId, (a, b): Bodies<'_, S>) -> f32 {
        if self.motions.is_empty() || a.sensor || b.sensor || a.impacts_only || b.impacts_only {
            return 0.0;
        }
        approach([a, b], [self.motions.of(pair.a), self.motions.of(pair.b)])
    }
}

/// A placeholder that is overwritten.
fn blank<K: Key>() -> Candidate<K> {
    let (pair, keys) = (PairId { a: 0, b: 0 }, (K::null(), K::null()));
    let (persistent, contact) = (NOWHERE, ContactNumber::NONE);
    Candidate { pair, keys, hint: Hint::NONE, persistent, contact, until: f64::NEG_INFINITY }
}

/// Whether the kept results of a pair are for another shape than a body has now. Checked for every pair; mostly there
/// is no such body, and then no call.
#[inline(always)]
fn of_another_shape(reshaped: &[u32], pair: PairId) -> bool {
    !reshaped.is_empty() && is_either_among(reshaped, pair)
}

#[cold]
#[inline(never)]
fn is_either_among(slots: &[u32], pair: PairId) -> bool {
    slots.binary_search(&pair.a).is_ok() || slots.binary_search(&pair.b).is_ok()
}
