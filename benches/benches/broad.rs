//! Criterion's view of the broad phase: the main rows of `compare -- broad`, our side alone.

use asunder_broad::Sweep;
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use core::time::Duration;
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};

/// From scratch each frame, the boxes moved on between the frames.
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

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1));
    targets = scratch
}
criterion_main!(benches);
