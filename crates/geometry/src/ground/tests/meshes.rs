//! Meshes that are hard to get right.

use super::Dice;
use glam::Vec3;

pub(super) struct Named {
    pub(super) name: String,
    pub(super) vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

pub(super) fn all() -> Vec<Named> {
    let mut dice = Dice::new(1);
    let rough: Vec<f32> = (0..4096).map(|_| dice.between(-1.0, 1.0)).collect();
    let noise = move |column: u32, row: u32| rough[(column * 61 + row * 17) as usize % rough.len()];
    let mut meshes = vec![
        grid("flat", 7, |_, _| 0.0),
        grid("rough", 12, &noise),
        grid("terraces", 14, |column, row| ((column / 3 + row / 4) % 3) as f32),
        scaled(grid("far", 9, &noise), Vec3::splat(0.5), Vec3::new(9e5, -2e5, 3e5)),
        scaled(grid("tiny", 9, &noise), Vec3::splat(1e-4), Vec3::ZERO),
        scaled(grid("huge", 9, &noise), Vec3::new(1e5, 3e4, 1e5), Vec3::new(-4e5, 0.0, -4e5)),
        scaled(grid("slivers", 9, &noise), Vec3::new(1.0, 1e-3, 1e-3), Vec3::ZERO),
        scaled(grid("thinner", 9, |_, _| 0.0), Vec3::new(1.0, 1.0, 1e-5), Vec3::ZERO),
        soup("soup", 6),
        messy("messy"),
        fan("fan", 30),
        moebius("moebius", 40),
        cubes("cubes"),
        one_box("one box", 300),
        giant("giant", 12, &noise),
        junction("junction"),
    ];
    for count in [1, 2, 3, 8, 9, 10, 63, 64, 65, 66, 513] {
        let mut part = grid(&format!("first {count}"), 17, &noise);
        part.triangles.truncate(count);
        meshes.push(part);
    }
    let mut flipped = grid("flipped", 10, &noise);
    flipped.triangles.iter_mut().step_by(3).for_each(|triangle| triangle.swap(0, 2));
    meshes.push(flipped);
    // Modelled from both sides: all of it, and here and there.
    for step in [1, 3] {
        let mut leaf = grid(&format!("leaf {step}"), 8, &noise);
        let backs: Vec<_> = leaf.triangles.iter().step_by(step).map(|&[a, b, c]| [b, a, c]).collect();
        leaf.triangles.extend(backs);
        meshes.push(leaf);
    }
    meshes
}

/// Squares of two triangles with fronts up.
pub(super) fn grid(name: &str, cells: u32, height: impl Fn(u32, u32) -> f32) -> Named {
    let vertex = |number: u32| {
        let (column, row) = (number % (cells + 1), number / (cells + 1));
        Vec3::new(column as f32, height(column, row), row as f32)
    };
    let vertices = (0..(cells + 1) * (cells + 1)).map(vertex).collect();
    let mut triangles = Vec::new();
    for cell in 0..cells * cells {
        let near = cell / cells * (cells + 1) + cell % cells;
        let far = near + cells + 1;
        triangles.extend([[near, far, near + 1], [near + 1, far, far + 1]]);
    }
    Named { name: name.to_owned(), vertices, triangles }
}

fn scaled(mut mesh: Named, scale: Vec3, shift: Vec3) -> Named {
    mesh.vertices.iter_mut().for_each(|vertex| *vertex = *vertex * scale + shift);
    mesh
}

/// No two triangles share a vertex by number; zeros have either sign.
pub(super) fn soup(name: &str, cells: u32) -> Named {
    let grid = grid(name, cells, |column, row| if column * row % 3 == 0 { 0.0 } else { 0.5 });
    let corners = grid.triangles.iter().flatten().enumerate();
    let sign = |place: usize| if place.is_multiple_of(2) { 0.0 } else { -0.0 };
    let vertices: Vec<Vec3> = corners
        .map(|(place, &vertex)| {
            let at = grid.vertices[vertex as usize];
            Vec3::from_array(at.to_array().map(|part| if part == 0.0 { sign(place) } else { part }))
        })
        .collect();
    let triangles = (0..grid.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    Named { name: name.to_owned(), vertices, triangles }
}

/// Duplicates in every order, and triangles without an area, among others.
pub(super) fn messy(name: &str) -> Named {
    let mut dice = Dice::new(7);
    let mut mesh = soup(name, 5);
    let good = mesh.triangles.clone();
    for _ in 0..40 {
        let mut extra = good[dice.below(good.len() as u32) as usize];
        match dice.below(4) {
            0 => extra.rotate_left(1),
            1 => extra.swap(0, 1),
            2 => extra[2] = extra[0],
            _ => {
                let [a, b] = [extra[0], extra[1]].map(|vertex| mesh.vertices[vertex as usize]);
                extra[2] = mesh.vertices.len() as u32;
                mesh.vertices.push((a + b) * 0.5);
            }
        }
        mesh.triangles.insert(dice.below(mesh.triangles.len() as u32) as usize, extra);
    }
    mesh
}

/// Many triangles on one edge, some of them twice.
fn fan(name: &str, count: u32) -> Named {
    let mut vertices = vec![Vec3::ZERO, Vec3::Y];
    for i in 0..count {
        let angle = 0.2 * f64::from(i);
        vertices.push(Vec3::new(libm::cos(angle) as f32, 0.3, libm::sin(angle) as f32));
    }
    let mut triangles: Vec<[u32; 3]> = (0..count).map(|i| [i % 2, 1 - i % 2, i + 2]).collect();
    triangles.extend((0..count).step_by(4).map(|i| [i + 2, 0, 1]));
    // Duplicates count once: this makes an edge where three triangles meet, and one where two do.
    triangles.extend([[2, 3, 0], [3, 2, 0], [2, 3, 1]]);
    Named { name: name.to_owned(), vertices, triangles }
}

fn moebius(name: &str, count: u32) -> Named {
    let mut vertices = Vec::new();
    for i in 0..count {
        let turn = core::f64::consts::TAU * f64::from(i) / f64::from(count);
        for side in [-0.4, 0.4] {
            let out = 2.0 + side * libm::cos(turn * 0.5);
            let point = [out * libm::cos(turn), side * libm::sin(turn * 0.5), out * libm::sin(turn)];
            vertices.push(Vec3::from_array(point.map(|part| part as f32)));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..count {
        let (a, b) = (2 * i, 2 * i + 1);
        // After a full turn of the strip, left becomes right.
        let (c, d) = if i + 1 < count { (a + 2, b + 2) } else { (1, 0) };
        triangles.extend([[a, b, c], [c, b, d]]);
    }
    Named { name: name.to_owned(), vertices, triangles }
}

/// Closed cubes, of which the second stands on an edge of the first, and the third on its corner.
fn cubes(name: &str) -> Named {
    let mut mesh = Named { name: name.to_owned(), vertices: vec![], triangles: vec![] };
    for shift in [Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0), Vec3::splat(-1.0)] {
        let first = mesh.vertices.len() as u32;
        let corner = |i: u32| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) + shift;
        mesh.vertices.extend((0..8).map(corner));
        for [a, b, c, d] in
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
        {
            mesh.triangles.extend([[a, b, c], [a, c, d]].map(|triangle| triangle.map(|v: u32| v + first)));
        }
    }
    mesh
}

/// Triangles that share one box.
fn one_box(name: &str, count: u32) -> Named {
    let mut dice = Dice::new(3);
    let mut vertices = vec![Vec3::ZERO, Vec3::ONE];
    vertices.extend((0..count).map(|_| Vec3::new(dice.share(), dice.share(), dice.share())));
    Named { name: name.to_owned(), vertices, triangles: (0..count).map(|i| [0, 1, i + 2]).collect() }
}

/// A large triangle among many small ones.
fn giant(name: &str, cells: u32, height: impl Fn(u32, u32) -> f32) -> Named {
    let mut mesh = grid(name, cells, height);
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend([Vec3::new(-5e3, -1.0, -4e3), Vec3::new(-5e3, 2.0, 9e3), Vec3::new(8e3, 0.0, 0.0)]);
    mesh.triangles.insert(70, [first, first + 1, first + 2]);
    mesh
}

/// Two triangles on the edge of a larger one, at whose middle they meet.
fn junction(name: &str) -> Named {
    let vertices = [(0.0, 0.0), (2.0, 0.0), (1.0, 2.0), (1.0, 0.0), (0.5, -1.0), (1.5, -1.0)];
    let vertices = vertices.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec();
    Named { name: name.to_owned(), vertices, triangles: vec![[0, 2, 1], [0, 3, 4], [3, 1, 5], [4, 3, 5]] }
}
