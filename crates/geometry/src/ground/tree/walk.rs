//! Traversals of a tree: all boxes that overlap one, and boxes in an order, such as those a moved box crosses or the
//! nearest.

use super::{EMPTY, IS_BOX, IS_LEAF, Leaf, MOST_DEPTH, Node, Rows, Sides, Tree, WIDTH};
use crate::aabb::{Aabb3, Bounds};
use crate::outward::{round_down, round_up};
use arrayvec::ArrayVec;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};

/// Most entries on the stack: all but one child of each ancestor.
pub(super) const STACK: usize = WIDTH * (MOST_DEPTH + 1);

/// Boxes that wait, each with its place in the order. Not an array, which would have to be initialised: for a ray on
/// 20,000 triangles that was 4 % of the time (AMD EPYC, Zen 4, 2026-11-25).
type Stack = ArrayVec<(f32, u32), STACK>;

/// Relative rounding error allowed for: three roundings to f32 between a corner and a time, five between corners and
/// the square of a distance, of at most 2^-24 each.
const LOST: f64 = 1.0 / 4_194_304.0;

/// A query that puts boxes in an order. Nodes and boxes take the same test, monotone under rounding, so that no box
/// comes before the node around it.
pub(crate) trait Ask {
    /// Finds the place of each of eight boxes in the order, and which of them are within a limit. Places of others, and
    /// of empty slots, are arbitrary.
    fn find(&self, sides: &Rows, slots: &[u32; WIDTH], limit: f32, found: &mut Found);
    /// Converts a limit to the units of places; negative if nothing is within it.
    fn within(&self, limit: f64) -> f32;
}

/// The result of a test of the eight boxes of a node.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(32))]
pub(crate) struct Found {
    places: [f32; WIDTH],
    /// 1 for those within the limit, in the bytes of one number, so that a loop over lanes needs no sum across them.
    within: [u8; WIDTH],
}

impl Tree {
    /// Hands the number of every box that overlaps this one to `visitor`, each once, until it breaks off; with its
    /// triangle, in a tree of triangles.
    #[inline]
    pub(crate) fn visit_overlapping(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32, Option<[Vec3; 3]>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.root == EMPTY || !bounds.is_valid() {
            return ControlFlow::Continue(());
        }
        let ([a, b, c], [d, e, f]) = bounds.corners();
        let one: Sides = [a, b, c, d, e, f];
        let mut within = [0; WIDTH];
        let mut stack = ArrayVec::<u32, STACK>::new();
        stack.push(self.root);
        while let Some(slot) = stack.pop() {
            if slot & IS_LEAF != 0 {
                let leaf = &self.leaves[(slot & !IS_LEAF) as usize];
                leaf.overlapping(&one, &mut within);
                let mut hits = u64::from_le_bytes(within);
                while hits != 0 {
                    let place = hits.trailing_zeros() as usize / 8 % WIDTH;
                    visitor(leaf.slots[place], Some(leaf.triangle(place)))?;
                    hits &= hits - 1;
                }
                continue;
            }
            let node = &self.nodes[slot as usize];
            node.overlapping(&one, &mut within);
            let mut hits = u64::from_le_bytes(within);
            while hits != 0 {
                let slot = node.slots[hits.trailing_zeros() as usize / 8 % WIDTH];
                hits &= hits - 1;
                if slot & IS_BOX == 0 {
                    stack.push(slot);
                } else {
                    visitor(slot & !IS_BOX, None)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Hands boxes within a limit to `visitor`, the children of each node in order; with their triangles, in a tree of
    /// triangles. `visitor` returns the limit from then on, which cannot be raised.
    ///
    /// Longer than sixty lines, as popping from the stack and pushing to it share six variables that a helper would
    /// have to take and return.
    #[inline]
    pub(crate) fn visit_in_order(
        &self,
        ask: &impl Ask,
        limit: f64,
        mut visitor: impl FnMut(u32, Option<[Vec3; 3]>) -> f64,
    ) {
        let mut limit = ask.within(limit);
        if self.root == EMPTY {
            return;
        }
        let mut stack = Stack::new();
        stack.push((0.0_f32, self.root));
        let mut found = Found::default();
        'next: while let Some((place, mut slot)) = stack.pop() {
            // A negative limit ends here.
            if place > limit {
                continue;
            }
            while slot & IS_BOX == 0 {
                // In a leaf, slots are the places of triangles; in a node, its own slots.
                let (first, slots) = if slot & IS_LEAF == 0 {
                    let node = &self.nodes[slot as usize];
                    ask.find(&node.sides, &node.slots, limit, &mut found);
                    (0, &node.slots)
                } else {
                    let leaf = &self.leaves[(slot & !IS_LEAF) as usize];
                    ask.find(&leaf.sides(), &leaf.slots, limit, &mut found);
                    (IS_BOX | ((slot & !IS_LEAF) * WIDTH as u32), &LANES)
                };
                let mut bits = u64::from_le_bytes(found.within);
                if bits == 0 {
                    continue 'next;
                }
                let bottom = stack.len();
                while bits & (bits - 1) != 0 {
                    let lane = bits.trailing_zeros() as usize / 8 % WIDTH;
                    bits &= bits - 1;
                    let place = found.places[lane];
                    insert(&mut stack, bottom, (place, first | slots[lane]));
                }
                // The last of them is visited at once if it is the nearest.
                let lane = bits.trailing_zeros() as usize / 8 % WIDTH;
                let place = found.places[lane];
                slot = first | slots[lane];
                if let Some(&(nearest, first)) = stack[bottom..].last()
                    && nearest <= place
                {
                    stack.pop();
                    insert(&mut stack, bottom, (place, slot));
                    slot = first;
                }
            }
            let place = (slot & !IS_BOX) as usize;
            let (number, corners) = match self.leaves.get(place / WIDTH) {
                Some(leaf) => (leaf.slots[place % WIDTH], Some(leaf.triangle(place % WIDTH))),
                None => (slot & !IS_BOX, None),
            };
            let wanted = ask.within(visitor(number, corners));
            limit = if wanted < limit { wanted } else { limit };
        }
    }
}

/// Inserts a box into the part of a stack above `bottom`, with the nearest on top; among equals, the one of the earlier
/// lane.
#[inline(always)]
fn insert(stack: &mut Stack, bottom: usize, one: (f32, u32)) {
    let mut at = stack.len();
    stack.push(one);
    while at > bottom && stack[at - 1].0 <= one.0 {
        stack[at] = stack[at - 1];
        at -= 1;
    }
    stack[at] = one;
}

/// Places of a leaf.
const LANES: [u32; WIDTH] = [0, 1, 2, 3, 4, 5, 6, 7];

impl Node {
    /// Which of the boxes overlap a box: see [`note_overlaps`].
    #[inline(never)]
    fn overlapping(&self, one: &Sides, within: &mut [u8; WIDTH]) {
        note_overlaps(&self.sides, one, within);
    }
}

impl Leaf {
    /// Which of the triangles have a box that overlaps a box: see [`note_overlaps`].
    #[inline(never)]
    fn overlapping(&self, one: &Sides, within: &mut [u8; WIDTH]) {
        note_overlaps(&self.sides(), one, within);
    }
}

/// Which of eight boxes overlap a box: 1 for those, and 0 for others.
///
/// Its callers are separate functions that write to memory, like [`Ask::find`]: returned as a number, or inlined into
/// the walk, the lanes were scalarised (110 instructions per node, in place of 50). So the triangles near a box of 0.8
/// m are found in 0.73 of the time among 20,000, in 0.82 among a million (Intel Xeon, 2.5 GHz, 2026-11-28).
#[inline(always)]
fn note_overlaps(sides: &Rows, one: &Sides, within: &mut [u8; WIDTH]) {
    // An empty place holds NaN, which compares with nothing.
    let mut meets = [u32::MAX; WIDTH];
    for axis in 0..3 {
        let (low, high) = (&sides[axis], &sides[axis + 3]);
        for lane in 0..WIDTH {
            let meet = (low[lane] <= one[axis + 3]) & (one[axis] <= high[lane]);
            meets[lane] &= if meet { u32::MAX } else { 0 };
        }
    }
    for lane in 0..WIDTH {
        within[lane] = (meets[lane] & 1) as u8;
    }
}

/// A box that moves along a line, or a ray. Places are times, in lengths of the direction after it was scaled to about
/// 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// On which axes the upper side of a box is met first.
    is_backward: [bool; 3],
    /// The coordinates from which times are measured, each repeated for four lanes.
    from_near: [[f32; 4]; 3],
    from_far: [[f32; 4]; 3],
    /// Time per metre, rounded down and up by more than all later rounding can add up to. Infinite without motion.
    per_near: [[f32; 4]; 3],
    per_far: [[f32; 4]; 3],
    /// Units of time per length of the given direction, a power of two.
    unit: f64,
}

impl Line {
    /// `None` if a number is not finite or a half extent negative.
    #[inline(always)]
    pub(crate) fn new(from: DVec3, direction: DVec3, grown: Vec3) -> Option<Self> {
        let grown = grown.as_dvec3();
        let is_good = from.is_finite() && direction.is_finite() && grown.is_finite();
        if !is_good || grown.min_element() < 0.0 {
            return None;
        }
        let longest = direction.abs().max_element();
        // The power of two below the longest component, so that nothing overflows early.
        let power = f64::from_bits(longest.to_bits() & (0x7ff << 52)).max(f64::MIN_POSITIVE);
        let unit = if longest > 0.0 { power } else { 1.0 };
        let axis = |from: f64, direction: f64, grown: f64| {
            let lost = (from.abs() + grown) * (4.0 * f64::EPSILON);
            let (low, high) = (round_down(from - grown - lost), round_up(from + grown + lost));
            let per = unit / direction.abs();
            let most = if direction == 0.0 { f32::INFINITY } else { f32::MAX };
            let per_near = ((per * (1.0 - LOST)) as f32).min(most);
            let per_far = (per * (1.0 + LOST)) as f32;
            let is_backward = direction < 0.0;
            if is_backward {
                (is_backward, low, high, -per_near, -per_far)
            } else {
                (is_backward, high, low, per_near, per_far)
            }
        };
        let x = axis(from.x, direction.x, grown.x);
        let y = axis(from.y, direction.y, grown.y);
        let z = axis(from.z, direction.z, grown.z);
        Some(Self {
            is_backward: [x.0, y.0, z.0],
            from_near: [[x.1; 4], [y.1; 4], [z.1; 4]],
            from_far: [[x.2; 4], [y.2; 4], [z.2; 4]],
            per_near: [[x.3; 4], [y.3; 4], [z.3; 4]],
            per_far: [[x.4; 4], [y.4; 4], [z.4; 4]],
            unit,
        })
    }
}

impl Ask for Line {
    /// A NaN comes from a side that is touched all the way. It is no bound, and comparisons drop it.
    ///
    /// Not inlined, with its result in memory: inlined into the walk, the lanes were scalarised (250 instructions per
    /// node, in place of 95; AMD EPYC, Zen 4, 2026-11-22).
    #[inline(never)]
    fn find(&self, sides: &Rows, slots: &[u32; WIDTH], limit: f32, found: &mut Found) {
        let (mut enter, mut leave) = ([0.0; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let (low, high) = (&sides[axis], &sides[axis + 3]);
            let (near, far) = if self.is_backward[axis] { (high, low) } else { (low, high) };
            for lane in 0..WIDTH {
                let first = (near[lane] - self.from_near[axis][lane % 4]) * self.per_near[axis][lane % 4];
                let last = (far[lane] - self.from_far[axis][lane % 4]) * self.per_far[axis][lane % 4];
                enter[lane] = if first > enter[lane] { first } else { enter[lane] };
                leave[lane] = if last < leave[lane] { last } else { leave[lane] };
            }
        }
        found.places = enter;
        for lane in 0..WIDTH {
            found.within[lane] = u8::from((enter[lane] <= leave[lane]) & (slots[lane] != EMPTY));
        }
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        let limit = limit * self.unit * (1.0 + LOST);
        if limit >= 0.0 { round_up(limit).min(f32::MAX) } else { -1.0 }
    }
}

/// The query for boxes near a box. Places are squared distances in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near(Sides);

impl Near {
    /// `None` if the box is empty.
    pub(crate) fn new(bounds: &Aabb3) -> Option<Self> {
        let ([a, b, c], [d, e, f]) = bounds.corners();
        bounds.is_valid().then_some(Self([a, b, c, d, e, f]))
    }
}

impl Ask for Near {
    #[inline(never)]
    fn find(&self, sides: &Rows, slots: &[u32; WIDTH], limit: f32, found: &mut Found) {
        let mut squares = [0.0; WIDTH];
        for axis in 0..3 {
            let (low, high) = (&sides[axis], &sides[axis + 3]);
            for (lane, square) in squares.iter_mut().enumerate() {
                let (above, below) = (low[lane] - self.0[axis + 3], self.0[axis] - high[lane]);
                let gap = if above > 0.0 { above } else { 0.0 };
                let gap = if below > gap { below } else { gap };
                *square += gap * gap;
            }
        }
        for square in &mut squares {
            // Denormal squares are too inexact to compare, and become 0; overflow is clamped to the greatest number.
            *square = if *square >= f32::MIN_POSITIVE { *square } else { 0.0 };
            *square = if *square < f32::MAX { *square } else { f32::MAX };
        }
        found.places = squares;
        for lane in 0..WIDTH {
            found.within[lane] = u8::from((squares[lane] <= limit) & (slots[lane] != EMPTY));
        }
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        let limit = limit * (1.0 + 2.0 * LOST);
        // Squares below that of 1e-19 m count as 0.
        if limit >= 0.0 { ((limit * limit) as f32).clamp(f32::MIN_POSITIVE, f32::MAX) } else { -1.0 }
    }
}
