//! The distance from a point to a shape's surface, by the plain definition: independent of the engine's kernels.

use asunder::glam::{DVec2, DVec3};
use asunder::{Shape2, Shape3};

/// Metres from a local point to the surface of a shape, or of the given part of a compound.
pub(crate) fn from_surface3(shape: &Shape3, part: u32, point: DVec3) -> f64 {
    match shape {
        Shape3::HalfSpace(half_space) => half_space.unit_normal().dot(point).abs(),
        Shape3::Compound(compound) => compound
            .parts()
            .get(part as usize)
            .map_or(f64::INFINITY, |part| from_surface3(part.shape(), 0, part.pose().transform_back(point))),
        _ => (above_core3(shape, point) - f64::from(shape.radius())).abs(),
    }
}

/// The same in the plane.
pub(crate) fn from_surface2(shape: &Shape2, part: u32, point: DVec2) -> f64 {
    match shape {
        Shape2::HalfPlane(half_plane) => half_plane.unit_normal().dot(point).abs(),
        Shape2::Compound(compound) => compound
            .parts()
            .get(part as usize)
            .map_or(f64::INFINITY, |part| from_surface2(part.shape(), 0, part.pose().transform_back(point))),
        // No pair has ground in it: ground is drawn alone.
        Shape2::Chain(_) => f64::INFINITY,
        _ => (above_core2(shape, point) - f64::from(shape.radius())).abs(),
    }
}

/// The signed distance from a core, negative inside.
fn above_core3(shape: &Shape3, point: DVec3) -> f64 {
    let core = shape.core();
    let (vertices, topology) = (core.vertices(), core.topology());
    let vertex = |i: usize| vertices[i].as_dvec3();
    let faces = core.normals().iter().enumerate();
    let heights = faces.filter_map(|(face, normal)| {
        let first = topology.face_vertices(face).next()?;
        Some(normal.dot(point - vertex(first)))
    });
    let highest = heights.fold(f64::NEG_INFINITY, f64::max);
    if highest < 0.0 && highest.is_finite() {
        return highest;
    }
    let edges = topology.edges().iter().map(|&edge| {
        let (from, to) = topology.ends(usize::from(edge));
        from_segment(point, vertex(from), vertex(to))
    });
    // Above the interior of a face the nearest point is on its plane; elsewhere it is on an edge or vertex.
    let faces = core.normals().iter().enumerate().filter_map(|(face, normal)| {
        let is_inside = topology.face_half_edges(face).all(|half_edge| {
            let (from, to) = topology.ends(half_edge);
            normal.cross(vertex(to) - vertex(from)).dot(point - vertex(from)) >= 0.0
        });
        let first = topology.face_vertices(face).next()?;
        is_inside.then(|| normal.dot(point - vertex(first)).abs())
    });
    let corners = vertices.iter().map(|corner| (point - corner.as_dvec3()).length());
    edges.chain(faces).chain(corners).fold(f64::INFINITY, f64::min)
}

/// The signed distance from a core, negative inside.
fn above_core2(shape: &Shape2, point: DVec2) -> f64 {
    let core = shape.core();
    let (vertices, count) = (core.vertices(), core.vertices().len());
    let vertex = |i: usize| vertices[i % count].as_dvec2();
    let heights = core.normals().iter().enumerate().map(|(edge, normal)| normal.dot(point - vertex(edge)));
    let highest = heights.fold(f64::NEG_INFINITY, f64::max);
    if highest < 0.0 && highest.is_finite() {
        return highest;
    }
    let edges = (0..core.normals().len())
        .map(|edge| from_segment(point.extend(0.0), vertex(edge).extend(0.0), vertex(edge + 1).extend(0.0)));
    let corners = vertices.iter().map(|corner| (point - corner.as_dvec2()).length());
    edges.chain(corners).fold(f64::INFINITY, f64::min)
}

fn from_segment(point: DVec3, from: DVec3, to: DVec3) -> f64 {
    let along = to - from;
    let share = ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (point - from - along * share).length()
}
