//! Our answers about pairs in the plane, compared with the truth.
//!
//! The truth is the tests' oracle in double-double (`asunder_tests::precise`). It uses only the stored vertices and
//! poses, builds the outlines with exact predicates, projects all vertices of both shapes on every edge's normal, and
//! for a gap proves the distance by two bounds that meet. It shares nothing with the kernels.

use super::{Case, Memory};
use crate::accuracy::{Accuracy, Said};
use crate::clock::Effort;
use crate::narrow::Operation;
use asunder_narrow::{Answer, Manifold2, Pair2, Separation2};
use asunder_scenes::pairs::{FRAMES, PosedPair2};
use asunder_tests::precise::separation2;

/// The most vertices of a row's pairs that are judged: the judge takes about 2 us for each.
const VERTICES: usize = 400_000;

/// The most and the fewest pairs that are judged, however many vertices they have.
const PAIRS: [usize; 2] = [10_000, 20];

/// Compares our answers with the truth for a part of the pairs, spread over all of them, in whole sequences of frames.
pub(super) fn judged(case: &Case, pairs: &[PosedPair2], effort: &Effort) -> Accuracy {
    let is_sequence = case.set().is_some_and(|set| set.is_sequence());
    let tracks = if is_sequence { pairs.len() / FRAMES } else { pairs.len() }.max(1);
    let vertices = pairs.first().map_or(2, |pair| vertices(pair).max(2));
    let affordable = VERTICES / vertices / if effort.is_quick { 10 } else { 1 };
    let most = affordable.clamp(PAIRS[1], PAIRS[0]);
    let chosen = if is_sequence { most.div_ceil(FRAMES) } else { most };
    let step = tracks.div_ceil(chosen);
    let frames: Vec<Vec<&PosedPair2>> =
        pairs.chunks(tracks).map(|frame| frame.iter().step_by(step).collect()).collect();
    let mut memory = Memory::new(tracks.div_ceil(step));
    let mut accuracy = Accuracy::default();
    for frame in &frames {
        let said: Vec<Said> = if case.operation() == Operation::Cached {
            memory.ask(frame);
            let manifolds = &memory.batch.manifolds;
            memory.batch.answers.iter().map(|answer| of_answer(answer, manifolds)).collect()
        } else {
            frame.iter().map(|pair| of_pair(case.operation(), pair)).collect()
        };
        for (pair, said) in frame.iter().zip(said) {
            accuracy.judge_ours(truth(pair), size(pair), said);
        }
    }
    accuracy
}

fn vertices(pair: &PosedPair2) -> usize {
    pair.shape_a.core().vertices().len() + pair.shape_b.core().vertices().len()
}

/// The separation in metres, accurate to a unit or two in the last place of an f64.
fn truth(pair: &PosedPair2) -> f64 {
    separation2((&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b)).separation
}

fn size(pair: &PosedPair2) -> f64 {
    f64::from(pair.shape_a.outer_radius()) + f64::from(pair.shape_b.outer_radius())
}

fn of_pair(operation: Operation, posed: &PosedPair2) -> Said {
    let pair = Pair2::new(&posed.shape_a, &posed.pose_a, &posed.shape_b, &posed.pose_b);
    match operation {
        Operation::Boolean => Said { touching: pair.overlaps(), separation: None },
        Operation::Separation => match pair.separation(0.0) {
            Separation2::Measured(found) => {
                Said { touching: found.separation <= 0.0, separation: Some(found.separation.into()) }
            }
            Separation2::AtLeast(_) => Said { touching: false, separation: None },
        },
        Operation::Distance => {
            let found = pair.distance();
            Said { touching: found.is_none(), separation: found.map(|closest| closest.distance.into()) }
        }
        Operation::Manifold | Operation::Cached => of_manifolds(pair.manifold(0.0).as_slice()),
    }
}

fn of_answer(answer: &Answer, manifolds: &[Manifold2]) -> Said {
    match answer {
        Answer::Apart { .. } => Said { touching: false, separation: None },
        Answer::Contact { manifolds: range, .. } => {
            of_manifolds(&manifolds[range.start as usize..range.end as usize])
        }
    }
}

/// The separation of the deepest point.
fn of_manifolds(manifolds: &[Manifold2]) -> Said {
    let points = manifolds.iter().flat_map(|manifold| &manifold.points);
    let deepest = points.map(|point| f64::from(point.separation)).reduce(f64::min);
    Said { touching: deepest.is_some(), separation: deepest }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_scenes::pairs::{PairSet, PlaneKind, pairs2};
    use asunder_tests::exhaustive_distance::exhaustive_distance2;
    use asunder_tests::exhaustive_sat::exhaustive_sat2;
    use asunder_tests::placed::Placed2;

    /// From all pairs of vertices and all pairs of a vertex and an edge, in plain f64.
    fn by_exhaustion(pair: &PosedPair2) -> f64 {
        let origin = pair.pose_a.position();
        let [a, b] = [(&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b)]
            .map(|(shape, pose)| Placed2::new(shape, pose, origin));
        let best = exhaustive_sat2(&a, &b).gap;
        if best > 0.0 { exhaustive_distance2(&a, &b).distance } else { best }
    }

    #[test]
    fn the_truth_is_what_exhaustion_finds_in_every_set() {
        for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
            for set in PairSet::ALL {
                for pair in &pairs2(kind, set, 4, 3)[..4] {
                    let (truth, found) = (truth(pair), by_exhaustion(pair));
                    // Coordinates of some metres in f64, with a few dozen roundings.
                    assert!(
                        (truth - found).abs() < 1e-13,
                        "{}/{}: {truth}, {found}",
                        kind.name(),
                        set.name()
                    );
                }
            }
        }
    }

    #[test]
    fn a_point_that_is_too_deep_is_found_out() {
        let pair = &pairs2(PlaneKind::Poly8, PairSet::Touch, 1, 1)[0];
        let said = of_pair(Operation::Separation, pair);
        let judge = |separation: Option<f64>| {
            let mut accuracy = Accuracy::default();
            accuracy.judge_ours(truth(pair), size(pair), Said { separation, ..said });
            accuracy.off
        };
        let right = truth(pair);
        assert_eq!((judge(Some(right)), judge(Some(right - 2e-5 * size(pair)))), (0, 1));
    }
}
