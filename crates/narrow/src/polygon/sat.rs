//! The separating axis test for two convex polygons.
//!
//! ```text
//! for each edge of A, of B: axis = its normal
//! the separation along an axis = min over B - max over A, projecting *every* vertex
//! one axis beyond the limit settles it; else the greatest separation wins
//! ```
//! Gottschalk, "Separating axis theorem" (1996). Cost: the product of the vertex counts, twice.

use super::outline::Outline;
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::Precision;
use asunder_geometry::glam::DVec2;

/// What an axis is the normal of.
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

/// The best axis of each shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) edge_a: Axis,
    pub(crate) edge_b: Axis,
}

impl Axes {
    /// No axis was looked at: separation -inf.
    const NONE: Self = Self {
        edge_a: Axis { separation: f64::NEG_INFINITY, normal: DVec2::X, of: AxisOf::EdgeA(0) },
        edge_b: Axis { separation: f64::NEG_INFINITY, normal: DVec2::X, of: AxisOf::EdgeB(0) },
    };

    /// The greater separation of the two. Ties: A's.
    pub(crate) fn best(&self) -> &Axis {
        if self.edge_b.separation > self.edge_a.separation { &self.edge_b } else { &self.edge_a }
    }
}

/// Outcome of the test: one axis that parts the shapes by more than the limit, or the best of each shape.
pub(crate) enum Outcome {
    Beyond(Axis),
    Within(Axes),
}

/// Runs the test; `hint` is tried first. The outcome within the limit does not depend on the hint.
pub(crate) fn separating_axes(a: &Outline, b: &Outline, limit: f64, hint: Hint) -> Outcome {
    if let Some(axis) = hinted_axis(a, b, hint)
        && axis.separation > limit
    {
        return Outcome::Beyond(axis);
    }
    let mut best = Axes::NONE;
    for edge in 0..a.edge_count() {
        let axis = axis_a(a, b, edge);
        if axis.separation > limit {
            return Outcome::Beyond(axis);
        }
        if axis.separation > best.edge_a.separation {
            best.edge_a = axis;
        }
    }
    for edge in 0..b.edge_count() {
        let axis = axis_b(a, b, edge);
        if axis.separation > limit {
            return Outcome::Beyond(axis);
        }
        if axis.separation > best.edge_b.separation {
            best.edge_b = axis;
        }
    }
    Outcome::Within(best)
}

/// Which side of touching all edge normals put two shapes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sides {
    /// One axis parts them for certain.
    Apart,
    /// Every axis shows more overlap than its error.
    Overlapping,
    /// Some axis is too close to call.
    Unclear,
}

/// Which side of touching the shapes are on.
///
/// No axis is normalised: what is lost to rounding is no more than along an axis as long as the longest edge can be.
pub(crate) fn sides(a: &Outline, b: &Outline, precision: &Precision) -> Sides {
    // An outward vector is as long as its edge, no edge is longer than its shape, and no core than this.
    let rounding = precision.projection() * 2.0 * precision.size;
    let mut top = f64::NEG_INFINITY;
    let mut parts = |one: &Outline, other: &Outline, edge: usize| {
        let outward = one.outward(edge);
        let separation = -other.support(-outward).reach - one.support(outward).reach;
        top = top.max(separation);
        separation > rounding
    };
    if (0..a.edge_count()).any(|edge| parts(a, b, edge)) || (0..b.edge_count()).any(|edge| parts(b, a, edge))
    {
        return Sides::Apart;
    }
    let doubt = rounding + precision.of_face() * 2.0 * precision.size;
    if top < -doubt { Sides::Overlapping } else { Sides::Unclear }
}

/// Whether no edge normal parts the shapes. Asks for a yes or no only, so no axis is normalised.
pub(crate) fn overlaps(a: &Outline, b: &Outline) -> bool {
    let parts = |one: &Outline, other: &Outline, edge: usize| {
        let outward = one.outward(edge);
        -other.support(-outward).reach > one.support(outward).reach
    };
    !(0..a.edge_count()).any(|edge| parts(a, b, edge)) && !(0..b.edge_count()).any(|edge| parts(b, a, edge))
}

fn axis_a(a: &Outline, b: &Outline, edge: usize) -> Axis {
    let normal = a.normal(edge);
    let separation = -b.support(-normal).reach - a.support(normal).reach;
    Axis { separation, normal, of: AxisOf::EdgeA(edge) }
}

fn axis_b(a: &Outline, b: &Outline, edge: usize) -> Axis {
    let normal = -b.normal(edge);
    let separation = -b.support(-normal).reach - a.support(normal).reach;
    Axis { separation, normal, of: AxisOf::EdgeB(edge) }
}

/// The axis that a hint names, evaluated; nothing where it names none that this pair has.
fn hinted_axis(a: &Outline, b: &Outline, hint: Hint) -> Option<Axis> {
    let features = hint.features()?;
    match (features.a(), features.b()) {
        (Feature::Edge(edge), _) if (edge as usize) < a.edge_count() => Some(axis_a(a, b, edge as usize)),
        (_, Feature::Edge(edge)) if (edge as usize) < b.edge_count() => Some(axis_b(a, b, edge as usize)),
        _ => None,
    }
}

/// The hint that leads back to an axis.
pub(crate) fn hint_of(axis: &Axis) -> Hint {
    Hint::axis(match axis.of {
        AxisOf::EdgeA(edge) => FeatureId::new(Feature::Edge(edge as u32), Feature::Vertex(0)),
        AxisOf::EdgeB(edge) => FeatureId::new(Feature::Vertex(0), Feature::Edge(edge as u32)),
    })
}
