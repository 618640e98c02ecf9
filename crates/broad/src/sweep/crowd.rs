//! Whether columns are of any use to the boxes as they lie, judged by the number of candidates in them.

use super::segments::worth;
use super::trial::{Way, way};
use crate::columns::grid::Grid;
use crate::columns::{ColumnEntries, Columns};

/// Totals over some columns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Crowd {
    candidates: usize,
    entries: usize,
    /// Entries of the fullest column.
    fullest: usize,
}

/// If the fullest column has this many times the average, it is to blame alone, and is cut further by itself.
const CROWDED: usize = 8;

/// Whether columns hold so many boxes on average that counting candidates may be worth it. Takes twice the most that
/// there could be if all columns were alike.
pub(super) fn may_be_crowded(boxes: usize, entries: usize, grid: &Grid) -> bool {
    let most = (worth(boxes) as u64).saturating_mul(boxes as u64).saturating_mul(grid.count() as u64);
    way() == Way::Segments || (entries as u64).saturating_mul(entries as u64) > most
}

impl Crowd {
    /// Totals over all columns. Cost: linear in their entries.
    pub(super) fn of(columns: &Columns, grid: &Grid) -> Self {
        (0..grid.count()).fold(Self::default(), |crowd, index| crowd.and(&columns.column(grid, index), grid))
    }

    /// Adds one column.
    pub(super) fn and(self, column: &ColumnEntries<'_>, grid: &Grid) -> Self {
        let entries = column.entries.len();
        Self {
            candidates: self.candidates + column.candidates(grid),
            entries: self.entries + entries,
            fullest: self.fullest.max(entries),
        }
    }

    /// The sum of both.
    #[cfg(feature = "parallel")]
    pub(super) fn with(self, other: Self) -> Self {
        Self {
            candidates: self.candidates + other.candidates,
            entries: self.entries + other.entries,
            fullest: self.fullest.max(other.fullest),
        }
    }

    /// Whether a walk by segments through all boxes takes less time than these columns would, and no single column is
    /// to blame.
    pub(super) fn is_worth_segments(&self, boxes: usize, grid: &Grid) -> bool {
        let is_even = self.fullest * grid.count() < CROWDED * self.entries;
        way() == Way::Segments || is_even && self.candidates > boxes * worth(boxes)
    }
}
