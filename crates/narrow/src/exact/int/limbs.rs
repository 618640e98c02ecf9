//! Magnitudes: little-endian limbs of 64 bits, without sign or storage.
//!
//! The inner loops of [`Int`](super::Int). Those with a length in their type are unrolled by the compiler and stay in
//! registers; those on slices are for the rare long operand. Nothing here allocates.

use core::cmp::Ordering;

/// `out = a + b`, or `out = a - b`, on the first `L` limbs, all of the sum landing in `L + 1`. True where the
/// difference was negative: `out` then holds its absolute value.
///
/// Which of the two operands is larger is a coin toss in an orientation test, so neither the choice between sum and
/// difference nor the final change of sign is a branch: `a - b` is `a + !b + 1`, and a negative result, seen by the
/// missing carry, is brought back by the same trick.
#[inline]
pub(super) fn combine<const L: usize, const N: usize>(
    out: &mut [u64; N],
    a: &[u64; N],
    b: &[u64; N],
    subtract: bool,
) -> bool {
    const { assert!(L < N) };
    let mut sum = [0; L];
    let mask = u64::from(subtract).wrapping_neg();
    let mut carry = subtract;
    for i in 0..L {
        (sum[i], carry) = add_carry(a[i], b[i] ^ mask, carry);
    }
    out[L] = u64::from(carry & !subtract);
    let negative = subtract & !carry;
    let mask = u64::from(negative).wrapping_neg();
    let mut carry = negative;
    for i in 0..L {
        (out[i], carry) = add_carry(sum[i] ^ mask, 0, carry);
    }
    negative
}

/// As [`combine`], in place: `acc += term` or `acc -= term`.
#[inline]
pub(super) fn accumulate<const L: usize, const N: usize>(
    acc: &mut [u64; N],
    term: &[u64; N],
    subtract: bool,
) -> bool {
    let mut before = [0; N];
    before[..L].copy_from_slice(&acc[..L]);
    combine::<L, N>(acc, &before, term, subtract)
}

/// [`trimmed`] of the first few limbs.
#[inline]
pub(super) fn trimmed_fixed<const N: usize>(limbs: &[u64; N], upto: usize) -> usize {
    let mut len = 0;
    for (i, &limb) in limbs.iter().take(upto).enumerate() {
        len = if limb == 0 { len } else { i + 1 };
    }
    len
}

/// `acc += term`, or `acc -= term`, in two's complement.
#[inline]
pub(super) fn add_signed<const S: usize>(acc: &mut [u64; S], term: &[u64; S], subtract: bool) {
    let mask = u64::from(subtract).wrapping_neg();
    let mut carry = subtract;
    for i in 0..S {
        (acc[i], carry) = add_carry(acc[i], term[i] ^ mask, carry);
    }
}

/// Change of sign in two's complement, if asked for.
#[inline]
pub(super) fn negated_if<const S: usize>(mut limbs: [u64; S], negate: bool) -> [u64; S] {
    let mask = u64::from(negate).wrapping_neg();
    let mut carry = negate;
    for limb in &mut limbs {
        (*limb, carry) = add_carry(*limb ^ mask, 0, carry);
    }
    limbs
}

/// The product of the first `L` limbs of one and the first `M` of the other.
#[inline]
pub(super) fn multiply_short<const L: usize, const M: usize, const S: usize>(
    a: &[u64],
    b: &[u64],
) -> [u64; S] {
    const { assert!(L + M <= S) };
    let mut out = [0; S];
    let (Some(a), Some(b)) = (a.first_chunk::<L>(), b.first_chunk::<M>()) else { return out };
    for i in 0..L {
        let mut carry = 0;
        for j in 0..M {
            (out[i + j], carry) = multiply_add(a[i], b[j], out[i + j], carry);
        }
        out[i + M] = carry;
    }
    out
}

/// `out = a * b` for any lengths; `out` is zero on entry and has at least `a.len() + b.len()` limbs.
///
/// Schoolbook, four rows at a time.
pub(super) fn multiply_long(out: &mut [u64], a: &[u64], b: &[u64]) {
    let (long, short) = ordered(a, b);
    let (fours, rest) = short.as_chunks::<4>();
    let mut out = out;
    for four in fours {
        add_product(out, four, long);
        out = out.get_mut(4..).unwrap_or_default();
    }
    match *rest {
        [a] => add_product(out, &[a], long),
        [a, b] => add_product(out, &[a, b], long),
        [a, b, c] => add_product(out, &[a, b, c], long),
        _ => {}
    }
}

/// `out += a * b`, where `out` has at least `L + b.len()` limbs, zero from `b.len()` on.
///
/// `rest` is the part of the sum that later columns still reach; it stays in registers.
#[inline]
fn add_product<const L: usize>(out: &mut [u64], a: &[u64; L], b: &[u64]) {
    let mut rest = [0; L];
    let (low, high) = out.split_at_mut(b.len());
    for (out, &factor) in low.iter_mut().zip(b) {
        let mut carry;
        (*out, carry) = multiply_add(a[0], factor, rest[0], *out);
        for i in 1..L {
            (rest[i - 1], carry) = multiply_add(a[i], factor, rest[i], carry);
        }
        rest[L - 1] = carry;
    }
    for (out, limb) in high.iter_mut().zip(rest) {
        *out = limb;
    }
}

/// `acc += term`. `acc` is at least as long as `term`, and has room for the carry.
pub(super) fn add_long(acc: &mut [u64], term: &[u64]) {
    let mut carry = false;
    let (low, high) = acc.split_at_mut(term.len());
    for (limb, &term) in low.iter_mut().zip(term) {
        (*limb, carry) = add_carry(*limb, term, carry);
    }
    for limb in high {
        if !carry {
            break;
        }
        (*limb, carry) = limb.overflowing_add(1);
    }
}

/// `acc -= term`, where `acc >= term`.
pub(super) fn subtract_long(acc: &mut [u64], term: &[u64]) {
    let mut borrow = false;
    let (low, high) = acc.split_at_mut(term.len());
    for (limb, &term) in low.iter_mut().zip(term) {
        let (difference, first) = limb.overflowing_sub(term);
        let (difference, second) = difference.overflowing_sub(u64::from(borrow));
        (*limb, borrow) = (difference, first | second);
    }
    for limb in high {
        if !borrow {
            break;
        }
        (*limb, borrow) = limb.overflowing_sub(1);
    }
}

/// Order of two trimmed magnitudes: the longer is the larger.
#[inline]
pub(super) fn compare(a: &[u64], b: &[u64]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
}

/// The number of limbs without leading zeros.
#[inline]
pub(super) fn trimmed(limbs: &[u64]) -> usize {
    limbs.iter().rposition(|&limb| limb != 0).map_or(0, |top| top + 1)
}

/// The longer of the two first.
#[inline]
pub(super) fn ordered<'a>(a: &'a [u64], b: &'a [u64]) -> (&'a [u64], &'a [u64]) {
    if a.len() >= b.len() { (a, b) } else { (b, a) }
}

#[inline]
fn add_carry(a: u64, b: u64, carry: bool) -> (u64, bool) {
    let (sum, first) = a.overflowing_add(b);
    let (sum, second) = sum.overflowing_add(u64::from(carry));
    (sum, first | second)
}

/// `a * b + c + d` as (low, high); it always fits, since (2^64 - 1)^2 + 2 (2^64 - 1) = 2^128 - 1.
#[inline]
fn multiply_add(a: u64, b: u64, c: u64, d: u64) -> (u64, u64) {
    let sum = u128::from(a) * u128::from(b) + u128::from(c) + u128::from(d);
    (sum as u64, (sum >> 64) as u64)
}
