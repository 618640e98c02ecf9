//! Two sets of vertices in one exact frame, and the iteration that decides whether their hulls meet.

use super::Corner;
use super::int::{Int, cross3, direction, dot3, sum_of_products};
use super::nearest::{Carried, Simplex};
use asunder_geometry::glam::{DVec3, Vec2, Vec3};
use core::cmp::Ordering;

/// The stored vertices of a core; in the plane, with a third coordinate of zero.
#[derive(Clone, Copy, Debug)]
pub(super) enum Vertices<'a> {
    Plane(&'a [Vec2]),
    Space(&'a [Vec3]),
}

/// The rotation from a shape's own axes to the common frame, times the frame's weight.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one question")]
#[derive(Clone)]
pub(super) enum Turn {
    /// The shape's axes are the frame's.
    Weight(Int),
    /// Rows of a matrix.
    Matrix([[Int; 3]; 3]),
}

/// One shape in the frame.
#[allow(clippy::large_enum_variant, reason = "as Turn")]
pub(super) enum Body<'a> {
    Core(Vertices<'a>, Turn),
    /// Everything below a plane through the body's position: its outward normal in the frame, of any length.
    HalfSpace([Int; 3]),
}

/// Two shapes in one frame, every length in it an integer: a multiple of one power of two, times `weight`.
pub(super) struct Question<'a> {
    pub(super) a: Body<'a>,
    pub(super) b: Body<'a>,
    /// B's origin less A's.
    pub(super) offset: [Int; 3],
    /// Both radii together.
    pub(super) radii: Int,
    /// The exponent of the power of two that vertices are multiples of.
    pub(super) unit: i32,
}

impl Vertices<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Plane(points) => points.len(),
            Self::Space(points) => points.len(),
        }
    }

    fn at(&self, vertex: usize) -> Vec3 {
        match self {
            Self::Plane(points) => points[vertex].extend(0.0),
            Self::Space(points) => points[vertex],
        }
    }

    /// All coordinates, for the choice of a unit.
    pub(super) fn coordinates(&self) -> impl Iterator<Item = f32> {
        (0..self.len()).flat_map(|vertex| self.at(vertex).to_array())
    }

    /// A vertex in whole units.
    fn exact(&self, vertex: usize, unit: i32) -> [Int; 3] {
        self.at(vertex).to_array().map(|value| in_units(f64::from(value), unit))
    }
}

impl Turn {
    pub(super) fn turn(&self, v: &[Int; 3]) -> [Int; 3] {
        match self {
            Self::Weight(weight) => [&v[0] * weight, &v[1] * weight, &v[2] * weight],
            Self::Matrix(rows) => [dot3(&rows[0], v), dot3(&rows[1], v), dot3(&rows[2], v)],
        }
    }

    /// A direction of the frame in the shape's own axes; its length has no meaning.
    fn turn_back(&self, v: &[Int; 3]) -> [Int; 3] {
        match self {
            Self::Weight(_) => v.clone(),
            Self::Matrix(rows) => {
                let column = |i: usize| {
                    sum_of_products([[&rows[0][i], &v[0]], [&rows[1][i], &v[1]], [&rows[2][i], &v[2]]], false)
                };
                [column(0), column(1), column(2)]
            }
        }
    }
}

/// A finite value as a multiple of a power of two that divides it.
pub(super) fn in_units(value: f64, unit: i32) -> Int {
    let (mantissa, exponent) = super::int::parts(value);
    match exponent - unit {
        _ if mantissa == 0 => Int::ZERO,
        // A mantissa has 53 bits.
        shift @ 0..=64 => Int::from(i128::from(mantissa) << shift),
        shift => Int::from_scaled(mantissa, shift as u32),
    }
}

/// The greatest power of two that divides every value; 1 if all are zero.
pub(super) fn common_unit(values: impl Iterator<Item = f64>) -> i32 {
    let exponents = values.map(super::int::parts).filter(|parts| parts.0 != 0).map(|parts| parts.1);
    exponents.min().unwrap_or(0)
}

impl Question<'_> {
    /// Whether the shapes share a point.
    pub(super) fn answer(&self, start: &[Corner]) -> bool {
        match (&self.a, &self.b) {
            // Two half-spaces overlap, unless their normals are exactly opposite, across a gap.
            (Body::HalfSpace(normal), Body::HalfSpace(_)) => {
                !(self.are_opposed() && dot3(normal, &self.offset).sign() == Ordering::Greater)
            }
            // The least projection of B along A's normal, measured from A's plane; and the other way round.
            (Body::HalfSpace(normal), Body::Core(..)) => !self.is_beyond(&self.least(normal).1, normal),
            (Body::Core(..), Body::HalfSpace(normal)) => {
                let back = normal.clone().map(|c| -c);
                !self.is_beyond(&self.least(&back).1, &back)
            }
            (Body::Core(..), Body::Core(..)) => self.cores_meet(start),
        }
    }

    /// Whether both are half-spaces with exactly opposite normals.
    pub(super) fn are_opposed(&self) -> bool {
        let (Body::HalfSpace(normal_a), Body::HalfSpace(normal_b)) = (&self.a, &self.b) else { return false };
        cross3(normal_a, normal_b).iter().all(Int::is_zero)
            && dot3(normal_a, normal_b).sign() == Ordering::Less
    }

    fn cores_meet(&self, start: &[Corner]) -> bool {
        let mut simplex = Simplex::new();
        for &corner in start.iter().take(4) {
            simplex.push(corner, self.point(corner));
        }
        if simplex.is_empty() {
            simplex.push([0, 0], self.point([0, 0]));
        }
        loop {
            let Carried::By(towards) = simplex.reduce() else { return true };
            let reach = dot3(&towards, simplex.first());
            if !self.radii.is_zero() && !self.is_beyond(&reach, &towards) {
                return true;
            }
            let (corner, least) = self.least(&towards);
            // Once v is the nearest point of all, no corner projects below v's own: then one of these two holds.
            if self.is_beyond(&least, &towards) || least >= reach {
                return false;
            }
            simplex.push(corner, self.point(corner));
        }
    }

    /// Whether a projection on a direction of any length exceeds the sum of both radii.
    fn is_beyond(&self, projection: &Int, along: &[Int; 3]) -> bool {
        if projection.sign() != Ordering::Greater {
            return false;
        }
        self.radii.is_zero() || projection.square() > &self.radii.square() * &dot3(along, along)
    }

    /// A vertex of B less one of A.
    fn point(&self, [in_a, in_b]: Corner) -> [Int; 3] {
        let place = |body: &Body, vertex: usize| match body {
            Body::Core(vertices, turn) => turn.turn(&vertices.exact(vertex, self.unit)),
            Body::HalfSpace(_) => [Int::ZERO; 3],
        };
        let (a, b) = (place(&self.a, in_a), place(&self.b, in_b));
        let axis = |i: usize| &(&b[i] + &self.offset[i]) - &a[i];
        [axis(0), axis(1), axis(2)]
    }

    /// The corner that is least along a direction, and its projection there.
    fn least(&self, along: &[Int; 3]) -> (Corner, Int) {
        let back = along.clone().map(|c| -c);
        let (in_a, most_a) = self.furthest(&self.a, along);
        let (in_b, most_b) = self.furthest(&self.b, &back);
        let mut least = dot3(along, &self.offset);
        least -= &most_a;
        least -= &most_b;
        ([in_a, in_b], least)
    }

    /// The vertex furthest along a direction and its projection there, without the body's position.
    ///
    /// f64 selects the candidates. Each component of the local direction is off by at most 2^-52 of itself, and a
    /// projection takes five roundings more, so it is off by less than 8 units of 2^-53 of the sum of its terms'
    /// magnitudes; vertices within twice that of the furthest are compared exactly.
    fn furthest(&self, body: &Body, along: &[Int; 3]) -> (usize, Int) {
        let Body::Core(vertices, turn) = body else { return (0, Int::ZERO) };
        let local = turn.turn_back(along);
        let exact = |vertex: usize| dot3(&local, &vertices.exact(vertex, self.unit));
        let about = direction(&local);
        let (mut furthest, mut doubt) = (f64::NEG_INFINITY, 0.0_f64);
        let project = |vertex: usize| {
            let terms = about * vertices.at(vertex).as_dvec3();
            (terms.element_sum(), DVec3::abs(terms).element_sum())
        };
        for vertex in 0..vertices.len() {
            let (reach, size) = project(vertex);
            (furthest, doubt) = (furthest.max(reach), doubt.max(size));
        }
        // Underflow of terms and components loses less than this.
        let doubt = 16.0 * f64::EPSILON * doubt + 1e-290;
        let candidates = (0..vertices.len()).filter(|&vertex| project(vertex).0 >= furthest - doubt);
        let best = candidates
            .map(|vertex| (vertex, exact(vertex)))
            .reduce(|best, next| if next.1 > best.1 { next } else { best });
        let (vertex, local_reach) = best.unwrap_or_else(|| (0, exact(0)));
        let reach = match turn {
            Turn::Weight(weight) => &local_reach * weight,
            Turn::Matrix(_) => local_reach,
        };
        (vertex, reach)
    }
}
