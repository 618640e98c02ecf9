//! Double-double numbers: an unevaluated sum of two f64, about 106 bits.
//!
//! Sums and products of two f64 are split into a result and its exact rounding error (Dekker, "A floating-point
//! technique for extending the available precision", 1971; Knuth's two-sum); no fused operations. Every operation here
//! has a relative error below 2^-102, as long as nothing comes near the limits of f64's exponent
//! (`tests/suite/oracles.rs` compares them with big integers).

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::DVec3;

/// A number as the sum of two f64, the second at most half a unit in the last place of the first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dd {
    high: f64,
    low: f64,
}

/// Three double-doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dd3 {
    /// First coordinate.
    pub x: Dd,
    /// Second coordinate.
    pub y: Dd,
    /// Third coordinate: zero in the plane.
    pub z: Dd,
}

/// A sum and its rounding error.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// As [`two_sum`], where `a` is the larger.
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// The upper and the lower half of a significand.
fn split(a: f64) -> (f64, f64) {
    let scaled = a * 134_217_729.0;
    let high = scaled - (scaled - a);
    (high, a - high)
}

/// A product and its rounding error.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a, a_low), (b, b_low)) = (split(a), split(b));
    (product, ((a * b - product) + a * b_low + a_low * b) + a_low * b_low)
}

impl Dd {
    /// Zero.
    pub const ZERO: Self = Self { high: 0.0, low: 0.0 };

    /// The exact difference of two f64.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        Self { high, low }
    }

    /// The sum of two f64, exactly.
    pub fn sum(a: f64, b: f64) -> Self {
        Self::difference(a, -b)
    }

    /// The nearest f64.
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// Both parts, the larger first.
    pub fn parts(self) -> [f64; 2] {
        [self.high, self.low]
    }

    /// The square root; zero for a negative number.
    pub fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        // One Newton step from the f64 root doubles its digits.
        let root = Self::from(self.high.sqrt());
        root + (self - root * root) / (root + root)
    }

    /// The magnitude.
    pub fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The larger of two.
    pub fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The smaller of two.
    pub fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
}

impl From<f64> for Dd {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl From<f32> for Dd {
    fn from(value: f32) -> Self {
        Self::from(f64::from(value))
    }
}

impl PartialOrd for Dd {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        let high = self.high.partial_cmp(&other.high)?;
        Some(high.then(self.low.partial_cmp(&other.low)?))
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let (high, error) = quick_two_sum(high, error + low);
        let (high, low) = quick_two_sum(high, error + rest);
        Self { high, low }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        let (high, low) = quick_two_sum(high, error + (self.high * other.low + self.low * other.high));
        Self { high, low }
    }
}

impl Div for Dd {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        // Long division, three digits of 53 bits.
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let third = rest.high / other.high;
        let (high, low) = quick_two_sum(first, second);
        Self { high, low } + Self::from(third)
    }
}

impl Dd3 {
    /// Three zeros.
    pub const ZERO: Self = Self { x: Dd::ZERO, y: Dd::ZERO, z: Dd::ZERO };

    /// From coordinates.
    pub fn new(x: impl Into<Dd>, y: impl Into<Dd>, z: impl Into<Dd>) -> Self {
        Self { x: x.into(), y: y.into(), z: z.into() }
    }

    /// The difference of two f64 vectors, exactly.
    pub fn difference(a: DVec3, b: DVec3) -> Self {
        Self { x: Dd::difference(a.x, b.x), y: Dd::difference(a.y, b.y), z: Dd::difference(a.z, b.z) }
    }

    /// The dot product.
    pub fn dot(self, other: Self) -> Dd {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The cross product.
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// The length. Vectors shorter than 1e-140 lose digits.
    pub fn length(self) -> Dd {
        self.dot(self).sqrt()
    }

    /// The vector at unit length; `None` for zero.
    pub fn try_normalize(self) -> Option<Self> {
        // Scaled near one first, by a power of two: squares of short vectors would underflow.
        let largest = self.to_f64().abs().max_element();
        if largest == 0.0 {
            return None;
        }
        let exponent = (largest.to_bits() >> 52 & 0x7FF).clamp(1, 2045);
        let near_one = self * Dd::from(f64::from_bits((2046 - exponent) << 52));
        let length = near_one.length();
        (length > Dd::ZERO).then(|| near_one / length)
    }

    /// The nearest f64 vector.
    pub fn to_f64(self) -> DVec3 {
        DVec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }
}

impl From<DVec3> for Dd3 {
    fn from(v: DVec3) -> Self {
        Self::new(v.x, v.y, v.z)
    }
}

impl Add for Dd3 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl Sub for Dd3 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl Neg for Dd3 {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl Mul<Dd> for Dd3 {
    type Output = Self;
    fn mul(self, by: Dd) -> Self {
        Self { x: self.x * by, y: self.y * by, z: self.z * by }
    }
}

impl Div<Dd> for Dd3 {
    type Output = Self;
    fn div(self, by: Dd) -> Self {
        Self { x: self.x / by, y: self.y / by, z: self.z / by }
    }
}
