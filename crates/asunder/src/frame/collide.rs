//! Stage 3: candidate pairs to contacts.
//!
//! ```text
//! walk the pairs beside last update's candidates:
//!   neither body moved: the pair is carried on, with its hint, contact and manifolds
//!   else: it is asked about, with the hint it has
//! ask about batches of pairs, in parallel
//! walk the pairs once more, and put what was carried and what was answered together
//! ```

use crate::collider::Collider;
use crate::contact::{Candidate, Record};
use crate::motion::{Motions, approach};
use crate::space::Space;
use crate::world::{ASKED, Scratch, World};
use asunder_broad::PairId;
use asunder_narrow::{Answer, ArrayVec, Batch, Hint};
use core::ops::Range;
use slotmap::SlotMap;

/// Pairs in one batch. Fixed, so that where batches are cut does not depend on the threads.
const BATCH: usize = 256;

/// Jobs handed to the narrow phase at once: enough to fill wide kernels, few enough to stay on the stack.
const SLICE: usize = 64;

/// Brings candidates and contacts up to date.
pub(super) fn collide<S: Space>(world: &mut World<S>) {
    if world.stats.overflow {
        return;
    }
    let World { candidates, records, manifolds, scratch, .. } = world;
    core::mem::swap(candidates, &mut scratch.last_candidates);
    core::mem::swap(records, &mut scratch.last_records);
    core::mem::swap(manifolds, &mut scratch.last_manifolds);
    world.reshaped.sort_unstable();
    choose(world);
    ask(world);
    gather(world);
    for slot in world.moved.drain(..) {
        world.is_moved[slot as usize] = false;
    }
}

/// Which pairs are carried on and which are asked about. Pairs are sorted, and so are last update's: one walk.
fn choose<S: Space>(world: &mut World<S>) {
    let World { keys, is_moved, reshaped, scratch, .. } = world;
    let Scratch { pairs, carried, asked, last_candidates, .. } = scratch;
    carried.clear();
    asked.clear();
    let mut last = 0;
    for &pair in &*pairs {
        while last_candidates.get(last).is_some_and(|known| known.pair < pair) {
            last += 1;
        }
        let (a, b) = (pair.a as usize, pair.b as usize);
        // A reused slot is a new body.
        let known =
            last_candidates.get(last).filter(|known| known.pair == pair && known.keys == (keys[a], keys[b]));
        match known {
            Some(_) if !is_moved[a] && !is_moved[b] => carried.push(last as u32),
            known => {
                carried.push(ASKED);
                let known = known.filter(|_| !of_another_shape(reshaped, pair));
                asked.push((pair, known.map_or(Hint::NONE, |known| known.hint)));
            }
        }
    }
}

/// Whether what was learnt of a pair is about another shape than the one a body has now.
pub(super) fn of_another_shape(reshaped: &[u32], pair: PairId) -> bool {
    !reshaped.is_empty()
        && (reshaped.binary_search(&pair.a).is_ok() || reshaped.binary_search(&pair.b).is_ok())
}

/// Asks the narrow phase, in batches.
fn ask<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, motions, scratch, .. } = world;
    let Scratch { asked, batches, .. } = scratch;
    let batch_count = asked.len().div_ceil(BATCH);
    if batches.len() < batch_count {
        batches.resize_with(batch_count, Batch::default);
    }
    let asker = Asker { bodies, keys, motions };
    let batches = &mut batches[..batch_count];
    #[cfg(feature = "parallel")]
    if batch_count > 1 {
        use rayon::prelude::*;
        let both = asked.par_chunks(BATCH).zip(batches.par_iter_mut());
        both.for_each(|(asked, batch)| asker.ask(asked, batch));
        return;
    }
    asked.chunks(BATCH).zip(batches).for_each(|(asked, batch)| asker.ask(asked, batch));
}

/// What a batch needs to know, shared by all threads.
struct Asker<'a, S: Space> {
    bodies: &'a SlotMap<S::Key, Collider<S>>,
    keys: &'a [S::Key],
    motions: &'a Motions<S>,
}

impl<S: Space> Asker<'_, S> {
    /// Answers the pairs of one batch.
    fn ask(&self, asked: &[(PairId, Hint)], batch: &mut Batch<S::Manifold>) {
        batch.clear();
        for slice in asked.chunks(SLICE) {
            let mut jobs: ArrayVec<S::Job<'_>, SLICE> = ArrayVec::new();
            for &(pair, hint) in slice {
                let [a, b] = [pair.a, pair.b].map(|slot| self.bodies.get(self.keys[slot as usize]));
                if let Some((a, b)) = a.zip(b) {
                    jobs.push(S::job(a, b, a.margin + b.margin + self.approach(pair, [a, b]), hint));
                }
            }
            S::collide(&jobs, batch);
        }
    }

    /// By how much the bodies' motions may bring them nearer. A sensor looks no further than it reaches.
    #[inline]
    fn approach(&self, pair: PairId, bodies: [&Collider<S>; 2]) -> f32 {
        if self.motions.is_empty() || bodies[0].sensor || bodies[1].sensor {
            return 0.0;
        }
        approach(bodies, [self.motions.of(pair.a), self.motions.of(pair.b)])
    }
}

/// Puts candidates, contacts and manifolds of this update together, in order of the pairs.
fn gather<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, candidates, records, manifolds, scratch, .. } = world;
    let Scratch { pairs, carried, asked, batches, last_candidates, last_records, last_manifolds, .. } =
        scratch;
    candidates.clear();
    records.clear();
    manifolds.clear();
    let batch_count = asked.len().div_ceil(BATCH);
    let mut answers = Answers::new(&mut batches[..batch_count]);
    let mut last = 0;
    for (&pair, &carried) in pairs.iter().zip(&*carried) {
        let start = manifolds.len() as u32;
        if let Some(known) = last_candidates.get(carried as usize) {
            candidates.push(known.clone());
            while last_records.get(last).is_some_and(|record| record.pair < pair) {
                last += 1;
            }
            if let Some(record) = last_records.get(last).filter(|record| record.pair == pair) {
                manifolds.extend_from_slice(&last_manifolds[range_of(&record.manifolds)]);
                let manifolds = start..manifolds.len() as u32;
                records.push(Record {
                    manifolds,
                    begun: record.overlapping,
                    is_new: false,
                    ..record.clone()
                });
            }
            continue;
        }
        let Some(answer) = answers.next(manifolds) else { break };
        let keys = (keys[pair.a as usize], keys[pair.b as usize]);
        let (Answer::Apart { hint } | Answer::Contact { hint, .. }) = *answer;
        candidates.push(Candidate { pair, keys, hint });
        if let (Answer::Contact { overlapping, .. }, Some(a), Some(b)) =
            (answer, bodies.get(keys.0), bodies.get(keys.1))
        {
            let found = &manifolds[start as usize..];
            let range = start..manifolds.len() as u32;
            records.push(record_of::<S>((pair, keys), [a, b], *overlapping, found, range));
        }
    }
}

/// The answers of all batches, one after the other. Manifolds are moved, not cloned: clones of heaps' are a twelfth of
/// a frame (AMD EPYC, Zen 4, 2026-11-22).
struct Answers<'a, M> {
    batches: core::slice::IterMut<'a, Batch<M>>,
    answers: core::slice::Iter<'a, Answer>,
    manifolds: Option<std::vec::Drain<'a, M>>,
}

impl<'a, M> Answers<'a, M> {
    fn new(batches: &'a mut [Batch<M>]) -> Self {
        Self { batches: batches.iter_mut(), answers: [].iter(), manifolds: None }
    }

    /// The next answer; its manifolds go behind those of the one before it.
    fn next(&mut self, manifolds: &mut Vec<M>) -> Option<&'a Answer> {
        loop {
            if let Some(answer) = self.answers.next() {
                if let (Answer::Contact { manifolds: range, .. }, Some(left)) = (answer, &mut self.manifolds)
                {
                    manifolds.extend(left.take(range.len()));
                }
                return Some(answer);
            }
            let batch = self.batches.next()?;
            (self.answers, self.manifolds) = (batch.answers.iter(), Some(batch.manifolds.drain(..)));
        }
    }
}

/// A contact, as the narrow phase alone knows it; its past is merged in later.
fn record_of<S: Space>(
    (pair, keys): (PairId, (S::Key, S::Key)),
    [a, b]: [&Collider<S>; 2],
    overlapping: bool,
    found: &[S::Manifold],
    manifolds: Range<u32>,
) -> Record<S::Key> {
    let is_beyond = || S::least_separation(found) > a.margin + b.margin;
    Record {
        pair,
        keys,
        user_data: (a.user_data, b.user_data),
        manifolds,
        sensor: a.sensor || b.sensor,
        overlapping,
        begun: overlapping,
        is_new: false,
        speculative: !overlapping && !found.is_empty() && is_beyond(),
    }
}

fn range_of(range: &Range<u32>) -> Range<usize> {
    range.start as usize..range.end as usize
}
