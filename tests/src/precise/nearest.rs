//! The least distance of two convex hulls of points, between two bounds that prove each other.
//!
//! ```text
//! simplex = up to four differences of a point of B and one of A           (Gilbert, Johnson and Keerthi, 1988)
//! loop      the point of the simplex nearest to the origin, by trying every subset of its corners
//!           its length bounds the distance from above: it is a difference of two points of the hulls
//!           the gap between the projections on its direction bounds it from below
//!           until they agree, or no corner is new; a simplex that contains the origin ends it too: the hulls overlap
//! ```
//! Whatever the iteration does, both bounds are true, up to the rounding of a double-double.

use super::dd::{Dd, Dd3};
use glam::DVec3;

/// Points, and the same points in f64, among which support points are searched first.
#[derive(Clone, Debug)]
pub struct Cloud {
    /// The points. There is at least one.
    pub points: Vec<Dd3>,
    rough: Vec<DVec3>,
    /// The greatest distance of a point from the origin.
    reach: f64,
}

/// What is known of the distance between two hulls.
#[derive(Clone, Debug)]
pub struct Nearest {
    /// From A to B, the shortest difference found; zero or nearly zero in overlap.
    pub vector: Dd3,
    /// The points of A and of B, by index, whose differences span `vector`.
    pub corners: Vec<[usize; 2]>,
    /// The weight of each of them.
    pub weights: Vec<Dd>,
    /// At least the distance: the length of `vector`.
    pub upper: Dd,
    /// At most the distance; negative where no axis tried shows a gap.
    pub lower: Dd,
    /// The unit axis that shows `lower`.
    pub axis: Option<Dd3>,
}

/// Steps after which the iteration is cut off; a few dozen is the most seen.
const MAX_STEPS: usize = 500;

/// The relative error of the length of a sum in double-double, over its largest term: 2^-98, sixteen units or so.
pub const NOISE: f64 = 3.2e-30;

impl Cloud {
    /// From points, at least one.
    pub fn new(points: Vec<Dd3>) -> Self {
        let rough: Vec<DVec3> = points.iter().map(|p| p.to_f64()).collect();
        let reach = rough.iter().map(|p| p.length()).fold(0.0, f64::max);
        Self { points, rough, reach }
    }

    /// The points in f64.
    pub fn rough(&self) -> &[DVec3] {
        &self.rough
    }

    /// The greatest distance of a point from the origin.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The point furthest along a unit axis, and its projection.
    pub fn support(&self, axis: Dd3) -> (usize, Dd) {
        let rough_axis = axis.to_f64();
        let along: Vec<f64> = self.rough.iter().map(|p| p.dot(rough_axis)).collect();
        let most = along.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // At most ten roundings of f64 on either side; a point below this cannot be the furthest.
        let enough = most - 1e-14 * self.reach;
        let near = (0..along.len()).filter(|&i| along[i] >= enough);
        let exact = near.map(|i| (i, self.points[i].dot(axis)));
        exact.fold(None, later_if_greater).unwrap_or((0, Dd::ZERO))
    }

    /// The points within `slack` of the furthest along a unit axis, furthest first.
    pub fn near_support(&self, axis: Dd3, slack: f64) -> Vec<usize> {
        let (_, most) = self.support(axis);
        let mut near: Vec<(usize, f64)> = (self.points.iter().enumerate())
            .map(|(i, p)| (i, (most - p.dot(axis)).to_f64()))
            .filter(|(_, below)| *below <= slack)
            .collect();
        near.sort_by(|p, q| p.1.total_cmp(&q.1));
        near.into_iter().map(|(i, _)| i).collect()
    }
}

fn later_if_greater(best: Option<(usize, Dd)>, next: (usize, Dd)) -> Option<(usize, Dd)> {
    match best {
        Some(best) if best.1 >= next.1 => Some(best),
        _ => Some(next),
    }
}

/// The gap between the projections of two clouds on a unit axis from A to B.
pub fn gap_along(a: &Cloud, b: &Cloud, axis: Dd3) -> Dd {
    -b.support(-axis).1 - a.support(axis).1
}

/// The distance between the hulls of two clouds.
pub fn nearest(a: &Cloud, b: &Cloud) -> Nearest {
    let noise = NOISE * (a.reach + b.reach);
    let difference = |[i, j]: [usize; 2]| b.points[j] - a.points[i];
    let start = [0, 0];
    let mut best = Nearest {
        vector: difference(start),
        corners: vec![start],
        weights: vec![Dd::from(1.0)],
        upper: difference(start).length(),
        lower: Dd::from(f64::NEG_INFINITY),
        axis: None,
    };
    let mut simplex = best.corners.clone();
    for _ in 0..MAX_STEPS {
        let Some(axis) = best.vector.try_normalize().filter(|_| best.upper.to_f64() > noise) else { break };
        let ((i, on_a), (j, on_b)) = (a.support(axis), b.support(-axis));
        if -on_b - on_a > best.lower {
            (best.lower, best.axis) = (-on_b - on_a, Some(axis));
        }
        if (best.upper - best.lower).to_f64() <= noise || simplex.contains(&[i, j]) {
            break;
        }
        simplex.push([i, j]);
        let corners: Vec<Dd3> = simplex.iter().map(|&pair| difference(pair)).collect();
        let Some((kept, weights, vector)) = nearest_of_simplex(&corners) else { break };
        let length = vector.length();
        if length >= best.upper {
            break;
        }
        simplex = kept.iter().map(|&i| simplex[i]).collect();
        best = Nearest { vector, corners: simplex.clone(), weights, upper: length, ..best };
        if simplex.len() == 4 {
            break;
        }
    }
    best
}

/// The point nearest to the origin of the hull of up to four points: the corners that span it, and their weights.
fn nearest_of_simplex(corners: &[Dd3]) -> Option<(Vec<usize>, Vec<Dd>, Dd3)> {
    let mut best: Option<(Vec<usize>, Vec<Dd>, Dd3, Dd)> = None;
    for subset in 1_usize..1 << corners.len() {
        let kept: Vec<usize> = (0..corners.len()).filter(|i| subset >> i & 1 == 1).collect();
        let of: Vec<Dd3> = kept.iter().map(|&i| corners[i]).collect();
        let Some(weights) = weights_of_foot(&of) else { continue };
        let vector = of.iter().zip(&weights).fold(Dd3::ZERO, |sum, (&p, &w)| sum + p * w);
        let squared = vector.dot(vector);
        if best.as_ref().is_none_or(|best| squared < best.3) {
            best = Some((kept, weights, vector, squared));
        }
    }
    best.map(|(kept, weights, vector, _)| (kept, weights, vector))
}

/// The weights of up to four points in the foot of the origin on their affine hull; `None` if one is negative, or if
/// the points are affinely dependent: a subset of them does as well then.
fn weights_of_foot(points: &[Dd3]) -> Option<Vec<Dd>> {
    let shares = match *points {
        [_] => vec![Dd::from(1.0)],
        [p, q] => {
            let along = q - p;
            vec![q.dot(along), -p.dot(along)]
        }
        [p, q, r] => {
            let normal = (q - p).cross(r - p);
            vec![q.cross(r).dot(normal), r.cross(p).dot(normal), p.cross(q).dot(normal)]
        }
        [p, q, r, s] => {
            let of = |u: Dd3, v: Dd3, w: Dd3| u.cross(v).dot(w);
            vec![of(q, r, s), -of(p, r, s), of(p, q, s), -of(p, q, r)]
        }
        _ => return None,
    };
    let sum = shares.iter().fold(Dd::ZERO, |sum, &share| sum + share);
    if sum == Dd::ZERO {
        return None;
    }
    let weights: Vec<Dd> = shares.into_iter().map(|share| share / sum).collect();
    weights.iter().all(|&weight| weight >= Dd::ZERO).then_some(weights)
}
