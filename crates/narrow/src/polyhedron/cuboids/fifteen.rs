//! All fifteen axes of two cuboids, computed at once.
//!
//! ```text
//! R = B's axes seen from A (columns), t = B's centre seen from A, h, k = half extents, i+1 and i+2 modulo 3
//! face i of A  |t_i|                         - h_i                             - sum k_j |R_ij|
//! face j of B  |sum t_i R_ij|                - sum h_i |R_ij|                  - k_j
//! edges i, j   |t_i+2 R_i+1,j - t_i+1 R_i+2,j| - h_i+1 |R_i+2,j| - h_i+2 |R_i+1,j| - k_j+1 |R_i,j+2| - k_j+2 |R_i,j+1|
//!              along an axis of squared length R_i+1,j^2 + R_i+2,j^2
//! ```
//! Gottschalk, Lin and Manocha, "OBBTree" (SIGGRAPH 1996). The axes of A and of B are rows of four lanes, the last one
//! padding, and nothing branches. No axis is normalised here: lengths enter as squares, and only where they matter.

use crate::lanes::Lanes;
use crate::precision::Precision;
use asunder_geometry::Basis3;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::PARALLEL_EDGES;

/// The separations of the cores along fifteen axes. Those of edge pairs are times the length of their axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fifteen {
    pub(super) faces_a: [f64; 3],
    pub(super) faces_b: Row,
    /// B's centre along its own axes.
    pub(super) ahead: Row,
    /// Row `i`, column `j`: the edges along axis `i` of A and axis `j` of B.
    pub(super) edges: [Row; 3],
    /// Squared lengths of the edge pairs' axes, which are squared sines of the edges' angles.
    pub(super) squared: [Row; 3],
}

type Row = Lanes<4>;

impl Fifteen {
    /// Computes all of it.
    #[inline(always)]
    pub(super) fn new(half: &[DVec3; 2], relative: &Basis3, offset: DVec3) -> Self {
        let (h, k, t) = (half[0].to_array(), half[1].to_array(), offset.to_array());
        let Basis3 { x, y, z } = relative;
        let rows = [Lanes([x.x, y.x, z.x, 0.0]), Lanes([x.y, y.y, z.y, 0.0]), Lanes([x.z, y.z, z.z, 0.0])];
        let sizes = [rows[0].abs(), rows[1].abs(), rows[2].abs()];
        let squares = [rows[0] * rows[0], rows[1] * rows[1], rows[2] * rows[2]];
        // `next` and `after` are the two other half extents of B for lane `j`. The padding shows an infinite overlap.
        let (next, after) = (Lanes([k[1], k[2], k[0], f64::MAX]), Lanes([k[2], k[0], k[1], 0.0]));
        let edges = |i: usize, n: usize, m: usize| {
            let [x, y, z, _] = sizes[i].0;
            let radius = sizes[n] * h[m] + sizes[m] * h[n];
            let other = next * Lanes([z, x, y, 1.0]) + after * Lanes([y, z, x, 0.0]);
            (rows[n] * t[m] - rows[m] * t[n]).abs() - radius - other
        };
        let face_a = |i: usize| {
            let [x, y, z, _] = sizes[i].0;
            t[i].abs() - h[i] - (x * k[0] + y * k[1] + z * k[2])
        };
        let ahead = rows[0] * t[0] + rows[1] * t[1] + rows[2] * t[2];
        Self {
            ahead,
            faces_a: [face_a(0), face_a(1), face_a(2)],
            faces_b: ahead.abs()
                - Lanes([k[0], k[1], k[2], 0.0])
                - (sizes[0] * h[0] + sizes[1] * h[1] + sizes[2] * h[2]),
            edges: [edges(0, 1, 2), edges(1, 2, 0), edges(2, 0, 1)],
            squared: [squares[1] + squares[2], squares[2] + squares[0], squares[0] + squares[1]],
        }
    }

    /// The separation along the axis of an edge pair, times its length, and its length squared.
    #[inline(always)]
    pub(super) fn edge_pair(&self, pair: usize) -> (f64, f64) {
        let (i, j) = (pair / 3 % 3, pair % 3);
        (self.edges[i].0[j], self.squared[i].0[j])
    }

    /// The edge pair with the greatest separation, of those that separate the cores and are not parallel up to
    /// rounding. Where two are nearly equal, rounding may choose the lesser. `None` where none separates them.
    #[inline]
    pub(super) fn best_edges(&self) -> Option<usize> {
        let (mut best, mut most) = (None, 0.0);
        for n in 0..9 {
            let (scaled, squared) = self.edge_pair(n);
            let is_sound = (scaled > 0.0) & (squared > PARALLEL_EDGES * PARALLEL_EDGES);
            let found = if is_sound { scaled * scaled / squared } else { 0.0 };
            (best, most) = if found > most { (Some(n), found) } else { (best, most) };
        }
        best
    }

    /// Whether an edge pair separates the cores by more than `limit` metres, which is not negative, plus the error
    /// bound of its closed form.
    #[inline(always)]
    pub(super) fn do_edges_part(&self, limit: f64, doubt: f64) -> bool {
        let (squared_limit, mut part) = (limit * limit, false);
        for n in 0..9 {
            let (scaled, squared) = self.edge_pair(n);
            let sure = scaled - doubt;
            part |= (sure > 0.0)
                & (sure * sure > squared_limit * squared)
                & (squared > PARALLEL_EDGES * PARALLEL_EDGES);
        }
        part
    }

    /// The greatest of all separations, none of them normalised.
    #[inline(always)]
    pub(super) fn top(&self) -> f64 {
        let greater = |a: f64, b: f64| if a > b { a } else { b };
        let row = |row: &[f64]| greater(greater(row[0], row[1]), row[2]);
        let faces = greater(row(&self.faces_a), row(&self.faces_b.0));
        let edges = greater(greater(row(&self.edges[0].0), row(&self.edges[1].0)), row(&self.edges[2].0));
        greater(faces, edges)
    }

    /// Whether cuboids with such a sum of radii, in metres, overlap. `None` where rounding could change the answer, or
    /// only their radii close the gap.
    #[inline(always)]
    pub(super) fn overlap(&self, radii: f64, precision: &Precision) -> Option<bool> {
        let (top, doubt) = (self.top(), closed_form(precision));
        if top - radii > doubt {
            return Some(false);
        }
        if top < -doubt {
            return Some(true);
        }
        if top > doubt {
            return None;
        }
        // Axes of parallel edges have no length, and prove nothing: boxes on a grid have three of them or more.
        let (mut top, mut least) = (f64::NEG_INFINITY, 0.0_f64);
        for n in 0..6 {
            top = top.max(if n < 3 { self.faces_a[n] } else { self.faces_b.0[n - 3] });
        }
        for n in 0..9 {
            let (scaled, squared) = self.edge_pair(n);
            if squared > PARALLEL_EDGES * PARALLEL_EDGES {
                top = top.max(scaled);
            } else {
                least = least.max(precision.of_parallel_edges(squared));
            }
        }
        (top < -doubt - least).then_some(true)
    }

    /// An axis that separates the cores by more than `limit` metres for certain: 0 to 2 for A's faces, 3 to 5 for B's,
    /// from 6 for edge pairs; -1 where there is none. Of faces, the best; edge pairs only where no face does.
    ///
    /// For an edge pair the error bound is subtracted from its closed form, both times the axis' length.
    #[inline(always)]
    pub(super) fn parted(&self, limit: f64, precision: &Precision) -> f64 {
        let (limit, doubt) = (limit + precision.projection(), closed_form(precision));
        let squared_limit = limit * limit;
        let (mut by_face, mut best) = (-1.0, limit);
        for n in 0..6 {
            let separation = if n < 3 { self.faces_a[n] } else { self.faces_b.0[n - 3] };
            let is_better = separation > best;
            by_face = if is_better { n as f64 } else { by_face };
            best = if is_better { separation } else { best };
        }
        let (mut by_edges, mut best) = (-1.0, 0.0);
        for n in 0..9 {
            let sure = self.edges[n / 3].0[n % 3] - doubt;
            let is_better = (sure > best) & (sure * sure > squared_limit * self.squared[n / 3].0[n % 3]);
            by_edges = if is_better { (6 + n) as f64 } else { by_edges };
            best = if is_better { sure } else { best };
        }
        if by_face >= 0.0 { by_face } else { by_edges }
    }
}

/// Error bound of the closed forms, times the axis' length.
#[inline(always)]
pub(super) fn closed_form(precision: &Precision) -> f64 {
    1.5 * precision.projection()
}
