//! A counting sort of boxes into columns and, within a column, into bins along the sweep axis.

pub(crate) mod codes;
pub(crate) mod grid;
mod parts;
mod scatter;
mod shown;

pub use shown::Column;

use crate::sweep::trial::note;
use crate::width::{Kernel, Width};
use asunder_geometry::Bounds;
use codes::{Codes, Entry};
use core::ops::Range;
use grid::{Grid, Reach};
use scatter::{Groups, MANY};

/// The entries of boxes, column by column, and in each by the bin of their minimum on the sweep axis. A box has an
/// entry in every column that it reaches.
#[derive(Debug, Default)]
pub(crate) struct Columns {
    /// Every box once, in the order of the input. `place` holds the cell of its first entry here.
    records: Vec<Entry>,
    /// Boxes that reach exactly one more column on the first axis, on the second, and all others in more than one
    /// column.
    straddlers: [Vec<u32>; 3],
    /// Where each bin of each column ends in `entries`.
    ends: Vec<u32>,
    entries: Vec<Entry>,
    /// Entries counted, those of empty boxes included.
    counted: usize,
    groups: Groups,
}

asunder_geometry::copied!(Columns, { records, straddlers, ends, entries, counted } but { groups });

impl Columns {
    /// The entries of a column, and where its bins end.
    #[inline(always)]
    pub(crate) fn column(&self, grid: &Grid, index: usize) -> ColumnEntries<'_> {
        let bins = 1 << grid.bin_bits;
        let ends = &self.ends[index * bins..(index + 1) * bins];
        let start = if index == 0 { 0 } else { self.ends[index * bins - 1] };
        let end = ends.last().copied().unwrap_or(start);
        ColumnEntries { start, ends, entries: &self.entries[start as usize..end as usize] }
    }

    /// Which entries a box may overlap, going by bins: one stretch for each column that it reaches. `longest` is how
    /// many bins the entries reach beyond their first at most, not counting boxes that are kept elsewhere.
    #[inline(always)]
    pub(crate) fn stretches(&self, grid: &Grid, codes: &Codes, longest: u32, mut visit: impl FnMut(Stretch)) {
        let Reach { bin, y, z } = grid.reach(codes);
        let last = grid.bin(codes[grid.sweep + 3]) as u32;
        let early = |bin: u32| bin.saturating_sub(longest);
        for row in y.0..=y.1 {
            for column in z.0..=z.1 {
                let cells = [early(bin), early(last)].map(|bin| grid.cell(row, column, bin));
                let start = (cells[0] as usize).checked_sub(1).map_or(0, |before| self.ends[before]);
                let end = self.ends[grid.cell(row, column, last) as usize];
                visit(Stretch { start, end, cells, home: home(row == y.0, column == z.0) });
            }
        }
    }

    /// All entries, in order of the columns.
    pub(crate) fn entries(&self) -> &[Entry] {
        &self.entries[..self.len()]
    }

    /// Entries that were counted, before they are sorted.
    #[cfg(feature = "parallel")]
    pub(crate) const fn counted(&self) -> usize {
        self.counted
    }

    /// Entries in all columns.
    pub(crate) fn len(&self) -> usize {
        // Empty boxes are in an extra bin behind the last column.
        self.ends.len().checked_sub(2).map_or(0, |last| self.ends[last] as usize)
    }

    /// Candidates in all columns.
    pub(crate) fn candidates(&self, grid: &Grid) -> usize {
        (0..grid.count()).map(|index| self.column(grid, index).candidates(grid)).sum()
    }

    /// Memory that is held, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        (self.records.capacity() + self.entries.capacity()) * size_of::<Entry>()
            + (self.ends.capacity() + self.straddlers.iter().map(Vec::capacity).sum::<usize>()) * 4
            + self.groups.bytes()
    }

    /// The first half of sorting: makes the record of every box at `places`, and counts the entries of every bin (of
    /// every group of bins, for many boxes).
    ///
    /// There are no branches on where a box lies: whether it straddles would be mispredicted for every fifth box (1.5
    /// ns per box, Zen 4, 2026-11-21).
    ///
    /// Boxes are read in batches of `AHEAD` before the work on them: see [`SCATTERED`].
    ///
    /// Once there are more than `most` entries, counting stops: giants that the sample missed would have one in every
    /// column.
    #[inline(always)]
    pub(crate) fn count<B: Bounds, const AHEAD: usize>(
        &mut self,
        grid: &Grid,
        (places, most): (Range<usize>, usize),
        pick: impl Fn(usize) -> B,
    ) {
        self.count_from::<B, AHEAD>(MANY, grid, (places, most), pick);
    }

    /// The same, with the number of boxes from which on bins are grouped.
    #[inline(always)]
    fn count_from<B: Bounds, const AHEAD: usize>(
        &mut self,
        many: usize,
        grid: &Grid,
        (places, most): (Range<usize>, usize),
        pick: impl Fn(usize) -> B,
    ) {
        let cells = grid.count() << grid.bin_bits;
        let no_box = cells as u32;
        self.ends.clear();
        // One more, for empty boxes.
        self.ends.resize(cells + 1, 0);
        self.groups.begin(self.ends.len(), places.len(), many);
        self.records.resize(places.len(), Entry::default());
        let Self { records, straddlers: [over_y, over_z, over_more], ends, groups, .. } = self;
        let (counts, shift) = groups.counts(ends);
        for list in [&mut *over_y, &mut *over_z, &mut *over_more] {
            list.resize(places.len(), 0);
        }
        let [mut count_y, mut count_z, mut count_more] = [0; 3];
        let mut corners = [([0.0; 3], [0.0; 3]); AHEAD];
        let mut place = 0;
        for records in records.chunks_mut(AHEAD) {
            let first = places.start + place as usize;
            for (at, corners) in (first..first + records.len()).zip(&mut corners) {
                *corners = pick(at).corners();
            }
            for (record, &(low, high)) in records.iter_mut().zip(&corners) {
                let is_box = (low[0] <= high[0]) & (low[1] <= high[1]) & (low[2] <= high[2]);
                let codes = grid.quantiser.codes(low, high);
                let reach = grid.reach(&codes);
                let cell = if is_box { grid.cell(reach.y.0, reach.z.0, reach.bin) } else { no_box };
                *record = Entry { codes, place: cell };
                counts[(cell >> shift) as usize] += 1;
                // Wraps for an inverted box, which ends before it begins: that is empty, and not counted.
                let (more_y, more_z) = (reach.y.1.wrapping_sub(reach.y.0), reach.z.1.wrapping_sub(reach.z.0));
                let is_over_y = is_box & (more_y == 1) & (more_z == 0);
                let is_over_z = is_box & (more_z == 1) & (more_y == 0);
                over_y[count_y] = place;
                count_y += usize::from(is_over_y);
                over_z[count_z] = place;
                count_z += usize::from(is_over_z);
                over_more[count_more] = place;
                count_more += usize::from(is_box & (more_y | more_z != 0) & !is_over_y & !is_over_z);
                place += 1;
            }
        }
        over_y.truncate(count_y);
        over_z.truncate(count_z);
        over_more.truncate(count_more);
        self.count_others(grid, most);
    }

    /// Counts the entries of boxes in all columns that they reach except the first.
    #[inline(always)]
    fn count_others(&mut self, grid: &Grid, most: usize) {
        let Self { records, straddlers: [over_y, over_z, over_more], ends, groups, .. } = self;
        let (step_y, step_z) = grid.steps();
        let mut total = records.len() + over_y.len() + over_z.len();
        let (counts, shift) = groups.counts(ends);
        for (list, step) in [(over_y, step_y), (over_z, step_z)] {
            for &place in &*list {
                counts[((records[place as usize].place + step) >> shift) as usize] += 1;
            }
        }
        for &place in &*over_more {
            if total > most {
                break;
            }
            let codes = records[place as usize].codes;
            total += for_others(&codes, grid, |cell, _| {
                // These bypass the groups: they are counted in their bin, and room is reserved in their group.
                ends[cell as usize] += 1;
                groups.keep_room(cell);
            });
        }
        note(total);
        self.counted = total;
    }
}

/// How many boxes to read at a time where they are contiguous, and prefetched by the hardware anyway.
pub(crate) const IN_ORDER: usize = 1;

/// The same where they are scattered over memory: a loop that does nothing but read has many cache misses in flight. A
/// million boxes of `islands`, whose columns are swept in columns of their own, take 0.62 of the time; contiguous boxes
/// would take 1.02 (Intel Xeon, family 6 model 85, one thread, 2026-11-28).
pub(crate) const SCATTERED: usize = 32;

/// Sorts `count` boxes, which `pick` gives by their places. Returns the grid that was used: coarser than the given one
/// if that would give boxes too many entries.
pub(crate) struct Fill<'a, P, const AHEAD: usize> {
    pub(crate) columns: &'a mut Columns,
    pub(crate) grid: Grid,
    pub(crate) count: usize,
    pub(crate) pick: P,
}

impl<B: Bounds, P: Fn(usize) -> B, const AHEAD: usize> Kernel for Fill<'_, P, AHEAD> {
    type Output = Grid;

    #[inline(always)]
    fn run<W: Width>(self, _: W) -> Grid {
        let Self { columns, mut grid, count, pick } = self;
        loop {
            let most = grid.most_entries(count);
            columns.count::<_, AHEAD>(&grid, (0..count, most), &pick);
            if columns.counted <= most {
                break;
            }
            grid = grid.coarser();
        }
        columns.scatter(&grid, 0);
        grid
    }
}

/// Flags in the place of an entry: the box begins in this column on the first column axis, and on the second.
const HOME_Y: u32 = 1 << 30;
const HOME_Z: u32 = 1 << 31;

/// The place of the box of an entry, if the box begins in this column on both axes: true of one entry of every box.
#[inline(always)]
pub(crate) const fn begins(place: u32) -> Option<u32> {
    if place >> 30 == 3 { Some(place & PLACE) } else { None }
}

/// The flags of a place.
#[inline(always)]
const fn home(on_y: bool, on_z: bool) -> u32 {
    (if on_y { HOME_Y } else { 0 }) | (if on_z { HOME_Z } else { 0 })
}

/// Some entries of one column that a box may overlap.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Stretch {
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// The cell with which it starts, and the last cell with which the stretch of a box that begins within this one can
    /// start.
    pub(crate) cells: [u32; 2],
    /// Whether the box begins in this column, as flags of a place.
    pub(crate) home: u32,
}

/// The bits of a place that hold the place itself, without flags.
pub(crate) const PLACE: u32 = HOME_Y - 1;

/// Most boxes of one sweep, so that their entries, at most four each on average, can be counted in 32 bits.
pub(crate) const MOST_BOXES: usize = 1 << 29;

/// The places of two boxes that overlap in a column, and whether the column owns the pair: it does if it contains the
/// greater of their minima on both axes, so that on each axis one of them begins here.
#[inline(always)]
pub(crate) const fn owned(one: u32, other: u32) -> (u32, u32, bool) {
    (one & PLACE, other & PLACE, (one | other) >> 30 == 3)
}

/// One column.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ColumnEntries<'a> {
    pub(crate) start: u32,
    pub(crate) ends: &'a [u32],
    pub(crate) entries: &'a [Entry],
}

impl ColumnEntries<'_> {
    /// Where the candidates of a box end: behind the last bin that it reaches.
    #[inline(always)]
    pub(crate) fn row_end(&self, codes: &Codes, grid: &Grid) -> usize {
        (self.ends[grid.bin(codes[grid.sweep + 3])] - self.start) as usize
    }

    /// Boxes in the fullest bin.
    #[inline(always)]
    pub(crate) fn fullest_bin(&self) -> usize {
        let mut fullest = self.ends[0] - self.start;
        for pair in self.ends.windows(2) {
            fullest = fullest.max(pair[1] - pair[0]);
        }
        fullest as usize
    }

    /// Candidates of all boxes in it.
    pub(crate) fn candidates(&self, grid: &Grid) -> usize {
        let rows = (1..).zip(self.entries);
        rows.map(|(next, entry)| self.row_end(&entry.codes, grid).saturating_sub(next)).sum()
    }
}

/// Hands over the cells of a box in all columns that it reaches except the first; returns how many.
#[inline(always)]
fn for_others(codes: &Codes, grid: &Grid, mut visit: impl FnMut(u32, u32)) -> usize {
    let Reach { bin, y, z } = grid.reach(codes);
    let mut count = 0;
    for row in y.0..=y.1 {
        for column in z.0..=z.1 {
            if count > 0 {
                visit(grid.cell(row, column, bin), home(row == y.0, column == z.0));
            }
            count += 1;
        }
    }
    count - 1
}
