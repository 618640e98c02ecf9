//! One kernel, compiled for the processor at hand.

/// Code that is worth compiling twice: for any processor, and for wider vectors.
///
/// Both give the same results in the same order. `run` must be inlined always, or it is compiled once only.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does the work. `WIDE` says that AVX2 is at hand.
    fn run<const WIDE: bool>(self) -> Self::Output;
}

/// Runs the kernel as wide as the processor can.
#[inline]
pub(crate) fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("bmi1") {
        #[allow(unsafe_code)]
        // SAFETY: the processor was just asked for both features, and they are all that `run_avx2` needs.
        return unsafe { run_avx2(kernel) };
    }
    kernel.run::<false>()
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1")]
fn run_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<true>()
}
