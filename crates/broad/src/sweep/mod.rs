//! Sweep and prune in columns.

mod order;
mod rows;

use crate::columns::codes::Entry;
use crate::columns::grid::Grid;
use crate::columns::{Columns, owned};
use crate::pair::{PairId, TooManyPairs};
use asunder_geometry::Bounds;
use core::ops::ControlFlow;
use rows::{HITS, Hit, LANES, Progress, Strips};

/// A sweep.
#[derive(Clone, Debug, Default)]
pub struct Sweep {
    columns: Columns,
    strips: Strips,
    order: order::Order,
}

impl Sweep {
    /// A sweep without scratch memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
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
        pairs.clear();
        let outcome = self.batches(boxes, &admit, &mut |found: &[PairId]| {
            if found.len() > limit - pairs.len() {
                return ControlFlow::Break(());
            }
            pairs.extend_from_slice(found);
            ControlFlow::Continue(())
        });
        if outcome.is_break() {
            pairs.clear();
            return Err(TooManyPairs { limit });
        }
        self.order.sort(pairs, boxes.len());
        Ok(())
    }

    /// Hands every overlapping pair that `admit` lets pass to `visitor`.
    pub fn visit<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: impl Fn(u32, u32) -> bool + Sync,
        mut visitor: impl FnMut(PairId) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.batches(boxes, &admit, &mut |pairs: &[PairId]| pairs.iter().try_for_each(|&pair| visitor(pair)))
    }

    fn batches<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: &impl Fn(u32, u32) -> bool,
        sink: &mut impl FnMut(&[PairId]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let grid = Grid::for_boxes(boxes.len(), |place| boxes[place]);
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("bmi1") {
            #[allow(unsafe_code)]
            // SAFETY: the features were asked for.
            return unsafe { self.sweep_avx2(grid, boxes, admit, sink) };
        }
        self.sweep::<B, false>(grid, boxes, admit, sink)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,bmi1")]
    fn sweep_avx2<B: Bounds>(
        &mut self,
        grid: Grid,
        boxes: &[B],
        admit: &impl Fn(u32, u32) -> bool,
        sink: &mut impl FnMut(&[PairId]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        self.sweep::<B, true>(grid, boxes, admit, sink)
    }

    #[inline(always)]
    fn sweep<B: Bounds, const WIDE: bool>(
        &mut self,
        grid: Grid,
        boxes: &[B],
        admit: &impl Fn(u32, u32) -> bool,
        sink: &mut impl FnMut(&[PairId]) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let grid = self.columns.fill(grid, boxes.iter().copied());
        let mut hits = [Hit::default(); HITS];
        let mut pairs = [PairId { a: 0, b: 0 }; HITS * LANES];
        for index in 0..grid.count() {
            let column = self.columns.column(&grid, index);
            if column.entries.len() < 2 {
                continue;
            }
            self.strips.fill(column.entries);
            let mut progress = Progress::default();
            loop {
                let count = self.strips.sweep::<WIDE>(&column, &grid, &mut progress, &mut hits);
                if count == 0 {
                    break;
                }
                let count = settle(&mut hits[..count], column.entries, boxes, &mut pairs);
                let mut admitted = 0;
                for place in 0..count {
                    let pair = pairs[place];
                    pairs[admitted] = pair;
                    admitted += usize::from(admit(pair.a, pair.b));
                }
                sink(&pairs[..admitted])?;
            }
        }
        ControlFlow::Continue(())
    }

    /// Memory that is held, in bytes.
    pub fn bytes(&self) -> usize {
        self.columns.bytes() + self.strips.bytes() + self.order.bytes()
    }
}

/// Hits to pairs that this column owns; returns how many.
///
/// One box of every hit at a time, and the hits that have more once again: a loop over the boxes of each hit would end where the
/// processor does not expect it.
#[inline(always)]
fn settle<B: Bounds>(
    hits: &mut [Hit],
    entries: &[Entry],
    boxes: &[B],
    pairs: &mut [PairId; HITS * LANES],
) -> usize {
    let (mut count, mut left) = (0, hits.len());
    while left > 0 {
        let mut more = 0;
        for place in 0..left {
            let hit = hits[place];
            let (index, is_close, rest) = hit.next();
            let (one, other, mut is_ours) =
                owned(entries[hit.row as usize].place, entries[index as usize].place);
            let pair = PairId::new(one, other);
            if is_close {
                is_ours &= boxes[pair.a as usize].overlaps(&boxes[pair.b as usize]);
            }
            pairs[count & (HITS * LANES - 1)] = pair;
            count += usize::from(is_ours);
            hits[more] = rest;
            more += usize::from(!rest.is_done());
        }
        left = more;
    }
    count
}
