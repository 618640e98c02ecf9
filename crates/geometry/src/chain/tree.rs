//! A binary BVH over the segments of a chain, in their order along it.
//!
//! Consecutive segments are neighbours in space, so no sorting is needed: the tree follows the order along the chain,
//! and a node's number implies which segments are in it. Four segments share a lowest box, so that all boxes together
//! take as much memory as the vertices.

use super::segment_count;
use crate::aabb::{Aabb2, Bounds};
use core::ops::ControlFlow;
use glam::Vec2;

/// Segments of a lowest box.
const LEAF: usize = 4;

/// More levels than two million segments have.
const LEVELS: usize = 32;

#[derive(Debug)]
pub(super) struct Tree {
    /// Lowest first; the last holds one box.
    levels: Box<[Box<[Aabb2]>]>,
    segments: usize,
}

impl Tree {
    pub(super) fn new(vertices: &[Vec2], is_closed: bool) -> Self {
        let segments = segment_count(vertices.len(), is_closed);
        let around = |first: usize| {
            let end = (first + LEAF).min(segments);
            let tail = if end < vertices.len() { vertices.get(end) } else { vertices.first() };
            let inner = vertices.get(first..end).unwrap_or_default();
            inner
                .iter()
                .chain(tail)
                .fold(Aabb2::NOTHING, |known, &vertex| known.union(&Aabb2::new(vertex, vertex)))
        };
        let mut level: Box<[Aabb2]> = (0..segments).step_by(LEAF).map(around).collect();
        let mut levels = Vec::new();
        while level.len() > 1 {
            let above =
                level.chunks(2).map(|pair| pair.iter().fold(Aabb2::NOTHING, |known, next| known.union(next)));
            let above = above.collect();
            levels.push(core::mem::replace(&mut level, above));
        }
        levels.push(level);
        Self { levels: levels.into(), segments }
    }

    /// Segments of a lowest box.
    fn leaf(&self, node: usize) -> core::ops::Range<u32> {
        (node * LEAF) as u32..((node + 1) * LEAF).min(self.segments) as u32
    }

    /// The box around all segments.
    pub(super) fn whole(&self) -> Option<&Aabb2> {
        self.bounds(self.levels.len() - 1, 0)
    }

    fn bounds(&self, level: usize, node: usize) -> Option<&Aabb2> {
        self.levels.get(level)?.get(node)
    }

    pub(super) fn visit_where(
        &self,
        ends: &impl Fn(u32) -> Option<[Vec2; 2]>,
        mut meets: impl FnMut(&Aabb2) -> bool,
        mut visit: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let mut open = Open::new((self.levels.len() - 1, 0));
        while let Some((level, node)) = open.pop() {
            if !self.bounds(level, node).is_some_and(&mut meets) {
                continue;
            }
            if level > 0 {
                // The one pushed last comes first.
                open.push((level - 1, 2 * node + 1));
                open.push((level - 1, 2 * node));
                continue;
            }
            for segment in self.leaf(node) {
                if ends(segment).is_some_and(|ends| meets(&around(ends))) {
                    visit(segment)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    pub(super) fn visit_nearest(
        &self,
        ends: &impl Fn(u32) -> Option<[Vec2; 2]>,
        mut limit: f64,
        mut bound: impl FnMut(&Aabb2) -> f64,
        mut visit: impl FnMut(u32) -> f64,
    ) {
        let top = (self.levels.len() - 1, 0);
        let Some(least) = self.bounds(top.0, top.1).map(&mut bound) else { return };
        let mut open = Open::new((least, top));
        while let Some((least, (level, node))) = open.pop() {
            if least > limit {
                continue;
            }
            if level > 0 {
                let mut child = |node: usize| {
                    self.bounds(level - 1, node).map(|bounds| (bound(bounds), (level - 1, node)))
                };
                let [one, other] = [child(2 * node), child(2 * node + 1)];
                let is_later_first = matches!((one, other), (Some(one), Some(other)) if other.0 < one.0);
                let [first, last] = if is_later_first { [other, one] } else { [one, other] };
                last.into_iter().chain(first).for_each(|child| open.push(child));
                continue;
            }
            for segment in self.leaf(node) {
                let is_beyond = ends(segment).is_none_or(|ends| bound(&around(ends)) > limit);
                if !is_beyond {
                    limit = visit(segment);
                }
            }
        }
    }
}

fn around([from, to]: [Vec2; 2]) -> Aabb2 {
    Aabb2::new(from.min(to), from.max(to))
}

/// A stack of nodes to visit, the next one last: at most one per level, and one more.
struct Open<T> {
    nodes: [Option<T>; LEVELS],
    count: usize,
}

impl<T: Copy> Open<T> {
    fn new(first: T) -> Self {
        let mut nodes = [None; LEVELS];
        nodes[0] = Some(first);
        Self { nodes, count: 1 }
    }

    fn push(&mut self, node: T) {
        if let Some(place) = self.nodes.get_mut(self.count) {
            *place = Some(node);
            self.count += 1;
        }
    }

    fn pop(&mut self) -> Option<T> {
        self.count = self.count.checked_sub(1)?;
        self.nodes.get(self.count).copied().flatten()
    }
}
