//! The narrow phase's part of a query, for one body: in the plane, and in space.

use super::answer::{CastAnswer, NearAnswer, RayAnswer};
use super::walk::{Look, Reach, visit_slots};
use crate::collider::Collider;
use crate::space::{Plane, Space, Volume};
use crate::world::World;
use asunder_broad::Cast;
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder_geometry::{
    Aabb2, Aabb3, Circle, Motion2, Motion3, Pose2, Pose3, Ray2, Ray3, Shape2, Shape3, Sphere,
};
use asunder_narrow::{
    Impact2, Impact3, Manifold2, Manifold3, Pair2, Pair3, Touch2, Touch3, cast_ray2, cast_ray3,
};
use core::cell::Cell;
use core::ops::ControlFlow;
use std::thread::LocalKey;

thread_local! {
    static TOUCHES2: Cell<Vec<Touch2>> = const { Cell::new(Vec::new()) };
    static TOUCHES3: Cell<Vec<Touch3>> = const { Cell::new(Vec::new()) };
}

/// A shape, and where it is.
pub(crate) type Posed<'a, S> = (&'a <S as Space>::Shape, &'a <S as Space>::Pose);

/// A dimension that can be queried.
pub(crate) trait Asked: Space {
    /// A vector of f32.
    type Vector: Copy;
    /// A point of f64.
    type Point: Copy;
    /// A ray.
    type Ray: Copy;

    /// The box around one part of a posed compound, which lies in that of the whole compound; `None` for other shapes.
    fn part_bounds(shape: &Self::Shape, pose: &Self::Pose, part: u32) -> Option<Self::Aabb>;

    /// Visits the slots of all bodies whose boxes are within reach, up to a limit, until the visitor breaks off. Its
    /// definitions are not generic, for the reason of [`Space::advance`].
    fn visit_slots(
        world: &World<Self>,
        within: (&Reach<Self::Aabb>, f64),
        look: &mut Look,
    ) -> ControlFlow<()>;
    /// A point as a shape; `None` if no pose can be there.
    fn point(at: Self::Point) -> Option<(Self::Shape, Self::Pose)>;
    /// Whether the body shares a point with the shape; exact.
    fn overlaps(at: Posed<'_, Self>, body: &Collider<Self>) -> bool;
    /// The same, but one-sided ground counts from its front alone.
    fn overlaps_front(at: Posed<'_, Self>, body: &Collider<Self>) -> bool;
    /// Appends the touches of a shape with the body, where they overlap.
    fn add_touches(at: Posed<'_, Self>, body: &Collider<Self>, to: &mut Vec<Self::Touch>);
    /// Visits the manifolds of the shape with a body that are within the margin, one by one.
    fn visit_manifolds(
        at: Posed<'_, Self>,
        body: &Collider<Self>,
        margin: f32,
        visitor: impl FnMut(&Self::Manifold),
    );
    /// A list that each thread keeps, so that a query in every frame allocates nothing.
    fn kept_touches() -> &'static LocalKey<Cell<Vec<Self::Touch>>>;
    /// How near the body is.
    fn near(at: Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self>;
    /// A ray as a cast against boxes.
    fn along_ray(ray: &Self::Ray) -> Cast;
    /// A moved box as a cast against boxes.
    fn along(bounds: &Self::Aabb, displacement: Self::Vector) -> Cast;
    /// Where the ray enters the body.
    fn enter(ray: &Self::Ray, limit: f64, key: Self::Key, body: &Collider<Self>) -> Option<Enter<Self>>;
    /// Where the moved shape meets the body.
    fn meet(
        at: Posed<'_, Self>,
        displacement: Self::Vector,
        body: &Collider<Self>,
    ) -> Option<(f64, Self::Impact)>;
    /// Where it first meets a part of the body that counts.
    fn meet_if(
        at: Posed<'_, Self>,
        displacement: Self::Vector,
        of: (Self::Key, &Collider<Self>),
        counts: impl Fn(&Meet<Self>) -> bool,
    ) -> Option<Meet<Self>>;
    /// That share of a displacement, as a motion; `None` if it is not finite, or longer than a motion may be.
    fn shift(displacement: Self::Vector, share: f64) -> Option<Self::Motion>;
    /// The greatest coordinate of a displacement, in metres.
    fn longest(displacement: Self::Vector) -> f64;
    /// The answer for an impact at a fraction of the displacement.
    fn met(at: f64, impact: &Self::Impact, key: Self::Key, body: &Collider<Self>) -> Meet<Self>;
}

pub(crate) type Enter<S> = RayAnswer<<S as Space>::Key, <S as Asked>::Vector, <S as Asked>::Point>;

pub(crate) type Meet<S> = CastAnswer<<S as Space>::Key, <S as Asked>::Vector, <S as Asked>::Point>;

pub(crate) type Near<S> = NearAnswer<<S as Space>::Key, <S as Asked>::Vector, <S as Asked>::Point>;

impl Asked for Plane {
    type Vector = Vec2;
    type Point = DVec2;
    type Ray = Ray2;

    fn visit_slots(
        world: &World<Self>,
        within: (&Reach<Self::Aabb>, f64),
        look: &mut Look,
    ) -> ControlFlow<()> {
        visit_slots(world, within, look)
    }

    fn part_bounds(shape: &Shape2, pose: &Pose2, part: u32) -> Option<Aabb2> {
        let Shape2::Compound(compound) = shape else { return None };
        compound.part_bounds(pose, part)
    }

    fn point(at: DVec2) -> Option<(Shape2, Pose2)> {
        Some((Circle::POINT.into(), Pose2::at(at).ok()?))
    }

    fn overlaps((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair2::new(shape, pose, &body.shape, &body.pose).overlaps()
    }

    fn overlaps_front((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair2::new(shape, pose, &body.shape, &body.pose).overlaps_front()
    }

    fn add_touches((shape, pose): Posed<'_, Self>, body: &Collider<Self>, to: &mut Vec<Touch2>) {
        Pair2::new(shape, pose, &body.shape, &body.pose).add_touches(to);
    }

    fn visit_manifolds(
        (shape, pose): Posed<'_, Self>,
        body: &Collider<Self>,
        margin: f32,
        visitor: impl FnMut(&Manifold2),
    ) {
        Pair2::new(shape, pose, &body.shape, &body.pose).visit_manifolds(margin, visitor);
    }

    fn kept_touches() -> &'static LocalKey<Cell<Vec<Touch2>>> {
        &TOUCHES2
    }

    fn near((shape, pose): Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self> {
        let pair = Pair2::new(shape, pose, &body.shape, &body.pose);
        let (here, there) = (pose.position(), body.pose.position());
        let place =
            |anchor_a: Vec2, anchor_b: Vec2| (here + anchor_a.as_dvec2(), there + anchor_b.as_dvec2());
        if let Some(closest) = pair.distance() {
            let (from, point) = place(closest.anchor_a, closest.anchor_b);
            let (error, normal, part) = (closest.error, closest.normal, closest.part_b);
            let distance = closest.distance.into();
            return NearAnswer { body: key, distance, error, overlapping: false, normal, from, point, part };
        }
        let is_point = matches!(shape, Shape2::Circle(Circle::POINT));
        let deepest = if is_point { None } else { pair.manifold(0.0) };
        let part = deepest.as_ref().map_or(0, |manifold| manifold.part_b);
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
            part,
        }
    }

    fn along_ray(ray: &Ray2) -> Cast {
        Cast::from(*ray)
    }

    fn along(bounds: &Aabb2, displacement: Vec2) -> Cast {
        Cast::of_box2(bounds, displacement)
    }

    fn enter(ray: &Ray2, limit: f64, key: Self::Key, body: &Collider<Self>) -> Option<Enter<Self>> {
        let hit = cast_ray2(&body.shape, &body.pose, ray, limit)?;
        let (distance, error, normal) = (hit.distance, hit.error, hit.normal);
        let (inside, part) = (hit.inside, hit.part);
        Some(RayAnswer { body: key, distance, error, point: ray.at(distance), normal, inside, part })
    }

    fn meet(
        (shape, pose): Posed<'_, Self>,
        displacement: Vec2,
        body: &Collider<Self>,
    ) -> Option<(f64, Impact2)> {
        let impact = Pair2::new(shape, pose, &body.shape, &body.pose).cast(displacement)?;
        Some((impact.fraction, impact))
    }

    fn meet_if(
        (shape, pose): Posed<'_, Self>,
        displacement: Vec2,
        (key, body): (Self::Key, &Collider<Self>),
        counts: impl Fn(&Meet<Self>) -> bool,
    ) -> Option<Meet<Self>> {
        let met = |impact: &Impact2| Self::met(impact.fraction, impact, key, body);
        let pair = Pair2::new(shape, pose, &body.shape, &body.pose);
        pair.cast_if(displacement, |impact| counts(&met(impact))).map(|impact| met(&impact))
    }

    fn shift(displacement: Vec2, share: f64) -> Option<Motion2> {
        Motion2::shift(displacement.as_dvec2() * share).ok()
    }

    fn longest(displacement: Vec2) -> f64 {
        displacement.abs().max_element().into()
    }

    fn met(at: f64, impact: &Impact2, key: Self::Key, body: &Collider<Self>) -> Meet<Self> {
        CastAnswer {
            body: key,
            fraction: at,
            error: impact.error,
            overlapping: impact.overlapping,
            normal: impact.normal,
            point: body.pose.position() + impact.anchor_b.as_dvec2(),
            anchor: impact.anchor_a,
            part: impact.part_b,
            part_of_moved: impact.part_a,
        }
    }
}

impl Asked for Volume {
    type Vector = Vec3;
    type Point = DVec3;
    type Ray = Ray3;

    fn visit_slots(
        world: &World<Self>,
        within: (&Reach<Self::Aabb>, f64),
        look: &mut Look,
    ) -> ControlFlow<()> {
        visit_slots(world, within, look)
    }

    fn part_bounds(shape: &Shape3, pose: &Pose3, part: u32) -> Option<Aabb3> {
        let Shape3::Compound(compound) = shape else { return None };
        compound.part_bounds(pose, part)
    }

    fn point(at: DVec3) -> Option<(Shape3, Pose3)> {
        Some((Sphere::POINT.into(), Pose3::at(at).ok()?))
    }

    fn overlaps((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair3::new(shape, pose, &body.shape, &body.pose).overlaps()
    }

    fn overlaps_front((shape, pose): Posed<'_, Self>, body: &Collider<Self>) -> bool {
        Pair3::new(shape, pose, &body.shape, &body.pose).overlaps_front()
    }

    fn add_touches((shape, pose): Posed<'_, Self>, body: &Collider<Self>, to: &mut Vec<Touch3>) {
        Pair3::new(shape, pose, &body.shape, &body.pose).add_touches(to);
    }

    fn visit_manifolds(
        (shape, pose): Posed<'_, Self>,
        body: &Collider<Self>,
        margin: f32,
        visitor: impl FnMut(&Manifold3),
    ) {
        Pair3::new(shape, pose, &body.shape, &body.pose).visit_manifolds(margin, visitor);
    }

    fn kept_touches() -> &'static LocalKey<Cell<Vec<Touch3>>> {
        &TOUCHES3
    }

    fn near((shape, pose): Posed<'_, Self>, key: Self::Key, body: &Collider<Self>) -> Near<Self> {
        let pair = Pair3::new(shape, pose, &body.shape, &body.pose);
        let (here, there) = (pose.position(), body.pose.position());
        let place =
            |anchor_a: Vec3, anchor_b: Vec3| (here + anchor_a.as_dvec3(), there + anchor_b.as_dvec3());
        if let Some(closest) = pair.distance() {
            let (from, point) = place(closest.anchor_a, closest.anchor_b);
            let (error, normal, part) = (closest.error, closest.normal, closest.part_b);
            let distance = closest.distance.into();
            return NearAnswer { body: key, distance, error, overlapping: false, normal, from, point, part };
        }
        let is_point = matches!(shape, Shape3::Sphere(Sphere::POINT));
        let deepest = if is_point { None } else { pair.manifold(0.0) };
        let part = deepest.as_ref().map_or(0, |manifold| manifold.part_b);
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
            part,
        }
    }

    fn along_ray(ray: &Ray3) -> Cast {
        Cast::from(*ray)
    }

    fn along(bounds: &Aabb3, displacement: Vec3) -> Cast {
        Cast::of_box3(bounds, displacement)
    }

    fn enter(ray: &Ray3, limit: f64, key: Self::Key, body: &Collider<Self>) -> Option<Enter<Self>> {
        let hit = cast_ray3(&body.shape, &body.pose, ray, limit)?;
        let (distance, error, normal) = (hit.distance, hit.error, hit.normal);
        let (inside, part) = (hit.inside, hit.part);
        Some(RayAnswer { body: key, distance, error, point: ray.at(distance), normal, inside, part })
    }

    fn meet(
        (shape, pose): Posed<'_, Self>,
        displacement: Vec3,
        body: &Collider<Self>,
    ) -> Option<(f64, Impact3)> {
        let impact = Pair3::new(shape, pose, &body.shape, &body.pose).cast(displacement)?;
        Some((impact.fraction, impact))
    }

    fn meet_if(
        (shape, pose): Posed<'_, Self>,
        displacement: Vec3,
        (key, body): (Self::Key, &Collider<Self>),
        counts: impl Fn(&Meet<Self>) -> bool,
    ) -> Option<Meet<Self>> {
        let met = |impact: &Impact3| Self::met(impact.fraction, impact, key, body);
        let pair = Pair3::new(shape, pose, &body.shape, &body.pose);
        pair.cast_if(displacement, |impact| counts(&met(impact))).map(|impact| met(&impact))
    }

    fn shift(displacement: Vec3, share: f64) -> Option<Motion3> {
        Motion3::shift(displacement.as_dvec3() * share).ok()
    }

    fn longest(displacement: Vec3) -> f64 {
        displacement.abs().max_element().into()
    }

    fn met(at: f64, impact: &Impact3, key: Self::Key, body: &Collider<Self>) -> Meet<Self> {
        CastAnswer {
            body: key,
            fraction: at,
            error: impact.error,
            overlapping: impact.overlapping,
            normal: impact.normal,
            point: body.pose.position() + impact.anchor_b.as_dvec3(),
            anchor: impact.anchor_a,
            part: impact.part_b,
            part_of_moved: impact.part_a,
        }
    }
}
