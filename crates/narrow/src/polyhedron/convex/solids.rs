//! Solids: the order of the searches, the decision, and the number that agrees with it.
//!
//! ```text
//! contact points   the distance, if last frame's hint, or the one that this answer leaves, finds it     (sat::across)
//! hull or cuboid   whether last frame's direction still separates it from another, by bounds in f32     (parted)
//! two cuboids      all fifteen axes; in a gap, or where those cannot decide, the distance
//! anything else    last frame's axis, or one near it; for pairs that meet for the first time, a face's  (sat::walk)
//!                  a search for a separating direction, or for a common point                           (portal)
//!                  the distance, if there may be one within the limit                                   (distance)
//!                  the best axis, in overlap, and where contact points are wanted                       (sat)
//! ```
//! Most pairs that a broad phase hands over are apart, and most others overlap by more than rounding: what
//! distinguishes them comes first, and the axes, of which there are thousands, only when the depth is wanted. In a gap
//! no contact is built on the axes of edges, and only those of faces are evaluated.

use super::{Convex, Evidence, Near, Probe, Query, Wanted};
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Corner};
use crate::feature::Hint;
use crate::polyhedron::cuboids::{Cuboids, Outcome};
use crate::polyhedron::distance::{Close, Reached, Until, Witness, distance};
use crate::polyhedron::manifold::{TouchInput, nearest_edges, touch};
use crate::polyhedron::portal::{self, Found};
use crate::polyhedron::sat::{
    Axes, Axis, Ended, Hinted, Search, across_edges, face_axes, first_axis, hint_of, hint_to, separating_axes,
};
use crate::polyhedron::solid::Solid;
use crate::precision::{at_least, signed};
use asunder_geometry::glam::DVec3;

/// How two cores lie, as far as the distance iteration has found out.
#[allow(clippy::large_enum_variant, reason = "as Probe")]
enum Cores {
    /// Overlapping, or apart by at most this many metres.
    Within(f64),
    /// Two bounds on their distance, with witness points.
    Between(Witness),
}

const OVERLAPPING: Verdict = Verdict { overlapping: true, tier: Tier::Bound };
const DOUBLE_OVERLAP: Verdict = Verdict { overlapping: true, tier: Tier::Double };

impl Convex<'_> {
    pub(super) fn probe_solids(&self, a: &Solid, b: &Solid, query: Query) -> Probe {
        let beyond = query.limit + self.radii + self.precision.projection();
        // For hulls and cuboids, bounds in f32 left this open (`parted`); for all others it is the first test.
        if let Some(direction) = query.hint.direction() {
            let separation = -b.support(-direction).reach - a.support(direction).reach;
            if separation > beyond {
                return self.beyond(separation, query.hint);
            }
        }
        let hinted = Hinted::new((a, b), query.hint, &self.precision);
        if let Some(Hinted { axis, .. }) = &hinted
            && axis.separation > beyond
        {
            return self.beyond(axis.separation, query.hint);
        }
        if query.wanted == Wanted::Points
            && let Some((axes, witness)) = self.gap_by_hint((a, b), query.hint, hinted.as_ref())
        {
            return self.probe_gap_by_hint((a, b), axes, witness, query.hint);
        }
        // Closest points come from the distance, not from axes. Only pairs that nearly touch come here for them: others
        // took the fastest path (`apart`).
        if query.wanted != Wanted::Closest
            && let Some(cuboids) = self.cuboids()
        {
            return self.probe_cuboids(&cuboids, (a, b), beyond, query.wanted);
        }
        let hinted = hinted.or_else(|| self.first_axis((a, b), query.wanted));
        if let Some(hinted) = &hinted {
            if hinted.axis.separation > beyond {
                return self.beyond(hinted.axis.separation, hint_of(&hinted.axis));
            }
            match hinted.walk((a, b), &self.precision) {
                Ended::Best(axes) => return self.overlap_of_cores(axes, OVERLAPPING, 0.0),
                Ended::Apart(axis) if axis.separation > beyond => {
                    return self.beyond(axis.separation, hint_of(&axis));
                }
                _ => {}
            }
        }
        let reached = match portal::search(a, b, beyond, &self.precision) {
            Found::Beyond(direction, separation) => return self.beyond(separation, Hint::towards(direction)),
            Found::Overlap if query.wanted == Wanted::Closest => return self.just_overlapping(),
            Found::Overlap => return self.overlap_by_axes((a, b), hinted),
            Found::Nothing(direction) => {
                let until = Until { beyond, ..Until::met(&self.precision) };
                distance(a, b, direction, &until)
            }
        };
        self.probe_reached((a, b), reached, (beyond, query.wanted))
    }

    /// The probe's answer from where the search for closest points ended.
    #[inline(always)]
    fn probe_reached(
        &self,
        (a, b): (&Solid, &Solid),
        reached: Reached,
        (beyond, wanted): (f64, Wanted),
    ) -> Probe {
        match reached {
            Reached::Origin(Close { is_proved: true, .. }) if wanted == Wanted::Closest => {
                self.just_overlapping()
            }
            Reached::Between(witness) if witness.at_least > beyond => {
                self.beyond(witness.at_least, Hint::towards(witness.normal))
            }
            Reached::Between(witness) if witness.is_plain(&self.precision) => {
                let (verdict, is_gap) = self.conclude_gap(&witness);
                if !is_gap {
                    let axes = self.all_axes(a, b, f64::NEG_INFINITY);
                    return self.probe_close((a, b), axes, (verdict, Cores::Within(0.0)), wanted);
                }
                if wanted != Wanted::Points {
                    let hint = Hint::towards(witness.normal);
                    return self.gap_of_cores(Axes::NONE, verdict, witness, hint);
                }
                // The axes show which faces lie opposite each other.
                let axes = self.face_axes(a, b, witness.at_least);
                self.probe_close((a, b), axes, (verdict, Cores::Between(witness)), wanted)
            }
            reached => {
                let axes = self.all_axes(a, b, f64::NEG_INFINITY);
                let closer = self.closer(reached, Some(axes.best()));
                self.probe_close((a, b), axes, closer, wanted)
            }
        }
    }

    /// The axis to start from where there is no hint. A walk from there most often decides pairs that meet for the
    /// first time, without a search: hulls face on face 0.72 to 0.8 of the time, what a broad phase hands over 0.94
    /// (AMD EPYC, Zen 4, 2026-11-26). For deeply overlapping pairs it seldom does, and there the search costs nothing.
    fn first_axis(&self, (a, b): (&Solid, &Solid), wanted: Wanted) -> Option<Hinted> {
        let is_deep = || {
            let apart = (a.center() - b.center()).length();
            portal::do_spheres_meet(a, b, apart, &self.precision)
        };
        if wanted == Wanted::Closest || is_deep() {
            return None;
        }
        first_axis(a, b, &self.search(f64::NEG_INFINITY))
    }

    /// The answer for solids that certainly overlap, where the axis that was started from, last frame's or a face's,
    /// was not proved to be the best. Most often it nearly is, and what shows less is culled.
    fn overlap_by_axes(&self, (a, b): (&Solid, &Solid), hinted: Option<Hinted>) -> Probe {
        let doubt = 8.0 * self.precision.projection();
        let unproved = hinted.map_or(f64::NEG_INFINITY, |hinted| hinted.axis.separation);
        let search = Search { unproved, ..self.search(unproved - doubt) };
        self.overlap_of_cores(separating_axes(a, b, &search), OVERLAPPING, 0.0)
    }

    fn probe_cuboids(
        &self,
        cuboids: &Cuboids,
        (a, b): (&Solid, &Solid),
        beyond: f64,
        wanted: Wanted,
    ) -> Probe {
        let axes = match cuboids.separating_axes(a, b, beyond, &self.precision) {
            Outcome::Beyond(axis) => return self.beyond(axis.separation, hint_of(&axis)),
            Outcome::Within(axes) => axes,
        };
        // Axes of faces that were derived or merged prove nothing; those of cuboids do.
        if axes.best().separation + axes.short() < -2.0 * self.precision.projection() {
            return self.overlap_of_cores(axes, OVERLAPPING, 0.0);
        }
        let closer = self.look_closer(a, b, Some(axes.best()));
        self.probe_close((a, b), axes, closer, wanted)
    }

    /// The answer for overlapping cores where only closest points were wanted: they have none.
    fn just_overlapping(&self) -> Probe {
        Probe::Near(Near {
            verdict: OVERLAPPING,
            separation: 0.0,
            error: f32::INFINITY,
            normal: DVec3::X,
            closest: None,
            hint: Hint::NONE,
            evidence: Evidence::Axes(Axes::NONE, None),
        })
    }

    pub(super) fn beyond(&self, separation: f64, hint: Hint) -> Probe {
        Probe::Beyond(at_least(separation - self.radii, &self.precision), hint)
    }

    /// The answer once all axes are known, and how the cores lie.
    fn probe_close(
        &self,
        (a, b): (&Solid, &Solid),
        axes: Axes,
        closer: (Verdict, Cores),
        wanted: Wanted,
    ) -> Probe {
        match closer {
            // The search proved no gap, and all axes show an overlap. Not where the radii close a gap between the
            // cores: then only the axes of faces were evaluated.
            (verdict, Cores::Between(witness))
                if verdict.overlapping
                    && witness.at_least <= self.precision.projection()
                    && axes.best().separation > f64::NEG_INFINITY
                    && axes.best().separation + axes.short() < 0.0 =>
            {
                self.overlap_of_cores(axes, verdict, witness.distance)
            }
            (verdict, Cores::Between(witness)) => {
                let hint = self.hint_across((a, b), &axes, &witness, wanted);
                // The gap that this hint will find in the next frame is reported now: an answer does not depend on its
                // own hint.
                if wanted == Wanted::Points {
                    let hinted = Hinted::new((a, b), hint, &self.precision);
                    if let Some((axes, witness)) = self.gap_by_hint((a, b), hint, hinted.as_ref()) {
                        return self.probe_gap_by_hint((a, b), axes, witness, hint);
                    }
                }
                self.gap_of_cores(axes, verdict, witness, hint)
            }
            (verdict, Cores::Within(gap)) if verdict.overlapping => self.overlap_of_cores(axes, verdict, gap),
            (verdict, Cores::Within(gap)) => self.all_but_touching(a, b, axes, (verdict, gap)),
        }
    }

    /// The gap that a hint finds by itself, and its axis.
    fn gap_by_hint(
        &self,
        (a, b): (&Solid, &Solid),
        hint: Hint,
        hinted: Option<&Hinted>,
    ) -> Option<(Axes, Witness)> {
        match hint.direction() {
            Some(direction) => across_edges((a, b), direction, &self.precision),
            None => hinted?.across((a, b), &self.precision),
        }
    }

    /// The answer for a gap that a hint found. The hint is kept: the next answer comes from the same one.
    fn probe_gap_by_hint(&self, (a, b): (&Solid, &Solid), axes: Axes, witness: Witness, hint: Hint) -> Probe {
        match self.conclude_gap(&witness) {
            (verdict, true) => self.gap_of_cores(axes, verdict, witness, hint),
            // Not reached: a gap between the cores that a hint finds is wider than rounding.
            (verdict, false) => self.overlap_of_cores(self.all_axes(a, b, f64::NEG_INFINITY), verdict, 0.0),
        }
    }

    /// The answer for shapes whose cores overlap, or have a gap too small for any axis to show: as deep as the best
    /// axis says. `gap` is the most that the gap can be.
    fn overlap_of_cores(&self, axes: Axes, verdict: Verdict, gap: f64) -> Probe {
        let best = *axes.best();
        let depth = best.separation - self.radii;
        Probe::Near(Near {
            verdict,
            separation: signed(depth, true),
            error: self.precision.of_separation(depth, self.short(&axes, gap)),
            normal: best.normal,
            closest: None,
            hint: hint_of(&best),
            evidence: Evidence::Axes(axes, None),
        })
    }

    /// By how much the true separation may exceed that of the best axis, for cores that are apart by at most `gap`.
    ///
    /// In overlap the axes tested are all there are. In a gap the best axis may be none of them, and only witness
    /// points give a bound.
    fn short(&self, axes: &Axes, gap: f64) -> f64 {
        let (best, short) = (axes.best().separation, axes.short());
        if best + short < 0.0 { short } else { short.max(gap - best) }
    }

    /// The answer for shapes with a gap between their cores, which their radii may close.
    fn gap_of_cores(&self, axes: Axes, verdict: Verdict, witness: Witness, hint: Hint) -> Probe {
        let precision = self.precision;
        let (separation, gap) = precision.of_gap(witness.distance, witness.at_least, self.radii);
        let closest = self.on_surfaces([witness.point_a, witness.point_b], witness.across);
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: precision.of_distance(separation, gap),
            normal: witness.normal,
            closest: (!verdict.overlapping).then_some(closest),
            hint,
            evidence: Evidence::Axes(axes, Some(witness)),
        })
    }

    /// The hint for the next frame: the best axis, where that is the axis of the distance; else the nearest edges; else
    /// the direction. Edges are looked for only where contact points are wanted.
    fn hint_across(&self, (a, b): (&Solid, &Solid), axes: &Axes, witness: &Witness, wanted: Wanted) -> Hint {
        let best = axes.best();
        if best.separation >= witness.at_least - 2.0 * self.preference() {
            return hint_of(best);
        }
        let edges = if wanted == Wanted::Points { nearest_edges(a, b, witness) } else { None };
        edges.map_or(Hint::towards(witness.normal), hint_to)
    }

    /// Whether solids overlap, other than two cuboids.
    pub(super) fn verdict_of_solids(&self, a: &Solid, b: &Solid) -> Verdict {
        let until = self.until_decided();
        let bound = |overlapping: bool| Verdict { overlapping, tier: Tier::Bound };
        match portal::search(a, b, until.beyond, &self.precision) {
            Found::Beyond(..) => bound(false),
            Found::Overlap => bound(true),
            Found::Nothing(direction) => {
                let verdict = self.conclude(distance(a, b, direction, &until)).0;
                // What is evaluated first counts as the first tier.
                if verdict.tier == Tier::Exact { verdict } else { bound(verdict.overlapping) }
            }
        }
    }

    /// [`Convex::guess`] for solids.
    pub(super) fn guess_of_solids(&self, a: &Solid, b: &Solid) -> bool {
        let until = Until { beyond: self.radii, within: self.radii, precision: &self.precision };
        match portal::search(a, b, self.radii, &self.precision) {
            Found::Beyond(..) => false,
            Found::Overlap => true,
            Found::Nothing(direction) => match distance(a, b, direction, &until) {
                Reached::Between(witness) => witness.distance <= self.radii,
                Reached::Origin(_) => true,
            },
        }
    }

    /// When the distance iteration may stop for an overlap test: once it shows whether the radii close the gap.
    fn until_decided(&self) -> Until<'_> {
        let doubt = self.precision.projection();
        Until { beyond: self.radii + doubt, within: self.radii - 2.0 * doubt, precision: &self.precision }
    }

    /// From A's centre to B's.
    fn between_centers(&self) -> DVec3 {
        let center_b = self.offset + self.relative.turn(self.shape_b.center().as_dvec3());
        center_b - self.shape_a.center().as_dvec3()
    }

    /// The unit direction from A's centre to B's: where a search may begin.
    fn towards_b(&self) -> DVec3 {
        self.between_centers().try_normalize().unwrap_or(DVec3::X)
    }

    /// [`Convex::towards_b`] where the cores' bounding spheres are apart.
    pub(super) fn direction_apart(&self) -> Option<DVec3> {
        let between = self.between_centers();
        let apart = between.length();
        (apart > self.precision.size + self.precision.projection()).then(|| between / apart)
    }

    /// The decision by the second tier and the third, and how the cores lie. `best` is the axis that the first tier
    /// found best.
    fn look_closer(&self, a: &Solid, b: &Solid, best: Option<&Axis>) -> (Verdict, Cores) {
        let towards = best.map_or_else(|| self.towards_b(), |axis| axis.normal);
        self.closer(distance(a, b, towards, &Until::met(&self.precision)), best)
    }

    /// Whether two cuboids overlap, where their axes do not decide it.
    pub(super) fn unclear_verdict(&self, a: &Solid, b: &Solid) -> Verdict {
        self.look_closer(a, b, None).0
    }

    /// The decision from what the distance iteration has reached and the best axis: of their two lower bounds, the
    /// better one is kept.
    fn closer(&self, mut reached: Reached, best: Option<&Axis>) -> (Verdict, Cores) {
        let mut tier = Tier::Double;
        if let (Reached::Between(witness), Some(best)) = (&mut reached, best)
            && best.separation >= witness.at_least
        {
            if witness.is_close(self.precision.size) {
                witness.across = best.normal;
            }
            (witness.at_least, witness.normal) = (best.separation, best.normal);
            tier = Tier::Bound;
        }
        let (verdict, witness) = self.conclude(reached);
        let tier = if verdict.tier == Tier::Double && !verdict.overlapping { tier } else { verdict.tier };
        (Verdict { tier, ..verdict }, witness)
    }

    /// The decision that the distance iteration has proved, or the third tier's where it has proved nothing.
    fn conclude(&self, reached: Reached) -> (Verdict, Cores) {
        match reached {
            Reached::Origin(Close { is_proved: true, .. }) => (DOUBLE_OVERLAP, Cores::Within(0.0)),
            Reached::Origin(close) => {
                let verdict = self.exactly(&close.corners);
                let do_overlap = self.radii == 0.0 && verdict.overlapping;
                (verdict, Cores::Within(if do_overlap { 0.0 } else { close.within }))
            }
            Reached::Between(witness) => match self.conclude_gap(&witness) {
                (verdict, true) => (verdict, Cores::Between(witness)),
                (verdict, false) => (verdict, Cores::Within(0.0)),
            },
        }
    }

    /// [`Convex::conclude`] for bounds on a distance; also whether there is a gap between the cores, as far as is
    /// known. By reference: witnesses are large, and most are passed on.
    fn conclude_gap(&self, witness: &Witness) -> (Verdict, bool) {
        let doubt = self.precision.projection();
        if witness.at_least - self.radii > doubt {
            return (Verdict { overlapping: false, tier: Tier::Double }, true);
        }
        if self.radii > 0.0 && witness.distance - self.radii < -2.0 * doubt {
            return (DOUBLE_OVERLAP, true);
        }
        let verdict = self.exactly(&witness.corners);
        (verdict, !(self.radii == 0.0 && verdict.overlapping))
    }

    /// The third tier, from the corners where f64 stopped.
    pub(super) fn exactly(&self, start: &[Corner]) -> Verdict {
        let overlapping = exact::overlaps3([&self.sites[0], &self.sites[1]], start);
        Verdict { overlapping, tier: Tier::Exact }
    }

    /// The answer for cores that an axis separates by so little that no pair of points shows it: their contact is made
    /// as if they overlapped.
    fn all_but_touching(&self, a: &Solid, b: &Solid, axes: Axes, (verdict, gap): (Verdict, f64)) -> Probe {
        let precision = self.precision;
        let best = axes.best();
        let separation = best.separation.max(0.0) - self.radii;
        let preference = self.preference();
        // The very deepest corner is wanted here, not one that is nearly as deep.
        let even = preference;
        let near = self.same_place();
        let input =
            TouchInput { axes: &axes, witness: None, margin: 0.0, preference, even, near, last: None };
        let touch = touch(a, b, &input);
        let deepest = touch.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: precision.of_separation(separation, self.short(&axes, gap) + 3.0 * precision.projection()),
            normal: best.normal,
            closest: deepest.map(|point| [point.on_a, point.on_b]),
            hint: hint_of(best),
            evidence: Evidence::Axes(axes, None),
        })
    }

    /// The best axes of all that may be as good as `known`, a separation that is certain, for solids that are not
    /// cuboids.
    pub(crate) fn all_axes(&self, a: &Solid, b: &Solid, known: f64) -> Axes {
        separating_axes(a, b, &self.search(known))
    }

    /// [`Convex::all_axes`] of faces alone: across a gap no contact is built on the axes of edges.
    fn face_axes(&self, a: &Solid, b: &Solid, known: f64) -> Axes {
        face_axes(a, b, &self.search(known))
    }

    fn search(&self, known: f64) -> Search<'_> {
        let slack = self.preference() + 4.0 * self.precision.planarity;
        Search { known, unproved: f64::NEG_INFINITY, slack, precision: &self.precision }
    }
}
