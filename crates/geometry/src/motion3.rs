//! Motions in space: how a body moves from one pose to another, and how fast it turns on the way.

use crate::basis3::Basis3;
use crate::pose3::{Pose3, PoseError, check_position, check_rotation};
use crate::tolerance::MAX_POSITION;
use glam::{DVec3, Quat};

/// A motion in space: a displacement in metres and, if it turns, the rotation at the end.
///
/// The start is not part of it. At a fraction t, from 0 to 1, a body that starts at position p and rotation q is at
///
/// ```text
/// position  p + t d
/// rotation  (1 - t) q + t q'      q' = the rotation at the end, scaled to the length of q, with the nearer sign
/// ```
///
/// which, taken as the matrix M(q)/|q|^2, is a rotation without any trigonometry: about one axis, by at most half a
/// turn, and a little faster in the middle than at the ends (for a quarter turn by 17 %, for half a turn by a factor of
/// 2).
///
/// ```
/// use asunder::{Motion3, Pose3, glam::{DVec3, Quat, Vec3}};
/// let quarter = Quat::from_xyzw(0.0, 0.0, 1.0, 1.0);
/// let motion = Motion3::new(Vec3::X * 4.0, quarter)?;
/// let middle = motion.pose_at(&Pose3::IDENTITY, 0.5);
/// assert_eq!(middle.position(), DVec3::X * 2.0);
/// let diagonal = middle.transform(Vec3::X) - middle.position();
/// assert!((diagonal - DVec3::new(1.0, 1.0, 0.0).normalize()).length() < 1e-7, "half of a quarter turn");
/// assert_eq!(motion.pose_at(&Pose3::IDENTITY, 1.0).rotation(), quarter);
/// assert_eq!((motion.displacement(), motion.rotation()), (DVec3::X * 4.0, Some(quarter)));
/// # Ok::<(), asunder::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion3 {
    displacement: DVec3,
    rotation: Option<[f32; 4]>,
}

/// How a body turns during a [`Motion3`]: about one axis, in f64.
///
/// ```
/// use asunder::{Motion3, Pose3, glam::{DVec3, Quat, Vec3}};
/// let half = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0))?;
/// let turn = half.turn(&Pose3::IDENTITY);
/// assert_eq!((turn.axis(), turn.speed_at(0.5), turn.top_speed()), (DVec3::Z, 4.0, half.turn_speed(&Pose3::IDENTITY)));
/// assert!((turn.basis_at(0.5).x - DVec3::Y).length() < 1e-15);
/// assert!(!turn.is_still());
/// # Ok::<(), asunder::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn3 {
    /// Quaternions x, y, z, w of unit length, no more than a right angle apart.
    from: [f64; 4],
    to: [f64; 4],
    axis: DVec3,
    /// Sine and cosine of half the angle.
    sine: f64,
    cosine: f64,
}

impl Motion3 {
    /// Neither moves nor turns.
    pub const STILL: Self = Self { displacement: DVec3::ZERO, rotation: None };

    /// A displacement in metres (`Vec3`, `DVec3`, or an array of f64), and the absolute rotation at the end (not one
    /// relative to the start), of any length but zero. For a motion without rotation: [`shift`](Self::shift).
    ///
    /// # Errors
    /// Numbers that are not finite, a displacement beyond 1e9 m on an axis, and a zero quaternion.
    pub fn new(displacement: impl Into<DVec3>, to: Quat) -> Result<Self, PoseError> {
        check_rotation(&to.to_array())?;
        Ok(Self { rotation: Some(to.to_array()), ..Self::shift(displacement)? })
    }

    /// A displacement in metres. The body keeps its rotation, bit for bit.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, PoseError, glam::{DVec3, Vec3}};
    /// let up = Motion3::shift(Vec3::Y)?;
    /// assert_eq!(up.pose_at(&Pose3::IDENTITY, 0.25), Pose3::at([0.0, 0.25, 0.0])?);
    /// assert_eq!((up.rotation(), up.turn_speed(&Pose3::IDENTITY)), (None, 0.0));
    /// assert!(matches!(Motion3::shift([f64::NAN, 0.0, 0.0]), Err(PoseError::PositionNotFinite { axis: 0, .. })));
    /// # Ok::<(), PoseError>(())
    /// ```
    ///
    /// # Errors
    /// A displacement that is not finite, or beyond 1e9 m on an axis.
    pub fn shift(displacement: impl Into<DVec3>) -> Result<Self, PoseError> {
        let displacement = displacement.into();
        check_position(&displacement.to_array())?;
        Ok(Self { displacement, rotation: None })
    }

    /// The motion from one pose to another, for example from before to after a solver's step. It turns the shorter way.
    ///
    /// Its end has the other's rotation, bit for bit, and its position up to two roundings of f64. Between poses with
    /// the same rotation it is a shift.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, glam::Quat};
    /// let from = Pose3::at([1.0, 2.0, 3.0])?;
    /// let to = Pose3::new([1.5, 2.0, 3.0], Quat::from_xyzw(0.0, 0.6, 0.0, 0.8))?;
    /// let motion = Motion3::between(&from, &to)?;
    /// assert_eq!((motion.pose_at(&from, 0.0), motion.pose_at(&from, 1.0)), (from, to));
    /// assert_eq!(Motion3::between(&to, &to)?, Motion3::STILL);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// Positions that are more than 1e9 m apart on an axis.
    pub fn between(from: &Pose3, to: &Pose3) -> Result<Self, PoseError> {
        let motion = Self::shift(to.position() - from.position())?;
        let [start, end] = [from, to].map(|pose| pose.rotation().to_array());
        let is_turned = start.map(f32::to_bits) != end.map(f32::to_bits);
        Ok(Self { rotation: is_turned.then_some(end), ..motion })
    }

    /// The motion of a body with constant velocities for a time: metres per second, and radians per second about an
    /// axis along `angular` through the body's position; both in world axes.
    ///
    /// It ends where the body would after a turn at constant speed, by `libm`, rounded to f32: the same bits on every
    /// platform. A turn of less than 1e-7 rad in a step may be lost, or doubled. On the way it turns the shorter way,
    /// so with half a turn or more in one step a wheel appears to run backwards: take shorter steps.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, glam::{DVec3, Vec3}};
    /// let from = Pose3::at([0.0, 2.0, 0.0])?;
    /// let motion = Motion3::of_velocities(&from, [3.0, 0.0, 0.0], Vec3::Y * core::f32::consts::FRAC_PI_2, 0.5)?;
    /// let to = motion.pose_at(&from, 1.0);
    /// assert_eq!(to.position(), DVec3::new(1.5, 2.0, 0.0));
    /// let ahead = to.transform(Vec3::Z) - to.position();
    /// assert!((ahead - DVec3::new(1.0, 0.0, 1.0).normalize()).length() < 1e-7, "an eighth of a turn");
    /// assert_eq!(Motion3::of_velocities(&from, Vec3::X, Vec3::ZERO, 1.0)?, Motion3::shift(Vec3::X)?);
    /// assert!(Motion3::of_velocities(&from, Vec3::X, Vec3::NAN, 1.0).is_err());
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// Numbers that are not finite, and a displacement beyond 1e9 m on an axis.
    pub fn of_velocities(
        from: &Pose3,
        linear: impl Into<DVec3>,
        angular: impl Into<DVec3>,
        seconds: f64,
    ) -> Result<Self, PoseError> {
        let displacement = linear.into() * seconds;
        let turn = angular.into() * seconds;
        let angle = turn.length();
        if angle == 0.0 {
            return Self::shift(displacement);
        }
        let axis = turn * (libm::sin(0.5 * angle) / angle);
        let [x, y, z, w] = unit(from.rotation().to_array().map(f64::from));
        let (v, cosine) = (DVec3::new(x, y, z), libm::cos(0.5 * angle));
        let (end, real) = (v * cosine + axis * w + axis.cross(v), cosine * w - axis.dot(v));
        Self::new(displacement, Quat::from_array([end.x, end.y, end.z, real].map(|value| value as f32)))
    }

    /// The displacement of the whole motion, in metres.
    #[inline]
    pub const fn displacement(&self) -> DVec3 {
        self.displacement
    }

    /// The rotation at the end, bit for bit as given; `None` for a motion that does not turn.
    #[inline]
    pub fn rotation(&self) -> Option<Quat> {
        self.rotation.map(Quat::from_array)
    }

    /// The pose of a body that starts at `from` after a fraction of the motion.
    ///
    /// - At 0 and below, or for NaN, it is `from` bit for bit.
    /// - At 1 and above the position is the sum, and the rotation the one at the end, bit for bit.
    /// - In between the rotation is rounded to f32, by less than 1.2e-7 rad, and the position to f64.
    /// - An end beyond 1e9 m on an axis is clamped, axis by axis, and the motion leads straight to there.
    pub fn pose_at(&self, from: &Pose3, fraction: f64) -> Pose3 {
        // NaN counts as zero.
        if fraction.is_nan() || fraction <= 0.0 {
            return *from;
        }
        let fraction = fraction.min(1.0);
        let limit = DVec3::splat(MAX_POSITION);
        let position = (from.position() + self.path(from) * fraction).clamp(-limit, limit);
        let rotation = match self.rotation {
            None => from.rotation(),
            Some(to) if fraction >= 1.0 => Quat::from_array(to),
            Some(_) => {
                let turn = self.turn(from);
                match turn.is_still() {
                    true => from.rotation(),
                    false => Quat::from_array(unit(turn.quaternion_at(fraction)).map(|value| value as f32)),
                }
            }
        };
        // Both are in range; the pose cannot be rejected.
        Pose3::new(position, rotation).unwrap_or(*from)
    }

    /// The whole way of a body that starts at `from`, in metres: the displacement, unless that leads beyond the range
    /// of poses.
    fn path(&self, from: &Pose3) -> DVec3 {
        let (limit, end) = (DVec3::splat(MAX_POSITION), from.position() + self.displacement);
        if end.abs().max_element() <= MAX_POSITION {
            return self.displacement;
        }
        end.clamp(-limit, limit) - from.position()
    }

    /// The turn of a body that starts at `from`. Cost: two square roots and a product of quaternions.
    pub fn turn(&self, from: &Pose3) -> Turn3 {
        let start = unit(from.rotation().to_array().map(f64::from));
        let Some(to) = self.rotation else {
            return Turn3 { from: start, to: start, axis: DVec3::X, sine: 0.0, cosine: 1.0 };
        };
        let end = unit(to.map(f64::from));
        let dot = |[a, b, c, d]: [f64; 4], [x, y, z, w]: [f64; 4]| (a * x + b * y) + (c * z + d * w);
        let cosine = dot(start, end);
        let end = if cosine < 0.0 { end.map(|value| -value) } else { end };
        // The vector part of q' conjugate(q): the axis times the sine of half the angle.
        let ([a, b, c, d], [x, y, z, w]) = (start, end);
        let (v, v_end) = (DVec3::new(a, b, c), DVec3::new(x, y, z));
        let across = v_end * d - v * w + v.cross(v_end);
        let sine = across.length();
        // If the rotations differ only by rounding, the axis is mere rounding, too.
        if sine <= STILL {
            return Turn3 { from: start, to: start, axis: DVec3::X, sine: 0.0, cosine: 1.0 };
        }
        Turn3 {
            from: start,
            to: end,
            axis: across / sine,
            sine: sine.min(1.0),
            cosine: cosine.abs().min(1.0),
        }
    }

    /// An upper bound on the angular speed of a body that starts at `from`, in radians per whole motion: at most 4, and
    /// at most 1.28 times that of an even turn.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, glam::{Quat, Vec3}};
    /// let quarter = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 1.0, 0.0, 1.0))?;
    /// let speed = quarter.turn_speed(&Pose3::IDENTITY);
    /// assert!(speed > core::f64::consts::FRAC_PI_2 && speed < 1.7, "{speed}");
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    pub fn turn_speed(&self, from: &Pose3) -> f64 {
        self.turn(from).top_speed()
    }
}

/// Sine of half the angle below which rotations are the same up to rounding of f64.
const STILL: f64 = 8.0 * f64::EPSILON;

/// A factor that covers the rounding of a bound's few operations.
const ROUNDED_UP: f64 = 1.0 + 32.0 * f64::EPSILON;

impl Turn3 {
    /// Whether it does not turn at all.
    #[inline]
    pub fn is_still(&self) -> bool {
        self.sine == 0.0
    }

    /// The unit axis that it turns about, in world axes; meaningless if it does not turn.
    #[inline]
    pub const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The greatest distance, over all fractions, of the tip of a unit arm from its start: twice the sine of half the
    /// angle, 2 for half a turn.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, glam::{Quat, Vec3}};
    /// let quarter = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 1.0, 0.0, 1.0))?.turn(&Pose3::IDENTITY);
    /// assert!(quarter.chord() >= 2_f64.sqrt() && quarter.chord() < 1.4143);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    #[inline]
    pub fn chord(&self) -> f64 {
        2.0 * self.sine * ROUNDED_UP
    }

    /// The quaternion x, y, z, w at a fraction from 0 to 1, not normalised: its length is between 0.7 and 1.
    #[inline]
    fn quaternion_at(&self, fraction: f64) -> [f64; 4] {
        let rest = 1.0 - fraction;
        let mut at = [0.0; 4];
        for (i, at) in at.iter_mut().enumerate() {
            *at = rest * self.from[i] + fraction * self.to[i];
        }
        at
    }

    /// The axes at a fraction from 0 to 1, in f64: right to some 40 units of 2^-53.
    #[inline]
    pub fn basis_at(&self, fraction: f64) -> Basis3 {
        Basis3::of_quaternion(self.quaternion_at(fraction))
    }

    /// The angular speed about the axis at a fraction from 0 to 1, in radians per whole motion.
    #[inline]
    pub fn speed_at(&self, fraction: f64) -> f64 {
        // |q(t)|^2 between unit quaternions, from the cosine of their angle.
        let squared = 1.0 - 2.0 * fraction * (1.0 - fraction) * (1.0 - self.cosine);
        2.0 * self.sine / squared
    }

    /// A bound on the angular speed, in radians per whole motion: the speed in the middle.
    #[inline]
    pub fn top_speed(&self) -> f64 {
        self.bounds_within(0.0, 1.0)[0]
    }

    /// Bounds on the angular speed and on its rate of change between two fractions, in radians per whole motion, and
    /// per whole motion squared.
    ///
    /// ```
    /// use asunder::{Motion3, Pose3, glam::{Quat, Vec3}};
    /// let turn = Motion3::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0))?.turn(&Pose3::IDENTITY);
    /// let [speed, change] = turn.bounds_within(0.0, 0.25);
    /// assert!(speed >= turn.speed_at(0.25) && speed < 3.3 && change > 4.0);
    /// assert_eq!(turn.bounds_within(0.0, 1.0)[0], turn.top_speed());
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    pub fn bounds_within(&self, from: f64, to: f64) -> [f64; 2] {
        if self.is_still() {
            return [0.0; 2];
        }
        // It is fastest where nearest to the middle; |q(t)|^2 changes fastest furthest from there.
        let nearest = (from - 0.5).max(0.5 - to).max(0.0);
        let furthest = (from - 0.5).abs().max((to - 0.5).abs());
        let share = 1.0 - self.cosine;
        // |q(t)|^2 at the point nearest to the middle.
        let squared = 1.0 - share * (0.5 - 2.0 * nearest * nearest);
        let speed = 2.0 * self.sine / squared * ROUNDED_UP;
        [speed.min(4.0), speed * (4.0 * share.max(0.0) * furthest) / squared * ROUNDED_UP]
    }
}

/// Normalises a quaternion of f32 numbers, or one between two such.
fn unit(q: [f64; 4]) -> [f64; 4] {
    let [x, y, z, w] = q;
    let length = ((x * x + y * y) + (z * z + w * w)).sqrt();
    q.map(|value| value / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(q: [f32; 4]) -> Pose3 {
        Pose3::new(DVec3::new(1.0, -2.0, 3.0), Quat::from_array(q)).unwrap()
    }

    /// Rotations near and far apart, of all lengths, and exactly half a turn.
    const ROTATIONS: [[f32; 4]; 8] = [
        [0.0, 0.0, 0.0, 1.0],
        [0.1, -0.2, 0.3, 0.4],
        [-0.1, 0.2, -0.3, -0.4],
        [1e-38, 2e-38, -1e-38, 3e-38],
        [1e38, -1e38, 0.5e38, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [1e-7, 0.0, 0.0, 1.0],
        [0.3, 0.2, 0.1, 0.0],
    ];

    #[test]
    fn both_ends_are_kept_bit_for_bit() {
        for from in ROTATIONS.map(pose) {
            for to in ROTATIONS.map(Quat::from_array) {
                let motion = Motion3::new([1.0, 2.0, 4.0], to).unwrap();
                for start in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
                    assert!(motion.pose_at(&from, start).same_bits(&from));
                }
                let end = Pose3::new(from.position() + DVec3::new(1.0, 2.0, 4.0), to).unwrap();
                for over in [1.0, 1.5, f64::INFINITY] {
                    assert!(motion.pose_at(&from, over).same_bits(&end));
                }
            }
        }
    }

    #[test]
    fn a_body_turns_about_its_axis_no_faster_than_told() {
        let steps = 512;
        for from in ROTATIONS.map(pose) {
            for to in ROTATIONS.map(Quat::from_array) {
                let motion = Motion3::new(DVec3::ZERO, to).unwrap();
                let turn = motion.turn(&from);
                let mut before = turn.basis_at(0.0);
                for step in 1..=steps {
                    let t = f64::from(step) / f64::from(steps);
                    let now = turn.basis_at(t);
                    let (x, y, z) = (now.x - before.x, now.y - before.y, now.z - before.z);
                    // The angle of a rotation between two bases, by the length of their difference.
                    let moved = ((x.length_squared() + y.length_squared() + z.length_squared()) / 8.0).sqrt();
                    let angle = 2.0 * libm::asin(moved.min(1.0));
                    let least = turn.speed_at(t).min(turn.speed_at(t - 1.0 / f64::from(steps)));
                    assert!(angle <= turn.top_speed() / f64::from(steps) + 1e-14, "{from:?} {to:?} {t}");
                    assert!(angle >= 0.99 * least / f64::from(steps) - 1e-14, "{angle} {least}");
                    let along = turn.axis();
                    assert!((now.turn_back(along) - before.turn_back(along)).length() < 1e-12, "{t}");
                    before = now;
                }
            }
        }
    }

    #[test]
    fn the_rounded_pose_is_where_the_body_is() {
        for from in ROTATIONS.map(pose) {
            for to in ROTATIONS.map(Quat::from_array) {
                let motion = Motion3::new(DVec3::ZERO, to).unwrap();
                let turn = motion.turn(&from);
                for t in [0.0, 0.1, 0.5, 0.9, 1.0] {
                    let (rounded, exact) = (motion.pose_at(&from, t).basis(), turn.basis_at(t));
                    for (a, b) in [(rounded.x, exact.x), (rounded.y, exact.y), (rounded.z, exact.z)] {
                        assert!((a - b).length() < 1.2e-7, "{from:?} {to:?} {t}: {a} {b}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_angular_speed_and_its_change_stay_within_their_bounds() {
        for to in ROTATIONS.map(Quat::from_array) {
            let turn = Motion3::new(DVec3::ZERO, to).unwrap().turn(&pose([0.2, 0.1, -0.5, 0.9]));
            for step in 0..1000 {
                let t = f64::from(step) / 1000.0;
                let change = (turn.speed_at(t + 1e-3) - turn.speed_at(t)).abs();
                for (from, to) in [(0.0, 1.0), (t, t + 1e-3), (t * 0.5, 1.0), (0.0, (t + 1e-3).max(0.25))] {
                    let [fastest, changing] = turn.bounds_within(from, to);
                    assert!(
                        turn.speed_at(t) <= fastest && turn.speed_at(t + 1e-3) <= fastest,
                        "{t} {from} {to}"
                    );
                    assert!(change <= changing * 1e-3 + 1e-12, "{t} {from} {to}: {change}");
                }
            }
        }
    }

    #[test]
    fn positions_end_at_the_edge_of_the_world() {
        let edge = Pose3::at([9e8, 0.0, 0.0]).unwrap();
        let motion = Motion3::shift([9e8, 1.0, 0.0]).unwrap();
        assert_eq!(motion.pose_at(&edge, 1.0).position(), DVec3::new(1e9, 1.0, 0.0));
        assert!(Motion3::shift([2e9, 0.0, 0.0]).is_err());
        assert_eq!(
            Motion3::new(DVec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 0.0)),
            Err(PoseError::ZeroRotation)
        );
    }

    /// By the formula of Rodrigues, without quaternions.
    fn rotated(v: DVec3, axis: DVec3, angle: f64) -> DVec3 {
        let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
        v * cosine + axis.cross(v) * sine + axis * (axis.dot(v) * (1.0 - cosine))
    }

    #[test]
    fn velocities_lead_where_a_steady_turn_does() {
        for from in ROTATIONS.map(pose) {
            for axis in [DVec3::X, DVec3::new(1.0, -2.0, 0.5), DVec3::new(-0.3, 0.1, 0.9)] {
                let axis = axis.normalize();
                for (speed, seconds) in
                    [(1e-9, 1.0), (0.3, 1.0 / 60.0), (12.0, 1.0 / 60.0), (3.0, 2.0), (-7.0, 30.0)]
                {
                    let motion = Motion3::of_velocities(&from, DVec3::Z, axis * speed, seconds).unwrap();
                    let to = motion.pose_at(&from, 1.0);
                    assert_eq!(to.position(), from.position() + DVec3::Z * seconds);
                    for arm in [DVec3::X, DVec3::Y, DVec3::Z] {
                        let truth = rotated(from.basis().turn(arm), axis, speed * seconds);
                        let off = (to.basis().turn(arm) - truth).length();
                        assert!(off < 3e-7, "{axis} {speed} {seconds}: {off}");
                    }
                }
            }
        }
    }

    #[test]
    fn velocities_that_are_no_numbers_are_refused() {
        let from = Pose3::IDENTITY;
        for odd in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(Motion3::of_velocities(&from, [odd, 0.0, 0.0], DVec3::Y, 1.0).is_err());
            assert!(Motion3::of_velocities(&from, DVec3::X, [0.0, odd, 0.0], 1.0).is_err());
            assert!(Motion3::of_velocities(&from, DVec3::X, DVec3::Y, odd).is_err());
        }
        assert!(Motion3::of_velocities(&from, DVec3::X * 2e9, DVec3::ZERO, 1.0).is_err());
        let fast = Motion3::of_velocities(&from, DVec3::ZERO, DVec3::Y * f64::MAX, 1e-300).unwrap();
        assert!(fast.rotation().is_some_and(|to| to.is_finite()));
    }
}
