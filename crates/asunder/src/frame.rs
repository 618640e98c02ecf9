//! One frame.
//!
//! # The determinism contract, stage by stage
//! Equal operations give bit-equal outputs: at any thread count, in debug and in release.
//! 1. **refit**: a box is a function of its body alone.
//! 2. **sweep**: the pair list is a function of boxes and filters alone, sorted by pair, whatever is kept between
//!    updates.
//! 3. **collide**: an answer is a function of one job. Chunks of pairs are cut by counts, or where they were cut last
//!    time, never by thread, and are put together in order. A hint can save work, and choose among features that are
//!    equally good up to rounding. Where the bodies hardly drifted since their manifold was made, it is moved along,
//!    within its error. Where neither body moved, or they were further apart than they have moved since, the answer is
//!    last update's. Last update's answers are found by walking two lists sorted by pair, side by side.
//! 4. **merge**: the chunks' results, in their order.
//! 5. **report**: events in pair order.
//!
//! Hooks are called by one thread, in pair order: the pair hook after the sweep, the contact hook after the report.
//! What bullets run into comes last: a function of one pair and of what the bullet touches, sorted.
//!
//! No stage walks a hash map, calls std's trigonometry or fuses a multiplication with an addition.

mod chunk;
mod collide;
mod impacts;
mod merge;
mod refit;
mod report;
mod settle;
mod sweep;
mod touches;

pub(crate) use chunk::manifolds_at;
pub(crate) use impacts::TimedHit;
pub(crate) use settle::Settled;
pub(crate) use touches::Touches;

use crate::clock::Moment;
use crate::hooks::{Hooks, edit_contacts};
use crate::space::Space;
use crate::stats::Stats;
use crate::world::World;
use core::time::Duration;

impl<S: Space> World<S> {
    /// Brings contacts, candidates and events up to date with the bodies. It cannot fail.
    ///
    /// Cost:
    /// - Boxes: linear in the bodies that moved.
    /// - Sweep: linear in the bodies that moved and in the candidates if few bodies move, else in all bodies and
    ///   candidates (see [`Sweep`](asunder_broad::Sweep)).
    /// - Narrow phase: every candidate with a body that moved, except those whose bodies were further apart than they
    ///   have moved since. While two bodies move against each other by no more than 2^-15 of the smaller bounding
    ///   radius (2^-10 where they rest on a broad patch, up to 2^-8 on ground), their contact is moved along for a
    ///   fraction of the cost of a new one.
    pub fn update(&mut self) {
        self.update_with(&Hooks::new());
    }

    /// Like [`update`](Self::update), but calls these hooks to decide which bodies may pair and to edit contacts.
    ///
    /// They are called in pair order, by one thread. For equal worlds to have equal futures, their answers must be a
    /// function of their arguments alone.
    ///
    /// Cost: for [`Hooks::pair`], a call per candidate; for [`Hooks::contact`], a call per contact and a copy of its
    /// manifolds.
    pub fn update_with(&mut self, hooks: &Hooks<'_, S>) {
        S::advance(self, hooks);
    }

    fn timed(&mut self, stage: impl FnOnce(&mut Self)) -> Duration {
        let start = Moment::now();
        stage(self);
        start.elapsed()
    }
}

/// The stages, one after the other.
pub(crate) fn advance<S: Space>(world: &mut World<S>, hooks: &Hooks<'_, S>) {
    let Stats { candidates, contacts, overlapping, manifolds, .. } = world.stats;
    // If a hook panics, last update's events and impacts must not pass for this one's. Candidates and contacts stay,
    // and so do their counts.
    world.events.clear();
    world.impacts.clear();
    world.mark_kept_motions();
    let bodies = world.bodies.len();
    world.stats = Stats { bodies, candidates, contacts, overlapping, manifolds, ..Stats::default() };
    world.stats.refit = world.timed(refit::refit);
    world.stats.sweep = world.timed(|world| sweep::sweep(world, hooks));
    world.stats.collide = world.timed(collide::collide);
    world.stats.merge = world.timed(merge::merge);
    world.stats.report = world.timed(report::report);
    world.stats.hooks = world.timed(|world| edit_contacts(world, hooks));
    world.stats.impacts = world.timed(impacts::impacts);
}

/// Runs both closures, on two threads if possible.
fn join(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(one, other);
    #[cfg(not(feature = "parallel"))]
    {
        one();
        other();
    }
}
