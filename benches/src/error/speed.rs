//! Time and error, group by group; and wrong answers by the size of the gap.

use super::groups::{GROUPS, Grouped};
use super::methods::{Asked, Method, Prepared, Said};
use super::truth::{Judged, Truth, truths};
use super::{ErrorRow, GapRow};
use crate::clock::{Samples, Spread, quantiles, time};
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use asunder_tests::exact_overlap::Relation;
use rayon::prelude::*;

/// Pairs per chunk. Reading the clock costs about as much as one query.
const CHUNK: usize = 128;

/// The least and the most rounds over all chunks.
const ROUNDS: [usize; 2] = [5, 31];

/// The amount of work.
struct Effort {
    /// Pairs of random-mixed, and of every other group.
    pairs: [usize; 2],
    /// How many pairs are timed.
    timed: usize,
    /// CPU seconds for timing a group, all methods together.
    seconds: f64,
}

/// Everything of both dimensions.
pub(super) fn all(quick: bool, progress: &dyn Fn(&str)) -> Vec<ErrorRow> {
    let (few, seconds) = if quick { (10, 0.1) } else { (1, 1.0) };
    let in_space = Effort { pairs: [100_000 / few, 10_000 / few], timed: 1024, seconds: 6.0 * seconds };
    let in_plane = Effort { timed: 2048, seconds: 2.0 * seconds, ..in_space };
    let mut rows = of_dimension::<PosedPair3>(&in_space, progress);
    rows.extend(of_dimension::<PosedPair2>(&in_plane, progress));
    rows
}

fn of_dimension<P: Grouped + Judged + Asked>(effort: &Effort, progress: &dyn Fn(&str)) -> Vec<ErrorRow> {
    let mut rows = Vec::new();
    for (name, count) in GROUPS.into_iter().zip([effort.pairs[0]].into_iter().chain([effort.pairs[1]; 6])) {
        progress(&format!("speed against error, {}, {name}", P::DIMENSION));
        rows.extend(of_group::<P>(name, count, effort));
    }
    rows
}

fn of_group<P: Grouped + Judged + Asked>(name: &str, count: usize, effort: &Effort) -> Vec<ErrorRow> {
    let pairs = P::group(name, count, 1);
    let (methods, truths) = (P::methods(), truths(&pairs));
    let answers = said_by_all(&methods, &pairs);
    let samples = in_turns(&methods, &pairs[..effort.timed.min(pairs.len())], effort.seconds);
    let row = |((method, said), samples): ((&Method<P>, Vec<Said>), Samples)| {
        let tally = Tally::new(&truths, &said);
        let spread = samples.spread().unwrap_or(Spread { low: 0.0, median: 0.0, high: 0.0 });
        let [p99, max] = quantiles(&tally.errors, [0.99, 1.0]).unwrap_or([0.0; 2]);
        ErrorRow {
            dimension: P::DIMENSION.to_string(),
            group: name.to_string(),
            method: method.name.to_string(),
            pairs: pairs.len() as u64,
            answered: tally.strict,
            ns: spread.median,
            ns_low: spread.low,
            ns_high: spread.high,
            error_p99: p99,
            error_max: max,
            wrong_per_100k: 1e5 * tally.wrong as f64 / tally.strict.max(1) as f64,
            refused: tally.refused,
        }
    };
    methods.iter().zip(answers).zip(samples).map(row).collect()
}

/// The answers of every method about every pair, on all threads.
fn said_by_all<P: Sync>(methods: &[Method<P>], pairs: &[P]) -> Vec<Vec<Said>> {
    let by_method = |method: &Method<P>| {
        let of_chunk = |chunk| {
            let mut said = Vec::with_capacity(CHUNK);
            (method.prepare)(chunk).say(&mut said);
            said
        };
        pairs.par_chunks(CHUNK).flat_map_iter(of_chunk).collect()
    };
    methods.iter().map(by_method).collect()
}

/// The time per pair of each method: chunk by chunk in turns, one sample per round; which comes first alternates.
///
/// Before a method is timed on a chunk, it runs on another one, so that its code is in the caches whichever method came
/// before: without that, `fast` took 490 ns for mixed pairs in place of 350, beside a textbook that takes fifty times
/// as long (AMD EPYC, Zen 4, 2026-11-22).
pub(super) fn in_turns<P>(methods: &[Method<P>], pairs: &[P], seconds: f64) -> Vec<Samples> {
    let prepared: Vec<Vec<Box<dyn Prepared + '_>>> = pairs
        .chunks(CHUNK)
        .map(|chunk| methods.iter().map(|method| (method.prepare)(chunk)).collect())
        .collect();
    let mut samples = vec![Samples::default(); methods.len()];
    let mut said = Vec::with_capacity(CHUNK);
    for round in 0..ROUNDS[1] {
        let mut spent = vec![0.0; methods.len()];
        for (index, chunk) in prepared.iter().enumerate() {
            for turn in 0..methods.len() {
                let method = (round + index + turn) % methods.len();
                said.clear();
                prepared[(index + 1) % prepared.len()][method].say(&mut said);
                said.clear();
                spent[method] += time(|| chunk[method].say(&mut said)).0;
            }
        }
        for (samples, spent) in samples.iter_mut().zip(spent) {
            samples.push(spent / pairs.len().max(1) as f64, spent);
        }
        if round + 1 >= ROUNDS[0] && samples.iter().map(Samples::spent).sum::<f64>() > seconds * 1e9 {
            break;
        }
    }
    samples
}

/// One method's answers compared with the truth.
#[derive(Debug, Default)]
struct Tally {
    /// Pairs that do not touch exactly and were answered.
    strict: u64,
    wrong: u64,
    refused: u64,
    /// Errors as shares of the size, of pairs that share a point and of those that the method says do.
    errors: Vec<f64>,
}

impl Tally {
    fn new(truths: &[Truth], said: &[Said]) -> Self {
        let mut tally = Self::default();
        for (truth, &said) in truths.iter().zip(said) {
            tally.strict += u64::from(truth.relation != Relation::Touching && said != Said::Refused);
            tally.wrong += u64::from(is_wrong(truth.relation, said));
            tally.refused += u64::from(said == Said::Refused);
            tally.errors.extend(error(truth, said));
        }
        tally
    }
}

/// Whether a strictly apart or strictly overlapping pair was answered wrongly.
fn is_wrong(relation: Relation, said: Said) -> bool {
    match (relation, said) {
        (Relation::Touching, _) | (_, Said::Refused) => false,
        (Relation::Apart, said) => said != Said::Apart,
        (Relation::Overlapping, said) => said == Said::Apart,
    }
}

/// How far an answer is off, as a share of the size. An answer without a number is off by what contradicts it; `None`
/// where there is a gap and the method says so, since that has no number.
fn error(truth: &Truth, said: Said) -> Option<f64> {
    let off = match said {
        Said::Refused => return None,
        Said::Apart if truth.relation == Relation::Apart => return None,
        Said::Apart => -truth.separation,
        Said::Touching => truth.separation.max(0.0),
        Said::Deep(separation) => (separation - truth.separation).abs(),
    };
    Some(off / truth.size)
}

/// Wrong answers by the size of the gap, in every group except the random one, where hardly any gap is small.
pub(super) fn by_gap(quick: bool, progress: &dyn Fn(&str)) -> Vec<GapRow> {
    let count = if quick { 2000 } else { 20_000 };
    let mut rows = gaps_of_dimension::<PosedPair3>(count, progress);
    rows.extend(gaps_of_dimension::<PosedPair2>(count, progress));
    rows
}

fn gaps_of_dimension<P: Grouped + Judged + Asked>(count: usize, progress: &dyn Fn(&str)) -> Vec<GapRow> {
    let mut rows = Vec::new();
    for name in &GROUPS[1..] {
        progress(&format!("wrong answers by gap, {}, {name}", P::DIMENSION));
        // A seed of its own, so that these are other pairs than those of the first table.
        let pairs = P::group(name, count, 2);
        let (methods, truths) = (P::methods(), truths(&pairs));
        let answers = said_by_all(&methods, &pairs);
        for (method, said) in methods.iter().zip(answers) {
            rows.extend(count_by_decade(&truths, &said).into_iter().map(|cell| GapRow {
                dimension: P::DIMENSION.to_string(),
                group: name.to_string(),
                method: method.name.to_string(),
                decade: cell.decade,
                apart: cell.apart,
                pairs: cell.pairs,
                wrong: cell.wrong,
            }));
        }
    }
    rows
}

/// The decade of exact touching.
const TOUCHING: i32 = -99;

/// Pairs of similar gap or depth, on one side of touching.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cell {
    decade: i32,
    apart: bool,
    pairs: u64,
    wrong: u64,
}

/// In order of the decade, overlapping before apart. Exact touching counts as overlapping; a refusal is not wrong.
fn count_by_decade(truths: &[Truth], said: &[Said]) -> Vec<Cell> {
    let mut cells: Vec<Cell> = Vec::new();
    for (truth, &said) in truths.iter().zip(said) {
        let is_touching = truth.relation == Relation::Touching;
        let decade = if is_touching { TOUCHING } else { decade(truth.separation.abs() / truth.size) };
        let apart = truth.relation == Relation::Apart;
        let wrong = if is_touching { said == Said::Apart } else { is_wrong(truth.relation, said) };
        let place = cells.binary_search_by_key(&(decade, apart), |cell| (cell.decade, cell.apart));
        let index = place.unwrap_or_else(|index| {
            cells.insert(index, Cell { decade, apart, pairs: 0, wrong: 0 });
            index
        });
        cells[index].pairs += 1;
        cells[index].wrong += u64::from(wrong);
    }
    cells
}

/// floor(log10) of a share, clamped to -18 to 0.
fn decade(share: f64) -> i32 {
    (-18..0)
        .rev()
        .find(|&decade| share >= power_of_ten(decade))
        .map_or(-18, |decade| decade + i32::from(share >= 1.0))
}

/// Correctly rounded, unlike products of 0.1.
fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const APART: Truth = Truth { relation: Relation::Apart, separation: 0.5, size: 2.0 };
    const TOUCHING_: Truth = Truth { relation: Relation::Touching, separation: 0.0, size: 2.0 };
    const DEEP: Truth = Truth { relation: Relation::Overlapping, separation: -0.5, size: 2.0 };

    #[test]
    fn a_wrong_method_is_found_wrong() {
        let truths = [APART, TOUCHING_, DEEP];
        let of = |said: [Said; 3]| {
            let tally = Tally::new(&truths, &said);
            assert_eq!(
                tally.strict,
                if tally.refused == 0 { 2 } else { 0 },
                "what is refused is not answered"
            );
            (tally.wrong, tally.refused, tally.errors)
        };
        assert_eq!(of([Said::Apart, Said::Deep(0.0), Said::Deep(-0.5)]), (0, 0, vec![0.0, 0.0]));
        assert_eq!(of([Said::Apart, Said::Apart, Said::Deep(-0.25)]), (0, 0, vec![0.0, 0.125]));
        assert_eq!(of([Said::Deep(-0.5), Said::Touching, Said::Apart]), (2, 0, vec![0.5, 0.0, 0.25]));
        assert_eq!(of([Said::Touching, Said::Touching, Said::Touching]), (1, 0, vec![0.25, 0.0, 0.0]));
        assert_eq!(of([Said::Refused; 3]), (0, 3, vec![]));
    }

    /// A method that is always wrong, one that gives no numbers, and one that panics.
    #[test]
    fn methods_are_asked_and_held_against_the_truth() {
        struct Always(fn() -> Said, usize);
        impl Prepared for Always {
            fn say(&self, said: &mut Vec<Said>) {
                said.extend((0..self.1).map(|_| (self.0)()));
            }
        }
        let pairs = PosedPair2::group("near-touching", 200, 1);
        let truths = truths(&pairs);
        let apart = truths.iter().filter(|truth| truth.relation == Relation::Apart).count() as u64;
        let overlapping =
            truths.iter().filter(|truth| truth.relation == Relation::Overlapping).count() as u64;
        assert!(apart > 50 && overlapping > 50);
        let yes = Method {
            name: "yes",
            prepare: |pairs: &[PosedPair2]| Box::new(Always(|| Said::Touching, pairs.len())),
        };
        let no = Method {
            name: "no",
            prepare: |pairs: &[PosedPair2]| Box::new(Always(|| Said::Apart, pairs.len())),
        };
        let answers = said_by_all(&[yes, no], &pairs);
        assert_eq!(Tally::new(&truths, &answers[0]).wrong, apart);
        assert_eq!(Tally::new(&truths, &answers[1]).wrong, overlapping);
        let wrong = |said: &[Said]| count_by_decade(&truths, said).iter().map(|cell| cell.wrong).sum::<u64>();
        assert_eq!(wrong(&answers[0]), apart);
        assert_eq!(wrong(&answers[1]), truths.len() as u64 - apart);
    }

    #[test]
    fn decades_are_those_of_the_gap() {
        for (share, expected) in
            [(2.0, 0), (1.0, 0), (0.99, -1), (0.1, -1), (1e-3, -3), (9.99e-4, -4), (1e-17, -17), (1e-25, -18)]
        {
            assert_eq!(decade(share), expected, "{share}");
        }
    }

    #[test]
    fn all_methods_give_figures_and_ours_is_never_wrong() {
        let effort = Effort { pairs: [60, 60], timed: 60, seconds: 0.0 };
        let quiet = |_: &str| {};
        let mut rows = of_dimension::<PosedPair3>(&effort, &quiet);
        rows.extend(of_dimension::<PosedPair2>(&effort, &quiet));
        assert_eq!(rows.len(), GROUPS.len() * (7 + 4));
        for row in &rows {
            assert!(
                row.ns > 0.0 && row.ns_low <= row.ns && row.ns <= row.ns_high && row.pairs >= 60,
                "{row:?}"
            );
            if matches!(row.method.as_str(), "certain" | "batched-boxes") {
                assert_eq!((row.wrong_per_100k, row.refused), (0.0, 0), "{row:?}");
                assert!(row.error_max < 1e-6, "{row:?}");
            }
        }
        let of_f32 = rows.iter().filter(|row| row.method == "textbook-f32");
        assert!(of_f32.filter(|row| row.wrong_per_100k > 0.0).count() > 4);
    }
}
