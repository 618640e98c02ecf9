//! Contacts on height fields against those on meshes of the same triangles, which a loop over all triangles verifies.

use super::scenes::{BODIES, Random, body, stick};
use asunder_geometry::glam::{Quat, Vec2, Vec3};
use asunder_geometry::{Ground, HeightField, Pose3, Shape3, TriMesh};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, collide3};

/// The mesh of a field's triangles: the same vertices and triangle numbers, with nothing in its holes.
fn as_mesh(field: &HeightField) -> TriMesh {
    let ground = Ground::Field(field);
    let place = |(number, &height): (usize, &f32)| {
        let [column, row] = [number % field.columns(), number / field.columns()].map(|it| it as f32);
        Vec3::new(column * field.cell().x, height, row * field.cell().y)
    };
    let vertices: Vec<Vec3> = field.heights().iter().enumerate().map(place).collect();
    // A hole becomes degenerate triangles, which are dropped: the others keep their numbers.
    let triangle = |number| ground.triangle(number).map_or([0; 3], |_| ground.vertex_numbers(number));
    let triangles: Vec<[u32; 3]> = (0..ground.triangle_count()).map(triangle).collect();
    let mesh = TriMesh::new(vertices, triangles).unwrap();
    for number in 0..ground.triangle_count() {
        assert_eq!(ground.triangle(number), Ground::Mesh(&mesh).triangle(number), "{number}");
    }
    if field.is_one_sided() { mesh.one_sided() } else { mesh }
}

/// Hills and ridges, steps, a plane, a slope with bends about as low as those that count as flat; some with holes.
fn field(random: &mut Random, kind: usize, cells: usize) -> HeightField {
    let side = cells + 1;
    let height = |number: usize, random: &mut Random| match kind {
        0 | 1 => random.signed() * [0.1, 0.6][kind],
        2 => (((number % side) * 5 + (number / side) * 3) % 7) as f64 * 0.25,
        3 => 0.0,
        _ => 0.3 * (number % side) as f64 + random.signed() * 3e-5,
    };
    let heights: Vec<f32> = (0..side * side).map(|number| height(number, random) as f32).collect();
    let field = HeightField::new(side, side, heights, Vec2::new(0.5, 0.4)).unwrap();
    let holes = if random.below(3) == 0 { cells / 2 } else { 0 };
    let field = field.with_holes((0..holes).map(|_| (random.below(cells), random.below(cells)))).unwrap();
    if random.below(2) == 0 { field.one_sided() } else { field }
}

/// Whether the two overlap, if they are in contact, and their manifolds.
type Told = (Option<bool>, Vec<Manifold3>);

fn told([shape_a, shape_b]: [&Shape3; 2], [pose_a, pose_b]: [&Pose3; 2], margin: f32) -> Told {
    let job = Job3 { shape_a, pose_a, shape_b, pose_b, margin, hint: Hint::NONE, ahead: 0.0, sensor: false };
    let mut batch = Batch3::default();
    collide3(&[job], &mut batch);
    let contact = match &batch.answers[0] {
        Answer::Apart { .. } => None,
        Answer::Contact { overlapping, .. } => Some(*overlapping),
    };
    (contact, batch.manifolds.clone())
}

/// The contact of a body with a field of `cells` a side, and with the mesh of its triangles.
fn on_both(random: &mut Random, round: usize, cells: usize) -> [Told; 2] {
    let field = field(random, round % 5, cells);
    let mesh = as_mesh(&field);
    let kind = random.below(BODIES + 1);
    let shape = if kind == BODIES { stick() } else { body(kind) };
    let vertex = mesh.vertices()[random.below(mesh.vertices().len())].as_dvec3();
    let place = vertex + random.vector() * 0.7;
    let ground_pose = match random.below(2) {
        0 => Pose3::IDENTITY,
        _ => Pose3::new(random.vector() * 1e5, random.rotation()).unwrap(),
    };
    let turn = if random.below(4) == 0 { Quat::IDENTITY } else { random.rotation() };
    let pose = Pose3::new(ground_pose.transform(place), turn).unwrap();
    let margin = if random.below(2) == 0 { 0.0 } else { 0.05 };
    let is_b = random.below(2) == 0;
    [Shape3::from(field), mesh.into()].map(|ground| {
        if is_b {
            told([&shape, &ground], [&pose, &ground_pose], margin)
        } else {
            told([&ground, &shape], [&ground_pose, &pose], margin)
        }
    })
}

/// With so few triangles, both process nearby triangles in the order of their numbers.
#[test]
fn on_a_small_height_field_all_is_told_that_the_mesh_of_its_triangles_tells_bit_for_bit() {
    let mut random = Random::new(53);
    let mut counts = [0; 3];
    for round in 0..6000 {
        let [on_field, on_mesh] = on_both(&mut random, round, 1 + round % 2);
        assert_eq!(on_field, on_mesh, "round {round}");
        counts[on_field.0.map_or(0, |overlapping| 1 + usize::from(overlapping))] += 1;
    }
    assert!(counts.iter().all(|&count| count > 100), "apart, near, overlapping: {counts:?}");
}

/// With many triangles, a mesh processes them in another order, and of those with equal contacts, as two beside an
/// edge, the first one wins: feature ids depend on it, and points of deep contacts; overlap and the widths of gaps do
/// not.
#[test]
fn on_a_height_field_yes_and_no_and_gaps_are_those_of_the_mesh_of_its_triangles() {
    let mut random = Random::new(59);
    let (mut counts, mut same) = ([0; 3], 0);
    for round in 0..6000 {
        let [on_field, on_mesh] = on_both(&mut random, round, 8);
        assert_eq!(on_field.0, on_mesh.0, "round {round}");
        counts[on_field.0.map_or(0, |overlapping| 1 + usize::from(overlapping))] += 1;
        same += usize::from(on_field.0.is_some() && on_field.1 == on_mesh.1);
        let nearest = |told: &[Manifold3]| {
            let least = told.iter().min_by(|one, other| one.separation.total_cmp(&other.separation))?;
            Some((least.separation, least.error))
        };
        if on_field.0 == Some(false)
            && let (Some(one), Some(other)) = (nearest(&on_field.1), nearest(&on_mesh.1))
        {
            assert!((one.0 - other.0).abs() <= one.1 + other.1, "round {round}: {on_field:?} {on_mesh:?}");
        }
    }
    assert!(counts.iter().all(|&count| count > 100), "apart, near, overlapping: {counts:?}");
    assert!(same * 3 > (counts[1] + counts[2]) * 2, "{same} of {counts:?} are the same bit for bit");
}
