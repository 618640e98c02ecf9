//! Why a cloud of points is no hull.

use crate::tolerance::{MAX_HULL_POINTS, MAX_HULL_VERTICES, MAX_RADIUS, MIN_RADIUS};

/// Why points were refused as a hull.
///
/// ```
/// use asunder_geometry::{Hull, HullError, glam::Vec3};
/// let square = [(0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0)].map(Vec3::from);
/// assert_eq!(Hull::from_points(&square).unwrap_err(), HullError::Flat { dimension: 2 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HullError {
    /// Fewer than four points.
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
        /// What they do span: 0 a point, 1 a line, 2 a plane.
        dimension: u8,
    },
    /// The hull has more vertices than it may.
    TooManyVertices {
        /// How many were found before the search was given up.
        at_least: usize,
    },
}

impl core::fmt::Display for HullError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::TooFewPoints { count } => write!(f, "{count} points make no hull: give at least 4"),
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
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS} m: use larger units")
            }
            Self::Flat { dimension } => {
                let what = ["are one point", "lie on one line", "lie in one plane"];
                write!(f, "the points {}: move one off it", what[usize::from(*dimension).min(2)])
            }
            Self::TooManyVertices { at_least } => write!(
                f,
                "the hull has at least {at_least} vertices, and {MAX_HULL_VERTICES} is the most: give fewer points"
            ),
        }
    }
}

impl core::error::Error for HullError {}
