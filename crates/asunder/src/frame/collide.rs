//! Stage 3: candidate pairs to contacts.
//!
//! ```text
//! cut the pairs into chunks
//! for each chunk, in parallel:
//!   find its part of last update's candidates
//!   what is carried on, moved along, or asked about                                         (ask)
//!   candidates and contacts, and what of last update's goes on                              (settle)
//! ```
//! Most of a frame of bodies that rest is waiting for memory. What bought what, of heaps and pyramids of boxes (AMD EPYC,
//! Zen 4, 2026-11-22 and -23):
//!
//! 1. manifolds stay in the list of the chunk that made them: 17 % of the time was copying, and 3 % is;
//! 2. bodies are read once, while a pair is asked about: a twentieth;
//! 3. candidates, contacts and whether they are new are written down chunk by chunk, too, and no longer by one thread for all:
//!    0.78 to 0.90 of a frame on two threads. On one thread it costs 3 to 10 % of frames that all but rest;
//! 4. a list of points has nothing to drop: forgetting last frame's manifolds read each of them once more, a twenty-fifth;
//! 5. a candidate knows the number of its contact, and last update's contacts are not walked beside the pairs: a twentieth;
//! 6. points of 36 bytes in place of 40, by ids of two halves: heaps of boxes another twentieth, pyramids nothing;
//! 7. where every body moves that may, no contact is carried on, and manifolds are written over last update's, which is less
//!    memory in turn: 1.03 times as fast;
//! 8. what is kept to be moved along in 248 bytes in place of 304, points by one of their ends: 1.03 to 1.06 times.
//!
//! Tried, on one thread (medians of runs next to each other, on a busy machine): chunks of 128 pairs, 9 % slower than 256: each
//! has lists of its own, and begins with waiting for each of them. What is kept to be moved along in a box of its own: pyramids
//! 8 % slower, hulls faster. What is kept fetched six pairs ahead: nothing, hulls 10 % slower; it is not one wait that counts,
//! but how much there is to read. By the processor's own instruction, while its pair is chosen, a heap of boxes at rest is 1.02 times as
//! fast and pyramids 1.00 to 1.03 (Zen 5, 2026-11-24): not worth code that is unsafe. Leaving out pairs that are still apart
//! without a branch halved what a simulated processor predicted wrongly, and saved no time (heaps -2 to +2 %, pyramids 2 to 5 %
//! slower, hulls 5 % faster).
//!
//! Kernels here and below shun `map`, `zip` and `from_fn` on arrays: with `lto = "off"` they are calls, a third of the time
//! of such a frame and half of a sweep's; by default they are not, and nothing is gained.

use super::ask::{Asker, Chunk};
use super::both;
use super::settle::Settled;
use crate::collider::Tag;
use crate::contact::{Candidate, ContactNumber, Record};
use crate::records::{Records, chunk_of};
use crate::slab::NOWHERE;
use crate::space::Space;
use crate::world::{Scratch, World};
use asunder_broad::PairId;
use asunder_narrow::{Batch, Hint};
use slotmap::Key;
use std::sync::Mutex;

/// Brings candidates up to date, and finds the contacts of each chunk.
pub(super) fn collide<S: Space>(world: &mut World<S>) {
    if world.stats.overflow {
        return;
    }
    let World { candidates, records, answered, scratch, .. } = world;
    core::mem::swap(candidates, &mut scratch.last_candidates);
    core::mem::swap(records, &mut scratch.last_records);
    let does_any_stay = does_any_stay(&world.moved, &world.keys, &world.tags, &world.is_moved);
    if does_any_stay {
        core::mem::swap(answered, &mut scratch.last_answered);
    }
    world.reshaped.sort_unstable();
    ask(world);
    if !does_any_stay {
        make_room_as_in(&world.answered, &mut world.scratch.last_answered);
    }
    for slot in world.moved.drain(..) {
        world.is_moved[slot as usize] = false;
        world.odometers[slot as usize].close();
    }
}

/// Whether a body may stay where it is that may meet another that does: else no contact is carried on, and last update's
/// manifolds may be written over. Cost: linear in what moved: where most bodies are at rest, nobody looks.
fn does_any_stay<K: Key>(moved: &[u32], keys: &[K], tags: &[Tag], is_moved: &[bool]) -> bool {
    let mut bodies = keys.iter().zip(tags).zip(is_moved);
    2 * moved.len() < keys.len()
        || bodies.any(|((key, tag), is_moved)| !is_moved && !tag.is_fixed() && !key.is_null())
}

/// Makes the lists that were not needed as roomy as the others: so that a body that stays allocates nothing then, and memory
/// stops growing as soon as if both lists took turns. Memory that nobody writes to costs no time.
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
fn ask<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, is_moved, reshaped, odometers, motions, persistent, .. } = world;
    let World { candidates, records, answered, scratch, .. } = world;
    let Scratch { pairs, chunk, settled, spare, last_candidates, last_records, last_answered, .. } = scratch;
    // Of a world's first pairs, all are asked about.
    let asked = settled.iter().map(|settled| settled.tally.asked).reduce(|all, asked| all + asked);
    let size = chunk_of(pairs.len(), asked.unwrap_or(pairs.len()));
    *chunk = size;
    // Without a pair there is a chunk still: of what is gone.
    let records = records.chunks_of(pairs, size);
    let answered = room_for(records.len(), answered, Batch::clear);
    let settled = room_for(records.len(), settled, Settled::clear);
    // What is there already is written over.
    candidates.resize(pairs.len(), blank());
    let asker = Asker {
        bodies,
        keys,
        is_moved,
        reshaped,
        odometers,
        motions,
        persistent,
        last_answered,
        spare: Mutex::new(spare),
    };
    let part = Part { first: 0, size, pairs, last_candidates, candidates, records, answered, settled };
    part.work(&asker, last_records);
}

/// What is written over.
fn blank<K: Key>() -> Candidate<K> {
    let (pair, keys) = (PairId { a: 0, b: 0 }, (K::null(), K::null()));
    let (persistent, contact) = (NOWHERE, ContactNumber::NONE);
    Candidate { pair, keys, hint: Hint::NONE, persistent, contact, until: f64::NEG_INFINITY }
}

/// As many of a list as are needed; the others are cleared.
fn room_for<T: Default>(count: usize, list: &mut Vec<T>, clear: impl Fn(&mut T)) -> &mut [T] {
    if list.len() < count {
        list.resize_with(count, T::default);
    }
    let (some, others) = list.split_at_mut(count);
    others.iter_mut().for_each(clear);
    some
}

/// Chunks, one after the other, from the first of them on; and their part of last update's lists.
struct Part<'c, S: Space> {
    first: usize,
    /// Pairs in a chunk.
    size: usize,
    pairs: &'c [PairId],
    last_candidates: &'c [Candidate<S::Key>],
    candidates: &'c mut [Candidate<S::Key>],
    records: &'c mut [Vec<Record<S::Key>>],
    answered: &'c mut [Batch<S::Manifold>],
    settled: &'c mut [Settled<S>],
}

impl<S: Space> Part<'_, S> {
    /// Works through the chunks: through one of them, or through either half, on two threads where there are.
    fn work(self, asker: &Asker<'_, S>, last_records: &Records<S::Key>) {
        if self.answered.len() > 1 {
            let (one, other) = self.halves();
            return both(|| one.work(asker, last_records), || other.work(asker, last_records));
        }
        let Self { first, pairs, last_candidates, candidates, records, answered, settled, .. } = self;
        if let ([records], [answered], [settled]) = (records, answered, settled) {
            asker.ask(Chunk {
                number: first as u32,
                pairs,
                last_candidates,
                last_records,
                candidates,
                records,
                answered,
                settled,
            });
        }
    }

    /// The first and the second half of the chunks. Candidates begin about where they did last time.
    fn halves(self) -> (Self, Self) {
        let middle = self.answered.len() / 2;
        let at = middle * self.size;
        let first = self.pairs[at];
        let known = first_after(self.last_candidates, at, |known| known.pair < first);
        let pairs = self.pairs.split_at(at);
        let last_candidates = self.last_candidates.split_at(known);
        let candidates = self.candidates.split_at_mut(at);
        let records = self.records.split_at_mut(middle);
        let answered = self.answered.split_at_mut(middle);
        let settled = self.settled.split_at_mut(middle);
        let one = Self {
            first: self.first,
            size: self.size,
            pairs: pairs.0,
            last_candidates: last_candidates.0,
            candidates: candidates.0,
            records: records.0,
            answered: answered.0,
            settled: settled.0,
        };
        let other = Self {
            first: self.first + middle,
            size: self.size,
            pairs: pairs.1,
            last_candidates: last_candidates.1,
            candidates: candidates.1,
            records: records.1,
            answered: answered.1,
            settled: settled.1,
        };
        (one, other)
    }
}

/// The first place of a list that is not before something, searched for from a guess on. Cost: logarithmic in how far off
/// that is.
fn first_after<T>(list: &[T], guess: usize, is_before: impl Fn(&T) -> bool) -> usize {
    let guess = guess.min(list.len());
    let (mut low, mut high, mut step) = (guess, guess, 1);
    if list.get(guess).is_some_and(&is_before) {
        while list.get(high).is_some_and(&is_before) {
            low = high + 1;
            high = (high + step).min(list.len());
            step *= 2;
        }
    } else {
        while low > 0 && !is_before(&list[low - 1]) {
            high = low - 1;
            low = low.saturating_sub(step);
            step *= 2;
        }
    }
    low + list[low..high].partition_point(is_before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_found_from_any_guess() {
        let list: Vec<u32> = (0..40).map(|i| i / 3 * 2).collect();
        for wanted in 0..30 {
            let place = list.iter().filter(|&&one| one < wanted).count();
            for guess in 0..50 {
                assert_eq!(first_after(&list, guess, |&one| one < wanted), place, "{wanted} from {guess}");
            }
        }
        assert_eq!(first_after(&[], 3, |_: &u32| true), 0);
    }
}
