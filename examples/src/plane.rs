//! The game in the plane.

use crate::physics::{Matter, Physics, Touch, TouchId};
use asunder::glam::DVec2;
use asunder::{Collider2, Contact2, Impact2, MassProperties2, Motion2, Plane, Pose2, Rotation2};

impl Physics for Plane {
    type Vector = DVec2;
    type Spin = f64;
    /// Cosine and sine.
    type Turn = DVec2;
    type Inertia = f64;
    const IMMOVABLE: f64 = 0.0;

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

    fn matter(body: &Collider2) -> Option<Matter<Self>> {
        let MassProperties2 { mass, center, inertia } = body.shape().mass_properties(1.0).ok()?;
        let (inverse_mass, inverse_inertia) = (1.0 / mass, 1.0 / inertia);
        let (size, reach) = (mass.sqrt(), f64::from(body.shape().outer_radius()));
        let is_sound = (inverse_mass + inverse_inertia).is_finite();
        is_sound.then_some(Matter { inverse_mass, inverse_inertia, center, size, reach })
    }

    fn pose_of(body: &Collider2) -> &Pose2 {
        body.pose()
    }

    fn place(pose: &Pose2) -> (DVec2, DVec2) {
        let rotation = pose.rotation();
        (pose.position(), DVec2::new(f64::from(rotation.cos()), f64::from(rotation.sin())))
    }

    fn pose(position: DVec2, turn: DVec2) -> Option<Pose2> {
        Pose2::new(position, Rotation2::new(turn.x as f32, turn.y as f32).ok()?).ok()
    }

    fn motion(from: &Pose2, to: &Pose2) -> Option<Motion2> {
        Motion2::new(to.position() - from.position(), to.rotation()).ok()
    }

    fn fraction(impact: &Impact2) -> f64 {
        impact.fraction
    }

    fn touches(contact: Contact2<'_>, bodies: [u32; 2]) -> impl Iterator<Item = Touch<Self>> {
        let keys = (contact.a, contact.b);
        contact.manifolds.iter().flat_map(move |manifold| {
            let (parts, normal) = ((manifold.part_a, manifold.part_b), manifold.normal.as_dvec2());
            manifold.points.iter().map(move |point| Touch {
                id: TouchId { keys, parts, feature: point.feature.to_bits() },
                bodies,
                normal,
                separation: f64::from(point.separation),
                anchors: [point.anchor_a, point.anchor_b].map(|anchor| anchor.as_dvec2()),
            })
        })
    }
}
