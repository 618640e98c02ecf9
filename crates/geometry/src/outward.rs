//! Rounds f64 intervals outwards to f32, so that a box always contains its shape.

use crate::aabb::{Aabb2, Aabb3};
use crate::octets::VertexOctet;
use crate::pose2::Pose2;
use crate::pose3::Pose3;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The largest f32 that is not above `value`, for lower bounds. NaN stays NaN, and a finite number above all f32
/// becomes the greatest of them.
///
/// ```
/// use asunder_geometry::round_down;
/// assert!(f64::from(round_down(0.1)) < 0.1 && round_down(-1e-46) < 0.0);
/// assert_eq!((round_down(0.5), round_down(1e300)), (0.5, f32::MAX));
/// ```
///
/// Cost: no branch. Whether the nearest f32 is on the wrong side is a coin toss, six times a box, so the step is added
/// as a number. With branches the boxes of cuboids were 14 % of a frame of pyramids, and are 4 % without (samples; AMD
/// EPYC, Zen 4, 2026-11-23).
#[inline]
pub fn round_down(value: f64) -> f32 {
    let nearest = value as f32;
    step(nearest, -i32::from(f64::from(nearest) > value))
}

/// The smallest f32 that is not below `value`.
#[inline]
pub(crate) fn round_up(value: f64) -> f32 {
    let nearest = value as f32;
    step(nearest, i32::from(f64::from(nearest) < value))
}

/// The next f32 up (1) or down (-1), or the same (0). The sign of a zero says from which side it was rounded, so its
/// step goes away from zero. Equals `next_up` and `next_down` for all values that come up here.
#[inline]
fn step(value: f32, by: i32) -> f32 {
    let bits = value.to_bits();
    // Bits count away from zero.
    let away = 1 | (bits.cast_signed() >> 31);
    f32::from_bits(bits.wrapping_add_signed(away * by))
}

/// One axis of a box: `low..high` relative to `position`, widened by `grow` and by `lost`, the rounding error in f64.
///
/// Rounding comes last, after translation and margin: a box rounded first and moved later can lose a contact.
#[inline]
pub(crate) fn interval(position: f64, low: f64, high: f64, grow: f64, lost: f64) -> (f32, f32) {
    (round_down(position + low - grow - lost), round_up(position + high + grow + lost))
}

/// The rounding error in f64 of a body's projection on an axis, from the sums of its absolute coordinates.
///
/// It matches what the narrow phase allows for a pair, where all coordinates of both bodies count, and not only those
/// on the axis: a pair that counts as touching there must not be apart here.
#[inline]
pub(crate) fn lost(position: f64, reach: f64, grow: f64) -> f64 {
    64.0 * f64::EPSILON * (position + reach + grow)
}

/// The box around posed points in the plane, grown by `grow` metres. There must be a point.
pub(crate) fn around2(points: impl Iterator<Item = DVec2>, pose: &Pose2, grow: f64) -> Aabb2 {
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in points {
        let turned = pose.rotation().turn(point);
        (low, high) = (low.min(turned), high.max(turned));
    }
    let p = pose.position();
    let lost = lost(p.abs().element_sum(), low.abs().max(high.abs()).element_sum(), grow);
    let x = interval(p.x, low.x, high.x, grow, lost);
    let y = interval(p.y, low.y, high.y, grow, lost);
    Aabb2::new(Vec2::new(x.0, y.0), Vec2::new(x.1, y.1))
}

/// The box around posed points in space, grown by `grow` metres. There must be a point.
pub(crate) fn around3(points: impl Iterator<Item = DVec3>, pose: &Pose3, grow: f64) -> Aabb3 {
    let basis = pose.basis();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for point in points {
        let turned = basis.turn(point);
        (low, high) = (low.min(turned), high.max(turned));
    }
    around(low, high, pose, grow)
}

/// The same for many vertices whose coordinates do not exceed `extent`, eight at a time in f32. It is wider by the
/// rounding error, less than a millionth of the extent. 32 vertices: 99 ns one by one, 67 here (AMD EPYC, Zen 4,
/// 2026-11-23).
///
/// Tried: four vertices at a time along all three axes, so that each is loaded once: no gain, with 32 vertices or 16
/// (AMD EPYC, Zen 5, 2026-11-24). Most of the time is a chain of dependent operations before and after the vertices.
pub(crate) fn around_octets(octets: &[VertexOctet], extent: f32, pose: &Pose3, grow: f64) -> Aabb3 {
    let basis = pose.basis();
    let mut sides = [[0.0; 2]; 3];
    for (axis, side) in sides.iter_mut().enumerate() {
        let row = Vec3::new(basis.x[axis] as f32, basis.y[axis] as f32, basis.z[axis] as f32);
        let (mut up, mut down) = ([f32::NEG_INFINITY; 8], [f32::NEG_INFINITY; 8]);
        for octet in octets {
            let mut reach = [0.0; 8];
            for (i, reach) in reach.iter_mut().enumerate() {
                *reach = row.x * octet.x[i] + row.y * octet.y[i] + row.z * octet.z[i];
            }
            for i in 0..8 {
                up[i] = if reach[i] > up[i] { reach[i] } else { up[i] };
            }
            for i in 0..8 {
                down[i] = if -reach[i] > down[i] { -reach[i] } else { down[i] };
            }
        }
        // Rounding of the row, each product and two sums: below 4.1 times 2^-24 of the terms' sum.
        let terms = f64::from(extent) * f64::from(row.abs().element_sum());
        let doubt = 2.1 * f64::from(f32::EPSILON) * terms;
        *side = [-f64::from(greatest(down)) - doubt, f64::from(greatest(up)) + doubt];
    }
    let [x, y, z] = sides;
    around(DVec3::new(x[0], y[0], z[0]), DVec3::new(x[1], y[1], z[1]), pose, grow)
}

#[inline(always)]
fn greatest(lanes: [f32; 8]) -> f32 {
    let greater = |a: f32, b: f32| if a > b { a } else { b };
    let four: [f32; 4] = core::array::from_fn(|i| greater(lanes[i], lanes[i + 4]));
    greater(greater(four[0], four[2]), greater(four[1], four[3]))
}

/// The box from `low` to `high` about a position, grown by `grow` metres.
#[inline]
pub(crate) fn around(low: DVec3, high: DVec3, pose: &Pose3, grow: f64) -> Aabb3 {
    let p = pose.position();
    let lost = lost(p.abs().element_sum(), low.abs().max(high.abs()).element_sum(), grow);
    let x = interval(p.x, low.x, high.x, grow, lost);
    let y = interval(p.y, low.y, high.y, grow, lost);
    let z = interval(p.z, low.z, high.z, grow, lost);
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
    fn rounding_is_to_the_next_number_of_that_side() {
        let mut values: Vec<f64> = vec![0.0, f64::INFINITY, f64::MAX, f64::MIN_POSITIVE, 1e-46, 1e39];
        values.extend([f32::MAX, f32::MIN_POSITIVE, 1.0, 0.1, f32::from_bits(1)].map(f64::from));
        values.extend((0..2000).map(|i| f64::from_bits(0x3600_0000_0000_0000 + i * 0x0009_1234_5678_9ABC)));
        let near = values.iter().flat_map(|&value| [value.next_down(), value, value.next_up()]);
        for value in near.flat_map(|value| [value, -value]) {
            let nearest = value as f32;
            let is_above = f64::from(nearest) > value;
            let down = if is_above { nearest.next_down() } else { nearest };
            assert_eq!(round_down(value).to_bits(), down.to_bits(), "{value}");
            let is_below = f64::from(nearest) < value;
            let up = if is_below { nearest.next_up() } else { nearest };
            assert_eq!(round_up(value).to_bits(), up.to_bits(), "{value}");
        }
        assert!(round_down(f64::NAN).is_nan() && round_up(f64::NAN).is_nan());
    }

    #[test]
    fn eight_by_eight_is_no_tighter_than_one_by_one_and_hardly_wider() {
        let mut state = 5_u32;
        let mut number = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 8_388_608.0 - 1.0
        };
        for case in 0..3000 {
            let size = [1e-6, 1.0, 1e5][case % 3];
            let points: Vec<Vec3> =
                (0..4 + case % 29).map(|_| Vec3::new(number(), number(), number()) * size).collect();
            let eight = |places: &[Vec3]| {
                let at = |i: usize| *places.get(i).unwrap_or(&points[0]);
                VertexOctet::of_eight(&core::array::from_fn(at))
            };
            let octets: Vec<VertexOctet> = points.chunks(8).map(eight).collect();
            let rotation = glam::Quat::from_xyzw(number(), number(), number(), number());
            let at = DVec3::new(number().into(), number().into(), number().into()) * 10.0 * f64::from(size);
            let pose = Pose3::new(at, rotation).unwrap();
            let extent = points.iter().map(|point| point.abs().max_element()).fold(0.0, f32::max);
            let tight = around3(points.iter().map(|point| point.as_dvec3()), &pose, 0.0);
            let found = around_octets(&octets, extent, &pose, 0.0);
            assert!(found.min.cmple(tight.min).all() && found.max.cmpge(tight.max).all(), "{case}");
            // Plus the f32 rounding of a position up to eleven extents away.
            let wider = (tight.min - found.min).max(found.max - tight.max).max_element();
            assert!(wider <= 3e-6 * extent, "{case}: {wider} of {extent}");
        }
    }

    #[test]
    fn a_margin_survives_far_from_the_origin() {
        let (low, high) = interval(1e9 + 0.123, -0.5, 0.5, 0.02, lost(1e9, 0.5, 0.02));
        assert!(f64::from(low) <= 1e9 + 0.123 - 0.52 && f64::from(high) >= 1e9 + 0.123 + 0.52);
    }
}
