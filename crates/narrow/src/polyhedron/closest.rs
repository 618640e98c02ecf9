//! Closest points of two placed cores, each bound by itself: what a cast evaluates again and again on its way.
//!
//! No decision and no f32: a cast needs, in f64, an axis and the separation that it shows by projection, and may ask
//! again from somewhere else. The next search starts from the axis of the last answer.

use super::distance::{Reached, Until, distance};
use super::half_space::Plane;
use super::slender::{self, Slender};
use super::solid::Solid;
use crate::precision::Precision;
use asunder_geometry::glam::DVec3;

/// Two bounds on the separation of two cores, before their rounding is subtracted, and what shows them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Closest {
    /// The separation along `normal` by projection; -inf where a gap could not be distinguished from an overlap.
    pub(crate) at_least: f64,
    /// The distance of the points.
    pub(crate) at_most: f64,
    /// Unit axis from A to B.
    pub(crate) normal: DVec3,
    /// Points of A and of B.
    pub(crate) points: [DVec3; 2],
}

/// A placed shape without its rounding.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one step")]
pub(crate) enum Placed<'a> {
    Core(Solid<'a>),
    HalfSpace(Plane),
}

/// The closest points of A and B; the search starts in the direction `towards`.
pub(crate) fn closest(a: &Placed, b: &Placed, towards: DVec3, precision: &Precision) -> Closest {
    match (a, b) {
        (Placed::Core(a), Placed::Core(b)) => of_cores(a, b, towards, precision),
        (Placed::HalfSpace(plane), Placed::Core(core)) | (Placed::Core(core), Placed::HalfSpace(plane)) => {
            let (vertex, height) = plane.lowest(core);
            let (point, foot) = (core.point(vertex), core.point(vertex) - plane.normal * height);
            let points = if plane.is_b { [point, foot] } else { [foot, point] };
            Closest { at_least: height, at_most: height.max(0.0), normal: plane.axis(), points }
        }
        (Placed::HalfSpace(a), Placed::HalfSpace(b)) => {
            // Half-spaces whose normals are not exactly opposite overlap, and were sorted out before anything moved.
            let height = a.separation_from(b, || true);
            let at_most = if height == f64::NEG_INFINITY { 0.0 } else { height.max(0.0) };
            Closest { at_least: height, at_most, normal: a.axis(), points: a.points_with(b) }
        }
    }
}

fn of_cores(a: &Solid, b: &Solid, towards: DVec3, precision: &Precision) -> Closest {
    if a.is_slender() && b.is_slender() {
        let nearest = slender::nearest(&Slender::of_solid(a), &Slender::of_solid(b), precision.projection());
        return Closest {
            at_least: nearest.at_least,
            at_most: nearest.distance,
            normal: nearest.normal,
            points: [nearest.on_a, nearest.on_b],
        };
    }
    match distance(a, b, towards, &Until::met(precision)) {
        Reached::Between(witness) => Closest {
            at_least: witness.at_least,
            at_most: witness.distance,
            normal: witness.normal,
            points: [witness.point_a, witness.point_b],
        },
        Reached::Origin(close) => Closest {
            at_least: f64::NEG_INFINITY,
            at_most: close.within,
            normal: towards,
            points: close.points,
        },
    }
}
