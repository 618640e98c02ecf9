//! The report on hard cases: what we and parry3d get wrong, by how much, and at what cost, family by family.
//!
//! ```text
//! posed   one trait for pairs in space and in the plane: our answers, the oracles', the peers'
//! judged  one case: all our promises checked against the oracles, every breach reported with its numbers
//! peers   parry3d in f32 and in f64, called so that a panic or a NaN is an answer like any other
//! tally   many cases of one family added up, in any order with the same result
//! times   nanoseconds per query, on one thread, in turns
//! table   rows for a program and a table for people
//! ```
//! Overlap is checked on every case by exact arithmetic. The true separation, which is needed for errors, costs more,
//! so it is computed on every k-th case ([`Scope::truth_every`]).

mod judged;
pub mod peers;
mod posed;
mod table;
mod tally;
mod times;

pub use judged::{Fault, FaultKind, Judged, Question, judge};
pub use peers::Said;
pub use posed::{Ours, Posed, Reported, Truth};
pub use table::{Row, header, markdown};
pub use tally::{Hard, Offender, PeerTally, Scope, Tally, shares, tally, weight};
pub use times::{Times, times};

use asunder_scenes::pairs::{PosedPair2, PosedPair3};

/// Judges one pair in space, including errors, without the peers.
///
/// ```
/// use asunder_scenes::pairs::{PairSet, SolidKind, pairs3};
/// let judged = asunder_tests::report::judge3(&pairs3(SolidKind::Box, PairSet::Mixed, 1, 1)[0]);
/// assert!(judged.faults.is_empty() && judged.truth.is_some());
/// ```
pub fn judge3(pair: &PosedPair3) -> Judged {
    judge(pair, Question { truth: true, peers: false })
}

/// Judges one pair in the plane, including errors.
///
/// ```
/// use asunder_scenes::pairs::{PairSet, PlaneKind, pairs2};
/// let judged = asunder_tests::report::judge2(&pairs2(PlaneKind::Rect, PairSet::Mixed, 1, 1)[0]);
/// assert!(judged.faults.is_empty() && judged.truth.is_some());
/// ```
pub fn judge2(pair: &PosedPair2) -> Judged {
    judge(pair, Question { truth: true, peers: false })
}
