//! Shapes in the plane; where a constructor rejects one, a plain shape takes its place.

use crate::pairs;
use crate::random::Random;
use asunder_geometry::{Capsule2, Circle, Polygon, Rect, Segment2, Shape2};
use core::f64::consts::TAU;
use glam::{DVec2, Vec2};

/// The shape that replaces a rejected one.
pub(super) fn plain() -> Shape2 {
    pairs::rect(Vec2::splat(0.5))
}

pub(super) fn rect(half_extents: DVec2) -> Shape2 {
    Rect::from_half_extents(half_extents.as_vec2()).map_or_else(|_| plain(), Shape2::from)
}

pub(super) fn polygon(points: &[Vec2]) -> Shape2 {
    Polygon::hull_of(points).map_or_else(|_| plain(), Shape2::from)
}

pub(super) fn circle(radius: f64) -> Shape2 {
    Circle::new(radius as f32).map_or_else(|_| plain(), Shape2::from)
}

pub(super) fn capsule(from: DVec2, to: DVec2, radius: f64) -> Shape2 {
    Capsule2::new(from.as_vec2(), to.as_vec2(), radius as f32).map_or_else(|_| plain(), Shape2::from)
}

pub(super) fn segment(from: DVec2, to: DVec2) -> Shape2 {
    Segment2::new(from.as_vec2(), to.as_vec2()).map_or_else(|_| plain(), Shape2::from)
}

/// The same shape, rounded: grown by a radius. A shape that cannot be rounded stays as it is.
pub(super) fn rounded(shape: Shape2, radius: f64) -> Shape2 {
    let grown = match &shape {
        Shape2::Rect(rect) => rect.rounded(radius as f32).ok().map(Shape2::from),
        Shape2::Polygon(polygon) => polygon.clone().rounded(radius as f32).ok().map(Shape2::from),
        _ => None,
    };
    grown.unwrap_or(shape)
}

pub(super) fn half_extents(random: &mut Random) -> DVec2 {
    DVec2::new(random.range(0.3, 0.6), random.range(0.3, 0.6)).as_vec2().as_dvec2()
}

/// The hull of so many points around an ellipse about `width` metres wide, at equal angles or jittered by a share of
/// their spacing.
pub(super) fn ring(count: usize, width: f64, random: &mut Random) -> Shape2 {
    let half = half_extents(random) * width;
    let jitter = if random.unit() < 0.5 { 0.0 } else { 0.8 };
    let points: Vec<Vec2> = (0..count.max(3))
        .map(|i| {
            let angle = TAU * (i as f64 + jitter * random.range(-0.5, 0.5)) / count.max(3) as f64;
            (DVec2::new(libm::cos(angle), libm::sin(angle)) * half).as_vec2()
        })
        .collect();
    polygon(&points)
}

/// A rectangle or a polygon about `width` metres wide.
pub(super) fn outline(width: f64, random: &mut Random) -> Shape2 {
    if random.unit() < 0.4 {
        return rect(half_extents(random) * width);
    }
    let count = [3, 4, 5, 6, 8, 16, 64][random.below(7)];
    ring(count, width, random)
}

/// Any bounded convex shape about `width` metres wide, round ones and segments included.
pub(super) fn anything(width: f64, random: &mut Random) -> Shape2 {
    let mut point = || DVec2::new(random.range(-0.5, 0.5), random.range(-0.5, 0.5)) * width;
    let (from, to) = (point(), point());
    match random.below(8) {
        0 => circle(random.range(0.2, 0.6) * width),
        1 => capsule(from, to, random.range(0.1, 0.4) * width),
        2 => segment(from, to),
        3 => {
            let outline = outline(width, random);
            rounded(outline, random.range(0.01, 0.3) * width)
        }
        _ => outline(width, random),
    }
}
