//! Exact questions about points in space: the signs of determinants of their coordinates.
//!
//! Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates" (1997). Exact for all
//! finite f32: products of three of them neither overflow nor underflow in f64.

use glam::Vec3;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Positive where `d` lies outside the plane that a, b, c span counter-clockwise.
pub(super) fn outside(points: &[Vec3], [a, b, c]: [u32; 3], d: u32) -> f64 {
    let coord = |i: u32| {
        let v = points[i as usize].as_dvec3();
        Coord3D { x: v.x, y: v.y, z: v.z }
    };
    // `robust` calls the side from which a, b, c run clockwise the positive one.
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

/// Hull of coplanar points, turning as `triangle` does, by Andrew's monotone chain in a projection.
pub(super) fn planar_hull(points: &[Vec3], in_plane: &[u32], triangle: [u32; 3]) -> Vec<u32> {
    // Any projection that does not flatten the plane keeps the combinatorics.
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
            while hull.len() >= floor + 2 && turn(hull[hull.len() - 2], hull[hull.len() - 1], i) <= 0.0 {
                hull.pop();
            }
            hull.push(i);
        }
        hull.pop();
    }
    hull
}

/// Facets in an order that depends on nothing but themselves: each loop from its lowest corner, the loops sorted.
pub(super) fn canonical(mut facets: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    for facet in &mut facets {
        let lowest = facet.iter().enumerate().min_by_key(|&(_, corner)| corner).map_or(0, |(place, _)| place);
        facet.rotate_left(lowest);
    }
    facets.sort_unstable();
    facets
}
