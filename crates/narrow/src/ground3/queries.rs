//! Overlap and separation of a body and ground.
//!
//! Ground is the union of its triangles, as a compound is of its parts, and is tested in the same way: each convex part
//! of the body against each triangle near it, as two convex shapes, with the same error and the same exactness.
//!
//! ```text
//! overlap      triangles whose boxes the part's box meets: apart along the triangle's normal, or along the axis to its
//!              nearest point; a point of it in the sphere or cuboid inside the part; else as any pair
//! separation   a sphere that is apart from all triangles: in closed form                                   (sphere)
//!              triangles in the order of their boxes' distances, up to the least separation so far:
//!                beyond an upper bound from a point of the part and one of a triangle seen before: skipped
//!                else it waits
//!              those that wait, the least lower bound first:
//!                the axis found last shows it no nearer than the least separation so far: skipped
//!                else as any pair
//! ```
//! Kernels are expensive, and most triangles around the nearest share its nearest corner or edge. What the bounds save,
//! over hills: kernel calls per query, 9.4 to 1.8 for hulls of 32, 5.1 to 2.2 for boxes; time, 11.0 us to 6.4, and 7.3
//! to 5.6 (AMD EPYC, Zen 4, 2026-11-22).
//!
//! Between two grounds, each triangle of one is tested against the triangles of the other that are near it.

use super::bounds::Corners;
use super::near::{OnGround, grown_around};
use super::sides::sphere_of;
use crate::answer::{Closest3, Measured3, Separation3, Tier, Verdict};
use crate::counted::count_step;
use crate::feature::Hint;
use crate::least::Least;
use crate::pair3::{Pair3, Part, Parts, for_parts};
use crate::polyhedron::convex::{Near, Probe, Query, Wanted};
use crate::precision::round_down;
use arrayvec::ArrayVec;
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Aabb3, Basis3, Ground, Shape3};
use core::ops::ControlFlow;

/// Most triangles that wait, as an upper bound from another may show that they are too far away.
const MOST_WAITING: usize = 16;

/// What is reported of the nearest triangle.
pub(super) struct NearestTriangle {
    pub(super) parts: [u32; 2],
    pub(super) separation: f32,
    pub(super) normal: Vec3,
    pub(super) closest: Option<[Vec3; 2]>,
}

impl OnGround<'_> {
    /// Visits the convex parts of the body until the visitor says to stop; returns whether it did. A body that is
    /// ground itself has its triangles for parts: those that may be within `reach` metres.
    pub(crate) fn for_body_parts(&self, reach: f64, mut visit: impl FnMut(&Part) -> bool) -> bool {
        let Some(body) = Ground::of(self.body) else {
            return for_parts(self.body, &self.body_basis, |part| visit(&part));
        };
        let flow = body.visit_near(&self.bounds_for(reach), |number| {
            let stops = self.as_part(body, number, &mut visit).unwrap_or(false);
            if stops { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        flow.is_break()
    }

    fn as_part<R>(&self, body: Ground, number: u32, visit: impl FnOnce(&Part) -> R) -> Option<R> {
        let triangle = Shape3::Triangle(body.triangle(number)?);
        let mut part = Part::whole(&triangle, &self.body_basis);
        part.index = number;
        Some(visit(&part))
    }

    /// A box around the ground in the axes of a body that is ground too, grown by some metres.
    fn bounds_for(&self, reach: f64) -> Aabb3 {
        let (center, radius) = sphere_of(self.ground);
        let center = self.body_basis.turn_back(self.basis.turn(center) - self.to_body);
        grown_around([center; 2], radius + reach, self.to_body.length() + center.length() + radius)
    }
}

impl Pair3<'_> {
    pub(crate) fn verdict_on(&self, on: &OnGround) -> Verdict {
        let mut tier = Tier::Bound;
        let overlapping = self.any_on(on, false, |parts| {
            let verdict = parts.convex.verdict();
            tier = tier.max(verdict.tier);
            verdict.overlapping
        });
        Verdict { overlapping, tier }
    }

    pub(crate) fn guess_on(&self, on: &OnGround) -> bool {
        self.any_on(on, false, |parts| parts.convex.guess())
    }

    /// Whether any part overlaps a triangle that faces it.
    pub(crate) fn overlaps_facing(&self, on: &OnGround) -> bool {
        self.gap_of_spheres() <= 0.0 && self.any_on(on, true, |parts| parts.convex.verdict().overlapping)
    }

    /// Whether the answer is yes for any part and a triangle near it.
    fn any_on(&self, on: &OnGround, only_facing: bool, mut test: impl FnMut(&Parts) -> bool) -> bool {
        let bases = on.in_order([on.body_basis, on.basis]);
        on.for_body_parts(0.0, |part| {
            let placed = Corners::of(on, part);
            let flow = on.ground.visit_near(&placed.bounds(0.0, part), |number| {
                count_step();
                let corners = on.ground.corners(number);
                let beside = placed.beside(corners);
                let is_candidate = placed.gap(&beside, 0.0) <= 0.0
                    && (!only_facing || on.is_facing(corners, placed.viewpoint));
                let mut by_kernels = || {
                    let triangle = on.ground.triangle(number).map(Shape3::Triangle);
                    triangle.is_some_and(|it| test(&self.parts_on(on, &bases, *part, (number, &it))))
                };
                let is_yes = is_candidate && (placed.holds_some(&beside) || by_kernels());
                if is_yes { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            flow.is_break()
        })
    }

    /// A part of the body and a triangle of the ground.
    pub(crate) fn parts_on<'s>(
        &'s self,
        on: &OnGround,
        bases: &[Basis3; 2],
        part: Part<'s>,
        (number, triangle): (u32, &'s Shape3),
    ) -> Parts<'s> {
        let mut of_ground = Part::whole(triangle, &on.basis);
        of_ground.index = number;
        let [a, b] = on.in_order([part, of_ground]);
        self.parts(bases, a, b)
    }

    pub(crate) fn separation_on(&self, on: &OnGround, limit: f64) -> Separation3 {
        match self.nearest_on(on, limit, Wanted::Number) {
            Ok((NearestTriangle { separation, normal, .. }, error)) => {
                Separation3::Measured(Measured3 { separation, error, normal })
            }
            Err(at_least) => Separation3::AtLeast(at_least),
        }
    }

    pub(crate) fn distance_on(&self, on: &OnGround) -> Option<Closest3> {
        let (nearest, error) = self.nearest_on(on, f64::INFINITY, Wanted::Closest).ok()?;
        let [anchor_a, anchor_b] = nearest.closest?;
        let NearestTriangle { parts: [part_a, part_b], separation: distance, normal, .. } = nearest;
        Some(Closest3 { distance, error, normal, anchor_a, anchor_b, part_a, part_b })
    }

    /// The part and triangle with the least separation and the error that covers all others, or a bound where all are
    /// beyond the limit.
    fn nearest_on(&self, on: &OnGround, limit: f64, wanted: Wanted) -> Result<(NearestTriangle, f32), f32> {
        let gap = self.gap_of_spheres();
        if gap > limit {
            return Err(round_down(gap));
        }
        let mut least = Least::within(limit);
        // The bound for triangles whose boxes are beyond the limit.
        least.give_up(round_down(limit));
        let bases = on.in_order([on.body_basis, on.basis]);
        let mut look = |part: &Part| self.look_around(on, &bases, (part, wanted), &mut least);
        if let Some(body) = Ground::of(on.body) {
            body.visit_nearest(&on.bounds_for(0.0), limit, |number| {
                on.as_part(body, number, &mut look).unwrap_or(f64::INFINITY)
            });
        } else {
            for_parts(on.body, &on.body_basis, |part| {
                look(&part);
                false
            });
        }
        least.finish()
    }

    /// Offers the triangles near a part; returns the distance within which others still matter.
    fn look_around(
        &self,
        on: &OnGround,
        bases: &[Basis3; 2],
        (part, wanted): (&Part, Wanted),
        least: &mut Least<NearestTriangle>,
    ) -> f64 {
        if matches!(part.shape, Shape3::Sphere(_)) && self.look_around_ball(on, part, least) {
            return least.reach();
        }
        let placed = &Corners::of(on, part);
        let mut kernels = KernelCalls { pair: self, on, bases, part, wanted, placed, shown: None };
        let mut waiting: ArrayVec<(f64, u32), MOST_WAITING> = ArrayVec::new();
        let mut at_most = f64::INFINITY;
        // The core's box: the box around a ball has corners that are nearer than the ball.
        let radius = f64::from(part.shape.radius());
        on.ground.visit_nearest(&placed.bounds(-radius, part), least.reach() + radius, |number| {
            let beside = placed.narrowed(&placed.beside(on.ground.corners(number)));
            let gap = placed.gap(&beside, least.reach().min(at_most));
            if !least.passes_below(gap, at_most) {
                at_most = at_most.min(placed.at_most(&beside));
                if waiting.is_full() {
                    waiting.retain(|(gap, _)| !least.passes_below(*gap, at_most));
                }
                if let Err(full) = waiting.try_push((gap, number)) {
                    kernels.measure(full.element().1, least);
                }
            }
            least.reach().min(at_most) + radius
        });
        waiting.sort_unstable_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        for (gap, number) in waiting {
            if !least.passes_below(gap, at_most) {
                kernels.measure(number, least);
            }
        }
        least.reach()
    }
}

/// Calls the kernels for a part and triangles, one after the other.
struct KernelCalls<'s> {
    pair: &'s Pair3<'s>,
    on: &'s OnGround<'s>,
    bases: &'s [Basis3; 2],
    part: &'s Part<'s>,
    wanted: Wanted,
    placed: &'s Corners,
    /// The axis found last, from the part to the ground in the ground's axes, and how far the part reaches along it.
    shown: Option<(DVec3, f64)>,
}

impl KernelCalls<'_> {
    /// Calls the kernels for one triangle, unless the last axis shows that it is no nearer than the nearest so far:
    /// most often both share the nearest corner or edge.
    fn measure(&mut self, number: u32, least: &mut Least<NearestTriangle>) {
        let Self { pair, on, bases, part, wanted, placed, .. } = *self;
        let beside = &placed.beside(on.ground.corners(number));
        let is_no_less = |shown: (DVec3, f64)| least.is_no_less(placed.beyond(shown, beside));
        if self.shown.is_some_and(is_no_less) || placed.towards(part, beside).is_some_and(is_no_less) {
            return;
        }
        let Some(triangle) = on.ground.triangle(number).map(Shape3::Triangle) else { return };
        let parts = pair.parts_on(on, bases, *part, (number, &triangle));
        match parts.convex.probe(Query { limit: least.reach(), hint: Hint::NONE, wanted }) {
            Probe::Beyond(at_least, _) => least.give_up(at_least),
            Probe::Near(near) => {
                let towards = on.basis.turn_back(parts.basis.turn(near.normal));
                let towards = if on.is_b { towards } else { -towards };
                self.shown = Some((towards, placed.top(part, towards)));
                least.offer(nearest_triangle(&parts, &near), near.separation, near.error);
            }
        }
    }
}

fn nearest_triangle(parts: &Parts, near: &Near) -> NearestTriangle {
    NearestTriangle {
        parts: parts.indices,
        separation: near.separation,
        normal: parts.basis.turn(near.normal).as_vec3(),
        closest: near.closest.map(|[on_a, on_b]| [parts.anchor_a(on_a), parts.anchor_b(on_b)]),
    }
}
