//! The distance of two disjoint polyhedra, between two certified bounds.
//!
//! ```text
//! v = a point of A - B
//! repeat
//!   w = the vertex of A - B furthest towards the origin from v
//!   |v| bounds the distance from above (it has witness points), v.w/|v| from below (it is a projection)
//!   stop where they meet
//!   v = the nearest point to the origin of the simplex of v's corners and w; keep the corners it needs
//!   where w brings nothing new, look square to the simplex instead of from v; stop where that brings nothing either
//! ```
//! Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex objects in
//! three-dimensional space" (1988). Whatever rounding does to the iteration, both bounds hold for what is returned:
//! a stall widens the reported error, and nothing else. Cost: a few steps, each linear in the vertices.

use super::simplex::{Nearest, nearest_to_origin};
use super::solid::Solid;
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Steps after which the iteration gives up narrowing. Sets of random hulls need 4 to 12.
const MAX_STEPS: usize = 64;

/// Share of the size above which the axis from one witness point to the other is not rounding.
pub(crate) const TELLING: f64 = 1e-6;

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
    pub(crate) corners: ArrayVec<[usize; 2], 4>,
    /// Whether they hold the origin for certain: the shapes share a point.
    pub(crate) is_proved: bool,
    /// No further apart than this, in metres: as far as the last points were.
    pub(crate) within: f64,
    /// Those points, on A and on B.
    pub(crate) points: [DVec3; 2],
}

/// Witness points and the bounds they leave.
#[derive(Clone, Debug)]
pub(crate) struct Witness {
    /// Distance of the witness points: an upper bound.
    pub(crate) distance: f64,
    /// The best separation by projection that was met: a lower bound.
    pub(crate) at_least: f64,
    /// The unit axis of that projection, from A to B.
    pub(crate) normal: DVec3,
    /// The unit axis from one witness point to the other; that of the projection where they are too close to tell.
    pub(crate) across: DVec3,
    pub(crate) point_a: DVec3,
    pub(crate) point_b: DVec3,
    /// Vertices of A and of B that carry the witness points, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 4>,
}

impl Witness {
    /// Whether the points are so close for a pair of this size that the axis from one to the other is rounding.
    pub(crate) fn is_close(&self, size: f64) -> bool {
        self.distance <= TELLING * size
    }
}

/// A vertex of A and one of B, and the place of their difference.
type Vertex = ([usize; 2], DVec3);

/// What a corner more made of a simplex.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one step")]
enum Grown {
    /// Its nearest point came nearer.
    Nearer,
    /// Nothing new.
    Not,
    /// The four corners hold the origin.
    Around([Vertex; 4]),
}

/// Corners of the difference A - B that carry its nearest point to the origin so far.
struct Simplex {
    corners: ArrayVec<Vertex, 4>,
    /// The corners' shares of the nearest point.
    weights: [f64; 4],
    nearest: DVec3,
}

/// Narrows the distance down.
pub(crate) fn distance(a: &Solid, b: &Solid, towards_b: DVec3, until: &Until) -> Reached {
    let precision = until.precision;
    let size = precision.size;
    // The furthest vertex of the difference, and the separation that the direction shows.
    let corner = |direction: DVec3| {
        let (in_a, in_b) = (a.support(direction).vertex, b.support(-direction).vertex);
        let place = a.point(in_a) - b.point(in_b);
        (([in_a, in_b], place), -direction.dot(place))
    };
    let (first, bound) = corner(towards_b);
    let mut simplex = Simplex::of(first);
    let (mut at_least, mut normal) = (bound, towards_b);
    'steps: for _ in 0..MAX_STEPS {
        let length = simplex.nearest.length();
        if length <= f64::EPSILON * size {
            let (corners, points) = (simplex.vertices(), simplex.points(a, b));
            return Reached::Origin(Close { corners, is_proved: false, within: length, points });
        }
        let straight = simplex.nearest / -length;
        for direction in [Some(straight), None] {
            let direction = direction.unwrap_or_else(|| simplex.square_to_origin(straight));
            let (found, bound) = corner(direction);
            if bound > at_least {
                (at_least, normal) = (bound, direction);
            }
            if length - at_least <= DISTANCE_GAP * size || at_least > until.beyond || length < until.within {
                break 'steps;
            }
            if simplex.corners.iter().all(|&(known, _)| known != found.0) && !simplex.corners.is_full() {
                match simplex.grow(found, length) {
                    Grown::Nearer => continue 'steps,
                    Grown::Not => {}
                    Grown::Around(around) => {
                        let is_proved = is_around_origin(around.map(|corner| corner.1), precision);
                        if !is_proved {
                            simplex.go_to_nearest_face(&around);
                        }
                        let (corners, within) =
                            (around.map(|corner| corner.0).into(), simplex.nearest.length());
                        let points = simplex.points(a, b);
                        return Reached::Origin(Close { corners, is_proved, within, points });
                    }
                }
            }
        }
        break;
    }
    let [point_a, point_b] = simplex.points(a, b);
    let corners = simplex.vertices();
    let distance = (point_b - point_a).length();
    let mut witness = Witness { distance, at_least, normal, across: normal, point_a, point_b, corners };
    if !witness.is_close(size) {
        witness.across = (point_b - point_a) / distance;
    }
    Reached::Between(witness)
}

/// Whether four corners hold the origin for certain.
///
/// They do where the origin lies on the same side of all four faces: the four volumes that it spans with them have one
/// sign. A corner is off by at most `projection` in each coordinate, so that a volume of corners no longer than m
/// is off by less than 6 m^2 of that, and by less than 16 roundings of m^3.
pub(super) fn is_around_origin([a, b, c, d]: [DVec3; 4], precision: &Precision) -> bool {
    let longest = [a, b, c, d].iter().map(|corner| corner.abs().element_sum()).fold(0.0, f64::max);
    let doubt = longest * longest * (6.0 * precision.projection() + 8.0 * f64::EPSILON * longest);
    let volume = |p: DVec3, q: DVec3, r: DVec3| p.cross(q).dot(r);
    let volumes = [volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)];
    volumes.iter().all(|&volume| volume > doubt) || volumes.iter().all(|&volume| volume < -doubt)
}

fn places_of(corners: &[Vertex]) -> ArrayVec<DVec3, 4> {
    corners.iter().map(|&(_, place)| place).collect()
}

impl Simplex {
    fn of(corner: Vertex) -> Self {
        Self { corners: core::iter::once(corner).collect(), weights: [1.0, 0.0, 0.0, 0.0], nearest: corner.1 }
    }

    fn vertices(&self) -> ArrayVec<[usize; 2], 4> {
        self.corners.iter().map(|&(corner, _)| corner).collect()
    }

    /// Takes one corner more and leaves out those that then do not carry the nearest point, if that is nearer than
    /// `length`.
    fn grow(&mut self, corner: Vertex, length: f64) -> Grown {
        let _ = self.corners.try_push(corner);
        match nearest_to_origin(&places_of(&self.corners)) {
            Some(nearest) if nearest.point.length_squared() < length * length => {
                self.keep(&nearest);
                Grown::Nearer
            }
            Some(_) => {
                self.corners.pop();
                Grown::Not
            }
            None => {
                // Only four corners hold anything.
                let around = core::array::from_fn(|i| self.corners[i.min(self.corners.len() - 1)]);
                self.corners.pop();
                Grown::Around(around)
            }
        }
    }

    /// Leaves out the corners that do not carry the nearest point.
    fn keep(&mut self, nearest: &Nearest) {
        self.nearest = nearest.point;
        // Where they stay: moved as a whole, they cost as much as the search for the nearest point.
        let mut kept = 0;
        for i in 0..self.corners.len() {
            if nearest.corners >> i & 1 == 1 {
                self.corners[kept] = self.corners[i];
                self.weights[kept] = nearest.weights[i];
                kept += 1;
            }
        }
        self.corners.truncate(kept);
    }

    /// Goes on to the nearest point of the faces of four corners, which hold the origin but for rounding: so much closer than
    /// the last point was, that what is not proved is told by it.
    fn go_to_nearest_face(&mut self, around: &[Vertex; 4]) {
        for left_out in 0..4 {
            let corners: ArrayVec<Vertex, 4> = (0..4).filter(|&i| i != left_out).map(|i| around[i]).collect();
            if let Some(nearest) = nearest_to_origin(&places_of(&corners))
                && nearest.point.length_squared() < self.nearest.length_squared()
            {
                self.corners = corners;
                self.keep(&nearest);
            }
        }
    }

    /// The unit direction to the origin that is square to the simplex: where the origin is all but on it, the
    /// straight one is rounding, and this one tells.
    fn square_to_origin(&self, straight: DVec3) -> DVec3 {
        let square = match *self.corners.as_slice() {
            [(_, a), (_, b), (_, c)] => (b - a).cross(c - a),
            [(_, a), (_, b)] => straight - (b - a) * (straight.dot(b - a) / (b - a).length_squared()),
            _ => straight,
        };
        let square = square.try_normalize().unwrap_or(straight);
        if square.dot(straight) < 0.0 { -square } else { square }
    }

    /// The points of A and B that the weights make.
    fn points(&self, a: &Solid, b: &Solid) -> [DVec3; 2] {
        [self.weighted(a, 0), self.weighted(b, 1)]
    }

    /// The point of A or B that the weights make. Of differences from the first corner, and not of the corners: what
    /// the weights' sum lost to rounding shrinks with them.
    fn weighted(&self, solid: &Solid, which: usize) -> DVec3 {
        let first = solid.point(self.corners[0].0[which]);
        let mut sum = first;
        for (i, (corner, _)) in self.corners.iter().enumerate() {
            sum += (solid.point(corner[which]) - first) * self.weights[i];
        }
        sum
    }
}
