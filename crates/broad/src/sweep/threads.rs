//! A sweep on many threads, with the same list as on one.
//!
//! ```text
//! lay out the grid                                       one thread
//! cut the boxes into parts; sort each into columns       one part per thread
//! cut the columns into groups of equal weight; gather    threads take groups
//!   the columns of a group from all parts, sweep them,
//!   and distribute the pairs into ranges of the first
//!   number (where columns are of no use: walk through a
//!   slab of space by segments in place of a group)
//! gather each range from all groups, and sort it         threads take ranges
//! ```
//! Which thread takes which part, group or range does not change the result: the list is the ranges one after the
//! other, each sorted.

use super::Admit;
use super::crowd::{Crowd, may_be_crowded};
use super::level::{Level, Scratch};
use super::order::Order;
use super::segments::{Item, Key, Slab, axes_from, in_order};
use super::settle::Question;
use crate::columns::grid::{Grid, Over};
use crate::columns::{Columns, IN_ORDER};
use crate::pair::{PairId, TooManyPairs};
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::ops::{ControlFlow, Range};
use core::sync::atomic::{AtomicUsize, Ordering};
use rayon::prelude::*;

/// With fewer boxes a second thread costs about what it saves. With 10,000 it saves a tenth to a third, in a whole
/// frame with 8,000 a twenty-fifth (`compare -- broad --threads 2`; AMD EPYC, Zen 5, 2 virtual cores, 2026-11-25; how
/// two threads are measured: see `blocks` among the benchmarks).
pub(super) const MANY_BOXES: usize = 5_000;

/// About the fewest boxes for each thread that takes part.
const BOXES_EACH: usize = 2_500;

/// Groups per thread: more than one, so that a crowded group does not hold up the rest.
const GROUPS: usize = 4;

/// Most ranges of pairs.
const RANGES: usize = 64;

/// Bins of a histogram of first numbers, from which the ranges are cut.
const BINS: usize = 1024;

/// What is kept between sweeps on many threads.
#[derive(Debug, Default)]
pub(super) struct Team {
    /// The grid of the last sweep, if that was on many threads.
    grid: Option<Grid>,
    parts: Vec<Columns>,
    groups: Vec<Group>,
    orders: Vec<Order>,
    /// Where slabs end, if the boxes are swept by segments.
    cuts: Vec<Key>,
}

impl Clone for Team {
    fn clone(&self) -> Self {
        let mut copy = Self::default();
        copy.clone_from(self);
        copy
    }

    /// Copies the columns of the last sweep, if that was on many threads; all else is scratch memory.
    fn clone_from(&mut self, source: &Self) {
        self.grid = source.grid;
        if source.grid.is_some() {
            self.parts.clone_from(&source.parts);
        }
    }
}

/// Columns that one thread sweeps in one go.
#[derive(Debug, Default)]
struct Group {
    columns: Range<usize>,
    scratch: Scratch,
    found: Vec<PairId>,
    counts: Vec<u32>,
    /// The pairs distributed into ranges, and where each range ends.
    thrown: Vec<PairId>,
    ends: Vec<usize>,
}

impl Team {
    pub(super) fn bytes(&self) -> usize {
        let groups = self.groups.iter().map(|group| {
            group.scratch.bytes()
                + (group.found.capacity() + group.thrown.capacity()) * size_of::<PairId>()
                + group.counts.capacity() * 4
                + group.ends.capacity() * 8
        });
        self.parts.iter().map(Columns::bytes).sum::<usize>()
            + groups.sum::<usize>()
            + self.orders.iter().map(Order::bytes).sum::<usize>()
            + self.cuts.capacity() * size_of::<Key>()
    }

    pub(super) fn sorted(&self) -> Option<(&Grid, &[Columns])> {
        Some((self.grid.as_ref()?, &self.parts))
    }

    /// Merges the columns of all parts into one piece, and hands them over with their grid.
    pub(super) fn put_together(&mut self, into: &mut Columns) -> Option<Grid> {
        let grid = self.grid.take()?;
        into.gather_all(&self.parts, &grid);
        Some(grid)
    }

    /// Notes that the last sweep was not on many threads.
    pub(super) fn forget(&mut self) {
        self.grid = None;
    }

    /// Finds all pairs, sorted, on as many threads of the current pool as are worth it.
    pub(super) fn pairs<B: Bounds>(
        &mut self,
        boxes: &[B],
        (admit, limit): (&Admit, usize),
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        let threads = rayon::current_num_threads().min(boxes.len() / BOXES_EACH).max(1);
        self.parts.resize_with(threads, Columns::default);
        self.groups.resize_with(threads * GROUPS, Group::default);
        let grid = sort(&mut self.parts, boxes);
        self.grid = Some(grid);
        share_out(&mut self.groups, &self.parts, &grid);
        let cuts = &mut self.cuts;
        cuts.clear();
        if is_crowded(&mut self.groups, &self.parts, boxes.len(), &grid) {
            cut_into_slabs(cuts, boxes, (axes_from::<B>(grid.sweep).0[0], self.groups.len()));
        }

        let total = AtomicUsize::new(0);
        let parts = &self.parts;
        let cuts = &self.cuts;
        self.groups.par_iter_mut().enumerate().for_each(|(number, group)| {
            let slab = cuts.get(number..number + 2).map(|ends| Slab { start: ends[0], end: ends[1] });
            group.sweep((parts, &grid), slab, (boxes, admit), (&total, limit));
        });
        let total = total.into_inner();
        pairs.clear();
        if total > limit {
            return Err(TooManyPairs { limit });
        }

        let ranges = (threads * GROUPS).min(RANGES);
        let (range_of, sizes) = ranges_of_first(&self.groups, ranges, total);
        self.groups.par_iter_mut().for_each(|group| group.throw(&range_of, ranges, boxes.len()));
        pairs.resize(total, PairId { a: 0, b: 0 });
        self.orders.resize_with(ranges, Order::default);
        let ordering = Ordered { groups: &self.groups, sizes: &sizes[..ranges], count: boxes.len() };
        ordering.write(0..ranges, pairs, &mut self.orders);
        Ok(())
    }
}

/// Sorts all boxes into columns, one part per thread.
fn sort<B: Bounds>(parts: &mut [Columns], boxes: &[B]) -> Grid {
    let each = boxes.len().div_ceil(parts.len().max(1));
    let places = |part: usize| (part * each).min(boxes.len())..((part + 1) * each).min(boxes.len());
    let mut grid = Grid::for_boxes(boxes.len(), Over::All, |place| boxes[place]);
    loop {
        let count = |(index, part): (usize, &mut Columns)| {
            widest(Count { part, grid: &grid, boxes, places: places(index) });
        };
        parts.par_iter_mut().enumerate().for_each(count);
        let entries: usize = parts.iter().map(Columns::counted).sum();
        if entries <= grid.most_entries(boxes.len()) {
            break;
        }
        grid = grid.coarser();
    }
    let scatter = |(index, part): (usize, &mut Columns)| {
        widest(Scatter { part, grid: &grid, first: places(index).start as u32 });
    };
    parts.par_iter_mut().enumerate().for_each(scatter);
    grid
}

/// The first half of sorting a part.
struct Count<'a, B> {
    part: &'a mut Columns,
    grid: &'a Grid,
    boxes: &'a [B],
    places: Range<usize>,
}

impl<B: Bounds> Kernel for Count<'_, B> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, _: W) {
        let most = self.grid.most_entries(self.boxes.len());
        self.part.count::<_, IN_ORDER>(self.grid, (self.places, most), |place| self.boxes[place]);
    }
}

/// The second half of sorting a part.
struct Scatter<'a> {
    part: &'a mut Columns,
    grid: &'a Grid,
    first: u32,
}

impl Kernel for Scatter<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, _: W) {
        self.part.scatter(self.grid, self.first);
    }
}

/// Cuts the columns into groups of about equally many entries.
fn share_out(groups: &mut [Group], parts: &[Columns], grid: &Grid) {
    let entries: usize = parts.iter().map(Columns::len).sum();
    let count = groups.len();
    let (mut index, mut before) = (0, 0);
    for (number, group) in (1..).zip(groups) {
        let start = index;
        while index < grid.count() && (number == count || before * count < entries * number) {
            before += parts.iter().map(|part| part.column(grid, index).entries.len()).sum::<usize>();
            index += 1;
        }
        group.columns = start..index;
    }
}

/// Whether all columns are so full that a walk by segments is better.
fn is_crowded(groups: &mut [Group], parts: &[Columns], boxes: usize, grid: &Grid) -> bool {
    let entries = parts.iter().map(Columns::len).sum();
    let count = |group: &mut Group| {
        let columns = group.columns.clone();
        columns
            .fold(Crowd::default(), |crowd, index| crowd.and(&group.scratch.gather(parts, grid, index), grid))
    };
    may_be_crowded(boxes, entries, grid)
        && groups.par_iter_mut().map(count).reduce(Crowd::default, Crowd::with).is_worth_segments(boxes, grid)
}

/// Boxes sampled per slab.
const LOOKS: usize = 32;

/// Finds where to cut space along an axis so that about equally many boxes begin in every slab.
fn cut_into_slabs<B: Bounds>(cuts: &mut Vec<Key>, boxes: &[B], (axis, slabs): (usize, usize)) {
    let looks = (slabs * LOOKS) as u64;
    let sample = (0..looks).map(|look| (look * boxes.len() as u64 / looks) as u32);
    let item = |place: u32| Item::new(boxes.get(place as usize)?, place);
    cuts.extend(sample.filter_map(item).map(|item| item.key(axis)));
    cuts.sort_unstable_by(in_order);
    let count = cuts.len();
    for slab in 1..slabs.min(count) {
        cuts[slab] = cuts[slab * count / slabs];
    }
    // The outermost slabs are unbounded; where the sample is short, the last ones are empty.
    cuts.resize(slabs + 1, Slab::ALL.end);
    (cuts[0], cuts[slabs]) = (Slab::ALL.start, Slab::ALL.end);
}

impl Group {
    fn sweep<B: Bounds>(
        &mut self,
        (parts, grid): (&[Columns], &Grid),
        slab: Option<Slab>,
        (boxes, admit): (&[B], &Admit),
        (total, limit): (&AtomicUsize, usize),
    ) {
        let Self { columns, scratch, found, counts, .. } = self;
        found.clear();
        let mut sink = |pairs: &mut [PairId]| {
            let admitted = admit(pairs);
            found.extend_from_slice(&pairs[..admitted]);
            let all = total.fetch_add(admitted, Ordering::Relaxed) + admitted;
            if all > limit { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let range = columns.clone();
        let question = &mut Question { boxes, sink: &mut sink };
        // It only breaks off at too many pairs, which `total` shows.
        let _ = match slab {
            Some(slab) => question.ask_all(&mut scratch.segments, (grid.sweep, slab)),
            None => widest(Level::<_, false> { parts, grid, range, question, scratch, around: (None, 0) }),
        };
        counts.clear();
        counts.resize(BINS, 0);
        for pair in found.iter() {
            counts[bin_of(pair.a, boxes.len())] += 1;
        }
    }

    /// Distributes the pairs into ranges.
    fn throw(&mut self, range_of: &[u8; BINS], ranges: usize, boxes: usize) {
        let Self { found, thrown, ends, counts, .. } = self;
        ends.clear();
        ends.resize(ranges, 0);
        for (&count, &range) in counts.iter().zip(range_of) {
            ends[usize::from(range)] += count as usize;
        }
        let mut sum = 0;
        for end in ends.iter_mut() {
            sum += core::mem::replace(end, sum);
        }
        thrown.resize(found.len(), PairId { a: 0, b: 0 });
        for pair in found.iter() {
            let end = &mut ends[usize::from(range_of[bin_of(pair.a, boxes)])];
            thrown[*end] = *pair;
            *end += 1;
        }
    }

    fn range(&self, range: usize) -> &[PairId] {
        let start = if range == 0 { 0 } else { self.ends[range - 1] };
        &self.thrown[start..self.ends[range]]
    }
}

fn bin_of(first: u32, boxes: usize) -> usize {
    (u64::from(first) * BINS as u64 / boxes.max(1) as u64) as usize
}

/// The range of each bin of first numbers, and the number of pairs in each range: about the same for all.
fn ranges_of_first(groups: &[Group], ranges: usize, total: usize) -> ([u8; BINS], [usize; RANGES]) {
    let (mut range_of, mut sizes) = ([0; BINS], [0; RANGES]);
    let (mut range, mut before) = (0, 0);
    for (bin, of) in range_of.iter_mut().enumerate() {
        while range + 1 < ranges && before * ranges >= total * (range + 1) {
            range += 1;
        }
        let count: usize = groups.iter().map(|group| group.counts[bin] as usize).sum();
        *of = range as u8;
        sizes[range] += count;
        before += count;
    }
    (range_of, sizes)
}

/// The pairs of all groups, about to be written into one list.
struct Ordered<'a> {
    groups: &'a [Group],
    sizes: &'a [usize],
    count: usize,
}

impl Ordered<'_> {
    /// Writes some ranges, by halves on several threads.
    fn write(&self, ranges: Range<usize>, pairs: &mut [PairId], orders: &mut [Order]) {
        match orders {
            [] => {}
            [order] => {
                let mut rest = &mut *pairs;
                for group in self.groups {
                    let piece = group.range(ranges.start);
                    let (here, after) = rest.split_at_mut(piece.len());
                    here.copy_from_slice(piece);
                    rest = after;
                }
                order.sort(pairs, self.count);
            }
            several => {
                let half = several.len() / 2;
                let middle = ranges.start + half;
                let size: usize = self.sizes[ranges.start..middle].iter().sum();
                let (low, high) = pairs.split_at_mut(size);
                let (orders_low, orders_high) = several.split_at_mut(half);
                rayon::join(
                    || self.write(ranges.start..middle, low, orders_low),
                    || self.write(middle..ranges.end, high, orders_high),
                );
            }
        }
    }
}
