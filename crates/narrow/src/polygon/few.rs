//! The separating axis test of polygons of few edges: all edges of one shape against all vertices of the other.
//!
//! ```text
//! place the vertices and turn the normals of both shapes, each coordinate in an array of its own
//! for each edge of one shape, side by side:
//!   separation = min over the other's vertices of n.x - n.(the edge's own first vertex)
//! the best edge is then normalised and believed after projecting every vertex
//! ```
//! That an edge's own vertex is furthest along its own normal is no guess: polygons are convex by exact predicates.
//!
//! What is lost to rounding: the normal is stored within 4 u of the true one (2 in direction, 2 in length), turned, 2.9 u, and
//! multiplied by a scale, 2 u: less than 9 u of what is projected, which is a difference of points. Placing a vertex
//! takes 2.9 u, adding the offset 1 u, each product 2 u, the difference 1 u. All in all less than 16 u of the reach: within two
//! projections' rounding of the truth, in both directions, and so are parts', whose matrices take 3 u more.

use super::outline::Outline;
use super::sat::{Axes, Axis, AxisOf, Named, Outcome, Sides, Wanted, doubt, hint_of, named};
use asunder_geometry::glam::DVec2;

/// A core's vertices in the frame of the pair, and its edges' outward normals. What is left of the arrays repeats the
/// last one.
struct Few<const N: usize> {
    x: [f64; N],
    y: [f64; N],
    normal_x: [f64; N],
    normal_y: [f64; N],
    vertices: usize,
    edges: usize,
}

impl<const N: usize> Few<N> {
    #[inline]
    fn new(outline: &Outline) -> Self {
        let (vertices, edges) = (outline.vertices.len().min(N), outline.edge_count().min(N));
        let (mut x, mut y, mut normal_x, mut normal_y) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
        for i in 0..vertices {
            (x[i], y[i]) = outline.point(i).into();
        }
        for i in 0..edges {
            (normal_x[i], normal_y[i]) = outline.outward(i).into();
        }
        Self { x, y, normal_x, normal_y, vertices, edges }
    }

    /// The separation along each edge's normal; only those of edges mean anything.
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

    /// How far the core reaches along a direction.
    #[inline]
    fn reach(&self, direction: DVec2) -> f64 {
        let mut most = f64::NEG_INFINITY;
        for i in 0..self.vertices {
            let reach = direction.x * self.x[i] + direction.y * self.y[i];
            most = if reach > most { reach } else { most };
        }
        most
    }

    /// The unit normal of an edge.
    #[inline]
    fn normal(&self, edge: usize) -> DVec2 {
        DVec2::new(self.normal_x[edge], self.normal_y[edge]).normalize()
    }
}

/// The greatest, and the first that is as great.
#[inline]
fn greatest(separations: &[f64]) -> (f64, usize) {
    let mut best = (f64::NEG_INFINITY, 0);
    for (edge, &separation) in separations.iter().enumerate() {
        if separation > best.0 {
            best = (separation, edge);
        }
    }
    best
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

/// Finds the best axes. No vertex count is above N.
pub(super) fn separating_axes<const N: usize>(a: &Outline, b: &Outline, wanted: &Wanted) -> Outcome {
    let kept = match named(a, b, wanted.hint) {
        Some(Named::Edge(of)) => Some(of),
        _ => None,
    };
    let (few_a, few_b) = (Few::<N>::new(a), Few::<N>::new(b));
    if let Some(of) = kept {
        let axis = axis(&few_a, &few_b, of);
        if axis.separation > wanted.limit {
            return Outcome::Beyond(axis.separation, wanted.hint);
        }
    }
    let doubt = doubt(wanted.precision);
    let (of_a, of_b) = (few_a.separations(&few_b), few_b.separations(&few_a));
    let (in_a, in_b) = (greatest(&of_a[..few_a.edges]), greatest(&of_b[..few_b.edges]));
    let top = in_a.0.max(in_b.0);
    let mut axes = Axes::NONE;
    if few_a.edges > 0 && in_a.0 >= top - wanted.band {
        axes.edge_a = axis(&few_a, &few_b, AxisOf::EdgeA(in_a.1));
    }
    if few_b.edges > 0 && in_b.0 >= top - wanted.band {
        axes.edge_b = axis(&few_a, &few_b, AxisOf::EdgeB(in_b.1));
    }
    let best = axes.best();
    if best.separation > wanted.limit {
        return Outcome::Beyond(best.separation, hint_of(best.of));
    }
    axes.short = doubt + (top - best.separation).max(0.0);
    axes.kept = kept
        .filter(|of| {
            let separation = match *of {
                AxisOf::EdgeA(edge) => of_a[edge],
                AxisOf::EdgeB(edge) => of_b[edge],
            };
            separation >= top - wanted.band
        })
        .map(|of| axis(&few_a, &few_b, of));
    Outcome::Within(axes)
}

/// Which side of touching the shapes are on. No vertex count is above N.
pub(super) fn sides<const N: usize>(a: &Outline, b: &Outline, doubt: f64) -> Sides {
    let (few_a, few_b) = (Few::<N>::new(a), Few::<N>::new(b));
    let (in_a, _) = greatest(&few_a.separations(&few_b)[..few_a.edges]);
    if in_a > doubt {
        return Sides::Apart;
    }
    let (in_b, _) = greatest(&few_b.separations(&few_a)[..few_b.edges]);
    if in_b > doubt {
        return Sides::Apart;
    }
    if in_a.max(in_b) < -doubt { Sides::Overlapping } else { Sides::Unclear }
}
