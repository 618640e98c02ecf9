//! When a box that moves on a line meets boxes at rest.

use crate::aabb::Aabb3;
use glam::{DVec3, Vec3};

/// A box that moves on a line, or a ray: what triangles' boxes are asked by.
///
/// In f64, and widened by more than it may round, so that no box is lost: a slab's time is right to a few units in
/// the last place of the coordinates that went into it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slab {
    from: DVec3,
    direction: DVec3,
    grown: DVec3,
}

impl Slab {
    /// Nothing where a number is not finite, or a half extent negative.
    pub(crate) fn new(from: DVec3, direction: DVec3, grown: Vec3) -> Option<Self> {
        let grown = grown.as_dvec3();
        let is_good = from.is_finite() && direction.is_finite() && grown.is_finite();
        (is_good && grown.min_element() >= 0.0).then_some(Self { from, direction, grown })
    }

    /// When the moving box first meets this one, in lengths of the direction, not above; nothing where it never does.
    #[inline(always)]
    pub(crate) fn enters(&self, low: [f32; 3], high: [f32; 3]) -> Option<f64> {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let (from, along, grown) = (self.from[axis], self.direction[axis], self.grown[axis]);
            let (low, high) = (f64::from(low[axis]), f64::from(high[axis]));
            let slack = LOST * (low.abs() + high.abs() + from.abs() + grown);
            let (low, high) = (low - grown - from - slack, high + grown - from + slack);
            if along == 0.0 {
                // Standing still on this axis: inside all the time, or never.
                if low > 0.0 || high < 0.0 {
                    return None;
                }
                continue;
            }
            let (first, last) =
                if along > 0.0 { (low / along, high / along) } else { (high / along, low / along) };
            let (first, last) = (first - LOST * first.abs(), last + LOST * last.abs());
            enter = if first > enter { first } else { enter };
            leave = if last < leave { last } else { leave };
        }
        (enter <= leave).then_some(enter)
    }
}

/// More than a few roundings in a row can lose.
const LOST: f64 = 8.0 * f64::EPSILON;

/// The distance between two boxes, in metres, not above.
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
