//! Heaps that fall into a pit, stepped once and kept as poses, so that benchmarks of collision alone can replay them.

use crate::game::Game;
use crate::opened::volume;
use crate::report::STEP;
use asunder::{Collider3, Pose3, Volume};
use asunder_scenes::level::LevelBody3;
use asunder_scenes::stages::Falling;
use asunder_scenes::worlds::{Body3, Replay3};
use std::error::Error;

/// Frames that are kept after the one at which the recording begins.
pub const FRAMES: u32 = 60;

/// Steps a heap until enough of it has fallen into the pit, then records every body's pose there and in the next
/// [`FRAMES`] frames. Equal arguments give equal bits, on any number of threads. Nothing sleeps: all bodies move in
/// every frame.
///
/// Cost: that of 85 steps, four seconds for the usual 8,005 boxes.
///
/// # Errors
/// A body without mass, which no such scene has.
///
/// ```
/// use asunder_examples::falling::recorded;
/// use asunder_scenes::stages::Falling;
/// let mut heap = recorded(Falling::Boxes, 69, 1)?;
/// let highest = |heap: &asunder_scenes::worlds::Replay3| {
///     let bodies = heap.bodies.iter().filter(|body| !body.fixed);
///     bodies.map(|body| body.pose.position().y).fold(0.0, f64::max)
/// };
/// let before = highest(&heap);
/// heap.advance(60);
/// assert!(highest(&heap) < before);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn recorded(falling: Falling, count: usize, seed: u64) -> Result<Replay3, Box<dyn Error>> {
    let scene = falling.above_pit(count, seed);
    let mut game = volume(&scene)?;
    game.sleeps = false;
    game.update();
    (0..falling.first_frame()).for_each(|_| game.step(STEP));
    let bodies = scene.level.bodies.iter().enumerate();
    let bodies = bodies.filter_map(|(number, body)| seen(&game, number, body)).collect();
    let mut frames = vec![poses(&game)];
    for _ in 0..FRAMES {
        game.step(STEP);
        frames.push(poses(&game));
    }
    Ok(Replay3::recorded(bodies, frames))
}

/// A body as it is now; `None` for one that has left the level, which no body in a pit does.
fn seen(game: &Game<Volume>, number: usize, body: &LevelBody3) -> Option<Body3> {
    let pose = *collider(game, number)?.pose();
    let (shape, fixed, sensor) = (body.shape.clone(), body.fixed, body.sensor);
    let velocity = game.stepper.bodies()[number].velocity.as_vec3();
    Some(Body3 { shape, pose, velocity, fixed, sensor, owner: None })
}

/// The poses of all bodies that are not fixed.
fn poses(game: &Game<Volume>) -> Vec<Pose3> {
    let bodies = (0..game.len()).filter_map(|number| collider(game, number));
    bodies.filter(|body| !body.is_fixed()).map(|body| *body.pose()).collect()
}

fn collider(game: &Game<Volume>, number: usize) -> Option<&Collider3> {
    game.stepper.world.get(game.key(number)?)
}
