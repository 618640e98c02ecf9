//! Errors of polygons.

use crate::tolerance::{MAX_POLYGON_VERTICES, MAX_RADIUS, MIN_RADIUS};

/// Why the vertices of a polygon were rejected.
///
/// ```
/// use asunder::{Polygon, PolygonError, glam::Vec2};
/// let dart = [(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)].map(Vec2::from);
/// assert_eq!(Polygon::new(&dart).unwrap_err(), PolygonError::Concave { vertex: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PolygonError {
    /// Fewer than three points.
    TooFewPoints {
        /// How many were given.
        count: usize,
    },
    /// More vertices than a polygon may have: [`MAX_POLYGON_VERTICES`].
    TooManyVertices {
        /// How many there would be.
        count: usize,
    },
    /// The number of vertices to keep is below 3 or above [`MAX_POLYGON_VERTICES`].
    LimitOutOfRange {
        /// The number asked for.
        max_vertices: usize,
    },
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the point.
        index: usize,
    },
    /// A point is further than [`MAX_RADIUS`] from the shape's origin.
    TooLarge {
        /// Index of the point.
        index: usize,
    },
    /// The bounding radius is below [`MIN_RADIUS`].
    TooSmall {
        /// The bounding radius, in metres.
        radius: f32,
    },
    /// Two vertices are the same point.
    Repeated {
        /// Index of the earlier one.
        first: usize,
        /// Index of the later one.
        second: usize,
    },
    /// All points lie on one line.
    Collinear,
    /// The vertices wind clockwise.
    Clockwise,
    /// The outline turns inwards at a vertex.
    Concave {
        /// Index of the vertex.
        vertex: usize,
    },
    /// Every vertex turns left, but the outline winds around more than once, like a star's.
    WindsRepeatedly,
    /// A regular polygon of fewer sides than 3, or of more than [`MAX_POLYGON_VERTICES`].
    Sides {
        /// The requested number.
        sides: usize,
    },
    /// A radius of a regular polygon that is not positive and finite.
    NotPositive {
        /// In metres, as it was given.
        value: f32,
    },
}

impl core::fmt::Display for PolygonError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFewPoints { count } => write!(f, "{count} points make no polygon: give at least 3"),
            Self::TooManyVertices { count } => {
                write!(f, "{count} vertices are more than {MAX_POLYGON_VERTICES}: use Polygon::simplify")
            }
            Self::LimitOutOfRange { max_vertices } => {
                write!(
                    f,
                    "no polygon has at most {max_vertices} vertices: ask for 3 to {MAX_POLYGON_VERTICES}"
                )
            }
            Self::NotFinite { index } => write!(f, "point {index} is not finite"),
            Self::TooLarge { index } => {
                write!(
                    f,
                    "point {index} is more than {MAX_RADIUS} m from the shape's origin: split the shape"
                )
            }
            Self::TooSmall { radius } => {
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS} m: use smaller units")
            }
            Self::Repeated { first, second } => {
                write!(f, "points {first} and {second} are the same: leave one out, or use Polygon::hull_of")
            }
            Self::Collinear => write!(f, "all points lie on one line"),
            Self::Clockwise => write!(f, "the vertices wind clockwise: reverse their order"),
            Self::Concave { vertex } => {
                write!(
                    f,
                    "the outline turns inwards at vertex {vertex}: use Polygon::hull_of, or decompose it into a Compound2"
                )
            }
            Self::WindsRepeatedly => {
                write!(f, "the outline runs around more than once: use Polygon::hull_of")
            }
            Self::Sides { sides } => {
                write!(f, "no polygon has {sides} sides: ask for 3 to {MAX_POLYGON_VERTICES}")
            }
            Self::NotPositive { value } => {
                write!(f, "a radius of {value} m makes no polygon: give one that is positive and finite")
            }
        }
    }
}

impl core::error::Error for PolygonError {}

/// Why stored data do not make a polygon.
#[cfg(feature = "serde")]
#[derive(Debug, PartialEq)]
pub(crate) enum StoredPolygonError {
    Outline(PolygonError),
    /// A vertex lies on the line between its neighbours, which no polygon keeps.
    NoCorner,
    /// The error is negative, not finite, or larger than any polygon.
    BadError {
        value: f32,
    },
}

#[cfg(feature = "serde")]
impl core::fmt::Display for StoredPolygonError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "stored polygon: ")?;
        match self {
            Self::Outline(error) => error.fmt(f),
            Self::NoCorner => write!(f, "a vertex lies on the line between its neighbours"),
            Self::BadError { value } => write!(f, "{value} m is no error of a polygon"),
        }
    }
}
