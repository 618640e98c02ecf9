//! A million operations without growth of memory.

use asunder::glam::{Vec2, Vec3};
use asunder::{Collider3, Cuboid, HeightField, Plane, Pose3, Volume, World, World3};
use asunder_tests::cases::Random;
use asunder_tests::counting::{counted, live_bytes};
use asunder_tests::engine::{Change, Engine};

/// Bodies, more or less.
const BODIES: usize = 1000;

/// Bytes held after so many operations: a body moves, comes, goes or is changed, and now and then all is updated.
fn bytes_after<S: Engine>(operations: [usize; 2], room: f64) -> [i64; 2] {
    counted(1, || {
        let mut random = Random::new(90);
        // A few hundred bodies and poses to draw from: making one takes longer than all else.
        let bodies: Vec<_> = (0..300).map(|_| S::random_body(&mut random, room)).collect();
        let changes: Vec<_> = (0..300).map(|_| Change::<S>::random(&mut random)).collect();
        let before = live_bytes();
        let mut world = World::<S>::new();
        let mut keys = Vec::with_capacity(2 * BODIES);
        let (mut held, mut updates, mut most) = ([0; 2], 0, 0);
        for operation in 0..=operations[1] {
            for (held, at) in held.iter_mut().zip(operations) {
                if operation == at {
                    *held = live_bytes() - before;
                }
            }
            let body = &bodies[random.below(bodies.len())];
            let place = random.below(keys.len().max(1));
            match random.below(16) {
                _ if keys.len() < BODIES - 50 => keys.push(S::insert(&mut world, body.clone())),
                0 if keys.len() < BODIES + 50 => keys.push(S::insert(&mut world, body.clone())),
                1 => drop(S::remove(&mut world, keys.swap_remove(place))),
                2 => assert!(S::change(&mut world, keys[place], &changes[random.below(changes.len())])),
                _ => assert!(S::set_pose(&mut world, keys[place], S::pose_of(body))),
            }
            if operation % 1000 == 0 {
                world.update();
                (updates, most) = (updates + 1, most.max(world.stats().contacts));
            }
        }
        assert!(updates > 100 && most > 100, "{updates} updates, {most} contacts");
        held
    })
}

fn check<S: Engine>(room: f64) {
    let [early, late] = bytes_after::<S>([100_000, 1_000_000], room);
    // A vector may still meet its largest frame, and double. A byte an operation would be several times as much.
    assert!(late <= early + early / 8, "{early} bytes held after 100,000 operations, {late} after 1,000,000");
}

#[test]
fn a_million_operations_in_space_take_no_more_memory() {
    check::<Volume>(12.0);
}

#[test]
fn a_million_operations_in_the_plane_take_no_more_memory() {
    check::<Plane>(40.0);
}

/// Reshaping again and again between two updates is noted once.
#[test]
fn changes_between_updates_take_no_memory_each() {
    let grown = counted(1, || {
        let mut world = World::<Volume>::new();
        let keys: Vec<_> = (0..10).map(|at| world.insert(Volume::unit_at(f64::from(at)))).collect();
        let shape = Volume::shape_of(&Volume::unit_at(0.0)).clone();
        world.update();
        let before = live_bytes();
        for at in 0..100_000 {
            world.set_shape(keys[at % keys.len()], shape.clone()).unwrap();
            world.sleep(keys[at % keys.len()]).unwrap();
        }
        live_bytes() - before
    });
    assert!(grown < 1000, "{grown} bytes");
}

/// Cubes that hop on and off a level, while others elsewhere hop onto each other: what was kept of one pair serves another,
/// however far apart they are in the list of pairs.
#[test]
fn what_hops_takes_no_memory_each_time() {
    let grown = counted(1, || {
        let mut world = World3::new();
        let floor = HeightField::new(2, 2, vec![0.0; 4], Vec2::splat(100.0)).unwrap();
        world.insert(Collider3::new(floor).fixed());
        let cube = Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap();
        let at = |number: usize, height: f64| {
            let cell = [number % 20, number / 20].map(|cell| cell as f64 * 2.0 + 2.0);
            Pose3::at([cell[0], height, cell[1]]).unwrap()
        };
        let mut insert = |number: usize, height: f64, is_fixed: bool| {
            let cube = Collider3::new(cube).margin(0.02).unwrap().at(at(number, height));
            world.insert(if is_fixed { cube.fixed() } else { cube })
        };
        let on_floor: Vec<_> = (0..40).map(|number| insert(number, 10.0, false)).collect();
        // Pairs that stay, between theirs and those of the others.
        for number in 0..300 {
            insert(number, 50.0, true);
            insert(number, 50.999, false);
        }
        for number in 0..40 {
            insert(number, 100.0, true);
        }
        let on_cubes: Vec<_> = (0..40).map(|number| insert(number, 110.0, false)).collect();
        let mut held = [0; 2];
        for cycle in 0..60 {
            for heights in [[0.499, 110.0], [10.0, 110.0], [10.0, 100.999], [10.0, 110.0]] {
                for tremble in [0.0, 1e-6] {
                    for (number, pair) in on_floor.iter().zip(&on_cubes).enumerate() {
                        world.set_pose(*pair.0, at(number, heights[0] + tremble)).unwrap();
                        world.set_pose(*pair.1, at(number, heights[1] + tremble)).unwrap();
                    }
                    world.update();
                }
            }
            held[usize::from(cycle >= 20)] = live_bytes();
        }
        assert!(world.stats().touching >= 300);
        held[1] - held[0]
    });
    // Kept by the wrong one, it was 70,000 a cycle.
    assert!(grown < 10_000, "{grown} bytes in forty cycles");
}
