//! Vertices and edges brought into contact: the twin of the module for space.

use super::body::{Body2, Draft2, any_angle, direction, place, size};
use super::outlines::{outline, rect, ring};
use crate::hard::gap::{any_gap, gap, sign};
use crate::random::Random;
use asunder_geometry::Shape2;
use glam::DVec2;

/// The kind of feature with which a body touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    Vertex,
    Edge,
}

impl Kind {
    pub(super) fn any(random: &mut Random) -> Self {
        [Self::Vertex, Self::Edge][random.below(2)]
    }
}

/// A point of a shape's core, and a unit direction in which the core is supported there; in local axes.
#[derive(Clone, Copy, Debug)]
struct Feature {
    kind: Kind,
    point: DVec2,
    axis: DVec2,
}

/// A shape without edges gives a vertex; the edge of a half-plane is its boundary line.
fn feature(shape: &Shape2, kind: Kind, random: &mut Random) -> Feature {
    if let Shape2::HalfPlane(half_plane) = shape {
        return Feature { kind: Kind::Edge, point: DVec2::ZERO, axis: half_plane.unit_normal() };
    }
    let core = shape.core();
    let vertices = core.vertices();
    if kind == Kind::Edge && vertices.len() > 1 {
        let index = random.below(vertices.len());
        let ends = [vertices.get(index), vertices.get((index + 1) % vertices.len())];
        if let [Some(from), Some(to)] = ends {
            let (from, to) = (from.as_dvec2(), to.as_dvec2());
            let along = (to - from).normalize_or_zero();
            let axis = DVec2::new(along.y, -along.x);
            if axis != DVec2::ZERO {
                return Feature { kind, point: from + (to - from) * random.range(0.1, 0.9), axis };
            }
        }
    }
    let axis = direction(any_angle(random));
    Feature { kind: Kind::Vertex, point: shape.support(axis).unwrap_or_default(), axis }
}

/// Where A is placed, and the angle in radians by which the features' directions are misaligned.
#[derive(Clone, Copy)]
struct Stance {
    at: DVec2,
    tilt: f64,
}

/// A feature of A on a feature of B, apart by `gap` times their size, to which half-planes add nothing.
fn met(a: (Shape2, Kind), b: (Shape2, Kind), gap: f64, stance: Stance, random: &mut Random) -> Draft2 {
    let (on_a, on_b) = (feature(&a.0, a.1, random), feature(&b.0, b.1, random));
    let angle_a = if random.unit() < 0.3 { 0.0 } else { any_angle(random) };
    let facing = libm::atan2(-on_a.axis.y, -on_a.axis.x) - libm::atan2(on_b.axis.y, on_b.axis.x);
    let (a, b) = (Body2::new(a.0, angle_a), Body2::new(b.0, angle_a + facing + stance.tilt));
    let axis = match (on_a.kind, on_b.kind) {
        (Kind::Vertex, Kind::Edge) => -b.turn(on_b.axis),
        _ => a.turn(on_a.axis),
    };
    let gap = gap * size(&a, &b);
    let (point_a, point_b) = (a.turn(on_a.point), b.turn(on_b.point));
    Draft2::meeting((a, point_a), (b, point_b), axis.normalize(), gap, stance.at)
}

/// A feature of A on a feature of B, apart by `gap` times their size.
pub(super) fn contact(a: (Shape2, Kind), b: (Shape2, Kind), gap: f64, random: &mut Random) -> Draft2 {
    let at = place(random);
    met(a, b, gap, Stance { at, tilt: 0.0 }, random)
}

/// Two shapes that touch with random features.
pub(super) fn any_contact(a: Shape2, b: Shape2, gap: f64, random: &mut Random) -> Draft2 {
    let at = place(random);
    any_contact_at(a, b, gap, at, random)
}

/// As [`any_contact`], with A at a given place.
pub(super) fn any_contact_at(a: Shape2, b: Shape2, gap: f64, at: DVec2, random: &mut Random) -> Draft2 {
    let kinds = [Kind::any(random), Kind::any(random)];
    met((a, kinds[0]), (b, kinds[1]), gap, Stance { at, tilt: 0.0 }, random)
}

pub(super) fn vertex_edge(level: u32, random: &mut Random) -> Draft2 {
    let gap = gap(level, random);
    let (a, b) = (outline(1.0, random), outline(1.0, random));
    contact((a, Kind::Edge), (b, Kind::Vertex), gap, random)
}

pub(super) fn vertex_vertex(level: u32, random: &mut Random) -> Draft2 {
    let gap = gap(level, random);
    let (a, b) = (outline(1.0, random), outline(1.0, random));
    contact((a, Kind::Vertex), (b, Kind::Vertex), gap, random)
}

/// Angles between the edges of [`parallel_edges`], by level.
pub(super) const ANGLES: [f64; 8] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0];

/// An edge along an edge, at a small or zero angle.
pub(super) fn parallel_edges(level: u32, random: &mut Random) -> Draft2 {
    let angle = ANGLES[level.min(7) as usize] * sign(random);
    let gap = any_gap(random);
    // An f32 rotation resolves angles to 6e-8; near the identity its sine resolves any.
    if level > 3 || random.unit() < 0.3 {
        let half = |random: &mut Random| super::outlines::half_extents(random);
        let (a, b) = (Body2::new(rect(half(random)), 0.0), Body2::new(rect(half(random)), angle));
        let (axis, side) = (random.below(2), sign(random));
        let axis = super::edges::along(axis, side);
        let gap = gap * size(&a, &b);
        let slack = angle.abs() * size(&a, &b);
        return Draft2::beside(a, b, axis, gap, place(random)).claiming(axis, gap.abs() + slack);
    }
    let a = (outline(1.0, random), Kind::Edge);
    let b = (outline(1.0, random), Kind::Edge);
    let at = place(random);
    let draft = met(a, b, gap, Stance { at, tilt: angle }, random);
    let reach = f64::from(draft.pair.shape_a.outer_radius() + draft.pair.shape_b.outer_radius());
    match draft.claim {
        Some(claim) => draft.claiming(claim.axis, claim.within + angle.abs() * reach),
        None => draft,
    }
}

/// Sides of [`polygons`], by level.
pub(super) const SIDES: [usize; 8] = [3, 5, 8, 16, 64, 256, 1024, 4096];

/// Polygons of many sides, nearly touching.
pub(super) fn polygons(level: u32, random: &mut Random) -> Draft2 {
    let sides = SIDES[level.min(7) as usize];
    let gap = any_gap(random);
    let (a, b) = (ring(sides, 1.0, random), ring(sides, 1.0, random));
    let b = if random.unit() < 0.3 { outline(1.0, random) } else { b };
    any_contact(a, b, gap, random)
}
