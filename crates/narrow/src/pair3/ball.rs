//! A sphere and a cuboid that are not parts of a compound: in closed form, in the cuboid's axes.
//!
//! Separation, error and normal are those of the general path to the last bit, and points up to rounding. That path
//! does more work: the distance takes some 340 ns there and 45 here (AMD EPYC, Zen 4, 2026-11-21).

use super::balls::ClosedForm;
use super::{Pair3, Part, reach_of};
use crate::answer::{Tier, Verdict};
use crate::batch::{Proximity, beyond};
use crate::exact::{self, Corner};
use crate::feature::{Feature, FeatureId};
use crate::polyhedron::cuboids::ball::Nearest;
use crate::precision::{IN_SPACE, Precision};
use crate::room::Room;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Basis3, Cuboid, Pose3, Shape3};

/// A sphere and a cuboid, with their poses.
pub(super) struct Ball<'p> {
    pair: &'p Pair3<'p>,
    cuboid: &'p Cuboid,
    /// The sphere's radius, in metres.
    radius: f32,
    /// Whether the cuboid is B.
    is_b: bool,
}

/// The sphere's centre in the cuboid's axes.
pub(super) struct InCuboidAxes<'p> {
    ball: &'p Ball<'p>,
    /// The cuboid's axes in the world.
    basis: Basis3,
    nearest: Nearest,
    precision: Precision,
    /// The separation of the shapes, where `nearest` is about their cores.
    separation: f64,
}

impl<'a> Pair3<'a> {
    #[inline]
    pub(super) fn ball(&self) -> Option<Ball<'_>> {
        let (cuboid, sphere, is_b) = match (self.shape_a, self.shape_b) {
            (Shape3::Cuboid(cuboid), Shape3::Sphere(sphere)) => (cuboid, sphere, false),
            (Shape3::Sphere(sphere), Shape3::Cuboid(cuboid)) => (cuboid, sphere, true),
            _ => return None,
        };
        Some(Ball { pair: self, cuboid, radius: sphere.radius(), is_b })
    }
}

impl Ball<'_> {
    /// The sum of both bounding radii, in metres.
    #[inline]
    fn outer_radii(&self) -> f64 {
        f64::from(self.cuboid.outer_radius()) + f64::from(self.radius)
    }

    /// Whether the bounding spheres are more than `limit` metres apart for certain.
    #[inline]
    fn is_far(&self, limit: f64) -> bool {
        let reach = self.outer_radii() + limit;
        // The subtraction of positions, three squares, three sums: eight roundings at most.
        self.pair.between.length_squared() > reach * reach * (1.0 + 8.0 * f64::EPSILON)
    }

    /// Whether the inscribed spheres overlap for certain.
    #[inline]
    fn is_near(&self) -> bool {
        let reach = f64::from(self.cuboid.inner_radius()) + f64::from(self.radius);
        // Roundings as in `is_far`.
        self.pair.between.length_squared() * (1.0 + 8.0 * f64::EPSILON) < reach * reach
    }

    #[inline]
    pub(super) fn in_cuboid_axes(&self) -> InCuboidAxes<'_> {
        let (pose, center) = self.place();
        let basis = pose.basis();
        let center = basis.turn_back(center);
        let nearest = Nearest::of(self.cuboid.half_extents().as_dvec3(), center);
        let round = f64::from(self.cuboid.radius());
        let (size, radii) = (f64::from(self.cuboid.outer_radius()) - round, round + f64::from(self.radius));
        let reach = size + radii + center.abs().element_sum();
        let precision = Precision { size, reach, planarity: 0.0, roundings: IN_SPACE.of_bodies };
        InCuboidAxes { ball: self, basis, nearest, precision, separation: nearest.separation - radii }
    }

    /// The cuboid's pose, and the sphere's centre relative to its position.
    #[inline]
    fn place(&self) -> (&Pose3, DVec3) {
        let pair = self.pair;
        if self.is_b { (&pair.pose_b, -pair.between) } else { (&pair.pose_a, pair.between) }
    }

    #[inline]
    pub(super) fn verdict(&self) -> Verdict {
        if self.is_far(0.0) {
            return Verdict { overlapping: false, tier: Tier::Bound };
        }
        if self.is_near() {
            return Verdict { overlapping: true, tier: Tier::Bound };
        }
        self.in_cuboid_axes().verdict()
    }

    /// Whether they overlap, if they are within the margin. The manifold is written if one is wanted.
    #[inline]
    pub(super) fn contact(&self, margin: f32, manifolds: &mut impl Room) -> Proximity {
        if self.is_far(reach_of(margin)) {
            // Roundings as in `is_far`.
            let apart = self.pair.between.length() * (1.0 - 8.0 * f64::EPSILON);
            return Proximity::Beyond(beyond(apart - self.outer_radii(), reach_of(margin)));
        }
        self.in_cuboid_axes().contact(margin, manifolds)
    }
}

impl ClosedForm for InCuboidAxes<'_> {
    #[inline]
    fn pair(&self) -> &Pair3<'_> {
        self.ball.pair
    }

    #[inline]
    fn separation(&self) -> f64 {
        self.separation
    }

    #[inline]
    fn precision(&self) -> &Precision {
        &self.precision
    }

    #[cold]
    fn exactly(&self) -> bool {
        let Pair3 { shape_a, shape_b, pose_a, pose_b, .. } = self.ball.pair;
        let site = |shape, pose: &Pose3| Part::whole(shape, &self.basis).site(pose);
        let (a, b) = (site(shape_a, pose_a), site(shape_b, pose_b));
        let of_both = |corner| if self.ball.is_b { [0, corner] } else { [corner, 0] };
        let corners: ArrayVec<Corner, 3> = self.nearest.corners().into_iter().map(of_both).collect();
        exact::overlaps3([&a, &b], &corners)
    }

    #[inline]
    fn normal(&self) -> Vec3 {
        self.in_world(if self.ball.is_b { -self.nearest.normal } else { self.nearest.normal })
    }

    #[inline]
    fn anchors(&self) -> [Vec3; 2] {
        let Nearest { normal, on_cuboid, .. } = self.nearest;
        let on_cuboid = self.in_world(on_cuboid + normal * f64::from(self.ball.cuboid.radius()));
        let on_sphere = self.in_world(normal * -f64::from(self.ball.radius));
        if self.ball.is_b { [on_sphere, on_cuboid] } else { [on_cuboid, on_sphere] }
    }

    /// Points are measured from the cuboid, in either order.
    #[inline]
    fn is_from_b(&self) -> bool {
        self.ball.is_b
    }

    fn feature(&self) -> FeatureId {
        let (of_cuboid, of_sphere) = (self.nearest.feature(), Feature::Vertex(0));
        if self.ball.is_b {
            FeatureId::new(of_sphere, of_cuboid)
        } else {
            FeatureId::new(of_cuboid, of_sphere)
        }
    }
}

impl InCuboidAxes<'_> {
    #[inline]
    fn in_world(&self, v: DVec3) -> Vec3 {
        self.basis.turn(v).as_vec3()
    }
}

#[cfg(test)]
mod tests;
