//! Rays against spheres and capsules.

use super::{Line, Meeting};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Capsule3};

/// A sphere about the part's origin.
#[inline(always)]
pub(super) fn sphere(line: &Line, radius: f64) -> Meeting {
    is_outside(line.origin.length_squared(), radius, line.doubt)
        .unwrap_or_else(|| enter(line, line.origin, radius))
}

/// For a ray that starts at this distance from a core, given as a square: whether inside or unclear; `None` if it
/// certainly starts outside.
#[inline(always)]
fn is_outside(squared: f64, radius: f64, doubt: f64) -> Option<Meeting> {
    let (outer, inner) = (radius + doubt, radius - doubt);
    if squared > outer * outer {
        return None;
    }
    Some(if inner > 0.0 && squared < inner * inner { Meeting::Inside } else { Meeting::Unclear })
}

/// Where a ray from outside, at `from` as seen from a sphere's centre, enters the sphere, if it does. By the foot of
/// the perpendicular: nothing cancels beyond what the distance has lost.
#[inline(always)]
fn enter(line: &Line, from: DVec3, radius: f64) -> Meeting {
    let inverse = 1.0 / line.squared;
    let to_foot = -from.dot(line.way) * inverse;
    let foot = from + line.way * to_foot;
    let room = radius * radius - foot.length_squared();
    if room < 0.0 || to_foot < 0.0 {
        return Meeting::Never;
    }
    let half_chord = (room * inverse).sqrt();
    let distance = to_foot - half_chord;
    if distance < 0.0 {
        return Meeting::Never;
    }
    let (doubt, pace) = line.doubt_at(distance);
    let error = doubt + off_by(doubt, radius, (room, half_chord * pace));
    Meeting::At(distance, (foot - line.way * half_chord) / radius, error)
}

/// The error of half a chord, given with its square, if the circle's line is off by `doubt`: the root of the error of
/// the square.
#[inline(always)]
fn off_by(doubt: f64, radius: f64, (squared, half_chord): (f64, f64)) -> f64 {
    let off = doubt * (2.0 * radius + doubt);
    if squared > off { off / half_chord } else { (2.0 * off).sqrt() }
}

/// A capsule: its infinite cylinder; where the ray enters that beyond an end, the sphere at that end.
#[inline(always)]
pub(super) fn capsule(line: &Line, basis: &Basis3, capsule: &Capsule3) -> Meeting {
    let radius = f64::from(capsule.radius());
    let [from, to] = capsule.segment().ends().map(|end| end.as_dvec3());
    let axis = basis.turn(to - from);
    let origin = line.origin - basis.turn(from);
    let inverse = 1.0 / axis.length_squared();
    // Along the axis, in lengths of it.
    let place = origin.dot(axis) * inverse;
    let nearest = origin - axis * place.clamp(0.0, 1.0);
    if let Some(known) = is_outside(nearest.length_squared(), radius, line.doubt) {
        return known;
    }
    let cap = |place: f64| enter(line, if place < 0.0 { origin } else { origin - axis }, radius);
    let outside = origin - axis * place;
    if outside.length_squared() <= radius * radius {
        return cap(place);
    }
    let slide = line.way.dot(axis) * inverse;
    let across = line.way - axis * slide;
    let squared = across.length_squared();
    if squared == 0.0 {
        return Meeting::Never;
    }
    // As for a circle, seen along the axis.
    let inverse = 1.0 / squared;
    let to_foot = -outside.dot(across) * inverse;
    let foot = outside + across * to_foot;
    let room = radius * radius - foot.length_squared();
    if room < 0.0 || to_foot < 0.0 {
        return Meeting::Never;
    }
    let half_chord = (room * inverse).sqrt();
    let distance = to_foot - half_chord;
    let along = place + slide * distance;
    if !(0.0..=1.0).contains(&along) {
        return cap(along);
    }
    let ((doubt, pace), crossing) = (line.doubt_at(distance), squared.sqrt());
    let error = doubt + off_by(doubt, radius, (room, half_chord * crossing)) * (pace / crossing);
    Meeting::At(distance, (foot - across * half_chord) / radius, error)
}
