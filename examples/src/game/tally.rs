//! Queries of a game.

use super::{Game, Places, spin_between};
use crate::playable::{InSpace, Playable};
use crate::recording::Numbers;
use crate::stepper::{Point, State};
use asunder::AnyWorld;
use asunder::glam::DVec3;

impl<S: Playable> Game<S> {
    /// How many bodies were added.
    pub fn len(&self) -> usize {
        self.actors.len()
    }

    /// Whether none was added.
    pub fn is_empty(&self) -> bool {
        self.actors.is_empty()
    }

    /// How many steps were done.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// How many of the bodies that pushes can move are awake, and how many asleep.
    pub fn awake_and_asleep(&self) -> (usize, usize) {
        (self.stepper.awake().len(), self.stepper.asleep().len())
    }

    /// The key of a body in the world; `None` for one that has left, or was never added.
    pub fn key(&self, number: usize) -> Option<S::Key> {
        let body = self.stepper.bodies().get(number)?;
        (body.state != State::Removed).then(|| body.key.into())
    }

    /// Where a body's centre of mass is.
    pub fn center(&self, number: usize) -> Option<DVec3> {
        self.stepper.bodies().get(number).map(|body| body.center)
    }

    /// Gives a body another velocity, in m/s, and wakes it. Does nothing to a body that pushes cannot move.
    pub fn set_velocity(&mut self, number: usize, velocity: DVec3) {
        self.stepper.wake(&[number]);
        if self.stepper.bodies().get(number).is_some_and(|body| body.state == State::Awake) {
            self.stepper.bodies_mut()[number].velocity = velocity;
        }
    }

    /// The deepest overlap of any contact point of the last update, in metres.
    pub fn deepest_now(&self) -> f64 {
        self.all_points().map(|point| -point.separation).fold(0.0, f64::max)
    }

    /// The deepest overlap of any contact point of the last update, as a share of the smaller body's size: the edge of
    /// the cube, or square, of the same mass.
    pub fn deepest_share(&self) -> f64 {
        self.all_points().map(|point| self.share_of(&point)).fold(0.0, f64::max)
    }

    /// The points of all contacts, also of sleeping bodies.
    fn all_points(&self) -> impl Iterator<Item = Point> {
        self.stepper.world.contacts().flat_map(|contact| {
            let numbers = [contact.a, contact.b].map(|key| self.stepper.number(key));
            let bodies = if let [Some(a), Some(b)] = numbers { Some([a, b]) } else { None };
            let points = contact.manifolds.iter().flat_map(S::points);
            points.filter_map(move |mut point| {
                point.bodies = bodies?;
                Some(point)
            })
        })
    }

    /// The greatest speed of any body, in m/s: near zero once the scene is at rest.
    pub fn fastest_now(&self) -> f64 {
        let bodies = self.stepper.awake().iter().map(|&number| &self.stepper.bodies()[number]);
        bodies.map(|body| body.velocity.length()).fold(0.0, f64::max)
    }

    /// The kinetic energy of all bodies that are awake, in joules.
    pub fn energy(&self) -> f64 {
        let energy = |&number: &usize| {
            let body = &self.stepper.bodies()[number];
            // In the body's axes, as the inertia is. In the plane the matrix is singular: all but its last entry is
            // zero.
            let (spin, inverse) = (body.turn.conjugate() * body.spin, body.mass.inverse_inertia);
            let momentum = match inverse.determinant() > 0.0 {
                true => inverse.inverse() * spin,
                false => spin / inverse.z_axis.z,
            };
            0.5 * (body.velocity.dot(body.velocity) / body.mass.inverse + spin.dot(momentum))
        };
        // Not `sum`, which is -0 for no items.
        self.stepper.awake().iter().map(energy).fold(0.0, |sum, one| sum + one)
    }

    /// How many bodies that pushes can move are outside a room, or have left the level.
    pub fn outside<V: InSpace>(&self, (low, high): (V, V)) -> usize {
        let (low, high) = (low.in_space(), high.in_space());
        let is_out = |&&number: &&usize| {
            let center = self.stepper.bodies()[number].center;
            !(center.cmpge(low).all() && center.cmple(high).all())
        };
        let numbers = self.stepper.awake().iter().chain(self.stepper.asleep());
        numbers.filter(is_out).count() + self.counts.left
    }

    /// Where all bodies are.
    pub fn places(&self) -> Places {
        Places(self.stepper.bodies().iter().map(|body| (body.center, body.turn)).collect())
    }

    /// How far the body that has moved furthest since then has moved, as a share of its size: the motion of its centre
    /// and, by rotation, of its furthest point. The size is the edge of the cube, or square, of the same mass. A body
    /// that has left counts as infinitely far.
    pub fn strayed(&self, since: &Places) -> f64 {
        let mut most: f64 = 0.0;
        for ((body, actor), (center, turn)) in self.stepper.bodies().iter().zip(&self.actors).zip(&since.0) {
            match body.state {
                State::Removed => return f64::INFINITY,
                State::Fixed => continue,
                State::Awake | State::Asleep => {}
            }
            let moved = (body.center - *center).length();
            let turned = spin_between(*turn, body.turn).length() * body.mass.reach;
            most = most.max((moved + turned) / actor.size);
        }
        most
    }

    /// A hash of all poses, to compare two runs (FNV-1a over their bits).
    pub fn digest(&self) -> u64 {
        let mut digest = 0xcbf2_9ce4_8422_2325_u64;
        for body in self.stepper.bodies().iter().filter_map(|body| self.stepper.world.get(body.key.into())) {
            for byte in S::pose_of(body).numbers().flat_map(f64::to_le_bytes) {
                digest = (digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
        digest
    }
}
