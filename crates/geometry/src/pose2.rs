//! Poses in the plane, and the exact meaning of their rotations.

use crate::pose3::{PoseError, check_position, check_rotation};
use crate::tolerance::UNIT_ROTATION;
use glam::{DAffine2, DVec2};

/// A rotation in the plane, stored as its cosine and sine.
///
/// It *means* the stored matrix `[c -s; s c]`, which the constructor normalises once. The stored pair is within an f32
/// rounding of unit length; that tiny scale counts as part of the true shape.
///
/// ```
/// use asunder::Rotation2;
/// let quarter = Rotation2::new(0.0, 2.0)?;
/// assert_eq!((quarter.cos(), quarter.sin()), (0.0, 1.0));
/// let eighth = Rotation2::from_angle(std::f32::consts::FRAC_PI_4)?;
/// assert!((eighth.cos() - eighth.sin()).abs() < 1e-7);
/// # Ok::<(), asunder::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation2 {
    cos: f32,
    sin: f32,
}

impl Rotation2 {
    /// No rotation.
    pub const IDENTITY: Self = Self { cos: 1.0, sin: 0.0 };

    /// The rotation of the x axis to the direction (`cos`, `sin`), of any length but zero.
    ///
    /// # Errors
    /// Numbers that are not finite, and zero.
    pub fn new(cos: f32, sin: f32) -> Result<Self, PoseError> {
        check_rotation(&[cos, sin])?;
        Ok(Self::of_f64(cos.into(), sin.into()))
    }

    /// From numbers that are finite, and not both zero.
    pub(crate) fn of_f64(c: f64, s: f64) -> Self {
        let length = (c * c + s * s).sqrt();
        Self { cos: (c / length) as f32, sin: (s / length) as f32 }
    }

    /// The opposite rotation, bit for bit.
    pub(crate) fn reversed(self) -> Self {
        // A difference instead of a negation avoids -0.
        Self { cos: self.cos, sin: 0.0 - self.sin }
    }

    /// The rotation with exactly this [`cos`](Self::cos) and [`sin`](Self::sin), bit for bit: for games that store or
    /// send rotations in a format of their own. [`Rotation2::new`] would normalise them again, and change one in two
    /// hundred.
    ///
    /// ```
    /// use asunder::{PoseError, Rotation2};
    /// let sent = Rotation2::from_angle(2.5)?;
    /// assert_eq!(Rotation2::restored(sent.cos(), sent.sin()), Ok(sent));
    /// assert_eq!(Rotation2::restored(0.8, 0.8), Err(PoseError::NotUnit { cos: 0.8, sin: 0.8 }));
    /// # Ok::<(), PoseError>(())
    /// ```
    ///
    /// # Errors
    /// Numbers that are not finite, or that are not of unit length up to rounding.
    pub fn restored(cos: f32, sin: f32) -> Result<Self, PoseError> {
        check_rotation(&[cos, sin])?;
        let (c, s) = (f64::from(cos), f64::from(sin));
        if (c * c + s * s - 1.0).abs() > UNIT_ROTATION {
            return Err(PoseError::NotUnit { cos, sin });
        }
        Ok(Self { cos, sin })
    }

    /// A counter-clockwise rotation by an angle in radians, by `libm`: the same bits on every platform.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn from_angle(radians: f32) -> Result<Self, PoseError> {
        if !radians.is_finite() {
            return Err(PoseError::RotationNotFinite { component: 0, value: radians });
        }
        Self::new(libm::cos(f64::from(radians)) as f32, libm::sin(f64::from(radians)) as f32)
    }

    /// The angle in radians, counter-clockwise from the x axis, -pi to pi, by `libm`: the same bits on every platform.
    ///
    /// ```
    /// use asunder::Rotation2;
    /// assert_eq!(Rotation2::new(0.0, -3.0)?.angle(), -std::f32::consts::FRAC_PI_2);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    pub fn angle(&self) -> f32 {
        libm::atan2(f64::from(self.sin), f64::from(self.cos)) as f32
    }

    /// The stored cosine.
    #[inline]
    pub const fn cos(&self) -> f32 {
        self.cos
    }

    /// The stored sine.
    #[inline]
    pub const fn sin(&self) -> f32 {
        self.sin
    }

    /// Rotates a vector by the stored matrix.
    #[inline]
    pub fn turn(&self, v: DVec2) -> DVec2 {
        let (c, s) = (f64::from(self.cos), f64::from(self.sin));
        DVec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
    }
}

impl Default for Rotation2 {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// The pose of a body in the plane: an f64 position in metres and an f32 rotation.
///
/// ```
/// use asunder::{Pose2, Rotation2, glam::{DVec2, Vec2}};
/// let pose = Pose2::new(DVec2::new(1e6, 0.25), Rotation2::new(0.0, 1.0)?)?;
/// assert_eq!(pose.transform(Vec2::X).to_array(), [1e6, 1.25]);
/// # Ok::<(), asunder::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose2 {
    position: DVec2,
    rotation: Rotation2,
}

impl Pose2 {
    /// No translation, no rotation.
    pub const IDENTITY: Self = Self { position: DVec2::ZERO, rotation: Rotation2::IDENTITY };

    /// A pose from a position (`Vec2`, `DVec2`, or an array of f64) and a rotation.
    ///
    /// # Errors
    /// A coordinate that is not finite, or beyond [`MAX_POSITION`](crate::tolerance::MAX_POSITION).
    pub fn new(position: impl Into<DVec2>, rotation: Rotation2) -> Result<Self, PoseError> {
        let position = position.into();
        check_position(&position.to_array())?;
        Ok(Self { position, rotation })
    }

    /// A pose without rotation.
    ///
    /// # Errors
    /// As [`Pose2::new`].
    pub fn at(position: impl Into<DVec2>) -> Result<Self, PoseError> {
        Self::new(position, Rotation2::IDENTITY)
    }

    /// The position, in metres.
    #[inline]
    pub const fn position(&self) -> DVec2 {
        self.position
    }

    /// The rotation.
    #[inline]
    pub const fn rotation(&self) -> Rotation2 {
        self.rotation
    }

    /// The pose with another position, in metres (`Vec2`, `DVec2`, or an array of f64), and the same rotation.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::DVec2};
    /// let pose = Pose2::new([1.0, 2.0], Rotation2::new(0.6, 0.8)?)?;
    /// let there = pose.with_position([7.0, 8.0])?;
    /// assert_eq!((there.position(), there.rotation()), (DVec2::new(7.0, 8.0), pose.rotation()));
    /// assert_eq!(there.with_rotation(Rotation2::IDENTITY), Pose2::at([7.0, 8.0])?);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pose2::new`].
    pub fn with_position(&self, position: impl Into<DVec2>) -> Result<Self, PoseError> {
        Self::new(position, self.rotation)
    }

    /// The pose with another rotation, and the same position.
    #[must_use]
    pub const fn with_rotation(&self, rotation: Rotation2) -> Self {
        Self { position: self.position, rotation }
    }

    /// The pose moved by a displacement in metres (`Vec2`, `DVec2`, or an array of f64); the rotation is kept.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::DVec2};
    /// let pose = Pose2::new([1.0, 2.0], Rotation2::new(0.6, 0.8)?)?;
    /// let moved = pose.shifted(DVec2::X * 3.0)?;
    /// assert_eq!((moved.position(), moved.rotation()), (DVec2::new(4.0, 2.0), pose.rotation()));
    /// assert!(pose.shifted(DVec2::Y * 1e9).is_err(), "out of range");
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pose2::new`].
    pub fn shifted(&self, displacement: impl Into<DVec2>) -> Result<Self, PoseError> {
        Self::new(self.position + displacement.into(), self.rotation)
    }

    /// Transforms a local point, in metres, to world space.
    #[inline]
    pub fn transform(&self, point: impl Into<DVec2>) -> DVec2 {
        self.position + self.rotation.turn(point.into())
    }

    /// Transforms a point in world space, in metres, to local space: the inverse of [`Pose2::transform`], up to
    /// rounding.
    #[inline]
    pub fn transform_back(&self, point: DVec2) -> DVec2 {
        self.turn_back(point - self.position)
    }

    /// The pose as an affine matrix from local to world space, for renderers and scene graphs. The note on cameras of
    /// [`Pose3::to_affine`](crate::Pose3::to_affine) applies here, too.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::{Affine2, DAffine2, DVec2, Vec2}};
    /// let body = Pose2::new([1e6, 0.25], Rotation2::new(0.0, 1.0)?)?;
    /// let eye = DVec2::new(1e6, 0.0);
    /// let seen: Affine2 = (DAffine2::from_translation(-eye) * body.to_affine()).as_affine2();
    /// assert_eq!(seen.transform_point2(Vec2::X), Vec2::new(0.0, 1.25));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn to_affine(&self) -> DAffine2 {
        DAffine2::from_cols(self.rotation.turn(DVec2::X), self.rotation.turn(DVec2::Y), self.position)
    }

    /// Transforms a local direction to world axes, for example the direction in which the body faces.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2, glam::DVec2};
    /// let pose = Pose2::new([7.0, 8.0], Rotation2::new(0.0, 1.0)?)?;
    /// assert_eq!((pose.turn(DVec2::X), pose.turn_back(DVec2::Y)), (DVec2::Y, DVec2::X));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn turn(&self, direction: DVec2) -> DVec2 {
        self.rotation.turn(direction)
    }

    /// Transforms a direction in world axes to local axes, by the inverse of the stored matrix.
    #[inline]
    pub fn turn_back(&self, direction: DVec2) -> DVec2 {
        let (c, s) = (f64::from(self.rotation.cos), f64::from(self.rotation.sin));
        DVec2::new(c * direction.x + s * direction.y, c * direction.y - s * direction.x) / (c * c + s * s)
    }

    /// Whether every stored bit is equal: `0.0` and `-0.0` differ. A world uses it to detect whether a body has moved.
    #[inline]
    pub fn same_bits(&self, other: &Self) -> bool {
        self.position.x.to_bits() == other.position.x.to_bits()
            && self.position.y.to_bits() == other.position.y.to_bits()
            && self.same_rotation(other)
    }

    /// An upper bound on how far any point within `arm` metres of the position moves on the way to another pose by the
    /// shortest turn; at least the distance between where any of them starts and ends. Rounded up.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2};
    /// let half = Pose2::new([3.0, 0.0], Rotation2::new(-1.0, 0.0)?)?;
    /// let travel = Pose2::IDENTITY.travel(&half, 2.0);
    /// assert!((7.0..7.0001).contains(&travel), "three, and across a circle of two");
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn travel(&self, to: &Self, arm: f64) -> f64 {
        let straight = (to.position - self.position).length();
        let step = DVec2::new(
            f64::from(to.rotation.cos) - f64::from(self.rotation.cos),
            f64::from(to.rotation.sin) - f64::from(self.rotation.sin),
        );
        let spin = step.length();
        // Zero times infinity: an infinite arm that does not turn does not move.
        let turned = if spin > 0.0 { spin * arm } else { 0.0 };
        (straight + turned) * (1.0 + 64.0 * f64::EPSILON)
    }

    /// Whether every stored bit of the rotation is equal.
    ///
    /// ```
    /// use asunder::{Pose2, Rotation2};
    /// let turned = Pose2::new([1.0, 2.0], Rotation2::new(0.6, 0.8)?)?;
    /// let moved = turned.shifted([1.0, 0.0])?;
    /// assert!(turned.same_rotation(&moved) && !turned.same_bits(&moved));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn same_rotation(&self, other: &Self) -> bool {
        self.rotation.cos.to_bits() == other.rotation.cos.to_bits()
            && self.rotation.sin.to_bits() == other.rotation.sin.to_bits()
    }
}
