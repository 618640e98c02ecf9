//! The results of casts in the plane: impacts, and hits of rays.

use asunder_geometry::glam::Vec2;

/// When and where a moved shape in the plane first touches another.
///
/// ```
/// use asunder::{Circle, Pair2, Pose2, Shape2, glam::Vec2};
/// let ball = Shape2::from(Circle::new(0.5)?);
/// let (here, there) = (Pose2::IDENTITY, Pose2::at([3.0, 0.0])?);
/// let impact = Pair2::new(&ball, &here, &ball, &there).cast(Vec2::X * 4.0).ok_or("they meet")?;
/// assert!((impact.fraction - 0.5).abs() * 4.0 <= f64::from(impact.error) && impact.error < 1e-6);
/// assert_eq!((impact.normal, impact.anchor_a, impact.anchor_b), (Vec2::X, Vec2::X * 0.5, Vec2::X * -0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Impact2 {
    /// The fraction of the motion at the impact, from 0 to 1. Up to it, the poses that `pose_at` of the motions gives do
    /// not touch.
    pub fraction: f64,
    /// Bound on the distance of the shapes at `fraction`, in metres; 0 if they touch at the start. It includes the
    /// rounding of a pose at that fraction.
    pub error: f32,
    /// Whether they already touch at the start, exactly. Then the fraction is 0, and the normal is the direction of
    /// least depth.
    pub overlapping: bool,
    /// Unit normal in world axes, from A to B, at the impact.
    pub normal: Vec2,
    /// The point of contact on A, in world axes, relative to A's position at the impact.
    pub anchor_a: Vec2,
    /// The point of contact on B, in world axes, relative to B's position at the impact.
    pub anchor_b: Vec2,
    /// Which part of A, for shapes made of several; of a chain, the first segment of the straight run; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several; of a chain, the first segment of the straight run; else 0.
    pub part_b: u32,
}

/// Where a ray in the plane enters a shape.
///
/// ```
/// use asunder::{Pose2, Ray2, Rect, Shape2, cast_ray2, glam::Vec2};
/// let square = Shape2::from(Rect::from_half_extents(Vec2::ONE)?);
/// let within = Ray2::new([0.5, 0.0], Vec2::X)?;
/// let hit = cast_ray2(&square, &Pose2::IDENTITY, &within, 10.0).ok_or("it starts inside")?;
/// assert_eq!((hit.inside, hit.distance, hit.error, hit.normal), (true, 0.0, 0.0, Vec2::NEG_X));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit2 {
    /// The distance along the ray, in lengths of its direction, as `Ray2::at` takes it.
    pub distance: f64,
    /// Bound on the error of the distance, in metres along the ray. A ray that misses by less than rounding may be
    /// reported as a hit, and one that enters by less than rounding as a miss.
    pub error: f32,
    /// Outward unit normal of the shape at that point, in world axes; opposite to the ray's direction if it starts
    /// inside.
    pub normal: Vec2,
    /// Whether the ray starts in the shape, exactly; touching counts. Then the distance is 0.
    pub inside: bool,
    /// Which part, for a shape made of several, or which segment of a chain; else 0.
    pub part: u32,
}
