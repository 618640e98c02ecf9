//! The separating axis test for two cuboids: fifteen axes.
//!
//! ```text
//! R = B's axes seen from A, t = B's centre seen from A, h, k = half extents
//! separation along n = |n.t| - sum of h_i |n.e_i| - sum of k_j |n.R_j|
//! for n in the 3 axes of A, the 3 of B, and their 9 cross products
//! ```
//! Gottschalk, Lin and Manocha, "OBBTree" (SIGGRAPH 1996). A closed-form projection radius replaces the eight vertices;
//! everything else is as in the general test, including how axes of nearly parallel edges are treated.
//!
//! [`Cuboids`] is the plain definition, one axis after the other. It answers for parts of compounds, and where the
//! kernels below leave a pair open. Two bodies that are cuboids take a faster path to the same answers
//! ([`placed::Posed`]): `fifteen` computes all axes at once; `settled` picks the best of them for one pair, `graded`
//! for eight side by side (`eight`), without a branch.

pub(crate) mod ball;
mod brick;
mod contact;
pub(crate) mod eight;
mod fifteen;
mod gap;
mod graded;
mod names;
mod patch;
pub(crate) mod placed;
pub(crate) mod queries;
mod reduce;
mod settled;
mod wide;

use super::sat::{Axes, Axis, AxisOf};
use super::solid::Solid;
use crate::precision::Precision;
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::PARALLEL_EDGES;

/// Two cuboids in the frame of the pair.
pub(crate) struct Cuboids {
    /// Half extents of A.
    pub(crate) half_a: DVec3,
    /// Half extents of B.
    pub(crate) half_b: DVec3,
    /// B's axes seen from A.
    pub(crate) basis: Basis3,
    /// B's centre seen from A.
    pub(crate) offset: DVec3,
}

/// Which side of touching the axes show two cuboids to be on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// One axis separates them for certain.
    Apart,
    /// Every axis shows more overlap than its error bound.
    Overlapping,
    /// Some axis is too close to call.
    Unclear,
}

/// One axis that separates the cuboids by more than the limit, or the best axis of each kind.
pub(crate) enum Outcome {
    Beyond(Axis),
    Within(Axes),
}

impl Cuboids {
    fn axis_b(&self, j: usize) -> DVec3 {
        [self.basis.x, self.basis.y, self.basis.z][j]
    }

    /// Separation along an axis of any length, scaled by that length.
    fn along(&self, axis: DVec3) -> f64 {
        let radius_a = axis.abs().dot(self.half_a);
        let radius_b = self.basis.turn_back(axis).abs().dot(self.half_b);
        axis.dot(self.offset).abs() - radius_a - radius_b
    }

    /// The cross product of edges along two axes. `Err` if they are nearly parallel: with the squared sine of their
    /// angle, and not to be used as an axis.
    fn cross(&self, i: usize, j: usize) -> Result<DVec3, (DVec3, f64)> {
        let cross = DVec3::AXES[i].cross(self.axis_b(j));
        let squared_sine = cross.length_squared();
        if squared_sine > PARALLEL_EDGES * PARALLEL_EDGES { Ok(cross) } else { Err((cross, squared_sine)) }
    }

    /// Whether no axis separates them. No axis is normalised.
    pub(crate) fn overlaps(&self) -> bool {
        (0..3).all(|i| self.along(DVec3::AXES[i]) <= 0.0)
            && (0..3).all(|j| self.along(self.axis_b(j)) <= 0.0)
            && (0..9).all(|k| self.cross(k / 3, k % 3).map_or(true, |cross| self.along(cross) <= 0.0))
    }

    /// Which side of touching the axes show them to be on.
    ///
    /// No axis is longer than 1, so that its rounding error is no more than along a unit axis: one comparison replaces
    /// a length and a quotient for each axis.
    pub(crate) fn sides(&self, precision: &Precision) -> Sides {
        let rounding = precision.projection();
        let (mut top, mut left_out) = (f64::NEG_INFINITY, 0.0_f64);
        let mut parts = |axis: DVec3| {
            let separation = self.along(axis);
            top = top.max(separation);
            separation > rounding
        };
        let mut are_apart = (0..3).any(|i| parts(DVec3::AXES[i])) || (0..3).any(|j| parts(self.axis_b(j)));
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            if are_apart {
                break;
            }
            match self.cross(i, j) {
                // Of unit vectors: the axis' rounding over the sine, times its length, which is that sine.
                Ok(cross) => are_apart = parts(cross),
                Err((_, squared_sine)) => left_out = left_out.max(precision.of_parallel_edges(squared_sine)),
            }
        }
        // The rounding of an axis, and by how much the axis may be off its place.
        let ceiling = top + rounding + precision.of_face() + left_out;
        match are_apart {
            true => Sides::Apart,
            false if ceiling < 0.0 => Sides::Overlapping,
            false => Sides::Unclear,
        }
    }

    /// Tests all fifteen axes, until one separates the cuboids by more than `limit`.
    pub(crate) fn separating_axes(&self, a: &Solid, b: &Solid, limit: f64, precision: &Precision) -> Outcome {
        let mut axes = Axes::NONE;
        for i in 0..3 {
            axes.offer(self.face_axis_a(i));
            if axes.face_a.separation > limit {
                return Outcome::Beyond(axes.face_a);
            }
        }
        for j in 0..3 {
            axes.offer(self.face_axis_b(j));
            if axes.face_b.separation > limit {
                return Outcome::Beyond(axes.face_b);
            }
        }
        axes.raise(axes.best().separation, precision.of_face());
        let mut best = (f64::NEG_INFINITY, DVec3::X, 0, 0);
        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
            let cross = match self.cross(i, j) {
                Ok(cross) => cross,
                Err((cross, squared_sine)) => {
                    let separation = self.along(cross) / squared_sine.sqrt();
                    axes.leave_out(separation, squared_sine, precision);
                    continue;
                }
            };
            let length = cross.length();
            let normal = cross / length;
            let separation = self.along(normal);
            axes.raise(separation, precision.of_face() / length);
            if separation > best.0 {
                best = (separation, normal, i, j);
            }
            if separation > limit {
                break;
            }
        }
        // Which of the four edges along an axis it is, is only looked up for the best pair.
        let (separation, normal, i, j) = best;
        if separation > f64::NEG_INFINITY {
            axes.offer(self.edge_axis(a, b, (i, j), separation, normal));
        }
        if axes.edges.separation > limit { Outcome::Beyond(axes.edges) } else { Outcome::Within(axes) }
    }

    /// An axis flipped to point from A to B. At equal centres either sense is right; this keeps the given one.
    fn towards_b(&self, axis: DVec3) -> DVec3 {
        if axis.dot(self.offset) < 0.0 { -axis } else { axis }
    }

    fn face_axis_a(&self, i: usize) -> Axis {
        let normal = self.towards_b(DVec3::AXES[i]);
        let face = 2 * i + usize::from(normal[i] > 0.0);
        Axis { separation: self.along(normal), normal, of: AxisOf::FaceA(face) }
    }

    fn face_axis_b(&self, j: usize) -> Axis {
        let normal = self.towards_b(self.axis_b(j));
        // The face of B that faces A.
        let face = 2 * j + usize::from(normal.dot(self.axis_b(j)) < 0.0);
        Axis { separation: self.along(normal), normal, of: AxisOf::FaceB(face) }
    }

    fn edge_axis(
        &self,
        a: &Solid,
        b: &Solid,
        (i, j): (usize, usize),
        separation: f64,
        normal: DVec3,
    ) -> Axis {
        let normal = self.towards_b(normal);
        let edge_a = edge_along(a, i, a.support(normal).vertex);
        let edge_b = edge_along(b, j, b.support(-normal).vertex);
        Axis { separation, normal, of: AxisOf::Edges(edge_a, edge_b) }
    }
}

/// The edge of a cuboid that runs along an axis through a corner.
fn edge_along(cuboid: &Solid, axis: usize, corner: usize) -> usize {
    // Corners that differ in one bit share an edge, and every such edge exists.
    cuboid.edge_between(corner & !(1 << axis), corner | 1 << axis).unwrap_or(0)
}

#[cfg(test)]
mod tests;
