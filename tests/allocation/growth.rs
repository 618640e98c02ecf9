//! A million operations without growth of memory.

use crate::asked::Asker;
use asunder::glam::{Vec2, Vec3};
use asunder::{Collider, Collider3, Cuboid, HeightField, Motion3, Plane, Pose3, Volume, World, World3};
use asunder_tests::cases::Random;
use asunder_tests::counting::{counted, live_bytes};
use asunder_tests::engine::{Change, Engine};

/// Approximate number of bodies.
const BODIES: usize = 1000;

/// A few hundred of everything to draw from: making them takes longer than all else.
struct Stock<S: Asker> {
    bodies: Vec<Collider<S>>,
    changes: Vec<Change<S>>,
    motions: Vec<S::Motion>,
    asked: Vec<S::Asked>,
}

impl<S: Asker> Stock<S> {
    fn new(random: &mut Random, room: f64) -> Self {
        let count = 0..300;
        let body =
            |number: usize, body: Collider<S>| if number.is_multiple_of(4) { body.bullet() } else { body };
        Self {
            bodies: count.clone().map(|number| body(number, S::random_body(random, room))).collect(),
            changes: count.clone().map(|_| Change::random(random)).collect(),
            motions: count.clone().map(|_| S::random_motion(random, 1.0)).collect(),
            asked: count.map(|_| S::asked(random, room)).collect(),
        }
    }
}

/// A world in which much happens.
struct Life<S: Asker> {
    world: World<S>,
    keys: Vec<S::Key>,
    copy: World<S>,
    lists: S::Lists,
    /// Numbers of updates, contacts, impacts, answers and characters that hit something: evidence that memory was used.
    seen: [usize; 5],
}

impl<S: Asker> Life<S> {
    fn new() -> Self {
        let keys = Vec::with_capacity(2 * BODIES);
        Self { world: World::new(), keys, copy: World::new(), lists: S::Lists::default(), seen: [0; 5] }
    }

    fn begin_anew(&mut self) {
        self.world.clear();
        self.keys.clear();
        S::ground().into_iter().for_each(|ground| _ = S::insert(&mut self.world, ground));
    }

    /// Moves, inserts, removes or changes a body, gives it a motion, or runs a query.
    fn act(&mut self, stock: &Stock<S>, random: &mut Random) {
        let Self { world, keys, lists, seen: [.., answers, walls], .. } = self;
        let number = random.below(stock.bodies.len());
        let (body, asked) = (&stock.bodies[number], &stock.asked[number]);
        let place = random.below(keys.len().max(1));
        match random.below(256) {
            _ if keys.len() < BODIES - 50 => keys.push(S::insert(world, body.clone())),
            0..16 if keys.len() < BODIES + 50 => keys.push(S::insert(world, body.clone())),
            16..32 => drop(S::remove(world, keys.swap_remove(place))),
            32..48 => assert!(S::change(world, keys[place], &stock.changes[number])),
            48..56 => assert!(S::set_motion(world, keys[place], stock.motions[number])),
            80 => *answers += S::list(world, asked, lists),
            81 => *answers += S::visit(world, asked),
            82 => *walls += usize::from(S::walk(world, asked)),
            _ => assert!(S::set_pose(world, keys[place], S::pose_of(body))),
        }
    }

    /// What is done now and then: updates, copies, snapshots.
    fn look_back(&mut self, operation: usize) {
        let Self { world, copy, seen: [updates, contacts, impacts, ..], .. } = self;
        if operation.is_multiple_of(1000) {
            world.update();
            *updates += 1;
            *contacts += world.stats().contacts;
            *impacts += S::impacts(world).len();
        }
        if operation % 25_000 == 500 {
            copy.clone_from(world);
            assert!(S::comes_back(&copy.clone()), "after {operation} operations");
        }
    }
}

/// Operations until all bodies are removed, and everything is done once more.
const ROUND: usize = 250_000;

/// Bytes held after each round of the same operations; now and then the world is updated, cloned, saved and restored.
fn bytes_after<S: Asker>(rounds: usize, room: f64) -> Vec<i64> {
    counted(1, || {
        let stock = Stock::<S>::new(&mut Random::new(90), room);
        let before = live_bytes();
        let mut life = Life::<S>::new();
        let round = |_| {
            let mut random = Random::new(91);
            life.begin_anew();
            for operation in 0..ROUND {
                life.act(&stock, &mut random);
                life.look_back(operation);
            }
            assert!(life.seen.iter().all(|&seen| seen > 100), "{:?}", life.seen);
            live_bytes() - before
        };
        (0..rounds).map(round).collect()
    })
}

fn check<S: Asker>(room: f64) {
    // In each round slots are filled in another order, so that pairs are, too, and the lists of chunks differ slightly:
    // by 60 kB up or down, of 15 MB, from the third round to the tenth; before that the largest of each is still to
    // come. One byte per operation would be eight times as much.
    let held = bytes_after::<S>(6, room);
    assert!(held[5] - held[3] < ROUND as i64 / 4, "{held:?} bytes after so many rounds");
}

#[test]
fn a_million_operations_in_space_take_no_more_memory() {
    check::<Volume>(12.0);
}

#[test]
fn a_million_operations_in_the_plane_take_no_more_memory() {
    check::<Plane>(40.0);
}

/// A change of shape, or a motion that a replaced body loses, is recorded once however often it happens between
/// updates.
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
            world.set_motion(keys[at % keys.len()], Motion3::STILL).unwrap();
            world.replace(keys[at % keys.len()], Volume::unit_at(at as f64)).unwrap();
        }
        live_bytes() - before
    });
    // Lists of twice as many slots as there are, plus their spare capacity.
    assert!(grown < 2000, "{grown} bytes");
}

/// Cubes hop on and off a level, while others elsewhere hop onto each other: memory kept for one pair must be reused
/// for another, however far apart they are in the list of pairs.
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
        // Permanent pairs, in the list between the pairs of the two groups.
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
        assert!(world.stats().overlapping >= 300);
        held[1] - held[0]
    });
    // When it was kept in the wrong place, it grew by 70,000 a cycle.
    assert!(grown < 10_000, "{grown} bytes in forty cycles");
}
