//! Characters that walk in a yard.

use super::Replay3;
use super::motion::Motion3;
use crate::pairs::{cuboid, prism};
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::Shape3;
use glam::{DVec3, Vec3};

/// Parts per character.
const PARTS: usize = 19;

/// Metres between neighbouring characters.
const SPACING: f64 = 0.6;

/// One part: its shape, its centre relative to the ground under the character, and how far it swings forward.
struct Part {
    shape: Shape3,
    middle: DVec3,
    swing: f64,
}

/// As many whole characters as there are bodies for, on one floor.
pub(super) fn walkers(count: usize, seed: u64) -> Replay3 {
    let mut random = Random::new(seed ^ 0xc20d);
    let characters = (count.saturating_sub(1) / PARTS).max(1);
    let side = (characters as f64).sqrt().ceil() as usize;
    let half = 0.5 * SPACING * side as f64;
    let corner = DVec3::new(half, 0.0, half);
    let mut replay = Replay3::default();
    let floor = Vec3::new(half as f32 + 2.0, 0.5, half as f32 + 2.0);
    replay.fixed(cuboid(floor), Motion3::still(DVec3::new(0.0, -0.5, 0.0)));
    let parts = parts();
    for character in 0..characters {
        let cell = DVec3::new((character % side) as f64 + 0.5, 0.0, (character / side) as f64 + 0.5);
        let stray = random.within(DVec3::new(-0.04, 0.0, -0.04), DVec3::new(0.04, 0.0, 0.04));
        let root = cell * SPACING + stray - corner;
        // All go the same way, as in a street: crossing paths would lead through one another.
        let heading = random.range(-0.1, 0.1);
        let ahead = DVec3::new(libm::sin(heading), 0.0, libm::cos(heading));
        let turn = Turn::about(DVec3::Y, heading);
        let (speed, phase, period) = (random.range(1.3, 1.4), random.unit(), random.range(50.0, 70.0));
        for part in &parts {
            let mut motion = Motion3::still(root).turned(turn);
            motion.velocity = ahead * speed;
            (motion.low, motion.high) = (-corner, corner);
            motion.offset = turn.apply(part.middle);
            motion.swing = ahead * part.swing;
            (motion.period, motion.phase) = (period, phase);
            replay.moving(part.shape.clone(), motion, Some(character as u64 + 1));
        }
    }
    replay
}

/// A body 1.8 m high that faces along z: trunk and head, then both arms and legs.
fn parts() -> Vec<Part> {
    let boxed = |half: [f32; 3], middle: [f64; 3], swing: f64| Part {
        shape: cuboid(Vec3::from(half)),
        middle: DVec3::from(middle),
        swing,
    };
    let round = |radius: f64, half_height: f64, middle: [f64; 3], swing: f64| Part {
        shape: prism(8, radius, half_height),
        middle: DVec3::from(middle),
        swing,
    };
    let mut parts = vec![
        boxed([0.16, 0.09, 0.11], [0.0, 0.96, 0.0], 0.0),
        boxed([0.14, 0.07, 0.10], [0.0, 1.10, 0.0], 0.0),
        boxed([0.16, 0.08, 0.11], [0.0, 1.24, 0.0], 0.0),
        boxed([0.18, 0.09, 0.12], [0.0, 1.39, 0.0], 0.0),
        round(0.10, 0.13, [0.0, 1.66, 0.02], 0.0),
    ];
    for side in [-1.0, 1.0] {
        let swing = 0.1 * side;
        parts.push(boxed([0.06, 0.05, 0.06], [side * 0.22, 1.42, 0.0], 0.0));
        parts.push(round(0.05, 0.14, [side * 0.25, 1.25, 0.0], 0.5 * swing));
        parts.push(round(0.04, 0.13, [side * 0.26, 0.98, 0.03], swing));
        parts.push(boxed([0.02, 0.08, 0.04], [side * 0.26, 0.80, 0.05], 1.2 * swing));
        parts.push(round(0.08, 0.20, [side * 0.10, 0.69, 0.0], -0.5 * swing));
        parts.push(round(0.055, 0.20, [side * 0.10, 0.29, 0.0], -swing));
        // The soles are 0.5 mm below the floor.
        parts.push(boxed([0.05, 0.035, 0.13], [side * 0.10, 0.0345, 0.05], -1.2 * swing));
    }
    debug_assert_eq!(parts.len(), PARTS);
    parts
}
