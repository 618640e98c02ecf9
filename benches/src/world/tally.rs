//! What frames found.

use crate::lean::{Lean, Walked};
use asunder::Stats;

/// Sums over frames: of a heap that falls in, no frame stands for the others.
#[derive(Default)]
pub(super) struct Tally {
    frames: usize,
    found: Found,
}

/// What a frame finds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Pairs that the broad phase hands over.
    pub(super) candidates: usize,
    /// Pairs that share a point; the peer does not say.
    pub(super) touching: usize,
    /// Pairs with contact points, within the margin.
    pub(super) contacts: usize,
    /// Contact points.
    pub(super) points: usize,
}

impl Tally {
    /// One of our frames.
    pub(super) fn push(&mut self, stats: &Stats, walked: Walked) {
        self.push_counts(stats.candidates, stats.overlapping, walked);
    }

    /// One of the peer's.
    pub(super) fn push_peer(&mut self, peer: &Lean, walked: Walked) {
        self.push_counts(peer.candidates(), 0, walked);
    }

    fn push_counts(&mut self, candidates: usize, touching: usize, walked: Walked) {
        self.frames += 1;
        self.found.candidates += candidates;
        self.found.touching += touching;
        self.found.contacts += walked.contacts;
        self.found.points += walked.points;
    }

    /// A frame on average, in whole numbers.
    pub(super) fn mean(&self) -> Found {
        let mean = |sum: usize| (sum + self.frames / 2) / self.frames.max(1);
        let Found { candidates, touching, contacts, points } = self.found;
        Found {
            candidates: mean(candidates),
            touching: mean(touching),
            contacts: mean(contacts),
            points: mean(points),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_on_average_is_rounded_to_the_nearest() {
        let mut tally = Tally::default();
        assert_eq!(tally.mean(), Found::default());
        for (candidates, contacts) in [(10, 3), (20, 4), (31, 4)] {
            let stats = Stats { candidates, ..Stats::default() };
            tally.push(&stats, Walked { contacts, points: 7, ..Walked::default() });
        }
        // 61 / 3 and 11 / 3.
        assert_eq!(tally.mean(), Found { candidates: 20, touching: 0, contacts: 4, points: 7 });
    }
}
