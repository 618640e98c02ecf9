//! Errors of chains.

use crate::tolerance::{MAX_CHAIN_VERTICES, MAX_RADIUS};

/// Why vertices were rejected as a chain.
///
/// ```
/// use asunder::{Chain, ChainError, glam::Vec2};
/// assert_eq!(Chain::open([Vec2::X, Vec2::NAN]), Err(ChainError::NotFinite { index: 1 }));
/// let fault = Chain::closed([Vec2::X, Vec2::Y, Vec2::Y]).unwrap_err();
/// assert_eq!(fault, ChainError::TooFew { count: 2, needed: 3 });
/// assert!(fault.to_string().contains("needs 3"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ChainError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Index of the vertex, as it was given.
        index: usize,
    },
    /// A vertex is further than [`MAX_RADIUS`] from the shape's origin.
    TooLarge {
        /// Index of the vertex, as it was given.
        index: usize,
    },
    /// Fewer vertices than two (three for a closed chain), dropped ones not counted.
    TooFew {
        /// How many there are.
        count: usize,
        /// How many it takes.
        needed: usize,
    },
    /// More than [`MAX_CHAIN_VERTICES`].
    TooMany {
        /// At least this many were given.
        at_least: usize,
    },
}

impl core::fmt::Display for ChainError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NotFinite { index } => write!(f, "vertex {index} is not finite"),
            Self::TooLarge { index } => {
                write!(
                    f,
                    "vertex {index} is more than {MAX_RADIUS} m from the shape's origin: split the chain"
                )
            }
            Self::TooFew { count, needed } => {
                write!(f, "too few distinct vertices: {count}, and such a chain needs {needed}")
            }
            Self::TooMany { at_least } => {
                write!(f, "{at_least} vertices are more than {MAX_CHAIN_VERTICES}: make several chains")
            }
        }
    }
}

impl core::error::Error for ChainError {}
