//! The game in the plane.

use crate::physics::{Mass, Physics, Touch, TouchId};
use asunder::glam::DVec2;
use asunder::{BodyKey2, Collider2, Event2, Plane, Pose2, Rotation2, Shape2, World2};

impl Physics for Plane {
    type Vector = DVec2;
    type Spin = f64;
    /// Cosine and sine.
    type Turn = DVec2;
    type Inertia = f64;
    const IMMOVABLE: f64 = 0.0;

    fn dot(a: DVec2, b: DVec2) -> f64 {
        a.dot(b)
    }

    fn torque(arm: DVec2, push: DVec2) -> f64 {
        arm.perp_dot(push)
    }

    fn sweep(spin: f64, arm: DVec2) -> DVec2 {
        arm.perp() * spin
    }

    fn respond(inertia: &f64, torque: f64) -> f64 {
        inertia * torque
    }

    fn turned_inertia(inertia: &f64, _turn: DVec2) -> f64 {
        *inertia
    }

    fn turned_by(turn: DVec2, spin: f64) -> DVec2 {
        (turn + turn.perp() * spin).normalize()
    }

    fn turned(turn: DVec2, local: DVec2) -> DVec2 {
        turn.rotate(local)
    }

    fn mass(shape: &Shape2) -> Option<Mass<Self>> {
        let matter = shape.mass_properties(1.0).ok()?;
        let inverse_inertia = 1.0 / matter.inertia;
        let is_sound = (inverse_inertia + 1.0 / matter.mass).is_finite();
        is_sound.then_some(Mass { mass: matter.mass, center: matter.center, inverse_inertia })
    }

    fn place(pose: &Pose2) -> (DVec2, DVec2) {
        let rotation = pose.rotation();
        (pose.position(), DVec2::new(f64::from(rotation.cos()), f64::from(rotation.sin())))
    }

    fn pose(position: DVec2, turn: DVec2) -> Option<Pose2> {
        Pose2::new(position, Rotation2::new(turn.x as f32, turn.y as f32).ok()?).ok()
    }

    fn insert(world: &mut World2, collider: Collider2) -> BodyKey2 {
        world.insert(collider)
    }

    fn remove(world: &mut World2, key: BodyKey2) {
        world.remove(key);
    }

    fn set_pose(world: &mut World2, key: BodyKey2, pose: Pose2) {
        // A stale key is a body that has left the level: there is nothing to move.
        let _ = world.set_pose(key, pose);
    }

    fn pose_of(world: &World2, key: BodyKey2) -> Option<Pose2> {
        world.get(key).map(|body| *body.pose())
    }

    fn events(world: &World2) -> &[Event2] {
        world.events()
    }

    fn touches(world: &World2) -> Vec<Touch<Self>> {
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
                    normal: manifold.normal.as_dvec2(),
                    separation: f64::from(point.separation),
                    anchor_a: point.anchor_a.as_dvec2(),
                    anchor_b: point.anchor_b.as_dvec2(),
                }));
            }
        }
        touches
    }

    fn pose_bits(pose: &Pose2) -> Vec<u64> {
        let rotation = [pose.rotation().cos(), pose.rotation().sin()].map(f64::from);
        pose.position().to_array().into_iter().chain(rotation).map(f64::to_bits).collect()
    }
}
