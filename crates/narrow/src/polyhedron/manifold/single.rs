//! A single contact point, where no two faces share a patch.

use super::super::distance::Witness;
use super::super::sat::{Axis, AxisOf};
use super::super::solid::Solid;
use super::Point;
use super::over::point_over;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::tolerance::ALIGNED_FACES;

/// The contact point of two edges that cross: the nearest points of the two segments.
///
/// Ericson, "Real-time collision detection" (2005), 5.1.9: where one point is clamped to an end, the other is the foot
/// of that end. If the edges do not lie over each other, they are not what touches: see [`point_over`].
pub(super) fn edge_point(a: &Solid, b: &Solid, edges: (usize, usize), axis: &Axis, slack: f64) -> Point {
    let normal = axis.normal;
    let ((a0, a1), (b0, b1)) = (a.edge(edges.0), b.edge(edges.1));
    let (along_a, along_b, between) = (a1 - a0, b1 - b0, b0 - a0);
    let cross = along_a.cross(along_b);
    // The axis came from this cross product, so it is not zero.
    let inverse = 1.0 / cross.length_squared();
    let s = (between.cross(along_b).dot(cross) * inverse).clamp(0.0, 1.0);
    let unheld = between.cross(along_a).dot(cross) * inverse;
    let foot_on_b = (along_a * s - between).dot(along_b) / along_b.length_squared();
    let t = if s > 0.0 && s < 1.0 { unheld } else { foot_on_b };
    let held = t.clamp(0.0, 1.0);
    let foot_on_a = || (along_b * held + between).dot(along_a) / along_a.length_squared();
    let s = if held == t { s } else { foot_on_a().clamp(0.0, 1.0) };
    let (on_a, on_b) = (a0 + along_a * s, b0 + along_b * held);
    let feature = FeatureId::new(Feature::Edge(edges.0 as u32), Feature::Edge(edges.1 as u32));
    let separation = normal.dot(on_b - on_a);
    let mut point = Point { separation, on_a, on_b, feature };
    let aside_squared = (on_b - on_a - normal * separation).length_squared();
    if aside_squared > slack * slack
        && let Some((over, aside)) = point_over(a, b, axis, slack)
        && aside * aside < aside_squared
    {
        point = over;
    }
    point.on_surfaces([a.radius, b.radius], normal)
}

/// The deepest vertex of one shape and its foot on the other's supporting plane: the fallback where a face is not over
/// what touches it. If other features that are as deep lie over each other, a point of those is returned instead.
pub(super) fn deepest_point(a: &Solid, b: &Solid, axis: &Axis, slack: f64) -> Point {
    if let Some((over, _)) = point_over(a, b, axis, slack) {
        return over.on_surfaces([a.radius, b.radius], axis.normal);
    }
    let Axis { separation, normal, of } = *axis;
    let point = match of {
        AxisOf::FaceB(face) => {
            let vertex = a.support(normal).vertex;
            let on_a = a.point(vertex);
            let feature = FeatureId::new(Feature::Vertex(vertex as u32), Feature::Face(face as u32));
            Point { separation, on_a, on_b: on_a + normal * separation, feature }
        }
        AxisOf::FaceA(_) | AxisOf::Edges(..) => {
            let vertex = b.support(-normal).vertex;
            let on_b = b.point(vertex);
            let of_a = match of {
                AxisOf::Edges(edge, _) => Feature::Edge(edge as u32),
                AxisOf::FaceA(face) | AxisOf::FaceB(face) => Feature::Face(face as u32),
            };
            let feature = FeatureId::new(of_a, Feature::Vertex(vertex as u32));
            Point { separation, on_a: on_b - normal * separation, on_b, feature }
        }
    };
    point.on_surfaces([a.radius, b.radius], normal)
}

/// The witness points of a gap, named by the features that carry them.
pub(super) fn closest_point(a: &Solid, b: &Solid, witness: &Witness) -> Point {
    let [of_a, of_b] = carriers(a, b, witness);
    let point = Point {
        separation: witness.distance,
        on_a: witness.point_a,
        on_b: witness.point_b,
        feature: FeatureId::new(of_a, of_b),
    };
    point.on_surfaces([a.radius, b.radius], witness.across)
}

/// The edges that the witness points of a gap lie on; `None` unless both lie on edges, and for edges side by side,
/// which have no axis.
pub(in super::super) fn nearest_edges(a: &Solid, b: &Solid, witness: &Witness) -> Option<AxisOf> {
    let [Feature::Edge(edge_a), Feature::Edge(edge_b)] = carriers(a, b, witness) else { return None };
    let (edge_a, edge_b) = (edge_a as usize, edge_b as usize);
    let do_cross = !are_side_by_side((a, edge_a), (b, edge_b));
    do_cross.then_some(AxisOf::Edges(edge_a, edge_b))
}

/// Whether two edges are so nearly parallel that an axis across them is of no use.
pub(in super::super) fn are_side_by_side((a, edge_a): (&Solid, usize), (b, edge_b): (&Solid, usize)) -> bool {
    let (along_a, along_b) = (a.edge_direction(edge_a), b.edge_direction(edge_b));
    let (cosine, squares) = (along_a.dot(along_b), along_a.length_squared() * along_b.length_squared());
    cosine * cosine >= ALIGNED_FACES * ALIGNED_FACES * squares
}

/// The lowest-dimensional features that hold the witness points.
fn carriers(a: &Solid, b: &Solid, witness: &Witness) -> [Feature; 2] {
    [(a, 0), (b, 1)].map(|(solid, which)| {
        let mut vertices: ArrayVec<usize, 4> = witness.corners.iter().map(|corner| corner[which]).collect();
        vertices.sort_unstable();
        let mut last = None;
        vertices.retain(|vertex| last.replace(*vertex) != Some(*vertex));
        feature_of(solid, &vertices)
    })
}

/// The lowest-dimensional feature that holds all of these vertices.
pub(super) fn feature_of(solid: &Solid, vertices: &[usize]) -> Feature {
    let vertex = Feature::Vertex(vertices.first().map_or(0, |&v| v as u32));
    let (&[first, ..], topology) = (vertices, solid.topology) else { return vertex };
    if let &[one, other] = vertices
        && let Some(&half_edge) = topology.leaving(one).iter().find(|&&h| topology.ends(h.into()).1 == other)
    {
        return Feature::Edge(topology.edge_of(half_edge.into()) as u32);
    }
    let holds_all = |face: &usize| vertices.iter().all(|v| topology.face_vertices(*face).any(|w| w == *v));
    let face_of = |&half_edge: &u16| usize::from(topology.half_edges()[usize::from(half_edge)].face);
    match topology.leaving(first).iter().map(face_of).find(holds_all) {
        Some(face) if vertices.len() > 1 => Feature::Face(face as u32),
        _ => vertex,
    }
}
