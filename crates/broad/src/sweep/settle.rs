//! From hits to pairs: applies the owner rule, and tests the boxes where codes leave it undecided.

use super::rows::{HITS, Hit, LANES};
use super::segments::{Item, Segments, Slab, axes_from};
use super::trial::note;
use crate::columns::codes::Entry;
use crate::columns::{PLACE, owned};
use crate::pair::PairId;
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// Most pairs in one buffer of hits.
const PAIRS: usize = HITS * LANES;

/// Room for the pairs of one buffer of hits.
pub(super) type Pairs = [PairId; PAIRS];

/// No pair yet.
pub(super) const NO_PAIRS: Pairs = [PairId { a: 0, b: 0 }; PAIRS];

/// Maps the boxes of nested columns to places in the column around them, and so on outwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names<'a> {
    /// The entries' places in the column around.
    pub(super) members: &'a [u32],
    pub(super) outer: Option<&'a Names<'a>>,
}

/// The place of a box in the caller's list, from its place in nested columns.
pub(super) fn outermost(place: u32, names: Option<&Names<'_>>) -> u32 {
    let mut place = place;
    let mut around = names;
    while let Some(&Names { members, outer }) = around {
        place = members[place as usize] & PLACE;
        around = outer;
    }
    place
}

/// The outermost places of two boxes of a column, and whether all columns around own the pair.
#[inline(always)]
fn outside(mut one: u32, mut other: u32, names: Option<&Names<'_>>) -> (u32, u32, bool) {
    let (mut is_ours, mut around) = (true, names);
    while let Some(&Names { members, outer }) = around {
        let is_owned;
        (one, other, is_owned) = owned(members[one as usize], members[other as usize]);
        is_ours &= is_owned;
        around = outer;
    }
    (one, other, is_ours)
}

/// Takes pairs, many at a time, in a slice that it may overwrite. As a trait object called for batches it costs the
/// kernels next to nothing, and they need not be compiled anew for each caller.
pub(super) type Sink<'s> = dyn FnMut(&mut [PairId]) -> ControlFlow<()> + 's;

/// The boxes that are swept, and where their pairs go.
pub(super) struct Question<'a, B> {
    pub(super) boxes: &'a [B],
    pub(super) sink: &'a mut Sink<'a>,
}

impl<B: Bounds> Question<'_, B> {
    /// Hands over the pairs of some hits.
    #[inline(always)]
    pub(super) fn answer<const NESTED: bool>(
        &mut self,
        hits: &mut [Hit],
        entries: &[Entry],
        names: Option<&Names<'_>>,
        pairs: &mut Pairs,
    ) -> ControlFlow<()> {
        let count = self.settle::<NESTED>(hits, entries, names, pairs);
        self.hand(count, pairs)
    }

    /// Hands over the first pairs.
    #[inline(always)]
    fn hand(&mut self, count: usize, pairs: &mut Pairs) -> ControlFlow<()> {
        (self.sink)(&mut pairs[..count.min(PAIRS)])
    }

    /// Turns hits into the pairs that this column owns; returns how many.
    ///
    /// Takes one box of every hit in a round, and then the hits with boxes left in the next: the end of an inner loop
    /// over the boxes of each hit would be mispredicted (2 ns per pair, Zen 4, 2026-11-21).
    #[inline(always)]
    fn settle<const NESTED: bool>(
        &self,
        hits: &mut [Hit],
        entries: &[Entry],
        names: Option<&Names<'_>>,
        pairs: &mut Pairs,
    ) -> usize {
        let (mut count, mut left) = (0, hits.len());
        while left > 0 {
            note(left);
            let mut more = 0;
            for place in 0..left {
                let hit = hits[place];
                let (index, is_close, rest) = hit.next();
                let (mut one, mut other, mut is_ours) =
                    owned(entries[hit.row as usize].place, entries[index as usize].place);
                if NESTED {
                    let is_owned;
                    (one, other, is_owned) = outside(one, other, names);
                    is_ours &= is_owned;
                }
                let pair = PairId::new(one, other);
                if is_close {
                    is_ours &= self.boxes[pair.a as usize].overlaps(&self.boxes[pair.b as usize]);
                }
                pairs[count % PAIRS] = pair;
                count += usize::from(is_ours);
                hits[more] = rest;
                more += usize::from(!rest.is_done());
            }
            left = more;
        }
        count
    }

    /// Hands over the pairs of some boxes by segments, at a bounded cost however they lie. `name` gives the outermost
    /// places of two boxes, and whether the pair is wanted here.
    pub(super) fn ask_segments(
        &mut self,
        segments: &mut Segments,
        items: impl Iterator<Item = Item>,
        (sweep, slab): (usize, Slab),
        name: impl Fn(u32, u32) -> (u32, u32, bool),
        pairs: &mut Pairs,
    ) -> ControlFlow<()> {
        let mut count = 0;
        let (axes, most) = axes_from::<B>(sweep);
        segments.sweep(items, (&axes[..most], slab), &mut |one, other| {
            let (one, other, is_ours) = name(one, other);
            pairs[count] = PairId::new(one, other);
            count += usize::from(is_ours);
            if count < PAIRS {
                return ControlFlow::Continue(());
            }
            self.hand(core::mem::take(&mut count), pairs)
        })?;
        self.hand(count, pairs)
    }

    /// Whether two boxes of a column overlap.
    pub(super) fn overlap(&self, one: &Entry, other: &Entry, names: Option<&Names<'_>>) -> bool {
        let pick = |entry: &Entry| &self.boxes[outermost(entry.place & PLACE, names) as usize];
        pick(one).overlaps(pick(other))
    }

    /// The pairs of a column by segments.
    pub(super) fn ask_column(
        &mut self,
        segments: &mut Segments,
        (entries, sweep): (&[Entry], usize),
        names: Option<&Names<'_>>,
        pairs: &mut Pairs,
    ) -> ControlFlow<()> {
        let boxes = self.boxes;
        let pick = |entry: &Entry| &boxes[outermost(entry.place & PLACE, names) as usize];
        let items = (0..).zip(entries).filter_map(|(place, entry)| Item::new(pick(entry), place));
        let name = |one: u32, other: u32| {
            let (one, other, is_ours) = owned(entries[one as usize].place, entries[other as usize].place);
            let (one, other, is_owned) = outside(one, other, names);
            (one, other, is_ours & is_owned)
        };
        self.ask_segments(segments, items, (sweep, Slab::ALL), name, pairs)
    }

    /// The pairs of all boxes by segments.
    pub(super) fn ask_all(
        &mut self,
        segments: &mut Segments,
        (sweep, slab): (usize, Slab),
    ) -> ControlFlow<()> {
        let boxes = self.boxes;
        let items = (0..).zip(boxes).filter_map(|(place, one)| Item::new(one, place));
        self.ask_segments(segments, items, (sweep, slab), |one, other| (one, other, true), &mut { NO_PAIRS })
    }
}
