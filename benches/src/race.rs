//! Our side and the peer's, in turns.

use crate::clock::{Effort, Samples, time};
use crate::row::Row;

/// Times of both sides of a row, who take turns so that whatever else the machine does falls on both.
///
/// ```
/// use asunder_benches::{clock::Effort, race::Race, row::Row};
/// let (mut race, mut row) = (Race::default(), Row::new("sum", "number", 1000));
/// while !race.is_over(&Effort { rounds: 3, ..Effort::quick() }) {
///     let (ours, peer) = race.turn(1000, || (0..1000_u64).sum::<u64>(), || 499_500);
///     assert_eq!(ours, peer);
/// }
/// race.tell(&mut row, "what is known");
/// assert!(row.done == 3 && row.ours_ns.is_some() && row.peer_ns.is_some());
/// assert!(row.ours_quartiles.is_some_and(|[low, high]| low <= high) && row.peer_quartiles.is_some());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Race {
    /// Our times.
    pub ours: Samples,
    /// The peer's.
    pub peer: Samples,
}

impl Race {
    /// One turn of either side, of so many of what the row counts; who is first takes turns, too. Returns what both
    /// found.
    pub fn turn<A, B>(&mut self, count: usize, ours: impl FnOnce() -> A, peer: impl FnOnce() -> B) -> (A, B) {
        let ((ns, found), (peer_ns, found_by_peer)) = if self.ours.len().is_multiple_of(2) {
            let ours = time(ours);
            (ours, time(peer))
        } else {
            let peer = time(peer);
            (time(ours), peer)
        };
        self.ours.push(ns / count as f64, ns);
        self.peer.push(peer_ns / count as f64, peer_ns);
        (found, found_by_peer)
    }

    /// Turns of so many until it is over, and what is said of what both found first.
    pub fn run<A, B>(
        effort: &Effort,
        count: usize,
        mut ours: impl FnMut() -> A,
        mut peer: impl FnMut() -> B,
        says: impl Fn(A, B) -> String,
    ) -> (Self, String) {
        let (mut race, mut said) = (Self::default(), None);
        while !race.is_over(effort) {
            let (found, found_by_peer) = race.turn(count, &mut ours, &mut peer);
            said.get_or_insert_with(|| says(found, found_by_peer));
        }
        (race, said.unwrap_or_default())
    }

    /// Whether one side has spent the time of a variant.
    pub fn is_spent(&self, effort: &Effort) -> bool {
        self.ours.spent().max(self.peer.spent()) > effort.nanoseconds()
    }

    /// Whether there were all rounds, or one side has spent its time.
    pub fn is_over(&self, effort: &Effort) -> bool {
        self.ours.len() >= effort.rounds || self.is_spent(effort)
    }

    /// Fills in the row's figures.
    pub fn tell(&self, row: &mut Row, peer: &'static str) {
        row.tell(&self.ours);
        row.done = self.ours.len();
        row.tell_peer(peer, &self.peer);
        row.finish();
    }
}
