//! A city of fixed boxes with some traffic.

use super::Replay3;
use super::motion::Motion3;
use crate::pairs::{SolidKind, cuboid, solids};
use crate::random::Random;
use crate::turn::Turn;
use glam::{DVec3, Vec3};

/// Metres between neighbouring streets.
const BLOCK: f64 = 20.0;

/// One body of `one_of` moves, and at least one: traffic along the streets between buildings on square lots, one box a
/// lot.
pub(super) fn streets(count: usize, one_of: usize, seed: u64) -> Replay3 {
    let mut random = Random::new(seed ^ 0xc177);
    let mut replay = Replay3::default();
    let movers = (count.saturating_sub(1) / one_of.max(1)).max(1);
    let lots = count.saturating_sub(1 + movers);
    let side = ((lots as f64).sqrt().ceil() as usize).max(1);
    let half = 0.5 * BLOCK * side as f64;
    let floor = Vec3::new(half as f32 + 10.0, 1.0, half as f32 + 10.0);
    replay.fixed(cuboid(floor), Motion3::still(DVec3::new(0.0, -1.0, 0.0)));
    for lot in 0..lots {
        let place = DVec3::new((lot % side) as f64 + 0.5, 0.0, (lot / side) as f64 + 0.5) * BLOCK;
        let size = random.within(DVec3::new(6.9, 2.0, 6.9), DVec3::new(7.2, 25.0, 7.2));
        let middle = place + DVec3::new(-half, size.y - 0.1, -half);
        // Askew, so that their AABBs reach into the streets.
        let turn = Turn::about(DVec3::Y, random.range(-0.78, 0.78));
        replay.fixed(cuboid(size.as_vec3()), Motion3::still(middle).turned(turn));
    }
    traffic(&mut replay, movers, side, seed, &mut random);
    replay
}

/// Bodies that follow a street back and forth. Three of ten drive on the ground; the others fly, and rotate as they go.
fn traffic(replay: &mut Replay3, count: usize, side: usize, seed: u64, random: &mut Random) {
    let shapes = solids(SolidKind::Hull16, 16, seed);
    let half = 0.5 * BLOCK * side as f64;
    for i in 0..count {
        let street = random.below(side + 1) as f64 * BLOCK - half;
        let (lane, along) = (random.range(-1.8, 1.8), random.range(-half, half));
        let drives = i % 10 < 3;
        let height = if drives { 0.699 } else { random.range(0.8, 6.0) };
        let speed = random.range(3.0, 15.0);
        let runs_along_x = i % 2 == 0;
        let on_axes = |along: f64, across: f64, up: f64| {
            if runs_along_x { DVec3::new(along, up, across) } else { DVec3::new(across, up, along) }
        };
        let mut motion = Motion3::still(on_axes(along, street + lane, height));
        motion.velocity = on_axes(speed, 0.0, 0.0);
        motion.low = on_axes(-half, f64::NEG_INFINITY, f64::NEG_INFINITY);
        motion.high = on_axes(half, f64::INFINITY, f64::INFINITY);
        if drives {
            let size = on_axes(2.1, 0.9, 0.7).as_vec3();
            replay.moving(cuboid(size), motion, None);
        } else {
            (motion.turn, motion.axis, motion.spin) =
                (random.turn(), random.direction(), random.range(0.5, 2.0));
            replay.moving(shapes[i % shapes.len()].clone(), motion, None);
        }
    }
}
