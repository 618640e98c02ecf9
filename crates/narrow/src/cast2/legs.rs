//! Which parts of a compound a ball may meet on its way within a stretch, where either body turns: its path, as the
//! compound sees it, in straight legs.
//!
//! ```text
//! x(t)      the ball's centre from the compound's position, in world axes: an arm that turns, on a straight way
//! y = u*x   the same in the compound's axes, as complex numbers, u* its rotation conjugated: here parts stand still
//! y''       = u*''x + 2 u*'x' + u*x'',  |u'| <= speed and |u''| <= swerve; the arm's derivatives likewise
//! leg       from y(s) to y(e) in a straight line: y is never further from it than  max|y''| (e - s)^2 / 8
//! ```
//! The last line is the error of linear interpolation. Let n point from the leg to y at the time at which they are
//! furthest apart. Along n their difference is zero at both ends, and its second derivative is no less than -m, m =
//! max|y''|; so it is below the parabola m (t - s) (e - t) / 2, which has that second derivative everywhere and is zero
//! at both ends too. Its top is m (e - s)^2 / 8. So a ball on the leg, larger by that, contains the true one at each
//! time. Until this larger ball meets a part's box or bounding circle, nothing in the true one meets the part.
//!
//! No number of the search for the meeting enters here, so none need be trusted: parts that are left out are certainly
//! apart, and the others are tested in the order of their numbers, each up to the first meeting known, as if none had
//! been left out. The ball is also larger by the gap that counts as met, so that parts which pass within that gap get
//! the same answer.
//!
//! Measured gains stand beside its twin in space, `cast3::legs`.

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

/// The most legs of a path.
const MAX_LEGS: usize = 32;

/// How far a leg may lie off the path, as a share of the radii of the ball and of the compound's parts.
const BESIDE: f64 = 0.5;

/// The path of a ball past a compound, from the start of a stretch to a time.
pub(super) struct Legs {
    legs: ArrayVec<Leg, MAX_LEGS>,
    /// An upper bound on what is lost to sums, and to rotations that are not quite of unit length, where the two are
    /// near.
    lost: f64,
}

/// A straight piece of the path, in the compound's axes.
struct Leg {
    /// The time at which it begins, and for how long it lasts.
    from: f64,
    span: f64,
    start: DVec2,
    way: DVec2,
    /// Radius of a ball that contains the moving one at all times of the leg.
    radius: f64,
}

impl Legs {
    /// The path, as a compound (A, 0, or B, 1) sees it, of a ball around a piece of the other body, or around all of
    /// it, until a time.
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
        let (mut from, mut start) = (0.0, in_axes_of(stretch, which, other.center, 0.0));
        let mut legs = ArrayVec::new();
        for number in 1..=count as usize {
            let to = until * (number as f64 / count);
            let end = in_axes_of(stretch, which, other.center, to);
            let (way, radius) = (end - start, radius + beside(from, to));
            legs.push(Leg { from, span: to - from, start, way, radius });
            (from, start) = (to, end);
        }
        Self { legs, lost }
    }

    /// Lists the parts whose boxes may be met, each at least once.
    pub(super) fn walk(&self, compound: &Compound2, numbers: &mut Vec<u32>) {
        for leg in &self.legs {
            let grown = Region2 { center: leg.start, radius: leg.radius }.grown(leg.way, compound);
            compound.visit_along(leg.start, leg.way, grown, 1.0, |index| {
                numbers.push(index);
                1.0
            });
        }
    }

    /// A time before which a circle around a point of the compound, in its axes, is not met; `None` if it never is.
    pub(super) fn first_meeting(&self, center: DVec2, radius: f64) -> Option<f64> {
        self.legs.iter().find_map(|leg| leg.meeting(center, radius + self.lost, self.lost))
    }
}

impl Leg {
    /// The same for this leg; all that is computed on the way is off by less than `lost` metres.
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
        // The rounding of a share is less than that of a time.
        Some((self.from + self.span * (first / pace) - 4.0 * f64::EPSILON).max(self.from))
    }
}

/// A point of the other body, given in that body's axes, as seen in the axes of body `which` at a time.
fn in_axes_of(stretch: &Stretch, which: usize, point: DVec2, at: f64) -> DVec2 {
    let (arm, offset) = (stretch.spins[1 - which].turn_at(at).turn(point), stretch.offset_at(at));
    stretch.spins[which].turn_at(at).turn_back(if which == 0 { offset + arm } else { arm - offset })
}

/// A typical size of the parts of a compound: the mean of three bounding radii.
fn size_of_parts(compound: &Compound2) -> f64 {
    let parts = compound.parts();
    let some = [parts.first(), parts.get(parts.len() / 2), parts.last()];
    some.into_iter().flatten().map(|part| f64::from(part.shape().outer_radius())).sum::<f64>() / 3.0
}
