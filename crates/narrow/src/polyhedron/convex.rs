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
//! Whether they overlap is settled in three tiers, each asked only where the one before cannot tell:
//!
//! ```text
//! Bound    what is asked first: all axes of boxes and small polygons, a distance in closed form, or as below
//! Double   an axis that parts them, or corners around a common point, each further off than rounding   (distance)
//! Exact    integers, from the corners where f64 stopped                                               (exact)
//! ```
//! The number then takes the decision's sign: where it says otherwise, it is rounding.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! plane out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

use super::cuboids::{Cuboids, Sides};
use super::distance::{Close, Reached, Until, Witness, distance};
use super::half_space::Plane;
use super::manifold::{Ask, Point, Touch, touch, touch_into};
use super::sat::{Axes, Axis, Outcome, Search, hint_of, separating_axes};
use super::slender::{self, Nearest};
use super::solid::Solid;
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Corner, Site3};
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{IN_SPACE, Precision, at_least, signed};
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::FACE_PREFERENCE;
use asunder_geometry::{Basis3, Core3, Hull, Shape3};

/// Two convex shapes in the frame of the pair: A's axes, about A's position.
pub(crate) struct Convex<'a> {
    sites: [Site3<'a>; 2],
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
    pub(crate) verdict: Verdict,
    pub(crate) separation: f32,
    pub(crate) error: f32,
    /// Unit axis from A to B.
    pub(crate) normal: DVec3,
    /// Closest points of the shapes, where they do not overlap.
    pub(crate) closest: Option<[DVec3; 2]>,
    pub(crate) hint: Hint,
    evidence: Evidence,
}

/// How two cores lie, as far as the distance iteration came.
#[allow(clippy::large_enum_variant, reason = "as Probe")]
enum Cores {
    /// Overlapping, or apart by at most so many metres.
    Within(f64),
    /// Two bounds on their distance, with witness points.
    Between(Witness),
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
    pub(crate) fn new(sites: [Site3<'a>; 2], relative: Basis3, offset: DVec3, summed: f64) -> Self {
        let [shape_a, shape_b] = sites.map(|site| site.shape);
        let radii = f64::from(shape_a.radius()) + f64::from(shape_b.radius());
        let planarity = |shape: &Shape3| match shape {
            Shape3::Hull(hull) => f64::from(Hull::planarity_error(hull)),
            _ => 0.0,
        };
        // What the distance iteration's steps are relative to: radii do not enter it.
        let size = core_size(shape_a) + core_size(shape_b);
        // Sums of coordinates bound lengths, and need no root.
        let length = |v: DVec3| v.abs().element_sum();
        let off_center = length(shape_a.center().as_dvec3()) + length(shape_b.center().as_dvec3());
        let precision = Precision {
            size,
            reach: size + radii + off_center + length(offset) + summed,
            planarity: planarity(shape_a) + planarity(shape_b),
            roundings: IN_SPACE[usize::from(sites.iter().any(|site| site.part.is_some()))],
        };
        Self { sites, shape_a, shape_b, relative, offset, precision, radii }
    }

    /// The separation where it is at most `limit` metres; the hinted axis is tried first.
    pub(crate) fn probe(&self, limit: f64, hint: Hint) -> Probe {
        match self.planes() {
            [Some(a), Some(b)] => self.told(self.told_half_spaces(a, b), limit),
            [Some(plane), None] | [None, Some(plane)] => self.told(self.told_half_space(plane), limit),
            [None, None] => self.with_solids(|a, b| {
                if a.is_slender() && b.is_slender() {
                    self.told(self.told_slender(a, b), limit)
                } else {
                    self.probe_solids(a, b, limit, hint)
                }
            }),
        }
    }

    /// Whether the shapes share a point: as [`Convex::probe`] would say, by the cheapest way.
    ///
    /// For two cuboids that is their fifteen axes; for other solids a search for a direction that parts them, or for
    /// corners around a common point, which asks for no face and no edge.
    pub(crate) fn verdict(&self) -> Verdict {
        if self.radii == 0.0
            && let Some(cuboids) = self.cuboids()
        {
            return match cuboids.sides(&self.precision) {
                Sides::Apart => Verdict { overlapping: false, tier: Tier::Bound },
                Sides::Overlapping => Verdict { overlapping: true, tier: Tier::Bound },
                Sides::Unclear => self.with_solids(|a, b| self.look_closer(a, b, None).0),
            };
        }
        match self.planes() {
            [None, None] => self.with_solids(|a, b| {
                if a.is_slender() && b.is_slender() {
                    return self.told_verdict(&self.told_slender(a, b));
                }
                let verdict = self.conclude(distance(a, b, self.towards_b(), &self.until_told())).0;
                // What was asked first is the first tier.
                let tier = if verdict.tier == Tier::Exact { Tier::Exact } else { Tier::Bound };
                Verdict { tier, ..verdict }
            }),
            [Some(a), Some(b)] => self.told_verdict(&self.told_half_spaces(a, b)),
            [Some(plane), None] | [None, Some(plane)] => self.told_verdict(&self.told_half_space(plane)),
        }
    }

    /// What the first tier's numbers say of the overlap, within their error of zero too.
    pub(crate) fn guess(&self) -> bool {
        if self.radii == 0.0
            && let Some(cuboids) = self.cuboids()
        {
            return cuboids.overlaps();
        }
        match self.planes() {
            [None, None] => self.with_solids(|a, b| {
                if a.is_slender() && b.is_slender() {
                    return self.told_slender(a, b).separation <= 0.0;
                }
                let until = Until { beyond: self.radii, within: self.radii, precision: &self.precision };
                match distance(a, b, self.towards_b(), &until) {
                    Reached::Between(witness) => witness.distance <= self.radii,
                    Reached::Origin(_) => true,
                }
            }),
            [Some(a), Some(b)] => a.separation_from(&b, || true) <= 0.0,
            [Some(plane), None] | [None, Some(plane)] => self.told_half_space(plane).separation <= 0.0,
        }
    }

    /// From A's centre to B's: where a search may begin.
    fn towards_b(&self) -> DVec3 {
        let center_b = self.offset + self.relative.turn(self.shape_b.center().as_dvec3());
        (center_b - self.shape_a.center().as_dvec3()).try_normalize().unwrap_or(DVec3::X)
    }

    /// For a yes or no a distance is known well enough once it tells whether the radii close the gap.
    fn until_told(&self) -> Until<'_> {
        let doubt = self.precision.projection();
        Until { beyond: self.radii + doubt, within: self.radii - 2.0 * doubt, precision: &self.precision }
    }

    /// Contact points of shapes at most `margin` metres apart, on their surfaces. None for two half-spaces that overlap
    /// without end.
    pub(crate) fn touch(&self, near: &Near, margin: f64) -> Option<Touch> {
        let preference = self.preference();
        match &near.evidence {
            Evidence::Axes(axes, witness) => {
                let ask = Ask { axes, witness: witness.as_ref(), margin, preference, last: None };
                let mut touch = Touch::NONE;
                self.with_solids(|a, b| touch_into(a, b, &ask, &mut touch));
                Some(touch)
            }
            Evidence::Slender(nearest) => {
                Some(self.with_solids(|a, b| slender::touch(a, b, nearest, margin, preference)))
            }
            Evidence::HalfSpace(plane) => {
                Some(self.with_solids(|a, b| plane.touch(if plane.is_b { a } else { b }, margin, preference)))
            }
            Evidence::HalfSpaces(a, b) => {
                let [on_a, on_b] = a.points_with(b);
                let separation = near.separation.into();
                let feature = FeatureId::new(Feature::Face(0), Feature::Face(0));
                let points = core::iter::once(Point { separation, on_a, on_b, feature }).collect();
                (separation > f64::NEG_INFINITY).then_some(Touch { normal: a.axis(), points, of: None })
            }
        }
    }

    fn told_half_spaces(&self, a: Plane, b: Plane) -> Told {
        let separation = a.separation_from(&b, || exact::are_opposed3([&self.sites[0], &self.sites[1]]));
        Told {
            separation,
            at_least: separation,
            normal: a.axis(),
            closest: a.points_with(&b),
            evidence: Evidence::HalfSpaces(a, b),
        }
    }

    fn told_half_space(&self, plane: Plane) -> Told {
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
        Told { separation, at_least: separation, normal: plane.axis(), closest, evidence }
    }

    fn told_slender(&self, a: &Solid, b: &Solid) -> Told {
        let nearest = slender::nearest(a, b, self.precision.projection());
        Told {
            separation: nearest.distance - self.radii,
            at_least: nearest.at_least - self.radii,
            normal: nearest.normal,
            closest: self.on_surfaces([nearest.on_a, nearest.on_b], nearest.normal),
            evidence: Evidence::Slender(nearest),
        }
    }

    /// Whether the shapes overlap, where closed-form kernels have told two bounds.
    fn told_verdict(&self, told: &Told) -> Verdict {
        let doubt = 2.0 * self.precision.projection();
        if told.at_least > doubt || told.separation < -doubt {
            return Verdict { overlapping: told.separation < 0.0, tier: Tier::Bound };
        }
        self.exactly(&[])
    }

    /// What a kernel without axes to try has told, within the limit.
    fn told(&self, told: Told, limit: f64) -> Probe {
        let precision = self.precision;
        if told.at_least > limit + precision.projection() {
            return Probe::Beyond(at_least(told.at_least, &precision), Hint::NONE);
        }
        let verdict = self.told_verdict(&told);
        let Told { separation, at_least: bound, normal, closest, evidence } = told;
        // Half-spaces that overlap without end do so exactly.
        let is_endless = separation == f64::NEG_INFINITY;
        let error = if is_endless { 0.0 } else { precision.of_distance(separation, separation - bound) };
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error,
            normal,
            closest: (!verdict.overlapping).then_some(closest),
            hint: Hint::NONE,
            evidence,
        })
    }

    /// Axes first; the decision next; then the number that agrees with it.
    fn probe_solids(&self, a: &Solid, b: &Solid, limit: f64, hint: Hint) -> Probe {
        let precision = self.precision;
        let axes = match self.axes(a, b, limit + self.radii + precision.projection(), hint) {
            Outcome::Beyond(axis) => {
                return Probe::Beyond(at_least(axis.separation - self.radii, &precision), hint_of(&axis));
            }
            Outcome::Within(axes) => axes,
        };
        let is_clear = axes.best().separation + axes.short() < -2.0 * precision.projection();
        // Axes of faces that were derived or merged are no proof: for those, corners around a common point are.
        if is_clear && self.cuboids().is_some() {
            return self.overlap_of_cores(axes, Verdict { overlapping: true, tier: Tier::Bound }, 0.0);
        }
        match self.look_closer(a, b, Some(axes.best())) {
            // A search that proved no gap, where all axes show an overlap.
            (verdict, Cores::Between(witness))
                if verdict.overlapping && axes.best().separation + axes.short() < 0.0 =>
            {
                self.overlap_of_cores(axes, verdict, witness.distance)
            }
            (verdict, Cores::Between(witness)) => self.gap_of_cores(axes, verdict, witness),
            (verdict, Cores::Within(gap)) if verdict.overlapping => self.overlap_of_cores(axes, verdict, gap),
            (verdict, Cores::Within(gap)) => self.all_but_touching(a, b, axes, (verdict, gap)),
        }
    }

    /// Shapes whose cores overlap, or have so small a gap that no axis tells, as deep as the best axis says. `gap` is the
    /// most that the gap can be.
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

    /// By how much the truth may exceed the best axis, of cores that are apart by at most `gap`.
    ///
    /// In overlap the axes are all there are. In a gap the best one may be none of them, and only witness points tell.
    fn short(&self, axes: &Axes, gap: f64) -> f64 {
        let (best, short) = (axes.best().separation, axes.short());
        if best + short < 0.0 { short } else { short.max(gap - best) }
    }

    /// Shapes with a gap between their cores, which their radii may close.
    fn gap_of_cores(&self, axes: Axes, verdict: Verdict, witness: Witness) -> Probe {
        let precision = self.precision;
        // Where both bounds meet up to rounding, the projection went through less of it.
        let gap = witness.distance - witness.at_least;
        let is_met = self.radii > 0.0 && gap <= precision.projection();
        let separation = if is_met { witness.at_least } else { witness.distance } - self.radii;
        let closest = self.on_surfaces([witness.point_a, witness.point_b], witness.across);
        Probe::Near(Near {
            verdict,
            separation: signed(separation, verdict.overlapping),
            error: precision.of_distance(separation, gap),
            normal: witness.normal,
            closest: (!verdict.overlapping).then_some(closest),
            hint: hint_of(axes.best()),
            evidence: Evidence::Axes(axes, Some(witness)),
        })
    }

    /// The second tier and the third, and how the cores lie. `best` is the axis that the first tier found best.
    ///
    /// Of the two lower bounds, the iteration's and the best axis', the better one is kept.
    fn look_closer(&self, a: &Solid, b: &Solid, best: Option<&Axis>) -> (Verdict, Cores) {
        let towards = best.map_or_else(|| self.towards_b(), |axis| axis.normal);
        let mut reached = distance(a, b, towards, &Until::met(&self.precision));
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

    /// What the distance iteration has proved, and the third tier where it has proved nothing.
    fn conclude(&self, reached: Reached) -> (Verdict, Cores) {
        let doubt = self.precision.projection();
        let double = |overlapping: bool| Verdict { overlapping, tier: Tier::Double };
        let witness = match reached {
            Reached::Origin(Close { is_proved: true, .. }) => return (double(true), Cores::Within(0.0)),
            Reached::Origin(close) => {
                let verdict = self.exactly(&close.corners);
                let do_overlap = self.radii == 0.0 && verdict.overlapping;
                return (verdict, Cores::Within(if do_overlap { 0.0 } else { close.within }));
            }
            Reached::Between(witness) => witness,
        };
        if witness.at_least - self.radii > doubt {
            return (double(false), Cores::Between(witness));
        }
        if self.radii > 0.0 && witness.distance - self.radii < -2.0 * doubt {
            return (double(true), Cores::Between(witness));
        }
        let verdict = self.exactly(&witness.corners);
        let do_overlap = self.radii == 0.0 && verdict.overlapping;
        (verdict, if do_overlap { Cores::Within(0.0) } else { Cores::Between(witness) })
    }

    /// The third tier, from the corners where f64 stopped.
    fn exactly(&self, start: &[Corner]) -> Verdict {
        let overlapping = exact::overlaps3([&self.sites[0], &self.sites[1]], start);
        Verdict { overlapping, tier: Tier::Exact }
    }

    /// Cores that an axis parts by so little that no two points of them do: their contact is made as if they
    /// overlapped.
    fn all_but_touching(&self, a: &Solid, b: &Solid, axes: Axes, (verdict, gap): (Verdict, f64)) -> Probe {
        let precision = self.precision;
        let best = axes.best();
        let separation = best.separation.max(0.0) - self.radii;
        let preference = self.preference();
        let touch = touch(a, b, &Ask { axes: &axes, witness: None, margin: 0.0, preference, last: None });
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

    /// Points of the cores moved out to the shapes' surfaces.
    fn on_surfaces(&self, [on_a, on_b]: [DVec3; 2], normal: DVec3) -> [DVec3; 2] {
        [on_a + normal * f64::from(self.shape_a.radius()), on_b - normal * f64::from(self.shape_b.radius())]
    }

    pub(crate) fn axes(&self, a: &Solid, b: &Solid, limit: f64, hint: Hint) -> Outcome {
        let slack = self.preference() + 4.0 * self.precision.planarity;
        let search = Search { limit, hint, slack, precision: &self.precision };
        match self.cuboids() {
            Some(cuboids) => cuboids.separating_axes(a, b, &search),
            None => separating_axes(a, b, &search),
        }
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
