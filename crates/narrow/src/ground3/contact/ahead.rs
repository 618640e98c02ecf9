//! Ground ahead of a body in motion: triangles beyond a concave edge.
//!
//! Contacts are with the ground that a body is opposite now. At the foot of a slope, the slope's nearest point is on a
//! concave edge, which gives no direction (see `contact`), so a body that comes to the slope within this frame would
//! have no contact with it before it is inside. For a pair with a motion a second pass adds those contacts:
//!
//! ```text
//! for each triangle near the part, seen from the part's side:
//!   the part is no further from it than the motion goes, and all of it is in front of the plane
//!   what of the part lies over the plane beyond a concave edge, inside all other sides:   points along the normal
//!   nearer than all contacts so far:   none of them, since the edge's other triangle would be nearer
//! ```
//! The plane stands for ground that is not there, so such a point may stop a body a frame too early where it passes
//! over a short slope. It never does where the body keeps to the ground: up to the edge, the plane is behind the other
//! triangle. Cost: that of reading the triangles twice, for pairs with a motion alone.

use super::ball::nearest_to;
use super::facet::{Facet, Furthest, across};
use super::groups::{Base, Pin};
use super::over::Plane;
use super::prism::Prism;
use super::round::Round;
use super::{GroundQuery, Known, PartTest};
use crate::feature::Feature;
use asunder_geometry::Ground;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::SAME_NORMAL;
use core::ops::ControlFlow;

impl PartTest<'_> {
    /// Adds points over the planes of triangles ahead.
    #[cold]
    #[inline(never)]
    pub(super) fn look_ahead(&self, known: &mut Known) {
        let (ground, ahead, standing) = (self.query.on.ground, self.query.ahead, self.standing);
        let least = known.groups.least();
        if least == f64::INFINITY || standing.outer_radius == f64::INFINITY {
            return;
        }
        let _ = ground.read_near(&self.bounds, |near| {
            let Some(facet) = Facet::facing(ground, near.number, standing.center) else {
                return ControlFlow::Continue(());
            };
            let open = facet.concave_sides(ground);
            let beyond =
                (standing.center - nearest_to(&facet, standing.center).1).length() - standing.outer_radius;
            if beyond > ahead {
                return ControlFlow::Continue(());
            }
            if self.is_ball {
                let ball = (standing.center, standing.radius, self.doubt_over(&facet));
                add_ball(ball, (ground, &facet, open), [least, ahead], known);
                return ControlFlow::Continue(());
            }
            let Plane { facet, extent, doubt, .. } = &self.over(facet);
            let separation = extent.low - standing.radius;
            let is_nearest = separation <= known.groups.least_along(facet.normal) + standing.slack;
            if separation > 0.0 && separation >= least && separation <= ahead && is_nearest {
                let prism = Prism {
                    ground,
                    standing,
                    facet,
                    extent,
                    reach: ahead,
                    doubt: *doubt,
                    gate: None,
                    ahead: Some(open),
                };
                self.add_by_normal(&prism, known);
            }
            ControlFlow::Continue(())
        });
    }
}

impl Round {
    /// The same for a sphere on its fast path.
    #[cold]
    #[inline(never)]
    pub(super) fn look_ahead(&self, query: &GroundQuery, known: &mut Known) {
        let (ground, least) = (query.on.ground, known.groups.least());
        if least == f64::INFINITY {
            return;
        }
        let _ = ground.read_near(&self.bounds(), |near| {
            if let Some(facet) = Facet::facing(ground, near.number, self.center) {
                let ball = (self.center, self.radius, facet.doubt((self.center, self.radius), self.lengths));
                let open = facet.concave_sides(ground);
                add_ball(ball, (ground, &facet, open), [least, query.ahead], known);
            }
            ControlFlow::Continue(())
        });
    }
}

/// Adds the point of a ball, with the error bound of its height, over the plane of a triangle with these open sides.
fn add_ball(
    (center, radius, doubt): (DVec3, f64, f64),
    (ground, facet, open): (Ground, &Facet, [bool; 3]),
    [least, ahead]: [f64; 2],
    known: &mut Known,
) {
    let separation = facet.height(center) - radius;
    let is_in_reach = separation > 0.0 && separation >= least && separation <= ahead;
    if !is_in_reach
        || (center - nearest_to(facet, center).1).length() - radius > ahead
        || !facet.is_ahead(ground, center, open)
    {
        return;
    }
    let patch = ground.patch(facet.number);
    let pin = Pin {
        on_body: center - facet.normal * radius,
        on_ground: center - facet.normal * facet.height(center),
        separation,
        doubt,
        of_body: Feature::Vertex(0),
        of_ground: Feature::Face(patch),
    };
    known.groups.add(&Base { weight: facet.area(), ..Base::along(facet.normal, patch) }, pin);
}

impl Facet {
    /// The sides beyond which ground rises on the side of the part.
    fn concave_sides(&self, ground: Ground) -> [bool; 3] {
        [0, 1, 2].map(|edge| {
            ground.neighbor(self.number, edge).is_some_and(|(other, twin)| {
                let leaving = across(ground, other, twin);
                let rise = leaving.dot(self.normal);
                rise > 0.0 && rise * rise > SAME_NORMAL * SAME_NORMAL * leaving.length_squared()
            })
        })
    }

    /// Whether a point's foot is beyond an open side, and the triangle's nearest point on that or at an end of it.
    pub(super) fn is_ahead(&self, ground: Ground, point: DVec3, open: [bool; 3]) -> bool {
        let is_beyond = |edge: usize| open[edge] && self.inside(point, |other| other == edge) < 0.0;
        match nearest_to(self, point) {
            (Furthest::Face, _) => false,
            (Furthest::Edge(edge), _) => is_beyond(edge),
            (Furthest::Corner(corner), at) => {
                is_beyond(corner)
                    || is_beyond((corner + 2) % 3)
                    || !self.may_give(ground, Furthest::Corner(corner), (point - at).normalize_or_zero())
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
        let is_ahead = |open| pin.separation > 0.0 && self.facet.is_ahead(self.ground, pin.on_body, open);
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
