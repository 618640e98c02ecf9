//! Where two polygons touch: one or two points on one normal.
//!
//! ```text
//! the reference edge is A's unless B's beats it by more than a relative preference
//! the incident edge is, of the two at the other shape's deepest vertex, the one most opposed
//! clip the incident edge to the reference edge's width
//! keep the ends within the margin of the reference line
//! if the deepest point was clipped away, ask the axis that is best of all; then the witness points of the gap
//! ```

use super::distance::Witness;
use super::outline::Outline;
use super::sat::{Axes, Axis, AxisOf};
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;

/// A contact point in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) separation: f64,
    pub(crate) on_a: DVec2,
    pub(crate) on_b: DVec2,
    pub(crate) feature: FeatureId,
}

/// A normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec2,
    pub(crate) points: ArrayVec<Point, 2>,
}

/// The manifold of shapes that overlap, or that a gap of at most `margin` parts; `witness` tells which.
/// `preference` is how much another axis must beat an edge of A by.
///
/// An axis that only nearly is the best may have its deepest point clipped away, because what touches lies just beside
/// its edge. Then the best axis is asked in its place, and in a gap, the witness points.
pub(crate) fn touch(
    a: &Outline,
    b: &Outline,
    axes: &Axes,
    witness: Option<&Witness>,
    margin: f64,
    preference: f64,
) -> Touch {
    let at_stake = witness.map_or(axes.best().separation, |witness| witness.distance);
    let b_wins = axes.edge_b.separation > axes.edge_a.separation + preference;
    for axis in [if b_wins { &axes.edge_b } else { &axes.edge_a }, axes.best()] {
        if axis.separation < at_stake - preference {
            continue;
        }
        // Everything as deep as the deepest vertex up to rounding belongs to the manifold, also where that is no
        // deeper than zero: a body that rests exactly on an edge rests on both of its ends.
        let within = margin.max(at_stake + preference);
        let points = match axis.of {
            AxisOf::EdgeA(edge) => edge_points(a, b, edge, axis.normal, within, false),
            AxisOf::EdgeB(edge) => edge_points(b, a, edge, -axis.normal, within, true),
        };
        if points.iter().any(|point| point.separation <= at_stake + preference) {
            return Touch { normal: axis.normal, points };
        }
    }
    match witness {
        Some(witness) => Touch { normal: witness.normal, points: closest_point(a, b, witness) },
        None => Touch { normal: axes.best().normal, points: deepest_point(a, b, axes.best()) },
    }
}

/// The deepest vertex of the shape whose edge the axis is not, and its foot on that edge's line: what is left where an
/// edge looks past what touches it.
fn deepest_point(a: &Outline, b: &Outline, axis: &Axis) -> ArrayVec<Point, 2> {
    let (in_a, in_b) = (a.support(axis.normal), b.support(-axis.normal));
    let point = match axis.of {
        AxisOf::EdgeA(edge) => Reference { normal: axis.normal, reach: in_a.reach, is_b: false }
            .contact(b.point(in_b.vertex), (Feature::Edge(edge as u32), Feature::Vertex(in_b.vertex as u32))),
        AxisOf::EdgeB(edge) => Reference { normal: -axis.normal, reach: in_b.reach, is_b: true }
            .contact(a.point(in_a.vertex), (Feature::Edge(edge as u32), Feature::Vertex(in_a.vertex as u32))),
    };
    core::iter::once(point).collect()
}

/// The witness points of a gap, named by the features that carry them.
fn closest_point(a: &Outline, b: &Outline, witness: &Witness) -> ArrayVec<Point, 2> {
    let carrier = |outline: &Outline, which: usize, towards: DVec2| {
        let first = witness.corners[0][which];
        let other = witness.corners.iter().map(|corner| corner[which]).find(|&vertex| vertex != first);
        match other {
            None => Feature::Vertex(first as u32),
            // Both edges of a segment have both its ends: the one that looks at the other shape.
            Some(_) if outline.is_flat() => Feature::Edge(u32::from(outline.normal(0).dot(towards) < 0.0)),
            Some(other) if outline.after(first) == other => Feature::Edge(first as u32),
            Some(other) => Feature::Edge(other as u32),
        }
    };
    let point = Point {
        separation: witness.distance,
        on_a: witness.point_a,
        on_b: witness.point_b,
        feature: FeatureId::new(carrier(a, 0, witness.normal), carrier(b, 1, -witness.normal)),
    };
    core::iter::once(point).collect()
}

/// A line to measure contact points from: that of the reference edge.
struct Reference {
    /// Its outward unit normal.
    normal: DVec2,
    /// The reference shape's reach along it.
    reach: f64,
    is_b: bool,
}

impl Reference {
    /// The contact of a point of the incident shape with its foot on the line. Features: the reference's first.
    fn contact(&self, point: DVec2, (of_reference, of_incident): (Feature, Feature)) -> Point {
        let separation = self.normal.dot(point) - self.reach;
        let foot = point - self.normal * separation;
        if self.is_b {
            Point { separation, on_a: point, on_b: foot, feature: FeatureId::new(of_incident, of_reference) }
        } else {
            Point { separation, on_a: foot, on_b: point, feature: FeatureId::new(of_reference, of_incident) }
        }
    }
}

/// Contact points of an edge of `outline` with outward normal `normal`, and the incident shape: those at most
/// `within` outside the edge's line.
fn edge_points(
    outline: &Outline,
    incident: &Outline,
    edge: usize,
    normal: DVec2,
    within: f64,
    is_b: bool,
) -> ArrayVec<Point, 2> {
    let reference = Reference { normal, reach: outline.support(normal).reach, is_b };
    let deepest = incident.support(-normal).vertex;
    if incident.edge_count() == 0 {
        let point = incident.point(deepest);
        let (from, to) = (outline.point(edge), outline.point(outline.after(edge)));
        let is_beside = (point - from).dot(to - from) >= 0.0 && (point - to).dot(from - to) >= 0.0;
        let contact = reference.contact(point, (Feature::Edge(edge as u32), Feature::Vertex(deepest as u32)));
        return (is_beside && contact.separation <= within).then_some(contact).into_iter().collect();
    }
    let previous = incident.before(deepest);
    // Ties go to the edge before the deepest vertex.
    let facing = |edge: usize| incident.normal(edge).dot(normal);
    let incident_edge = if facing(deepest) < facing(previous) { deepest } else { previous };

    let mut points: ArrayVec<Point, 2> = clip(outline, edge, incident, incident_edge)
        .into_iter()
        .map(|(point, features)| reference.contact(point, features))
        .filter(|contact| contact.separation <= within)
        .collect();
    points.sort_unstable_by_key(|point| point.feature);
    points
}

/// The ends of the incident edge, held to the width of the reference edge; none where they face past each other.
fn clip(
    outline: &Outline,
    edge: usize,
    incident: &Outline,
    incident_edge: usize,
) -> ArrayVec<(DVec2, (Feature, Feature)), 2> {
    let mut kept = ArrayVec::new();
    let (from, to) = (outline.point(edge), outline.point(outline.after(edge)));
    let along = to - from;
    let (first, second) = (incident_edge, incident.after(incident_edge));
    let (start, end) = (incident.point(first), incident.point(second));
    // Places along the reference edge, 0 to 1. The incident edge runs against it, so that `low` is its end.
    let place = |point: DVec2| along.dot(point - from) / along.length_squared();
    let (high, low) = (place(start), place(end));
    if high <= low || high < 0.0 || low > 1.0 {
        return kept;
    }
    let at = |place: f64| start + (end - start) * ((high - place) / (high - low));
    let on_edge = |vertex: usize| (Feature::Edge(edge as u32), Feature::Vertex(vertex as u32));
    let on_corner = |vertex: usize| (Feature::Vertex(vertex as u32), Feature::Edge(incident_edge as u32));
    kept.push(if low >= 0.0 { (end, on_edge(second)) } else { (at(0.0), on_corner(edge)) });
    kept.push(if high <= 1.0 { (start, on_edge(first)) } else { (at(1.0), on_corner(outline.after(edge))) });
    kept
}
