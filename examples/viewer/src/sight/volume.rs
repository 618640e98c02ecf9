//! Space.

use super::Sight;
use crate::batch::Frame;
use crate::form::Form;
use crate::paint::Paint;
use asunder::glam::DVec3;
use asunder::{
    BodyKey3, Collider3, DebugLine, DebugOptions, Filter3, Pair3, Pose3, Ray3, RayAnswer3, Shape3, Tier,
    Volume, World3,
};
use asunder_examples::picture::mesh;

impl Sight for Volume {
    const FLAT: bool = false;

    fn within(v: DVec3) -> DVec3 {
        v
    }

    fn position(body: &Collider3) -> DVec3 {
        body.pose().position()
    }

    fn frame(body: &Collider3, from: DVec3) -> Frame {
        let (pose, basis) = (body.pose(), body.pose().basis());
        Frame {
            position: (pose.position() - from).as_vec3(),
            axes: DVec3::AXES.map(|axis| basis.turn(axis).as_vec3()),
        }
    }

    fn ball(body: &Collider3) -> (DVec3, f64) {
        let center = body.pose().transform(body.shape().center().as_dvec3());
        (center, f64::from(body.shape().outer_radius()))
    }

    fn corners(body: &Collider3) -> (DVec3, DVec3) {
        let bounds = body.shape().bounds(body.pose(), 0.0);
        (bounds.min.as_dvec3(), bounds.max.as_dvec3())
    }

    fn likeness(body: &Collider3) -> Option<[u64; 3]> {
        let radius = u64::from(body.shape().radius().to_bits());
        match body.shape() {
            Shape3::Sphere(_) => Some([0, radius, 0]),
            Shape3::Cuboid(cuboid) if radius == 0 => {
                let [x, y, z] = cuboid.vertices()[0].abs().to_array().map(|half| u64::from(half.to_bits()));
                Some([1, x << 32 | y, z])
            }
            Shape3::Hull(hull) => Some([2, radius, hull.shared_address() as u64]),
            Shape3::Compound(compound) => Some([3, compound.shared_address() as u64, 0]),
            _ => None,
        }
    }

    fn form(body: &Collider3, endless: f64) -> Form {
        if let Shape3::HalfSpace(half_space) = body.shape() {
            return Form::board(half_space.unit_normal(), endless);
        }
        let mut form = Form::default();
        let at_rest = Collider3::new(body.shape().clone()).at(Pose3::IDENTITY);
        for part in mesh::parts(&at_rest) {
            for face in mesh::faces(&part) {
                form.add(face.normal, face.corners, 1.0);
            }
        }
        form
    }

    fn paint(body: &Collider3) -> Paint {
        match body.shape() {
            Shape3::Cuboid(_) => Paint::WOOD,
            Shape3::Sphere(_) => Paint::BALL,
            Shape3::Capsule(_) => Paint::RUBBER,
            Shape3::Compound(_) => Paint::METAL,
            _ => Paint::STONE,
        }
    }

    fn lines(world: &World3, options: &DebugOptions, line: &mut impl FnMut(DVec3, DVec3, DebugLine)) {
        world.debug_lines(options, line);
    }

    fn tiers(world: &World3, mut tell: impl FnMut([BodyKey3; 2], Tier, &mut dyn Iterator<Item = DVec3>)) {
        for contact in world.contacts() {
            let Some((a, b)) = world.get(contact.a).zip(world.get(contact.b)) else { continue };
            let tier = Pair3::new(a.shape(), a.pose(), b.shape(), b.pose()).verdict().tier;
            let points = contact.manifolds.iter().flat_map(|manifold| &manifold.points);
            let mut places = points.map(|point| a.pose().position() + point.anchor_a.as_dvec3());
            tell([contact.a, contact.b], tier, &mut places);
        }
    }

    fn pick(world: &World3, from: DVec3, direction: DVec3, hidden: &[BodyKey3]) -> Option<(BodyKey3, DVec3)> {
        let ray = Ray3::new(from, direction.as_vec3()).ok()?;
        let is_shown = |key: BodyKey3, _: &Collider3| !hidden.contains(&key);
        let answer = world.cast_ray(&ray, 1e6, &Filter3::new().solid().only(&is_shown))?;
        Some((answer.body, answer.point))
    }

    fn between(world: &World3, from: DVec3, to: DVec3, found: &mut Vec<BodyKey3>) {
        found.clear();
        let Ok(ray) = Ray3::between(from, to) else { return };
        let is_scenery = |_, body: &Collider3| body.is_fixed();
        let mut answers: Vec<RayAnswer3> = Vec::new();
        world.cast_ray_all(&ray, 1.0, &Filter3::new().solid().only(&is_scenery), &mut answers);
        found.extend(answers.iter().map(|answer| answer.body));
    }
}
