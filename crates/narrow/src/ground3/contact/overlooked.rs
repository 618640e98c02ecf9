//! What many low bends in a row hide of the least of all, looked for once more.
//!
//! ```text
//! what is told may be further than ground is, by bounds that cost little                                  (protrusion)
//! for each triangle near the part that has such a bend, again:
//!     by its plane, a face of the part, the normal that is told, or any axis that costs little, it is no nearer than what
//!         is told: done
//! of those that are left, the nearest by these bounds first, the kernels are asked:
//!     nearer than all that is told, and so along its own normal but for a few low bends: it is told
//! ```
//! Told as what a group's points have between them, where that has the same normal and the same ground; else as a point
//! of its own: so a crate stands on the top of a dome that falls away under its corners. What is left goes into the
//! error: a millionth of a body at most, or where more were left open than are asked about, what their bounds leave; of
//! an overlap a thousandth of the radius at most.
//!
//! A body on a dome of bends below 1e-4 pays for ground twice or more. On a plane nobody comes here, nor where bends
//! are such as one sees; on a plane that was turned as a whole, capsules and wide bodies may.

use super::facet::Facet;
use super::prism::Prism;
use super::protrusion::{hidden_by, sine, window};
use super::unsaid::Unsaid;
use super::{Known, Seen};
use arrayvec::ArrayVec;
use asunder_geometry::NearTriangle;
use asunder_geometry::glam::DVec3;
use core::ops::ControlFlow;

/// Triangles about which kernels are asked between two looks at all of them. In a gap the first is most often the
/// nearest, and the direction in which it is shows that others are not.
const MOST_ASKED: usize = 8;

/// Looks at all of them.
const MOST_LOOKS: usize = 4;

/// How much may be left to the error, in slacks. With a half, capsules on a floor that was turned as a whole, whose
/// bends are the rounding of f32, took up to twice the time; with four, one error in ten on hills was above a millionth
/// of the body (AMD EPYC, Zen 5, 2 virtual cores, 2026-11-24).
const LEEWAY: f64 = 0.875;

/// Share of the radius by which ground that is overlapped may be deeper than what is told of it, and be hidden by low
/// bends: tens of them in a row under one body. No error grows by more. With a sixteenth, bodies that stick through
/// ground were told with errors of a hundredth of their radius, in one case of ten thousand.
const DEEPER: f64 = 1.0 / 1024.0;

/// Triangles that may be nearer than what is told, and bounds on how near.
struct Open {
    nearest: ArrayVec<(f64, u32), MOST_ASKED>,
    /// A bound for all others.
    rest: f64,
}

/// What is known by now.
struct Asked {
    numbers: ArrayVec<u32, { MOST_ASKED * MOST_LOOKS }>,
    /// Unit directions to the part, along which something is as near as is told, and how low the part reaches along
    /// each, in metres from its centre; and the point of the core that is there.
    axes: ArrayVec<(DVec3, f64, DVec3), MOST_ASKED>,
    /// A bound on all of them.
    lowest: f64,
}

impl Open {
    fn add(&mut self, bound: f64, number: u32) {
        let place = self.nearest.partition_point(|&(known, _)| known <= bound);
        if self.nearest.is_full() {
            let last =
                if place < MOST_ASKED { self.nearest.pop().map_or(bound, |last| last.0) } else { bound };
            self.rest = self.rest.min(last);
        }
        let _ = self.nearest.try_insert(place, (bound, number));
    }
}

impl Seen<'_> {
    /// Sees to it that no triangle with a low bend is nearer than what is told, but for what goes into the error.
    /// Whether the part is within the margin is known by now, unless nothing was told of it.
    pub(super) fn bound_least(&self, known: &mut Known, is_wanted: bool) {
        if !is_wanted && known.groups.least() < f64::INFINITY {
            return;
        }
        let enough = self.enough(known);
        let floor = self.floor(known);
        known.levels.lowest = match known.levels.least_above(floor, enough) {
            Some(lowest) => lowest,
            None => self.look_again(known),
        };
    }

    /// A bound above which nothing need be known.
    fn enough(&self, known: &Known) -> f64 {
        known.groups.least().min(self.asking.margin.into()) - LEEWAY * self.standing.slack
    }

    /// A bound below which triangles are other ground. What is nearest along a triangle's own normal, but for a few low
    /// bends, is no further than its plane and those.
    fn floor(&self, known: &Known) -> f64 {
        let radius = self.standing.outer_radius;
        if known.overlapping { known.groups.least() - DEEPER * radius } else { -2.0 * window(radius) }
    }

    /// Looks once more at triangles with low bends; a bound on how near any of them is.
    #[inline(never)]
    fn look_again(&self, known: &mut Known) -> f64 {
        let mut asked =
            Asked { numbers: ArrayVec::new_const(), axes: ArrayVec::new_const(), lowest: f64::INFINITY };
        if let Some((normal, on_body)) = known.groups.nearest() {
            self.add_axis(normal, on_body, &mut asked);
        }
        let mut rest = f64::INFINITY;
        let mut is_any_told = false;
        for _ in 0..MOST_LOOKS {
            let open = self.nearest_of_low(&asked, known);
            is_any_told = false;
            for (bound, number) in open.nearest {
                is_any_told |= self.ask(number, bound, &mut asked, known);
            }
            rest = open.rest;
            if rest >= self.enough(known) {
                break;
            }
        }
        if is_any_told && known.levels.is_crowded {
            // What is hidden of the manifold that came last.
            let _ = self.nearest_of_low(&asked, known);
        }
        asked.lowest.min(rest)
    }

    fn add_axis(&self, normal: DVec3, on_body: DVec3, asked: &mut Asked) {
        let low = self.standing.extent(normal, self.standing.center).low - self.standing.radius;
        let _ = asked.axes.try_push((normal, low, on_body + normal * self.standing.radius));
    }

    /// A bound on how near a triangle is, along any axis known by now.
    fn bound_by(&self, asked: &Asked, facet: &Facet) -> f64 {
        let center = self.standing.center;
        let bound = |&(normal, low, _): &(DVec3, f64, DVec3)| {
            let top = |corner: usize| normal.dot(facet.corners[corner] - center);
            low - top(0).max(top(1)).max(top(2))
        };
        asked.axes.iter().map(bound).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Asks the kernels about a triangle, and tells what they say where it is nearer than all that is told; whether it
    /// is.
    fn ask(&self, number: u32, bound: f64, asked: &mut Asked, known: &mut Known) -> bool {
        let (ground, standing, enough) = (self.asking.on.ground, self.standing, self.enough(known));
        let _ = asked.numbers.try_push(number);
        let Some(facet) = Facet::seen(ground, number, standing.center) else { return false };
        let bound = bound.max(self.bound_by(asked, &facet) - self.doubt_over(&facet));
        if bound >= enough {
            asked.lowest = asked.lowest.min(bound);
            return false;
        }
        let found = self.meeting.nearest((ground, &facet), &standing.place, self.asking);
        let Some((towards, found)) = found else { return false };
        let is_hidden =
            facet.normal.dot(towards) > 0.0 && facet.normal.cross(towards).length() <= window(1.0);
        if !(is_hidden || !known.overlapping && !ground.is_one_sided()) {
            return false;
        }
        asked.lowest = asked.lowest.min(found.separation - found.doubt);
        self.add_axis(towards, found.ends[0], asked);
        let is_nearer = found.separation < known.groups.least();
        if is_nearer {
            self.tell_overlooked(found, known);
        }
        is_nearer
    }

    /// Goes through all triangles with low bends that were not asked about. What they hide of other manifolds than the
    /// nearest is noted where not all levels were kept.
    fn nearest_of_low(&self, asked: &Asked, known: &mut Known) -> Open {
        let (ground, standing) = (self.asking.on.ground, self.standing);
        let (floor, enough) = (self.floor(known), self.enough(known));
        let mut open = Open { nearest: ArrayVec::new_const(), rest: f64::INFINITY };
        let _ = ground.read_near(&self.bounds, |near| {
            let Some((facet, least)) = self.low(near, known).filter(|&(_, least)| least >= floor) else {
                return ControlFlow::Continue(());
            };
            let bound = least.max(self.bound_by(asked, &facet) - self.doubt_over(&facet));
            if known.levels.is_crowded {
                self.hide(facet.normal, bound, known);
            }
            let is_apart = || {
                let beyond = enough + self.doubt_over(&facet);
                let mut cores = asked.axes.iter().map(|&(.., core)| core);
                standing.is_apart((&facet, None), beyond)
                    || cores.any(|core| standing.is_apart_towards(core, &facet, beyond))
            };
            if asked.numbers.contains(&near.number) {
                return ControlFlow::Continue(());
            }
            if bound >= enough {
                open.rest = open.rest.min(bound);
            } else if is_apart() {
                open.rest = open.rest.min(enough);
            } else {
                open.add(bound, near.number);
            }
            ControlFlow::Continue(())
        });
        open
    }

    /// A triangle if it has a low bend, and a bound on how near it is.
    fn low(&self, near: &NearTriangle, known: &mut Known) -> Option<(Facet, f64)> {
        let (ground, standing, reach) = (self.asking.on.ground, self.standing, self.asking.reach);
        if !near.prominent.bends_low() {
            return None;
        }
        let facet = Facet::seen(ground, near.number, standing.center)?;
        let extent = standing.extent(facet.normal, facet.origin());
        let doubt = self.doubt_over(&facet);
        let prism = Prism { ground, standing, facet: &facet, extent: &extent, reach, doubt, gate: None };
        let least = prism.least_of_low(Some(&self.incident_to(facet.normal, known)));
        Some((facet, least))
    }

    fn hide(&self, normal: DVec3, bound: f64, known: &mut Known) {
        let radius = self.standing.outer_radius;
        known.groups.hide(normal, bound, |told, lower| hidden_by(sine(told, normal), lower, radius));
    }

    fn tell_overlooked(&self, found: Unsaid, known: &mut Known) {
        let told = [found.separation, found.doubt];
        let above = known.groups.least_along(found.normal) - found.separation;
        if above <= window(self.standing.outer_radius) {
            known.groups.tell(found.normal, told);
        } else {
            self.add_unsaid(&found, known);
        }
    }
}
