//! Axes: from values to positions along an edge of a plot.

use libm::{exp10, floor, log10};

/// An axis: logarithmic, with a band of its own for zero on request, or linear from zero.
///
/// ```
/// use asunder_benches::report::axis::Axis;
/// let axis = Axis::new(&[0.02, 5.0], (0.0, 300.0));
/// assert_eq!((axis.at(0.01), axis.at(1.0), axis.at(10.0)), (0.0, 200.0, 300.0));
/// assert_eq!(axis.ticks(4), [0.01, 0.1, 1.0, 10.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// The powers of ten at both ends.
    decades: (i32, i32),
    /// The positions of both ends on the sheet.
    places: (f64, f64),
    /// Where zero is drawn.
    zero: Option<f64>,
    /// The value at the upper end of a linear axis.
    linear: Option<f64>,
}

impl Axis {
    /// An axis over the whole decades that hold all positive and finite values, between two places on the sheet.
    pub fn new(values: &[f64], places: (f64, f64)) -> Self {
        let positive = values.iter().copied().filter(|value| value.is_finite() && *value > 0.0);
        let (low, high) = positive.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        let decades = if high > 0.0 {
            let low = floor(log10(low)) as i32;
            // A value at the upper end needs no further decade.
            (low, (libm::ceil(log10(high)) as i32).max(low + 1))
        } else {
            (0, 1)
        };
        Self { decades, places, zero: None, linear: None }
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

    /// A linear axis from zero to the greatest value, or to 1.
    ///
    /// ```
    /// use asunder_benches::report::axis::Axis;
    /// let axis = Axis::linear(&[0.3, 2.0], (0.0, 100.0));
    /// assert_eq!((axis.at(0.0), axis.at(1.0), axis.at(2.0)), (0.0, 50.0, 100.0));
    /// assert_eq!(axis.ticks(5), [0.0, 0.5, 1.0, 1.5, 2.0]);
    /// ```
    pub fn linear(values: &[f64], places: (f64, f64)) -> Self {
        let high = values.iter().copied().filter(|value| value.is_finite()).fold(1.0, f64::max);
        Self { decades: (0, 1), places, zero: None, linear: Some(high) }
    }

    /// The position of a value. Zero is in its band, if there is one; values beyond an end are at that end.
    pub fn at(&self, value: f64) -> f64 {
        if let (Some(zero), true) = (self.zero, value == 0.0) {
            return zero;
        }
        let (low, high) = (f64::from(self.decades.0), f64::from(self.decades.1));
        let part = match self.linear {
            Some(most) => value / most,
            None => (log10(value.max(f64::MIN_POSITIVE)) - low) / (high - low),
        };
        self.places.0 + part.clamp(0.0, 1.0) * (self.places.1 - self.places.0)
    }

    /// The position of zero, and the end of its band.
    pub fn zero(&self) -> Option<(f64, f64)> {
        self.zero.map(|place| (place, self.places.0))
    }

    /// The values to be labelled: as many as fit, without one next to the label of zero.
    pub fn ticks(&self, most: usize) -> Vec<f64> {
        let lines = self.lines();
        let step = lines.len().div_ceil(most.max(2)).max(1);
        let last = lines.len() - 1;
        let is_shown = |i: usize| (last - i).is_multiple_of(step) && (i > 0 || self.zero.is_none());
        (0..lines.len()).filter(|&i| is_shown(i)).map(|i| lines[i]).collect()
    }

    /// Every power of ten on the axis; on a linear one, every half of the power of ten below its end.
    pub fn lines(&self) -> Vec<f64> {
        match self.linear {
            Some(most) => {
                // Half of the power of ten below the end: 2 to 20 steps.
                let step = 0.5 * exp10(floor(log10(most)));
                (0..=floor(most / step) as i32).map(|i| step * f64::from(i)).collect()
            }
            None => (self.decades.0..=self.decades.1).map(|decade| exp10(f64::from(decade))).collect(),
        }
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
            assert!((2..=6).contains(&axis.ticks(6).len()), "{values:?}: {:?}", axis.ticks(6));
        }
    }
}
