//! Criterion benches of the report's first section: the separation of pairs, near and far, by our certain and our fast
//! queries. Eight boxes at a time are in `vertices`.

mod brief;

use asunder_narrow::Pair3;
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, pairs3};
use core::hint::black_box;
use criterion::{Criterion, criterion_group, criterion_main};

/// Pairs in a set: one iteration queries them all.
const PAIRS: usize = 200;

fn posed(p: &PosedPair3) -> Pair3<'_> {
    Pair3::new(&p.shape_a, &p.pose_a, &p.shape_b, &p.pose_b)
}

fn separations(criterion: &mut Criterion) {
    for kind in [SolidKind::Box, SolidKind::Hull32] {
        for set in [PairSet::Mixed, PairSet::Touch, PairSet::Rest] {
            let pairs = pairs3(kind, set, PAIRS, 1);
            let name = format!("error/{}/{}", kind.name(), set.name());
            criterion.bench_function(&format!("{name}/certain, {PAIRS} pairs"), |bencher| {
                bencher.iter(|| {
                    for p in &pairs {
                        black_box(posed(black_box(p)).separation(0.0));
                    }
                });
            });
            criterion.bench_function(&format!("{name}/fast, {PAIRS} pairs"), |bencher| {
                bencher.iter(|| pairs.iter().filter(|p| posed(black_box(p)).guess()).count());
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = brief::brief();
    targets = separations
}
criterion_main!(benches);
