//! The results of casts in space: impacts, and hits of rays.

use asunder_geometry::glam::Vec3;

/// When and where a moved shape in space first touches another.
///
/// ```
/// use asunder::{Pair3, Pose3, Shape3, Sphere, glam::Vec3};
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// let (here, there) = (Pose3::IDENTITY, Pose3::at([5.0, 0.0, 0.0])?);
/// let impact = Pair3::new(&ball, &here, &ball, &there).cast(Vec3::X * 8.0).ok_or("it flies into the other")?;
/// assert!(impact.fraction <= 0.5 && (0.5 - impact.fraction) * 8.0 <= f64::from(impact.error));
/// assert!((impact.anchor_a - Vec3::X * 0.5).length() < 1e-6 && (impact.normal - Vec3::X).length() < 1e-6);
/// assert!(!impact.overlapping && impact.error < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact3 {
    /// The fraction of the motion at the impact, from 0 to 1. Up to it, the poses that `pose_at` of the motions gives do
    /// not touch.
    pub fraction: f64,
    /// Bound on the distance of the shapes at `fraction`, in metres; 0 if they touch at the start. It includes the
    /// rounding of a pose at that fraction.
    pub error: f32,
    /// Whether they already touch at the start, exactly. Then the fraction is 0, and the normal is the direction of
    /// least depth.
    pub overlapping: bool,
    /// Unit axis in world axes, from A to B, at the impact.
    pub normal: Vec3,
    /// The point of contact on A, in world axes, relative to A's position at the impact.
    pub anchor_a: Vec3,
    /// The point of contact on B, in world axes, relative to B's position at the impact.
    pub anchor_b: Vec3,
    /// Which part of A, for shapes made of several, and for ground; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several, and for ground; else 0.
    pub part_b: u32,
}

/// Where a ray in space first meets a shape.
///
/// ```
/// use asunder::{Pose3, Ray3, Shape3, Sphere, cast_ray3, glam::Vec3};
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// let ray = Ray3::new([-2.0, 0.0, 0.0], Vec3::X * 3.0)?;
/// let hit = cast_ray3(&ball, &Pose3::IDENTITY, &ray, f64::INFINITY).ok_or("it points at the ball")?;
/// assert!((hit.distance - 0.5).abs() * 3.0 <= f64::from(hit.error));
/// assert_eq!((hit.normal, hit.inside, hit.part), (Vec3::NEG_X, false, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit3 {
    /// The distance along the ray, in lengths of its direction, as [`Ray3::at`](asunder_geometry::Ray3::at) takes it.
    pub distance: f64,
    /// Bound on the error of the distance, in metres along the ray; 0 if the ray starts inside.
    pub error: f32,
    /// Outward unit normal of the shape at that point, in world axes; opposite to the ray's direction if it starts
    /// inside.
    pub normal: Vec3,
    /// Whether the ray starts in the shape, exactly; touching counts. Then the distance is 0.
    pub inside: bool,
    /// Which part of a shape made of several, or which triangle of ground; else 0.
    pub part: u32,
}
