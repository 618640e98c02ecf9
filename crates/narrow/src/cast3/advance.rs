//! Two convex parts, moved until they touch: from outside, by steps that are each certified.
//!
//! ```text
//! s = 0
//! repeat
//!   the gap at s: two bounds on it, and the unit axis n that shows the lower one         (polyhedron::closest)
//!   h = how far the motion may go before anything can reach across the gap along n       (step)
//!   h leads beyond the end:      n separates them for good: no impact
//!   the gap is within tolerance: an impact at s
//!   s = s + h
//! ```
//! Along a fixed axis n the gap of two shapes that only translate shrinks at the rate n.d: the step is their quotient,
//! and the next axis belongs to where that leads. This is Newton's iteration on the gap: for polytopes it ends after as
//! many steps as features are met, and it never steps too far (van den Bergen, "Ray casting against general convex
//! objects with application to continuous collision detection", 2004).
//!
//! With rotation the usual step is the gap over the fastest that any point may move (Mirtich 1996, "conservative
//! advancement"), which converges only linearly, and slowly where shapes graze. Here it is of second order:
//!
//! ```text
//! a vertex x of A moves along n by  h n.v + h^2/2 K at most,  v = its velocity at s,  K = a bound on all accelerations
//! n.(x + h w x r) = (n + h n x w).r + ..., so one support search along a turned axis gives the furthest vertex of all,
//!                                          each moved along its own tangent: the gap L(h), up to K h^2/2
//! L is concave in h (a least of straight lines): between two h it lies above its chord
//! h = the root of chord - K h^2/2; a shorter chord has a better root: repeated a few times
//! ```
//! Near the contact K h^2 vanishes beside the gap, and the iteration is Newton's again.
//!
//! The poses that callers make of a fraction are rounded, the rotation of a body that turns to f32. What that may take
//! from a gap, the slack, is left: so steps aim at the slack and a little more, and a pose that a motion was stopped at
//! overlaps nothing. Two that are nearer at the start may move away or along each other, and do not end any nearer.
//!
//! A half-space that turns has an axis that turns with it: the same, with the vertices of the other as seen from the
//! plane. Axes that turn are useful for other bodies as well. Where a body passes beside a face of one that turns, a
//! fixed axis shows no more of the gap than the far corner of that face leaves. So where steps are many, an axis that
//! turns along with either body is tried as well. Cost: a distance and a few support searches a step; and where the two
//! all but touch at the start, some more along the axes of the faces and edges there (`parting`).

use super::passage::{Course, Moment, length, outlasts_rounded};
use crate::polyhedron::closest::{Closest, Placed, closest};
use crate::precision::{closed_after, off_closing};
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

/// Steps after which the fraction that was reached is reported, with the gap that is left there.
const MAX_STEPS: usize = 256;

/// Steps after which axes that turn along with a body are tried as well.
const PATIENT: usize = 16;

/// Chords after which a step is good enough.
const MAX_CHORDS: usize = 6;

/// Share of their gap that a step leaves at least to two that are nearer than the slack: the less, the sooner those that
/// turn away get away.
const LEFT: f64 = 1.0 / 16.0;

/// How the motion of two parts ends.
pub(super) enum End {
    /// They do not touch before the limit.
    Apart,
    /// They touch, or come near enough to count as touching.
    Met(Met),
    /// They overlap at the start, or rounding leaves open whether they do; and whether, if they do not, they come no
    /// nearer than they are.
    Unclear(Met, bool),
}

/// Where two parts have come so close that they count as touching.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) fraction: f64,
    /// An upper bound on the gap, in metres.
    pub(super) gap: f64,
    /// Unit axis from A to B.
    pub(super) normal: DVec3,
    /// Points of the shapes' surfaces, each relative to its own body's position.
    pub(super) anchors: [DVec3; 2],
}

/// How far the motion may go, judged along one axis.
#[derive(Clone, Copy)]
enum Step {
    /// To the limit and beyond.
    Free,
    /// By this fraction; and a lower bound on the gap that the axis shows after it.
    By(f64, f64),
}

/// The body that an axis turns along with, if any.
type Carrier = Option<usize>;

/// Moves two parts until they touch, or until the limit, a fraction.
pub(super) fn advance(course: &Course, until: f64) -> End {
    let passage = course.passage;
    let mut towards = (passage.between + (course.parts[1].center - course.parts[0].center))
        .try_normalize()
        .unwrap_or(DVec3::X);
    let (mut fraction, mut kept) = (0.0, f64::NEG_INFINITY);
    // As long as two that turn are as near as counts as met since the start: how, and how near, they started.
    let (mut met, mut start): (Option<Met>, Option<(Met, f64)>) = (None, None);
    for number in 0..MAX_STEPS {
        let moment = course.at(fraction);
        let mut found = closest(&moment.a, &moment.b, towards, &moment.precision);
        let doubt = moment.precision.projection();
        found.at_least -= course.radii + doubt;
        let at_most = found.at_most - course.radii + doubt;
        let gap = at_most + course.rounding(fraction, moment.between);
        // The axis that led here still shows the gap that it was left with; a new one may show less, by rounding. But a
        // half-space has no other than its own, which has turned.
        if found.at_least < kept && !course.has_plane() {
            (found.at_least, found.normal) = (kept, towards);
        }
        let is_near = at_most <= course.slack + course.fineness.gap(doubt);
        let may_part = fraction == 0.0 && is_near && !passage.is_straight();
        let apart = if may_part { course.turns_apart(&moment, &mut found, at_most, until) } else { None };
        let here = course.met(&moment, &found, (fraction, gap));
        if let Some((away, axis)) = apart {
            start = Some((here, f64::NEG_INFINITY));
            (fraction, towards, kept) = (away, axis, f64::NEG_INFINITY);
            continue;
        }
        if found.at_least <= 0.0 {
            if fraction > 0.0 {
                return End::Met(start.map_or(here, |(start, _)| start));
            }
            return End::Unclear(here, course.comes_no_nearer(&moment, &found, until));
        }
        start = match start {
            _ if !is_near => None,
            Some((start, level)) if found.at_least < level - 4.0 * doubt => return End::Met(start),
            None if fraction == 0.0 && !passage.is_straight() => Some((here, found.at_least)),
            start => start,
        };
        let carriers: &[Carrier] = if number < PATIENT { &[None] } else { &[None, Some(0), Some(1)] };
        let Some((step, left, carrier)) = course.longest_step(&moment, &found, [fraction, until], carriers)
        else {
            return End::Apart;
        };
        // Never too far, whatever the sum's rounding.
        let next = (fraction + step).next_down();
        if is_near && start.is_none() || next <= fraction {
            return End::Met(start.map_or(here, |(start, _)| start));
        }
        met = Some(here);
        let next = next.min(until);
        (towards, kept) = (course.carried(found.normal, carrier, [fraction, next]), left);
        fraction = next;
    }
    match met {
        Some(met) if !course.rounds_pass(&met, until) => End::Met(start.map_or(met, |(start, _)| start)),
        _ => End::Apart,
    }
}

impl Course<'_> {
    fn met(&self, moment: &Moment, found: &Closest, (fraction, gap): (f64, f64)) -> Met {
        let radius = |i: usize| f64::from(self.parts[i].shape.radius());
        let [on_a, on_b] = found.points;
        let anchors = [on_a + found.normal * radius(0), on_b - moment.between - found.normal * radius(1)];
        Met { fraction, gap: gap.max(0.0), normal: found.normal, anchors }
    }

    /// Whether all that a body may sweep by turning about its axis stays clear along the axis of a meeting, from then
    /// on until the limit: shows, where steps get no further, that a wheel of many sides rolls past another for good.
    /// What is swept does not turn: along one axis its gap is least at one of the two ends.
    fn rounds_pass(&self, met: &Met, until: f64) -> bool {
        let turns = &self.passage.turns;
        let is_plane = |i: usize| matches!(self.parts[i].shape, Shape3::HalfSpace(_));
        // Where nothing turns, this shows nothing new; a plane that turns sweeps over all of space.
        if self.passage.is_straight() || (0..2).any(|i| turns[i].is_some() && is_plane(i)) {
            return false;
        }
        let moment = self.at(met.fraction);
        let placed = [&moment.a, &moment.b];
        // How far a part reaches from its body's position.
        let reach = |i: usize, along: DVec3| match (placed[i], turns[i]) {
            (Placed::HalfSpace(_), _) => 0.0,
            (Placed::Core(solid), None) if i == 0 => solid.support(along).reach,
            (Placed::Core(solid), None) => solid.support(along).reach - along.dot(moment.between),
            // A cylinder about the axis, as long as the body is along it.
            (Placed::Core(solid), Some(turn)) => {
                let (axis, origin) = (turn.axis(), if i == 0 { DVec3::ZERO } else { moment.between });
                let lengthwise = if axis.dot(along) < 0.0 { -axis } else { axis };
                let longest = solid.support(lengthwise).reach - lengthwise.dot(origin);
                lengthwise.dot(along) * longest + axis.cross(along).length() * self.arms[i].from_axis
            }
        };
        let reaches = reach(0, met.normal) + reach(1, -met.normal) + self.radii;
        let doubt = self.slack + self.fineness.gap(moment.precision.projection());
        [met.fraction, until]
            .into_iter()
            .all(|fraction| met.normal.dot(self.passage.between_at(fraction)) - reaches > doubt)
    }

    /// An upper bound on the speed at which the gap along an axis closes, without what turning adds.
    pub(super) fn closing(&self, axis: DVec3) -> f64 {
        axis.dot(self.passage.drift) + off_closing(self.passage.drift)
    }

    /// The longest step by the axis that was found, turning along with whichever of the `carriers`; `None` if one of
    /// these shows that the two stay apart.
    fn longest_step(
        &self,
        moment: &Moment,
        found: &Closest,
        times: [f64; 2],
        carriers: &[Carrier],
    ) -> Option<(f64, f64, Carrier)> {
        let mut longest = (0.0, f64::NEG_INFINITY, None);
        for &carrier in carriers.iter().filter(|carrier| self.may_carry(**carrier)) {
            let Step::By(step, left) = self.step(moment, (found, carrier), times) else { return None };
            if carrier.is_none() || step > longest.0 {
                longest = (step, left, carrier);
            }
        }
        Some(longest)
    }

    /// Whether an axis may turn along with a body: only if that turns, and neither is a half-space, which has an axis
    /// of its own.
    fn may_carry(&self, carrier: Carrier) -> bool {
        carrier.is_none_or(|i| self.passage.turns[i].is_some() && !self.has_plane())
    }

    fn has_plane(&self) -> bool {
        self.parts.iter().any(|part| matches!(part.shape, Shape3::HalfSpace(_)))
    }

    /// Where an axis that turns along with a body is, a while later.
    fn carried(&self, axis: DVec3, carrier: Carrier, [from, to]: [f64; 2]) -> DVec3 {
        let Some(turn) = carrier.and_then(|i| self.passage.turns[i]) else { return axis };
        turn.basis_at(to).turn(turn.basis_at(from).turn_back(axis)).normalize_or(axis)
    }

    /// How far the motion may go before the shapes can touch, by an axis and the body it turns along with.
    fn step(
        &self,
        moment: &Moment,
        (found, carrier): (&Closest, Carrier),
        [fraction, until]: [f64; 2],
    ) -> Step {
        let span = until - fraction;
        let closing = self.closing(found.normal);
        let rest = self.fineness.rest(moment.precision.projection());
        let aim = self.slack + rest;
        if moment.spins == [DVec3::ZERO; 2] {
            let gap = (found.at_least - self.slack, self.slack);
            if outlasts_rounded(gap, closing, (self.passage.drift, span)) {
                return Step::Free;
            }
            let step = closed_after(found.at_least - aim, closing);
            return Step::By(step, found.at_least * (1.0 - 4.0 * f64::EPSILON) - closing * step);
        }
        if let (Placed::HalfSpace(_), Placed::HalfSpace(_)) = (&moment.a, &moment.b) {
            // No longer parallel, half-spaces meet far out at once.
            return Step::By(0.0, found.at_least);
        }
        let axis = (found.normal, carrier);
        let mut bend = self.bend(moment, carrier, [fraction, span]);
        let at_end = self.shown(moment, axis, closing, span);
        // Never as near as poses may be off, or never nearer than now.
        let least = at_end - 0.5 * bend * span * span;
        if least > self.slack || least >= found.at_least {
            return Step::Free;
        }
        // Those that start nearer may come nearer yet for a while, if only they do not stay so: `advance` sees to it.
        let (aim, left) = if found.at_least > aim {
            (aim, self.slack + 0.5 * rest)
        } else {
            // Of what is certain in rounded poses, if anything is.
            let sure = if found.at_least > self.slack { self.slack } else { 0.0 };
            let some = (found.at_least - sure) * LEFT;
            (sure + some, sure + 0.5 * some)
        };
        let free = found.at_least - aim;
        let (mut step, mut chord, mut end) = (0.0, span, at_end);
        for _ in 0..MAX_CHORDS {
            // The root of free + slope h - bend h^2 / 2.
            let slope = (end - found.at_least) / chord;
            let width = (slope * slope + 2.0 * bend * free).sqrt();
            let root = if slope > 0.0 { (width + slope) / bend } else { 2.0 * free / (width - slope) };
            // Nothing is known beyond the chord.
            let next = if root < chord { root } else { chord };
            if next <= step * 1.0625 {
                break;
            }
            step = next;
            chord = (2.0 * step).min(span);
            end = self.shown(moment, axis, closing, chord);
            bend = self.bend(moment, carrier, [fraction, chord]);
        }
        Step::By(step * (1.0 - 16.0 * f64::EPSILON), left)
    }

    /// The separation along an axis after a step in which every vertex moves along its own tangent: a lower bound, but
    /// for the curvature of the paths.
    pub(super) fn shown(
        &self,
        moment: &Moment,
        (axis, carrier): (DVec3, Carrier),
        closing: f64,
        step: f64,
    ) -> f64 {
        let [spin_a, spin_b] = moment.spins.map(|spin| spin * step);
        let [a, b] = [&moment.a, &moment.b];
        let takes_along =
            |i: usize, placed: &Placed| carrier == Some(i) || matches!(placed, Placed::HalfSpace(_));
        // A half-space takes its axis along.
        let mut along = axis;
        if takes_along(0, a) {
            along += spin_a.cross(axis);
        }
        if takes_along(1, b) {
            along += spin_b.cross(axis);
        }
        // Along an axis that turns with it, a body always reaches equally far.
        let axis_for =
            |i: usize, spin: DVec3| if carrier == Some(i) { axis } else { along + axis.cross(spin) };
        let reach_a = match a {
            Placed::Core(solid) => solid.support(axis_for(0, spin_a)).reach,
            Placed::HalfSpace(_) => 0.0,
        };
        let reach_b = match b {
            // From B's own position.
            Placed::Core(solid) => {
                let along = axis_for(1, spin_b);
                solid.support(-along).reach + along.dot(moment.between)
            }
            Placed::HalfSpace(_) => 0.0,
        };
        let longest = 1.0 + length(spin_a) + length(spin_b);
        let doubt = moment.precision.projection() * longest;
        along.dot(moment.between) - closing * step - reach_a - reach_b - self.radii - doubt
    }

    /// A bound on any vertex' acceleration along an axis, from here until `span` later.
    pub(super) fn bend(&self, moment: &Moment, carrier: Carrier, [fraction, span]: [f64; 2]) -> f64 {
        let bounds = self.passage.turns.map(|turn| match turn {
            Some(turn) => turn.bounds_within(fraction, fraction + span),
            None => [0.0; 2],
        });
        let (speed, change) = (|i: usize| bounds[i][0], |i: usize| bounds[i][1]);
        let drift = self.passage.drift.length();
        let apart = moment.between.length() + drift * span;
        let of = |i: usize| {
            let (own, other) = (change(i) + speed(i) * speed(i), 1 - i);
            if carrier == Some(i) || matches!(self.parts[i].shape, Shape3::HalfSpace(_)) {
                // Seen from a half-space that turns, or from the body that carries the axis, all that moves is on a
                // curve.
                let arm = self.arms[other];
                return own * (apart + arm.from_position)
                    + 2.0 * speed(i) * (drift + speed(other) * arm.from_axis);
            }
            own * self.arms[i].from_axis
        };
        (of(0) + of(1)) * (1.0 + 64.0 * f64::EPSILON)
    }
}
