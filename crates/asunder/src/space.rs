//! The differences between the plane and space: types, `bounds` and `collide`. Everything else is written once.

use crate::collider::Collider;
use crate::copy::copy;
use crate::frame::advance;
use crate::hooks::Hooks;
use crate::world::World;
use asunder_geometry::{Aabb2, Aabb3, Bounds, Motion2, Motion3, Pose2, Pose3, Shape2, Shape3};
use asunder_narrow::{
    Answer, Batch, Batch2, Batch3, Hint, Impact2, Impact3, Job2, Job3, Manifold2, Manifold3, Pair2, Pair3,
    Persistent2, Persistent3, Spare3, Touch2, Touch3, collide2, collide3,
};
use core::fmt::Debug;

slotmap::new_key_type! {
    /// The key of a body of a [`World2`](crate::World2). It stays valid until the body is removed, and never refers to
    /// another one.
    ///
    /// It cannot be used with a [`World3`](crate::World3):
    ///
    /// ```compile_fail,E0308
    /// use asunder::{BodyKey2, World3};
    /// fn take(world: &mut World3, key: BodyKey2) {
    ///     world.remove(key);
    /// }
    /// ```
    pub struct BodyKey2;

    /// The key of a body of a [`World3`](crate::World3). It stays valid until the body is removed, and never refers to
    /// another one.
    ///
    /// ```
    /// use asunder::{BodyKey3, Collider3, Sphere, World3, slotmap::SecondaryMap};
    /// let mut world = World3::new();
    /// let ball = Collider3::new(Sphere::new(1.0)?);
    /// let gone = world.insert(ball.clone());
    /// world.remove(gone);
    /// let there: BodyKey3 = world.insert(ball);
    /// assert!(world.contains(there) && !world.contains(gone) && there != gone, "though it has the same slot");
    /// let mut names = SecondaryMap::new();
    /// names.insert(there, "ball");
    /// assert_eq!((names.get(there), names.get(gone)), (Some(&"ball"), None));
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    pub struct BodyKey3;
}

/// The bodies that a moving body may run into.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum RunsInto<'f, S: Space> {
    /// Either is a sensor.
    Sensor,
    /// Something solid, while the body has these touches.
    Solid(&'f [S::Touch]),
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Plane {}
    impl Sealed for super::Volume {}
}

/// The plane: the type parameter that makes a [`World`](crate::World) a [`World2`](crate::World2).
///
/// ```
/// use asunder::{Plane, Volume, World, World2, World3};
/// let (flat, solid): (World2, World3) = (World::<Plane>::new(), World::<Volume>::new());
/// assert!(flat.is_empty() && solid.is_empty());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {}

/// Space: the type parameter that makes a [`World`](crate::World) a [`World3`](crate::World3).
///
/// ```
/// use asunder::{Collider, Space, Sphere, Volume, World};
/// /// Worlds of either dimension are counted alike.
/// fn count<S: Space>(worlds: &[World<S>]) -> usize {
///     worlds.iter().map(World::len).sum()
/// }
/// /// A world to come back to, whatever its dimension.
/// fn keep<S: Space>(world: &World<S>) -> World<S> {
///     world.clone()
/// }
/// let mut world = World::<Volume>::new();
/// world.insert(Collider::<Volume>::new(Sphere::new(1.0)?));
/// assert_eq!(count(&[keep(&world), world]), 2);
/// # Ok::<(), asunder::RadiusError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Volume {}

/// A dimension. Sealed: [`Plane`] and [`Volume`] are its only implementations.
pub trait Space: sealed::Sealed + Copy + Debug + Eq + 'static {
    /// Key of a body.
    type Key: slotmap::Key + Debug + Send + Sync;
    /// The pose of a body.
    type Pose: Copy + Default + PartialEq + Debug + Send + Sync;
    /// The shape of a body.
    type Shape: Clone + PartialEq + Debug + Send + Sync;
    /// The box of the broad phase.
    type Aabb: Bounds;
    /// A contact manifold of two convex parts.
    type Manifold: Clone + PartialEq + Debug + Send + Sync;
    /// A manifold that is moved along while its bodies hardly drift.
    #[doc(hidden)]
    type Persistent: Clone + PartialEq + Debug + Send + Sync;
    /// Memory of persistent manifolds that are no longer kept.
    #[doc(hidden)]
    type Spare: Clone + Default + Debug + Send + Sync;
    /// The motion of a body within a frame.
    type Motion: Copy + PartialEq + Debug + Send + Sync;
    /// The result of a time-of-impact query: when two bodies first touch.
    type Impact: Copy + PartialEq + Debug + Send + Sync;
    /// A touch of a body with one other than the second body of a pair.
    #[doc(hidden)]
    type Touch: Copy + Debug + Send + Sync;
    /// One pair for the narrow phase.
    #[doc(hidden)]
    type Job<'a>: Send + Sync;

    /// Runs one frame. Its definitions are not generic, so it is compiled with this crate and its optimisation:
    /// otherwise a game that calls [`World::update`] would compile all of it again, and in a debug build run it
    /// unoptimised.
    #[doc(hidden)]
    fn advance(world: &mut World<Self>, hooks: &Hooks<'_, Self>);

    /// Makes one world equal to another; not generic for the same reason.
    #[doc(hidden)]
    fn copy(from: &World<Self>, to: &mut World<Self>);

    /// Whether two poses are equal in every bit.
    #[doc(hidden)]
    fn same_bits(one: &Self::Pose, other: &Self::Pose) -> bool;

    /// The box around a posed shape, grown by a margin, rounded outwards.
    #[doc(hidden)]
    fn bounds(shape: &Self::Shape, pose: &Self::Pose, margin: f32) -> Self::Aabb;

    /// A box that holds a posed shape, at a constant cost for compounds.
    #[doc(hidden)]
    fn bounds_at_once(shape: &Self::Shape, pose: &Self::Pose) -> Self::Aabb;

    /// The least box around both.
    #[doc(hidden)]
    fn union(one: &Self::Aabb, other: &Self::Aabb) -> Self::Aabb;

    /// How far a shape reaches from its body's position, in metres, whichever way it is turned; may be infinite.
    #[doc(hidden)]
    fn arm(shape: &Self::Shape) -> f64;

    /// Where a motion from a pose ends.
    #[doc(hidden)]
    fn end(motion: &Self::Motion, from: &Self::Pose) -> Self::Pose;

    /// A bound on the angular speed of a motion from a pose, in radians for all of it.
    #[doc(hidden)]
    fn turn_speed(motion: &Self::Motion, from: &Self::Pose) -> f64;

    /// How far the points of a shape go at most from one pose to another, in metres.
    #[doc(hidden)]
    fn travel(shape: &Self::Shape, from: &Self::Pose, to: &Self::Pose) -> f64;

    /// How far two motions move two positions against each other, in metres.
    #[doc(hidden)]
    fn drift(motions: [Option<Self::Motion>; 2]) -> f64;

    /// When two bodies first touch in their motions somewhere they do not touch at the start, and the fraction of the
    /// motions until then. Where either is a sensor and they overlap already, there is no impact with other parts. If
    /// both are solid, the first passes over parts that are flush with those that it touches.
    #[doc(hidden)]
    fn impact(
        of: [(&Self::Shape, &Self::Pose); 2],
        runs_into: RunsInto<'_, Self>,
        motions: [Option<Self::Motion>; 2],
    ) -> Option<(f64, Self::Impact)>;

    /// A contact's manifold as a touch of one of the two bodies.
    #[doc(hidden)]
    fn touch(manifold: &Self::Manifold, is_a: bool) -> Self::Touch;

    /// Whether a shape is ground, which is always fixed.
    #[doc(hidden)]
    fn is_ground(shape: &Self::Shape) -> bool;

    /// The least separation of manifolds.
    #[doc(hidden)]
    fn least_separation(manifolds: &[Self::Manifold]) -> f32;

    /// A job from two bodies; the margin includes what is `ahead`: by how much their motions may bring them nearer.
    #[doc(hidden)]
    fn job<'a>(bodies: [&'a Collider<Self>; 2], margin_and_ahead: [f32; 2], hint: Hint) -> Self::Job<'a>;

    /// Appends the answers to a slice of jobs.
    #[doc(hidden)]
    fn collide(jobs: &[Self::Job<'_>], batch: &mut Batch<Self::Manifold>);

    /// The persistent manifold of an answer, if it pays for bodies that moved by `step` metres in the last frame.
    #[doc(hidden)]
    fn persistent(
        job: &Self::Job<'_>,
        answer: &Answer,
        manifolds: &[Self::Manifold],
        step: f64,
        spare: &mut Self::Spare,
    ) -> Option<Self::Persistent>;

    /// Whether a store has no memory to lend.
    #[doc(hidden)]
    fn has_no_memory(spare: &Self::Spare) -> bool;

    /// Hands memory over from one store to another that has none.
    #[doc(hidden)]
    fn lend(from: &mut Self::Spare, to: &mut Self::Spare);

    /// Takes the memory of a persistent manifold that is no longer kept.
    #[doc(hidden)]
    fn reclaim(spare: &mut Self::Spare, kept: &mut Self::Persistent);

    /// Appends a persistent manifold's manifolds, moved along; `None` if they have to be recomputed, since bodies
    /// drifted, margins changed, or one has become a sensor.
    #[doc(hidden)]
    fn carry_on(
        persistent: &Self::Persistent,
        bodies: [&Collider<Self>; 2],
        margin: f32,
        to: &mut Vec<Self::Manifold>,
    ) -> Option<bool>;
}

impl Space for Plane {
    type Key = BodyKey2;
    type Pose = Pose2;
    type Shape = Shape2;
    type Aabb = Aabb2;
    type Manifold = Manifold2;
    type Persistent = Persistent2;
    type Spare = ();
    type Motion = Motion2;
    type Impact = Impact2;
    type Touch = Touch2;
    type Job<'a> = Job2<'a>;

    fn advance(world: &mut World<Self>, hooks: &Hooks<'_, Self>) {
        advance(world, hooks);
    }

    fn copy(from: &World<Self>, to: &mut World<Self>) {
        copy(from, to);
    }

    fn same_bits(one: &Pose2, other: &Pose2) -> bool {
        one.same_bits(other)
    }

    fn bounds(shape: &Shape2, pose: &Pose2, margin: f32) -> Aabb2 {
        shape.bounds(pose, margin)
    }

    fn bounds_at_once(shape: &Shape2, pose: &Pose2) -> Aabb2 {
        match shape {
            Shape2::Compound(compound) => compound.bounds_at_once(pose),
            _ => shape.bounds(pose, 0.0),
        }
    }

    fn union(one: &Aabb2, other: &Aabb2) -> Aabb2 {
        one.union(other)
    }

    fn arm(shape: &Shape2) -> f64 {
        shape.center().as_dvec2().length() + f64::from(shape.outer_radius())
    }

    fn end(motion: &Motion2, from: &Pose2) -> Pose2 {
        motion.pose_at(from, 1.0)
    }

    fn turn_speed(motion: &Motion2, from: &Pose2) -> f64 {
        motion.turn_speed(from)
    }

    fn travel(shape: &Shape2, from: &Pose2, to: &Pose2) -> f64 {
        from.travel(to, Self::arm(shape))
    }

    fn drift(motions: [Option<Motion2>; 2]) -> f64 {
        let [a, b] = motions.map(|motion| motion.unwrap_or(Motion2::STILL).displacement());
        (a - b).length()
    }

    fn impact(
        [(shape_a, pose_a), (shape_b, pose_b)]: [(&Shape2, &Pose2); 2],
        runs_into: RunsInto<'_, Self>,
        motions: [Option<Motion2>; 2],
    ) -> Option<(f64, Impact2)> {
        let [of_a, of_b] = motions.map(|motion| motion.unwrap_or(Motion2::STILL));
        let pair = Pair2::new(shape_a, pose_a, shape_b, pose_b);
        let impact = match runs_into {
            RunsInto::Sensor => pair.impact(&of_a, &of_b).filter(|impact| !impact.overlapping),
            RunsInto::Solid(touches) => pair.next_impact_beside(touches, &of_a, &of_b),
        };
        impact.map(|impact| (impact.fraction, impact))
    }

    fn touch(manifold: &Manifold2, is_a: bool) -> Touch2 {
        Touch2::of(manifold, is_a)
    }

    fn is_ground(shape: &Shape2) -> bool {
        shape.is_ground()
    }

    fn least_separation(manifolds: &[Manifold2]) -> f32 {
        manifolds.iter().fold(f32::INFINITY, |least, manifold| least.min(manifold.separation))
    }

    fn job<'a>([a, b]: [&'a Collider<Self>; 2], [margin, ahead]: [f32; 2], hint: Hint) -> Job2<'a> {
        Job2 {
            shape_a: &a.shape,
            pose_a: &a.pose,
            shape_b: &b.shape,
            pose_b: &b.pose,
            margin,
            hint,
            ahead,
            sensor: a.sensor || b.sensor,
        }
    }

    fn collide(jobs: &[Job2<'_>], batch: &mut Batch2) {
        collide2(jobs, batch);
    }

    fn persistent(
        job: &Job2<'_>,
        answer: &Answer,
        manifolds: &[Manifold2],
        step: f64,
        (): &mut (),
    ) -> Option<Persistent2> {
        Persistent2::lasting(job, answer, manifolds, step)
    }

    fn has_no_memory((): &()) -> bool {
        false
    }

    fn lend((): &mut (), (): &mut ()) {}

    fn reclaim((): &mut (), _: &mut Persistent2) {}

    fn carry_on(
        persistent: &Persistent2,
        [a, b]: [&Collider<Self>; 2],
        margin: f32,
        to: &mut Vec<Manifold2>,
    ) -> Option<bool> {
        let is_same = persistent.margin().to_bits() == margin.to_bits() && !a.sensor && !b.sensor;
        (is_same && persistent.carry_on([&a.pose, &b.pose], to)).then_some(persistent.overlapping())
    }
}

impl Space for Volume {
    type Key = BodyKey3;
    type Pose = Pose3;
    type Shape = Shape3;
    type Aabb = Aabb3;
    type Manifold = Manifold3;
    type Persistent = Persistent3;
    type Spare = Spare3;
    type Motion = Motion3;
    type Impact = Impact3;
    type Touch = Touch3;
    type Job<'a> = Job3<'a>;

    fn advance(world: &mut World<Self>, hooks: &Hooks<'_, Self>) {
        advance(world, hooks);
    }

    fn copy(from: &World<Self>, to: &mut World<Self>) {
        copy(from, to);
    }

    fn same_bits(one: &Pose3, other: &Pose3) -> bool {
        one.same_bits(other)
    }

    fn bounds(shape: &Shape3, pose: &Pose3, margin: f32) -> Aabb3 {
        shape.bounds(pose, margin)
    }

    fn bounds_at_once(shape: &Shape3, pose: &Pose3) -> Aabb3 {
        match shape {
            Shape3::Compound(compound) => compound.bounds_at_once(pose),
            _ => shape.bounds(pose, 0.0),
        }
    }

    fn union(one: &Aabb3, other: &Aabb3) -> Aabb3 {
        one.union(other)
    }

    fn arm(shape: &Shape3) -> f64 {
        shape.center().as_dvec3().length() + f64::from(shape.outer_radius())
    }

    fn end(motion: &Motion3, from: &Pose3) -> Pose3 {
        motion.pose_at(from, 1.0)
    }

    fn turn_speed(motion: &Motion3, from: &Pose3) -> f64 {
        motion.turn_speed(from)
    }

    fn travel(shape: &Shape3, from: &Pose3, to: &Pose3) -> f64 {
        from.travel(to, Self::arm(shape))
    }

    fn drift(motions: [Option<Motion3>; 2]) -> f64 {
        let [a, b] = motions.map(|motion| motion.unwrap_or(Motion3::STILL).displacement());
        (a - b).length()
    }

    fn impact(
        [(shape_a, pose_a), (shape_b, pose_b)]: [(&Shape3, &Pose3); 2],
        runs_into: RunsInto<'_, Self>,
        motions: [Option<Motion3>; 2],
    ) -> Option<(f64, Impact3)> {
        let [of_a, of_b] = motions.map(|motion| motion.unwrap_or(Motion3::STILL));
        let pair = Pair3::new(shape_a, pose_a, shape_b, pose_b);
        let impact = match runs_into {
            RunsInto::Sensor => pair.impact(&of_a, &of_b).filter(|impact| !impact.overlapping),
            RunsInto::Solid(touches) => pair.next_impact_beside(touches, &of_a, &of_b),
        };
        impact.map(|impact| (impact.fraction, impact))
    }

    fn touch(manifold: &Manifold3, is_a: bool) -> Touch3 {
        Touch3::of(manifold, is_a)
    }

    fn is_ground(shape: &Shape3) -> bool {
        shape.is_ground()
    }

    fn least_separation(manifolds: &[Manifold3]) -> f32 {
        manifolds.iter().fold(f32::INFINITY, |least, manifold| least.min(manifold.separation))
    }

    fn job<'a>([a, b]: [&'a Collider<Self>; 2], [margin, ahead]: [f32; 2], hint: Hint) -> Job3<'a> {
        Job3 {
            shape_a: &a.shape,
            pose_a: &a.pose,
            shape_b: &b.shape,
            pose_b: &b.pose,
            margin,
            hint,
            ahead,
            sensor: a.sensor || b.sensor,
        }
    }

    fn collide(jobs: &[Job3<'_>], batch: &mut Batch3) {
        collide3(jobs, batch);
    }

    fn persistent(
        job: &Job3<'_>,
        answer: &Answer,
        manifolds: &[Manifold3],
        step: f64,
        spare: &mut Spare3,
    ) -> Option<Persistent3> {
        Persistent3::lasting(job, answer, manifolds, step, spare)
    }

    fn has_no_memory(spare: &Spare3) -> bool {
        spare.is_empty()
    }

    fn lend(from: &mut Spare3, to: &mut Spare3) {
        from.lend(to);
    }

    fn reclaim(spare: &mut Spare3, kept: &mut Persistent3) {
        spare.take(kept);
    }

    fn carry_on(
        persistent: &Persistent3,
        [a, b]: [&Collider<Self>; 2],
        margin: f32,
        to: &mut Vec<Manifold3>,
    ) -> Option<bool> {
        let is_same = persistent.margin().to_bits() == margin.to_bits() && !a.sensor && !b.sensor;
        (is_same && persistent.carry_on([&a.pose, &b.pose], to)).then_some(persistent.overlapping())
    }
}
