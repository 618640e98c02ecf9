//! A convex part over ground: its vertices in the ground's axes.

use super::axes::Axes;
use super::ball::nearest_to;
use super::facet::Facet;
use crate::ground3::OnGround;
use crate::pair3::Part;
use crate::polyhedron::solid::Solid;
use crate::precision::IN_SPACE;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::tolerance::{EVEN_DEPTH, FACE_PREFERENCE, MAX_HULL_VERTICES};
use asunder_geometry::{Basis3, Core3, Pose3, Shape3};

/// The position and rotation of a part, in the ground's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) axes: Basis3,
    pub(super) origin: DVec3,
    /// The summed lengths of the vectors that make up `origin`, in metres.
    pub(super) summed: f64,
}

/// Vertices in eights: large, and filled in place.
pub(super) type Octets = ArrayVec<[[f64; 8]; 3], { MAX_HULL_VERTICES / 8 }>;

/// A part, with its vertices; a half-space has none.
pub(super) struct Standing<'s> {
    pub(super) part: Part<'s>,
    pub(super) place: Place,
    /// The core, in the ground's axes.
    pub(super) solid: &'s Solid<'s>,
    /// The box around the core in the part's own axes.
    around: [DVec3; 2],
    /// Its middle in the ground's axes, and its half extents.
    pub(super) middle: DVec3,
    half: DVec3,
    /// The box around the core in the ground's axes.
    pub(super) turned: [DVec3; 2],
    /// The vertices in eights; the last eight are padded with their first.
    octets: &'s Octets,
    pub(super) center: DVec3,
    pub(super) radius: f64,
    pub(super) outer_radius: f64,
    /// How far the faces of a hull are from planes, in metres.
    pub(super) planarity: f64,
    /// Positions that differ by no more count as the same, in metres.
    pub(super) slack: f64,
    /// Points no further than this above the deepest count as deep as it where four of more are chosen, in metres.
    pub(super) even: f64,
    /// The summed lengths that enter a coordinate, in metres.
    pub(super) lengths: f64,
}

/// How far a part reaches down and up, over a plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) low: f64,
    pub(super) lowest: usize,
    pub(super) high: f64,
    pub(super) highest: usize,
}

impl Extent {
    /// The same as seen from the other side of the plane.
    pub(super) fn turned_over(self) -> Self {
        Self { low: -self.high, lowest: self.highest, high: -self.low, highest: self.lowest }
    }
}

impl Place {
    pub(super) fn of(on: &OnGround, part: &Part, [body, ground]: [&Pose3; 2]) -> Self {
        let (axes, _) = part.placed(&on.body_basis);
        // Equal rotations cancel to the last bit.
        let axes = match part.site(body).part {
            None => body.basis_from(ground),
            Some(_) => axes.relative_to(&on.basis),
        };
        let (origin, summed) = on.origin_of(part);
        Self { axes, origin, summed }
    }

    /// From the part's own axes to the ground's.
    #[inline]
    pub(super) fn point(&self, local: DVec3) -> DVec3 {
        self.origin + self.axes.turn(local)
    }
}

impl<'s> Standing<'s> {
    pub(super) fn new(
        part: Part<'s>,
        place: Place,
        (core, solid): (&'s Core3<'s>, &'s Solid<'s>),
        octets: &'s mut Octets,
    ) -> Self {
        let axes = [place.axes.x.to_array(), place.axes.y.to_array(), place.axes.z.to_array()];
        let origin = place.origin.to_array();
        let mut own = [[[f32::INFINITY; 8]; 3], [[f32::NEG_INFINITY; 8]; 3]];
        let mut turned = [[[f64::INFINITY; 8]; 3], [[f64::NEG_INFINITY; 8]; 3]];
        for eight in core.vertex_octets() {
            let rows = [&eight.x, &eight.y, &eight.z];
            let mut octet = [[0.0; 8]; 3];
            for axis in 0..3 {
                for i in 0..8 {
                    // As `Place::point`.
                    let sum = axes[0][axis] * f64::from(rows[0][i])
                        + axes[1][axis] * f64::from(rows[1][i])
                        + axes[2][axis] * f64::from(rows[2][i]);
                    octet[axis][i] = origin[axis] + sum;
                }
                widen(&mut own, axis, rows[axis]);
                widen(&mut turned, axis, &octet[axis]);
            }
            let _ = octets.try_push(octet);
        }
        let (own, turned) = (corners_of(&own), corners_of(&turned));
        let around = [Vec3::from_array(own[0]).as_dvec3(), Vec3::from_array(own[1]).as_dvec3()];
        let center = part.shape.center().as_dvec3();
        // A half-space has none, and no vertices for which it would matter.
        let outer_radius = match solid.vertices.len() {
            0 => 0.0,
            _ => f64::from(part.shape.outer_radius()),
        };
        let lengths = place.summed + center.abs().element_sum() + outer_radius;
        let mut standing = Self {
            part,
            place,
            solid,
            around,
            middle: place.point((around[0] + around[1]) * 0.5),
            half: (around[1] - around[0]) * 0.5,
            turned: [DVec3::from_array(turned[0]), DVec3::from_array(turned[1])],
            octets,
            center: place.point(center),
            radius: f64::from(part.shape.radius()),
            outer_radius,
            planarity: match part.shape {
                Shape3::Hull(hull) => hull.planarity_error().into(),
                _ => 0.0,
            },
            slack: 0.0,
            even: 0.0,
            lengths,
        };
        let doubt = standing.doubt(standing.center);
        standing.slack = (2.0 * FACE_PREFERENCE * outer_radius).max(doubt);
        standing.even = (2.0 * EVEN_DEPTH * outer_radius).max(doubt);
        standing
    }

    /// Error bound of a coordinate, or of a product with a unit vector, near a point of ground.
    #[inline]
    pub(super) fn doubt(&self, ground: DVec3) -> f64 {
        doubt_of(self.lengths, ground)
    }

    /// Whether a cheap axis shows that a triangle is further away than `beyond` metres: one of a cuboid's thirteen; for
    /// other parts one of the box around them, or across its edges; or the one from the triangle's nearest point to the
    /// part's centre.
    pub(super) fn is_apart(&self, (facet, axes): (&Facet, Option<&Axes>), beyond: f64) -> bool {
        let beyond_core = beyond + self.radius;
        if let Some(axes) = axes {
            if axes.best > beyond_core {
                return true;
            }
            if axes.best < 0.0 {
                return false;
            }
        } else {
            let own = |corner: usize| self.place.axes.turn_back(facet.corners[corner] - self.place.origin);
            let own = [own(0), own(1), own(2)];
            let [low, high] = self.around;
            let above = own[0].min(own[1]).min(own[2]) - high;
            let below = low - own[0].max(own[1]).max(own[2]);
            let is_apart = || is_apart_across(&own, [low, high], beyond_core);
            if above.max(below).max_element() > beyond_core || is_apart() {
                return true;
            }
        }
        // Tried: two more steps, each from the vertex furthest against the last direction. They saved no kernel call
        // for cuboids or hulls of 32, and cost 5 % more instructions per frame of hulls (2026-11-22).
        self.is_apart_towards(self.center, facet, beyond)
    }

    /// The same by the axis from the triangle's nearest point to a point of the core.
    pub(super) fn is_apart_towards(&self, point: DVec3, facet: &Facet, beyond: f64) -> bool {
        let near = nearest_to(facet, point - facet.normal * facet.height(point)).1;
        let Some(towards) = (point - near).try_normalize() else { return false };
        let top = |corner: usize| towards.dot(facet.corners[corner] - near);
        let low = self.low(towards, near) - top(0).max(top(1)).max(top(2));
        low > beyond + self.radius
    }

    /// An upper bound on how far the core reaches from `middle` along a unit normal, by the box around it; rounding
    /// apart.
    #[inline]
    pub(super) fn reach_along(&self, normal: DVec3) -> f64 {
        self.half.dot(self.place.axes.turn_back(normal).abs())
    }

    /// Whether the box around the core contains a point, more than `inside` metres from its faces.
    pub(super) fn is_in_box(&self, point: DVec3, inside: f64) -> bool {
        let own = self.place.axes.turn_back(point - self.place.origin);
        let [low, high] = self.around;
        (own - low).min(high - own).min_element() > inside
    }

    /// A vertex of the core.
    #[inline]
    pub(super) fn point(&self, vertex: usize) -> DVec3 {
        match self.octets.get(vertex / 8) {
            Some([x, y, z]) => DVec3::new(x[vertex % 8], y[vertex % 8], z[vertex % 8]),
            None => self.center,
        }
    }

    /// How low the vertices of the core are over a plane through `origin`.
    pub(super) fn low(&self, normal: DVec3, origin: DVec3) -> f64 {
        let mut low = f64::INFINITY;
        for octet in self.octets {
            let mut heights = [0.0; 8];
            note_heights(octet, [&normal, &origin], &mut heights);
            let least = fold(&heights, |a, b| a < b);
            low = if least < low { least } else { low };
        }
        low
    }

    /// The lowest and highest vertex of the core over a plane through `origin`; of equals, the first. Cost: linear in
    /// the vertices, eight at a time.
    #[inline]
    pub(super) fn extent(&self, normal: DVec3, origin: DVec3) -> Extent {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut low_at, mut high_at) = (0, 0);
        for (octet, number) in self.octets.iter().zip(0..) {
            let mut heights = [0.0; 8];
            note_heights(octet, [&normal, &origin], &mut heights);
            let (least, most) = (fold(&heights, |a, b| a < b), fold(&heights, |a, b| a > b));
            if least < low {
                (low, low_at) = (least, 8 * number + first(&heights, least));
            }
            if most > high {
                (high, high_at) = (most, 8 * number + first(&heights, most));
            }
        }
        Extent { low, lowest: low_at, high, highest: high_at }
    }
}

/// The heights of eight vertices over a plane. In a function of its own: inlined where they are compared, it was
/// scalarised.
#[inline(never)]
fn note_heights([x, y, z]: &[[f64; 8]; 3], [normal, origin]: [&DVec3; 2], heights: &mut [f64; 8]) {
    for i in 0..8 {
        heights[i] =
            normal.x * (x[i] - origin.x) + normal.y * (y[i] - origin.y) + normal.z * (z[i] - origin.z);
    }
}

/// Takes eight coordinates into the least and greatest of each lane.
#[inline(always)]
fn widen<T: Copy + PartialOrd>(ends: &mut [[[T; 8]; 3]; 2], axis: usize, row: &[T; 8]) {
    let [low, high] = ends;
    for i in 0..8 {
        low[axis][i] = if row[i] < low[axis][i] { row[i] } else { low[axis][i] };
        high[axis][i] = if row[i] > high[axis][i] { row[i] } else { high[axis][i] };
    }
}

/// The least and greatest of all lanes.
#[inline(always)]
fn corners_of<T: Copy + PartialOrd>([low, high]: &[[[T; 8]; 3]; 2]) -> [[T; 3]; 2] {
    let least = |row: &[T; 8]| fold(row, |a, b| a < b);
    let most = |row: &[T; 8]| fold(row, |a, b| a > b);
    [[least(&low[0]), least(&low[1]), least(&low[2])], [most(&high[0]), most(&high[1]), most(&high[2])]]
}

/// The one of eight numbers that comes before all others.
#[inline(always)]
fn fold<T: Copy>(of: &[T; 8], is_before: impl Fn(T, T) -> bool) -> T {
    let pick = |a: T, b: T| if is_before(a, b) { a } else { b };
    let four = [pick(of[0], of[4]), pick(of[1], of[5]), pick(of[2], of[6]), pick(of[3], of[7])];
    pick(pick(four[0], four[2]), pick(four[1], four[3]))
}

/// The first index of a number among eight; padding repeats the first of them, and never comes before it.
#[inline(always)]
fn first(of: &[f64; 8], number: f64) -> usize {
    // In lanes of f64, like the numbers that are compared.
    let mut from_end = [0.0; 8];
    for i in 0..8 {
        from_end[i] = if of[i] == number { (8 - i) as f64 } else { 0.0 };
    }
    (8 - usize::from(fold(&from_end, |a, b| a > b) as u8)) % 8
}

/// How far out a triangle's corners lie along each axis, in metres.
#[inline]
pub(in crate::ground3) fn span_of([a, b, c]: &[DVec3; 3]) -> DVec3 {
    a.abs().max(b.abs()).max(c.abs())
}

/// Error bound of a coordinate that such lengths went into, or of its product with a unit vector, near a point of
/// ground.
#[inline]
pub(in crate::ground3) fn doubt_of(lengths: f64, ground: DVec3) -> f64 {
    IN_SPACE.of_parts * (f64::EPSILON / 2.0) * (lengths + ground.abs().element_sum())
}

/// Whether a cross product of edges of the triangle and of a box shows that they are further apart than `beyond`
/// metres; all in the box's axes.
///
/// Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001), with a margin.
fn is_apart_across(corners: &[DVec3; 3], [low, high]: [DVec3; 2], beyond: f64) -> bool {
    let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let corners = [corners[0] - middle, corners[1] - middle, corners[2] - middle];
    for (edge, third) in [(0, 2), (1, 0), (2, 1)] {
        let along = corners[(edge + 1) % 3] - corners[edge];
        let axes = [
            DVec3::new(0.0, -along.z, along.y),
            DVec3::new(along.z, 0.0, -along.x),
            DVec3::new(-along.y, along.x, 0.0),
        ];
        for axis in axes {
            let (one, other) = (axis.dot(corners[edge]), axis.dot(corners[third]));
            let (nearer, further) = if one < other { (one, other) } else { (other, one) };
            let nearest = if nearer > 0.0 { nearer } else { -further };
            let gap = nearest - half.dot(axis.abs());
            if gap > 0.0 && gap * gap > beyond * beyond * axis.length_squared() {
                return true;
            }
        }
    }
    false
}
