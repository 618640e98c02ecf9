//! Temporal coherence: what rests is kept, what moves is swept.
//!
//! ```text
//! where more than a fifth of the boxes moved: sweep all, keep nothing
//! else, of the boxes that have moved since the index was built (the movers):
//!   drop the kept pairs of those that were not among them before
//!   sweep the movers among themselves
//!   ask the index of resting boxes about each
//!   sort these pairs, and merge them with the kept ones
//! build anew: when a fifth has moved by now, or when asking for movers that have come to rest has cost as much
//! ```
//! A frame costs some 150 ns a mover and a copy of the kept pairs (0.2 ns each); boxes that rest cost nothing. The list is
//! that of [`Sweep`](crate::Sweep), whatever came before: history decides only what it costs.

use crate::index::Index;
use crate::pair::{PairId, TooManyPairs};
use crate::sweep::Sweep;
use crate::sweep::order::Order;
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// All overlapping pairs of boxes of which few move from frame to frame.
///
/// ```
/// use asunder_broad::{CoherentSweep, PairId};
/// use asunder_geometry::{Aabb3, glam::Vec3};
/// let unit_at = |x: f32| Aabb3::new(Vec3::splat(x), Vec3::splat(x + 1.0));
/// let mut boxes: Vec<Aabb3> = (0..100).map(|i| unit_at(i as f32 * 3.0)).collect();
/// let mut sweep = CoherentSweep::new();
/// let mut pairs = Vec::new();
/// for _ in 0..3 {
///     sweep.update(&boxes, &[], |_, _| true, usize::MAX, &mut pairs)?;
///     assert!(pairs.is_empty());
/// }
/// boxes[7] = unit_at(60.5);
/// sweep.update(&boxes, &[7], |_, _| true, usize::MAX, &mut pairs)?;
/// assert_eq!(pairs, [PairId { a: 7, b: 20 }]);
/// # Ok::<(), asunder_broad::TooManyPairs>(())
/// ```
#[derive(Clone, Debug)]
pub struct CoherentSweep<B> {
    sweep: Sweep,
    /// The boxes that rested when it was built.
    index: Index<B>,
    is_built: bool,
    /// Frames in a row in which few boxes moved.
    quiet_frames: u32,
    /// Boxes that have moved since, ascending, and the same as a flag a box.
    movers: Vec<u32>,
    is_mover: Vec<bool>,
    /// Pairs of two boxes that have not.
    kept: Vec<PairId>,
    /// Movers that did not move, a frame and mover.
    idle: usize,
    moving: Vec<B>,
    fresh: Vec<PairId>,
    among: Vec<PairId>,
    order: Order,
}

/// Where more than one box of so many moves, nothing is kept.
const FEW: usize = 5;

/// Asking the index about one mover costs this part of building it anew, a box.
const IDLE_A_BOX: usize = 2;

impl<B: Bounds> Default for CoherentSweep<B> {
    fn default() -> Self {
        Self::new()
    }
}

impl<B: Bounds> CoherentSweep<B> {
    /// One that has seen no boxes yet.
    pub fn new() -> Self {
        Self {
            sweep: Sweep::new(),
            index: Index::new(),
            is_built: false,
            quiet_frames: 0,
            movers: Vec::new(),
            is_mover: Vec::new(),
            kept: Vec::new(),
            idle: 0,
            moving: Vec::new(),
            fresh: Vec::new(),
            among: Vec::new(),
            order: Order::default(),
        }
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
    ///
    /// `moved` names the boxes that differ from the last call in any way, their filters included; in any order, and again if need be. Boxes
    /// behind those of the last call are new, and need not be named. What is not named is believed to be as it was. A box that is
    /// taken away becomes an empty set. `admit` is asked as by [`Sweep::pairs`].
    ///
    /// # Errors
    /// More than `limit` admitted pairs. `pairs` is then empty, and the next call starts from here.
    pub fn update(
        &mut self,
        boxes: &[B],
        moved: &[u32],
        admit: impl Fn(u32, u32) -> bool + Sync,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        let new = self.is_mover.len()..boxes.len();
        let is_quiet = (moved.len() + new.len()) * FEW <= boxes.len() && self.is_mover.len() <= boxes.len();
        if !is_quiet {
            self.forget(boxes.len());
            return self.sweep.pairs(boxes, admit, limit, pairs);
        }
        self.quiet_frames = self.quiet_frames.saturating_add(1);
        self.is_mover.resize(boxes.len(), false);
        let were = self.movers.len();
        for &place in moved.iter().chain(&new.map(|place| place as u32).collect::<Vec<u32>>()) {
            if let Some(is_mover) = self.is_mover.get_mut(place as usize)
                && !core::mem::replace(is_mover, true)
            {
                self.movers.push(place);
            }
        }
        if !self.is_built || self.movers.len() * FEW > boxes.len() || self.idle > boxes.len() / IDLE_A_BOX {
            return self.rebuild(boxes, moved, admit, limit, pairs);
        }
        self.idle += self.movers.len().saturating_sub(moved.len());
        if self.movers.len() > were {
            self.movers.sort_unstable();
            let is_mover = &self.is_mover;
            self.kept.retain(|pair| !is_mover[pair.a as usize] && !is_mover[pair.b as usize]);
        }
        let outcome = self.pairs_of_movers(boxes, &admit, limit.saturating_sub(self.kept.len()));
        pairs.clear();
        if outcome.is_err() || self.kept.len() > limit {
            return Err(TooManyPairs { limit });
        }
        self.order.sort(&mut self.fresh, boxes.len());
        merge(&self.kept, &self.fresh, pairs);
        Ok(())
    }

    /// Memory that is held for the next call, in bytes: some 150 a box.
    ///
    /// ```
    /// assert_eq!(asunder_broad::CoherentSweep::<asunder_geometry::Aabb2>::new().bytes(), 0);
    /// ```
    pub fn bytes(&self) -> usize {
        let pairs = self.kept.capacity() + self.fresh.capacity() + self.among.capacity();
        self.sweep.bytes()
            + self.index.bytes()
            + self.order.bytes()
            + self.movers.capacity() * 4
            + self.is_mover.capacity()
            + self.moving.capacity() * size_of::<B>()
            + pairs * size_of::<PairId>()
    }

    /// Keeps nothing of the boxes up to now.
    fn forget(&mut self, count: usize) {
        self.is_built = false;
        self.quiet_frames = 0;
        self.is_mover.clear();
        self.is_mover.resize(count, false);
        self.movers.clear();
    }

    /// Sweeps all, and keeps what does not move now; in the first quiet frame, which may stay alone, nothing.
    fn rebuild(
        &mut self,
        boxes: &[B],
        moved: &[u32],
        admit: impl Fn(u32, u32) -> bool + Sync,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        let quiet_frames = self.quiet_frames;
        self.forget(boxes.len());
        self.quiet_frames = quiet_frames;
        self.sweep.pairs(boxes, admit, limit, pairs)?;
        if quiet_frames < 2 {
            return Ok(());
        }
        for &place in moved {
            if let Some(is_mover) = self.is_mover.get_mut(place as usize)
                && !core::mem::replace(is_mover, true)
            {
                self.movers.push(place);
            }
        }
        self.movers.sort_unstable();
        let is_mover = &self.is_mover;
        let rests = |place: u32| !is_mover[place as usize];
        self.index.build_from(boxes, rests);
        self.kept.clear();
        self.kept.extend(pairs.iter().filter(|pair| rests(pair.a) && rests(pair.b)));
        self.idle = 0;
        self.is_built = true;
        Ok(())
    }

    /// The pairs of which one box moved at least, in no order.
    fn pairs_of_movers(
        &mut self,
        boxes: &[B],
        admit: &(impl Fn(u32, u32) -> bool + Sync),
        limit: usize,
    ) -> Result<(), TooManyPairs> {
        let Self { sweep, index, movers, is_mover, moving, fresh, among, .. } = self;
        moving.clear();
        moving.extend(movers.iter().map(|&place| boxes[place as usize]));
        let place = |mover: u32| movers[mover as usize];
        sweep.pairs(moving, |a, b| admit(place(a), place(b)), limit, among)?;
        fresh.clear();
        fresh.extend(among.iter().map(|pair| PairId { a: place(pair.a), b: place(pair.b) }));
        for (&mover, bounds) in movers.iter().zip(moving) {
            let flow = index.visit_overlapping(bounds, |resting| {
                let pair = PairId::new(mover, resting);
                if !is_mover[resting as usize] && admit(pair.a, pair.b) {
                    if fresh.len() == limit {
                        return ControlFlow::Break(());
                    }
                    fresh.push(pair);
                }
                ControlFlow::Continue(())
            });
            if flow.is_break() {
                return Err(TooManyPairs { limit });
            }
        }
        Ok(())
    }
}

/// Replaces `into` by both lists, in order: stretches of the kept one are copied whole.
fn merge(kept: &[PairId], fresh: &[PairId], into: &mut Vec<PairId>) {
    into.clear();
    into.reserve(kept.len() + fresh.len());
    let mut rest = kept;
    for &pair in fresh {
        // Twice as far each time, then halves: few steps for the next pair, and not many for one far away.
        let mut far = 1;
        while far < rest.len() && rest[far] < pair {
            far *= 2;
        }
        let stretch = rest[..rest.len().min(far + 1)].partition_point(|kept| *kept < pair);
        let (before, after) = rest.split_at(stretch);
        into.extend_from_slice(before);
        into.push(pair);
        rest = after;
    }
    into.extend_from_slice(rest);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_merge_is_the_sorted_union() {
        let pairs = |step: u32, count: u32| -> Vec<PairId> {
            (0..count).map(|i| PairId { a: i * step / 7, b: 100 + i * step }).collect()
        };
        for (kept, fresh) in [(0, 0), (0, 5), (5, 0), (1, 1), (400, 3), (3, 400), (400, 400)] {
            let (kept, fresh) = (pairs(3, kept), pairs(5, fresh));
            let mut merged = vec![PairId { a: 9, b: 10 }];
            merge(&kept, &fresh, &mut merged);
            let mut sorted = [kept, fresh].concat();
            sorted.sort_unstable();
            assert_eq!(merged, sorted);
        }
    }
}
