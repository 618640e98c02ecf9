//! A gap found from what separated the solids in the last frame: no search, no iteration, no other axis.
//!
//! ```text
//! a point of each solid     the solids' distance is no more than that of the points
//! an axis                   it is no less than the separation along the axis, all vertices projected
//! both agree                that is the distance, whatever the points and the axis were guessed from
//! ```
//! The guesses are: a vertex straight over a face; the middle of an edge or a face that is level with a face below it;
//! two edges that cross; edges side by side; corners. For bodies at rest nearly all guesses are right. Two cuboids or
//! hulls of 32 vertices in a gap took 2.4 to 9 us, and take 0.7 to 1.6 with their contact points (AMD EPYC, Zen 4,
//! 2026-11-21).

use super::super::distance::{CLEAR_GAP, Witness};
use super::super::manifold::are_side_by_side;
use super::super::solid::Solid;
use super::facet::in_face;
use super::hinted::Hinted;
use super::level::Level;
use super::{Axes, Axis, AxisOf};
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

impl Hinted {
    /// This axis and the closest points of solids separated by a gap, if it is the axis of their distance: the deepest
    /// vertex lies straight over the face, or the two edges cross.
    ///
    /// The separation along the axis bounds the distance from below, any pair of points bounds it from above; both
    /// bounds must agree up to rounding. No search, no iteration, and no other axis.
    pub(crate) fn across(&self, (a, b): (&Solid, &Solid), precision: &Precision) -> Option<(Axes, Witness)> {
        let Axis { separation, normal, of } = self.axis;
        let doubt = 8.0 * precision.projection();
        if separation <= doubt {
            return None;
        }
        let (points, corners, distance) = match of {
            AxisOf::FaceA(face) => {
                let Over { point, foot, distance, corners } =
                    over_face((a, face), normal, (b, self.deepest), (separation, doubt))?;
                ([foot, point], corners, distance)
            }
            AxisOf::FaceB(face) => {
                let Over { point, foot, distance, corners } =
                    over_face((b, face), -normal, (a, self.deepest), (separation, doubt))?;
                ([point, foot], corners.into_iter().map(|[b, a]| [a, b]).collect(), distance)
            }
            AxisOf::Edges(edge_a, edge_b) => {
                let (points, corners) = nearest_of_edges((a, edge_a), (b, edge_b));
                (points, corners.into_iter().collect(), (points[1] - points[0]).length())
            }
        };
        let do_meet = distance - separation <= (DISTANCE_GAP * precision.size).max(doubt);
        if !do_meet {
            return None;
        }
        let mut axes = Axes::NONE;
        axes.offer(self.axis);
        let [point_a, point_b] = points;
        let at_least = separation;
        Some((axes, Witness { distance, at_least, normal, across: normal, point_a, point_b, corners }))
    }
}

/// [`Hinted::across`] for a direction that separated the solids in the last frame. Finds the nearest points of two
/// edges at the support vertices along it; the axis from one point to the other must show their distance.
///
/// That covers edges side by side, whose cross product is no axis, and corners.
pub(crate) fn across_edges(
    (a, b): (&Solid, &Solid),
    direction: DVec3,
    precision: &Precision,
) -> Option<(Axes, Witness)> {
    let edge_a = edge_across(a, a.support(direction).vertex, direction)?;
    let edge_b = edge_across(b, b.support(-direction).vertex, direction)?;
    let ([point_a, point_b], corners) = nearest_of_edges((a, edge_a), (b, edge_b));
    // Edges that cross have an axis of their own, and a hint that names it.
    let [[from_a, from_b], [to_a, to_b]] = corners;
    let do_cross = from_a != to_a && from_b != to_b && !are_side_by_side((a, edge_a), (b, edge_b));
    if do_cross {
        return None;
    }
    let distance = (point_b - point_a).length();
    // Where the points are so close that the axis is rounding, or not a number, slower methods decide.
    let is_clear = distance > CLEAR_GAP * precision.size;
    if !is_clear {
        return None;
    }
    let normal = (point_b - point_a) / distance;
    let at_least = -b.support(-normal).reach - a.support(normal).reach;
    let do_meet = distance - at_least <= (DISTANCE_GAP * precision.size).max(8.0 * precision.projection());
    let corners = corners.into_iter().collect();
    let witness = Witness { distance, at_least, normal, across: normal, point_a, point_b, corners };
    do_meet.then_some((Axes::NONE, witness))
}

/// The edge at a vertex that is most nearly perpendicular to a direction.
fn edge_across(solid: &Solid, vertex: usize, direction: DVec3) -> Option<usize> {
    let local = solid.turned_back(direction);
    let mut best = (f64::INFINITY, None);
    for &half_edge in solid.topology.leaving(vertex) {
        let (from, to) = solid.topology.ends(half_edge.into());
        let along = solid.vertices[to].as_dvec3() - solid.vertices[from].as_dvec3();
        let lean = local.dot(along);
        let share = lean * lean / along.length_squared();
        if share < best.0 {
            best = (share, Some(solid.topology.edge_of(half_edge.into())));
        }
    }
    best.1
}

/// The nearest points of two edges, and the vertices that carry them.
///
/// Where an end is nearest, it is computed and reported as that vertex alone, whichever of its edges was given.
fn nearest_of_edges(
    (a, edge_a): (&Solid, usize),
    (b, edge_b): (&Solid, usize),
) -> ([DVec3; 2], [[usize; 2]; 2]) {
    let (ends_a, ends_b) = (a.topology.ends(edge_a), b.topology.ends(edge_b));
    let (along_a, along_b) = (a.edge(edge_a), b.edge(edge_b));
    let shares = nearest_on_edges(along_a, along_b);
    let end = |share: f64, (from, to): (usize, usize)| match share {
        0.0 => Some(from),
        1.0 => Some(to),
        _ => None,
    };
    let between = |(from, to): (DVec3, DVec3), share: f64| from + (to - from) * share;
    let (points, of_a, of_b) = match (end(shares[0], ends_a), end(shares[1], ends_b)) {
        (Some(v), Some(w)) => ([a.point(v), b.point(w)], (v, v), (w, w)),
        (Some(v), None) => ([a.point(v), foot(along_b, a.point(v))], (v, v), ends_b),
        (None, Some(w)) => ([foot(along_a, b.point(w)), b.point(w)], ends_a, (w, w)),
        (None, None) => ([between(along_a, shares[0]), between(along_b, shares[1])], ends_a, ends_b),
    };
    (points, [[of_a.0, of_b.0], [of_a.1, of_b.1]])
}

/// The point of an edge that is nearest to another point.
fn foot((from, to): (DVec3, DVec3), point: DVec3) -> DVec3 {
    let along = to - from;
    from + along * ((point - from).dot(along) / along.length_squared()).clamp(0.0, 1.0)
}

/// A point of one solid over a face of another.
struct Over {
    point: DVec3,
    /// Its projection on the face's plane.
    foot: DVec3,
    /// An upper bound on the distance of the solids.
    distance: f64,
    /// Vertices of the face and of the other solid that carry both points.
    corners: ArrayVec<[usize; 2], 4>,
}

/// The other solid's deepest vertex, if it lies over a face; else the middle of the part of its deepest edge or face
/// that does.
fn over_face(
    (solid, face): (&Solid, usize),
    outward: DVec3,
    (other, deepest): (&Solid, usize),
    (separation, doubt): (f64, f64),
) -> Option<Over> {
    let carriers = solid.topology.face_vertices(face).take(3);
    let point = other.point(deepest);
    if let Some(sunk) = sunk_below(solid, face, (outward, point), doubt) {
        let corners = carriers.map(|vertex| [vertex, deepest]).collect();
        return Some(Over {
            point,
            foot: point - outward * separation,
            distance: separation + sunk,
            corners,
        });
    }
    // What is level with the deepest vertex up to rounding.
    let level = Level::around(other, deepest, outward, 0.125 * doubt);
    let point = level.middle_over((solid, face), outward, other)?;
    let sunk = sunk_below(solid, face, (outward, point), doubt)?;
    let height = separation.max(outward.dot(point) - solid.face_reach(face, outward));
    let corners = carriers.zip(level.vertices().iter().cycle()).map(|(vertex, &own)| [vertex, own]).collect();
    Some(Over { point, foot: point - outward * height, distance: height + sunk, corners })
}

/// How far a face may lie below its plane under a point: no further than its lowest corner. `None` unless the point, as
/// seen along the outward normal, is inside the face by more than `doubt`.
fn sunk_below(solid: &Solid, face: usize, (outward, point): (DVec3, DVec3), doubt: f64) -> Option<f64> {
    let is_over = in_face((solid, face), outward, point) > doubt;
    if !is_over {
        return None;
    }
    let heights = solid.topology.face_vertices(face).map(|vertex| outward.dot(solid.point(vertex)));
    Some((solid.face_reach(face, outward) - heights.fold(f64::INFINITY, f64::min)).max(0.0))
}

/// The nearest points of two edges, as parameters from 0 to 1 along them.
///
/// Ericson, "Real-time collision detection" (2005), 5.1.9. For parallel edges any nearest points will do.
fn nearest_on_edges((a0, a1): (DVec3, DVec3), (b0, b1): (DVec3, DVec3)) -> [f64; 2] {
    let (along_a, along_b, between) = (a1 - a0, b1 - b0, b0 - a0);
    let (square_a, square_b) = (along_a.length_squared(), along_b.length_squared());
    let cross = along_a.cross(along_b);
    let area = cross.length_squared();
    let s = if area > 0.0 { between.cross(along_b).dot(cross) / area } else { 0.0 };
    let t = (along_a * s.clamp(0.0, 1.0) - between).dot(along_b) / square_b;
    let held = t.clamp(0.0, 1.0);
    let s = (along_b * held + between).dot(along_a) / square_a;
    [s.clamp(0.0, 1.0), held]
}
