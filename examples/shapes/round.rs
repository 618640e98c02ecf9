//! Normals of round surfaces in the viewer's axes: x right, y up, z towards the viewer.

use asunder::glam::{DVec2, DVec3};
use core::f64::consts::{PI, TAU};

/// Steps along an arc between two faces' normals.
const ARC: usize = 6;
/// Steps of a full turn.
const TURN: usize = 40;

/// The direction at a share of a full turn.
pub(crate) fn facing(turn: f64) -> DVec2 {
    let (sin, cos) = libm::sincos(turn * TAU);
    DVec2::new(cos, sin)
}

/// Unit normals along the shorter arc from one to another, without the last.
pub(crate) fn arc(from: DVec3, to: DVec3) -> impl Iterator<Item = DVec3> {
    let angle = libm::acos(from.dot(to).clamp(-1.0, 1.0));
    let aside = (to - from * from.dot(to)).normalize_or_zero();
    (0..ARC).map(move |i| {
        let (sin, cos) = libm::sincos(angle * i as f64 / ARC as f64);
        from * cos + aside * sin
    })
}

/// Unit normals perpendicular to an axis, counter-clockwise as seen from its tip.
pub(crate) fn ring(axis: DVec3) -> Vec<DVec3> {
    let aside = axis.any_orthonormal_vector();
    let other = axis.cross(aside);
    let at = |i: usize| {
        let facing = facing(i as f64 / TURN as f64);
        aside * facing.x + other * facing.y
    };
    (0..TURN).map(at).collect()
}

/// The range of angles about an edge's axis, between the normals of its two faces, that the viewer sees: 0 and pi are
/// the silhouettes, and pi/2 faces the viewer most directly.
pub(crate) fn strip_range(axis: DVec3, sides: [DVec3; 2]) -> Option<[f64; 2]> {
    let [across, front] = around(axis)?;
    let [one, other] = sides.map(|side| libm::atan2(side.dot(front), side.dot(across)));
    let (low, high) = (one.min(other), one.max(other));
    match (low >= 0.0, high >= 0.0) {
        (true, _) => Some([low, high]),
        (false, false) => None,
        // The shorter arc passes one silhouette or the other.
        (false, true) if high - low < PI => Some([0.0, high]),
        (false, true) => Some([high, PI]),
    }
}

/// Two unit normals of a cylinder about an axis: at its silhouette, and where it faces the viewer most directly. `None`
/// if the viewer looks along the axis.
pub(crate) fn around(axis: DVec3) -> Option<[DVec3; 2]> {
    let across = DVec3::new(-axis.y, axis.x, 0.0).try_normalize()?;
    let front = axis.cross(across);
    Some([across, if front.z < 0.0 { -front } else { front }])
}

/// The visible part of a patch of the unit ball that is given by the normals around it, counter-clockwise as seen from
/// outside. Where the patch crosses the ball's silhouette, the outline follows the silhouette.
pub(crate) fn cap_outline(normals: &[DVec3]) -> Vec<DVec2> {
    let mut outline = Vec::new();
    let mut silhouette_from: Option<f64> = None;
    let mut first_entry: Option<(usize, f64)> = None;
    let after = normals.iter().cycle().skip(1);
    for (&here, &next) in normals.iter().zip(after) {
        if here.z >= 0.0 {
            outline.push(here.truncate());
        }
        if (here.z >= 0.0) == (next.z >= 0.0) {
            continue;
        }
        let crossing = here.lerp(next, here.z / (here.z - next.z)).truncate().normalize_or_zero();
        let angle = libm::atan2(crossing.y, crossing.x);
        if here.z >= 0.0 {
            outline.push(crossing);
            silhouette_from = Some(angle);
        } else {
            match silhouette_from.take() {
                Some(from) => outline.extend(silhouette(from, angle)),
                None => first_entry = Some((outline.len(), angle)),
            }
            outline.push(crossing);
        }
    }
    // The walk began on the hidden side: the silhouette up to the first entry closes the outline.
    if let (Some(from), Some((place, angle))) = (silhouette_from, first_entry) {
        let arc: Vec<DVec2> = silhouette(from, angle).collect();
        outline.splice(place..place, arc);
    }
    outline
}

/// Points of the unit circle from one angle counter-clockwise to another, without both ends.
fn silhouette(from: f64, to: f64) -> impl Iterator<Item = DVec2> {
    let span = if to >= from { to - from } else { to - from + TAU };
    let count = (span / TAU * TURN as f64).ceil().max(1.0) as usize;
    (1..count).map(move |i| facing((from + span * i as f64 / count as f64) / TAU))
}
