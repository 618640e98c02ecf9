//! Where two polygons touch: one or two points on one normal.
//!
//! ```text
//! the reference edge is last frame's unless another beats it by more than two relative preferences
//!   else A's unless B's beats it by more than one
//! the incident edge is, of the two at the other shape's deepest vertex, the one most opposed
//! clip the incident edge to the reference edge's width
//! keep the ends within the margin of the reference line
//! if the deepest point was clipped away, ask the axis that is best of all; then the witness points of the gap
//! ```
//! All of that is done with the shapes' cores, and the points are then moved out to the surfaces: what is deepest,
//! along the normal; the other end of a tilted edge along that edge's own normal, since the shape's surface beyond it
//! looks that way.

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

impl Point {
    /// A point where two cores are closest, moved out to the surfaces along the normal.
    pub(super) fn on_surfaces(self, a: &Outline, b: &Outline, normal: DVec2) -> Self {
        Self {
            separation: self.separation - a.radius - b.radius,
            on_a: self.on_a + normal * a.radius,
            on_b: self.on_b - normal * b.radius,
            ..self
        }
    }
}

/// A normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec2,
    pub(crate) points: ArrayVec<Point, 2>,
    /// The edge that it was built on, if it was one: what the next frame tries first, and keeps among equals.
    pub(crate) reference: Option<AxisOf>,
}

impl Touch {
    pub(super) fn of_point(normal: DVec2, point: Point, reference: Option<AxisOf>) -> Self {
        let mut points = ArrayVec::new();
        points.push(point);
        Self { normal, points, reference }
    }
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
    let deep = at_stake + preference;
    let least = deep - a.radius - b.radius;
    // Everything as deep as the deepest vertex up to rounding belongs to the manifold, also where that is no
    // deeper than zero: a body that rests exactly on an edge rests on both of its ends.
    let depths = Depths { deep, within: margin.max(least) };
    let b_wins = axes.edge_b.separation > axes.edge_a.separation + preference;
    let plain = if b_wins { &axes.edge_b } else { &axes.edge_a };
    let best = axes.best();
    // A reference that changed from frame to frame would change all names.
    let kept = axes.kept.as_ref().filter(|kept| kept.separation >= best.separation - 2.0 * preference);
    let tried = [kept.map(|kept| (kept, 2.0)), Some((plain, 1.0)), Some((best, 1.0))];
    for (axis, preferences) in tried.into_iter().flatten() {
        if axis.separation < at_stake - preferences * preference {
            continue;
        }
        let points = match axis.of {
            AxisOf::EdgeA(edge) => edge_points(a, b, edge, axis.normal, depths, false),
            AxisOf::EdgeB(edge) => edge_points(b, a, edge, -axis.normal, depths, true),
        };
        if points.iter().any(|point| point.separation <= least) {
            return Touch { normal: axis.normal, points, reference: Some(axis.of) };
        }
    }
    match witness {
        Some(witness) => {
            Touch { normal: witness.across, points: closest_point(a, b, witness), reference: None }
        }
        None => Touch { normal: best.normal, points: deepest_point(a, b, best), reference: Some(best.of) },
    }
}

/// Which ends of an edge become points, in metres.
#[derive(Clone, Copy)]
struct Depths {
    /// Ends of the cores no further apart than this are as deep as any.
    deep: f64,
    /// Points of the shapes no further apart than this are wanted.
    within: f64,
}

/// The deepest vertex of the shape whose edge the axis is not, and its foot on that edge's line: what is left where an
/// edge looks past what touches it.
fn deepest_point(a: &Outline, b: &Outline, axis: &Axis) -> ArrayVec<Point, 2> {
    let (in_a, in_b) = (a.support(axis.normal), b.support(-axis.normal));
    let (low_a, low_b) = (a.point(in_a.vertex), b.point(in_b.vertex));
    let (on_a, on_b) = (Feature::Vertex(in_a.vertex as u32), Feature::Vertex(in_b.vertex as u32));
    let point = match axis.of {
        AxisOf::EdgeA(edge) => {
            let features = (Feature::Edge(edge as u32), on_b);
            Reference::of(a, axis.normal, false).lowest(low_b, b.radius, features)
        }
        AxisOf::EdgeB(edge) => {
            let features = (Feature::Edge(edge as u32), on_a);
            Reference::of(b, -axis.normal, true).lowest(low_a, a.radius, features)
        }
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
    core::iter::once(point.on_surfaces(a, b, witness.across)).collect()
}

/// A line to measure contact points from: that of the reference edge's surface.
struct Reference {
    /// Its outward unit normal.
    normal: DVec2,
    /// How far the surface reaches along it.
    reach: f64,
    is_b: bool,
}

impl Reference {
    fn of(outline: &Outline, normal: DVec2, is_b: bool) -> Self {
        Self { normal, reach: outline.support(normal).reach + outline.radius, is_b }
    }

    /// The contact of a point of the other shape's core, moved out to its surface along the normal.
    fn lowest(&self, point: DVec2, radius: f64, features: (Feature, Feature)) -> Point {
        self.contact(point - self.normal * radius, features)
    }

    /// The contact of a point of the other shape's surface with its foot on the line. Features: the reference's first.
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

/// Contact points of an edge of `outline` with outward normal `normal`, and the incident shape.
fn edge_points(
    outline: &Outline,
    incident: &Outline,
    edge: usize,
    normal: DVec2,
    depths: Depths,
    is_b: bool,
) -> ArrayVec<Point, 2> {
    let reference = Reference::of(outline, normal, is_b);
    let deepest = incident.support(-normal).vertex;
    if incident.edge_count() == 0 {
        let point = incident.point(deepest);
        let (from, to) = (outline.point(edge), outline.point(outline.after(edge)));
        let is_beside = (point - from).dot(to - from) >= 0.0 && (point - to).dot(from - to) >= 0.0;
        let features = (Feature::Edge(edge as u32), Feature::Vertex(deepest as u32));
        let contact = reference.lowest(point, incident.radius, features);
        return (is_beside && contact.separation <= depths.within).then_some(contact).into_iter().collect();
    }
    let previous = incident.before(deepest);
    // Ties go to the edge before the deepest vertex.
    let facing = |edge: usize| incident.normal(edge).dot(normal);
    let incident_edge = if facing(deepest) < facing(previous) { deepest } else { previous };

    let mut points: ArrayVec<Point, 2> = ArrayVec::new();
    let is_sharp = outline.radius + incident.radius == 0.0;
    // How deep the cores are, seen from a contact made along the normal.
    let core = |contact: &Point| contact.separation + outline.radius + incident.radius;
    let on_core = clip((outline, edge), (incident, incident_edge), DVec2::ZERO);
    let lowest = on_core.into_iter().map(|(point, of)| reference.lowest(point, incident.radius, of));
    let wanted = |contact: &Point| contact.separation <= depths.within;
    points.extend(lowest.filter(|contact| wanted(contact) && (is_sharp || core(contact) <= depths.deep)));
    if points.len() < 2 && !is_sharp {
        // What is less deep belongs to a tilted edge, and lies out along its normal; there the ends are cut again.
        let outwards = incident.normal(incident_edge) * incident.radius;
        let mut ends: ArrayVec<Point, 2> = clip((outline, edge), (incident, incident_edge), outwards)
            .into_iter()
            .map(|(point, features)| reference.contact(point, features))
            .filter(wanted)
            .collect();
        if let Some(&known) = points.first() {
            // The end that is not the deep one.
            let away = |end: &Point| (end.on_a - known.on_a).length_squared();
            ends.retain(|end| end.feature != known.feature);
            ends.sort_unstable_by(|one, other| away(other).total_cmp(&away(one)));
        }
        let room = points.remaining_capacity();
        points.extend(ends.into_iter().take(room));
    }
    points.sort_unstable_by_key(|point| point.feature);
    points
}

/// The ends of the incident edge, moved by `aside` and held to the width of the reference edge; none where they face
/// past each other.
fn clip(
    (outline, edge): (&Outline, usize),
    (incident, incident_edge): (&Outline, usize),
    aside: DVec2,
) -> ArrayVec<(DVec2, (Feature, Feature)), 2> {
    let mut kept = ArrayVec::new();
    let (from, to) = (outline.point(edge), outline.point(outline.after(edge)));
    let along = to - from;
    let (first, second) = (incident_edge, incident.after(incident_edge));
    let (start, end) = (incident.point(first) + aside, incident.point(second) + aside);
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
