//! Shapes that move and turn.

use super::Course;
use super::moving::displacement;
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Cuboid, Motion3, Pose3, Segment3, Shape3};
use asunder_narrow::Pair3;
use asunder_tests::cases::{Case3, Random};
use asunder_tests::shapes::{KINDS3, PLACES, pair3};

/// A target rotation: near, any, the same with the other sign, exactly half a turn away.
fn reached(random: &mut Random, from: Quat) -> Quat {
    let [x, y, z, w] = from.to_array();
    match random.below(6) {
        0 => from,
        1 => Quat::from_xyzw(-x, -y, -z, -w),
        // Orthogonal to it as a four-vector.
        2 => Quat::from_xyzw(-y, x, -w, z),
        3 => Quat::from_xyzw(-w, z, -y, x),
        4 => Quat::from_xyzw(x + 0.125 * w, y, z - 0.0625 * w, w - 0.125 * x + 0.0625 * z),
        _ => random.quaternion(),
    }
}

#[test]
fn nothing_that_turns_touches_before_it_is_said_to() {
    let (mut hits, mut misses, mut wide) = (0, 0, 0);
    for (i, a) in KINDS3.iter().enumerate() {
        for (j, b) in KINDS3.iter().enumerate() {
            if a.0 == "half-space" && b.0 == "half-space" {
                continue;
            }
            for round in 0..PLACES {
                let mut random = Random::new(((i * 100 + j) * 10_000 + round + 5000) as u128);
                let bodies = pair3(&mut random, a, b, round);
                let mut case = bodies.case().clone();
                let reach =
                    super::finite(case.shape_a.outer_radius()) + super::finite(case.shape_b.outer_radius());
                let away = random.direction() * reach * random.between(0.5, 1.5);
                case.pose_b = Pose3::new(case.pose_b.position() + away, case.pose_b.rotation()).unwrap();
                let moved = [displacement(&mut random, &case), (random.direction() * reach).as_vec3()];
                let share = random.pick(&[0.0, 0.5, 1.0]) as f32;
                let to_a = reached(&mut random, case.pose_a.rotation());
                let to_b = reached(&mut random, case.pose_b.rotation());
                let (Ok(motion_a), Ok(motion_b)) =
                    (Motion3::new(moved[0] * share, to_a), Motion3::new(moved[1] * share, to_b))
                else {
                    continue;
                };
                let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
                let impact = pair.impact(&motion_a, &motion_b);
                let course = Course { case: &case, motions: [motion_a, motion_b] };
                course.check(impact, &format!("{} {} {round}", a.0, b.0));
                match impact {
                    None => misses += 1,
                    Some(impact) => {
                        hits += usize::from(!impact.overlapping);
                        let told = f64::from(impact.error) - 2.0 * course.rounding();
                        wide += usize::from(told > 1.01e-6 * course.size());
                    }
                }
            }
        }
    }
    // For two half-spaces of which one turns there is no answer closer than the start.
    assert!(hits > 500 && misses > 300 && wide < hits / 50, "{hits} {misses} {wide}");
}

#[test]
fn thin_rods_that_spin_fast_never_pass_through_posts() {
    let rod = Shape3::from(Cuboid::from_half_extents(Vec3::new(3.0, 1e-3, 1e-3)).unwrap());
    let post = Shape3::from(Cuboid::from_half_extents(Vec3::new(1e-3, 1e-3, 5.0)).unwrap());
    let line = Shape3::from(Segment3::new(Vec3::NEG_Z * 5.0, Vec3::Z * 5.0).unwrap());
    let still = Motion3::shift(Vec3::ZERO).unwrap();
    for (seed, post) in (0..200).zip([&post, &line].into_iter().cycle()) {
        let mut random = Random::new(seed);
        // Off the rod at the start and at the end, the only poses that a game's sampling would see.
        let at = DVec3::new(random.between(-0.5, 0.5), random.between(0.1, 2.9), 0.0);
        let half = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0)).unwrap();
        let case = Case3 {
            shape_a: rod.clone(),
            pose_a: Pose3::IDENTITY,
            shape_b: post.clone(),
            pose_b: Pose3::at(at).unwrap(),
        };
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        let impact = pair.impact(&half, &still).unwrap();
        Course { case: &case, motions: [half, still] }.check(Some(impact), "rod");
        // The rod's centre line passes through the post, up to both widths.
        let along = half.turn(&case.pose_a).basis_at(impact.fraction).x;
        let beside = along.cross(at).length();
        assert!(beside < 4e-3 && impact.error < 1e-5, "{beside} {impact:?}");
    }
}

#[test]
fn the_other_sign_of_a_rotation_is_no_turn() {
    for seed in 0..200 {
        let mut random = Random::new(seed);
        let bodies = pair3(&mut random, &KINDS3[seed as usize % 12], &KINDS3[4], 0);
        let case = bodies.case();
        let moved = displacement(&mut random, case);
        let [x, y, z, w] = case.pose_a.rotation().to_array();
        let plain = Motion3::shift(moved).unwrap();
        let signed = Motion3::new(moved, Quat::from_xyzw(-x, -y, -z, -w)).unwrap();
        let still = Motion3::shift(Vec3::ZERO).unwrap();
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        assert_eq!(pair.impact(&signed, &still), pair.impact(&plain, &still), "{case:?}");
        assert_eq!(pair.impact(&plain, &still), pair.cast(moved), "{case:?}");
    }
}
