//! A body: where it is, how it moves, and how it answers pushes.

use super::dimension::Dimension;
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::slotmap::KeyData;

/// The mass properties of a body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mass {
    /// In 1/kg; zero for a body that no push moves.
    pub inverse: f64,
    /// About the centre of mass, in the body's axes.
    pub inverse_inertia: DMat3,
    /// The centre of mass, in the body's axes.
    pub center: DVec3,
    /// How far the shape reaches from its own centre, in metres.
    pub reach: f64,
}

/// What moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// Nothing, or the caller who drives it.
    #[default]
    Fixed,
    /// Pushes and gravity.
    Awake,
    /// Nothing, until something wakes it.
    Asleep,
    /// It was taken out of the world.
    Removed,
}

/// A body of a stepper.
#[derive(Clone, Debug, Default)]
pub struct Body {
    /// The key in the world, without its type.
    pub key: KeyData,
    /// What moves it.
    pub state: State,
    /// Its mass properties.
    pub mass: Mass,
    /// Where its centre of mass is.
    pub center: DVec3,
    /// The rotation, in f64: in the f32 of poses it would drift over many small turns.
    pub turn: DQuat,
    /// The velocity of the centre of mass, in m/s.
    pub velocity: DVec3,
    /// The angular velocity, in rad/s.
    pub spin: DVec3,
    /// The motion of the centre of mass in this step, in metres.
    pub moved: DVec3,
    /// The rotation vector of this step, in radians.
    pub turned: DVec3,
    /// From the body's position to its centre of mass, in world axes.
    pub(super) offset: DVec3,
    /// Zero for a body that no push moves in this step; so is the inverse inertia.
    pub(super) inverse_mass: f64,
    /// In world axes.
    pub(super) inverse_inertia: DMat3,
}

impl Mass {
    /// That of a body that no push moves.
    pub const ENDLESS: Self =
        Self { inverse: 0.0, inverse_inertia: DMat3::ZERO, center: DVec3::ZERO, reach: 0.0 };
}

impl Body {
    /// A body at rest.
    pub(super) fn new(key: KeyData, state: State, mass: Mass, (position, turn): (DVec3, DQuat)) -> Self {
        let center = position + turn * mass.center;
        let (offset, inverse_inertia) = (center - position, DMat3::ZERO);
        Self { key, state, mass, center, turn, offset, inverse_inertia, ..Self::default() }
    }

    /// Stops it, so that no push moves it.
    pub(super) fn rest(&mut self) {
        [self.velocity, self.spin, self.moved, self.turned] = [DVec3::ZERO; 4];
        (self.inverse_mass, self.inverse_inertia) = (0.0, DMat3::ZERO);
    }

    /// Gets it ready to be moved by pushes in a step.
    pub(super) fn prepare(&mut self) {
        let axes = DMat3::from_quat(self.turn);
        self.inverse_inertia = axes * self.mass.inverse_inertia * axes.transpose();
        self.inverse_mass = self.mass.inverse;
        [self.moved, self.turned] = [DVec3::ZERO; 2];
    }

    /// Whether it has a velocity.
    pub(super) fn is_moving(&self) -> bool {
        self.velocity != DVec3::ZERO || self.spin != DVec3::ZERO
    }

    /// The square of an upper bound on the speed of its points.
    pub fn speed_squared(&self) -> f64 {
        self.velocity.length_squared() + self.spin.length_squared() * self.mass.reach * self.mass.reach
    }

    /// The centre of mass and rotation after a small motion.
    pub fn after(&self, moved: DVec3, turned: DVec3) -> (DVec3, DQuat) {
        let half = DQuat::from_vec4((turned * 0.5).extend(0.0));
        (self.center + moved, (self.turn + half * self.turn).normalize())
    }

    /// The pose with the given centre of mass and rotation; `None` where the numbers make no valid pose.
    pub fn pose<S: Dimension>(&self, (center, turn): (DVec3, DQuat)) -> Option<S::Pose> {
        S::pose(center - turn * self.mass.center, turn)
    }

    pub(super) fn push(&mut self, arm: DVec3, push: DVec3) {
        self.velocity += push * self.inverse_mass;
        self.spin += self.inverse_inertia * arm.cross(push);
    }

    pub(super) fn velocity_at(&self, arm: DVec3) -> DVec3 {
        self.velocity + self.spin.cross(arm)
    }

    /// The inverse effective mass at the end of an arm: the speed that a unit push along a direction gives it there.
    pub(super) fn yielding(&self, arm: DVec3, direction: DVec3) -> f64 {
        let spin = self.inverse_inertia * arm.cross(direction);
        self.inverse_mass + direction.dot(spin.cross(arm))
    }
}
