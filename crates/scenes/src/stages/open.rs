//! Wide scenes in which a solver moves few of the bodies or none.

use super::{Driver, Path3, Scene3};
use crate::pairs::{SolidKind, cuboid, solids};
use crate::random::Random;
use crate::turn::Turn;
use crate::worlds::{Replay3, WorldScene};
use asunder_geometry::Sphere;
use glam::{DVec3, Vec3};

/// Metres from one box of the landscape to the next.
const TILE: f64 = 2.0;
/// The number of boxes in the landscape for each body that moves.
const ONE_OF: usize = 10_000;

/// Blocks whose tops are uneven by about a hand, and bodies that fall on them and roll.
pub(super) fn large_world(size: usize, seed: u64) -> Scene3 {
    let mut random = Random::new(seed ^ 0x1a46e);
    let mut scene = Scene3::empty();
    let side = ((size as f64).sqrt().ceil() as usize).max(1);
    let half = 0.5 * TILE * side as f64;
    let block = cuboid(Vec3::new(0.5 * TILE as f32, 1.0, 0.5 * TILE as f32));
    for i in 0..size.max(1) {
        let cell = DVec3::new((i % side) as f64 + 0.5, 0.0, (i / side) as f64 + 0.5) * TILE;
        let top = random.range(-0.1, 0.0);
        scene.fixed(block.clone(), cell + DVec3::new(-half, top - 1.0, -half), Turn::IDENTITY);
    }
    let rocks = solids(SolidKind::Hull16, 16, seed);
    let ball = Sphere::new(0.5).expect("a radius in range").into();
    for i in 0..(size / ONE_OF).max(1) {
        let inner = (half - 20.0).max(0.2 * half);
        let place = random.within(DVec3::new(-inner, 1.5, -inner), DVec3::new(inner, 4.0, inner));
        let shape = match i % 3 {
            0 => cuboid(Vec3::splat(0.5)),
            1 => rocks[random.below(rocks.len())].clone(),
            _ => Clone::clone(&ball),
        };
        let along = random.direction() * DVec3::new(1.0, 0.0, 1.0);
        scene.free(shape, place, random.turn()).linear_velocity = along * 4.0;
    }
    scene
}

/// The walkers of [`WorldScene::Crowd`], as driven bodies.
pub(super) fn crowd(size: usize, seed: u64) -> Scene3 {
    let walkers = Replay3::new(WorldScene::Crowd, size + 1, seed);
    let mut scene = Scene3::empty();
    for body in &walkers.bodies {
        scene.level.bodies.push(super::body(body.shape.clone(), body.pose, body.fixed));
    }
    for (&body, motion) in walkers.movers().iter().zip(walkers.motions()) {
        scene.drivers.push(Driver { body, path: Path3::walking(motion.clone()) });
        scene.owners.extend(walkers.bodies[body as usize].owner.map(|owner| (body, owner)));
    }
    scene
}
