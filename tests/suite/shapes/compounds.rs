//! Compounds: the least of their parts' separations, a manifold for each pair of parts that touch, and nothing else.

use crate::shapes::Judged;
use asunder_geometry::{
    Circle, Compound2, Compound3, Cuboid, Pose2, Pose3, Rotation2, Segment2, Shape2, Shape3, Sphere,
};
use asunder_narrow::{ContactPoint3, Pair2, Pair3, Separation2, Separation3};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::{Bodies2, Bodies3};
use asunder_tests::cases::{Case2, Case3, Random};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3, pair2, pair3};
use glam::{DVec3, Quat, Vec2, Vec3};

const COMPOUND3: usize = 10;
const COMPOUND2: usize = 7;

/// A pair of compounds has manifolds exactly for the parts that are near, in order, each right by itself.
#[test]
fn every_pair_of_parts_that_touches_has_one_manifold() {
    let (mut several, mut none) = (0, 0);
    for round in 0..1500 {
        let mut random = Random::new(7300 + round as u128);
        let other = if round % 2 == 0 { COMPOUND3 } else { random.below(KINDS3.len()) };
        let bodies = pair3(&mut random, &KINDS3[COMPOUND3], &KINDS3[other], round);
        let margin = [0.0, 0.05][round % 2] * bodies.size();
        let manifolds = bodies.pair().manifolds(margin as f32);
        let found: Vec<_> = manifolds.iter().map(|m| (m.part_a as usize, m.part_b as usize)).collect();
        assert!(found.is_sorted_by(|one, other| one < other), "in order of the parts, each once: {found:?}");
        let Shape3::Compound(compound) = &bodies.case().shape_a else { unreachable!("a compound") };
        let others = match &bodies.case().shape_b {
            Shape3::Compound(compound) => compound.parts().len(),
            _ => 1,
        };
        let band = 4e-6 * bodies.size() + 1e-13 * bodies.reach();
        for a in 0..compound.parts().len() {
            for b in 0..others {
                let truth = bodies.truth_of_parts(a, b);
                if (truth - margin).abs() > band {
                    assert_eq!(found.contains(&(a, b)), truth < margin, "{a} {b}, true {truth}: {bodies:?}");
                }
            }
        }
        for manifold in &manifolds {
            let judged = bodies.judged(manifold);
            let truth = bodies.truth_of_parts(manifold.part_a as usize, manifold.part_b as usize);
            let judge = Judged { asked: &bodies, truth, size: bodies.size(), reach: bodies.reach() };
            judge.check_points(&judged, margin, 4);
        }
        let least = manifolds.iter().map(|m| m.separation).fold(f32::INFINITY, f32::min);
        let deepest = bodies.pair().manifold(margin as f32).map_or(f32::INFINITY, |m| m.separation);
        assert_eq!(deepest, least, "the deepest of them");
        several += usize::from(manifolds.len() > 1);
        none += usize::from(manifolds.is_empty());
    }
    assert!(several > 200 && none > 100, "{several} with several, {none} with none");
}

#[test]
fn every_pair_of_parts_in_the_plane_that_touches_has_one_manifold() {
    let (mut several, mut none) = (0, 0);
    for round in 0..3000 {
        let mut random = Random::new(7310 + round as u128);
        let other = if round % 2 == 0 { COMPOUND2 } else { random.below(KINDS2.len()) };
        let bodies = pair2(&mut random, &KINDS2[COMPOUND2], &KINDS2[other], round);
        let margin = [0.0, 0.05][round % 2] * bodies.size();
        let manifolds = bodies.pair().manifolds(margin as f32);
        let found: Vec<_> = manifolds.iter().map(|m| (m.part_a as usize, m.part_b as usize)).collect();
        assert!(found.is_sorted_by(|one, other| one < other), "in order of the parts, each once: {found:?}");
        for manifold in &manifolds {
            let judged = bodies.judged(manifold);
            let truth = bodies.truth_of_parts(manifold.part_a as usize, manifold.part_b as usize);
            let judge = Judged { asked: &bodies, truth, size: bodies.size(), reach: bodies.reach() };
            judge.check_points(&judged, margin, 2);
        }
        several += usize::from(manifolds.len() > 1);
        none += usize::from(manifolds.is_empty());
    }
    assert!(several > 400 && none > 200, "{several} with several, {none} with none");
}

/// Whether a pair has a kernel of its own, not used for parts of compounds, that rounds its separation differently.
const fn has_own_number(a: &Shape3, b: &Shape3) -> bool {
    use Shape3::{Capsule, HalfSpace, Hull, Segment, Sphere, Triangle};
    matches!(
        (a, b),
        (Sphere(_), Capsule(_) | Segment(_) | Triangle(_) | Hull(_))
            | (Capsule(_) | Segment(_) | Triangle(_) | Hull(_), Sphere(_))
            | (Capsule(_) | Segment(_), Capsule(_) | Segment(_))
            | (HalfSpace(_), _)
            | (_, HalfSpace(_))
    )
}

/// The same for points alone.
const fn has_own_points(a: &Shape3, b: &Shape3) -> bool {
    use Shape3::{Cuboid, Sphere};
    matches!((a, b), (Cuboid(_) | Sphere(_), Cuboid(_) | Sphere(_))) || has_own_number(a, b)
}

/// Asserts that the points are the same, up to rounding to f32.
fn assert_alike(one: &[ContactPoint3], other: &[ContactPoint3], size: f64) {
    let features = |points: &[ContactPoint3]| points.iter().map(|point| point.feature).collect::<Vec<_>>();
    assert_eq!(features(one), features(other));
    let slack = 4.0 * f64::from(f32::EPSILON) * size;
    for (one, other) in one.iter().zip(other) {
        let apart = (one.anchor_a - other.anchor_a).length().max((one.anchor_b - other.anchor_b).length());
        let deeper = (one.separation - other.separation).abs();
        assert!(f64::from(apart.max(deeper)) <= slack, "{one:?}, {other:?}");
    }
}

/// One part with the identity pose in its compound gives the same bits as the shape alone; moved, the same within
/// errors.
#[test]
fn a_compound_of_one_part_is_that_part() {
    for round in 0..1500 {
        let mut random = Random::new(7320 + round as u128);
        let kinds = [random.below(COMPOUND3), random.below(KINDS3.len())];
        let bodies = pair3(&mut random, &KINDS3[kinds[0]], &KINDS3[kinds[1]], round);
        let Case3 { shape_a, pose_a, shape_b, pose_b } = bodies.case();
        let alone = Compound3::new([(Pose3::IDENTITY, shape_a.clone())]).unwrap().into();
        let pair = Pair3::new(&alone, pose_a, shape_b, pose_b);
        assert_eq!(pair.overlaps(), bodies.overlaps(), "{bodies:?}");
        let [one, other] = [&pair, &bodies.pair()].map(|pair| pair.separation(f32::INFINITY));
        let (Separation3::Measured(one), Separation3::Measured(other)) = (one, other) else {
            panic!("no limit")
        };
        if has_own_number(shape_a, shape_b) {
            let is_same = one.separation == other.separation;
            let apart = (one.separation - other.separation).abs();
            assert!(is_same || apart <= one.error + other.error, "{bodies:?}");
            // For two capsules in one place, all directions across their segments are equally good.
            if shape_a == shape_b && pose_a == pose_b {
                continue;
            }
            assert!((one.normal - other.normal).length() <= 1e-6, "{bodies:?}");
        } else {
            assert_eq!((one.separation, one.normal), (other.separation, other.normal), "{bodies:?}");
        }
        let points = |pair: &Pair3| pair.manifold(0.1).map_or(Default::default(), |manifold| manifold.points);
        let (of_part, of_body) = (points(&pair), points(&bodies.pair()));
        // Kernels for special pairs place their points with fewer roundings.
        if has_own_points(shape_a, shape_b) {
            assert_alike(&of_part, &of_body, f64::from(bodies.pair().size()));
        } else {
            assert_eq!(of_part, of_body, "{bodies:?}");
        }
        // A body at the origin whose only part is where the shape was.
        if pose_a.position().length() < 10.0 {
            let moved = Compound3::new([(*pose_a, shape_a.clone())]).unwrap().into();
            let pair = Pair3::new(&moved, &Pose3::IDENTITY, shape_b, pose_b);
            let Separation3::Measured(moved) = pair.separation(f32::INFINITY) else { panic!("no limit") };
            let slack = moved.error + other.error;
            assert!((moved.separation - other.separation).abs() <= slack, "{moved:?}, {other:?}: {bodies:?}");
        }
    }
}

#[test]
fn a_compound_of_one_part_in_the_plane_is_that_part() {
    for round in 0..2000 {
        let mut random = Random::new(7330 + round as u128);
        let kinds = [random.below(COMPOUND2), random.below(KINDS2.len())];
        let bodies = pair2(&mut random, &KINDS2[kinds[0]], &KINDS2[kinds[1]], round);
        let Case2 { shape_a, pose_a, shape_b, pose_b } = bodies.case();
        let alone = Compound2::new([(Pose2::IDENTITY, shape_a.clone())]).unwrap().into();
        let pair = Pair2::new(&alone, pose_a, shape_b, pose_b);
        assert_eq!(pair.overlaps(), bodies.overlaps(), "{bodies:?}");
        let [one, other] = [&pair, &bodies.pair()].map(|pair| pair.separation(f32::INFINITY));
        let (Separation2::Measured(one), Separation2::Measured(other)) = (one, other) else {
            panic!("no limit")
        };
        assert_eq!((one.separation, one.normal), (other.separation, other.normal), "{bodies:?}");
        let points = |pair: &Pair2| pair.manifold(0.1).map(|manifold| manifold.points);
        assert_eq!(points(&pair), points(&bodies.pair()), "{bodies:?}");
    }
}

/// A part whose bounding sphere is beyond the limit may still be nearer than one that was measured.
#[test]
fn a_limit_never_hides_the_nearer_part() {
    let rod = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 1.0, 1.0)).unwrap());
    let ball = Shape3::from(Sphere::new(1.0).unwrap());
    // A corner of the cube is 0.3 sqrt(3) = 0.52 m from the origin, but only 0.3 m on each axis; the ball is 0.4 m
    // away.
    let parts = [(Pose3::at([1.3, 1.3, 1.3]).unwrap(), rod), (Pose3::at([-1.4, 0.0, 0.0]).unwrap(), ball)];
    let compound = Shape3::from(Compound3::new(parts).unwrap());
    let point = Shape3::from(Sphere::new(1e-6).unwrap());
    let pair = Pair3::new(&compound, &Pose3::IDENTITY, &point, &Pose3::IDENTITY);
    for limit in [0.0, 0.2, 0.35, 0.39, 0.41, 0.6, f32::INFINITY] {
        match pair.separation(limit) {
            Separation3::Measured(found) => assert!(
                (found.separation - 0.4).abs() < 1e-5,
                "with a limit of {limit}: {found:?}, but the ball is 0.4 m away"
            ),
            Separation3::AtLeast(bound) => {
                assert!(bound >= limit && bound <= 0.4, "at least {bound} at {limit}")
            }
        }
    }
}

/// A bound is never less than the limit, even where it comes from a bounding sphere.
#[test]
fn a_bound_is_never_below_the_limit() {
    let ball = Shape3::from(Sphere::new(1.0).unwrap());
    let compound = Shape3::from(Compound3::new([(Pose3::IDENTITY, ball.clone())]).unwrap());
    for shape in [&ball, &compound] {
        for step in 1..200 {
            let there = Pose3::at([3.0 + f64::from(step) * 1e-9, 0.0, 0.0]).unwrap();
            let pair = Pair3::new(shape, &Pose3::IDENTITY, &ball, &there);
            if let Separation3::AtLeast(bound) = pair.separation(1.0) {
                assert!(bound >= 1.0, "at least {bound} with a limit of 1, {step} nm beyond: {shape:?}");
            }
        }
    }
}

/// The stored 2D matrix is a rotation only up to rounding, and may make a shape larger than its bounding circle.
#[test]
fn a_part_that_its_rotation_makes_longer_still_touches() {
    let mut random = Random::new(7340);
    let mut tried = 0;
    for _ in 0..20_000 {
        let turn = random.rotation2();
        let scale = (f64::from(turn.cos()) * f64::from(turn.cos())
            + f64::from(turn.sin()) * f64::from(turn.sin()))
        .sqrt();
        let end = random.direction2().as_vec2() * 50.0;
        let needle = Shape2::from(Segment2::new(-end, end).unwrap());
        let slack = f64::from(needle.outer_radius()) - end.as_dvec2().length();
        // Only needles longer than their bounding circle, whose radius was rounded up.
        if end.as_dvec2().length() * (scale - 1.0) < slack + 1e-6 {
            continue;
        }
        tried += 1;
        let compound = Shape2::from(Compound2::new([(Pose2::IDENTITY, needle.clone())]).unwrap());
        let pose = Pose2::new([0.0, 0.0], turn).unwrap();
        // A circle on the same line, which the needle's true end enters by 0.3 micrometres.
        let tip = turn.turn(end.as_dvec2());
        let ball = Shape2::from(Circle::new(1.0).unwrap());
        let there = Pose2::at(tip + tip.normalize() * (1.0 - 0.3e-6)).unwrap();
        let alone = Pair2::new(&needle, &pose, &ball, &there);
        let part = Pair2::new(&compound, &pose, &ball, &there);
        assert!(alone.overlaps(), "0.3 micrometres deep");
        assert!(part.overlaps(), "a needle overlaps, its compound does not: {needle:?} {pose:?} {there:?}");
        assert!(part.manifold(0.0).is_some());
    }
    assert!(tried > 10, "{tried} needles");
}

/// Far from the compound's origin, with a body pose that moves the part back.
#[test]
fn parts_far_from_their_compounds_origin_are_as_exact_as_their_places() {
    for round in 0..600 {
        let mut random = Random::new(7350 + round as u128);
        let far = random.direction() * 9e5;
        let mut clay = Clay::new(&mut random, 1.0);
        let part = KINDS3[round % COMPOUND3].1(&mut clay);
        let other = KINDS3[(round / 7) % COMPOUND3].1(&mut clay);
        let turn = random.quaternion();
        let compound = Compound3::new([(Pose3::new(far, random.quaternion()).unwrap(), part)]).unwrap();
        let body = Pose3::new(random.vector(), turn).unwrap();
        let near = body.transform(far) + random.direction() * random.between(0.0, 2.0);
        let case = Case3 {
            shape_a: compound.into(),
            pose_a: body,
            shape_b: other,
            pose_b: Pose3::new(near, random.quaternion()).unwrap(),
        };
        let bodies = Bodies3::new(case);
        let truth = bodies.true_separation();
        let judge = Judged { asked: &bodies, truth, size: bodies.size(), reach: bodies.reach() };
        judge.check_separations();
    }
}

/// Compared in their final poses: a rotated compound of rotated parts against the parts as separate bodies.
#[test]
fn a_compound_is_its_parts_as_bodies() {
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let box_ = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.25, 1.0, 0.5)).unwrap());
    let quarter = Quat::from_xyzw(0.0, 0.0, 1.0, 1.0);
    let inner = Pose3::new([0.0, 2.0, 0.0], quarter).unwrap();
    let hammer: Shape3 =
        Compound3::new([(Pose3::at([0.0, -1.0, 0.0]).unwrap(), ball.clone()), (inner, box_.clone())])
            .unwrap()
            .into();
    let pose = Pose3::new([5.0, 0.0, 0.0], quarter).unwrap();
    // A quarter turn about z takes y to -x: the ball ends up at x = 6, the box at x = 3, rotated by half a turn.
    let half_turn = Quat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let parts = [
        (ball, Pose3::at([6.0, 0.0, 0.0]).unwrap()),
        (box_, Pose3::new([3.0, 0.0, 0.0], half_turn).unwrap()),
    ];
    let probe = Shape3::from(Sphere::new(0.75).unwrap());
    for x in 0..80 {
        let at = DVec3::new(f64::from(x) * 0.1, 0.4, 0.1);
        let there = Pose3::at(at).unwrap();
        let expected = parts.iter().map(|(shape, pose)| {
            let Separation3::Measured(found) =
                Pair3::new(shape, pose, &probe, &there).separation(f32::INFINITY)
            else {
                panic!("no limit")
            };
            found.separation
        });
        let expected = expected.fold(f32::INFINITY, f32::min);
        let pair = Pair3::new(&hammer, &pose, &probe, &there);
        let Separation3::Measured(found) = pair.separation(f32::INFINITY) else { panic!("no limit") };
        assert!((found.separation - expected).abs() < 1e-6, "{found:?}, by its parts {expected}, at {at}");
    }
    // The same in the plane, with a rotation that has length one only up to rounding.
    let turn = Rotation2::new(0.6, 0.8).unwrap();
    let disc = Shape2::from(Circle::new(0.5).unwrap());
    let pair_of = Compound2::new([(Pose2::at(Vec2::X).unwrap(), disc.clone())]).unwrap().into();
    let pose = Pose2::new([1.0, 1.0], turn).unwrap();
    let there = Pose2::at([1.6, 3.8]).unwrap();
    let Separation2::Measured(found) = Pair2::new(&pair_of, &pose, &disc, &there).separation(f32::INFINITY)
    else {
        panic!("no limit")
    };
    assert!((found.separation - 1.0).abs() < 1e-6, "{found:?}");
    let bodies = Bodies2::new(Case2 { shape_a: pair_of, pose_a: pose, shape_b: disc, pose_b: there });
    assert!((bodies.true_separation() - 1.0).abs() < 1e-6);
}
