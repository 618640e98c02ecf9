//! Joins triangles into convex parts.
//!
//! Hertel and Mehlhorn, "Fast triangulation of simple polygons" (1983): a diagonal can be dropped if both of its ends
//! stay convex without it. If that is impossible once, it stays so, since parts only grow: one pass is enough. At most
//! two diagonals remain for each reflex vertex of the outline, which gives the factor of four.

use super::triangulate::Half;
use crate::polygon::predicate::orientation;
use glam::Vec2;

/// A convex part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// Its vertices, counter-clockwise, the lowest number first. Some may lie on a line with their neighbours.
    pub(super) vertices: Vec<usize>,
    /// The parts that it shares a diagonal with.
    pub(super) neighbours: Vec<usize>,
}

/// Joins triangles across their diagonals, the longest first, and returns the parts sorted by their vertices.
pub(super) fn merged(points: &[Vec2], mut halves: Vec<Half>) -> Vec<Part> {
    let mut diagonals: Vec<(f64, usize, usize)> = Vec::new();
    for (index, half) in halves.iter().enumerate() {
        if let Some(twin) = half.twin.filter(|&twin| index < twin) {
            let length = points[half.from].as_dvec2().distance_squared(points[halves[twin].from].as_dvec2());
            diagonals.push((length, index, twin));
        }
    }
    // Long diagonals bound slivers. Ties go to the lower triangle, so that the result is unique.
    diagonals.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut is_side = vec![true; halves.len()];
    for (_, one, other) in diagonals {
        if stays_convex(points, &halves, one, other) && stays_convex(points, &halves, other, one) {
            is_side[one] = false;
            is_side[other] = false;
            unlink(&mut halves, one, other);
            unlink(&mut halves, other, one);
        }
    }
    parts(&halves, is_side)
}

/// Whether the part at the start of a diagonal's half is convex there without the diagonal.
fn stays_convex(points: &[Vec2], halves: &[Half], half: usize, twin: usize) -> bool {
    let before = halves[halves[half].before].from;
    let after = halves[halves[halves[twin].next].next].from;
    orientation(points[before], points[halves[half].from], points[after]) >= 0.0
}

/// Links the sides around the start of a half past it.
fn unlink(halves: &mut [Half], half: usize, twin: usize) {
    let (before, after) = (halves[half].before, halves[twin].next);
    halves[before].next = after;
    halves[after].before = before;
}

/// Reads the parts off the remaining sides.
fn parts(halves: &[Half], mut is_open: Vec<bool>) -> Vec<Part> {
    let mut loops: Vec<Vec<usize>> = Vec::new();
    for start in 0..halves.len() {
        let mut sides = Vec::new();
        let mut side = start;
        while is_open[side] {
            is_open[side] = false;
            sides.push(side);
            side = halves[side].next;
        }
        if !sides.is_empty() {
            let lowest = (0..sides.len()).min_by_key(|&i| halves[sides[i]].from).unwrap_or(0);
            sides.rotate_left(lowest);
            loops.push(sides);
        }
    }
    let vertices = |sides: &[usize]| sides.iter().map(|&side| halves[side].from).collect::<Vec<usize>>();
    loops.sort_by_cached_key(|sides| vertices(sides));
    let mut part_of = vec![0; halves.len()];
    for (part, sides) in loops.iter().enumerate() {
        sides.iter().for_each(|&side| part_of[side] = part);
    }
    let beside = |sides: &[usize]| {
        sides.iter().filter_map(|&side| halves[side].twin).map(|twin| part_of[twin]).collect::<Vec<usize>>()
    };
    loops.iter().map(|sides| Part { vertices: vertices(sides), neighbours: beside(sides) }).collect()
}
