//! Boxes in, candidate pairs out.
//!
//! A broad phase knows no shapes: it is given axis-aligned boxes, numbered by their place in a slice, and finds which
//! of them overlap. Boxes are closed sets, so touching counts; a box with a NaN, or with a minimum above its maximum,
//! is empty and overlaps nothing. The pair list is sorted, and is a function of the boxes alone.
//!
//! ```
//! use asunder_broad::{PairId, Sweep};
//! use asunder_geometry::{Aabb2, glam::Vec2};
//!
//! let boxes = [(0.0, 1.0), (0.5, 1.5), (1.5, 2.0)].map(|(low, high)| Aabb2::new(Vec2::splat(low), Vec2::splat(high)));
//! let mut pairs = Vec::new();
//! Sweep::new().pairs(&boxes, |_, _| true, usize::MAX, &mut pairs)?;
//! assert_eq!(pairs, [PairId { a: 0, b: 1 }, PairId { a: 1, b: 2 }]);
//! # Ok::<(), asunder_broad::TooManyPairs>(())
//! ```
#![deny(missing_docs)]

mod coherent;
mod columns;
mod index;
mod loose;
mod pair;
mod plain;
mod sift;
mod sweep;
mod width;

pub use coherent::CoherentSweep;
pub use columns::Column;
pub use index::{Cast, Found, Index, Queue, least_distance};
pub use loose::{LooseSweep, Moved};
pub use pair::{PairId, TooManyPairs};
pub use plain::PlainSweep;
pub use sweep::Sweep;
