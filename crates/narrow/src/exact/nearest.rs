//! The point of an exact simplex that is nearest to the origin, and the corners that carry it.
//!
//! ```text
//! a set of corners carries the nearest point exactly if
//!   the point of its affine hull nearest to the origin has a positive weight on each corner, and
//!   no other corner lies nearer along that point's direction
//! one corner:     G[i][k] >= G[i][i] for every other k
//! two:            weights G[j][j] - G[i][j] and G[i][i] - G[i][j]; their mean's product with k is at least that with i
//! three:          weights from the 2 x 2 system of their edges; the other corner on the side away from the origin
//! four:           the origin is on the same side of all four faces
//! ```
//! G is the Gram matrix, `G[i][j] = p_i . p_j`. There are at most fifteen candidate sets, tried until one passes: at
//! least one set of independent corners does, whatever the others are, and all that pass have the same nearest point.

use super::Corner;
use super::int::{Int, cross3, dot3, sum_of_products};
use arrayvec::ArrayVec;
use core::cmp::Ordering;

/// One to four corners.
#[derive(Clone)]
pub(super) struct Simplex {
    points: ArrayVec<[Int; 3], 4>,
    corners: ArrayVec<Corner, 4>,
    /// Dot products of corners, indexed by the later corner first.
    gram: [[Int; 4]; 4],
    /// Whether all corners but the last carried the previous nearest point, so that the last is among those that carry
    /// the next.
    is_grown: bool,
}

/// The result of [`Simplex::reduce`].
#[allow(clippy::large_enum_variant, reason = "it lives on the stack for one step")]
pub(super) enum Carried {
    /// The origin is in the simplex.
    Origin,
    /// The corners that are left carry the nearest point, which lies in this direction, of any length.
    By([Int; 3]),
}

impl Simplex {
    pub(super) fn new() -> Self {
        let row = || [Int::ZERO, Int::ZERO, Int::ZERO, Int::ZERO];
        Self {
            points: ArrayVec::new(),
            corners: ArrayVec::new(),
            gram: [row(), row(), row(), row()],
            is_grown: false,
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Adds a corner, unless it is there already or there are four.
    pub(super) fn push(&mut self, corner: Corner, point: [Int; 3]) {
        if self.points.is_full() || self.corners.contains(&corner) {
            return;
        }
        self.points.push(point);
        self.corners.push(corner);
    }

    /// One of the corners. All corners that carry the nearest point have the same projection on its direction.
    pub(super) fn first(&self) -> &[Int; 3] {
        &self.points[0]
    }

    /// Drops all corners that do not carry the nearest point.
    ///
    /// Most corners that come from f64 do, so the largest sets are tried first.
    pub(super) fn reduce(&mut self) -> Carried {
        if self.is_around_origin() {
            return Carried::Origin;
        }
        self.multiply();
        let count = self.points.len();
        // After a reduction, only sets with the newest corner can have a nearer point.
        let newest = if self.is_grown { count - 1 } else { 0 };
        for i in (newest..count).rev() {
            for (j, k) in (0..i).rev().flat_map(|j| (0..j).rev().map(move |k| (j, k))) {
                if let Some(towards) = self.carries_three([i, j, k]) {
                    return self.carried(&[k, j, i], towards);
                }
            }
        }
        for i in (newest..count).rev() {
            for j in (0..i).rev() {
                if let Some(towards) = self.carries_two(i, j) {
                    return self.carried(&[j, i], towards);
                }
            }
        }
        for i in (newest..count).rev() {
            if self.carries_one(i) {
                return self.carried(&[i], self.points[i].clone());
            }
        }
        Carried::Origin
    }

    /// Whether there are four corners, with the origin strictly inside: its volumes with all four faces have one sign.
    fn is_around_origin(&self) -> bool {
        let [a, b, c, d] = self.points.as_slice() else { return false };
        let (ab, cd) = (cross3(a, b), cross3(c, d));
        let of_d = dot3(&ab, d).sign();
        of_d != Ordering::Equal
            && dot3(&ab, c).sign() == of_d.reverse()
            && dot3(&cd, b).sign() == of_d
            && dot3(&cd, a).sign() == of_d.reverse()
    }

    /// Fills in the products of corners that are not known yet.
    fn multiply(&mut self) {
        let known = if self.is_grown { self.points.len() - 1 } else { 0 };
        for i in known..self.points.len() {
            for j in 0..=i {
                self.gram[i][j] = dot3(&self.points[i], &self.points[j]);
            }
        }
    }

    fn carried(&mut self, set: &[usize], towards: [Int; 3]) -> Carried {
        if towards.iter().all(Int::is_zero) {
            return Carried::Origin;
        }
        let points = set.iter().map(|&i| self.points[i].clone()).collect();
        let corners = set.iter().map(|&i| self.corners[i]).collect();
        // The set is in ascending order, so products only move down.
        for (to_i, &i) in set.iter().enumerate() {
            for (to_j, &j) in set[..=to_i].iter().enumerate() {
                self.gram[to_i][to_j] = self.gram[i][j].clone();
            }
        }
        (self.points, self.corners, self.is_grown) = (points, corners, true);
        Carried::By(towards)
    }

    fn product(&self, i: usize, j: usize) -> &Int {
        if i >= j { &self.gram[i][j] } else { &self.gram[j][i] }
    }

    fn others<'s>(&self, set: &'s [usize]) -> impl Iterator<Item = usize> + use<'s> {
        (0..self.points.len()).filter(move |k| !set.contains(k))
    }

    fn carries_one(&self, i: usize) -> bool {
        self.others(&[i]).all(|k| self.product(i, k) >= self.product(i, i))
    }

    /// The direction of the nearest point, if these two corners carry it; zero if it is the origin.
    fn carries_two(&self, i: usize, j: usize) -> Option<[Int; 3]> {
        let cross = self.product(i, j);
        let share_i = self.product(j, j) - cross;
        let share_j = self.product(i, i) - cross;
        if !is_positive(&share_i) || !is_positive(&share_j) {
            return None;
        }
        let has_none_before = |k: usize| {
            let (from_i, from_j) = (self.product(i, k) - self.product(i, i), self.product(j, k) - cross);
            sum_of_products([[&share_i, &from_i], [&share_j, &from_j]], false).sign() != Ordering::Less
        };
        let is_nearest = self.others(&[i, j]).all(has_none_before);
        let mean = |axis: usize| {
            let (in_i, in_j) = (&self.points[i][axis], &self.points[j][axis]);
            sum_of_products([[&share_i, in_i], [&share_j, in_j]], false)
        };
        is_nearest.then(|| [mean(0), mean(1), mean(2)])
    }

    /// The direction of the nearest point, if these three corners carry it; zero if it is the origin.
    fn carries_three(&self, set: [usize; 3]) -> Option<[Int; 3]> {
        let [i, j, k] = set;
        // Dot products of the edges from k: with corner k (`along`), and with each other.
        let (at_k, at_i, at_j) = (self.product(k, k), self.product(i, k), self.product(j, k));
        let (along_i, along_j) = (at_i - at_k, at_j - at_k);
        let ii = &(self.product(i, i) - at_i) - &along_i;
        let jj = &(self.product(j, j) - at_j) - &along_j;
        let ij = &(self.product(i, j) - at_j) - &along_i;
        let share_i = sum_of_products([[&ij, &along_j], [&jj, &along_i]], true);
        if !is_positive(&share_i) {
            return None;
        }
        let share_j = sum_of_products([[&ij, &along_i], [&ii, &along_j]], true);
        if !is_positive(&share_j) {
            return None;
        }
        let mut share_k = sum_of_products([[&ii, &jj], [&ij, &ij]], true);
        share_k -= &share_i;
        share_k -= &share_j;
        if !is_positive(&share_k) {
            return None;
        }
        let from_k = |other: usize| {
            let (p, q) = (&self.points[other], &self.points[k]);
            [&p[0] - &q[0], &p[1] - &q[1], &p[2] - &q[2]]
        };
        let across = cross3(&from_k(i), &from_k(j));
        let side = dot3(&across, &self.points[k]).sign();
        if side == Ordering::Equal {
            return Some([Int::ZERO, Int::ZERO, Int::ZERO]);
        }
        let is_nearest = self.others(&set).all(|l| {
            let beyond = dot3(&across, &from_k(l)).sign();
            beyond == Ordering::Equal || beyond == side
        });
        is_nearest.then(|| if side == Ordering::Greater { across } else { across.map(|c| -c) })
    }
}

fn is_positive(value: &Int) -> bool {
    value.sign() == Ordering::Greater
}
