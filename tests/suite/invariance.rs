//! What must not matter: which shape is called A, where the origin is, the length of a quaternion, units of length,
//! hints of the last frame, and the rest of the batch.

mod units;

use asunder_geometry::{Pose2, Pose3};
use asunder_narrow::{
    Answer, Batch2, Batch3, Hint, Job2, Job3, Manifold2, Manifold3, Pair2, Pair3, Separation2, Separation3,
    collide2, collide3,
};
use asunder_tests::answers::{Asked, Asked2, Asked3};
use asunder_tests::cases::{Case2, Case3, Random};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

const GAPS: [f64; 6] = [1e-2, 1e-5, 1e-8, -1e-8, -1e-5, -1e-2];

fn pair3(case: &Case3) -> Pair3<'_> {
    Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b)
}

fn pair2(case: &Case2) -> Pair2<'_> {
    Pair2::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b)
}

fn mixed_case3(random: &mut Random, round: usize) -> Case3 {
    if round.is_multiple_of(2) { random.case3() } else { random.near_case3(GAPS[round / 2 % GAPS.len()]) }
}

fn mixed_case2(random: &mut Random, round: usize) -> Case2 {
    if round.is_multiple_of(2) { random.case2() } else { random.near_case2(GAPS[round / 2 % GAPS.len()]) }
}

fn check_symmetric(asked: &impl Asked) {
    let swapped = asked.swapped();
    let (one, other) = (asked.separation(f32::INFINITY).unwrap(), swapped.separation(f32::INFINITY).unwrap());
    let difference = (one.separation - other.separation).abs();
    assert!(difference <= one.error + other.error, "{one:?}, swapped {other:?}: {asked:?}");
    assert_eq!(asked.overlaps(), swapped.overlaps(), "{asked:?}");
    assert_eq!(asked.manifold(0.0).is_some(), swapped.manifold(0.0).is_some(), "{asked:?}");
}

#[test]
fn which_shape_is_called_a() {
    let mut random = Random::new(500);
    for round in 0..2000 {
        check_symmetric(&Asked3::new(mixed_case3(&mut random, round)));
        check_symmetric(&Asked2::new(mixed_case2(&mut random, round)));
    }
}

/// Positions on a grid of 2^-24 m, so that a move of up to 2^28 m loses no bit of them.
fn on_grid(v: f64) -> f64 {
    (v * 16_777_216.0).round() / 16_777_216.0
}

#[test]
fn where_the_origin_is() {
    let mut random = Random::new(501);
    for round in 0..1500 {
        let shift = random.pick(&[1e6, 1e8]) * DVec3::new(1.0, -1.0, 0.5);
        let mut case = mixed_case3(&mut random, round);
        let snap = |pose: &Pose3, shift: DVec3| {
            let position = DVec3::from_array(pose.position().to_array().map(on_grid));
            Pose3::new(position + shift, pose.rotation()).unwrap()
        };
        (case.pose_a, case.pose_b) = (snap(&case.pose_a, DVec3::ZERO), snap(&case.pose_b, DVec3::ZERO));
        let far =
            Case3 { pose_a: snap(&case.pose_a, shift), pose_b: snap(&case.pose_b, shift), ..case.clone() };
        let (near, far) = (pair3(&case), pair3(&far));
        assert_eq!(near.separation(f32::INFINITY), far.separation(f32::INFINITY), "{case:?}");
        assert_eq!(near.distance(), far.distance(), "{case:?}");
        assert_eq!(near.manifold(0.1), far.manifold(0.1), "{case:?}");

        let mut case = mixed_case2(&mut random, round);
        let snap = |pose: &Pose2, shift: DVec2| {
            let position = DVec2::from_array(pose.position().to_array().map(on_grid));
            Pose2::new(position + shift, pose.rotation()).unwrap()
        };
        (case.pose_a, case.pose_b) = (snap(&case.pose_a, DVec2::ZERO), snap(&case.pose_b, DVec2::ZERO));
        let shift = shift.truncate();
        let far =
            Case2 { pose_a: snap(&case.pose_a, shift), pose_b: snap(&case.pose_b, shift), ..case.clone() };
        let (near, far) = (pair2(&case), pair2(&far));
        assert_eq!(near.separation(f32::INFINITY), far.separation(f32::INFINITY), "{case:?}");
        assert_eq!(near.distance(), far.distance(), "{case:?}");
        assert_eq!(near.manifold(0.1), far.manifold(0.1), "{case:?}");
    }
}

/// Off the grid a position far out is rounded; the answer must be right for the rounded position.
#[test]
fn far_from_the_origin_answers_are_as_good() {
    let mut random = Random::new(502);
    for round in 0..1000 {
        let shift = random.direction() * random.pick(&[1e6, 1e8]);
        let case = mixed_case3(&mut random, round);
        let moved = |pose: &Pose3| Pose3::new(pose.position() + shift, pose.rotation()).unwrap();
        let far = Asked3::new(Case3 { pose_a: moved(&case.pose_a), pose_b: moved(&case.pose_b), ..case });
        let (truth, found) = (far.true_separation(), far.separation(f32::INFINITY).unwrap());
        assert!(
            (found.separation - truth).abs() <= found.error + 2e-14 * far.size(),
            "{found:?}, true {truth}"
        );
        assert!(found.error <= 4e-6 * far.size(), "distance from the origin costs nothing: {found:?}");
    }
}

/// Rotating and moving both bodies alike changes the answer only by the relative rotation that rounded quaternions
/// cause.
#[test]
fn a_rigid_motion_of_both() {
    let mut random = Random::new(503);
    for round in 0..1000 {
        let case = mixed_case3(&mut random, round);
        let (turn, shift) = (random.quaternion().normalize(), random.vector() * 100.0);
        let carrier = Pose3::new(shift, turn).unwrap();
        let moved = |pose: &Pose3| {
            let position = shift + carrier.basis().turn(pose.position());
            Pose3::new(position, turn * pose.rotation()).unwrap()
        };
        let there =
            Asked3::new(Case3 { pose_a: moved(&case.pose_a), pose_b: moved(&case.pose_b), ..case.clone() });
        let here = Asked3::new(case);
        let (one, other) = [&here, &there].map(|asked| asked.separation(f32::INFINITY).unwrap()).into();
        // A product of f32 quaternions is off by about 2e-7, which moves points at each shape's reach by twice that.
        let slack = 2e-6 * here.size() + one.error + other.error;
        assert!((one.separation - other.separation).abs() <= slack, "{one:?}, moved {other:?}: {here:?}");
    }
}

#[test]
fn how_long_a_quaternion_is() {
    let mut random = Random::new(504);
    for round in 0..1000 {
        let case = mixed_case3(&mut random, round);
        let stretched = |factor: f32| {
            let longer = |pose: &Pose3| {
                let q = pose.rotation().to_array().map(|c| c * factor);
                Pose3::new(pose.position(), Quat::from_array(q)).unwrap()
            };
            Case3 { pose_a: longer(&case.pose_a), pose_b: longer(&case.pose_b), ..case.clone() }
        };
        // Scaling by powers of two keeps every bit; and q and -q are one rotation.
        for factor in [4.0, 0.125, -1.0] {
            let other = stretched(factor);
            assert_eq!(
                pair3(&case).separation(f32::INFINITY),
                pair3(&other).separation(f32::INFINITY),
                "{factor}: {case:?}"
            );
            assert_eq!(pair3(&case).manifold(0.1), pair3(&other).manifold(0.1), "{factor}: {case:?}");
        }
    }
}

/// A scene of pebbles and a scene of mountains: scaled by powers of two, every bit of the answer follows.
#[test]
fn units_of_length() {
    let mut random = Random::new(505);
    for round in 0..600 {
        for factor in [1.0 / 65536.0, 0.25, 8.0, 131_072.0] {
            let case = mixed_case3(&mut random, round);
            let wide = f64::from(factor);
            let moved = |pose: &Pose3| Pose3::new(pose.position() * wide, pose.rotation()).unwrap();
            let large = Case3 {
                shape_a: case.shape_a.scaled(Vec3::splat(factor)).unwrap(),
                pose_a: moved(&case.pose_a),
                shape_b: case.shape_b.scaled(Vec3::splat(factor)).unwrap(),
                pose_b: moved(&case.pose_b),
            };
            let (one, other) = (pair3(&case), pair3(&large));
            assert_eq!(one.overlaps(), other.overlaps(), "{factor}: {case:?}");
            let measured = [&one, &other].map(|pair| match pair.separation(f32::INFINITY) {
                Separation3::Measured(measured) => measured,
                Separation3::AtLeast(_) => panic!("no limit, yet no measure"),
            });
            assert_eq!(measured[0].separation * factor, measured[1].separation, "{factor}: {case:?}");
            assert_eq!(measured[0].normal, measured[1].normal, "{factor}: {case:?}");

            let case = mixed_case2(&mut random, round);
            let moved = |pose: &Pose2| Pose2::new(pose.position() * wide, pose.rotation()).unwrap();
            let large = Case2 {
                shape_a: case.shape_a.scaled(Vec2::splat(factor)).unwrap(),
                pose_a: moved(&case.pose_a),
                shape_b: case.shape_b.scaled(Vec2::splat(factor)).unwrap(),
                pose_b: moved(&case.pose_b),
            };
            let (one, other) = (pair2(&case), pair2(&large));
            assert_eq!(one.overlaps(), other.overlaps(), "{factor}: {case:?}");
            let measured = [&one, &other].map(|pair| match pair.separation(f32::INFINITY) {
                Separation2::Measured(measured) => measured,
                Separation2::AtLeast(_) => panic!("no limit, yet no measure"),
            });
            assert_eq!(measured[0].separation * factor, measured[1].separation, "{factor}: {case:?}");
        }
    }
}

fn hint_of(answer: &Answer) -> Hint {
    match answer {
        Answer::Apart { hint, .. } | Answer::Contact { hint, .. } => *hint,
    }
}

/// An answer without its hint: whether there is a contact, whether it overlaps, and its manifolds.
fn facts<M: Clone>(answer: &Answer, manifolds: &[M]) -> Option<(bool, Vec<M>)> {
    match answer {
        Answer::Apart { .. } => None,
        Answer::Contact { overlapping, manifolds: range, .. } => {
            Some((*overlapping, manifolds[range.start as usize..range.end as usize].to_vec()))
        }
    }
}

/// A wrong hint may choose among features that are equally good up to rounding, and where a search begins. It must not
/// change the overlap decision, nor numbers beyond their errors.
fn assert_no_other_answer(
    one: &Option<(bool, Vec<Manifold3>)>,
    other: &Option<(bool, Vec<Manifold3>)>,
    case: &Case3,
) {
    let overlapping =
        |fact: &Option<(bool, Vec<Manifold3>)>| fact.as_ref().map(|(overlapping, _)| *overlapping);
    assert_eq!(overlapping(one), overlapping(other), "a wrong hint: {case:?}");
    let (Some((_, one)), Some((_, other))) = (one, other) else { return };
    assert_eq!(one.len(), other.len(), "a wrong hint: {case:?}");
    for (one, other) in one.iter().zip(other) {
        assert_eq!((one.part_a, one.part_b), (other.part_a, other.part_b));
        let apart = (f64::from(one.separation) - f64::from(other.separation)).abs();
        assert!(apart <= f64::from(one.error) + f64::from(other.error), "a wrong hint: {case:?}");
    }
}

#[test]
fn hints_and_neighbours_in_a_batch() {
    let mut random = Random::new(506);
    let cases: Vec<(Case3, f32)> =
        (0..1500).map(|round| (mixed_case3(&mut random, round), [0.0, 0.02][round % 2])).collect();
    let jobs = |hint: &dyn Fn(usize) -> Hint, sensor: bool| -> Batch3 {
        let numbered = cases.iter().enumerate();
        let jobs: Vec<_> = numbered
            .map(|(i, (case, margin))| Job3 {
                shape_a: &case.shape_a,
                pose_a: &case.pose_a,
                shape_b: &case.shape_b,
                pose_b: &case.pose_b,
                margin: *margin,
                hint: hint(i),
                ahead: 0.0,
                sensor,
            })
            .collect();
        let mut batch = Batch3::default();
        collide3(&jobs, &mut batch);
        batch
    };
    let first = jobs(&|_| Hint::NONE, false);
    assert_eq!(first.answers.len(), cases.len());
    let hinted = jobs(&|i| hint_of(&first.answers[i]), false);
    // A hint made for another pair names an axis that may not even exist here.
    let misled = jobs(&|i| hint_of(&first.answers[(i * 7 + 1) % cases.len()]), false);
    let sensed = jobs(&|_| Hint::NONE, true);
    assert!(sensed.manifolds.is_empty());
    for (i, (case, margin)) in cases.iter().enumerate() {
        let fact = facts(&first.answers[i], &first.manifolds);
        assert_eq!(fact, facts(&hinted.answers[i], &hinted.manifolds), "its own hint: {case:?}");
        assert_no_other_answer(&fact, &facts(&misled.answers[i], &misled.manifolds), case);
        let alone = pair3(case).manifold(*margin);
        assert_eq!(fact.as_ref().map(|(_, manifolds)| manifolds.clone()), alone.map(|m| vec![m]), "{case:?}");
        let sense = facts(&sensed.answers[i], &sensed.manifolds);
        assert_eq!(sense.map(|(overlapping, _)| overlapping), fact.map(|(overlapping, _)| overlapping));
    }
}

#[test]
fn hints_and_neighbours_in_a_batch_in_the_plane() {
    let mut random = Random::new(507);
    let cases: Vec<(Case2, f32)> =
        (0..3000).map(|round| (mixed_case2(&mut random, round), [0.0, 0.02][round % 2])).collect();
    let jobs = |hint: &dyn Fn(usize) -> Hint, sensor: bool| -> Batch2 {
        let numbered = cases.iter().enumerate();
        let jobs: Vec<_> = numbered
            .map(|(i, (case, margin))| Job2 {
                shape_a: &case.shape_a,
                pose_a: &case.pose_a,
                shape_b: &case.shape_b,
                pose_b: &case.pose_b,
                margin: *margin,
                hint: hint(i),
                ahead: 0.0,
                sensor,
            })
            .collect();
        let mut batch = Batch2::default();
        collide2(&jobs, &mut batch);
        batch
    };
    let first = jobs(&|_| Hint::NONE, false);
    assert_eq!(first.answers.len(), cases.len());
    let hinted = jobs(&|i| hint_of(&first.answers[i]), false);
    let misled = jobs(&|i| hint_of(&first.answers[(i * 7 + 1) % cases.len()]), false);
    let sensed = jobs(&|_| Hint::NONE, true);
    assert!(sensed.manifolds.is_empty());
    let mut differing = 0;
    for (i, (case, margin)) in cases.iter().enumerate() {
        let fact = facts(&first.answers[i], &first.manifolds);
        assert_eq!(fact, facts(&hinted.answers[i], &hinted.manifolds), "its own hint: {case:?}");
        // Among edges that are equally good, up to two preferences, the hinted one is kept; the numbers are the same.
        let numbers = |fact: Option<(bool, Vec<Manifold2>)>| {
            fact.map(|(overlapping, m)| {
                (overlapping, m.iter().map(|m| (m.separation, m.error)).collect::<Vec<_>>())
            })
        };
        let wrong = facts(&misled.answers[i], &misled.manifolds);
        differing += usize::from(fact != wrong);
        assert_eq!(numbers(fact.clone()), numbers(wrong), "a wrong hint: {case:?}");
        let alone = pair2(case).manifold(*margin);
        assert_eq!(fact.as_ref().map(|(_, manifolds)| manifolds.clone()), alone.map(|m| vec![m]), "{case:?}");
        let sense = facts(&sensed.answers[i], &sensed.manifolds);
        assert_eq!(sense.map(|(overlapping, _)| overlapping), fact.map(|(overlapping, _)| overlapping));
    }
    assert!(differing < cases.len() / 100, "{differing} wrong hints named an edge as good");
}
