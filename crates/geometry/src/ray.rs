//! Rays.

use crate::direction::{DirectionError, check_direction};
use crate::pose3::{PoseError, check_position};
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A ray in the plane: an origin, and a direction of any length but zero. The point at parameter t is origin + t
/// direction.
///
/// ```
/// use asunder::{DirectionError, Ray2, RayError, glam::{DVec2, Vec2}};
/// let ray = Ray2::new(DVec2::X, Vec2::Y * 2.0)?;
/// assert_eq!(ray.at(0.5), DVec2::X + DVec2::Y);
/// assert_eq!(Ray2::new(DVec2::X, Vec2::ZERO), Err(RayError::Direction(DirectionError::Zero)));
/// # Ok::<(), RayError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray2 {
    origin: DVec2,
    direction: Vec2,
}

impl Ray2 {
    /// A ray from its origin, in metres (`Vec2`, `DVec2`, or an array of f64), and its direction.
    ///
    /// # Errors
    /// Numbers that are not finite, an origin beyond 1e9 m on an axis, and a zero direction.
    pub fn new(origin: impl Into<DVec2>, direction: Vec2) -> Result<Self, RayError> {
        let origin = origin.into();
        check_position(&origin.to_array()).map_err(RayError::Origin)?;
        check_direction(&direction.to_array()).map_err(RayError::Direction)?;
        Ok(Self { origin, direction })
    }

    /// A ray from one point towards another, both in metres (`Vec2`, `DVec2`, or an array of f64): a line of sight. Its
    /// direction is the vector from one point to the other, so that a distance along it is a fraction of that vector,
    /// and a query for bodies in between has the limit 1. The direction is f32: the end is off by up to 1e-7 of the
    /// vector's length.
    ///
    /// ```
    /// use asunder::{Ray2, RayError, glam::DVec2};
    /// let sight = Ray2::between([1e6, 0.0], [1e6, 5.0])?;
    /// assert_eq!((sight.at(0.0), sight.at(1.0)), (DVec2::X * 1e6, DVec2::X * 1e6 + DVec2::Y * 5.0));
    /// assert!(Ray2::between(DVec2::X, DVec2::X).is_err(), "points nowhere");
    /// # Ok::<(), RayError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Ray2::new`]; the direction is zero if the points are equal, or closer than f32 can represent.
    pub fn between(from: impl Into<DVec2>, to: impl Into<DVec2>) -> Result<Self, RayError> {
        let from = from.into();
        Self::new(from, (to.into() - from).as_vec2())
    }

    /// The origin, in metres.
    ///
    /// ```
    /// use asunder::{Ray2, RayError, glam::{DVec2, Vec2}};
    /// let ray = Ray2::new(DVec2::X, Vec2::Y)?;
    /// assert_eq!((ray.origin(), ray.direction()), (DVec2::X, Vec2::Y));
    /// # Ok::<(), RayError>(())
    /// ```
    #[inline]
    pub const fn origin(&self) -> DVec2 {
        self.origin
    }

    /// The direction, bit for bit as given.
    #[inline]
    pub const fn direction(&self) -> Vec2 {
        self.direction
    }

    /// The point at a parameter.
    #[inline]
    pub fn at(&self, t: f64) -> DVec2 {
        self.origin + self.direction.as_dvec2() * t
    }
}

/// A ray in space: an origin, and a direction of any length but zero. The point at parameter t is origin + t direction.
///
/// ```
/// use asunder::{DirectionError, Ray3, RayError, glam::{DVec3, Vec3}};
/// let ray = Ray3::new(DVec3::X, Vec3::Y * 2.0)?;
/// assert_eq!(ray.at(0.5), DVec3::X + DVec3::Y);
/// assert_eq!(Ray3::new(DVec3::X, Vec3::ZERO), Err(RayError::Direction(DirectionError::Zero)));
/// # Ok::<(), RayError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray3 {
    origin: DVec3,
    direction: Vec3,
}

impl Ray3 {
    /// A ray from its origin, in metres (`Vec3`, `DVec3`, or an array of f64), and its direction.
    ///
    /// # Errors
    /// Numbers that are not finite, an origin beyond 1e9 m on an axis, and a zero direction.
    pub fn new(origin: impl Into<DVec3>, direction: Vec3) -> Result<Self, RayError> {
        let origin = origin.into();
        check_position(&origin.to_array()).map_err(RayError::Origin)?;
        check_direction(&direction.to_array()).map_err(RayError::Direction)?;
        Ok(Self { origin, direction })
    }

    /// A ray from one point towards another, both in metres (`Vec3`, `DVec3`, or an array of f64): a line of sight. Its
    /// direction is the vector from one point to the other, so that a distance along it is a fraction of that vector,
    /// and a query for bodies in between has the limit 1. The direction is f32: the end is off by up to 1e-7 of the
    /// vector's length.
    ///
    /// ```
    /// use asunder::{Ray3, RayError, glam::DVec3};
    /// let sight = Ray3::between([1e6, 0.0, 0.0], [1e6, 5.0, 0.0])?;
    /// assert_eq!((sight.at(0.0), sight.at(1.0)), (DVec3::X * 1e6, DVec3::X * 1e6 + DVec3::Y * 5.0));
    /// assert!(Ray3::between(DVec3::X, DVec3::X).is_err(), "points nowhere");
    /// # Ok::<(), RayError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Ray3::new`]; the direction is zero if the points are equal, or closer than f32 can represent.
    pub fn between(from: impl Into<DVec3>, to: impl Into<DVec3>) -> Result<Self, RayError> {
        let from = from.into();
        Self::new(from, (to.into() - from).as_vec3())
    }

    /// The origin, in metres.
    ///
    /// ```
    /// use asunder::{Ray3, RayError, glam::{DVec3, Vec3}};
    /// let ray = Ray3::new(DVec3::X, Vec3::Y)?;
    /// assert_eq!((ray.origin(), ray.direction()), (DVec3::X, Vec3::Y));
    /// # Ok::<(), RayError>(())
    /// ```
    #[inline]
    pub const fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The direction, bit for bit as given.
    #[inline]
    pub const fn direction(&self) -> Vec3 {
        self.direction
    }

    /// The point at a parameter.
    #[inline]
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + self.direction.as_dvec3() * t
    }
}

/// Why a ray was rejected.
///
/// ```
/// use asunder::{PoseError, Ray3, RayError, glam::Vec3};
/// let refused = Ray3::new([0.0, 2e9, 0.0], Vec3::X).unwrap_err();
/// assert_eq!(refused, RayError::Origin(PoseError::PositionTooFar { axis: 1, value: 2e9 }));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RayError {
    /// Its origin is invalid.
    Origin(PoseError),
    /// Its direction is invalid.
    Direction(DirectionError),
}

impl core::fmt::Display for RayError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Origin(error) => write!(f, "origin of a ray: {error}"),
            Self::Direction(error) => write!(f, "{error}"),
        }
    }
}

impl core::error::Error for RayError {}
