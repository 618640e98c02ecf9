//! A body: where it is, how it moves, and how it yields to pushes.

use super::dimension::Dimension;
use asunder::glam::{DMat3, DQuat, DVec3};
use asunder::slotmap::KeyData;

/// How heavy a body is.
#[derive(Clone, Copy, Debug, Default)]
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

/// Who moves a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum State {
    /// Nobody, or whoever drives it.
    #[default]
    Fixed,
    /// Pushes.
    Awake,
    /// Nobody, until something wakes it.
    Asleep,
    /// It was taken out.
    Removed,
}

/// A body of a stepper.
#[derive(Clone, Debug, Default)]
pub struct Body {
    /// Of its key in the world.
    pub key: KeyData,
    /// Who moves it.
    pub state: State,
    /// How heavy it is.
    pub mass: Mass,
    /// Where its centre of mass is.
    pub center: DVec3,
    /// How it is turned, in f64: the poses' own f32 would drift over many small turns.
    pub turn: DQuat,
    /// Of the centre of mass, in m/s.
    pub velocity: DVec3,
    /// In rad/s.
    pub spin: DVec3,
    /// During this step, in metres.
    pub moved: DVec3,
    /// During this step, in radians.
    pub turned: DVec3,
    /// From the body's position to its centre of mass, in world axes.
    pub(super) offset: DVec3,
    /// Zero for what no push moves in this step, as the next.
    pub(super) inverse_mass: f64,
    /// In world axes.
    pub(super) inverse_inertia: DMat3,
}

impl Mass {
    /// Of what no push moves.
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

    /// Holds it where it is, whatever pushes it.
    pub(super) fn rest(&mut self) {
        [self.velocity, self.spin, self.moved, self.turned] = [DVec3::ZERO; 4];
        (self.inverse_mass, self.inverse_inertia) = (0.0, DMat3::ZERO);
    }

    /// Lets pushes move it for a step.
    pub(super) fn prepare(&mut self) {
        let axes = DMat3::from_quat(self.turn);
        self.inverse_inertia = axes * self.mass.inverse_inertia * axes.transpose();
        self.inverse_mass = self.mass.inverse;
        [self.moved, self.turned] = [DVec3::ZERO; 2];
    }

    /// Whether it goes anywhere by itself.
    pub(super) fn is_moving(&self) -> bool {
        self.velocity != DVec3::ZERO || self.spin != DVec3::ZERO
    }

    /// The square of a bound on the speed of its points.
    pub fn speed_squared(&self) -> f64 {
        self.velocity.length_squared() + self.spin.length_squared() * self.mass.reach * self.mass.reach
    }

    /// Its centre and rotation after a small motion.
    pub fn after(&self, moved: DVec3, turned: DVec3) -> (DVec3, DQuat) {
        let half = DQuat::from_vec4((turned * 0.5).extend(0.0));
        (self.center + moved, (self.turn + half * self.turn).normalize())
    }

    /// The pose with its centre of mass at a place; nothing where the numbers are no pose.
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

    /// How much speed along a direction a unit push along it gives the end of an arm.
    pub(super) fn yielding(&self, arm: DVec3, direction: DVec3) -> f64 {
        let spin = self.inverse_inertia * arm.cross(direction);
        self.inverse_mass + direction.dot(spin.cross(arm))
    }
}
