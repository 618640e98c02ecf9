//! Which boxes of a tree reach out furthest: how what is around all of them is found without looking at all.
//!
//! ```text
//! to each of six sides: from node to node what reaches furthest there, down to a box, which is handed over
//! then all boxes, but for those, and nodes, that reach no further than what was handed over
//! ```
//! The first is not sure to find what is furthest, since the box of a node that is turned reaches further than what is
//! in it. It finds what lets the second pass over nearly all.

use super::walk::STACK;
use super::{EMPTY, IS_BOX, Node, Sides, Tree};
use arrayvec::ArrayVec;

/// How far something reaches to six sides: any numbers that are greater further out.
pub(crate) type Reach = [f64; 6];

impl Tree {
    /// Hands boxes to `visitor`, some more than once, which returns how far all that it was handed reaches by then:
    /// until no other reaches further. `reach_of` tells how far a box can reach, no less than all that is in it. Cost:
    /// logarithmic in the boxes, and linear in those about which `reach_of` leaves it open.
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
                // What is no number may reach anywhere.
                let is_inside = (0..6).all(|side| reach[side] <= reached[side]);
                if !is_inside {
                    stack.push(child);
                }
            }
        }
    }
}

impl Node {
    /// What is in its places, and the boxes around them.
    fn children(&self) -> impl Iterator<Item = (u32, Sides)> + '_ {
        let filled = self.slots.iter().enumerate().filter(|&(_, &slot)| slot != EMPTY);
        filled.map(|(place, &slot)| (slot, core::array::from_fn(|side| self.sides[side][place])))
    }
}
