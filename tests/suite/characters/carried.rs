//! Characters that something carries.

use super::stage::{Hero, capsule, cosine, cuboid, sine};
use asunder::glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use asunder::{
    Circle, Collider2, Collider3, Filter2, Footing2, Footing3, Hull, Obstacle3, Pose2, Pose3, Rect,
    Rotation2, Shape3, Slide3, Walk2, Walk3, World2, World3,
};
use asunder_tests::cases::Random;

fn block() -> Collider3 {
    Collider3::new(cuboid([3.0, 0.5, 3.0]))
}

/// A quaternion of a turn about y, in 64ths of a turn.
fn spun(steps: u32) -> Quat {
    let half = core::f64::consts::PI * f64::from(steps % 64) / 64.0;
    Quat::from_xyzw(0.0, sine(half) as f32, 0.0, cosine(half) as f32)
}

/// The same in either dimension: how a vector and a rotation are made, and a body.
macro_rules! the_foot_goes_where_its_place_goes {
    ($name:ident, $World:ident, $Pose:ident, $Footing:ident, $vector:expr, $rotation:expr, $body:expr) => {
        #[test]
        fn $name() {
            let random = &mut Random::new(9100);
            for round in 0..2000 {
                let far = random.pick(&[1.0, 100.0, 1e6]);
                let [then, now] =
                    [(); 2].map(|()| $Pose::new($vector(random) * far, $rotation(random)).unwrap());
                let mut world = $World::new();
                let body = world.insert($body.at(then));
                let point = then.transform($vector(random));
                let footing = $Footing { body, pose: then, point };
                let hero = $Pose::new(point + $vector(random), $rotation(random)).unwrap();
                world.set_pose(body, now).unwrap();
                let carried = world.carried(&footing, &hero);
                let expected = hero.position() + now.transform(then.transform_back(point)) - point;
                assert!(carried.same_rotation(&hero));
                assert!((carried.position() - expected).length() <= 1e-14 * far + 1e-15, "round {round}");
            }
        }
    };
}

the_foot_goes_where_its_place_goes!(
    the_foot_goes_where_its_place_on_the_body_goes,
    World3,
    Pose3,
    Footing3,
    Random::vector,
    Random::quaternion,
    block()
);

the_foot_goes_where_its_place_goes!(
    the_foot_goes_where_its_place_on_the_body_goes_in_the_plane,
    World2,
    Pose2,
    Footing2,
    |random: &mut Random| random.vector().truncate(),
    Random::rotation2,
    Collider2::new(Rect::from_half_extents(Vec2::ONE).unwrap())
);

/// Rounding would let the character creep on a lift that shuttles for hours.
#[test]
fn a_lift_far_out_carries_by_exactly_its_way() {
    let mut world = World3::new();
    let at = DVec3::new(1e7, -3e6, 5e8);
    let turn = Quat::from_xyzw(0.1, 0.7, -0.3, 0.4);
    let lift = world.insert(block().at(Pose3::new(at, turn).unwrap()));
    let point = at + DVec3::new(0.3, 0.7, 1.1);
    let mut hero = Pose3::at(at + DVec3::Y * 2.0).unwrap();
    let start = hero;
    let way = DVec3::new(0.015625, 0.25, -0.125);
    for frame in 0..200 {
        let footing = Footing3 { body: lift, pose: *world.pose(lift).unwrap(), point };
        assert!(world.carried(&footing, &hero).same_bits(&hero), "it has not moved");
        let lifted = world.pose(lift).unwrap().shifted(if frame < 100 { way } else { -way }).unwrap();
        world.set_pose(lift, lifted).unwrap();
        hero = world.carried(&footing, &hero);
    }
    assert!(hero.same_bits(&start), "{}", hero.position() - start.position());
}

#[test]
fn nobody_is_carried_by_what_is_gone_or_off_or_out_of_range() {
    let mut world = World3::new();
    let lift = world.insert(block());
    let hero = Pose3::at([-0.0, 1.5, 0.0]).unwrap();
    // At a corner of its foot; what is carried is below its position.
    let corner = DVec3::new(0.75, 0.5, -0.25);
    let ground = Obstacle3 { body: lift, normal: Vec3::Y, point: corner, part: 0 };
    let (walls, moved) = (Default::default(), DVec3::ZERO);
    let slide = Slide3 { pose: hero, moved, ground: Some(ground), walls, blocked: false, is_free: true };
    let walk = Walk3::new(&capsule(), Vec3::Y).unwrap();
    let footing = world.footing(&slide, &walk).unwrap();
    assert_eq!((footing.body, footing.pose, footing.point), (lift, Pose3::IDENTITY, DVec3::Y * 0.5));
    world.set_pose(lift, Pose3::at([0.0, 1.0, 0.0]).unwrap()).unwrap();
    assert_eq!(world.carried(&footing, &hero), hero.shifted([0.0, 1.0, 0.0]).unwrap());
    let at_the_edge = Pose3::at([0.0, 1e9, 0.0]).unwrap();
    assert!(world.carried(&footing, &at_the_edge).same_bits(&at_the_edge));
    let broken = Footing3 { point: DVec3::NAN, ..footing };
    assert!(world.carried(&broken, &hero).position().is_finite());
    assert!(world.disable(lift).is_ok());
    assert!(world.carried(&footing, &hero).same_bits(&hero));
    assert!(world.enable(lift).is_ok());
    world.remove(lift);
    assert!(world.carried(&footing, &hero).same_bits(&hero));
    assert_eq!(world.footing(&slide, &walk), None);
    let next = world.insert(block().at(Pose3::at([0.0, 9.0, 0.0]).unwrap()));
    assert!(next != lift && world.carried(&footing, &hero).same_bits(&hero), "a body in the same slot");
}

#[test]
fn a_merry_go_round_takes_its_riders_around() {
    let mut world = World3::new();
    let disc = world.insert(block());
    let mut rider = Pose3::at([1.5, 1.5, -0.5]).unwrap();
    let mut footing = None;
    for step in 0..=128 {
        let turned = Pose3::new([0.05 * f64::from(step), 0.02 * f64::from(step), 0.0], spun(step)).unwrap();
        world.set_pose(disc, turned).unwrap();
        if let Some(footing) = &footing {
            rider = world.carried(footing, &rider);
        }
        let mut hero = Hero { pose: rider, ..Hero::new(&world, capsule(), DVec3::ZERO) };
        let slide = hero.step([0.0, -0.1, 0.0]);
        rider = slide.pose;
        footing = world.footing(&slide, &hero.walk);
        assert!(footing.is_some_and(|footing| footing.body == disc), "it still rides: step {step}");
        let seen = world.pose(disc).unwrap().transform_back(rider.position());
        assert!((seen - DVec3::new(1.5, seen.y, -0.5)).length() < 1e-5, "step {step}: {seen}");
    }
}

/// Symptom: a crate that stood still on a turntable wandered over it, by 2 m in a full turn and a quarter: it turned about
/// whichever of its corners was found first. Over a top that is tilted, its upper
/// corners still push it by 2 cm in each turn.
#[test]
fn a_turntable_keeps_all_feet_where_they_stand() {
    let corners = (0..16).map(|i| {
        let angle = core::f64::consts::TAU * f64::from(i % 8) / 8.0;
        let height = if i < 8 { -0.9 } else { 0.9 };
        Vec3::new(0.3 * cosine(angle) as f32, height, 0.3 * sine(angle) as f32)
    });
    let prism = Shape3::from(Hull::from_points(&corners.collect::<Vec<_>>()).unwrap());
    let shapes = [cuboid([0.3, 0.9, 0.3]), prism, capsule()];
    for (tilt, most) in [(0.0, 1e-9), (0.1, 0.12)] {
        let tilted = Quat::from_xyzw(sine(tilt) as f32, 0.0, 0.0, cosine(tilt) as f32);
        for (number, shape) in shapes.iter().enumerate() {
            let mut world = World3::new();
            let disc = world.insert(block().at(Pose3::new(DVec3::ZERO, tilted).unwrap()));
            let (mut rider, mut footing) = (Pose3::at([1.3, 1.7, 0.8]).unwrap(), None);
            let mut stood: Option<DVec3> = None;
            for step in 0..320 {
                let turned = Pose3::new(DVec3::ZERO, spun(step) * tilted).unwrap();
                world.set_pose(disc, turned).unwrap();
                if let Some(footing) = &footing {
                    rider = world.carried(footing, &rider);
                }
                let mut hero = Hero { pose: rider, ..Hero::new(&world, shape.clone(), DVec3::ZERO) };
                let slide = hero.step([0.0, if step == 0 { -0.9 } else { -0.01 }, 0.0]);
                rider = slide.pose;
                footing = world.footing(&slide, &hero.walk);
                assert!(footing.is_some(), "{number} at {tilt}: step {step}");
                // Straight below or above its position, since only that is carried.
                let [x, z] = [rider.position().x, rider.position().z];
                let seen = DVec3::new(x, 0.0, z);
                let seen = Pose3::new(DVec3::ZERO, spun(step)).unwrap().transform_back(seen);
                let off = (seen - *stood.get_or_insert(seen)).length();
                assert!(off < most, "{number} at {tilt}, step {step}: {off} m off");
            }
        }
    }
}

#[test]
fn a_seesaw_carries_the_feet_and_not_the_head() {
    let mut world = World2::new();
    let plank = world.insert(Collider2::new(Rect::from_half_extents(Vec2::new(4.0, 0.25)).unwrap()));
    let ball = Circle::new(0.5).unwrap().into();
    let walk = Walk2::new(&ball, Vec2::Y).unwrap();
    let filter = Filter2::new();
    let slide = world.move_and_slide((&ball, &Pose2::at([2.0, 0.8]).unwrap()), Vec2::NEG_Y, &walk, &filter);
    let mut rider = slide.pose;
    let mut footing = world.footing(&slide, &walk).unwrap();
    let gap = rider.position().y - 0.75;
    for step in 1..=40 {
        // Up to 20 degrees, which can be walked on.
        let angle = f64::from(step) * 0.5_f64.to_radians();
        let turned = Rotation2::new(cosine(angle) as f32, sine(angle) as f32).unwrap();
        world.set_pose(plank, Pose2::new(DVec2::ZERO, turned).unwrap()).unwrap();
        rider = world.carried(&footing, &rider);
        let slide = world.move_and_slide((&ball, &rider), Vec2::NEG_Y * 0.01, &walk, &filter);
        rider = slide.pose;
        footing = world.footing(&slide, &walk).unwrap();
        let (ground, on_plank) = (slide.ground.unwrap().point, *world.pose(plank).unwrap());
        assert_eq!((footing.body, footing.pose), (plank, on_plank), "step {step}");
        assert_eq!(footing.point.x, rider.position().x, "step {step}");
        assert!((footing.point.y - ground.y).abs() < 1e-12, "step {step}: {} {ground}", footing.point);
        // Where a ball of this radius touches the plank, along it from the pivot, and how high it is above.
        let seen = world.pose(plank).unwrap().transform_back(rider.position());
        assert!((seen.y - 0.75 - gap).abs() < 0.25 * f64::from(walk.skin), "step {step}: {seen}");
        // Its centre is above the foot, so the foot moves on a little with each step; never by more than a head's way.
        assert!((seen.x - 2.0).abs() < 0.5, "step {step}: {seen}");
    }
}
