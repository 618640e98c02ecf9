//! The plane.

use super::dimension::{Dimension, Mass};
use super::solver::Point;
use asunder::glam::{DMat3, DVec2, DVec3};
use asunder::{Collider2, Manifold2, MassProperties2, Plane, Pose2, Rotation2};

impl Dimension for Plane {
    /// Cosine and sine.
    type Turn = DVec2;

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

    fn place(pose: &Pose2) -> (DVec3, DVec2) {
        let (cos, sin) = (pose.rotation().cos(), pose.rotation().sin());
        (pose.position().extend(0.0), DVec2::new(f64::from(cos), f64::from(sin)))
    }

    fn pose(position: DVec3, turn: DVec2) -> Option<Pose2> {
        Pose2::new(position.truncate(), Rotation2::new(turn.x as f32, turn.y as f32).ok()?).ok()
    }

    fn turned(turn: DVec2, local: DVec3) -> DVec3 {
        turn.rotate(local.truncate()).extend(0.0)
    }

    fn turned_by(turn: DVec2, spin: DVec3) -> DVec2 {
        (turn + turn.perp() * spin.z).normalize()
    }

    fn turned_inertia(inertia: DMat3, _turn: DVec2) -> DMat3 {
        inertia
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
