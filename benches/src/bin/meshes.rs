//! Prints what meshes cost beside parry3d's, in the same run: `meshes [triangles]`, a million unless said otherwise.
//!
//! Thread CPU time, the two in turns, medians. Only the ratios count. parry3d's own flags stand in the table: plain, as
//! most games build them, and with what mends inner edges, which is nearer to what ours does.

use asunder_benches::clock::{Samples, time};
use asunder_geometry::{Aabb3, Ground, HeightField, Shape3, TriMesh};
use core::ops::ControlFlow;
use glam::{DVec3, Vec2, Vec3};
use parry3d::math::Pose;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::{TriMesh as Theirs, TriMeshFlags};

type Given = (Vec<Vec3>, Vec<[u32; 3]>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(1_000_000_usize);
    let side = (count as f64 / 2.0).sqrt() as usize;
    let land = land(side);
    println!("{:<22} {:>12} {:>12} {:>8} {:>12}", "", "ours", "parry", "ratio", "bytes each");
    for (name, (vertices, triangles)) in
        [("land", &land), ("unwelded", &soup(&land)), ("one direction", &strip(&land))]
    {
        build(name, vertices, triangles)?;
    }
    let mesh = TriMesh::new(land.0.clone(), land.1.clone())?;
    let heights: Vec<f32> = land.0.iter().map(|vertex| vertex.y).collect();
    let (ns, field) = time(|| HeightField::new(side + 1, side + 1, heights, Vec2::ONE));
    let field = field?;
    let bytes = field.bytes() as f64 / (2 * side * side) as f64;
    println!("{:<22} {:>9.1} ms {:>12} {:>8} {bytes:>12.1}", "build field", ns * 1e-6, "", "");
    let theirs = Theirs::new(land.0.clone(), land.1.clone())?;
    for (name, shape) in [("mesh", Shape3::from(mesh)), ("field", Shape3::from(field))] {
        ask(name, &shape, &theirs, side as f32)?;
    }
    Ok(())
}

fn build(name: &str, vertices: &[Vec3], triangles: &[[u32; 3]]) -> Result<(), Box<dyn std::error::Error>> {
    let (mut ours, mut theirs, mut mended) = (Samples::default(), Samples::default(), Samples::default());
    let mut bytes = 0.0;
    for _ in 0..3 {
        let given = (vertices.to_vec(), triangles.to_vec());
        let (ns, mesh) = time(|| TriMesh::new(given.0, given.1));
        ours.push(ns, ns);
        bytes = mesh?.bytes() as f64 / triangles.len() as f64;
        let given = (vertices.to_vec(), triangles.to_vec());
        let (ns, _) = time(|| Theirs::new(given.0, given.1).map(|mesh| mesh.num_triangles()));
        theirs.push(ns, ns);
        let given = (vertices.to_vec(), triangles.to_vec());
        let flags = TriMeshFlags::FIX_INTERNAL_EDGES | TriMeshFlags::DELETE_DUPLICATE_TRIANGLES;
        let (ns, _) = time(|| Theirs::with_flags(given.0, given.1, flags).map(|mesh| mesh.num_triangles()));
        mended.push(ns, ns);
    }
    let ours = ours.median().unwrap_or(0.0);
    for (kind, theirs) in [("", theirs), (", mended", mended)] {
        let theirs = theirs.median().unwrap_or(0.0);
        let label = format!("build {name}{kind}");
        println!(
            "{label:<22} {:>9.1} ms {:>9.1} ms {:>8.2} {bytes:>12.1}",
            ours * 1e-6,
            theirs * 1e-6,
            theirs / ours
        );
    }
    Ok(())
}

/// A box of a body, rays down and along, and what is nearest.
fn ask(name: &str, shape: &Shape3, theirs: &Theirs, side: f32) -> Result<(), Box<dyn std::error::Error>> {
    let ground = Ground::of(shape).ok_or("no ground")?;
    let places: Vec<Vec3> = places(side);
    for (label, size) in [("box 1 m", 0.5), ("box 4 m", 2.0)] {
        let boxes = places.iter().map(|&place| (place - size, place + size));
        let boxes: Vec<(Vec3, Vec3)> = boxes.collect();
        let mut hits = 0;
        let mine = |hits: &mut usize| {
            for &(low, high) in &boxes {
                let _ = ground.visit_near(&Aabb3::new(low, high), |_| {
                    *hits += 1;
                    ControlFlow::Continue(())
                });
            }
        };
        let other = || {
            let boxes = boxes.iter().map(|&(low, high)| parry3d::bounding_volume::Aabb::new(low, high));
            boxes.map(|one| theirs.bvh().intersect_aabb(&one).count()).sum::<usize>()
        };
        let (ours, parry) = turns(|| mine(&mut hits), || _ = core::hint::black_box(other()));
        row(
            &format!("{name} {label}"),
            ours,
            parry,
            boxes.len(),
            hits as f64 / (ROUNDS * boxes.len()) as f64,
        );
    }
    for (label, along) in [("ray down", Vec3::NEG_Y), ("ray along", Vec3::new(0.8, -0.03, 0.6))] {
        let mut met = 0;
        let mine = |met: &mut usize| {
            for &place in &places {
                let from = (place + Vec3::Y * 5.0).as_dvec3();
                let mut best = 200.0_f64;
                ground.visit_along(from, along.as_dvec3(), Vec3::ZERO, best, |number| {
                    *met += 1;
                    let hit = hit(ground.corners(number), from, along.as_dvec3());
                    best = hit.map_or(best, |time| time.min(best));
                    best
                });
                core::hint::black_box(best);
            }
        };
        let other = || {
            let rays = places.iter().map(|&place| Ray::new(place + Vec3::Y * 5.0, along));
            rays.filter_map(|ray| theirs.cast_ray(&Pose::IDENTITY, &ray, 200.0, false))
                .map(f64::from)
                .sum::<f64>()
        };
        let (ours, parry) = turns(|| mine(&mut met), || _ = core::hint::black_box(other()));
        row(
            &format!("{name} {label}"),
            ours,
            parry,
            places.len(),
            met as f64 / (ROUNDS * places.len()) as f64,
        );
    }
    let mut met = 0;
    let mine = |met: &mut usize| {
        for &place in &places {
            let mut best = f64::INFINITY;
            ground.visit_nearest(&Aabb3::new(place, place), best, |number| {
                *met += 1;
                let middle = ground.corners(number).iter().sum::<Vec3>() / 3.0;
                best = f64::from(middle.distance(place)).min(best);
                best
            });
            core::hint::black_box(best);
        }
    };
    let (ours, _) = turns(|| mine(&mut met), || ());
    row(&format!("{name} nearest"), ours, 0.0, places.len(), met as f64 / (ROUNDS * places.len()) as f64);
    Ok(())
}

const ROUNDS: usize = 5;

fn turns(mut one: impl FnMut(), mut other: impl FnMut()) -> (f64, f64) {
    let (mut ours, mut theirs) = (Samples::default(), Samples::default());
    for _ in 0..ROUNDS {
        let (ns, ()) = time(&mut one);
        ours.push(ns, ns);
        let (ns, ()) = time(&mut other);
        theirs.push(ns, ns);
    }
    (ours.median().unwrap_or(0.0), theirs.median().unwrap_or(0.0))
}

fn row(label: &str, ours: f64, theirs: f64, count: usize, met: f64) {
    let (ours, theirs) = (ours / count as f64, theirs / count as f64);
    println!("{label:<22} {ours:>9.1} ns {theirs:>9.1} ns {:>8.2} {met:>8.1} met", theirs / ours);
}

/// Where a line meets a triangle (Möller and Trumbore, 1997).
fn hit(corners: [Vec3; 3], from: DVec3, along: DVec3) -> Option<f64> {
    let [a, b, c] = corners.map(|corner| corner.as_dvec3());
    let (u, v) = (b - a, c - a);
    let p = along.cross(v);
    let scale = 1.0 / u.dot(p);
    let arm = from - a;
    let (s, q) = (arm.dot(p) * scale, arm.cross(u));
    let t = along.dot(q) * scale;
    (s >= 0.0 && t >= 0.0 && s + t <= 1.0).then(|| v.dot(q) * scale)
}

/// Rolling land of so many cells of a metre on a side.
fn land(side: usize) -> Given {
    let height = |x: f32, z: f32| libm_sin(x * 0.05) * 3.0 + libm_sin(z * 0.11 + x * 0.02) * 1.5;
    let vertex = |number: usize| {
        let (x, z) = ((number % (side + 1)) as f32, (number / (side + 1)) as f32);
        Vec3::new(x, height(x, z), z)
    };
    let vertices = (0..(side + 1) * (side + 1)).map(vertex).collect();
    let cell = |number: usize| {
        let near = (number / side * (side + 1) + number % side) as u32;
        let far = near + side as u32 + 1;
        [[near, far, near + 1], [near + 1, far, far + 1]]
    };
    (vertices, (0..side * side).flat_map(cell).collect())
}

/// A wave near enough to a sine.
fn libm_sin(x: f32) -> f32 {
    let turns = x / core::f32::consts::TAU;
    let part = turns - turns.floor() - 0.5;
    part * (0.5 - part.abs()) * 16.0
}

fn soup((vertices, triangles): &Given) -> Given {
    let corners = triangles.as_flattened().iter().map(|&vertex| vertices[vertex as usize]).collect();
    (corners, (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect())
}

/// The same, long and thin.
fn strip((vertices, triangles): &Given) -> Given {
    (vertices.iter().map(|vertex| *vertex * Vec3::new(1.0, 1.0, 0.001)).collect(), triangles.clone())
}

/// Bodies near the ground.
fn places(side: f32) -> Vec<Vec3> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u32 << 24) as f32
    };
    (0..4000).map(|_| Vec3::new(next() * side, next() * 6.0 - 3.0, next() * side)).collect()
}
