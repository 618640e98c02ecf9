//! A rigid-body stepper: a world, and bodies with mass and velocity that its contacts push apart.
//!
//! [`Stepper::step`] is four calls, and a game that has something to do in between makes them itself:
//! - [`solve`](Stepper::solve) turns contacts into motions;
//! - [`advance`](Stepper::advance) moves the bodies;
//! - [`settle`](Stepper::settle) sends bodies at rest to sleep;
//! - [`update`](Stepper::update) finds the next contacts and wakes the sleeping bodies that they concern.
//!
//! | file | what is in it |
//! |---|---|
//! | this one | the step, which contacts are solved, queries |
//! | `body` | where a body is, how it moves and how it answers pushes |
//! | `solver` | soft contacts, friction, restitution, warm starting |
//! | `islands` | who sleeps |
//! | `dimension` | what differs between space and the plane |
//!
//! It uses only the engine's public interface, and nothing else of the examples. Equal calls give equal bits: bodies
//! and contacts are visited in a fixed order, in one thread.
//!
//! ```
//! use asunder::glam::{DVec3, Vec3};
//! use asunder::{Collider3, Cuboid, HalfSpace, Pose3, Volume};
//! use asunder_examples::stepper::{MARGIN, Stepper};
//! let mut stepper = Stepper::<Volume>::new(DVec3::NEG_Y * 9.81);
//! let floor = Collider3::new(HalfSpace::new(Vec3::Y)?).fixed();
//! let cube = Collider3::new(Cuboid::from_half_extents(Vec3::splat(0.5))?);
//! stepper.add(floor, DVec3::ZERO, DVec3::ZERO);
//! let cube = stepper.add(cube.at(Pose3::at([0.0, 0.6, 0.0])?).margin(MARGIN)?, DVec3::X, DVec3::ZERO);
//! stepper.update();
//! (0..120).for_each(|_| stepper.step(1.0 / 60.0));
//! let cube = &stepper.bodies()[cube.ok_or("it has mass")?];
//! assert!(cube.center.x > 0.05 && (cube.center.y - 0.5).abs() < 0.01, "it slid, and lies still");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body;
mod dimension;
mod islands;
mod solver;

pub use asunder_scenes::stages::Feel;
pub use body::{Body, Mass, State};
pub use dimension::Dimension;
pub use solver::Point;

use asunder::glam::DVec3;
use asunder::slotmap::{Key, SecondaryMap};
use asunder::{AnyWorld, Collider, World};
use islands::Islands;
use solver::{Pass, warm_start};

/// The contact margin of each body: how close it comes before it gets a contact. A contact that exists before it is
/// needed lets the solver stop a body at the surface instead of inside it.
pub const MARGIN: f32 = 0.02;

/// Bodies with a separation below this, in metres, belong to one island and wake each other.
const JOINED: f64 = 0.005;

/// A world and the bodies in it. A body's number is the order in which it was added, and never changes.
pub struct Stepper<S: Dimension> {
    /// The world, which finds the contacts.
    pub world: World<S>,
    /// In m/s^2.
    pub gravity: DVec3,
    /// How bodies behave where they touch.
    pub feel: Feel,
    bodies: Vec<Body>,
    numbers: SecondaryMap<S::Key, usize>,
    islands: Islands,
    driven: Vec<usize>,
    /// The points of the last update, in the world's order of pairs; and those that the last step has solved.
    points: Vec<Point>,
    solved: Vec<Point>,
    /// The length of the last step, used as an estimate of the next.
    seconds: f64,
}

impl<S: Dimension> Stepper<S> {
    /// An empty world, with gravity in m/s^2. In the plane the third coordinate of every place and velocity is zero,
    /// and so are the first two of every spin.
    pub fn new(gravity: DVec3) -> Self {
        Self {
            world: World::new(),
            gravity,
            feel: Feel::default(),
            bodies: Vec::new(),
            numbers: SecondaryMap::new(),
            islands: Islands::default(),
            driven: Vec::new(),
            points: Vec::new(),
            solved: Vec::new(),
            seconds: 1.0 / 60.0,
        }
    }

    /// Adds a body, with velocities in m/s and rad/s, and returns its number; `None` for a shape without mass. A fixed
    /// body needs no mass, and has no velocity until it is driven.
    pub fn add(&mut self, collider: Collider<S>, velocity: DVec3, spin: DVec3) -> Option<usize> {
        let (state, mass, [velocity, spin]) = match collider.is_fixed() {
            true => (State::Fixed, Mass::ENDLESS, [DVec3::ZERO; 2]),
            false => (State::Awake, S::mass(&collider)?, [velocity, spin]),
        };
        let (number, place) = (self.bodies.len(), S::place(S::pose_of(&collider)));
        let key = self.world.insert(collider);
        self.numbers.insert(key, number);
        self.islands.add(state == State::Awake);
        self.bodies.push(Body { velocity, spin, ..Body::new(key.data(), state, mass, place) });
        Some(number)
    }

    /// Drives a body from now on: no push moves it; it moves with the velocity set in [`Self::bodies_mut`], and pushes
    /// and carries others. Does nothing if there is no such body.
    pub fn drive(&mut self, number: usize) {
        self.wake(&[number]);
        let Some(body) = self.bodies.get_mut(number) else { return };
        *body = Body::new(body.key, State::Fixed, Mass::ENDLESS, (body.center - body.offset, body.turn));
        self.islands.awake.retain(|&other| other != number);
        self.driven.retain(|&other| other != number);
        self.driven.push(number);
    }

    /// Puts a body somewhere else; its velocity stays as it is.
    pub fn place(&mut self, number: usize, pose: S::Pose) {
        let Some(body) = self.bodies.get_mut(number) else { return };
        let (position, turn) = S::place(&pose);
        body.offset = turn * body.mass.center;
        (body.center, body.turn) = (position + body.offset, turn);
        // A stale key is a body that has left the world: there is nothing to move.
        let _ = self.world.set_pose(body.key.into(), pose);
    }

    /// Takes a body out of the world, and wakes the bodies it touches.
    pub fn remove(&mut self, number: usize) {
        let Some(key) = self.bodies.get(number).map(|body| S::Key::from(body.key)) else { return };
        let contacts = self.world.contacts().filter(|contact| contact.a == key || contact.b == key);
        let others = contacts.flat_map(|contact| [contact.a, contact.b]).filter_map(|key| self.number(key));
        self.wake(&others.chain([number]).collect::<Vec<usize>>());
        self.bodies[number].state = State::Removed;
        self.bodies[number].rest();
        self.islands.awake.retain(|&other| other != number);
        self.points.retain(|point| !point.bodies.contains(&number));
        self.world.remove(key);
    }

    /// All bodies, by number.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// To change velocities (of a sleeping body, only after [`Self::wake`]), or, between [`Self::solve`] and
    /// [`Self::advance`], the motions of this step.
    pub fn bodies_mut(&mut self) -> &mut [Body] {
        &mut self.bodies
    }

    /// The numbers of the bodies that are awake and that pushes can move, ascending.
    pub fn awake(&self) -> &[usize] {
        &self.islands.awake
    }

    /// The numbers of the sleeping bodies, ascending.
    pub fn asleep(&self) -> &[usize] {
        &self.islands.asleep
    }

    /// The contact points of the last update, between bodies of which at least one moves.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The number of a body of the world; `None` for a key of another world.
    pub fn number(&self, key: S::Key) -> Option<usize> {
        self.numbers.get(key).copied()
    }

    /// One step of so many seconds, more than zero: solves the contacts of the last update, moves the bodies, sends to
    /// sleep what is at rest, and finds the next contacts.
    pub fn step(&mut self, seconds: f64) {
        self.solve(seconds);
        self.advance();
        self.settle();
        self.update();
    }

    /// Finds the motions of one step, under gravity and contacts.
    pub fn solve(&mut self, seconds: f64) {
        let Self { bodies, points, islands, driven, feel, .. } = self;
        for &number in islands.awake.iter().chain(&*driven) {
            bodies[number].prepare();
        }
        warm_start(points, &self.solved);
        points.iter_mut().for_each(|point| point.prepare(bodies));
        let substep = seconds / f64::from(feel.substeps.max(1));
        let soft = Pass::soft(substep, feel.friction);
        let stiff = soft.stiff();
        for _ in 0..feel.substeps.max(1) {
            for &number in &islands.awake {
                bodies[number].velocity += self.gravity * substep;
                bodies[number].spin *= 1.0 / (1.0 + substep * feel.spin_damping);
            }
            points.iter().for_each(|point| point.apply(bodies, point.normal * point.apart + point.aside));
            points.iter_mut().for_each(|point| point.push(bodies, &soft));
            for &number in islands.awake.iter().chain(&*driven) {
                let body = &mut bodies[number];
                body.moved += body.velocity * substep;
                body.turned += body.spin * substep;
            }
            points.iter_mut().for_each(|point| point.push(bodies, &stiff));
        }
        if feel.restitution > 0.0 {
            points.iter_mut().for_each(|point| point.bounce(bodies, feel.restitution));
        }
        self.seconds = seconds;
        core::mem::swap(&mut self.points, &mut self.solved);
    }

    /// Moves the bodies. A body whose motion leads to no valid pose stays where it is and stops.
    pub fn advance(&mut self) {
        for &number in self.islands.awake.iter().chain(&self.driven) {
            let body = &mut self.bodies[number];
            // A body without motion keeps its pose to the bit, and costs the world nothing.
            if body.moved == DVec3::ZERO && body.turned == DVec3::ZERO {
                continue;
            }
            let place = body.after(body.moved, body.turned);
            match body.pose::<S>(place) {
                Some(pose) => {
                    (body.center, body.turn) = place;
                    body.offset = body.turn * body.mass.center;
                    let _ = self.world.set_pose(body.key.into(), pose);
                }
                None => body.rest(),
            }
        }
    }

    /// Sends islands at rest to sleep.
    pub fn settle(&mut self) {
        let Self { bodies, islands, .. } = self;
        for number in islands.awake.clone() {
            islands.note(number, bodies[number].speed_squared(), self.seconds);
        }
        for point in self.solved.iter().filter(|point| point.separation < JOINED) {
            let [a, b] = point.bodies;
            match [bodies[a].state, bodies[b].state] {
                [State::Awake, State::Awake] => islands.join(a, b),
                [State::Fixed, State::Awake] if bodies[a].is_moving() => islands.disturb(b),
                [State::Awake, State::Fixed] if bodies[b].is_moving() => islands.disturb(a),
                _ => {}
            }
        }
        for number in islands.settle() {
            bodies[number].state = State::Asleep;
            bodies[number].rest();
            let _ = self.world.sleep(bodies[number].key.into());
        }
    }

    /// Finds the contacts at the bodies' new poses, and wakes every island that a moving body touches or will touch in
    /// the next step: a body still asleep when it is hit would act as a wall.
    pub fn update(&mut self) {
        self.world.update();
        self.gather();
        let is_near = |point: &&Point| {
            let closing = -point.speed(&self.bodies) * self.seconds;
            point.separation - closing.max(0.0) <= JOINED
        };
        let near: Vec<usize> = self.points.iter().filter(is_near).flat_map(|point| point.bodies).collect();
        self.wake(&near);
    }

    /// Wakes the islands of the given bodies, as far as they sleep.
    pub fn wake(&mut self, numbers: &[usize]) {
        let is_asleep = |&number: &usize| self.bodies.get(number).is_some_and(|b| b.state == State::Asleep);
        let asleep: Vec<usize> = numbers.iter().copied().filter(is_asleep).collect();
        if asleep.is_empty() {
            return;
        }
        for number in self.islands.wake(&asleep) {
            self.bodies[number].state = State::Awake;
        }
        // Contacts between sleeping bodies were left out; those of the bodies that woke count now.
        self.gather();
    }

    /// Collects the contact points to be solved: one body of the pair must move, and one must not be fixed.
    fn gather(&mut self) {
        let Self { world, bodies, numbers, points, .. } = self;
        points.clear();
        for contact in world.contacts() {
            let (Some(&a), Some(&b)) = (numbers.get(contact.a), numbers.get(contact.b)) else { continue };
            let moves = |body: usize| bodies[body].state == State::Awake || bodies[body].is_moving();
            let is_fixed = |body: usize| bodies[body].state == State::Fixed;
            // Speculative contacts of bullets are left out: a game with bullets uses their impacts, which say more.
            let is_bullet = |key| world.get(key).is_some_and(Collider::is_bullet);
            let is_flying = contact.speculative && (is_bullet(contact.a) || is_bullet(contact.b));
            if is_flying || !(moves(a) || moves(b)) || is_fixed(a) && is_fixed(b) {
                continue;
            }
            let keys = [contact.a.data(), contact.b.data()];
            points.extend(contact.manifolds.iter().flat_map(S::points).map(|point| {
                let arms = [point.arms[0] - bodies[a].offset, point.arms[1] - bodies[b].offset];
                Point { keys, bodies: [a, b], arms, ..point }
            }));
        }
    }
}
