//! Four of the corners of a patch: as `super::super::reduce` chooses, in the plane of the reference face.

use super::patch::Patch;

/// The most corners that two rectangles' common patch has.
const MOST: usize = 8;

/// Slots of four corners of at least five: the deepest, the furthest from it, and so on; ties go to the lowest id.
#[inline(never)]
pub(super) fn four_of(patch: &Patch, is_b: bool) -> [usize; 4] {
    let (mut slots, mut count, mut rest) = ([0; MOST], 0, patch.held);
    while rest != 0 && count < MOST {
        slots[count] = rest.trailing_zeros() as usize;
        count += 1;
        rest &= rest - 1;
    }
    let slots = &slots[..count];
    // Distances are those of the points on A, which are not in one plane where B's face measures.
    let rise = if is_b { 1.0 } else { 0.0 };
    let Patch { u, v, height, .. } = patch;
    let apart = |i: usize, j: usize| {
        let (u, v, height) = (u[i] - u[j], v[i] - v[j], rise * (height[i] - height[j]));
        u * u + v * v + height * height
    };
    let doubled_area =
        |a: usize, b: usize, c: usize| (u[b] - u[a]) * (v[c] - v[a]) - (v[b] - v[a]) * (u[c] - u[a]);
    let best = |score: &dyn Fn(usize) -> f64| best(patch, slots, score);
    let first = best(&|i| -height[i]);
    let second = best(&|i| apart(i, first));
    let third = best(&|i| doubled_area(first, second, i).abs());
    let sense = if doubled_area(first, second, third) < 0.0 { 1.0 } else { -1.0 };
    let triangle = [first, second, third];
    let beyond = |i: usize| {
        let side = |k: usize| sense * doubled_area(triangle[k], triangle[(k + 1) % 3], i);
        side(0).max(side(1)).max(side(2))
    };
    [first, second, third, best(&beyond)]
}

#[inline(always)]
fn best(patch: &Patch, slots: &[usize], score: &dyn Fn(usize) -> f64) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for &slot in slots {
        let found = score(slot);
        if found > best.1 || (found == best.1 && patch.names(slot) < patch.names(best.0)) {
            best = (slot, found);
        }
    }
    best.0
}
