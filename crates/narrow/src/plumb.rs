//! Points in space whose ends are plumb: one is the foot of the other, along the normal as it was rounded.
//!
//! So they have in common what makes one of them the other, bit by bit, and of a point that is kept from frame to frame
//! one end is enough (`persistent3::solids`). The end that is moved goes by some 1e-7 of how deep the point is.
//!
//! The end that lies much further from its body's position is always the one that is moved: on a floor as wide as a
//! town it was rounded to millimetres, and kept, it took the other with it.

use crate::answer::Manifold3;
use asunder_geometry::glam::{DVec3, Vec3};

/// How much further an end may be from its body's position than the other, squared, and be the one that stays.
const MUCH: f64 = 16.0;

/// Whether the ends on A stay: those on the body whose face points are not measured from, unless they reach out further
/// by much. By the squares of how far both reach.
#[inline(always)]
pub(crate) fn stays_on_a(is_from_b: bool, [of_a, of_b]: [f64; 2]) -> bool {
    if is_from_b { of_a <= of_b * MUCH } else { of_b > of_a * MUCH }
}

impl Manifold3 {
    /// Moves one end of each point to the foot of the other. From A's position to B's it is so far, in metres. Cost:
    /// linear in the points.
    #[inline(always)]
    pub(crate) fn plumb(&mut self, is_from_b: bool, offset: DVec3) {
        let Some(first) = self.points.first() else { return };
        let reach = |anchor: Vec3| anchor.as_dvec3().length_squared();
        let is_by_a = stays_on_a(is_from_b, [reach(first.anchor_a), reach(first.anchor_b)]);
        let normal = self.normal.as_dvec3();
        for point in &mut self.points {
            let out = normal * f64::from(point.separation);
            if is_by_a {
                point.anchor_b = end_on_b(point.anchor_a.as_dvec3(), offset, out).as_vec3();
            } else {
                point.anchor_a = end_on_a(point.anchor_b.as_dvec3(), offset, out).as_vec3();
            }
        }
    }

    /// Whether it is plumb already by the ends on A, or on B, in every bit.
    #[inline(always)]
    pub(crate) fn is_plumb(&self, is_by_a: bool, offset: DVec3) -> bool {
        let normal = self.normal.as_dvec3();
        self.points.iter().all(|point| {
            let out = normal * f64::from(point.separation);
            if is_by_a {
                point.anchor_b == end_on_b(point.anchor_a.as_dvec3(), offset, out).as_vec3()
            } else {
                point.anchor_a == end_on_a(point.anchor_b.as_dvec3(), offset, out).as_vec3()
            }
        })
    }
}

/// A point's end on A by that on B: from A's position to B's it is so far, and from the end on A to that on B.
#[inline(always)]
pub(crate) fn end_on_a(on_b: DVec3, offset: DVec3, out: DVec3) -> DVec3 {
    on_b + offset - out
}

/// A point's end on B by that on A.
#[inline(always)]
pub(crate) fn end_on_b(on_a: DVec3, offset: DVec3, out: DVec3) -> DVec3 {
    on_a - offset + out
}

/// Both ends by one of them.
#[inline(always)]
pub(crate) fn ends(held: DVec3, is_by_a: bool, offset: DVec3, out: DVec3) -> [DVec3; 2] {
    if is_by_a { [held, end_on_b(held, offset, out)] } else { [end_on_a(held, offset, out), held] }
}
