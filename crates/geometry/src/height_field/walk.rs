//! Which triangles of a height field are near, or in the way.

use super::HeightField;
use super::grid::{Cell, Grid};
use crate::aabb::{Aabb3, Bounds};
use crate::ground::tree::Ask;
use core::ops::{ControlFlow, Range};

/// Cells on a side of a block.
///
/// The tree of blocks takes 2 bytes per cell; smaller blocks take four times as much, and of larger ones more cells
/// are looked at in vain.
pub(super) const BLOCK: Block = Block { side: 4 };

#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    side: u32,
}

impl Block {
    /// Blocks along x.
    const fn columns(self, grid: &Grid) -> u32 {
        grid.cells[0].div_ceil(self.side)
    }

    pub(super) const fn count(self, grid: &Grid) -> u32 {
        self.columns(grid) * grid.cells[1].div_ceil(self.side)
    }

    /// Columns and rows of a block's cells.
    fn ranges(self, grid: &Grid, block: u32) -> [Range<u32>; 2] {
        let place = [block % self.columns(grid), block / self.columns(grid)];
        [0, 1].map(|axis| {
            let start = place[axis] * self.side;
            start..(start + self.side).min(grid.cells[axis])
        })
    }
}

/// The cells of a block, row by row.
pub(super) fn cells_of(grid: &Grid, block: u32) -> impl Iterator<Item = Cell> + use<> {
    let [columns, rows] = BLOCK.ranges(grid, block);
    cells(columns, rows)
}

fn cells(columns: Range<u32>, rows: Range<u32>) -> impl Iterator<Item = Cell> + use<> {
    rows.flat_map(move |row| columns.clone().map(move |column| Cell { column, row }))
}

/// Cells below a box up to which all are looked at; of more, blocks are asked first whether any is as high.
const FEW: u32 = 64;

impl HeightField {
    pub(crate) fn visit_near(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if !bounds.is_valid() {
            return ControlFlow::Continue(());
        }
        let grid = &self.data.grid;
        let columns = grid.reached(0, f64::from(bounds.min.x), f64::from(bounds.max.x));
        let rows = grid.reached(1, f64::from(bounds.min.z), f64::from(bounds.max.z));
        let heights = [bounds.min.y, bounds.max.y];
        if (columns.len() as u32).saturating_mul(rows.len() as u32) <= FEW {
            return cells(columns, rows).try_for_each(|cell| grid.visit_cell(cell, heights, &mut visitor));
        }
        self.data.blocks.visit_overlapping(bounds, |block, _| {
            let [block_columns, block_rows] = BLOCK.ranges(grid, block);
            let of_both = cells(common(&columns, &block_columns), common(&rows, &block_rows));
            of_both.into_iter().try_for_each(|cell| grid.visit_cell(cell, heights, &mut visitor))
        })
    }

    /// Hands triangles to `visitor` block by block as the order has it, and in its order within each. `place` is what
    /// `ask` is, of a single box.
    pub(crate) fn visit_in_order(
        &self,
        ask: &impl Ask,
        place: impl Fn([f32; 3], [f32; 3]) -> Option<f64>,
        limit: f64,
        mut visitor: impl FnMut(u32) -> f64,
    ) {
        let (grid, mut limit) = (&self.data.grid, limit);
        self.data.blocks.visit_in_order(ask, limit, |block, _| {
            let mut found = [(0.0, 0); (2 * BLOCK.side * BLOCK.side) as usize];
            let mut count = 0;
            for cell in cells_of(grid, block).filter(|&cell| !grid.is_hole(cell)) {
                for (triangle, [low, high]) in grid.boxes(cell) {
                    if let Some(place) = place(low, high).filter(|&place| place <= limit) {
                        found[count] = (place, triangle);
                        count += 1;
                    }
                }
            }
            let found = &mut found[..count];
            found.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            for &mut (place, triangle) in found {
                if place <= limit {
                    limit = visitor(triangle).min(limit);
                }
            }
            limit
        });
    }
}

fn common(one: &Range<u32>, other: &Range<u32>) -> Range<u32> {
    one.start.max(other.start)..one.end.min(other.end)
}

impl Grid {
    /// Least and greatest heights of a cell's two triangles. On the other axes both are as wide as the cell.
    #[inline]
    fn spans(&self, cell: Cell) -> [[f32; 2]; 2] {
        let [a, b, c, d] = self.heights_of(cell);
        let (low, high) = (if b < c { b } else { c }, if b < c { c } else { b });
        let with = |one: f32| [if one < low { one } else { low }, if one > high { one } else { high }];
        [with(a), with(d)]
    }

    /// Hands those triangles of a cell to `visitor` that are between two heights.
    #[inline]
    fn visit_cell(
        &self,
        cell: Cell,
        [least, most]: [f32; 2],
        visitor: &mut impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.is_hole(cell) {
            return ControlFlow::Continue(());
        }
        let first = 2 * self.number(cell);
        for (triangle, [low, high]) in (first..).zip(self.spans(cell)) {
            if low <= most && least <= high {
                visitor(triangle)?;
            }
        }
        ControlFlow::Continue(())
    }

    /// The triangles of a cell, with their least and greatest corners.
    #[inline]
    fn boxes(&self, cell: Cell) -> impl Iterator<Item = (u32, [[f32; 3]; 2])> + use<> {
        let [x, next_x] = [cell.column, cell.column + 1].map(|column| self.line(0, column));
        let [z, next_z] = [cell.row, cell.row + 1].map(|row| self.line(1, row));
        let of = move |[low, high]: [f32; 2]| [[x, low, z], [next_x, high, next_z]];
        (2 * self.number(cell)..).zip(self.spans(cell).map(of))
    }
}
