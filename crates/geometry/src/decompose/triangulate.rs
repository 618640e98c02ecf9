//! A simple polygon's constrained Delaunay triangulation, and the proof that it is the polygon.
//!
//! The triangulation is spade's. Whatever it answers is believed only if it passes a check of our own: triangles that
//! all wind counter-clockwise, by an exact test, and whose sides all cancel but for the outline's, cover exactly what
//! the outline winds around, once. So a fault there could be an error here, and never a wrong part.

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
    /// The same side seen from the other part; none on the outline.
    pub(super) twin: Option<usize>,
}

/// Triangles that are the polygon, three halves each in order. The outline must be simple and counter-clockwise.
pub(super) fn triangulated(points: &[Vec2]) -> Result<Vec<Half>, DecomposeError> {
    let triangles = inner_triangles(points).unwrap_or_default();
    checked(points, &triangles).ok_or(DecomposeError::Untriangulated { triangles: triangles.len() })
}

/// Spade's triangles within the outline, each from its lowest vertex, sorted.
///
/// Vertices go in one by one, coarse to fine (0, then the middle, then the quarters, ...), each near one that is already
/// in: n log n in practice. Spade's bulk loading walks a hash set, whose order differs from run to run.
fn inner_triangles(points: &[Vec2]) -> Result<Vec<[usize; 3]>, InsertionError> {
    // Spade refuses magnitudes below 2^-142. A power of two keeps every bit, and every sign of its predicates.
    const SCALE: f64 = (1_u128 << 64) as f64;
    let place = |i: usize| Point2::new(f64::from(points[i].x) * SCALE, f64::from(points[i].y) * SCALE);
    let mut mesh = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut number = Vec::with_capacity(points.len());
    let mut handles = vec![mesh.insert(place(0))?; points.len()];
    number.push(0);
    let mut step = points.len().next_power_of_two();
    while step > 1 {
        step /= 2;
        for i in (step..points.len()).step_by(2 * step) {
            handles[i] = mesh.insert_with_hint(place(i), handles[i - step])?;
            number.push(i);
        }
    }
    for (i, &from) in handles.iter().enumerate() {
        // The plain call panics where constraints cross; here none do.
        mesh.try_add_constraint(from, handles[(i + 1) % handles.len()]);
    }
    let number_of = |vertex: FixedVertexHandle| number.get(vertex.index()).copied().unwrap_or(0);
    let mut triangles: Vec<[usize; 3]> = mesh
        .inner_faces()
        .map(|face| face.vertices().map(|vertex| number_of(vertex.fix())))
        .map(from_lowest)
        // Within the outline, and only there, a counter-clockwise triangle meets the vertices in the outline's order.
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

/// The triangles with their sides paired, if they are the polygon.
fn checked(points: &[Vec2], triangles: &[[usize; 3]]) -> Option<Vec<Half>> {
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
