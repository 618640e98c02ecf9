//! Triangles whose axis ground refused: they wait until all others have been heard.
//!
//! ```text
//! first those whose axis is nearly their own normal, then the others: told by their own normals, but for those that are freed
//!     by a normal that was heard before all of them, by the part's lowest vertex
//!     those not nearly their own also by any that is heard by then and far from it; those that a gap parts from the part
//!     only if they would be told as deeper than all else
//! ```
//! A normal frees a triangle if a move along it, by how deep the part was found along it, leaves the triangle, too. Of
//! a crate that lies over the edge of a step, a millimetre deep in the tread and half a metre beyond the riser, the
//! riser is freed by the tread. Between normals that are nearly the same it makes no such difference, and there the
//! second rule would only give what trembles one manifold more in every other frame.

use super::facet::{Facet, is_same};
use super::groups::MOST_GROUPS;
use super::over::Plane;
use super::prism::Prism;
use super::whole::touching;
use super::{Known, Seen};
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;
use core::cell::Cell;
use core::f64::consts::FRAC_1_SQRT_2;

/// A triangle whose axis was refused, and how the part stands over it.
struct Refused {
    plane: Plane,
    refusal: Refusal,
}

/// What is known of an axis that was refused.
#[derive(Clone, Copy, Debug)]
pub(super) struct Refusal {
    /// Whether it is nearly the triangle's own normal.
    pub(super) is_own: bool,
    /// Whether a gap parts the triangle from the part.
    pub(super) is_apart: bool,
    /// How deep the part is in the triangle, and how far that may be off, where the axis is level to all of it.
    pub(super) told: Option<[f64; 2]>,
}

/// Most triangles that wait until all others have been seen: by their numbers, and seen anew then, which takes less
/// than what was asked before. Those beyond are told at once, and nothing frees them: with 32 and a margin of 0.3 m,
/// one in forty bodies on stairs of many pieces, a millimetre deep at most, was told to be more than 5 cm deep in one
/// of them.
const MOST_REFUSED: usize = 256;

pub(super) type AllRefused = ArrayVec<Waiting, MOST_REFUSED>;

/// A triangle that waits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    number: u32,
    refusal: Refusal,
    /// What is deeper was left out when its axis was refused, and is when it is told, in metres.
    floor: f64,
}

/// A normal, and the least separation that was found along it.
pub(super) type Heard = (DVec3, f64);

impl Known {
    pub(super) fn heard(&self) -> ArrayVec<Heard, MOST_GROUPS> {
        self.groups.iter().map(|group| (group.base.normal, group.least())).collect()
    }
}

impl Seen<'_> {
    /// Keeps a triangle whose axis was refused until all others have been heard.
    pub(super) fn refuse(&self, prism: &Prism, refusal: Refusal, known: &mut Known) {
        let (number, floor) = (prism.facet.number, known.groups.floor());
        // What is deep of it was told by then, or another told of it: of what waits there is a gap alone.
        let refusal = Refusal { is_apart: refusal.is_apart || floor > f64::NEG_INFINITY, ..refusal };
        let is_seen = || {
            prism.facet.has_own_plane() || Facet::seen(prism.ground, number, self.standing.center).is_some()
        };
        if !is_seen() || known.refused.try_push(Waiting { number, refusal, floor }).is_err() {
            self.add_in_place(prism, refusal, known);
        }
    }

    /// Adds points of triangles whose axis was refused, by their own normals.
    pub(super) fn add_refused(&self, known: &mut Known) {
        if known.refused.is_empty() {
            return;
        }
        let heard = known.heard();
        let is_freed = |refused: &Refused| heard.iter().any(|&by| self.is_freed(refused, by));
        self.add_those(true, known, |refused, _| is_freed(refused));
        if known.refused.iter().all(|waiting| waiting.refusal.is_own) {
            return;
        }
        let (by_now, deepest) = (known.heard(), known.groups.least().min(0.0));
        self.add_those(false, known, |refused, known| {
            let is_far = |by: &&Heard| refused.plane.facet.normal.dot(by.0) < FRAC_1_SQRT_2;
            // What a gap parts from the part is clear of it before any move, which shows nothing: the floor beside a
            // wall was told by one corner. Only what would be told as deeper than all else is left out.
            let may_be_freed = !refused.refusal.is_apart || self.is_deeper(refused, deepest);
            let mut far = by_now.iter().filter(is_far);
            is_freed(refused)
                || far.any(|&by| {
                    self.is_freed(refused, by) || (may_be_freed && self.is_freed_by_face(refused, by, known))
                })
        });
    }

    /// Adds points of those whose axis is nearly their own normal, or of the others, but for what is freed.
    fn add_those(&self, is_own: bool, known: &mut Known, is_freed: impl Fn(&Refused, &mut Known) -> bool) {
        for place in 0..known.refused.len() {
            let Waiting { number, refusal, floor } = known.refused[place];
            if refusal.is_own == is_own
                && let Some(plane) = self.plane_of(number)
            {
                let refused = Refused { plane, refusal };
                if !is_freed(&refused, known) {
                    known.groups.leave_out(floor);
                    self.add_in_place(&self.prism_over(&refused.plane), refusal, known);
                    known.groups.leave_out(f64::NEG_INFINITY);
                }
            }
        }
    }

    /// Whether the part is deeper in a triangle, along its own normal, than was found along another.
    fn is_deeper(&self, refused: &Refused, least: f64) -> bool {
        refused.plane.extent.low - self.standing.radius < least - self.standing.slack
    }

    /// Whether a normal frees a triangle, as the part's lowest vertex shows.
    fn is_freed(&self, refused: &Refused, by: Heard) -> bool {
        let facet = &refused.plane.facet;
        self.is_deeper(refused, by.1)
            && may_free(refused, by)
            && !is_same(facet.normal, by.0)
            && self.is_left_below(facet, by)
    }

    /// Whether a move along a normal, by how deep the part was found along it, leaves all of a triangle below the
    /// part's lowest vertex.
    pub(super) fn is_left_below(&self, facet: &Facet, (normal, least): Heard) -> bool {
        let standing = self.standing;
        let [a, b, c] = facet.corners;
        let height = |corner: DVec3| normal.dot(corner - facet.origin());
        let top = height(a).max(height(b)).max(height(c));
        let low = standing.low(normal, facet.origin()) - standing.radius;
        low - top >= least - standing.slack
    }

    /// The same where that vertex is beside all ground: as any axis shows of a cuboid, of others the face that they
    /// turn to the normal.
    fn is_freed_by_face(&self, refused: &Refused, (normal, least): Heard, known: &mut Known) -> bool {
        let standing = self.standing;
        let facet = &refused.plane.facet;
        if !self.is_deeper(refused, least) || !may_free(refused, (normal, least)) {
            return false;
        }
        if let Shape3::Cuboid(_) = standing.part.shape {
            return standing.is_clear_of(facet, normal * -least);
        }
        let incident = self.incident_to(normal, known);
        let Some(outwards) = incident.outwards.filter(|_| !standing.solid.is_slender()) else { return false };
        let [a, b, c] = facet.corners;
        let nearest = outwards.dot(a).min(outwards.dot(b)).min(outwards.dot(c));
        let over = standing.solid.face_reach(incident.face, outwards) + standing.radius;
        nearest - over >= -outwards.dot(normal) * least - standing.slack
    }

    /// Adds points by a triangle's own normal, in place of those along what was refused. Of one that a gap parts from
    /// the part, none is deep: the part is beside it, and not in it. But where the part is deep in others of its plane
    /// that hang together with it, it leaves all of them at once.
    fn add_in_place(&self, prism: &Prism, refusal: Refusal, known: &mut Known) {
        let is_left_out = Cell::new(false);
        let is_in_others = || {
            let Facet { number, normal, .. } = *prism.facet;
            self.may_meet(prism) && known.groups.deep_along(prism.ground, normal).holds(prism.ground, number)
        };
        let is_beside = refusal.is_apart && self.is_behind(prism) && !is_in_others();
        let gate = is_beside.then_some((self.deep_below(prism), &is_left_out));
        self.add_by_normal(&Prism { gate, ..*prism }, known);
        if let Some(told) = refusal.told {
            known.groups.tell(prism.facet.normal, told);
        }
    }
}

/// Whether a normal counts at all for a triangle: for one that the part overlaps, if something touches along it. Else
/// it would depend on the margin what is deep.
fn may_free(refused: &Refused, (_, least): Heard) -> bool {
    refused.refusal.is_apart || least <= touching()
}
