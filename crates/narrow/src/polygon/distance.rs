//! The distance of two disjoint polygons, between two certified bounds.
//!
//! As in space (see `polyhedron/distance.rs`, Gilbert, Johnson and Keerthi 1988), with simplices of at most three
//! corners.

use super::outline::Outline;
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Steps after which the iteration gives up narrowing. A large polygon needs about as many as its vertex count has
/// bits.
const MAX_STEPS: usize = 64;

/// Share of the size above which the axis from one witness point to the other is not rounding.
const TELLING: f64 = 1e-6;

/// How far the iteration came.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one pair")]
pub(crate) enum Reached {
    /// Two bounds on a distance, however far apart.
    Between(Witness),
    /// The difference of the shapes is too close to the origin to tell, or holds it.
    Origin(Close),
}

/// When the iteration may stop, besides when its bounds meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until<'a> {
    /// The lower bound has come above this, in metres.
    pub(crate) beyond: f64,
    /// The upper bound has come below this, in metres.
    pub(crate) within: f64,
    /// That of the pair.
    pub(crate) precision: &'a Precision,
}

impl<'a> Until<'a> {
    /// Only when they meet.
    pub(crate) fn met(precision: &'a Precision) -> Self {
        Self { beyond: f64::INFINITY, within: f64::NEG_INFINITY, precision }
    }
}

/// Corners of the difference that are at the origin as far as f64 can tell.
#[derive(Clone, Debug)]
pub(crate) struct Close {
    /// Vertices of A and of B, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 3>,
    /// Whether they hold the origin for certain: the shapes share a point.
    pub(crate) is_proved: bool,
    /// No further apart than this, in metres: as far as the last points were.
    pub(crate) within: f64,
}

/// Witness points and the bounds they leave.
#[derive(Clone, Debug)]
pub(crate) struct Witness {
    /// Distance of the witness points: an upper bound.
    pub(crate) distance: f64,
    /// The best separation by projection that was met: a lower bound.
    pub(crate) at_least: f64,
    /// The unit axis of that projection, from A to B.
    pub(crate) normal: DVec2,
    /// The unit axis from one witness point to the other; that of the projection where they are too close to tell.
    pub(crate) across: DVec2,
    pub(crate) point_a: DVec2,
    pub(crate) point_b: DVec2,
    /// Vertices of A and of B that carry the witness points, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 3>,
}

impl Witness {
    /// Whether the points are so close for a pair of this size that the axis from one to the other is rounding.
    pub(crate) fn is_close(&self, size: f64) -> bool {
        self.distance <= TELLING * size
    }
}

/// Corners of the difference A - B in use: their vertices, their places, their shares of the nearest point.
type Simplex = ArrayVec<([usize; 2], DVec2, f64), 3>;

/// Narrows the distance down.
pub(crate) fn distance(a: &Outline, b: &Outline, towards_b: DVec2, until: &Until) -> Reached {
    let precision = until.precision;
    let size = precision.size;
    // Steps grow ever shorter: the last corner, or one beside it, most often is the next.
    let corner = |direction: DVec2, near: Option<[usize; 2]>| {
        let in_a = a.support_near(direction, near.map(|near| near[0])).vertex;
        let in_b = b.support_near(-direction, near.map(|near| near[1])).vertex;
        ([in_a, in_b], a.point(in_a) - b.point(in_b), 1.0)
    };
    let mut simplex = Simplex::new();
    simplex.push(corner(towards_b, None));
    let mut last = simplex[0].0;
    let mut v = simplex[0].1;
    let (mut at_least, mut normal) = (f64::NEG_INFINITY, towards_b);
    'steps: for _ in 0..MAX_STEPS {
        let length = v.length();
        if length <= f64::EPSILON * size {
            return Reached::Origin(Close { corners: vertices(&simplex), is_proved: false, within: length });
        }
        for direction in to_origin(&simplex, v) {
            let found = corner(direction, Some(last));
            last = found.0;
            let bound = -direction.dot(found.1);
            if bound > at_least {
                (at_least, normal) = (bound, direction);
            }
            if length - at_least <= DISTANCE_GAP * size || at_least > until.beyond || length < until.within {
                break 'steps;
            }
            if simplex.iter().all(|known| known.0 != found.0) && !simplex.is_full() {
                let mut wider = simplex.clone();
                wider.push(found);
                let Some((nearest, place)) = nearest_to_origin(&wider) else {
                    let is_proved = is_around_origin(&wider, precision);
                    // Its border is as near as any point may be that it really holds.
                    let border = nearest_on_border(&wider).map_or(length, |(_, place)| place.length());
                    let within = length.min(border);
                    return Reached::Origin(Close { corners: vertices(&wider), is_proved, within });
                };
                if place.length() < length {
                    (simplex, v) = (nearest, place);
                    continue 'steps;
                }
            }
        }
        break;
    }
    // Weighted differences from the first corner, and not weighted corners: what the weights' sum lost shrinks with
    // them.
    let weighted = |outline: &Outline, which: usize| {
        let first = outline.point(simplex[0].0[which]);
        let offsets =
            simplex.iter().map(|(vertices, _, weight)| (outline.point(vertices[which]) - first) * *weight);
        first + offsets.sum::<DVec2>()
    };
    let (point_a, point_b) = (weighted(a, 0), weighted(b, 1));
    let corners = vertices(&simplex);
    let distance = (point_b - point_a).length();
    let mut witness = Witness { distance, at_least, normal, across: normal, point_a, point_b, corners };
    if !witness.is_close(size) {
        witness.across = (point_b - point_a) / distance;
    }
    Reached::Between(witness)
}

fn vertices(simplex: &Simplex) -> ArrayVec<[usize; 2], 3> {
    simplex.iter().map(|&(vertices, ..)| vertices).collect()
}

/// Whether three corners hold the origin for certain: the areas that it spans with each side have one sign.
///
/// A corner is off by at most `projection` in each coordinate, so that an area of corners no longer than m is off by
/// less than 4 m of that, and by less than 4 roundings of m^2.
fn is_around_origin(simplex: &Simplex, precision: &Precision) -> bool {
    let [a, b, c] = simplex.as_slice() else { return false };
    let longest = simplex.iter().map(|corner| corner.1.abs().element_sum()).fold(0.0, f64::max);
    let doubt = longest * (4.0 * precision.projection() + 2.0 * f64::EPSILON * longest);
    let areas = [a.1.perp_dot(b.1), b.1.perp_dot(c.1), c.1.perp_dot(a.1)];
    areas.iter().all(|&area| area > doubt) || areas.iter().all(|&area| area < -doubt)
}

/// Unit directions from the nearest point to the origin: straight, and square to the simplex, as in space.
fn to_origin(simplex: &Simplex, nearest: DVec2) -> [DVec2; 2] {
    let straight = -nearest.normalize();
    let square = match *simplex.as_slice() {
        [(_, a, _), (_, b, _)] => (b - a).perp().try_normalize().unwrap_or(straight),
        _ => straight,
    };
    [straight, if square.dot(straight) < 0.0 { -square } else { square }]
}

/// The corners that carry the nearest point, and that point; nothing where a triangle holds the origin.
fn nearest_to_origin(simplex: &Simplex) -> Option<(Simplex, DVec2)> {
    if let [a, b, c] = simplex.as_slice() {
        let sides = [a.1.perp_dot(b.1), b.1.perp_dot(c.1), c.1.perp_dot(a.1)];
        if sides.iter().all(|&side| side > 0.0) || sides.iter().all(|&side| side < 0.0) {
            return None;
        }
    }
    nearest_on_border(simplex)
}

/// The same of the corners and the sides between them.
fn nearest_on_border(simplex: &Simplex) -> Option<(Simplex, DVec2)> {
    let mut best: Option<(Simplex, DVec2)> = None;
    let mut offer = |corners: Simplex| {
        let first = corners[0].1;
        let place = first + corners.iter().map(|&(_, point, weight)| (point - first) * weight).sum::<DVec2>();
        if best.as_ref().is_none_or(|(_, known)| place.length_squared() < known.length_squared()) {
            best = Some((corners, place));
        }
    };
    for (i, &(vertices, point, _)) in simplex.iter().enumerate() {
        offer(core::iter::once((vertices, point, 1.0)).collect());
        for &(other_vertices, other, _) in &simplex[i + 1..] {
            let along = other - point;
            let t = -point.dot(along) / along.length_squared();
            if t > 0.0 && t < 1.0 {
                offer([(vertices, point, 1.0 - t), (other_vertices, other, t)].into_iter().collect());
            }
        }
    }
    best
}
