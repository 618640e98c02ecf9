//! A world's memory: a steady one allocates nothing per frame, an ageing one no more, and how much a body takes.
//!
//! A binary of its own, since a program has one global allocator.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

mod asked;
mod growth;
mod sizes;
mod steady;

use asunder_tests::counting::{Counting, allocations, counted, live_bytes};

#[global_allocator]
static COUNTING: Counting = Counting;

#[test]
fn what_is_allocated_is_counted() {
    let (calls, live) = counted(2, || {
        let (calls, live) = (allocations(), live_bytes());
        let (one, other) = rayon::join(|| vec![1_u8; 1000], || vec![2_u8; 500]);
        assert_eq!(live_bytes() - live, 1500);
        drop((one, other));
        (allocations() - calls, live_bytes() - live)
    });
    assert_eq!((calls, live), (2, 0));
}
