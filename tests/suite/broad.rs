//! The broad phase against a double loop: random boxes, nasty boxes, filters, and limits.

use asunder_broad::{CoherentSweep, PairId, PlainSweep, Sweep, TooManyPairs};
use asunder_geometry::{Aabb2, Aabb3, Bounds};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_scenes::hurt::HurtScene;
use asunder_tests::brute_pairs::{Sides, brute_pairs};
use asunder_tests::cases::{NASTY, Random};
use core::ops::ControlFlow;
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::Mutex;

fn swept<B: Bounds>(boxes: &[B], admit: impl Fn(u32, u32) -> bool + Sync) -> Vec<(u32, u32)> {
    let mut pairs = vec![PairId { a: 7, b: 9 }];
    Sweep::new().pairs(boxes, admit, usize::MAX, &mut pairs).unwrap();
    pairs.iter().map(|pair| (pair.a, pair.b)).collect()
}

/// Asserts that list and visitor give the pairs of the double loop, with and without a filter; returns how many.
fn check<B: Bounds + Sides>(boxes: &[B]) -> usize {
    let everything = brute_pairs(boxes, |_, _| true);
    assert_eq!(swept(boxes, |_, _| true), everything);
    let admit = |a: u32, b: u32| !(a ^ b).is_multiple_of(3);
    let filtered = brute_pairs(boxes, admit);
    // The filter is called with the lower number first, and only for boxes that overlap.
    let asked = |a: u32, b: u32| {
        assert!(everything.binary_search(&(a, b)).is_ok(), "asked about {a}, {b}, which are apart");
        admit(a, b)
    };
    assert_eq!(swept(boxes, asked), filtered);
    let mut plain = Vec::new();
    PlainSweep::new().pairs(boxes, admit, usize::MAX, &mut plain).unwrap();
    assert!(plain.iter().map(|pair| (pair.a, pair.b)).eq(filtered.iter().copied()), "the definition");
    let mut visited = Vec::new();
    let outcome = Sweep::new().visit(boxes, admit, |pair| {
        visited.push((pair.a, pair.b));
        ControlFlow::Continue(())
    });
    assert!(outcome.is_continue());
    visited.sort_unstable();
    assert_eq!(visited, filtered, "each pair once to the visitor");
    everything.len()
}

fn random_box3(random: &mut Random, room: Vec3, size: f64) -> Aabb3 {
    let center = random.vector().as_vec3() * room;
    let half = Vec3::from_array([0; 3].map(|_| random.between(0.0, size) as f32));
    Aabb3::new(center - half, center + half)
}

fn random_box2(random: &mut Random, room: Vec2, size: f64) -> Aabb2 {
    let flat = random_box3(random, room.extend(0.0), size);
    Aabb2::new(flat.min.truncate(), flat.max.truncate())
}

#[test]
fn random_boxes_of_every_density() {
    let mut random = Random::new(700);
    let mut counts = Vec::new();
    for size in [0.002, 0.02, 0.1, 0.5, 2.0] {
        // Cubic rooms, a flat one, and a shaft: each of the three axes is the widest once.
        for room in [Vec3::ONE, Vec3::new(1.0, 0.02, 1.0), Vec3::new(0.01, 0.01, 5.0), Vec3::X, Vec3::Y] {
            let boxes: Vec<_> = (0..500).map(|_| random_box3(&mut random, room, size)).collect();
            counts.push(check(&boxes));
            let boxes: Vec<_> = (0..500)
                .map(|_| random_box2(&mut random, room.truncate() + Vec2::splat(0.01), size))
                .collect();
            counts.push(check(&boxes));
        }
    }
    let all_pairs = 500 * 499 / 2;
    assert!(counts.iter().any(|&count| count < 20), "sparse: {counts:?}");
    assert!(counts.iter().any(|&count| count > all_pairs * 9 / 10), "dense: {counts:?}");
}

#[test]
fn nasty_boxes() {
    let mut random = Random::new(701);
    let mut pairs = 0;
    for round in 0..400 {
        // NaN in every tenth round only, or few valid boxes would be left.
        let skip = usize::from(round % 10 != 0);
        let mut corner = || Vec3::from_array([0; 3].map(|_| NASTY[skip + random.below(NASTY.len() - skip)]));
        let boxes: Vec<Aabb3> = (0..60)
            .map(|i| {
                let (p, q) = (corner(), corner());
                // Every fourth box may be inverted.
                if i % 4 == 0 { Aabb3::new(p, q) } else { Aabb3::new(p.min(q), p.max(q)) }
            })
            .collect();
        pairs += check(&boxes);
        let flat: Vec<Aabb2> = boxes.iter().map(|b| Aabb2::new(b.min.truncate(), b.max.truncate())).collect();
        pairs += check(&flat);
    }
    assert!(pairs > 100_000, "{pairs} pairs");
}

#[test]
fn no_box_one_box_two_boxes() {
    let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
    assert_eq!(swept::<Aabb3>(&[], |_, _| true), []);
    assert_eq!(swept(&[unit], |_, _| true), []);
    assert_eq!(swept(&[unit, unit], |_, _| true), [(0, 1)]);
    let beside = Aabb3::new(Vec3::new(1.0, 0.0, 0.0), Vec3::new(2.0, 1.0, 1.0));
    assert_eq!(swept(&[beside, unit], |_, _| true), [(0, 1)], "touching counts");
    let mut apart = beside;
    apart.min.x = 1.0_f32.next_up();
    assert_eq!(swept(&[apart, unit], |_, _| true), [], "one rounding parts them");
}

#[test]
fn identical_touching_and_flat_boxes() {
    let unit = Aabb2::new(Vec2::ZERO, Vec2::ONE);
    assert_eq!(check(&[unit; 100]), 100 * 99 / 2, "identical boxes all meet");
    let point = Aabb2::new(Vec2::ONE, Vec2::ONE);
    assert_eq!(check(&[point; 50]), 50 * 49 / 2, "so do points");
    let grid: Vec<Aabb3> = (0..1000)
        .map(|i| {
            let low = Vec3::new((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32);
            Aabb3::new(low, low + Vec3::ONE)
        })
        .collect();
    // Cells touch if they are at most one step apart on every axis: 28 of 100 ordered pairs per axis, including equal
    // ones.
    assert_eq!(check(&grid), (28_usize.pow(3) - 1000) / 2);
    let segments: Vec<Aabb2> =
        (0..100).map(|i| Aabb2::new(Vec2::new(i as f32, 0.0), Vec2::new(i as f32 + 1.0, 0.0))).collect();
    assert_eq!(check(&segments), 99, "a chain of flat boxes");
}

#[test]
fn too_many_pairs_is_an_error_and_leaves_nothing() {
    let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 20];
    let count = 20 * 19 / 2;
    let mut sweep = Sweep::new();
    let mut pairs = vec![PairId { a: 0, b: 1 }];
    let mut limited = |limit: usize| {
        let outcome = sweep.pairs(&boxes, |_, _| true, limit, &mut pairs);
        (outcome, pairs.len())
    };
    for limit in [0, 1, count - 1] {
        assert_eq!(limited(limit), (Err(TooManyPairs { limit }), 0));
    }
    assert_eq!(limited(count), (Ok(()), count), "the limit itself is allowed");
    // Pairs that the filter drops do not count.
    let kept = sweep.pairs(&boxes, |a, _| a == 0, 19, &mut pairs);
    assert_eq!((kept, pairs.len()), (Ok(()), 19));
}

#[test]
fn a_visitor_may_break_off() {
    let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 20];
    let mut seen = 0;
    let outcome = Sweep::new().visit(
        &boxes,
        |_, _| true,
        |_| {
            seen += 1;
            if seen == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    assert!(outcome.is_break() && seen == 5);
}

/// Scratch memory carries no history: after any other boxes, the answer is that of a new sweep.
#[test]
fn a_sweep_remembers_nothing() {
    let mut random = Random::new(702);
    let mut sweep = Sweep::new();
    let mut pairs = Vec::new();
    for count in [300, 2, 0, 150, 1, 299] {
        let boxes: Vec<_> = (0..count).map(|_| random_box3(&mut random, Vec3::ONE, 0.2)).collect();
        sweep.pairs(&boxes, |_, _| true, usize::MAX, &mut pairs).unwrap();
        let found: Vec<_> = pairs.iter().map(|pair| (pair.a, pair.b)).collect();
        assert_eq!(found, brute_pairs(&boxes, |_, _| true));
    }
}

/// Asserts that both sweeps give the same pairs; the double loop would take too long.
fn same_as_plain<B: Bounds>(sweep: &mut Sweep, boxes: &[B], what: &str) -> usize {
    let (mut pairs, mut plain) = (Vec::new(), Vec::new());
    sweep.pairs(boxes, |a, b| (a ^ b) % 7 != 0, usize::MAX, &mut pairs).unwrap();
    PlainSweep::new().pairs(boxes, |a, b| (a ^ b) % 7 != 0, usize::MAX, &mut plain).unwrap();
    assert!(pairs == plain, "{what}: {} pairs, the plain sweep has {}", pairs.len(), plain.len());
    pairs.len()
}

#[test]
fn every_scene_has_the_pairs_of_the_plain_sweep_in_every_frame() {
    let mut sweep = Sweep::new();
    for scene in BoxScene::ALL {
        for count in [300, 3000] {
            let mut moving = MovingBoxes::new(scene, count, 5);
            for frame in 0..4 {
                moving.step();
                let found =
                    same_as_plain(&mut sweep, &moving.boxes, &format!("{} {count} {frame}", scene.name()));
                assert!(found > 0 || scene == BoxScene::Still, "{}", scene.name());
                let flat: Vec<Aabb2> =
                    moving.boxes.iter().map(|b| Aabb2::new(b.min.truncate(), b.max.truncate())).collect();
                same_as_plain(&mut sweep, &flat, scene.name());
            }
        }
    }
}

/// Clusters of clusters of clusters, giants among crumbs, all on one spot, all at one height: the worst cases of grids.
#[test]
fn crowds_in_crowds_and_giants_have_the_pairs_of_the_plain_sweep() {
    let mut random = Random::new(703);
    let mut sweep = Sweep::new();
    let mut clumps = Vec::new();
    for i in 0..3000_u32 {
        // Each level a thousand times smaller than the one around it.
        let digit = |place: u32| (i / 5_u32.pow(place)) % 5;
        let at = |place: u32, size: f32| {
            Vec3::new((digit(place) * 7 % 5) as f32, digit(place) as f32, (digit(place) * 3 % 5) as f32)
                * size
        };
        let corner = at(0, 1e3) + at(1, 1.0) + at(2, 1e-3) + random.vector().as_vec3() * 1e-4;
        clumps.push(Aabb3::new(corner, corner + Vec3::splat(3e-5)));
    }
    assert!(same_as_plain(&mut sweep, &clumps, "clumps") > 1000);
    let mut giants: Vec<Aabb3> =
        (0..3000).map(|_| random_box3(&mut random, Vec3::splat(50.0), 0.3)).collect();
    for i in 0..40 {
        let height = Vec3::Y * (i as f32 - 20.0);
        giants[i * 70] = Aabb3::new(Vec3::splat(-100.0) + height, Vec3::new(100.0, -99.0, 100.0) + height);
        giants[i * 70 + 1] = random_box3(&mut random, Vec3::splat(50.0), 40.0);
    }
    giants[5] = Aabb3::new(Vec3::NEG_INFINITY, Vec3::new(f32::INFINITY, -3.0, f32::INFINITY));
    assert!(same_as_plain(&mut sweep, &giants, "giants") > 3000);
    let height = Vec3::new(500.0, 0.0, 500.0);
    let crowd: Vec<Aabb3> = (0..3000).map(|_| random_box3(&mut random, height, 1.0)).collect();
    same_as_plain(&mut sweep, &crowd, "at one height");
    same_as_plain(&mut sweep, &[Aabb3::new(Vec3::ZERO, Vec3::ONE); 700], "all identical");
    let needles: Vec<Aabb3> = (0..2000)
        .map(|i| {
            let mut half = Vec3::splat(0.01);
            half[i % 3] = 30.0;
            let center = random.vector().as_vec3() * 50.0;
            Aabb3::new(center - half, center + half)
        })
        .collect();
    assert!(same_as_plain(&mut sweep, &needles, "needles") > 50);
}

/// Boxes far away from most others, clusters in clusters, and boxes of three sizes on one spot: cases that leave most
/// boxes in one column.
#[test]
fn what_leaves_most_boxes_in_one_column_has_the_pairs_of_the_plain_sweep() {
    let mut random = Random::new(704);
    let mut sweep = Sweep::new();
    for every in [50, 25, 6, 3] {
        let outside = |(i, b): (usize, Aabb3)| {
            if i % every == 0 { Aabb3::new(b.min * 1e5, b.min * 1e5 + Vec3::splat(0.1)) } else { b }
        };
        let room: Vec<Aabb3> = (0..3000).map(|_| random_box3(&mut random, Vec3::ONE, 0.1)).collect();
        let boxes: Vec<Aabb3> = room.into_iter().enumerate().map(outside).collect();
        assert!(same_as_plain(&mut sweep, &boxes, "far outside") > 1000);
    }
    let clusters: Vec<Aabb3> = (0..3000)
        .map(|i| {
            let scale = (0..i % 40).fold(1.0, |scale: f32, _| scale * 0.25);
            let b = random_box3(&mut random, Vec3::ONE, 0.1);
            Aabb3::new(b.min * scale, b.max * scale)
        })
        .collect();
    assert!(same_as_plain(&mut sweep, &clusters, "clusters in clusters") > 100);
    let spot = |i: usize| Aabb3::new(Vec3::splat(-((i % 3) as f32)), Vec3::splat((i % 3) as f32));
    let spots: Vec<Aabb3> = (0..1500).map(spot).collect();
    assert!(same_as_plain(&mut sweep, &spots, "one spot") > 500_000);
}

/// Boxes come, go, rest, wake and jump, few or many per frame, filters change, limits are reached: the list is always
/// that of a sweep without history.
#[test]
fn a_coherent_sweep_has_the_pairs_of_a_fresh_one_whatever_came_before() {
    let mut random = Random::new(704);
    let (mut kept_frames, mut refused) = (0, 0);
    for round in 0..30 {
        let room = Vec3::new(3.0, 0.5 + f32::from(round as u8), 3.0);
        let mut boxes: Vec<Aabb3> = Vec::new();
        let mut layers: Vec<u32> = Vec::new();
        let mut coherent = CoherentSweep::new();
        let (mut pairs, mut fresh) = (Vec::new(), Vec::new());
        for frame in 0..60 {
            let mut moved = Vec::new();
            // Bursts, stretches of rest, and sometimes everything.
            let share = [0.0, 0.0, 0.02, 0.1, 0.5][random.below(5)] * f64::from(u8::from(frame % 20 < 15));
            for place in 0..boxes.len() {
                if random.between(0.0, 1.0) < share {
                    boxes[place] = match random.below(6) {
                        0 => Aabb3::NOTHING,
                        1 => random_box3(&mut random, room, 3.0),
                        _ => random_box3(&mut random, room, 0.2),
                    };
                    layers[place] = 1 + random.below(3) as u32;
                    moved.push(place as u32);
                    if random.below(4) == 0 {
                        moved.push(place as u32);
                    }
                }
            }
            moved.reverse();
            let new = if frame == 0 { 200 } else { [0, 0, 0, 1, 7][random.below(5)] };
            for _ in 0..new {
                boxes.push(random_box3(&mut random, room, 0.2));
                layers.push(3);
            }
            if random.below(3) == 0 {
                // A box that is said to have moved and did not; and boxes that do not exist.
                moved.extend([boxes.len() as u32 - 1, boxes.len() as u32, u32::MAX]);
            }
            let admit = |a: u32, b: u32| layers[a as usize] & layers[b as usize] != 0;
            Sweep::new().pairs(&boxes, admit, usize::MAX, &mut fresh).unwrap();
            let limit = if random.below(8) == 0 { fresh.len().saturating_sub(1) } else { fresh.len() };
            let outcome = coherent.update(&boxes, &moved, admit, limit, &mut pairs);
            kept_frames += usize::from(moved.len() * 5 <= boxes.len());
            if limit < fresh.len() {
                assert_eq!((outcome, pairs.len()), (Err(TooManyPairs { limit }), 0));
                refused += 1;
            } else {
                assert_eq!(outcome, Ok(()));
                assert!(
                    pairs == fresh,
                    "round {round}, frame {frame}: {} pairs, not {}",
                    pairs.len(),
                    fresh.len()
                );
            }
            if frame == 40 && round % 3 == 0 {
                // Fewer boxes than before.
                boxes.truncate(150);
                layers.truncate(150);
            }
        }
    }
    assert!(kept_frames > 600 && refused > 100, "{kept_frames} frames with few movers, {refused} refused");
}

/// Moving boxes that reach many columns are looked up while that costs less than a full sweep; beyond that all are
/// swept, and the filter is called for resting pairs, too. Either way once for each pair.
#[test]
fn movers_that_reach_too_far_are_swept_with_all_others() {
    let mut random = Random::new(705);
    let room = Vec3::new(60.0, 50.0, 50.0);
    let rest: Vec<Aabb3> = (0..20_000).map(|_| random_box3(&mut random, room, 0.5)).collect();
    let (mut pairs, mut fresh, mut ways) = (Vec::new(), Vec::new(), Vec::new());
    for sheets in [1, 4000] {
        let mut coherent = CoherentSweep::new();
        // The first sweep keeps nothing, the second everything.
        for _ in 0..2 {
            coherent.update(&rest, &[], |_, _| true, usize::MAX, &mut pairs).unwrap();
        }
        let mut boxes = rest.clone();
        let moved: Vec<u32> = (0..sheets).map(|i| 5 * i).collect();
        for &place in &moved {
            // Across the whole room, and as thin as a sheet.
            let x = rest[place as usize].min.x;
            boxes[place as usize] =
                Aabb3::new(Vec3::new(x, -room.y, -room.z), Vec3::new(x + 0.01, room.y, room.z));
        }
        let asked = Mutex::new(Vec::new());
        let admit = |a, b| {
            asked.lock().unwrap().push((a, b));
            true
        };
        coherent.update(&boxes, &moved, admit, usize::MAX, &mut pairs).unwrap();
        Sweep::new().pairs(&boxes, |_, _| true, usize::MAX, &mut fresh).unwrap();
        assert!(pairs == fresh, "{sheets} sheets: {} pairs, not {}", pairs.len(), fresh.len());
        let mut asked = asked.into_inner().unwrap();
        let count = asked.len();
        asked.sort_unstable();
        asked.dedup();
        assert_eq!(asked.len(), count, "{sheets} sheets: asked twice about a pair");
        let is_moved = |place: &u32| moved.binary_search(place).is_ok();
        ways.push(asked.iter().any(|(a, b)| !is_moved(a) && !is_moved(b)));
    }
    assert_eq!(ways, [false, true], "whether all were swept");
}

#[test]
fn the_list_is_the_same_on_1_2_8_and_16_threads() {
    let named = [BoxScene::Pile, BoxScene::Islands, BoxScene::Sizes]
        .map(|scene| (scene.name(), MovingBoxes::new(scene, 35_000, 6).boxes));
    // Some are laid out so that columns are of no use: one of them, or all.
    let hurting =
        [HurtScene::Needles, HurtScene::Quarters].map(|scene| (scene.name(), scene.boxes(100_000, 6)));
    for (name, boxes) in named.into_iter().chain(hurting) {
        let on = |threads: usize, limit: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut sweep = Sweep::new();
                let mut pairs = Vec::new();
                let outcome = sweep.pairs(&boxes, |a, b| (a ^ b) % 5 != 0, limit, &mut pairs);
                // Again, reusing the memory of the first time.
                assert_eq!(sweep.pairs(&boxes, |a, b| (a ^ b) % 5 != 0, limit, &mut pairs), outcome);
                (outcome, pairs)
            })
        };
        let one = on(1, usize::MAX);
        assert!(one.1.len() > 5_000 && one.1.is_sorted());
        for threads in [2, 8, 16] {
            assert!(on(threads, usize::MAX) == one, "{threads} threads, {name}");
        }
        let short = one.1.len() - 1;
        assert_eq!(on(1, short), (Err(TooManyPairs { limit: short }), vec![]));
        assert_eq!(on(8, short), on(1, short));
    }
}

#[test]
fn what_a_team_has_swept_is_kept_as_well() {
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut moving = MovingBoxes::new(BoxScene::Static1, 35_000, 8);
            let (mut coherent, mut fresh) = (CoherentSweep::new(), Sweep::new());
            let (mut pairs, mut expected) = (Vec::new(), Vec::new());
            for frame in 0..6 {
                moving.step();
                coherent.update(&moving.boxes, moving.moved(), |_, _| true, usize::MAX, &mut pairs).unwrap();
                fresh.pairs(&moving.boxes, |_, _| true, usize::MAX, &mut expected).unwrap();
                assert!(pairs == expected, "{threads} threads, frame {frame}");
            }
        });
    }
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => (-8_i8..8).prop_map(|step| f32::from(step) * 0.25),
        2 => any::<f32>(),
        1 => prop::sample::select(NASTY.to_vec()),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 500,
        rng_seed: RngSeed::Fixed(0xB0C5),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn any_boxes(corners in prop::collection::vec(prop::array::uniform6(coordinate()), 0..40)) {
        let boxes: Vec<Aabb3> = corners
            .iter()
            .map(|&[ax, ay, az, bx, by, bz]| Aabb3::new(Vec3::new(ax, ay, az), Vec3::new(bx, by, bz)))
            .collect();
        check(&boxes);
        let sorted: Vec<Aabb2> = boxes
            .iter()
            .map(|b| (b.min.truncate(), b.max.truncate()))
            .map(|(p, q)| Aabb2::new(p.min(q), p.max(q)))
            .collect();
        check(&sorted);
    }
}
