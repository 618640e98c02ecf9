//! Tests of both ways of sweeping, each forced where counts would choose the other.

use super::segments::{Item, Key, Segments, Slab, in_order};
use super::trial::{Way, steps_of};
use crate::{CoherentSweep, PairId, PlainSweep, Sweep, TooManyPairs};
use asunder_geometry::glam::Vec3;
use asunder_geometry::{Aabb2, Aabb3, Bounds};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_scenes::hurt::HurtScene;
use asunder_scenes::random::Random;
use core::ops::ControlFlow;
use proptest::prelude::*;

const FORCED: [Way; 2] = [Way::Segments, Way::SegmentsInColumns];

fn flat(boxes: &[Aabb3]) -> Vec<Aabb2> {
    boxes.iter().map(|one| Aabb2::new(one.min.truncate(), one.max.truncate())).collect()
}

fn double_loop<B: Bounds>(boxes: &[B], admit: impl Fn(u32, u32) -> bool) -> Vec<PairId> {
    let all = (0..boxes.len() as u32).flat_map(|a| (a + 1..boxes.len() as u32).map(move |b| PairId { a, b }));
    all.filter(|pair| boxes[pair.a as usize].overlaps(&boxes[pair.b as usize]) && admit(pair.a, pair.b))
        .collect()
}

/// Checks the lists of sweeps by segments, as a whole and within columns.
fn check<B: Bounds>(
    sweep: &mut Sweep,
    boxes: &[B],
    admit: impl Fn(u32, u32) -> bool + Sync,
    expected: &[PairId],
) {
    for way in FORCED {
        let mut pairs = Vec::new();
        steps_of(way, || sweep.pairs(boxes, &admit, usize::MAX, &mut pairs).unwrap());
        assert!(pairs == expected, "{way:?}: {} pairs in place of {}", pairs.len(), expected.len());
    }
}

fn check_against_plain<B: Bounds>(sweep: &mut Sweep, boxes: &[B]) -> usize {
    let (admit, mut expected) = (|a: u32, b: u32| !(a ^ b).is_multiple_of(7), Vec::new());
    PlainSweep::new().pairs(boxes, admit, usize::MAX, &mut expected).unwrap();
    check(sweep, boxes, admit, &expected);
    expected.len()
}

#[test]
fn segments_have_the_pairs_of_the_plain_sweep_in_every_scene() {
    let mut sweep = Sweep::new();
    for count in [2, 60, 300, 3000] {
        let named = BoxScene::ALL.map(|scene| MovingBoxes::new(scene, count, 5).boxes);
        let hurting = HurtScene::ALL.map(|scene| scene.boxes(count, 5));
        let mut pairs = 0;
        for boxes in named.into_iter().chain(hurting) {
            pairs += check_against_plain(&mut sweep, &boxes);
            check_against_plain(&mut sweep, &flat(&boxes));
        }
        assert!(count < 300 || pairs > 2 * count, "{pairs} pairs");
    }
}

/// Problematic coordinates, few enough to be equal often.
const NASTY: [f32; 16] = [
    f32::NAN,
    f32::NEG_INFINITY,
    f32::MIN,
    -1e30,
    -1.0,
    -f32::MIN_POSITIVE,
    -1e-45,
    -0.0,
    0.0,
    1e-45,
    f32::MIN_POSITIVE,
    1.0,
    1.000_000_1,
    1e30,
    f32::MAX,
    f32::INFINITY,
];

#[test]
fn segments_take_nasty_boxes_as_the_definition_does() {
    let (mut random, mut sweep, mut pairs) = (Random::new(710), Sweep::new(), 0);
    for round in 0..200 {
        let skip = usize::from(round % 10 != 0);
        let mut corner = || Vec3::from_array([0; 3].map(|_| NASTY[skip + random.below(NASTY.len() - skip)]));
        // More than are compared without a cut; every fourth may stay inverted.
        let boxes: Vec<Aabb3> = (0..200)
            .map(|i| (i, corner(), corner()))
            .map(|(i, p, q)| if i % 4 == 0 { Aabb3::new(p, q) } else { Aabb3::new(p.min(q), p.max(q)) })
            .collect();
        let admit = |a: u32, b: u32| !(a ^ b).is_multiple_of(3);
        let expected = double_loop(&boxes, admit);
        pairs += expected.len();
        check(&mut sweep, &boxes, admit, &expected);
        let flat = flat(&boxes);
        check(&mut sweep, &flat, admit, &double_loop(&flat, admit));
    }
    assert!(pairs > 200_000, "{pairs} pairs");
}

#[test]
fn identical_boxes_cost_segments_no_more_than_their_pairs() {
    for boxes in [[Aabb3::new(Vec3::ZERO, Vec3::ONE); 2000], [Aabb3::new(Vec3::ONE, Vec3::ONE); 2000]] {
        let all = 2000 * 1999 / 2;
        let mut pairs = Vec::new();
        let steps = steps_of(Way::Segments, || {
            Sweep::new().pairs(&boxes, |_, _| true, usize::MAX, &mut pairs).unwrap();
        });
        assert!(pairs.len() == all && pairs.is_sorted(), "{} pairs", pairs.len());
        assert!(steps < all, "{steps} steps for {all} pairs");
    }
}

#[test]
fn segments_ask_the_filter_once_and_keep_to_limits() {
    let boxes = HurtScene::Halves.boxes(2000, 3);
    let all = double_loop(&boxes, |_, _| true);
    for way in FORCED {
        steps_of(way, || {
            let asked = core::sync::atomic::AtomicUsize::new(0);
            let mut pairs = vec![PairId { a: 0, b: 1 }];
            let admit = |a, b| {
                asked.fetch_add(1, core::sync::atomic::Ordering::Relaxed);
                all.binary_search(&PairId { a, b }).is_ok()
            };
            let mut sweep = Sweep::new();
            assert_eq!(sweep.pairs(&boxes, admit, all.len(), &mut pairs), Ok(()));
            assert_eq!((asked.into_inner(), &pairs), (all.len(), &all), "{way:?}");
            let limit = all.len() - 1;
            assert_eq!(sweep.pairs(&boxes, |_, _| true, limit, &mut pairs), Err(TooManyPairs { limit }));
            assert!(pairs.is_empty());
            let mut seen = 0;
            let flow = sweep.visit(
                &boxes,
                |_, _| true,
                |_| {
                    seen += 1;
                    if seen == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                },
            );
            assert!(flow.is_break() && seen == 5, "{way:?}: {seen}");
        });
    }
}

/// However space is cut, each pair is in exactly one slab.
#[test]
fn slabs_have_all_pairs_once() {
    let mut boxes = HurtScene::Halves.boxes(1000, 4);
    boxes.extend([Aabb3::new(Vec3::ZERO, Vec3::ONE); 100]);
    boxes.push(Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY));
    let items = || (0..).zip(&boxes).filter_map(|(place, one)| Item::new(one, place));
    let mut keys: Vec<Key> = items().map(|item| item.key(1)).collect();
    keys.sort_unstable_by(in_order);
    for every in [1, 50, 333, 2000] {
        let mut cuts: Vec<Key> = keys.iter().copied().step_by(every).collect();
        cuts[0] = Slab::ALL.start;
        cuts.push(Slab::ALL.end);
        let (mut segments, mut pairs) = (Segments::default(), Vec::new());
        for ends in cuts.windows(2) {
            let slab = Slab { start: ends[0], end: ends[1] };
            let _ = segments.sweep(items(), (&[1, 2, 0], slab), &mut |one, other| {
                pairs.push(PairId::new(one, other));
                ControlFlow::Continue(())
            });
        }
        pairs.sort_unstable();
        assert!(pairs == double_loop(&boxes, |_, _| true), "a cut every {every}");
    }
}

/// Steps and pairs of a sweep, per box.
fn steps(scene: HurtScene, count: usize, way: Way) -> f64 {
    let boxes = scene.boxes(count, 1);
    let mut pairs = 0;
    let steps = steps_of(way, || {
        let _ = Sweep::new().visit(
            &boxes,
            |_, _| true,
            |_| {
                pairs += 1;
                ControlFlow::Continue(())
            },
        );
    });
    (steps + pairs) as f64 / count as f64
}

/// Whether the steps per box are few in relation to the squared logarithm of the number of boxes, and, unless they are
/// very few, grow no faster than that from n to 4 n boxes (with two fifths of slack for counts that fall on either side
/// of a threshold).
fn is_bounded(scene: HurtScene, count: usize, way: Way) -> bool {
    let share =
        [count, 4 * count].map(|count| steps(scene, count, way) / f64::from(count.ilog2() * count.ilog2()));
    let [one, four] = share;
    one < 2.0 && four < 2.0 && (four < 0.4 || four < 1.4 * one)
}

#[test]
fn boxes_that_hurt_cost_little_more_each_where_there_are_more_of_them() {
    for scene in HurtScene::ALL {
        assert!(is_bounded(scene, 100_000, Way::ByCounts), "{}", scene.name());
    }
}

#[test]
fn columns_alone_would_not_do_for_them() {
    for scene in [HurtScene::Needles, HurtScene::Halves, HurtScene::Quarters] {
        assert!(!is_bounded(scene, 20_000, Way::Columns), "columns alone would do for {}", scene.name());
    }
}

/// Movers that reach very many boxes at rest are not looked up one by one.
#[test]
fn what_moves_among_boxes_that_hurt_costs_no_more_than_a_sweep_of_all() {
    // Steps are counted per thread, and so many boxes would be shared among all threads.
    #[cfg(feature = "parallel")]
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(check_what_moves);
    #[cfg(not(feature = "parallel"))]
    check_what_moves();
}

fn check_what_moves() {
    for scene in HurtScene::ALL {
        let mut boxes = scene.boxes(20_000, 1);
        let (mut coherent, mut pairs, mut expected) = (CoherentSweep::new(), Vec::new(), Vec::new());
        let moved: Vec<u32> = (0..20_000).step_by(6).collect();
        for frame in 0..4 {
            // Boxes swap places in pairs.
            moved.chunks_exact(2).for_each(|two| boxes.swap(two[0] as usize, two[1] as usize));
            let steps = steps_of(Way::ByCounts, || {
                coherent.update(&boxes, &moved, |_, _| true, usize::MAX, &mut pairs).unwrap();
            });
            let all = steps_of(Way::ByCounts, || {
                Sweep::new().pairs(&boxes, |_, _| true, usize::MAX, &mut expected).unwrap();
            });
            assert!(pairs == expected, "{} frame {frame}", scene.name());
            assert!(steps < all * 5 / 2, "{} frame {frame}: {steps} steps, {all} for all", scene.name());
        }
    }
}

#[test]
fn needles_are_swept_by_segments_and_gas_is_not() {
    let held = |boxes: &[Aabb3]| {
        let mut sweep = Sweep::new();
        let _ = sweep.visit(boxes, |_, _| true, |_| ControlFlow::Continue(()));
        sweep.scratch.bytes_of_segments()
    };
    assert!(held(&HurtScene::Needles.boxes(100_000, 1)) >= 64 * 100_000);
    for scene in BoxScene::ALL {
        assert_eq!(held(&MovingBoxes::new(scene, 20_000, 1).boxes), 0, "{}", scene.name());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn segments_have_the_pairs_of_a_double_loop(
        corners in prop::collection::vec(prop::array::uniform6(-6_i8..6), 0..200),
    ) {
        let boxes: Vec<Aabb3> = corners
            .iter()
            .map(|corners| corners.map(|step| f32::from(step) * 0.25))
            .map(|[a, b, c, d, e, f]| (Vec3::new(a, b, c), Vec3::new(d, e, f).abs()))
            .map(|(low, size)| Aabb3::new(low, low + size))
            .collect();
        check(&mut Sweep::new(), &boxes, |_, _| true, &double_loop(&boxes, |_, _| true));
    }
}
