//! A half-plane against a core: one support point and its height. There is one axis in all.
//!
//! Of all directions only the line's own normal can show a gap or a finite depth, so the separation is exact up to
//! rounding: the least height of a vertex over the line.

use super::manifold::{Point, Touch};
use super::outline::Outline;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;

/// Sine of the angle up to which two lines count as possibly parallel: far more than the rounding of two unit normals.
const PARALLEL: f64 = 1e-12;

/// The line of a half-plane, in the frame of the pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Line {
    /// Unit normal, out of the half-plane.
    pub(crate) normal: DVec2,
    /// A point on it.
    pub(crate) origin: DVec2,
    /// Whether the half-plane is B.
    pub(crate) is_b: bool,
}

impl Line {
    /// Unit axis from A to B.
    pub(crate) fn axis(&self) -> DVec2 {
        if self.is_b { -self.normal } else { self.normal }
    }

    fn height(&self, point: DVec2) -> f64 {
        self.normal.dot(point - self.origin)
    }

    /// The lowest vertex of a core and its height, which is the separation.
    pub(crate) fn lowest(&self, core: &Outline) -> (usize, f64) {
        let vertex = core.support(-self.normal).vertex;
        (vertex, self.height(core.point(vertex)))
    }

    /// Two half-planes: the distance of their lines if their normals are exactly opposite; else they overlap
    /// without end. The exact test is made only where f64 leaves it open.
    pub(crate) fn separation_from(&self, other: &Self, are_opposed: impl FnOnce() -> bool) -> f64 {
        let may_be =
            self.normal.perp_dot(other.normal).abs() <= PARALLEL && self.normal.dot(other.normal) < 0.0;
        if may_be && are_opposed() { self.height(other.origin) } else { f64::NEG_INFINITY }
    }

    /// A point of each line, half way between their origins.
    pub(crate) fn points_with(&self, other: &Self) -> [DVec2; 2] {
        let middle = (self.origin + other.origin) * 0.5;
        [self, other].map(|line| middle - line.normal * line.height(middle))
    }

    /// The lowest vertex, and the other end of the edge there that faces the line most, if that is no more than
    /// `margin` above the line. Vertices up to `preference` higher than the lowest count as equally deep.
    pub(crate) fn touch(&self, core: &Outline, margin: f64, preference: f64) -> Touch {
        let (lowest, height) = self.lowest(core);
        let deep = height + preference;
        let within = margin.max(deep - core.radius);
        let (before, after) = (core.before(lowest), core.after(lowest));
        let facing =
            |edge: usize| if edge < core.edge_count() { core.normal(edge).dot(self.normal) } else { 0.0 };
        let (neighbour, edge) =
            if facing(lowest) < facing(before) { (after, lowest) } else { (before, before) };
        let contact = |vertex: usize| {
            let corner = core.point(vertex);
            // A vertex that is higher belongs to a tilted edge, whose surface lies out along the edge's own normal.
            let is_deep = vertex == lowest || self.height(corner) <= deep;
            let outwards = if is_deep { -self.normal } else { core.normal(edge) };
            let point = corner + outwards * core.radius;
            let separation = if is_deep { self.height(corner) - core.radius } else { self.height(point) };
            let foot = point - self.normal * separation;
            let (of_line, of_core) = (Feature::Edge(0), Feature::Vertex(vertex as u32));
            if self.is_b {
                Point { separation, on_a: point, on_b: foot, feature: FeatureId::new(of_core, of_line) }
            } else {
                Point { separation, on_a: foot, on_b: point, feature: FeatureId::new(of_line, of_core) }
            }
        };
        let mut points: ArrayVec<Point, 2> = core::iter::once(contact(lowest)).collect();
        if neighbour != lowest {
            points.extend(core::iter::once(contact(neighbour)).filter(|point| point.separation <= within));
        }
        points.sort_unstable_by_key(|point| point.feature);
        Touch { normal: self.axis(), points, reference: None }
    }
}
