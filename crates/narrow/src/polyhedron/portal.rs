//! Overlap test of two solids, by a ray from inside their difference.
//!
//! ```text
//! M = A - B, which holds the origin where A and B share a point; v = the difference of the centres, inside M
//! 1 spheres: if the centres are closer than the sum of both inner radii, A and B overlap
//! 2 three vertices of M around the ray from v through the origin: a portal. Each is the support point along some
//!   direction; if it lies short of the origin, that direction separates A and B
//! 3 if the origin lies between v and the portal, it is inside the tetrahedron of v and the three, and so inside M
//! 4 else take the support point beyond the portal, and go on with the one of three smaller portals that the ray meets
//! ```
//! Snethen, "XenoCollide: complex collision made simple" (Game Programming Gems 7, 2008). Each step needs one support
//! vertex of A and one of B, and neither a face nor a distance: an overlap test of two hulls of 32 vertices takes 4 to
//! 6 of them. Every answer was checked beyond rounding; what stalls, or is too close to call, is left to the distance
//! iteration.

use super::distance::is_around_origin;
use super::solid::Solid;
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// Most support vertices before the search gives up. Sets of random hulls need 2 to 9.
const MAX_VERTICES: usize = 32;

/// What the search has proved.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Found {
    /// A unit direction from A to B along which they are further apart than the limit, and the separation along it.
    Beyond(DVec3, f64),
    /// A common point.
    Overlap,
    /// Nothing; this is the last direction that was tried.
    Nothing(DVec3),
}

/// Searches for a direction that separates the solids by more than `beyond`, or for a common point. Cost: a few support
/// searches.
pub(crate) fn search(a: &Solid, b: &Solid, beyond: f64, precision: &Precision) -> Found {
    let inside = a.center() - b.center();
    let apart = inside.length();
    if a.inner_radius <= 0.0 || b.inner_radius <= 0.0 {
        // Flat solids have no inside to start a ray from.
        return Found::Nothing(-inside.try_normalize().unwrap_or(DVec3::X));
    }
    if do_spheres_meet(a, b, apart, precision) {
        return Found::Overlap;
    }
    if apart == 0.0 {
        // Slivers about the same centre, thinner than rounding: there is no ray.
        return Found::Nothing(DVec3::X);
    }
    let mut look = Look::new((a, b), -inside / apart, precision);
    match look.through(inside) {
        Some(Some(corners)) if is_around_origin(corners, precision) => Found::Overlap,
        None if look.separation > beyond => Found::Beyond(look.unit(), look.separation),
        _ => Found::Nothing(look.unit()),
    }
}

/// Whether spheres inside both overlap beyond rounding, given how far their centres are apart.
pub(crate) fn do_spheres_meet(a: &Solid, b: &Solid, apart: f64, precision: &Precision) -> bool {
    apart + 2.0 * precision.projection() < a.inner_radius + b.inner_radius
}

/// Four points of the difference around the origin; `None` where none are found beyond rounding, or the solids have no
/// inside to start from. Cost: a few support searches.
pub(super) fn around(a: &Solid, b: &Solid, precision: &Precision) -> Option<[DVec3; 4]> {
    let (mut inside, radius) = (a.center() - b.center(), a.inner_radius + b.inner_radius);
    let has_inside = a.inner_radius > 0.0 && b.inner_radius > 0.0;
    if !has_inside {
        return None;
    }
    // A point that all but coincides with the origin gives no ray; any other in the sphere about it will do.
    if inside.length() < 0.5 * radius {
        inside.x += (0.5 * radius).copysign(inside.x);
    }
    let mut look = Look::new((a, b), -inside.try_normalize()?, precision);
    look.through(inside)?.filter(|&corners| is_around_origin(corners, precision))
}

/// A search for vertices of the difference, one after the other.
struct Look<'a, 'b> {
    a: &'a Solid<'b>,
    b: &'a Solid<'b>,
    /// A separation beyond this is more than rounding: the solids are apart.
    doubt: f64,
    /// The direction of the last support search, of any length.
    direction: DVec3,
    /// The separation that it showed, in metres; if negative, in units of the direction's length.
    separation: f64,
    left: usize,
}

impl<'a, 'b> Look<'a, 'b> {
    /// Before the first support search.
    fn new((a, b): (&'a Solid<'b>, &'a Solid<'b>), direction: DVec3, precision: &Precision) -> Self {
        Self { a, b, doubt: precision.projection(), direction, separation: 0.0, left: MAX_VERTICES }
    }

    fn unit(&self) -> DVec3 {
        self.direction.try_normalize().unwrap_or(DVec3::X)
    }

    /// The support vertex along a direction of any length; `None` if that separates the solids, if there is no
    /// direction, or if there were too many. A root is taken only where the solids seem to be separated.
    fn along(&mut self, mut direction: DVec3) -> Option<DVec3> {
        let mut square = direction.length_squared();
        // The lanes are f32: what is much shorter or longer would leave their range, and with it their bound.
        if !(1e-40..1e40).contains(&square) {
            (direction, square) = (direction.try_normalize()?, 1.0);
        }
        self.left = self.left.checked_sub(1)?;
        self.direction = direction;
        let ((in_a, _), (in_b, _)) = (self.a.rough_support(direction), self.b.rough_support(-direction));
        self.separation = -in_b.reach - in_a.reach;
        if self.separation > 0.0 {
            self.separation /= square.sqrt();
        }
        (self.separation <= self.doubt).then(|| self.a.point(in_a.vertex) - self.b.point(in_b.vertex))
    }

    /// Follows the ray from a point inside, to corners that are around the origin up to rounding. `None` where a
    /// support search led no further: its direction separates the solids, or there were too many. No corners where the
    /// ray leaves the difference short of the origin, by no more than rounding.
    fn through(&mut self, inside: DVec3) -> Option<Option<[DVec3; 4]>> {
        let mut one = self.along(self.direction)?;
        let mut two = self.along(one.cross(inside))?;
        let mut square = (one - inside).cross(two - inside);
        // Seen from inside, the portal's corners go counter-clockwise about the ray.
        if square.dot(inside) > 0.0 {
            (one, two, square) = (two, one, -square);
        }
        let mut three = self.along(square)?;
        loop {
            if one.cross(three).dot(inside) < 0.0 {
                two = three;
            } else if three.cross(two).dot(inside) < 0.0 {
                one = three;
            } else {
                break;
            }
            three = self.along((one - inside).cross(two - inside))?;
        }
        loop {
            let outwards = (two - one).cross(three - one);
            if outwards.dot(one) >= 0.0 {
                return Some(Some([inside, one, two, three]));
            }
            let beyond = self.along(outwards)?;
            if (beyond - three).dot(outwards) <= 0.0 {
                // The portal lies on the surface of M, short of the origin by less than rounding.
                return Some(None);
            }
            // Which side of the plane through the ray and the new vertex each corner lies on.
            let across = beyond.cross(inside);
            if one.dot(across) > 0.0 {
                if two.dot(across) > 0.0 { one = beyond } else { three = beyond }
            } else if three.dot(across) > 0.0 {
                two = beyond;
            } else {
                one = beyond;
            }
        }
    }
}
