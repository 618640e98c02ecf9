//! Circles.

use crate::aabb::Aabb2;
use crate::outward::around2;
use crate::pose2::Pose2;
use crate::radius::{RadiusError, check_round};
use glam::DVec2;

/// A disc about its own origin, given by its radius in metres: a point expanded by the radius.
///
#[doc = include_str!("../doc/circle.svg")]
///
/// # Costs and limits
/// The cheapest shape: two circles take one square root, a circle and a half-plane one dot product. A contact is always
/// one point. Radius 1e-6 to 1e6 m.
///
/// ```
/// use asunder::{Circle, glam::DVec2};
/// let ball = Circle::new(0.5)?;
/// assert!(ball.contains(DVec2::X * 0.5) && !ball.contains(DVec2::ONE * 0.5));
/// # Ok::<(), asunder::RadiusError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    radius: f32,
}

impl Circle {
    /// A circle of radius zero, for queries about points; not for bodies.
    #[doc(hidden)]
    pub const POINT: Self = Self { radius: 0.0 };

    /// A circle from its radius, in metres.
    ///
    /// # Errors
    /// A radius that is not finite, or outside 1e-6 to 1e6 m.
    pub fn new(radius: f32) -> Result<Self, RadiusError> {
        check_round(radius, 0.0)?;
        Ok(Self { radius })
    }

    /// The radius, in metres.
    #[inline]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Whether the closed shape contains a local point, in metres.
    pub fn contains(&self, point: impl Into<DVec2>) -> bool {
        self.contains_within(point.into(), self.radius.into())
    }

    /// The same with another radius, in metres, about the same core.
    pub(crate) fn contains_within(&self, point: DVec2, radius: f64) -> bool {
        point.length_squared() <= radius * radius
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose2, margin: f32) -> Aabb2 {
        around2(core::iter::once(DVec2::ZERO), pose, f64::from(margin) + f64::from(self.radius))
    }
}
