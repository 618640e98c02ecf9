//! Height fields.

mod build;
mod error;
mod grid;
mod walk;

pub use error::HeightFieldError;

use crate::aabb::Aabb3;
use crate::ground::tree::Tree;
use crate::ground::{Ground, Prominent};
use crate::mesh::bounds_of;
use crate::pose3::Pose3;
use crate::triangle::Triangle3;
use glam::{DVec3, Vec2, Vec3};
use grid::{Cell, Grid};
use std::sync::Arc;

/// Ground with one height above each point of a grid, y up. Clones share the data.
///
#[doc = include_str!("../../doc/height_field.svg")]
///
/// The vertex of column `c` and row `r` is at (c * cell.x, height, r * cell.y), rounded to f32: the first at (0,
/// height, 0). A cell has four vertices and two triangles, whose common edge runs from (c + 1, r) to (c, r + 1) in
/// every cell, so that drawn terrain can match it. Fronts face up. Cells may be holes.
///
/// ```text
///     (c, r) --- (c+1, r)   x ->    Cell number k = r * (columns - 1) + c
///        |  2k   /  |        z      Triangle 2k:     (c, r), (c, r+1), (c+1, r)
///        |    /     |        |      Triangle 2k + 1: (c+1, r), (c, r+1), (c+1, r+1)
///        | /  2k+1  |        v
///   (c, r+1) -- (c+1, r+1)
/// ```
///
/// It behaves like a [`TriMesh`](crate::TriMesh) of these triangles, in a tenth of the memory: a surface without
/// thickness, solid from both sides unless it is [`one_sided`](Self::one_sided). Bodies with this shape are always
/// fixed. Bodies that are sunk deep may get other contacts than from a mesh, since triangles are processed in another
/// order.
///
/// # Costs and limits
/// From 2 to [`MAX_FIELD_SIDE`](crate::tolerance::MAX_FIELD_SIDE) columns and rows, within 1e6 m of the shape's origin.
/// A cell takes about 16 bytes. Triangles near a place are found through the grid.
///
/// ```
/// use asunder::{HeightField, glam::{Vec2, Vec3}};
/// let slope = HeightField::new(3, 2, [0.0, 1.0, 2.0, 0.0, 1.0, 2.0], Vec2::new(2.0, 5.0))?.one_sided();
/// assert_eq!((slope.columns(), slope.rows(), slope.cell()), (3, 2, Vec2::new(2.0, 5.0)));
/// assert_eq!((slope.height_at(3.0, 4.0), slope.height_at(4.5, 4.0)), (Some(1.5), None));
/// assert!(slope.is_one_sided() && slope.contains(Vec3::new(3.0, 1.5, 4.0)));
/// # Ok::<(), asunder::HeightFieldError>(())
/// ```
#[derive(Clone)]
pub struct HeightField {
    data: Arc<Data>,
    is_one_sided: bool,
}

struct Data {
    grid: Grid,
    /// Two bits for each edge that belongs to a vertex or its cell, and two for the vertex: see [`build`].
    marks: Vec<u16>,
    /// The patch of each triangle, by its least triangle number.
    patches: Vec<u32>,
    /// Boxes around blocks of cells.
    blocks: Tree,
    low: Vec3,
    high: Vec3,
    center: Vec3,
    outer_radius: f32,
}

impl HeightField {
    /// A field from its heights, in metres, row by row, and their spacing: cell.x along x, cell.y along z. Cost: a
    /// quarter to half a microsecond per cell, and 48 bytes more per cell while it is made.
    ///
    /// # Errors
    /// Fewer than 2 columns or rows, or too many; a wrong number of heights; numbers that are not finite or out of
    /// range; cells too steep for a normal.
    pub fn new(
        columns: usize,
        rows: usize,
        heights: impl Into<Vec<f32>>,
        cell: Vec2,
    ) -> Result<Self, HeightFieldError> {
        let grid = Grid::new([columns, rows], heights.into(), cell)?;
        Ok(Self { data: Arc::new(build::build(grid)?), is_one_sided: false })
    }

    /// The same field, solid only from above.
    #[must_use]
    pub fn one_sided(self) -> Self {
        Self { is_one_sided: true, ..self }
    }

    /// The same field without the ground of some cells, each given by its column and row. Cost: that of a new field.
    ///
    /// ```
    /// use asunder::{HeightField, HeightFieldError, glam::Vec2};
    /// let flat = HeightField::new(3, 3, [0.0; 9], Vec2::ONE)?;
    /// let torn = flat.clone().with_holes([(0, 0), (1, 1)])?;
    /// assert_eq!((torn.is_hole(1, 1), torn.is_hole(1, 0), torn.height_at(1.5, 1.5)), (true, false, None));
    /// assert_eq!(flat.with_holes([(2, 0)]), Err(HeightFieldError::NoSuchCell { column: 2, row: 0 }));
    /// # Ok::<(), HeightFieldError>(())
    /// ```
    ///
    /// # Errors
    /// A cell that is not there; no cell left.
    pub fn with_holes(
        self,
        holes: impl IntoIterator<Item = (usize, usize)>,
    ) -> Result<Self, HeightFieldError> {
        let mut grid = self.data.grid.clone();
        holes.into_iter().try_for_each(|(column, row)| grid.punch(column, row))?;
        Ok(Self { data: Arc::new(build::build(grid)?), ..self })
    }

    /// The same field without the ground of one cell. Cost: that of a new field; for several holes,
    /// [`with_holes`](Self::with_holes) is far cheaper.
    ///
    /// ```
    /// use asunder::{HeightField, HeightFieldError, glam::Vec2};
    /// let slope = HeightField::new(3, 2, [0.0, 1.0, 2.0, 0.0, 1.0, 2.0], Vec2::ONE)?.with_hole(0, 0)?;
    /// assert_eq!((slope.height_at(0.5, 0.5), slope.height_at(1.5, 0.5)), (None, Some(1.5)));
    /// assert_eq!(slope.heights()[0], 0.0, "heights at holes stay");
    /// # Ok::<(), HeightFieldError>(())
    /// ```
    ///
    /// # Errors
    /// A cell that is not there; no cell left.
    pub fn with_hole(self, column: usize, row: usize) -> Result<Self, HeightFieldError> {
        self.with_holes([(column, row)])
    }

    /// The same field with other heights, in metres, row by row; holes, cells and the solid side stay. For example for
    /// craters: a field made with `new` and `with_holes` would be built twice. Cost: that of a new field.
    ///
    /// ```
    /// use asunder::{HeightField, HeightFieldError, glam::Vec2};
    /// let plain = HeightField::new(3, 3, [1.0; 9], Vec2::ONE)?.with_hole(0, 0)?;
    /// let mut heights = plain.heights().to_vec();
    /// heights[8] = 0.5; // column 2, row 2
    /// let crater = plain.with_heights(heights)?;
    /// assert_eq!((crater.height_at(2.0, 2.0), crater.height_at(1.0, 2.0)), (Some(0.5), Some(1.0)));
    /// assert!(crater.is_hole(0, 0));
    /// # Ok::<(), HeightFieldError>(())
    /// ```
    ///
    /// # Errors
    /// As for a new field: a wrong number of heights; numbers that are not finite or out of range; cells too steep for
    /// a normal.
    pub fn with_heights(self, heights: impl Into<Vec<f32>>) -> Result<Self, HeightFieldError> {
        let grid = self.data.grid.with_heights(heights.into())?;
        Ok(Self { data: Arc::new(build::build(grid)?), ..self })
    }

    /// Whether it is solid only from above.
    #[inline]
    pub const fn is_one_sided(&self) -> bool {
        self.is_one_sided
    }

    /// An address that two fields have in common exactly when they share their data; valid only while both live. It
    /// differs from run to run: use it for look-ups, and let no output depend on it.
    #[cfg(feature = "serde")]
    #[doc(hidden)]
    pub fn shared_address(&self) -> usize {
        Arc::as_ptr(&self.data).addr()
    }

    /// Number of heights along x, one more than cells.
    #[inline]
    pub fn columns(&self) -> usize {
        self.data.grid.cells[0] as usize + 1
    }

    /// Number of heights along z, one more than cells.
    #[inline]
    pub fn rows(&self) -> usize {
        self.data.grid.cells[1] as usize + 1
    }

    /// Spacing of heights along x and along z, in metres.
    #[inline]
    pub fn cell(&self) -> Vec2 {
        self.data.grid.cell
    }

    /// All heights, in metres, row by row, those at holes included.
    pub fn heights(&self) -> &[f32] {
        &self.data.grid.heights
    }

    /// Whether there is no ground in a cell: a hole, or beyond the field.
    #[inline]
    pub fn is_hole(&self, column: usize, row: usize) -> bool {
        let cell = u32::try_from(column).ok().zip(u32::try_from(row).ok());
        cell.is_none_or(|(column, row)| self.data.grid.is_hole(Cell { column, row }))
    }

    /// The cell that a triangle is in: its column and row. Materials are looked up by it.
    ///
    /// ```
    /// use asunder::{HeightField, glam::Vec2};
    /// let field = HeightField::new(4, 3, [0.0; 12], Vec2::ONE)?;
    /// assert_eq!((field.cell_of(5), field.cell_of(6), field.cell_of(12)), (Some((2, 0)), Some((0, 1)), None));
    /// # Ok::<(), asunder::HeightFieldError>(())
    /// ```
    #[inline]
    pub fn cell_of(&self, triangle: u32) -> Option<(usize, usize)> {
        let Cell { column, row } = self.data.grid.cell_of(triangle)?;
        Some((column as usize, row as usize))
    }

    /// The height of the ground at a place, in metres and local axes, rounded to f32; `None` in holes and beyond the
    /// field. Cost: constant.
    ///
    /// ```
    /// use asunder::{HeightField, glam::Vec2};
    /// let ridge = HeightField::new(2, 2, [0.0, 1.0, 1.0, 0.0], Vec2::ONE)?;
    /// assert_eq!([(0.0, 0.0), (0.5, 0.5), (0.75, 0.75)].map(|(x, z)| ridge.height_at(x, z)), [
    ///     Some(0.0),
    ///     Some(1.0),
    ///     Some(0.5)
    /// ]);
    /// # Ok::<(), asunder::HeightFieldError>(())
    /// ```
    pub fn height_at(&self, x: impl Into<f64>, z: impl Into<f64>) -> Option<f32> {
        self.data.grid.height_at([x.into(), z.into()])
    }

    /// Memory that is held, in bytes; clones share it.
    ///
    /// ```
    /// use asunder::{HeightField, glam::Vec2};
    /// let field = HeightField::new(101, 101, vec![0.0; 101 * 101], Vec2::ONE)?;
    /// assert!(field.bytes() > 10_000 * 12 && field.bytes() < 10_000 * 20);
    /// # Ok::<(), asunder::HeightFieldError>(())
    /// ```
    pub fn bytes(&self) -> usize {
        let data = &*self.data;
        let patches = data.patches.capacity() * size_of::<u32>();
        let marks = size_of::<u16>() * data.marks.capacity();
        size_of::<Data>() + data.grid.bytes() + marks + patches + data.blocks.bytes()
    }

    /// The centre of the bounding radius: the middle of its box.
    #[inline]
    pub fn center(&self) -> Vec3 {
        self.data.center
    }

    /// Bounding radius about [`HeightField::center`], in metres, rounded up.
    #[inline]
    pub fn outer_radius(&self) -> f32 {
        self.data.outer_radius
    }

    /// Whether any triangle contains a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        Ground::Field(self).holds(point.into())
    }

    /// A box around the posed field, grown by `margin` metres and rounded outwards. It is the box of the field's own
    /// box, posed; the cost is that of eight corners.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        bounds_of([self.data.low, self.data.high], pose, margin)
    }

    #[inline]
    pub(crate) fn triangle_count(&self) -> u32 {
        self.data.grid.triangle_count()
    }

    #[inline]
    pub(crate) fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.data.grid.corners(triangle)
    }

    #[inline]
    pub(crate) fn triangle(&self, triangle: u32) -> Option<Triangle3> {
        self.data.grid.has(triangle).then(|| Triangle3::known(self.corners(triangle)))
    }

    #[inline]
    pub(crate) fn vertex_numbers(&self, triangle: u32) -> [u32; 3] {
        self.data.grid.vertex_numbers(triangle)
    }

    #[inline]
    pub(crate) fn neighbor(&self, triangle: u32, edge: usize) -> Option<(u32, usize)> {
        self.data.grid.neighbor(triangle, edge % 3)
    }

    #[inline]
    pub(crate) fn prominent(&self, triangle: u32) -> Prominent {
        build::prominent(&self.data.grid, &self.data.marks, triangle)
    }

    #[inline]
    pub(crate) fn patch(&self, triangle: u32) -> u32 {
        self.data.patches.get(triangle as usize).copied().unwrap_or(triangle)
    }
}

/// Equal heights, cells and holes, solid from the same sides.
impl PartialEq for HeightField {
    fn eq(&self, other: &Self) -> bool {
        let is_same = || self.data.grid == other.data.grid;
        self.is_one_sided == other.is_one_sided && (Arc::ptr_eq(&self.data, &other.data) || is_same())
    }
}
