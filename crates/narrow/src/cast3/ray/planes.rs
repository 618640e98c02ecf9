//! Rays against what planes bound.

use super::{Line, Meeting};
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Core3, Cuboid, HalfSpace, Hull, Triangle3};

/// Sine of the angle to a triangle's plane below which it counts as seen edge on.
const EDGE_ON: f64 = 1e-6;

/// Between the planes of which pairs the ray is: a box by slabs.
pub(super) fn cuboid(line: &Line, cuboid: &Cuboid) -> Meeting {
    let half = cuboid.half_extents().as_dvec3();
    let beyond = (line.origin.abs() - half).max_element();
    if beyond <= line.doubt {
        return if beyond < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    let (mut enter, mut leave, mut face) = (f64::NEG_INFINITY, f64::INFINITY, 0);
    for axis in 0..3 {
        let (at, pace) = (line.origin[axis], line.along[axis]);
        if pace == 0.0 {
            if at.abs() > half[axis] {
                return Meeting::Never;
            }
            continue;
        }
        // Where it passes the middle, and how long it is inside to both sides of that.
        let inverse = 1.0 / pace;
        let (middle, span) = (-at * inverse, half[axis] * inverse.abs());
        if middle - span > enter {
            (enter, face) = (middle - span, axis);
        }
        leave = leave.min(middle + span);
    }
    if enter > leave || enter < 0.0 {
        return Meeting::Never;
    }
    let pace = line.along[face];
    let mut normal = DVec3::ZERO;
    normal[face] = -pace.signum();
    Meeting::At(enter, normal, line.error(enter, pace.abs(), 0.0))
}

/// Inside of all planes: the ray enters some and leaves others.
pub(super) fn hull(line: &Line, hull: &Hull, core: &Core3) -> Meeting {
    let (mut enter, mut leave, mut furthest) = (f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
    let mut face = DVec3::X;
    for (&normal, &height) in core.normals().iter().zip(core.heights()) {
        let (beyond, pace) = (normal.dot(line.origin) - height, normal.dot(line.along));
        furthest = furthest.max(beyond);
        let distance = -beyond / pace;
        if pace < 0.0 {
            if distance > enter {
                (enter, face) = (distance, normal);
            }
        } else if pace > 0.0 {
            leave = leave.min(distance);
        } else if beyond > line.doubt {
            return Meeting::Never;
        }
    }
    if furthest <= line.doubt {
        // Faces prove nothing inwards, a sphere inside does.
        let from_center = (line.origin - core.center().as_dvec3()).length();
        let is_deep = from_center + line.doubt < f64::from(core.inner_radius());
        return if is_deep { Meeting::Inside } else { Meeting::Unclear };
    }
    if enter > leave || enter < 0.0 {
        return Meeting::Never;
    }
    let off = 4.0 * f64::from(hull.planarity_error());
    let error = line.error(enter, face.dot(line.along).abs(), off).min(2.0 * f64::from(hull.outer_radius()));
    Meeting::At(enter, face, error)
}

/// One plane.
pub(super) fn half_space(line: &Line, half_space: &HalfSpace) -> Meeting {
    let normal = half_space.unit_normal();
    let (height, pace) = (normal.dot(line.origin), -normal.dot(line.along));
    if height <= line.doubt {
        return if height < -line.doubt { Meeting::Inside } else { Meeting::Unclear };
    }
    let distance = height / pace;
    // Away from it or along it; so nearly along it that it is out of range.
    if pace <= 0.0 || !distance.is_finite() {
        return Meeting::Never;
    }
    Meeting::At(distance, normal, line.error(distance, pace, 0.0))
}

/// Where it meets the triangle's plane, if that is on the inner side of all edges up to rounding.
pub(super) fn triangle(line: &Line, triangle: &Triangle3) -> Meeting {
    let [a, b, c] = triangle.vertices().map(|vertex| vertex.as_dvec3());
    let [normal, _] = triangle.normals();
    let (height, pace) = (normal.dot(line.origin - a), normal.dot(line.along));
    if height.abs() <= line.doubt || pace.abs() < EDGE_ON {
        return Meeting::Open;
    }
    let distance = -height / pace;
    if distance < 0.0 {
        return Meeting::Never;
    }
    let (at, error) = (line.at(distance), line.error(distance, pace.abs(), 0.0));
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let inwards = normal.cross(to - from);
        if inwards.dot(at - from) < -error * inwards.length() {
            return Meeting::Never;
        }
    }
    Meeting::At(distance, if pace < 0.0 { normal } else { -normal }, error)
}
