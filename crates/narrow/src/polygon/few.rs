//! The separating axis test of polygons of few edges: all edges of one shape against all vertices of the other.
//!
//! ```text
//! place the vertices and turn the normals of both shapes, each coordinate in an array of its own
//! for each edge of one shape, side by side:
//!   separation = min over the other's vertices of n.x - n.(the edge's own first vertex)
//! normalise the best edge's normal, and project every vertex on it: only this result is trusted
//! ```
//! An edge's own vertex is certainly furthest along its normal: polygons are convex by exact predicates.
//!
//! What is lost to rounding: the normal is stored within 4 u of the true one (2 in direction, 2 in length), turned, 2.9
//! u, and multiplied by a scale, 2 u: less than 9 u of what is projected, which is a difference of points. Placing a
//! vertex takes 2.9 u, adding the offset 1 u, each product 2 u, the difference 1 u. All in all less than 16 u of the
//! reach: within two projections' rounding of the truth, in both directions. The same holds for parts, whose matrices
//! take 3 u more.
//!
//! 1. Coordinates stand in arrays of one length, eight or sixteen, padded with the last vertex: no loop has a variable
//!    count.
//! 2. The greatest separation is found by a tree of maxima; which edge shows it, afterwards.
//! 3. The best edge's normal is normalised by one step of Newton's, without a root.
//!
//! Together, AMD EPYC, Zen 4, 2026-11-21: `poly8/mixed/separation` 160 ns to 132, `poly8/mixed/manifold` 189 to 164.
//! Not done: all of it compiled for AVX2, four lanes in place of two: boolean 48 ns to 40, separation 133 to 118,
//! manifold 166 to 148, less what a call through run-time detection costs.
//!
//! The loops are the scalar definition as well; a test checks them bit for bit against one edge after the other.

use super::outline::{Turn, renormalized};
use super::placed::Placed;
use super::sat::{Axes, Axis, AxisOf, Outcome, Sides, Wanted, doubt, hint_of};
use asunder_geometry::glam::{DVec2, Vec2};

/// A core's vertices in the frame of the pair, and its edges' outward normals. The rest of the arrays repeats the last
/// one, so that loops need no count; a point's normals are zero.
pub(super) struct Few<const N: usize> {
    x: [f64; N],
    y: [f64; N],
    normal_x: [f64; N],
    normal_y: [f64; N],
    vertices: usize,
    edges: usize,
    radius: f64,
}

impl<const N: usize> Few<N> {
    /// A core of at most N vertices, and how far its shape reaches beyond it.
    #[inline]
    pub(super) fn new(core: (&[Vec2], &[DVec2]), turn: &Turn, position: DVec2, radius: f64) -> Self {
        let (c, s) = (turn.axes()[0].x, turn.axes()[0].y);
        let unit = turn.unit();
        let (last, last_edge) = (core.0.len().min(N).wrapping_sub(1), core.1.len().min(N).wrapping_sub(1));
        let (vertices, edges) = (core.0.len().min(N), core.1.len().min(N));
        let blank = [0.0; N];
        let mut few = Self { x: blank, y: blank, normal_x: blank, normal_y: blank, vertices, edges, radius };
        // By loops: without link-time optimisation `map` and `from_fn` are calls, half of all instructions for
        // octagons.
        for i in 0..N {
            let v = core.0.get(i.min(last)).map_or(DVec2::ZERO, |v| v.as_dvec2());
            (few.x[i], few.y[i]) = (position.x + (c * v.x - s * v.y), position.y + (s * v.x + c * v.y));
            let n = core.1.get(i.min(last_edge)).copied().unwrap_or(DVec2::ZERO);
            few.normal_x[i] = (c * n.x - s * n.y) * unit;
            few.normal_y[i] = (s * n.x + c * n.y) * unit;
        }
        few
    }

    /// The separation along each edge's normal; entries beyond the last edge mean nothing.
    #[inline]
    fn separations(&self, other: &Self) -> [f64; N] {
        let mut least = [f64::INFINITY; N];
        for j in 0..other.vertices {
            let (x, y) = (other.x[j], other.y[j]);
            for (i, least) in least.iter_mut().enumerate() {
                let reach = self.normal_x[i] * x + self.normal_y[i] * y;
                *least = if reach < *least { reach } else { *least };
            }
        }
        for (i, least) in least.iter_mut().enumerate() {
            *least -= self.normal_x[i] * self.x[i] + self.normal_y[i] * self.y[i];
        }
        least
    }

    /// The greatest separation, before normals are normalised again, and which edge shows it.
    #[inline]
    pub(super) fn best(&self, other: &Self) -> (f64, usize) {
        self.greatest(&self.separations(other))
    }

    /// How far the core reaches along a direction.
    #[inline]
    fn reach(&self, direction: DVec2) -> f64 {
        let mut reaches = [0.0; N];
        for (i, reach) in reaches.iter_mut().enumerate() {
            *reach = direction.x * self.x[i] + direction.y * self.y[i];
        }
        top(&reaches)
    }

    /// The unit normal of an edge.
    #[inline]
    fn normal(&self, edge: usize) -> DVec2 {
        renormalized(DVec2::new(self.normal_x[edge], self.normal_y[edge]))
    }

    /// The greatest separation along an edge's normal, and the first edge that shows it; -inf for a point.
    #[inline]
    fn greatest(&self, separations: &[f64; N]) -> (f64, usize) {
        let top = top(separations);
        let first = (0..N).rev().fold(0, |first, i| if separations[i] == top { i } else { first });
        (if self.edges == 0 { f64::NEG_INFINITY } else { top }, first)
    }
}

/// The greatest of all, by halves: lanes are compared side by side.
#[inline]
fn top<const N: usize>(values: &[f64; N]) -> f64 {
    let mut values = *values;
    let mut half = N / 2;
    while half > 0 {
        for i in 0..half {
            let other = values[i + half];
            values[i] = if other > values[i] { other } else { values[i] };
        }
        half /= 2;
    }
    values[0]
}

/// An axis by full projection.
#[inline]
fn axis<const N: usize>(a: &Few<N>, b: &Few<N>, of: AxisOf) -> Axis {
    let normal = match of {
        AxisOf::EdgeA(edge) => a.normal(edge),
        AxisOf::EdgeB(edge) => -b.normal(edge),
    };
    Axis { separation: -b.reach(-normal) - a.reach(normal), normal, of }
}

/// Finds the best axes. `kept` is the edge that the hint refers to.
#[inline]
pub(super) fn separating_axes<const N: usize>(
    [a, b]: [&Few<N>; 2],
    kept: Option<AxisOf>,
    wanted: &Wanted,
) -> Outcome {
    if let Some(of) = kept {
        let axis = axis(a, b, of);
        if axis.separation > wanted.limit {
            return Outcome::Beyond(axis.separation, wanted.hint);
        }
    }
    let (of_a, of_b) = (a.separations(b), b.separations(a));
    let (in_a, in_b) = (a.greatest(&of_a), b.greatest(&of_b));
    let top = if in_b.0 > in_a.0 { in_b.0 } else { in_a.0 };
    let mut axes = Axes::NONE;
    if in_a.0 >= top - wanted.band {
        axes.edge_a = axis(a, b, AxisOf::EdgeA(in_a.1));
    }
    if in_b.0 >= top - wanted.band {
        axes.edge_b = axis(a, b, AxisOf::EdgeB(in_b.1));
    }
    let best = axes.best().separation;
    if best > wanted.limit {
        return Outcome::Beyond(best, hint_of(axes.best().of));
    }
    axes.short = doubt(wanted.precision) + (top - best).max(0.0);
    axes.kept = kept
        .filter(|of| {
            let separation = match *of {
                AxisOf::EdgeA(edge) => of_a[edge],
                AxisOf::EdgeB(edge) => of_b[edge],
            };
            separation >= top - wanted.band
        })
        .map(|of| axis(a, b, of));
    Outcome::Within(axes)
}

/// Whether the axes show the two shapes apart, or overlapping, by more than `doubt`.
#[inline]
pub(super) fn sides<const N: usize>([a, b]: [&Few<N>; 2], doubt: f64) -> Sides {
    let (in_a, _) = a.best(b);
    if in_a > doubt {
        return Sides::Apart;
    }
    let (in_b, _) = b.best(a);
    if in_b > doubt {
        return Sides::Apart;
    }
    if in_a < -doubt && in_b < -doubt { Sides::Overlapping } else { Sides::Unclear }
}

impl<const N: usize> Placed for Few<N> {
    #[inline]
    fn radius(&self) -> f64 {
        self.radius
    }

    #[inline]
    fn is_flat(&self) -> bool {
        self.vertices <= 2
    }

    #[inline]
    fn edge_count(&self) -> usize {
        self.edges
    }

    #[inline]
    fn after(&self, vertex: usize) -> usize {
        if vertex + 1 == self.vertices { 0 } else { vertex + 1 }
    }

    #[inline]
    fn before(&self, vertex: usize) -> usize {
        if vertex == 0 { self.vertices - 1 } else { vertex - 1 }
    }

    #[inline]
    fn point(&self, vertex: usize) -> DVec2 {
        DVec2::new(self.x[vertex], self.y[vertex])
    }

    #[inline]
    fn outward(&self, edge: usize) -> DVec2 {
        DVec2::new(self.normal_x[edge], self.normal_y[edge])
    }

    #[inline]
    fn furthest(&self, direction: DVec2) -> usize {
        let mut best = (f64::NEG_INFINITY, 0);
        for vertex in 0..self.vertices {
            let reach = direction.dot(self.point(vertex));
            if reach > best.0 {
                best = (reach, vertex);
            }
        }
        best.1
    }
}
