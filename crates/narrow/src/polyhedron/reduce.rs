//! From any number of contact points to four that hold a body as well.
//!
//! ```text
//! root = the lowest id of the corners that are as deep as any
//! for each corner opposite the root: furthest out on either side of the diagonal is the best there    (rooted)
//! the best four of all have one corner in each arc between neighbours of the four found so;
//! so root at each corner of the arc with the fewest                                                  (others)
//! ```
//! For a fixed root and a diagonal that turns on, the corners furthest from it turn on as well: one pass around the
//! patch finds the best four that hold the root. That the best of all lie between those is proved by Boyce, Dobkin,
//! Drysdale and Guibas, "Finding extremal polygons" (SIAM Journal on Computing 1985).
//!
//! What is promised, of corners in convex position:
//! - one of the four is as deep as any, up to the slack;
//! - their area is at least that of the best four that hold the root;
//! - if the best four of all hold a corner as deep as any, it is at least 95 % of theirs: all of it up to
//!   [`EVERY_ROOT`] corners in the arc. So it is wherever faces rest on each other, where all are as deep.
//!
//! The best four that hold a given corner have at least 2/3 of the area of the best of all: at worst the deepest is the
//! middle of the longer side of a trapezoid whose other side is half as long. Nothing that keeps it can do better.

use crate::feature::FeatureId;

/// Corners of an arc up to which each is tried as a root; of more, as many spread evenly.
const EVERY_ROOT: usize = 8;

/// Share by which four corners must have more area than others that were found before: more than rounding, so that
/// corners of regular patches do not change from frame to frame.
const BEATS: f64 = 1e-6;

/// A corner of a patch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spot {
    /// Where it is, seen along the normal.
    pub(crate) at: [f64; 2],
    /// How far the shapes are apart there.
    pub(crate) separation: f64,
}

/// Four of more than four corners, by their places in the list. The list goes clockwise around a convex patch.
pub(crate) fn pick_four<S, I>(count: usize, spot: S, id: I, slack: f64) -> [usize; 4]
where
    S: Fn(usize) -> Spot,
    I: Fn(usize) -> FeatureId,
{
    let least = (0..count).map(|i| spot(i).separation).fold(f64::INFINITY, f64::min) + slack;
    let is_deep = |i: usize| spot(i).separation <= least;
    let around = Around { count, at: |i| spot(i).at };
    match count {
        5 => return pick_of_few::<5>(around.places(), is_deep, id),
        6 => return pick_of_few::<6>(around.places(), is_deep, id),
        7 => return pick_of_few::<7>(around.places(), is_deep, id),
        8 => return pick_of_few::<8>(around.places(), is_deep, id),
        _ => {}
    }
    let root = (0..count).filter(|&i| is_deep(i)).min_by_key(|&i| id(i)).unwrap_or(0);
    let mut best = around.rooted(root, [(1, count - 3), (2, count - 2), (3, count - 1)]);
    let is_alone = (0..count).filter(|&i| is_deep(i)).nth(1).is_none();
    if !is_alone {
        around.for_others(best.corners, |found| {
            if found.area > best.area * (1.0 + BEATS) && found.corners.iter().any(|&i| is_deep(i)) {
                best = found;
            }
        });
    }
    best.corners
}

/// The best four of a few that hold a deep one, by trying all.
fn pick_of_few<const N: usize>(
    places: [[f64; 2]; N],
    is_deep: impl Fn(usize) -> bool,
    id: impl Fn(usize) -> FeatureId,
) -> [usize; 4] {
    let deep = (0..N).map(|i| u32::from(is_deep(i)) << i).fold(0, |bits, bit| bits | bit);
    let (mut best, mut tie, mut beats) = ([0, 1, 2, 3], f64::NEG_INFINITY, f64::NEG_INFINITY);
    for a in 0..N {
        for c in a + 2..N {
            let [x, y] = [places[c][0] - places[a][0], places[c][1] - places[a][1]];
            for b in a + 1..c {
                for d in c + 1..N {
                    // Twice the area: the cross product of the diagonals.
                    let area = y * (places[d][0] - places[b][0]) - x * (places[d][1] - places[b][1]);
                    if area < tie || deep & (1 << a | 1 << b | 1 << c | 1 << d) == 0 {
                        continue;
                    }
                    let four = [a, b, c, d];
                    if area > beats || lowest(four, &id) < lowest(best, &id) {
                        (best, tie, beats) = (four, area * (1.0 - BEATS), area * (1.0 + BEATS));
                    }
                }
            }
        }
    }
    best
}

fn lowest(four: [usize; 4], id: impl Fn(usize) -> FeatureId) -> [FeatureId; 4] {
    let mut ids = four.map(id);
    ids.sort_unstable();
    ids
}

/// Corners around a patch.
struct Around<F> {
    count: usize,
    at: F,
}

/// Four corners in order around a patch, and twice the area between them.
#[derive(Clone, Copy)]
struct Four {
    corners: [usize; 4],
    area: f64,
}

impl<F: Fn(usize) -> [f64; 2]> Around<F> {
    fn places<const N: usize>(&self) -> [[f64; 2]; N] {
        core::array::from_fn(&self.at)
    }

    /// The best four that hold a root, the others each so many corners further on.
    fn rooted(
        &self,
        root: usize,
        [(b_least, b_most), (c_least, c_most), (d_least, d_most)]: [(usize, usize); 3],
    ) -> Four {
        let index = |offset: usize| {
            if root + offset < self.count { root + offset } else { root + offset - self.count }
        };
        let from = (self.at)(root);
        let place = |offset: usize| {
            let [x, y] = (self.at)(index(offset));
            [x - from[0], y - from[1]]
        };
        // Twice the area of the triangle of the root and two more, which is positive clockwise.
        let area = |[x0, y0]: [f64; 2], [x1, y1]: [f64; 2]| y0 * x1 - x0 * y1;
        let mut best = Four { corners: [root; 4], area: f64::NEG_INFINITY };
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
            if near + far > best.area * (1.0 + BEATS) || best.area == f64::NEG_INFINITY {
                best = Four { corners: [root, index(b), index(c), index(d)], area: near + far };
            }
        }
        best
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
