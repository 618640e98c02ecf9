//! Motions in the plane: how a body moves from one pose to another.

use crate::pose2::{Pose2, Rotation2};
use crate::pose3::{PoseError, check_position};
use crate::tolerance::MAX_POSITION;
use glam::DVec2;

/// A motion in the plane: a displacement in metres and, if it turns, the rotation at the end.
///
/// The position moves along a straight line at constant speed. The rotation takes the shorter way round, in two halves:
/// to the rotation half way, then on to the end. In each half, cosine and sine are interpolated along the chord and
/// normalised: no trigonometry, and a half is at most a quarter turn, in which the speed changes by a factor of two at
/// most. Between exactly opposite rotations, it turns counter-clockwise.
///
/// ```
/// use asunder::{Motion2, Pose2, Rotation2, glam::DVec2};
/// let from = Pose2::at([1.0, 0.0])?;
/// let half_turn = Motion2::new([2.0, 0.0], Rotation2::new(-1.0, 0.0)?)?;
/// let middle = half_turn.pose_at(&from, 0.5);
/// assert_eq!((middle.position(), middle.rotation()), (DVec2::X * 2.0, Rotation2::new(0.0, 1.0)?));
/// assert_eq!(half_turn.pose_at(&from, 1.0).rotation().cos(), -1.0);
/// # Ok::<(), asunder::PoseError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion2 {
    displacement: DVec2,
    to: Option<Rotation2>,
}

impl Motion2 {
    /// Neither moves nor turns.
    pub const STILL: Self = Self { displacement: DVec2::ZERO, to: None };

    /// A displacement in metres (`Vec2`, `DVec2`, or an array of f64), and the absolute rotation at the end (not one
    /// relative to the start). For a motion without rotation: [`shift`](Self::shift).
    ///
    /// # Errors
    /// A displacement that is not finite, or beyond [`MAX_POSITION`](crate::tolerance::MAX_POSITION) on an axis.
    pub fn new(displacement: impl Into<DVec2>, to: Rotation2) -> Result<Self, PoseError> {
        Ok(Self { to: Some(to), ..Self::shift(displacement)? })
    }

    /// A displacement in metres. The body keeps its rotation.
    ///
    /// ```
    /// use asunder::{Motion2, Pose2, Rotation2, glam::DVec2};
    /// let from = Pose2::new([0.0, 0.0], Rotation2::new(0.6, 0.8)?)?;
    /// let shift = Motion2::shift(DVec2::X)?;
    /// assert_eq!((shift.displacement(), shift.rotation()), (DVec2::X, None));
    /// assert_eq!((shift.pose_at(&from, 1.0).rotation(), shift.turn_speed(&from)), (from.rotation(), 0.0));
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// As [`Motion2::new`].
    pub fn shift(displacement: impl Into<DVec2>) -> Result<Self, PoseError> {
        let displacement = displacement.into();
        check_position(&displacement.to_array())?;
        Ok(Self { displacement, to: None })
    }

    /// The motion from one pose to another, for example from before to after a solver's step. It turns the shorter way.
    ///
    /// Its end has the other's rotation, bit for bit, and its position up to two roundings of f64. Between poses with
    /// the same rotation it is a shift.
    ///
    /// ```
    /// use asunder::{Motion2, Pose2, Rotation2};
    /// let (from, to) = (Pose2::at([1.0, 2.0])?, Pose2::new([1.5, 2.0], Rotation2::new(0.6, 0.8)?)?);
    /// let motion = Motion2::between(&from, &to)?;
    /// assert_eq!((motion.pose_at(&from, 0.0), motion.pose_at(&from, 1.0)), (from, to));
    /// assert_eq!(Motion2::between(&to, &to)?, Motion2::STILL);
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// Positions that are more than [`MAX_POSITION`](crate::tolerance::MAX_POSITION) apart on an axis.
    pub fn between(from: &Pose2, to: &Pose2) -> Result<Self, PoseError> {
        let motion = Self::shift(to.position() - from.position())?;
        let bits = |pose: &Pose2| [pose.rotation().cos().to_bits(), pose.rotation().sin().to_bits()];
        Ok(Self { to: (bits(from) != bits(to)).then_some(to.rotation()), ..motion })
    }

    /// The motion of a body with constant velocities for a time: metres per second, and radians per second
    /// counter-clockwise about its position.
    ///
    /// It ends where the body would after a turn at constant speed, by `libm`, rounded to f32: the same bits on every
    /// platform. A turn of less than 1e-7 rad in a step may be lost, or doubled. On the way it turns the shorter way,
    /// so with half a turn or more in one step a wheel appears to run backwards: take shorter steps.
    ///
    /// ```
    /// use asunder::{Motion2, Pose2, glam::{DVec2, Vec2}};
    /// let from = Pose2::at([0.0, 2.0])?;
    /// let motion = Motion2::of_velocities(&from, [3.0, 0.0], core::f64::consts::FRAC_PI_2, 0.5)?;
    /// let to = motion.pose_at(&from, 1.0);
    /// assert_eq!(to.position(), DVec2::new(1.5, 2.0));
    /// assert!((f64::from(to.rotation().angle()) - core::f64::consts::FRAC_PI_4).abs() < 1e-7, "an eighth of a turn");
    /// assert_eq!(Motion2::of_velocities(&from, Vec2::X, 0.0, 1.0)?, Motion2::shift(Vec2::X)?);
    /// assert!(Motion2::of_velocities(&from, Vec2::X, f64::NAN, 1.0).is_err());
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    ///
    /// # Errors
    /// Numbers that are not finite, and a displacement beyond [`MAX_POSITION`](crate::tolerance::MAX_POSITION) on an
    /// axis.
    pub fn of_velocities(
        from: &Pose2,
        linear: impl Into<DVec2>,
        angular: f64,
        seconds: f64,
    ) -> Result<Self, PoseError> {
        let (displacement, angle) = (linear.into() * seconds, angular * seconds);
        if angle == 0.0 {
            return Self::shift(displacement);
        }
        let turn = DVec2::new(libm::cos(angle), libm::sin(angle));
        let end = turn.rotate(DVec2::new(from.rotation().cos().into(), from.rotation().sin().into()));
        Self::new(displacement, Rotation2::new(end.x as f32, end.y as f32)?)
    }

    /// The displacement of the whole motion, in metres.
    #[inline]
    pub const fn displacement(&self) -> DVec2 {
        self.displacement
    }

    /// The rotation at the end; `None` for a motion that does not turn.
    #[inline]
    pub const fn rotation(&self) -> Option<Rotation2> {
        self.to
    }

    /// The pose of a body that starts at `from` after a fraction of the motion.
    ///
    /// - At 0 and below, or for NaN, it is `from` bit for bit.
    /// - At 1 and above the position is the rounded sum, and the rotation the one at the end, bit for bit.
    /// - In between the position is off by some roundings of f64, the rotation by less than 1e-7 rad.
    /// - An end beyond the range of poses is clamped, axis by axis, and the motion leads straight to there.
    ///
    /// Cost: constant.
    pub fn pose_at(&self, from: &Pose2, fraction: f64) -> Pose2 {
        if fraction.is_nan() || fraction <= 0.0 {
            return *from;
        }
        let (start, end) = (from.position(), self.end(from));
        let rotation = match self.to {
            Some(to) if fraction < 1.0 => between(from.rotation(), to, fraction),
            Some(to) => to,
            None => from.rotation(),
        };
        let limit = DVec2::splat(MAX_POSITION);
        let place = if fraction < 1.0 { start + (end - start) * fraction } else { end };
        // A position in range is never rejected.
        Pose2::new(place.clamp(-limit, limit), rotation).unwrap_or(*from)
    }

    /// An upper bound on the angular speed, in radians per whole motion: at most 1.28 times that of an even turn. Zero
    /// if it does not turn. Cost: constant.
    ///
    /// ```
    /// use asunder::{Motion2, Pose2, Rotation2};
    /// let half_turn = Motion2::new([0.0, 0.0], Rotation2::new(-1.0, 0.0)?)?;
    /// let speed = half_turn.turn_speed(&Pose2::IDENTITY);
    /// assert!(speed >= 4.0 && speed < 4.001, "{speed}");
    /// # Ok::<(), asunder::PoseError>(())
    /// ```
    pub fn turn_speed(&self, from: &Pose2) -> f64 {
        let Some(to) = self.to.filter(|to| *to != from.rotation()) else { return 0.0 };
        let (first, last) = (vector(from.rotation()), vector(to));
        let middle = half_way(first, last);
        // The speed along a chord is the area it spans over its squared distance from the origin.
        let speed = |from: DVec2, to: DVec2| {
            let nearest = (from + to) * 0.5;
            from.perp_dot(to).abs() / nearest.length_squared()
        };
        // Twice, as each half takes half the time. Lengths are one up to the rounding of f32, and so the nearest point
        // is the middle up to that.
        2.0 * speed(first, middle).max(speed(middle, last)) * (1.0 + 1e-6)
    }

    fn end(&self, from: &Pose2) -> DVec2 {
        let limit = DVec2::splat(MAX_POSITION);
        (from.position() + self.displacement).clamp(-limit, limit)
    }
}

fn vector(rotation: Rotation2) -> DVec2 {
    DVec2::new(f64::from(rotation.cos()), f64::from(rotation.sin()))
}

/// The unit vector half way from one to the other, the shorter way round; counter-clockwise if both ways are equally
/// long.
///
/// It is along the sum, and perpendicular to the difference; the longer of the two is used.
fn half_way(from: DVec2, to: DVec2) -> DVec2 {
    if from.dot(to) >= 0.0 {
        return (from + to).normalize();
    }
    let change = to - from;
    let left = DVec2::new(change.y, -change.x).normalize();
    if from.perp_dot(to) >= 0.0 { left } else { -left }
}

/// The rotation at a fraction of the way, strictly between 0 and 1.
fn between(from: Rotation2, to: Rotation2, fraction: f64) -> Rotation2 {
    if from == to {
        return from;
    }
    let middle = stored(half_way(vector(from), vector(to)), from);
    let (start, end, share) = match fraction {
        half if half < 0.5 => (from, middle, half * 2.0),
        0.5 => return middle,
        half => (middle, to, half * 2.0 - 1.0),
    };
    let (start, end) = (vector(start), vector(end));
    stored((start + (end - start) * share).normalize(), from)
}

/// A unit vector as a rotation. It is never rejected.
fn stored(unit: DVec2, instead: Rotation2) -> Rotation2 {
    Rotation2::new(unit.x as f32, unit.y as f32).unwrap_or(instead)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(angle: f64) -> Rotation2 {
        Rotation2::from_angle(angle as f32).unwrap()
    }

    fn angle_of(rotation: Rotation2) -> f64 {
        libm::atan2(f64::from(rotation.sin()), f64::from(rotation.cos()))
    }

    #[test]
    fn the_ends_are_bit_equal_and_odd_fractions_are_taken_as_ends() {
        let from = Pose2::new([1e8 + 0.1, -3.0], turned(0.3)).unwrap();
        let motion = Motion2::new([0.7, 1e3], turned(2.9)).unwrap();
        let end = Pose2::new([1e8 + 0.1 + 0.7, 997.0], turned(2.9)).unwrap();
        for fraction in [0.0, -0.0, -1.0, f64::NEG_INFINITY, f64::NAN] {
            assert!(motion.pose_at(&from, fraction).same_bits(&from));
        }
        for fraction in [1.0, 1.5, f64::INFINITY] {
            assert!(motion.pose_at(&from, fraction).same_bits(&end));
        }
    }

    #[test]
    fn it_takes_the_shorter_way_and_turns_no_faster_than_it_says() {
        for (start, turn) in [(0.0, 3.1), (2.0, -3.1), (-1.0, 1e-3), (0.5, 1.6), (3.0, -1.5), (0.4, 3.12)] {
            let from = Pose2::new([0.0, 0.0], turned(start)).unwrap();
            let motion = Motion2::new([0.0, 0.0], turned(start + turn)).unwrap();
            let speed = motion.turn_speed(&from);
            assert!(
                speed >= turn.abs() - 1e-6 && speed <= 1.5 * turn.abs() + 1e-6,
                "{start} {turn}: {speed}"
            );
            let mut last = from.rotation();
            for step in 1..=1000 {
                let next = motion.pose_at(&from, f64::from(step) / 1000.0).rotation();
                let by = vector(last).perp_dot(vector(next));
                assert!(by * turn.signum() >= -2e-7, "{start} {turn}: it turns back by {by}");
                assert!(by.abs() <= speed / 1000.0 + 2e-7, "{start} {turn}: {by} in a step, {speed}");
                last = next;
            }
            assert_eq!(last, turned(start + turn));
        }
    }

    #[test]
    fn opposite_rotations_turn_counter_clockwise() {
        for rotation in [(1.0, 0.0), (0.0, 1.0), (-0.6, 0.8), (0.28, -0.96)] {
            let from = Pose2::new([0.0, 0.0], Rotation2::new(rotation.0, rotation.1).unwrap()).unwrap();
            let (cos, sin) = (from.rotation().cos(), from.rotation().sin());
            let motion = Motion2::new([0.0, 0.0], Rotation2::new(-cos, -sin).unwrap()).unwrap();
            let middle = motion.pose_at(&from, 0.5).rotation();
            assert_eq!((middle.cos(), middle.sin()), (-sin, cos));
            let quarter = motion.pose_at(&from, 0.25).rotation();
            let by = angle_of(
                Rotation2::new(
                    cos * quarter.cos() + sin * quarter.sin(),
                    cos * quarter.sin() - sin * quarter.cos(),
                )
                .unwrap(),
            );
            assert!((by - core::f64::consts::FRAC_PI_4).abs() < 1e-6, "{by}");
        }
    }

    #[test]
    fn a_motion_out_of_the_world_ends_at_its_edge() {
        let from = Pose2::at([9e8, -9e8]).unwrap();
        let motion = Motion2::shift([1e9, -5e7]).unwrap();
        assert_eq!(motion.pose_at(&from, 1.0).position(), DVec2::new(1e9, -9.5e8));
        assert_eq!(motion.pose_at(&from, 0.5).position(), DVec2::new(9.5e8, -9.25e8));
        assert!(Motion2::shift([f64::NAN, 0.0]).is_err() && Motion2::shift([0.0, 2e9]).is_err());
    }

    #[test]
    fn velocities_lead_where_a_steady_turn_does() {
        for from in [0.0, 0.5, -3.0, 2.0].map(turned) {
            let from = Pose2::new(DVec2::X, from).unwrap();
            for (speed, seconds) in
                [(1e-9, 1.0), (0.3, 1.0 / 60.0), (-12.0, 1.0 / 60.0), (3.0, 2.0), (7.0, 30.0)]
            {
                let motion = Motion2::of_velocities(&from, DVec2::Y, speed, seconds).unwrap();
                let to = motion.pose_at(&from, 1.0);
                assert_eq!(to.position(), DVec2::new(1.0, seconds));
                let off = angle_of(to.rotation()) - angle_of(from.rotation()) - speed * seconds;
                assert!(libm::sin(off).abs() < 3e-7 && libm::cos(off) > 0.0, "{speed} {seconds}: {off}");
            }
        }
        let from = Pose2::IDENTITY;
        for odd in [f64::NAN, f64::INFINITY] {
            assert!(Motion2::of_velocities(&from, [odd, 0.0], 1.0, 1.0).is_err());
            assert!(Motion2::of_velocities(&from, DVec2::X, odd, 1.0).is_err());
            assert!(Motion2::of_velocities(&from, DVec2::X, 1.0, odd).is_err());
        }
    }
}
