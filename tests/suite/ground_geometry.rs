//! Meshes and height fields as a game uses them: stored and loaded, with two million triangles, and under rays that
//! parry3d casts, too. Their other properties are compared with plain loops in the geometry crate.

use asunder::tolerance::MAX_TRIANGLES;
use asunder::{
    DroppedTriangles, Ground, HeightField, HeightFieldError, MassError, MeshError, Pair3, Pose3, Ray3,
    Shape3, Sphere, TriMesh, cast_ray3,
};
use asunder_tests::cases::Random;
use glam::{DVec3, Vec2, Vec3};
use serde_json::json;

/// Rolling land of `side` by `side` cells, with some vertices duplicated, and some triangles, too.
fn land(random: &mut Random, side: u32) -> TriMesh {
    let vertex = |number: u32| {
        let (x, z) = (number % (side + 1), number / (side + 1));
        Vec3::new(x as f32, (x * z % 7) as f32 * 0.3, z as f32)
    };
    let mut vertices: Vec<Vec3> = (0..(side + 1) * (side + 1)).map(vertex).collect();
    let mut triangles = vec![];
    for cell in 0..side * side {
        let near = cell / side * (side + 1) + cell % side;
        let far = near + side + 1;
        triangles.extend([[near, far, near + 1], [near + 1, far, far + 1]]);
    }
    for _ in 0..side {
        let corner = random.below(3 * triangles.len());
        let copied = vertices[triangles.as_flattened()[corner] as usize];
        triangles.as_flattened_mut()[corner] = vertices.len() as u32;
        vertices.push(copied);
        triangles.push(triangles[random.below(triangles.len())]);
        triangles.push([3, 3, random.below(vertices.len()) as u32]);
    }
    TriMesh::new(vertices, triangles).unwrap()
}

fn field(random: &mut Random, columns: usize, rows: usize) -> HeightField {
    let heights: Vec<f32> = (0..columns * rows).map(|_| random.signed() as f32).collect();
    let field = HeightField::new(columns, rows, heights, Vec2::new(0.7, 1.3)).unwrap();
    field.with_holes((0..5).map(|_| (random.below(columns - 1), random.below(rows - 1)))).unwrap()
}

/// Everything that ground reports about itself.
fn told(shape: &Shape3) -> String {
    let ground = Ground::of(shape).unwrap();
    let of = |number: u32| {
        let neighbors = [0, 1, 2].map(|edge| ground.neighbor(number, edge));
        let (marks, patch) = (ground.prominent(number), ground.patch(number));
        format!(
            "{:?} {:?} {neighbors:?} {marks:?} {patch}",
            ground.triangle(number),
            ground.vertex_numbers(number)
        )
    };
    let mut text: Vec<String> = (0..ground.triangle_count()).map(of).collect();
    let mut met = vec![];
    ground.visit_along(DVec3::new(-1.0, 0.5, -1.0), DVec3::new(1.0, 0.0, 0.8), Vec3::ONE, 1e3, |number| {
        met.push(number);
        1e3
    });
    text.push(format!("{met:?} {:?} {} {}", shape.center(), shape.outer_radius(), ground.is_one_sided()));
    text.join("\n")
}

#[test]
fn ground_comes_back_in_every_bit_and_says_the_same() {
    let random = &mut Random::new(800);
    let (mesh, field) = (land(random, 20), field(random, 9, 14));
    assert!(mesh.dropped().degenerate >= 20 && mesh.dropped().duplicate >= 15, "{:?}", mesh.dropped());
    let shapes: [Shape3; 5] = [
        mesh.clone().into(),
        mesh.one_sided().into(),
        field.clone().into(),
        field.one_sided().into(),
        HeightField::new(2, 2, [-0.0, 0.0, 1e-40, -1e5], Vec2::splat(1e4)).unwrap().into(),
    ];
    for shape in shapes {
        let text = serde_json::to_string(&shape).unwrap();
        let back: Shape3 = serde_json::from_str(&text).unwrap();
        assert_eq!(back, shape);
        assert_eq!(told(&back), told(&shape));
        assert_eq!(serde_json::to_string(&back).unwrap(), text);
    }
}

#[test]
fn stored_ground_that_is_none_is_refused_by_what_its_constructor_says() {
    let refused = |value| serde_json::from_value::<Shape3>(value).unwrap_err().to_string();
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let mesh = |triangles| json!({ "TriMesh": { "vertices": corners, "triangles": triangles } });
    let field = |heights, holes| {
        json!({ "HeightField": {
            "columns": 2, "rows": 2, "cell": [1.0, 1.0], "heights": heights, "holes": holes
        } })
    };
    let missing = MeshError::NoSuchVertex { triangle: 1, vertex: 7, count: 3 };
    assert_eq!(refused(mesh(json!([[0, 2, 1], [0, 1, 7]]))), missing.to_string());
    assert_eq!(refused(mesh(json!([]))), MeshError::NoTriangles.to_string());
    let count = HeightFieldError::Count { columns: 2, rows: 2, heights: 3 };
    assert_eq!(refused(field(json!([0.0, 0.0, 0.0]), json!([]))), count.to_string());
    let hole = HeightFieldError::NoSuchCell { column: 1, row: 0 };
    assert_eq!(refused(field(json!([0.0, 0.0, 0.0, 0.0]), json!([[1, 0]]))), hole.to_string());
    assert!(
        serde_json::from_value::<Shape3>(mesh(json!([[0, 2, 1]]))).is_ok(),
        "the others were refused for a reason"
    );
    assert!(serde_json::from_value::<Shape3>(field(json!([0.0, 0.0, 0.0, 0.0]), json!([]))).is_ok());
}

#[test]
fn a_million_triangles_take_less_than_100_bytes_each() {
    let mesh = land(&mut Random::new(801), 707);
    let count = mesh.triangles().len();
    // 12 of them for corners in the leaves of the tree, which make rays half as fast again.
    assert!(count > 1_000_000 && mesh.bytes() < 82 * count, "{} of {count}", mesh.bytes());
    // Nothing shared, as careless exporters write it.
    let corners: Vec<Vec3> =
        mesh.triangles().as_flattened().iter().map(|&vertex| mesh.vertices()[vertex as usize]).collect();
    let triangles: Vec<[u32; 3]> = (0..count as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let soup = TriMesh::new(corners, triangles).unwrap();
    assert!(soup.bytes() < 100 * count, "{} of {count}", soup.bytes());
    // The greatest number of vertices for which the tree holds corners.
    let mut spare = mesh.vertices().to_vec();
    spare.resize(2 * count, Vec3::ZERO);
    let spare = TriMesh::new(spare, mesh.triangles()).unwrap();
    assert!(spare.bytes() < 100 * count, "{} of {count}", spare.bytes());
    // Which triangles are dropped, joined and coplanar does not depend on how vertices were given.
    assert_eq!(soup.dropped(), mesh.dropped());
    let shapes = [Shape3::from(mesh), Shape3::from(soup)];
    let [Some(one), Some(other)] = [Ground::of(&shapes[0]), Ground::of(&shapes[1])] else { panic!() };
    for number in 0..count as u32 {
        assert_eq!(one.neighbor(number, 1), other.neighbor(number, 1));
        assert_eq!(
            (one.prominent(number), one.patch(number)),
            (other.prominent(number), other.patch(number))
        );
    }
}

/// As many triangles as a mesh may have, no two coplanar: the last is hit under its number.
#[test]
fn the_last_of_two_million_triangles_is_met_by_its_number() {
    const SIDE: u32 = 1000;
    let vertex = |number: u32| {
        let (x, z) = (number % (SIDE + 1), number / (SIDE + 1));
        Vec3::new(x as f32, (x * z % 7) as f32 * 0.3, z as f32)
    };
    let vertices: Vec<Vec3> = (0..(SIDE + 1) * (SIDE + 1)).map(vertex).collect();
    let mut triangles = vec![];
    for cell in 0..SIDE * SIDE {
        let near = cell / SIDE * (SIDE + 1) + cell % SIDE;
        let far = near + SIDE + 1;
        triangles.extend([[near, far, near + 1], [near + 1, far, far + 1]]);
    }
    assert_eq!(triangles.len(), MAX_TRIANGLES);
    let mesh = TriMesh::new(vertices, triangles).unwrap();
    assert_eq!(mesh.dropped(), DroppedTriangles::default());
    assert!(mesh.bytes() < 100 * MAX_TRIANGLES, "{}", mesh.bytes());

    let (ground, here) = (Shape3::from(mesh), Pose3::at([0.3, -0.2, 0.1]).unwrap());
    let ball = Shape3::from(Sphere::new(0.1).unwrap());
    for number in [0, 999_999, 1_000_000, MAX_TRIANGLES as u32 - 2, MAX_TRIANGLES as u32 - 1] {
        let corners = Ground::of(&ground).unwrap().corners(number).map(|corner| corner.as_dvec3());
        let middle = here.transform(corners.into_iter().sum::<DVec3>() / 3.0);
        let touching = Pose3::at(middle + DVec3::Y * 0.099).unwrap();
        let manifolds = Pair3::new(&ground, &here, &ball, &touching).manifolds(0.01);
        assert_eq!(manifolds.iter().map(|manifold| manifold.part_a).collect::<Vec<_>>(), [number]);
        let above = middle + DVec3::Y * 3.0;
        let hit = cast_ray3(&ground, &here, &Ray3::new(above, Vec3::NEG_Y).unwrap(), 10.0).unwrap();
        assert_eq!(hit.part, number);
        let above = Pose3::at(above).unwrap();
        let impact = Pair3::new(&ball, &above, &ground, &here).cast(Vec3::NEG_Y * 10.0).unwrap();
        assert_eq!((impact.part_a, impact.part_b), (0, number));
    }
}

#[test]
fn rays_meet_the_triangle_that_parry_says() {
    use parry3d::query::RayCast;
    let random = &mut Random::new(802);
    let shape = Shape3::from(land(random, 60));
    let (ground, Shape3::TriMesh(mesh)) = (Ground::of(&shape).unwrap(), &shape) else { panic!() };
    let theirs = parry3d::shape::TriMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
    let mut met = 0;
    for _ in 0..3000 {
        let from =
            DVec3::new(random.signed(), random.signed() * 0.2, random.signed()) * 40.0 + DVec3::splat(20.0);
        let along = random.vector();
        let ray = parry3d::query::Ray::new(from.as_vec3(), along.as_vec3());
        let wanted = theirs.cast_ray(&parry3d::math::Pose::IDENTITY, &ray, 100.0, false);
        let mut best = 100.0;
        ground.visit_along(from, along, Vec3::ZERO, best, |number| {
            let [a, b, c] = ground.corners(number).map(|corner| corner.as_dvec3());
            let normal = (b - a).cross(c - a);
            let time = (a - from).dot(normal) / along.dot(normal);
            let point = from + along * time;
            let inside = |from: DVec3, to: DVec3| (to - from).cross(point - from).dot(normal) >= 0.0;
            if time >= 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
                best = time.min(best);
            }
            best
        });
        let Some(wanted) = wanted else { continue };
        // Nearer, where parry's ray slips through an edge in f32.
        assert!(best <= f64::from(wanted) * (1.0 + 1e-4) + 1e-4, "{best} {wanted}");
        met += usize::from((best - f64::from(wanted)).abs() < 1e-3);
    }
    assert!(met > 300, "{met}");
}

#[test]
fn ground_has_no_mass_and_its_parts_are_told_of() {
    let random = &mut Random::new(803);
    for shape in [Shape3::from(land(random, 4)), Shape3::from(field(random, 4, 4))] {
        assert_eq!(shape.mass_properties(1000.0), Err(MassError::Ground));
        assert!(matches!(shape.mass_properties(-1.0), Err(MassError::Density { .. })));
        assert!(shape.is_ground() && shape.radius() == 0.0);
        let bounds = shape.bounds(&Pose3::IDENTITY, 0.0);
        let highest = shape.support(DVec3::Y).unwrap();
        assert!((highest.y - f64::from(bounds.max.y)).abs() < 1e-5);
    }
    assert_ne!(land(random, 4).dropped(), DroppedTriangles::default());
}
