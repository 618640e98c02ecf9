//! Where two polygons touch: one or two points on one normal.
//!
//! ```text
//! the reference edge is last frame's unless another beats it by more than two relative preferences
//!   else A's unless B's beats it by more than one
//! the incident edge is, of the two at the other shape's deepest vertex, the one most opposed
//! clip the incident edge to the reference edge's width
//! keep the ends within the margin of the reference line
//! if the deepest point was clipped away: use the best axis instead; failing that, the witness points of the gap
//! ```
//! All of that is done with the shapes' cores, and the points are then moved out to the surfaces. What is deepest moves
//! along the normal. The other end of a tilted edge moves along that edge's own normal, since the surface beyond it
//! faces that way. Over ground, where the reference edge may cut off what is deepest, a point moves to the surface over
//! the cut.

use super::distance::Witness;
use super::placed::Placed;
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
    /// A point where two cores are closest, moved out along the normal, by both radii, to the surfaces.
    pub(super) fn on_surfaces(self, [a, b]: [f64; 2], normal: DVec2) -> Self {
        Self {
            separation: self.separation - a - b,
            on_a: self.on_a + normal * a,
            on_b: self.on_b - normal * b,
            ..self
        }
    }
}

/// A normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec2,
    pub(crate) points: ArrayVec<Point, 2>,
    /// The edge that it was built on, if any: the next frame tries it first, and prefers it among equals.
    pub(crate) reference: Option<AxisOf>,
}

impl Touch {
    pub(super) fn of_point(normal: DVec2, point: Point, reference: Option<AxisOf>) -> Self {
        let mut points = ArrayVec::new();
        points.push(point);
        Self { normal, points, reference }
    }
}

/// The manifold of shapes that overlap, or have a gap of at most `margin`, of which `witness` holds the nearest points.
/// `preference` is by how much another axis must beat an edge of A, and `near` how near to a vertex of either a point
/// must be to be named after it.
///
/// An axis that is only nearly the best may have its deepest point clipped away, because the touching feature lies just
/// beside its edge. Then the best axis is used instead, and in a gap, the witness points.
#[inline(always)]
pub(crate) fn touch(
    [a, b]: [&impl Placed; 2],
    axes: &Axes,
    witness: Option<&Witness>,
    margin: f64,
    [preference, near]: [f64; 2],
) -> Touch {
    let best = axes.best();
    let at_stake = witness.map_or(best.separation, |witness| witness.distance);
    let deep = at_stake + preference;
    let least = deep - a.radius() - b.radius();
    // Everything as deep as the deepest vertex up to rounding belongs to the manifold, even if that is no deeper than
    // zero: a body that rests exactly on an edge rests on both of its ends.
    let depths = Depths { deep, within: margin.max(least), is_cut: false, near };
    let on_edge = |axis: &Axis| {
        let points = match axis.of {
            AxisOf::EdgeA(edge) => edge_points([a, b], edge, axis, depths, false),
            AxisOf::EdgeB(edge) => edge_points([b, a], edge, axis, depths, true),
        };
        let is_deep = points.iter().any(|point| point.separation <= least);
        is_deep.then_some(Touch { normal: axis.normal, points, reference: Some(axis.of) })
    };
    // A reference that changes from frame to frame would change all feature ids.
    let kept = axes.kept.as_ref().filter(|kept| kept.separation >= best.separation - 2.0 * preference);
    if let Some(kept) = kept
        && kept.separation >= at_stake - 2.0 * preference
        && let Some(touch) = on_edge(kept)
    {
        return touch;
    }
    let b_wins = axes.edge_b.separation > axes.edge_a.separation + preference;
    let plain = if b_wins { &axes.edge_b } else { &axes.edge_a };
    if plain.separation >= at_stake - preference
        && let Some(touch) = on_edge(plain)
    {
        return touch;
    }
    if best.of != plain.of
        && best.separation >= at_stake - preference
        && let Some(touch) = on_edge(best)
    {
        return touch;
    }
    match witness {
        Some(witness) => Touch::of_point(witness.across, closest_point(a, b, witness), None),
        None => Touch::of_point(best.normal, deepest_point(a, b, best), Some(best.of)),
    }
}

/// Which ends of an edge become points, in metres.
#[derive(Clone, Copy)]
struct Depths {
    /// Ends of the cores no further apart than this count as deepest.
    deep: f64,
    /// Points of the shapes no further apart than this are wanted.
    within: f64,
    /// Whether the reference edge may cut off what is deepest, because its axis may be far from the best.
    is_cut: bool,
    /// How near a point must be to a vertex to be named after it.
    near: f64,
}

/// The deepest vertex of the other shape, and its foot on the line of the axis' edge: the fallback where that edge is
/// not over what touches it.
#[cold]
fn deepest_point(a: &impl Placed, b: &impl Placed, axis: &Axis) -> Point {
    match axis.of {
        AxisOf::EdgeA(edge) => {
            let vertex = b.furthest(-axis.normal);
            let features = (Feature::Edge(edge as u32), Feature::Vertex(vertex as u32));
            Reference::of(a, edge, axis.normal, false).lowest(b.point(vertex), b.radius(), features)
        }
        AxisOf::EdgeB(edge) => {
            let vertex = a.furthest(axis.normal);
            let features = (Feature::Edge(edge as u32), Feature::Vertex(vertex as u32));
            Reference::of(b, edge, -axis.normal, true).lowest(a.point(vertex), a.radius(), features)
        }
    }
}

/// The witness points of a gap, named by the features that carry them.
fn closest_point(a: &impl Placed, b: &impl Placed, witness: &Witness) -> Point {
    let point = Point {
        separation: witness.distance,
        on_a: witness.point_a,
        on_b: witness.point_b,
        feature: FeatureId::new(
            carrier(a, witness, 0, witness.normal),
            carrier(b, witness, 1, -witness.normal),
        ),
    };
    point.on_surfaces([a.radius(), b.radius()], witness.across)
}

/// The vertex or edge of a shape that carries its witness point.
fn carrier(outline: &impl Placed, witness: &Witness, which: usize, towards: DVec2) -> Feature {
    let first = witness.corners[0][which];
    let other = witness.corners.iter().map(|corner| corner[which]).find(|&vertex| vertex != first);
    match other {
        None => Feature::Vertex(first as u32),
        // Both edges of a segment have both its ends: take the one that faces the other shape.
        Some(_) if outline.is_flat() => Feature::Edge(u32::from(outline.outward(0).dot(towards) < 0.0)),
        Some(other) if outline.after(first) == other => Feature::Edge(first as u32),
        Some(other) => Feature::Edge(other as u32),
    }
}

/// A line to measure contact points from: that of the reference edge's surface.
struct Reference {
    /// The ends of the edge.
    ends: [DVec2; 2],
    /// Its outward unit normal.
    normal: DVec2,
    /// How far the surface reaches along it.
    reach: f64,
    is_b: bool,
}

impl Reference {
    #[inline]
    fn of(outline: &impl Placed, edge: usize, normal: DVec2, is_b: bool) -> Self {
        let ends = [outline.point(edge), outline.point(outline.after(edge))];
        // Polygons are convex by exact predicates: nothing reaches further along an edge's normal than its ends.
        let (from, to) = (normal.dot(ends[0]), normal.dot(ends[1]));
        let reach = (if to > from { to } else { from }) + outline.radius();
        Self { ends, normal, reach, is_b }
    }

    /// The contact of a point of the other shape's core, moved out to its surface along the normal.
    #[inline]
    fn lowest(&self, point: DVec2, radius: f64, features: (Feature, Feature)) -> Point {
        self.contact(point - self.normal * radius, features)
    }

    /// The same for a point at which the reference edge cuts off an edge of the core. `out` leads from that edge to the
    /// surface.
    ///
    /// The deepest point of a whole shape is a radius below its core. Below a cut lies the surface of a tilted edge, or
    /// of the arc around its deeper end.
    #[cold]
    fn over_cut(
        &self,
        point: DVec2,
        ([start, end], out): ([DVec2; 2], DVec2),
        features: (Feature, Feature),
    ) -> Point {
        let deeper = if self.normal.dot(end) < self.normal.dot(start) { end } else { start };
        let from_end = point - deeper;
        let (above, aside) = (self.normal.dot(from_end), self.normal.perp_dot(from_end).abs());
        let squared = out.length_squared();
        let below = if aside < self.normal.perp_dot(out).abs() {
            above + (squared - aside * aside).sqrt()
        } else {
            // An edge reaches this far to the side only if it leans by less than a right angle.
            squared / -self.normal.dot(out)
        };
        self.lowest(point, below, features)
    }

    /// The contact of a point of the other shape's surface with its foot on the line. Features: the reference's come
    /// first.
    #[inline]
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

/// The nearest points of two cores with a gap between them, if they lie on the best axis' edge and along that axis:
/// then they are as far apart as it shows, and no search is needed. Points up to `tiny` further count as nearest.
pub(super) fn nearest_on_edge([a, b]: [&impl Placed; 2], axis: &Axis, tiny: f64) -> Option<Witness> {
    let witness = match axis.of {
        AxisOf::EdgeA(edge) => on_edge(a, b, (edge, axis.normal), tiny, false),
        AxisOf::EdgeB(edge) => on_edge(b, a, (edge, -axis.normal), tiny, true),
    }?;
    let [point_a, point_b] = witness.1;
    let distance = (point_b - point_a).length();
    let (normal, at_least) = (axis.normal, axis.separation);
    Some(Witness { distance, at_least, normal, across: normal, point_a, point_b, corners: witness.0 })
}

/// Corners that carry the nearest points, and those points, A's first.
type Carried = (ArrayVec<[usize; 2], 3>, [DVec2; 2]);

fn on_edge(
    outline: &impl Placed,
    incident: &impl Placed,
    (edge, normal): (usize, DVec2),
    tiny: f64,
    is_b: bool,
) -> Option<Carried> {
    let reference = Reference::of(outline, edge, normal, is_b);
    let next = outline.after(edge);
    let ([from, to], deepest) = (reference.ends, incident.furthest(-normal));
    let (along, vertex) = (to - from, incident.point(deepest));
    let place = along.dot(vertex - from) / along.length_squared();
    let (place, vertices, point) = if (0.0..=1.0).contains(&place) {
        (place, [deepest, deepest], vertex)
    } else {
        if incident.edge_count() == 0 {
            return None;
        }
        // The edge there may be parallel, and reach over the other all the same.
        let second = incident.facing(deepest, normal);
        let vertices = [second, incident.after(second)];
        let ends = [incident.point(vertices[0]), incident.point(vertices[1])];
        let clipped = clip(&reference.ends, ends, [(edge, next), (vertices[0], vertices[1])], 0.0)?;
        let ends = [clipped[0].at, clipped[1].at];
        let (one, other) = ((normal.dot(ends[0]), ends[0]), (normal.dot(ends[1]), ends[1]));
        let (height, point) = if other.0 < one.0 { other } else { one };
        if height - normal.dot(vertex) > tiny {
            return None;
        }
        (along.dot(point - from) / along.length_squared(), vertices, point)
    };
    let foot = from + along * place.clamp(0.0, 1.0);
    let pairs = [[edge, vertices[0]], [next, vertices[1]]];
    let corners =
        pairs.into_iter().map(|[one, other]| if is_b { [other, one] } else { [one, other] }).collect();
    Some((corners, if is_b { [point, foot] } else { [foot, point] }))
}

/// Points of the incident shape's lowest edge that lie over an edge of `outline`, along that edge's outward normal
/// whatever the best axis is, and no further than `within` metres from it. Beyond an end that is `open`, the edge
/// counts as going on.
pub(crate) fn over_edge(
    [outline, incident]: [&impl Placed; 2],
    (edge, normal, open): (usize, DVec2, [bool; 2]),
    within: f64,
    [preference, near]: [f64; 2],
    is_b: bool,
) -> ArrayVec<Point, 2> {
    let mut reference = Reference::of(outline, edge, normal, is_b);
    let height = |point: DVec2| normal.dot(point) - (reference.reach - outline.radius());
    if open != [false; 2] {
        reference.ends = stretched(reference.ends, open, incident, normal);
    }
    let ends = reference.ends;
    let mut deep = f64::NEG_INFINITY;
    if incident.edge_count() > 0 {
        let second = incident.facing_edge(normal);
        let vertices = [second, incident.after(second)];
        let lowest = [incident.point(vertices[0]), incident.point(vertices[1])];
        let clipped = clip(&ends, lowest, [(0, 0); 2], 0.0);
        deep =
            clipped.map_or(f64::INFINITY, |[one, other]| height(one.at).min(height(other.at)) + preference);
    }
    points_over(&reference, [outline, incident], edge, Depths { deep, within, is_cut: true, near })
}

/// The ends of an edge, where it is open moved out past all of the incident shape's lowest edge.
fn stretched([from, to]: [DVec2; 2], open: [bool; 2], incident: &impl Placed, normal: DVec2) -> [DVec2; 2] {
    let along = to - from;
    let first =
        if incident.edge_count() > 0 { incident.facing_edge(normal) } else { incident.furthest(-normal) };
    let next = if incident.edge_count() > 0 { incident.after(first) } else { first };
    let places =
        [first, next].map(|vertex| along.dot(incident.point(vertex) - from) / along.length_squared());
    let further = 1.0 + incident.radius() / along.length();
    let low = if open[0] { places[0].min(places[1]).min(0.0) - further } else { 0.0 };
    let high = if open[1] { places[0].max(places[1]).max(1.0) + further } else { 1.0 };
    [from + along * low, from + along * high]
}

/// Contact points of an edge of `outline` with this outward normal, and the incident shape.
#[inline]
fn edge_points(
    [outline, incident]: [&impl Placed; 2],
    edge: usize,
    axis: &Axis,
    depths: Depths,
    is_b: bool,
) -> ArrayVec<Point, 2> {
    let normal = if is_b { -axis.normal } else { axis.normal };
    points_over(&Reference::of(outline, edge, normal, is_b), [outline, incident], edge, depths)
}

/// Contact points of the incident shape over a reference edge, which may go on beyond its ends.
#[inline]
fn points_over(
    reference: &Reference,
    [outline, incident]: [&impl Placed; 2],
    edge: usize,
    depths: Depths,
) -> ArrayVec<Point, 2> {
    let normal = reference.normal;
    if incident.edge_count() == 0 {
        let deepest = incident.furthest(-normal);
        return vertex_point(reference, (edge, deepest), incident, depths).into_iter().collect();
    }
    let second = incident.facing_edge(normal);
    let radius = incident.radius();
    let is_sharp = outline.radius() + radius == 0.0;
    let edges = [(edge, outline.after(edge)), (second, incident.after(second))];
    let ends = [incident.point(edges[1].0), incident.point(edges[1].1)];
    let mut points: ArrayVec<Point, 2> = ArrayVec::new();
    // Which end has a point already.
    let mut known = None;
    if let Some([one, other]) = clip(&reference.ends, ends, edges, depths.near) {
        let lowest = |End { at, features, is_cut }: End| {
            if is_cut && depths.is_cut && radius > 0.0 {
                reference.over_cut(at, (ends, incident.outward(second) * radius), features)
            } else {
                reference.lowest(at, radius, features)
            }
        };
        let (one, other) = (lowest(one), lowest(other));
        // A core's depth as seen from a contact made along the normal.
        let is_kept = |contact: &Point| {
            let core = contact.separation + outline.radius() + radius;
            contact.separation <= depths.within && (is_sharp || core <= depths.deep)
        };
        let kept = [is_kept(&one), is_kept(&other)];
        known = kept.iter().position(|&is_kept| is_kept);
        match kept {
            [true, true] if other.feature < one.feature => {
                points.push(other);
                points.push(one);
            }
            [true, true] => {
                points.push(one);
                points.push(other);
            }
            [true, false] => points.push(one),
            [false, true] => points.push(other),
            [false, false] => {}
        }
    }
    if is_sharp {
        return points;
    }
    if points.len() < 2 {
        let outwards = incident.outward(second) * radius;
        let clipped = clip(&reference.ends, [ends[0] + outwards, ends[1] + outwards], edges, depths.near);
        add_tilted((&mut points, known), reference, clipped, depths);
    }
    points
}

/// The contact of an edge with a vertex, if the vertex is over the edge.
fn vertex_point(
    reference: &Reference,
    (edge, vertex): (usize, usize),
    incident: &impl Placed,
    depths: Depths,
) -> Option<Point> {
    let (point, [from, to]) = (incident.point(vertex), reference.ends);
    let is_beside = (point - from).dot(to - from) >= 0.0 && (point - to).dot(from - to) >= 0.0;
    let features = (Feature::Edge(edge as u32), Feature::Vertex(vertex as u32));
    let contact = reference.lowest(point, incident.radius(), features);
    (is_beside && contact.separation <= depths.within).then_some(contact)
}

/// Adds an end that is less deep: it belongs to a tilted edge, so its surface is along that edge's normal, and clipped
/// there.
fn add_tilted(
    (points, known): (&mut ArrayVec<Point, 2>, Option<usize>),
    reference: &Reference,
    clipped: Clipped,
    depths: Depths,
) {
    let is_other = |&(which, _): &(usize, End)| known != Some(which);
    let ends = clipped.into_iter().flatten().enumerate().filter(is_other);
    let contacts = ends.map(|(_, end)| reference.contact(end.at, end.features));
    let mut ends: ArrayVec<Point, 2> =
        contacts.filter(|contact| contact.separation <= depths.within).collect();
    if let Some(&known) = points.first() {
        // The end that is not the deep one.
        let away = |end: &Point| (end.on_a - known.on_a).length_squared();
        ends.sort_unstable_by(|one, other| away(other).total_cmp(&away(one)));
    }
    let room = points.remaining_capacity();
    points.extend(ends.into_iter().take(room));
    if let [first, second] = points.as_mut_slice()
        && second.feature < first.feature
    {
        core::mem::swap(first, second);
    }
}

/// A point of the incident edge.
struct End {
    at: DVec2,
    /// The reference's first.
    features: (Feature, Feature),
    /// Whether the incident edge goes on beyond the reference edge there.
    is_cut: bool,
}

type Clipped = Option<[End; 2]>;

/// The incident edge clipped to the width of the reference edge; `None` where no part of it is over that. `edges` are
/// the vertices at their ends, the reference's first. Where ends of both are within `near` metres of each other, the
/// point is named after both, whichever is further in: so ids stay the same while bodies of equal width tremble on each
/// other.
#[inline]
fn clip(
    &[from, to]: &[DVec2; 2],
    [start, end]: [DVec2; 2],
    edges: [(usize, usize); 2],
    near: f64,
) -> Clipped {
    let along = to - from;
    // Places along the reference edge, 0 to 1. The incident edge runs the other way, so that `low` is its end.
    let inverse = 1.0 / along.length_squared();
    let place = |point: DVec2| along.dot(point - from) * inverse;
    let (high, low) = (place(start), place(end));
    // Far out an edge may have rounded to a point; its places are NaN, and compare as false.
    let meets = high > low && high >= 0.0 && low <= 1.0;
    if !meets {
        return None;
    }
    let at = |place: f64| start + (end - start) * ((high - place) / (high - low));
    let [(edge, next), (first, second)] = edges;
    let end_at = |place: f64, beyond: f64, whole: DVec2, (of_reference, of_incident): (usize, usize)| {
        let is_cut = beyond < 0.0;
        let corner = (Feature::Vertex(of_reference as u32), Feature::Vertex(of_incident as u32));
        let features = if beyond * beyond * along.length_squared() < near * near {
            corner
        } else if is_cut {
            (corner.0, Feature::Edge(first as u32))
        } else {
            (Feature::Edge(edge as u32), corner.1)
        };
        End { at: if is_cut { at(place) } else { whole }, features, is_cut }
    };
    Some([end_at(0.0, low, end, (edge, second)), end_at(1.0, 1.0 - high, start, (next, first))])
}
