//! Bodies whose centre is beyond a bend or a rim of the ground that they touch. First seen as planks that were driven
//! through a roof's ridge, and crates beside a platform that were thrown onto it.

use asunder_geometry::glam::{DVec3, Quat, Vec2, Vec3};
use asunder_geometry::{Cuboid, HeightField, Pose3, Shape3, TriMesh};
use asunder_narrow::Pair3;

/// A roof with its ridge along z, above x = 0, in cells of `cell` metres.
fn roof(slope: f32, cell: f32) -> (Shape3, Pose3) {
    let n = (8.0 / cell) as usize + 1;
    let height = |i: usize| -slope * ((i % n) as f32 * cell - 4.0).abs();
    let heights: Vec<f32> = (0..n * n).map(height).collect();
    (
        HeightField::new(n, n, heights, Vec2::splat(cell)).unwrap().into(),
        Pose3::at([-4.0, 0.0, -4.0]).unwrap(),
    )
}

/// The same triangles as a mesh.
fn as_mesh(field: &Shape3) -> Shape3 {
    let ground = asunder_geometry::Ground::of(field).unwrap();
    let corners = (0..ground.triangle_count()).flat_map(|triangle| ground.corners(triangle));
    let triangles: Vec<[u32; 3]> =
        (0..ground.triangle_count()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriMesh::new(corners.collect::<Vec<_>>(), triangles).unwrap().into()
}

#[test]
fn what_lies_across_a_ridge_is_above_the_slope_beyond_it() {
    let mut shown = 0;
    for (slope, cell) in [(0.3, 1.0), (0.3, 0.5), (1.0, 0.25)] {
        let (field, here) = roof(slope, cell);
        let mesh = as_mesh(&field);
        for half in [Vec3::new(2.0, 0.05, 0.3), Vec3::new(1.5, 0.2, 0.2), Vec3::splat(0.5)] {
            let plank = Shape3::from(Cuboid::from_half_extents(half).unwrap());
            for step in 0..40 {
                let (aside, sunk) = (f64::from(step) * 0.045 - 0.9, [1e-6, 1e-4, 3e-3][step as usize % 3]);
                if aside.abs() > f64::from(half.x) - 0.1 {
                    continue;
                }
                let place = DVec3::new(aside, f64::from(half.y) - sunk, 0.03);
                let there = Pose3::new(place, Quat::from_rotation_y(0.3 * (step % 4) as f32)).unwrap();
                for ground in [&field, &mesh] {
                    let manifolds = Pair3::new(ground, &here, &plank, &there).manifolds(0.0);
                    assert!(!manifolds.is_empty(), "{slope} {cell} {half} {aside}");
                    for manifold in manifolds {
                        let depth = -f64::from(manifold.separation);
                        let is_up = manifold.normal.y > 0.5;
                        assert!(
                            is_up && depth <= 1.001 * sunk + 1e-6,
                            "{slope} {cell} {half} {aside}: {manifold:?}"
                        );
                        shown += 1;
                    }
                }
            }
        }
    }
    assert!(shown > 500, "{shown}");
}

#[test]
fn a_crate_beside_a_rim_is_pushed_aside_and_not_onto_it() {
    let corners = [(-2.0, -2.0), (-2.0, 2.0), (0.0, -2.0), (0.0, 2.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let platform = TriMesh::new(corners, [[0, 1, 2], [2, 1, 3]]).unwrap();
    let cube = Shape3::from(Cuboid::from_half_extents(Vec3::splat(0.5)).unwrap());
    for ground in [Shape3::from(platform.clone()), platform.one_sided().into()] {
        // Sines of the angles by which the crate leans away.
        for lean in [-0.1, 0.0, 1e-6, 1e-3, 0.01, 0.1, 0.5_f64] {
            for up in [0.05, 0.3] {
                let cosine = (1.0 - lean * lean).sqrt();
                let (aside, above) = (DVec3::new(cosine, -lean, 0.0), DVec3::new(lean, cosine, 0.0));
                let place = aside * (0.5 - 1e-4) + above * up;
                let there = Pose3::new(place, Quat::from_rotation_arc(Vec3::X, aside.as_vec3())).unwrap();
                for manifold in Pair3::new(&ground, &Pose3::IDENTITY, &cube, &there).manifolds(0.0) {
                    let off = (manifold.normal.as_dvec3() - aside).length();
                    let depth = f64::from(manifold.separation) + 1e-4;
                    assert!(off < 1e-5 && depth.abs() < 1e-6, "{lean} {up}: {manifold:?}");
                }
            }
        }
    }
}
