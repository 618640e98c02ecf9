//! Radii of round shapes, and of the rounding that a polygon, cuboid or hull may have.

use crate::outward::round_up;
use crate::tolerance::{MAX_RADIUS, MIN_RADIUS};

/// Why a radius was rejected.
///
/// ```
/// use asunder::{RadiusError, Sphere};
/// assert_eq!(Sphere::new(-0.5).unwrap_err(), RadiusError::Negative { value: -0.5 });
/// assert!(Sphere::new(0.0).unwrap_err().to_string().contains("0.000001"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RadiusError {
    /// NaN or infinite.
    NotFinite {
        /// The given value.
        value: f32,
    },
    /// Below zero.
    Negative {
        /// The given value, in metres.
        value: f32,
    },
    /// The radius of a round shape is below [`MIN_RADIUS`].
    TooSmall {
        /// The given value, in metres.
        value: f32,
    },
    /// The shape would reach further from its origin than [`MAX_RADIUS`].
    TooLarge {
        /// How far it would reach, in metres.
        reach: f32,
    },
}

impl core::fmt::Display for RadiusError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite { value } => {
                write!(f, "radius {value} is not finite: give a number of metres")
            }
            Self::Negative { value } => write!(f, "radius {value} m is negative: give its magnitude"),
            Self::TooSmall { value } => {
                write!(f, "radius {value} m is below {MIN_RADIUS:.6} m: use smaller units")
            }
            Self::TooLarge { reach } => {
                write!(
                    f,
                    "the shape would reach {reach} m, beyond {MAX_RADIUS} m: use larger units, or split it"
                )
            }
        }
    }
}

impl core::error::Error for RadiusError {}

/// Checks the radius of a shape that is round by nature.
pub(crate) fn check_round(radius: f32, core_reach: f64) -> Result<(), RadiusError> {
    check_rounding(radius, core_reach)?;
    if radius < MIN_RADIUS {
        return Err(RadiusError::TooSmall { value: radius });
    }
    Ok(())
}

/// Checks the rounding of a core that reaches `core_reach` metres from its origin. Zero means none.
pub(crate) fn check_rounding(radius: f32, core_reach: f64) -> Result<(), RadiusError> {
    if !radius.is_finite() {
        return Err(RadiusError::NotFinite { value: radius });
    }
    if radius < 0.0 {
        return Err(RadiusError::Negative { value: radius });
    }
    let reach = round_up(core_reach + f64::from(radius));
    if reach > MAX_RADIUS {
        return Err(RadiusError::TooLarge { reach });
    }
    Ok(())
}

/// The bounding radius of a core plus its rounding, rounded up to f32.
#[inline]
pub(crate) fn grown(core: f32, radius: f32) -> f32 {
    if radius == 0.0 { core } else { round_up(f64::from(core) + f64::from(radius)) }
}
