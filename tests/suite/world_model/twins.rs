//! A world and its model, given the same operations; and the worlds that it was cloned or restored from, given the
//! same, too.

use super::operation::Operation;
use crate::stored::Stored;
use asunder::slotmap::Key;
use asunder::{Collider, Hooks, Meeting, Plane, Side, Volume, World};
use asunder_tests::cases::Random;
use asunder_tests::engine::{Change, Engine};
use asunder_tests::judged::Judged;
use asunder_tests::naive_world::{NaiveWorld, Tally};
use asunder_tests::played::Played;

/// All that a list needs of a dimension.
pub(super) trait Stage: Judged + Played + Stored {}

impl Stage for Plane {}
impl Stage for Volume {}

/// Half of the side of the room, in metres: bodies of a metre meet often in it.
pub(super) const ROOM: f64 = 1.6;

/// No bodies are inserted beyond this number, since all pairs are compared.
const MOST_BODIES: usize = 30;

/// No ground is inserted beyond this number: much of the room is near it.
const MOST_GROUNDS: usize = 2;

/// The number of originals that follow at once. The first one stays to the end; of the others the oldest is dropped.
const MOST_FOLLOWERS: usize = 3;

pub(super) struct Twins<S: Stage> {
    world: World<S>,
    /// Worlds from which this one was cloned or restored: they must report the same.
    originals: Vec<World<S>>,
    /// A world that no longer follows, whose history has diverged.
    left: Option<World<S>>,
    model: NaiveWorld<S>,
    keys: Vec<S::Key>,
    is_to_the_bit: bool,
    pub(super) updates: usize,
    /// How many worlds were cloned or restored.
    pub(super) followers: usize,
}

impl<S: Stage> Twins<S> {
    pub(super) fn new() -> Self {
        Self {
            world: World::new(),
            originals: Vec::new(),
            left: None,
            model: NaiveWorld::default(),
            keys: Vec::new(),
            is_to_the_bit: false,
            updates: 0,
            followers: 0,
        }
    }

    pub(super) fn to_the_bit() -> Self {
        Self { model: NaiveWorld::to_the_bit(), is_to_the_bit: true, ..Self::new() }
    }

    pub(super) fn tally(&self) -> Tally {
        self.model.tally
    }

    /// One of the existing bodies; or, one time in eight, one of all that ever existed.
    fn key(&self, body: usize) -> S::Key {
        let alive = S::bodies(&self.world);
        match (body % 8, alive.len(), self.keys.len()) {
            // Before there is any body, the null key stands for one that never existed.
            (.., 0) => S::Key::null(),
            (0, _, ever) | (_, 0, ever) => self.keys[body / 8 % ever],
            (_, there, _) => alive[body / 8 % there].0,
        }
    }

    /// Does the same to the world and its originals, which must return the same.
    fn tell<A: PartialEq + core::fmt::Debug>(&mut self, act: impl Fn(&mut World<S>) -> A) -> A {
        let answer = act(&mut self.world);
        for original in &mut self.originals {
            assert_eq!(act(original), answer, "the original answers alike");
        }
        answer
    }

    pub(super) fn apply(&mut self, operation: &Operation) {
        match *operation {
            Operation::Insert { seed } => self.insert(vec![self.random_body(&mut Random::new(seed.into()))]),
            Operation::InsertMany { seed } => {
                let random = &mut Random::new(seed.into());
                let bodies = (0..random.below(5)).map(|_| self.random_body(random)).collect();
                self.insert(bodies);
            }
            Operation::Ground { seed } => {
                let grounds =
                    S::bodies(&self.world).iter().filter(|(_, body)| S::is_ground(S::shape_of(body))).count();
                if grounds < MOST_GROUNDS {
                    self.insert(vec![S::random_ground(&mut Random::new(seed.into()), ROOM)]);
                }
            }
            Operation::Remove { body } => {
                let key = self.key(body);
                let was_there = self.model.remove(key);
                let removed = self.tell(|world| S::remove(world, key).is_some());
                assert_eq!(removed, was_there, "a stale key removes nobody");
            }
            Operation::Clear => {
                self.tell(World::clear);
                self.model.clear();
            }
            Operation::Change { body, seed } => {
                let (key, change) = (self.key(body), Change::random(&mut Random::new(seed.into())));
                let was_there = self.model.change(key, &change);
                let changed = self.tell(|world| S::change(world, key, &change));
                assert_eq!(changed, was_there, "a stale key changes nobody");
            }
            Operation::Motion { body, seed } => self.set_motion(body, seed),
            Operation::Clone => {
                let world = match self.left.take() {
                    Some(mut left) => {
                        left.clone_from(&self.world);
                        left
                    }
                    None => self.world.clone(),
                };
                self.go_on_with(world);
            }
            Operation::Restore => {
                let text = S::text(&self.world);
                self.go_on_with(S::restored(&text).unwrap_or_else(|error| panic!("{error}")));
            }
            Operation::Update => {
                self.tell(World::update);
                self.model.update(&self.world);
                self.check();
                if self.is_to_the_bit {
                    check_fresh(&self.world);
                }
            }
            Operation::UpdateWithin { most } => {
                self.tell(|world| world.set_max_pairs(most));
                self.tell(World::update);
                self.tell(|world| world.set_max_pairs(1 << 24));
                self.model.update_within(&self.world, most);
                self.check();
            }
            Operation::UpdateWith { seed } => self.update_with(seed),
            Operation::Move { .. }
            | Operation::MoveMany { .. }
            | Operation::Nudge { .. }
            | Operation::Settle { .. }
            | Operation::Stay { .. } => self.go(operation),
        }
        self.check_keys();
    }

    /// A body of any kind, or a unit body on the grid; every third is a bullet.
    fn random_body(&self, random: &mut Random) -> Collider<S> {
        let body = match random.below(8) {
            0 if !self.is_to_the_bit => S::moved(S::unit_at(0.0), S::on_grid(random, ROOM)),
            _ => S::random_body(random, ROOM),
        };
        if random.below(3) == 0 { body.bullet() } else { body }
    }

    fn insert(&mut self, mut bodies: Vec<Collider<S>>) {
        bodies.truncate(MOST_BODIES.saturating_sub(self.world.len()));
        let keys = match &bodies[..] {
            [body] => vec![self.tell(|world| S::insert(world, body.clone()))],
            _ => self.tell(|world| S::insert_many(world, bodies.clone())),
        };
        assert_eq!(keys.len(), bodies.len());
        for (key, body) in keys.into_iter().zip(bodies) {
            assert!(!self.keys.contains(&key), "a key that an earlier body had");
            self.model.insert(key, body);
            self.keys.push(key);
        }
    }

    /// Moves one body or several.
    fn go(&mut self, operation: &Operation) {
        let (body, seed) = match *operation {
            Operation::Move { body, seed }
            | Operation::Nudge { body, seed }
            | Operation::Settle { body, seed } => (body, seed),
            Operation::Stay { body } => (body, 0),
            Operation::MoveMany { seed } => {
                let random = &mut Random::new(seed.into());
                let mut place = || (self.key(random.below(1 << 20)), S::random_pose(random, ROOM));
                let poses: Vec<_> = (0..4).map(|_| place()).collect();
                // All bodies with fresh keys are moved, even after a stale one.
                let stale = poses.iter().filter(|(key, pose)| !self.model.set_pose(*key, *pose)).count();
                let moved = self.tell(|world| S::set_poses(world, poses.clone()));
                assert_eq!(moved, stale == 0, "a stale key among many is told of, and moves nobody");
                return;
            }
            _ => return,
        };
        let (key, random) = (self.key(body), &mut Random::new(seed.into()));
        let here = S::get(&self.world, key).map(S::pose_of);
        let pose = match (operation, here) {
            (Operation::Stay { .. }, Some(here)) => here,
            (Operation::Nudge { .. }, Some(here)) => {
                let by = random.pick(&[1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1]);
                S::nudged(&here, random, by)
            }
            (Operation::Settle { .. }, _) => S::on_grid(random, ROOM),
            _ => S::random_pose(random, ROOM),
        };
        let was_there = self.model.set_pose(key, pose);
        let moved = self.tell(|world| S::set_pose(world, key, pose));
        assert_eq!(moved, was_there, "a stale key moves nobody");
    }

    fn set_motion(&mut self, body: usize, seed: u64) {
        let (key, motion) = (self.key(body), S::random_motion(&mut Random::new(seed.into()), 2.0 * ROOM));
        let was_there = self.model.set_motion(key, motion);
        let set = self.tell(|world| S::set_motion(world, key, motion));
        assert_eq!(set, was_there, "a stale key goes nowhere");
    }

    /// Updates with hooks that reject a third of the pairs, and remove some manifolds of each contact.
    fn update_with(&mut self, seed: u64) {
        let dice = |a: &Collider<S>, b: &Collider<S>| {
            a.get_user_data().wrapping_mul(31).wrapping_add(b.get_user_data()).wrapping_add(seed) % 3
        };
        let pair = |a: Side<'_, S>, b: Side<'_, S>| dice(a.body, b.body) != 0;
        let contact = |meeting: Meeting<'_, S>| {
            let keep = dice(meeting.a.body, meeting.b.body) - 1;
            meeting.manifolds.truncate(keep as usize);
        };
        self.tell(|world| world.update_with(&Hooks::new().pair(&pair).contact(&contact)));
        self.model.update_with(&self.world, |a, b| dice(a, b) != 0, |a, b| dice(a, b) as usize - 1);
        self.check();
    }

    /// Continues with `world`; the previous one becomes an original.
    fn go_on_with(&mut self, world: World<S>) {
        if self.originals.len() >= MOST_FOLLOWERS {
            self.left = Some(self.originals.remove(1));
        }
        self.originals.push(core::mem::replace(&mut self.world, world));
        self.followers += 1;
        self.check_originals();
    }

    fn check(&mut self) {
        self.updates += 1;
        self.model.check(&self.world);
        self.check_originals();
    }

    /// Asserts that the originals report the same as the world.
    fn check_originals(&self) {
        for original in &self.originals {
            assert_eq!(S::events(original), S::events(&self.world), "events of the original");
            assert!(S::candidates(original) == S::candidates(&self.world), "candidates of the original");
            assert!(S::contacts(original) == S::contacts(&self.world), "contacts of the original");
            assert!(S::impacts(original) == S::impacts(&self.world), "impacts of the original");
            let counts = |world: &World<S>| {
                let stats = world.stats();
                (stats.moved, stats.contacts, stats.overlapping, stats.manifolds)
            };
            assert_eq!(counts(original), counts(&self.world), "counts of the original");
        }
    }

    /// At the end of a list, state that is not visible yet is the same, too, in every bit.
    pub(super) fn finish(&self) {
        let checksum = S::checksum(&self.world);
        assert!(self.originals.iter().all(|original| S::checksum(original) == checksum));
    }

    fn check_keys(&self) {
        for &key in &self.keys {
            let is_fresh = self.model.is_fresh(key);
            let is_there = S::get(&self.world, key).is_some();
            assert_eq!(is_there, is_fresh, "keys of gone bodies are stale for ever");
            if !is_fresh {
                let is_forgotten = S::contacts_of(&self.world, key).is_empty();
                assert!(is_forgotten && S::touching(&self.world, key).is_empty());
                assert!(S::candidates_of(&self.world, key).is_empty());
            }
        }
    }
}

/// A fresh world with the same bodies in the same order has the same contacts, bit for bit: history affects only which
/// contacts are new.
fn check_fresh<S: Engine>(world: &World<S>) {
    let bodies = S::bodies(world);
    let mut fresh = World::new();
    let keys: Vec<_> = bodies.iter().map(|(_, body)| S::insert(&mut fresh, body.clone())).collect();
    fresh.update();
    let rank = |key: S::Key| bodies.iter().position(|(known, _)| *known == key).unwrap();
    let (contacts, others) = (S::contacts(world), S::contacts(&fresh));
    assert_eq!(contacts.len(), others.len(), "contacts of a fresh world");
    for (contact, other) in contacts.iter().zip(&others) {
        assert_eq!((keys[rank(contact.a)], keys[rank(contact.b)]), (other.a, other.b));
        assert_eq!((contact.sensor, contact.overlapping), (other.sensor, other.overlapping));
        assert_eq!(format!("{:?}", contact.manifolds), format!("{:?}", other.manifolds), "in every bit");
        assert_eq!(other.is_new, other.overlapping, "in a fresh world every touch is new");
    }
}
