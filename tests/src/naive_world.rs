//! A naive model of a world, from all pairs of bodies and plain lists: no batches, no coherence, no order to maintain,
//! and no narrow phase: which bodies touch is decided by [`judged`](crate::judged).
//!
//! ```text
//! overlap      exactly the oracle's
//! contact      the oracle's separation against the margins; within `BAND` of them either is right, and the world's
//!              answer is taken
//! to come      bodies within the margins at any of some moments of the motions must have a speculative contact;
//!              bodies further apart than the motions can close must not                       (ahead)
//! impacts      each touches at its reported time; what is passed at any moment is reported    (ahead)
//! manifolds    their least separation is the oracle's within their error                      (check)
//!              or, in worlds without tiny moves, they are the narrow phase's in every bit     (bits)
//! ```

mod ahead;
mod bits;
mod check;

use crate::engine::{Change, Engine, Traits, slot_of};
use crate::judged::{Judged, Question, Stand, Word};
use ahead::Ahead;
use asunder::{Collider, Event, World};
use bits::Bits;
use std::collections::{BTreeMap, BTreeSet};

/// In metres. Reported separations are within 1e-6 of the bodies' size, which is three metres at most.
const BAND: f64 = 3e-6;

/// Margins of two bodies are a metre at most; separations beyond that are not needed.
const NEARBY: Question = Question { within: 1.1, has_sides: true };

/// A body in its slot.
#[derive(Clone, Debug)]
struct Tenant<S: Judged> {
    key: S::Key,
    body: Collider<S>,
    stand: Stand<S>,
    /// Changes whenever the body gets another pose or shape.
    stood: u64,
    is_disabled: bool,
    is_asleep: bool,
    motion: Option<S::Motion>,
}

/// Two slots, the lower one first.
type Slots = (u32, u32);

/// The model of a world.
#[derive(Clone, Debug)]
pub struct NaiveWorld<S: Judged> {
    bodies: BTreeMap<u32, Tenant<S>>,
    /// The oracle's answers for pairs, with the `stood` numbers that they hold for.
    words: BTreeMap<Slots, ([u64; 2], Word)>,
    /// Contacts of the last update, by the slots of their bodies.
    records: BTreeMap<Slots, Record<S>>,
    events: Vec<Event<S::Key>>,
    /// Pairs that may meet and whose boxes overlap, as of the last update.
    candidates: Vec<(S::Key, S::Key)>,
    /// Bodies whose shape changed since the last update.
    reshaped: BTreeSet<u32>,
    /// The number of poses and shapes so far.
    stands: u64,
    bits: Option<Bits<S>>,
    /// Whether the last update had too many pairs, and was given up.
    is_given_up: bool,
    /// Counts of what was judged so far.
    pub tally: Tally,
}

/// Counts of what was judged.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// Pairs that may meet.
    pub pairs: usize,
    /// Pairs for which the world's answer was taken, since either is right.
    pub unsure: usize,
    /// Contacts with ground.
    pub on_ground: usize,
    /// Contacts that a motion may bring.
    pub to_come: usize,
    /// Impacts of bullets.
    pub impacts: usize,
    /// Events.
    pub events: usize,
    /// Updates with too many pairs.
    pub given_up: usize,
}

#[derive(Clone, Debug)]
struct Record<S: Judged> {
    keys: (S::Key, S::Key),
    user_data: (u64, u64),
    sensor: bool,
    overlapping: bool,
    speculative: bool,
    begun: bool,
    is_new: bool,
    /// The oracle's answer.
    word: Word,
    on_ground: bool,
    /// Whether the ground is one-sided.
    is_one_sided: bool,
    /// How many manifolds a hook kept.
    most: usize,
    /// The manifolds, where every bit is known.
    shown: Option<Vec<S::Manifold>>,
}

impl<S: Judged> Default for NaiveWorld<S> {
    fn default() -> Self {
        Self {
            bodies: BTreeMap::new(),
            words: BTreeMap::new(),
            records: BTreeMap::new(),
            events: Vec::new(),
            candidates: Vec::new(),
            reshaped: BTreeSet::new(),
            stands: 0,
            bits: None,
            is_given_up: false,
            tally: Tally::default(),
        }
    }
}

impl<S: Judged> NaiveWorld<S> {
    /// A model that knows every bit of the manifolds. Only without motions, ground and tiny moves, since manifolds that
    /// are moved along keep their points.
    pub fn to_the_bit() -> Self {
        Self { bits: Some(Bits::default()), ..Self::default() }
    }

    /// Inserts a body under the key that the world gave it.
    pub fn insert(&mut self, key: S::Key, body: Collider<S>) {
        assert!(body.is_enabled() && !body.is_asleep(), "the model notes that itself");
        self.stands += 1;
        let tenant = Tenant {
            key,
            stand: stand_of(&body),
            body,
            stood: self.stands,
            is_disabled: false,
            is_asleep: false,
            motion: None,
        };
        assert!(self.bodies.insert(slot_of(key), tenant).is_none(), "a slot with two tenants");
    }

    /// Removes a body; returns whether it existed.
    pub fn remove(&mut self, key: S::Key) -> bool {
        self.is_fresh(key) && self.bodies.remove(&slot_of(key)).is_some()
    }

    /// Sets a pose; returns whether the body exists.
    pub fn set_pose(&mut self, key: S::Key, pose: S::Pose) -> bool {
        let Some(tenant) = tenant_of(&mut self.bodies, key) else { return false };
        // Setting an equal pose is no move. No pose here contains -0.0.
        if S::pose_of(&tenant.body) != pose {
            self.stands += 1;
            tenant.body = S::moved(tenant.body.clone(), pose);
            (tenant.stand, tenant.stood, tenant.is_asleep) = (tenant.stand.at(&pose), self.stands, false);
        }
        true
    }

    /// Sets a motion; returns whether the body exists.
    pub fn set_motion(&mut self, key: S::Key, motion: S::Motion) -> bool {
        let Some(tenant) = tenant_of(&mut self.bodies, key) else { return false };
        (tenant.motion, tenant.is_asleep) = (Some(motion), false);
        true
    }

    /// Makes a change; returns whether the body exists.
    pub fn change(&mut self, key: S::Key, change: &Change<S>) -> bool {
        let slot = slot_of(key);
        let Some(tenant) = tenant_of(&mut self.bodies, key) else { return false };
        let body = &mut tenant.body;
        match change {
            Change::Shape(shape) => {
                if S::shape_of(body) != shape {
                    self.reshaped.insert(slot);
                }
                *body = S::shaped(body, shape.clone());
            }
            Change::Layers(layers) => *body = body.clone().layers(*layers),
            Change::UserData(number) => *body = body.clone().user_data(*number),
            Change::Enable => tenant.is_disabled = false,
            Change::Disable => tenant.is_disabled = true,
            Change::Sleep => tenant.is_asleep = true,
            Change::Wake => tenant.is_asleep = false,
            Change::Sensor(sensor) => {
                *body = S::with_traits(body, Traits { sensor: *sensor, ..Traits::of(body) });
            }
            Change::Fixed(fixed) => {
                *body = S::with_traits(body, Traits { fixed: *fixed, ..Traits::of(body) })
            }
            Change::Owner(owner) => {
                *body = S::with_traits(body, Traits { owner: *owner, ..Traits::of(body) })
            }
            Change::Bullet(bullet) => {
                *body = S::with_traits(body, Traits { bullet: *bullet, ..Traits::of(body) });
            }
            Change::ImpactsOnly(impacts_only) => {
                *body = S::with_traits(body, Traits { impacts_only: *impacts_only, ..Traits::of(body) });
            }
            Change::Margin(margin) => {
                let with = body.clone().margin(*margin);
                *body = with.expect("a body had it");
            }
            Change::Replace(other) => {
                if S::shape_of(body) != S::shape_of(other) {
                    self.reshaped.insert(slot);
                }
                *body = other.clone();
                (tenant.is_disabled, tenant.is_asleep, tenant.motion) = (false, false, None);
            }
        }
        if matches!(change, Change::Shape(_) | Change::Replace(_)) {
            self.stands += 1;
            (tenant.stand, tenant.stood) = (stand_of(&tenant.body), self.stands);
        }
        true
    }

    /// Whether the key's body exists.
    pub fn is_fresh(&self, key: S::Key) -> bool {
        self.bodies.get(&slot_of(key)).is_some_and(|tenant| tenant.key == key)
    }

    /// Removes every body.
    pub fn clear(&mut self) {
        self.bodies.clear();
    }

    /// Finds contacts from all pairs, and events as the difference of two sets. `world` has just been updated; its
    /// answer is taken where both are right.
    pub fn update(&mut self, world: &World<S>) {
        self.update_with(world, |_, _| true, |_, _| usize::MAX);
    }

    /// The same with a limit on the number of pairs: beyond it there are no results, and the previous contacts stay.
    pub fn update_within(&mut self, world: &World<S>, most: usize) {
        let (mut sure, mut unsure) = (0, 0);
        let ahead = Ahead::of(&self.bodies);
        for slots in self.pairs_that_may_meet() {
            match ahead.boxes_overlap(slots, [slots.0, slots.1].map(|slot| &self.bodies[&slot])) {
                Some(overlap) => sure += usize::from(overlap),
                None => unsure += 1,
            }
        }
        let is_given_up = world.stats().overflow;
        assert!(if is_given_up { sure + unsure > most } else { sure <= most }, "{sure} of {most} pairs");
        if !is_given_up {
            self.update(world);
            return;
        }
        assert!(S::impacts(world).is_empty(), "impacts of an update that was given up");
        self.is_given_up = true;
        self.tally.given_up += 1;
        self.events.clear();
        self.records.values_mut().for_each(|record| record.is_new = false);
        self.bodies.values_mut().for_each(|tenant| tenant.motion = None);
    }

    /// The same for the pairs that `admit` accepts; `keep` limits the number of their manifolds.
    pub fn update_with(
        &mut self,
        world: &World<S>,
        admit: impl Fn(&Collider<S>, &Collider<S>) -> bool,
        keep: impl Fn(&Collider<S>, &Collider<S>) -> usize,
    ) {
        self.is_given_up = false;
        let (mut records, mut candidates) = (BTreeMap::new(), Vec::new());
        let told: BTreeSet<Slots> =
            S::candidates(world).iter().map(|(a, b)| (slot_of(*a), slot_of(*b))).collect();
        let mut ahead = Ahead::of(&self.bodies);
        let mut known = self.bits.take();
        for slots in self.pairs_that_may_meet() {
            let [a, b] = [slots.0, slots.1].map(|slot| &self.bodies[&slot]);
            if !admit(&a.body, &b.body) {
                continue;
            }
            let word = word_on(&mut self.words, slots, [a, b]);
            if ahead.boxes_overlap(slots, [a, b]).unwrap_or_else(|| told.contains(&slots)) {
                candidates.push((a.key, b.key));
            }
            ahead.look(slots, [a, b], word);
            self.tally.pairs += 1;
            let is_reshaped = self.reshaped.contains(&slots.0) || self.reshaped.contains(&slots.1);
            let bits = known.as_mut().map(|known| known.ask(slots, [a, b], is_reshaped));
            let Some(mut record) = met(world, [a, b], word, &mut self.tally.unsure)
                .or_else(|| ahead.to_come(world, slots, [a, b], word))
            else {
                assert!(bits.is_none_or(|met| met.is_none()), "the narrow phase alone says otherwise");
                continue;
            };
            record.most = keep(&a.body, &b.body);
            record.shown = bits.map(|met| {
                let (overlapping, manifolds) = met.expect("the narrow phase alone says otherwise");
                assert_eq!(overlapping, record.overlapping);
                let most = if record.sensor { 0 } else { record.most };
                manifolds.into_iter().take(most).collect()
            });
            let before = self.records.get(&slots).filter(|before| before.keys == record.keys);
            // With a margin, a contact outlives the touch; a speculative one does not.
            let had_begun = before.is_some_and(|before| before.begun) && !record.speculative;
            record.begun = had_begun || record.overlapping;
            record.is_new = record.overlapping && !had_begun;
            records.insert(slots, record);
        }
        self.tally.impacts += ahead.check_impacts(world, &self.bodies);
        self.note_events(&records);
        (self.records, self.candidates) = (records, candidates);
        self.bits = known.map(Bits::turned_over);
        self.reshaped.clear();
        self.words.retain(|(a, b), _| self.bodies.contains_key(a) && self.bodies.contains_key(b));
        self.bodies.values_mut().for_each(|tenant| tenant.motion = None);
        self.tally.on_ground += self.records.values().filter(|record| record.on_ground).count();
        self.tally.to_come += self.records.values().filter(|record| record.speculative).count();
        self.tally.events += self.events.len();
    }

    fn note_events(&mut self, records: &BTreeMap<Slots, Record<S>>) {
        self.events.clear();
        let slots: BTreeSet<Slots> = self.records.keys().chain(records.keys()).copied().collect();
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
    }

    /// In order of their slots.
    fn pairs_that_may_meet(&self) -> Vec<Slots> {
        let enabled = || self.bodies.iter().filter(|(_, tenant)| !tenant.is_disabled);
        let later = |slot: u32| enabled().filter(move |(other, _)| **other > slot);
        let pairs =
            enabled().flat_map(|(&slot, a)| later(slot).map(move |(&other, b)| ((slot, other), a, b)));
        pairs.filter(|(_, a, b)| may_meet(&a.body, &b.body)).map(|(slots, ..)| slots).collect()
    }
}

fn stand_of<S: Judged>(body: &Collider<S>) -> Stand<S> {
    Stand::new(S::shape_of(body), &S::pose_of(body))
}

fn tenant_of<S: Judged>(bodies: &mut BTreeMap<u32, Tenant<S>>, key: S::Key) -> Option<&mut Tenant<S>> {
    bodies.get_mut(&slot_of(key)).filter(|tenant| tenant.key == key)
}

/// The oracle's answer for two bodies at their poses, recomputed when either has changed.
fn word_on<S: Judged>(
    words: &mut BTreeMap<Slots, ([u64; 2], Word)>,
    slots: Slots,
    [a, b]: [&Tenant<S>; 2],
) -> Word {
    let stood = [a.stood, b.stood];
    let word = words.get(&slots).filter(|(then, _)| *then == stood).map(|(_, word)| *word);
    let word = word.unwrap_or_else(|| a.stand.meet(&b.stand, NEARBY));
    words.insert(slots, (stood, word));
    word
}

/// The sum of two margins, rounded as in the world.
fn margin_of<S: Judged>([a, b]: [&Tenant<S>; 2]) -> f64 {
    f64::from(a.body.get_margin() + b.body.get_margin())
}

/// The contact of two bodies within their margins.
fn met<S: Judged>(
    world: &World<S>,
    [a, b]: [&Tenant<S>; 2],
    word: Word,
    unsure: &mut usize,
) -> Option<Record<S>> {
    let margin = margin_of([a, b]);
    let told = S::contact(world, a.key, b.key).filter(|told| !told.speculative);
    let mut overlapping = word.overlapping;
    // Without a margin everything is exact.
    let is_close = margin > 0.0 && (word.separation - margin).abs() <= BAND;
    // A one-sided surface collides with what is in front of it and over it. Beside a concave edge a body may be in
    // front of one piece and behind the other: with a contact or without, until they overlap.
    let is_beside = word.separation <= margin && (a.stand.is_one_sided() || b.stand.is_one_sided());
    let is_near = if word.is_doubtful && word.separation <= margin + BAND || is_close && !overlapping {
        *unsure += 1;
        overlapping = if word.is_doubtful { told.is_some_and(|told| told.overlapping) } else { overlapping };
        told.is_some()
    } else if is_beside && !overlapping {
        told.is_some() && margin > 0.0
    } else {
        overlapping || margin > 0.0 && word.separation <= margin
    };
    is_near.then(|| Record { overlapping, ..record_of([a, b], word) })
}

fn record_of<S: Judged>([a, b]: [&Tenant<S>; 2], word: Word) -> Record<S> {
    Record {
        keys: (a.key, b.key),
        user_data: (a.body.get_user_data(), b.body.get_user_data()),
        sensor: a.body.is_sensor() || b.body.is_sensor(),
        overlapping: false,
        speculative: false,
        begun: false,
        is_new: false,
        word,
        on_ground: S::is_ground(S::shape_of(&a.body)) || S::is_ground(S::shape_of(&b.body)),
        is_one_sided: a.stand.is_one_sided() || b.stand.is_one_sided(),
        most: usize::MAX,
        shown: None,
    }
}

/// Whether two bodies may meet: not two fixed ones, not two of one owner, and only if the layers of both agree.
fn may_meet<S: Engine>(a: &Collider<S>, b: &Collider<S>) -> bool {
    let both_fixed = a.is_fixed() && b.is_fixed();
    let one_owner = a.get_owner().is_some() && a.get_owner() == b.get_owner();
    let wants = |one: &Collider<S>, other: &Collider<S>| {
        one.get_layers().collides_with & other.get_layers().member_of != 0
    };
    !both_fixed && !one_owner && wants(a, b) && wants(b, a)
}
