//! Spheres.

use crate::aabb::Aabb3;
use crate::outward::around;
use crate::pose3::Pose3;
use crate::radius::{RadiusError, check_round};
use glam::DVec3;

/// A ball about its own origin, given by its radius in metres: a point expanded by the radius.
///
#[doc = include_str!("../doc/sphere.svg")]
///
/// # Costs and limits
/// The cheapest shape: two spheres take one square root, a sphere and a half-space one dot product. A contact is always
/// one point. Radius 1e-6 to 1e6 m.
///
/// ```
/// use asunder::{Sphere, glam::DVec3};
/// let ball = Sphere::new(0.5)?;
/// assert!(ball.contains(DVec3::X * 0.5) && !ball.contains(DVec3::ONE * 0.5));
/// # Ok::<(), asunder::RadiusError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    radius: f32,
}

impl Sphere {
    /// A sphere of radius zero, for queries about points. Do not use it for a body: snapshots reject spheres without a
    /// radius. Use a hull of one point instead ([`Hull::of_any_dimension`](crate::Hull::of_any_dimension)).
    ///
    /// ```
    /// use asunder::{Sphere, glam::DVec3};
    /// assert!(Sphere::POINT.contains(DVec3::ZERO) && !Sphere::POINT.contains(DVec3::X * 1e-100));
    /// ```
    pub const POINT: Self = Self { radius: 0.0 };

    /// A sphere from its radius, in metres.
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
    pub fn contains(&self, point: impl Into<DVec3>) -> bool {
        point.into().length_squared() <= f64::from(self.radius) * f64::from(self.radius)
    }

    /// The box around the posed shape, grown by `margin` metres and rounded outwards.
    pub fn bounds(&self, pose: &Pose3, margin: f32) -> Aabb3 {
        // Needs no axes, as no rotation moves the centre.
        around(DVec3::ZERO, DVec3::ZERO, pose, f64::from(margin) + f64::from(self.radius))
    }
}
