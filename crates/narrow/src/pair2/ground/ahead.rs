//! Ground ahead of a body in motion: runs of a chain beyond a concave corner.
//!
//! Contacts are with the ground that a body is opposite now. At the foot of a slope, the slope's nearest point is a
//! concave corner, which gives no normal (see `ground2::surface`), so a body that comes to the slope within this frame
//! would have no contact with it before it is inside. For a pair with a motion a second pass adds those contacts:
//!
//! ```text
//! for each run near the part that the part sees:
//!   it has a concave end, and the part is no further from it than the motion goes
//!   what of the part lies over the line of the run, beyond that end, all in front of it:   points along its normal
//!   nearer than all contacts so far:     none of them, since the corner's other run would be nearer
//! ```
//! The line stands for ground that is not there, so such a point may stop a body a frame too early where it passes over
//! a short slope. It never does where the body keeps to the ground: up to the corner, the line is behind the other run.

use super::super::Part;
use super::contact::Standing;
use super::patches::{Patch, Patches};
use crate::counted::count_step;
use crate::feature::Hint;
use crate::ground2::Zone;
use crate::polygon::manifold::Point;
use crate::polygon::measure::{Probe, Query};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Run, Shape2};
use core::ops::ControlFlow;

impl Standing<'_> {
    /// Adds points over the lines of runs ahead. Cost: one kernel call for each run with a concave end near the part.
    #[cold]
    #[inline(never)]
    pub(super) fn look_ahead(&self, zone: &Zone, patches: &mut Patches) {
        let (least, mut last) = (patches.least(), None);
        if least == f32::INFINITY {
            return;
        }
        let _ = self.chain.visit_where(self.is_near(zone), |segment| {
            if let Some(run) = self.chain.run_of(segment).filter(|run| last != Some(run.first())) {
                last = Some(run.first());
                self.add_ahead(&run, least, patches);
            }
            ControlFlow::Continue(())
        });
    }

    fn add_ahead(&self, run: &Run, least: f32, patches: &mut Patches) {
        let Some((surface, Some(_))) = self.surface(run) else { return };
        let (open, Some(chord)) = (surface.concave_ends(), self.chain.chord(run).map(Shape2::Segment)) else {
            return;
        };
        if open == [false; 2] {
            return;
        }
        count_step();
        let turn = if self.side == 0 { &self.pair.turn_a } else { &self.pair.turn_b };
        let parts = self.pair.ordered(self.side, Part::segment(run.first(), &chord, turn), self.part);
        let query = Query { limit: self.ahead, hint: Hint::NONE, points: false };
        let Probe::Near(near) = parts.convex.probe(&query) else { return };
        let edge = (surface.edge(), surface.normal);
        let points = parts.convex.over_edge(self.side == 1, edge, self.ahead, open);
        let on_ground = |point: &Point| if self.side == 0 { point.on_a } else { point.on_b };
        let is_ahead = |point: &Point| {
            let beyond = surface.is_beyond(on_ground(point));
            beyond[0] && open[0] || beyond[1] && open[1]
        };
        // Over the run itself everything has been said.
        let points: ArrayVec<Point, 2> = points.into_iter().filter(is_ahead).collect();
        let normal: DVec2 = if self.side == 0 { surface.normal } else { -surface.normal };
        let patch = Patch::new((normal, &points), (&parts.place, self.side), run, &near);
        let patch = patch.map(|patch| patch.deep_by_its_points().widened());
        if let Some(patch) = patch.filter(|patch| patch.is_beyond(least)) {
            patches.add(patch, parts.convex.preference());
        }
    }
}
