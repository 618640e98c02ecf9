//! The best axes of two cores that overlap, without a branch: for kernels with many pairs side by side, the same as
//! [`Placed::settle`](super::placed::Placed::settle) finds step by step.
//!
//! ```text
//! best face of A, of B                   as there
//! normalise all nine edge pairs          those that cannot matter are ignored
//! settled if                             they overlap for certain, and the best edges, if they beat the faces,
//!                                        need no projection
//! ```
//! That is nine roots and quotients where a single pair needs none or few: side by side they cost less than a
//! mispredicted branch.

use super::fifteen::{Fifteen, closed_form};
use super::settled::{Best, Edges, Face, SLACK};
use crate::precision::Precision;
use asunder_geometry::tolerance::PARALLEL_EDGES;

/// The best axes, as numbers only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Graded {
    /// Is 1 if the other fields are valid, 0 if the pair must be answered by itself.
    pub(super) is_settled: f64,
    /// The best face of each cuboid: its axis.
    pub(super) face_a: f64,
    pub(super) face_b: f64,
    /// The edge pair that is better than both faces, or -1.
    pub(super) pair: f64,
    /// Its separation.
    pub(super) edges: f64,
    /// As in [`Best`].
    pub(super) short: f64,
}

impl Graded {
    /// The best axes as [`Placed::settle`](super::placed::Placed::settle) returns them. `faces` are the best faces'
    /// separations.
    #[inline(always)]
    pub(super) fn best(&self, faces: [f64; 2]) -> Option<Best> {
        let pair = self.pair as i32;
        (self.is_settled > 0.0).then_some(Best {
            face_a: Face { separation: faces[0], axis: self.face_a as usize },
            face_b: Face { separation: faces[1], axis: self.face_b as usize },
            edges: (pair >= 0).then_some(Edges { separation: self.edges, pair: pair as usize }),
            short: self.short,
        })
    }
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The greatest of three and its index; of equals, the first.
#[inline(always)]
fn first_greatest([x, y, z]: [f64; 3]) -> (f64, f64) {
    let (one, place) = if y > x { (y, 1.0) } else { (x, 0.0) };
    if z > one { (z, 2.0) } else { (one, place) }
}

impl Fifteen {
    /// Finds the best axes of a pair that none of them separates.
    #[inline(always)]
    pub(super) fn graded(&self, precision: &Precision) -> Graded {
        let (rounding, doubt) = (precision.projection(), closed_form(precision));
        let [x, y, z, _] = self.faces_b.0;
        let (of_a, face_a) = first_greatest(self.faces_a);
        let (of_b, face_b) = first_greatest([x, y, z]);
        let face = greater(of_b, of_a);
        let slack = face.abs() * SLACK;
        let bound = face + slack;
        let squared_bound = bound * bound;
        let (mut separation, mut pair, mut lost) = (f64::NEG_INFINITY, -1.0, 0.0);
        let (mut ceiling, mut left_out) = (f64::NEG_INFINITY, 0.0);
        for n in 0..9 {
            let (scaled, squared) = (self.edges[n / 3].0[n % 3], self.squared[n / 3].0[n % 3]);
            let most = scaled + doubt;
            let is_less = (bound <= 0.0) & (most <= 0.0) & (most * most >= squared_bound * squared);
            let is_parallel = squared <= PARALLEL_EDGES * PARALLEL_EDGES;
            let length = squared.sqrt();
            let inverse = 1.0 / length;
            let may_lose = doubt * inverse;
            let found = if is_less | is_parallel { f64::NEG_INFINITY } else { scaled * inverse };
            ceiling = greater(found + may_lose, ceiling);
            let is_better = found > separation;
            separation = if is_better { found } else { separation };
            pair = if is_better { n as f64 } else { pair };
            lost = if is_better { may_lose } else { lost };
            // As in `Placed::look_at_edges`.
            let by_axis = (scaled + 2.0 * doubt) * inverse - face;
            let by_angle = 5.0 * (length * precision.reach + rounding);
            let left = if by_axis < by_angle { by_axis } else { by_angle };
            let left = if is_less { 0.0 } else { left };
            left_out = if is_parallel { greater(left, left_out) } else { left_out };
        }
        let do_edges = separation > face + doubt;
        let best = if do_edges { separation } else { face };
        let short = greater(greater(greater(slack, rounding), ceiling - best), left_out);
        let is_settled = (best + short < -2.0 * rounding) & !(do_edges & (lost > slack));
        Graded {
            is_settled: if is_settled { 1.0 } else { 0.0 },
            face_a,
            face_b,
            pair: if do_edges { pair } else { -1.0 },
            edges: separation,
            short,
        }
    }
}
