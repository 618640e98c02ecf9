//! Errors of the vertices of a segment, capsule or triangle.

use crate::tolerance::{MAX_RADIUS, MIN_RADIUS};
use glam::DVec3;

/// Why vertices were rejected.
///
/// ```
/// use asunder::{Segment3, VertexError, glam::Vec3};
/// assert_eq!(Segment3::new(Vec3::X, Vec3::X).unwrap_err(), VertexError::Repeated { first: 0, second: 1 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum VertexError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the vertex.
        index: usize,
    },
    /// A vertex is further than [`MAX_RADIUS`] from the shape's origin.
    TooLarge {
        /// Index of the vertex.
        index: usize,
    },
    /// Two vertices are the same point.
    Repeated {
        /// Index of the earlier one.
        first: usize,
        /// Index of the later one.
        second: usize,
    },
    /// The three vertices of a triangle lie on one line, or closer to one than 1e-7 of its longest side.
    Collinear,
    /// The bounding radius is below [`MIN_RADIUS`].
    TooSmall {
        /// The bounding radius, in metres.
        radius: f32,
    },
}

impl core::fmt::Display for VertexError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite { index } => write!(f, "vertex {index} is not finite"),
            Self::TooLarge { index } => {
                write!(
                    f,
                    "vertex {index} is more than {MAX_RADIUS} m from the shape's origin: split the shape"
                )
            }
            Self::Repeated { first, second } => {
                write!(f, "vertices {first} and {second} are the same: use a shape with fewer of them")
            }
            Self::Collinear => write!(f, "the vertices lie on one line: use a segment"),
            Self::TooSmall { radius } => {
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS:.6} m: use smaller units")
            }
        }
    }
}

impl core::error::Error for VertexError {}

/// Checks the vertices of a segment or triangle; in the plane, z is 0.
pub(crate) fn check_vertices(vertices: &[DVec3]) -> Result<(), VertexError> {
    for (index, vertex) in vertices.iter().enumerate() {
        if !vertex.is_finite() {
            return Err(VertexError::NotFinite { index });
        }
        if vertex.length() > f64::from(MAX_RADIUS) {
            return Err(VertexError::TooLarge { index });
        }
        if let Some(first) = vertices[..index].iter().position(|known| known == vertex) {
            return Err(VertexError::Repeated { first, second: index });
        }
    }
    Ok(())
}

/// Rejects a bounding radius below the least.
pub(crate) fn check_size(radius: f32) -> Result<(), VertexError> {
    if radius < MIN_RADIUS { Err(VertexError::TooSmall { radius }) } else { Ok(()) }
}
