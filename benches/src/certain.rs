//! The cost of certainty: yes or no by the first tier alone, beside yes or no that is never wrong.
//!
//! | figure | meaning |
//! |---|---|
//! | `fast_ns` | `Pair3::new` and `guess`: the first tier, right or wrong |
//! | `certain_ns` | `Pair3::new` and `overlaps` |
//! | `f64_share`, `exact_share` | share of the pairs decided by the second and by the third tier, from `verdict` |
//! | `wrong` | pairs of a subset for which `overlaps` differs from exact arithmetic |
//!
//! Sets are measured in blocks, by both variants in turns; the figure is the median of the blocks, in nanoseconds per
//! pair. The sets are pairs as from a broad phase (`mixed`), faces on faces with an overlap of 1e-3 to 1e-5 of size
//! (`rest3` to `rest5`), walls of bricks, polygons in the plane, and every family of hard cases.

mod bricks;
mod rest;

use crate::clock::{Effort, Samples, time};
use crate::narrow::block_size;
use asunder_narrow::Tier;
use asunder_scenes::hard::{FAMILIES2, FAMILIES3, Family2, Family3};
use asunder_scenes::pairs::{PairSet, PlaneKind, SolidKind, pairs2, pairs3};
use asunder_tests::exact_overlap::Relation;
use asunder_tests::report::{Hard, Posed};
use core::hint::black_box;
use serde::Serialize;

pub use bricks::bricks;
pub use rest::{rest2, rest3};

/// How often a query of the exact tier is repeated for one timing: reading the clock costs about as much as one query.
const REPEATS: usize = 8;

/// The most queries of the exact tier that are timed.
const EXACT_QUERIES: usize = 500;

/// How the shapes of a row are placed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lie {
    /// [`PairSet::Mixed`].
    Mixed,
    /// Face on face, with an overlap of ten to the minus so many of size.
    Rest(u8),
}

/// One row.
#[derive(Clone, Copy)]
pub enum Case {
    /// Solids of a kind.
    Solid(SolidKind, Lie),
    /// Shapes in the plane of a kind.
    Plane(PlaneKind, Lie),
    /// Walls of bricks.
    Bricks,
    /// A hard family in space.
    Hard3(&'static Family3),
    /// A hard family in the plane.
    Hard2(&'static Family2),
}

/// The result of a row. The first seven fields are read by other programs and keep their names.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct CertainRow {
    /// The case.
    pub row: String,
    /// Median nanoseconds per pair for the first tier alone.
    pub fast_ns: f64,
    /// Median nanoseconds per pair for the certain answer.
    pub certain_ns: f64,
    /// `certain_ns` divided by `fast_ns`.
    pub ratio: f64,
    /// The share of the pairs that the f64 tier decided.
    pub f64_share: f64,
    /// The share of the pairs that exact arithmetic decided.
    pub exact_share: f64,
    /// Wrong answers among the pairs that were checked.
    pub wrong: usize,
    /// Median nanoseconds of a query that exact arithmetic decided; `None` if there is none.
    pub exact_ns: Option<f64>,
    /// Pairs in the set.
    pub n: usize,
    /// Pairs that were checked against exact arithmetic.
    pub n_checked: usize,
    /// Wrong answers of the first tier alone, among those.
    pub wrong_fast: usize,
}

/// Every row.
///
/// ```
/// use asunder_benches::certain;
/// let names: Vec<String> = certain::cases().iter().map(certain::name).collect();
/// for name in ["box/mixed", "hull32/rest4", "poly8/rest5", "bricks"] {
///     assert!(names.contains(&name.into()), "{name}");
/// }
/// ```
pub fn cases() -> Vec<Case> {
    const LIES: [Lie; 4] = [Lie::Mixed, Lie::Rest(3), Lie::Rest(4), Lie::Rest(5)];
    let solids = [SolidKind::Box, SolidKind::Hull32];
    let mut cases: Vec<Case> =
        solids.into_iter().flat_map(|kind| LIES.map(|lie| Case::Solid(kind, lie))).collect();
    cases.push(Case::Bricks);
    cases.extend(LIES.map(|lie| Case::Plane(PlaneKind::Poly8, lie)));
    cases.extend(FAMILIES3.iter().map(Case::Hard3));
    cases.extend(FAMILIES2.iter().map(Case::Hard2));
    cases
}

/// The name of a row, as `box/rest4` or `hard/crossed-edges`.
///
/// ```
/// use asunder_benches::certain::{Case, Lie, name};
/// use asunder_scenes::pairs::SolidKind;
/// assert_eq!(name(&Case::Solid(SolidKind::Hull32, Lie::Rest(5))), "hull32/rest5");
/// ```
pub fn name(case: &Case) -> String {
    let lie = |lie: Lie| match lie {
        Lie::Mixed => "mixed".to_string(),
        Lie::Rest(digits) => format!("rest{digits}"),
    };
    match case {
        Case::Solid(kind, how) => format!("{}/{}", kind.name(), lie(*how)),
        Case::Plane(kind, how) => format!("{}/{}", kind.name(), lie(*how)),
        Case::Bricks => "bricks".to_string(),
        Case::Hard3(family) => family.title(),
        Case::Hard2(family) => family.title(),
    }
}

/// Measures one row. Cost: about a second per variant, and making and checking the pairs.
///
/// ```
/// use asunder_benches::{certain::{Case, Lie, measure}, clock::Effort};
/// use asunder_scenes::pairs::SolidKind;
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = measure(&Case::Solid(SolidKind::Box, Lie::Mixed), &effort);
/// assert!(row.wrong == 0 && row.n_checked == 50 && row.ratio > 0.0);
/// assert!(row.to_json().starts_with(r#"{"row":"box/mixed","fast_ns":"#));
/// ```
pub fn measure(case: &Case, effort: &Effort) -> CertainRow {
    let (row, pairs) = (name(case), effort.pairs);
    // Some hard cases have hundreds of vertices, and take as long to make as to check.
    let hard = pairs / 5;
    match case {
        Case::Solid(kind, Lie::Mixed) => of_pairs(row, &pairs3(*kind, PairSet::Mixed, pairs, 1), effort),
        Case::Solid(kind, Lie::Rest(digits)) => {
            of_pairs(row, &rest3(*kind, share(*digits), pairs, 1), effort)
        }
        Case::Plane(kind, Lie::Mixed) => of_pairs(row, &pairs2(*kind, PairSet::Mixed, pairs, 1), effort),
        Case::Plane(kind, Lie::Rest(digits)) => {
            of_pairs(row, &rest2(*kind, share(*digits), pairs, 1), effort)
        }
        Case::Bricks => of_pairs(row, &bricks(pairs, 1), effort),
        Case::Hard3(family) => of_pairs(row, &family.pairs(hard, 1), effort),
        Case::Hard2(family) => of_pairs(row, &family.pairs(hard, 1), effort),
    }
}

/// Ten to the power of minus `digits`.
fn share(digits: u8) -> f64 {
    (0..digits).fold(1.0, |share, _| share * 0.1)
}

fn of_pairs<P: Posed>(row: String, pairs: &[P], effort: &Effort) -> CertainRow {
    let n = pairs.len();
    let tiers: Vec<Tier> = pairs.iter().map(|pair| pair.verdict().tier).collect();
    let share_of = |tier: Tier| tiers.iter().filter(|&&found| found == tier).count() as f64 / n.max(1) as f64;
    let settled_exactly: Vec<&P> =
        pairs.iter().zip(&tiers).filter(|(_, tier)| **tier == Tier::Exact).map(|(pair, _)| pair).collect();
    let [fast, certain] = in_turns(pairs, effort);
    // Spread over the whole set, whatever its order.
    let step = n.div_ceil(if effort.is_quick { 50 } else { 300 }).max(1);
    let judged: Vec<(&P, bool)> =
        pairs.iter().step_by(step).map(|pair| (pair, pair.relation() != Relation::Apart)).collect();
    let (fast_ns, certain_ns) = (fast.median().unwrap_or(0.0), certain.median().unwrap_or(0.0));
    CertainRow {
        row,
        fast_ns,
        certain_ns,
        ratio: if fast_ns > 0.0 { certain_ns / fast_ns } else { 0.0 },
        f64_share: share_of(Tier::Double),
        exact_share: share_of(Tier::Exact),
        wrong: judged.iter().filter(|(pair, exact)| pair.overlaps() != *exact).count(),
        exact_ns: one_by_one(&settled_exactly),
        n,
        n_checked: judged.len(),
        wrong_fast: judged.iter().filter(|(pair, exact)| pair.guess() != *exact).count(),
    }
}

/// Both variants on the same blocks, one after the other; which comes first alternates from block to block.
fn in_turns<P: Posed>(pairs: &[P], effort: &Effort) -> [Samples; 2] {
    let mut samples = [Samples::default(), Samples::default()];
    let first = pairs.first().map_or(0.0, |pair| time(|| pair.overlaps()).0);
    let ask = |variant: usize, pair: &P| if variant == 0 { pair.guess() } else { pair.overlaps() };
    for round in 0..effort.rounds {
        for (index, block) in pairs.chunks(block_size(first, effort)).enumerate() {
            for turn in 0..2 {
                let variant = (round + index + turn) % 2;
                let asked = || block.iter().filter(|pair| ask(variant, black_box(pair))).count();
                let (ns, _) = time(asked);
                samples[variant].push(ns / block.len() as f64, ns);
            }
            if samples.iter().map(Samples::spent).fold(0.0, f64::max) > effort.nanoseconds() {
                return samples;
            }
        }
    }
    samples
}

/// The median cost of some queries, each timed on its own.
fn one_by_one<P: Posed>(pairs: &[&P]) -> Option<f64> {
    let mut samples = Samples::default();
    for pair in pairs.iter().step_by(pairs.len().div_ceil(EXACT_QUERIES).max(1)) {
        let (ns, _) = time(|| (0..REPEATS).filter(|_| black_box(pair).overlaps()).count());
        samples.push(ns / REPEATS as f64, ns);
    }
    samples.median()
}

impl CertainRow {
    /// One line of JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| format!("{{\"row\":\"{}: {error}\"}}", self.row))
    }

    /// One line of a table, under [`heading`].
    pub fn to_text(&self) -> String {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        format!(
            "{:<28} {:>9.0} {:>9.0} {:>7.2} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7}",
            self.row,
            self.fast_ns,
            self.certain_ns,
            self.ratio,
            percent(self.f64_share),
            percent(self.exact_share),
            self.exact_ns.map_or("-".to_string(), |ns| format!("{ns:.0}")),
            self.wrong,
            self.wrong_fast,
            self.n_checked,
        )
    }
}

/// The first line of a table.
///
/// ```
/// assert!(asunder_benches::certain::heading().contains("ratio"));
/// ```
pub fn heading() -> String {
    format!(
        "{:<28} {:>9} {:>9} {:>7} {:>9} {:>9} {:>9} {:>7} {:>7} {:>7}",
        "row", "fast ns", "sure ns", "ratio", "in f64", "exactly", "exact ns", "wrong", "(fast)", "checked"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures_and_no_wrong_answer() {
        let effort = Effort { pairs: 30, rounds: 1, seconds: 0.2, is_quick: true };
        for case in cases() {
            let row = measure(&case, &effort);
            assert!(row.fast_ns > 0.0 && row.ratio > 0.0 && row.n_checked > 0, "{row:?}");
            assert_eq!(row.wrong, 0, "{row:?}");
        }
    }

    #[test]
    fn bricks_are_those_that_the_bound_cannot_settle() {
        let row = measure(&Case::Bricks, &Effort { pairs: 400, rounds: 1, ..Effort::quick() });
        assert!(row.exact_share >= 0.1, "{row:?}");
    }
}
