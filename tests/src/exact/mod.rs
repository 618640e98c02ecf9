//! The parts of [`exact_overlap`](crate::exact_overlap): everything here is decided over integers.
//!
//! - [`place`]: posed shapes as pieces with integer coordinates
//! - [`simplex`]: linear programming without fractions, with a proof for either answer
//! - [`share`]: whether two hulls share a point, by guesses that are checked
//! - [`distance`]: the squared distance of two hulls against a squared radius

pub mod distance;
pub mod place;
pub mod share;
pub mod simplex;
