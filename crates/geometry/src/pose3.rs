//! Poses in space, and the exact meaning of their rotations.

use crate::basis3::Basis3;
use crate::tolerance::MAX_POSITION;
use glam::{DAffine3, DVec3, Quat};

/// Why a pose was rejected.
///
/// ```
/// use asunder::{Pose3, PoseError, glam::{Quat, Vec3}};
/// let refused = Pose3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 0.0));
/// assert_eq!(refused.unwrap_err(), PoseError::ZeroRotation);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PoseError {
    /// A coordinate of the position is NaN or infinite.
    PositionNotFinite {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value.
        value: f64,
    },
    /// A coordinate of the position is beyond [`MAX_POSITION`].
    PositionTooFar {
        /// Which axis, 0 for x.
        axis: usize,
        /// The given value, in metres.
        value: f64,
    },
    /// A component of the rotation is NaN or infinite.
    RotationNotFinite {
        /// Which component: x, y, z, w of a quaternion; cosine, sine in the plane.
        component: usize,
        /// The given value.
        value: f32,
    },
    /// The rotation is zero in every component, and so has no direction.
    ZeroRotation,
    /// A cosine and a sine whose squares do not add up to one, so that they belong to no rotation in the plane: see
    /// [`Rotation2::restored`](crate::Rotation2::restored).
    NotUnit {
        /// The cosine.
        cos: f32,
        /// The sine.
        sin: f32,
    },
}

impl core::fmt::Display for PoseError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::PositionNotFinite { axis, value } => {
                write!(
                    f,
                    "position or displacement {value} on axis {axis} is not finite: check the step that made it"
                )
            }
            Self::PositionTooFar { axis, value } => {
                write!(
                    f,
                    "position or displacement {value} m on axis {axis} is beyond {MAX_POSITION} m: move the origin"
                )
            }
            Self::RotationNotFinite { component, value } => {
                write!(f, "rotation component {component} is {value}: check the step that made it")
            }
            Self::ZeroRotation => write!(f, "the rotation is zero: use the identity for no rotation"),
            Self::NotUnit { cos, sin } => {
                write!(
                    f,
                    "cosine {cos} and sine {sin} are not of length 1 to the last bit: store what a rotation shows"
                )
            }
        }
    }
}

impl core::error::Error for PoseError {}

/// Rejects positions that are not finite or out of range, in either dimension.
pub(crate) fn check_position(position: &[f64]) -> Result<(), PoseError> {
    for (axis, &value) in position.iter().enumerate() {
        if !value.is_finite() {
            return Err(PoseError::PositionNotFinite { axis, value });
        }
        if value.abs() > MAX_POSITION {
            return Err(PoseError::PositionTooFar { axis, value });
        }
    }
    Ok(())
}

/// Rejects a rotation that is not finite or zero.
pub(crate) fn check_rotation(components: &[f32]) -> Result<(), PoseError> {
    for (component, &value) in components.iter().enumerate() {
        if !value.is_finite() {
            return Err(PoseError::RotationNotFinite { component, value });
        }
    }
    if components.iter().all(|&value| value == 0.0) {
        return Err(PoseError::ZeroRotation);
    }
    Ok(())
}

/// The pose of a body in space: an f64 position in metres and an f32 rotation.
///
/// The quaternion is kept bit for bit and never renormalised: it *means* the matrix M(q)/|q|^2, which is an exact
/// rotation for every q but zero. A quaternion that has drifted over ten thousand products is therefore as good
/// as a fresh one.
///
/// ```
/// use asunder::{Pose3, glam::{Quat, Vec3}};
/// let drifted = Quat::from_xyzw(0.0, 0.0, 3.0, 3.0); // a quarter turn about z, far from unit length
/// let pose = Pose3::new(Vec3::new(1e6, 0.0, 0.0), drifted)?;
/// assert_eq!(pose.rotation(), drifted);
/// assert_eq!(pose.transform(Vec3::X).to_array(), [1e6, 1.0, 0.0]);
/// # Ok::<(), asunder::PoseError>(())
/// ```
// The rotation comes first: copies are made in chunks of sixteen bytes, and a load right after one must not straddle
// two of these stores.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pose3 {
    // Components x, y, z, w. Not a `Quat`, whose alignment would pad every pose to 48 bytes.
    rotation: [f32; 4],
    position: DVec3,
}

impl Pose3 {
    /// No translation, no rotation.
    pub const IDENTITY: Self = Self { position: DVec3::ZERO, rotation: [0.0, 0.0, 0.0, 1.0] };

    /// A pose from a position (`Vec3`, `DVec3`, or an array of f64) and a rotation of any length but zero.
    ///
    /// # Errors
    /// Numbers that are not finite, a coordinate beyond [`MAX_POSITION`], and a zero quaternion.
    pub fn new(position: impl Into<DVec3>, rotation: Quat) -> Result<Self, PoseError> {
        let position = position.into();
        check_position(&position.to_array())?;
        check_rotation(&rotation.to_array())?;
        Ok(Self { position, rotation: rotation.to_array() })
    }

    /// A pose without rotation.
    ///
    /// # Errors
    /// As [`Pose3::new`].
    pub fn at(position: impl Into<DVec3>) -> Result<Self, PoseError> {
        Self::new(position, Quat::IDENTITY)
    }

    /// The position, in metres.
    #[inline]
    pub const fn position(&self) -> DVec3 {
        self.position
    }

    /// The rotation, bit for bit as it was given.
    ///
    /// It need not be a unit quaternion, as glam's matrices require: normalise it for these, or use
    /// [`Pose3::to_affine`].
    #[inline]
    pub fn rotation(&self) -> Quat {
        Quat::from_array(self.rotation)
    }

    /// The pose with another position, in metres (`Vec3`, `DVec3`, or an array of f64), and the same rotation.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat}};
    /// let pose = Pose3::new([1.0, 2.0, 3.0], Quat::from_xyzw(0.1, 0.2, 0.3, 0.4))?;
    /// let there = pose.with_position([7.0, 8.0, 9.0])?;
    /// assert_eq!((there.position(), there.rotation()), (DVec3::new(7.0, 8.0, 9.0), pose.rotation()));
    /// assert_eq!(there.with_rotation(Quat::IDENTITY)?, Pose3::at([7.0, 8.0, 9.0])?);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pose3::new`].
    pub fn with_position(&self, position: impl Into<DVec3>) -> Result<Self, PoseError> {
        Self::new(position, self.rotation())
    }

    /// The pose with another rotation, and the same position.
    ///
    /// # Errors
    /// As [`Pose3::new`].
    pub fn with_rotation(&self, rotation: Quat) -> Result<Self, PoseError> {
        Self::new(self.position, rotation)
    }

    /// The pose moved by a displacement in metres (`Vec3`, `DVec3`, or an array of f64); the rotation is kept.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat}};
    /// let pose = Pose3::new([1.0, 2.0, 3.0], Quat::from_xyzw(0.1, 0.2, 0.3, 0.4))?;
    /// let moved = pose.shifted(DVec3::X * 3.0)?;
    /// assert_eq!((moved.position(), moved.rotation()), (DVec3::new(4.0, 2.0, 3.0), pose.rotation()));
    /// assert!(pose.shifted(DVec3::Y * 1e9).is_err(), "out of range");
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Pose3::new`].
    pub fn shifted(&self, displacement: impl Into<DVec3>) -> Result<Self, PoseError> {
        Self::new(self.position + displacement.into(), self.rotation())
    }

    /// The rotation's matrix M(q)/|q|^2, in f64. Cost: one division.
    #[inline]
    pub fn basis(&self) -> Basis3 {
        Basis3::of_quaternion(self.components())
    }

    /// The axes of this pose in the axes of another one: right to 31 units of 2^-53, and exactly the identity if both
    /// rotations are equal. Cost: that of [`Pose3::basis`], and a product of quaternions.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat, Vec3}};
    /// let tilted = Pose3::new(Vec3::ZERO, Quat::from_xyzw(0.1, 0.2, 0.3, 0.4))?;
    /// assert_eq!(tilted.basis_from(&tilted), Pose3::IDENTITY.basis());
    /// let quarter = Pose3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 1.0))?;
    /// assert_eq!(quarter.basis_from(&Pose3::IDENTITY).x, DVec3::Y);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn basis_from(&self, other: &Self) -> Basis3 {
        Basis3::between(other.components(), self.components())
    }

    /// The rotation, in world axes, that takes a body's directions in another pose to those in this one: right to 31
    /// units of 2^-53, and exactly the identity if both rotations are equal. Cost: that of [`Pose3::basis_from`].
    ///
    /// ```
    /// use asunder::{Basis3, Pose3, glam::{DVec3, Quat, Vec3}};
    /// let lying = Pose3::new(Vec3::ZERO, Quat::from_xyzw(1.0, 0.0, 0.0, 1.0))?;
    /// let turned = Pose3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 1.0) * lying.rotation())?;
    /// assert_eq!(turned.turn_since(&lying).turn(DVec3::X), DVec3::Y);
    /// assert_eq!(lying.turn_since(&lying), Basis3::UNIT);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn turn_since(&self, other: &Self) -> Basis3 {
        // q conjugate(p), from the conjugates of both.
        let ([a, b, c, d], [x, y, z, w]) = (other.components(), self.components());
        Basis3::between([-x, -y, -z, w], [-a, -b, -c, d])
    }

    /// The rotation's x, y, z, w. Written out, as below: without link-time optimisation `map` is a call.
    #[inline(always)]
    pub(crate) fn components(&self) -> [f64; 4] {
        let [x, y, z, w] = self.rotation;
        [x.into(), y.into(), z.into(), w.into()]
    }

    /// Transforms a local point, in metres, to world space.
    #[inline]
    pub fn transform(&self, point: impl Into<DVec3>) -> DVec3 {
        self.position + self.basis().turn(point.into())
    }

    /// Transforms a point in world space, in metres, to local space: the inverse of [`Pose3::transform`], up to
    /// rounding.
    #[inline]
    pub fn transform_back(&self, point: DVec3) -> DVec3 {
        self.basis().turn_back(point - self.position)
    }

    /// The pose as an affine matrix from local to world space, for renderers and scene graphs. Right to some units of
    /// 2^-53; its 3 by 3 part is a rotation, whatever the quaternion's length.
    ///
    /// Rounded to f32, it gets coarser with the distance from the origin. To avoid jitter, draw relative to the camera:
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DAffine3, DVec3, Mat4, Quat, Vec3A}};
    /// let body = Pose3::new([1e6, 2.0, 0.25], Quat::from_xyzw(0.0, 0.0, 3.0, 3.0))?;
    /// let eye = DVec3::new(1e6, 0.0, 0.0);
    /// let seen = DAffine3::from_translation(-eye) * body.to_affine();
    /// assert_eq!(seen.as_affine3a().transform_point3a(Vec3A::X), Vec3A::new(0.0, 3.0, 0.25));
    /// let matrix: Mat4 = Mat4::from(seen.as_affine3a());
    /// assert_eq!(matrix.w_axis.to_array(), [0.0, 2.0, 0.25, 1.0]);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn to_affine(&self) -> DAffine3 {
        let Basis3 { x, y, z } = self.basis();
        DAffine3::from_cols(x, y, z, self.position)
    }

    /// Transforms a local direction to world axes, for example the direction in which the body faces.
    ///
    /// ```
    /// use asunder::{Pose3, glam::{DVec3, Quat}};
    /// let pose = Pose3::new([7.0, 8.0, 9.0], Quat::from_xyzw(0.0, 0.0, 1.0, 1.0))?;
    /// assert_eq!((pose.turn(DVec3::X), pose.turn_back(DVec3::Y)), (DVec3::Y, DVec3::X));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn turn(&self, direction: DVec3) -> DVec3 {
        self.basis().turn(direction)
    }

    /// Transforms a direction in world axes to local axes.
    #[inline]
    pub fn turn_back(&self, direction: DVec3) -> DVec3 {
        self.basis().turn_back(direction)
    }

    /// Whether every stored bit is equal: `0.0` and `-0.0` differ. A world uses it to detect whether a body has moved.
    #[inline]
    pub fn same_bits(&self, other: &Self) -> bool {
        let (here, there) = (self.position, other.position);
        here.x.to_bits() == there.x.to_bits()
            && here.y.to_bits() == there.y.to_bits()
            && here.z.to_bits() == there.z.to_bits()
            && self.same_rotation(other)
    }

    /// An upper bound on how far any point within `arm` metres of the position moves on the way to another pose by the
    /// shortest turn; at least the distance between where any of them starts and ends. Rounded up.
    ///
    /// ```
    /// use asunder::{Pose3, glam::Quat};
    /// let half = Pose3::new([3.0, 0.0, 0.0], Quat::from_xyzw(0.0, 0.0, 1.0, 0.0))?;
    /// let travel = Pose3::IDENTITY.travel(&half, 2.0);
    /// assert!((7.0..7.0001).contains(&travel), "three, and across a circle of two");
    /// let same = Pose3::new([3.0, 0.0, 0.0], Quat::from_xyzw(0.0, 0.0, -2.0, 0.0))?;
    /// assert_eq!([half, same].map(|pose| half.travel(&pose, f64::INFINITY)), [0.0, 0.0]);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn travel(&self, to: &Self, arm: f64) -> f64 {
        let straight = (to.position - self.position).length();
        let spin = if self.same_rotation(to) { 0.0 } else { to.spin_since(self) };
        // Zero times infinity: an infinite arm that does not turn does not move.
        let turned = if spin > 0.0 { spin * arm } else { 0.0 };
        (straight + turned) * (1.0 + 64.0 * f64::EPSILON)
    }

    /// How far the tips of unit vectors moved at most, like [`Basis3::spin_from`] but from the quaternions: twice the
    /// sine of half the angle, which is the share of the vector part in the rotation from one to the other. A third of
    /// the work.
    #[inline]
    fn spin_since(&self, other: &Self) -> f64 {
        let ([a, b, c, d], [x, y, z, w]) = (other.components(), self.components());
        let along = [
            d * x - a * w + (c * y - b * z),
            d * y - b * w + (a * z - c * x),
            d * z - c * w + (b * x - a * y),
        ];
        let aside = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
        let straight = a * x + b * y + c * z + d * w;
        2.0 * (aside / (aside + straight * straight)).sqrt()
    }

    /// Whether every stored bit of the rotation is equal.
    ///
    /// ```
    /// use asunder::{Pose3, glam::Quat};
    /// let turned = Pose3::new([1.0, 2.0, 3.0], Quat::from_xyzw(0.1, 0.2, 0.3, 0.4))?;
    /// let moved = turned.shifted([1.0, 0.0, 0.0])?;
    /// assert!(turned.same_rotation(&moved) && !turned.same_bits(&moved));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn same_rotation(&self, other: &Self) -> bool {
        // Without a branch per component.
        let ([x, y, z, w], [a, b, c, d]) =
            (self.rotation.map(f32::to_bits), other.rotation.map(f32::to_bits));
        (x ^ a) | (y ^ b) | (z ^ c) | (w ^ d) == 0
    }
}

impl Default for Pose3 {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_refuse_what_is_not_a_place() {
        let q = Quat::IDENTITY;
        assert!(matches!(
            Pose3::new(DVec3::new(0.0, f64::NAN, 0.0), q),
            Err(PoseError::PositionNotFinite { axis: 1, .. })
        ));
        assert_eq!(
            Pose3::new(DVec3::new(0.0, 0.0, -2e9), q),
            Err(PoseError::PositionTooFar { axis: 2, value: -2e9 })
        );
        assert!(matches!(
            Pose3::new(DVec3::ZERO, Quat::from_xyzw(0.0, f32::INFINITY, 0.0, 1.0)),
            Err(PoseError::RotationNotFinite { component: 1, .. })
        ));
    }

    #[test]
    fn a_spin_is_that_of_the_bases() {
        let turns = [
            [0.1, 0.2, 0.3, 0.4],
            [1e-38, 0.0, -3e-38, 2e-38],
            [0.0, -1e30, 0.0, 1e30],
            [0.0, 0.0, 0.0, -3.0],
        ];
        let poses = turns.map(|turn| Pose3::new(DVec3::ZERO, Quat::from_array(turn)).unwrap());
        for (one, other) in poses.iter().flat_map(|one| poses.iter().map(move |other| (one, other))) {
            let spin = one.basis_from(other).spin_from(&Basis3::UNIT);
            assert!((one.spin_since(other) - spin).abs() <= 1e-15, "{one:?} {other:?}: {spin}");
        }
        let hardly = Pose3::new(DVec3::ZERO, Quat::from_xyzw(1e-7, 0.0, 0.0, 1.0)).unwrap();
        assert!((hardly.spin_since(&Pose3::IDENTITY) / 2e-7 - 1.0).abs() < 1e-7);
    }

    #[test]
    fn a_basis_is_a_rotation_however_long_the_quaternion() {
        for length in [1e-38_f32, 1e-20, 0.5, 1.0, 1e20, 1e38] {
            let q = Quat::from_xyzw(0.3 * length, -0.7 * length, 0.2 * length, 0.6 * length);
            let basis = Pose3::new(DVec3::ZERO, q).unwrap().basis();
            for (a, b, dot) in [
                (basis.x, basis.x, 1.0),
                (basis.x, basis.y, 0.0),
                (basis.y, basis.z, 0.0),
                (basis.z, basis.z, 1.0),
            ] {
                assert!((a.dot(b) - dot).abs() < 1e-15, "{length}: {}", a.dot(b));
            }
            assert!((basis.x.cross(basis.y) - basis.z).length() < 1e-15);
        }
    }
}
