//! Finds the boxes of a tree that reach out furthest, to bound all of them without visiting all.
//!
//! ```text
//! for each of six sides: descend to the child that reaches furthest there, down to a box, and hand that over
//! then traverse the tree, without nodes and boxes that reach no further than what has been handed over
//! ```
//! The first pass may miss the furthest box, since the turned box of a node reaches further than its contents. But what
//! it finds lets the second pass skip nearly everything.

use super::walk::STACK;
use super::{EMPTY, IS_BOX, Node, Sides, Tree};
use arrayvec::ArrayVec;

/// How far something reaches to six sides, in any numbers that grow outwards.
pub(crate) type Reach = [f64; 6];

impl Tree {
    /// Hands boxes to `visitor`, some more than once, until no other can reach further. `visitor` returns how far
    /// everything that it has been handed so far reaches. `reach_of` gives an upper bound of how far the contents of a
    /// box reach. Cost: logarithmic in the boxes, and linear in those that `reach_of` cannot rule out.
    pub(crate) fn visit_outermost(
        &self,
        reach_of: impl Fn(Sides) -> Reach,
        mut visitor: impl FnMut(u32) -> Reach,
    ) {
        if self.root == EMPTY {
            return;
        }
        let mut reached = [f64::NEG_INFINITY; 6];
        for side in 0..6 {
            let mut slot = self.root;
            while slot & IS_BOX == 0 {
                let Some((next, _)) = self.nodes[slot as usize]
                    .children()
                    .map(|(slot, sides)| (slot, reach_of(sides)[side]))
                    .reduce(|best, next| if next.1 > best.1 { next } else { best })
                else {
                    return;
                };
                slot = next;
            }
            reached = visitor(slot & !IS_BOX);
        }
        let mut stack = ArrayVec::<u32, STACK>::new();
        stack.push(self.root);
        while let Some(slot) = stack.pop() {
            if slot & IS_BOX != 0 {
                reached = visitor(slot & !IS_BOX);
                continue;
            }
            for (child, sides) in self.nodes[slot as usize].children() {
                let reach = reach_of(sides);
                // NaN may reach anywhere.
                let is_inside = (0..6).all(|side| reach[side] <= reached[side]);
                if !is_inside {
                    stack.push(child);
                }
            }
        }
    }
}

impl Node {
    /// The slots in use, and their boxes.
    fn children(&self) -> impl Iterator<Item = (u32, Sides)> + '_ {
        let filled = self.slots.iter().enumerate().filter(|&(_, &slot)| slot != EMPTY);
        filled.map(|(place, &slot)| (slot, core::array::from_fn(|side| self.sides[side][place])))
    }
}
