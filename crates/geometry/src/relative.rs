//! Poses relative to others, for bodies that are held, carried or mounted.

use crate::basis3::turn_between;
use crate::pose2::{Pose2, Rotation2};
use crate::pose3::{Pose3, PoseError};
use glam::Quat;

impl Pose3 {
    /// The world pose of a body whose pose in the axes of `self` is `local`: a lantern in a hand, a wheel on a cart.
    ///
    /// The rotation is off by at most 2^-23 rad, so that a point d metres away is off by d 2^-23 m; it is exact if one
    /// of both is the identity. The quaternion may have any length. [`Pose3::relative_to`] is the inverse.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat, Vec3}};
    /// let quarter = Quat::from_xyzw(0.0, 0.0, 1.0, 1.0);
    /// let (hand, lantern) = (Pose3::new([5.0, 1.0, 0.0], quarter)?, Pose3::new([2.0, 0.0, 0.0], quarter)?);
    /// let shown = hand.compose(&lantern)?;
    /// assert_eq!((shown.position(), shown.turn(DVec3::X)), (DVec3::new(5.0, 3.0, 0.0), DVec3::NEG_X));
    /// assert_eq!(shown.transform(Vec3::Y), hand.transform(lantern.transform(Vec3::Y)));
    /// assert_eq!(hand.compose(&Pose3::IDENTITY)?, hand);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A position out of range: see [`Pose3::new`].
    pub fn compose(&self, local: &Self) -> Result<Self, PoseError> {
        let [x, y, z, w] = self.components();
        let rotation = turn_between([-x, -y, -z, w], local.components());
        Self::new(self.transform(local.position()), rounded(rotation))
    }

    /// This pose in the axes of another one: the inverse of [`Pose3::compose`]. For the identity it gives the other's
    /// inverse.
    ///
    /// Positions are subtracted before they are rotated, so that it is as accurate far from the origin.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat}};
    /// let quarter = Quat::from_xyzw(0.0, 0.0, 1.0, 1.0);
    /// let (cart, wheel) = (Pose3::new([5e6, 1.0, 0.0], quarter)?, Pose3::at([5e6, 3.5, 0.0])?);
    /// let mounted = wheel.relative_to(&cart)?;
    /// assert_eq!((mounted.position(), mounted.turn(DVec3::Y)), (DVec3::new(2.5, 0.0, 0.0), DVec3::X));
    /// assert_eq!(cart.compose(&mounted)?.position(), wheel.position());
    /// let back = Pose3::IDENTITY.relative_to(&cart)?;
    /// assert_eq!(back.transform(wheel.position()), mounted.position());
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A position out of range: see [`Pose3::new`].
    pub fn relative_to(&self, other: &Self) -> Result<Self, PoseError> {
        let rotation = turn_between(other.components(), self.components());
        Self::new(other.transform_back(self.position()), rounded(rotation))
    }
}

/// A non-zero quaternion rounded to f32. If its length is far from one, it is first scaled by a power of two, which is
/// exact.
fn rounded(quaternion: [f64; 4]) -> Quat {
    let most = quaternion.into_iter().fold(0.0_f64, |most, part| most.max(part.abs()));
    // Removes the exponent if it is far from that of one.
    let exponent = most.to_bits() >> 52;
    let scale = if (2e-3..=2e3).contains(&most) { 1.0 } else { f64::from_bits((2046 - exponent) << 52) };
    Quat::from_array(quaternion.map(|part| (part * scale) as f32))
}

impl Pose2 {
    /// The world pose of a body whose pose in the axes of `self` is `local`: a turret on a tank.
    ///
    /// The rotation is off by at most 2^-23 rad, so that a point d metres away is off by d 2^-23 m; it is exact if one
    /// of both is the identity. [`Pose2::relative_to`] is the inverse.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::{DVec2, Vec2}};
    /// let quarter = Rotation2::new(0.0, 1.0)?;
    /// let (tank, turret) = (Pose2::new([5.0, 1.0], quarter)?, Pose2::new([2.0, 0.0], quarter)?);
    /// let shown = tank.compose(&turret)?;
    /// assert_eq!((shown.position(), shown.turn(DVec2::X)), (DVec2::new(5.0, 3.0), DVec2::NEG_X));
    /// assert_eq!(shown.transform(Vec2::Y), tank.transform(turret.transform(Vec2::Y)));
    /// assert_eq!((tank.compose(&Pose2::IDENTITY)?, Pose2::IDENTITY.compose(&tank)?), (tank, tank));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A position out of range: see [`Pose2::new`].
    pub fn compose(&self, local: &Self) -> Result<Self, PoseError> {
        Self::new(self.transform(local.position()), self.rotation().then(local.rotation(), 1.0))
    }

    /// This pose in the axes of another one: the inverse of [`Pose2::compose`]. For the identity it gives the other's
    /// inverse.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::DVec2};
    /// let (tank, turret) = (Pose2::new([5e6, 1.0], Rotation2::new(0.0, 1.0)?)?, Pose2::at([5e6, 3.5])?);
    /// let mounted = turret.relative_to(&tank)?;
    /// assert_eq!((mounted.position(), mounted.turn(DVec2::Y)), (DVec2::new(2.5, 0.0), DVec2::X));
    /// assert_eq!(tank.compose(&mounted)?, turret);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A position out of range: see [`Pose2::new`].
    pub fn relative_to(&self, other: &Self) -> Result<Self, PoseError> {
        Self::new(other.transform_back(self.position()), self.rotation().then(other.rotation(), -1.0))
    }
}

/// The product of two rotations, the right one applied first, rounded to f32.
///
/// ```
/// use asunder::{Rotation2, glam::DVec2};
/// let (quarter, eighth) = (Rotation2::new(0.0, 1.0)?, Rotation2::new(1.0, 1.0)?);
/// let turned = (quarter * eighth).turn(DVec2::X);
/// assert!((turned - quarter.turn(eighth.turn(DVec2::X))).length() < 1e-7);
/// assert_eq!(quarter * quarter.inverse(), Rotation2::IDENTITY);
/// # Ok::<(), asunder::PoseError>(())
/// ```
impl core::ops::Mul for Rotation2 {
    type Output = Self;

    fn mul(self, first: Self) -> Self {
        first.then(self, 1.0)
    }
}

impl Rotation2 {
    /// The inverse rotation.
    ///
    /// ```
    /// use asunder::Rotation2;
    /// assert_eq!(Rotation2::new(0.0, 2.0)?.inverse(), Rotation2::new(0.0, -1.0)?);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[must_use]
    pub fn inverse(self) -> Self {
        Self::IDENTITY.then(self, -1.0)
    }

    /// This rotation combined with another one (`sign` 1) or its inverse (-1).
    fn then(self, other: Self, sign: f64) -> Self {
        if other == Self::IDENTITY {
            return self;
        }
        if self == Self::IDENTITY {
            return if sign > 0.0 { other } else { other.reversed() };
        }
        let [c, s] = [self.cos(), self.sin()].map(f64::from);
        let [x, y] = [f64::from(other.cos()), sign * f64::from(other.sin())];
        Self::of_f64(c * x - s * y, s * x + c * y)
    }
}
