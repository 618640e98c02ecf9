//! Nanoseconds per query: on one thread, by its CPU time, the variants in turns, medians of blocks.

use super::peers::{double, single, unless_panic};
use super::posed::Posed;
use super::tally::Hard;
use core::hint::black_box;
use cpu_time::ThreadTime;

/// Pairs in a block. Reading the clock costs about as much as a query.
const BLOCK: usize = 32;

/// How often every block is run.
const ROUNDS: usize = 5;

/// Median cost of an overlap test, in nanoseconds per pair; `None` where there is no answer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    /// Our first tier alone, from two posed shapes.
    pub guess: Option<f64>,
    /// Our certain answer, from two posed shapes.
    pub overlaps: Option<f64>,
    /// parry3d in f32 and f64, from two posed shapes, converted beforehand.
    pub peers: [Option<f64>; 2],
}

/// Measures a family on `count` cases, levels in turn.
///
/// ```
/// use asunder_scenes::hard::FAMILIES2;
/// let times = asunder_tests::report::times(&FAMILIES2[0], 32, 1);
/// assert!(times.overlaps.is_some() && times.peers == [None; 2]);
/// ```
pub fn times<H: Hard>(family: &H, count: usize, seed: u64) -> Times {
    let make = |index| {
        let (level, seed) = family.nth(index, seed);
        family.case(level, seed)
    };
    let pairs: Vec<H::Pair> = (0..count).map(make).collect();
    let in_space = || pairs.iter().filter_map(Posed::in_space);
    // A peer that rejects some of the shapes, or panics, is timed on the rest.
    let single: Vec<single::Twins> =
        in_space().filter_map(|pair| unless_panic(|| single::Twins::new(pair))).collect();
    let double: Vec<double::Twins> =
        in_space().filter_map(|pair| unless_panic(|| double::Twins::new(pair))).collect();
    let [mut guess, mut overlaps, mut in_f32, mut in_f64] = [const { Vec::new() }; 4];
    for _ in 0..ROUNDS {
        for first in (0..pairs.len()).step_by(BLOCK) {
            time(&mut guess, &pairs, first, |pair| pair.guess());
            time(&mut overlaps, &pairs, first, |pair| pair.overlaps());
            time(&mut in_f32, &single, first, |twins| unless_panic(|| twins.overlaps()).unwrap_or(false));
            time(&mut in_f64, &double, first, |twins| unless_panic(|| twins.overlaps()).unwrap_or(false));
        }
    }
    Times { guess: median(guess), overlaps: median(overlaps), peers: [median(in_f32), median(in_f64)] }
}

/// Times one query on the block from `first` on, in nanoseconds per pair. It is run once before, so that the first
/// variant does not pay for the cache.
fn time<T>(samples: &mut Vec<f64>, pairs: &[T], first: usize, ask: impl Fn(&T) -> bool) {
    let block = pairs.get(first..).unwrap_or_default();
    let block = &block[..block.len().min(BLOCK)];
    if block.is_empty() {
        return;
    }
    let run = || black_box(block.iter().filter(|pair| ask(black_box(pair))).count());
    run();
    let start = ThreadTime::now();
    run();
    samples.push(start.elapsed().as_nanos() as f64 / block.len() as f64);
}

fn median(mut samples: Vec<f64>) -> Option<f64> {
    samples.sort_unstable_by(f64::total_cmp);
    samples.get(samples.len().saturating_sub(1) / 2).copied()
}
