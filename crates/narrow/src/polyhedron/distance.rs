//! The distance of two disjoint polyhedra, between two certified bounds.
//!
//! ```text
//! v = a point of A - B
//! repeat
//!   w = the support point of A - B along -v
//!   |v| bounds the distance from above (it has witness points), v.w/|v| from below (it is a projection)
//!   stop where they meet
//!   v = the nearest point to the origin of the simplex of v's corners and w; keep the corners that carry it
//!   where w brings nothing new, search perpendicular to the simplex instead of along -v; stop where that fails too
//! ```
//! Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex objects in
//! three-dimensional space" (1988). Whatever rounding does to the iteration, both bounds hold for what is returned:
//! a stall widens the reported error, and nothing else. Cost: a few steps, each linear in the vertices.

use super::simplex::{Corners, Nearest, nearest_of_all, nearest_to_origin};
use crate::precision::Precision;
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::DISTANCE_GAP;

/// Steps after which the iteration gives up narrowing. Sets of random hulls need 4 to 12.
const MAX_STEPS: usize = 64;

/// Share of the pair's size above which the axis from one witness point to the other is not rounding.
pub(crate) const CLEAR_GAP: f64 = 1e-6;

/// How far the iteration came.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one pair")]
pub(crate) enum Reached {
    /// Two bounds on a distance, however far apart.
    Between(Witness),
    /// The difference of the shapes is too close to the origin to decide, or holds it.
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
    /// Stop only when the bounds meet.
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
    /// An upper bound on the distance, in metres: how far apart the last points were.
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
    /// The unit axis from one witness point to the other; `normal` where they are too close to each other.
    pub(crate) across: DVec3,
    pub(crate) point_a: DVec3,
    pub(crate) point_b: DVec3,
    /// Vertices of A and of B that carry the witness points, in pairs.
    pub(crate) corners: ArrayVec<[usize; 2], 4>,
}

impl Witness {
    /// Whether the points are so close for a pair of this size that the axis from one to the other is rounding.
    pub(crate) fn is_close(&self, size: f64) -> bool {
        self.distance <= CLEAR_GAP * size
    }
}

/// What the iteration needs of a body: its vertices, in the frame of the pair.
pub(crate) trait Polytope {
    /// The vertex furthest along a direction of unit length.
    fn furthest(&self, direction: DVec3) -> usize;
    /// Where a vertex is.
    fn point(&self, vertex: usize) -> DVec3;
}

/// A vertex of A and one of B, and their difference.
type Vertex = ([usize; 2], DVec3);

/// What adding a corner did to a simplex.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one step")]
enum Grown {
    /// Its nearest point came nearer.
    Nearer,
    /// No nearer: the corner is left out again.
    Not,
    /// The four corners hold the origin; all of them are still stored.
    Around,
}

/// Corners of the difference A - B that carry its nearest point to the origin so far.
struct Simplex {
    /// Vertices of A and of B.
    vertices: [[usize; 2]; 4],
    corners: Corners,
    /// The corners' shares of the nearest point.
    weights: [f64; 3],
    nearest: DVec3,
}

/// Brings the two bounds on the distance together, until they meet or `until` says to stop.
pub(crate) fn distance(a: &impl Polytope, b: &impl Polytope, towards_b: DVec3, until: &Until) -> Reached {
    let precision = until.precision;
    let size = precision.size;
    // The support vertex of the difference, and the separation that the direction shows.
    let corner = |direction: DVec3| {
        let (in_a, in_b) = (a.furthest(direction), b.furthest(-direction));
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
            if simplex.knows(found.0) || simplex.corners.count == 4 {
                continue;
            }
            match simplex.grow(found, length) {
                Grown::Nearer => continue 'steps,
                Grown::Not => {}
                Grown::Around => {
                    let corners = simplex.vertices.into();
                    let is_proved = is_around_origin(simplex.corners.places, precision);
                    if !is_proved {
                        simplex.go_to_nearest_face(length);
                    }
                    let (points, within) = (simplex.points(a, b), simplex.nearest.length());
                    return Reached::Origin(Close { corners, is_proved, within, points });
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
/// They do where the origin lies on the same side of all four faces: the four volumes that it spans with the faces have
/// one sign. A corner is off by at most `projection` in each coordinate, so that a volume of corners no longer than m
/// is off by less than 6 m^2 times that, and by less than 16 roundings of m^3.
pub(super) fn is_around_origin([a, b, c, d]: [DVec3; 4], precision: &Precision) -> bool {
    let longest = [a, b, c, d].iter().map(|corner| corner.abs().element_sum()).fold(0.0, f64::max);
    let doubt = longest * longest * (6.0 * precision.projection() + 8.0 * f64::EPSILON * longest);
    let volume = |p: DVec3, q: DVec3, r: DVec3| p.cross(q).dot(r);
    let volumes = [volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)];
    volumes.iter().all(|&volume| volume > doubt) || volumes.iter().all(|&volume| volume < -doubt)
}

impl Simplex {
    fn of((vertices, place): Vertex) -> Self {
        Self {
            vertices: [vertices; 4],
            corners: Corners { places: [place; 4], count: 1 },
            weights: [1.0, 0.0, 0.0],
            nearest: place,
        }
    }

    fn vertices(&self) -> ArrayVec<[usize; 2], 4> {
        self.vertices.iter().take(self.corners.count).copied().collect()
    }

    #[inline(always)]
    fn knows(&self, vertices: [usize; 2]) -> bool {
        (0..4).any(|i| self.vertices[i] == vertices && i < self.corners.count)
    }

    /// Adds a corner and drops those that then do not carry the nearest point, if that is nearer than `length`.
    #[inline(always)]
    fn grow(&mut self, (vertices, place): Vertex, length: f64) -> Grown {
        let new = self.corners.count & 3;
        (self.vertices[new], self.corners.places[new]) = (vertices, place);
        self.corners.count = new + 1;
        let Some(nearest) = nearest_to_origin(&self.corners) else { return Grown::Around };
        if nearest.point.length_squared() < length * length {
            self.keep(&nearest);
            return Grown::Nearer;
        }
        let nearest = nearest_of_all(&self.corners);
        if nearest.point.length_squared() < length * length {
            self.keep(&nearest);
            return Grown::Nearer;
        }
        self.corners.count = new;
        Grown::Not
    }

    /// Drops the corners that do not carry the nearest point.
    #[inline(always)]
    fn keep(&mut self, nearest: &Nearest) {
        (self.nearest, self.weights, self.corners.count) = (nearest.point, nearest.weights, nearest.count);
        // Of those that count, none is read after it was overwritten: picks ascend.
        for (to, &from) in nearest.picks.iter().enumerate() {
            self.vertices[to] = self.vertices[from & 3];
            self.corners.places[to] = self.corners.places[from & 3];
        }
    }

    /// Moves to the nearest point of the faces of four corners, which hold the origin up to rounding. The last point
    /// was `length` away; this one is so much closer that it is reported where the overlap is not proved.
    fn go_to_nearest_face(&mut self, length: f64) {
        let around = (self.vertices, self.corners.places);
        // Until a face is nearer, that of the first three, which the last point was on.
        self.corners.count = 3;
        let mut best = length * length;
        for left_out in 0..4 {
            let mut face =
                Self { vertices: around.0, corners: Corners { places: around.1, count: 3 }, ..*self };
            for (to, i) in (0..4).filter(|&i| i != left_out).enumerate() {
                (face.vertices[to], face.corners.places[to]) = (around.0[i], around.1[i]);
            }
            let nearest = nearest_of_all(&face.corners);
            if nearest.point.length_squared() < best {
                best = nearest.point.length_squared();
                face.keep(&nearest);
                *self = face;
            }
        }
    }

    /// The unit direction to the origin that is perpendicular to the simplex: where the origin nearly lies on the
    /// simplex, the straight direction is rounding, and this one is not.
    fn square_to_origin(&self, straight: DVec3) -> DVec3 {
        let [a, b, c, _] = self.corners.places;
        let square = match self.corners.count {
            3 => (b - a).cross(c - a),
            2 => straight - (b - a) * (straight.dot(b - a) / (b - a).length_squared()),
            _ => straight,
        };
        let square = square.try_normalize().unwrap_or(straight);
        if square.dot(straight) < 0.0 { -square } else { square }
    }

    /// The points of A and B that the weights give.
    fn points(&self, a: &impl Polytope, b: &impl Polytope) -> [DVec3; 2] {
        [self.weighted(a, 0), self.weighted(b, 1)]
    }

    /// The point of A or B that the weights give. Summed over differences from the first corner, not over corners: what
    /// the weights' sum lost to rounding is scaled down with them.
    fn weighted(&self, body: &impl Polytope, which: usize) -> DVec3 {
        let first = body.point(self.vertices[0][which]);
        let mut sum = first;
        for i in 0..self.corners.count.min(3) {
            sum += (body.point(self.vertices[i][which]) - first) * self.weights[i];
        }
        sum
    }
}
