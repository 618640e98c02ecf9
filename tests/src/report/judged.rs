//! One case: all our promises checked against the oracles.

use super::peers::{self, Said};
use super::posed::{Ours, Posed, Reported, Truth};
use crate::exact_overlap::Relation;
use core::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A separation must be within this share of the measure, and its normal must show it to this share.
const ACCURACY: f64 = 1e-6;

/// What is checked of a case besides overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    /// Whether the oracles measure the separation.
    pub truth: bool,
    /// Whether parry3d is queried.
    pub peers: bool,
}

/// A promise that was broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// `overlaps` or `verdict` disagrees with exact arithmetic.
    Wrong,
    /// A panic.
    Panicked,
    /// A NaN, an undue infinity, a negative error, or a normal that is not a unit vector.
    NotANumber,
    /// `separation` above 0 exactly when the shapes do not overlap.
    Sign,
    /// `distance` returns something exactly when the shapes do not overlap.
    Distance,
    /// |true - reported| <= error.
    Broken,
    /// Separation and distance within 1e-6 of the measure.
    Inaccurate,
    /// The separation along the reported normal is within 1e-6 of the measure of the best one.
    Regret,
    /// There is a manifold at margin 0 exactly when two solids overlap.
    Manifold,
}

impl FaultKind {
    /// Every promise, in the order in which results are listed.
    pub const ALL: [Self; 9] = [
        Self::Wrong,
        Self::Panicked,
        Self::NotANumber,
        Self::Sign,
        Self::Distance,
        Self::Broken,
        Self::Inaccurate,
        Self::Regret,
        Self::Manifold,
    ];
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Wrong => "overlaps is wrong",
            Self::Panicked => "panicked",
            Self::NotANumber => "no number, or no unit normal",
            Self::Sign => "the separation's sign is not that of overlaps",
            Self::Distance => "distance does not go with overlaps",
            Self::Broken => "broken error bound",
            Self::Inaccurate => "off by more than 1e-6 of size",
            Self::Regret => "normal off by more than 1e-6 of size",
            Self::Manifold => "contact points do not go with overlaps",
        })
    }
}

/// One broken promise, with its numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// Which promise.
    pub kind: FaultKind,
    /// The numbers that show it.
    pub story: String,
}

/// The results for one case.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// The relation by exact arithmetic.
    pub relation: Relation,
    /// The oracles' separation, if it was measured.
    pub truth: Option<Truth>,
    /// What errors are relative to, in metres: the size, or in a wide gap the separation, which is rounded to f32.
    pub measure: f64,
    /// Our answers; `None` after a panic.
    pub ours: Option<Ours>,
    /// The promises that we broke.
    pub faults: Vec<Fault>,
    /// parry3d's answers in f32 and f64, where it was queried.
    pub peers: [Said; 2],
    /// The larger |reported - true| of separation and distance over the measure.
    pub error: Option<f64>,
    /// The same over the error that was reported.
    pub tightness: Option<f64>,
    /// The true separation less that along our normal, over the measure.
    pub regret: Option<f64>,
}

/// Runs all queries on one pair, and checks the answers against the oracles.
///
/// ```
/// use asunder_scenes::pairs::{PairSet, PlaneKind, pairs2};
/// use asunder_tests::report::{Question, judge};
/// let pair = &pairs2(PlaneKind::Poly8, PairSet::Far, 1, 1)[0];
/// let judged = judge(pair, Question { truth: false, peers: false });
/// assert!(!judged.overlapping() && judged.truth.is_none() && judged.faults.is_empty());
/// ```
pub fn judge<P: Posed>(pair: &P, question: Question) -> Judged {
    let relation = pair.relation();
    let truth = question.truth.then(|| pair.truth());
    let mut judged = Judged {
        relation,
        truth,
        measure: measure(pair.size(), truth),
        ours: None,
        faults: Vec::new(),
        peers: pair.in_space().filter(|_| question.peers).map_or([Said::default(); 2], peers::ask),
        error: None,
        tightness: None,
        regret: None,
    };
    // Nothing that a panic leaves behind is used again.
    match catch_unwind(AssertUnwindSafe(|| pair.ours())) {
        Ok(ours) => {
            judged.ours = Some(ours);
            judged.check_yes_or_no(&ours, pair.is_solid());
            judged.check_numbers(&ours);
            if judged.truth.is_some() {
                judged.check_separation(&ours, pair);
            }
        }
        Err(cause) => {
            let text = cause.downcast_ref::<String>().map(String::as_str);
            let text = text.or(cause.downcast_ref::<&str>().copied()).unwrap_or("without a message");
            judged.blame(FaultKind::Panicked, text.to_string());
        }
    }
    judged
}

/// A wide gap is a larger number than the size, and an f32 rounds it relative to itself.
fn measure(size: f64, truth: Option<Truth>) -> f64 {
    let gap = truth.map(|truth| truth.separation.abs()).filter(|gap| gap.is_finite()).unwrap_or(0.0);
    size.max(gap).max(f64::MIN_POSITIVE)
}

impl Judged {
    /// Whether the shapes share a point; touching counts.
    pub fn overlapping(&self) -> bool {
        self.relation != Relation::Apart
    }

    fn blame(&mut self, kind: FaultKind, story: String) {
        self.faults.push(Fault { kind, story });
    }

    fn check_yes_or_no(&mut self, ours: &Ours, is_solid: bool) {
        let exact = self.overlapping();
        if ours.overlaps != exact || ours.verdict.overlapping != exact {
            let story = format!("overlaps {}, {:?}, exact {exact}", ours.overlaps, ours.verdict);
            self.blame(FaultKind::Wrong, story);
        }
        // Compared with our own overlap decision: a wrong one is reported above.
        let overlaps = ours.overlaps;
        match ours.separation {
            Some(found) if (found.value <= 0.0) == overlaps => {}
            found => self.blame(FaultKind::Sign, format!("overlaps {overlaps}, separation {found:?}")),
        }
        if ours.distance.is_some() == overlaps || ours.distance.is_some_and(|found| found.value <= 0.0) {
            let story = format!("overlaps {overlaps}, distance {:?}", ours.distance);
            self.blame(FaultKind::Distance, story);
        }
        if is_solid && (ours.points.is_some_and(|count| count > 0)) != overlaps {
            let story = format!("overlaps {overlaps}, points {:?}, {:?}", ours.points, ours.separation);
            self.blame(FaultKind::Manifold, story);
        }
    }

    fn check_numbers(&mut self, ours: &Ours) {
        for found in ours.separation.iter().chain(&ours.distance) {
            // Two half-spaces that face each other overlap without bound.
            let is_number = found.value.is_finite() || found.value == f64::NEG_INFINITY;
            let has_bound = found.error >= 0.0 && found.error < f64::INFINITY;
            let is_unit = (found.normal.length() - 1.0).abs() < 1e-6;
            if !(is_number && has_bound && is_unit) {
                self.blame(FaultKind::NotANumber, format!("{found:?}"));
            }
        }
    }

    fn check_separation<P: Posed>(&mut self, ours: &Ours, pair: &P) {
        let Some(truth) = self.truth else { return };
        for found in ours.separation.iter().chain(&ours.distance) {
            self.check_error(truth, found);
        }
        let Some(found) = ours.separation else { return };
        let best = truth.separation;
        if !best.is_finite() {
            return;
        }
        let gap = pair.gap_along(found.normal);
        // Rounding may make the best normal look better than the truth.
        let regret = ((best - gap) / self.measure).max(0.0);
        self.regret = larger(self.regret, regret);
        if exceeds(best - gap, ACCURACY * self.measure) {
            self.blame(FaultKind::Regret, format!("true {best}, {gap} along the normal of {found:?}"));
        }
    }

    fn check_error(&mut self, truth: Truth, found: &Reported) {
        let Truth { separation, bound } = truth;
        let off = if found.value == separation { 0.0 } else { (found.value - separation).abs() };
        self.error = larger(self.error, off / self.measure);
        if off > bound {
            self.tightness = larger(self.tightness, (off - bound) / found.error);
        }
        if exceeds(off, found.error + bound) {
            let story = format!("off by {off}, true {separation} up to {bound}, {found:?}");
            self.blame(FaultKind::Broken, story);
        }
        if exceeds(off, ACCURACY * self.measure) {
            let share = off / self.measure;
            self.blame(
                FaultKind::Inaccurate,
                format!("off by {share} of size, true {separation}, {found:?}"),
            );
        }
    }
}

/// Whether a figure is beyond its limit; a NaN on either side is.
fn exceeds(figure: f64, limit: f64) -> bool {
    figure.is_nan() || limit.is_nan() || figure > limit
}

/// The larger of a new figure and the known one; a NaN stays.
fn larger(known: Option<f64>, found: f64) -> Option<f64> {
    Some(known.map_or(found, |known| if found > known || found.is_nan() { found } else { known }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_geometry::{Cuboid, Pose3, Shape3};
    use asunder_narrow::{Tier, Verdict};
    use asunder_scenes::pairs::PosedPair3;
    use glam::{DVec3, Vec3};

    /// A real pair with answers of our choosing.
    #[derive(Debug)]
    struct Liar {
        pair: PosedPair3,
        ours: Option<Ours>,
    }

    impl Posed for Liar {
        fn ours(&self) -> Ours {
            self.ours.unwrap_or_else(|| panic!("no answer"))
        }
        fn guess(&self) -> bool {
            self.pair.guess()
        }
        fn overlaps(&self) -> bool {
            self.pair.overlaps()
        }
        fn verdict(&self) -> Verdict {
            self.pair.verdict()
        }
        fn relation(&self) -> Relation {
            self.pair.relation()
        }
        fn truth(&self) -> Truth {
            self.pair.truth()
        }
        fn size(&self) -> f64 {
            self.pair.size()
        }
        fn gap_along(&self, normal: DVec3) -> f64 {
            self.pair.gap_along(normal)
        }
        fn vertices(&self) -> usize {
            self.pair.vertices()
        }
        fn is_solid(&self) -> bool {
            self.pair.is_solid()
        }
        fn in_space(&self) -> Option<&PosedPair3> {
            None
        }
    }

    /// Two unit cubes at a distance along x, with true answers.
    fn honest(x: f64) -> Liar {
        let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap());
        let pose_b = Pose3::at([x, 0.125, 0.0]).unwrap();
        let pair = PosedPair3 { shape_a: cube.clone(), pose_a: Pose3::IDENTITY, shape_b: cube, pose_b };
        let overlapping = x <= 1.0;
        let measured = Reported { value: x - 1.0, error: 1e-7, normal: DVec3::X };
        let ours = Ours {
            guess: overlapping,
            verdict: Verdict { overlapping, tier: Tier::Bound },
            overlaps: overlapping,
            separation: Some(measured),
            distance: (!overlapping).then_some(measured),
            points: overlapping.then_some(4),
        };
        Liar { pair, ours: Some(ours) }
    }

    fn found(liar: &Liar) -> Vec<FaultKind> {
        judge(liar, Question { truth: true, peers: false }).faults.iter().map(|fault| fault.kind).collect()
    }

    fn with(x: f64, lie: impl FnOnce(&mut Ours)) -> Vec<FaultKind> {
        let mut liar = honest(x);
        lie(liar.ours.as_mut().unwrap());
        found(&liar)
    }

    #[test]
    fn honest_answers_are_not_blamed() {
        for x in [0.75, 1.0, 1.5, 40.0] {
            assert_eq!(found(&honest(x)), []);
        }
    }

    #[test]
    fn every_lie_is_found_and_named() {
        use FaultKind::{Broken, Distance, Inaccurate, Manifold, NotANumber, Panicked, Regret, Sign, Wrong};
        let separation = |ours: &mut Ours, change: fn(&mut Reported)| {
            change(ours.separation.as_mut().unwrap());
        };
        assert_eq!(with(1.5, |ours| ours.verdict.overlapping = true), [Wrong]);
        assert_eq!(with(0.75, |ours| ours.points = None), [Manifold]);
        assert_eq!(with(1.5, |ours| ours.points = Some(1)), [Manifold]);
        assert_eq!(with(1.5, |ours| ours.distance = None), [Distance]);
        assert_eq!(with(0.75, |ours| ours.separation = None), [Sign]);
        assert_eq!(with(1.0, |ours| separation(ours, |found| found.value = 5e-8)), [Sign]);
        // Breaks the bound alone; the bound and the accuracy; the accuracy alone.
        assert_eq!(with(0.75, |ours| separation(ours, |found| found.value += 2e-7)), [Broken]);
        assert_eq!(with(0.75, |ours| separation(ours, |found| found.value += 1e-5)), [Broken, Inaccurate]);
        let wide = |found: &mut Reported| (found.value, found.error) = (-0.251, 1e-2);
        assert_eq!(with(0.75, |ours| separation(ours, wide)), [Inaccurate]);
        assert_eq!(with(0.75, |ours| separation(ours, |found| found.normal = DVec3::Y)), [Regret]);
        assert_eq!(with(0.75, |ours| separation(ours, |found| found.normal = DVec3::X * 0.99)), [NotANumber]);
        let no_number = with(0.75, |ours| separation(ours, |found| found.error = f64::NAN));
        assert_eq!(no_number, [NotANumber, Broken]);
        assert_eq!(found(&Liar { ours: None, ..honest(1.0) }), [Panicked]);
    }
}
