//! Rounding an f64 interval outwards to f32, so that a box never loses the shape inside it.

use crate::aabb::{Aabb2, Aabb3};
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The largest f32 that is not above `value`.
#[inline]
pub(crate) fn round_down(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) > value { nearest.next_down() } else { nearest }
}

/// The smallest f32 that is not below `value`.
#[inline]
pub(crate) fn round_up(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) < value { nearest.next_up() } else { nearest }
}

/// One side of a box: `low..high` relative to `position`, widened by `margin` and by what f64 may have lost.
///
/// Rounding comes last, after translation and margin: a box rounded first and moved later can lose a contact.
#[inline]
pub(crate) fn interval(position: f64, low: f64, high: f64, margin: f64) -> (f32, f32) {
    // A projection is a sum of three products of entries with a handful of roundings each: 32 units cover them.
    let slack = 32.0 * f64::EPSILON * (position.abs() + low.abs().max(high.abs()) + margin);
    (round_down(position + low - margin - slack), round_up(position + high + margin + slack))
}

/// The box around points in the plane, posed, grown by `grow` metres. There must be a point.
pub(crate) fn around2(points: impl Iterator<Item = DVec2>, pose: &Pose2, grow: f64) -> Aabb2 {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in points {
        let turned = pose.rotation().turn(point);
        (low, high) = (low.min(turned), high.max(turned));
    }
    let p = pose.position();
    let x = interval(p.x, low.x, high.x, grow);
    let y = interval(p.y, low.y, high.y, grow);
    Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
}

/// The box around points in space, posed, grown by `grow` metres. There must be a point.
pub(crate) fn around3(points: impl Iterator<Item = DVec3>, pose: &Pose3, grow: f64) -> Aabb3 {
    let basis = pose.basis();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for point in points {
        let turned = basis.turn(point);
        (low, high) = (low.min(turned), high.max(turned));
    }
    let p = pose.position();
    let x = interval(p.x, low.x, high.x, grow);
    let y = interval(p.y, low.y, high.y, grow);
    let z = interval(p.z, low.z, high.z, grow);
    Aabb3::new(Vec3::new(x.0, y.0, z.0), Vec3::new(x.1, y.1, z.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_never_moves_inwards() {
        for value in [0.1_f64, -0.1, 1e-46, -1e-46, 1e9 + 0.3, -1e9 - 0.3, 0.0, 1.0] {
            assert!(f64::from(round_down(value)) <= value, "{value}");
            assert!(f64::from(round_up(value)) >= value, "{value}");
        }
    }

    #[test]
    fn a_margin_survives_far_from_the_origin() {
        let (low, high) = interval(1e9 + 0.123, -0.5, 0.5, 0.02);
        assert!(f64::from(low) <= 1e9 + 0.123 - 0.52 && f64::from(high) >= 1e9 + 0.123 + 0.52);
    }
}
