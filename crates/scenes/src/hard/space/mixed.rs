//! The other families: deep overlap, half-spaces, compounds, drifted rotations, rest, random pairs.

use super::body::{Body3, Draft3, place, size};
use super::faces::on_grid;
use super::features::{Kind, contact};
use super::solids::{anything, brick, cuboid, plain, solid};
use crate::hard::gap::{any_gap, gap, sign, stepped, ulps};
use crate::random::Random;
use crate::turn::{Turn, unit};
use asunder_geometry::{Compound3, HalfSpace, Pose3, Shape3};
use glam::{DVec3, Quat};

/// One shape within the other, or their centres near each other.
pub(super) fn deep(level: u32, random: &mut Random) -> Draft3 {
    let (a, b) = match random.below(3) {
        0 => (anything(1.0, random), anything(1.0, random)),
        1 => (solid(1.0, random), solid(0.3, random)),
        _ => (brick(1.0, random), brick(1.0, random)),
    };
    let (turn_a, turn_b) = (random.turn(), random.turn());
    let turn_b = if random.unit() < 0.3 { turn_a } else { turn_b };
    let (a, b) = (Body3::new(a, turn_a), Body3::new(b, turn_b));
    let share = [0.1, 1e-3, 1e-6, 1e-12, 0.0][level.min(4) as usize];
    let offset = random.direction() * (share * size(&a, &b)) + a.middle() - b.middle();
    let at = place(random);
    Draft3::placed(a, b, at, at + offset)
}

/// Everything, also rounded shapes, on half-spaces with tilted normals; and half-spaces with opposite normals.
pub(super) fn half_space(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let normal = tilted(random);
    let plane = |normal: DVec3| HalfSpace::new(normal.as_vec3()).map_or_else(|_| plain(), Shape3::from);
    if random.unit() < 0.15 {
        let turn = random.turn();
        let (a, b) = (Body3::new(plane(normal), turn), Body3::new(plane(-normal), turn));
        let axis = unit(a.turn(normal.as_vec3().as_dvec3()));
        let at = place(random);
        let aside = random.direction();
        let offset = aside - axis * axis.dot(aside) + axis * gap;
        let offset = if random.unit() < 0.5 { axis * gap } else { offset };
        return Draft3::placed(a, b, at, at + offset);
    }
    let b = anything(1.0, random);
    let kind = Kind::any(random);
    contact((plane(normal), Kind::Face), (b, kind), gap, random)
}

/// A normal of any length: an axis, small whole numbers, or a random direction.
fn tilted(random: &mut Random) -> DVec3 {
    match random.below(4) {
        0 => DVec3::Y,
        1 => DVec3::new(1.0 + random.below(5) as f64, random.below(5) as f64, -1.0 - random.below(5) as f64),
        2 => random.direction() * random.log_range(1e-30, 1e30),
        _ => DVec3::new(random.log_range(1e-12, 1e-3) * sign(random), 1.0, random.log_range(1e-12, 1e-3)),
    }
}

/// Compounds of bricks on a grid, under one rotation, part on part or part in a notch, by ulps; and of random shapes.
pub(super) fn compounds(level: u32, random: &mut Random) -> Draft3 {
    if random.unit() < 0.4 {
        return scattered(random);
    }
    let cell = 0.125;
    let rotation = if random.unit() < 0.5 { Turn::IDENTITY } else { random.turn() };
    let (a, b) = (
        notched(cell, random),
        if random.unit() < 0.5 { notched(cell, random) } else { cuboid(DVec3::splat(cell)) },
    );
    let (a, b) = (Body3::new(a, rotation), Body3::new(b, rotation));
    // Offset by whole cells: some touch by faces, some by edges, some share cells.
    let mut cells = || (random.below(9) as f64 - 4.0) * cell;
    let offset = a.turn(DVec3::new(cells(), cells(), cells()));
    let at = on_grid(random.within(DVec3::splat(-4.0), DVec3::splat(4.0)), 64.0);
    let mut goal = at + offset;
    for axis in 0..3 {
        goal[axis] = stepped(goal[axis], ulps(8_u32.saturating_sub(2 * level), random));
    }
    Draft3::placed(a, b, at, goal)
}

/// Two to six cubes on a grid, rotated by quarter turns: one in the middle, the others at random on or around it.
fn notched(cell: f64, random: &mut Random) -> Shape3 {
    let parts: Vec<(Pose3, Shape3)> = (0..2 + random.below(5))
        .map(|i| {
            let mut steps = || (random.below(3) as f64 - 1.0) * 2.0 * cell;
            let middle = if i == 0 { DVec3::ZERO } else { DVec3::new(steps(), steps(), steps()) };
            let turn =
                [Quat::IDENTITY, Quat::from_xyzw(1.0, 0.0, 0.0, 1.0), Quat::from_xyzw(0.5, 0.5, 0.5, 0.5)];
            (super::body::pose(middle, turn[random.below(3)]), cuboid(DVec3::splat(cell)))
        })
        .collect();
    Compound3::new(parts).map_or_else(|_| plain(), Shape3::from)
}

/// Compounds of random shapes at random, brought near touching along an axis.
fn scattered(random: &mut Random) -> Draft3 {
    let compound = |random: &mut Random| {
        let parts: Vec<(Pose3, Shape3)> = (0..1 + random.below(5))
            .map(|_| {
                let middle = random.within(DVec3::splat(-0.5), DVec3::splat(0.5));
                let turn = random.rotation();
                (super::body::pose(middle, turn), anything(0.6, random))
            })
            .collect();
        Compound3::new(parts).map_or_else(|_| plain(), Shape3::from)
    };
    let a = Body3::new(compound(random), random.turn());
    let b = if random.unit() < 0.5 { compound(random) } else { anything(1.0, random) };
    let b = Body3::new(b, random.turn());
    let gap = any_gap(random) * size(&a, &b);
    Draft3::beside(a, b, random.direction(), gap, place(random))
}

/// How many products the rotations of [`drifted`] are made of, by level.
const PRODUCTS: [u32; 4] = [10, 100, 1_000, 10_000];

/// Rotations that are products in f32 of up to thousands of f32 rotations, never normalised.
pub(super) fn drifted(level: u32, random: &mut Random) -> Draft3 {
    let products = PRODUCTS[level.min(3) as usize];
    let gap = any_gap(random);
    let one = drift(products, random);
    let (a, b) = (solid(1.0, random), solid(1.0, random));
    if random.unit() < 0.4 {
        let (a, b) = (Body3::turned(brick(1.0, random), one), Body3::turned(brick(1.0, random), one));
        let axis = a.turn([DVec3::X, DVec3::Y, DVec3::NEG_Z][random.below(3)]);
        let gap = gap * size(&a, &b);
        let aside = random.direction() * 0.2;
        return Draft3::meeting((a, aside), (b, DVec3::ZERO), axis, gap, place(random));
    }
    let (a, b) = (Body3::turned(a, one), Body3::turned(b, drift(products, random)));
    let gap = gap * size(&a, &b);
    // Along a face's normal of A, or along a random direction.
    let axis = match a.shape.core().normals().first() {
        Some(&normal) if random.unit() < 0.5 => unit(a.turn(normal)),
        _ => random.direction(),
    };
    Draft3::beside(a, b, axis, gap, place(random))
}

/// A product of so many rotations by up to 0.1 rad, each a little longer or shorter than 1, so that the product's
/// length ends between 1e-6 and 1e6.
fn drift(products: u32, random: &mut Random) -> Quat {
    let start = random.turn();
    let mut known = [start.v.x, start.v.y, start.v.z, start.w].map(|part| part as f32);
    let stretch = libm::exp(random.range(-13.8, 13.8) / f64::from(products));
    let step = Turn::about(random.direction(), random.range(0.0, 0.1));
    let step = [step.v.x, step.v.y, step.v.z, step.w].map(|part| (part * stretch) as f32);
    for _ in 0..products {
        known = product(step, known);
    }
    Quat::from_array(known)
}

/// The product of two quaternions (x, y, z, w), in f32, in this order of summation.
fn product(p: [f32; 4], q: [f32; 4]) -> [f32; 4] {
    let ([a, b, c, d], [x, y, z, w]) = (p, q);
    [
        d * x + a * w + b * z - c * y,
        d * y - a * z + b * w + c * x,
        d * z + a * y - b * x + c * w,
        d * w - a * x - b * y - c * z,
    ]
}

/// The greatest depth of [`resting`] bodies as a share of their size, by level.
const SUNK: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7];

/// Bodies at rest on each other, face on face, with a small overlap.
pub(super) fn resting(level: u32, random: &mut Random) -> Draft3 {
    let sunk = SUNK[level.min(4) as usize] * random.range(0.3, 1.0);
    let (a, b) = match random.below(3) {
        0 => (brick(1.0, random), brick(1.0, random)),
        1 => (cuboid(DVec3::new(4.0, 0.5, 4.0)), solid(1.0, random)),
        _ => (solid(1.0, random), solid(1.0, random)),
    };
    contact((a, Kind::Face), (b, Kind::Face), -sunk, random)
}

/// Random shapes near each other: the easy control.
pub(super) fn random_pair(_level: u32, random: &mut Random) -> Draft3 {
    let (a, b) = (anything(1.0, random), anything(1.0, random));
    let (a, b) = (Body3::new(a, random.turn()), Body3::new(b, random.turn()));
    let offset = random.direction() * (size(&a, &b) * random.range(0.0, 1.1));
    let at = place(random);
    Draft3::placed(a, b, at, at + offset)
}
