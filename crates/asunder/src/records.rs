//! The contacts of an update, sorted by pair, in the chunks of pairs in which they were found.
//!
//! A list in one piece would be written twice: nobody knows where a chunk's contacts go before all others are counted. Tried:
//! putting 30,000 of them together took 7 % of the frame (AMD EPYC, Zen 4, 2 virtual cores, 2026-11-22).

use crate::contact::Record;
use asunder_broad::PairId;

/// Most pairs in a chunk.
pub(crate) const CHUNK: usize = 1024;

/// How many chunks there are at most, unless each would hold more than [`CHUNK`].
const MANY: usize = 96;

/// Fewest pairs in a chunk, but for the last, where hardly any is asked about.
const FEW: usize = 256;

/// Pairs in a chunk, of so many, where of last update's so many were asked about: enough chunks to share out, and no more.
/// Each has lists of its own, and begins with waiting for each of them: some 3 us (AMD EPYC, Zen 4, 2026-11-23).
///
/// To ask takes some ten times as long as all else: a crowd has 1,300 pairs, all of them asked about, and in chunks of 256 they
/// took 16 threads 1.0 ms, of 128 0.7 and of 64 0.6 (Intel Xeon, family 6 model 207, 16 virtual cores, 2026-11-26); where few are, 64 pairs are not worth a
/// chunk (boxes at rest 8 % slower). Who comes to rest leaves the lists of both kinds behind. Never by the number of threads.
pub(crate) fn chunk_of(pairs: usize, asked: usize) -> usize {
    let few = if asked > pairs / 4 { FEW / 2 } else { FEW };
    pairs.div_ceil(MANY).next_multiple_of(few).clamp(few, CHUNK)
}

/// Contacts in pair order. Each has a number, ascending: its chunk's, times [`CHUNK`], and its place there.
#[derive(Debug)]
pub(crate) struct Records<K> {
    /// The least pair that a chunk may hold, of each in use. The first holds what is before it, too.
    firsts: Vec<PairId>,
    /// Those of no use are empty, and kept for their memory.
    chunks: Vec<Vec<Record<K>>>,
}

asunder_geometry::copied!(Records<K>, for [K: Clone], { firsts, chunks } but {});

impl<K> Records<K> {
    pub(crate) const fn new() -> Self {
        Self { firsts: Vec::new(), chunks: Vec::new() }
    }

    /// Of a sorted list; each has its place there as its number.
    #[cfg(any(feature = "serde", test))]
    pub(crate) fn of(list: &[Record<K>]) -> Self
    where
        K: Clone,
    {
        let firsts = list.chunks(CHUNK).map(|chunk| chunk[0].pair).collect();
        Self { firsts, chunks: list.chunks(CHUNK).map(<[_]>::to_vec).collect() }
    }

    /// One empty chunk for every `size` pairs; at least one.
    pub(crate) fn chunks_of(&mut self, pairs: &[PairId], size: usize) -> &mut [Vec<Record<K>>] {
        self.firsts.clear();
        self.firsts.extend(pairs.iter().step_by(size));
        self.chunks.iter_mut().for_each(Vec::clear);
        let count = self.firsts.len().max(1);
        if self.chunks.len() < count {
            self.chunks.resize_with(count, Vec::new);
        }
        &mut self.chunks[..count]
    }

    /// The record of a number.
    #[inline]
    pub(crate) fn get(&self, number: usize) -> &Record<K> {
        &self.chunks[number / CHUNK][number % CHUNK]
    }

    /// All chunks, those of no use at the end.
    pub(crate) fn chunks(&self) -> &[Vec<Record<K>>] {
        &self.chunks
    }

    /// All, without their numbers.
    pub(crate) fn all(&self) -> impl Iterator<Item = &Record<K>> {
        self.chunks.iter().flatten()
    }

    /// The same.
    pub(crate) fn all_mut(&mut self) -> impl Iterator<Item = &mut Record<K>> {
        self.chunks.iter_mut().flatten()
    }

    /// All, with their numbers.
    pub(crate) fn iter(&self) -> Walk<'_, K> {
        Walk { here: [].iter(), number: 0, chunks: self.chunks.iter(), next_chunk: 0 }
    }

    /// Those of this pair and of what comes after it. Cost: logarithmic in all records.
    pub(crate) fn from(&self, pair: PairId) -> Walk<'_, K> {
        let chunk = self.firsts.partition_point(|&first| first <= pair).saturating_sub(1);
        let mut chunks = self.chunks.get(chunk..).unwrap_or_default().iter();
        let list = chunks.next().map_or([].as_slice(), Vec::as_slice);
        let at = list.partition_point(|record| record.pair < pair);
        Walk { here: list[at..].iter(), number: chunk * CHUNK + at, chunks, next_chunk: chunk + 1 }
    }
}

/// Records one after the other, with their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Walk<'a, K> {
    here: core::slice::Iter<'a, Record<K>>,
    /// Of the next record here.
    number: usize,
    chunks: core::slice::Iter<'a, Vec<Record<K>>>,
    next_chunk: usize,
}

impl<'a, K> Iterator for Walk<'a, K> {
    type Item = (usize, &'a Record<K>);

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(record) = self.here.next() {
                self.number += 1;
                return Some((self.number - 1, record));
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

impl<K> ExactSizeIterator for Walk<'_, K> {}

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
            let chunks = records.chunks_of(&pairs, CHUNK).iter_mut().zip(pairs.chunks(CHUNK));
            for (number, (chunk, pairs)) in chunks.enumerate() {
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
            assert!(records.from(pair(a)).all(|(number, record)| records.get(number).pair == record.pair));
        }
        assert_eq!(records.chunks_of(&[], 8).len(), 1);
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
