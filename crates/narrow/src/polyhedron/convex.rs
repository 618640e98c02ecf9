//! Two convex shapes: which kernel they go to, and what its answer means with their radii.
//!
//! ```text
//! separation of two rounded shapes = separation of their cores - both radii, along the same axis
//! half-space and anything:          its plane's normal is the only axis                         (half_space)
//! a ball and a cuboid:              the centre clamped to the cuboid                            (cuboids::ball)
//! points and segments:              closest points in closed form                               (slender)
//! two cuboids:                      fifteen axes                                                (cuboids)
//! everything else:                  last frame's direction, if it still separates them          (parted)
//!                                   last frame's axis, if it is proved to be the best           (sat)
//!                                   a search for a separating direction or a common point       (portal)
//!                                   in a gap, the closest points                                (distance)
//!                                   in overlap, faces and edge pairs                            (sat)
//! ```
//! Where only closest points are wanted, neither axes nor features are computed (`apart`).
//!
//! Whether the shapes overlap is decided in three tiers, each used only where the one before cannot decide:
//!
//! ```text
//! Bound    what is evaluated first: all axes of boxes and small polygons, a distance in closed form, or as below
//! Double   a separating axis, or corners around a common point, each by more than rounding              (distance)
//! Exact    integers, starting from the corners where f64 stopped                                        (exact)
//! ```
//! The separation is then given the decision's sign: where the number says otherwise, that is rounding.
//!
//! The rule in the first line holds in a gap and in overlap alike: adding a ball of radius r moves every supporting
//! plane out by r, so that the separation along every axis shrinks by the same amount, and the best axis stays the
//! best.

mod apart;
mod closed_form;
mod parted;
mod solids;

use super::cuboids::{Cuboids, Sides};
use super::distance::Witness;
use super::half_space::Plane;
use super::manifold::{Point, Touch, TouchInput, touch_into};
use super::sat::{Axes, last_of};
use super::slender::{self, Nearest, Slender};
use super::solid::Solid;
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Site3};
use crate::feature::{Feature, FeatureId, Hint};
use crate::precision::{IN_SPACE, Precision, length_at_most};
use asunder_geometry::glam::DVec3;
use asunder_geometry::tolerance::{EVEN_DEPTH, FACE_PREFERENCE, SAME_PLACE};
use asunder_geometry::{Basis3, Hull, Shape3};
use closed_form::Ball;

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

pub(crate) type Probe = crate::answer::Probe<Near>;

/// The separation of two shapes, and what shows it.
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

/// A query about a pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Query {
    /// Beyond this separation, in metres, nothing else needs to be known.
    pub(crate) limit: f64,
    /// Last frame's hint.
    pub(crate) hint: Hint,
    pub(crate) wanted: Wanted,
}

/// What an answer is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The separation.
    Number,
    /// Closest points, where there is a gap.
    Closest,
    /// Contact points: then [`Convex::touch`] may be called.
    Points,
}

#[allow(clippy::large_enum_variant, reason = "as Probe")]
enum Evidence {
    /// The best axes; closest points of the cores, where those do not overlap.
    Axes(Axes, Option<Witness>),
    Slender(Nearest),
    Ball(Ball),
    HalfSpace(Plane),
    HalfSpaces(Plane, Plane),
}

pub(crate) const IDENTITY: Basis3 = Basis3 { x: DVec3::X, y: DVec3::Y, z: DVec3::Z };

impl<'a> Convex<'a> {
    /// Two shapes, with B's axes and position as seen from A. Where the position is a sum of several vectors, `summed`
    /// is how long those were together, in metres.
    #[inline(always)]
    pub(crate) fn new(sites: [Site3<'a>; 2], relative: Basis3, offset: DVec3, summed: f64) -> Self {
        let (shape_a, shape_b) = (sites[0].shape, sites[1].shape);
        let radii = f64::from(shape_a.radius()) + f64::from(shape_b.radius());
        let planarity = |shape: &Shape3| match shape {
            Shape3::Hull(hull) => f64::from(Hull::planarity_error(hull)),
            _ => 0.0,
        };
        // What the distance iteration's steps are relative to: radii do not enter it.
        let size = core_size(shape_a) + core_size(shape_b);
        let off_center =
            length_at_most(shape_a.center().as_dvec3()) + length_at_most(shape_b.center().as_dvec3());
        let precision = Precision {
            size,
            reach: size + radii + off_center + length_at_most(offset) + summed,
            planarity: planarity(shape_a) + planarity(shape_b),
            roundings: IN_SPACE.of_either(sites.iter().any(|site| site.part.is_some())),
        };
        Self { sites, shape_a, shape_b, relative, offset, precision, radii }
    }

    /// The separation where it is within the limit; the hinted axis is tried first.
    pub(crate) fn probe(&self, query: Query) -> Probe {
        match self.closed_form() {
            Some(result) => self.probe_closed_form(result, query.limit),
            None => self.with_solids(|a, b| self.probe_solids(a, b, query)),
        }
    }

    /// [`Convex::probe`] and, where its answer is accepted, [`Convex::touch`]; also whether points were made. Both at
    /// once, since it costs something to build a [`Solid`] from a cuboid.
    pub(crate) fn contact(
        &self,
        query: Query,
        accept: impl FnOnce(&Near) -> bool,
        touch: &mut Touch,
    ) -> (Probe, bool) {
        if self.simple().is_some() {
            let probe = self.probe(query);
            let is_made = match &probe {
                Probe::Near(near) if accept(near) => self.touch(near, query, touch),
                _ => false,
            };
            return (probe, is_made);
        }
        if let Some(probe) = self.parted_as_before(query) {
            return (probe, false);
        }
        self.with_solids(|a, b| {
            let probe = self.probe_solids(a, b, query);
            let is_made = match &probe {
                Probe::Near(near) if accept(near) => {
                    self.touch_solids((a, b), near, query, touch);
                    true
                }
                _ => false,
            };
            (probe, is_made)
        })
    }

    /// Whether the shapes share a point: the decision of [`Convex::probe`], in the cheapest way.
    ///
    /// For two cuboids that is their fifteen axes; for other solids a search for a separating direction or for corners
    /// around a common point, which needs no face and no edge.
    pub(crate) fn verdict(&self) -> Verdict {
        if self.radii == 0.0
            && let Some(cuboids) = self.cuboids()
        {
            return match cuboids.sides(&self.precision) {
                Sides::Apart => Verdict { overlapping: false, tier: Tier::Bound },
                Sides::Overlapping => Verdict { overlapping: true, tier: Tier::Bound },
                Sides::Unclear => match exact::boxes_overlap3([&self.sites[0], &self.sites[1]]) {
                    Some(overlapping) => Verdict { overlapping, tier: Tier::Exact },
                    None => self.with_solids(|a, b| self.unclear_verdict(a, b)),
                },
            };
        }
        match self.closed_form() {
            Some(result) => self.closed_form_verdict(&result),
            None => self.with_solids(|a, b| self.verdict_of_solids(a, b)),
        }
    }

    /// Whether the first tier's numbers show an overlap, even where they are within their error of zero.
    pub(crate) fn guess(&self) -> bool {
        if self.radii == 0.0
            && let Some(cuboids) = self.cuboids()
        {
            return cuboids.overlaps();
        }
        match self.closed_form() {
            Some(result) => result.separation <= 0.0,
            None => self.with_solids(|a, b| self.guess_of_solids(a, b)),
        }
    }

    /// Contact points of shapes within the limit, on their surfaces. They are made on the features that last frame's
    /// hint names, unless those are worse by two preferences. Filled in, since they are large. False for two
    /// half-spaces that overlap without end, which have none.
    fn touch(&self, near: &Near, query: Query, touch: &mut Touch) -> bool {
        let (margin, preference) = (query.limit, self.preference());
        let (a, b) = match &near.evidence {
            Evidence::HalfSpaces(a, b) => (a, b),
            Evidence::HalfSpace(plane) => {
                let slacks = [preference, self.even_depth()];
                let (shape, frame) = self.shape_over(plane);
                *touch = plane.touch_shape(shape, frame, margin, slacks);
                return true;
            }
            Evidence::Ball(ball) => {
                *touch = ball.touch(near.separation.into(), self.on_surfaces(ball.points(), ball.axis()));
                return true;
            }
            Evidence::Slender(nearest) => {
                if let Some([a, b]) = self.slenders() {
                    *touch = slender::touch([&a, &b], nearest, margin, preference);
                }
                return true;
            }
            Evidence::Axes(..) => {
                self.with_solids(|a, b| self.touch_solids((a, b), near, query, touch));
                return true;
            }
        };
        let [on_a, on_b] = a.points_with(b);
        let separation = near.separation.into();
        let feature = FeatureId::new(Feature::Face(0), Feature::Face(0));
        touch.normal = a.axis();
        touch.points.push(Point { separation, on_a, on_b, feature });
        separation > f64::NEG_INFINITY
    }

    /// [`Convex::contact`] by the kernels of solids, whatever the shapes.
    #[cfg(test)]
    pub(crate) fn contact_of_solids(&self, query: Query) -> (Probe, Touch) {
        let mut touch = Touch::none();
        let probe = self.with_solids(|a, b| {
            let probe = self.probe_solids(a, b, query);
            if let Probe::Near(near) = &probe {
                self.touch_solids((a, b), near, query, &mut touch);
            }
            probe
        });
        (probe, touch)
    }

    /// [`Convex::touch`] for shapes that are treated as solids.
    fn touch_solids(&self, (a, b): (&Solid, &Solid), near: &Near, query: Query, touch: &mut Touch) {
        let (margin, preference) = (query.limit, self.preference());
        if let Evidence::Axes(axes, witness) = &near.evidence {
            let (even, last) = (self.even_depth(), last_of(query.hint));
            let near = self.same_place();
            let input = TouchInput { axes, witness: witness.as_ref(), margin, preference, even, near, last };
            touch_into(a, b, &input, touch);
        }
    }

    /// Points of the cores moved out to the shapes' surfaces.
    fn on_surfaces(&self, [on_a, on_b]: [DVec3; 2], normal: DVec3) -> [DVec3; 2] {
        [on_a + normal * f64::from(self.shape_a.radius()), on_b - normal * f64::from(self.shape_b.radius())]
    }

    fn cuboids(&self) -> Option<Cuboids> {
        let (Shape3::Cuboid(a), Shape3::Cuboid(b)) = (self.shape_a, self.shape_b) else { return None };
        let (half_a, half_b) = (a.half_extents().as_dvec3(), b.half_extents().as_dvec3());
        Some(Cuboids { half_a, half_b, basis: self.relative, offset: self.offset })
    }

    /// The planes of those shapes that are half-spaces.
    fn planes(&self) -> [Option<Plane>; 2] {
        let plane = |shape: &Shape3, is_b: bool| {
            let Shape3::HalfSpace(half_space) = shape else { return None };
            let (basis, origin) = if is_b { (self.relative, self.offset) } else { (IDENTITY, DVec3::ZERO) };
            Some(Plane { normal: basis.turn(half_space.unit_normal()), origin, is_b })
        };
        [plane(self.shape_a, false), plane(self.shape_b, true)]
    }

    /// Both shapes without their radii, where those are points or segments.
    fn slenders(&self) -> Option<[Slender; 2]> {
        let a = Slender::of(self.shape_a, (&IDENTITY, DVec3::ZERO))?;
        Some([a, Slender::of(self.shape_b, (&self.relative, self.offset))?])
    }

    /// The shape beside a half-space, and its axes and position.
    fn shape_over(&self, plane: &Plane) -> (&'a Shape3, (&Basis3, DVec3)) {
        match plane.is_b {
            true => (self.shape_a, (&IDENTITY, DVec3::ZERO)),
            false => (self.shape_b, (&self.relative, self.offset)),
        }
    }

    pub(crate) fn with_solids<R>(&self, run: impl FnOnce(&Solid, &Solid) -> R) -> R {
        // One by one: a pair of them would be moved, and cores that are built here are large.
        let core_a = self.shape_a.core();
        let core_b = self.shape_b.core();
        let a = Solid::new(&core_a, IDENTITY, DVec3::ZERO, f64::from(self.shape_a.radius()));
        let b = Solid::new(&core_b, self.relative, self.offset, f64::from(self.shape_b.radius()));
        run(&a, &b)
    }

    /// By how much another axis must beat a face of A, in metres. Relative to the smaller shape: what is nothing to a
    /// floor may be the size of a pebble. Never below rounding.
    fn preference(&self) -> f64 {
        self.of_smaller(FACE_PREFERENCE)
    }

    /// How much deeper a corner must be to be kept for its depth alone, in metres.
    fn even_depth(&self) -> f64 {
        self.of_smaller(EVEN_DEPTH)
    }

    /// How near a contact point must be to a vertex or an edge to get its feature id, in metres.
    fn same_place(&self) -> f64 {
        self.of_smaller(SAME_PLACE)
    }

    /// This share of the smaller shape's diameter.
    fn of_smaller(&self, share: f64) -> f64 {
        let smaller = f64::from(self.shape_a.outer_radius().min(self.shape_b.outer_radius()));
        self.precision.share(share, smaller)
    }
}

/// Bounding radius of a core. A half-space has none: only the other shape's vertices enter its pairs.
fn core_size(shape: &Shape3) -> f64 {
    match shape {
        Shape3::HalfSpace(_) => 0.0,
        _ => f64::from(shape.outer_radius()) - f64::from(shape.radius()),
    }
}
