//! The double-double oracle: against the exact one, the exhaustive ones, and separations known beforehand.

use asunder_geometry::{
    Capsule3, Compound3, Cuboid, HalfSpace, Pose2, Pose3, Rect, Rotation2, Segment3, Shape2, Shape3, Sphere,
    Triangle3,
};
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::{
    Relation, exact_overlap2, exact_overlap3, exact_relation2, exact_relation3,
};
use asunder_tests::precise::{Precise, along2, along3, separation2, separation3, separations3};
use asunder_tests::shapes::{KINDS2, KINDS3, PLACES, pair2, pair3};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// Whether a separation's sign agrees with a relation, as far as the separation is known.
fn agree<V>(precise: &Precise<V>, relation: Relation) -> bool {
    match relation {
        Relation::Apart => precise.separation >= -precise.bound,
        Relation::Touching => precise.separation.abs() <= precise.bound,
        Relation::Overlapping => precise.separation <= precise.bound,
    }
}

/// The size of a pair; unbounded shapes add nothing.
fn size(radii: [f32; 2]) -> f64 {
    radii.iter().filter(|radius| radius.is_finite()).map(|&radius| f64::from(radius)).sum()
}

/// Every kind of shape with every other in every kind of relative pose.
#[test]
fn the_sign_of_a_separation_is_the_exact_relation() {
    let mut random = Random::new(920);
    let mut seen = [0; 3];
    for round in 0..2 * PLACES {
        for a in &KINDS3 {
            for b in &KINDS3 {
                // Two half-spaces have no gap that they could be moved to.
                if a.0.starts_with("half") && b.0.starts_with("half") {
                    continue;
                }
                let bodies = pair3(&mut random, a, b, round);
                let case = bodies.case();
                let pair = ((&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b));
                let (precise, relation) = (separation3(pair.0, pair.1), exact_relation3(pair.0, pair.1));
                assert!(agree(&precise, relation), "{} {} {round}: {precise:?} {relation:?}", a.0, b.0);
                assert_eq!(
                    exact_overlap3(pair.0, pair.1),
                    relation != Relation::Apart,
                    "{} {} {round}",
                    a.0,
                    b.0
                );
                seen[relation as usize] += 1;
                let size = size([case.shape_a.outer_radius(), case.shape_b.outer_radius()]);
                let last_place =
                    if precise.separation.is_finite() { precise.separation.abs() * 3e-16 } else { 0.0 };
                // Half-spaces have no size, and far out nothing is known better than the position.
                let reach = size.max(1e-12 * bodies.reach()) + last_place * 1e12;
                assert!(precise.bound <= 1e-12 * reach, "{} {} {round}: {precise:?} {size}", a.0, b.0);
                // The same by brute force, within the rounding of f64.
                let truth = bodies.truth().separation;
                assert!(
                    truth == precise.separation
                        || (truth - precise.separation).abs() <= 1e-12 * bodies.reach(),
                    "{} {} {round}: {truth} {precise:?}",
                    a.0,
                    b.0
                );
            }
        }
    }
    assert!(seen[0] > 500 && seen[1] > 5 && seen[2] > 500, "{seen:?}");
}

#[test]
fn the_sign_of_a_separation_in_the_plane_is_the_exact_relation() {
    let mut random = Random::new(921);
    let mut seen = [0; 3];
    for round in 0..3 * PLACES {
        for a in &KINDS2 {
            for b in &KINDS2 {
                // Two half-planes have no gap that they could be moved to.
                if a.0.starts_with("half") && b.0.starts_with("half") {
                    continue;
                }
                let bodies = pair2(&mut random, a, b, round);
                let case = bodies.case();
                let pair = ((&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b));
                let (precise, relation) = (separation2(pair.0, pair.1), exact_relation2(pair.0, pair.1));
                assert!(agree(&precise, relation), "{} {} {round}: {precise:?} {relation:?}", a.0, b.0);
                assert_eq!(
                    exact_overlap2(pair.0, pair.1),
                    relation != Relation::Apart,
                    "{} {} {round}",
                    a.0,
                    b.0
                );
                seen[relation as usize] += 1;
                let truth = bodies.truth().separation;
                assert!(
                    truth == precise.separation
                        || (truth - precise.separation).abs() <= 1e-12 * bodies.reach(),
                    "{} {} {round}: {truth} {precise:?}",
                    a.0,
                    b.0
                );
            }
        }
    }
    assert!(seen[0] > 500 && seen[1] > 5 && seen[2] > 500, "{seen:?}");
}

#[test]
fn exhaustive_judges_agree_within_their_rounding() {
    let mut random = Random::new(922);
    for round in 0..600 {
        let gap = random.pick(&[0.0, 1e-3, -1e-3, 1e-7, -1e-7, 1e-11, -1e-11]);
        let case = if round % 3 == 0 { random.case3() } else { random.near_case3(gap) };
        let [a, b] = [(&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b)];
        let precise = separation3(a, b);
        let truth = case.truth();
        assert!((precise.separation - truth.separation).abs() <= 1e-14, "{round}: {precise:?} {truth:?}");
        assert!(precise.bound <= 2e-15, "{round}: {precise:?}");
        let Precise { normal: Some(normal), .. } = precise else { continue };
        // An f32 axis is within 6e-8 of the normal, and the pair is about 2 m in size.
        let along = along3(a, b, normal.as_vec3());
        assert!((-1e-15..3e-7).contains(&(precise.separation - along)), "{round}: {along} {precise:?}");
        for _ in 0..5 {
            let axis = random.direction().as_vec3();
            assert!(along3(a, b, axis) <= precise.separation + precise.bound, "{round}: {axis}");
        }
        let case = if round % 3 == 0 { random.case2() } else { random.near_case2(gap) };
        let [a, b] = [(&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b)];
        let precise = separation2(a, b);
        assert!((precise.separation - case.truth().separation).abs() <= 1e-14, "{round}: {precise:?}");
        assert!(
            precise.normal.is_none_or(|n| along2(a, b, n.as_vec2()) > precise.separation - 3e-7),
            "{round}"
        );
        let axis = random.direction2().as_vec2();
        assert!(along2(a, b, axis) <= precise.separation + precise.bound, "{round}: {axis}");
    }
}

fn cuboid(x: f32, y: f32, z: f32) -> Shape3 {
    Cuboid::from_half_extents(Vec3::new(x, y, z)).unwrap().into()
}

fn at(x: f64, y: f64, z: f64) -> Pose3 {
    Pose3::at(DVec3::new(x, y, z)).unwrap()
}

/// Whether a separation is a known number, within its own bound, which must be small.
fn is_known(precise: Precise<DVec3>, separation: f64, normal: Option<DVec3>) -> bool {
    let is_close = (precise.separation - separation).abs() <= precise.bound + separation.abs() * 1.2e-16;
    let same_normal = match (precise.normal, normal) {
        (Some(found), Some(normal)) => (found - normal).length() <= 3e-16,
        (found, normal) => found.is_none() && normal.is_none(),
    };
    is_close && same_normal && precise.bound <= 1e-15
}

#[test]
fn separations_known_beforehand_are_found() {
    let home = Pose3::IDENTITY;
    let cube = cuboid(1.0, 1.0, 1.0);
    let known = |a: (&Shape3, &Pose3), b: (&Shape3, &Pose3), separation: f64, normal: Option<DVec3>| {
        let precise = separation3(a, b);
        assert!(is_known(precise, separation, normal), "{a:?} {b:?} {precise:?}");
        let turned = separation3(b, a);
        assert!(is_known(turned, separation, normal.map(|n| -n)), "{turned:?}");
    };
    // Corner to corner along (2, 3, 6), edge to edge along (3, 4), face to face; one ulp.
    known((&cube, &home), (&cube, &at(4.0, 5.0, 8.0)), 7.0, Some(DVec3::new(2.0, 3.0, 6.0) / 7.0));
    known((&cube, &home), (&cube, &at(-5.0, 6.0, 0.25)), 5.0, Some(DVec3::new(-0.6, 0.8, 0.0)));
    let hair = 2.0_f64.next_up() - 2.0;
    known((&cube, &home), (&cube, &at(2.0 + hair, 0.5, 0.25)), hair, Some(DVec3::X));
    known((&cube, &home), (&cube, &at(2.0 - hair / 2.0, 0.5, 0.25)), -hair / 2.0, Some(DVec3::X));
    known((&cube, &home), (&cube, &at(2.0, 0.5, 0.25)), 0.0, Some(DVec3::X));
    // In one pose, six faces are equally good.
    known((&cube, &home), (&cube, &home), -2.0, None);
    known((&cuboid(1.0, 2.0, 3.0), &home), (&cube, &at(0.25, 0.0, 0.0)), -1.75, Some(DVec3::X));
    // Two parallel beams, the upper one rolled by cos 3/5 and sin 4/5 about its length: the lower one's face wins.
    let crossed = Quat::from_xyzw(1.0, 0.0, 0.0, 2.0);
    let beam = cuboid(5.0, 1.0, 1.0);
    let tilted = Pose3::new(DVec3::new(0.0, 3.0, 0.0), crossed).unwrap();
    // Half heights: 1, and (3 + 4) / 5 of the rotated unit square along y; along its own face, 3 * 3/5 - 1 - 7/5.
    known((&beam, &home), (&beam, &tilted), 0.6, Some(DVec3::Y));
    // Crossing segments, a point in a triangle's plane, and one segment along another: no depth, no direction.
    let rod = |to: Vec3| Shape3::from(Segment3::new(-to, to).unwrap());
    known((&rod(Vec3::X), &home), (&rod(Vec3::Y), &home), 0.0, None);
    known((&rod(Vec3::X), &home), (&rod(Vec3::Y), &at(0.0, 0.0, 0.125)), 0.125, Some(DVec3::Z));
    known((&rod(Vec3::X), &home), (&rod(Vec3::X), &at(0.5, 0.0, 0.0)), 0.0, None);
    let triangle: Shape3 = Triangle3::new(Vec3::ZERO, Vec3::X * 4.0, Vec3::Y * 4.0).unwrap().into();
    known((&triangle, &home), (&rod(Vec3::Z * 0.5), &at(1.0, 1.0, 0.25)), -0.25, Some(DVec3::Z));
    // Rounded shapes: from the cores' separation, apart and in overlap.
    let capsule: Shape3 = Capsule3::new(Vec3::NEG_Y, Vec3::Y, 0.25).unwrap().into();
    let ball: Shape3 = Sphere::new(0.5).unwrap().into();
    known((&capsule, &home), (&ball, &at(3.0, 5.0, 0.0)), 4.25, Some(DVec3::new(0.6, 0.8, 0.0)));
    known((&cube, &home), (&ball, &at(0.5, 0.0, 0.0)), -1.0, Some(DVec3::X));
    let slope: Shape3 = HalfSpace::new(Vec3::new(6.0, 8.0, 0.0)).unwrap().into();
    known(
        (&slope, &at(-1e9, 0.0, 0.0)),
        (&ball, &at(3.0 - 1e9, 4.0, 7.0)),
        4.5,
        Some(DVec3::new(0.6, 0.8, 0.0)),
    );
}

#[test]
fn the_depth_of_crossed_edges_is_found() {
    // A cube on its edge below another on its edge, crosswise: each reaches sqrt(2) up or down. For the half angle, the
    // sine and cosine of a sixteenth of a turn.
    let [s, c] = [-0.25, 0.25].map(|part| (0.5 + part * std::f64::consts::SQRT_2).sqrt());
    let below = Pose3::new(DVec3::ZERO, Quat::from_xyzw(s as f32, 0.0, 0.0, c as f32)).unwrap();
    let cube = cuboid(1.0, 1.0, 1.0);
    for sunk in [1e-3, 0.1, 0.2] {
        let height = 2.0 * std::f64::consts::SQRT_2 - sunk;
        let above =
            Pose3::new(DVec3::new(0.0, 0.0, height), Quat::from_xyzw(0.0, s as f32, 0.0, c as f32)).unwrap();
        let precise = separation3((&cube, &below), (&cube, &above));
        // The f32 quaternion is an eighth of a turn within 6e-8, and the reach has its maximum there.
        assert!((precise.separation + sunk).abs() < 1e-7, "{precise:?}");
        assert!((precise.normal.unwrap() - DVec3::Z).length() < 1e-6, "{precise:?}");
    }
}

#[test]
fn separations_in_the_plane_known_beforehand_are_found() {
    let rect: Shape2 = Rect::from_half_extents(Vec2::new(1.0, 0.5)).unwrap().into();
    let quarter = Rotation2::new(0.0, 1.0).unwrap();
    for (x, y, separation, normal) in [
        (4.5, 5.5, 5.0, Some(DVec2::new(0.6, 0.8))),
        (1.25, 0.25, -0.25, Some(DVec2::X)),
        (1.5, 0.25, 0.0, Some(DVec2::X)),
        (0.0, -1.0, -0.5, Some(DVec2::NEG_Y)),
        (0.0, 0.0, -1.5, None),
    ] {
        let pose = Pose2::new(DVec2::new(x, y), quarter).unwrap();
        let precise = separation2((&rect, &Pose2::IDENTITY), (&rect, &pose));
        assert!((precise.separation - separation).abs() <= precise.bound, "{x} {y}: {precise:?}");
        assert_eq!(precise.normal.is_some(), normal.is_some(), "{x} {y}: {precise:?}");
        assert!(
            precise.normal.is_none_or(|n| (n - normal.unwrap()).length() < 3e-16),
            "{x} {y}: {precise:?}"
        );
    }
}

#[test]
fn a_compound_is_as_near_as_its_nearest_part() {
    let cube = cuboid(0.5, 0.5, 0.5);
    let parts = [(at(0.0, 0.0, 0.0), cube.clone()), (at(3.0, 0.0, 0.0), cube.clone())];
    let compound: Shape3 = Compound3::new(parts).unwrap().into();
    let pose = at(5.0, 0.25, 0.0);
    let [a, b] = [(&compound, &Pose3::IDENTITY), (&cube, &pose)];
    let all: Vec<f64> = separations3(a, b).iter().map(|precise| precise.separation).collect();
    assert_eq!(all, [4.0, 1.0]);
    assert_eq!((separation3(a, b).separation, separation3(a, b).normal), (1.0, Some(DVec3::X)));
    assert_eq!([along3(a, b, Vec3::X * 3.0), along3(a, b, Vec3::NEG_X)], [1.0, -3.0]);
    // Halfway between both parts, on either side, the normal is not unique.
    assert_eq!(separation3(a, (&cube, &at(1.5, 0.0, 0.0))).normal, None);
}

/// The largest possible hulls, deep in each other: faces by the hundred, pairs of edges by the hundred thousand.
#[test]
fn hulls_of_256_vertices_have_a_depth() {
    let mut random = Random::new(923);
    let (a, b) = (random.hull(256), random.hull(256));
    let pose = Pose3::new(random.vector() * 0.1, random.quaternion()).unwrap();
    let [a, b] = [(&a, &Pose3::IDENTITY), (&b, &pose)];
    let precise = separation3(a, b);
    assert_eq!(exact_relation3(a, b), Relation::Overlapping);
    assert!(precise.separation < -0.1 && precise.bound < 1e-15, "{precise:?}");
    let normal = precise.normal.unwrap();
    // The best axis beats those close to it, and any other.
    let spread = [1e-3, 1e-1, 1.0].map(|width| (0..200).map(move |_| width));
    for width in spread.into_iter().flatten() {
        let axis = (normal + random.vector() * width).as_vec3();
        assert!(along3(a, b, axis) <= precise.separation + precise.bound, "{axis}");
    }
    assert!(along3(a, b, normal.as_vec3()) > precise.separation - 3e-7);
}
