//! What a game needs of a dimension beyond what the engine gives: vectors, turning, mass.

use crate::recording::Numbers;
use asunder::glam::{DVec2, DVec3};
use asunder::slotmap::Key;
use asunder::{Collider, Contact, Space};
use core::ops::{Add, AddAssign, Mul, Sub, SubAssign};

/// Vectors, and what bodies spin by: a number in the plane, a vector in space.
pub trait Linear:
    Copy
    + Default
    + PartialEq
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<f64, Output = Self>
    + AddAssign
    + SubAssign
{
    /// The inner product.
    fn dot(self, other: Self) -> f64;

    /// The root of the inner product with itself.
    #[inline]
    fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
}

impl Linear for f64 {
    #[inline]
    fn dot(self, other: Self) -> f64 {
        self * other
    }
}

impl Linear for DVec2 {
    #[inline]
    fn dot(self, other: Self) -> f64 {
        Self::dot(self, other)
    }
}

impl Linear for DVec3 {
    #[inline]
    fn dot(self, other: Self) -> f64 {
        Self::dot(self, other)
    }
}

/// A dimension that the game can be played in.
pub trait Physics: Space<Pose: Numbers> {
    /// Places and velocities.
    type Vector: Linear;
    /// Angular velocities, in radians a second.
    type Spin: Linear;
    /// A rotation in f64: the poses' own f32 would drift over many small turns.
    type Turn: Copy;
    /// An inverse inertia about the centre of mass: times a torque it is the spin that the torque gives.
    type Inertia: Copy + Mul<Self::Spin, Output = Self::Spin>;
    /// Of what no torque turns.
    const IMMOVABLE: Self::Inertia;

    /// Whether a point lies in the box between two corners.
    fn is_within(point: Self::Vector, room: &(Self::Vector, Self::Vector)) -> bool;
    /// What a push at the end of an arm turns with.
    fn torque(arm: Self::Vector, push: Self::Vector) -> Self::Spin;
    /// The velocity that a spin gives the end of an arm.
    fn sweep(spin: Self::Spin, arm: Self::Vector) -> Self::Vector;
    /// A vector of the body in world axes.
    fn turned(turn: Self::Turn, local: Self::Vector) -> Self::Vector;
    /// A rotation, turned on by a small one.
    fn turned_by(turn: Self::Turn, spin: Self::Spin) -> Self::Turn;
    /// What turns one rotation to another that is near.
    fn spin_between(from: Self::Turn, to: Self::Turn) -> Self::Spin;
    /// The inverse inertia of a turned body, in world axes.
    fn turned_inertia(inertia: &Self::Inertia, turn: Self::Turn) -> Self::Inertia;
    /// Twice the energy of a spin. What nothing turns has none.
    fn spin_energy(inertia: &Self::Inertia, spin: Self::Spin) -> f64;

    /// What a body weighs at unit density; nothing where it is too thin for its mass to be told from zero.
    fn matter(body: &Collider<Self>) -> Option<Matter<Self>>;
    /// Where a body is.
    fn pose_of(body: &Collider<Self>) -> &Self::Pose;
    /// The place of a body's own origin, and its rotation.
    fn place(pose: &Self::Pose) -> (Self::Vector, Self::Turn);
    /// Nothing where the numbers are no pose: the body has left every level that there can be.
    fn pose(position: Self::Vector, turn: Self::Turn) -> Option<Self::Pose>;
    /// What leads from one pose to another; nothing where they are too far apart.
    fn motion(from: &Self::Pose, to: &Self::Pose) -> Option<Self::Motion>;
    /// The share of a motion until something is hit.
    fn fraction(impact: &Self::Impact) -> f64;
    /// The points of a contact between the bodies of these numbers.
    fn touches(
        contact: Contact<'_, Self::Key, Self::Manifold>,
        bodies: [u32; 2],
    ) -> impl Iterator<Item = Touch<Self>>;
}

/// How heavy a body is.
pub struct Matter<S: Physics> {
    /// In 1/kg. Zero for what no push moves.
    pub inverse_mass: f64,
    /// About the centre of mass, in the body's axes.
    pub inverse_inertia: S::Inertia,
    /// The centre of mass, in the body's axes.
    pub center: S::Vector,
    /// The edge of the cube, or of the square, of its mass, in metres; infinite without one.
    pub size: f64,
    /// How far the shape reaches from its own centre, in metres.
    pub reach: f64,
}

impl<S: Physics> Matter<S> {
    /// Of scenery, which needs none and may be without an end.
    pub(crate) fn none() -> Self {
        let (center, size) = (S::Vector::default(), f64::INFINITY);
        Self { inverse_mass: 0.0, inverse_inertia: S::IMMOVABLE, center, size, reach: 0.0 }
    }
}

/// One point of a contact.
pub struct Touch<S: Physics> {
    /// What stays the same of it.
    pub id: TouchId<S::Key>,
    /// The numbers of both bodies in the game.
    pub bodies: [u32; 2],
    /// From the first body to the second.
    pub normal: S::Vector,
    /// In metres; negative in overlap.
    pub separation: f64,
    /// Relative to either body's position.
    pub anchors: [S::Vector; 2],
}

/// What stays the same of a contact point from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TouchId<K: Key> {
    /// Both bodies, in the world's order.
    pub keys: (K, K),
    /// Which parts of both.
    pub parts: (u32, u32),
    /// The bits of its feature id.
    pub feature: u64,
}
