//! Sweep and prune in columns.

mod level;
mod order;
mod rows;
mod settle;
mod wide;

use crate::columns::grid::Grid;
use crate::columns::{Columns, MOST_BOXES};
use crate::pair::{PairId, TooManyPairs};
use asunder_geometry::Bounds;
use core::ops::ControlFlow;
use level::{Level, Scratch};
use settle::Question;
use wide::Kernel;

/// A sweep.
#[derive(Clone, Debug, Default)]
pub struct Sweep {
    columns: Columns,
    scratch: Scratch,
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
        let boxes = &boxes[..boxes.len().min(MOST_BOXES)];
        let Self { columns, scratch, .. } = self;
        let grid = wide::run(Sort { boxes, columns });
        let level = Level {
            parts: core::slice::from_ref(columns),
            grid: &grid,
            range: 0..grid.count(),
            question: &mut Question { boxes, admit, sink },
            scratch,
        };
        wide::run(level)
    }

    /// Memory that is held, in bytes.
    pub fn bytes(&self) -> usize {
        self.columns.bytes() + self.scratch.bytes() + self.order.bytes()
    }
}

/// All boxes into columns.
struct Sort<'a, B> {
    boxes: &'a [B],
    columns: &'a mut Columns,
}

impl<B: Bounds> Kernel for Sort<'_, B> {
    type Output = Grid;

    #[inline(always)]
    fn run<const WIDE: bool>(self) -> Grid {
        let Self { boxes, columns } = self;
        let grid = Grid::for_boxes(boxes.len(), |place| boxes[place]);
        columns.fill(grid, boxes.len(), |place| boxes[place])
    }
}
