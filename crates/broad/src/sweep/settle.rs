//! Hits to pairs: whose they are, where codes cannot tell, and whether the caller wants them.

use super::rows::{HITS, Hit, LANES};
use crate::columns::codes::Entry;
use crate::columns::owned;
use crate::pair::PairId;
use asunder_geometry::Bounds;
use core::ops::ControlFlow;

/// Most pairs of one load of hits.
const PAIRS: usize = HITS * LANES;

/// Room for the pairs of one load of hits.
pub(super) type Pairs = [PairId; PAIRS];

/// No pair yet.
pub(super) const NO_PAIRS: Pairs = [PairId { a: 0, b: 0 }; PAIRS];

/// What the boxes of a column are called outside: places in a column that was itself swept in columns, and so on
/// outwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Names<'a> {
    /// The entries' places in the column around.
    pub(super) members: &'a [u32],
    pub(super) outer: Option<&'a Names<'a>>,
}

/// What a sweep asks and whom it tells.
pub(super) struct Question<'a, B, A, S> {
    pub(super) boxes: &'a [B],
    pub(super) admit: &'a A,
    pub(super) sink: &'a mut S,
}

impl<B, A, S> Question<'_, B, A, S>
where
    B: Bounds,
    A: Fn(u32, u32) -> bool,
    S: FnMut(&[PairId]) -> ControlFlow<()>,
{
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
        let mut admitted = 0;
        for place in 0..count.min(PAIRS) {
            let pair = pairs[place];
            pairs[admitted] = pair;
            admitted += usize::from((self.admit)(pair.a, pair.b));
        }
        (self.sink)(&pairs[..admitted])
    }

    /// Hits to pairs that this column owns; returns how many.
    ///
    /// One box of every hit at a time, and the hits that have more once again: a loop over the boxes of each hit
    /// would end where the processor does not expect it (2 ns a pair, Zen 4, 2026-11-21).
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
            let mut more = 0;
            for place in 0..left {
                let hit = hits[place];
                let (index, is_close, rest) = hit.next();
                let (mut one, mut other, mut is_ours) =
                    owned(entries[hit.row as usize].place, entries[index as usize].place);
                let mut around = if NESTED { names } else { None };
                while let Some(&Names { members, outer }) = around {
                    let is_owned;
                    (one, other, is_owned) = owned(members[one as usize], members[other as usize]);
                    is_ours &= is_owned;
                    around = outer;
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
}
