//! Two parts that all but touch at the start, and turn apart.
//!
//! Between points that are as near as rounding, an axis is rounding over their gap; the normals of edges are not. And
//! beside the edge of a body that turns, a fixed axis shows no more than the far corner of that edge leaves: so an axis
//! may turn along with either body.

use super::{Course, Look};
use asunder_geometry::glam::DVec2;

/// Times at which two that all but touch at the start are looked at, to find them apart.
const MAX_TRIES: usize = 20;

impl Course<'_> {
    /// Of an axis, and the normals of the edges at the corners that reach furthest along it, the one that shows the
    /// greatest gap, and that. Between points that all but touch, an axis is off by their rounding over their gap;
    /// edges' normals are not.
    pub(super) fn sharpest(&self, axis: DVec2, now: f64) -> (DVec2, f64) {
        let mut best = (axis, self.gap(axis, now));
        if self.line().is_some() {
            return best;
        }
        let [a, b] = self.outlines(now);
        for (outline, sign) in
            [(&a, 1.0), (&b, -1.0)].into_iter().filter(|(outline, _)| outline.edge_count() > 0)
        {
            let corner = outline.support(axis * sign).vertex;
            for edge in [outline.before(corner), corner] {
                let normal = outline.normal(edge) * sign;
                let gap = self.gap(normal, now);
                if gap > best.1 {
                    best = (normal, gap);
                }
            }
        }
        best
    }

    /// A look along the sharpest axis.
    pub(super) fn sharpened(&self, look: Look, now: f64) -> Look {
        let (axis, least) = self.sharpest(look.axis, now);
        if least > look.least { Look { axis, least, ..look } } else { look }
    }

    /// When two that turn, and all but touch at time zero, are further apart along an axis than a step aims at, having
    /// come no nearer in between; `None` if it shows no such time. The axis is fixed, or turns along with either body.
    pub(super) fn turns_apart(&self, axis: DVec2) -> Option<f64> {
        let least = self.gap(axis, 0.0);
        if !self.is_turning() || least < -self.slack - 16.0 * self.precision.projection() {
            return None;
        }
        let mut carriers = [None].into_iter().chain(self.carriers().map(Some));
        carriers.find_map(|carrier| self.apart_along(axis, carrier, least))
    }

    /// The same for an axis and what it turns along with, along which they are as near as `least` at time zero.
    fn apart_along(&self, axis: DVec2, carrier: Option<usize>, least: f64) -> Option<f64> {
        if !self.opens(axis, carrier) {
            return None;
        }
        let bend = carrier.map_or(self.bend, |which| self.bend_along(which));
        let mut later = self.times[1];
        for _ in 0..MAX_TRIES {
            let then = carrier.map_or(axis, |which| self.carried(which, axis, [0.0, later]));
            let gap = self.gap(then, later);
            // In between, at h, a gap is below the line between both by no more than bend h (later - h) / 2.
            if gap > self.aim && gap - least >= 0.5 * bend * later * later * (1.0 + 1e-9) {
                return Some(later);
            }
            later *= 0.25;
        }
        None
    }

    /// Whether the vertices that are nearest along an axis come no nearer at first. If they do, the gap along it comes
    /// back to what it was no faster than it may bend, and so shows nothing.
    fn opens(&self, axis: DVec2, carrier: Option<usize>) -> bool {
        if self.line().is_some() {
            return true;
        }
        let [a, b] = self.outlines(0.0);
        let (on_a, on_b) = (a.point(a.support(axis).vertex), b.point(b.support(-axis).vertex));
        let [spin_a, spin_b] = self.stretch.spins.map(|spin| spin.speed_at(0.0));
        let velocity = (on_b - self.stretch.offset_at(0.0)).perp() * spin_b
            - on_a.perp() * spin_a
            - self.stretch.velocity;
        let sway = carrier.map_or(0.0, |which| [spin_a, spin_b][which]);
        axis.dot(velocity) + sway * axis.perp().dot(on_b - on_a) >= 0.0
    }

    /// The bodies that an axis may turn along with: those that turn. A half-plane has an axis of its own.
    pub(super) fn carriers(&self) -> impl Iterator<Item = usize> {
        let has_line = self.line().is_some();
        [0, 1].into_iter().filter(move |&which| !has_line && self.stretch.spins[which].speed > 0.0)
    }

    /// Where an axis that turns along with a body is, a while later.
    pub(super) fn carried(&self, which: usize, axis: DVec2, [from, to]: [f64; 2]) -> DVec2 {
        let spin = &self.stretch.spins[which];
        spin.turn_at(to).turn(spin.turn_at(from).turn_back(axis)).normalize()
    }

    /// A bound on the second derivative of the gap along an axis that turns along with a body: seen from that, all else
    /// turns about it, as seen from a half-plane.
    pub(super) fn bend_along(&self, which: usize) -> f64 {
        let (spins, other) = (&self.stretch.spins, 1 - which);
        spins[which].swerve * self.around()
            + 2.0 * spins[which].speed * (self.stretch.velocity.length() + self.pace)
            + spins[other].swerve * self.pieces[other].arm
    }

    /// The furthest that a point of either is from the other's position.
    pub(super) fn around(&self) -> f64 {
        let furthest = self.times.map(|time| self.stretch.offset_at(time).length());
        furthest[0].max(furthest[1]) + self.pieces[0].arm + self.pieces[1].arm
    }
}
