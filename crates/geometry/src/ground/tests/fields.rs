//! Tests of height fields against meshes of the same triangles.

use super::Dice;
use crate::aabb::Aabb3;
use crate::ground::Ground;
use crate::height_field::{HeightField, HeightFieldError};
use crate::mesh::TriMesh;
use crate::pose3::Pose3;
use crate::shape::Shape3;
use core::ops::ControlFlow;
use glam::{DVec3, Quat, Vec2, Vec3};

/// Rough, flat and holed in parts.
pub(super) fn random(columns: usize, rows: usize, seed: u64) -> HeightField {
    let mut dice = Dice::new(seed);
    let mut heights: Vec<f32> = (0..columns * rows).map(|_| dice.between(-1.0, 1.5)).collect();
    for height in &mut heights {
        if dice.below(3) > 0 {
            *height = (*height * 1.5).round() * 0.5;
        }
    }
    let cell = [Vec2::ONE, Vec2::new(0.3, 0.7), Vec2::new(13.1, 0.1)][seed as usize % 3];
    let field = HeightField::new(columns, rows, heights, cell).unwrap();
    let mut holes = vec![];
    for _ in 0..(columns - 1) * (rows - 1) / 6 {
        holes.push((dice.below(columns as u32 - 1) as usize, dice.below(rows as u32 - 1) as usize));
    }
    field.with_holes(holes).unwrap()
}

/// The same as a mesh; dropped triangles at holes keep the numbering.
fn as_mesh(field: &HeightField) -> TriMesh {
    let (columns, rows) = (field.columns(), field.rows());
    let mut vertices = vec![];
    for row in 0..rows {
        for column in 0..columns {
            let height = field.heights()[row * columns + column];
            vertices.push(Vec3::new(column as f32 * field.cell().x, height, row as f32 * field.cell().y));
        }
    }
    let mut triangles = vec![];
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let near = (row * columns + column) as u32;
            let far = near + columns as u32;
            if field.is_hole(column, row) {
                triangles.extend([[near; 3]; 2]);
            } else {
                triangles.extend([[near, far, near + 1], [near + 1, far, far + 1]]);
            }
        }
    }
    TriMesh::new(vertices, triangles).unwrap()
}

fn several() -> Vec<HeightField> {
    let mut fields: Vec<HeightField> =
        (0..12).map(|seed| random(2 + seed * 5 % 17, 2 + seed * 3 % 19, seed as u64)).collect();
    fields.push(HeightField::new(30, 20, [0.25; 600], Vec2::new(0.1, 2.0)).unwrap());
    let steps: Vec<f32> = (0..400).map(|i| (i % 20 / 4) as f32).collect();
    fields.push(HeightField::new(20, 20, steps, Vec2::ONE).unwrap().one_sided());
    fields
}

#[test]
fn a_field_is_what_a_mesh_of_its_triangles_is() {
    let mut counts = [0; 3];
    for field in several() {
        let mesh = as_mesh(&field);
        let mesh = if field.is_one_sided() { mesh.one_sided() } else { mesh };
        let shapes = [Shape3::from(field.clone()), Shape3::from(mesh)];
        let [Some(field), Some(mesh)] = [Ground::of(&shapes[0]), Ground::of(&shapes[1])] else { panic!() };
        assert_eq!(field.triangle_count(), mesh.triangle_count());
        assert_eq!(field.is_one_sided(), mesh.is_one_sided());
        for number in 0..field.triangle_count() + 3 {
            assert_eq!(field.triangle(number), mesh.triangle(number), "{number}");
            assert_eq!(field.patch(number), mesh.patch(number), "{number}");
            assert_eq!(field.prominent(number), mesh.prominent(number), "{number}");
            for edge in 0..4 {
                assert_eq!(field.neighbor(number, edge), mesh.neighbor(number, edge), "{number} {edge}");
            }
            if mesh.triangle(number).is_some() {
                assert_eq!(field.corners(number), mesh.corners(number));
                assert_eq!(field.vertex_numbers(number), mesh.vertex_numbers(number));
                counts[0] += 1;
                counts[1] += usize::from(field.patch(number) != number);
                counts[2] += usize::from(!field.prominent(number).any(true));
            }
        }
        let pose = Pose3::new([1.0, 2.0, 3.0], Quat::from_xyzw(0.1, 0.7, -0.4, 0.3)).unwrap();
        for pose in [Pose3::IDENTITY, pose] {
            assert_eq!(shapes[0].bounds(&pose, 0.1), shapes[1].bounds(&pose, 0.1));
        }
        let of = |shape: &Shape3| (shape.center(), shape.outer_radius());
        assert_eq!(of(&shapes[0]), of(&shapes[1]));
        assert_eq!(
            shapes[0].support(DVec3::new(0.3, -0.2, 0.1)),
            shapes[1].support(DVec3::new(0.3, -0.2, 0.1))
        );
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}

#[test]
fn a_field_finds_what_a_mesh_of_its_triangles_finds() {
    let mut counts = [0; 3];
    for (index, field) in several().into_iter().enumerate() {
        let shapes = [Shape3::from(field.clone()), Shape3::from(as_mesh(&field))];
        let [Some(field), Some(mesh)] = [Ground::of(&shapes[0]), Ground::of(&shapes[1])] else { panic!() };
        let mut dice = Dice::new(index as u64);
        let size = shapes[0].outer_radius();
        for round in 0..100 {
            let mut part = || dice.between(-1.1, 1.1);
            let low = shapes[0].center() + Vec3::new(part(), part() * 0.3, part()) * size;
            let bounds = Aabb3::new(low, low + size * [0.0, 0.1, 1.0][round % 3]);
            let near = |ground: Ground<'_>| {
                let mut found = vec![];
                let _ = ground.visit_near(&bounds, |number| {
                    found.push(number);
                    ControlFlow::Continue(())
                });
                found.sort_unstable();
                found
            };
            assert_eq!(near(field), near(mesh));
            counts[0] += near(field).len();
            let point = Vec3::new(low.x, low.y, low.z).as_dvec3();
            let height = match &shapes[0] {
                Shape3::HeightField(field) => field.height_at(point.x, point.z),
                _ => None,
            };
            let above = |ground: Ground<'_>| {
                let mut found = vec![];
                ground.visit_along(point.with_y(9.0), DVec3::NEG_Y, Vec3::ZERO, 100.0, |number| {
                    found.push(number);
                    100.0
                });
                found.sort_unstable();
                found
            };
            assert_eq!(height.is_none(), above(field).is_empty() && above(mesh).is_empty(), "{point}");
            let Some(height) = height else { continue };
            counts[1] += 1;
            // On one of the triangles below it, up to an f32 rounding.
            let triangles = above(mesh).into_iter().filter_map(|number| mesh.triangle(number));
            let is_on = |triangle: crate::Triangle3| {
                let [normal, _] = triangle.normals();
                let there = DVec3::new(point.x, f64::from(height), point.z);
                (normal.dot(there - triangle.vertices()[0].as_dvec3()) / normal.y).abs() < 1e-6
            };
            assert!(triangles.into_iter().any(is_on), "{point} {height}");
        }
        for number in 0..field.triangle_count() {
            let Some(triangle) = field.triangle(number) else { continue };
            let [a, b, c] = triangle.vertices().map(|corner| corner.as_dvec3());
            for point in [a, (a + b) * 0.5, (b + c) * 0.5, (a + b + c) / 3.0] {
                assert_eq!(shapes[0].contains(point), shapes[1].contains(point));
                counts[2] += usize::from(shapes[0].contains(point));
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}");
}

#[test]
fn a_flat_field_is_one_patch() {
    let field = HeightField::new(100, 90, vec![3.0; 9000], Vec2::new(0.1, 0.3)).unwrap();
    assert!((0..field.triangle_count()).all(|number| field.patch(number) == 0));
    assert!(
        (0..field.triangle_count()).filter(|&number| field.prominent(number).any_edge(true)).count() < 400
    );
}

#[test]
fn heights_at_vertices_are_the_heights_given() {
    let field = random(23, 17, 1);
    let mut seen = 0;
    for row in 0..17 {
        for column in 0..23 {
            let (x, z) = (column as f32 * field.cell().x, row as f32 * field.cell().y);
            if let Some(height) = field.height_at(x, z) {
                let given = field.heights()[row * 23 + column];
                assert!((height - given).abs() <= 1e-6, "{height} is not {given}");
                seen += 1;
            }
        }
    }
    assert!(seen > 300);
    assert_eq!([f64::NAN, f64::INFINITY, -0.001, 1e300].map(|x| field.height_at(x, 0.5)), [None; 4]);
}

#[test]
fn other_heights_are_those_of_a_field_made_anew() {
    for seed in 0..24 {
        let (columns, rows) = (2 + seed as usize % 5, 3 + seed as usize % 3);
        let [field, other] = [seed, seed + 100].map(|seed| random(columns, rows, seed));
        let field = if seed % 2 == 0 { field.one_sided() } else { field };
        let anew = HeightField::new(columns, rows, other.heights(), field.cell()).unwrap();
        let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (column, row)));
        let holes: Vec<_> = cells.filter(|&(column, row)| field.is_hole(column, row)).collect();
        let anew = if holes.is_empty() { anew } else { anew.with_holes(holes).unwrap() };
        let anew = if field.is_one_sided() { anew.one_sided() } else { anew };
        let changed = field.clone().with_heights(other.heights()).unwrap();
        assert_eq!(changed, anew, "seed {seed}");

        let [one, two] = [changed.clone(), anew].map(Shape3::from);
        let [one, two] = [&one, &two].map(|shape| Ground::of(shape).unwrap());
        for triangle in 0..one.triangle_count() {
            assert_eq!(one.prominent(triangle), two.prominent(triangle), "seed {seed}, triangle {triangle}");
            assert_eq!(one.patch(triangle), two.patch(triangle), "seed {seed}, triangle {triangle}");
        }
        assert_eq!(changed.with_heights(field.heights()).unwrap(), field, "and back");
        let short = &other.heights()[1..];
        assert!(matches!(field.with_heights(short), Err(HeightFieldError::Count { .. })));
    }
}
