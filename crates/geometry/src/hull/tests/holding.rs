//! Tests of `Hull::contains`: the shortcut by faces agrees with a test of every triangle.

use super::clouds::{Random, nasty};
use crate::hull::Hull;
use crate::hull::predicate::outside;
use crate::hull::wrap::enumerate_facets;
use glam::{DVec3, Vec3};

#[test]
fn faces_tell_what_all_triangles_tell() {
    let (mut inside, mut outside) = (0, 0);
    for seed in 0..320 {
        let Ok(hull) = Hull::of_any_dimension(&nasty(seed)) else { continue };
        let size = hull.outer_radius();
        let hull = if seed % 2 == 0 { hull } else { hull.clone().rounded(0.1 * size).unwrap_or(hull) };
        let (radius, mut random) = (f64::from(hull.radius()), Random::new(seed));
        for round in 0..150 {
            // On a corner, an edge, a face or between, and beside it.
            let mut corner = || hull.vertices()[random.below(hull.vertices().len())].as_dvec3();
            let on = corner().lerp(corner(), [0.0, 0.25, 0.5][round % 3]);
            let on = on.lerp(corner(), [0.0, 0.0, 0.3, 0.5][round % 4]);
            let away = [0.0, 1e-16, 1e-12, 1e-7, 0.1, 0.5, 2.0][round % 7] * f64::from(size);
            let p = on + random.vector().as_dvec3() * away;
            let expected = match hull.dimension() < 3 && radius == 0.0 {
                true => hull.data.bears(p),
                false if radius == 0.0 => !hull.data.surface().is_outside(p),
                false => hull.data.surface().distance_outside(p) <= radius,
            };
            assert_eq!(hull.contains(p), expected, "{p} of seed {seed}");
            inside += u32::from(expected);
            outside += u32::from(!expected);
            assert!(!hull.contains(p.with_y(f64::NAN)) && !hull.contains(DVec3::NEG_INFINITY));
        }
    }
    assert!(inside > 10_000 && outside > 10_000, "{inside} inside, {outside} outside");
}

/// Against determinants with the facets of gift wrapping, also where faces are merged.
#[test]
fn a_hull_holds_what_no_exact_facet_has_outside() {
    let (mut inside, mut between, mut merged) = (0, 0, 0);
    for seed in 0..600 {
        let mut random = Random::new(seed);
        // Plates from thicker than rounding down to no more than that, and turned lattices.
        let thickness = [1.0, 1e-3, 1e-5, 1e-6, 3e-7][seed as usize % 5];
        let turn = random.turn();
        let points: Vec<Vec3> = (0..12 + random.below(20))
            .map(|i| match seed % 3 {
                0 => Vec3::new((i % 3) as f32, (i / 3 % 3) as f32, (i / 9) as f32 * thickness),
                1 => random.vector() * Vec3::new(1.0, 1.0, thickness),
                _ => random.vector().with_z(0.0).normalize() + Vec3::Z * (thickness * (i % 2) as f32),
            })
            .map(|point| turn * point)
            .collect();
        let Ok(hull) = Hull::from_points(&points) else { continue };
        let vertices = hull.vertices().to_vec();
        let facets = enumerate_facets(&vertices).unwrap();
        merged += usize::from(facets.len() > hull.topology().face_count());
        for round in 0..60 {
            let weights = [0; 3].map(|_| random.vector().x.abs());
            let mut corner = || vertices[random.below(vertices.len())];
            let mean = (corner() * weights[0] + corner() * weights[1] + corner() * weights[2])
                / weights.iter().sum::<f32>();
            let p = mean + random.vector() * [0.0, 1e-8, 1e-7, 1e-6, 0.1][round % 5];
            let with: Vec<Vec3> = vertices.iter().copied().chain([p]).collect();
            let is_outside = facets
                .iter()
                .any(|facet| outside(&with, [facet[0], facet[1], facet[2]], vertices.len() as u32) > 0.0);
            assert_eq!(hull.contains(p), !is_outside, "{p:?} of seed {seed}: {points:?}");
            inside += usize::from(!is_outside);
            // Points that are in front of no face, measured from all of its corners.
            let height = |normal: &DVec3, face: usize| {
                let corners = hull.topology().face_vertices(face);
                corners.map(|i| normal.dot((p - vertices[i]).as_dvec3())).fold(f64::INFINITY, f64::min)
            };
            let is_behind_faces =
                hull.normals().iter().enumerate().all(|(face, normal)| height(normal, face) <= 0.0);
            between += usize::from(is_outside && is_behind_faces);
        }
    }
    assert!(
        inside > 3000 && between > 300 && merged > 100,
        "{inside} inside, {between} beside merged faces, {merged} with them"
    );
}

/// Points off the surface by as little as f64 resolves, against integers and every plane through three vertices.
#[test]
fn a_hull_of_integers_holds_what_integers_say() {
    const STEPS: f64 = (1_u64 << 60) as f64;
    let (mut inside, mut outside) = (0, 0);
    for seed in 0..300 {
        let mut random = Random::new(seed);
        let points: Vec<Vec3> = (0..12).map(|_| (random.vector() * 3.0).round()).collect();
        let Ok(hull) = Hull::from_points(&points) else { continue };
        let corners: Vec<[i128; 3]> =
            hull.vertices().iter().map(|v| v.to_array().map(|c| c as i128)).collect();
        let planes = planes_around(&corners);
        for round in 0..120 {
            let mut corner = || hull.vertices()[random.below(corners.len())].as_dvec3();
            // On a corner, an edge, a face or between; then moved by the least step, or not.
            let on = corner().lerp(corner(), [0.0, 0.25, 0.5][round % 3]);
            let on = on.lerp(corner(), [0.0, 0.0, 0.25, 0.5][round % 4]);
            let off = |c: f64, way: usize| {
                let least = if c == 0.0 { 1.0 / STEPS } else { c.abs().next_up() - c.abs() };
                c + least * (way as f64 - 1.0)
            };
            let p = DVec3::from_array(on.to_array().map(|c| off(c, random.below(3))));
            let steps = p.to_array().map(|c| (c * STEPS) as i128);
            assert_eq!(p.to_array(), steps.map(|c| c as f64 / STEPS), "no bit is lost");
            let height = |[normal, at]: &[[i128; 3]; 2]| -> i128 {
                (0..3).map(|i| normal[i] * (steps[i] - (at[i] << 60))).sum()
            };
            let is_outside = planes.iter().any(|plane| height(plane) > 0);
            assert_eq!(hull.contains(p), !is_outside, "{p:?} of seed {seed}: {points:?}");
            inside += usize::from(!is_outside);
            outside += usize::from(is_outside);
        }
    }
    assert!(inside > 5000 && outside > 5000, "{inside} inside, {outside} outside");
}

/// Outward normals and a point of each plane through three corners without corners in front.
fn planes_around(corners: &[[i128; 3]]) -> Vec<[[i128; 3]; 2]> {
    let less = |a: [i128; 3], b: [i128; 3]| [0, 1, 2].map(|i| a[i] - b[i]);
    let dot = |a: [i128; 3], b: [i128; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut planes = Vec::new();
    for &a in corners {
        for &b in corners {
            for &c in corners {
                let (u, v) = (less(b, a), less(c, a));
                let normal =
                    [0, 1, 2].map(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]);
                if normal != [0; 3] && corners.iter().all(|&d| dot(normal, less(d, a)) <= 0) {
                    planes.push([normal, a]);
                }
            }
        }
    }
    planes
}
