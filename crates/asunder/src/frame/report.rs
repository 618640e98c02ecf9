//! Stage 5: events, and every body's contacts.

use crate::contact::Record;
use crate::event::Event;
use crate::space::Space;
use crate::world::World;
use slotmap::Key;

/// Writes the events in pair order, then the index of records by their second body.
pub(super) fn report<S: Space>(world: &mut World<S>) {
    let World { keys, candidates, records, edited, events, by_second, stats, scratch, .. } = world;
    events.clear();
    let mut ended = scratch.ended.iter().peekable();
    for began in records.iter().filter(|record| record.is_new) {
        // Where a slot was reused, what ended comes before what began.
        while let Some(gone) = ended.next_if(|gone| gone.pair <= began.pair) {
            events.push(end(gone));
        }
        let Record { keys: (a, b), user_data: (user_data_a, user_data_b), sensor, .. } = *began;
        events.push(Event::Began { a, b, user_data_a, user_data_b, sensor });
    }
    events.extend(ended.map(end));

    if !stats.overflow {
        index_by_second(records, keys.len(), by_second, &mut scratch.ends);
    }
    stats.candidates = candidates.len();
    stats.contacts = records.len();
    stats.touching = records.iter().filter(|record| record.overlapping).count();
    stats.manifolds = match edited {
        Some(edited) => edited.len(),
        None => records.iter().map(|record| record.manifolds.range.len()).sum(),
    };
}

/// The records in order of their second body, then of the first, in which order they come.
///
/// By counting, which is twice as fast as sorting where most bodies touch; where few do, there are more slots than
/// worth counting in.
fn index_by_second<K: Key>(records: &[Record<K>], slots: usize, into: &mut Vec<u32>, ends: &mut Vec<u32>) {
    into.clear();
    let second = |index: u32| records[index as usize].pair.b;
    let all = 0..records.len() as u32;
    if slots > 16 * records.len() {
        into.extend(all);
        into.sort_unstable_by_key(|&index| (second(index), index));
        return;
    }
    ends.clear();
    ends.resize(slots, 0);
    for index in all.clone() {
        ends[second(index) as usize] += 1;
    }
    let mut sum = 0;
    for end in ends.iter_mut() {
        sum += core::mem::replace(end, sum);
    }
    into.resize(records.len(), 0);
    for index in all {
        let end = &mut ends[second(index) as usize];
        into[*end as usize] = index;
        *end += 1;
    }
}

fn end<K: Key>(gone: &Record<K>) -> Event<K> {
    let Record { keys: (a, b), user_data: (user_data_a, user_data_b), sensor, .. } = *gone;
    Event::Ended { a, b, user_data_a, user_data_b, sensor }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Place;
    use crate::space::BodyKey3;
    use asunder_broad::PairId;

    #[test]
    fn counting_and_sorting_give_the_same_index() {
        let record = |(a, b): (u32, u32)| Record {
            pair: PairId { a, b },
            keys: (BodyKey3::null(), BodyKey3::null()),
            user_data: (0, 0),
            manifolds: Place::NOWHERE,
            sensor: false,
            overlapping: true,
            begun: true,
            is_new: false,
            speculative: false,
        };
        let pairs = (0..40).flat_map(|a| (a + 1..60).step_by(7).map(move |b| (a, b)));
        let records: Vec<Record<BodyKey3>> = pairs.map(record).collect();
        let (mut counted, mut sorted, mut ends) = (vec![9], vec![], vec![7; 3]);
        index_by_second(&records, 60, &mut counted, &mut ends);
        index_by_second(&records, 20 * records.len(), &mut sorted, &mut ends);
        let by_second = |&index: &u32| (records[index as usize].pair.b, records[index as usize].pair.a);
        assert!(counted.is_sorted_by_key(by_second) && counted.len() == records.len());
        assert_eq!(counted, sorted);
    }
}
