//! What persists from frame to frame, and speculative points.

use super::pair3;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, collide3};
use asunder_tests::cases::{Case3, Random};
use glam::{Quat, Vec3};

fn cuboid(half: Vec3) -> Shape3 {
    Cuboid::from_half_extents(half).unwrap().into()
}

/// One frame: returns the manifold, and the hint for the next.
pub(super) fn frame(case: &Case3, hint: Hint, margin: f32) -> (Manifold3, Hint) {
    let Case3 { shape_a, pose_a, shape_b, pose_b } = case;
    let mut batch = Batch3::default();
    collide3(
        &[Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor: false }],
        &mut batch,
    );
    let Answer::Contact { hint, .. } = batch.answers[0] else { panic!("a contact: {case:?}") };
    (batch.manifolds[0], hint)
}

/// A wide box on a small one, tilted so that its own face is the better axis by this many face preferences: along the
/// small one's normal the depth is that of the wide box's lower corner, along its own that of the small one's higher
/// corner only.
fn tilted(preferences: f64) -> Case3 {
    let (under, over) = (Vec3::new(0.25, 0.5, 0.25), Vec3::new(1.0, 0.5, 0.25));
    let preference = FACE_PREFERENCE * 2.0 * under.as_dvec3().length();
    let sine = preferences * preference / f64::from(over.x - under.x);
    Case3 {
        shape_a: cuboid(under),
        pose_a: Pose3::IDENTITY,
        shape_b: cuboid(over),
        pose_b: Pose3::new([0.0, 0.99, 0.0], Quat::from_xyzw(0.0, 0.0, (sine / 2.0) as f32, 1.0)).unwrap(),
    }
}

/// With a hint, the reference face keeps its role until another beats it by two preferences, in both directions;
/// without one, by one preference.
#[test]
fn the_reference_face_keeps_its_role_until_beaten_by_two_preferences() {
    let is_of_a = |manifold: &Manifold3| manifold.normal == Vec3::Y;
    let mut hint = Hint::NONE;
    for preferences in [0.0, 0.5, 1.5, 0.9, 1.9] {
        let case = tilted(preferences);
        let (manifold, next) = frame(&case, hint, 0.0);
        hint = next;
        assert!(is_of_a(&manifold), "{preferences}: {manifold:?}");
        let alone = pair3(&case).manifold(0.0).unwrap();
        assert_eq!(is_of_a(&alone), preferences < 1.0, "without a memory, at {preferences}: {alone:?}");
        assert_eq!(manifold.separation, alone.separation, "the number does not depend on the memory");
    }
    // Beyond two, the face of B takes over; it stays, since A's never beats it by two.
    for preferences in [2.1, 1.5, 0.5, 0.1] {
        let (manifold, next) = frame(&tilted(preferences), hint, 0.0);
        hint = next;
        assert!(!is_of_a(&manifold), "{preferences}: {manifold:?}");
    }
}

/// A hint of features that these shapes do not have, or that are far from the best, changes nothing.
#[test]
fn a_stale_memory_moves_no_point() {
    let mut random = Random::new(330);
    let mut hints = Vec::new();
    for _ in 0..300 {
        let case = random.case3();
        if pair3(&case).overlaps() {
            hints.push(frame(&case, Hint::NONE, 0.0).1);
        }
    }
    assert!(hints.len() > 50);
    for _ in 0..2000 {
        let case = random.case3();
        if let Some(alone) = pair3(&case).manifold(0.0) {
            let (manifold, _) = frame(&case, random.pick(&hints), 0.0);
            assert_eq!(manifold.points, alone.points, "{case:?}");
        }
    }
}

/// A solver's body trembles on what it rests on. Over sixty frames now one face is the better axis and now the other,
/// by up to two preferences: with hints the reference face stays, and so does every feature id.
#[test]
fn names_and_the_reference_stay_while_a_resting_body_trembles() {
    let mut random = Random::new(331);
    let (shape_a, shape_b) = (cuboid(Vec3::splat(0.25)), cuboid(Vec3::new(0.9, 0.5, 0.9)));
    let mut flips_without = 0;
    for _ in 0..20 {
        let turn = random.direction2().as_vec2();
        let aside = random.vector() * 0.1;
        let mut tremble = || {
            // Along A's normal the depth is that of B's lower corner, 1.27 aside; along B's normal that of A's, at
            // least 0.25 aside. At a slope of up to 7.1e-7 the difference is 1.7 preferences.
            let tilt = (random.vector() * 2.5e-7).as_vec3();
            let step = random.vector() * 1e-6;
            let rotation = Quat::from_xyzw(tilt.x, turn.y + tilt.y, tilt.z, turn.x);
            let position = [aside.x + step.x, 0.748 + step.y, aside.z + step.z];
            let pose_b = Pose3::new(position, rotation).unwrap();
            Case3 { shape_a: shape_a.clone(), pose_a: Pose3::IDENTITY, shape_b: shape_b.clone(), pose_b }
        };
        let names =
            |manifold: &Manifold3| manifold.points.iter().map(|point| point.feature).collect::<Vec<_>>();
        let is_of_a = |manifold: &Manifold3| manifold.normal == Vec3::Y;
        let (first, mut hint) = frame(&tremble(), Hint::NONE, 0.01);
        for _ in 0..60 {
            let case = tremble();
            let (manifold, next) = frame(&case, hint, 0.01);
            hint = next;
            assert_eq!(names(&manifold), names(&first), "a name changed: {case:?}");
            assert_eq!(is_of_a(&manifold), is_of_a(&first), "the reference flips: {case:?}");
            flips_without += usize::from(is_of_a(&pair3(&case).manifold(0.01).unwrap()) != is_of_a(&first));
        }
    }
    assert!(
        flips_without > 100,
        "only {flips_without} of 1200 would flip without the memory: nothing to see"
    );
}

/// Over a floor, a tilted box has one point for every lower corner within the margin, at that corner's height, and no
/// others.
#[test]
fn points_ahead_of_contact_are_the_corners_within_the_margin() {
    let mut random = Random::new(332);
    let (floor, half) = (cuboid(Vec3::new(50.0, 0.5, 50.0)), Vec3::new(0.5, 0.4, 0.3));
    let crate_ = cuboid(half);
    let mut counts = [0; 5];
    for _ in 0..1000 {
        let tilt = (random.vector() * 0.02).as_vec3();
        let turn = random.direction2().as_vec2();
        let rotation = Quat::from_xyzw(tilt.x, turn.y, tilt.z, turn.x);
        let upright = Pose3::new([0.0; 3], rotation).unwrap();
        let corners = [-1.0, 1.0].map(|x| [-1.0, 1.0].map(|z| Vec3::new(x, -1.0, z) * half)).concat();
        let heights: Vec<f64> = corners.iter().map(|c| upright.basis().turn(c.as_dvec3()).y).collect();
        let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let (gap, margin) = (random.between(1e-4, 5e-3), 0.02_f32);
        let lift = gap - lowest;
        let case = Case3 {
            shape_a: floor.clone(),
            pose_a: Pose3::at([0.0, -0.5, 0.0]).unwrap(),
            shape_b: crate_.clone(),
            pose_b: Pose3::new([0.0, lift, 0.0], rotation).unwrap(),
        };
        let mut expected: Vec<f64> = heights.iter().map(|height| height + lift).collect();
        expected.retain(|&height| height <= f64::from(margin));
        if heights.iter().any(|height| (height + lift - f64::from(margin)).abs() < 1e-5) {
            continue;
        }
        let manifold = pair3(&case).manifold(margin).unwrap();
        let mut found: Vec<f64> = manifold.points.iter().map(|point| point.separation.into()).collect();
        found.sort_by(f64::total_cmp);
        expected.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len(), "{found:?}, expected {expected:?}: {case:?}");
        let are_alike = found.iter().zip(&expected).all(|(one, other)| (one - other).abs() < 1e-6);
        assert!(are_alike, "{found:?}, expected {expected:?}: {case:?}");
        assert!(pair3(&case).manifold((gap * 0.9) as f32).is_none(), "the margin is all there is: {case:?}");
        counts[found.len()] += 1;
    }
    assert!(counts[1] > 50 && counts[2] > 50 && counts[4] > 50, "all kinds: {counts:?}");
}
