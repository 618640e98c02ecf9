//! The second half of sorting boxes into columns: every entry into its bin.
//!
//! ```text
//! few entries:   each into its bin
//! many:          the bins in groups of as many, each of which fits a near cache:
//!                each entry into its group, in the order in which it comes
//!                of each group, each entry into its bin
//! ```
//! Boxes come in any order, and where many are spread over much memory, each entry waits for a line and a page of its
//! own. Groups are few enough for one line of each to stay near. Both ways keep the order in which entries come, and so
//! give the same.
//!
//! A whole sweep of a million boxes, pairs sorted, takes 0.69 of the time for `gas`, 0.7 for `sizes` and `tower`, 0.9
//! for `pile` (Intel Xeon, family 6 model 85, 2 virtual cores, one thread, 2026-11-28, medians in turns). Of 100,000
//! boxes nothing is gained, and of 50,000 some percent are lost. Groups of half or twice as many entries: the same.

use super::codes::Entry;
use super::grid::{Grid, Reach};
use super::{Columns, HOME_Y, HOME_Z, for_others};

/// Entries that a group holds, about: 128 KiB of them.
const A_GROUP: usize = 1 << 13;

/// Most groups.
const MOST_GROUPS: usize = 256;

/// Fewest entries that are worth groups.
const MANY: usize = 1 << 17;

impl Columns {
    /// Puts every entry into its bin. The places are counted from `first`.
    #[inline(always)]
    pub(crate) fn scatter(&mut self, grid: &Grid, first: u32) {
        self.scatter_if(grid, first, MANY);
    }

    /// The same, where so many entries are worth groups.
    #[inline(always)]
    fn scatter_if(&mut self, grid: &Grid, first: u32, many: usize) {
        let mut sum = 0;
        for end in &mut self.ends {
            sum += core::mem::replace(end, sum);
        }
        if self.entries.len() < self.counted {
            self.entries.resize(self.counted, Entry::default());
        }
        if self.counted < many {
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

    /// All but those of boxes that reach more than two columns.
    #[inline(always)]
    fn scatter_each(&mut self, grid: &Grid, first: u32) {
        let Self { records, straddlers, ends, entries, .. } = self;
        for_entries(records, straddlers, (grid, first), |cell, entry| {
            put(entries, &mut ends[cell as usize], entry);
        });
    }

    /// The same in groups of bins.
    #[inline(always)]
    fn scatter_in_groups(&mut self, grid: &Grid, first: u32) {
        let Self { records, straddlers, ends, entries, counted, group } = self;
        let groups = (*counted / A_GROUP).clamp(1, MOST_GROUPS);
        let shift = ends.len().div_ceil(groups).next_power_of_two().trailing_zeros();
        let mut starts = [0; MOST_GROUPS];
        for (start, first) in starts.iter_mut().zip(ends.iter().step_by(1 << shift)) {
            *start = *first;
        }
        let (mut next, no_box, mut none) = (starts, ends.len() as u32 - 1, 0);
        for_entries(records, straddlers, (grid, first), |cell, entry| {
            // No codes tell that a box is none. They stand behind all others, where nobody looks.
            if cell == no_box {
                none += 1;
            } else {
                put(entries, &mut next[(cell >> shift) as usize], entry);
            }
        });
        for (&start, &end) in starts.iter().zip(&next) {
            group.clear();
            group.extend_from_slice(&entries[start as usize..end as usize]);
            for entry in &*group {
                put(entries, &mut ends[cell_of(entry, grid) as usize], *entry);
            }
        }
        ends[no_box as usize] += none;
    }
}

/// Hands over the entries of all boxes but those that reach more than two columns, each with its cell: first those where
/// they begin.
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

/// The bin of an entry that is in the first column of its box, or in the next on one axis.
#[inline(always)]
fn cell_of(entry: &Entry, grid: &Grid) -> u32 {
    let Reach { bin, y, z } = grid.reach(&entry.codes);
    let next = |home: u32| u32::from(entry.place & home == 0);
    grid.cell(y.0 + next(HOME_Y), z.0 + next(HOME_Z), bin)
}

/// Puts an entry where others end.
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

    /// Boxes on a lattice, out of order, some of them large or none; so many of these.
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
            columns.count::<_, IN_ORDER>(&grid, (0..boxes.len(), usize::MAX), pick);
            columns.scatter_if(&grid, 5, many);
            let entries: Vec<_> = columns.entries().iter().map(|entry| (entry.codes, entry.place)).collect();
            (columns.ends, entries)
        };
        let (one_by_one, by_groups) = (sorted(usize::MAX), sorted(0));
        let entries = one_by_one.1.len();
        assert!(
            grid.count() > 30 && entries > boxes.len() && entries > 4 * super::A_GROUP,
            "{entries} in {:?}",
            grid.columns
        );
        assert_eq!(*one_by_one.0.last().unwrap() as usize, entries + none);
        assert_eq!(one_by_one, by_groups);
    }
}
