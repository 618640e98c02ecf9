//! Errors of building a hull from points.

use crate::tolerance::{MAX_HULL_POINTS, MAX_HULL_VERTICES, MAX_RADIUS, MIN_RADIUS};

/// Why points were rejected as a hull.
///
/// ```
/// use asunder::{Hull, HullError, glam::Vec3};
/// let square = [(0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0)].map(Vec3::from);
/// assert_eq!(Hull::from_points(&square).unwrap_err(), HullError::Flat { dimension: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HullError {
    /// Fewer than four points, or none where one would be enough.
    TooFewPoints {
        /// How many were given.
        count: usize,
    },
    /// More points than a hull may be built from.
    TooManyPoints {
        /// How many were given.
        count: usize,
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
    /// The points span no volume.
    Flat {
        /// The dimension of their span: 0 for a point, 1 for a line, 2 for a plane.
        dimension: u8,
    },
    /// The hull has more vertices than it may.
    TooManyVertices {
        /// How many were found before the search was given up. Merging might have removed a few of them.
        at_least: usize,
    },
    /// The requested number of vertices is not 4 to 256.
    VertexLimit {
        /// The requested number.
        max_vertices: usize,
    },
    /// A prism or a pyramid of fewer sides than 3, or of more than its corners allow.
    Sides {
        /// The requested number.
        sides: usize,
        /// The most.
        most: usize,
    },
    /// A half height or a radius of a prism or a pyramid that is not positive and finite.
    NotPositive {
        /// In metres, as it was given.
        value: f32,
    },
}

impl core::fmt::Display for HullError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFewPoints { count } => write!(
                f,
                "{count} points make no hull with a volume: give at least 4, or use Hull::of_any_dimension with at least 1"
            ),
            Self::TooManyPoints { count } => {
                write!(f, "{count} points are more than {MAX_HULL_POINTS}: leave some out")
            }
            Self::NotFinite { index } => write!(f, "point {index} is not finite"),
            Self::TooLarge { index } => {
                write!(
                    f,
                    "point {index} is more than {MAX_RADIUS} m from the shape's origin: split the shape"
                )
            }
            Self::TooSmall { radius } => {
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS:.6} m: use smaller units")
            }
            Self::Flat { dimension } => {
                let what = ["are one point", "lie on one line", "lie in one plane"];
                let what = what[usize::from(*dimension).min(2)];
                write!(f, "the points {what}: use Hull::of_any_dimension, or move one off it")
            }
            Self::TooManyVertices { at_least } => write!(
                f,
                "the hull has {at_least} vertices or more, and {MAX_HULL_VERTICES} is the most: use Hull::simplify"
            ),
            Self::VertexLimit { max_vertices } => {
                write!(
                    f,
                    "a hull of at most {max_vertices} vertices cannot be made: ask for 4 to {MAX_HULL_VERTICES}"
                )
            }
            Self::Sides { sides, most } => {
                write!(f, "{sides} sides cannot be made a hull: ask for 3 to {most}")
            }
            Self::NotPositive { value } => {
                write!(
                    f,
                    "a half height or radius of {value} m makes no hull: give one that is positive and finite"
                )
            }
        }
    }
}

impl core::error::Error for HullError {}
