//! Scales: far away, tiny, huge, unequal, scaled by powers of two, and denormal.

use super::body::{Body2, Draft2, any_angle, direction, within};
use super::edges::{along, on_grid};
use super::features::{any_contact, any_contact_at};
use super::outlines::{anything, capsule, circle, half_extents, outline, polygon, rect, segment};
use crate::hard::gap::{any_gap, sign};
use crate::pairs::PosedPair2;
use crate::random::Random;
use asunder_geometry::tolerance::MAX_POSITION;
use asunder_geometry::{Rotation2, Shape2};
use glam::{DVec2, Vec2};

/// Levels of [`far`]: from 1e2 m to 1e9 m.
pub(super) const FAR_LEVELS: u32 = 8;

const REACH: [f64; FAR_LEVELS as usize] = [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// A contact far from the origin. At the last level some have a position at the very limit.
pub(super) fn far(level: u32, random: &mut Random) -> Draft2 {
    let reach = REACH[level.min(FAR_LEVELS - 1) as usize];
    if random.unit() < 0.3 {
        return far_bricks(reach, random);
    }
    let gap = any_gap(random);
    let (a, b) = (anything(1.0, random), anything(1.0, random));
    let draft = any_contact_at(a, b, gap, DVec2::ZERO, random);
    let mut shift = direction(any_angle(random)) * (reach - 16.0);
    let offset = draft.pair.pose_b.position() - draft.pair.pose_a.position();
    if random.unit() < 0.25 {
        shift.x = if offset.x > 0.0 { -reach } else { reach };
    }
    moved(draft, shift)
}

/// The pair moved: A to a place, B to its old offset from A, as far as positions can represent it.
fn moved(draft: Draft2, to: DVec2) -> Draft2 {
    let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = draft.pair;
    let to = to.clamp(DVec2::splat(-MAX_POSITION), DVec2::splat(MAX_POSITION));
    let goal = to + (pose_b.position() - pose_a.position());
    let (a, b) = (Body2::turned(shape_a, pose_a.rotation()), Body2::turned(shape_b, pose_b.rotation()));
    let moved = Draft2::placed(a, b, to, goal);
    let lost = 4.0 * f64::EPSILON * to.abs().max_element();
    match draft.claim {
        Some(claim) => moved.claiming(claim.axis, claim.within + lost),
        None => moved,
    }
}

/// Rectangles on a grid of 2^-20 m, edge on edge, or up to two steps of position off that.
fn far_bricks(reach: f64, random: &mut Random) -> Draft2 {
    let grid = libm::exp2(20.0);
    let (a, b) = (on_grid(half_extents(random), grid), on_grid(half_extents(random), grid));
    let at = on_grid(direction(any_angle(random)) * (reach - 16.0), grid);
    let mut offset = on_grid(within(random, 0.9) * (a + b), grid);
    let (axis, side) = (random.below(2), sign(random));
    let step = f64::EPSILON * reach;
    offset[axis] = side * (a[axis] + b[axis]) + (random.below(5) as f64 - 2.0) * step;
    let (a, b) = (Body2::turned(rect(a), Rotation2::IDENTITY), Body2::turned(rect(b), Rotation2::IDENTITY));
    Draft2::placed(a, b, at, at + offset).claiming(along(axis, side), 4.0 * step)
}

/// Size ratios of [`size_ratio`], by level.
const RATIOS: [f64; 6] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// A small shape on a large one. Gaps are shares of the size of either.
pub(super) fn size_ratio(level: u32, random: &mut Random) -> Draft2 {
    let ratio = RATIOS[level.min(5) as usize];
    let large = random.log_range(1.0, 1e4) * 10.0;
    let a = outline(large, random);
    let b = if random.unit() < 0.2 { circle(0.5 * large / ratio) } else { outline(large / ratio, random) };
    let gap = any_gap(random);
    let gap = if random.unit() < 0.7 { gap / ratio } else { gap };
    any_contact(a, b, gap, random)
}

/// Widths of [`tiny`] and [`huge`], by level except the last.
const TINY: [f64; 3] = [1e-3, 1e-4, 1e-5];
const HUGE: [f64; 3] = [1e3, 1e4, 1e5];

/// Small shapes, down to the smallest allowed.
pub(super) fn tiny(level: u32, random: &mut Random) -> Draft2 {
    let gap = any_gap(random);
    let one = |random: &mut Random| match TINY.get(level as usize) {
        Some(&width) => outline(width, random),
        None => least(random),
    };
    let (a, b) = (one(random), one(random));
    let draft = any_contact_at(a, b, gap, DVec2::ZERO, random);
    // Mostly near the origin: 5 m away, one step of a position is a billionth of the size.
    if random.unit() < 0.7 { draft } else { moved(draft, direction(any_angle(random)) * 5.0) }
}

/// A shape with the least bounding radius, 1e-6 m, or hardly more.
fn least(random: &mut Random) -> Shape2 {
    match random.below(3) {
        0 => circle(1e-6),
        1 => rect(DVec2::new(random.range(0.75e-6, 1e-6), random.range(0.75e-6, 1e-6))),
        _ => segment(DVec2::X * 1.01e-6, DVec2::X * -1.01e-6),
    }
}

/// Large shapes, up to the largest allowed.
pub(super) fn huge(level: u32, random: &mut Random) -> Draft2 {
    let gap = any_gap(random);
    let one = |random: &mut Random| match HUGE.get(level as usize) {
        Some(&width) => anything(width, random),
        None => greatest(random),
    };
    let (a, b) = (one(random), one(random));
    any_contact(a, b, gap, random)
}

/// A shape that reaches 1e6 m from its origin, or hardly less.
fn greatest(random: &mut Random) -> Shape2 {
    match random.below(5) {
        0 => circle(1e6),
        1 => rect(DVec2::splat(707_106.0)),
        2 => segment(DVec2::Y * 1e6, DVec2::Y * -1e6),
        3 => polygon(&[Vec2::X * 1e6, Vec2::new(-6e5, 8e5), Vec2::new(-6e5, -8e5)]),
        _ => capsule(DVec2::Y * 9e5, DVec2::Y * -9e5, 1e5),
    }
}

/// Exponents of two of [`scaled`], by level.
const POWERS: [f64; 4] = [3.0, 8.0, 13.0, 17.0];

/// A contact of bodies about 1 m wide, with every number scaled by a power of two.
pub(super) fn scaled(level: u32, random: &mut Random) -> Draft2 {
    let factor = libm::exp2(POWERS[level.min(3) as usize] * sign(random));
    let gap = any_gap(random);
    let (a, b) = (outline(1.0, random), outline(1.0, random));
    let draft = any_contact(a, b, gap, random);
    let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = draft.pair;
    let a = Body2::turned(times(&shape_a, factor as f32), pose_a.rotation());
    let b = Body2::turned(times(&shape_b, factor as f32), pose_b.rotation());
    let scaled = Draft2::placed(a, b, pose_a.position() * factor, pose_b.position() * factor);
    match draft.claim {
        Some(claim) => scaled.claiming(claim.axis, claim.within * factor),
        None => scaled,
    }
}

/// A rectangle or polygon with every coordinate multiplied.
fn times(shape: &Shape2, factor: f32) -> Shape2 {
    if let Shape2::Rect(known) = shape {
        return rect((known.half_extents() * factor).as_dvec2());
    }
    let points: Vec<Vec2> = shape.core().vertices().iter().map(|&vertex| vertex * factor).collect();
    polygon(&points)
}

/// Numbers next to zero: in positions, vertices and rotations.
pub(super) fn denormal(level: u32, random: &mut Random) -> Draft2 {
    let at = nothing(random);
    match level {
        0 => {
            let (a, b) = (half_extents(random), half_extents(random));
            let mut goal = nothing(random);
            let (axis, side) = (random.below(2), sign(random));
            goal[axis] += side * (a[axis] + b[axis]);
            let (a, b) =
                (Body2::turned(rect(a), Rotation2::IDENTITY), Body2::turned(rect(b), Rotation2::IDENTITY));
            Draft2::placed(a, b, at, goal).claiming(along(axis, side), 1e-29)
        }
        1 => {
            let gap = any_gap(random);
            let a = speck(random);
            let b = if random.unit() < 0.5 { speck(random) } else { outline(1.0, random) };
            any_contact(a, b, gap, random)
        }
        _ => {
            let a = if random.unit() < 0.5 { speck(random) } else { outline(1.0, random) };
            let (a, b) = (Body2::turned(a, hardly(random)), Body2::turned(speck(random), hardly(random)));
            if level > 2 {
                return Draft2::placed(a, b, at, nothing(random));
            }
            let axis = if random.unit() < 0.5 { DVec2::X } else { direction(any_angle(random)) };
            Draft2::beside(a, b, axis, any_gap(random), DVec2::ZERO)
        }
    }
}

/// A vector of numbers between 5e-324 and 1e-30, of either sign, or zero.
fn nothing(random: &mut Random) -> DVec2 {
    let mut one = || {
        let power = [-1074.0, -1050.0, -1022.0, -1000.0, -500.0, -149.0, -126.0, -100.0][random.below(8)];
        [0.0, 1.0, -1.0][random.below(3)] * libm::exp2(power)
    };
    DVec2::new(one(), one())
}

/// A triangle or a diamond with denormal coordinates next to ordinary ones.
fn speck(random: &mut Random) -> Shape2 {
    let mut small = || f32::from_bits(1 + random.below(1 << 23) as u32) * sign(random) as f32;
    let points = [
        Vec2::new(0.5, small()),
        Vec2::new(small(), 0.5),
        Vec2::new(-0.5, small()),
        Vec2::new(small(), -f32::MIN_POSITIVE),
        Vec2::new(small(), -0.5),
    ];
    let count = 4 + random.below(2);
    polygon(points.get(..count).unwrap_or(&points))
}

/// A rotation by almost nothing, or by a quarter turn and almost nothing.
fn hardly(random: &mut Random) -> Rotation2 {
    let small = [1e-20_f32, 1e-30, 1e-38, 1e-42, 1.5e-45][random.below(5)] * sign(random) as f32;
    let (cos, sin) = if random.unit() < 0.5 { (1.0, small) } else { (small, 1.0) };
    Rotation2::new(cos, sin).unwrap_or_default()
}
