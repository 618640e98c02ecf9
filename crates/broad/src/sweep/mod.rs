//! Sweep and prune in columns: finds all overlapping pairs of boxes, without any history.
//!
//! ```text
//! sample a few boxes: where are they, how large, how crowded?                        columns/grid
//! sweep along the axis on which boxes are smallest, lay columns over the other two
//! quantise every bound to a code of 16 bits, monotonically                           columns/codes
//! counting sort of the boxes into columns and, within a column, into bins along
//!   the sweep axis; a box that straddles columns goes into each of them              columns
//! a column that is far too full is swept in columns of its own                       level
//! where columns do not help, in one column or in all: a walk of bounded cost         crowd, segments
//! for each column, each box in order: test it against the boxes after it, sixteen
//!   at a time, up to the bin in which it ends; on all three axes, by codes           rows
//! for each hit: does this column own the pair (hold the greater of both minima on
//!   both column axes)? if two codes are equal, test the boxes; ask the filter        settle
//! radix sort of the pairs                                                            order
//! ```
//! Codes are monotone: a lesser code proves a lesser bound, so only where codes are equal must the boxes be compared (1
//! pair in 100). The owner rule, which works on codes too, picks exactly one column for every pair: no pair is found
//! twice and none is lost.
//!
//! Baraff's sweep and prune (1992) in the cells of a regular grid, after Terdiman, "Box pruning revisited" (2017), for
//! the wide tests on integers; Tracy, Buss & Woods, "Efficient large-scale sweep and prune methods with AABB insertion
//! and removal" (2009), for the segmentation. Cost: linear in boxes and pairs where boxes are of similar size; widely
//! different sizes cost more entries per box. By [`segments`], no scene costs more than n log^3 n + pairs, except that
//! a pair may be found in every column that both of its boxes share.
//!
//! # What each technique bought
//! Total ns per box for 10,000 boxes of `gas` and `pile`, AMD EPYC (Zen 4), one thread, 2026-11-21; the plain sweep
//! takes 1,240.
//!
//! | technique | gas | pile |
//! |---|---|---|
//! | columns, sixteen lanes of SSE2, counting sorts, pairs sorted by first number and then by insertion | 42.6 | 175 |
//! | 1. the sweep compiled for AVX2 as well | 37.2 | 126 |
//! | 2. whole entries (16 bytes) beside the strips, so that a hit loads one cache line and not twelve | 33.0 | 110 |
//! | 3. one counting sort by column and bin, not two; sweep, owner and filter in three branchless passes | 31.2 | 103 |
//! | 4. one pass for codes, columns and counts; the mask of lanes by one instruction | 29.4 | 101 |
//! | 5. lists of boxes that straddle on one axis, the other, both: no branch per box | 28.4 | 98 |
//! | 6. radix sort of the pairs, instead of a sort of runs | 28.4 | 80 |
//! | 7. owner rule in two bits of the place; equal codes found in the lanes; one box of a hit per round | 28.6 | 77 |
//!
//! Tried without gain: bins for a quarter or for all of the boxes (1 %); sorting runs of pairs by rank in eight lanes
//! (15 ns per pair in sparse scenes, against 6); AVX-512 (0 to 2 %); counting compiled once for each sweep axis (0 to 3
//! %); codes and bins of a box in hand-written AVX2, half the instructions (6 % slower).
//!
//! 8. Segments, wherever comparing the candidates in the columns would cost more. The named scenes do not change. The
//!    table gives ns per box and, in brackets, the ratio to a budget of 80 ns per box and 20 per pair, by `compare --
//!    broad --hurt` (AMD EPYC, Zen 4, 2 virtual cores, one thread, 2026-11-22; the "before" of quarters, and of halves
//!    at 300,000, come from a run of their own):
//!
//! | boxes | 30,000 before | after | 100,000 before | after | 300,000 before | after |
//! |---|---|---|---|---|---|---|
//! | needles along all axes | 473 (5.8) | 401 (4.9) | 1,967 (24) | 943 (12) | 3,912 (48) | 1,337 (16) |
//! | needles of all lengths | 65 (0.8) | 68 (0.9) | 112 (1.4) | 113 (1.4) | 191 (2.4) | 191 (2.4) |
//! | clumps shrinking by halves | 1,026 (6.5) | 911 (5.8) | 1,948 (16) | 633 (5.2) | 5,732 (41) | 950 (6.8) |
//! | by quarters | 15,422 (100) | 408 (2.7) | 63,259 (562) | 414 (3.7) | - | 748 (5.7) |
//! | by thousandths | 359 (3.7) | 295 (3.1) | 270 (3.0) | 310 (3.5) | 360 (3.7) | 440 (4.6) |
//! | scattered by logarithms | 1,107 (14) | 113 (1.4) | 408 (5.1) | 157 (2.0) | 640 (8.0) | 224 (2.8) |
//! | lines without end | 280 (3.5) | 191 (2.4) | 430 (5.3) | 413 (5.1) | 770 (9.6) | 430 (5.3) |
//! | floors, 44 pairs a box | 1,085 (1.1) | 1,096 (1.1) | 1,377 (1.4) | 1,703 (1.8) | 1,737 (1.8) | 1,820 (1.9) |
//!
//! Tried: segments from the start, without columns (30,000 needles take 1.7 times as long as in columns, floors 2.5
//! times); segments at once in any column that is full (thousandths take 1.6 times as long). Where clumps are a
//! thousand times smaller than what surrounds them, nesting columns without a limit takes 0.8 times as long, up to
//! 300,000 boxes. Needles stay over budget: they cost a logarithm per axis. The machine was under load; both ways were
//! measured in turns.
//!
//! 9. Where entries or pairs are more than a near cache holds: entries go into groups of bins first and then into bins,
//!    and pairs into buckets before the radix sort. A million boxes of `gas` take 112 ns per box in place of 182, of
//!    `pile` 241 in place of 334, and 100,000 of `pile` 184 in place of 221 (Intel Xeon, family 6 model 85, 2 virtual
//!    cores, one thread, 2026-11-28, medians in turns).
//! 10. Where a column is swept in columns of its own, its boxes are scattered over memory, so they are read in batches
//!     ahead of the work on them: a million boxes of `islands` take 157 ns per box in place of 254 (the same machine
//!     and day).

mod compiled;
mod crowd;
pub(crate) mod level;
pub(crate) mod order;
pub(crate) mod rows;
mod segments;
mod settle;
#[cfg(test)]
mod tests;
#[cfg(feature = "parallel")]
mod threads;
pub(crate) mod trial;
pub(crate) mod wide;

use crate::columns::grid::{Grid, Over};
use crate::columns::{Column, Columns, Fill, IN_ORDER, MOST_BOXES};
use crate::pair::{PairId, TooManyPairs};
use crate::width::widest;
use asunder_geometry::Bounds;
use core::ops::ControlFlow;
use crowd::{Crowd, may_be_crowded};
use level::{Level, Scratch};
use segments::Slab;
use settle::{Question, Sink};

/// The pair filter, applied to many pairs at a time: moves the admitted ones to the front, and returns how many they
/// are.
pub(crate) type Admit<'f> = dyn Fn(&mut [PairId]) -> usize + Sync + 'f;

/// Turns a filter of single pairs into an [`Admit`].
pub(crate) fn keep(pairs: &mut [PairId], admit: impl Fn(u32, u32) -> bool) -> usize {
    let mut admitted = 0;
    for place in 0..pairs.len() {
        let pair = pairs[place];
        // Written unconditionally: the branch would be unpredictable.
        pairs[admitted] = pair;
        admitted += usize::from(admit(pair.a, pair.b));
    }
    admitted
}

/// Finds all overlapping pairs of boxes. Keep one between frames: a steady scene then allocates nothing.
///
/// However the boxes lie, the cost is O(n log^3 n + pairs), where a pair counts once for every column that both of its
/// boxes share.
///
/// It holds no history: the list depends on the boxes and the filter alone, and is the same at any thread count and
/// vector width. In [`Sweep::pairs`], from 5,000 boxes on, the threads of the current rayon pool share the work
/// (feature `parallel`).
///
/// ```
/// use asunder_broad::{PairId, Sweep};
/// use asunder_geometry::{Aabb3, glam::Vec3};
/// use core::ops::ControlFlow;
///
/// let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 3];
/// let mut sweep = Sweep::new();
/// let mut pairs = Vec::new();
/// sweep.pairs(&boxes, |a, _| a != 0, usize::MAX, &mut pairs)?;
/// assert_eq!(pairs, [PairId { a: 1, b: 2 }], "the filter dropped every pair of box 0");
///
/// let mut count = 0;
/// let _ = sweep.visit(&boxes, |_, _| true, |_| {
///     count += 1;
///     ControlFlow::Continue(())
/// });
/// assert_eq!(count, 3);
/// # Ok::<(), asunder_broad::TooManyPairs>(())
/// ```
#[derive(Debug, Default)]
pub struct Sweep {
    columns: Columns,
    /// The grid of the last sweep.
    grid: Option<Grid>,
    scratch: Scratch,
    order: order::Order,
    #[cfg(feature = "parallel")]
    team: threads::Team,
}

asunder_geometry::copied!(Sweep, { columns, grid, #[cfg(feature = "parallel")] team } but { scratch, order });

impl Sweep {
    /// A sweep without scratch memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
    ///
    /// `admit` is asked once for each pair of overlapping boxes, the smaller number first, in any order and from any
    /// thread: bit tests on layers and owners belong here. Boxes beyond the first 2^29 are ignored. Cost: some 30 ns
    /// per box and 10 ns per pair.
    ///
    /// # Errors
    /// More than `limit` admitted pairs. `pairs` is then empty.
    pub fn pairs<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: impl Fn(u32, u32) -> bool + Sync,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        self.pairs_by(boxes, &|pairs| keep(pairs, &admit), limit, pairs)
    }

    /// The same, with a filter of many pairs at a time.
    pub(crate) fn pairs_by<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: &Admit,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        #[cfg(feature = "parallel")]
        if boxes.len() >= threads::MANY_BOXES && rayon::current_num_threads() > 1 {
            let boxes = &boxes[..boxes.len().min(MOST_BOXES)];
            self.grid = None;
            return compiled::pairs(&mut self.team, boxes, (admit, limit), pairs);
        }
        pairs.clear();
        let outcome = compiled::batches(self, boxes, &mut |found| {
            let admitted = admit(found);
            if admitted > limit - pairs.len() {
                return ControlFlow::Break(());
            }
            pairs.extend_from_slice(&found[..admitted]);
            ControlFlow::Continue(())
        });
        if outcome.is_break() {
            pairs.clear();
            return Err(TooManyPairs { limit });
        }
        self.order.sort(pairs, boxes.len());
        Ok(())
    }

    /// Hands every overlapping pair that `admit` lets pass to `visitor`, each once, in unspecified order, until it
    /// breaks off. For outputs that are too long to keep. On one thread.
    pub fn visit<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: impl Fn(u32, u32) -> bool + Sync,
        mut visitor: impl FnMut(PairId) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        compiled::batches(self, boxes, &mut |pairs| {
            let admitted = keep(pairs, &admit);
            pairs[..admitted].iter().try_for_each(|&pair| visitor(pair))
        })
    }

    /// Hands over all overlapping pairs, many at a time. On one thread.
    fn batches<B: Bounds>(&mut self, boxes: &[B], sink: &mut Sink) -> ControlFlow<()> {
        let boxes = &boxes[..boxes.len().min(MOST_BOXES)];
        #[cfg(feature = "parallel")]
        self.team.forget();
        let Self { columns, scratch, .. } = self;
        let pick = |place: usize| boxes[place];
        let grid = Grid::for_boxes(boxes.len(), Over::All, pick);
        let grid = widest(Fill::<_, IN_ORDER> { columns, grid, count: boxes.len(), pick });
        self.grid = Some(grid);
        let question = &mut Question { boxes, sink };
        if may_be_crowded(boxes.len(), columns.len(), &grid)
            && Crowd::of(columns, &grid).is_worth_segments(boxes.len(), &grid)
        {
            return question.ask_all(&mut scratch.segments, (grid.sweep, Slab::ALL));
        }
        let level = Level::<_, false> {
            parts: core::slice::from_ref(columns),
            grid: &grid,
            range: 0..grid.count(),
            question,
            scratch,
            around: (None, 0),
        };
        widest(level)
    }

    /// The columns of the last sweep in one piece: the parts that several threads leave behind are merged first.
    ///
    /// A lookup of single boxes would have to visit every part, and wait for memory in each: with two parts, a frame of
    /// a million boxes of which few move took 1.8 to 2.4 times as long (Zen 4, 2026-11-22).
    pub(crate) fn put_together(&mut self) -> Option<(&Grid, &Columns)> {
        #[cfg(feature = "parallel")]
        if let Some(grid) = self.team.put_together(&mut self.columns) {
            self.grid = Some(grid);
        }
        self.whole()
    }

    /// The columns of the last sweep; only valid if they are in one piece already.
    pub(crate) fn whole(&self) -> Option<(&Grid, &Columns)> {
        Some((self.grid.as_ref()?, &self.columns))
    }

    /// The columns of the last sweep in parts, each with the next range of boxes.
    fn sorted(&self) -> Option<(&Grid, &[Columns])> {
        #[cfg(feature = "parallel")]
        if let Some(sorted) = self.team.sorted() {
            return Some(sorted);
        }
        self.whole().map(|(grid, columns)| (grid, core::slice::from_ref(columns)))
    }

    /// The columns that the last sweep sorted boxes into, for debug views: those that hold any box, in the order in
    /// which they are swept. None before the first sweep. Columns within an overfull column are not listed. Cost:
    /// linear in all columns and the boxes in them.
    ///
    /// ```
    /// use asunder_broad::Sweep;
    /// use asunder_geometry::{Aabb2, glam::Vec2};
    /// let low = |i: u32| Vec2::new((i % 20) as f32, (i / 20) as f32) * 2.0;
    /// let boxes: Vec<Aabb2> = (0..400).map(|i| Aabb2::new(low(i), low(i) + Vec2::ONE)).collect();
    /// let mut sweep = Sweep::new();
    /// assert_eq!(sweep.columns().count(), 0);
    /// sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut Vec::new())?;
    /// assert!(sweep.columns().count() > 1);
    /// assert!(sweep.columns().map(|column| column.boxes).sum::<usize>() >= 400);
    /// # Ok::<(), asunder_broad::TooManyPairs>(())
    /// ```
    pub fn columns(&self) -> impl Iterator<Item = Column> {
        self.sorted().into_iter().flat_map(|(grid, parts)| Column::all(grid, parts))
    }

    /// Memory that is held for the next sweep, in bytes: some 50 to 70 per box, and 9 per pair for the sort (30 on
    /// several threads); where columns are of no use, another 64 per box, for each thread.
    ///
    /// ```
    /// assert_eq!(asunder_broad::Sweep::new().bytes(), 0);
    /// ```
    pub fn bytes(&self) -> usize {
        let one = self.columns.bytes() + self.scratch.bytes() + self.order.bytes();
        #[cfg(feature = "parallel")]
        let one = one + self.team.bytes();
        one
    }
}
