//! An index of boxes that rest.

mod build;
mod cast;
mod node;
mod order;
mod queue;
mod reach;
#[cfg(target_arch = "x86_64")]
mod wide;

pub use cast::Cast;
pub use queue::Queue;
pub use reach::Found;

use asunder_geometry::Bounds;
use core::marker::PhantomData;
use core::ops::ControlFlow;
use node::{Node, Sides, WIDTH};

/// Boxes that rest, to be asked many times. Asking changes nothing, so that any number of threads may.
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
#[derive(Clone, Debug)]
pub struct Index<B> {
    nodes: Vec<Node>,
    items: Vec<order::Item>,
    scratch: order::Scratch,
    bounds: PhantomData<B>,
}

/// Nodes that wait while another is looked at: all but one of each that stands above it.
const STACK: usize = (WIDTH - 1) * build::MOST_DEPTH + WIDTH;

impl<B: Bounds> Index<B> {
    /// An index of no boxes.
    pub fn new() -> Self {
        Self { nodes: Vec::new(), items: Vec::new(), scratch: order::Scratch::default(), bounds: PhantomData }
    }

    /// Forgets all boxes, and takes these instead. Boxes that are empty sets are never found.
    ///
    /// At most 2^31 boxes. Cost: about 40 ns a box; 70 bytes a box, of which 16 are scratch memory.
    pub fn build(&mut self, boxes: &[B]) {
        self.build_from(boxes, |_| true);
    }

    /// The same without the boxes that `keep` does not want. The others keep their numbers.
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
        let numbers = (0_u32..).zip(boxes).filter(|(number, one)| one.is_valid() && keep(*number));
        self.items.extend(numbers.map(|(number, _)| u64::from(number)));
        self.nodes.clear();
        let sides = |number: u32| sides(&boxes[number as usize]);
        let (items, scratch, nodes) = (&mut self.items, &mut self.scratch, &mut self.nodes);
        build::Builder { sides, items, scratch, nodes }.build();
    }

    /// How many boxes can be found.
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

    /// Replaces `into` by the boxes that overlap this one, by their numbers, sorted.
    pub fn overlapping(&self, bounds: &B, into: &mut Vec<u32>) {
        into.clear();
        let _ = self.visit_overlapping(bounds, |number| {
            into.push(number);
            ControlFlow::Continue(())
        });
        into.sort_unstable();
    }

    /// Hands the number of every box that overlaps this one to `visitor`, each once, in no promised order, until it breaks off.
    #[inline]
    pub fn visit_overlapping(
        &self,
        bounds: &B,
        visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        #[cfg(target_arch = "x86_64")]
        if is_wide() {
            #[allow(unsafe_code)]
            // SAFETY: the features were asked for.
            return unsafe { self.overlapping_avx2(bounds, visitor) };
        }
        self.overlapping_any::<false>(bounds, visitor)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,bmi1")]
    fn overlapping_avx2(&self, bounds: &B, visitor: impl FnMut(u32) -> ControlFlow<()>) -> ControlFlow<()> {
        self.overlapping_any::<true>(bounds, visitor)
    }

    #[inline(always)]
    fn overlapping_any<const WIDE: bool>(
        &self,
        bounds: &B,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.nodes.is_empty() || !bounds.is_valid() {
            return ControlFlow::Continue(());
        }
        let sides = sides(bounds);
        let mut stack = [0_u32; STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[stack[waiting] as usize];
            let (nodes, boxes) = node.parts(node::overlapping::<WIDE>(node, &sides));
            for (_, number) in boxes {
                visitor(number)?;
            }
            for (_, child) in nodes {
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

#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn is_wide() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("bmi1")
}
