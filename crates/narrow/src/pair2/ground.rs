//! Chains: overlap and separation of their segments and the parts of other bodies. Contacts are in `contact`.
//!
//! Each segment is a shape like any other, tested by the same kernels; as for compounds, the least separation counts. A
//! tree of boxes along the chain finds the segments that are near.

mod ahead;
mod contact;
mod patches;
#[cfg(test)]
mod tests;

use super::{Pair2, Part, Parts, Place, for_parts};
use crate::answer::{Tier, Verdict};
use crate::counted::count_step;
use crate::feature::Hint;
use crate::ground2::{Surface, Zone};
use crate::least::Least;
use crate::polygon::measure::{Near, Probe, Query};
use crate::precision::round_down;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, Chain, Shape2};
use core::ops::ControlFlow;

impl Pair2<'_> {
    /// Whether either shape is ground.
    #[inline]
    pub(crate) fn has_ground(&self) -> bool {
        self.shape_a.is_ground() || self.shape_b.is_ground()
    }

    pub(super) fn verdict_on_ground(&self) -> Verdict {
        let mut tier = Tier::Bound;
        let overlapping = self.any_on_ground(false, |parts| {
            let verdict = parts.convex.verdict();
            tier = tier.max(verdict.tier);
            verdict.overlapping
        });
        Verdict { overlapping, tier }
    }

    pub(super) fn guess_on_ground(&self) -> bool {
        self.any_on_ground(false, |parts| parts.convex.guess())
    }

    /// Whether any part overlaps a segment of a run that it sees.
    pub(super) fn overlaps_facing(&self) -> bool {
        self.any_on_ground(true, |parts| parts.convex.verdict().overlapping)
    }

    /// Whether the answer is yes for any segment and any part of the other shape, of those whose boxes meet. Two
    /// grounds see each other from all sides.
    fn any_on_ground(&self, only_facing: bool, mut test: impl FnMut(&Parts) -> bool) -> bool {
        let only_facing = only_facing && !(self.shape_a.is_ground() && self.shape_b.is_ground());
        let near = |zone: &Zone, bounds: &Aabb2| zone.gap(bounds) <= 0.0;
        let mut among = |side: usize, chain: &Chain, other: Part| {
            let zone = self.zone(side, &other);
            let visit = |segment| {
                let is_candidate = !only_facing || self.is_facing((side, chain), segment, &other);
                let mut is_met =
                    || self.with_segment(side, chain, (segment, other), |parts| test(&parts)) == Some(true);
                if is_candidate && is_met() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            chain.visit_where(|bounds| near(&zone, bounds), visit).is_break()
        };
        match (self.shape_a, self.shape_b) {
            (Shape2::Chain(a), Shape2::Chain(b)) => {
                let zone = self.zone(0, &Part::whole(self.shape_b, &self.turn_b));
                let visit = |segment| {
                    let found = a.segment(segment).map(Shape2::Segment);
                    let is_met =
                        found.is_some_and(|shape| among(1, b, Part::segment(segment, &shape, &self.turn_a)));
                    if is_met { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                };
                a.visit_where(|bounds| near(&zone, bounds), visit).is_break()
            }
            (Shape2::Chain(a), other) => for_parts(other, &self.turn_b, |part| among(0, a, part)),
            (other, Shape2::Chain(b)) => for_parts(other, &self.turn_a, |part| among(1, b, part)),
            _ => false,
        }
    }

    /// Whether a part sees a segment's run: the part is in front of the run, or the ground is not one-sided.
    fn is_facing(&self, (side, chain): (usize, &Chain), segment: u32, part: &Part) -> bool {
        let [chain_at, body_at] =
            if side == 0 { [DVec2::ZERO, self.between] } else { [self.between, DVec2::ZERO] };
        let turn = if side == 0 { &self.turn_a } else { &self.turn_b };
        let run = chain.run_of(segment);
        run.and_then(|run| Surface::new(chain, &run, (turn, chain_at), part.middle(body_at))).is_some()
    }

    /// The segment and the part with the least separation, or a bound if all are beyond the limit.
    pub(super) fn nearest_on_ground(&self, limit: f64) -> Result<(Place, Near), f32> {
        let mut least = Least::within(limit);
        match (self.shape_a, self.shape_b) {
            (Shape2::Chain(a), Shape2::Chain(b)) => {
                let zone = self.zone(0, &Part::whole(self.shape_b, &self.turn_b));
                let visit = |segment| {
                    if let Some(shape) = a.segment(segment).map(Shape2::Segment) {
                        self.nearest_segment(1, b, Part::segment(segment, &shape, &self.turn_a), &mut least);
                    }
                    least.reach()
                };
                a.visit_nearest(limit, |bounds| zone.gap(bounds), visit);
            }
            (Shape2::Chain(a), other) => {
                for_parts(other, &self.turn_b, |part| self.nearest_segment(0, a, part, &mut least));
            }
            (other, Shape2::Chain(b)) => {
                for_parts(other, &self.turn_a, |part| self.nearest_segment(1, b, part, &mut least));
            }
            _ => {}
        }
        // Segments in boxes that were never opened are beyond the limit.
        least.give_up(round_down(limit));
        let ((place, mut near), error) = least.finish()?;
        near.error = error;
        Ok((place, near))
    }

    /// Offers the segments of a chain that may be nearest to a part. Always returns false, so that all parts are
    /// visited.
    fn nearest_segment(
        &self,
        side: usize,
        chain: &Chain,
        other: Part,
        least: &mut Least<(Place, Near)>,
    ) -> bool {
        let zone = self.zone(side, &other);
        let mut deepest = f64::INFINITY;
        let limit = least.reach();
        chain.visit_nearest(
            limit,
            |bounds| zone.gap(bounds),
            |segment| {
                let query = Query { limit: least.reach(), hint: Hint::NONE, points: false };
                let found = self.with_segment(side, chain, (segment, other), |parts| {
                    (parts.place, parts.convex.probe(&query))
                });
                match found {
                    Some((place, Probe::Near(near))) => {
                        let (separation, error) = (near.separation, near.error);
                        deepest = deepest.min(f64::from(separation));
                        least.offer((place, near), separation, error);
                    }
                    Some((_, Probe::Beyond(at_least, _))) => least.give_up(at_least),
                    None => {}
                }
                // For a half-plane, a box bounds the depth of its segments, and only the deepest counts.
                if zone.is_endless() { deepest.min(least.reach()) } else { least.reach() }
            },
        );
        false
    }

    /// Passes a segment of the chain on one side of the pair, and a part of the other, to `run`.
    fn with_segment<R>(
        &self,
        side: usize,
        chain: &Chain,
        (segment, other): (u32, Part),
        run: impl FnOnce(Parts) -> R,
    ) -> Option<R> {
        count_step();
        let shape = Shape2::Segment(chain.segment(segment)?);
        let turn = if side == 0 { &self.turn_a } else { &self.turn_b };
        Some(run(self.ordered(side, Part::segment(segment, &shape, turn), other)))
    }

    /// A part of the ground and one of the other body, in the order of A and B.
    fn ordered<'p>(&self, side: usize, ground: Part<'p>, other: Part<'p>) -> Parts<'p> {
        if side == 0 { self.parts(ground, other) } else { self.parts(other, ground) }
    }

    /// The zone of a part of the body, in the axes of the chain, which is A (side 0) or B.
    fn zone(&self, side: usize, part: &Part) -> Zone {
        let (chain, body) =
            if side == 0 { (&self.turn_a, &self.turn_b) } else { (&self.turn_b, &self.turn_a) };
        let between = if side == 0 { self.between } else { -self.between };
        let (turn, shift) = part.placed(body);
        let summed = between.abs().element_sum() + shift.abs().element_sum();
        Zone::of(part.shape, turn, between + shift, chain, summed)
    }
}

impl<'p> Part<'p> {
    /// A segment of a chain as a part.
    fn segment(index: u32, shape: &'p Shape2, turn: &super::Turn) -> Self {
        Self { index, ..Self::whole(shape, turn) }
    }

    /// The part's centre relative to A's position; `None` for a half-plane, which has none.
    fn middle(&self, body: DVec2) -> Option<DVec2> {
        (self.shape.outer_radius() < f32::INFINITY).then(|| body + self.center)
    }
}
