//! Points in space whose two anchors are plumb: each is the foot of the other along the rounded normal.
//!
//! So one anchor of a point follows from the other, bit for bit, and a point that is kept from frame to frame needs
//! only one (`persistent3::solids`). The anchor that is moved goes by some 1e-7 of the point's depth.
//!
//! The anchor that lies much further from its body's position is always the one that is moved: on a floor as wide as a
//! town it was rounded to millimetres; if it stayed, it would take the other with it.

use crate::answer::Manifold3;
use asunder_geometry::glam::{DVec3, Vec3};

/// How much further from its body's position than the other an anchor may be and still be the one that stays, squared.
const MUCH: f64 = 16.0;

/// Whether the anchors on A stay, by the squares of how far both reach. Those on the incident body do, opposite the
/// reference face, unless they reach much further.
#[inline(always)]
pub(crate) fn stays_on_a(is_from_b: bool, [of_a, of_b]: [f64; 2]) -> bool {
    if is_from_b { of_a <= of_b * MUCH } else { of_b > of_a * MUCH }
}

impl Manifold3 {
    /// Moves one anchor of each point to the foot of the other. `offset` is from A's position to B's, in metres. Cost:
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

    /// Whether it is plumb already, bit for bit, with the anchors on A held, or those on B.
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

/// A point's anchor on A from that on B: `offset` is from A's position to B's, `out` from the anchor on A to that on B.
#[inline(always)]
pub(crate) fn end_on_a(on_b: DVec3, offset: DVec3, out: DVec3) -> DVec3 {
    on_b + offset - out
}

/// A point's anchor on B from that on A.
#[inline(always)]
pub(crate) fn end_on_b(on_a: DVec3, offset: DVec3, out: DVec3) -> DVec3 {
    on_a - offset + out
}

/// Both anchors from the one that is held.
#[inline(always)]
pub(crate) fn ends(held: DVec3, is_by_a: bool, offset: DVec3, out: DVec3) -> [DVec3; 2] {
    if is_by_a { [held, end_on_b(held, offset, out)] } else { [end_on_a(held, offset, out), held] }
}
