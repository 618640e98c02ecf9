//! Whether two hulls share a point: guesses in double-double, proofs in integers.
//!
//! ```text
//! guess    the closest points of the two hulls, and the axis between them, in double-double
//! apart    the axis, cut to integers, separates every point of A from every point of B; checked for all of them
//! shared   otherwise: the few points that span the guess form a small linear program, solved over integers
//!            it is feasible    -> hulls of subsets share a point, and so do the hulls
//!            it is not         -> its proof is an axis; if that separates all points: apart. Else the points that
//!                                 violate it most join the program, which grows at every step, and so ends
//! ```
//! The guesses affect only the time.

use super::place::{Cores, Point, dot};
use super::simplex::{parting, refutation};
use crate::precise::dd::{Dd, Dd3};
use crate::precise::nearest::{Cloud, Nearest, nearest};
use num_bigint::{BigInt, Sign};

/// Two cores, scaled to about one unit in size, in double-double.
#[derive(Clone, Debug)]
pub struct Guess {
    /// The points of A.
    pub a: Cloud,
    /// The points of B.
    pub b: Cloud,
    /// The closest points and the axis between them.
    pub found: Nearest,
}

/// Bits of an axis that is cut to integers.
const AXIS_BITS: i32 = 104;

impl Guess {
    /// The guess for two cores.
    pub fn new(cores: &Cores) -> Self {
        let bits = cores.a.iter().chain(&cores.b).flatten().map(BigInt::bits).max().unwrap_or(0);
        let rounded = |points: &[Point]| {
            let number = |p: &Point, i: usize| p.get(i).map_or(Dd::ZERO, |c| as_dd(c, bits as i64));
            Cloud::new(points.iter().map(|p| Dd3::new(number(p, 0), number(p, 1), number(p, 2))).collect())
        };
        let (a, b) = (rounded(&cores.a), rounded(&cores.b));
        let found = nearest(&a, &b);
        Self { a, b, found }
    }

    /// The guessed axis as integers of the cores' dimension.
    pub fn axis(&self, dimension: usize) -> Option<Point> {
        self.found
            .axis
            .map(|axis| [axis.x, axis.y, axis.z][..dimension].iter().map(|&c| as_integer(c)).collect())
    }
}

/// An integer of at most `bits` bits, times 2^-`bits`, rounded.
pub fn as_dd(value: &BigInt, bits: i64) -> Dd {
    let digit = |(i, digit): (usize, u64)| {
        let scale = power_of_two(64 * i as i64 - bits);
        let (high, low) = ((digit >> 32) as f64 * 4_294_967_296.0, (digit & 0xFFFF_FFFF) as f64);
        Dd::sum(high * scale, low * scale)
    };
    let digits = value.iter_u64_digits().enumerate();
    let first = digits.len().saturating_sub(3);
    let magnitude = digits.skip(first).map(digit).fold(Dd::ZERO, |sum, part| sum + part);
    if value.sign() == Sign::Minus { -magnitude } else { magnitude }
}

/// 2 to a power of at most 63; zero below f64's range.
fn power_of_two(exponent: i64) -> f64 {
    if exponent < -1022 { 0.0 } else { f64::from_bits(((exponent + 1023) as u64) << 52) }
}

/// A number of magnitude about 1 at most, times 2^[`AXIS_BITS`], cut to an integer.
fn as_integer(value: Dd) -> BigInt {
    value.parts().into_iter().map(|part| cut(part, AXIS_BITS)).sum()
}

/// An f64 times 2^`bits`, cut to an integer.
pub fn cut(value: f64, bits: i32) -> BigInt {
    let Some(last) = crate::integers::last_exponent(value) else { return BigInt::ZERO };
    let mantissa = crate::integers::in_unit(value, last);
    let shift = last + bits;
    if shift >= 0 { mantissa << shift as usize } else { mantissa >> shift.unsigned_abs() as usize }
}

/// The furthest of some points along an axis: its index, and its projection.
pub fn furthest(points: &[Point], axis: &[BigInt]) -> (usize, BigInt) {
    let along = points.iter().map(|p| dot(p, axis)).enumerate();
    along.max_by(|p, q| p.1.cmp(&q.1)).expect("a core has points")
}

/// The nearest of some points along an axis: its index, and its projection.
pub fn least_far(points: &[Point], axis: &[BigInt]) -> (usize, BigInt) {
    let along = points.iter().map(|p| dot(p, axis)).enumerate();
    along.min_by(|p, q| p.1.cmp(&q.1)).expect("a core has points")
}

/// Whether two hulls share a point.
pub fn share_point(cores: &Cores, guess: &Guess) -> bool {
    if guess.found.lower > Dd::ZERO
        && let Some(axis) = guess.axis(cores.a[0].len())
        && furthest(&cores.a, &axis).1 < least_far(&cores.b, &axis).1
    {
        return false;
    }
    let (mut from_a, mut from_b) = first_program(guess);
    loop {
        let of = |points: &[Point], chosen: &[usize]| -> Vec<Point> {
            chosen.iter().map(|&i| points[i].clone()).collect()
        };
        let Some(parting) = parting(&of(&cores.a, &from_a), &of(&cores.b, &from_b)) else { return true };
        let (i, on_a) = furthest(&cores.a, &parting.axis);
        let (j, on_b) = least_far(&cores.b, &parting.axis);
        if on_a < on_b {
            return false;
        }
        // At least one of them is new: the program separated those that it had.
        from_a.extend((on_a > parting.of_a).then_some(i));
        from_b.extend((on_b < parting.of_b).then_some(j));
    }
}

/// The points that span the guess, and those almost level with them along its axis.
fn first_program(guess: &Guess) -> (Vec<usize>, Vec<usize>) {
    let mut from_a: Vec<usize> = guess.found.corners.iter().map(|corner| corner[0]).collect();
    let mut from_b: Vec<usize> = guess.found.corners.iter().map(|corner| corner[1]).collect();
    if let Some(axis) = guess.found.axis.filter(|_| guess.found.corners.len() < 4) {
        let slack = 1e-12 * (guess.a.reach() + guess.b.reach());
        from_a.extend(guess.a.near_support(axis, slack).into_iter().take(4));
        from_b.extend(guess.b.near_support(-axis, slack).into_iter().take(4));
    }
    for chosen in [&mut from_a, &mut from_b] {
        chosen.sort_unstable();
        chosen.dedup();
    }
    (from_a, from_b)
}

/// Whether two hulls still overlap after any sufficiently small translation: whether the origin is in the interior of
/// the set of all differences.
///
/// It is, exactly when multiples of differences of points of the hulls reach in all directions; and they do when they
/// reach along the axes and along the direction opposite to their sum. Four small linear programs.
pub fn share_inside(cores: &Cores) -> bool {
    let dimension = cores.a[0].len();
    (0..=dimension).all(|k| {
        let goal: Point = (0..dimension).map(|i| BigInt::from(u8::from(k == dimension || i == k))).collect();
        // A goal must not be negative: for the last direction, everything is negated.
        let turn = |point: &Point, weight: i8| -> Point {
            let sign = BigInt::from(if k == dimension { -weight } else { weight });
            point.iter().map(|c| c * &sign).chain([BigInt::from(weight)]).collect()
        };
        let mut columns: Vec<Point> = cores.a.iter().map(|point| turn(point, 1)).collect();
        columns.extend(cores.b.iter().map(|point| turn(point, -1)));
        refutation(&columns, &[goal, vec![BigInt::ZERO]].concat()).is_none()
    })
}
