//! Picks four of the corners of a patch: those that `super::super::reduce` picks, found side by side.
//!
//! ```text
//! put the corners clockwise in eight places, the last one repeated
//! 70 quadrilaterals: ten shapes (steps from corner to corner) times eight first corners cover each once or twice
//! twice the area of each = the cross product of its diagonals
//! ```
//! All of them are evaluated, since that takes no branch: the walk around the patch, which finds the same, takes six
//! times as long (AMD EPYC, Zen 4, 2026-11-21). Areas are only compared, so f32 is enough. If the largest holds no
//! corner that counts as deepest, or another is as large up to [`EVEN_AREA`], the walk decides: it breaks ties by the
//! features of the corners, which stay the same while a body trembles.

use super::super::reduce::{Spot, pick_four};
use super::patch::{Patch, SLOTS};
use asunder_geometry::tolerance::EVEN_AREA;

/// The most corners that the common patch of two rectangles has.
pub(super) const MOST: usize = 8;

/// Steps from the first corner to the third, from the first to the second, and from the second to the fourth.
const SHAPES: [[usize; 3]; 10] = [
    [4, 2, 4],
    [4, 1, 4],
    [3, 2, 3],
    [4, 3, 3],
    [4, 2, 3],
    [4, 3, 2],
    [3, 1, 3],
    [3, 2, 2],
    [2, 1, 3],
    [2, 1, 2],
];

/// The bits of an area that hold the quadrilateral's number.
const NUMBER: u32 = 127;

/// Factors for the area of each quadrilateral, for five to eight corners: 1 for each set of four corners once, else 0,
/// so that two equal areas are of two different sets.
const ANY: [Weights; 4] = [weights(5, false), weights(6, false), weights(7, false), weights(8, false)];

/// The same if the first corner must be kept.
const ROOTED: [Weights; 4] = [weights(5, true), weights(6, true), weights(7, true), weights(8, true)];

/// By shape and beginning.
type Weights = [[f32; 8]; 10];

const fn weights(count: usize, is_rooted: bool) -> Weights {
    let mut weights = [[0.0; 8]; 10];
    // Sets of places.
    let mut is_met = [false; 256];
    let mut number = 0;
    while number < 80 {
        let [a, b, c, d] = corners(number / 8, number % 8);
        let set: usize = 1 << a | 1 << b | 1 << c | 1 << d;
        if !is_met[set] && set >> count == 0 && (!is_rooted || set & 1 == 1) {
            weights[number / 8][number % 8] = 1.0;
        }
        is_met[set] = true;
        number += 1;
    }
    weights
}

/// The places of a quadrilateral's corners.
const fn corners(shape: usize, begin: usize) -> [usize; 4] {
    let [third, second, fourth] = SHAPES[shape % 10];
    [begin % 8, (begin + second) % 8, (begin + third) % 8, (begin + second + fourth) % 8]
}

/// Slots of four corners of a patch, out of more than four and no more than eight, which are listed clockwise. Those no
/// higher than `even` count as deepest.
#[inline(always)]
pub(super) fn four_of(patch: &Patch, slots: &[usize; MOST], count: usize, even: f64) -> [usize; 4] {
    let is_deep = |slot: usize| patch.height[slot % SLOTS] <= even;
    let mut deep = 0_u32;
    for i in 0..count {
        deep |= u32::from(is_deep(slots[i % MOST])) << i;
    }
    // A corner that is deeper than all others must be kept, and comes first.
    let is_alone = deep.count_ones() == 1;
    let first = if is_alone { deep.trailing_zeros() as usize } else { 0 };
    let mut around = [0; MOST];
    for (place, slot) in around.iter_mut().enumerate() {
        let i = if place < count { place } else { count - 1 } + first;
        *slot = slots[if i < count { i } else { i - count } % MOST];
    }
    let weights = if is_alone { &ROOTED } else { &ANY };
    let found = largest(patch, &around, &weights[count.clamp(5, MOST) - 5]);
    let four = found.map(|found| [around[found[0]], around[found[1]], around[found[2]], around[found[3]]]);
    match four.filter(|four| four.iter().any(|&slot| is_deep(slot))) {
        Some(four) => four,
        None => walk(patch, &slots[..count.min(MOST)], even),
    }
}

/// The quadrilateral with the largest weighted area; `None` if another is as large up to what counts as even.
#[inline(always)]
fn largest(patch: &Patch, around: &[usize; MOST], weights: &Weights) -> Option<[usize; 4]> {
    let mut places = [[0.0_f32; 12]; 2];
    // Relative to one of them, before anything is rounded: they may lie far out on a huge face.
    let first = around[0] % SLOTS;
    let [from_u, from_v] = [patch.u[first], patch.v[first]];
    for i in 0..12 {
        let slot = around[i % MOST] % SLOTS;
        (places[0][i], places[1][i]) = ((patch.u[slot] - from_u) as f32, (patch.v[slot] - from_v) as f32);
    }
    let mut diagonals = [[[0.0; 12]; 2]; 3];
    fill_diagonals(&places, &mut diagonals);
    let mut areas = [[0.0; 8]; 10];
    fill_areas(&diagonals, weights, &mut areas);
    let mut best = [0.0; 8];
    fill_best(&areas, &mut best);
    let [a, b, c, d, e, f, g, h] = best;
    let greatest = greater(greater(greater(a, b), greater(c, d)), greater(greater(e, f), greater(g, h)));
    let number = (greatest.to_bits() & NUMBER) as usize;
    let even = f32::from_bits(greatest.to_bits() & !NUMBER) * (1.0 - EVEN_AREA as f32);
    (count_from(&areas, even) == 1).then(|| corners(number / 8, number % 8))
}

/// How many areas are at least this large.
#[inline(always)]
fn count_from(areas: &[[f32; 8]; 10], even: f32) -> u32 {
    let mut counts = [0_u32; 8];
    for areas in areas {
        for i in 0..8 {
            counts[i] += u32::from(areas[i] >= even);
        }
    }
    counts.iter().sum()
}

#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Indexed by the number of corners they lead on, less two; by coordinate; by corner, with the first few again at the
/// end.
type Diagonals = [[[f32; 12]; 2]; 3];

/// From memory to memory, here and below, so that LLVM sees eight lanes. Kept in registers throughout, it comes out
/// scalar.
#[inline(never)]
fn fill_diagonals(places: &[[f32; 12]; 2], diagonals: &mut Diagonals) {
    for (on, diagonals) in diagonals.iter_mut().enumerate() {
        for (places, diagonals) in places.iter().zip(diagonals) {
            for i in 0..8 {
                diagonals[i] = places[i + on + 2] - places[i];
            }
            for i in 8..12 {
                diagonals[i] = places[(i + on + 2) % 8] - places[i - 8];
            }
        }
    }
}

#[inline(never)]
fn fill_areas(diagonals: &Diagonals, weights: &Weights, areas: &mut [[f32; 8]; 10]) {
    fill_area::<0>(diagonals, weights, areas);
    fill_area::<1>(diagonals, weights, areas);
    fill_area::<2>(diagonals, weights, areas);
    fill_area::<3>(diagonals, weights, areas);
    fill_area::<4>(diagonals, weights, areas);
    fill_area::<5>(diagonals, weights, areas);
    fill_area::<6>(diagonals, weights, areas);
    fill_area::<7>(diagonals, weights, areas);
    fill_area::<8>(diagonals, weights, areas);
    fill_area::<9>(diagonals, weights, areas);
}

/// All quadrilaterals of one shape.
#[inline(always)]
fn fill_area<const SHAPE: usize>(diagonals: &Diagonals, weights: &Weights, areas: &mut [[f32; 8]; 10]) {
    let [third, second, fourth] = SHAPES[SHAPE];
    let ([one_u, one_v], [other_u, other_v]) = (&diagonals[third - 2], &diagonals[fourth - 2]);
    for i in 0..8 {
        let area = one_v[i] * other_u[i + second] - one_u[i] * other_v[i + second];
        // Numbered in the lowest bits, so that the greatest float tells which quadrilateral it is.
        let numbered = (area * weights[SHAPE][i]).to_bits() & !NUMBER | (8 * SHAPE + i) as u32;
        areas[SHAPE][i] = f32::from_bits(numbered);
    }
}

#[inline(never)]
fn fill_best(areas: &[[f32; 8]; 10], best: &mut [f32; 8]) {
    for i in 0..8 {
        let column = |shape: usize| areas[shape][i];
        let one = greater(greater(column(0), column(1)), greater(column(2), column(3)));
        let other = greater(greater(column(4), column(5)), greater(column(6), column(7)));
        best[i] = greater(greater(one, other), greater(column(8), column(9)));
    }
}

/// The walk that all other shapes use.
#[cold]
#[inline(never)]
fn walk(patch: &Patch, slots: &[usize], even: f64) -> [usize; 4] {
    let Patch { u, v, height, .. } = patch;
    let slot = |i: usize| slots[i] % SLOTS;
    let spot = |i: usize| Spot { at: [u[slot(i)], v[slot(i)]], separation: height[slot(i)] };
    let deepest = slots.iter().map(|&slot| height[slot % SLOTS]).fold(f64::INFINITY, f64::min);
    pick_four(slots.len(), spot, |i| patch.names(slot(i)).id(), even - deepest).map(slot)
}
