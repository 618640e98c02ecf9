//! The feature of a solid that is furthest in a direction, where that is more than a vertex: whole edges between bodies
//! that stand upright side by side, whole faces of bodies that lie on something.
//!
//! Which of its vertices counts as the furthest is then chosen by rounding, and that vertex may lie beyond the end of
//! the face that it is tested against, though most of the edge is over the face.

use super::super::solid::Solid;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::MAX_HULL_VERTICES;

/// Most corners of a face that is taken as a whole; of larger faces, an edge is taken.
const MOST: usize = 8;

/// Most corners of both faces together where one is clipped by the other.
const MOST_CUT: usize = 24;

/// The deepest edge (two vertices) or face (its vertices, in order) of a solid against a direction; empty where a
/// vertex is alone.
pub(super) struct Level {
    vertices: ArrayVec<usize, MOST>,
}

impl Level {
    pub(super) const NONE: Self = Self { vertices: ArrayVec::new_const() };

    /// The feature around the deepest vertex against an outward direction: vertices that are higher by no more than
    /// `slack` metres.
    #[inline]
    pub(super) fn around(solid: &Solid, deepest: usize, outward: DVec3, slack: f64) -> Self {
        let mut vertices = ArrayVec::new_const();
        let local = solid.turned_back(outward);
        let place = |vertex: usize| local.dot(solid.vertices[vertex].as_dvec3());
        let most = place(deepest) + slack;
        let mut neighbour = None;
        for &half_edge in solid.topology.leaving(deepest) {
            let (_, to) = solid.topology.ends(half_edge.into());
            // A ball's core is one vertex, and its only edge leads back to it.
            if to == deepest || place(to) > most {
                continue;
            }
            let face = solid.topology.half_edges()[usize::from(half_edge)].face as usize;
            let around = solid.topology.face_vertices(face);
            // Of a flat solid, only the side that faces there.
            if !solid.is_slender()
                && around.len() <= MOST
                && around.clone().all(|vertex| place(vertex) <= most)
                && solid.normal(face).dot(outward) < 0.0
            {
                vertices.extend(around);
                return Self { vertices };
            }
            neighbour = neighbour.or(Some(to));
        }
        if let Some(to) = neighbour {
            vertices.extend([deepest, to]);
        }
        Self { vertices }
    }

    /// Whether a vertex is alone.
    #[inline]
    pub(super) fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The vertices' numbers.
    pub(super) fn vertices(&self) -> &[usize] {
        &self.vertices
    }

    fn points<'a>(&'a self, solid: &'a Solid) -> impl Iterator<Item = DVec3> + Clone + 'a {
        self.vertices.iter().map(|&vertex| solid.point(vertex))
    }

    /// How far the origin is inside the difference of a face and this feature, as seen along the face's outward normal;
    /// negative where it is outside.
    ///
    /// The sides of the difference of two polygons are the sides of both, each with the other polygon's vertex that is
    /// furthest out across it.
    pub(super) fn in_difference(&self, (solid, face): (&Solid, usize), outward: DVec3, other: &Solid) -> f64 {
        // Each point is transformed once, and used once a side of the other polygon. Filled in place: collecting would
        // copy their full capacity.
        let mut corners = ArrayVec::<DVec3, MAX_HULL_VERTICES>::new_const();
        corners.extend(solid.topology.face_vertices(face).map(|vertex| solid.point(vertex)));
        let mut own = ArrayVec::<DVec3, MOST>::new_const();
        own.extend(self.points(other));
        let mut least = f64::INFINITY;
        // Seen from the face's side the feature's sides go the other way around.
        let (on_face, on_own) =
            (sides(corners.iter().copied(), outward), sides(own.iter().copied(), -outward));
        for (from, inwards) in on_face {
            let inside = own.iter().map(|point| inwards.dot(*point - from)).fold(f64::NEG_INFINITY, f64::max);
            least = least.min(share_of(inside, inwards));
        }
        for (from, inwards) in on_own {
            let inside =
                corners.iter().map(|point| inwards.dot(*point - from)).fold(f64::NEG_INFINITY, f64::max);
            least = least.min(share_of(inside, inwards));
        }
        if least > 0.0 && least.is_finite() { least.sqrt() } else { f64::NEG_INFINITY }
    }

    /// The middle of the part of this feature that lies over a face, as seen along the face's outward normal, if any
    /// does.
    ///
    /// Sutherland and Hodgman, "Reentrant polygon clipping" (1974).
    pub(super) fn middle_over(
        &self,
        (solid, face): (&Solid, usize),
        outward: DVec3,
        other: &Solid,
    ) -> Option<DVec3> {
        let corners = solid.topology.face_vertices(face);
        if self.vertices.len() + corners.len() > MOST_CUT {
            return None;
        }
        let mut left = ArrayVec::<DVec3, MOST_CUT>::new_const();
        left.extend(self.points(other));
        let mut whole = ArrayVec::new_const();
        for (from, inwards) in sides(corners.map(|vertex| solid.point(vertex)), outward) {
            // Most sides clip nothing.
            if left.iter().all(|&point| inwards.dot(point - from) >= 0.0) {
                continue;
            }
            whole.clone_from(&left);
            left.clear();
            let mut before = *whole.last()?;
            let mut depth = inwards.dot(before - from);
            for &point in &whole {
                let next = inwards.dot(point - from);
                if (depth < 0.0) != (next < 0.0) {
                    left.try_push(before + (point - before) * (depth / (depth - next))).ok()?;
                }
                if next >= 0.0 {
                    left.try_push(point).ok()?;
                }
                (before, depth) = (point, next);
            }
        }
        let middle = left.iter().fold(DVec3::ZERO, |sum, point| sum + *point) / left.len() as f64;
        (!left.is_empty()).then_some(middle)
    }
}

/// The sides of a polygon: a corner and the inward direction there, as long as the side. Two corners have two sides,
/// there and back.
fn sides(
    corners: impl Iterator<Item = DVec3> + Clone,
    outward: DVec3,
) -> impl Iterator<Item = (DVec3, DVec3)> {
    let first = corners.clone().next();
    let next = corners.clone().skip(1).chain(first);
    corners.zip(next).map(move |(from, to)| (from, outward.cross(to - from)))
}

/// The square of how far something is inside a side; -inf where it is outside, or the side has no length.
fn share_of(inside: f64, inwards: DVec3) -> f64 {
    let square = inside * inside / inwards.length_squared();
    if inside > 0.0 && square.is_finite() { square } else { f64::NEG_INFINITY }
}
