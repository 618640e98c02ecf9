//! Stage 4: last update's contacts beside this one's.

use super::collide::of_another_shape;
use crate::contact::Record;
use crate::space::Space;
use crate::world::World;
use slotmap::Key;

/// Carries over what has begun, and sets aside what is gone. Two lists sorted by pair, walked once.
pub(super) fn merge<S: Space>(world: &mut World<S>) {
    let World { records, reshaped, stats, scratch, .. } = world;
    scratch.ended.clear();
    if stats.overflow {
        // Last update's contacts stay; their events were reported then.
        records.iter_mut().for_each(|record| record.is_new = false);
        return;
    }
    let mut last = scratch.last_records.iter().peekable();
    for record in records.iter_mut() {
        while let Some(gone) = last.next_if(|last| last.pair < record.pair) {
            set_aside(gone, &mut scratch.ended);
        }
        let before = last.next_if(|last| last.pair == record.pair);
        let had_begun = match before {
            // A reused slot is a new body: its predecessor's contact ended.
            Some(before) if before.keys != record.keys => {
                set_aside(before, &mut scratch.ended);
                false
            }
            // The margin's memory does not outlive a shape: a contact that the new one does not touch is over. So
            // is one beyond the margin, whatever a motion may bring.
            Some(before)
                if record.speculative || (!record.overlapping && of_another_shape(reshaped, record.pair)) =>
            {
                set_aside(before, &mut scratch.ended);
                false
            }
            Some(before) => before.begun,
            None => false,
        };
        record.begun |= had_begun;
        record.is_new = record.begun && !had_begun;
    }
    for gone in last {
        set_aside(gone, &mut scratch.ended);
    }
    reshaped.clear();
}

fn set_aside<K: Key>(gone: &Record<K>, ended: &mut Vec<Record<K>>) {
    if gone.begun {
        ended.push(gone.clone());
    }
}
