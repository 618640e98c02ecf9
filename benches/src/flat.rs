//! Narrow phase in the plane: the twin of [`narrow`](crate::narrow), without a peer.

use crate::clock::{Effort, Samples, time};
use crate::narrow::{Operation, block_size};
use crate::row::Row;
use asunder_narrow::{Answer, Batch2, Hint, Job2, Pair2, Separation2, collide2};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, pairs2};
use core::hint::black_box;

/// One row: a family of shapes, a set of pairs, a question.
pub type Case = (PlaneKind, PairSet, Operation);

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

/// Every row.
///
/// ```
/// use asunder_benches::flat;
/// let names: Vec<String> = flat::cases().iter().map(flat::name).collect();
/// assert!(names.contains(&"rect/mixed/boolean".into()) && names.contains(&"poly4096/far/boolean".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let of_kind = |kind| QUESTIONS.into_iter().map(move |(set, operation)| (kind, set, operation));
    let all = PlaneKind::ALL.into_iter().flat_map(of_kind);
    // Choosing which of the mixed pairs of huge polygons are apart would take longer than the row.
    all.filter(|(kind, set, _)| *kind != PlaneKind::Poly4096 || *set != PairSet::Mixed).collect()
}

/// The name of a row, as `rect/mixed/manifold`.
///
/// ```
/// use asunder_benches::{flat, narrow::Operation};
/// use asunder_scenes::pairs::{PairSet, PlaneKind};
/// assert_eq!(flat::name(&(PlaneKind::Poly64, PairSet::Far, Operation::Boolean)), "poly64/far/boolean");
/// ```
pub fn name(&(kind, set, operation): &Case) -> String {
    format!("{}/{}/{}", kind.name(), set.name(), operation.name())
}

/// Measures one row. Cost: about a second, and making the pairs.
///
/// ```
/// use asunder_benches::{clock::Effort, flat, narrow::Operation};
/// use asunder_scenes::pairs::{PairSet, PlaneKind};
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = flat::measure(&(PlaneKind::Poly8, PairSet::Mixed, Operation::Manifold), &effort);
/// assert!(row.done == 250 && row.ours_ns.is_some() && row.peer.is_none());
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let &(kind, set, operation) = case;
    let count = if kind == PlaneKind::Poly4096 { effort.pairs.min(1000) } else { effort.pairs };
    let pairs = pairs2(kind, set, count, 1);
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
