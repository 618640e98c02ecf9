//! What a world must say, from all pairs of bodies and three plain lists: no boxes, no batches, no order to keep up.

use crate::engine::{Change, Engine, slot_of};
use asunder::{Collider, Event, Space, World};
use asunder_narrow::Hint;
use std::collections::{BTreeMap, BTreeSet};

/// A body in its slot, with the key that the world gave it.
type Tenant<S> = (<S as Space>::Key, Collider<S>);

/// What the last update learnt of two bodies, by their keys.
type Known<S> = ((<S as Space>::Key, <S as Space>::Key), Hint);

/// The model of a world.
#[derive(Clone, Debug)]
pub struct NaiveWorld<S: Engine> {
    /// Bodies by slot.
    bodies: BTreeMap<u32, Tenant<S>>,
    /// Contacts of the last update, by the slots of their bodies.
    records: BTreeMap<(u32, u32), Record<S>>,
    events: Vec<Event<S::Key>>,
    /// Pairs that may meet and whose boxes overlap, as of the last update.
    candidates: Vec<(S::Key, S::Key)>,
    /// Bodies that were disabled since they came, or since they were enabled.
    disabled: BTreeSet<u32>,
    /// Bodies that got another shape since the last update.
    reshaped: BTreeSet<u32>,
    /// What the last update learnt of each pair whose boxes overlap, by the slots of their bodies.
    hints: BTreeMap<(u32, u32), Known<S>>,
}

#[derive(Clone, Debug)]
struct Record<S: Engine> {
    keys: (S::Key, S::Key),
    user_data: (u64, u64),
    sensor: bool,
    overlapping: bool,
    begun: bool,
    is_new: bool,
    /// Manifolds, as they were edited.
    shown: Vec<S::Manifold>,
}

impl<S: Engine> Default for NaiveWorld<S> {
    fn default() -> Self {
        Self {
            bodies: BTreeMap::new(),
            records: BTreeMap::new(),
            events: Vec::new(),
            candidates: Vec::new(),
            disabled: BTreeSet::new(),
            reshaped: BTreeSet::new(),
            hints: BTreeMap::new(),
        }
    }
}

impl<S: Engine> NaiveWorld<S> {
    /// A body that the world gave this key.
    pub fn insert(&mut self, key: S::Key, body: Collider<S>) {
        assert!(body.is_enabled(), "the model notes that itself");
        assert!(self.bodies.insert(slot_of(key), (key, body)).is_none(), "a slot with two tenants");
        self.disabled.remove(&slot_of(key));
    }

    /// Whether the key's body was there.
    pub fn remove(&mut self, key: S::Key) -> bool {
        self.is_fresh(key) && self.bodies.remove(&slot_of(key)).is_some()
    }

    /// Whether the key's body is there.
    pub fn set_pose(&mut self, key: S::Key, pose: S::Pose) -> bool {
        if !self.is_fresh(key) {
            return false;
        }
        let slot = self.bodies.get_mut(&slot_of(key)).unwrap();
        slot.1 = S::moved(slot.1.clone(), pose);
        true
    }

    /// Whether the key's body is there, and so the change was made.
    pub fn change(&mut self, key: S::Key, change: &Change<S>) -> bool {
        if !self.is_fresh(key) {
            return false;
        }
        let slot = slot_of(key);
        let body = &mut self.bodies.get_mut(&slot).unwrap().1;
        match change {
            Change::Shape(shape) => {
                *body = S::shaped(body, shape.clone());
                self.reshaped.insert(slot);
            }
            Change::Layers(layers) => *body = body.clone().layers(*layers),
            Change::UserData(number) => *body = body.clone().user_data(*number),
            Change::Enable => drop(self.disabled.remove(&slot)),
            Change::Disable => drop(self.disabled.insert(slot)),
            Change::Sleep | Change::Wake => (),
            Change::Replace(other) => {
                if S::shape_of(body) != S::shape_of(other) {
                    self.reshaped.insert(slot);
                }
                *body = other.clone();
                self.disabled.remove(&slot);
            }
        }
        true
    }

    /// Whether the key's body is there.
    pub fn is_fresh(&self, key: S::Key) -> bool {
        self.bodies.get(&slot_of(key)).is_some_and(|(tenant, _)| *tenant == key)
    }

    /// Removes every body.
    pub fn clear(&mut self) {
        self.bodies.clear();
    }

    /// Contacts from all pairs, and events from the difference of two sets.
    pub fn update(&mut self) {
        self.update_with(|_, _| true, |_, _, manifolds| manifolds.clone());
    }

    /// The same of the pairs that are admitted, with the manifolds as they are edited.
    pub fn update_with(
        &mut self,
        admit: impl Fn(&Collider<S>, &Collider<S>) -> bool,
        edit: impl Fn(&Collider<S>, &Collider<S>, &Vec<S::Manifold>) -> Vec<S::Manifold>,
    ) {
        let (mut records, mut hints, mut candidates) = (BTreeMap::new(), BTreeMap::new(), Vec::new());
        for [a, b] in self.pairs_that_may_meet() {
            if !admit(&a.1, &b.1) {
                continue;
            }
            let slots = (slot_of(a.0), slot_of(b.0));
            let keys = (a.0, b.0);
            let is_reshaped = self.reshaped.contains(&slots.0) || self.reshaped.contains(&slots.1);
            let known = self.hints.get(&slots).filter(|(known, _)| *known == keys && !is_reshaped);
            let (hint, met) = S::meet(&a.1, &b.1, known.map_or(Hint::NONE, |(_, hint)| *hint));
            if S::boxes_overlap(&a.1, &b.1) {
                candidates.push(keys);
                hints.insert(slots, (keys, hint));
            }
            let Some((overlapping, manifolds)) = met else { continue };
            let sensor = a.1.is_sensor() || b.1.is_sensor();
            let before = self.records.get(&slots).filter(|before| before.keys == keys);
            // With a margin, a contact outlives the touch; not with another shape.
            let had_begun = before.is_some_and(|before| before.begun) && (overlapping || !is_reshaped);
            let manifolds = if sensor { Vec::new() } else { manifolds };
            let record = Record {
                keys,
                user_data: (a.1.get_user_data(), b.1.get_user_data()),
                sensor,
                overlapping,
                begun: had_begun || overlapping,
                is_new: overlapping && !had_begun,
                shown: if manifolds.is_empty() { Vec::new() } else { edit(&a.1, &b.1, &manifolds) },
            };
            records.insert(slots, record);
        }
        self.events.clear();
        let mut slots: Vec<_> = self.records.keys().chain(records.keys()).copied().collect();
        slots.sort_unstable();
        slots.dedup();
        for slots in slots {
            let (before, now) = (self.records.get(&slots), records.get(&slots));
            let stays = |before: &Record<S>| {
                now.is_some_and(|now| now.keys == before.keys && (now.begun || !before.begun))
            };
            if let Some(Record { keys: (a, b), user_data: (user_data_a, user_data_b), sensor, .. }) =
                before.filter(|before| before.begun && !stays(before)).cloned()
            {
                self.events.push(Event::Ended { a, b, user_data_a, user_data_b, sensor });
            }
            if let Some(Record { keys: (a, b), user_data: (user_data_a, user_data_b), sensor, .. }) =
                now.filter(|now| now.is_new).cloned()
            {
                self.events.push(Event::Began { a, b, user_data_a, user_data_b, sensor });
            }
        }
        (self.records, self.hints, self.candidates) = (records, hints, candidates);
        self.reshaped.clear();
    }

    /// Pairs in order of their slots.
    fn pairs_that_may_meet(&self) -> Vec<[&Tenant<S>; 2]> {
        let mut pairs = Vec::new();
        for (&slot, a) in &self.bodies {
            let is_enabled = |slot: &u32| !self.disabled.contains(slot);
            let others = self.bodies.range(slot + 1..).filter(|(other, _)| is_enabled(other));
            let later = others.filter(|_| is_enabled(&slot)).map(|(_, b)| [a, b]);
            pairs.extend(later.filter(|[a, b]| may_meet(&a.1, &b.1)));
        }
        pairs
    }

    /// Fails unless the world, just updated, says in every list and look-up what the model says.
    pub fn check(&self, world: &World<S>) {
        self.check_lists(world);
        self.check_lookups(world);
        let stats = world.stats();
        let records = self.records.values();
        assert_eq!(stats.bodies, self.bodies.len());
        assert_eq!(stats.candidates, S::candidates(world).len());
        assert_eq!(stats.contacts, self.records.len());
        assert_eq!(stats.touching, records.clone().filter(|record| record.overlapping).count());
        assert_eq!(stats.manifolds, records.map(|record| record.shown.len()).sum::<usize>());
        assert!(!stats.overflow);
    }

    fn check_lists(&self, world: &World<S>) {
        assert_eq!(S::events(world), self.events, "events");
        assert_eq!(S::candidates(world), self.candidates, "candidates");
        let contacts = S::contacts(world);
        assert_eq!(contacts.len(), self.records.len(), "contacts");
        for (contact, record) in contacts.iter().zip(self.records.values()) {
            assert_eq!((contact.a, contact.b), record.keys, "contacts in order of their slots");
            let facts = (contact.sensor, contact.overlapping, contact.is_new);
            assert_eq!(facts, (record.sensor, record.overlapping, record.is_new), "{contact:?}");
            assert_eq!(contact.manifolds, record.shown, "{contact:?}");
        }
        let bodies: Vec<_> = self.bodies.values().map(|(key, _)| *key).collect();
        let found: Vec<_> = S::bodies(world).into_iter().map(|(key, _)| key).collect();
        assert_eq!(found, bodies, "bodies in order of their slots");
        assert_eq!((world.len(), world.is_empty()), (bodies.len(), bodies.is_empty()));
    }

    fn check_lookups(&self, world: &World<S>) {
        for (slot, (key, body)) in &self.bodies {
            let found = S::get(world, *key).unwrap();
            assert_eq!(found.get_user_data(), body.get_user_data());
            assert_eq!(found.is_enabled(), !self.disabled.contains(slot));
            let of_key: Vec<_> = self
                .records
                .iter()
                .filter(|((a, b), _)| a == slot || b == slot)
                .map(|((a, b), record)| (if a == slot { *b } else { *a }, record))
                .collect();
            // In order of the other body's slot: lower slots first, which is where this one comes second.
            let mut others = of_key.clone();
            others.sort_by_key(|(other, _)| *other);
            let contacts: Vec<_> = S::contacts_of(world, *key).iter().map(|c| (c.a, c.b)).collect();
            assert_eq!(contacts, others.iter().map(|(_, record)| record.keys).collect::<Vec<_>>());
            let touching: Vec<u32> = S::touching(world, *key).into_iter().map(slot_of).collect();
            let begun = others.iter().filter(|(_, record)| record.begun).map(|(other, _)| *other);
            assert_eq!(touching, begun.collect::<Vec<_>>());
            for (other_slot, (other, _)) in &self.bodies {
                let record = self.records.get(&(*slot.min(other_slot), *slot.max(other_slot)));
                assert_eq!(S::is_touching(world, *key, *other), record.is_some_and(|record| record.begun));
                assert_eq!(S::contact(world, *key, *other).map(|c| (c.a, c.b)), record.map(|r| r.keys));
            }
        }
    }
}

/// Who meets whom: not two fixed bodies, not one owner's, and only where both sides' layers agree.
fn may_meet<S: Engine>(a: &Collider<S>, b: &Collider<S>) -> bool {
    let both_fixed = a.is_fixed() && b.is_fixed();
    let one_owner = a.get_owner().is_some() && a.get_owner() == b.get_owner();
    let wants = |one: &Collider<S>, other: &Collider<S>| {
        one.get_layers().collides_with & other.get_layers().member_of != 0
    };
    !both_fixed && !one_owner && wants(a, b) && wants(b, a)
}
