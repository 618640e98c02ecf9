//! Whether columns are of any use to boxes as they lie: told by how many candidates there are in them.

use super::segments::worth;
use super::trial::{Way, way};
use crate::columns::grid::Grid;
use crate::columns::{ColumnEntries, Columns};

/// What some columns hold.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Crowd {
    candidates: usize,
    entries: usize,
    /// Entries of the fullest column.
    fullest: usize,
}

/// A column with so many times as many boxes as the others is cut further by itself.
const CROWDED: usize = 8;

/// Whether columns hold so many boxes on average that candidates may be worth counting: where all columns are like each
/// other, half of what is compared here is all that there are.
pub(super) fn may_be_crowded(boxes: usize, entries: usize, grid: &Grid) -> bool {
    let most = (worth(boxes) as u64).saturating_mul(boxes as u64).saturating_mul(grid.count() as u64);
    way() == Way::Segments || (entries as u64).saturating_mul(entries as u64) > most
}

impl Crowd {
    /// What all columns hold. Cost: linear in their entries.
    pub(super) fn of(columns: &Columns, grid: &Grid) -> Self {
        (0..grid.count()).fold(Self::default(), |crowd, index| crowd.and(&columns.column(grid, index), grid))
    }

    /// One column more.
    pub(super) fn and(self, column: &ColumnEntries<'_>, grid: &Grid) -> Self {
        let entries = column.entries.len();
        Self {
            candidates: self.candidates + column.candidates(grid),
            entries: self.entries + entries,
            fullest: self.fullest.max(entries),
        }
    }

    /// Both together.
    #[cfg(feature = "parallel")]
    pub(super) fn with(self, other: Self) -> Self {
        Self {
            candidates: self.candidates + other.candidates,
            entries: self.entries + other.entries,
            fullest: self.fullest.max(other.fullest),
        }
    }

    /// Whether a walk by segments through all boxes takes less time than to sweep these columns, none of which is to
    /// blame alone.
    pub(super) fn is_worth_segments(&self, boxes: usize, grid: &Grid) -> bool {
        let is_even = self.fullest * grid.count() < CROWDED * self.entries;
        way() == Way::Segments || is_even && self.candidates > boxes * worth(boxes)
    }
}
