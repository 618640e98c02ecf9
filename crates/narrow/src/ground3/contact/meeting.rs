//! A convex part and one triangle by the general kernels, and which of their axes ground lets through.

use super::Asking;
use super::facet::{Facet, edge_number};
use super::groups::{Base, Groups, Pin};
use super::standing::{Place, Standing};
use crate::exact::Site3;
use crate::feature::{Feature, Hint};
use crate::ground3::OnGround;
use crate::pair3::Part;
use crate::polyhedron::convex::{Asked, Convex, Near, Probe, Wanted};
use crate::polyhedron::manifold::Touch;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Ground, Pose3, Shape3};

/// A part and the ground, ready for the kernels: the part is A.
pub(super) struct Meeting<'a> {
    part: Part<'a>,
    body: &'a Pose3,
    field: &'a Pose3,
    /// The ground's axes and its origin as the part sees them.
    relative: Basis3,
    offset: DVec3,
    summed: f64,
}

/// What the kernels say of a part and a triangle.
pub(super) enum Met {
    /// They are further apart than the margin.
    Apart,
    /// They are not; whether they share a point, and whether points were made of it.
    Near { overlapping: bool, has_points: bool },
}

impl<'a> Meeting<'a> {
    pub(super) fn new(on: &OnGround, part: Part<'a>, [body, field]: [&'a Pose3; 2]) -> Self {
        let (axes, shift) = part.placed(&on.body_basis);
        let is_part = part.site(body).part.is_some();
        let relative = if is_part { on.basis.relative_to(&axes) } else { field.basis_from(body) };
        let offset = axes.turn_back(-(on.to_body + shift));
        let summed = if is_part { on.to_body.length() + shift.length() } else { 0.0 };
        Self { part, body, field, relative, offset, summed }
    }

    fn with<R>(&self, ground: Ground, number: u32, ask: impl FnOnce(&Convex) -> R) -> Option<R> {
        let shape = Shape3::Triangle(ground.triangle(number)?);
        let site = Site3 { shape: &shape, body: *self.field, part: None };
        let sites = [self.part.site(self.body), site];
        Some(ask(&Convex::new(sites, self.relative, self.offset, self.summed)))
    }

    /// Whether the part and a triangle share a point, exactly.
    pub(super) fn overlaps(&self, ground: Ground, number: u32) -> bool {
        self.with(ground, number, |convex| convex.verdict().overlapping).unwrap_or(false)
    }

    /// Asks the kernels, and adds their points where ground lets their axis through: not where the triangle's own
    /// normal takes its place.
    pub(super) fn add_points(
        &self,
        (ground, facet): (Ground, &Facet),
        standing: &Standing,
        asking: &Asking,
        groups: &mut Groups,
    ) -> Met {
        let (place, margin) = (&standing.place, asking.margin);
        let mut touch = Touch::NONE;
        let asked = Asked { limit: asking.reach, hint: Hint::NONE, wanted: Wanted::Points };
        let is_near = |near: &Near| near.verdict.overlapping || near.separation <= margin;
        // No points are made along what ground refuses, as it does most often.
        let is_let_through =
            |near: &Near| asking.is_plain || facet.lets_through(ground, -place.axes.turn(near.normal));
        let found = self.with(ground, facet.number, |convex| {
            let accept = |near: &Near| is_near(near) && is_let_through(near);
            let (probe, _) = convex.contact(asked, accept, &mut touch);
            match probe {
                Probe::Near(near) if is_near(&near) => {
                    Some((near.verdict.overlapping, f64::from(near.error)))
                }
                _ => None,
            }
        });
        let Some(Some((overlapping, error))) = found else { return Met::Apart };
        let has_points = self.add_touch((ground, facet), place, (&touch, error), groups);
        Met::Near { overlapping, has_points }
    }

    fn add_touch(
        &self,
        (ground, facet): (Ground, &Facet),
        place: &Place,
        (touch, error): (&Touch, f64),
        groups: &mut Groups,
    ) -> bool {
        let towards = -place.axes.turn(touch.normal);
        if touch.points.is_empty() || !facet.lets_through(ground, towards) {
            return false;
        }
        let base = Base { normal: towards, patch: ground.patch(facet.number), weight: 0.0 };
        for point in &touch.points {
            let pin = Pin {
                on_body: place.point(point.on_a),
                on_ground: place.point(point.on_b),
                separation: point.separation,
                doubt: error,
                of_body: point.feature.a(),
                of_ground: feature_on(ground, facet.number, point.feature.b()),
            };
            groups.add(&base, pin);
        }
        true
    }
}

/// The name of a triangle's own feature on the ground.
fn feature_on(ground: Ground, triangle: u32, feature: Feature) -> Feature {
    match feature {
        Feature::Vertex(corner) => {
            let numbers = ground.vertex_numbers(triangle);
            Feature::Vertex(numbers[corner as usize % 3])
        }
        Feature::Edge(edge) => Feature::Edge(edge_number(ground, triangle, edge as usize % 3)),
        Feature::Face(_) => Feature::Face(ground.patch(triangle)),
    }
}
