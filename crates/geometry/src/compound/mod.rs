//! Several convex parts under one collider.

mod plane;
mod space;

pub use plane::{Compound2, Part2};
pub use space::{Compound3, Part3};

use crate::aabb::Aabb3;
use crate::ground::tree::{Sides, Tree};
use crate::tolerance::{MAX_PARTS, MAX_RADIUS};

/// Why parts were rejected as a compound.
///
/// ```
/// use asunder::{Compound3, CompoundError};
/// assert_eq!(Compound3::new([]), Err(CompoundError::NoParts));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CompoundError {
    /// None were given.
    NoParts,
    /// More than [`MAX_PARTS`].
    TooManyParts {
        /// How many were given.
        count: usize,
    },
    /// A part is itself a compound.
    Nested {
        /// Index of the part.
        index: usize,
    },
    /// A part is unbounded.
    Unbounded {
        /// Index of the part.
        index: usize,
    },
    /// A part is ground, which is not convex and never moves.
    Ground {
        /// Index of the part.
        index: usize,
    },
    /// A part reaches further than [`MAX_RADIUS`] from the compound's origin.
    TooLarge {
        /// Index of the part.
        index: usize,
    },
}

impl core::fmt::Display for CompoundError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoParts => write!(f, "a compound needs a part"),
            Self::TooManyParts { count } => {
                write!(f, "{count} parts are more than {MAX_PARTS}: make several bodies of one owner")
            }
            Self::Nested { index } => {
                write!(f, "part {index} is made of several parts itself: give those instead")
            }
            Self::Unbounded { index } => {
                write!(f, "part {index} has no end: make it a body of its own")
            }
            Self::Ground { index } => {
                write!(f, "part {index} is ground: make it a body of its own")
            }
            Self::TooLarge { index } => {
                write!(f, "part {index} reaches beyond {MAX_RADIUS} m from the compound's origin: split it")
            }
        }
    }
}

impl core::error::Error for CompoundError {}

/// From this many parts on, they are looked up in their tree; of fewer all are tested.
const MANY_PARTS: usize = 16;

/// The tree of the parts, by their boxes.
fn tree_of(boxes: &[Aabb3]) -> Tree {
    let sides = |number: u32| -> Sides {
        let Some(Aabb3 { min, max }) = boxes.get(number as usize) else { return [0.0; 6] };
        [min.x, min.y, min.z, max.x, max.y, max.z]
    };
    Tree::new(0..boxes.len() as u32, sides)
}
