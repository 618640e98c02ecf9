//! Narrow phase in the plane: the twin of [`narrow`](crate::narrow), without a peer.
//!
//! Our answers for a part of each set are compared with true separations in double-double, as in space.

pub(crate) mod grown;
mod judged;
mod round;

pub use grown::Lie;

use crate::clock::{Effort, Samples, time};
use crate::narrow::{Operation, block_size};
use crate::row::Row;
use asunder_narrow::{Answer, Batch2, Hint, Job2, Pair2, Separation2, collide2};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, pairs2};
use core::borrow::Borrow;
use core::hint::black_box;

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// A family of shapes, a set of pairs, and a query.
    Of(PlaneKind, PairSet, Operation),
    /// Circles and capsules: a set of pairs, and a query.
    Round(PairSet, Operation),
    /// Ellipses of so many vertices, their placement, and a query: how its cost grows.
    Grown(usize, Lie, Operation),
}

impl Case {
    /// The set of pairs; growing polygons are in none.
    const fn set(&self) -> Option<PairSet> {
        match *self {
            Self::Of(_, set, _) | Self::Round(set, _) => Some(set),
            Self::Grown(..) => None,
        }
    }

    /// The query.
    const fn operation(&self) -> Operation {
        match *self {
            Self::Of(.., operation) | Self::Round(_, operation) | Self::Grown(.., operation) => operation,
        }
    }
}

/// The queries for each family.
const QUESTIONS: [(PairSet, Operation); 13] = [
    (PairSet::Mixed, Operation::Boolean),
    (PairSet::Mixed, Operation::Separation),
    (PairSet::Mixed, Operation::Distance),
    (PairSet::Mixed, Operation::Manifold),
    (PairSet::Rest, Operation::Manifold),
    (PairSet::Slide, Operation::Cached),
    (PairSet::Far, Operation::Boolean),
    (PairSet::Far, Operation::Distance),
    (PairSet::Touch, Operation::Boolean),
    (PairSet::Touch, Operation::Separation),
    (PairSet::Touch, Operation::Manifold),
    (PairSet::Deep, Operation::Boolean),
    (PairSet::Deep, Operation::Separation),
];

/// The sets of circles and capsules, which have no edges to rest on.
const ROUND: [PairSet; 4] = [PairSet::Mixed, PairSet::Far, PairSet::Touch, PairSet::Deep];

/// Numbers of vertices of the polygons whose cost grows, and the queries for them. Circles decide the yes or no of deep
/// ones.
const SIZES: [usize; 10] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];
const OF_GROWN: [(Lie, Operation); 6] = [
    (Lie::Apart, Operation::Boolean),
    (Lie::Light, Operation::Boolean),
    (Lie::Apart, Operation::Distance),
    (Lie::Light, Operation::Manifold),
    (Lie::Deep, Operation::Separation),
    (Lie::Deep, Operation::Manifold),
];

/// Every row.
///
/// ```
/// use asunder_benches::flat;
/// let names: Vec<String> = flat::cases().iter().map(flat::name).collect();
/// assert!(names.contains(&"rect/mixed/boolean".into()) && names.contains(&"poly4096/far/boolean".into()));
/// assert!(names.contains(&"poly8/touch/separation".into()) && names.contains(&"round/deep/separation".into()));
/// assert!(names.contains(&"grown1024/light/boolean".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let of_kind = |kind| QUESTIONS.into_iter().map(move |(set, operation)| Case::Of(kind, set, operation));
    let of_kinds = PlaneKind::ALL.into_iter().flat_map(of_kind);
    let grown = OF_GROWN
        .into_iter()
        .flat_map(|(lie, operation)| SIZES.map(|vertices| Case::Grown(vertices, lie, operation)));
    let of_round = QUESTIONS.into_iter().filter(|(set, _)| ROUND.contains(set));
    let round = of_round.map(|(set, operation)| Case::Round(set, operation));
    // To choose which of the mixed pairs of huge polygons are apart would take longer than the row.
    let is_slow = |case: &Case| matches!(case, Case::Of(PlaneKind::Poly4096, PairSet::Mixed, _));
    of_kinds.filter(|case| !is_slow(case)).chain(round).chain(grown).collect()
}

/// The name of a row, as `rect/mixed/manifold`.
///
/// ```
/// use asunder_benches::{flat, flat::Case, narrow::Operation};
/// use asunder_scenes::pairs::{PairSet, PlaneKind};
/// assert_eq!(flat::name(&Case::Of(PlaneKind::Poly64, PairSet::Far, Operation::Boolean)), "poly64/far/boolean");
/// ```
pub fn name(case: &Case) -> String {
    match case {
        Case::Of(kind, set, operation) => format!("{}/{}/{}", kind.name(), set.name(), operation.name()),
        Case::Round(set, operation) => format!("round/{}/{}", set.name(), operation.name()),
        Case::Grown(vertices, lie, operation) => {
            format!("grown{vertices}/{}/{}", lie.name(), operation.name())
        }
    }
}

/// Measures one row. Cost: about a second, and making and judging the pairs.
///
/// ```
/// use asunder_benches::{clock::Effort, flat, flat::Case, narrow::Operation};
/// use asunder_scenes::pairs::{PairSet, PlaneKind};
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = flat::measure(&Case::Of(PlaneKind::Poly8, PairSet::Mixed, Operation::Manifold), &effort);
/// assert!(row.done == 250 && row.ours_ns.is_some() && row.peer.is_none());
/// let accuracy = row.accuracy.ok_or("not judged")?;
/// assert_eq!((accuracy.judged, accuracy.off, accuracy.missed, accuracy.peer_off), (250, 0, 0, None));
/// # Ok::<(), &str>(())
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let pairs = match *case {
        Case::Of(kind, set, _) => {
            let most = if kind == PlaneKind::Poly4096 { 1000 } else { usize::MAX };
            pairs2(kind, set, effort.pairs.min(most), 1)
        }
        Case::Round(set, _) => round::pairs(set, effort.pairs),
        Case::Grown(vertices, lie, _) => grown::pairs(vertices, lie, effort.pairs.min(1000)),
    };
    let mut row = Row::new(name(case), "pair", pairs.len());
    let samples = match case.operation() {
        Operation::Cached => cached(&pairs, effort, &mut row),
        operation => fresh(operation, &pairs, effort, &mut row),
    };
    row.done = row.done.min(row.n);
    row.tell(&samples);
    row.accuracy = Some(judged::judged(case, &pairs, effort));
    row.finish();
    row
}

fn fresh(operation: Operation, pairs: &[PosedPair2], effort: &Effort, row: &mut Row) -> Samples {
    let mut samples = Samples::default();
    let first = pairs.first().map_or(0.0, |pair| time(|| ask(operation, pair)).0);
    for _ in 0..effort.rounds {
        for block in pairs.chunks(block_size(first, effort)) {
            let (ns, _) = time(|| block.iter().map(|pair| ask(operation, pair)).sum::<f32>());
            samples.push(ns / block.len() as f64, ns);
            row.done += block.len();
            if samples.spent() > effort.nanoseconds() {
                return samples;
            }
        }
    }
    samples
}

/// Returns a number from the answer, so that none of it can be optimised away.
fn ask(operation: Operation, posed: &PosedPair2) -> f32 {
    let pair = Pair2::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b);
    match operation {
        Operation::Boolean => f32::from(u8::from(pair.overlaps())),
        Operation::Separation => match pair.separation(0.0) {
            Separation2::Measured(found) => found.separation + found.normal.x,
            Separation2::AtLeast(bound) => bound,
        },
        Operation::Distance => pair.distance().map_or(0.0, |closest| closest.distance),
        Operation::Manifold | Operation::Cached => {
            let manifold = black_box(pair.manifold(0.0));
            manifold.map_or(0.0, |manifold| manifold.points.iter().map(|point| point.separation).sum())
        }
    }
}

/// Frame after frame, each with the hints of the previous one; the first frame is not timed.
fn cached(pairs: &[PosedPair2], effort: &Effort, row: &mut Row) -> Samples {
    let mut samples = Samples::default();
    let tracks = (pairs.len() / FRAMES).max(1);
    let mut memory = Memory::new(tracks);
    for (step, frame) in pairs.chunks(tracks).enumerate() {
        let (ns, ()) = time(|| memory.ask(frame));
        if step > 0 {
            samples.push(ns / frame.len() as f64, ns);
        }
        row.done += frame.len();
        if samples.spent() > effort.nanoseconds() {
            break;
        }
    }
    samples
}

/// The hints kept from a frame's pairs.
struct Memory {
    hints: Vec<Hint>,
    batch: Batch2,
}

impl Memory {
    fn new(tracks: usize) -> Self {
        Self { hints: vec![Hint::NONE; tracks], batch: Batch2::default() }
    }

    fn ask<P: Borrow<PosedPair2>>(&mut self, frame: &[P]) {
        let pairs = frame.iter().zip(&self.hints);
        let jobs: Vec<Job2<'_>> = pairs.map(|(pair, &hint)| job(pair.borrow(), hint)).collect();
        self.batch.clear();
        collide2(&jobs, &mut self.batch);
        for (kept, answer) in self.hints.iter_mut().zip(&self.batch.answers) {
            let (Answer::Apart { hint, .. } | Answer::Contact { hint, .. }) = answer;
            *kept = *hint;
        }
    }
}

fn job(pair: &PosedPair2, hint: Hint) -> Job2<'_> {
    let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job2 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures_and_is_right() {
        let effort = Effort { pairs: 120, rounds: 1, seconds: 0.2, is_quick: true };
        for case in cases() {
            let row = measure(&case, &effort);
            assert!(row.ours_ns.is_some() && row.peer_ns.is_none() && row.done > 0, "{row:?}");
            let accuracy = row.accuracy.unwrap();
            assert!(accuracy.judged > 0 && accuracy.off + accuracy.missed == 0, "{row:?}");
        }
    }
}
