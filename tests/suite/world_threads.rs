//! Equal outputs at every number of threads: the same frames in pools of 1, 2, 3 and 8.

use asunder::{Plane, Volume, World};
use asunder_tests::cases::Random;
use asunder_tests::engine::Engine;
use rayon::ThreadPoolBuilder;

/// Every output of some frames, bit for bit as text: `Debug` distinguishes -0 from 0, and NaN from numbers.
fn frames<S: Engine>(threads: usize, bodies: usize, frames: usize, room: f64) -> (Vec<String>, usize) {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut random = Random::new(800);
        let mut world = World::<S>::new();
        let mut keys: Vec<_> =
            (0..bodies).map(|_| S::insert(&mut world, S::random_body(&mut random, room))).collect();
        let (mut outputs, mut most_pairs) = (Vec::new(), 0);
        for _ in 0..frames {
            world.update();
            most_pairs = most_pairs.max(world.stats().candidates);
            outputs.push(format!("{:?}", S::candidates(&world)));
            outputs.push(format!("{:?}", S::contacts(&world)));
            outputs.push(format!("{:?}", S::events(&world)));
            for &key in &keys[..bodies / 2] {
                let pose = S::random_pose(&mut random, room);
                S::set_pose(&mut world, key, pose);
            }
            let gone = keys.swap_remove(random.below(keys.len()));
            S::remove(&mut world, gone);
            keys.push(S::insert(&mut world, S::random_body(&mut random, room)));
        }
        (outputs, most_pairs)
    })
}

fn check<S: Engine>(bodies: usize, count: usize, room: f64) {
    let (alone, most_pairs) = frames::<S>(1, bodies, count, room);
    // Enough pairs for many batches, or one thread would have done it all.
    assert!(most_pairs > 2000, "{most_pairs} pairs");
    for threads in [2, 3, 8] {
        let (together, _) = frames::<S>(threads, bodies, count, room);
        assert!(alone == together, "{threads} threads say something else");
    }
}

#[test]
fn crowded_rooms() {
    check::<Volume>(500, 4, 4.0);
    check::<Plane>(700, 4, 9.0);
}

/// So many bodies that their AABBs are computed in parallel, too.
#[test]
fn many_bodies() {
    check::<Volume>(9000, 2, 16.0);
    check::<Plane>(9000, 2, 70.0);
}
