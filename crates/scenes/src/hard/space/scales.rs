//! Scales: far away, tiny, huge, unequal, scaled by powers of two, and denormal.

use super::body::{Body3, Draft3};
use super::features::{any_contact, any_contact_at};
use super::solids::{anything, brick, capsule, cuboid, hull, segment, solid, sphere, triangle};
use crate::hard::gap::{any_gap, sign};
use crate::pairs::PosedPair3;
use crate::random::Random;
use asunder_geometry::Shape3;
use asunder_geometry::tolerance::MAX_POSITION;
use glam::{DVec3, Quat, Vec3};

/// Levels of [`far`]: from 1e2 m to 1e9 m.
pub(super) const FAR_LEVELS: u32 = 8;

const REACH: [f64; FAR_LEVELS as usize] = [1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];

/// A contact far from the origin. At the last level some have a position at the very limit.
pub(super) fn far(level: u32, random: &mut Random) -> Draft3 {
    let reach = REACH[level.min(FAR_LEVELS - 1) as usize];
    if random.unit() < 0.3 {
        return far_bricks(reach, random);
    }
    let gap = any_gap(random);
    let (a, b) = (anything(1.0, random), anything(1.0, random));
    let draft = any_contact_at(a, b, gap, DVec3::ZERO, random);
    let mut shift = random.direction() * (reach - 16.0);
    let offset = draft.pair.pose_b.position() - draft.pair.pose_a.position();
    if random.unit() < 0.25 {
        shift.x = if offset.x > 0.0 { -reach } else { reach };
    }
    moved(draft, shift)
}

/// The pair moved: A to a place, B to its old offset from A, as far as positions can represent it.
fn moved(draft: Draft3, to: DVec3) -> Draft3 {
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = draft.pair;
    let to = to.clamp(DVec3::splat(-MAX_POSITION), DVec3::splat(MAX_POSITION));
    let goal = to + (pose_b.position() - pose_a.position());
    let (a, b) = (Body3::turned(shape_a, pose_a.rotation()), Body3::turned(shape_b, pose_b.rotation()));
    let moved = Draft3::placed(a, b, to, goal);
    let lost = 4.0 * f64::EPSILON * to.abs().max_element();
    match draft.claim {
        Some(claim) => moved.claiming(claim.axis, claim.within + lost),
        None => moved,
    }
}

/// Bricks on a grid of 2^-20 m, face on face, or steps of a position off that.
fn far_bricks(reach: f64, random: &mut Random) -> Draft3 {
    let grid = libm::exp2(-20.0);
    let snap = |v: DVec3| (v / grid).round() * grid;
    let half = |random: &mut Random| snap(random.within(DVec3::splat(0.3), DVec3::splat(0.6)));
    let (a, b) = (half(random), half(random));
    let at = snap(random.direction() * (reach - 16.0));
    let mut offset = snap(random.within(DVec3::splat(-0.9), DVec3::splat(0.9)) * (a + b));
    let axis = random.below(3);
    let side = sign(random);
    let step = f64::EPSILON * reach;
    let steps = random.below(5) as f64 - 2.0;
    offset[axis] = side * (a[axis] + b[axis]) + steps * step;
    let mut along = DVec3::ZERO;
    along[axis] = side;
    let (a, b) = (Body3::turned(cuboid(a), Quat::IDENTITY), Body3::turned(cuboid(b), Quat::IDENTITY));
    Draft3::placed(a, b, at, at + offset).claiming(along, 4.0 * step)
}

/// Size ratios of [`size_ratio`], by level.
const RATIOS: [f64; 6] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// A small shape on a large one. Gaps are shares of the size of either.
pub(super) fn size_ratio(level: u32, random: &mut Random) -> Draft3 {
    let ratio = RATIOS[level.min(5) as usize];
    let large = random.log_range(10.0, 1e5);
    let (a, b) = (solid(large, random), solid(large / ratio, random));
    let (a, b) = if random.unit() < 0.2 { (a, sphere(0.5 * large / ratio)) } else { (a, b) };
    let gap = any_gap(random);
    let gap = if random.unit() < 0.7 { gap / ratio } else { gap };
    any_contact(a, b, gap, random)
}

/// Widths of [`tiny`], by level except the last.
const TINY: [f64; 3] = [1e-3, 1e-4, 1e-5];

/// Small shapes, down to the smallest allowed.
pub(super) fn tiny(level: u32, random: &mut Random) -> Draft3 {
    let gap = any_gap(random);
    let one = |random: &mut Random| match TINY.get(level as usize) {
        Some(&width) => solid(width, random),
        None => least(random),
    };
    let (a, b) = (one(random), one(random));
    let draft = any_contact_at(a, b, gap, DVec3::ZERO, random);
    // Mostly near the origin: 5 m away, one step of a position is a billionth of the size.
    if random.unit() < 0.7 { draft } else { moved(draft, random.direction() * 5.0) }
}

/// A shape with the least bounding radius, 1e-6 m, or hardly more.
fn least(random: &mut Random) -> Shape3 {
    match random.below(4) {
        0 => sphere(1e-6),
        1 => cuboid(DVec3::new(0.58e-6, 0.58e-6, 0.58e-6)),
        2 => segment(DVec3::X * 1.01e-6, DVec3::X * -1.01e-6),
        _ => cuboid(DVec3::new(1e-6, 1e-6, 1e-6) * random.within(DVec3::splat(0.6), DVec3::ONE)),
    }
}

/// Widths of [`huge`], by level except the last.
const HUGE: [f64; 3] = [1e3, 1e4, 1e5];

/// Large shapes, up to the largest allowed.
pub(super) fn huge(level: u32, random: &mut Random) -> Draft3 {
    let gap = any_gap(random);
    let one = |random: &mut Random| match HUGE.get(level as usize) {
        Some(&width) => anything(width, random),
        None => greatest(random),
    };
    let (a, b) = (one(random), one(random));
    any_contact(a, b, gap, random)
}

/// A shape that reaches 1e6 m from its origin, or hardly less.
fn greatest(random: &mut Random) -> Shape3 {
    match random.below(5) {
        0 => sphere(1e6),
        1 => cuboid(DVec3::splat(577_350.0)),
        2 => segment(DVec3::Y * 1e6, DVec3::Y * -1e6),
        3 => triangle([DVec3::X * 1e6, DVec3::new(-6e5, 8e5, 0.0), DVec3::new(0.0, -6e5, 8e5)]),
        _ => capsule(DVec3::Y * 9e5, DVec3::Y * -9e5, 1e5),
    }
}

/// Exponents of two of [`scaled`], by level.
const POWERS: [f64; 4] = [3.0, 8.0, 13.0, 17.0];

/// A contact of bodies about 1 m wide, with every number scaled by a power of two.
pub(super) fn scaled(level: u32, random: &mut Random) -> Draft3 {
    let power = POWERS[level.min(3) as usize] * sign(random);
    let gap = any_gap(random);
    let (a, b) = (solid(1.0, random), solid(1.0, random));
    let draft = any_contact(a, b, gap, random);
    let factor = libm::exp2(power);
    let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = draft.pair;
    let a = Body3::turned(times(&shape_a, factor as f32), pose_a.rotation());
    let b = Body3::turned(times(&shape_b, factor as f32), pose_b.rotation());
    let scaled = Draft3::placed(a, b, pose_a.position() * factor, pose_b.position() * factor);
    match draft.claim {
        Some(claim) => scaled.claiming(claim.axis, claim.within * factor),
        None => scaled,
    }
}

/// A cuboid or hull with every coordinate multiplied.
fn times(shape: &Shape3, factor: f32) -> Shape3 {
    if let Shape3::Cuboid(known) = shape {
        return cuboid((known.half_extents() * factor).as_dvec3());
    }
    let points: Vec<Vec3> = shape.core().vertices().iter().map(|&vertex| vertex * factor).collect();
    hull(&points)
}

/// Numbers next to zero: in positions, vertices and rotations.
pub(super) fn denormal(level: u32, random: &mut Random) -> Draft3 {
    match level {
        0 => near_places(random),
        1 => small_vertices(random),
        2 => small_rotations(random),
        _ => {
            let a = if random.unit() < 0.5 { speck(random) } else { brick(1.0, random) };
            let b = speck(random);
            let (a, b) = (Body3::turned(a, small_rotation(random)), Body3::turned(b, small_rotation(random)));
            Draft3::placed(a, b, nothing(random), nothing(random))
        }
    }
}

/// A vector of numbers between 5e-324 and 1e-30, of either sign, or zero.
fn nothing(random: &mut Random) -> DVec3 {
    let mut one = || {
        let power = [-1074.0, -1050.0, -1022.0, -1000.0, -500.0, -149.0, -126.0, -100.0][random.below(8)];
        [0.0, 1.0, -1.0][random.below(3)] * libm::exp2(power)
    };
    DVec3::new(one(), one(), one())
}

/// Bricks that touch exactly except for a tiny difference; or one within the other.
fn near_places(random: &mut Random) -> Draft3 {
    let half = |random: &mut Random| random.within(DVec3::splat(0.3), DVec3::splat(0.6)).as_vec3().as_dvec3();
    let (a, b) = (half(random), half(random));
    let (at, mut goal) = (nothing(random), nothing(random));
    if random.unit() < 0.2 {
        let (a, b) = (Body3::turned(cuboid(a), Quat::IDENTITY), Body3::turned(cuboid(b), Quat::IDENTITY));
        return Draft3::placed(a, b, at, goal);
    }
    let (axis, side) = (random.below(3), sign(random));
    goal[axis] += side * (a[axis] + b[axis]);
    let mut along = DVec3::ZERO;
    along[axis] = side;
    let (a, b) = (Body3::turned(cuboid(a), Quat::IDENTITY), Body3::turned(cuboid(b), Quat::IDENTITY));
    Draft3::placed(a, b, at, goal).claiming(along, 1e-29)
}

/// A tetrahedron, an octahedron or a brick with denormal coordinates next to ordinary ones.
fn speck(random: &mut Random) -> Shape3 {
    let mut small = || f64::from(f32::from_bits(1 + random.below(1 << 23) as u32)) * sign(random);
    let mut off = || DVec3::new(small(), small(), small());
    let points: Vec<DVec3> = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z]
        .into_iter()
        .map(|corner| corner * 0.5 + off())
        .collect();
    let count = 4 + random.below(3);
    let mut points: Vec<Vec3> = points.iter().take(count).map(|point| point.as_vec3()).collect();
    points.push(Vec3::new(0.0, f32::from_bits(1), -f32::MIN_POSITIVE));
    hull(&points)
}

fn small_vertices(random: &mut Random) -> Draft3 {
    let a = speck(random);
    let b = if random.unit() < 0.5 { speck(random) } else { solid(1.0, random) };
    let gap = any_gap(random);
    if random.unit() < 0.5 {
        return any_contact(a, b, gap, random);
    }
    let (a, b) = (Body3::turned(a, Quat::IDENTITY), Body3::turned(b, Quat::IDENTITY));
    let axis = [DVec3::X, DVec3::Y, DVec3::NEG_Z][random.below(3)];
    Draft3::beside(a, b, axis, gap, DVec3::ZERO)
}

/// A rotation whose components are tiny, all of them or all but one.
fn small_rotation(random: &mut Random) -> Quat {
    let scale = [1e-20, 1e-30, 1e-38, 1e-42, 1.5e-45][random.below(5)];
    let turn = random.turn();
    let mut parts = [turn.v.x, turn.v.y, turn.v.z, turn.w].map(|part| (part * scale) as f32);
    if random.unit() < 0.5 {
        parts[random.below(4)] = 1.0;
    }
    // At the smallest scale all of them may have been rounded to zero.
    if parts == [0.0; 4] {
        parts[3] = f32::from_bits(1);
    }
    Quat::from_array(parts)
}

fn small_rotations(random: &mut Random) -> Draft3 {
    let (a, b) = (solid(1.0, random), solid(1.0, random));
    let one = small_rotation(random);
    let other = if random.unit() < 0.5 { one } else { small_rotation(random) };
    let (a, b) = (Body3::turned(a, one), Body3::turned(b, other));
    let axis = if random.unit() < 0.5 { a.turn(DVec3::Y) } else { random.direction() };
    let gap = any_gap(random);
    Draft3::beside(a, b, axis, gap, DVec3::ZERO)
}
