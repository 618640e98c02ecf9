//! Sorts pairs: an LSD radix sort over no more bits than the numbers have. Pairs that do not fit a near cache are first
//! distributed into buckets by the top bits of the first number, and each bucket is sorted that way.
//!
//! A pass costs 2 to 3.5 ns per pair, whatever the size of its digit, as long as the counters stay in a near cache. For
//! 10,000 boxes two digits of 14 bits take 5.9 ns per pair, three of 10 bits 6.8 (AMD EPYC, Zen 4, 2026-11-22, medians
//! in turns). Buckets: 16.5 ns per pair in place of 26 for 400,000 pairs of 100,000 boxes, 24 in place of 37 for 4
//! million pairs of a million (Intel Xeon, family 6 model 85, 2026-11-28; on the Zen 4 10.5 in place of 12, and 14.5 in
//! place of 15.0). For 50,000 pairs they cost more: 9 ns in place of 6.8 (Zen 4).
//!
//! Tried: digits of 14 and 17 bits for a million boxes (20 to 22 ns in place of 14.5: counters beyond the near cache;
//! Zen 4); digits of 8 and of 9 bits, without buckets (37 and 29 ns in place of 26, Xeon); keys of 32 bits in buckets
//! (no change); a counting sort by the first number, and a comparison sort of each run (16 ns for 400,000 pairs, 43 for
//! 4 million, Xeon).

use crate::pair::PairId;
use core::ops::Range;

/// Scratch memory of the sort.
#[derive(Debug, Default)]
pub(crate) struct Order {
    keys: [Vec<u64>; 2],
    counts: Vec<u32>,
    /// Where each bucket ends.
    ends: Vec<u32>,
}

/// Most bits of a digit, so that its counters fit the nearest cache.
const DIGIT: u32 = 12;

/// Most bits of a digit where two digits are enough, and there are at least as many pairs as counters.
const LONG_DIGIT: u32 = 14;

/// Cost of moving a pair in one pass, relative to adding up one counter.
const A_PAIR: usize = 5;

/// Fewer pairs are sorted by comparison.
const FEW: usize = 64;

/// From this many pairs on, they are distributed into buckets,
const MANY: usize = 1 << 17;

/// each of about this many pairs, or up to twice as many, so that their keys fit a near cache,
const A_BUCKET: usize = 1 << 12;

/// by at most this many bits of the first number.
const MOST_TOP: u32 = 8;

impl Order {
    /// Sorts `pairs`, whose numbers are below `count`.
    pub(crate) fn sort(&mut self, pairs: &mut [PairId], count: usize) {
        self.sort_from(0, pairs, count);
    }

    /// The same for pairs whose second numbers ascend: the sort is stable, so half the digits, those of the first
    /// number, are enough.
    pub(crate) fn sort_by_first(&mut self, pairs: &mut [PairId], count: usize) {
        self.sort_from(bits_below(count), pairs, count);
    }

    /// Sorts by the bits of both numbers from bit `from` on.
    fn sort_from(&mut self, from: u32, pairs: &mut [PairId], count: usize) {
        let bits = bits_below(count);
        let pack = |pair: &PairId| u64::from(pair.a) << bits | u64::from(pair.b);
        let unpack = |key: u64| PairId { a: (key >> bits) as u32, b: (key & ((1 << bits) - 1)) as u32 };
        if pairs.len() < FEW {
            let keys = &mut self.keys[0];
            keys.clear();
            keys.extend(pairs.iter().map(pack));
            keys.sort_unstable();
            pairs.iter_mut().zip(&*keys).for_each(|(pair, &key)| *pair = unpack(key));
            return;
        }
        let [keys, others] = &mut self.keys;
        keys.resize(pairs.len(), 0);
        if pairs.len() < MANY {
            others.resize(pairs.len(), 0);
            keys.iter_mut().zip(pairs.iter()).for_each(|(key, pair)| *key = pack(pair));
            return by_digits((keys, others), from..2 * bits, &mut self.counts, (pairs, unpack));
        }
        let top = (pairs.len() / A_BUCKET).ilog2().min(MOST_TOP).min(bits);
        let longest = throw(pairs, (bits - top, pack), &mut self.ends, keys);
        others.resize(longest, 0);
        let mut rest = (&mut keys[..], pairs);
        let mut start = 0;
        for &end in &self.ends {
            let (keys, later_keys) = rest.0.split_at_mut((end - start) as usize);
            let (pairs, later_pairs) = rest.1.split_at_mut((end - start) as usize);
            (rest, start) = ((later_keys, later_pairs), end);
            let others = &mut others[..keys.len()];
            by_digits((keys, others), from..2 * bits - top, &mut self.counts, (pairs, unpack));
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.keys.iter().map(|keys| keys.capacity() * 8).sum::<usize>()
            + (self.counts.capacity() + self.ends.capacity()) * 4
    }
}

/// Distributes the keys of pairs into buckets by the first number without its `low` bits. Writes where each bucket
/// ends, and returns the size of the largest.
fn throw(
    pairs: &[PairId],
    (low, pack): (u32, impl Fn(&PairId) -> u64),
    ends: &mut Vec<u32>,
    keys: &mut [u64],
) -> usize {
    ends.clear();
    for pair in pairs {
        let bucket = (pair.a >> low) as usize;
        if bucket >= ends.len() {
            ends.resize(bucket + 1, 0);
        }
        ends[bucket] += 1;
    }
    let (mut sum, mut longest) = (0, 0);
    for end in ends.iter_mut() {
        longest = longest.max(*end);
        sum += core::mem::replace(end, sum);
    }
    for pair in pairs {
        let end = &mut ends[(pair.a >> low) as usize];
        keys[*end as usize] = pack(pair);
        *end += 1;
    }
    longest as usize
}

/// Sorts keys by some of their bits, and unpacks them; both buffers are as long as `pairs`.
#[inline(always)]
fn by_digits<'k>(
    (mut keys, mut others): (&'k mut [u64], &'k mut [u64]),
    bits: Range<u32>,
    counts: &mut Vec<u32>,
    (pairs, unpack): (&mut [PairId], impl Fn(u64) -> PairId),
) {
    let (from, bits) = (bits.start, bits.end - bits.start);
    let passes = passes(bits, keys.len());
    let digit = bits.div_ceil(passes);
    let size = 1 << digit;
    let mask = size as u64 - 1;
    counts.clear();
    counts.resize(size * passes as usize, 0);
    for &key in keys.iter() {
        for (pass, counts) in (0..).zip(counts.chunks_exact_mut(size)) {
            counts[(key >> (from + pass * digit) & mask) as usize] += 1;
        }
    }
    for (pass, counts) in (0..).zip(counts.chunks_exact_mut(size)) {
        let mut sum = 0;
        for count in counts.iter_mut() {
            sum += core::mem::replace(count, sum);
        }
        let place = |key: u64| (key >> (from + pass * digit) & mask) as usize;
        if pass + 1 < passes {
            for &key in keys.iter() {
                let to = &mut counts[place(key)];
                others[*to as usize] = key;
                *to += 1;
            }
            core::mem::swap(&mut keys, &mut others);
        } else {
            for &key in keys.iter() {
                let to = &mut counts[place(key)];
                pairs[*to as usize] = unpack(key);
                *to += 1;
            }
        }
    }
}

/// Bits that numbers up to this one need.
fn bits_below(count: usize) -> u32 {
    usize::BITS - count.leading_zeros()
}

/// Into how many digits to cut this many bits, for a number of pairs.
fn passes(bits: u32, pairs: usize) -> u32 {
    let do_two_suffice = bits <= 2 * LONG_DIGIT && pairs >= 1 << bits.div_ceil(2);
    let mut passes = if do_two_suffice { 2 } else { bits.div_ceil(DIGIT) };
    let cost = |passes: u32| passes as usize * ((1 << bits.div_ceil(passes)) + A_PAIR * pairs);
    // For few pairs, another pass may cost less than so many counters.
    while passes < bits && cost(passes + 1) < cost(passes) {
        passes += 1;
    }
    passes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_buckets_and_comparisons_give_the_same_order() {
        let mut order = Order::default();
        let mut state = 1_u64;
        let mut random = |below: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % below) as u32
        };
        for count in [2, 3, 63, 64, 65, 1000, 4096, 70_000, 1 << 29] {
            for pairs in [0, 1, FEW - 1, FEW, 1000, 5000, MANY - 1, MANY + 1000] {
                let mut pairs: Vec<PairId> = (0..pairs)
                    .map(|_| PairId { a: random(count), b: random(count) })
                    .chain([PairId { a: count as u32 - 2, b: count as u32 - 1 }])
                    .collect();
                let mut sorted = pairs.clone();
                sorted.sort_unstable();
                order.sort(&mut pairs, count as usize);
                assert_eq!(pairs, sorted, "{count} boxes");
                for (pair, second) in pairs.iter_mut().zip(0..count as u32) {
                    *pair = PairId { a: random(count), b: second };
                }
                pairs.truncate(count as usize);
                let mut sorted = pairs.clone();
                sorted.sort_unstable();
                order.sort_by_first(&mut pairs, count as usize);
                assert_eq!(pairs, sorted, "{count} boxes, by the first");
            }
        }
    }
}
