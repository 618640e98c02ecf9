//! A shape that a cast has brought to another may leave again, and whatever a cast hits is hit from the front.

use asunder::glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Chain, Circle, Cuboid, Motion2, Motion3, Pair2, Pair3, Pose2, Pose3, Rect, Rotation2,
    Shape2, Shape3, Sphere,
};
use asunder_tests::cases::Random;

/// From near the origin to so far out that positions are rounded to a hundred thousandth of a millimetre.
const PLACES: [f64; 5] = [0.0, 1.0, 100.0, 1e5, 1e8];

fn flat(random: &mut Random) -> Shape2 {
    match random.below(4) {
        0 => Circle::new(random.between(0.2, 1.0) as f32).unwrap().into(),
        1 => Capsule2::from_half_height(random.between(0.1, 1.0) as f32, 0.3).unwrap().into(),
        2 => Rect::from_half_extents(Vec2::new(0.5, 0.3)).unwrap().rounded(0.1).unwrap().into(),
        _ => random.shape2(),
    }
}

fn solid(random: &mut Random) -> Shape3 {
    match random.below(4) {
        0 => Sphere::new(random.between(0.2, 1.0) as f32).unwrap().into(),
        1 => Capsule3::from_half_height(random.between(0.1, 1.0) as f32, 0.3).unwrap().into(),
        2 => Cuboid::from_half_extents(Vec3::new(0.5, 0.3, 0.4)).unwrap().rounded(0.1).unwrap().into(),
        _ => random.shape3(),
    }
}

#[test]
fn what_a_cast_brought_there_may_leave() {
    let (mut met, mut left) = ([0; 2], [0; 2]);
    for seed in 0..4000 {
        let mut random = Random::new(seed);
        let far = PLACES[seed as usize % PLACES.len()];
        let (a, b) = (flat(&mut random), flat(&mut random));
        let from = Pose2::new(random.vector().truncate() * far, random.rotation2()).unwrap();
        let way = (random.direction2() * 8.0).as_vec2().as_dvec2();
        let to = Pose2::new(from.position() + way, random.rotation2()).unwrap();
        if let Some(hit) = Pair2::new(&a, &from, &b, &to).cast(way.as_vec2()) {
            let there = from.shifted(way * hit.fraction).unwrap();
            let pair = Pair2::new(&a, &there, &b, &to);
            met[0] += 1;
            // They may touch by the rounding of the position alone.
            if !pair.overlaps() {
                let normal = hit.normal.as_dvec2();
                let away = -normal + normal.perp() * random.between(-1.0, 1.0);
                let motion = Motion2::shift(away).unwrap();
                let told = [pair.cast(away.as_vec2()), pair.next_impact(&motion, &Motion2::STILL)];
                assert_eq!(told, [None, None], "{seed}: {a:?} {there:?} leaves {b:?} {to:?} by {away}");
                left[0] += 1;
            }
        }

        let (a, b) = (solid(&mut random), solid(&mut random));
        let from = Pose3::new(random.vector() * far, random.quaternion()).unwrap();
        let way = (random.direction() * 8.0).as_vec3().as_dvec3();
        let to = Pose3::new(from.position() + way, random.quaternion()).unwrap();
        if let Some(hit) = Pair3::new(&a, &from, &b, &to).cast(way.as_vec3()) {
            let there = from.shifted(way * hit.fraction).unwrap();
            let pair = Pair3::new(&a, &there, &b, &to);
            met[1] += 1;
            if !pair.overlaps() {
                let normal = hit.normal.as_dvec3();
                let away = -normal + normal.any_orthonormal_vector() * random.between(-1.0, 1.0);
                let motion = Motion3::shift(away).unwrap();
                let told = [pair.cast(away.as_vec3()), pair.next_impact(&motion, &Motion3::STILL)];
                assert_eq!(told, [None, None], "{seed}: {a:?} {there:?} leaves {b:?} {to:?} by {away}");
                left[1] += 1;
            }
        }
    }
    assert!(met.iter().zip(left).all(|(met, left)| *met > 3000 && left * 10 > met * 9), "{met:?} {left:?}");
}

#[test]
fn who_hovers_by_a_hair_and_rises_meets_nothing_though_it_turns() {
    let floor = Shape2::from(Rect::from_half_extents(Vec2::new(5.0, 0.5)).unwrap());
    let ground = Shape3::from(Cuboid::from_half_extents(Vec3::new(5.0, 0.5, 5.0)).unwrap());
    let flats: [(Shape2, f64); 3] = [
        (Circle::new(0.3).unwrap().into(), 0.3),
        (Rect::from_half_extents(Vec2::new(0.3, 0.2)).unwrap().into(), 0.2),
        (Capsule2::from_half_height(0.3, 0.2).unwrap().into(), 0.5),
    ];
    let solids: [(Shape3, f64); 3] = [
        (Sphere::new(0.3).unwrap().into(), 0.3),
        (Cuboid::from_half_extents(Vec3::new(0.3, 0.2, 0.4)).unwrap().into(), 0.2),
        (Capsule3::from_half_height(0.3, 0.2).unwrap().into(), 0.5),
    ];
    for gap in [1e-15, 1e-13, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6] {
        for (rise, turn) in [(0.1, 0.0), (0.1, 0.05), (1.0, 0.05), (10.0, 0.05)] {
            for (shape, down) in &flats {
                let pose = Pose2::at([0.1, 0.5 + down + gap]).unwrap();
                let pair = Pair2::new(shape, &pose, &floor, &Pose2::IDENTITY);
                let goal = Rotation2::from_angle(turn as f32).unwrap();
                let motion = Motion2::new([0.05, rise], goal).unwrap();
                let told = pair.impact(&motion, &Motion2::STILL);
                assert!(pair.overlaps() || told.is_none(), "{gap} {rise} {turn}: {shape:?} {told:?}");
            }
            for (shape, down) in &solids {
                let pose = Pose3::at([0.1, 0.5 + down + gap, 0.2]).unwrap();
                let pair = Pair3::new(shape, &pose, &ground, &Pose3::IDENTITY);
                let goal = Quat::from_xyzw((0.5 * turn) as f32, 0.0, 0.0, 1.0);
                let motion = Motion3::new([0.05, rise, 0.0], goal).unwrap();
                let told = pair.impact(&motion, &Motion3::STILL);
                assert!(pair.overlaps() || told.is_none(), "{gap} {rise} {turn}: {shape:?} {told:?}");
            }
        }
    }
}

#[test]
fn what_parts_slowly_while_it_turns_is_told_near_or_not_at_all() {
    // Balls beside long planks that turn: one step later, a fixed axis shows a gap only a twentieth wider.
    let (mut told, mut free) = (0, 0);
    for seed in 0..3000 {
        let mut random = Random::new(seed);
        let gap = random.pick(&[1e-4, 1e-3, 1e-2]);
        let (along, leaves) = (random.between(-1.5, 1.5), random.between(-0.1, 0.3));
        let (slides, turn) = (random.between(-1.5, 1.5), random.between(-0.7, 0.7));
        let half = [random.between(1.0, 4.0) as f32, 0.5];

        let plank = Shape2::from(Rect::from_half_extents(Vec2::from(half)).unwrap());
        let ball = Shape2::from(Circle::new(0.5).unwrap());
        let at = Pose2::at([along, 1.0 + gap]).unwrap();
        let motion = Motion2::shift([slides, leaves]).unwrap();
        let turns = Motion2::new(DVec2::ZERO, Rotation2::from_angle(turn as f32).unwrap()).unwrap();
        let pair = Pair2::new(&ball, &at, &plank, &Pose2::IDENTITY);
        let flat = pair.impact(&motion, &turns).map(|impact| (impact.fraction, impact.error));
        let apart = |fraction: f64| {
            let (ball_at, plank_at) =
                (motion.pose_at(&at, fraction), turns.pose_at(&Pose2::IDENTITY, fraction));
            Pair2::new(&ball, &ball_at, &plank, &plank_at).distance().map_or(0.0, |closest| closest.distance)
        };
        check_told(seed, flat, apart);

        let plank = Shape3::from(Cuboid::from_half_extents(Vec3::new(half[0], half[1], 1.0)).unwrap());
        let ball = Shape3::from(Sphere::new(0.5).unwrap());
        let at = Pose3::at([along, 1.0 + gap, 0.1]).unwrap();
        let motion = Motion3::shift([slides, leaves, 0.05]).unwrap();
        let turns = Motion3::new(DVec3::ZERO, Quat::from_xyzw(0.0, 0.02, (0.5 * turn) as f32, 1.0)).unwrap();
        let pair = Pair3::new(&ball, &at, &plank, &Pose3::IDENTITY);
        let solid = pair.impact(&motion, &turns).map(|impact| (impact.fraction, impact.error));
        let apart = |fraction: f64| {
            let (ball_at, plank_at) =
                (motion.pose_at(&at, fraction), turns.pose_at(&Pose3::IDENTITY, fraction));
            Pair3::new(&ball, &ball_at, &plank, &plank_at).distance().map_or(0.0, |closest| closest.distance)
        };
        check_told(seed, solid, apart);
        for impact in [flat, solid] {
            if impact.is_some() { told += 1 } else { free += 1 }
        }
    }
    assert!(told > 1500 && free > 1500, "{told} {free}");
}

/// Asserts that the bodies almost touch at the reported impact (a fraction and an error), and are apart until then;
/// `apart` gives their distance at a fraction.
fn check_told(seed: u128, told: Option<(f64, f32)>, apart: impl Fn(f64) -> f32) {
    if let Some((fraction, error)) = told {
        assert!(
            error < 1e-5 && apart(fraction) < 1e-5,
            "{seed}: told {error} m apart, {} m",
            apart(fraction)
        );
    }
    let until = told.map_or(1.0, |(fraction, _)| fraction);
    for moment in 0..64 {
        let fraction = until * f64::from(moment) / 64.0;
        assert!(apart(fraction) > 0.0, "{seed}: they touch at {fraction}, before {told:?}");
    }
}

#[test]
fn what_falls_about_in_a_cave_meets_its_walls_from_the_front_and_comes_to_rest() {
    let mut stops = 0;
    for seed in 0..120 {
        let mut random = Random::new(seed);
        let count = 6 + random.below(30);
        let corners = (0..count).map(|corner| {
            let turn = Rotation2::from_angle((core::f64::consts::TAU * corner as f64 / count as f64) as f32);
            (turn.unwrap().turn(DVec2::X) * random.between(6.0, 10.0)).as_vec2()
        });
        // From right to left over its floor: the front of a one-sided chain faces inwards.
        let mut corners: Vec<Vec2> = corners.collect();
        let is_one_sided = seed % 2 == 1;
        if is_one_sided {
            corners.reverse();
        }
        let cave = Chain::closed(corners).unwrap();
        let cave = Shape2::from(if is_one_sided { cave.one_sided() } else { cave });
        let shape = flat(&mut random);
        let mut pose = Pose2::new([0.0, 0.0], random.rotation2()).unwrap();
        let mut speed = random.vector().truncate() * 15.0;
        for step in 0..240 {
            speed.y -= 9.81 / 60.0;
            let mut left = 1.0 / 60.0;
            for _ in 0..8 {
                let pair = Pair2::new(&shape, &pose, &cave, &Pose2::IDENTITY);
                for manifold in pair.manifolds(1e-4) {
                    let normal = manifold.normal.as_dvec2();
                    speed -= normal * speed.dot(normal).max(0.0) * 1.4;
                }
                let way = speed * left;
                let motion = Motion2::shift(way).unwrap();
                let Some(hit) = pair.next_impact(&motion, &Motion2::STILL) else {
                    pose = pose.shifted(way).unwrap();
                    break;
                };
                let normal = hit.normal.as_dvec2();
                assert!(normal.dot(way) > -1e-4 * way.length(), "{seed} {step}: {hit:?} by {way}");
                pose = pose.shifted(way * hit.fraction).unwrap();
                left *= 1.0 - hit.fraction;
                speed -= normal * speed.dot(normal).max(0.0) * 1.4;
                stops += 1;
            }
            assert!(
                pose.position().length() < 10.0 && speed.length() < 60.0,
                "{seed} {step}: {pose:?} {speed}"
            );
        }
    }
    assert!(stops > 3000, "{stops}");
}

#[test]
fn a_cast_that_grazes_a_wall_it_left_goes_on_to_the_next() {
    // Two walls that face each other: a ball bounces between them a hundred times without sticking.
    let wall = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.5, 9.0, 9.0)).unwrap());
    let ball = Shape3::from(Sphere::new(0.25).unwrap());
    for far in [0.0, 123.456, 98_765.432] {
        let walls = [far - 3.1, far + 2.7].map(|x| Pose3::at([x, far, 0.0]).unwrap());
        let mut pose = Pose3::at([far, far, 0.1]).unwrap();
        let mut way = DVec3::new(9.0, 0.01, -0.02);
        for bounce in 0..100 {
            let next = walls.iter().filter_map(|at| Pair3::new(&ball, &pose, &wall, at).cast(way.as_vec3()));
            let hit = next.reduce(|one, other| if other.fraction < one.fraction { other } else { one });
            let Some(hit) = hit else { panic!("{far} {bounce}: through the wall from {pose:?}") };
            assert!(hit.fraction > 0.1 && hit.normal.as_dvec3().dot(way) > 0.0, "{far} {bounce}: {hit:?}");
            pose = pose.shifted(way * hit.fraction).unwrap();
            way -= hit.normal.as_dvec3() * (2.0 * hit.normal.as_dvec3().dot(way));
        }
    }
}
