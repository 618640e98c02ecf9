//! A half-space against a core: two dot products for the nearest vertex, one axis in all.
//!
//! Of all directions only the plane's own normal can show a gap or a finite depth, so the separation is exact up to
//! rounding: the least height of a vertex over the plane.

use super::manifold::{Frame, Point, Touch, opposed_face};
use super::reduce::{Spot, pick_four};
use super::slender::Slender;
use super::solid::Solid;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
use asunder_geometry::{Basis3, Shape3};

/// Sine of the angle up to which two planes may be parallel: far more than the roundings of two unit normals.
const PARALLEL: f64 = 1e-12;

/// The plane of a half-space, in the frame of the pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Plane {
    /// Unit normal, out of the half-space.
    pub(crate) normal: DVec3,
    /// A point on it.
    pub(crate) origin: DVec3,
    /// Whether the half-space is B.
    pub(crate) is_b: bool,
}

impl Plane {
    /// Unit axis from A to B.
    pub(crate) fn axis(&self) -> DVec3 {
        if self.is_b { -self.normal } else { self.normal }
    }

    pub(crate) fn height(&self, point: DVec3) -> f64 {
        self.normal.dot(point - self.origin)
    }

    /// The lowest vertex of a core and its height, which is the separation.
    pub(crate) fn lowest(&self, core: &Solid) -> (usize, f64) {
        let vertex = core.support(-self.normal).vertex;
        (vertex, self.height(core.point(vertex)))
    }

    /// The same of a shape that has its axes and its origin there: where the vertex is. To make a [`Solid`] of a cuboid or a
    /// capsule takes longer.
    #[inline]
    pub(crate) fn lowest_of(&self, shape: &Shape3, (basis, origin): (&Basis3, DVec3)) -> DVec3 {
        if let Shape3::Cuboid(cuboid) = shape {
            let (half, down) = (cuboid.half_extents().as_dvec3(), basis.turn_back(-self.normal));
            origin + basis.turn(DVec3::select(down.cmpgt(DVec3::ZERO), half, -half))
        } else if let Some(Slender { ends: [one, other], .. }) = Slender::of(shape, (basis, origin)) {
            if self.height(other) < self.height(one) { other } else { one }
        } else {
            let core = shape.core();
            let core = Solid::new(&core, *basis, origin, 0.0);
            core.point(self.lowest(&core).0)
        }
    }

    /// Two half-spaces: the distance of planes that look exactly away from each other; else they overlap without end.
    /// Whether they do is asked only of those that may.
    pub(crate) fn separation_from(&self, other: &Self, are_opposed: impl FnOnce() -> bool) -> f64 {
        let may_be =
            self.normal.cross(other.normal).length() <= PARALLEL && self.normal.dot(other.normal) < 0.0;
        if may_be && are_opposed() { self.height(other.origin) } else { f64::NEG_INFINITY }
    }

    /// A point of each plane, half way between their origins.
    pub(crate) fn points_with(&self, other: &Self) -> [DVec3; 2] {
        let middle = (self.origin + other.origin) * 0.5;
        [self, other].map(|plane| middle - plane.normal * plane.height(middle))
    }

    /// The corners, at most four, of the face that looks at the plane, and no more than `margin` above it. Corners
    /// that are no higher than the lowest, up to `preference`, are as deep as any; up to `even`, for the choice of four.
    pub(crate) fn touch(&self, core: &Solid, margin: f64, [preference, even]: [f64; 2]) -> Touch {
        let opposed = opposed_face(core, self.normal, preference);
        let (face, lowest) = (opposed.face, opposed.deepest);
        let deep = self.height(core.point(lowest)) + preference;
        let within = margin.max(deep - core.radius);
        // What is higher belongs to a tilted face, whose surface lies out along its own normal.
        let outwards = core.outwards(face, -self.normal);
        let mut points: ArrayVec<Point, MAX_HULL_VERTICES> = ArrayVec::new();
        for vertex in core.topology.face_vertices(face) {
            let corner = core.point(vertex);
            let is_deep = vertex == lowest || self.height(corner) <= deep;
            let Some(outwards) = (if is_deep { Some(-self.normal) } else { outwards }) else { continue };
            let point = corner + outwards * core.radius;
            let separation = if is_deep { self.height(corner) - core.radius } else { self.height(point) };
            if separation > within && vertex != lowest {
                continue;
            }
            let foot = point - self.normal * separation;
            let (of_plane, of_core) = (Feature::Face(0), Feature::Vertex(vertex as u32));
            let _ = points.try_push(if self.is_b {
                Point { separation, on_a: point, on_b: foot, feature: FeatureId::new(of_core, of_plane) }
            } else {
                Point { separation, on_a: foot, on_b: point, feature: FeatureId::new(of_plane, of_core) }
            });
        }
        Touch { normal: self.axis(), points: self.kept(&points, even), of: None }
    }

    /// At most four of the corners of a face, in order of their ids.
    fn kept(&self, points: &[Point], even: f64) -> ArrayVec<Point, 4> {
        let mut kept: ArrayVec<Point, 4> = ArrayVec::new();
        if points.len() <= 4 {
            kept.extend(points.iter().copied());
        } else {
            let frame = Frame::level(self.normal, self.origin);
            let spot =
                |i: usize| Spot { at: frame.place(points[i].on_a).0, separation: points[i].separation };
            kept.extend(
                pick_four(points.len(), spot, |i| points[i].feature, even).into_iter().map(|i| points[i]),
            );
        }
        kept.sort_unstable_by_key(|point| point.feature);
        kept
    }
}
