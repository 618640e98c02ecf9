//! Whether two shapes share a point, decided exactly: linear programming over integers.
//!
//! ```text
//! points  = stored vertices, turned and moved exactly: M(q)/|q|^2 and f64 positions are rational; one positive
//!           factor clears every denominator
//! overlap = weights >= 0, summing to 1 on each side, whose two weighted means are the same point
//! simplex = phase one from artificial variables, Bland's rule (1977), which cannot cycle on degenerate
//!           touching cases; pivots keep integers, as in Bareiss (1968): every division is exact
//! ```
//! It knows no axes, no faces and no tolerance, and shares no idea with the separating axis test.

use crate::integers::common_integers;
use crate::placed::stored_vertices2;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use glam::Vec3;
use num_bigint::{BigInt, Sign};

/// Whether two posed solids share a point. Closed sets: touching counts.
pub fn exact_overlap3(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> bool {
    let stored = [stored_vertices3(a.0), stored_vertices3(b.0)];
    let poses = [a.1, b.1];
    // One power of two for all lengths, so that vertices and positions stay comparable.
    let mut lengths: Vec<f64> = stored.iter().flatten().flat_map(|v| v.as_dvec3().to_array()).collect();
    lengths.extend(poses.iter().flat_map(|pose| pose.position().to_array()));
    let lengths = common_integers(&lengths);
    let positions = &lengths[lengths.len() - 6..];
    let rotations = poses.map(|pose| common_integers(&pose.rotation().to_array().map(f64::from)));
    let norms = [0, 1].map(|i| rotations[i].iter().map(|c| c * c).sum::<BigInt>());
    let both_norms = &norms[0] * &norms[1];
    let mut triples = lengths.chunks_exact(3);
    let points = [0, 1].map(|body| {
        let place = |v: &[BigInt]| -> Vec<BigInt> {
            let turned = turned_by_quaternion(&rotations[body], v);
            let other_norm = &norms[1 - body];
            let at = &positions[3 * body..3 * body + 3];
            turned.iter().zip(at).map(|(t, p)| t * other_norm + p * &both_norms).collect()
        };
        triples.by_ref().take(stored[body].len()).map(place).collect::<Vec<_>>()
    });
    hulls_share_point(&points[0], &points[1])
}

/// Whether two posed shapes in the plane share a point. Closed sets: touching counts.
pub fn exact_overlap2(a: (&Shape2, &Pose2), b: (&Shape2, &Pose2)) -> bool {
    let stored = [stored_vertices2(a.0), stored_vertices2(b.0)];
    let poses = [a.1, b.1];
    let mut lengths: Vec<f64> = stored.iter().flatten().flat_map(|v| v.as_dvec2().to_array()).collect();
    lengths.extend(poses.iter().flat_map(|pose| pose.position().to_array()));
    let lengths = common_integers(&lengths);
    let positions = &lengths[lengths.len() - 4..];
    // The stored matrix is meant as it stands, so its unit is kept beside the entries.
    let matrices = poses.map(|pose| [pose.rotation().cos(), pose.rotation().sin()].map(f64::from));
    let entries = common_integers(&[matrices[0][0], matrices[0][1], matrices[1][0], matrices[1][1], 1.0]);
    let mut doubles = lengths.chunks_exact(2);
    let points = [0, 1].map(|body| {
        let (c, s) = (&entries[2 * body], &entries[2 * body + 1]);
        let at = [&positions[2 * body] * &entries[4], &positions[2 * body + 1] * &entries[4]];
        let place = |v: &[BigInt]| vec![c * &v[0] - s * &v[1] + &at[0], s * &v[0] + c * &v[1] + &at[1]];
        doubles.by_ref().take(stored[body].len()).map(place).collect::<Vec<_>>()
    });
    hulls_share_point(&points[0], &points[1])
}

/// Whether the convex hulls of two sets of integer points, of any one dimension, share a point.
pub fn hulls_share_point(a: &[Vec<BigInt>], b: &[Vec<BigInt>]) -> bool {
    let (zero, one) = (BigInt::ZERO, BigInt::from(1));
    // Seen from the first point of A the numbers are as short as they can be.
    let origin = &a[0];
    let column = |point: &Vec<BigInt>, of_a: bool| -> Vec<BigInt> {
        let seen = point.iter().zip(origin).map(|(p, o)| if of_a { p - o } else { o - p });
        let weights = if of_a { [one.clone(), zero.clone()] } else { [zero.clone(), one.clone()] };
        seen.chain(weights).collect()
    };
    let mut columns: Vec<Vec<BigInt>> = a.iter().map(|point| column(point, true)).collect();
    columns.extend(b.iter().map(|point| column(point, false)));
    let mut goal = vec![zero; origin.len()];
    goal.extend([one.clone(), one]);
    has_nonnegative_solution(&columns, &goal)
}

/// Whether some x >= 0 solves `columns * x = goal`, for a goal that is not negative.
fn has_nonnegative_solution(columns: &[Vec<BigInt>], goal: &[BigInt]) -> bool {
    let (width, height) = (columns.len(), goal.len());
    // Rows over a common denominator, the right side last; below them the infeasibility, to be brought to zero. The
    // artificial variables have no columns of their own: one that has left never comes back.
    let mut rows: Vec<Vec<BigInt>> = (0..height)
        .map(|row| columns.iter().map(|column| column[row].clone()).chain([goal[row].clone()]).collect())
        .collect();
    rows.push((0..=width).map(|j| rows.iter().map(|row| &row[j]).sum()).collect());
    let mut basis: Vec<usize> = (width..width + height).collect();
    let mut denominator = BigInt::from(1);
    while rows[height][width].sign() == Sign::Plus {
        let Some(entering) = (0..width).find(|&j| rows[height][j].sign() == Sign::Plus) else { return false };
        let Some(leaving) = leaving_row(&rows, &basis, entering) else { return false };
        denominator = pivot(&mut rows, leaving, entering, &denominator);
        basis[leaving] = entering;
    }
    true
}

/// The row that bounds the entering variable first; ties to the least variable, as Bland's rule demands.
fn leaving_row(rows: &[Vec<BigInt>], basis: &[usize], entering: usize) -> Option<usize> {
    let right = rows[0].len() - 1;
    let ratio_order = |&p: &usize, &q: &usize| {
        let left = &rows[p][right] * &rows[q][entering];
        left.cmp(&(&rows[q][right] * &rows[p][entering])).then(basis[p].cmp(&basis[q]))
    };
    (0..basis.len()).filter(|&row| rows[row][entering].sign() == Sign::Plus).min_by(ratio_order)
}

/// One step of fraction-free elimination; returns the new common denominator, which is positive.
fn pivot(rows: &mut [Vec<BigInt>], leaving: usize, entering: usize, denominator: &BigInt) -> BigInt {
    let pivot_row = rows[leaving].clone();
    let by = &pivot_row[entering];
    for (index, row) in rows.iter_mut().enumerate().filter(|(index, _)| *index != leaving) {
        let factor = row[entering].clone();
        for (j, (cell, across)) in row.iter_mut().zip(&pivot_row).enumerate() {
            let product = &*cell * by - &factor * across;
            debug_assert_eq!(&product % denominator, BigInt::ZERO, "row {index}, column {j}");
            *cell = product / denominator;
        }
    }
    by.clone()
}

fn stored_vertices3(shape: &Shape3) -> Vec<Vec3> {
    shape.core().vertices().to_vec()
}

/// M(q) times a vector, for integers: |q|^2 times as long as the turned vector.
fn turned_by_quaternion(q: &[BigInt], v: &[BigInt]) -> Vec<BigInt> {
    let (u, w) = (&q[..3], &q[3]);
    let dot: BigInt = u.iter().zip(v).map(|(a, b)| a * b).sum();
    let along = w * w - u.iter().map(|c| c * c).sum::<BigInt>();
    (0..3)
        .map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let cross = &u[j] * &v[k] - &u[k] * &v[j];
            &along * &v[i] + BigInt::from(2) * (&dot * &u[i] + w * cross)
        })
        .collect()
}
