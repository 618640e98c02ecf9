//! Rocks that drift in a closed room, and bullets among them.

use super::Scene2;
use super::plane::grid;
use crate::pairs::rect;
use crate::random::Random;
use asunder_geometry::{Circle, Polygon, Shape2};
use core::f64::consts::TAU;
use glam::{DVec2, Vec2};

/// Metres from rock to rock.
const CELL: f64 = 4.0;
/// Rocks for each bullet.
const ONE_OF: usize = 10;
/// Metres a second.
const BULLET_SPEED: f64 = 200.0;

pub(super) fn field(size: usize, seed: u64) -> Scene2 {
    let mut random = Random::new(seed ^ 0xa57e4);
    let mut scene = Scene2::empty();
    scene.level.gravity = DVec2::ZERO;
    (scene.feel.restitution, scene.feel.friction, scene.feel.spin_damping) = (0.7, 0.3, 0.0);
    let bullets = size / ONE_OF;
    let rocks = (size - bullets).max(1);
    let side = ((rocks as f64).sqrt().ceil() as usize).max(1);
    let half = 0.5 * CELL * side as f64 + 2.0;
    // Thin as sheets of steel: bullets must not pass them either.
    let thin = 0.05;
    for side in [-1.0, 1.0] {
        scene.fixed(upright(thin, half), DVec2::new(side * (half + thin), 0.0), 0.0);
        let lying = rect(DVec2::new(half + 2.0 * thin, thin).as_vec2());
        scene.fixed(lying, DVec2::new(0.0, side * (half + thin)), 0.0);
    }
    let shapes: Vec<Shape2> = (0..32).map(|_| rock(&mut random)).collect();
    grid(rocks, side, |cell| {
        let stray = DVec2::new(random.range(-0.5, 0.5), random.range(-0.5, 0.5));
        let place = DVec2::new(cell.x, cell.y - 0.5 * (side as f64 - 1.0)) * CELL + stray;
        let shape = shapes[random.below(shapes.len())].clone();
        let velocity = DVec2::new(random.range(-3.0, 3.0), random.range(-3.0, 3.0));
        let body = scene.free(shape, place, random.range(0.0, TAU));
        (body.linear_velocity, body.angular_velocity) = (velocity, random.range(-1.0, 1.0));
    });
    let shot = Shape2::from(Circle::new(0.1).expect("a radius in range"));
    for _ in 0..bullets {
        scene.bullets.push(scene.level.bodies.len() as u32);
        let way = TAU * random.unit();
        // Between the rocks: at a corner where four cells meet.
        let corner = |random: &mut Random| (random.below(side) as f64 - 0.5 * side as f64) * CELL;
        let place = DVec2::new(corner(&mut random), corner(&mut random));
        scene.free(shot.clone(), place, 0.0).linear_velocity =
            DVec2::new(libm::cos(way), libm::sin(way)) * BULLET_SPEED;
    }
    scene.room = (DVec2::splat(-half), DVec2::splat(half));
    scene
}

fn upright(wide: f64, high: f64) -> Shape2 {
    rect(DVec2::new(wide, high).as_vec2())
}

/// A convex rock of 5 to 11 corners, 0.8 to 2.4 m wide.
fn rock(random: &mut Random) -> Shape2 {
    let (corners, radius) = (5 + random.below(7), random.range(0.4, 1.2));
    let mut corner = |i: usize| {
        let angle = TAU * (i as f64 + random.range(-0.3, 0.3)) / corners as f64;
        (DVec2::new(libm::cos(angle), libm::sin(angle)) * radius).as_vec2()
    };
    let points: Vec<Vec2> = (0..corners).map(&mut corner).collect();
    Polygon::hull_of(&points).expect("corners in order around a middle").into()
}
