//! The distance of two disjoint polyhedra, between two certified bounds.
//!
//! ```text
//! v = a point of A - B
//! repeat
//!   w = the vertex of A - B furthest towards the origin from v
//!   |v| bounds the distance from above (it has witness points), v.w/|v| from below (it is a projection)
//!   stop where they meet, or where w brings nothing new
//!   v = the nearest point to the origin of the simplex of v's corners and w; keep the corners it needs
//! ```
//! Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex objects in
//! three-dimensional space" (1988). Whatever rounding does to the iteration, both bounds hold for what is returned:
//! a stall widens the reported error, and nothing else. Cost: a few steps, each linear in the vertices.

use super::simplex::nearest_to_origin;
use super::solid::Solid;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Steps after which the iteration gives up narrowing. Sets of random hulls need 4 to 12.
const MAX_STEPS: usize = 64;

/// Witness points and the bounds they leave.
#[derive(Clone, Debug)]
pub(crate) struct Witness {
    /// Distance of the witness points: an upper bound.
    pub(crate) distance: f64,
    /// The best separation by projection that was met: a lower bound.
    pub(crate) at_least: f64,
    /// The unit axis of that projection, from A to B.
    pub(crate) normal: DVec3,
    pub(crate) point_a: DVec3,
    pub(crate) point_b: DVec3,
    /// Vertices of A and of B that carry the witness points, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 4>,
}

/// Narrows the distance down; nothing where the shapes cannot be told apart. `size` is the size of the pair.
pub(crate) fn distance(a: &Solid, b: &Solid, towards_b: DVec3, size: f64) -> Option<Witness> {
    let corner = |direction: DVec3| {
        let (in_a, in_b) = (a.support(direction).vertex, b.support(-direction).vertex);
        ([in_a, in_b], a.point(in_a) - b.point(in_b))
    };
    let mut simplex: ArrayVec<([usize; 2], DVec3), 4> = ArrayVec::new();
    simplex.push(corner(towards_b));
    let mut v = simplex[0].1;
    let mut weights = [1.0, 0.0, 0.0, 0.0];
    let (mut at_least, mut normal) = (f64::NEG_INFINITY, towards_b);
    for _ in 0..MAX_STEPS {
        let length = v.length();
        if length <= f64::EPSILON * size {
            return None;
        }
        let direction = -v / length;
        let (vertices, w) = corner(direction);
        let bound = -direction.dot(w);
        if bound > at_least {
            (at_least, normal) = (bound, direction);
        }
        let brings_nothing = simplex.iter().any(|&(known, _)| known == vertices);
        if length - at_least <= DISTANCE_GAP * size || brings_nothing || simplex.is_full() {
            break;
        }
        simplex.push((vertices, w));
        let points: ArrayVec<DVec3, 4> = simplex.iter().map(|&(_, point)| point).collect();
        let nearest = nearest_to_origin(&points)?;
        if nearest.point.length() >= length {
            simplex.pop();
            break;
        }
        v = nearest.point;
        let mut slot = 0;
        let mut index = 0;
        weights = [0.0; 4];
        simplex.retain(|_| {
            let keep = nearest.corners >> index & 1 == 1;
            if keep {
                weights[slot] = nearest.weights[index];
                slot += 1;
            }
            index += 1;
            keep
        });
    }
    let weighted = |solid: &Solid, which: usize| {
        simplex
            .iter()
            .zip(weights)
            .map(|((corner, _), weight)| solid.point(corner[which]) * weight)
            .sum::<DVec3>()
    };
    let (point_a, point_b) = (weighted(a, 0), weighted(b, 1));
    let corners = simplex.iter().map(|&(corner, _)| corner).collect();
    Some(Witness { distance: (point_b - point_a).length(), at_least, normal, point_a, point_b, corners })
}
