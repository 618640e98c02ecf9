//! What a narrow phase says: separations, closest points, manifolds. One set a dimension, alike in every name.

use crate::feature::{FeatureId, Hint};
use arrayvec::ArrayVec;
use asunder_geometry::glam::{Vec2, Vec3};
use core::ops::Range;

/// The answer to one job of a batch.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The shapes are further apart than the margin.
    Apart {
        /// For the next frame: the axis that separates them.
        hint: Hint,
        /// By how much more than the margin they are apart at least, in metres; zero where that is not known. Until
        /// points of theirs have moved that far against each other, they stay apart.
        beyond: f32,
    },
    /// The shapes are within the margin of each other.
    Contact {
        /// For the next frame.
        hint: Hint,
        /// Whether they share a point.
        overlapping: bool,
        /// Their manifolds, as a range of the batch's. Empty for a sensor.
        manifolds: Range<u32>,
    },
}

/// Which tier of precision settled whether two shapes overlap.
///
/// ```
/// use asunder_geometry::{Cuboid, Pose3, Shape3, glam::Vec3};
/// use asunder_narrow::{Pair3, Tier};
/// let brick = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.1, 0.05, 0.2))?);
/// let (here, next) = (Pose3::IDENTITY, Pose3::at([0.3, 0.0, 0.0])?);
/// assert_eq!(Pair3::new(&brick, &here, &brick, &next).verdict().tier, Tier::Bound);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// What is asked first, by its own bound. For two cuboids, or polygons of few edges, all axes: one shows a gap
    /// beyond rounding, or each more overlap than it may be off by. For half-spaces, spheres and capsules a
    /// distance in closed form. For the rest a search for an axis that parts them, or for corners around a common
    /// point.
    Bound,
    /// For those that went by axes: the same search.
    Double,
    /// Exact arithmetic.
    Exact,
}

/// Whether two shapes overlap, and how that was settled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Verdict {
    /// Whether the shapes share a point; touching counts. Exact, whichever the tier.
    pub overlapping: bool,
    /// The tier that settled it.
    pub tier: Tier,
}

/// A separation in the plane, or a bound on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation2 {
    /// Found, with its error and axis.
    Measured(Measured2),
    /// Beyond the caller's limit: the shapes are at least this far apart, in metres. Rounded down, so that it may equal
    /// the limit.
    AtLeast(f32),
}

/// A separation in space, or a bound on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation3 {
    /// Found, with its error and axis.
    Measured(Measured3),
    /// Beyond the caller's limit: the shapes are at least this far apart, in metres. Rounded down, so that it may equal
    /// the limit.
    AtLeast(f32),
}

/// A separation in the plane and the axis that shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured2 {
    /// Metres: positive the distance, negative minus the least translation that parts them. Not positive exactly
    /// when the shapes overlap.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec2,
}

/// A separation in space and the axis that shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured3 {
    /// Metres: positive the distance, negative minus the least translation that parts them. Not positive exactly
    /// when the shapes overlap.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec3,
}

/// Closest points of two shapes in the plane that do not overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest2 {
    /// The distance in metres, always positive.
    pub distance: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec2,
    /// The point of A, in world axes, relative to A's position.
    pub anchor_a: Vec2,
    /// The point of B, in world axes, relative to B's position.
    pub anchor_b: Vec2,
    /// Which part of A that is: of a compound its part, of a chain the segment by its number; else 0.
    pub part_a: u32,
    /// The same of B.
    pub part_b: u32,
}

/// Closest points of two shapes in space that do not overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closest3 {
    /// The distance in metres, always positive.
    pub distance: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec3,
    /// The point of A, in world axes, relative to A's position.
    pub anchor_a: Vec3,
    /// The point of B, in world axes, relative to B's position.
    pub anchor_b: Vec3,
    /// Which part of A that is: of a compound its part, of ground the triangle by its number; else 0.
    pub part_a: u32,
    /// The same of B.
    pub part_b: u32,
}

/// One point of a manifold in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint2 {
    /// Distance along the normal from A's point to B's, in metres: negative where they overlap.
    pub separation: f32,
    /// The point on A, in world axes, relative to A's position.
    pub anchor_a: Vec2,
    /// The point on B, in world axes, relative to B's position.
    pub anchor_b: Vec2,
    /// What touches what.
    pub feature: FeatureId,
}

/// One point of a manifold in space.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint3 {
    /// Distance along the normal from A's point to B's, in metres: negative where they overlap.
    pub separation: f32,
    /// The point on A, in world axes, relative to A's position.
    pub anchor_a: Vec3,
    /// The point on B, in world axes, relative to B's position.
    pub anchor_b: Vec3,
    /// What touches what.
    pub feature: FeatureId,
}

/// How two convex shapes in the plane touch: one normal, and one or two points, in order of their feature ids.
///
/// Of a chain, the part is the first segment of the straight run that is touched, or the least of those that share the
/// normal; and the error holds how far its vertices lie beside that.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Manifold2 {
    /// Which part of A, for shapes made of several, and for ground; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several, and for ground; else 0.
    pub part_b: u32,
    /// Unit normal in world axes, from A to B.
    pub normal: Vec2,
    /// Separation of the two parts, in metres. The least of the points' own is within `error` of it, plus 2e-6 of the
    /// smaller bounding radius: what a steady choice of the reference may cost.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Where they touch. Never empty.
    pub points: ArrayVec<ContactPoint2, 2>,
}

/// How two convex shapes in space touch: one normal, and one to four points, in order of their feature ids.
///
/// Of ground, the part is the least triangle of the plane that is touched, or of those that share the normal.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Manifold3 {
    /// Which part of A, for shapes made of several, and for ground; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several, and for ground; else 0.
    pub part_b: u32,
    /// Unit normal in world axes, from A to B.
    pub normal: Vec3,
    /// Separation of the two parts, in metres. The least of the points' own is within `error` of it, plus 2e-6 of the
    /// smaller bounding radius: what a steady choice of the reference may cost. Of four points, which may stand for more, and of
    /// fewer on ground made of triangles, where several triangles' may be one, it is up to 2^-15 of the smaller bounding diameter
    /// above that: what a steady choice may cost.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Where they touch. Never empty. Of more corners than four, those that hold the patch by at least 95 % of the best four's
    /// area, one of them as deep as any up to that: the same from frame to frame, but for a coincidence, while their features are.
    pub points: ArrayVec<ContactPoint3, 4>,
}

/// What a pair looks like within a limit; `N` is the plane's or the space's.
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for one pair, and a frame allocates nothing"
)]
pub(crate) enum Probe<N> {
    /// Further apart than the limit: by at least so much.
    Beyond(f32, Hint),
    /// The separation, and all that is needed to make contact points.
    Near(N),
}
