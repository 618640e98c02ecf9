//! Manifolds in every bit: those of the narrow phase for each pair alone, with the pair's hint of the last update.

use super::{Slots, Tenant};
use crate::engine::Met;
use crate::judged::Judged;
use asunder_narrow::Hint;
use std::collections::BTreeMap;

/// Hints by the slots of two bodies, with their keys.
type Hints<S> = BTreeMap<Slots, ((<S as asunder::Space>::Key, <S as asunder::Space>::Key), Hint)>;

/// The hints of each pair whose AABBs overlap.
#[derive(Clone, Debug)]
pub(super) struct Bits<S: Judged> {
    last: Hints<S>,
    now: Hints<S>,
}

impl<S: Judged> Default for Bits<S> {
    fn default() -> Self {
        Self { last: Hints::<S>::new(), now: Hints::<S>::new() }
    }
}

impl<S: Judged> Bits<S> {
    pub(super) fn ask(&mut self, slots: Slots, [a, b]: [&Tenant<S>; 2], is_reshaped: bool) -> Met<S> {
        let keys = (a.key, b.key);
        let known = self.last.get(&slots).filter(|(known, _)| *known == keys && !is_reshaped);
        let (hint, met) = S::meet(&a.body, &b.body, known.map_or(Hint::NONE, |(_, hint)| *hint));
        if S::boxes_overlap(&a.body, &b.body) {
            self.now.insert(slots, (keys, hint));
        }
        met
    }

    /// Ends an update.
    pub(super) fn turned_over(self) -> Self {
        Self { last: self.now, now: Hints::<S>::new() }
    }
}
