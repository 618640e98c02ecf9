//! Boxes crossed by rays and moving boxes, and nearest boxes: against f64, with the promised errors.

use super::{any_boxes, clusters, everything, flat, nasty_boxes, random_box3, two_of_three};
use asunder_broad::{Cast, Found, Index, Queue};
use asunder_geometry::{Aabb2, Aabb3, Bounds, Ray2, Ray3};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_tests::brute_pairs::Sides;
use asunder_tests::cases::Random;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// A moving box: its sides, its direction, and how far.
struct Moved {
    sides: Vec<(f64, f64)>,
    along: Vec<f32>,
    limit: f64,
}

/// How much a distance may fall short, relative to itself: four roundings to f32 of 6e-8, and twice 2.4e-7 that are
/// subtracted.
const SHORT: f64 = 1e-6;

impl Moved {
    /// The interval in which a box is hit, in f64; unbounded along an axis on which it is touched all the way.
    fn meets<B: Sides>(&self, other: &B) -> Option<(f64, f64)> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for ((&(low, high), &along), (least, most)) in self.sides.iter().zip(&self.along).zip(other.sides()) {
            let (least, most, along) = (f64::from(least), f64::from(most), f64::from(along));
            // `min` and `max` skip the NaN of two equal infinities.
            if along == 0.0 {
                if low > most || high < least {
                    return None;
                }
            } else {
                let ends = [(least - high) / along, (most - low) / along];
                let (first, last) = if along > 0.0 { (ends[0], ends[1]) } else { (ends[1], ends[0]) };
                (enter, leave) = (enter.max(first), leave.min(last));
            }
        }
        Some((enter, leave))
    }

    /// Asserts that all boxes that are hit are found, and none that is missed by more than rounding, each once, in
    /// order.
    fn check<B: Bounds + Sides>(&self, boxes: &[B], keep: fn(u32) -> bool, found: &[Found]) {
        assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by number: {found:?}");
        let mut by_number = vec![None; boxes.len()];
        for one in found {
            assert!(by_number[one.number as usize].replace(one.distance).is_none(), "{} twice", one.number);
        }
        // For a direction of length 1, distances end at the largest f32.
        let longest = self.along.iter().fold(0.0_f64, |most, &part| most.max(f64::from(part).abs()));
        let end = if longest > 0.0 { self.limit.min(1e38 / longest) } else { self.limit };
        // Numbers too small for f32.
        let tiny = if longest > 0.0 { 1e-44 / longest } else { 0.0 };
        for ((number, one), told) in (0_u32..).zip(boxes).zip(by_number) {
            let truth = self.meets(one).filter(|_| one.is_valid() && keep(number));
            let Some(told) = told else {
                let is_missed = truth.is_none_or(|(enter, leave)| enter > leave || enter > end);
                assert!(is_missed, "lost {one:?}, met at {truth:?}");
                continue;
            };
            let Some((enter, leave)) = truth else { panic!("{one:?} is not there, or beside the line") };
            assert!(
                enter <= leave * (1.0 + SHORT) + tiny && enter <= self.limit * (1.0 + SHORT) + tiny,
                "{one:?}: {truth:?}"
            );
            assert!(told <= enter + tiny && told >= enter * (1.0 - SHORT) - tiny, "{told} told for {enter}");
        }
    }
}

/// Compares a cast with the loop, in all its forms; returns how many boxes it crosses.
fn check_cast<B: Bounds + Sides>(
    index: &Index<B>,
    boxes: &[B],
    keep: fn(u32) -> bool,
    cast: &Cast,
    moved: &Moved,
) -> usize {
    let mut found = vec![Found { distance: 1.0, number: 1 }];
    index.crossed(cast, moved.limit, &mut found);
    moved.check(boxes, keep, &found);
    let (mut queue, mut in_order) = (Queue::new(), Vec::new());
    index.crossed_in_order(cast, moved.limit, &mut queue, |one| {
        in_order.push(one);
        moved.limit
    });
    assert_eq!(in_order, found);
    // From the middle one on, nothing beyond it is wanted.
    if let Some(&middle) = found.get(found.len() / 2) {
        in_order.clear();
        index.crossed_in_order(cast, moved.limit, &mut queue, |one| {
            in_order.push(one);
            if one.distance < middle.distance { moved.limit } else { middle.distance }
        });
        let wanted = found.partition_point(|one| one.distance <= middle.distance);
        assert!(in_order.len() >= wanted && in_order == found[..in_order.len()], "{in_order:?} of {found:?}");
        let last = in_order[in_order.len() - 1].distance;
        assert!(last <= middle.distance * (1.0 + SHORT), "went on to {last} after {middle:?}");
        in_order.clear();
        index.crossed_in_order(cast, moved.limit, &mut queue, |one| {
            in_order.push(one);
            -1.0
        });
        assert_eq!(in_order, found[..1]);
    }
    found.len()
}

fn direction(random: &mut Random) -> Vec3 {
    let along = Vec3::from_array([0; 3].map(|_| random.between(-1.0, 1.0) as f32));
    // Some along an axis or in a coordinate plane, some short, some long.
    let parts = Vec3::from_array([0; 3].map(|_| [1.0, 1.0, 1.0, 0.0, -0.0][random.below(5)]));
    along * parts * [1.0, 1.0, 1e-30, 1e20, 1e-42][random.below(5)]
}

/// Rays and moving boxes that start among the boxes, and up to half as far again around them.
fn check_casts(random: &mut Random, boxes: &[Aabb3], starts: &[Aabb3]) -> usize {
    let boxes2: Vec<Aabb2> = boxes.iter().map(flat).collect();
    let (mut index, mut index2) = (Index::new(), Index::new());
    let mut found = 0;
    for (number, start) in starts.iter().enumerate() {
        let keep = [everything, two_of_three][number % 2];
        if number < 2 || starts.len() < 100 {
            index.build_from(boxes, keep);
            index2.build_from(&boxes2, keep);
        } else if number % 2 == 0 {
            continue;
        }
        let along = direction(random);
        let reach = f64::from(along.length()).max(1e-44);
        let limit = [f64::INFINITY, 0.0, random.between(0.0, 2.0) / reach][random.below(3)];
        let sides = |count: usize| {
            start.sides()[..count].iter().map(|&(a, b)| (f64::from(a), f64::from(b))).collect()
        };
        let moved =
            |count: usize| Moved { sides: sides(count), along: along.to_array()[..count].to_vec(), limit };
        let flat_along = along.truncate();
        if start.is_valid() {
            found += check_cast(&index, boxes, keep, &Cast::of_box3(start, along), &moved(3));
            found += check_cast(&index2, &boxes2, keep, &Cast::of_box2(&flat(start), flat_along), &moved(2));
        }
        let ray =
            |moved: Moved| Moved { sides: moved.sides.iter().map(|&(low, _)| (low, low)).collect(), ..moved };
        if let Ok(cast) = Ray3::new(start.min, along) {
            found += check_cast(&index, boxes, keep, &cast.into(), &ray(moved(3)));
        }
        if let Ok(cast) = Ray2::new(start.min.truncate().as_dvec2(), flat_along) {
            found += check_cast(&index2, &boxes2, keep, &cast.into(), &ray(moved(2)));
        }
    }
    found
}

#[test]
fn casts_through_random_boxes() {
    let mut random = Random::new(820);
    let mut found = 0;
    for size in [0.0, 0.002, 0.05, 0.4] {
        for room in [Vec3::ONE, Vec3::new(1.0, 0.02, 1.0), Vec3::new(0.01, 0.01, 5.0)] {
            let boxes: Vec<_> = (0..400).map(|_| random_box3(&mut random, room, size)).collect();
            let starts: Vec<_> = (0..90).map(|_| random_box3(&mut random, room * 1.5, size)).collect();
            found += check_casts(&mut random, &boxes, &starts);
        }
    }
    assert!(found > 20_000, "{found}");
}

#[test]
fn casts_through_every_scene() {
    let mut random = Random::new(821);
    let mut found = 0;
    for scene in BoxScene::ALL {
        for count in [0, 1, 2, 9, 1000] {
            let boxes = MovingBoxes::new(scene, count, 3).boxes;
            let starts: Vec<_> = boxes.iter().step_by(count / 30 + 1).copied().collect();
            found += check_casts(&mut random, &boxes, &starts);
        }
    }
    assert!(found > 5_000, "{found}");
}

#[test]
fn casts_through_nasty_boxes() {
    let mut random = Random::new(822);
    let mut found = 0;
    for round in 0..60 {
        let boxes = nasty_boxes(&mut random, round);
        found += check_casts(&mut random, &boxes, &boxes);
    }
    found += {
        let boxes = clusters(&mut random);
        check_casts(&mut random, &boxes, &boxes[..150])
    };
    assert!(found > 20_000, "{found}");
}

#[test]
fn a_ray_that_touches_is_not_lost() {
    let mut random = Random::new(823);
    let mut index = Index::new();
    let mut hits = Vec::new();
    for _ in 0..3000 {
        // Towards a corner of a box, or a point on an edge, from an origin that f32 may not represent.
        let one = random_box3(&mut random, Vec3::splat(3.0), 0.5);
        let along = Vec3::from_array([0; 3].map(|_| random.between(-2.0, 2.0) as f32));
        let corner = DVec3::new(f64::from(one.min.x), f64::from(one.max.y), f64::from(one.min.z));
        let ahead = random.between(0.1, 3.0);
        index.build(&[one]);
        let ray = Ray3::new(corner - along.as_dvec3() * ahead, along).unwrap();
        index.crossed(&ray.into(), ahead * (1.0 + 1e-14), &mut hits);
        assert_eq!(hits.len(), 1, "{one:?} from {ray:?}");
        // One side of the box exactly in a plane with the ray.
        let level = Ray3::new([-9.0, f64::from(one.max.y), f64::from(one.min.z)], Vec3::X).unwrap();
        index.crossed(&level.into(), 20.0, &mut hits);
        assert_eq!(hits.len(), 1, "{one:?} from {level:?}");
        let beside =
            Ray3::new([-9.0, f64::from(one.max.y.next_up()), f64::from(one.min.z)], Vec3::X).unwrap();
        index.crossed(&beside.into(), 20.0, &mut hits);
        assert_eq!(hits, [], "along an axis, one rounding parts them");
    }
}

/// In small integers, where only quotients are rounded: a line that touches a corner, entering and leaving at once.
#[test]
fn a_line_through_a_corner_is_not_lost() {
    let mut random = Random::new(824);
    let mut index = Index::new();
    let mut hits = Vec::new();
    for _ in 0..5000 {
        let along = Vec3::from_array([0; 3].map(|_| (1 + random.below(99)) as f32));
        let start = Vec3::from_array([0; 3].map(|_| random.below(1000) as f32));
        let steps = (1 + random.below(99)) as f32;
        let corner = start + along * steps;
        let low = Vec3::new(corner.x, corner.y - 50_000.0, corner.z - 50_000.0);
        index.build(&[Aabb3::new(low, Vec3::new(corner.x + 50_000.0, corner.y, corner.z))]);
        for cast in [Cast::of_box3(&Aabb3::new(start, start), along), Ray3::new(start, along).unwrap().into()]
        {
            index.crossed(&cast, f64::from(steps), &mut hits);
            assert_eq!(hits.len(), 1, "{along:?} from {start:?}, {steps} steps");
            let back = Cast::of_box3(&Aabb3::new(corner + along, corner + along), -along);
            index.crossed(&back, 1.0, &mut hits);
            assert_eq!(hits.len(), 1, "back");
        }
    }
}

#[test]
fn bad_casts_meet_nothing_and_bad_limits_end_them() {
    let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
    let mut index = Index::new();
    index.build(&[unit; 20]);
    let found = |cast: &Cast, limit: f64| {
        let mut found = Vec::new();
        index.crossed(cast, limit, &mut found);
        found.len()
    };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(found(&Cast::of_box3(&unit, Vec3::new(0.0, bad, 1.0)), 1.0), 0);
    }
    assert_eq!(found(&Cast::of_box3(&Aabb3::NOTHING, Vec3::X), 1.0), 0);
    let good = Cast::of_box3(&unit, Vec3::X);
    for (limit, expected) in
        [(f64::NAN, 0), (-1.0, 0), (-0.0, 20), (0.0, 20), (1e300, 20), (f64::INFINITY, 20)]
    {
        assert_eq!(found(&good, limit), expected, "limit {limit}");
    }
    let mut seen = Vec::new();
    index.crossed_in_order(&good, 1.0, &mut Queue::new(), |one| {
        seen.push(one.number);
        if seen.len() < 5 { 1.0 } else { f64::NAN }
    });
    assert_eq!(seen, [0, 1, 2, 3, 4], "equal distances go by number");
    let outcome = index.visit_crossed(&good, 1.0, |_| ControlFlow::Break(()));
    assert!(outcome.is_break());
}

/// Distance of two boxes, in f64.
fn gap<B: Sides>(one: &B, other: &B) -> f64 {
    let on = |(p, q): (&(f32, f32), &(f32, f32))| {
        let gap = (f64::from(p.0) - f64::from(q.1)).max(f64::from(q.0) - f64::from(p.1)).max(0.0);
        gap * gap
    };
    one.sides().iter().zip(&other.sides()).map(on).sum::<f64>().sqrt()
}

/// Checks all boxes in order of distance from one, and any number of the first of them; returns how many.
fn check_nearest<B: Bounds + Sides>(
    index: &Index<B>,
    boxes: &[B],
    keep: fn(u32) -> bool,
    to: &B,
    limit: f64,
) -> usize {
    let (mut queue, mut found) = (Queue::new(), Vec::new());
    index.nearest(to, usize::MAX, &mut queue, &mut found);
    assert!(found.windows(2).all(|pair| pair[0] < pair[1]), "by distance, then by number: {found:?}");
    let mut numbers: Vec<u32> = found.iter().map(|one| one.number).collect();
    numbers.sort_unstable();
    let there = (0..boxes.len() as u32).filter(|&i| to.is_valid() && keep(i) && boxes[i as usize].is_valid());
    assert_eq!(numbers, there.collect::<Vec<_>>());
    for &Found { distance, number } in &found {
        let truth = gap(to, &boxes[number as usize]);
        assert!(distance <= truth, "{distance} told for {truth}");
        let counts = if truth < 1.1e-19 { 0.0 } else { truth.min(1.8e19) };
        assert!(distance >= counts * (1.0 - SHORT), "{distance} told for {truth}");
    }
    let mut some = Vec::new();
    for count in [0, 1, 2, 7, found.len()] {
        index.nearest(to, count, &mut queue, &mut some);
        assert_eq!(some, found[..count.min(found.len())]);
    }
    some.clear();
    index.nearest_in_order(to, limit, &mut queue, |one| {
        some.push(one);
        limit
    });
    let [sure, possible] = [limit, limit * (1.0 + SHORT) + 1.1e-19]
        .map(|limit| found.partition_point(|one| one.distance <= limit));
    assert!(
        some == found[..some.len()] && (sure..=possible).contains(&some.len()),
        "{} within {limit}",
        some.len()
    );
    // The first box as far away as the third ends it.
    if let Some(third) = found.get(2) {
        some.clear();
        index.nearest_in_order(to, f64::INFINITY, &mut queue, |one| {
            some.push(one);
            if one.distance < third.distance { f64::INFINITY } else { third.distance }
        });
        assert!(
            some == found[..some.len()]
                && some.len() >= found.partition_point(|one| one.distance <= third.distance)
        );
    }
    found.len()
}

fn check_all_nearest(boxes: &[Aabb3], asked: &[Aabb3]) -> usize {
    let boxes2: Vec<Aabb2> = boxes.iter().map(flat).collect();
    let (mut index, mut index2) = (Index::new(), Index::new());
    let mut found = 0;
    for keep in [everything, two_of_three] {
        index.build_from(boxes, keep);
        index2.build_from(&boxes2, keep);
        for (to, limit) in asked.iter().zip([0.3, 0.0, 2.0, 50.0].into_iter().cycle()) {
            let point = Aabb3::new(to.min, to.min);
            found += check_nearest(&index, boxes, keep, to, limit);
            found += check_nearest(&index, boxes, keep, &point, limit);
            found += check_nearest(&index2, &boxes2, keep, &flat(to), limit);
        }
    }
    found
}

#[test]
fn nearest_of_random_boxes_scenes_and_nasty_boxes() {
    let mut random = Random::new(830);
    let mut found = 0;
    for size in [0.0, 0.01, 0.3] {
        let boxes: Vec<_> = (0..300).map(|_| random_box3(&mut random, Vec3::ONE, size)).collect();
        let asked: Vec<_> = (0..40).map(|_| random_box3(&mut random, Vec3::splat(1.5), size)).collect();
        found += check_all_nearest(&boxes, &asked);
    }
    for scene in BoxScene::ALL {
        for count in [0, 1, 2, 9, 600] {
            let boxes = MovingBoxes::new(scene, count, 3).boxes;
            let asked: Vec<_> = boxes.iter().step_by(count / 10 + 1).copied().collect();
            found += check_all_nearest(&boxes, &asked);
        }
    }
    for round in 0..40 {
        let boxes = nasty_boxes(&mut random, round);
        found += check_all_nearest(&boxes, &boxes[..20]);
    }
    let boxes = clusters(&mut random);
    found += check_all_nearest(&boxes, &boxes[..300]);
    assert!(found > 100_000, "{found}");
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        rng_seed: RngSeed::Fixed(0xB0C6),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn casts_and_nearest_of_any_boxes(boxes in any_boxes(), seed in 0_u64..1000) {
        check_casts(&mut Random::new(seed.into()), &boxes, &boxes);
        check_all_nearest(&boxes, &boxes[..boxes.len().min(8)]);
    }
}
