//! Reduces any number of contact points to four that support a body as well.
//!
//! ```text
//! root = the first corner by its features
//! for each corner opposite the root: the corner furthest out on either side of that diagonal is the best  (rooted)
//! the best four of all have one corner in each arc between neighbours of the four found so;
//! so root at each corner of the arc with the fewest                                                       (for_others)
//! where none of those four counts as deepest: the same again, root = the first of the corners that do
//! ```
//! For a fixed root and a diagonal that turns in one direction, the corners furthest from it move on in the same
//! direction: one pass around the patch finds the best four with that root. That the best of all lie between those is
//! proved by Boyce, Dobkin, Drysdale and Guibas, "Finding extremal polygons" (SIAM Journal on Computing 1985). For five
//! to eight corners all sets of four are tried.
//!
//! Guarantees, for corners in convex position, up to a few [`EVEN_AREA`]:
//! - one of the four counts as deepest, within the given tolerance;
//! - their area is at least that of the best four that hold the first of the deepest corners;
//! - if the best four of all hold a corner that counts as deepest, the area is at least 95 % of theirs, and all of it
//!   for up to [`EVERY_ROOT`] corners in the arc. That is so wherever faces rest on each other, where all corners are
//!   equally deep;
//! - ties between sets of four are broken by the features of their corners alone: a body that trembles on its face
//!   stands on the same four in every frame, and the four are the same as seen from the other shape, unless two corners
//!   have each other's names.
//!
//! The best four that hold a given corner have at least 2/3 of the area of the best of all. The worst case is a
//! trapezoid whose longer side, twice as long as the opposite one, has the deepest corner in its middle. No choice that
//! keeps that corner can do better.

use crate::feature::FeatureId;
use asunder_geometry::tolerance::EVEN_AREA;
use core::array::from_fn;

/// Up to this many corners of an arc, each is tried as a root; of more, this many spread evenly.
const EVERY_ROOT: usize = 8;

/// A corner of a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Its position, as projected along the normal.
    pub(crate) at: [f64; 2],
    /// The separation of the shapes there.
    pub(crate) separation: f64,
}

/// Picks four of more than four corners; returns their indices. The list goes clockwise around a convex patch. Corners
/// no more than `even` above the deepest count as deepest.
pub(crate) fn pick_four<S, I>(count: usize, spot: S, id: I, even: f64) -> [usize; 4]
where
    S: Fn(usize) -> Spot,
    I: Fn(usize) -> FeatureId,
{
    let least = (0..count).map(|i| spot(i).separation).fold(f64::INFINITY, f64::min) + even;
    let is_deep = |i: usize| spot(i).separation <= least;
    let at = |i: usize| spot(i).at;
    // One bit per corner.
    let deep = || (0..count).fold(0, |bits, i| bits | u32::from(is_deep(i)) << i);
    match count {
        5 => pick_of_few::<5>(from_fn(at), deep(), &id),
        6 => pick_of_few::<6>(from_fn(at), deep(), &id),
        7 => pick_of_few::<7>(from_fn(at), deep(), &id),
        8 => pick_of_few::<8>(from_fn(at), deep(), &id),
        _ => pick_of_many(count, at, is_deep, id),
    }
}

/// The order among corners that are worth as much.
fn rank(id: FeatureId) -> ([u32; 2], FeatureId) {
    (id.in_any_order(), id)
}

/// The best four of a few corners that hold a deepest one, by trying all sets of four. `deep` has a bit for each
/// deepest corner.
///
/// `id` is a trait object, not a type parameter, so that there is one copy of the search rather than one for each kind
/// of patch.
fn pick_of_few<const N: usize>(
    places: [[f64; 2]; N],
    deep: u32,
    id: &dyn Fn(usize) -> FeatureId,
) -> [usize; 4] {
    let (mut best, mut most, mut second) = (0b1111, f64::NEG_INFINITY, f64::NEG_INFINITY);
    for_each_four(&places, |four, area| {
        if four & deep == 0 {
            return;
        }
        if area > most {
            (best, most, second) = (four, area, most);
        } else if area > second {
            second = area;
        }
    });
    let even = most - most.abs() * EVEN_AREA;
    if second < even {
        return corners_in(best);
    }
    // A bit for each corner, the highest for the first by rank: of two sets of four, the greater number comes first.
    let ranks: [_; N] = from_fn(|i| (rank(id(i)), i));
    let bits: [u32; N] = from_fn(|i| 1 << (N - 1 - ranks.iter().filter(|&other| *other < ranks[i]).count()));
    let mut greatest = 0;
    for_each_four(&places, |four, area| {
        if four & deep != 0 && area >= even {
            let by_rank = corners_in(four).into_iter().fold(0, |all, i| all | bits[i % N]);
            if by_rank > greatest {
                (best, greatest) = (four, by_rank);
            }
        }
    });
    corners_in(best)
}

/// Visits all sets of four corners, as a bit for each corner, with twice their area.
#[inline(always)]
fn for_each_four<const N: usize>(places: &[[f64; 2]; N], mut visit: impl FnMut(u32, f64)) {
    for a in 0..N {
        for c in a + 2..N {
            let [x, y] = [places[c][0] - places[a][0], places[c][1] - places[a][1]];
            for b in a + 1..c {
                for d in c + 1..N {
                    // The cross product of the diagonals.
                    let area = y * (places[d][0] - places[b][0]) - x * (places[d][1] - places[b][1]);
                    visit(1 << a | 1 << b | 1 << c | 1 << d, area);
                }
            }
        }
    }
}

/// The corners in a set of four, ascending.
fn corners_in(mut four: u32) -> [usize; 4] {
    let mut corners = [0; 4];
    for corner in &mut corners {
        *corner = four.trailing_zeros() as usize;
        four &= four.wrapping_sub(1);
    }
    corners
}

/// Four of many corners that hold a deepest one, by walks around the patch.
///
/// The walks start at the first corner by its features and go towards whichever neighbour comes first. So where several
/// sets of four are worth as much, the same set is found, whichever corner the list begins with and from whichever
/// shape the patch is seen.
fn pick_of_many(
    count: usize,
    at: impl Fn(usize) -> [f64; 2],
    is_deep: impl Fn(usize) -> bool,
    id: impl Fn(usize) -> FeatureId,
) -> [usize; 4] {
    let first = |is_it: &dyn Fn(usize) -> bool| {
        (0..count).filter(|&i| is_it(i)).min_by_key(|&i| rank(id(i))).unwrap_or(0)
    };
    let mut deep = (0..count).filter(|&i| is_deep(i));
    // A corner that is deeper than all others must be kept, and is the root.
    let alone = deep.next().filter(|_| deep.next().is_none());
    let root = alone.unwrap_or_else(|| first(&|_| true));
    let (next, before) = ((root + 1) % count, (root + count - 1) % count);
    let is_back = rank(id(before)) < rank(id(next));
    let turned = |i: usize| if is_back { count - 1 - i } else { i };
    let around = Around {
        count,
        at: |i: usize| {
            let [x, y] = at(turned(i));
            if is_back { [y, x] } else { [x, y] }
        },
    };
    if alone.is_some() {
        return around.holding(turned(root)).corners.map(turned);
    }
    let mut best = around.best_from(turned(root), |_| true);
    let holds_deep = |four: &Four| four.corners.iter().any(|&i| is_deep(turned(i)));
    if !holds_deep(&best) {
        best = around.best_from(turned(first(&is_deep)), holds_deep);
    }
    best.corners.map(turned)
}

/// Twice the signed area of the triangle of a root and two corners given relative to it; positive if clockwise.
fn area([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    y0 * x1 - x0 * y1
}

/// Corners around a patch.
struct Around<F> {
    count: usize,
    at: F,
}

/// Four corners in order around a patch.
#[derive(Clone, Copy)]
struct Four {
    /// The first found whose area is even with the best.
    corners: [usize; 4],
    /// The best four themselves.
    furthest: [usize; 4],
    /// Twice the area of the best four.
    area: f64,
}

impl<F: Fn(usize) -> [f64; 2]> Around<F> {
    /// The best four that hold a root.
    fn holding(&self, root: usize) -> Four {
        self.rooted(root, [(1, self.count - 3), (2, self.count - 2), (3, self.count - 1)])
    }

    /// The best four that hold a root, or others that are allowed by the filter and better by more than what counts as
    /// even.
    fn best_from(&self, root: usize, is_allowed: impl Fn(&Four) -> bool) -> Four {
        let mut best = self.holding(root);
        self.for_others(best.furthest, |mut found| {
            if found.area > best.area * (1.0 + EVEN_AREA) {
                if !is_allowed(&found) {
                    found.corners = found.furthest;
                }
                if is_allowed(&found) {
                    best = found;
                }
            }
        });
        best
    }

    /// The best four that hold a root and one corner in each of three ranges, given as offsets from the root.
    fn rooted(
        &self,
        root: usize,
        [(b_least, b_most), (c_least, c_most), (d_least, d_most)]: [(usize, usize); 3],
    ) -> Four {
        let place = self.seen_from(root);
        // The first that is even with the best so far, and the best.
        let (mut first, mut enough) = ([0, 1, 2, 3], f64::NEG_INFINITY);
        let (mut best, mut most) = (first, f64::NEG_INFINITY);
        let (mut b, mut d) = (b_least.max(1), d_least.max(3));
        let (mut at_b, mut at_d) = (place(b), place(d.min(self.count - 1)));
        for c in c_least.max(b + 1)..=c_most.min(self.count - 2) {
            let at_c = place(c);
            let mut near = area(at_b, at_c);
            while b < b_most.min(c - 1) {
                let at_next = place(b + 1);
                let next = area(at_next, at_c);
                if next <= near {
                    break;
                }
                (b, at_b, near) = (b + 1, at_next, next);
            }
            if d <= c {
                (d, at_d) = (c + 1, place(c + 1));
            }
            let mut far = area(at_c, at_d);
            while d < d_most.min(self.count - 1) {
                let at_next = place(d + 1);
                let next = area(at_c, at_next);
                if next <= far {
                    break;
                }
                (d, at_d, far) = (d + 1, at_next, next);
            }
            if near + far > most {
                (best, most) = ([0, b, c, d], near + far);
                if most > enough * (1.0 + EVEN_AREA) || enough == f64::NEG_INFINITY {
                    (first, enough) = (best, most);
                }
            }
        }
        let first = self.nearer(root, first, [b_least.max(1), d_least]);
        let index = |offset: usize| self.index(root, offset);
        Four { corners: first.map(index), furthest: best.map(index), area: most }
    }

    /// Of corners on either side of a diagonal that are worth as much, the ones nearest to the root, but no nearer than
    /// the `least` offsets.
    fn nearer(&self, root: usize, [_, mut b, c, mut d]: [usize; 4], least: [usize; 2]) -> [usize; 4] {
        let place = self.seen_from(root);
        let at_c = place(c);
        let (near, far) = (area(place(b), at_c), area(at_c, place(d)));
        while b > least[0] && area(place(b - 1), at_c) >= near - near.abs() * EVEN_AREA {
            b -= 1;
        }
        while d > least[1].max(c + 1) && area(at_c, place(d - 1)) >= far - far.abs() * EVEN_AREA {
            d -= 1;
        }
        [0, b, c, d]
    }

    /// The index of the corner at an offset from a root.
    fn index(&self, root: usize, offset: usize) -> usize {
        if root + offset < self.count { root + offset } else { root + offset - self.count }
    }

    /// Positions of corners relative to a root, by their offset from it.
    fn seen_from(&self, root: usize) -> impl Fn(usize) -> [f64; 2] {
        let from = (self.at)(root);
        move |offset| {
            let [x, y] = (self.at)(self.index(root, offset));
            [x - from[0], y - from[1]]
        }
    }

    /// For each other corner of the shortest arc between four corners, visits the best four that hold it and lie
    /// between those four.
    fn for_others(&self, four: [usize; 4], mut visit: impl FnMut(Four)) {
        let arcs = [0, 1, 2, 3].map(|i| {
            let (begin, end) = (four[i], four[(i + 1) % 4]);
            if end >= begin { end - begin } else { end + self.count - begin }
        });
        let Some(shortest) = (0..4).min_by_key(|&i| arcs[i]) else { return };
        let (first, length) = (four[shortest], arcs[shortest]);
        let tries = length.clamp(1, EVERY_ROOT - 1);
        for turn in 0..=tries {
            let step = turn * length / tries;
            let root = (first + step) % self.count;
            if root == four[0] {
                continue;
            }
            // One in each of the other arcs, as offsets from the root.
            let mut ahead = length - step;
            let others = [1, 2, 3].map(|i| {
                let begin = ahead;
                ahead += arcs[(shortest + i) % 4];
                (begin, ahead)
            });
            visit(self.rooted(root, others));
        }
    }
}

#[cfg(test)]
mod tests;
