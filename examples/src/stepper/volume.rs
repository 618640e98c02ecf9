//! Space.

use super::dimension::{Dimension, Mass};
use super::solver::Point;
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{Collider3, Manifold3, MassProperties3, Pose3, Volume};

impl Dimension for Volume {
    type Turn = DQuat;

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

    fn turned(turn: DQuat, local: DVec3) -> DVec3 {
        turn * local
    }

    fn turned_by(turn: DQuat, spin: DVec3) -> DQuat {
        let half = spin * 0.5;
        (turn + DQuat::from_xyzw(half.x, half.y, half.z, 0.0) * turn).normalize()
    }

    fn turned_inertia(inertia: DMat3, turn: DQuat) -> DMat3 {
        let rotation = DMat3::from_quat(turn);
        rotation * inertia * rotation.transpose()
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
