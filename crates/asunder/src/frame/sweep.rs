//! Stage 2: boxes to candidate pairs.

use crate::hooks::{Hooks, refuse_pairs};
use crate::space::Space;
use crate::world::World;
use asunder_broad::Moved;

/// Finds the pairs whose boxes overlap and whose filters agree.
pub(super) fn sweep<S: Space>(world: &mut World<S>, hooks: &Hooks<'_, S>) {
    let World { boxes, tags, odometers, moved, max_pairs, stats, scratch, .. } = world;
    let admit = |a: u32, b: u32| tags[a as usize].may_meet(&tags[b as usize]);
    let has_changed = |slot: u32| odometers[slot as usize].has_changed();
    let moved = Moved { places: moved, has_changed };
    let outcome = scratch.sweep.update(boxes, moved, admit, *max_pairs, &mut scratch.pairs);
    stats.overflow = outcome.is_err();
    refuse_pairs(world, hooks);
}
