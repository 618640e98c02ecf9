//! What the stepper must know of a dimension.
//!
//! It steps in space. The plane is space without height: places, speeds and pushes keep their third coordinate at zero,
//! and bodies turn about the third axis alone, since nothing else in their inverse inertia is above zero.

use super::solver::Point;
use asunder::glam::{DMat3, DVec3};
use asunder::{Collider, Space};

/// A dimension that bodies can be stepped in.
pub trait Dimension: Space {
    /// A rotation in f64: the poses' own f32 would drift over many small turns.
    type Turn: Copy;

    /// What a body weighs at unit density; nothing where it is too thin for its mass to be told from zero.
    fn mass(body: &Collider<Self>) -> Option<Mass>;
    /// Where a body is.
    fn pose_of(body: &Collider<Self>) -> &Self::Pose;
    /// The place of a body's own origin, and its rotation.
    fn place(pose: &Self::Pose) -> (DVec3, Self::Turn);
    /// Nothing where the numbers are no pose.
    fn pose(position: DVec3, turn: Self::Turn) -> Option<Self::Pose>;
    /// A vector of the body in world axes.
    fn turned(turn: Self::Turn, local: DVec3) -> DVec3;
    /// A rotation, turned on by a small one.
    fn turned_by(turn: Self::Turn, spin: DVec3) -> Self::Turn;
    /// The inverse inertia of a turned body, in world axes.
    fn turned_inertia(inertia: DMat3, turn: Self::Turn) -> DMat3;
    /// The points of a manifold, with arms from where the bodies are; of which bodies, the caller knows.
    fn points(manifold: &Self::Manifold) -> impl Iterator<Item = Point>;
}

/// How heavy a body is.
#[derive(Clone, Copy, Debug)]
pub struct Mass {
    /// In 1/kg. Zero for what no push moves.
    pub inverse: f64,
    /// About the centre of mass, in the body's axes.
    pub inverse_inertia: DMat3,
    /// The centre of mass, in the body's axes.
    pub center: DVec3,
    /// How far the shape reaches from its own centre, in metres.
    pub reach: f64,
}

impl Mass {
    /// Of what no push moves.
    pub const ENDLESS: Self =
        Self { inverse: 0.0, inverse_inertia: DMat3::ZERO, center: DVec3::ZERO, reach: 0.0 };
}
