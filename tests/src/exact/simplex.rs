//! Linear programming over integers: some x >= 0 with `columns * x = goal`, or the proof that there is none.
//!
//! Phase one of the simplex method from artificial variables, by Bland's rule (1977), which cannot cycle on degenerate
//! touching cases. Pivots keep integers, as in Bareiss (1968): every division is exact. Only the artificial variables'
//! columns are carried along, and they never enter again; what is left below them at the end is the proof.

use super::place::{Point, dot, minus};
use num_bigint::{BigInt, Sign};

/// An axis and two levels on it: all of A lies at `of_a` or below, all of B at `of_b` or above, and `of_a < of_b`.
#[derive(Clone, Debug)]
pub struct Parting {
    /// From A to B, of any length.
    pub axis: Point,
    /// No point of A lies above.
    pub of_a: BigInt,
    /// No point of B lies below.
    pub of_b: BigInt,
}

/// Whether the convex hulls of two sets of integer points, of any one dimension, share a point.
pub fn hulls_share_point(a: &[Point], b: &[Point]) -> bool {
    parting(a, b).is_none()
}

/// What separates the convex hulls of two sets of integer points; `None` if they share a point: weights >= 0, summing
/// to 1 on each side, whose two weighted means are the same.
pub fn parting(a: &[Point], b: &[Point]) -> Option<Parting> {
    let (zero, one) = (BigInt::ZERO, BigInt::from(1));
    // Relative to the first point of A the numbers are as short as they can be.
    let origin = &a[0];
    let column = |point: &Point, of_a: bool| -> Point {
        let seen = if of_a { minus(point, origin) } else { minus(origin, point) };
        let weights = if of_a { [one.clone(), zero.clone()] } else { [zero.clone(), one.clone()] };
        seen.into_iter().chain(weights).collect()
    };
    let mut columns: Vec<Point> = a.iter().map(|point| column(point, true)).collect();
    columns.extend(b.iter().map(|point| column(point, false)));
    let mut goal = vec![zero; origin.len()];
    goal.extend([one.clone(), one]);
    let mut axis = refutation(&columns, &goal)?;
    // y.(a - o, 1, 0) <= 0, y.(o - b, 0, 1) <= 0 and y.(0, 1, 1) > 0.
    let levels = axis.split_off(origin.len());
    let at_origin: BigInt = dot(&axis, origin);
    Some(Parting { of_a: &at_origin - &levels[0], of_b: &at_origin + &levels[1], axis })
}

/// A y with y.column <= 0 for all columns and y.goal > 0, for a goal that is not negative; `None` if some x >= 0 solves
/// `columns * x = goal`. One or the other exists (Farkas, 1902).
pub fn refutation(columns: &[Point], goal: &[BigInt]) -> Option<Point> {
    let (width, height) = (columns.len(), goal.len());
    // What stands below the artificial columns and the right-hand side, over a common denominator; other columns are
    // computed only when needed (the revised method). The last row is the infeasibility, to be brought to zero, as a
    // sum of the others; the factor of each of them stands there.
    let unit = |row: usize| (0..height).map(move |i| BigInt::from(u8::from(i == row || row == height)));
    let sum = goal.iter().sum();
    let right_sides = goal.iter().chain([&sum]);
    let mut rows: Vec<Point> =
        right_sides.enumerate().map(|(row, right)| unit(row).chain([right.clone()]).collect()).collect();
    let mut basis: Vec<usize> = (width..width + height).collect();
    let mut denominator = BigInt::from(1);
    while rows[height][height].sign() == Sign::Plus {
        let multipliers = &rows[height][..height];
        let Some(entering) = columns.iter().position(|column| dot(multipliers, column).sign() == Sign::Plus)
        else {
            return Some(multipliers.to_vec());
        };
        let column: Point = rows.iter().map(|row| dot(&row[..height], &columns[entering])).collect();
        // The infeasibility cannot fall without bound, so some row bounds any variable that lowers it.
        let leaving = leaving_row(&rows, &column, &basis).expect("bounded");
        denominator = pivot(&mut rows, &column, leaving, &denominator);
        basis[leaving] = entering;
    }
    None
}

/// The row that bounds the entering variable first; ties to the least variable, as Bland's rule demands.
fn leaving_row(rows: &[Point], column: &[BigInt], basis: &[usize]) -> Option<usize> {
    let right = basis.len();
    let ratio_order = |&p: &usize, &q: &usize| {
        let left = &rows[p][right] * &column[q];
        left.cmp(&(&rows[q][right] * &column[p])).then(basis[p].cmp(&basis[q]))
    };
    (0..basis.len()).filter(|&row| column[row].sign() == Sign::Plus).min_by(ratio_order)
}

/// One step of fraction-free elimination; returns the new common denominator, which is positive.
fn pivot(rows: &mut [Point], column: &[BigInt], leaving: usize, denominator: &BigInt) -> BigInt {
    let pivot_row = rows[leaving].clone();
    let by = &column[leaving];
    for (index, (row, factor)) in
        rows.iter_mut().zip(column).enumerate().filter(|(index, _)| *index != leaving)
    {
        for (cell, across) in row.iter_mut().zip(&pivot_row) {
            let product = &*cell * by - factor * across;
            let quotient = &product / denominator;
            debug_assert_eq!(&quotient * denominator, product, "row {index}");
            *cell = quotient;
        }
    }
    by.clone()
}
