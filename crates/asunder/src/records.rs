//! Candidates of an update and the contacts among them, sorted by pair, in chunks.
//!
//! A list in one piece would be written twice: where a chunk's contacts go is known only when those of all chunks
//! before it are counted. Tried: putting 30,000 of them together took 7 % of the frame (AMD EPYC, Zen 4, 2 virtual
//! cores, 2026-11-22).
//!
//! Chunks persist from one update to the next, as long as none grows too large. So a chunk in which nothing moved can
//! be skipped: see `frame::collide`.

use crate::contact::{Candidate, Record};
use asunder_broad::PairId;

/// Most pairs in a chunk.
pub(crate) const CHUNK: usize = 1024;

/// How many chunks there are at most, unless each would hold more than [`CHUNK`].
const MANY: usize = 96;

/// Fewest pairs in a chunk, except the last, where hardly any needs the narrow phase.
const FEW: usize = 256;

/// Most pairs in a chunk, for so many pairs in all, when `computed` of last update's went through the narrow phase:
/// enough chunks to share out, and no more. Each has lists of its own, and begins with waiting for each of them: some 3
/// us (AMD EPYC, Zen 4, 2026-11-23).
///
/// The narrow phase takes some ten times as long as all else: a crowd has 1,300 pairs, all of which need it, and in
/// chunks of 256 they took 16 threads 1.0 ms, of 128 0.7 and of 64 0.6 (Intel Xeon, family 6 model 207, 16 virtual
/// cores, 2026-11-26); where few need it, 64 pairs are not worth a chunk (boxes at rest 8 % slower). Bodies that come
/// to rest leave the lists of both sizes behind. Never by the number of threads.
pub(crate) fn chunk_of(pairs: usize, computed: usize) -> usize {
    let few = if computed > pairs / 4 { FEW / 2 } else { FEW };
    pairs.div_ceil(MANY).next_multiple_of(few).clamp(few, CHUNK)
}

/// Something that belongs to one pair.
pub(crate) trait OfPair {
    fn pair(&self) -> PairId;
}

impl<K> OfPair for Candidate<K> {
    #[inline]
    fn pair(&self) -> PairId {
        self.pair
    }
}

impl<K> OfPair for Record<K> {
    #[inline]
    fn pair(&self) -> PairId {
        self.pair
    }
}

/// A list in pair order. Each element has a number, ascending: that of its chunk, times [`CHUNK`], plus its place
/// there.
#[derive(Debug)]
pub(crate) struct Chunked<T> {
    /// The least pair that each chunk in use may hold. The first chunk also holds what is before its own.
    firsts: Vec<PairId>,
    /// Those not in use are empty, and kept for their memory.
    chunks: Vec<Vec<T>>,
}

/// The candidate pairs of an update.
pub(crate) type Candidates<K> = Chunked<Candidate<K>>;

/// Its contacts.
pub(crate) type Records<K> = Chunked<Record<K>>;

asunder_geometry::copied!(Chunked<T>, for [T: Clone], { firsts, chunks } but {});

impl<T: OfPair> Chunked<T> {
    pub(crate) const fn new() -> Self {
        Self { firsts: Vec::new(), chunks: Vec::new() }
    }

    /// From a sorted list; each element's number is its place there.
    #[cfg(any(feature = "serde", test))]
    pub(crate) fn of(list: &[T]) -> Self
    where
        T: Clone,
    {
        let firsts = list.chunks(CHUNK).map(|chunk| chunk[0].pair()).collect();
        Self { firsts, chunks: list.chunks(CHUNK).map(<[_]>::to_vec).collect() }
    }

    /// The least pair of each chunk.
    pub(crate) fn firsts(&self) -> &[PairId] {
        &self.firsts
    }

    /// Where each chunk's part of some pairs ends, in order.
    pub(crate) fn ends_in(&self, pairs: &[PairId], ends: &mut Vec<usize>) {
        ends.clear();
        let others = self.firsts.get(1..).unwrap_or_default();
        ends.extend(others.iter().map(|first| pairs.partition_point(|pair| pair < first)));
        ends.push(pairs.len());
    }

    /// Sets up chunks that begin with these pairs, at least one; their contents are to be overwritten.
    pub(crate) fn begin_at(&mut self, firsts: impl IntoIterator<Item = PairId>) -> &mut [Vec<T>] {
        self.firsts.clear();
        self.firsts.extend(firsts);
        let count = self.firsts.len().max(1);
        if self.chunks.len() < count {
            self.chunks.resize_with(count, Vec::new);
        }
        let (chunks, others) = self.chunks.split_at_mut(count);
        others.iter_mut().for_each(Vec::clear);
        chunks
    }

    /// The element with a number.
    #[inline]
    pub(crate) fn get(&self, number: usize) -> &T {
        &self.chunks[number / CHUNK][number % CHUNK]
    }

    /// All chunks, those not in use at the end.
    pub(crate) fn chunks(&self) -> &[Vec<T>] {
        &self.chunks
    }

    /// The same.
    pub(crate) fn chunks_mut(&mut self) -> &mut [Vec<T>] {
        &mut self.chunks
    }

    /// [`firsts`](Self::firsts) and [`chunks_mut`](Self::chunks_mut).
    pub(crate) fn firsts_and_chunks_mut(&mut self) -> (&[PairId], &mut [Vec<T>]) {
        (&self.firsts, &mut self.chunks)
    }

    /// How many elements there are.
    pub(crate) fn len(&self) -> usize {
        self.chunks.iter().map(Vec::len).sum()
    }

    /// All elements, without their numbers.
    pub(crate) fn all(&self) -> impl Iterator<Item = &T> {
        self.chunks.iter().flatten()
    }

    /// The same.
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut T> {
        self.chunks.iter_mut().flatten()
    }

    /// All elements, with their numbers.
    pub(crate) fn iter(&self) -> Walk<'_, T> {
        Walk { here: [].iter(), number: 0, chunks: self.chunks.iter(), next_chunk: 0 }
    }

    /// Elements from `first` on, or from the beginning, up to but without `end`, or to the end. As slices, none of
    /// which is read before its turn.
    pub(crate) fn between(&self, first: Option<PairId>, end: Option<PairId>) -> impl Iterator<Item = &[T]> {
        let start = first.map_or_else(|| self.iter(), |first| self.from(first));
        let slices = core::iter::once(start.here.as_slice()).chain(start.chunks.map(Vec::as_slice));
        let before_end = move |slice: &'_ [T]| match end {
            Some(end) => slice.partition_point(|one| one.pair() < end),
            None => slice.len(),
        };
        let mut is_over = false;
        slices.map_while(move |slice| {
            let count = before_end(slice);
            let is_last = core::mem::replace(&mut is_over, count < slice.len());
            (!is_last).then(|| &slice[..count])
        })
    }

    /// The elements of this pair and of those after it. Cost: logarithmic in all of them.
    pub(crate) fn from(&self, pair: PairId) -> Walk<'_, T> {
        let chunk = self.firsts.partition_point(|&first| first <= pair).saturating_sub(1);
        let mut chunks = self.chunks.get(chunk..).unwrap_or_default().iter();
        let list = chunks.next().map_or([].as_slice(), Vec::as_slice);
        let at = list.partition_point(|one| one.pair() < pair);
        Walk { here: list[at..].iter(), number: chunk * CHUNK + at, chunks, next_chunk: chunk + 1 }
    }
}

/// Iterates over elements with their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Walk<'a, T> {
    here: core::slice::Iter<'a, T>,
    /// The number of the next element in `here`.
    number: usize,
    chunks: core::slice::Iter<'a, Vec<T>>,
    next_chunk: usize,
}

impl<'a, T> Iterator for Walk<'a, T> {
    type Item = (usize, &'a T);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(one) = self.here.next() {
                self.number += 1;
                return Some((self.number - 1, one));
            }
            self.here = self.chunks.next()?.iter();
            self.number = self.next_chunk * CHUNK;
            self.next_chunk += 1;
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.here.len() + self.chunks.clone().map(Vec::len).sum::<usize>();
        (left, Some(left))
    }
}

impl<T> ExactSizeIterator for Walk<'_, T> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::BodyKey3;

    const fn pair(a: u32) -> PairId {
        PairId { a, b: a + 1 }
    }

    #[test]
    fn records_are_found_in_any_chunk() {
        // Of three chunks of pairs, the second without a contact, the others with every third.
        let pairs: Vec<PairId> = (10..10 + 2 * CHUNK as u32 + 9).map(pair).collect();
        let mut records: Records<BodyKey3> = Records::new();
        for _ in 0..2 {
            let chunks =
                records.begin_at(pairs.iter().step_by(CHUNK).copied()).iter_mut().zip(pairs.chunks(CHUNK));
            for (number, (chunk, pairs)) in chunks.enumerate() {
                chunk.clear();
                let met = pairs.iter().step_by(3).filter(|_| number != 1);
                chunk.extend(met.map(|&pair| Record::of_nobody(pair)));
            }
        }
        let all: Vec<PairId> = records.all().map(|record| record.pair).collect();
        assert!(all.is_sorted() && all.len() == CHUNK.div_ceil(3) + 3);
        assert!(records.iter().map(|(_, record)| record.pair).eq(all.iter().copied()));
        assert_eq!(records.iter().len(), all.len());
        assert!(records.iter().all(|(number, record)| records.get(number).pair == record.pair));
        for a in 0..10 + 3 * CHUNK as u32 {
            let from: Vec<PairId> = records.from(pair(a)).map(|(_, record)| record.pair).collect();
            let expected: Vec<PairId> = all.iter().copied().filter(|&of| of >= pair(a)).collect();
            assert_eq!(from, expected, "from {a}");
            assert_eq!(records.from(pair(a)).len(), from.len());
            for end in [a, a + 7, a + CHUNK as u32].map(pair) {
                let some = records.between(Some(pair(a)), Some(end)).flatten().map(|record| record.pair);
                assert!(some.eq(expected.iter().copied().filter(|&of| of < end)), "from {a} to {end:?}");
                let before = records.between(None, Some(end)).flatten().map(|record| record.pair);
                assert!(before.eq(all.iter().copied().filter(|&of| of < end)), "to {end:?}");
            }
            assert!(records.between(Some(pair(a)), None).flatten().map(|record| record.pair).eq(from));
            assert!(records.from(pair(a)).all(|(number, record)| records.get(number).pair == record.pair));
        }
        let left = records.begin_at([]);
        assert_eq!(left.len(), 1);
        left[0].clear();
        assert!(records.iter().next().is_none() && records.from(pair(0)).next().is_none());
    }

    #[test]
    fn a_list_is_numbered_as_it_is() {
        let list: Vec<Record<BodyKey3>> =
            (0..2 * CHUNK as u32 + 5).map(|a| Record::of_nobody(pair(a))).collect();
        let records = Records::of(&list);
        assert!(records.iter().map(|(number, _)| number).eq(0..list.len()));
        assert_eq!(records.from(list[CHUNK + 3].pair).next().map(|(number, _)| number), Some(CHUNK + 3));
    }
}
