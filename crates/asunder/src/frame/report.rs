//! Stage 5: events, and every body's contacts.

use super::settle::Settled;
use crate::contact::Record;
use crate::event::Event;
use crate::records::CHUNK;
use crate::space::Space;
use crate::world::{Scratch, World};
use slotmap::Key;

/// Writes the events in pair order, then the index of records by their second body. Of records, only those of chunks
/// with a new one are read; where no chunk was looked at, the index is what it was.
pub(super) fn report<S: Space>(world: &mut World<S>) {
    let World { keys, candidates, records, events, by_second, stats, scratch, .. } = world;
    let Scratch { ended, settled, seconds, ends, chunk_ends, .. } = scratch;
    events.clear();
    let tallies = || settled.iter().map(|settled| &settled.tally);
    let mut ended = ended.iter().peekable();
    let with_new = records.chunks().iter().zip(tallies()).filter(|(_, tally)| tally.new > 0);
    let has_new = |record: &&Record<S::Key>| record.is_new;
    for began in with_new.flat_map(|(chunk, _)| chunk).filter(has_new) {
        // Where a slot was reused, what ended comes before what began.
        while let Some(gone) = ended.next_if(|gone| gone.pair <= began.pair) {
            events.push(end(gone));
        }
        let Record { keys: (a, b), user_data: (user_data_a, user_data_b), sensor, .. } = *began;
        events.push(Event::Began { a, b, user_data_a, user_data_b, sensor });
    }
    events.extend(ended.map(end));

    stats.candidates = candidates.len();
    if stats.overflow {
        // Nobody has counted those that stay.
        stats.contacts = records.all().count();
        stats.touching = records.all().filter(|record| record.overlapping).count();
        stats.manifolds = records.all().map(|record| record.manifolds.count()).sum();
    } else {
        stats.contacts = tallies().map(|tally| tally.seconds.len()).sum();
        stats.touching = tallies().map(|tally| tally.touching).sum();
        stats.manifolds = tallies().map(|tally| tally.manifolds).sum();
        let lists = || tallies().map(|tally| &*tally.seconds);
        if settled.iter().take(chunk_ends.len()).all(Settled::is_quiet) {
            return;
        }
        index_by_second((lists, stats.contacts), keys.len(), by_second, (seconds, ends));
    }
}

/// The numbers of the records in order of their second bodies, which are listed chunk by chunk; then of the first, in
/// which order they come.
///
/// By counting, which is twice as fast as sorting where most bodies touch; where few do, there are more slots than
/// worth counting in.
fn index_by_second<'a, L: Iterator<Item = &'a [u32]>>(
    (lists, count): (impl Fn() -> L, usize),
    slots: usize,
    by_second: &mut Vec<u32>,
    (seconds, ends): (&mut Vec<(u32, u32)>, &mut Vec<u32>),
) {
    by_second.clear();
    let numbered = || (0..).step_by(CHUNK).zip(lists()).flat_map(|(first, list)| list.iter().zip(first..));
    if slots > 16 * count {
        seconds.clear();
        seconds.extend(numbered().map(|(&second, number)| (second, number)));
        seconds.sort_unstable();
        by_second.extend(seconds.iter().map(|&(_, number)| number));
        return;
    }
    ends.clear();
    ends.resize(slots, 0);
    for &second in lists().flatten() {
        ends[second as usize] += 1;
    }
    let mut sum = 0;
    for end in ends.iter_mut() {
        sum += core::mem::replace(end, sum);
    }
    by_second.resize(count, 0);
    for (&second, number) in numbered() {
        let end = &mut ends[second as usize];
        by_second[*end as usize] = number;
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

    #[test]
    fn counting_and_sorting_give_the_same_index() {
        // Numbers have gaps: a chunk is never full.
        let lists: Vec<Vec<u32>> = (0..40).map(|a| (a + 1..60).step_by(7).collect()).collect();
        let all = || lists.iter().map(Vec::as_slice);
        let count = lists.iter().map(Vec::len).sum();
        let second = |&number: &u32| (lists[number as usize / CHUNK][number as usize % CHUNK], number);
        let (mut counted, mut sorted, mut seconds, mut ends) = (vec![9], vec![], vec![(1, 2)], vec![7; 3]);
        index_by_second((all, count), 60, &mut counted, (&mut seconds, &mut ends));
        assert!(counted.is_sorted_by_key(second) && counted.len() == count);
        index_by_second((all, count), 20 * count, &mut sorted, (&mut seconds, &mut ends));
        assert_eq!(counted, sorted);
    }
}
