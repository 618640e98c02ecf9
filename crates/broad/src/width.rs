//! One kernel, compiled for any processor and once more for wider vectors.

use crate::index::wide::EightBoxes;
use crate::sweep::wide::SixteenGaps;

/// How wide vectors are. A value is the proof that the processor has them.
pub(crate) trait Width: Copy + SixteenGaps + EightBoxes {}

/// What every processor has: loops over lanes, as vectors of whatever width the compiler may count on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Width for Portable {}

/// Code that is worth compiling twice. Both give the same results in the same order.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does the work. To be inlined always, or it is compiled once only.
    fn run<W: Width>(self, width: W) -> Self::Output;
}

/// Runs the kernel as wide as the processor can.
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
        /// The only way to one. None with the feature `portable`.
        #[inline]
        pub(crate) fn detect() -> Option<Self> {
            use std::arch::is_x86_feature_detected as has;
            (!cfg!(feature = "portable") && has!("avx2") && has!("bmi1")).then_some(Self(()))
        }

        #[inline]
        pub(super) fn run<K: Kernel>(self, kernel: K) -> K::Output {
            // SAFETY: this value says that the processor has both features, and they are all that `run_wide` needs.
            unsafe { run_wide(kernel, self) }
        }
    }

    #[target_feature(enable = "avx2,bmi1")]
    fn run_wide<K: Kernel>(kernel: K, width: Avx2) -> K::Output {
        kernel.run(width)
    }
}
