//! Contacts on chains, without ghost collisions.
//!
//! ```text
//! for each convex part of the body
//!   for each straight run of the chain that has a segment near the part, and that the part sees        (Surface)
//!     ask the kernels how the part touches the run, as if the run were one segment
//!     their normal is that of a corner of the run: take their points
//!     it is the run's own, or the surface has none such: take what of the part lies over the run  (over_edge)
//!     it is a neighbour's, beyond a sharp corner: take nothing, unless no other point touches
//!   for a pair with a motion: the lines of runs that are still ahead                                (ahead)
//!   one manifold for each normal                                                                  (patches)
//! ```
//! Testing a run in place of its segments keeps points and their feature ids as a body slides. The segments, which lie
//! on their run up to rounding, are only tested for overlap, exactly, and only where the run leaves that open.

use super::super::{Pair2, Part, Parts, for_parts};
use super::patches::{Patch, Patches};
use crate::answer::Manifold2;
use crate::counted::count_step;
use crate::feature::Hint;
use crate::ground2::{Region, Surface, Zone};
use crate::lists::{MANIFOLDS2, with_list};
use crate::polygon::manifold::Point;
use crate::polygon::measure::{Near, Probe, Query};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::STRAIGHT;
use asunder_geometry::{Chain, Run, Shape2};
use core::ops::ControlFlow;

/// A convex part, and the chain that it may stand on.
pub(super) struct Standing<'p> {
    pub(super) pair: &'p Pair2<'p>,
    pub(super) chain: &'p Chain,
    /// Which of the pair the chain is: 0 is A.
    pub(super) side: usize,
    pub(super) part: Part<'p>,
    /// Points within this many metres are wanted; and the widest separation that rounds to so much.
    margin: f32,
    limit: f64,
    /// By how much of that a motion may bring the part nearer, in metres.
    pub(super) ahead: f64,
}

/// Whether a run's segments overlap the part, as far as it is known.
#[derive(Clone, Copy)]
enum Overlap {
    Decided(bool),
    /// The separation is within what the segments may lie off the run: each has to be tested.
    Open,
}

impl Pair2<'_> {
    /// Whether a body overlaps ground that it sees; `None` if they are further apart than the margin. Adds manifolds to
    /// a list. Of the margin, motions may use up `ahead` metres.
    pub(crate) fn contact_on_ground(
        &self,
        [margin, ahead]: [f32; 2],
        manifolds: &mut Vec<Manifold2>,
    ) -> Option<bool> {
        let (side, chain, shape, turn) = match (self.shape_a, self.shape_b) {
            // Two grounds have no contacts with each other.
            (Shape2::Chain(_), Shape2::Chain(_)) => return None,
            (Shape2::Chain(chain), shape) => (0, chain, shape, &self.turn_b),
            (shape, Shape2::Chain(chain)) => (1, chain, shape, &self.turn_a),
            _ => return None,
        };
        let margin = margin.max(0.0);
        let mut touch: Option<bool> = None;
        for_parts(shape, turn, |part| {
            let limit = f64::from(margin.next_up());
            let standing =
                Standing { pair: self, chain, side, part, margin, limit, ahead: ahead.min(margin).into() };
            if let Some(overlapping) = standing.contact(manifolds) {
                touch = Some(touch.unwrap_or(false) || overlapping);
            }
            false
        });
        touch
    }
}

impl Pair2<'_> {
    /// The same, with the deepest of the manifolds; of equals, the first.
    pub(crate) fn deepest_on_ground(&self, margin: f32) -> (Option<bool>, Option<Manifold2>) {
        with_list(&MANIFOLDS2, |list| {
            let touch = self.contact_on_ground([margin, 0.0], list);
            let deepest =
                list.iter().reduce(|best, next| if next.separation < best.separation { next } else { best });
            (touch, deepest.cloned())
        })
    }
}

impl Standing<'_> {
    fn contact(&self, manifolds: &mut Vec<Manifold2>) -> Option<bool> {
        let zone = self.pair.zone(self.side, &self.part);
        let mut patches = Patches::new(manifolds, self.side);
        let mut known: [Option<(Run, Overlap)>; 2] = [None; 2];
        let mut overlapping = false;
        let _ = self.chain.visit_where(self.is_near(&zone), |segment| {
            let Some(run) = self.chain.run_of(segment) else { return ControlFlow::Continue(()) };
            let overlap_found = known.into_iter().flatten().find(|(other, _)| other.first() == run.first());
            let overlap =
                overlap_found.map_or_else(|| self.on_run(&run, &mut patches), |(_, overlap)| overlap);
            // The last run of a closed chain may be the first one again.
            known = [known[0].or(Some((run, overlap))), Some((run, overlap))];
            overlapping |= match overlap {
                Overlap::Decided(overlapping) => overlapping,
                Overlap::Open if overlapping => true,
                Overlap::Open => {
                    let verdict = |parts: Parts| parts.convex.verdict().overlapping;
                    self.pair.with_segment(self.side, self.chain, (segment, self.part), verdict) == Some(true)
                }
            };
            ControlFlow::Continue(())
        });
        if self.ahead > 0.0 {
            self.look_ahead(&zone, &mut patches);
        }
        patches.finish(overlapping, self.margin).then_some(overlapping)
    }

    /// Which boxes may hold segments of a run within the limit.
    pub(super) fn is_near<'z>(&self, zone: &'z Zone) -> impl Fn(&asunder_geometry::Aabb2) -> bool + 'z {
        // How far segments may lie off their run.
        let limit = self.limit;
        let uneven = 4.0 * STRAIGHT * (zone.reach() + limit);
        move |bounds| {
            let reach = if zone.is_endless() {
                let [low, high] = [bounds.min, bounds.max].map(|corner| corner.as_dvec2().abs());
                4.0 * STRAIGHT * low.max(high).element_sum()
            } else {
                uneven
            };
            zone.gap(bounds) <= limit + reach
        }
    }

    /// Whether a segment of a run overlaps the part. Asked only where that must tell a part deep in the run's face from
    /// one behind the face, past the run's end.
    fn is_overlapped(&self, run: &Run, overlap: &mut Overlap) -> bool {
        if let Overlap::Decided(overlapping) = *overlap {
            return overlapping;
        }
        let zone = self.pair.zone(self.side, &self.part);
        let verdict = |parts: Parts| parts.convex.verdict().overlapping;
        let met = self.chain.visit_where(self.is_near(&zone), |segment| {
            let is_of_run = self.chain.run_of(segment).is_some_and(|it| it.first() == run.first());
            if is_of_run
                && self.pair.with_segment(self.side, self.chain, (segment, self.part), verdict) == Some(true)
            {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        *overlap = Overlap::Decided(met.is_break());
        met.is_break()
    }

    /// A run as a surface, and the part's centre; `None` where the part does not see it.
    pub(super) fn surface(&self, run: &Run) -> Option<(Surface, Option<DVec2>)> {
        let pair = self.pair;
        let [chain_at, body_at] =
            if self.side == 0 { [DVec2::ZERO, pair.between] } else { [pair.between, DVec2::ZERO] };
        let turn = if self.side == 0 { &pair.turn_a } else { &pair.turn_b };
        let center = self.part.middle(body_at);
        Surface::new(self.chain, run, (turn, chain_at), center).map(|surface| (surface, center))
    }

    /// How the part touches a run.
    fn on_run(&self, run: &Run, patches: &mut Patches) -> Overlap {
        count_step();
        let pair = self.pair;
        let Some((surface, center)) = self.surface(run) else { return Overlap::Decided(false) };
        let turn = if self.side == 0 { &pair.turn_a } else { &pair.turn_b };
        let Some(chord) = self.chain.chord(run).map(Shape2::Segment) else { return Overlap::Decided(false) };
        let parts = pair.ordered(self.side, Part::segment(run.first(), &chord, turn), self.part);
        let limit = self.limit + run.unevenness();
        let Probe::Near(near) = parts.convex.probe(&Query { limit, hint: Hint::NONE, points: true }) else {
            return Overlap::Decided(false);
        };
        let mut overlap = overlap(&near, run);
        let Some(touch) = &near.touch else { return overlap };
        let preference = parts.convex.preference();
        let patch = |normal: DVec2, points: &[Point]| {
            Patch::new((normal, points), (&parts.place, self.side), run, &near)
        };
        let kernels = || patch(touch.normal, &touch.points);
        let away = if self.side == 0 { touch.normal } else { -touch.normal };
        let region = if center.is_none() { Region::Corner } else { surface.region_of(away) };
        let (made, spare) = match region {
            Region::Corner => (kernels(), None),
            Region::Beyond(_) => (None, kernels()),
            Region::Face | Region::Inner => {
                let edge = (surface.edge(), surface.normal);
                let points: ArrayVec<Point, 2> =
                    parts.convex.over_edge(self.side == 1, edge, limit, [false; 2]);
                let normal = if self.side == 0 { surface.normal } else { -surface.normal };
                let over = patch(normal, &points).map(Patch::deep_by_its_points);
                let over = over.filter(|over| {
                    let is_beyond = is_apart(&near, run) && over.is_behind();
                    !is_beyond && (!over.is_deep() || self.is_overlapped(run, &mut overlap))
                });
                // At a corner that is almost straight, rounding may find nothing over either face.
                let is_face = region == Region::Face;
                // A body's corner may be past the run's end by next to nothing. What is clipped there lies further up
                // the body's edge, by more the steeper that is.
                let is_missed = |over: &Patch| is_face && is_apart(&near, run) && over.is_above(&near);
                let over = over.filter(|over| !is_missed(over));
                if is_face { (over.or_else(kernels), None) } else { (over, kernels()) }
            }
        };
        match made.as_ref().and_then(|made| made.within(self.margin)) {
            Some(patch) => patches.add(patch, preference),
            None => patches.spare(made.or(spare)),
        }
        overlap
    }
}

/// Whether there is a gap beyond rounding.
///
/// If there is, what lies over the run is either in front of it, or behind it because it came past its end: the latter
/// is no contact of the run.
fn is_apart(near: &Near, run: &Run) -> bool {
    f64::from(near.separation) > f64::from(near.error) + run.unevenness()
}

/// What testing a run as one segment tells about overlap with its segments.
fn overlap(near: &Near, run: &Run) -> Overlap {
    if run.unevenness() == 0.0 {
        Overlap::Decided(near.verdict.overlapping)
    } else if is_apart(near, run) {
        Overlap::Decided(false)
    } else {
        Overlap::Open
    }
}
