//! Scenes that must stand.

use asunder_geometry::{Cuboid, Hull, Pose3, Shape3};
use asunder_scenes::pairs::{SolidKind, solids};
use asunder_scenes::random::Random;
use asunder_tests::solver::{Settings, Solver};
use glam::{DQuat, DVec3, Vec3};

pub(super) fn cuboid(half: Vec3) -> Shape3 {
    Cuboid::from_half_extents(half).unwrap().into()
}

/// The same box as a hull.
pub(super) fn crate_hull(half: Vec3) -> Shape3 {
    let corner = |i: u32| half * Vec3::new(sign(i & 1), sign(i & 2), sign(i & 4));
    Hull::from_points(&(0..8).map(corner).collect::<Vec<Vec3>>()).unwrap().into()
}

fn sign(bit: u32) -> f32 {
    if bit == 0 { -1.0 } else { 1.0 }
}

/// An upright prism over a regular octagon with an inscribed circle of radius 0.5, 1 m high.
pub(super) fn octagon() -> Shape3 {
    // The tangent of half of an eighth of a turn.
    let t = core::f64::consts::SQRT_2 - 1.0;
    let around = [(1.0, t), (t, 1.0), (-t, 1.0), (-1.0, t), (-1.0, -t), (-t, -1.0), (t, -1.0), (1.0, -t)];
    let corner = |(x, z): (f64, f64)| [-0.5, 0.5].map(|y| DVec3::new(0.5 * x, y, 0.5 * z).as_vec3());
    Hull::from_points(&around.into_iter().flat_map(corner).collect::<Vec<Vec3>>()).unwrap().into()
}

/// A rotation about a unit axis, by the tangent of half its angle.
pub(super) fn about(axis: DVec3, half_tangent: f64) -> DQuat {
    let v = axis * half_tangent;
    DQuat::from_xyzw(v.x, v.y, v.z, 1.0).normalize()
}

pub(super) fn pose(position: DVec3, rotation: DQuat) -> Pose3 {
    Pose3::new(position, rotation.as_quat()).unwrap()
}

/// A wide floor with its top at y = 0.
pub(super) fn on_floor(settings: Settings) -> Solver {
    let mut solver = Solver::new(settings);
    solver.add(cuboid(Vec3::new(30.0, 1.0, 30.0)), Pose3::at([0.0, -1.0, 0.0]).unwrap(), true);
    solver
}

/// Ten equal bodies on top of each other, each rotated about the vertical relative to the one below.
pub(super) fn stack(shape: &Shape3, height: f64, twist: f64, settings: Settings) -> Solver {
    let mut solver = on_floor(settings);
    let mut turn = DQuat::IDENTITY;
    for i in 0..10 {
        turn *= about(DVec3::Y, twist);
        solver.add(shape.clone(), pose(DVec3::Y * (height * (f64::from(i) + 0.5)), turn), false);
    }
    solver
}

/// Ten rows of cubes, each on two of the row below.
pub(super) fn pyramid(shape: &Shape3, settings: Settings) -> Solver {
    let mut solver = on_floor(settings);
    for row in 0..10_u8 {
        for i in 0..10 - row {
            let x = 1.04 * (f64::from(i) + 0.5 * f64::from(row));
            solver.add(shape.clone(), Pose3::at([x, f64::from(row) + 0.5, 0.0]).unwrap(), false);
        }
    }
    solver
}

/// Two thin boxes that lean against each other; `half_tangent` is the tangent of half the angle from upright.
pub(super) fn cards(half_tangent: f64, settings: Settings) -> Solver {
    let half = DVec3::new(0.02, 0.5, 0.35);
    let mut solver = on_floor(settings);
    let square = half_tangent * half_tangent;
    let (sin, cos) = (2.0 * half_tangent / (1.0 + square), (1.0 - square) / (1.0 + square));
    // The lowest corner is on the floor, the innermost touches the other card's.
    let (up, aside) = (half.y * cos + half.x * sin, half.y * sin + half.x * cos);
    for side in [-1.0, 1.0] {
        solver.add(
            cuboid(half.as_vec3()),
            pose(DVec3::new(side * aside, up, 0.0), about(DVec3::Z, side * half_tangent)),
            false,
        );
    }
    solver
}

/// Solids of one family in random orientations, above the floor and apart from each other.
pub(super) fn dropped(kind: SolidKind) -> Solver {
    let mut solver = on_floor(Settings::default());
    let mut random = Random::new(5);
    for (i, shape) in solids(kind, 25, 3).into_iter().enumerate() {
        let at = DVec3::new(3.0 * (i % 5) as f64 - 6.0, 0.9, 3.0 * (i / 5) as f64 - 6.0);
        solver.add(shape, Pose3::new(at, random.rotation()).unwrap(), false);
    }
    solver
}
