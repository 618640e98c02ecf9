//! Two edges and the axis across them.

use super::super::solid::Solid;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::PARALLEL_EDGES;

/// An edge in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeAt {
    pub(super) half_edge: usize,
    /// Its direction, not normalised.
    pub(super) along: DVec3,
    /// Where it starts.
    pub(super) from: DVec3,
}

impl EdgeAt {
    pub(super) const NONE: Self = Self { half_edge: usize::MAX, along: DVec3::ZERO, from: DVec3::ZERO };

    #[inline]
    pub(super) fn new(solid: &Solid, half_edge: usize) -> Self {
        let (from, _) = solid.edge(half_edge);
        Self { half_edge, along: solid.edge_direction(half_edge), from }
    }
}

/// The cross product of two edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cross {
    pub(super) axis: DVec3,
    /// Of the sine between the edges.
    pub(super) squared_sine: f64,
    /// No less than the product of the edges' lengths.
    pub(super) lengths: f64,
}

impl Cross {
    pub(super) fn new(along_a: DVec3, along_b: DVec3) -> Self {
        let axis = along_a.cross(along_b);
        let (square_a, square_b) = (along_a.length_squared(), along_b.length_squared());
        let squared_sine = axis.length_squared() / (square_a * square_b);
        Self { axis, squared_sine, lengths: 0.5 * (square_a + square_b) }
    }

    /// Turned from A to B; of A's edge, its direction and one that lies between the normals beside it.
    #[inline]
    pub(super) fn outwards(
        (along_a, out_of_a): (DVec3, DVec3),
        along_b: DVec3,
        out_of_b: impl FnOnce() -> DVec3,
    ) -> Self {
        let cross = Self::new(along_a, along_b);
        // Outwards as seen from A's edge: between the normals of its two faces. A segment looks everywhere; then B's
        // edge tells.
        let outwards = if out_of_a == DVec3::ZERO { -out_of_b() } else { out_of_a };
        if cross.axis.dot(outwards) < 0.0 { Self { axis: -cross.axis, ..cross } } else { cross }
    }

    /// Whether the edges are so nearly parallel that the axis would be rounding. Edges of no length are.
    pub(super) fn is_noise(&self) -> bool {
        self.squared_sine.is_nan() || self.squared_sine <= PARALLEL_EDGES * PARALLEL_EDGES
    }
}
