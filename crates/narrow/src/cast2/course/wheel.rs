//! Parts that turn, as the circles that they sweep: shows, where steps get no further, that a wheel of many sides rolls
//! past another for good.

use super::{Course, Look};
use asunder_geometry::glam::DVec2;

impl Course<'_> {
    /// Whether circles around all that turns pass, along the axis of a look, from then on until the end. Circles do not
    /// turn: along one axis their gap is least at one of the two ends.
    pub(super) fn circles_pass(&self, look: &Look, now: f64) -> bool {
        let is_turning = |which: usize| self.stretch.spins[which].rounding > 0.0;
        // Where nothing turns, a circle shows nothing new; a half-plane that turns sweeps over all of the plane.
        if !self.stretch.is_turning() || (0..2).any(|which| is_turning(which) && self.pieces[which].is_line())
        {
            return false;
        }
        let reach = |which: usize, along: DVec2, time: f64| {
            if is_turning(which) {
                let body = if which == 0 { DVec2::ZERO } else { self.stretch.offset_at(time) };
                return along.dot(body) + self.pieces[which].arm;
            }
            if self.pieces[which].is_line() {
                return along.dot(self.place(which, time).1);
            }
            self.outline(which, time).support(along).reach
        };
        [now, self.times[1]].into_iter().all(|time| {
            let gap = -reach(0, look.axis, time) - reach(1, -look.axis, time) - self.radii;
            gap > self.slack + 2.0 * self.precision.projection()
        })
    }
}
