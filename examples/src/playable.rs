//! What a game needs of a dimension beyond what the stepper does.

use crate::recording::Numbers;
use crate::stepper::Dimension;
use asunder::glam::{DVec2, DVec3};
use asunder::{Impact2, Impact3, Motion2, Motion3, Plane, Pose2, Pose3, Volume};

/// A dimension that the game can be played in.
pub trait Playable: Dimension<Pose: Numbers> {
    /// The edge of the square, or of the cube, of a mass.
    fn size(mass: f64) -> f64;
    /// What leads from one pose to another; nothing where they are too far apart.
    fn motion(from: &Self::Pose, to: &Self::Pose) -> Option<Self::Motion>;
    /// The share of a motion until something is hit.
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

/// A place, a velocity or a spin of a scene as one of space, where the stepper is: the plane is space without height.
///
/// ```
/// use asunder::glam::{DVec2, DVec3};
/// use asunder_examples::playable::InSpace;
/// assert_eq!(DVec2::new(1.0, 2.0).in_space(), DVec3::new(1.0, 2.0, 0.0));
/// assert_eq!((0.5.in_space(), DVec3::ONE.in_space()), (DVec3::Z * 0.5, DVec3::ONE), "a spin of the plane, a vector");
/// ```
pub trait InSpace: Copy {
    /// The same in space.
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
