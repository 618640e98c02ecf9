//! Tests of the largest clouds, by counting steps instead of time.

use super::clouds::Random;
use crate::counted::steps_of;
use crate::tolerance::MAX_HULL_POINTS;
use crate::{Hull, HullError};
use glam::{DVec3, Vec3};

/// The largest clouds allowed, of kinds that make hull builders quadratic.
fn large_clouds(random: &mut Random) -> Vec<(&'static str, Vec<Vec3>)> {
    const COUNT: usize = MAX_HULL_POINTS;
    let turn = random.turn();
    let turned = |v: Vec3| turn * v;
    let all = |place: &mut dyn FnMut(usize) -> Vec3| -> Vec<Vec3> { (0..COUNT).map(place).collect() };
    let grid = |i: usize| Vec3::new((i % 256) as f32, (i / 256) as f32, 0.0);
    let lattice = |i: usize| Vec3::new((i % 40) as f32, (i / 40 % 40) as f32, (i / 1600) as f32);
    let share = |i: usize| i as f32 / COUNT as f32;
    // A rational circle: no trigonometry.
    let around = |i: usize| {
        let (t, half) =
            (f64::from(share(i % (COUNT / 2))) * 4.0 - 1.0, if i < COUNT / 2 { 1.0 } else { -1.0 });
        (DVec3::new(2.0 * t, 1.0 - t * t, 0.0) / (1.0 + t * t) * half).as_vec3()
    };
    vec![
        ("sphere", all(&mut |_| random.sphere())),
        ("ball", all(&mut |_| random.ball())),
        ("lattice", all(&mut |i| lattice(i))),
        ("turned lattice", all(&mut |i| turned(lattice(i)))),
        ("sheet", all(&mut |i| grid(i))),
        ("turned sheet", all(&mut |i| turned(grid(i)))),
        ("rough sheet", all(&mut |i| grid(i) + Vec3::Z * random.unit() * 1e-4)),
        ("ring", all(&mut |i| turned(around(i)))),
        ("cone", all(&mut |i| if i == 0 { Vec3::Z } else { around(i) })),
        ("paraboloid", all(&mut |i| grid(i) + Vec3::Z * grid(i).length_squared())),
        ("shallow paraboloid", all(&mut |i| grid(i) + Vec3::Z * grid(i).length_squared() * 1e-7)),
        ("curve", all(&mut |i| Vec3::new(share(i), share(i) * share(i), share(i) * share(i) * share(i)))),
        ("turned line", all(&mut |i| turned(Vec3::X * i as f32))),
        ("one place", vec![Vec3::ONE; COUNT]),
    ]
}

/// Checks for every second cloud from the given one on that it takes no more steps than sorting would explain, and that
/// the hull is valid.
fn check(first: usize) {
    for (name, points) in large_clouds(&mut Random::new(3003)).into_iter().skip(first).step_by(2) {
        let (built, steps) = steps_of(|| [Hull::of_any_dimension(&points), Hull::simplify(&points, 256)]);
        // Measured: at most 18 n log n for both (a ring). A single quadratic step would be 4,096.
        assert!(steps <= 32 * 16 * MAX_HULL_POINTS as u64, "{name}: {steps}");
        // If both hulls are the same, one check is enough.
        let are_same = built[0].is_ok() && built[0] == built[1];
        for hull in built.into_iter().skip(usize::from(are_same)) {
            match hull {
                Ok(hull) => hull.check(&points).unwrap_or_else(|fault| panic!("{name}: {fault}")),
                Err(HullError::TooManyVertices { at_least }) => assert!(at_least > 256, "{name}"),
                Err(HullError::Flat { .. }) => {}
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
}

// In two halves, which run in parallel.

#[test]
fn the_largest_clouds_take_no_more_steps_than_sorting_would_explain() {
    check(0);
}

#[test]
fn nor_do_the_other_largest_clouds() {
    check(1);
}
