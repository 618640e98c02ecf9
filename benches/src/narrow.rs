//! Narrow phase in space: one question about many pairs, beside parry3d's same question.
//!
//! | operation | ours | parry3d |
//! |---|---|---|
//! | boolean | `Pair3::overlaps` | `intersection_test` |
//! | separation | `Pair3::separation(0)` | `contact` with prediction 0 |
//! | distance | `Pair3::distance` | `distance` |
//! | manifold | `Pair3::manifold(0)` | `contact_manifolds` into an empty manifold |
//! | cached | `collide3` with last frame's hints | `contact_manifolds` into last frame's manifold |
//!
//! A set is measured in blocks of a few hundred pairs that the variants take in turns; the figure is the median of the
//! blocks, in nanoseconds a pair. Making the relative pose is part of the question.

use crate::clock::{Effort, Samples, time};
use crate::parry::{self, Shapes};
use crate::row::Row;
use asunder_narrow::{Answer, Batch3, Hint, Job3, Pair3, Separation3, collide3};
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, frames3, pairs3};
use core::hint::black_box;
use glam::Vec3;
use parry3d::math::Pose;
use parry3d::query::{self, ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};
use parry3d::shape::SharedShape;

/// Most pairs in a block.
const BLOCK: usize = 250;

/// Pairs in a block, so that a row has some blocks however slow it is.
pub(crate) fn block_size(ns_of_one: f64, effort: &Effort) -> usize {
    ((effort.nanoseconds() / (8.0 * ns_of_one.max(1.0))) as usize).clamp(1, BLOCK)
}

/// Frames that a pair at rest is asked about with what the last one left; the first is not timed.
const REST_FRAMES: usize = 6;

/// The question of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Do they overlap?
    Boolean,
    /// How deep, and along which axis?
    Separation,
    /// How far apart?
    Distance,
    /// At which points do they touch?
    Manifold,
    /// The same, knowing last frame's answer.
    Cached,
}

impl Operation {
    /// The name used in result rows.
    ///
    /// ```
    /// assert_eq!(asunder_benches::narrow::Operation::Cached.name(), "cached");
    /// ```
    pub const fn name(self) -> &'static str {
        match self {
            Self::Boolean => "boolean",
            Self::Separation => "separation",
            Self::Distance => "distance",
            Self::Manifold => "manifold",
            Self::Cached => "cached",
        }
    }
}

/// One row: a family of shapes, a set of pairs, a question.
pub type Case = (SolidKind, PairSet, Operation);

/// The questions asked of each family.
const QUESTIONS: [(PairSet, Operation); 13] = [
    (PairSet::Mixed, Operation::Boolean),
    (PairSet::Mixed, Operation::Separation),
    (PairSet::Mixed, Operation::Distance),
    (PairSet::Mixed, Operation::Manifold),
    (PairSet::Rest, Operation::Manifold),
    (PairSet::Rest, Operation::Cached),
    (PairSet::Slide, Operation::Cached),
    (PairSet::Tumble, Operation::Cached),
    (PairSet::Far, Operation::Boolean),
    (PairSet::Far, Operation::Distance),
    (PairSet::Touch, Operation::Boolean),
    (PairSet::Touch, Operation::Separation),
    (PairSet::Deep, Operation::Separation),
];

/// Every row.
///
/// ```
/// use asunder_benches::narrow;
/// let names: Vec<String> = narrow::cases().iter().map(narrow::name).collect();
/// assert!(names.contains(&"box/mixed/manifold".into()) && names.contains(&"hull32/slide/cached".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let of_kind = |kind| QUESTIONS.into_iter().map(move |(set, operation)| (kind, set, operation));
    SolidKind::ALL.into_iter().flat_map(of_kind).collect()
}

/// The name of a row, as `box/mixed/manifold`.
///
/// ```
/// use asunder_benches::narrow::{Operation, name};
/// use asunder_scenes::pairs::{PairSet, SolidKind};
/// assert_eq!(name(&(SolidKind::Hull8, PairSet::Rest, Operation::Cached)), "hull8/rest/cached");
/// ```
pub fn name(&(kind, set, operation): &Case) -> String {
    format!("{}/{}/{}", kind.name(), set.name(), operation.name())
}

/// Measures one row. Cost: about a second a variant, and making the pairs.
///
/// ```
/// use asunder_benches::{clock::Effort, narrow::{Operation, measure}};
/// use asunder_scenes::pairs::{PairSet, SolidKind};
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = measure(&(SolidKind::Box, PairSet::Mixed, Operation::Boolean), &effort);
/// assert_eq!((row.done, row.disagree), (250, Some(0)));
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let &(kind, set, operation) = case;
    let mut row = Row::new(name(case), "pair", 0);
    let mut shapes = Shapes::default();
    let (ours, peer) = if operation == Operation::Cached {
        let frames = frames3(kind, set, effort.pairs, 1);
        let Some(frames) =
            frames.iter().map(|frame| Both::all(frame, &mut shapes)).collect::<Option<Vec<_>>>()
        else {
            row.remark("parry3d refuses a hull");
            return row;
        };
        row.n = frames.iter().map(Vec::len).sum();
        cached(&frames, effort, &mut row)
    } else {
        let Some(pairs) = Both::all(&pairs3(kind, set, effort.pairs, 1), &mut shapes) else {
            row.remark("parry3d refuses a hull");
            return row;
        };
        row.n = pairs.len();
        if operation == Operation::Boolean {
            row.disagree = Some(disagreements(&pairs));
        }
        fresh(operation, &pairs, effort, &mut row)
    };
    row.done = row.done.min(row.n);
    row.ours_ns = ours.median();
    (row.peer, row.peer_ns) = (Some("parry3d"), peer.median());
    row.finish();
    row
}

/// A pair, in our types and in parry3d's.
struct Both {
    ours: PosedPair3,
    shapes: [SharedShape; 2],
    poses: [Pose; 2],
}

impl Both {
    fn all(pairs: &[PosedPair3], shapes: &mut Shapes) -> Option<Vec<Self>> {
        let both = pairs.iter().map(|pair| {
            Some(Self {
                shapes: [shapes.convert(&pair.shape_a)?, shapes.convert(&pair.shape_b)?],
                poses: [parry::pose(&pair.pose_a), parry::pose(&pair.pose_b)],
                ours: pair.clone(),
            })
        });
        both.collect()
    }

    fn pair(&self) -> Pair3<'_> {
        Pair3::new(&self.ours.shape_a, &self.ours.pose_a, &self.ours.shape_b, &self.ours.pose_b)
    }

    fn job(&self, hint: Hint) -> Job3<'_> {
        let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = &self.ours;
        Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, sensor: false }
    }

    fn peer_overlaps(&self) -> bool {
        let ([a, b], [pose_a, pose_b]) = (&self.shapes, &self.poses);
        // Unsupported combinations do not occur: all shapes are convex.
        query::intersection_test(pose_a, &*a.0, pose_b, &*b.0).is_ok_and(|found| found.intersecting)
    }
}

/// Pairs where the yes or no differs although the separation is beyond 1e-4 of size.
fn disagreements(pairs: &[Both]) -> usize {
    let is_clear = |pair: &Pair3| match pair.separation(f32::INFINITY) {
        Separation3::Measured(found) => found.separation.abs() > 1e-4 * pair.size(),
        Separation3::AtLeast(bound) => bound > 1e-4 * pair.size(),
    };
    let differs = |both: &&Both| both.pair().overlaps() != both.peer_overlaps() && is_clear(&both.pair());
    pairs.iter().filter(differs).count()
}

/// Questions without memory.
fn fresh(operation: Operation, pairs: &[Both], effort: &Effort, row: &mut Row) -> (Samples, Samples) {
    let (mut ours, mut peer) = (Samples::default(), Samples::default());
    let mut manifolds: Vec<ContactManifold<(), ()>> = Vec::new();
    let first = pairs.first().map_or(0.0, |both| time(|| ask_ours(operation, both)).0);
    'rounds: for _ in 0..effort.rounds {
        for block in pairs.chunks(block_size(first, effort)) {
            let (ns, _) = time(|| block.iter().map(|both| ask_ours(operation, both)).sum::<f32>());
            ours.push(ns / block.len() as f64, ns);
            let (ns, _) =
                time(|| block.iter().map(|both| ask_peer(operation, both, &mut manifolds)).sum::<f32>());
            peer.push(ns / block.len() as f64, ns);
            row.done += block.len();
            if ours.spent().max(peer.spent()) > effort.nanoseconds() {
                break 'rounds;
            }
        }
    }
    (ours, peer)
}

/// Returns something of the answer, so that none of it can be left out.
fn ask_ours(operation: Operation, both: &Both) -> f32 {
    let pair = both.pair();
    match operation {
        Operation::Boolean => f32::from(u8::from(pair.overlaps())),
        Operation::Separation => match pair.separation(0.0) {
            Separation3::Measured(found) => found.separation + found.normal.x,
            Separation3::AtLeast(bound) => bound,
        },
        Operation::Distance => pair.distance().map_or(0.0, |closest| closest.distance),
        Operation::Manifold | Operation::Cached => {
            let manifold = black_box(pair.manifold(0.0));
            manifold.map_or(0.0, |manifold| manifold.points.iter().map(|point| point.separation).sum())
        }
    }
}

fn ask_peer(operation: Operation, both: &Both, manifolds: &mut Vec<ContactManifold<(), ()>>) -> f32 {
    let ([a, b], [pose_a, pose_b]) = (&both.shapes, &both.poses);
    let (a, b) = (&*a.0, &*b.0);
    match operation {
        Operation::Boolean => f32::from(u8::from(both.peer_overlaps())),
        Operation::Separation => match query::contact(pose_a, a, pose_b, b, 0.0) {
            Ok(Some(contact)) => contact.dist + contact.normal1.x,
            _ => 0.0,
        },
        Operation::Distance => query::distance(pose_a, a, pose_b, b).map_or(0.0, |found| found.distance),
        Operation::Manifold | Operation::Cached => {
            // An empty manifold without a normal is one without memory; its allocation may stay.
            for manifold in manifolds.iter_mut() {
                manifold.points.clear();
                (manifold.local_n1, manifold.local_n2) = (Vec3::ZERO, Vec3::ZERO);
            }
            ask_manifolds(both, manifolds)
        }
    }
}

fn ask_manifolds(both: &Both, manifolds: &mut Vec<ContactManifold<(), ()>>) -> f32 {
    let ([a, b], [pose_a, pose_b]) = (&both.shapes, &both.poses);
    let relative = pose_a.inv_mul(pose_b);
    // Both shapes are convex, which parry3d supports in every combination.
    let _ = DefaultQueryDispatcher.contact_manifolds(&relative, &*a.0, &*b.0, 0.0, manifolds, &mut None);
    manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.dist).sum()
}

/// Frame after frame, each with what the last one left; the first frame of a block is not timed.
fn cached(frames: &[Vec<Both>], effort: &Effort, row: &mut Row) -> (Samples, Samples) {
    let (mut ours, mut peer) = (Samples::default(), Samples::default());
    let tracks = frames.first().map_or(0, Vec::len);
    let steps = if frames.len() == 1 { REST_FRAMES } else { frames.len() };
    let rounds = effort.rounds.div_ceil(steps);
    'rounds: for _ in 0..rounds {
        for first in (0..tracks).step_by(BLOCK) {
            let last = (first + BLOCK).min(tracks);
            let mut memory = Memory::new(last - first);
            for step in 0..steps {
                let block = &frames[step % frames.len()][first..last];
                let (ours_ns, _) = time(|| memory.ask_ours(block));
                let (peer_ns, _) = time(|| memory.ask_peer(block));
                if step > 0 {
                    ours.push(ours_ns / block.len() as f64, ours_ns);
                    peer.push(peer_ns / block.len() as f64, peer_ns);
                }
                row.done += block.len();
                if ours.spent().max(peer.spent()) > effort.nanoseconds() {
                    break 'rounds;
                }
            }
        }
    }
    (ours, peer)
}

/// What either side remembers of a block of pairs.
struct Memory {
    hints: Vec<Hint>,
    batch: Batch3,
    manifolds: Vec<Vec<ContactManifold<(), ()>>>,
}

impl Memory {
    fn new(count: usize) -> Self {
        let manifolds = (0..count).map(|_| Vec::new()).collect();
        Self { hints: vec![Hint::NONE; count], batch: Batch3::default(), manifolds }
    }

    fn ask_ours(&mut self, block: &[Both]) -> f32 {
        let jobs: Vec<Job3<'_>> = block.iter().zip(&self.hints).map(|(both, &hint)| both.job(hint)).collect();
        self.batch.clear();
        collide3(&jobs, &mut self.batch);
        for (kept, answer) in self.hints.iter_mut().zip(&self.batch.answers) {
            let (Answer::Apart { hint } | Answer::Contact { hint, .. }) = answer;
            *kept = *hint;
        }
        self.batch.manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.separation).sum()
    }

    fn ask_peer(&mut self, block: &[Both]) -> f32 {
        block.iter().zip(&mut self.manifolds).map(|(both, manifolds)| ask_manifolds(both, manifolds)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures_and_no_clear_disagreement() {
        let effort = Effort { pairs: 120, rounds: 1, seconds: 0.5, is_quick: true };
        for case in cases() {
            let row = measure(&case, &effort);
            assert!(row.ratio.is_some() && row.done > 0, "{row:?}");
            assert_eq!(row.disagree.unwrap_or(0), 0, "{row:?}");
        }
    }
}
