//! The second half of sorting boxes into columns: puts every entry into its bin.
//!
//! ```text
//! few boxes:   bins have been counted; each entry goes into its bin
//! many boxes:  groups of equally many bins have been counted, each small enough for a near cache:
//!              each entry goes into its group, in the order of the input
//!              in each group, count the entries of every bin, then put each into its bin
//! at the end:  boxes that reach more than two columns: all entries but the first, each into its bin
//! ```
//! Boxes come in any order. Where many are spread over much memory, each entry costs a cache and a TLB miss, and so
//! does the counter of its bin. Groups are few enough for one cache line of each to stay near. Both ways are stable,
//! and so give the same result.
//!
//! With groups, a whole sweep of a million boxes, pairs sorted, takes 0.69 of the time for `gas`, 0.7 for `sizes` and
//! `tower`, 0.9 for `pile` (Intel Xeon, family 6 model 85, 2 virtual cores, one thread, 2026-11-28, medians in turns).
//! That still counted all bins at once; counting group by group takes 0.87 of that for `gas`, 0.75 for `tower`, 1.0 for
//! the others, and on two threads 0.8 for `gas` and `tower`, 0.7 for `sizes`. For 100,000 boxes nothing is gained, and
//! for 50,000 some percent are lost. Groups of half or twice as many entries: the same.

use super::codes::Entry;
use super::grid::{Grid, Reach};
use super::{Columns, HOME_Y, HOME_Z, for_others};

/// Boxes per group, about: 128 KiB of entries, and those that these boxes have in other columns.
const A_GROUP: usize = 1 << 13;

/// Most groups.
const MOST_GROUPS: usize = 256;

/// Fewest boxes for which groups pay.
pub(super) const MANY: usize = 1 << 17;

/// Groups of bins, a power of two in each.
#[derive(Debug, Default)]
pub(super) struct Groups {
    /// Log2 of the bins per group.
    shift: u32,
    /// Entries in each group; empty where the bins themselves are counted.
    counts: Vec<u32>,
    /// Copies of the entries of one group on their way into their bins, and those bins.
    entries: Vec<Entry>,
    cells: Vec<u32>,
}

impl Groups {
    /// Lays out groups of so many bins, the one of empty boxes included, if there are `many` boxes or more.
    #[inline(always)]
    pub(super) fn begin(&mut self, bins: usize, boxes: usize, many: usize) {
        self.counts.clear();
        if boxes >= many {
            let groups = (boxes / A_GROUP).clamp(1, MOST_GROUPS);
            self.shift = bins.div_ceil(groups).next_power_of_two().trailing_zeros();
            self.counts.resize(bins.div_ceil(1 << self.shift), 0);
        }
    }

    /// The counters of groups or else of bins, and by how many bits to shift the number of a bin to index them.
    #[inline(always)]
    pub(super) fn counts<'c>(&'c mut self, bins: &'c mut [u32]) -> (&'c mut [u32], u32) {
        if self.counts.is_empty() { (bins, 0) } else { (&mut self.counts, self.shift) }
    }

    /// Counts an entry that is put into its bin at the end.
    #[inline(always)]
    pub(super) fn keep_room(&mut self, cell: u32) {
        if let Some(count) = self.counts.get_mut((cell >> self.shift) as usize) {
            *count += 1;
        }
    }

    /// Memory that is held, in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.entries.capacity() * size_of::<Entry>() + (self.counts.capacity() + self.cells.capacity()) * 4
    }
}

impl Columns {
    /// Puts every entry into its bin. The first box has place `first`.
    #[inline(always)]
    pub(crate) fn scatter(&mut self, grid: &Grid, first: u32) {
        if self.entries.len() < self.counted {
            self.entries.resize(self.counted, Entry::default());
        }
        if self.groups.counts.is_empty() {
            self.scatter_each(grid, first);
        } else {
            self.scatter_in_groups(grid, first);
        }
        let Self { records, straddlers: [.., over_more], ends, entries, .. } = self;
        for &place in &*over_more {
            let codes = records[place as usize].codes;
            for_others(&codes, grid, |cell, home| {
                put(entries, &mut ends[cell as usize], Entry { codes, place: (first + place) | home });
            });
        }
    }

    /// The first entry of every box, and the second of those in two columns, straight into their bins.
    #[inline(always)]
    fn scatter_each(&mut self, grid: &Grid, first: u32) {
        let Self { records, straddlers, ends, entries, .. } = self;
        add_up(ends, 0);
        for_entries(records, straddlers, (grid, first), |cell, entry| {
            put(entries, &mut ends[cell as usize], entry);
        });
    }

    /// The same in groups of bins.
    #[inline(always)]
    fn scatter_in_groups(&mut self, grid: &Grid, first: u32) {
        let Self { records, straddlers, ends, entries, counted, groups } = self;
        let Groups { shift, counts: next, entries: group, cells } = groups;
        add_up(next, 0);
        let mut starts = [0; MOST_GROUPS];
        starts[..next.len()].copy_from_slice(next);
        let no_box = ends.len() as u32 - 1;
        for_entries(records, straddlers, (grid, first), |cell, entry| {
            // Codes cannot represent an empty box. These are put behind all others, where they are never read.
            if cell != no_box {
                put(entries, &mut next[(cell >> *shift) as usize], entry);
            }
        });
        let (bins, none) = ends.split_at_mut(no_box as usize);
        let all = bins.chunks_mut(1 << *shift).zip(starts.iter().zip(&*next));
        for ((bins, (&start, &end)), group_number) in all.zip(0..) {
            let bin = |cell: u32| (cell - (group_number << *shift)) as usize;
            group.clear();
            cells.clear();
            for entry in &entries[start as usize..end as usize] {
                let cell = cell_of(entry, grid);
                group.push(*entry);
                cells.push(cell);
                bins[bin(cell)] += 1;
            }
            add_up(bins, start);
            for (entry, &cell) in group.iter().zip(&*cells) {
                put(entries, &mut bins[bin(cell)], *entry);
            }
        }
        none[0] = *counted as u32;
    }
}

/// Prefix sum: turns counts into where each begins, the first at `start`.
#[inline(always)]
fn add_up(counts: &mut [u32], start: u32) {
    let mut sum = start;
    for count in counts {
        sum += core::mem::replace(count, sum);
    }
}

/// Hands over the first entry of every box, then the second of those in two columns, each with its cell.
#[inline(always)]
fn for_entries(
    records: &[Entry],
    [over_y, over_z, _]: &[Vec<u32>; 3],
    (grid, first): (&Grid, u32),
    mut visit: impl FnMut(u32, Entry),
) {
    for (record, place) in records.iter().zip(first..) {
        visit(record.place, Entry { codes: record.codes, place: place | HOME_Y | HOME_Z });
    }
    let (step_y, step_z) = grid.steps();
    for (list, step, home) in [(over_y, step_y, HOME_Z), (over_z, step_z, HOME_Y)] {
        for &place in list {
            let record = &records[place as usize];
            visit(record.place + step, Entry { codes: record.codes, place: (first + place) | home });
        }
    }
}

/// The bin of an entry that is in the first column of its box, or in the next one on one axis.
#[inline(always)]
fn cell_of(entry: &Entry, grid: &Grid) -> u32 {
    let Reach { bin, y, z } = grid.reach(&entry.codes);
    let next = |home: u32| u32::from(entry.place & home == 0);
    grid.cell(y.0 + next(HOME_Y), z.0 + next(HOME_Z), bin)
}

/// Appends an entry to a bin.
#[inline(always)]
fn put(entries: &mut [Entry], end: &mut u32, entry: Entry) {
    entries[*end as usize] = entry;
    *end += 1;
}

#[cfg(test)]
mod tests {
    use crate::columns::grid::{Grid, Over};
    use crate::columns::{Columns, IN_ORDER};
    use asunder_geometry::{Aabb3, glam::Vec3};

    /// Boxes on a lattice, out of order, some of them large or empty; and how many are empty.
    fn boxes() -> (Vec<Aabb3>, usize) {
        let none = |i: u32| i % 1000 == 17;
        let boxes = (0..30_000_u32).map(|i| {
            let at = i.wrapping_mul(0x9e37_79b9) >> 17;
            let low = Vec3::new((at % 32) as f32, (at / 32 % 32) as f32, (at / 1024) as f32) * 1.3;
            let size = if i % 100 == 5 { 9.0 } else { 1.0 };
            if none(i) { Aabb3::new(low + Vec3::ONE, low) } else { Aabb3::new(low, low + Vec3::splat(size)) }
        });
        (boxes.collect(), (0..30_000_u32).filter(|&i| none(i)).count())
    }

    #[test]
    fn entries_by_groups_are_where_they_are_one_by_one() {
        let (boxes, none) = boxes();
        let pick = |place: usize| boxes[place];
        let grid = Grid::for_boxes(boxes.len(), Over::All, pick);
        let sorted = |many: usize| {
            let mut columns = Columns::default();
            columns.count_from::<_, IN_ORDER>(many, &grid, (0..boxes.len(), usize::MAX), pick);
            columns.scatter(&grid, 5);
            let entries: Vec<_> = columns.entries().iter().map(|entry| (entry.codes, entry.place)).collect();
            (columns.ends, entries)
        };
        let (one_by_one, by_groups) = (sorted(usize::MAX), sorted(0));
        let entries = one_by_one.1.len();
        assert!(
            grid.count() > 30 && entries > boxes.len() && boxes.len() > 3 * super::A_GROUP,
            "{entries} in {:?}",
            grid.columns
        );
        assert_eq!(*one_by_one.0.last().unwrap() as usize, entries + none);
        assert_eq!(one_by_one, by_groups);
    }
}
