//! Queries of a world against a loop over all of its bodies: before updates and after, near and far, whatever the
//! world's history.

mod asked;
mod checked;
mod points;
mod sieve;
mod stories;

use asked::{Questioned, answers, not_touched, visited};
use asunder::{Filter, Plane, Volume, World};
use asunder_tests::cases::Random;
use checked::check;
use sieve::Sieve;

/// Counts of what occurred in a run, so that no part of a test is vacuous.
#[derive(Debug, Default)]
struct Seen {
    asked: usize,
    overlaps: usize,
    near: usize,
    met: usize,
    touched: usize,
}

/// Runs a world in which bodies come and go, move alone and in crowds, with queries at any time.
fn live<S: Questioned>(seed: u128, steps: usize, room: f64, shift: f64) -> Seen {
    let mut random = Random::new(seed);
    let (mut world, mut copy) = (World::<S>::new(), World::new());
    let (mut keys, mut gone, mut seen) = (Vec::new(), Vec::new(), Seen::default());
    for step in 0..steps {
        match random.below(12) {
            // Some hundred at once, so that lists grow too long and trees are rebuilt.
            0 if keys.len() < 150 => {
                for _ in 0..40 + random.below(80) {
                    let body = S::shifted(S::random_body(&mut random, room), shift);
                    keys.push(S::insert(&mut world, body));
                }
            }
            1 if step % 7 == 0 => {
                for &key in &keys[..keys.len() * random.below(5) / 4] {
                    S::set_pose(&mut world, key, S::pose_in(&mut random, room, shift));
                }
            }
            0..4 => {
                let body = S::shifted(S::random_body(&mut random, room), shift);
                keys.push(S::insert(&mut world, body));
            }
            4..7 if !keys.is_empty() => {
                for _ in 0..1 + random.below(20) {
                    let key = random.pick(&keys);
                    S::set_pose(&mut world, key, S::pose_in(&mut random, room, shift));
                }
            }
            7 if !keys.is_empty() => {
                for _ in 0..1 + random.below(keys.len().min(6)) {
                    let key = keys.swap_remove(random.below(keys.len()));
                    assert!(S::remove(&mut world, key).is_some());
                    gone.push(key);
                }
            }
            8 if random.below(60) == 0 => {
                world.clear();
                gone.append(&mut keys);
            }
            _ => world.update(),
        }
        let known: Vec<S::Key> = keys.iter().chain(&gone).copied().collect();
        for _ in 0..random.below(3) {
            let (asked, sieve) = (S::asked(&mut random, room, shift), Sieve::new(&mut random, &known));
            let filter = &sieve.filter;
            let found = answers(&world, &asked, filter);
            check(&world, &asked, &sieve, &found);
            assert_eq!(visited(&world, &asked, filter), found, "visitors are told the same");
            // A clone has no trees yet: the history of this world's trees changes nothing.
            assert_eq!(answers(&world.clone(), &asked, filter), found, "a clone answers the same");
            copy.clone_from(&world);
            assert_eq!(answers(&copy, &asked, filter), found, "so does one that was asked of others before");
            let untouched = answers(&world, &asked, &filter.without_touched());
            seen.asked += 1;
            seen.touched +=
                found.rays.len() + found.casts.len() - untouched.rays.len() - untouched.casts.len();
            seen.overlaps += found.over.len() + found.holding.len();
            seen.met += found.rays.len() + found.casts.len();
            seen.near += found.near_shape.len() + found.near_point.len();
            assert_eq!(
                untouched,
                not_touched::<S>(found),
                "what is touched at the start is left out, and nothing else"
            );
        }
    }
    seen
}

#[test]
fn every_question_at_any_time() {
    for seed in 0..4 {
        let seen = [live::<Volume>(2500 + seed, 300, 4.0, 0.0), live::<Plane>(2600 + seed, 300, 9.0, 0.0)];
        for seen in seen {
            assert!(
                seen.asked > 150
                    && seen.overlaps > 200
                    && seen.near > 2000
                    && seen.met > 300
                    && seen.touched > 100,
                "{seen:?}"
            );
        }
    }
}

/// Where f32 AABBs are 64 m wide, and where positions of some metres still resolve millimetres.
#[test]
fn every_question_far_from_the_origin() {
    for (seed, shift) in [(1, 9.9e8), (2, -1e6), (3, 1e7)] {
        let seen =
            [live::<Volume>(2700 + seed, 150, 3.0, shift), live::<Plane>(2800 + seed, 150, 6.0, shift)];
        for seen in seen {
            assert!(seen.asked > 70 && seen.overlaps > 100, "{seen:?}");
        }
    }
}

/// Of ten thousand bodies some move in every frame: in a world that is queried all the time, and in one that never was.
fn crowd<S: Questioned>(bodies: usize, room: f64) {
    let mut random = Random::new(2900);
    let mut world = World::<S>::new();
    let keys: Vec<S::Key> =
        (0..bodies).map(|_| S::insert(&mut world, S::random_body(&mut random, room))).collect();
    let mut found = 0;
    for frame in 0..6 {
        // A few, many, all: within the list, in the second tree, and beyond it.
        let moving = [10, 150, bodies / 20, bodies / 3, bodies, 0][frame];
        for &key in &keys[..moving] {
            S::set_pose(&mut world, key, S::pose_in(&mut random, room, 0.0));
            if random.below(100) == 0 {
                let asked = S::asked(&mut random, room, 0.0);
                let _ = answers(&world, &asked, &Filter::new());
            }
        }
        for is_updated in [false, true] {
            if is_updated {
                world.update();
            }
            let asked = S::asked(&mut random, room, 0.0);
            let here = answers(&world, &asked, &Filter::new());
            check(&world, &asked, &Sieve::all(), &here);
            assert_eq!(answers(&world.clone(), &asked, &Filter::new()), here);
            found += here.over.len() + here.near_shape.len();
        }
    }
    assert!(found > 10, "{found}");
}

#[test]
fn crowds_of_which_few_or_many_move() {
    crowd::<Volume>(4000, 14.0);
    crowd::<Plane>(4000, 55.0);
}

/// Many threads query a world that has just changed: the first one builds the trees.
fn threads<S: Questioned>(room: f64) {
    let mut random = Random::new(3000);
    let mut world = World::<S>::new();
    let keys: Vec<S::Key> =
        (0..2000).map(|_| S::insert(&mut world, S::random_body(&mut random, room))).collect();
    for round in 0..6 {
        for &key in &keys[..[2000, 5, 300, 1900, 90, 0][round]] {
            S::set_pose(&mut world, key, S::pose_in(&mut random, room, 0.0));
        }
        if round % 2 == 1 {
            world.update();
        }
        let asked: Vec<_> = (0..30).map(|_| S::asked(&mut random, room, 0.0)).collect();
        let ask_all = |world: &World<S>| -> Vec<_> {
            asked.iter().map(|asked| answers(world, asked, &Filter::new().solid())).collect()
        };
        let alone = ask_all(&world.clone());
        let world = &world;
        std::thread::scope(|scope| {
            let together: Vec<_> = (0..6).map(|_| scope.spawn(|| ask_all(world))).collect();
            for thread in together {
                assert!(thread.join().unwrap() == alone, "a thread is told something else");
            }
        });
        assert!(alone.iter().map(|found| found.near_shape.len()).sum::<usize>() > 100);
    }
}

#[test]
fn threads_are_told_the_same() {
    threads::<Volume>(10.0);
    threads::<Plane>(40.0);
}
