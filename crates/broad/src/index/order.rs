//! Sorts boxes along a space-filling curve.

use super::node::Sides;

/// A box to be sorted: its key in the upper half, its number in the lower.
pub(super) type Item = u64;

/// Scratch memory of the sort.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    others: Vec<Item>,
    counts: Vec<u32>,
}

/// Most bits of a key.
const MOST_BITS: usize = 32;

/// Bits of a coordinate.
const COORDINATE: u32 = 16;

/// A giant is wider than this many cells, each of which holds about one node's boxes.
const GIANT: f64 = 4.0;

/// So few boxes have no giants: setting them apart would not matter.
const FEW: usize = 64;

/// So few boxes are sorted along one axis instead: setting up a curve costs some microseconds. A long row of boxes
/// makes many such handfuls, as there are only so many different keys along one axis.
const HANDFUL: usize = 24;

/// Sorts the boxes along the curve, with giants behind all others in no useful order; returns how many are not giants.
pub(super) fn sort(items: &mut [Item], scratch: &mut Scratch, sides: impl Fn(u32) -> Sides) -> usize {
    if items.len() <= HANDFUL {
        line(items, &sides);
        return items.len();
    }
    let curve = Curve::through(items, &sides);
    scratch.others.clear();
    let (mut ordinary, most) = (0, if items.len() > FEW { curve.giant } else { f32::INFINITY });
    for place in 0..items.len() {
        let number = items[place] as u32;
        let one = sides(number);
        let width = (one[3] - one[0]).max(one[4] - one[1]).max(one[5] - one[2]);
        if width <= most {
            items[ordinary] = u64::from(curve.key(&one)) << 32 | u64::from(number);
            ordinary += 1;
        } else {
            scratch.others.push(u64::from(number));
        }
    }
    // If all are giants, none is treated as one.
    if ordinary == 0 {
        for item in &mut *items {
            let number = *item as u32;
            *item = u64::from(curve.key(&sides(number))) << 32 | u64::from(number);
        }
        ordinary = items.len();
    } else {
        items[ordinary..].copy_from_slice(&scratch.others);
    }
    radix(&mut items[..ordinary], scratch, curve.bits);
    ordinary
}

/// Sorts boxes by their centres on the axis on which these are spread widest.
fn line(items: &mut [Item], sides: &impl Fn(u32) -> Sides) {
    let (low, high) = centers(items, sides);
    let width = |axis: usize| f64::from(high[axis]) - f64::from(low[axis]);
    let axis = (0..3).max_by(|&a, &b| width(a).total_cmp(&width(b))).unwrap_or(0);
    for item in &mut *items {
        let number = *item as u32;
        let bits = center(&sides(number), axis).to_bits();
        // Flips all bits of negative numbers and the sign of others, so that unsigned keys have the order of the
        // floats.
        let key = bits ^ if bits >> 31 == 0 { 1 << 31 } else { u32::MAX };
        *item = u64::from(key) << 32 | u64::from(number);
    }
    items.sort_unstable();
}

/// Least and greatest finite centres on each axis.
fn centers(items: &[Item], sides: &impl Fn(u32) -> Sides) -> ([f32; 3], [f32; 3]) {
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for &item in items {
        let one = sides(item as u32);
        for axis in 0..3 {
            let center = center(&one, axis);
            if center.abs() <= f32::MAX {
                low[axis] = if center < low[axis] { center } else { low[axis] };
                high[axis] = if center > high[axis] { center } else { high[axis] };
            }
        }
    }
    (low, high)
}

/// Centre of a box on an axis; NaN or infinite if the box has none.
#[inline(always)]
fn center(sides: &Sides, axis: usize) -> f32 {
    sides[axis] * 0.5 + sides[axis + 3] * 0.5
}

/// A Z-order curve with cells as near to cubes as halving allows: each bit halves cells along their longest axis.
struct Curve {
    low: [f32; 3],
    scale: [f32; 3],
    bits: u32,
    giant: f32,
    /// The key bits for the lower and upper byte of each coordinate.
    spread: [[[u32; 256]; 2]; 3],
}

impl Curve {
    fn through(items: &[Item], sides: &impl Fn(u32) -> Sides) -> Self {
        let (low, high) = centers(items, sides);
        let mut curve = Self { low, scale: [0.0; 3], bits: 0, giant: 0.0, spread: [[[0; 256]; 2]; 3] };
        let mut cell = [0.0; 3];
        for axis in 0..3 {
            let width = f64::from(high[axis]) - f64::from(low[axis]);
            // Otherwise no box has a centre here, or all have the same.
            if width > 0.0 {
                cell[axis] = width;
                curve.scale[axis] = (65_536.0 / width).min(f64::from(f32::MAX)) as f32;
            }
        }
        curve.halve(cell, items.len());
        curve
    }

    fn halve(&mut self, mut cell: [f64; 3], count: usize) {
        let nodes = usize::BITS - (count / 8).leading_zeros();
        let (mut taken, mut halved) = ([0; 3], [0_u8; MOST_BITS]);
        let most = (nodes as usize + 9).min(MOST_BITS);
        let longest = |cell: &[f64; 3]| (0..3).max_by(|&a, &b| cell[a].total_cmp(&cell[b])).unwrap_or(0);
        for (bit, halved) in halved.iter_mut().take(most).enumerate() {
            let axis = longest(&cell);
            if bit == nodes as usize {
                self.giant = (cell[axis] * GIANT) as f32;
            }
            if cell[axis] == 0.0 {
                break;
            }
            *halved = axis as u8;
            taken[axis] += 1;
            cell[axis] = if taken[axis] < COORDINATE { cell[axis] * 0.5 } else { 0.0 };
            self.bits += 1;
        }
        // Maps each bit of each coordinate to its key bit.
        let (mut to, mut next) = ([[0_u32; COORDINATE as usize]; 3], [COORDINATE as usize; 3]);
        for (bit, &axis) in halved.iter().take(self.bits as usize).enumerate() {
            let axis = usize::from(axis);
            next[axis] -= 1;
            to[axis][next[axis]] = 1 << (self.bits as usize - 1 - bit);
        }
        for (axis, tables) in self.spread.iter_mut().enumerate() {
            for (byte, table) in tables.iter_mut().enumerate() {
                for bit in 0..8 {
                    for value in 0..1 << bit {
                        table[value | 1 << bit] = table[value] | to[axis][byte * 8 + bit];
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn key(&self, sides: &Sides) -> u32 {
        let mut key = 0;
        for axis in 0..3 {
            let scaled = (center(sides, axis) - self.low[axis]) * self.scale[axis];
            // NaN becomes 0.
            let code = scaled.clamp(0.0, 65_535.0) as u16;
            key |=
                self.spread[axis][0][usize::from(code & 255)] | self.spread[axis][1][usize::from(code >> 8)];
        }
        key
    }
}

/// Most bits of a digit, so that its counters fit the nearest cache.
const DIGIT: u32 = 11;

/// Sorts by the lower bits of the keys, least digit first.
fn radix(items: &mut [Item], scratch: &mut Scratch, bits: u32) {
    if items.len() < 256 || bits == 0 {
        items.sort_unstable();
        return;
    }
    let passes = bits.div_ceil(DIGIT);
    let digit = bits.div_ceil(passes);
    let size = 1 << digit;
    let place = |item: u64, pass: u32| (item >> (32 + pass * digit)) as usize & (size - 1);
    scratch.others.clear();
    scratch.others.resize(items.len(), 0);
    scratch.counts.clear();
    scratch.counts.resize(size * passes as usize, 0);
    for &item in &*items {
        for (pass, counts) in (0..).zip(scratch.counts.chunks_exact_mut(size)) {
            counts[place(item, pass)] += 1;
        }
    }
    let (mut from, mut to) = (&mut *items, &mut scratch.others[..]);
    for (pass, counts) in (0..).zip(scratch.counts.chunks_exact_mut(size)) {
        let mut sum = 0;
        for count in counts.iter_mut() {
            sum += core::mem::replace(count, sum);
        }
        for &item in &*from {
            let next = &mut counts[place(item, pass)];
            to[*next as usize] = item;
            *next += 1;
        }
        core::mem::swap(&mut from, &mut to);
    }
    if passes % 2 == 1 {
        to.copy_from_slice(from);
    }
}

impl Scratch {
    pub(super) fn bytes(&self) -> usize {
        self.others.capacity() * size_of::<Item>() + self.counts.capacity() * 4
    }
}
