//! Boxes and pentagons in the plane.

use super::stacks::{base_of, pyramid_places, small_pyramids};
use super::{Path2, Scene2};
use crate::pairs::rect;
use crate::random::Random;
use asunder_geometry::{Polygon, Shape2};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use glam::{DVec2, Vec2};

/// Half of a wall's thickness, in metres.
const WALL: f64 = 1.0;

pub(super) fn pyramid(size: usize) -> Scene2 {
    let base = base_of(size);
    let mut scene = on_a_floor(0.6 * base as f64 + 10.0);
    // In the plane it cannot lean over: it needs only what holds its lowest rows still.
    scene.feel.substeps = if base > 40 { 12 } else { 8 };
    let shape = rect(Vec2::splat(0.5));
    for (x, y) in pyramid_places(base) {
        scene.free(shape.clone(), DVec2::new(x, y), 0.0);
    }
    scene
}

pub(super) fn many_pyramids(size: usize) -> Scene2 {
    let (base, count, _) = small_pyramids(size);
    let step = 1.1 * (base + 1) as f64;
    let mut scene = on_a_floor(0.5 * step * count as f64);
    let shape = rect(Vec2::splat(0.5));
    for pyramid in 0..count {
        let left = (pyramid as f64 - 0.5 * (count as f64 - 1.0)) * step;
        for (x, y) in pyramid_places(base) {
            scene.free(shape.clone(), DVec2::new(left + x, y), 0.0);
        }
    }
    scene
}

/// Radians a second: 25 degrees.
const TUMBLER_SPEED: f64 = 25.0 * PI / 180.0;

/// Boxes of half a metre in a square of four walls that turns about its centre.
pub(super) fn tumbler(size: usize, seed: u64) -> Scene2 {
    let mut random = Random::new(seed ^ 0x707b1);
    let side = ((size as f64).sqrt().ceil() as usize).max(1);
    let half = 0.5 * 0.6 * side as f64 + 2.0;
    let mut scene = Scene2::empty();
    let wall = rect(DVec2::new(WALL, half + 2.0 * WALL).as_vec2());
    for i in 0..4 {
        let angle = FRAC_PI_2 * f64::from(i);
        let place = DVec2::new(libm::cos(angle), libm::sin(angle)) * (half + WALL);
        scene.driven(wall.clone(), Path2::turning(place, angle, TUMBLER_SPEED));
    }
    let shape = rect(Vec2::splat(0.25));
    grid(size, side, |cell| {
        let stray = DVec2::new(random.range(-0.03, 0.03), random.range(-0.03, 0.03));
        let middle = DVec2::new(0.0, 0.5 * (side as f64 - 1.0));
        scene.free(shape.clone(), (cell - middle) * 0.6 + stray, 0.0);
    });
    let corner = DVec2::splat((half + WALL) * core::f64::consts::SQRT_2);
    scene.room = (-corner, corner);
    scene
}

pub(super) fn junkyard(size: usize, seed: u64) -> Scene2 {
    let mut random = Random::new(seed ^ 0x91a42);
    let side = ((size as f64 * 2.0).sqrt().ceil() as usize).max(1);
    let half = 0.5 * 1.05 * side as f64 + 0.5;
    let high = 1.05 * (size.div_ceil(side) + 4) as f64;
    let mut scene = pit(DVec2::new(1.5 * half, 0.5 * high));
    let wall = rect(DVec2::new(WALL, 0.5 * high).as_vec2());
    let from = DVec2::new(-1.5 * half - WALL + 0.5, 0.5 * high);
    scene.driven(wall, Path2::pushing(from, DVec2::X * half, 2.4 * half));
    let pentagons: Vec<Shape2> = (0..8).map(|i| pentagon(0.35 + 0.02 * f64::from(i))).collect();
    grid(size, side, |cell| {
        let stray = DVec2::new(random.range(-0.02, 0.02), random.range(-0.02, 0.02));
        let shape = pentagons[random.below(pentagons.len())].clone();
        let place = cell * 1.05 + stray + DVec2::new(0.4 * half, 0.6);
        scene.free(shape, place, random.range(0.0, TAU));
    });
    scene
}

fn pentagon(radius: f64) -> Shape2 {
    let corner = |i: i32| {
        let angle = TAU * f64::from(i) / 5.0;
        (DVec2::new(libm::cos(angle), libm::sin(angle)) * radius).as_vec2()
    };
    let points: Vec<Vec2> = (0..5).map(corner).collect();
    Polygon::hull_of(&points).expect("five corners in range").into()
}

/// A floor with its top at zero, which extends by `reach` to each side.
fn on_a_floor(reach: f64) -> Scene2 {
    let mut scene = Scene2::empty();
    scene.fixed(rect(DVec2::new(reach, 1.0).as_vec2()), DVec2::NEG_Y, 0.0);
    scene
}

/// A floor and two walls; `inside` holds half the inner sizes.
pub(super) fn pit(inside: DVec2) -> Scene2 {
    let mut scene = on_a_floor(inside.x + 2.0 * WALL);
    let wall = rect(DVec2::new(WALL, inside.y).as_vec2());
    for side in [-1.0, 1.0] {
        scene.fixed(wall.clone(), DVec2::new(side * (inside.x + WALL), inside.y), 0.0);
    }
    scene.room = (DVec2::new(-inside.x, 0.0), DVec2::new(inside.x, 4.0 * inside.y));
    scene
}

/// Calls `place` for so many cells, row by row, with positions in cells: centred on zero sideways, from zero upwards.
pub(super) fn grid(count: usize, wide: usize, mut place: impl FnMut(DVec2)) {
    for i in 0..count {
        place(DVec2::new((i % wide) as f64 - 0.5 * (wide as f64 - 1.0), (i / wide) as f64));
    }
}
