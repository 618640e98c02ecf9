//! All overlapping AABBs, by a double loop over plain comparisons.

use asunder_geometry::{Aabb2, Aabb3};

/// A box as intervals (least, greatest), one per axis: what the double loop compares.
pub trait Sides {
    /// Least and greatest coordinate on each axis.
    fn sides(&self) -> Vec<(f32, f32)>;
}

impl Sides for Aabb2 {
    fn sides(&self) -> Vec<(f32, f32)> {
        vec![(self.min.x, self.max.x), (self.min.y, self.max.y)]
    }
}

impl Sides for Aabb3 {
    fn sides(&self) -> Vec<(f32, f32)> {
        vec![(self.min.x, self.max.x), (self.min.y, self.max.y), (self.min.z, self.max.z)]
    }
}

/// All pairs `(a, b)` with `a < b` whose closed boxes share a point and that `admit` accepts, in order.
///
/// Closed intervals share a point exactly when the greater of the minima is no greater than the lesser of the maxima;
/// with a NaN or an inverted interval there is no such point. Written with intervals, not with the library's six
/// comparisons, so that both would have to be wrong in the same way.
pub fn brute_pairs<B: Sides>(boxes: &[B], admit: impl Fn(u32, u32) -> bool) -> Vec<(u32, u32)> {
    let sides: Vec<_> = boxes.iter().map(Sides::sides).collect();
    let mut pairs = Vec::new();
    for a in 0..sides.len() {
        for b in a + 1..sides.len() {
            let share = sides[a].iter().zip(&sides[b]).all(|(&p, &q)| shares_point(p, q));
            if share && admit(a as u32, b as u32) {
                pairs.push((a as u32, b as u32));
            }
        }
    }
    pairs
}

fn shares_point(p: (f32, f32), q: (f32, f32)) -> bool {
    let is_interval = |(low, high): (f32, f32)| !low.is_nan() && !high.is_nan() && low <= high;
    // `max` and `min` skip NaN, so both sides must be checked to be intervals first.
    is_interval(p) && is_interval(q) && p.0.max(q.0) <= p.1.min(q.1)
}
