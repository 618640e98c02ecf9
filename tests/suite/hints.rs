//! Hints over sixty frames: a batch with hints gives the same answers as one without, and so does one with wrong hints.
//!
//! Overlap is the same bit. A separation may come from another axis, and is still within its own error.

use asunder_geometry::{
    Capsule2, Compound2, Compound3, Cuboid, Hull, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3, Sphere,
};
use asunder_narrow::{
    Answer, Batch2, Batch3, Hint, Job2, Job3, Pair2, Pair3, Separation2, Separation3, collide2, collide3,
};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, PosedPair3, SolidKind, pairs2, pairs3};
use asunder_scenes::random::Random;
use asunder_tests::precise::{separation2, separation3};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The content of an answer, and its hint.
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
            Answer::Apart { hint, .. } => {
                Self { hint: *hint, contact: None, measured: None, deepest: f64::INFINITY }
            }
            Answer::Contact { hint, overlapping, manifolds: range } => {
                // For compounds, the deepest pair of parts.
                let of_parts =
                    manifolds.get(range.start as usize..range.end as usize).unwrap().iter().map(read);
                let found = of_parts.min_by(|one, other| one.0.total_cmp(&other.0));
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
    /// Answers to many pairs, each with its hint; sensors have no manifolds.
    fn collide(pairs: &[Self], hints: &[Hint], margin: f32, sensor: bool) -> Vec<Fact>;
    /// The true separation and the oracle's error.
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
            jobs.push(Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor });
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
            jobs.push(Job2 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor });
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

/// How much a stable choice of the reference face may cost the deepest point, as a share of the size: twice 2e-6 of the
/// smaller radius.
const STEADY: f64 = 2e-6;

/// Compares two answers to the same question.
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
        // Within the error of the margin either is allowed.
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

/// Three batches over all frames: without hints, with their own, and with those of another pair, also of another
/// family. Every `judge_every`-th answer is compared with the truth. Returns how many answers gave a hint.
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
            // From a neighbouring pair, or from another family altogether.
            let other = |i: usize| match foreign.get((number + i) % (2 * foreign.len()).max(1)) {
                Some(&hint) => hint,
                None => own[(i + 1 + number % 3) % width],
            };
            shuffled = (0..width).map(other).collect();
        }
    }
    hinted
}

/// Sixty frames of resting pairs that move slightly each frame: not at all, by a rounding, by a thousandth of the
/// depth.
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

/// The hints of some pairs.
fn hints_of<P: Pair>(pairs: &[P]) -> Vec<Hint> {
    P::collide(pairs, &vec![Hint::NONE; pairs.len()], 0.0, false).iter().map(|fact| fact.hint).collect()
}

#[test]
fn solids() {
    let foreign = hints_of(&pairs3(SolidKind::Hull32, PairSet::Mixed, 7, 9));
    for kind in SolidKind::ALL {
        // How many pairs there are, and which answers are judged: as many as a second or two has time for.
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

/// A hammer: a handle of all parts but one, of several kinds, and a head across it.
fn hammer3(random: &mut Random, parts: usize) -> Shape3 {
    let length = 1.6 / (parts - 1) as f32;
    let mut all = vec![(Pose3::at([0.0, 0.9, 0.0]).unwrap(), part3(random, 0, Vec3::new(0.5, 0.2, 0.2)))];
    for i in 0..parts - 1 {
        let place = DVec3::new(0.0, 0.7 - f64::from(length) * (i as f64 + 0.5), 0.0);
        let kind = random.below(4);
        all.push((Pose3::at(place).unwrap(), part3(random, kind, Vec3::new(0.1, 0.5 * length, 0.1))));
    }
    Compound3::new(all).unwrap().into()
}

fn part3(random: &mut Random, kind: usize, half: Vec3) -> Shape3 {
    match kind {
        0 | 1 => Cuboid::from_half_extents(half).unwrap().into(),
        2 => Sphere::new(half.y).unwrap().into(),
        _ => {
            let points: Vec<Vec3> = (0..24).map(|_| random.direction().as_vec3() * half).collect();
            Hull::from_points(&points).unwrap().into()
        }
    }
}

/// The same in the plane.
fn hammer2(random: &mut Random, parts: usize) -> Shape2 {
    let length = 1.6 / (parts - 1) as f32;
    let head = Rect::from_half_extents(Vec2::new(0.5, 0.2)).unwrap().into();
    let mut all: Vec<(Pose2, Shape2)> = vec![(Pose2::at([0.0, 0.9]).unwrap(), head)];
    for i in 0..parts - 1 {
        let place = DVec2::new(0.0, 0.7 - f64::from(length) * (i as f64 + 0.5));
        let part = match random.below(2) {
            0 => Rect::from_half_extents(Vec2::new(0.1, 0.5 * length)).unwrap().into(),
            _ => Capsule2::from_half_height(0.5 * length, 0.1).unwrap().into(),
        };
        all.push((Pose2::at(place).unwrap(), part));
    }
    Compound2::new(all).unwrap().into()
}

/// Initial depths of pairs of compounds: deep, resting, within the margin, apart.
const DEPTHS: [f64; 5] = [0.05, 1e-3, -1e-2, -0.1, -0.4];

/// Sixty frames of hammers against hammers or single shapes that turn past each other, a little further each frame.
fn hammers3(random: &mut Random) -> Vec<Vec<PosedPair3>> {
    let mut tracks = Vec::new();
    for (i, &depth) in (0..20).zip(DEPTHS.iter().cycle()) {
        let shape_a = hammer3(random, [2, 3, 5, 8][i % 4]);
        let shape_b =
            if i % 7 == 6 { part3(random, i % 4, Vec3::splat(0.4)) } else { hammer3(random, 2 + i % 7) };
        let pose_a = Pose3::new(random.direction() * 10.0, random.rotation()).unwrap();
        let far = pose_a.position() + random.direction() * 6.0;
        let rotation = random.rotation();
        let pose_b = Pose3::new(far, rotation).unwrap();
        let found = Pair3::new(&shape_a, &pose_a, &shape_b, &pose_b).separation(f32::INFINITY);
        let Separation3::Measured(found) = found else { unreachable!("without a limit it is measured") };
        let start = far - found.normal.as_dvec3() * (f64::from(found.separation) + depth);
        let (drift, spin) =
            (random.direction() * [0.0, 1e-3, 1e-2][i % 3], random.direction() * [0.0, 0.02][i % 2]);
        let frame = |number: usize| {
            let turn = glam::Quat::from_scaled_axis((spin * number as f64).as_vec3());
            let pose_b = Pose3::new(start + drift * number as f64, turn * rotation).unwrap();
            PosedPair3 { shape_a: shape_a.clone(), pose_a, shape_b: shape_b.clone(), pose_b }
        };
        tracks.push((0..FRAMES).map(frame).collect::<Vec<_>>());
    }
    (0..FRAMES).map(|number| tracks.iter().map(|track| track[number].clone()).collect()).collect()
}

/// The same in the plane.
fn hammers2(random: &mut Random) -> Vec<Vec<PosedPair2>> {
    let mut tracks = Vec::new();
    for (i, &depth) in (0..20).zip(DEPTHS.iter().cycle()) {
        let shape_a = hammer2(random, [2, 3, 5, 8][i % 4]);
        let shape_b = if i % 7 == 6 {
            Rect::from_half_extents(Vec2::splat(0.4)).unwrap().into()
        } else {
            hammer2(random, 2 + i % 7)
        };
        let (angle_a, angle_b) = (random.range(-3.0, 3.0), random.range(-3.0, 3.0));
        let turned = |angle: f64| Rotation2::from_angle(angle as f32).unwrap();
        let pose_a = Pose2::new(random.direction().truncate() * 10.0, turned(angle_a)).unwrap();
        let far = pose_a.position() + random.direction().truncate().normalize_or(DVec2::X) * 6.0;
        let pose_b = Pose2::new(far, turned(angle_b)).unwrap();
        let found = Pair2::new(&shape_a, &pose_a, &shape_b, &pose_b).separation(f32::INFINITY);
        let Separation2::Measured(found) = found else { unreachable!("without a limit it is measured") };
        let start = far - found.normal.as_dvec2() * (f64::from(found.separation) + depth);
        let drift = random.direction().truncate() * [0.0, 1e-3, 1e-2][i % 3];
        let spin = [0.0, 0.02][i % 2];
        let frame = |number: usize| {
            let by = number as f64;
            let pose_b = Pose2::new(start + drift * by, turned(angle_b + spin * by)).unwrap();
            PosedPair2 { shape_a: shape_a.clone(), pose_a, shape_b: shape_b.clone(), pose_b }
        };
        tracks.push((0..FRAMES).map(frame).collect::<Vec<_>>());
    }
    (0..FRAMES).map(|number| tracks.iter().map(|track| track[number].clone()).collect()).collect()
}

#[test]
fn compounds() {
    let mut random = Random::new(41);
    let frames = hammers3(&mut random);
    // Hints of other hammers; of hulls, which have other features; and of the plane.
    let own = run(&frames, &[], 31, "hammers");
    assert!(own >= frames.len() * frames[0].len(), "{own} hints");
    run(&frames, &hints_of(&pairs3(SolidKind::Hull32, PairSet::Mixed, 40, 9)), 31, "hammers, hints of hulls");
    run(&frames, &hints_of(&hammers2(&mut random)[0]), 31, "hammers, hints of the plane");
    // Hints that name parts that do not exist, for shapes without parts.
    let hulls = resting(&pairs3(SolidKind::Hull16, PairSet::Touch, 10, 21));
    run(&hulls, &hints_of(&frames[0]), 31, "hulls, hints of hammers");
    let few: Vec<Vec<_>> = frames.iter().map(|pairs| vec![pairs[0].clone(), pairs[14].clone()]).collect();
    run(&few, &hints_of(&frames[0]), 31, "small hammers, hints of large ones");
}

#[test]
fn compounds_in_the_plane() {
    let mut random = Random::new(42);
    let frames = hammers2(&mut random);
    let own = run(&frames, &[], 31, "hammers");
    assert!(own >= frames.len() * frames[0].len(), "{own} hints");
    run(
        &frames,
        &hints_of(&pairs2(PlaneKind::Poly64, PairSet::Mixed, 40, 9)),
        31,
        "hammers, hints of polygons",
    );
    run(&frames, &hints_of(&hammers3(&mut random)[0]), 31, "hammers, hints of space");
    let polygons = resting(&pairs2(PlaneKind::Poly8, PairSet::Touch, 10, 21));
    run(&polygons, &hints_of(&frames[0]), 31, "polygons, hints of hammers");
}
