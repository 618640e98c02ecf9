//! Prints the cost of compounds of many parts, beside parry3d's: `parts [rounds]`.
//!
//! Cubes of n x n x n boxes and balls, a fifth of a metre from each other. Queries for two such cubes, for a crate
//! among the parts of one, and for a ray; thread CPU time per query, both sides in turns, medians.

use asunder_benches::clock::{Samples, time};
use asunder_benches::parry::{self, Shapes};
use asunder_geometry::{Compound3, Cuboid, Motion3, Pose3, Ray3, Shape3, Sphere};
use asunder_narrow::{Pair3, cast_ray3};
use asunder_scenes::random::Random;
use clap::Parser;
use glam::{DVec3, Quat, Vec3};
use parry3d::math::Vector;
use parry3d::query::{self, Ray, ShapeCastOptions};
use parry3d::shape::SharedShape;
use std::error::Error;

/// Pairs per row.
const PAIRS: usize = 32;

/// Two bodies, for us and for the peer.
struct Twins {
    shapes: [Shape3; 2],
    twins: [SharedShape; 2],
    poses: Vec<[Pose3; 2]>,
}

type Ours = fn(&Pair3, &Pose3) -> bool;
type Peers = fn([&SharedShape; 2], [parry3d::math::Pose; 2]) -> bool;

/// The queries, for us and for the peer, if it has such a query.
const QUESTIONS: [(&str, Ours, Option<Peers>); 5] = [
    (
        "yes or no",
        |pair, _| pair.overlaps(),
        Some(|[a, b], [here, there]| {
            query::intersection_test(&here, &*a.0, &there, &*b.0).is_ok_and(|found| found.intersecting)
        }),
    ),
    (
        "distance",
        |pair, _| pair.distance().is_some(),
        Some(|[a, b], [here, there]| {
            query::distance(&here, &*a.0, &there, &*b.0).is_ok_and(|found| found.distance > 0.0)
        }),
    ),
    ("points", |pair, _| !pair.manifolds(0.02).is_empty(), None),
    (
        "cast",
        |pair, there| pair.cast((there.position() * 0.1).as_vec3()).is_some(),
        Some(|[a, b], [here, there]| {
            let options = ShapeCastOptions { max_time_of_impact: 1.0, ..ShapeCastOptions::default() };
            let way = there.translation * 0.1;
            query::cast_shapes(&here, way, &*a.0, &there, Vector::ZERO, &*b.0, options)
                .is_ok_and(|hit| hit.is_some())
        }),
    ),
    (
        "turning",
        |pair, there| {
            let turn = Quat::from_xyzw(0.0, 0.1, 0.0, 1.0);
            let motion = Motion3::new(there.position() * 0.1, turn);
            motion.is_ok_and(|motion| pair.impact(&motion, &Motion3::STILL).is_some())
        },
        None,
    ),
];

/// What compounds of many parts cost, beside parry3d's.
#[derive(Parser)]
struct Options {
    /// Turns of which the median counts.
    #[arg(default_value_t = 9)]
    rounds: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Options { rounds } = Options::parse();
    println!(
        "{:>6} {:<8} {:<10} {:>12} {:>12} {:>7}",
        "parts", "with", "question", "asunder us", "parry3d us", "ratio"
    );
    for edge in [3, 5, 10, 15] {
        let mut random = Random::new(18);
        let (cube, small) = (cube_of(edge)?, Cuboid::from_half_extents(Vec3::new(0.3, 0.4, 0.3))?.into());
        for (name, other) in [("crate", &small), ("its like", &cube)] {
            let pairs = twins([&cube, other], &mut random)?;
            for (question, ours, peers) in QUESTIONS {
                row(
                    &[&(edge * edge * edge).to_string(), name, question],
                    measure(&pairs, (ours, peers), rounds),
                );
            }
        }
        row(
            &[&(edge * edge * edge).to_string(), "ray", "first"],
            rays(&cube, edge as f64, rounds, &mut random)?,
        );
    }
    Ok(())
}

fn row([parts, name, question]: &[&str; 3], [ours, peers]: [Option<f64>; 2]) {
    let told = |time: Option<f64>| time.map_or("-".to_owned(), |time| format!("{:.2}", time * 1e-3));
    let ratio = ours.zip(peers).map_or("-".to_owned(), |(ours, peers)| format!("{:.2}", peers / ours));
    println!("{parts:>6} {name:<8} {question:<10} {:>12} {:>12} {ratio:>7}", told(ours), told(peers));
}

/// Boxes and balls alternating, centred on the origin.
fn cube_of(edge: usize) -> Result<Shape3, Box<dyn Error>> {
    let (crate_, ball) = (Cuboid::from_half_extents(Vec3::splat(0.4))?, Sphere::new(0.4)?);
    let middle = (edge - 1) as f64 * 0.5;
    let mut parts = Vec::new();
    for i in 0..edge * edge * edge {
        let place = [i % edge, i / edge % edge, i / edge / edge].map(|cell| cell as f64 - middle);
        let shape: Shape3 = if i % 2 == 0 { crate_.into() } else { ball.into() };
        parts.push((Pose3::at(place)?, shape));
    }
    Ok(Compound3::new(parts)?.into())
}

/// Places the second body: brought to the first from afar, then at most a decimetre further or back.
fn twins(shapes: [&Shape3; 2], random: &mut Random) -> Result<Twins, Box<dyn Error>> {
    let mut known = Shapes::default();
    let mut convert = |shape| known.convert(shape).ok_or("parry3d refuses the shape");
    let twins = [convert(shapes[0])?, convert(shapes[1])?];
    let far = 2.0 * f64::from(shapes[0].outer_radius() + shapes[1].outer_radius());
    let poses = (0..PAIRS)
        .map(|_| {
            let (here, away) = (Pose3::new(DVec3::ZERO, random.rotation())?, random.direction());
            let there = Pose3::new(away * far, random.rotation())?;
            let pair = Pair3::new(shapes[1], &there, shapes[0], &here);
            let met = pair.cast((away * -far).as_vec3()).map_or(1.0, |impact| impact.fraction);
            let place = away * (far * (1.0 - met) + random.range(-0.1, 0.1));
            Ok([here, Pose3::new(place, there.rotation())?])
        })
        .collect::<Result<_, Box<dyn Error>>>()?;
    Ok(Twins { shapes: shapes.map(Clone::clone), twins, poses })
}

/// Nanoseconds per query, ours and the peer's.
fn measure(twins: &Twins, (ours, peers): (Ours, Option<Peers>), rounds: usize) -> [Option<f64>; 2] {
    let mut samples = [Samples::default(), Samples::default()];
    let [a, b] = &twins.shapes;
    let ask = |[here, there]: &&[Pose3; 2]| ours(&Pair3::new(a, here, b, there), there);
    let count = twins.poses.len() as f64;
    for _ in 0..rounds {
        let (ns, yes) = time(|| twins.poses.iter().filter(ask).count());
        std::hint::black_box(yes);
        samples[0].push(ns / count, ns);
        if let Some(peers) = peers {
            let poses: Vec<_> =
                twins.poses.iter().map(|poses| [parry::pose(&poses[0]), parry::pose(&poses[1])]).collect();
            let ask = |poses: &&[parry3d::math::Pose; 2]| peers([&twins.twins[0], &twins.twins[1]], **poses);
            let (ns, yes) = time(|| poses.iter().filter(ask).count());
            std::hint::black_box(yes);
            samples[1].push(ns / count, ns);
        }
    }
    samples.map(|samples| samples.median())
}

fn rays(
    cube: &Shape3,
    edge: f64,
    rounds: usize,
    random: &mut Random,
) -> Result<[Option<f64>; 2], Box<dyn Error>> {
    let twin = Shapes::default().convert(cube).ok_or("parry3d refuses the shape")?;
    let mut rays = Vec::new();
    for _ in 0..1000 {
        let (from, to) = (random.direction() * edge, random.direction() * edge * 0.4);
        rays.push(Ray3::new(from, (to - from).as_vec3())?);
    }
    let others: Vec<Ray> = rays.iter().map(|ray| Ray::new(ray.origin().as_vec3(), ray.direction())).collect();
    let mut samples = [Samples::default(), Samples::default()];
    let here = parry::pose(&Pose3::IDENTITY);
    for _ in 0..rounds {
        let hits = |ray: &&Ray3| cast_ray3(cube, &Pose3::IDENTITY, ray, 2.0).is_some();
        let (ns, yes) = time(|| rays.iter().filter(hits).count());
        std::hint::black_box(yes);
        samples[0].push(ns / rays.len() as f64, ns);
        let hits = |ray: &&Ray| twin.cast_ray_and_get_normal(&here, ray, 2.0, true).is_some();
        let (ns, yes) = time(|| others.iter().filter(hits).count());
        std::hint::black_box(yes);
        samples[1].push(ns / rays.len() as f64, ns);
    }
    Ok(samples.map(|samples| samples.median()))
}
