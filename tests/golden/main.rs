//! Golden hashes: what every named scene, and bodies on ground, say over sixty frames, bit for bit, on any number of
//! threads, in any build.
//!
//! `table.txt` was made by `cargo test -p asunder-tests --test golden -- --ignored --nocapture | grep ^scene >
//! tests/golden/table.txt` and is to be made again only where an output is meant to change. A row that differs
//! between two machines, builds or thread counts is a fault, whatever the table says.
//!
//! `.ci/run` asks for the small scenes once more without optimisation and with the portable twins of all wide kernels.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

use asunder::{Plane, Volume};
use asunder_scenes::worlds::WorldScene;
use asunder_tests::recorded::{Fnv1a, Recorded, Recording, Replay};
use asunder_tests::rolling::{GROUNDS, Hills, Track};
use rayon::ThreadPoolBuilder;
use std::collections::HashSet;
use std::fmt::Write;
use std::mem::discriminant;

const FRAMES: u32 = 60;

/// Sixty frames as a row of the table.
fn row<S: Recording, R: Replay<S>>(name: &str, mut recorded: Recorded<S, R>) -> String {
    let (mut events, mut contacts, mut event_count, mut touching) =
        (Fnv1a::default(), Fnv1a::default(), 0, 0);
    for frame in 0..FRAMES {
        recorded.play(frame);
        recorded.hash(&mut events, &mut contacts);
        event_count += S::events(&recorded.world).len();
        touching += recorded.world.stats().touching;
    }
    assert!(event_count > 0 && touching > 0, "{name} says nothing");
    let (events, contacts) = (events.0, contacts.0);
    format!("scene {name}: {event_count} events {events:016x}, {touching} touching {contacts:016x}")
}

/// Few bodies: fast enough without optimisation.
fn small() -> String {
    table(|_| 301, 301, 301)
}

/// So many that every stage is shared out among threads in some scene.
fn large() -> String {
    let count = |scene| match scene {
        WorldScene::ConvexPile => 905,
        WorldScene::MostlyStatic | WorldScene::World1m => 31_000,
        _ => 4301,
    };
    table(count, 31_000, 2301)
}

fn table(count: impl Fn(WorldScene) -> usize, in_plane: usize, on_ground: usize) -> String {
    let mut table = String::new();
    for scene in WorldScene::ALL {
        let (name, count) = (scene.name(), count(scene));
        let recorded = Recorded::<Volume>::new(scene, count);
        writeln!(table, "{}", row(&format!("{name}/{count}"), recorded)).unwrap();
    }
    for scene in [WorldScene::ManyPyramids, WorldScene::Mixed] {
        let name = scene.name();
        let recorded = Recorded::<Plane>::new(scene, in_plane);
        writeln!(table, "{}", row(&format!("plane/{name}/{in_plane}"), recorded)).unwrap();
    }
    let hills = Recorded::<Volume, _>::with(Hills::open(on_ground));
    writeln!(table, "{}", row(&format!("hills/{on_ground}"), hills)).unwrap();
    let track = Recorded::<Plane, _>::with(Track::open(on_ground));
    writeln!(table, "{}", row(&format!("plane/track/{on_ground}"), track)).unwrap();
    table
}

/// The rows of these scenes, as the table has them.
fn check(found: &str, on: &str) {
    let golden = include_str!("table.txt");
    for row in found.lines() {
        let name = row.split(':').next().unwrap();
        let known = golden.lines().find(|line| line.split(':').next() == Some(name));
        assert_eq!(Some(row), known, "{on}");
    }
}

fn on_threads(threads: usize, table: impl FnOnce() -> String + Send) -> String {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(table)
}

#[test]
fn small_scenes_say_what_they_always_said() {
    check(&on_threads(1, small), "one thread");
}

#[test]
fn large_scenes_say_what_they_always_said_on_any_number_of_threads() {
    for threads in [1, 2, 8] {
        check(&on_threads(threads, large), &format!("{threads} threads"));
    }
}

/// Of each ground, which come first: whether bodies of every kind that is there touch it at some time.
fn has_all_kinds<S: Recording>(mut recorded: Recorded<S, impl Replay<S>>, grounds: usize) -> Vec<bool> {
    let bodies = S::bodies(&recorded.world);
    let kinds = bodies.iter().map(|(key, body)| (*key, discriminant(S::shape_of(body)))).collect::<Vec<_>>();
    let (grounds, others) = kinds.split_at(grounds);
    let mut seen = vec![HashSet::new(); grounds.len()];
    for frame in 0..FRAMES {
        recorded.play(frame);
        for (seen, (ground, _)) in seen.iter_mut().zip(grounds) {
            let touching =
                others.iter().filter(|(other, _)| S::is_touching(&recorded.world, *ground, *other));
            seen.extend(touching.map(|(_, kind)| *kind));
        }
    }
    let kinds: HashSet<_> = others.iter().map(|(_, kind)| *kind).collect();
    assert!(kinds.len() >= 5, "boxes, polyhedra, what is round, and compounds");
    seen.iter().map(|seen| *seen == kinds).collect()
}

#[test]
fn bodies_of_every_kind_touch_all_ground() {
    assert_eq!(has_all_kinds(Recorded::<Volume, _>::with(Hills::open(301)), GROUNDS), [true; GROUNDS]);
    assert_eq!(has_all_kinds(Recorded::<Plane, _>::with(Track::open(301)), 1), [true]);
}

#[test]
#[ignore = "prints the table"]
fn print_the_table() {
    print!("\n{}{}", on_threads(1, small), on_threads(1, large));
}
