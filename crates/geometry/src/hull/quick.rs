//! Exact facets of a convex hull, point by point, the furthest first.
//!
//! ```text
//! 1 a tetrahedron of points that span space; every other point waits at one facet that it lies strictly outside of
//! 2 take a facet with waiting points, and of those the one furthest from its plane
//! 3 the facets that it lies strictly outside of are connected: find them from this one, neighbour by neighbour
//! 4 their border is the horizon: join each edge of it to the point, and drop what was seen
//! 5 the points that waited at what was dropped wait at a new facet they are outside of, or are inside for good
//! 6 repeat 2 until nobody waits; then join triangles of one plane into facets
//! ```
//! Barber, Dobkin and Huhdanpaa, "The quickhull algorithm for convex hulls" (1996), over exact determinants (Shewchuk
//! 1997). A point in a facet's plane counts as not outside of it, so that the new triangles at the horizon are never
//! flat: a point on the line of a horizon edge would lie in the plane of the facet that it is strictly outside of. "Furthest"
//! is the only rounded number, and decides nothing but the order. Cost: about n log n.

use super::HullError;
use super::predicate::{affine_basis, canonical, outside, planar_hull};
use glam::Vec3;
use std::collections::BTreeMap;

/// A triangle of the growing hull.
struct Triangle {
    /// Counter-clockwise from outside.
    corners: [u32; 3],
    /// The triangle across the edge from corner `i` to the next.
    neighbours: [usize; 3],
    /// Points strictly outside of it.
    waiting: Vec<u32>,
    /// The last apex that was found strictly outside of it. Such a triangle is dropped, but stays in the list, so that
    /// indices stay.
    seen_from: Option<u32>,
}

/// Facets as vertex loops, counter-clockwise from outside, with no three corners on a line, in canonical order.
///
/// The points must be finite and no two the same.
pub(super) fn hull_facets(points: &[Vec3]) -> Result<Vec<Vec<u32>>, HullError> {
    let basis = affine_basis(points).map_err(|dimension| HullError::Flat { dimension })?;
    let mut triangles = tetrahedron(points, basis);
    let mut open: Vec<usize> = (0..4).collect();
    let waiting = (0..points.len() as u32).filter(|i| !basis.contains(i)).collect();
    distribute(points, &mut triangles, waiting, 0..4);
    while let Some(first) = open.pop() {
        if triangles[first].seen_from.is_some() || triangles[first].waiting.is_empty() {
            continue;
        }
        let apex = furthest(points, &triangles[first]);
        let seen = seen_from(points, &mut triangles, first, apex);
        let horizon = horizon(&triangles, &seen);
        let mut orphans: Vec<u32> = Vec::new();
        for &index in &seen {
            orphans.append(&mut triangles[index].waiting);
        }
        orphans.retain(|&i| i != apex);
        let new = join(&mut triangles, &horizon, apex);
        distribute(points, &mut triangles, orphans, new.clone());
        open.extend(new);
    }
    let alive = triangles
        .into_iter()
        .filter(|triangle| triangle.seen_from.is_none())
        .map(|triangle| triangle.corners);
    Ok(facets_of(points, &alive.collect::<Vec<_>>()))
}

fn tetrahedron(points: &[Vec3], [a, b, c, d]: [u32; 4]) -> Vec<Triangle> {
    // The base is turned so that the fourth point lies inside of its plane.
    let (b, c) = if outside(points, [a, b, c], d) < 0.0 { (b, c) } else { (c, b) };
    let new = |corners, neighbours| Triangle { corners, neighbours, waiting: Vec::new(), seen_from: None };
    vec![
        new([a, b, c], [1, 2, 3]),
        new([b, a, d], [0, 3, 2]),
        new([c, b, d], [0, 1, 3]),
        new([a, c, d], [0, 2, 1]),
    ]
}

/// Makes each point wait at the first of the triangles that it is strictly outside of; the rest are inside for good.
fn distribute(
    points: &[Vec3],
    triangles: &mut [Triangle],
    waiting: Vec<u32>,
    among: core::ops::Range<usize>,
) {
    for point in waiting {
        let found = triangles[among.clone()].iter_mut().find(|t| outside(points, t.corners, point) > 0.0);
        if let Some(triangle) = found {
            triangle.waiting.push(point);
        }
    }
}

/// The waiting point furthest from a triangle's plane; ties go to the first. Any of them would be right.
fn furthest(points: &[Vec3], triangle: &Triangle) -> u32 {
    let [a, b, c] = triangle.corners.map(|i| points[i as usize].as_dvec3());
    let normal = (b - a).cross(c - a);
    let mut best = (f64::NEG_INFINITY, triangle.waiting[0]);
    for &i in &triangle.waiting {
        let reach = normal.dot(points[i as usize].as_dvec3() - a);
        if reach > best.0 {
            best = (reach, i);
        }
    }
    best.1
}

/// The triangles that `apex` lies strictly outside of, found from one of them.
fn seen_from(points: &[Vec3], triangles: &mut [Triangle], first: usize, apex: u32) -> Vec<usize> {
    triangles[first].seen_from = Some(apex);
    let mut seen = vec![first];
    let mut next = 0;
    while next < seen.len() {
        for neighbour in triangles[seen[next]].neighbours {
            let triangle = &mut triangles[neighbour];
            if triangle.seen_from.is_none() && outside(points, triangle.corners, apex) > 0.0 {
                triangle.seen_from = Some(apex);
                seen.push(neighbour);
            }
        }
        next += 1;
    }
    seen
}

/// The edges between what is seen and what is not, in order around: start, end, and the triangle beyond.
fn horizon(triangles: &[Triangle], seen: &[usize]) -> Vec<(u32, u32, usize)> {
    let mut leads_to: BTreeMap<u32, (u32, usize)> = BTreeMap::new();
    for &index in seen {
        let Triangle { corners, neighbours, .. } = &triangles[index];
        for i in 0..3 {
            if triangles[neighbours[i]].seen_from.is_none() {
                leads_to.insert(corners[i], (corners[(i + 1) % 3], neighbours[i]));
            }
        }
    }
    let mut around = Vec::with_capacity(leads_to.len());
    let Some((&start, _)) = leads_to.first_key_value() else { return around };
    let mut at = start;
    while let Some((to, beyond)) = leads_to.remove(&at) {
        around.push((at, to, beyond));
        at = to;
    }
    around
}

/// Joins each edge of the horizon to the apex, and ties the new triangles to each other and to what lies beyond.
fn join(triangles: &mut Vec<Triangle>, horizon: &[(u32, u32, usize)], apex: u32) -> core::ops::Range<usize> {
    let (first, count) = (triangles.len(), horizon.len());
    for (i, &(from, to, beyond)) in horizon.iter().enumerate() {
        let (before, after) = ((i + count - 1) % count, (i + 1) % count);
        triangles.push(Triangle {
            corners: [from, to, apex],
            neighbours: [beyond, first + after, first + before],
            waiting: Vec::new(),
            seen_from: None,
        });
        let side = triangles[beyond].corners.iter().position(|&corner| corner == to);
        if let Some(side) = side {
            triangles[beyond].neighbours[side] = first + i;
        }
    }
    first..first + count
}

/// Joins triangles of one plane, exactly, and puts the facets in canonical order.
fn facets_of(points: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut left_of: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for (index, corners) in triangles.iter().enumerate() {
        for i in 0..3 {
            left_of.insert((corners[i], corners[(i + 1) % 3]), index);
        }
    }
    let mut is_taken = vec![false; triangles.len()];
    let mut facets = Vec::new();
    for seed in 0..triangles.len() {
        if core::mem::replace(&mut is_taken[seed], true) {
            continue;
        }
        let mut region = vec![seed];
        let mut next = 0;
        while next < region.len() {
            let corners = triangles[region[next]];
            for i in 0..3 {
                let Some(&across) = left_of.get(&(corners[(i + 1) % 3], corners[i])) else { continue };
                let in_plane = |corner: &u32| outside(points, triangles[seed], *corner) == 0.0;
                if !is_taken[across] && triangles[across].iter().all(in_plane) {
                    is_taken[across] = true;
                    region.push(across);
                }
            }
            next += 1;
        }
        let mut corners: Vec<u32> = region.iter().flat_map(|&index| triangles[index]).collect();
        corners.sort_unstable();
        corners.dedup();
        facets.push(planar_hull(points, &corners, triangles[seed]));
    }
    canonical(facets)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cube_of_triangles_is_joined_into_six_facets() {
        let cube: Vec<Vec3> =
            (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
        let facets = hull_facets(&cube);
        assert_eq!(facets.map(|facets| facets.iter().map(Vec::len).collect::<Vec<_>>()), Ok(vec![4; 6]));
    }

    #[test]
    fn points_on_a_line_span_one_dimension() {
        let line: Vec<Vec3> = (0..5).map(|i| Vec3::new(i as f32, 2.0 * i as f32, 0.0)).collect();
        assert_eq!(hull_facets(&line), Err(HullError::Flat { dimension: 1 }));
    }
}
