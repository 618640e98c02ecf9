//! What a corner of a patch is named after: of each face, the least feature that is near.
//!
//! ```text
//! the vertex of the face that the corner is
//! on an edge of the face: the nearer of its ends, if it is near; else the edge
//! else the nearest vertex of the face, if one is near; else the nearest edge, if one is; else the face
//! corners of one patch that would be named alike keep the names of what they lie on
//! ```
//! Of crates that stand squarely on each other, corners are now a hair within each other's sides and now beside them; a corner
//! of their patch is now a vertex of one, now of the other, and now lies where edges cross. Names that changed with it would cost
//! a solver what it knew of the point: stacks of six cubes that were told so still trembled after 20 seconds.
//!
//! Cuboids have the same in closed form (`super::super::cuboids::patch`).

use asunder_geometry::glam::DVec2;

/// A face's vertices as seen along the normal, by the half-edges that start from them.
pub(super) struct Rim<P> {
    /// Where the vertex is seen that is so many half-edges after the first.
    pub(super) place: P,
    pub(super) count: usize,
    /// The first half-edge of the face.
    pub(super) first: u16,
}

/// A feature of a face by a half-edge: the vertex that it starts from, or its edge.
#[derive(Clone, Copy)]
pub(super) enum Near {
    Vertex(u16),
    Edge(u16),
}

impl<P: Fn(usize) -> [f64; 2]> Rim<P> {
    /// Both ends of an edge.
    #[inline]
    fn ends(&self, edge: usize) -> [DVec2; 2] {
        let next = if edge + 1 == self.count { 0 } else { edge + 1 };
        [DVec2::from_array((self.place)(edge)), DVec2::from_array((self.place)(next))]
    }

    /// Of a place on an edge, given by its half-edge: an end of it within so many metres, or the edge.
    #[inline]
    pub(super) fn on_edge(&self, at: [f64; 2], half_edge: u16, near: f64) -> Near {
        let edge = usize::from(half_edge - self.first);
        let away = self.ends(edge).map(|end| (end - DVec2::from_array(at)).length_squared());
        let next = if edge + 1 == self.count { self.first } else { half_edge + 1 };
        match away[1] < away[0] {
            _ if away[0].min(away[1]) >= near * near => Near::Edge(half_edge),
            false => Near::Vertex(half_edge),
            true => Near::Vertex(next),
        }
    }

    /// Of a place in the face: what of it is within so many metres. Cost: linear in the edges.
    pub(super) fn in_face(&self, at: [f64; 2], near: f64) -> Option<Near> {
        let at = DVec2::from_array(at);
        // A vertex is on the lines of two edges: most often no line is near.
        let is_beside = |edge: usize| {
            let [from, to] = self.ends(edge);
            let across = (to - from).perp_dot(at - from);
            across * across < near * near * (to - from).length_squared()
        };
        (0..self.count).any(is_beside).then(|| self.nearest(at, near)).flatten()
    }

    #[cold]
    fn nearest(&self, at: DVec2, near: f64) -> Option<Near> {
        let (mut vertex, mut edge) = ((near * near, None), (near, None));
        for (i, half_edge) in (0..self.count).zip(self.first..) {
            let [from, to] = self.ends(i);
            let squared = (from - at).length_squared();
            if squared < vertex.0 {
                vertex = (squared, Some(Near::Vertex(half_edge)));
            }
            let off = (to - from).perp_dot(at - from).abs() / (to - from).length();
            if off < edge.0 {
                edge = (off, Some(Near::Edge(half_edge)));
            }
        }
        vertex.1.or(edge.1)
    }
}
