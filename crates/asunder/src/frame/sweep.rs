//! Stage 2: boxes to candidate pairs.

use crate::space::Space;
use crate::world::World;

/// Finds the pairs of bodies whose boxes overlap and that may meet at all.
pub(super) fn sweep<S: Space>(world: &mut World<S>) {
    let World { bodies, keys, boxes, max_pairs, stats, scratch, .. } = world;
    let admit = |a: u32, b: u32| {
        let body = |slot: u32| bodies.get(keys[slot as usize]);
        body(a).zip(body(b)).is_some_and(|(a, b)| a.may_meet(b))
    };
    let outcome = scratch.sweep.pairs(boxes, admit, *max_pairs, &mut scratch.pairs);
    stats.overflow = outcome.is_err();
}
