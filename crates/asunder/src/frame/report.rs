//! Stage 5: events, and every body's contacts.

use crate::contact::Record;
use crate::event::Event;
use crate::records::CHUNK;
use crate::space::Space;
use crate::world::{Scratch, World};
use slotmap::Key;

/// Writes the events in pair order, then the index of records by their second body. Records are read only in chunks
/// that have a new one. Where every chunk's records have the second bodies that they had, the index stays as it is.
pub(super) fn report<S: Space>(world: &mut World<S>) {
    let World { keys, candidates, records, events, by_second, stats, scratch, .. } = world;
    let Scratch { ended, settled, seconds, ends, .. } = scratch;
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
        // The contacts that stay have not been counted.
        stats.contacts = records.all().count();
        stats.overlapping = records.all().filter(|record| record.overlapping).count();
        stats.manifolds = records.all().map(|record| record.manifolds.count()).sum();
    } else {
        stats.contacts = tallies().map(|tally| tally.seconds.len()).sum();
        stats.overlapping = tallies().map(|tally| tally.overlapping).sum();
        stats.manifolds = tallies().map(|tally| tally.manifolds).sum();
        if tallies().any(|tally| tally.has_others) || by_second.len() != stats.contacts {
            let lists = || tallies().map(|tally| &*tally.seconds);
            index_by_second((lists, stats.contacts), keys.len(), by_second, (seconds, ends));
        }
    }
}

/// Lists the numbers of the records in order of their second body, then of their first. The second bodies are given
/// chunk by chunk, already in order of the first.
///
/// By counting sort, twice as fast where most bodies touch; where few do, the slots to count in are too many, and
/// numbers are sorted.
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
    use crate::space::BodyKey3;
    use crate::{Collider3, Cuboid, Pose3, World3};
    use asunder_geometry::glam::{DVec3, Vec3};

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

    /// A floor of so many tiles with a crate on each, and the crates.
    fn crates_on_tiles(count: u32) -> (World3, Vec<BodyKey3>) {
        let unit = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap()).margin(0.01).unwrap();
        let mut world = World3::new();
        let at = |i: u32, y: f64| Pose3::at([2.0 * f64::from(i), y, 0.0]).unwrap();
        // Crates lie in higher slots than all tiles.
        world.insert_many((0..count).map(|i| unit.clone().at(at(i, 0.0)).fixed()));
        let crates = (0..count).map(|i| world.insert(unit.clone().at(at(i, 1.0)))).collect();
        world.update();
        (world, crates)
    }

    fn is_in_order(world: &World3) -> bool {
        let key = |&number: &u32| (world.records.get(number as usize).pair.b, number);
        world.by_second.is_sorted_by_key(key) && world.by_second.len() == world.records.len()
    }

    fn shift(world: &mut World3, body: BodyKey3, by: [f64; 3]) {
        let pose = world.pose(body).unwrap().shifted(DVec3::from(by)).unwrap();
        world.set_pose(body, pose).unwrap();
    }

    #[test]
    fn the_index_is_made_anew_only_where_contacts_come_or_go() {
        let (mut world, crates) = crates_on_tiles(1500);
        assert!(is_in_order(&world) && world.records.len() == 1500);
        for movers in [1, 1000] {
            for round in 0..6 {
                // A mark that lasts until an index is written.
                world.by_second.reverse();
                let by = if round % 2 == 0 { 1e-3 } else { -1e-3 };
                crates.iter().take(movers).for_each(|&body| shift(&mut world, body, [0.0, by, 0.0]));
                world.update();
                world.by_second.reverse();
                assert!(is_in_order(&world), "{movers} that tremble, round {round}");
            }
            for by in [0.5, -0.5] {
                shift(&mut world, crates[700], [0.0, by, 0.0]);
                world.update();
                assert!(is_in_order(&world), "{movers}: one by {by}");
            }
            // As many contacts as before.
            shift(&mut world, crates[10], [2.0, 0.0, 0.0]);
            shift(&mut world, crates[11], [-2.0, 0.0, 0.0]);
            world.update();
            assert!(is_in_order(&world), "{movers}: two change places");
        }
    }

    #[test]
    fn the_index_is_that_of_the_contacts_whatever_a_world_was_before() {
        let ((mut world, crates), (mut other, others)) = (crates_on_tiles(700), crates_on_tiles(700));
        let kept = world.clone();
        for (round, &body) in (0..).zip(&crates[..60]) {
            match round % 5 {
                0 => drop(world.remove(body)),
                1 => shift(&mut world, body, [2.0, 0.0, 0.0]),
                2 => world.set_max_pairs(if round % 2 == 0 { 10 } else { 1 << 24 }),
                3 => world.disable(body).unwrap(),
                _ => {
                    shift(&mut other, others[round], [0.0, 3.0, 0.0]);
                    other.update();
                    // As many contacts, and others; or none at all.
                    world.clone_from(if round % 2 == 0 { &other } else { &kept });
                    if round == 59 {
                        world.clear();
                    }
                }
            }
            world.update();
            assert!(is_in_order(&world), "round {round}");
        }
    }
}
