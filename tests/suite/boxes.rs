//! Pairs of cuboids, which have kernels of their own: eight at a time give what each gives alone, and what exact
//! arithmetic says; swapping A and B mirrors them.

use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, Pair3, collide3, separations3};
use asunder_scenes::pairs::{PairSet, PosedPair3, SolidKind, frames3, pairs3};
use asunder_tests::answers::{Asked, Asked3};
use asunder_tests::cases::{Case3, Random};
use glam::{DVec3, Quat, Vec3};

fn job(pair: &PosedPair3, margin: f32, hint: Hint, sensor: bool) -> Job3<'_> {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor }
}

fn hint_of(answer: &Answer) -> Hint {
    let (Answer::Apart { hint, .. } | Answer::Contact { hint, .. }) = answer;
    *hint
}

fn overlapping(answer: &Answer) -> Option<bool> {
    match answer {
        Answer::Apart { .. } => None,
        Answer::Contact { overlapping, .. } => Some(*overlapping),
    }
}

fn manifolds<'a>(answer: &Answer, batch: &'a Batch3) -> &'a [Manifold3] {
    match answer {
        Answer::Apart { .. } => &[],
        Answer::Contact { manifolds, .. } => {
            &batch.manifolds[manifolds.start as usize..manifolds.end as usize]
        }
    }
}

/// Shuffles a list, so that the lanes hold a mix of all kinds.
fn shuffled<T>(mut list: Vec<T>, random: &mut Random) -> Vec<T> {
    for i in (1..list.len()).rev() {
        list.swap(i, random.below(i + 1));
    }
    list
}

/// Cuboids of every set, mixed with rounded ones and other shapes, which take other paths.
fn crowd() -> Vec<PosedPair3> {
    let mut random = Random::new(5100);
    let mut pairs: Vec<PosedPair3> =
        PairSet::ALL.iter().flat_map(|set| pairs3(SolidKind::Box, *set, 240, 7)).collect();
    for pair in pairs.iter_mut().step_by(17) {
        if let Shape3::Cuboid(cuboid) = pair.shape_b {
            pair.shape_b = cuboid.rounded(0.125).unwrap().into();
        }
    }
    pairs.extend(pairs3(SolidKind::Hull8, PairSet::Mixed, 90, 7));
    shuffled(pairs, &mut random)
}

#[test]
fn a_batch_says_bit_for_bit_what_each_pair_says_alone() {
    let crowd = crowd();
    let mut random = Random::new(5101);
    let margins = [0.0, 0.0, 0.01, 0.5, f32::INFINITY];
    let mut hints = vec![Hint::NONE; crowd.len()];
    let (mut apart, mut touching, mut points) = (0, 0, 0);
    for frame in 0..3 {
        let jobs: Vec<Job3> = (0..crowd.len())
            .map(|i| job(&crowd[i], margins[(i + frame) % margins.len()], hints[i], random.below(4) == 0))
            .collect();
        let mut together = Batch3::default();
        // Slices of every length, so that lanes are sometimes full and sometimes not.
        let mut rest = &jobs[..];
        while !rest.is_empty() {
            let (now, later) = rest.split_at((1 + random.below(70)).min(rest.len()));
            collide3(now, &mut together);
            rest = later;
        }
        for (i, job) in jobs.iter().enumerate() {
            let mut alone = Batch3::default();
            collide3(core::slice::from_ref(job), &mut alone);
            let (one, other) = (&together.answers[i], &alone.answers[0]);
            assert_eq!(
                (hint_of(one), overlapping(one)),
                (hint_of(other), overlapping(other)),
                "{:?}",
                crowd[i]
            );
            // Debug output distinguishes 0.0 from -0.0.
            let (one, other) = (manifolds(one, &together), manifolds(other, &alone));
            assert_eq!(format!("{one:?}"), format!("{other:?}"), "{:?}", crowd[i]);
            apart += usize::from(overlapping(&alone.answers[0]).is_none());
            touching += usize::from(!one.is_empty());
            points += one.iter().map(|manifold| manifold.points.len()).sum::<usize>();
        }
        hints = together.answers.iter().map(hint_of).collect();
    }
    assert!(
        apart > 1000 && touching > 2000 && points > 5000,
        "{apart} apart, {touching} touch in {points} points"
    );
}

#[test]
fn separations_of_many_are_bit_for_bit_those_of_each() {
    let crowd = crowd();
    let pairs: Vec<Pair3> =
        crowd.iter().map(|p| Pair3::new(&p.shape_a, &p.pose_a, &p.shape_b, &p.pose_b)).collect();
    for limit in [0.0, 0.25, f32::INFINITY] {
        let mut found = Vec::new();
        pairs.chunks(61).for_each(|pairs| separations3(pairs, limit, &mut found));
        assert_eq!(found.len(), pairs.len());
        for (pair, found) in pairs.iter().zip(&found) {
            assert_eq!(format!("{found:?}"), format!("{:?}", pair.separation(limit)), "{pair:?}");
        }
    }
}

/// Two cuboids whose corners, edges or faces touch, or are apart or overlap by a few roundings.
fn near(random: &mut Random, round: usize) -> Case3 {
    let mut half = || Vec3::new(1.0 + random.below(8) as f32, 1.0 + random.below(8) as f32, 1.0) / 8.0;
    let (a, b) = (half(), half());
    let gap = [0.0, 1e-16, -1e-16, 1e-14, -1e-14, 1e-9, -1e-9][round % 7];
    let turn = if round.is_multiple_of(2) { Quat::IDENTITY } else { random.quaternion() };
    // Offset along one, two or three of A's axes: face, edge or corner.
    let sides = [DVec3::X, DVec3::new(1.0, -1.0, 0.0), DVec3::NEG_ONE][round % 3];
    let away = sides * ((a + b).as_dvec3() + DVec3::splat(gap));
    let pose_a = Pose3::new(random.vector() * 100.0, turn).unwrap();
    let pose_b = Pose3::new(pose_a.transform(away), turn).unwrap();
    let shape = |half| Shape3::from(Cuboid::from_half_extents(half).unwrap());
    Case3 { shape_a: shape(a), pose_a, shape_b: shape(b), pose_b }
}

#[test]
fn eight_at_a_time_they_overlap_exactly_when_exact_arithmetic_says_so() {
    let mut random = Random::new(5102);
    let mut cases: Vec<Case3> = (0..600).map(|round| near(&mut random, round)).collect();
    let lone: Vec<PosedPair3> =
        PairSet::ALL.iter().flat_map(|set| pairs3(SolidKind::Box, *set, 60, 9)).collect();
    cases.extend(lone.into_iter().map(|PosedPair3 { shape_a, pose_a, shape_b, pose_b }| Case3 {
        shape_a,
        pose_a,
        shape_b,
        pose_b,
    }));
    let jobs = |sensor: bool| -> Batch3 {
        let jobs: Vec<Job3> = cases
            .iter()
            .map(|Case3 { shape_a, pose_a, shape_b, pose_b }| Job3 {
                shape_a,
                pose_a,
                shape_b,
                pose_b,
                margin: 0.0,
                hint: Hint::NONE,
                ahead: 0.0,
                sensor,
            })
            .collect();
        let mut batch = Batch3::default();
        collide3(&jobs, &mut batch);
        batch
    };
    let (bodies, sensors) = (jobs(false), jobs(true));
    let mut overlaps = 0;
    for (i, case) in cases.iter().enumerate() {
        let truth = Asked3::new(case.clone()).exactly_overlaps();
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        assert_eq!(pair.overlaps(), truth, "{case:?}");
        for batch in [&bodies, &sensors] {
            assert_eq!(overlapping(&batch.answers[i]).unwrap_or(false), truth, "{case:?}");
        }
        overlaps += usize::from(truth);
    }
    assert!((300..900).contains(&overlaps), "{overlaps} overlap");
}

#[test]
fn no_hint_changes_whether_they_overlap() {
    let mut hints = vec![Hint::NONE; 4];
    let mut told = 0;
    for set in PairSet::ALL {
        for frame in frames3(SolidKind::Box, set, 240, 11) {
            let ask = |hint: &dyn Fn(usize) -> Hint| {
                let jobs: Vec<Job3> =
                    frame.iter().enumerate().map(|(i, pair)| job(pair, 0.01, hint(i), i % 3 == 0)).collect();
                let mut batch = Batch3::default();
                collide3(&jobs, &mut batch);
                batch
            };
            let fresh = ask(&|_| Hint::NONE);
            // Hints of other pairs, and of other sets.
            let misled = ask(&|i| hints[(7 * i + 3) % hints.len()]);
            let hinted = ask(&|i| hint_of(&misled.answers[i]));
            for (i, pair) in frame.iter().enumerate() {
                let said = |batch: &Batch3| overlapping(&batch.answers[i]);
                assert_eq!(said(&fresh), said(&misled), "{pair:?}");
                assert_eq!(said(&fresh), said(&hinted), "{pair:?}");
                // The separation is that of the best axis, whichever axis the points are built on.
                let number = |batch: &Batch3| {
                    manifolds(&batch.answers[i], batch).first().map(|found| (found.separation, found.error))
                };
                assert_eq!(number(&fresh), number(&misled), "{pair:?}");
                told += usize::from(number(&fresh).is_some());
            }
            hints = fresh.answers.iter().map(hint_of).collect();
        }
    }
    assert!(told > 800, "{told} manifolds");
}

#[test]
fn the_other_way_round_they_mirror_each_other() {
    let (mut mirrored, mut all) = (0, 0);
    for set in [PairSet::Mixed, PairSet::Rest, PairSet::Touch, PairSet::Deep] {
        for pair in pairs3(SolidKind::Box, set, 600, 13) {
            let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = &pair;
            let one = Pair3::new(shape_a, pose_a, shape_b, pose_b).manifold(0.01);
            let other = Pair3::new(shape_b, pose_b, shape_a, pose_a).manifold(0.01);
            assert_eq!(one.is_some(), other.is_some(), "{pair:?}");
            let (Some(one), Some(other)) = (one, other) else { continue };
            let apart = (f64::from(one.separation) - f64::from(other.separation)).abs();
            assert!(apart <= f64::from(one.error) + f64::from(other.error), "{pair:?}");
            all += 1;
            // Opposite faces are equally good, and A's comes first: swapped, the points are built on another.
            if (one.normal + other.normal).length() > 1e-6 {
                continue;
            }
            let size = shape_a.outer_radius() + shape_b.outer_radius();
            let back = other.points.iter().filter(|back| {
                one.points.iter().any(|point| {
                    (point.anchor_a - back.anchor_b).length() < 1e-5 * size
                        && (point.anchor_b - back.anchor_a).length() < 1e-5 * size
                })
            });
            mirrored +=
                usize::from(back.count() == one.points.len() && one.points.len() == other.points.len());
        }
    }
    assert!(all > 1000 && mirrored * 100 >= all * 90, "{mirrored} of {all} are mirrored");
}
