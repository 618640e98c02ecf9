//! Merging facets that differ from one plane by rounding only.
//!
//! ```text
//! for each facet not yet in a face, the largest first:
//!   grow over neighbouring facets as long as every corner of theirs lies within the tolerance of its plane
//!   the face is the outline of that region, if it is one loop; else the facet stays alone
//! vertices that no outline visits lie inside a face: they are reported, and the hull is built again without them
//! ```
//! Growing from the largest facet measures distance from the best-conditioned plane, never from a sliver's.

use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// Faces as vertex loops, and the vertices that ended up inside one, ascending.
pub(super) struct Merged {
    pub(super) faces: Vec<Vec<u32>>,
    pub(super) inside: Vec<u32>,
}

pub(super) fn merge_facets(points: &[Vec3], facets: &[Vec<u32>], tolerance: f64) -> Merged {
    let mut facet_left_of: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for (index, facet) in facets.iter().enumerate() {
        for_edges(facet, |from, to| {
            facet_left_of.insert((from, to), index);
        });
    }
    let doubled_area = |facet: &Vec<u32>| area_vector(facet.iter().map(|&i| points[i as usize])).length();
    let mut by_area: Vec<(f64, usize)> = facets.iter().map(doubled_area).zip(0..).collect();
    by_area.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));

    let mut face_of: Vec<Option<usize>> = vec![None; facets.len()];
    let mut faces = Vec::new();
    for (_, seed) in by_area {
        if face_of[seed].is_some() {
            continue;
        }
        let region = grow(points, facets, &facet_left_of, &face_of, seed, tolerance);
        let in_region = |facet: usize| region.contains(&facet);
        let (members, outline) = match outline(facets, &facet_left_of, &region, in_region) {
            Some(outline) => (region, outline),
            None => (vec![seed], facets[seed].clone()),
        };
        for member in members {
            face_of[member] = Some(faces.len());
        }
        faces.push(outline);
    }
    let mut visited = vec![false; points.len()];
    faces.iter().flatten().for_each(|&i| visited[i as usize] = true);
    let mut inside: Vec<u32> = facets.iter().flatten().copied().filter(|&i| !visited[i as usize]).collect();
    inside.sort_unstable();
    inside.dedup();
    Merged { faces, inside }
}

fn for_edges(facet: &[u32], mut visit: impl FnMut(u32, u32)) {
    for (i, &from) in facet.iter().enumerate() {
        visit(from, facet[(i + 1) % facet.len()]);
    }
}

fn grow(
    points: &[Vec3],
    facets: &[Vec<u32>],
    facet_left_of: &BTreeMap<(u32, u32), usize>,
    face_of: &[Option<usize>],
    seed: usize,
    tolerance: f64,
) -> Vec<usize> {
    let normal = unit_normal(facets[seed].iter().map(|&i| points[i as usize]));
    let origin = points[facets[seed][0] as usize].as_dvec3();
    let is_flat = |facet: usize| {
        let facing = unit_normal(facets[facet].iter().map(|&i| points[i as usize])).dot(normal) > 0.5;
        let near = |&i: &u32| normal.dot(points[i as usize].as_dvec3() - origin).abs() <= tolerance;
        facing && facets[facet].iter().all(near)
    };
    let mut region = vec![seed];
    let mut next = 0;
    while next < region.len() {
        for_edges(&facets[region[next]], |from, to| {
            if let Some(&neighbour) = facet_left_of.get(&(to, from))
                && face_of[neighbour].is_none()
                && !region.contains(&neighbour)
                && is_flat(neighbour)
            {
                region.push(neighbour);
            }
        });
        next += 1;
    }
    region
}

/// The single loop around a region of facets, or nothing if its border is not one simple loop.
fn outline(
    facets: &[Vec<u32>],
    facet_left_of: &BTreeMap<(u32, u32), usize>,
    region: &[usize],
    in_region: impl Fn(usize) -> bool,
) -> Option<Vec<u32>> {
    let mut leads_to: BTreeMap<u32, u32> = BTreeMap::new();
    let mut is_simple = true;
    for &facet in region {
        for_edges(&facets[facet], |from, to| {
            let is_border = facet_left_of.get(&(to, from)).is_none_or(|&other| !in_region(other));
            if is_border {
                is_simple &= leads_to.insert(from, to).is_none();
            }
        });
    }
    let (&start, _) = leads_to.first_key_value()?;
    let mut around = vec![start];
    let mut at = *leads_to.get(&start)?;
    while at != start && around.len() <= leads_to.len() {
        around.push(at);
        at = *leads_to.get(&at)?;
    }
    (is_simple && around.len() == leads_to.len() && around.len() >= 3).then_some(around)
}

/// Newell's area vector: twice the area, along the normal. About the first corner, so that far loops lose nothing.
fn area_vector(corners: impl Iterator<Item = Vec3>) -> DVec3 {
    let mut corners = corners.map(Vec3::as_dvec3);
    let Some(origin) = corners.next() else { return DVec3::ZERO };
    let (mut sum, mut last) = (DVec3::ZERO, DVec3::ZERO);
    for corner in corners {
        let arm = corner - origin;
        sum += last.cross(arm);
        last = arm;
    }
    sum
}

/// Unit normal of a loop, in f64. A loop whose area vanishes even in f64 gets x: any axis is verified before use.
pub(super) fn unit_normal(corners: impl Iterator<Item = Vec3>) -> DVec3 {
    let area = area_vector(corners);
    // Scaled first: the squares of a 1e-90 area would underflow.
    let largest = area.abs().max_element();
    if largest > 0.0 { (area / largest).normalize() } else { DVec3::X }
}

/// Distance from a point to a triangle, after Ericson, "Real-Time Collision Detection" (2005), 5.1.5.
pub(super) fn distance_to_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_segment = |u: DVec3, v: DVec3| {
        let along = v - u;
        let t = ((p - u).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (u + along * t - p).length()
    };
    let normal = (b - a).cross(c - a);
    let inside = |u: DVec3, v: DVec3| (v - u).cross(p - u).dot(normal) >= 0.0;
    let edges = to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a));
    if inside(a, b) && inside(b, c) && inside(c, a) {
        edges.min((normal.dot(p - a) / normal.length()).abs())
    } else {
        edges
    }
}
