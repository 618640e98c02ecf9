//! What a body that touches some of another meets next: whether that is level with what it touches, in the plane and in
//! space.
//!
//! ```text
//! touched at the start: no answer, it is a contact already
//! every other part, where it is met first, by the normal n that it is met with:
//!   of compounds: flush with a touched part along the normal m of its contact, and the body is never deeper below that than half
//!             its thickness: level (the next slab of a floor, whose side looks like a wall; ground has normals of its own
//!             for inner edges)
//!   gap       along n at the start, no more than a 64th of the body's thickness, and
//!   closing   along n from the start to the deepest, less what goes into the touched anyway, no more than that too:
//!             level, and passed over (the next triangle of a floor, a bend of half a degree)
//!   who turns and is deeper along n at the start than in the touched, as another axis parts the two: closing counts from where
//!             they meet
//!   else:     an impact
//! where A touches others, as the tile that it stands on; of anything but ground that is touched as well:
//!   flush with one of those, and A never deeper below it than half its thickness: level; half-spaces reach along their normals alone,
//!   and are flush with nothing
//! where nothing is met within the first half thickness of the way: ground that the body has a manifold with at that point, and moves
//!   into, is an impact at the start
//! ```
//! That last rule is for ground that is touched but has no manifold, since its neighbour's stands for it: a ball in a
//! hollow touches two faces where they meet, stands on one, and runs into the other.
//!
//! Along n alone, one who turns may begin deep in what stands a metre beside it. By the time that it meets that, it has
//! turned out along n, and how deep it goes in again is not seen from where it began. What does not turn goes in along
//! n all the way or comes out all the way. Along a hill's later faces it begins deep as well, and only comes out: so a
//! depth at the start is no impact by itself.
//!
//! What goes into the touched is what a game's solver takes out of the motion: (d.m) (m.n) for a contact's normal m. So
//! a body that is pressed to a floor runs over its seams and over bends that fall, and into ramps and walls. A body
//! that passes over ends no deeper in it than that 64th beyond what it does in the touched. What a motion sinks into
//! the touched by all its thickness, as a coin that falls for a frame while it lies, passes under what stands there.
//!
//! Which of the two moves is not asked: a touch has no motion of its own, and the tiles of a lift, each a body, all rise
//! into who stands on them. So what is flush at the start and swings into A is passed over too, until it would come half
//! a thickness deep; it is a contact in the next frame.

mod contacts;
#[cfg(test)]
mod tests;

use asunder_geometry::tolerance::{NEXT_LEVEL, NEXT_THICKNESS};
pub(crate) use contacts::{AlongAxis, Contacts};
use contacts::{Axis, Bundle, Holds};

/// Share of a body's thickness by which it may sink into what it touches, and be led over what is flush with that.
const SUNK: f64 = 0.5;

/// How the next meeting of two parts relates to the contacts that there are already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lies {
    /// Further on.
    Ahead,
    /// Beside it, and gone into no further.
    Level,
    /// Beside it, and gone into.
    Across,
}

/// Two parts on their way, along axes from A to B.
pub(crate) struct Passing<'p, V> {
    /// That of the thinner of the two, in metres: [`thickness`].
    pub(crate) thickness: f64,
    /// Whether one is ground, whose inner edges have the normals of its faces.
    pub(crate) is_on_ground: bool,
    /// Whether one is a half-space, which reaches along its own normal alone.
    pub(crate) is_endless: bool,
    /// Their gap along an axis at the start.
    pub(crate) gap: &'p dyn Fn(V) -> f64,
    /// By how much that gap closes from a fraction of the motion on, to where it is least after that.
    pub(crate) closing: &'p dyn Fn(V, f64) -> f64,
    /// The fraction at which who turns meets the other; zero where nobody turns, and for what is touched at the start.
    pub(crate) met_at: f64,
    pub(crate) reach: Reach,
}

/// By how much a gap along an axis, and what is made of it, differs from that along another.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    /// How far a point of B is from one of A at most, in metres: at the start, and at any time.
    pub(crate) arms: [f64; 2],
    /// What the sum of all lengths that a gap is made of loses to rounding.
    pub(crate) rounding: f64,
}

impl Reach {
    /// Of two parts as far apart as their bounding balls say, which go so far against each other. The lengths that a
    /// gap is a sum of may be longer.
    pub(crate) fn new(start: f64, way: f64, lengths: f64) -> Self {
        // A stored rotation of the plane stretches by its length, which is one up to the rounding of f32.
        let grown = |arm: f64| arm * (1.0 + 8.0 * f64::from(f32::EPSILON));
        Self { arms: [grown(start), grown(start + way)], rounding: 1024.0 * f64::EPSILON * lengths }
    }
}

impl<V: Axis> Passing<'_, V> {
    /// Classifies a meeting along a unit axis, given the contacts between the two bodies, where they touch, and all
    /// that A touches.
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

    /// Whether the two reach further into each other along a unit axis, at the start, than any of what is touched
    /// accounts for, and are met later.
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

    /// Whether what the motion leads into the touched explains, but for the slack, how far it leads in along a unit
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

    /// Whether it stands up no higher than a contact, and no further down than the body reaches, which in the end is no
    /// deeper below that than half its thickness, and was not at the start.
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
        // Of a contact that is high enough, and one that is no deeper in than that.
        let highest = most.min(above + off + slack);
        let lowest = (closing - self.closes_by(bundle)).max(0.0) - SUNK * self.thickness;
        if lowest - self.reach.rounding > highest { Holds::No } else { Holds::Perhaps }
    }

    /// By how much more or less than along a contact's axis a gap closes along those laid out behind it, at most.
    fn closes_by(&self, bundle: &Bundle) -> f64 {
        let Reach { arms: [start, ever], rounding } = self.reach;
        (start + ever) * bundle.spread + 2.0 * rounding
    }
}

/// What a convex part counts for: how thick it is from its middle, for a core with planes at these heights above its
/// middle, around which there is a radius; all in metres, as its outer radius is.
pub(crate) fn thickness(heights: impl Iterator<Item = f64>, radius: f32, outer: f32) -> f64 {
    let inner = heights.fold(f64::INFINITY, f64::min);
    let inner = if inner.is_finite() { inner.max(0.0) } else { 0.0 };
    (inner + f64::from(radius)).max(NEXT_THICKNESS * f64::from(outer))
}

/// The thinner of two, where ground and what has no end do not count.
pub(crate) fn thinner(of: [Option<f64>; 2]) -> f64 {
    let least = of.into_iter().flatten().fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// The share of a motion that is half a thickness, where it leads by so many metres at most.
pub(crate) fn half_through(thickness: f64, way: f64) -> f64 {
    (SUNK * thickness / way).min(1.0)
}
