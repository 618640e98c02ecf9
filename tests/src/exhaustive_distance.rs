//! The Euclidean distance over every pair of features, in f64.
//!
//! Two disjoint convex polyhedra are closest at a vertex and a facet or at two edges (or at a part of these). Every
//! candidate is a pair of points of the two shapes, so that none can be too short; and the gap along the line between
//! the closest ones proves that nothing is closer (`tests/suite/oracles.rs` compares the two). Overlapping shapes have
//! no distance: use [`exhaustive_sat`](crate::exhaustive_sat) first.

use crate::placed::{Placed2, Placed3};
use glam::{DVec2, DVec3};

/// Two closest points.
#[derive(Clone, Copy, Debug)]
pub struct Nearest<V> {
    /// Their distance, in metres.
    pub distance: f64,
    /// The point of A.
    pub on_a: V,
    /// The point of B.
    pub on_b: V,
}

/// The distance between two disjoint solids.
pub fn exhaustive_distance3(a: &Placed3, b: &Placed3) -> Nearest<DVec3> {
    let mut nearest = Nearest { distance: f64::INFINITY, on_a: DVec3::ZERO, on_b: DVec3::ZERO };
    let mut consider = |on_a: DVec3, on_b: DVec3| {
        let distance = (on_b - on_a).length();
        if distance < nearest.distance {
            nearest = Nearest { distance, on_a, on_b };
        }
    };
    for face in 0..a.facets.len() {
        for &vertex in &b.vertices {
            if let Some(foot) = foot_in_facet(a, face, vertex) {
                consider(foot, vertex);
            }
        }
    }
    for face in 0..b.facets.len() {
        for &vertex in &a.vertices {
            if let Some(foot) = foot_in_facet(b, face, vertex) {
                consider(vertex, foot);
            }
        }
    }
    for edge_a in &a.edges {
        let of_a = edge_a.map(|i| a.vertices[i]);
        for edge_b in &b.edges {
            segment_candidates(of_a, edge_b.map(|i| b.vertices[i]), &mut consider);
        }
    }
    nearest
}

/// The distance between two disjoint polygons: a vertex of one and an edge of the other.
pub fn exhaustive_distance2(a: &Placed2, b: &Placed2) -> Nearest<DVec2> {
    let mut nearest = Nearest { distance: f64::INFINITY, on_a: DVec2::ZERO, on_b: DVec2::ZERO };
    let mut consider = |on_a: DVec2, on_b: DVec2| {
        let distance = (on_b - on_a).length();
        if distance < nearest.distance {
            nearest = Nearest { distance, on_a, on_b };
        }
    };
    for edge in a.edges() {
        b.vertices.iter().for_each(|&vertex| consider(foot_on_segment2(edge, vertex), vertex));
    }
    for edge in b.edges() {
        a.vertices.iter().for_each(|&vertex| consider(vertex, foot_on_segment2(edge, vertex)));
    }
    nearest
}

/// The foot of the perpendicular from a point to a facet, if it is inside the facet. If not, an edge is nearer.
fn foot_in_facet(solid: &Placed3, face: usize, point: DVec3) -> Option<DVec3> {
    let (normal, corners) = (solid.normals[face], &solid.facets[face]);
    let height = normal.dot(point - solid.vertices[corners[0]]);
    if height < 0.0 {
        return None;
    }
    let foot = point - normal * height;
    let middle = corners.iter().map(|&i| solid.vertices[i]).sum::<DVec3>() / corners.len() as f64;
    let border = solid.edges.iter().filter(|edge| edge.iter().all(|end| corners.contains(end)));
    let side = |edge: &[usize; 2], p: DVec3| {
        let [from, to] = edge.map(|i| solid.vertices[i]);
        (to - from).cross(p - from).dot(normal)
    };
    border.clone().all(|edge| side(edge, foot) * side(edge, middle) >= 0.0).then_some(foot)
}

fn foot_on_segment3([from, to]: [DVec3; 2], point: DVec3) -> DVec3 {
    let along = to - from;
    from + along * ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
}

fn foot_on_segment2([from, to]: [DVec2; 2], point: DVec2) -> DVec2 {
    let along = to - from;
    from + along * ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
}

/// The four ends against the other segment, and the common perpendicular if it meets both.
fn segment_candidates(a: [DVec3; 2], b: [DVec3; 2], consider: &mut impl FnMut(DVec3, DVec3)) {
    b.iter().for_each(|&end| consider(foot_on_segment3(a, end), end));
    a.iter().for_each(|&end| consider(end, foot_on_segment3(b, end)));
    let (along_a, along_b, between) = (a[1] - a[0], b[1] - b[0], b[0] - a[0]);
    let across = along_a.cross(along_b);
    let s = between.cross(along_b).dot(across) / across.length_squared();
    let t = between.cross(along_a).dot(across) / across.length_squared();
    // Parallel lines give NaN here; their closest points include an end.
    if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
        consider(a[0] + along_a * s, b[0] + along_b * t);
    }
}
