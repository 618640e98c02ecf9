//! Where two polyhedra touch: up to four points on one normal.
//!
//! ```text
//! choose what touches: a face of A unless a face of B, or two edges, beat it by more than a relative preference
//! two edges:  the faces beside them, if they nearly look at each other; else the nearest points of their lines
//! a face:     the other shape's incident face is the one most opposed, of those at its deepest vertex
//!             clip it against planes through the reference face's edges, along the normal
//!             keep the points within the margin of the reference plane
//! if the deepest point was clipped away, ask the axis that is best of all; then, in a gap, the faces that nearly look at
//! each other across it; then the witness points
//! reduce to four
//! ```
//! Side planes are made from the reference face's own edges and not from neighbouring faces, so that a face which is
//! flat only up to rounding clips like one that is flat. Every corner of the clipped polygon carries the features it
//! comes from, which is what makes its id.

use super::distance::Witness;
use super::reduce::reduce_to_four;
use super::sat::{Axes, Axis, AxisOf};
use super::solid::Solid;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::ALIGNED_FACES;

/// The most corners a clipped face can have: those of both faces.
const MAX_CORNERS: usize = 512;

/// A contact point in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) separation: f64,
    pub(crate) on_a: DVec3,
    pub(crate) on_b: DVec3,
    pub(crate) feature: FeatureId,
}

/// A normal and its points, in the frame of the pair.
pub(crate) struct Touch {
    pub(crate) normal: DVec3,
    pub(crate) points: ArrayVec<Point, 4>,
}

/// The manifold of shapes that overlap, or that a gap of at most `margin` parts; `witness` tells which.
/// `preference` is how much another axis must beat a face of A by.
///
/// An axis that only nearly is the best may have its deepest point clipped away, because what touches lies just beside
/// its face. Then the best axis is asked in its place; in a gap, faces that nearly look at each other across it, and at
/// last the witness points.
pub(crate) fn touch(
    a: &Solid,
    b: &Solid,
    axes: &Axes,
    witness: Option<&Witness>,
    margin: f64,
    preference: f64,
) -> Touch {
    let overlapping = witness.is_none();
    let at_stake = witness.map_or(axes.best().separation, |witness| witness.distance);
    let is_deep =
        |points: &ArrayVec<Point, 4>| points.iter().any(|point| point.separation <= at_stake + preference);
    for axis in [preferred(axes, overlapping, preference), axes.best()] {
        if axis.separation < at_stake - preference {
            continue;
        }
        // Everything as deep as the deepest vertex up to rounding belongs to the manifold, also where that is no
        // deeper than zero: a body that rests exactly on a face rests on all of its corners.
        let within = margin.max(at_stake + preference);
        let points = match axis.of {
            AxisOf::FaceA(face) => face_points(a, b, face, axis.normal, within, false),
            AxisOf::FaceB(face) => face_points(b, a, face, -axis.normal, within, true),
            AxisOf::Edges(..) if !overlapping => continue,
            AxisOf::Edges(edge_a, edge_b) => aligned_faces(a, b, axis.normal, within)
                .filter(|points| is_deep(points))
                .unwrap_or_else(|| edge_point(a, b, (edge_a, edge_b), axis.normal)),
        };
        if is_deep(&points) {
            return Touch { normal: axis.normal, points };
        }
    }
    if let Some(witness) = witness
        && let Some(points) = aligned_faces(a, b, witness.normal, margin).filter(|points| is_deep(points))
    {
        return Touch { normal: witness.normal, points };
    }
    match witness {
        Some(witness) => Touch { normal: witness.normal, points: closest_point(a, b, witness) },
        None => Touch { normal: axes.best().normal, points: deepest_point(a, b, axes.best()) },
    }
}

fn preferred(axes: &Axes, overlapping: bool, preference: f64) -> &Axis {
    let face = if axes.face_b.separation > axes.face_a.separation + preference {
        &axes.face_b
    } else {
        &axes.face_a
    };
    if overlapping && axes.edges.separation > face.separation + preference { &axes.edges } else { face }
}

/// The deepest vertex of one shape, and its foot on the other's supporting plane: what is left where a face looks past
/// what touches it.
fn deepest_point(a: &Solid, b: &Solid, axis: &Axis) -> ArrayVec<Point, 4> {
    let (in_a, in_b) = (a.support(axis.normal), b.support(-axis.normal));
    let (on_a, on_b) = (Feature::Vertex(in_a.vertex as u32), Feature::Vertex(in_b.vertex as u32));
    let a_is_foot = Reference { along: axis.normal, facing: axis.normal, reach: in_a.reach, is_b: false };
    let b_is_foot = Reference { along: -axis.normal, facing: -axis.normal, reach: in_b.reach, is_b: true };
    let point = match axis.of {
        AxisOf::FaceA(face) => a_is_foot.contact(b.point(in_b.vertex), (Feature::Face(face as u32), on_b)),
        AxisOf::FaceB(face) => b_is_foot.contact(a.point(in_a.vertex), (Feature::Face(face as u32), on_a)),
        AxisOf::Edges(edge, _) => a_is_foot.contact(b.point(in_b.vertex), (Feature::Edge(edge as u32), on_b)),
    };
    core::iter::once(point).collect()
}

/// Contact points of two faces that look at each other along an axis that is neither's own, if they nearly do.
///
/// A box that rests on a box, tilted by a hair, touches it where two edges cross: one point, which jumps to another
/// corner with the next hair, and on which nothing can stand. The crossing is also a corner of the patch that both
/// faces share as seen along the axis. The patch holds, and keeps the axis and the depth exact.
fn aligned_faces(a: &Solid, b: &Solid, normal: DVec3, within: f64) -> Option<ArrayVec<Point, 4>> {
    if a.is_slender() || b.is_slender() {
        return None;
    }
    let face_a = opposed_face_at(a, a.support(normal).vertex, -normal);
    let face_b = opposed_face_at(b, b.support(-normal).vertex, normal);
    let (facing_a, facing_b) = (a.normal(face_a), b.normal(face_b));
    if facing_a.dot(normal) < ALIGNED_FACES || facing_b.dot(normal) > -ALIGNED_FACES {
        return None;
    }
    let reference =
        Reference { along: normal, facing: facing_a, reach: a.support(facing_a).reach, is_b: false };
    Some(clipped_points((a, face_a), (b, face_b), &reference, within))
}

/// The nearest points of two edges that cross, each held to its edge.
fn edge_point(a: &Solid, b: &Solid, edges: (usize, usize), normal: DVec3) -> ArrayVec<Point, 4> {
    let ((a0, a1), (b0, b1)) = (a.edge(edges.0), b.edge(edges.1));
    let (along_a, along_b, between) = (a1 - a0, b1 - b0, b0 - a0);
    let cross = along_a.cross(along_b);
    // The axis came from this cross product, so it is not zero.
    let inverse = 1.0 / cross.length_squared();
    let s = (between.cross(along_b).dot(cross) * inverse).clamp(0.0, 1.0);
    let t = (between.cross(along_a).dot(cross) * inverse).clamp(0.0, 1.0);
    let (on_a, on_b) = (a0 + along_a * s, b0 + along_b * t);
    let feature = FeatureId::new(Feature::Edge(edges.0 as u32), Feature::Edge(edges.1 as u32));
    core::iter::once(Point { separation: normal.dot(on_b - on_a), on_a, on_b, feature }).collect()
}

/// The witness points of a gap, named by the features that carry them.
fn closest_point(a: &Solid, b: &Solid, witness: &Witness) -> ArrayVec<Point, 4> {
    let carrier = |solid: &Solid, which: usize| {
        let mut vertices: ArrayVec<usize, 4> = witness.corners.iter().map(|corner| corner[which]).collect();
        vertices.sort_unstable();
        let mut last = None;
        vertices.retain(|vertex| last.replace(*vertex) != Some(*vertex));
        feature_of(solid, &vertices)
    };
    let point = Point {
        separation: witness.distance,
        on_a: witness.point_a,
        on_b: witness.point_b,
        feature: FeatureId::new(carrier(a, 0), carrier(b, 1)),
    };
    core::iter::once(point).collect()
}

/// The least feature that holds all of these vertices.
fn feature_of(solid: &Solid, vertices: &[usize]) -> Feature {
    if let &[vertex] = vertices {
        return Feature::Vertex(vertex as u32);
    }
    if let &[one, other] = vertices
        && let Some(edge) = solid.edge_between(one, other)
    {
        return Feature::Edge(edge as u32);
    }
    let holds_all =
        |face: &usize| vertices.iter().all(|v| solid.topology.face_vertices(*face).any(|w| w == *v));
    let face = (0..solid.topology.face_count()).find(holds_all);
    face.map_or(Feature::Vertex(vertices.first().map_or(0, |&v| v as u32)), |face| Feature::Face(face as u32))
}

/// A corner of the polygon being clipped.
#[derive(Clone, Copy)]
struct Corner {
    point: DVec3,
    /// Of the reference shape and of the incident one.
    features: (Feature, Feature),
    /// What the polygon's edge from this corner to the next lies on.
    leaving: Side,
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    /// An edge of the incident face.
    Incident(u32),
    /// A side plane, by the reference half-edge it stands on.
    Reference(usize),
}

/// A plane to measure contact points from: that of the reference face.
struct Reference {
    /// Unit direction out of the reference shape along which separations are measured.
    along: DVec3,
    /// The plane's outward unit normal: most often the same.
    facing: DVec3,
    /// The reference shape's reach along `facing`.
    reach: f64,
    is_b: bool,
}

impl Reference {
    /// The contact of a point of the incident shape with its foot on the plane. Features: the reference's first.
    fn contact(&self, point: DVec3, (of_reference, of_incident): (Feature, Feature)) -> Point {
        let separation = (self.facing.dot(point) - self.reach) / self.facing.dot(self.along);
        let foot = point - self.along * separation;
        if self.is_b {
            Point { separation, on_a: point, on_b: foot, feature: FeatureId::new(of_incident, of_reference) }
        } else {
            Point { separation, on_a: foot, on_b: point, feature: FeatureId::new(of_reference, of_incident) }
        }
    }
}

/// Contact points of a face of `solid` with outward normal `normal`, and the incident shape: those at most `within`
/// outside the face's plane.
fn face_points(
    solid: &Solid,
    incident: &Solid,
    face: usize,
    normal: DVec3,
    within: f64,
    is_b: bool,
) -> ArrayVec<Point, 4> {
    let reference = Reference { along: normal, facing: normal, reach: solid.support(normal).reach, is_b };
    let deepest = incident.support(-normal).vertex;
    let incident_face = opposed_face_at(incident, deepest, normal);
    clipped_points((solid, face), (incident, incident_face), &reference, within)
}

/// Corners of the patch that two faces share as seen along the reference's direction, at most `within` outside its
/// plane, and at most four of them.
fn clipped_points(
    (solid, face): (&Solid, usize),
    (incident, incident_face): (&Solid, usize),
    reference: &Reference,
    within: f64,
) -> ArrayVec<Point, 4> {
    let mut points: ArrayVec<Point, MAX_CORNERS> = ArrayVec::new();
    let mut rings = [Ring::new_const(), Ring::new_const()];
    for corner in clip((solid, face), (incident, incident_face), reference.along, &mut rings) {
        let new = reference.contact(corner.point, corner.features);
        let is_new = points.iter().all(|known| known.feature != new.feature);
        if new.separation <= within && is_new {
            points.push(new);
        }
    }
    reduce_to_four(&points, reference.along)
}

/// Of the faces around a vertex, the one that looks most against `normal`. A point or segment has one loop, which is it.
pub(super) fn opposed_face_at(solid: &Solid, vertex: usize, normal: DVec3) -> usize {
    if solid.is_slender() {
        return 0;
    }
    let mut best = (f64::INFINITY, 0);
    for half_edge in solid.topology.half_edges().iter().filter(|h| h.origin as usize == vertex) {
        let facing = solid.normal(half_edge.face as usize).dot(normal);
        if (facing, half_edge.face as usize) < best {
            best = (facing, half_edge.face as usize);
        }
    }
    best.1
}

/// A polygon being clipped. Large, so that any two faces fit: it is filled in place and never moved.
type Ring = ArrayVec<Corner, MAX_CORNERS>;

/// The incident face cut by the side planes of the reference face: Sutherland and Hodgman, "Reentrant polygon
/// clipping" (1974). Returns whichever of the two rings holds the result.
fn clip<'a>(
    (reference, face): (&Solid, usize),
    (incident, incident_face): (&Solid, usize),
    normal: DVec3,
    rings: &'a mut [Ring; 2],
) -> &'a Ring {
    let [mut polygon, mut clipped] = rings.each_mut();
    for half_edge in incident.topology.face_half_edges(incident_face) {
        let vertex = incident.topology.ends(half_edge).0;
        polygon.push(Corner {
            point: incident.point(vertex),
            features: (Feature::Face(face as u32), Feature::Vertex(vertex as u32)),
            leaving: Side::Incident(incident.topology.edge_of(half_edge) as u32),
        });
    }
    for half_edge in reference.topology.face_half_edges(face) {
        let from = reference.point(reference.topology.ends(half_edge).0);
        let outward = reference.edge_direction(half_edge).cross(normal);
        clipped.clear();
        for (i, &here) in polygon.iter().enumerate() {
            let there = polygon[if i + 1 == polygon.len() { 0 } else { i + 1 }];
            let (d_here, d_there) = (outward.dot(here.point - from), outward.dot(there.point - from));
            if d_here <= 0.0 {
                let _ = clipped.try_push(here);
            }
            if (d_here <= 0.0) != (d_there <= 0.0) {
                let point = here.point + (there.point - here.point) * (d_here / (d_here - d_there));
                let features = crossing(reference, here.leaving, half_edge, incident_face);
                // Going out, the polygon follows the side plane from here; coming in, it follows its old edge.
                let leaving = if d_here <= 0.0 { Side::Reference(half_edge) } else { here.leaving };
                let _ = clipped.try_push(Corner { point, features, leaving });
            }
        }
        core::mem::swap(&mut polygon, &mut clipped);
    }
    polygon
}

/// Features of the corner where a side of the polygon meets the side plane on `half_edge`.
fn crossing(reference: &Solid, side: Side, half_edge: usize, incident_face: usize) -> (Feature, Feature) {
    match side {
        Side::Incident(edge) => {
            (Feature::Edge(reference.topology.edge_of(half_edge) as u32), Feature::Edge(edge))
        }
        Side::Reference(other) => {
            // Two side planes meet over a vertex of the reference face: the one that both edges have.
            let (from, to) = reference.topology.ends(half_edge);
            let (other_from, other_to) = reference.topology.ends(other);
            let shared = if to == other_from || to == other_to { to } else { from };
            (Feature::Vertex(shared as u32), Feature::Face(incident_face as u32))
        }
    }
}
