//! Memory a body, which the documentation of `World` states.

use asunder::{Collider2, Collider3, Manifold2, Manifold3, Plane, Volume};
use asunder_scenes::worlds::WorldScene;
use asunder_tests::counting::{counted, live_bytes};
use asunder_tests::recorded::{Recorded, Recording};

/// What the documentation says: bytes a body, and bytes a candidate pair.
type Stated = (f64, f64);

/// Bytes that a world holds a body, after some frames, without the data of its shapes.
fn check<S: Recording>(name: &str, (scene, count): (WorldScene, usize), (a_body, a_candidate): Stated) {
    counted(1, || {
        // The shapes' data and the motion are not the world's.
        let (replay, colliders) = S::open(scene, count);
        let before = live_bytes();
        let mut world = Recorded::<S>::with((replay, colliders.clone()));
        let clones = live_bytes() - before;
        // Some frames, and then two in which nobody moves: contacts are carried on by themselves.
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
