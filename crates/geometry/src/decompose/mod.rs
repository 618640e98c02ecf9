//! Splits concave outlines into convex parts.
//!
//! ```text
//! reject edges that meet elsewhere than at their common vertex   simple.rs
//! constrained Delaunay triangulation, checked exactly            triangulate.rs
//! drop diagonals, longest first, while both ends stay convex     merge.rs
//! the regions between the remaining diagonals are the parts      here
//! ```

use crate::compound::{Compound2, CompoundError};
use crate::polygon::predicate::{corners, order, orientation};
use crate::polygon::{Polygon, PolygonError};
use crate::pose2::Pose2;
use crate::shape::Shape2;
use crate::tolerance::{MAX_POLYGON_VERTICES, MAX_RADIUS};
use glam::Vec2;
use merge::{Part, merged};
use triangulate::triangulated;

mod error;
mod merge;
mod simple;
#[cfg(test)]
mod tests;
mod triangulate;

pub use error::DecomposeError;

/// Splits a polygon that may be concave into convex ones. The outline is in metres, and may wind either way.
///
/// The parts' vertices are the outline's, bit for bit; their interiors are disjoint, and their union is the polygon
/// that the outline encloses. At most 4096 vertices; vertices on a line with their neighbours are fine. There are at
/// most four times as many parts as the least possible number (Hertel and Mehlhorn, "Fast triangulation of simple
/// polygons", 1983), and usually only a few more than that. The pose of every part is the identity. Every decision is
/// an exact orientation test.
///
/// A part with a bounding radius below [`MIN_RADIUS`](crate::tolerance::MIN_RADIUS) is not a valid shape. If it lies
/// beside a larger part it is left out, and everything lost lies within 2e-6 m of the parts that are kept; otherwise
/// the outline is rejected.
///
/// Cost: n log n in practice: 5 to 20 ms for 4096 vertices, and 50 ms where thousands of long edges lie side by side.
///
/// ```
/// use asunder::{decompose, glam::{DVec2, Vec2}};
/// let angle = [(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)].map(Vec2::from);
/// let parts = decompose(&angle)?;
/// assert_eq!(parts.parts().len(), 2);
/// assert!(parts.contains(DVec2::new(0.5, 2.0)) && !parts.contains(DVec2::new(2.0, 2.0)));
/// # Ok::<(), asunder::DecomposeError>(())
/// ```
///
/// # Errors
/// Edges that cross, touch or overlap, repeated vertices, and every other case of [`DecomposeError`].
pub fn decompose(outline: &[Vec2]) -> Result<Compound2, DecomposeError> {
    check_vertices(outline)?;
    simple::check_simple(outline)?;
    let ring = counter_clockwise(outline);
    let points: Vec<Vec2> = ring.iter().map(|&vertex| outline[vertex]).collect();
    if corners(&points).all(|[before, at, after]| orientation(before, at, after) >= 0.0) {
        return compound(outline, &[Part { vertices: ring, neighbours: Vec::new() }]);
    }
    let mut parts = merged(&points, triangulated(&points)?);
    // From numbers in the ring to numbers in the caller's outline.
    parts.iter_mut().flat_map(|part| &mut part.vertices).for_each(|vertex| *vertex = ring[*vertex]);
    compound(outline, &parts)
}

fn check_vertices(outline: &[Vec2]) -> Result<(), DecomposeError> {
    let count = outline.len();
    if count < 3 {
        return Err(DecomposeError::TooFewVertices { count });
    }
    if count > MAX_POLYGON_VERTICES {
        return Err(DecomposeError::TooManyVertices { count });
    }
    for (vertex, point) in outline.iter().enumerate() {
        if !point.is_finite() {
            return Err(DecomposeError::NotFinite { vertex });
        }
        if point.as_dvec2().length() > f64::from(MAX_RADIUS) {
            return Err(DecomposeError::TooLarge { vertex });
        }
    }
    Ok(())
}

/// The vertices of a simple outline, counter-clockwise, starting with number 0.
fn counter_clockwise(outline: &[Vec2]) -> Vec<usize> {
    // The turn at the least vertex shows how the outline winds, as all of it lies on one side.
    let turn = corners(outline)
        .min_by(|[_, a, _], [_, b, _]| order(*a, *b))
        .map_or(0.0, |[before, least, after]| orientation(before, least, after));
    let mut ring: Vec<usize> = (0..outline.len()).collect();
    if turn < 0.0 {
        ring[1..].reverse();
    }
    ring
}

/// Makes shapes of the parts, without those that are too small.
fn compound(outline: &[Vec2], parts: &[Part]) -> Result<Compound2, DecomposeError> {
    let mut shapes: Vec<Option<Polygon>> = Vec::with_capacity(parts.len());
    let mut largest_refused = 0.0_f32;
    for part in parts {
        let places: Vec<Vec2> = part.vertices.iter().map(|&vertex| outline[vertex]).collect();
        let is_corner = |&[before, at, after]: &[Vec2; 3]| orientation(before, at, after) > 0.0;
        let convex = corners(&places).filter(is_corner).map(|[_, at, _]| at).collect();
        let polygon = Polygon::from_convex(convex, 0.0);
        if let Err(PolygonError::TooSmall { radius }) = polygon {
            largest_refused = largest_refused.max(radius);
        }
        shapes.push(polygon.ok());
    }
    if shapes.iter().all(Option::is_none) {
        return Err(DecomposeError::TooSmall { radius: largest_refused });
    }
    for (part, _) in parts.iter().zip(&shapes).filter(|(_, shape)| shape.is_none()) {
        if part.neighbours.iter().all(|&beside| shapes[beside].is_none()) {
            return Err(DecomposeError::TooFine { vertex: part.vertices[0] });
        }
    }
    let kept = shapes.iter().flatten().map(|polygon| (Pose2::IDENTITY, Shape2::Polygon(polygon.clone())));
    Compound2::new(kept).map_err(|error| {
        // Only a part's size can be wrong: there is a part, at most one for each vertex, and none is a compound.
        let index = if let CompoundError::TooLarge { index } = error { index } else { 0 };
        let kept = parts.iter().zip(&shapes).filter(|(_, shape)| shape.is_some());
        DecomposeError::TooLarge { vertex: kept.map(|(part, _)| part.vertices[0]).nth(index).unwrap_or(0) }
    })
}
