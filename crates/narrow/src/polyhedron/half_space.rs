//! A half-space against a core: a support search along the only axis there is.
//!
//! Of all directions only the plane's own normal can show a gap or a finite depth, so the separation is exact up to
//! rounding: the least height of a vertex over the plane.

use super::manifold::{Frame, Point, Touch, opposed_face};
use super::reduce::{Spot, pick_four};
use super::slender::Slender;
use super::solid::{Solid, across_segment, corner_along};
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::{BVec3, DVec3};
use asunder_geometry::tolerance::MAX_HULL_VERTICES;
use asunder_geometry::{Basis3, Cuboid, Shape3};

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

    /// The position of [`Plane::lowest`] for a shape with these axes and this origin. To build a [`Solid`] of a cuboid
    /// or a capsule takes longer.
    #[inline]
    pub(crate) fn lowest_of(&self, shape: &Shape3, (basis, origin): (&Basis3, DVec3)) -> DVec3 {
        if let Shape3::Cuboid(cuboid) = shape {
            let (half, down) = (cuboid.half_extents().as_dvec3(), basis.turn_back(-self.normal));
            origin + basis.turn(DVec3::select(down.cmpgt(DVec3::ZERO), half, -half))
        } else if let Some(Slender { ends: [one, other], .. }) = Slender::of(shape, (basis, origin)) {
            if self.height(other) < self.height(one) { other } else { one }
        } else if let Shape3::Triangle(triangle) = shape {
            let [a, b, c] = triangle.vertices().map(|vertex| origin + basis.turn(vertex.as_dvec3()));
            let lower =
                |one: DVec3, other: DVec3| if self.height(other) < self.height(one) { other } else { one };
            lower(lower(a, b), c)
        } else {
            let core = shape.core();
            let core = Solid::new(&core, *basis, origin, 0.0);
            core.point(self.lowest(&core).0)
        }
    }

    /// The separation of two half-spaces: the distance of their planes if the normals are exactly opposite; else they
    /// overlap without end. `are_opposed` is called only where the planes are parallel up to rounding.
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

    /// Contact points at corners, at most four, of the face that faces the plane, no more than `margin` above it.
    /// Corners higher than the lowest by no more than the first of `slacks` (the preference) count as deepest; for the
    /// choice of four, by no more than the second (`even`).
    pub(crate) fn touch(&self, core: &Solid, margin: f64, slacks: [f64; 2]) -> Touch {
        let opposed = opposed_face(core, self.normal, slacks[0]);
        let corners = core.topology.face_vertices(opposed.face).map(|vertex| (vertex, core.point(vertex)));
        let lowest = (opposed.deepest, core.point(opposed.deepest));
        let outwards = core.outwards(opposed.face, -self.normal);
        self.touch_corners(corners, lowest, (core.radius, outwards), margin, slacks)
    }

    /// [`Plane::touch`] for a shape with these axes and this origin: without a [`Solid`] where possible, since building
    /// that from a cuboid or a capsule takes as long as all the rest.
    #[inline]
    pub(crate) fn touch_shape(
        &self,
        shape: &Shape3,
        (basis, origin): (&Basis3, DVec3),
        margin: f64,
        slacks: [f64; 2],
    ) -> Touch {
        if let Some(Slender { ends, radius, .. }) = Slender::of(shape, (basis, origin)) {
            let is_last = self.height(ends[1]) < self.height(ends[0]);
            let lowest = (usize::from(is_last), ends[usize::from(is_last)]);
            let outwards = across_segment(ends[1] - ends[0], -self.normal);
            let count = if ends[0] == ends[1] { 1 } else { 2 };
            let corners = ends.into_iter().enumerate().take(count);
            return self.touch_corners(corners, lowest, (radius, outwards), margin, slacks);
        }
        if let Shape3::Cuboid(cuboid) = shape
            && let Some(face) = self.face_of(cuboid, basis, slacks[0])
        {
            let half = cuboid.half_extents().as_dvec3();
            let corner = |vertex: usize| {
                let is_upper = BVec3::new(vertex & 1 != 0, vertex & 2 != 0, vertex & 4 != 0);
                (vertex, origin + basis.turn(DVec3::select(is_upper, half, -half)))
            };
            let lowest = corner(corner_along(basis.turn_back(-self.normal)));
            let corners = Cuboid::topology().face_vertices(face).map(corner);
            let surface = (cuboid.radius().into(), Some(basis.turn(Cuboid::NORMALS[face])));
            return self.touch_corners(corners, lowest, surface, margin, slacks);
        }
        let core = shape.core();
        self.touch(&Solid::new(&core, *basis, origin, f64::from(shape.radius())), margin, slacks)
    }

    /// The face of a cuboid that faces the plane, as [`opposed_face`]; `None` unless at most four corners are as low as
    /// the lowest, up to the slack, and lie on one face.
    fn face_of(&self, cuboid: &Cuboid, basis: &Basis3, slack: f64) -> Option<usize> {
        let down = basis.turn_back(-self.normal).to_array();
        let rises = [0, 1, 2].map(|axis| 2.0 * f64::from(cuboid.half_extents()[axis]) * down[axis].abs());
        let is_level = rises.map(|rise| rise <= slack);
        let all: f64 =
            rises.iter().zip(is_level).map(|(rise, is_level)| if is_level { *rise } else { 0.0 }).sum();
        if is_level == [true; 3] || all > slack {
            return None;
        }
        // Of the faces that have all of the lowest corners, the one that faces down the most; on ties, the first.
        let faces = (0..3)
            .filter(|&axis| !is_level[axis])
            .map(|axis| (2 * axis + usize::from(down[axis] > 0.0), down[axis].abs()));
        faces.reduce(|best, next| if next.1 > best.1 { next } else { best }).map(|(face, _)| face)
    }

    /// The contact points of a face's corners, which come with their numbers. `lowest` is the lowest vertex of all;
    /// `radius` and `outwards` say how far the surface lies beyond the face, and in which direction.
    #[inline]
    fn touch_corners(
        &self,
        corners: impl Iterator<Item = (usize, DVec3)>,
        lowest: (usize, DVec3),
        (radius, outwards): (f64, Option<DVec3>),
        margin: f64,
        [preference, even]: [f64; 2],
    ) -> Touch {
        let deep = self.height(lowest.1) + preference;
        let within = margin.max(deep - radius);
        let mut points: ArrayVec<Point, MAX_HULL_VERTICES> = ArrayVec::new();
        for (vertex, corner) in corners {
            let is_deep = vertex == lowest.0 || self.height(corner) <= deep;
            // A higher corner belongs to a tilted face, whose surface lies out along the face's own normal.
            let Some(outwards) = (if is_deep { Some(-self.normal) } else { outwards }) else { continue };
            let point = corner + outwards * radius;
            let separation = if is_deep { self.height(corner) - radius } else { self.height(point) };
            if separation > within && vertex != lowest.0 {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Numbers;
    use asunder_geometry::glam::{Quat, Vec3};
    use asunder_geometry::{Capsule3, Pose3, Segment3};

    /// Upright and nearly upright, where several corners are as low as the lowest, and in any pose; plates and rods,
    /// too.
    #[test]
    fn a_shape_touches_as_its_solid_does() {
        let mut numbers = Numbers::new(31);
        let mut counts = [0; 5];
        for i in 0..6000 {
            let size = numbers.vector().abs() + DVec3::splat(0.05);
            let thin =
                DVec3::new(1.0, [1.0, 1e-6][usize::from(i % 7 == 0)], [1.0, 1e-5][usize::from(i % 5 == 0)]);
            let end = numbers.vector().as_vec3();
            let shape: Shape3 = match i % 4 {
                0 => Cuboid::from_half_extents((size * thin).as_vec3()).unwrap().into(),
                1 => Cuboid::from_half_extents(size.as_vec3()).unwrap().rounded(0.1).unwrap().into(),
                2 => Capsule3::new(end, -end, 0.3).unwrap().into(),
                _ => Segment3::new(Vec3::ZERO, end).unwrap().into(),
            };
            let tilt = numbers.vector() * [0.0, 1e-9, 1e-6, 1e-4, 1.0][i % 5];
            let rotation = Quat::from_xyzw(tilt.x as f32, tilt.y as f32, tilt.z as f32, 1.0);
            let basis = Pose3::new(DVec3::ZERO, rotation).unwrap().basis();
            let normal = if i % 3 == 0 { numbers.vector().normalize() } else { DVec3::Y };
            let plane = Plane { normal, origin: numbers.vector(), is_b: i % 2 == 0 };
            let (at, margin) = (numbers.vector(), numbers.vector().x.max(0.0));
            let slacks = [1e-6, 1e-4];
            let core = shape.core();
            let solid = Solid::new(&core, basis, at, f64::from(shape.radius()));
            let by_solid = plane.touch(&solid, margin, slacks);
            let by_shape = plane.touch_shape(&shape, (&basis, at), margin, slacks);
            assert_eq!(by_shape.points.len(), by_solid.points.len(), "{i}");
            for (one, other) in by_shape.points.iter().zip(&by_solid.points) {
                assert_eq!(one.feature, other.feature, "{i}");
                let off = (one.on_a - other.on_a).length() + (one.on_b - other.on_b).length();
                assert!(off < 1e-14 && (one.separation - other.separation).abs() < 1e-14, "{i}: {off}");
            }
            counts[by_shape.points.len()] += 1;
        }
        assert!(counts[0] == 0 && counts[1..].iter().all(|&count| count > 100), "{counts:?}");
    }
}
