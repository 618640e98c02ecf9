//! Two convex shapes: which kernel handles them, and what its answer means with their radii.
//!
//! ```text
//! separation of two rounded shapes = separation of their cores - both radii, along the same axis
//! half-plane and any other:         its line's normal is the only axis         (half_plane)
//! two points:                       the line through them
//! everything else:                  edge normals                               (sat)
//!                                   in a gap, the closest points as well       (distance)
//! ```
//! Whether they overlap is decided in three tiers (`tiers`). The number then takes that decision's sign: where it
//! disagrees, that is rounding.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! line out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

use super::half_plane::Line;
use super::manifold::{Point, Touch, over_edge};
use super::measure::{Measure, Near, Probe, Query};
use super::outline::{Outline, Turn};
use super::sat::{Outcome, doubt, separating_axes};
use super::search::beside;
use super::tiers::Cores;
use crate::exact::{self, Site2};
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{at_least, signed};
use arrayvec::ArrayVec;
use asunder_geometry::glam::DVec2;
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
    pub(super) measure: Measure,
}

/// The answer of a kernel in closed form.
pub(super) struct ClosedForm {
    pub(super) separation: f64,
    /// Unit axis from A to B.
    pub(super) normal: DVec2,
    /// Closest points on the surfaces; meaningless in overlap.
    closest: [DVec2; 2],
}

impl<'a> Convex<'a> {
    /// Two shapes, their rotations, and B's position less A's. For parts, whose offset is a sum of several vectors,
    /// `summed` is the sum of those vectors' lengths, in metres.
    #[inline]
    pub(crate) fn new(sites: [Site2<'a>; 2], turns: [Turn; 2], offset: DVec2, summed: Option<f64>) -> Self {
        let (shapes, [turn_a, turn_b]) = (sites.map(|site| site.shape), turns);
        let [shape_a, shape_b] = shapes;
        Self {
            sites,
            shape_a,
            shape_b,
            turn_a,
            turn_b,
            offset,
            measure: Measure::new(shapes, offset, summed),
        }
    }

    /// The separation where it is at most the limit; the hinted axis is tried first.
    #[inline]
    pub(crate) fn probe(&self, query: &Query) -> Probe {
        if self.has_line() {
            return self.probe_lines(query);
        }
        self.with_outlines(|a, b| {
            if a.edge_count() + b.edge_count() > 0 {
                return self.probe_outlines(a, b, query);
            }
            self.probe_closed_form(&self.closed_form_of_points(a, b), query, |result| {
                let (on_a, on_b) = (a.point(0), b.point(0));
                let separation = result.normal.dot(on_b - on_a);
                let feature = FeatureId::new(Feature::Vertex(0), Feature::Vertex(0));
                let point = Point { separation, on_a, on_b, feature }
                    .on_surfaces([a.radius, b.radius], result.normal);
                Some(Touch::of_point(result.normal, point, None))
            })
        })
    }

    /// For shapes of which at least one is a half-plane.
    fn probe_lines(&self, query: &Query) -> Probe {
        match self.lines() {
            [Some(a), Some(b)] => {
                self.probe_closed_form(&self.closed_form_of_half_planes(a, b), query, |result| {
                    let ([on_a, on_b], separation) = (a.points_with(&b), f64::from(result.separation as f32));
                    let feature = FeatureId::new(Feature::Edge(0), Feature::Edge(0));
                    let point = Point { separation, on_a, on_b, feature };
                    (separation > f64::NEG_INFINITY).then(|| Touch::of_point(result.normal, point, None))
                })
            }
            [Some(line), _] | [_, Some(line)] => self.with_outlines(|a, b| {
                let core = if line.is_b { a } else { b };
                let result = self.closed_form_of_half_plane(line, core);
                self.probe_closed_form(&result, query, |_| {
                    Some(line.touch(core, query.limit, self.measure.preference))
                })
            }),
            [None, None] => Probe::Beyond(0.0, Hint::NONE),
        }
    }

    pub(super) fn closed_form_of_half_planes(&self, a: Line, b: Line) -> ClosedForm {
        let separation = a.separation_from(&b, || exact::are_opposed2([&self.sites[0], &self.sites[1]]));
        ClosedForm { separation, normal: a.axis(), closest: a.points_with(&b) }
    }

    pub(super) fn closed_form_of_half_plane(&self, line: Line, core: &Outline) -> ClosedForm {
        let (vertex, height) = line.lowest(core);
        let vertex = core.point(vertex);
        let on_shape = vertex - line.normal * self.measure.radii;
        let on_line = vertex - line.normal * height;
        let closest = if line.is_b { [on_shape, on_line] } else { [on_line, on_shape] };
        ClosedForm { separation: height - self.measure.radii, normal: line.axis(), closest }
    }

    pub(super) fn closed_form_of_points(&self, a: &Outline, b: &Outline) -> ClosedForm {
        let (on_a, on_b) = (a.point(0), b.point(0));
        let distance = (on_b - on_a).length();
        let normal = if distance > 0.0 { (on_b - on_a) / distance } else { DVec2::Y };
        let separation = distance - self.measure.radii;
        let closest = self.measure.on_surfaces([on_a, on_b], normal);
        ClosedForm { separation, normal, closest }
    }

    /// The answer that follows from a closed form, within the limit.
    fn probe_closed_form(
        &self,
        result: &ClosedForm,
        query: &Query,
        touch: impl FnOnce(&ClosedForm) -> Option<Touch>,
    ) -> Probe {
        let precision = self.measure.precision;
        let separation = result.separation;
        if separation > query.limit + precision.projection() {
            return Probe::Beyond(at_least(separation, &precision), Hint::NONE);
        }
        let verdict = self.closed_form_verdict(result);
        // Half-planes that overlap without end do so exactly.
        let is_endless = separation == f64::NEG_INFINITY;
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: if is_endless { 0.0 } else { precision.of_distance(separation, 0.0) },
            normal: result.normal,
            closest: (!verdict.overlapping).then_some(result.closest),
            hint: Hint::NONE,
            touch: if query.points { touch(result) } else { None },
        })
    }

    /// Axes first; the decision next; then the number that agrees with it.
    fn probe_outlines(&self, a: &Outline, b: &Outline, query: &Query) -> Probe {
        let measure = &self.measure;
        let wanted = measure.wanted(query, self.towards_b());
        let outcome = separating_axes(a, b, &wanted);
        if let Some(probe) = measure.at_once([a, b], query, &outcome) {
            return probe;
        }
        match outcome {
            Outcome::Beyond(separation, hint) => {
                Probe::Beyond(at_least(separation - measure.radii, &measure.precision), hint)
            }
            Outcome::Gap(separation, normal) => self.gap([a, b], query, (separation, normal), wanted.band),
            Outcome::Within(axes) => {
                let best = axes.best();
                let looked = self.look_closer(a, b, Some((best.separation, best.normal)));
                measure.close_cores([a, b], query, &axes, &looked)
            }
        }
    }

    /// Shapes with a gap between their cores that one direction proves: finds the nearest points first, and then the
    /// axes that matter beside theirs.
    fn gap(&self, [a, b]: [&Outline; 2], query: &Query, shown: (f64, DVec2), band: f64) -> Probe {
        let looked = self.look_closer(a, b, Some(shown));
        let (normal, least) = match &looked.1 {
            Cores::Between(witness) => (witness.normal, witness.distance),
            Cores::Within(_) => (shown.1, shown.0),
        };
        let mut axes = beside(a, b, normal, least - band);
        axes.short = doubt(&self.measure.precision);
        self.measure.close_cores([a, b], query, &axes, &looked)
    }

    /// Contact points over an edge of A, or of B, along its outward normal: see [`over_edge`].
    pub(crate) fn over_edge(
        &self,
        of_b: bool,
        edge: (usize, DVec2),
        within: f64,
        open: [bool; 2],
    ) -> ArrayVec<Point, 2> {
        let sizes = self.measure.sizes();
        let edge = (edge.0, edge.1, open);
        self.with_outlines(|a, b| over_edge(if of_b { [b, a] } else { [a, b] }, edge, within, sizes, of_b))
    }

    /// By how much one contact point must be deeper than another to be preferred, in metres.
    pub(crate) fn preference(&self) -> f64 {
        self.measure.preference
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
    pub(super) fn with_outlines<R>(&self, run: impl FnOnce(&Outline, &Outline) -> R) -> R {
        let (core_a, core_b): (Core2, Core2) = (self.shape_a.core(), self.shape_b.core());
        let a = Outline::new(self.shape_a, &core_a, self.turn_a, DVec2::ZERO);
        let b = Outline::new(self.shape_b, &core_b, self.turn_b, self.offset);
        run(&a, &b)
    }
}
