//! The moments of a rounding beside the faces: sectors of cylinders along edges, sectors of balls at vertices.
//!
//! ```text
//! for each edge p -> q, with unit direction e, between the faces with normals n1 (left of it) and n2:
//!     its normals are u(t) = n1 cos t + (e x n1) sin t, t in [0, angle]        half a turn for a flat core
//!     add the sector of a cylinder: p + s (q - p) + rho u(t)
//!     on the unit sphere this is an arc about e, between the regions of p and of q:
//!         pull of p -= angle e / 2,  pull of q += angle e / 2
//! for each vertex, whose solid angle = full turn - the sum of its face angles (Gauss and Bonnet; also for flat cores):
//!     add the sector of a ball, v + rho w with w in its region, from the solid angle and pull = integral of w
//! once: the integral of rho^2 w w^T, which does not depend on vertices: all sectors together make one ball
//! ```
//!
//! The pull is Lambert's formula, the first of Arvo's irradiance tensors: for a region left of arcs about unit axes k,
//! it is the sum of angle k / 2; here k is -e at the edge's origin and e at its end. There is no division by the sine
//! of an angle, so neighbouring faces that are nearly coplanar or back to back are no special case.

use super::second::{Second, cross};
use super::volume::Moments;
use crate::cores::Core3;
use core::f64::consts::{PI, TAU};
use glam::DVec3;

/// Adds the sectors along edges and at vertices. `vertices` are the core's, about the origin of the moments.
pub(super) fn add_rounding(moments: &mut Moments, core: &Core3<'_>, vertices: &[DVec3], r: f64) {
    let mut pulls = vec![DVec3::ZERO; vertices.len()];
    for &edge in core.topology().edges() {
        let (from, to) = core.topology().ends(edge as usize);
        let (p, q) = (vertices[from], vertices[to]);
        let along = (q - p) / (q - p).length();
        let Some(sector) = sector_of(core, edge as usize, along) else { continue };
        add_cylinder_sector(moments, [p, q], &sector, r);
        let half = along * (sector.angle / 2.0);
        pulls[from] -= half;
        pulls[to] += half;
    }
    for ((&vertex, pull), solid_angle) in vertices.iter().zip(pulls).zip(solid_angles(core, vertices)) {
        let (volume, pull) = (solid_angle * r * r * r / 3.0, pull * (r * r * r * r / 4.0));
        let second = Second::of(vertex) * volume + Second::pair(vertex, pull);
        moments.add(volume, vertex * volume + pull, second);
    }
    moments.add(0.0, DVec3::ZERO, Second::round(4.0 / 15.0 * PI * r * r * r * r * r));
}

/// The unit normals of an edge, an arc.
struct Sector {
    angle: f64,
    /// Integral of the vectors.
    pull: DVec3,
    /// Integral of their tensors.
    spread: Second,
}

/// `None` for an edge so short that the normals of its faces do not turn about it.
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
    // Normals of merged faces are perpendicular to the edge only up to the flatness of a face.
    let upright = |normal: DVec3| (normal - along * normal.dot(along)).try_normalize();
    let (from, to) = (upright(left)?, upright(right)?);
    let across = along.cross(from);
    let (cos, mut sin) = (from.dot(to), across.dot(to));
    if cos < 0.0 {
        // Around a flat core, rounding must not turn half a turn into minus half a turn.
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

/// The solid angle of the normals of each vertex.
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
