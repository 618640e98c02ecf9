//! The point of a triangle that is nearest to a given point.

use asunder_geometry::glam::DVec3;

/// Of the edges that a point lies beyond, the one nearest to it: its number, where on it, from 0 to 1, and that point.
/// `None` for a point that is over the triangle.
///
/// The nearest point lies on an edge that the point is beyond: a point that is beyond neither edge at a corner is no
/// nearer to that corner than to the rest of the triangle. An edge is a corner and the way to the next; `inwards` turns
/// such a way into the triangle.
#[inline(always)]
pub(crate) fn nearest_on_edges(
    edge: impl Fn(usize) -> (DVec3, DVec3),
    inwards: impl Fn(DVec3) -> DVec3,
    point: DVec3,
) -> Option<(usize, f64, DVec3)> {
    let mut best: Option<(f64, (usize, f64, DVec3))> = None;
    for number in 0..3 {
        let (from, along) = edge(number);
        let from_start = point - from;
        if inwards(along).dot(from_start) >= 0.0 {
            continue;
        }
        let place = (from_start.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let at = match place {
            0.0 => from,
            1.0 => edge((number + 1) % 3).0,
            _ => from + along * place,
        };
        let squared = (point - at).length_squared();
        if best.is_none_or(|(least, _)| squared < least) {
            best = Some((squared, (number, place, at)));
        }
    }
    best.map(|(_, found)| found)
}
