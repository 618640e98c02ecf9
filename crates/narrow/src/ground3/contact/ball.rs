//! A ball and a triangle: the triangle's point nearest to the centre, and the feature that it lies on.

use super::facet::{Facet, Furthest, edge_number, is_same};
use super::groups::{Base, Groups, Pin};
use super::rejected_gaps::ClosestPoints;
use super::standing::Standing;
use super::{Known, PartTest};
use crate::feature::Feature;
use crate::triangle::nearest_on_edges;
use asunder_geometry::Ground;
use asunder_geometry::glam::DVec3;

/// The point of a triangle that is nearest to a ball's centre.
pub(super) struct Nearest {
    at: DVec3,
    pub(super) feature: Furthest,
    /// Of the two surfaces, in metres.
    pub(super) separation: f64,
    /// Unit direction from that point to the centre.
    pub(super) towards: DVec3,
}

impl Nearest {
    /// The point of a triangle that is nearest to a part's centre.
    pub(super) fn of(standing: &Standing, facet: &Facet, doubt: f64) -> Self {
        let center = standing.center;
        Self::at((center, standing.radius), facet, nearest_to(facet, center), doubt)
    }

    /// The same, where the feature and the point nearest to the centre are known.
    #[inline]
    pub(super) fn at(
        (center, radius): (DVec3, f64),
        facet: &Facet,
        (feature, at): (Furthest, DVec3),
        doubt: f64,
    ) -> Self {
        let between = center - at;
        let distance = between.length();
        if feature == Furthest::Face || distance <= doubt {
            let height = facet.height(center);
            let at = center - facet.normal * height;
            return Self { at, feature: Furthest::Face, separation: height - radius, towards: facet.normal };
        }
        Self { at, feature, separation: distance - radius, towards: between / distance }
    }

    /// What is kept of it where ground rejects the direction, which is not the triangle's normal.
    #[inline]
    pub(super) fn closest_points(
        &self,
        (center, radius): (DVec3, f64),
        (ground, number): (Ground, u32),
        doubt: f64,
    ) -> ClosestPoints {
        let Self { at, separation, towards, .. } = *self;
        let ends = [center - towards * radius, at];
        ClosestPoints {
            number,
            separation,
            doubt,
            ends,
            normal: towards,
            is_own: false,
            may_touch: !ground.is_one_sided(),
        }
    }

    /// Adds the contact point, if ground accepts the direction; returns whether it did.
    pub(super) fn add_point(
        &self,
        (center, radius): (DVec3, f64),
        facet: &Facet,
        ground: Ground,
        doubt: f64,
        groups: &mut Groups,
    ) -> bool {
        let is_face = self.feature == Furthest::Face || is_same(facet.normal, self.towards);
        let is_prominent = match self.feature {
            Furthest::Face => true,
            Furthest::Edge(edge) => ground.prominent(facet.number).edge(edge, facet.is_front),
            Furthest::Corner(corner) => ground.prominent(facet.number).corner(corner, facet.is_front),
        };
        if !(is_face || is_prominent && facet.may_give(ground, self.feature, self.towards)) {
            return false;
        }
        let patch = ground.patch(facet.number);
        let of_ground = match self.feature {
            _ if is_face => Feature::Face(patch),
            Furthest::Corner(corner) => Feature::Vertex(ground.vertex_numbers(facet.number)[corner % 3]),
            Furthest::Edge(edge) => Feature::Edge(edge_number(ground, facet.number, edge)),
            Furthest::Face => Feature::Face(patch),
        };
        let normal = if is_face { facet.normal } else { self.towards };
        let on_body = center - normal * radius;
        let pin = Pin {
            on_body,
            on_ground: self.at,
            separation: self.separation,
            doubt,
            of_body: Feature::Vertex(0),
            of_ground,
        };
        let weight = if is_face { facet.area() } else { 0.0 };
        groups.add(&Base { weight, ..Base::along(normal, patch) }, pin);
        true
    }
}

impl PartTest<'_> {
    /// Processes one triangle, for a ball.
    pub(super) fn look_at_from_ball(&self, number: u32, known: &mut Known) {
        let ground = self.query.on.ground;
        let Some(facet) = &Facet::facing(ground, number, self.standing.center) else { return };
        let doubt = self.doubt_over(facet);
        if facet.height(self.standing.center) - self.standing.radius > self.query.reach + doubt {
            return;
        }
        let nearest = Nearest::of(self.standing, facet, doubt);
        if nearest.separation > self.query.reach + doubt {
            return;
        }
        let ball = (self.standing.center, self.standing.radius);
        let is_within = nearest.separation <= self.query.reach;
        let has_points = is_within && nearest.add_point(ball, facet, ground, doubt, &mut known.groups);
        if is_within && !has_points {
            known.keep_rejected_gap(nearest.closest_points(ball, (ground, number), doubt));
        }
        if known.overlapping || nearest.separation > doubt {
            return;
        }
        if nearest.separation < -doubt {
            return known.settle(facet.number);
        }
        self.leave_unclear(facet.number, (has_points, nearest.separation), known);
    }
}

/// The feature of a triangle nearest to a point, and the nearest point on it. Over the face the point itself is
/// returned; the caller computes its foot.
pub(super) fn nearest_to(facet: &Facet, point: DVec3) -> (Furthest, DVec3) {
    match nearest_on_edges(|edge| facet.edge(edge), |along| facet.inwards(along), point) {
        None => (Furthest::Face, point),
        Some((edge, place, at)) if place <= 0.0 => (Furthest::Corner(edge), at),
        Some((edge, place, at)) if place >= 1.0 => (Furthest::Corner((edge + 1) % 3), at),
        Some((edge, _, at)) => (Furthest::Edge(edge), at),
    }
}
