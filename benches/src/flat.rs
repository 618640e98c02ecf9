//! Narrow phase in the plane: the twin of [`narrow`](crate::narrow), without a peer.

mod grown;

pub use grown::Lie;

use crate::clock::{Effort, Samples, time};
use crate::narrow::{Operation, block_size};
use crate::row::Row;
use asunder_narrow::{Answer, Batch2, Hint, Job2, Pair2, Separation2, collide2};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, pairs2};
use core::hint::black_box;

/// One row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// A family of shapes, a set of pairs, a question.
    Of(PlaneKind, PairSet, Operation),
    /// Ellipses of so many vertices, how they lie, and a question: how its cost grows.
    Grown(usize, Lie, Operation),
}

/// The questions asked of each family.
const QUESTIONS: [(PairSet, Operation); 7] = [
    (PairSet::Mixed, Operation::Boolean),
    (PairSet::Mixed, Operation::Separation),
    (PairSet::Mixed, Operation::Manifold),
    (PairSet::Rest, Operation::Manifold),
    (PairSet::Slide, Operation::Cached),
    (PairSet::Far, Operation::Boolean),
    (PairSet::Deep, Operation::Boolean),
];

/// Vertices of the polygons whose cost grows, and what is asked of them. Circles tell the yes or no of deep ones.
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
/// assert!(names.contains(&"grown1024/light/boolean".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let of_kind = |kind| QUESTIONS.into_iter().map(move |(set, operation)| Case::Of(kind, set, operation));
    let of_kinds = PlaneKind::ALL.into_iter().flat_map(of_kind);
    let grown = OF_GROWN
        .into_iter()
        .flat_map(|(lie, operation)| SIZES.map(|vertices| Case::Grown(vertices, lie, operation)));
    // Choosing which of the mixed pairs of huge polygons are apart would take longer than the row.
    let is_slow = |case: &Case| matches!(case, Case::Of(PlaneKind::Poly4096, PairSet::Mixed, _));
    of_kinds.filter(|case| !is_slow(case)).chain(grown).collect()
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
        Case::Grown(vertices, lie, operation) => {
            format!("grown{vertices}/{}/{}", lie.name(), operation.name())
        }
    }
}

/// Measures one row. Cost: about a second, and making the pairs.
///
/// ```
/// use asunder_benches::{clock::Effort, flat, flat::Case, narrow::Operation};
/// use asunder_scenes::pairs::{PairSet, PlaneKind};
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = flat::measure(&Case::Of(PlaneKind::Poly8, PairSet::Mixed, Operation::Manifold), &effort);
/// assert!(row.done == 250 && row.ours_ns.is_some() && row.peer.is_none());
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let (pairs, operation) = match *case {
        Case::Of(kind, set, operation) => {
            let most = if kind == PlaneKind::Poly4096 { 1000 } else { usize::MAX };
            (pairs2(kind, set, effort.pairs.min(most), 1), operation)
        }
        Case::Grown(vertices, lie, operation) => {
            (grown::pairs(vertices, lie, effort.pairs.min(1000)), operation)
        }
    };
    let mut row = Row::new(name(case), "pair", pairs.len());
    let samples = if operation == Operation::Cached {
        cached(&pairs, effort, &mut row)
    } else {
        fresh(operation, &pairs, effort, &mut row)
    };
    row.done = row.done.min(row.n);
    row.ours_ns = samples.median();
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

/// Returns something of the answer, so that none of it can be left out.
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

/// Frame after frame, each with the hints of the last; the first frame is not timed.
fn cached(pairs: &[PosedPair2], effort: &Effort, row: &mut Row) -> Samples {
    let mut samples = Samples::default();
    let tracks = (pairs.len() / FRAMES).max(1);
    let (mut hints, mut batch) = (vec![Hint::NONE; tracks], Batch2::default());
    for (step, frame) in pairs.chunks(tracks).enumerate() {
        let (ns, ()) = time(|| {
            let jobs: Vec<Job2<'_>> = frame.iter().zip(&hints).map(|(pair, &hint)| job(pair, hint)).collect();
            batch.clear();
            collide2(&jobs, &mut batch);
            for (kept, answer) in hints.iter_mut().zip(&batch.answers) {
                let (Answer::Apart { hint } | Answer::Contact { hint, .. }) = answer;
                *kept = *hint;
            }
        });
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

fn job(pair: &PosedPair2, hint: Hint) -> Job2<'_> {
    let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job2 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, sensor: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures() {
        let effort = Effort { pairs: 120, rounds: 1, seconds: 0.2, is_quick: true };
        for case in cases() {
            let row = measure(&case, &effort);
            assert!(row.ours_ns.is_some() && row.peer_ns.is_none() && row.done > 0, "{row:?}");
        }
    }
}
