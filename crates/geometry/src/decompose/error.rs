//! Errors of decomposition.

use crate::tolerance::{MAX_POLYGON_VERTICES, MAX_RADIUS, MIN_RADIUS};

/// Why an outline was rejected by [`decompose`](crate::decompose()). Edge `i` runs from vertex `i` to the next.
///
/// ```
/// use asunder::{DecomposeError, decompose, glam::Vec2};
/// let bow_tie = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)].map(Vec2::from);
/// assert_eq!(decompose(&bow_tie).unwrap_err(), DecomposeError::Crossing { first: 0, second: 2 });
/// let pinched = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)].map(Vec2::from);
/// assert_eq!(decompose(&pinched).unwrap_err(), DecomposeError::Touching { vertex: 3, edge: 0 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DecomposeError {
    /// Fewer than three vertices.
    TooFewVertices {
        /// How many were given.
        count: usize,
    },
    /// More vertices than [`MAX_POLYGON_VERTICES`].
    TooManyVertices {
        /// How many were given.
        count: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the vertex.
        vertex: usize,
    },
    /// A vertex, or the bounding circle of the part that it belongs to, is beyond [`MAX_RADIUS`] from the origin.
    TooLarge {
        /// Index of the vertex.
        vertex: usize,
    },
    /// No part has a bounding radius of [`MIN_RADIUS`] or more.
    TooSmall {
        /// The greatest of their bounding radii, in metres.
        radius: f32,
    },
    /// A part with a bounding radius below [`MIN_RADIUS`] lies beside no larger one, so that leaving it out would lose
    /// a piece.
    TooFine {
        /// Index of a vertex of the part.
        vertex: usize,
    },
    /// Two vertices are the same point.
    Repeated {
        /// Index of the earlier one.
        first: usize,
        /// Index of the later one.
        second: usize,
    },
    /// Two edges cross.
    Crossing {
        /// Index of the earlier edge.
        first: usize,
        /// Index of the later edge.
        second: usize,
    },
    /// A vertex lies on an edge of which it is not an end.
    Touching {
        /// Index of the vertex.
        vertex: usize,
        /// Index of the edge.
        edge: usize,
    },
    /// Two edges lie on one line and share more than a point.
    Overlapping {
        /// Index of the earlier edge.
        first: usize,
        /// Index of the later edge.
        second: usize,
    },
    /// The triangulation is not that of the outline: a bug in this library, found by an exact check.
    Untriangulated {
        /// How many triangles were found.
        triangles: usize,
    },
}

impl core::fmt::Display for DecomposeError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::TooFewVertices { count } => {
                write!(f, "{count} vertices make no outline: give at least 3")
            }
            Self::TooManyVertices { count } => {
                write!(f, "{count} vertices are more than {MAX_POLYGON_VERTICES}: split the outline")
            }
            Self::NotFinite { vertex } => write!(f, "vertex {vertex} is not finite"),
            Self::TooLarge { vertex } => {
                write!(
                    f,
                    "the part at vertex {vertex} reaches beyond {MAX_RADIUS} m from the origin: use larger units"
                )
            }
            Self::TooSmall { radius } => {
                write!(
                    f,
                    "the largest part's radius of {radius} m is below {MIN_RADIUS:.6} m: use smaller units"
                )
            }
            Self::TooFine { vertex } => write!(
                f,
                "the part at vertex {vertex} is smaller than {MIN_RADIUS:.6} m: leave out vertices there, or use smaller units"
            ),
            Self::Repeated { first, second } => {
                write!(
                    f,
                    "vertices {first} and {second} are the same: leave one out, or split the outline there"
                )
            }
            Self::Crossing { first, second } => {
                write!(f, "edges {first} and {second} cross: move or reorder their vertices")
            }
            Self::Touching { vertex, edge } => {
                write!(f, "vertex {vertex} lies on edge {edge}: move it off, or split the outline there")
            }
            Self::Overlapping { first, second } => {
                write!(f, "edges {first} and {second} overlap on one line: leave the doubled stretch out")
            }
            Self::Untriangulated { triangles } => {
                write!(f, "the outline gave {triangles} triangles that do not fit: please report it")
            }
        }
    }
}

impl core::error::Error for DecomposeError {}
