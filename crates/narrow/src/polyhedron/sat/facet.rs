//! A proof, in some thirty products, that an axis is the best of all, without evaluating any other.
//!
//! The penetration depth of two solids is the distance of the origin from the surface of their difference M = A - B.
//! The axis of a face or of two edges is the best one exactly when the facet of M that it belongs to is the nearest.
//!
//! ```text
//! T      the facet, at depth d: a face of A less B's deepest vertex, edge or face; a face of B likewise; or the
//!        parallelogram of two edges
//! disc   about the foot of the origin on T, of radius p: in a direction at angle t to the axis, M reaches at least
//!        d cos t + p sin t, which is d or more as long as tan (t / 2) <= p / d
//! ball   about the difference D of the centres, of radius r = the sum of both inner radii: M reaches at least D.n + r
//!        along n
//! proof  the ball reaches d in every direction in which the disc does not
//! ```
//! Then the ball of radius d about the origin lies inside M, and touches its surface at the foot. Nearly all pairs
//! whose depth is small next to their faces, which is most pairs, are proved this way; where last frame's axis is still
//! the best, no other axis is ever evaluated. The idea is that of an expanding polytope's last step (van den Bergen,
//! "Proximity queries and penetration depth computation on 3D game objects", GDC 2001), with a polytope that needs no
//! expanding. Where the ball does not suffice, single vertices of M may (`cover`).
//!
//! Between solids that stand upright side by side, whole edges are furthest (`level`). In long, thin solids the ball in
//! the middle covers little. Tried: others beside it, along an arm that was kept with each hull, which made a frame of a
//! crowd faster before there was `cover`. Since then it takes as many instructions without them, and long rods and
//! planks that slide on each other 1 to 4 % more (callgrind, 2026-11-29).

use super::super::solid::Solid;
use super::cover::{Cover, Facet, cover};
use super::level::Level;
use super::{Axis, AxisOf};
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// What is known of an axis along which two solids overlap.
pub(super) enum Near {
    /// It is the best one; besides its own rounding, it may show too little by this much.
    Nearest(f64),
    /// Along this unit direction they overlap less deeply, or too close to call.
    Beaten(DVec3),
    Open,
}

/// Whether an axis along which two solids overlap is the best there is.
///
/// `deepest` is the other solid's deepest vertex against a face; for edges it means nothing.
pub(super) fn judge((a, b): (&Solid, &Solid), axis: &Axis, deepest: usize, precision: &Precision) -> Near {
    let doubt = precision.doubt_of_depth();
    let depth = -axis.separation;
    // A depth within rounding has no direction.
    if depth <= doubt {
        return Near::Open;
    }
    let mut level = Level::NONE;
    let mut over = |face, outward: DVec3, (other, deepest): (&Solid, usize)| {
        level = Level::around(other, deepest, outward, precision.projection());
        if level.is_empty() {
            return in_face(face, outward, other.point(deepest));
        }
        level.in_difference(face, outward, other)
    };
    let disc = match axis.of {
        AxisOf::FaceA(face) => over((a, face), axis.normal, (b, deepest)),
        AxisOf::FaceB(face) => over((b, face), -axis.normal, (a, deepest)),
        AxisOf::Edges(edge_a, edge_b) => {
            let edges @ [(from_a, to_a), (from_b, to_b)] = [a.edge(edge_a), b.edge(edge_b)];
            let along = |point: DVec3| axis.normal.dot(point);
            let lowest = along(from_a).min(along(to_a)) - along(from_b).max(along(to_b));
            // Edges that are named by a stale hint need not lie on the supporting planes; and the axis of edges at a
            // small angle is so far off that not all four corners lie in one plane perpendicular to it.
            let is_facet = lowest >= depth - 0.5 * doubt;
            if is_facet { in_parallelogram(edges, axis.normal) } else { f64::NEG_INFINITY }
        }
    };
    let is_behind = disc > doubt;
    if !is_behind {
        return Near::Open;
    }
    let uneven = if level.is_empty() { 0.0 } else { precision.projection() };
    if does_ball_cover(a, b, axis.normal, (depth + doubt, disc - doubt)) {
        return Near::Nearest(uneven);
    }
    let Some(facet) = Facet::new((a, b), axis.of, (deepest, &level)) else { return Near::Open };
    match cover((a, b), (axis.normal, &facet), (depth, doubt)) {
        Cover::Whole => Near::Nearest(uneven),
        Cover::Torn(direction) => Near::Beaten(direction),
        Cover::Unknown => Near::Open,
    }
}

/// How far a point is inside a face, as seen along its outward normal; below zero where it is not.
pub(super) fn in_face((solid, face): (&Solid, usize), outward: DVec3, point: DVec3) -> f64 {
    in_polygon(solid.topology.face_vertices(face).map(|vertex| solid.point(vertex)), outward, point)
}

/// How far a point is inside a convex polygon, as seen along its outward normal; below zero where it is not.
#[inline(always)]
pub(crate) fn in_polygon(mut corners: impl Iterator<Item = DVec3>, outward: DVec3, point: DVec3) -> f64 {
    let mut least = f64::INFINITY;
    let Some(first) = corners.next() else { return f64::NEG_INFINITY };
    let mut from = first;
    for to in corners.chain(core::iter::once(first)) {
        let inwards = outward.cross(to - from);
        let inside = inwards.dot(point - from);
        let scale = 1.0 / inwards.length_squared();
        // Squared, to keep roots out of the loop. NaN proves nothing.
        if !(inside > 0.0 && scale.is_finite()) {
            return f64::NEG_INFINITY;
        }
        least = least.min(inside * inside * scale);
        from = to;
    }
    least.sqrt()
}

/// How far the origin is inside the difference of two edges, as seen along the normal of both.
fn in_parallelogram([(from_a, to_a), (from_b, to_b)]: [(DVec3, DVec3); 2], normal: DVec3) -> f64 {
    let between = from_a - from_b;
    let (along_a, along_b) = (to_a - from_a, to_b - from_b);
    let strip = |side: DVec3, other: DVec3| {
        // From one side of the strip to the other, both of which are parallel to `side`.
        let across = normal.cross(side);
        let (near, far) = (across.dot(between), across.dot(between + other));
        let inside = if near < far { (-near).min(far) } else { (-far).min(near) };
        inside / across.length()
    };
    let (one, other) = (strip(along_a, -along_b), strip(along_b, along_a));
    if one < other { one } else { other }
}

/// Whether the ball about the difference of the solids' centres reaches `depth` in every direction in which a disc of
/// radius `disc` does not.
fn does_ball_cover(a: &Solid, b: &Solid, normal: DVec3, (depth, disc): (f64, f64)) -> bool {
    let (center, radius) = (a.center() - b.center(), a.inner_radius + b.inner_radius);
    let spare = radius - depth;
    let along = center.dot(normal);
    let square = center.length_squared();
    if spare >= 0.0 && spare * spare >= square {
        return true;
    }
    // Not the root of a difference of squares: for a centre straight behind the facet that difference is rounding, and
    // its root far more.
    let across = (center - normal * along).length();
    // The angle up to which the disc reaches the depth, by the tangent of its half.
    let tangent = disc / depth;
    let scale = 1.0 / (1.0 + tangent * tangent);
    let (sine, cosine) = (2.0 * tangent * scale, (1.0 - tangent * tangent) * scale);
    // Beyond that angle the ball's reach only grows, if the direction is past the opposite of its centre.
    let is_past = sine * along + cosine * across <= 0.0;
    is_past && along * cosine - across * sine + spare >= 0.0
}
