//! What can be asked of a game.

use super::{Game, Places, State};
use crate::physics::{Linear, Physics, Touch};
use crate::recording::Numbers;
use asunder::AnyWorld;

impl<S: Physics> Game<S> {
    /// How many bodies were added.
    pub fn len(&self) -> usize {
        self.bodies.len()
    }

    /// Whether none was added.
    pub fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// How many steps were done.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// How many bodies are awake, and how many are asleep, of those that pushes can move.
    pub fn awake_and_asleep(&self) -> (usize, usize) {
        (self.awake.len(), self.islands.asleep.len())
    }

    /// The key of a body in the world; nothing for one that has left, or never came.
    pub fn key(&self, number: usize) -> Option<S::Key> {
        self.bodies.get(number).filter(|body| body.state != State::Left).map(|body| body.key)
    }

    /// The number of a body of the world; nothing for a key of another world.
    pub fn number(&self, key: S::Key) -> Option<usize> {
        self.numbers.get(key).map(|&number| number as usize)
    }

    /// Where a body's centre of mass is.
    pub fn center(&self, number: usize) -> Option<S::Vector> {
        self.bodies.get(number).map(|body| body.center)
    }

    /// How fast a body's centre of mass moves, in m/s.
    pub fn velocity(&self, number: usize) -> Option<S::Vector> {
        self.motions.get(number).map(|motion| motion.velocity)
    }

    /// Gives a body another speed, in m/s, and wakes it. No effect on what pushes cannot move.
    pub fn set_velocity(&mut self, number: usize, velocity: S::Vector) {
        match self.bodies.get(number).map(|body| body.state) {
            Some(State::Awake) => {}
            Some(State::Asleep) => {
                let Self { bodies, islands, awake, .. } = self;
                islands.rouse(number as u32);
                islands.wake(awake, |number| bodies[number as usize].state = State::Awake);
                self.gather();
            }
            _ => return,
        }
        self.motions[number].velocity = velocity;
    }

    /// The deepest overlap of any contact point of the last update, in metres.
    pub fn deepest_now(&self) -> f64 {
        self.all_touches().map(|touch| -touch.separation).fold(0.0, f64::max)
    }

    /// The deepest overlap of any contact point of the last update, as a share of the smaller body's size: the edge of
    /// the cube, or of the square, of its mass.
    pub fn deepest_share(&self) -> f64 {
        self.all_touches().map(|touch| self.share_of(&touch)).fold(0.0, f64::max)
    }

    fn all_touches(&self) -> impl Iterator<Item = Touch<S>> {
        let pair = |a, b| Some([*self.numbers.get(a)?, *self.numbers.get(b)?]);
        let of_bodies =
            self.world.contacts().filter_map(move |contact| Some((contact, pair(contact.a, contact.b)?)));
        of_bodies.flat_map(|(contact, bodies)| S::touches(contact, bodies))
    }

    pub(super) fn share_of(&self, touch: &Touch<S>) -> f64 {
        let [a, b] = touch.bodies.map(|number| self.bodies[number as usize].matter.size);
        -touch.separation / a.min(b)
    }

    /// The greatest speed of any body, in m/s: near zero once the scene is at rest.
    pub fn fastest_now(&self) -> f64 {
        let motions = self.awake.iter().map(|&number| &self.motions[number as usize]);
        motions.map(|motion| motion.velocity.length()).fold(0.0, f64::max)
    }

    /// The kinetic energy of all that pushes can move, in joules.
    pub fn energy(&self) -> f64 {
        let energy = |&number: &u32| {
            let (body, motion) = (&self.bodies[number as usize], &self.motions[number as usize]);
            let inertia = S::turned_inertia(&body.matter.inverse_inertia, body.turn);
            let spin = S::spin_energy(&inertia, motion.spin);
            0.5 * (motion.velocity.dot(motion.velocity) / body.matter.inverse_mass + spin)
        };
        // Not `sum`: of nothing that is -0.
        self.awake.iter().map(energy).fold(0.0, |sum, one| sum + one)
    }

    /// How many bodies that pushes can move are outside a room, or have left the level.
    pub fn outside(&self, room: &(S::Vector, S::Vector)) -> usize {
        let numbers = self.awake.iter().chain(&self.islands.asleep);
        let is_out = |&&number: &&u32| !S::is_within(self.bodies[number as usize].center, room);
        numbers.filter(is_out).count() + self.counts.left
    }

    /// Where all bodies are.
    pub fn places(&self) -> Places<S> {
        Places(self.bodies.iter().map(|body| (body.center, body.turn)).collect())
    }

    /// How far the body has moved that moved furthest since then, as a share of its size: its centre, and its
    /// furthest point by turning. The size is the edge of the cube, or of the square, of its mass. Bodies that have
    /// left are infinitely far.
    pub fn strayed(&self, since: &Places<S>) -> f64 {
        let mut most: f64 = 0.0;
        for (body, (center, turn)) in self.bodies.iter().zip(&since.0) {
            match body.state {
                State::Left => return f64::INFINITY,
                State::Fixed | State::Driven => continue,
                State::Awake | State::Asleep => {}
            }
            let moved = (body.center - *center).length();
            let turned = S::spin_between(*turn, body.turn).length() * body.matter.reach;
            most = most.max((moved + turned) / body.matter.size);
        }
        most
    }

    /// A number that differs wherever the poses of two runs do (FNV-1a over their bits).
    pub fn digest(&self) -> u64 {
        let mut digest = 0xcbf2_9ce4_8422_2325_u64;
        for body in self.bodies.iter().filter_map(|body| self.world.get(body.key)) {
            for byte in S::pose_of(body).numbers().flat_map(f64::to_le_bytes) {
                digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
        digest
    }
}
