//! Contacts that physics depends on: their number, their positions, and how they change.

use asunder_geometry::{
    Capsule2, Capsule3, Circle, Cuboid, HalfPlane, HalfSpace, Hull, Polygon, Pose2, Pose3, Rect, Rotation2,
    Shape2, Shape3, Sphere, Triangle3,
};
use asunder_narrow::{FeatureId, Manifold3, Pair2, Pair3, Separation2, Separation3};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::Bodies3;
use asunder_tests::cases::{Case3, Random};
use asunder_tests::shapes::{KINDS3, pair3};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use std::collections::BTreeSet;

fn cube(half: f32) -> Cuboid {
    Cuboid::from_half_extents(Vec3::splat(half)).unwrap()
}

/// Along x: half a metre of segment each way, with a radius of 0.25 m.
fn lying_capsule() -> Shape3 {
    Capsule3::new(Vec3::NEG_X * 0.5, Vec3::X * 0.5, 0.25).unwrap().into()
}

fn floors() -> [(&'static str, Shape3, f64); 4] {
    let corners = [Vec3::new(-90.0, 0.0, -90.0), Vec3::new(0.0, 0.0, 90.0), Vec3::new(90.0, 0.0, -90.0)];
    let box_ = Cuboid::from_half_extents(Vec3::new(50.0, 0.5, 50.0)).unwrap();
    [
        ("half-space", HalfSpace::new(Vec3::Y).unwrap().into(), 0.0),
        ("box", box_.into(), -0.5),
        ("triangle", Triangle3::new(corners[0], corners[1], corners[2]).unwrap().into(), 0.0),
        ("rounded box", box_.rounded(0.25).unwrap().into(), -0.75),
    ]
}

/// Shapes that lie flat on a floor of any kind, the heights of their origins then, and how many points support them.
fn lying() -> [(&'static str, Shape3, f64, usize); 6] {
    let wedge = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::Y].map(|v| v - Vec3::new(0.25, 0.0, 0.25));
    let patch = Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::Z).unwrap();
    [
        ("box", cube(0.5).into(), 0.5, 4),
        ("rounded box", cube(0.5).rounded(0.25).unwrap().into(), 0.75, 4),
        ("lying capsule", lying_capsule(), 0.25, 2),
        ("ball", Sphere::new(0.5).unwrap().into(), 0.5, 1),
        ("hull on a triangular face", Hull::from_points(&wedge).unwrap().into(), 0.0, 3),
        ("triangle", patch.into(), 0.0, 3),
    ]
}

/// Slightly sunk in, deep, exactly touching, and slightly above: all supporting points are present, in both orders.
#[test]
fn what_lies_on_a_floor_lies_on_all_of_its_points() {
    let mut random = Random::new(7200);
    for (floor_name, floor, level) in floors() {
        for (name, shape, height, expected) in lying() {
            for round in 0..40 {
                let sunk = [0.0, 1e-6, 1e-3, 0.01, -1e-6, -1e-3][round % 6];
                // A sheet is never sunk into another sheet: it is above or below.
                let are_sheets = (floor_name, name) == ("triangle", "triangle");
                if are_sheets && sunk > 0.0 {
                    continue;
                }
                let at = DVec2::new(random.signed(), random.signed()) * 20.0;
                let turn = random.direction2();
                let turn = Quat::from_xyzw(0.0, turn.x as f32, 0.0, turn.y as f32);
                let case = Case3 {
                    shape_a: floor.clone(),
                    pose_a: Pose3::at([0.0, level, 0.0]).unwrap(),
                    shape_b: shape.clone(),
                    pose_b: Pose3::new([at.x, height - sunk, at.y], turn).unwrap(),
                };
                for case in [case.swapped(), case] {
                    let bodies = Bodies3::new(case);
                    let Some(manifold) = bodies.manifold(0.002) else {
                        panic!("{name} on {floor_name}, sunk {sunk}: nothing")
                    };
                    let count = manifold.contacts.len();
                    // A sheet is never sunk into another sheet: it is above or below.
                    let sunk =
                        if (floor_name, name) == ("triangle", "triangle") { -sunk.abs() } else { sunk };
                    assert_eq!(count, expected, "{name} on {floor_name}, sunk {sunk}: {manifold:?}");
                    for contact in &manifold.contacts {
                        assert!(
                            (contact.separation + sunk).abs() < 1e-5,
                            "{name} on {floor_name}: {contact:?}"
                        );
                    }
                }
            }
        }
    }
}

/// Side by side, crossed, and end to end.
#[test]
fn parallel_capsules_touch_in_two_points_and_crossed_ones_in_one() {
    let capsule = lying_capsule();
    let points = |at: [f64; 3], turn: Quat| {
        let there = Pose3::new(at, turn).unwrap();
        Pair3::new(&capsule, &Pose3::IDENTITY, &capsule, &there).manifold(0.01).unwrap().points.len()
    };
    let along_z = Quat::from_xyzw(0.0, 1.0, 0.0, 1.0);
    for (height, shift) in [(0.5, 0.0), (0.49, 0.3), (0.505, -0.7), (0.3, 0.25)] {
        assert_eq!(points([shift, height, 0.0], Quat::IDENTITY), 2, "{height} {shift}");
        assert_eq!(points([shift, 0.0, height], Quat::from_xyzw(0.0, 1.0, 0.0, 0.0)), 2, "{height} {shift}");
        assert_eq!(points([0.1, height, 0.1], along_z), 1, "{height}");
    }
    assert_eq!(points([1.49, 0.0, 0.0], Quat::IDENTITY), 1, "end to end");
}

/// A tiny bit more rotation must not cost a lying capsule one of its points.
#[test]
fn a_capsule_that_rolls_over_a_box_keeps_two_points() {
    let capsule = lying_capsule();
    for (name, floor, level) in floors() {
        for step in 0..400 {
            let tilt = f64::from(step - 200) * 1e-6;
            let turn = Quat::from_xyzw(0.01 * step as f32, 0.0, (tilt / 2.0) as f32, 1.0);
            let pose = Pose3::new([0.0, 0.249, 0.0], turn).unwrap();
            let manifold = Pair3::new(&floor, &Pose3::at([0.0, level, 0.0]).unwrap(), &capsule, &pose)
                .manifold(0.0)
                .unwrap();
            assert_eq!(manifold.points.len(), 2, "on {name}, tilted {tilt}: {manifold:?}");
        }
    }
}

#[test]
fn what_lies_on_a_line_lies_on_both_of_its_points() {
    let floors: [(Shape2, f64); 3] = [
        (HalfPlane::new(Vec2::Y).unwrap().into(), 0.0),
        (Rect::from_half_extents(Vec2::new(50.0, 0.5)).unwrap().into(), -0.5),
        (Rect::from_half_extents(Vec2::new(50.0, 0.25)).unwrap().rounded(0.25).unwrap().into(), -0.5),
    ];
    let square = Rect::from_half_extents(Vec2::splat(0.5)).unwrap();
    let wedge = Polygon::new(&[Vec2::NEG_X, Vec2::X, Vec2::Y]).unwrap();
    let lying: [(Shape2, f64, usize); 5] = [
        (square.into(), 0.5, 2),
        (square.rounded(0.25).unwrap().into(), 0.75, 2),
        (Capsule2::new(Vec2::NEG_X, Vec2::X, 0.25).unwrap().into(), 0.25, 2),
        (Circle::new(0.5).unwrap().into(), 0.5, 1),
        (wedge.into(), 0.0, 2),
    ];
    for (floor, level) in &floors {
        for (shape, height, expected) in &lying {
            for sunk in [0.0, 1e-6, 0.01, -1e-6, -1e-3] {
                let at = Pose2::at([3.25, height - sunk]).unwrap();
                let below = Pose2::at([0.0, *level]).unwrap();
                let manifold = Pair2::new(floor, &below, shape, &at).manifold(0.002).unwrap();
                assert_eq!(
                    manifold.points.len(),
                    *expected,
                    "{shape:?} on {floor:?}, sunk {sunk}: {manifold:?}"
                );
                let manifold = Pair2::new(shape, &at, floor, &below).manifold(0.002).unwrap();
                assert_eq!(
                    manifold.points.len(),
                    *expected,
                    "{floor:?} under {shape:?}, sunk {sunk}: {manifold:?}"
                );
            }
        }
    }
}

/// Moved through the place where the cores begin to overlap, nothing jumps by more than the step.
#[test]
fn a_separation_passes_from_gap_to_core_overlap_without_a_jump() {
    let mut random = Random::new(7201);
    let rounded = |random: &mut Random| -> Shape3 {
        let Shape3::Hull(hull) = random.hull(6) else { unreachable!("a hull") };
        match random.below(3) {
            0 => cube(0.5).rounded(0.2).unwrap().into(),
            1 => hull.rounded(0.1).unwrap().into(),
            _ => lying_capsule(),
        }
    };
    for _ in 0..150 {
        let case = Case3 {
            shape_a: rounded(&mut random),
            pose_a: Pose3::new(DVec3::ZERO, random.quaternion()).unwrap(),
            shape_b: rounded(&mut random),
            pose_b: Pose3::new(random.direction(), random.quaternion()).unwrap(),
        };
        let radii = f64::from(case.shape_a.radius() + case.shape_b.radius());
        // Moves to where the cores touch, then through it.
        let mut at = case.pose_b.position();
        let mut normal = DVec3::X;
        for _ in 0..4 {
            let pose_b = Pose3::new(at, case.pose_b.rotation()).unwrap();
            let truth = Bodies3::new(Case3 { pose_b, ..case.clone() }).truth();
            normal = truth.normal;
            at -= normal * (truth.separation + radii);
        }
        let mut last: Option<(f64, f64)> = None;
        for step in -25..25 {
            let pose_b = Pose3::new(at - normal * (f64::from(step) * 1e-6), case.pose_b.rotation()).unwrap();
            let pair = Pair3::new(&case.shape_a, &case.pose_a, &case.shape_b, &pose_b);
            let Separation3::Measured(found) = pair.separation(0.0) else { panic!("they overlap") };
            let (separation, error) = (f64::from(found.separation), f64::from(found.error));
            if let Some((before, before_error)) = last {
                let most = 1e-6 + error + before_error;
                assert!(
                    (separation - before).abs() <= most,
                    "{before} -> {separation} at step {step}: {case:?}"
                );
            }
            last = Some((separation, error));
        }
    }
}

/// Two half-spaces can be apart only if their normals are exactly opposite.
#[test]
fn half_spaces_overlap_without_end_or_lie_apart() {
    let up = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    let down = Shape3::from(HalfSpace::new(Vec3::NEG_Y * 3.0).unwrap());
    let pose = |y: f64| Pose3::at([7.0, y, -3.0]).unwrap();
    let apart = (pose(0.0), pose(2.0));
    let pair = Pair3::new(&up, &apart.0, &down, &apart.1);
    let Separation3::Measured(found) = pair.separation(f32::INFINITY) else { panic!("no limit") };
    assert_eq!((found.separation, found.normal), (2.0, Vec3::Y));
    assert!(!pair.overlaps() && pair.distance().is_some() && pair.manifold(1.0).is_none());
    let manifold = pair.manifold(2.0).unwrap();
    assert_eq!((manifold.points.len(), manifold.points[0].separation), (1, 2.0));
    // Sunk into each other by a finite depth; and with another normal, without bound.
    let sunk = (pose(0.5), pose(0.0));
    let pair = Pair3::new(&up, &sunk.0, &down, &sunk.1);
    assert!(pair.overlaps() && pair.distance().is_none());
    assert_eq!(pair.manifold(0.0).unwrap().separation, -0.5);
    let aside = Shape3::from(HalfSpace::new(Vec3::new(1e-6, -1.0, 0.0)).unwrap());
    for (a, b) in [(&up, &aside), (&up, &up), (&aside, &down)] {
        let pair = Pair3::new(a, &apart.0, b, &apart.1);
        assert!(pair.overlaps() && pair.distance().is_none() && pair.manifold(9.0).is_none());
        let Separation3::Measured(found) = pair.separation(0.0) else { panic!("they overlap") };
        assert_eq!((found.separation, found.error), (f32::NEG_INFINITY, 0.0));
    }
}

/// The same rotation for both does not change the relation of two half-spaces.
#[test]
fn half_spaces_that_are_turned_alike_still_look_away_from_each_other() {
    let mut random = Random::new(7202);
    let (mut parted, rounds) = (0, 200);
    for _ in 0..rounds {
        let normal = random.direction().as_vec3();
        let [up, down] = [normal, -normal].map(|normal| Shape3::from(HalfSpace::new(normal).unwrap()));
        let turn = random.quaternion();
        let here = Pose3::new(DVec3::ZERO, turn).unwrap();
        let out = here.basis().turn(normal.as_dvec3().normalize());
        let there = Pose3::new(out * 2.0, turn).unwrap();
        let pair = Pair3::new(&up, &here, &down, &there);
        if let Separation3::Measured(found) = pair.separation(f32::INFINITY) {
            parted += usize::from((found.separation - 2.0).abs() < 1e-6);
        }
    }
    assert_eq!(parted, rounds, "2 m apart, and called so");
    let mut parted = 0;
    for _ in 0..rounds {
        let normal = random.direction2().as_vec2();
        let [up, down] = [normal, -normal].map(|normal| Shape2::from(HalfPlane::new(normal).unwrap()));
        let turn: Rotation2 = random.rotation2();
        let out = turn.turn(normal.as_dvec2()).normalize();
        let [here, there] = [0.0, 2.0].map(|by| Pose2::new(out * by, turn).unwrap());
        if let Separation2::Measured(found) = Pair2::new(&up, &here, &down, &there).separation(f32::INFINITY)
        {
            parted += usize::from((found.separation - 2.0).abs() < 1e-6);
        }
    }
    assert_eq!(parted, rounds, "2 m apart in the plane, and called so");
}

/// Of two vertices that are equally deep one may lie past the reference face: the contact point is over the face.
#[test]
fn a_contact_lies_over_the_face_where_an_edge_leads_past_it() {
    let cuboid = Cuboid::from_half_extents(Vec3::new(0.375, 0.875, 0.75)).unwrap();
    let corners = [
        Vec3::new(-0.25, -0.875, 1.0),
        Vec3::new(0.625, 0.375, 0.125),
        Vec3::new(0.625, 0.625, -0.375),
        Vec3::new(-0.375, -0.625, -0.25),
        Vec3::new(-0.375, 0.625, -0.5),
    ];
    let bodies = Bodies3::new(Case3 {
        shape_a: cuboid.into(),
        pose_a: Pose3::IDENTITY,
        shape_b: Hull::from_points(&corners).unwrap().into(),
        pose_b: Pose3::at([-0.625, -0.25, 0.75]).unwrap(),
    });
    assert!((bodies.true_separation() + 0.375).abs() < 1e-12);
    let manifold = bodies.manifold(0.0).unwrap();
    for contact in &manifold.contacts {
        let points = contact.points;
        assert!(points.beyond_a < 1e-6 && points.beyond_b < 1e-6, "points on the shapes: {contact:?}");
    }
}

/// Two capsules that cross at a few degrees, one on top.
#[test]
fn both_points_of_nearly_parallel_capsules_lie_one_above_the_other() {
    let capsule = lying_capsule();
    for degree in [0.0_f64, 0.01, 0.5, 2.0, 5.0] {
        let half = (degree.to_radians() / 2.0) as f32;
        let turn = Quat::from_xyzw(0.0, half, 0.0, 1.0);
        let bodies = Bodies3::new(Case3 {
            shape_a: capsule.clone(),
            pose_a: Pose3::IDENTITY,
            shape_b: capsule.clone(),
            pose_b: Pose3::new([0.0, 0.45, 0.0], turn).unwrap(),
        });
        for contact in &bodies.manifold(0.0).unwrap().contacts {
            assert!(contact.points.across_normal < 1e-5, "{degree} degrees: {contact:?}");
        }
    }
}

/// Margins and limits that are not lengths: NaN and negative values count as zero, infinity includes everything.
#[test]
fn any_margin_and_any_limit_has_an_answer() {
    for round in 0..KINDS3.len() * KINDS3.len() {
        let mut random = Random::new(7210 + round as u128);
        let kinds = [round / KINDS3.len(), round % KINDS3.len()];
        let bodies = pair3(&mut random, &KINDS3[kinds[0]], &KINDS3[kinds[1]], round);
        let (pair, truth) = (bodies.pair(), bodies.true_separation());
        for none in [f32::NAN, -1.0, f32::NEG_INFINITY, -0.0] {
            assert_eq!(pair.manifolds(none), pair.manifolds(0.0), "{none}: {bodies:?}");
        }
        assert_eq!(pair.separation(f32::NAN), pair.separation(f32::INFINITY), "{bodies:?}");
        assert_eq!(pair.separation(-1.0), pair.separation(0.0), "{bodies:?}");
        let everything = pair.manifold(f32::INFINITY);
        assert_eq!(everything.is_some(), truth > f64::NEG_INFINITY, "{bodies:?}");
        for point in everything.iter().flat_map(|manifold| &manifold.points) {
            let finite =
                point.separation.is_finite() && point.anchor_a.is_finite() && point.anchor_b.is_finite();
            assert!(finite, "{point:?}: {bodies:?}");
        }
    }
}

/// Whether coplanar sheets are reported apart is decided by rounding; if so, their closest points still lie on both.
#[test]
fn closest_points_of_sheets_in_one_plane_lie_on_both() {
    let mut random = Random::new(7211);
    let mut apart = 0;
    for _ in 0..2000 {
        let mut point = || (random.vector() * DVec3::new(1.0, 1.0, 0.0)).as_vec3();
        let Ok(triangle) = Triangle3::new(point(), point(), point()) else { continue };
        let turn = random.quaternion();
        let here = Pose3::new(random.vector(), turn).unwrap();
        let aside = here.basis().turn(DVec3::new(random.signed(), random.signed(), 0.0) * 0.5);
        let case = Case3 {
            shape_a: triangle.into(),
            pose_a: here,
            shape_b: triangle.into(),
            pose_b: Pose3::new(here.position() + aside, turn).unwrap(),
        };
        let bodies = Bodies3::new(case);
        if let Some(nearest) = bodies.distance() {
            apart += 1;
            let points = nearest.points;
            assert!(points.beyond_a < 1e-6 && points.beyond_b < 1e-6, "{nearest:?}: {bodies:?}");
        }
    }
    assert!(apart > 100, "{apart} apart");
}

/// Swapped, a pair has the same features with sides changed, except for the few where two faces are equally good.
#[test]
fn features_change_sides_with_their_shapes() {
    let (mut equal, mut other) = (0, 0);
    for round in 0..4000 {
        let mut random = Random::new(7220 + round as u128);
        let kinds = [random.below(KINDS3.len() - 2), random.below(KINDS3.len() - 2)];
        // Relative poses 0 to 3 are random ones.
        let bodies = pair3(&mut random, &KINDS3[kinds[0]], &KINDS3[kinds[1]], round % 4);
        let Some(manifold) = bodies.pair().manifold(0.0) else { continue };
        let turned = bodies.swapped();
        let Some(back) = turned.pair().manifold(0.0) else { panic!("nothing: {bodies:?}") };
        let names = |manifold: &Manifold3, is_back: bool| {
            let name = |id: FeatureId| if is_back { FeatureId::new(id.b(), id.a()) } else { id };
            manifold.points.iter().map(|point| name(point.feature)).collect::<BTreeSet<_>>()
        };
        assert!((manifold.normal + back.normal).length() < 1e-5 || manifold.separation > -1e-5, "{bodies:?}");
        *if names(&manifold, false) == names(&back, true) { &mut equal } else { &mut other } += 1;
    }
    assert!(equal > 1000 && other * 50 < equal, "{equal} the same, {other} not");
}
