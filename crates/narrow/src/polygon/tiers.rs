//! Whether two convex shapes share a point, in three tiers, each used only where the one before cannot decide.
//!
//! ```text
//! Bound    the first test: axes of sharp shapes, a distance in closed form, or as below
//! Double   an axis that separates them, or corners around a common point, each by more than rounding   (distance)
//! Exact    integers, from the corners where f64 stopped                                                (exact)
//! ```

use super::convex::{ClosedForm, Convex};
use super::distance::{Close, Reached, Until, Witness, distance};
use super::outline::Outline;
use super::sat::{Sides, doubt, sides};
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Corner};
use asunder_geometry::glam::DVec2;

/// How two cores lie, as far as the distance iteration got.
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one pair")]
pub(super) enum Cores {
    /// Overlapping, or at most this far apart, in metres.
    Within(f64),
    /// Two bounds on their distance, with witness points.
    Between(Witness),
}

impl Convex<'_> {
    /// Whether the shapes share a point: the answer of [`Convex::probe`], in the cheapest way.
    ///
    /// For polygons of few edges that is a test of all axes; for others a search for a direction that separates them,
    /// or for corners around a common point.
    pub(crate) fn verdict(&self) -> Verdict {
        if self.has_line() {
            return self.closed_form_verdict(&self.closed_form_of_lines());
        }
        self.with_outlines(|a, b| {
            let edges = a.edge_count() + b.edge_count();
            if edges == 0 {
                return self.closed_form_verdict(&self.closed_form_of_points(a, b));
            }
            if self.measure.radii == 0.0 {
                return match sides(a, b, self.towards_b(), doubt(&self.measure.precision)) {
                    Sides::Apart => Verdict { overlapping: false, tier: Tier::Bound },
                    Sides::Overlapping if !is_thin(a, b) => Verdict { overlapping: true, tier: Tier::Bound },
                    _ => self.look_closer(a, b, None).0,
                };
            }
            let verdict = self.conclude(distance(a, b, unit(self.towards_b()), &self.until_decided())).0;
            // The test that is tried first is the first tier.
            let tier = if verdict.tier == Tier::Exact { Tier::Exact } else { Tier::Bound };
            Verdict { tier, ..verdict }
        })
    }

    /// The first tier's guess whether they overlap, also where its number is within its error of zero.
    pub(crate) fn guess(&self) -> bool {
        if let [Some(a), Some(b)] = self.lines() {
            return a.separation_from(&b, || true) <= 0.0;
        }
        if self.has_line() {
            return self.closed_form_of_lines().separation <= 0.0;
        }
        self.with_outlines(|a, b| {
            let edges = a.edge_count() + b.edge_count();
            if edges == 0 {
                return self.closed_form_of_points(a, b).separation <= 0.0;
            }
            if self.measure.radii == 0.0 {
                return sides(a, b, self.towards_b(), 0.0) != Sides::Apart;
            }
            let until = Until {
                beyond: self.measure.radii,
                within: self.measure.radii,
                precision: &self.measure.precision,
            };
            match distance(a, b, unit(self.towards_b()), &until) {
                Reached::Between(witness) => witness.distance <= self.measure.radii,
                Reached::Origin(_) => true,
            }
        })
    }

    /// For shapes of which at least one is a half-plane.
    fn closed_form_of_lines(&self) -> ClosedForm {
        match self.lines() {
            [Some(a), Some(b)] => self.closed_form_of_half_planes(a, b),
            [Some(line), _] | [_, Some(line)] => {
                self.with_outlines(|a, b| self.closed_form_of_half_plane(line, if line.is_b { a } else { b }))
            }
            [None, None] => self.with_outlines(|a, b| self.closed_form_of_points(a, b)),
        }
    }

    /// From A's centre to B's, of any length: a direction to start a search with.
    pub(super) fn towards_b(&self) -> DVec2 {
        let center_b = self.offset + self.turn_b.turn(self.shape_b.center().as_dvec2());
        center_b - self.turn_a.turn(self.shape_a.center().as_dvec2())
    }

    /// For a yes or no, a distance is known well enough once it shows whether the radii close the gap.
    fn until_decided(&self) -> Until<'_> {
        let doubt = self.measure.precision.projection();
        Until {
            beyond: self.measure.radii + doubt,
            within: self.measure.radii - 2.0 * doubt,
            precision: &self.measure.precision,
        }
    }

    /// Whether the shapes overlap, given their separation in closed form.
    pub(super) fn closed_form_verdict(&self, result: &ClosedForm) -> Verdict {
        let doubt = 2.0 * self.measure.precision.projection();
        if result.separation.abs() > doubt {
            return Verdict { overlapping: result.separation < 0.0, tier: Tier::Bound };
        }
        self.exactly(&[])
    }

    /// The second tier and the third, and how the cores lie. `best` is the best separation that the first tier found,
    /// and its axis.
    ///
    /// Of the two lower bounds, the iteration's and the best axis', the better one is kept.
    pub(super) fn look_closer(
        &self,
        a: &Outline,
        b: &Outline,
        best: Option<(f64, DVec2)>,
    ) -> (Verdict, Cores) {
        let towards = best.map_or_else(|| unit(self.towards_b()), |(_, normal)| normal);
        let mut reached = distance(a, b, towards, &Until::met(&self.measure.precision));
        let mut tier = Tier::Double;
        if let (Reached::Between(witness), Some((separation, normal))) = (&mut reached, best)
            && separation >= witness.at_least
        {
            if witness.is_close(self.measure.precision.size) {
                witness.across = normal;
            }
            (witness.at_least, witness.normal) = (separation, normal);
            tier = Tier::Bound;
        }
        let (verdict, witness) = self.conclude(reached);
        let tier = if verdict.tier == Tier::Double && !verdict.overlapping { tier } else { verdict.tier };
        (Verdict { tier, ..verdict }, witness)
    }

    /// What the distance iteration has proved; where it has proved nothing, the third tier's answer.
    fn conclude(&self, reached: Reached) -> (Verdict, Cores) {
        let doubt = self.measure.precision.projection();
        let double = |overlapping: bool| Verdict { overlapping, tier: Tier::Double };
        let witness = match reached {
            Reached::Origin(Close { is_proved: true, .. }) => return (double(true), Cores::Within(0.0)),
            Reached::Origin(close) => {
                let verdict = self.exactly(&close.corners);
                let do_overlap = self.measure.radii == 0.0 && verdict.overlapping;
                return (verdict, Cores::Within(if do_overlap { 0.0 } else { close.within }));
            }
            Reached::Between(witness) => witness,
        };
        if witness.at_least - self.measure.radii > doubt {
            return (double(false), Cores::Between(witness));
        }
        if self.measure.radii > 0.0 && witness.distance - self.measure.radii < -2.0 * doubt {
            return (double(true), Cores::Between(witness));
        }
        let verdict = self.exactly(&witness.corners);
        let do_overlap = self.measure.radii == 0.0 && verdict.overlapping;
        (verdict, if do_overlap { Cores::Within(0.0) } else { Cores::Between(witness) })
    }

    /// The third tier, from the corners where f64 stopped.
    fn exactly(&self, start: &[Corner]) -> Verdict {
        let overlapping = exact::overlaps2([&self.sites[0], &self.sites[1]], start);
        Verdict { overlapping, tier: Tier::Exact }
    }
}

/// A direction normalised; for none, any unit vector.
pub(super) fn unit(direction: DVec2) -> DVec2 {
    direction.try_normalize().unwrap_or(DVec2::X)
}

/// Whether neither core has an interior: both may lie on one line, and have no candidate axis along it.
pub(super) fn is_thin(a: &Outline, b: &Outline) -> bool {
    a.is_flat() && b.is_flat()
}
