//! Stage 1: moved poses to boxes, rounded outwards.

use crate::motion::swept_bounds;
use crate::space::Space;
use crate::world::World;
use slotmap::Key;

/// Below this many bodies, handing them to other threads costs more than it saves.
#[cfg(feature = "parallel")]
const MIN_PARALLEL: usize = 1024;

/// Makes the boxes of all bodies that moved, or came, since the last update; those of bodies that went, or are
/// disabled, are empty sets.
pub(super) fn refit<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, boxes, dirty, is_dirty, moved, is_moved, motions, stats, scratch, .. } = world;
    stats.moved = dirty.iter().filter(|&&slot| !keys[slot as usize].is_null()).count();
    let bounds = |&slot: &u32| {
        let body = bodies.get(keys[slot as usize]).filter(|body| !body.disabled);
        match (body, motions.of(slot)) {
            (None, _) => asunder_geometry::Bounds::NOTHING,
            (Some(body), None) => S::bounds(&body.shape, &body.pose, body.margin),
            (Some(body), Some(motion)) => swept_bounds(body, &motion),
        }
    };
    scratch.refitted.clear();
    #[cfg(feature = "parallel")]
    if dirty.len() >= MIN_PARALLEL {
        use rayon::prelude::*;
        dirty.par_iter().map(bounds).collect_into_vec(&mut scratch.refitted);
    }
    if scratch.refitted.is_empty() {
        scratch.refitted.extend(dirty.iter().map(bounds));
    }
    for (&slot, &refitted) in dirty.iter().zip(&scratch.refitted) {
        let index = slot as usize;
        boxes[index] = refitted;
        is_dirty[index] = false;
        // After an update that overflowed it may stand there still.
        if !core::mem::replace(&mut is_moved[index], true) {
            moved.push(slot);
        }
    }
    dirty.clear();
}
