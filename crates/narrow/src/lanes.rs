//! Several numbers side by side: arrays whose operations LLVM turns into vector instructions, on any target.
//!
//! No intrinsics and no widths: a lane's arithmetic is that of a single number, in the order in which it is written, so
//! its bits are the same at every width. Values written to memory compile to vectors; those that stay in registers all
//! the way often compile to scalars.

use core::ops::{Add, Mul, Sub};

/// `N` numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub(crate) struct Lanes<const N: usize>(pub(crate) [f64; N]);

impl<const N: usize> Lanes<N> {
    pub(crate) const ZERO: Self = Self([0.0; N]);

    /// The same number in every lane.
    #[inline(always)]
    pub(crate) const fn all(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    pub(crate) fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Rounded to f32.
    #[inline(always)]
    pub(crate) fn rounded(self) -> Self {
        self.map(|lane| f64::from(lane as f32))
    }

    /// The lesser, lane by lane; if either is NaN, that of `other`.
    #[inline(always)]
    pub(crate) fn least(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    /// The greater, lane by lane; if either is NaN, that of `other`.
    #[inline(always)]
    pub(crate) fn greatest(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let mut out = self.0;
        for lane in &mut out {
            *lane = f(*lane);
        }
        Self(out)
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut out = self.0;
        for (lane, other) in out.iter_mut().zip(other.0) {
            *lane = f(*lane, other);
        }
        Self(out)
    }
}

impl<const N: usize> Add for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl<const N: usize> Sub for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl<const N: usize> Mul for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl<const N: usize> Mul<f64> for Lanes<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(|lane| lane * factor)
    }
}
