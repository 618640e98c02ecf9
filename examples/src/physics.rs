//! What a game needs of a dimension beyond what the engine gives: vectors, turning, mass.

use asunder::glam::{DVec2, DVec3};
use asunder::slotmap::Key;
use asunder::{Collider, Event, Space, World};
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
}

impl Linear for f64 {}
impl Linear for DVec2 {}
impl Linear for DVec3 {}

/// A dimension that the game can be played in.
pub trait Physics: Space {
    /// Places and velocities.
    type Vector: Linear;
    /// Angular velocities, in radians a second.
    type Spin: Linear;
    /// A rotation in f64: the poses' own f32 would drift over many small turns.
    type Turn: Copy;
    /// An inverse inertia about the centre of mass.
    type Inertia: Copy;
    /// How many numbers a position has, and how many a rotation.
    const NUMBERS: [usize; 2];
    /// Of what no torque turns.
    const IMMOVABLE: Self::Inertia;

    /// The inner product.
    fn dot(a: Self::Vector, b: Self::Vector) -> f64;
    /// The speed of a spin, squared.
    fn spin_square(spin: Self::Spin) -> f64;
    /// Whether a point lies in the box between two corners.
    fn is_within(point: Self::Vector, room: &(Self::Vector, Self::Vector)) -> bool;
    /// The spin that a push at the end of an arm gives.
    fn torque(arm: Self::Vector, push: Self::Vector) -> Self::Spin;
    /// The velocity that a spin gives the end of an arm.
    fn sweep(spin: Self::Spin, arm: Self::Vector) -> Self::Vector;
    /// The spin that a torque gives.
    fn respond(inertia: &Self::Inertia, torque: Self::Spin) -> Self::Spin;
    /// Twice the energy of a spin. What nothing turns has none.
    fn spin_energy(inertia: &Self::Inertia, spin: Self::Spin) -> f64;
    /// The inverse inertia of a turned body, in world axes.
    fn turned_inertia(inertia: &Self::Inertia, turn: Self::Turn) -> Self::Inertia;
    /// A rotation, turned on by a small one.
    fn turned_by(turn: Self::Turn, spin: Self::Spin) -> Self::Turn;
    /// What turns one rotation to another that is near.
    fn spin_between(from: Self::Turn, to: Self::Turn) -> Self::Spin;
    /// A vector of the body in world axes.
    fn turned(turn: Self::Turn, local: Self::Vector) -> Self::Vector;

    /// Nothing where the shape is too thin for its mass to be told from zero.
    fn mass(shape: &Self::Shape) -> Option<Mass<Self>>;
    /// How far a shape reaches from its own centre, in metres.
    fn reach(shape: &Self::Shape) -> f64;
    /// The place of a body's own origin, and its rotation.
    fn place(pose: &Self::Pose) -> (Self::Vector, Self::Turn);
    /// Nothing where the numbers are no pose: the body has left every level that there can be.
    fn pose(position: Self::Vector, turn: Self::Turn) -> Option<Self::Pose>;

    /// Adds a body.
    fn insert(world: &mut World<Self>, collider: Collider<Self>) -> Self::Key;
    /// Takes a body out.
    fn remove(world: &mut World<Self>, key: Self::Key);
    /// Moves a body.
    fn set_pose(world: &mut World<Self>, key: Self::Key, pose: Self::Pose);
    /// Says where a body will be when the next step is done.
    fn look_ahead(world: &mut World<Self>, key: Self::Key, to: &Self::Pose);
    /// Notes that a body is at rest.
    fn sleep(world: &mut World<Self>, key: Self::Key);
    /// Where a body is.
    fn pose_of(world: &World<Self>, key: Self::Key) -> Option<Self::Pose>;
    /// What the last update reported.
    fn events(world: &World<Self>) -> &[Event<Self::Key>];
    /// What solid things bullets run into: the bullet, the other, and the share of the motion until then.
    fn hits(world: &World<Self>) -> impl Iterator<Item = (Self::Key, Self::Key, f64)>;
    /// Whether two bodies have a contact by where they are, and not only by where they are going.
    fn is_near(world: &World<Self>, a: Self::Key, b: Self::Key) -> bool;
    /// Appends every point of the contacts that are wanted, in the world's order. Asked with both bodies, and whether
    /// the contact is only what motions may bring; the answer is the bodies' numbers.
    fn touches(
        world: &World<Self>,
        wanted: impl FnMut(Self::Key, Self::Key, bool) -> Option<[u32; 2]>,
        touches: &mut Vec<Touch<Self>>,
    );
    /// How many contacts there are by where bodies are, and how many of them share a point.
    fn count_contacts(world: &World<Self>) -> (u32, u32);
    /// The numbers of a pose, bit for bit: those of the position, then those of the rotation, which are f32.
    fn numbers(pose: &Self::Pose) -> impl Iterator<Item = f64>;
    /// The pose of such numbers; nothing where they are none.
    fn of_numbers(numbers: &[f64]) -> Option<Self::Pose>;
}

/// Mass at unit density, and how it is spread.
pub struct Mass<S: Physics> {
    /// In kilograms.
    pub mass: f64,
    /// The edge of the cube, or of the square, of that mass, in metres.
    pub size: f64,
    /// The centre of mass, in the body's axes.
    pub center: S::Vector,
    /// About the centre of mass.
    pub inverse_inertia: S::Inertia,
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
    /// Relative to the first body's position.
    pub anchor_a: S::Vector,
    /// Relative to the second body's position.
    pub anchor_b: S::Vector,
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
