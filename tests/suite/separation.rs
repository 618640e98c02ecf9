//! Separations and distances against the oracles: an exhaustive separating axis test and an exhaustive distance.

use asunder::{Pair2, Pose2, Separation2};
use asunder_tests::answers::{Asked, Asked2, Asked3, Measured};
use asunder_tests::cases::Random;

/// Rounding of the oracles themselves, as a share of the pair's size: some forty roundings in f64.
const JUDGES: f64 = 2e-14;

/// A normal is reported in f32: its direction is off by up to 1e-7, which shifts points at the pair's size by that
/// share.
const NORMAL: f64 = 2e-7;

/// Gaps that pairs are moved to, as shares of their size: clear ones, and ones too small for f32, then for f64.
const GAPS: [f64; 12] = [0.3, 1e-2, 1e-4, 1e-6, 1e-8, 1e-11, -1e-11, -1e-8, -1e-6, -1e-4, -1e-2, -0.2];

fn check_measured(measured: &Measured, truth: f64, size: f64, what: &str) {
    let Measured { separation, error, normal_length, gap_along_normal } = *measured;
    assert!(
        (separation - truth).abs() <= error + JUDGES * size,
        "{what}: reported {separation} +- {error}, true {truth}"
    );
    assert!((normal_length - 1.0).abs() <= 2e-7, "{what}: a normal of length {normal_length}");
    assert!(
        gap_along_normal >= separation - error - NORMAL * size,
        "{what}: the normal shows {gap_along_normal}, reported {separation}"
    );
    // A useless error bound would make every other check here empty.
    assert!(error <= 4e-6 * size + 1e-7 * separation.abs(), "{what}: error {error} of {size}");
}

/// Checks everything that is reported for one pair; returns its true separation.
fn check(asked: &impl Asked) -> f64 {
    let (truth, size) = (asked.true_separation(), asked.size());
    let overlaps = asked.overlaps();
    if truth.abs() > JUDGES * size {
        assert_eq!(overlaps, truth < 0.0, "true separation {truth}: {asked:?}");
    }
    let Ok(measured) = asked.separation(f32::INFINITY) else { panic!("no limit, yet no measure: {asked:?}") };
    check_measured(&measured, truth, size, &format!("separation of {asked:?}"));
    assert_eq!(measured.separation <= 0.0, overlaps, "the sign is the decision's: {asked:?}");

    let distance = asked.distance();
    assert_eq!(distance.is_none(), overlaps, "closest points exactly where there is a gap: {asked:?}");
    if let Some(nearest) = distance {
        check_measured(&nearest.measured, truth, size, &format!("distance of {asked:?}"));
        assert!(nearest.measured.separation > 0.0);
        // Points are rounded to f32 once. Across a tiny gap their direction is noise, so only lengths are checked.
        let (on, error) = (NORMAL * size, nearest.measured.error);
        let points = nearest.points;
        assert!(
            points.beyond_a <= on && points.beyond_b <= on,
            "points on the shapes: {points:?} of {asked:?}"
        );
        let apart = points.along_normal.hypot(points.across_normal);
        assert!((apart - truth).abs() <= error + 2.0 * on, "points {apart} apart, true {truth}: {asked:?}");
    }
    check_limits(asked, truth, size);
    truth
}

/// With a limit, measured values are as good as without one, and a bound is a true bound.
fn check_limits(asked: &impl Asked, truth: f64, size: f64) {
    for share in [0.0, 1e-3, 0.1] {
        let limit = (share * size) as f32;
        match asked.separation(limit) {
            Ok(measured) => {
                check_measured(&measured, truth, size, &format!("separation({limit}) of {asked:?}"));
            }
            Err(bound) => {
                assert!(
                    f64::from(bound) <= truth + JUDGES * size,
                    "at least {bound}, true {truth}: {asked:?}"
                );
                // Rounded down to f32, a bound may end up equal to the limit.
                assert!(bound >= limit, "at least {bound} says less than the limit {limit}: {asked:?}");
                assert!(!asked.overlaps(), "a bound above zero, yet they overlap: {asked:?}");
            }
        }
    }
}

/// Asserts that each sign of the true separation occurred often enough for the test to mean something.
fn tally(truths: impl Iterator<Item = f64>, least: usize) {
    let (mut apart, mut overlapping) = (0, 0);
    truths.for_each(|truth| *if truth > 0.0 { &mut apart } else { &mut overlapping } += 1);
    assert!(apart >= least && overlapping >= least, "{apart} apart, {overlapping} in overlap");
}

#[test]
fn random_solids() {
    let mut random = Random::new(100);
    tally((0..6000).map(|_| check(&Asked3::new(random.case3()))), 1500);
}

#[test]
fn random_polygons() {
    let mut random = Random::new(101);
    tally((0..10_000).map(|_| check(&Asked2::new(random.case2()))), 2500);
}

#[test]
fn solids_that_almost_touch() {
    let mut random = Random::new(102);
    tally((0..3000).map(|i| check(&Asked3::new(random.near_case3(GAPS[i % GAPS.len()])))), 1000);
}

#[test]
fn polygons_that_almost_touch() {
    let mut random = Random::new(103);
    tally((0..6000).map(|i| check(&Asked2::new(random.near_case2(GAPS[i % GAPS.len()])))), 2000);
}

#[test]
fn a_gap_of_one_bit_in_the_plane_has_an_error_of_use() {
    // Bisected along a line until no f64 lies between a pose that touches and one that does not.
    let mut apart = 0;
    for seed in 0..40_000 {
        let mut random = Random::new(seed);
        let mut case = if seed % 4 == 0 { random.near_case2(0.0) } else { random.case2() };
        if seed % 4 == 1 {
            (case.shape_b, case.pose_b) =
                (case.shape_a.clone(), Pose2::new(case.pose_b.position(), case.pose_a.rotation()).unwrap());
        }
        let from = case.pose_a.position();
        let away = random.direction2() * case.size();
        let place = |share: f64| Pose2::new(from + away * share, case.pose_b.rotation()).unwrap();
        let overlaps = |pose: &Pose2| Pair2::new(&case.shape_a, &case.pose_a, &case.shape_b, pose).overlaps();
        let (mut near, mut far) = (0.0, 1.5);
        if !overlaps(&place(near)) || overlaps(&place(far)) {
            continue;
        }
        loop {
            let middle = 0.5 * (near + far);
            if middle <= near || middle >= far {
                break;
            }
            if overlaps(&place(middle)) { near = middle } else { far = middle }
        }
        for share in [near, far] {
            let pose = place(share);
            for pair in [
                Pair2::new(&case.shape_a, &case.pose_a, &case.shape_b, &pose),
                Pair2::new(&case.shape_b, &pose, &case.shape_a, &case.pose_a),
            ] {
                let Separation2::Measured(measured) = pair.separation(f32::INFINITY) else {
                    panic!("{seed}")
                };
                let most = 1e-12 * case.size();
                assert!(f64::from(measured.error) < most, "{seed}: {measured:?} of {case:?} at {pose:?}");
                assert!(f64::from(measured.separation.abs()) < most, "{seed}: {measured:?}");
                assert_eq!(measured.separation <= 0.0, share == near, "{seed}: {measured:?}");
            }
            apart += 1;
        }
    }
    assert!(apart > 60_000, "{apart}");
}
