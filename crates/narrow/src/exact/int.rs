//! Signed integers of any length, made for a few hundred products of one to five limbs.
//!
//! Representation: sign and magnitude. The magnitude is an array of 64-bit limbs, little-endian, trimmed (zero has
//! none): held in the value itself up to twelve limbs (768 bits, 136 bytes in all), on the heap beyond ([`spill`]).
//! What is typical here, factors of 1 to 5 limbs and their sums of products, needs no heap; heap memory is reused.
//!
//! Why sign and magnitude: most callers ask only for the sign, which is stored; a product needs no correction; and the
//! length says how large a number is. Two's complement is better at one thing, sums whose sign is a coin toss, and the
//! inner loops (`limbs`) use it there: no branch depends on a sign.
//!
//! Why not a general crate: those allocate for every result and loop over lengths known only at run time, and both cost
//! more than the arithmetic. Nanoseconds, ours before the stroke and num-bigint 0.4 behind it (AMD EPYC, family 25
//! model 17, one core; rustc 1.95, no target features; one length throughout, so branches are predicted):
//!
//! ```text
//! limbs          1x1       2x2       2x3       3x3       5x5      10x10
//! a * b          4 / 26    6 / 33    7 / 35   10 / 39   20 / 57  107 / 132
//! a + b          5 / 12    5 / 29    6 / 22    6 / 32    9 / 33   14 / 35
//! a += b         5 / 15    6 / 16    6 / 16    6 / 17    7 / 17   13 / 20
//! dot3           9 / 89   14 / 118  20 / 125  37 / 140  63 / 194 474 / 460
//! ```
//!
//! Cost: sums are linear in the limbs, products quadratic (schoolbook at any length), the rest is constant except for
//! `clone`.
//!
//! Four things make the difference:
//! 1. Short operands are padded with zeros to one of a few fixed lengths, whose loops the compiler unrolls into
//!    registers. Limbs above `len` are zero for that purpose.
//! 2. [`sum_of_products`] picks those lengths once for an inner product, and resolves the sign once.
//! 3. Results leave the registers only once. Built in a local that is then returned, they would be stored, loaded and
//!    stored again: a product of 1x1 limbs takes 9 ns that way, against 4.
//! 4. Twelve limbs in place. With 16 or 20, tried: 2x3 takes 8 ns in place of 7, a product of 5x5 that is added on 38
//!    or 42 in place of 32; that saves only allocations that the longest results need.
//!
//! Tried, the loops on slices over other storage, products 1x1, 2x3, 5x5: smallvec 11, 14, 28 ns; arrayvec, which
//! cannot grow, 8, 11, 27 ns.

mod limbs;
mod operators;
mod spill;
#[cfg(test)]
mod tests;

use asunder_geometry::glam::DVec3;
use core::cmp::Ordering;
use spill::Spill;

/// Limbs held in place.
const INLINE: usize = 12;

/// A signed integer of any length.
#[derive(Clone, Debug)]
pub(crate) struct Int {
    /// The magnitude where it fits, little-endian; every limb from `len` on is zero.
    inline: [u64; INLINE],
    /// The whole magnitude where `len` is above `INLINE`; absent otherwise.
    spilled: Option<Spill>,
    /// Limbs up to the highest that is not zero.
    len: usize,
    /// Never set for zero.
    negative: bool,
}

impl Int {
    pub(crate) const ZERO: Self = Self { inline: [0; INLINE], spilled: None, len: 0, negative: false };

    pub(crate) const ONE: Self = {
        let mut inline = [0; INLINE];
        inline[0] = 1;
        Self { inline, spilled: None, len: 1, negative: false }
    };

    /// `mantissa * 2^shift`.
    pub(crate) fn from_scaled(mantissa: i64, shift: u32) -> Self {
        let low = (shift / 64) as usize;
        let bits = u128::from(mantissa.unsigned_abs()) << (shift % 64);
        let top = [bits as u64, (bits >> 64) as u64];
        let mut int = if low + 2 <= INLINE {
            let mut int = Self::ZERO;
            for (limb, top) in int.inline[low..].iter_mut().zip(top) {
                *limb = top;
            }
            int.trim(low + 2);
            int
        } else {
            let mut limbs = Spill::zeros(low + 2);
            for (limb, top) in limbs.iter_mut().skip(low).zip(top) {
                *limb = top;
            }
            Self::from_limbs(limbs)
        };
        int.negative = mantissa < 0;
        int
    }

    /// Minus one, zero or one.
    #[inline]
    pub(crate) fn signum(&self) -> i32 {
        i32::from(self.len != 0) - 2 * i32::from(self.negative)
    }

    /// How the number compares with zero.
    #[inline]
    pub(crate) fn sign(&self) -> Ordering {
        self.signum().cmp(&0)
    }

    #[inline]
    pub(crate) fn is_zero(&self) -> bool {
        self.len == 0
    }

    /// Length of the magnitude in bits; zero has none.
    #[inline]
    pub(crate) fn bits(&self) -> u32 {
        self.limbs().last().map_or(0, |top| 64 * self.len as u32 - top.leading_zeros())
    }

    #[inline]
    pub(crate) fn square(&self) -> Self {
        self * self
    }

    /// The number as `m * 2^e` with 0.5 <= |m| < 1 and a relative error of at most 2^-52; zero is `(0, 0)`.
    ///
    /// The top 64 bits are kept: cutting the rest costs less than 2^-63, rounding to f64 at most 2^-53.
    pub(crate) fn to_f64_scaled(&self) -> (f64, i32) {
        let (top, next) = match *self.limbs() {
            [] => return (0.0, 0),
            [top] => (top, 0),
            [.., next, top] => (top, next),
        };
        let both = (u128::from(top) << 64) | u128::from(next);
        let leading = (both << both.leading_zeros()) >> 64;
        // A power of two: exact. Rounding may have brought the mantissa up to one.
        let magnitude = leading as u64 as f64 / (1_u128 << 64) as f64;
        let exponent = self.bits() as i32;
        let (magnitude, exponent) = if magnitude < 1.0 { (magnitude, exponent) } else { (0.5, exponent + 1) };
        (if self.negative { -magnitude } else { magnitude }, exponent)
    }

    /// The magnitude, trimmed.
    #[inline]
    fn limbs(&self) -> &[u64] {
        match &self.spilled {
            None => &self.inline[..self.len.min(INLINE)],
            Some(limbs) => &limbs[..],
        }
    }

    /// A number that is not negative, from limbs in any state.
    fn from_limbs(mut limbs: Spill) -> Self {
        limbs.truncate(limbs::trimmed(&limbs));
        let mut int = Self::ZERO;
        int.len = limbs.len();
        match int.inline.get_mut(..limbs.len()) {
            Some(inline) => inline.copy_from_slice(&limbs),
            None => int.spilled = Some(limbs),
        }
        int
    }

    /// Sets the length, at most `len`; for numbers held in place only.
    #[inline]
    fn trim(&mut self, mut len: usize) {
        len = len.min(INLINE);
        while len > 0 && self.inline[len - 1] == 0 {
            len -= 1;
        }
        self.len = len;
        self.negative &= len > 0;
    }

    /// Product of at most `INLINE` limbs.
    fn product_inline(&self, other: &Self) -> Self {
        let negative = self.negative ^ other.negative;
        let (short, long) = if self.len <= other.len { (self, other) } else { (other, self) };
        match (short.len, long.len) {
            (0..=1, 0..=1) => Self::product_fixed::<1, 1>(short, long, negative),
            (0..=1, 2..=3) => Self::product_fixed::<1, 3>(short, long, negative),
            (2, 2) => Self::product_fixed::<2, 2>(short, long, negative),
            (2, 3) => Self::product_fixed::<2, 3>(short, long, negative),
            (3, 3) => Self::product_fixed::<3, 3>(short, long, negative),
            (0..=2, 4..=5) => Self::product_fixed::<2, 5>(short, long, negative),
            (3, 4..=5) => Self::product_fixed::<3, 5>(short, long, negative),
            (4, 4) => Self::product_fixed::<4, 4>(short, long, negative),
            (4..=5, 5) => Self::product_fixed::<5, 5>(short, long, negative),
            _ => {
                let mut product = Self::ZERO;
                limbs::multiply_long(&mut product.inline, long.limbs(), short.limbs());
                product.negative = negative;
                product.trim(short.len + long.len);
                product
            }
        }
    }

    #[inline]
    fn product_fixed<const L: usize, const M: usize>(short: &Self, long: &Self, negative: bool) -> Self {
        let inline = limbs::multiply_short::<L, M, INLINE>(&short.inline, &long.inline);
        let len = limbs::trimmed_fixed::<INLINE>(&inline, L + M);
        Self { inline, spilled: None, len, negative: negative & (len > 0) }
    }

    #[cold]
    fn product_long(&self, other: &Self) -> Self {
        let mut limbs = Spill::zeros(self.len + other.len);
        limbs::multiply_long(&mut limbs, self.limbs(), other.limbs());
        let mut product = Self::from_limbs(limbs);
        product.negative = product.len > 0 && self.negative != other.negative;
        product
    }

    /// `self + term`, with a sign given for the term.
    #[inline]
    fn sum(&self, term: &Self, negative: bool) -> Self {
        if self.len.max(term.len) < INLINE {
            self.sum_inline(term, negative)
        } else {
            self.sum_long(term.limbs(), negative)
        }
    }

    fn sum_inline(&self, term: &Self, negative: bool) -> Self {
        let subtract = self.negative ^ negative;
        match self.len.max(term.len) {
            0..=2 => self.sum_fixed::<2>(term, subtract),
            3..=4 => self.sum_fixed::<4>(term, subtract),
            5..=7 => self.sum_fixed::<7>(term, subtract),
            _ => self.sum_fixed::<{ INLINE - 1 }>(term, subtract),
        }
    }

    #[inline]
    fn sum_fixed<const L: usize>(&self, term: &Self, subtract: bool) -> Self {
        let mut inline = [0; INLINE];
        let flipped = limbs::combine::<L, INLINE>(&mut inline, &self.inline, &term.inline, subtract);
        let len = limbs::trimmed_fixed::<INLINE>(&inline, L + 1);
        Self { inline, spilled: None, len, negative: (self.negative ^ flipped) & (len > 0) }
    }

    /// `self += term`, with a sign given for the term.
    #[inline]
    fn accumulate(&mut self, term: &Self, negative: bool) {
        if self.len.max(term.len) < INLINE {
            self.accumulate_inline(&term.inline, term.len, negative);
        } else {
            *self = self.sum_long(term.limbs(), negative);
        }
    }

    /// The same for operands below `INLINE` limbs.
    fn accumulate_inline(&mut self, term: &[u64; INLINE], len: usize, negative: bool) {
        let longest = self.len.max(len);
        let subtract = self.negative ^ negative;
        let acc = &mut self.inline;
        self.negative ^= match longest {
            0..=2 => limbs::accumulate::<2, INLINE>(acc, term, subtract),
            3..=4 => limbs::accumulate::<4, INLINE>(acc, term, subtract),
            5..=7 => limbs::accumulate::<7, INLINE>(acc, term, subtract),
            _ => limbs::accumulate::<{ INLINE - 1 }, INLINE>(acc, term, subtract),
        };
        self.trim(longest + 1);
    }

    #[cold]
    fn sum_long(&self, term: &[u64], negative: bool) -> Self {
        if self.negative == negative {
            let (longer, shorter) = limbs::ordered(self.limbs(), term);
            // The limb above takes the carry.
            let mut sum = Spill::copied(longer, 1);
            limbs::add_long(&mut sum, shorter);
            Self { negative, ..Self::from_limbs(sum) }
        } else {
            let order = limbs::compare(self.limbs(), term);
            let (larger, smaller) = if order.is_ge() { (self.limbs(), term) } else { (term, self.limbs()) };
            let mut difference = Spill::copied(larger, 0);
            limbs::subtract_long(&mut difference, smaller);
            let negative = if order.is_ge() { self.negative } else { negative };
            Self { negative: negative && order.is_ne(), ..Self::from_limbs(difference) }
        }
    }
}

/// The inner product of two vectors.
pub(crate) fn dot3(a: &[Int; 3], b: &[Int; 3]) -> Int {
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    sum_of_products([[ax, bx], [ay, by], [az, bz]], false)
}

/// The vector product.
pub(crate) fn cross3(a: &[Int; 3], b: &[Int; 3]) -> [Int; 3] {
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    [
        sum_of_products([[ay, bz], [az, by]], true),
        sum_of_products([[az, bx], [ax, bz]], true),
        sum_of_products([[ax, by], [ay, bx]], true),
    ]
}

/// The first product plus the others, or minus the others.
///
/// Short factors are padded with zeros to a common length and summed in registers, in two's complement: one choice of
/// lengths and one change of sign for the whole sum.
pub(crate) fn sum_of_products<const K: usize>(factors: [[&Int; 2]; K], subtract: bool) -> Int {
    let [a, b] = [0, 1].map(|side| factors.iter().map(|pair| pair[side].len).max().unwrap_or(0));
    match (a, b) {
        (0..=1, 0..=1) => products_fixed::<K, 1, 1, 3>(factors, subtract),
        (0..=2, 0..=2) => products_fixed::<K, 2, 2, 5>(factors, subtract),
        (0..=2, 3) => products_fixed::<K, 2, 3, 6>(factors, subtract),
        (3, 0..=2) => products_fixed::<K, 2, 3, 6>(factors.map(|[a, b]| [b, a]), subtract),
        (0..=3, 0..=3) => products_fixed::<K, 3, 3, 7>(factors, subtract),
        (0..=2, 0..=5) => products_fixed::<K, 2, 5, 8>(factors, subtract),
        (0..=5, 0..=2) => products_fixed::<K, 2, 5, 8>(factors.map(|[a, b]| [b, a]), subtract),
        (0..=4, 0..=4) => products_fixed::<K, 4, 4, 9>(factors, subtract),
        (0..=5, 0..=5) => products_fixed::<K, 5, 5, 11>(factors, subtract),
        _ => {
            let mut sum = Int::ZERO;
            for (i, [a, b]) in factors.into_iter().enumerate() {
                let product = a * b;
                sum.accumulate(&product, product.negative ^ (subtract && i > 0));
            }
            sum
        }
    }
}

/// [`sum_of_products`] of factors of at most `L` and `M` limbs; `S` is one more than both, for the sign.
#[inline]
fn products_fixed<const K: usize, const L: usize, const M: usize, const S: usize>(
    factors: [[&Int; 2]; K],
    subtract: bool,
) -> Int {
    const { assert!(S == L + M + 1 && S <= INLINE) };
    let mut sum = [0; S];
    for (i, [a, b]) in factors.into_iter().enumerate() {
        let product = limbs::multiply_short::<L, M, S>(&a.inline, &b.inline);
        limbs::add_signed(&mut sum, &product, a.negative ^ b.negative ^ (subtract && i > 0));
    }
    let negative = sum[S - 1] >> 63 == 1;
    let mut inline = [0; INLINE];
    for (limb, magnitude) in inline.iter_mut().zip(limbs::negated_if(sum, negative)) {
        *limb = magnitude;
    }
    let len = limbs::trimmed_fixed(&inline, S);
    Int { inline, spilled: None, len, negative }
}

/// The direction of a vector in f64, its largest component in 0.5 to 1 by magnitude; zero for the zero vector.
///
/// A component less than 2^-1022 of the largest is dropped.
pub(crate) fn direction(vector: &[Int; 3]) -> DVec3 {
    let top = vector.iter().filter(|int| !int.is_zero()).map(|int| int.to_f64_scaled().1).max();
    let component = |int: &Int| {
        let (mantissa, exponent) = int.to_f64_scaled();
        match u64::try_from(exponent - top.unwrap_or(0) + 1023) {
            Ok(biased) if biased > 0 && !int.is_zero() => mantissa * f64::from_bits(biased << 52),
            _ => 0.0,
        }
    };
    let [x, y, z] = vector;
    DVec3::new(component(x), component(y), component(z))
}

/// `value = mantissa * 2^exponent` exactly, the mantissa odd or zero; `(0, 0)` for zero and for what is not finite.
pub(crate) fn parts(value: f64) -> (i64, i32) {
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    let bits = value.to_bits();
    let fraction = (bits & ((1 << FRACTION) - 1)) as i64;
    let biased = ((bits >> FRACTION) & 0x7ff) as i32;
    // Subnormals share the exponent of the smallest normal numbers and lack the hidden bit.
    let magnitude = if biased == 0 { fraction } else { fraction | 1 << FRACTION };
    if magnitude == 0 || !value.is_finite() {
        return (0, 0);
    }
    let zeros = magnitude.trailing_zeros();
    let odd = magnitude >> zeros;
    (if value < 0.0 { -odd } else { odd }, biased.max(1) - 1075 + zeros as i32)
}
