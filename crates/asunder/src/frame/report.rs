//! Stage 5: events, and every body's contacts.

use crate::contact::Record;
use crate::event::Event;
use crate::space::Space;
use crate::world::World;
use slotmap::Key;

/// Writes the events in pair order, then the index of records by their second body.
pub(super) fn report<S: Space>(world: &mut World<S>) {
    let World { candidates, records, manifolds, events, by_second, stats, scratch, .. } = world;
    events.clear();
    let mut ended = scratch.ended.iter().peekable();
    for began in records.iter().filter(|record| record.is_new) {
        // Where a slot was reused, what ended comes before what began.
        while let Some(gone) = ended.next_if(|gone| gone.pair <= began.pair) {
            events.push(end(gone));
        }
        let Record { keys: (a, b), user_data: (user_data_a, user_data_b), .. } = *began;
        events.push(Event::Began { a, b, user_data_a, user_data_b });
    }
    events.extend(ended.map(end));

    if !stats.overflow {
        by_second.clear();
        by_second.extend(0..records.len() as u32);
        // Records are sorted by both bodies; their index breaks ties as the first body would.
        by_second.sort_unstable_by_key(|&index| (records[index as usize].pair.b, index));
    }
    stats.candidates = candidates.len();
    stats.contacts = records.len();
    stats.touching = records.iter().filter(|record| record.overlapping).count();
    stats.manifolds = manifolds.len();
}

fn end<K: Key>(gone: &Record<K>) -> Event<K> {
    let Record { keys: (a, b), user_data: (user_data_a, user_data_b), .. } = *gone;
    Event::Ended { a, b, user_data_a, user_data_b }
}
