//! Shapes that move without turning.

use super::{Course, finite};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Motion3, Pose3};
use asunder_narrow::Pair3;
use asunder_tests::cases::{Case3, Random};
use asunder_tests::shapes::{KINDS3, PLACES, pair3};

/// A displacement that may meet the other body: towards it, past it, or anywhere; long or short.
pub(crate) fn displacement(random: &mut Random, case: &Case3) -> Vec3 {
    let between = case.pose_b.position() - case.pose_a.position();
    let reach = finite(case.shape_a.outer_radius()) + finite(case.shape_b.outer_radius());
    let aside = random.direction() * reach * random.between(0.0, 1.1);
    let towards = match random.below(4) {
        0 => random.direction() * (between.length() + reach),
        _ => between + aside,
    };
    (towards * random.pick(&[0.5, 1.0, 2.0, 2.0, 10.0, 1e3])).as_vec3()
}

#[test]
fn nothing_touches_before_it_is_said_to() {
    let (mut hits, mut misses, mut starts) = (0, 0, 0);
    for (i, a) in KINDS3.iter().enumerate() {
        for (j, b) in KINDS3.iter().enumerate() {
            if a.0 == "half-space" && b.0 == "half-space" {
                continue;
            }
            for round in 0..2 * PLACES {
                let mut random = Random::new(((i * 100 + j) * 10_000 + round) as u128);
                let bodies = pair3(&mut random, a, b, round);
                let mut case = bodies.case().clone();
                // Half of them further apart than the table places them.
                if round >= PLACES {
                    let reach = finite(case.shape_a.outer_radius()) + finite(case.shape_b.outer_radius());
                    let away = random.direction() * reach * random.between(1.0, 3.0);
                    let moved = case.pose_b.position() + away;
                    case.pose_b = Pose3::new(moved, case.pose_b.rotation()).unwrap();
                }
                let moved = displacement(&mut random, &case);
                let Ok(motion) = Motion3::shift(moved) else { continue };
                let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
                let impact = pair.cast(moved);
                let still = Motion3::shift(DVec3::ZERO).unwrap();
                let course = Course { case: &case, motions: [motion, still] };
                course.check(impact, &format!("{} {} {round}", a.0, b.0));
                match impact {
                    None => misses += 1,
                    Some(impact) if impact.overlapping => starts += 1,
                    Some(impact) => {
                        hits += 1;
                        let rounding = course.rounding() + 1e-13 * f64::from(moved.length());
                        let told = f64::from(impact.error) - rounding;
                        assert!(told <= 1.01e-6 * course.size(), "{} {} {round}: {impact:?}", a.0, b.0);
                    }
                }
            }
        }
    }
    assert!(hits > 1000 && misses > 500 && starts > 500, "{hits} {misses} {starts}");
}

#[test]
fn both_moving_is_one_moving_against_the_other() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let (a, b) = (&KINDS3[random.below(KINDS3.len())], &KINDS3[random.below(KINDS3.len() - 1)]);
        let bodies = pair3(&mut random, a, b, 0);
        let case = bodies.case();
        let (first, second) = (displacement(&mut random, case), displacement(&mut random, case) * 0.25);
        let motions = [first, second].map(|moved| Motion3::shift(moved).unwrap());
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        let impact = pair.impact(&motions[0], &motions[1]);
        Course { case, motions }.check(impact, &format!("{} {} {seed}", a.0, b.0));
        // Swapped, the result is mirrored.
        let back = Pair3::new(&case.shape_b, &case.pose_b, &case.shape_a, &case.pose_a);
        let mirrored = back.impact(&motions[1], &motions[0]);
        assert_eq!(impact.is_some(), mirrored.is_some(), "{case:?}");
        if let (Some(one), Some(other)) = (impact, mirrored) {
            let way = (motions[0].displacement() - motions[1].displacement()).length();
            // Where the path only grazes, the gap changes by the error over many times its length.
            let gap = |fraction: f64| Course { case, motions }.separation(fraction).0;
            let room = f64::from(one.error + other.error);
            let is_near = (one.fraction - other.fraction).abs() * way <= 4.0 * room
                || gap(one.fraction.max(other.fraction)).abs() <= 4.0 * room;
            assert!(is_near, "{one:?} {other:?} {case:?}");
        }
    }
}

#[test]
fn scaled_by_a_power_of_two_the_answers_are_scaled() {
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let (half, moved) = ((random.vector().abs() + 0.1).as_vec3(), (random.vector() * 8.0).as_vec3());
        let (turn_a, turn_b) = (random.quaternion(), random.quaternion());
        let at = (random.direction() * 3.0).as_vec3();
        let points: Vec<Vec3> = (0..12).map(|_| random.vector().as_vec3()).collect();
        let scaled = |scale: f32| {
            let cuboid = asunder_geometry::Cuboid::from_half_extents(half * scale).unwrap().into();
            let cloud: Vec<Vec3> = points.iter().map(|&point| point * scale).collect();
            let hull = asunder_geometry::Hull::from_points(&cloud).unwrap().into();
            let pose_a = Pose3::new(Vec3::ZERO, turn_a).unwrap();
            let pose_b = Pose3::new(at * scale, turn_b).unwrap();
            Pair3::new(&cuboid, &pose_a, &hull, &pose_b).cast(moved * scale)
        };
        let plain = scaled(1.0);
        for scale in [0.015_625, 1024.0] {
            let other = scaled(scale);
            assert_eq!(plain.map(|impact| impact.fraction), other.map(|impact| impact.fraction), "{seed}");
            let lengths = |impact: &asunder_narrow::Impact3| (impact.anchor_a, impact.normal);
            if let (Some(plain), Some(other)) = (&plain, &other) {
                let (anchor, normal) = lengths(plain);
                assert_eq!((anchor * scale, normal), lengths(other), "{seed}");
            }
        }
    }
}
