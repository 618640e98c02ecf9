//! The index of resting boxes against a loop over all of them: overlaps here; rays, moving boxes and nearest boxes in
//! `reach`.

mod reach;

use asunder_broad::Index;
use asunder_geometry::{Aabb2, Aabb3, Bounds};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_tests::brute_pairs::Sides;
use asunder_tests::cases::{NASTY, Random};
use core::ops::ControlFlow;
use glam::Vec3;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Whether two boxes share a point: on every axis, the greater of the minima is not above the lesser of the maxima.
fn share<B: Sides>(one: &B, other: &B) -> bool {
    let is_interval = |&(low, high): &(f32, f32)| low <= high;
    one.sides()
        .iter()
        .zip(&other.sides())
        .all(|(p, q)| is_interval(p) && is_interval(q) && p.0.max(q.0) <= p.1.min(q.1))
}

/// Asserts that list and visitor give the same boxes as the loop; returns how many.
fn check_overlaps<B: Bounds + Sides>(
    index: &Index<B>,
    boxes: &[B],
    keep: fn(u32) -> bool,
    asked: &B,
) -> usize {
    let numbers = (0_u32..).zip(boxes).filter(|&(number, other)| keep(number) && share(asked, other));
    let expected: Vec<u32> = numbers.map(|(number, _)| number).collect();
    let mut found = vec![7];
    index.overlapping(asked, &mut found);
    assert_eq!(found, expected, "{asked:?}");
    let mut visited = Vec::new();
    let outcome = index.visit_overlapping(asked, |number| {
        visited.push(number);
        ControlFlow::Continue(())
    });
    assert!(outcome.is_continue());
    visited.sort_unstable();
    assert_eq!(visited, expected, "each box once to the visitor");
    expected.len()
}

fn everything(_: u32) -> bool {
    true
}

fn two_of_three(number: u32) -> bool {
    !number.is_multiple_of(3)
}

/// Queries an index of all boxes and one that leaves some out, with every third query box, grown and not.
fn check_all<B: Bounds + Sides>(boxes: &[B], asked: &[B]) -> usize {
    let mut index = Index::new();
    let mut found = 0;
    for keep in [everything, two_of_three] {
        index.build_from(boxes, keep);
        found += asked.iter().map(|one| check_overlaps(&index, boxes, keep, one)).sum::<usize>();
    }
    found
}

fn random_box3(random: &mut Random, room: Vec3, size: f64) -> Aabb3 {
    let center = random.vector().as_vec3() * room;
    let half = Vec3::from_array([0; 3].map(|_| random.between(0.0, size) as f32));
    Aabb3::new(center - half, center + half)
}

fn flat(b: &Aabb3) -> Aabb2 {
    Aabb2::new(b.min.truncate(), b.max.truncate())
}

#[test]
fn overlaps_in_random_boxes_of_every_density() {
    let mut random = Random::new(810);
    let mut counts = Vec::new();
    for size in [0.002, 0.02, 0.1, 0.5, 2.0] {
        for room in [Vec3::ONE, Vec3::new(1.0, 0.02, 1.0), Vec3::new(0.01, 0.01, 5.0), Vec3::X, Vec3::Y] {
            let boxes: Vec<_> = (0..700).map(|_| random_box3(&mut random, room, size)).collect();
            let asked: Vec<_> =
                (0..60).map(|i| random_box3(&mut random, room, [0.0, size, 0.3][i % 3])).collect();
            counts.push(check_all(&boxes, &asked));
            let [boxes, asked] = [boxes, asked].map(|list| list.iter().map(flat).collect::<Vec<_>>());
            counts.push(check_all(&boxes, &asked));
        }
    }
    let most = 60 * (700 + 466);
    assert!(counts.iter().any(|&count| count < most / 100), "sparse: {counts:?}");
    assert!(counts.iter().any(|&count| count > most * 8 / 10), "dense: {counts:?}");
}

#[test]
fn overlaps_in_every_scene() {
    let mut found = 0;
    for scene in BoxScene::ALL {
        for count in [0, 1, 2, 8, 9, 65, 3000] {
            let boxes = MovingBoxes::new(scene, count, 3).boxes;
            let asked: Vec<_> = boxes.iter().step_by(count / 50 + 1).copied().collect();
            found += check_all(&boxes, &asked);
        }
    }
    assert!(found > 1000, "{found}");
}

/// Sixty boxes with nasty coordinates; every fourth may be inverted.
fn nasty_boxes(random: &mut Random, round: usize) -> Vec<Aabb3> {
    // NaN in every tenth round only, or few valid boxes would be left.
    let skip = usize::from(!round.is_multiple_of(10));
    let mut corner = || Vec3::from_array([0; 3].map(|_| NASTY[skip + random.below(NASTY.len() - skip)]));
    let corners = (0..60).map(|i| (i, corner(), corner()));
    corners
        .map(|(i, p, q)| if i % 4 == 0 { Aabb3::new(p, q) } else { Aabb3::new(p.min(q), p.max(q)) })
        .collect()
}

#[test]
fn overlaps_of_nasty_boxes() {
    let mut random = Random::new(811);
    let mut found = 0;
    for round in 0..200 {
        let boxes = nasty_boxes(&mut random, round);
        found += check_all(&boxes, &boxes);
        let flat: Vec<Aabb2> = boxes.iter().map(flat).collect();
        found += check_all(&flat, &flat);
    }
    assert!(found > 100_000, "{found} overlaps");
}

/// Boxes in ever smaller clusters, identical ones, and giants among them: nothing that sort keys can separate at once.
fn clusters(random: &mut Random) -> Vec<Aabb3> {
    let mut boxes = Vec::new();
    for scale in [1e9_f32, 1.0, 1e-9, 1e-18, 1e-27, 1e-36] {
        boxes.extend((0..100).map(|_| random_box3(random, Vec3::splat(scale), f64::from(scale) * 0.01)));
        boxes.extend([Aabb3::new(Vec3::ZERO, Vec3::splat(scale)); 40]);
    }
    boxes.extend((0..20).map(|i| Aabb3::new(Vec3::NEG_INFINITY, Vec3::new(f32::INFINITY, 0.0, i as f32))));
    boxes
}

#[test]
fn overlaps_in_clusters_in_clusters() {
    let boxes = clusters(&mut Random::new(812));
    let found = check_all(&boxes, &boxes);
    assert!(found > 100_000, "{found} overlaps");
}

/// Nine boxes at each power of two, on both sides of zero: halving the room splits off one power at a time, and makes a
/// deep tree.
#[test]
fn overlaps_of_boxes_that_halve_the_way() {
    let powers = (1..255).map(|exponent| f32::from_bits(exponent << 23)).flat_map(|power| [power, -power]);
    let boxes: Vec<Aabb3> =
        powers.flat_map(|power| [Aabb3::new(Vec3::splat(power), Vec3::splat(power)); 9]).collect();
    let all = Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY);
    let asked: Vec<Aabb3> = boxes.iter().step_by(9).copied().chain([all]).collect();
    // Nine of nine and six of nine at every place; the box around everything finds as many again.
    assert_eq!(check_all(&boxes, &asked), 508 * (9 + 6) * 2);
}

#[test]
fn an_index_remembers_nothing() {
    let mut random = Random::new(813);
    let mut index = Index::new();
    for count in [300, 2, 0, 150, 1, 299] {
        let boxes: Vec<_> = (0..count).map(|_| random_box3(&mut random, Vec3::ONE, 0.2)).collect();
        index.build(&boxes);
        assert_eq!((index.len(), index.is_empty()), (count, count == 0));
        for one in &boxes {
            check_overlaps(&index, &boxes, everything, one);
        }
    }
}

#[test]
fn a_visitor_may_break_off() {
    let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 200];
    let mut index = Index::new();
    index.build(&boxes);
    let mut seen = 0;
    let outcome = index.visit_overlapping(&boxes[0], |_| {
        seen += 1;
        if seen == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(outcome.is_break() && seen == 5);
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => (-8_i8..8).prop_map(|step| f32::from(step) * 0.25),
        2 => any::<f32>(),
        1 => prop::sample::select(NASTY.to_vec()),
    ]
}

fn any_boxes() -> impl Strategy<Value = Vec<Aabb3>> {
    let sides = prop::array::uniform6(coordinate());
    let one = sides.prop_map(|[a, b, c, d, e, f]| Aabb3::new(Vec3::new(a, b, c), Vec3::new(d, e, f)));
    prop::collection::vec(one, 0..40)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        rng_seed: RngSeed::Fixed(0xB0C5),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn overlaps_of_any_boxes(boxes in any_boxes()) {
        check_all(&boxes, &boxes);
        let sorted: Vec<Aabb2> = boxes.iter().map(flat).map(|b| Aabb2::new(b.min.min(b.max), b.min.max(b.max))).collect();
        check_all(&sorted, &sorted);
    }
}
