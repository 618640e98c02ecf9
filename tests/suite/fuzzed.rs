//! The bodies of the fuzz targets on seeded bytes: a few seconds, in every run, of what `fuzz/` explores for hours.

use asunder_tests::cases::Random;
use asunder_tests::fuzzed;

/// Short and long strings of random bytes, every third of them a mutation of the previous one.
fn strings(seed: u128, count: usize) -> impl Iterator<Item = Vec<u8>> {
    let mut random = Random::new(seed);
    let mut last: Vec<u8> = Vec::new();
    (0..count).map(move |number| {
        if number % 3 == 2 && !last.is_empty() {
            for _ in 0..1 + random.below(4) {
                let place = random.below(last.len());
                last[place] = random.below(256) as u8;
            }
        } else {
            let length = 2 + random.below(if number % 2 == 0 { 32 } else { 130 });
            last = (0..length).map(|_| random.below(256) as u8).collect();
            // A small limit on the vertices to keep, so that some are left out.
            last[1] %= 12;
        }
        last.clone()
    })
}

#[test]
fn hulls_of_any_bytes() {
    strings(3000, 20_000).for_each(|bytes| fuzzed::hull(&bytes));
}

#[test]
fn polygons_of_any_bytes() {
    strings(3001, 20_000).for_each(|bytes| fuzzed::polygon(&bytes));
}

#[test]
fn outlines_of_any_bytes() {
    strings(3002, 20_000).for_each(|bytes| fuzzed::decompose(&bytes));
}
