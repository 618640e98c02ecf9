//! The geometry of a height field: where its vertices, cells and triangles are.

use super::HeightFieldError;
use crate::tolerance::{MAX_FIELD_SIDE, MAX_RADIUS};
use crate::triangle::Triangle3;
use core::ops::Range;
use glam::{Vec2, Vec3};

/// The data that define a height field, from which everything else is derived.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Grid {
    /// Cells along x and z.
    pub(super) cells: [u32; 2],
    pub(super) cell: Vec2,
    pub(super) heights: Vec<f32>,
    /// A bit for each cell, set for holes; empty if there are none.
    holes: Vec<u64>,
}

/// A cell, by column and row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cell {
    pub(super) column: u32,
    pub(super) row: u32,
}

impl Grid {
    pub(super) fn new(
        [columns, rows]: [usize; 2],
        mut heights: Vec<f32>,
        cell: Vec2,
    ) -> Result<Self, HeightFieldError> {
        let sides = 2..=MAX_FIELD_SIDE;
        if !sides.contains(&columns) || !sides.contains(&rows) {
            return Err(HeightFieldError::Sides { columns, rows });
        }
        if heights.len() != columns * rows {
            return Err(HeightFieldError::Count { columns, rows, heights: heights.len() });
        }
        if let Some(axis) = (0..2).find(|&axis| !(cell[axis].is_finite() && cell[axis] > 0.0)) {
            return Err(HeightFieldError::Cell { axis, value: cell[axis] });
        }
        if let Some(place) = heights.iter().position(|height| !height.is_finite()) {
            return Err(HeightFieldError::NotFinite { column: place % columns, row: place / columns });
        }
        heights.shrink_to_fit();
        let grid = Self { cells: [columns as u32 - 1, rows as u32 - 1], cell, heights, holes: Vec::new() };
        grid.check_reach()?;
        grid.check_cells()?;
        Ok(grid)
    }

    /// The same cells and holes with other heights.
    pub(super) fn with_heights(&self, heights: Vec<f32>) -> Result<Self, HeightFieldError> {
        let sides = self.cells.map(|count| count as usize + 1);
        Ok(Self { holes: self.holes.clone(), ..Self::new(sides, heights, self.cell)? })
    }

    fn check_reach(&self) -> Result<(), HeightFieldError> {
        let is_far = |vertex: &u32| self.vertex(*vertex).as_dvec3().length() > f64::from(MAX_RADIUS);
        let columns = self.cells[0] + 1;
        (0..self.heights.len() as u32).find(is_far).map_or(Ok(()), |vertex| {
            let (column, row) = (vertex % columns, vertex / columns);
            Err(HeightFieldError::TooLarge { column: column as usize, row: row as usize })
        })
    }

    /// Rejects cells whose triangles [`Triangle3`] would reject.
    fn check_cells(&self) -> Result<(), HeightFieldError> {
        let side = self.cell.as_dvec2();
        let (area, diagonal) = (side.x * side.y, side.length_squared());
        for cell in self.all_cells() {
            let four = self.heights_of(cell).map(f64::from);
            let low = four.into_iter().fold(f64::INFINITY, f64::min);
            let drop = four.into_iter().fold(f64::NEG_INFINITY, f64::max) - low;
            // A triangle's area is at least that of its projection, and its sides are at most this long. Nearly all
            // cells pass here; the margin is far above the effect of rounded coordinates.
            if area > 2e-7 * (diagonal + drop * drop) && diagonal > 1e-10 {
                continue;
            }
            let is_bad = |&triangle: &u32| {
                let [a, b, c] = self.corners(triangle);
                Triangle3::new(a, b, c).is_err()
            };
            let first = 2 * self.number(cell);
            if [first, first + 1].iter().any(is_bad) {
                let Cell { column, row } = cell;
                return Err(HeightFieldError::Degenerate { column: column as usize, row: row as usize });
            }
        }
        Ok(())
    }

    /// Makes a cell a hole.
    pub(super) fn punch(&mut self, column: usize, row: usize) -> Result<(), HeightFieldError> {
        let [columns, rows] = self.cells.map(|count| count as usize);
        if column >= columns || row >= rows {
            return Err(HeightFieldError::NoSuchCell { column, row });
        }
        if self.holes.is_empty() {
            self.holes = vec![0; (columns * rows).div_ceil(64)];
        }
        let number = row * columns + column;
        self.holes[number / 64] |= 1 << (number % 64);
        Ok(())
    }

    pub(super) fn bytes(&self) -> usize {
        self.heights.capacity() * size_of::<f32>() + self.holes.capacity() * size_of::<u64>()
    }

    /// All cells, row by row.
    pub(super) fn all_cells(&self) -> impl Iterator<Item = Cell> + Clone + use<> {
        let [columns, rows] = self.cells;
        (0..rows).flat_map(move |row| (0..columns).map(move |column| Cell { column, row }))
    }

    /// The number of a cell that exists.
    #[inline]
    pub(super) const fn number(&self, cell: Cell) -> u32 {
        cell.row * self.cells[0] + cell.column
    }

    #[inline]
    pub(super) const fn triangle_count(&self) -> u32 {
        2 * self.cells[0] * self.cells[1]
    }

    #[inline]
    pub(super) fn cell_of(&self, triangle: u32) -> Option<Cell> {
        let number = triangle / 2;
        let cell = Cell { column: number % self.cells[0], row: number / self.cells[0] };
        (triangle < self.triangle_count()).then_some(cell)
    }

    /// Whether there is no ground; true as well beyond the grid.
    #[inline]
    pub(super) fn is_hole(&self, cell: Cell) -> bool {
        let [columns, rows] = self.cells;
        if cell.column >= columns || cell.row >= rows {
            return true;
        }
        let number = self.number(cell) as usize;
        self.holes.get(number / 64).is_some_and(|bits| bits >> (number % 64) & 1 == 1)
    }

    /// Whether a triangle exists and is not in a hole.
    #[inline]
    pub(super) fn has(&self, triangle: u32) -> bool {
        self.cell_of(triangle).is_some_and(|cell| !self.is_hole(cell))
    }

    /// The coordinate that the vertices of a column or row share.
    #[inline]
    pub(super) fn line(&self, axis: usize, number: u32) -> f32 {
        number as f32 * self.cell[axis]
    }

    /// The number of a vertex by column and row; of a cell, that of its first vertex.
    #[inline]
    pub(super) const fn vertex_number(&self, cell: Cell) -> u32 {
        cell.row * (self.cells[0] + 1) + cell.column
    }

    /// All vertices that are corners of ground.
    pub(super) fn vertices(&self) -> impl Iterator<Item = Vec3> + '_ {
        let is_ground = |column: u32, row: u32| !self.is_hole(Cell { column, row });
        let at = move |column: u32, row: u32| {
            let number = self.vertex_number(Cell { column, row }) as usize;
            // Before the first, numbers wrap to far beyond the last, where there is no cell.
            let (left, above) = (column.wrapping_sub(1), row.wrapping_sub(1));
            let is_kept = is_ground(column, row)
                || is_ground(left, row)
                || is_ground(column, above)
                || is_ground(left, above);
            is_kept.then(|| Vec3::new(self.line(0, column), self.heights[number], self.line(1, row)))
        };
        (0..=self.cells[1]).flat_map(move |row| (0..=self.cells[0]).filter_map(move |column| at(column, row)))
    }

    fn vertex(&self, number: u32) -> Vec3 {
        let columns = self.cells[0] + 1;
        let height = self.heights.get(number as usize).copied().unwrap_or(0.0);
        Vec3::new(self.line(0, number % columns), height, self.line(1, number / columns))
    }

    /// Heights at (c, r), (c + 1, r), (c, r + 1) and (c + 1, r + 1) of a cell that exists.
    #[inline]
    pub(super) fn heights_of(&self, cell: Cell) -> [f32; 4] {
        let near = self.vertex_number(cell) as usize;
        let far = near + self.cells[0] as usize + 1;
        [self.heights[near], self.heights[near + 1], self.heights[far], self.heights[far + 1]]
    }

    #[inline]
    pub(super) fn vertex_numbers(&self, triangle: u32) -> [u32; 3] {
        let Some(cell) = self.cell_of(triangle) else { return [0; 3] };
        let near = self.vertex_number(cell);
        let far = near + self.cells[0] + 1;
        if triangle.is_multiple_of(2) { [near, far, near + 1] } else { [near + 1, far, far + 1] }
    }

    #[inline]
    pub(super) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        let Some(cell) = self.cell_of(triangle) else { return [Vec3::ZERO; 3] };
        let [first, second] = self.triangles_of(cell);
        if triangle.is_multiple_of(2) { first } else { second }
    }

    /// The corners of both triangles of a cell that exists.
    #[inline]
    pub(super) fn triangles_of(&self, cell: Cell) -> [[Vec3; 3]; 2] {
        let [a, b, c, d] = self.heights_of(cell);
        let [x, next_x] = [cell.column, cell.column + 1].map(|column| self.line(0, column));
        let [z, next_z] = [cell.row, cell.row + 1].map(|row| self.line(1, row));
        let (left, right) = (Vec3::new(x, c, next_z), Vec3::new(next_x, b, z));
        [[Vec3::new(x, a, z), left, right], [right, left, Vec3::new(next_x, d, next_z)]]
    }

    /// The triangle across an edge, and the number of the shared edge in it.
    #[inline]
    pub(super) fn neighbor(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        let cell = self.cell_of(triangle).filter(|&cell| !self.is_hole(cell))?;
        let Cell { column, row } = cell;
        let (column, row, first, edge) = match (triangle % 2, edge) {
            (0, 0) => (column.checked_sub(1)?, row, 1, 2),
            (0, 1) => (column, row, 1, 0),
            (0, _) => (column, row.checked_sub(1)?, 1, 1),
            (_, 0) => (column, row, 0, 1),
            (_, 1) => (column, row + 1, 0, 2),
            (_, _) => (column + 1, row, 0, 0),
        };
        let cell = Cell { column, row };
        (!self.is_hole(cell)).then(|| (2 * self.number(cell) + first, edge))
    }

    /// The columns or rows of cells that reach into an interval.
    pub(super) fn reached(&self, axis: usize, low: f64, high: f64) -> Range<u32> {
        let (count, side) = (self.cells[axis], f64::from(self.cell[axis]));
        let line = |number: u32| f64::from(self.line(axis, number));
        // The guess minus two is never too great, as a coordinate is off by less than a cell. From there, search
        // linearly.
        let guess = |at: f64| (at / side).clamp(0.0, f64::from(count)) as u32;
        let mut start = guess(low).saturating_sub(2);
        while start < count && line(start + 1) < low {
            start += 1;
        }
        let mut end = guess(high).saturating_sub(2);
        while end < count && line(end) <= high {
            end += 1;
        }
        start..end
    }

    pub(super) fn height_at(&self, [x, z]: [f64; 2]) -> Option<f32> {
        if !(x.is_finite() && z.is_finite()) {
            return None;
        }
        let (columns, rows) = (self.reached(0, x, x), self.reached(1, z, z));
        let mut cells = rows.flat_map(|row| columns.clone().map(move |column| Cell { column, row }));
        let cell = cells.find(|&cell| !self.is_hole(cell))?;
        let share = |axis: usize, number: u32, at: f64| {
            let [from, to] = [number, number + 1].map(|number| f64::from(self.line(axis, number)));
            (at - from) / (to - from)
        };
        let (u, v) = (share(0, cell.column, x), share(1, cell.row, z));
        let [a, b, c, d] = self.heights_of(cell).map(f64::from);
        let height = if u + v <= 1.0 {
            a + u * (b - a) + v * (c - a)
        } else {
            d + (1.0 - u) * (c - d) + (1.0 - v) * (b - d)
        };
        Some(height as f32)
    }
}
