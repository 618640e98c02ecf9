//! The extent of a part over a triangle's plane, which most often is the plane of the triangle before.

use super::PartTest;
use super::facet::Facet;
use super::prism::Prism;
use super::standing::Extent;
use asunder_geometry::NearTriangle;
use asunder_geometry::glam::DVec3;

/// A triangle, and the part's extent over its plane.
pub(super) struct Plane {
    pub(super) patch: u32,
    pub(super) facet: Facet,
    pub(super) extent: Extent,
    /// Error bound of heights, in metres.
    pub(super) doubt: f64,
}

impl PartTest<'_> {
    /// Sets `plane` to a triangle's plane and the part's extent over it; most often those of the triangle before are
    /// kept. Returns false where all of the part is further from the plane than the reach, on either side, or the
    /// triangle is not seen. In place: it is large.
    pub(super) fn is_within(&self, near: &NearTriangle, plane: &mut Option<Plane>) -> bool {
        let (ground, standing, patch) = (self.query.on.ground, self.standing, near.patch);
        // Beside the sides of a much larger triangle more is lost to rounding than over the plane of the one before.
        if let Some(plane) = plane.as_mut().filter(|plane| plane.patch == patch)
            && plane.facet.move_on(ground, near.number, 0.25 * plane.doubt, standing.center)
            && self.doubt_over(&plane.facet) <= 0.75 * plane.doubt
        {
            return true;
        }
        let Some(mut facet) = Facet::front_of(near.number, near.corners) else { return false };
        // Twice: other triangles of the patch may lie off the plane by a quarter of it, which leaves three quarters for
        // rounding.
        let doubt = 2.0 * self.doubt_over(&facet);
        let beyond = self.query.reach + standing.radius + doubt;
        // Most triangles are out of reach of the box around the part: its vertices need not be read.
        if facet.height(standing.middle).abs() - standing.reach_along(facet.normal) > beyond + doubt {
            return false;
        }
        let mut extent = standing.extent(facet.normal, facet.origin());
        if extent.low > beyond || -extent.high > beyond {
            return false;
        }
        if !facet.has_in_front(ground, standing.center) {
            if ground.is_one_sided() {
                return false;
            }
            facet.turn_over();
            extent = extent.turned_over();
        }
        *plane = Some(Plane { patch, facet, extent, doubt });
        true
    }

    /// The same for a triangle by its own plane, however far away it is; `None` where it is not seen.
    pub(super) fn plane_of(&self, number: u32) -> Option<Plane> {
        Facet::facing(self.query.on.ground, number, self.standing.center).map(|facet| self.over(facet))
    }

    /// The same for a triangle as seen along a direction, whichever side the part is on: beside bends of two-sided
    /// ground a flat patch may be seen from both sides. For one-sided ground, as `plane_of`.
    pub(super) fn plane_towards(&self, number: u32, direction: DVec3) -> Option<Plane> {
        let ground = self.query.on.ground;
        if ground.is_one_sided() {
            return self.plane_of(number);
        }
        let mut facet = Facet::front_of(number, ground.corners(number))?;
        if facet.normal.dot(direction) < 0.0 {
            facet.turn_over();
        }
        Some(self.over(facet))
    }

    pub(super) fn over(&self, facet: Facet) -> Plane {
        let (patch, doubt) = (self.query.on.ground.patch(facet.number), self.doubt_over(&facet));
        let extent = self.standing.extent(facet.normal, facet.origin());
        Plane { patch, facet, extent, doubt }
    }

    /// The triangle and the part over it, with the reach of the query.
    pub(super) fn prism_over<'p>(&'p self, plane: &'p Plane) -> Prism<'p> {
        let Plane { facet, extent, doubt, .. } = plane;
        let (ground, standing, reach) = (self.query.on.ground, self.standing, self.query.reach);
        Prism { ground, standing, facet, extent, reach, doubt: *doubt, gate: None, ahead: None }
    }
}
