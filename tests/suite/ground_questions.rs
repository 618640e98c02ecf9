//! Queries about ground made of triangles, against a loop over all of them, one by one.
//!
//! - [`overlaps`]: overlaps, separations and distances; the exact oracle; degenerate triangles
//! - [`rays`]: rays, through edges and vertices too
//! - [`casts`]: moving and turning bodies; sides; normals over inner edges
//! - [`onwards`]: what bodies that already touch ground run into next
//! - [`fronts`]: overlap with the front of ground
//! - [`worlds`]: queries of worlds with ground, bullets, bad input
//! - [`walks`]: characters on ground
//! - [`peer`]: against parry3d

mod casts;
mod fronts;
mod onwards;
mod overlaps;
mod peer;
mod rays;
mod walks;
mod worlds;

use asunder_geometry::glam::{DVec3, Vec2, Vec3};
use asunder_geometry::{Ground, HeightField, Pose3, Shape3, TriMesh};
use asunder_tests::cases::Random;

/// Vertices and triangles that a mesh is made from.
pub(crate) type Soup = (Vec<Vec3>, Vec<[u32; 3]>);

/// A grid of squares, two triangles each, facing up: heights by place, and which squares are left out.
pub(crate) fn sheet(
    [along, across]: [u32; 2],
    step: [f32; 2],
    mut height: impl FnMut(f32, f32) -> f32,
    mut is_hole: impl FnMut(u32, u32) -> bool,
) -> Soup {
    let mut vertices = vec![];
    for j in 0..=across {
        for i in 0..=along {
            let x = (i as f32 - along as f32 / 2.0) * step[0];
            let z = (j as f32 - across as f32 / 2.0) * step[1];
            vertices.push(Vec3::new(x, height(x, z), z));
        }
    }
    let mut triangles = vec![];
    for j in 0..across {
        for i in (0..along).filter(|&i| !is_hole(i, j)) {
            let [a, b] = [j * (along + 1) + i, (j + 1) * (along + 1) + i];
            triangles.extend([[a, b, a + 1], [a + 1, b, b + 1]]);
        }
    }
    (vertices, triangles)
}

pub(crate) fn mesh((vertices, triangles): Soup) -> Shape3 {
    TriMesh::new(vertices, triangles).unwrap().into()
}

/// Bumpy ground with holes.
fn bumps(random: &mut Random) -> Soup {
    let (along, across) = (3 + random.below(6) as u32, 3 + random.below(6) as u32);
    let holes = random.below(3);
    let mut other = Random::new(random.below(1 << 20) as u128);
    sheet(
        [along, across],
        [0.8, 0.7],
        |_, _| random.between(-0.4, 0.4) as f32,
        |_, _| holes == 0 && other.below(5) == 0,
    )
}

/// Bumps as a height field with a hole.
fn field(random: &mut Random) -> Shape3 {
    let (columns, rows) = (3 + random.below(7), 3 + random.below(7));
    let heights: Vec<f32> = (0..columns * rows).map(|_| random.between(-0.4, 0.4) as f32).collect();
    let field = HeightField::new(columns, rows, heights, Vec2::new(0.8, 0.7)).unwrap();
    field.with_hole(random.below(columns - 1), random.below(rows - 1)).unwrap().into()
}

/// Triangles placed at random: of every size, and slivers.
fn shards(random: &mut Random) -> Soup {
    let (mut vertices, mut triangles) = (vec![], vec![]);
    for _ in 0..20 + random.below(40) {
        let size = random.pick(&[0.01, 0.3, 1.0, 1.0, 2.0, 50.0]);
        let thin = random.pick(&[1.0, 1.0, 1e-2, 1e-5]);
        let corner = random.vector() * 2.5;
        let along = random.direction() * size;
        let across = along.cross(random.direction()).normalize() * size * thin;
        let first = vertices.len() as u32;
        vertices.extend(
            [corner, corner + along, corner + along * random.between(0.0, 1.0) + across]
                .map(|vertex| vertex.as_vec3()),
        );
        triangles.push([first, first + 1, first + 2]);
    }
    (vertices, triangles)
}

/// A closed, distorted box: thin walls all around.
fn shell(random: &mut Random) -> Soup {
    let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0;
    let vertices = (0..8).map(|i| corner(i) * 1.5 + random.vector().as_vec3() * 0.3).collect();
    let squares = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = squares.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    (vertices, triangles)
}

/// Ground of each kind in turn; every other one rotated, and one in five far from the origin.
pub(crate) fn level(random: &mut Random, round: usize) -> (Shape3, Pose3) {
    let ground = match round % 6 {
        0 => mesh(bumps(random)),
        3 => field(random),
        1 | 4 => mesh(shards(random)),
        _ => mesh(shell(random)),
    };
    let far = if round.is_multiple_of(5) { DVec3::new(-3e5, 7e5, 1e4) } else { random.vector() };
    let pose = match round % 2 {
        0 => Pose3::at(far).unwrap(),
        _ => Pose3::new(far, random.quaternion()).unwrap(),
    };
    (ground, pose)
}

/// All triangles of ground with their numbers, as shapes in the ground's axes.
pub(crate) fn triangles(ground: &Shape3) -> Vec<(u32, Shape3)> {
    let ground = Ground::of(ground).unwrap();
    (0..ground.triangle_count())
        .filter_map(|number| Some((number, Shape3::Triangle(ground.triangle(number)?))))
        .collect()
}

/// A point near ground: on or beside one of its triangles.
pub(crate) fn beside(random: &mut Random, ground: (&Shape3, &Pose3), away: f64) -> DVec3 {
    let ground_of = Ground::of(ground.0).unwrap();
    let corners = loop {
        let number = random.below(ground_of.triangle_count() as usize) as u32;
        if ground_of.triangle(number).is_some() {
            break ground_of.corners(number);
        }
    };
    let [u, v] = [random.between(0.0, 1.0), random.between(0.0, 1.0)];
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let place = a + (b - a) * (u * (1.0 - v)) + (c - a) * (v * (1.0 - u));
    ground.1.transform(place) + random.direction() * away
}
