//! Speed against error: how fast each method answers, and how wrong it is on hard cases.
//!
//! # The question
//! Every method is asked **"apart, or how deep?"** about two posed shapes. For a gap, "apart" is the whole answer; for
//! an overlap it is the depth, the least translation that separates them. The width of a gap is not asked for, since
//! methods define it differently (the Euclidean distance, or the best axis that was tried).
//!
//! | method | calls |
//! |---|---|
//! | `textbook-f32`, `textbook-f64` | SAT as in textbooks (`textbook.rs`), with shapes prepared beforehand |
//! | `fast` | `guess` of `Pair3` and `Pair2`: our first tier alone, a yes or no that may be wrong. It gives **no depth** |
//! | `certain` | `separation(0)`: its sign is the exact answer, its depth has a bound |
//! | `batched-boxes` | `separations3(0)` over 128 pairs: the same answers; cuboids go eight at a time, anything else alone |
//! | `parry-f32`, `parry-f64` | `contact` with prediction 0; shapes converted beforehand, equal ones shared |
//!
//! # The truth
//! Yes or no is exact: decided in integers wherever the separation in double-double is within 1e-9 of the size of zero.
//! The separation is that of `asunder_tests::precise`, accurate to a unit or two in the last place of an f64. Both are
//! computed once per pair and compared with every method.
//!
//! # The figures
//! - **Error**: |answer - true separation| / size, where size is the sum of the bounding radii. It is taken of pairs
//!   that share a point, and of those that a method says do; where there is a gap and the method says so, there is no
//!   number to be wrong. An answer without a number is off by what contradicts it: "apart" by the true depth, a bare
//!   "touching" (which is all that `fast` gives) by the gap. So `fast` appears among wrong answers, but not on a front
//!   of time against error.
//! - **Wrong**: strictly apart or strictly overlapping, and answered otherwise. Exact touching is neither; for it,
//!   "apart" counts as wrong only in [`GapRow`], under the decade -99. A positive "depth" counts as "apart".
//! - **Refused**: a NaN, also in the normal, a panic, or a shape that the method does not accept. It does not count as
//!   wrong, and has no error. A peer's panics are caught; the program's panic hook still prints them.
//! - **Time**: thread CPU time. All methods take turns on chunks of 128 pairs, each after a chunk that is not timed;
//!   which comes first alternates from chunk to chunk. A round over all chunks gives one sample per method, and the row
//!   has their median and quartiles ([`Samples::spread`](crate::clock::Samples::spread)). The timed pairs are the first
//!   of a group, which has every kind and level in turn; the calls that are timed are those that are judged. Computing
//!   a pair's relative pose is part of the query.
//!
//! In the plane there is no peer. Groups are in `groups.rs`, measures of stability in `stability.rs`.

mod groups;
mod methods;
mod speed;
mod stability;
mod textbook;
mod truth;
mod vertices;

use serde::{Deserialize, Serialize};

/// The time and errors of one method on a group of pairs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// The family of pairs: `random-mixed`, `resting`, `near-touching`, `parallel-edges`, `slivers`, `far` or
    /// `tiny-and-huge`.
    pub group: String,
    /// The method: `textbook-f32`, `textbook-f64`, `fast`, `certain`, `batched-boxes`, `parry-f32` or `parry-f64`.
    pub method: String,
    /// How many pairs were asked about.
    pub pairs: u64,
    /// Pairs that do not touch exactly and were answered: those whose answer can be wrong.
    pub answered: u64,
    /// Median time of a query over rounds, in nanoseconds of thread CPU time.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
    /// 99th percentile of |separation - truth| / size.
    pub error_p99: f64,
    /// Greatest |separation - truth| / size.
    pub error_max: f64,
    /// Strictly apart or strictly overlapping pairs that were answered wrongly, per 100,000.
    pub wrong_per_100k: f64,
    /// How often there was no answer: NaN, a panic, or none.
    pub refused: u64,
}

/// How often one method was wrong, for pairs of similar gap or depth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// The family of pairs, as in [`ErrorRow`].
    pub group: String,
    /// The method, as in [`ErrorRow`].
    pub method: String,
    /// floor(log10(|separation| / size)), clamped to -18 to 0; -99 for exact touching.
    pub decade: i32,
    /// Whether the two are apart.
    pub apart: bool,
    /// How many pairs there are.
    pub pairs: u64,
    /// How many of them were answered wrongly.
    pub wrong: u64,
}

/// How stable one method's answers are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityRow {
    /// `jitter-1ulp`, `count-changes`, `normal-flips`, `drifting-depth` or `standing-stack`.
    pub measure: String,
    /// The shape that was placed.
    pub shape: String,
    /// The method, as in [`ErrorRow`].
    pub method: String,
    /// How many samples the next three figures are taken from.
    pub samples: u64,
    /// Their median.
    pub median: f64,
    /// Their 99th percentile.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
    /// Their unit.
    pub unit: String,
}

/// The cost of one query for shapes of so many vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VertexRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// `boolean`, `separation` or `manifold`.
    pub operation: String,
    /// The method, as in [`ErrorRow`].
    pub method: String,
    /// Vertices of each of the two shapes.
    pub vertices: u32,
    /// Median time of a query over rounds, in nanoseconds of thread CPU time.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
}

/// Time and error of every method, group by group; `quick` takes about a tenth of the time.
pub fn speed_against_error(quick: bool, progress: &dyn Fn(&str)) -> Vec<ErrorRow> {
    speed::all(quick, progress)
}

/// Wrong answers of every method by the size of the gap; `quick` takes about a tenth of the time.
pub fn wrong_by_gap(quick: bool, progress: &dyn Fn(&str)) -> Vec<GapRow> {
    speed::by_gap(quick, progress)
}

/// How stable answers are; `quick` takes about a tenth of the time.
pub fn stability(quick: bool, progress: &dyn Fn(&str)) -> Vec<StabilityRow> {
    stability::all(quick, progress)
}

/// Time against vertices; `quick` takes about a tenth of the time.
pub fn vertices(quick: bool, progress: &dyn Fn(&str)) -> Vec<VertexRow> {
    vertices::all(quick, progress)
}
