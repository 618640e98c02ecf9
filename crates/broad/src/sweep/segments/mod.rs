//! A sweep of bounded cost, by segment trees: all pairs of overlapping boxes in O(n log^3 n + pairs), however they lie.
//!
//! Two boxes overlap on an axis where the lower end of one lies in the interval of the other. So every box plays two
//! roles: a *span*, its interval on the current axis, and a *point*, its lower end there. The question is which points
//! lie in which spans, and which of these pairs overlap on the remaining axes.
//!
//! ```text
//! given spans, points, and a stretch of the axis that contains all points:
//!   few spans or few points: compare all, eight at a time                               few
//!   spans that cover the stretch contain every point: both go on to the next axis, and
//!     once more with roles swapped, as either may have the lower end there; on the
//!     last axis, sort and sweep both instead
//!   cut the points in halves; recurse into each half with the spans that reach it but
//!     do not cover the whole stretch
//! ```
//! At each depth a span is passed on to at most two stretches, those with its ends. So a depth costs as much as there
//! are spans and points, and each axis has log n depths. That is a segment tree, no node of which is ever stored:
//! Zomorodian & Edelsbrunner, "Fast software for box intersections" (2000).
//!
//! 1. Equal lower ends are ordered by the place of the box, so there are no ties: of two boxes exactly one begins
//!    first, a cut gives halves even where all boxes are the same, and touching or unbounded boxes are no special case.
//! 2. Sets are partitioned in place, never copied: the only memory is two copies of the boxes (64 bytes per box).
//! 3. A cut by a sample that leaves less than a quarter on one side is replaced by the exact median: a path, and so the
//!    stack, is at most 2.5 log2 n deep per axis.
//! 4. On the last axis a sort and a sweep replace the two passes with roles swapped: a third less in all (needles,
//!    100,000).
//!
//! Tried (AMD EPYC, Zen 4, 2026-11-22): comparing from 32 boxes down in place of 64, 1.1 to 1.4 times as long; limiting
//! spans and points that go on to each other's bounds, no change; bounds as integers, 1.3 to 1.8 times as long, as the
//! kernel of the index cannot be used for them.

mod few;

use crate::index::node::{Node, Sides, WIDTH};
use crate::sweep::trial::{Way, note, way};
use asunder_geometry::Bounds;
use core::cmp::Ordering;
use core::ops::ControlFlow;
use few::{FEW, Lanes};

/// A box in either role, and its place in the caller's list. 32 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Item {
    sides: Sides,
    place: u32,
}

/// A lower end, and the place of its box as a tie-breaker: no two keys are equal.
pub(super) type Key = (f32, u32);

impl Item {
    /// `None` if the box is empty.
    #[inline(always)]
    pub(super) fn new<B: Bounds>(bounds: &B, place: u32) -> Option<Self> {
        // Turns -0 into 0, so that `total_cmp` and `<` agree.
        let ([a, b, c], [d, e, f]) = bounds.corners();
        let sides = [a + 0.0, b + 0.0, c + 0.0, d + 0.0, e + 0.0, f + 0.0];
        bounds.is_valid().then_some(Self { sides, place })
    }

    #[inline(always)]
    const fn low(&self, axis: usize) -> f32 {
        self.sides[axis]
    }

    #[inline(always)]
    const fn high(&self, axis: usize) -> f32 {
        self.sides[axis + 3]
    }

    #[inline(always)]
    pub(super) const fn key(&self, axis: usize) -> Key {
        (self.low(axis), self.place)
    }

    #[inline(always)]
    fn begins_before(&self, axis: usize, key: Key) -> bool {
        (self.low(axis) < key.0) | ((self.low(axis) == key.0) & (self.place < key.1))
    }
}

pub(super) fn in_order(one: &Key, other: &Key) -> Ordering {
    one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
}

/// The axes in the order in which a walk takes them, the sweep axis of the columns first, as boxes are short on it; and
/// how many there are: in the plane two.
pub(super) fn axes_from<B: Bounds>(sweep: usize) -> ([usize; 3], usize) {
    let axes = [0, 1, 2].map(|offset| (sweep + offset) % B::AXES.max(1));
    (axes, B::AXES.min(3))
}

/// Cost per box of finding all pairs of so many boxes by segments, in candidates that a sweep of columns compares in
/// the same time. It is the worst measured (needles; cubes of all sizes take a third of it).
pub(super) fn worth(boxes: usize) -> usize {
    if way() == Way::Columns {
        return usize::MAX >> (usize::BITS / 2);
    }
    let depth = boxes.max(2).ilog2() as usize;
    CANDIDATES_A_NODE * depth * depth
}

/// See [`worth`].
const CANDIDATES_A_NODE: usize = 12;

/// Scratch memory: the boxes of a sweep in both roles.
#[derive(Debug, Default)]
pub(super) struct Segments {
    spans: Vec<Item>,
    points: Vec<Item>,
}

impl Segments {
    pub(super) fn bytes(&self) -> usize {
        (self.spans.capacity() + self.points.capacity()) * size_of::<Item>()
    }

    /// Hands over the places of every two boxes that overlap, each pair once, until told to stop. A pair counts only if
    /// the box that begins later on the first axis begins in the slab. Axes are taken in the given order; the first
    /// should be one on which boxes are short.
    pub(super) fn sweep(
        &mut self,
        items: impl Iterator<Item = Item>,
        (axes, slab): (&[usize], Slab),
        visit: &mut impl FnMut(u32, u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let Self { spans, points } = self;
        spans.clear();
        points.clear();
        let first = axes.first().copied().unwrap_or_default();
        for item in items.filter(|item| item.begins_before(first, slab.end)) {
            if item.high(first) >= slab.start.0 {
                spans.push(item);
            }
            if !item.begins_before(first, slab.start) {
                points.push(item);
            }
        }
        meet(&mut Walk { visit, lanes: [Node::EMPTY; FEW / WIDTH] }, axes, spans, points)
    }
}

/// Keys from `start` up to `end`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    pub(super) start: Key,
    pub(super) end: Key,
}

impl Slab {
    pub(super) const ALL: Self = Self { start: (f32::NEG_INFINITY, 0), end: (f32::INFINITY, u32::MAX) };
}

/// The context of a walk.
struct Walk<'a, V> {
    visit: &'a mut V,
    lanes: Lanes,
}

/// A stretch of an axis: no key of its points is before `first`, no lower end above `last`.
#[derive(Clone, Copy)]
struct Stretch {
    first: Key,
    last: f32,
}

/// Finds the pairs of a span and a point that lies in it on the first axis, if they overlap on all others too.
fn meet<V: FnMut(u32, u32) -> ControlFlow<()>>(
    walk: &mut Walk<'_, V>,
    axes: &[usize],
    spans: &mut [Item],
    points: &mut [Item],
) -> ControlFlow<()> {
    let &[axis, ..] = axes else { return ControlFlow::Continue(()) };
    let Some(first) = points.iter().map(|point| point.key(axis)).min_by(in_order) else {
        return ControlFlow::Continue(());
    };
    let last = points.iter().map(|point| point.key(axis)).max_by(in_order).unwrap_or(first);
    let reach = part(spans, |span| span.begins_before(axis, last) & (span.high(axis) >= first.0));
    descend(walk, axes, Stretch { first, last: last.0 }, &mut spans[..reach], points)
}

/// The same for the points of a stretch, and spans that begin before its end and end behind its start.
fn descend<V: FnMut(u32, u32) -> ControlFlow<()>>(
    walk: &mut Walk<'_, V>,
    axes: &[usize],
    stretch: Stretch,
    spans: &mut [Item],
    points: &mut [Item],
) -> ControlFlow<()> {
    let &[axis, ref others @ ..] = axes else { return ControlFlow::Continue(()) };
    if spans.len().min(points.len()) <= FEW {
        return walk.compare(spans, points, Some(axis));
    }
    let covering =
        part(spans, |span| span.begins_before(axis, stretch.first) & (span.high(axis) >= stretch.last));
    let (covering, spans) = spans.split_at_mut(covering);
    pass_on(walk, others, covering, points)?;
    if spans.is_empty() {
        return ControlFlow::Continue(());
    }
    let (before, key) = halve(points, axis);
    let (before, behind) = points.split_at_mut(before);
    let reach = part(spans, |span| span.begins_before(axis, key));
    descend(walk, axes, Stretch { last: key.0, ..stretch }, &mut spans[..reach], before)?;
    let reach = part(spans, |span| span.high(axis) >= key.0);
    descend(walk, axes, Stretch { first: key, ..stretch }, &mut spans[..reach], behind)
}

/// Finds the pairs of a span and a point that overlap on all remaining axes.
fn pass_on<V: FnMut(u32, u32) -> ControlFlow<()>>(
    walk: &mut Walk<'_, V>,
    axes: &[usize],
    spans: &mut [Item],
    points: &mut [Item],
) -> ControlFlow<()> {
    if spans.len().min(points.len()) <= FEW {
        return walk.compare(spans, points, None);
    }
    if let &[last] = axes {
        return walk.scan(spans, points, last);
    }
    meet(walk, axes, spans, points)?;
    meet(walk, axes, points, spans)
}

/// Points sampled for a cut.
const SAMPLE: usize = 11;

/// Partitions points at a key, with at least a quarter of them on each side. Returns how many are before it, and that
/// key, the least of those behind.
fn halve(points: &mut [Item], axis: usize) -> (usize, Key) {
    let step = points.len() / SAMPLE;
    let mut sample = [(0.0, 0); SAMPLE];
    for (number, key) in sample.iter_mut().enumerate() {
        *key = points[number * step + step / 2].key(axis);
    }
    sample.sort_unstable_by(in_order);
    let key = sample[SAMPLE / 2];
    let before = part(points, |point| point.begins_before(axis, key));
    if before.min(points.len() - before) >= points.len() / 4 {
        return (before, key);
    }
    let half = points.len() / 2;
    let (_, middle, _) =
        points.select_nth_unstable_by(half, |one, other| in_order(&one.key(axis), &other.key(axis)));
    (half, middle.key(axis))
}

/// Moves the wanted items to the front; returns how many they are.
#[inline(always)]
fn part(items: &mut [Item], is_wanted: impl Fn(&Item) -> bool) -> usize {
    note(items.len());
    // Often there is none, and nothing needs to be written.
    let Some(first) = items.iter().position(&is_wanted) else { return 0 };
    items.swap(0, first);
    let mut count = 1;
    for place in first + 1..items.len() {
        let is_one = is_wanted(&items[place]);
        items.swap(place, count);
        count += usize::from(is_one);
    }
    count
}
