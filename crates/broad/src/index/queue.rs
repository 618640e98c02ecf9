//! What has been seen from afar, nearest first.

use core::cmp::Reverse;
use std::collections::BinaryHeap;

/// Scratch memory of questions whose answers come in order of distance. Keep one a thread, so that asking allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct Queue {
    /// Distance in the upper half, then a bit that puts nodes before boxes at the same, then the number of either.
    heap: BinaryHeap<Reverse<u64>>,
}

/// What comes next.
#[derive(Clone, Copy, Debug)]
pub(super) enum Next {
    Node(u32),
    Box(u32, f32),
}

const IS_BOX: u64 = 1 << 31;

impl Queue {
    /// A queue without memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    pub(super) fn clear(&mut self) {
        self.heap.clear();
    }

    /// Adds a node or a box, at a distance that is not below 0: then its bits are in the order of numbers.
    #[inline(always)]
    pub(super) fn push(&mut self, distance: f32, number: u32, is_box: bool) {
        let is_box = if is_box { IS_BOX } else { 0 };
        self.heap.push(Reverse(u64::from(distance.to_bits()) << 32 | is_box | u64::from(number)));
    }

    /// Takes the nearest, if it is not beyond the limit.
    #[inline(always)]
    pub(super) fn pop(&mut self, limit: f32) -> Option<Next> {
        let Reverse(key) = self.heap.pop()?;
        let distance = f32::from_bits((key >> 32) as u32);
        if distance > limit {
            return None;
        }
        let number = (key & (IS_BOX - 1)) as u32;
        Some(if key & IS_BOX == 0 { Next::Node(number) } else { Next::Box(number, distance) })
    }
}
