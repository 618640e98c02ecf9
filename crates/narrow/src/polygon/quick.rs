//! Answers about two bodies before they are prepared for a kernel: circles around and inside them, and rectangles.
//!
//! | trick | gain, AMD EPYC, Zen 4 |
//! |---|---|
//! | circles around both | polygons of 64, apart, where the broad phase reported a pair: 97 ns to 12 |
//! | circles inside both | polygons of 64, deep: 314 ns to 12 |
//! | two rectangles go to `rects` at once | 103 ns to 30 |
//!
//! A stored rotation stretches by its length, which is one up to the rounding of f32: radii are widened, or narrowed,
//! by more than that. The rounding of positions and centres is bounded by the sum of their coordinates.

use super::few::{self, Few};
use super::measure::{Measure, Probe, Query};
use super::outline::{FEW_VERTICES, Turn};
use super::rects::{self, Corners, Rects};
use super::sat::{Named, hint_of, named};
use crate::precision::{IN_PLANE, Precision, round_down};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Rect, Shape2, glam::Vec2};

/// More than a stored rotation may stretch by.
const STRETCH: f64 = 4.0 * f32::EPSILON as f64;

/// Two bodies: their shapes, their rotations, and B's position less A's.
#[derive(Clone, Copy)]
pub(crate) struct Bodies<'s> {
    pub(crate) shapes: [&'s Shape2; 2],
    pub(crate) turns: [&'s Turn; 2],
    pub(crate) between: DVec2,
}

/// A circle around a body and one inside it, about one point.
struct Circles {
    center: Vec2,
    outer: f32,
    /// Negative where there is none.
    inner: f32,
}

impl Circles {
    #[inline]
    fn of(shape: &Shape2) -> Option<Self> {
        let (center, outer, inner) = match shape {
            Shape2::Polygon(polygon) => (polygon.center(), polygon.outer_radius(), polygon.inner_radius()),
            Shape2::Rect(rect) => (Vec2::ZERO, rect.outer_radius(), rect.inner_radius()),
            Shape2::Circle(circle) => (Vec2::ZERO, circle.radius(), circle.radius()),
            Shape2::Capsule(_) | Shape2::Segment(_) => {
                let center = shape.center();
                // The middle was rounded: it is beside the segment by no more than twice this.
                let beside = f32::EPSILON * center.abs().element_sum();
                (center, shape.outer_radius(), shape.radius() - beside)
            }
            Shape2::HalfPlane(_) | Shape2::Compound(_) | Shape2::Chain(_) => return None,
        };
        Some(Self { center, outer, inner })
    }
}

impl Bodies<'_> {
    /// Whether they overlap, if circles or rectangles show it.
    #[inline]
    pub(crate) fn overlap(&self) -> Option<bool> {
        if let [Shape2::Rect(a), Shape2::Rect(b)] = self.shapes
            && a.radius() + b.radius() == 0.0
        {
            let halves = [a.half_extents().as_dvec2(), b.half_extents().as_dvec2()];
            let size = f64::from(a.outer_radius()) + f64::from(b.outer_radius());
            let reach = size + self.between.abs().element_sum();
            let precision = Precision { size, reach, planarity: 0.0, roundings: IN_PLANE.of_bodies };
            let (top, doubt) =
                (Rects::new(halves, self.turns, self.between).top(), 2.0 * precision.projection());
            return if top > doubt || top < -doubt { Some(top < 0.0) } else { None };
        }
        let [a, b] = [Circles::of(self.shapes[0])?, Circles::of(self.shapes[1])?];
        let (between, lost) = self.centers([a.center, b.center]);
        let squared = between.length_squared();
        let outer = (f64::from(a.outer) + f64::from(b.outer)) * (1.0 + STRETCH) + lost;
        if squared > outer * outer {
            return Some(false);
        }
        let inner = (f64::from(a.inner) + f64::from(b.inner)) * (1.0 - STRETCH) - lost;
        (inner > 0.0 && squared < inner * inner).then_some(true)
    }

    /// The answer, if it is certain by circles or by axes of few edges: for most pairs it is.
    ///
    /// The offset between them is passed by value, in registers: see `rects`.
    #[inline]
    pub(crate) fn answer(&self, query: &Query) -> Option<Probe> {
        if let [Shape2::Rect(a), Shape2::Rect(b)] = self.shapes {
            return of_rects([a, b], self.turns, self.between, query);
        }
        of_others(self.shapes, self.turns, self.between, query)
    }

    fn few<const N: usize>(&self, cores: [(&[Vec2], &[DVec2]); 2], query: &Query) -> Option<Probe> {
        let measure = Measure::new(self.shapes, self.between, None);
        let (radius_a, radius_b) = (self.shapes[0].radius().into(), self.shapes[1].radius().into());
        let a = Few::<N>::new(cores[0], self.turns[0], DVec2::ZERO, radius_a);
        let b = Few::<N>::new(cores[1], self.turns[1], self.between, radius_b);
        let kept = named([cores[0].1.len(), cores[1].1.len()], query.hint).and_then(Named::edge);
        let outcome = few::separating_axes([&a, &b], kept, &measure.wanted(query, self.between));
        measure.at_once([&a, &b], query, &outcome)
    }

    /// A lower bound on how far they are apart, if circles around them show more than a limit.
    #[inline]
    fn beyond(&self, limit: f64) -> Option<f64> {
        let [a, b] = [Circles::of(self.shapes[0])?, Circles::of(self.shapes[1])?];
        let (between, lost) = self.centers([a.center, b.center]);
        let outer = (f64::from(a.outer) + f64::from(b.outer)) * (1.0 + STRETCH) + lost;
        let reach = limit + outer;
        let squared = between.length_squared();
        (squared > reach * reach).then(|| squared.sqrt() - outer).filter(|&gap| gap > limit)
    }

    /// From A's centre to B's; and a bound on what it, its length, and what that is compared with lose to rounding.
    #[inline]
    fn centers(&self, centers: [Vec2; 2]) -> (DVec2, f64) {
        let (a, b) = (centers[0].as_dvec2(), centers[1].as_dvec2());
        let sum = |v: DVec2| v.abs().element_sum();
        let lost = 16.0 * f64::EPSILON * (sum(self.between) + sum(a) + sum(b));
        (self.between + (self.turns[1].turn(b) - self.turns[0].turn(a)), lost)
    }
}

/// The answer for two rectangles, by their four axes.
fn of_rects([a, b]: [&Rect; 2], turns: [&Turn; 2], between: DVec2, query: &Query) -> Option<Probe> {
    let measure = Measure::of_rects([a, b], between);
    let wanted = measure.wanted(query, between);
    let halves = [a.half_extents().as_dvec2(), b.half_extents().as_dvec2()];
    let kept = named([4, 4], query.hint).and_then(Named::edge);
    let axes = match rects::best_axes(halves, turns, between, (kept, &wanted)) {
        Ok(axes) => axes,
        Err((separation, of)) => return Some(measure.beyond(separation, hint_of(of))),
    };
    let corners_a = Corners::new(halves[0], turns[0], DVec2::ZERO, f64::from(a.radius()));
    let corners_b = Corners::new(halves[1], turns[1], between, f64::from(b.radius()));
    measure.within([&corners_a, &corners_b], query, &axes)
}

/// The answer for other shapes: by circles first, and then by all axes of few edges.
fn of_others(shapes: [&Shape2; 2], turns: [&Turn; 2], between: DVec2, query: &Query) -> Option<Probe> {
    let bodies = Bodies { shapes, turns, between };
    if let Some(gap) = bodies.beyond(query.limit) {
        return Some(Probe::Beyond(round_down(gap), query.hint));
    }
    let (core_a, core_b) = (shapes[0].core(), shapes[1].core());
    let cores = [(core_a.vertices(), core_a.normals()), (core_b.vertices(), core_b.normals())];
    let (a, b) = (cores[0].0.len(), cores[1].0.len());
    // A circle has no edges, a half-plane and a compound no vertices.
    if a.min(b) == 0 || a + b == 2 || a.max(b) > FEW_VERTICES {
        return None;
    }
    if a.max(b) <= 8 { bodies.few::<8>(cores, query) } else { bodies.few::<FEW_VERTICES>(cores, query) }
}
