//! What a corner of a patch is named after: of each face, the least feature that is near.
//!
//! ```text
//! the vertex of the face that the corner is; else one that is near: the nearest
//! else the edge that the corner lies on; else an edge of the face, if one is near: the nearest
//! else the face
//! corners of one patch that would be named alike keep the names of what they lie on
//! ```
//! Of crates that stand squarely on each other, corners are now a hair within each other's sides and now beside them; a corner
//! of their patch is now a vertex of one, now of the other, and now lies where edges cross. Names that changed with it would cost
//! a solver what it knew of the point: stacks of six cubes that were told so still trembled after 20 seconds.
//!
//! Cuboids have the same in closed form (`super::super::cuboids::patch`).

use asunder_geometry::glam::DVec2;

/// A face's vertices as seen along the normal, by the half-edges that start from them.
pub(super) struct Rim<'r> {
    pub(super) places: &'r [[f64; 2]],
    /// The first half-edge of the face.
    pub(super) first: u16,
}

impl Rim<'_> {
    /// The nearest vertex, by its half-edge, if it is within so many metres. Cost: linear in the vertices.
    pub(super) fn vertex_near(&self, at: [f64; 2], near: f64) -> Option<u16> {
        let at = DVec2::from_array(at);
        let mut best = (near * near, None);
        for (&place, half_edge) in self.places.iter().zip(self.first..) {
            let squared = (DVec2::from_array(place) - at).length_squared();
            if squared < best.0 {
                best = (squared, Some(half_edge));
            }
        }
        best.1
    }

    /// The nearest edge, by its half-edge, if the line that it is on is within so many metres. Cost: linear in the edges.
    pub(super) fn edge_near(&self, at: [f64; 2], near: f64) -> Option<u16> {
        let (at, count) = (DVec2::from_array(at), self.places.len());
        let mut best = (near, None);
        for (i, half_edge) in (0..count).zip(self.first..) {
            let from = DVec2::from_array(self.places[i]);
            let along = DVec2::from_array(self.places[if i + 1 == count { 0 } else { i + 1 }]) - from;
            let off = along.perp_dot(at - from).abs() / along.length();
            if off < best.0 {
                best = (off, Some(half_edge));
            }
        }
        best.1
    }
}
