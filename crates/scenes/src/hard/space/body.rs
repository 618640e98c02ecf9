//! Pairs under construction: shapes with their rotations as stored, and how they are brought together.

use crate::pairs::PosedPair3;
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::{Basis3, Pose3, Shape3};
use glam::{DVec3, Quat};

/// A shape with its rotation as stored (rounded), so that it is placed by its true surface.
#[derive(Clone, Debug)]
pub(super) struct Body3 {
    pub(super) shape: Shape3,
    pub(super) rotation: Quat,
    basis: Basis3,
}

impl Body3 {
    pub(super) fn new(shape: Shape3, turn: Turn) -> Self {
        Self::turned(shape, turn.to_quat())
    }

    /// The quaternion may have any length.
    pub(super) fn turned(shape: Shape3, rotation: Quat) -> Self {
        let pose = pose(DVec3::ZERO, rotation);
        Self { shape, rotation: pose.rotation(), basis: pose.basis() }
    }

    /// A local vector in world axes.
    pub(super) fn turn(&self, local: DVec3) -> DVec3 {
        self.basis.turn(local)
    }

    pub(super) fn turn_back(&self, world: DVec3) -> DVec3 {
        self.basis.turn_back(world)
    }

    /// Rotates a local vector of whole multiples of `grid`, and divides by the quaternion's squared length once, at the
    /// end: exact if the quaternion has small whole components and `grid` is a multiple of its squared length.
    pub(super) fn turn_whole(&self, local: DVec3, grid: f64) -> DVec3 {
        let [x, y, z, w] = self.rotation.to_array().map(f64::from);
        let (v, square) = (DVec3::new(x, y, z), x * x + y * y + z * z + w * w);
        let whole = local / grid;
        let turned = whole * (w * w - v.dot(v)) + v * (2.0 * v.dot(whole)) + v.cross(whole) * (2.0 * w);
        turned * (grid / square)
    }

    /// The support point in a direction of the world, from the body's position. For a half-space, its origin.
    pub(super) fn furthest(&self, axis: DVec3) -> DVec3 {
        self.turn(self.shape.support(self.turn_back(axis)).unwrap_or_default())
    }

    /// The shape's centre, from the body's position, in world axes.
    pub(super) fn middle(&self) -> DVec3 {
        self.turn(self.shape.center().as_dvec3())
    }

    /// The bounding radius; 0 for a half-space.
    pub(super) fn radius(&self) -> f64 {
        let radius = f64::from(self.shape.outer_radius());
        if radius.is_finite() { radius } else { 0.0 }
    }
}

/// The sum of both bounding radii.
pub(super) fn size(a: &Body3, b: &Body3) -> f64 {
    a.radius() + b.radius()
}

/// The pose, or the identity where it is not valid: the numbers drawn here are finite and in range.
pub(super) fn pose(position: DVec3, rotation: Quat) -> Pose3 {
    Pose3::new(position, rotation).unwrap_or(Pose3::IDENTITY)
}

/// A place for both bodies: the origin, where positions are most precise, or anywhere within 5 m along each axis.
pub(super) fn place(random: &mut Random) -> DVec3 {
    if random.unit() < 0.5 { DVec3::ZERO } else { random.within(DVec3::splat(-5.0), DVec3::splat(5.0)) }
}

/// A finished pair, and what its generator claims of it.
#[derive(Clone, Debug)]
pub(in crate::hard) struct Draft3 {
    pub(in crate::hard) pair: PosedPair3,
    /// How near touching the pair is; checked by the tests.
    pub(in crate::hard) claim: Option<Claim3>,
}

/// Claims that the separation along a unit axis from A to B is at most `within` metres in size, and so is the distance.
#[derive(Clone, Copy, Debug)]
pub(in crate::hard) struct Claim3 {
    pub(in crate::hard) axis: DVec3,
    pub(in crate::hard) within: f64,
}

impl Draft3 {
    /// A pair at two places, without a claim.
    pub(super) fn placed(a: Body3, b: Body3, at: DVec3, goal: DVec3) -> Self {
        let pair = PosedPair3 {
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
    pub(super) fn meeting(a: (Body3, DVec3), b: (Body3, DVec3), axis: DVec3, gap: f64, at: DVec3) -> Self {
        let ((a, on_a), (b, on_b)) = (a, b);
        let on_top = (a.furthest(axis) - on_a).dot(axis) - (b.furthest(-axis) - on_b).dot(axis);
        Self::placed(a, b, at, at + (on_a - on_b + axis * (on_top + gap))).claiming(axis, gap.abs())
    }

    /// Puts B's support point against the axis `gap` metres beyond A's support point along it.
    pub(super) fn beside(a: Body3, b: Body3, axis: DVec3, gap: f64, at: DVec3) -> Self {
        let (on_a, on_b) = (a.furthest(axis), b.furthest(-axis));
        Self::meeting((a, on_a), (b, on_b), axis, gap, at)
    }

    pub(super) fn claiming(self, axis: DVec3, within: f64) -> Self {
        Self { claim: Some(Claim3 { axis, within }), ..self }
    }

    pub(in crate::hard) fn swapped(self) -> Self {
        let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = self.pair;
        let pair = PosedPair3 { shape_a: shape_b, pose_a: pose_b, shape_b: shape_a, pose_b: pose_a };
        let claim = self.claim.map(|claim| Claim3 { axis: -claim.axis, ..claim });
        Self { pair, claim }
    }
}
