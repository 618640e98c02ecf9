//! What a tree is asked.

use super::{EMPTY, IS_BOX, MOST_DEPTH, Node, Sides, Tree, WIDTH};
use crate::aabb::{Aabb3, Bounds};
use crate::outward::{round_down, round_up};
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};

/// What waits while another is looked at: all but one of each node that stands above it.
const STACK: usize = WIDTH * (MOST_DEPTH + 1);

/// Three roundings to f32 stand between a corner and a time, and five between corners and the square of a distance,
/// of at most 2^-24 each.
const LOST: f64 = 1.0 / 4_194_304.0;

/// A question about an order: one rule for nodes and boxes, monotone under rounding, so that no box comes before the node
/// around it.
pub(crate) trait Ask {
    /// Where each of eight boxes comes in the order; beyond the limit, anything above it. Of empty places, anything.
    fn places(&self, sides: &[[f32; WIDTH]; 6], limit: f32) -> [f32; WIDTH];
    /// A limit, as places are told; below zero, if nothing is within it.
    fn within(&self, limit: f64) -> f32;
}

impl Tree {
    /// Hands the number of every box that overlaps this one to `visitor`, each once, until it breaks off.
    #[inline]
    pub(crate) fn visit_overlapping(
        &self,
        bounds: &Aabb3,
        mut visitor: impl FnMut(u32) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        if self.nodes.is_empty() || !bounds.is_valid() {
            return ControlFlow::Continue(());
        }
        let ([a, b, c], [d, e, f]) = bounds.corners();
        let one: Sides = [a, b, c, d, e, f];
        let mut stack = [0_u32; STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let node = &self.nodes[stack[waiting] as usize];
            let mut hits = overlapping(node, &one);
            while hits != 0 {
                let slot = node.slots[hits.trailing_zeros() as usize % WIDTH];
                hits &= hits - 1;
                if slot & IS_BOX == 0 {
                    stack[waiting] = slot;
                    waiting += 1;
                } else {
                    visitor(slot & !IS_BOX)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Hands boxes to `visitor` that are within a limit, of each node the first in the order before all others. What
    /// it returns is the limit from then on, unless it was lower before.
    #[inline]
    pub(crate) fn visit_in_order(&self, ask: &impl Ask, limit: f64, mut visitor: impl FnMut(u32) -> f64) {
        let mut limit = ask.within(limit);
        if self.nodes.is_empty() {
            return;
        }
        let mut stack = [(0.0_f32, 0_u32); STACK];
        let mut waiting = 1;
        while waiting > 0 {
            waiting -= 1;
            let (place, slot) = stack[waiting];
            // A limit below zero ends here.
            if place > limit {
                continue;
            }
            if slot & IS_BOX != 0 {
                let wanted = ask.within(visitor(slot & !IS_BOX));
                limit = if wanted < limit { wanted } else { limit };
                continue;
            }
            let node = &self.nodes[slot as usize];
            let places = ask.places(&node.sides, limit);
            let (first, mut bits) = (waiting, within(&places, &node.slots, limit));
            while bits != 0 {
                let lane = bits.trailing_zeros() as usize % WIDTH;
                bits &= bits - 1;
                let place = places[lane];
                // The nearest goes on top; of equals, the one in the earlier place.
                let mut at = waiting;
                while at > first && stack[at - 1].0 <= place {
                    stack[at] = stack[at - 1];
                    at -= 1;
                }
                stack[at] = (place, node.slots[lane]);
                waiting += 1;
            }
        }
    }
}

/// Which of eight boxes are within a limit.
#[inline(always)]
fn within(places: &[f32; WIDTH], slots: &[u32; WIDTH], limit: f32) -> u32 {
    let mut bits: [u32; WIDTH] = [1, 2, 4, 8, 16, 32, 64, 128];
    for lane in 0..WIDTH {
        let is_within = (places[lane] <= limit) & (slots[lane] != EMPTY);
        bits[lane] = if is_within { bits[lane] } else { 0 };
    }
    all_of(bits)
}

/// All bits of eight lanes.
#[inline(always)]
fn all_of([a, b, c, d, e, f, g, h]: [u32; WIDTH]) -> u32 {
    ((a | e) | (b | f)) | ((c | g) | (d | h))
}

/// Which of the eight boxes a box overlaps.
#[inline(always)]
fn overlapping(node: &Node, one: &Sides) -> u32 {
    // An empty place holds NaN, which compares with nothing.
    let mut bits: [u32; WIDTH] = [1, 2, 4, 8, 16, 32, 64, 128];
    for axis in 0..3 {
        let (low, high) = (&node.sides[axis], &node.sides[axis + 3]);
        for lane in 0..WIDTH {
            let meets = (low[lane] <= one[axis + 3]) & (one[axis] <= high[lane]);
            bits[lane] = if meets { bits[lane] } else { 0 };
        }
    }
    all_of(bits)
}

/// A box that moves on a line, or a ray. Places are times, in lengths of the direction after it was made about as long
/// as 1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// On each axis, which side of a box is met first and last, as rows of a node.
    near: [usize; 3],
    far: [usize; 3],
    /// From where that is measured.
    from_near: [f32; 3],
    from_far: [f32; 3],
    /// Times a metre, rounded down and up by more than all that follows can lose. Infinite where nothing moves.
    per_near: [f32; 3],
    per_far: [f32; 3],
    /// Times in a length of the direction as it was given, a power of two.
    unit: f64,
}

impl Line {
    /// Nothing where a number is not finite, or a half extent negative.
    pub(crate) fn new(from: DVec3, direction: DVec3, grown: Vec3) -> Option<Self> {
        let grown = grown.as_dvec3();
        let is_good = from.is_finite() && direction.is_finite() && grown.is_finite();
        if !is_good || grown.min_element() < 0.0 {
            return None;
        }
        let longest = direction.abs().max_element();
        // The power of two below the longest part, so that nothing overflows early.
        let power = f64::from_bits(longest.to_bits() & (0x7ff << 52)).max(f64::MIN_POSITIVE);
        let unit = if longest > 0.0 { power } else { 1.0 };
        let lost = (from.abs() + grown) * (4.0 * f64::EPSILON);
        let (low, high) = (from - grown - lost, from + grown + lost);
        let mut line = Self {
            near: [0, 1, 2],
            far: [3, 4, 5],
            from_near: [round_up(high.x), round_up(high.y), round_up(high.z)],
            from_far: [round_down(low.x), round_down(low.y), round_down(low.z)],
            per_near: [0.0; 3],
            per_far: [0.0; 3],
            unit,
        };
        for axis in 0..3 {
            let per = unit / direction[axis].abs();
            let is_backward = direction[axis] < 0.0;
            let sign = if is_backward { -1.0 } else { 1.0 };
            if is_backward {
                core::mem::swap(&mut line.near[axis], &mut line.far[axis]);
                core::mem::swap(&mut line.from_near[axis], &mut line.from_far[axis]);
            }
            let most = if direction[axis] == 0.0 { f32::INFINITY } else { f32::MAX };
            line.per_near[axis] = sign * ((per * (1.0 - LOST)) as f32).min(most);
            line.per_far[axis] = sign * (per * (1.0 + LOST)) as f32;
        }
        Some(line)
    }
}

impl Ask for Line {
    /// A NaN comes from a side that is touched all the way, and bounds nothing: comparisons drop it.
    #[inline(always)]
    fn places(&self, sides: &[[f32; WIDTH]; 6], limit: f32) -> [f32; WIDTH] {
        let (mut enter, mut leave) = ([0.0; WIDTH], [limit; WIDTH]);
        for axis in 0..3 {
            let (near, far) = (&sides[self.near[axis]], &sides[self.far[axis]]);
            for lane in 0..WIDTH {
                let first = (near[lane] - self.from_near[axis]) * self.per_near[axis];
                let last = (far[lane] - self.from_far[axis]) * self.per_far[axis];
                enter[lane] = if first > enter[lane] { first } else { enter[lane] };
                leave[lane] = if last < leave[lane] { last } else { leave[lane] };
            }
        }
        for lane in 0..WIDTH {
            enter[lane] = if enter[lane] <= leave[lane] { enter[lane] } else { f32::INFINITY };
        }
        enter
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        let limit = limit * self.unit * (1.0 + LOST);
        if limit >= 0.0 { round_up(limit).min(f32::MAX) } else { -1.0 }
    }
}

/// How near to a box others are. Places are squares of metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near(Sides);

impl Near {
    /// Nothing where the box is empty.
    pub(crate) fn new(bounds: &Aabb3) -> Option<Self> {
        let ([a, b, c], [d, e, f]) = bounds.corners();
        bounds.is_valid().then_some(Self([a, b, c, d, e, f]))
    }
}

impl Ask for Near {
    #[inline(always)]
    fn places(&self, sides: &[[f32; WIDTH]; 6], _: f32) -> [f32; WIDTH] {
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
            // Denormal squares have lost too much to say who is nearer; infinite ones are the limit of what can be told.
            *square = if *square >= f32::MIN_POSITIVE { *square } else { 0.0 };
            *square = if *square < f32::MAX { *square } else { f32::MAX };
        }
        squares
    }

    #[inline(always)]
    fn within(&self, limit: f64) -> f32 {
        let limit = limit * (1.0 + 2.0 * LOST);
        // The least square that counts is the square of 1e-19 m.
        if limit >= 0.0 { ((limit * limit) as f32).clamp(f32::MIN_POSITIVE, f32::MAX) } else { -1.0 }
    }
}
