//! Hints over sixty frames: a batch that remembers says what one without memory says, and so does one that remembers
//! something else.
//!
//! Yes or no is the same bit. A separation may come from another axis, and is right within its own error all the same.

use asunder_geometry::{Pose2, Pose3};
use asunder_narrow::{Answer, Batch2, Batch3, Hint, Job2, Job3, collide2, collide3};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, PosedPair3, SolidKind, pairs2, pairs3};
use asunder_scenes::random::Random;
use asunder_tests::precise::{separation2, separation3};
use glam::DVec3;

/// What an answer says, beside its hint.
#[derive(Clone, Debug)]
struct Fact {
    hint: Hint,
    /// Whether they overlap, if they are within the margin.
    contact: Option<bool>,
    /// The separation and its error, where there is a manifold.
    measured: Option<(f64, f64)>,
    /// The least separation of a contact point.
    deepest: f64,
}

impl Fact {
    fn of<M>(answer: &Answer, manifolds: &[M], read: impl Fn(&M) -> (f64, f64, f64)) -> Self {
        match answer {
            Answer::Apart { hint } => {
                Self { hint: *hint, contact: None, measured: None, deepest: f64::INFINITY }
            }
            Answer::Contact { hint, overlapping, manifolds: range } => {
                let found =
                    manifolds.get(range.start as usize..range.end as usize).unwrap().first().map(read);
                Self {
                    hint: *hint,
                    contact: Some(*overlapping),
                    measured: found.map(|found| (found.0, found.1)),
                    deepest: found.map_or(f64::INFINITY, |found| found.2),
                }
            }
        }
    }
}

/// A pair in space or in the plane.
trait Pair: Clone {
    /// Answers to many, each with its hint; sensors have no manifolds.
    fn collide(pairs: &[Self], hints: &[Hint], margin: f32, sensor: bool) -> Vec<Fact>;
    /// The separation and what the judge may have wrong.
    fn truth(&self) -> (f64, f64);
    /// The sum of both bounding radii.
    fn size(&self) -> f64;
    /// B moved by a share of the size.
    fn nudged(&self, by: DVec3) -> Self;
}

impl Pair for PosedPair3 {
    fn collide(pairs: &[Self], hints: &[Hint], margin: f32, sensor: bool) -> Vec<Fact> {
        let mut jobs = Vec::new();
        for (pair, &hint) in pairs.iter().zip(hints) {
            let Self { shape_a, pose_a, shape_b, pose_b } = pair;
            jobs.push(Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, sensor });
        }
        let mut batch = Batch3::default();
        collide3(&jobs, &mut batch);
        let fact = |answer| {
            Fact::of(answer, &batch.manifolds, |found| {
                let deepest = found.points.iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
                (found.separation.into(), found.error.into(), deepest.into())
            })
        };
        batch.answers.iter().map(fact).collect()
    }

    fn truth(&self) -> (f64, f64) {
        let found = separation3((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b));
        (found.separation, found.bound)
    }

    fn size(&self) -> f64 {
        f64::from(self.shape_a.outer_radius()) + f64::from(self.shape_b.outer_radius())
    }

    fn nudged(&self, by: DVec3) -> Self {
        let place = self.pose_b.position() + by * self.size();
        Self { pose_b: Pose3::new(place, self.pose_b.rotation()).unwrap(), ..self.clone() }
    }
}

impl Pair for PosedPair2 {
    fn collide(pairs: &[Self], hints: &[Hint], margin: f32, sensor: bool) -> Vec<Fact> {
        let mut jobs = Vec::new();
        for (pair, &hint) in pairs.iter().zip(hints) {
            let Self { shape_a, pose_a, shape_b, pose_b } = pair;
            jobs.push(Job2 { shape_a, pose_a, shape_b, pose_b, margin, hint, sensor });
        }
        let mut batch = Batch2::default();
        collide2(&jobs, &mut batch);
        let fact = |answer| {
            Fact::of(answer, &batch.manifolds, |found| {
                let deepest = found.points.iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
                (found.separation.into(), found.error.into(), deepest.into())
            })
        };
        batch.answers.iter().map(fact).collect()
    }

    fn truth(&self) -> (f64, f64) {
        let found = separation2((&self.shape_a, &self.pose_a), (&self.shape_b, &self.pose_b));
        (found.separation, found.bound)
    }

    fn size(&self) -> f64 {
        f64::from(self.shape_a.outer_radius()) + f64::from(self.shape_b.outer_radius())
    }

    fn nudged(&self, by: DVec3) -> Self {
        let place = self.pose_b.position() + by.truncate() * self.size();
        Self { pose_b: Pose2::new(place, self.pose_b.rotation()).unwrap(), ..self.clone() }
    }
}

/// What a steady choice of the reference may cost the deepest point, as a share of the size: twice 2e-6 of the smaller
/// radius.
const STEADY: f64 = 2e-6;

/// One answer held against another to the same question.
fn check_alike<P: Pair>(fresh: &Fact, other: &Fact, (pair, margin): (&P, f64), story: &str) {
    let whole = || format!("{story}, margin {margin}: {fresh:?}, {other:?}");
    assert_eq!(
        fresh.contact.unwrap_or(false),
        other.contact.unwrap_or(false),
        "whether they overlap: {}",
        whole()
    );
    match (fresh.measured, other.measured) {
        (Some((one, error)), Some((other_one, other_error))) => {
            assert!((one - other_one).abs() <= error + other_error, "{}", whole());
            let slack = error + other_error + STEADY * pair.size();
            assert!((fresh.deepest - other.deepest).abs() <= slack, "the deepest point: {}", whole());
        }
        // Within the error of the margin, rounding decides.
        (Some((one, error)), None) | (None, Some((one, error))) => {
            assert!(margin > 0.0 && (one - margin).abs() <= error, "a contact or none: {}", whole());
        }
        (None, None) => {}
    }
}

fn check_true<P: Pair>(fact: &Fact, pair: &P, margin: f64, story: &str) {
    let (truth, bound) = pair.truth();
    let size = pair.size();
    if truth.abs() > bound {
        assert_eq!(fact.contact.unwrap_or(false), truth < 0.0, "{story}: {fact:?}, true {truth}");
    }
    match fact.measured {
        Some((found, error)) => {
            assert!((found - truth).abs() <= error + bound, "{story}: {fact:?}, true {truth} up to {bound}");
            assert!(error <= 1e-6 * size, "{story}: {fact:?}");
        }
        None => assert!(truth > margin - 1e-6 * size, "{story}, margin {margin}: {fact:?}, true {truth}"),
    }
}

/// Three batches over all frames: without memory, with its own, and with what another pair left, also of another family.
/// Every `judge_every`-th answer is held against the truth. Returns how many answers gave a hint.
fn run<P: Pair>(frames: &[Vec<P>], foreign: &[Hint], judge_every: usize, story: &str) -> usize {
    let width = frames[0].len();
    let size = frames[0].iter().map(Pair::size).fold(f64::INFINITY, f64::min);
    let mut hinted = 0;
    for margin in [0.0, (0.02 * size) as f32] {
        let none = vec![Hint::NONE; width];
        let (mut own, mut shuffled) = (none.clone(), none.clone());
        for (number, pairs) in frames.iter().enumerate() {
            let fresh = P::collide(pairs, &none, margin, false);
            let known = P::collide(pairs, &own, margin, false);
            let misled = P::collide(pairs, &shuffled, margin, false);
            let sensed = P::collide(pairs, &own, margin, true);
            let story = format!("{story}, frame {number}");
            for (i, pair) in pairs.iter().enumerate() {
                let question = (pair, f64::from(margin));
                check_alike(&fresh[i], &known[i], question, &format!("{story}, own hint"));
                check_alike(&fresh[i], &misled[i], question, &format!("{story}, another's hint"));
                assert_eq!(
                    sensed[i].contact.unwrap_or(false),
                    fresh[i].contact.unwrap_or(false),
                    "{story}, sensor"
                );
                if (number * width + i).is_multiple_of(judge_every) {
                    for fact in [&fresh[i], &known[i], &misled[i]] {
                        check_true(fact, pair, margin.into(), &story);
                    }
                }
            }
            own = known.iter().map(|fact| fact.hint).collect();
            hinted += own.iter().filter(|&&hint| hint != Hint::NONE).count();
            // From the pair beside it, or from another family altogether.
            let other = |i: usize| match foreign.get((number + i) % (2 * foreign.len()).max(1)) {
                Some(&hint) => hint,
                None => own[(i + 1 + number % 3) % width],
            };
            shuffled = (0..width).map(other).collect();
        }
    }
    hinted
}

/// Sixty frames of pairs that rest, each frame moved a little: by nothing, by a rounding, by a thousandth of its depth.
fn resting<P: Pair>(pairs: &[P]) -> Vec<Vec<P>> {
    let mut random = Random::new(31);
    let nudge = |random: &mut Random, frame: usize| random.direction() * [0.0, 1e-15, 1e-7, 1e-5][frame % 4];
    (0..FRAMES)
        .map(|frame| pairs.iter().map(|pair| pair.nudged(nudge(&mut random, frame))).collect())
        .collect()
}

fn frames_of<P: Pair>(set: PairSet, pairs: &[P]) -> Vec<Vec<P>> {
    if set.is_sequence() {
        pairs.chunks(pairs.len() / FRAMES).map(<[P]>::to_vec).collect()
    } else {
        resting(pairs)
    }
}

const SETS: [PairSet; 4] = [PairSet::Rest, PairSet::Slide, PairSet::Tumble, PairSet::Touch];

/// What pairs of some size leave behind.
fn hints_of<P: Pair>(pairs: &[P]) -> Vec<Hint> {
    P::collide(pairs, &vec![Hint::NONE; pairs.len()], 0.0, false).iter().map(|fact| fact.hint).collect()
}

#[test]
fn solids() {
    let foreign = hints_of(&pairs3(SolidKind::Hull32, PairSet::Mixed, 7, 9));
    for kind in SolidKind::ALL {
        // How many pairs, and which answers are judged: as many as a second or two has room for.
        let (tracks, judge_every) = match kind {
            SolidKind::Box | SolidKind::Authored | SolidKind::Hull8 => (20, 17),
            SolidKind::Hull16 => (10, 17),
            SolidKind::Hull128 => (2, 31),
            _ => (6, 23),
        };
        for set in SETS {
            let count = if set.is_sequence() { tracks * FRAMES } else { tracks };
            let frames = frames_of(set, &pairs3(kind, set, count, 21));
            let story = format!("{}/{}", kind.name(), set.name());
            let hinted = run(&frames, &foreign, judge_every, &story);
            assert!(hinted >= tracks * FRAMES, "{story}: {hinted} hints");
        }
    }
}

#[test]
fn shapes_in_the_plane() {
    let foreign = hints_of(&pairs2(PlaneKind::Poly64, PairSet::Mixed, 7, 9));
    for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
        for set in SETS {
            let count = if set.is_sequence() { 20 * FRAMES } else { 20 };
            let frames = frames_of(set, &pairs2(kind, set, count, 22));
            let story = format!("{}/{}", kind.name(), set.name());
            let hinted = run(&frames, &foreign, 29, &story);
            assert!(hinted >= 20 * FRAMES, "{story}: {hinted} hints");
        }
    }
}
