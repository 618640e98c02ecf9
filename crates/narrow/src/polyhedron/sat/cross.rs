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
    /// Squares of the edges' lengths.
    squares: [f64; 2],
}

impl Cross {
    #[inline]
    pub(super) fn new(along_a: DVec3, along_b: DVec3) -> Self {
        Self { axis: along_a.cross(along_b), squares: [along_a.length_squared(), along_b.length_squared()] }
    }

    /// The cross product, oriented from A to B. For A's edge it takes the direction and one that lies between the
    /// normals beside it.
    #[inline]
    pub(super) fn outwards(
        (along_a, out_of_a): (DVec3, DVec3),
        along_b: DVec3,
        out_of_b: impl FnOnce() -> DVec3,
    ) -> Self {
        let cross = Self::new(along_a, along_b);
        // Outwards as seen from A's edge: between the normals of its two faces. A segment's arc is its whole great
        // circle; then B's edge decides.
        let outwards = if out_of_a == DVec3::ZERO { -out_of_b() } else { out_of_a };
        if cross.axis.dot(outwards) < 0.0 { Self { axis: -cross.axis, ..cross } } else { cross }
    }

    /// The square of the sine of the angle between the edges.
    pub(super) fn squared_sine(&self) -> f64 {
        self.axis.length_squared() / (self.squares[0] * self.squares[1])
    }

    /// An upper bound on the product of the edges' lengths.
    #[inline]
    pub(super) fn lengths(&self) -> f64 {
        0.5 * (self.squares[0] + self.squares[1])
    }

    /// Whether the edges are so nearly parallel that the axis would be rounding. Also true for edges of no length.
    #[inline]
    pub(super) fn is_noise(&self) -> bool {
        let least = PARALLEL_EDGES * PARALLEL_EDGES * (self.squares[0] * self.squares[1]);
        let is_sure = self.axis.length_squared() > least;
        !is_sure
    }
}
