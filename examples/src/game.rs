//! The game: a world, and bodies with mass and speed that its contacts push apart.

use crate::physics::{Physics, TouchId};
use crate::response::{Motion, Pushes, respond};
use asunder::slotmap::SecondaryMap;
use asunder::{Collider, Event, World};

/// How close bodies come before they get a contact, each. A contact that exists before it is needed lets the response
/// stop a body at the surface instead of inside it.
pub const MARGIN: f32 = 0.02;

/// A body this far from where it started, in metres, has left the level.
const LEFT: f64 = 1000.0;

/// The world and the bodies in it, in their own order.
pub struct Game<S: Physics> {
    /// What finds the contacts.
    pub world: World<S>,
    /// What has happened so far.
    pub counts: Counts,
    gravity: S::Vector,
    bodies: Vec<Body<S>>,
    motions: Vec<Motion<S>>,
    numbers: SecondaryMap<S::Key, usize>,
    last_pushes: Vec<(TouchId<S::Key>, Pushes<S>)>,
}

/// What has happened since the start.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    /// Contacts that began.
    pub began: usize,
    /// Contacts that ended.
    pub ended: usize,
    /// Events of sensors among those.
    pub sensed: usize,
    /// Bodies that have left the level.
    pub left: usize,
    /// Of any step, in metres.
    pub deepest: f64,
}

/// A shape that moves and has no mass: without an inside, without an end, or too thin for its mass to be told from
/// zero.
#[derive(Debug)]
pub struct NoMass;

impl std::error::Error for NoMass {}

impl std::fmt::Display for NoMass {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the shape has no mass to move: make it thicker, or the body fixed")
    }
}

struct Body<S: Physics> {
    key: S::Key,
    center: S::Vector,
    local_center: S::Vector,
    start: S::Vector,
    turn: S::Turn,
    inverse_inertia: S::Inertia,
    is_here: bool,
    is_sensor: bool,
}

impl<S: Physics> Game<S> {
    /// An empty game, with gravity in m/s^2.
    pub fn new(gravity: S::Vector) -> Self {
        Self {
            world: World::new(),
            counts: Counts::default(),
            gravity,
            bodies: Vec::new(),
            motions: Vec::new(),
            numbers: SecondaryMap::new(),
            last_pushes: Vec::new(),
        }
    }

    /// Adds a body.
    ///
    /// # Errors
    /// A shape that has no mass to speak of.
    pub fn add(
        &mut self,
        collider: Collider<S>,
        shape: &S::Shape,
        pose: &S::Pose,
        velocity: S::Vector,
        spin: S::Spin,
    ) -> Result<(), NoMass> {
        let (position, turn) = S::place(pose);
        let is_fixed = collider.is_fixed();
        // Scenery needs none, and may be without an end.
        let mass = if is_fixed { None } else { Some(S::mass(shape).ok_or(NoMass)?) };
        let local_center = mass.as_ref().map_or(S::Vector::default(), |mass| mass.center);
        let center = position + S::turned(turn, local_center);
        let is_sensor = collider.is_sensor();
        let key = S::insert(&mut self.world, collider);
        self.numbers.insert(key, self.bodies.len());
        let inverse_inertia = mass.as_ref().map_or(S::IMMOVABLE, |mass| mass.inverse_inertia);
        self.bodies.push(Body {
            key,
            center,
            local_center,
            start: center,
            turn,
            inverse_inertia,
            is_here: true,
            is_sensor,
        });
        let inverse_mass = mass.map_or(0.0, |mass| 1.0 / mass.mass);
        self.motions.push(Motion::new(velocity, spin, inverse_mass));
        Ok(())
    }

    /// One step: the contacts of the last update push, bodies move, and the world finds the next contacts.
    pub fn step(&mut self, seconds: f64) {
        for (body, motion) in self.bodies.iter().zip(&mut self.motions) {
            motion.start_step(S::turned_inertia(&body.inverse_inertia, body.turn));
        }
        let touches = S::touches(&self.world);
        let arms = |number: usize, anchor: S::Vector| {
            let body = &self.bodies[number];
            anchor - S::turned(body.turn, body.local_center)
        };
        let numbered = touches.iter().filter_map(|touch| {
            let (&a, &b) = (self.numbers.get(touch.id.a)?, self.numbers.get(touch.id.b)?);
            Some((touch, (a, arms(a, touch.anchor_a)), (b, arms(b, touch.anchor_b))))
        });
        self.last_pushes = respond(numbered, &mut self.motions, &self.last_pushes, self.gravity, seconds);
        self.move_bodies();
        self.update();
    }

    /// Brings the world's contacts up to date and counts what they say.
    pub fn update(&mut self) {
        self.world.update();
        for event in S::events(&self.world) {
            match event {
                Event::Began { .. } => self.counts.began += 1,
                Event::Ended { .. } => self.counts.ended += 1,
            }
            let (a, b) = event.bodies();
            let is_sensor = |key| self.numbers.get(key).is_some_and(|&number| self.bodies[number].is_sensor);
            self.counts.sensed += usize::from(is_sensor(a) || is_sensor(b));
        }
        self.counts.deepest = self.counts.deepest.max(self.deepest_now());
    }

    /// The deepest overlap of any contact point of the last update, in metres.
    pub fn deepest_now(&self) -> f64 {
        S::touches(&self.world).iter().map(|touch| -touch.separation).fold(0.0, f64::max)
    }

    /// The greatest speed of any body, in m/s: near zero once the scene is at rest.
    pub fn fastest_now(&self) -> f64 {
        let bodies = self.bodies.iter().zip(&self.motions).filter(|(body, _)| body.is_here);
        bodies.map(|(_, motion)| S::dot(motion.velocity, motion.velocity)).fold(0.0, f64::max).sqrt()
    }

    /// A number that differs wherever the poses of two runs do (FNV-1a over their bits).
    pub fn digest(&self) -> u64 {
        let mut digest = 0xcbf2_9ce4_8422_2325_u64;
        for pose in self.bodies.iter().filter_map(|body| S::pose_of(&self.world, body.key)) {
            for byte in S::pose_bits(&pose).into_iter().flat_map(u64::to_le_bytes) {
                digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
        digest
    }

    fn move_bodies(&mut self) {
        for (body, motion) in self.bodies.iter_mut().zip(&mut self.motions) {
            if motion.inverse_mass == 0.0 || !body.is_here {
                continue;
            }
            body.center += motion.moved;
            body.turn = S::turned_by(body.turn, motion.turned);
            let travelled = body.center - body.start;
            let pose = S::pose(body.center - S::turned(body.turn, body.local_center), body.turn);
            match pose {
                Some(pose) if S::dot(travelled, travelled) < LEFT * LEFT => {
                    S::set_pose(&mut self.world, body.key, pose);
                }
                _ => {
                    S::remove(&mut self.world, body.key);
                    body.is_here = false;
                    motion.inverse_mass = 0.0;
                    self.counts.left += 1;
                }
            }
        }
    }
}
