//! The game in space.

use crate::physics::{Matter, Physics, Touch, TouchId};
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::{Collider3, Contact3, Impact3, MassProperties3, Motion3, Pose3, Volume};

impl Physics for Volume {
    type Vector = DVec3;
    type Spin = DVec3;
    type Turn = DQuat;
    type Inertia = DMat3;
    const IMMOVABLE: DMat3 = DMat3::ZERO;

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

    fn matter(body: &Collider3) -> Option<Matter<Self>> {
        let MassProperties3 { mass, center, inertia } = body.shape().mass_properties(1.0).ok()?;
        let (inverse_mass, inverse_inertia) = (1.0 / mass, inertia.inverse());
        let (size, reach) = (libm::cbrt(mass), f64::from(body.shape().outer_radius()));
        let is_sound = inverse_mass.is_finite() && inverse_inertia.is_finite();
        is_sound.then_some(Matter { inverse_mass, inverse_inertia, center, size, reach })
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

    fn motion(from: &Pose3, to: &Pose3) -> Option<Motion3> {
        Motion3::new(to.position() - from.position(), to.rotation()).ok()
    }

    fn fraction(impact: &Impact3) -> f64 {
        impact.fraction
    }

    fn touches(contact: Contact3<'_>, bodies: [u32; 2]) -> impl Iterator<Item = Touch<Self>> {
        let keys = (contact.a, contact.b);
        contact.manifolds.iter().flat_map(move |manifold| {
            let (parts, normal) = ((manifold.part_a, manifold.part_b), manifold.normal.as_dvec3());
            manifold.points.iter().map(move |point| Touch {
                id: TouchId { keys, parts, feature: point.feature.to_bits() },
                bodies,
                normal,
                separation: f64::from(point.separation),
                anchors: [point.anchor_a, point.anchor_b].map(|anchor| anchor.as_dvec3()),
            })
        })
    }
}
