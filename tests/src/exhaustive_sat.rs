//! The separating axis test without early outs: every candidate axis, full projections, in f64.
//!
//! The separation of two convex sets is the maximum over unit axes n of `min over B of n.x - max over A of n.x`. In
//! overlap it is attained at a facet normal of the Minkowski difference: a facet normal of A, one of B negated, or the
//! cross product of an edge of each (Gottschalk, Lin and Manocha, "OBBTree", 1996). In a gap the same axes give a lower
//! bound, and the sign.

use crate::placed::{Placed2, Placed3};
use glam::{DVec2, DVec3};

/// The kind of the best axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// A facet normal of A; in the plane, an edge normal.
    OfA,
    /// A facet normal of B; in the plane, an edge normal.
    OfB,
    /// The cross product of an edge of each.
    Edges,
}

/// The best axis of one kind.
#[derive(Clone, Copy, Debug)]
pub struct Best<V> {
    /// The gap along the axis, in metres: negative where the projections overlap.
    pub gap: f64,
    /// The unit axis, from A to B.
    pub normal: V,
    /// The kind of axis.
    pub axis: Axis,
}

/// The gap between the projections on a unit axis that points from A to B.
pub fn gap3(a: &Placed3, b: &Placed3, normal: DVec3) -> f64 {
    -b.reach(-normal) - a.reach(normal)
}

/// The gap between the projections on a unit axis that points from A to B.
pub fn gap2(a: &Placed2, b: &Placed2, normal: DVec2) -> f64 {
    -b.reach(-normal) - a.reach(normal)
}

/// The greatest gap over every axis of one kind.
pub fn best_of_kind3(a: &Placed3, b: &Placed3, axis: Axis) -> Best<DVec3> {
    let mut best = Best { gap: f64::NEG_INFINITY, normal: DVec3::X, axis };
    let mut consider = |normal: DVec3| {
        let gap = gap3(a, b, normal);
        if gap > best.gap {
            best = Best { gap, normal, axis };
        }
    };
    match axis {
        Axis::OfA => a.normals.iter().for_each(|&normal| consider(normal)),
        Axis::OfB => b.normals.iter().for_each(|&normal| consider(-normal)),
        Axis::Edges => {
            for &[p, q] in &a.edges {
                let along_a = (a.vertices[q] - a.vertices[p]).normalize();
                for &[r, s] in &b.edges {
                    let cross = along_a.cross((b.vertices[s] - b.vertices[r]).normalize());
                    // For two nearly parallel edges, whatever axis results, its projections are true bounds; only a
                    // cross product of exactly zero has no direction.
                    if let Some(normal) = cross.try_normalize() {
                        consider(normal);
                        consider(-normal);
                    }
                }
            }
        }
    }
    best
}

/// The greatest gap over every candidate axis: the separation in overlap, and its sign everywhere.
pub fn exhaustive_sat3(a: &Placed3, b: &Placed3) -> Best<DVec3> {
    let [of_a, of_b, edges] = [Axis::OfA, Axis::OfB, Axis::Edges].map(|axis| best_of_kind3(a, b, axis));
    let of_faces = if of_b.gap > of_a.gap { of_b } else { of_a };
    if edges.gap > of_faces.gap { edges } else { of_faces }
}

/// The greatest gap over the normals, both ways, of all vertex pairs of one shape. The edges are among them, and the
/// other pairs only add true lower bounds: nothing here relies on the order of the vertices.
pub fn best_of_kind2(a: &Placed2, b: &Placed2, axis: Axis) -> Best<DVec2> {
    let mut best = Best { gap: f64::NEG_INFINITY, normal: DVec2::X, axis };
    let vertices = if axis == Axis::OfA { &a.vertices } else { &b.vertices };
    for (index, &p) in vertices.iter().enumerate() {
        for &q in &vertices[..index] {
            let normal = (p - q).normalize().perp();
            for normal in [normal, -normal] {
                let gap = gap2(a, b, normal);
                if gap > best.gap {
                    best = Best { gap, normal, axis };
                }
            }
        }
    }
    best
}

/// The greatest gap over every candidate axis: the separation in overlap, and its sign everywhere.
pub fn exhaustive_sat2(a: &Placed2, b: &Placed2) -> Best<DVec2> {
    let [of_a, of_b] = [Axis::OfA, Axis::OfB].map(|axis| best_of_kind2(a, b, axis));
    if of_b.gap > of_a.gap { of_b } else { of_a }
}
