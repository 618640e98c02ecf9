//! Moments of shapes in space: the core and the prisms on its faces.

use super::facets::each_facet;
use super::properties::MassProperties3;
use super::rounded::add_rounding;
use super::second::{Second, cross};
use crate::cores::Core3;
use crate::cuboid::Cuboid;
use crate::shape::Shape3;
use core::f64::consts::PI;
use glam::{DMat3, DVec3};

/// Integrals over a body, about some origin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Moments {
    volume: f64,
    /// Of x.
    first: DVec3,
    /// Of x x^T.
    second: Second,
}

impl Moments {
    pub(super) fn add(&mut self, volume: f64, first: DVec3, second: Second) {
        self.volume += volume;
        self.first += first;
        self.second += second;
    }
}

/// Any convex shape with a core; a half-space or a compound, which have none, get no mass here.
pub(super) fn of_convex(shape: &Shape3, density: f64) -> MassProperties3 {
    if let Shape3::Cuboid(cuboid) = shape {
        return of_cuboid(cuboid, density);
    }
    let (core, center, radius) = (shape.core(), shape.center().as_dvec3(), f64::from(shape.radius()));
    let vertices: Vec<DVec3> = core.vertices().iter().map(|vertex| vertex.as_dvec3() - center).collect();
    let mut moments = Moments::default();
    let is_solid = matches!(shape, Shape3::Hull(hull) if hull.dimension() == 3);
    if is_solid {
        each_facet(&core, |facet| add_tetrahedron(&mut moments, facet.map(|i| vertices[i])));
    }
    if radius > 0.0 {
        each_triangle(&core, &vertices, |face, triangle| {
            add_prism(&mut moments, triangle, core.normals()[face] * radius);
        });
        add_rounding(&mut moments, &core, &vertices, radius);
    }
    if moments.volume <= 0.0 {
        return without_volume(center + centroid(&core, &vertices));
    }
    // The volume of a sliver may be mere rounding, and the quotient anywhere.
    let (low, high) = box_around(&vertices);
    let offset = (moments.first / moments.volume).clamp(low - radius, high + radius);
    let mut second = moments.second + Second::of(offset) * -moments.volume;
    // Negative only by the rounding of this difference.
    second.squares = second.squares.max(DVec3::ZERO);
    let (mass, inertia) = (density * moments.volume, (second * density).inertia());
    MassProperties3 { mass, center: center + offset, inertia }
}

/// A cuboid, in a form that keeps its symmetry in every bit: the centre is its origin and no axes are mixed.
fn of_cuboid(cuboid: &Cuboid, density: f64) -> MassProperties3 {
    let (h, r) = (cuboid.half_extents().as_dvec3(), f64::from(cuboid.radius()));
    let (r2, r3) = (r * r, r * r * r);
    // Second moment along one axis. In order: the pieces with the core's extent there (core, four slabs, four edges),
    // the two slabs at its ends, the eight edges across it (as two whole cylinders), the corners (as one ball).
    let along = |a: f64, b: f64, c: f64| {
        let a2 = a * a;
        a2 / 3.0 * (8.0 * a * (b * c + r * (b + c)) + 2.0 * PI * r2 * a)
            + 8.0 * b * c * r * (a2 + r * a + r2 / 3.0)
            + 2.0 * (b + c) * r2 * (PI * a2 + 8.0 / 3.0 * a * r + PI / 4.0 * r2)
            + PI * r3 * (4.0 / 3.0 * a2 + a * r + 4.0 / 15.0 * r2)
    };
    let volume = 8.0 * (h.x * h.y * h.z + r * (h.x * h.y + h.y * h.z + h.z * h.x))
        + 2.0 * PI * r2 * (h.x + h.y + h.z)
        + 4.0 / 3.0 * PI * r3;
    let squares = DVec3::new(along(h.x, h.y, h.z), along(h.y, h.z, h.x), along(h.z, h.x, h.y));
    let inertia = (Second { squares, products: DVec3::ZERO } * density).inertia();
    MassProperties3 { mass: density * volume, center: DVec3::ZERO, inertia }
}

fn without_volume(center: DVec3) -> MassProperties3 {
    MassProperties3 { mass: 0.0, center, inertia: DMat3::ZERO }
}

fn box_around(vertices: &[DVec3]) -> (DVec3, DVec3) {
    let around = |(low, high): (DVec3, DVec3), &vertex: &DVec3| (low.min(vertex), high.max(vertex));
    vertices.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), around)
}

/// All faces as fans of triangles, counter-clockwise seen from outside.
fn each_triangle(core: &Core3<'_>, vertices: &[DVec3], mut visit: impl FnMut(usize, [DVec3; 3])) {
    for face in 0..core.normals().len() {
        let mut around = core.topology().face_vertices(face).map(|i| vertices[i]);
        let Some(apex) = around.next() else { continue };
        for (b, c) in around.clone().zip(around.skip(1)) {
            visit(face, [apex, b, c]);
        }
    }
}

/// A triangle's area vector, sum of corners, and twelve times its second moment for unit area.
fn measures([a, b, c]: [DVec3; 3]) -> (DVec3, DVec3, Second) {
    let sum = a + b + c;
    (cross(b - a, c - a) * 0.5, sum, Second::of(a) + Second::of(b) + Second::of(c) + Second::of(sum))
}

/// Adds the tetrahedron from the origin, which lies inside or near the core, to a triangle of its surface.
fn add_tetrahedron(moments: &mut Moments, triangle: [DVec3; 3]) {
    let (area, sum, square) = measures(triangle);
    let volume = area.dot(triangle[0]) / 3.0;
    moments.add(volume, sum * (volume / 4.0), square * (volume / 20.0));
}

/// Adds the prism that a triangle sweeps along `way`.
fn add_prism(moments: &mut Moments, triangle: [DVec3; 3], way: DVec3) {
    let (area, sum, square) = measures(triangle);
    let volume = area.dot(way);
    let middle = sum / 3.0;
    let second = square * (1.0 / 12.0) + Second::pair(middle, way) * 0.5 + Second::of(way) * (1.0 / 3.0);
    moments.add(volume, (middle + way * 0.5) * volume, second * volume);
}

/// The centroid of a core without volume, weighted by area, length, or number.
fn centroid(core: &Core3<'_>, vertices: &[DVec3]) -> DVec3 {
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    if core.normals().len() == 2 {
        each_triangle(core, vertices, |face, triangle| {
            let (across, sum, _) = measures(triangle);
            let share = across.dot(core.normals()[face]);
            area += share;
            moment += sum * (share / 3.0);
        });
    }
    if area > 0.0 {
        return moment / area;
    }
    vertices.iter().fold(DVec3::ZERO, |sum, &v| sum + v) / vertices.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use crate::hull::Hull;
    use crate::shape::Shape3;
    use glam::Vec3;

    #[test]
    fn a_sliver_has_its_centre_of_mass_within() {
        let corners = [
            (0.008_330_43, -19.903_73, 0.0),
            (0.0, 0.0, -0.141_098_11),
            (0.0, 0.0, 1_020.159_5),
            (0.0, 1.175_494_4e-38, 999_999.94),
        ];
        for radius in [0.0, 1e-45, 1e-3] {
            let hull = Hull::of_any_dimension(&corners.map(Vec3::from)).unwrap().rounded(radius).unwrap();
            let center = Shape3::from(hull).mass_properties(1.0).unwrap().center;
            assert!(center.cmpge(Vec3::new(-0.001, -19.91, -0.15).as_dvec3()).all(), "{center}");
            assert!(center.cmple(Vec3::new(0.01, 0.001, 1e6).as_dvec3()).all(), "{center}");
        }
    }
}
