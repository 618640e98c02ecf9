//! Errors of height fields.

use crate::tolerance::{MAX_FIELD_SIDE, MAX_RADIUS};

/// Why heights were rejected as a height field.
///
/// ```
/// use asunder::{HeightField, HeightFieldError, glam::Vec2};
/// let refused = HeightField::new(2, 2, [0.0, 1.0, f32::NAN, 0.0], Vec2::ONE).unwrap_err();
/// assert_eq!(refused, HeightFieldError::NotFinite { column: 0, row: 1 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HeightFieldError {
    /// Fewer than 2 columns or rows, or more than [`MAX_FIELD_SIDE`].
    Sides {
        /// Columns, as given.
        columns: usize,
        /// Rows, as given.
        rows: usize,
    },
    /// The number of heights is not columns times rows.
    Count {
        /// Columns, as given.
        columns: usize,
        /// Rows, as given.
        rows: usize,
        /// How many heights were given.
        heights: usize,
    },
    /// A side of a cell that is not finite, or not positive.
    Cell {
        /// Which side: 0 along x, 1 along z.
        axis: usize,
        /// The given value, in metres.
        value: f32,
    },
    /// A height is NaN or infinite.
    NotFinite {
        /// Column of the height.
        column: usize,
        /// Row of the height.
        row: usize,
    },
    /// A vertex is further than [`MAX_RADIUS`] from the field's origin.
    TooLarge {
        /// Column of the vertex.
        column: usize,
        /// Row of the vertex.
        row: usize,
    },
    /// A cell is so long, steep or small that its triangles would have no normals.
    Degenerate {
        /// Column of the cell.
        column: usize,
        /// Row of the cell.
        row: usize,
    },
    /// A hole where there is no cell: cells are one fewer than columns, and than rows.
    NoSuchCell {
        /// Column of the hole.
        column: usize,
        /// Row of the hole.
        row: usize,
    },
    /// Every cell is a hole.
    NoGround,
}

impl core::fmt::Display for HeightFieldError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Sides { columns, rows } => {
                write!(f, "{columns} columns of {rows} heights: both are from 2 to {MAX_FIELD_SIDE}")
            }
            Self::Count { columns, rows, heights } => {
                write!(f, "{heights} heights are not {columns} times {rows}: give them row by row")
            }
            Self::Cell { axis, value } => {
                write!(f, "side {axis} of a cell, {value} m, is not finite and positive")
            }
            Self::NotFinite { column, row } => {
                write!(
                    f,
                    "the height at column {column}, row {row} is not finite: give any height that is, and make its cells holes afterwards"
                )
            }
            Self::TooLarge { column, row } => {
                write!(
                    f,
                    "the vertex at column {column}, row {row} is more than {MAX_RADIUS} m from the origin: split it"
                )
            }
            Self::Degenerate { column, row } => {
                write!(
                    f,
                    "the cell at column {column}, row {row} is too long, too steep or too small for a normal"
                )
            }
            Self::NoSuchCell { column, row } => {
                write!(f, "there is no cell at column {column}, row {row}: cells are one less than heights")
            }
            Self::NoGround => write!(f, "every cell is a hole: leave the field out"),
        }
    }
}

impl core::error::Error for HeightFieldError {}
