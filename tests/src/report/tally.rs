//! Many cases of one family added up, with the same result in any order, on any number of threads.

use super::judged::{FaultKind, Judged, Question, judge};
use super::peers::Said;
use super::posed::Posed;
use crate::exact_overlap::Relation;
use asunder_narrow::Tier;
use asunder_scenes::hard::{Family2, Family3};
use asunder_scenes::pairs::{PosedPair2, PosedPair3};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A family of hard cases, in either dimension.
pub trait Hard: Sync {
    /// Its pairs.
    type Pair: Posed;
    /// `hard/NAME` in space, `hard2/NAME` in the plane.
    fn title(&self) -> String;
    /// What is hard about it.
    fn about(&self) -> &'static str;
    /// Levels of difficulty, 0 the easiest.
    fn levels(&self) -> u32;
    /// One case. Equal arguments give equal bits.
    fn case(&self, level: u32, seed: u64) -> Self::Pair;

    /// Case `index` of a run: levels in turn, so that any prefix has them all.
    fn nth(&self, index: usize, seed: u64) -> (u32, u64) {
        let levels = self.levels().max(1) as usize;
        ((index % levels) as u32, seed.wrapping_add((index / levels) as u64))
    }
}

impl Hard for Family3 {
    type Pair = PosedPair3;

    fn title(&self) -> String {
        format!("hard/{}", self.name)
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn levels(&self) -> u32 {
        self.levels
    }

    fn case(&self, level: u32, seed: u64) -> PosedPair3 {
        self.pair(level, seed)
    }
}

impl Hard for Family2 {
    type Pair = PosedPair2;

    fn title(&self) -> String {
        format!("hard2/{}", self.name)
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn levels(&self) -> u32 {
        self.levels
    }

    fn case(&self, level: u32, seed: u64) -> PosedPair2 {
        self.pair(level, seed)
    }
}

/// How much of a family is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scope {
    /// Cases.
    pub cases: usize,
    /// The separation is judged on every k-th case of each level, from the first; this is k.
    pub truth_every: usize,
    /// The first seed.
    pub seed: u64,
    /// Whether parry3d is queried.
    pub peers: bool,
}

/// The first case that broke a promise, with what is needed to make it again.
#[derive(Clone, Debug, PartialEq)]
pub struct Offender {
    /// Its place in the run.
    pub index: usize,
    /// Its level of difficulty.
    pub level: u32,
    /// Its seed.
    pub seed: u64,
    /// The numbers that show the breach.
    pub story: String,
}

/// What a peer got wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PeerTally {
    /// Cases with an overlap decision.
    pub answered: usize,
    /// Wrong ones among them; where shapes touch without overlapping, any answer is accepted.
    pub wrong: usize,
    /// Separations that are NaN.
    pub not_a_number: usize,
    /// Panics.
    pub panics: usize,
    /// The largest |separation - truth| over the measure, of the cases whose separation was judged.
    pub error: Option<f64>,
}

/// A family's cases, added up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// The family's title.
    pub family: String,
    /// Cases.
    pub cases: usize,
    /// Cases whose separation was judged.
    pub measured: usize,
    /// Cases in which the shapes share a point.
    pub overlapping: usize,
    /// Cases among them in which they touch without overlapping.
    pub touching: usize,
    /// Wrong answers of the first tier alone.
    pub wrong_guesses: usize,
    /// Cases by the tier that settled them: bound, double, exact.
    pub tiers: [usize; 3],
    /// How often each promise was broken.
    pub faults: BTreeMap<FaultKind, usize>,
    /// The first case that broke each promise.
    pub offenders: BTreeMap<FaultKind, Offender>,
    /// The largest [`Judged::error`].
    pub error: Option<f64>,
    /// The largest [`Judged::tightness`].
    pub tightness: Option<f64>,
    /// The largest [`Judged::regret`].
    pub regret: Option<f64>,
    /// parry3d in f32 and f64.
    pub peers: [PeerTally; 2],
}

/// A family's weight in sharing out cases: 1 up to 40 vertices per pair, less in proportion beyond, as judging takes
/// longer. Cost: making two pairs of every level.
///
/// ```
/// use asunder_scenes::hard::FAMILIES2;
/// assert!((0.0..=1.0).contains(&asunder_tests::report::weight(&FAMILIES2[0])));
/// ```
pub fn weight<H: Hard>(family: &H) -> f64 {
    let count = 2 * family.levels().max(1) as usize;
    let vertices = |index: usize| {
        let (level, seed) = family.nth(index, 0);
        family.case(level, seed).vertices()
    };
    let mean = (0..count).map(vertices).sum::<usize>() as f64 / count as f64;
    (USUAL_VERTICES / mean).min(1.0)
}

/// Vertices of a pair up to which a family gets its full share of the cases.
const USUAL_VERTICES: f64 = 40.0;

/// Shares out at least `cases` cases by weight.
///
/// ```
/// assert_eq!(asunder_tests::report::shares(&[1.0, 0.5, 1.0], 25), [10, 5, 10]);
/// ```
pub fn shares(weights: &[f64], cases: usize) -> Vec<usize> {
    let sum = weights.iter().sum::<f64>();
    weights.iter().map(|weight| (cases as f64 * weight / sum).ceil() as usize).collect()
}

/// Runs and judges some cases of a family on all threads of the current pool.
///
/// ```
/// use asunder_scenes::hard::FAMILIES2;
/// use asunder_tests::report::{Scope, tally};
/// let scope = Scope { cases: 8, truth_every: 2, seed: 1, peers: false };
/// let tally = tally(&FAMILIES2[0], &scope);
/// assert_eq!(tally.cases, 8);
/// ```
pub fn tally<H: Hard>(family: &H, scope: &Scope) -> Tally {
    let levels = family.levels().max(1) as usize;
    let add = |mut tally: Tally, index: usize| {
        let (level, seed) = family.nth(index, scope.seed);
        let truth = (index / levels).is_multiple_of(scope.truth_every.max(1));
        let judged = judge(&family.case(level, seed), Question { truth, peers: scope.peers });
        tally.add(&judged, index, (level, seed));
        tally
    };
    let found = (0..scope.cases).into_par_iter().fold(Tally::default, add);
    Tally { family: family.title(), ..found.reduce(Tally::default, Tally::merged) }
}

impl Tally {
    /// How often a promise was broken.
    pub fn count(&self, kind: FaultKind) -> usize {
        self.faults.get(&kind).copied().unwrap_or(0)
    }

    /// How often a promise was broken, and by which case first, in words; `None` where it was kept.
    pub fn complaint(&self, kind: FaultKind) -> Option<String> {
        let Offender { level, seed, story, .. } = self.offenders.get(&kind)?;
        let (family, count, cases) = (&self.family, self.count(kind), self.cases);
        Some(format!("{family}: {kind} in {count} of {cases}, first at level {level}, seed {seed}: {story}"))
    }

    fn add(&mut self, judged: &Judged, index: usize, (level, seed): (u32, u64)) {
        self.cases += 1;
        self.measured += usize::from(judged.truth.is_some());
        self.overlapping += usize::from(judged.overlapping());
        self.touching += usize::from(judged.relation == Relation::Touching);
        if let Some(ours) = judged.ours {
            self.wrong_guesses += usize::from(ours.guess != judged.overlapping());
            let tier = match ours.verdict.tier {
                Tier::Bound => 0,
                Tier::Double => 1,
                Tier::Exact => 2,
            };
            self.tiers[tier] += 1;
        }
        for fault in &judged.faults {
            *self.faults.entry(fault.kind).or_default() += 1;
            let offender = Offender { index, level, seed, story: fault.story.clone() };
            self.offend(fault.kind, offender);
        }
        self.error = largest(self.error, judged.error);
        self.tightness = largest(self.tightness, judged.tightness);
        self.regret = largest(self.regret, judged.regret);
        for (peer, said) in self.peers.iter_mut().zip(&judged.peers) {
            peer.add(said, judged);
        }
    }

    /// Keeps the earlier of two offenders.
    fn offend(&mut self, kind: FaultKind, offender: Offender) {
        match self.offenders.get(&kind) {
            Some(known) if known.index <= offender.index => {}
            _ => {
                self.offenders.insert(kind, offender);
            }
        }
    }

    fn merged(mut self, other: Self) -> Self {
        self.cases += other.cases;
        self.measured += other.measured;
        self.overlapping += other.overlapping;
        self.touching += other.touching;
        self.wrong_guesses += other.wrong_guesses;
        for (count, more) in self.tiers.iter_mut().zip(other.tiers) {
            *count += more;
        }
        for (kind, count) in other.faults {
            *self.faults.entry(kind).or_default() += count;
        }
        for (kind, offender) in other.offenders {
            self.offend(kind, offender);
        }
        self.error = largest(self.error, other.error);
        self.tightness = largest(self.tightness, other.tightness);
        self.regret = largest(self.regret, other.regret);
        for (peer, more) in self.peers.iter_mut().zip(other.peers) {
            peer.answered += more.answered;
            peer.wrong += more.wrong;
            peer.not_a_number += more.not_a_number;
            peer.panics += more.panics;
            peer.error = largest(peer.error, more.error);
        }
        self
    }
}

impl PeerTally {
    fn add(&mut self, said: &Said, judged: &Judged) {
        self.panics += usize::from(said.panicked);
        self.not_a_number += usize::from(said.separation.is_some_and(f64::is_nan));
        if let Some(overlaps) = said.overlaps {
            self.answered += 1;
            self.wrong +=
                usize::from(overlaps != judged.overlapping() && judged.relation != Relation::Touching);
        }
        if let (Some(truth), Some(separation)) = (judged.truth, said.separation)
            && truth.separation.is_finite()
            && !separation.is_nan()
        {
            let off = (separation - truth.separation).abs();
            self.error = largest(self.error, Some(off / judged.measure));
        }
    }
}

/// The larger of two figures; a NaN counts as the largest, on whichever side it is.
fn largest(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if a.is_nan() || a >= b { a } else { b }),
        (known, None) | (None, known) => known,
    }
}
