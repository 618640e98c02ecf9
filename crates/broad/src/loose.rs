//! Sweeps loose (fat) boxes, whose pairs stay valid for many frames while boxes hardly move.
//!
//! ```text
//! every box lies in a loose one, wider by what it may move in some frames
//! each frame, of the boxes that moved:
//!   those that are still inside their loose ones: the pairs of loose boxes have not changed
//!   if a few have left theirs: these get new loose boxes, which are looked up             coherent
//!   if many have: all get new loose boxes, which are all swept
//! if few moved, for some frames in a row: give up loose boxes, until many move
//! report those pairs of loose boxes whose boxes overlap
//! if that costs no less than sweeping the boxes, or loose boxes have many more pairs: give loose boxes up, and try
//!   again after some frames, twice as many each time
//! ```
//! The same as a table of states ([`State`]). `n` counts frames, `patience` is where it starts:
//! ```text
//! state          a frame in which                               next state                        pairs from
//! Boxes n        few boxes move                                 Boxes n                           a sweep
//! Boxes n        many move                                      Boxes n - 1; of 0, Noted          a sweep
//! Noted          few move                                       Noted                             a sweep
//! Noted          many move                                      Loose                             loose boxes
//! Loose          few move, as in the STILL frames before        Boxes patience                    a sweep
//! Loose          strays cost at most half a sweep (1)           Loose                             loose boxes
//! Loose          they cost more, loose boxes were worth it      Loose anew; least patience        loose boxes
//! Loose          they cost more, loose boxes were not           Boxes patience; patience * 2      a sweep
//! Noted, Loose   boxes were taken off the list's end            Boxes patience; patience * 2      a sweep
//! to Loose       loose boxes have too many pairs                Boxes patience; patience * 2      a sweep
//! (1) and so few have left their loose boxes that not all need be swept again
//! ```
//! A frame in which all boxes get new loose ones, or give them up, takes as long as up to three sweeps of the boxes.
//! Bodies that rest on each other tremble, but stay inside their loose boxes meanwhile: a frame then costs one
//! comparison per box and one per pair. The list equals that of [`Sweep`](crate::Sweep) whatever came before: history
//! affects only the cost.
//!
//! Heaps at rest but awake, one thread (AMD EPYC, Zen 4, 2026-11-23): a sweep of 8,005 boxes takes 0.15 ms in place of
//! 0.67, of 10,081 boxes in pyramids 0.12 in place of 0.53; whole frames are 1.08 and 1.15 times as fast.
//!
//! Tried:
//! - a margin by size alone, a hundredth of it: 60 % more pairs in a heap of boxes
//! - a margin for 16 frames at a box's pace in place of 64: two thirds of the gain
//! - new loose boxes for all whenever some are worn, narrower where they had been too wide: boxes that had turned back
//!   leave them again
//!
//! Sources: neighbour lists with a skin, L. Verlet, *Computer "experiments" on classical fluids*, Phys. Rev. 159
//! (1967); the fat boxes of the dynamic trees of Bullet and Box2D.

use crate::coherent::{CoherentSweep, FEW};
use crate::columns::Column;
use crate::pair::{PairId, TooManyPairs};
use crate::sift::sift;
use crate::sweep::{Admit, keep};
use asunder_geometry::Bounds;

#[cfg(test)]
mod tests;

/// The boxes that differ from those of the last call.
///
/// ```
/// let moved = asunder_broad::Moved { places: &[3, 7], has_changed: |place| place == 7 };
/// assert!((moved.has_changed)(7) && !(moved.has_changed)(3), "3 moved, and is the box that it was");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Moved<'a, C> {
    /// Their places; in any order, repetitions allowed.
    pub places: &'a [u32],
    /// Whether a box at such a place stands for something else than before, so that the filter must be asked about it
    /// anew. Called from any thread, in any order.
    pub has_changed: C,
}

/// Finds all overlapping pairs of boxes each frame, whether few of them move or most of them a little.
///
/// ```
/// use asunder_broad::{LooseSweep, Moved, PairId};
/// use asunder_geometry::{Aabb3, glam::Vec3};
/// let unit_at = |x: f32| Aabb3::new(Vec3::splat(x), Vec3::splat(x + 1.0));
/// let (mut sweep, mut pairs) = (LooseSweep::new(), Vec::new());
/// let moved = Moved { places: &[0, 1, 2], has_changed: |_| false };
/// for frame in 0..100u8 {
///     let tremble = if frame % 2 == 0 { 0.001 } else { -0.001 };
///     let boxes = [unit_at(0.0), unit_at(1.0 + tremble), unit_at(3.0 - tremble)];
///     sweep.update(&boxes, moved, |_, _| true, usize::MAX, &mut pairs)?;
///     assert_eq!(pairs.contains(&PairId { a: 0, b: 1 }), frame % 2 == 1);
/// }
/// # Ok::<(), asunder_broad::TooManyPairs>(())
/// ```
#[derive(Debug)]
pub struct LooseSweep<B> {
    sweep: CoherentSweep<B>,
    state: State,
    /// Frames for which boxes will be swept as they are, the next time that loose ones are given up.
    patience: u32,
    /// Loose boxes, or (in [`State::Noted`]) where boxes were.
    loose: Vec<B>,
    /// The margin of each around the box for which it was made, in metres.
    widths: Vec<f32>,
    /// Pairs of loose boxes.
    near: Vec<PairId>,
    /// Boxes that have left their loose ones.
    strays: Vec<u32>,
    /// Number of pairs at the last call.
    told: usize,
    /// What loose boxes have cost since all got new ones, in nanoseconds.
    spent: usize,
    /// Frames in a row in which boxes were loose, and few moved.
    still: u32,
}

asunder_geometry::copied!(LooseSweep<B>, for [B: Bounds], { sweep, state, patience, loose, widths, near, strays, told, spent, still } but {});

/// What is swept.
#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    /// Boxes as they are. Loose boxes are tried after so many more frames in which many boxes move.
    Boxes { frames: u32 },
    /// Boxes as they are; their positions are noted, to see how far they move in a frame.
    Noted,
    /// Loose boxes, made for all boxes so many frames ago.
    Loose { frames: usize },
}

/// What a frame's pairs are made from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Source {
    /// The pairs of loose boxes, which are up to date.
    Loose,
    /// A sweep of the boxes as they are.
    Boxes,
}

/// Cost of a sweep per box and per pair, in nanoseconds (AMD EPYC, Zen 4; roughly).
const SWEPT: [usize; 2] = [45, 3];

/// Nanoseconds to look up a box that has left its loose one.
const STRAY: usize = 300;

/// Nanoseconds to check one box, or to keep one pair.
const NEAR: usize = 3;

/// For how many frames at a box's current pace its loose box should last. Bodies that tremble turn back long before.
const PACE: f32 = 64.0;

/// The greatest margin, as a part of a box's least extent, or (of a plate or a needle) of a sixteenth of its greatest
/// extent.
const WIDEST: f32 = 0.125;

/// Frames in a row in which few boxes move until loose boxes are given up: keeping pairs at rest costs less than
/// testing the pairs of loose boxes.
const STILL: u32 = 8;

/// Least and most frames until loose boxes are tried again.
const PATIENCE: [u32; 2] = [2, 32];

impl<B: Bounds> Default for LooseSweep<B> {
    fn default() -> Self {
        Self::new()
    }
}

impl<B: Bounds> LooseSweep<B> {
    /// One that has seen no boxes yet.
    pub fn new() -> Self {
        Self {
            sweep: CoherentSweep::new(),
            state: State::Boxes { frames: PATIENCE[0] },
            patience: PATIENCE[0],
            loose: Vec::new(),
            widths: Vec::new(),
            near: Vec::new(),
            strays: Vec::new(),
            told: 0,
            spent: 0,
            still: 0,
        }
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
    ///
    /// `moved` is as for [`CoherentSweep::update`]. `admit` may be asked about boxes that do not quite overlap, and its
    /// answer is kept until one of the two has changed.
    ///
    /// # Errors
    /// More than `limit` admitted pairs. `pairs` is then empty, and the next call starts from here.
    pub fn update<C: Fn(u32) -> bool + Sync>(
        &mut self,
        boxes: &[B],
        moved: Moved<'_, C>,
        admit: impl Fn(u32, u32) -> bool + Sync,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        let admit: &Admit = &|pairs| keep(pairs, &admit);
        let outcome = match self.advance(boxes, &moved, admit) {
            Source::Loose => {
                tell(&self.near, boxes, pairs);
                if pairs.len() > limit { Err(TooManyPairs { limit }) } else { Ok(()) }
            }
            Source::Boxes => self.sweep.update_by(boxes, moved.places, admit, limit, pairs),
        };
        self.told = pairs.len();
        if outcome.is_err() {
            pairs.clear();
        }
        outcome
    }

    /// The columns of the last sweep of all boxes, as [`CoherentSweep::columns`] lists them.
    pub fn columns(&self) -> impl Iterator<Item = Column> {
        self.sweep.columns()
    }

    /// Memory that is held for the next call, in bytes: that of [`CoherentSweep::bytes`]; where most boxes move,
    /// another 32 per box and 8 per pair.
    pub fn bytes(&self) -> usize {
        self.sweep.bytes()
            + self.loose.capacity() * size_of::<B>()
            + (self.widths.capacity() + self.strays.capacity()) * 4
            + self.near.capacity() * size_of::<PairId>()
    }

    /// Moves on to this frame's state, and brings the pairs of loose boxes up to date where these are its source.
    fn advance<C: Fn(u32) -> bool + Sync>(
        &mut self,
        boxes: &[B],
        moved: &Moved<'_, C>,
        admit: &Admit,
    ) -> Source {
        let do_many = moved.places.len() * FEW > boxes.len();
        match self.state {
            State::Boxes { .. } | State::Noted if !do_many => Source::Boxes,
            State::Boxes { frames: 0 } => {
                self.note(boxes);
                Source::Boxes
            }
            State::Boxes { frames } => {
                self.state = State::Boxes { frames: frames - 1 };
                Source::Boxes
            }
            State::Noted if boxes.len() >= self.loose.len() => self.loosen_all(boxes, admit),
            State::Loose { frames } if boxes.len() >= self.loose.len() => {
                self.still = if do_many { 0 } else { self.still + 1 };
                if self.still > STILL {
                    // Keeping pairs at rest costs less now. Loose boxes have not failed, so `patience` stays.
                    self.sweep.forget();
                    self.state = State::Boxes { frames: self.patience };
                    return Source::Boxes;
                }
                self.find_strays(boxes, moved);
                self.keep_loose(boxes, frames, admit)
            }
            State::Noted | State::Loose { .. } => self.give_up_loose(),
        }
    }

    /// Looks up boxes that have left their loose ones, if these are few; otherwise makes new loose boxes for all if the
    /// last were worth it, and else gives them up.
    fn keep_loose(&mut self, boxes: &[B], frames: usize, admit: &Admit) -> Source {
        let (sweep, look) = (self.cost_of_sweep(), self.cost_of_look());
        let is_worn = !self.strays.is_empty() && self.sweep.is_worn(self.strays.len());
        if 2 * look <= sweep && !is_worn {
            // A frame in which few boxes move saved no sweep.
            self.state = State::Loose { frames: frames + usize::from(self.still == 0) };
            self.spent += look + NEAR * (boxes.len() + self.near.len());
            self.look_up_strays(boxes, admit)
        } else if 4 * self.spent <= 3 * frames * sweep {
            self.patience = PATIENCE[0];
            self.loosen_all(boxes, admit)
        } else {
            self.give_up_loose()
        }
    }

    /// Cost of sweeping the boxes, in nanoseconds.
    fn cost_of_sweep(&self) -> usize {
        SWEPT[0] * self.loose.len() + SWEPT[1] * self.told
    }

    /// Cost of looking up the boxes that have left their loose ones, in nanoseconds.
    fn cost_of_look(&self) -> usize {
        if self.strays.is_empty() {
            return 0;
        }
        // Assumes that each has as many pairs as the average.
        let pairs = self.near.len() / self.loose.len().max(1);
        (STRAY + NEAR * pairs) * (self.sweep.movers() + self.strays.len()) + NEAR * self.near.len()
    }

    /// Notes where boxes are, to see how far they move.
    fn note(&mut self, boxes: &[B]) {
        self.loose.clear();
        self.loose.extend_from_slice(boxes);
        self.widths.clear();
        self.widths.resize(boxes.len(), 0.0);
        self.state = State::Noted;
    }

    /// Makes loose boxes for all boxes, and sweeps these.
    fn loosen_all(&mut self, boxes: &[B], admit: &Admit) -> Source {
        self.loose.resize(boxes.len(), B::NOTHING);
        self.widths.resize(boxes.len(), 0.0);
        for (place, now) in boxes.iter().enumerate() {
            self.give(place, now);
        }
        self.state = State::Loose { frames: 0 };
        self.still = 0;
        let most = 2 * self.told + boxes.len();
        // With room for the next frames.
        self.strays.clear();
        self.strays.reserve(boxes.len());
        self.near.clear();
        self.near.reserve(self.told + self.told / 2);
        let is_known = self.sweep.sweep_all(&self.loose, true, admit, most, &mut self.near).is_ok();
        self.spent = SWEPT[0] * boxes.len() + SWEPT[1] * self.near.len();
        if is_known { Source::Loose } else { self.give_up_loose() }
    }

    /// Gives up loose boxes for some time: they cost too much.
    fn give_up_loose(&mut self) -> Source {
        self.sweep.forget();
        self.state = State::Boxes { frames: self.patience };
        self.patience = (2 * self.patience).min(PATIENCE[1]);
        Source::Boxes
    }

    /// Finds the boxes that have changed, are new, or have left their loose ones.
    fn find_strays<C: Fn(u32) -> bool + Sync>(&mut self, boxes: &[B], moved: &Moved<'_, C>) {
        let Self { loose, widths, strays, .. } = self;
        let is_stray = |place: u32| {
            let known = boxes.get(place as usize).zip(loose.get(place as usize));
            known.is_some_and(|(now, loose)| {
                (moved.has_changed)(place) || !(loose.encloses(now) && now.is_valid())
            })
        };
        strays.resize(moved.places.len(), 0);
        let left = sift(moved.places, strays, &is_stray);
        strays.truncate(left);
        for &place in strays.iter().filter(|&&place| (moved.has_changed)(place)) {
            loose[place as usize] = B::NOTHING;
        }
        strays.extend(loose.len() as u32..boxes.len() as u32);
        loose.resize(boxes.len(), B::NOTHING);
        widths.resize(boxes.len(), 0.0);
    }

    /// Makes new loose boxes for the few that have left theirs, and looks these up.
    fn look_up_strays(&mut self, boxes: &[B], admit: &Admit) -> Source {
        if self.strays.is_empty() {
            return Source::Loose;
        }
        let strays = core::mem::take(&mut self.strays);
        for &place in &strays {
            self.give(place as usize, &boxes[place as usize]);
        }
        let most = 2 * self.told + boxes.len();
        let is_known = self.sweep.update_by(&self.loose, &strays, admit, most, &mut self.near).is_ok();
        self.strays = strays;
        if is_known { Source::Loose } else { self.give_up_loose() }
    }

    /// Makes a loose box for a box, unless it is still inside its old one.
    fn give(&mut self, place: usize, now: &B) {
        let had = self.loose[place];
        if self.widths[place] > 0.0 && had.encloses(now) && now.is_valid() {
            return;
        }
        let width = width_of(now, &had, self.widths[place]);
        self.widths[place] = width;
        self.loose[place] = now.widened(width);
    }
}

/// The margin for a new loose box, from the old one and its margin.
fn width_of<B: Bounds>(now: &B, had: &B, width: f32) -> f32 {
    if !now.is_valid() || !had.is_valid() {
        return 0.0;
    }
    let (mut way, mut least, mut greatest) = (0.0_f32, f32::INFINITY, 0.0_f32);
    for axis in 0..B::AXES {
        let ((low, high), (from, to)) = (now.interval(axis), had.interval(axis));
        way = way.max((low - (from + width)).abs()).max((high - (to - width)).abs());
        (least, greatest) = (least.min(high - low), greatest.max(high - low));
    }
    let wanted = if width == 0.0 { PACE * way } else { 2.0 * width.max(way) };
    let wanted = wanted.min(WIDEST * least.max(greatest / 16.0));
    if wanted.is_finite() { wanted } else { 0.0 }
}

/// Replaces `pairs` by the pairs of `near` whose boxes overlap.
fn tell<B: Bounds>(near: &[PairId], boxes: &[B], pairs: &mut Vec<PairId>) {
    // What is there already is overwritten.
    if pairs.len() < near.len() {
        pairs.resize(near.len(), PairId { a: 0, b: 0 });
    }
    let do_overlap = |pair: PairId| boxes[pair.a as usize].overlaps_valid(&boxes[pair.b as usize]);
    let told = sift(near, &mut pairs[..near.len()], &do_overlap);
    pairs.truncate(told);
}
