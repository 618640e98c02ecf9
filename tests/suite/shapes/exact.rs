//! Overlap decisions against integers.

use asunder_geometry::{
    Capsule2, Capsule3, Circle, Cuboid, HalfSpace, Pose2, Pose3, Segment3, Shape2, Shape3, Sphere, Triangle3,
};
use asunder_narrow::{Pair2, Pair3};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::{Bodies2, Bodies3};
use asunder_tests::cases::{Case3, Random};
use asunder_tests::integers::common_integers;
use asunder_tests::shapes::{KINDS2, KINDS3, pair2, pair3};
use glam::{DVec3, Vec3};
use num_bigint::BigInt;

/// Short coordinates, for which every product in the engine is exact in f64: relative poses 6 to 8 of the table.
const SHORT: [usize; 3] = [6, 7, 8];

/// Sharp, bounded and convex: the rows that the simplex oracle can judge.
fn sharp<S>(kinds: &[asunder_tests::shapes::Kind<S>]) -> Vec<usize> {
    let names = ["cuboid", "hull", "flat hull", "triangle", "segment", "rectangle", "polygon"];
    (0..kinds.len()).filter(|&i| names.contains(&kinds[i].0)).collect()
}

#[test]
fn sharp_shapes_on_a_lattice_in_space_are_decided_exactly() {
    let (mut touching, mut wrong) = (0, Vec::new());
    for a in sharp(&KINDS3) {
        for b in sharp(&KINDS3) {
            for round in 0..200 {
                let mut random = Random::new((a * 100 + b) as u128 * 1000 + round as u128);
                let bodies = pair3(&mut random, &KINDS3[a], &KINDS3[b], SHORT[round % 3]);
                if bodies.overlaps() != bodies.exactly_overlaps() {
                    wrong.push(bodies.true_separation());
                }
                touching += usize::from(bodies.true_separation().abs() < 1e-12);
            }
        }
    }
    assert!(wrong.is_empty(), "{} decided wrongly, true separations {wrong:?}", wrong.len());
    assert!(touching > 60, "{touching} touching");
}

#[test]
fn sharp_shapes_on_a_lattice_in_the_plane_are_decided_exactly() {
    let (mut touching, mut wrong) = (0, Vec::new());
    for a in sharp(&KINDS2) {
        for b in sharp(&KINDS2) {
            for round in 0..200 {
                let mut random = Random::new((a * 100 + b) as u128 * 1000 + round as u128);
                let bodies = pair2(&mut random, &KINDS2[a], &KINDS2[b], SHORT[round % 3]);
                if bodies.overlaps() != bodies.exactly_overlaps() {
                    wrong.push(bodies.true_separation());
                }
                touching += usize::from(bodies.true_separation().abs() < 1e-12);
            }
        }
    }
    assert!(wrong.is_empty(), "{} decided wrongly, true separations {wrong:?}", wrong.len());
    assert!(touching > 50, "{touching} touching");
}

/// Random poses: the oracles of this module against the simplex, so that neither is wrong alone.
#[test]
fn the_judges_agree_with_the_simplex() {
    let mut asked = 0;
    for a in sharp(&KINDS3) {
        for b in sharp(&KINDS3) {
            for round in 0..12 {
                let mut random = Random::new((a * 100 + b) as u128 * 1000 + round as u128);
                let bodies: Bodies3 = pair3(&mut random, &KINDS3[a], &KINDS3[b], round % 4);
                let truth = bodies.true_separation();
                if truth.abs() > 1e-13 * bodies.reach() {
                    assert_eq!(truth < 0.0, bodies.exactly_overlaps(), "true {truth}: {bodies:?}");
                    asked += 1;
                }
            }
        }
    }
    for a in sharp(&KINDS2) {
        for b in sharp(&KINDS2) {
            for round in 0..12 {
                let mut random = Random::new((a * 100 + b) as u128 * 1000 + round as u128);
                let bodies: Bodies2 = pair2(&mut random, &KINDS2[a], &KINDS2[b], round % 4);
                let truth = bodies.true_separation();
                if truth.abs() > 1e-13 * bodies.reach() {
                    assert_eq!(truth < 0.0, bodies.exactly_overlaps(), "true {truth}: {bodies:?}");
                    asked += 1;
                }
            }
        }
    }
    assert!(asked > 300, "{asked} asked");
}

/// Balls and discs: the square of the distance against the square of the radii's sum, in integers.
#[test]
fn balls_are_decided_by_whole_squares() {
    let mut random = Random::new(7100);
    let (mut touching, mut overlapping) = (0, 0);
    for round in 0..40_000 {
        // Small integers, with which touching is common, times a power of two.
        let unit = [1.0, 0.25, 1024.0, 1.0 / 262_144.0][round % 4];
        let mut whole = |low: i64, count: usize| (low + random.below(count) as i64) as f64 * unit;
        let apart = [whole(-9, 19), whole(-9, 19), whole(-9, 19)];
        let radii = [whole(1, 8), whole(1, 8)];
        let flat = round % 2 == 0;
        let integers =
            common_integers(&[apart[0], apart[1], if flat { 0.0 } else { apart[2] }, radii[0], radii[1]]);
        let square: BigInt = integers[..3].iter().map(|c| c * c).sum();
        let sum = &integers[3] + &integers[4];
        let expected = square <= &sum * &sum;
        let overlaps = if flat {
            let [a, b] = radii.map(|radius| Shape2::from(Circle::new(radius as f32).unwrap()));
            let there = Pose2::at([apart[0], apart[1]]).unwrap();
            Pair2::new(&a, &Pose2::IDENTITY, &b, &there).overlaps()
        } else {
            let [a, b] = radii.map(|radius| Shape3::from(Sphere::new(radius as f32).unwrap()));
            let there = Pose3::at(apart).unwrap();
            Pair3::new(&a, &Pose3::IDENTITY, &b, &there).overlaps()
        };
        assert_eq!(overlaps, expected, "{apart:?} apart, radii {radii:?}");
        touching += usize::from(square == &sum * &sum);
        overlapping += usize::from(expected);
    }
    assert!(touching > 300 && overlapping > 10_000, "{touching} touching, {overlapping} in overlap");
}

type Whole = [i128; 3];

fn minus(a: Whole, b: Whole) -> Whole {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Whole, b: Whole) -> i128 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Whole, b: Whole) -> Whole {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Whether a point is within `radius` of a segment, in integers.
fn is_point_within(p: Whole, [from, to]: [Whole; 2], radius: i128) -> bool {
    let (along, arm) = (minus(to, from), minus(p, from));
    let (place, length) = (dot(arm, along), dot(along, along));
    if place <= 0 || length == 0 {
        return dot(arm, arm) <= radius * radius;
    }
    if place >= length {
        return dot(minus(p, to), minus(p, to)) <= radius * radius;
    }
    let side = cross(arm, along);
    dot(side, side) <= radius * radius * length
}

/// Whether two segments are within `radius`, in integers: an end of either, or the common perpendicular.
fn are_segments_within(a: [Whole; 2], b: [Whole; 2], radius: i128) -> bool {
    let ends =
        a.iter().any(|&p| is_point_within(p, b, radius)) || b.iter().any(|&p| is_point_within(p, a, radius));
    let (u, v, between) = (minus(a[1], a[0]), minus(b[1], b[0]), minus(b[0], a[0]));
    let normal = cross(u, v);
    let square = dot(normal, normal);
    let (s, t) = (dot(cross(between, v), normal), dot(cross(between, u), normal));
    let crosses = square > 0 && (0..=square).contains(&s) && (0..=square).contains(&t);
    ends || crosses && {
        let height = dot(between, normal);
        height * height <= radius * radius * square
    }
}

#[test]
fn capsules_and_balls_are_decided_by_whole_squares() {
    let mut random = Random::new(7101);
    let (mut touching, mut overlapping) = (0, 0);
    // Pairs that touch exactly and were reported apart: in the plane, in space.
    let mut missed = [0, 0];
    for round in 0..40_000 {
        let flat = round % 2 == 0;
        let mut point = |is_flat: bool| -> Whole {
            let z = if is_flat { 0 } else { random.below(9) as i128 - 4 };
            [random.below(9) as i128 - 4, random.below(9) as i128 - 4, z]
        };
        let (a, b) = ([point(flat), point(flat)], [point(flat), point(flat)]);
        let b = if round % 5 == 0 { [[0; 3]; 2] } else { b };
        let at = point(flat);
        let radii = [1 + random.below(3) as i128, 1 + random.below(3) as i128];
        let vertex = |p: Whole| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32);
        let overlaps = if flat {
            let shape = |ends: [Whole; 2], radius: i128| -> Shape2 {
                let [from, to] = ends.map(|end| vertex(end).truncate());
                match Capsule2::new(from, to, radius as f32) {
                    Ok(capsule) => capsule.into(),
                    Err(_) if from == glam::Vec2::ZERO => Circle::new(radius as f32).unwrap().into(),
                    Err(_) => Capsule2::new(from, to + glam::Vec2::X, radius as f32).unwrap().into(),
                }
            };
            let there = Pose2::at(vertex(at).truncate()).unwrap();
            Pair2::new(&shape(a, radii[0]), &Pose2::IDENTITY, &shape(b, radii[1]), &there).overlaps()
        } else {
            let shape = |ends: [Whole; 2], radius: i128| -> Shape3 {
                let [from, to] = ends.map(vertex);
                match Capsule3::new(from, to, radius as f32) {
                    Ok(capsule) => capsule.into(),
                    Err(_) if from == Vec3::ZERO => Sphere::new(radius as f32).unwrap().into(),
                    Err(_) => Capsule3::new(from, to + Vec3::X, radius as f32).unwrap().into(),
                }
            };
            let there = Pose3::at(vertex(at)).unwrap();
            Pair3::new(&shape(a, radii[0]), &Pose3::IDENTITY, &shape(b, radii[1]), &there).overlaps()
        };
        let stretched = |[from, to]: [Whole; 2]| match from == to && from != [0; 3] {
            true => [from, [to[0] + 1, to[1], to[2]]],
            false => [from, to],
        };
        let moved = stretched(b).map(|end| [end[0] + at[0], end[1] + at[1], end[2] + at[2]]);
        let sum = radii[0] + radii[1];
        let expected = are_segments_within(stretched(a), moved, sum);
        // Scaled by a thousand, squares distinguish a distance of exactly the sum from one a thousandth less.
        let thousandfold = |ends: [Whole; 2]| ends.map(|end| end.map(|c| 1000 * c));
        let is_touching =
            expected && !are_segments_within(thousandfold(stretched(a)), thousandfold(moved), 1000 * sum - 1);
        if is_touching && !overlaps {
            missed[usize::from(!flat)] += 1;
        } else {
            assert_eq!(overlaps, expected, "{a:?} radius {}, {b:?} radius {} at {at:?}", radii[0], radii[1]);
        }
        touching += usize::from(is_touching);
        overlapping += usize::from(expected);
    }
    assert!(touching > 300 && overlapping > 10_000, "{touching} touching, {overlapping} in overlap");
    // Along a slanted segment the foot or the normal is rounded, and touching may be computed as 1e-16 apart.
    assert!(
        missed[0] + missed[1] < touching / 50,
        "{missed:?} of {touching} that touch exactly, called apart"
    );
}

/// A ball, a segment's end, a triangle's corner: touching in one point with short coordinates, near and far.
#[test]
fn touching_in_one_short_point_is_touching() {
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let needle = Shape3::from(Segment3::new(Vec3::ZERO, Vec3::X).unwrap());
    let triangle = Shape3::from(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap());
    for origin in [0.0, -3.0, 1e6, 9e8] {
        for (shape, at) in [(&needle, 1.5), (&triangle, 1.5), (&ball, 1.0)] {
            let pose = |x: f64| Pose3::at(DVec3::new(x, 0.0, 0.0)).unwrap();
            let asked = |x: f64| Pair3::new(shape, &pose(origin), &ball, &pose(x)).overlaps();
            assert!(asked(origin + at), "{shape:?} at {origin}");
            assert!(asked((origin + at).next_down()));
            // Within rounding of touching counts as touching, where a radius decides.
            let parted = (origin + at).next_up().max(origin + at + 1e-13);
            assert!(!asked(parted), "{shape:?} at {origin}");
        }
    }
}

/// The oracles for bodies of any kind, on cases that are known beforehand.
#[test]
fn the_judges_know_cases_known_beforehand() {
    let segment = |from: Vec3, to: Vec3| Shape3::from(Segment3::new(from, to).unwrap());
    let needle = segment(Vec3::NEG_Z, Vec3::Z);
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let triangle = Shape3::from(Triangle3::new(Vec3::NEG_X, Vec3::X, Vec3::Y * 2.0).unwrap());
    let capsule = Shape3::from(Capsule3::new(Vec3::ZERO, Vec3::X * 3.0, 0.25).unwrap());
    let floor = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap().rounded(0.5).unwrap());
    let known: [(&Shape3, &Shape3, [f64; 3], f64); 13] = [
        (&ball, &ball, [3.0, 0.0, 4.0], 4.0),
        (&ball, &ball, [0.0, 0.0, 0.0], -1.0),
        // Two collinear needles: overlapping, end to end, and apart.
        (&needle, &needle, [0.0, 0.0, 0.5], 0.0),
        (&needle, &needle, [0.0, 0.0, 2.5], 0.5),
        (&needle, &needle, [0.0, 3.0, 4.0], 13.0_f64.sqrt()),
        // Through a triangle, nearest to its lower edge; up to its centre; and past its corner.
        (&triangle, &needle, [0.0, 0.25, 0.0], -0.25),
        (&triangle, &needle, [0.0, 0.5, 0.875], -0.125),
        (&triangle, &needle, [4.0, 0.0, 0.0], 3.0),
        (&triangle, &triangle, [0.0, 0.5, 0.0], 0.0),
        (&capsule, &ball, [1.5, 1.0, 0.0], 0.25),
        (&floor, &capsule, [9.0, -1.0, 9.0], -1.25),
        (&floor, &triangle, [0.0, 0.75, 0.0], 0.75),
        (&cube, &ball, [4.0, 5.0, 0.0], 4.0),
    ];
    for (a, b, at, expected) in known {
        let case = Case3 {
            shape_a: a.clone(),
            pose_a: Pose3::IDENTITY,
            shape_b: b.clone(),
            pose_b: Pose3::at(at).unwrap(),
        };
        for case in [case.swapped(), case] {
            let found = Bodies3::new(case).true_separation();
            assert!((found - expected).abs() < 1e-14, "{found}, known {expected}: {a:?} and {b:?} at {at:?}");
        }
    }
}
