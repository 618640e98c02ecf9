//! Compares sixteen gaps between boxes at once, portable and for AVX2, into a bit mask of those that are not positive.

use super::rows::{LANES, gaps_to_mask};
use crate::width::Portable;

/// How a width compares sixteen gaps.
pub(crate) trait SixteenGaps {
    /// Which of them are not positive, and which are zero; [`gaps_to_mask`] is the definition.
    fn mask(self, gaps: &[i16; LANES]) -> u32;
}

impl SixteenGaps for Portable {
    #[inline(always)]
    fn mask(self, gaps: &[i16; LANES]) -> u32 {
        gaps_to_mask(gaps)
    }
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2 {
    use super::super::rows::MAY;
    use super::{LANES, SixteenGaps};
    use crate::width::Avx2;
    use core::arch::x86_64::*;

    impl SixteenGaps for Avx2 {
        #[inline(always)]
        fn mask(self, gaps: &[i16; LANES]) -> u32 {
            // SAFETY: this value proves that the processor has AVX2.
            unsafe { mask(gaps) }
        }
    }

    /// Two comparisons, then the top bits of all lanes in one instruction; the loop over lanes takes twenty.
    #[target_feature(enable = "avx2")]
    #[inline]
    fn mask(gaps: &[i16; LANES]) -> u32 {
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = *gaps;
        let gaps = _mm256_set_epi16(p, o, n, m, l, k, j, i, h, g, f, e, d, c, b, a);
        let zero = _mm256_setzero_si256();
        let bytes = _mm256_packs_epi16(_mm256_cmpgt_epi16(gaps, zero), _mm256_cmpeq_epi16(gaps, zero));
        _mm256_movemask_epi8(bytes) as u32 ^ MAY
    }

    #[cfg(test)]
    mod tests {
        use super::super::{Portable, SixteenGaps};
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
