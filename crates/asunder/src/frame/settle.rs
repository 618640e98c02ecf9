//! The results of a chunk's pairs, as candidates and records, in pair order.
//!
//! A candidate holds the number of its contact and whether that had begun, so a contact that goes on is not looked up
//! in last update's list.

use super::chunk::{Chunk, CollideStage, Way, manifolds_at};
use crate::collider::Collider;
use crate::contact::{Candidate, ContactNumber, Place, Record};
use crate::odometer::Odometer;
use crate::records::CHUNK;
use crate::slab::NOWHERE;
use crate::space::Space;
use asunder_broad::PairId;
use asunder_narrow::{Answer, Batch};
use std::sync::PoisonError;

/// Two bodies.
pub(super) type Bodies<'a, S> = (&'a Collider<S>, &'a Collider<S>);

/// Two bodies within their margins.
struct Met {
    overlapping: bool,
    user_data: (u64, u64),
    sensor: bool,
}

/// The results of a chunk: the shared lists are made from them when all chunks are done.
#[derive(Debug)]
pub(crate) struct Settled<S: Space> {
    /// The chunk's pairs when it was last processed, if they were noted.
    pairs: Vec<PairId>,
    are_noted: bool,
    /// Whether it is skipped in this update.
    is_quiet: bool,
    /// How each pair is processed.
    pub(super) ways: Vec<Way>,
    /// Contacts of last update that are over, and had begun, by their numbers.
    pub(super) ended: Vec<u32>,
    /// New persistent manifolds, and the chunk's pair that each belongs to.
    pub(super) kept: Vec<(u32, S::Persistent)>,
    /// Places of persistent manifolds that are no longer kept.
    pub(super) vacated: Vec<u32>,
    /// Each bullet that a motion may bring to another body, and that body; both ways round, where both are bullets.
    pub(super) bullets: Vec<(S::Key, S::Key)>,
    /// Memory for one kept manifold at most, lent by the store that all share.
    spare: S::Spare,
    pub(super) tally: Tally,
}

/// The data that later stages need of a chunk's records, so that they need not read these again: they are large, and
/// out of the cache by then.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    /// The second body of each; during a count, followed by the rest of the last count's.
    pub(super) seconds: Vec<u32>,
    /// How many were counted so far.
    counted: usize,
    /// Whether the second bodies are others than those of the last count.
    pub(super) has_others: bool,
    /// Pairs that the narrow phase computed.
    pub(super) computed: usize,
    pub(super) new: usize,
    pub(super) overlapping: usize,
    pub(super) manifolds: usize,
}

impl Tally {
    fn begin(&mut self) {
        (self.counted, self.has_others) = (0, false);
        (self.computed, self.new, self.overlapping, self.manifolds) = (0, 0, 0, 0);
    }

    #[inline]
    fn count<K>(&mut self, record: &Record<K>) {
        if self.seconds.get(self.counted) != Some(&record.pair.b) {
            self.seconds.truncate(self.counted);
            self.seconds.push(record.pair.b);
            self.has_others = true;
        }
        self.counted += 1;
        self.new += usize::from(record.is_new);
        self.overlapping += usize::from(record.overlapping);
        self.manifolds += record.manifolds.count();
    }

    fn end(&mut self) {
        self.has_others |= self.counted < self.seconds.len();
        self.seconds.truncate(self.counted);
    }

    /// Drops the last count: it is another world's.
    pub(super) fn forget(&mut self) {
        self.seconds.clear();
    }
}

impl<S: Space> Default for Settled<S> {
    fn default() -> Self {
        Self {
            pairs: Vec::new(),
            are_noted: false,
            is_quiet: false,
            ways: Vec::new(),
            ended: Vec::new(),
            kept: Vec::new(),
            vacated: Vec::new(),
            bullets: Vec::new(),
            spare: S::Spare::default(),
            tally: Tally::default(),
        }
    }
}

impl<S: Space> Settled<S> {
    /// Empties it but keeps its memory: the chunk is no longer in use.
    pub(super) fn clear(&mut self) {
        self.start_over();
        self.tally.end();
    }

    fn start_over(&mut self) {
        self.pairs.clear();
        self.are_noted = false;
        self.ways.clear();
        self.ended.clear();
        self.kept.clear();
        self.vacated.clear();
        self.bullets.clear();
        self.tally.begin();
    }

    /// Begins with a chunk of these pairs, which are noted if it may be skipped in the next update.
    pub(super) fn begin_with(&mut self, pairs: &[PairId], may_be_skipped: bool) {
        self.start_over();
        self.are_noted = may_be_skipped;
        if may_be_skipped {
            self.pairs.extend_from_slice(pairs);
        }
    }

    /// Whether nothing in the chunk can have changed: the same pairs, none of their bodies moved, and no contact was
    /// new at the last update. A body that came to the slot of another counts as moved.
    pub(super) fn is_unchanged(&self, pairs: &[PairId], is_moved: &[bool]) -> bool {
        let is_still = |pair: &PairId| !is_moved[pair.a as usize] && !is_moved[pair.b as usize];
        self.tally.new == 0 && self.are_noted && pairs == self.pairs && pairs.iter().all(is_still)
    }

    /// It will be processed, unless it is kept quiet in this update as well.
    pub(super) fn wake(&mut self) {
        self.is_quiet = false;
    }

    /// It is skipped: its last results are handed over again, except those that later stages have consumed.
    pub(super) fn keep_quiet(&mut self) {
        self.is_quiet = true;
        self.tally.computed = 0;
        self.tally.has_others = false;
    }

    #[inline]
    pub(super) const fn is_quiet(&self) -> bool {
        self.is_quiet
    }

    /// Gives up the place of a persistent manifold, if there is one.
    pub(super) fn vacate(&mut self, place: u32) {
        if place != NOWHERE {
            self.vacated.push(place);
        }
    }

    /// Gives up all that belongs to a pair that is no longer a candidate.
    pub(super) fn give_up(&mut self, gone: &Candidate<S::Key>) {
        self.vacate(gone.persistent);
        self.set_aside(gone.contact);
    }

    /// Notes that a contact of last update is over.
    fn set_aside(&mut self, gone: ContactNumber) {
        self.ended.extend(gone.begun());
    }

    /// Decides whether a contact has begun, and is new. One that had begun stays so until it is over.
    #[inline(always)]
    fn begin(&mut self, record: &mut Record<S::Key>, before: ContactNumber) {
        // Beyond the margins a contact is over, whatever a motion may bring.
        if record.speculative {
            self.set_aside(before);
        }
        let had_begun = !record.speculative && before.begun().is_some();
        record.begun = record.overlapping || had_begun;
        record.is_new = record.begun && !had_begun;
    }
}

impl<S: Space> CollideStage<'_, S> {
    /// Settles the candidates of a chunk and makes its records, in order of the pairs.
    pub(super) fn settle(&self, chunk: Chunk<'_, S>) {
        let Chunk { number: chunk_number, candidates, records, answered, settled } = chunk;
        let place_of = |start, end| Place { chunk: chunk_number as u32, start, end };
        let mut next_answer = 0;
        for (index, candidate) in candidates.iter_mut().enumerate() {
            let (way, last_contact) = (settled.ways[index], candidate.contact);
            let record = match way {
                Way::Carried => last_contact.number().map(|last_number| {
                    let last_record = self.last_records.get(last_number);
                    let (start, end) = self.carry(last_record, answered);
                    Record { manifolds: place_of(start, end), ..*last_record }
                }),
                Way::Moved { at, count, overlapping, user_data } => {
                    let manifolds = place_of(at, at + count);
                    let met = Met { overlapping, user_data, sensor: false };
                    Some(self.record_of(candidate, met, manifolds, answered))
                }
                Way::Computed => {
                    // Each job has an answer, in order.
                    let answer = answered.answers.get(next_answer);
                    next_answer += 1;
                    let numbers = [chunk_number as u32, index as u32];
                    answer
                        .and_then(|answer| self.record_anew((numbers, candidate), answer, answered, settled))
                }
                Way::Open => None,
            };
            candidate.contact = match record {
                Some(mut record) => {
                    settled.begin(&mut record, last_contact);
                    settled.tally.count(&record);
                    let record_number = chunk_number * CHUNK + records.len();
                    records.push(record);
                    ContactNumber::new(record_number, record.begun)
                }
                None => {
                    settled.set_aside(last_contact);
                    ContactNumber::NONE
                }
            };
        }
        settled.tally.computed = next_answer;
        settled.tally.end();
        // `choose` put those of lost candidates first. Numbers ascend as pairs do.
        settled.ended.sort_unstable();
    }

    /// Learns from the answer about a candidate, and makes the record of a contact. The numbers are the chunk's, and the
    /// pair's within it.
    #[inline(always)]
    fn record_anew(
        &self,
        ([chunk, index], candidate): ([u32; 2], &mut Candidate<S::Key>),
        answer: &Answer,
        answered: &Batch<S::Manifold>,
        settled: &mut Settled<S>,
    ) -> Option<Record<S::Key>> {
        // Both bodies exist: `answer` has seen to that.
        let (a, b) = self.bodies.get(candidate.keys.0).zip(self.bodies.get(candidate.keys.1))?;
        self.learn(candidate, answer);
        match self.kept_of((candidate.pair, (a, b)), answer, answered, settled) {
            Some(kept) => settled.kept.push((index, kept)),
            None => settled.vacate(core::mem::replace(&mut candidate.persistent, NOWHERE)),
        }
        let &Answer::Contact { overlapping, ref manifolds, .. } = answer else { return None };
        let manifolds = Place { chunk, start: manifolds.start, end: manifolds.end };
        let met = Met { overlapping, user_data: (a.user_data, b.user_data), sensor: a.sensor || b.sensor };
        Some(self.record_of(candidate, met, manifolds, answered))
    }

    /// Stores an answer about a pair for the next update.
    fn learn(&self, candidate: &mut Candidate<S::Key>, answer: &Answer) {
        (candidate.hint, candidate.until) = match *answer {
            Answer::Apart { hint, beyond } => {
                let PairId { a, b } = candidate.pair;
                let ways = [self.odometers[a as usize], self.odometers[b as usize]];
                (hint, Odometer::until(ways, beyond))
            }
            Answer::Contact { hint, .. } => (hint, f64::NEG_INFINITY),
        };
    }

    /// The persistent manifold of an answer, if the bodies touch and it is likely to last.
    fn kept_of(
        &self,
        (pair, (a, b)): (PairId, Bodies<'_, S>),
        answer: &Answer,
        answered: &Batch<S::Manifold>,
        settled: &mut Settled<S>,
    ) -> Option<S::Persistent> {
        let &Answer::Contact { hint, .. } = answer else { return None };
        if self.is_going(pair) {
            return None;
        }
        if S::is_ground(&a.shape) || S::is_ground(&b.shape) {
            // Which memory is lent changes no output. If chunks kept it, it would pile up in those without ground.
            if S::has_no_memory(&settled.spare) {
                S::lend(&mut self.spare.lock().unwrap_or_else(PoisonError::into_inner), &mut settled.spare);
            }
        }
        let job = S::job([a, b], [a.margin + b.margin, 0.0], hint);
        let step = self.odometers[pair.a as usize].step() + self.odometers[pair.b as usize].step();
        S::persistent(&job, answer, &answered.manifolds, step, &mut settled.spare)
    }

    /// Whether either body has a motion: the margin then differs from frame to frame, so nothing is kept.
    #[inline]
    pub(super) fn is_going(&self, pair: PairId) -> bool {
        let motions = self.motions;
        !motions.is_empty() && (motions.of(pair.a).is_some() || motions.of(pair.b).is_some())
    }

    /// Carries over a contact's manifolds from last update; returns where they start and end.
    fn carry(&self, last: &Record<S::Key>, answered: &mut Batch<S::Manifold>) -> (u32, u32) {
        let to = &mut answered.manifolds;
        let start = to.len() as u32;
        to.extend_from_slice(manifolds_at(&last.manifolds, self.last_answered));
        (start, to.len() as u32)
    }

    /// A contact as the narrow phase alone knows it: [`Settled::begin`] decides whether it has begun, and is new.
    #[inline(always)]
    fn record_of(
        &self,
        &Candidate { pair, keys, .. }: &Candidate<S::Key>,
        met: Met,
        manifolds: Place,
        answered: &Batch<S::Manifold>,
    ) -> Record<S::Key> {
        // Without a motion, no manifold need be read.
        let speculative = self.is_going(pair) && !met.overlapping && {
            let found = &answered.manifolds[manifolds.start as usize..manifolds.end as usize];
            let bodies = self.bodies.get(keys.0).zip(self.bodies.get(keys.1));
            let is_beyond = |(a, b): Bodies<'_, S>| S::least_separation(found) > a.margin + b.margin;
            !found.is_empty() && bodies.is_some_and(is_beyond)
        };
        let Met { overlapping, user_data, sensor } = met;
        Record {
            pair,
            keys,
            user_data,
            sensor,
            overlapping,
            begun: false,
            is_new: false,
            speculative,
            manifolds,
        }
    }
}
