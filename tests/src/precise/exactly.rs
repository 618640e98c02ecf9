//! The side of a line or plane on which a point lies, and the orientation of a triangle: exactly, for f32 coordinates.

use super::dd::Dd3;
use crate::exact::distance::cross;
use crate::exact::place::minus;
use crate::exact::share::as_dd;
use crate::integers::common_integers;
use glam::DVec3;
use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

/// The side of the plane through three points on which another lies, exactly; greater where the three are
/// counter-clockwise seen from it.
pub fn side_of_plane(points: &[DVec3], [i, j, k]: [usize; 3], l: usize) -> Ordering {
    let [u, v, w] = [j, k, l].map(|p| points[p] - points[i]);
    let det = u.cross(v).dot(w);
    // Each of the 12 roundings loses at most 2^-53 of a product of the three lengths: 1e-14 of it covers them.
    if det.abs() > 1e-14 * u.length() * v.length() * w.length() {
        return det.total_cmp(&0.0);
    }
    let integers = common_integers(&[i, j, k, l].map(|p| points[p].to_array()).concat());
    let arm = |row: usize, axis: usize| &integers[3 * row + axis] - &integers[axis];
    let minor = |a: usize, b: usize| -> BigInt { arm(1, a) * arm(2, b) - arm(1, b) * arm(2, a) };
    sign_order(&(minor(1, 2) * arm(3, 0) + minor(2, 0) * arm(3, 1) + minor(0, 1) * arm(3, 2)))
}

/// The orientation of three points projected along an axis: greater where counter-clockwise about it.
pub fn side_of_line(points: &[DVec3], corners: [usize; 3], axis: usize) -> Ordering {
    let [a, b] = [(axis + 1) % 3, (axis + 2) % 3];
    let [i, j, k] = corners;
    let [u, v] = [j, k].map(|p| points[p] - points[i]);
    let (left, right) = (u[a] * v[b], u[b] * v[a]);
    // Five roundings, each at most 2^-53 of the two products.
    if (left - right).abs() > 1e-15 * (left.abs() + right.abs()) {
        return left.total_cmp(&right);
    }
    let integers = common_integers(&corners.map(|p| [points[p][a], points[p][b]]).concat());
    let arm = |row: usize, axis: usize| &integers[2 * row + axis] - &integers[axis];
    sign_order(&(arm(1, 0) * arm(2, 1) - arm(1, 1) * arm(2, 0)))
}

/// The normal of the triangle of three points, of any length, correct to the last digits of a double-double.
pub fn exact_cross(points: &[DVec3], corners: [usize; 3]) -> Dd3 {
    let integers = common_integers(&corners.map(|p| points[p].to_array()).concat());
    let arm = |row: usize| minus(&integers[3 * row..3 * row + 3], &integers[..3]);
    let normal = cross(&arm(1), &arm(2));
    let bits = normal.iter().map(BigInt::bits).max().unwrap_or(0);
    let [x, y, z] = [0, 1, 2].map(|i: usize| as_dd(&normal[i], bits as i64));
    Dd3 { x, y, z }
}

fn sign_order(value: &BigInt) -> Ordering {
    match value.sign() {
        Sign::Plus => Ordering::Greater,
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
    }
}
