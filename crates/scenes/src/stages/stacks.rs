//! Structures that should stand, or fall.

use super::Scene3;
use crate::pairs::cuboid;
use crate::turn::Turn;
use asunder_geometry::{Shape3, Sphere};
use core::f64::consts::FRAC_PI_2;
use glam::{DVec3, Vec3};

/// Metres between the centres of neighbours in a row of a pyramid of boxes of 1 m: because of the gap, neighbours have
/// no contact.
const PITCH: f64 = 1.05;
/// Boxes in the lowest row of each of many pyramids.
const SMALL_BASE: usize = 10;

/// The number of rows of the largest pyramid of at most `size` boxes; at least one.
pub(super) fn base_of(size: usize) -> usize {
    let mut base = 1;
    while (base + 1) * (base + 2) / 2 <= size {
        base += 1;
    }
    base
}

/// The substeps with which a pyramid stands still. It is a wall one box thick, and with springs as contacts a wall
/// buckles under its own weight. For a height h the frequency of the springs must grow as h to the 3/2 (Greenhill,
/// 1881), and so must the substep rate, of which it is a fixed share.
fn substeps_of(base: usize) -> u32 {
    let base = base as f64;
    (0.048 * base * base.sqrt()).round().clamp(8.0, 100.0) as u32
}

/// Centres of a pyramid's boxes of 1 m.
pub(super) fn pyramid_places(base: usize) -> impl Iterator<Item = (f64, f64)> {
    (0..base).flat_map(move |row| {
        let wide = base - row;
        (0..wide).map(move |i| ((i as f64 - 0.5 * (wide as f64 - 1.0)) * PITCH, row as f64 + 0.5))
    })
}

/// The base of each small pyramid, how many there are boxes for, and how many go in a row.
pub(super) fn small_pyramids(size: usize) -> (usize, usize, usize) {
    let boxes = SMALL_BASE * (SMALL_BASE + 1) / 2;
    let count = (size / boxes).max(1);
    (SMALL_BASE, count, (count as f64).sqrt().ceil() as usize)
}

pub(super) fn pyramid(size: usize) -> Scene3 {
    let base = base_of(size);
    let mut scene = on_a_floor(0.5 * PITCH * base as f64 + 2.0, 5.0);
    scene.feel.substeps = substeps_of(base);
    let shape = unit();
    for (x, y) in pyramid_places(base) {
        scene.free(shape.clone(), DVec3::new(x, y, 0.0), Turn::IDENTITY);
    }
    scene
}

pub(super) fn many_pyramids(size: usize) -> Scene3 {
    let (base, count, side) = small_pyramids(size);
    let step = DVec3::new(PITCH * (base + 1) as f64, 0.0, 3.0);
    let mut scene = on_a_floor(step.x * side as f64, step.z * side as f64);
    let shape = unit();
    for pyramid in 0..count {
        let cell = DVec3::new((pyramid % side) as f64, 0.0, (pyramid / side) as f64);
        let place = (cell - DVec3::new(0.5, 0.0, 0.5) * (side as f64 - 1.0)) * step;
        for (x, y) in pyramid_places(base) {
            scene.free(shape.clone(), place + DVec3::new(x, y, 0.0), Turn::IDENTITY);
        }
    }
    scene
}

pub(super) fn stack(size: usize) -> Scene3 {
    let mut scene = on_a_floor(5.0, 5.0);
    // With fewer, the top of the tower sways by a centimetre.
    scene.feel.substeps = 12;
    for i in 0..size.max(1) {
        scene.free(unit(), DVec3::new(0.0, i as f64 + 0.5, 0.0), Turn::IDENTITY);
    }
    scene
}

/// Half of a card's thickness, height and depth, in metres.
const CARD: Vec3 = Vec3::new(0.01, 0.5, 0.35);
/// How far a card leans, in radians.
const LEAN: f64 = 0.4;

/// Storeys of tents, each of two cards that lean on each other, and cards laid from tent to tent.
pub(super) fn card_house(size: usize) -> Scene3 {
    let mut storeys = 1;
    while (storeys + 1) * (3 * storeys + 4) / 2 <= size {
        storeys += 1;
    }
    let mut scene = on_a_floor(0.6 * storeys as f64 + 1.0, 2.0);
    scene.feel.substeps = 16;
    let card = cuboid(CARD);
    let (thick, high) = (f64::from(CARD.x), f64::from(CARD.y));
    let (sin, cos) = libm::sincos(LEAN);
    // A tent is as high as the outer corners of its cards' tops; cards that lie end to end have a gap of 2 mm.
    let (tent, storey) = (2.0 * (high * cos + thick * sin), 2.0 * (high * cos + thick * sin + thick));
    let pitch = 2.0 * high + 0.002;
    for level in 0..storeys {
        let (tents, floor) = (storeys - level, level as f64 * storey);
        for i in 0..tents {
            let middle = (i as f64 - 0.5 * (tents as f64 - 1.0)) * pitch;
            for side in [-1.0, 1.0] {
                // The inner corners of both tops meet over the middle of the tent.
                let place = DVec3::new(middle + side * (thick * cos + high * sin), floor + 0.5 * tent, 0.0);
                scene.free(card.clone(), place, Turn::about(DVec3::Z, side * LEAN));
            }
            if i + 1 < tents {
                let place = DVec3::new(middle + 0.5 * pitch, floor + tent + thick, 0.0);
                scene.free(card.clone(), place, Turn::about(DVec3::Z, FRAC_PI_2));
            }
        }
    }
    scene
}

/// Half of a brick, in metres.
const BRICK: Vec3 = Vec3::new(0.5, 0.25, 0.25);
/// Bricks in a course.
const COURSE: usize = 10;

/// Courses of bricks in running bond, closed by half bricks, and a ball that flies at them.
pub(super) fn brick_wall(size: usize) -> Scene3 {
    let mut scene = on_a_floor(15.0, 27.0);
    let (whole, half) = (cuboid(BRICK), cuboid(Vec3::new(0.5 * BRICK.x - 0.002, BRICK.y, BRICK.z)));
    let (wide, high) = (2.0 * f64::from(BRICK.x) + 0.004, 2.0 * f64::from(BRICK.y));
    let courses = (size / COURSE).max(1);
    for course in 0..courses {
        let y = (course as f64 + 0.5) * high;
        let left = -0.5 * wide * COURSE as f64;
        if course % 2 == 0 {
            for i in 0..COURSE {
                let place = DVec3::new(left + (i as f64 + 0.5) * wide, y, 0.0);
                scene.free(whole.clone(), place, Turn::IDENTITY);
            }
            continue;
        }
        for side in [-1.0, 1.0] {
            let place = DVec3::new(side * (-left - 0.25 * wide), y, 0.0);
            scene.free(half.clone(), place, Turn::IDENTITY);
        }
        for i in 1..COURSE {
            scene.free(whole.clone(), DVec3::new(left + i as f64 * wide, y, 0.0), Turn::IDENTITY);
        }
    }
    scene.bullets.push(scene.level.bodies.len() as u32);
    let ball = Sphere::new(0.6).expect("a radius in range").into();
    let place = DVec3::new(0.5, 0.5 * high * courses as f64, 25.0);
    scene.free(ball, place, Turn::IDENTITY).linear_velocity = DVec3::new(0.0, 2.0, -60.0);
    scene
}

/// Half extents of a domino, in metres: it falls along x.
const DOMINO: Vec3 = Vec3::new(0.08, 0.5, 0.25);

pub(super) fn dominoes(size: usize) -> Scene3 {
    // Each stands `step` from the last, on a spiral that widens by a pace a turn.
    let (step, opening, inner) = (0.5, 0.03, 3.0);
    let outer = inner + opening * size as f64 + 2.0;
    let mut scene = on_a_floor(outer, outer);
    let (shape, high) = (cuboid(DOMINO), f64::from(DOMINO.y));
    (scene.feel.friction, scene.feel.spin_damping) = (0.4, 0.1);
    let mut angle = 0.0;
    for i in 0..size.max(1) {
        let radius = inner + opening * i as f64;
        let (sin, cos) = libm::sincos(angle);
        let (place, ahead) = (DVec3::new(cos * radius, high, sin * radius), DVec3::new(-sin, 0.0, cos));
        let domino = scene.free(shape.clone(), place, Turn::between(DVec3::X, ahead));
        if i == 0 {
            domino.angular_velocity = DVec3::Y.cross(ahead) * 2.5;
            domino.linear_velocity = ahead * 2.5 * high;
        }
        angle += step / radius;
    }
    scene
}

/// A floor with its top at zero, which extends by x and z to each side.
pub(super) fn on_a_floor(x: f64, z: f64) -> Scene3 {
    let mut scene = Scene3::empty();
    let half = DVec3::new(x, 1.0, z);
    scene.fixed(cuboid(half.as_vec3()), DVec3::new(0.0, -1.0, 0.0), Turn::IDENTITY);
    scene
}

fn unit() -> Shape3 {
    cuboid(Vec3::splat(0.5))
}
