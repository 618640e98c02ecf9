//! Prints how long building hulls of points takes, beside parry3d in the same run: `hulls [rounds]`.
//!
//! Thread CPU time, both in turns, medians. Only the ratios count. Where the true hull has more vertices than ours may
//! have, ours is the simplified one, and the search for it is part of its time.

use asunder_benches::clock::{Samples, time};
use asunder_geometry::Hull;
use clap::Parser;
use glam::Vec3;
use parry3d::transformation::try_convex_hull;

/// A cloud: its name, the number of points, and whether they lie on the sphere or in the ball.
const CLOUDS: [(&str, usize, bool); 9] = [
    ("ball", 5000, false),
    ("sphere", 5000, true),
    ("ball", 1000, false),
    ("sphere", 1000, true),
    ("ball", 200, false),
    ("sphere", 200, true),
    ("ball", 32, false),
    ("sphere", 32, true),
    ("sphere", 65_535, true),
];

/// How long hulls of points take beside parry3d's.
#[derive(Parser)]
struct Options {
    /// Turns of which the median counts.
    #[arg(default_value_t = 31)]
    rounds: usize,
}

fn main() {
    let Options { rounds } = Options::parse();
    println!("{:<14} {:>12} {:>12} {:>8} {:>9}", "points", "ours us", "parry us", "ratio", "vertices");
    for (name, count, is_sphere) in CLOUDS {
        let points = cloud(count, is_sphere);
        let (mut ours, mut theirs, mut vertices) = (Samples::default(), Samples::default(), 0);
        let repeats = (5000 / count).max(1);
        for _ in 0..if count > 10_000 { rounds.min(5) } else { rounds } {
            for _ in 0..repeats {
                let (ns, hull) = time(|| Hull::simplify(&points, 256));
                ours.push(ns, ns);
                vertices = hull.map_or(0, |hull| hull.vertices().len());
                let (ns, _) = time(|| try_convex_hull(&points).map(|hull| hull.0.len()));
                theirs.push(ns, ns);
            }
        }
        let (ours, theirs) = (ours.median().unwrap_or(0.0), theirs.median().unwrap_or(0.0));
        let label = format!("{name} {count}");
        println!(
            "{label:<14} {:>12.1} {:>12.1} {:>8.2} {vertices:>9}",
            ours * 1e-3,
            theirs * 1e-3,
            ours / theirs
        );
    }
}

/// Points in a unit ball, by rejection, or their directions.
fn cloud(count: usize, is_sphere: bool) -> Vec<Vec3> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u32 << 23) as f32 - 1.0
    };
    let mut points = Vec::with_capacity(count);
    while points.len() < count {
        let point = Vec3::new(next(), next(), next());
        if point.length_squared() <= 1.0 {
            points.push(if is_sphere { point.normalize_or(Vec3::X) } else { point });
        }
    }
    points
}
