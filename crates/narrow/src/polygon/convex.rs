//! Two convex shapes: which kernel they go to, and what its answer means with their radii.
//!
//! ```text
//! separation of two rounded shapes = separation of their cores - both radii, along the same axis
//! half-plane and anything:          its line's normal is the only axis         (half_plane)
//! two points:                       the line through them
//! everything else:                  edge normals                               (sat)
//!                                   in a gap, the closest points as well       (distance)
//! ```
//! Where a number decides whether shapes overlap, and not a test of axes, within rounding of touching counts as
//! touching: bodies on a grid touch exactly and often, and are hardly ever apart by so little.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! line out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

use super::distance::{Witness, distance};
use super::half_plane::Line;
use super::manifold::{Point, Touch, touch};
use super::outline::{Outline, Turn};
use super::sat::{Axes, Axis, Outcome, hint_of, overlaps, separating_axes};
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{Precision, at_least, signed};
use asunder_geometry::glam::DVec2;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Core2, Shape2};

/// Two convex shapes in the frame of the pair: the world's axes, about A's position.
pub(crate) struct Convex<'a> {
    pub(crate) shape_a: &'a Shape2,
    pub(crate) shape_b: &'a Shape2,
    pub(crate) turn_a: Turn,
    pub(crate) turn_b: Turn,
    /// B's position less A's.
    pub(crate) offset: DVec2,
    precision: Precision,
    /// Both radii, in metres.
    radii: f64,
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

/// The separation of two shapes, and where it was seen.
pub(crate) struct Near {
    pub(crate) overlapping: bool,
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B.
    pub(crate) normal: DVec2,
    /// Closest points of the shapes, where they do not overlap.
    pub(crate) closest: Option<[DVec2; 2]>,
    pub(crate) hint: Hint,
    evidence: Evidence,
}

/// What a kernel in closed form says of two shapes.
struct Told {
    separation: f64,
    /// A lower bound on it.
    at_least: f64,
    /// Unit axis from A to B.
    normal: DVec2,
    /// Closest points on the surfaces; they mean nothing in overlap.
    closest: [DVec2; 2],
    evidence: Evidence,
}

#[allow(clippy::large_enum_variant, reason = "as Probe")]
enum Evidence {
    /// The best axes; closest points of the cores, where those do not overlap.
    Axes(Axes, Option<Witness>),
    /// The line through two points.
    Points,
    HalfPlane(Line),
    HalfPlanes(Line, Line),
}

impl<'a> Convex<'a> {
    /// Two shapes, how they are turned, and B's position less A's. `summed` is how long the vectors were that the
    /// position is a sum of, in metres, where it is one of several.
    pub(crate) fn new(shapes: [&'a Shape2; 2], turns: [Turn; 2], offset: DVec2, summed: f64) -> Self {
        let ([shape_a, shape_b], [turn_a, turn_b]) = (shapes, turns);
        let radii = f64::from(shape_a.radius()) + f64::from(shape_b.radius());
        // What errors are relative to: the cores' sizes, since radii are added exactly.
        let size = core_size(shape_a) + core_size(shape_b);
        // Sums of coordinates bound lengths, and need no root.
        let length = |v: DVec2| v.abs().element_sum();
        let off_center = length(shape_a.center().as_dvec2()) + length(shape_b.center().as_dvec2());
        let reach = size + radii + off_center + length(offset) + summed;
        let precision = Precision { size, reach, planarity: 0.0 };
        Self { shape_a, shape_b, turn_a, turn_b, offset, precision, radii }
    }

    /// The separation where it is at most `limit` metres; the hinted axis is tried first.
    pub(crate) fn probe(&self, limit: f64, hint: Hint) -> Probe {
        match self.lines() {
            [Some(a), Some(b)] => self.probe_half_planes(a, b, limit),
            [Some(line), None] | [None, Some(line)] => self.probe_half_plane(line, limit),
            [None, None] => self.with_outlines(|a, b| {
                if a.edge_count() + b.edge_count() == 0 {
                    self.probe_points(a, b, limit)
                } else {
                    self.probe_outlines(a, b, limit, hint)
                }
            }),
        }
    }

    /// Whether the shapes share a point: as [`Convex::probe`] would say, by the cheapest way.
    pub(crate) fn overlaps(&self) -> bool {
        if self.lines() == [None, None] && self.radii == 0.0 {
            return self.with_outlines(|a, b| self.decide(a, b));
        }
        matches!(self.probe(0.0, Hint::NONE), Probe::Near(near) if near.overlapping)
    }

    /// Contact points of shapes at most `margin` metres apart, on their surfaces. None for two half-planes that overlap
    /// without end.
    pub(crate) fn touch(&self, near: &Near, margin: f64) -> Option<Touch> {
        let preference = self.preference();
        match &near.evidence {
            Evidence::Axes(axes, witness) => {
                Some(self.with_outlines(|a, b| touch(a, b, axes, witness.as_ref(), margin, preference)))
            }
            Evidence::Points => {
                let feature = FeatureId::new(Feature::Vertex(0), Feature::Vertex(0));
                let point = self.with_outlines(|a, b| {
                    let (on_a, on_b) = (a.point(0), b.point(0));
                    let separation = near.normal.dot(on_b - on_a);
                    Point { separation, on_a, on_b, feature }.on_surfaces(a, b, near.normal)
                });
                Some(Touch { normal: near.normal, points: core::iter::once(point).collect() })
            }
            Evidence::HalfPlane(line) => {
                Some(self.with_outlines(|a, b| line.touch(if line.is_b { a } else { b }, margin, preference)))
            }
            Evidence::HalfPlanes(a, b) => {
                let [on_a, on_b] = a.points_with(b);
                let separation = a.separation_from(b);
                let feature = FeatureId::new(Feature::Edge(0), Feature::Edge(0));
                let points = core::iter::once(Point { separation, on_a, on_b, feature }).collect();
                (separation > f64::NEG_INFINITY).then_some(Touch { normal: a.axis(), points })
            }
        }
    }

    fn probe_half_planes(&self, a: Line, b: Line, limit: f64) -> Probe {
        let separation = a.separation_from(&b);
        self.told(
            Told {
                separation,
                at_least: separation,
                normal: a.axis(),
                closest: a.points_with(&b),
                evidence: Evidence::HalfPlanes(a, b),
            },
            limit,
        )
    }

    fn probe_half_plane(&self, line: Line, limit: f64) -> Probe {
        let (vertex, height) = self.with_outlines(|a, b| {
            let core = if line.is_b { a } else { b };
            let (vertex, height) = line.lowest(core);
            (core.point(vertex), height)
        });
        let separation = height - self.radii;
        let on_shape = vertex - line.normal * self.radii;
        let on_line = vertex - line.normal * height;
        let closest = if line.is_b { [on_shape, on_line] } else { [on_line, on_shape] };
        let evidence = Evidence::HalfPlane(line);
        self.told(Told { separation, at_least: separation, normal: line.axis(), closest, evidence }, limit)
    }

    fn probe_points(&self, a: &Outline, b: &Outline, limit: f64) -> Probe {
        let (on_a, on_b) = (a.point(0), b.point(0));
        let distance = (on_b - on_a).length();
        let normal = if distance > 0.0 { (on_b - on_a) / distance } else { DVec2::Y };
        let separation = distance - self.radii;
        let closest = self.on_surfaces([on_a, on_b], normal);
        let evidence = Evidence::Points;
        self.told(Told { separation, at_least: separation, normal, closest, evidence }, limit)
    }

    /// What a kernel without axes to try has told, within the limit: here a number decides, up to rounding.
    fn told(&self, told: Told, limit: f64) -> Probe {
        let Told { separation, at_least: bound, normal, closest, evidence } = told;
        let precision = self.precision;
        if bound > limit + precision.projection() {
            return Probe::Beyond(at_least(bound, &precision), Hint::NONE);
        }
        let overlapping = separation <= precision.projection();
        // Half-spaces that overlap without end do so exactly.
        let is_endless = separation == f64::NEG_INFINITY;
        let error = if is_endless { 0.0 } else { precision.of_distance(separation, separation - bound) };
        Probe::Near(Near {
            overlapping,
            separation: signed(separation, overlapping),
            error,
            normal,
            closest: (!overlapping).then_some(closest),
            hint: Hint::NONE,
            evidence,
        })
    }

    /// Axes first; the decision next; then the number that agrees with it.
    fn probe_outlines(&self, a: &Outline, b: &Outline, limit: f64, hint: Hint) -> Probe {
        let precision = self.precision;
        let radii = self.radii;
        let axes = match separating_axes(a, b, limit + radii + precision.projection(), hint) {
            Outcome::Beyond(axis) => {
                return Probe::Beyond(at_least(axis.separation - radii, &precision), hint_of(&axis));
            }
            Outcome::Within(axes) => axes,
        };
        let best = axes.best();
        let hint = hint_of(best);
        // Within its error of zero a sign is not the number's to tell: `decide` does, so that both always agree.
        let is_clear = best.separation.abs() > f64::from(precision.of_separation(0.0)) && !is_thin(a, b);
        let cores_overlap = if is_clear { best.separation < 0.0 } else { self.decide(a, b) };
        if cores_overlap {
            let depth = best.separation.min(0.0) - radii;
            return Probe::Near(Near {
                overlapping: true,
                separation: signed(depth, true),
                error: precision.of_separation(best.separation - radii),
                normal: best.normal,
                closest: None,
                hint,
                evidence: Evidence::Axes(axes, None),
            });
        }
        let Some(witness) = self.witness(a, b, best) else { return self.all_but_touching(a, b, axes) };
        // Where both bounds meet up to rounding, the projection went through less of it.
        let gap = witness.distance - witness.at_least;
        let core =
            if radii > 0.0 && gap <= precision.projection() { witness.at_least } else { witness.distance };
        let separation = core - radii;
        let overlapping = radii > 0.0 && separation <= precision.projection();
        let closest = self.on_surfaces([witness.point_a, witness.point_b], witness.across);
        Probe::Near(Near {
            overlapping,
            separation: signed(separation, overlapping),
            error: precision.of_distance(separation, gap),
            normal: witness.normal,
            closest: (!overlapping).then_some(closest),
            hint,
            evidence: Evidence::Axes(axes, Some(witness)),
        })
    }

    /// Cores that an axis parts by so little that no two points of them do: their contact is made as if they
    /// overlapped.
    fn all_but_touching(&self, a: &Outline, b: &Outline, axes: Axes) -> Probe {
        let precision = self.precision;
        let best = axes.best();
        let overlapping = self.radii > 0.0;
        let separation = best.separation.max(0.0) - self.radii;
        let touch = touch(a, b, &axes, None, 0.0, self.preference());
        let deepest = touch.points.iter().min_by(|one, other| one.separation.total_cmp(&other.separation));
        Probe::Near(Near {
            overlapping,
            separation: signed(separation, overlapping),
            error: precision.of_separation(separation),
            normal: best.normal,
            closest: deepest.filter(|_| !overlapping).map(|point| [point.on_a, point.on_b]),
            hint: hint_of(best),
            evidence: Evidence::Axes(axes, None),
        })
    }

    /// Witness points of a gap between the cores, with the better of the two lower bounds: the iteration's, and the
    /// best axis'. Nothing where the points are too close to tell apart.
    fn witness(&self, a: &Outline, b: &Outline, best: &Axis) -> Option<Witness> {
        let mut witness = distance(a, b, best.normal, self.precision.size)?;
        if best.separation >= witness.at_least {
            if witness.is_close(self.precision.size) {
                witness.across = best.normal;
            }
            (witness.at_least, witness.normal) = (best.separation, best.normal);
        }
        Some(witness)
    }

    /// Points of the cores moved out to the shapes' surfaces.
    fn on_surfaces(&self, [on_a, on_b]: [DVec2; 2], normal: DVec2) -> [DVec2; 2] {
        [on_a + normal * f64::from(self.shape_a.radius()), on_b - normal * f64::from(self.shape_b.radius())]
    }

    /// Whether the cores share a point. Decided in f64.
    fn decide(&self, a: &Outline, b: &Outline) -> bool {
        if a.edge_count() + b.edge_count() == 0 {
            return a.point(0) == b.point(0);
        }
        overlaps(a, b) && !(is_thin(a, b) && self.is_parted(a, b))
    }

    /// Whether the distance iteration finds an axis that parts the cores. It needs no normals, and its axis is
    /// believed only after full projection.
    fn is_parted(&self, a: &Outline, b: &Outline) -> bool {
        let precision = self.precision;
        let witness = distance(a, b, DVec2::X, precision.size);
        witness.is_some_and(|witness| witness.at_least > precision.projection())
    }

    /// The lines of half-planes.
    fn lines(&self) -> [Option<Line>; 2] {
        let line = |shape: &Shape2, is_b: bool| {
            let Shape2::HalfPlane(half_plane) = shape else { return None };
            let (turn, origin) = if is_b { (self.turn_b, self.offset) } else { (self.turn_a, DVec2::ZERO) };
            Some(Line { normal: turn.turn(half_plane.unit_normal()).normalize(), origin, is_b })
        };
        [line(self.shape_a, false), line(self.shape_b, true)]
    }

    pub(crate) fn with_outlines<R>(&self, ask: impl FnOnce(&Outline, &Outline) -> R) -> R {
        let (core_a, core_b): (Core2, Core2) = (self.shape_a.core(), self.shape_b.core());
        let a = Outline::new(&core_a, self.turn_a, DVec2::ZERO, f64::from(self.shape_a.radius()));
        let b = Outline::new(&core_b, self.turn_b, self.offset, f64::from(self.shape_b.radius()));
        ask(&a, &b)
    }

    /// How much another axis must beat a face of A by, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be all of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        (FACE_PREFERENCE * 2.0 * smaller).max(self.precision.projection())
    }
}

/// Whether neither core has an inside: they may lie on one line, and have no axis along it.
fn is_thin(a: &Outline, b: &Outline) -> bool {
    a.is_flat() && b.is_flat()
}

/// Bounding radius of a core. A half-plane has none: only the other shape's vertices enter its pairs.
fn core_size(shape: &Shape2) -> f64 {
    match shape {
        Shape2::HalfPlane(_) => 0.0,
        _ => f64::from(shape.outer_radius()) - f64::from(shape.radius()),
    }
}
