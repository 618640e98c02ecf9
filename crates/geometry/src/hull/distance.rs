//! Distance of a point from a hull, and whether the hull contains it.

use super::{Hull, HullData};
use crate::outward::round_up;
use crate::tolerance::MAX_RADIUS;
use glam::{DVec3, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

impl Hull {
    /// Whether the closed shape contains a local point, in metres.
    ///
    /// - Without rounding, this is decided exactly, for the hull of the vertices, even where facets were merged into a
    ///   face that is flat only up to rounding. Exact as long as no product of three coordinates underflows, as it may
    ///   with a coordinate below 1e-200 m.
    /// - With rounding, the shape is whatever lies within the radius of the nearest feature.
    ///
    /// Cost: a dot product per face; for a point on the surface up to rounding, 30 to 50 ns for each triangle of the
    /// surface (Intel Xeon, Ice Lake, 2026-11-27).
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        let point = point.into();
        // Such a point is far beyond any shape, and its squares could overflow.
        if !point.is_finite() || point.abs().max_element() > 4.0 * f64::from(MAX_RADIUS) {
            return false;
        }
        if self.data.dimension < 3 && self.radius == 0.0 {
            return self.data.bears(point);
        }
        let radius = f64::from(self.radius);
        let beyond = self.data.beyond_faces(point);
        // Covers some ten roundings of normals, heights and the point; a face's own corners are not further off its
        // plane.
        let rounding = 32.0 * f64::EPSILON * (point.abs().element_sum() + f64::from(self.extent()));
        if beyond > radius + rounding {
            return false;
        }
        if self.data.dimension == 3 && beyond < -(rounding + 4.0 * f64::from(self.planarity_error())) {
            return true;
        }
        let surface = self.data.surface();
        if self.data.dimension == 3 && radius == 0.0 {
            return !surface.is_outside(point);
        }
        surface.distance_outside(point) <= radius
    }
}

impl HullData {
    /// Whether a hull without volume contains a point: exact, as long as no product of three coordinates underflows.
    pub(super) fn bears(&self, p: DVec3) -> bool {
        let vertex = |i: usize| self.vertices[i].as_dvec3();
        match self.vertices.len() {
            0 => false,
            1 => p == vertex(0),
            2 => {
                let (a, b) = (vertex(0), vertex(1));
                (0..3).all(|axis| turn(axis, [a, b, p]) == 0.0)
                    && p.cmpge(a.min(b)).all()
                    && p.cmple(a.max(b)).all()
            }
            count => {
                // Any three corners make a triangle, as no three are on one line.
                let (normal, axis) = (self.normals[0], largest_axis(self.normals[0]));
                let height = orient3d(exact(vertex(0)), exact(vertex(1)), exact(vertex(2)), exact(p));
                let sense = normal[axis].signum();
                let is_left = |i: usize| turn(axis, [vertex(i), vertex((i + 1) % count), p]) * sense >= 0.0;
                height == 0.0 && (0..count).all(is_left)
            }
        }
    }

    /// The greatest height of a point above any face, in metres: a lower bound of its distance, negative if it is in
    /// front of no face. Minus infinity for a segment or a point, which have no faces.
    fn beyond_faces(&self, p: DVec3) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for (normal, &height) in self.normals.iter().zip(&self.octets.heights) {
            let beyond = normal.dot(p) - height;
            most = if beyond > most { beyond } else { most };
        }
        most
    }

    /// The exact surface.
    #[inline]
    pub(super) fn surface(&self) -> Surface<'_> {
        Surface { dimension: self.dimension, vertices: &self.vertices, facets: &self.facets }
    }
}

/// The exact facets of a hull, in triangles. A segment is a triangle without area, and so is a point.
#[derive(Clone, Copy)]
pub(super) struct Surface<'a> {
    pub(super) dimension: u8,
    pub(super) vertices: &'a [Vec3],
    pub(super) facets: &'a [[u8; 3]],
}

impl Surface<'_> {
    fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.facets.iter().map(|corners| corners.map(|i| self.vertices[usize::from(i)].as_dvec3()))
    }

    /// An upper bound on a point's distance from the hull: its distance to the nearest triangle, or zero if it lies
    /// outside of none.
    pub(super) fn distance_outside(&self, p: DVec3) -> f64 {
        if self.dimension == 3 && !self.is_outside(p) {
            return 0.0;
        }
        self.triangles().map(|corners| to_triangle(p, corners)).fold(f64::INFINITY, f64::min)
    }

    /// The greatest of these bounds over many points. For a point that is no further from some triangle than the
    /// greatest bound so far, the nearest triangle need not be found.
    pub(super) fn furthest_outside(&self, points: impl Iterator<Item = DVec3>) -> f64 {
        let (mut most, mut near) = (0.0, self.near());
        for p in points {
            let distance = near.distance(p, most);
            if distance > most && (self.dimension < 3 || self.is_outside(p)) {
                most = distance;
            }
        }
        most
    }

    /// Its triangles, prepared for many points in turn.
    pub(super) fn near(&self) -> Near {
        Near { triangles: self.triangles().collect(), last: 0 }
    }

    /// Whether a point lies strictly outside of any facet: exact.
    pub(super) fn is_outside(&self, p: DVec3) -> bool {
        // `robust` calls the side from which a triangle's corners run clockwise the positive one.
        self.triangles().any(|corners| {
            let [a, b, c] = corners.map(exact);
            orient3d(a, b, c, exact(p)) < 0.0
        })
    }

    /// The inner radius about the centre, made negative if the centre lies outside, so that it stays valid when the
    /// hull's radius is added.
    pub(super) fn inner_radius(&self, center: Vec3, radius: f32) -> f32 {
        if radius > 0.0 {
            return radius;
        }
        let distance = self.distance_outside(center.as_dvec3());
        0.0 - round_up(distance * (1.0 + 8.0 * f64::EPSILON))
    }
}

/// Triangles for distance queries of many points, each mostly near the last.
pub(super) struct Near {
    triangles: Vec<[DVec3; 3]>,
    /// The triangle nearest to the last point.
    last: usize,
}

impl Near {
    /// A point's distance to the nearest triangle, or to any that is no further than `enough`.
    pub(super) fn distance(&mut self, p: DVec3, enough: f64) -> f64 {
        let mut least = (f64::INFINITY, self.last);
        for index in (self.last..self.triangles.len()).chain(0..self.last) {
            let distance = to_triangle(p, self.triangles[index]);
            if distance < least.0 {
                least = (distance, index);
            }
            if distance <= enough {
                break;
            }
        }
        self.last = least.1;
        least.0
    }
}

fn exact(v: DVec3) -> Coord3D<f64> {
    Coord3D { x: v.x, y: v.y, z: v.z }
}

/// Orientation as seen along an axis: 0 in the (y, z) plane, 1 in (z, x), 2 in (x, y).
fn turn(axis: usize, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| Coord { x: v[(axis + 1) % 3], y: v[(axis + 2) % 3] });
    orient2d(a, b, c)
}

fn largest_axis(v: DVec3) -> usize {
    let size = v.abs();
    (0..3).fold(0, |best, axis| if size[axis] > size[best] { axis } else { best })
}

/// Distance from a point to a triangle. Never below the true one by more than the rounding of a length: it is always
/// measured to a point given by weights within the triangle, however badly conditioned these are. Two corners or all
/// may be equal.
pub(super) fn to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let (u, v, w) = (b - a, c - a, p - a);
    let normal = u.cross(v);
    let area = normal.length_squared();
    let weights = |w: DVec3| (w.cross(v).dot(normal) / area, u.cross(w).dot(normal) / area);
    let across = |(s, t): (f64, f64)| {
        let is_within = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
        is_within.then(|| (u * s + v * t - w).length())
    };
    let first = weights(w);
    if area > 1e-6 * u.length_squared() * v.length_squared() {
        return across(first).unwrap_or_else(|| to_edges(p, [a, b, c]));
    }
    // Badly conditioned: a second step on the small remainder has a small error, too. The distance to the edges is
    // another upper bound.
    let more = weights(w - u * first.0 - v * first.1);
    let second = (first.0 + more.0, first.1 + more.1);
    [first, second].into_iter().filter_map(across).fold(to_edges(p, [a, b, c]), f64::min)
}

fn to_edges(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let squared = |from: DVec3, to: DVec3| {
        let (along, arm) = (to - from, p - from);
        let length = along.length_squared();
        let t = if length > 0.0 { (arm.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        (along * t - arm).length_squared()
    };
    squared(a, b).min(squared(b, c)).min(squared(c, a)).sqrt()
}
