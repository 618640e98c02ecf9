//! The game in space.

use crate::physics::{Mass, Physics, Touch, TouchId};
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{BodyKey3, Collider3, Event3, Pose3, Shape3, Volume, World3};

impl Physics for Volume {
    type Vector = DVec3;
    type Spin = DVec3;
    type Turn = DQuat;
    type Inertia = DMat3;
    const IMMOVABLE: DMat3 = DMat3::ZERO;

    fn dot(a: DVec3, b: DVec3) -> f64 {
        a.dot(b)
    }

    fn torque(arm: DVec3, push: DVec3) -> DVec3 {
        arm.cross(push)
    }

    fn sweep(spin: DVec3, arm: DVec3) -> DVec3 {
        spin.cross(arm)
    }

    fn respond(inertia: &DMat3, torque: DVec3) -> DVec3 {
        *inertia * torque
    }

    fn turned_inertia(inertia: &DMat3, turn: DQuat) -> DMat3 {
        let rotation = DMat3::from_quat(turn);
        rotation * *inertia * rotation.transpose()
    }

    fn turned_by(turn: DQuat, spin: DVec3) -> DQuat {
        let half = spin * 0.5;
        (turn + DQuat::from_xyzw(half.x, half.y, half.z, 0.0) * turn).normalize()
    }

    fn turned(turn: DQuat, local: DVec3) -> DVec3 {
        turn * local
    }

    fn mass(shape: &Shape3) -> Option<Mass<Self>> {
        let matter = shape.mass_properties(1.0).ok()?;
        let inverse_inertia = matter.inertia.inverse();
        let is_sound = inverse_inertia.is_finite() && (1.0 / matter.mass).is_finite();
        is_sound.then_some(Mass { mass: matter.mass, center: matter.center, inverse_inertia })
    }

    fn place(pose: &Pose3) -> (DVec3, DQuat) {
        (pose.position(), pose.rotation().as_dquat().normalize())
    }

    fn pose(position: DVec3, turn: DQuat) -> Option<Pose3> {
        Pose3::new(position, turn.as_quat()).ok()
    }

    fn insert(world: &mut World3, collider: Collider3) -> BodyKey3 {
        world.insert(collider)
    }

    fn remove(world: &mut World3, key: BodyKey3) {
        world.remove(key);
    }

    fn set_pose(world: &mut World3, key: BodyKey3, pose: Pose3) {
        // A stale key is a body that has left the level: there is nothing to move.
        let _ = world.set_pose(key, pose);
    }

    fn pose_of(world: &World3, key: BodyKey3) -> Option<Pose3> {
        world.get(key).map(|body| *body.pose())
    }

    fn events(world: &World3) -> &[Event3] {
        world.events()
    }

    fn touches(world: &World3) -> Vec<Touch<Self>> {
        let mut touches = Vec::new();
        for contact in world.contacts() {
            for manifold in contact.manifolds {
                touches.extend(manifold.points.iter().map(|point| Touch {
                    id: TouchId {
                        a: contact.a,
                        b: contact.b,
                        parts: (manifold.part_a, manifold.part_b),
                        feature: point.feature.to_bits(),
                    },
                    normal: manifold.normal.as_dvec3(),
                    separation: f64::from(point.separation),
                    anchor_a: point.anchor_a.as_dvec3(),
                    anchor_b: point.anchor_b.as_dvec3(),
                }));
            }
        }
        touches
    }

    fn pose_bits(pose: &Pose3) -> Vec<u64> {
        let rotation = pose.rotation().to_array().map(f64::from);
        pose.position().to_array().into_iter().chain(rotation).map(f64::to_bits).collect()
    }
}
