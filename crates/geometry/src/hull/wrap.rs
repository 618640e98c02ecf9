//! Exact facets of a convex hull by gift wrapping.
//!
//! ```text
//! 1 find a hull edge: a line that a vertical plane through the least point supports
//! 2 turn a plane about an unwrapped directed edge until no point lies outside it: that plane bears a facet
//! 3 take *all* points in that plane and form their planar hull: the facet, however many corners it has
//! 4 its edges, run the other way, are to be wrapped unless their facet is known; repeat 2 until none is left
//! ```
//! Chand and Kapur, "An algorithm for convex polytopes" (1970). Every decision is the sign of an exact determinant
//! (Shewchuk 1997), so coplanar and collinear points need no tolerance and no case of their own. Cost: points times
//! facets. It is slow beside a real builder, and obviously right: it stays as that builder's oracle.

use super::HullError;
use crate::tolerance::MAX_HULL_VERTICES;
use glam::Vec3;
use robust::{Coord, Coord3D, orient2d, orient3d};
use std::collections::BTreeSet;

/// Facets as vertex loops, counter-clockwise from outside, with no three corners on a line.
///
/// The points must be finite and no two the same.
pub(super) fn enumerate_facets(points: &[Vec3]) -> Result<Vec<Vec<u32>>, HullError> {
    let dimension = affine_dimension(points);
    if dimension < 3 {
        return Err(HullError::Flat { dimension });
    }
    let mut facets = Vec::new();
    let mut vertices = BTreeSet::new();
    let mut known: BTreeSet<(u32, u32)> = BTreeSet::new();
    let mut open = vec![first_edge(points)];
    while let Some((p, q)) = open.pop() {
        if known.contains(&(p, q)) {
            continue;
        }
        let facet = facet_beside(points, p, q);
        for (i, &from) in facet.iter().enumerate() {
            let to = facet[(i + 1) % facet.len()];
            known.insert((from, to));
            if !known.contains(&(to, from)) {
                open.push((to, from));
            }
            vertices.insert(from);
        }
        facets.push(facet);
        if vertices.len() > 2 * MAX_HULL_VERTICES {
            // Far too many already, whatever merging may take away: do not wrap a hundred thousand facets.
            return Err(HullError::TooManyVertices { at_least: vertices.len() });
        }
    }
    Ok(facets)
}

/// Positive where `d` lies outside the plane that a, b, c span counter-clockwise.
fn outside(points: &[Vec3], [a, b, c]: [u32; 3], d: u32) -> f64 {
    let coord = |i: u32| {
        let v = points[i as usize].as_dvec3();
        Coord3D { x: v.x, y: v.y, z: v.z }
    };
    // `robust` calls the side from which a, b, c run clockwise the positive one.
    -orient3d(coord(a), coord(b), coord(c), coord(d))
}

/// Orientation of the triangle as seen along one axis: 0 in the (y, z) plane, 1 in (z, x), 2 in (x, y).
fn turn_seen_along(points: &[Vec3], axis: usize, [a, b, c]: [u32; 3]) -> f64 {
    let coord = |i: u32| {
        let v = points[i as usize];
        Coord { x: f64::from(v[(axis + 1) % 3]), y: f64::from(v[(axis + 2) % 3]) }
    };
    orient2d(coord(a), coord(b), coord(c))
}

fn is_collinear(points: &[Vec3], triangle: [u32; 3]) -> bool {
    (0..3).all(|axis| turn_seen_along(points, axis, triangle) == 0.0)
}

fn affine_dimension(points: &[Vec3]) -> u8 {
    let all = 0..points.len() as u32;
    if points.len() < 2 {
        return 0;
    }
    let Some(third) = all.clone().skip(2).find(|&i| !is_collinear(points, [0, 1, i])) else { return 1 };
    if all.clone().any(|i| outside(points, [0, 1, third], i) != 0.0) { 3 } else { 2 }
}

fn order(points: &[Vec3], a: u32, b: u32) -> core::cmp::Ordering {
    let key = |i: u32| points[i as usize].to_array().map(|c| c + 0.0);
    let (a, b) = (key(a), key(b));
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
}

/// A directed edge of the hull, to be wrapped first.
fn first_edge(points: &[Vec3]) -> (u32, u32) {
    let all = 0..points.len() as u32;
    let least = all.clone().min_by(|&a, &b| order(points, a, b)).unwrap_or(0);
    // Seen from above, the least point is a corner of the outline. Find the vertical plane through it that has
    // every point to its left or in it.
    let seen_apart = |i: u32| points[i as usize].truncate() != points[least as usize].truncate();
    let mut ahead = None;
    for i in all.clone().filter(|&i| seen_apart(i)) {
        match ahead {
            Some(q) if turn_seen_along(points, 2, [least, q, i]) >= 0.0 => {}
            _ => ahead = Some(i),
        }
    }
    let ahead = ahead.unwrap_or(least);
    let in_plane: Vec<u32> =
        all.filter(|&i| i == least || turn_seen_along(points, 2, [least, ahead, i]) == 0.0).collect();
    let Some(&third) = in_plane.iter().find(|&&i| i != least && !is_collinear(points, [least, ahead, i]))
    else {
        // All of them on one line: it is an edge, from end to end.
        let end = in_plane.iter().copied().max_by(|&a, &b| order(points, a, b)).unwrap_or(ahead);
        return (least, end);
    };
    // A whole facet stands upright: any edge of its outline will do.
    let outline = planar_hull(points, &in_plane, [least, ahead, third]);
    (outline[0], outline[1])
}

/// The facet to the left of the directed hull edge `p -> q`.
fn facet_beside(points: &[Vec3], p: u32, q: u32) -> Vec<u32> {
    let mut third = None;
    for i in (0..points.len() as u32).filter(|&i| i != p && i != q) {
        match third {
            Some(r) if outside(points, [p, q, r], i) <= 0.0 => {}
            _ if is_collinear(points, [p, q, i]) => {}
            _ => third = Some(i),
        }
    }
    // The points span space, so some point is off the line.
    let triangle = [p, q, third.unwrap_or(p)];
    let in_plane: Vec<u32> =
        (0..points.len() as u32).filter(|&i| outside(points, triangle, i) == 0.0).collect();
    planar_hull(points, &in_plane, triangle)
}

/// Hull of coplanar points, turning as `triangle` does, by Andrew's monotone chain in a projection.
fn planar_hull(points: &[Vec3], in_plane: &[u32], triangle: [u32; 3]) -> Vec<u32> {
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
