//! Moments of shapes in the plane.

use super::properties::MassProperties2;
use crate::product::product_difference;
use crate::rect::Rect;
use crate::shape::Shape2;
use core::f64::consts::{PI, TAU};
use glam::DVec2;

/// Integrals over a figure in the plane, about some origin.
#[derive(Clone, Copy, Debug, Default)]
struct Moments {
    area: f64,
    /// Of x.
    first: DVec2,
    /// Of |x|^2.
    polar: f64,
}

impl Moments {
    fn add(&mut self, area: f64, first: DVec2, polar: f64) {
        self.area += area;
        self.first += first;
        self.polar += polar;
    }
}

/// A rectangle, in a form that keeps its symmetry in every bit: the centre is its origin.
pub(super) fn of_rect(rect: &Rect, density: f64) -> MassProperties2 {
    let (h, r) = (rect.half_extents().as_dvec2(), f64::from(rect.radius()));
    // Second moment along one axis: the core and the strips beside it, the strips at its ends, and four quarters of a
    // circle.
    let along = |a: f64, b: f64| {
        let (a2, r2) = (a * a, r * r);
        4.0 * a * (b + r) * a2 / 3.0
            + 4.0 * b * r * (a2 + r * a + r2 / 3.0)
            + r2 * (PI * a2 + 8.0 / 3.0 * a * r + PI / 4.0 * r2)
    };
    let area = 4.0 * (h.x * h.y + r * (h.x + h.y)) + PI * r * r;
    let inertia = density * (along(h.x, h.y) + along(h.y, h.x));
    MassProperties2 { mass: density * area, center: DVec2::ZERO, inertia }
}

/// Any convex shape with a core; a half-plane or a compound, which have none, get no mass here.
pub(super) fn of_convex(shape: &Shape2, density: f64) -> MassProperties2 {
    if let Shape2::Rect(rect) = shape {
        return of_rect(rect, density);
    }
    let (core, center, radius) = (shape.core(), shape.center().as_dvec2(), f64::from(shape.radius()));
    let vertices: Vec<DVec2> = core.vertices().iter().map(|vertex| vertex.as_dvec2() - center).collect();
    let mut moments = Moments::default();
    match vertices.as_slice() {
        [] => {}
        [point] => add_sector(&mut moments, *point, Turn::FULL, radius),
        corners => {
            if corners.len() > 2 {
                add_core(&mut moments, corners);
            }
            add_rounding(&mut moments, corners, core.normals(), radius);
        }
    }
    if moments.area <= 0.0 {
        // Without area: a segment, or a sliver that f64 cannot tell from one.
        let middle = vertices.iter().fold(DVec2::ZERO, |sum, &v| sum + v) / vertices.len().max(1) as f64;
        return MassProperties2 { mass: 0.0, center: center + middle, inertia: 0.0 };
    }
    // The area of a sliver may be mere rounding, and the quotient anywhere.
    let (low, high) = box_around(&vertices);
    let offset = (moments.first / moments.area).clamp(low - radius, high + radius);
    // Negative only by the rounding of this difference.
    let polar = (moments.polar - moments.area * offset.length_squared()).max(0.0);
    MassProperties2 { mass: density * moments.area, center: center + offset, inertia: density * polar }
}

fn box_around(vertices: &[DVec2]) -> (DVec2, DVec2) {
    let around = |(low, high): (DVec2, DVec2), &vertex: &DVec2| (low.min(vertex), high.max(vertex));
    vertices.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), around)
}

/// Adds a polygon, as triangles from the origin, which lies inside or near it.
fn add_core(moments: &mut Moments, vertices: &[DVec2]) {
    for (i, &a) in vertices.iter().enumerate() {
        let b = vertices[(i + 1) % vertices.len()];
        let doubled = product_difference(a.x, b.y, a.y, b.x);
        let polar = a.length_squared() + b.length_squared() + a.dot(b);
        moments.add(doubled / 2.0, (a + b) * (doubled / 6.0), doubled / 12.0 * polar);
    }
}

/// Adds a rectangle on each edge and a sector of a circle at each vertex.
fn add_rounding(moments: &mut Moments, vertices: &[DVec2], normals: &[DVec2], r: f64) {
    if r == 0.0 {
        return;
    }
    let count = vertices.len();
    for (i, (&p, &normal)) in vertices.iter().zip(normals).enumerate() {
        let q = vertices[(i + 1) % count];
        let (area, middle) = ((q - p).length() * r, (p + q) * 0.5);
        let flat = (p.length_squared() + q.length_squared() + p.dot(q)) / 3.0;
        let polar = area * (flat + r * middle.dot(normal) + r * r / 3.0);
        moments.add(area, (middle + normal * (r / 2.0)) * area, polar);
        let before = normals[(i + count - 1) % count];
        add_sector(moments, p, Turn::between(before, normal), r);
    }
}

/// The directions of a circular sector.
struct Turn {
    angle: f64,
    /// Integral of the unit vectors in it.
    pull: DVec2,
}

impl Turn {
    const FULL: Self = Self { angle: TAU, pull: DVec2::ZERO };

    /// From one outward normal to the next, counter-clockwise.
    fn between(from: DVec2, to: DVec2) -> Self {
        let (cos, mut sin) = (from.dot(to), from.perp_dot(to));
        if cos < 0.0 {
            // At the end of a segment, rounding must not turn half a turn into minus half a turn.
            sin = sin.abs();
        }
        Self { angle: libm::atan2(sin, cos), pull: from * sin + from.perp() * (1.0 - cos) }
    }
}

fn add_sector(moments: &mut Moments, vertex: DVec2, turn: Turn, r: f64) {
    let (area, pull) = (turn.angle * r * r / 2.0, turn.pull * (r * r * r / 3.0));
    let polar = area * (vertex.length_squared() + r * r / 2.0) + 2.0 * vertex.dot(pull);
    moments.add(area, vertex * area + pull, polar);
}

#[cfg(test)]
mod tests {
    use crate::polygon::Polygon;
    use crate::shape::Shape2;
    use glam::Vec2;

    #[test]
    fn a_sliver_has_its_centre_of_mass_within() {
        // The rounding of positions about its middle is more than its area.
        let corners = [(0.0, 0.0), (128_701.21, 480_313.9), (4.964_317e-11, 1.852_687e-10)].map(Vec2::from);
        for radius in [0.0, 1e-45, 1e-12, 1e-3] {
            let sliver = Polygon::hull_of(&corners).unwrap().rounded(radius).unwrap();
            let center = Shape2::from(sliver).mass_properties(1.0).unwrap().center;
            assert!(center.cmpge(Vec2::splat(-0.002).as_dvec2()).all(), "{radius}: {center}");
            assert!(center.cmple(Vec2::new(128_701.22, 480_313.93).as_dvec2()).all(), "{radius}: {center}");
        }
    }
}
