use super::*;
use crate::tolerance::COPLANAR;

/// xorshift, for clouds without a dependency.
fn cloud(count: usize, seed: u64, shape: impl Fn(Vec3) -> Vec3) -> Vec<Vec3> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
    };
    (0..count).map(|_| shape(Vec3::new(next(), next(), next()))).collect()
}

/// Closed, Euler's formula, convex within its own planarity error, all points inside within `error()`.
fn check(points: &[Vec3], hull: &Hull) {
    let topology = hull.topology();
    let (v, e, f) = (hull.vertices().len(), topology.edges().len(), topology.face_count());
    assert_eq!(v + f, e + 2, "Euler's formula: {v} vertices, {e} edges, {f} faces");
    assert_eq!(topology.half_edges().len(), 2 * e, "closed");
    for (i, half_edge) in topology.half_edges().iter().enumerate() {
        let twin = topology.half_edges()[half_edge.twin as usize];
        assert_eq!(twin.twin as usize, i);
        assert_ne!(twin.face, half_edge.face);
        assert_eq!(twin.origin as usize, topology.ends(i).1);
    }
    assert!(hull.vertices().iter().all(|vertex| points.contains(vertex)), "a subset of the points");
    assert!(f64::from(hull.planarity_error()) <= 8.0 * COPLANAR * f64::from(hull.outer_radius()));
    // A point lies within `error` of the hull, and the hull within its planarity error of each face's plane.
    let slack =
        f64::from(hull.planarity_error()) + f64::from(hull.error()) + 1e-12 * f64::from(hull.outer_radius());
    for (face, normal) in hull.normals().iter().enumerate() {
        assert!((normal.length() - 1.0).abs() < 1e-14);
        let reach = |v: Vec3| normal.dot(v.as_dvec3() - hull.center().as_dvec3());
        let plane =
            topology.face_vertices(face).map(|i| reach(hull.vertices()[i])).fold(f64::INFINITY, f64::min);
        for &point in points {
            assert!(reach(point) <= plane + slack, "point beyond face {face} by {}", reach(point) - plane);
        }
    }
}

#[test]
fn random_clouds_are_valid_hulls() {
    for seed in 1..60 {
        let count = 4 + (seed as usize * 7) % 80;
        let points = cloud(count, seed, |v| v);
        check(&points, &Hull::from_points(&points).unwrap());
        let sphere = cloud(count, seed + 100, |v| v.normalize_or(Vec3::X) * 3.0 + Vec3::splat(10.0));
        check(&sphere, &Hull::from_points(&sphere).unwrap());
    }
}

#[test]
fn lattices_merge_into_a_cuboid() {
    let lattice: Vec<Vec3> =
        (0..125).map(|i| Vec3::new((i % 5) as f32, (i / 5 % 5) as f32, (i / 25) as f32)).collect();
    let hull = Hull::from_points(&lattice).unwrap();
    check(&lattice, &hull);
    assert_eq!((hull.vertices().len(), hull.topology().face_count()), (8, 6));
    assert_eq!((hull.planarity_error(), hull.error()), (0.0, 0.0));
    assert_eq!(hull.center(), Vec3::splat(2.0));
    assert_eq!(hull.inner_radius(), 2.0_f32.next_down(), "rounded down by the guard");
}

#[test]
fn faces_that_rounding_split_are_merged_again() {
    // A turned lattice: its faces are flat up to f32 rounding only, and its inner face points poke out.
    let pose = crate::Pose3::new(Vec3::ZERO, glam::Quat::from_xyzw(0.1, 0.7, -0.3, 0.6)).unwrap();
    let turned: Vec<Vec3> = (0..64)
        .map(|i| pose.transform(Vec3::new((i % 4) as f32, (i / 4 % 4) as f32, (i / 16) as f32)).as_vec3())
        .collect();
    let hull = Hull::from_points(&turned).unwrap();
    check(&turned, &hull);
    assert_eq!(hull.topology().face_count(), 6);
    assert!(hull.error() > 0.0 && hull.error() < 1e-6, "{}", hull.error());
}

#[test]
fn needles_plates_and_thin_clouds_are_valid() {
    for seed in 1..20 {
        for stretch in [Vec3::new(1.0, 1e-6, 1e-6), Vec3::new(1.0, 1.0, 1e-6), Vec3::new(1.0, 1.0, 1e-7)] {
            let points = cloud(30, seed, |v| v * stretch);
            match Hull::from_points(&points) {
                Ok(hull) => check(&points, &hull),
                Err(error) => panic!("{error}"),
            }
        }
    }
}

#[test]
fn clouds_without_volume_name_their_dimension() {
    let flat = |shape: fn(Vec3) -> Vec3| Hull::from_points(&cloud(20, 3, shape)).unwrap_err();
    assert_eq!(flat(|_| Vec3::ONE), HullError::Flat { dimension: 0 });
    assert_eq!(flat(|v| Vec3::new(v.x, v.x * 2.0, 0.5)), HullError::Flat { dimension: 1 });
    assert_eq!(flat(|v| Vec3::new(v.x, v.y, 0.25)), HullError::Flat { dimension: 2 });
}

#[test]
fn bad_clouds_are_refused() {
    let mut points = cloud(10, 5, |v| v);
    assert_eq!(Hull::from_points(&points[..3]).unwrap_err(), HullError::TooFewPoints { count: 3 });
    points[7].y = f32::NAN;
    assert_eq!(Hull::from_points(&points).unwrap_err(), HullError::NotFinite { index: 7 });
    points[7].y = 1.1e6;
    assert_eq!(Hull::from_points(&points).unwrap_err(), HullError::TooLarge { index: 7 });
    let tiny = cloud(10, 5, |v| v * 1e-8);
    assert!(matches!(Hull::from_points(&tiny).unwrap_err(), HullError::TooSmall { .. }));
    let round = cloud(2000, 5, |v| v.normalize_or(Vec3::X));
    assert!(matches!(Hull::from_points(&round).unwrap_err(), HullError::TooManyVertices { .. }));
    let many = cloud(70_000, 5, |v| v);
    assert_eq!(Hull::from_points(&many).unwrap_err(), HullError::TooManyPoints { count: 70_000 });
}

/// Clouds that break hull builders: coplanar, collinear, repeated, nearly flat, thin, and all of it at once.
fn nasty_cloud(seed: u64) -> Vec<Vec3> {
    let count = 4 + (seed as usize * 13) % 60;
    let steps = |v: Vec3, n: f32| (v * n).round() / n;
    cloud(count, seed, |v| match seed % 9 {
        0 => v,
        1 => v.normalize_or(Vec3::X),
        2 => steps(v, 1.0),
        3 => steps(v, 2.0),
        4 => Vec3::new(v.x, v.y, v.z * 1e-7),
        5 => Vec3::new(v.x, v.y * 1e-6, v.z * 1e-6),
        6 => steps(v, 3.0) + v * 1e-7,
        7 => Vec3::new(v.x, v.y, if v.z > 0.5 { v.z } else { 0.25 }),
        _ => Vec3::splat(1e5) + steps(v, 4.0),
    })
}

#[test]
fn the_builder_finds_the_very_facets_that_wrapping_finds() {
    let mut solid = 0;
    for seed in 1..3000 {
        let points = cloud::Cloud::new(&nasty_cloud(seed), 4).unwrap().points;
        let (quick, wrapped) = (quick::hull_facets(&points), wrap::enumerate_facets(&points));
        assert_eq!(quick, wrapped, "seed {seed}");
        solid += usize::from(quick.is_ok());
    }
    assert!(solid > 2500, "only {solid} clouds had a volume");
}

#[test]
fn nasty_clouds_are_valid_hulls() {
    for seed in 1..3000 {
        let points = nasty_cloud(seed);
        match Hull::from_points(&points) {
            Ok(hull) => check(&points, &hull),
            Err(error) => assert!(matches!(error, HullError::Flat { .. }), "seed {seed}: {error}"),
        }
    }
}
