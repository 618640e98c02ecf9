//! Triangles across a gap that gave no contact point because ground rejected their direction.
//!
//! The nearest point of all ground is in the Voronoi region of its own feature, and its direction is accepted. The
//! exceptions:
//!
//! - The direction is the triangle's normal up to the tolerance, but all of the part's incident face, or its nearest
//!   point, is clipped away along the normal: the part's nearest point is a hair outside the triangle; or the part is
//!   rounded, and nearest with a rounded edge that crosses the triangle from side to side.
//! - A face of the part that is nearly as good was preferred, and ground rejects its normal.
//! - The part reaches around a rim or a fold of two-sided ground: its centre is on one side and its nearest point on
//!   the other, from which the triangle is not tested, or is taken for penetrated; or a corner is so crumpled that it
//!   has no sides.
//!
//! Then nothing was reported for a part within the margin, 58 times in 2.8 M random poses beside rims, folds and fans
//! of triangles, half of them capsules; or, for rounded boxes in a groove, a separation that was millimetres too large.
//! So the kernels' answers are kept, one per direction, and reported at the end: along a triangle's normal where
//! nothing along that is as near, along other directions where nothing at all is.

use super::facet::{Facet, Furthest, edge_number, is_same};
use super::groups::{Base, Pin};
use super::{Known, PartTest, Unclear};
use crate::feature::Feature;
use arrayvec::ArrayVec;
use asunder_geometry::Ground;
use asunder_geometry::glam::DVec3;

/// The closest points, by the kernels or a closed form, for a triangle that gave no contact point.
#[derive(Clone, Copy, Debug)]
pub(super) struct ClosestPoints {
    pub(super) number: u32,
    /// In metres, below zero in overlap; and its error bound.
    pub(super) separation: f64,
    pub(super) doubt: f64,
    /// The closest points, on the part and on the ground.
    pub(super) ends: [DVec3; 2],
    /// Unit direction from the ground to the part: the triangle's normal where it is the same; and whether it is.
    pub(super) normal: DVec3,
    pub(super) is_own: bool,
    /// Whether ground may be touched along it: one-sided ground has no back, and its rims give only some directions.
    pub(super) may_touch: bool,
}

/// One per direction, the nearest first; of too many, the nearest stay.
pub(super) type RejectedGaps = ArrayVec<ClosestPoints, 8>;

impl ClosestPoints {
    /// For a triangle and a unit direction from it to the part: their separation and its error bound, and their closest
    /// points.
    pub(super) fn along(
        (ground, facet): (Ground, &Facet),
        towards: DVec3,
        [separation, doubt]: [f64; 2],
        ends: [DVec3; 2],
    ) -> Self {
        let is_own = is_same(facet.normal, towards);
        let normal = if is_own { facet.normal } else { towards };
        // What was rejected may be a face of the part that is nearly as good as this. A needle is level in many
        // directions: when only its normal was accepted, bodies beside the rim of a strip of needles were reported
        // further away than they are.
        let is_given = || match facet.furthest(towards) {
            Furthest::Face => {
                facet.normal.dot(towards) > 0.0 || facet.may_give_across(ground, towards, |_| true)
            }
            furthest => facet.may_give(ground, furthest, towards),
        };
        let may_touch = is_own || !ground.is_one_sided() || is_given();
        Self { number: facet.number, separation, doubt, ends, normal, is_own, may_touch }
    }

    /// Whether it comes before another; of equals the one of the lower number.
    fn is_before(&self, other: &Self) -> bool {
        (self.separation, self.number) < (other.separation, other.number)
    }
}

impl Known {
    /// Keeps the nearest of each direction.
    pub(super) fn keep_rejected_gap(&mut self, gap: ClosestPoints) {
        if !gap.may_touch {
            return;
        }
        let all = &mut self.rejected_gaps;
        let same = all.iter().position(|known| is_same(known.normal, gap.normal));
        let in_place = same.or_else(|| all.is_full().then(|| all.len() - 1));
        if let Some(place) = in_place {
            if !gap.is_before(&all[place]) {
                return;
            }
            all.remove(place);
        }
        let place = all.partition_point(|known| known.is_before(&gap));
        let _ = all.try_insert(place, gap);
    }

    /// Whether something is nearer than all contact points, by more than `slack` metres, for a part that overlaps no
    /// triangle.
    pub(super) fn has_nearer_rejected_gap(&self, slack: f64) -> bool {
        let least = self.groups.least() - slack;
        !self.overlapping && self.rejected_gaps.first().is_some_and(|nearest| nearest.separation < least)
    }

    /// Records the least separation kept here, where it is that of the nearest contact point up to the slack: the
    /// points stay.
    pub(super) fn record_rejected_gap(&mut self, slack: f64) {
        let least = self.groups.least();
        if let Some(nearest) = self.rejected_gaps.first()
            && !self.overlapping
            && (least - slack..least).contains(&nearest.separation)
        {
            self.groups.record_nearest([nearest.separation, nearest.doubt]);
        }
    }
}

impl PartTest<'_> {
    /// Reports what was kept. Cost: some kernel calls for a part that is near two-sided ground from behind, and touches
    /// nothing.
    pub(super) fn report_rejected_gaps(&self, known: &mut Known) {
        if !known.overlapping {
            self.look_behind(known);
        }
        if known.rejected_gaps.is_empty() {
            return;
        }
        let slack = self.standing.slack;
        let least = known.groups.least();
        known.record_rejected_gap(slack);
        // By index: taking the list out would copy all of it.
        for place in 0..known.rejected_gaps.len() {
            let gap = known.rejected_gaps[place];
            let along = known.groups.least_along(gap.normal);
            if gap.is_own && (along - slack..along).contains(&gap.separation) {
                // The same place up to the slack: the points stay.
                known.groups.record(gap.normal, [gap.separation, gap.doubt]);
            }
            let is_nearer = if gap.is_own {
                gap.separation < along - slack
            } else {
                !known.overlapping && gap.separation < least - slack
            };
            if is_nearer {
                self.add_rejected_gap(&gap, known);
            }
        }
    }

    pub(super) fn add_rejected_gap(&self, gap: &ClosestPoints, known: &mut Known) {
        let (ground, standing) = (self.query.on.ground, self.standing);
        let ClosestPoints { number, separation, doubt, ends: [on_body, on_ground], normal, .. } = *gap;
        let Some(facet) = Facet::facing(ground, number, standing.center) else { return };
        // Gets the id of a side of the triangle, wherever that is: a contact between a vertex and a side is never moved
        // along, and rejected ground might come nearer on the way.
        let away = |edge: usize| facet.inside(on_ground, |other| other == edge).abs();
        let edge = (1..3).fold(0, |best, edge| if away(edge) < away(best) { edge } else { best });
        let of_body = Feature::Vertex(standing.extent(normal, on_ground).lowest as u32);
        let of_ground = Feature::Edge(edge_number(ground, number, edge));
        let pin = Pin { on_body, on_ground, separation, doubt, of_body, of_ground };
        known.groups.add(&Base::along(normal, ground.patch(number)), pin);
    }

    /// Calls the kernels for triangles that were taken for penetrated and are not: the part is on their other side.
    fn look_behind(&self, known: &mut Known) {
        let (ground, standing) = (self.query.on.ground, self.standing);
        if ground.is_one_sided() || known.unclear.is_empty() {
            return;
        }
        for place in 0..known.unclear.len() {
            let Unclear { separation, number, .. } = known.unclear[place];
            if separation < -standing.slack
                && let Some(facet) = Facet::facing(ground, number, standing.center)
                && let Some(gap) = self.meeting.gap((ground, &facet), &standing.place, self.query)
            {
                known.keep_rejected_gap(gap);
            }
        }
    }
}
