//! Triangles near the part, across a gap, that gave no point because ground refused their direction.
//!
//! What is nearest of all ground lies in its own Voronoi region, and ground lets it through. Not so
//!
//! - where that direction is the triangle's own normal up to the tolerance, and along the normal all of the part's face
//!   is cut away, or the nearest of it: the part's nearest point stands a hair outside the triangle; or the part is
//!   rounded, and what is nearest is the round of an edge that leads over the triangle from side to side;
//! - where a face of the part that is all but as good was preferred to it, and ground refuses that one;
//! - of two-sided ground, where the part reaches around a rim or a fold: its centre is on one side, and what is nearest
//!   on the other, from where the triangle is not looked at, or taken for deep; and at corners so crumpled that they
//!   have no sides.
//!
//! Then nothing was told of a part within the margin, 58 times in 2.8 M random poses beside rims, folds and fans of
//! triangles, half of them capsules; or, of rounded boxes in a groove, by millimetres too much. So the kernels' own
//! answers are kept, one a direction, and told at last: along a triangle's own normal where nothing there is as near,
//! along others where nothing at all is.

use super::facet::{Facet, Furthest, edge_number, is_same};
use super::groups::{Base, Pin};
use super::{Known, Seen, Unclear};
use crate::feature::Feature;
use arrayvec::ArrayVec;
use asunder_geometry::Ground;
use asunder_geometry::glam::DVec3;

/// What the kernels, or a closed form, say of a triangle of which no point was made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unsaid {
    pub(super) number: u32,
    /// In metres, and by how much it may be off; below zero where they overlap.
    pub(super) separation: f64,
    pub(super) doubt: f64,
    /// The nearest points, on the part and on the ground.
    pub(super) ends: [DVec3; 2],
    /// Unit direction from the ground to the part: the triangle's own normal where it is the same, and whether it is.
    pub(super) normal: DVec3,
    pub(super) is_own: bool,
    /// Whether ground means to be touched along it: one-sided ground has no backs, and no more of its rims than it
    /// gives.
    pub(super) is_meant: bool,
}

/// One a direction, the nearest first; of many those.
pub(super) type AllUnsaid = ArrayVec<Unsaid, 8>;

impl Unsaid {
    /// Of a triangle, along a unit direction from it to the part: how far they are apart and by how much that may be
    /// off, and their nearest points.
    pub(super) fn along(
        (ground, facet): (Ground, &Facet),
        towards: DVec3,
        [separation, doubt]: [f64; 2],
        ends: [DVec3; 2],
    ) -> Self {
        let is_own = is_same(facet.normal, towards);
        let normal = if is_own { facet.normal } else { towards };
        // What was refused may be a face of the part that is all but as good as this. To a needle many directions are
        // level: with none but its own, bodies beside the rim of a strip of needles were told to be further away than
        // they are.
        let is_given = || match facet.furthest(towards) {
            Furthest::Face => {
                facet.normal.dot(towards) > 0.0 || facet.may_give_across(ground, towards, |_| true)
            }
            furthest => facet.may_give(ground, furthest, towards),
        };
        let is_meant = is_own || !ground.is_one_sided() || is_given();
        Self { number: facet.number, separation, doubt, ends, normal, is_own, is_meant }
    }

    /// Whether it comes before another; of equals the one of the lower number.
    fn is_before(&self, other: &Self) -> bool {
        (self.separation, self.number) < (other.separation, other.number)
    }
}

impl Known {
    /// Keeps the nearest of each direction.
    pub(super) fn leave_unsaid(&mut self, unsaid: Unsaid) {
        if !unsaid.is_meant {
            return;
        }
        let all = &mut self.unsaid;
        let same = all.iter().position(|known| is_same(known.normal, unsaid.normal));
        let in_place = same.or_else(|| all.is_full().then(|| all.len() - 1));
        if let Some(place) = in_place {
            if !unsaid.is_before(&all[place]) {
                return;
            }
            all.remove(place);
        }
        let place = all.partition_point(|known| known.is_before(&unsaid));
        let _ = all.try_insert(place, unsaid);
    }

    /// Whether something is nearer than all that was told of a part that overlaps no triangle: by more than `slack`
    /// metres.
    pub(super) fn is_unsaid(&self, slack: f64) -> bool {
        let least = self.groups.least() - slack;
        !self.overlapping && self.unsaid.first().is_some_and(|nearest| nearest.separation < least)
    }

    /// Tells how near the nearest of it is, where that is the same place up to the slack: the points stay.
    pub(super) fn tell_unsaid(&mut self, slack: f64) {
        let least = self.groups.least();
        if let Some(nearest) = self.unsaid.first()
            && !self.overlapping
            && (least - slack..least).contains(&nearest.separation)
        {
            self.groups.tell_nearest([nearest.separation, nearest.doubt]);
        }
    }
}

impl Seen<'_> {
    /// Tells what was left unsaid. Cost: some kernels for a part that is near two-sided ground from behind, and touches
    /// nothing.
    pub(super) fn say(&self, known: &mut Known) {
        if !known.overlapping {
            self.look_behind(known);
        }
        if known.unsaid.is_empty() {
            return;
        }
        let slack = self.standing.slack;
        let least = known.groups.least();
        known.tell_unsaid(slack);
        // By their places: taken out, the list would be copied, blanks and all.
        for place in 0..known.unsaid.len() {
            let unsaid = known.unsaid[place];
            let along = known.groups.least_along(unsaid.normal);
            if unsaid.is_own && (along - slack..along).contains(&unsaid.separation) {
                // The same place up to the slack: the points stay.
                known.groups.tell(unsaid.normal, [unsaid.separation, unsaid.doubt]);
            }
            let is_nearer = if unsaid.is_own {
                unsaid.separation < along - slack
            } else {
                !known.overlapping && unsaid.separation < least - slack
            };
            if is_nearer {
                self.add_unsaid(&unsaid, known);
            }
        }
    }

    pub(super) fn add_unsaid(&self, unsaid: &Unsaid, known: &mut Known) {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        let Unsaid { number, separation, doubt, ends: [on_body, on_ground], normal, .. } = *unsaid;
        let Some(facet) = Facet::seen(ground, number, standing.center) else { return };
        // Named after a side of the triangle, wherever it is: what is held by a corner and a side is never moved along,
        // and whoever was refused once may come nearer on the way.
        let away = |edge: usize| facet.inside(on_ground, |other| other == edge).abs();
        let edge = (1..3).fold(0, |best, edge| if away(edge) < away(best) { edge } else { best });
        let of_body = Feature::Vertex(standing.extent(normal, on_ground).lowest as u32);
        let of_ground = Feature::Edge(edge_number(ground, number, edge));
        let pin = Pin { on_body, on_ground, separation, doubt, of_body, of_ground };
        known.groups.add(&Base::along(normal, ground.patch(number)), pin);
    }

    /// Asks the kernels about triangles that were taken for deep and are not: the part is on the other side of them.
    fn look_behind(&self, known: &mut Known) {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        if ground.is_one_sided() || known.unclear.is_empty() {
            return;
        }
        for place in 0..known.unclear.len() {
            let Unclear { separation, number, .. } = known.unclear[place];
            if separation < -standing.slack
                && let Some(facet) = Facet::seen(ground, number, standing.center)
                && let Some(gap) = self.meeting.gap((ground, &facet), &standing.place, self.asking)
            {
                known.leave_unsaid(gap);
            }
        }
    }
}
