//! The results of queries.

use crate::space::{BodyKey2, BodyKey3};
use crate::world::slot_of;
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};
use slotmap::Key;

/// A body that a ray meets. `N` is a vector of f32, `P` a point of f64; use it as [`RayAnswer2`] or [`RayAnswer3`].
///
/// ```
/// use asunder::{Collider3, Filter3, Pose3, Ray3, RayAnswer3, Sphere, World3, glam::{DVec3, Vec3}};
/// let mut world = World3::new();
/// let ball = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at([4.0, 0.0, 0.0])?));
/// let ray = Ray3::new(DVec3::ZERO, Vec3::X * 2.0)?;
/// let hit: RayAnswer3 = world.cast_ray(&ray, 9.0, &Filter3::new()).ok_or("it is in the way")?;
/// assert_eq!((hit.body, hit.normal, hit.inside, hit.part), (ball, Vec3::NEG_X, false, 0));
/// assert!((hit.distance - 1.5).abs() * 2.0 <= f64::from(hit.error), "lengths of the direction, metres of error");
/// assert_eq!(hit.point, ray.at(hit.distance));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RayAnswer<K, N, P> {
    /// The body.
    pub body: K,
    /// Where the ray enters it, in lengths of the ray's direction, as [`Ray3::at`](crate::Ray3::at) takes it; 0 if the
    /// ray starts inside.
    pub distance: f64,
    /// Bound on the error of the distance, in metres along the ray.
    pub error: f32,
    /// The point at that distance, in metres.
    pub point: P,
    /// Unit outward normal of the body at that point; opposite to the ray's direction if the ray starts inside.
    pub normal: N,
    /// Whether the ray starts inside the body; touching counts. Exact.
    pub inside: bool,
    /// Which part of the body: the part of a compound, the triangle of ground, the segment of a chain; else 0.
    pub part: u32,
}

/// A body of a [`World2`](crate::World2) that a ray meets.
pub type RayAnswer2 = RayAnswer<BodyKey2, Vec2, DVec2>;

/// A body of a [`World3`](crate::World3) that a ray meets.
pub type RayAnswer3 = RayAnswer<BodyKey3, Vec3, DVec3>;

/// A body that a moved shape meets. `N` is a vector of f32, `P` a point of f64; use it as [`CastAnswer2`] or
/// [`CastAnswer3`].
///
/// ```
/// use asunder::{CastAnswer3, Collider3, Filter3, Pose3, Shape3, Sphere, World3, glam::Vec3};
/// let mut world = World3::new();
/// let ball = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at([4.0, 0.0, 0.0])?));
/// let (dart, here) = (Shape3::from(Sphere::new(0.5)?), Pose3::IDENTITY);
/// let hit: CastAnswer3 = world.cast_shape((&dart, &here), Vec3::X * 5.0, &Filter3::new()).ok_or("it meets the ball")?;
/// assert_eq!((hit.body, hit.overlapping, hit.part, hit.part_of_moved), (ball, false, 0, 0));
/// let gap = 2.5 - hit.fraction * 5.0;
/// assert!((0.0..=f64::from(hit.error)).contains(&gap), "never too far");
/// assert!((hit.normal - Vec3::X).length() < 1e-6 && (hit.anchor - Vec3::X * 0.5).length() < 1e-6);
/// assert!((hit.point.as_vec3() - Vec3::X * 3.0).length() < 1e-5, "on the ball");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CastAnswer<K, N, P> {
    /// The body.
    pub body: K,
    /// The fraction of the displacement after which they touch, 0 to 1. It is never too great: a shape that is moved by
    /// it is free of the body. Multiply in f64: rounded to f32, it may be too great.
    pub fraction: f64,
    /// Bound on the gap that is still left between them then, in metres; 0 if they touch at the start.
    pub error: f32,
    /// Whether they touch at the start. Exact. If so, the fraction is 0, and the normal is the direction of least
    /// depth.
    pub overlapping: bool,
    /// Unit normal in world axes, from the moved shape to the body.
    pub normal: N,
    /// The point of contact on the body, in metres.
    pub point: P,
    /// The point of contact on the moved shape, in world axes, relative to its position then, in metres.
    pub anchor: N,
    /// Which part of the body: the part of a compound, the triangle of ground, the segment of a chain; else 0.
    pub part: u32,
    /// Which part of the moved shape, if that is a compound; else 0.
    pub part_of_moved: u32,
}

/// A body of a [`World2`](crate::World2) that a moved shape meets.
pub type CastAnswer2 = CastAnswer<BodyKey2, Vec2, DVec2>;

/// A body of a [`World3`](crate::World3) that a moved shape meets.
pub type CastAnswer3 = CastAnswer<BodyKey3, Vec3, DVec3>;

/// A body near a point or a shape, and the points of both that are closest. `N` is a vector of f32, `P` a point of
/// f64; use it as [`NearAnswer2`] or [`NearAnswer3`].
///
/// ```
/// use asunder::{Collider3, Filter3, NearAnswer3, Pose3, Sphere, World3, glam::{DVec3, Vec3}};
/// let mut world = World3::new();
/// let ball = world.insert(Collider3::new(Sphere::new(1.0)?).at(Pose3::at([4.0, 0.0, 0.0])?));
/// let near: NearAnswer3 = world.closest(DVec3::X, 9.0, &Filter3::new()).ok_or("it is near")?;
/// assert_eq!((near.body, near.overlapping, near.normal), (ball, false, Vec3::X));
/// assert!((near.distance - 2.0).abs() <= f64::from(near.error));
/// assert_eq!((near.from, near.point), (DVec3::X, DVec3::X * 3.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearAnswer<K, N, P> {
    /// The body.
    pub body: K,
    /// The distance in metres: 0 if they overlap, else positive.
    pub distance: f64,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Whether they share a point; for a query by a point, whether the body contains it. Exact.
    pub overlapping: bool,
    /// Unit normal in world axes towards the body. Zero if they overlap.
    pub normal: N,
    /// The point of the query's shape that is closest to the body, or the query's point, in metres.
    pub from: P,
    /// The point of the body that is closest to `from`, in metres. If the body contains the query's point, it is that
    /// point. If shapes overlap, both points are those of their deepest contact (for two half-spaces, the position of
    /// the query's).
    pub point: P,
    /// Which part of the body `point` is on: the part of a compound, the triangle of ground, the segment of a chain;
    /// else 0. Also 0 if the body contains the query's point. If shapes overlap, the part in the manifold of their
    /// deepest contact.
    pub part: u32,
}

/// A body of a [`World2`](crate::World2) near a point or a shape.
pub type NearAnswer2 = NearAnswer<BodyKey2, Vec2, DVec2>;

/// A body of a [`World3`](crate::World3) near a point or a shape.
pub type NearAnswer3 = NearAnswer<BodyKey3, Vec3, DVec3>;

/// How answers are compared.
pub(crate) trait Ranked {
    /// The distance, and the slot that decides between equals.
    fn rank(&self) -> (f64, u32);
    /// The part of the body that was met; `None` for answers that name no part.
    fn part(&self) -> Option<u32>;
    /// Replaces the distance. What was derived from it stays: the change is less than the error.
    fn put_at(&mut self, distance: f64);
}

impl<K: Key, N, P> Ranked for RayAnswer<K, N, P> {
    fn rank(&self) -> (f64, u32) {
        (self.distance, slot_of(self.body))
    }

    fn part(&self) -> Option<u32> {
        Some(self.part)
    }

    fn put_at(&mut self, distance: f64) {
        self.distance = distance;
    }
}

impl<K: Key, N, P> Ranked for CastAnswer<K, N, P> {
    fn rank(&self) -> (f64, u32) {
        (self.fraction, slot_of(self.body))
    }

    fn part(&self) -> Option<u32> {
        Some(self.part)
    }

    fn put_at(&mut self, fraction: f64) {
        self.fraction = fraction;
    }
}

impl<K: Key, N, P> Ranked for NearAnswer<K, N, P> {
    fn rank(&self) -> (f64, u32) {
        (self.distance, slot_of(self.body))
    }

    fn part(&self) -> Option<u32> {
        Some(self.part)
    }

    fn put_at(&mut self, distance: f64) {
        self.distance = distance;
    }
}

/// A body that is found, without a distance.
pub(crate) struct Met<K>(pub(crate) K);

impl<K: Key> Ranked for Met<K> {
    fn rank(&self) -> (f64, u32) {
        (0.0, slot_of(self.0))
    }

    fn part(&self) -> Option<u32> {
        None
    }

    fn put_at(&mut self, _: f64) {}
}
