//! Manifolds: points on both shapes, on one normal, with the pair's separation; and their feature ids.

mod faces;
mod frames;
mod names;
mod trembling;

use asunder_geometry::tolerance::EVEN_DEPTH;
use asunder_geometry::{Cuboid, Hull, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use asunder_narrow::{ContactPoint3, Pair2, Pair3};
use asunder_tests::answers::{Asked, Asked2, Asked3, Manifold};
use asunder_tests::cases::{Case2, Case3, Random, prism};
use glam::{DVec2, Quat, Vec2, Vec3};
use std::collections::BTreeSet;

/// A point may be off its shape by this share of the pair's size: faces count as flat within a few 2.5e-7, a face is
/// preferred to another axis within 5e-7, and anchors are f32.
const ON_SHAPE: f64 = 2e-6;

/// Checks everything about a manifold that was requested with `margin`.
fn check_manifold(asked: &impl Asked, manifold: &Manifold, margin: f64) {
    let size = asked.size();
    let truth = asked.true_separation();
    let Manifold { measured, contacts } = manifold;
    let slack = ON_SHAPE * size;
    assert!(
        (measured.separation - truth).abs() <= measured.error + 2e-14 * size,
        "{measured:?}, true {truth}"
    );
    assert!((measured.normal_length - 1.0).abs() <= 2e-7, "{measured:?}");
    assert!(
        measured.gap_along_normal >= truth - slack,
        "the normal shows {measured:?}, true {truth}: {asked:?}"
    );
    assert!(!contacts.is_empty(), "a contact without a point: {asked:?}");

    let features: Vec<u64> = contacts.iter().map(|contact| contact.feature).collect();
    assert!(features.is_sorted_by(|a, b| a < b), "distinct, in order: {features:?} of {asked:?}");
    for contact in contacts {
        let points = contact.points;
        let on_shapes = points.beyond_a <= slack && points.beyond_b <= slack;
        assert!(on_shapes, "points on the shapes: {contact:?}, true {truth}, of {asked:?}");
        assert!((points.along_normal - contact.separation).abs() <= slack, "{contact:?} of {asked:?}");
        assert!(points.across_normal <= slack, "one point above the other: {contact:?} of {asked:?}");
        assert!(contact.separation <= margin.max(0.0) + slack, "beyond {margin}: {contact:?} of {asked:?}");
    }
    let least = contacts.iter().map(|contact| contact.separation).fold(f64::INFINITY, f64::min);
    // Four points chosen from more corners include one that counts as deepest, within a share of the smaller shape's
    // diameter, which is at most the pair's size.
    let even = if contacts.len() == 4 { EVEN_DEPTH * size } else { 0.0 };
    let beyond = least - measured.separation;
    assert!((-slack..=slack + even).contains(&beyond), "deepest {least}, {measured:?}: {asked:?}");
}

/// Checks the manifolds without a margin and with one; returns the number of points without.
fn check(asked: &impl Asked, margin_share: f64) -> usize {
    let (size, truth) = (asked.size(), asked.true_separation());
    let touching = asked.manifold(0.0);
    assert_eq!(
        touching.is_some(),
        asked.overlaps(),
        "without a margin, exactly when they overlap: {asked:?}"
    );
    if let Some(manifold) = &touching {
        check_manifold(asked, manifold, 0.0);
    }
    let margin = (margin_share * size) as f32;
    let near = asked.manifold(margin);
    // Within the reported error of the margin either answer is allowed.
    if (truth - f64::from(margin)).abs() > 4e-6 * size {
        assert_eq!(near.is_some(), truth < f64::from(margin), "margin {margin}, true {truth}: {asked:?}");
    }
    if let Some(manifold) = &near {
        check_manifold(asked, manifold, margin.into());
    }
    touching.map_or(0, |manifold| manifold.contacts.len())
}

const MARGINS: [f64; 3] = [1e-3, 0.02, 0.2];
const GAPS: [f64; 10] = [0.15, 1e-2, 1e-3, 1e-5, 1e-7, -1e-9, -1e-7, -1e-5, -1e-3, -3e-2];

#[test]
fn random_solids() {
    let mut random = Random::new(300);
    let mut with_points = [0; 5];
    for round in 0..4000 {
        with_points[check(&Asked3::new(random.case3()), MARGINS[round % 3])] += 1;
    }
    assert!(with_points.iter().all(|&count| count > 50), "manifolds of every size: {with_points:?}");
}

#[test]
fn random_polygons() {
    let mut random = Random::new(301);
    let mut with_points = [0; 3];
    for round in 0..8000 {
        with_points[check(&Asked2::new(random.case2()), MARGINS[round % 3])] += 1;
    }
    assert!(with_points.iter().all(|&count| count > 100), "manifolds of every size: {with_points:?}");
}

#[test]
fn solids_that_almost_touch() {
    let mut random = Random::new(302);
    for round in 0..2000 {
        check(&Asked3::new(random.near_case3(GAPS[round % GAPS.len()])), MARGINS[round % 3]);
    }
}

#[test]
fn polygons_that_almost_touch() {
    let mut random = Random::new(303);
    for round in 0..5000 {
        check(&Asked2::new(random.near_case2(GAPS[round % GAPS.len()])), MARGINS[round % 3]);
    }
}

/// A wide floor with its top at y = 0.
fn floor() -> Shape3 {
    Cuboid::from_half_extents(Vec3::new(50.0, 0.5, 50.0)).unwrap().into()
}

fn resting(shape_b: &Shape3, height: f64, at: DVec2, rotation: Quat) -> Asked3 {
    Asked3::new(Case3 {
        shape_a: floor(),
        pose_a: Pose3::at([0.0, -0.5, 0.0]).unwrap(),
        shape_b: shape_b.clone(),
        pose_b: Pose3::new([at.x, height, at.y], rotation).unwrap(),
    })
}

fn pair3(case: &Case3) -> Pair3<'_> {
    Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b)
}

fn features(manifold: &Manifold) -> BTreeSet<u64> {
    manifold.contacts.iter().map(|contact| contact.feature).collect()
}

#[test]
fn a_resting_box_stands_on_four_points_whose_names_stay() {
    let mut random = Random::new(304);
    let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap());
    for _ in 0..100 {
        let at = random.vector().truncate() * 40.0;
        let turn = random.direction2().as_vec2();
        let upright = Quat::from_xyzw(0.0, turn.y, 0.0, turn.x);
        // Sunk in a little deeper than the motion below, as bodies rest in a game.
        let rest = resting(&crate_, 0.499, at, upright).manifold(0.0).unwrap();
        assert_eq!(rest.contacts.len(), 4);
        for _ in 0..20 {
            let step = random.vector() * 1e-5;
            let tilt = (random.vector() * 1e-5).as_vec3();
            let tilted = Quat::from_xyzw(tilt.x, turn.y + tilt.y, tilt.z, turn.x);
            let moved = resting(&crate_, 0.499 + step.y, at + DVec2::new(step.x, step.z), tilted);
            assert_eq!(features(&moved.manifold(0.0).unwrap()), features(&rest), "a name changed: {moved:?}");
        }
    }
}

#[test]
fn a_resting_rectangle_stands_on_two_points_whose_names_stay() {
    let mut random = Random::new(305);
    let floor = Shape2::from(Rect::from_half_extents(Vec2::new(50.0, 0.5)).unwrap());
    let crate_ = Shape2::from(Polygon::new(&[-Vec2::ONE, Vec2::new(1.0, -1.0), Vec2::Y]).unwrap());
    let resting = |at: DVec2, sine: f32| {
        Asked2::new(Case2 {
            shape_a: floor.clone(),
            pose_a: Pose2::at([0.0, -0.5]).unwrap(),
            shape_b: crate_.clone(),
            pose_b: Pose2::new(at, Rotation2::new(1.0, sine).unwrap()).unwrap(),
        })
    };
    for _ in 0..200 {
        let at = DVec2::new(random.signed() * 40.0, 0.999);
        let rest = resting(at, 0.0).manifold(0.0).unwrap();
        assert_eq!(rest.contacts.len(), 2);
        let step = DVec2::new(random.signed(), random.signed()) * 1e-5;
        let moved = resting(at + step, random.signed() as f32 * 1e-5);
        assert_eq!(features(&moved.manifold(0.0).unwrap()), features(&rest), "a name changed: {moved:?}");
    }
}

/// A box that hangs over another's edge stands on the rectangle that the two share, sunk in or slightly above it.
#[test]
fn an_overhanging_box_stands_on_what_both_share() {
    let mut random = Random::new(306);
    let under = Vec3::new(1.0, 0.5, 1.0);
    for _ in 0..500 {
        let half = Vec3::new(random.between(0.2, 1.5) as f32, 0.5, random.between(0.2, 1.5) as f32);
        let aside = random.vector() * (under + half).as_dvec3() * 0.9;
        let sunk = random.pick(&[0.02, 1e-4, -1e-4, -0.01]);
        let shapes = [under, half].map(|half| Shape3::from(Cuboid::from_half_extents(half).unwrap()));
        let pose = Pose3::at([aside.x, 1.0 - sunk, aside.z]).unwrap();
        let manifold = Pair3::new(&shapes[0], &Pose3::IDENTITY, &shapes[1], &pose).manifold(0.015).unwrap();
        let common = |axis: usize| {
            let (under, half) = (f64::from(under[axis]), f64::from(half[axis]));
            [(-under).max(aside[axis] - half), under.min(aside[axis] + half)]
        };
        let expected = common(0).map(|x| common(2).map(|z| DVec2::new(x, z))).concat();
        assert_eq!(manifold.points.len(), 4, "{manifold:?}");
        for corner in expected {
            let is_corner = |point: &ContactPoint3| {
                let at = point.anchor_a.as_dvec3();
                (DVec2::new(at.x, at.z) - corner).length() < 1e-6
            };
            let found: Vec<_> = manifold.points.iter().filter(|point| is_corner(point)).collect();
            assert_eq!(found.len(), 1, "one point at {corner}: {manifold:?}");
            assert!((f64::from(found[0].separation) + sunk).abs() < 1e-6, "{manifold:?}");
        }
    }
}

#[test]
fn an_overhanging_rectangle_stands_on_what_both_share() {
    let mut random = Random::new(307);
    for _ in 0..500 {
        let half = Vec2::new(random.between(0.2, 1.5) as f32, 0.5);
        let aside = random.signed() * (1.0 + f64::from(half.x)) * 0.9;
        let sunk = random.pick(&[0.02, 1e-4, -1e-4, -0.01]);
        let under = Shape2::from(Rect::from_half_extents(Vec2::new(1.0, 0.5)).unwrap());
        let over = Shape2::from(Rect::from_half_extents(half).unwrap());
        let pose = Pose2::at([aside, 1.0 - sunk]).unwrap();
        let manifold = Pair2::new(&under, &Pose2::IDENTITY, &over, &pose).manifold(0.015).unwrap();
        let mut found: Vec<f64> = manifold.points.iter().map(|point| point.anchor_a.x.into()).collect();
        found.sort_by(f64::total_cmp);
        let expected = [(-1.0_f64).max(aside - f64::from(half.x)), 1.0_f64.min(aside + f64::from(half.x))];
        assert_eq!(found.len(), 2, "{manifold:?}");
        assert!(found.iter().zip(expected).all(|(x, end)| (x - end).abs() < 1e-6), "{found:?}, {expected:?}");
    }
}

/// A post of seven sides on a floor touches it with seven corners. The four that are kept span most of their area, and
/// include the deepest. Seven, because with eight the corner opposite the shallowest would always be the deepest.
#[test]
fn four_of_seven_points_hold_a_post() {
    let outline = [(2, 1), (1, 2), (-1, 2), (-2, 1), (-2, -1), (-1, -2), (1, -2)];
    let points: Vec<Vec3> = outline
        .iter()
        .flat_map(|&(x, z)| [-1.0, 1.0].map(|y| Vec3::new(x as f32 * 0.25, y, z as f32 * 0.25)))
        .collect();
    let post = Shape3::from(Hull::from_points(&points).unwrap());
    let area_of_all = 13.0 / 16.0;
    let mut random = Random::new(308);
    for _ in 0..300 {
        let tilt = (random.vector() * 5e-3).as_vec3();
        let turn = random.direction2().as_vec2();
        let rotation = Quat::from_xyzw(tilt.x, turn.y, tilt.z, turn.x);
        // Sunk in by 0.02, and tilted by no more than 0.015 over half a metre: all seven corners are below the floor.
        let asked = resting(&post, 0.98, random.vector().truncate() * 40.0, rotation);
        let manifold = asked.manifold(0.0).unwrap();
        check_manifold(&asked, &manifold, 0.0);
        assert_eq!(manifold.contacts.len(), 4);
        let Case3 { shape_a, pose_a, shape_b, pose_b } = asked.case();
        let found = Pair3::new(shape_a, pose_a, shape_b, pose_b).manifold(0.0).unwrap();
        let mut corners: Vec<DVec2> =
            found.points.iter().map(|p| DVec2::new(p.anchor_b.x.into(), p.anchor_b.z.into())).collect();
        let middle = corners.iter().sum::<DVec2>() / 4.0;
        // Sorted around the middle: by half plane, then by slope.
        corners.sort_by(|&p, &q| {
            let (p, q) = (p - middle, q - middle);
            (p.y < 0.0).cmp(&(q.y < 0.0)).then(0.0_f64.total_cmp(&p.perp_dot(q)))
        });
        let doubled: f64 = (0..4).map(|i| corners[i].perp_dot(corners[(i + 1) % 4])).sum();
        // Four of these seven can span 10/13 of the area, three at most 6/13.
        assert!(doubled / 2.0 > 0.6 * area_of_all, "area {}: {found:?}", doubled / 2.0);
    }
}

/// Two equal crates, tilted by less than the face preference: the normal stays that of A's face, bit for bit.
#[test]
fn the_reference_face_does_not_flip_between_ties() {
    let mut random = Random::new(309);
    let crate_ = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap());
    for _ in 0..500 {
        let tilt = (random.vector() * 1e-7).as_vec3();
        let turn = random.direction2().as_vec2();
        let rotation = Quat::from_xyzw(tilt.x, turn.y, tilt.z, turn.x);
        let aside = random.vector() * 0.3;
        let pose = Pose3::new([aside.x, 0.99, aside.z], rotation).unwrap();
        let manifold = Pair3::new(&crate_, &Pose3::IDENTITY, &crate_, &pose).manifold(0.0).unwrap();
        assert_eq!(manifold.normal, Vec3::Y, "{manifold:?}");
    }
}

/// Symptom: a single contact point whose ends were 1.8 m apart, in an overlap of 18 micrometres. Cause: a prism's
/// parallel edges have the same cross products, and the first edge that gave the axis was taken for the one that
/// touches. Seen in about one in seventy of this suite's overlapping pairs.
#[test]
fn parallel_edges_share_an_axis_and_one_of_them_touches() {
    let wedge = |outline: [(f32, f32); 3], half: f32| prism(&outline.map(Vec2::from), half);
    let asked = Asked3::new(Case3 {
        shape_a: wedge(
            [(-0.5446574, -0.53803045), (0.23462094, -0.4649082), (0.5067642, 0.09905431)],
            0.743971,
        ),
        pose_a: Pose3::new(
            [-0.2792966209723575, -0.481607836589242, -0.7513771144461991],
            Quat::from_xyzw(0.4006483, 0.6878547, -0.31382495, 0.51754296),
        )
        .unwrap(),
        shape_b: wedge(
            [(-0.5887811, 0.1986272), (0.0335504, 0.70585024), (-0.34694788, 0.691066)],
            0.6662749,
        ),
        pose_b: Pose3::new(
            [-0.1507696756170081, 0.47384109650985, -1.033504941655284],
            Quat::from_xyzw(-0.44169447, -0.58987, 0.57461303, 0.35606086),
        )
        .unwrap(),
    });
    let manifold = asked.manifold(0.0).unwrap();
    check_manifold(&asked, &manifold, 0.0);
    assert_eq!(manifold.contacts.len(), 1, "two edges cross in one point: {manifold:?}");
}

/// Symptom: within a margin, a point of A 0.3 mm beside A. Cause: at the distance d, an axis whose separation is less
/// by p is tilted sideways by sqrt(2 d p), so that preferring a face by a hair is no longer a hair.
#[test]
fn a_corner_beside_a_side_is_not_above_it() {
    let asked = Asked2::new(Case2 {
        shape_a: Rect::from_half_extents(Vec2::ONE).unwrap().into(),
        pose_a: Pose2::IDENTITY,
        shape_b: Polygon::new(&[Vec2::ZERO, Vec2::new(1.0, 0.5), Vec2::new(1.0, 2.0)]).unwrap().into(),
        pose_b: Pose2::at([1.0003, 1.2]).unwrap(),
    });
    check_manifold(&asked, &asked.manifold(0.5).unwrap(), 0.5);
}
