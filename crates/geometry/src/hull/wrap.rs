//! Exact facets of a convex hull by gift wrapping.
//!
//! ```text
//! 1 find a hull edge, in a vertical supporting plane through the least point
//! 2 turn a plane about an unwrapped directed edge until no point lies outside it: that plane contains a facet
//! 3 take *all* points in that plane and form their planar hull: the facet, however many corners it has
//! 4 its edges, reversed, are to be wrapped unless their facet is known; repeat from 2 until none is left
//! ```
//! Chand and Kapur, "An algorithm for convex polytopes" (1970). Every decision is the sign of an exact determinant
//! (Shewchuk 1997), so coplanar and collinear points need neither a tolerance nor special cases. Cost: points times
//! facets. It is slow but obviously right: the oracle of the real builder, whose facets must be the same.

use super::HullError;
use super::loops::Loops;
use super::predicate::{affine_basis, is_collinear, outside, planar_hull, turn_seen_along};
use glam::Vec3;
use std::collections::BTreeSet;

/// Facets as vertex loops, counter-clockwise from outside, with no three corners on a line.
///
/// The points must be finite and no two the same.
pub(super) fn enumerate_facets(points: &[Vec3]) -> Result<Loops, HullError> {
    affine_basis(points).map_err(|dimension| HullError::Flat { dimension })?;
    let mut facets = Loops::default();
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
        }
        facets.push(facet);
    }
    Ok(facets.canonical())
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
    // Seen from above, the least point is a corner of the outline. Finds the vertical plane through it that has every
    // point on or to the left of it.
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
        // All points in the plane are collinear: they form an edge, from end to end.
        let end = in_plane.iter().copied().max_by(|&a, &b| order(points, a, b)).unwrap_or(ahead);
        return (least, end);
    };
    // The plane contains a whole facet: any edge of its outline will do.
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
    // Some point is off the line, as the points span space.
    let triangle = [p, q, third.unwrap_or(p)];
    let in_plane: Vec<u32> =
        (0..points.len() as u32).filter(|&i| outside(points, triangle, i) == 0.0).collect();
    planar_hull(points, &in_plane, triangle)
}
