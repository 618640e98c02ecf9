//! A bound on what a walk through boxes may cost: all pairs of two sets in O(n log^3 n + pairs), however they lie.
//!
//! Two boxes overlap on an axis where the lower end of one lies in the interval of the other. So every box is once a
//! *span*, an interval on the axis at hand, and once a *point*, its lower end there; the question is which points lie
//! in which spans, and which of these pairs overlap on the axes that are left.
//!
//! ```text
//! spans, points, a stretch of the axis that holds all points:
//!   few of either: compare all, eight at a time                                         few
//!   spans that cover the stretch hold every point: they and the points go on to the
//!     next axis, in both roles, as either may have the lower end there; on the last
//!     axis both are sorted and swept
//!   cut the points in halves; each half, with the spans that reach it but do not cover
//!     all, is the same again
//! ```
//! A span is passed on to at most two of the stretches of a depth, those with its ends; so a depth costs what there
//! are spans and points, and each axis has a logarithm of depths. That is a segment tree of which no node is ever
//! stored: Zomorodian & Edelsbrunner, "Fast software for box intersections" (2000).
//!
//! 1. Lower ends that are equal are told apart by the place of the box. So there are no ties: of two boxes exactly one
//!    begins first, halves are halves where all boxes are the same, and touching or unbounded boxes are nothing
//!    special.
//! 2. Sets are moved to the front of their slice, never copied: the whole works in two copies of the boxes (64 bytes a
//!    box), with no other memory.
//! 3. A cut that leaves less than a quarter on a side is made again, exactly: a path is at most 2.5 log2 n deep an
//!    axis, and so is the stack.
//! 4. On the last axis a sort and a sweep in place of both roles: a third less in all (needles, 100,000).
//!
//! Tried (AMD EPYC, Zen 4, 2026-11-22): 32 boxes that are compared in place of 64, 1.1 to 1.4 times as long; spans and
//! points that go on limited to each other's bounds, no change; bounds as whole numbers, 1.3 to 1.8 times as long, for
//! want of the kernel that the index has.

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

/// A lower end, and whose: no two are equal.
pub(super) type Key = (f32, u32);

impl Item {
    /// Nothing, if the box is no set of points.
    #[inline(always)]
    pub(super) fn new<B: Bounds>(bounds: &B, place: u32) -> Option<Self> {
        // Minus zero becomes zero: there is one order of floats then.
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

/// The axes in the order in which a walk takes them: that along which columns are swept is one on which boxes are
/// short. The plane has two.
pub(super) fn axes_from<B: Bounds>(sweep: usize) -> ([usize; 3], usize) {
    let axes = [0, 1, 2].map(|offset| (sweep + offset) % B::AXES.max(1));
    (axes, B::AXES.min(3))
}

/// What all pairs of so many boxes cost, a box, in the candidates that a sweep of columns compares in that time: as far
/// as was measured at the worst (needles; a third of it where boxes are cubes of all sizes).
pub(super) fn worth(boxes: usize) -> usize {
    if way() == Way::Columns {
        return usize::MAX >> (usize::BITS / 2);
    }
    let depth = boxes.max(2).ilog2() as usize;
    CANDIDATES_A_NODE * depth * depth
}

/// See [`worth`].
const CANDIDATES_A_NODE: usize = 12;

/// Two copies of the boxes of a sweep.
#[derive(Debug, Default)]
pub(super) struct Segments {
    spans: Vec<Item>,
    points: Vec<Item>,
}

impl Segments {
    pub(super) fn bytes(&self) -> usize {
        (self.spans.capacity() + self.points.capacity()) * size_of::<Item>()
    }

    /// Hands over the places of every two of these boxes that overlap and of which the one that begins later on the
    /// first axis begins in the slab, each two once, until told to stop. The axes are taken in the order given: first
    /// one on which boxes are short.
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

/// Keys from one up to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    pub(super) start: Key,
    pub(super) end: Key,
}

impl Slab {
    pub(super) const ALL: Self = Self { start: (f32::NEG_INFINITY, 0), end: (f32::INFINITY, u32::MAX) };
}

/// What a walk carries along.
struct Walk<'a, V> {
    visit: &'a mut V,
    lanes: Lanes,
}

/// A stretch of an axis: its points' keys are none before `first`, and their lower ends none above `last`.
#[derive(Clone, Copy)]
struct Stretch {
    first: Key,
    last: f32,
}

/// Pairs of a span and a point that lies in it on the first of the axes, and that overlap on all others.
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

/// The same, of the points of a stretch, and spans that begin before its end and end behind its start.
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

/// Pairs of a span and a point that overlap on all axes that are left.
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

/// Points that are looked at for a cut.
const SAMPLE: usize = 11;

/// Moves points of lesser keys before those of greater ones; returns how many they are, and the least key of the
/// others. On both sides there is a quarter at least.
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

/// Moves items of a kind to the front; returns how many they are.
#[inline(always)]
fn part(items: &mut [Item], is_wanted: impl Fn(&Item) -> bool) -> usize {
    note(items.len());
    // Often there is none, and then nothing to be written.
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
