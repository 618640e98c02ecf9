//! The sides of a triangle: which points lie over the triangle, and how far inside.

use super::facet::Facet;
use asunder_geometry::glam::DVec3;

/// A side of a triangle, prepared for tests of which points lie over the triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    from: DVec3,
    /// As long as the side.
    inwards: DVec3,
    /// No less than the side's length.
    length: f64,
    /// How far inside a point must be, times `length`.
    least: f64,
}

impl Rim {
    /// Whether a point is on the triangle's side of it.
    #[inline]
    pub(super) fn holds(&self, point: DVec3) -> bool {
        self.inwards.dot(point - self.from) >= self.least
    }

    /// The same for a point that may be further outside, by `more` metres.
    #[inline]
    pub(super) fn holds_by(&self, point: DVec3, more: f64) -> bool {
        self.inwards.dot(point - self.from) >= self.least - more * self.length
    }

    /// Whether a point is on the other side, by however little.
    #[inline]
    pub(super) fn is_beyond(&self, point: DVec3) -> bool {
        self.inwards.dot(point - self.from) < 0.0
    }
}

impl Facet {
    /// The least distance of a point's foot from the sides that count, by their half-edges, positive inside, in metres.
    /// Infinite where none counts.
    #[inline]
    pub(super) fn inside(&self, point: DVec3, counts: impl Fn(usize) -> bool) -> f64 {
        let mut least = f64::INFINITY;
        for edge in 0..3 {
            if counts(edge) {
                let (from, along) = self.edge(edge);
                let distance = self.inwards(along).dot(point - from) / along.length();
                least = if distance < least { distance } else { least };
            }
        }
        least
    }

    /// Whether a point's foot is in the triangle, or outside by no more than `slack` metres.
    #[inline]
    pub(super) fn is_over(&self, point: DVec3, slack: f64) -> bool {
        (0..3).all(|edge| self.rim(edge, slack).holds(point))
    }

    /// One of its sides, for points that may be outside by no more than `slack` metres.
    #[inline]
    pub(super) fn rim(&self, edge: usize, slack: f64) -> Rim {
        let (from, along) = self.edge(edge);
        // The sum of absolute values bounds the length, and needs no root.
        let length = along.abs().element_sum();
        Rim { from, inwards: self.inwards(along), length, least: -slack * length }
    }
}
