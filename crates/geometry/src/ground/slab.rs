//! When a box that moves along a line meets boxes at rest.

use crate::aabb::Aabb3;
use glam::{DVec3, Vec3};

/// A box that moves along a line, or a ray, for slab tests against the columns, rows and heights of a field.
///
/// In f64, and widened by more than its rounding, so that no box is missed: times are right to a few units in the last
/// place of the coordinates that went into them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    from: DVec3,
    direction: DVec3,
    /// One over each component of the direction; meaningless where that is zero.
    pace: DVec3,
    grown: DVec3,
}

impl Slab {
    /// `None` if a number is not finite or a half extent negative.
    pub(crate) fn new(from: DVec3, direction: DVec3, grown: Vec3) -> Option<Self> {
        let grown = grown.as_dvec3();
        let is_good = from.is_finite() && direction.is_finite() && grown.is_finite();
        (is_good && grown.min_element() >= 0.0).then_some(Self {
            from,
            direction,
            pace: direction.recip(),
            grown,
        })
    }

    /// The part of a time interval in which the moving box overlaps an interval on an axis, never too short; `None` if
    /// it never does.
    #[inline(always)]
    pub(crate) fn over(
        &self,
        axis: usize,
        [low, high]: [f32; 2],
        [enter, leave]: [f64; 2],
    ) -> Option<[f64; 2]> {
        let (from, along, grown) = (self.from[axis], self.direction[axis], self.grown[axis]);
        let pace = self.pace[axis];
        let (low, high) = (f64::from(low), f64::from(high));
        let slack = LOST * (low.abs() + high.abs() + from.abs() + grown);
        let (low, high) = (low - grown - from - slack, high + grown - from + slack);
        if along == 0.0 {
            // No motion on this axis: inside all the time, or never.
            return (low <= 0.0 && high >= 0.0).then_some([enter, leave]);
        }
        let (first, last) = if along > 0.0 { (low * pace, high * pace) } else { (high * pace, low * pace) };
        let (first, last) = (first - LOST * first.abs(), last + LOST * last.abs());
        let (first, last) =
            (if first > enter { first } else { enter }, if last < leave { last } else { leave });
        (first <= last).then_some([first, last])
    }

    /// The interval on an axis that the moving box covers in a time interval, never too small.
    #[inline(always)]
    pub(crate) fn reach(&self, axis: usize, time: [f64; 2]) -> [f64; 2] {
        let (from, along, grown) = (self.from[axis], self.direction[axis], self.grown[axis]);
        // Without motion, times may be infinite.
        let [start, end] = if along == 0.0 { [from; 2] } else { time.map(|time| from + along * time) };
        let (low, high) = if start < end { (start, end) } else { (end, start) };
        let slack = LOST * (low.abs() + high.abs() + from.abs() + grown);
        [low - grown - slack, high + grown + slack]
    }
}

/// More than the relative error of a few roundings in a row.
const LOST: f64 = 8.0 * f64::EPSILON;

/// The distance between two boxes, in metres, never too great.
#[inline(always)]
pub(crate) fn gap(one: &Aabb3, low: [f32; 3], high: [f32; 3]) -> f64 {
    let mut squares = 0.0;
    for axis in 0..3 {
        let above = f64::from(low[axis]) - f64::from(one.max[axis]);
        let below = f64::from(one.min[axis]) - f64::from(high[axis]);
        let gap = if above > 0.0 { above } else { 0.0 };
        let gap = if below > gap { below } else { gap };
        squares += gap * gap;
    }
    squares.sqrt() * (1.0 - 4.0 * f64::EPSILON)
}
