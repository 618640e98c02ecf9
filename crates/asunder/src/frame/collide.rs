//! Stage 3: candidate pairs to contacts.

use crate::collider::Collider;
use crate::contact::{Candidate, Record};
use crate::space::Space;
use crate::world::World;
use asunder_broad::PairId;
use asunder_narrow::{Answer, ArrayVec, Batch, Hint};
use slotmap::SlotMap;

/// Pairs in one batch. Fixed, so that where batches are cut does not depend on the threads.
const BATCH: usize = 256;

/// Jobs handed to the narrow phase at once: enough to fill wide kernels, few enough to stay on the stack.
const SLICE: usize = 64;

/// Asks the narrow phase about every candidate, with last update's hint, and keeps the answers in order.
pub(super) fn collide<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, candidates, records, manifolds, stats, scratch, .. } = world;
    if stats.overflow {
        return;
    }
    core::mem::swap(candidates, &mut scratch.last_candidates);
    core::mem::swap(records, &mut scratch.last_records);
    candidates.clear();
    records.clear();
    manifolds.clear();

    let batch_count = scratch.pairs.len().div_ceil(BATCH);
    if scratch.batches.len() < batch_count {
        scratch.batches.resize_with(batch_count, Batch::default);
    }
    let asker = Asker { bodies, keys, last: &scratch.last_candidates };
    let (pairs, batches) = (&scratch.pairs, &mut scratch.batches[..batch_count]);
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        if batch_count > 1 {
            pairs
                .par_chunks(BATCH)
                .zip(batches.par_iter_mut())
                .for_each(|(pairs, batch)| asker.ask(pairs, batch));
        } else {
            pairs.chunks(BATCH).zip(batches.iter_mut()).for_each(|(pairs, batch)| asker.ask(pairs, batch));
        }
    }
    #[cfg(not(feature = "parallel"))]
    pairs.chunks(BATCH).zip(batches.iter_mut()).for_each(|(pairs, batch)| asker.ask(pairs, batch));

    for (pairs, batch) in pairs.chunks(BATCH).zip(batches) {
        let offset = manifolds.len() as u32;
        for (&pair, answer) in pairs.iter().zip(&batch.answers) {
            let keys = (keys[pair.a as usize], keys[pair.b as usize]);
            let (hint, contact) = match answer {
                Answer::Apart { hint } => (*hint, None),
                Answer::Contact { hint, overlapping, manifolds } => (*hint, Some((*overlapping, manifolds))),
            };
            candidates.push(Candidate { pair, keys, hint });
            if let (Some((overlapping, range)), Some(a), Some(b)) =
                (contact, bodies.get(keys.0), bodies.get(keys.1))
            {
                records.push(Record {
                    pair,
                    keys,
                    user_data: (a.user_data, b.user_data),
                    manifolds: range.start + offset..range.end + offset,
                    sensor: a.sensor || b.sensor,
                    overlapping,
                    begun: overlapping,
                    is_new: false,
                });
            }
        }
        manifolds.append(&mut batch.manifolds);
    }
}

/// What a batch needs to know, shared by all threads.
struct Asker<'a, S: Space> {
    bodies: &'a SlotMap<S::Key, Collider<S>>,
    keys: &'a [S::Key],
    last: &'a [Candidate<S::Key>],
}

impl<S: Space> Asker<'_, S> {
    /// Answers the pairs of one batch. They are sorted, and so are last update's: one walk finds all hints.
    fn ask(&self, pairs: &[PairId], batch: &mut Batch<S::Manifold>) {
        batch.clear();
        let first = pairs.first().map_or(0, |first| self.last.partition_point(|known| known.pair < *first));
        let mut last = self.last[first..].iter().peekable();
        for slice in pairs.chunks(SLICE) {
            let mut jobs: ArrayVec<S::Job<'_>, SLICE> = ArrayVec::new();
            for pair in slice {
                let keys = (self.keys[pair.a as usize], self.keys[pair.b as usize]);
                while last.next_if(|known| known.pair < *pair).is_some() {}
                let known = last.next_if(|known| known.pair == *pair);
                let hint = known.filter(|known| known.keys == keys).map_or(Hint::NONE, |known| known.hint);
                if let Some((a, b)) = self.bodies.get(keys.0).zip(self.bodies.get(keys.1)) {
                    jobs.push(S::job(a, b, a.margin + b.margin, hint));
                }
            }
            S::collide(&jobs, batch);
        }
    }
}
