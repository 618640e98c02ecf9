//! Rays against ground made of triangles.
//!
//! ```text
//! for each triangle whose box the ray meets, nearest first, until boxes are beyond the nearest hit
//!   clearly beside it, behind the origin or beyond the nearest hit:   no          (passes)
//!   else:                                                             what the triangle alone answers
//! ```
//! Watertight: a triangle is hit by what passes within rounding of it, and is not passed over here unless the ray is
//! twice as far beside it; so a ray through an edge that two triangles share, or a vertex, hits at least one of them.
//!
//! What makes it fast: the ray is turned into the ground's axes, once, and not the triangles out of them; a triangle
//! that is missed costs no root and one quotient.

use super::planes::EDGE_ON;
use super::{Cast, length};
use crate::impact3::RayHit3;
use crate::pair3::Part;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Ground, Shape3};

/// A ray in the ground's axes.
struct Local {
    origin: DVec3,
    way: DVec3,
    squared: f64,
    /// How far a point on it may be beside its place, in metres: at the origin, and more for each length of the way.
    doubt: [f64; 2],
    is_one_sided: bool,
}

impl Cast<'_> {
    /// Where the ray first meets ground with these axes.
    pub(super) fn over(&self, ground: Ground, basis: &Basis3, limit: f64) -> Option<RayHit3> {
        let size = f64::from(self.shape.outer_radius()) + length(self.shape.center().as_dvec3());
        let pace = length(self.way);
        // Twice what any triangle takes for itself.
        let doubt = [128.0 * f64::EPSILON * (length(self.from) + size), 128.0 * f64::EPSILON * pace];
        let local = Local {
            origin: basis.turn_back(self.from),
            way: basis.turn_back(self.way),
            squared: self.squared,
            doubt,
            is_one_sided: ground.is_one_sided(),
        };
        // Boxes are met early and late enough for what their triangles give away.
        let grown = Vec3::splat((4.0 * doubt[0]) as f32);
        let mut first: Option<RayHit3> = None;
        let mut within = limit;
        ground.visit_along(local.origin, local.way, grown, limit, |number| {
            if !local.passes(ground.corners(number), within)
                && let Some(triangle) = ground.triangle(number).map(Shape3::Triangle)
            {
                let meeting = self.meeting(&triangle, basis, DVec3::ZERO, limit);
                let hit = Cast { shape: &triangle, ..*self }
                    .answer(meeting, within, || Part::whole(&triangle, basis));
                if let Some(hit) = hit.map(|hit| RayHit3 { part: number, ..hit })
                    && first.is_none_or(|known| (hit.distance, number) < (known.distance, known.part))
                {
                    within = hit.distance;
                    first = Some(hit);
                }
            }
            within
        });
        first
    }
}

impl Local {
    /// Whether the ray certainly passes by a triangle, or through it from behind where that is no hindrance.
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
        // So far beside an edge, over how steep the ray is: both sides are squares, times the area's and the pace's.
        let off = off * area * self.squared;
        let is_beside = |edge: DVec3, at: DVec3| {
            let inwards = normal.dot(edge.cross(at));
            inwards < 0.0 && inwards * inwards * steep > off * edge.length_squared()
        };
        is_beside(u, at) || is_beside(c - b, at - u) || is_beside(-v, at - v)
    }
}
