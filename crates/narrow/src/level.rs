//! What a body that already touches parts of another meets next, and whether that is level with what it touches; for
//! the plane and for space.
//!
//! ```text
//! parts touched at the start: no answer, they are contacts already
//! every other part, at its first meeting, whose normal is n:
//!   compounds   flush with a touched part along the normal m of that contact, and the body never deeper below that
//!               than half its thickness: level (the next slab of a floor, whose side looks like a wall)
//!               not so for ground: its inner edges have the normals of its faces
//!   gap         along n at the start, at most a 64th of the body's thickness, and
//!   closing     along n from the start to the deepest moment, less what goes into the touched parts anyway, at most
//!               that too: level, and passed over (the next triangle of a floor, a bend of half a degree)
//!   if a body turns and is deeper along n at the start than in what it touches, since another axis separates the two:
//!               closing counts from where they meet
//!   else        an impact
//! where A also touches other bodies, such as the tile that it stands on; for all but ground that is itself touched:
//!   flush with one of those, and A never deeper below it than half its thickness: level
//!   half-spaces are never flush: they reach along their own normals alone
//! where nothing is met within the first half thickness of the way:
//!   ground that the body has a manifold with at that point, and moves into, is an impact at the start
//! ```
//! The last rule is for ground that is touched but has no manifold, since its neighbour's stands for it: a ball in a
//! hollow touches two faces where they meet, stands on one, and runs into the other.
//!
//! Why closing may have to count from the meeting: along n alone, a body that turns may begin deep in a part that
//! stands a metre beside it. By the time the two meet it has turned out along n, and how deep it goes in again cannot
//! be seen from where it began. A body that does not turn goes in along n all the way or comes out all the way. Along a
//! hill's later faces a body begins deep as well, and only comes out: so a depth at the start is no impact by itself.
//!
//! What goes into the touched parts is what a game's solver takes out of a motion d: (d.m) (m.n) for a contact's normal
//! m. So a body that is pressed to a floor runs over its seams and over bends that fall, and into ramps and walls. A
//! body that passes over a part ends no deeper in it than in what it touches, but for that 64th. A motion that sinks a
//! body into what it touches by all its thickness, as a coin that falls for a frame while it lies, leads it under what
//! stands there.
//!
//! Which of the two bodies moves does not matter: a touch has no motion of its own, and the tiles of a lift, each a
//! body, all rise into whatever stands on them. So what is flush at the start and swings into A is passed over too,
//! unless it would come half a thickness deep; it is a contact in the next frame.

mod contacts;
#[cfg(test)]
mod tests;

use asunder_geometry::tolerance::{NEXT_LEVEL, NEXT_THICKNESS};
pub(crate) use contacts::{AlongAxis, Contacts};
use contacts::{Axis, Bundle, Holds};

/// Share of a body's thickness by which it may sink into what it touches and still pass over what is flush with that.
const SUNK: f64 = 0.5;

/// How the next meeting of two parts relates to the contacts at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lies {
    /// Without contact at the start, or not close along the normal.
    Ahead,
    /// Level with a contact: passed over.
    Level,
    /// Close along the normal at the start, and moved into by more than contacts explain.
    Across,
}

/// Two parts of bodies that move, along axes from A to B.
pub(crate) struct Passing<'p, V> {
    /// That of the thinner of the two parts, in metres: see [`thickness`].
    pub(crate) thickness: f64,
    /// Whether one is ground, whose inner edges have the normals of its faces.
    pub(crate) is_on_ground: bool,
    /// Whether one is a half-space, which reaches along its own normal alone.
    pub(crate) is_endless: bool,
    /// Their gap along an axis at the start.
    pub(crate) gap: &'p dyn Fn(V) -> f64,
    /// By how much that gap closes from a fraction of the motion to the time at which it is least after that.
    pub(crate) closing: &'p dyn Fn(V, f64) -> f64,
    /// The fraction at which the two meet, if either turns; else zero, as for what is touched at the start.
    pub(crate) met_at: f64,
    pub(crate) reach: Reach,
}

/// Bounds how much a gap, and what is computed from it, changes with the axis that it is measured along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// The furthest that a point of B is from one of A, in metres: at the start, and at any time.
    pub(crate) arms: [f64; 2],
    /// Rounding error of the sum of all lengths that a gap is computed from.
    pub(crate) rounding: f64,
}

impl Reach {
    /// Of two parts whose points are at most `start` apart, by their bounding balls, and which move by `way` against
    /// each other. The lengths that a gap is a sum of may be longer.
    pub(crate) fn new(start: f64, way: f64, lengths: f64) -> Self {
        // A stored rotation of the plane stretches by its length, which is one up to the rounding of f32.
        let grown = |arm: f64| arm * (1.0 + 8.0 * f64::from(f32::EPSILON));
        Self { arms: [grown(start), grown(start + way)], rounding: 1024.0 * f64::EPSILON * lengths }
    }
}

impl<V: Axis> Passing<'_, V> {
    /// Classifies a meeting along a unit axis, given the contacts between the two bodies, if they touch, and all that A
    /// touches.
    pub(crate) fn lies(
        &self,
        normal: V,
        touched: Option<&Contacts<impl AlongAxis>>,
        beside: &Contacts<impl AlongAxis>,
    ) -> Lies {
        let has_inner_edges = self.is_on_ground && touched.is_some();
        let may_be_flush = !self.is_endless && !has_inner_edges;
        let is_flush = |bundle: &Bundle| self.is_flush(bundle);
        if may_be_flush && (beside.any(is_flush) || touched.is_some_and(|touched| touched.any(is_flush))) {
            return Lies::Level;
        }
        let Some(touched) = touched else { return Lies::Ahead };
        let slack = NEXT_LEVEL * self.thickness;
        if (self.gap)(normal) > slack {
            return Lies::Ahead;
        }
        let from = if self.begins_deep(normal, touched) { self.met_at } else { 0.0 };
        let into = (self.closing)(normal, from);
        let is_level = into <= slack || touched.any(|bundle| self.goes_anyway(normal, into, bundle));
        if is_level { Lies::Level } else { Lies::Across }
    }

    /// Whether the two reach further into each other along a unit axis at the start than any contact accounts for, and
    /// meet later.
    fn begins_deep(&self, normal: V, touched: &Contacts<impl AlongAxis>) -> bool {
        if self.met_at <= 0.0 {
            return false;
        }
        let (gap, slack) = ((self.gap)(normal), NEXT_LEVEL * self.thickness);
        let accounts = |bundle: &Bundle| {
            let along = V::of(bundle.axis).dot(normal);
            if gap >= bundle.separation * along.max(0.0) - slack {
                return Holds::Yes;
            }
            let deepest = bundle.separations[0].min(0.0) * (along + bundle.spread).max(0.0);
            if gap < deepest - slack - self.reach.rounding { Holds::No } else { Holds::Perhaps }
        };
        gap < -slack && !touched.any(accounts)
    }

    /// Whether what the motion leads into a touched part explains, within the slack, how far it leads in along a unit
    /// axis.
    fn goes_anyway(&self, normal: V, into: f64, bundle: &Bundle) -> Holds {
        let slack = NEXT_LEVEL * self.thickness;
        let axis = V::of(bundle.axis);
        let (closing, along) = ((self.closing)(axis, 0.0), axis.dot(normal));
        if into - closing.max(0.0) * along.max(0.0) <= slack {
            return Holds::Yes;
        }
        let Reach { rounding, .. } = self.reach;
        let most = (closing + self.closes_by(bundle)).max(0.0) * (along + bundle.spread + rounding).max(0.0);
        if into - most > slack + rounding { Holds::No } else { Holds::Perhaps }
    }

    /// Whether the two are flush, along a contact's axis: the part that is met rises no higher than what is touched,
    /// and begins no lower than the body ends; and the body is never deeper below that contact than half its thickness,
    /// at the start or later.
    fn is_flush(&self, bundle: &Bundle) -> Holds {
        let slack = NEXT_LEVEL * self.thickness;
        let axis = V::of(bundle.axis);
        let above = (self.gap)(axis);
        let off = self.reach.arms[0] * bundle.spread + self.reach.rounding;
        let [least, most] = bundle.separations;
        if above - off > slack || above + off < least - slack {
            return Holds::No;
        }
        let closing = (self.closing)(axis, 0.0);
        let deepest = closing.max(0.0) - bundle.separation;
        if above <= slack && above >= bundle.separation - slack && deepest <= SUNK * self.thickness {
            return Holds::Yes;
        }
        // A contact that qualifies has a separation from `lowest` (not too deep) to `highest` (not risen above).
        let highest = most.min(above + off + slack);
        let lowest = (closing - self.closes_by(bundle)).max(0.0) - SUNK * self.thickness;
        if lowest - self.reach.rounding > highest { Holds::No } else { Holds::Perhaps }
    }

    /// The most by which the gap along the axes behind a contact closes more, or less, than along its own.
    fn closes_by(&self, bundle: &Bundle) -> f64 {
        let Reach { arms: [start, ever], rounding } = self.reach;
        (start + ever) * bundle.spread + 2.0 * rounding
    }
}

/// A convex part's thickness from its middle, in metres: the least height of its core's planes above its middle, plus
/// the radius around the core; but at least a small share of its outer radius.
pub(crate) fn thickness(heights: impl Iterator<Item = f64>, radius: f32, outer: f32) -> f64 {
    let inner = heights.fold(f64::INFINITY, f64::min);
    let inner = if inner.is_finite() { inner.max(0.0) } else { 0.0 };
    (inner + f64::from(radius)).max(NEXT_THICKNESS * f64::from(outer))
}

/// The lesser of two thicknesses; ground, and what has no end, has none that counts.
pub(crate) fn thinner(of: [Option<f64>; 2]) -> f64 {
    let least = of.into_iter().flatten().fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// The share of a motion that is half a thickness, for a motion of at most `way` metres.
pub(crate) fn half_through(thickness: f64, way: f64) -> f64 {
    (SUNK * thickness / way).min(1.0)
}
