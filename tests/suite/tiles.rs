//! What bullets and casts hit on floors made of many bodies: walls and steps, and not the next tile's side.

use asunder::glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use asunder::{
    BodyKey2, BodyKey3, Capsule2, Capsule3, Circle, Collider2, Collider3, Compound3, Cuboid, Filter2,
    Filter3, HalfPlane, HalfSpace, Hit2, Hit3, Hooks3, Motion2, Motion3, Pose2, Pose3, Rect, Shape2, Shape3,
    Sphere, World2, World3,
};
use asunder_tests::cases::Random;

/// The x of the wall, whose face looks back along the floor.
const WALL: f64 = 6.0;

/// Bodies, with how far they reach down and ahead from their position.
fn solids() -> Vec<(Shape3, f64, f64)> {
    let balls =
        [0.3, -0.3].map(|x| (Pose3::at([x, 0.0, 0.0]).unwrap(), Shape3::from(Sphere::new(0.25).unwrap())));
    vec![
        (Sphere::new(0.5).unwrap().into(), 0.5, 0.5),
        (Cuboid::from_half_extents(Vec3::new(0.4, 0.3, 0.2)).unwrap().into(), 0.3, 0.4),
        (Capsule3::from_half_height(0.3, 0.2).unwrap().into(), 0.5, 0.2),
        (Compound3::new(balls).unwrap().into(), 0.25, 0.55),
    ]
}

fn slab(half: [f32; 3], at: [f64; 3]) -> Collider3 {
    Collider3::new(Cuboid::from_half_extents(Vec3::from(half)).unwrap()).at(Pose3::at(at).unwrap())
}

/// A yard at any pose: tiles about a metre wide whose tops are at height 0, and a wall.
struct Yard {
    world: World3,
    wall: BodyKey3,
    lies: Pose3,
}

impl Yard {
    fn new(random: &mut Random, lies: Pose3) -> Self {
        let mut world = World3::new();
        let mut insert = |body: Collider3| {
            let there = lies.compose(body.pose()).unwrap();
            world.insert(body.fixed().at(there))
        };
        let mut x = -7.0;
        while x < WALL + 1.0 {
            let width = random.between(0.3, 1.5);
            for z in [-2.0, 2.0] {
                let high = random.between(0.2, 1.0);
                insert(slab([width as f32 * 0.5, high as f32, 2.0], [x + 0.5 * width, -high, z]));
            }
            x += width;
        }
        let wall = insert(slab([1.0, 3.0, 4.0], [WALL + 1.0, 0.0, 0.0]));
        Self { world, wall, lies }
    }

    fn place(&self, at: DVec3) -> Pose3 {
        self.lies.compose(&Pose3::at(at).unwrap()).unwrap()
    }
}

/// Whether the wall is hit, at the expected fraction of the way; panics if anything else is reported.
fn meets_wall<K: PartialEq>(seed: u128, told: Option<(K, f64)>, (wall, expected): (K, f64)) -> bool {
    let Some((other, fraction)) = told else {
        assert!(expected > 1.0 - 1e-5, "{seed}: through the wall at {expected}");
        return false;
    };
    assert!(other == wall, "{seed}: stopped by a tile at {fraction}, {expected}");
    assert!((fraction - expected).abs() < 1e-5, "{seed}: {fraction}, not {expected}");
    true
}

#[test]
fn who_sinks_into_a_tile_is_led_over_the_next_and_into_the_wall() {
    let (mut walls, mut free) = (0, 0);
    for seed in 0..1500 {
        let mut random = Random::new(seed);
        let lies = if random.below(2) == 0 {
            Pose3::IDENTITY
        } else {
            Pose3::new(random.vector() * random.pick(&[3.0, 1e5]), random.quaternion()).unwrap()
        };
        let mut yard = Yard::new(&mut random, lies);
        let (shape, down, ahead) = solids().swap_remove(random.below(4));
        let pressed = random.pick(&[1e-6, 1e-3, 0.02]);
        let start = DVec3::new(random.between(-5.0, 4.0), down - pressed, random.between(-1.0, 1.0));
        let falls = random.pick(&[0.0, 1e-6, 2.7e-3, 0.05]);
        let way = DVec3::new(random.between(0.5, 12.0), -falls, random.between(-1.0, 1.0));
        let (here, flies) = (yard.place(start), lies.turn(way));
        let bullet = yard.world.insert(Collider3::new(shape.clone()).at(here).bullet());
        yard.world.set_motion(bullet, Motion3::shift(flies).unwrap()).unwrap();
        yard.world.update();
        let hit = yard.world.impacts().first().map(|hit| (hit.other, hit.impact.fraction));
        let filter = Filter3::new().without(bullet);
        let cast = yard.world.cast_shape_onwards((&shape, &here), flies.as_vec3(), &filter);
        let cast = cast.map(|hit| (hit.body, hit.fraction));
        let expected = (WALL - ahead - start.x) / way.x;
        for told in [hit, cast] {
            if meets_wall(seed, told, (yard.wall, expected)) { walls += 1 } else { free += 1 }
        }
    }
    assert!(walls > 800 && free > 800, "{walls} {free}");
}

#[test]
fn who_sinks_into_a_tile_of_the_plane_is_led_over_the_next_and_into_the_wall() {
    let (mut walls, mut free) = (0, 0);
    for seed in 0..3000 {
        let mut random = Random::new(seed);
        let lies = if random.below(2) == 0 {
            Pose2::IDENTITY
        } else {
            Pose2::new(random.vector().truncate() * random.pick(&[3.0, 1e5]), random.rotation2()).unwrap()
        };
        let mut world = World2::new();
        let mut insert = |half: [f64; 2], at: [f64; 2]| -> BodyKey2 {
            let rect = Rect::from_half_extents(DVec2::from(half).as_vec2()).unwrap();
            let there = lies.compose(&Pose2::at(at).unwrap()).unwrap();
            world.insert(Collider2::new(rect).fixed().at(there))
        };
        let mut x = -7.0;
        while x < WALL + 1.0 {
            let (width, high) = (random.between(0.3, 1.5), random.between(0.2, 1.0));
            // In the same numbers that it is built from: a tile that is rounded wider makes a seam.
            let half = f64::from((width * 0.5) as f32);
            insert([half, high], [x + half, -f64::from(high as f32)]);
            x += 2.0 * half;
        }
        let wall = insert([1.0, 3.0], [WALL + 1.0, 0.0]);
        let bodies: [(Shape2, f64, f64); 3] = [
            (Circle::new(0.5).unwrap().into(), 0.5, 0.5),
            (Rect::from_half_extents(Vec2::new(0.4, 0.3)).unwrap().into(), 0.3, 0.4),
            (Capsule2::from_half_height(0.3, 0.2).unwrap().into(), 0.5, 0.2),
        ];
        let (shape, down, ahead) = &bodies[random.below(3)];
        let pressed = random.pick(&[1e-6, 1e-3, 0.02]);
        let start = DVec2::new(random.between(-5.0, 4.0), down - pressed);
        let way = DVec2::new(random.between(0.5, 12.0), -random.pick(&[0.0, 1e-6, 2.7e-3, 0.05]));
        let (here, flies) = (lies.compose(&Pose2::at(start).unwrap()).unwrap(), lies.turn(way));
        let bullet = world.insert(Collider2::new(shape.clone()).at(here).bullet());
        world.set_motion(bullet, Motion2::shift(flies).unwrap()).unwrap();
        world.update();
        let hit = world.impacts().first().map(|hit: &Hit2| (hit.other, hit.impact.fraction));
        let filter = Filter2::new().without(bullet);
        let cast = world.cast_shape_onwards((shape, &here), flies.as_vec2(), &filter);
        let cast = cast.map(|hit| (hit.body, hit.fraction));
        let expected = (WALL - ahead - start.x) / way.x;
        for told in [hit, cast] {
            if meets_wall(seed, told, (wall, expected)) { walls += 1 } else { free += 1 }
        }
    }
    assert!(walls > 1500 && free > 1500, "{walls} {free}");
}

#[test]
fn a_ball_that_rolls_over_tiles_is_never_stopped() {
    let mut yard = Yard::new(&mut Random::new(7), Pose3::IDENTITY);
    let ball = Collider3::new(Sphere::new(0.25).unwrap()).bullet();
    let ball = yard.world.insert(ball.at(Pose3::at([-6.0, 0.2495, 0.1]).unwrap()));
    let (mut velocity, mut bounces) = (0.11, 0);
    let mut rotation = Quat::IDENTITY;
    for frame in 0..400 {
        let start = *yard.world.get(ball).unwrap().pose();
        let step = DVec3::new(velocity, -2.7e-3, 0.0);
        let spin = Quat::from_xyzw(0.0, 0.0, -0.5 * (velocity / 0.25) as f32, 1.0).normalize();
        rotation = (spin * rotation).normalize();
        yard.world.set_motion(ball, Motion3::new(step, rotation).unwrap()).unwrap();
        yard.world.update();
        let hit: Option<&Hit3> = yard.world.impacts().first();
        let fraction = hit.map_or(1.0, |hit| hit.impact.fraction);
        if let Some(hit) = hit {
            assert!(hit.other == yard.wall, "{frame}: stopped by a tile: {hit:?}");
            velocity = -velocity;
            bounces += 1;
        }
        // A solver would undo the fall; a hair off the wall.
        let x = start.position().x + step.x * fraction;
        let place = DVec3::new(x.min(WALL - 0.2501), 0.2495, 0.1);
        if place.x < -6.0 {
            velocity = -velocity;
        }
        yard.world.set_pose(ball, Pose3::new(place, rotation).unwrap()).unwrap();
    }
    assert!(bounces >= 1, "{bounces}");
}

/// Whether a body that stands on a tile and moves along x hits the next tile, whose top is at this height.
fn next_tile(
    world: &mut World3,
    (depth, fall): (f64, f64),
    height: f64,
    floor: impl Fn(Collider3) -> Collider3,
) -> bool {
    world.insert(floor(slab([1.0, 0.5, 2.0], [0.0, -0.5, 0.0]).fixed()));
    let next = world.insert(slab([1.0, 0.5, 2.0], [2.0, height - 0.5, 0.0]).fixed());
    let box_ = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap()).bullet();
    let box_ = world.insert(box_.at(Pose3::at([0.0, 0.4 - depth, 0.0]).unwrap()));
    world.set_motion(box_, Motion3::shift([1.5, -fall, 0.0]).unwrap()).unwrap();
    let hooks = Hooks3::new();
    world.update_with(&hooks);
    let met = world.impacts().iter().any(|hit| hit.other == next);
    let shape = world.get(box_).unwrap().shape().clone();
    let from = Pose3::at([0.0, 0.4 - depth, 0.0]).unwrap();
    let way = Vec3::new(1.5, -fall as f32, 0.0);
    let cast = world.cast_shape_onwards((&shape, &from), way, &Filter3::new().without(box_));
    assert_eq!(cast.is_some_and(|hit| hit.body == next), met, "casts and bullets are of one mind");
    met
}

#[test]
fn what_stands_higher_or_is_gone_into_deeply_stops() {
    let meets = |sunk, height| next_tile(&mut World3::new(), sunk, height, |floor| floor);
    // The box is 0.4 thick from its centre: up to 6.25 mm are level.
    for (height, expected) in [(0.0, false), (0.006, false), (0.0065, true), (0.2, true), (-0.0005, false)] {
        assert_eq!(meets((0.001, 0.0), height), expected, "{height} m higher");
    }
    // Level to a depth of 0.2, including the fall.
    assert!(!meets((0.19, 0.0), 0.0) && meets((0.21, 0.0), 0.0));
    assert!(!meets((0.05, 0.14), 0.0) && meets((0.05, 0.16), 0.0));
}

#[test]
fn what_carries_nobody_is_no_floor() {
    assert!(!next_tile(&mut World3::new(), (0.001, 0.0), 0.0, |floor| floor));
    // As a sensor, disabled, of the same owner, or without a common layer, a tile carries nobody.
    assert!(next_tile(&mut World3::new(), (0.001, 0.0), 0.0, Collider3::sensor));
    assert!(next_tile(&mut World3::new(), (0.001, 0.0), 0.0, Collider3::disabled));
}

/// The fraction at which a ball in a floor whose top is at height 0 hits something on its way.
fn met_by_ball(walls: Vec<Collider3>, from: [f64; 3], way: [f64; 3]) -> Option<f64> {
    let mut world = World3::new();
    world.insert(slab([9.0, 1.0, 9.0], [0.0, -1.0, 0.0]).fixed());
    walls.into_iter().for_each(|wall| _ = world.insert(wall.fixed()));
    let ball = Collider3::new(Sphere::new(0.25).unwrap()).bullet();
    let ball = world.insert(ball.at(Pose3::at(from).unwrap()));
    world.set_motion(ball, Motion3::shift(way).unwrap()).unwrap();
    world.update();
    let hit = world.impacts().first().map(|hit| hit.impact.fraction);
    let (shape, pose) = (world.get(ball).unwrap().shape().clone(), Pose3::at(from).unwrap());
    let way = DVec3::from(way).as_vec3();
    let cast = world.cast_shape_onwards((&shape, &pose), way, &Filter3::new().without(ball));
    let cast = cast.map(|cast| cast.fraction);
    let are_equal =
        hit.is_some() == cast.is_some() && (hit.unwrap_or(0.0) - cast.unwrap_or(0.0)).abs() < 1e-6;
    assert!(are_equal, "casts and bullets are of one mind: {hit:?} {cast:?}");
    hit
}

/// Symptom: balls went through half-spaces whose pose was level with the floor. Cause: a half-space was taken to end at
/// its position along any axis.
#[test]
fn what_has_no_end_is_flush_with_nothing() {
    for height in [0.0, 0.001, -0.0005, 1.0, -3.0] {
        let wall = Collider3::new(HalfSpace::new(Vec3::NEG_X).unwrap());
        let wall = wall.at(Pose3::at([6.0, height, 0.0]).unwrap());
        let met = met_by_ball(vec![wall], [0.0, 0.2495, 0.0], [12.0, 0.0, 0.0]).unwrap();
        assert!((met * 12.0 - 5.75).abs() < 1e-5, "{height}: {met}");
    }
    for ahead in [0.002, 0.007] {
        let mut world = World2::new();
        let floor = Rect::from_half_extents(Vec2::new(9.0, 1.0)).unwrap();
        world.insert(Collider2::new(floor).fixed().at(Pose2::at([0.0, -1.0]).unwrap()));
        let wall = Collider2::new(HalfPlane::new(Vec2::NEG_X).unwrap());
        let wall = world.insert(wall.fixed().at(Pose2::at([0.5 + ahead, 0.0]).unwrap()));
        let ball = Collider2::new(Circle::new(0.5).unwrap()).bullet();
        let ball = world.insert(ball.at(Pose2::at([0.0, 0.499]).unwrap()));
        world.set_motion(ball, Motion2::shift([0.2, 0.0]).unwrap()).unwrap();
        world.update();
        assert!(matches!(world.impacts(), [hit] if hit.other == wall), "{ahead}: {:?}", world.impacts());
    }
}

/// Symptom: a ball deep in the floor that rose went through fences whose tops were level with the floor. Cause: its
/// depth at the start was not taken into account, and rising reduced it.
#[test]
fn who_is_stuck_deep_and_rises_is_led_over_nothing() {
    let fence = |half: f32| slab([half, 0.5, 4.0], [9.0 + 3.0, -0.5, 0.0]);
    for (depth, rise) in [(0.3, 0.3), (0.2, 0.2), (0.2, 0.0), (0.1, 0.0)] {
        let met = met_by_ball(vec![fence(0.025)], [8.0, 0.25 - depth, 0.0], [8.0, rise, 0.0]);
        // The fence is 2.5 cm thick from its centre: half of that is 1.25 cm.
        assert!(met.is_some(), "{depth} deep, by {rise}");
        let met = met_by_ball(vec![fence(1.0)], [8.0, 0.25 - depth, 0.0], [8.0, rise, 0.0]);
        assert_eq!(met.is_some(), depth > 0.125, "{depth} deep, by {rise}");
    }
}

#[test]
fn a_bullet_that_stands_still_is_led_over_as_one_that_says_so() {
    // A millimetre deep in its tile, while a platform of the same height comes from the side.
    for is_said in [false, true] {
        let mut world = World3::new();
        world.insert(slab([1.0, 0.5, 2.0], [0.0, -0.5, 0.0]).fixed());
        let platform = world.insert(slab([1.0, 0.5, 2.0], [3.0, -0.5, 0.0]));
        let ball = Collider3::new(Sphere::new(0.25).unwrap()).bullet();
        let ball = world.insert(ball.at(Pose3::at([0.9, 0.249, 0.0]).unwrap()));
        world.set_motion(platform, Motion3::shift([-2.0, 0.0, 0.0]).unwrap()).unwrap();
        if is_said {
            world.set_motion(ball, Motion3::STILL).unwrap();
        }
        world.update();
        assert!(world.impacts().is_empty(), "{is_said}: {:?}", world.impacts());
    }
}
