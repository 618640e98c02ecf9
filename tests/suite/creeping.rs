//! Worlds whose bodies creep: what is carried over from frame to frame agrees with a world made in this frame.
//!
//! Steps are from a ten-millionth of a body's size to a hundredth, so that pairs stay apart for many frames, manifolds
//! are moved along for some, and both end within the run.

use asunder::{Collider2, Collider3, Contact, Contact2, Contact3, World2, World3};
use asunder_geometry::{
    Capsule3, Circle, Compound3, Cuboid, HalfSpace, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3, Sphere,
};
use asunder_scenes::pairs::{SolidKind, solids};
use asunder_scenes::random::Random;
use glam::{DQuat, DVec2, DVec3, Vec2, Vec3};

const FRAMES: usize = 120;

/// The compared part of a contact.
#[derive(Debug)]
struct Seen {
    bodies: (usize, usize),
    overlapping: bool,
    /// Separation and error of each manifold.
    manifolds: Vec<(f64, f64)>,
}

/// Asserts that both agree: overlaps in every bit, separations within their errors, and the presence of a contact
/// except where the error leaves the comparison with the margin open.
fn check_alike(carried: &[Seen], fresh: &[Seen], margin: f64, story: &str) {
    let of = |list: &[Seen], bodies: (usize, usize)| list.iter().position(|seen| seen.bodies == bodies);
    for (one, others) in [(carried, fresh), (fresh, carried)] {
        for seen in one {
            let Some(other) = of(others, seen.bodies).map(|at| &others[at]) else {
                let is_open = seen.manifolds.iter().all(|(found, error)| (found - margin).abs() <= *error);
                assert!(!seen.overlapping && is_open, "{story}: only one has {seen:?}");
                continue;
            };
            assert_eq!(seen.overlapping, other.overlapping, "{story}: {seen:?}, {other:?}");
            if let ([(one, error)], [(two, other_error)]) = (&*seen.manifolds, &*other.manifolds) {
                assert!((one - two).abs() <= error + other_error, "{story}: {seen:?}, {other:?}");
            }
        }
    }
}

/// A body's motion: a step per frame, and a rotation about its centre.
struct Way {
    step: DVec3,
    turn: DVec3,
}

fn ways(count: usize, random: &mut Random) -> Vec<Way> {
    (0..count)
        .map(|i| {
            // A third of the bodies tremble, a third creep, a third walk.
            let speed = [1e-7, 1e-5, 1e-3][i % 3] * random.range(0.3, 3.0);
            let turn = if i % 2 == 0 { DVec3::ZERO } else { random.direction() * speed };
            Way { step: random.direction() * speed, turn }
        })
        .collect()
}

fn shapes3() -> Vec<Shape3> {
    let mut shapes = solids(SolidKind::Hull16, 4, 3);
    shapes.extend(solids(SolidKind::Box, 4, 3));
    shapes.push(Sphere::new(0.45).unwrap().into());
    shapes.push(Capsule3::new(Vec3::new(0.0, -0.2, 0.0), Vec3::new(0.0, 0.2, 0.0), 0.25).unwrap().into());
    shapes.push(Cuboid::from_half_extents(Vec3::splat(0.4)).unwrap().rounded(0.05).unwrap().into());
    shapes.push(compound().into());
    shapes
}

fn compound() -> Compound3 {
    let part = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.2, 0.3, 0.2)).unwrap());
    let at = |x: f64| Pose3::at([x, 0.0, 0.0]).unwrap();
    Compound3::new([(at(-0.3), part.clone()), (at(0.3), part)]).unwrap()
}

/// The compared part of a contact. Bodies are given by their index; `numbers` returns a manifold's separation and
/// error.
fn seen<K: Copy + PartialEq, M>(
    contact: &Contact<'_, K, M>,
    keys: &[K],
    numbers: impl Fn(&M) -> [f32; 2],
) -> Seen {
    let index = |key: K| keys.iter().position(|known| *known == key).unwrap();
    let numbers = |manifold| {
        let [separation, error] = numbers(manifold);
        (separation.into(), error.into())
    };
    Seen {
        bodies: (index(contact.a), index(contact.b)),
        overlapping: contact.overlapping,
        manifolds: contact.manifolds.iter().map(numbers).collect(),
    }
}

#[test]
fn what_is_carried_on_is_what_a_new_world_finds_in_space() {
    let shapes = shapes3();
    for seed in 0..4 {
        let mut random = Random::new(seed ^ 0xc4ee9);
        let margin = [0.0, 0.01][seed as usize % 2];
        let mut bodies: Vec<(Shape3, Pose3)> =
            vec![(Shape3::from(HalfSpace::new(Vec3::Y).unwrap()), Pose3::at([0.0, -0.4, 0.0]).unwrap())];
        for i in 0..48 {
            let cell = DVec3::new((i % 4) as f64, (i / 16) as f64, (i / 4 % 4) as f64) * 0.85;
            let place = cell + random.within(DVec3::splat(-0.05), DVec3::splat(0.05));
            let rotation = if i % 3 == 0 { glam::Quat::IDENTITY } else { random.rotation() };
            bodies.push((shapes[i % shapes.len()].clone(), Pose3::new(place, rotation).unwrap()));
        }
        let ways = ways(bodies.len(), &mut random);
        let collider = |(i, (shape, pose)): (usize, &(Shape3, Pose3))| {
            let collider = Collider3::new(shape.clone()).at(*pose).margin(margin * 0.5).unwrap();
            if i == 0 { collider.fixed() } else { collider }
        };
        let mut world = World3::new();
        let keys: Vec<_> = bodies.iter().enumerate().map(|body| world.insert(collider(body))).collect();
        for frame in 0..FRAMES {
            for (i, (_, pose)) in bodies.iter_mut().enumerate().skip(1) {
                let Way { step, turn } = &ways[i];
                // Back and forth, so that no body leaves.
                let sense = if frame / 20 % 2 == 0 { 1.0 } else { -1.0 };
                let turned = DQuat::from_xyzw(turn.x, turn.y, turn.z, 2.0 * sense).normalize();
                let rotation = if *turn == DVec3::ZERO {
                    pose.rotation()
                } else {
                    (turned * pose.rotation().as_dquat()).as_quat()
                };
                *pose = Pose3::new(pose.position() + *step * sense, rotation).unwrap();
                world.set_pose(keys[i], *pose).unwrap();
            }
            world.update();
            let mut fresh = World3::new();
            let fresh_keys: Vec<_> =
                bodies.iter().enumerate().map(|body| fresh.insert(collider(body))).collect();
            fresh.update();
            let told = |contact: Contact3<'_>, keys: &[_]| seen(&contact, keys, |m| [m.separation, m.error]);
            let carried: Vec<_> = world.contacts().map(|contact| told(contact, &keys)).collect();
            let found: Vec<_> = fresh.contacts().map(|contact| told(contact, &fresh_keys)).collect();
            check_alike(&carried, &found, margin.into(), &format!("seed {seed}, frame {frame}"));
        }
    }
}

#[test]
fn what_is_carried_on_is_what_a_new_world_finds_in_the_plane() {
    for seed in 0..4 {
        let mut random = Random::new(seed ^ 0xc4eea);
        let margin = [0.0, 0.01][seed as usize % 2];
        let shapes = [
            Shape2::from(Rect::from_half_extents(Vec2::new(0.45, 0.4)).unwrap()),
            Shape2::from(Circle::new(0.45).unwrap()),
            Shape2::from(Rect::from_half_extents(Vec2::splat(0.4)).unwrap().rounded(0.05).unwrap()),
        ];
        let mut bodies: Vec<(Shape2, Pose2)> = Vec::new();
        for i in 0..60 {
            let cell = DVec2::new((i % 8) as f64, (i / 8) as f64) * 0.87;
            let place = cell + random.within(DVec3::splat(-0.03), DVec3::splat(0.03)).truncate();
            let angle = if i % 3 == 0 { 0.0 } else { random.range(0.0, 6.0) as f32 };
            let pose = Pose2::new(place, Rotation2::from_angle(angle).unwrap()).unwrap();
            bodies.push((shapes[i % 3].clone(), pose));
        }
        let ways = ways(bodies.len(), &mut random);
        let collider = |(shape, pose): &(Shape2, Pose2)| {
            Collider2::new(shape.clone()).at(*pose).margin(margin * 0.5).unwrap()
        };
        let mut world = World2::new();
        let keys: Vec<_> = bodies.iter().map(|body| world.insert(collider(body))).collect();
        for frame in 0..FRAMES {
            for (i, (_, pose)) in bodies.iter_mut().enumerate() {
                let Way { step, turn } = &ways[i];
                let sense = if frame / 20 % 2 == 0 { 1.0 } else { -1.0 };
                let rotation = if *turn == DVec3::ZERO {
                    pose.rotation()
                } else {
                    let facing = pose.turn(DVec2::new(1.0, turn.z * sense));
                    Rotation2::new(facing.x as f32, facing.y as f32).unwrap()
                };
                *pose = Pose2::new(pose.position() + step.truncate() * sense, rotation).unwrap();
                world.set_pose(keys[i], *pose).unwrap();
            }
            world.update();
            let mut fresh = World2::new();
            let fresh_keys: Vec<_> = bodies.iter().map(|body| fresh.insert(collider(body))).collect();
            fresh.update();
            let told = |contact: Contact2<'_>, keys: &[_]| seen(&contact, keys, |m| [m.separation, m.error]);
            let carried: Vec<_> = world.contacts().map(|contact| told(contact, &keys)).collect();
            let found: Vec<_> = fresh.contacts().map(|contact| told(contact, &fresh_keys)).collect();
            check_alike(&carried, &found, margin.into(), &format!("seed {seed}, frame {frame}"));
        }
    }
}
