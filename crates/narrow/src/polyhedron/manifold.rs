//! Where two polyhedra touch: up to four points on one normal.
//!
//! ```text
//! choose what touches: a face of A unless a face of B, or two edges, beat it by more than a relative preference
//! two edges:  the faces beside them, if they nearly look at each other; else the nearest points of their lines
//! a face:     the other shape's incident face is the one most opposed, of those at its deepest vertex
//!             clip it against planes through the reference face's edges, along the normal
//!             keep the points within the margin of the reference plane
//! if the deepest point was clipped away, ask the axis that is best of all; then, in a gap, the faces that nearly look at
//! each other across it; then edges that lie side by side; then the witness points
//! reduce to four
//! ```
//! All of that is done with the shapes' cores, and the points are then moved out to the surfaces: what is deepest,
//! along the normal; a corner of a tilted face that is less deep, along that face's own normal, since the shape's
//! surface beyond it looks that way.
//!
//! Side planes are made from the reference face's own edges and not from neighbouring faces, so that a face which is
//! flat only up to rounding clips like one that is flat. Every corner of the clipped polygon carries the features it
//! comes from, which is what makes its id.

use super::distance::Witness;
use super::reduce::reduce_to_four;
use super::rods::side_by_side;
use super::sat::{Axes, Axis, AxisOf};
use super::solid::Solid;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::{ALIGNED_FACES, MAX_HULL_VERTICES};

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

impl Point {
    /// A point where two cores are closest, moved out to the surfaces along the normal.
    pub(super) fn on_surfaces(self, a: &Solid, b: &Solid, normal: DVec3) -> Self {
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
    let deep = at_stake + preference;
    let least = deep - a.radius - b.radius;
    let is_deep = |points: &ArrayVec<Point, 4>| points.iter().any(|point| point.separation <= least);
    for axis in [preferred(axes, overlapping, preference), axes.best()] {
        if axis.separation < at_stake - preference {
            continue;
        }
        // Everything as deep as the deepest vertex up to rounding belongs to the manifold, also where that is no
        // deeper than zero: a body that rests exactly on a face rests on all of its corners.
        let depths = Depths { deep, within: margin.max(least), slack: preference };
        let points = match axis.of {
            AxisOf::FaceA(face) => face_points(a, b, face, axis.normal, depths, false),
            AxisOf::FaceB(face) => face_points(b, a, face, -axis.normal, depths, true),
            AxisOf::Edges(..) if !overlapping => continue,
            AxisOf::Edges(edge_a, edge_b) => aligned_faces(a, b, axis.normal, depths)
                .filter(is_deep)
                .unwrap_or_else(|| edge_point(a, b, (edge_a, edge_b), axis.normal)),
        };
        if is_deep(&points) {
            return Touch { normal: axis.normal, points };
        }
    }
    if let Some(witness) = witness {
        let within = margin.max(least);
        let normal = witness.across;
        let faces = aligned_faces(a, b, normal, Depths { deep, within, slack: preference }).filter(is_deep);
        let points = faces.or_else(|| side_by_side((a, b), normal, at_stake, within, preference));
        if let Some(points) = points {
            return Touch { normal, points };
        }
    }
    match witness {
        Some(witness) => Touch { normal: witness.across, points: closest_point(a, b, witness) },
        None => Touch { normal: axes.best().normal, points: deepest_point(a, b, axes.best()) },
    }
}

/// Which corners of a patch become points, in metres.
#[derive(Clone, Copy)]
struct Depths {
    /// Corners of the cores no further apart than this are as deep as any.
    deep: f64,
    /// Points of the shapes no further apart than this are wanted.
    within: f64,
    /// Vertices that differ by no more are as far as each other.
    slack: f64,
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
    let (a_is_foot, b_is_foot) = (
        Reference::of(a, axis.normal, axis.normal, false),
        Reference::of(b, -axis.normal, -axis.normal, true),
    );
    let (low_a, low_b) = (a.point(in_a.vertex), b.point(in_b.vertex));
    let point = match axis.of {
        AxisOf::FaceA(face) => a_is_foot.lowest(low_b, b.radius, (Feature::Face(face as u32), on_b)),
        AxisOf::FaceB(face) => b_is_foot.lowest(low_a, a.radius, (Feature::Face(face as u32), on_a)),
        AxisOf::Edges(edge, _) => a_is_foot.lowest(low_b, b.radius, (Feature::Edge(edge as u32), on_b)),
    };
    core::iter::once(point).collect()
}

/// Contact points of two faces that look at each other along an axis that is neither's own, if they nearly do.
///
/// A box that rests on a box, tilted by a hair, touches it where two edges cross: one point, which jumps to another
/// corner with the next hair, and on which nothing can stand. The crossing is also a corner of the patch that both
/// faces share as seen along the axis. The patch holds, and keeps the axis and the depth exact.
fn aligned_faces(a: &Solid, b: &Solid, normal: DVec3, depths: Depths) -> Option<ArrayVec<Point, 4>> {
    if a.is_slender() || b.is_slender() {
        return None;
    }
    let face_a = opposed_face(a, -normal, depths.slack);
    let face_b = opposed_face(b, normal, depths.slack);
    let (facing_a, facing_b) = (a.normal(face_a), b.normal(face_b));
    if facing_a.dot(normal) < ALIGNED_FACES || facing_b.dot(normal) > -ALIGNED_FACES {
        return None;
    }
    let reference = Reference::of(a, normal, facing_a, false);
    Some(clipped_points((a, face_a), (b, face_b), &reference, depths))
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
    let point = Point { separation: normal.dot(on_b - on_a), on_a, on_b, feature };
    core::iter::once(point.on_surfaces(a, b, normal)).collect()
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
    core::iter::once(point.on_surfaces(a, b, witness.across)).collect()
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

/// A plane to measure contact points from: that of the reference face's surface.
struct Reference {
    /// Unit direction out of the reference shape along which separations are measured.
    along: DVec3,
    /// The plane's outward unit normal: most often the same.
    facing: DVec3,
    /// How far the core reaches along `facing`.
    reach: f64,
    /// How far the surface lies beyond the core.
    radius: f64,
    is_b: bool,
}

impl Reference {
    fn of(solid: &Solid, along: DVec3, facing: DVec3, is_b: bool) -> Self {
        Self { along, facing, reach: solid.support(facing).reach, radius: solid.radius, is_b }
    }

    /// Height of a point over the core's plane, along the direction of measurement.
    fn height(&self, point: DVec3) -> f64 {
        (self.facing.dot(point) - self.reach) / self.facing.dot(self.along)
    }

    /// The contact of a point of the other shape's core with its foot on the core's plane, both moved out to the
    /// surfaces along the direction of measurement. Features: the reference's first.
    fn lowest(&self, point: DVec3, radius: f64, features: (Feature, Feature)) -> Point {
        let height = self.height(point);
        let foot = point - self.along * (height - self.radius);
        self.contact(foot, point - self.along * radius, height - self.radius - radius, features)
    }

    /// The contact of a point of the other shape's surface with its foot on this surface's plane.
    fn over_surface(&self, point: DVec3, features: (Feature, Feature)) -> Point {
        let separation = self.height(point) - self.radius / self.facing.dot(self.along);
        self.contact(point - self.along * separation, point, separation, features)
    }

    fn contact(
        &self,
        foot: DVec3,
        point: DVec3,
        separation: f64,
        (of_reference, of_incident): (Feature, Feature),
    ) -> Point {
        if self.is_b {
            Point { separation, on_a: point, on_b: foot, feature: FeatureId::new(of_incident, of_reference) }
        } else {
            Point { separation, on_a: foot, on_b: point, feature: FeatureId::new(of_reference, of_incident) }
        }
    }
}

/// Contact points of a face of `solid` with outward normal `normal`, and the incident shape.
fn face_points(
    solid: &Solid,
    incident: &Solid,
    face: usize,
    normal: DVec3,
    depths: Depths,
    is_b: bool,
) -> ArrayVec<Point, 4> {
    let reference = Reference::of(solid, normal, normal, is_b);
    let incident_face = opposed_face(incident, normal, depths.slack);
    clipped_points((solid, face), (incident, incident_face), &reference, depths)
}

/// Corners of the patch that two faces share as seen along the reference's direction, and at most four of them.
fn clipped_points(
    (solid, face): (&Solid, usize),
    (incident, incident_face): (&Solid, usize),
    reference: &Reference,
    depths: Depths,
) -> ArrayVec<Point, 4> {
    let mut points: ArrayVec<Point, MAX_CORNERS> = ArrayVec::new();
    let mut rings = [Ring::new_const(), Ring::new_const()];
    let mut offer = |new: Point| {
        // Where edges run over corners, several features meet in one place: the first names it.
        let is_known =
            |known: &Point| known.feature == new.feature || (known.on_a - new.on_a).length() <= depths.slack;
        if new.separation <= depths.within && !points.iter().any(is_known) {
            let _ = points.try_push(new);
        }
    };
    let is_sharp = solid.radius + incident.radius == 0.0;
    let sides = [DVec3::ZERO; 2];
    for corner in clip((solid, face), (incident, incident_face), reference.along, sides, &mut rings) {
        if is_sharp || reference.height(corner.point) <= depths.deep {
            offer(reference.lowest(corner.point, incident.radius, corner.features));
        }
    }
    // What is less deep belongs to a tilted face, and lies out along its normal; there the corners are cut again.
    let outwards = incident.outwards(incident_face, -reference.along).filter(|_| !is_sharp);
    if let Some(outwards) = outwards {
        let sides = [reference.facing * solid.radius, outwards * incident.radius];
        for corner in clip((solid, face), (incident, incident_face), reference.along, sides, &mut rings) {
            offer(reference.over_surface(corner.point, corner.features));
        }
    }
    reduce_to_four(&points, reference.along)
}

/// The face with which a shape looks against `normal`: of those that have the most of its furthest vertices, the most
/// opposed. Vertices within `slack` of the furthest are as far. A point or segment has one loop, which is it.
///
/// Of two vertices that are equally far, one may have a third face that is more opposed than both of their edge's
/// own; what touches may be at the other.
pub(super) fn opposed_face(solid: &Solid, normal: DVec3, slack: f64) -> usize {
    if solid.is_slender() {
        return 0;
    }
    debug_assert!(slack >= 0.0, "no vertex would be far");
    let least = solid.support(-normal).reach - slack.max(0.0);
    let is_far: ArrayVec<bool, MAX_HULL_VERTICES> =
        (0..solid.vertices.len()).map(|vertex| -normal.dot(solid.point(vertex)) >= least).collect();
    let mut best = (0, f64::INFINITY, 0);
    for face in 0..solid.face_count() {
        let far = solid.topology.face_vertices(face).filter(|&vertex| is_far[vertex]).count();
        if far < best.0 || far == 0 {
            continue;
        }
        let facing = solid.normal(face).dot(normal);
        if far > best.0 || facing < best.1 {
            best = (far, facing, face);
        }
    }
    best.2
}

/// A polygon being clipped. Large, so that any two faces fit: it is filled in place and never moved.
type Ring = ArrayVec<Corner, MAX_CORNERS>;

/// The incident face cut by the side planes of the reference face: Sutherland and Hodgman, "Reentrant polygon
/// clipping" (1974). Both faces are moved by `sides` first. Returns whichever of the two rings holds the result.
fn clip<'a>(
    (reference, face): (&Solid, usize),
    (incident, incident_face): (&Solid, usize),
    normal: DVec3,
    sides: [DVec3; 2],
    rings: &'a mut [Ring; 2],
) -> &'a Ring {
    let [mut polygon, mut clipped] = rings.each_mut();
    polygon.clear();
    for half_edge in incident.topology.face_half_edges(incident_face) {
        let vertex = incident.topology.ends(half_edge).0;
        polygon.push(Corner {
            point: incident.point(vertex) + sides[1],
            features: (Feature::Face(face as u32), Feature::Vertex(vertex as u32)),
            leaving: Side::Incident(incident.topology.edge_of(half_edge) as u32),
        });
    }
    for half_edge in reference.topology.face_half_edges(face) {
        let from = reference.point(reference.topology.ends(half_edge).0) + sides[0];
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
