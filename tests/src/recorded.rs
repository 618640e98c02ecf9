//! The named worlds of `asunder-scenes`, played into a world frame by frame; and what a frame reports, as hashes.

use crate::engine::Engine;
use asunder::slotmap::Key;
use asunder::{Collider, Event, Plane, Pose2, Pose3, Space, Volume, World};
use asunder_scenes::worlds::{Body2, Body3, Replay2, Replay3, WorldScene};

/// Gap within which two bodies are a contact, in metres: half of it is each body's margin.
pub(crate) const MARGIN: f32 = 0.02;

/// A world and the motion of its bodies.
pub struct Recorded<S: Recording, R = <S as Recording>::Replay> {
    /// The world, as of the last frame.
    pub world: World<S>,
    keys: Vec<S::Key>,
    replay: R,
}

impl<S: Recording> Recorded<S> {
    /// A world of `count` bodies or a few less, not updated yet. Seed 1.
    pub fn new(scene: WorldScene, count: usize) -> Self {
        Self::with(S::open(scene, count))
    }
}

impl<S: Recording, R: Replay<S>> Recorded<S, R> {
    /// A world of these bodies, not updated yet.
    pub fn with((replay, colliders): (R, Vec<Collider<S>>)) -> Self {
        let mut world = World::new();
        let keys = colliders.into_iter().map(|collider| S::insert(&mut world, collider)).collect();
        Self { world, keys, replay }
    }

    /// Sets the poses of all moving bodies for this frame. Allocates nothing itself.
    pub fn pose(&mut self, frame: u32) {
        let Self { world, keys, replay } = self;
        replay.advance(frame, |body, pose| assert!(S::set_pose(world, keys[body], pose)));
    }

    /// The same, followed by an update.
    pub fn play(&mut self, frame: u32) {
        self.pose(frame);
        self.world.update();
    }

    /// Adds what the last frame reported to both hashes, events to the first and contacts to the second. Allocates
    /// nothing.
    pub fn hash(&self, events: &mut Fnv1a, contacts: &mut Fnv1a) {
        hash(&self.world, events, contacts);
    }
}

/// Adds what a world's last frame reported to both hashes, events to the first and contacts to the second. Allocates
/// nothing.
pub fn hash<S: Recording>(world: &World<S>, events: &mut Fnv1a, contacts: &mut Fnv1a) {
    for event in S::events(world) {
        let (Event::Began { a, b, .. } | Event::Ended { a, b, .. }) = *event;
        let (user_data_a, user_data_b) = event.user_data();
        let flags = u64::from(event.is_began()) << 1 | u64::from(event.is_sensor());
        events.add([bits(a), bits(b), user_data_a, user_data_b, flags]);
    }
    S::hash_contacts(world, contacts);
}

fn bits(key: impl Key) -> u64 {
    key.data().as_ffi()
}

/// The 64-bit hash of Fowler, Noll and Vo, variant 1a: simple enough to be written out here, so that it never changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv1a(pub u64);

impl Default for Fnv1a {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv1a {
    /// Adds words, least significant byte first.
    pub fn add<const N: usize>(&mut self, words: [u64; N]) {
        for byte in words.into_iter().flat_map(u64::to_le_bytes) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds numbers, bit for bit.
    pub fn add_floats<const N: usize>(&mut self, numbers: [f32; N]) {
        self.add(numbers.map(|number| u64::from(number.to_bits())));
    }
}

/// The poses of bodies at a frame.
pub trait Replay<S: Space>: Send {
    /// Passes on the pose of every moving body, by its number.
    fn advance(&mut self, frame: u32, set: impl FnMut(usize, S::Pose));
}

/// A dimension's recorded worlds.
pub trait Recording: Engine {
    /// How the bodies of a named world move.
    type Replay: Replay<Self>;
    /// The motion, and the bodies at its start.
    fn open(scene: WorldScene, count: usize) -> (Self::Replay, Vec<Collider<Self>>);
    /// Adds candidates and contacts: every key, flag, number and feature id.
    fn hash_contacts(world: &World<Self>, into: &mut Fnv1a);
}

impl Replay<Volume> for Replay3 {
    fn advance(&mut self, frame: u32, mut set: impl FnMut(usize, Pose3)) {
        self.advance(frame);
        for &body in self.movers() {
            set(body as usize, self.bodies[body as usize].pose);
        }
    }
}

impl Recording for Volume {
    type Replay = Replay3;

    fn open(scene: WorldScene, count: usize) -> (Replay3, Vec<Collider<Self>>) {
        let replay = Replay3::new(scene, count, 1);
        let collider = |(number, body): (u64, &Body3)| {
            let collider = Collider::<Self>::new(body.shape.clone()).at(body.pose).user_data(number);
            let collider = if body.fixed { collider.fixed() } else { collider };
            body.owner.into_iter().fold(collider, Collider::owner).margin(0.5 * MARGIN).unwrap()
        };
        let colliders = (0..).zip(&replay.bodies).map(collider).collect();
        (replay, colliders)
    }

    fn hash_contacts(world: &World<Self>, into: &mut Fnv1a) {
        world.candidates().for_each(|(a, b)| into.add([bits(a), bits(b)]));
        for contact in world.contacts() {
            let flags = [contact.sensor, contact.overlapping, contact.is_new].map(u64::from);
            into.add([bits(contact.a), bits(contact.b)]);
            into.add(flags);
            for manifold in contact.manifolds {
                into.add([manifold.part_a, manifold.part_b, manifold.points.len() as u32].map(u64::from));
                into.add_floats(manifold.normal.to_array());
                into.add_floats([manifold.separation, manifold.error]);
                for point in &manifold.points {
                    into.add_floats(point.anchor_a.to_array());
                    into.add_floats(point.anchor_b.to_array());
                    into.add_floats([point.separation]);
                    into.add([point.feature.to_bits()]);
                }
            }
        }
    }
}

impl Replay<Plane> for Replay2 {
    fn advance(&mut self, frame: u32, mut set: impl FnMut(usize, Pose2)) {
        self.advance(frame);
        for &body in self.movers() {
            set(body as usize, self.bodies[body as usize].pose);
        }
    }
}

impl Recording for Plane {
    type Replay = Replay2;

    fn open(scene: WorldScene, count: usize) -> (Replay2, Vec<Collider<Self>>) {
        let replay = Replay2::new(scene, count, 1);
        let collider = |(number, body): (u64, &Body2)| {
            let collider = Collider::<Self>::new(body.shape.clone()).at(body.pose).user_data(number);
            let collider = if body.fixed { collider.fixed() } else { collider };
            body.owner.into_iter().fold(collider, Collider::owner).margin(0.5 * MARGIN).unwrap()
        };
        let colliders = (0..).zip(&replay.bodies).map(collider).collect();
        (replay, colliders)
    }

    fn hash_contacts(world: &World<Self>, into: &mut Fnv1a) {
        world.candidates().for_each(|(a, b)| into.add([bits(a), bits(b)]));
        for contact in world.contacts() {
            let flags = [contact.sensor, contact.overlapping, contact.is_new].map(u64::from);
            into.add([bits(contact.a), bits(contact.b)]);
            into.add(flags);
            for manifold in contact.manifolds {
                into.add([manifold.part_a, manifold.part_b, manifold.points.len() as u32].map(u64::from));
                into.add_floats(manifold.normal.to_array());
                into.add_floats([manifold.separation, manifold.error]);
                for point in &manifold.points {
                    into.add_floats(point.anchor_a.to_array());
                    into.add_floats(point.anchor_b.to_array());
                    into.add_floats([point.separation]);
                    into.add([point.feature.to_bits()]);
                }
            }
        }
    }
}
