//! Eight boxes side by side, and the tests against all of them.

use super::cast::Cast;

/// Minimum, then maximum.
pub(crate) type Sides = [f32; 6];

/// Boxes in a node.
pub(crate) const WIDTH: usize = 8;

/// A node: up to eight boxes, first the bounds of child nodes, then boxes of the caller. Four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// A row for each side, so that eight boxes are tested by the same instructions.
    pub(crate) sides: [[f32; WIDTH]; 6],
    /// The number of the child node or of the caller's box in each slot.
    slots: [u32; WIDTH],
    /// How many of them are nodes.
    inner: u32,
    /// How many slots are used.
    used: u32,
}

impl Node {
    pub(crate) const EMPTY: Self =
        Self { sides: [[f32::NAN; WIDTH]; 6], slots: [0; WIDTH], inner: 0, used: 0 };

    /// Appends a box. Nodes must come first.
    pub(crate) fn push(&mut self, sides: &Sides, slot: u32, is_node: bool) {
        let at = self.used as usize % WIDTH;
        for (row, &side) in self.sides.iter_mut().zip(sides) {
            row[at] = side;
        }
        self.slots[at] = slot;
        self.inner += u32::from(is_node);
        self.used += 1;
    }

    /// The nodes, and the numbers of the boxes, that the bits of a mask stand for.
    #[inline(always)]
    pub(crate) fn parts(&self, mask: u32) -> (Slots<'_>, Slots<'_>) {
        let nodes = mask & ((1 << self.inner) - 1);
        (Slots { slots: &self.slots, mask: nodes }, Slots { slots: &self.slots, mask: mask ^ nodes })
    }

    /// Which of the eight boxes a box overlaps.
    #[inline(always)]
    pub(crate) fn overlapping(&self, one: &Sides) -> u32 {
        // An empty slot holds NaN, which compares with nothing.
        let mut bits = BITS;
        for axis in 0..3 {
            let (low, high) = (&self.sides[axis], &self.sides[axis + 3]);
            for lane in 0..WIDTH {
                let meets = (low[lane] <= one[axis + 3]) & (one[axis] <= high[lane]);
                bits[lane] = if meets { bits[lane] } else { 0 };
            }
        }
        any(&bits)
    }
}

/// ORs all bits by halves, as vector code does.
#[inline(always)]
const fn any(bits: &[u32; WIDTH]) -> u32 {
    let [a, b, c, d, e, f, g, h] = *bits;
    ((a | e) | (b | f)) | ((c | g) | (d | h))
}

/// Which of eight boxes pass a test, and the distance of each.
pub(crate) struct Far {
    pub(crate) mask: u32,
    pub(crate) distances: [f32; WIDTH],
}

impl Node {
    /// Which of the eight boxes a cast meets before the limit, and where.
    ///
    /// A NaN comes from a side that is touched all the way, or from two infinite numbers. It is no bound, and
    /// comparisons drop it.
    #[inline(always)]
    pub(crate) fn crossed(&self, cast: &Cast, limit: f32) -> Far {
        let [mut enter, mut leave] = [[0.0; WIDTH], [limit; WIDTH]];
        for axis in 0..3 {
            let (near, far) = (&self.sides[cast.near[axis]], &self.sides[cast.far[axis]]);
            for lane in 0..WIDTH {
                let first = (near[lane] - cast.from_near[axis]) * cast.per_near[axis];
                let last = (far[lane] - cast.from_far[axis]) * cast.per_far[axis];
                enter[lane] = if first > enter[lane] { first } else { enter[lane] };
                leave[lane] = if last < leave[lane] { last } else { leave[lane] };
            }
        }
        let mut bits = BITS;
        for lane in 0..WIDTH {
            bits[lane] = if enter[lane] <= leave[lane] { bits[lane] } else { 0 };
        }
        Far { mask: any(&bits) & self.present(), distances: enter }
    }

    /// Which of the eight boxes are no further than the limit, and their squared distances.
    #[inline(always)]
    pub(crate) fn near(&self, one: &Sides, limit: f32) -> Far {
        let mut squares = [0.0; WIDTH];
        for axis in 0..3 {
            let (low, high) = (&self.sides[axis], &self.sides[axis + 3]);
            for (lane, square) in squares.iter_mut().enumerate() {
                let (above, below) = (low[lane] - one[axis + 3], one[axis] - high[lane]);
                // NaN comes from two infinite sides, which touch.
                let gap = if above > 0.0 { above } else { 0.0 };
                let gap = if below > gap { below } else { gap };
                *square += gap * gap;
            }
        }
        let mut bits = BITS;
        for lane in 0..WIDTH {
            // Denormal squares are too inexact to compare, and become 0; overflow is clamped to the greatest number.
            let square = if squares[lane] >= f32::MIN_POSITIVE { squares[lane] } else { 0.0 };
            squares[lane] = if square < f32::MAX { square } else { f32::MAX };
            bits[lane] = if squares[lane] <= limit { bits[lane] } else { 0 };
        }
        Far { mask: any(&bits) & self.present(), distances: squares }
    }

    /// A bit for each slot that is used.
    #[inline(always)]
    pub(crate) const fn present(&self) -> u32 {
        (1 << self.used) - 1
    }
}

const BITS: [u32; WIDTH] = [1, 2, 4, 8, 16, 32, 64, 128];

/// Some slots of a node, in order.
pub(crate) struct Slots<'a> {
    slots: &'a [u32; WIDTH],
    mask: u32,
}

impl Iterator for Slots<'_> {
    /// The slot, and what is in it.
    type Item = (usize, u32);

    #[inline(always)]
    fn next(&mut self) -> Option<(usize, u32)> {
        if self.mask == 0 {
            return None;
        }
        let lane = self.mask.trailing_zeros() as usize % WIDTH;
        self.mask &= self.mask - 1;
        Some((lane, self.slots[lane]))
    }
}
