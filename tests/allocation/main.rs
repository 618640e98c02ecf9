//! What a world takes from the allocator: nothing a frame once it is steady, no more as it ages, and so much a body.
//!
//! A binary of its own, since a program has one allocator.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests stop the test, as tests do")]

mod counting;
mod growth;
mod sizes;
mod steady;
