//! Rays, against the distance of points on them from the shape.

use super::finite;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Cuboid, Hull, Pose3, Ray3, Shape3, Triangle3};
use asunder_narrow::{Pair3, Separation3, cast_ray3};
use asunder_tests::cases::Random;
use asunder_tests::shapes::{KINDS3, PLACES, pair3};

/// Signed distance of a point from a shape, negative inside, and its error.
fn separation(shape: &Shape3, pose: &Pose3, point: DVec3) -> (f64, f64) {
    let dot = Shape3::from(Hull::of_any_dimension(&[Vec3::ZERO]).unwrap());
    let place = Pose3::at(point).unwrap();
    match Pair3::new(shape, pose, &dot, &place).separation(f32::INFINITY) {
        Separation3::Measured(found) => (found.separation.into(), found.error.into()),
        Separation3::AtLeast(bound) => panic!("no limit, yet no measure: {bound}"),
    }
}

fn overlaps(shape: &Shape3, pose: &Pose3, point: DVec3) -> bool {
    let dot = Shape3::from(Hull::of_any_dimension(&[Vec3::ZERO]).unwrap());
    let place = Pose3::at(point).unwrap();
    Pair3::new(shape, pose, &dot, &place).overlaps()
}

#[test]
fn a_ray_meets_nothing_before_its_hit_and_the_surface_there() {
    let (mut hits, mut misses, mut inside) = (0, 0, 0);
    for (i, kind) in KINDS3.iter().enumerate() {
        for round in 0..30 * PLACES {
            let mut random = Random::new((i * 10_000 + round) as u128);
            let bodies = pair3(&mut random, kind, &KINDS3[0], round);
            let case = bodies.case();
            let (shape, pose) = (&case.shape_a, &case.pose_a);
            let size = finite(shape.outer_radius()).max(1e-6);
            let center = pose.transform(shape.center());
            let from = center + random.direction() * size * random.pick(&[0.0, 0.3, 1.0, 1.5, 4.0]);
            let aside = random.direction() * size * random.pick(&[0.0, 0.1, 0.5, 0.9]);
            let towards = center + aside - from;
            let length = random.pick(&[1.0, 1e-3, 7.0]);
            let direction = (towards * length).as_vec3();
            let Ok(ray) = Ray3::new(from, if direction == Vec3::ZERO { Vec3::X } else { direction }) else {
                continue;
            };
            let pace = ray.direction().as_dvec3().length();
            // Rounding of the positions of points on the ray.
            let lost = 4.0 * f64::EPSILON * (from.abs().element_sum() + 8.0 * size) + 1e-13 * size;
            let hit = cast_ray3(shape, pose, &ray, f64::INFINITY);
            let told = format!("{} {round}: {hit:?} {shape:?} {pose:?} {ray:?}", kind.0);
            assert_eq!(hit.is_some_and(|hit| hit.inside), overlaps(shape, pose, from), "{told}");
            let until = hit.map_or(6.0 * size / pace, |hit| hit.distance);
            let slack = hit.map_or(0.0, |hit| f64::from(hit.error)) + lost + planar(shape);
            for step in 0..24 {
                let (deep, error) = separation(shape, pose, ray.at(until * f64::from(step) / 24.0));
                assert!(deep + error >= -slack || hit.is_some_and(|hit| hit.inside), "{deep} {step} {told}");
            }
            let Some(hit) = hit else {
                misses += 1;
                continue;
            };
            assert!((hit.normal.length() - 1.0).abs() < 1e-6 && hit.distance.is_finite(), "{told}");
            assert!(hit.normal.dot(ray.direction()) <= 0.0, "{told}");
            if hit.inside {
                inside += 1;
                assert!(hit.distance == 0.0 && hit.error == 0.0, "{told}");
                continue;
            }
            hits += 1;
            let (apart, error) = separation(shape, pose, ray.at(hit.distance));
            assert!(apart.abs() <= slack + error, "{apart} {slack} {told}");
            if hit.distance * pace < 1e-6 * size {
                continue;
            }
            let limits = [hit.distance * 1.0001, hit.distance * 0.9999];
            let found = limits.map(|limit| cast_ray3(shape, pose, &ray, limit));
            assert!(found[0].is_some() && found[1].is_none(), "{found:?} {told}");
        }
    }
    assert!(hits > 2000 && misses > 200 && inside > 500, "{hits} {misses} {inside}");
}

/// How far a hull's faces may be off its vertices.
fn planar(shape: &Shape3) -> f64 {
    match shape {
        Shape3::Hull(hull) => 4.0 * f64::from(hull.planarity_error()),
        Shape3::Compound(compound) => {
            compound.parts().iter().map(|part| planar(part.shape())).fold(0.0, f64::max)
        }
        _ => 0.0,
    }
}

#[test]
fn origins_on_the_surface_are_inside_exactly() {
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.5, 0.25, 0.125)).unwrap());
    let octahedron = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let hull = Shape3::from(Hull::from_points(&octahedron).unwrap());
    for (shape, point) in [(&cube, DVec3::new(0.5, 0.25, 0.0)), (&hull, DVec3::new(0.5, 0.25, 0.25))] {
        for direction in [Vec3::X, Vec3::NEG_X, Vec3::Z] {
            let on = cast_ray3(shape, &Pose3::IDENTITY, &Ray3::new(point, direction).unwrap(), 1.0).unwrap();
            assert!(on.inside && on.distance == 0.0 && on.normal == -direction);
        }
        let out = DVec3::new(point.x.next_up(), point.y, point.z);
        let away = cast_ray3(shape, &Pose3::IDENTITY, &Ray3::new(out, Vec3::X).unwrap(), 1.0);
        assert!(away.is_none_or(|hit| !hit.inside && hit.distance < 1e-12), "{away:?}");
        let back = cast_ray3(shape, &Pose3::IDENTITY, &Ray3::new(out, Vec3::NEG_X).unwrap(), 1.0).unwrap();
        assert!(!back.inside && back.distance < 1e-12, "{back:?}");
    }
}

#[test]
fn no_ray_slips_between_triangles_that_share_an_edge() {
    for seed in 0..2000 {
        let mut random = Random::new(seed);
        let [a, b, c, d] = [0; 4].map(|_| random.vector().as_vec3());
        let (Ok(one), Ok(other)) = (Triangle3::new(a, b, c), Triangle3::new(b, a, d)) else { continue };
        let pose = Pose3::new(random.vector(), random.quaternion()).unwrap();
        let on_edge = pose.transform(a.as_dvec3().lerp(b.as_dvec3(), random.between(0.01, 0.99)));
        let from = on_edge + random.direction() * 5.0;
        let ray = Ray3::new(from, (on_edge - from).as_vec3()).unwrap();
        // The direction was rounded to f32: aim by moving the origin instead.
        let ray = Ray3::new(on_edge - ray.direction().as_dvec3(), ray.direction()).unwrap();
        let hit = [one, other].map(|triangle| cast_ray3(&triangle.into(), &pose, &ray, f64::INFINITY));
        assert!(hit.iter().any(Option::is_some), "{seed}: {ray:?} {pose:?} {a} {b} {c} {d}");
    }
}

#[test]
fn odd_rays_and_limits_give_no_nan() {
    let mut random = Random::new(3);
    for (kind, make) in KINDS3 {
        for scale in [1e-4, 1.0, 1e5] {
            let shape = make(&mut asunder_tests::shapes::Clay::new(&mut random, scale));
            let pose = Pose3::new([0.0; 3], random.quaternion()).unwrap();
            for direction in
                [Vec3::X * 1e-45, Vec3::Y * 3e38, Vec3::new(1.0, 1e-45, 0.0), Vec3::splat(-1e-30)]
            {
                for origin in
                    [DVec3::ZERO, DVec3::splat(1e9), DVec3::new(-1e9, 1e-300, 0.0), DVec3::Y * scale]
                {
                    let ray = Ray3::new(origin, direction).unwrap();
                    for limit in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300, 1.0] {
                        let Some(hit) = cast_ray3(&shape, &pose, &ray, limit) else { continue };
                        assert!(hit.distance >= 0.0 && hit.distance.is_finite(), "{kind} {hit:?} {ray:?}");
                        assert!(hit.normal.is_finite() && hit.error >= 0.0, "{kind} {hit:?} {ray:?}");
                        assert!(limit.is_nan() || hit.distance <= limit.max(0.0), "{kind} {hit:?} {limit}");
                    }
                }
            }
        }
    }
}
