//! Criterion benches of whole frames, and of pairs that are queried from frame to frame.

mod brief;

use asunder::glam::{DVec3, Vec3};
use asunder::{Collider3, Cuboid, Pose3, World3};
use asunder_examples::falling::recorded;
use asunder_narrow::{Answer, Batch3, Hint, Job3, collide3};
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, frames3, pairs3};
use asunder_scenes::stages::Falling;
use asunder_scenes::worlds::{Body3, Replay3, WorldScene};
use core::hint::black_box;
use core::time::Duration;
use criterion::{Criterion, criterion_group, criterion_main};
use std::time::Instant;

/// Pairs in a set: one iteration queries them all.
const PAIRS: usize = 200;

/// One frame of a scene small enough for a quick look, from setting poses on. Moving the scene is not timed.
fn frames(criterion: &mut Criterion) {
    let scenes = [
        (WorldScene::Mixed, 2000),
        (WorldScene::ManyPyramids, 1000),
        (WorldScene::ConvexPile, 505),
        (WorldScene::MostlyStatic, 10_000),
    ];
    for (scene, count) in scenes {
        frame(criterion, scene.name(), Replay3::new(scene, count, 1));
    }
    let heap = Falling::Boxes;
    frame(criterion, heap.name(), recorded(heap, 1005, 1).expect("boxes have mass"));
}

/// A block of boxes at rest, face to face, beside which one moves: the cost of a frame in which almost nothing happens.
fn asleep(criterion: &mut Criterion) {
    const SIDE: usize = 20;
    let mut world = World3::new();
    let unit = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5)).expect("half a metre is in range"));
    let pose = |at: DVec3| Pose3::at(at).expect("near the origin");
    for cell in 0..SIDE.pow(3) {
        let at = [cell % SIDE, cell / SIDE % SIDE, cell / SIDE / SIDE].map(|coordinate| coordinate as f64);
        world.insert(unit.clone().at(pose(DVec3::from(at))));
    }
    let mover = world.insert(unit);
    // In the first update everything is new; in the second everything is recorded.
    (0..3).for_each(|_| world.update());
    let mut frames = 0_u32;
    criterion.bench_function(&format!("frame/asleep, {} bodies", world.len()), |bencher| {
        bencher.iter(|| {
            frames += 1;
            // No body is ever removed.
            let _ =
                world.set_pose(mover, pose(DVec3::new(-50.0 + 0.01 * f64::from(frames % 1000), 0.0, 0.0)));
            world.update();
            world.stats().contacts
        });
    });
}

fn frame(criterion: &mut Criterion, name: &str, mut replay: Replay3) {
    let mut world = World3::new();
    let insert = |world: &mut World3, body: &Body3| {
        let collider = Collider3::new(body.shape.clone()).at(body.pose);
        world.insert(if body.fixed { collider.fixed() } else { collider })
    };
    let keys: Vec<_> = replay.bodies.iter().map(|body| insert(&mut world, body)).collect();
    let mut number = 0;
    criterion.bench_function(&format!("frame/{name}, {} bodies", keys.len()), |bencher| {
        bencher.iter_custom(|frames| {
            let mut spent = Duration::ZERO;
            for _ in 0..frames {
                number += 1;
                replay.advance(number);
                let start = Instant::now();
                for &i in replay.movers() {
                    // No key is stale: no body is ever removed.
                    let _ = world.set_pose(keys[i as usize], replay.bodies[i as usize].pose);
                }
                world.update();
                black_box(world.contacts().map(|contact| contact.manifolds.len()).sum::<usize>());
                spent += start.elapsed();
            }
            spent
        });
    });
}

/// Pairs that are queried frame after frame.
fn hints(criterion: &mut Criterion) {
    for kind in [SolidKind::Box, SolidKind::Hull32] {
        cached(criterion, kind);
        followed(criterion, kind);
    }
}

fn job(pair: &PosedPair3, hint: Hint) -> Job3<'_> {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor: false }
}

/// Faces on faces, with the hints of the previous frame.
fn cached(criterion: &mut Criterion, kind: SolidKind) {
    let pairs = pairs3(kind, PairSet::Rest, PAIRS, 1);
    let mut batch = Batch3::default();
    let fresh: Vec<Job3<'_>> = pairs.iter().map(|pair| job(pair, Hint::NONE)).collect();
    collide3(&fresh, &mut batch);
    let hints = batch.answers.iter().map(hint_of);
    let jobs: Vec<Job3<'_>> = pairs.iter().zip(hints).map(|(pair, hint)| job(pair, hint)).collect();
    criterion.bench_function(&format!("{}/rest/cached, {PAIRS} pairs", kind.name()), |bencher| {
        let mut batch = Batch3::default();
        bencher.iter(|| {
            batch.clear();
            collide3(black_box(&jobs), &mut batch);
            batch.manifolds.len()
        });
    });
}

fn hint_of(answer: &Answer) -> Hint {
    let (Answer::Apart { hint, .. } | Answer::Contact { hint, .. }) = answer;
    *hint
}

/// Bodies that slide or tumble through all frames, each frame with the hints of the previous one.
fn followed(criterion: &mut Criterion, kind: SolidKind) {
    for set in [PairSet::Slide, PairSet::Tumble] {
        let frames = frames3(kind, set, PAIRS, 1);
        let asked: usize = frames.iter().map(Vec::len).sum();
        let (mut batch, mut hints) = (Batch3::default(), Vec::new());
        criterion.bench_function(
            &format!("{}/{}/cached, {asked} pairs", kind.name(), set.name()),
            |bencher| {
                bencher.iter(|| {
                    hints.clear();
                    hints.resize(frames[0].len(), Hint::NONE);
                    for frame in black_box(&frames) {
                        let jobs: Vec<Job3<'_>> =
                            frame.iter().zip(&hints).map(|(pair, &hint)| job(pair, hint)).collect();
                        batch.clear();
                        collide3(&jobs, &mut batch);
                        hints
                            .iter_mut()
                            .zip(&batch.answers)
                            .for_each(|(kept, answer)| *kept = hint_of(answer));
                    }
                    batch.manifolds.len()
                });
            },
        );
    }
}

criterion_group! {
    name = benches;
    config = brief::brief();
    targets = frames, asleep, hints
}
criterion_main!(benches);
