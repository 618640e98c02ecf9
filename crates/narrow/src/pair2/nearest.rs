//! Which pairs of parts may be near enough, or nearest, in the plane.

use super::Pair2;
use super::part::{Part, for_nearest_parts, for_parts, for_parts_near};
use crate::among::{Region2, many2};
use crate::feature::Hint;
use crate::least::Least;
use crate::polygon::measure::{Probe, Query};
use crate::precision::round_down;

impl<'a> Pair2<'a> {
    /// Calls `visit` for all pairs of parts that may be as near as the nearest so far, until it returns that it has
    /// enough.
    ///
    /// Parts of a compound of many are visited roughly nearest first. With two such compounds, one close pair is
    /// measured first, and whatever is further apart is left out. With compounds of few parts, all pairs in order.
    pub(super) fn visit_nearest<P>(
        &self,
        least: &mut Least<P>,
        mut visit: impl FnMut(&mut Least<P>, [Part<'a>; 2]) -> bool,
    ) {
        let whole_b = Part::whole(self.shape_b, &self.turn_b);
        let mut within = least.reach();
        // A bound for parts that no tree visits.
        least.give_up(if self.has_many_parts() { round_down(within) } else { f32::INFINITY });
        match [self.shape_a, self.shape_b].map(many2) {
            [Some(a), None] => {
                let others = self.around_b(&whole_b, 0.0);
                return for_nearest_parts(a, &self.turn_a, others, within, |a| {
                    let is_enough = for_parts(self.shape_b, &self.turn_b, |b| visit(least, [a, b]));
                    if is_enough { -1.0 } else { least.reach() }
                });
            }
            [None, Some(b)] => {
                let others = self.around_a(&Part::whole(self.shape_a, &self.turn_a), 0.0);
                return for_nearest_parts(b, &self.turn_b, others, within, |b| {
                    let is_enough = for_parts(self.shape_a, &self.turn_a, |a| visit(least, [a, b]));
                    if is_enough { -1.0 } else { least.reach() }
                });
            }
            [Some(_), Some(_)] => within = within.min(self.no_further_than()),
            [None, None] => {}
        }
        let beside_b = || self.around_b(&whole_b, within);
        for_parts_near(self.shape_a, &self.turn_a, beside_b, |a| {
            if least.passes_over(self.gap(&a, &whole_b)) {
                return false;
            }
            let within = within.min(least.reach());
            let beside_a = || self.around_a(&a, within);
            for_parts_near(self.shape_b, &self.turn_b, beside_a, |b| visit(least, [a, b]))
        });
    }

    /// An upper bound on the separation, from two parts that are near each other; zero if they overlap. No search need
    /// look further.
    fn no_further_than(&self) -> f64 {
        let middle_a = self.turn_a.turn(self.shape_a.center().as_dvec2());
        let b = Part::nearest(self.shape_b, &self.turn_b, middle_a - self.between);
        let a = Part::nearest(self.shape_a, &self.turn_a, self.between + b.center);
        let b = Part::nearest(self.shape_b, &self.turn_b, a.center - self.between);
        let query = Query { limit: f64::INFINITY, hint: Hint::NONE, points: false };
        match self.parts(a, b).convex.probe(&query) {
            Probe::Near(near) => (f64::from(near.separation) + f64::from(near.error)).max(0.0),
            Probe::Beyond(..) => f64::INFINITY,
        }
    }

    /// The region in which parts of A may be within a distance of a part of B, or of B as a whole.
    pub(super) fn around_b(&self, b: &Part, within: f64) -> Region2 {
        Region2 { center: self.between + b.center, radius: f64::from(b.shape.outer_radius()) + within }
    }

    /// The region in which parts of B may be within a distance of a part of A, or of A as a whole.
    pub(super) fn around_a(&self, a: &Part, within: f64) -> Region2 {
        Region2 { center: a.center - self.between, radius: f64::from(a.shape.outer_radius()) + within }
    }

    /// Whether either shape is a compound of so many parts that its tree is searched.
    pub(super) fn has_many_parts(&self) -> bool {
        [self.shape_a, self.shape_b].iter().any(|shape| many2(shape).is_some())
    }
}
