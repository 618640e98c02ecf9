//! What a game needs to know of a dimension, beyond what the stepper does.

use crate::recording::Numbers;
use crate::stepper::Dimension;
use asunder::glam::{DVec2, DVec3};
use asunder::{Impact2, Impact3, Motion2, Motion3, Plane, Pose2, Pose3, Volume};

/// A dimension in which the game can be played.
pub trait Playable: Dimension<Pose: Numbers> {
    /// The edge of the square or cube with a given mass.
    fn size(mass: f64) -> f64;
    /// The motion from one pose to another; `None` where they are too far apart.
    fn motion(from: &Self::Pose, to: &Self::Pose) -> Option<Self::Motion>;
    /// The share of the motion before the impact.
    fn fraction(impact: &Self::Impact) -> f64;
}

impl Playable for Plane {
    fn size(mass: f64) -> f64 {
        mass.sqrt()
    }

    fn motion(from: &Pose2, to: &Pose2) -> Option<Motion2> {
        Motion2::between(from, to).ok()
    }

    fn fraction(impact: &Impact2) -> f64 {
        impact.fraction
    }
}

impl Playable for Volume {
    fn size(mass: f64) -> f64 {
        libm::cbrt(mass)
    }

    fn motion(from: &Pose3, to: &Pose3) -> Option<Motion3> {
        Motion3::between(from, to).ok()
    }

    fn fraction(impact: &Impact3) -> f64 {
        impact.fraction
    }
}

/// A place, velocity or spin of a scene, as a vector in space, where the stepper works. The plane is space with z = 0.
///
/// ```
/// use asunder::glam::{DVec2, DVec3};
/// use asunder_examples::playable::InSpace;
/// assert_eq!(DVec2::new(1.0, 2.0).in_space(), DVec3::new(1.0, 2.0, 0.0));
/// assert_eq!((0.5.in_space(), DVec3::ONE.in_space()), (DVec3::Z * 0.5, DVec3::ONE), "a spin of the plane, a vector");
/// ```
pub trait InSpace: Copy {
    /// The same as a vector in space.
    fn in_space(self) -> DVec3;
}

impl InSpace for f64 {
    fn in_space(self) -> DVec3 {
        DVec3::Z * self
    }
}

impl InSpace for DVec2 {
    fn in_space(self) -> DVec3 {
        self.extend(0.0)
    }
}

impl InSpace for DVec3 {
    fn in_space(self) -> DVec3 {
        self
    }
}
