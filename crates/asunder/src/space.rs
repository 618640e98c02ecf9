//! What differs between the plane and space: types, `bounds` and `collide`. All else is written once.

use crate::collider::Collider;
use asunder_geometry::{Aabb2, Aabb3, Bounds, Pose2, Pose3, Shape2, Shape3};
use asunder_narrow::{Batch, Batch2, Batch3, Hint, Job2, Job3, Manifold2, Manifold3, collide2, collide3};
use core::fmt::Debug;

slotmap::new_key_type! {
    /// A body of a [`World2`](crate::World2). Stays valid until the body is removed, and never means another one.
    pub struct BodyKey2;

    /// A body of a [`World3`](crate::World3). Stays valid until the body is removed, and never means another one.
    pub struct BodyKey3;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Plane {}
    impl Sealed for super::Volume {}
}

/// The plane: what makes a [`World`](crate::World) a [`World2`](crate::World2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {}

/// Space: what makes a [`World`](crate::World) a [`World3`](crate::World3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Volume {}

/// A dimension. Sealed: [`Plane`] and [`Volume`] are all there is.
pub trait Space: sealed::Sealed + Sized + 'static {
    /// Key of a body.
    type Key: slotmap::Key + Debug + Send + Sync;
    /// Where a body is.
    type Pose: Copy + Default + PartialEq + Debug + Send + Sync;
    /// What a body is.
    type Shape: Clone + PartialEq + Debug + Send + Sync;
    /// The box of the broad phase.
    type Aabb: Bounds;
    /// How two convex parts touch.
    type Manifold: Clone + PartialEq + Debug + Send + Sync;
    /// One pair for the narrow phase.
    #[doc(hidden)]
    type Job<'a>: Send + Sync;

    /// Whether two poses are equal in every bit.
    #[doc(hidden)]
    fn same_bits(one: &Self::Pose, other: &Self::Pose) -> bool;

    /// The box around a posed shape, grown by a margin, rounded outwards.
    #[doc(hidden)]
    fn bounds(shape: &Self::Shape, pose: &Self::Pose, margin: f32) -> Self::Aabb;

    /// A job from two bodies; `margin` is the sum of theirs.
    #[doc(hidden)]
    fn job<'a>(a: &'a Collider<Self>, b: &'a Collider<Self>, margin: f32, hint: Hint) -> Self::Job<'a>;

    /// Appends the answers to a slice of jobs.
    #[doc(hidden)]
    fn collide(jobs: &[Self::Job<'_>], batch: &mut Batch<Self::Manifold>);
}

impl Space for Plane {
    type Key = BodyKey2;
    type Pose = Pose2;
    type Shape = Shape2;
    type Aabb = Aabb2;
    type Manifold = Manifold2;
    type Job<'a> = Job2<'a>;

    fn same_bits(one: &Pose2, other: &Pose2) -> bool {
        one.same_bits(other)
    }

    fn bounds(shape: &Shape2, pose: &Pose2, margin: f32) -> Aabb2 {
        shape.bounds(pose, margin)
    }

    fn job<'a>(a: &'a Collider<Self>, b: &'a Collider<Self>, margin: f32, hint: Hint) -> Job2<'a> {
        Job2 {
            shape_a: &a.shape,
            pose_a: &a.pose,
            shape_b: &b.shape,
            pose_b: &b.pose,
            margin,
            hint,
            sensor: a.sensor || b.sensor,
        }
    }

    fn collide(jobs: &[Job2<'_>], batch: &mut Batch2) {
        collide2(jobs, batch);
    }
}

impl Space for Volume {
    type Key = BodyKey3;
    type Pose = Pose3;
    type Shape = Shape3;
    type Aabb = Aabb3;
    type Manifold = Manifold3;
    type Job<'a> = Job3<'a>;

    fn same_bits(one: &Pose3, other: &Pose3) -> bool {
        one.same_bits(other)
    }

    fn bounds(shape: &Shape3, pose: &Pose3, margin: f32) -> Aabb3 {
        shape.bounds(pose, margin)
    }

    fn job<'a>(a: &'a Collider<Self>, b: &'a Collider<Self>, margin: f32, hint: Hint) -> Job3<'a> {
        Job3 {
            shape_a: &a.shape,
            pose_a: &a.pose,
            shape_b: &b.shape,
            pose_b: &b.pose,
            margin,
            hint,
            sensor: a.sensor || b.sensor,
        }
    }

    fn collide(jobs: &[Job3<'_>], batch: &mut Batch3) {
        collide3(jobs, batch);
    }
}
