//! Characters: shapes that a game moves itself, among solids that they must not enter.
//!
//! ```text
//! free        moves a shape out of the solids that it overlaps, by as little as possible
//! slide       free, then cast by cast: move, and turn the rest along obstacles; steps, and the ground below
//! clip        the vector nearest to a given one that goes into no plane
//! footing     what carries a character that stands on it
//! plane, volume   vectors and the narrow phase, for both dimensions; the methods of both worlds
//! ```
//! Only `free` ever moves a shape to a place to which no cast led, and only if the shape overlapped a solid before. All
//! other moves end on a path that a cast has certified as free: this is why no solid is tunnelled through and a free
//! shape stays free, even if the planes are wrong.
//!
//! The loop is that of Quake's `SV_FlyMove`, with these differences:
//! 1. The rest of the displacement keeps its original direction, and is turned along *all* planes met so far after
//!    each cast: first its level part along walls, then all of it along planes. If the result would lead back, the
//!    move ends. Turning the already turned vector again and again makes characters tremble in acute corners.
//! 2. For one convex body, the last plane replaces those before. Its distance has one gradient at a time, and old
//!    planes of a dome would throw off a character that climbs it.
//! 3. A gap is kept along the normal, by stopping short on the cast's own path. So the inner edges of tiles of one
//!    height are never met, and every position is on a cast's path.
//!
//! Pushing out is Hildreth's method (1957) on the planes of all nearby manifolds, as in the mover of Box2D v3.1: the
//! shortest way if these planes describe all of the solids nearby, and corrected within a few rounds if they do not.

mod clip;
mod footing;
mod free;
mod gait;
mod plane;
mod slide;
mod volume;

pub use footing::{Footing, Footing2, Footing3};

use crate::query::Asked;
use crate::space::{BodyKey2, BodyKey3};
use asunder_geometry::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder_geometry::{Pose2, Pose3};
use asunder_narrow::ArrayVec;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

/// How a character walks: which way is up, what it can stand on and climb. `N` is a vector of f32; use it as [`Walk2`]
/// or [`Walk3`].
///
/// Create one with `new` and change fields as your game requires.
/// - All lengths are in metres. A length that is NaN or below zero counts as zero, and one above 1e6 as 1e6.
/// - The skin is never less than 1/4096 of the shape's bounding radius, nor less than 2^-46 of its distance from the
///   origin.
///
/// ```
/// use asunder::{Capsule3, Shape3, Walk3, glam::Vec3};
/// let hero = Shape3::from(Capsule3::from_half_height(0.5, 0.4)?);
/// let walk = Walk3 { snap: 0.5, ..Walk3::new(&hero, Vec3::Y)? };
/// assert!(walk.up == Vec3::Y && walk.skin < 0.01 && walk.step > 0.3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Walk<N> {
    /// The upward direction, of any length. Zero for a character that has no ground, such as one that flies.
    pub up: N,
    /// The gap that is kept to all solids that are met. A solid that is merely passed, such as an edge or the side of a
    /// hollow, may be nearer at the end of a move; the next move begins by moving away from it, where there is room.
    /// Default: a hundredth of the shape's bounding radius.
    pub skin: f32,
    /// The least cosine between up and the normal of ground that can be walked on, 0 to 1: anything steeper is a wall.
    /// Default: 0.7, which is 45.6 degrees. A NaN counts as 0.7, and less than 1e-3 as 1e-3.
    pub steepest: f32,
    /// The highest step that is climbed, to within half a skin; 0 for none. Anything higher is a wall. Round feet of
    /// radius r are an exception: whatever the step, they walk over an edge up to (1 - `steepest`) r high, by default
    /// 0.3 r, since the normal at the edge is then no steeper than that of ground. Default: 0.35 of the shape's
    /// bounding radius, a third of a metre for an adult.
    pub step: f32,
    /// How far down a character follows the ground on which it stood, unless it moves up; 0 to switch that off. It stood
    /// if there is ground about a skin below where the move starts; only then it climbs steps, too. Default: the same
    /// as `step`.
    pub snap: f32,
}

/// How a character walks in the plane. See [`Walk`].
pub type Walk2 = Walk<Vec2>;

/// How a character walks in space. See [`Walk`].
pub type Walk3 = Walk<Vec3>;

/// A place that is free of solids, or as free as could be found. `O` is a pose and `P` a vector of f64; use it as
/// [`Freed2`] or [`Freed3`].
///
/// ```
/// use asunder::{Collider3, Filter3, Freed3, HalfSpace, Pose3, Shape3, Sphere, World3, glam::Vec3};
/// let mut world = World3::new();
/// world.insert(Collider3::new(HalfSpace::new(Vec3::Y)?).fixed());
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// let freed: Freed3 = world.depenetrate((&ball, &Pose3::at([0.0, 0.25, 0.0])?), &Filter3::new());
/// assert!(freed.is_free && freed.moved.x == 0.0 && freed.moved.z == 0.0);
/// assert!(freed.moved.y > 0.25 && freed.moved.y < 0.251 && freed.pose.position().y > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Freed<O, P> {
    /// Where the shape is now. Its rotation is kept.
    pub pose: O,
    /// The displacement by which it was moved there, in metres. Zero if it was free already.
    pub moved: P,
    /// Whether the shape overlaps no solid now; touching counts as overlapping. Exact. One-sided ground does not count
    /// while the shape is behind it.
    pub is_free: bool,
}

/// A place in the plane that is free of solids, or as free as could be found.
pub type Freed2 = Freed<Pose2, DVec2>;

/// A place in space that is free of solids, or as free as could be found.
pub type Freed3 = Freed<Pose3, DVec3>;

/// A body that a character stands on, or met. `K` is a key, `N` a vector of f32, `P` a point of f64; use it as
/// [`Obstacle2`] or [`Obstacle3`].
///
/// ```
/// use asunder::{Obstacle3, World3, glam::{DVec3, Vec3}};
/// /// What a wall takes of a velocity.
/// fn bumped(velocity: Vec3, met: &Obstacle3) -> Vec3 {
///     velocity - met.normal * velocity.dot(met.normal).min(0.0)
/// }
/// // Of a character that runs, only the fall: a slope that is too steep would turn the run into a climb (guide: characters).
/// let met = Obstacle3 { body: Default::default(), normal: Vec3::NEG_X, point: DVec3::X, part: 0 };
/// assert!(!World3::new().contains(met.body), "the null key is nobody's");
/// assert_eq!(bumped(Vec3::new(2.0, 0.0, 1.0), &met), Vec3::Z);
/// assert_eq!(bumped(Vec3::NEG_X, &met), Vec3::NEG_X, "away from it");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Obstacle<K, N, P> {
    /// The body.
    pub body: K,
    /// Unit normal in world axes, from the body to the character.
    pub normal: N,
    /// The point on the body where they would meet, in metres.
    pub point: P,
    /// Which part of the body: the part of a compound, the triangle of ground, the segment of a chain; else 0.
    pub part: u32,
}

/// A body that a character in the plane stands on, or met.
pub type Obstacle2 = Obstacle<BodyKey2, Vec2, DVec2>;

/// A body that a character in space stands on, or met.
pub type Obstacle3 = Obstacle<BodyKey3, Vec3, DVec3>;

/// The result of a character's move: how far it came, and what it met. `K` is a key, `O` a pose, `N` a vector of f32
/// and `P` one of f64; use it as [`Slide2`] or [`Slide3`].
///
/// ```
/// use asunder::{Collider3, Filter3, HalfSpace, Obstacle3, Pose3, Shape3, Slide3, Sphere, Walk3, World3, glam::Vec3};
/// let mut world = World3::new();
/// let floor = world.insert(Collider3::new(HalfSpace::new(Vec3::Y)?).fixed());
/// let wall = world.insert(Collider3::new(HalfSpace::new(Vec3::NEG_X)?).at(Pose3::at([3.0, 0.0, 0.0])?).fixed());
/// let ball = Shape3::from(Sphere::new(0.5)?);
/// let (walk, from) = (Walk3::new(&ball, Vec3::Y)?, Pose3::at([0.0, 0.6, 0.0])?);
/// let way = Vec3::new(5.0, -0.5, 1.0);
/// let slide: Slide3 = world.move_and_slide((&ball, &from), way, &walk, &Filter3::new());
/// assert!(slide.ground.is_some_and(|ground: Obstacle3| ground.body == floor && ground.normal.y > 0.99));
/// assert!(slide.walls.iter().all(|met| met.body == wall && met.point.x > 2.9) && !slide.walls.is_empty());
/// assert!(slide.is_free && slide.moved.x > 2.4 && slide.moved.x < 2.5, "up to the wall");
/// assert!(slide.moved.z > 0.9, "and along it: {}", slide.moved);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Slide<K, O, N, P> {
    /// Where the character is now. Its rotation is kept.
    pub pose: O,
    /// The displacement from its old to its new position, in metres.
    pub moved: P,
    /// The ground that it stands on at the end, if any: a surface that it can walk on, or the edge of a step. For a
    /// round foot beside an edge, the normal is that of the foot and may be nearly horizontal, the gap may be several
    /// skins, and the lowest point of the foot may be up to a step below the edge.
    pub ground: Option<Obstacle<K, N, P>>,
    /// The obstacles that it met and cannot stand on or climb (walls, ceilings and kerbs), at most eight. First come
    /// upright walls to which it was closer than its skin and into which it moves, then all others in the order in
    /// which it met them.
    ///
    /// If it did not cover the whole displacement, the reason is here or in `ground`, except for the following, which
    /// are not reported: to detect them, compare `moved` with the requested displacement.
    /// - ground that deflected a jump;
    /// - ground that broke a fall and was left again within the same displacement;
    /// - an obstacle that it would have entered by rounding (then it stays where it was free);
    /// - what squeezes it, where it could not be freed (then `is_free` is false, and it did not move).
    pub walls: ArrayVec<Obstacle<K, N, P>, 8>,
    /// Whether walls stopped all that was left of the displacement: it stands before a wall, or in a corner.
    pub blocked: bool,
    /// Whether it overlaps no solid now, apart from one-sided ground through which it came from behind. Exact. Always
    /// true if it overlapped none before.
    pub is_free: bool,
}

/// The result of the move of a character in the plane.
pub type Slide2 = Slide<BodyKey2, Pose2, Vec2, DVec2>;

/// The result of the move of a character in space.
pub type Slide3 = Slide<BodyKey3, Pose3, Vec3, DVec3>;

/// An f64 vector, as far as characters need it.
pub(crate) trait Linear:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Neg<Output = Self>
{
    const ZERO: Self;
    fn dot(self, other: Self) -> f64;
    /// An order of vectors, by x, then y, then z: arbitrary, but always the same.
    fn rank(self, other: Self) -> Ordering;

    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The unit vector; `None` for zero and for vectors that are not finite.
    fn unit(self) -> Option<Self> {
        let length = self.length();
        (length > 0.0 && length.is_finite()).then(|| self * (1.0 / length))
    }
}

/// A manifold as a plane that a shape must not cross.
pub(crate) struct Gap<P> {
    /// The separation in metres: below zero where they overlap, and zero where they touch.
    gap: f64,
    /// Unit normal that leads away from the body.
    away: P,
    /// The deepest point, on the body.
    point: P,
    /// Which part of the body.
    part: u32,
}

/// Whether a ray runs along a plane, up to rounding, by the dot product with the normal (`closing`) and the two lengths
/// that enter it.
pub(crate) fn is_along(closing: f64, lengths: [f64; 2]) -> bool {
    closing.abs() <= 64.0 * f64::EPSILON * lengths[0] * lengths[1]
}

/// A dimension to walk in.
pub(crate) trait Walks: Asked<Point: Linear> {
    fn wide(vector: Self::Vector) -> Self::Point;
    fn narrow(vector: Self::Point) -> Self::Vector;
    fn position(pose: &Self::Pose) -> Self::Point;
    /// A vector in world axes that turns with a body from one pose to another. The same bits if the rotation is kept.
    fn turned_since(from: &Self::Pose, to: &Self::Pose, vector: Self::Point) -> Self::Point;
    /// The moved pose; `None` if it would leave the world.
    fn moved(pose: &Self::Pose, by: Self::Point) -> Option<Self::Pose>;
    /// Unit directions all around, in an order that never changes.
    fn all_around(each: impl FnMut(Self::Point));
    /// The bounding radius of a shape.
    fn size(shape: &Self::Shape) -> f64;
    /// The centre of each convex part's bounding ball, which decides on which side of ground the part is.
    fn middles(at: (&Self::Shape, &Self::Pose), each: impl FnMut(Self::Point));
    /// How far the shape reaches along a direction, from its position.
    fn reach(at: (&Self::Shape, &Self::Pose), along: Self::Point) -> Option<f64>;
    /// The manifolds with a body that are within the margin, each as a plane.
    fn gaps(
        at: (&Self::Shape, &Self::Pose),
        body: &crate::collider::Collider<Self>,
        margin: f32,
        each: impl FnMut(Gap<Self::Point>),
    );
    /// Whether a body is solid from one side only.
    fn has_one_side(body: &crate::collider::Collider<Self>) -> bool;
    /// Where a ray that starts on ground first goes through some of it, within `limit` lengths: at the start, if the
    /// ground there is one-sided and the ray leads into it. From two-sided ground it may leave to either side.
    fn first_through(ray: &Self::Ray, limit: f64, body: &crate::collider::Collider<Self>) -> Option<f64>;
    /// A ray, if it is a valid one.
    fn ray(origin: Self::Point, direction: Self::Point) -> Option<Self::Ray>;
    /// The unit direction that lies in both planes, given by their normals; `None` where they are parallel, and in 2D,
    /// where two lines share a point at most.
    fn crease(one: Self::Point, other: Self::Point) -> Option<Self::Point>;
}
