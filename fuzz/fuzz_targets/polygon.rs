//! Polygons: taken as they are, as hulls, simplified.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| asunder_tests::fuzzed::polygon(data));
