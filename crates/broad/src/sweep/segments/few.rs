//! Compares few boxes with any number of others, eight at a time.

use super::{Item, Walk, in_order};
use crate::index::node::{Node, WIDTH};
use crate::sweep::trial::note;
use crate::width::{Kernel, Width, widest};
use core::ops::ControlFlow;

/// So few boxes are compared with all others, and not cut further.
pub(super) const FEW: usize = 64;

/// Those few, side by side in nodes of eight.
pub(super) type Lanes = [Node; FEW / WIDTH];

impl<V: FnMut(u32, u32) -> ControlFlow<()>> Walk<'_, V> {
    /// Finds the pairs of a span and a point that overlap; where an axis is given, only those whose span begins first
    /// on it.
    pub(super) fn compare(
        &mut self,
        spans: &[Item],
        points: &[Item],
        axis: Option<usize>,
    ) -> ControlFlow<()> {
        widest(Comparison { spans, points, axis, walk: self })
    }
}

impl<V: FnMut(u32, u32) -> ControlFlow<()>> Walk<'_, V> {
    /// Finds the pairs of a box of either set that overlap on an axis, by sort and sweep: boxes in order of their lower
    /// ends, each with those of the other set that begin within it.
    pub(super) fn scan(&mut self, ones: &mut [Item], others: &mut [Item], axis: usize) -> ControlFlow<()> {
        for items in [&mut *ones, &mut *others] {
            note(items.len() * items.len().max(2).ilog2() as usize);
            items.sort_unstable_by(|one, other| in_order(&one.key(axis), &other.key(axis)));
        }
        let (mut ones, mut others) = (&*ones, &*others);
        while let ([one, rest @ ..], [other, rest_of_others @ ..]) = (ones, others) {
            let (first, reached) = if one.begins_before(axis, other.key(axis)) {
                ones = rest;
                (one, others)
            } else {
                others = rest_of_others;
                (other, ones)
            };
            for second in reached.iter().take_while(|second| second.low(axis) <= first.high(axis)) {
                (self.visit)(first.place, second.place)?;
            }
        }
        ControlFlow::Continue(())
    }
}

struct Comparison<'a, 'w, V> {
    spans: &'a [Item],
    points: &'a [Item],
    axis: Option<usize>,
    walk: &'a mut Walk<'w, V>,
}

impl<V: FnMut(u32, u32) -> ControlFlow<()>> Kernel for Comparison<'_, '_, V> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> ControlFlow<()> {
        let Self { spans, points, axis, walk: Walk { visit, lanes } } = self;
        let (few, many, is_few_spans) =
            if spans.len() < points.len() { (spans, points, true) } else { (points, spans, false) };
        note(few.len().div_ceil(WIDTH) * many.len());
        for few in few.chunks(FEW) {
            for (node, few) in lanes.iter_mut().zip(few.chunks(WIDTH)) {
                *node = Node::EMPTY;
                few.iter().for_each(|item| node.push(&item.sides, item.place, false));
            }
            let lanes = &lanes[..few.len().div_ceil(WIDTH)];
            for one in many {
                let mut hits = 0;
                for (number, node) in lanes.iter().enumerate() {
                    hits |= u64::from(width.overlapping(node, &one.sides)) << (number * WIDTH);
                }
                while hits != 0 {
                    let other = &few[hits.trailing_zeros() as usize];
                    hits &= hits - 1;
                    let (span, point) = if is_few_spans { (other, one) } else { (one, other) };
                    if axis.is_none_or(|axis| span.begins_before(axis, point.key(axis))) {
                        visit(span.place, point.place)?;
                    }
                }
            }
        }
        ControlFlow::Continue(())
    }
}
