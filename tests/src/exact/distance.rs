//! The distance of two hulls against a radius, exactly, by squares.
//!
//! ```text
//! guess     closest points in double-double (share)
//! apart     its axis n, cut to integers: gap along n positive, and its square above radius^2 n^2; over all points
//! within    its weights, cut to integers: a difference of two points of the hulls, shorter than the radius
//! else      the foot of the origin on some vertices' differences, by ratios of integers. It is the closest there is
//!           exactly when it lies between them and no point of either hull is nearer along it; then its square decides
//! ```
//! Two closest points can be chosen in a vertex and a vertex, edge or triangle, or in two edges: differences of at most
//! four vertices, three of which span the foot.

use super::place::{Cores, Point, dot, minus, times};
use super::share::{Guess, cut, furthest, least_far, share_point};
use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

/// How the distance between the hulls compares with the radius. If they share a point it is less, unless the radius is
/// 0.
pub fn distance_to_radius(cores: &Cores, guess: &Guess) -> Ordering {
    if cores.radius.sign() == Sign::NoSign {
        return if share_point(cores, guess) { Ordering::Equal } else { Ordering::Greater };
    }
    if is_beyond(cores, guess) {
        return Ordering::Greater;
    }
    if is_within(cores, guess) || share_point(cores, guess) {
        return Ordering::Less;
    }
    let reach = guess.a.reach() + guess.b.reach();
    let near = guess
        .found
        .axis
        .map(|axis| [guess.a.near_support(axis, 1e-20 * reach), guess.b.near_support(-axis, 1e-20 * reach)]);
    let all = [(0..cores.a.len()).collect(), (0..cores.b.len()).collect()];
    let spanned = compare_foot(cores, &guess.found.corners);
    let nearby = || near.and_then(|near| compare_among(cores, &near));
    spanned.or_else(nearby).or_else(|| compare_among(cores, &all)).expect("closest points have features")
}

fn is_beyond(cores: &Cores, guess: &Guess) -> bool {
    let Some(axis) = guess.axis(cores.a[0].len()) else { return false };
    let gap = least_far(&cores.b, &axis).1 - furthest(&cores.a, &axis).1;
    gap.sign() == Sign::Plus && &gap * &gap > &cores.radius * &cores.radius * dot(&axis, &axis)
}

fn is_within(cores: &Cores, guess: &Guess) -> bool {
    let weights: Vec<BigInt> =
        guess.found.weights.iter().map(|w| w.parts().map(|p| cut(p, 104)).iter().sum()).collect();
    if weights.iter().any(|weight| weight.sign() == Sign::Minus) {
        return false;
    }
    let corners: Vec<Point> = guess.found.corners.iter().map(|&pair| difference(cores, pair)).collect();
    let (whole, foot) = (weights.iter().sum::<BigInt>(), combined(&corners, &weights));
    let limit = &cores.radius * &whole;
    dot(&foot, &foot) < &limit * &limit
}

fn difference(cores: &Cores, [i, j]: [usize; 2]) -> Point {
    minus(&cores.b[j], &cores.a[i])
}

fn combined(points: &[Point], weights: &[BigInt]) -> Point {
    let zero = vec![BigInt::ZERO; points[0].len()];
    points.iter().zip(weights).fold(zero, |sum, (point, weight)| {
        sum.iter().zip(times(point, weight)).map(|(sum, term)| sum + term).collect()
    })
}

/// The answer from all sets of up to three differences of at most four of the given vertices.
fn compare_among(cores: &Cores, [of_a, of_b]: &[Vec<usize>; 2]) -> Option<Ordering> {
    let pairs: Vec<[usize; 2]> = of_a.iter().flat_map(|&i| of_b.iter().map(move |&j| [i, j])).collect();
    let singles = (0..pairs.len()).map(|p| vec![p]);
    let doubles = (0..pairs.len()).flat_map(|q| (0..q).map(move |p| vec![p, q]));
    let triples = (0..pairs.len()).flat_map(|r| (0..r).flat_map(move |q| (0..q).map(move |p| vec![p, q, r])));
    singles.chain(doubles).chain(triples).find_map(|chosen| {
        let corners: Vec<[usize; 2]> = chosen.iter().map(|&p| pairs[p]).collect();
        let vertices = [0, 1].map(|side| {
            let mut of_side: Vec<usize> = corners.iter().map(|corner| corner[side]).collect();
            of_side.sort_unstable();
            of_side.dedup();
            of_side.len()
        });
        if vertices[0] + vertices[1] > 4 { None } else { compare_foot(cores, &corners) }
    })
}

/// The answer, if the foot of the origin on these differences lies between them and is the closest point of all.
fn compare_foot(cores: &Cores, corners: &[[usize; 2]]) -> Option<Ordering> {
    let points: Vec<Point> = corners.iter().map(|&pair| difference(cores, pair)).collect();
    let mut shares = shares_of_foot(&points)?;
    let mut whole: BigInt = shares.iter().sum();
    if whole.sign() == Sign::Minus {
        whole = -whole;
        shares.iter_mut().for_each(|share| *share = -&*share);
    }
    if whole.sign() == Sign::NoSign || shares.iter().any(|share| share.sign() == Sign::Minus) {
        return None;
    }
    // The foot times the sum of the shares.
    let foot = combined(&points, &shares);
    let squared = dot(&foot, &foot);
    let gap = least_far(&cores.b, &foot).1 - furthest(&cores.a, &foot).1;
    let limit = &cores.radius * &whole;
    (gap * whole >= squared).then(|| squared.cmp(&(&limit * &limit)))
}

/// The weights of up to three points in the foot of the origin on their affine hull, up to a common factor.
fn shares_of_foot(points: &[Point]) -> Option<Vec<BigInt>> {
    match points {
        [_] => Some(vec![BigInt::from(1)]),
        [p, q] => {
            let along = minus(q, p);
            Some(vec![dot(q, &along), -dot(p, &along)])
        }
        [p, q, r] if p.len() == 3 => {
            let normal = cross(&minus(q, p), &minus(r, p));
            Some([[q, r], [r, p], [p, q]].map(|[u, v]| dot(&cross(u, v), &normal)).to_vec())
        }
        _ => None,
    }
}

/// The cross product in space.
pub fn cross(u: &[BigInt], v: &[BigInt]) -> Point {
    (0..3).map(|i| (&u[(i + 1) % 3] * &v[(i + 2) % 3]) - (&u[(i + 2) % 3] * &v[(i + 1) % 3])).collect()
}
