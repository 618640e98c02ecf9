//! Criterion benches of the report's last section: each query, for pairs with few and with many vertices, in space and
//! in the plane.

mod brief;

use asunder_narrow::{Batch3, Hint, Job3, Pair2, Pair3, collide3, separations3};
use asunder_scenes::pairs::{PairSet, PlaneKind, PosedPair2, PosedPair3, SolidKind, pairs2, pairs3};
use core::hint::black_box;
use criterion::{Criterion, criterion_group, criterion_main};

/// Pairs in a set: one iteration queries them all.
const PAIRS: usize = 200;

fn posed(p: &PosedPair3) -> Pair3<'_> {
    Pair3::new(&p.shape_a, &p.pose_a, &p.shape_b, &p.pose_b)
}

/// One query for every pair of a set. The name is that of the row of `compare`; times are for the whole set.
fn solids(
    criterion: &mut Criterion,
    (kind, set): (SolidKind, PairSet),
    operation: &str,
    ask: impl Fn(&Pair3) -> bool,
) {
    let pairs = pairs3(kind, set, PAIRS, 1);
    let one = |pair: &PosedPair3| ask(&posed(pair));
    criterion.bench_function(
        &format!("{}/{}/{operation}, {PAIRS} pairs", kind.name(), set.name()),
        |bencher| {
            bencher.iter(|| pairs.iter().filter(|pair| one(black_box(pair))).count());
        },
    );
}

fn space(criterion: &mut Criterion) {
    for kind in [SolidKind::Box, SolidKind::Authored, SolidKind::Hull32, SolidKind::Hull128] {
        let mixed = (kind, PairSet::Mixed);
        solids(criterion, mixed, "boolean", |pair| pair.overlaps());
        solids(criterion, mixed, "separation", |pair| {
            black_box(pair.separation(0.0));
            true
        });
        solids(criterion, mixed, "manifold", |pair| black_box(pair.manifold(0.0)).is_some());
        solids(criterion, (kind, PairSet::Rest), "manifold", |pair| black_box(pair.manifold(0.0)).is_some());
    }
    for kind in [SolidKind::Box, SolidKind::Hull32] {
        solids(criterion, (kind, PairSet::Far), "boolean", |pair| pair.overlaps());
        solids(criterion, (kind, PairSet::Deep), "separation", |pair| {
            black_box(pair.separation(0.0));
            true
        });
    }
    at_once(criterion);
}

fn job(pair: &PosedPair3, hint: Hint, sensor: bool) -> Job3<'_> {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor }
}

/// Boxes without hints, all in one call.
fn at_once(criterion: &mut Criterion) {
    let pairs = pairs3(SolidKind::Box, PairSet::Mixed, PAIRS, 1);
    let posed: Vec<Pair3<'_>> = pairs.iter().map(posed).collect();
    let mut found = Vec::new();
    criterion.bench_function(&format!("box8/mixed/separation, {PAIRS} pairs"), |bencher| {
        bencher.iter(|| {
            found.clear();
            separations3(black_box(&posed), 0.0, &mut found);
            found.len()
        });
    });
    let mut batch = Batch3::default();
    for (operation, sensor) in [("boolean", true), ("manifold", false)] {
        let jobs: Vec<Job3<'_>> = pairs.iter().map(|pair| job(pair, Hint::NONE, sensor)).collect();
        criterion.bench_function(&format!("box8/mixed/{operation}, {PAIRS} pairs"), |bencher| {
            bencher.iter(|| {
                batch.clear();
                collide3(black_box(&jobs), &mut batch);
                batch.manifolds.len()
            });
        });
    }
}

fn pair(p: &PosedPair2) -> Pair2<'_> {
    Pair2::new(&p.shape_a, &p.pose_a, &p.shape_b, &p.pose_b)
}

fn plane(criterion: &mut Criterion) {
    for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
        let pairs = pairs2(kind, PairSet::Mixed, PAIRS, 1);
        criterion.bench_function(&format!("{}/mixed/boolean, {PAIRS} pairs", kind.name()), |bencher| {
            bencher.iter(|| pairs.iter().filter(|p| pair(black_box(p)).overlaps()).count());
        });
        criterion.bench_function(&format!("{}/mixed/manifold, {PAIRS} pairs", kind.name()), |bencher| {
            bencher.iter(|| pairs.iter().filter(|p| pair(black_box(p)).manifold(0.0).is_some()).count());
        });
    }
    for (kind, set) in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64]
        .into_iter()
        .flat_map(|kind| [(kind, PairSet::Touch), (kind, PairSet::Deep)])
    {
        let pairs = pairs2(kind, set, PAIRS, 1);
        let name = format!("{}/{}/separation, {PAIRS} pairs", kind.name(), set.name());
        criterion.bench_function(&name, |bencher| {
            bencher.iter(|| {
                for p in &pairs {
                    black_box(pair(black_box(p)).separation(0.0));
                }
            });
        });
    }
    let far = pairs2(PlaneKind::Poly4096, PairSet::Far, PAIRS, 1);
    criterion.bench_function(&format!("poly4096/far/boolean, {PAIRS} pairs"), |bencher| {
        bencher.iter(|| far.iter().filter(|p| pair(black_box(p)).overlaps()).count());
    });
}

criterion_group! {
    name = benches;
    config = brief::brief();
    targets = space, plane
}
criterion_main!(benches);
