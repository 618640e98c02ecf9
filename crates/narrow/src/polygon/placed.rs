//! What contact points are built from: a core whose vertices and edges are placed in the frame of the pair.

use super::outline::Outline;
use asunder_geometry::glam::DVec2;

/// A core in the frame of a pair.
pub(crate) trait Placed {
    /// How far the shape reaches beyond this core.
    fn radius(&self) -> f64;

    /// Whether it has no interior: a point or a segment.
    fn is_flat(&self) -> bool;

    /// Number of edges: none of a point, two of a segment.
    fn edge_count(&self) -> usize;

    /// The vertex after this one, counter-clockwise.
    fn after(&self, vertex: usize) -> usize;

    /// The vertex before this one.
    fn before(&self, vertex: usize) -> usize;

    /// A vertex.
    fn point(&self, vertex: usize) -> DVec2;

    /// Outward normal of an edge, of unit length up to some roundings.
    fn outward(&self, edge: usize) -> DVec2;

    /// The vertex furthest along a direction.
    fn furthest(&self, direction: DVec2) -> usize;

    /// Of the two edges at the deepest vertex, the one that faces a normal most; in a tie, the one before.
    #[inline]
    fn facing(&self, deepest: usize, normal: DVec2) -> usize {
        let previous = self.before(deepest);
        let facing = |edge: usize| self.outward(edge).dot(normal);
        if facing(deepest) < facing(previous) { deepest } else { previous }
    }

    /// The same for the vertex that is furthest against the normal.
    #[inline]
    fn facing_edge(&self, normal: DVec2) -> usize {
        self.facing(self.furthest(-normal), normal)
    }
}

impl Placed for Outline<'_> {
    #[inline]
    fn radius(&self) -> f64 {
        self.radius
    }

    #[inline]
    fn is_flat(&self) -> bool {
        self.vertices.len() <= 2
    }

    #[inline]
    fn edge_count(&self) -> usize {
        Outline::edge_count(self)
    }

    #[inline]
    fn after(&self, vertex: usize) -> usize {
        Outline::after(self, vertex)
    }

    #[inline]
    fn before(&self, vertex: usize) -> usize {
        Outline::before(self, vertex)
    }

    #[inline]
    fn point(&self, vertex: usize) -> DVec2 {
        Outline::point(self, vertex)
    }

    #[inline]
    fn outward(&self, edge: usize) -> DVec2 {
        Outline::outward(self, edge)
    }

    #[inline]
    fn furthest(&self, direction: DVec2) -> usize {
        self.support(direction).vertex
    }
}
