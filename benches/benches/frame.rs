//! Criterion's view of the main rows: one broad phase, one narrow phase, one whole frame.

use asunder::{Collider3, World3};
use asunder_broad::Sweep;
use asunder_narrow::Pair3;
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_scenes::pairs::{PairSet, SolidKind, pairs3};
use asunder_scenes::worlds::{Replay3, WorldScene};
use core::time::Duration;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

fn broad(criterion: &mut Criterion) {
    let mut moving = MovingBoxes::new(BoxScene::Gas, 10_000, 1);
    let (mut sweep, mut pairs) = (Sweep::new(), Vec::new());
    criterion.bench_function("broad/gas/10k", |bencher| {
        bencher.iter_batched_ref(
            || {
                moving.step();
                moving.boxes.clone()
            },
            |boxes| sweep.pairs(boxes, |_, _| true, usize::MAX, &mut pairs),
            BatchSize::LargeInput,
        );
    });
}

fn narrow(criterion: &mut Criterion) {
    let pairs = pairs3(SolidKind::Box, PairSet::Mixed, 1000, 1);
    criterion.bench_function("narrow/box/mixed/manifold, 1000 pairs", |bencher| {
        bencher.iter(|| {
            let ask = |p: &asunder_scenes::pairs::PosedPair3| {
                Pair3::new(&p.shape_a, &p.pose_a, &p.shape_b, &p.pose_b)
                    .manifold(0.0)
                    .map_or(0, |m| m.points.len())
            };
            pairs.iter().map(ask).sum::<usize>()
        });
    });
}

fn frame(criterion: &mut Criterion) {
    let mut replay = Replay3::new(WorldScene::Mixed, 2000, 1);
    let mut world = World3::new();
    let insert = |world: &mut World3, body: &asunder_scenes::worlds::Body3| {
        world.insert(Collider3::new(body.shape.clone()).at(body.pose))
    };
    let keys: Vec<_> = replay.bodies.iter().map(|body| insert(&mut world, body)).collect();
    let mut number = 0;
    criterion.bench_function("frame/mixed, 2000 bodies", |bencher| {
        bencher.iter(|| {
            number += 1;
            replay.advance(number);
            for &i in replay.movers() {
                // No key is stale: no body is ever removed.
                let _ = world.set_pose(keys[i as usize], replay.bodies[i as usize].pose);
            }
            world.update();
            world.contacts().map(|contact| contact.manifolds.len()).sum::<usize>()
        });
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    targets = broad, narrow, frame
}
criterion_main!(benches);
