//! What a few corners prove of a convex part and a triangle, before anything dearer is asked.

use super::near::OnGround;
use crate::pair3::Part;
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::{DVec3, Vec3};

/// Cores of no more vertices are looked at by them, others by their bounding spheres: the triangle's normal parts what
/// lies beside a floor, and a floor is what most triangles near a body are.
const FEW: usize = 8;

/// A convex part in the ground's axes: everything within a radius of some points.
pub(crate) struct Corners {
    points: ArrayVec<DVec3, FEW>,
    radius: f64,
    /// The centre of its bounding sphere, which tells the side it is on.
    pub(crate) center: DVec3,
    /// All lengths that were summed for a place, and the radius.
    lengths: f64,
}

impl Corners {
    /// A part as it stands. A half-space has no points, and proves nothing.
    pub(crate) fn of(on: &OnGround, part: &Part) -> Self {
        let (axes, shift) = part.placed(&on.body_basis);
        let origin = on.basis.turn_back(on.to_body + shift);
        let center = on.basis.turn_back(on.to_body + part.center);
        let axes = [axes.x, axes.y, axes.z].map(|axis| on.basis.turn_back(axis));
        let core = part.shape.core();
        let (mut points, mut radius) = (ArrayVec::new(), f64::from(part.shape.radius()));
        if core.vertices().len() <= FEW {
            for vertex in core.vertices() {
                let [x, y, z] = vertex.as_dvec3().to_array();
                points.push(axes[0] * x + axes[1] * y + axes[2] * z + origin);
            }
        } else {
            points.push(center);
            radius = f64::from(part.shape.outer_radius());
        }
        let reach = if let Shape3::HalfSpace(_) = part.shape { 0.0 } else { part.shape.outer_radius() };
        let lengths = on.to_body.length() + shift.length() + f64::from(reach);
        let lengths = lengths + part.shape.center().as_dvec3().length() + radius;
        Self { points, radius, center, lengths }
    }

    /// A lower bound on the separation from a triangle, by the axis across it; zero or less where it shows none.
    pub(crate) fn gap(&self, corners: [Vec3; 3]) -> f64 {
        let [[from, to], _] = self.heights(corners, DVec3::ZERO);
        from.max(-to)
    }

    /// Whether it stays on one side of a triangle while it is moved.
    pub(crate) fn stays_beside(&self, corners: [Vec3; 3], way: DVec3) -> bool {
        let [[from, to], [low, high]] = self.heights(corners, way);
        from + low > 0.0 || to + high < 0.0
    }

    /// From where to where it reaches along a triangle's normal, seen from what the triangle itself takes up there,
    /// and beyond rounding: above zero it is clear of the triangle on the front, and below at the back. And how far
    /// down and up some way leads.
    fn heights(&self, corners: [Vec3; 3], way: DVec3) -> [[f64; 2]; 2] {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let (u, v) = (b - a, c - a);
        let none = [[f64::NEG_INFINITY, f64::INFINITY], [0.0; 2]];
        // Any axis proves what all corners show along it; so it need not be the normal to the last bit.
        let Some(normal) = u.cross(v).try_normalize() else { return none };
        if self.points.is_empty() {
            return none;
        }
        let [on_b, on_c] = [u, v].map(|edge| normal.dot(edge));
        let (low, high) = (on_b.min(on_c).min(0.0), on_b.max(on_c).max(0.0));
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for &point in &self.points {
            let height = normal.dot(point - a);
            from = if height < from { height } else { from };
            to = if height > to { height } else { to };
        }
        let lengths = self.lengths + a.abs().element_sum() + way.abs().element_sum();
        let doubt = self.radius + 128.0 * f64::EPSILON * lengths;
        let rise = normal.dot(way);
        [[from - high - doubt, to - low + doubt], [rise.min(0.0), rise.max(0.0)]]
    }
}
