//! One contact point, found where the supporting features of two shapes lie over each other.
//!
//! ```text
//! of each shape, project all vertices as far along the normal as the furthest, up to a slack, onto the plane across it
//! take the convex outline of each set: a point within it is in its shape, and no lower than the slack
//! over all pairs of their sides, find the nearest points: outlines that overlap have sides that cross
//! where none do, one outline may be within the other: then any corner of it is over the other
//! ```
//! Where an edge is split by a vertex in its middle, or faces are just not merged into one, several edges or faces
//! support an axis and rounding picks one of them. The other shape may be over another. Andrew, "Another efficient
//! algorithm for convex hulls in two dimensions" (1979).
//!
//! Cost: the product of both outlines' side counts. It runs only where a contact point turned out to lie beside the
//! shapes, which is rare.

use super::super::sat::Axis;
use super::super::solid::Solid;
use super::Point;
use super::frame::Frame;
use super::single::feature_of;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;

/// Share of the slack by which a pair of points must be nearer to replace another: smaller differences are rounding.
const NEARER: f64 = 1e-3;

/// Multiples of the slack that are tried in turn. The last is 1.3e-4 of the smaller shape.
const WIDER: [f64; 3] = [1.0, 16.0, 256.0];

/// A contact point of the cores on an axis, and how far its two ends are apart across the axis: no more than the slack,
/// or if nothing lies over each other within that, no more than the first of its multiples that finds something.
///
/// The multiples are needed since corners of a merged face may lie further from its plane than the slack of a much
/// smaller shape.
#[cold]
#[inline(never)]
pub(super) fn point_over(a: &Solid, b: &Solid, axis: &Axis, slack: f64) -> Option<(Point, f64)> {
    let slacks = WIDER.map(|wider| wider * slack);
    slacks.into_iter().find_map(|slack| point_within(a, b, axis, slack))
}

fn point_within(a: &Solid, b: &Solid, axis: &Axis, slack: f64) -> Option<(Point, f64)> {
    let frame = Frame::level(axis.normal, DVec3::ZERO);
    let (of_a, of_b) =
        (Outline::of(a, axis.normal, &frame, slack), Outline::of(b, -axis.normal, &frame, slack));
    let best = nearest(&of_a, &of_b, slack)?;
    let half = axis.normal * (0.5 * axis.separation);
    let point = |middle: DVec3, of_a: Feature, of_b: Feature| {
        let feature = FeatureId::new(of_a, of_b);
        Point { separation: axis.separation, on_a: middle - half, on_b: middle + half, feature }
    };
    if best.aside > NEARER * slack {
        let [corner_a, corner_b] = best.sides.map(|[corner, _]| corner);
        if of_b.has(corner_a.at) {
            let middle = a.point(corner_a.vertex) + half;
            return Some((point(middle, corner_a.feature(), of_b.feature(b)), 0.0));
        }
        if of_a.has(corner_b.at) {
            let middle = b.point(corner_b.vertex) - half;
            return Some((point(middle, of_a.feature(a), corner_b.feature()), 0.0));
        }
    }
    let middle = (best.on(a, 0) + best.on(b, 1)) * 0.5;
    (best.aside <= slack).then(|| (point(middle, best.feature(a, 0), best.feature(b, 1)), best.aside))
}

/// The first pair of sides that cross, or else the nearest pair.
fn nearest(a: &Outline, b: &Outline, slack: f64) -> Option<Near> {
    let mut best: Option<Near> = None;
    for side_a in a.sides() {
        for side_b in b.sides() {
            let near = Near::of(side_a, side_b);
            if near.aside <= NEARER * slack {
                return Some(near);
            }
            if best.as_ref().is_none_or(|best| near.aside < best.aside - NEARER * slack) {
                best = Some(near);
            }
        }
    }
    best
}

/// A vertex as projected along the axis.
#[derive(Clone, Copy)]
struct Projected {
    at: [f64; 2],
    vertex: usize,
}

impl Projected {
    fn feature(&self) -> Feature {
        Feature::Vertex(self.vertex as u32)
    }
}

/// The convex outline of a shape's furthest vertices, counterclockwise.
struct Outline {
    corners: ArrayVec<Projected, MAX_HULL_VERTICES>,
}

impl Outline {
    fn of(solid: &Solid, direction: DVec3, frame: &Frame, slack: f64) -> Self {
        let least = solid.support(direction).reach - slack;
        let far = |&vertex: &usize| direction.dot(solid.point(vertex)) >= least;
        let mut all: ArrayVec<Projected, MAX_HULL_VERTICES> = ArrayVec::new();
        for vertex in (0..solid.vertices.len()).filter(far) {
            let _ = all.try_push(Projected { at: frame.shift(solid.point(vertex)), vertex });
        }
        all.sort_unstable_by(|one, other| {
            let by_place = one.at[0].total_cmp(&other.at[0]).then(one.at[1].total_cmp(&other.at[1]));
            by_place.then(one.vertex.cmp(&other.vertex))
        });
        let mut corners = ArrayVec::new();
        add_chain(all.iter(), &mut corners);
        add_chain(all.iter().rev(), &mut corners);
        if corners.is_empty() {
            corners.extend(all.first().copied());
        }
        Self { corners }
    }

    /// Each corner with the next; a single corner with itself.
    fn sides(&self) -> impl Iterator<Item = [Projected; 2]> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&from, &to)| [from, to])
    }

    fn has(&self, at: [f64; 2]) -> bool {
        self.corners.len() > 2 && self.sides().all(|[from, to]| turn(from.at, to.at, at) >= 0.0)
    }

    fn feature(&self, solid: &Solid) -> Feature {
        let vertices: ArrayVec<usize, MAX_HULL_VERTICES> =
            self.corners.iter().map(|corner| corner.vertex).collect();
        feature_of(solid, &vertices)
    }
}

/// Adds the half of an outline to the right of the line from the first of the sorted corners to the last. The last
/// corner itself is left to the other half.
fn add_chain<'a>(
    sorted: impl Iterator<Item = &'a Projected>,
    corners: &mut ArrayVec<Projected, MAX_HULL_VERTICES>,
) {
    let start = corners.len();
    let mut last: Option<Projected> = None;
    for &next in sorted {
        if let Some(last) = last {
            let _ = corners.try_push(last);
        }
        while let [.., one, other] = corners[start..]
            && turn(one.at, other.at, next.at) <= 0.0
        {
            corners.pop();
        }
        last = Some(next);
    }
}

/// Twice the signed area of a triangle; positive if it turns left.
fn turn(from: [f64; 2], to: [f64; 2], at: [f64; 2]) -> f64 {
    cross(less(to, from), less(at, from))
}

fn cross(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[1] - one[1] * other[0]
}

fn dot(one: [f64; 2], other: [f64; 2]) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

fn less(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [one[0] - other[0], one[1] - other[1]]
}

/// The nearest points of two sides.
struct Near {
    aside: f64,
    sides: [[Projected; 2]; 2],
    /// The nearest point of each side, from 0 at its start to 1 at its end.
    shares: [f64; 2],
}

impl Near {
    fn of(side_a: [Projected; 2], side_b: [Projected; 2]) -> Self {
        let [[a0, a1], [b0, b1]] = [side_a, side_b].map(|side| side.map(|corner| corner.at));
        let (along_a, along_b, between) = (less(a1, a0), less(b1, b0), less(b0, a0));
        let foot = |at: [f64; 2], from: [f64; 2], along: [f64; 2]| {
            (dot(less(at, from), along) / dot(along, along)).clamp(0.0, 1.0)
        };
        let inverse = 1.0 / cross(along_a, along_b);
        let crossing = [cross(between, along_b) * inverse, cross(between, along_a) * inverse];
        let shares = [
            crossing.map(|share| share.clamp(0.0, 1.0)),
            [0.0, foot(a0, b0, along_b)],
            [1.0, foot(a1, b0, along_b)],
            [foot(b0, a0, along_a), 0.0],
            [foot(b1, a0, along_a), 1.0],
        ];
        let mut best = Self { aside: f64::INFINITY, sides: [side_a, side_b], shares: [0.0; 2] };
        // Parallel sides have no crossing, and a side of one corner has no foot on it: those shares are NaN.
        for shares in shares.map(|pair| pair.map(|share| if share.is_nan() { 0.0 } else { share })) {
            let [s, t] = shares;
            let apart = |i: usize| between[i] + along_b[i] * t - along_a[i] * s;
            let (x, y) = (apart(0), apart(1));
            let aside = (x * x + y * y).sqrt();
            if aside < best.aside {
                (best.aside, best.shares) = (aside, shares);
            }
        }
        best
    }

    fn on(&self, solid: &Solid, which: usize) -> DVec3 {
        let [from, to] = self.sides[which].map(|corner| solid.point(corner.vertex));
        from + (to - from) * self.shares[which]
    }

    fn feature(&self, solid: &Solid, which: usize) -> Feature {
        let [from, to] = self.sides[which];
        match self.shares[which] {
            0.0 => from.feature(),
            1.0 => to.feature(),
            _ => feature_of(solid, &[from.vertex, to.vertex]),
        }
    }
}
