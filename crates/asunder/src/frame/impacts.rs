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

/// Below this many pairs, other threads cost more than they save.
#[cfg(feature = "parallel")]
const MIN_PARALLEL: usize = 64;

/// One impact: the bullet's slot, the fraction of its motion, the other's slot; and what is reported.
pub(crate) type Found<S> = (u32, f64, u32, Hit<<S as Space>::Key, <S as Space>::Impact>);

/// Brings the impacts up to date, and forgets the motions.
pub(super) fn impacts<S: Space>(world: &mut World<S>) {
    if !world.motions.is_empty() && !world.stats.overflow {
        ask(world);
        let World { impacts, scratch, .. } = world;
        scratch.found.sort_unstable_by(|one, other| {
            (one.0.cmp(&other.0)).then(one.1.total_cmp(&other.1)).then(one.2.cmp(&other.2))
        });
        let mut stopped = None;
        for (bullet, _, _, hit) in &scratch.found {
            if stopped != Some(bullet) {
                impacts.push(*hit);
            }
            if !hit.sensor {
                stopped = Some(bullet);
            }
        }
    }
    world.forget_motions();
}

/// Computes the impact of every pair with a bullet. The pairs were noted by the collide stage, the only one that reads
/// all candidates.
fn ask<S: Space>(world: &mut World<S>) {
    let Scratch { settled, of_bullets, .. } = &mut world.scratch;
    of_bullets.clear();
    settled.iter_mut().for_each(|settled| of_bullets.append(&mut settled.bullets));
    of_bullets.sort_unstable_by_key(|&(bullet, other)| (slot_of(bullet), slot_of(other)));
    Touches::gather(world);
    let World { bodies, motions, scratch, .. } = world;
    let touches = &scratch.touches;
    let impact = |&(bullet, other): &(S::Key, S::Key)| {
        let (slot, other_slot) = (slot_of(bullet), slot_of(other));
        let (one, two) = bodies.get(bullet).zip(bodies.get(other))?;
        let posed = [(&one.shape, &one.pose), (&two.shape, &two.pose)];
        let sensor = one.sensor || two.sensor;
        let runs_into = if sensor { RunsInto::Sensor } else { RunsInto::Solid(touches.of(slot)) };
        let (fraction, impact) = S::impact(posed, runs_into, [motions.of(slot), motions.of(other_slot)])?;
        let hit = Hit { bullet, other, sensor, impact };
        Some((slot, fraction, other_slot, hit))
    };
    scratch.found.clear();
    #[cfg(feature = "parallel")]
    if scratch.of_bullets.len() >= MIN_PARALLEL {
        use rayon::prelude::*;
        scratch.of_bullets.par_iter().map(impact).collect_into_vec(&mut scratch.impacts);
        scratch.found.extend(scratch.impacts.drain(..).flatten());
        return;
    }
    scratch.found.extend(scratch.of_bullets.iter().filter_map(impact));
}
