//! How a character walks, in sanitised numbers.

use super::{Linear, Walk, Walks};
use crate::space::Space;
use asunder_geometry::tolerance::{LEAST_SKIN, MAX_RADIUS, SKIN, UPRIGHT};

impl<N> Walk<N> {
    /// The defaults for a shape of this bounding radius.
    pub(super) fn for_size(size: f64, up: N) -> Self {
        // A half-space cannot walk.
        let size = if size.is_finite() { size as f32 } else { 0.0 };
        let step = 0.35 * size;
        Self { up, skin: SKIN * size, steepest: STEEPEST, step, snap: step }
    }
}

/// 45.6 degrees.
const STEEPEST: f32 = 0.7;

/// A [`Walk`] in f64, with numbers in range.
pub(super) struct Gait<P> {
    /// Unit, or zero.
    pub(super) up: P,
    pub(super) skin: f64,
    pub(super) steepest: f64,
    pub(super) step: f64,
    pub(super) snap: f64,
}

impl<P: Linear> Gait<P> {
    pub(super) fn of<S: Walks<Point = P>>(walk: &Walk<S::Vector>, shape: &S::Shape, pose: &S::Pose) -> Self {
        let length = |value: f32| f64::from(value.clamp(0.0, MAX_RADIUS).max(0.0));
        let steepest = if walk.steepest.is_nan() { STEEPEST } else { walk.steepest.clamp(0.0, 1.0) };
        Self {
            up: S::wide(walk.up).unit().unwrap_or(P::ZERO),
            skin: length(walk.skin).max(least_skin::<S>(shape, pose)),
            // An upright wall is no ground, whatever a game sets.
            steepest: f64::from(steepest).max(UPRIGHT),
            step: length(walk.step),
            snap: length(walk.snap),
        }
    }

    /// The part of a vector that is neither up nor down.
    pub(super) fn level(&self, v: P) -> P {
        v - self.up * v.dot(self.up)
    }
}

/// The least gap that is kept: more than the rounding of positions.
pub(super) fn least_skin<S: Walks>(shape: &S::Shape, pose: &<S as Space>::Pose) -> f64 {
    let rounding = S::position(pose).length() * (64.0 * f64::EPSILON);
    (LEAST_SKIN * S::size(shape)).max(rounding)
}
