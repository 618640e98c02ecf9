//! Copies of a world: what a clone takes over, and what stays its own.

use crate::space::Space;
use crate::world::{Scratch, World};
use asunder_geometry::copied;

/// Makes one world equal to another, in the memory that it has. Working memory, on which no output depends, stays its
/// own.
pub(crate) fn copy<S: Space>(from: &World<S>, to: &mut World<S>) {
    copied!(from => to, of World {
        bodies, keys, boxes, tags, dirty, is_dirty, moved, is_moved, reshaped, odometers, motions, max_pairs, questions,
        candidates, records, answered, persistent, edited, events, impacts, by_second, stats
    } but { scratch });
    copied!(&from.scratch => to.scratch, of Scratch { sweep } but {
        pairs, spare, is_settled, chunk_ends, settled, last_candidates, last_records, last_answered, ended, editing, of_bullets, touches,
        timed_hits, #[cfg(feature = "parallel")] impacts, ends, seconds
    });
    to.scratch.is_settled = false;
}
