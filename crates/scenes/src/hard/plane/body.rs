//! Pairs under construction: shapes with their rotations as stored, and how they are brought together.

use crate::pairs::PosedPair2;
use crate::random::Random;
use asunder_geometry::{Pose2, Rotation2, Shape2};
use core::f64::consts::TAU;
use glam::DVec2;

/// A shape with its rotation as stored (rounded), so that it is placed by its true outline.
#[derive(Clone, Debug)]
pub(super) struct Body2 {
    pub(super) shape: Shape2,
    pub(super) rotation: Rotation2,
}

impl Body2 {
    pub(super) fn new(shape: Shape2, angle: f64) -> Self {
        Self { shape, rotation: rotation(angle) }
    }

    pub(super) fn turned(shape: Shape2, rotation: Rotation2) -> Self {
        Self { shape, rotation }
    }

    /// A local vector in world axes.
    pub(super) fn turn(&self, local: DVec2) -> DVec2 {
        self.rotation.turn(local)
    }

    /// The support point in a unit direction of the world, from the body's position. For a half-plane, its origin.
    ///
    /// The stored matrix rotates the core and, by its rounding, stretches it; the radius stays as it is.
    pub(super) fn furthest(&self, axis: DVec2) -> DVec2 {
        let turned = |shape: &Shape2, pose: &Pose2| {
            let core = shape.core();
            let places = core.vertices().iter().map(|&vertex| self.turn(pose.transform(vertex)));
            let vertex = places.max_by(|p, q| p.dot(axis).total_cmp(&q.dot(axis)));
            vertex.map(|vertex| vertex + axis * f64::from(shape.radius()))
        };
        let found = match &self.shape {
            Shape2::Compound(compound) => {
                let parts = compound.parts().iter().filter_map(|part| turned(part.shape(), part.pose()));
                parts.max_by(|p, q| p.dot(axis).total_cmp(&q.dot(axis)))
            }
            shape => turned(shape, &Pose2::IDENTITY),
        };
        found.unwrap_or_default()
    }

    /// The shape's centre, from the body's position, in world axes.
    pub(super) fn middle(&self) -> DVec2 {
        self.turn(self.shape.center().as_dvec2())
    }

    /// The bounding radius; 0 for a half-plane.
    pub(super) fn radius(&self) -> f64 {
        let radius = f64::from(self.shape.outer_radius());
        if radius.is_finite() { radius } else { 0.0 }
    }
}

/// The sum of both bounding radii.
pub(super) fn size(a: &Body2, b: &Body2) -> f64 {
    a.radius() + b.radius()
}

pub(super) fn rotation(angle: f64) -> Rotation2 {
    Rotation2::new(libm::cos(angle) as f32, libm::sin(angle) as f32).unwrap_or(Rotation2::IDENTITY)
}

/// The pose, or the identity where it is not valid: the numbers drawn here are finite and in range.
pub(super) fn pose(position: DVec2, rotation: Rotation2) -> Pose2 {
    Pose2::new(position, rotation).unwrap_or(Pose2::IDENTITY)
}

pub(super) fn any_angle(random: &mut Random) -> f64 {
    random.range(0.0, TAU)
}

pub(super) fn direction(angle: f64) -> DVec2 {
    DVec2::new(libm::cos(angle), libm::sin(angle))
}

pub(super) fn within(random: &mut Random, reach: f64) -> DVec2 {
    DVec2::new(random.range(-reach, reach), random.range(-reach, reach))
}

/// A place for both bodies: the origin, where positions are most precise, or anywhere within 5 m along each axis.
pub(super) fn place(random: &mut Random) -> DVec2 {
    if random.unit() < 0.5 { DVec2::ZERO } else { within(random, 5.0) }
}

/// A finished pair, and what its generator claims of it.
#[derive(Clone, Debug)]
pub(in crate::hard) struct Draft2 {
    pub(in crate::hard) pair: PosedPair2,
    /// How near touching the pair is; checked by the tests.
    pub(in crate::hard) claim: Option<Claim2>,
}

/// Claims that the separation along a unit axis from A to B is at most `within` metres in size, and so is the distance.
#[derive(Clone, Copy, Debug)]
pub(in crate::hard) struct Claim2 {
    pub(in crate::hard) axis: DVec2,
    pub(in crate::hard) within: f64,
}

impl Draft2 {
    /// A pair at two places, without a claim.
    pub(super) fn placed(a: Body2, b: Body2, at: DVec2, goal: DVec2) -> Self {
        let pair = PosedPair2 {
            pose_a: pose(at, a.rotation),
            pose_b: pose(goal, b.rotation),
            shape_a: a.shape,
            shape_b: b.shape,
        };
        Self { pair, claim: None }
    }

    /// Puts B's point `on_b` on A's point `on_a`, then moves B along a unit axis until B's support point against the
    /// axis is `gap` metres beyond A's support point along it. Points are relative to their body's position, in world
    /// axes.
    pub(super) fn meeting(a: (Body2, DVec2), b: (Body2, DVec2), axis: DVec2, gap: f64, at: DVec2) -> Self {
        let ((a, on_a), (b, on_b)) = (a, b);
        let on_top = (a.furthest(axis) - on_a).dot(axis) - (b.furthest(-axis) - on_b).dot(axis);
        Self::placed(a, b, at, at + (on_a - on_b + axis * (on_top + gap))).claiming(axis, gap.abs())
    }

    /// Puts B's support point against the axis `gap` metres beyond A's support point along it.
    pub(super) fn beside(a: Body2, b: Body2, axis: DVec2, gap: f64, at: DVec2) -> Self {
        let (on_a, on_b) = (a.furthest(axis), b.furthest(-axis));
        Self::meeting((a, on_a), (b, on_b), axis, gap, at)
    }

    pub(super) fn claiming(self, axis: DVec2, within: f64) -> Self {
        Self { claim: Some(Claim2 { axis, within }), ..self }
    }

    pub(in crate::hard) fn swapped(self) -> Self {
        let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = self.pair;
        let pair = PosedPair2 { shape_a: shape_b, pose_a: pose_b, shape_b: shape_a, pose_b: pose_a };
        let claim = self.claim.map(|claim| Claim2 { axis: -claim.axis, ..claim });
        Self { pair, claim }
    }
}
