//! An edge or corner of ground against the face that a part turns to it: the fast path with the roles exchanged.
//!
//! ```text
//! the feature of the triangle that reaches furthest against the normal of the part's face            (Facet::furthest)
//! seen along that normal it lies within the face, further inside than it is deep: the face's normal is the axis,
//!     unless, across a gap, a side of the face cuts off the upper end of an edge that is not quite level
//! else the kernels are called
//! ```
//! Across a gap of the cores that is the closest point. In overlap no axis that leans by less than a right angle over a
//! side of the face is better, as shown for the triangle's normal (see `contact`). Most features that stand out of
//! ground under a box lie under the middle of its face.

use super::facet::Furthest;
use super::groups::{Base, Groups, Pin};
use super::prism::{Cut, Incident, Prism, STEEP, Span, within};
use super::rejected::Rejection;
use crate::feature::Feature;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

/// How much of an edge's rise may be cut off and be charged to the error, in slacks: what rotations in f32 leave of
/// edges that were meant to be level. With zero, cuboids that start on hills with their faces along the ground's took
/// 17 % more instructions.
const MOST_CUT_OFF: f64 = 1.0 / 64.0;

/// The result of testing a part's face against a triangle.
pub(super) enum Against {
    /// They are further apart than the reach.
    Apart,
    /// The face's normal is not the answer, or may not be.
    Unknown,
    /// It is, and the ground around the triangle's feature rejects it.
    Rejected(Rejection),
    /// It is, and points were added: the separation, and whether the part certainly shares a point with the triangle.
    Added(f64, bool),
}

/// The interval of a triangle's edge over a face, or a corner; and how far its middle is inside the face, in metres.
struct Stretch {
    ends: Span,
    inside: f64,
}

impl Prism<'_> {
    /// Adds contact points along the normal of the part's face, where that is the answer.
    pub(super) fn add_against(&self, incident: &Incident, groups: &mut Groups) -> Against {
        let (standing, facet) = (self.standing, self.facet);
        let (false, Some(outwards)) = (standing.solid.is_slender(), incident.outwards) else {
            return Against::Unknown;
        };
        let furthest = facet.furthest(-outwards);
        let (from, along) = match furthest {
            Furthest::Edge(edge) => facet.edge(edge),
            Furthest::Corner(corner) => (facet.corners[corner], DVec3::ZERO),
            Furthest::Face => return Against::Unknown,
        };
        let first = standing.solid.topology.face_vertices(incident.face).next().unwrap_or(0);
        let over = standing.point(first) + outwards * standing.radius;
        let separation = |share: f64| outwards.dot(from + along * share - over);
        let least = separation(0.0).min(separation(1.0));
        let doubt = self.doubt + standing.planarity;
        if least > self.reach + 2.0 * doubt {
            return Against::Apart;
        }
        if outwards.dot(facet.normal) > -STEEP {
            return Against::Unknown;
        }
        let Some(stretch) = self.stretch(incident.face, outwards, (from, along)) else {
            return Against::Unknown;
        };
        // An edge that counts as level may rise a little. Where its upper end is cut off, another edge of the triangle
        // may pass under the face nearer to it, across a gap, by no more than the rise that was cut off.
        let [(begin, _), (end, _)] = stretch.ends;
        let nearest = separation(begin).min(separation(end));
        let is_little = nearest - least <= MOST_CUT_OFF * standing.slack;
        if !is_little && nearest + standing.radius > 0.0 {
            return Against::Unknown;
        }
        let doubt = if is_little { doubt + (nearest - least) } else { doubt };
        let depth = -(least + standing.radius);
        if stretch.inside < depth.max(0.0) {
            return Against::Unknown;
        }
        if !facet.may_give(self.ground, furthest, -outwards) {
            let is_own = facet.is_nearly_own(-outwards);
            return Against::Rejected(Rejection { is_own, is_apart: least > doubt, measured: None });
        }
        let base = Base::along(-outwards, self.ground.patch(facet.number));
        for (share, by) in stretch.ends {
            let (on_ground, separation) = (from + along * share, separation(share));
            if separation <= self.reach {
                let (of_body, of_ground) = self.names(incident.face, furthest, (share, by));
                let on_body = on_ground - outwards * separation;
                let doubt = doubt + by.map_or(0.0, |by| self.under_round(by, outwards, along));
                groups.add(&base, Pin { on_body, on_ground, separation, doubt, of_body, of_ground });
            }
        }
        let middle = from + along * (0.5 * (begin + end));
        Against::Added(least, self.certainly_holds(middle, outwards.dot(middle - over), stretch.inside))
    }

    /// Whether a point of ground at this separation from the part's face is certainly in the part. Faces of hulls are
    /// derived, and prove nothing.
    fn certainly_holds(&self, point: DVec3, separation: f64, inside: f64) -> bool {
        let standing = self.standing;
        if !matches!(standing.part.shape, Shape3::Cuboid(_)) {
            return false;
        }
        let height = separation + standing.radius;
        (height >= 0.0 && separation < -self.doubt && inside > self.doubt)
            || standing.is_in_box(point, self.doubt)
    }

    /// How much further than the face's plane a rounded edge reaches where a line passes out from under it: a line that
    /// counts as level may lean against the face. In metres; never more than its whole rise.
    fn under_round(&self, half_edge: usize, outwards: DVec3, along: DVec3) -> f64 {
        let standing = self.standing;
        let (start, stop) = standing.solid.topology.ends(half_edge);
        let side = standing.point(stop) - standing.point(start);
        let (rise, across) = (outwards.dot(along), outwards.cross(side).dot(along) / side.length());
        let slope = rise / across;
        let over = standing.radius * ((1.0 + slope * slope).sqrt() - 1.0);
        if over < rise.abs() { over } else { rise.abs() }
    }

    fn names(
        &self,
        face: usize,
        furthest: Furthest,
        (share, by): (f64, Option<usize>),
    ) -> (Feature, Feature) {
        let numbers = self.ground.vertex_numbers(self.facet.number);
        let of_face = Feature::Face(face as u32);
        match (furthest, by) {
            (Furthest::Edge(edge), by) => self.names_on_edge(face, edge, (share, by)),
            (Furthest::Corner(corner), _) => (of_face, Feature::Vertex(numbers[corner % 3])),
            (Furthest::Face, _) => (of_face, Feature::Face(self.ground.patch(self.facet.number))),
        }
    }

    /// The part of an edge, or the corner, that lies over the part's face, seen along the face's normal.
    fn stretch(&self, face: usize, outwards: DVec3, (from, along): (DVec3, DVec3)) -> Option<Stretch> {
        let (standing, topology) = (self.standing, self.standing.solid.topology);
        let cuts = || {
            topology.face_half_edges(face).map(|half_edge| {
                let (start, stop) = topology.ends(half_edge);
                let (start, stop) = (standing.point(start), standing.point(stop));
                // A face goes counter-clockwise as seen from outside.
                Cut { half_edge, start, into: outwards.cross(stop - start) }
            })
        };
        let ends = within(cuts(), DVec3::ZERO, (from, along), [0.0, 1.0])?;
        let middle = from + along * (0.5 * (ends[0].0 + ends[1].0));
        let mut least = f64::INFINITY;
        for Cut { start, into, .. } in cuts() {
            let inside = into.dot(middle - start) / into.length();
            least = if inside < least { inside } else { least };
        }
        Some(Stretch { ends, inside: least })
    }
}
