//! Sums of what frames find.

use crate::lean::{Lean, Walked};
use asunder::Stats;

/// Sums over frames: no frame of a heap that falls is representative.
#[derive(Default)]
pub(super) struct Tally {
    frames: usize,
    found: Found,
}

/// The counts of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Found {
    /// Pairs that the broad phase reports.
    pub(super) candidates: usize,
    /// Pairs that share a point; not known for the peer.
    pub(super) touching: usize,
    /// Pairs with contact points, within the margin.
    pub(super) contacts: usize,
    /// Contact points.
    pub(super) points: usize,
}

impl Tally {
    /// Adds one of our frames.
    pub(super) fn push(&mut self, stats: &Stats, walked: Walked) {
        self.push_counts(stats.candidates, stats.overlapping, walked);
    }

    /// Adds one of the peer's frames.
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

    /// The average frame, in whole numbers.
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
