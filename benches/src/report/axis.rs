//! From values to places along an edge of a plot.

use libm::{exp10, floor, log10};

/// A logarithmic axis, with an own band for zero where it is asked for.
///
/// ```
/// use asunder_benches::report::axis::Axis;
/// let axis = Axis::new(&[0.02, 5.0], (0.0, 300.0));
/// assert_eq!((axis.at(0.01), axis.at(1.0), axis.at(10.0)), (0.0, 200.0, 300.0));
/// assert_eq!(axis.ticks(4), [-2, -1, 0, 1]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Powers of ten at both ends.
    decades: (i32, i32),
    /// Their places on the sheet.
    places: (f64, f64),
    /// Where zero is drawn.
    zero: Option<f64>,
}

impl Axis {
    /// An axis over the whole decades that hold all positive and finite values, between two places on the sheet.
    pub fn new(values: &[f64], places: (f64, f64)) -> Self {
        let positive = values.iter().copied().filter(|value| value.is_finite() && *value > 0.0);
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        let decades = if high > 0.0 {
            let low = floor(log10(low)) as i32;
            // A value on the upper end needs no decade of its own.
            (low, (libm::ceil(log10(high)) as i32).max(low + 1))
        } else {
            (0, 1)
        };
        Self { decades, places, zero: None }
    }

    /// The same with a band for zero, `width` wide, at the low end.
    #[must_use]
    pub fn with_zero(mut self, width: f64) -> Self {
        let (from, to) = self.places;
        let width = if to < from { -width } else { width };
        self.zero = Some(from + 0.5 * width);
        self.places.0 = from + width;
        self
    }

    /// The same within these values and no wider; for scales that do not begin with a power of ten.
    ///
    /// ```
    /// use asunder_benches::report::axis::Axis;
    /// let axis = Axis::new(&[1.0], (0.0, 100.0)).spanning(3, 5);
    /// assert_eq!((axis.at(1e3), axis.at(1e5)), (0.0, 100.0));
    /// ```
    #[must_use]
    pub fn spanning(mut self, low: i32, high: i32) -> Self {
        self.decades = (low, high.max(low + 1));
        self
    }

    /// The place of a value. Zero has its band, where there is one; what is beyond an end is at that end.
    pub fn at(&self, value: f64) -> f64 {
        if let (Some(zero), true) = (self.zero, value == 0.0) {
            return zero;
        }
        let (low, high) = (f64::from(self.decades.0), f64::from(self.decades.1));
        let part = ((log10(value.max(f64::MIN_POSITIVE)) - low) / (high - low)).clamp(0.0, 1.0);
        self.places.0 + part * (self.places.1 - self.places.0)
    }

    /// Where the band of zero lies, and where it ends.
    pub fn zero(&self) -> Option<(f64, f64)> {
        self.zero.map(|place| (place, self.places.0))
    }

    /// The decades to be labelled: all, or as many as fit.
    pub fn ticks(&self, most: usize) -> Vec<i32> {
        let (low, high) = self.decades;
        let count = (high - low) as usize + 1;
        let step = count.div_ceil(most.max(2)).max(1) as i32;
        (low..=high).filter(|decade| (high - decade) % step == 0).collect()
    }

    /// Every power of ten on the axis.
    pub fn decades(&self) -> impl Iterator<Item = i32> {
        self.decades.0..=self.decades.1
    }

    /// A power of ten.
    pub fn power(decade: i32) -> f64 {
        exp10(f64::from(decade))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_has_a_place_of_its_own_below_all_that_is_positive() {
        let axis = Axis::new(&[1e-9, 0.0, 1e-3], (100.0, 400.0)).with_zero(40.0);
        assert_eq!(axis.at(0.0), 120.0);
        assert_eq!(axis.at(1e-9), 140.0);
        assert_eq!(axis.at(1e-3), 400.0);
        let up = Axis::new(&[10.0, 1000.0], (300.0, 0.0)).with_zero(30.0);
        assert_eq!((up.at(0.0), up.at(10.0), up.at(1000.0)), (285.0, 270.0, 0.0));
    }

    #[test]
    fn whatever_the_values_are_there_is_an_axis() {
        for values in [&[][..], &[0.0], &[f64::NAN, f64::INFINITY], &[1.0], &[f64::MIN_POSITIVE, f64::MAX]] {
            let axis = Axis::new(values, (0.0, 100.0));
            for value in [0.0, 1.0, f64::MAX, f64::INFINITY, 1e-320] {
                assert!((0.0..=100.0).contains(&axis.at(value)), "{values:?}: {value} at {}", axis.at(value));
            }
            assert!((2..=7).contains(&axis.ticks(6).len()), "{values:?}: {:?}", axis.ticks(6));
        }
    }
}
