//! Derives the data of a height field when it is made.
//!
//! Each vertex has marks of two bytes. From the lowest bit, there are two bits each, seen from the front and from the
//! back, for the edge along x that starts at the vertex, the one along z, the diagonal of the cell that starts there,
//! and the vertex itself. Then follows one bit for each of the three edges, set if it has a low bend.

use super::grid::{Cell, Grid};
use super::walk::{BLOCK, cells_of};
use super::{Data, HeightFieldError};
use crate::ground::Prominent;
use crate::ground::bend::{RIM, Sight, is_low, patches, sight};
use crate::ground::tree::{Sides, Tree};
use crate::hull::normal::unit;
use crate::outward::round_up;
use glam::{DVec3, Vec3};

pub(super) fn build(grid: Grid) -> Result<Data, HeightFieldError> {
    let kept = || grid.all_cells().filter(|&cell| !grid.is_hole(cell));
    let Some(around) = kept().map(|cell| sides(&grid, cell)).reduce(union) else {
        return Err(HeightFieldError::NoGround);
    };
    let [a, b, c, d, e, f] = around;
    let (low, high) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
    // The minimum of -0 and 0 may be either: adding zero makes them equal.
    let center = (low + high) * 0.5 + Vec3::ZERO;
    let reach = |corner: Vec3| (corner.as_dvec3() - center.as_dvec3()).length_squared();
    let outer = grid.vertices().map(reach).fold(0.0, f64::max).sqrt();
    let neighbor = |triangle, edge| Some(grid.neighbor(triangle, edge)?.0);
    let normals: Vec<DVec3> = grid.all_cells().flat_map(|cell| grid.triangles_of(cell).map(normal)).collect();
    let normal = |triangle: u32| normals[triangle as usize];
    let patches = patches(grid.triangle_count(), |triangle| grid.has(triangle), normal, neighbor);
    let marks = Marks::of(&grid, &normals);
    let block_sides = |block: u32| {
        let cells = cells_of(&grid, block).filter(|&cell| !grid.is_hole(cell));
        cells.map(|cell| sides(&grid, cell)).reduce(union)
    };
    let blocks: Vec<Option<Sides>> = (0..BLOCK.count(&grid)).map(block_sides).collect();
    let full = (0..).zip(&blocks).filter(|(_, sides)| sides.is_some()).map(|(block, _)| block);
    let blocks = Tree::new(full, |block| blocks[block as usize].unwrap_or(around));
    let outer_radius = round_up(outer * (1.0 + 8.0 * f64::EPSILON));
    Ok(Data { marks, patches, blocks, low, high, center, outer_radius, grid })
}

/// The marked edges and corners of a triangle.
#[inline]
pub(super) fn prominent(grid: &Grid, marks: &[u16], triangle: u32) -> Prominent {
    let Some(Cell { column, row }) = grid.cell_of(triangle).filter(|&cell| !grid.is_hole(cell)) else {
        return Prominent::NONE;
    };
    let near = grid.vertex_number(Cell { column, row }) as usize;
    let far = near + grid.cells[0] as usize + 1;
    let (edges, corners) = if triangle.is_multiple_of(2) {
        ([(near, ALONG_Z), (near, DIAGONAL), (near, ALONG_X)], [near, far, near + 1])
    } else {
        ([(near, DIAGONAL), (far, ALONG_X), (near + 1, ALONG_Z)], [near + 1, far, far + 1])
    };
    let is_low = |(vertex, shift): (usize, usize)| marks[vertex] >> (LOW + shift / 2) & 1 == 1;
    let mut prominent = Prominent::NONE;
    if edges.into_iter().any(is_low) {
        prominent = prominent.with_low_bend();
    }
    for (side, is_front) in [true, false].into_iter().enumerate() {
        for i in 0..3 {
            let (vertex, shift) = edges[i];
            if marks[vertex] >> (shift + side) & 1 == 1 {
                prominent = prominent.with_edge(i, is_front);
            }
            if marks[corners[i]] >> (VERTEX + side) & 1 == 1 {
                prominent = prominent.with_corner(i, is_front);
            }
        }
    }
    prominent
}

const ALONG_X: usize = 0;
const ALONG_Z: usize = 2;
const DIAGONAL: usize = 4;
const VERTEX: usize = 6;
const LOW: usize = 8;

/// Marks the edges and vertices of a field.
struct Marks<'a> {
    grid: &'a Grid,
    normals: &'a [DVec3],
    marks: Vec<u16>,
}

impl<'a> Marks<'a> {
    fn of(grid: &'a Grid, normals: &'a [DVec3]) -> Vec<u16> {
        let mut marks = Self { grid, normals, marks: vec![0; grid.heights.len()] };
        let [columns, rows] = grid.cells;
        for row in 0..=rows {
            for column in 0..=columns {
                marks.mark(Cell { column, row });
            }
        }
        marks.marks
    }

    /// Marks the three edges of a vertex, and their ends.
    fn mark(&mut self, cell: Cell) {
        let Cell { column, row } = cell;
        let near = self.grid.vertex_number(cell) as usize;
        let far = near + self.grid.cells[0] as usize + 1;
        let first = |cell: Cell| (!self.grid.is_hole(cell)).then(|| 2 * self.grid.number(cell));
        let here = first(cell);
        // All three edges belong to one triangle.
        let corners = here.map(|here| self.grid.corners(here).map(|corner| corner.as_dvec3()));
        // Before the first row and column, numbers wrap to far beyond the last, where there is no cell.
        let above = first(Cell { column, row: row.wrapping_sub(1) });
        let left = first(Cell { column: column.wrapping_sub(1), row });
        let second = |first: u32| first + 1;
        let edges = [
            (ALONG_X, 2, above, [near, near + 1]),
            (ALONG_Z, 0, left, [near, far]),
            (DIAGONAL, 1, here, [near + 1, far]),
        ];
        for (shift, edge, other, ends) in edges {
            let other = other.map(second);
            let along = corners.map(|corners| corners[(edge + 1) % 3] - corners[edge]);
            let sight = self.sight(here.zip(along), other);
            self.put(ends, near, shift, sight);
            if self.is_low(here, other) {
                self.marks[near] |= 1 << (LOW + shift / 2);
            }
        }
    }

    /// Whether there is ground on both sides of an edge, with a low bend.
    fn is_low(&self, one: Option<u32>, other: Option<u32>) -> bool {
        one.zip(other)
            .is_some_and(|(one, other)| is_low([one, other].map(|number| self.normals[number as usize])))
    }

    /// From which sides the edge between a triangle (given with the direction of its half-edge) and another one counts;
    /// from none for an edge that does not exist.
    fn sight(&self, one: Option<(u32, DVec3)>, other: Option<u32>) -> Sight {
        match (one, other) {
            (None, None) => [false; 2],
            (Some((one, along)), Some(other)) => {
                sight([one, other].map(|triangle| self.normals[triangle as usize]), along.normalize())
            }
            _ => RIM,
        }
    }

    fn put(&mut self, ends: [usize; 2], vertex: usize, shift: usize, [front, back]: Sight) {
        let bits = u16::from(front) | u16::from(back) << 1;
        if bits != 0 {
            self.marks[vertex] |= bits << shift;
            ends.into_iter().for_each(|end| self.marks[end] |= bits << VERTEX);
        }
    }
}

fn normal(triangle: [Vec3; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|corner| corner.as_dvec3());
    unit((b - a).cross(c - a))
}

/// The box around a cell.
fn sides(grid: &Grid, cell: Cell) -> Sides {
    let heights = grid.heights_of(cell);
    let low = heights.into_iter().fold(f32::INFINITY, f32::min);
    let high = heights.into_iter().fold(f32::NEG_INFINITY, f32::max);
    let Cell { column, row } = cell;
    let [x, z] =
        [(0, column), (1, row)].map(|(axis, number)| [grid.line(axis, number), grid.line(axis, number + 1)]);
    [x[0], low, z[0], x[1], high, z[1]]
}

fn union(one: Sides, other: Sides) -> Sides {
    core::array::from_fn(|row| if row < 3 { one[row].min(other[row]) } else { one[row].max(other[row]) })
}
