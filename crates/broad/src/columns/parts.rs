//! Merges columns whose boxes were sorted in parts.

use super::codes::Entry;
use super::grid::Grid;
use super::{ColumnEntries, Columns};
use core::ops::Range;

/// Fewest entries that are worth another thread.
#[cfg(feature = "parallel")]
const WORTH_A_THREAD: usize = 16_384;

impl Columns {
    /// Merges the parts of one column, bin by bin.
    pub(crate) fn gather(&mut self, parts: &[Self], grid: &Grid, index: usize) -> ColumnEntries<'_> {
        let bins = 1 << grid.bin_bits;
        let bins = index * bins..(index + 1) * bins;
        let count = count(parts, &bins);
        if self.entries.len() < count {
            self.entries.resize(count, Entry::default());
        }
        self.ends.resize(bins.len(), 0);
        put_together(parts, bins, (&mut self.entries, &mut self.ends), 0);
        ColumnEntries { start: 0, ends: &self.ends, entries: &self.entries[..count] }
    }

    /// Merges the parts of all columns, on the threads of the current pool. Leaves no records.
    #[cfg(feature = "parallel")]
    pub(crate) fn gather_all(&mut self, parts: &[Self], grid: &Grid) {
        let cells = grid.count() << grid.bin_bits;
        let count = count(parts, &(0..cells));
        self.records.clear();
        self.entries.resize(count, Entry::default());
        // One more, for empty boxes.
        self.ends.resize(cells + 1, 0);
        self.ends[cells] = count as u32;
        put_together_in_halves(parts, 0..cells, (&mut self.entries, &mut self.ends[..cells]), 0);
    }
}

/// Counts the entries in some bins of all parts.
fn count(parts: &[Columns], bins: &Range<usize>) -> usize {
    parts.iter().map(|part| (part.ends[bins.end - 1] - start(part, bins.start)) as usize).sum()
}

#[inline(always)]
fn start(part: &Columns, bin: usize) -> u32 {
    if bin == 0 { 0 } else { part.ends[bin - 1] }
}

/// Writes the entries of some bins, and where each bin ends; the first entry has place `first`.
#[inline(always)]
fn put_together(
    parts: &[Columns],
    bins: Range<usize>,
    (entries, ends): (&mut [Entry], &mut [u32]),
    first: usize,
) {
    let mut next = 0;
    for (bin, end) in bins.zip(ends) {
        for part in parts {
            // Mostly only a few entries: a loop is faster than a call of memcpy.
            for entry in &part.entries[start(part, bin) as usize..part.ends[bin] as usize] {
                entries[next] = *entry;
                next += 1;
            }
        }
        *end = (first + next) as u32;
    }
}

/// The same on several threads.
#[cfg(feature = "parallel")]
fn put_together_in_halves(
    parts: &[Columns],
    bins: Range<usize>,
    (entries, ends): (&mut [Entry], &mut [u32]),
    first: usize,
) {
    if entries.len() < WORTH_A_THREAD || bins.len() < 2 {
        return put_together(parts, bins, (entries, ends), first);
    }
    let half = bins.len() / 2;
    let middle = bins.start + half;
    let size = count(parts, &(bins.start..middle));
    let (entries_low, entries_high) = entries.split_at_mut(size);
    let (ends_low, ends_high) = ends.split_at_mut(half);
    rayon::join(
        || put_together_in_halves(parts, bins.start..middle, (entries_low, ends_low), first),
        || put_together_in_halves(parts, middle..bins.end, (entries_high, ends_high), first + size),
    );
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use crate::Sweep;
    use asunder_geometry::{Aabb3, glam::Vec3};

    #[test]
    fn columns_put_together_hold_what_one_thread_sorts() {
        let low = |i: u32| Vec3::new((i % 40) as f32, (i / 40 % 40) as f32, (i / 1600) as f32) * 1.3;
        let mut boxes: Vec<Aabb3> =
            (0..60_000).map(|i| Aabb3::new(low(i), low(i) + Vec3::splat(1.4))).collect();
        boxes[77] = Aabb3::new(Vec3::ONE, Vec3::ZERO);
        // Every bin: where it ends, and what is in it.
        let sorted = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut sweep = Sweep::new();
            pool.install(|| {
                sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut Vec::new()).unwrap();
                let (_, columns) = sweep.put_together().unwrap();
                let mut start = 0;
                let bins = columns.ends.iter().map(|&end| {
                    let bin = &columns.entries[start..end as usize];
                    start = end as usize;
                    let mut bin: Vec<_> = bin.iter().map(|entry| (entry.place, entry.codes)).collect();
                    bin.sort_unstable();
                    bin
                });
                bins.take(columns.ends.len() - 1).collect::<Vec<_>>()
            })
        };
        let one = sorted(1);
        assert!(one.len() > 1000 && one.iter().map(Vec::len).sum::<usize>() > boxes.len());
        assert_eq!(one, sorted(2));
        assert_eq!(one, sorted(7));
    }
}
