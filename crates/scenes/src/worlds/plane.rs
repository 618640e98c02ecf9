//! The worlds in the plane.

use super::motion::Motion2;
use super::piles::{PYRAMID, pyramid_places};
use super::{Body2, Replay2};
use crate::pairs::{PlaneKind, polygons, rect};
use crate::random::Random;
use asunder_geometry::Shape2;
use core::f64::consts::TAU;
use glam::{DVec2, Vec2};

impl Replay2 {
    fn push(&mut self, shape: Shape2, motion: Motion2, fixed: bool, moves: bool) {
        let pose = motion.pose_at(0);
        if moves {
            self.movers.push(self.bodies.len() as u32);
            self.motions.push(motion);
        }
        self.bodies.push(Body2 { shape, pose, velocity: Vec2::ZERO, fixed, sensor: false, owner: None });
    }
}

/// As many whole pyramids as there are boxes for, side by side on one floor.
pub(super) fn pyramids(count: usize, seed: u64) -> Replay2 {
    let mut random = Random::new(seed ^ 0x97a2);
    let mut replay = Replay2::default();
    let pyramids = (count.saturating_sub(1) / PYRAMID.0).max(1);
    let floor = rect(Vec2::new(pyramids as f32 * 12.5, 1.0));
    let still = Motion2::swaying(DVec2::new(0.0, -1.0), 0.0, &mut random);
    replay.push(floor, still, true, false);
    let shape = rect(Vec2::splat(0.5));
    for pyramid in 0..pyramids {
        let left = (pyramid as f64 - 0.5 * (pyramids as f64 - 1.0)) * 25.0;
        for (x, y) in pyramid_places() {
            let motion = Motion2::swaying(DVec2::new(left + x, y), 2e-5, &mut random);
            replay.push(shape.clone(), motion, false, true);
        }
    }
    replay
}

/// Rectangles and polygons in the air on a loose lattice. Every other one rotates, and drifts back and forth.
pub(super) fn mixed(count: usize, seed: u64) -> Replay2 {
    let mut random = Random::new(seed ^ 0x3132);
    let kinds = [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64];
    let shapes: Vec<Shape2> = kinds.iter().flat_map(|&kind| polygons(kind, 16, seed)).collect();
    let mut replay = Replay2::default();
    let side = ((count as f64).sqrt().ceil() as usize).max(1);
    for i in 0..count {
        let stray = DVec2::new(random.range(-0.1, 0.1), random.range(-0.1, 0.1));
        let place = DVec2::new((i % side) as f64, (i / side) as f64) * 1.12 + stray;
        let shape = shapes[random.below(shapes.len())].clone();
        let mut motion = Motion2::swaying(place, 0.15, &mut random);
        motion.angle = random.range(0.0, TAU);
        motion.spin = random.range(0.2, 2.0);
        replay.push(shape, motion, false, i % 2 == 0);
    }
    replay
}
