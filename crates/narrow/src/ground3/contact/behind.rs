//! Triangles of two-sided ground that are seen from behind, across a gap: they are looked at after all others but
//! before those whose axis was refused (`refused`), whose normals only stand in, and would seem to explain them.
//!
//! ```text
//! a normal that was heard, of ground around one of the triangle's corners, and the triangle's own no nearer to it than a little less
//!     than a right angle: a move along it, by how deep the part is there, leaves all of the triangle behind: it is hidden
//! all others are looked at as if they had not waited
//! ```
//! A crate on a step, a hair deep in the tread, has a strip of the riser as high as that before it, from the inside:
//! told as what it runs into, that stopped a crate without friction at the edge of the step it slid from. Ground that
//! only lies lower, and is no part of what the crate stands on, hides nothing: between fences that cross, bodies tipped
//! over one into the other.

use super::facet::Facet;
use super::prism::Prism;
use super::refused::Heard;
use super::{Known, Seen};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Ground, NearTriangle};

/// Most triangles that wait; those beyond are looked at at once.
const MOST_BEHIND: usize = 64;

pub(super) type AllBehind = ArrayVec<NearTriangle, MOST_BEHIND>;

/// Cosine of the angle between two normals up to which what is before a triangle is not above what is under the part.
const ASIDE: f64 = 0.125;

impl Seen<'_> {
    /// Keeps a triangle until all others have been looked at, if it is to wait; whether it did.
    pub(super) fn leaves_behind(&self, near: &NearTriangle, prism: &Prism, known: &mut Known) -> bool {
        let separation = prism.extent.low - self.standing.radius;
        !prism.facet.is_front && separation > prism.doubt && known.behind.try_push(*near).is_ok()
    }

    /// Looks at the triangles that waited, but for those that are hidden.
    pub(super) fn look_at_behind(&self, known: &mut Known) {
        if known.behind.is_empty() {
            return;
        }
        let heard = known.heard();
        // By their places: taken out, the list would be copied, blanks and all.
        for place in 0..known.behind.len() {
            let (near, mut plane) = (known.behind[place], None);
            if !self.is_within(&near, &mut plane) {
                continue;
            }
            let Some(plane) = &plane else { continue };
            if !heard.iter().any(|&by| self.is_hidden(&plane.facet, by)) {
                self.look_on(&near, &self.prism_over(plane), known);
            }
        }
    }

    /// Whether a normal hides a triangle.
    fn is_hidden(&self, facet: &Facet, by: Heard) -> bool {
        facet.normal.dot(by.0) <= ASIDE
            && self.is_left_below(facet, by)
            && facet.has_beside(self.asking.on.ground, by.0)
    }
}

impl Facet {
    /// Whether the front of any other triangle around its corners looks nearly along a normal.
    fn has_beside(&self, ground: Ground, normal: DVec3) -> bool {
        let is_other = |other: u32, _: usize| {
            let front = Self::front_of(other, ground.corners(other));
            front.is_none_or(|front| !front.is_nearly_own(normal))
        };
        (0..3).any(|corner| !self.do_all_around(ground, corner, is_other))
    }
}
