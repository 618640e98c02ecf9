//! Which parts of a compound a ball may meet on its way, where either body turns: its path, as the compound sees it, in
//! straight legs.
//!
//! ```text
//! x(t)    the ball's centre from the compound's position, in world axes: an arm that turns, on a straight way
//! y = Tx  the same in the compound's axes, T its rotation undone: here its parts stand still
//! y''     = T''x + 2 T'x' + Tx'',  |T'| <= w and |T''| <= w^2 + |w'| of a turn at speed w; the arm likewise
//! leg     from y(s) to y(e) in a straight line: y is never further from it than  max|y''| (e - s)^2 / 8
//! ```
//! The last line is the error of linear interpolation. Let n point from the leg to y at the time at which they are
//! furthest apart. Along n their difference is zero at both ends, and its second derivative is no less than -m, m =
//! max|y''|; so it is below the parabola m (t - s) (e - t) / 2, which has that second derivative everywhere and is zero
//! at both ends too. Its top is m (e - s)^2 / 8. So a ball on the leg, larger by that, contains the true one at each
//! time. Until this larger ball meets a part's box or bounding sphere, nothing in the true one meets the part.
//!
//! No number of the search for the meeting enters here, so none need be trusted: parts that are left out are certainly
//! apart, and the others are tested in the order of their numbers, each up to the first meeting known, as if none had
//! been left out. The ball is also larger by the gap that counts as met, so that parts which pass within that gap get
//! the same answer.
//!
//! What a quarter turn cost before and costs now, while one of two bodies of balls and boxes flies at the other, in ms
//! (Intel Xeon, family 6 model 85, 2026-11-28, a busy machine; in the plane squares, see `cast2`):
//!
//! | parts of each | 64 | 512 | 4,096 |
//! |---|---|---|---|
//! | cubes | 0.27 to 0.12 | 4.9 to 0.34 | 172 to 1.7 |
//!
//! | parts of each | 64 | 484 | 4,096 |
//! |---|---|---|---|
//! | squares | 0.14 to 0.05 | 4.8 to 0.27 | 303 to 2.0 |
//!
//! Bars of 4,096 parts in a row, which turn by half: 6,900 to 24; in the plane 18,500 to 23.

#[cfg(test)]
mod tests;

use super::passage::{Passage, length};
use crate::among::{Region3, in_order, many3};
use crate::counted::count_step;
use crate::pair3::{Part, for_parts, for_parts_along};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::IMPACT_GAP;
use asunder_geometry::{Compound3, Shape3};

/// The most legs of a path.
const MAX_LEGS: usize = 32;

/// How far a leg may lie off the path, as a share of the radii of the ball and of the compound's parts.
const BESIDE: f64 = 0.5;

/// The path of a ball past a compound, from the start to a fraction of the motion.
pub(super) struct Legs {
    legs: ArrayVec<Leg, MAX_LEGS>,
    /// An upper bound on what all sums here lose to rounding.
    lost: f64,
}

/// A straight piece of the path, in the compound's axes.
struct Leg {
    /// The fraction at which it begins, and for how long it lasts.
    from: f64,
    span: f64,
    start: DVec3,
    way: DVec3,
    /// Radius of a ball that contains the moving one at all times of the leg.
    radius: f64,
}

impl Passage {
    /// Visits, in the order of their numbers, the convex parts of a body, A (0) or B (1), that may meet a part of the
    /// other body, or all of it, until a fraction; each with a fraction before which it certainly does not. May visit
    /// other parts too. The visitor says when to stop; returns whether it did.
    pub(super) fn for_parts_met<'a>(
        &self,
        (shape, i): (&'a Shape3, usize),
        other: &Part,
        until: f64,
        mut visit: impl FnMut(Part<'a>, f64) -> bool,
    ) -> bool {
        let basis = &self.bases[i];
        // An endless shape is everywhere.
        let many = many3(shape).filter(|_| other.shape.outer_radius().is_finite());
        let Some(compound) = many else { return for_parts(shape, basis, |part| visit(part, 0.0)) };
        if self.is_straight() {
            let region = self.region(i, compound, other);
            return for_parts_along(compound, basis, region, until, |part| visit(part, 0.0));
        }
        let legs = self.legs((compound, i), other, until);
        let visit_met = |index: u32| {
            let part = &compound.parts()[index as usize];
            let met = legs.first_meeting(part.center(), part.shape().outer_radius().into());
            met.is_some_and(|from| visit(Part::of(compound, index, basis), from))
        };
        in_order(|numbers| legs.walk(compound, numbers), visit_met)
    }

    /// Where the parts of a compound are that may meet a part of the other body, or all of it, if neither body turns: a
    /// region at the start, and how that region moves.
    fn region(&self, i: usize, compound: &Compound3, other: &Part) -> (Region3, DVec3) {
        let (center, way) = match i {
            0 => (self.between + other.center, -self.drift),
            _ => (other.center - self.between, self.drift),
        };
        let radius = f64::from(other.shape.outer_radius());
        let met = IMPACT_GAP * (radius + f64::from(compound.outer_radius()));
        (Region3 { center, radius: radius + met + self.rounding }, way)
    }

    /// The path, as a compound sees it, of a ball around a part of the other body, or around all of it.
    fn legs(&self, (compound, i): (&Compound3, usize), other: &Part, until: f64) -> Legs {
        let radius = f64::from(other.shape.outer_radius());
        let size = f64::from(compound.outer_radius());
        let arms = [other.center.length(), size + compound.center().as_dvec3().length()];
        let far = length(self.between) + length(self.drift);
        let lost = 2048.0 * f64::EPSILON * (radius + arms[0] + arms[1] + far);
        // Rotations of poses are rounded to f32.
        let turned = 2.0 * f64::from(f32::EPSILON) * (arms[0] + arms[1]);
        let radius = radius + IMPACT_GAP * (radius + size) + self.rounding + turned + lost;
        let beside =
            |from: f64, to: f64| 0.125 * self.bend(i, arms[0], [from, to]) * (to - from) * (to - from);
        let count = (beside(0.0, until) / (BESIDE * (radius + size_of_parts(compound)))).sqrt().ceil();
        let count = count.clamp(1.0, MAX_LEGS as f64);
        let local = self.bases[1 - i].turn_back(other.center);
        let (mut from, mut start) = (0.0, self.in_axes_of(i, local, 0.0));
        let mut legs = ArrayVec::new();
        for number in 1..=count as usize {
            let to = until * (number as f64 / count);
            let end = self.in_axes_of(i, local, to);
            let (way, radius) = (end - start, radius + beside(from, to));
            legs.push(Leg { from, span: to - from, start, way, radius });
            (from, start) = (to, end);
        }
        Legs { legs, lost }
    }

    /// A point of the other body, given in that body's axes, as seen in the axes of body `i` at a fraction.
    fn in_axes_of(&self, i: usize, point: DVec3, fraction: f64) -> DVec3 {
        let basis = |i: usize| self.turns[i].map_or(self.bases[i], |turn| turn.basis_at(fraction));
        let (arm, between) = (basis(1 - i).turn(point), self.between_at(fraction));
        basis(i).turn_back(if i == 0 { between + arm } else { arm - between })
    }

    /// A bound on the acceleration, as body `i` sees it, of a point of the other body at the end of an arm.
    fn bend(&self, i: usize, arm: f64, [from, to]: [f64; 2]) -> f64 {
        let bounds = |i: usize| self.turns[i].map_or([0.0; 2], |turn| turn.bounds_within(from, to));
        let ([speed, change], [other_speed, other_change]) = (bounds(i), bounds(1 - i));
        let apart = self.between_at(from).length().max(self.between_at(to).length()) + arm;
        let pace = self.drift.length() + other_speed * arm;
        let bend = (change + speed * speed) * apart
            + 2.0 * speed * pace
            + (other_change + other_speed * other_speed) * arm;
        bend * (1.0 + 64.0 * f64::EPSILON)
    }
}

impl Legs {
    /// Lists the parts whose boxes may be met, each at least once.
    fn walk(&self, compound: &Compound3, numbers: &mut Vec<u32>) {
        for leg in &self.legs {
            let grown = Region3 { center: leg.start, radius: leg.radius }.grown(leg.way, compound);
            compound.visit_along(leg.start, leg.way, grown, 1.0, |index| {
                numbers.push(index);
                1.0
            });
        }
    }

    /// A fraction before which a sphere around a point of the compound, in its axes, is not met; `None` if it never is.
    fn first_meeting(&self, center: DVec3, radius: f64) -> Option<f64> {
        self.legs.iter().find_map(|leg| leg.meeting(center, radius + self.lost, self.lost))
    }
}

impl Leg {
    /// The same for this leg; all that is computed on the way is off by less than `lost` metres.
    fn meeting(&self, center: DVec3, radius: f64, lost: f64) -> Option<f64> {
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
        // The rounding of a share is less than that of a fraction.
        Some((self.from + self.span * (first / pace) - 4.0 * f64::EPSILON).max(self.from))
    }
}

/// A typical size of the parts of a compound: the mean of three bounding radii.
fn size_of_parts(compound: &Compound3) -> f64 {
    let parts = compound.parts();
    let some = [parts.first(), parts.get(parts.len() / 2), parts.last()];
    some.into_iter().flatten().map(|part| f64::from(part.shape().outer_radius())).sum::<f64>() / 3.0
}
