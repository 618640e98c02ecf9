//! Exact predicates for points in the plane.

use glam::Vec2;
use robust::{Coord, orient2d};

/// Sign of the turn a -> b -> c: positive to the left. Exact for all f32 that are finite.
pub(crate) fn orientation(a: Vec2, b: Vec2, c: Vec2) -> f64 {
    let coord = |v: Vec2| Coord { x: f64::from(v.x), y: f64::from(v.y) };
    orient2d(coord(a), coord(b), coord(c))
}

pub(crate) fn order(a: Vec2, b: Vec2) -> core::cmp::Ordering {
    // `+ 0.0` turns -0 into +0: they are the same point.
    (a.x + 0.0).total_cmp(&(b.x + 0.0)).then((a.y + 0.0).total_cmp(&(b.y + 0.0)))
}

pub(crate) fn is_before(a: Vec2, b: Vec2) -> bool {
    order(a, b).is_lt()
}

/// Each vertex with its neighbours: (previous, this, next). Number `i` is vertex `i`.
pub(crate) fn corners(outline: &[Vec2]) -> impl Iterator<Item = [Vec2; 3]> + '_ {
    let n = outline.len();
    (0..n).map(move |i| [outline[(i + n - 1) % n], outline[i], outline[(i + 1) % n]])
}

pub(crate) fn first_repeated(points: &[Vec2]) -> Option<(usize, usize)> {
    let mut by_place: Vec<usize> = (0..points.len()).collect();
    by_place.sort_by(|&a, &b| order(points[a], points[b]).then(a.cmp(&b)));
    by_place.windows(2).find(|two| points[two[0]] == points[two[1]]).map(|two| (two[0], two[1]))
}

/// How often the outline changes between going right and left: twice for a simple convex one.
pub(crate) fn direction_changes(outline: &[Vec2]) -> usize {
    corners(outline).filter(|&[a, b, c]| is_before(a, b) != is_before(b, c)).count()
}
