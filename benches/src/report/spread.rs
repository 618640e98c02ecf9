//! The noise of rows, and Pareto fronts.

use crate::clock::Spread;

/// Quartiles further apart than this share of the median are marked, in plots and in tables.
pub const WIDE: f64 = 0.2;

/// Whether the quartiles are further apart than [`WIDE`] of the median.
///
/// ```
/// use asunder_benches::report::spread::is_wide;
/// assert!(!is_wide(100.0, 95.0, 110.0));
/// assert!(is_wide(100.0, 95.0, 116.0));
/// assert!(is_wide(f64::NAN, 1.0, 2.0), "what is no number is not steady");
/// ```
pub fn is_wide(median: f64, low: f64, high: f64) -> bool {
    let is_steady = high - low <= WIDE * median;
    // A comparison with NaN is false, and must not count as steady.
    !is_steady
}

impl Spread {
    /// A median and its quartiles.
    pub const fn new(median: f64, low: f64, high: f64) -> Self {
        Self { low, median, high }
    }

    /// The same in other units.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.median * factor, self.low * factor, self.high * factor)
    }

    /// Whether it is to be marked: see [`is_wide`].
    pub fn is_wide(self) -> bool {
        is_wide(self.median, self.low, self.high)
    }
}

/// The Pareto front: the points that no other point dominates, where less is better in both coordinates. Indices in
/// order of the first coordinate, then of the second. Points with a NaN are left out.
///
/// ```
/// use asunder_benches::report::spread::pareto_front;
/// let points = [(3.0, 1.0), (1.0, 3.0), (2.0, 2.0), (3.0, 3.0), (1.0, 4.0), (0.0, f64::NAN)];
/// assert_eq!(pareto_front(&points), [1, 2, 0]);
/// ```
pub fn pareto_front(points: &[(f64, f64)]) -> Vec<usize> {
    let known = |&(x, y): &(f64, f64)| !x.is_nan() && !y.is_nan();
    let beats = |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && a != b;
    let mut front: Vec<usize> = (0..points.len())
        .filter(|&i| known(&points[i]) && !points.iter().any(|other| beats(other, &points[i])))
        .collect();
    front.sort_by(|&i, &j| {
        let (a, b) = (points[i], points[j]);
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(i.cmp(&j))
    });
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_front_holds_ties_once_each_and_nobody_who_is_beaten_in_one() {
        assert_eq!(pareto_front(&[(1.0, 1.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)]), [0, 1]);
        assert_eq!(pareto_front(&[]), [] as [usize; 0]);
    }

    #[test]
    fn whoever_is_not_on_the_front_is_beaten_by_somebody_on_it() {
        let mut random = asunder_scenes::random::Random::new(5);
        let points: Vec<(f64, f64)> = (0..200)
            .map(|_| ((random.range(0.0, 20.0)).floor(), (random.range(0.0, 20.0)).floor()))
            .collect();
        let front = pareto_front(&points);
        for (i, point) in points.iter().enumerate() {
            let beaten = front
                .iter()
                .any(|&j| points[j].0 <= point.0 && points[j].1 <= point.1 && points[j] != *point);
            assert_ne!(front.contains(&i), beaten, "{point:?}");
        }
    }
}
