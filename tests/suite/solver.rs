//! A simple solver on the manifolds: what games stack stands for five seconds, warm-started by the feature ids of
//! contact points.
//!
//! Eight substeps per step, contacts as springs of 60 Hz, friction 0.6, contacts within 2 cm of bodies 1 m wide.
//! Overlaps are judged in double-double and not by the manifolds, which would not show a point that they miss.

mod scenes;

use asunder_geometry::Shape3;
use asunder_scenes::pairs::SolidKind;
use asunder_tests::precise::separation3;
use asunder_tests::solver::{Body, Names, STEP, Settings, Solver};
use glam::{DVec3, Vec3};
use scenes::{cards, crate_hull, cuboid, dropped, octagon, pyramid, stack};

/// The deepest allowed overlap of a pair, over the smaller body's size. Springs yield under load: ten bodies press the
/// lowest in by 7e-4.
const DEEPEST: f64 = 5e-3;

/// The furthest that a body may move from where it was put, in sizes: the springs yield by 4e-3, ten times over.
const DRIFT: f64 = 0.02;

/// The furthest that it may still move in the last second.
const LAST_DRIFT: f64 = 2e-3;

/// Least share of the points whose feature id existed in the previous step.
const KEPT: f64 = 0.99;

/// Seconds for which everything must stand.
const TIME: f64 = 5.0;

/// Seconds after which contacts have settled.
const SETTLED: f64 = 1.0;

/// What happened to bodies that should have stood.
#[derive(Clone, Copy, Debug, Default)]
struct Story {
    /// The deepest overlap of any pair, as a share of the smaller body's size, judged in double-double.
    deepest: f64,
    /// How far a body has moved from where it started, in sizes.
    drift: f64,
    /// The same in the last second alone.
    last_drift: f64,
    /// Share of the points, once settled, whose feature id existed in the previous step.
    kept: f64,
    points: usize,
}

fn size(shape: &Shape3) -> f64 {
    2.0 * f64::from(shape.outer_radius())
}

/// Shapes of all bodies, in order.
fn shapes(solver: &Solver) -> Vec<Shape3> {
    let mut shapes: Vec<(u64, Shape3)> =
        solver.world.iter().map(|(_, body)| (body.get_user_data(), body.shape().clone())).collect();
    shapes.sort_by_key(|(index, _)| *index);
    shapes.into_iter().map(|(_, shape)| shape).collect()
}

fn deepest(solver: &Solver) -> f64 {
    let share = |(a, b)| {
        let [a, b] = [a, b].map(|key| solver.world.get(key).unwrap());
        let truth = separation3((a.shape(), a.pose()), (b.shape(), b.pose()));
        -truth.separation / size(a.shape()).min(size(b.shape()))
    };
    solver.world.candidates().map(share).fold(0.0, f64::max)
}

fn furthest(from: &[DVec3], solver: &Solver, sizes: &[f64]) -> f64 {
    let moved = from
        .iter()
        .zip(&solver.bodies)
        .zip(sizes)
        .map(|((from, body), size)| (body.center - from).length() / size);
    moved.fold(0.0, f64::max)
}

fn watch(solver: &mut Solver) -> Story {
    let sizes: Vec<f64> = shapes(solver).iter().map(size).collect();
    let places = |solver: &Solver| solver.bodies.iter().map(|body| body.center).collect::<Vec<DVec3>>();
    let start = places(solver);
    let (mut story, mut late, mut kept) = (Story::default(), start.clone(), 0);
    let steps = (TIME / STEP).round() as usize;
    for step in 0..steps {
        let seen = solver.step();
        if step as f64 * STEP >= SETTLED {
            (story.points, kept) = (story.points + seen.points, kept + seen.kept);
        }
        if step % 30 == 29 {
            story.deepest = story.deepest.max(deepest(solver));
        }
        if step + 60 == steps {
            late = places(solver);
        }
    }
    story.kept = kept as f64 / story.points.max(1) as f64;
    (story.drift, story.last_drift) = (furthest(&start, solver, &sizes), furthest(&late, solver, &sizes));
    story
}

fn assert_stands(name: &str, solver: &mut Solver) {
    let story = watch(solver);
    eprintln!("{name}: {story:?}");
    assert!(story.deepest < DEEPEST, "{name}: {story:?}");
    assert!(story.drift < DRIFT && story.last_drift < LAST_DRIFT, "{name}: {story:?}");
    assert!(story.kept >= KEPT, "{name}: {story:?}");
}

fn cube() -> Shape3 {
    cuboid(Vec3::splat(0.5))
}

fn cube_hull() -> Shape3 {
    crate_hull(Vec3::splat(0.5))
}

#[test]
fn stacks_of_ten_stand() {
    assert_stands("boxes", &mut stack(&cube(), 1.0, 0.0, Settings::default()));
    assert_stands("boxes as hulls", &mut stack(&cube_hull(), 1.0, 0.0, Settings::default()));
}

#[test]
fn two_cards_lean_on_each_other() {
    // 15 and 25 degrees from upright, whose tangents must be below the friction.
    for half_tangent in [0.13, 0.22] {
        assert_stands(&format!("cards at {half_tangent}"), &mut cards(half_tangent, Settings::default()));
    }
}

#[test]
fn pyramids_of_ten_rows_stand() {
    assert_stands("pyramid of boxes", &mut pyramid(&cube(), Settings::default()));
    assert_stands("pyramid of hulls", &mut pyramid(&cube_hull(), Settings::default()));
}

/// Where two faces share more than four corners, which four are kept changes with the last bits of the depths: impulses
/// are lost, and a stack sways slightly.
#[test]
fn stacks_of_ten_stand_on_patches_of_eight_corners() {
    for (name, shape, twist) in [
        ("twisted boxes", cube(), 0.15),
        ("twisted boxes as hulls", cube_hull(), 0.15),
        ("octagons", octagon(), 0.0),
        ("twisted octagons", octagon(), 0.1),
    ] {
        let story = watch(&mut stack(&shape, 1.0, twist, Settings::default()));
        eprintln!("{name}: {story:?}");
        assert!(story.deepest < DEEPEST, "{name}: {story:?}");
        assert!(story.drift < 3.0 * DRIFT && story.last_drift < 3.0 * DRIFT, "{name}: {story:?}");
        assert!(story.kept >= 0.5, "{name}: {story:?}");
    }
}

/// Half the substeps, so that a solver without warm starting cannot make up for it by more iterations.
fn frugal(names: Names) -> Settings {
    Settings { substeps: 4, names, ..Settings::default() }
}

#[test]
fn names_hold_stacks_up() {
    for (name, shape) in [("boxes", cube()), ("boxes as hulls", cube_hull())] {
        let [kept, lost, swapped] = [Names::Kept, Names::Lost, Names::Swapped]
            .map(|names| watch(&mut stack(&shape, 1.0, 0.0, frugal(names))));
        eprintln!("{name}: kept {kept:?}, lost {lost:?}, swapped {swapped:?}");
        assert!(kept.drift < 3.0 * DRIFT && kept.deepest < DEEPEST, "{name}: {kept:?}");
        assert_eq!(lost.kept, 0.0);
        // Both have fallen, or are about to.
        for story in [lost, swapped] {
            assert!(story.drift > 10.0 * DRIFT && story.deepest > DEEPEST, "{name}: {story:?}");
        }
    }
}

#[test]
fn names_keep_what_stands_from_creeping() {
    let with = |names| Settings { names, ..Settings::default() };
    for (name, [kept, lost]) in [
        ("pyramid", [Names::Kept, Names::Lost].map(|names| watch(&mut pyramid(&cube(), with(names))))),
        ("cards", [Names::Kept, Names::Lost].map(|names| watch(&mut cards(0.22, with(names))))),
    ] {
        eprintln!("{name}: kept {kept:?}, lost {lost:?}");
        assert!(lost.drift > 10.0 * kept.drift && lost.last_drift > 1e-4, "{name}: {kept:?}, {lost:?}");
        assert!(kept.last_drift < 1e-6, "{name}: {kept:?}");
    }
}

/// Bodies of every kind, dropped from a small height, come to rest on points whose feature ids then persist.
#[test]
fn dropped_bodies_come_to_rest() {
    for kind in [SolidKind::Box, SolidKind::Authored, SolidKind::Hull8, SolidKind::Hull16, SolidKind::Hull32]
    {
        let mut solver = dropped(kind);
        let mut seen = [0, 0];
        for step in 0..(2.0 * TIME / STEP) as usize {
            let now = solver.step();
            if step as f64 * STEP > 2.0 * TIME - 1.0 {
                seen = [seen[0] + now.points, seen[1] + now.kept];
            }
        }
        let share = seen[1] as f64 / seen[0] as f64;
        let speed = |body: &Body| body.velocity.length() + body.spin.length();
        let fastest = solver.bodies.iter().map(speed).fold(0.0, f64::max);
        eprintln!("{}: fastest {fastest}, kept {share}, deepest {}", kind.name(), deepest(&solver));
        assert!(fastest < 1e-2, "{}: still at {fastest}", kind.name());
        assert!(share >= 0.95 && deepest(&solver) < DEEPEST, "{}: {share}", kind.name());
    }
}
