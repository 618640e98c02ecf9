//! Rays against spheres and capsules.

use super::{Line, Meeting};
use asunder_geometry::Capsule3;
use asunder_geometry::glam::DVec3;

/// A sphere. The foot of the perpendicular from its centre comes first: nothing cancels that the distance did not lose.
pub(super) fn sphere(line: &Line, center: DVec3, radius: f64) -> Meeting {
    let from = line.origin - center;
    let height = from.length() - radius;
    if height <= line.doubt {
        return if height < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    enter(line, center, radius).unwrap_or(Meeting::Never)
}

/// Where a ray from outside enters a sphere, if it does.
fn enter(line: &Line, center: DVec3, radius: f64) -> Option<Meeting> {
    let from = line.origin - center;
    let to_foot = -from.dot(line.along);
    let foot = from + line.along * to_foot;
    let squared = radius * radius - foot.length_squared();
    if squared < 0.0 {
        return None;
    }
    let half_chord = squared.sqrt();
    let distance = to_foot - half_chord;
    if distance < 0.0 {
        return None;
    }
    // The root of what is off by so much.
    let doubt = line.doubt + 64.0 * f64::EPSILON * distance;
    let off = doubt * (2.0 * radius + doubt);
    let error = doubt + if squared > off { off / half_chord } else { (2.0 * off).sqrt() };
    Some(Meeting::At(distance, (foot - line.along * half_chord) / radius, error))
}

/// A capsule: its cylinder without ends, and where the ray enters that beyond an end, the sphere there.
pub(super) fn capsule(line: &Line, capsule: &Capsule3) -> Meeting {
    let radius = f64::from(capsule.radius());
    let [from, to] = capsule.segment().ends().map(|end| end.as_dvec3());
    let way = to - from;
    let length = way.length();
    let axis = way / length;
    let origin = line.origin - from;
    let place = origin.dot(axis);
    let height = (origin - axis * place.clamp(0.0, length)).length() - radius;
    if height <= line.doubt {
        return if height < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    let cap = |place: f64| enter(line, if place < 0.0 { from } else { to }, radius).unwrap_or(Meeting::Never);
    let outside = origin - axis * place;
    if outside.length_squared() <= radius * radius {
        return cap(place);
    }
    let across = line.along - axis * line.along.dot(axis);
    let pace = across.length();
    if pace == 0.0 {
        return Meeting::Never;
    }
    // As for a circle, seen along the axis.
    let unit = across / pace;
    let to_foot = -outside.dot(unit);
    let foot = outside + unit * to_foot;
    let squared = radius * radius - foot.length_squared();
    if squared < 0.0 || to_foot < 0.0 {
        return Meeting::Never;
    }
    let half_chord = squared.sqrt();
    let distance = (to_foot - half_chord) / pace;
    let along = place + line.along.dot(axis) * distance;
    if !(0.0..=length).contains(&along) {
        return cap(along);
    }
    let doubt = line.doubt + 64.0 * f64::EPSILON * distance;
    let off = doubt * (2.0 * radius + doubt);
    let error = doubt + if squared > off { off / half_chord } else { (2.0 * off).sqrt() } / pace;
    Meeting::At(distance, (foot - unit * half_chord) / radius, error)
}
