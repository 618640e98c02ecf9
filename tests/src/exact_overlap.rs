//! Whether two shapes share a point, decided exactly, for shapes of every kind.
//!
//! ```text
//! bodies   = pieces: a core with a radius, or a half-space; compounds are all their parts      (exact::place)
//! points   = stored vertices, rotated and moved exactly: M(q)/|q|^2 and f64 positions are rational; one positive
//!            factor clears every denominator
//! sharp    = weights >= 0, summing to 1 on each side, whose two weighted means are the same point; or an axis that
//!            separates all points                                                               (exact::share)
//! rounded  = the squared distance of the cores against the squared sum of the radii              (exact::distance)
//! half     = the least height of a point, squared, against the squared radius
//! ```
//! It knows no faces, no edges and no tolerance. Guesses come from double-double arithmetic and are proved over
//! integers, whichever way they go; where a proof fails, integers alone find the answer. [`full_program3`] and
//! [`full_program2`] solve one linear program over all vertices instead: slow, and an oracle for this oracle.

use crate::exact::distance::distance_to_radius;
use crate::exact::place::{Cores, Piece, Point, dot, minus, pieces2, pieces3, times};
use crate::exact::share::{Guess, share_inside};
use crate::exact::simplex;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use num_bigint::{BigInt, Sign};
use std::cmp::Ordering;

pub use crate::exact::simplex::hulls_share_point;

/// How two shapes relate: the sign of their separation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Relation {
    /// They share no point: the separation is positive.
    Apart,
    /// They share a point, and an arbitrarily small translation separates them: the separation is zero.
    Touching,
    /// They share points, and no translation below some length separates them: the separation is negative.
    Overlapping,
}

/// Whether two posed shapes share a point. Closed sets: touching counts.
pub fn exact_overlap3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> bool {
    any_pair_shares(&pieces3(a, b))
}

/// Whether two posed shapes in the plane share a point. Closed sets: touching counts.
pub fn exact_overlap2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> bool {
    any_pair_shares(&pieces2(a, b))
}

/// How two posed shapes relate. Costs up to four linear programs more than [`exact_overlap3`] for sharp shapes.
pub fn exact_relation3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> Relation {
    greatest_relation(&pieces3(a, b))
}

/// How two posed shapes in the plane relate. Costs up to three linear programs more than [`exact_overlap2`] for sharp
/// shapes.
pub fn exact_relation2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> Relation {
    greatest_relation(&pieces2(a, b))
}

/// As [`exact_overlap3`], for sharp, convex, bounded shapes, by one linear program over all vertices.
pub fn full_program3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> bool {
    full_program(&pieces3(a, b))
}

/// As [`exact_overlap2`], for sharp, convex, bounded shapes, by one linear program over all vertices.
pub fn full_program2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> bool {
    full_program(&pieces2(a, b))
}

fn full_program(pieces: &[Vec<Piece>; 2]) -> bool {
    match (&pieces[0][..], &pieces[1][..]) {
        ([a @ Piece::Round { .. }], [b @ Piece::Round { .. }]) => {
            let cores = cores(a, b).expect("two cores");
            assert_eq!(cores.radius.sign(), Sign::NoSign, "of sharp shapes only");
            simplex::hulls_share_point(&cores.a, &cores.b)
        }
        _ => panic!("of two convex, bounded shapes only"),
    }
}

fn pairs(pieces: &[Vec<Piece>; 2]) -> impl Iterator<Item = (&Piece, &Piece)> {
    pieces[0].iter().flat_map(|a| pieces[1].iter().map(move |b| (a, b)))
}

fn any_pair_shares(pieces: &[Vec<Piece>; 2]) -> bool {
    pairs(pieces).any(|(a, b)| match cores(a, b) {
        Some(cores) => distance_to_radius(&cores, &Guess::new(&cores)).is_le(),
        None => to_half(a, b).is_le(),
    })
}

fn greatest_relation(pieces: &[Vec<Piece>; 2]) -> Relation {
    let of_pair = |(a, b)| {
        let Some(cores) = cores(a, b) else { return relation(to_half(a, b)) };
        match distance_to_radius(&cores, &Guess::new(&cores)) {
            Ordering::Equal if cores.radius.sign() == Sign::NoSign && share_inside(&cores) => {
                Relation::Overlapping
            }
            order => relation(order),
        }
    };
    pairs(pieces).map(of_pair).max().expect("a body has a piece")
}

/// From how a distance compares with a radius.
fn relation(order: Ordering) -> Relation {
    match order {
        Ordering::Greater => Relation::Apart,
        Ordering::Equal => Relation::Touching,
        Ordering::Less => Relation::Overlapping,
    }
}

/// Two pieces as cores, if both are bounded.
fn cores(a: &Piece, b: &Piece) -> Option<Cores> {
    match (a, b) {
        (
            Piece::Round { points, denominator, radius },
            Piece::Round { points: others, denominator: other, radius: more },
        ) => Some(Cores::new((points, denominator, radius), (others, other, more))),
        _ => None,
    }
}

/// How the separation of two pieces, at least one of which is a half-space, compares with zero.
fn to_half(a: &Piece, b: &Piece) -> Ordering {
    match (a, b) {
        (Piece::Half { normal, at, denominator }, Piece::Round { points, denominator: other, radius }) => {
            let plane = times(at, other);
            let height = |point: &Point| dot(normal, &minus(&times(point, denominator), &plane));
            let least = points.iter().map(height).min().expect("a core has points");
            let radius = radius * denominator * other;
            match least.sign() {
                Sign::Plus => (&least * &least).cmp(&(&radius * &radius * dot(normal, normal))),
                Sign::Minus => Ordering::Less,
                Sign::NoSign => BigInt::ZERO.cmp(&radius),
            }
        }
        (Piece::Round { .. }, Piece::Half { .. }) => to_half(b, a),
        (
            Piece::Half { normal, at, denominator },
            Piece::Half { normal: facing, at: there, denominator: other },
        ) => {
            // Only exactly opposite normals leave a gap, or share just a plane.
            let minors = (0..normal.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            let is_parallel =
                minors.into_iter().all(|(i, j)| &normal[i] * &facing[j] == &normal[j] * &facing[i]);
            if !is_parallel || dot(normal, facing).sign() == Sign::Plus {
                return Ordering::Less;
            }
            dot(normal, &minus(&times(there, denominator), &times(at, other))).cmp(&BigInt::ZERO)
        }
        (Piece::Round { .. }, Piece::Round { .. }) => unreachable!("two cores have a distance"),
    }
}
