//! Cases in which casts commonly fail: far out, grazing, endless motion, tiny bodies.

use super::Course;
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Cuboid, Hull, Motion3, Pose3, Shape3, Sphere};
use asunder_narrow::Pair3;
use asunder_tests::cases::{Case3, Random};

fn ball(radius: f32) -> Shape3 {
    Sphere::new(radius).unwrap().into()
}

fn still() -> Motion3 {
    Motion3::shift(Vec3::ZERO).unwrap()
}

#[test]
fn tiny_bodies_far_from_the_origin_meet_where_f64_says() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(1e-5)).unwrap());
        let origin = random.direction() * 1e8;
        let pose_a = Pose3::new(origin, random.quaternion()).unwrap();
        let away = random.direction() * 1e-3;
        let pose_b = Pose3::new(origin + away, random.quaternion()).unwrap();
        let moved = ((pose_b.position() - pose_a.position()) * 2.0).as_vec3();
        let case = Case3 { shape_a: cube.clone(), pose_a, shape_b: cube.clone(), pose_b };
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        let impact = pair.cast(moved).unwrap();
        // At that distance f64 resolves 1.5e-8 m.
        assert!(impact.error < 2e-7 && impact.fraction > 0.4 && impact.fraction < 0.5, "{impact:?}");
        Course { case: &case, motions: [Motion3::shift(moved).unwrap(), still()] }.check(Some(impact), "far");
    }
}

#[test]
fn what_flies_a_million_kilometres_meets_what_is_in_the_way() {
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let direction = random.direction();
        let case = Case3 {
            shape_a: ball(0.5),
            pose_a: Pose3::at(direction * -4.9e8).unwrap(),
            shape_b: Cuboid::from_half_extents(Vec3::splat(2.0)).unwrap().into(),
            pose_b: Pose3::new(DVec3::ZERO, random.quaternion()).unwrap(),
        };
        let motion = Motion3::shift(direction * 9e8).unwrap();
        let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
        let impact = pair.impact(&motion, &still()).unwrap();
        // Sixteen projections at 4 units of 2^-53 of a way of 1e9 m in three coordinates.
        assert!(impact.error < 2e-5, "{impact:?}");
        Course { case: &case, motions: [motion, still()] }.check(Some(impact), "long");
    }
}

#[test]
fn grazing_passes_are_told_by_a_hundred_thousandth() {
    let (radius, way) = (1.0_f32, Vec3::X * 8.0);
    for share in [1e-1, 1e-2, 1e-3, 1e-4, 1e-5] {
        for (sign, is_hit) in [(-1.0, true), (1.0, false)] {
            // Two balls that pass each other with this gap, or overlap by it.
            let between = sign * share;
            let (here, there) = (Pose3::IDENTITY, Pose3::at([4.0, 2.0 + between, 0.0]).unwrap());
            let shape = ball(radius);
            let impact = Pair3::new(&shape, &here, &shape, &there).cast(way);
            assert_eq!(impact.is_some(), is_hit, "{between}: {impact:?}");
            let (cube, prism) = (
                Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap()),
                Shape3::from(
                    Hull::from_points(&Cuboid::from_half_extents(Vec3::ONE).unwrap().vertices()).unwrap(),
                ),
            );
            for shape in [&cube, &prism] {
                let impact = Pair3::new(shape, &here, shape, &there).cast(way);
                assert_eq!(impact.is_some(), is_hit, "{between}: {impact:?}");
            }
        }
    }
}

#[test]
fn a_cube_slides_along_a_floor_it_all_but_touches() {
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap());
    let floor = Shape3::from(Cuboid::from_half_extents(Vec3::new(100.0, 1.0, 100.0)).unwrap());
    for gap in [1e-3, 1e-6, 1e-9, 1e-11] {
        let (above, ground) = (Pose3::at([0.0, 2.0 + gap, 0.0]).unwrap(), Pose3::IDENTITY);
        let pair = Pair3::new(&cube, &above, &floor, &ground);
        assert_eq!(pair.cast(Vec3::X * 50.0), None, "{gap}");
        assert_eq!(pair.cast(Vec3::Y), None, "{gap}");
        let down = pair.cast(Vec3::new(1.0, -1.0, 0.0)).unwrap();
        assert!(down.fraction <= gap && down.normal == Vec3::NEG_Y, "{gap}: {down:?}");
    }
}

#[test]
fn motions_of_all_lengths_and_none_end_in_numbers() {
    let mut random = Random::new(5);
    let lengths = [0.0, 1e-45, 1e-30, 1e-6, 1.0, 1e9, 1e30, 3e38];
    for (name, make) in asunder_tests::shapes::KINDS3 {
        for (other, make_other) in asunder_tests::shapes::KINDS3 {
            let a = make(&mut asunder_tests::shapes::Clay::new(&mut random, 1.0));
            let b = make_other(&mut asunder_tests::shapes::Clay::new(&mut random, 10.0));
            let pose_a = Pose3::new(random.vector() * 20.0, random.quaternion()).unwrap();
            let pose_b = Pose3::new(random.vector() * 20.0, random.quaternion()).unwrap();
            let pair = Pair3::new(&a, &pose_a, &b, &pose_b);
            for length in lengths {
                let direction = random.direction().as_vec3();
                if let Some(impact) = pair.cast(direction * length) {
                    assert!((0.0..=1.0).contains(&impact.fraction), "{name} {other} {length}: {impact:?}");
                    assert!(impact.error >= 0.0 && impact.normal.is_finite(), "{name} {other}: {impact:?}");
                    assert!(impact.anchor_a.is_finite() && impact.anchor_b.is_finite(), "{impact:?}");
                }
                let Ok(motion) = Motion3::new(direction * length, Quat::from_xyzw(1e-40, 0.0, 3e38, 1.0))
                else {
                    continue;
                };
                if let Some(impact) = pair.impact(&motion, &motion) {
                    assert!((0.0..=1.0).contains(&impact.fraction), "{name} {other} {length}: {impact:?}");
                    assert!(impact.error >= 0.0 && impact.normal.is_finite(), "{name} {other}: {impact:?}");
                }
            }
        }
    }
}
