//! Ground and a body beside it: their frames, and which triangles a convex part may touch.

use crate::answer::{ContactPoint3, Manifold3};
use crate::pair3::{Pair3, Part};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Aabb3, Basis3, Ground, Shape3};

/// A part's position, for deciding which side of a triangle it is on.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Viewpoint {
    /// The centre of its bounding sphere.
    Place(DVec3),
    /// At infinity in a unit direction: for a half-space the direction into it, as its position is an arbitrary point
    /// of its plane.
    Far(DVec3),
}

/// Sine of the angle by which a direction may point behind a triangle and still count as parallel to it, and so as in
/// front.
const ASIDE: f64 = 1e-9;

impl Viewpoint {
    /// Whether it is in front of a triangle, given by one of its corners and its normal, of any length.
    #[inline]
    pub(crate) fn is_in_front(self, corner: DVec3, normal: DVec3) -> bool {
        match self {
            Self::Place(place) => normal.dot(place - corner) >= 0.0,
            Self::Far(direction) => normal.dot(direction) >= -ASIDE * normal.length(),
        }
    }
}

/// Ground, and a body that may touch it.
#[derive(Clone, Copy)]
pub(crate) struct OnGround<'a> {
    pub(crate) ground: Ground<'a>,
    /// The body's shape. It may be ground, too.
    pub(crate) body: &'a Shape3,
    /// The ground is B, and the body A.
    pub(crate) is_b: bool,
    /// The ground's axes in the world.
    pub(crate) basis: Basis3,
    /// The body's axes in the world.
    pub(crate) body_basis: Basis3,
    /// The body's position less the ground's.
    pub(crate) to_body: DVec3,
}

impl<'a> OnGround<'a> {
    /// `None` where neither shape is ground. If both are, B is the ground and A the body.
    #[inline]
    pub(crate) fn of(pair: &Pair3<'a>) -> Option<Self> {
        let (a, b) = (Ground::of(pair.shape_a), Ground::of(pair.shape_b));
        let [basis_a, basis_b] = [&pair.pose_a, &pair.pose_b];
        match (a, b) {
            (_, Some(ground)) => Some(Self {
                ground,
                body: pair.shape_a,
                is_b: true,
                basis: basis_b.basis(),
                body_basis: basis_a.basis(),
                to_body: -pair.between,
            }),
            (Some(ground), None) => Some(Self {
                ground,
                body: pair.shape_b,
                is_b: false,
                basis: basis_a.basis(),
                body_basis: basis_b.basis(),
                to_body: pair.between,
            }),
            (None, None) => None,
        }
    }

    /// The box around a convex part of the body in the ground's axes, grown by `reach` metres and rounded outwards;
    /// computed from the f64 box around its core. Infinite for a half-space.
    pub(crate) fn bounds_around(&self, part: &Part, [low, high]: [DVec3; 2], reach: f64) -> Aabb3 {
        if matches!(part.shape, Shape3::HalfSpace(_)) {
            return Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY);
        }
        let (_, summed) = self.origin_of(part);
        let lengths = summed + f64::from(part.shape.outer_radius()) + part.shape.center().as_dvec3().length();
        grown_around([low, high], f64::from(part.shape.radius()) + reach, lengths)
    }

    /// A part's origin in the ground's axes, and the summed lengths of the vectors that make it up, in metres.
    #[inline]
    pub(crate) fn origin_of(&self, part: &Part) -> (DVec3, f64) {
        let (_, shift) = part.placed(&self.body_basis);
        (self.basis.turn_back(self.to_body + shift), self.to_body.length() + shift.length())
    }
}

/// The box between two corners, grown by `grow` metres and by the rounding error that comes with such lengths.
#[inline]
pub(crate) fn grown_around([low, high]: [DVec3; 2], grow: f64, lengths: f64) -> Aabb3 {
    let grow = DVec3::splat(grow + 64.0 * f64::EPSILON * lengths);
    box_around([low - grow, high + grow])
}

/// The box between two corners, rounded outwards: one step beyond the nearest f32.
pub(crate) fn box_around([low, high]: [DVec3; 2]) -> Aabb3 {
    let low = low.as_vec3().to_array().map(f32::next_down);
    let high = high.as_vec3().to_array().map(f32::next_up);
    Aabb3::new(low.into(), high.into())
}

impl OnGround<'_> {
    /// Reorders a pair from (body, ground) to (A, B), or back.
    #[inline]
    pub(crate) fn in_order<T>(&self, [one, other]: [T; 2]) -> [T; 2] {
        if self.is_b { [one, other] } else { [other, one] }
    }

    /// The normal of a manifold from the ground to the body, in world axes.
    pub(crate) fn towards(&self, manifold: &Manifold3) -> DVec3 {
        let normal = manifold.normal.as_dvec3();
        if self.is_b { -normal } else { normal }
    }

    /// The ends of a contact point on the body, from its position, and on ground, from the ground's, in world axes. The
    /// latter is computed from the former: its anchor is rounded the more the larger the ground is.
    pub(crate) fn ends(&self, manifold: &Manifold3, point: &ContactPoint3) -> [DVec3; 2] {
        let [on_body, _] = self.in_order([point.anchor_a, point.anchor_b]);
        let on_body = on_body.as_dvec3();
        [on_body, self.to_body + on_body - self.towards(manifold) * f64::from(point.separation)]
    }
}
