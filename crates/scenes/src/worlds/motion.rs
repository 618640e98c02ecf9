//! Motion in closed form: a pose does not depend on the frames before.

use crate::pairs::pose2;
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::Pose2;
use core::f64::consts::TAU;
use glam::{DVec2, DVec3};

/// Seconds a frame.
const STEP: f64 = 1.0 / 60.0;

/// A root moves straight through a room and turns back at its walls. The body is at an offset from the root, swings
/// about that place, and spins.
#[derive(Clone, Debug)]
pub(crate) struct Motion3 {
    pub(super) root: DVec3,
    /// Metres a second.
    pub(super) velocity: DVec3,
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    pub(super) offset: DVec3,
    /// Amplitude, in metres.
    pub(super) swing: DVec3,
    /// Frames for one swing back and forth.
    pub(super) period: f64,
    /// Where in the swing frame 0 is, from 0 to 1.
    pub(super) phase: f64,
    pub(super) turn: Turn,
    pub(super) axis: DVec3,
    /// Radians a second about the axis.
    pub(super) spin: f64,
}

impl Motion3 {
    pub(super) fn still(root: DVec3) -> Self {
        Self {
            root,
            velocity: DVec3::ZERO,
            low: DVec3::NEG_INFINITY,
            high: DVec3::INFINITY,
            offset: DVec3::ZERO,
            swing: DVec3::ZERO,
            period: 60.0,
            phase: 0.0,
            turn: Turn::IDENTITY,
            axis: DVec3::Y,
            spin: 0.0,
        }
    }

    pub(super) fn turned(mut self, turn: Turn) -> Self {
        self.turn = turn;
        self
    }

    /// A swing in a random direction, of random period and phase.
    pub(super) fn swaying(mut self, amplitude: f64, random: &mut Random) -> Self {
        self.swing = random.direction() * amplitude;
        self.period = random.range(20.0, 90.0);
        self.phase = random.unit();
        self
    }

    pub(crate) fn at(&self, frame: u32) -> (DVec3, Turn) {
        let time = f64::from(frame) * STEP;
        let flown = self.root + self.velocity * time;
        let root = DVec3::new(
            fold(flown.x, self.low.x, self.high.x),
            fold(flown.y, self.low.y, self.high.y),
            fold(flown.z, self.low.z, self.high.z),
        );
        let swung = self.swing * triangle(f64::from(frame) / self.period + self.phase);
        let turn = if self.spin == 0.0 {
            self.turn
        } else {
            Turn::about(self.axis, self.spin * time).after(self.turn)
        };
        (root + self.offset + swung, turn)
    }
}

/// The twin of [`Motion3`] in the plane, without a room: bodies that drift turn back because they swing.
#[derive(Clone, Debug)]
pub(super) struct Motion2 {
    pub(super) root: DVec2,
    /// Amplitude, in metres.
    pub(super) swing: DVec2,
    pub(super) period: f64,
    pub(super) phase: f64,
    pub(super) angle: f64,
    /// Radians a second.
    pub(super) spin: f64,
}

impl Motion2 {
    pub(super) fn swaying(root: DVec2, amplitude: f64, random: &mut Random) -> Self {
        let way = TAU * random.unit();
        Self {
            root,
            swing: DVec2::new(libm::cos(way), libm::sin(way)) * amplitude,
            period: random.range(20.0, 90.0),
            phase: random.unit(),
            angle: 0.0,
            spin: 0.0,
        }
    }

    pub(super) fn pose_at(&self, frame: u32) -> Pose2 {
        let swung = self.swing * triangle(f64::from(frame) / self.period + self.phase);
        pose2(self.root + swung, self.angle + self.spin * f64::from(frame) * STEP)
    }
}

/// A triangle wave between -1 and 1, of period 1.
fn triangle(x: f64) -> f64 {
    4.0 * (x - x.floor() - 0.5).abs() - 1.0
}

/// A coordinate reflected at both ends of a range.
fn fold(x: f64, low: f64, high: f64) -> f64 {
    let width = high - low;
    if !width.is_finite() || width <= 0.0 {
        return x;
    }
    let t = (x - low).rem_euclid(2.0 * width);
    low + if t > width { 2.0 * width - t } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motion_stays_in_its_room_and_is_continuous() {
        let mut random = Random::new(1);
        let mut motion = Motion3::still(DVec3::splat(0.5)).swaying(0.1, &mut random);
        (motion.low, motion.high) = (DVec3::ZERO, DVec3::ONE);
        motion.velocity = DVec3::new(3.0, -2.0, 0.5);
        let mut last = motion.at(0).0;
        for frame in 1..600 {
            let next = motion.at(frame).0;
            assert!((next - DVec3::splat(0.5)).abs().max_element() <= 0.6 + 1e-12);
            assert!((next - last).length() < 0.1);
            last = next;
        }
    }
}
