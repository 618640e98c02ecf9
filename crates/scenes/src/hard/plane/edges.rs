//! Edge against edge: off by ulps, rotated, on a grid, stacked.

use super::body::{Body2, Draft2, any_angle, within};
use super::outlines::{anything, half_extents, outline, rect};
use crate::hard::gap::{gap, sign, stepped, ulps};
use crate::random::Random;
use asunder_geometry::{Rotation2, Shape2};
use glam::DVec2;

/// Levels of [`edge_ulps`]: at most 256 ulp, 128, and so on down to one.
pub(super) const ULP_LEVELS: u32 = 9;

/// Two axis-aligned rectangles that touch along one axis, with a gap or overlap of a few ulps.
pub(super) fn edge_ulps(level: u32, random: &mut Random) -> Draft2 {
    let (a, b) = (half_extents(random), half_extents(random));
    let reach = [1.0, 8.0, 1000.0][random.below(3)];
    // On a coarse grid, so that the sum with two f32 extents is exact and 0 ulp means touching.
    let at = on_grid(within(random, reach), 1024.0);
    let axis = random.below(2);
    let mut goal = at + within(random, 0.8) * (a + b);
    let steps = ulps(ULP_LEVELS - 1 - level, random);
    let side = sign(random);
    let touching = at[axis] + side * (a[axis] + b[axis]);
    let ulp = if random.unit() < 0.3 { f64::from(f32::EPSILON) * 0.5 } else { ulp_of(touching) };
    goal[axis] = touching + side * steps as f64 * ulp;
    let mut within = steps.unsigned_abs() as f64 * ulp;
    // A quarter of the pairs touch only at a corner.
    if random.unit() < 0.25 {
        let other = 1 - axis;
        let steps = ulps(ULP_LEVELS - 1 - level, random);
        goal[other] = stepped(at[other] + a[other] + b[other], steps);
        within += 2.0 * steps.unsigned_abs() as f64 * ulp_of(goal[other]);
    }
    let (a, b) = (upright(a), upright(b));
    Draft2::placed(a, b, at, goal).claiming(along(axis, side), within)
}

fn upright(half_extents: DVec2) -> Body2 {
    Body2::turned(rect(half_extents), Rotation2::IDENTITY)
}

/// A unit vector along an axis.
pub(super) fn along(axis: usize, side: f64) -> DVec2 {
    if axis == 0 { DVec2::new(side, 0.0) } else { DVec2::new(0.0, side) }
}

fn ulp_of(value: f64) -> f64 {
    (stepped(value, 1) - value).abs()
}

/// The nearest point whose coordinates are whole multiples of `1 / parts`.
pub(super) fn on_grid(point: DVec2, parts: f64) -> DVec2 {
    (point * parts).round() / parts
}

/// Two rectangles under one rotation, edge on edge. The stored cosine and sine are f32, so their products with extents
/// of few bits are exact in f64, and so is the position at which the rectangles touch.
pub(super) fn edge_rotated(level: u32, random: &mut Random) -> Draft2 {
    let gap = gap(level, random);
    let turn = Body2::new(rect(DVec2::ONE), any_angle(random)).rotation;
    let grid = if random.unit() < 0.5 { 1024.0 } else { 16_777_216.0 };
    let (a, b) = (on_grid(half_extents(random), grid), on_grid(half_extents(random), grid));
    let mut local = on_grid(within(random, 0.9) * (a + b), grid);
    let (axis, side) = (random.below(2), sign(random));
    local[axis] = side * (a[axis] + b[axis]);
    let size = a.length() + b.length();
    let (a, b) = (Body2::turned(rect(a), turn), Body2::turned(rect(b), turn));
    // The stored matrix keeps lengths only up to rounding; the normal must have length 1.
    let normal = a.turn(along(axis, side)).normalize();
    let at = if random.unit() < 0.5 { DVec2::ZERO } else { on_grid(within(random, 4.0), 256.0) };
    let goal = at + a.turn(local) + normal * (gap * size);
    Draft2::placed(a, b, at, goal).claiming(normal, gap.abs() * size)
}

/// Two rectangles on a grid that exactly share an edge, a corner or more, rotated by quarter turns.
pub(super) fn coincident_edges(level: u32, random: &mut Random) -> Draft2 {
    // At level 2 the extents are not dyadic; but they are f32, so their sums are still exact in f64.
    let unit = if level < 2 { 0.125 } else { f64::from([0.1_f32, 0.3, 0.7, 1.1][random.below(4)]) * 0.25 };
    let mut extents =
        || DVec2::new([1.0, 2.0, 4.0][random.below(3)], [1.0, 2.0, 4.0][random.below(3)]) * unit;
    let (a, b) = (extents(), extents());
    let quarter = |random: &mut Random| {
        let (cos, sin) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][random.below(4)];
        if level == 0 { Rotation2::IDENTITY } else { Rotation2::new(cos, sin).unwrap_or_default() }
    };
    let (turn_a, turn_b) = (quarter(random), quarter(random));
    let reach =
        |half: DVec2, turn: Rotation2| if turn.cos() == 0.0 { DVec2::new(half.y, half.x) } else { half };
    let (reach_a, reach_b) = (reach(a, turn_a), reach(b, turn_b));
    let mut offset = DVec2::ZERO;
    for axis in 0..2 {
        let flush = [reach_a[axis] - reach_b[axis], 0.0, reach_a[axis] + reach_b[axis], unit];
        offset[axis] = flush[random.below(4)] * sign(random);
    }
    let (axis, side) = (random.below(2), sign(random));
    offset[axis] = side * (reach_a[axis] + reach_b[axis]);
    let at = on_grid(within(random, 20.0), 8.0);
    let (a, b) = (Body2::turned(rect(a), turn_a), Body2::turned(rect(b), turn_b));
    Draft2::placed(a, b, at, at + offset).claiming(along(axis, side), 0.0)
}

/// Courses of rectangles whose heights are multiples of 0.1: positions are summed in f64 or f32, and extents are f32.
pub(super) fn stack(level: u32, random: &mut Random) -> Draft2 {
    let tenths = |random: &mut Random| (1 + random.below(9)) as f64 * 0.1;
    let half = |random: &mut Random| (DVec2::new(tenths(random), tenths(random)) * 0.5).as_vec2().as_dvec2();
    let (a, b) = (half(random), half(random));
    let courses = 1 + random.below([1, 10, 100, 1000][level.min(3) as usize]);
    let step = 2.0 * a.y;
    let mut height = [0.0_f64, 0.1, 0.3][random.below(3)];
    let in_f32 = random.unit() < 0.5;
    for _ in 0..courses {
        height = if in_f32 {
            f64::from(height as f32 + step as f32)
        } else {
            height + (step * 10.0).round() / 10.0
        };
    }
    let above = height + a.y + b.y;
    let above = if in_f32 { f64::from(above as f32) } else { above };
    let x = random.below(10) as f64 * 0.1;
    let beside = random.below(10) as f64 * 0.1 * (a.x + b.x);
    let (a, b) = (upright(a), upright(b));
    Draft2::placed(a, b, DVec2::new(x, height), DVec2::new(x + beside, above))
        .claiming(DVec2::Y, 2e-7 * height.max(1.0))
}

/// The same shape twice, in the same or nearly the same pose.
pub(super) fn identical(level: u32, random: &mut Random) -> Draft2 {
    let shape: Shape2 = if random.unit() < 0.5 { anything(1.0, random) } else { outline(1.0, random) };
    let angle = if random.unit() < 0.3 { 0.0 } else { any_angle(random) };
    let at = on_grid(within(random, 8.0), 1024.0);
    let mut goal = at;
    match level {
        0 => {}
        1 => goal += on_grid(super::body::direction(any_angle(random)) * random.log_range(1e-3, 0.5), 1024.0),
        2 => goal[random.below(2)] += random.log_range(1e-15, 1e-3) * sign(random),
        _ => {
            for axis in 0..2 {
                goal[axis] = stepped(goal[axis], random.below(3) as i64 - 1);
            }
        }
    }
    let (a, b) = (Body2::new(shape.clone(), angle), Body2::new(shape, angle));
    Draft2::placed(a, b, at, goal)
}
