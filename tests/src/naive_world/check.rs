//! Whether a world reports what the model does.

use super::{NaiveWorld, Record};
use crate::engine::slot_of;
use crate::judged::Judged;
use asunder::{Collider, Contact, Event, World};

/// In metres: how far the oracle's own f64 may be off, some 1e-15 of a few metres over the sine between two edges.
const ROUNDING: f64 = 1e-10;

impl<S: Judged> NaiveWorld<S> {
    /// Asserts that the world, just updated, agrees with the model in every list and look-up.
    pub fn check(&self, world: &World<S>) {
        self.check_lists(world);
        self.check_lookups(world);
        let stats = world.stats();
        assert_eq!(stats.bodies, self.bodies.len());
        assert_eq!(stats.candidates, S::candidates(world).len());
        assert_eq!(stats.contacts, self.records.len());
        assert_eq!(stats.overlapping, self.records.values().filter(|record| record.overlapping).count());
        assert_eq!(stats.manifolds, S::contacts(world).iter().map(|one| one.manifolds.len()).sum::<usize>());
        assert_eq!(stats.overflow, self.is_given_up);
    }

    fn check_lists(&self, world: &World<S>) {
        assert_eq!(S::events(world), self.events, "events");
        assert_eq!(S::candidates(world), self.candidates, "candidates");
        let contacts = S::contacts(world);
        let keys: Vec<_> = contacts.iter().map(|contact| (contact.a, contact.b)).collect();
        let expected: Vec<_> = self.records.values().map(|record| record.keys).collect();
        let other = keys.iter().zip(&expected).position(|(key, expected)| key != expected);
        let other = other.unwrap_or(keys.len().min(expected.len()));
        if keys.len() != expected.len() || other < keys.len() {
            let (told, record) = (contacts.get(other), self.records.values().nth(other));
            let keys = told.map(|contact| (contact.a, contact.b)).into_iter();
            let bodies = keys.chain(record.map(|record| record.keys)).map(|keys| self.bodies_of(keys));
            panic!(
                "contacts in order of their slots: {told:?}, not {record:?}: {:?}",
                bodies.collect::<Vec<_>>()
            );
        }
        for (contact, record) in contacts.iter().zip(self.records.values()) {
            let facts = (contact.sensor, contact.overlapping, contact.is_new, contact.speculative);
            let expected = (record.sensor, record.overlapping, record.is_new, record.speculative);
            assert_eq!(facts, expected, "{contact:?}");
            let wrong = wrong_with(contact, record);
            assert!(wrong.is_none(), "{wrong:?}: {contact:?}, {record:?}: {:?}", self.bodies_of(record.keys));
        }
        let bodies: Vec<_> = self.bodies.values().map(|tenant| tenant.key).collect();
        let found: Vec<_> = S::bodies(world).into_iter().map(|(key, _)| key).collect();
        assert_eq!(found, bodies, "bodies in order of their slots");
        assert_eq!((world.len(), world.is_empty()), (bodies.len(), bodies.is_empty()));
    }

    fn bodies_of(&self, (a, b): (S::Key, S::Key)) -> [Option<&Collider<S>>; 2] {
        [a, b].map(|key| self.bodies.get(&slot_of(key)).map(|tenant| &tenant.body))
    }

    /// After an update that was given up, there may be contacts of removed bodies.
    fn are_fresh(&self, (a, b): (S::Key, S::Key)) -> bool {
        self.is_fresh(a) && self.is_fresh(b)
    }

    fn check_lookups(&self, world: &World<S>) {
        for (slot, tenant) in &self.bodies {
            let (found, body) = (S::get(world, tenant.key).unwrap(), &tenant.body);
            assert_eq!(S::pose_of(found), S::pose_of(body));
            assert!(S::shape_of(found) == S::shape_of(body));
            assert_eq!(found.get_user_data(), body.get_user_data());
            assert_eq!((found.get_layers(), found.get_owner()), (body.get_layers(), body.get_owner()));
            assert_eq!((found.is_fixed(), found.is_bullet()), (body.is_fixed(), body.is_bullet()));
            assert_eq!(found.is_enabled(), !tenant.is_disabled);
            assert_eq!(found.is_asleep(), tenant.is_asleep);
            // In order of the other body's slot: lower slots first, where this body comes second.
            let mut others: Vec<_> = self
                .records
                .iter()
                .filter(|((a, b), record)| (a == slot || b == slot) && self.are_fresh(record.keys))
                .map(|((a, b), record)| (if a == slot { *b } else { *a }, record))
                .collect();
            others.sort_by_key(|(other, _)| *other);
            let of_key = |&(a, b): &(S::Key, S::Key)| a == tenant.key || b == tenant.key;
            let candidates = self.candidates.iter().copied().filter(of_key);
            let candidates: Vec<_> = candidates.filter(|&keys| self.are_fresh(keys)).collect();
            assert_eq!(S::candidates_of(world, tenant.key), candidates, "in order of the other's slot");
            let contacts: Vec<_> = S::contacts_of(world, tenant.key).iter().map(|c| (c.a, c.b)).collect();
            assert_eq!(contacts, others.iter().map(|(_, record)| record.keys).collect::<Vec<_>>());
            let all = S::events(world).iter().copied();
            let events: Vec<_> = all.filter(|event| of_key(&event.bodies())).collect();
            assert_eq!(S::events_of(world, tenant.key), events);
            let other = |event: &Event<S::Key>| event.other(tenant.key).map(slot_of);
            assert!(events.is_sorted_by_key(other), "in order of the other's slot: {events:?}");
            let touching: Vec<u32> = S::touching(world, tenant.key).into_iter().map(slot_of).collect();
            let begun = others.iter().filter(|(_, record)| record.begun).map(|(other, _)| *other);
            assert_eq!(touching, begun.collect::<Vec<_>>());
            for (other_slot, other) in &self.bodies {
                let record = self.records.get(&(*slot.min(other_slot), *slot.max(other_slot)));
                let record = record.filter(|record| self.are_fresh(record.keys));
                let is_touching = S::is_touching(world, tenant.key, other.key);
                assert_eq!(is_touching, record.is_some_and(|record| record.begun));
                let contact = S::contact(world, tenant.key, other.key).map(|contact| (contact.a, contact.b));
                assert_eq!(contact, record.map(|record| record.keys));
            }
        }
    }
}

/// How a contact's manifolds disagree with the oracle: their least separation must be its, within their errors.
fn wrong_with<S: Judged>(
    contact: &Contact<'_, S::Key, S::Manifold>,
    record: &Record<S>,
) -> Option<&'static str> {
    let manifolds = contact.manifolds;
    if record.shown.as_ref().is_some_and(|shown| shown != manifolds) || manifolds.len() > record.most {
        return Some("other manifolds");
    }
    if record.sensor {
        return (!manifolds.is_empty()).then_some("a sensor has no manifolds");
    }
    let truth = record.word.separation;
    // Half-spaces may overlap without bound, and then have no manifold. On ground, depths are along its normals, and
    // are tested elsewhere.
    let is_surface = record.on_ground && record.overlapping;
    if record.word.is_doubtful || truth == f64::NEG_INFINITY || is_surface {
        return None;
    }
    let told: Vec<[f64; 2]> = manifolds.iter().map(S::told).collect();
    let least = told.iter().min_by(|one, other| one[0].total_cmp(&other[0]));
    let &[separation, error] = match least {
        Some(least) => least,
        None => return (record.most > 0).then_some("a contact has points"),
    };
    if told.iter().any(|[separation, error]| separation + error < truth - ROUNDING) {
        return Some("nearer than it is");
    }
    // For one-sided ground the nearest piece may be one that is hidden by its neighbours.
    let is_whole = record.most == usize::MAX && !record.is_one_sided;
    if is_whole && separation - error > truth + ROUNDING {
        return Some("further than it is");
    }
    (is_whole && (separation <= 0.0) != record.overlapping).then_some("the sign says otherwise")
}
