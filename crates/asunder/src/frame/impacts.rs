//! After the contacts: the impacts of bullets during their motions.
//!
//! ```text
//! for each candidate pair with a bullet, and a motion: when do they first touch?     in parallel
//! sort by bullet, then by time; cut each bullet's list after the first that is solid
//! ```
//! Parts that overlap at the start are a contact already. The other parts of such bodies are tested, and those flush
//! with what the bullet touches are passed over (`next_impact_beside`).

use super::touches::Touches;
use crate::motion::Hit;
use crate::space::{RunsInto, Space};
use crate::world::{Scratch, World, slot_of};
use core::cmp::Ordering;

/// Below this many pairs, other threads cost more than they save.
#[cfg(feature = "parallel")]
const MIN_PARALLEL: usize = 64;

/// One impact, with what impacts are sorted by.
pub(crate) struct TimedHit<S: Space> {
    bullet_slot: u32,
    /// The time of impact, as a fraction of the motions.
    fraction: f64,
    other_slot: u32,
    /// What is reported.
    hit: Hit<S::Key, S::Impact>,
}

impl<S: Space> TimedHit<S> {
    fn by_bullet_and_time(&self, other: &Self) -> Ordering {
        (self.bullet_slot.cmp(&other.bullet_slot))
            .then(self.fraction.total_cmp(&other.fraction))
            .then(self.other_slot.cmp(&other.other_slot))
    }
}

/// Brings the impacts up to date, and forgets the motions.
pub(super) fn impacts<S: Space>(world: &mut World<S>) {
    if !world.motions.is_empty() && !world.stats.overflow {
        time_hits(world);
        let World { impacts, scratch, .. } = world;
        scratch.timed_hits.sort_unstable_by(TimedHit::by_bullet_and_time);
        let mut stopped = None;
        for TimedHit { bullet_slot, hit, .. } in &scratch.timed_hits {
            if stopped != Some(bullet_slot) {
                impacts.push(*hit);
            }
            if !hit.sensor {
                stopped = Some(bullet_slot);
            }
        }
    }
    world.forget_motions();
}

/// Computes the impact of every pair with a bullet. The pairs were noted by the collide stage, the only one that reads
/// all candidates.
fn time_hits<S: Space>(world: &mut World<S>) {
    let Scratch { settled, of_bullets, .. } = &mut world.scratch;
    of_bullets.clear();
    settled.iter_mut().for_each(|settled| of_bullets.append(&mut settled.bullets));
    of_bullets.sort_unstable_by_key(|&(bullet, other)| (slot_of(bullet), slot_of(other)));
    Touches::gather(world);
    let World { bodies, motions, scratch, .. } = world;
    let touches = &scratch.touches;
    let impact = |&(bullet, other): &(S::Key, S::Key)| {
        let (bullet_slot, other_slot) = (slot_of(bullet), slot_of(other));
        let (one, two) = bodies.get(bullet).zip(bodies.get(other))?;
        let posed = [(&one.shape, &one.pose), (&two.shape, &two.pose)];
        let sensor = one.sensor || two.sensor;
        let runs_into = if sensor { RunsInto::Sensor } else { RunsInto::Solid(touches.of(bullet_slot)) };
        let (fraction, impact) =
            S::impact(posed, runs_into, [motions.of(bullet_slot), motions.of(other_slot)])?;
        let hit = Hit { bullet, other, sensor, impact };
        Some(TimedHit { bullet_slot, fraction, other_slot, hit })
    };
    scratch.timed_hits.clear();
    #[cfg(feature = "parallel")]
    if scratch.of_bullets.len() >= MIN_PARALLEL {
        use rayon::prelude::*;
        scratch.of_bullets.par_iter().map(impact).collect_into_vec(&mut scratch.impacts);
        scratch.timed_hits.extend(scratch.impacts.drain(..).flatten());
        return;
    }
    scratch.timed_hits.extend(scratch.of_bullets.iter().filter_map(impact));
}
