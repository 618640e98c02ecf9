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

use super::outline::Turn;
use super::placed::Placed;
use super::sat::{Axes, Axis, AxisOf, Outcome, Sides, Wanted, doubt, hint_of};
use asunder_geometry::glam::{DVec2, Vec2};

/// A core's vertices in the frame of the pair, and its edges' outward normals. What is left of the arrays is zero.
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
        let (mut x, mut y, mut normal_x, mut normal_y) = ([0.0; N], [0.0; N], [0.0; N], [0.0; N]);
        for (vertex, (x, y)) in core.0.iter().zip(x.iter_mut().zip(&mut y)) {
            (*x, *y) = (position + turn.turn(vertex.as_dvec2())).into();
        }
        let unit = turn.unit();
        for (normal, (x, y)) in core.1.iter().zip(normal_x.iter_mut().zip(&mut normal_y)) {
            (*x, *y) = (turn.turn(*normal) * unit).into();
        }
        Self { x, y, normal_x, normal_y, vertices: core.0.len().min(N), edges: core.1.len().min(N), radius }
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

/// Finds the best axes. `kept` is what the hint names.
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
    let (in_a, in_b) = (greatest(&of_a[..a.edges]), greatest(&of_b[..b.edges]));
    let top = if in_b.0 > in_a.0 { in_b.0 } else { in_a.0 };
    let mut axes = Axes::NONE;
    if a.edges > 0 && in_a.0 >= top - wanted.band {
        axes.edge_a = axis(a, b, AxisOf::EdgeA(in_a.1));
    }
    if b.edges > 0 && in_b.0 >= top - wanted.band {
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

/// Which side of touching the shapes are on.
#[inline]
pub(super) fn sides<const N: usize>([a, b]: [&Few<N>; 2], doubt: f64) -> Sides {
    let (in_a, _) = greatest(&a.separations(b)[..a.edges]);
    if in_a > doubt {
        return Sides::Apart;
    }
    let (in_b, _) = greatest(&b.separations(a)[..b.edges]);
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
