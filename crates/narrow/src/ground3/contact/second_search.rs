//! A second search for the least separation, where many low bends in a row may hide some of it.
//!
//! ```text
//! cheap lower bounds leave open that ground is nearer than the least separation found                     (protrusion)
//! for each triangle near the part that has a low bend, again:
//!     its plane, a face of the part, the normals found, or any cheap axis show that it is no nearer: done
//! the kernels are called for those that are left, in the order of these bounds:
//!     nearer than all that was found, and along its normal up to a few low bends: its separation is reported
//! ```
//! Where a group has the same normal and the same ground, this separation is recorded as one between the group's
//! points; else a point is added: so a crate stands on the top of a dome that falls away under its corners. What
//! remains goes into the error: at most a millionth of the body or, where more triangles were left than kernels are
//! called for, what their bounds leave open; in overlap at most a thousandth of the radius.
//!
//! A body on a dome with bends below 1e-4 pays for ground twice or more. On a plane this search never runs, nor where
//! bends are large enough to see; on a plane that was rotated as a whole it may run for capsules and wide bodies.

use super::facet::Facet;
use super::protrusion::{hidden_by, sine, window};
use super::rejected_gaps::ClosestPoints;
use super::{Known, PartTest};
use arrayvec::ArrayVec;
use asunder_geometry::NearTriangle;
use asunder_geometry::glam::DVec3;
use core::ops::ControlFlow;

/// Most triangles for which kernels are called between two passes over all of them. Across a gap the first is most
/// often the nearest, and its direction proves that the others are not.
const MOST_CALLED: usize = 8;

/// Most passes over all of them.
const MOST_LOOKS: usize = 4;

/// How much may be left to the error, in slacks. With a half, capsules on a floor that was rotated as a whole, whose
/// bends are f32 rounding, took up to twice the time; with four, one error in ten on hills was above a millionth of the
/// body (AMD EPYC, Zen 5, 2 virtual cores, 2026-11-24).
const LEEWAY: f64 = 0.875;

/// In overlap, the share of the radius by which low bends, tens of them in a row under one body, may hide depth beyond
/// what is reported. No error grows by more. With a sixteenth, bodies that stick through ground were reported with
/// errors of a hundredth of their radius, in one case of ten thousand.
const DEEPER: f64 = 1.0 / 1024.0;

/// Triangles that may be nearer than the least separation found, with lower bounds on theirs.
struct Open {
    nearest: ArrayVec<(f64, u32), MOST_CALLED>,
    /// A lower bound for all others.
    rest: f64,
}

/// The triangles for which kernels have been called, and what that showed.
struct Called {
    numbers: ArrayVec<u32, { MOST_CALLED * MOST_LOOKS }>,
    /// Unit directions from the ground to the part along which closest points were found, how low the part reaches
    /// along each, in metres from its centre, and the core's point there.
    axes: ArrayVec<(DVec3, f64, DVec3), MOST_CALLED>,
    /// A lower bound on the separations of all of them.
    lowest: f64,
}

impl Open {
    fn add(&mut self, bound: f64, number: u32) {
        let place = self.nearest.partition_point(|&(known, _)| known <= bound);
        if self.nearest.is_full() {
            let last =
                if place < MOST_CALLED { self.nearest.pop().map_or(bound, |last| last.0) } else { bound };
            self.rest = self.rest.min(last);
        }
        let _ = self.nearest.try_insert(place, (bound, number));
    }
}

impl PartTest<'_> {
    /// Makes sure that no triangle with a low bend is nearer than the least separation reported, except for what goes
    /// into the error. Whether the part is within the margin is already known, unless nothing was found for it.
    pub(super) fn bound_least(&self, known: &mut Known, is_wanted: bool) {
        if !is_wanted && known.groups.least() < f64::INFINITY {
            return;
        }
        let enough = self.enough(known);
        let floor = self.floor(known);
        known.levels.lowest = match known.levels.least_above(floor, enough) {
            Some(lowest) => lowest,
            None => self.search_again(known),
        };
    }

    /// Triangles with bounds above this need not be examined.
    fn enough(&self, known: &Known) -> f64 {
        known.groups.least().min(self.query.margin.into()) - LEEWAY * self.standing.slack
    }

    /// Triangles with bounds below this are other ground: the closest point along a triangle's normal, up to a few low
    /// bends, is no further than its plane and those bends.
    fn floor(&self, known: &Known) -> f64 {
        let radius = self.standing.outer_radius;
        if known.overlapping { known.groups.least() - DEEPER * radius } else { -2.0 * window(radius) }
    }

    /// Searches the triangles with low bends again; returns a lower bound on the separations of all of them.
    #[inline(never)]
    fn search_again(&self, known: &mut Known) -> f64 {
        let mut called =
            Called { numbers: ArrayVec::new_const(), axes: ArrayVec::new_const(), lowest: f64::INFINITY };
        if let Some((normal, on_body)) = known.groups.nearest() {
            self.add_axis(normal, on_body, &mut called);
        }
        let mut rest = f64::INFINITY;
        let mut is_any_nearer = false;
        for _ in 0..MOST_LOOKS {
            let open = self.nearest_of_low(&called, known);
            is_any_nearer = false;
            for (bound, number) in open.nearest {
                is_any_nearer |= self.call_kernels(number, bound, &mut called, known);
            }
            rest = open.rest;
            if rest >= self.enough(known) {
                break;
            }
        }
        if is_any_nearer && known.levels.is_crowded {
            // To note what is hidden of the manifold that was added last.
            let _ = self.nearest_of_low(&called, known);
        }
        called.lowest.min(rest)
    }

    fn add_axis(&self, normal: DVec3, on_body: DVec3, called: &mut Called) {
        let low = self.standing.extent(normal, self.standing.center).low - self.standing.radius;
        let _ = called.axes.try_push((normal, low, on_body + normal * self.standing.radius));
    }

    /// A lower bound on a triangle's separation, by the axes known so far.
    fn bound_by(&self, called: &Called, facet: &Facet) -> f64 {
        let center = self.standing.center;
        let bound = |&(normal, low, _): &(DVec3, f64, DVec3)| {
            let top = |corner: usize| normal.dot(facet.corners[corner] - center);
            low - top(0).max(top(1)).max(top(2))
        };
        called.axes.iter().map(bound).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Calls the kernels for a triangle, and reports its separation if that is less than all found; returns whether it
    /// is.
    fn call_kernels(&self, number: u32, bound: f64, called: &mut Called, known: &mut Known) -> bool {
        let (ground, standing, enough) = (self.query.on.ground, self.standing, self.enough(known));
        let _ = called.numbers.try_push(number);
        let Some(facet) = Facet::facing(ground, number, standing.center) else { return false };
        let bound = bound.max(self.bound_by(called, &facet) - self.doubt_over(&facet));
        if bound >= enough {
            called.lowest = called.lowest.min(bound);
            return false;
        }
        let found = self.meeting.nearest((ground, &facet), &standing.place, self.query);
        let Some((towards, found)) = found else { return false };
        let is_hidden =
            facet.normal.dot(towards) > 0.0 && facet.normal.cross(towards).length() <= window(1.0);
        if !(is_hidden || !known.overlapping && !ground.is_one_sided()) {
            return false;
        }
        called.lowest = called.lowest.min(found.separation - found.doubt);
        self.add_axis(towards, found.ends[0], called);
        let is_nearer = found.separation < known.groups.least();
        if is_nearer {
            self.report_nearer(found, known);
        }
        is_nearer
    }

    /// Passes over all triangles with low bends for which no kernels were called. Where not all levels were kept, it
    /// notes what they may hide of manifolds other than the nearest.
    fn nearest_of_low(&self, called: &Called, known: &mut Known) -> Open {
        let (ground, standing) = (self.query.on.ground, self.standing);
        let (floor, enough) = (self.floor(known), self.enough(known));
        let mut open = Open { nearest: ArrayVec::new_const(), rest: f64::INFINITY };
        let _ = ground.read_near(&self.bounds, |near| {
            let Some((facet, least)) = self.low(near, known).filter(|&(_, least)| least >= floor) else {
                return ControlFlow::Continue(());
            };
            let bound = least.max(self.bound_by(called, &facet) - self.doubt_over(&facet));
            if known.levels.is_crowded {
                self.hide(facet.normal, bound, known);
            }
            let is_apart = || {
                let beyond = enough + self.doubt_over(&facet);
                let mut cores = called.axes.iter().map(|&(.., core)| core);
                standing.is_apart((&facet, None), beyond)
                    || cores.any(|core| standing.is_apart_towards(core, &facet, beyond))
            };
            if called.numbers.contains(&near.number) {
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

    /// A triangle, if it has a low bend, and a lower bound on its separation.
    fn low(&self, near: &NearTriangle, known: &mut Known) -> Option<(Facet, f64)> {
        if !near.prominent.bends_low() {
            return None;
        }
        let plane = self.plane_of(near.number)?;
        let incident = self.incident_to(plane.facet.normal, known);
        let least = self.prism_over(&plane).least_of_low(Some(&incident));
        Some((plane.facet, least))
    }

    fn hide(&self, normal: DVec3, bound: f64, known: &mut Known) {
        let radius = self.standing.outer_radius;
        known.groups.hide(normal, bound, |reported, lower| hidden_by(sine(reported, normal), lower, radius));
    }

    fn report_nearer(&self, found: ClosestPoints, known: &mut Known) {
        let measured = [found.separation, found.doubt];
        let above = known.groups.least_along(found.normal) - found.separation;
        if above <= window(self.standing.outer_radius) {
            known.groups.record(found.normal, measured);
        } else {
            self.add_rejected_gap(&found, known);
        }
    }
}
