//! Memory per body, which the documentation of `World` states; and the sizes that ground reports.

use asunder::glam::{Vec2, Vec3};
use asunder::{
    Collider2, Collider3, Compound3, Cuboid, HeightField, Manifold2, Manifold3, Plane, Pose3, Shape3,
    TriMesh, Volume, World3,
};
use asunder_scenes::terrain::Terrain;
use asunder_scenes::worlds::WorldScene;
use asunder_tests::cases::Random;
use asunder_tests::counting::{counted, live_bytes};
use asunder_tests::recorded::{Recorded, Recording};

/// What the documentation states: bytes per body, and bytes per candidate pair.
type Stated = (f64, f64);

/// Checks the bytes that a world holds per body after some frames, without the data of its shapes.
fn check<S: Recording>(name: &str, (scene, count): (WorldScene, usize), (a_body, a_candidate): Stated) {
    counted(1, || {
        // The shapes' data and the motion do not belong to the world.
        let (replay, colliders) = S::open(scene, count);
        let before = live_bytes();
        let mut world = Recorded::<S>::with((replay, colliders.clone()));
        let clones = live_bytes() - before;
        // Some frames, and then two in which nothing moves: contacts are carried over.
        for frame in [0, 1, 2, 3, 3, 3] {
            world.play(frame);
        }
        let (held, stats) = ((live_bytes() - before) as f64, *world.world.stats());
        let bodies = stats.bodies as f64;
        println!(
            "{name}: {:.0} bytes a body ({:.0} before the first update); {:.2} candidates, {:.2} contacts, {:.2} manifolds a body",
            held / bodies,
            clones as f64 / bodies,
            stats.candidates as f64 / bodies,
            stats.contacts as f64 / bodies,
            stats.manifolds as f64 / bodies,
        );
        let stated = a_body * bodies + a_candidate * stats.candidates as f64;
        assert!((0.5 * stated..=stated).contains(&held), "{name}: {held} bytes held, {stated} stated");
    });
}

/// `cargo test -p asunder-tests --test allocation sizes -- --nocapture` prints them.
#[test]
fn memory_a_body_is_as_documented() {
    println!("colliders: {} and {} bytes", size_of::<Collider3>(), size_of::<Collider2>());
    println!("manifolds: {} and {} bytes", size_of::<Manifold3>(), size_of::<Manifold2>());
    let (in_space, in_plane) = ((450.0, 1600.0), (400.0, 1300.0));
    check::<Volume>("mostly_static", (WorldScene::MostlyStatic, 101_001), in_space);
    check::<Volume>("boxes_pile", (WorldScene::BoxesPile, 100_005), in_space);
    check::<Plane>("plane/mixed", (WorldScene::Mixed, 100_000), in_plane);
    check::<Plane>("plane/many_pyramids", (WorldScene::ManyPyramids, 100_000), in_plane);
}

/// The same for bodies whose pairs have many manifolds: bytes for each beyond one per candidate.
fn check_many(name: &str, level: Collider3, bodies: &[Collider3], a_manifold: f64) {
    let level = level.margin(0.01).unwrap();
    counted(1, || {
        let before = live_bytes();
        let mut world = World3::new();
        world.insert(level.clone());
        let keys: Vec<_> = bodies.iter().map(|body| world.insert(body.clone())).collect();
        for frame in 0..6 {
            // They tremble, so that their contacts are moved along; in the end they rest.
            let by = [0.0, 1e-4, -1e-4, 0.0, 0.0, 0.0][frame];
            for (key, body) in keys.iter().zip(bodies) {
                world.set_pose(*key, body.pose().shifted([by, 0.0, 0.0]).unwrap()).unwrap();
            }
            world.update();
        }
        let (held, stats) = ((live_bytes() - before) as f64, *world.stats());
        let [bodies, candidates, manifolds] =
            [stats.bodies, stats.candidates, stats.manifolds].map(|count| count as f64);
        let beyond = held - 450.0 * bodies - 1600.0 * candidates;
        println!(
            "{name}: {held} bytes of {bodies} bodies, {candidates} candidates, {manifolds} manifolds: {:.0} for each beyond the first",
            beyond / (manifolds - candidates),
        );
        assert!(manifolds > 2.0 * candidates, "{name}: {stats:?}");
        assert!(beyond <= a_manifold * (manifolds - candidates), "{name}: {held} bytes held");
    });
}

#[test]
fn memory_of_pairs_of_many_manifolds_is_as_documented() {
    let mut random = Random::new(3);
    let heights: Vec<f32> = (0..101 * 101).map(|_| random.between(0.0, 0.3) as f32).collect();
    let field = HeightField::new(101, 101, heights, Vec2::splat(0.25)).unwrap();
    let box_ = Collider3::new(Cuboid::from_half_extents(Vec3::new(0.5, 0.1, 0.5)).unwrap());
    let at = |i: u32, y: f64| {
        let [x, z] = [i % 20, i / 20].map(|cell| 0.7 + 1.2 * f64::from(cell));
        Pose3::at([x, y, z]).unwrap()
    };
    let boxes: Vec<Collider3> = (0..400).map(|i| box_.clone().margin(0.01).unwrap().at(at(i, 0.3))).collect();
    check_many("field", Collider3::new(field), &boxes, 1300.0);
    let slab = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.2, 0.2, 13.0)).unwrap());
    let slabs = (0..60).map(|i| (Pose3::at([0.4 * f64::from(i), 0.0, 13.0]).unwrap(), slab.clone()));
    let floor = Collider3::new(Compound3::new(slabs).unwrap()).fixed();
    let boxes: Vec<Collider3> =
        (0..400).map(|i| box_.clone().margin(0.01).unwrap().at(at(i, 0.295))).collect();
    check_many("slabs", floor, &boxes, 1300.0);
}

/// The size that ground reports, and what was allocated for it; asserts that all of it is freed.
fn said_and_given<T>(make: impl FnOnce() -> T + Send, bytes: impl FnOnce(&T) -> usize + Send) -> [f64; 2] {
    counted(1, || {
        let before = live_bytes();
        // The input becomes part of the ground, or is freed.
        let ground = make();
        let (said, given) = (bytes(&ground), live_bytes() - before);
        drop(ground);
        assert_eq!(live_bytes(), before);
        [said as f64, given as f64]
    })
}

/// The two counters of an `Arc`, which `bytes` does not include.
const COUNTERS: f64 = 2.0 * size_of::<usize>() as f64;

#[test]
fn ground_holds_what_it_says() {
    let terrain = Terrain::new(20_000, 1.0, 7);
    let triangles = terrain.triangles().len() as f64;
    let shared = || TriMesh::new(terrain.vertices(), terrain.triangles()).unwrap();
    let alone = || {
        let vertices = terrain.vertices();
        let corners =
            terrain.triangles().into_flattened().into_iter().map(|corner| vertices[corner as usize]);
        let corners: Vec<Vec3> = corners.collect();
        let numbers =
            (0..corners.len() as u32 / 3).map(|triangle| [0, 1, 2].map(|corner| 3 * triangle + corner));
        let numbers: Vec<[u32; 3]> = numbers.collect();
        TriMesh::new(corners, numbers).unwrap()
    };
    for (name, mesh) in [("shared", &shared as &(dyn Fn() -> TriMesh + Sync)), ("alone", &alone)] {
        let [said, given] = said_and_given(mesh, TriMesh::bytes);
        println!("{name}: {:.1} bytes a triangle said, {:.1} given", said / triangles, given / triangles);
        assert!((said..=said + COUNTERS).contains(&given), "{name}: {said} bytes said, {given} given");
        assert!(given <= 100.0 * triangles, "{name}: {given} bytes for {triangles} triangles");
    }

    let (side, cells) = (terrain.cells() + 1, 0.5 * triangles);
    let field = || {
        let heights: Vec<f32> = terrain.vertices().iter().map(|vertex| vertex.y).collect();
        HeightField::new(side, side, heights, Vec2::ONE).unwrap().with_hole(3, 5).unwrap()
    };
    let [said, given] = said_and_given(field, HeightField::bytes);
    println!("height field: {:.1} bytes a cell said, {:.1} given", said / cells, given / cells);
    assert!((said..=said + COUNTERS).contains(&given), "{said} bytes said, {given} given");
    // "A cell takes about 16 bytes", and rows have one vertex more than cells.
    assert!(given <= 18.0 * cells, "{given} bytes for {cells} cells");
}
