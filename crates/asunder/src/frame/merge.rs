//! Stage 4: the chunks' results, put together.

use crate::space::Space;
use crate::world::{Scratch, World};

/// Gathers the contacts that ended, and puts persistent manifolds into their places.
pub(super) fn merge<S: Space>(world: &mut World<S>) {
    let World { candidates, records, persistent, reshaped, stats, scratch, .. } = world;
    let Scratch { settled, spare, ended, last_records, .. } = scratch;
    ended.clear();
    if stats.overflow {
        // Last update's contacts stay; their events were reported then.
        records.all_mut().for_each(|record| record.is_new = false);
        return;
    }
    for (settled, candidates) in settled.iter_mut().zip(candidates.chunks_mut()) {
        ended.extend(settled.ended.drain(..).map(|number| *last_records.get(number as usize)));
        for place in settled.vacated.drain(..) {
            persistent.vacate(place);
        }
        for (number, kept) in settled.kept.drain(..) {
            let Some(candidate) = candidates.get_mut(number as usize) else { break };
            candidate.persistent =
                persistent.put(candidate.persistent, kept, |before| S::reclaim(spare, before));
        }
    }
    reshaped.clear();
}
