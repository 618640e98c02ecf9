//! What the rounding adds beside the faces: sectors of cylinders along edges, sectors of balls at vertices.
//!
//! ```text
//! for each edge p -> q, with unit direction e, between the faces with normals n1 (left of it) and n2:
//!     its normals are u(t) = n1 cos t + (e x n1) sin t, t in [0, angle]        half a turn for a flat core
//!     add the sector of a cylinder: p + s (q - p) + rho u(t)
//!     on the sphere of normals this is an arc about e; it bounds the regions of p and of q:
//!         T1 of p -= angle e / 2          T2 of p -= sym(A e^T) / 3, with A = integral of u
//!         T1 of q += the same             T2 of q += the same
//! for each vertex, with T0 = full turn - the sum of its face angles (Gauss and Bonnet: also right for flat cores):
//!     add the sector of a ball, v + rho w with w in its region, by
//!         T0 = integral of 1, T1 = integral of w, T2 = integral of w w^T = (T0 I + sums above) / 3
//! ```
//!
//! T1 and T2 are Arvo's boundary integrals for arcs p -> q about k: T1 is the sum of angle k / 2, and 3 T2 is T0 I minus the
//! sum of (k x (q - p)) k^T; here k is -e at the edge's origin and e at its end, and e x (n1 - n2) is A. No quotient has
//! the sine of an angle below it, so nothing happens where neighbouring faces are nearly one plane or back to back.

use super::second::{Second, cross};
use super::volume::Moments;
use crate::cores::Core3;
use core::f64::consts::{PI, TAU};
use glam::DVec3;

/// Adds what lies beside edges and vertices. `vertices` are the core's, about the origin of the moments.
pub(super) fn add_rounding(moments: &mut Moments, core: &Core3<'_>, vertices: &[DVec3], r: f64) {
    let mut regions = vec![Region::default(); vertices.len()];
    for &edge in core.topology().edges() {
        let (from, to) = core.topology().ends(edge as usize);
        let (p, q) = (vertices[from], vertices[to]);
        let length = (q - p).length();
        let along = (q - p) / length;
        let Some(sector) = sector_of(core, edge as usize, along) else { continue };
        add_cylinder_sector(moments, [p, q], &sector, r);
        let (half, bend) = (along * (sector.angle / 2.0), Second::pair(sector.pull, along) * 0.5);
        regions[from].bounded_by(half * -1.0, bend * -1.0);
        regions[to].bounded_by(half, bend);
    }
    for (vertex, solid_angle) in solid_angles(core, vertices).into_iter().enumerate() {
        add_ball_sector(moments, vertices[vertex], &regions[vertex], solid_angle, r);
    }
}

/// The normals of an edge: unit vectors on an arc.
struct Sector {
    angle: f64,
    /// Integral of the vectors.
    pull: DVec3,
    /// Integral of their tensors.
    spread: Second,
}

/// Nothing for an edge so short that its faces' normals do not turn about it.
fn sector_of(core: &Core3<'_>, edge: usize, along: DVec3) -> Option<Sector> {
    let half_edge = core.topology().half_edges()[edge];
    let twin = core.topology().half_edges()[half_edge.twin as usize];
    let (Some(&left), Some(&right)) =
        (core.normals().get(half_edge.face as usize), core.normals().get(twin.face as usize))
    else {
        // A segment: all the way around.
        let spread = (Second::round(1.0) + Second::of(along) * -1.0) * PI;
        return Some(Sector { angle: TAU, pull: DVec3::ZERO, spread });
    };
    // Normals of merged faces are perpendicular to the edge up to the flatness of a face only.
    let upright = |normal: DVec3| (normal - along * normal.dot(along)).try_normalize();
    let (from, to) = (upright(left)?, upright(right)?);
    let across = along.cross(from);
    let (cos, mut sin) = (from.dot(to), across.dot(to));
    if cos < 0.0 {
        // Half a turn, around a flat core, must not become minus half a turn by rounding.
        sin = sin.abs();
    }
    let angle = libm::atan2(sin, cos);
    let (half, wave) = (angle / 2.0, sin * cos / 2.0);
    let spread = Second::of(from) * (half + wave)
        + Second::of(across) * (half - wave)
        + Second::pair(from, across) * (sin * sin / 2.0);
    Some(Sector { angle, pull: from * sin + across * (1.0 - cos), spread })
}

fn add_cylinder_sector(moments: &mut Moments, [p, q]: [DVec3; 2], sector: &Sector, r: f64) {
    let (length, middle) = ((q - p).length(), (p + q) * 0.5);
    let (square, cube) = (length * r * r / 2.0, length * r * r * r / 3.0);
    let line = (Second::of(p) + Second::of(q) + Second::of(p + q)) * (1.0 / 6.0);
    moments.add(
        square * sector.angle,
        middle * (square * sector.angle) + sector.pull * cube,
        line * (square * sector.angle)
            + Second::pair(middle, sector.pull) * cube
            + sector.spread * (length * r * r * r * r / 4.0),
    );
}

/// The normals of a vertex: a polygon on the unit sphere, as sums over its arcs.
#[derive(Clone, Copy, Default)]
struct Region {
    /// Integral of the vectors.
    pull: DVec3,
    /// Three times the integral of their tensors, less the solid angle on its diagonal.
    bend: Second,
}

impl Region {
    fn bounded_by(&mut self, pull: DVec3, bend: Second) {
        self.pull += pull;
        self.bend += bend;
    }
}

fn add_ball_sector(moments: &mut Moments, vertex: DVec3, region: &Region, solid_angle: f64, r: f64) {
    let (cube, fourth) = (r * r * r / 3.0, r * r * r * r / 4.0);
    let spread = (Second::round(solid_angle) + region.bend) * (1.0 / 3.0);
    moments.add(
        solid_angle * cube,
        vertex * (solid_angle * cube) + region.pull * fourth,
        Second::of(vertex) * (solid_angle * cube)
            + Second::pair(vertex, region.pull) * fourth
            + spread * (r * r * r * r * r / 5.0),
    );
}

/// The solid angle of each vertex's normals.
fn solid_angles(core: &Core3<'_>, vertices: &[DVec3]) -> Vec<f64> {
    let whole = if vertices.len() == 1 { 2.0 * TAU } else { TAU };
    let mut angles = vec![whole; vertices.len()];
    if core.normals().is_empty() {
        return angles;
    }
    for (index, half_edge) in core.topology().half_edges().iter().enumerate() {
        let ((from, corner), (_, to)) =
            (core.topology().ends(index), core.topology().ends(half_edge.next as usize));
        let (back, on) = (vertices[from] - vertices[corner], vertices[to] - vertices[corner]);
        angles[corner] -= libm::atan2(cross(on, back).length(), on.dot(back));
    }
    angles
}
