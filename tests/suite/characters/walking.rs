//! Floors, slopes and stairs.

use super::stage::{Hero, capsule, cosine, crate_of_a_person, cuboid, floor, put, sine};
use asunder::glam::{DVec3, Vec3};
use asunder::{Collider3, Filter3, HalfSpace, Pose3, World3};

const SHAPES: [fn() -> asunder::Shape3; 2] = [capsule, crate_of_a_person];

#[test]
fn who_stands_on_a_floor_stays_there() {
    let world = floor();
    for shape in SHAPES {
        let mut hero = Hero::new(&world, shape(), DVec3::ZERO);
        let start = hero.pose;
        for _ in 0..100 {
            let slide = hero.step([0.0, -0.2, 0.0]);
            assert!(slide.ground.is_some_and(|ground| ground.normal == Vec3::Y) && !slide.blocked);
        }
        assert!(hero.pose.position().distance(start.position()) < 1e-6, "{}", hero.feet());
    }
}

#[test]
fn who_falls_lands_a_skin_above_the_floor() {
    let world = floor();
    for shape in SHAPES {
        let mut hero = Hero::new(&world, shape(), [0.0, 5.0, 0.0]);
        assert!(hero.step([0.5, -1.0, 0.0]).ground.is_none());
        assert!((hero.feet().x - 0.5).abs() < 1e-9);
        let slide = hero.step([1.0, -100.0, 0.0]);
        assert!(slide.ground.is_some());
        assert!(hero.feet().y.abs() < 1e-4, "{}", hero.feet());
    }
}

#[test]
fn who_jumps_leaves_the_ground() {
    let world = floor();
    let mut hero = Hero::new(&world, capsule(), DVec3::ZERO);
    let slide = hero.step([0.1, 0.15, 0.0]);
    assert!(slide.ground.is_none());
    assert!((hero.feet() - DVec3::new(0.1, 0.15, 0.0)).length() < 1e-6);
}

/// Symptom: in a frame that rises by less than a skin, or no faster than the slope ahead, ground was reported; a loop
/// that applies gravity only without ground lost the jump. Cause: ground was searched below even after an upward
/// motion.
#[test]
fn who_jumps_slowly_or_uphill_leaves_the_ground_too() {
    let world = floor();
    for up in [1e-4, 1e-3, 5e-3] {
        let mut hero = Hero::new(&world, capsule(), DVec3::ZERO);
        for frame in 1..=20 {
            assert!(hero.step([0.01, up, 0.0]).ground.is_none(), "{up} up");
            assert!((hero.feet().y - f64::from(frame) * f64::from(up)).abs() < 1e-5, "{}", hero.feet());
        }
    }
    for degrees in [20.0_f64, 40.0] {
        let world = slope(degrees);
        let mut hero = Hero::new(&world, capsule(), [-2.0, 0.0, 0.0]);
        hero.walk.steepest = cosine(50.0_f64.to_radians()) as f32;
        for _ in 0..60 {
            hero.step([0.1, -0.1, 0.0]);
        }
        assert!(hero.feet().y > 0.5, "on the slope: {}", hero.feet());
        let slide = hero.step([0.1, 0.02, 0.0]);
        assert!(slide.ground.is_none(), "{degrees} degrees: {slide:?}");
        assert!(hero.step([0.0, -0.3, 0.0]).ground.is_some(), "{degrees} degrees");
    }
}

#[test]
fn no_inner_edge_of_a_tiled_floor_catches() {
    // Tiles of width 0.7, which f32 does not hold: tops level, sides flush up to rounding.
    let mut world = World3::new();
    for x in -3..40 {
        for z in -2..3 {
            let at = [f64::from(x) * 0.7, -0.35, f64::from(z) * 0.7];
            put(&mut world, [0.35, 0.35, 0.35], at, 0.0);
        }
    }
    for shape in SHAPES {
        for gravity in [0.0, -0.1] {
            let mut hero = Hero::new(&world, shape(), DVec3::ZERO);
            let direction = Vec3::new(0.08, gravity, 0.013);
            for frame in 1..=200 {
                let slide = hero.step([direction.x, gravity, if frame % 50 < 25 { 0.013 } else { -0.013 }]);
                assert!(slide.ground.is_some() && slide.walls.is_empty(), "frame {frame}: {slide:?}");
                assert!(hero.feet().y.abs() < 1e-3, "{}", hero.feet());
            }
            assert!((hero.feet().x / 16.0 - 1.0).abs() < 0.01, "{}", hero.feet());
        }
    }
}

/// A slope of a hundred metres that starts at x = 0 on the floor, and rises towards +x.
fn slope(degrees: f64) -> World3 {
    let mut world = floor();
    let radians = degrees.to_radians();
    let along = DVec3::new(cosine(radians), sine(radians), 0.0);
    let normal = DVec3::new(-along.y, along.x, 0.0);
    put(&mut world, [50.0, 1.0, 20.0], along * 50.0 - normal, degrees);
    world
}

#[test]
fn slopes_are_climbed_up_to_the_limit_and_no_further() {
    for shape in SHAPES {
        for limit in [20.0_f64, 40.0, 60.0] {
            for (degrees, climbs) in [(limit - 0.5, true), (limit + 0.5, false)] {
                let world = slope(degrees);
                let mut hero = Hero::new(&world, shape(), [-2.0, 0.0, 0.0]);
                hero.walk.steepest = cosine(limit.to_radians()) as f32;
                for _ in 0..100 {
                    hero.step([0.1, -0.1, 0.02]);
                }
                let height = hero.feet().y;
                if climbs {
                    // 10.2 m at constant speed; 2 m lead to the slope, 0.4 less for a character with edges.
                    let most = 8.6 * sine(degrees.to_radians());
                    assert!(height > 0.85 * most && height < most + 0.1, "{degrees}: {}", hero.feet());
                } else {
                    assert!(height.abs() < 0.02 && hero.feet().x < 0.01, "{degrees}: {}", hero.feet());
                }
            }
        }
    }
}

#[test]
fn who_stands_on_a_slope_that_can_be_walked_on_does_not_slide_off() {
    let world = slope(35.0);
    for shape in SHAPES {
        let mut hero = Hero::new(&world, shape(), [-2.0, 0.0, 0.0]);
        for _ in 0..50 {
            hero.step([0.1, -0.1, 0.0]);
        }
        let there = hero.feet();
        assert!(there.y > 0.5);
        for _ in 0..200 {
            assert!(hero.step([0.0, -0.1, 0.0]).ground.is_some());
        }
        assert!(hero.feet().distance(there) < 1e-4, "{there} {}", hero.feet());
    }
}

#[test]
fn who_falls_on_a_slope_that_is_too_steep_slides_down() {
    let world = slope(60.0);
    for shape in SHAPES {
        // Pushing against the slope changes nothing: a character does not hang there.
        for push in [0.0, 0.1] {
            let mut hero = Hero::new(&world, shape(), [3.0, 8.0, 0.0]);
            for frame in 0..100 {
                let before = hero.feet();
                hero.step([push, -0.2, 0.0]);
                let lands = hero.feet().y < 0.3;
                assert!(lands || before.y - hero.feet().y > 0.1, "frame {frame}: {before} {}", hero.feet());
            }
            assert!(hero.feet().y.abs() < 0.02, "{}", hero.feet());
        }
    }
}

/// Symptom: down a slope of 40 degrees 3 m/s became 3.9, and a walking character came as near as half its skin to the
/// floor, so that it bobbed whenever it stopped. Cause: the ground that it stood on at first was hit only where the
/// motion led into it by enough.
#[test]
fn slopes_are_walked_as_fast_up_as_down_and_a_skin_above_them() {
    for shape in SHAPES {
        for (degrees, speed) in
            [0.0, 20.0, 40.0].into_iter().flat_map(|degrees| [(degrees, 0.05), (degrees, -0.05)])
        {
            let mut world = World3::new();
            put(&mut world, [50.0, 0.5, 50.0], DVec3::ZERO, degrees);
            let mut hero = Hero::new(&world, shape(), [0.0, 3.0, 0.0]);
            while hero.step([0.0, -0.2, 0.0]).ground.is_none() {}
            // On landing it comes slightly nearer than its skin, and is moved back to it.
            hero.step([speed, -0.003, 0.01]);
            let start = hero.feet();
            for frame in 0..60 {
                assert!(hero.step([speed, -0.003, 0.01]).ground.is_some());
                let from = (&hero.shape, &hero.pose);
                let near = world.closest_to_shape(from, 1.0, &Filter3::new()).unwrap();
                let off = near.distance / f64::from(hero.walk.skin) - 1.0;
                assert!(off.abs() < 0.02, "{degrees} {speed}, frame {frame}: {off} of the skin");
            }
            let came = (hero.feet() - start).length();
            let level = 60.0 * DVec3::new(speed.into(), 0.0, 0.01).length();
            assert!((came / level - 1.0).abs() < 1e-3, "{degrees} {speed}: {came} m, not {level}");
        }
    }
}

/// Symptom: a character that jumped once at a slope that is too steep, and ran on, climbed it for as long as it ran.
/// Cause: the guide's hero removed from its velocity the component into the slope, and the speed of its run turned
/// upwards.
#[test]
fn who_jumps_at_a_slope_that_is_too_steep_and_runs_on_comes_down_again() {
    for degrees in [48.0, 60.0, 80.0] {
        for run in [3.0, 6.0] {
            let world = slope(degrees);
            let mut hero = Hero::new(&world, capsule(), [-2.0, 0.0, 0.0]);
            let (time, mut fall, mut is_on_ground) = (1.0 / 60.0, 0.0, true);
            let mut highest = 0.0_f64;
            for frame in 0..600 {
                let start = if !is_on_ground {
                    fall
                } else if frame == 20 {
                    5.0
                } else {
                    0.0
                };
                fall = start - 9.81 * time;
                let slide = hero.step([(run * time) as f32, (fall * time) as f32, 0.0]);
                for wall in &slide.walls {
                    let up = f64::from(wall.normal.y);
                    fall -= up * (fall * up).min(0.0);
                }
                is_on_ground = slide.ground.is_some();
                highest = highest.max(hero.feet().y);
            }
            // 5 m/s lead 1.27 m up.
            assert!(highest > 1.0 && highest < 1.3, "{degrees} {run}: {highest} m");
            assert!(is_on_ground && hero.feet().y < 0.1, "{degrees} {run}: {}", hero.feet());
        }
    }
}

#[test]
fn a_ramp_is_followed_downhill_on_the_ground() {
    let world = slope(30.0);
    for shape in SHAPES {
        for gravity in [0.0, -0.05] {
            let mut hero = Hero::new(&world, shape(), [8.0, 6.0, 0.0]);
            hero.step([0.0, -5.0, 0.0]);
            let mut highest = hero.feet().y;
            assert!(highest > 3.0);
            for _ in 0..200 {
                assert!(hero.step([-0.15, gravity, 0.0]).ground.is_some(), "{}", hero.feet());
                assert!(hero.feet().y <= highest + 1e-6, "always down");
                highest = hero.feet().y;
            }
            assert!(hero.feet().y.abs() < 0.02 && hero.feet().x < -2.0, "{}", hero.feet());
        }
    }
}

/// Ten steps up towards +x, of this height and depth.
fn stairs(height: f64, depth: f64) -> World3 {
    let mut world = floor();
    for step in 1..=10 {
        let (top, from) = (height * f64::from(step), depth * f64::from(step));
        put(&mut world, [6.0, 1.0, 3.0], [from + 6.0, top - 1.0, 0.0], 0.0);
    }
    world
}

#[test]
fn stairs_are_climbed_and_descended_on_the_ground() {
    for shape in SHAPES {
        for (height, depth, speed) in
            [(0.18, 0.28, 0.06), (0.28, 0.3, 0.1), (0.1, 0.4, 0.005), (0.3, 0.5, 0.2)]
        {
            let world = stairs(height, depth);
            let mut hero = Hero::new(&world, shape(), [-1.0, 0.0, 0.3]);
            let frames = (7.0 / speed) as usize;
            for frame in 0..frames {
                let slide = hero.step([speed as f32, -0.02, 0.0]);
                assert!(slide.ground.is_some(), "up {height} {speed}, frame {frame}: {}", hero.feet());
            }
            let feet = hero.feet();
            assert!((feet.y - 10.0 * height).abs() < 0.02, "up {height} {speed}: {feet}");
            assert!(
                feet.x > -1.0 + 0.8 * 7.0,
                "at most a fifth of the speed is lost: {height} {speed}: {feet}"
            );
            for frame in 0..frames {
                let slide = hero.step([-speed as f32, -0.02, 0.0]);
                assert!(slide.ground.is_some(), "down {height} {speed}, frame {frame}: {}", hero.feet());
            }
            let feet = hero.feet();
            assert!(feet.y.abs() < 0.02 && feet.x < 0.0, "down {height} {speed}: {feet}");
        }
    }
}

#[test]
fn steps_that_are_too_high_or_not_wanted_are_walls() {
    for shape in SHAPES {
        for (height, step) in [(0.36, 0.35), (0.1, 0.0)] {
            let world = stairs(height, 0.4);
            let mut hero =
                Hero::new(&world, if step > 0.0 { shape() } else { crate_of_a_person() }, [-1.0, 0.0, 0.0]);
            hero.walk.step = step;
            for _ in 0..100 {
                hero.step([0.1, -0.02, 0.0]);
            }
            assert!(hero.feet().y.abs() < 0.02 && hero.feet().x < 0.4, "{}", hero.feet());
        }
    }
}

#[test]
fn nobody_climbs_a_step_in_the_air_or_under_a_low_ceiling() {
    let mut world = stairs(0.3, 2.0);
    let mut hero = Hero::new(&world, crate_of_a_person(), [0.5, 0.1, 0.0]);
    let slide = hero.step([2.0, 0.0, 0.0]);
    assert!(hero.feet().y > 0.09 && hero.feet().x < 1.6 && slide.blocked);
    // A ceiling 1.9 m above the floor, and 1.6 m above the step.
    put(&mut world, [6.0, 0.1, 6.0], [0.0, 2.0, 0.0], 0.0);
    let mut hero = Hero::new(&world, crate_of_a_person(), [0.5, 0.0, 0.0]);
    for _ in 0..20 {
        hero.step([0.2, -0.02, 0.0]);
    }
    assert!(hero.feet().y.abs() < 0.02 && hero.feet().x < 1.6, "{}", hero.feet());
}

#[test]
fn far_from_the_origin_all_is_the_same_up_to_rounding() {
    for shape in SHAPES {
        let path = |origin: f64| {
            let shift = DVec3::new(origin, -origin, origin);
            let mut world = World3::new();
            for (_, body) in stairs(0.2, 0.4).iter() {
                let pose = Pose3::new(body.pose().position() + shift, body.pose().rotation()).unwrap();
                world.insert(body.clone().at(pose));
            }
            let mut hero = Hero::new(&world, shape(), shift - DVec3::X);
            (0..100)
                .map(|_| {
                    hero.step([0.06, -0.02, 0.01]);
                    hero.pose.position() - shift
                })
                .collect::<Vec<_>>()
        };
        for (near, far) in path(0.0).into_iter().zip(path(1e7)) {
            // An ulp is 1.9e-9 there, and every frame adds a few roundings.
            assert!(near.distance(far) < 1e-5, "{near} {far}");
        }
    }
}

#[test]
fn sensors_disabled_bodies_and_oneself_are_not_in_the_way() {
    let mut world = floor();
    let wall = Collider3::new(cuboid([0.1, 2.0, 2.0])).at(Pose3::at([1.0, 1.0, 0.0]).unwrap());
    world.insert(wall.clone().sensor());
    world.insert(wall.disabled());
    let shape = capsule();
    let pose = Pose3::at([0.0, 0.91, 0.0]).unwrap();
    let own = world.insert(Collider3::new(shape.clone()).at(pose));
    let walk = asunder::Walk3::new(&shape, Vec3::Y).unwrap();
    let filter = Filter3::new().without(own);
    let slide = world.move_and_slide((&shape, &pose), Vec3::X * 3.0, &walk, &filter);
    assert!(
        slide.walls.is_empty() && slide.is_free && slide.moved.distance(DVec3::X * 3.0) < 1e-3,
        "{slide:?}"
    );
    assert!(
        !world.depenetrate((&shape, &pose), &Filter3::new()).moved.eq(&DVec3::ZERO),
        "itself, if not left out"
    );
    assert!(world.depenetrate((&shape, &pose), &filter).is_free);
}

#[test]
fn nonsense_is_no_harm() {
    let mut world = floor();
    world.insert(
        Collider3::new(HalfSpace::new(Vec3::new(-1.0, 0.2, 0.0)).unwrap())
            .at(Pose3::at([20.0, 0.0, 0.0]).unwrap()),
    );
    let shape = capsule();
    let pose = Pose3::at([0.0, 0.91, 0.0]).unwrap();
    let odd =
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE, 1e-45, -1.0, 0.0, 3.0];
    for a in odd {
        for b in odd {
            let mut hero = Hero {
                world: &world,
                shape: shape.clone(),
                walk: asunder::Walk3::new(&shape, Vec3::Y).unwrap(),
                pose,
            };
            let walk = asunder::Walk3 { up: Vec3::new(0.0, a, b), skin: b, steepest: a, step: a, snap: b };
            let filter = Filter3::new();
            for displacement in [Vec3::new(a, b, 0.0), Vec3::new(0.1, -0.1, 0.0)] {
                let slide = world.move_and_slide((&shape, &pose), displacement, &walk, &filter);
                assert!(slide.is_free && slide.moved.is_finite(), "{a} {b}: {slide:?}");
                assert!(super::stage::is_free(&world, &shape, &slide.pose));
                let half_space = HalfSpace::new(Vec3::Y).unwrap().into();
                let slide = world.move_and_slide((&half_space, &pose), displacement, &walk, &filter);
                assert_eq!((slide.moved, slide.is_free), (DVec3::ZERO, false));
                hero.step(displacement);
                assert!(hero.pose.position().y > 0.9, "{displacement}: {}", hero.pose.position());
            }
        }
    }
}

#[test]
fn who_is_too_close_is_moved_back_to_a_skin() {
    let mut world = floor();
    put(&mut world, [1.0, 3.0, 9.0], [1.402, 2.0, 0.0], 0.0);
    for shape in SHAPES {
        // 1 mm above the floor, 2 mm from the wall.
        let mut hero = Hero::new(&world, shape(), DVec3::ZERO);
        let skin = f64::from(hero.walk.skin);
        hero.pose = Pose3::at([0.0, 0.901, 0.0]).unwrap();
        hero.step([0.0, -0.1, 0.0]);
        assert!(hero.feet().y.abs() < 1e-4, "{}", hero.feet());
        assert!((hero.feet().x + skin - 0.002).abs() < 1e-4, "{}", hero.feet());
    }
}
