//! Prints how much hints save for pairs of compounds: `compounds [rounds]`.
//!
//! Hammers of 2 to 8 parts, boxes or hulls, that drift a little from frame to frame. Each pair is queried with the hint
//! that its last answer left, and without. Thread CPU time per pair, the two variants in turns, medians.

use asunder_benches::clock::{Samples, time};
use asunder_geometry::{Compound3, Cuboid, Hull, Pose3, Shape3};
use asunder_narrow::{Answer, Batch3, Hint, Job3, Pair3, Separation3, collide3};
use asunder_scenes::random::Random;
use clap::Parser;
use glam::{DVec3, Quat, Vec3};

/// Pairs per row.
const PAIRS: usize = 64;

/// Frames for which a pair is followed; the first is not timed.
const FRAMES: usize = 32;

/// A placement of two bodies: a name, and a function that makes such a pair.
type Scene = (&'static str, fn(&mut Random, usize, bool) -> Option<Posed>);

const SCENES: [Scene; 4] =
    [("apart", apart), ("hooked", hooked), ("touching", touching), ("on a slab", on_a_slab)];

/// Two bodies.
struct Posed {
    shapes: [Shape3; 2],
    poses: [Pose3; 2],
}

/// What hints buy pairs of compounds.
#[derive(Parser)]
struct Options {
    /// Turns of which the median counts.
    #[arg(default_value_t = 15)]
    rounds: usize,
}

fn main() {
    let Options { rounds } = Options::parse();
    println!(
        "{:<10} {:>6} {:>6} {:>12} {:>12} {:>7}",
        "pair", "parts", "of", "without ns", "with ns", "ratio"
    );
    for (name, scene) in SCENES {
        for of_hulls in [false, true] {
            for parts in [2, 4, 8] {
                let mut random = Random::new(17);
                let mut pairs = Vec::new();
                while pairs.len() < PAIRS {
                    pairs.extend(scene(&mut random, parts, of_hulls));
                }
                let [without, with] = measure(&pairs, rounds, &mut random);
                let of = if of_hulls { "hulls" } else { "boxes" };
                println!(
                    "{name:<10} {parts:>6} {of:>6} {without:>12.0} {with:>12.0} {:>7.2}",
                    without / with
                );
            }
        }
    }
}

/// Nanoseconds per pair, without hints and with.
fn measure(pairs: &[Posed], rounds: usize, random: &mut Random) -> [f64; 2] {
    let frames: Vec<Vec<Pose3>> =
        (0..FRAMES).map(|_| pairs.iter().map(|pair| strayed(pair, random)).collect()).collect();
    let mut samples = [Samples::default(), Samples::default()];
    let mut batch = Batch3::default();
    for _ in 0..rounds {
        let mut hints = vec![Hint::NONE; pairs.len()];
        for (number, poses) in frames.iter().enumerate() {
            let none = vec![Hint::NONE; pairs.len()];
            for (which, hints) in [(0, &none), (1, &hints)] {
                let (ns, ()) = time(|| ask(pairs, poses, hints, &mut batch));
                if number > 0 {
                    samples[which].push(ns / pairs.len() as f64, ns);
                }
            }
            for (kept, answer) in hints.iter_mut().zip(&batch.answers) {
                let (Answer::Apart { hint, .. } | Answer::Contact { hint, .. }) = answer;
                *kept = *hint;
            }
        }
    }
    samples.map(|samples| samples.median().unwrap_or(0.0))
}

fn ask(pairs: &[Posed], poses: &[Pose3], hints: &[Hint], batch: &mut Batch3) {
    batch.clear();
    let mut jobs = Vec::with_capacity(pairs.len());
    for ((pair, pose_b), &hint) in pairs.iter().zip(poses).zip(hints) {
        let ([shape_a, shape_b], pose_a) = (&pair.shapes, &pair.poses[0]);
        jobs.push(Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.01, hint, ahead: 0.0, sensor: false });
    }
    collide3(&jobs, batch);
}

/// The pose of the second body in some frame.
fn strayed(pair: &Posed, random: &mut Random) -> Pose3 {
    let pose = &pair.poses[1];
    Pose3::new(pose.position() + random.direction() * 2e-4, pose.rotation()).unwrap_or(*pose)
}

/// A hammer: a handle along y of all parts but one, and a head across it.
fn hammer(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Shape3> {
    let length = 1.6 / (parts - 1) as f32;
    let mut all = vec![(Pose3::at([0.0, 0.9, 0.0]).ok()?, part(random, Vec3::new(0.5, 0.2, 0.2), of_hulls)?)];
    for i in 0..parts - 1 {
        let half = Vec3::new(0.1, 0.5 * length, 0.1);
        let place = DVec3::new(0.0, 0.7 - f64::from(length) * (i as f64 + 0.5), 0.0);
        all.push((Pose3::at(place).ok()?, part(random, half, of_hulls)?));
    }
    Some(Compound3::new(all).ok()?.into())
}

/// A box, or the hull of 32 points on the ellipsoid inscribed in it.
fn part(random: &mut Random, half: Vec3, of_hull: bool) -> Option<Shape3> {
    if !of_hull {
        return Some(Cuboid::from_half_extents(half).ok()?.into());
    }
    let points: Vec<Vec3> = (0..32).map(|_| random.direction().as_vec3() * half).collect();
    Some(Hull::from_points(&points).ok()?.into())
}

/// Their AABBs overlap, but a plane separates them.
fn apart(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Posed> {
    let posed = near(random, parts, of_hulls)?;
    let around = [around(&posed.shapes[0])?, around(&posed.shapes[1])?];
    let wholes = Pair3::new(&around[0], &posed.poses[0], &around[1], &posed.poses[1]);
    let Separation3::Measured(found) = wholes.separation(f32::INFINITY) else { return None };
    (found.separation > 0.03).then_some(posed)
}

/// The hull of a compound whose parts are not rotated.
fn around(shape: &Shape3) -> Option<Shape3> {
    let Shape3::Compound(compound) = shape else { return None };
    let mut points = Vec::new();
    for part in compound.parts() {
        let place = part.pose().position().as_vec3();
        points.extend(part.shape().core().vertices().iter().map(|&vertex| place + vertex));
    }
    Some(Hull::simplify(&points, 128).ok()?.into())
}

/// The head of one is in the corner between the other's head and handle: no plane separates them.
fn hooked(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Posed> {
    let shapes = [hammer(random, parts, of_hulls)?, hammer(random, parts, of_hulls)?];
    let place = DVec3::new(random.range(0.62, 0.68), random.range(-0.47, -0.43), random.range(-0.02, 0.02));
    let posed = Posed { shapes, poses: [Pose3::IDENTITY, Pose3::at(place).ok()?] };
    let Separation3::Measured(found) = pair(&posed).separation(f32::INFINITY) else { return None };
    (found.separation > 0.012).then_some(posed)
}

/// Pushed together along the normal of their separation, until they overlap by a millimetre.
fn touching(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Posed> {
    let mut posed = apart(random, parts, of_hulls)?;
    let Separation3::Measured(found) = pair(&posed).separation(f32::INFINITY) else { return None };
    let back = found.normal.as_dvec3() * (f64::from(found.separation) + 1e-3);
    posed.poses[1] = Pose3::new(posed.poses[1].position() - back, posed.poses[1].rotation()).ok()?;
    Some(posed)
}

/// A hammer that lies on a large box, by its head or its handle.
fn on_a_slab(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Posed> {
    let slab = Cuboid::from_half_extents(Vec3::new(5.0, 1.0, 5.0)).ok()?.into();
    let shapes = [slab, hammer(random, parts, of_hulls)?];
    // The head reaches 0.1 further to the side than the handle does, at a distance of 1.7 along it.
    let lie = DVec3::new(0.06, 0.998, -0.06).normalize();
    let tilt = Quat::from_rotation_arc(DVec3::Z.as_vec3(), lie.as_vec3());
    let high = Pose3::new([random.range(-2.0, 2.0), 3.0, random.range(-2.0, 2.0)], tilt).ok()?;
    let mut posed = Posed { shapes, poses: [Pose3::IDENTITY, high] };
    let Separation3::Measured(found) = pair(&posed).separation(f32::INFINITY) else { return None };
    let down = DVec3::Y * (f64::from(found.separation) + 1e-3);
    posed.poses[1] = Pose3::new(high.position() - down, tilt).ok()?;
    Some(posed)
}

fn near(random: &mut Random, parts: usize, of_hulls: bool) -> Option<Posed> {
    let shapes = [hammer(random, parts, of_hulls)?, hammer(random, parts, of_hulls)?];
    let place = random.direction() * random.range(0.3, 1.6);
    let poses =
        [Pose3::new(DVec3::ZERO, random.rotation()).ok()?, Pose3::new(place, random.rotation()).ok()?];
    let posed = Posed { shapes, poses };
    let boxes = [0, 1].map(|i| posed.shapes[i].bounds(&posed.poses[i], 0.0));
    boxes[0].overlaps(&boxes[1]).then_some(posed)
}

fn pair(posed: &Posed) -> Pair3<'_> {
    Pair3::new(&posed.shapes[0], &posed.poses[0], &posed.shapes[1], &posed.poses[1])
}
