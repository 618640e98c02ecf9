//! The only source of randomness of all scenes.

use crate::turn::Turn;
use glam::{DVec3, Quat};
use oorandom::Rand64;

/// A seeded generator of numbers, directions and rotations. Each draw costs some nanoseconds.
///
/// ```
/// use asunder_scenes::random::Random;
/// let (mut one, mut other) = (Random::new(7), Random::new(7));
/// assert_eq!(one.range(-2.0, 3.0), other.range(-2.0, 3.0));
/// assert_eq!(one.below(10), other.below(10));
/// assert!(one.unit() < 1.0);
/// assert!((one.direction().length() - 1.0).abs() < 1e-12);
/// assert!((one.rotation().length() - 1.0).abs() < 1e-6);
/// ```
#[derive(Clone, Debug)]
pub struct Random {
    numbers: Rand64,
}

impl Random {
    /// A generator whose draws depend on the seed alone.
    pub fn new(seed: u64) -> Self {
        Self { numbers: Rand64::new(u128::from(seed)) }
    }

    /// Uniform in `0.0..1.0`.
    pub fn unit(&mut self) -> f64 {
        self.numbers.rand_float()
    }

    /// Uniform in `low..high`.
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Log-uniform in `low..high`, both above zero: every octave as likely as any other.
    pub fn log_range(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.range(libm::log(low), libm::log(high)))
    }

    /// Uniform among `0..count`; 0 if `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// Uniform in the box between two corners.
    pub fn within(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        DVec3::new(self.range(low.x, high.x), self.range(low.y, high.y), self.range(low.z, high.z))
    }

    /// Uniform on the unit sphere, by rejection, without trigonometry.
    pub fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.within(DVec3::NEG_ONE, DVec3::ONE);
            let square = v.dot(v);
            if (0.01..=1.0).contains(&square) {
                return v / square.sqrt();
            }
        }
    }

    /// A uniformly random rotation.
    pub fn rotation(&mut self) -> Quat {
        self.turn().to_quat()
    }

    /// As [`Random::rotation`], in f64.
    pub(crate) fn turn(&mut self) -> Turn {
        loop {
            let [x, y, z, w] = [(); 4].map(|()| self.range(-1.0, 1.0));
            let square = x * x + y * y + z * z + w * w;
            if (0.01..=1.0).contains(&square) {
                let length = square.sqrt();
                return Turn { v: DVec3::new(x, y, z) / length, w: w / length };
            }
        }
    }
}
