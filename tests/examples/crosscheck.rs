//! Random pairs against parry3d: how often the two agree, and how far apart their numbers are.
//!
//! `cargo run --release -p asunder-tests --example crosscheck -- 100000`

use asunder_geometry::glam::Vec3;
use asunder_geometry::{Capsule3, Cuboid, Hull, Pose3, Shape3, Sphere};
use asunder_narrow::{Pair3, Separation3};
use asunder_scenes::random::Random;
use asunder_tests::precise::separation3;
use clap::Parser;
use parry3d::math::Pose;
use parry3d::query;
use parry3d::shape::SharedShape;
use std::error::Error;

/// Within this share of the pair's size of touching, parry3d's answer is not compared with ours.
const BAND: f32 = 1e-4;

/// Random pairs against parry3d: how often the two agree, and how far apart their numbers are.
#[derive(Parser)]
struct Options {
    /// Pairs.
    #[arg(default_value_t = 20_000)]
    count: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Options { count } = Options::parse();
    let mut random = Random::new(9);
    let (mut touching, mut near, mut differ, mut worst) = (0, 0, 0, [0.0_f64; 2]);
    for _ in 0..count {
        let (a, twin_a) = shape(&mut random)?;
        let (b, twin_b) = shape(&mut random)?;
        let here = Pose3::new(random.direction() * 0.1, random.rotation())?;
        let there = Pose3::new(random.direction() * random.range(0.2, 2.0), random.rotation())?;
        let pair = Pair3::new(&a, &here, &b, &there);
        let (pose_a, pose_b) = (twin_pose(&here), twin_pose(&there));
        let theirs = query::intersection_test(&pose_a, &*twin_a.0, &pose_b, &*twin_b.0)?.intersecting;
        let Separation3::Measured(ours) = pair.separation(f32::INFINITY) else { continue };
        touching += usize::from(pair.overlaps());
        if ours.separation.abs() <= BAND * pair.size() {
            near += 1;
            continue;
        }
        differ += usize::from(pair.overlaps() != theirs);
        if ours.separation > 0.0 {
            let theirs = query::distance(&pose_a, &*twin_a.0, &pose_b, &*twin_b.0)?.distance;
            let size = f64::from(pair.size());
            if f64::from((ours.separation - theirs).abs()) > 1e-6 * size {
                // Which is right, by an independent oracle.
                let truth = separation3((&a, &here), (&b, &there)).separation;
                for (worst, said) in worst.iter_mut().zip([ours.separation, theirs]) {
                    *worst = worst.max((f64::from(said) - truth).abs() / size);
                }
            }
        }
    }
    println!("{count} pairs, {touching} touch, {near} too near to touching to judge parry3d by");
    println!("{differ} where the two disagree about that");
    let [ours, theirs] = worst;
    println!(
        "distances that differ by more than 1e-6 of the size: asunder is off by at most {ours:.0e} of it, parry3d by {theirs:.0e}"
    );
    Ok(())
}

fn twin_pose(pose: &Pose3) -> Pose {
    Pose::from_parts(pose.position().as_vec3(), pose.rotation().normalize())
}

fn shape(random: &mut Random) -> Result<(Shape3, SharedShape), Box<dyn Error>> {
    let size = random.range(0.1, 0.8) as f32;
    Ok(match random.below(4) {
        0 => (Sphere::new(size)?.into(), SharedShape::ball(size)),
        1 => {
            let half = Vec3::new(size, size * 0.7, size * 0.4);
            (Cuboid::from_half_extents(half)?.into(), SharedShape::cuboid(half.x, half.y, half.z))
        }
        2 => (Capsule3::from_half_height(size, size * 0.3)?.into(), SharedShape::capsule_y(size, size * 0.3)),
        _ => {
            let points: Vec<Vec3> = (0..24).map(|_| random.direction().as_vec3() * size).collect();
            let hull = Hull::from_points(&points)?;
            let twin = SharedShape::convex_hull(hull.vertices()).ok_or("parry3d refuses the hull")?;
            (hull.into(), twin)
        }
    })
}
