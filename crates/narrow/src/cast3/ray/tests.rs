//! Rays at thin hulls, and from edges of ground.

use super::POINT;
use crate::cast_ray3;
use crate::numbers::Numbers;
use crate::pair3::Pair3;
use asunder_geometry::glam::{DQuat, DVec3, Vec2, Vec3};
use asunder_geometry::{HeightField, Hull, Pose3, Ray3, Shape3, TriMesh};

/// `count` points of a circle about y, in order.
fn ring(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        // By the tangent of half the angle, a quarter after the other.
        let place = 4.0 * i as f64 / count as f64;
        let half = place - place.floor();
        let (x, z) = ((1.0 - half * half) / (1.0 + half * half), 2.0 * half / (1.0 + half * half));
        match place as usize {
            0 => DVec3::new(x, 0.0, z),
            1 => DVec3::new(-z, 0.0, x),
            2 => DVec3::new(-x, 0.0, -z),
            _ => DVec3::new(z, 0.0, -x),
        }
    })
}

/// Corners of one of several kinds of thin shapes.
fn thin(kind: u32, numbers: &mut Numbers) -> Vec<DVec3> {
    let tenths = 1 + numbers.below(16) as i32;
    // From 0.3 down to 1e-8.
    let depth = (0..tenths).fold(1.0, |depth, _| depth * 0.316);
    let count = 3 + numbers.below(30) as usize;
    let corner = |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) - 0.5;
    match kind {
        // Tiles, in one plane up to rounding.
        0 => (0..4 + count % 5).map(|_| numbers.vector() * DVec3::new(1.0, 0.0, 1.0)).collect(),
        1 => ring(count).collect(),
        // Plates, boxes and needles.
        2 => ring(count).flat_map(|at| [at, at + DVec3::Y * depth]).collect(),
        3 => (0..8).map(|i| corner(i) * DVec3::new(1.0, depth, 1.0)).collect(),
        4 => (0..8).map(|i| corner(i) * DVec3::new(1.0, depth, depth)).collect(),
        // Wedges, and needles with points.
        5 => (0..8).map(|i| corner(i) * DVec3::new(1.0, depth * corner(i).z.max(0.0), 1.0)).collect(),
        6 => ring(count % 5 + 3).map(|at| at * depth + DVec3::Y).chain([DVec3::NEG_Y]).collect(),
        // Flat pyramids and lenses.
        7 => ring(count).chain([DVec3::Y * depth]).collect(),
        8 => (0..count + 8).map(|_| numbers.vector().normalize() * DVec3::new(1.0, depth, 1.0)).collect(),
        _ => (0..count).map(|_| numbers.vector()).collect(),
    }
}

/// A place on or in the hull, well inside the rim of all corners.
fn place_in(vertices: &[Vec3], numbers: &mut Numbers) -> DVec3 {
    let weights: Vec<f64> = vertices.iter().map(|_| 1.125 + numbers.number()).collect();
    let sum: f64 = weights.iter().sum();
    vertices.iter().zip(&weights).fold(DVec3::ZERO, |sum, (at, weight)| sum + at.as_dvec3() * *weight) / sum
}

#[test]
fn what_is_hit_of_thin_hulls_is_there_and_what_is_crossed_is_hit() {
    let (mut numbers, mut counts) = (Numbers::new(31), [[0; 3]; 10]);
    for case in 0..4000_u32 {
        let kind = case % 10;
        let [x, y, z, w] = [(); 4].map(|()| numbers.number());
        let turn = DQuat::from_xyzw(x, y, z, w + 0.01).normalize();
        let size = [1.0, 1e-3, 300.0][case as usize / 10 % 3];
        let points: Vec<Vec3> =
            thin(kind, &mut numbers).iter().map(|&at| (turn * at * size).as_vec3()).collect();
        let Ok(hull) = Hull::from_points(&points) else { continue };
        let (outer, center) = (f64::from(hull.outer_radius()), hull.center().as_dvec3());
        let shape = Shape3::from(hull.clone());
        for i in 0..24 {
            let is_aimed = i % 2 == 0;
            let target = if is_aimed {
                place_in(hull.vertices(), &mut numbers)
            } else {
                center + numbers.vector() * outer * 1.1
            };
            let way = (numbers.vector() * size).as_vec3();
            // So that the ray goes through its target up to rounding.
            let origin = target - way.as_dvec3() * (4.0 * outer / f64::from(way.length()));
            let Ok(ray) = Ray3::new(origin, way) else { continue };
            let hit = cast_ray3(&shape, &Pose3::IDENTITY, &ray, f64::INFINITY);
            let context = format!("{kind} {case} {i}: {:?} {ray:?} {hit:?}", hull.vertices());
            counts[kind as usize][0] += 1;
            let Some(hit) = hit else {
                assert!(!is_aimed || !hull.contains(target), "{context}");
                continue;
            };
            counts[kind as usize][if is_aimed { 1 } else { 2 }] += 1;
            let at = Pose3::at(ray.at(hit.distance)).unwrap();
            let beside = Pair3::new(&POINT, &at, &shape, &Pose3::IDENTITY).distance();
            let rounding = 1e-14 * (origin.length() + outer);
            let beside = beside.map_or(0.0, |closest| f64::from(closest.distance - closest.error));
            assert!(beside <= f64::from(hit.error) + rounding, "{beside} {context}");
            // Nor is the error so large that the hit might be anywhere.
            let steep = way.as_dvec3().normalize().dot(hit.normal.as_dvec3()).abs();
            assert!(f64::from(hit.error) * steep <= 1e-5 * outer, "{context}");
        }
    }
    let are_many = |[rays, aimed, beside]: &[u32; 3]| *rays > 4000 && *aimed > 2000 && *beside > 0;
    assert!(counts.iter().all(are_many), "{counts:?}");
}

#[test]
fn a_ray_beside_a_tile_misses_it() {
    let tile = [(0.0, 0.0, 0.0), (1.0, 0.1, 0.3), (1.2, 1.1, 1.0), (0.2, 1.0, 0.7)].map(Vec3::from);
    let shape = Shape3::from(Hull::from_points(&tile).unwrap());
    let ray = Ray3::new([-1.3, 0.2, 0.2], Vec3::new(0.96, 0.12, 0.25)).unwrap();
    assert_eq!(cast_ray3(&shape, &Pose3::IDENTITY, &ray, 100.0), None);
}

#[test]
fn a_ray_from_an_inner_edge_of_ground_starts_on_it() {
    let mut numbers = Numbers::new(32);
    for case in 0..400 {
        let mut off = || numbers.number() as f32 * 0.2;
        let flat = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let corners = flat.map(|(x, z): (f32, f32)| Vec3::new(x + off(), 0.0, z + off()));
        let cell = Vec2::new(1.0 + off(), 1.0 + off());
        let (ground, [from, to]) = if case % 2 == 0 {
            let mesh = TriMesh::new(corners, [[0, 2, 1], [0, 3, 2]]).unwrap();
            (Shape3::from(mesh), [corners[0], corners[2]])
        } else {
            let field = HeightField::new(3, 3, vec![0.0; 9], cell).unwrap();
            (field.into(), [Vec3::X * cell.x, Vec3::Z * cell.y])
        };
        for _ in 0..20 {
            // In the plane of both triangles, and so in one of them, wherever rounding puts it.
            let share = 0.5 + 0.45 * numbers.number();
            let at = from.as_dvec3() * (1.0 - share) + to.as_dvec3() * share;
            for way in [Vec3::X, Vec3::NEG_Z, Vec3::NEG_Y, numbers.vector().as_vec3()] {
                let hit = cast_ray3(&ground, &Pose3::IDENTITY, &Ray3::new(at, way).unwrap(), 100.0).unwrap();
                assert!(hit.inside && hit.distance == 0.0, "{ground:?} {at} {way}: {hit:?}");
            }
        }
    }
}
