//! Criterion benches of the broad phase: the main rows of `compare -- broad`, our side alone.

mod brief;

use asunder_broad::{CoherentSweep, Index, Sweep};
use asunder_geometry::{Aabb3, glam::Vec3};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use core::hint::black_box;
use core::time::Duration;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::time::Instant;

/// From scratch each frame; the boxes move on between the frames.
fn scratch(criterion: &mut Criterion) {
    let small = [BoxScene::Gas, BoxScene::City].map(|scene| (scene, 1000));
    let scenes = [BoxScene::Gas, BoxScene::City, BoxScene::Pile, BoxScene::Sizes, BoxScene::Tower];
    for (scene, count) in small.into_iter().chain(scenes.map(|scene| (scene, 10_000))) {
        let mut moving = MovingBoxes::new(scene, count, 1);
        let (mut sweep, mut pairs) = (Sweep::new(), Vec::new());
        criterion.bench_function(&format!("broad/{}/{count}", scene.name()), |bencher| {
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
}

/// Few boxes move, and pairs of resting boxes are kept. Moving the scene is not timed.
fn coherent(criterion: &mut Criterion) {
    for (scene, count) in
        [(BoxScene::Static1, 10_000), (BoxScene::Static5, 10_000), (BoxScene::Still, 100_000)]
    {
        let mut moving = MovingBoxes::new(scene, count, 1);
        let (mut sweep, mut pairs) = (CoherentSweep::new(), Vec::new());
        criterion.bench_function(&format!("broad/{}/{count}", scene.name()), |bencher| {
            bencher.iter_custom(|frames| {
                let mut spent = Duration::ZERO;
                for _ in 0..frames {
                    moving.step();
                    let start = Instant::now();
                    let update =
                        sweep.update(&moving.boxes, moving.moved(), |_, _| true, usize::MAX, &mut pairs);
                    let _ = black_box(update);
                    spent += start.elapsed();
                }
                spent
            });
        });
    }
}

/// The boxes that overlap a box of the scene's own size, among boxes that rest.
fn asked(criterion: &mut Criterion) {
    let boxes = MovingBoxes::new(BoxScene::Gas, 100_000, 1).boxes;
    let mut index = Index::new();
    index.build(&boxes);
    let questions: Vec<Aabb3> =
        boxes.iter().step_by(101).map(|one| Aabb3::new(one.min + Vec3::splat(0.3), one.max)).collect();
    let mut met = Vec::new();
    criterion.bench_function("query/gas/100000/overlap x 991", |bencher| {
        bencher.iter(|| {
            questions
                .iter()
                .map(|question| {
                    index.overlapping(question, &mut met);
                    met.len()
                })
                .sum::<usize>()
        });
    });
}

criterion_group! {
    name = benches;
    config = brief::brief();
    targets = scratch, coherent, asked
}
criterion_main!(benches);
