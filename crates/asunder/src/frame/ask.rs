//! Asks the narrow phase about pairs, in batches.
//!
//! ```text
//! for each batch, in parallel:
//!   a pair whose bodies hardly drifted since its manifold was made: the manifold is moved along
//!   else: it is asked about
//! ```

use crate::collider::Collider;
use crate::contact::Place;
use crate::motion::{Motions, approach};
use crate::slab::Slab;
use crate::space::Space;
use crate::world::World;
use asunder_broad::PairId;
use asunder_narrow::{Answer, ArrayVec, Batch, Hint};
use slotmap::SlotMap;

/// Pairs in one batch. Fixed, so that where batches are cut does not depend on the threads.
const BATCH: usize = 256;

/// Jobs handed to the narrow phase at once: enough to fill wide kernels, few enough to stay on the stack.
const SLICE: usize = 64;

/// A pair to be asked about, and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    pub(crate) pair: PairId,
    pub(crate) hint: Hint,
    /// Which of last update's persistent manifolds is its own; [`NOWHERE`](crate::slab::NOWHERE) without.
    pub(crate) persistent: u32,
}

/// What came of a pair.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// An answer.
    Answered,
    /// Its manifold was moved along.
    Moved(Moved),
}

/// What came of a pair whose manifold was moved along, with what is told of its bodies: they have just been read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    /// The first of its manifolds in the batch.
    at: u32,
    /// How many they are: no more than a part of a body has on ground.
    count: u8,
    pub(super) overlapping: bool,
    pub(super) user_data: (u64, u64),
}

/// What came of the pairs of a batch, each list in their order; manifolds in the order in which they were made.
#[derive(Clone, Debug)]
pub(crate) struct Asking<S: Space> {
    ways: Vec<Way>,
    answered: Batch<S::Manifold>,
}

impl<S: Space> Default for Asking<S> {
    fn default() -> Self {
        Self { ways: Vec::new(), answered: Batch::default() }
    }
}

impl<S: Space> Asking<S> {
    fn clear(&mut self) {
        self.ways.clear();
        self.answered.clear();
    }
}

/// The manifolds that stand in a place.
#[inline]
pub(crate) fn manifolds_at<'a, S: Space>(
    place: &Place,
    askings: &'a [Asking<S>],
    carried: &'a [S::Manifold],
) -> &'a [S::Manifold] {
    let list = askings.get(place.batch as usize).map_or(carried, |asking| &*asking.answered.manifolds);
    &list[place.range.start as usize..place.range.end as usize]
}

/// Asks about all pairs that were chosen.
pub(super) fn ask<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, motions, persistent, askings, scratch, .. } = world;
    let asked = &*scratch.asked;
    let batch_count = asked.len().div_ceil(BATCH);
    if askings.len() < batch_count {
        askings.resize_with(batch_count, Asking::default);
    }
    let (askings, spare) = askings.split_at_mut(batch_count);
    spare.iter_mut().for_each(Asking::clear);
    let asker = Asker { bodies, keys, motions, persistent };
    #[cfg(feature = "parallel")]
    if batch_count > 1 {
        use rayon::prelude::*;
        let both = asked.par_chunks(BATCH).zip(askings.par_iter_mut());
        both.for_each(|(asked, asking)| asker.ask(asked, asking));
        return;
    }
    asked.chunks(BATCH).zip(askings).for_each(|(asked, asking)| asker.ask(asked, asking));
}

/// What a batch needs to know, shared by all threads.
struct Asker<'a, S: Space> {
    bodies: &'a SlotMap<S::Key, Collider<S>>,
    keys: &'a [S::Key],
    motions: &'a Motions<S>,
    persistent: &'a Slab<S::Persistent>,
}

impl<S: Space> Asker<'_, S> {
    /// Answers the pairs of one batch.
    fn ask(&self, asked: &[Asked], asking: &mut Asking<S>) {
        asking.clear();
        for slice in asked.chunks(SLICE) {
            let mut jobs: ArrayVec<S::Job<'_>, SLICE> = ArrayVec::new();
            for asked in slice {
                let Asked { pair, hint, persistent } = *asked;
                let body = |slot: u32| self.bodies.get(self.keys[slot as usize]);
                let (Some(a), Some(b)) = (body(pair.a), body(pair.b)) else { continue };
                let margin = a.margin + b.margin + self.approach(pair, [a, b]);
                let persistent = self.persistent.get(persistent);
                let at = asking.answered.manifolds.len() as u32;
                let to = &mut asking.answered.manifolds;
                match persistent.and_then(|persistent| S::carry_on(persistent, [a, b], margin, to)) {
                    Some(overlapping) => {
                        let user_data = (a.user_data, b.user_data);
                        let count = (to.len() as u32 - at) as u8;
                        asking.ways.push(Way::Moved(Moved { at, count, overlapping, user_data }));
                    }
                    None => {
                        asking.ways.push(Way::Answered);
                        jobs.push(S::job(a, b, margin, hint));
                    }
                }
            }
            S::collide(&jobs, &mut asking.answered);
        }
    }

    /// By how much the bodies' motions may bring them nearer. A sensor looks no further than it reaches.
    #[inline]
    fn approach(&self, pair: PairId, bodies: [&Collider<S>; 2]) -> f32 {
        if self.motions.is_empty() || bodies[0].sensor || bodies[1].sensor {
            return 0.0;
        }
        approach(bodies, [self.motions.of(pair.a), self.motions.of(pair.b)])
    }
}

/// What came of one pair.
pub(super) enum Outcome<'a, S: Space> {
    /// An answer, and the manifolds that it is about.
    Answered(&'a Answer, &'a [S::Manifold]),
    /// Last update's manifold, moved along.
    Moved(Moved),
}

/// The outcomes of all batches, one after the other.
pub(super) struct Outcomes<'a, S: Space> {
    askings: &'a [Asking<S>],
    batch: usize,
    /// The next of each of the batch's lists.
    way: usize,
    answer: usize,
}

impl<'a, S: Space> Outcomes<'a, S> {
    pub(super) fn new(askings: &'a [Asking<S>]) -> Self {
        Self { askings, batch: 0, way: 0, answer: 0 }
    }

    /// The next outcome, and where its manifolds stand.
    #[inline]
    pub(super) fn next(&mut self) -> Option<(Outcome<'a, S>, Place)> {
        loop {
            let asking = self.askings.get(self.batch)?;
            let batch = self.batch as u32;
            let Some(way) = asking.ways.get(self.way) else {
                *self = Self { batch: self.batch + 1, ..Self::new(self.askings) };
                continue;
            };
            self.way += 1;
            if let Way::Moved(moved) = *way {
                let range = moved.at..moved.at + u32::from(moved.count);
                return Some((Outcome::Moved(moved), Place { batch, range }));
            }
            let answer = asking.answered.answers.get(self.answer)?;
            self.answer += 1;
            let place = match answer {
                Answer::Apart { .. } => Place::NOWHERE,
                Answer::Contact { manifolds, .. } => Place { batch, range: manifolds.clone() },
            };
            return Some((Outcome::Answered(answer, &asking.answered.manifolds), place));
        }
    }
}
