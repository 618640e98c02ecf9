//! Needles, plates, slivers, flat shapes, segments.

use super::body::{Body3, Draft3, place, size};
use super::features::{Kind, any_contact, contact};
use super::solids::{any_hull, capsule, cuboid, hull, prism, segment, solid, triangle};
use crate::hard::gap::{any_gap, gap, sign, stepped_f32};
use crate::random::Random;
use asunder_geometry::Shape3;
use core::f64::consts::TAU;
use glam::{DVec3, Vec3};

/// Widths of shapes about 1 m long, by level.
const WIDTHS: [f64; THIN_LEVELS as usize] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

/// Levels of [`needles`], [`plates`] and [`slivers`].
pub(super) const THIN_LEVELS: u32 = 5;

/// What a level of [`needles`], [`plates`] and [`slivers`] means.
pub(super) const THIN_KNOB: &str = "one in 100 thick at level 0, a tenth of that each level on";

/// Round shapes get at least this radius.
const LEAST: f64 = 1.01e-6;

fn width(level: u32) -> f64 {
    WIDTHS[level.min(THIN_LEVELS - 1) as usize]
}

/// Long and thin solids against each other and against ordinary solids.
pub(super) fn needles(level: u32, random: &mut Random) -> Draft3 {
    let needle = |random: &mut Random| {
        let (length, width) = (random.range(0.4, 0.8), width(level) * random.range(0.5, 1.0));
        match random.below(4) {
            0 => cuboid(DVec3::new(width, length, width)),
            1 => prism(3 + random.below(6), width, length),
            2 => capsule(DVec3::Y * length, DVec3::Y * -length, width.max(LEAST)),
            _ => splinter(length, width, random),
        }
    };
    let a = needle(random);
    let b = if random.unit() < 0.6 { needle(random) } else { solid(1.0, random) };
    let kinds = [[Kind::Edge; 2], [Kind::any(random), Kind::any(random)]][random.below(2)];
    let gap = thin_gap(level, random);
    contact((a, kinds[0]), (b, kinds[1]), gap, random)
}

/// A tetrahedron with one long edge, and a short one beside its middle.
fn splinter(length: f64, width: f64, random: &mut Random) -> Shape3 {
    let mut off = || random.range(-0.3, 0.3) * length;
    let points = [
        DVec3::new(0.0, length, 0.0),
        DVec3::new(0.0, -length, 0.0),
        DVec3::new(width, off(), 0.0),
        DVec3::new(0.0, off(), width),
    ];
    hull(&points.map(|point| point.as_vec3()))
}

/// A gap of any level, as a share of the size or of the thickness.
fn thin_gap(level: u32, random: &mut Random) -> f64 {
    let gap = any_gap(random);
    if random.unit() < 0.5 { gap * width(level) } else { gap }
}

/// Thin plates on each other, across each other, and against ordinary solids.
pub(super) fn plates(level: u32, random: &mut Random) -> Draft3 {
    let plate = |random: &mut Random| {
        let (reach, width) = (random.within(DVec3::splat(0.3), DVec3::splat(0.8)), width(level));
        match random.below(3) {
            0 => cuboid(DVec3::new(reach.x, width, reach.z)),
            1 => prism(3 + random.below(10), reach.x, width),
            _ => shard(reach, width, random),
        }
    };
    let a = plate(random);
    let b = if random.unit() < 0.6 { plate(random) } else { solid(1.0, random) };
    let gap = thin_gap(level, random);
    any_contact(a, b, gap, random)
}

/// The hull of points in a thin slab.
fn shard(reach: DVec3, width: f64, random: &mut Random) -> Shape3 {
    let count = 6 + random.below(10);
    let slab = DVec3::new(reach.x, width, reach.z);
    let points: Vec<Vec3> = (0..count).map(|_| random.within(-slab, slab).as_vec3()).collect();
    hull(&points)
}

/// Hulls with vertices nearly on one line or in one plane, so that facets are slivers.
pub(super) fn slivers(level: u32, random: &mut Random) -> Draft3 {
    let a = sliver(level, random);
    let b = if random.unit() < 0.5 { sliver(level, random) } else { solid(1.0, random) };
    let gap = any_gap(random);
    any_contact(a, b, gap, random)
}

/// A box with more points on its edges and faces, each moved outwards a little.
fn sliver(level: u32, random: &mut Random) -> Shape3 {
    let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6));
    let mut points: Vec<Vec3> =
        (0..8_u32).map(|i| (half * DVec3::new(side(i, 0), side(i, 1), side(i, 2))).as_vec3()).collect();
    for _ in 0..1 + random.below(12) {
        let mut point = random.within(DVec3::NEG_ONE, DVec3::ONE);
        let fixed = random.below(3);
        point[fixed] = point[fixed].signum();
        // On an edge half of the time, else within a face.
        if random.unit() < 0.5 {
            let other = (fixed + 1) % 3;
            point[other] = point[other].signum();
        }
        let out = 1.0 + width(level) * random.range(0.0, 0.3);
        let mut point = (point * half * out).as_vec3();
        point.x = stepped_f32(point.x, random.below(5) as i32 - 2);
        points.push(point);
    }
    hull(&points)
}

fn side(index: u32, bit: u32) -> f64 {
    if index >> bit & 1 == 1 { 1.0 } else { -1.0 }
}

/// A flat shape: a triangle or a flat hull, in the plane y = 0 or, half as often, in an oblique plane.
fn sheet(random: &mut Random) -> Shape3 {
    let reach = random.range(0.3, 0.6);
    let count = 3 + random.below(8);
    let start = random.range(0.0, TAU);
    let corner = |i: usize| {
        let angle = start + TAU * i as f64 / count as f64;
        DVec3::new(reach * libm::cos(angle), 0.0, reach * libm::sin(angle))
    };
    match random.below(3) {
        0 => triangle([corner(0), corner(count / 3), corner(2 * count / 3)]),
        1 => {
            // z = x + 2y keeps points of a coarse grid exactly in one plane.
            let grid = |value: f64| (value * 64.0).round() / 64.0;
            let points: Vec<Vec3> = (0..count)
                .map(|i| {
                    let (x, y) = (grid(corner(i).x), grid(corner(i).z));
                    DVec3::new(x, y, x + 2.0 * y).as_vec3()
                })
                .collect();
            any_hull(&points)
        }
        _ => {
            let points: Vec<Vec3> = (0..count).map(|i| corner(i).as_vec3()).collect();
            any_hull(&points)
        }
    }
}

/// Flat hulls and triangles against solids and each other.
pub(super) fn flat(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let a = sheet(random);
    if random.unit() < 0.3 {
        let b = sheet(random);
        return coplanar(a, b, gap, random);
    }
    let b = if random.unit() < 0.5 { sheet(random) } else { solid(1.0, random) };
    any_contact(a, b, gap, random)
}

/// Two sheets under one rotation; sheets in y = 0 lie side by side in one plane.
fn coplanar(a: Shape3, b: Shape3, gap: f64, random: &mut Random) -> Draft3 {
    let turn = if random.unit() < 0.5 { random.turn() } else { crate::turn::Turn::IDENTITY };
    let (a, b) = (Body3::new(a, turn), Body3::new(b, turn));
    let angle = random.range(0.0, TAU);
    let axis = a.turn(DVec3::new(libm::cos(angle), 0.0, libm::sin(angle)));
    let gap = gap * size(&a, &b);
    Draft3::beside(a, b, axis, gap, place(random))
}

/// Segments against segments and everything else: crossing, collinear and side by side.
pub(super) fn segments(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let rod = |random: &mut Random| {
        let half = random.direction() * random.range(0.2, 0.6);
        let middle = random.within(DVec3::splat(-0.3), DVec3::splat(0.3));
        segment(middle - half, middle + half)
    };
    let a = rod(random);
    match random.below(4) {
        0 => {
            let b = rod(random);
            contact((a, Kind::Edge), (b, Kind::Edge), gap, random)
        }
        1 => collinear(gap, random),
        2 => {
            let b = solid(1.0, random);
            contact((a, Kind::Edge), (b, Kind::Edge), gap, random)
        }
        _ => {
            let b = super::solids::anything(1.0, random);
            any_contact(a, b, gap, random)
        }
    }
}

/// Two segments along one line, end to end, or side by side.
fn collinear(gap: f64, random: &mut Random) -> Draft3 {
    let (one, other) = (random.range(0.2, 0.6), random.range(0.2, 0.6));
    let along = [DVec3::X, DVec3::new(1.0, 2.0, -3.0) * 0.25][random.below(2)];
    let turn = random.turn();
    let body = |half: f64| Body3::new(segment(along * -half, along * half), turn);
    let (a, b) = (body(one), body(other));
    let gap = gap * size(&a, &b);
    if random.unit() < 0.5 {
        let axis = crate::turn::unit(a.turn(along)) * sign(random);
        return Draft3::beside(a, b, axis, gap, place(random));
    }
    let axis = crate::turn::unit(a.turn(along).cross(random.direction()));
    let (on_a, on_b) = (a.turn(along) * random.range(-0.1, 0.1), b.turn(along) * random.range(-0.1, 0.1));
    Draft3::meeting((a, on_a), (b, on_b), axis, gap, place(random))
}
