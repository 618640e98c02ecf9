//! Vertices, edges and faces brought into contact.
//!
//! ```text
//! feature of A, with a direction that it supports       feature of B, with one of its own
//!    turn A at random, turn B until its direction opposes A's, then spin B about that direction
//!    round both rotations to f32; take the axis from the rounded bodies (normal of a face, cross product of edges)
//!    put point on point, then move B along the axis until the separation along it is the wanted gap
//! ```
//! Both features support the axis up to the rounding of rotations, so the gap is also the distance, up to as much.

use super::body::{Body3, Draft3, place, size};
use super::solids::{brick, cuboid, hull, prism, solid};
use crate::hard::gap::{any_gap, gap, sign};
use crate::random::Random;
use crate::turn::{Turn, unit};
use asunder_geometry::{Core3, Shape3};
use core::f64::consts::TAU;
use glam::{DVec3, Quat};

/// The kind of feature with which a body touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Vertex,
    Edge,
    Face,
}

impl Kind {
    pub(super) fn any(random: &mut Random) -> Self {
        [Self::Vertex, Self::Edge, Self::Face][random.below(3)]
    }
}

/// A point of a shape's core, and a unit direction in which the core is supported there; in local axes.
#[derive(Clone, Copy, Debug)]
struct Feature {
    kind: Kind,
    point: DVec3,
    axis: DVec3,
    /// For an edge, its unit direction; else zero.
    along: DVec3,
}

/// A shape without such a feature gives one of the next lower dimension: a ball gives a vertex.
fn feature(shape: &Shape3, kind: Kind, random: &mut Random) -> Feature {
    if let Shape3::HalfSpace(half_space) = shape {
        let axis = half_space.unit_normal();
        return Feature { kind: Kind::Face, point: DVec3::ZERO, axis, along: DVec3::ZERO };
    }
    let core = shape.core();
    let found = match kind {
        Kind::Vertex => None,
        Kind::Edge => edge(&core, random),
        Kind::Face => face(&core, random),
    };
    found.unwrap_or_else(|| vertex(shape, random.direction()))
}

fn vertex(shape: &Shape3, axis: DVec3) -> Feature {
    let point = shape.support(axis).unwrap_or_default();
    Feature { kind: Kind::Vertex, point, axis, along: DVec3::ZERO }
}

fn corner(core: &Core3<'_>, index: usize) -> DVec3 {
    core.vertices().get(index).map(|vertex| vertex.as_dvec3()).unwrap_or_default()
}

fn edge(core: &Core3<'_>, random: &mut Random) -> Option<Feature> {
    let topology = core.topology();
    let edges = topology.edges();
    let half_edge = usize::from(*edges.get(random.below(edges.len()))?);
    let (from, to) = topology.ends(half_edge);
    let (from, to) = (corner(core, from), corner(core, to));
    let along = unit(to - from);
    let one = topology.half_edges().get(half_edge)?;
    let other = topology.half_edges().get(usize::from(one.twin));
    let normal = |face: u16| core.normals().get(usize::from(face)).copied();
    let share = random.range(0.2, 0.8);
    let axis = match (normal(one.face), other.and_then(|other| normal(other.face))) {
        // Two opposite faces leave a half circle of supported directions, as does a sharp edge by its rounding: take
        // its middle.
        (Some(n), Some(m)) if n.dot(m) < -0.99 => {
            unit(along.cross(n) + along.cross(-m) + (n - m) * random.range(-0.5, 0.5))
        }
        (Some(n), Some(m)) => n * share + m * (1.0 - share),
        _ => random.direction(),
    };
    let axis = unit(axis - along * axis.dot(along));
    let point = from + (to - from) * random.range(0.1, 0.9);
    (along.is_finite() && axis.is_finite()).then_some(Feature { kind: Kind::Edge, point, axis, along })
}

fn face(core: &Core3<'_>, random: &mut Random) -> Option<Feature> {
    let count = core.normals().len();
    // Half of the time the face with most corners: a prism's cap, one among many sides.
    let corners = |face: usize| core.topology().face_vertices(face).len();
    let index =
        if random.unit() < 0.5 { (0..count).max_by_key(|&i| corners(i))? } else { random.below(count) };
    let axis = *core.normals().get(index)?;
    let (mut point, mut sum) = (DVec3::ZERO, 0.0);
    for i in core.topology().face_vertices(index) {
        let weight = random.range(0.1, 1.0);
        point += corner(core, i) * weight;
        sum += weight;
    }
    Some(Feature { kind: Kind::Face, point: point / sum, axis, along: DVec3::ZERO })
}

/// A feature of A on a feature of B, apart by `gap` times their size, at a place as by [`place`].
pub(super) fn contact(a: (Shape3, Kind), b: (Shape3, Kind), gap: f64, random: &mut Random) -> Draft3 {
    let at = place(random);
    contact_at(a, b, gap, at, random)
}

/// As [`contact`], with A at a given place. Half-spaces add nothing to the size.
fn contact_at(a: (Shape3, Kind), b: (Shape3, Kind), gap: f64, at: DVec3, random: &mut Random) -> Draft3 {
    let (on_a, on_b) = (feature(&a.0, a.1, random), feature(&b.0, b.1, random));
    let turn_a = if random.unit() < 0.3 { Turn::IDENTITY } else { random.turn() };
    let up = turn_a.apply(on_a.axis);
    let spin = Turn::about(up, random.range(0.0, TAU));
    let turn_b = spin.after(Turn::between(on_b.axis, -up));
    let (a, b) = (Body3::new(a.0, turn_a), Body3::new(b.0, turn_b));
    let axis = true_axis((&a, on_a), (&b, on_b), up);
    let gap = gap * size(&a, &b);
    let (point_a, point_b) = (a.turn(on_a.point), b.turn(on_b.point));
    Draft3::meeting((a, point_a), (b, point_b), axis, gap, at)
}

/// The axis that the features share, after their rotations are rounded.
fn true_axis(a: (&Body3, Feature), b: (&Body3, Feature), up: DVec3) -> DVec3 {
    let along = |(body, feature): (&Body3, Feature)| body.turn(feature.along);
    let axis = match (a.1.kind, b.1.kind) {
        (Kind::Face, _) => a.0.turn(a.1.axis),
        (_, Kind::Face) => -b.0.turn(b.1.axis),
        (Kind::Edge, Kind::Edge) => {
            let across = along(a).cross(along(b));
            if across.length_squared() < 1e-4 { up } else { across * across.dot(up).signum() }
        }
        (Kind::Edge, Kind::Vertex) => up - along(a) * up.dot(along(a)),
        (Kind::Vertex, Kind::Edge) => up - along(b) * up.dot(along(b)),
        (Kind::Vertex, Kind::Vertex) => up,
    };
    unit(axis)
}

/// Two shapes that touch with random features.
pub(super) fn any_contact(a: Shape3, b: Shape3, gap: f64, random: &mut Random) -> Draft3 {
    let at = place(random);
    any_contact_at(a, b, gap, at, random)
}

/// As [`any_contact`], with A at a given place.
pub(super) fn any_contact_at(a: Shape3, b: Shape3, gap: f64, at: DVec3, random: &mut Random) -> Draft3 {
    let kinds = [Kind::any(random), Kind::any(random)];
    contact_at((a, kinds[0]), (b, kinds[1]), gap, at, random)
}

/// A brick half of the time, else any solid.
fn block(random: &mut Random) -> Shape3 {
    if random.unit() < 0.5 { brick(1.0, random) } else { solid(1.0, random) }
}

pub(super) fn vertex_face(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let (a, b) = (block(random), block(random));
    contact((a, Kind::Face), (b, Kind::Vertex), gap, random)
}

pub(super) fn vertex_edge(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let (a, b) = (block(random), block(random));
    contact((a, Kind::Edge), (b, Kind::Vertex), gap, random)
}

pub(super) fn vertex_vertex(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    let (a, b) = (block(random), block(random));
    contact((a, Kind::Vertex), (b, Kind::Vertex), gap, random)
}

/// Two cubes, an edge of one across an edge of the other. For half of the pairs all numbers are whole.
pub(super) fn crossed_edges(level: u32, random: &mut Random) -> Draft3 {
    let gap = gap(level, random);
    if random.unit() < 0.5 {
        return whole_crossing(gap, random);
    }
    let cube = |random: &mut Random| cuboid(DVec3::splat(random.range(0.3, 0.6)));
    let (a, b) = (cube(random), cube(random));
    contact((a, Kind::Edge), (b, Kind::Edge), gap, random)
}

/// The quaternion (m, 0, 0, n) rotates about x by an angle whose sine and cosine are 2mn and n^2 - m^2, over m^2 + n^2.
/// A cube as wide as twice that sum then has its upper edges at whole heights.
fn whole_crossing(gap: f64, random: &mut Random) -> Draft3 {
    let tilt = |random: &mut Random| {
        let (m, n) = [(1.0, 2.0), (1.0, 3.0), (2.0, 3.0), (1.0, 4.0), (3.0, 4.0)][random.below(5)];
        (m * sign(random), n)
    };
    let ((m_a, n_a), (m_b, n_b)) = (tilt(random), tilt(random));
    let half = |m: f64, n: f64| (m * m + n * n) / 64.0;
    // The height of the rotated square's upper edge: half its width times |sine| + |cosine|.
    let height = |m: f64, n: f64| ((2.0 * m * n).abs() + (n * n - m * m).abs()) / 64.0;
    let (half_a, half_b) = (half(m_a, n_a), half(m_b, n_b));
    let up = height(m_a, n_a) + height(m_b, n_b);
    let (x, y) = (random.range(-0.9, 0.9) * half_a, random.range(-0.9, 0.9) * half_b);
    // The y of A's upper edge, and the x of B's lower edge: within the cubes' extents, the edges cross.
    let lean = |m: f64, n: f64| ((n * n - m * m).abs() - (2.0 * m * n).abs()) / 64.0;
    let a = Body3::turned(cuboid(DVec3::splat(half_a)), Quat::from_xyzw(m_a as f32, 0.0, 0.0, n_a as f32));
    let b = Body3::turned(cuboid(DVec3::splat(half_b)), Quat::from_xyzw(0.0, m_b as f32, 0.0, n_b as f32));
    let gap = gap * size(&a, &b);
    let snap = |value: f64| (value * 256.0).round() / 256.0;
    let shift = DVec3::new(
        snap(x) - lean(m_b, n_b) * m_b.signum(),
        snap(y) + lean(m_a, n_a) * m_a.signum(),
        up + gap,
    );
    let at = super::faces::on_grid(random.within(DVec3::splat(-4.0), DVec3::splat(4.0)), 64.0);
    Draft3::placed(a, b, at, at + shift).claiming(DVec3::Z, gap.abs())
}

/// Angles between the edges of [`parallel_edges`], by level.
pub(super) const ANGLES: [f64; 8] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0];

/// An edge along an edge, at a small or zero angle.
pub(super) fn parallel_edges(level: u32, random: &mut Random) -> Draft3 {
    let angle = ANGLES[level.min(7) as usize] * sign(random);
    let gap = any_gap(random);
    let beam = |random: &mut Random| match random.below(3) {
        0 => brick(1.0, random),
        1 => prism(3 + random.below(8), random.range(0.2, 0.5), random.range(0.3, 0.6)),
        _ => frustum(random),
    };
    // An f32 quaternion resolves angles to 6e-8; near the identity it resolves any.
    let in_axes = level > 3 || random.unit() < 0.5;
    let (a, b) =
        if in_axes { (brick(1.0, random), brick(1.0, random)) } else { (beam(random), beam(random)) };
    let (on_a, on_b) = if in_axes {
        (beam_edge(&a, DVec3::new(1.0, 1.0, 0.0), random), beam_edge(&b, DVec3::new(-1.0, -1.0, 0.0), random))
    } else {
        (feature(&a, Kind::Edge, random), feature(&b, Kind::Edge, random))
    };
    let turn_a = if in_axes && random.unit() < 0.5 { Turn::IDENTITY } else { random.turn() };
    let (up, along) = (turn_a.apply(on_a.axis), turn_a.apply(on_a.along));
    let tip = Turn::between(on_b.axis, -up);
    let turned = tip.apply(on_b.along);
    let needed = libm::atan2(along.dot(up.cross(turned)), along.dot(turned));
    let aligned = if in_axes { turn_a } else { Turn::about(up, needed).after(tip) };
    // Rotated about the axis the edges cross at the angle; rotated in the plane of axis and edge, one end is deeper.
    let about = if random.unit() < 0.7 { up } else { unit(up.cross(along)) };
    let turn_b = Turn::about(about, angle).after(aligned);
    let (a, b) = (Body3::new(a, turn_a), Body3::new(b, turn_b));
    let (point_a, point_b) = (a.turn(on_a.point), b.turn(on_b.point));
    let gap = gap * size(&a, &b);
    // In the latter case one end touches first, deeper by up to the angle times the size.
    let slack = angle.abs() * size(&a, &b);
    Draft3::meeting((a, point_a), (b, point_b), up, gap, place(random)).claiming(up, gap.abs() + slack)
}

/// The edge along z of a brick that lies in the given direction.
fn beam_edge(brick: &Shape3, towards: DVec3, random: &mut Random) -> Feature {
    let half = brick.support(DVec3::ONE).unwrap_or(DVec3::ONE);
    let point = DVec3::new(half.x * towards.x, half.y * towards.y, half.z * random.range(-0.8, 0.8));
    Feature { kind: Kind::Edge, point, axis: unit(towards), along: DVec3::Z }
}

/// A brick with a top smaller than its bottom.
fn frustum(random: &mut Random) -> Shape3 {
    let half = random.within(DVec3::splat(0.3), DVec3::splat(0.6));
    let taper = random.range(0.3, 0.95);
    let corner = |i: u32| {
        let side = |bit: u32| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let share = if side(1) > 0.0 { taper } else { 1.0 };
        (half * DVec3::new(side(0) * share, side(1), side(2) * share)).as_vec3()
    };
    let points: Vec<glam::Vec3> = (0..8).map(corner).collect();
    hull(&points)
}
