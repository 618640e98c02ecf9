//! Every operation against num-bigint, on numbers of 0 to 40 limbs: random limbs, all ones (carries run through),
//! single bits, small numbers shifted far up.

use super::*;
use num_bigint::{BigInt, BigUint, Sign};
use oorandom::Rand64;

const ROUNDS: usize = 20_000;

struct Numbers(Rand64);

impl Numbers {
    fn new(seed: u128) -> Self {
        Self(Rand64::new(seed))
    }

    /// Short lengths are as frequent as in use; lengths about the boundary of what is held in place occur often.
    fn len(&mut self) -> usize {
        match self.0.rand_range(0..8) {
            0..4 => self.0.rand_range(0..6) as usize,
            4..6 => self.0.rand_range(4..9) as usize,
            6 => self.0.rand_range(10..15) as usize,
            _ => self.0.rand_range(0..41) as usize,
        }
    }

    fn number(&mut self) -> (Int, BigInt) {
        let len = self.len();
        self.of_len(len)
    }

    fn of_len(&mut self, len: usize) -> (Int, BigInt) {
        let kind = self.0.rand_range(0..5);
        let mut limbs: Vec<u64> = (0..len)
            .map(|i| match kind {
                0..2 => self.0.rand_u64(),
                2 => u64::MAX,
                3 if i + 1 == len => 1 << self.0.rand_range(0..64),
                3 => 0,
                _ => [0, u64::MAX, 1, 1 << 63][self.0.rand_range(0..4) as usize],
            })
            .collect();
        // Neighbours of the round numbers.
        if let (true, Some(limb)) = (self.0.rand_range(0..4) == 0, limbs.first_mut()) {
            *limb ^= 1;
        }
        let negative = self.0.rand_u64() & 1 == 1;
        let digits = limbs.iter().flat_map(|limb| [*limb as u32, (limb >> 32) as u32]).collect();
        let big = BigInt::from_biguint(if negative { Sign::Minus } else { Sign::Plus }, BigUint::new(digits));
        let int = Int::from_limbs(super::spill::Spill::copied(&limbs, 0));
        (if negative { -int } else { int }, big)
    }

    fn vector(&mut self, len: usize) -> ([Int; 3], [BigInt; 3]) {
        let [x, y, z] = [0; 3].map(|_| {
            let shorter = self.0.rand_range(0..3) as usize;
            self.of_len(len.saturating_sub(shorter))
        });
        ([x.0, y.0, z.0], [x.1, y.1, z.1])
    }
}

/// Equal in value, and in the only representation of that value.
#[track_caller]
fn assert_same(int: &Int, big: &BigInt) {
    let limbs: Vec<u64> = big.magnitude().iter_u64_digits().collect();
    assert_eq!(int.limbs(), limbs);
    assert_eq!(int.len, limbs.len());
    assert_eq!(int.negative, big.sign() == Sign::Minus);
    assert_eq!(int.spilled.is_some(), limbs.len() > INLINE);
    let used = if int.spilled.is_some() { 0 } else { int.len };
    assert!(int.inline[used..].iter().all(|&limb| limb == 0), "padding is not zero: {int:?}");
}

#[test]
fn sums_and_differences_agree_with_num_bigint() {
    let mut numbers = Numbers::new(1);
    for _ in 0..ROUNDS {
        let ((a, big_a), (b, big_b)) = (numbers.number(), numbers.number());
        assert_same(&(&a + &b), &(&big_a + &big_b));
        assert_same(&(&a - &b), &(&big_a - &big_b));
        assert_same(&-&a, &-&big_a);
        assert_same(&(&a + &a), &(&big_a * 2));
        let mut sum = a.clone();
        sum += &b;
        assert_same(&sum, &(&big_a + &big_b));
        sum -= &a;
        assert_same(&sum, &big_b);
        sum -= &b;
        assert!(sum.is_zero());
        assert_same(&(&a - &a), &BigInt::ZERO);
    }
}

#[test]
fn close_numbers_leave_a_short_difference() {
    let mut numbers = Numbers::new(2);
    for _ in 0..ROUNDS {
        let ((a, big_a), (small, big_small)) = (numbers.number(), numbers.of_len(1));
        let (b, big_b) = (&a + &small, &big_a + &big_small);
        assert_same(&(&b - &a), &big_small);
        assert_same(&(&a - &b), &-&big_small);
        assert_same(&b, &big_b);
    }
}

#[test]
fn products_agree_with_num_bigint() {
    let mut numbers = Numbers::new(3);
    for _ in 0..ROUNDS {
        let ((a, big_a), (b, big_b), (c, big_c)) = (numbers.number(), numbers.number(), numbers.number());
        assert_same(&(&a * &b), &(&big_a * &big_b));
        assert_same(&a.square(), &(&big_a * &big_a));
        let mut sum = c.clone();
        sum += &(&a * &b);
        assert_same(&sum, &(&big_c + &big_a * &big_b));
        sum -= &(&a * &b);
        assert_same(&sum, &big_c);
        sum -= &(&a * &b);
        assert_same(&sum, &(&big_c - &big_a * &big_b));
    }
}

#[test]
fn every_pair_of_short_lengths_multiplies() {
    let mut numbers = Numbers::new(4);
    for len_a in 0..16 {
        for len_b in 0..16 {
            for _ in 0..40 {
                let ((a, big_a), (b, big_b)) = (numbers.of_len(len_a), numbers.of_len(len_b));
                assert_same(&(&a * &b), &(&big_a * &big_b));
                let mut cancelled = &a * &b;
                cancelled -= &(&b * &a);
                assert!(cancelled.is_zero());
            }
        }
    }
}

#[test]
fn vectors_agree_with_num_bigint() {
    let mut numbers = Numbers::new(5);
    for len_a in 0..9 {
        for len_b in 0..9 {
            for _ in 0..60 {
                let ((a, big_a), (b, big_b)) = (numbers.vector(len_a), numbers.vector(len_b));
                let dot = (0..3).map(|i| &big_a[i] * &big_b[i]).sum();
                assert_same(&dot3(&a, &b), &dot);
                let cross = cross3(&a, &b);
                for (i, cross) in cross.iter().enumerate() {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    assert_same(cross, &(&big_a[j] * &big_b[k] - &big_a[k] * &big_b[j]));
                }
                assert!(dot3(&cross, &a).is_zero());
                assert!(dot3(&cross, &b).is_zero());
            }
        }
    }
}

#[test]
fn order_and_sign_agree_with_num_bigint() {
    let mut numbers = Numbers::new(6);
    for _ in 0..ROUNDS {
        let ((a, big_a), (b, big_b)) = (numbers.number(), numbers.number());
        assert_eq!(a.cmp(&b), big_a.cmp(&big_b));
        assert_eq!(a == b, big_a == big_b);
        assert_eq!(a.cmp(&a.clone()), Ordering::Equal);
        assert_eq!(a.sign(), big_a.cmp(&BigInt::ZERO));
        assert_eq!(i64::from(a.signum()), i64::from(big_a > BigInt::ZERO) - i64::from(big_a < BigInt::ZERO));
        assert_eq!(a.is_zero(), big_a == BigInt::ZERO);
        assert_eq!(u64::from(a.bits()), big_a.bits());
        let next = &a + &Int::from(1_i64);
        assert_eq!((a.cmp(&next), next.cmp(&a)), (Ordering::Less, Ordering::Greater));
        assert!(a != next);
    }
}

#[test]
fn conversions_agree_with_num_bigint() {
    let mut numbers = Numbers::new(7);
    for value in [0, 1, -1, i64::MAX, i64::MIN, i64::MIN + 1] {
        assert_same(&Int::from(value), &BigInt::from(value));
        for shift in (0..3001).step_by(7).chain([0, 63, 64, 65, 640, 641, 704, 768, 3000]) {
            assert_same(&Int::from_scaled(value, shift), &(BigInt::from(value) << shift));
        }
    }
    for value in [0, 1, -1, i128::MAX, i128::MIN, 1 << 64, -(1 << 64), u64::MAX.into()] {
        assert_same(&Int::from(value), &BigInt::from(value));
    }
    for _ in 0..ROUNDS {
        let value = (i128::from(numbers.0.rand_i64()) << 64 | i128::from(numbers.0.rand_u64()))
            >> numbers.0.rand_range(0..128);
        assert_same(&Int::from(value), &BigInt::from(value));
    }
}

#[test]
fn a_number_is_within_an_ulp_of_its_mantissa_and_exponent() {
    let mut numbers = Numbers::new(8);
    for _ in 0..ROUNDS {
        let (a, big) = numbers.number();
        let (mantissa, exponent) = a.to_f64_scaled();
        if a.is_zero() {
            assert_eq!((mantissa, exponent), (0.0, 0));
            continue;
        }
        assert!((0.5..1.0).contains(&mantissa.abs()), "{mantissa}");
        assert_eq!(mantissa < 0.0, a.signum() < 0);
        // Both as integers in units of 2^-64: |m 2^e - a| <= 2^-52 |a|.
        let scaled = BigInt::from((mantissa * (1_u128 << 64) as f64) as i128) << exponent;
        let error: BigInt = scaled - (&big << 64);
        assert!(error.magnitude() << 52_u32 <= big.magnitude() << 64_u32, "{a:?}");
    }
}

#[test]
fn a_direction_keeps_the_ratios_of_any_vector() {
    let mut numbers = Numbers::new(9);
    for _ in 0..2_000 {
        let len = numbers.len();
        let (vector, big) = numbers.vector(len);
        let direction = direction(&vector).to_array();
        let largest = direction.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let Some((top, _)) = (0..3).map(|i| (i, big[i].magnitude())).max_by_key(|(_, magnitude)| *magnitude)
        else {
            unreachable!("three components")
        };
        if vector[top].is_zero() {
            assert_eq!(direction, [0.0; 3]);
            continue;
        }
        assert!((0.5..1.0).contains(&largest), "{direction:?}");
        for i in 0..3 {
            // The ratio to the largest, exactly to 2^-64, against the quotient of two values rounded once each.
            let ratio = (&big[i] << 64_u32) / &big[top];
            let expected = i128::try_from(ratio).unwrap() as f64 / (1_u128 << 64) as f64;
            assert!((direction[i] / direction[top] - expected).abs() <= 4.0 * f64::EPSILON, "{direction:?}");
        }
    }
    let far =
        [Int::from_scaled(1, 3000), Int::from_scaled(-1, 3000 - 1022), Int::from_scaled(-1, 3000 - 1024)];
    assert_eq!(direction(&far).to_array(), [0.5, -0.5 * f64::MIN_POSITIVE, 0.0]);
}

#[test]
fn parts_put_together_give_the_number_back() {
    let mut numbers = Numbers::new(10);
    let edges =
        [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, -f64::MIN_POSITIVE, 5e-324, -1.5e-323];
    let random = (0..ROUNDS).map(|_| f64::from_bits(numbers.0.rand_u64()));
    for value in edges.into_iter().chain(random).filter(|value| value.is_finite()) {
        let (mantissa, exponent) = parts(value);
        assert_eq!(mantissa == 0, value == 0.0);
        assert!(mantissa == 0 || mantissa % 2 != 0, "{value:e}");
        assert!(mantissa.abs() < 1 << 53);
        // Two exact steps, since 2^-1074 and 2^1023 are the ends of what one factor can be; one of them never rounds.
        let half = exponent / 2;
        assert_eq!(mantissa as f64 * power_of_two(half) * power_of_two(exponent - half), value);
    }
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(parts(value), (0, 0));
    }
    assert_eq!(parts(-12.0), (-3, 2));
    assert_eq!(parts(0.375), (3, -3));
}

fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}
