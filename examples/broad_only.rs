//! Only the broad phase: which of many boxes overlap, frame after frame, and what a box or a ray overlaps.
//!
//! A game that has its own shapes, or needs no more than boxes (triggers, areas of interest in a large world, culling),
//! can use `asunder-broad` alone: boxes go in, sorted pairs of their indices come out.

use asunder_broad::{Cast, CoherentSweep, Index, Sweep};
use asunder_geometry::{Aabb3, Ray3, glam::Vec3};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use std::time::Instant;

const COUNT: usize = 20_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut pairs = Vec::new();

    // Everything moves: a sweep from scratch each frame. The filter is called for overlapping boxes only; here it drops
    // pairs of two odd-numbered boxes.
    let mut gas = MovingBoxes::new(BoxScene::Gas, COUNT, 1);
    let mut sweep = Sweep::new();
    let mut timed = Vec::new();
    for _ in 0..20 {
        gas.step();
        let start = Instant::now();
        sweep.pairs(&gas.boxes, |a, b| a % 2 == 0 || b % 2 == 0, 1_000_000, &mut pairs)?;
        timed.push(start.elapsed());
    }
    println!("{COUNT} boxes, all moving: {} pairs, {:?} a frame", pairs.len(), median(&mut timed));

    // Few boxes move, and we know which: resting boxes cost nothing.
    let mut still = MovingBoxes::new(BoxScene::Static1, COUNT, 1);
    let mut coherent = CoherentSweep::new();
    let mut timed = Vec::new();
    for _ in 0..20 {
        still.step();
        let start = Instant::now();
        coherent.update(&still.boxes, still.moved(), |_, _| true, 1_000_000, &mut pairs)?;
        timed.push(start.elapsed());
    }
    let moved = still.moved().len();
    println!("{COUNT} boxes, {moved} moving: {} pairs, {:?} a frame", pairs.len(), median(&mut timed));

    // Queries on boxes that rest.
    let mut index = Index::new();
    index.build(&still.boxes);
    let mut met = Vec::new();
    index.overlapping(&Aabb3::new(Vec3::splat(-2.0), Vec3::splat(2.0)), &mut met);
    println!("a cube of 4 m in the middle meets {} boxes: {met:?}", met.len());
    let ray = Ray3::new(Vec3::new(-200.0, 0.1, 0.2), Vec3::X)?;
    let mut crossed = Vec::new();
    index.crossed(&Cast::from(ray), 1000.0, &mut crossed);
    for found in crossed.iter().take(3) {
        println!("the ray enters box {} after {:.2} m", found.number, found.distance);
    }
    Ok(())
}

fn median(times: &mut [std::time::Duration]) -> std::time::Duration {
    times.sort_unstable();
    times[times.len() / 2]
}
