//! Compiles kernels twice: for any processor, and for wider vectors.

use crate::index::wide::EightBoxes;
use crate::sweep::wide::SixteenGaps;

/// A vector width. A value of such a type proves that the processor has it.
pub(crate) trait Width: Copy + SixteenGaps + EightBoxes {}

/// For every processor: loops over lanes, which the compiler turns into vectors of the width it may assume.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Width for Portable {}

/// Code that is worth compiling twice. Both versions give the same results in the same order.
pub(crate) trait Kernel {
    /// The result.
    type Output;
    /// Does the work. Must be `#[inline(always)]`, or it is compiled only once.
    fn run<W: Width>(self, width: W) -> Self::Output;
}

/// Runs the kernel at the widest width that the processor has.
#[inline(always)]
pub(crate) fn widest<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = Avx2::detect() {
        return wide.run(kernel);
    }
    kernel.run(Portable)
}

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2 {
    use super::{Kernel, Width};

    /// The processor has AVX2 and BMI1.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Avx2(());

    impl Width for Avx2 {}

    impl Avx2 {
        /// The only way to get a value. Always `None` with the feature `portable`.
        #[inline]
        pub(crate) fn detect() -> Option<Self> {
            use std::arch::is_x86_feature_detected as has;
            (!cfg!(feature = "portable") && has!("avx2") && has!("bmi1")).then_some(Self(()))
        }

        #[inline]
        pub(super) fn run<K: Kernel>(self, kernel: K) -> K::Output {
            // SAFETY: this value proves that the processor has both features, and `run_wide` needs no others.
            unsafe { run_wide(kernel, self) }
        }
    }

    #[target_feature(enable = "avx2,bmi1")]
    fn run_wide<K: Kernel>(kernel: K, width: Avx2) -> K::Output {
        kernel.run(width)
    }
}
