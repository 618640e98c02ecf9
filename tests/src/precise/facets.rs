//! Facets and edges of a convex hull from its vertices, exactly, and fast enough for hundreds of them.
//!
//! ```text
//! first facet  the least vertex and two others whose plane has no vertex on one side      (all pairs are tried)
//! next         a facet's edge u -> v, reversed: of all planes through it, the one with no vertex beyond it
//!              (gift wrapping: Chand and Kapur, 1970); all vertices in that plane belong to the facet
//! corners      a facet's outline, by the monotone chain (Andrew, 1979) with one coordinate dropped
//! ```
//! Every side is decided exactly. Flat hulls have one facet, listed from both sides; segments one edge; points nothing.
//! [`Solid`](crate::solid::Solid) finds the same by trying all triples.

use super::exactly::{side_of_line, side_of_plane};
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// A convex polyhedron, polygon, segment or point.
#[derive(Clone, Debug, Default)]
pub struct Polyhedron {
    /// The corners of each facet, counter-clockwise seen from outside; none lies between two others.
    pub facets: Vec<Vec<usize>>,
    /// The edges.
    pub edges: Vec<Edge>,
    /// Whether there is an interior.
    pub is_solid: bool,
}

/// An edge, and a vertex beside it for each facet that it bounds.
#[derive(Clone, Debug)]
pub struct Edge {
    /// Both ends.
    pub ends: [usize; 2],
    /// The vertex furthest from the edge of each facet beside it.
    pub beside: Vec<usize>,
}

impl Polyhedron {
    /// The hull of points whose coordinates are f32 values.
    pub fn of(points: &[DVec3]) -> Self {
        let mut distinct: Vec<usize> = (0..points.len()).collect();
        distinct.sort_by(|&i, &j| lexicographic(points[i], points[j]));
        distinct.dedup_by(|i, j| lexicographic(points[*i], points[*j]).is_eq());
        let (Some(&first), Some(&last)) = (distinct.first(), distinct.last()) else { return Self::default() };
        let off_line = distinct.iter().copied().find(|&p| dropped_axis(points, [first, last, p]).is_some());
        let Some(third) = off_line else {
            let edge = Edge { ends: [first, last], beside: vec![] };
            return Self { edges: (first != last).then_some(edge).into_iter().collect(), ..Self::default() };
        };
        let side = |&p: &usize| side_of_plane(points, [first, last, third], p);
        let facets = if distinct.iter().all(|p| side(p).is_eq()) {
            let outline = outline(points, &distinct, [first, last, third]);
            vec![outline.iter().rev().copied().collect(), outline]
        } else {
            wrapped(points, &distinct)
        };
        Self { edges: edges_of(points, &facets), is_solid: facets.len() > 2, facets }
    }
}

fn lexicographic(p: DVec3, q: DVec3) -> Ordering {
    // 0.0 and -0.0 are equal.
    let order = |axis: usize| (p[axis] + 0.0).total_cmp(&(q[axis] + 0.0));
    order(0).then(order(1)).then(order(2))
}

/// The best coordinate to drop so that three points are still not collinear; `None` if they are collinear.
fn dropped_axis(points: &[DVec3], [i, j, k]: [usize; 3]) -> Option<usize> {
    let area = (points[j] - points[i]).cross(points[k] - points[i]).abs();
    let mut axes = [0, 1, 2];
    axes.sort_by(|&p, &q| area[q].total_cmp(&area[p]));
    axes.into_iter().find(|&axis| side_of_line(points, [i, j, k], axis).is_ne())
}

/// The corners of the outline of coplanar points, three of which span the plane, in either orientation.
fn outline(points: &[DVec3], corners: &[usize], spanning: [usize; 3]) -> Vec<usize> {
    let axis = dropped_axis(points, spanning).expect("three points that span a plane");
    outline_without(points, corners, axis)
}

/// The corners of the outline of points projected along an axis; counter-clockwise if that is the third.
pub fn outline_without(points: &[DVec3], corners: &[usize], axis: usize) -> Vec<usize> {
    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
    let mut sorted = corners.to_vec();
    let order = |axis: usize, p: usize, q: usize| (points[p][axis] + 0.0).total_cmp(&(points[q][axis] + 0.0));
    sorted.sort_by(|&p, &q| order(u, p, q).then(order(v, p, q)));
    sorted.dedup_by(|p, q| order(u, *p, *q).then(order(v, *p, *q)).is_eq());
    if sorted.len() < 3 {
        return sorted;
    }
    let chain = |in_order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for point in in_order {
            while let [.., from, to] = chain[..]
                && side_of_line(points, [from, to, point], axis).is_le()
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let lower = chain(&mut sorted.iter().copied());
    let upper = chain(&mut sorted.iter().rev().copied());
    [lower, upper].concat()
}

/// All facets of points that span space.
fn wrapped(points: &[DVec3], distinct: &[usize]) -> Vec<Vec<usize>> {
    let mut facets: Vec<Vec<usize>> = Vec::new();
    let mut bounded = BTreeSet::new();
    // Reversed edges, each with a corner of the facet on which it was found.
    let mut open: Vec<[usize; 3]> = vec![];
    let mut next = Some(first_facet(points, distinct));
    while let Some(facet) = next.take() {
        for (i, &from) in facet.iter().enumerate() {
            let [to, beyond] = [1, 2].map(|step| facet[(i + step) % facet.len()]);
            assert!(bounded.insert([from, to]), "an edge bounds two facets");
            open.push([to, from, beyond]);
        }
        facets.push(facet);
        open.retain(|[from, to, _]| !bounded.contains(&[*from, *to]));
        next = open.last().map(|&[from, to, beyond]| {
            let further = |&w: &usize, &p: &usize| side_of_plane(points, [from, to, w], p).is_gt();
            let apex = distinct.iter().fold(beyond, |w, p| if further(&w, p) { *p } else { w });
            facet_through(points, distinct, [from, to, apex])
        });
    }
    facets
}

/// A facet with the least vertex as a corner: two others are searched whose plane has no vertex on one side.
fn first_facet(points: &[DVec3], distinct: &[usize]) -> Vec<usize> {
    let first = distinct[0];
    let others = &distinct[1..];
    for (index, &j) in others.iter().enumerate() {
        for &k in &others[index + 1..] {
            if dropped_axis(points, [first, j, k]).is_none() {
                continue;
            }
            let (mut above, mut below) = (false, false);
            for &p in others {
                match side_of_plane(points, [first, j, k], p) {
                    Ordering::Greater => above = true,
                    Ordering::Less => below = true,
                    Ordering::Equal => {}
                }
                if above && below {
                    break;
                }
            }
            if above != below {
                return facet_through(points, distinct, if above { [first, k, j] } else { [first, j, k] });
            }
        }
    }
    panic!("points that span space have a facet at each of their vertices")
}

/// The facet in the plane of three points, which has no vertex above it.
fn facet_through(points: &[DVec3], distinct: &[usize], plane: [usize; 3]) -> Vec<usize> {
    let in_plane = |&p: &usize| plane.contains(&p) || side_of_plane(points, plane, p).is_eq();
    let corners: Vec<usize> = distinct.iter().copied().filter(in_plane).collect();
    let mut facet = outline(points, &corners, plane);
    let outside = distinct.iter().find(|p| !corners.contains(p)).expect("the points span space");
    if side_of_plane(points, [facet[0], facet[1], facet[2]], *outside).is_gt() {
        facet.reverse();
    }
    facet
}

fn edges_of(points: &[DVec3], facets: &[Vec<usize>]) -> Vec<Edge> {
    let mut edges: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for facet in facets {
        for (i, &from) in facet.iter().enumerate() {
            let to = facet[(i + 1) % facet.len()];
            let off_edge = |&p: &usize| (points[to] - points[from]).cross(points[p] - points[from]).length();
            let beside = facet.iter().copied().max_by(|p, q| off_edge(p).total_cmp(&off_edge(q)));
            edges.entry([from.min(to), from.max(to)]).or_default().extend(beside);
        }
    }
    edges.into_iter().map(|(ends, beside)| Edge { ends, beside }).collect()
}
