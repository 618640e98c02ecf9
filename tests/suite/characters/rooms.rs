//! Seeded rooms full of things, closed by thin walls: whatever a character does in there, it gets into nothing, and not
//! out.

use super::stage::{capsule, check_length, crate_of_a_person, cuboid, is_free, put};
use asunder::glam::{DVec3, Vec3};
use asunder::{Collider3, Compound3, Filter3, Hull, Pose3, Shape3, Sphere, Walk3, World3};
use asunder_scenes::random::Random;

/// Half of a room's side, in metres.
const ROOM: f64 = 4.0;

/// A room closed by walls of a millimetre, with some of everything in it.
fn room(random: &mut Random) -> World3 {
    let mut world = World3::new();
    let (wide, thin) = (ROOM as f32 + 0.1, 0.0005);
    for side in [-ROOM, ROOM] {
        put(&mut world, [thin, wide, wide], [side, 0.0, 0.0], 0.0);
        put(&mut world, [wide, thin, wide], [0.0, side, 0.0], 0.0);
        put(&mut world, [wide, wide, thin], [0.0, 0.0, side], 0.0);
    }
    for _ in 0..random.below(24) {
        let half = random.within(DVec3::splat(0.05), DVec3::splat(0.9)).as_vec3();
        let shape: Shape3 = match random.below(5) {
            0 => Sphere::new(half.x).unwrap().into(),
            1 => {
                let points: Vec<Vec3> = (0..12).map(|_| random.direction().as_vec3() * half).collect();
                Hull::from_points(&points).unwrap().into()
            }
            2 => {
                let part =
                    |at: Vec3| (Pose3::new(at, random.clone().rotation()).unwrap(), cuboid(half * 0.6));
                Compound3::new([part(half), part(-half)]).unwrap().into()
            }
            _ => cuboid(half),
        };
        let at = random.within(DVec3::splat(-ROOM), DVec3::splat(ROOM));
        let pose = if random.unit() < 0.5 { Pose3::at(at) } else { Pose3::new(at, random.rotation()) };
        let body = Collider3::new(shape).at(pose.unwrap());
        world.insert(if random.below(12) == 0 { body.sensor() } else { body });
    }
    world
}

#[test]
fn whoever_starts_free_ends_free_and_inside() {
    let mut random = Random::new(90);
    let (mut walked, mut met, mut grounded, mut blocked) = (0, 0, 0, 0);
    for case in 0..1500 {
        let world = room(&mut random);
        let shape: Shape3 = match random.below(4) {
            0 => capsule(),
            1 => crate_of_a_person(),
            2 => Sphere::new(random.range(0.05, 0.5) as f32).unwrap().into(),
            _ => cuboid(random.within(DVec3::splat(0.05), DVec3::splat(0.5)).as_vec3()),
        };
        let start = random.within(DVec3::splat(-ROOM + 0.9), DVec3::splat(ROOM - 0.9));
        let mut pose = Pose3::new(
            start,
            if random.unit() < 0.7 { asunder::glam::Quat::IDENTITY } else { random.rotation() },
        )
        .unwrap();
        if !is_free(&world, &shape, &pose) {
            continue;
        }
        let walk = Walk3 {
            steepest: random.range(0.3, 0.95) as f32,
            step: if random.unit() < 0.5 { 0.0 } else { random.range(0.0, 1.0) as f32 },
            ..Walk3::new(&shape, if random.unit() < 0.9 { Vec3::Y } else { random.direction().as_vec3() })
                .unwrap()
        };
        for _ in 0..12 {
            let displacement = (random.direction() * random.log_range(1e-4, 100.0)).as_vec3();
            let displacement = if random.unit() < 0.3 { Vec3::NEG_Y * 0.1 } else { displacement };
            let slide = world.move_and_slide((&shape, &pose), displacement, &walk, &Filter3::new());
            check_length(&slide, displacement, &walk);
            assert!(slide.is_free && is_free(&world, &shape, &slide.pose), "{case}: {slide:?}");
            let at = slide.pose.position();
            assert!(at.abs().max_element() < ROOM, "{case}: out of the room at {at}");
            for wall in slide.walls.iter().chain(&slide.ground) {
                assert!((wall.normal.length() - 1.0).abs() < 1e-5 && wall.point.is_finite());
            }
            let again = world.clone().move_and_slide((&shape, &pose), displacement, &walk, &Filter3::new());
            assert_eq!(slide, again, "a function of the bodies alone");
            (walked, met) = (walked + 1, met + slide.walls.len());
            (grounded, blocked) =
                (grounded + usize::from(slide.ground.is_some()), blocked + usize::from(slide.blocked));
            pose = slide.pose;
        }
    }
    assert!(
        walked > 5000 && met > 3000 && grounded > 1000 && blocked > 300,
        "{walked} {met} {grounded} {blocked}"
    );
}

#[test]
fn whoever_starts_in_the_middle_of_it_is_told_the_truth() {
    let mut random = Random::new(91);
    let (mut freed, mut wedged) = (0, 0);
    for case in 0..1000 {
        let world = room(&mut random);
        let shape = if random.unit() < 0.5 { capsule() } else { crate_of_a_person() };
        let mut pose = Pose3::at(random.within(DVec3::splat(-ROOM), DVec3::splat(ROOM))).unwrap();
        let walk = Walk3::new(&shape, Vec3::Y).unwrap();
        for _ in 0..4 {
            let was_free = is_free(&world, &shape, &pose);
            let displacement = (random.direction() * random.range(0.0, 0.5)).as_vec3();
            let slide = world.move_and_slide((&shape, &pose), displacement, &walk, &Filter3::new());
            assert_eq!(slide.is_free, is_free(&world, &shape, &slide.pose), "{case}: {slide:?}");
            assert!(slide.is_free || !was_free && slide.blocked, "{case}: {slide:?}");
            assert!(slide.moved.length() < 4.0 * ROOM);
            freed += usize::from(slide.is_free && !was_free);
            wedged += usize::from(!slide.is_free);
            pose = slide.pose;
        }
    }
    assert!(freed > 200 && wedged < 200, "{freed} {wedged}");
}

#[test]
fn how_the_world_came_about_does_not_matter() {
    let mut random = Random::new(92);
    for _ in 0..100 {
        let mut world = room(&mut random);
        let shape = capsule();
        let walk = Walk3::new(&shape, Vec3::Y).unwrap();
        let pose = Pose3::at(random.within(DVec3::splat(-2.0), DVec3::splat(2.0))).unwrap();
        let displacement = (random.direction() * 2.0).as_vec3();
        let ask =
            |world: &World3| world.move_and_slide((&shape, &pose), displacement, &walk, &Filter3::new());
        let first = ask(&world);
        world.update();
        assert_eq!(first, ask(&world));
        let keys: Vec<_> = world.iter().map(|(key, body)| (key, *body.pose())).collect();
        for &(key, _) in keys.iter().step_by(2) {
            world.set_pose(key, Pose3::at([50.0, 0.0, 0.0]).unwrap()).unwrap();
        }
        ask(&world);
        world.set_poses(keys).unwrap();
        assert_eq!(first, ask(&world), "after everything was moved away and back");
    }
}
