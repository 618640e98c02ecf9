//! A point as a shape: what it is inside of, exactly, and how far it is from every kind of shape.

use asunder::{Circle, Pair2, Pair3, Pose2, Pose3, Shape2, Shape3, Sphere};
use asunder_tests::bodies::{Bodies2, Bodies3};
use asunder_tests::cases::{Case2, Case3, Random};
use asunder_tests::exact_overlap::{exact_overlap2, exact_overlap3};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use glam::{DVec2, DVec3};

/// Points of a shape, near it, and a few ulps beside it: corners, points of edges, faces and round surfaces.
fn places(vertices: &[DVec3], support: impl Fn(DVec3) -> Option<DVec3>, random: &mut Random) -> Vec<DVec3> {
    let mut places = vec![];
    for _ in 0..12 {
        let any =
            |random: &mut Random| if vertices.is_empty() { random.vector() } else { random.pick(vertices) };
        let (a, b, c) = (any(random), any(random), any(random));
        let surface = support(random.direction()).unwrap_or(a);
        let from =
            [a, (a + b) * 0.5, (a + b + c) / 3.0, a + (b - a) * random.between(0.0, 1.0), surface, surface];
        let beside = [DVec3::ZERO, random.vector() * 1e-16, random.vector() * 1e-7, random.vector() * 0.5];
        places.push(random.pick(&from) + random.pick(&beside));
    }
    places
}

#[test]
fn a_point_is_in_a_solid_exactly_where_integers_say_so() {
    let mut random = Random::new(3100);
    let dot = Shape3::from(Sphere::POINT);
    for (name, make) in KINDS3 {
        let mut held = [0; 2];
        for round in 0..60 {
            let shape = make(&mut if round % 2 == 0 {
                Clay::short(&mut random)
            } else {
                Clay::new(&mut random, 1.0)
            });
            let turn = [glam::Quat::IDENTITY, random.quaternion()][round / 2 % 2];
            let pose = Pose3::new([DVec3::ZERO, random.vector() * 1e6][round / 4 % 2], turn).unwrap();
            let vertices: Vec<DVec3> =
                shape.core().vertices().iter().map(|vertex| vertex.as_dvec3()).collect();
            for place in places(&vertices, |along| shape.support(along), &mut random) {
                let at = Pose3::at(pose.transform(place)).unwrap();
                let truth = exact_overlap3((&dot, &at), (&shape, &pose));
                let found = Pair3::new(&dot, &at, &shape, &pose).overlaps();
                assert_eq!(found, truth, "{name}: {place} in {shape:?} at {pose:?}");
                held[usize::from(truth)] += 1;
            }
        }
        assert!(held[0] > 30 && held[1] > 10, "{name}: {held:?}");
    }
}

#[test]
fn a_point_is_in_a_shape_of_the_plane_exactly_where_integers_say_so() {
    let mut random = Random::new(3101);
    let dot = Shape2::from(Circle::POINT);
    for (name, make) in KINDS2 {
        let mut held = [0; 2];
        for round in 0..60 {
            let shape = make(&mut if round % 2 == 0 {
                Clay::short(&mut random)
            } else {
                Clay::new(&mut random, 1.0)
            });
            let turn = [asunder::Rotation2::IDENTITY, random.rotation2()][round / 2 % 2];
            let pose =
                Pose2::new([DVec2::ZERO, random.vector().truncate() * 1e6][round / 4 % 2], turn).unwrap();
            let vertices: Vec<DVec3> =
                shape.core().vertices().iter().map(|vertex| vertex.as_dvec2().extend(0.0)).collect();
            for place in
                places(&vertices, |along| Some(shape.support(along.truncate())?.extend(0.0)), &mut random)
            {
                let at = Pose2::at(pose.transform(place.truncate())).unwrap();
                let truth = exact_overlap2((&dot, &at), (&shape, &pose));
                let found = Pair2::new(&dot, &at, &shape, &pose).overlaps();
                assert_eq!(found, truth, "{name}: {place} in {shape:?} at {pose:?}");
                held[usize::from(truth)] += 1;
            }
        }
        assert!(held[0] > 30 && held[1] > 10, "{name}: {held:?}");
    }
}

#[test]
fn the_distance_of_a_point_is_right_within_its_error() {
    let mut random = Random::new(3102);
    let mut apart = 0;
    for round in 0..120 {
        for (name, make) in KINDS3 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose3::new(random.vector(), random.quaternion()).unwrap();
            let at = Pose3::at(random.vector() * [0.5, 2.0, 10.0][round % 3]).unwrap();
            let case = Case3 { shape_a: Sphere::POINT.into(), pose_a: at, shape_b: shape, pose_b: pose };
            let judged = Bodies3::new(case);
            let truth = judged.truth().separation;
            let Some(closest) = judged.pair().distance() else {
                assert!(truth <= 1e-12, "{name}: {truth} m away");
                continue;
            };
            let miss = (f64::from(closest.distance) - truth).abs();
            // The oracle's own rounding, in f64.
            assert!(miss <= f64::from(closest.error) + 1e-12, "{name}: {closest:?}, true {truth}");
            assert_eq!(closest.anchor_a, glam::Vec3::ZERO, "{name}: a point is where it is");
            assert!(f64::from(closest.error) <= 1e-6 * (truth + 2.0), "{name}: {closest:?}");
            apart += 1;
        }
        for (name, make) in KINDS2 {
            let shape = make(&mut Clay::new(&mut random, 1.0));
            let pose = Pose2::new(random.vector().truncate(), random.rotation2()).unwrap();
            let at = Pose2::at(random.vector().truncate() * [0.5, 2.0, 10.0][round % 3]).unwrap();
            let case = Case2 { shape_a: Circle::POINT.into(), pose_a: at, shape_b: shape, pose_b: pose };
            let judged = Bodies2::new(case);
            let truth = judged.truth().separation;
            let Some(closest) = judged.pair().distance() else {
                assert!(truth <= 1e-12, "{name}: {truth} m away");
                continue;
            };
            let miss = (f64::from(closest.distance) - truth).abs();
            assert!(miss <= f64::from(closest.error) + 1e-12, "{name}: {closest:?}, true {truth}");
            assert_eq!(closest.anchor_a, glam::Vec2::ZERO, "{name}: a point is where it is");
            apart += 1;
        }
    }
    assert!(apart > 1000, "{apart}");
}
