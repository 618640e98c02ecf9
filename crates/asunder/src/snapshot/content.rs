//! The contents of a snapshot.

use super::body::BodyForm;
use super::shapes::{Collected, Saved, ShapeRef, Table};
use super::slots::{key_of, keys_to_come, version_of};
use crate::contact::{Candidate, Record};
use crate::event::Event;
use crate::frame::manifolds_at;
use crate::motion::Hit;
use crate::odometer::Odometer;
use crate::slab::Slab;
use crate::stats::Stats;
use crate::world::{World, slot_of};
use asunder_narrow::Hint;
use serde::{Deserialize, Serialize};

/// The number of this format; it changes whenever a field is added, removed or changes its meaning.
pub(super) const FORMAT: u32 = 8;

/// A world, without data that can be derived.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "World", bound = "", deny_unknown_fields)]
pub(super) struct Content<S: Saved> {
    pub(super) format: u32,
    pub(super) shapes: Table<S>,
    /// From slot 1 on; slot 0 is never used.
    pub(super) slots: Vec<SlotForm<S>>,
    /// Empty slots in the order in which they will be filled.
    pub(super) free: Vec<u32>,
    /// Slots whose box is out of date; slots whose body moved since contacts were made; slots whose shape changed since
    /// then. Ascending.
    pub(super) dirty: Vec<u32>,
    pub(super) moved: Vec<u32>,
    pub(super) reshaped: Vec<u32>,
    /// Slots with a motion for the next update, or that lost one with their body. Ascending.
    pub(super) motions: Vec<(u32, Option<S::Motion>)>,
    /// Slot, how far its body has moved, and how far in this frame; only of bodies that did not change otherwise.
    /// Ascending.
    pub(super) odometers: Vec<(u32, f64, f64)>,
    pub(super) max_pairs: u64,
    pub(super) candidates: Vec<CandidateForm<S>>,
    pub(super) contacts: Vec<ContactForm<S>>,
    /// Each contact's manifolds as a contact hook left them, if there was one.
    pub(super) edited: Option<Vec<Vec<S::Manifold>>>,
    pub(super) events: Vec<Event<S::Key>>,
    pub(super) impacts: Vec<Hit<S::Key, S::Impact>>,
    pub(super) counts: Counts,
}

/// A slot: its body and the version of its key; or, if it is empty, the version of the next key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Slot", bound = "", deny_unknown_fields)]
pub(super) struct SlotForm<S: Saved> {
    pub(super) version: u32,
    pub(super) body: Option<BodyForm<ShapeRef<S::Shape>, S::Pose>>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Candidate", bound = "", deny_unknown_fields)]
pub(super) struct CandidateForm<S: Saved> {
    pub(super) keys: (S::Key, S::Key),
    pub(super) hint: Hint,
    /// The persistent manifold.
    pub(super) persistent: Option<S::Persistent>,
    /// For bodies that are apart, the sum of their paths up to which they stay so.
    pub(super) until: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Contact", bound = "", deny_unknown_fields)]
pub(super) struct ContactForm<S: Saved> {
    pub(super) keys: (S::Key, S::Key),
    pub(super) user_data: (u64, u64),
    pub(super) sensor: bool,
    pub(super) overlapping: bool,
    pub(super) begun: bool,
    pub(super) is_new: bool,
    pub(super) speculative: bool,
    pub(super) manifolds: Vec<S::Manifold>,
}

/// The counts of the last update; its times are not kept.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Counts {
    bodies: u64,
    moved: u64,
    candidates: u64,
    contacts: u64,
    overlapping: u64,
    manifolds: u64,
    overflow: bool,
}

impl<S: Saved> Content<S> {
    pub(super) fn of(world: &World<S>) -> Self {
        let World {
            bodies,
            keys,
            boxes: _,
            tags: _,
            dirty,
            is_dirty: _,
            moved,
            is_moved: _,
            reshaped,
            max_pairs,
            candidates,
            records,
            answered,
            persistent,
            odometers,
            edited,
            events,
            by_second: _,
            stats,
            motions,
            questions: _,
            impacts,
            scratch: _,
        } = world;
        let mut shapes = Collected::new();
        let mut slots: Vec<SlotForm<S>> =
            vec![SlotForm { version: 1, body: None }; keys.len().saturating_sub(1)];
        for (key, body) in bodies {
            if let Some(slot) = slots.get_mut((slot_of(key) as usize).wrapping_sub(1)) {
                let body = BodyForm::of(body, |shape| shapes.name(shape));
                *slot = SlotForm { version: version_of(key), body: Some(body) };
            }
        }
        let to_come = keys_to_come(bodies, keys.len());
        for &key in &to_come {
            if let Some(slot) = slots.get_mut((slot_of(key) as usize).wrapping_sub(1)) {
                slot.version = version_of(key);
            }
        }
        let list = |index: usize| edited.as_ref().map_or(Vec::new(), |edited| edited.of(index).to_vec());
        Self {
            format: FORMAT,
            shapes: shapes.table,
            slots,
            free: to_come.into_iter().map(slot_of).collect(),
            dirty: ascending(dirty),
            moved: ascending(moved),
            reshaped: ascending(reshaped),
            motions: motions.list(),
            odometers: (0..).zip(odometers).filter_map(counted).collect(),
            max_pairs: *max_pairs as u64,
            candidates: candidates.all().map(|candidate| CandidateForm::of(candidate, persistent)).collect(),
            contacts: records
                .all()
                .map(|record| ContactForm::of(record, manifolds_at(&record.manifolds, answered)))
                .collect(),
            edited: edited.as_ref().map(|_| records.iter().map(|(number, _)| list(number)).collect()),
            events: events.clone(),
            impacts: impacts.clone(),
            counts: Counts::of(stats),
        }
    }
}

/// Sorted, since no output depends on their order and equal worlds are to have equal snapshots.
fn ascending(slots: &[u32]) -> Vec<u32> {
    let mut slots = slots.to_vec();
    slots.sort_unstable();
    slots.dedup();
    slots
}

fn counted((slot, odometer): (u32, &Odometer)) -> Option<(u32, f64, f64)> {
    odometer.saved().map(|(travel, step)| (slot, travel, step))
}

impl<S: Saved> SlotForm<S> {
    /// The key of the body in this slot, or of the next one.
    pub(super) fn key(&self, slot: usize) -> S::Key {
        key_of(slot, self.version)
    }
}

impl<S: Saved> CandidateForm<S> {
    fn of(candidate: &Candidate<S::Key>, all: &Slab<S::Persistent>) -> Self {
        // The pair is that of the keys' slots, and the place of a persistent manifold does not matter. The candidate's
        // contact is found again, since contacts are saved in the same order.
        let Candidate { pair: _, keys, hint, persistent, contact: _, until } = candidate;
        let persistent = all.get(*persistent).cloned();
        Self { keys: *keys, hint: *hint, persistent, until: Some(*until).filter(|until| until.is_finite()) }
    }
}

impl<S: Saved> ContactForm<S> {
    fn of(record: &Record<S::Key>, found: &[S::Manifold]) -> Self {
        let Record {
            pair: _,
            keys,
            user_data,
            manifolds: _,
            sensor,
            overlapping,
            begun,
            is_new,
            speculative,
        } = record;
        Self {
            keys: *keys,
            user_data: *user_data,
            sensor: *sensor,
            overlapping: *overlapping,
            begun: *begun,
            is_new: *is_new,
            speculative: *speculative,
            manifolds: found.to_vec(),
        }
    }
}

impl Counts {
    fn of(stats: &Stats) -> Self {
        let Stats {
            refit: _,
            sweep: _,
            collide: _,
            merge: _,
            hooks: _,
            impacts: _,
            report: _,
            bodies,
            moved,
            candidates,
            contacts,
            overlapping,
            manifolds,
            overflow,
        } = *stats;
        Self {
            bodies: bodies as u64,
            moved: moved as u64,
            candidates: candidates as u64,
            contacts: contacts as u64,
            overlapping: overlapping as u64,
            manifolds: manifolds as u64,
            overflow,
        }
    }

    pub(super) fn stats(&self) -> Stats {
        let Self { bodies, moved, candidates, contacts, overlapping, manifolds, overflow } = *self;
        Stats {
            bodies: bodies as usize,
            moved: moved as usize,
            candidates: candidates as usize,
            contacts: contacts as usize,
            overlapping: overlapping as usize,
            manifolds: manifolds as usize,
            overflow,
            ..Stats::default()
        }
    }
}
