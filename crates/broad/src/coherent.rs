//! Temporal coherence: keeps the pairs of boxes that rest, and looks up the boxes that move.
//!
//! ```text
//! if more than a fifth of the boxes moved: sweep all
//! else, for the boxes that have moved since the last sweep of all (the movers):
//!   drop the kept pairs of boxes that have just become movers
//!   look up each mover in the columns that the sweep of all left behind   rest
//!   movers that look in the same place are tested against each other; if too many do, sweep the movers by themselves
//!   sort these pairs, and merge them with the kept ones
//! sweep all again once a fifth of all boxes are movers; once looking up movers that have come to rest has cost as much
//!   as a sweep; or once movers reach so many boxes at rest that looking them up would cost as much
//! ```
//! A frame costs 150 ns per mover among 10,000 boxes, 240 among 100,000 and 840 among a million, and a copy of the kept
//! pairs (0.3 ns each); boxes that rest cost nothing. It was 230, 380 and 1,030 with a sweep of the movers, strips in
//! six lists, and a merge that searched for the place of each pair (a hundredth moves; Intel Xeon, 2.5 GHz, 2026-11-28,
//! medians in turns). Tried: prefetching what is looked up six lookups later: a tenth less from 100,000 boxes on, 3 %
//! more for 10,000, and needs unsafe code. The list equals that of [`Sweep`](crate::Sweep) whatever came before:
//! history affects only the cost.

mod rest;

use crate::columns::Column;
use crate::pair::{PairId, TooManyPairs};
use crate::sweep::order::Order;
use crate::sweep::{Admit, Sweep, keep};
use crate::width::{Kernel, Width, widest};
use asunder_geometry::Bounds;
use rest::{Met, Rest};

/// Finds all overlapping pairs of boxes, few of which move from frame to frame.
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
#[derive(Debug)]
pub struct CoherentSweep<B> {
    /// The sweep of all boxes, whose columns are kept.
    sweep: Sweep,
    rest: Rest<B>,
    is_kept: bool,
    /// Number of boxes at the last call.
    known: usize,
    /// Boxes that have moved since the last sweep of all, ascending.
    movers: Vec<u32>,
    /// Pairs of two boxes that have not moved since.
    kept: Vec<PairId>,
    /// Movers that stood still, summed over frames.
    idle: usize,
    /// The sweep of movers alone, for where too many are in one place; their boxes, and the pairs it found.
    sweep_of_movers: Sweep,
    moving: Vec<B>,
    among: Vec<PairId>,
    /// Pairs with at least one mover.
    fresh: Vec<PairId>,
    order: Order,
}

asunder_geometry::copied!(CoherentSweep<B>, for [B: Bounds], { sweep, rest, is_kept, known, movers, kept, idle }
    but { sweep_of_movers, moving, among, fresh, order });

/// If more than one box in this many moves, all are swept.
pub(crate) const FEW: usize = 5;

/// Looking up one mover costs about as much as a sweep of all does for this many boxes.
const IDLE_A_BOX: usize = 2;

/// Pairs that the filter is asked about at a time.
const AT_ONCE: usize = 1024;

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
            rest: Rest::new(),
            is_kept: false,
            known: 0,
            movers: Vec::new(),
            kept: Vec::new(),
            idle: 0,
            sweep_of_movers: Sweep::new(),
            moving: Vec::new(),
            among: Vec::new(),
            fresh: Vec::new(),
            order: Order::default(),
        }
    }

    /// Replaces `pairs` by all overlapping pairs that `admit` lets pass, each once, sorted.
    ///
    /// `moved` names the boxes that differ from the last call in any way, their filters included; in any order,
    /// repetitions allowed. Boxes beyond those of the last call are new, and need not be named. All others are assumed
    /// to be unchanged. To remove a box, make it an empty set. `admit` is asked as by [`Sweep::pairs`].
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
        self.update_by(boxes, moved, &|pairs| keep(pairs, &admit), limit, pairs)
    }

    /// The same, with a filter of many pairs at a time.
    pub(crate) fn update_by(
        &mut self,
        boxes: &[B],
        moved: &[u32],
        admit: &Admit,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        let new = boxes.len().saturating_sub(self.known);
        let few = (moved.len() + new) * FEW <= boxes.len() && boxes.len() >= self.known;
        let were = self.movers.len();
        if few && self.is_kept {
            self.note_movers(moved, boxes.len());
        }
        self.known = boxes.len();
        if !few || self.is_worn(0) {
            return self.sweep_all(boxes, few, admit, limit, pairs);
        }
        self.idle += self.movers.len().saturating_sub(moved.len());
        if self.movers.len() > were {
            self.movers.sort_unstable();
            let rest = &self.rest;
            self.kept.retain(|pair| rest.rests(pair.a) && rest.rests(pair.b));
        }
        let room = limit.checked_sub(self.kept.len()).ok_or(TooManyPairs { limit });
        let have_met = room.and_then(|room| self.pairs_of_movers(boxes, admit, room));
        let Ok(have_met) = have_met else {
            pairs.clear();
            return Err(TooManyPairs { limit });
        };
        if !have_met {
            return self.sweep_all(boxes, few, admit, limit, pairs);
        }
        self.order.sort(&mut self.fresh, boxes.len());
        merge(&self.kept, &self.fresh, pairs);
        Ok(())
    }

    /// The columns of the last sweep of all boxes, as [`Sweep::columns`] lists them. Boxes that have moved since are
    /// looked up in them, but not sorted into any.
    pub fn columns(&self) -> impl Iterator<Item = Column> {
        self.sweep.columns()
    }

    /// Memory that is held for the next call, in bytes: some 85 per box (30 to 60 more where several threads sort
    /// them), 16 per pair, and 44 for every column that a mover reaches, at most about four for every box; where
    /// columns are of no use, another 64 per box, for each thread.
    ///
    /// ```
    /// assert_eq!(asunder_broad::CoherentSweep::<asunder_geometry::Aabb2>::new().bytes(), 0);
    /// ```
    pub fn bytes(&self) -> usize {
        let pairs = self.kept.capacity() + self.among.capacity() + self.fresh.capacity();
        self.sweep.bytes()
            + self.sweep_of_movers.bytes()
            + self.rest.bytes()
            + self.order.bytes()
            + self.movers.capacity() * 4
            + self.moving.capacity() * size_of::<B>()
            + pairs * size_of::<PairId>()
    }

    fn note_movers(&mut self, moved: &[u32], count: usize) {
        for place in moved.iter().copied().chain(self.known as u32..count as u32) {
            if (place as usize) < count && self.rest.wakes(place) {
                self.movers.push(place);
            }
        }
    }

    /// Whether all boxes are to be swept again, if so many more have moved.
    pub(crate) fn is_worn(&self, more: usize) -> bool {
        let are_few = (self.movers.len() + more) * FEW <= self.known;
        !(self.is_kept && are_few && self.idle * IDLE_A_BOX <= self.known)
    }

    /// Number of boxes that have moved since the last sweep of all.
    pub(crate) fn movers(&self) -> usize {
        self.movers.len()
    }

    /// Discards what is kept: the next call sweeps all boxes.
    pub(crate) fn forget(&mut self) {
        self.is_kept = false;
    }

    /// Sweeps all boxes. With `keep`, keeps what the next call needs to look up movers: a frame in which few boxes move
    /// is likely to be followed by another.
    pub(crate) fn sweep_all(
        &mut self,
        boxes: &[B],
        keep: bool,
        admit: &Admit,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        self.is_kept = false;
        self.known = boxes.len();
        self.idle = 0;
        self.movers.clear();
        self.sweep.pairs_by(boxes, admit, limit, pairs)?;
        if keep && let Some((grid, columns)) = self.sweep.put_together() {
            self.rest.settle(boxes, grid, columns);
            self.kept.clear();
            self.kept.extend_from_slice(pairs);
            self.is_kept = true;
        }
        Ok(())
    }

    /// Finds the pairs with at least one mover, unsorted. Returns false if a sweep of all would cost less.
    fn pairs_of_movers(&mut self, boxes: &[B], admit: &Admit, limit: usize) -> Result<bool, TooManyPairs> {
        let Self { movers, moving, among, fresh, .. } = self;
        fresh.clear();
        let mut found = Gathered { pairs: fresh, admitted: 0, admit, limit };
        // First what may turn out to be too much: no pair has been passed to the filter by then.
        let met = match self.sweep.whole() {
            Some(sorted) => self.rest.meet(sorted, boxes, movers, &mut found),
            None => Met::Resting,
        };
        if met == Met::Nobody {
            return Ok(false);
        }
        found.sift();
        let room = limit.checked_sub(fresh.len()).ok_or(TooManyPairs { limit })?;
        if met == Met::Resting {
            moving.clear();
            moving.extend(movers.iter().map(|&place| boxes[place as usize]));
            let place = |mover: u32| movers[mover as usize];
            let admits = |a: u32, b: u32| admit(&mut [PairId { a: place(a), b: place(b) }]) == 1;
            self.sweep_of_movers.pairs(moving, admits, room, among)?;
            fresh.extend(among.iter().map(|pair| PairId { a: place(pair.a), b: place(pair.b) }));
        }
        Ok(true)
    }
}

/// Collects pairs that come one by one, and filters them many at a time.
struct Gathered<'a> {
    pairs: &'a mut Vec<PairId>,
    /// So many of them have passed the filter.
    admitted: usize,
    admit: &'a Admit<'a>,
    limit: usize,
}

impl Gathered<'_> {
    /// Adds a pair; false if there are too many.
    #[inline]
    fn take(&mut self, pair: PairId) -> bool {
        self.pairs.push(pair);
        self.pairs.len() < self.admitted + AT_ONCE || self.sift()
    }

    /// Filters the pairs that have not been yet; false if there are too many.
    fn sift(&mut self) -> bool {
        self.admitted += (self.admit)(&mut self.pairs[self.admitted..]);
        self.pairs.truncate(self.admitted);
        self.admitted <= self.limit
    }
}

/// Pairs that are copied at a time while the next one to be inserted is far, and once it is near.
const STRETCH: usize = 64;
const STEP: usize = 8;

/// Replaces `into` by the merge of both sorted lists.
fn merge(kept: &[PairId], fresh: &[PairId], into: &mut Vec<PairId>) {
    into.resize(kept.len() + fresh.len(), PairId { a: 0, b: 0 });
    widest(Merging { kept, fresh, into });
}

/// Merges both sorted lists into one of their total length.
///
/// Copies pieces of fixed length. The last piece before an inserted pair may be too long; the next one overwrites the
/// excess. How many of its pairs come before is counted without branches, so that few are mispredicted.
struct Merging<'a> {
    kept: &'a [PairId],
    fresh: &'a [PairId],
    into: &'a mut [PairId],
}

impl Kernel for Merging<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, _: W) {
        let Self { kept: mut rest, fresh, into: mut to } = self;
        let number = |pair: &PairId| u64::from(pair.a) << 32 | u64::from(pair.b);
        for pair in fresh {
            let this = number(pair);
            while let Some((stretch, after)) = rest.split_first_chunk::<STRETCH>()
                && number(&stretch[STRETCH - 1]) < this
            {
                to[..STRETCH].copy_from_slice(stretch);
                (rest, to) = (after, &mut to[STRETCH..]);
            }
            let mut before = 0;
            while let Some((step, after)) = rest.split_first_chunk::<STEP>() {
                to[..STEP].copy_from_slice(step);
                before = 0;
                for kept in step {
                    before += u64::from(number(kept) < this);
                }
                if before < STEP as u64 {
                    break;
                }
                (rest, to) = (after, &mut to[STEP..]);
            }
            let mut before = before as usize;
            if rest.len() < STEP {
                before = rest.partition_point(|kept| kept < pair);
                to[..before].copy_from_slice(&rest[..before]);
            }
            to[before] = *pair;
            (rest, to) = (&rest[before..], &mut to[before + 1..]);
        }
        to.copy_from_slice(rest);
    }
}

#[cfg(test)]
mod tests;
