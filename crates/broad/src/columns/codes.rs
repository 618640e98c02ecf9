//! Bounds of boxes as whole numbers of 16 bits.

/// The codes of one box: least on the three axes, then greatest.
pub(crate) type Codes = [i16; 6];

/// A box in a column: 16 bytes, so that four fit a cache line.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(16))]
pub(crate) struct Entry {
    pub(crate) codes: Codes,
    /// Place of the box in what is swept.
    pub(crate) place: u32,
}

/// Adding this to a number below 2^21 leaves its nearest whole number in the low bits of the mantissa.
const ROUNDS_TO_WHOLE: f32 = 12_582_912.0;

/// The greatest code; the least is its opposite.
const LAST: f32 = 32_767.0;

/// Coordinates to codes on three axes, monotone: what is not less has no lesser code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantiser {
    middle: [f32; 8],
    scale: [f32; 8],
}

impl Quantiser {
    /// Spreads the codes over the given intervals; what lies outside shares the codes at the ends.
    ///
    /// An interval may be empty, and as wide as numbers go. The middle stays finite, and the scale finite and above
    /// zero, so that no infinite coordinate becomes a NaN.
    pub(crate) fn over(intervals: [(f32, f32); 3]) -> Self {
        let [mut middle, mut scale] = [[0.0; 8]; 2];
        for (axis, (low, high)) in intervals.into_iter().enumerate() {
            let width = f64::from(high) - f64::from(low);
            let per_metre = (2.0 * f64::from(LAST) / width).clamp(1e-30, 1e30) as f32;
            for place in [axis, axis + 3] {
                middle[place] = low * 0.5 + high * 0.5;
                scale[place] = per_metre;
            }
        }
        Self { middle, scale }
    }

    /// The codes of a box without NaN; for any other, some.
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

/// Code to number above zero, in order.
#[inline(always)]
pub(crate) const fn rank(code: i16) -> u32 {
    (code as u16 ^ 0x8000) as u32
}
