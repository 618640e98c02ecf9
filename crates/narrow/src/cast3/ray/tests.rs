//! Rays from edges of ground.

use crate::cast_ray3;
use crate::numbers::Numbers;
use asunder_geometry::glam::{Vec2, Vec3};
use asunder_geometry::{HeightField, Pose3, Ray3, Shape3, TriMesh};

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
