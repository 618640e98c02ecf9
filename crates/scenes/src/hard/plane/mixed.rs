//! The other families: deep overlap, thin and round shapes, lines, compounds, drifted rotations, rest, random pairs.

use super::body::{Body2, Draft2, any_angle, direction, place, pose, size, within};
use super::edges::on_grid;
use super::features::{Kind, any_contact, contact};
use super::outlines::{
    anything, capsule, circle, half_extents, outline, plain, polygon, rect, rounded, segment,
};
use crate::hard::gap::{any_gap, gap, sign, stepped, ulps};
use crate::random::Random;
use asunder_geometry::{Compound2, HalfPlane, Pose2, Rotation2, Shape2};
use glam::{DVec2, Vec2};

/// One shape within the other, or their centres near each other.
pub(super) fn deep(level: u32, random: &mut Random) -> Draft2 {
    let width = [1.0, 0.3][random.below(2)];
    let (a, b) = (anything(1.0, random), anything(width, random));
    let angle = any_angle(random);
    let other = if random.unit() < 0.3 { angle } else { any_angle(random) };
    let (a, b) = (Body2::new(a, angle), Body2::new(b, other));
    let share = [0.1, 1e-3, 1e-6, 1e-12, 0.0][level.min(4) as usize];
    let offset = direction(any_angle(random)) * (share * size(&a, &b)) + a.middle() - b.middle();
    let at = place(random);
    Draft2::placed(a, b, at, at + offset)
}

/// Widths of shapes about 1 m long, by level.
const WIDTHS: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// Long and thin shapes, across and beside each other.
pub(super) fn needles(level: u32, random: &mut Random) -> Draft2 {
    let width = WIDTHS[level.min(4) as usize];
    let needle = |random: &mut Random| {
        let (length, width) = (random.range(0.4, 0.8), width * random.range(0.5, 1.0));
        match random.below(3) {
            0 => rect(DVec2::new(length, width)),
            // Round shapes get at least this radius.
            1 => capsule(DVec2::X * length, DVec2::X * -length, width.max(1.01e-6)),
            _ => {
                let middle = random.range(-0.5, 0.5) * length;
                let points = [(length, 0.0), (middle, width), (-length, 0.0), (-middle, -0.3 * width)];
                polygon(&points.map(|(x, y)| DVec2::new(x, y).as_vec2()))
            }
        }
    };
    let a = needle(random);
    let b = if random.unit() < 0.6 { needle(random) } else { outline(1.0, random) };
    let gap = any_gap(random);
    let gap = if random.unit() < 0.5 { gap * width } else { gap };
    any_contact(a, b, gap, random)
}

/// Segments against everything: crossing, collinear and side by side.
pub(super) fn segments(level: u32, random: &mut Random) -> Draft2 {
    let gap = gap(level, random);
    let half = direction(any_angle(random)) * random.range(0.2, 0.6);
    let middle = within(random, 0.3);
    let a = segment(middle - half, middle + half);
    if random.unit() < 0.3 {
        // Collinear: one direction of few bits for both, under one rotation.
        let along = [DVec2::X, DVec2::new(3.0, -1.0) * 0.25][random.below(2)];
        let angle = any_angle(random);
        let body = |half: f64| Body2::new(segment(along * -half, along * half), angle);
        let (a, b) = (body(0.5), body(random.range(0.1, 0.6)));
        let axis = a.turn(along).normalize() * sign(random);
        let gap = gap * size(&a, &b);
        return Draft2::beside(a, b, axis, gap, place(random));
    }
    let b = match random.below(3) {
        0 => segment(half * -0.7, half),
        1 => outline(1.0, random),
        _ => anything(1.0, random),
    };
    any_contact(a, b, gap, random)
}

/// Levels of [`points_and_balls`]: at most 128 ulps off exact contacts, halved at each further level, none at the last.
pub(super) const BALL_LEVELS: u32 = 9;

/// Circles, capsules and rounded rectangles whose centres, ends or corners are an exact distance apart, or ulps from
/// it. Not rotated: in the plane a stored rotation has no exact length.
pub(super) fn points_and_balls(level: u32, random: &mut Random) -> Draft2 {
    if random.unit() < 0.3 {
        let radius = random.log_range(1e-4, 0.3);
        let (a, b) = (rounded(outline(1.0, random), radius), anything(1.0, random));
        let gap = gap(level, random);
        return any_contact(a, b, gap, random);
    }
    let [x, y, length] =
        [[3.0, 4.0, 5.0], [5.0, 12.0, 13.0], [8.0, 15.0, 17.0], [20.0, 21.0, 29.0]][random.below(4)];
    let grid = libm::exp2(-libm::ceil(libm::log2(length)));
    let parts = 2.0 * length;
    let radius_a = 1.0 + random.below(parts as usize - 1) as f64;
    let (radius_a, radius_b) = (radius_a * grid * 0.5, (parts - radius_a) * grid * 0.5);
    let (x, y) = if random.unit() < 0.5 { (x, y) } else { (y, x) };
    let offset = DVec2::new(x * sign(random), y * sign(random)) * grid;
    let (a, end_a) = ball(radius_a, offset, grid, random);
    let (b, end_b) = ball(radius_b, -offset, grid, random);
    let (a, b) = (Body2::turned(a, Rotation2::IDENTITY), Body2::turned(b, Rotation2::IDENTITY));
    let at = if random.unit() < 0.5 { DVec2::ZERO } else { on_grid(within(random, 4.0), 256.0) };
    let mut goal = at + (end_a + offset - end_b);
    let moved = random.below(2);
    let before = goal[moved];
    if level + 1 < BALL_LEVELS {
        goal[moved] = stepped(before, ulps(BALL_LEVELS - 2 - level, random));
    }
    Draft2::placed(a, b, at, goal).claiming(offset.normalize(), (goal[moved] - before).abs())
}

/// A shape with a round end or corner in a given direction, and the centre of that rounding.
fn ball(radius: f64, towards: DVec2, grid: f64, random: &mut Random) -> (Shape2, DVec2) {
    let mut whole = || (1 + random.below(8)) as f64 * grid;
    let half = DVec2::new(whole(), whole());
    let corner = half * towards.signum();
    match random.below(4) {
        0 => (capsule(corner, -corner, radius), corner),
        1 => (rounded(rect(half), radius), corner),
        2 => {
            let points = [corner, -corner, DVec2::new(corner.x, -corner.y)];
            (rounded(polygon(&points.map(|point| point.as_vec2())), radius), corner)
        }
        _ => (circle(radius), DVec2::ZERO),
    }
}

/// Everything, also rounded shapes, on half-planes with tilted normals; and half-planes with opposite normals.
pub(super) fn half_plane(level: u32, random: &mut Random) -> Draft2 {
    let gap = gap(level, random);
    let normal = match random.below(4) {
        0 => DVec2::Y,
        1 => DVec2::new(1.0 + random.below(5) as f64, -1.0 - random.below(5) as f64),
        2 => direction(any_angle(random)) * random.log_range(1e-30, 1e30),
        _ => DVec2::new(random.log_range(1e-12, 1e-3) * sign(random), 1.0),
    };
    let normal = normal.as_vec2();
    let plane = |normal: Vec2| HalfPlane::new(normal).map_or_else(|_| plain(), Shape2::from);
    if random.unit() < 0.15 {
        let angle = any_angle(random);
        let (a, b) = (Body2::new(plane(normal), angle), Body2::new(plane(-normal), angle));
        let axis = a.turn(normal.as_dvec2()).normalize();
        let aside = if random.unit() < 0.5 { DVec2::ZERO } else { axis.perp() * random.range(-1.0, 1.0) };
        let at = place(random);
        return Draft2::placed(a, b, at, at + axis * gap + aside);
    }
    let (b, kind) = (anything(1.0, random), Kind::any(random));
    contact((plane(normal), Kind::Edge), (b, kind), gap, random)
}

/// Compounds of squares on a grid, under one rotation, part on part or part in a notch, by ulps; and of random shapes.
pub(super) fn compounds(level: u32, random: &mut Random) -> Draft2 {
    if random.unit() < 0.4 {
        return scattered(random);
    }
    let cell = 0.125;
    let angle = if random.unit() < 0.5 { 0.0 } else { any_angle(random) };
    let a = notched(cell, random);
    let b = if random.unit() < 0.5 { notched(cell, random) } else { rect(DVec2::splat(cell)) };
    let (a, b) = (Body2::new(a, angle), Body2::new(b, angle));
    let mut cells = || (random.below(9) as f64 - 4.0) * cell;
    let offset = a.turn(DVec2::new(cells(), cells()));
    let at = on_grid(within(random, 4.0), 64.0);
    let mut goal = at + offset;
    for axis in 0..2 {
        goal[axis] = stepped(goal[axis], ulps(8_u32.saturating_sub(2 * level), random));
    }
    Draft2::placed(a, b, at, goal)
}

/// Two to six squares on a grid, rotated by quarter turns: one in the middle, the others at random on or around it.
fn notched(cell: f64, random: &mut Random) -> Shape2 {
    let parts: Vec<(Pose2, Shape2)> = (0..2 + random.below(5))
        .map(|i| {
            let mut steps = || (random.below(3) as f64 - 1.0) * 2.0 * cell;
            let middle = if i == 0 { DVec2::ZERO } else { DVec2::new(steps(), steps()) };
            let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)][random.below(3)];
            let turn = Rotation2::new(cos, sin).unwrap_or_default();
            (pose(middle, turn), rect(DVec2::splat(cell)))
        })
        .collect();
    Compound2::new(parts).map_or_else(|_| plain(), Shape2::from)
}

/// Compounds of random shapes at random, brought near touching along an axis.
fn scattered(random: &mut Random) -> Draft2 {
    let compound = |random: &mut Random| {
        let parts: Vec<(Pose2, Shape2)> = (0..1 + random.below(5))
            .map(|_| {
                let middle = within(random, 0.5);
                let part = Body2::new(anything(0.6, random), any_angle(random));
                (pose(middle, part.rotation), part.shape)
            })
            .collect();
        Compound2::new(parts).map_or_else(|_| plain(), Shape2::from)
    };
    let a = compound(random);
    let b = if random.unit() < 0.5 { compound(random) } else { anything(1.0, random) };
    let (a, b) = (Body2::new(a, any_angle(random)), Body2::new(b, any_angle(random)));
    let gap = any_gap(random) * size(&a, &b);
    let axis = direction(any_angle(random));
    Draft2::beside(a, b, axis, gap, place(random))
}

/// How many products the rotations of [`drifted`] are made of, by level.
const PRODUCTS: [u32; 4] = [10, 100, 1_000, 10_000];

/// Rotations that are products in f32 of up to thousands of f32 rotations; only their constructor normalises them.
pub(super) fn drifted(level: u32, random: &mut Random) -> Draft2 {
    let products = PRODUCTS[level.min(3) as usize];
    let gap = any_gap(random);
    let one = drift(products, random);
    let same = random.unit() < 0.4;
    let other = if same { one } else { drift(products, random) };
    let shape = |random: &mut Random| if same { rect(half_extents(random)) } else { outline(1.0, random) };
    let (a, b) = (Body2::turned(shape(random), one), Body2::turned(shape(random), other));
    let gap = gap * size(&a, &b);
    let axis = if same { a.turn(DVec2::Y).normalize() } else { direction(any_angle(random)) };
    Draft2::beside(a, b, axis, gap, place(random))
}

/// A product of so many rotations by up to 0.1 rad, each a little longer or shorter than 1.
fn drift(products: u32, random: &mut Random) -> Rotation2 {
    let start = direction(any_angle(random));
    let (mut cos, mut sin) = (start.x as f32, start.y as f32);
    let stretch = libm::exp(random.range(-13.8, 13.8) / f64::from(products));
    let step = direction(random.range(0.0, 0.1)) * stretch;
    let (c, s) = (step.x as f32, step.y as f32);
    for _ in 0..products {
        (cos, sin) = (c * cos - s * sin, s * cos + c * sin);
    }
    Rotation2::new(cos, sin).unwrap_or_default()
}

/// The greatest depth of [`resting`] bodies as a share of their size, by level.
const SUNK: [f64; 5] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7];

/// Bodies at rest on each other, edge on edge, with a small overlap.
pub(super) fn resting(level: u32, random: &mut Random) -> Draft2 {
    let sunk = SUNK[level.min(4) as usize] * random.range(0.3, 1.0);
    let a = if random.unit() < 0.3 { rect(DVec2::new(4.0, 0.5)) } else { outline(1.0, random) };
    let b = outline(1.0, random);
    contact((a, Kind::Edge), (b, Kind::Edge), -sunk, random)
}

/// Random shapes near each other: the easy control.
pub(super) fn random_pair(_level: u32, random: &mut Random) -> Draft2 {
    let (a, b) = (anything(1.0, random), anything(1.0, random));
    let (a, b) = (Body2::new(a, any_angle(random)), Body2::new(b, any_angle(random)));
    let offset = direction(any_angle(random)) * (size(&a, &b) * random.range(0.0, 1.1));
    let at = place(random);
    Draft2::placed(a, b, at, at + offset)
}
