//! Times our side and the peer's in turns.

use crate::clock::{Effort, Samples, time};
use crate::row::Row;

/// Times of both sides of a row. They take turns, so that disturbances of the machine affect both.
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
    /// The peer's times.
    pub peer: Samples,
}

impl Race {
    /// One turn of each side, in which each does `count` units of the row; which comes first also alternates. Returns
    /// both results.
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

    /// Takes turns until it is over; also returns what `says` makes of the first results.
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

    /// Whether one side has used up the time of a variant.
    pub fn is_spent(&self, effort: &Effort) -> bool {
        self.ours.spent().max(self.peer.spent()) > effort.nanoseconds()
    }

    /// Whether all rounds are done, or one side has used up its time.
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
