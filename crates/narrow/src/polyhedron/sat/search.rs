//! What a caller asks of the separating axis test, and the tolerances that follow from it.

use crate::precision::Precision;

/// What is asked of the test.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Search<'a> {
    /// A separation that is certain: axes that show less by more than [`Search::keep`] are left out.
    pub(crate) known: f64,
    /// The separation along an axis from which a walk did not succeed, last frame's or a face's: no walk starts from a
    /// face that shows no more.
    pub(crate) unproved: f64,
    /// How far two edges may lie off the supporting planes of their own axis.
    pub(crate) slack: f64,
    pub(crate) precision: &'a Precision,
}

impl Search<'_> {
    /// By how much an axis may fall short of the best and still be kept, since a contact may be built on it.
    pub(super) fn keep(&self) -> f64 {
        4.0 * (self.slack + self.precision.projection())
    }

    /// By how much an edge pair may beat the best face and still count as even with it: nothing next to the rounding of
    /// the answer to f32.
    ///
    /// Where the edges' arcs end at the same normal, or the edges are parallel, as between two prisms, every pair has
    /// the axis of a face up to rounding: tested one by one, two prisms of 128 sides in one place took 14 ms.
    pub(super) fn even(&self, best: f64) -> f64 {
        64.0 * self.precision.projection() + best.abs() * f64::from(f32::EPSILON) / 128.0
    }
}
