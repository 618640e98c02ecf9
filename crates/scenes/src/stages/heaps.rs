//! Heaps: in a pit, pushed about by a wall, tumbled in a drum.

use super::stacks::on_a_floor;
use super::{Path3, Scene3};
use crate::pairs::{SolidKind, cuboid, solids};
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::Shape3;
use core::f64::consts::{PI, SQRT_2, TAU};
use glam::{DVec3, Vec3};

/// The number of different hulls in a heap; the clones share their data.
const DISTINCT: usize = 64;

/// Half of a wall's thickness, in metres.
const WALL: f64 = 1.0;

/// Layers of 16 by 16, as many as needed.
pub(super) fn convex_pile(size: usize, seed: u64) -> Scene3 {
    let mut random = Random::new(seed ^ 0xc0_9173);
    let shapes = solids(SolidKind::Hull32, DISTINCT, seed);
    let side = (libm::cbrt(size as f64 * 0.8).ceil() as usize).max(1);
    let half = 0.5 * 1.3 * side as f64 + 0.5;
    let high = 1.3 * (size.div_ceil(side * side) + 2) as f64;
    let mut scene = on_a_floor(half + 2.0 * WALL, half + 2.0 * WALL);
    walls(&mut scene, DVec3::new(half, 0.5 * high, half));
    lattice(&mut scene, size, [side, side], |scene, cell| {
        let stray = random.within(DVec3::splat(-0.05), DVec3::splat(0.05));
        let shape = shapes[random.below(shapes.len())].clone();
        scene.free(shape, cell * 1.3 + stray + DVec3::Y, random.turn());
    });
    scene.room = (DVec3::new(-half, 0.0, -half), DVec3::new(half, 2.0 * high, half));
    scene
}

/// Layers of 21 by 21, for a heap three times as long as high; the wall comes from the left.
pub(super) fn junkyard(size: usize, seed: u64) -> Scene3 {
    let mut random = Random::new(seed ^ 0x91a4d);
    let shapes = solids(SolidKind::Hull16, DISTINCT, seed);
    let side = (libm::cbrt(size as f64 * 0.875).ceil() as usize).max(1);
    let half = 0.5 * 1.2 * side as f64 + 0.5;
    let high = 1.2 * (size.div_ceil(side * side) + 2) as f64;
    // Room on the right for the heap to slump into.
    let yard = DVec3::new(2.0 * half, 0.5 * high, half);
    let mut scene = on_a_floor(yard.x + 4.0 * WALL, yard.z + 2.0 * WALL);
    walls(&mut scene, yard);
    let wall = cuboid(DVec3::new(WALL, 0.5 * high, yard.z - 0.05).as_vec3());
    let from = DVec3::new(-yard.x - WALL + 0.5, 0.5 * high, 0.0);
    scene.driven(wall, Path3::pushing(from, DVec3::X * half, 2.4 * half));
    lattice(&mut scene, size, [side, side], |scene, cell| {
        let stray = random.within(DVec3::splat(-0.05), DVec3::splat(0.05));
        let shape = shapes[random.below(shapes.len())].clone();
        let place = cell * 1.2 + stray + DVec3::new(1.0 - half, 1.0, 0.0);
        scene.free(shape, place, random.turn());
    });
    scene.room = (DVec3::new(-yard.x, 0.0, -yard.z), DVec3::new(yard.x, 2.0 * high, yard.z));
    scene
}

/// Staves around a drum.
const STAVES: usize = 32;
/// Radians a second: 25 degrees.
const DRUM_SPEED: f64 = 25.0 * PI / 180.0;
/// How far every fourth stave's fin stands out, in metres.
const FIN: f64 = 1.0;

/// A drum of cuboid staves that turns about z between two walls.
pub(super) fn washer(size: usize, seed: u64) -> Scene3 {
    let mut random = Random::new(seed ^ 0x3a5e4);
    let side = (libm::cbrt(size as f64).ceil() as usize).max(1);
    let half = 0.5 * 0.6 * side as f64;
    let (radius, long) = (half * SQRT_2 + FIN + 0.5, half + 0.5);
    let mut scene = Scene3::empty();
    let tangent = radius * libm::tan(PI / STAVES as f64) + WALL;
    let stave = cuboid(DVec3::new(WALL, tangent, long + WALL).as_vec3());
    let fin = cuboid(DVec3::new(0.5 * FIN, 0.15, long).as_vec3());
    for i in 0..STAVES {
        let turn = Turn::about(DVec3::Z, TAU * i as f64 / STAVES as f64);
        let mut drive = |shape: &Shape3, distance: f64| {
            let place = turn.apply(DVec3::X * distance);
            scene.driven(shape.clone(), Path3::turning(place, turn, DVec3::Z, DRUM_SPEED));
        };
        drive(&stave, radius + WALL);
        if i % 4 == 0 {
            drive(&fin, radius - 0.5 * FIN);
        }
    }
    let plate = cuboid(DVec3::new(radius, radius, WALL).as_vec3());
    for end in [-1.0, 1.0] {
        scene.fixed(plate.clone(), DVec3::Z * end * (long + WALL), Turn::IDENTITY);
    }
    let shape = cuboid(Vec3::splat(0.25));
    lattice(&mut scene, size, [side, side], |scene, cell| {
        let stray = random.within(DVec3::splat(-0.02), DVec3::splat(0.02));
        scene.free(shape.clone(), cell * 0.6 + stray - DVec3::Y * (half - 0.3), Turn::IDENTITY);
    });
    // The box around the circle in which the staves turn.
    let out = DVec3::new(radius + 0.5, radius + 0.5, long + 0.1);
    scene.room = (-out, out);
    scene
}

/// Four walls around a floor; `inside` holds half the inner sizes, and half the height.
fn walls(scene: &mut Scene3, inside: DVec3) {
    for side in [-1.0, 1.0] {
        let across_x = cuboid(DVec3::new(WALL, inside.y, inside.z + 2.0 * WALL).as_vec3());
        scene.fixed(across_x, DVec3::new(side * (inside.x + WALL), inside.y, 0.0), Turn::IDENTITY);
        let across_z = cuboid(DVec3::new(inside.x, inside.y, WALL).as_vec3());
        scene.fixed(across_z, DVec3::new(0.0, inside.y, side * (inside.z + WALL)), Turn::IDENTITY);
    }
}

/// Calls `place` for so many cells, layer by layer, with positions in cells: centred on zero sideways, from zero
/// upwards.
fn lattice(
    scene: &mut Scene3,
    count: usize,
    [wide, deep]: [usize; 2],
    mut place: impl FnMut(&mut Scene3, DVec3),
) {
    for i in 0..count {
        let (x, y, z) = (i % wide, i / (wide * deep), i / wide % deep);
        let middle = DVec3::new(wide as f64 - 1.0, 0.0, deep as f64 - 1.0) * 0.5;
        place(scene, DVec3::new(x as f64, y as f64, z as f64) - middle);
    }
}
