//! A steady scene allocates nothing per frame.

use crate::asked::Asker;
use asunder::glam::{DVec3, Quat, Vec3};
use asunder::{Collider3, Cuboid, Hooks, Plane, Pose3, Space, TriMesh, Volume, World, World3};
use asunder_scenes::terrain::Terrain;
use asunder_scenes::worlds::WorldScene;
use asunder_tests::cases::Random;
use asunder_tests::counting::{allocations, counted, counted_here};
use asunder_tests::recorded::{Fnv1a, Recorded, Recording};

/// Frames after which everything starts anew.
const CYCLE: u32 = 30;

/// Allocations of the sixth cycle: the first started in another place than it ended, and within five a sweep has done
/// everything that it does only now and then.
///
/// With several threads, the least of a few cycles: which thread takes which pairs is chance, and each must have
/// decided its longest exact overlap once.
fn allocations_a_cycle<S: Recording>(scene: WorldScene, count: usize, threads: usize) -> u64 {
    counted(threads, || sixth_cycle::<S>(scene, count, threads > 1))
}

fn sixth_cycle<S: Recording>(scene: WorldScene, count: usize, by_chance: bool) -> u64 {
    let mut recorded = Recorded::<S>::new(scene, count);
    let (mut events, mut contacts) = (Fnv1a::default(), Fnv1a::default());
    let mut cycle = || {
        let before = allocations();
        for frame in 0..CYCLE {
            recorded.play(frame);
            recorded.hash(&mut events, &mut contacts);
        }
        allocations() - before
    };
    let early = (0..5).map(|_| cycle()).sum::<u64>();
    let mut least = cycle();
    for _ in 0..if by_chance { 6 } else { 0 } {
        least = if least > 0 { cycle() } else { 0 };
    }
    // There were allocations to count, and results to read.
    assert!(early > 0 && recorded.world.stats().candidates > 0, "{}", scene.name());
    least
}

/// Enough bodies that the narrow phase, and in one scene refit, too, is distributed over several threads.
fn count(scene: WorldScene) -> usize {
    match scene {
        WorldScene::ManyPyramids => 4201,
        WorldScene::ConvexPile => 505,
        _ => 1805,
    }
}

#[test]
fn a_steady_scene_in_space_allocates_nothing() {
    for threads in [1, 2] {
        for scene in WorldScene::ALL {
            let taken = allocations_a_cycle::<Volume>(scene, count(scene), threads);
            assert_eq!(taken, 0, "{} on {threads} threads", scene.name());
        }
    }
}

#[test]
fn a_steady_scene_in_the_plane_allocates_nothing() {
    for threads in [1, 2] {
        for scene in [WorldScene::ManyPyramids, WorldScene::Mixed] {
            let taken = allocations_a_cycle::<Plane>(scene, 4201, threads);
            assert_eq!(taken, 0, "{} on {threads} threads", scene.name());
        }
    }
}

/// So many boxes, most of them moving, that the sweep is distributed, as from 5,000 boxes on; and as many at rest.
#[test]
fn nor_do_sweeps_of_many_threads() {
    for (scene, count) in [(WorldScene::ManyPyramids, 12_000), (WorldScene::Mixed, 12_000)] {
        assert_eq!(allocations_a_cycle::<Plane>(scene, count, 2), 0, "{}", scene.name());
    }
    assert_eq!(allocations_a_cycle::<Volume>(WorldScene::MostlyStatic, 12_000, 2), 0);
}

/// A thread outside any pool hands each stage's work to one: rayon keeps it in a queue, and allocates new blocks of 63
/// now and then.
#[test]
fn a_thread_of_no_pool_allocates_a_block_of_the_queue_now_and_then() {
    let taken = counted_here(|| sixth_cycle::<Volume>(WorldScene::ManyPyramids, 4201, false));
    assert!(taken <= u64::from(CYCLE) / 10, "{taken} in {CYCLE} frames");
}

/// Bodies that slide back and forth on hills: their contacts are moved along for some frames, and then made anew.
#[test]
fn nor_do_contacts_with_a_level() {
    let terrain = Terrain::new(800, 1.0, 20);
    let level = TriMesh::new(terrain.vertices(), terrain.triangles()).unwrap();
    let taken = counted(1, || {
        let mut world = World3::new();
        world.insert(Collider3::new(level).fixed());
        let cube = Cuboid::from_half_extents(Vec3::splat(0.3)).unwrap();
        let bodies: Vec<_> = (0..16)
            .map(|number| {
                let place = [2.3 + f64::from(number % 4) * 3.7, 2.1 + f64::from(number / 4) * 3.9];
                let (height, normal) = terrain.under(place);
                let upright = Quat::from_rotation_arc(Vec3::Y, normal.as_vec3());
                let at = DVec3::new(place[0], height, place[1]) + normal * 0.299;
                let pose = Pose3::new(at, upright).unwrap();
                let body = Collider3::new(cube).at(pose).margin(0.02).unwrap();
                (world.insert(body), pose, normal.any_orthonormal_vector())
            })
            .collect();
        let (mut taken, mut kept) = (0, Kept::new());
        for frame in 0..3 * CYCLE {
            let turn = frame % CYCLE;
            let way = 2e-4 * f64::from(turn.min(CYCLE - turn));
            let before = allocations();
            for (key, pose, along) in &bodies {
                world.set_pose(*key, pose.shifted(*along * way).unwrap()).unwrap();
            }
            world.update();
            kept.keep(frame, &mut world);
            taken = if frame < 2 * CYCLE { 0 } else { taken + allocations() - before };
        }
        assert!(world.stats().manifolds >= bodies.len());
        taken
    });
    assert_eq!(taken, 0);
}

/// The last frames, as a game keeps them for rolling back.
struct Kept<S: Space>([World<S>; 3]);

impl<S: Space> Kept<S> {
    fn new() -> Self {
        Self([World::new(), World::new(), World::new()])
    }

    /// Overwrites the oldest frame; every fifth frame the world is rolled back to the oldest one then.
    fn keep(&mut self, frame: u32, world: &mut World<S>) {
        self.0[frame as usize % 3].clone_from(world);
        if frame % 5 == 4 {
            world.clone_from(&self.0[(frame as usize + 1) % 3]);
        }
    }
}

fn kept_cycle<S: Recording>(scene: WorldScene, count: usize) -> u64 {
    counted(1, || {
        let (mut recorded, mut kept) = (Recorded::<S>::new(scene, count), Kept::new());
        let mut taken = 0;
        for frame in 0..6 * CYCLE {
            let before = allocations();
            recorded.pose(frame % CYCLE);
            recorded.world.update();
            kept.keep(frame, &mut recorded.world);
            taken = if frame < 5 * CYCLE { 0 } else { taken + allocations() - before };
        }
        assert!(kept.0.iter().all(|kept| kept.stats().contacts > 0), "{}", scene.name());
        taken
    })
}

#[test]
fn nor_do_frames_that_are_kept() {
    for scene in
        [WorldScene::ManyPyramids, WorldScene::Mixed, WorldScene::MostlyStatic, WorldScene::ConvexPile]
    {
        assert_eq!(kept_cycle::<Volume>(scene, count(scene)), 0, "{}", scene.name());
    }
    for scene in [WorldScene::ManyPyramids, WorldScene::Mixed] {
        assert_eq!(kept_cycle::<Plane>(scene, 1805), 0, "{} in the plane", scene.name());
    }
}

#[test]
fn nor_do_hooks() {
    let taken = counted(1, || {
        let mut recorded = Recorded::<Volume>::new(WorldScene::ManyPyramids, 421);
        let upright = |meeting: asunder::Meeting3<'_>| meeting.manifolds.retain(|m| m.normal.y.abs() > 0.5);
        let all = |_: asunder::Side3<'_>, _: asunder::Side3<'_>| true;
        let hooks = Hooks::new().pair(&all).contact(&upright);
        let mut taken = 0;
        for frame in 0..3 * CYCLE {
            let before = allocations();
            recorded.pose(frame % CYCLE);
            recorded.world.update_with(&hooks);
            taken = if frame < 2 * CYCLE { 0 } else { taken + allocations() - before };
        }
        assert!(recorded.world.stats().manifolds > 0);
        taken
    });
    assert_eq!(taken, 0);
}

/// Frames after which a room is as before.
const ROOM_CYCLE: u32 = 12;

/// Allocations of the eighth cycle in a room with ground, when a sweep has done everything that it does only now and
/// then: half of the bodies are elsewhere in every frame, the others, bullets among them, get motions, and between two
/// updates all queries are run.
fn allocations_in_a_room<S: Asker>(threads: usize) -> u64 {
    counted(threads, || {
        let mut random = Random::new(92);
        let mut world = World::<S>::new();
        S::ground().into_iter().for_each(|ground| _ = S::insert(&mut world, ground));
        let bodies: Vec<_> = (0..120)
            .map(|number| {
                let body = S::random_body(&mut random, 3.0);
                S::insert(&mut world, if number % 3 == 0 { body.bullet() } else { body })
            })
            .collect();
        let asked: Vec<_> = (0..5).map(|_| S::asked(&mut random, 3.0)).collect();
        let mut lists = S::Lists::default();
        let [mut answers, mut impacts, mut walls, mut lines] = [0; 4];
        let mut cycle = || {
            let before = allocations();
            for frame in 0..ROOM_CYCLE {
                let mut random = Random::new(93 + u128::from(frame));
                for (number, &body) in bodies.iter().enumerate() {
                    if number % 2 == 0 {
                        S::set_pose(&mut world, body, S::random_pose(&mut random, 3.0));
                    } else {
                        S::set_motion(&mut world, body, S::random_motion(&mut random, 2.0));
                    }
                }
                // Before the update, when poses are newer than the trees, and after it.
                for when in 0..2 {
                    for asked in &asked {
                        answers += S::list(&world, asked, &mut lists) + S::visit(&world, asked);
                        walls += usize::from(S::walk(&world, asked));
                    }
                    if when == 0 {
                        world.update();
                    }
                }
                impacts += S::impacts(&world).len();
                lines += S::lines(&world);
            }
            allocations() - before
        };
        let early = (0..7).map(|_| cycle()).sum::<u64>();
        // With several threads the least of a few, as above.
        let taken = (1..if threads > 1 { 6 } else { 2 }).map(|_| cycle()).min();
        assert!(early > 0 && answers > 1000 && impacts > 50 && walls > 100 && lines > 10_000);
        taken.unwrap()
    })
}

#[test]
fn nor_do_bullets_questions_and_characters_in_space() {
    assert_eq!(allocations_in_a_room::<Volume>(1), 0);
    assert_eq!(allocations_in_a_room::<Volume>(2), 0, "on two threads");
}

#[test]
fn nor_do_bullets_questions_and_characters_in_the_plane() {
    assert_eq!(allocations_in_a_room::<Plane>(1), 0);
    assert_eq!(allocations_in_a_room::<Plane>(2), 0, "on two threads");
}
