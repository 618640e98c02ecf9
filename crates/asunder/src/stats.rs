//! Times and counts of the last update.

use core::time::Duration;

/// The time of each stage of the last update, and counts. Times are wall-clock times, zero on platforms without a
/// clock; everything else is deterministic.
///
/// ```
/// use asunder::World3;
/// let mut world = World3::new();
/// world.update();
/// assert_eq!((world.stats().bodies, world.stats().candidates), (0, 0));
/// let stats = world.stats();
/// let stages = [stats.refit, stats.sweep, stats.collide, stats.merge, stats.report, stats.hooks, stats.impacts];
/// assert!(stats.total() == stages.iter().sum() && !stats.total().is_zero());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Stage 1: poses to boxes.
    pub refit: Duration,
    /// Stage 2: boxes to candidate pairs.
    pub sweep: Duration,
    /// Stage 3: candidate pairs to contacts, matched with the last update's.
    pub collide: Duration,
    /// Stage 4: the results of all threads, merged.
    pub merge: Duration,
    /// Stage 5: events, and the index by body.
    pub report: Duration,
    /// After stage 5: the contact hook; zero without one.
    pub hooks: Duration,
    /// After the hook: impacts of bullets; zero without motions.
    pub impacts: Duration,
    /// Bodies in the world.
    pub bodies: usize,
    /// Bodies whose box was recomputed.
    pub moved: usize,
    /// Pairs whose boxes overlap and whose filters agree.
    pub candidates: usize,
    /// Pairs within their margins, and speculative ones.
    pub contacts: usize,
    /// Pairs that share a point.
    pub overlapping: usize,
    /// Manifolds of all contacts.
    pub manifolds: usize,
    /// Whether there were more candidates than [`World::set_max_pairs`](crate::World::set_max_pairs) allows. Contacts
    /// are then those of the update before, there are no events and no impacts, and this frame's motions are forgotten.
    pub overflow: bool,
}

impl Stats {
    /// The total time of all stages.
    pub fn total(&self) -> Duration {
        self.refit + self.sweep + self.collide + self.merge + self.hooks + self.impacts + self.report
    }
}
