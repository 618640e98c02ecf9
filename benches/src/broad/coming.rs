//! Stands in for what `asunder_broad` does not offer yet. To be deleted when it does: then `ours.rs` imports the names
//! from there.

use asunder_broad::{PairId, Sweep, TooManyPairs};
use asunder_geometry::Bounds;

/// Memory held, in bytes. An inherent method of the same name wins over it.
pub(super) trait Bytes {
    fn bytes(&self) -> usize {
        0
    }
}

impl Bytes for Sweep {}

/// Keeps nothing so far.
#[derive(Default)]
pub(super) struct CoherentSweep(Sweep);

impl CoherentSweep {
    pub(super) fn new() -> Self {
        Self::default()
    }

    pub(super) fn update<B: Bounds>(
        &mut self,
        boxes: &[B],
        _moved: &[u32],
        admit: impl Fn(u32, u32) -> bool + Sync,
        limit: usize,
        pairs: &mut Vec<PairId>,
    ) -> Result<(), TooManyPairs> {
        self.0.pairs(boxes, admit, limit, pairs)
    }

    pub(super) fn bytes(&self) -> usize {
        self.0.bytes()
    }
}
