//! A priority queue of nodes and boxes, nearest first.

use core::cmp::Reverse;
use std::collections::BinaryHeap;

/// Scratch memory for queries that answer in order of distance. Keep one per thread, so that queries allocate nothing.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    heap: BinaryHeap<Reverse<Next>>,
}

/// A node or a box: its distance in the upper half, then a bit that puts nodes before boxes at equal distance, then its
/// number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Next(u64);

const IS_BOX: u64 = 1 << 31;

impl Next {
    /// A node, at a distance that is not negative: then its bits have the order of the floats.
    #[inline(always)]
    pub(super) fn node(distance: f32, number: u32) -> Self {
        Self(u64::from(distance.to_bits()) << 32 | u64::from(number))
    }

    #[inline(always)]
    pub(super) fn boxed_at(distance: f32, number: u32) -> Self {
        Self(Self::node(distance, number).0 | IS_BOX)
    }

    #[inline(always)]
    pub(super) const fn distance(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    #[inline(always)]
    pub(super) const fn number(self) -> u32 {
        (self.0 & (IS_BOX - 1)) as u32
    }

    /// The number, if it is a box.
    #[inline(always)]
    pub(super) const fn boxed(self) -> Option<u32> {
        if self.0 & IS_BOX == 0 { None } else { Some(self.number()) }
    }
}

impl Queue {
    /// A queue without memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    pub(super) fn clear(&mut self) {
        self.heap.clear();
    }

    #[inline(always)]
    pub(super) fn push(&mut self, next: Next) {
        self.heap.push(Reverse(next));
    }

    #[inline(always)]
    pub(super) fn pop(&mut self) -> Option<Next> {
        self.heap.pop().map(|Reverse(next)| next)
    }

    #[inline(always)]
    pub(super) fn peek(&self) -> Option<Next> {
        self.heap.peek().map(|&Reverse(next)| next)
    }
}
