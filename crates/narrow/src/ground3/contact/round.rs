//! A sphere on ground, at once: what matters of it is its centre.
//!
//! ```text
//! for each triangle near it:
//!   its plane is too far, or its nearest point: done
//!   neither is in front for certain, and no side of it may give that direction: no point
//!   else, and only then: which side the centre is on, which takes a walk around the corner       (Facet::is_before)
//!   the point, where ground lets the direction through                                           (Nearest::add_point)
//! what ground refused is nearer than all points: the general way                                (unsaid)
//! ```
//! Answers are those of the general way to the last bit. Where rounding leaves it open whether the two share a point, or
//! the centre is on the triangle, that way is asked instead: it knows how to go on.
//!
//! What it buys: no core, no solid, no vertices eight by eight, and for most triangles no side.

use super::ball::{Nearest, nearest_to};
use super::facet::{Facet, Furthest, is_same};
use super::standing::{Place, doubt_of};
use super::{Asking, Known};
use crate::pair3::Part;
use crate::room::Room;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Aabb3, Ground, NearTriangle, Prominent};
use core::ops::ControlFlow;

/// A sphere, in the ground's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    center: DVec3,
    radius: f64,
    /// Lengths that enter a coordinate, in metres.
    lengths: f64,
    /// The widest gap in which a point is wanted, in metres.
    reach: f64,
}

impl Round {
    pub(super) fn new(place: &Place, radius: f64, reach: f64) -> Self {
        Self { center: place.point(DVec3::ZERO), radius, lengths: place.summed + radius, reach }
    }

    /// Whether it overlaps, if it is within the margin, as [`Asking::contact_of`]; nothing where the general way has to be
    /// gone.
    pub(super) fn contact(
        &self,
        asking: &Asking,
        part: Part,
        is_settled: bool,
        manifolds: &mut impl Room,
    ) -> Option<Option<bool>> {
        let bounds = asking.on.bounds(&part, self.reach);
        let slack = self.slack();
        let mut known = Known::new([slack; 2]);
        if !self.look(asking.on.ground, &bounds, !manifolds.is_wanted(), &mut known) {
            return None;
        }
        if !(known.overlapping || is_settled && known.groups.least() >= -slack) {
            known.groups.keep_within(-slack);
        }
        if known.is_unsaid(slack) || known.groups.least() > slack && known.shown_by.is_some() {
            return None;
        }
        known.tell_unsaid(slack);
        Some(asking.answer(part, &mut known, is_settled, manifolds))
    }

    /// Places that differ by no more are the same, in metres.
    fn slack(&self) -> f64 {
        (2.0 * FACE_PREFERENCE * self.radius).max(doubt_of(self.lengths, self.center))
    }

    /// Looks at the triangles near it, all but at once if only yes or no is wanted. Whether that settles everything;
    /// else it is to be asked in the general way, from the start.
    fn look(&self, ground: Ground, bounds: &Aabb3, is_yes_enough: bool, known: &mut Known) -> bool {
        let flow = ground.read_near(bounds, |near| {
            if !self.look_at(ground, near, known) {
                known.is_open = true;
                return ControlFlow::Break(());
            }
            if known.overlapping && is_yes_enough {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        });
        flow.is_continue() || !known.is_open
    }

    /// Looks at one triangle; whether it is settled.
    fn look_at(&self, ground: Ground, near: &NearTriangle, known: &mut Known) -> bool {
        let Some(mut facet) = Facet::front_of(near.number, near.corners) else { return true };
        let height = facet.height(self.center);
        let lever = (self.center - facet.origin()).abs().element_sum() + self.radius;
        let doubt = doubt_of(self.lengths, facet.origin()) + facet.tilt * lever;
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
                known.leave_unsaid(ground, nearest.unsaid(ball, near.number, doubt));
            }
        }
        if nearest.separation < -doubt {
            known.settle(near.number);
        }
        known.overlapping || nearest.separation > doubt
    }
}

/// Whether the triangle may give a point as seen from either side.
fn may_add(nearest: &Nearest, facet: &Facet, prominent: Prominent) -> bool {
    let is_prominent = match nearest.feature {
        Furthest::Face => true,
        Furthest::Edge(edge) => prominent.edge(edge, true) || prominent.edge(edge, false),
        Furthest::Corner(corner) => prominent.corner(corner, true) || prominent.corner(corner, false),
    };
    is_prominent || is_same(facet.normal, nearest.towards) || is_same(-facet.normal, nearest.towards)
}
