//! The constrained Delaunay triangulation of a simple polygon, with a proof that it covers the polygon.
//!
//! The triangulation is spade's. Its result must pass a check of our own: triangles that all wind counter-clockwise, by
//! an exact test, and whose sides all cancel except the outline's, cover exactly what the outline winds around, once.
//! So a bug there could cause an error here, but never a wrong part.

use super::error::DecomposeError;
use crate::polygon::predicate::orientation;
use glam::Vec2;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, InsertionError, Point2, Triangulation};

/// One side of a triangle, and later of a part, which lies to its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Half {
    /// The vertex that it leaves.
    pub(super) from: usize,
    /// The next one around its part.
    pub(super) next: usize,
    /// The one before it around its part.
    pub(super) before: usize,
    /// The same side of the other part; none on the outline.
    pub(super) twin: Option<usize>,
}

/// Triangles that make up the polygon, three halves each, in order. The outline must be simple and counter-clockwise.
pub(super) fn triangulated(points: &[Vec2]) -> Result<Vec<Half>, DecomposeError> {
    let triangles = inner_triangles(points).unwrap_or_default();
    checked(points, &triangles).ok_or(DecomposeError::Untriangulated { triangles: triangles.len() })
}

/// Spade's triangles within the outline, each from its lowest vertex, sorted.
///
/// Vertices are inserted one by one, each with the edge that leads to it: n log n in practice. Inserting edges after
/// all vertices takes 20 times as long if they are long and close together; and spade's bulk loading iterates over a
/// hash set, whose order differs from run to run.
fn inner_triangles(points: &[Vec2]) -> Result<Vec<[usize; 3]>, InsertionError> {
    // Spade rejects magnitudes below 2^-142. A power of two keeps every bit, and the sign of every predicate.
    const SCALE: f64 = (1_u128 << 64) as f64;
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(points.len());
    for point in points {
        let place = Point2::new(f64::from(point.x) * SCALE, f64::from(point.y) * SCALE);
        let handle = match handles.last() {
            Some(&last) => mesh.insert_with_hint(place, last)?,
            None => mesh.insert(place)?,
        };
        // The plain call would panic if constraints crossed; here none do.
        handles.last().map(|&last| mesh.try_add_constraint(last, handle));
        handles.push(handle);
    }
    if let [first, .., last] = handles[..] {
        mesh.try_add_constraint(last, first);
    }
    // Vertices are numbered in the order of insertion.
    let mut triangles: Vec<[usize; 3]> = mesh
        .inner_faces()
        .map(|face| from_lowest(face.vertices().map(|vertex| vertex.fix().index())))
        // Within the outline, and only there, a counter-clockwise triangle has its vertices in the outline's order.
        .filter(|[a, b, c]| a < b && b < c)
        .collect();
    triangles.sort_unstable();
    Ok(triangles)
}

fn from_lowest([a, b, c]: [usize; 3]) -> [usize; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// The triangles with their sides paired, if they make up the polygon.
pub(super) fn checked(points: &[Vec2], triangles: &[[usize; 3]]) -> Option<Vec<Half>> {
    let is_left = |&[a, b, c]: &[usize; 3]| orientation(points[a], points[b], points[c]) > 0.0;
    if triangles.is_empty() || !triangles.iter().all(is_left) {
        return None;
    }
    let mut halves: Vec<Half> = Vec::with_capacity(3 * triangles.len());
    for triangle in triangles {
        let first = halves.len();
        for (corner, &from) in triangle.iter().enumerate() {
            let (next, before) = (first + (corner + 1) % 3, first + (corner + 2) % 3);
            halves.push(Half { from, next, before, twin: None });
        }
    }
    let ends = |half: &Half| (half.from, halves[half.next].from);
    let mut by_ends: Vec<((usize, usize), usize)> =
        halves.iter().enumerate().map(|(index, half)| (ends(half), index)).collect();
    by_ends.sort_unstable();
    if by_ends.windows(2).any(|two| two[0].0 == two[1].0) {
        return None;
    }
    for &((from, to), index) in &by_ends {
        match by_ends.binary_search_by_key(&(to, from), |&(ends, _)| ends) {
            Ok(found) => halves[index].twin = Some(by_ends[found].1),
            Err(_) if to == (from + 1) % points.len() => {}
            Err(_) => return None,
        }
    }
    Some(halves)
}
