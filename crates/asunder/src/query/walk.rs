//! From boxes to answers: the best, all, or a visitor for each.

use super::answer::{Met, Ranked};
use super::filter::Filter;
use super::space::Asked;
use crate::collider::Collider;
use crate::space::Space;
use crate::world::{World, slot_of};
use asunder_broad::{Cast, Index, Queue, least_distance};
use asunder_geometry::Bounds;
use core::cell::Cell;
use core::ops::ControlFlow;
use std::thread::LocalKey;

/// Which boxes a query is about.
pub(crate) enum Reach<B> {
    /// Those that overlap a box.
    Over(B),
    /// Those that a ray or a moved box crosses.
    Along(Cast),
    /// Those near a box.
    Around(B),
}

thread_local! {
    /// Working memory of this thread's queries. A query within a query finds it taken, and gets its own.
    static QUEUE: Cell<Queue> = Cell::new(Queue::new());
}

/// Lends the memory that a thread keeps from one query to the next.
pub(super) fn with_kept<T: Default, R>(
    place: &'static LocalKey<Cell<T>>,
    ask: impl FnOnce(&mut T) -> R,
) -> R {
    // A thread that is about to end has dropped it.
    let mut kept = place.try_with(Cell::take).unwrap_or_default();
    let answer = ask(&mut kept);
    let _ = place.try_with(|place| place.set(kept));
    answer
}

impl<B: Bounds> Reach<B> {
    /// A lower bound on the distance at which a box is met, if it is within the limit.
    fn meets(&self, bounds: &B, limit: f64) -> Option<f64> {
        match self {
            Self::Over(this) => this.overlaps(bounds).then_some(0.0),
            Self::Along(cast) => cast.meets(bounds, limit),
            Self::Around(this) => least_distance(this, bounds).filter(|&distance| distance <= limit),
        }
    }

    /// Visits all boxes within the limit, until the visitor breaks off.
    fn visit(
        &self,
        index: &Index<B>,
        limit: f64,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        match self {
            Self::Over(this) => index.visit_overlapping(this, visitor),
            Self::Along(cast) => index.visit_crossed(cast, limit, |found| visitor(found.number)),
            Self::Around(_) => {
                let mut flow = ControlFlow::Continue(());
                self.in_order(index, limit, |number| {
                    flow = visitor(number);
                    if flow.is_break() { -1.0 } else { limit }
                });
                flow
            }
        }
    }

    /// Visits boxes, nearest first; what the visitor returns is the limit from then on.
    fn in_order(&self, index: &Index<B>, limit: f64, mut visitor: impl FnMut(u32) -> f64) {
        match self {
            // All are equally near.
            Self::Over(this) => {
                let _ = index.visit_overlapping(this, |number| {
                    if visitor(number) < 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                });
            }
            Self::Along(cast) => with_kept(&QUEUE, |queue| {
                index.crossed_in_order(cast, limit, queue, |found| visitor(found.number))
            }),
            Self::Around(this) => with_kept(&QUEUE, |queue| {
                index.nearest_in_order(this, limit, queue, |found| visitor(found.number))
            }),
        }
    }
}

/// A visitor of slots.
pub(crate) type Look<'l> = dyn FnMut(u32) -> ControlFlow<()> + 'l;

/// Visits the slots of all bodies whose boxes are within reach, until the visitor breaks off. Implements
/// [`Asked::visit_slots`].
pub(super) fn visit_slots<S: Space>(
    world: &World<S>,
    (reach, limit): (&Reach<S::Aabb>, f64),
    look: &mut Look,
) -> ControlFlow<()> {
    let sight = world.sight();
    for (slot, bounds) in sight.recent() {
        if reach.meets(bounds, limit).is_some() {
            look(slot)?;
        }
    }
    for branch in sight.trees() {
        reach.visit(branch.tree, limit, |number| match branch.slot(number) {
            Some(slot) => look(slot),
            None => ControlFlow::Continue(()),
        })?;
    }
    ControlFlow::Continue(())
}

/// The narrow phase's answer for a body, if there is one.
pub(crate) trait Asks<S: Space, A>: Fn(S::Key, &Collider<S>) -> Option<A> {}

impl<S: Space, A, F: Fn(S::Key, &Collider<S>) -> Option<A>> Asks<S, A> for F {}

/// A query about all bodies that a filter admits.
pub(crate) struct Question<'q, S: Space, F> {
    pub(super) world: &'q World<S>,
    pub(super) filter: &'q Filter<'q, S>,
    pub(super) reach: Reach<S::Aabb>,
    /// Makes the box around a body by which its answer is decided, except for answers with a compound's part.
    pub(super) bounds_of: fn(&S::Shape, &S::Pose) -> S::Aabb,
    /// Answers beyond it do not count.
    pub(super) limit: f64,
    pub(super) ask: F,
}

impl<S: Asked, A: Ranked, F: Fn(S::Key, &Collider<S>) -> Option<A>> Question<'_, S, F> {
    /// The answer of a body, if it is within the limit, which may have shrunk by now. A box around the body was met
    /// already; the box that decides is tested after the narrow phase, which rejects more bodies.
    fn answer(&self, slot: u32, limit: f64) -> Option<A> {
        let key = *self.world.keys.get(slot as usize)?;
        let body = self.world.bodies.get(key).filter(|body| self.filter.admits(key, body))?;
        if !self.filter.agrees(key, body) {
            return None;
        }
        let mut answer = (self.ask)(key, body).filter(|answer| answer.rank().0 <= limit)?;
        let bound = match answer.part().and_then(|part| S::part_bounds(&body.shape, &body.pose, part)) {
            Some(of_part) => self.bound_of_compound(body, &of_part, (answer.rank().0, limit))?,
            None => self.reach.meets(&(self.bounds_of)(&body.shape, &body.pose), limit)?,
        };
        if answer.rank().0 < bound {
            answer.put_at(bound);
        }
        (answer.rank().0 <= limit).then_some(answer)
    }

    /// The least distance of an answer with a compound: where the compound's own box is met. A larger box would not do,
    /// since trees store this one or a larger one. It is not computed where the box of the part that was met, which
    /// lies inside it, is no further than the answer.
    fn bound_of_compound(
        &self,
        body: &Collider<S>,
        of_part: &S::Aabb,
        (rank, limit): (f64, f64),
    ) -> Option<f64> {
        let met = self.reach.meets(of_part, limit).filter(|&met| met <= rank);
        met.or_else(|| self.reach.meets(&S::bounds(&body.shape, &body.pose, 0.0), limit))
    }

    /// The answer of the least rank.
    ///
    /// Each body may lower the limit, so that trees are walked no further than necessary.
    pub(crate) fn first(&self) -> Option<A> {
        let (mut best, mut limit) = (None::<A>, self.limit);
        let mut look = |slot: u32| {
            let found = self.answer(slot, limit);
            if let Some(found) =
                found.filter(|found| best.as_ref().is_none_or(|best| found.rank() < best.rank()))
            {
                limit = limit.min(found.rank().0);
                best = Some(found);
            }
            limit
        };
        let sight = self.world.sight();
        let mut limit = self.limit;
        for (slot, bounds) in sight.recent() {
            if self.reach.meets(bounds, limit).is_some() {
                limit = look(slot);
            }
        }
        for branch in sight.trees() {
            let start = limit;
            self.reach.in_order(branch.tree, start, |number| {
                if let Some(slot) = branch.slot(number) {
                    limit = look(slot);
                }
                limit
            });
        }
        best
    }

    /// Visits all answers, in no promised order, until the visitor breaks off.
    pub(crate) fn visit(&self, mut visitor: impl FnMut(A) -> ControlFlow<()>) -> ControlFlow<()> {
        let mut look = |slot| match self.answer(slot, self.limit) {
            Some(answer) => visitor(answer),
            None => ControlFlow::Continue(()),
        };
        S::visit_slots(self.world, (&self.reach, self.limit), &mut look)
    }

    /// Replaces `into` by all answers, by their rank.
    pub(crate) fn all(&self, into: &mut Vec<A>) {
        into.clear();
        let _ = self.visit(|answer| {
            into.push(answer);
            ControlFlow::Continue(())
        });
        into.sort_unstable_by(|a, b| {
            let ((one, slot), (other, other_slot)) = (a.rank(), b.rank());
            one.total_cmp(&other).then(slot.cmp(&other_slot))
        });
    }
}

impl<S: Asked, F: Fn(S::Key, &Collider<S>) -> Option<Met<S::Key>>> Question<'_, S, F> {
    /// Replaces `into` by the bodies found, by their slots.
    pub(crate) fn keys(&self, into: &mut Vec<S::Key>) {
        into.clear();
        let _ = self.visit(|Met(key)| {
            into.push(key);
            ControlFlow::Continue(())
        });
        into.sort_unstable_by_key(|&key| slot_of(key));
    }
}
