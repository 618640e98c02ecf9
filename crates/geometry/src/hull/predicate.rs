//! Exact predicates for points in space: the signs of determinants of their coordinates.
//!
//! Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates" (1997). Exact for all
//! finite f32: products of three of them neither overflow nor underflow in f64.

use crate::counted::count_step;
use glam::{DVec3, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Positive where `d` lies outside the plane that a, b, c span counter-clockwise.
pub(super) fn outside(points: &[Vec3], [a, b, c]: [u32; 3], d: u32) -> f64 {
    let coord = |i: u32| {
        let v = points[i as usize].as_dvec3();
        Coord3D { x: v.x, y: v.y, z: v.z }
    };
    // In `robust` the positive side is the one from which a, b, c run clockwise.
    -orient3d(coord(a), coord(b), coord(c), coord(d))
}

/// Orientation of the triangle as seen along one axis: 0 in the (y, z) plane, 1 in (z, x), 2 in (x, y).
pub(super) fn turn_seen_along(points: &[Vec3], axis: usize, [a, b, c]: [u32; 3]) -> f64 {
    let coord = |i: u32| {
        let v = points[i as usize];
        Coord { x: f64::from(v[(axis + 1) % 3]), y: f64::from(v[(axis + 2) % 3]) }
    };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether three points lie on one line.
pub(super) fn is_collinear(points: &[Vec3], triangle: [u32; 3]) -> bool {
    (0..3).all(|axis| turn_seen_along(points, axis, triangle) == 0.0)
}

/// Four points that span space, or the dimension of what all of them span.
pub(super) fn affine_basis(points: &[Vec3]) -> Result<[u32; 4], u8> {
    let mut all = 0..points.len() as u32;
    if points.len() < 2 {
        return Err(0);
    }
    let third = all.clone().skip(2).find(|&i| !is_collinear(points, [0, 1, i])).ok_or(1)?;
    let fourth = all.find(|&i| outside(points, [0, 1, third], i) != 0.0).ok_or(2)?;
    Ok([0, 1, third, fourth])
}

/// Hull of coplanar points, with the orientation of `triangle`, by Andrew's monotone chain in a projection.
pub(super) fn planar_hull(points: &[Vec3], in_plane: &[u32], triangle: [u32; 3]) -> Vec<u32> {
    // Any axis projection that does not flatten the plane will do.
    let (axis, sense) = (0..3)
        .map(|axis| (axis, turn_seen_along(points, axis, triangle)))
        .find(|&(_, turn)| turn != 0.0)
        .unwrap_or((2, 1.0));
    let turn = |a, b, c| turn_seen_along(points, axis, [a, b, c]) * sense.signum();
    let key = |i: u32| {
        let v = points[i as usize];
        (v[(axis + 1) % 3] + 0.0, v[(axis + 2) % 3] + 0.0)
    };
    let mut sorted = in_plane.to_vec();
    sorted.sort_by(|&a, &b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let mut hull: Vec<u32> = Vec::with_capacity(sorted.len() + 1);
    let forwards: Vec<u32> = sorted.clone();
    sorted.reverse();
    for chain in [forwards, sorted] {
        let floor = hull.len();
        for i in chain {
            count_step();
            while hull.len() >= floor + 2 && turn(hull[hull.len() - 2], hull[hull.len() - 1], i) <= 0.0 {
                hull.pop();
            }
            hull.push(i);
        }
        hull.pop();
    }
    hull
}

/// The rounding error of a point's height above a triangle.
///
/// With u, v the triangle's sides and w the arm to the point, (u x v) . w in f64 is within 8 units of f64::EPSILON *
/// |u| |v| |w| of the true value: each difference, product and sum adds half a unit of at most twice that product. The
/// bound here is twice as large. On a lattice of up to 65,536 steps every intermediate is a whole number of steps below
/// 2^53, and the height is exact.
#[derive(Clone, Copy)]
pub(super) struct Filter {
    per_area: f64,
}

impl Filter {
    pub(super) fn of(points: &[Vec3]) -> Self {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let mut step = i32::MAX;
        for point in points {
            (low, high) = (low.min(point.as_dvec3()), high.max(point.as_dvec3()));
            step = point.to_array().into_iter().map(lowest_bit).fold(step, i32::min);
        }
        let extent = (high - low).max_element();
        let steps = 65_536.0 * f64::from_bits(((step.clamp(-149, 127) + 1023) as u64) << 52);
        Self { per_area: if extent <= steps { 0.0 } else { 16.0 * f64::EPSILON * (high - low).length() } }
    }

    /// Whether rounded heights are exact.
    #[inline]
    pub(super) fn is_exact(self) -> bool {
        self.per_area == 0.0
    }

    /// A bound on the rounding error of any height above a triangle with these two sides, times its normal's length.
    #[inline]
    pub(super) fn slack(self, u: DVec3, v: DVec3) -> f64 {
        self.per_area * u.length() * v.length()
    }
}

/// The exponent of the lowest set bit of a finite number; for zero, more than any.
fn lowest_bit(value: f32) -> i32 {
    let (exponent, fraction) = ((value.to_bits() >> 23 & 0xFF) as i32, value.to_bits() & 0x7F_FFFF);
    match (exponent, fraction) {
        (0, 0) => i32::MAX,
        (0, _) => -149 + fraction.trailing_zeros() as i32,
        _ => exponent - 150 + (fraction | 0x80_0000).trailing_zeros() as i32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_bit_of_a_number_is_its_largest_power_of_two() {
        let cases = [(1.0, 0), (-3.0, 0), (0.75, -2), (96.0, 5), (1e-45, -149), (f32::MIN_POSITIVE, -126)];
        for (value, power) in cases {
            assert_eq!(lowest_bit(value), power, "{value}");
        }
    }

    #[test]
    fn short_lattices_are_exact_and_others_are_not() {
        let exact = |scale: f32| Filter::of(&[Vec3::ZERO, Vec3::splat(scale), Vec3::X]).is_exact();
        assert!(exact(65_536.0) && exact(0.5) && !exact(65_537.0) && !exact(0.1));
    }
}
