//! `+`, `-`, `*`, order and conversions of [`Int`]; the arithmetic is in the module of the type.

use super::{INLINE, Int, limbs};
use core::cmp::Ordering;
use core::ops::{Add, AddAssign, Mul, Neg, Sub, SubAssign};

impl From<i64> for Int {
    #[inline]
    fn from(value: i64) -> Self {
        let mut int = Self::ZERO;
        int.inline[0] = value.unsigned_abs();
        int.len = usize::from(value != 0);
        int.negative = value < 0;
        int
    }
}

impl From<i128> for Int {
    #[inline]
    fn from(value: i128) -> Self {
        let mut int = Self::ZERO;
        let magnitude = value.unsigned_abs();
        int.inline[0] = magnitude as u64;
        int.inline[1] = (magnitude >> 64) as u64;
        int.negative = value < 0;
        int.trim(2);
        int
    }
}

impl Mul for &Int {
    type Output = Int;

    #[inline]
    fn mul(self, other: Self) -> Int {
        if self.len + other.len <= INLINE { self.product_inline(other) } else { self.product_long(other) }
    }
}

impl AddAssign<&Int> for Int {
    #[inline]
    fn add_assign(&mut self, other: &Int) {
        self.accumulate(other, other.negative);
    }
}

impl SubAssign<&Int> for Int {
    #[inline]
    fn sub_assign(&mut self, other: &Int) {
        self.accumulate(other, !other.negative);
    }
}

impl Add for &Int {
    type Output = Int;

    #[inline]
    fn add(self, other: Self) -> Int {
        self.sum(other, other.negative)
    }
}

impl Sub for &Int {
    type Output = Int;

    #[inline]
    fn sub(self, other: Self) -> Int {
        self.sum(other, !other.negative)
    }
}

impl Neg for Int {
    type Output = Int;

    #[inline]
    fn neg(mut self) -> Int {
        self.negative = !self.negative && self.len > 0;
        self
    }
}

impl Neg for &Int {
    type Output = Int;

    #[inline]
    fn neg(self) -> Int {
        -self.clone()
    }
}

impl PartialEq for Int {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.negative == other.negative && self.limbs() == other.limbs()
    }
}

impl Eq for Int {}

impl PartialOrd for Int {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Int {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        self.signum().cmp(&other.signum()).then_with(|| {
            let order = limbs::compare(self.limbs(), other.limbs());
            if self.negative { order.reverse() } else { order }
        })
    }
}
