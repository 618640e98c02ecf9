//! From axes and nearest points to an answer: the number, its error, its sign, and the contact points.

use super::distance::Witness;
use super::manifold::{Touch, nearest_on_edge, touch};
use super::outline::{OF_SEARCH, is_searched};
use super::placed::Placed;
use super::sat::{Axes, Outcome, Wanted, doubt, hint_of, hint_of_direction};
use super::tiers::Cores;
use crate::answer::{Tier, Verdict};
use crate::feature::Hint;
use crate::precision::{IN_PLANE, Precision, at_least, signed};
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::{DISTANCE_GAP, FACE_PREFERENCE, SAME_PLACE};
use asunder_geometry::{Rect, Shape2};

/// A query about two shapes.
#[derive(Clone, Copy)]
pub(crate) struct Query {
    /// Separations above this are not wanted, in metres.
    pub(crate) limit: f64,
    /// The axis to try first.
    pub(crate) hint: Hint,
    /// Whether contact points up to the limit are wanted.
    pub(crate) points: bool,
}

pub(crate) type Probe = crate::answer::Probe<Near>;

/// The separation of two shapes, and where they touch.
pub(crate) struct Near {
    pub(crate) verdict: Verdict,
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B.
    pub(crate) normal: DVec2,
    /// Closest points of the shapes, unless they overlap.
    pub(crate) closest: Option<[DVec2; 2]>,
    /// Leads the next frame back to this axis.
    pub(crate) hint: Hint,
    /// Contact points, if they were wanted. `None` for two half-planes that overlap without end.
    pub(crate) touch: Option<Touch>,
}

/// The lengths that answers about a pair are relative to, in metres.
#[derive(Clone, Copy)]
pub(crate) struct Measure {
    pub(super) precision: Precision,
    /// Sum of both radii, and A's.
    pub(super) radii: f64,
    radius_a: f64,
    /// By how much another axis must beat a face of A. Relative to the smaller shape: what is nothing to a floor may be
    /// all of a pebble. Never below rounding.
    pub(super) preference: f64,
    /// How near a contact point must be to a vertex to be named after it, in metres.
    near: f64,
}

impl Measure {
    /// By how much an axis must beat another, and how near to a vertex a point is named after it, in metres.
    #[inline]
    pub(super) fn sizes(&self) -> [f64; 2] {
        [self.preference, self.near]
    }

    /// For two shapes, and B's position less A's. For parts, whose offset is a sum of several vectors, `summed` is the
    /// sum of those vectors' lengths, in metres.
    #[inline]
    pub(crate) fn new([a, b]: [&Shape2; 2], offset: DVec2, summed: Option<f64>) -> Self {
        let radii = [f64::from(a.radius()), f64::from(b.radius())];
        // Sums of coordinates bound lengths, and need no root.
        let length = |v: DVec2| v.abs().element_sum();
        let off_center = length(a.center().as_dvec2()) + length(b.center().as_dvec2());
        let further = off_center + length(offset) + summed.unwrap_or(0.0);
        let searched = if is_searched(a) || is_searched(b) { OF_SEARCH } else { 0.0 };
        let roundings = IN_PLANE.of_either(summed.is_some()) + searched;
        Self::of_radii([a.outer_radius(), b.outer_radius()], radii, further, roundings)
    }

    /// The same for two bodies that are rectangles.
    #[inline]
    pub(super) fn of_rects([a, b]: [&Rect; 2], offset: DVec2) -> Self {
        let radii = [f64::from(a.radius()), f64::from(b.radius())];
        let further = offset.abs().element_sum();
        Self::of_radii([a.outer_radius(), b.outer_radius()], radii, further, IN_PLANE.of_bodies)
    }

    /// From the bounding radii, the radii of rounding, the sum of what else enters a coordinate, and the rounding error
    /// of a projection.
    #[inline]
    fn of_radii(
        [outer_a, outer_b]: [f32; 2],
        [radius_a, radius_b]: [f64; 2],
        further: f64,
        roundings: f64,
    ) -> Self {
        let radii = radius_a + radius_b;
        // The distance iteration's steps are relative to the size of the cores: radii do not enter it. A half-plane has
        // no size: only the other shape's vertices enter its pairs.
        let core =
            |outer: f32, radius: f64| if outer < f32::INFINITY { f64::from(outer) - radius } else { 0.0 };
        let size = core(outer_a, radius_a) + core(outer_b, radius_b);
        let reach = size + radii + further;
        let precision = Precision { size, reach, planarity: 0.0, roundings };
        let smaller = f64::from(if outer_b < outer_a { outer_b } else { outer_a });
        let (preference, rounding) = (FACE_PREFERENCE * 2.0 * smaller, precision.projection());
        Self {
            precision,
            radii,
            radius_a,
            preference: if preference > rounding { preference } else { rounding },
            near: SAME_PLACE * 2.0 * smaller,
        }
    }

    /// What is wanted of the best axis. `towards_b` is from A's centre to B's.
    #[inline]
    pub(super) fn wanted(&self, query: &Query, towards_b: DVec2) -> Wanted<'_> {
        Wanted {
            limit: query.limit + self.radii + self.precision.projection(),
            band: 2.0 * self.preference,
            hint: query.hint,
            towards_b,
            precision: &self.precision,
        }
    }

    /// The answer for cores that an axis separates by more than the limit.
    #[inline]
    pub(super) fn beyond(&self, separation: f64, hint: Hint) -> Probe {
        Probe::Beyond(at_least(separation - self.radii, &self.precision), hint)
    }

    /// The answer, if it is certain by the axes, or by the nearest points where those lie on the best axis' edge.
    #[inline]
    pub(super) fn at_once(
        &self,
        placed: [&impl Placed; 2],
        query: &Query,
        outcome: &Outcome,
    ) -> Option<Probe> {
        match outcome {
            Outcome::Beyond(separation, hint) => Some(self.beyond(*separation, *hint)),
            Outcome::Gap(..) => None,
            Outcome::Within(axes) => self.within(placed, query, axes),
        }
    }

    /// The same for shapes that no axis separates by more than the limit.
    #[inline]
    pub(super) fn within(&self, placed: [&impl Placed; 2], query: &Query, axes: &Axes) -> Option<Probe> {
        let (best, rounding) = (axes.best(), self.precision.projection());
        // Every edge normal was tried, or is known to be no better. Shapes without an interior may lie on one line, and
        // have no candidate axis along it.
        if best.separation < -(axes.short + 2.0 * rounding) {
            let is_thin = placed[0].is_flat() && placed[1].is_flat();
            let verdict = Verdict { overlapping: true, tier: Tier::Bound };
            return (!is_thin).then(|| self.overlap_of_cores(placed, query, axes, (verdict, 0.0)));
        }
        if best.separation <= doubt(&self.precision) {
            return None;
        }
        let witness = nearest_on_edge(placed, best, DISTANCE_GAP * self.precision.size)?;
        let overlapping = witness.distance - self.radii < -2.0 * rounding;
        if !overlapping && witness.at_least - self.radii <= rounding {
            return None;
        }
        let verdict = Verdict { overlapping, tier: Tier::Bound };
        Some(self.gap_of_cores(placed, query, axes, (verdict, &witness)))
    }

    /// The answer for shapes whose axes alone show neither a clear gap nor a clear overlap of the cores.
    pub(super) fn close_cores(
        &self,
        placed: [&impl Placed; 2],
        query: &Query,
        axes: &Axes,
        (verdict, cores): &(Verdict, Cores),
    ) -> Probe {
        let verdict = *verdict;
        match cores {
            // A search that proved no gap, while all axes show an overlap.
            Cores::Between(witness) if verdict.overlapping && axes.best().separation + axes.short < 0.0 => {
                self.overlap_of_cores(placed, query, axes, (verdict, witness.distance))
            }
            Cores::Between(witness) => self.gap_of_cores(placed, query, axes, (verdict, witness)),
            Cores::Within(gap) if verdict.overlapping => {
                self.overlap_of_cores(placed, query, axes, (verdict, *gap))
            }
            Cores::Within(gap) => self.all_but_touching(placed, query, axes, (verdict, *gap)),
        }
    }

    /// The answer for shapes whose cores overlap, or have a gap too small for any axis to show: the depth is the best
    /// axis'. `gap` is an upper bound on that gap.
    #[inline]
    fn overlap_of_cores(
        &self,
        placed: [&impl Placed; 2],
        query: &Query,
        axes: &Axes,
        (verdict, gap): (Verdict, f64),
    ) -> Probe {
        let best = axes.best();
        let depth = best.separation - self.radii;
        let touch = query.points.then(|| touch(placed, axes, None, query.limit, self.sizes()));
        Probe::Near(Near {
            verdict,
            separation: signed(depth, true),
            error: self.precision.of_separation(depth, Self::short(axes, gap)),
            normal: best.normal,
            closest: None,
            hint: Self::hint(touch.as_ref(), hint_of(best.of)),
            touch,
        })
    }

    /// The hint for the edge that contact points were built on; else for the best axis.
    fn hint(touch: Option<&Touch>, best: Hint) -> Hint {
        touch.and_then(|touch| touch.reference).map_or(best, hint_of)
    }

    /// By how much the truth may exceed the best axis, for cores that are at most `gap` apart.
    ///
    /// In overlap the axes are all the candidates. In a gap the true axis may be none of them: only witness points can
    /// show it.
    fn short(axes: &Axes, gap: f64) -> f64 {
        let (best, short) = (axes.best().separation, axes.short);
        if best + short < 0.0 { short } else { short.max(gap - best) }
    }

    /// The answer for shapes with a gap between their cores, which their radii may close.
    fn gap_of_cores(
        &self,
        placed: [&impl Placed; 2],
        query: &Query,
        axes: &Axes,
        (verdict, witness): (Verdict, &Witness),
    ) -> Probe {
        let precision = self.precision;
        let (separation, gap) = precision.of_gap(witness.distance, witness.at_least, self.radii);
        let closest = self.on_surfaces([witness.point_a, witness.point_b], witness.across);
        let best = axes.best();
        let has_axis = best.separation > f64::NEG_INFINITY;
        let hint = if has_axis { hint_of(best.of) } else { hint_of_direction(witness.normal) };
        let touch = query.points.then(|| touch(placed, axes, Some(witness), query.limit, self.sizes()));
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: precision.of_distance(separation, gap),
            normal: witness.normal,
            closest: (!verdict.overlapping).then_some(closest),
            hint: Self::hint(touch.as_ref(), hint),
            touch,
        })
    }

    /// The answer for cores that an axis separates by so little that no two points of them show it: the contact is
    /// built as if they overlapped.
    fn all_but_touching(
        &self,
        placed: [&impl Placed; 2],
        query: &Query,
        axes: &Axes,
        (verdict, gap): (Verdict, f64),
    ) -> Probe {
        let precision = self.precision;
        let best = axes.best();
        let separation = best.separation.max(0.0) - self.radii;
        let nearest = touch(placed, axes, None, 0.0, self.sizes());
        let deepest = nearest.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
        let short = Self::short(axes, gap) + 3.0 * precision.projection();
        let touch = query.points.then(|| touch(placed, axes, None, query.limit, self.sizes()));
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: precision.of_separation(separation, short),
            normal: best.normal,
            closest: deepest.map(|point| [point.on_a, point.on_b]),
            hint: Self::hint(touch.as_ref(), hint_of(best.of)),
            touch,
        })
    }

    /// Points of the cores moved out to the shapes' surfaces.
    pub(super) fn on_surfaces(&self, [on_a, on_b]: [DVec2; 2], normal: DVec2) -> [DVec2; 2] {
        [on_a + normal * self.radius_a, on_b - normal * (self.radii - self.radius_a)]
    }
}
