//! Simplifies a convex polygon to fewer vertices, with little left outside.
//!
//! ```text
//! the cap over a chord a -> b: the hull's vertices between a and b, which the chord would cut off
//! for a given error:
//!     from some vertex, go round the hull by chords, each as long as its cap stays within the error
//! bisect for the least error with which max_vertices chords go all the way round
//! use spare vertices where the highest caps are
//! measure the final error over every vertex that is left out
//! ```
//!
//! Greedily long chords are as few as possible from a given first vertex (Imai and Iri, "Computational-geometric
//! methods for polygonal approximations of a curve", 1986). A cap is a convex arc: its height over the chord rises and
//! then falls, so that its highest vertex is found by bisection, too.

use crate::outward::round_up;
use glam::{DVec2, Vec2};

/// Picks at most `limit` (3 or more) of the vertices of a strictly convex polygon that has more; also returns how far
/// outside any other lies.
pub(super) fn simplified(hull: &[Vec2], limit: usize) -> (Vec<Vec2>, f32) {
    let ring = Ring { hull };
    let mut kept = ring.chosen(limit);
    while kept.len() < limit && ring.split_highest(&mut kept) {}
    kept.iter_mut().for_each(|index| *index %= hull.len());
    kept.sort_unstable();
    let error = ring.error(&kept);
    (kept.into_iter().map(|index| hull[index]).collect(), error)
}

/// The hull's vertices as a ring: indices wrap around.
struct Ring<'a> {
    hull: &'a [Vec2],
}

/// Bisection stops once the least sufficient error and the greatest insufficient one differ by no more than this in
/// their bit patterns: by 2^-10 of their size.
const CLOSE_ENOUGH: u64 = 1 << 42;

impl Ring<'_> {
    fn at(&self, index: usize) -> DVec2 {
        self.hull[index % self.hull.len()].as_dvec2()
    }

    /// At most `limit` vertices in order round the ring, with caps as low as bisection finds.
    fn chosen(&self, limit: usize) -> Vec<usize> {
        let size = (1..self.hull.len()).map(|i| self.at(i).distance(self.at(0))).fold(0.0, f64::max);
        // Twice the size is at least the diameter. Bit patterns of positive numbers have their order.
        let (mut low, mut high) = ((size * 1e-18).to_bits(), (size * 2.0).to_bits());
        let mut best: Vec<usize> = Vec::new();
        while high - low > CLOSE_ENOUGH {
            let middle = low + (high - low) / 2;
            match self.round(f64::from_bits(middle), limit) {
                Some(found) => (high, best) = (middle, found),
                None => low = middle,
            }
        }
        if best.is_empty() { (0..limit).collect() } else { best }
    }

    /// A way round with caps up to `height` in at most `limit` chords, if there is one from any of a few first
    /// vertices.
    ///
    /// Any way round has a vertex within the reach of vertex 0. All of these are tried if they are few; with a large
    /// limit, one chord more or less does not matter.
    fn round(&self, height: f64, limit: usize) -> Option<Vec<usize>> {
        let reach = self.reach(0, self.hull.len() - 1, height);
        let tries = reach.min(256 / limit).max(1);
        (1..=tries).find_map(|number| self.round_from(number * reach / tries, height, limit))
    }

    fn round_from(&self, start: usize, height: f64, limit: usize) -> Option<Vec<usize>> {
        let end = start + self.hull.len();
        let mut kept = vec![start];
        // The first chord must not return to its own start.
        let mut last = self.reach(start, end - 1, height);
        while last < end {
            if kept.len() == limit {
                return None;
            }
            kept.push(last);
            last = self.reach(last, end, height);
        }
        Some(kept)
    }

    /// The furthest vertex up to `end` whose chord from `from` has a cap up to `height`, by galloping search: steps
    /// double, then halve.
    fn reach(&self, from: usize, end: usize, height: f64) -> usize {
        let is_low = |to: usize| to <= end && self.cap(from, to).1 <= height;
        let (mut to, mut step) = (from + 1, 1);
        while is_low(to + step) {
            to += step;
            step *= 2;
        }
        while step > 1 {
            step /= 2;
            if is_low(to + step) {
                to += step;
            }
        }
        to
    }

    /// The highest vertex of the cap over a chord, and a bound on the cap's distance from the chord.
    ///
    /// If the cap overhangs an end of the chord, the bound combines height and overhang.
    fn cap(&self, from: usize, to: usize) -> (usize, f64) {
        let (a, b) = (self.at(from), self.at(to));
        let along = (b - a) / (b - a).length();
        let edge = |i: usize| self.at(i + 1) - self.at(i);
        let highest = partition_point(from, to, |i| edge(i).perp_dot(along) > 0.0);
        let leftmost = partition_point(from, highest, |i| edge(i).dot(along) < 0.0);
        let rightmost = partition_point(highest, to, |i| edge(i).dot(along) > 0.0);
        let height = (self.at(highest) - a).perp_dot(along).max(0.0);
        let overhang = along.dot(a - self.at(leftmost)).max(along.dot(self.at(rightmost) - b)).max(0.0);
        (highest, (height * height + overhang * overhang).sqrt())
    }

    /// Adds the highest vertex of the highest cap. False where no chord has a cap.
    fn split_highest(&self, kept: &mut Vec<usize>) -> bool {
        let mut highest: Option<(usize, usize, f64)> = None;
        for (place, (from, to)) in self.chords(kept).enumerate().filter(|(_, (from, to))| to - from > 1) {
            let (vertex, height) = self.cap(from, to);
            if highest.is_none_or(|(_, _, known)| height > known) {
                // Rounding may make an end of a flat cap its highest vertex.
                highest = Some((place, vertex.clamp(from + 1, to - 1), height));
            }
        }
        if let Some((place, vertex, _)) = highest {
            kept.insert(place + 1, vertex);
        }
        highest.is_some()
    }

    /// The chords between the kept vertices, once around.
    fn chords<'k>(&self, kept: &'k [usize]) -> impl Iterator<Item = (usize, usize)> + use<'k> {
        let end = kept[0] + self.hull.len();
        kept.iter().copied().zip(kept[1..].iter().copied().chain([end]))
    }

    /// The furthest that any vertex lies from the chord that cuts it off, rounded up.
    fn error(&self, kept: &[usize]) -> f32 {
        let (mut furthest, mut size) = (0.0_f64, 0.0_f64);
        for (from, to) in self.chords(kept) {
            let (a, b) = (self.at(from), self.at(to));
            size = size.max(a.distance(self.at(kept[0])));
            for i in from + 1..to {
                let place = ((self.at(i) - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                furthest = furthest.max(self.at(i).distance(a + (b - a) * place));
            }
        }
        // The nearest point, as rounded, is on the chord up to a few roundings of these lengths.
        let extent = self.at(kept[0]).length() + size + furthest;
        round_up(furthest + 16.0 * f64::EPSILON * extent)
    }
}

/// The first index of a range at which a condition that holds up to somewhere fails, or the range's end.
fn partition_point(mut from: usize, mut to: usize, holds: impl Fn(usize) -> bool) -> usize {
    while from < to {
        let middle = from + (to - from) / 2;
        if holds(middle) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    from
}
