//! A shape as the kernels see it: its stored vertices, and their pose in the frame of the pair.

use super::few::Few;
use crate::counted::count_step;
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Core2, Rotation2, Shape2};

/// A rotation by its matrix [c -s; s c], in f64: the stored one of a body, or its product with a part's.
///
/// The stored pair is of unit length only up to rounding, so the matrix also scales slightly: that is part of the true
/// shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    pub(crate) fn of(rotation: Rotation2) -> Self {
        Self { cos: f64::from(rotation.cos()), sin: f64::from(rotation.sin()) }
    }

    /// The rotation that takes the x axis to a unit vector.
    pub(crate) fn to(unit: DVec2) -> Self {
        Self { cos: unit.x, sin: unit.y }
    }

    /// One over the matrix' scale, within 3 roundings of 2^-53.
    ///
    /// The squared scale is 1 + e with |e| < 3e-7, also for the product of two matrices: the third power of e is
    /// negligible, and neither root nor quotient is needed.
    #[inline]
    pub(crate) fn unit(&self) -> f64 {
        let excess = self.cos * self.cos + self.sin * self.sin - 1.0;
        1.0 - excess * (0.5 - 0.375 * excess)
    }

    /// The columns of the matrix: the local axes.
    #[inline]
    pub(crate) fn axes(&self) -> [DVec2; 2] {
        [DVec2::new(self.cos, self.sin), DVec2::new(-self.sin, self.cos)]
    }

    /// A vector turned.
    #[inline]
    pub(crate) fn turn(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x - self.sin * v.y, self.sin * v.x + self.cos * v.y)
    }

    /// A direction turned by the transposed matrix: back to local axes, with the matrix' scale.
    #[inline]
    pub(crate) fn turn_back(&self, v: DVec2) -> DVec2 {
        DVec2::new(self.cos * v.x + self.sin * v.y, self.cos * v.y - self.sin * v.x)
    }

    /// The matrix of a part that is turned by `local` inside a body that is turned by this.
    pub(crate) fn of_part(&self, local: Rotation2) -> Self {
        let turned = self.turn(DVec2::new(f64::from(local.cos()), f64::from(local.sin())));
        Self { cos: turned.x, sin: turned.y }
    }
}

/// Up to this many vertices, a support is found by testing each; beyond, by a search.
pub(super) const FEW_VERTICES: usize = 16;

/// What a searched support adds to the rounding error of a projection, in units of 2^-53 of the reach: see
/// [`Outline::climb`].
pub(crate) const OF_SEARCH: f64 = 4.0;

/// A core in the frame of a pair: the world's axes, about A's position. Usually a polygon; a segment has two edges back
/// to back, a point none.
///
/// The stored rotation is of unit length only up to rounding, so turned normals are normalised again, and both shapes
/// are turned where in space one relative rotation would do.
pub(crate) struct Outline<'a> {
    pub(crate) vertices: &'a [Vec2],
    normals: &'a [DVec2],
    /// For a polygon of many vertices, those furthest along +x, +y, -x and -y.
    extremes: Option<[usize; 4]>,
    /// Half extents of a rectangle.
    pub(super) half: Option<DVec2>,
    pub(super) turn: Turn,
    unit: f64,
    pub(super) position: DVec2,
    /// How far the shape reaches beyond this core. Axes and distances leave it out; contact points lie on the shape.
    pub(crate) radius: f64,
}

/// Where a projection is greatest, and how great.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    pub(crate) vertex: usize,
    pub(crate) reach: f64,
}

/// Normalises a vector that is of unit length up to some roundings, to within 3: by one step of Newton's, without a
/// root.
#[inline]
pub(super) fn renormalized(v: DVec2) -> DVec2 {
    v * (1.5 - 0.5 * v.length_squared())
}

/// Whether supports of a shape are searched, and so less exact by [`OF_SEARCH`].
pub(crate) fn is_searched(shape: &Shape2) -> bool {
    matches!(shape, Shape2::Polygon(polygon) if polygon.vertices().len() > FEW_VERTICES)
}

/// The corner of a rectangle that is furthest along a direction in its own axes; of those that tie, the lowest.
#[inline(always)]
fn corner_along(local: DVec2) -> usize {
    let (is_above, is_level) = (local.y > 0.0, local.x == 0.0);
    let is_right = (local.x > 0.0) | (is_above & is_level);
    // Counter-clockwise from the lower left.
    usize::from(is_right ^ is_above) | usize::from(is_above) << 1
}

impl<'a> Outline<'a> {
    pub(crate) fn new(shape: &Shape2, core: &'a Core2<'a>, turn: Turn, position: DVec2) -> Self {
        let extremes = match shape {
            Shape2::Polygon(polygon) if is_searched(shape) => Some(polygon.extremes()),
            _ => None,
        };
        let half = match shape {
            Shape2::Rect(rect) => Some(rect.half_extents().as_dvec2()),
            _ => None,
        };
        Self {
            vertices: core.vertices(),
            normals: core.normals(),
            extremes,
            half,
            turn,
            unit: turn.unit(),
            position,
            radius: f64::from(shape.radius()),
        }
    }

    /// The same with vertices placed, for a core of at most N vertices.
    #[inline]
    pub(super) fn few<const N: usize>(&self) -> Few<N> {
        Few::new((self.vertices, self.normals), &self.turn, self.position, self.radius)
    }

    /// Whether it has no interior: a point or a segment.
    #[inline]
    pub(crate) fn is_flat(&self) -> bool {
        self.vertices.len() <= 2
    }

    /// A vertex in the frame of the pair.
    #[inline]
    pub(crate) fn point(&self, vertex: usize) -> DVec2 {
        self.position + self.turn.turn(self.vertices[vertex].as_dvec2())
    }

    /// The vertex after this one, counter-clockwise.
    #[inline]
    pub(crate) fn after(&self, vertex: usize) -> usize {
        if vertex + 1 == self.vertices.len() { 0 } else { vertex + 1 }
    }

    /// The vertex before this one.
    #[inline]
    pub(crate) fn before(&self, vertex: usize) -> usize {
        if vertex == 0 { self.vertices.len() - 1 } else { vertex - 1 }
    }

    /// The vertex `edges` edges after this one, at most once around.
    #[inline]
    pub(super) fn ahead(&self, vertex: usize, edges: usize) -> usize {
        let ahead = vertex + edges;
        if ahead >= self.vertices.len() { ahead - self.vertices.len() } else { ahead }
    }

    /// How many edges lead from one vertex to another, counter-clockwise: less than all.
    #[inline]
    pub(super) fn edges_between(&self, from: usize, to: usize) -> usize {
        if to >= from { to - from } else { to + self.vertices.len() - from }
    }

    /// Outward unit normal of an edge, in the frame of the pair.
    #[inline]
    pub(crate) fn normal(&self, edge: usize) -> DVec2 {
        renormalized(self.outward(edge))
    }

    /// Outward normal of an edge, of unit length up to 7 roundings.
    #[inline]
    pub(crate) fn outward(&self, edge: usize) -> DVec2 {
        self.turn.turn(self.normals[edge]) * self.unit
    }

    /// Number of edges: none of a point, two of a segment.
    #[inline]
    pub(crate) fn edge_count(&self) -> usize {
        self.normals.len()
    }

    /// The vertex furthest along a direction; of few vertices that tie, the lowest index. Cost: linear in the vertices
    /// where they are few, else the logarithm of their number.
    #[inline]
    pub(crate) fn support(&self, direction: DVec2) -> Support {
        self.support_near(direction, None)
    }

    /// The same, starting from a vertex that may be the furthest or next to it: then two edges decide. Among vertices
    /// that tie up to rounding, it may return another.
    #[inline]
    pub(crate) fn support_near(&self, direction: DVec2, near: Option<usize>) -> Support {
        let local = self.turn.turn_back(direction);
        let vertex = self.furthest_local(local, near);
        Support { vertex, reach: local.dot(self.vertices[vertex].as_dvec2()) + direction.dot(self.position) }
    }

    /// That vertex alone.
    #[inline]
    pub(super) fn furthest_near(&self, direction: DVec2, near: Option<usize>) -> usize {
        self.furthest_local(self.turn.turn_back(direction), near)
    }

    #[inline]
    fn furthest_local(&self, local: DVec2, near: Option<usize>) -> usize {
        match &self.extremes {
            None if self.half.is_some() => corner_along(local),
            None => self.furthest(local),
            Some(extremes) => {
                // Edges from one extreme vertex to the next face into one quadrant, in order of their angles.
                let (from, to) = match (local.x < 0.0, local.y < 0.0) {
                    (false, false) => (extremes[0], extremes[1]),
                    (true, false) => (extremes[1], extremes[2]),
                    (true, true) => (extremes[2], extremes[3]),
                    (false, true) => (extremes[3], extremes[0]),
                };
                self.climb_near(from, self.edges_between(from, to), local, near)
            }
        }
    }

    /// As [`climb_local`](Self::climb_local), but starts from `near` if that is one of those vertices.
    #[inline]
    fn climb_near(&self, from: usize, edges: usize, local: DVec2, near: Option<usize>) -> usize {
        // How many of the edges come before it.
        let Some(before) = near.map(|near| self.edges_between(from, near)).filter(|&before| before <= edges)
        else {
            return self.climb_local(from, edges, local);
        };
        if before > 0 && !self.ascends(self.ahead(from, before - 1), local) {
            return self.climb_local(from, before - 1, local);
        }
        if before < edges && self.ascends(self.ahead(from, before), local) {
            return self.climb_local(self.ahead(from, before + 1), edges - before - 1, local);
        }
        self.ahead(from, before)
    }

    /// Whether the edge that starts at a vertex leads along a direction.
    #[inline]
    fn ascends(&self, start: usize, local: DVec2) -> bool {
        count_step();
        let along = self.vertices[self.after(start)].as_dvec2() - self.vertices[start].as_dvec2();
        local.dot(along) > 0.0
    }

    fn furthest(&self, local: DVec2) -> usize {
        let (mut best, mut reach) = (0, f64::NEG_INFINITY);
        for (vertex, point) in self.vertices.iter().enumerate() {
            let next = local.dot(point.as_dvec2());
            if next > reach {
                (best, reach) = (vertex, next);
            }
        }
        best
    }

    /// The vertex furthest along a direction, among those from `from` on up to `edges` edges later. Those edges turn by
    /// less than half a circle, and the direction lies between the first one's normal and the last one's.
    ///
    /// So edges first ascend and then descend, and the last that ascends is found by halving. An edge e for which the
    /// sign of d.e is lost to rounding has |d.e| <= 2 u |d| |e|: where d.e vanishes, both products are at most |d| |e|
    /// / 2, and their sum is rounded by next to nothing; the difference of two f32 is off by u at most. All such edges
    /// are neighbours, nearly on one line, and together no longer than the polygon, 2 R. So whichever of them the
    /// search ends at, it falls short of the furthest vertex by at most 4 u R: [`OF_SEARCH`].
    #[inline]
    pub(super) fn climb(&self, from: usize, edges: usize, direction: DVec2) -> usize {
        self.climb_local(from, edges, self.turn.turn_back(direction))
    }

    fn climb_local(&self, from: usize, edges: usize, local: DVec2) -> usize {
        let (mut ascending, mut unknown) = (0, edges);
        while unknown > 0 {
            let half = unknown / 2;
            if self.ascends(self.ahead(from, ascending + half), local) {
                (ascending, unknown) = (ascending + half + 1, unknown - half - 1);
            } else {
                unknown = half;
            }
        }
        self.ahead(from, ascending)
    }
}
