//! The plane.

use super::Sight;
use crate::batch::Frame;
use crate::form::Form;
use crate::paint::Paint;
use asunder::glam::{DVec2, DVec3, Vec3};
use asunder::{
    BodyKey2, Collider2, DebugLine, DebugOptions, Filter2, Pair2, Plane, Pose2, Shape2, Tier, World2,
};
use asunder_examples::picture::mesh;

impl Sight for Plane {
    const FLAT: bool = true;

    fn within(v: DVec3) -> DVec3 {
        v.truncate().extend(0.0)
    }

    fn position(body: &Collider2) -> DVec3 {
        body.pose().position().extend(0.0)
    }

    fn frame(body: &Collider2, from: DVec3) -> Frame {
        let axis = |axis: DVec2| body.pose().turn(axis).extend(0.0).as_vec3();
        Frame {
            position: (Self::position(body) - from).as_vec3(),
            axes: [axis(DVec2::X), axis(DVec2::Y), Vec3::Z],
        }
    }

    fn ball(body: &Collider2) -> (DVec3, f64) {
        let center = body.pose().transform(body.shape().center().as_dvec2());
        (center.extend(0.0), f64::from(body.shape().outer_radius()))
    }

    fn corners(body: &Collider2) -> (DVec3, DVec3) {
        let bounds = body.shape().bounds(body.pose(), 0.0);
        (bounds.min.as_dvec2().extend(0.0), bounds.max.as_dvec2().extend(0.0))
    }

    fn likeness(body: &Collider2) -> Option<[u64; 3]> {
        let radius = u64::from(body.shape().radius().to_bits());
        match body.shape() {
            Shape2::Circle(_) => Some([0, radius, 0]),
            Shape2::Rect(rect) if radius == 0 => {
                let [x, y] = rect.vertices()[0].abs().to_array().map(|half| u64::from(half.to_bits()));
                Some([1, x, y])
            }
            Shape2::Compound(compound) => Some([2, compound.shared_address() as u64, 0]),
            _ => None,
        }
    }

    fn form(body: &Collider2, endless: f64) -> Form {
        let mut form = Form::default();
        match body.shape() {
            Shape2::HalfPlane(half_plane) => {
                let normal = half_plane.unit_normal();
                let (along, deep) = (normal.perp() * endless, normal * -endless);
                form.add_flat(&[-along, deep - along, along + deep, along]);
            }
            // These are shown by lines.
            Shape2::Chain(_) | Shape2::Segment(_) => {}
            shape => {
                let at_rest = Collider2::new(shape.clone()).at(Pose2::IDENTITY);
                mesh::outlines(&at_rest).iter().for_each(|outline| form.add_flat(outline));
            }
        }
        form
    }

    fn paint(body: &Collider2) -> Paint {
        match body.shape() {
            Shape2::Rect(_) => Paint::WOOD,
            Shape2::Circle(_) => Paint::BALL,
            Shape2::Capsule(_) => Paint::RUBBER,
            Shape2::Compound(_) => Paint::METAL,
            _ => Paint::STONE,
        }
    }

    fn lines(world: &World2, options: &DebugOptions, line: &mut impl FnMut(DVec3, DVec3, DebugLine)) {
        world.debug_lines(options, &mut |from: DVec2, to: DVec2, what| {
            line(from.extend(0.0), to.extend(0.0), what);
        });
    }

    fn tiers(world: &World2, mut tell: impl FnMut([BodyKey2; 2], Tier, &mut dyn Iterator<Item = DVec3>)) {
        for contact in world.contacts() {
            let Some((a, b)) = world.get(contact.a).zip(world.get(contact.b)) else { continue };
            let tier = Pair2::new(a.shape(), a.pose(), b.shape(), b.pose()).verdict().tier;
            let points = contact.manifolds.iter().flat_map(|manifold| &manifold.points);
            let mut places =
                points.map(|point| (a.pose().position() + point.anchor_a.as_dvec2()).extend(0.0));
            tell([contact.a, contact.b], tier, &mut places);
        }
    }

    fn pick(world: &World2, from: DVec3, _: DVec3, _: &[BodyKey2]) -> Option<(BodyKey2, DVec3)> {
        let point = from.truncate();
        let mut found = Vec::new();
        world.overlapping_point(point, &Filter2::new().solid(), &mut found);
        let moves = |key: &&BodyKey2| world.get(**key).is_some_and(|body| !body.is_fixed());
        let key = found.iter().find(moves).or(found.first())?;
        Some((*key, point.extend(0.0)))
    }

    fn between(_: &World2, _: DVec3, _: DVec3, found: &mut Vec<BodyKey2>) {
        found.clear();
    }
}
