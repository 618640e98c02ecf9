//! Tests of input that is rejected as ground.

use crate::height_field::{HeightField, HeightFieldError};
use crate::mesh::{MeshError, TriMesh};
use crate::tolerance::{MAX_MESH_VERTICES, MAX_TRIANGLES};
use glam::{Vec2, Vec3};

#[test]
fn bad_meshes_are_refused_by_what_is_wrong() {
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Z];
    let with = |vertex: Vec3| TriMesh::new([Vec3::ZERO, Vec3::X, vertex], [[0, 1, 2]]).unwrap_err();
    assert_eq!(with(Vec3::new(0.0, f32::NAN, 0.0)), MeshError::NotFinite { vertex: 2 });
    assert_eq!(with(Vec3::new(0.0, f32::NEG_INFINITY, 0.0)), MeshError::NotFinite { vertex: 2 });
    assert_eq!(with(Vec3::new(0.0, 8e5, 8e5)), MeshError::TooLarge { vertex: 2 });
    assert_eq!(with(Vec3::splat(f32::MAX)), MeshError::TooLarge { vertex: 2 });
    let refused = |triangles: &[[u32; 3]]| TriMesh::new(corners, triangles).unwrap_err();
    assert_eq!(refused(&[]), MeshError::NoTriangles);
    assert_eq!(refused(&[[0, 0, 1], [2, 2, 2]]), MeshError::NoTriangles);
    let missing = MeshError::NoSuchVertex { triangle: 1, vertex: u32::MAX, count: 3 };
    assert_eq!(refused(&[[0, 1, 2], [0, u32::MAX, 2]]), missing);
    assert_eq!(
        TriMesh::new([], [[0, 1, 2]]).unwrap_err(),
        MeshError::NoSuchVertex { triangle: 0, vertex: 0, count: 0 }
    );
    let many = vec![[0, 1, 2]; MAX_TRIANGLES + 1];
    assert_eq!(refused(&many), MeshError::TooManyTriangles { count: MAX_TRIANGLES + 1 });
    let many = TriMesh::new(vec![Vec3::ZERO; MAX_MESH_VERTICES + 1], [[0, 1, 2]]).unwrap_err();
    assert_eq!(many, MeshError::TooManyVertices { count: MAX_MESH_VERTICES + 1 });
    // Below the least radius, and a line.
    let small = corners.map(|corner| corner * 1e-7);
    assert_eq!(TriMesh::new(small, [[0, 2, 1]]).unwrap_err(), MeshError::NoTriangles);
    let line = [Vec3::ZERO, Vec3::X, Vec3::X * 3.0];
    assert_eq!(TriMesh::new(line, [[0, 2, 1]]).unwrap_err(), MeshError::NoTriangles);
}

#[test]
fn bad_fields_are_refused_by_what_is_wrong() {
    use HeightFieldError as Error;
    let refused =
        |columns, rows, heights: Vec<f32>, cell| HeightField::new(columns, rows, heights, cell).unwrap_err();
    for (columns, rows) in [(0, 0), (1, 5), (5, 1), (4098, 2), (usize::MAX, usize::MAX)] {
        assert_eq!(refused(columns, rows, vec![0.0; 4], Vec2::ONE), Error::Sides { columns, rows });
    }
    assert_eq!(refused(3, 2, vec![0.0; 5], Vec2::ONE), Error::Count { columns: 3, rows: 2, heights: 5 });
    for value in [0.0, -1.0, f32::INFINITY] {
        assert_eq!(refused(2, 2, vec![0.0; 4], Vec2::new(1.0, value)), Error::Cell { axis: 1, value });
    }
    assert!(matches!(refused(2, 2, vec![0.0; 4], Vec2::new(f32::NAN, 1.0)), Error::Cell { axis: 0, .. }));
    let heights = |place: usize, height: f32| {
        let mut heights = vec![0.0; 6];
        heights[place] = height;
        heights
    };
    assert_eq!(refused(3, 2, heights(5, f32::NAN), Vec2::ONE), Error::NotFinite { column: 2, row: 1 });
    assert_eq!(refused(3, 2, heights(4, 2e6), Vec2::ONE), Error::TooLarge { column: 1, row: 1 });
    assert_eq!(refused(3, 2, vec![0.0; 6], Vec2::new(6e5, 1.0)), Error::TooLarge { column: 2, row: 0 });
    assert_eq!(refused(3, 2, heights(5, 9e5), Vec2::splat(1e-3)), Error::Degenerate { column: 1, row: 0 });
    assert_eq!(refused(3, 2, vec![0.0; 6], Vec2::new(1e-5, 1e4)), Error::Degenerate { column: 0, row: 0 });
    assert_eq!(refused(3, 2, vec![0.0; 6], Vec2::splat(1e-7)), Error::Degenerate { column: 0, row: 0 });
    assert!(HeightField::new(3, 2, heights(5, 2e3), Vec2::ONE).is_ok(), "steep, and still ground");
    let flat = HeightField::new(3, 2, vec![0.0; 6], Vec2::ONE).unwrap();
    assert_eq!(flat.clone().with_hole(0, 1).unwrap_err(), Error::NoSuchCell { column: 0, row: 1 });
    assert_eq!(
        flat.clone().with_hole(usize::MAX, 0).unwrap_err(),
        Error::NoSuchCell { column: usize::MAX, row: 0 }
    );
    assert_eq!(flat.with_holes([(0, 0), (1, 0)]).unwrap_err(), Error::NoGround);
}

#[test]
fn refusals_say_what_to_do() {
    for error in [
        MeshError::TooManyTriangles { count: 3 },
        MeshError::NoSuchVertex { triangle: 7, vertex: 9, count: 3 },
    ] {
        assert!(error.to_string().contains('3'), "{error}");
    }
    assert!(HeightFieldError::Count { columns: 3, rows: 2, heights: 5 }.to_string().contains("5 heights"));
}
