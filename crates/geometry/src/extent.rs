//! Errors of the half extents of a rectangle or a cuboid.

use crate::tolerance::{MAX_RADIUS, MIN_RADIUS};

/// Why half extents were rejected.
///
/// ```
/// use asunder::{Cuboid, ExtentError, glam::Vec3};
/// let refused = Cuboid::from_half_extents(Vec3::new(1.0, 0.0, 1.0));
/// assert_eq!(refused.unwrap_err(), ExtentError::NotPositive { axis: 1, value: 0.0 });
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ExtentError {
    /// A half extent is NaN or infinite.
    NotFinite {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value.
        value: f32,
    },
    /// A half extent is zero or negative.
    NotPositive {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value.
        value: f32,
    },
    /// The bounding radius is below the smallest that the engine is made for.
    TooSmall {
        /// The bounding radius, in metres.
        radius: f32,
    },
    /// The bounding radius is above the largest that the engine is made for.
    TooLarge {
        /// The bounding radius, in metres.
        radius: f32,
    },
}

impl core::fmt::Display for ExtentError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite { axis, value } => {
                write!(
                    f,
                    "half extent {value} on axis {axis} is not finite: give a positive number of metres"
                )
            }
            Self::NotPositive { axis, value } => {
                write!(f, "half extent {value} on axis {axis} is not positive: give half of the full size")
            }
            Self::TooSmall { radius } => {
                write!(f, "bounding radius {radius} m is below {MIN_RADIUS} m: use smaller units")
            }
            Self::TooLarge { radius } => {
                write!(f, "bounding radius {radius} m is above {MAX_RADIUS} m: use larger units, or split it")
            }
        }
    }
}

impl core::error::Error for ExtentError {}

/// Checks half extents and returns the bounding radius, rounded up.
pub(crate) fn bounding_radius(half_extents: &[f32]) -> Result<f32, ExtentError> {
    let mut squared = 0.0_f64;
    for (axis, &value) in half_extents.iter().enumerate() {
        if !value.is_finite() {
            return Err(ExtentError::NotFinite { axis, value });
        }
        if value <= 0.0 {
            return Err(ExtentError::NotPositive { axis, value });
        }
        squared += f64::from(value) * f64::from(value);
    }
    let radius = crate::outward::round_up(squared.sqrt() * (1.0 + 4.0 * f64::EPSILON));
    if radius < MIN_RADIUS {
        return Err(ExtentError::TooSmall { radius });
    }
    if radius > MAX_RADIUS {
        return Err(ExtentError::TooLarge { radius });
    }
    Ok(radius)
}
