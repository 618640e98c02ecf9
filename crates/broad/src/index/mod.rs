//! An index of boxes that rest: a BVH with eight children per node, built along a Z-order curve.
//!
//! ```text
//! build    sort boxes by the Z-order code of their centres, very large ones (giants) apart from the rest (order)
//!          for each node: split its range of the order at the highest bit that differs, the largest piece first, until
//!          there are eight pieces or none has more than eight boxes; pieces become child nodes, or their boxes become
//!          direct children of this node if they fit
//!          boxes with equal codes are sorted again by codes of their own; if that fails, split by count
//! overlap  test the eight boxes of a node at once; hand over boxes; push nodes on a stack
//! order    test the eight boxes of a node at once; continue with whatever is nearest: visit a node, hand over a box
//! ```
//! Lauterbach et al., "Fast BVH construction on GPUs" (2009), for the order; Wald, Benthin and Boulos, "Getting rid
//! of packets" (2008), for wide nodes; Ize, "Robust BVH ray traversal" (2013), for bounds that lose no box.
//!
//! What each part buys (AMD EPYC Zen 4, 2026-11-21; overlaps of a box among 100,000 in `gas`, unless said otherwise):
//! 1. Eight boxes per node as a structure of arrays: one instruction tests eight. A node is four cache lines; a third
//!    of the time is spent waiting for the first.
//! 2. Hand-written AVX2 (wide): 1.2 to 1.4 times as fast. The compiler turns the loops into four lanes and four
//!    scalars.
//! 3. A sort instead of splits by cost: the build takes 42 ns per box, parry3d's binned build 450 to 500.
//! 4. Giants apart: 300 walls of 60 m among 100,000 boxes of 1 m make the overlaps of a box take 1.4 times as long as
//!    without walls, not 2 times; rays 1.3 times, not 1.8.
//! 5. The boxes of small pieces are children of the parent: fewer nodes, and none with a single box (not measured by
//!    itself).
//! 6. The same test for nodes and boxes, monotone under rounding: no box is lost between levels, without any margin.
//! 7. The nearest child bypasses the queue, and if a single nearest box is wanted, nothing is queued that is further
//!    than a box already seen: the nearest box took 930 ns with a plain queue, and takes 570.
//!
//! Why not the columns of the sweep (`crate::columns`): they have no order of distance, so the nearest box in an empty
//! part of the world would have to be searched for ring by ring. They were not measured themselves, but a stand-in was:
//! a grid of cells of 2 m (20 in `sizes` and `islands`; neither tuned) that stores each box once, with its bounds, and
//! knows the greatest size. For a box of the scene it takes 172 ns in `gas`, 136 among a million, 80 in `city`, 88 in
//! `tower`; the tree 148, 149, 67 and 115. In `pile`, `sizes` and `islands` it takes 835, 487 and 6207 ns, the tree
//! 304, 165 and 333.
//!
//! Tried: batches of queries, sorted along a curve: 1.1 to 1.4 times as fast (2.5 in `islands`), the sort not counted.
//! It is not offered; callers whose queries have such an order should keep it. Tried: pushing nodes on the stack
//! without a branch, by eight stores and a count: 25 % slower.

mod build;
mod cast;
pub(crate) mod node;
mod order;
mod queue;
mod reach;
mod single;
pub(crate) mod wide;

pub use cast::Cast;
pub use queue::Queue;
pub use reach::Found;
pub use single::least_distance;

use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use core::marker::PhantomData;
use core::ops::ControlFlow;
use node::{Node, Sides, WIDTH};

/// Boxes that rest, for many queries. Queries change nothing, so any number of threads may make them.
///
/// The boxes' numbers are their places in the slice they came in.
///
/// ```
/// use asunder_broad::Index;
/// use asunder_geometry::{Aabb2, glam::Vec2};
/// let boxes = [0.0, 1.0, 2.0, 3.0].map(|x| Aabb2::new(Vec2::new(x, 0.0), Vec2::new(x + 0.5, 1.0)));
/// let mut index = Index::new();
/// index.build(&boxes);
/// let mut found = vec![];
/// index.overlapping(&Aabb2::new(Vec2::new(0.5, 0.0), Vec2::new(2.0, 0.0)), &mut found);
/// assert_eq!(found, [0, 1, 2], "closed sets: touching counts");
/// ```
#[derive(Debug)]
pub struct Index<B> {
    nodes: Vec<Node>,
    items: Vec<order::Item>,
    scratch: order::Scratch,
    bounds: PhantomData<B>,
}

asunder_geometry::copied!(Index<B>, for [B: Bounds], { nodes, items } but { scratch, bounds });

/// Most nodes on the stack while one is visited: all but one child of each of its ancestors.
const STACK: usize = (WIDTH - 1) * build::MOST_DEPTH + WIDTH;

impl<B: Bounds> Index<B> {
    /// An index of no boxes.
    pub fn new() -> Self {
        Self { nodes: Vec::new(), items: Vec::new(), scratch: order::Scratch::default(), bounds: PhantomData }
    }

    /// Replaces all boxes by these. Empty boxes are never found.
    ///
    /// Boxes beyond the first 2^31 are ignored. Cost: 50 to 120 ns per box, and 80 bytes per box, of which 16 are
    /// scratch memory.
    pub fn build(&mut self, boxes: &[B]) {
        self.build_from(boxes, |_| true);
    }

    /// The same with only the boxes that `keep` wants. They keep their numbers.
    ///
    /// ```
    /// use asunder_broad::Index;
    /// use asunder_geometry::{Aabb2, glam::Vec2};
    /// let unit = Aabb2::new(Vec2::ZERO, Vec2::ONE);
    /// let mut index = Index::new();
    /// index.build_from(&[unit; 5], |number| number % 2 == 1);
    /// let mut found = vec![];
    /// index.overlapping(&unit, &mut found);
    /// assert_eq!((found, index.len()), (vec![1, 3], 2));
    /// ```
    pub fn build_from(&mut self, boxes: &[B], mut keep: impl FnMut(u32) -> bool) {
        self.items.clear();
        let numbers = (0_u32..1 << 31).zip(boxes).filter(|(number, one)| one.is_valid() && keep(*number));
        self.items.extend(numbers.map(|(number, _)| u64::from(number)));
        self.nodes.clear();
        // There are about 0.23 nodes per box in all scenes; a vector that grows by itself would take twice the memory.
        self.nodes.reserve(self.items.len() / 4 + 1);
        let sides = |number: u32| sides(&boxes[number as usize]);
        let (items, scratch, nodes) = (&mut self.items, &mut self.scratch, &mut self.nodes);
        build::Builder { sides, items, scratch, nodes }.build();
    }

    /// The number of boxes in the index.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// Memory that is held, in bytes.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.items.capacity() * size_of::<order::Item>()
            + self.scratch.bytes()
    }

    /// Replaces `into` by the numbers of the boxes that overlap this one, sorted.
    pub fn overlapping(&self, bounds: &B, into: &mut Vec<u32>) {
        into.clear();
        let _ = self.visit_overlapping(bounds, |number| {
            into.push(number);
            ControlFlow::Continue(())
        });
        into.sort_unstable();
    }

    /// Hands the number of every box that overlaps this one to `visitor`, each once, in unspecified order, until it
    /// breaks off.
    #[inline]
    pub fn visit_overlapping(
        &self,
        bounds: &B,
        visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.nodes.is_empty() || !bounds.is_valid() {
            return ControlFlow::Continue(());
        }
        widest(Overlap { nodes: &self.nodes, sides: sides(bounds), visitor })
    }
}

/// The query for the boxes that overlap one.
struct Overlap<'a, F> {
    nodes: &'a [Node],
    sides: Sides,
    visitor: F,
}

impl<F: FnMut(u32) -> ControlFlow<()>> Kernel for Overlap<'_, F> {
    type Output = ControlFlow<()>;

    #[inline(always)]
    fn run<W: Width>(self, width: W) -> ControlFlow<()> {
        let Self { nodes, sides, mut visitor } = self;
        let mut stack = [0_u32; STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = &nodes[stack[waiting] as usize];
            let (inner, boxes) = node.parts(width.overlapping(node, &sides));
            for (_, number) in boxes {
                visitor(number)?;
            }
            for (_, child) in inner {
                stack[waiting] = child;
                waiting += 1;
            }
        }
        ControlFlow::Continue(())
    }
}

impl<B: Bounds> Default for Index<B> {
    fn default() -> Self {
        Self::new()
    }
}

#[inline(always)]
fn sides(bounds: &impl Bounds) -> Sides {
    let ([a, b, c], [d, e, f]) = bounds.corners();
    [a, b, c, d, e, f]
}
