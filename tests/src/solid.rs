//! Facets and edges of a convex hull from its vertices alone.
//!
//! The plane through three vertices contains a facet exactly when there are not vertices on both sides of it; two
//! facets that share two vertices share an edge. All triples are tried and every side is decided exactly, so nothing
//! here depends on a tolerance, nor on the library's hull builder.

use crate::integers::common_integers;
use asunder_geometry::Shape3;
use glam::{DVec3, Vec3};
use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// A convex polyhedron by its vertices, facets and edges.
#[derive(Clone, Debug)]
pub struct Solid {
    /// The vertices, as stored by the shape.
    pub vertices: Vec<Vec3>,
    /// Every facet, as all the vertices in its plane.
    pub facets: Vec<Facet>,
    /// Every edge, as its two ends.
    pub edges: Vec<[usize; 2]>,
}

/// All vertices in one supporting plane.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Outward unit normal, from the largest triangle of its corners.
    pub normal: DVec3,
    /// Indices of the vertices in the plane, ascending.
    pub corners: Vec<usize>,
}

impl Solid {
    /// The solid of a shape's stored vertices.
    pub fn of(shape: &Shape3) -> Self {
        Self::of_vertices(shape.core().vertices())
    }

    /// The hull of vertices that span space. Cost: the fourth power of their number at worst.
    pub fn of_vertices(vertices: &[Vec3]) -> Self {
        let mut largest: BTreeMap<Vec<usize>, (f64, DVec3)> = BTreeMap::new();
        let count = vertices.len();
        for i in 0..count {
            for j in i + 1..count {
                for k in j + 1..count {
                    let Some((corners, sense)) = supported(vertices, [i, j, k]) else { continue };
                    let area = doubled_area(vertices, [i, j, k]) * sense;
                    let known = largest.entry(corners).or_insert((0.0, DVec3::ZERO));
                    if area.length() > known.0 {
                        *known = (area.length(), area.normalize());
                    }
                }
            }
        }
        let facets: Vec<Facet> =
            largest.into_iter().map(|(corners, (_, normal))| Facet { normal, corners }).collect();
        let edges = edges_between(vertices, &facets);
        Self { vertices: vertices.to_vec(), facets, edges }
    }
}

/// The vertices in the plane of a triple and the sign that makes its normal point outwards; `None` if it supports
/// nothing.
fn supported(vertices: &[Vec3], triple: [usize; 3]) -> Option<(Vec<usize>, f64)> {
    let (mut above, mut below) = (false, false);
    let mut corners = Vec::new();
    for l in 0..vertices.len() {
        match if triple.contains(&l) { Ordering::Equal } else { side(vertices, triple, l) } {
            Ordering::Greater => above = true,
            Ordering::Less => below = true,
            Ordering::Equal => corners.push(l),
        }
        if above && below {
            return None;
        }
    }
    // A collinear triple has every vertex "in its plane": it supports no facet.
    (above || below).then_some((corners, if above { -1.0 } else { 1.0 }))
}

fn doubled_area(vertices: &[Vec3], [i, j, k]: [usize; 3]) -> DVec3 {
    let from_i = |v: usize| vertices[v].as_dvec3() - vertices[i].as_dvec3();
    from_i(j).cross(from_i(k))
}

/// Which side of the plane through a triple a vertex lies on, exactly.
fn side(vertices: &[Vec3], triple: [usize; 3], l: usize) -> Ordering {
    let [i, j, k] = triple;
    let from_i = |v: usize| vertices[v].as_dvec3() - vertices[i].as_dvec3();
    let (u, v, w) = (from_i(j), from_i(k), from_i(l));
    let det = u.cross(v).dot(w);
    // Each of the 12 roundings loses at most 2^-53 of a product of the three lengths: 1e-14 of it covers them.
    if det.abs() > 1e-14 * u.length() * v.length() * w.length() {
        return det.total_cmp(&0.0);
    }
    let all: Vec<f64> =
        [i, j, k, l].iter().flat_map(|&index| vertices[index].as_dvec3().to_array()).collect();
    let integers = common_integers(&all);
    let arm = |row: usize, axis: usize| &integers[3 * row + axis] - &integers[axis];
    let minor = |a: usize, b: usize| -> BigInt { arm(1, a) * arm(2, b) - arm(1, b) * arm(2, a) };
    let det = minor(1, 2) * arm(3, 0) + minor(2, 0) * arm(3, 1) + minor(0, 1) * arm(3, 2);
    match det.sign() {
        Sign::Plus => Ordering::Greater,
        Sign::Minus => Ordering::Less,
        Sign::NoSign => Ordering::Equal,
    }
}

fn edges_between(vertices: &[Vec3], facets: &[Facet]) -> Vec<[usize; 2]> {
    let mut edges = BTreeSet::new();
    for (index, facet) in facets.iter().enumerate() {
        for other in &facets[..index] {
            let shared: Vec<usize> =
                facet.corners.iter().copied().filter(|corner| other.corners.contains(corner)).collect();
            // More than two shared vertices are collinear: the edge is the two furthest apart.
            let length = |[p, q]: [usize; 2]| (vertices[p].as_dvec3() - vertices[q].as_dvec3()).length();
            let pairs = shared.iter().flat_map(|&p| shared.iter().map(move |&q| [p, q]));
            let longest = pairs.filter(|[p, q]| p < q).max_by(|&a, &b| length(a).total_cmp(&length(b)));
            edges.extend(longest);
        }
    }
    edges.into_iter().collect()
}
