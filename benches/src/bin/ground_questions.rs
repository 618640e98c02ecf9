//! Questions about ground of 20,000 and of a million triangles, beside parry3d's `TriMesh`: both sides take turns, block
//! by block, and what is told is the median of a block's time for one question, with the ratio of both.
//!
//! `cargo run --release -p asunder-benches --bin ground_questions [PART OF A NAME]`

use asunder_benches::clock::{Samples, time};
use asunder_benches::parry::Shapes;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Capsule3, Cuboid, Hull, Pose3, Ray3, Shape3, Sphere, TriMesh};
use asunder_narrow::{Pair3, cast_ray3};
use asunder_tests::cases::Random;
use core::hint::black_box;
use parry3d::math::{Pose, Rotation};
use parry3d::query::{Ray, ShapeCastOptions, cast_shapes, distance, intersection_test};
use parry3d::shape::SharedShape;
use std::error::Error;

/// Questions a block, and blocks a side.
const BLOCK: usize = 500;
const BLOCKS: usize = 20;

/// Hills of `side` by `side` squares of a metre, up to a tenth of that high, rough on top.
fn hills(side: u32, random: &mut Random) -> Result<TriMesh, Box<dyn Error>> {
    let middle = f64::from(side) / 2.0;
    let wave = |x: f64| {
        let x = x - (x / 2.0).round() * 2.0;
        4.0 * x * (1.0 - x.abs())
    };
    let mut vertices = vec![];
    for j in 0..=side {
        for i in 0..=side {
            let (x, z) = (f64::from(i), f64::from(j));
            let large = wave(x / middle) * wave(z / middle + 0.3) * middle / 5.0;
            let height = large + wave(x / 9.0 + z / 13.0) * 1.5 + random.between(-0.2, 0.2);
            vertices.push(DVec3::new(x - middle, height, z - middle).as_vec3());
        }
    }
    let square = |i: u32, j: u32| {
        let [a, b] = [j * (side + 1) + i, (j + 1) * (side + 1) + i];
        [[a, b, a + 1], [a + 1, b, b + 1]]
    };
    let triangles: Vec<_> = (0..side).flat_map(|j| (0..side).flat_map(move |i| square(i, j))).collect();
    Ok(TriMesh::new(vertices, triangles)?)
}

/// Where questions come from: a body's pose, and a way.
fn places(random: &mut Random, side: u32, length: f64) -> Vec<(Pose3, Vec3)> {
    let half = f64::from(side) * 0.48;
    let one = |random: &mut Random| {
        let place = random.vector() * DVec3::new(half, half / 6.0, half);
        let pose = Pose3::new(place.as_vec3(), random.quaternion()).ok()?;
        Some((pose, (random.direction() * length).as_vec3()))
    };
    (0..BLOCK * BLOCKS).filter_map(|_| one(random)).collect()
}

fn pose_of(pose: &Pose3) -> Pose {
    let q = pose.rotation().normalize();
    Pose::from_parts(pose.position().as_vec3(), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// Both sides in turns; `yes` counts how often they said yes.
fn race(
    name: &str,
    places: &[(Pose3, Vec3)],
    ours: impl Fn(&(Pose3, Vec3)) -> bool,
    theirs: impl Fn(&(Pose3, Vec3)) -> bool,
) {
    if std::env::args().nth(1).is_some_and(|only| !name.contains(&only)) {
        return;
    }
    let (mut ours_ns, mut theirs_ns) = (Samples::default(), Samples::default());
    let mut yes = [0; 2];
    for block in places.chunks(BLOCK) {
        let (ns, count) = time(|| block.iter().filter(|place| black_box(ours(place))).count());
        ours_ns.push(ns / block.len() as f64, ns);
        yes[0] += count;
        let (ns, count) = time(|| block.iter().filter(|place| black_box(theirs(place))).count());
        theirs_ns.push(ns / block.len() as f64, ns);
        yes[1] += count;
    }
    let (ours, theirs) = (ours_ns.median().unwrap_or(0.0), theirs_ns.median().unwrap_or(0.0));
    println!("{name:28} {ours:9.0} ns {theirs:9.0} ns {:6.2}   yes {} {}", theirs / ours, yes[0], yes[1]);
}

fn bodies() -> Result<Vec<(&'static str, Shape3)>, Box<dyn Error>> {
    let corners: Vec<Vec3> = {
        let mut random = Random::new(3);
        (0..24).map(|_| (random.direction() * 0.6).as_vec3()).collect()
    };
    Ok(vec![
        ("sphere", Sphere::new(0.5)?.into()),
        ("capsule", Capsule3::from_half_height(0.5, 0.4)?.into()),
        ("cuboid", Cuboid::from_half_extents(Vec3::new(0.4, 0.5, 0.6))?.into()),
        ("hull of 24", Hull::from_points(&corners)?.into()),
    ])
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut random = Random::new(1);
    println!("{:28} {:>12} {:>12} {:>6}", "", "ours", "parry3d", "ratio");
    for side in [100, 707] {
        let mesh = hills(side, &mut random)?;
        let count = mesh.triangles().len();
        let mut shapes = Shapes::default();
        let ground = Shape3::from(mesh);
        let twin = shapes.convert(&ground).ok_or("parry3d refuses the mesh")?;
        let (home, theirs) = (Pose3::IDENTITY, Pose::IDENTITY);
        let question = |what: &str| format!("{count} {what}");
        let long = places(&mut random, side, 1.0);
        race(
            &question("ray"),
            &long,
            |(pose, way)| {
                let ray = Ray3::new(pose.position(), *way);
                ray.is_ok_and(|ray| cast_ray3(&ground, &home, &ray, f64::INFINITY).is_some())
            },
            |(pose, way)| {
                let ray = Ray::new(pose.position().as_vec3(), *way);
                twin.cast_ray(&theirs, &ray, f32::MAX, true).is_some()
            },
        );
        for (name, body) in bodies()? {
            let other: SharedShape = shapes.convert(&body).ok_or("parry3d has it")?;
            race(
                &question(&format!("cast of a {name}")),
                &places(&mut random, side, 10.0),
                |(pose, way)| Pair3::new(&body, pose, &ground, &home).cast(*way).is_some(),
                |(pose, way)| {
                    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
                    cast_shapes(&pose_of(pose), *way, &*other, &theirs, Vec3::ZERO, &*twin, options)
                        .is_ok_and(|hit| hit.is_some())
                },
            );
            race(
                &question(&format!("overlap of a {name}")),
                &places(&mut random, side, 1.0),
                |(pose, _)| Pair3::new(&body, pose, &ground, &home).overlaps(),
                |(pose, _)| {
                    intersection_test(&pose_of(pose), &*other, &theirs, &*twin)
                        .is_ok_and(|found| found.intersecting)
                },
            );
            race(
                &question(&format!("distance of a {name}")),
                &places(&mut random, side, 1.0),
                |(pose, _)| Pair3::new(&body, pose, &ground, &home).distance().is_some(),
                |(pose, _)| {
                    distance(&pose_of(pose), &*other, &theirs, &*twin).is_ok_and(|found| found.distance > 0.0)
                },
            );
        }
    }
    Ok(())
}
