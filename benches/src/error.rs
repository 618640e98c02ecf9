//! Speed against error: how fast each method answers, and how wrong it is where that is hard.
//!
//! # The question
//! Every method is asked **"apart, or how deep?"** about two posed shapes. In a gap "apart" is the whole answer; in
//! overlap it is the depth, the least translation that parts them. How wide a gap is, which methods mean differently
//! (the Euclidean distance, or the best axis that was tried), is not asked.
//!
//! | method | what is called |
//! |---|---|
//! | `textbook-f32`, `textbook-f64` | SAT as in books (`textbook.rs`), shapes prepared beforehand |
//! | `fast` | `guess` of `Pair3` and `Pair2`: our first tier alone, a yes or no that may be wrong. It gives **no depth** |
//! | `certain` | `separation(0)`: its sign is the exact answer, its depth has a bound |
//! | `batched-boxes` | `separations3(0)` over 128 pairs: the same answers; cuboids go eight at a time, anything else alone |
//! | `parry-f32`, `parry-f64` | `contact` with prediction 0; shapes converted beforehand, equal ones shared |
//!
//! # The truth
//! Yes or no is exact: that of integers, wherever a separation in double-double is within 1e-9 of the size of zero. The
//! separation is that of `asunder_tests::precise`, right to a unit or two in the last place of an f64. Both are found
//! once a pair and held against every method.
//!
//! # The figures
//! - **Error**: |said - true separation| / size, the size being the sum of the bounding radii. Of pairs that share a
//!   point, and of those of which a method says so; where there is a gap and it says so, there is no number to be
//!   wrong. A word without a number is off by what contradicts it: "apart" by the depth that there is, a bare
//!   "touching" (which is all that `fast` says) by the gap. So `fast` has a place among wrong answers, and none in a
//!   front of time against error.
//! - **Wrong**: strictly apart or strictly overlapping, and answered otherwise. What touches exactly is neither; there
//!   "apart" is wrong in [`GapRow`] alone, under the decade -99. A positive "depth" counts as "apart".
//! - **Refused**: a NaN, also in the normal, a panic, or a shape that a method will not have. It is not wrong, and has
//!   no error. A peer's panics are caught; the program's panic hook still prints them.
//! - **Time**: thread CPU time. All methods take turns on chunks of 128 pairs, who is first changing from chunk to
//!   chunk, each after a chunk that is not timed; a round over all chunks gives one sample a method, and the row has
//!   their median and quartiles ([`Samples::spread`](crate::clock::Samples::spread)). Timed are the first pairs of a
//!   group, which hold every kind and level in turn; what is timed is what is judged. Making a pair's relative pose is
//!   part of the question.
//!
//! In the plane there is no peer. Groups stand in `groups.rs`, measures of stability in `stability.rs`.

mod groups;
mod methods;
mod speed;
mod stability;
mod textbook;
mod truth;
mod vertices;

use serde::{Deserialize, Serialize};

/// What one method took for a group of pairs, and how wrong it was.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// The family of pairs: `random-mixed`, `resting`, `near-touching`, `parallel-edges`, `slivers`, `far` or
    /// `tiny-and-huge`.
    pub group: String,
    /// Who answered: `textbook-f32`, `textbook-f64`, `fast`, `certain`, `batched-boxes`, `parry-f32` or `parry-f64`.
    pub method: String,
    /// How many pairs were asked about.
    pub pairs: u64,
    /// Pairs that do not touch exactly, and were answered: those that may be wrong.
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
    /// Pairs strictly apart or strictly overlapping that were answered wrongly, in 100,000.
    pub wrong_per_100k: f64,
    /// How often no answer came: NaN, a panic, or none.
    pub refused: u64,
}

/// How often one method was wrong where the gap is about so wide.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// The family of pairs, as in [`ErrorRow`].
    pub group: String,
    /// Who answered, as in [`ErrorRow`].
    pub method: String,
    /// floor(log10(|gap| / size)), within -18 to 0; -99 where the two touch exactly.
    pub decade: i32,
    /// Whether the two are apart.
    pub apart: bool,
    /// How many pairs there are.
    pub pairs: u64,
    /// How many of them were answered wrongly.
    pub wrong: u64,
}

/// How steady one method's answers are.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityRow {
    /// `jitter-1ulp`, `count-changes`, `normal-flips`, `drifting-depth` or `standing-stack`.
    pub measure: String,
    /// What was placed.
    pub shape: String,
    /// Who answered, as in [`ErrorRow`].
    pub method: String,
    /// How many numbers the next three are taken from.
    pub samples: u64,
    /// Their median.
    pub median: f64,
    /// Their 99th percentile.
    pub p99: f64,
    /// The greatest.
    pub max: f64,
    /// What they are counted in.
    pub unit: String,
}

/// What one question costs shapes of so many vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct VertexRow {
    /// `2d` or `3d`.
    pub dimension: String,
    /// `boolean`, `separation` or `manifold`.
    pub operation: String,
    /// Who answered, as in [`ErrorRow`].
    pub method: String,
    /// Vertices of each of the two.
    pub vertices: u32,
    /// Median time of a query over rounds, in nanoseconds of thread CPU time.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
}

/// Time and error of every method, a group of pairs at a time; `quick` in about a tenth of the time.
pub fn speed_against_error(quick: bool, progress: &dyn Fn(&str)) -> Vec<ErrorRow> {
    speed::all(quick, progress)
}

/// Wrong answers of every method by the width of the gap; `quick` in about a tenth of the time.
pub fn wrong_by_gap(quick: bool, progress: &dyn Fn(&str)) -> Vec<GapRow> {
    speed::by_gap(quick, progress)
}

/// How steady answers are; `quick` in about a tenth of the time.
pub fn stability(quick: bool, progress: &dyn Fn(&str)) -> Vec<StabilityRow> {
    stability::all(quick, progress)
}

/// Time against vertices; `quick` in about a tenth of the time.
pub fn vertices(quick: bool, progress: &dyn Fn(&str)) -> Vec<VertexRow> {
    vertices::all(quick, progress)
}
