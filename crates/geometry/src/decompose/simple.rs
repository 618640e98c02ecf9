//! Checks that an outline is simple: edges meet only where one ends and the next begins.
//!
//! ```text
//! for each vertex, from left to right, and from below if two have the same x:
//!     in the list of edges that the sweep line crosses, from below, find those through the vertex
//!     if any of these does not end there, the vertex lies on an edge
//!     replace them by the edges that begin there
//!     test the pairs that have become neighbours in the list
//! ```
//!
//! Shamos and Hoey, "Geometric intersection problems" (1976). Edges that meet become neighbours in the list before the
//! sweep line reaches the point where they meet, and the first such pair ends the sweep: up to there the list is in
//! order. All comparisons are of a vertex with an edge, and exact.

use super::error::DecomposeError;
use crate::polygon::predicate::{is_before, order, orientation};
use glam::Vec2;

/// Rejects an outline whose edges meet elsewhere than at their common vertices. The vertices must be finite.
pub(super) fn check_simple(outline: &[Vec2]) -> Result<(), DecomposeError> {
    let count = outline.len();
    let mut by_place: Vec<usize> = (0..count).collect();
    by_place.sort_by(|&a, &b| order(outline[a], outline[b]).then(a.cmp(&b)));
    if let Some(two) = by_place.windows(2).find(|two| outline[two[0]] == outline[two[1]]) {
        return Err(DecomposeError::Repeated { first: two[0], second: two[1] });
    }
    let edges: Vec<Edge> = (0..count).map(|index| Edge::new(outline, index)).collect();
    let mut crossed: Vec<usize> = Vec::new();
    for vertex in by_place {
        let at = outline[vertex];
        let start = crossed.partition_point(|&edge| edges[edge].side(at) > 0.0);
        let through = crossed[start..].iter().take_while(|&&edge| edges[edge].side(at) == 0.0).count();
        let own = [(vertex + count - 1) % count, vertex];
        if let Some(&edge) = crossed[start..start + through].iter().find(|edge| !own.contains(edge)) {
            return Err(touching(&edges, vertex, edge));
        }
        let mut beginning = own.to_vec();
        beginning.retain(|&edge| edges[edge].left == at);
        if let [one, other] = beginning[..]
            && edges[one].side(edges[other].right) < 0.0
        {
            beginning.swap(0, 1);
        }
        let last = start + beginning.len();
        crossed.splice(start..start + through, beginning);
        for upper in start.max(1)..crossed.len().min(last + 1) {
            check_pair(&edges, crossed[upper - 1], crossed[upper])?;
        }
    }
    Ok(())
}

struct Edge {
    from: Vec2,
    to: Vec2,
    left: Vec2,
    right: Vec2,
}

impl Edge {
    fn new(outline: &[Vec2], index: usize) -> Self {
        let (from, to) = (outline[index], outline[(index + 1) % outline.len()]);
        let (left, right) = if is_before(from, to) { (from, to) } else { (to, from) };
        Self { from, to, left, right }
    }

    /// Positive for a point above the edge's line.
    fn side(&self, point: Vec2) -> f64 {
        orientation(self.left, self.right, point)
    }
}

/// Rejects two edges that share more than the common vertex of neighbours.
fn check_pair(edges: &[Edge], one: usize, other: usize) -> Result<(), DecomposeError> {
    let (first, second) = (one.min(other), one.max(other));
    let (e, f) = (&edges[first], &edges[second]);
    let next = |edge: usize| (edge + 1) % edges.len();
    if let Some(error) = overlap(edges, first, second) {
        return Err(error);
    }
    if next(first) == second || next(second) == first {
        return Ok(());
    }
    let apart = |e: &Edge, f: &Edge| {
        let [from, to] = [f.from, f.to].map(|point| e.side(point));
        from > 0.0 && to > 0.0 || from < 0.0 && to < 0.0 || from == 0.0 && to == 0.0
    };
    if apart(e, f) || apart(f, e) {
        return Ok(());
    }
    // They meet: at an end of one that is on the other's line, if there is one.
    Err(if e.side(f.from) == 0.0 {
        touching(edges, second, first)
    } else if e.side(f.to) == 0.0 {
        touching(edges, next(second), first)
    } else if f.side(e.from) == 0.0 {
        touching(edges, first, second)
    } else if f.side(e.to) == 0.0 {
        touching(edges, next(first), second)
    } else {
        DecomposeError::Crossing { first, second }
    })
}

/// The error of a vertex on an edge, or of an overlap with one of the vertex's own edges.
fn touching(edges: &[Edge], vertex: usize, edge: usize) -> DecomposeError {
    let own = [(vertex + edges.len() - 1) % edges.len(), vertex];
    let overlapping =
        own.into_iter().filter(|&other| other != edge).find_map(|other| overlap(edges, edge, other));
    overlapping.unwrap_or(DecomposeError::Touching { vertex, edge })
}

/// The error of two edges on one line. These overlap, as both are in the list at once, or one ends within the other.
fn overlap(edges: &[Edge], one: usize, other: usize) -> Option<DecomposeError> {
    let (e, f) = (&edges[one], &edges[other]);
    let on_one_line = e.side(f.from) == 0.0 && e.side(f.to) == 0.0;
    on_one_line.then_some(DecomposeError::Overlapping { first: one.min(other), second: one.max(other) })
}
