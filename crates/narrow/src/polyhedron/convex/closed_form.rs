//! Shapes whose distance has a closed form: half-spaces, balls and cuboids, and points and segments among themselves.

use super::{Convex, Evidence, Near, Probe};
use crate::answer::{Tier, Verdict};
use crate::exact::{self, Corner};
use crate::feature::{Feature, FeatureId, Hint};
use crate::polyhedron::cuboids::ball::Nearest;
use crate::polyhedron::half_space::Plane;
use crate::polyhedron::manifold::{Point, Touch};
use crate::polyhedron::slender::{self, Slender};
use crate::precision::{at_least, signed};
use arrayvec::ArrayVec;
use asunder_geometry::Shape3;
use asunder_geometry::glam::DVec3;

/// Two shapes that are measured in closed form, as their kernel takes them.
pub(super) enum Simple {
    HalfSpaces(Plane, Plane),
    HalfSpace(Plane),
    Ball(Ball),
    Slender([Slender; 2]),
}

/// The result of a kernel in closed form.
pub(super) struct ClosedForm {
    pub(super) separation: f64,
    /// A lower bound on it.
    at_least: f64,
    /// Unit axis from A to B.
    normal: DVec3,
    /// Closest points on the surfaces; they mean nothing in overlap.
    closest: [DVec3; 2],
    evidence: Evidence,
    /// The corners from which exact arithmetic may start.
    corners: ArrayVec<Corner, 3>,
}

/// A ball's centre and a cuboid, in the frame of the pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    nearest: Nearest,
    center: DVec3,
    /// Whether the cuboid is B.
    is_b: bool,
}

impl Ball {
    /// Unit axis from A to B.
    pub(super) fn axis(&self) -> DVec3 {
        if self.is_b { -self.nearest.normal } else { self.nearest.normal }
    }

    /// The nearest points of A's core and B's.
    pub(super) fn points(&self) -> [DVec3; 2] {
        let (center, on_cuboid) = (self.center, self.nearest.on_cuboid);
        if self.is_b { [center, on_cuboid] } else { [on_cuboid, center] }
    }

    /// The contact point, at this separation.
    pub(super) fn touch(&self, separation: f64, [on_a, on_b]: [DVec3; 2]) -> Touch {
        let point = Point { separation, on_a, on_b, feature: self.feature() };
        Touch { normal: self.axis(), points: core::iter::once(point).collect(), of: None }
    }

    fn feature(&self) -> FeatureId {
        let (of_cuboid, of_ball) = (self.nearest.feature(), Feature::Vertex(0));
        if self.is_b { FeatureId::new(of_ball, of_cuboid) } else { FeatureId::new(of_cuboid, of_ball) }
    }
}

impl Convex<'_> {
    /// How the pair is measured in closed form; `None` for two solids.
    #[inline]
    pub(super) fn simple(&self) -> Option<Simple> {
        if let Some(ball) = self.ball() {
            return Some(Simple::Ball(ball));
        }
        match self.planes() {
            [Some(a), Some(b)] => Some(Simple::HalfSpaces(a, b)),
            [Some(plane), None] | [None, Some(plane)] => Some(Simple::HalfSpace(plane)),
            [None, None] => self.slenders().map(Simple::Slender),
        }
    }

    /// The result of the pair's kernel in closed form; `None` for two solids.
    ///
    /// Those are told by their kinds first, without a call: 2 % of an overlap test of two hulls (AMD EPYC, Zen 5,
    /// 2026-12-01).
    #[inline]
    pub(super) fn closed_form(&self) -> Option<ClosedForm> {
        let is_solid = |shape: &Shape3| match shape {
            Shape3::Cuboid(_) | Shape3::Triangle(_) => true,
            Shape3::Hull(hull) => hull.vertices().len() > 2,
            _ => false,
        };
        if is_solid(self.shape_a) && is_solid(self.shape_b) { None } else { self.closed_form_of_simple() }
    }

    #[inline(never)]
    fn closed_form_of_simple(&self) -> Option<ClosedForm> {
        self.simple().map(|simple| match simple {
            Simple::HalfSpaces(a, b) => self.closed_form_of_half_spaces(a, b),
            Simple::HalfSpace(plane) => self.closed_form_of_half_space(plane),
            Simple::Ball(ball) => self.closed_form_of_ball(ball),
            Simple::Slender([a, b]) => self.closed_form_of_slender(&a, &b),
        })
    }

    fn closed_form_of_half_spaces(&self, a: Plane, b: Plane) -> ClosedForm {
        let separation = a.separation_from(&b, || exact::are_opposed3([&self.sites[0], &self.sites[1]]));
        ClosedForm {
            separation,
            at_least: separation,
            normal: a.axis(),
            closest: a.points_with(&b),
            evidence: Evidence::HalfSpaces(a, b),
            corners: ArrayVec::new(),
        }
    }

    fn closed_form_of_half_space(&self, plane: Plane) -> ClosedForm {
        let (shape, frame) = self.shape_over(&plane);
        let vertex = plane.lowest_of(shape, frame);
        let height = plane.height(vertex);
        let separation = height - self.radii;
        let on_shape = vertex - plane.normal * self.radii;
        let on_plane = vertex - plane.normal * height;
        let closest = if plane.is_b { [on_shape, on_plane] } else { [on_plane, on_shape] };
        let (normal, evidence, corners) = (plane.axis(), Evidence::HalfSpace(plane), ArrayVec::new());
        ClosedForm { separation, at_least: separation, normal, closest, evidence, corners }
    }

    fn closed_form_of_slender(&self, a: &Slender, b: &Slender) -> ClosedForm {
        let nearest = slender::nearest(a, b, self.precision.projection());
        ClosedForm {
            separation: nearest.distance - self.radii,
            at_least: nearest.at_least - self.radii,
            normal: nearest.normal,
            closest: self.on_surfaces([nearest.on_a, nearest.on_b], nearest.normal),
            evidence: Evidence::Slender(nearest),
            corners: ArrayVec::new(),
        }
    }

    /// A sphere's centre and a cuboid, if that is what they are, in the frame of the pair.
    #[inline]
    fn ball(&self) -> Option<Ball> {
        match (self.shape_a, self.shape_b) {
            (Shape3::Cuboid(a), Shape3::Sphere(_)) => {
                let nearest = Nearest::of(a.half_extents().as_dvec3(), self.offset);
                Some(Ball { nearest, center: self.offset, is_b: false })
            }
            (Shape3::Sphere(_), Shape3::Cuboid(b)) => {
                let center = self.relative.turn_back(-self.offset);
                let mut nearest = Nearest::of(b.half_extents().as_dvec3(), center);
                nearest.on_cuboid = self.offset + self.relative.turn(nearest.on_cuboid);
                nearest.normal = self.relative.turn(nearest.normal);
                Some(Ball { nearest, center: DVec3::ZERO, is_b: true })
            }
            _ => None,
        }
    }

    fn closed_form_of_ball(&self, ball: Ball) -> ClosedForm {
        let Ball { nearest, is_b, .. } = ball;
        let separation = nearest.separation - self.radii;
        ClosedForm {
            separation,
            at_least: separation,
            normal: ball.axis(),
            closest: self.on_surfaces(ball.points(), ball.axis()),
            corners: nearest.corners().into_iter().map(|of| if is_b { [0, of] } else { [of, 0] }).collect(),
            evidence: Evidence::Ball(ball),
        }
    }

    /// Whether the shapes overlap, given the two bounds of a closed-form kernel.
    pub(super) fn closed_form_verdict(&self, result: &ClosedForm) -> Verdict {
        let doubt = 2.0 * self.precision.projection();
        if result.at_least > doubt || result.separation < -doubt {
            return Verdict { overlapping: result.separation < 0.0, tier: Tier::Bound };
        }
        self.exactly(&result.corners)
    }

    /// The answer of [`Convex::probe`] from a closed-form kernel's result.
    pub(super) fn probe_closed_form(&self, result: ClosedForm, limit: f64) -> Probe {
        let precision = self.precision;
        if result.at_least > limit + precision.projection() {
            return Probe::Beyond(at_least(result.at_least, &precision), Hint::NONE);
        }
        let verdict = self.closed_form_verdict(&result);
        let ClosedForm { separation, at_least: bound, normal, closest, evidence, .. } = result;
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
}
