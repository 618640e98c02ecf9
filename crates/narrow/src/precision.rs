//! The error that goes with a separation: one place for the whole crate.
//!
//! Kernels propose an axis and evaluate it by full projection in f64. What separates the reported number from the
//! truth is, in metres:
//!
//! 1. rounding in f64: the terms of a projection are at most `reach`, the largest coordinate that entered, and each
//!    went through fewer than 64 roundings of 2^-53;
//! 2. the candidates left out: axes of nearly parallel edges, and the directional noise of those just above that
//!    limit, both below `SEPARATION_ERROR` of the pair's size (`docs/accuracy.md`);
//! 3. faces that are flat only up to the planarity error;
//! 4. the gap between the two certified bounds, where a distance was iterated;
//! 5. rounding the answer to f32: half an ulp.

use asunder_geometry::tolerance::SEPARATION_ERROR;

/// Everything about a pair that its error depends on, in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Precision {
    /// Sum of the cores' bounding radii; a half-space has none.
    pub(crate) size: f64,
    /// The largest coordinate that a projection can meet.
    pub(crate) reach: f64,
    /// Sum of the two planarity errors.
    pub(crate) planarity: f64,
}

impl Precision {
    /// Rounding of a projection in f64: below this, a sign means nothing.
    pub(crate) fn projection(&self) -> f64 {
        64.0 * (f64::EPSILON / 2.0) * self.reach
    }

    /// Error of a separation found by exhausting the candidate axes.
    pub(crate) fn of_separation(&self, separation: f64) -> f32 {
        self.rounded_up(SEPARATION_ERROR * self.size + 4.0 * self.planarity + self.projection(), separation)
    }

    /// Error of a distance known to lie in an interval of this length.
    pub(crate) fn of_distance(&self, distance: f64, gap: f64) -> f32 {
        // Bounds the wrong way round are rounding too.
        self.rounded_up(gap.abs() + 4.0 * self.projection(), distance)
    }

    fn rounded_up(&self, error: f64, value: f64) -> f32 {
        let half_ulp = value.abs() * f64::from(f32::EPSILON) / 2.0 + f64::from(f32::from_bits(1));
        ((error + half_ulp) as f32).next_up()
    }
}

/// A separation in f32 whose sign is the decision's: never positive for shapes that overlap, always for those that
/// do not.
pub(crate) fn signed(separation: f64, overlapping: bool) -> f32 {
    let rounded = separation as f32;
    if overlapping { rounded.min(0.0) } else { rounded.max(f32::from_bits(1)) }
}

/// A certified lower bound in f32.
pub(crate) fn at_least(separation: f64, precision: &Precision) -> f32 {
    rounded_down(separation - precision.projection())
}

/// The greatest f32 that is not above a bound.
pub(crate) fn rounded_down(bound: f64) -> f32 {
    let rounded = bound as f32;
    if f64::from(rounded) > bound { rounded.next_down() } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_is_the_decisions_also_where_rounding_disagrees() {
        assert_eq!(signed(1e-60, true), 0.0);
        assert!(signed(-1e-60, false) > 0.0);
        assert!(signed(1e-60, false) > 0.0, "underflow to zero would read as touching");
        assert_eq!(signed(-0.5, true), -0.5);
    }

    #[test]
    fn errors_grow_with_size_reach_and_value() {
        let small = Precision { size: 1.0, reach: 2.0, planarity: 0.0 };
        assert!(small.of_separation(0.0) < small.of_separation(100.0));
        assert!(small.of_separation(0.0) < Precision { size: 10.0, ..small }.of_separation(0.0));
        assert!(small.of_distance(1.0, 0.0) < Precision { reach: 1e9, ..small }.of_distance(1.0, 0.0));
    }
}
