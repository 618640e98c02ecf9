//! What differs for the stepper between space and the plane.
//!
//! The stepper works in space. The plane is space with z = 0: places, velocities and pushes keep a third coordinate of
//! zero, and bodies turn about the third axis alone, since all else in their inverse inertia is zero.

use super::body::Mass;
use super::solver::Point;
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{Collider, Collider2, Collider3, Manifold2, Manifold3, MassProperties2, MassProperties3};
use asunder::{Plane, Pose2, Pose3, Rotation2, Space, Volume};

/// A dimension in which bodies can be stepped.
pub trait Dimension: Space {
    /// The mass properties at unit density; `None` where the body is so thin that its mass rounds to zero.
    fn mass(body: &Collider<Self>) -> Option<Mass>;
    /// The pose of a body.
    fn pose_of(body: &Collider<Self>) -> &Self::Pose;
    /// The position of the body's origin, and its rotation.
    fn place(pose: &Self::Pose) -> (DVec3, DQuat);
    /// The pose with such numbers; `None` where they make no valid pose.
    fn pose(position: DVec3, turn: DQuat) -> Option<Self::Pose>;
    /// The points of a manifold, with arms from the bodies' origins. The caller fills in which bodies they belong to.
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
        // The quaternion is of half the angle, whose tangent is (1 - cos) / sin = sin / (1 + cos): take the form that
        // does not cancel.
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
