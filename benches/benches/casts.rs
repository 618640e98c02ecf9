//! Criterion benches of casts and rays in space, beside parry3d's.

use asunder_geometry::glam::{Quat, Vec3};
use asunder_geometry::{Capsule3, Cuboid, Hull, Motion3, Pose3, Ray3, Shape3, Sphere};
use asunder_narrow::{Pair3, cast_ray3};
use core::hint::black_box;
use criterion::{Criterion, criterion_group, criterion_main};
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::query::{Ray, ShapeCastOptions, cast_shapes};
use parry3d::shape::{Ball, Capsule, ConvexPolyhedron, Cuboid as Box3, SharedShape};
use std::sync::Arc;

/// How many different rays or motions are cast in turns.
const ROUND: usize = 64;

/// Points spread evenly on a sphere: a spiral by repeated small rotations, without trigonometry.
fn spiral(count: usize) -> Vec<Vec3> {
    let step = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.3)).ok();
    let turn = step.map(|motion| motion.turn(&Pose3::IDENTITY).basis_at(1.0));
    let (mut along, mut points) = (asunder_geometry::glam::DVec3::X, Vec::new());
    for i in 0..count {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        points.push((along * (1.0 - z * z).sqrt() + asunder_geometry::glam::DVec3::Z * z).as_vec3());
        along = turn.map_or(along, |basis| basis.turn(along));
    }
    points
}

fn shapes() -> Vec<(&'static str, Shape3, SharedShape)> {
    let half = Vec3::new(0.5, 0.75, 1.0);
    let points = spiral(32);
    let twin: Vec<Vector> = points.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let mut shapes: Vec<(&'static str, Shape3, SharedShape)> = Vec::new();
    if let (Ok(ball), Ok(capsule), Ok(cuboid), Ok(hull), Some(polyhedron)) = (
        Sphere::new(1.0),
        Capsule3::from_half_height(0.75, 0.5),
        Cuboid::from_half_extents(half),
        Hull::from_points(&points),
        ConvexPolyhedron::from_convex_hull(&twin),
    ) {
        shapes.push(("sphere", ball.into(), SharedShape(Arc::new(Ball::new(1.0)))));
        shapes.push(("capsule", capsule.into(), SharedShape(Arc::new(Capsule::new_y(0.75, 0.5)))));
        let box3 = Box3::new(Vector::new(half.x, half.y, half.z));
        shapes.push(("cuboid", cuboid.into(), SharedShape(Arc::new(box3))));
        shapes.push(("hull of 32", hull.into(), SharedShape(Arc::new(polyhedron))));
    }
    shapes
}

/// Starts around a shape and directions towards it; every fourth misses it.
fn lines() -> Vec<(Vec3, Vec3)> {
    let aims = spiral(ROUND + 1);
    (spiral(ROUND).into_iter().zip(aims).enumerate())
        .map(|(i, (from, aim))| {
            let aside = if i % 4 == 3 { 2.0 } else { 0.4 };
            (from * 5.0, (Vec3::new(aim.y, aim.z, aim.x) * aside - from * 5.0) * 1.5)
        })
        .collect()
}

fn vector(v: Vec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn rays(criterion: &mut Criterion) {
    let turn = Quat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
    let Ok(pose) = Pose3::new(Vec3::ZERO, turn) else { return };
    let at = Pose::from_parts(Vector::ZERO, Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w));
    for (name, ours, theirs) in shapes() {
        let rays: Vec<Ray3> = lines().into_iter().filter_map(|(from, to)| Ray3::new(from, to).ok()).collect();
        let mut i = 0;
        criterion.bench_function(&format!("ray/{name}"), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ROUND;
                cast_ray3(&ours, &pose, black_box(&rays[i]), 10.0)
            });
        });
        let rays: Vec<Ray> =
            lines().into_iter().map(|(from, to)| Ray::new(vector(from), vector(to))).collect();
        criterion.bench_function(&format!("ray/{name}/parry3d"), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ROUND;
                theirs.cast_ray_and_get_normal(&at, black_box(&rays[i]), 10.0, true)
            });
        });
    }
}

fn casts(criterion: &mut Criterion) {
    let turn = Quat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
    let Ok(pose) = Pose3::new(Vec3::ZERO, turn) else { return };
    let rotation = Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w);
    for (name, ours, theirs) in shapes() {
        let starts: Vec<(Pose3, Vec3)> =
            lines().into_iter().filter_map(|(from, way)| Some((Pose3::at(from).ok()?, way))).collect();
        let mut i = 0;
        criterion.bench_function(&format!("cast/{name}"), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ROUND;
                let (start, way) = black_box(&starts[i]);
                Pair3::new(&ours, start, &ours, &pose).cast(*way)
            });
        });
        let lines = lines();
        let at = Pose::from_parts(Vector::ZERO, rotation);
        criterion.bench_function(&format!("cast/{name}/parry3d"), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ROUND;
                let (from, way) = black_box(lines[i]);
                let start = Pose::from_parts(vector(from), Rotation::IDENTITY);
                let options = ShapeCastOptions::with_max_time_of_impact(1.0);
                cast_shapes(&start, vector(way), &*theirs.0, &at, Vector::ZERO, &*theirs.0, options)
            });
        });
        let motions: Vec<Motion3> = starts
            .iter()
            .filter_map(|(_, way)| Motion3::new(*way, Quat::from_xyzw(0.9, -0.4, 0.1, 0.3)).ok())
            .collect();
        let Ok(still) = Motion3::shift(Vec3::ZERO) else { return };
        criterion.bench_function(&format!("impact, turning/{name}"), |bencher| {
            bencher.iter(|| {
                i = (i + 1) % ROUND;
                let (start, motion) = black_box((&starts[i].0, &motions[i]));
                Pair3::new(&ours, start, &ours, &pose).impact(motion, &still)
            });
        });
    }
}

criterion_group! {
    name = group;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(core::time::Duration::from_millis(200))
        .measurement_time(core::time::Duration::from_millis(600));
    targets = rays, casts
}
criterion_main!(group);
