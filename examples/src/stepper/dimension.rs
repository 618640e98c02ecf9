//! What the stepper must know of a dimension, for space and for the plane.
//!
//! It steps in space. The plane is space without height: places, speeds and pushes keep their third coordinate at zero,
//! and bodies turn about the third axis alone, since nothing else in their inverse inertia is above zero.

use super::body::Mass;
use super::solver::Point;
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{Collider, Collider2, Collider3, Manifold2, Manifold3, MassProperties2, MassProperties3};
use asunder::{Plane, Pose2, Pose3, Rotation2, Space, Volume};

/// A dimension that bodies can be stepped in.
pub trait Dimension: Space {
    /// What a body weighs at unit density; nothing where it is too thin for its mass to be told from zero.
    fn mass(body: &Collider<Self>) -> Option<Mass>;
    /// Where a body is.
    fn pose_of(body: &Collider<Self>) -> &Self::Pose;
    /// The place of a body's own origin, and its rotation.
    fn place(pose: &Self::Pose) -> (DVec3, DQuat);
    /// Nothing where the numbers are no pose.
    fn pose(position: DVec3, turn: DQuat) -> Option<Self::Pose>;
    /// The points of a manifold, with arms from where the bodies are; of which bodies, the caller knows.
    fn points(manifold: &Self::Manifold) -> impl Iterator<Item = Point>;
}

impl Dimension for Volume {
    fn mass(body: &Collider3) -> Option<Mass> {
        let MassProperties3 { mass, center, inertia } = body.shape().mass_properties(1.0).ok()?;
        let (inverse, inverse_inertia) = (1.0 / mass, inertia.inverse());
        let reach = f64::from(body.shape().outer_radius());
        let is_sound = inverse.is_finite() && inverse_inertia.is_finite();
        is_sound.then_some(Mass { inverse, inverse_inertia, center, reach })
    }

    fn pose_of(body: &Collider3) -> &Pose3 {
        body.pose()
    }

    fn place(pose: &Pose3) -> (DVec3, DQuat) {
        (pose.position(), pose.rotation().as_dquat().normalize())
    }

    fn pose(position: DVec3, turn: DQuat) -> Option<Pose3> {
        Pose3::new(position, turn.as_quat()).ok()
    }

    fn points(manifold: &Manifold3) -> impl Iterator<Item = Point> {
        manifold.points.iter().map(|point| Point {
            feature: (manifold.part_a, manifold.part_b, point.feature.to_bits()),
            normal: manifold.normal.as_dvec3(),
            separation: f64::from(point.separation),
            arms: [point.anchor_a, point.anchor_b].map(|anchor| anchor.as_dvec3()),
            ..Point::default()
        })
    }
}

impl Dimension for Plane {
    fn mass(body: &Collider2) -> Option<Mass> {
        let MassProperties2 { mass, center, inertia } = body.shape().mass_properties(1.0).ok()?;
        let inverse_inertia = DMat3::from_diagonal(DVec3::Z / inertia);
        let (inverse, reach) = (1.0 / mass, f64::from(body.shape().outer_radius()));
        let is_sound = inverse.is_finite() && inverse_inertia.is_finite();
        is_sound.then_some(Mass { inverse, inverse_inertia, center: center.extend(0.0), reach })
    }

    fn pose_of(body: &Collider2) -> &Pose2 {
        body.pose()
    }

    fn place(pose: &Pose2) -> (DVec3, DQuat) {
        let (cos, sin) = (f64::from(pose.rotation().cos()), f64::from(pose.rotation().sin()));
        // A quaternion is of half the angle, whose tangent is either of these; that which does not cancel.
        let (z, w) = if cos < 0.0 { (1.0 - cos, sin) } else { (sin, 1.0 + cos) };
        (pose.position().extend(0.0), DQuat::from_xyzw(0.0, 0.0, z, w).normalize())
    }

    fn pose(position: DVec3, turn: DQuat) -> Option<Pose2> {
        let x_axis = (turn * DVec3::X).as_vec3();
        Pose2::new(position.truncate(), Rotation2::new(x_axis.x, x_axis.y).ok()?).ok()
    }

    fn points(manifold: &Manifold2) -> impl Iterator<Item = Point> {
        manifold.points.iter().map(|point| Point {
            feature: (manifold.part_a, manifold.part_b, point.feature.to_bits()),
            normal: manifold.normal.as_dvec2().extend(0.0),
            separation: f64::from(point.separation),
            arms: [point.anchor_a, point.anchor_b].map(|anchor| anchor.as_dvec2().extend(0.0)),
            ..Point::default()
        })
    }
}
