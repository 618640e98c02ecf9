//! Concave outlines: refused for a reason that is true, or split without gap or overlap.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| asunder_tests::fuzzed::decompose(data));
