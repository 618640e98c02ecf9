//! Rays against ground made of triangles.
//!
//! ```text
//! for each triangle whose box the ray meets, nearest first, until boxes are beyond the nearest hit
//!   zero is certainly outside its projection along the ray:               no      (Projection::side)
//!   zero is certainly inside it, and nothing was hit yet:                 where the ray meets its plane
//!   else: certainly beside it, behind the origin or beyond the hit:       no      (passes)
//!   else:                                                                 test the triangle by itself
//! ```
//! Watertight: a triangle by itself is hit by what passes within rounding of it, and is skipped here only if the ray is
//! twice as far beside it; so a ray through an edge that two triangles share, or a vertex, hits at least one of them.
//!
//! What makes it fast, in instructions of a ray on 20,000 triangles of rolling land, 3970 before and 2530 now:
//!
//! 1. the ray is turned into the ground's axes, once, and not the triangles out of them; a missed triangle costs no
//!    root and no quotient;
//! 2. corners come out of the tree's leaves, not by index out of tables: on a million triangles that wait for memory
//!    was a third of the time;
//! 3. a triangle that is certainly crossed needs no test of its bounding sphere, nor of its edges again (350);
//! 4. a value written in parts and read whole at once stalls a dozen cycles: the projection and the ray are built in
//!    registers, and the visitor is called in one place, so that it is inlined into the walk (a quarter of the time,
//!    and few instructions).

use super::planes::{self, EDGE_ON};
use super::projection::{Projection, Side};
use super::{Cast, Meeting, length};
use crate::impact3::RayHit3;
use crate::pair3::Part;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Ground, Shape3, Triangle3};

/// A ray in the ground's axes.
struct Local {
    origin: DVec3,
    way: DVec3,
    squared: f64,
    /// Rounding error of a point on it, in metres: at the origin, and more for each length of the way.
    doubt: [f64; 2],
    is_one_sided: bool,
    projection: Projection,
}

impl Cast<'_> {
    /// Where the ray first meets ground with these axes.
    pub(super) fn over(&self, ground: Ground, basis: &Basis3, limit: f64) -> Option<RayHit3> {
        let size = f64::from(self.shape.outer_radius()) + length(self.shape.center().as_dvec3());
        let pace = length(self.way);
        // Twice the slack that any triangle by itself has.
        let doubt = [128.0 * f64::EPSILON * (length(self.from) + size), 128.0 * f64::EPSILON * pace];
        let (origin, way) = (basis.turn_back(self.from), basis.turn_back(self.way));
        let local = Local {
            origin,
            way,
            squared: self.squared,
            doubt,
            is_one_sided: ground.is_one_sided(),
            projection: Projection::new(origin, way, length(self.from) + size),
        };
        // Boxes are grown by the slack of their triangles.
        let grown = Vec3::splat((4.0 * doubt[0]) as f32);
        let mut first: Option<RayHit3> = None;
        let mut within = limit;
        ground.read_along(origin, way, grown, limit, |number, corners| {
            let side = local.projection.side(corners);
            if side == Side::Beside {
                return within;
            }
            // A triangle that is certainly crossed, as the first, is tested at once; any other only if the ray does not
            // certainly pass it.
            let is_plain = side == Side::Inside && first.is_none() && !local.is_one_sided;
            if is_plain || !local.passes(corners, within) {
                let triangle = Triangle3::known(corners);
                let hit = self.on(triangle, basis, within, side == Side::Inside);
                // Of equals, one that the ray starts on, then the lowest number.
                let place = |hit: &RayHit3| (hit.distance, !hit.inside, hit.part);
                if let Some(hit) = hit.map(|hit| RayHit3 { part: number, ..hit })
                    && first.is_none_or(|known| place(&hit) < place(&known))
                {
                    within = hit.distance;
                    first = Some(hit);
                }
            }
            within
        });
        first
    }

    /// The hit on a triangle by itself. If the ray's line crosses the triangle, it also meets its bounding sphere.
    #[inline(always)]
    fn on(&self, triangle: Triangle3, basis: &Basis3, limit: f64, is_crossed: bool) -> Option<RayHit3> {
        if is_crossed {
            let size = f64::from(triangle.outer_radius()) + length(triangle.center().as_dvec3());
            let meeting = planes::crossed_triangle(&self.line(DVec3::ZERO, size), basis, &triangle);
            if !matches!(meeting, Meeting::Open) {
                return self.hit_in_closed_form(meeting, limit);
            }
        }
        self.slowly_on(&triangle.into(), basis, limit)
    }

    #[inline(never)]
    fn slowly_on(&self, triangle: &Shape3, basis: &Basis3, limit: f64) -> Option<RayHit3> {
        let meeting = self.meeting(triangle, basis, DVec3::ZERO, limit);
        Cast { shape: triangle, ..*self }.answer(meeting, limit, || Part::whole(triangle, basis))
    }
}

impl Local {
    /// Whether the ray certainly passes by a triangle, or through a one-sided one from behind.
    #[inline(always)]
    fn passes(&self, corners: [Vec3; 3], limit: f64) -> bool {
        let (a, b, c) = (corners[0].as_dvec3(), corners[1].as_dvec3(), corners[2].as_dvec3());
        let (u, v, from) = (b - a, c - a, self.origin - a);
        let normal = u.cross(v);
        let (height, pace) = (normal.dot(from), normal.dot(self.way));
        if self.is_one_sided && pace > 0.0 {
            return true;
        }
        let area = normal.length_squared();
        let off = self.doubt[0] * self.doubt[0] * area;
        let steep = pace * pace;
        if height * height <= off || steep <= 4.0 * EDGE_ON * EDGE_ON * self.squared * area {
            return false;
        }
        let distance = -height / pace;
        let doubt = self.doubt[0] + self.doubt[1] * distance;
        let off = doubt * doubt * area;
        let beyond = (distance - limit) * pace;
        if distance < 0.0 || distance > limit && beyond * beyond > off {
            return true;
        }
        let at = from + self.way * distance;
        // Beside an edge by more than the error over the ray's steepness: both sides squared, times the area's and the
        // pace's.
        let off = off * area * self.squared;
        let is_beside = |edge: DVec3, at: DVec3| {
            let inwards = normal.dot(edge.cross(at));
            inwards < 0.0 && inwards * inwards * steep > off * edge.length_squared()
        };
        is_beside(u, at) || is_beside(c - b, at - u) || is_beside(-v, at - v)
    }
}
