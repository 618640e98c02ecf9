//! Narrow phase in space: one query for many pairs, beside the same query of parry3d.
//!
//! | operation | ours | parry3d |
//! |---|---|---|
//! | boolean | `Pair3::overlaps` | `intersection_test` |
//! | separation | `Pair3::separation(0)` | `contact` with prediction 0 |
//! | distance | `Pair3::distance` | `distance` |
//! | manifold | `Pair3::manifold(0)` | `contact_manifolds` into an empty manifold |
//! | cached | `collide3` with the last frame's hints | `contact_manifolds` into the last frame's manifold |
//! | `box8`: boolean, manifold | `collide3` over a slice of sensors or bodies, without hints | as above, one by one |
//! | `box8`: separation | `separations3` | as above, one by one |
//!
//! A set is measured in blocks of a few hundred pairs, by the variants in turns; the figure is the median of the
//! blocks, in nanoseconds per pair. Computing the relative pose is part of the query.
//!
//! Both sides' answers for a part of the set, spread over all of it, are compared with true separations in
//! double-double ([`Judge`], [`Accuracy`]). The depth of a manifold is that of its deepest point. Rows of growing hulls
//! also report the slowest single pair.

pub(crate) mod both;
mod cached;

use crate::accuracy::Accuracy;
use crate::clock::{Effort, time};
use crate::judge::Judge;
use crate::parry::Shapes;
use crate::race::Race;
use crate::row::Row;
use asunder_narrow::{Batch3, Hint, Job3, Pair3, collide3, separations3};
use asunder_scenes::pairs::{FRAMES, PairSet, PosedPair3, SolidKind, frames3, pairs3};
use both::{Both, Peer};

/// The most pairs in a block.
const BLOCK: usize = 250;

/// The most pairs in a set of growing hulls: placing them costs as much as querying them.
const GROWTH_PAIRS: usize = 1000;

/// Pairs that are timed one by one to find the slowest, and how often each: the least time counts.
const ALONE: usize = 100;
const REPEATS: usize = 3;

/// Pairs per block, so that a row has several blocks however slow it is.
pub(crate) fn block_size(ns_of_one: f64, effort: &Effort) -> usize {
    ((effort.nanoseconds() / (8.0 * ns_of_one.max(1.0))) as usize).clamp(1, BLOCK)
}

/// The query of a row.
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
    /// The same, with the last frame's answer as a hint.
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

/// One row: a family of shapes, a set of pairs, and a query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// The family.
    pub kind: SolidKind,
    /// The set of pairs.
    pub set: PairSet,
    /// The query.
    pub operation: Operation,
    /// Whether we get many pairs at once, without hints.
    pub at_once: bool,
}

/// The queries for each family.
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

/// The sets on which growing hulls are queried for their separation.
const GROWTH_SETS: [PairSet; 4] = [PairSet::Mixed, PairSet::Deep, PairSet::Same, PairSet::Turned];

/// Every row.
///
/// ```
/// use asunder_benches::narrow;
/// let names: Vec<String> = narrow::cases().iter().map(narrow::name).collect();
/// for name in ["box/mixed/manifold", "box8/mixed/boolean", "hull32/slide/cached", "hull256/turned/separation"] {
///     assert_eq!(names.iter().filter(|known| *known == name).count(), 1, "{name}");
/// }
/// ```
pub fn cases() -> Vec<Case> {
    let case = |kind, set, operation| Case { kind, set, operation, at_once: false };
    let mut cases = Vec::new();
    for kind in SolidKind::ALL {
        cases.extend(QUESTIONS.map(|(set, operation)| case(kind, set, operation)));
        if kind == SolidKind::Box {
            let batch = |operation| Case { at_once: true, ..case(kind, PairSet::Mixed, operation) };
            cases.extend([Operation::Boolean, Operation::Separation, Operation::Manifold].map(batch));
        }
    }
    let growth = |kind| GROWTH_SETS.map(|set| case(kind, set, Operation::Separation));
    let growing: Vec<Case> = SolidKind::GROWTH.into_iter().flat_map(growth).collect();
    cases.extend(growing.into_iter().filter(|case| {
        !QUESTIONS.contains(&(case.set, case.operation)) || !SolidKind::ALL.contains(&case.kind)
    }));
    cases
}

/// The name of a row, as `box/mixed/manifold`.
///
/// ```
/// use asunder_benches::narrow::{Case, Operation, name};
/// use asunder_scenes::pairs::{PairSet, SolidKind};
/// let case = Case { kind: SolidKind::Box, set: PairSet::Mixed, operation: Operation::Boolean, at_once: false };
/// assert_eq!(name(&case), "box/mixed/boolean");
/// assert_eq!(name(&Case { at_once: true, ..case }), "box8/mixed/boolean");
/// ```
pub fn name(case: &Case) -> String {
    let lanes = if case.at_once { "8" } else { "" };
    format!("{}{lanes}/{}/{}", case.kind.name(), case.set.name(), case.operation.name())
}

/// Measures one row. Cost: about a second per variant, and making and judging the pairs.
///
/// ```
/// use asunder_benches::{clock::Effort, judge::Judge, narrow::{Case, Operation, measure}};
/// use asunder_scenes::pairs::{PairSet, SolidKind};
/// let case = Case { kind: SolidKind::Box, set: PairSet::Mixed, operation: Operation::Separation, at_once: false };
/// let effort = Effort { pairs: 250, rounds: 1, ..Effort::quick() };
/// let row = measure(&case, &effort, &mut Judge::default());
/// let accuracy = row.accuracy.ok_or("not judged")?;
/// assert_eq!((row.done, accuracy.judged, accuracy.off, accuracy.missed), (250, 250, 0, 0));
/// # Ok::<(), &str>(())
/// ```
pub fn measure(case: &Case, effort: &Effort, judge: &mut Judge) -> Row {
    let &Case { kind, set, operation, at_once } = case;
    let mut row = Row::new(name(case), "pair", 0);
    let mut shapes = Shapes::default();
    let is_growing = SolidKind::GROWTH.contains(&kind);
    let count = if SolidKind::ALL.contains(&kind) { effort.pairs } else { effort.pairs.min(GROWTH_PAIRS) };
    let frames = match operation {
        Operation::Cached => frames3(kind, set, count, 1),
        _ => vec![pairs3(kind, set, count, 1)],
    };
    row.n = frames.iter().map(Vec::len).sum();
    let Some(all) = frames.iter().map(|frame| Both::all(frame, &mut shapes)).collect::<Option<Vec<_>>>()
    else {
        row.remark("parry3d refuses a hull");
        return row;
    };
    let race = match (operation, at_once) {
        (Operation::Cached, _) => cached::time_frames(&all, effort, &mut row),
        (_, false) => fresh(operation, &all[0], effort, &mut row),
        (_, true) => batched(operation, &all[0], effort, &mut row),
    };
    if is_growing && operation == Operation::Separation {
        slowest(&all[0], effort, &mut row);
    }
    let done = row.done.min(row.n);
    race.tell(&mut row, "parry3d");
    row.done = done;
    row.accuracy = Some(judged(case, effort, &frames, &all, judge));
    row
}

/// The most pairs of a set that are judged, so that the judge takes some two seconds.
fn most_judged(kind: SolidKind, set: PairSet, effort: &Effort) -> usize {
    let most = match kind {
        SolidKind::Box | SolidKind::Authored | SolidKind::Hull8 | SolidKind::Hull16 => 10_000,
        SolidKind::Hull32 => 5000,
        SolidKind::Hull64 => 1000,
        SolidKind::Hull128 => 400,
        SolidKind::Hull256 | SolidKind::Prism256 | SolidKind::Globe256 => 100,
    };
    // A gap needs no axes.
    let most = if set == PairSet::Far { 10 * most } else { most };
    if effort.is_quick { most / 20 } else { most }
}

/// Compares both sides' answers with the truth for a part of the pairs: spread over the set, in whole sequences of
/// frames.
fn judged(
    case: &Case,
    effort: &Effort,
    frames: &[Vec<PosedPair3>],
    all: &[Vec<Both>],
    judge: &mut Judge,
) -> Accuracy {
    let most = most_judged(case.kind, case.set, effort);
    let width = frames.first().map_or(0, Vec::len);
    let chosen = if case.set.is_sequence() { most.div_ceil(FRAMES) } else { most };
    // Rounded up, so that it is the same for every query on the set.
    let step = width.div_ceil(chosen).max(1);
    let truths_of: Vec<PosedPair3> =
        frames.iter().flat_map(|frame| frame.iter().step_by(step).cloned()).collect();
    let truths = judge.separations((case.kind, case.set), &truths_of);
    let some: Vec<Vec<&Both>> = all.iter().map(|frame| frame.iter().step_by(step).collect()).collect();
    let (ours, peer) = if case.operation == Operation::Cached {
        cached::said(&some)
    } else {
        let pairs = &some[0];
        let ours = if case.at_once {
            both::said_at_once(case.operation, pairs)
        } else {
            pairs.iter().map(|both| both.said(case.operation)).collect()
        };
        let mut peer = Peer::default();
        (ours, pairs.iter().map(|both| peer.said(case.operation, both)).collect())
    };
    let mut accuracy = Accuracy::default();
    let sizes = some.iter().flatten().map(|both| f64::from(both.pair().size()));
    for (((truth, size), ours), peer) in truths.iter().zip(sizes).zip(ours).zip(peer) {
        accuracy.judge(*truth, size, ours, peer);
    }
    accuracy
}

/// Times both sides in turns on blocks of so many pairs, until the time is up.
fn in_turns<B>(
    blocks: &[(usize, B)],
    effort: &Effort,
    row: &mut Row,
    mut ours: impl FnMut(&B) -> f32,
    mut peer: impl FnMut(&B) -> f32,
) -> Race {
    let mut race = Race::default();
    'rounds: for _ in 0..effort.rounds {
        for (count, block) in blocks {
            race.turn(*count, || ours(block), || peer(block));
            row.done += count;
            if race.is_spent(effort) {
                break 'rounds;
            }
        }
    }
    race
}

/// Queries without hints, one by one.
fn fresh(operation: Operation, pairs: &[Both], effort: &Effort, row: &mut Row) -> Race {
    let first = pairs.first().map_or(0.0, |both| time(|| both.ask(operation)).0);
    let blocks = pairs.chunks(block_size(first, effort));
    let blocks: Vec<(usize, &[Both])> = blocks.map(|block| (block.len(), block)).collect();
    let mut peer = Peer::default();
    let ours = |block: &&[Both]| block.iter().map(|both| both.ask(operation)).sum();
    in_turns(&blocks, effort, row, ours, |block| block.iter().map(|both| peer.ask(operation, both)).sum())
}

/// Queries without hints, many at once. The jobs are made beforehand, as the peer's shapes are.
fn batched(operation: Operation, pairs: &[Both], effort: &Effort, row: &mut Row) -> Race {
    let is_sensor = operation == Operation::Boolean;
    let blocks: Vec<(usize, Block<'_>)> =
        pairs.chunks(BLOCK).map(|pairs| (pairs.len(), Block::new(pairs, is_sensor))).collect();
    let (mut batch, mut peer) = (Batch3::default(), Peer::default());
    let mut found = Vec::new();
    let ours = |block: &Block<'_>| {
        if operation == Operation::Separation {
            found.clear();
            separations3(&block.ours, 0.0, &mut found);
            return found.len() as f32;
        }
        batch.clear();
        collide3(&block.jobs, &mut batch);
        batch.answers.len() as f32
    };
    in_turns(&blocks, effort, row, ours, |block| {
        block.pairs.iter().map(|both| peer.ask(operation, both)).sum()
    })
}

/// Pairs, and our jobs for them.
struct Block<'a> {
    pairs: &'a [Both],
    ours: Vec<Pair3<'a>>,
    jobs: Vec<Job3<'a>>,
}

impl<'a> Block<'a> {
    fn new(pairs: &'a [Both], is_sensor: bool) -> Self {
        let jobs = pairs.iter().map(|both| both.job(Hint::NONE, is_sensor)).collect();
        Self { pairs, ours: pairs.iter().map(Both::pair).collect(), jobs }
    }
}

/// The slowest of some pairs, each timed on its own: the least of a few times, which no interruption can prolong.
fn slowest(pairs: &[Both], effort: &Effort, row: &mut Row) {
    let count = if effort.is_quick { ALONE / 5 } else { ALONE };
    let (mut ours, mut theirs, mut peer) = (0.0_f64, 0.0_f64, Peer::default());
    for both in pairs.iter().step_by(pairs.len().div_ceil(count).max(1)) {
        let least = |ask: &mut dyn FnMut() -> f32| {
            (0..REPEATS).map(|_| time(&mut *ask).0).fold(f64::INFINITY, f64::min)
        };
        ours = ours.max(least(&mut || both.ask(Operation::Separation)));
        theirs = theirs.max(least(&mut || peer.ask(Operation::Separation, both)));
    }
    (row.worst_ns, row.peer_worst_ns) = (Some(ours), Some(theirs));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_gives_figures_and_is_right() {
        let effort = Effort { pairs: 60, rounds: 1, seconds: 0.2, is_quick: true };
        let mut judge = Judge::default();
        for case in cases() {
            let row = measure(&case, &effort, &mut judge);
            assert!(row.ratio.is_some() && row.done > 0, "{row:?}");
            let accuracy = row.accuracy.unwrap();
            assert!(accuracy.judged > 0 && accuracy.off + accuracy.missed == 0, "{row:?}");
        }
    }
}
