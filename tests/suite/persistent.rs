//! Manifolds that are moved along: at the shapes' new poses they are right within their stated error, or are rejected.
//!
//! The oracles are separations in double-double arithmetic, exact overlap, and drifts measured at the vertices.

use asunder_geometry::tolerance::EVEN_DEPTH;
use asunder_geometry::{Compound3, Cuboid, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use asunder_narrow::{
    Batch2, Batch3, Hint, Job2, Job3, Pair2, Pair3, Persistent2, Persistent3, collide2, collide3,
};
use asunder_scenes::pairs::{PairSet, PlaneKind, PosedPair2, PosedPair3, SolidKind, pairs2, pairs3};
use asunder_scenes::random::Random;
use asunder_tests::precise::{along2, separation2, separation3};
use glam::{DQuat, DVec2, DVec3, Vec2, Vec3};

/// The largest error that a manifold may state, as a share of the pair's size: twice a drift of 2^-15 of the smaller
/// radius, or once that on a footing, and a little for rounding.
const PROMISED: f64 = 3.1e-5;

const SETS: [PairSet; 4] = [PairSet::Rest, PairSet::Touch, PairSet::Mixed, PairSet::Slide];

fn kept(pair: &PosedPair3, margin: f32) -> Option<Persistent3> {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    let job = Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint: Hint::NONE, ahead: 0.0, sensor: false };
    let mut batch = Batch3::default();
    collide3(&[job], &mut batch);
    Persistent3::of(&job, &batch.answers[0], &batch.manifolds)
}

/// A small rotation about any axis, and a small step.
fn small(random: &mut Random, turn: f64, step: f64) -> (DQuat, DVec3) {
    let axis = random.direction() * turn * 0.5;
    (DQuat::from_xyzw(axis.x, axis.y, axis.z, 1.0).normalize(), random.direction() * step)
}

fn moved(pose: &Pose3, (turn, step): (DQuat, DVec3), around: DVec3) -> Pose3 {
    let place = around + turn * (pose.position() - around) + step;
    let rotation = if turn == DQuat::IDENTITY {
        pose.rotation()
    } else {
        (turn * pose.rotation().as_dquat().normalize()).as_quat()
    };
    Pose3::new(place, rotation).unwrap()
}

/// How far the vertices of B moved relative to A, and those of A relative to B: the lesser of the two maxima.
fn drift(before: &PosedPair3, now: &PosedPair3) -> f64 {
    let seen = |pair: &PosedPair3, of: usize| -> Vec<DVec3> {
        let (shape, pose, other): (&Shape3, _, _) = if of == 0 {
            (&pair.shape_a, &pair.pose_a, &pair.pose_b)
        } else {
            (&pair.shape_b, &pair.pose_b, &pair.pose_a)
        };
        shape.core().vertices().iter().map(|v| other.transform_back(pose.transform(*v))).collect()
    };
    let greatest = |of: usize| {
        let (one, other) = (seen(before, of), seen(now, of));
        one.iter().zip(other).map(|(one, other)| (*one - other).length()).fold(0.0, f64::max)
    };
    greatest(0).min(greatest(1))
}

/// The separation along one axis.
fn along(pair: &PosedPair3, axis: DVec3) -> f64 {
    let least = |shape: &Shape3, pose: &Pose3, axis: DVec3| {
        let heights = |v: &Vec3| pose.turn(v.as_dvec3()).dot(axis);
        shape.core().vertices().iter().map(heights).fold(f64::INFINITY, f64::min)
    };
    let offset = (pair.pose_b.position() - pair.pose_a.position()).dot(axis);
    offset + least(&pair.shape_b, &pair.pose_b, axis) + least(&pair.shape_a, &pair.pose_a, -axis)
}

/// Asserts that a manifold that was moved along is right for the pair at its present poses.
fn check(persistent: &Persistent3, pair: &PosedPair3, margin: f32, story: &str) {
    let mut found = Vec::new();
    assert!(persistent.carry_on([&pair.pose_a, &pair.pose_b], &mut found));
    let manifold = &found[0];
    let whole = Pair3::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b);
    assert_eq!(persistent.overlapping(), whole.overlaps(), "{story}: {manifold:?}");
    assert_eq!(persistent.overlapping(), manifold.separation <= 0.0, "{story}: {manifold:?}");
    assert!(persistent.overlapping() || manifold.separation <= margin, "{story}: {manifold:?}");
    let truth = separation3((&pair.shape_a, &pair.pose_a), (&pair.shape_b, &pair.pose_b));
    let size = f64::from(whole.size());
    let off = (f64::from(manifold.separation) - truth.separation).abs();
    assert!(off <= f64::from(manifold.error) + truth.bound, "{story}: off by {off}, {manifold:?}");
    assert!(f64::from(manifold.error) <= PROMISED * size, "{story}: {manifold:?}");
    assert!((manifold.normal.as_dvec3().length() - 1.0).abs() < 1e-6);
    let apart = along(pair, manifold.normal.as_dvec3());
    let shown = f64::from(manifold.separation - manifold.error) - 2e-6 * size;
    assert!(apart >= shown, "{story}: {apart} along the normal, {manifold:?}");
    let then = persistent.manifolds().next().unwrap();
    assert_eq!(manifold.points.len(), then.points.len());
    let offset = pair.pose_b.position() - pair.pose_a.position();
    for (point, before) in manifold.points.iter().zip(&then.points) {
        assert_eq!(point.feature, before.feature, "{story}");
        let apart = offset + point.anchor_b.as_dvec3() - point.anchor_a.as_dvec3();
        let straight = manifold.normal.as_dvec3() * f64::from(point.separation);
        assert!((apart - straight).length() <= 1e-6 * size, "{story}: one is not over the other, {point:?}");
    }
    let deepest =
        manifold.points.iter().map(|point| f64::from(point.separation)).fold(f64::INFINITY, f64::min);
    // Four points may stand for more.
    let even = if manifold.points.len() == 4 { EVEN_DEPTH * size } else { 0.0 };
    let steady = f64::from(manifold.error) + 2e-6 * size + even;
    assert!((deepest - f64::from(manifold.separation)).abs() <= steady, "{story}: {manifold:?}");
}

#[test]
fn what_is_moved_along_is_true_in_space() {
    let mut random = Random::new(71);
    let (mut carried, mut refused, mut slid) = (0, 0, 0);
    for kind in [SolidKind::Box, SolidKind::Authored, SolidKind::Hull16] {
        for set in SETS {
            for (number, pair) in pairs3(kind, set, 120, 5).into_iter().enumerate() {
                let size = f64::from(pair.shape_a.outer_radius() + pair.shape_b.outer_radius());
                let margin = (0.02 * size) as f32;
                let Some(persistent) = kept(&pair, margin) else { continue };
                let story = format!("{} {} {number}", kind.name(), set.name());
                for round in 0..12_usize {
                    // Both first move a long way together, or not; then B moves a little by itself, turning or not.
                    let spread = [1e-5, 1e-6, 1e-7, 1e-8][round % 4] * size;
                    let (together, alone) = match round {
                        0..4 => (0.0, 0.0),
                        4..8 => (random.range(0.0, 3.0), random.range(0.0, 2.0) * spread),
                        _ => (random.range(0.0, 3.0), random.range(0.0, 0.1) * spread),
                    };
                    let both = small(&mut random, together, together);
                    let step = random.range(0.0, 60.0) * spread;
                    let one = small(&mut random, alone, step);
                    let middle = pair.pose_a.position();
                    let of_b = moved(&moved(&pair.pose_b, both, middle), one, middle + both.1);
                    let now = PosedPair3 {
                        pose_a: moved(&pair.pose_a, both, middle),
                        pose_b: of_b,
                        ..pair.clone()
                    };
                    let drift = drift(&pair, &now);
                    let most = f64::from(persistent.reach());
                    assert!(persistent.reach() <= Persistent3::most_reach(&job(&pair, margin)), "{story}");
                    if persistent.carry_on([&now.pose_a, &now.pose_b], &mut Vec::new()) {
                        assert!(drift <= most + 1e-9 * size, "{story}: it drifted by {drift}");
                        check(&persistent, &now, margin, &story);
                        carried += 1;
                        slid += usize::from(drift > 4e-5 * size);
                    } else {
                        // Rotations are stored in f32, and so points move by some 1e-7 of the size.
                        refused += 1;
                    }
                }
            }
        }
    }
    assert!(carried > 6000 && refused > 2000, "{carried} carried, {refused} refused");
    assert!(slid > 1500, "{slid} went further than a footing is needed for");
}

fn job(pair: &PosedPair3, margin: f32) -> Job3<'_> {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = pair;
    Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint: Hint::NONE, ahead: 0.0, sensor: false }
}

/// Contacts that rounding or a drift could decide either way are never kept.
#[test]
fn what_is_close_to_call_is_not_kept() {
    let mut seen = 0;
    for pair in pairs3(SolidKind::Box, PairSet::Rest, 60, 9) {
        let Some(persistent) = kept(&pair, 0.0) else { continue };
        let then = persistent.manifolds().next().unwrap();
        let (normal, depth) = (then.normal.as_dvec3(), -f64::from(then.separation));
        let lifted = |by: f64| {
            let pose_b = Pose3::new(pair.pose_b.position() + normal * by, pair.pose_b.rotation()).unwrap();
            PosedPair3 { pose_b, ..pair.clone() }
        };
        // A millionth of a millimetre of overlap, or of gap, and the same around the margin.
        let close =
            [(depth - 1e-9, 0.0, 3e-9), (depth + 1e-9, 0.01, -3e-9), (depth + 0.01 - 1e-9, 0.01, 3e-9)];
        for (by, margin, step) in close {
            if let Some(close) = kept(&lifted(by), margin) {
                let mut moved = Vec::new();
                let beyond = lifted(by + step);
                assert!(!close.carry_on([&beyond.pose_a, &beyond.pose_b], &mut moved), "{by} of {depth}");
            }
            seen += 1;
        }
    }
    assert!(seen > 100);
}

/// A corner across a gap from a corner, or from an edge, has a normal of its own, which turns with the bodies; in the
/// plane, such contacts are not kept.
#[test]
fn corners_across_a_gap_are_kept_by_what_is_nearest() {
    let square = Shape2::from(Rect::from_half_extents(Vec2::ONE).unwrap());
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap());
    let mut random = Random::new(73);
    let mut seen = [0; 2];
    for gap in [1e-5, 1e-4, 1e-3, 5e-3] {
        let (at_a, at_b) = (Pose2::IDENTITY, Pose2::at([2.0 + gap, 2.0 + gap]).unwrap());
        let job = Job2 {
            shape_a: &square,
            pose_a: &at_a,
            shape_b: &square,
            pose_b: &at_b,
            margin: 0.01,
            hint: Hint::NONE,
            ahead: 0.0,
            sensor: false,
        };
        let mut batch = Batch2::default();
        collide2(&[job], &mut batch);
        assert_eq!(batch.manifolds.len(), 1, "{gap}");
        assert_eq!(Persistent2::of(&job, &batch.answers[0], &batch.manifolds), None, "{gap}");
        // Two parallel edges, and two corners.
        for (way, place) in [[2.0 + gap, 2.0 + gap, 0.3], [2.0 + gap; 3]].into_iter().enumerate() {
            let pair = PosedPair3 {
                shape_a: cube.clone(),
                pose_a: Pose3::IDENTITY,
                shape_b: cube.clone(),
                pose_b: Pose3::at(place).unwrap(),
            };
            let persistent = kept(&pair, 0.01).expect("it is some way from touching, and within the margin");
            for _ in 0..40 {
                let (spin, step) = (random.range(0.0, 1e-5), random.range(0.0, 5e-5));
                let now = PosedPair3 {
                    pose_b: moved(&pair.pose_b, small(&mut random, spin, step), pair.pose_b.position()),
                    ..pair.clone()
                };
                if persistent.carry_on([&now.pose_a, &now.pose_b], &mut Vec::new()) {
                    check(&persistent, &now, 0.01, &format!("{way} {gap}"));
                    seen[way] += 1;
                }
            }
        }
    }
    assert!(seen[0] > 40 && seen[1] > 40, "{seen:?}");
}

/// Along the normal of a manifold that was moved along, all of both bodies are as far apart as reported, not only what
/// is near. If edges and corners almost face to face turned the normal, it would tilt with every step; a face that
/// turned with its own small body, and not with the ground under it, would lift the ground's far end.
#[test]
fn far_ends_are_as_far_apart_along_the_normal_as_is_told() {
    let cube = |half: f32| Shape3::from(Cuboid::from_half_extents(Vec3::splat(half)).unwrap());
    let floor = Shape3::from(Cuboid::from_half_extents(Vec3::new(100.0, 100.0, 1.0)).unwrap());
    let tilted = Pose3::new(
        DVec3::new(30.0, 20.0, 1.499),
        DQuat::from_xyzw(1e-4, 2e-4, 0.3, 1.0).normalize().as_quat(),
    );
    let (lone, turned) = ((cube(1.0), Pose3::IDENTITY), (cube(0.5), tilted.unwrap()));
    let at = |place: [f64; 3]| (cube(1.0), Pose3::at(place).unwrap());
    let pairs = [
        (lone.clone(), at([2.001, 2.0 + 1e-6, 0.3])),
        (lone.clone(), at([2.001, 2.0 + 1e-6, 2.0 + 1e-6])),
        ((floor.clone(), Pose3::IDENTITY), turned.clone()),
        (turned, (floor, Pose3::IDENTITY)),
    ];
    let mut random = Random::new(74);
    for (way, ((shape_a, pose_a), (shape_b, pose_b))) in pairs.into_iter().enumerate() {
        let pair = PosedPair3 { shape_a, pose_a, shape_b, pose_b };
        let persistent = kept(&pair, 0.01).expect("it is some way from touching, and within the margin");
        let mut seen = 0;
        for _ in 0..200 {
            let (spin, step) = (random.range(0.0, 1e-5), random.range(0.0, 3e-5));
            let small = small(&mut random, spin, step);
            let then = persistent.manifolds().next().unwrap();
            let around = pair.pose_b.position() + then.points[0].anchor_b.as_dvec3();
            let now = PosedPair3 { pose_b: moved(&pair.pose_b, small, around), ..pair.clone() };
            if persistent.carry_on([&now.pose_a, &now.pose_b], &mut Vec::new()) {
                check(&persistent, &now, 0.01, &format!("{way}"));
                seen += 1;
            }
        }
        assert!(seen > 20, "{way}: {seen}");
    }
}

/// Another part of a compound may come within the margin.
#[test]
fn what_has_parts_is_not_kept() {
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap());
    let part = |place: [f64; 3]| (Pose3::at(place).unwrap(), cube.clone());
    let shape_a = Compound3::new([part([0.0; 3]), part([4.007, 0.0, 0.0])]).unwrap().into();
    // Between both parts: two edges are 3 mm from it, two others just outside the margin.
    let pair = |x: f64| PosedPair3 {
        shape_a: Shape3::clone(&shape_a),
        pose_a: Pose3::IDENTITY,
        shape_b: cube.clone(),
        pose_b: Pose3::at([x, 2.001, 0.3]).unwrap(),
    };
    let near = |x: f64| {
        let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = &pair(x);
        Pair3::new(shape_a, pose_a, shape_b, pose_b).manifolds(0.0041).len()
    };
    assert_eq!((near(2.003), near(2.003_1)), (1, 2));
    assert_eq!(kept(&pair(2.003), 0.0041), None);
}

/// The second axis is as good as the first, and gains on it with every step: the most that a footing can lose. B is
/// tilted by `lean` on A's top, with its deepest corners over A's rim: the depth along both face normals is equal, and
/// sliding along the slope changes one of them only.
#[test]
fn what_a_footing_may_lose_is_in_the_error() {
    let cuboid =
        |x: f32, y: f32, z: f32| Shape3::from(Cuboid::from_half_extents(Vec3::new(x, y, z)).unwrap());
    let (cube, beam) = (cuboid(1.0, 1.0, 1.0), cuboid(0.1, 1.0, 0.5));
    let cases = [
        // Four points on a wide face, four on a narrow one, two on an edge.
        (cube.clone(), DQuat::IDENTITY, 1.0 / 45.0),
        (beam, DQuat::IDENTITY, 1.0 / 60.0),
        (cube, DQuat::from_xyzw(0.382_683_432, 0.0, 0.0, 0.923_879_533).normalize(), 1.0 / 90.0),
    ];
    for (way, (shape, first, lean)) in cases.into_iter().enumerate() {
        let Shape3::Cuboid(cuboid) = &shape else { unreachable!("made a cuboid") };
        let half = cuboid.half_extents().as_dvec3();
        let turn = (DQuat::from_xyzw(0.0, -lean / 2.0, 0.0, 1.0).normalize() * first).as_quat();
        let corners = [[-1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, 1.0]];
        let at_origin = Pose3::new(DVec3::ZERO, turn).unwrap();
        let lowest = corners.map(|signs| at_origin.transform(half * DVec3::from_array(signs)));
        let lowest = lowest.into_iter().min_by(|a, b| a.z.total_cmp(&b.z)).unwrap();
        for (over, depth) in [(1e-7, 4e-3), (-1e-7, 4e-3), (0.0, 1e-3)] {
            let place = DVec3::new(over - half.x - lowest.x, 0.0, half.z - depth - lowest.z);
            let pair = PosedPair3 {
                shape_a: shape.clone(),
                pose_a: Pose3::IDENTITY,
                shape_b: shape.clone(),
                pose_b: Pose3::new(place, turn).unwrap(),
            };
            let persistent = kept(&pair, 0.2).expect("it is deep enough");
            let reach = f64::from(persistent.reach());
            assert!(reach > 5e-4, "{way}: a footing");
            let mut seen = 0;
            for (share, side) in [(0.99, 1.0), (0.99, -1.0), (0.6, 1.0), (0.6, -1.0), (0.3, 1.0), (0.3, -1.0)]
            {
                let now = PosedPair3 {
                    pose_b: Pose3::new(place + DVec3::X * (reach * share * side), turn).unwrap(),
                    ..pair.clone()
                };
                if persistent.carry_on([&now.pose_a, &now.pose_b], &mut Vec::new()) {
                    check(&persistent, &now, 0.2, &format!("{way} {over} {share} {side}"));
                    seen += 1;
                }
            }
            assert!(seen >= 2, "{way} {over}: {seen}");
        }
    }
}

/// Two plates half way through each other may leave by either side, and what sinks on one side rises on the other.
#[test]
fn plates_through_each_other_have_no_footing() {
    let plate = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 1.0, 1e-3)).unwrap());
    let at = |z: f64| PosedPair3 {
        shape_a: plate.clone(),
        pose_a: Pose3::IDENTITY,
        shape_b: plate.clone(),
        pose_b: Pose3::at([0.0, 0.0, z]).unwrap(),
    };
    let persistent = kept(&at(1e-7), 0.01).expect("it is deep enough");
    let most = f64::from(Persistent3::most_reach(&job(&at(1e-7), 0.01)));
    let mut seen = 0;
    for share in [0.9, 0.5, 0.2, 0.02, 0.01] {
        let now = at(1e-7 - most * share);
        if persistent.carry_on([&now.pose_a, &now.pose_b], &mut Vec::new()) {
            check(&persistent, &now, 0.01, &format!("{share}"));
            seen += 1;
        }
    }
    assert!(seen > 0);
}

/// Points lose at most a thirtieth of a narrow patch.
#[test]
fn a_footing_reaches_a_64th_of_what_is_under_it() {
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap());
    let rim = PosedPair3 {
        shape_a: cube.clone(),
        pose_a: Pose3::IDENTITY,
        shape_b: cube,
        pose_b: Pose3::at([1.98, 0.0, 2.0 - 1e-4]).unwrap(),
    };
    let reach = f64::from(kept(&rim, 0.2).expect("it is deep enough").reach());
    assert!(reach <= 0.02 / 64.0 && reach > 3.0_f64.sqrt() / 32_768.0);
}

#[test]
fn what_is_moved_along_is_true_in_the_plane() {
    let mut random = Random::new(72);
    let (mut carried, mut refused) = (0, 0);
    for kind in [PlaneKind::Rect, PlaneKind::Poly8, PlaneKind::Poly64] {
        for set in SETS {
            for pair in pairs2(kind, set, 120, 6) {
                let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = &pair;
                let size = f64::from(shape_a.outer_radius() + shape_b.outer_radius());
                let margin = (0.02 * size) as f32;
                let job = Job2 {
                    shape_a,
                    pose_a,
                    shape_b,
                    pose_b,
                    margin,
                    hint: Hint::NONE,
                    ahead: 0.0,
                    sensor: false,
                };
                let mut batch = Batch2::default();
                collide2(&[job], &mut batch);
                let Some(persistent) = Persistent2::of(&job, &batch.answers[0], &batch.manifolds) else {
                    continue;
                };
                for round in 0..6_usize {
                    let angle = if round < 3 { 0.0 } else { random.range(-1.0, 1.0) };
                    // A rotation, by the tangent of half its angle.
                    let (cos, sin) =
                        ((1.0 - angle * angle) / (1.0 + angle * angle), 2.0 * angle / (1.0 + angle * angle));
                    let turn = |v: DVec2| DVec2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y);
                    let step = random.direction().truncate() * [1e-5, 2e-4, 1e-3][round % 3] * size;
                    let turned = |pose: &Pose2, extra: DVec2| {
                        let middle = pose_a.position();
                        let facing =
                            turn(DVec2::new(pose.rotation().cos().into(), pose.rotation().sin().into()));
                        let rotation = Rotation2::new(facing.x as f32, facing.y as f32).unwrap();
                        let rotation = if angle == 0.0 { pose.rotation() } else { rotation };
                        Pose2::new(middle + turn(pose.position() - middle) + extra, rotation).unwrap()
                    };
                    let (now_a, now_b) = (turned(pose_a, DVec2::ZERO), turned(pose_b, step));
                    let mut found = Vec::new();
                    if !persistent.carry_on([&now_a, &now_b], &mut found) {
                        refused += 1;
                        continue;
                    }
                    carried += 1;
                    let manifold = &found[0];
                    let overlaps = Pair2::new(shape_a, &now_a, shape_b, &now_b).overlaps();
                    assert_eq!(persistent.overlapping(), overlaps, "{manifold:?}");
                    let truth = separation2((shape_a, &now_a), (shape_b, &now_b));
                    let off = (f64::from(manifold.separation) - truth.separation).abs();
                    assert!(off <= f64::from(manifold.error) + truth.bound, "off by {off}, {manifold:?}");
                    assert!(f64::from(manifold.error) <= PROMISED * size, "{manifold:?}");
                    let apart = along2((shape_a, &now_a), (shape_b, &now_b), manifold.normal);
                    let shown = f64::from(manifold.separation - manifold.error) - 2e-6 * size;
                    assert!(apart >= shown, "{apart} along the normal, {manifold:?}");
                    let offset = now_b.position() - now_a.position();
                    for point in &manifold.points {
                        let apart = offset + point.anchor_b.as_dvec2() - point.anchor_a.as_dvec2();
                        let straight = manifold.normal.as_dvec2() * f64::from(point.separation);
                        assert!((apart - straight).length() <= 1e-6 * size, "{point:?}");
                    }
                }
            }
        }
    }
    assert!(carried > 1000 && refused > 300, "{carried} carried, {refused} refused");
}
