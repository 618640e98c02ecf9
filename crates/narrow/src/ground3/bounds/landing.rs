//! Where a part that moves without turning comes down on the inside of a triangle: in closed form.
//!
//! ```text
//! n = the triangle's normal, against the motion; p = the part's lowest point along it
//! h = how high p is above the plane: no other axis needs to show that the two are apart before all of h is gone
//! where all of h but a rest is gone, p is above the inside of the triangle: there they are no further apart than that rest
//! p starts below the plane, moves along it, or comes down beside the triangle: left to others
//! ```
//! Most of what walks or falls on ground meets it so. The triangle found this way ends the search for most of the
//! others, whose planes are reached later: so it is looked for before anything is searched in steps.

use super::{Corners, Extent};
use crate::pair3::Part;
use crate::precision::{closed_after, off_closing};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::IMPACT_REST;

/// A part that has come down on a triangle, in the ground's axes.
pub(crate) struct Landing {
    /// A share of the motion before which the two certainly do not touch.
    pub(crate) fraction: f64,
    /// An upper bound on the gap that is left there, in metres.
    pub(crate) gap: f64,
    /// Unit normal of the triangle, towards the part.
    pub(crate) up: DVec3,
    /// The part's lowest point, where the motion starts.
    pub(crate) foot: DVec3,
}

impl Corners {
    /// Where a part comes down on the inside of a triangle, if it certainly does so, before it has moved by `until`
    /// times `way`. What `rounding` poses may take from a gap, in metres, is left.
    pub(crate) fn landing(
        &self,
        part: &Part,
        corners: [Vec3; 3],
        (way, until, rounding): (DVec3, f64, f64),
    ) -> Option<Landing> {
        let corners = corners.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).try_normalize()?;
        let up = if normal.dot(way) < 0.0 { normal } else { -normal };
        let foot = self.lowest(part, up)? - up * f64::from(part.shape.radius());
        let doubt = 128.0 * f64::EPSILON * self.lengths_with(&corners);
        let off = off_closing(way);
        let highest = up.dot(b - a).max(up.dot(c - a)).max(0.0);
        let (height, closing) = (up.dot(foot - a) - highest - doubt - rounding, -up.dot(way));
        if height <= 0.0 || closing <= off {
            return None;
        }
        let rest = (IMPACT_REST * f64::from(part.shape.outer_radius())).max(4.0 * doubt);
        let fraction = closed_after(height - rest, closing + off).next_down().max(0.0);
        let there = foot + way * fraction;
        let doubt = doubt + off;
        let is_inside = |from: DVec3, to: DVec3| {
            let inwards = normal.cross(to - from);
            inwards.dot(there - from) > 2.0 * doubt * (to - from).abs().element_sum()
        };
        let is_landing = fraction < until && is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
        is_landing.then(|| Landing { fraction, gap: up.dot(there - a).max(0.0) + doubt, up, foot })
    }

    /// The vertex of a part's core that is furthest against a unit axis; `None` for a half-space. Cost: linear in the
    /// vertices.
    fn lowest(&self, part: &Part, up: DVec3) -> Option<DVec3> {
        let place = |local: DVec3| {
            let [x, y, z] = self.axes;
            self.origin + (x * local.x + y * local.y + z * local.z)
        };
        let lower = |axis: DVec3| {
            move |one: DVec3, other: DVec3| if axis.dot(other) < axis.dot(one) { other } else { one }
        };
        match &self.extent {
            Extent::Cuboid(half) => Some(place(-*half * self.own(up).signum())),
            Extent::Points(points) if self.has_all => points.iter().copied().reduce(lower(up)),
            Extent::Points(_) => {
                let core = part.shape.core();
                core.vertices().iter().map(|vertex| vertex.as_dvec3()).reduce(lower(self.own(up))).map(place)
            }
        }
    }
}
