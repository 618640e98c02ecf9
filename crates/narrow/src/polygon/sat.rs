//! Axes that may separate two convex polygons: what they are, how one is evaluated, and which kernel finds the best.
//!
//! ```text
//! two polygons have their separation, positive or negative, along a normal of an edge of either
//! two rectangles:      four axes in closed form               (rects)
//! few edges:           all of them, side by side              (few)
//! many edges:          a search over directions               (search)
//! ```
//! Gottschalk, "Separating axis theorem" (1996). Whatever proposes an axis, it is trusted only after both shapes were
//! projected on it, by [`axis`]. That is the definition of an axis' separation; `plain` below is the definition of the
//! best axis, to test the kernels against.

use super::few;
use super::outline::{FEW_VERTICES, Outline};
use super::rects;
use super::search;
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::Precision;
use asunder_geometry::glam::DVec2;

/// The edge that an axis is normal to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AxisOf {
    EdgeA(usize),
    EdgeB(usize),
}

/// A unit axis from A to B, and the separation along it by full projection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) separation: f64,
    pub(crate) normal: DVec2,
    pub(crate) of: AxisOf,
}

/// The best axis of each shape, as far as it matters: if it is below the best of all by more than the band of the
/// question, it may be missing (a separation of -inf), or not be the best of its shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) edge_a: Axis,
    pub(crate) edge_b: Axis,
    /// The axis that the hint named, where it is within the band.
    pub(crate) kept: Option<Axis>,
    /// By how much any other axis may truly exceed the best one.
    pub(crate) short: f64,
}

impl Axes {
    /// No axis was tested: separation -inf.
    pub(super) const NONE: Self = Self {
        edge_a: Axis { separation: f64::NEG_INFINITY, normal: DVec2::X, of: AxisOf::EdgeA(0) },
        edge_b: Axis { separation: f64::NEG_INFINITY, normal: DVec2::X, of: AxisOf::EdgeB(0) },
        kept: None,
        short: 0.0,
    };

    /// The greater separation of the two. Ties: A's.
    #[inline]
    pub(crate) fn best(&self) -> &Axis {
        if self.edge_b.separation > self.edge_a.separation { &self.edge_b } else { &self.edge_a }
    }
}

/// What is asked about the best axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wanted<'a> {
    /// An axis that shows a greater separation settles the question.
    pub(crate) limit: f64,
    /// How far below the best axis another one still matters: at least the rounding of two projections.
    pub(crate) band: f64,
    /// What the last frame found. It is tried first; the result does not depend on it.
    pub(crate) hint: Hint,
    /// A's centre to B's, of any length.
    pub(crate) towards_b: DVec2,
    /// The pair's precision.
    pub(crate) precision: &'a Precision,
}

/// Outcome of a test: an axis that separates the shapes by more than the limit, or a gap within it that only the
/// nearest points can measure, or the best axes.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one pair")]
pub(crate) enum Outcome {
    Beyond(f64, Hint),
    Gap(f64, DVec2),
    Within(Axes),
}

/// Whether all edge normals show two shapes apart, or overlapping.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// One axis certainly separates them.
    Apart,
    /// Every axis shows more overlap than its error.
    Overlapping,
    /// Some axis is too close to call.
    Unclear,
}

/// Finds the best axes.
pub(crate) fn separating_axes(a: &Outline, b: &Outline, wanted: &Wanted) -> Outcome {
    let kept = named([a.edge_count(), b.edge_count()], wanted.hint);
    let edge = kept.and_then(Named::edge);
    if let (Some(half_a), Some(half_b)) = (a.half, b.half) {
        let (offset, turns) = (b.position - a.position, [&a.turn, &b.turn]);
        return match rects::best_axes([half_a, half_b], turns, offset, (edge, wanted)) {
            Ok(axes) => Outcome::Within(axes),
            Err((separation, of)) => Outcome::Beyond(separation, hint_of(of)),
        };
    }
    match a.vertices.len().max(b.vertices.len()) {
        0..=8 => few::separating_axes([&a.few::<8>(), &b.few()], edge, wanted),
        9..=FEW_VERTICES => few::separating_axes([&a.few::<FEW_VERTICES>(), &b.few()], edge, wanted),
        _ => search::separating_axes(a, b, kept, wanted),
    }
}

/// Whether the axes show the two shapes apart, or overlapping, by more than `doubt`.
pub(crate) fn sides(a: &Outline, b: &Outline, towards_b: DVec2, doubt: f64) -> Sides {
    match a.vertices.len().max(b.vertices.len()) {
        0..=8 => few::sides([&a.few::<8>(), &b.few()], doubt),
        9..=FEW_VERTICES => few::sides([&a.few::<FEW_VERTICES>(), &b.few()], doubt),
        _ => search::sides(a, b, towards_b, doubt),
    }
}

/// By how much the separation along an axis may be off before a full projection: two projections' rounding.
#[inline]
pub(crate) fn doubt(precision: &Precision) -> f64 {
    2.0 * precision.projection()
}

/// The normal of an edge, from A to B, with both shapes projected on it. `near` is a vertex of the other shape that may
/// be its support point, or next to it; on the edge's own shape that is the edge's start.
pub(super) fn axis(a: &Outline, b: &Outline, of: AxisOf, near: Option<usize>) -> Axis {
    let (normal, near_a, near_b) = match of {
        AxisOf::EdgeA(edge) => (a.normal(edge), Some(edge), near),
        AxisOf::EdgeB(edge) => (-b.normal(edge), near, Some(edge)),
    };
    let separation = -b.support_near(-normal, near_b).reach - a.support_near(normal, near_a).reach;
    Axis { separation, normal, of }
}

/// What a hint refers to: an edge that this pair has, or a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Named {
    Edge(AxisOf),
    Direction(DVec2),
}

impl Named {
    pub(super) fn edge(self) -> Option<AxisOf> {
        match self {
            Self::Edge(of) => Some(of),
            Self::Direction(_) => None,
        }
    }
}

/// What a hint refers to; `None` if a pair with so many edges each has no such edge.
#[inline]
pub(super) fn named(edges: [usize; 2], hint: Hint) -> Option<Named> {
    let Some(features) = hint.features() else {
        // A hint from space may be perpendicular to the plane.
        return hint.direction()?.truncate().try_normalize().map(Named::Direction);
    };
    match (features.a(), features.b()) {
        (Feature::Edge(edge), _) => {
            ((edge as usize) < edges[0]).then_some(Named::Edge(AxisOf::EdgeA(edge as usize)))
        }
        (_, Feature::Edge(edge)) => {
            ((edge as usize) < edges[1]).then_some(Named::Edge(AxisOf::EdgeB(edge as usize)))
        }
        _ => None,
    }
}

/// The hint that leads back to an axis.
pub(crate) fn hint_of(of: AxisOf) -> Hint {
    Hint::axis(match of {
        AxisOf::EdgeA(edge) => FeatureId::new(Feature::Edge(edge as u32), Feature::Vertex(0)),
        AxisOf::EdgeB(edge) => FeatureId::new(Feature::Vertex(0), Feature::Edge(edge as u32)),
    })
}

/// The hint that leads back to a direction, up to an f32 rounding of its coordinates.
pub(crate) fn hint_of_direction(direction: DVec2) -> Hint {
    Hint::towards(direction.extend(0.0))
}

/// The definition: the best axis of each shape, with every axis fully projected. Cost: the product of the vertex
/// counts, twice, or less by what a search saves.
#[cfg(test)]
pub(super) fn plain(a: &Outline, b: &Outline) -> Axes {
    let mut best = Axes::NONE;
    for edge in 0..a.edge_count() {
        let axis = axis(a, b, AxisOf::EdgeA(edge), None);
        if axis.separation > best.edge_a.separation {
            best.edge_a = axis;
        }
    }
    for edge in 0..b.edge_count() {
        let axis = axis(a, b, AxisOf::EdgeB(edge), None);
        if axis.separation > best.edge_b.separation {
            best.edge_b = axis;
        }
    }
    best
}
