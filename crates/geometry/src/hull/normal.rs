//! Areas and normals of face loops.

use super::loops::Loops;
use crate::product::{halves, product_difference};
use glam::{DVec3, Vec3};

/// Newell's area vector of a loop: twice the area, along the normal.
///
/// It is computed about an end of the shortest edge. About a point far away, two corners closer than f64 resolves at
/// that distance would coincide, and the direction of a long triangle on a short base would be lost.
pub(crate) fn area_vector(count: usize, corner: impl Fn(usize) -> Vec3) -> DVec3 {
    if count == 3 { triangle([corner(0), corner(1), corner(2)]) } else { newell(count, corner).0 }
}

/// The area vector, and the sum of the products of lengths that were rounded: the rounding error of the area is a few
/// f64::EPSILON of that sum.
fn newell(count: usize, corner: impl Fn(usize) -> Vec3) -> (DVec3, f64) {
    if count == 3 {
        let corners = [corner(0), corner(1), corner(2)];
        let [(u, _), (v, _)] = [difference(corners[1], corners[0]), difference(corners[2], corners[0])];
        return (triangle(corners), u.length() * v.length() * 1e-14);
    }
    let at = |i: usize| corner(i % count).as_dvec3();
    let edge = |i: &usize| (at(*i + 1) - at(*i)).length_squared();
    let start = (0..count).min_by(|a, b| edge(a).total_cmp(&edge(b))).unwrap_or(0);
    let (mut sum, mut lengths, mut last) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for i in 1..count {
        let arm = at(start + i) - at(start);
        sum += last.cross(arm);
        lengths += last.length() * arm.length();
        last = arm;
    }
    (sum, lengths)
}

/// The area vector of a triangle, right in all but its last bits however long and thin it is: a sliver's normal may be
/// the only one in its direction.
fn triangle([a, b, c]: [Vec3; 3]) -> DVec3 {
    let (u, u_lost) = difference(b, a);
    let (v, v_lost) = difference(c, a);
    let low = |value: DVec3| DVec3::new(halves(value.x).1, halves(value.y).1, halves(value.z).1);
    if u_lost.abs() + v_lost.abs() + low(u).abs() + low(v).abs() == DVec3::ZERO {
        // All products are exact, as they are where corners are no more than a few times as far from the origin as from
        // each other. The result has the same bits as below, and a ray against a mesh takes 150 instructions less.
        return u.cross(v) + DVec3::ZERO;
    }
    exactly([u, u_lost], [v, v_lost])
}

/// The same where a difference or a product may have been rounded.
#[inline(never)]
fn exactly([u, u_lost]: [DVec3; 2], [v, v_lost]: [DVec3; 2]) -> DVec3 {
    let (ux, uy, uz) = (u.x, u.y, u.z);
    let (vx, vy, vz) = (v.x, v.y, v.z);
    let area = DVec3::new(
        product_difference(uy, vz, uz, vy),
        product_difference(uz, vx, ux, vz),
        product_difference(ux, vy, uy, vx),
    );
    // The rounding of the differences matters only where coordinates differ by a factor of a billion.
    area + (u_lost.cross(v) + u.cross(v_lost))
}

/// A difference and its exact rounding error (Knuth, "The art of computer programming", vol. 2, 4.2.2).
fn difference(to: Vec3, from: Vec3) -> (DVec3, DVec3) {
    let (to, from) = (to.as_dvec3(), -from.as_dvec3());
    let sum = to + from;
    let part = sum - to;
    (sum, (to - (sum - part)) + (from - part))
}

/// Unit vector along a loop's area; x if the area vanishes even in f64.
pub(crate) fn unit(area: DVec3) -> DVec3 {
    // Scaled first, as the squares of an area of 1e-90 would underflow.
    let largest = area.abs().max_element();
    if largest > 0.0 { (area / largest).normalize() } else { DVec3::X }
}

/// Whether a loop's area, computed in f64 from any of its corners, may be mere rounding.
///
/// That is so only if some corners differ by less than f64 resolves relative to their distance from others.
pub(super) fn is_noise(count: usize, corner: impl Fn(usize) -> Vec3) -> bool {
    (0..count).any(|start| {
        let (area, lengths) = newell(count, |i| corner((start + i) % count));
        is_lost(area, lengths)
    })
}

fn is_lost(area: DVec3, lengths: f64) -> bool {
    area.length() <= 1e-13 * lengths
}

/// Squared lengths and indices of a loop's edges, the longest first.
fn longest_edges(count: usize, corner: impl Fn(usize) -> Vec3) -> Vec<(f64, usize)> {
    let squared = |i: usize| (corner((i + 1) % count).as_dvec3() - corner(i).as_dvec3()).length_squared();
    let mut edges: Vec<(f64, usize)> = (0..count).map(|i| (squared(i), i)).collect();
    edges.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    edges
}

/// Areas and unit normals of the faces of a hull, given their neighbours.
///
/// A face whose area is noise lies on its longest edge up to rounding, and so in the plane of the face beyond that
/// edge: it takes that face's normal.
pub(super) fn areas_and_normals(
    points: &[Vec3],
    faces: &Loops,
    neighbours: &[u32],
) -> (Vec<DVec3>, Vec<DVec3>) {
    let (mut areas, mut unknown) = (Vec::with_capacity(faces.len()), Vec::new());
    for (face, around) in faces.iter().enumerate() {
        let (area, lengths) = newell(around.len(), |i| points[around[i] as usize]);
        if is_lost(area, lengths) {
            unknown.push(face);
        }
        areas.push(area);
    }
    let mut normals: Vec<DVec3> = areas.iter().copied().map(unit).collect();
    if unknown.is_empty() {
        return (areas, normals);
    }
    let mut is_known = vec![true; faces.len()];
    unknown.iter().for_each(|&face| is_known[face] = false);
    while !unknown.is_empty() {
        let before = unknown.len();
        unknown.retain(|&face| {
            let (around, across) = (faces.get(face), &neighbours[faces.places(face)]);
            let edges = longest_edges(around.len(), |i| points[around[i] as usize]);
            // A face beyond a short edge may face anywhere.
            let long = edges.first().map_or(0.0, |edge| edge.0 * 0.25);
            let beyond = edges
                .into_iter()
                .take_while(|edge| edge.0 >= long)
                .map(|(_, i)| across[i] as usize)
                .find(|&neighbour| is_known[neighbour]);
            if let Some(neighbour) = beyond {
                (normals[face], is_known[face]) = (normals[neighbour], true);
            }
            beyond.is_none()
        });
        if unknown.len() == before {
            break;
        }
    }
    (areas, normals)
}

/// For each corner of each face, the face across the edge that starts there.
pub(super) fn neighbours(faces: &Loops) -> Vec<u32> {
    // Edge and start packed into one number, which is compared at once; there are fewer than 2^16 points.
    let (mut sides, mut face_of) = (Vec::with_capacity(faces.corners().len()), Vec::new());
    for (face, around) in (0..).zip(faces.iter()) {
        let next = around.iter().skip(1).chain(around.first());
        for (&from, &to) in around.iter().zip(next) {
            let (low, high) = (u64::from(from.min(to)), u64::from(from.max(to)));
            sides.push(low << 48 | high << 32 | face_of.len() as u64);
            face_of.push(face);
        }
    }
    sides.sort_unstable();
    let mut neighbours = face_of.clone();
    for two in sides.windows(2) {
        if two[0] >> 32 == two[1] >> 32 {
            let [first, second] = [two[0], two[1]].map(|side| side as u32 as usize);
            (neighbours[first], neighbours[second]) = (face_of[second], face_of[first]);
        }
    }
    neighbours
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliver_has_the_normal_that_integers_give() {
        // In steps of 2^-45, with one corner next to the origin, so that differences have more digits than f32.
        let (long, near) = (1_i128 << 45, [12_345_677_i128, -2_345_679, 3_456_789]);
        for (b, c) in [
            ([long, long / 2, -long], [long + (1 << 22), long / 2 + (1 << 23), -long + (1 << 24)]),
            ([long, 0, 0], [long - (1 << 21), 1, 0]),
            ([-long, -248_527, 4_505_365], [-long / 2, -1_297_102, 3_981_077]),
        ] {
            let (u, v) = ([0, 1, 2].map(|i| b[i] - near[i]), [0, 1, 2].map(|i| c[i] - near[i]));
            let cross = [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
            let truth = DVec3::from_array(cross.map(|value| value as f64)).normalize();
            let point =
                |corner: [i128; 3]| Vec3::from_array(corner.map(|value| (value as f64 / long as f64) as f32));
            let points = [near, b, c].map(point);
            let found = unit(area_vector(3, |i| points[i % 3]));
            assert!((found - truth).length() < 1e-15, "{found} is not {truth}");
        }
    }

    #[test]
    fn what_rounds_nothing_has_the_bits_of_what_rounds() {
        let (mut bits, mut short, mut long) = (0x9E37_79B9_7F4A_7C15_u64, 0, 0);
        let mut next = |below: u64| {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (bits >> 33) % below
        };
        for round in 0..20_000_u64 {
            // Corners whose differences have more and more digits, up to where they are rounded.
            let mut part = || {
                let (value, place) = (next(1 << 24) as f32 - 8_388_608.0, next(1 + round % 40) as f32);
                value * place.exp2() * 1e-9
            };
            let mut corner = || Vec3::new(part(), part(), if round % 3 == 0 { 0.0 } else { part() });
            let [a, b, c] = [corner(), corner(), corner()];
            let (u, v) = (difference(b, a), difference(c, a));
            let (found, full) = (triangle([a, b, c]), exactly([u.0, u.1], [v.0, v.1]));
            assert_eq!(found.to_array().map(f64::to_bits), full.to_array().map(f64::to_bits), "{a} {b} {c}");
            let is_long =
                [u.0, v.0].iter().any(|arm| arm.to_array().iter().any(|&part| halves(part).1 != 0.0));
            (short, long) = (short + usize::from(!is_long), long + usize::from(is_long));
        }
        assert!(short > 400 && long > 10_000, "{short} {long}");
    }
}
