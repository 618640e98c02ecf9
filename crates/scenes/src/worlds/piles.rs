//! Heaps, pyramids, and a cloud of mixed shapes.

use super::Replay3;
use super::motion::Motion3;
use crate::pairs::{SolidKind, cuboid, solids};
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::Shape3;
use glam::{DVec3, Vec3};

/// How far a resting body strays, in metres: the residual motion that a solver leaves.
const TREMBLE: f64 = 2e-5;

/// Spacing of boxes of 1 m. Layers are a little lower than a box, so boxes overlap those below by half a millimetre.
/// With this much room at the sides some touch their neighbours, and two of three candidate pairs do not touch.
pub(crate) const BOXES: DVec3 = DVec3::new(1.035, 0.9995, 1.035);

/// Spacing of hulls.
pub(crate) const HULLS: DVec3 = DVec3::splat(0.93);

/// The number of different hulls in a heap; the clones share their data.
pub(crate) const DISTINCT: usize = 64;

/// Boxes of 1 m in a pit, layer by layer.
pub(super) fn boxes(count: usize, seed: u64) -> Replay3 {
    let shape = cuboid(Vec3::splat(0.5));
    heap(count, seed, BOXES, 0.03, |_, random| {
        (shape.clone(), Turn::about(DVec3::Y, random.range(-0.035, 0.035)))
    })
}

/// Hulls of 32 points in a pit, in random rotations.
pub(super) fn hulls(count: usize, seed: u64) -> Replay3 {
    let shapes = solids(SolidKind::Hull32, DISTINCT, seed);
    heap(count, seed, HULLS, 0.02, |i, random| (shapes[i % shapes.len()].clone(), random.turn()))
}

/// A lattice of bodies, roughly a cube, in a pit of a floor and four walls.
fn heap(
    count: usize,
    seed: u64,
    spacing: DVec3,
    jitter: f64,
    mut draw: impl FnMut(usize, &mut Random) -> (Shape3, Turn),
) -> Replay3 {
    let mut random = Random::new(seed ^ 0x9117e);
    let mut replay = Replay3::default();
    let inside = count.saturating_sub(PIT);
    let side = side(inside);
    for (half, middle) in pit(spacing * side as f64, spacing) {
        replay.fixed(cuboid(half), Motion3::still(middle));
    }
    for i in 0..inside {
        let cell = DVec3::new((i % side) as f64, (i / (side * side)) as f64, (i / side % side) as f64);
        let stray = random.within(DVec3::splat(-jitter), DVec3::splat(jitter));
        let middle = cell + DVec3::new(0.5 - 0.5 * side as f64, 0.5, 0.5 - 0.5 * side as f64);
        // Bodies stray only sideways, so that layers are level.
        let place = middle * spacing + DVec3::new(stray.x, 0.0, stray.z);
        let (shape, turn) = draw(i, &mut random);
        replay.moving(shape, Motion3::still(place).turned(turn).swaying(TREMBLE, &mut random), None);
    }
    replay
}

/// The number of bodies along an edge of a cube of so many.
pub(crate) fn side(count: usize) -> usize {
    (libm::cbrt(count as f64).ceil() as usize).max(1)
}

/// The number of boxes that make up a pit.
pub(crate) const PIT: usize = 5;

/// Half extents and centres of the floor and the walls of a pit, for contents with the given spacing.
pub(crate) fn pit(inside: DVec3, spacing: DVec3) -> [(Vec3, DVec3); PIT] {
    let (half, slack) = (inside * 0.5, spacing * 0.02);
    let floor = Vec3::new(half.x as f32 + 3.0, 1.0, half.z as f32 + 3.0);
    let across_x = Vec3::new(1.0, half.y as f32 + 2.0, floor.z);
    let across_z = Vec3::new(half.x as f32, half.y as f32 + 2.0, 1.0);
    let (at_x, at_z) = (half.x + slack.x + 1.0, half.z + slack.z + 1.0);
    [
        (floor, DVec3::new(0.0, -0.9999, 0.0)),
        (across_x, DVec3::new(-at_x, half.y, 0.0)),
        (across_z, DVec3::new(0.0, half.y, -at_z)),
        (across_x, DVec3::new(at_x, half.y, 0.0)),
        (across_z, DVec3::new(0.0, half.y, at_z)),
    ]
}

/// Boxes in one pyramid, and in its lowest row.
pub(super) const PYRAMID: (usize, usize) = (210, 20);

/// As many whole pyramids as there are boxes for, in rows on one floor.
pub(super) fn pyramids(count: usize, seed: u64) -> Replay3 {
    let mut random = Random::new(seed ^ 0x97a);
    let mut replay = Replay3::default();
    let pyramids = (count.saturating_sub(1) / PYRAMID.0).max(1);
    let shape = cuboid(Vec3::splat(0.5));
    let depth = pyramids as f32 * 2.0;
    replay.fixed(cuboid(Vec3::new(20.0, 1.0, depth)), Motion3::still(DVec3::new(0.0, -1.0, 0.0)));
    for pyramid in 0..pyramids {
        let z = (pyramid as f64 - 0.5 * (pyramids as f64 - 1.0)) * 4.0;
        for (x, y) in pyramid_places() {
            // Yaws are nearly equal, so that the AABBs of neighbours overlap but the boxes do not touch.
            let turn = Turn::about(DVec3::Y, random.range(0.006, 0.010));
            let motion = Motion3::still(DVec3::new(x, y, z)).turned(turn).swaying(TREMBLE, &mut random);
            replay.moving(shape.clone(), motion, None);
        }
    }
    replay
}

/// Centres of a pyramid's boxes of 1 m: each overlaps those below by half a millimetre and is 26 mm from its
/// neighbours.
pub(super) fn pyramid_places() -> impl Iterator<Item = (f64, f64)> {
    (0..PYRAMID.1).flat_map(|row| {
        let wide = PYRAMID.1 - row;
        let y = 0.4995 + row as f64 * 0.9995;
        (0..wide).map(move |i| ((i as f64 - 0.5 * (wide as f64 - 1.0)) * 1.026, y))
    })
}

/// Shapes in the air on a loose lattice. Every other one rotates, and drifts back and forth.
pub(super) fn mixed(count: usize, seed: u64) -> Replay3 {
    in_the_air(count, (2, 1.17), seed)
}

/// The same, further apart, so that few touch. One of a hundred rotates, and drifts back and forth.
pub(super) fn spread(count: usize, seed: u64) -> Replay3 {
    in_the_air(count, (100, 1.3), seed)
}

/// One of `one_of` bodies moves, and cells are `cell_size` metres wide.
fn in_the_air(count: usize, (one_of, cell_size): (usize, f64), seed: u64) -> Replay3 {
    let mut random = Random::new(seed ^ 0x313d);
    let kinds = [SolidKind::Box, SolidKind::Hull8, SolidKind::Hull16, SolidKind::Hull32];
    let shapes: Vec<Shape3> = kinds.iter().flat_map(|&kind| solids(kind, 16, seed)).collect();
    let mut replay = Replay3::default();
    let side = (libm::cbrt(count as f64).ceil() as usize).max(1);
    for i in 0..count {
        let cell = DVec3::new((i % side) as f64, (i / (side * side)) as f64, (i / side % side) as f64);
        let stray = random.within(DVec3::splat(-0.05), DVec3::splat(0.05));
        let shape = shapes[random.below(shapes.len())].clone();
        let mut motion = Motion3::still(cell * cell_size + stray).turned(random.turn());
        if i % one_of == 0 {
            motion = motion.swaying(0.15, &mut random);
            motion.axis = random.direction();
            motion.spin = random.range(0.2, 2.0);
            replay.moving(shape, motion, None);
        } else {
            replay.resting(shape, motion);
        }
    }
    replay
}
