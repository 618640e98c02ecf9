//! Stage 1: moved poses to boxes, rounded outwards.

use super::join;
use crate::motion::swept_bounds;
use crate::space::Space;
use crate::world::World;
use slotmap::Key;

/// Below this many bodies, handing them to other threads costs more than it saves.
#[cfg(feature = "parallel")]
const MIN_PARALLEL: usize = 1024;

/// Most boxes that a thread makes in one go: a thread that was asleep comes late, and takes what is left. With 1,024 at
/// once, 8,005 boxes took two threads 0.17 ms for 0.15 (AMD EPYC, Zen 4, 2026-11-26).
#[cfg(feature = "parallel")]
const AT_ONCE: usize = 256;

/// Makes the boxes of all bodies that moved or were inserted since the last update. Those of removed or disabled bodies
/// are empty.
pub(super) fn refit<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, boxes, dirty, is_dirty, moved, is_moved, motions, stats, .. } = world;
    stats.moved = dirty.iter().filter(|&&slot| !keys[slot as usize].is_null()).count();
    let bounds = |slot: u32| {
        let body = bodies.get(keys[slot as usize]).filter(|body| !body.disabled);
        match (body, motions.of(slot)) {
            (None, _) => asunder_geometry::Bounds::NOTHING,
            (Some(body), None) => S::bounds(&body.shape, &body.pose, body.margin),
            (Some(body), Some(motion)) => swept_bounds(body, &motion),
        }
    };
    let share = share_of(dirty.len());
    if share < dirty.len() {
        dirty.sort_unstable();
    }
    make(dirty, (0, boxes), share, &bounds);
    for &slot in &*dirty {
        let index = slot as usize;
        is_dirty[index] = false;
        // After an update that overflowed it may still be in the list.
        if !core::mem::replace(&mut is_moved[index], true) {
            moved.push(slot);
        }
    }
    dirty.clear();
}

/// How many of `count` slots one thread processes in one go.
fn share_of(count: usize) -> usize {
    #[cfg(feature = "parallel")]
    if count >= MIN_PARALLEL && rayon::current_num_threads() > 1 {
        return AT_ONCE;
    }
    count
}

/// Makes the boxes of some slots; `boxes` begins with that of the slot `first`. More slots than one share must ascend,
/// and are split in halves, each on a thread.
fn make<A: Send>(
    slots: &[u32],
    (first, boxes): (usize, &mut [A]),
    share: usize,
    bounds: &(impl Fn(u32) -> A + Sync),
) {
    if slots.len() > share {
        let (low, high) = slots.split_at(slots.len() / 2);
        let middle = high[0] as usize;
        let (boxes_low, boxes_high) = boxes.split_at_mut(middle - first);
        return join(
            || make(low, (first, boxes_low), share, bounds),
            || make(high, (middle, boxes_high), share, bounds),
        );
    }
    for &slot in slots {
        boxes[slot as usize - first] = bounds(slot);
    }
}
