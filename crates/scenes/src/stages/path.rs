//! The poses of driven bodies, frame by frame, in closed form.

use crate::pairs::{pose2, pose3};
use crate::turn::Turn;
use crate::worlds::motion::Motion3;
use asunder_geometry::{Pose2, Pose3};
use core::f64::consts::TAU;
use glam::{DVec2, DVec3};

/// Frames a second.
const RATE: f64 = 60.0;

/// The pose of a body in the plane at each frame, of 1/60 s.
#[derive(Clone, Debug)]
pub struct Path2(Way2);

/// The pose of a body in space at each frame, of 1/60 s.
#[derive(Clone, Debug)]
pub struct Path3(Way3);

#[derive(Clone, Debug)]
enum Way2 {
    Turning { position: DVec2, angle: f64, speed: f64 },
    Pushing(Push<DVec2>),
}

#[derive(Clone, Debug)]
enum Way3 {
    Turning { position: DVec3, turn: Turn, axis: DVec3, speed: f64 },
    Pushing(Push<DVec3>),
    Walking(Motion3),
}

/// Back and forth between two places, slowly near both.
#[derive(Clone, Debug)]
struct Push<Vector> {
    from: Vector,
    reach: Vector,
    /// Seconds for the way there and back.
    period: f64,
}

impl<Vector> Push<Vector> {
    fn share_at(&self, frame: u32) -> f64 {
        0.5 - 0.5 * libm::cos(TAU * f64::from(frame) / (RATE * self.period))
    }
}

impl Path2 {
    /// Turns about the origin, at a speed in radians a second.
    pub(super) fn turning(position: DVec2, angle: f64, speed: f64) -> Self {
        Self(Way2::Turning { position, angle, speed })
    }

    pub(super) fn pushing(from: DVec2, reach: DVec2, period: f64) -> Self {
        Self(Way2::Pushing(Push { from, reach, period }))
    }

    /// The pose at a frame.
    pub fn pose_at(&self, frame: u32) -> Pose2 {
        match &self.0 {
            Way2::Turning { position, angle, speed } => {
                let by = speed * f64::from(frame) / RATE;
                let (sin, cos) = libm::sincos(by);
                pose2(DVec2::new(cos, sin).rotate(*position), angle + by)
            }
            Way2::Pushing(push) => pose2(push.from + push.reach * push.share_at(frame), 0.0),
        }
    }
}

impl Path3 {
    /// Turns about an axis through the origin, at a speed in radians a second.
    pub(super) fn turning(position: DVec3, turn: Turn, axis: DVec3, speed: f64) -> Self {
        Self(Way3::Turning { position, turn, axis, speed })
    }

    pub(super) fn pushing(from: DVec3, reach: DVec3, period: f64) -> Self {
        Self(Way3::Pushing(Push { from, reach, period }))
    }

    pub(super) fn walking(motion: Motion3) -> Self {
        Self(Way3::Walking(motion))
    }

    /// The pose at a frame.
    pub fn pose_at(&self, frame: u32) -> Pose3 {
        match &self.0 {
            Way3::Turning { position, turn, axis, speed } => {
                let by = Turn::about(*axis, speed * f64::from(frame) / RATE);
                pose3(by.apply(*position), by.after(*turn))
            }
            Way3::Pushing(push) => pose3(push.from + push.reach * push.share_at(frame), Turn::IDENTITY),
            Way3::Walking(motion) => {
                let (position, turn) = motion.at(frame);
                pose3(position, turn)
            }
        }
    }
}
