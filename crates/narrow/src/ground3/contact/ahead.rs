//! Ground ahead of a body in motion: triangles beyond a concave edge.
//!
//! Contacts are with the ground that a body is opposite now. At the foot of a slope, the slope's nearest point is on a
//! concave edge, which gives no direction (see `contact`), so a body that comes to the slope within this frame would
//! have no contact with it before it is inside. For a pair with a motion a second pass adds those contacts:
//!
//! ```text
//! for each triangle near the part, seen from the part's side:
//!   the part is no further from it than the motion goes, and all of it is in front of the plane
//!   what of the part lies over the plane, beyond a concave edge whose other triangle is seen from its side as well,
//!       or beyond a corner that gives no direction:                                      points along the normal
//!   nearer than all contacts so far:   none of them, since the edge's other triangle would be nearer
//! ```
//! The plane stands for ground that is not there, so such a point may stop a body a frame too early where it passes
//! over a short slope. It never does where the body keeps to the ground: up to the edge, the plane is behind the other
//! triangle.
//!
//! Cost: that of reading the triangles twice, for pairs with a motion alone. Frames of bodies of a metre that move by a
//! third of that over bumps take 21 % (hulls) to 42 % (balls) more instructions than without this pass (callgrind,
//! 2026-11-29).

use super::ball::nearest_to;
use super::facet::{Facet, Furthest, across};
use super::groups::{Base, Pin};
use super::over::Plane;
use super::prism::Prism;
use super::round::Round;
use super::{GroundQuery, Known, PartTest};
use crate::feature::Feature;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;
use asunder_geometry::{Ground, NearTriangle};
use core::ops::ControlFlow;

/// Share of a distance within which two triangles count as equally near: their nearest point is on a common edge.
const EQUALLY_NEAR: f64 = 1e-9;

impl PartTest<'_> {
    /// Adds points over the planes of triangles ahead.
    #[cold]
    #[inline(never)]
    pub(super) fn look_ahead(&self, known: &mut Known) {
        let (ground, standing) = (self.query.on.ground, self.standing);
        let Some(reach) = Reach::of(self.query, known) else { return };
        // A half-space has a single normal.
        if standing.outer_radius == f64::INFINITY {
            return;
        }
        known.groups.fix();
        let _ = ground.read_near(&self.bounds, |near| {
            let radii = [standing.radius, standing.outer_radius];
            if let Some(facet) = reach.facet(ground, near, standing.center, radii) {
                self.add_ahead(facet, &reach, known);
            }
            ControlFlow::Continue(())
        });
    }

    fn add_ahead(&self, facet: Facet, reach: &Reach, known: &mut Known) {
        let standing = self.standing;
        let plane = self.over(facet);
        let Plane { facet, extent, .. } = &plane;
        let separation = extent.low - standing.radius;
        // Another triangle of the same normal is nearer.
        let is_hidden = || separation > known.groups.least_along(facet.normal) + standing.slack;
        if !reach.holds(separation) || is_hidden() {
            return;
        }
        let open = [0, 1, 2].map(|edge| facet.is_concave(self.query.on.ground, edge, standing.center));
        let prism = Prism { reach: reach.most, ahead: Some(open), ..self.prism_over(&plane) };
        self.add_by_normal(&prism, known);
    }
}

impl Round {
    /// The same for a sphere, whichever path has found its other contacts.
    #[cold]
    #[inline(never)]
    pub(super) fn look_ahead(&self, query: &GroundQuery, known: &mut Known) {
        let (ground, Some(reach)) = (query.on.ground, Reach::of(query, known)) else { return };
        known.groups.fix();
        let _ = ground.read_near(&self.bounds(), |near| {
            if let Some(facet) = reach.facet(ground, near, self.center, [self.radius; 2]) {
                let ball = (self.center, self.radius, facet.doubt((self.center, self.radius), self.lengths));
                reach.add_ball(ball, (ground, &facet), known);
            }
            ControlFlow::Continue(())
        });
    }
}

/// Which separations matter, in metres: no less than that of the nearest contact, and no more than the motion.
struct Reach {
    least: f64,
    most: f64,
}

impl Reach {
    /// `None` where there is no contact at all.
    fn of(query: &GroundQuery, known: &Known) -> Option<Self> {
        let least = known.groups.least();
        (least < f64::INFINITY).then_some(Self { least, most: query.ahead })
    }

    fn holds(&self, separation: f64) -> bool {
        separation > 0.0 && separation >= self.least && separation <= self.most
    }

    /// A triangle seen from a part's centre, if the part may be within reach of it, and in front of it. All of the part
    /// is within the outer of the two radii, and a ball of the inner one around the centre within the part.
    fn facet(
        &self,
        ground: Ground,
        near: &NearTriangle,
        center: DVec3,
        [inner, outer]: [f64; 2],
    ) -> Option<Facet> {
        let mut facet = Facet::front_of(near.number, near.corners)?;
        let height = facet.height(center);
        if height.abs() <= inner
            || height.abs() > outer + self.most
            || ground.is_one_sided() && height < 0.0
            || (center - nearest_to(&facet, center).1).length() > outer + self.most
        {
            return None;
        }
        if !facet.has_in_front(ground, center) {
            facet.turn_over();
        }
        (facet.height(center) > 0.0).then_some(facet)
    }

    /// Adds the point of a ball, with the error bound of its height, over the plane of a triangle ahead.
    fn add_ball(
        &self,
        (center, radius, doubt): (DVec3, f64, f64),
        (ground, facet): (Ground, &Facet),
        known: &mut Known,
    ) {
        let height = facet.height(center);
        if !self.holds(height - radius)
            || !facet.is_ahead(ground, [center; 2], |edge| facet.is_concave(ground, edge, center))
        {
            return;
        }
        let patch = ground.patch(facet.number);
        let pin = Pin {
            on_body: center - facet.normal * radius,
            on_ground: center - facet.normal * height,
            separation: height - radius,
            doubt,
            of_body: Feature::Vertex(0),
            of_ground: Feature::Face(patch),
        };
        known.groups.add(&Base { weight: facet.area(), ..Base::along(facet.normal, patch) }, pin);
    }
}

impl Facet {
    /// Whether ground rises beyond a side, on the side of the part, and has the part's centre on that side.
    ///
    /// The latter since two-sided ground behind a convex edge, like the far wall of a crate seen from above its lid,
    /// bends towards the side from which no body that is over the edge can come.
    fn is_concave(&self, ground: Ground, edge: usize, center: DVec3) -> bool {
        ground.neighbor(self.number, edge).is_some_and(|(other, twin)| {
            let leaving = across(ground, other, twin);
            let rise = leaving.dot(self.normal);
            rise > 0.0
                && rise * rise > SAME_NORMAL * SAME_NORMAL * leaving.length_squared()
                && self.has_same_side(ground, other, center)
        })
    }

    /// The same for a corner: whether the part's centre is on the side from which this triangle is seen, judged by the
    /// triangle nearest to a point among those around the corner; of equally near ones, by all.
    fn has_same_side_around(&self, ground: Ground, corner: usize, [point, center]: [DVec3; 2]) -> bool {
        let (mut nearest, mut is_same) = (f64::INFINITY, true);
        self.do_all_around(ground, corner, |other, _| {
            if let Some(facet) = Self::front_of(other, ground.corners(other)) {
                let distance = match nearest_to(&facet, point) {
                    (Furthest::Face, _) => facet.height(point).abs(),
                    (_, at) => (point - at).length(),
                };
                let is_other_same = self.has_same_side(ground, other, center);
                if distance < nearest * (1.0 - EQUALLY_NEAR) {
                    (nearest, is_same) = (distance, is_other_same);
                } else if distance <= nearest * (1.0 + EQUALLY_NEAR) {
                    is_same &= is_other_same;
                }
            }
            true
        });
        is_same
    }

    /// Whether a point of a part with this centre has its foot beyond an open side, and the triangle's nearest point on
    /// that or at an end of it; or at a corner that may not give the direction to the point.
    pub(super) fn is_ahead(
        &self,
        ground: Ground,
        [point, center]: [DVec3; 2],
        is_open: impl Fn(usize) -> bool,
    ) -> bool {
        let is_beyond = |edge: usize| self.inside(point, |other| other == edge) < 0.0 && is_open(edge);
        match nearest_to(self, point) {
            (Furthest::Face, _) => false,
            (Furthest::Edge(edge), _) => is_beyond(edge),
            (Furthest::Corner(corner), at) => {
                let is_rejected =
                    || !self.may_give(ground, Furthest::Corner(corner), (point - at).normalize_or_zero());
                (is_beyond(corner) || is_beyond((corner + 2) % 3) || is_rejected())
                    && self.has_same_side_around(ground, corner, [point, center])
            }
        }
    }
}

impl Prism<'_> {
    /// Whether the triangle counts as going on beyond a side.
    #[inline(always)]
    pub(super) fn goes_on_beyond(&self, edge: usize) -> bool {
        self.ahead.is_some_and(|open| open[edge % 3])
    }

    /// Whether a point along the triangle's normal is wanted: with ground ahead, only one beyond the triangle.
    #[inline(always)]
    pub(super) fn is_wanted(&self, pin: &Pin) -> bool {
        let is_ahead = |open: [bool; 3]| {
            pin.separation > 0.0
                && self.facet.is_ahead(self.ground, [pin.on_body, self.standing.center], |edge| open[edge])
        };
        self.ahead.is_none_or(is_ahead)
    }

    /// The fractions of a side's length between which it counts: beyond a corner at which an open side begins, it goes
    /// on.
    #[inline(always)]
    pub(super) fn stretch_of(&self, edge: usize) -> [f64; 2] {
        let low = if self.goes_on_beyond(edge + 2) { f64::NEG_INFINITY } else { 0.0 };
        let high = if self.goes_on_beyond(edge + 1) { f64::INFINITY } else { 1.0 };
        [low, high]
    }
}
