//! The nearest point of ground that no triangle told of, in a gap within the margin.
//!
//! What is nearest of all ground lies in its own Voronoi region, and ground lets it through. Not so
//!
//! - where the part's nearest point stands a hair outside the triangle: that direction is the triangle's own normal up to the
//!   tolerance, and along the normal all of the part's face is cut away;
//! - of two-sided ground, where the part reaches around a rim or a fold: its centre is on one side, and what is nearest on the
//!   other, from where the triangle is not looked at, or taken for deep; and at corners so crumpled that they have no sides.
//!
//! Then nothing would be told of a part within the margin: 58 times in 2.8 M random poses beside rims, folds and fans of
//! triangles, half of them capsules. So the kernels' own answer is kept, and told if no other is as near.

use super::facet::{Facet, Furthest, is_same};
use super::groups::{Base, Pin};
use super::meeting::feature_on;
use super::{Known, Seen};
use crate::feature::Feature;
use asunder_geometry::glam::DVec3;

/// A triangle in a gap from the part, of which no point was made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unsaid {
    pub(super) number: u32,
    /// In metres, and by how much it may be off.
    pub(super) separation: f64,
    pub(super) doubt: f64,
    /// The nearest points, on the part and on the ground.
    pub(super) ends: [DVec3; 2],
    /// Unit direction from the ground to the part.
    pub(super) towards: DVec3,
}

impl Known {
    /// Keeps the nearest; of equals the lowest number.
    pub(super) fn leave_unsaid(&mut self, unsaid: Unsaid) {
        let is_nearer = |known: &Unsaid| {
            unsaid.separation < known.separation
                || unsaid.separation == known.separation && unsaid.number < known.number
        };
        if self.unsaid.as_ref().is_none_or(is_nearer) {
            self.unsaid = Some(unsaid);
        }
    }

    /// What is kept, of a part that overlaps no triangle, if it is nearer than all that was told: by more than `slack` metres.
    pub(super) fn unsaid_within(&self, slack: f64) -> Option<Unsaid> {
        let is_nearer = |unsaid: &Unsaid| unsaid.separation < self.groups.least() - slack;
        self.unsaid.filter(|unsaid| !self.overlapping && is_nearer(unsaid))
    }
}

impl Seen<'_> {
    /// Tells what was left unsaid of a part that overlaps no triangle, where it is nearer there than anywhere else that was
    /// told.
    pub(super) fn say_nearest(&self, known: &mut Known) {
        if known.overlapping {
            return;
        }
        self.look_behind(known);
        let (ground, standing) = (self.asking.on.ground, self.standing);
        let Some(unsaid) = known.unsaid_within(standing.slack) else { return };
        let Unsaid { number, separation, doubt, ends: [on_body, on_ground], towards } = unsaid;
        let Some(facet) = Facet::seen(ground, number, standing.center) else { return };
        let is_own = is_same(facet.normal, towards);
        if ground.is_one_sided() && !is_own {
            // Its rims and its back were meant to be refused.
            return;
        }
        let normal = if is_own { facet.normal } else { towards };
        let of_body = Feature::Vertex(standing.extent(normal, on_ground).lowest as u32);
        let of_ground = match facet.furthest(towards) {
            Furthest::Corner(corner) => Feature::Vertex(corner as u32),
            Furthest::Edge(edge) => Feature::Edge(edge as u32),
            Furthest::Face => Feature::Face(0),
        };
        let of_ground = feature_on(ground, number, of_ground);
        let pin = Pin { on_body, on_ground, separation, doubt, of_body, of_ground };
        known.groups.add(&Base { normal, patch: ground.patch(number), weight: 0.0 }, pin);
    }

    /// Asks the kernels about triangles that were taken for deep and are not: the part is on the other side of them.
    fn look_behind(&self, known: &mut Known) {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        if ground.is_one_sided() {
            return;
        }
        for (.., separation, number) in core::mem::take(&mut known.unclear) {
            if separation < -standing.slack
                && let Some(facet) = Facet::seen(ground, number, standing.center)
                && let Some(gap) = self.meeting.gap((ground, &facet), &standing.place, self.asking)
            {
                known.leave_unsaid(gap);
            }
        }
    }
}
