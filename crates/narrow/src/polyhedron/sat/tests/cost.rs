//! What the largest hulls cost, counted and not timed: see `crate::counted`.

use super::*;
use crate::Pair3;
use crate::counted::steps_of;
use asunder_geometry::glam::DVec2;

/// Corners of a regular polygon whose number of corners is a power of two, without trigonometry.
fn regular(count: usize) -> Vec<DVec2> {
    let mut step = DVec2::Y;
    for _ in 2..count.trailing_zeros() {
        let cosine = (0.5 + 0.5 * step.x).sqrt();
        step = DVec2::new(cosine, 0.5 * step.y / cosine);
    }
    (0..count).scan(DVec2::X, |at, _| Some(core::mem::replace(at, step.rotate(*at)))).collect()
}

/// How many kinds of hulls there are.
const KINDS: usize = 7;

/// Hulls of 256 vertices, or nearly, all different: round, symmetric, with large faces, thin, long.
fn hull(random: &mut Random, kind: usize) -> Shape3 {
    let [wide, high] = [0.3 + 0.2 * random.number().abs(), 0.3 + 0.2 * random.number().abs()];
    let ring = |count: usize, wide: f32, z: f32| {
        regular(count).into_iter().map(move |at| (at.as_vec2() * wide).extend(z))
    };
    let points: Vec<Vec3> = match kind % KINDS {
        0 => return random.round_hull(256),
        1 => ring(128, wide, -high).chain(ring(128, wide, high)).collect(),
        // Rings at the latitudes of a globe, and its poles.
        2 => regular(64)[1..32]
            .iter()
            .step_by(2)
            .flat_map(|at| ring(16, wide * at.y as f32, wide * at.x as f32))
            .collect(),
        3 => ring(128, wide, -0.001).chain(ring(128, wide, 0.001)).collect(),
        4 => ring(128, 0.01, -high).chain(ring(128, 0.01, high)).collect(),
        5 => ring(128, wide, 0.0).chain([Vec3::Z * high, -Vec3::Z * high]).collect(),
        _ => ring(128, wide, -high).chain(ring(128, 0.9 * wide, high)).collect(),
    };
    Hull::from_points(&points).unwrap().into()
}

/// How B lies: in A's exact place, about A's centre, deep inside, lightly overlapping, and apart.
const LIES: [&str; 7] = ["same", "half a step", "turned", "deep", "aligned", "light", "apart"];

fn lie(random: &mut Random, lie: usize) -> [Pose3; 2] {
    let turn = random.turn(0);
    let pose = |at: Vec3, turn: Quat| Pose3::new(at, turn).unwrap();
    let here = pose(Vec3::ZERO, turn);
    let towards = random.vector().normalize_or(Vec3::X);
    let there = match lie {
        0 => here,
        1 => pose(Vec3::ZERO, turn * Quat::from_xyzw(0.0, 0.0, 0.012_271_538, 0.999_924_7)),
        2 => pose(Vec3::ZERO, random.turn(0)),
        3 => pose(0.1 * towards, random.turn(0)),
        4 => pose(turn * (Vec3::Z * 0.5 * random.number()), turn),
        5 => pose(0.6 * towards, random.turn(0)),
        _ => pose(3.0 * towards, random.turn(0)),
    };
    [here, there]
}

/// Steps of every query about a pair.
fn steps(shapes: [&Shape3; 2], poses: [Pose3; 2]) -> [usize; 4] {
    let pair = Pair3::new(shapes[0], &poses[0], shapes[1], &poses[1]);
    [
        steps_of(|| pair.overlaps()).1,
        steps_of(|| pair.separation(0.0)).1,
        steps_of(|| pair.distance()).1,
        steps_of(|| pair.manifold(0.0)).1,
    ]
}

#[test]
fn twice_the_vertices_cost_less_than_three_times_as_much() {
    let mut random = Random(0x2127_599B_F432_5C37);
    for (number, name) in LIES.iter().enumerate() {
        let mut sums = [[0; 4]; 2];
        for _ in 0..30 {
            let poses = lie(&mut random, number);
            for (sum, vertices) in sums.iter_mut().zip([128, 256]) {
                let (shape_a, shape_b) = (random.round_hull(vertices), random.round_hull(vertices));
                let one = steps([&shape_a, if number == 0 { &shape_a } else { &shape_b }], poses);
                (0..4).for_each(|i| sum[i] += one[i]);
            }
        }
        assert!(sums[0].iter().any(|&few| few > 5000), "{name}: nothing was counted: {sums:?}");
        for (few, many) in sums[0].into_iter().zip(sums[1]) {
            assert!(many <= 3 * few, "{name}: {sums:?}");
        }
    }
}

/// A millisecond at 4 ns a step. The worst are two equal prisms in one place, whose 50,000 pairs of edges that may
/// touch are all even, and double cones, all of whose axes are equally good.
const MOST: usize = 250_000;

#[test]
fn no_pair_of_the_largest_hulls_takes_a_millisecond() {
    let mut random = Random(0x9216_D5D9_8979_FB1B);
    let mut worst = 0;
    for kind in 0..KINDS {
        for (number, name) in LIES.iter().enumerate() {
            for round in 0..8 {
                let shape_a = hull(&mut random, kind);
                let shape_b = if round < 6 { shape_a.clone() } else { hull(&mut random, kind + round) };
                let steps = steps([&shape_a, &shape_b], lie(&mut random, number));
                let most = steps.into_iter().max().unwrap();
                assert!(most <= MOST, "{steps:?} steps: kind {kind}, {name}, {shape_a:?}, {shape_b:?}");
                worst = worst.max(most);
            }
        }
    }
    assert!(worst > MOST / 4, "the hard ones are among them: {worst}");
}
