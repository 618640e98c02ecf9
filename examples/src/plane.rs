//! The game in the plane.

use crate::physics::{Mass, Physics, Touch, TouchId};
use asunder::glam::DVec2;
use asunder::{BodyKey2, Collider2, Event2, Motion2, Plane, Pose2, Rotation2, Shape2, World2};

impl Physics for Plane {
    type Vector = DVec2;
    type Spin = f64;
    /// Cosine and sine.
    type Turn = DVec2;
    type Inertia = f64;
    const NUMBERS: [usize; 2] = [2, 2];
    const IMMOVABLE: f64 = 0.0;

    #[inline]
    fn dot(a: DVec2, b: DVec2) -> f64 {
        a.dot(b)
    }

    #[inline]
    fn spin_square(spin: f64) -> f64 {
        spin * spin
    }

    fn is_within(point: DVec2, (low, high): &(DVec2, DVec2)) -> bool {
        point.cmpge(*low).all() && point.cmple(*high).all()
    }

    #[inline]
    fn torque(arm: DVec2, push: DVec2) -> f64 {
        arm.perp_dot(push)
    }

    #[inline]
    fn sweep(spin: f64, arm: DVec2) -> DVec2 {
        arm.perp() * spin
    }

    #[inline]
    fn respond(inertia: &f64, torque: f64) -> f64 {
        inertia * torque
    }

    fn spin_energy(inertia: &f64, spin: f64) -> f64 {
        if *inertia > 0.0 { spin * spin / *inertia } else { 0.0 }
    }

    fn turned_inertia(inertia: &f64, _turn: DVec2) -> f64 {
        *inertia
    }

    fn turned_by(turn: DVec2, spin: f64) -> DVec2 {
        (turn + turn.perp() * spin).normalize()
    }

    fn spin_between(from: DVec2, to: DVec2) -> f64 {
        libm::atan2(from.perp_dot(to), from.dot(to))
    }

    #[inline]
    fn turned(turn: DVec2, local: DVec2) -> DVec2 {
        turn.rotate(local)
    }

    fn mass(shape: &Shape2) -> Option<Mass<Self>> {
        let matter = shape.mass_properties(1.0).ok()?;
        let inverse_inertia = 1.0 / matter.inertia;
        let is_sound = (inverse_inertia + 1.0 / matter.mass).is_finite();
        is_sound.then_some(Mass {
            mass: matter.mass,
            size: matter.mass.sqrt(),
            center: matter.center,
            inverse_inertia,
        })
    }

    fn reach(shape: &Shape2) -> f64 {
        f64::from(shape.outer_radius())
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

    fn look_ahead(world: &mut World2, key: BodyKey2, to: &Pose2) {
        let Some(from) = Self::pose_of(world, key) else { return };
        if let Ok(motion) = Motion2::new(to.position() - from.position(), to.rotation()) {
            let _ = world.set_motion(key, motion);
        }
    }

    fn sleep(world: &mut World2, key: BodyKey2) {
        let _ = world.sleep(key);
    }

    fn pose_of(world: &World2, key: BodyKey2) -> Option<Pose2> {
        world.get(key).map(|body| *body.pose())
    }

    fn events(world: &World2) -> &[Event2] {
        world.events()
    }

    fn hits(world: &World2) -> impl Iterator<Item = (BodyKey2, BodyKey2, f64)> {
        let solid = world.impacts().iter().filter(|hit| !hit.sensor);
        solid.map(|hit| (hit.bullet, hit.other, hit.impact.fraction))
    }

    fn is_near(world: &World2, a: BodyKey2, b: BodyKey2) -> bool {
        world.contact(a, b).is_some_and(|contact| !contact.speculative)
    }

    fn touches(
        world: &World2,
        mut wanted: impl FnMut(BodyKey2, BodyKey2, bool) -> Option<[u32; 2]>,
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
                    normal: manifold.normal.as_dvec2(),
                    separation: f64::from(point.separation),
                    anchor_a: point.anchor_a.as_dvec2(),
                    anchor_b: point.anchor_b.as_dvec2(),
                }));
            }
        }
    }

    fn count_contacts(world: &World2) -> (u32, u32) {
        let near = world.contacts().filter(|contact| !contact.speculative);
        near.fold((0, 0), |(near, touching), contact| (near + 1, touching + u32::from(contact.overlapping)))
    }

    fn numbers(pose: &Pose2) -> impl Iterator<Item = f64> {
        let rotation = [pose.rotation().cos(), pose.rotation().sin()].map(f64::from);
        pose.position().to_array().into_iter().chain(rotation)
    }

    fn of_numbers(numbers: &[f64]) -> Option<Pose2> {
        let &[x, y, cos, sin] = numbers else { return None };
        Self::pose(DVec2::new(x, y), DVec2::new(cos, sin))
    }
}
