//! Directions, for half-planes, half-spaces and rays.

/// Why a direction was rejected.
///
/// ```
/// use asunder::{DirectionError, HalfSpace, glam::Vec3};
/// assert_eq!(HalfSpace::new(Vec3::ZERO).unwrap_err(), DirectionError::Zero);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DirectionError {
    /// A component is NaN or infinite.
    NotFinite {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value.
        value: f32,
    },
    /// Zero in every component.
    Zero,
}

impl core::fmt::Display for DirectionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite { axis, value } => {
                write!(f, "direction {value} on axis {axis} is not finite: check the step that made it")
            }
            Self::Zero => write!(f, "the direction is zero: give one of any length but zero"),
        }
    }
}

impl core::error::Error for DirectionError {}

/// Rejects directions that are not finite, or zero.
pub(crate) fn check_direction(components: &[f32]) -> Result<(), DirectionError> {
    for (axis, &value) in components.iter().enumerate() {
        if !value.is_finite() {
            return Err(DirectionError::NotFinite { axis, value });
        }
    }
    if components.iter().all(|&value| value == 0.0) {
        return Err(DirectionError::Zero);
    }
    Ok(())
}
