//! Why a snapshot was rejected.

use crate::collider::MarginError;

/// Why a snapshot was rejected.
///
/// ```
/// use asunder::{Snapshot2, SnapshotError, World2};
/// let text = serde_json::to_string(&World2::new().snapshot())?.replace("\"max_pairs\":16777216", "\"max_pairs\":1");
/// let damaged: Snapshot2 = serde_json::from_str(&text)?;
/// assert!(matches!(World2::restore(&damaged), Err(SnapshotError::Checksum { .. })));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The snapshot has another version of the format than this library.
    Format {
        /// The version that was found.
        found: u32,
    },
    /// A shared shape is invalid, or a body or a part refers to one that does not exist.
    Shape {
        /// The number of the shape among those of its kind, or the slot of the body.
        index: usize,
        /// Why it is invalid.
        reason: String,
    },
    /// A body's margin is invalid.
    Margin {
        /// The body's slot.
        slot: usize,
        /// Why it is invalid.
        error: MarginError,
    },
    /// The version of a slot is even or too great, or the distance that its body has moved is not a possible number.
    Slot {
        /// The slot.
        slot: usize,
    },
    /// The list of empty slots does not contain each of them exactly once.
    Free,
    /// A key that no body of this world has or has ever had.
    Key {
        /// The list that contains it.
        list: &'static str,
        /// Its place in the list.
        index: usize,
    },
    /// A list is not sorted, or has an entry twice.
    Order {
        /// The list.
        list: &'static str,
        /// The place of the first entry that is out of order.
        index: usize,
    },
    /// A contact contradicts itself, or belongs to no candidate.
    Contact {
        /// Its place in the list.
        index: usize,
    },
    /// A manifold has no points, a number that is not finite, or a normal that is not of unit length.
    Manifold {
        /// The place of its contact in the list.
        index: usize,
    },
    /// An impact at a fraction outside of its motion, with a number that is not finite, or with a normal that is not of
    /// unit length.
    Impact {
        /// Its place in the list.
        index: usize,
    },
    /// The data kept of a pair has a number that is not finite, or a manifold that is invalid as in
    /// [`Manifold`](Self::Manifold).
    Candidate {
        /// Its place in the list.
        index: usize,
    },
    /// The numbers differ from those that were saved. Either the file was damaged, or the format does not keep every
    /// bit of a float: serde_json does with its feature `float_roundtrip`.
    Checksum {
        /// The checksum that is stored in the snapshot.
        stored: u64,
        /// The checksum of its numbers.
        found: u64,
    },
}

impl core::fmt::Display for SnapshotError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "snapshot: ")?;
        match self {
            Self::Format { found } => write!(f, "format {found} is not that of this version of asunder"),
            Self::Shape { index, reason } => write!(f, "shape {index}: {reason}"),
            Self::Margin { slot, error } => write!(f, "body in slot {slot}: {error}"),
            Self::Slot { slot } => {
                write!(
                    f,
                    "slot {slot} has a version that is even or too great, or its body went no distance that can be"
                )
            }
            Self::Free => write!(f, "the list of empty slots does not name each of them once"),
            Self::Key { list, index } => {
                write!(f, "number {index} of the {list} has a key that no body of this world ever had")
            }
            Self::Order { list, index } => write!(f, "number {index} of the {list} is out of order"),
            Self::Contact { index } => write!(f, "contact {index} contradicts itself or the candidates"),
            Self::Manifold { index } => write!(f, "contact {index} has a manifold that is none"),
            Self::Impact { index } => write!(f, "impact {index} has numbers that no impact has"),
            Self::Candidate { index } => write!(f, "candidate {index} keeps what cannot be kept"),
            Self::Checksum { stored, found } => write!(
                f,
                "checksum {found:016x} is not {stored:016x}: the file is damaged, or its format does not keep every bit of a float \
                 (turn on `float_roundtrip` of serde_json)"
            ),
        }
    }
}

impl core::error::Error for SnapshotError {}
