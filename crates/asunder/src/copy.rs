//! A world as it is, once more: what a clone has, and what it finds for itself.

use crate::space::Space;
use crate::world::World;

/// Makes one world what another is, in the memory that it has. What no output depends on stays its own.
pub(crate) fn copy<S: Space>(from: &World<S>, to: &mut World<S>) {
    // Named one by one, so that none is forgotten.
    let World {
        bodies,
        keys,
        boxes,
        tags,
        dirty,
        is_dirty,
        moved,
        is_moved,
        reshaped,
        odometers,
        motions,
        max_pairs,
        questions,
        candidates,
        records,
        answered,
        persistent,
        edited,
        events,
        impacts,
        by_second,
        stats,
        scratch,
    } = from;
    to.bodies.clone_from(bodies);
    to.keys.clone_from(keys);
    to.boxes.clone_from(boxes);
    to.tags.clone_from(tags);
    to.dirty.clone_from(dirty);
    to.is_dirty.clone_from(is_dirty);
    to.moved.clone_from(moved);
    to.is_moved.clone_from(is_moved);
    to.reshaped.clone_from(reshaped);
    to.odometers.clone_from(odometers);
    to.motions.clone_from(motions);
    to.max_pairs = *max_pairs;
    to.questions.clone_from(questions);
    to.candidates.clone_from(candidates);
    to.records.clone_from(records);
    to.answered.clone_from(answered);
    to.persistent.clone_from(persistent);
    to.edited.clone_from(edited);
    to.events.clone_from(events);
    to.impacts.clone_from(impacts);
    to.by_second.clone_from(by_second);
    to.stats = *stats;
    // All else there is memory, and of no influence on anything.
    to.scratch.sweep.clone_from(&scratch.sweep);
}
