//! Symmetric tensors of second moments, and the one product that must not cancel.

use crate::product::product_difference;
use glam::{DMat3, DVec3};

/// A symmetric tensor of second moments: xx, yy, zz, and the mixed ones.
///
/// The tensor of a body about its centre is the integral of x x^T over its mass. It keeps small moments of thin shapes
/// exact, which could not be recovered from the inertia, whose entries are sums of two of these.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Second {
    /// xx, yy, zz.
    pub(super) squares: DVec3,
    /// yz, zx, xy.
    pub(super) products: DVec3,
}

impl Second {
    /// `v v^T`.
    pub(super) fn of(v: DVec3) -> Self {
        Self { squares: v * v, products: DVec3::new(v.y * v.z, v.z * v.x, v.x * v.y) }
    }

    /// `a b^T + b a^T`.
    pub(super) fn pair(a: DVec3, b: DVec3) -> Self {
        let products = DVec3::new(a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x);
        Self { squares: a * b * 2.0, products }
    }

    /// `value` times the unit tensor.
    pub(super) fn round(value: f64) -> Self {
        Self { squares: DVec3::splat(value), products: DVec3::ZERO }
    }

    /// The inertia of the same mass: the trace times the unit tensor, minus this.
    pub(super) fn inertia(&self) -> DMat3 {
        let s = self.squares;
        // A difference instead of a negation, which would print zero as "-0".
        let mixed = DVec3::ZERO - self.products;
        DMat3::from_cols(
            DVec3::new(s.y + s.z, mixed.z, mixed.y),
            DVec3::new(mixed.z, s.z + s.x, mixed.x),
            DVec3::new(mixed.y, mixed.x, s.x + s.y),
        )
    }
}

impl core::ops::Add for Second {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { squares: self.squares + other.squares, products: self.products + other.products }
    }
}

impl core::ops::AddAssign for Second {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl core::ops::Mul<f64> for Second {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { squares: self.squares * factor, products: self.products * factor }
    }
}

/// The cross product, every component right to a few units in its own last place: two long edges of a needle span an
/// area far smaller than the products of which it is the difference.
pub(super) fn cross(a: DVec3, b: DVec3) -> DVec3 {
    DVec3::new(
        product_difference(a.y, b.z, a.z, b.y),
        product_difference(a.z, b.x, a.x, b.z),
        product_difference(a.x, b.y, a.y, b.x),
    )
}
