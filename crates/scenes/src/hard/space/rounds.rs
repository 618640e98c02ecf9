//! Round shapes, hulls with many vertices, prisms.

use super::body::{Body3, Draft3, place, size};
use super::faces::{on_grid, whole_rotation};
use super::features::{Kind, any_contact, contact};
use super::solids::{any_hull, anything, capsule, cuboid, pebble, prism, rounded, solid, sphere};
use crate::hard::gap::{any_gap, gap, sign, stepped, ulps};
use crate::random::Random;
use crate::turn::Turn;
use asunder_geometry::Shape3;
use core::f64::consts::TAU;
use glam::{DVec3, Quat, Vec3};

/// Levels of [`points_and_balls`]: at most 128 ulps off exact contacts, halved at each further level, none at the last.
pub(super) const BALL_LEVELS: u32 = 9;

/// Offsets of whole numbers whose lengths are whole numbers.
const QUADRUPLES: [[f64; 4]; 8] = [
    [3.0, 4.0, 0.0, 5.0],
    [1.0, 2.0, 2.0, 3.0],
    [2.0, 3.0, 6.0, 7.0],
    [1.0, 4.0, 8.0, 9.0],
    [4.0, 4.0, 7.0, 9.0],
    [2.0, 6.0, 9.0, 11.0],
    [5.0, 12.0, 0.0, 13.0],
    [3.0, 4.0, 12.0, 13.0],
];

/// Balls, capsules and rounded solids whose centres, ends or corners are an exact distance apart, or ulps from it.
pub(super) fn points_and_balls(level: u32, random: &mut Random) -> Draft3 {
    if random.unit() < 0.3 {
        return nearly_touching(level, random);
    }
    let q = whole_rotation(random);
    let square: f64 = q.iter().map(|q| q * q).sum();
    let [x, y, z, length] = QUADRUPLES[random.below(QUADRUPLES.len())];
    // A grid on which all numbers here are whole, chosen so that the distance is between half a metre and a metre.
    let grid = square * libm::exp2(-libm::ceil(libm::log2(square * length)));
    let parts = 2.0 * length;
    let radius_a = 1.0 + random.below(parts as usize - 1) as f64;
    // Halved, so that the radii may be odd shares of the distance.
    let (radius_a, radius_b) = (radius_a * grid * 0.5, (parts - radius_a) * grid * 0.5);
    let mut offset = DVec3::new(x * sign(random), y * sign(random), z * sign(random)) * grid;
    for _ in 0..random.below(3) {
        offset = DVec3::new(offset.y, offset.z, offset.x);
    }
    let (a, end_a) = ball(radius_a, offset, grid, random);
    let (b, end_b) = ball(radius_b, -offset, grid, random);
    let rotation = Quat::from_array(q.map(|q| q as f32));
    let (a, b) = (Body3::turned(a, rotation), Body3::turned(b, rotation));
    let whole = a.turn_whole(end_a + offset - end_b, grid * 0.25);
    let axis = crate::turn::unit(a.turn(offset));
    let at = if random.unit() < 0.5 {
        DVec3::ZERO
    } else {
        on_grid(random.within(DVec3::splat(-4.0), DVec3::splat(4.0)), 256.0)
    };
    let mut goal = at + whole;
    let moved = random.below(3);
    let before = goal[moved];
    if level + 1 < BALL_LEVELS {
        goal[moved] = stepped(before, ulps(BALL_LEVELS - 2 - level, random));
    }
    Draft3::placed(a, b, at, goal).claiming(axis, (goal[moved] - before).abs())
}

/// A shape with a round end or corner in a given direction, and the centre of that rounding.
fn ball(radius: f64, towards: DVec3, grid: f64, random: &mut Random) -> (Shape3, DVec3) {
    let away = DVec3::new(
        if towards.x > 0.0 { 1.0 } else { -1.0 },
        if towards.y > 0.0 { 1.0 } else { -1.0 },
        if towards.z > 0.0 { 1.0 } else { -1.0 },
    );
    let mut whole = || (1 + random.below(8)) as f64 * grid;
    let half = DVec3::new(whole(), whole(), whole());
    let corner = half * away;
    match random.below(5) {
        0 => (capsule(corner, -corner, radius), corner),
        1 => (rounded(cuboid(half), radius), corner),
        2 => {
            let far = corner - DVec3::new(away.x * half.x, 0.0, 0.0) * 3.0;
            let points = [corner, far, corner - away * half.y, corner * DVec3::new(1.0, -1.0, 1.0)];
            (rounded(any_hull(&points.map(|p| p.as_vec3())), radius), corner)
        }
        3 => (rounded(any_hull(&[corner.as_vec3()]), radius), corner),
        _ => (sphere(radius), DVec3::ZERO),
    }
}

/// Rounded shapes of all kinds, a small gap apart.
fn nearly_touching(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level.min(super::super::gap::GAPS - 1), random);
    let round = |random: &mut Random| match random.below(4) {
        0 => sphere(random.range(0.2, 0.6)),
        1 => {
            let half = random.direction() * random.range(0.2, 0.6);
            capsule(half, -half, random.range(0.05, 0.4))
        }
        _ => {
            let solid = solid(1.0, random);
            rounded(solid, random.log_range(1e-4, 0.3))
        }
    };
    let (a, b) = (round(random), if random.unit() < 0.7 { round(random) } else { anything(1.0, random) });
    any_contact(a, b, gap, random)
}

/// Vertices of the hulls of [`round_hulls`], by level.
pub(super) const COUNTS: [usize; 4] = [64, 128, 192, 256];

/// Hulls of many vertices: random points on a ball, or points along meridians and parallels.
pub(super) fn round_hulls(level: u32, random: &mut Random) -> Draft3 {
    let count = COUNTS[level.min(3) as usize];
    let gap = any_gap(random);
    let a = if random.unit() < 0.3 { globe(count, random) } else { pebble(count, 1.0, random) };
    let b = match random.below(3) {
        0 => solid(1.0, random),
        1 => globe(count, random),
        _ => pebble(count, 1.0, random),
    };
    any_contact(a, b, gap, random)
}

fn globe(count: usize, random: &mut Random) -> Shape3 {
    let rings = 8;
    let around = count / rings;
    let radius = random.range(0.3, 0.6);
    let point = |ring: usize, i: usize| {
        let latitude = (ring as f64 + 0.5) / rings as f64 * TAU * 0.5;
        let longitude = TAU * i as f64 / around as f64;
        let flat = libm::sin(latitude) * radius;
        DVec3::new(flat * libm::cos(longitude), libm::cos(latitude) * radius, flat * libm::sin(longitude))
            .as_vec3()
    };
    let points: Vec<Vec3> =
        (0..rings).flat_map(|ring| (0..around).map(move |i| (ring, i))).map(|(r, i)| point(r, i)).collect();
    super::solids::hull(&points)
}

/// Sides of the prisms of [`prisms`], by level.
pub(super) const SIDES: [usize; 6] = [3, 5, 8, 16, 32, 64];

/// Prisms over regular polygons, whose caps are one face each, which touch by caps and sides.
pub(super) fn prisms(level: u32, random: &mut Random) -> Draft3 {
    let most = SIDES[level.min(5) as usize];
    let gap = any_gap(random);
    let any = |random: &mut Random| {
        let sides = if random.unit() < 0.5 { most } else { 3 + random.below(most - 2) };
        prism(sides, random.range(0.3, 0.6), random.range(0.1, 0.6))
    };
    let (a, b) = (any(random), any(random));
    if random.unit() < 0.3 {
        return upright(a, b, gap, random);
    }
    contact((a, Kind::Face), (b, Kind::Face), gap, random)
}

/// Cap on cap under one rotation, with no spin between the two.
fn upright(a: Shape3, b: Shape3, gap: f64, random: &mut Random) -> Draft3 {
    let turn = if random.unit() < 0.5 { Turn::IDENTITY } else { random.turn() };
    let (a, b) = (Body3::new(a, turn), Body3::new(b, turn));
    let axis = a.turn(DVec3::Y);
    let aside = a.turn(DVec3::new(random.range(-0.3, 0.3), 0.0, random.range(-0.3, 0.3)));
    let gap = gap * size(&a, &b);
    Draft3::meeting((a, aside), (b, DVec3::ZERO), axis, gap, place(random))
}
