//! Bounds of boxes, quantised to 16 bits.

/// The codes of one box: minima on the three axes, then maxima.
pub(crate) type Codes = [i16; 6];

/// The gap between two boxes on an axis, given the least and greatest code of each: below zero they overlap there, at
/// zero codes leave it undecided.
#[inline(always)]
pub(crate) const fn gap(one: [i16; 2], other: [i16; 2]) -> i16 {
    let (before, behind) = (one[0].saturating_sub(other[1]), other[0].saturating_sub(one[1]));
    if before > behind { before } else { behind }
}

/// A box in a column: 16 bytes, so that four fit a cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(16))]
pub(crate) struct Entry {
    pub(crate) codes: Codes,
    /// Place of the box in the list that is swept.
    pub(crate) place: u32,
}

/// Adding this to a number below 2^21 leaves its nearest whole number in the low bits of the mantissa.
const ROUNDS_TO_WHOLE: f32 = 12_582_912.0;

/// The greatest code; the least is its negative.
const LAST: f32 = 32_767.0;

/// Maps coordinates to codes on three axes, monotonically: a coordinate that is not less has no lesser code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantiser {
    middle: [f32; 8],
    scale: [f32; 8],
}

impl Quantiser {
    /// Spreads the codes over the given intervals; anything outside is clamped to the codes at the ends.
    ///
    /// An interval may have no width, or as much as f32 allows. The middle stays finite, and the scale finite and
    /// positive, so that no infinite coordinate becomes NaN.
    pub(crate) fn over(intervals: [(f32, f32); 3]) -> Self {
        let [mut middle, mut scale] = [[0.0; 8]; 2];
        for (axis, (low, high)) in intervals.into_iter().enumerate() {
            let width = f64::from(high) - f64::from(low);
            let per_metre = (2.0 * f64::from(LAST) / width).clamp(1e-36, 1e38) as f32;
            for place in [axis, axis + 3] {
                middle[place] = low * 0.5 + high * 0.5;
                scale[place] = per_metre;
            }
        }
        Self { middle, scale }
    }

    /// Codes per metre on an axis.
    pub(crate) fn per_metre(&self, axis: usize) -> f64 {
        f64::from(self.scale[axis])
    }

    /// The least coordinate on an axis whose code has this rank, in metres; for a rank behind the last, where the codes
    /// end.
    pub(crate) fn least(&self, axis: usize, rank: u32) -> f32 {
        let code = (f64::from(rank) - 32_768.5).clamp(-f64::from(LAST), f64::from(LAST));
        (f64::from(self.middle[axis]) + code / f64::from(self.scale[axis])) as f32
    }

    /// The codes of a box without NaN; with NaN, arbitrary codes.
    #[inline(always)]
    pub(crate) fn codes(&self, low: [f32; 3], high: [f32; 3]) -> Codes {
        let sides = [low[0], low[1], low[2], high[0], high[1], high[2], 0.0, 0.0];
        let mut codes = [0; 8];
        for place in 0..8 {
            let scaled = (sides[place] - self.middle[place]) * self.scale[place];
            let scaled = if scaled > -LAST { scaled } else { -LAST };
            let scaled = if scaled < LAST { scaled } else { LAST };
            codes[place] = (scaled + ROUNDS_TO_WHOLE).to_bits() as i16;
        }
        [codes[0], codes[1], codes[2], codes[3], codes[4], codes[5]]
    }
}

/// Maps codes to unsigned numbers in the same order.
#[inline(always)]
pub(crate) const fn rank(code: i16) -> u32 {
    (code as u16 ^ 0x8000) as u32
}

/// Whether two boxes may overlap, as far as codes can tell.
pub(crate) fn may_overlap(one: &Codes, other: &Codes) -> bool {
    (0..3).all(|axis| one[axis] <= other[axis + 3] && other[axis] <= one[axis + 3])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_monotone_and_infinity_is_at_the_ends() {
        let mut numbers = vec![
            f32::NEG_INFINITY,
            f32::MIN,
            -1e30,
            -1e9,
            -7.5,
            -1.0,
            -1e-40,
            0.0,
            f32::MIN_POSITIVE,
            0.1,
            1.0,
            1.000_000_1,
            7.5,
            1e9,
            f32::MAX,
            f32::INFINITY,
        ];
        numbers.extend((0..200).map(|i| i as f32 * 0.013));
        numbers.sort_unstable_by(f32::total_cmp);
        for interval in [(-10.0, 10.0), (1.0, 1.0), (-1e38, 1e38), (0.0, 1e-40), (1e9, 1.1e9), (-1e38, -1e38)]
        {
            let quantiser = Quantiser::over([interval; 3]);
            let codes: Vec<Codes> = numbers.iter().map(|&x| quantiser.codes([x; 3], [x; 3])).collect();
            assert!(codes.is_sorted(), "{interval:?}: {codes:?}");
            assert!(codes.iter().all(|codes| codes.iter().all(|&code| code == codes[0])));
            assert_eq!((codes[0][0], codes[codes.len() - 1][0]), (-32_767, 32_767));
        }
    }

    #[test]
    fn an_interval_is_spread_over_all_codes() {
        let quantiser = Quantiser::over([(2.0, 4.0), (0.0, 1.0), (-1.0, 0.0)]);
        assert_eq!(
            quantiser.codes([2.0, 0.0, -1.0], [4.0, 1.0, 0.0]),
            [-32_767, -32_767, -32_767, 32_767, 32_767, 32_767]
        );
        assert_eq!(quantiser.codes([3.0, 0.5, -0.5], [3.0, 0.5, -0.5]), [0; 6]);
    }

    #[test]
    fn intervals_as_wide_and_as_narrow_as_numbers_go_are_spread() {
        for width in [1e38_f32, 1e20, 1e-20, 1e-31, 1e-33] {
            let quantiser = Quantiser::over([(0.0, width); 3]);
            let codes = [0.0, 0.25, 0.5, 0.75].map(|part| quantiser.codes([part * width; 3], [width; 3])[0]);
            let is_off = |(code, wanted): (i16, i32)| (i32::from(code) - wanted).abs() > 2;
            let wanted = [-32_767, -16_384, 0, 16_384];
            assert!(!codes.into_iter().zip(wanted).any(is_off), "{width}: {codes:?}");
        }
    }

    #[test]
    fn ranks_are_codes_in_order() {
        assert_eq!([i16::MIN, -1, 0, i16::MAX].map(rank), [0, 32_767, 32_768, 65_535]);
    }
}
