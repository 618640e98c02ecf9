//! What of a compound a ball may meet on its way within a stretch, where either body turns: as the compound sees it,
//! in straight legs.
//!
//! ```text
//! x(t)      the ball's centre from the compound's position, in world axes: an arm that turns, on a straight way
//! y = u*x   the same in the compound's axes, as complex numbers, u* its rotation conjugated: here parts stand still
//! y''       = u*''x + 2 u*'x' + u*x'',  |u'| <= speed and |u''| <= swerve; the arm's derivatives likewise
//! leg       from y(s) to y(e) in a straight line: y is never further from it than  max|y''| (e - s)^2 / 8
//! ```
//! The last line is that of linear interpolation. Let n point from the leg to y at the time at which they are furthest
//! apart. Along n their difference is zero at both ends, and its second derivative is no less than -m, m = max|y''|; so
//! it is below the parabola m (t - s) (e - t) / 2, which has that second derivative everywhere and is zero at both ends
//! too. Its top is m (e - s)^2 / 8. So a ball on the leg, larger by that, holds the true one at each time. A part whose
//! box, or whose bounding circle, that larger ball does not meet until a time is met by nothing in the true one until
//! then. No number of the search for the meeting is part of this, so none need be trusted: what is left out is apart
//! for certain, and what is left is asked in the order of its numbers, each until what is known, as if nothing had been
//! left out. The ball is larger, too, by as much as counts as having met, so that of parts that pass within that the
//! same is told.
//!
//! What it brought stands beside its twin in space, `cast3::legs`.

#[cfg(test)]
mod tests;

use super::piece::Piece;
use super::stretch::Stretch;
use super::sum;
use crate::among::Region2;
use crate::counted::count_step;
use arrayvec::ArrayVec;
use asunder_geometry::Compound2;
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::CAST_GAP2;

/// Legs of a way at most.
const MAX_LEGS: usize = 32;

/// Share of what a ball and a part of the compound may measure by which a leg may be beside the way.
const BESIDE: f64 = 0.5;

/// The way of a ball past a compound, from the start of a stretch to a time.
pub(super) struct Legs {
    legs: ArrayVec<Leg, MAX_LEGS>,
    /// More than sums, and rotations that are not quite of unit length, lose where the two are near.
    lost: f64,
}

/// A straight piece of it, in the compound's axes.
struct Leg {
    /// The time at which it begins, and for how long it lasts.
    from: f64,
    span: f64,
    start: DVec2,
    way: DVec2,
    /// That of a ball that holds the moved one at any time of it.
    radius: f64,
}

impl Legs {
    /// The way of a ball about a piece of the other body, or about all of it, as a compound sees it, A (0) or B (1),
    /// until a time.
    pub(super) fn new(
        stretch: &Stretch,
        (compound, which): (&Compound2, usize),
        (other, until): (&Piece, f64),
    ) -> Self {
        let size = f64::from(compound.outer_radius());
        let arms = [size + compound.center().as_dvec2().length(), other.center.length()];
        let spins = [&stretch.spins[which], &stretch.spins[1 - which]];
        let sizes = other.outer + arms[0] + arms[1];
        let lost = 16.0 * f64::from(f32::EPSILON) * sizes
            + 256.0 * f64::EPSILON * (sum(stretch.offset) + sum(stretch.velocity));
        let turned = 4.0 * (spins[0].rounding * arms[0] + spins[1].rounding * arms[1]);
        let radius = other.outer + CAST_GAP2 * (other.outer + size) + 2.0 * stretch.lost(1.0) + turned + lost;
        let pace = stretch.velocity.length() + spins[1].speed * arms[1];
        let beside = |from: f64, to: f64| {
            let ends = [from, to].map(|at| stretch.offset_at(at).length());
            let bend = spins[0].swerve * (ends[0].max(ends[1]) + arms[1])
                + 2.0 * spins[0].speed * pace
                + spins[1].swerve * arms[1];
            0.125 * bend * (to - from) * (to - from) * (1.0 + 1e-6)
        };
        let count = (beside(0.0, until) / (BESIDE * (radius + size_of_parts(compound)))).sqrt().ceil();
        let count = count.clamp(1.0, MAX_LEGS as f64);
        let (mut from, mut start) = (0.0, seen(stretch, which, other.center, 0.0));
        let mut legs = ArrayVec::new();
        for number in 1..=count as usize {
            let to = until * (number as f64 / count);
            let end = seen(stretch, which, other.center, to);
            let (way, radius) = (end - start, radius + beside(from, to));
            legs.push(Leg { from, span: to - from, start, way, radius });
            (from, start) = (to, end);
        }
        Self { legs, lost }
    }

    /// Lists the parts whose boxes may be met, each once or more.
    pub(super) fn walk(&self, compound: &Compound2, numbers: &mut Vec<u32>) {
        for leg in &self.legs {
            let grown = Region2 { center: leg.start, radius: leg.radius }.grown(leg.way, compound);
            compound.visit_along(leg.start, leg.way, grown, 1.0, |index| {
                numbers.push(index);
                1.0
            });
        }
    }

    /// A time before which what is about a point of the compound, in its axes, is not met; nothing where it never
    /// is.
    pub(super) fn first_meeting(&self, center: DVec2, radius: f64) -> Option<f64> {
        self.legs.iter().find_map(|leg| leg.meeting(center, radius + self.lost, self.lost))
    }
}

impl Leg {
    /// The same, in this leg; all that is computed on the way is off by less than `lost` metres.
    fn meeting(&self, center: DVec2, radius: f64, lost: f64) -> Option<f64> {
        count_step();
        let (apart, reach) = (self.start - center, self.radius + radius);
        let pace = self.way.length();
        if pace <= lost {
            return (apart.length() <= reach + lost).then_some(self.from);
        }
        let along = self.way / pace;
        let ahead = -apart.dot(along);
        let beside = (apart + along * ahead).length();
        if beside > reach {
            return None;
        }
        let half_chord = ((reach - beside) * (reach + beside)).sqrt();
        let (first, last) = (ahead - half_chord, ahead + half_chord);
        if first > pace || last < 0.0 {
            return None;
        }
        // A share's rounding is less than a time's.
        Some((self.from + self.span * (first / pace) - 4.0 * f64::EPSILON).max(self.from))
    }
}

/// A point of the other body, given in its axes, in the axes of a body at a time.
fn seen(stretch: &Stretch, which: usize, point: DVec2, at: f64) -> DVec2 {
    let (arm, offset) = (stretch.spins[1 - which].turn_at(at).turn(point), stretch.offset_at(at));
    stretch.spins[which].turn_at(at).turn_back(if which == 0 { offset + arm } else { arm - offset })
}

/// About what the parts of a compound measure: the mean of three bounding radii.
fn size_of_parts(compound: &Compound2) -> f64 {
    let parts = compound.parts();
    let some = [parts.first(), parts.get(parts.len() / 2), parts.last()];
    some.into_iter().flatten().map(|part| f64::from(part.shape().outer_radius())).sum::<f64>() / 3.0
}
