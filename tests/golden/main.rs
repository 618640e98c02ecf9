//! Golden hashes: what every named scene says over sixty frames, bit for bit, on any number of threads, in any build.
//!
//! `table.txt` was made by `cargo test -p asunder-tests --test golden -- --ignored --nocapture | grep ^scene >
//! tests/golden/table.txt` and is to be made again only where an output is meant to change. A row that differs
//! between two machines, builds or thread counts is a fault, whatever the table says.
//!
//! `.ci/run` asks for the small scenes once more without optimisation and with the portable twins of all wide kernels.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

use asunder::{Plane, Volume};
use asunder_scenes::worlds::WorldScene;
use asunder_tests::recorded::{Fnv1a, Recorded, Recording};
use rayon::ThreadPoolBuilder;
use std::fmt::Write;

const FRAMES: u32 = 60;

/// Sixty frames as a row of the table.
fn row<S: Recording>(name: &str, scene: WorldScene, count: usize) -> String {
    let mut recorded = Recorded::<S>::new(scene, count);
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
    format!("scene {name}/{count}: {event_count} events {events:016x}, {touching} touching {contacts:016x}")
}

/// Few bodies: fast enough without optimisation.
fn small() -> String {
    table(|_| 301, 301)
}

/// So many that every stage is shared out among threads in some scene.
fn large() -> String {
    let count = |scene| match scene {
        WorldScene::ConvexPile => 905,
        WorldScene::MostlyStatic | WorldScene::World1m => 31_000,
        _ => 4301,
    };
    table(count, 31_000)
}

fn table(count: impl Fn(WorldScene) -> usize, in_plane: usize) -> String {
    let mut table = String::new();
    for scene in WorldScene::ALL {
        writeln!(table, "{}", row::<Volume>(scene.name(), scene, count(scene))).unwrap();
    }
    for scene in [WorldScene::ManyPyramids, WorldScene::Mixed] {
        writeln!(table, "{}", row::<Plane>(&format!("plane/{}", scene.name()), scene, in_plane)).unwrap();
    }
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

#[test]
#[ignore = "prints the table"]
fn print_the_table() {
    print!("\n{}{}", on_threads(1, small), on_threads(1, large));
}
