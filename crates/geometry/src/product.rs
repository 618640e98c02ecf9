//! Products with their exact rounding errors.
//!
//! Dekker, "A floating-point technique for extending the available precision" (1971), without fused multiply-add, which
//! not every platform has.

/// `a b - c d`, right to a few units in the last place: the rounding error of each product is added back.
pub(crate) fn product_difference(a: f64, b: f64, c: f64, d: f64) -> f64 {
    let ((ab, ab_lost), (cd, cd_lost)) = (exact_product(a, b), exact_product(c, d));
    (ab - cd) + (ab_lost - cd_lost)
}

/// A product as its rounded value and the rounding error.
fn exact_product(a: f64, b: f64) -> (f64, f64) {
    let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
    let rounded = a * b;
    (rounded, ((a_high * b_high - rounded) + a_high * b_low + a_low * b_high) + a_low * b_low)
}

/// A number as the sum of two with at most 26 bits each, whose products are therefore exact.
#[inline(always)]
pub(crate) fn halves(value: f64) -> (f64, f64) {
    const SPLIT: f64 = 134_217_729.0; // 2^27 + 1
    let scaled = SPLIT * value;
    let high = scaled - (scaled - value);
    (high, value - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_and_what_it_lost_are_what_integers_give() {
        let mut bits = 0x9E37_79B9_7F4A_7C15_u64;
        let mut next = || {
            bits = bits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (bits >> 11) as i64 - (1 << 52)
        };
        for _ in 0..10_000 {
            let (a, b) = (next(), next());
            let (rounded, lost) = exact_product(a as f64, b as f64);
            assert_eq!(rounded as i128 + lost as i128, i128::from(a) * i128::from(b), "{a} {b}");
            // Neighbouring factors: both products cancel almost completely.
            let (c, d) = (a + 1, b - 1);
            let truth = i128::from(a) * i128::from(b) - i128::from(c) * i128::from(d);
            let found = product_difference(a as f64, b as f64, c as f64, d as f64);
            assert!((found - truth as f64).abs() <= 4.0 * f64::EPSILON * truth.abs() as f64, "{a} {b}");
        }
    }
}
