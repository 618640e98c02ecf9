//! Properties of lattice shapes, where a failing case is shrunk to a small one.

use crate::shapes::Judged;
use asunder_geometry::{Capsule3, Hull, Pose3, Segment3, Shape3, Sphere, Triangle3};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::Bodies3;
use asunder_tests::cases::Case3;
use glam::{Quat, Vec3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn place() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-3_i8..=3).prop_map(|at| Vec3::from_array(at.map(f32::from)))
}

/// The simplest sharp shape that the points span.
fn spanned(points: &[Vec3]) -> Option<Shape3> {
    match *points {
        [from, to] => Some(Segment3::new(from, to).ok()?.into()),
        [a, b, c] => Some(Triangle3::new(a, b, c).ok()?.into()),
        _ => Some(Hull::of_any_dimension(points).ok()?.into()),
    }
}

fn sharp() -> impl Strategy<Value = Shape3> {
    prop::collection::vec(place(), 2..7).prop_filter_map("no shape", |points| spanned(&points))
}

fn any_kind() -> impl Strategy<Value = Shape3> {
    let rounded =
        (prop::collection::vec(place(), 1..6), 1_u8..4).prop_filter_map("no shape", |(points, radius)| {
            let hull = Hull::of_any_dimension(&points).ok()?;
            Some(hull.rounded(f32::from(radius) / 2.0).ok()?.into())
        });
    let capsule = (place(), place(), 1_u8..4).prop_filter_map("no capsule", |(from, to, radius)| {
        Some(Capsule3::new(from, to, f32::from(radius) / 2.0).ok()?.into())
    });
    let ball = (1_u8..4).prop_map(|radius| Sphere::new(f32::from(radius) / 2.0).unwrap().into());
    prop_oneof![2 => sharp(), 1 => rounded, 1 => capsule, 1 => ball]
}

/// No rotation, quarter turns, and one that is neither.
fn turn() -> impl Strategy<Value = Quat> {
    let q = |x: f32, y: f32, z: f32, w: f32| Just(Quat::from_xyzw(x, y, z, w));
    prop_oneof![q(0.0, 0.0, 0.0, 1.0), q(1.0, 0.0, 0.0, 1.0), q(0.0, 0.0, 1.0, -1.0), q(1.0, 2.0, -1.0, 3.0)]
}

proptest! {
    // The seed is fixed: a failure must fail everywhere. For a wider search use PROPTEST_CASES and another seed.
    #![proptest_config(ProptestConfig {
        cases: 3000,
        rng_seed: RngSeed::Fixed(0x0A5D),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn sharp_shapes_of_any_dimension_are_decided_exactly(shape_a in sharp(), shape_b in sharp(), at in place()) {
        let pose_b = Pose3::at(at).unwrap();
        let bodies = Bodies3::new(Case3 { shape_a, pose_a: Pose3::IDENTITY, shape_b, pose_b });
        prop_assert_eq!(bodies.overlaps(), bodies.exactly_overlaps());
    }

    #[test]
    fn any_two_shapes_are_judged_right(a in any_kind(), b in any_kind(), at in place(), turns in [turn(), turn()]) {
        let pose_a = Pose3::new(Vec3::ZERO, turns[0]).unwrap();
        let pose_b = Pose3::new(at, turns[1]).unwrap();
        let bodies = Bodies3::new(Case3 { shape_a: a, pose_a, shape_b: b, pose_b });
        let truth = bodies.true_separation();
        let judged = Judged { asked: &bodies, truth, size: bodies.size(), reach: bodies.reach() };
        judged.check_separations();
        judged.check_manifold(0.0, 4);
        judged.check_manifold(0.25, 4);
        judged.check_swapped();
    }
}
