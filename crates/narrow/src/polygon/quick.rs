//! What can be told of two bodies before they are made ready for a kernel: circles around and inside them, and rectangles.
//!
//! | trick | gain, AMD EPYC, Zen 4 |
//! |---|---|
//! | circles around both | polygons of 64, apart by a broad phase's mistake: 97 ns to 12 |
//! | circles inside both | polygons of 64, deep: 314 ns to 12 |
//! | two rectangles: `rects`, at once | 103 ns to 30 |
//!
//! A stored rotation stretches by its length, which is one up to the rounding of f32: radii are widened, or narrowed, by more
//! than that. What positions and centres lose is bounded by the sum of their coordinates.

use super::outline::Turn;
use super::rects::Rects;
use crate::precision::{IN_PLANE, Precision};
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Shape2, glam::Vec2};

/// By how much a stored rotation may stretch, and more.
const STRETCH: f64 = 4.0 * f32::EPSILON as f64;

/// Two bodies: their shapes, how they are turned, and B's position less A's.
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
            Shape2::Capsule(_) | Shape2::Segment(_) => (shape.center(), shape.outer_radius(), shape.radius()),
            Shape2::HalfPlane(_) | Shape2::Compound(_) => return None,
        };
        Some(Self { center, outer, inner })
    }
}

impl Bodies<'_> {
    /// Whether they overlap, where that is plain to see.
    #[inline]
    pub(crate) fn overlap(&self) -> Option<bool> {
        if let [Shape2::Rect(a), Shape2::Rect(b)] = self.shapes
            && a.radius() + b.radius() == 0.0
        {
            let halves = [a.half_extents(), b.half_extents()].map(Vec2::as_dvec2);
            let size = f64::from(a.outer_radius()) + f64::from(b.outer_radius());
            let reach = size + self.between.abs().element_sum();
            let precision = Precision { size, reach, planarity: 0.0, roundings: IN_PLANE[0] };
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

    /// How far apart they are at least, where circles around them show more than a limit.
    #[inline]
    pub(crate) fn beyond(&self, limit: f64) -> Option<f64> {
        let [a, b] = [Circles::of(self.shapes[0])?, Circles::of(self.shapes[1])?];
        let (between, lost) = self.centers([a.center, b.center]);
        let outer = (f64::from(a.outer) + f64::from(b.outer)) * (1.0 + STRETCH) + lost;
        let reach = limit + outer;
        let squared = between.length_squared();
        (squared > reach * reach).then(|| squared.sqrt() - outer).filter(|&gap| gap > limit)
    }

    /// From A's centre to B's, and more than is lost to rounding by it, its length, and what that is compared with.
    #[inline]
    fn centers(&self, centers: [Vec2; 2]) -> (DVec2, f64) {
        let [a, b] = centers.map(Vec2::as_dvec2);
        let sum = |v: DVec2| v.abs().element_sum();
        let lost = 16.0 * f64::EPSILON * (sum(self.between) + sum(a) + sum(b));
        (self.between + (self.turns[1].turn(b) - self.turns[0].turn(a)), lost)
    }
}
