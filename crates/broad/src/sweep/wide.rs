//! One kernel, compiled for any processor and once more for wider vectors.

use super::rows::{LANES, gaps_to_mask};

/// How wide vectors are. A value is the proof that the processor has them.
pub(crate) trait Width: Copy {
    /// Of sixteen gaps between boxes, which are none, and which are zero: see [`gaps_to_mask`].
    fn mask(self, gaps: &[i16; LANES]) -> u32;
}

/// What every processor has.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Width for Portable {
    #[inline(always)]
    fn mask(self, gaps: &[i16; LANES]) -> u32 {
        gaps_to_mask(gaps)
    }
}

/// Code that is worth compiling twice. Both give the same results in the same order.
pub(crate) trait Kernel {
    /// What it gives.
    type Output;
    /// Does the work. To be inlined always, or it is compiled once only.
    fn run<W: Width>(self, width: W) -> Self::Output;
}

/// Runs the kernel as wide as the processor can.
#[inline]
pub(crate) fn run<K: Kernel>(kernel: K) -> K::Output {
    #[cfg(target_arch = "x86_64")]
    if let Some(wide) = avx2::Avx2::detect() {
        return wide.run(kernel);
    }
    kernel.run(Portable)
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2 {
    use super::{Kernel, LANES, Width};
    use core::arch::x86_64::*;

    /// The processor has AVX2 and BMI1.
    #[derive(Clone, Copy, Debug)]
    pub(super) struct Avx2(());

    impl Avx2 {
        /// The only way to one.
        #[inline]
        pub(super) fn detect() -> Option<Self> {
            use std::arch::is_x86_feature_detected as has;
            (has!("avx2") && has!("bmi1")).then_some(Self(()))
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

    impl Width for Avx2 {
        #[inline(always)]
        fn mask(self, gaps: &[i16; LANES]) -> u32 {
            // SAFETY: this value says that the processor has AVX2.
            unsafe { mask(gaps) }
        }
    }

    /// Two comparisons, and the top bits of all lanes in one instruction; the loop over lanes takes twenty.
    #[target_feature(enable = "avx2")]
    #[inline]
    fn mask(gaps: &[i16; LANES]) -> u32 {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = *gaps;
        let gaps = _mm256_set_epi16(p, o, n, m, l, k, j, i, h, g, f, e, d, c, b, a);
        let zero = _mm256_setzero_si256();
        let bytes = _mm256_packs_epi16(_mm256_cmpgt_epi16(gaps, zero), _mm256_cmpeq_epi16(gaps, zero));
        _mm256_movemask_epi8(bytes) as u32 ^ 0x00ff_00ff
    }

    #[cfg(test)]
    mod tests {
        use super::super::{Portable, Width};
        use super::*;

        #[test]
        fn both_widths_give_the_same_mask() {
            let Some(wide) = Avx2::detect() else { return };
            let all = [i16::MIN, -32_767, -2, -1, 0, 1, 2, i16::MAX];
            let mut state = 1_u32;
            for _ in 0..20_000 {
                let gaps = [0; LANES].map(|_: i16| {
                    state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                    all[(state >> 24) as usize % all.len()]
                });
                assert_eq!(wide.mask(&gaps), Portable.mask(&gaps), "{gaps:?}");
            }
        }
    }
}
