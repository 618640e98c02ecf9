//! Textbook examples, each with the reason for its answer.

use asunder_geometry::{Aabb2, Aabb3, Cuboid, Hull, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3};
use asunder_tests::answers::{Asked, Asked2, Asked3};
use asunder_tests::cases::{Case2, Case3, Random};
use asunder_tests::exhaustive_sat::{Axis, best_of_kind3, gap2, gap3};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

fn cuboid(half: Vec3) -> Shape3 {
    Cuboid::from_half_extents(half).unwrap().into()
}

fn cube(half: f32) -> Shape3 {
    cuboid(Vec3::splat(half))
}

fn case3(shape_a: &Shape3, pose_a: Pose3, shape_b: &Shape3, pose_b: Pose3) -> Asked3 {
    Asked3::new(Case3 { shape_a: shape_a.clone(), pose_a, shape_b: shape_b.clone(), pose_b })
}

fn separation(asked: &impl Asked) -> f64 {
    let measured = asked.separation(f32::INFINITY).unwrap();
    let truth = asked.true_separation();
    assert!(
        (measured.separation - truth).abs() <= measured.error + 2e-14 * asked.size(),
        "{measured:?}, {truth}"
    );
    measured.separation
}

/// Two boxes are apart exactly when one is left of, right of, below or above the other: each test alone can reject.
#[test]
fn four_way_elimination() {
    let middle = Aabb2::new(Vec2::ZERO, Vec2::ONE);
    for (dx, dy) in (-2_i32..=2).flat_map(|dx| (-2_i32..=2).map(move |dy| (dx, dy))) {
        let offset = Vec2::new(dx as f32, dy as f32) * 0.75;
        let other = Aabb2::new(middle.min + offset, middle.max + offset);
        let (left, right) = (other.max.x < middle.min.x, other.min.x > middle.max.x);
        let (below, above) = (other.max.y < middle.min.y, other.min.y > middle.max.y);
        assert_eq!(middle.overlaps(&other), !(left || right || below || above), "at {offset}");
        assert_eq!(middle.overlaps(&other), dx.abs() < 2 && dy.abs() < 2, "a step of 1.5 eliminates");
    }
    // In space there are two more directions.
    let middle = Aabb3::new(Vec3::ZERO, Vec3::ONE);
    for way in [Vec3::NEG_X, Vec3::X, Vec3::NEG_Y, Vec3::Y, Vec3::NEG_Z, Vec3::Z] {
        let moved = |by: f32| Aabb3::new(middle.min + way * by, middle.max + way * by);
        assert!(middle.overlaps(&moved(1.0)) && !middle.overlaps(&moved(1.0_f32.next_up())), "{way}");
    }
}

/// A square in front of a triangle's long side: along all other normals of the two they overlap.
#[test]
fn one_edge_normal_of_seven_separates() {
    let shape_a = Shape2::from(Rect::from_half_extents(Vec2::ONE).unwrap());
    let corners = [(3.3, -1.2), (3.3, 3.3), (-1.2, 3.3)].map(Vec2::from);
    let shape_b = Shape2::from(Polygon::new(&corners).unwrap());
    for turn in [Rotation2::IDENTITY, Rotation2::new(0.6, 0.8).unwrap(), Rotation2::new(-0.28, 0.96).unwrap()]
    {
        let pose = Pose2::new(DVec2::new(3.0, -7.0), turn).unwrap();
        let case = Case2 { shape_a: shape_a.clone(), pose_a: pose, shape_b: shape_b.clone(), pose_b: pose };
        let (a, b) = case.placed();
        let normal_of = |[from, to]: [DVec2; 2]| -(to - from).normalize().perp();
        let of_a = a.edges().map(|edge| gap2(&a, &b, normal_of(edge)));
        let of_b = b.edges().map(|edge| gap2(&a, &b, -normal_of(edge)));
        let separating: Vec<f64> = of_a.chain(of_b).filter(|&gap| gap > 0.0).collect();
        assert_eq!(separating.len(), 1, "the example itself: {separating:?}");
        let asked = Asked2::new(case);
        assert!(!asked.overlaps());
        // The long side lies on x + y = 2.1, the square's corner at x + y = 2.
        let along = 0.1 / 2_f64.sqrt();
        assert!((separation(&asked) - along).abs() < 1e-6 && (separating[0] - along).abs() < 1e-6);
    }
}

/// Testing along n or along any multiple of n gives the same answer: here the unscaled cross product against the unit
/// axis in the oracles, and quaternions of any length, which scale every axis, in the library.
#[test]
fn scaled_axes_give_equal_answers() {
    let mut random = Random::new(900);
    for _ in 0..500 {
        let asked = Asked3::new(random.case3());
        let (a, b) = asked.case().placed();
        let normal = random.direction();
        let gap = gap3(&a, &b, normal);
        for factor in [1e-9, 0.37, 5.0, 1e9] {
            let scaled = gap3(&a, &b, normal * factor);
            assert_eq!(scaled > 0.0, gap > 0.0, "one sign");
            assert!((scaled / factor - gap).abs() < 1e-13, "{scaled} / {factor}, {gap}");
        }
        let here = separation(&asked);
        for factor in [1e-20_f32, 0.37, 5.0, 1e18] {
            let longer = |pose: &Pose3| {
                let q = pose.rotation().to_array().map(|c| c * factor);
                Pose3::new(pose.position(), Quat::from_array(q)).unwrap()
            };
            let Case3 { shape_a, pose_a, shape_b, pose_b } = asked.case();
            let scaled = case3(shape_a, longer(pose_a), shape_b, longer(pose_b));
            // Each component of a scaled quaternion is rounded once more: 6e-8 of a turn, twice, at a metre or two.
            assert!((separation(&scaled) - here).abs() < 2e-6 * asked.size(), "{factor}: {asked:?}");
        }
    }
}

/// The quaternion of an eighth of a turn about an axis, by the tangent of a sixteenth: sqrt(2) - 1.
fn eighth_of_a_turn(axis: Vec3) -> Quat {
    Quat::from_vec4((axis * (2_f32.sqrt() - 1.0)).extend(1.0))
}

/// Two cubes, each standing on an edge, the edges crossing at a right angle: only their cross product separates them.
#[test]
fn crossing_edges_separate_where_no_face_does() {
    for (gap, apart) in [(1e-3, true), (1e-5, true), (-1e-5, false), (-1e-3, false)] {
        let height = 2.0 * 2_f64.sqrt() + gap;
        for shape in [cube(1.0), Hull::from_points(&corners(Vec3::ONE)).unwrap().into()] {
            let asked = case3(
                &shape,
                Pose3::new(DVec3::ZERO, eighth_of_a_turn(Vec3::X)).unwrap(),
                &shape,
                Pose3::new(DVec3::new(0.25, -0.125, height), eighth_of_a_turn(Vec3::Y)).unwrap(),
            );
            let (a, b) = asked.case().placed();
            let [of_a, of_b] = [Axis::OfA, Axis::OfB].map(|kind| best_of_kind3(&a, &b, kind).gap);
            assert!(of_a < -0.1 && of_b < -0.1, "the example itself: no face separates: {of_a} {of_b}");
            let edges = best_of_kind3(&a, &b, Axis::Edges);
            assert!((edges.gap - gap).abs() < 1e-6 && edges.normal.z > 0.999);
            assert_eq!(asked.overlaps(), !apart, "{gap}");
            assert!((separation(&asked) - gap).abs() < 1e-6);
            let manifold = asked.manifold(0.01).unwrap();
            assert_eq!(manifold.contacts.len(), 1, "two crossing edges meet in one point");
        }
    }
}

/// Two roofs ridge to ridge, the ridges crossing at a small angle in one point. No face separates them, since each
/// ridge's ends lie below the other's eaves; the cross product of the nearly parallel edges does, and must not be
/// discarded.
#[test]
fn ridges_that_cross_at_a_small_angle() {
    let roof = |eaves: f32| -> Shape3 {
        let end = |x: f32| [Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, eaves), Vec3::new(x, -1.0, eaves)];
        Hull::from_points(&[end(-1.0), end(1.0)].concat()).unwrap().into()
    };
    let (below, above) = (roof(-1.0), roof(1.0));
    for angle in [0.5_f32, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9, 1e-11] {
        for share in [0.3, 0.01, -0.01, -0.3] {
            let gap = share * f64::from(angle);
            let turn = Quat::from_xyzw(0.0, 0.0, angle / 2.0, 1.0);
            let pose_b = Pose3::new([0.0, 0.0, gap], turn).unwrap();
            let asked = case3(&below, Pose3::IDENTITY, &above, pose_b);
            let (a, b) = asked.case().placed();
            let [of_a, of_b] = [Axis::OfA, Axis::OfB].map(|kind| best_of_kind3(&a, &b, kind).gap);
            let across = best_of_kind3(&a, &b, Axis::Edges).gap;
            assert!(of_a < 0.0 && of_b < 0.0, "the example itself: no face separates: {of_a} {of_b}");
            // Below this angle the cross product of two edges rotated in f64 is mostly noise.
            assert!(
                angle < 1e-9 || (across - gap).abs() < 1e-3 * gap.abs(),
                "the example itself: {across}, {gap}"
            );
            // The library ignores axes of edges closer to parallel than 1e-8; its error accounts for that, its sign
            // need not.
            if angle >= 1e-7 {
                assert_eq!(asked.overlaps(), gap <= 0.0, "angle {angle}, gap {gap}");
            }
            separation(&asked);
        }
    }
}

/// A cuboid's corners as plain points.
fn corners(half: Vec3) -> Vec<Vec3> {
    let Shape3::Cuboid(cuboid) = cuboid(half) else { unreachable!("made a cuboid") };
    cuboid.vertices().to_vec()
}

/// The cross product of nearly parallel edges is mostly rounding. It must not fake a gap between boxes that overlap,
/// nor hide one between boxes apart.
#[test]
fn nearly_parallel_edges() {
    let mut random = Random::new(901);
    for angle in [1e-3_f32, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
        for _ in 0..40 {
            let half = [0; 6].map(|_| random.between(0.2, 1.0) as f32);
            let (half_a, half_b) = (Vec3::from_slice(&half[..3]), Vec3::from_slice(&half[3..]));
            let tilt = (random.direction().as_vec3() * (angle / 2.0)).extend(1.0);
            let along = random.pick(&[DVec3::X, DVec3::Y, DVec3::Z]);
            let touching = (half_a + half_b).as_dvec3().dot(along);
            let depth = random.pick(&[0.05, 1e-2, 1e-4, -1e-4, -1e-2]);
            let aside = random.vector() * 0.1 * (DVec3::ONE - along);
            let pose_b = Pose3::new(along * (touching - depth) + aside, Quat::from_vec4(tilt)).unwrap();
            // Cuboids have a kernel of their own, and so do hulls.
            for (a, b) in [
                (cuboid(half_a), cuboid(half_b)),
                (Hull::from_points(&corners(half_a)).unwrap().into(), cuboid(half_b)),
            ] {
                let asked = case3(&a, Pose3::IDENTITY, &b, pose_b);
                let truth = asked.true_separation();
                // A tilt lowers or lifts a corner by at most the angle times the reach.
                if depth.abs() > 2.0 * f64::from(angle) * asked.size() {
                    assert_eq!(truth < 0.0, depth > 0.0, "the example itself");
                }
                assert_eq!(asked.overlaps(), truth <= 0.0, "angle {angle}, depth {depth}: {asked:?}");
                separation(&asked);
            }
        }
    }
}

/// Coincident centres give no direction from A to B: the depth is still the side, along some axis.
#[test]
fn identical_cubes_in_one_pose_are_a_side_deep() {
    let mut random = Random::new(902);
    for _ in 0..100 {
        let pose = Pose3::new(random.vector() * 1e3, random.quaternion()).unwrap();
        for shape in [cube(0.5), Hull::from_points(&corners(Vec3::splat(0.5))).unwrap().into()] {
            let asked = case3(&shape, pose, &shape, pose);
            let measured = asked.separation(0.0).unwrap();
            assert!((measured.separation + 1.0).abs() <= measured.error, "{measured:?}");
            assert_eq!(asked.manifold(0.0).unwrap().contacts.len(), 4);
        }
        let square = Shape2::from(Rect::from_half_extents(Vec2::splat(0.5)).unwrap());
        let pose = Pose2::new(random.vector().truncate(), random.rotation2()).unwrap();
        let asked =
            Asked2::new(Case2 { shape_a: square.clone(), pose_a: pose, shape_b: square, pose_b: pose });
        let measured = asked.separation(0.0).unwrap();
        // In the plane the stored matrix may be longer than 1 by an f32 rounding.
        assert!((measured.separation + 1.0).abs() <= measured.error + 1e-7, "{measured:?}");
    }
}

/// Absolute tolerances swallow small bodies: a gap of a tenth of the size is a gap at every size.
#[test]
fn small_boxes_with_a_tenth_of_a_gap_are_apart() {
    let mut random = Random::new(903);
    for half in [1e-3_f32, 1e-5, 1e-6] {
        for _ in 0..50 {
            let turn = random.quaternion();
            let pose_a = Pose3::new(random.vector(), turn).unwrap();
            let gap = f64::from(half) * 0.2;
            let away = pose_a.basis().x * (2.0 * f64::from(half) + gap);
            let pose_b = Pose3::new(pose_a.position() + away, turn).unwrap();
            let asked = case3(&cube(half), pose_a, &cube(half), pose_b);
            assert!(!asked.overlaps());
            assert!((separation(&asked) - gap).abs() < 1e-5 * gap);
            assert!(asked.manifold(0.0).is_none());
        }
    }
}

/// Beams 128 times as long as thick, where the reach magnifies every error of a direction.
#[test]
fn beams_of_128_to_1() {
    let mut random = Random::new(904);
    let (mut apart, mut overlapping) = (0, 0);
    for _ in 0..600 {
        let long = |axis: usize| {
            let mut half = [0.05_f32; 3];
            half[axis] = 6.4;
            cuboid(Vec3::from_array(half))
        };
        let (shape_a, shape_b) = (long(random.below(3)), long(random.below(3)));
        let pose_a = Pose3::new(random.vector(), random.quaternion()).unwrap();
        let pose_b = Pose3::new(random.vector() * 0.3, random.quaternion()).unwrap();
        let asked = case3(&shape_a, pose_a, &shape_b, pose_b);
        let found = separation(&asked);
        *if found > 0.0 { &mut apart } else { &mut overlapping } += 1;
        assert_eq!(asked.overlaps(), asked.true_separation() <= 0.0);
    }
    assert!(apart > 100 && overlapping > 10, "{apart} apart, {overlapping} in overlap");
}

/// A floor of 500 m and a crate of one: the error is relative to the floor, and the crate still stands on it.
#[test]
fn a_crate_on_a_floor_of_500_metres() {
    let mut random = Random::new(905);
    let floor = cuboid(Vec3::new(250.0, 0.5, 250.0));
    for _ in 0..200 {
        let turn = random.direction2().as_vec2();
        let place = random.vector() * 249.0;
        let depth = random.pick(&[0.0, 1e-3, 0.02, -1e-3]);
        let pose_b =
            Pose3::new(DVec3::new(place.x, 1.0 - depth, place.z), Quat::from_xyzw(0.0, turn.x, 0.0, turn.y));
        let asked = case3(&floor, Pose3::IDENTITY, &cube(0.5), pose_b.unwrap());
        assert!((separation(&asked) + depth).abs() < 1e-6 * asked.size());
        if depth > 0.0 {
            assert!(asked.overlaps());
            let manifold = asked.manifold(0.0).unwrap();
            assert_eq!(manifold.contacts.len(), 4, "it stands on its four corners: {asked:?}");
            assert!(manifold.contacts.iter().all(|c| (c.separation + depth).abs() < 1e-6 * asked.size()));
        }
        if depth < 0.0 {
            assert!(!asked.overlaps() && asked.manifold(0.0).is_none());
        }
    }
}
