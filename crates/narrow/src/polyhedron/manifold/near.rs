//! Names for the corners of a patch: of each face, the lowest-dimensional feature that is near the corner.
//!
//! ```text
//! it is a vertex of the face:  that vertex
//! on an edge of the face:      the nearer end of the edge, if near; else the edge
//! else:                        the nearest vertex of the face, if near; else the nearest edge, if near; else the face
//! corners of one patch that would get the same name keep the names of the features that they lie on
//! ```
//! Where crates stand squarely on each other, their corners lie a hair within each other's sides in one frame and a
//! hair beside them in the next. So a corner of their patch is a vertex of one, then of the other, then a crossing of
//! edges. If names changed with it, a solver would lose what it knew of the point: stacks of six cubes named so still
//! trembled after 20 seconds.
//!
//! Cuboids, whose patches are made by another kernel (`super::super::cuboids::patch`), call this where any corner is
//! near; mostly none is.

use asunder_geometry::glam::DVec2;

/// The vertices around a face as projected along the normal, by the half-edges that start from them.
pub(in crate::polyhedron) struct Rim<P> {
    /// Where the vertex is, by how many half-edges after the first it comes.
    pub(in crate::polyhedron) place: P,
    pub(in crate::polyhedron) count: usize,
    /// The first half-edge of the face.
    pub(in crate::polyhedron) first: u16,
}

/// A feature of a face: the vertex that a half-edge starts from, its edge, or the face itself.
#[derive(Clone, Copy, PartialEq)]
pub(in crate::polyhedron) enum LiesOn {
    Vertex(u16),
    Edge(u16),
    Face,
}

impl<P: Fn(usize) -> [f64; 2]> Rim<P> {
    /// Both ends of an edge.
    #[inline]
    fn ends(&self, edge: usize) -> [DVec2; 2] {
        let next = if edge + 1 == self.count { 0 } else { edge + 1 };
        [DVec2::from_array((self.place)(edge)), DVec2::from_array((self.place)(next))]
    }

    /// The name, among features within `near` metres, for a point that lies on a given feature of the face. Cost:
    /// linear in the edges where it lies in the face's interior.
    #[inline]
    pub(in crate::polyhedron) fn near(&self, at: [f64; 2], lies_on: LiesOn, near: f64) -> LiesOn {
        let at = DVec2::from_array(at);
        match lies_on {
            LiesOn::Vertex(_) => lies_on,
            LiesOn::Edge(half_edge) => self.on_edge(at, half_edge, near),
            LiesOn::Face => self.in_face(at, near),
        }
    }

    /// The nearer end of an edge, if it is near, or the edge.
    fn on_edge(&self, at: DVec2, half_edge: u16, near: f64) -> LiesOn {
        let edge = usize::from(half_edge - self.first);
        let away = self.ends(edge).map(|end| (end - at).length_squared());
        if away[0].min(away[1]) >= near * near {
            return LiesOn::Edge(half_edge);
        }
        let is_last = edge + 1 == self.count;
        match away[1] < away[0] {
            false => LiesOn::Vertex(half_edge),
            true => LiesOn::Vertex(if is_last { self.first } else { half_edge + 1 }),
        }
    }

    fn in_face(&self, at: DVec2, near: f64) -> LiesOn {
        // A vertex is on the lines of two edges, so this covers vertices too: mostly no line is near.
        let is_beside = |edge: usize| {
            let [from, to] = self.ends(edge);
            let across = (to - from).perp_dot(at - from);
            across * across < near * near * (to - from).length_squared()
        };
        if (0..self.count).any(is_beside) { self.nearest(at, near) } else { LiesOn::Face }
    }

    #[cold]
    fn nearest(&self, at: DVec2, near: f64) -> LiesOn {
        let (mut vertex, mut edge) = ((near * near, None), (near, LiesOn::Face));
        for (i, half_edge) in (0..self.count).zip(self.first..) {
            let [from, to] = self.ends(i);
            let squared = (from - at).length_squared();
            if squared < vertex.0 {
                vertex = (squared, Some(LiesOn::Vertex(half_edge)));
            }
            let off = (to - from).perp_dot(at - from).abs() / (to - from).length();
            if off < edge.0 {
                edge = (off, LiesOn::Edge(half_edge));
            }
        }
        vertex.1.unwrap_or(edge.1)
    }
}
