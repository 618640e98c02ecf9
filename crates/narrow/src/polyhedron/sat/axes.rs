//! Axes, and the best of each kind.

use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// The features that an axis belongs to.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) enum AxisOf {
    FaceA(usize),
    FaceB(usize),
    /// Lower half-edges of an edge of A and of B.
    Edges(usize, usize),
}

/// A unit axis from A to B, and the separation along it by full projection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) separation: f64,
    pub(crate) normal: DVec3,
    pub(crate) of: AxisOf,
}

/// The best axis of each kind. One that was never evaluated has separation -inf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) face_a: Axis,
    pub(crate) face_b: Axis,
    pub(crate) edges: Axis,
    /// An upper bound on the true separation along every axis that was proposed.
    ceiling: f64,
    /// By how much the best axis may fall short of the truth because of edge pairs that proposed none.
    pub(super) left_out: f64,
}

impl Axes {
    pub(crate) const NONE: Self = Self {
        face_a: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::FaceA(0) },
        face_b: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::FaceB(0) },
        edges: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::Edges(0, 0) },
        ceiling: f64::NEG_INFINITY,
        left_out: 0.0,
    };

    /// Records that some axis shows a separation, which may be too small by `doubt`.
    #[inline]
    pub(crate) fn raise(&mut self, separation: f64, doubt: f64) {
        self.ceiling = self.ceiling.max(separation + doubt);
    }

    /// Records a pair of edges so nearly parallel that their axis is not proposed, given the separation along it.
    ///
    /// Two bounds hold for the true axis of these edges: it shows no more than the given one plus its rounding, and no
    /// more than the best face plus the cost of a rotation by the edges' angle. Most such pairs are far from being the
    /// best, which the first bound shows.
    #[inline]
    pub(crate) fn leave_out(&mut self, separation: f64, squared_sine: f64, precision: &Precision) {
        // Twice: where rounding is no longer small next to the sine, the axis is off by more than their quotient.
        let by_axis = separation + 2.0 * precision.of_edges(squared_sine) - self.best().separation;
        let by_angle = precision.of_parallel_edges(squared_sine);
        self.left_out = self.left_out.max(by_angle.min(by_axis));
    }

    /// By how much the true separation may exceed the best one found, apart from that one's own rounding.
    pub(crate) fn short(&self) -> f64 {
        (self.ceiling - self.best().separation).max(self.left_out)
    }

    /// Keeps the axis if it is the best of its kind; of equals, that of the lower index.
    pub(crate) fn offer(&mut self, axis: Axis) {
        let slot = match axis.of {
            AxisOf::FaceA(_) => &mut self.face_a,
            AxisOf::FaceB(_) => &mut self.face_b,
            AxisOf::Edges(..) => &mut self.edges,
        };
        let is_earlier = axis.separation == slot.separation && axis.of < slot.of;
        if axis.separation > slot.separation || is_earlier {
            *slot = axis;
        }
    }

    /// The greatest separation of all. Ties: a face of A, then a face of B, then edges.
    pub(crate) fn best(&self) -> &Axis {
        let mut best = &self.face_a;
        for other in [&self.face_b, &self.edges] {
            if other.separation > best.separation {
                best = other;
            }
        }
        best
    }
}
