//! Sort and sweep along one axis: the reference that every faster sweep must equal.
//!
//! ```text
//! drop boxes that are empty sets
//! choose the axis along which the centres vary most
//! sort the boxes by their minimum on that axis
//! for each box, in that order:
//!   for each later box whose minimum is not beyond this one's maximum:
//!     they overlap on the sweep axis; test the other axes; ask the filter; hand over
//! ```
//! Baraff, "Dynamic simulation of non-penetrating rigid bodies" (1992), without keeping the order between frames. Cost:
//! n log n, plus the pairs that overlap on the sweep axis, which is quadratic if all boxes do.

use crate::pair::{PairId, TooManyPairs};
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// A sweep and its scratch memory. Keep one between frames so that a steady scene allocates nothing.
///
/// It holds no history: the answer depends on the boxes alone.
///
/// ```
/// use asunder_broad::{PairId, PlainSweep};
/// use asunder_geometry::{Aabb3, glam::Vec3};
/// use core::ops::ControlFlow;
///
/// let boxes = [Aabb3::new(Vec3::ZERO, Vec3::ONE); 3];
/// let mut sweep = PlainSweep::new();
/// let mut pairs = Vec::new();
/// sweep.pairs(&boxes, |a, _| a != 0, usize::MAX, &mut pairs)?;
/// assert_eq!(pairs, [PairId { a: 1, b: 2 }], "the filter dropped every pair of box 0");
///
/// let mut count = 0;
/// let _ = sweep.visit(&boxes, |_, _| true, |_| {
///     count += 1;
///     ControlFlow::Continue(())
/// });
/// assert_eq!(count, 3);
/// # Ok::<(), asunder_broad::TooManyPairs>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct PlainSweep {
    // (minimum on the sweep axis, box)
    order: Vec<(f32, u32)>,
}

impl PlainSweep {
    /// A sweep without scratch memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
    ///
    /// `admit` is asked once for each pair of overlapping boxes, the smaller number first, before the pair is made.
    /// Fewer than 2^32 boxes.
    ///
    /// # Errors
    /// More than `limit` admitted pairs. `pairs` is then empty.
    pub fn pairs<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: impl Fn(u32, u32) -> bool,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        pairs.clear();
        let outcome = self.visit(boxes, admit, |pair| {
            if pairs.len() == limit {
                return ControlFlow::Break(());
            }
            pairs.push(pair);
            ControlFlow::Continue(())
        });
        if outcome.is_break() {
            pairs.clear();
            return Err(TooManyPairs { limit });
        }
        pairs.sort_unstable();
        Ok(())
    }

    /// Hands every overlapping pair that `admit` lets pass to `visitor`, each once, in unspecified order, until it
    /// breaks off. For outputs that are too long to keep.
    pub fn visit<B: Bounds>(
        &mut self,
        boxes: &[B],
        admit: impl Fn(u32, u32) -> bool,
        mut visitor: impl FnMut(PairId) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        let axis = widest_axis(boxes);
        let minimum = |i: u32| boxes[i as usize].interval(axis).0;
        self.order.clear();
        let valid = (0..boxes.len() as u32).filter(|&i| boxes[i as usize].is_valid());
        self.order.extend(valid.map(|i| (minimum(i), i)));
        self.order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));

        for (place, &(_, i)) in self.order.iter().enumerate() {
            let box_i = &boxes[i as usize];
            let end = box_i.interval(axis).1;
            let reached = self.order[place + 1..].iter().take_while(|&&(start, _)| start <= end);
            for &(_, j) in reached {
                let pair = PairId::new(i, j);
                if box_i.overlaps(&boxes[j as usize]) && admit(pair.a, pair.b) {
                    visitor(pair)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

/// The axis along which the centres of the boxes vary most. Only speed depends on it.
fn widest_axis<B: Bounds>(boxes: &[B]) -> usize {
    let variance = |axis: usize| {
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for one in boxes {
            let (low, high) = one.interval(axis);
            let center = f64::from(low) * 0.5 + f64::from(high) * 0.5;
            // Unbounded boxes have no centre, and would make the variance infinite.
            if center.is_finite() {
                count += 1.0;
                sum += center;
                squares += center * center;
            }
        }
        if count > 0.0 { squares / count - (sum / count) * (sum / count) } else { 0.0 }
    };
    (0..B::AXES).max_by(|&a, &b| variance(a).total_cmp(&variance(b))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_geometry::{Aabb3, glam::Vec3};

    #[test]
    fn the_crowded_axis_is_not_the_one_swept() {
        let tower: Vec<Aabb3> = (0..100)
            .map(|i| Aabb3::new(Vec3::new(0.0, 0.0, i as f32), Vec3::new(1.0, 1.0, i as f32 + 0.5)))
            .collect();
        assert_eq!(widest_axis(&tower), 2);
        assert_eq!(widest_axis::<Aabb3>(&[]), 2, "any axis will do for nothing");
    }

    #[test]
    fn an_unbounded_box_meets_everything_that_is_valid() {
        let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
        let boxes = [Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY), unit, Aabb3::NOTHING, unit];
        let mut pairs = Vec::new();
        PlainSweep::new().pairs(&boxes, |_, _| true, 10, &mut pairs).unwrap();
        assert_eq!(pairs, [PairId::new(0, 1), PairId::new(0, 3), PairId::new(1, 3)]);
    }
}
