//! Mass properties as fractions of integers, from vertices alone: no rounding before the last division.

use asunder_geometry::{MassProperties2, MassProperties3};
use glam::{DMat3, DVec2, DVec3};
use num_bigint::{BigInt, Sign};

/// A quotient, correct to 2^-60.
fn quotient(numerator: &BigInt, denominator: &BigInt) -> f64 {
    let shift = 62 + denominator.bits() as i64 - numerator.bits() as i64;
    let shifted = |value: &BigInt, by: i64| if by > 0 { value << by as usize } else { value.clone() };
    let whole = shifted(numerator, shift) / shifted(denominator, -shift);
    let power_of_two = f64::from_bits(((1023 - shift) as u64) << 52);
    i64::try_from(whole).unwrap() as f64 * power_of_two
}

/// Sums over simplices between the origin and the surface, as integers.
struct Sums {
    volume: BigInt,
    first: Vec<BigInt>,
    second: Vec<Vec<BigInt>>,
}

impl Sums {
    fn new(dimension: usize) -> Self {
        let zero = || vec![BigInt::ZERO; dimension];
        Self { volume: BigInt::ZERO, first: zero(), second: (0..dimension).map(|_| zero()).collect() }
    }

    /// Adds the simplex between the origin and as many corners as there are dimensions; `size` is their determinant.
    fn add(&mut self, size: &BigInt, corners: &[Vec<BigInt>]) {
        let dimension = self.first.len();
        let sum: Vec<BigInt> = (0..dimension).map(|i| corners.iter().map(|c| &c[i]).sum()).collect();
        self.volume += size;
        for i in 0..dimension {
            self.first[i] += size * &sum[i];
            for j in 0..dimension {
                let product: BigInt = corners.iter().map(|c| &c[i] * &c[j]).sum();
                self.second[i][j] += size * (product + &sum[i] * &sum[j]);
            }
        }
    }

    /// Volume, centre, and central second moments. In n dimensions a simplex of determinant d has the volume d / n!,
    /// the first moment d s / (n + 1)! and the second moment d (sum of c c^T + s s^T) / (n + 2)!, where s is the sum of
    /// the corners.
    fn properties(&self) -> (f64, Vec<f64>, Vec<Vec<f64>>) {
        let n = self.first.len() as u64;
        let factorial = |k: u64| BigInt::from((1..=k).product::<u64>());
        let volume = quotient(&self.volume, &factorial(n));
        let center = self.first.iter().map(|f| quotient(f, &(&self.volume * (n + 1)))).collect();
        // second / (n + 2)! - (first / (n + 1)!)^2 n! / volume, over one denominator.
        let denominator = &self.volume * factorial(n + 2) * (n + 1);
        let entry = |i: usize, j: usize| {
            let numerator =
                &self.second[i][j] * &self.volume * (n + 1) - &self.first[i] * &self.first[j] * (n + 2);
            if numerator == BigInt::ZERO { 0.0 } else { quotient(&numerator, &denominator) }
        };
        let central = (0..n as usize).map(|i| (0..n as usize).map(|j| entry(i, j)).collect()).collect();
        (volume, center, central)
    }
}

fn integers(point: &[i64]) -> Vec<BigInt> {
    point.iter().map(|&value| BigInt::from(value)).collect()
}

fn determinant(a: &[BigInt], b: &[BigInt], c: &[BigInt]) -> BigInt {
    &a[0] * (&b[1] * &c[2] - &b[2] * &c[1])
        + &a[1] * (&b[2] * &c[0] - &b[0] * &c[2])
        + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0])
}

/// The hull of points in general position, of density 1. `None` if a facet contains four of them.
pub(super) fn solid(points: &[[i64; 3]]) -> Option<MassProperties3> {
    let at: Vec<Vec<BigInt>> = points.iter().map(|p| integers(p)).collect();
    let from = |origin: usize, i: usize| -> Vec<BigInt> {
        at[i].iter().zip(&at[origin]).map(|(one, other)| one - other).collect()
    };
    let mut sums = Sums::new(3);
    for (i, j, k) in triples(points.len()) {
        let (ij, ik) = (from(i, j), from(i, k));
        let sides: Vec<Sign> = (0..points.len())
            .filter(|&other| ![i, j, k].contains(&other))
            .map(|other| determinant(&ij, &ik, &from(i, other)).sign())
            .collect();
        match (sides.contains(&Sign::Plus), sides.contains(&Sign::Minus), sides.contains(&Sign::NoSign)) {
            (true, true, _) => {}
            (_, _, true) => return None,
            (false, _, _) => {
                sums.add(&determinant(&at[i], &at[j], &at[k]), &[at[i].clone(), at[j].clone(), at[k].clone()])
            }
            (true, _, _) => {
                sums.add(&determinant(&at[i], &at[k], &at[j]), &[at[i].clone(), at[k].clone(), at[j].clone()])
            }
        }
    }
    let (mass, center, c) = sums.properties();
    let inertia = DMat3::from_cols_array_2d(&[
        [c[1][1] + c[2][2], -c[0][1], -c[0][2]],
        [-c[0][1], c[2][2] + c[0][0], -c[1][2]],
        [-c[0][2], -c[1][2], c[0][0] + c[1][1]],
    ]);
    Some(MassProperties3 { mass, center: DVec3::from_slice(&center), inertia })
}

fn triples(count: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..count).flat_map(move |i| (i + 1..count).flat_map(move |j| (j + 1..count).map(move |k| (i, j, k))))
}

/// A counter-clockwise polygon of density 1.
pub(super) fn polygon(outline: &[[i64; 2]]) -> MassProperties2 {
    let mut sums = Sums::new(2);
    for (i, point) in outline.iter().enumerate() {
        let (a, b) = (integers(point), integers(&outline[(i + 1) % outline.len()]));
        sums.add(&(&a[0] * &b[1] - &a[1] * &b[0]), &[a, b]);
    }
    let (mass, center, central) = sums.properties();
    MassProperties2 { mass, center: DVec2::from_slice(&center), inertia: central[0][0] + central[1][1] }
}
