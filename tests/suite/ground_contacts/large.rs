//! Triangles of kilometres beside bodies of a metre: errors follow the rounding of the triangle's furthest corner.

use asunder_geometry::{Cuboid, Pose3, Shape3, Sphere, TriMesh, Triangle3};
use asunder_narrow::Pair3;
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::exact_overlap3;
use glam::{DVec3, Vec3};

/// Asserts that a triangle as a mesh agrees with the bare triangle, which agrees with exact arithmetic; and so do its
/// contacts. Returns whether they overlap.
fn is_exact(corners: [Vec3; 3], body: &Shape3, at: DVec3) -> bool {
    let mesh: Shape3 = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap().into();
    let alone: Shape3 = Triangle3::new(corners[0], corners[1], corners[2]).unwrap().into();
    let there = Pose3::at(at).unwrap();
    let exact = exact_overlap3((&alone, &Pose3::IDENTITY), (body, &there));
    for pair in
        [Pair3::new(&mesh, &Pose3::IDENTITY, body, &there), Pair3::new(body, &there, &mesh, &Pose3::IDENTITY)]
    {
        assert_eq!(pair.overlaps(), exact, "{corners:?} {body:?} {at}");
        // A gap below rounding may have a manifold, but no penetration.
        let is_deep = pair.manifold(0.0).is_some_and(|manifold| manifold.separation <= 0.0);
        assert_eq!(is_deep, exact, "{corners:?} {body:?} {at}");
        assert_eq!(pair.distance().is_none(), exact, "{corners:?} {body:?} {at}");
    }
    exact
}

/// Symptom: a sphere 1e-13 m beside the edge of a triangle of 9 km was reported to touch it. Cause: the error bound was
/// for the rounding of the corner opposite the longest side, and the edge began at another corner.
#[test]
fn spheres_beside_long_edges_are_told_exactly() {
    let ball: Shape3 = Sphere::new(0.5).unwrap().into();
    let wide = [(8000.0, 1000.0, 5500.0), (0.0, 0.0, 0.0), (-3000.0, 500.0, 9000.0)].map(Vec3::from);
    let at = DVec3::new(1.026_545_225_360_259_8, 0.180_000_838_517_409_06, 0.108_049_755_211_172_55);
    assert!(!is_exact(wide, &ball, at));
    let long = [(0.0, 0.0, 0.0), (-60000.0, 10000.0, 55000.0), (0.3, 0.1, 0.7)].map(Vec3::from);
    let at = DVec3::new(-0.392_872_259_568_492, 0.524_562_036_391_308_3, 1.915_332_531_879_336);
    assert!(!is_exact(long, &ball, at));
}

/// The same at random: beside an edge, at its foot near the origin, gaps and depths around what f64 resolves.
#[test]
fn bodies_beside_far_corners_are_told_exactly() {
    let mut random = Random::new(2711);
    let (mut apart, mut touching) = (0, 0);
    for round in 0..6_000 {
        let far = [100.0, 3e3, 8e4][round % 3];
        let mut corner = |size: f64| (random.vector() * size).as_vec3();
        // One corner is near the origin, at any of the three positions.
        let mut corners = [corner(far), corner(1.0), corner(far)];
        corners.rotate_left(round / 3 % 3);
        let near = corners.iter().position(|v| v.length() < 2.0).unwrap();
        let (from, to) = (corners[near].as_dvec3(), corners[(near + 1) % 3].as_dvec3());
        let other = corners[(near + 2) % 3].as_dvec3();
        let along = (to - from).normalize();
        let normal = along.cross(other - from).normalize_or(DVec3::Y);
        // Beyond the edge, or over the face.
        let outwards = along.cross(normal) * [1.0, 0.0][round / 9 % 2];
        let way = (outwards + normal * (0.2 + random.between(0.0, 1.0))).normalize();
        let gap = random.signed() * 1e-16 * far * [1.0, 10.0][round % 2];
        let foot = from + along * random.between(0.5, 2.0);
        let (body, reach): (Shape3, f64) = if round / 18 % 2 == 0 {
            (Sphere::new(0.5).unwrap().into(), 0.5)
        } else {
            let half = Vec3::new(0.5, 0.25, 1.0);
            (Cuboid::from_half_extents(half).unwrap().into(), half.as_dvec3().dot(way.abs()))
        };
        let is_ball = matches!(body, Shape3::Sphere(_));
        // The cuboid's corner that faces the foot is there.
        let at = if is_ball {
            foot + way * (reach + gap)
        } else {
            foot + way * gap + DVec3::new(0.5, 0.25, 1.0) * way.signum()
        };
        *if is_exact(corners, &body, at) { &mut touching } else { &mut apart } += 1;
    }
    assert!(apart > 1_000 && touching > 1_000, "{apart}, {touching}");
}
