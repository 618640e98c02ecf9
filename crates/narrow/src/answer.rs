//! The narrow phase's answers: separations, closest points, manifolds. The types for the plane and for space have the
//! same fields.

use crate::feature::{FeatureId, Hint};
use crate::points::ContactPoints;
use asunder_geometry::glam::{Vec2, Vec3};
use core::ops::Range;

/// The answer to one job of a batch.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The shapes are further apart than the margin.
    Apart {
        /// For the next frame: the axis that separates them.
        hint: Hint,
        /// A lower bound on how much further apart than the margin they are, in metres; zero where none is known. Until
        /// their points have moved by that much relative to each other, the shapes stay apart.
        beyond: f32,
    },
    /// The shapes are within the margin of each other.
    Contact {
        /// For the next frame.
        hint: Hint,
        /// Whether they share a point.
        overlapping: bool,
        /// Their manifolds, as a range of [`Batch::manifolds`](crate::Batch::manifolds). Empty for a sensor.
        manifolds: Range<u32>,
    },
}

/// Which tier of precision settled whether two shapes overlap.
///
/// ```
/// use asunder::{Cuboid, Pair3, Pose3, Shape3, Tier, glam::Vec3};
/// let brick = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.1, 0.05, 0.2))?);
/// let (here, next) = (Pose3::IDENTITY, Pose3::at([0.3, 0.0, 0.0])?);
/// assert_eq!(Pair3::new(&brick, &here, &brick, &next).verdict().tier, Tier::Bound);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tier {
    /// The first test, whose own error bound was enough:
    ///
    /// - Two cuboids, or polygons of few edges: all separating axes. One shows a gap beyond rounding error, or every
    ///   one shows an overlap beyond it.
    /// - Half-spaces, spheres and capsules: a distance in closed form.
    /// - All others: a search for a separating axis, or for support points that enclose a common point.
    Bound,
    /// Only for the pairs that `Bound` tests by their axes (cuboids, polygons of few edges): the axes did not settle
    /// it, but the search with which all other shapes begin did.
    Double,
    /// Exact arithmetic.
    Exact,
}

/// Whether two shapes overlap, and how that was settled.
///
/// ```
/// use asunder::{Cuboid, Pair3, Pose3, Shape3, Tier, Verdict, glam::Vec3};
/// let unit = Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?);
/// let (here, beside) = (Pose3::IDENTITY, Pose3::at([2.0, 0.0, 0.0])?);
/// let Verdict { overlapping, tier } = Pair3::new(&unit, &here, &unit, &beside).verdict();
/// assert!(overlapping && tier > Tier::Bound, "a shared side: f64 alone cannot tell");
/// assert!(Tier::Bound < Tier::Double && Tier::Double < Tier::Exact);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Verdict {
    /// Whether the shapes share a point; touching counts. Exact, whichever the tier.
    pub overlapping: bool,
    /// The tier that settled it.
    pub tier: Tier,
}

/// A separation in the plane, or a bound on it.
///
/// ```
/// use asunder::{Circle, Measured2, Pair2, Pose2, Separation2, Shape2};
/// let ball = Shape2::from(Circle::new(1.0)?);
/// let (here, there) = (Pose2::IDENTITY, Pose2::at([3.0, 0.0])?);
/// let pair = Pair2::new(&ball, &here, &ball, &there);
/// let Separation2::Measured(Measured2 { separation, error, .. }) = pair.separation(2.0) else {
///     return Err("they are nearer than 2 m".into());
/// };
/// assert!((separation - 1.0).abs() <= error);
/// assert!(matches!(pair.separation(0.5), Separation2::AtLeast(bound) if (0.5..=1.0).contains(&bound)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation2 {
    /// Found, with its error and axis.
    Measured(Measured2),
    /// Beyond the caller's limit: the shapes are at least this far apart, in metres. Rounded down, so that it may equal
    /// the limit.
    AtLeast(f32),
}

impl Separation2 {
    /// The measured separation; `None` beyond the caller's limit.
    ///
    /// ```
    /// use asunder::{Circle, Pair2, Pose2, Shape2};
    /// let ball = Shape2::from(Circle::new(1.0)?);
    /// let (here, there) = (Pose2::IDENTITY, Pose2::at([3.0, 0.0])?);
    /// let pair = Pair2::new(&ball, &here, &ball, &there);
    /// let gap = pair.separation(f32::INFINITY).measured().ok_or("all is within that")?;
    /// assert!((gap.separation - 1.0).abs() <= gap.error);
    /// assert!(pair.separation(0.5).measured().is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn measured(self) -> Option<Measured2> {
        match self {
            Self::Measured(measured) => Some(measured),
            Self::AtLeast(_) => None,
        }
    }
}

/// A separation in space, or a bound on it.
///
/// ```
/// use asunder::{Measured3, Pair3, Pose3, Separation3, Shape3, Sphere};
/// let ball = Shape3::from(Sphere::new(1.0)?);
/// let (here, there) = (Pose3::IDENTITY, Pose3::at([3.0, 0.0, 0.0])?);
/// let pair = Pair3::new(&ball, &here, &ball, &there);
/// let Separation3::Measured(Measured3 { separation, error, .. }) = pair.separation(2.0) else {
///     return Err("they are nearer than 2 m".into());
/// };
/// assert!((separation - 1.0).abs() <= error);
/// assert!(matches!(pair.separation(0.5), Separation3::AtLeast(bound) if (0.5..=1.0).contains(&bound)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Separation3 {
    /// Found, with its error and axis.
    Measured(Measured3),
    /// Beyond the caller's limit: the shapes are at least this far apart, in metres. Rounded down, so that it may equal
    /// the limit.
    AtLeast(f32),
}

impl Separation3 {
    /// The measured separation; `None` beyond the caller's limit.
    ///
    /// ```
    /// use asunder::{Pair3, Pose3, Shape3, Sphere};
    /// let ball = Shape3::from(Sphere::new(1.0)?);
    /// let (here, there) = (Pose3::IDENTITY, Pose3::at([3.0, 0.0, 0.0])?);
    /// let pair = Pair3::new(&ball, &here, &ball, &there);
    /// let gap = pair.separation(f32::INFINITY).measured().ok_or("all is within that")?;
    /// assert!((gap.separation - 1.0).abs() <= gap.error);
    /// assert!(pair.separation(0.5).measured().is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn measured(self) -> Option<Measured3> {
        match self {
            Self::Measured(measured) => Some(measured),
            Self::AtLeast(_) => None,
        }
    }
}

/// A separation in the plane and the axis that shows it.
///
/// ```
/// use asunder::{Circle, Measured2, Pair2, Pose2, Separation2, Shape2, glam::Vec2};
/// let ball = Shape2::from(Circle::new(1.0)?);
/// let (here, there) = (Pose2::IDENTITY, Pose2::at([1.5, 0.0])?);
/// let pair = Pair2::new(&ball, &here, &ball, &there);
/// let Separation2::Measured(deep) = pair.separation(0.0) else { return Err("they overlap".into()) };
/// let Measured2 { separation, error, normal } = deep;
/// assert!((separation + 0.5).abs() <= error, "half a metre deep");
/// assert!((normal - Vec2::X).length() < 1e-6, "the way out for the second");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured2 {
    /// In metres. Where the shapes are apart, their distance; where they overlap, minus the length of the shortest
    /// translation that separates them. For shapes of several parts, the least over all pairs of parts. At most zero
    /// exactly when the shapes overlap.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec2,
}

/// A separation in space and the axis that shows it.
///
/// ```
/// use asunder::{Measured3, Pair3, Pose3, Separation3, Shape3, Sphere, glam::Vec3};
/// let ball = Shape3::from(Sphere::new(1.0)?);
/// let (here, there) = (Pose3::IDENTITY, Pose3::at([1.5, 0.0, 0.0])?);
/// let pair = Pair3::new(&ball, &here, &ball, &there);
/// let Separation3::Measured(deep) = pair.separation(0.0) else { return Err("they overlap".into()) };
/// let Measured3 { separation, error, normal } = deep;
/// assert!((separation + 0.5).abs() <= error, "half a metre deep");
/// assert!((normal - Vec3::X).length() < 1e-6, "the way out for the second");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured3 {
    /// In metres. Where the shapes are apart, their distance; where they overlap, minus the length of the shortest
    /// translation that separates them. For shapes of several parts, the least over all pairs of parts. At most zero
    /// exactly when the shapes overlap.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Unit axis in world axes, from A to B.
    pub normal: Vec3,
}

/// Closest points of two shapes in the plane that do not overlap.
///
/// ```
/// use asunder::{Circle, Closest2, Pair2, Pose2, Shape2, glam::Vec2};
/// let ball = Shape2::from(Circle::new(1.0)?);
/// let (here, there) = (Pose2::IDENTITY, Pose2::at([3.0, 0.0])?);
/// let pair = Pair2::new(&ball, &here, &ball, &there);
/// let Closest2 { distance, error, normal, anchor_a, anchor_b, .. } = pair.distance().ok_or("they are apart")?;
/// assert!((distance - 1.0).abs() <= error);
/// assert_eq!((normal, anchor_a, anchor_b), (Vec2::X, Vec2::X, Vec2::NEG_X), "each from its own position");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// Which part of A the point is on: a part of a compound, or a segment of a chain; else 0.
    pub part_a: u32,
    /// The same for B.
    pub part_b: u32,
}

/// Closest points of two shapes in space that do not overlap.
///
/// ```
/// use asunder::{Closest3, Pair3, Pose3, Shape3, Sphere, glam::Vec3};
/// let ball = Shape3::from(Sphere::new(1.0)?);
/// let (here, there) = (Pose3::IDENTITY, Pose3::at([3.0, 0.0, 0.0])?);
/// let pair = Pair3::new(&ball, &here, &ball, &there);
/// let Closest3 { distance, error, normal, anchor_a, anchor_b, .. } = pair.distance().ok_or("they are apart")?;
/// assert!((distance - 1.0).abs() <= error);
/// assert_eq!((normal, anchor_a, anchor_b), (Vec3::X, Vec3::X, Vec3::NEG_X), "each from its own position");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
    /// Which part of A the point is on: a part of a compound, or a triangle of ground; else 0.
    pub part_a: u32,
    /// The same for B.
    pub part_b: u32,
}

/// One point of a manifold in the plane.
///
/// ```
/// use asunder::{Circle, ContactPoint2, Pair2, Pose2, Shape2};
/// let ball = Shape2::from(Circle::new(1.0)?);
/// let (here, there) = (Pose2::IDENTITY, Pose2::at([1.5, 0.0])?);
/// let pair = Pair2::new(&ball, &here, &ball, &there);
/// let manifold = pair.manifold(0.0).ok_or("they touch")?;
/// let ContactPoint2 { separation, anchor_a, anchor_b, .. } = manifold.points[0];
/// assert!((separation + 0.5).abs() < 1e-6);
/// // Both points in the world, and the way from one to the other along the normal.
/// let (on_a, on_b) = (anchor_a, there.position().as_vec2() + anchor_b);
/// assert!((on_b - on_a - manifold.normal * separation).length() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint2 {
    /// Distance along the normal from A's point to B's, in metres: negative where they overlap.
    pub separation: f32,
    /// The point on A, in world axes, relative to A's position.
    pub anchor_a: Vec2,
    /// The point on B, in world axes, relative to B's position.
    pub anchor_b: Vec2,
    /// The feature of A and that of B which touch.
    pub feature: FeatureId,
}

/// One point of a manifold in space.
///
/// Except on ground, and in manifolds that [`Persistent3`](crate::Persistent3) or a world has moved along with their
/// bodies, one anchor is the other, moved along the normal by the separation, bit for bit. Let `offset` be
/// from A's position to B's, in f64, and `out` the normal times the separation. Then either `anchor_b` is
/// `anchor_a - offset + out`, rounded once, at all points of a manifold; or `anchor_a` is `anchor_b + offset - out` at
/// all of them.
///
/// ```
/// use asunder::{ContactPoint3, Pair3, Pose3, Shape3, Sphere};
/// let ball = Shape3::from(Sphere::new(1.0)?);
/// let (here, there) = (Pose3::IDENTITY, Pose3::at([1.5, 0.0, 0.0])?);
/// let pair = Pair3::new(&ball, &here, &ball, &there);
/// let manifold = pair.manifold(0.0).ok_or("they touch")?;
/// let ContactPoint3 { separation, anchor_a, anchor_b, .. } = manifold.points[0];
/// assert!((separation + 0.5).abs() < 1e-6);
/// // Both points in the world, and the way from one to the other along the normal.
/// let (on_a, on_b) = (anchor_a, there.position().as_vec3() + anchor_b);
/// assert!((on_b - on_a - manifold.normal * separation).length() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactPoint3 {
    /// Distance along the normal from A's point to B's, in metres: negative where they overlap.
    pub separation: f32,
    /// The point on A, in world axes, relative to A's position.
    pub anchor_a: Vec3,
    /// The point on B, in world axes, relative to B's position.
    pub anchor_b: Vec3,
    /// The feature of A and that of B which touch.
    pub feature: FeatureId,
}

/// The contact manifold of two convex shapes in the plane: one normal, and one or two points, in order of their feature
/// ids.
///
/// On a chain, the part is the first segment of the straight [run](asunder_geometry::Run) that is touched; of several
/// runs that share the normal, the lowest. A run counts as one straight segment, and `error` includes how far its
/// vertices may lie off that.
///
/// If a pair has several manifolds, each has the depth along its own normal. The least of their separations shows
/// whether the shapes overlap, but not how far they have to move to be free of each other.
///
/// ```
/// use asunder::{Manifold2, Pair2, Pose2, Rect, Shape2, glam::Vec2};
/// let block = Shape2::from(Rect::from_half_extents(Vec2::new(1.0, 0.5))?);
/// let (here, above) = (Pose2::IDENTITY, Pose2::at([0.0, 0.75])?);
/// let manifold: Manifold2 = Pair2::new(&block, &here, &block, &above).manifold(0.0).ok_or("they overlap")?;
/// assert_eq!((manifold.normal, manifold.points.len()), (Vec2::Y, 2));
/// assert!((manifold.separation + 0.25).abs() <= manifold.error);
/// assert!(manifold.points.is_sorted_by_key(|point| point.feature));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Manifold2 {
    /// Which part of A, for shapes made of several, and for ground; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several, and for ground; else 0.
    pub part_b: u32,
    /// Unit normal in world axes, from A to B.
    pub normal: Vec2,
    /// Separation of the two parts, in metres. The least separation of the points is within `error` of it, plus 2e-6 of
    /// the smaller bounding radius: the price of a reference edge that stays the same from frame to frame.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Where they touch. Never empty.
    pub points: ContactPoints<ContactPoint2, 2>,
}

/// The contact manifold of two convex shapes in space: one normal, and one to four points, in order of their feature
/// ids.
///
/// On ground, the part is the lowest triangle of the plane that is touched, or of those planes that share the normal.
///
/// ```
/// use asunder::{Cuboid, Manifold3, Pair3, Pose3, Shape3, glam::Vec3};
/// let block = Shape3::from(Cuboid::from_half_extents(Vec3::new(1.0, 0.5, 1.0))?);
/// let (here, above) = (Pose3::IDENTITY, Pose3::at([0.0, 0.75, 0.0])?);
/// let manifold: Manifold3 = Pair3::new(&block, &here, &block, &above).manifold(0.0).ok_or("they overlap")?;
/// assert_eq!((manifold.normal, manifold.points.len()), (Vec3::Y, 4));
/// assert!((manifold.separation + 0.25).abs() <= manifold.error);
/// assert!(manifold.points.is_sorted_by_key(|point| point.feature));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Manifold3 {
    /// Which part of A, for shapes made of several, and for ground; else 0.
    pub part_a: u32,
    /// Which part of B, for shapes made of several, and for ground; else 0.
    pub part_b: u32,
    /// Unit normal in world axes, from A to B.
    pub normal: Vec3,
    /// Separation of the two parts, in metres. The least separation of the points is within `error` of it, plus 2e-6 of
    /// the smaller bounding radius, with four exceptions:
    ///
    /// - The faces of a hull are flat up to 2e-7 or so of its own size. Beside a far smaller body that is much: the
    ///   points of a crate on a plate a hundred times as large may lie lower than this by some 8e-6 of the crate, and
    ///   show a depth where nothing overlaps.
    /// - If there are four points (possibly chosen from more), and on ground made of triangles, all points may lie
    ///   higher than that by up to 2^-15 of the smaller bounding diameter: the price of a choice that is stable from
    ///   frame to frame.
    /// - Where ground bends in steps too small for normals of their own, ground that stands up between the points
    ///   counts here but in no point: up to 2^-11 of the smaller bounding radius.
    /// - The depth of a needle-thin triangle along a direction that is rejected (outside the Voronoi region of the
    ///   feature that it comes from) counts here but in no point either.
    pub separation: f32,
    /// |true - reported| <= error, in metres.
    pub error: f32,
    /// Where they touch. Never empty.
    ///
    /// Of more than four corners, four are chosen: one counts as deepest, within 2^-15 of the smaller bounding
    /// diameter, and their area is at least 95 % of the largest that any four have, if those include such a corner too.
    /// The choice is the same from frame to frame for as long as the corners keep their features, barring a
    /// coincidence.
    ///
    /// A point between two faces gets its id from a vertex (else an edge) of each face within 2^-9 of the smaller
    /// bounding diameter of it; if there is none, from the feature on which it lies.
    pub points: ContactPoints<ContactPoint3, 4>,
}

/// What a probe of a pair within a limit finds; `N` is the type for the plane or for space.
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for one pair, and a frame allocates nothing"
)]
pub(crate) enum Probe<N> {
    /// Further apart than the limit: by at least this much.
    Beyond(f32, Hint),
    /// The separation, and all that is needed to make contact points.
    Near(N),
}
