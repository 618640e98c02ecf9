//! Rotations in f64, as the images of the three axes.

use glam::DVec3;

/// conjugate(p) q: the rotation from one to another, in the axes of the first.
///
/// Products of f32 are exact in f64, so that equal rotations cancel to the last bit. Summed in pairs, so that each
/// component is rounded only twice.
#[inline(always)]
pub(crate) fn turn_between([a, b, c, d]: [f64; 4], [x, y, z, w]: [f64; 4]) -> [f64; 4] {
    [
        (d * x - a * w) + (c * y - b * z),
        (d * y - b * w) + (a * z - c * x),
        (d * z - c * w) + (b * x - a * y),
        (d * w + a * x) + (b * y + c * z),
    ]
}

/// A rotation as the images of the three coordinate axes, in f64.
///
/// Its products are written out in a fixed order of summation: that of glam's matrix code depends on the processor.
///
/// ```
/// use asunder::{Pose3, glam::DVec3};
/// let basis = Pose3::IDENTITY.basis();
/// assert_eq!(basis.turn(DVec3::X), DVec3::X);
/// assert_eq!(basis.turn_back(DVec3::Y), DVec3::Y);
/// assert_eq!(basis.relative_to(&basis), basis);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis3 {
    /// Image of the x axis.
    pub x: DVec3,
    /// Image of the y axis.
    pub y: DVec3,
    /// Image of the z axis.
    pub z: DVec3,
}

impl Basis3 {
    /// The axes of one rotation in those of another, from quaternions x, y, z, w of any length but zero whose
    /// components are f32 values. [`Pose3::basis_from`](crate::Pose3::basis_from) uses it; it is public for code that
    /// keeps rotations in arrays of its own.
    ///
    /// ```
    /// use asunder::Basis3;
    /// let turned = [0.5, -0.25, 1.0, 2.0];
    /// assert_eq!(Basis3::between([0.0, 0.0, 0.0, 1.0], turned), Basis3::of_quaternion(turned));
    /// ```
    #[inline(always)]
    pub fn between(from: [f64; 4], to: [f64; 4]) -> Self {
        Self::of_quaternion(turn_between(from, to))
    }

    /// M(q)/|q|^2 of a quaternion x, y, z, w of any length but zero whose components are f32 values.
    #[inline(always)]
    pub fn of_quaternion([x, y, z, w]: [f64; 4]) -> Self {
        // The least product of two f32 squared is 2e-180: no component can underflow here, and the largest cannot
        // overflow.
        let scale = 2.0 / (x * x + y * y + z * z + w * w);
        let (sx, sy, sz) = (scale * x, scale * y, scale * z);
        let (xx, xy, xz, xw) = (sx * x, sx * y, sx * z, sx * w);
        let (yy, yz, yw) = (sy * y, sy * z, sy * w);
        let (zz, zw) = (sz * z, sz * w);
        Self {
            x: DVec3::new(1.0 - (yy + zz), xy + zw, xz - yw),
            y: DVec3::new(xy - zw, 1.0 - (xx + zz), yz + xw),
            z: DVec3::new(xz + yw, yz - xw, 1.0 - (xx + yy)),
        }
    }

    /// No rotation.
    pub const UNIT: Self = Self { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

    /// The greatest distance that the tip of a unit vector moves from another rotation to this one: for rotation
    /// matrices, the Frobenius norm of the difference over the root of two. Right to some units of 2^-53.
    ///
    /// ```
    /// use asunder::Basis3;
    /// let half = Basis3::of_quaternion([0.0, 1.0, 0.0, 0.0]);
    /// assert_eq!(half.spin_from(&Basis3::UNIT), 2.0);
    /// ```
    #[inline]
    pub fn spin_from(&self, other: &Self) -> f64 {
        let squared = (self.x - other.x).length_squared()
            + (self.y - other.y).length_squared()
            + (self.z - other.z).length_squared();
        (squared * 0.5).sqrt()
    }

    /// Rotates a local vector into the outer frame.
    #[inline]
    pub fn turn(&self, v: DVec3) -> DVec3 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }

    /// Rotates a vector in the outer frame into the local one.
    #[inline]
    pub fn turn_back(&self, v: DVec3) -> DVec3 {
        DVec3::new(self.x.dot(v), self.y.dot(v), self.z.dot(v))
    }

    /// This basis in the axes of another one: `other`'s inverse times `self`.
    #[inline]
    pub fn relative_to(&self, other: &Self) -> Self {
        Self { x: other.turn_back(self.x), y: other.turn_back(self.y), z: other.turn_back(self.z) }
    }
}
