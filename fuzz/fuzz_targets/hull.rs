//! Hulls in space: made from points, of any dimension, simplified, checked.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| asunder_tests::fuzzed::hull(data));
