//! The separating axis test for two convex polyhedra.
//!
//! ```text
//! for each face of A, of B:          axis = its normal
//! for each edge pair whose arcs on the Gauss map may cross, and that is not nearly parallel:
//!                                    axis = the cross product
//! the separation along an axis = min over B - max over A, projecting *every* vertex
//! one axis beyond the limit settles it; else the greatest separation wins
//! ```
//! An edge pair bounds the Minkowski difference exactly when the arc between the normals at A's edge crosses the arc
//! between the (negated) normals at B's (Gregorius, "The separating axis test between convex polyhedra", GDC 2013).
//! The arc test here only saves time, and errs towards keeping a pair: what it keeps is verified by full projection,
//! so noise in a cross product can make an axis useless but never wrong. Which way a cross product points is told by
//! the arc of A's edge, and not by the centres, which may coincide.
//!
//! An axis that is a little off its place shows a little less than it should, never more. How much that may be is kept
//! beside the best separation ([`Axes::short`]): one edge pair at a small angle costs only its own pair's precision.
//!
//! Cost: faces times vertices, plus edge pairs, plus kept edge pairs times vertices.

use super::solid::Solid;
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::{ARC_SLACK, MAX_HULL_VERTICES, PARALLEL_EDGES};

/// Edges of a hull with the most vertices, by Euler's formula.
const MAX_EDGES: usize = 3 * MAX_HULL_VERTICES - 6;

/// What an axis is the axis of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum AxisOf {
    FaceA(usize),
    FaceB(usize),
    /// Lower half-edges of an edge of A and of B.
    Edges(usize, usize),
}

/// A unit axis from A to B, and the separation along it by full projection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis {
    pub(crate) separation: f64,
    pub(crate) normal: DVec3,
    pub(crate) of: AxisOf,
}

/// The best axis of each kind. An axis that was never looked at has separation -inf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) face_a: Axis,
    pub(crate) face_b: Axis,
    pub(crate) edges: Axis,
    /// No axis that was proposed has a greater separation in truth.
    ceiling: f64,
    /// What the axes may fall short of the truth by for pairs of edges that proposed none.
    left_out: f64,
}

impl Axes {
    pub(crate) const NONE: Self = Self {
        face_a: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::FaceA(0) },
        face_b: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::FaceB(0) },
        edges: Axis { separation: f64::NEG_INFINITY, normal: DVec3::X, of: AxisOf::Edges(0, 0) },
        ceiling: f64::NEG_INFINITY,
        left_out: 0.0,
    };

    /// Takes note that some axis shows a separation, and may show too little by `doubt`.
    #[inline]
    pub(crate) fn raise(&mut self, separation: f64, doubt: f64) {
        self.ceiling = self.ceiling.max(separation + doubt);
    }

    /// Takes note of edges so nearly parallel that their axis is not proposed, by the separation along it.
    ///
    /// Two bounds hold for the axis that they should have: it shows no more than this one and its rounding, and no more
    /// than the best face and what a turn by the edges' angle costs. Most such pairs are far from being the best, and
    /// the first of the two says so.
    #[inline]
    pub(crate) fn leave_out(&mut self, separation: f64, squared_sine: f64, precision: &Precision) {
        // Twice: where rounding is no longer small next to the sine, the axis is off by more than their quotient.
        let by_axis = separation + 2.0 * precision.of_edges(squared_sine) - self.best().separation;
        let by_angle = precision.of_parallel_edges(squared_sine);
        self.left_out = self.left_out.max(by_angle.min(by_axis));
    }

    /// By how much the truth may exceed the best separation, that one's own rounding apart.
    pub(crate) fn short(&self) -> f64 {
        (self.ceiling - self.best().separation).max(self.left_out)
    }

    /// Keeps the axis if it is the best of its kind; ties keep the earlier.
    pub(crate) fn offer(&mut self, axis: Axis) {
        let slot = match axis.of {
            AxisOf::FaceA(_) => &mut self.face_a,
            AxisOf::FaceB(_) => &mut self.face_b,
            AxisOf::Edges(..) => &mut self.edges,
        };
        if axis.separation > slot.separation {
            *slot = axis;
        }
    }

    /// The greatest separation of all. Ties: a face of A, then a face of B, then edges.
    pub(crate) fn best(&self) -> &Axis {
        let mut best = &self.face_a;
        for other in [&self.face_b, &self.edges] {
            if other.separation > best.separation {
                best = other;
            }
        }
        best
    }
}

/// Outcome of the test: one axis that parts the shapes by more than the limit, or the best of each kind.
pub(crate) enum Outcome {
    Beyond(Axis),
    Within(Axes),
}

/// What is asked of the test.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    /// One axis that parts the shapes by more than this ends it.
    pub(crate) limit: f64,
    /// Tried first. The outcome within the limit does not depend on it.
    pub(crate) hint: Hint,
    /// How far edges may lie from the supporting planes of the axis that is theirs.
    pub(crate) slack: f64,
    pub(crate) precision: &'a Precision,
}

/// Runs the test.
pub(crate) fn separating_axes(a: &Solid, b: &Solid, search: &Search) -> Outcome {
    let Search { limit, hint, slack, precision } = *search;
    if let Some(axis) = hinted_axis(a, b, hint)
        && axis.separation > limit
    {
        return Outcome::Beyond(axis);
    }
    let mut axes = Axes::NONE;
    let faces_a = (0..a.face_count()).map(|face| face_axis_a(a, b, face));
    let faces_b = (0..b.face_count()).map(|face| face_axis_b(a, b, face));
    for axis in faces_a.chain(faces_b) {
        if axis.separation > limit {
            return Outcome::Beyond(axis);
        }
        axes.offer(axis);
    }
    axes.raise(axes.best().separation, precision.of_face());
    let mut beyond = None;
    for_edge_pairs(a, b, |edge_a, edge_b| {
        let cross = Cross::outwards(a, b, edge_a, edge_b);
        let axis = edge_axis(a, b, [edge_a, edge_b], &cross);
        if cross.is_noise() {
            axes.leave_out(axis.separation, cross.squared_sine, precision);
            return false;
        }
        axes.raise(axis.separation, precision.of_edges(cross.squared_sine));
        if axis.separation > limit {
            beyond = Some(axis);
        } else if axis.separation > axes.edges.separation && supports(a, b, &axis, slack) {
            axes.offer(axis);
        }
        beyond.is_some()
    });
    beyond.map_or(Outcome::Within(axes), Outcome::Beyond)
}

fn face_axis_a(a: &Solid, b: &Solid, face: usize) -> Axis {
    let normal = a.normal(face);
    let separation = -b.support(-normal).reach - a.support(normal).reach;
    Axis { separation, normal, of: AxisOf::FaceA(face) }
}

fn face_axis_b(a: &Solid, b: &Solid, face: usize) -> Axis {
    let normal = -b.normal(face);
    let separation = -b.support(-normal).reach - a.support(normal).reach;
    Axis { separation, normal, of: AxisOf::FaceB(face) }
}

/// The cross product of two edges.
#[derive(Clone, Copy, Debug)]
struct Cross {
    axis: DVec3,
    /// Of the sine between the edges.
    squared_sine: f64,
}

impl Cross {
    fn new(along_a: DVec3, along_b: DVec3) -> Self {
        let axis = along_a.cross(along_b);
        let squared_sine = axis.length_squared() / (along_a.length_squared() * along_b.length_squared());
        Self { axis, squared_sine }
    }

    /// Turned from A to B.
    fn outwards(a: &Solid, b: &Solid, edge_a: usize, edge_b: usize) -> Self {
        let cross = Self::new(a.edge_direction(edge_a), b.edge_direction(edge_b));
        // Outwards as seen from A's edge: between the normals of its two faces. A segment looks everywhere; then B's
        // edge tells.
        let outwards = match a.arc(edge_a).middle {
            DVec3::ZERO => -b.arc(edge_b).middle,
            middle => middle,
        };
        if cross.axis.dot(outwards) < 0.0 { Self { axis: -cross.axis, ..cross } } else { cross }
    }

    /// Whether the edges are so nearly parallel that the axis would be rounding. Edges of no length are.
    fn is_noise(&self) -> bool {
        self.squared_sine.is_nan() || self.squared_sine <= PARALLEL_EDGES * PARALLEL_EDGES
    }
}

fn edge_axis(a: &Solid, b: &Solid, [edge_a, edge_b]: [usize; 2], cross: &Cross) -> Axis {
    let normal = cross.axis.normalize();
    let separation = -b.support(-normal).reach - a.support(normal).reach;
    Axis { separation, normal, of: AxisOf::Edges(edge_a, edge_b) }
}

/// Whether an axis' edges lie where both shapes reach furthest along it.
///
/// An arc that was kept because it was a close call need not: its axis is a true axis, but not that of its edges, and
/// some other pair of the same direction is the one that touches.
fn supports(a: &Solid, b: &Solid, axis: &Axis, slack: f64) -> bool {
    let AxisOf::Edges(edge_a, edge_b) = axis.of else { return true };
    let between = b.edge(edge_b).0 - a.edge(edge_a).0;
    axis.normal.dot(between) - axis.separation <= slack
}

/// An edge on the Gauss map: its direction, of any length, and the unit normals that its arc runs between.
///
/// The edge of a flat polygon has a half circle, from one side's normal over the outward direction in the plane to the
/// other's; a segment has its whole great circle, and zero for ends and middle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    pub(crate) along: DVec3,
    pub(crate) ends: [DVec3; 2],
    /// A direction, of any length, in the middle of the arc.
    pub(crate) middle: DVec3,
}

impl Arc {
    pub(crate) fn map(&self, turn: impl Fn(DVec3) -> DVec3) -> Self {
        Self { along: turn(self.along), ends: self.ends.map(&turn), middle: turn(self.middle) }
    }
}

/// Visits edge pairs whose arcs may cross until the visitor says to stop; returns whether it did.
fn for_edge_pairs(a: &Solid, b: &Solid, mut visit: impl FnMut(usize, usize) -> bool) -> bool {
    // B's arcs side by side, in B's own axes, so that only A's are turned.
    let mut arcs_b: ArrayVec<Arc, MAX_EDGES> = ArrayVec::new();
    arcs_b.extend(b.topology.edges().iter().map(|&edge| b.local_arc(edge as usize)));
    for &edge_a in a.topology.edges() {
        let arc_a = b.arc_from_frame(a.arc(edge_a as usize));
        for (arc_b, &edge_b) in arcs_b.iter().zip(b.topology.edges()) {
            if arcs_may_cross(&arc_a, arc_b) && visit(edge_a as usize, edge_b as usize) {
                return true;
            }
        }
    }
    false
}

/// Whether an arc of A may cross the negative of an arc of B.
///
/// Each arc's ends must lie on different sides of the other's great circle, whose pole is the edge, and of the two
/// antipodal points where the circles meet both arcs must pass through the same. Anything within the slack may.
fn arcs_may_cross(a: &Arc, b: &Arc) -> bool {
    // The sum of absolute values bounds the length, and needs no root.
    let slack_a = ARC_SLACK * a.along.abs().element_sum();
    if same_side(a.along.dot(b.ends[0]), a.along.dot(b.ends[1]), slack_a) {
        return false;
    }
    let slack_b = ARC_SLACK * b.along.abs().element_sum();
    if same_side(b.along.dot(a.ends[0]), b.along.dot(a.ends[1]), slack_b) {
        return false;
    }
    // An arc is no longer than a half circle, so its middle tells which of the two points it passes.
    let meeting = a.along.cross(b.along);
    let passes_a = meeting.dot(a.middle);
    let passes_b = -meeting.dot(b.middle);
    let slack = slack_a * slack_b / ARC_SLACK;
    !((passes_a > slack && passes_b < -slack) || (passes_a < -slack && passes_b > slack))
}

fn same_side(one: f64, other: f64, slack: f64) -> bool {
    (one > slack && other > slack) || (one < -slack && other < -slack)
}

/// The axis that a hint names, evaluated; nothing where it names none that this pair has.
fn hinted_axis(a: &Solid, b: &Solid, hint: Hint) -> Option<Axis> {
    let features = hint.features()?;
    match (features.a(), features.b()) {
        (Feature::Face(face), _) if a.has_face(face) => Some(face_axis_a(a, b, face as usize)),
        (_, Feature::Face(face)) if b.has_face(face) => Some(face_axis_b(a, b, face as usize)),
        (Feature::Edge(edge_a), Feature::Edge(edge_b)) if a.has_edge(edge_a) && b.has_edge(edge_b) => {
            let edges = [edge_a as usize, edge_b as usize];
            let cross = Cross::outwards(a, b, edges[0], edges[1]);
            (!cross.is_noise()).then(|| edge_axis(a, b, edges, &cross))
        }
        _ => None,
    }
}

/// The hint that leads back to an axis.
pub(crate) fn hint_of(axis: &Axis) -> Hint {
    Hint::axis(match axis.of {
        AxisOf::FaceA(face) => FeatureId::new(Feature::Face(face as u32), Feature::Vertex(0)),
        AxisOf::FaceB(face) => FeatureId::new(Feature::Vertex(0), Feature::Face(face as u32)),
        AxisOf::Edges(a, b) => FeatureId::new(Feature::Edge(a as u32), Feature::Edge(b as u32)),
    })
}

#[cfg(test)]
mod tests;
