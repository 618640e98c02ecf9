//! The game in space.

use crate::physics::{Mass, Physics, Touch, TouchId};
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{BodyKey3, Collider3, Event3, Motion3, Pose3, Shape3, Volume, World3};

impl Physics for Volume {
    type Vector = DVec3;
    type Spin = DVec3;
    type Turn = DQuat;
    type Inertia = DMat3;
    const NUMBERS: [usize; 2] = [3, 4];
    const IMMOVABLE: DMat3 = DMat3::ZERO;

    #[inline]
    fn dot(a: DVec3, b: DVec3) -> f64 {
        a.dot(b)
    }

    #[inline]
    fn spin_square(spin: DVec3) -> f64 {
        spin.dot(spin)
    }

    fn is_within(point: DVec3, (low, high): &(DVec3, DVec3)) -> bool {
        point.cmpge(*low).all() && point.cmple(*high).all()
    }

    #[inline]
    fn torque(arm: DVec3, push: DVec3) -> DVec3 {
        arm.cross(push)
    }

    #[inline]
    fn sweep(spin: DVec3, arm: DVec3) -> DVec3 {
        spin.cross(arm)
    }

    #[inline]
    fn respond(inertia: &DMat3, torque: DVec3) -> DVec3 {
        *inertia * torque
    }

    fn spin_energy(inertia: &DMat3, spin: DVec3) -> f64 {
        if inertia.determinant() > 0.0 { spin.dot(inertia.inverse() * spin) } else { 0.0 }
    }

    fn turned_inertia(inertia: &DMat3, turn: DQuat) -> DMat3 {
        let rotation = DMat3::from_quat(turn);
        rotation * *inertia * rotation.transpose()
    }

    fn turned_by(turn: DQuat, spin: DVec3) -> DQuat {
        let half = spin * 0.5;
        (turn + DQuat::from_xyzw(half.x, half.y, half.z, 0.0) * turn).normalize()
    }

    fn spin_between(from: DQuat, to: DQuat) -> DVec3 {
        let by = to * from.conjugate();
        // The shorter way round. Over a step it is small: an angle and its sine are nearly the same.
        let (half, w) = if by.w < 0.0 { (-by.xyz(), -by.w) } else { (by.xyz(), by.w) };
        let sine = half.length();
        if sine > 0.0 { half * (2.0 * libm::atan2(sine, w) / sine) } else { DVec3::ZERO }
    }

    #[inline]
    fn turned(turn: DQuat, local: DVec3) -> DVec3 {
        turn * local
    }

    fn mass(shape: &Shape3) -> Option<Mass<Self>> {
        let matter = shape.mass_properties(1.0).ok()?;
        let inverse_inertia = matter.inertia.inverse();
        let is_sound = inverse_inertia.is_finite() && (1.0 / matter.mass).is_finite();
        is_sound.then_some(Mass {
            mass: matter.mass,
            size: libm::cbrt(matter.mass),
            center: matter.center,
            inverse_inertia,
        })
    }

    fn reach(shape: &Shape3) -> f64 {
        f64::from(shape.outer_radius())
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

    fn look_ahead(world: &mut World3, key: BodyKey3, to: &Pose3) {
        let Some(from) = Self::pose_of(world, key) else { return };
        if let Ok(motion) = Motion3::new(to.position() - from.position(), to.rotation()) {
            let _ = world.set_motion(key, motion);
        }
    }

    fn sleep(world: &mut World3, key: BodyKey3) {
        let _ = world.sleep(key);
    }

    fn pose_of(world: &World3, key: BodyKey3) -> Option<Pose3> {
        world.get(key).map(|body| *body.pose())
    }

    fn events(world: &World3) -> &[Event3] {
        world.events()
    }

    fn hits(world: &World3) -> impl Iterator<Item = (BodyKey3, BodyKey3, f64)> {
        let solid = world.impacts().iter().filter(|hit| !hit.sensor);
        solid.map(|hit| (hit.bullet, hit.other, hit.impact.fraction))
    }

    fn is_near(world: &World3, a: BodyKey3, b: BodyKey3) -> bool {
        world.contact(a, b).is_some_and(|contact| !contact.speculative)
    }

    fn touches(
        world: &World3,
        mut wanted: impl FnMut(BodyKey3, BodyKey3, bool) -> Option<[u32; 2]>,
        touches: &mut Vec<Touch<Self>>,
    ) {
        for contact in world.contacts() {
            let Some(bodies) = wanted(contact.a, contact.b, contact.speculative) else { continue };
            for manifold in contact.manifolds {
                touches.extend(manifold.points.iter().map(|point| Touch {
                    id: TouchId {
                        keys: (contact.a, contact.b),
                        parts: (manifold.part_a, manifold.part_b),
                        feature: point.feature.to_bits(),
                    },
                    bodies,
                    normal: manifold.normal.as_dvec3(),
                    separation: f64::from(point.separation),
                    anchor_a: point.anchor_a.as_dvec3(),
                    anchor_b: point.anchor_b.as_dvec3(),
                }));
            }
        }
    }

    fn count_contacts(world: &World3) -> (u32, u32) {
        let near = world.contacts().filter(|contact| !contact.speculative);
        near.fold((0, 0), |(near, touching), contact| (near + 1, touching + u32::from(contact.overlapping)))
    }

    fn numbers(pose: &Pose3) -> impl Iterator<Item = f64> {
        let rotation = pose.rotation().to_array().map(f64::from);
        pose.position().to_array().into_iter().chain(rotation)
    }

    fn of_numbers(numbers: &[f64]) -> Option<Pose3> {
        let &[x, y, z, i, j, k, w] = numbers else { return None };
        Self::pose(DVec3::new(x, y, z), DQuat::from_xyzw(i, j, k, w))
    }
}
