//! Pairs that a snapshot names: candidates, contacts and events.

use super::content::{CandidateForm, ContactForm, SlotForm};
use super::error::SnapshotError;
use super::shapes::Saved;
use super::slots::version_of;
use crate::contact::{Candidate, ContactNumber, Place, Record};
use crate::event::Event;
use crate::motion::Hit;
use crate::slab::NOWHERE;
use crate::world::slot_of;
use asunder_broad::PairId;
use core::cmp::Ordering;

/// Checks pairs against the slots and their versions.
pub(super) struct Judge<'a, S: Saved> {
    pub(super) slots: &'a [SlotForm<S>],
}

/// Candidates, and the persistent manifolds that they point into.
type Candidates<S> =
    (Vec<Candidate<<S as crate::space::Space>::Key>>, Vec<<S as crate::space::Space>::Persistent>);

/// Contacts, and the manifolds that they point into.
type Records<S> = (Vec<Record<<S as crate::space::Space>::Key>>, Vec<<S as crate::space::Space>::Manifold>);

impl<S: Saved> Judge<'_, S> {
    /// Whether a body has or had this key; a future key would be handed out a second time.
    fn has_been(&self, key: S::Key) -> bool {
        let slot = self.slots.get((slot_of(key) as usize).wrapping_sub(1));
        slot.is_some_and(|slot| {
            let version = version_of(key);
            version < slot.version || (version == slot.version && slot.body.is_some())
        })
    }

    /// The pair of two keys, the one in the lower slot first.
    fn pair(
        &self,
        list: &'static str,
        index: usize,
        (a, b): (S::Key, S::Key),
    ) -> Result<PairId, SnapshotError> {
        if !self.has_been(a) || !self.has_been(b) {
            return Err(SnapshotError::Key { list, index });
        }
        let pair = PairId { a: slot_of(a), b: slot_of(b) };
        if pair.a < pair.b { Ok(pair) } else { Err(SnapshotError::Order { list, index }) }
    }

    /// In pair order; where a slot was reused, two may have the same pair.
    pub(super) fn events(&self, events: &[Event<S::Key>]) -> Result<(), SnapshotError> {
        let list = "events";
        let mut last = None;
        for (index, event) in events.iter().enumerate() {
            let pair = self.pair(list, index, event.bodies())?;
            if last.is_some_and(|last| last > pair) {
                return Err(SnapshotError::Order { list, index });
            }
            last = Some(pair);
        }
        Ok(())
    }

    /// By the bullet's slot, then by time; the other may be in any slot. A slot has had one bullet in an update.
    pub(super) fn impacts(&self, impacts: &[Hit<S::Key, S::Impact>]) -> Result<(), SnapshotError> {
        let list = "impacts";
        let is_stranger = |hit: &Hit<S::Key, _>| !self.has_been(hit.bullet) || !self.has_been(hit.other);
        if let Some(index) = impacts.iter().position(is_stranger) {
            return Err(SnapshotError::Key { list, index });
        }
        if let Some(index) = impacts.iter().position(|hit| !S::is_real(&hit.impact)) {
            return Err(SnapshotError::Impact { index });
        }
        let is_before = |one: &Hit<S::Key, S::Impact>, other: &Hit<S::Key, S::Impact>| {
            let times = [one, other].map(|hit| S::fraction(&hit.impact));
            match slot_of(one.bullet).cmp(&slot_of(other.bullet)) {
                Ordering::Equal => one.bullet == other.bullet && times[0].total_cmp(&times[1]).is_le(),
                by_slot => by_slot.is_lt(),
            }
        };
        match impacts.windows(2).position(|two| !is_before(&two[0], &two[1])) {
            Some(before) => Err(SnapshotError::Order { list, index: before + 1 }),
            None => Ok(()),
        }
    }

    /// Candidates, and the persistent manifolds that they point into.
    pub(super) fn candidates(&self, forms: &[CandidateForm<S>]) -> Result<Candidates<S>, SnapshotError> {
        let list = "candidates";
        let mut all = Vec::new();
        let mut candidates: Vec<Candidate<S::Key>> = Vec::with_capacity(forms.len());
        for (index, form) in forms.iter().enumerate() {
            let pair = self.pair(list, index, form.keys)?;
            if candidates.last().is_some_and(|last| last.pair >= pair) {
                return Err(SnapshotError::Order { list, index });
            }
            if !form.persistent.iter().all(S::is_lasting)
                || form.until.is_some_and(|until| !until.is_finite())
            {
                return Err(SnapshotError::Candidate { index });
            }
            let persistent = if form.persistent.is_some() { all.len() as u32 } else { NOWHERE };
            all.extend(form.persistent.clone());
            let until = form.until.unwrap_or(f64::NEG_INFINITY);
            let contact = ContactNumber::NONE;
            candidates.push(Candidate { pair, keys: form.keys, hint: form.hint, persistent, contact, until });
        }
        Ok((candidates, all))
    }

    /// Each contact must be that of a candidate, which gets its number: two sorted lists, walked once.
    pub(super) fn records(
        &self,
        forms: &[ContactForm<S>],
        candidates: &mut [Candidate<S::Key>],
    ) -> Result<Records<S>, SnapshotError> {
        let mut candidates = candidates.iter_mut();
        let (mut records, mut all) = (Vec::with_capacity(forms.len()), Vec::new());
        for (index, form) in forms.iter().enumerate() {
            // Candidates have been checked. A contact out of order finds none left.
            let Some(candidate) = candidates.find(|candidate| candidate.keys == form.keys) else {
                return Err(SnapshotError::Contact { index });
            };
            let ContactForm { keys, user_data, sensor, overlapping, begun, is_new, speculative, manifolds } =
                form;
            let unfounded = !begun && (*overlapping || *is_new);
            let contradicts =
                unfounded || (*speculative && *overlapping) || (*sensor && !manifolds.is_empty());
            if contradicts {
                return Err(SnapshotError::Contact { index });
            }
            if !manifolds.iter().all(S::is_sound) {
                return Err(SnapshotError::Manifold { index });
            }
            candidate.contact = ContactNumber::new(index, *begun);
            let start = all.len();
            all.extend_from_slice(manifolds);
            u32::try_from(all.len()).map_err(|_| SnapshotError::Contact { index })?;
            records.push(Record {
                pair: candidate.pair,
                keys: *keys,
                user_data: *user_data,
                manifolds: Place { chunk: 0, start: start as u32, end: all.len() as u32 },
                sensor: *sensor,
                overlapping: *overlapping,
                begun: *begun,
                is_new: *is_new,
                speculative: *speculative,
            });
        }
        Ok((records, all))
    }
}
