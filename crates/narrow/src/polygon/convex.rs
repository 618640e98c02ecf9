//! Two convex shapes: which kernel they go to, and what its answer means with their radii.
//!
//! ```text
//! separation of two rounded shapes = separation of their cores - both radii, along the same axis
//! half-plane and anything:          its line's normal is the only axis         (half_plane)
//! two points:                       the line through them
//! everything else:                  edge normals                               (sat)
//!                                   in a gap, the closest points as well       (distance)
//! ```
//! Whether they overlap is settled in three tiers (`tiers`); the number then takes the decision's sign: where it says
//! otherwise, it is rounding.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! line out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

use super::distance::Witness;
use super::half_plane::Line;
use super::manifold::{Point, Touch, touch};
use super::outline::{OF_SEARCH, Outline, Turn, is_searched};
use super::sat::{Axes, Outcome, Wanted, doubt, hint_of, hint_of_direction, separating_axes};
use super::search::beside;
use super::tiers::{Cores, is_thin};
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Site2};
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{IN_PLANE, Precision, at_least, signed};
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Core2, Shape2};

/// Two convex shapes in the frame of the pair: the world's axes, about A's position.
pub(crate) struct Convex<'a> {
    pub(super) sites: [Site2<'a>; 2],
    pub(crate) shape_a: &'a Shape2,
    pub(crate) shape_b: &'a Shape2,
    pub(crate) turn_a: Turn,
    pub(crate) turn_b: Turn,
    /// B's position less A's.
    pub(crate) offset: DVec2,
    pub(super) precision: Precision,
    /// Both radii, in metres.
    pub(super) radii: f64,
}

/// What a pair looks like within a limit.
#[allow(
    clippy::large_enum_variant,
    reason = "it lives on the stack for one pair, and a frame allocates nothing"
)]
pub(crate) enum Probe {
    /// Further apart than the limit: by at least so much.
    Beyond(f32, Hint),
    /// The separation, and all that is needed to make contact points.
    Near(Near),
}

/// What is asked of two shapes.
#[derive(Clone, Copy)]
pub(crate) struct Asked {
    /// Metres beyond which nobody wants to know.
    pub(crate) limit: f64,
    /// The axis to try first.
    pub(crate) hint: Hint,
    /// Whether contact points are wanted, those up to the limit.
    pub(crate) points: bool,
}

/// The separation of two shapes, and where they touch.
pub(crate) struct Near {
    pub(crate) verdict: Verdict,
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B.
    pub(crate) normal: DVec2,
    /// Closest points of the shapes, where they do not overlap.
    pub(crate) closest: Option<[DVec2; 2]>,
    /// What leads the next frame back to this axis.
    pub(crate) hint: Hint,
    /// Contact points, where they were wanted. None for two half-planes that overlap without end.
    pub(crate) touch: Option<Touch>,
}

/// What a kernel in closed form says of two shapes.
pub(super) struct Told {
    pub(super) separation: f64,
    /// Unit axis from A to B.
    pub(super) normal: DVec2,
    /// Closest points on the surfaces; they mean nothing in overlap.
    closest: [DVec2; 2],
}

impl<'a> Convex<'a> {
    /// Two shapes, how they are turned, and B's position less A's. `summed` is how long the vectors were that the
    /// position is a sum of, in metres, where it is one of several.
    pub(crate) fn new(sites: [Site2<'a>; 2], turns: [Turn; 2], offset: DVec2, summed: f64) -> Self {
        let ([shape_a, shape_b], [turn_a, turn_b]) = (sites.map(|site| site.shape), turns);
        let radii = f64::from(shape_a.radius()) + f64::from(shape_b.radius());
        // What the distance iteration's steps are relative to: radii do not enter it.
        let size = core_size(shape_a) + core_size(shape_b);
        // Sums of coordinates bound lengths, and need no root.
        let length = |v: DVec2| v.abs().element_sum();
        let off_center = length(shape_a.center().as_dvec2()) + length(shape_b.center().as_dvec2());
        let reach = size + radii + off_center + length(offset) + summed;
        let searched = if is_searched(shape_a) || is_searched(shape_b) { OF_SEARCH } else { 0.0 };
        let roundings = IN_PLANE[usize::from(sites.iter().any(|site| site.part.is_some()))] + searched;
        let precision = Precision { size, reach, planarity: 0.0, roundings };
        Self { sites, shape_a, shape_b, turn_a, turn_b, offset, precision, radii }
    }

    /// The separation where it is at most the limit; the hinted axis is tried first.
    #[inline]
    pub(crate) fn probe(&self, asked: &Asked) -> Probe {
        if self.has_line() {
            return self.probe_lines(asked);
        }
        self.with_outlines(|a, b| {
            if a.edge_count() + b.edge_count() > 0 {
                return self.probe_outlines(a, b, asked);
            }
            self.told(&self.told_points(a, b), asked, |told| {
                let (on_a, on_b) = (a.point(0), b.point(0));
                let separation = told.normal.dot(on_b - on_a);
                let feature = FeatureId::new(Feature::Vertex(0), Feature::Vertex(0));
                let point = Point { separation, on_a, on_b, feature }.on_surfaces(a, b, told.normal);
                Some(Touch::of_point(told.normal, point, None))
            })
        })
    }

    /// Of shapes of which at least one is a half-plane.
    fn probe_lines(&self, asked: &Asked) -> Probe {
        match self.lines() {
            [Some(a), Some(b)] => self.told(&self.told_half_planes(a, b), asked, |told| {
                let ([on_a, on_b], separation) = (a.points_with(&b), f64::from(told.separation as f32));
                let feature = FeatureId::new(Feature::Edge(0), Feature::Edge(0));
                let point = Point { separation, on_a, on_b, feature };
                (separation > f64::NEG_INFINITY).then(|| Touch::of_point(told.normal, point, None))
            }),
            [Some(line), _] | [_, Some(line)] => self.with_outlines(|a, b| {
                let core = if line.is_b { a } else { b };
                let told = self.told_half_plane(line, core);
                self.told(&told, asked, |_| Some(line.touch(core, asked.limit, self.preference())))
            }),
            [None, None] => Probe::Beyond(0.0, Hint::NONE),
        }
    }

    pub(super) fn told_half_planes(&self, a: Line, b: Line) -> Told {
        let separation = a.separation_from(&b, || exact::are_opposed2([&self.sites[0], &self.sites[1]]));
        Told { separation, normal: a.axis(), closest: a.points_with(&b) }
    }

    pub(super) fn told_half_plane(&self, line: Line, core: &Outline) -> Told {
        let (vertex, height) = line.lowest(core);
        let vertex = core.point(vertex);
        let on_shape = vertex - line.normal * self.radii;
        let on_line = vertex - line.normal * height;
        let closest = if line.is_b { [on_shape, on_line] } else { [on_line, on_shape] };
        Told { separation: height - self.radii, normal: line.axis(), closest }
    }

    pub(super) fn told_points(&self, a: &Outline, b: &Outline) -> Told {
        let (on_a, on_b) = (a.point(0), b.point(0));
        let distance = (on_b - on_a).length();
        let normal = if distance > 0.0 { (on_b - on_a) / distance } else { DVec2::Y };
        let separation = distance - self.radii;
        let closest = self.on_surfaces([on_a, on_b], normal);
        Told { separation, normal, closest }
    }

    /// What a kernel without axes to try has told, within the limit.
    fn told(&self, told: &Told, asked: &Asked, touch: impl FnOnce(&Told) -> Option<Touch>) -> Probe {
        let precision = self.precision;
        let separation = told.separation;
        if separation > asked.limit + precision.projection() {
            return Probe::Beyond(at_least(separation, &precision), Hint::NONE);
        }
        let verdict = self.told_verdict(told);
        // Half-planes that overlap without end do so exactly.
        let is_endless = separation == f64::NEG_INFINITY;
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: if is_endless { 0.0 } else { precision.of_distance(separation, 0.0) },
            normal: told.normal,
            closest: (!verdict.overlapping).then_some(told.closest),
            hint: Hint::NONE,
            touch: if asked.points { touch(told) } else { None },
        })
    }

    /// Axes first; the decision next; then the number that agrees with it.
    fn probe_outlines(&self, a: &Outline, b: &Outline, asked: &Asked) -> Probe {
        let precision = self.precision;
        let wanted = Wanted {
            limit: asked.limit + self.radii + precision.projection(),
            band: 2.0 * self.preference(),
            hint: asked.hint,
            towards_b: self.towards_b(),
            precision: &precision,
        };
        let axes = match separating_axes(a, b, &wanted) {
            Outcome::Beyond(separation, hint) => {
                return Probe::Beyond(at_least(separation - self.radii, &precision), hint);
            }
            Outcome::Gap(separation, normal) => {
                return self.gap([a, b], asked, (separation, normal), wanted.band);
            }
            Outcome::Within(axes) => axes,
        };
        let best = axes.best();
        // Every edge normal was tried, or is known to be no better.
        let is_clear = best.separation < -(axes.short + 2.0 * precision.projection());
        if is_clear && !is_thin(a, b) {
            let verdict = Verdict { overlapping: true, tier: Tier::Bound };
            return self.overlap_of_cores([a, b], asked, &axes, (verdict, 0.0));
        }
        let looked = self.look_closer(a, b, Some((best.separation, best.normal)));
        self.close_cores([a, b], asked, &axes, &looked)
    }

    /// Shapes whose cores are neither clearly apart nor clearly overlapping by their axes alone.
    fn close_cores(
        &self,
        outlines: [&Outline; 2],
        asked: &Asked,
        axes: &Axes,
        (verdict, cores): &(Verdict, Cores),
    ) -> Probe {
        let verdict = *verdict;
        match cores {
            // A search that proved no gap, where all axes show an overlap.
            Cores::Between(witness) if verdict.overlapping && axes.best().separation + axes.short < 0.0 => {
                self.overlap_of_cores(outlines, asked, axes, (verdict, witness.distance))
            }
            Cores::Between(witness) => self.gap_of_cores(outlines, asked, axes, (verdict, witness)),
            Cores::Within(gap) if verdict.overlapping => {
                self.overlap_of_cores(outlines, asked, axes, (verdict, *gap))
            }
            Cores::Within(gap) => self.all_but_touching(outlines, asked, axes, (verdict, *gap)),
        }
    }

    /// Shapes with a gap between their cores that one direction shows for certain: the nearest points first, and then the
    /// axes that matter beside them.
    fn gap(&self, [a, b]: [&Outline; 2], asked: &Asked, shown: (f64, DVec2), band: f64) -> Probe {
        let looked = self.look_closer(a, b, Some(shown));
        let (normal, least) = match &looked.1 {
            Cores::Between(witness) => (witness.normal, witness.distance),
            Cores::Within(_) => (shown.1, shown.0),
        };
        let mut axes = beside(a, b, normal, least - band);
        axes.short = doubt(&self.precision);
        self.close_cores([a, b], asked, &axes, &looked)
    }

    /// Shapes whose cores overlap, or have so small a gap that no axis tells, as deep as the best axis says. `gap` is the
    /// most that the gap can be.
    fn overlap_of_cores(
        &self,
        [a, b]: [&Outline; 2],
        asked: &Asked,
        axes: &Axes,
        (verdict, gap): (Verdict, f64),
    ) -> Probe {
        let best = axes.best();
        let depth = best.separation - self.radii;
        let touch = asked.points.then(|| touch(a, b, axes, None, asked.limit, self.preference()));
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

    /// What leads back to the edge that contact points were made on; else to the best axis.
    fn hint(touch: Option<&Touch>, best: Hint) -> Hint {
        touch.and_then(|touch| touch.reference).map_or(best, hint_of)
    }

    /// By how much the truth may exceed the best axis, of cores that are apart by at most `gap`.
    ///
    /// In overlap the axes are all there are. In a gap the best one may be none of them, and only witness points tell.
    fn short(axes: &Axes, gap: f64) -> f64 {
        let (best, short) = (axes.best().separation, axes.short);
        if best + short < 0.0 { short } else { short.max(gap - best) }
    }

    /// Shapes with a gap between their cores, which their radii may close.
    fn gap_of_cores(
        &self,
        [a, b]: [&Outline; 2],
        asked: &Asked,
        axes: &Axes,
        (verdict, witness): (Verdict, &Witness),
    ) -> Probe {
        let precision = self.precision;
        // Where both bounds meet up to rounding, the projection went through less of it.
        let gap = witness.distance - witness.at_least;
        let is_met = self.radii > 0.0 && gap <= precision.projection();
        let separation = if is_met { witness.at_least } else { witness.distance } - self.radii;
        let closest = self.on_surfaces([witness.point_a, witness.point_b], witness.across);
        let best = axes.best();
        let has_axis = best.separation > f64::NEG_INFINITY;
        let hint = if has_axis { hint_of(best.of) } else { hint_of_direction(witness.normal) };
        let touch = asked.points.then(|| touch(a, b, axes, Some(witness), asked.limit, self.preference()));
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

    /// Cores that an axis parts by so little that no two points of them do: their contact is made as if they
    /// overlapped.
    fn all_but_touching(
        &self,
        [a, b]: [&Outline; 2],
        asked: &Asked,
        axes: &Axes,
        (verdict, gap): (Verdict, f64),
    ) -> Probe {
        let precision = self.precision;
        let best = axes.best();
        let separation = best.separation.max(0.0) - self.radii;
        let nearest = touch(a, b, axes, None, 0.0, self.preference());
        let deepest = nearest.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
        let short = Self::short(axes, gap) + 3.0 * precision.projection();
        let touch = asked.points.then(|| touch(a, b, axes, None, asked.limit, self.preference()));
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
    fn on_surfaces(&self, [on_a, on_b]: [DVec2; 2], normal: DVec2) -> [DVec2; 2] {
        [on_a + normal * f64::from(self.shape_a.radius()), on_b - normal * f64::from(self.shape_b.radius())]
    }

    /// Whether a shape is a half-plane.
    #[inline]
    pub(super) fn has_line(&self) -> bool {
        [self.shape_a, self.shape_b].iter().any(|shape| matches!(shape, Shape2::HalfPlane(_)))
    }

    /// The lines of half-planes.
    pub(super) fn lines(&self) -> [Option<Line>; 2] {
        let line = |shape: &Shape2, is_b: bool| {
            let Shape2::HalfPlane(half_plane) = shape else { return None };
            let (turn, origin) = if is_b { (self.turn_b, self.offset) } else { (self.turn_a, DVec2::ZERO) };
            Some(Line { normal: turn.turn(half_plane.unit_normal()).normalize(), origin, is_b })
        };
        [line(self.shape_a, false), line(self.shape_b, true)]
    }

    #[inline]
    pub(super) fn with_outlines<R>(&self, ask: impl FnOnce(&Outline, &Outline) -> R) -> R {
        let (core_a, core_b): (Core2, Core2) = (self.shape_a.core(), self.shape_b.core());
        let a = Outline::new(self.shape_a, &core_a, self.turn_a, DVec2::ZERO);
        let b = Outline::new(self.shape_b, &core_b, self.turn_b, self.offset);
        ask(&a, &b)
    }

    /// How much another axis must beat a face of A by, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be all of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        (FACE_PREFERENCE * 2.0 * smaller).max(self.precision.projection())
    }
}

/// Bounding radius of a core. A half-plane has none: only the other shape's vertices enter its pairs.
fn core_size(shape: &Shape2) -> f64 {
    match shape {
        Shape2::HalfPlane(_) => 0.0,
        _ => f64::from(shape.outer_radius()) - f64::from(shape.radius()),
    }
}
