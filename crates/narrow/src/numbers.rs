//! Seeded numbers for tests.

use asunder_geometry::glam::DVec3;
use oorandom::Rand64;

/// Seeded numbers.
pub(crate) struct Numbers(Rand64);

impl Numbers {
    pub(crate) fn new(seed: u128) -> Self {
        Self(Rand64::new(seed))
    }

    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.0.rand_range(0..end)
    }

    /// From -1 to 1.
    pub(crate) fn number(&mut self) -> f64 {
        2.0 * self.0.rand_float() - 1.0
    }

    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}
