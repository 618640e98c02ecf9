//! A proof by single vertices of the difference that no direction is better than an axis, for pairs where the ball in
//! the middle does not suffice.
//!
//! The facet T, at depth d along the axis n, is part of M = A - B, and so is each vertex of A minus each vertex of B.
//! The axis is the best one if M reaches at least d in every direction.
//!
//! ```text
//! plane    the sphere of directions, projected stereographically: a direction at angle t to n becomes a point x at
//!          1 / tan (t / 2) from the middle; n itself is at infinity
//! outline  a corner q of T, as seen along n, reaches d where q.x >= d; what no corner reaches is a convex polygon
//!          about x = 0
//! disc     a point m of M reaches d inside a disc:  (d - m.n) |x|^2 - 2 m.x + (d + m.n) <= 0;  a ball of radius r
//!          likewise, with d - r in place of d
//! cover    each piece of the polygon has a disc. Where a corner of the piece lies outside it, take the vertex of M
//!          that is furthest in that direction. If its disc holds the corner, cut the piece in two, by which of both
//!          discs does better. If not, M does not reach d there, and that direction beats the axis
//! ```
//! A disc that holds all corners of a convex piece holds the piece. All of it is products. Of airborne pairs whose ball
//! does not suffice, a sixth need no vertex and three quarters one or two. It takes 1,500 instructions, a seventh of
//! what the test of all axes takes (hulls of 8 to 32 vertices, counted by callgrind, 2026-11-24).
//!
//! The polygon is what an expanding polytope would still have to cover, laid out flat (van den Bergen, "Proximity
//! queries and penetration depth computation on 3D game objects", GDC 2001). The stereographic projection turns each
//! point's bound on the sphere of directions into a disc.

use super::super::solid::Solid;
use super::AxisOf;
use super::level::Level;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec2, DVec3};

/// Most corners of a facet or of a piece: for larger ones nothing is proved.
const MOST_CORNERS: usize = 16;

/// Most pieces that wait to be covered.
const MOST_PIECES: usize = 8;

/// Most vertices of the difference that are searched for. Two are enough in nine of ten cases.
const MOST_VERTICES: usize = 6;

/// Most pieces that are examined.
const MOST_STEPS: usize = 32;

/// The largest relative widening of the outline for rounding that is still accepted.
const MOST_GROWTH: f64 = 1e-3;

/// What the cover has proved.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cover {
    /// No direction beats the axis.
    Whole,
    /// This unit direction beats it, or is too close to call.
    Torn(DVec3),
    /// Nothing was proved.
    Unknown,
}

type Corners = ArrayVec<DVec2, MOST_CORNERS>;

/// The features of both solids whose difference is the facet, by their vertices: a face with a vertex, an edge or a
/// face; or two edges.
pub(super) struct Facet {
    of_a: ArrayVec<usize, MOST_CORNERS>,
    of_b: ArrayVec<usize, MOST_CORNERS>,
}

impl Facet {
    /// For a face, `deepest` is the other solid's deepest vertex and `level` what is equally deep. `None` for a face of
    /// too many corners.
    pub(super) fn new(
        (a, b): (&Solid, &Solid),
        of: AxisOf,
        (deepest, level): (usize, &Level),
    ) -> Option<Self> {
        let other = || {
            if level.is_empty() { all([deepest].into_iter()) } else { all(level.vertices().iter().copied()) }
        };
        let edge = |solid: &Solid, edge: usize| {
            let (from, to) = solid.topology.ends(edge);
            all([from, to].into_iter())
        };
        let (of_a, of_b) = match of {
            AxisOf::FaceA(face) => (all(a.topology.face_vertices(face))?, other()?),
            AxisOf::FaceB(face) => (other()?, all(b.topology.face_vertices(face))?),
            AxisOf::Edges(edge_a, edge_b) => (edge(a, edge_a)?, edge(b, edge_b)?),
        };
        Some(Self { of_a, of_b })
    }
}

/// All of the vertices, or `None` where they are too many.
fn all(mut vertices: impl Iterator<Item = usize>) -> Option<ArrayVec<usize, MOST_CORNERS>> {
    let mut list = ArrayVec::new_const();
    vertices.try_for_each(|vertex| list.try_push(vertex)).ok()?;
    Some(list)
}

/// The directions, laid out flat.
struct Plane {
    normal: DVec3,
    axes: [DVec3; 2],
    /// The depth that must be reached, in metres.
    depth: f64,
}

/// The directions in which a point or ball of the difference reaches the depth: |x|^2 - 2 c.x + k <= 0.
#[derive(Clone, Copy)]
struct Disc {
    center: DVec2,
    constant: f64,
}

/// A piece of the polygon, and the disc that is to cover it.
struct Piece {
    corners: Corners,
    disc: Disc,
}

/// Whether the difference reaches `depth` along every unit direction, given that `facet` lies at that depth across
/// `normal`.
pub(super) fn cover(
    (a, b): (&Solid, &Solid),
    (normal, facet): (DVec3, &Facet),
    (depth, doubt): (f64, f64),
) -> Cover {
    let (x, y) = normal.any_orthonormal_pair();
    let plane = Plane { normal, axes: [x, y], depth: depth + doubt };
    let Some(corners) = plane.outline((a, b), facet, (depth, doubt)) else { return Cover::Unknown };
    // Where a centre is not inside its solid, the radius is negative, by at least its distance from it.
    let ball = plane.disc(a.center() - b.center(), a.inner_radius + b.inner_radius);
    let Some(disc) = ball else { return Cover::Unknown };
    let mut left = ArrayVec::<Piece, MOST_PIECES>::new();
    left.push(Piece { corners, disc });
    let mut discs = ArrayVec::<Disc, MOST_VERTICES>::new();
    for _ in 0..MOST_STEPS {
        let Some(piece) = left.last() else { return Cover::Whole };
        let Some(out) = piece.furthest_out() else {
            left.pop();
            continue;
        };
        let known = discs.iter().find(|disc| disc.holds(out)).copied();
        let Some(disc) = known.or_else(|| plane.disc(plane.furthest((a, b), out), 0.0)) else {
            return Cover::Unknown;
        };
        if !disc.holds(out) {
            return Cover::Torn(plane.direction(out));
        }
        if known.is_none() && discs.try_push(disc).is_err() || cut_last(&mut left, disc).is_none() {
            return Cover::Unknown;
        }
    }
    Cover::Unknown
}

impl Plane {
    fn flat(&self, point: DVec3) -> DVec2 {
        DVec2::new(self.axes[0].dot(point), self.axes[1].dot(point))
    }

    fn direction(&self, at: DVec2) -> DVec3 {
        let square = at.length_squared();
        let (up, aside) = ((square - 1.0) / (square + 1.0), 2.0 / (square + 1.0));
        self.normal * up + (self.axes[0] * at.x + self.axes[1] * at.y) * aside
    }

    /// `None` for what reaches the depth along the normal itself, which no point should.
    fn disc(&self, center: DVec3, radius: f64) -> Option<Disc> {
        let (up, short) = (self.normal.dot(center), self.depth - radius);
        let scale = 1.0 / (short - up);
        let is_short = scale > 0.0 && scale.is_finite();
        is_short.then(|| Disc { center: self.flat(center) * scale, constant: (short + up) * scale })
    }

    /// A support vertex of the difference, up to the rounding of f32: if it falls short for that reason, only the proof
    /// is lost.
    fn furthest(&self, (a, b): (&Solid, &Solid), at: DVec2) -> DVec3 {
        let direction = self.direction(at);
        let (of_a, of_b) = (a.rough_support(direction).0, b.rough_support(-direction).0);
        a.point(of_a.vertex) - b.point(of_b.vertex)
    }

    /// The directions in which no corner of the facet reaches its depth, widened by how far rounding may have moved the
    /// corners.
    fn outline(
        &self,
        (a, b): (&Solid, &Solid),
        facet: &Facet,
        (depth, doubt): (f64, f64),
    ) -> Option<Corners> {
        let sum = self.difference((a, b), facet)?;
        let (mut outline, mut furthest) = (Corners::new(), 0.0_f64);
        let mut from = *sum.last()?;
        for &to in &sum {
            let area = from.perp_dot(to);
            // Without the origin straight behind the facet there is no proof.
            let is_around = area > 0.0;
            if !is_around {
                return None;
            }
            let at = (to - from).perp() * (-depth / area);
            furthest = furthest.max(at.length_squared());
            outline.push(at);
            from = to;
        }
        let growth = doubt * furthest.sqrt() / depth;
        // NaN is not small.
        let is_small = growth < MOST_GROWTH;
        for at in &mut outline {
            *at *= 1.0 + 2.0 * growth;
        }
        is_small.then_some(outline)
    }

    /// The facet's corners as seen against the normal, counter-clockwise: the sides of both features, merged by their
    /// angles.
    fn difference(&self, (a, b): (&Solid, &Solid), facet: &Facet) -> Option<Corners> {
        let (mut of_a, mut of_b) = (Corners::new_const(), Corners::new_const());
        of_a.extend(facet.of_a.iter().map(|&vertex| self.flat(a.point(vertex))));
        of_b.extend(facet.of_b.iter().map(|&vertex| -self.flat(b.point(vertex))));
        from_lowest(&mut of_a);
        from_lowest(&mut of_b);
        let (mut i, mut j, mut sum) = (0, 0, Corners::new());
        let side = |list: &Corners, i: usize| list[(i + 1) % list.len()] - list[i % list.len()];
        let sides = |list: &Corners| if list.len() > 1 { list.len() } else { 0 };
        while i < sides(&of_a) || j < sides(&of_b) {
            sum.try_push(of_a[i % of_a.len()] + of_b[j % of_b.len()]).ok()?;
            let is_of_a = j == sides(&of_b) || i < sides(&of_a) && is_first([side(&of_a, i), side(&of_b, j)]);
            if is_of_a { i += 1 } else { j += 1 }
        }
        Some(sum)
    }
}

/// Whether the first of two directions has the smaller angle, from zero to a full turn, or both have the same.
fn is_first([one, other]: [DVec2; 2]) -> bool {
    // The cross product cannot order opposite directions.
    let is_down = |way: DVec2| way.y < 0.0 || way.y == 0.0 && way.x < 0.0;
    match (is_down(one), is_down(other)) {
        (false, true) => true,
        (true, false) => false,
        _ => one.perp_dot(other) >= 0.0,
    }
}

/// Orders the corners of a convex polygon counter-clockwise, starting from the lowest.
fn from_lowest(list: &mut Corners) {
    let area: f64 = (2..list.len()).map(|i| (list[i - 1] - list[0]).perp_dot(list[i] - list[0])).sum();
    if area < 0.0 {
        list.reverse();
    }
    let mut lowest = 0;
    for (i, corner) in list.iter().enumerate() {
        if (corner.y, corner.x) < (list[lowest].y, list[lowest].x) {
            lowest = i;
        }
    }
    list.rotate_left(lowest);
}

impl Disc {
    /// At or below zero inside.
    #[inline(always)]
    fn power(&self, at: DVec2) -> f64 {
        at.length_squared() - 2.0 * self.center.dot(at) + self.constant
    }

    #[inline(always)]
    fn holds(&self, at: DVec2) -> bool {
        self.power(at) <= 0.0
    }
}

impl Piece {
    /// The corner that is furthest outside the disc, if any is outside.
    #[inline(always)]
    fn furthest_out(&self) -> Option<DVec2> {
        let mut most = (0.0, None);
        for &at in &self.corners {
            let power = self.disc.power(at);
            // NaN counts as outside.
            let is_no_further = power <= most.0;
            if !is_no_further {
                most = (power, Some(at));
            }
        }
        most.1
    }
}

/// Cuts the last piece in two: the part that another disc covers better, and the rest.
///
/// Sutherland and Hodgman, "Reentrant polygon clipping" (1974), keeping both sides at once.
fn cut_last(pieces: &mut ArrayVec<Piece, MOST_PIECES>, disc: Disc) -> Option<()> {
    let piece = pieces.last_mut()?;
    let (own, whole) = (piece.disc, core::mem::take(&mut piece.corners));
    let mut better = Corners::new();
    // Zero on the line where both discs have the same power. With NaN everything is left to the piece's own disc, which
    // does not hold it.
    let side = |at: DVec2| 2.0 * (disc.center - own.center).dot(at) + (own.constant - disc.constant);
    let mut before = *whole.last()?;
    let mut was = side(before);
    for &corner in &whole {
        let is = side(corner);
        if (is > 0.0) != (was > 0.0) {
            let cut = before + (corner - before) * (was / (was - is));
            piece.corners.try_push(cut).ok()?;
            better.try_push(cut).ok()?;
        }
        if is > 0.0 { &mut better } else { &mut piece.corners }.try_push(corner).ok()?;
        (before, was) = (corner, is);
    }
    if piece.corners.is_empty() {
        pieces.pop();
    }
    if better.is_empty() {
        return Some(());
    }
    pieces.try_push(Piece { corners: better, disc }).ok()
}
