//! Overlaps, separations, distances.

use super::{beside, level, mesh, triangles};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Pose3, Shape3, Sphere};
use asunder_narrow::{Measured3, Pair3, Separation3};
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::exact_overlap3;
use asunder_tests::precise;
use asunder_tests::shapes::{Clay, KINDS3};

fn measured(pair: &Pair3) -> Measured3 {
    match pair.separation(f32::INFINITY) {
        Separation3::Measured(found) => found,
        Separation3::AtLeast(bound) => panic!("no limit, and yet {bound}"),
    }
}

/// Calls `check` with a body of every kind near every kind of ground.
fn for_cases(rounds: usize, mut check: impl FnMut(&mut Random, (&Shape3, &Pose3), (&Shape3, &Pose3), &str)) {
    for (kind, (name, make)) in KINDS3.iter().enumerate() {
        for round in 0..rounds {
            let mut random = Random::new((kind * 1000 + round) as u128);
            let (ground, at) = level(&mut random, round);
            let body = make(&mut Clay::new(&mut random, [0.3, 1.0, 0.05][round / 2 % 3]));
            let reach = if body.outer_radius().is_finite() { f64::from(body.outer_radius()) } else { 3.0 };
            let away = reach * random.between(0.0, 2.5);
            let place = beside(&mut random, (&ground, &at), away) - body.center().as_dvec3();
            let pose = Pose3::new(place, random.quaternion()).unwrap();
            check(&mut random, (&body, &pose), (&ground, &at), &format!("{name} {round}"));
        }
    }
}

#[test]
fn yes_or_no_is_that_of_any_triangle() {
    let (mut yes, mut no) = (0, 0);
    for_cases(60, |_, (body, pose), (ground, at), told| {
        let slow =
            triangles(ground).iter().any(|(_, triangle)| Pair3::new(body, pose, triangle, at).overlaps());
        assert_eq!(Pair3::new(body, pose, ground, at).overlaps(), slow, "{told}");
        assert_eq!(Pair3::new(ground, at, body, pose).overlaps(), slow, "{told}, the other way round");
        yes += usize::from(slow);
        no += usize::from(!slow);
    });
    assert!(yes > 200 && no > 200, "{yes} {no}");
}

#[test]
fn yes_or_no_is_what_exact_arithmetic_says() {
    let (mut yes, mut no) = (0, 0);
    for seed in 0..400 {
        let mut random = Random::new(7000 + seed);
        // Corners in eighths, so that many pairs touch exactly.
        let eighths =
            |random: &mut Random| Vec3::from_array([0; 3].map(|_| random.below(17) as f32 / 8.0 - 1.0));
        let corners: Vec<Vec3> = (0..8).map(|_| eighths(&mut random)).collect();
        let numbers = (0..6).map(|_| [0; 3].map(|_| random.below(8) as u32)).collect::<Vec<_>>();
        let apart = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|number| corners[number as usize]);
            (b - a).cross(c - a).length() > 0.0
        };
        let numbers: Vec<_> = numbers.into_iter().filter(apart).collect();
        if numbers.is_empty() {
            continue;
        }
        let ground = mesh((corners, numbers));
        let body = KINDS3[random.below(10)].1(&mut Clay::short(&mut random));
        let away = [0; 3].map(|_| random.below(17) as f64 / 8.0 - 1.0);
        let pose = Pose3::at(DVec3::from_array(away) + DVec3::splat(1e5)).unwrap();
        let at = Pose3::at(DVec3::splat(1e5)).unwrap();
        let slow =
            triangles(&ground).iter().any(|(_, triangle)| exact_overlap3((&body, &pose), (triangle, &at)));
        assert_eq!(Pair3::new(&body, &pose, &ground, &at).overlaps(), slow, "{seed}");
        yes += usize::from(slow);
        no += usize::from(!slow);
    }
    assert!(yes > 80 && no > 80, "{yes} {no}");
}

/// The least separation over all triangles, and the least that it may truly be.
fn slowly((body, pose): (&Shape3, &Pose3), (ground, at): (&Shape3, &Pose3)) -> (f64, f64) {
    let (mut least, mut lowest) = (f64::INFINITY, f64::INFINITY);
    for (_, triangle) in triangles(ground) {
        let found = measured(&Pair3::new(body, pose, &triangle, at));
        least = least.min(found.separation.into());
        lowest = lowest.min(f64::from(found.separation) - f64::from(found.error));
    }
    (least, least - lowest)
}

#[test]
fn the_separation_is_the_least_of_any_triangle() {
    let mut bounds = 0;
    for_cases(45, |random, at, level, told| {
        let (least, error) = slowly(at, level);
        let pair = Pair3::new(at.0, at.1, level.0, level.1);
        let found = measured(&pair);
        let slack = f64::from(found.error) + error;
        assert!((f64::from(found.separation) - least).abs() <= slack, "{told}: {found:?} {least}");
        assert_eq!(found.separation <= 0.0, pair.overlaps(), "{told}");
        assert!((found.normal.length() - 1.0).abs() < 1e-6, "{told}");
        let limit = (least.abs() * random.between(0.0, 2.0)) as f32;
        match pair.separation(limit) {
            Separation3::Measured(within) => {
                assert!(
                    (f64::from(within.separation) - least).abs() <= f64::from(within.error) + error,
                    "{told}"
                );
            }
            Separation3::AtLeast(bound) => {
                bounds += 1;
                assert!(
                    bound >= limit.next_down() && f64::from(bound) <= least + error,
                    "{told}: {bound} {least}"
                );
            }
        }
    });
    assert!(bounds > 80, "{bounds}");
}

/// Shards, needles and rotated ground among them, against numbers computed without any of the library's code.
#[test]
fn separations_and_distances_are_those_of_double_doubles() {
    let (mut apart, mut over) = (0, 0);
    for_cases(40, |_, (body, pose), (ground, at), told| {
        if !body.outer_radius().is_finite() {
            return;
        }
        let bounds = body.bounds(pose, 0.0);
        let gap_of = |triangle: &Shape3| {
            let other = triangle.bounds(at, 0.0);
            f64::from((bounds.min - other.max).max(other.min - bounds.max).max_element())
        };
        let mut near: Vec<(f64, Shape3)> =
            triangles(ground).into_iter().map(|(_, triangle)| (gap_of(&triangle), triangle)).collect();
        near.sort_by(|one, other| one.0.total_cmp(&other.0));
        let (mut least, mut doubt) = (f64::INFINITY, 0.0_f64);
        for (gap, triangle) in &near {
            if *gap > least.max(0.0) {
                break;
            }
            let truth = precise::separation3((body, pose), (triangle, at));
            (least, doubt) = (least.min(truth.separation), doubt.max(truth.bound));
        }
        let pair = Pair3::new(body, pose, ground, at);
        let found = measured(&pair);
        let off = (f64::from(found.separation) - least).abs();
        assert!(off <= f64::from(found.error) + doubt, "{told}: {found:?}, in truth {least} +- {doubt}");
        if let Some(closest) = pair.distance() {
            let off = (f64::from(closest.distance) - least).abs();
            assert!(
                off <= f64::from(closest.error) + doubt,
                "{told}: {closest:?}, in truth {least} +- {doubt}"
            );
            apart += 1;
        } else {
            over += 1;
        }
    });
    assert!(apart > 200 && over > 150, "{apart} {over}");
}

#[test]
fn closest_points_lie_on_both_and_are_as_far_apart_as_told() {
    let mut apart = 0;
    for_cases(30, |_, (body, pose), (ground, at), told| {
        let pair = Pair3::new(body, pose, ground, at);
        let Some(closest) = pair.distance() else {
            return assert!(pair.overlaps(), "{told}");
        };
        apart += 1;
        let (least, error) = slowly((body, pose), (ground, at));
        let slack = f64::from(closest.error) + error;
        assert!((f64::from(closest.distance) - least).abs() <= slack, "{told}: {closest:?} {least}");
        if !body.outer_radius().is_finite() {
            return;
        }
        // The reported triangle is as near as any, whichever body comes first.
        let turned = Pair3::new(ground, at, body, pose).distance().unwrap();
        let all = triangles(ground);
        for (part, error) in [(closest.part_b, closest.error), (turned.part_a, turned.error)] {
            let named = &all.iter().find(|(number, _)| *number == part).unwrap().1;
            let named = measured(&Pair3::new(body, pose, named, at));
            let slack = f64::from(error) + f64::from(named.error);
            assert!(f64::from(named.separation) - least <= slack, "{told}: {closest:?}");
        }
        let [on_a, on_b] =
            [pose.position() + closest.anchor_a.as_dvec3(), at.position() + closest.anchor_b.as_dvec3()];
        // Anchors are f32, relative to each body's position.
        let size = f64::from(body.outer_radius()) + 8.0 + f64::from(closest.anchor_b.length());
        let slack = f64::from(closest.error) + 1e-6 * size;
        let between = on_b - on_a;
        assert!((between.length() - f64::from(closest.distance)).abs() <= slack, "{told}: {closest:?}");
        let way = closest.normal.as_dvec3() * f64::from(closest.distance);
        assert!((between - way).length() <= 4.0 * slack, "{told}: {closest:?}");
        let point = Shape3::from(Sphere::POINT);
        for (on, shape, pose) in [(on_a, body, pose), (on_b, ground, at)] {
            let off = measured(&Pair3::new(&point, &Pose3::at(on).unwrap(), shape, pose));
            assert!(f64::from(off.separation) <= 4.0 * slack, "{told}: {off:?}");
        }
    });
    assert!(apart > 100, "{apart}");
}

#[test]
fn two_grounds_are_as_near_as_any_two_triangles() {
    let (mut yes, mut no) = (0, 0);
    for seed in 0..60 {
        let mut random = Random::new(9000 + seed as u128);
        let (a, pose_a) = level(&mut random, seed);
        let (b, mut pose_b) = level(&mut random, seed / 3);
        let away = random.direction() * random.between(2.0, 9.0);
        pose_b = Pose3::new(pose_a.position() + away, pose_b.rotation()).unwrap();
        let pair = Pair3::new(&a, &pose_a, &b, &pose_b);
        let (mut overlaps, mut least) = (false, f64::INFINITY);
        let mut error = 0.0_f64;
        for (_, one) in triangles(&a) {
            for (_, other) in triangles(&b) {
                let found = measured(&Pair3::new(&one, &pose_a, &other, &pose_b));
                overlaps |= found.separation <= 0.0;
                least = least.min(found.separation.into());
                error = error.max(found.error.into());
            }
        }
        assert_eq!(pair.overlaps(), overlaps, "{seed}");
        let found = measured(&pair);
        assert!((f64::from(found.separation) - least).abs() <= f64::from(found.error) + error, "{seed}");
        assert_eq!(pair.distance().is_none(), overlaps, "{seed}");
        yes += usize::from(overlaps);
        no += usize::from(!overlaps);
    }
    assert!(yes > 10 && no > 10, "{yes} {no}");
}

#[test]
fn limits_that_are_no_numbers_are_none() {
    for_cases(4, |_, (body, pose), (ground, at), told| {
        let pair = Pair3::new(body, pose, ground, at);
        let all = pair.separation(f32::INFINITY);
        assert_eq!(pair.separation(f32::NAN), all, "{told}");
        assert_eq!(pair.separation(-1.0), pair.separation(0.0), "{told}");
        assert!(pair.guess() == pair.overlaps() || measured(&pair).separation.abs() < 1e-3, "{told}");
    });
}
