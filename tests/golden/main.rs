//! Golden hashes of the output of every named scene and stage, and of bodies on ground, over sixty frames: the same bit
//! for bit on any number of threads, in any build.
//!
//! `table.txt` was made by `cargo test -p asunder-tests --test golden -- --ignored --nocapture | grep ^scene >
//! tests/golden/table.txt` and is to be made again only where an output is meant to change. A row that differs between
//! two machines, builds or thread counts is a bug, whatever the table says.
//!
//! `.ci/run` runs the small scenes once more without optimisation and with the portable versions of all SIMD kernels.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

use asunder::{Plane, Volume, World};
use asunder_examples::game::Game;
use asunder_examples::opened::AnyGame;
use asunder_examples::playable::Playable;
use asunder_examples::report::STEP;
use asunder_scenes::stages::Stage;
use asunder_scenes::worlds::WorldScene;
use asunder_tests::recorded::{Fnv1a, Recorded, Recording, Replay, hash};
use asunder_tests::rolling::{GROUNDS, Hills, Track};
use rayon::ThreadPoolBuilder;
use std::collections::HashSet;
use std::fmt::Write;
use std::mem::discriminant;

const FRAMES: u32 = 60;

/// The output of sixty frames, as a row of the table.
#[derive(Default)]
struct Told {
    events: Fnv1a,
    contacts: Fnv1a,
    event_count: usize,
    touching: usize,
}

impl Told {
    fn hear<S: Recording>(&mut self, world: &World<S>) {
        hash(world, &mut self.events, &mut self.contacts);
        self.event_count += S::events(world).len();
        self.touching += world.stats().overlapping;
    }

    fn row(self, name: &str) -> String {
        let Self { events: Fnv1a(events), contacts: Fnv1a(contacts), event_count, touching } = self;
        assert!(event_count > 0 && touching > 0, "{name} says nothing");
        format!("scene {name}: {event_count} events {events:016x}, {touching} touching {contacts:016x}")
    }
}

fn row<S: Recording, R: Replay<S>>(name: &str, mut recorded: Recorded<S, R>) -> String {
    let mut told = Told::default();
    for frame in 0..FRAMES {
        recorded.play(frame);
        told.hear(&recorded.world);
    }
    told.row(name)
}

/// A stage as the examples' stepper plays it: a solver turns contacts into poses, so that any difference persists.
fn stage_row(stage: Stage, size: usize) -> String {
    fn played<S: Recording + Playable>(mut game: Game<S>) -> Told {
        let mut told = Told::default();
        game.update();
        told.hear(&game.stepper.world);
        for _ in 1..FRAMES {
            game.step(STEP);
            told.hear(&game.stepper.world);
        }
        told
    }
    let game = AnyGame::of(&stage.build(size, 1)).unwrap();
    let told = match game {
        AnyGame::Plane(game) => played(game),
        AnyGame::Volume(game) => played(game),
    };
    told.row(&format!("stage/{}/{size}", stage.name()))
}

/// Few bodies: fast enough without optimisation.
fn small() -> String {
    table(|_| 301, 301, 301) + &stages(60)
}

/// So many bodies that every stage is distributed over threads in some scene.
fn large() -> String {
    let count = |scene| match scene {
        WorldScene::ConvexPile => 905,
        WorldScene::MostlyStatic | WorldScene::World1m => 31_000,
        _ => 4301,
    };
    table(count, 31_000, 2301) + &stages(300)
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

fn stages(size: usize) -> String {
    // In one of them only one body per ten thousand of the landscape moves.
    let size_of = |stage| if stage == Stage::LargeWorld { 100 * size } else { size };
    Stage::ALL.map(|stage| stage_row(stage, size_of(stage)) + "\n").concat()
}

/// Asserts that these rows are in the table.
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

// Separate tests, so that they run in parallel.

#[test]
fn large_scenes_say_what_they_always_said_on_one_thread() {
    check(&on_threads(1, large), "one thread");
}

#[test]
fn large_scenes_say_the_same_on_two_threads() {
    check(&on_threads(2, large), "two threads");
}

#[test]
fn large_scenes_say_the_same_on_eight_threads() {
    check(&on_threads(8, large), "eight threads");
}

/// For each ground, which come first: whether bodies of every kind present touch it at some time.
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
