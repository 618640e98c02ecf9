//! Chains: polylines to stand on.
//!
//! - [`exact`]: queries about the chain as a set of points, against the definition: the least over all segments, and
//!   exact arithmetic
//! - [`sliding`]: no ghost collisions on straight lines that are cut, at any angle, distance and speed
//! - [`surfaces`]: arcs, corners, hollows, loose ends, sides, thin walls
//! - [`casts`]: rays and moving shapes, against all segments; normals; characters that walk
//! - [`onwards`]: what bodies that already touch a chain run into next
//! - [`worlds`]: events, snapshots, queries

mod casts;
mod exact;
mod onwards;
mod sliding;
mod surfaces;
mod worlds;

use asunder::glam::{DVec2, Vec2};
use asunder::{Capsule2, Chain, Circle, Polygon, Pose2, Rect, Rotation2, Shape2};

/// Hashed numbers from 0 to 1.
fn noise(i: usize) -> f64 {
    let mixed = (i as u64).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    ((mixed ^ mixed >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9) >> 11) as f64 / (1u64 << 53) as f64
}

/// Positions from 0 to a length, unevenly spaced: some pieces are a thousandth of the others.
fn cuts(length: f64, count: usize) -> Vec<f64> {
    let steps: Vec<f64> =
        (0..count).map(|i| if i % 5 == 3 { 1e-3 } else { 0.5 + noise(i * 31 + count) }).collect();
    let total: f64 = steps.iter().sum();
    let mut at = 0.0;
    let mut places = vec![0.0];
    places.extend(steps.iter().map(|step| {
        at += step * length / total;
        at
    }));
    places
}

/// The unit vector at an angle from x.
fn towards(angle: f64) -> DVec2 {
    let turn = Rotation2::from_angle(angle as f32).unwrap();
    DVec2::new(turn.cos().into(), turn.sin().into()).normalize()
}

/// A line from one point to another, cut into pieces.
fn cut_line(from: DVec2, to: DVec2, count: usize) -> Vec<Vec2> {
    let along = (to - from).normalize();
    cuts((to - from).length(), count).into_iter().map(|at| (from + along * at).as_vec2()).collect()
}

/// Sliding bodies of about a metre: name, shape, and how far its foot is below its centre.
fn sliders() -> Vec<(&'static str, Shape2, f64)> {
    let rect = Rect::from_half_extents(Vec2::new(0.5, 0.25)).unwrap();
    let hexagon: Vec<Vec2> =
        (0..6).map(|i| towards(f64::from(i) * core::f64::consts::TAU / 6.0).as_vec2() * 0.5).collect();
    let hexagon = Polygon::hull_of(&hexagon).unwrap();
    let foot = hexagon.vertices().iter().fold(0.0_f32, |low, vertex| low.min(vertex.y));
    vec![
        ("box", rect.into(), 0.25),
        ("rounded box", rect.rounded(0.125).unwrap().into(), 0.375),
        ("circle", Circle::new(0.5).unwrap().into(), 0.5),
        ("capsule", Capsule2::new(Vec2::X * -0.5, Vec2::X * 0.5, 0.25).unwrap().into(), 0.25),
        ("hexagon", hexagon.into(), -f64::from(foot)),
    ]
}

/// The rotation that takes the x axis to a unit vector.
fn turned(along: DVec2) -> Rotation2 {
    Rotation2::new(along.x as f32, along.y as f32).unwrap()
}

fn at(x: f64, y: f64) -> Pose2 {
    Pose2::at([x, y]).unwrap()
}

fn chain(points: &[(f32, f32)]) -> Chain {
    Chain::open(points.iter().map(|&(x, y)| Vec2::new(x, y))).unwrap()
}
