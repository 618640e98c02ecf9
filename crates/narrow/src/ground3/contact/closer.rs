//! A triangle within reach: by its normal or, where that may not be the answer, by other axes.

use super::against::Against;
use super::axes::Axes;
use super::meeting::Met;
use super::prism::Prism;
use super::prominent_near::{Covered, Needs};
use super::rejected::Rejection;
use super::whole::touching;
use super::{Known, PartTest};
use asunder_geometry::{NearTriangle, Prominent};

impl PartTest<'_> {
    /// Processes a triangle within reach.
    pub(super) fn look_on(&self, near: &NearTriangle, prism: &Prism, known: &mut Known) {
        let prominent = near.prominent;
        match self.needs(prism, prominent) {
            Needs::Normal => return self.look_along(prism, prominent, known),
            // They share a point: there is no gap for the kernels.
            Needs::KernelsBeside if prism.does_cross() => return self.look_along(prism, prominent, known),
            Needs::KernelsBeside => {
                self.look_along(&Prism { reach: touching(), ..*prism }, prominent, known);
                known.groups.leave_out(self.deep_below(prism));
            }
            Needs::Kernels => {}
        }
        self.look_closer(prism, prominent, known);
        known.groups.leave_out(f64::NEG_INFINITY);
    }

    /// Processes a triangle along its normal.
    fn look_along(&self, prism: &Prism, prominent: Prominent, known: &mut Known) {
        let (number, doubt) = (prism.facet.number, prism.doubt);
        let separation = prism.extent.low - self.standing.radius;
        let has_points = self.add_where_met(prism, separation, known);
        known.note_level(prism, prominent);
        if known.overlapping || separation > doubt {
            return;
        }
        if prism.does_cross() {
            return known.settle(number);
        }
        self.leave_unclear(number, (has_points, separation), known);
    }

    /// Processes a triangle whose normal may not be the answer.
    fn look_closer(&self, prism: &Prism, prominent: Prominent, known: &mut Known) {
        let Prism { standing, facet, extent, doubt, .. } = *prism;
        let beyond = self.query.reach + 2.0 * doubt;
        let mut axes = Axes::new();
        let has_axes = !self.query.is_plain && prism.fill(&mut axes, beyond + standing.radius);
        let axes = has_axes.then_some(&axes);
        if standing.is_apart((facet, axes), beyond) {
            return;
        }
        known.note_level(prism, prominent);
        match self.covered((prism, axes), known) {
            Some(Covered::Wholly(least)) => {
                if least <= doubt {
                    let separation = extent.low - standing.radius;
                    self.leave_unclear(facet.number, (true, separation), known);
                }
                return;
            }
            Some(Covered::WhereDeep) => known.groups.leave_out(self.deep_below(prism)),
            None => {}
        }
        self.look_by_axes(prism, axes, known);
    }

    /// Processes a triangle along axes that may not be its normal.
    #[inline(never)]
    fn look_by_axes(&self, prism: &Prism, axes: Option<&Axes>, known: &mut Known) {
        let Prism { ground, standing, facet, extent, doubt, .. } = *prism;
        let (number, separation) = (facet.number, extent.low - standing.radius);
        match prism.add_against(&self.incident_to(facet.normal, known), &mut known.groups) {
            Against::Apart => return,
            Against::Rejected(rejection) => {
                self.defer_rejected(prism, rejection, known);
                return self.leave_unclear(number, (false, separation), known);
            }
            Against::Added(_, true) => return known.settle(number),
            Against::Added(separation, _) if separation > doubt + standing.planarity => return,
            Against::Added(separation, _) => return self.leave_unclear(number, (true, separation), known),
            Against::Unknown => {}
        }
        if let Some(axes) = axes {
            if axes.do_overlap(doubt) && prism.rejects(axes) {
                known.settle(number);
                let (is_own, measured) = (prism.is_own(axes), prism.measured_by(axes));
                return self.defer_rejected(prism, Rejection { is_own, is_apart: false, measured }, known);
            }
            if axes.best > doubt
                && let Some(gap) = prism.rejected_gap(axes)
            {
                if gap.separation <= self.query.margin.into() {
                    known.keep_rejected_gap(gap);
                    let is_own = gap.is_own;
                    self.defer_rejected(prism, Rejection { is_own, is_apart: true, measured: None }, known);
                }
                return;
            }
        }
        let met = self.meeting.add_points((ground, facet), standing, self.query, &mut known.groups);
        match met {
            Met::Apart | Met::Added(false) => {}
            Met::Added(true) => known.settle(number),
            Met::Rejected { overlapping, is_own, gap, measured } => {
                if overlapping {
                    known.settle(number);
                }
                if let Some(gap) = gap {
                    known.keep_rejected_gap(gap);
                }
                self.defer_rejected(prism, Rejection { is_own, is_apart: !overlapping, measured }, known);
            }
        }
    }
}
