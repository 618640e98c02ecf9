//! How fast this machine's memory is, as a bound on any broad phase.

use crate::clock::time;
use std::sync::OnceLock;

/// Bytes copied at a time: more than the caches of a server hold.
const BLOCK: usize = 128 << 20;

/// Bytes read and written per nanosecond by one thread that copies: the best of some copies, measured once per run, at
/// the first call. Cost: some tenths of a second, and twice [`BLOCK`] of memory.
pub(super) fn bandwidth() -> f64 {
    static BANDWIDTH: OnceLock<f64> = OnceLock::new();
    *BANDWIDTH.get_or_init(|| {
        let words = BLOCK / size_of::<u64>();
        let from: Vec<u64> = (0..words as u64).collect();
        // Not zero: pages that were never written share one physical page.
        let mut to = vec![1_u64; words];
        let copies = (0..7).map(|_| time(|| core::hint::black_box(&mut to).copy_from_slice(&from)).0);
        let best = copies.fold(f64::INFINITY, f64::min);
        2.0 * BLOCK as f64 / best.max(1.0)
    })
}

/// The traffic that no broad phase can avoid, in bytes: reading every box and writing every pair.
pub(super) fn least_traffic(boxes: usize, pairs: usize) -> f64 {
    24.0 * boxes as f64 + 8.0 * pairs as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_neither_slower_than_a_disk_nor_faster_than_a_cache() {
        let found = bandwidth();
        assert!((0.1..1000.0).contains(&found), "{found} bytes a nanosecond");
        assert_eq!(found, bandwidth(), "one figure a run");
    }
}
