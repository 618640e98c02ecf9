//! The game in space.

use crate::physics::{Mass, Physics, Touch, TouchId};
use asunder::glam::{DMat3, DQuat, DVec3, Vec3};
use asunder::{BodyKey3, Collider3, Event3, Pose3, Shape3, Topology, Volume, World3};

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
        let (vertices, topology) = mesh(shape);
        let (mut volume, mut moment, mut spread) = (0.0, DVec3::ZERO, DMat3::ZERO);
        // Tetrahedra from the origin over each face's fan; those on its far side count negative.
        for face in 0..topology.face_count() {
            let corners: Vec<DVec3> = topology.face_vertices(face).map(|i| vertices[i]).collect();
            for two in corners[1..].windows(2) {
                let (a, b, c) = (corners[0], two[0], two[1]);
                let (six_fold, sum) = (a.cross(b).dot(c), a + b + c);
                volume += six_fold / 6.0;
                moment += sum * (six_fold / 24.0);
                spread += (outer(a) + outer(b) + outer(c) + outer(sum)) * (six_fold / 120.0);
            }
        }
        let center = moment / volume;
        let central = spread - outer(center) * volume;
        let trace = central.x_axis.x + central.y_axis.y + central.z_axis.z;
        let inertia = DMat3::from_diagonal(DVec3::splat(trace)) - central;
        if volume <= 0.0 || inertia.determinant() <= 0.0 {
            return None;
        }
        let inverse_inertia = inertia.inverse();
        let is_sound = inverse_inertia.is_finite() && (1.0 / volume).is_finite();
        is_sound.then_some(Mass { mass: volume, center, inverse_inertia })
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

/// A shape's vertices, and how they make faces.
pub(crate) fn mesh(shape: &Shape3) -> (Vec<DVec3>, &Topology) {
    let core = shape.core();
    (core.vertices().iter().copied().map(Vec3::as_dvec3).collect(), core.topology())
}

fn outer(v: DVec3) -> DMat3 {
    DMat3::from_cols(v * v.x, v * v.y, v * v.z)
}
