//! Triangles of two-sided ground that are seen from behind, across a gap. They are processed after all others, but
//! before those whose axis was rejected (`rejected`): the normals of the latter are only substitutes, and would hide
//! these wrongly.
//!
//! ```text
//! a triangle is hidden, and skipped, by a normal found so far that ground around one of its corners has, nearly square
//!     to its own or further off, if a move along that normal, by the depth found, leaves the triangle below the part
//! the others are processed as if they had not waited
//! ```
//! A crate on a step, a hair deep in the tread, has a strip of the riser in front of it, as high as it is deep, seen
//! from the inside. Reported as a contact that the crate runs into, that strip stopped a crate without friction at the
//! edge of the step it slid from. Ground that only lies lower, and is not connected to what the crate stands on, hides
//! nothing: between fences that cross, bodies tipped over one into the other.

use super::facet::Facet;
use super::prism::Prism;
use super::rejected::LeastAlong;
use super::{Known, PartTest};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Ground, NearTriangle};

/// Most triangles that wait; further ones are processed at once.
const MOST_BEHIND: usize = 64;

pub(super) type AllBehind = ArrayVec<NearTriangle, MOST_BEHIND>;

/// Greatest cosine between the triangle's normal and the one that hides it: what is in front of the triangle is then
/// not above what is under the part.
const ASIDE: f64 = 0.125;

impl PartTest<'_> {
    /// Keeps a triangle until all others have been processed, if it has to wait; returns whether it did.
    pub(super) fn leaves_behind(&self, near: &NearTriangle, prism: &Prism, known: &mut Known) -> bool {
        let separation = prism.extent.low - self.standing.radius;
        !prism.facet.is_front && separation > prism.doubt && known.behind.try_push(*near).is_ok()
    }

    /// Processes the triangles that waited, except hidden ones.
    pub(super) fn look_at_behind(&self, known: &mut Known) {
        if known.behind.is_empty() {
            return;
        }
        let found = known.least_along_each();
        // By index: taking the list out would copy all of it.
        for place in 0..known.behind.len() {
            let (near, mut plane) = (known.behind[place], None);
            if !self.is_within(&near, &mut plane) {
                continue;
            }
            let Some(plane) = &plane else { continue };
            if !found.iter().any(|&by| self.is_hidden(&plane.facet, by)) {
                self.look_on(&near, &self.prism_over(plane), known);
            }
        }
    }

    /// Whether a normal hides a triangle.
    fn is_hidden(&self, facet: &Facet, by: LeastAlong) -> bool {
        facet.normal.dot(by.0) <= ASIDE
            && self.is_left_below(facet, by)
            && facet.has_beside(self.query.on.ground, by.0)
    }
}

impl Facet {
    /// Whether any other triangle around its corners has a front normal that is nearly this normal.
    fn has_beside(&self, ground: Ground, normal: DVec3) -> bool {
        let is_other = |other: u32, _: usize| {
            let front = Self::front_of(other, ground.corners(other));
            front.is_none_or(|front| !front.is_nearly_own(normal))
        };
        (0..3).any(|corner| !self.do_all_around(ground, corner, is_other))
    }
}
