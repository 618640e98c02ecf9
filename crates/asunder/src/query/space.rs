//! What the narrow phase says of one body: for the plane, and for space.

use super::answer::NearAnswer;
use crate::collider::Collider;
use crate::space::{Plane, Space, Volume};
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder_geometry::{Circle, Pose2, Pose3, Shape2, Shape3, Sphere};
use asunder_narrow::{Pair2, Pair3};

/// A shape, and where it is.
pub(crate) type Posed<'a, S> = (&'a <S as Space>::Shape, &'a <S as Space>::Pose);

/// A dimension that can be asked.
pub(crate) trait Asked: Space {
    /// A vector of f32.
    type Vector: Copy;
    /// A point of f64.
    type Point: Copy;

    /// A point as a shape; nothing if no pose can be there.
    fn point(at: Self::Point) -> Option<(Self::Shape, Self::Pose)>;
    /// Whether the body shares a point with the shape; exact.
    fn overlaps(at: Posed<'_, Self>, body: &Collider<Self>) -> bool;
    /// How near the body is.
    fn near(at: Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self>;
}

type Near<S> = NearAnswer<<S as Space>::Key, <S as Asked>::Vector, <S as Asked>::Point>;

impl Asked for Plane {
    type Vector = Vec2;
    type Point = DVec2;

    fn point(at: DVec2) -> Option<(Shape2, Pose2)> {
        Some((Circle::POINT.into(), Pose2::at(at).ok()?))
    }

    fn overlaps((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair2::new(shape, pose, &body.shape, &body.pose).overlaps()
    }

    fn near((shape, pose): Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self> {
        let pair = Pair2::new(shape, pose, &body.shape, &body.pose);
        let (here, there) = (pose.position(), body.pose.position());
        let place =
            |anchor_a: Vec2, anchor_b: Vec2| (here + anchor_a.as_dvec2(), there + anchor_b.as_dvec2());
        if let Some(closest) = pair.distance() {
            let (from, point) = place(closest.anchor_a, closest.anchor_b);
            let (error, normal) = (closest.error, closest.normal);
            let distance = closest.distance.into();
            return NearAnswer { body: key, distance, error, overlapping: false, normal, from, point };
        }
        let is_point = matches!(shape, Shape2::Circle(Circle::POINT));
        let deepest = if is_point { None } else { pair.manifold(0.0) };
        let points = deepest.as_ref().map_or(&[][..], |manifold| &manifold.points);
        let deepest = points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation));
        let (from, point) = deepest.map_or((here, here), |deepest| place(deepest.anchor_a, deepest.anchor_b));
        NearAnswer {
            body: key,
            distance: 0.0,
            error: 0.0,
            overlapping: true,
            normal: Vec2::ZERO,
            from,
            point,
        }
    }
}

impl Asked for Volume {
    type Vector = Vec3;
    type Point = DVec3;

    fn point(at: DVec3) -> Option<(Shape3, Pose3)> {
        Some((Sphere::POINT.into(), Pose3::at(at).ok()?))
    }

    fn overlaps((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair3::new(shape, pose, &body.shape, &body.pose).overlaps()
    }

    fn near((shape, pose): Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self> {
        let pair = Pair3::new(shape, pose, &body.shape, &body.pose);
        let (here, there) = (pose.position(), body.pose.position());
        let place =
            |anchor_a: Vec3, anchor_b: Vec3| (here + anchor_a.as_dvec3(), there + anchor_b.as_dvec3());
        if let Some(closest) = pair.distance() {
            let (from, point) = place(closest.anchor_a, closest.anchor_b);
            let (error, normal) = (closest.error, closest.normal);
            let distance = closest.distance.into();
            return NearAnswer { body: key, distance, error, overlapping: false, normal, from, point };
        }
        let is_point = matches!(shape, Shape3::Sphere(Sphere::POINT));
        let deepest = if is_point { None } else { pair.manifold(0.0) };
        let points = deepest.as_ref().map_or(&[][..], |manifold| &manifold.points);
        let deepest = points.iter().min_by(|a, b| a.separation.total_cmp(&b.separation));
        let (from, point) = deepest.map_or((here, here), |deepest| place(deepest.anchor_a, deepest.anchor_b));
        NearAnswer {
            body: key,
            distance: 0.0,
            error: 0.0,
            overlapping: true,
            normal: Vec3::ZERO,
            from,
            point,
        }
    }
}
