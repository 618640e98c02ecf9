//! The fast path for a sphere on ground: only its centre matters.
//!
//! ```text
//! for each triangle near it:
//!   a plane separates them by more than the reach: done                                           (Round::may_reach)
//!   its plane, or its nearest point, is too far: done
//!   the direction is not the normal, nor that of a feature prominent from either side: no point   (may_add)
//!   only now: which side the centre is on, which takes a walk around the corner                   (Facet::is_before)
//!   the point, if ground accepts the direction                                                    (Nearest::add_point)
//! a rejected closest point is nearer than all contact points: the general path                    (rejected_gaps)
//! ```
//! Answers are those of the general path to the last bit, except for needles whose normals are mostly rounding. Where
//! rounding leaves open whether the two share a point, or the centre is on the triangle, the general path runs instead,
//! which can decide it.
//!
//! It saves the core, the solid and the transformed vertices, and for most triangles the decision of the side.

use super::ball::{Nearest, nearest_to};
use super::facet::{Facet, Furthest, is_same, widened};
use super::standing::doubt_of;
use super::{GroundQuery, Known};
use crate::ground3::bounds::way_from;
use crate::ground3::near::grown_around;
use crate::pair3::Part;
use crate::room::Room;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Aabb3, Ground, NearTriangle, Prominent, Shape3};
use core::ops::ControlFlow;

/// More than products lose to rounding here, as a share of lengths. A needle's normal may be off by more, but the
/// separating plane is not made from it: a triangle that is skipped is apart, whatever its normal.
const LOST: f64 = 1e-6;

/// A sphere, in the ground's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    pub(super) center: DVec3,
    pub(super) radius: f64,
    /// The summed lengths that enter a coordinate, in metres.
    pub(super) lengths: f64,
    /// The widest gap in which a point is wanted, in metres.
    reach: f64,
}

impl Round {
    /// What matters of a part, if it is a sphere.
    #[inline]
    pub(super) fn of(query: &GroundQuery, part: &Part) -> Option<Self> {
        let Shape3::Sphere(sphere) = part.shape else { return None };
        let (center, summed) = query.on.origin_of(part);
        let radius = f64::from(sphere.radius());
        Some(Self { center, radius, lengths: summed + radius, reach: query.reach })
    }

    /// Its box grown by the reach, rounded outwards.
    #[inline]
    pub(super) fn bounds(&self) -> Aabb3 {
        grown_around([self.center; 2], self.radius + self.reach, self.lengths)
    }

    /// Whether it overlaps, if it is within the margin, as [`GroundQuery::contact_of`]; `None` where the general path
    /// has to run.
    pub(super) fn contact(
        &self,
        query: &GroundQuery,
        part: Part,
        is_overlap_known: bool,
        manifolds: &mut impl Room,
    ) -> Option<Option<bool>> {
        let slack = self.slack();
        let mut known = Known::new([slack; 2]);
        if !self.look(query.on.ground, !manifolds.is_wanted(), &mut known) {
            return None;
        }
        if !(known.overlapping || is_overlap_known && known.groups.least() >= -slack) {
            known.groups.keep_within(-slack);
        }
        if known.has_nearer_rejected_gap(slack) || known.groups.least() > slack && known.shown_by.is_some() {
            return None;
        }
        known.record_rejected_gap(slack);
        if query.ahead > 0.0 && manifolds.is_wanted() {
            self.look_ahead(query, &mut known);
        }
        Some(query.answer(part, &mut known, is_overlap_known, manifolds))
    }

    /// Positions that differ by no more count as the same, in metres.
    fn slack(&self) -> f64 {
        (2.0 * FACE_PREFERENCE * self.radius).max(doubt_of(self.lengths, self.center))
    }

    /// Processes the triangles near it, up to the first overlap if only yes or no is wanted. Returns whether everything
    /// is settled; if not, the general path has to run, from the start.
    fn look(&self, ground: Ground, is_yes_enough: bool, known: &mut Known) -> bool {
        let mut is_settled = true;
        let _ = ground.read_near_if(
            &self.bounds(),
            |corners| self.may_reach(corners),
            |near| {
                is_settled = self.look_at(ground, near, known);
                if is_settled && !(known.overlapping && is_yes_enough) {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            },
        );
        is_settled
    }

    /// Whether a triangle may be within reach: not if a plane separates it from the ball by more than that.
    ///
    /// The plane is square to the line from the triangle's nearest point, as rounding has it, to the centre. All
    /// corners are tested against it, so the answer is right however good that point is, and no root is taken. Six
    /// triangles of ten near a ball on hills end here: frames of balls that roll take 0.84 of the time. Tried: eight at
    /// a time in f32, for which LLVM emits more moves than products on SSE2; one by one without a branch: frames take
    /// 1.05 to 1.7, and 1.2 times as long (AMD EPYC, Zen 5, 2026-11-25).
    #[inline]
    fn may_reach(&self, corners: &[Vec3; 3]) -> bool {
        let corners = widened(*corners);
        let (away, least) = way_from(corners, self.center);
        // More than rounding can hide.
        let lever = (self.center - corners[0]).abs().element_sum() + self.radius;
        let beyond = self.radius + self.reach + doubt_of(self.lengths, corners[0]) + LOST * lever;
        // NaN may reach.
        let is_beyond = least > 0.0 && least * least > beyond * beyond * away.length_squared();
        !is_beyond
    }

    /// Processes one triangle; returns whether it is settled.
    fn look_at(&self, ground: Ground, near: &NearTriangle, known: &mut Known) -> bool {
        let Some(mut facet) = Facet::front_of(near.number, near.corners) else { return true };
        let height = facet.height(self.center);
        let doubt = facet.doubt((self.center, self.radius), self.lengths);
        let most = self.reach + doubt;
        if height.abs() - self.radius > most || ground.is_one_sided() && height < 0.0 {
            return true;
        }
        let on = nearest_to(&facet, self.center);
        if on.0 != Furthest::Face && (self.center - on.1).length() <= doubt {
            return false;
        }
        if on.0 == Furthest::Face && height < 0.0 {
            facet.turn_over();
        }
        let nearest = Nearest::at((self.center, self.radius), &facet, on, doubt);
        if nearest.separation > most {
            return true;
        }
        if nearest.separation <= self.reach {
            let ball = (self.center, self.radius);
            let is_added = may_add(&nearest, &facet, near.prominent) && {
                if on.0 != Furthest::Face
                    && !ground.is_one_sided()
                    && !facet.is_before(ground, self.center, on)
                {
                    facet.turn_over();
                }
                nearest.add_point(ball, &facet, ground, doubt, &mut known.groups)
            };
            if !is_added {
                known.keep_rejected_gap(nearest.closest_points(ball, (ground, near.number), doubt));
            }
        }
        if nearest.separation < -doubt {
            known.settle(near.number);
        }
        known.overlapping || nearest.separation > doubt
    }
}

/// Whether the triangle may give a point, seen from either side.
fn may_add(nearest: &Nearest, facet: &Facet, prominent: Prominent) -> bool {
    let is_prominent = match nearest.feature {
        Furthest::Face => true,
        Furthest::Edge(edge) => prominent.edge(edge, true) || prominent.edge(edge, false),
        Furthest::Corner(corner) => prominent.corner(corner, true) || prominent.corner(corner, false),
    };
    is_prominent || is_same(facet.normal, nearest.towards) || is_same(-facet.normal, nearest.towards)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_triangle_within_reach_is_dropped_as_beyond() {
        let mut random = oorandom::Rand64::new(3);
        let mut number = || 2.0 * random.rand_float() - 1.0;
        let (mut near, mut parted, mut far) = (0, 0, 0);
        for round in 0..200_000 {
            // Triangles of all sizes, from needles to regular ones, near the origin and far from it.
            let size = (20.0 * number()).exp2();
            let thin = [1.0, 1e-3, 1e-6][round % 3];
            let away = DVec3::new(number(), number(), number()) * [0.0, 1e3 * size][round % 2];
            let mut point = || DVec3::new(number(), number(), number()) * size;
            let (from, to, beside, center) = (point(), point(), point() * thin, point() * 2.0);
            let corners = [away + from, away + to, away + from + beside].map(|corner| corner.as_vec3());
            let Some(facet) = Facet::front_of(0, corners) else { continue };
            let center = away + center;
            let distance = match nearest_to(&facet, center) {
                (Furthest::Face, _) => facet.height(center).abs(),
                (_, at) => (center - at).length(),
            };
            // Balls that have the triangle just within reach, or just not.
            for share in [1.0 + 1e-9, 1.0, 1.0 - 1e-9, 0.999] {
                let (radius, reach) = (0.9 * distance * share, 0.1 * distance * share);
                let round = Round { center, radius, lengths: radius, reach };
                let is_within_reach = round.may_reach(&corners);
                if share >= 1.0 {
                    assert!(is_within_reach, "{distance} from {center}, {share}: {corners:?}");
                    near += 1;
                } else if share == 0.999 {
                    far += 1;
                    parted += usize::from(!is_within_reach);
                }
            }
        }
        assert!(near > 300_000 && parted * 10 > far * 9, "{near} near, {parted} of {far} parted");
    }
}
