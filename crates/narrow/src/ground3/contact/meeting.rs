//! A convex part and one triangle by the general kernels, and whether ground accepts their axis.

use super::GroundQuery;
use super::facet::{Facet, edge_number};
use super::groups::{Base, Groups, Pin};
use super::rejected_gaps::ClosestPoints;
use super::standing::{Place, Standing};
use crate::exact::Site3;
use crate::feature::{Feature, Hint};
use crate::ground3::OnGround;
use crate::pair3::Part;
use crate::polyhedron::convex::{Convex, Near, Probe, Query, Wanted};
use crate::polyhedron::manifold::Touch;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Ground, Pose3, Shape3};

/// A part and the ground, ready for the kernels: the part is A.
pub(super) struct Meeting<'a> {
    part: Part<'a>,
    body: &'a Pose3,
    ground_pose: &'a Pose3,
    /// The ground's axes and origin in the part's frame.
    relative: Basis3,
    offset: DVec3,
    summed: f64,
}

/// What the kernels found for a part and a triangle.
pub(super) enum Met {
    /// They are further apart than the margin.
    Apart,
    /// They are not, and contact points were added; whether they share a point.
    Added(bool),
    /// They are not, and ground rejected the direction: whether they share a point; whether the direction is nearly the
    /// triangle's normal; the closest points if they share none; and, where they overlap and all of the triangle is
    /// level in that direction, their separation and its error bound.
    Rejected { overlapping: bool, is_own: bool, gap: Option<ClosestPoints>, measured: Option<[f64; 2]> },
}

impl<'a> Meeting<'a> {
    pub(super) fn new(on: &OnGround, part: Part<'a>, [body, ground_pose]: [&'a Pose3; 2]) -> Self {
        let (axes, shift) = part.placed(&on.body_basis);
        let is_part = part.site(body).part.is_some();
        let relative = if is_part { on.basis.relative_to(&axes) } else { ground_pose.basis_from(body) };
        let offset = axes.turn_back(-(on.to_body + shift));
        let summed = if is_part { on.to_body.length() + shift.length() } else { 0.0 };
        Self { part, body, ground_pose, relative, offset, summed }
    }

    fn with<R>(&self, ground: Ground, number: u32, run: impl FnOnce(&Convex) -> R) -> Option<R> {
        let shape = Shape3::Triangle(ground.triangle(number)?);
        let site = Site3 { shape: &shape, body: *self.ground_pose, part: None };
        let sites = [self.part.site(self.body), site];
        Some(run(&Convex::new(sites, self.relative, self.offset, self.summed)))
    }

    /// Whether the part and a triangle share a point, exactly.
    pub(super) fn overlaps(&self, ground: Ground, number: u32) -> bool {
        self.with(ground, number, |convex| convex.verdict().overlapping).unwrap_or(false)
    }

    /// Calls the kernels, and adds their points if ground accepts their axis; if not, the triangle's normal takes its
    /// place.
    pub(super) fn add_points(
        &self,
        (ground, facet): (Ground, &Facet),
        standing: &Standing,
        query: &GroundQuery,
        groups: &mut Groups,
    ) -> Met {
        let place = &standing.place;
        let mut touch = Touch::none();
        // No points are made along directions that ground rejects, as it does most often.
        let is_let_through =
            |near: &Near| query.is_plain || facet.lets_through(ground, -place.axes.turn(near.normal));
        let Some(near) = self.near((ground, facet), query, is_let_through, &mut touch) else {
            return Met::Apart;
        };
        let measured = [near.separation.into(), near.error.into()];
        if self.add_touch((ground, facet), place, (&touch, measured), groups) {
            return Met::Added(near.verdict.overlapping);
        }
        let overlapping = near.verdict.overlapping;
        let towards = -place.axes.turn(near.normal);
        Met::Rejected {
            overlapping,
            is_own: facet.is_nearly_own(towards),
            gap: rejected_gap_of((ground, facet), place, &near),
            measured: (overlapping && facet.is_level_to(towards)).then_some(measured),
        }
    }

    /// The closest points of the part and a triangle, if they are within the margin and share no point.
    pub(super) fn gap(
        &self,
        of: (Ground, &Facet),
        place: &Place,
        query: &GroundQuery,
    ) -> Option<ClosestPoints> {
        let mut touch = Touch::none();
        let near = self.near(of, query, |_| false, &mut touch)?;
        rejected_gap_of(of, place, &near)
    }

    /// The closest points of the part and a triangle, if they are within the margin; where they overlap, the deepest.
    /// And the direction from the triangle to the part, as the kernels have it.
    pub(super) fn nearest(
        &self,
        of: (Ground, &Facet),
        place: &Place,
        query: &GroundQuery,
    ) -> Option<(DVec3, ClosestPoints)> {
        let mut touch = Touch::none();
        let near = self.near(of, query, |_| true, &mut touch)?;
        let towards = -place.axes.turn(near.normal);
        let deepest = touch.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
        let [on_a, on_b] = near.closest.or(deepest.map(|point| [point.on_a, point.on_b]))?;
        let measured = [near.separation.into(), near.error.into()];
        let ends = [place.point(on_a), place.point(on_b)];
        Some((towards, ClosestPoints::along(of, towards, measured, ends)))
    }

    /// The kernels' result, if the two are within the margin; with contact points, where those are wanted.
    ///
    /// Across a gap the closest points are computed first, since most often ground rejects them: axes, and a hint for
    /// the next frame, are computed only where points are made. For cuboids `rejected_gap` has done as much before.
    fn near(
        &self,
        (ground, facet): (Ground, &Facet),
        query: &GroundQuery,
        is_wanted: impl Fn(&Near) -> bool,
        touch: &mut Touch,
    ) -> Option<Near> {
        let of_triangle = Query { limit: query.reach, hint: Hint::NONE, wanted: Wanted::Points };
        let is_near = |near: &Near| near.verdict.overlapping || near.separation <= query.margin;
        let accept = |near: &Near| is_near(near) && is_wanted(near);
        let is_cuboid = matches!(self.part.shape, Shape3::Cuboid(_));
        let probe = self.with(ground, facet.number, |convex| {
            if !(query.is_plain || is_cuboid) {
                let closest = convex.probe(Query { wanted: Wanted::Closest, ..of_triangle });
                match &closest {
                    Probe::Near(near) if near.verdict.overlapping || accept(near) => {}
                    _ => return closest,
                }
            }
            convex.contact(of_triangle, accept, touch).0
        });
        match probe? {
            Probe::Near(near) if is_near(&near) => Some(near),
            _ => None,
        }
    }

    fn add_touch(
        &self,
        (ground, facet): (Ground, &Facet),
        place: &Place,
        (touch, measured): (&Touch, [f64; 2]),
        groups: &mut Groups,
    ) -> bool {
        let towards = -place.axes.turn(touch.normal);
        if touch.points.is_empty() || !facet.lets_through(ground, towards) {
            return false;
        }
        let base = Base::along(towards, ground.patch(facet.number));
        for point in &touch.points {
            let pin = Pin {
                on_body: place.point(point.on_a),
                on_ground: place.point(point.on_b),
                // Where faces cross beside a corner, a point may be lower than the corner: by as much as faces are
                // preferred by.
                separation: point.separation.max(measured[0]),
                doubt: measured[1],
                of_body: point.feature.a(),
                of_ground: feature_on(ground, facet.number, point.feature.b()),
            };
            groups.add(&base, pin);
        }
        // Points may stand for more than there are, and then none of them need have the least separation.
        groups.record(towards, measured);
        true
    }
}

/// The closest points of part and triangle, in the ground's axes; `None` where they overlap.
fn rejected_gap_of(of: (Ground, &Facet), place: &Place, near: &Near) -> Option<ClosestPoints> {
    let [on_a, on_b] = near.closest.filter(|_| !near.verdict.overlapping)?;
    let towards = -place.axes.turn(near.normal);
    let measured = [near.separation.into(), near.error.into()];
    Some(ClosestPoints::along(of, towards, measured, [place.point(on_a), place.point(on_b)]))
}

/// The ground's feature id for a feature of the triangle.
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
