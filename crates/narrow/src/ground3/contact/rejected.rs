//! Triangles whose axis ground rejected: they wait until all others have been processed.
//!
//! ```text
//! first those whose axis is nearly their normal, then the others: points along their normals, unless they are freed
//!     any may be freed by a normal that was found before all of them, as the part's lowest vertex shows
//!     the others also by any normal found by then that is far from theirs, as that vertex, an axis of a cuboid or the
//!         part's incident face shows; the latter two, across a gap, only if it would be deeper than all else
//! ```
//! A normal *frees* a triangle if moving the part along it, by the depth found along it, separates the part from the
//! triangle, too. Take a crate over the edge of a step, a millimetre deep in the tread and half a metre beyond the
//! riser: the riser is freed by the tread. Between nearly equal normals it makes no such difference, and the second
//! rule would only give a trembling body one manifold more in every other frame.

use super::facet::{Facet, is_same};
use super::groups::MOST_GROUPS;
use super::over::Plane;
use super::prism::Prism;
use super::whole::touching;
use super::{Known, PartTest};
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;
use core::cell::Cell;
use core::f64::consts::FRAC_1_SQRT_2;

/// A triangle whose axis was rejected, and the part's extent over it.
struct Rejected {
    plane: Plane,
    rejection: Rejection,
}

/// What is known of a rejected axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rejection {
    /// Whether it is nearly the triangle's normal.
    pub(super) is_own: bool,
    /// Whether there is a gap between the triangle and the part.
    pub(super) is_apart: bool,
    /// The separation of part and triangle, and its error bound, where all of the triangle is level in that direction.
    pub(super) measured: Option<[f64; 2]>,
}

/// Most triangles that wait until all others have been processed. They are kept by number and set up again then, which
/// costs less than the tests before. Further ones are added at once, and nothing frees them: with 32 and a margin of
/// 0.3 m, one in forty bodies on stairs of many pieces, a millimetre deep at most, was reported to be more than 5 cm
/// deep in one of them.
const MOST_REJECTED: usize = 256;

pub(super) type AllRejected = ArrayVec<Waiting, MOST_REJECTED>;

/// A triangle that waits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    number: u32,
    rejection: Rejection,
    /// Deeper points were left out when its axis was rejected, and are when its points are added, in metres.
    floor: f64,
}

/// A normal, and the least separation found along it.
pub(super) type LeastAlong = (DVec3, f64);

impl Known {
    pub(super) fn least_along_each(&self) -> ArrayVec<LeastAlong, MOST_GROUPS> {
        self.groups.iter().map(|group| (group.base.normal, group.least())).collect()
    }
}

impl PartTest<'_> {
    /// Keeps a triangle whose axis was rejected until all others have been processed.
    pub(super) fn defer_rejected(&self, prism: &Prism, rejection: Rejection, known: &mut Known) {
        let (number, floor) = (prism.facet.number, known.groups.floor());
        // With a floor, its penetrating points were added before, or another triangle covers them: only its gap waits.
        let rejection = Rejection { is_apart: rejection.is_apart || floor > f64::NEG_INFINITY, ..rejection };
        let is_facing = || {
            prism.facet.has_own_plane() || Facet::facing(prism.ground, number, self.standing.center).is_some()
        };
        if !is_facing() || known.rejected.try_push(Waiting { number, rejection, floor }).is_err() {
            self.add_in_place(prism, rejection, known);
        }
    }

    /// Adds points along the normals of triangles whose axis was rejected, unless they are freed.
    pub(super) fn add_rejected(&self, known: &mut Known) {
        if known.rejected.is_empty() {
            return;
        }
        let found = known.least_along_each();
        let is_freed = |rejected: &Rejected| found.iter().any(|&by| self.is_freed(rejected, by));
        self.add_those(true, known, |rejected, _| is_freed(rejected));
        if known.rejected.iter().all(|waiting| waiting.rejection.is_own) {
            return;
        }
        let (by_now, deepest) = (known.least_along_each(), known.groups.least().min(0.0));
        self.add_those(false, known, |rejected, known| {
            let is_far = |by: &&LeastAlong| rejected.plane.facet.normal.dot(by.0) < FRAC_1_SQRT_2;
            // A triangle across a gap is clear of the part before any move, so being clear of it after one shows
            // nothing: the floor beside a wall got a contact at one vertex only. Left out are just those that would be
            // reported deeper than all else.
            let may_be_freed = !rejected.rejection.is_apart || self.is_deeper(rejected, deepest);
            let mut far = by_now.iter().filter(is_far);
            is_freed(rejected)
                || far.any(|&by| {
                    self.is_freed(rejected, by)
                        || (may_be_freed && self.is_freed_by_face(rejected, by, known))
                })
        });
    }

    /// Adds points of the triangles whose axis is nearly their normal, or of the others, except for freed ones.
    fn add_those(&self, is_own: bool, known: &mut Known, is_freed: impl Fn(&Rejected, &mut Known) -> bool) {
        for place in 0..known.rejected.len() {
            let Waiting { number, rejection, floor } = known.rejected[place];
            if rejection.is_own == is_own
                && let Some(plane) = self.plane_of(number)
            {
                let rejected = Rejected { plane, rejection };
                if !is_freed(&rejected, known) {
                    known.groups.leave_out(floor);
                    self.add_in_place(&self.prism_over(&rejected.plane), rejection, known);
                    known.groups.leave_out(f64::NEG_INFINITY);
                }
            }
        }
    }

    /// Whether the part is deeper in a triangle, along the triangle's normal, than was found along another.
    fn is_deeper(&self, rejected: &Rejected, least: f64) -> bool {
        rejected.plane.extent.low - self.standing.radius < least - self.standing.slack
    }

    /// Whether a normal frees a triangle, as the part's lowest vertex shows.
    fn is_freed(&self, rejected: &Rejected, by: LeastAlong) -> bool {
        let facet = &rejected.plane.facet;
        self.is_deeper(rejected, by.1)
            && may_free(rejected, by)
            && !is_same(facet.normal, by.0)
            && self.is_left_below(facet, by)
    }

    /// Whether a move along a normal, by the depth found along it, leaves all of a triangle below the part's lowest
    /// vertex.
    pub(super) fn is_left_below(&self, facet: &Facet, (normal, least): LeastAlong) -> bool {
        let standing = self.standing;
        let [a, b, c] = facet.corners;
        let height = |corner: DVec3| normal.dot(corner - facet.origin());
        let top = height(a).max(height(b)).max(height(c));
        let low = standing.low(normal, facet.origin()) - standing.radius;
        low - top >= least - standing.slack
    }

    /// The same where that vertex is beside all ground: shown for a cuboid by any axis, for other parts by their
    /// incident face.
    fn is_freed_by_face(&self, rejected: &Rejected, (normal, least): LeastAlong, known: &mut Known) -> bool {
        let standing = self.standing;
        let facet = &rejected.plane.facet;
        if !self.is_deeper(rejected, least) || !may_free(rejected, (normal, least)) {
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

    /// Adds points along a triangle's normal, in place of those along the rejected axis. Across a gap, no penetrating
    /// ones: the part is beside the triangle, not in it. But where the part penetrates connected triangles of the same
    /// plane, it leaves all of them at once.
    fn add_in_place(&self, prism: &Prism, rejection: Rejection, known: &mut Known) {
        let is_left_out = Cell::new(false);
        let is_in_others = || {
            let Facet { number, normal, .. } = *prism.facet;
            self.may_meet(prism) && known.groups.deep_along(prism.ground, normal).holds(prism.ground, number)
        };
        let is_beside = rejection.is_apart && self.is_behind(prism) && !is_in_others();
        let gate = is_beside.then_some((self.deep_below(prism), &is_left_out));
        self.add_by_normal(&Prism { gate, ..*prism }, known);
        if let Some(measured) = rejection.measured {
            known.groups.record(prism.facet.normal, measured);
        }
    }
}

/// Whether a normal may free a triangle at all. For one that the part overlaps, something must touch along the normal:
/// else what is reported as penetrating would depend on the margin.
fn may_free(rejected: &Rejected, (_, least): LeastAlong) -> bool {
    rejected.rejection.is_apart || least <= touching()
}
