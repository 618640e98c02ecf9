//! From any number of contact points to four that hold a body as well.
//!
//! ```text
//! root = the first corner by its features
//! for each corner opposite the root: furthest out on either side of the diagonal is the best there    (rooted)
//! the best four of all have one corner in each arc between neighbours of the four found so;
//! so root at each corner of the arc with the fewest                                                  (others)
//! where none of those four is as deep as any: the same again, root = the first of the corners that are
//! ```
//! For a fixed root and a diagonal that turns on, the corners furthest from it turn on as well: one pass around the
//! patch finds the best four that hold the root. That the best of all lie between those is proved by Boyce, Dobkin,
//! Drysdale and Guibas, "Finding extremal polygons" (SIAM Journal on Computing 1985). Of five to eight corners all
//! fours are tried.
//!
//! What is promised, of corners in convex position, up to a few [`EVEN_AREA`]:
//! - one of the four is as deep as any, up to what counts as even;
//! - their area is at least that of the best four that hold the first of the corners as deep as any;
//! - if the best four of all hold a corner as deep as any, it is at least 95 % of theirs: all of it up to
//!   [`EVERY_ROOT`] corners in the arc. So it is wherever faces rest on each other, where all are as deep;
//! - fours that are worth as much are told apart by the features of their corners alone: a body that trembles on
//!   its face stands on the same four in every frame, and seen from the other shape they are the same, unless two
//!   corners have each other's names.
//!
//! The best four that hold a given corner have at least 2/3 of the area of the best of all: at worst the deepest is the
//! middle of the longer side of a trapezoid whose other side is half as long. Nothing that keeps it can do better.

use crate::feature::FeatureId;
use asunder_geometry::tolerance::EVEN_AREA;
use core::array::from_fn;

/// Corners of an arc up to which each is tried as a root; of more, as many spread evenly.
const EVERY_ROOT: usize = 8;

/// A corner of a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Where it is, seen along the normal.
    pub(crate) at: [f64; 2],
    /// How far the shapes are apart there.
    pub(crate) separation: f64,
}

/// Four of more than four corners, by their places in the list. The list goes clockwise around a convex patch. Corners
/// no more than `even` above the deepest are as deep as any.
pub(crate) fn pick_four<S, I>(count: usize, spot: S, id: I, even: f64) -> [usize; 4]
where
    S: Fn(usize) -> Spot,
    I: Fn(usize) -> FeatureId,
{
    let least = (0..count).map(|i| spot(i).separation).fold(f64::INFINITY, f64::min) + even;
    let is_deep = |i: usize| spot(i).separation <= least;
    let at = |i: usize| spot(i).at;
    // A bit for each.
    let deep = || (0..count).fold(0, |bits, i| bits | u32::from(is_deep(i)) << i);
    match count {
        5 => pick_of_few::<5>(from_fn(at), deep(), &id),
        6 => pick_of_few::<6>(from_fn(at), deep(), &id),
        7 => pick_of_few::<7>(from_fn(at), deep(), &id),
        8 => pick_of_few::<8>(from_fn(at), deep(), &id),
        _ => pick_of_many(count, at, is_deep, id),
    }
}

/// What comes first of corners that are worth as much.
fn rank(id: FeatureId) -> ([u32; 2], FeatureId) {
    (id.in_any_order(), id)
}

/// The best four of a few that hold a deep one, by trying all; a bit for each that is deep.
///
/// What asks for names is not a parameter of its own: of each kind of patch there would be a copy of all that is tried.
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
    // A bit for each corner, the first by rank the highest: of sets of four, the greatest is the first.
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

/// All fours of some corners, as a bit for each corner, and twice the area between them.
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

/// The corners of a set of four, in their order.
fn corners_in(mut four: u32) -> [usize; 4] {
    let mut corners = [0; 4];
    for corner in &mut corners {
        *corner = four.trailing_zeros() as usize;
        four &= four.wrapping_sub(1);
    }
    corners
}

/// Four of many that hold a deep one, by walks around the patch.
///
/// The walks set out from the first corner by its features, and towards the neighbour that comes first: where several
/// fours are worth as much, the same are found, whichever corner the list begins with and from whichever side the patch
/// is seen.
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
    // One that is deeper than all others must be kept, and is where to set out from.
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

/// Twice the area of the triangle of a root and two corners as seen from it, which is positive clockwise.
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
    /// The first that are even with the best.
    corners: [usize; 4],
    /// The best themselves.
    furthest: [usize; 4],
    /// Twice the area between these.
    area: f64,
}

impl<F: Fn(usize) -> [f64; 2]> Around<F> {
    /// The best four that hold a root.
    fn holding(&self, root: usize) -> Four {
        self.rooted(root, [(1, self.count - 3), (2, self.count - 2), (3, self.count - 1)])
    }

    /// The best four that hold a root, or others, of those that some filter allows, if they are better than even.
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

    /// The best four that hold a root, the others each so many corners further on.
    fn rooted(
        &self,
        root: usize,
        [(b_least, b_most), (c_least, c_most), (d_least, d_most)]: [(usize, usize); 3],
    ) -> Four {
        let place = self.seen_from(root);
        // The first that is even with the best, and the best.
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

    /// Of corners on either side of a diagonal that are worth as much, those nearer to the root, but no nearer than
    /// some.
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

    /// The corner so many further on than a root.
    fn index(&self, root: usize, offset: usize) -> usize {
        if root + offset < self.count { root + offset } else { root + offset - self.count }
    }

    /// Where corners are, by how many further on than a root they come.
    fn seen_from(&self, root: usize) -> impl Fn(usize) -> [f64; 2] {
        let from = (self.at)(root);
        move |offset| {
            let [x, y] = (self.at)(self.index(root, offset));
            [x - from[0], y - from[1]]
        }
    }

    /// Visits the best four that lie between four and hold another corner of their shortest arc, for each such corner.
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
            // One in each of the other arcs, counted from the root.
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
