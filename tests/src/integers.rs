//! Floats as integers: every finite float is an integer times a power of two.

use num_bigint::BigInt;

/// The values times one common power of two that makes all of them integers, exactly. They must be finite.
pub fn common_integers(values: &[f64]) -> Vec<BigInt> {
    let parts: Vec<(i64, i32)> = values.iter().map(|&value| mantissa_and_exponent(value)).collect();
    let least = parts.iter().filter(|part| part.0 != 0).map(|part| part.1).min().unwrap_or(0);
    let scaled = |&(mantissa, exponent): &(i64, i32)| {
        if mantissa == 0 { BigInt::ZERO } else { BigInt::from(mantissa) << (exponent - least) as usize }
    };
    parts.iter().map(scaled).collect()
}

/// `value` as `mantissa * 2^exponent`, with an odd mantissa or zero.
fn mantissa_and_exponent(value: f64) -> (i64, i32) {
    assert!(value.is_finite(), "{value} is no number");
    let bits = value.to_bits();
    let biased = (bits >> 52 & 0x7FF) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | 1 << 52, biased - 1075) };
    if mantissa == 0 {
        return (0, 0);
    }
    let shift = mantissa.trailing_zeros();
    let magnitude = mantissa >> shift;
    (if value.is_sign_negative() { -magnitude } else { magnitude }, exponent + shift as i32)
}

/// The exponent of the last set bit of a finite value: it is an integer times 2 to that power. `None` for zero.
pub fn last_exponent(value: f64) -> Option<i32> {
    let (mantissa, exponent) = mantissa_and_exponent(value);
    (mantissa != 0).then_some(exponent)
}

/// A finite value as an integer times 2^`unit`; it must be one.
pub fn in_unit(value: f64, unit: i32) -> BigInt {
    let (mantissa, exponent) = mantissa_and_exponent(value);
    if mantissa == 0 {
        return BigInt::ZERO;
    }
    assert!(exponent >= unit, "{value} is no multiple of 2^{unit}");
    BigInt::from(mantissa) << (exponent - unit) as usize
}
