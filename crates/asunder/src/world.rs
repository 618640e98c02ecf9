//! The world: bodies, and the results of the last update.

use crate::collider::{Collider, Tag};
use crate::contact::{Contact, Record};
use crate::event::Event;
use crate::frame::{Settled, TimedHit, Touches, manifolds_at};
use crate::hooks::Edited;
use crate::motion::{Hit, Motions};
use crate::odometer::Odometer;
use crate::query::Boxes;
use crate::records::{Candidates, Records};
use crate::slab::Slab;
use crate::space::Space;
use crate::stats::Stats;
use asunder_broad::{LooseSweep, PairId};
use asunder_narrow::Batch;
use core::fmt;
use slotmap::{Key, SlotMap};

/// A key whose body is gone.
///
/// A key is meaningful only in the world that issued it. Another world of the same dimension cannot distinguish it from
/// one of its own keys, and may have a body under that key: keep keys with their worlds.
///
/// ```
/// use asunder::{Collider3, Cuboid, Pose3, StaleKey, World3, glam::Vec3};
/// let mut world = World3::new();
/// let body = world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?));
/// world.remove(body);
/// assert_eq!(world.set_pose(body, Pose3::IDENTITY), Err(StaleKey));
/// # Ok::<(), asunder::ExtentError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StaleKey;

impl fmt::Display for StaleKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the key names no body of this world: its body was removed")
    }
}

impl core::error::Error for StaleKey {}

/// A world of bodies, in the plane or in space; use it as [`World2`](crate::World2) or [`World3`](crate::World3).
///
/// Equal operations give bit-equal outputs, at any thread count; a clone has an equal future. The world itself has no
/// serde traits: to store it, take a snapshot.
///
/// # Memory
/// Apart from the shapes' own data, a world takes, in the scenes that are measured, at most:
/// - per body, 450 bytes in space and 400 in the plane. Where all bodies move, up to 570 in space, and 800 if they are
///   bullets with motions and are queried as well (131,073 bodies, 2026-11-30);
/// - per candidate pair, 1,600 bytes in space and 1,300 in the plane;
/// - 1,300 bytes for each manifold beyond the first of a pair, as on ground and with compounds.
///
/// The greatest number of bodies, pairs and manifolds so far counts, since a world never shrinks its memory. A clone
/// takes only what it needs, apart from empty body slots.
///
/// In a steady scene an update allocates nothing if it is called inside a thread pool (`rayon::ThreadPool::install`) or
/// if the feature `parallel` is off; from outside, rayon allocates a block for its queue now and then. Overwriting a
/// world by `clone_from` in such a scene allocates nothing either.
pub struct World<S: Space> {
    pub(crate) bodies: SlotMap<S::Key, Collider<S>>,
    /// Key of the body in each slot; null where the slot is empty.
    pub(crate) keys: Vec<S::Key>,
    /// Box of the body in each slot; where the slot is empty, one that overlaps nothing.
    pub(crate) boxes: Vec<S::Aabb>,
    /// What the filter needs of the body in each slot.
    pub(crate) tags: Vec<Tag>,
    /// Slots whose box is out of date, in the order in which they became so, and the same as a flag a slot.
    pub(crate) dirty: Vec<u32>,
    pub(crate) is_dirty: Vec<bool>,
    /// Slots whose body moved, came or went since candidates were last collided, and the same as a flag a slot.
    pub(crate) moved: Vec<u32>,
    pub(crate) is_moved: Vec<bool>,
    /// Slots whose body has got another shape since then: results for the old one are void.
    pub(crate) reshaped: Vec<u32>,
    /// How far the body in each slot has moved.
    pub(crate) odometers: Vec<Odometer>,
    /// Motions of bodies until the next update.
    pub(crate) motions: Motions<S>,
    pub(crate) max_pairs: usize,
    /// The trees that answer queries; no output depends on them.
    pub(crate) questions: Boxes<S>,

    pub(crate) candidates: Candidates<S::Key>,
    pub(crate) records: Records<S::Key>,
    /// The narrow phase's answers, chunk by chunk, with all manifolds.
    pub(crate) answered: Vec<Batch<S::Manifold>>,
    /// Manifolds that can be moved along while their bodies hardly drift, as they were made: at most one a candidate,
    /// each in a fixed place.
    pub(crate) persistent: Slab<S::Persistent>,
    /// The manifolds as a contact hook left them at the last update; `None` without one.
    pub(crate) edited: Option<Edited<S>>,
    pub(crate) events: Vec<Event<S::Key>>,
    pub(crate) impacts: Vec<Hit<S::Key, S::Impact>>,
    /// Numbers of records, sorted by second body, then first. Together with the records, which are sorted by first
    /// body, they give every body's contacts.
    pub(crate) by_second: Vec<u32>,
    pub(crate) stats: Stats,
    pub(crate) scratch: Scratch<S>,
}

/// Working memory of a frame; no output depends on it.
pub(crate) struct Scratch<S: Space> {
    pub(crate) sweep: LooseSweep<S::Aabb>,
    pub(crate) pairs: Vec<PairId>,
    /// Memory of persistent manifolds that are no longer kept.
    pub(crate) spare: S::Spare,
    /// Whether `settled` still belongs to this world's chunks.
    pub(crate) is_settled: bool,
    /// Where each chunk's part of the pairs ends.
    pub(crate) chunk_ends: Vec<usize>,
    /// The chunks' results.
    pub(crate) settled: Vec<Settled<S>>,
    pub(crate) last_candidates: Candidates<S::Key>,
    pub(crate) last_records: Records<S::Key>,
    pub(crate) last_answered: Vec<Batch<S::Manifold>>,
    pub(crate) ended: Vec<Record<S::Key>>,
    /// The manifolds that a contact hook is editing.
    pub(crate) editing: Vec<S::Manifold>,
    /// Pairs with a bullet, the bullet first.
    pub(crate) of_bullets: Vec<(S::Key, S::Key)>,
    /// What bullets touch, by their slots.
    pub(crate) touches: Touches<S>,
    pub(crate) timed_hits: Vec<TimedHit<S>>,
    #[cfg(feature = "parallel")]
    pub(crate) impacts: Vec<Option<TimedHit<S>>>,
    /// For the index by second body: where each slot's records end; or second bodies with record numbers, to be sorted.
    pub(crate) ends: Vec<u32>,
    pub(crate) seconds: Vec<(u32, u32)>,
}

impl<S: Space> Scratch<S> {
    fn new() -> Self {
        Self {
            sweep: LooseSweep::new(),
            pairs: Vec::new(),
            spare: S::Spare::default(),
            is_settled: false,
            chunk_ends: Vec::new(),
            settled: Vec::new(),
            last_candidates: Candidates::new(),
            last_records: Records::new(),
            last_answered: Vec::new(),
            ended: Vec::new(),
            editing: Vec::new(),
            of_bullets: Vec::new(),
            touches: Touches::NONE,
            timed_hits: Vec::new(),
            #[cfg(feature = "parallel")]
            impacts: Vec::new(),
            ends: Vec::new(),
            seconds: Vec::new(),
        }
    }
}

impl<S: Space> Clone for World<S> {
    /// A world with an equal future.
    fn clone(&self) -> Self {
        let mut copy = Self::new();
        copy.clone_from(self);
        copy
    }

    /// Makes this world equal to another, reusing the memory that it already has. For rollback: a game that keeps its
    /// last frames overwrites the oldest of its kept worlds in every frame.
    ///
    /// ```
    /// use asunder::{Collider3, Sphere, World3};
    /// let (mut world, mut kept) = (World3::new(), World3::new());
    /// for _ in 0..60 {
    ///     world.insert(Collider3::new(Sphere::new(1.0)?));
    ///     world.update();
    ///     kept.clone_from(&world);
    /// }
    /// world.clear();
    /// world.clone_from(&kept);
    /// assert_eq!((world.len(), world.contacts().len()), (60, 60 * 59 / 2));
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    fn clone_from(&mut self, source: &Self) {
        S::copy(source, self);
    }
}

impl<S: Space> Default for World<S> {
    fn default() -> Self {
        Self::new()
    }
}

impl<S: Space> fmt::Debug for World<S> {
    /// Prints the number of bodies, candidates, contacts, events and impacts; bodies and contacts have their own
    /// `Debug`.
    ///
    /// ```
    /// use asunder::{Collider3, Sphere, World3};
    /// let mut world = World3::new();
    /// for _ in 0..100 {
    ///     world.insert(Collider3::new(Sphere::new(1.0)?));
    /// }
    /// world.update();
    /// let shown = format!("{world:?}");
    /// assert_eq!(shown, "World { bodies: 100, candidates: 4950, contacts: 4950, events: 4950, impacts: 0, .. }");
    /// # Ok::<(), asunder::RadiusError>(())
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("World")
            .field("bodies", &self.len())
            .field("candidates", &self.candidates.len())
            .field("contacts", &self.show_contacts().len())
            .field("events", &self.events.len())
            .field("impacts", &self.impacts.len())
            .finish_non_exhaustive()
    }
}

impl<S: Space> World<S> {
    /// An empty world.
    pub fn new() -> Self {
        Self {
            bodies: SlotMap::with_key(),
            keys: Vec::new(),
            boxes: Vec::new(),
            tags: Vec::new(),
            dirty: Vec::new(),
            is_dirty: Vec::new(),
            moved: Vec::new(),
            is_moved: Vec::new(),
            reshaped: Vec::new(),
            odometers: Vec::new(),
            motions: Motions::NONE,
            max_pairs: 1 << 24,
            questions: Boxes::default(),
            candidates: Candidates::new(),
            records: Records::new(),
            answered: Vec::new(),
            persistent: Slab::new(),
            edited: None,
            events: Vec::new(),
            impacts: Vec::new(),
            by_second: Vec::new(),
            stats: Stats::default(),
            scratch: Scratch::new(),
        }
    }

    /// Number of bodies.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether there is no body.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// Sets how many candidate pairs an update may make, counted before hooks reject any. See [`Stats::overflow`].
    ///
    /// The default is 2^24: at about 1,600 bytes each that is 27 GB, so set a smaller limit to bound memory.
    ///
    /// Pairs that layers, owners and so on reject do not count, but they are still found and cost time: see
    /// [`Layers`](crate::Layers).
    ///
    /// ```
    /// use asunder::{Collider2, Rect, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// world.set_max_pairs(0);
    /// for _ in 0..2 {
    ///     world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// }
    /// world.update();
    /// assert!(world.stats().overflow && world.events().is_empty());
    /// assert_eq!(world.len(), 2);
    /// world.clear();
    /// assert!(world.is_empty());
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn set_max_pairs(&mut self, max_pairs: usize) {
        self.max_pairs = max_pairs;
    }

    /// Times and counts of the last update.
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    pub(crate) fn show_contacts(
        &self,
    ) -> impl ExactSizeIterator<Item = Contact<'_, S::Key, S::Manifold>> + Clone {
        self.records.iter().map(|(number, record)| self.show_record(number, record))
    }

    /// The contact of a record by its number, with its manifolds as the contact hook left them.
    pub(crate) fn show(&self, number: usize) -> Contact<'_, S::Key, S::Manifold> {
        self.show_record(number, self.records.get(number))
    }

    // Inlined, since a game reads all of them each frame.
    #[inline]
    fn show_record<'a>(&'a self, number: usize, record: &Record<S::Key>) -> Contact<'a, S::Key, S::Manifold> {
        let Record { keys: (a, b), user_data, sensor, overlapping, is_new, speculative, .. } = *record;
        let manifolds = match &self.edited {
            Some(edited) => edited.of(number),
            None => manifolds_at(&record.manifolds, &self.answered),
        };
        Contact { a, b, user_data, sensor, overlapping, is_new, speculative, manifolds }
    }

    /// The number of the record of two bodies.
    pub(crate) fn record_of(&self, one: S::Key, other: S::Key) -> Option<usize> {
        if !self.bodies.contains_key(one) || !self.bodies.contains_key(other) {
            return None;
        }
        let pair = PairId::new(slot_of(one), slot_of(other));
        let (number, record) = self.records.from(pair).next().filter(|(_, record)| record.pair == pair)?;
        // The slot may have had another body when the record was made.
        (record.keys == (one, other) || record.keys == (other, one)).then_some(number)
    }

    /// Whether the contact of two bodies has begun.
    pub(crate) fn has_begun(&self, one: S::Key, other: S::Key) -> bool {
        self.record_of(one, other).is_some_and(|number| self.records.get(number).begun)
    }

    /// Records of one body, by their numbers, in order of the other body's slot.
    pub(crate) fn records_of(&self, key: S::Key) -> impl Iterator<Item = usize> + Clone {
        // A stale key gets an empty range. The records of a reused slot are filtered out below.
        let slot = if self.bodies.contains_key(key) { slot_of(key) } else { u32::MAX };
        let second = |&number: &u32| self.records.get(number as usize).pair.b;
        let start = self.by_second.partition_point(|number| second(number) < slot);
        let as_second = self.by_second[start..].iter().take_while(move |number| second(number) == slot);
        let as_first = self.records.from(PairId { a: slot, b: 0 });
        let as_first =
            as_first.take_while(move |(_, record)| record.pair.a == slot).map(|(number, _)| number);
        as_second.map(|&number| number as usize).chain(as_first).filter(move |&number| {
            let (a, b) = self.records.get(number).keys;
            // The other body may have been removed since.
            (a == key || b == key) && self.bodies.contains_key(a) && self.bodies.contains_key(b)
        })
    }

    /// Candidates of one body, in order of the other body's slot.
    pub(crate) fn pairs_of(&self, key: S::Key) -> impl Iterator<Item = (S::Key, S::Key)> + Clone {
        let (slot, is_there) = (slot_of(key), self.bodies.contains_key(key));
        let all =
            self.candidates.iter().take_while(move |(_, candidate)| is_there && candidate.pair.a < slot);
        let as_second = all.filter(move |(_, candidate)| candidate.pair.b == slot);
        let as_first = self.candidates.from(PairId { a: slot, b: 0 });
        let as_first = as_first.take_while(move |(_, candidate)| is_there && candidate.pair.a == slot);
        as_second.chain(as_first).map(|(_, candidate)| candidate.keys).filter(move |&(a, b)| {
            // Another body may have been removed since, and so may the one that had this slot then.
            self.bodies.contains_key(a) && self.bodies.contains_key(b)
        })
    }

    /// The bodies that touch this one.
    pub(crate) fn touched_by(&self, key: S::Key) -> impl Iterator<Item = S::Key> + Clone {
        let begun = self.records_of(key).map(|number| self.records.get(number)).filter(|record| record.begun);
        begun.map(move |record| if record.keys.0 == key { record.keys.1 } else { record.keys.0 })
    }
}

/// The slot of a key: small, stable while the body lives, and reused after it is removed.
///
/// slotmap keeps the slot in the low half of a key's bits and the version in the high half. It promises only that the
/// bits lead back to the key; a test below holds it to the rest.
pub(crate) fn slot_of<K: Key>(key: K) -> u32 {
    key.data().as_ffi() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::BodyKey3;

    #[test]
    fn slots_are_small_stable_and_reused() {
        let mut map: SlotMap<BodyKey3, ()> = SlotMap::with_key();
        let keys: Vec<BodyKey3> = (0..10).map(|_| map.insert(())).collect();
        let slots: Vec<u32> = keys.iter().map(|&key| slot_of(key)).collect();
        assert_eq!(slots, (1..=10).collect::<Vec<u32>>());
        map.remove(keys[4]);
        let reused = map.insert(());
        assert_eq!(slot_of(reused), slots[4]);
        assert_ne!(reused, keys[4]);
        assert_ne!(slot_of(BodyKey3::null()), slots[0], "the null key shares no slot with a body");
    }
}
