//! Gaps: how far a pair is from touching, on either side of it.

use crate::random::Random;

/// The levels of [`gap`]; the last is exact touching, as far as positions can represent it.
pub(super) const GAPS: u32 = 8;

/// What a level of [`gap`] means.
pub(super) const GAP_KNOB: &str =
    "gap of 1e-3 of size at level 0, a hundredth of that each level on, none at the last; of either sign";

const LARGEST: [f64; GAPS as usize - 1] = [1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15];

/// A gap, or if negative a depth, as a share of the pair's size; zero at the last level.
pub(super) fn gap(level: u32, random: &mut Random) -> f64 {
    match LARGEST.get(level as usize) {
        Some(&largest) => largest * random.log_range(0.01, 1.0) * sign(random),
        None => 0.0,
    }
}

/// A gap of any level of [`gap`], for families whose level means something else.
pub(super) fn any_gap(random: &mut Random) -> f64 {
    let level = random.below(GAPS as usize) as u32;
    gap(level, random)
}

/// One or minus one.
pub(super) fn sign(random: &mut Random) -> f64 {
    if random.unit() < 0.5 { -1.0 } else { 1.0 }
}

/// A random number of ulps, from -2^level to 2^level.
pub(super) fn ulps(level: u32, random: &mut Random) -> i64 {
    let most = 1_usize << level.min(40);
    random.below(2 * most + 1) as i64 - most as i64
}

/// `value` moved by so many f64 steps away from zero or, if negative, towards it.
pub(super) fn stepped(value: f64, steps: i64) -> f64 {
    let bits = value.abs().to_bits().saturating_add_signed(steps);
    let moved = f64::from_bits(bits).copysign(value);
    if moved.is_finite() { moved } else { value }
}

/// As [`stepped`], in steps of f32.
pub(super) fn stepped_f32(value: f32, steps: i32) -> f32 {
    let moved = f32::from_bits(value.abs().to_bits().saturating_add_signed(steps)).copysign(value);
    if moved.is_finite() { moved } else { value }
}
