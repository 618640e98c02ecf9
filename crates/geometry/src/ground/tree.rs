//! A tree of boxes that never change: what ground looks its triangles up in.
//!
//! ```text
//! build    to split a part: full children first, of 8, 64, 512 ... boxes; the last takes what is left
//!          halve by count, in such steps, along the axis on which centres lie furthest apart, until all are children
//! overlap  test the eight boxes of a node at once; hand over boxes, put nodes on a stack
//! order    test the eight boxes of a node at once; put all that pass on a stack, the nearest on top
//! ```
//! Splits by count pack all nodes full, so that a box takes 32 bytes and no tree is deeper than its count says (Kamel
//! and Faloutsos, "On packing R-trees", 1993). Wald, Benthin and Boulos, "Getting rid of packets" (2008), for nodes of
//! eight; Ize, "Robust BVH ray traversal" (2013), for bounds that lose no box.
//!
//! Not the index of the broad phase: that one is built anew whenever bodies have moved, in half the time, and takes
//! 60 bytes a box; and its order of distance is strict, which takes a heap.
//!
//! Of a million triangles of rolling land, those near a box of 1 m are found in 120 ns and near one of 4 m in 800,
//! anywhere; where it was asked about just before, in 80 and 170. parry3d's tree takes 1.6 times as long for either,
//! and 1.3 to 1.6 times for a ray (AMD EPYC Zen 4, 2026-11-22, a busy machine).
//! Tried: the same compiled for AVX2: 10 to 15 % faster, where memory is not what is waited for. Not worth unsafe code.
mod walk;

pub(crate) use walk::{Ask, Line, Near};

/// Least corner, then greatest.
pub(crate) type Sides = [f32; 6];

/// Boxes in a node.
pub(crate) const WIDTH: usize = 8;

/// Up to eight boxes. Empty places hold NaN, and [`EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
struct Node {
    /// A row for each side, so that eight boxes are tested by the same instructions.
    sides: [[f32; WIDTH]; 6],
    /// What is in each box: a node, or with [`IS_BOX`], a box.
    slots: [u32; WIDTH],
}

/// Set in the slot of a box that is no node's.
const IS_BOX: u32 = 1 << 31;

/// What no slot is.
const EMPTY: u32 = u32::MAX;

/// Most nodes below one another: 8^11 boxes are more than there are numbers.
const MOST_DEPTH: usize = 11;

/// Boxes by their numbers, to be found by place.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
}

/// A box to be sorted.
#[derive(Clone, Copy, Debug)]
struct Item {
    /// Twice its centre.
    center: [f32; 3],
    number: u32,
}

impl Tree {
    /// A tree of the boxes with these numbers, below 2^31 - 1. Boxes are finite.
    pub(crate) fn new(numbers: impl Iterator<Item = u32>, sides: impl Fn(u32) -> Sides) -> Self {
        let item = |number: u32| {
            let [a, b, c, d, e, f] = sides(number);
            Item { center: [a + d, b + e, c + f], number }
        };
        let mut items: Vec<Item> = numbers.map(item).collect();
        let mut nodes = Vec::with_capacity(items.len() / (WIDTH - 1) + 2 * MOST_DEPTH);
        if !items.is_empty() {
            Builder { nodes: &mut nodes, sides }.node(&mut items);
        }
        nodes.shrink_to_fit();
        Self { nodes }
    }

    /// Memory that is held, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
    }
}

struct Builder<'a, F> {
    nodes: &'a mut Vec<Node>,
    sides: F,
}

impl<F: Fn(u32) -> Sides> Builder<'_, F> {
    /// Appends the node of some boxes, and those below it; returns its number and the box around it.
    fn node(&mut self, items: &mut [Item]) -> (u32, Sides) {
        let number = self.nodes.len() as u32;
        let mut node = Node { sides: [[f32::NAN; WIDTH]; 6], slots: [EMPTY; WIDTH] };
        self.nodes.push(node);
        let mut child = 1;
        while child * WIDTH < items.len() {
            child *= WIDTH;
        }
        let mut places = 0..;
        let mut add = |(slot, sides): (u32, Sides)| {
            let place = places.next().unwrap_or(0) % WIDTH;
            node.slots[place] = slot;
            (0..6).for_each(|row| node.sides[row][place] = sides[row]);
        };
        if child == 1 {
            items.sort_unstable_by_key(|item| item.number);
            items.iter().for_each(|item| add((item.number | IS_BOX, (self.sides)(item.number))));
        } else {
            self.children(items, child, &mut add);
        }
        self.nodes[number as usize] = node;
        (number, around(&node))
    }

    /// Splits boxes into children of a number that is a power of eight, all of them full but the last.
    fn children(&mut self, items: &mut [Item], child: usize, add: &mut impl FnMut((u32, Sides))) {
        let count = items.len().div_ceil(child);
        if count > 1 {
            let middle = count.div_ceil(2) * child;
            split(items, middle);
            let (low, high) = items.split_at_mut(middle);
            self.children(low, child, add);
            self.children(high, child, add);
        } else if let [item] = items {
            add((item.number | IS_BOX, (self.sides)(item.number)));
        } else {
            add(self.node(items));
        }
    }
}

/// Puts that many with the least centres before all others, on the axis on which these lie furthest apart. Which
/// ones is a function of the boxes: where centres are equal, numbers decide.
fn split(items: &mut [Item], count: usize) {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for item in &*items {
        for axis in 0..3 {
            let center = item.center[axis];
            low[axis] = if center < low[axis] { center } else { low[axis] };
            high[axis] = if center > high[axis] { center } else { high[axis] };
        }
    }
    let width = |axis: usize| high[axis] - low[axis];
    let axis = if width(1) > width(0) { 1 } else { 0 };
    let axis = if width(2) > width(axis) { 2 } else { axis };
    items.select_nth_unstable_by(count, |one, other| {
        one.center[axis].total_cmp(&other.center[axis]).then(one.number.cmp(&other.number))
    });
}

fn around(node: &Node) -> Sides {
    // A NaN is passed over.
    core::array::from_fn(|row| {
        let sides = node.sides[row].iter().copied();
        if row < 3 { sides.fold(f32::INFINITY, f32::min) } else { sides.fold(f32::NEG_INFINITY, f32::max) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depth(tree: &Tree, node: u32) -> usize {
        let inner = tree.nodes[node as usize].slots.iter().filter(|&&slot| slot & IS_BOX == 0);
        1 + inner.map(|&slot| depth(tree, slot)).max().unwrap_or(0)
    }

    #[test]
    fn trees_are_packed_and_as_deep_as_their_count_says() {
        for (count, deepest) in [(1, 1), (8, 1), (9, 2), (64, 2), (65, 3), (100_000, 6)] {
            let sides = |number: u32| {
                let place = |by: u32| (number.wrapping_mul(by) >> 8) as f32;
                [place(7919), place(104_729), place(3), place(7919) + 1.0, place(104_729) + 9.0, place(3)]
            };
            let tree = Tree::new(0..count, sides);
            assert_eq!(depth(&tree, 0), deepest, "{count}");
            assert!(tree.bytes() <= count as usize * 36 + 500, "{count}: {}", tree.bytes());
        }
    }
}
