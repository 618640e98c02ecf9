//! Two convex shapes: which kernel they go to, and what its answer means with their radii.
//!
//! ```text
//! separation of two rounded shapes = separation of their cores - both radii, along the same axis
//! half-space and anything:          its plane's normal is the only axis        (half_space)
//! points and segments:              closest points in closed form              (slender)
//! two cuboids:                      fifteen axes                               (cuboids)
//! everything else:                  faces and edge pairs                       (sat)
//!                                   in a gap, the closest points as well       (distance)
//! ```
//! Where a number decides whether shapes overlap, and not a test of axes, within rounding of touching counts as
//! touching: bodies on a grid touch exactly and often, and are hardly ever apart by so little.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! plane out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

use super::cuboids::Cuboids;
use super::distance::{Witness, distance};
use super::half_space::Plane;
use super::manifold::{Point, Touch, touch};
use super::sat::{Axes, Axis, Outcome, hint_of, overlaps, separating_axes};
use super::slender::{self, Nearest};
use super::solid::Solid;
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{Precision, at_least, signed};
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Basis3, Core3, Hull, Shape3};

/// Two convex shapes in the frame of the pair: A's axes, about A's position.
pub(crate) struct Convex<'a> {
    pub(crate) shape_a: &'a Shape3,
    pub(crate) shape_b: &'a Shape3,
    /// B's axes seen from A.
    pub(crate) relative: Basis3,
    /// B's position seen from A.
    pub(crate) offset: DVec3,
    pub(crate) precision: Precision,
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
    pub(crate) normal: DVec3,
    /// Closest points of the shapes, where they do not overlap.
    pub(crate) closest: Option<[DVec3; 2]>,
    pub(crate) hint: Hint,
    evidence: Evidence,
}

/// What a kernel in closed form says of two shapes.
struct Told {
    separation: f64,
    /// A lower bound on it.
    at_least: f64,
    /// Unit axis from A to B.
    normal: DVec3,
    /// Closest points on the surfaces; they mean nothing in overlap.
    closest: [DVec3; 2],
    evidence: Evidence,
}

#[allow(clippy::large_enum_variant, reason = "as Probe")]
enum Evidence {
    /// The best axes; closest points of the cores, where those do not overlap.
    Axes(Axes, Option<Witness>),
    Slender(Nearest),
    HalfSpace(Plane),
    HalfSpaces(Plane, Plane),
}

const IDENTITY: Basis3 = Basis3 { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

impl<'a> Convex<'a> {
    /// Two shapes, B's axes and position as A sees them. `summed` is how long the vectors were that the position is a
    /// sum of, in metres, where it is one of several.
    pub(crate) fn new(shapes: [&'a Shape3; 2], relative: Basis3, offset: DVec3, summed: f64) -> Self {
        let [shape_a, shape_b] = shapes;
        let radii = f64::from(shape_a.radius()) + f64::from(shape_b.radius());
        let planarity = |shape: &Shape3| match shape {
            Shape3::Hull(hull) => f64::from(Hull::planarity_error(hull)),
            _ => 0.0,
        };
        // What errors are relative to: the cores' sizes, since radii are added exactly.
        let size = core_size(shape_a) + core_size(shape_b);
        // Sums of coordinates bound lengths, and need no root.
        let length = |v: DVec3| v.abs().element_sum();
        let off_center = length(shape_a.center().as_dvec3()) + length(shape_b.center().as_dvec3());
        let precision = Precision {
            size,
            reach: size + radii + off_center + length(offset) + summed,
            planarity: planarity(shape_a) + planarity(shape_b),
        };
        Self { shape_a, shape_b, relative, offset, precision, radii }
    }

    /// The separation where it is at most `limit` metres; the hinted axis is tried first.
    pub(crate) fn probe(&self, limit: f64, hint: Hint) -> Probe {
        match self.planes() {
            [Some(a), Some(b)] => self.probe_half_spaces(a, b, limit),
            [Some(plane), None] | [None, Some(plane)] => self.probe_half_space(plane, limit),
            [None, None] => self.with_solids(|a, b| {
                if a.is_slender() && b.is_slender() {
                    self.probe_slender(a, b, limit)
                } else {
                    self.probe_solids(a, b, limit, hint)
                }
            }),
        }
    }

    /// Whether the shapes share a point: as [`Convex::probe`] would say, by the cheapest way.
    pub(crate) fn overlaps(&self) -> bool {
        if self.radii == 0.0
            && let Some(cuboids) = self.cuboids()
        {
            return cuboids.overlaps();
        }
        if self.planes() == [None, None] && self.radii == 0.0 {
            return self.with_solids(|a, b| {
                if a.is_slender() && b.is_slender() {
                    slender::nearest(a, b, self.precision.projection()).distance == 0.0
                } else {
                    self.decide(a, b)
                }
            });
        }
        matches!(self.probe(0.0, Hint::NONE), Probe::Near(near) if near.overlapping)
    }

    /// Contact points of shapes at most `margin` metres apart, on their surfaces. None for two half-spaces that overlap
    /// without end.
    pub(crate) fn touch(&self, near: &Near, margin: f64) -> Option<Touch> {
        let preference = self.preference();
        match &near.evidence {
            Evidence::Axes(axes, witness) => {
                Some(self.with_solids(|a, b| touch(a, b, axes, witness.as_ref(), margin, preference)))
            }
            Evidence::Slender(nearest) => {
                Some(self.with_solids(|a, b| slender::touch(a, b, nearest, margin, preference)))
            }
            Evidence::HalfSpace(plane) => {
                Some(self.with_solids(|a, b| plane.touch(if plane.is_b { a } else { b }, margin, preference)))
            }
            Evidence::HalfSpaces(a, b) => {
                let [on_a, on_b] = a.points_with(b);
                let separation = a.separation_from(b);
                let feature = FeatureId::new(Feature::Face(0), Feature::Face(0));
                let points = core::iter::once(Point { separation, on_a, on_b, feature }).collect();
                (separation > f64::NEG_INFINITY).then_some(Touch { normal: a.axis(), points })
            }
        }
    }

    fn probe_half_spaces(&self, a: Plane, b: Plane, limit: f64) -> Probe {
        let separation = a.separation_from(&b);
        self.told(
            Told {
                separation,
                at_least: separation,
                normal: a.axis(),
                closest: a.points_with(&b),
                evidence: Evidence::HalfSpaces(a, b),
            },
            limit,
        )
    }

    fn probe_half_space(&self, plane: Plane, limit: f64) -> Probe {
        let (vertex, height) = self.with_solids(|a, b| {
            let core = if plane.is_b { a } else { b };
            let (vertex, height) = plane.lowest(core);
            (core.point(vertex), height)
        });
        let separation = height - self.radii;
        let on_shape = vertex - plane.normal * self.radii;
        let on_plane = vertex - plane.normal * height;
        let closest = if plane.is_b { [on_shape, on_plane] } else { [on_plane, on_shape] };
        let evidence = Evidence::HalfSpace(plane);
        self.told(Told { separation, at_least: separation, normal: plane.axis(), closest, evidence }, limit)
    }

    fn probe_slender(&self, a: &Solid, b: &Solid, limit: f64) -> Probe {
        let nearest = slender::nearest(a, b, self.precision.projection());
        self.told(
            Told {
                separation: nearest.distance - self.radii,
                at_least: nearest.at_least - self.radii,
                normal: nearest.normal,
                closest: self.on_surfaces([nearest.on_a, nearest.on_b], nearest.normal),
                evidence: Evidence::Slender(nearest),
            },
            limit,
        )
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
    fn probe_solids(&self, a: &Solid, b: &Solid, limit: f64, hint: Hint) -> Probe {
        let precision = self.precision;
        let radii = self.radii;
        let axes = match self.axes(a, b, limit + radii + precision.projection(), hint) {
            Outcome::Beyond(axis) => {
                return Probe::Beyond(at_least(axis.separation - radii, &precision), hint_of(&axis));
            }
            Outcome::Within(axes) => axes,
        };
        let best = axes.best();
        let hint = hint_of(best);
        // Within its error of zero a sign is not the number's to tell: `decide` does, so that both always agree.
        let is_clear = best.separation.abs() > f64::from(precision.of_separation(0.0)) && !self.is_thin(a, b);
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
    fn all_but_touching(&self, a: &Solid, b: &Solid, axes: Axes) -> Probe {
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
    fn witness(&self, a: &Solid, b: &Solid, best: &Axis) -> Option<Witness> {
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
    fn on_surfaces(&self, [on_a, on_b]: [DVec3; 2], normal: DVec3) -> [DVec3; 2] {
        [on_a + normal * f64::from(self.shape_a.radius()), on_b - normal * f64::from(self.shape_b.radius())]
    }

    pub(crate) fn axes(&self, a: &Solid, b: &Solid, limit: f64, hint: Hint) -> Outcome {
        match self.cuboids() {
            Some(cuboids) => cuboids.separating_axes(a, b, limit, hint),
            None => {
                let slack = self.preference() + 4.0 * self.precision.planarity;
                separating_axes(a, b, limit, hint, slack)
            }
        }
    }

    /// Whether the cores share a point. Decided in f64.
    fn decide(&self, a: &Solid, b: &Solid) -> bool {
        match self.cuboids() {
            Some(cuboids) => cuboids.overlaps(),
            None => overlaps(a, b) && !(self.is_thin(a, b) && self.is_parted(a, b)),
        }
    }

    /// Whether faces and edges may miss a gap.
    ///
    /// Of a hull so thin that its faces are all but antipodal, the directions along the plate or across the needle
    /// are no normals, and face and edge axes show a gap in them only scaled by the thickness: too little to tell
    /// from rounding. Two cores without an inside may lie in one plane, and have no axes in it at all. A cuboid has
    /// the normals of its sides, however thin it is.
    fn is_thin(&self, a: &Solid, b: &Solid) -> bool {
        let thin = |shape: &Shape3| matches!(shape, Shape3::Hull(hull) if hull.is_thin());
        thin(self.shape_a) || thin(self.shape_b) || (a.is_flat() && b.is_flat())
    }

    /// Whether the distance iteration finds an axis that parts the cores. It needs no normals, and its axis is
    /// believed only after full projection.
    fn is_parted(&self, a: &Solid, b: &Solid) -> bool {
        let precision = self.precision;
        let witness = distance(a, b, DVec3::X, precision.size);
        witness.is_some_and(|witness| witness.at_least > precision.projection())
    }

    fn cuboids(&self) -> Option<Cuboids> {
        let (Shape3::Cuboid(a), Shape3::Cuboid(b)) = (self.shape_a, self.shape_b) else { return None };
        let (half_a, half_b) = (a.half_extents().as_dvec3(), b.half_extents().as_dvec3());
        Some(Cuboids { half_a, half_b, basis: self.relative, offset: self.offset })
    }

    /// The planes of half-spaces.
    fn planes(&self) -> [Option<Plane>; 2] {
        let plane = |shape: &Shape3, is_b: bool| {
            let Shape3::HalfSpace(half_space) = shape else { return None };
            let (basis, origin) = if is_b { (self.relative, self.offset) } else { (IDENTITY, DVec3::ZERO) };
            Some(Plane { normal: basis.turn(half_space.unit_normal()), origin, is_b })
        };
        [plane(self.shape_a, false), plane(self.shape_b, true)]
    }

    pub(crate) fn with_solids<R>(&self, ask: impl FnOnce(&Solid, &Solid) -> R) -> R {
        let (core_a, core_b): (Core3, Core3) = (self.shape_a.core(), self.shape_b.core());
        let a = Solid::new(&core_a, IDENTITY, DVec3::ZERO, f64::from(self.shape_a.radius()));
        let b = Solid::new(&core_b, self.relative, self.offset, f64::from(self.shape_b.radius()));
        ask(&a, &b)
    }

    /// How much another axis must beat a face of A by, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be all of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        (FACE_PREFERENCE * 2.0 * smaller).max(self.precision.projection())
    }
}

/// Bounding radius of a core. A half-space has none: only the other shape's vertices enter its pairs.
fn core_size(shape: &Shape3) -> f64 {
    match shape {
        Shape3::HalfSpace(_) => 0.0,
        _ => f64::from(shape.outer_radius()) - f64::from(shape.radius()),
    }
}
