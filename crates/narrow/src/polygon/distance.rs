//! The distance of two disjoint polygons, between two certified bounds.
//!
//! As in space (see `polyhedron/distance.rs`, Gilbert, Johnson and Keerthi 1988), with simplices of at most three
//! corners.

use super::outline::Outline;
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Steps after which the iteration gives up. A large polygon needs about as many as its vertex count has bits.
const MAX_STEPS: usize = 64;

/// Share of the size above which the axis between the witness points is more than rounding.
const CLEAR_GAP: f64 = 1e-6;

/// How far the iteration got.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one pair")]
pub(crate) enum Reached {
    /// Two bounds on the distance, however far apart.
    Between(Witness),
    /// The Minkowski difference contains the origin, or is too close to it to decide.
    Origin(Close),
}

/// When the iteration may stop, apart from when its bounds meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Until<'a> {
    /// The lower bound has come above this, in metres.
    pub(crate) beyond: f64,
    /// The upper bound has come below this, in metres.
    pub(crate) within: f64,
    /// The pair's precision.
    pub(crate) precision: &'a Precision,
}

impl<'a> Until<'a> {
    /// Stops only when the bounds meet.
    pub(crate) fn met(precision: &'a Precision) -> Self {
        Self { beyond: f64::INFINITY, within: f64::NEG_INFINITY, precision }
    }
}

/// Corners of the difference that are at the origin, or around it, as far as f64 can tell.
#[derive(Clone, Debug)]
pub(crate) struct Close {
    /// Vertices of A and of B, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 3>,
    /// Whether they certainly contain the origin: the shapes share a point.
    pub(crate) is_proved: bool,
    /// An upper bound on the distance, in metres: that of the last points.
    pub(crate) within: f64,
}

/// Witness points, and the bounds on the distance that they prove.
#[derive(Clone, Debug)]
pub(crate) struct Witness {
    /// Distance of the witness points: an upper bound.
    pub(crate) distance: f64,
    /// The best separation by projection that was found: a lower bound.
    pub(crate) at_least: f64,
    /// The unit axis of that projection, from A to B.
    pub(crate) normal: DVec2,
    /// The unit axis from one witness point to the other; the projection's axis if they are too close for one.
    pub(crate) across: DVec2,
    pub(crate) point_a: DVec2,
    pub(crate) point_b: DVec2,
    /// Vertices of A and of B that carry the witness points, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 3>,
}

impl Witness {
    /// Whether, for a pair of this size, the points are so close that the axis between them is mostly rounding.
    pub(crate) fn is_close(&self, size: f64) -> bool {
        self.distance <= CLEAR_GAP * size
    }
}

/// Vertices of A and of B, and the place of their difference.
type Vertex = ([usize; 2], DVec2);

/// Corners of the difference A - B that carry its point nearest to the origin so far.
#[derive(Clone, Copy)]
struct Simplex {
    vertices: [[usize; 2]; 3],
    places: [DVec2; 3],
    count: usize,
    /// The second corner's weight in the nearest point.
    share: f64,
    nearest: DVec2,
}

/// What one more corner changed.
enum Grown {
    /// The nearest point has come nearer.
    Nearer,
    /// Nothing new.
    Not,
    /// The three corners contain the origin: all are kept.
    Around,
}

/// Narrows the bounds on the distance until they meet, or `until` is satisfied.
pub(crate) fn distance(a: &Outline, b: &Outline, towards_b: DVec2, until: &Until) -> Reached {
    let precision = until.precision;
    let size = precision.size;
    // Steps get ever shorter: the next corner is most often the last one or beside it.
    let corner = |direction: DVec2, near: Option<[usize; 2]>| {
        let in_a = a.furthest_near(direction, near.map(|near| near[0]));
        let in_b = b.furthest_near(-direction, near.map(|near| near[1]));
        ([in_a, in_b], a.point(in_a) - b.point(in_b))
    };
    let mut simplex = Simplex::of(corner(towards_b, None));
    let mut last = simplex.vertices[0];
    let (mut at_least, mut normal) = (-towards_b.dot(simplex.nearest), towards_b);
    'steps: for _ in 0..MAX_STEPS {
        let length = simplex.nearest.length();
        if length <= f64::EPSILON * size {
            return Reached::Origin(Close { corners: simplex.corners(), is_proved: false, within: length });
        }
        let straight = simplex.nearest / -length;
        for direction in [Some(straight), None] {
            let direction = direction.unwrap_or_else(|| simplex.square_to_origin(straight));
            let found = corner(direction, Some(last));
            last = found.0;
            let bound = -direction.dot(found.1);
            if bound > at_least {
                (at_least, normal) = (bound, direction);
            }
            if length - at_least <= DISTANCE_GAP * size || at_least > until.beyond || length < until.within {
                break 'steps;
            }
            if simplex.knows(found.0) || simplex.count == 3 {
                continue;
            }
            match simplex.grow(found, length) {
                Grown::Nearer => continue 'steps,
                Grown::Not => {}
                Grown::Around => {
                    let (corners, is_proved) =
                        (simplex.corners(), is_around_origin(simplex.places, precision));
                    // The distance of its border bounds the gap, if it does not really contain the origin.
                    let within = length.min(simplex.border());
                    return Reached::Origin(Close { corners, is_proved, within });
                }
            }
        }
        break;
    }
    let (point_a, point_b) = (simplex.weighted(a, 0), simplex.weighted(b, 1));
    let corners = simplex.corners();
    let distance = (point_b - point_a).length();
    let mut witness = Witness { distance, at_least, normal, across: normal, point_a, point_b, corners };
    if !witness.is_close(size) {
        witness.across = (point_b - point_a) / distance;
    }
    Reached::Between(witness)
}

/// Whether three corners certainly contain the origin: the areas that it spans with each side have one sign.
///
/// A corner is off by at most `projection` in each coordinate. So the area of corners no longer than m is off by less
/// than 4 m of that, and by less than 4 roundings of m^2.
fn is_around_origin(places @ [a, b, c]: [DVec2; 3], precision: &Precision) -> bool {
    let longest = places.iter().map(|place| place.abs().element_sum()).fold(0.0, f64::max);
    let doubt = longest * (4.0 * precision.projection() + 2.0 * f64::EPSILON * longest);
    let areas = [a.perp_dot(b), b.perp_dot(c), c.perp_dot(a)];
    areas.iter().all(|&area| area > doubt) || areas.iter().all(|&area| area < -doubt)
}

/// The point nearest to the origin on the segment between two corners: how far along the segment, from 0 to 1, and the
/// point. For corners in one place, the first.
#[inline(always)]
fn nearest_between(from: DVec2, to: DVec2) -> (f64, DVec2) {
    let along = to - from;
    let (down, length) = (-from.dot(along), along.length_squared());
    match down {
        _ if down <= 0.0 || length == 0.0 => (0.0, from),
        _ if down >= length => (1.0, to),
        _ => (down / length, from + along * (down / length)),
    }
}

impl Simplex {
    fn of((vertices, place): Vertex) -> Self {
        Self { vertices: [vertices; 3], places: [place; 3], count: 1, share: 0.0, nearest: place }
    }

    fn corners(&self) -> ArrayVec<[usize; 2], 3> {
        self.vertices.iter().take(self.count).copied().collect()
    }

    #[inline(always)]
    fn knows(&self, vertices: [usize; 2]) -> bool {
        (0..3).any(|i| self.vertices[i] == vertices && i < self.count)
    }

    /// Adds a corner and drops those that no longer carry the nearest point, if that is nearer than `length`.
    ///
    /// The nearest point is on a side that ends in the new corner, or the step brought nothing.
    #[inline(always)]
    fn grow(&mut self, (vertices, place): Vertex, length: f64) -> Grown {
        let [a, b, _] = self.places;
        let from_a = nearest_between(a, place);
        let (mut kept, mut best) = (0, from_a);
        if self.count == 2 {
            let areas = [a.perp_dot(b), b.perp_dot(place), place.perp_dot(a)];
            if areas.iter().all(|&area| area > 0.0) || areas.iter().all(|&area| area < 0.0) {
                (self.vertices[2], self.places[2], self.count) = (vertices, place, 3);
                return Grown::Around;
            }
            let from_b = nearest_between(b, place);
            if from_b.1.length_squared() < from_a.1.length_squared() {
                (kept, best) = (1, from_b);
            }
        }
        let (share, nearest) = best;
        let is_nearer = nearest.length() < length;
        if !is_nearer {
            return Grown::Not;
        }
        (self.share, self.nearest) = (share, nearest);
        if share == 1.0 {
            (self.vertices[0], self.places[0], self.count) = (vertices, place, 1);
            return Grown::Nearer;
        }
        (self.vertices[0], self.places[0]) = (self.vertices[kept], self.places[kept]);
        (self.vertices[1], self.places[1]) = (vertices, place);
        self.count = if share == 0.0 { 1 } else { 2 };
        Grown::Nearer
    }

    /// The unit direction to the origin that is square to the simplex, as in space.
    fn square_to_origin(&self, straight: DVec2) -> DVec2 {
        let [a, b, _] = self.places;
        let square = if self.count == 2 { (b - a).perp().try_normalize() } else { None };
        let square = square.unwrap_or(straight);
        if square.dot(straight) < 0.0 { -square } else { square }
    }

    /// How far its sides are from the origin.
    fn border(&self) -> f64 {
        let [a, b, c] = self.places;
        [(a, b), (b, c), (c, a)]
            .map(|(from, to)| nearest_between(from, to).1.length())
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    /// The point of A or B that the weights make: the first corner plus a weighted difference, not a sum of weighted
    /// corners, so that the rounding of the weights' sum shrinks with the difference.
    #[inline(always)]
    fn weighted(&self, outline: &Outline, which: usize) -> DVec2 {
        let first = outline.point(self.vertices[0][which]);
        match self.count {
            2 => first + (outline.point(self.vertices[1][which]) - first) * self.share,
            _ => first,
        }
    }
}
