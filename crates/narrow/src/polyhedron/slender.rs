//! Points and segments among themselves: what spheres and capsules are without their radius.
//!
//! ```text
//! the closest points of two segments: by their two equations, clamped, if a projection on the axis between proves it
//! else the feet of the common perpendicular, if both lie within, or the nearest of the four ends to the other segment
//! ```
//! A point is a segment of no length. Closed form in place of an iteration, and no face to test: such shapes have no
//! inside, so that their separation is never below zero.

use super::manifold::{Point, Touch};
use super::rods::{Rod, shared_stretch};
use super::solid::Solid;
use crate::feature::{Feature, FeatureId};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Basis3, Shape3};

/// A point or a segment, in the frame of the pair, and how far the shape reaches beyond it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slender {
    /// Both the same for a point.
    pub(crate) ends: [DVec3; 2],
    pub(super) is_point: bool,
    pub(crate) radius: f64,
}

impl Slender {
    /// From a shape with these axes and this origin, if it is one: to build a [`Solid`] of it takes as long as to find
    /// the closest points.
    #[inline]
    pub(crate) fn of(shape: &Shape3, (basis, origin): (&Basis3, DVec3)) -> Option<Self> {
        let [from, to] = match shape {
            Shape3::Sphere(ball) => {
                return Some(Self { ends: [origin; 2], is_point: true, radius: ball.radius().into() });
            }
            Shape3::Capsule(capsule) => capsule.segment().ends(),
            Shape3::Segment(segment) => segment.ends(),
            Shape3::Hull(hull) => match *hull.vertices() {
                [only] => [only; 2],
                [from, to] => [from, to],
                _ => return None,
            },
            _ => return None,
        };
        let ends = [origin + basis.turn(from.as_dvec3()), origin + basis.turn(to.as_dvec3())];
        Some(Self { ends, is_point: from == to, radius: shape.radius().into() })
    }

    /// From a core that has neither faces nor more than two vertices.
    pub(crate) fn of_solid(core: &Solid) -> Self {
        let last = core.vertices.len() - 1;
        Self { ends: [core.point(0), core.point(last)], is_point: last == 0, radius: core.radius }
    }

    #[inline]
    pub(crate) fn along(&self) -> DVec3 {
        self.ends[1] - self.ends[0]
    }

    /// The point at a place on it, from 0 at its first end to 1 at its last.
    #[inline]
    pub(crate) fn at(&self, place: f64) -> DVec3 {
        self.ends[0] + self.along() * place
    }

    /// The place on it that is nearest to a point.
    #[inline]
    pub(crate) fn place_of(&self, point: DVec3) -> f64 {
        place_on(self.ends[0], self.along(), point)
    }

    pub(crate) fn feature_at(&self, place: f64) -> Feature {
        match place {
            _ if self.is_point || place <= 0.0 => Feature::Vertex(0),
            _ if place >= 1.0 => Feature::Vertex(1),
            _ => Feature::Edge(0),
        }
    }
}

/// The closest points of two slender cores, in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Their distance.
    pub(crate) distance: f64,
    /// The separation along `normal` by projection: a lower bound.
    pub(crate) at_least: f64,
    /// Unit axis from A to B.
    pub(crate) normal: DVec3,
    pub(crate) on_a: DVec3,
    pub(crate) on_b: DVec3,
    /// Where on each core: 0 to 1 from its first vertex to its last.
    places: [f64; 2],
}

/// The closest points. Where they are closer than `rounding`, the vector from one to the other gives no axis.
#[inline]
pub(crate) fn nearest(a: &Slender, b: &Slender, rounding: f64) -> Nearest {
    nearest_at_once(a, b, rounding).unwrap_or_else(|| nearest_of_all(a, b, rounding))
}

/// The closest points of two segments by one solution of their equations, clamped (Ericson, "Real-Time Collision
/// Detection", 2005, 5.1.9).
///
/// `None` for points, for segments that are nearly parallel, and where a projection does not prove the answer to a
/// sixteenth of the rounding. Most pairs of capsules need neither the four ends nor another axis: without this function
/// their distance takes 208 ns in place of 165, and their manifold 265 in place of 227 (Intel Xeon, Ice Lake, 2 virtual
/// cores, 2026-11-27).
#[inline]
fn nearest_at_once(a: &Slender, b: &Slender, rounding: f64) -> Option<Nearest> {
    if a.is_point || b.is_point {
        return None;
    }
    let ([a0, a1], [b0, b1]) = (a.ends, b.ends);
    let (along_a, along_b, between) = (a.along(), b.along(), b0 - a0);
    let (aa, bb, ab) = (along_a.length_squared(), along_b.length_squared(), along_a.dot(along_b));
    let (on_a, on_b) = (along_a.dot(between), along_b.dot(between));
    let determinant = aa * bb - ab * ab;
    // NaN passes here, and is not proved below.
    if determinant <= 1e-4 * aa * bb {
        return None;
    }
    let mut s = ((on_a * bb - on_b * ab) / determinant).clamp(0.0, 1.0);
    let t = (ab * s - on_b) / bb;
    let clamped = t.clamp(0.0, 1.0);
    if clamped != t {
        s = ((ab * clamped + on_a) / aa).clamp(0.0, 1.0);
    }
    let (on_a, on_b) = (a0 + along_a * s, b0 + along_b * clamped);
    let distance = (on_b - on_a).length();
    if distance <= rounding {
        return None;
    }
    let normal = (on_b - on_a) / distance;
    let at_least = normal.dot(b0).min(normal.dot(b1)) - normal.dot(a0).max(normal.dot(a1));
    let is_proved = distance - at_least <= rounding / 16.0;
    is_proved.then_some(Nearest { distance, at_least, normal, on_a, on_b, places: [s, clamped] })
}

/// The closest points by comparing all candidates.
#[inline(never)]
fn nearest_of_all(a: &Slender, b: &Slender, rounding: f64) -> Nearest {
    let ([a0, a1], [b0, b1]) = (a.ends, b.ends);
    let (along_a, along_b) = (a.along(), b.along());
    let mut best = (f64::INFINITY, [0.0, 0.0]);
    let mut offer = |s: f64, t: f64| {
        let squared = (b0 + along_b * t - a0 - along_a * s).length_squared();
        if squared < best.0 {
            best = (squared, [s, t]);
        }
    };
    if a.is_point {
        offer(0.0, place_on(b0, along_b, a0));
    } else if b.is_point {
        offer(place_on(a0, along_a, b0), 0.0);
    } else {
        offer(place_on(a0, along_a, b0), 0.0);
        offer(place_on(a0, along_a, b1), 1.0);
        offer(0.0, place_on(b0, along_b, a0));
        offer(1.0, place_on(b0, along_b, a1));
        let cross = along_a.cross(along_b);
        let inverse = 1.0 / cross.length_squared();
        let (s, t) =
            ((b0 - a0).cross(along_b).dot(cross) * inverse, (b0 - a0).cross(along_a).dot(cross) * inverse);
        // Parallel lines give infinities and NaN here; an end is among their closest points.
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t) {
            offer(s, t);
        }
    }
    let places = best.1;
    let (on_a, on_b) = (a0 + along_a * places[0], b0 + along_b * places[1]);
    let distance = (on_b - on_a).length();
    let bound = |normal: DVec3| normal.dot(b0).min(normal.dot(b1)) - normal.dot(a0).max(normal.dot(a1));
    if distance <= rounding {
        let normal = across(along_a, along_b, (b0 + b1) - (a0 + a1));
        return Nearest { distance, at_least: bound(normal), normal, on_a, on_b, places };
    }
    let straight = (on_b - on_a) / distance;
    let clean = square_to(on_b - on_a, [along_a, along_b], places).unwrap_or(straight);
    let better = |best: (DVec3, f64), next: (DVec3, f64)| if next.1 > best.1 { next } else { best };
    let shown = |normal: DVec3| (normal, bound(normal));
    let (mut normal, mut at_least) = better(shown(straight), shown(clean));
    if distance - at_least > rounding {
        // Long segments that all but touch: the vector from one point to the other is mostly rounding.
        (normal, at_least) = better((normal, at_least), shown(across(along_a, along_b, on_b - on_a)));
    }
    Nearest { distance, at_least, normal, on_a, on_b, places }
}

/// The unit axis between closest points, made perpendicular to each segment that has its point in its interior.
///
/// Between points that all but coincide, the vector from one to the other is mostly rounding; being perpendicular to
/// the segments restores the axis.
fn square_to(between: DVec3, along: [DVec3; 2], places: [f64; 2]) -> Option<DVec3> {
    let is_inside = places.map(|place| place > 0.0 && place < 1.0);
    let cross = along[0].cross(along[1]);
    let axis = match is_inside {
        [true, true] if cross.length_squared() > 0.0 => cross * cross.dot(between).signum(),
        [true, _] => between - along[0] * (between.dot(along[0]) / along[0].length_squared()),
        [false, true] => between - along[1] * (between.dot(along[1]) / along[1].length_squared()),
        [false, false] => between,
    };
    axis.try_normalize()
}

/// The contact points: where the two are closest, or both ends of the stretch along which two segments lie side by
/// side.
///
/// Points are at most `within` apart. The stretch is taken only if one end of it is as close as the closest points, up
/// to `preference`: segments that cross at a small angle touch in one point.
pub(crate) fn touch([a, b]: [&Slender; 2], nearest: &Nearest, within: f64, preference: f64) -> Touch {
    let normal = nearest.normal;
    let least = nearest.distance - a.radius - b.radius + preference;
    let within = within.max(least);
    let mut points: ArrayVec<Point, 4> = ArrayVec::new();
    if let (Some(rod_a), Some(rod_b)) = (Rod::of_slender(a), Rod::of_slender(b)) {
        let stretch = shared_stretch(&rod_a, &rod_b, normal, nearest.distance, preference);
        points.extend(stretch.into_iter().filter(|point| point.separation <= within));
    }
    if !points.iter().any(|point| point.separation <= least) {
        points.clear();
        let feature = FeatureId::new(a.feature_at(nearest.places[0]), b.feature_at(nearest.places[1]));
        let (on_a, on_b) = (nearest.on_a, nearest.on_b);
        let point = Point { separation: nearest.distance, on_a, on_b, feature };
        points.push(point.on_surfaces([a.radius, b.radius], normal));
    }
    points.sort_unstable_by_key(|point| point.feature);
    Touch { normal, points, of: None }
}

/// The place of a point's projection on a segment, clamped to 0 to 1; 0 on a segment of no length.
fn place_on(from: DVec3, along: DVec3, point: DVec3) -> f64 {
    let place = (point - from).dot(along) / along.length_squared();
    if place.is_nan() { 0.0 } else { place.clamp(0.0, 1.0) }
}

/// A unit axis perpendicular to both directions, as far as there is one, on the side of `between` where that leaves a
/// choice.
pub(crate) fn across(along_a: DVec3, along_b: DVec3, between: DVec3) -> DVec3 {
    let cross = along_a.cross(along_b);
    let longer = if along_a.length_squared() >= along_b.length_squared() { along_a } else { along_b };
    let square = |v: DVec3| v.length_squared();
    // Not parallel: only their common perpendicular will do.
    let axis = if square(cross) > 1e-16 * square(along_a) * square(along_b) && square(cross) > 0.0 {
        cross
    } else {
        // Anything perpendicular to the longer one will do: made with the coordinate axis that is furthest from its
        // direction.
        let size = longer.abs();
        let other = if size.x <= size.y && size.x <= size.z {
            DVec3::X
        } else if size.y <= size.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        if square(longer) > 0.0 { longer.cross(other) } else { DVec3::Y }
    };
    let axis = axis.normalize();
    if axis.dot(between) < 0.0 { -axis } else { axis }
}
