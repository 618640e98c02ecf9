//! Stage 3: candidate pairs to contacts.
//!
//! ```text
//! cut the pairs into chunks: where they were cut last time, as long as none has grown too large     (begin_chunks)
//! chunks with the same pairs as then, none of whose bodies moved, keep their lists                  (keep_quiet)
//! for each other chunk, in parallel:                                                                (collide_chunks)
//!   each pair is carried over, moved along, or passed to the narrow phase                           (chunk.rs)
//!   candidates and contacts are written, and last update's that go on or end are noted              (settle.rs)
//! make room in the lists that were not needed, and mark bodies as not moved
//! ```
//! Kernels here and below avoid `map`, `zip` and `from_fn` on arrays: with `lto = "off"` they are calls, a third of the
//! time of a frame at rest and half of a sweep's; by default they are inlined, and nothing is gained.
//!
//! # What each technique bought
//! A frame of bodies at rest mostly waits for memory. In heaps and pyramids of boxes (AMD EPYC, Zen 4, 2026-11-22 and
//! -23):
//!
//! 1. manifolds stay in the list of the chunk that made them: copying took 17 % of the time, and takes 3 %;
//! 2. bodies are read once, while their pair is processed: a twentieth;
//! 3. candidates, contacts and whether they are new are written chunk by chunk, too, and no longer by one thread for
//!    all: 0.78 to 0.90 of a frame on two threads. On one thread it costs 3 to 10 % of frames of bodies almost at rest;
//! 4. a list of points has no destructor: dropping last frame's manifolds read each of them once more, a twenty-fifth;
//! 5. a candidate holds the number of its contact, so last update's contacts are not walked beside the pairs: a
//!    twentieth;
//! 6. points of 36 bytes in place of 40, thanks to ids of two halves: heaps of boxes another twentieth, pyramids
//!    nothing;
//! 7. where every body moves that may, no contact is carried over, so manifolds are written over last update's, which
//!    touches less memory: 1.03 times as fast;
//! 8. persistent manifolds of 248 bytes in place of 304, with one end of each point: 1.03 to 1.06 times;
//! 9. chunks in which nothing moved are skipped, and for that chunks persist between updates: a heap of 8,000 boxes at
//!    rest, 93,560 pairs, in 0.3 ms in place of 8 (Intel Xeon, family 6 model 106, one thread, 2026-11-27;
//!    `frame/asleep` of the bench `frame`). Where all move, 2 % more instructions. Tried: chunks that persist there as
//!    well, with room to grow: lists took longer to reach their largest size.
//!
//! # What was tried, and dropped
//! On one thread (medians of runs next to each other, on a busy machine):
//!
//! - Chunks of 128 pairs, 9 % slower than 256: each has lists of its own, and begins with waiting for each of them.
//! - Persistent manifolds in a `Box` of their own: pyramids 8 % slower, hulls faster.
//! - Persistent manifolds prefetched six pairs ahead: no gain, hulls 10 % slower; it is not one wait that counts, but
//!   how much there is to read. By the processor's prefetch instruction, while its pair is chosen, a heap of boxes at
//!   rest is 1.02 times as fast and pyramids 1.00 to 1.03 (Zen 5, 2026-11-24): not worth unsafe code.
//! - Skipping pairs that are still apart without a branch halved the mispredictions of a simulated processor, and saved
//!   no time (heaps -2 to +2 %, pyramids 2 to 5 % slower, hulls 5 % faster).

use super::chunk::{Chunk, CollideStage};
use super::join;
use super::settle::Settled;
use crate::collider::Tag;
use crate::contact::{Candidate, Record};
use crate::records::chunk_of;
use crate::space::Space;
use crate::world::{Scratch, World};
use asunder_narrow::Batch;
use slotmap::Key;
use std::sync::Mutex;

/// Brings the candidates up to date, and finds the contacts of each chunk.
pub(super) fn collide<S: Space>(world: &mut World<S>) {
    if world.stats.overflow {
        return;
    }
    let World { answered, scratch, .. } = world;
    let do_most_rest = 2 * world.moved.len() < world.keys.len();
    let does_any_stay = do_most_rest || does_any_stay(&world.keys, &world.tags, &world.is_moved);
    if does_any_stay {
        core::mem::swap(answered, &mut scratch.last_answered);
    }
    world.reshaped.sort_unstable();
    if begin_chunks(world, do_most_rest) {
        keep_quiet(world);
    }
    collide_chunks(world, do_most_rest);
    if !does_any_stay {
        make_room_as_in(&world.answered, &mut world.scratch.last_answered);
    }
    for slot in world.moved.drain(..) {
        world.is_moved[slot as usize] = false;
        world.odometers[slot as usize].close();
    }
}

/// Puts last update's lists aside, and sets up the chunks. Where most bodies are at rest, last update's chunks persist,
/// as long as none grows too large and there are not far too many; else chunks are cut anew. Returns whether the
/// chunks' last results still belong to these chunks.
fn begin_chunks<S: Space>(world: &mut World<S>, do_most_rest: bool) -> bool {
    let World { candidates, records, scratch, .. } = world;
    let Scratch { pairs, chunk_ends, settled, is_settled, last_candidates, last_records, .. } = scratch;
    // A world's first pairs are all passed to the narrow phase.
    let computed = settled.iter().map(|settled| settled.tally.computed).reduce(|all, one| all + one);
    let size = chunk_of(pairs.len(), computed.unwrap_or(pairs.len()));
    core::mem::swap(candidates, last_candidates);
    core::mem::swap(records, last_records);
    last_candidates.ends_in(pairs, chunk_ends);
    let starts = core::iter::once(&0).chain(&*chunk_ends);
    let longest = chunk_ends.iter().zip(starts).map(|(end, start)| end - start).max().unwrap_or(0);
    let are_many = chunk_ends.len() > 2 * pairs.len().div_ceil(size);
    let do_chunks_persist = do_most_rest && longest <= size && !are_many;
    if do_chunks_persist {
        candidates.begin_at(last_candidates.firsts().iter().copied());
    } else {
        // Chunks that may persist get room to grow.
        let cut = if do_most_rest { size - size / 4 } else { size };
        candidates.begin_at(pairs.iter().step_by(cut).copied());
        candidates.ends_in(pairs, chunk_ends);
    }
    records.begin_at(candidates.firsts().iter().copied());
    settled.iter_mut().for_each(Settled::wake);
    let were_settled = core::mem::replace(is_settled, true);
    if !were_settled {
        settled.iter_mut().for_each(|settled| settled.tally.forget());
    }
    were_settled && do_chunks_persist
}

/// Takes over last update's lists, as they are, of chunks in which nothing can have changed.
fn keep_quiet<S: Space>(world: &mut World<S>) {
    let World { candidates, records, answered, is_moved, scratch, .. } = world;
    let Scratch { pairs, chunk_ends, settled, last_candidates, last_records, last_answered, .. } = scratch;
    if answered.len() < chunk_ends.len() {
        answered.resize_with(chunk_ends.len(), Batch::default);
    }
    let mut start = 0;
    for (chunk, &end) in chunk_ends.iter().enumerate() {
        let pairs = &pairs[core::mem::replace(&mut start, end)..end];
        if settled[chunk].is_unchanged(pairs, is_moved) {
            settled[chunk].keep_quiet();
            let last = &mut last_candidates.chunks_mut()[chunk];
            core::mem::swap(&mut candidates.chunks_mut()[chunk], last);
            // The walks of other chunks through last update's candidates may pass here.
            last.clear();
            core::mem::swap(&mut records.chunks_mut()[chunk], &mut last_records.chunks_mut()[chunk]);
            core::mem::swap(&mut answered[chunk], &mut last_answered[chunk]);
        }
    }
}

/// Whether any body that is not fixed stayed where it is: else no contact is carried over, and last update's manifolds
/// may be overwritten. Cost: linear in all bodies, so it is not called where most are at rest.
fn does_any_stay<K: Key>(keys: &[K], tags: &[Tag], is_moved: &[bool]) -> bool {
    let mut bodies = keys.iter().zip(tags).zip(is_moved);
    bodies.any(|((key, tag), is_moved)| !is_moved && !tag.is_fixed() && !key.is_null())
}

/// Gives the lists that were not needed the capacity of the others, so that a body that stays later allocates nothing,
/// and memory stops growing as soon as if both lists took turns. Memory that nobody writes to costs no time.
fn make_room_as_in<M>(answered: &[Batch<M>], others: &mut Vec<Batch<M>>) {
    if others.len() < answered.len() {
        others.resize_with(answered.len(), Batch::default);
    }
    for (one, other) in answered.iter().zip(others) {
        other.clear();
        other.answers.reserve_exact(one.answers.capacity());
        other.manifolds.reserve_exact(one.manifolds.capacity());
    }
}

/// Works through the chunks.
fn collide_chunks<S: Space>(world: &mut World<S>, do_most_rest: bool) {
    let World { bodies, keys, is_moved, reshaped, odometers, motions, persistent, .. } = world;
    let World { candidates, records, answered, scratch, .. } = world;
    let Scratch { pairs, chunk_ends, settled, spare, last_candidates, last_records, last_answered, .. } =
        scratch;
    let count = chunk_ends.len();
    let (firsts, candidates) = candidates.firsts_and_chunks_mut();
    let part = Part {
        first: 0,
        candidates: &mut candidates[..count],
        records: &mut records.chunks_mut()[..count],
        answered: room_for(count, answered, Batch::clear),
        settled: room_for(count, settled, Settled::clear),
    };
    part.work(&CollideStage {
        bodies,
        keys,
        is_moved,
        reshaped,
        odometers,
        motions,
        persistent,
        pairs,
        chunk_ends,
        firsts,
        do_most_rest,
        last_candidates,
        last_records,
        last_answered,
        spare: Mutex::new(spare),
    });
}

/// The first `count` of a list, which grows if need be; the others are cleared.
fn room_for<T: Default>(count: usize, list: &mut Vec<T>, clear: impl Fn(&mut T)) -> &mut [T] {
    if list.len() < count {
        list.resize_with(count, T::default);
    }
    let (some, others) = list.split_at_mut(count);
    others.iter_mut().for_each(clear);
    some
}

/// Consecutive chunks, from number `first` on.
struct Part<'c, S: Space> {
    first: usize,
    candidates: &'c mut [Vec<Candidate<S::Key>>],
    records: &'c mut [Vec<Record<S::Key>>],
    answered: &'c mut [Batch<S::Manifold>],
    settled: &'c mut [Settled<S>],
}

impl<S: Space> Part<'_, S> {
    /// Works through the chunks: a single one, or both halves, on two threads if possible.
    fn work(self, stage: &CollideStage<'_, S>) {
        if self.settled.iter().all(Settled::is_quiet) {
            return;
        }
        if self.settled.len() > 1 {
            let (one, other) = self.halves();
            return join(|| one.work(stage), || other.work(stage));
        }
        let Self { first: number, candidates, records, answered, settled } = self;
        if let ([candidates], [records], [answered], [settled]) = (candidates, records, answered, settled) {
            stage.collide_chunk(Chunk { number, candidates, records, answered, settled });
        }
    }

    /// The first and the second half of the chunks.
    fn halves(self) -> (Self, Self) {
        let middle = self.settled.len() / 2;
        let candidates = self.candidates.split_at_mut(middle);
        let records = self.records.split_at_mut(middle);
        let answered = self.answered.split_at_mut(middle);
        let settled = self.settled.split_at_mut(middle);
        let one = Self {
            first: self.first,
            candidates: candidates.0,
            records: records.0,
            answered: answered.0,
            settled: settled.0,
        };
        let other = Self {
            first: self.first + middle,
            candidates: candidates.1,
            records: records.1,
            answered: answered.1,
            settled: settled.1,
        };
        (one, other)
    }
}
