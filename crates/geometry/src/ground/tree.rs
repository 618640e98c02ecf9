//! A static BVH, in which ground looks up its triangles.
//!
//! ```text
//! build    split into full children of 8, 64, 512 ... boxes; the last one takes the rest:
//!          halve by count, in multiples of a child, along the axis on which centres are spread widest
//! overlap  test the eight boxes of a node at once; hand over boxes, push nodes on a stack
//! order    test the eight boxes of a node at once; push all that pass on a stack, the nearest on top
//! reach    to six sides, skip everything that reaches no further than what was found                       (outermost)
//! ```
//! A tree of boxes has their numbers in its lowest nodes. A tree of triangles has leaves instead, with the corners of
//! up to eight triangles as a structure of arrays, from which boxes are computed on demand. So a ray needs no further
//! reads, and 48 instructions per leaf cost less than a second cache miss, which took a third of a ray's time on a
//! million triangles.
//!
//! Splits by count fill all nodes, so that a box takes 32 bytes, a triangle 44, and the depth follows from the count
//! (Kamel and Faloutsos, "On packing R-trees", 1993). Wald, Benthin and Boulos, "Getting rid of packets" (2008), for
//! nodes of eight; Ize, "Robust BVH ray traversal" (2013), for bounds that lose no box.
//!
//! Why not the index of the broad phase: that is made to be rebuilt whenever bodies have moved, in half the time, takes
//! 60 bytes per box, and its order of distance is strict, which takes a heap.
//!
//! Among a million triangles of rolling land, those near a box of 1 m are found in 120 ns and near one of 4 m in 800,
//! anywhere; if the same place was queried just before, in 80 and 170. parry3d's tree takes 1.6 times as long for
//! either, and 1.5 to 1.8 times for a ray (AMD EPYC Zen 4, 2026-11-22, a busy machine). Tried: compiling it for AVX2 as
//! well: 10 to 15 % faster where it does not wait for memory. Not worth unsafe code.
mod outermost;
mod walk;

pub(crate) use outermost::Reach;
pub(crate) use walk::{Ask, Line, Near};

use glam::Vec3;

/// Minimum, then maximum.
pub(crate) type Sides = [f32; 6];

/// Boxes in a node.
pub(crate) const WIDTH: usize = 8;

/// A row of eight boxes for each side, minima first, so that all eight are tested by the same instructions.
pub(crate) type Rows = [[f32; WIDTH]; 6];

/// Up to eight boxes. Empty places hold NaN, and [`EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
struct Node {
    sides: Rows,
    /// What each box contains: a node, or with [`IS_LEAF`] a leaf, or with [`IS_BOX`] a box of the caller.
    slots: [u32; WIDTH],
}

/// Up to eight triangles. Empty places hold NaN, and [`EMPTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
struct Leaf {
    /// A row for each coordinate of each corner: x, y, z of the first, the second, the third.
    corners: [[f32; WIDTH]; 9],
    /// Their numbers.
    slots: [u32; WIDTH],
}

impl Leaf {
    const EMPTY: Self = Self { corners: [[f32::NAN; WIDTH]; 9], slots: [EMPTY; WIDTH] };

    fn put(&mut self, place: usize, number: u32, corners: [Vec3; 3]) {
        self.slots[place] = number;
        for (corner, point) in corners.iter().enumerate() {
            for axis in 0..3 {
                self.corners[3 * corner + axis][place] = point[axis];
            }
        }
    }

    #[inline(always)]
    fn triangle(&self, place: usize) -> [Vec3; 3] {
        let at = |row: usize| {
            Vec3::new(self.corners[row][place], self.corners[row + 1][place], self.corners[row + 2][place])
        };
        [at(0), at(3), at(6)]
    }

    /// The boxes of all eight.
    #[inline(always)]
    fn sides(&self) -> Rows {
        let mut sides = [[0.0; WIDTH]; 6];
        for axis in 0..3 {
            let (a, b, c) = (&self.corners[axis], &self.corners[axis + 3], &self.corners[axis + 6]);
            for lane in 0..WIDTH {
                let least = if b[lane] < a[lane] { b[lane] } else { a[lane] };
                sides[axis][lane] = if c[lane] < least { c[lane] } else { least };
            }
            for lane in 0..WIDTH {
                let most = if b[lane] > a[lane] { b[lane] } else { a[lane] };
                sides[axis + 3][lane] = if c[lane] > most { c[lane] } else { most };
            }
        }
        sides
    }
}

/// Set in the slot of a caller's box; in a tree with leaves, in the place of a triangle within these.
const IS_BOX: u32 = 1 << 31;

/// Set in the slot of a leaf.
const IS_LEAF: u32 = 1 << 30;

/// The slot of an empty place.
const EMPTY: u32 = u32::MAX;

/// Greatest depth: 8^11 boxes are more than there are numbers.
const MOST_DEPTH: usize = 11;

/// Boxes or triangles with numbers, to be found by position.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    /// The leaves of a tree of triangles.
    leaves: Vec<Leaf>,
    /// As in a node's slots; [`EMPTY`] in an empty tree.
    root: u32,
}

/// A box that is to be sorted.
#[derive(Clone, Copy, Debug)]
struct Item {
    /// Twice its centre.
    center: [f32; 3],
    number: u32,
}

impl Tree {
    /// A tree of the boxes with these numbers, which are below 2^30. Boxes must be finite.
    pub(crate) fn new(numbers: impl Iterator<Item = u32>, sides: impl Fn(u32) -> Sides) -> Self {
        Self::build(numbers, sides, None::<fn(u32) -> [Vec3; 3]>)
    }

    /// A tree of triangles, with numbers below 2^30, that holds their corners. All must be finite.
    pub(crate) fn of_triangles(
        numbers: impl Iterator<Item = u32>,
        corners: impl Fn(u32) -> [Vec3; 3],
    ) -> Self {
        let sides = |number| {
            let [a, b, c] = corners(number);
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            [low.x, low.y, low.z, high.x, high.y, high.z]
        };
        Self::build(numbers, sides, Some(&corners))
    }

    fn build(
        numbers: impl Iterator<Item = u32>,
        sides: impl Fn(u32) -> Sides,
        corners: Option<impl Fn(u32) -> [Vec3; 3]>,
    ) -> Self {
        let item = |number: u32| {
            let [a, b, c, d, e, f] = sides(number);
            Item { center: [a + d, b + e, c + f], number }
        };
        let mut items: Vec<Item> = numbers.map(item).collect();
        let mut tree = Self { nodes: Vec::new(), leaves: Vec::new(), root: EMPTY };
        let ends = items.len().div_ceil(WIDTH);
        let inner = if corners.is_some() { ends } else { items.len() };
        tree.nodes.reserve(inner / (WIDTH - 1) + 2 * MOST_DEPTH);
        tree.leaves.reserve(if corners.is_some() { ends + MOST_DEPTH } else { 0 });
        if !items.is_empty() {
            tree.root = Builder { tree: &mut tree, sides, corners }.node(&mut items).0;
        }
        tree.nodes.shrink_to_fit();
        tree.leaves.shrink_to_fit();
        tree
    }

    /// Memory that is held, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.leaves.capacity() * size_of::<Leaf>()
    }
}

struct Builder<'a, F, G> {
    tree: &'a mut Tree,
    sides: F,
    corners: Option<G>,
}

impl<F: Fn(u32) -> Sides, G: Fn(u32) -> [Vec3; 3]> Builder<'_, F, G> {
    /// Appends the node of some boxes, and those below it; returns its slot and the box around it.
    fn node(&mut self, items: &mut [Item]) -> (u32, Sides) {
        let mut child = 1;
        while child * WIDTH < items.len() {
            child *= WIDTH;
        }
        if child == 1 {
            items.sort_unstable_by_key(|item| item.number);
            if let Some(corners) = &self.corners {
                let mut leaf = Leaf::EMPTY;
                items
                    .iter()
                    .enumerate()
                    .for_each(|(place, item)| leaf.put(place, item.number, corners(item.number)));
                self.tree.leaves.push(leaf);
                return ((self.tree.leaves.len() - 1) as u32 | IS_LEAF, around(&leaf.sides()));
            }
        }
        let number = self.tree.nodes.len() as u32;
        let mut node = Node { sides: [[f32::NAN; WIDTH]; 6], slots: [EMPTY; WIDTH] };
        self.tree.nodes.push(node);
        let mut places = 0..;
        let mut add = |(slot, sides): (u32, Sides)| {
            let place = places.next().unwrap_or(0) % WIDTH;
            node.slots[place] = slot;
            (0..6).for_each(|row| node.sides[row][place] = sides[row]);
        };
        if child == 1 {
            items.iter().for_each(|item| add((item.number | IS_BOX, (self.sides)(item.number))));
        } else {
            self.children(items, child, &mut add);
        }
        self.tree.nodes[number as usize] = node;
        (number, around(&node.sides))
    }

    /// Splits boxes into children of `child` boxes, a power of eight; all but the last are full.
    fn children(&mut self, items: &mut [Item], child: usize, add: &mut impl FnMut((u32, Sides))) {
        let count = items.len().div_ceil(child);
        if count > 1 {
            let middle = count.div_ceil(2) * child;
            split(items, middle);
            let (low, high) = items.split_at_mut(middle);
            self.children(low, child, add);
            self.children(high, child, add);
        } else if let ([item], None) = (&*items, &self.corners) {
            add((item.number | IS_BOX, (self.sides)(item.number)));
        } else {
            add(self.node(items));
        }
    }
}

/// Puts the `count` items with the least centres before all others, on the axis on which centres are spread widest. The
/// choice depends only on the boxes: among equal centres, numbers decide.
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

fn around(rows: &Rows) -> Sides {
    // NaN is skipped.
    core::array::from_fn(|row| {
        let sides = rows[row].iter().copied();
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
