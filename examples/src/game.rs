//! The game: a world, and bodies with mass and speed that its contacts push apart.

mod tally;

use crate::flight::Flights;
use crate::islands::Islands;
use crate::physics::{Linear, Matter, Physics, Touch};
use crate::response::{Forces, Motion, Response, approach};
use asunder::slotmap::SecondaryMap;
use asunder::{AnyWorld, Collider, Event, World};
use asunder_scenes::stages::Feel;

/// How close bodies come before they get a contact, each. A contact that exists before it is needed lets the response
/// stop a body at the surface instead of inside it.
pub const MARGIN: f32 = 0.02;

/// A body this far from where it started, in metres, has left the level.
const LEFT: f64 = 1000.0;

/// Bodies nearer than this, in metres, are of one island, and wake each other.
const JOINED: f64 = 0.005;

/// After so many seconds a scene is taken to have settled.
const SETTLED: f64 = 2.0;

/// The world and the bodies in it, in their own order.
///
/// A body has a number, by the order in which it was added; it keeps it when it leaves the level.
pub struct Game<S: Physics> {
    /// What finds the contacts.
    pub world: World<S>,
    /// What has happened so far.
    pub counts: Counts,
    /// What bodies are like where they touch.
    pub feel: Feel,
    /// Whether bodies that are at rest fall asleep.
    pub sleeps: bool,
    gravity: S::Vector,
    bodies: Vec<Body<S>>,
    motions: Vec<Motion<S>>,
    numbers: SecondaryMap<S::Key, u32>,
    /// Numbers of those that pushes move, ascending.
    awake: Vec<u32>,
    /// Numbers of those that go their own way, in the order in which they were told to, and their ways.
    driven: Vec<u32>,
    paths: Vec<Path<S>>,
    islands: Islands,
    flights: Flights<S>,
    touches: Vec<Touch<S>>,
    response: Response<S>,
    steps: u32,
    /// Of the last step, and so about of the next.
    seconds: f64,
}

/// Where a driven body is, frame by frame.
type Path<S> = Box<dyn Fn(u32) -> <S as asunder::Space>::Pose + Send>;

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
    /// Overlap of any step, in metres.
    pub deepest: f64,
    /// Overlap of any step after the first two seconds, in metres.
    pub deepest_settled: f64,
    /// The same as a share of the smaller body's size: the edge of the cube, or of the square, of its mass.
    pub deepest_share: f64,
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

/// Where all bodies are at one time, to be compared with where they are later.
pub struct Places<S: Physics>(Vec<(S::Vector, S::Turn)>);

pub(crate) struct Body<S: Physics> {
    pub(crate) key: S::Key,
    pub(crate) center: S::Vector,
    pub(crate) turn: S::Turn,
    start: S::Vector,
    pub(crate) matter: Matter<S>,
    pub(crate) is_bullet: bool,
    is_sensor: bool,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// Moved by nothing.
    Fixed,
    /// Moved along a path.
    Driven,
    Awake,
    Asleep,
    /// Out of the level.
    Left,
}

impl<S: Physics> Body<S> {
    /// The pose with the centre of mass at a place.
    pub(crate) fn pose_at(&self, center: S::Vector, turn: S::Turn) -> Option<S::Pose> {
        S::pose(center - S::turned(turn, self.matter.center), turn)
    }

    /// The square of a bound on the speed of its points.
    fn speed_squared(&self, motion: &Motion<S>) -> f64 {
        let reach = self.matter.reach;
        motion.velocity.dot(motion.velocity) + motion.spin.dot(motion.spin) * reach * reach
    }
}

impl<S: Physics> Game<S> {
    /// An empty game, with gravity in m/s^2.
    pub fn new(gravity: S::Vector) -> Self {
        Self {
            world: World::new(),
            counts: Counts::default(),
            feel: Feel::default(),
            sleeps: true,
            gravity,
            bodies: Vec::new(),
            motions: Vec::new(),
            numbers: SecondaryMap::new(),
            awake: Vec::new(),
            driven: Vec::new(),
            paths: Vec::new(),
            islands: Islands::default(),
            flights: Flights::NONE,
            touches: Vec::new(),
            response: Response::NONE,
            steps: 0,
            seconds: 1.0 / 60.0,
        }
    }

    /// Adds a body, with speeds in m/s and rad/s, and returns its number.
    ///
    /// # Errors
    /// A shape that has no mass to speak of.
    pub fn add(
        &mut self,
        collider: Collider<S>,
        velocity: S::Vector,
        spin: S::Spin,
    ) -> Result<usize, NoMass> {
        let (matter, state) = match collider.is_fixed() {
            true => (Matter::none(), State::Fixed),
            false => (S::matter(&collider).ok_or(NoMass)?, State::Awake),
        };
        let (position, turn) = S::place(S::pose_of(&collider));
        let center = position + S::turned(turn, matter.center);
        let (number, is_bullet, is_sensor) =
            (self.bodies.len() as u32, collider.is_bullet(), collider.is_sensor());
        let mut motion = Motion::new(velocity, spin, center - position);
        match state {
            State::Fixed => motion.rest(),
            _ => self.awake.push(number),
        }
        let key = self.world.insert(collider);
        self.numbers.insert(key, number);
        self.islands.add_body();
        self.motions.push(motion);
        self.bodies.push(Body { key, center, turn, start: center, matter, is_bullet, is_sensor, state });
        Ok(number as usize)
    }

    /// Drives a body from now on: after so many steps it is where the path says, whatever is in its way. It pushes
    /// and carries others with the speed that follows. No such body is no fault.
    pub fn drive(&mut self, number: usize, path: impl Fn(u32) -> S::Pose + Send + 'static) {
        let Some(body) = self.bodies.get_mut(number) else { return };
        body.center -= self.motions[number].offset;
        (body.matter.center, body.state) = (S::Vector::default(), State::Driven);
        let (still, at_origin) = (S::Vector::default(), S::Vector::default());
        self.motions[number] = Motion::new(still, S::Spin::default(), at_origin);
        self.awake.retain(|&other| other as usize != number);
        self.driven.push(number as u32);
        self.paths.push(Box::new(path));
    }

    /// One step: the contacts of the last update push, bodies move, and the world finds the next contacts.
    pub fn step(&mut self, seconds: f64) {
        self.seconds = seconds;
        self.steps += 1;
        for &number in &self.awake {
            let (body, motion) = (&self.bodies[number as usize], &mut self.motions[number as usize]);
            motion.inverse_mass = body.matter.inverse_mass;
            motion.inverse_inertia = S::turned_inertia(&body.matter.inverse_inertia, body.turn);
            (motion.moved, motion.turned) = (S::Vector::default(), S::Spin::default());
        }
        let targets = self.aim();
        let forces = Forces { gravity: self.gravity, feel: self.feel, seconds };
        let moving: [&[u32]; 2] = [&self.awake, &self.driven];
        self.response.respond(&self.touches, &mut self.motions, moving, &forces);
        self.move_bodies();
        for (&number, pose) in self.driven.iter().zip(targets) {
            let body = &mut self.bodies[number as usize];
            (body.center, body.turn) = S::place(&pose);
            // A stale key is a body that has left the level: there is nothing to move.
            let _ = self.world.set_pose(body.key, pose);
        }
        if self.sleeps {
            self.send_to_sleep();
        }
        self.update();
    }

    /// Gives driven bodies the speeds that lead them to their next places.
    fn aim(&mut self) -> Vec<S::Pose> {
        let rate = 1.0 / self.seconds;
        let mut targets = Vec::with_capacity(self.paths.len());
        for (&number, path) in self.driven.iter().zip(&self.paths) {
            let (body, motion) = (&self.bodies[number as usize], &mut self.motions[number as usize]);
            let pose = path(self.steps);
            let (position, turn) = S::place(&pose);
            motion.velocity = (position - body.center) * rate;
            motion.spin = S::spin_between(body.turn, turn) * rate;
            (motion.moved, motion.turned) = (S::Vector::default(), S::Spin::default());
            targets.push(pose);
        }
        targets
    }

    fn move_bodies(&mut self) {
        let Self { bodies, motions, awake, world, counts, flights, .. } = self;
        awake.retain(|&number| {
            let (body, motion) = (&mut bodies[number as usize], &mut motions[number as usize]);
            let (moved, turned) = flights.limit(body, number, motion.moved, motion.turned);
            let (center, turn) = (body.center + moved, S::turned_by(body.turn, turned));
            let travelled = center - body.start;
            match body.pose_at(center, turn) {
                Some(pose) if travelled.dot(travelled) < LEFT * LEFT => {
                    (body.center, body.turn) = (center, turn);
                    motion.offset = S::turned(turn, body.matter.center);
                    let _ = world.set_pose(body.key, pose);
                    true
                }
                _ => {
                    world.remove(body.key);
                    body.state = State::Left;
                    motion.rest();
                    counts.left += 1;
                    false
                }
            }
        });
    }

    fn send_to_sleep(&mut self) {
        let Self { bodies, motions, islands, awake, .. } = self;
        for &number in &*awake {
            let speed = bodies[number as usize].speed_squared(&motions[number as usize]);
            islands.note(number, speed, self.seconds);
        }
        for touch in self.touches.iter().filter(|touch| touch.separation < JOINED) {
            let [a, b] = touch.bodies;
            match touch.bodies.map(|number| bodies[number as usize].state) {
                [State::Awake, State::Awake] => islands.join(a, b),
                [State::Driven, State::Awake] if is_moving(&motions[a as usize]) => islands.disturb(b),
                [State::Awake, State::Driven] if is_moving(&motions[b as usize]) => islands.disturb(a),
                _ => {}
            }
        }
        let world = &mut self.world;
        islands.send_to_sleep(awake, |number| {
            let body = &mut bodies[number as usize];
            body.state = State::Asleep;
            motions[number as usize].rest();
            let _ = world.sleep(body.key);
        });
    }

    /// Brings the world's contacts up to date and counts what they say.
    pub fn update(&mut self) {
        self.look_ahead();
        self.world.update();
        self.note_hits();
        for event in self.world.events() {
            match event {
                Event::Began { .. } => self.counts.began += 1,
                Event::Ended { .. } => self.counts.ended += 1,
            }
            let (a, b) = event.bodies();
            let is_sensor =
                |key| self.numbers.get(key).is_some_and(|&number| self.bodies[number as usize].is_sensor);
            self.counts.sensed += usize::from(is_sensor(a) || is_sensor(b));
        }
        self.gather();
        // Whoever woke has contacts that nobody asked for before.
        if self.wake() {
            self.gather();
        }
        self.note_depths();
    }

    /// Tells the world of whatever will move so far that contacts must be there before it arrives.
    fn look_ahead(&mut self) {
        self.flights.clear();
        // What a bullet hits is known to where both are going.
        let everybody = self.awake.iter().any(|&number| self.bodies[number as usize].is_bullet);
        for &number in &self.awake {
            let (body, motion) = (&self.bodies[number as usize], &self.motions[number as usize]);
            let travel = body.speed_squared(motion).sqrt() * self.seconds;
            if travel < f64::from(MARGIN) + 0.05 * body.matter.reach && !(everybody && travel > 0.0) {
                continue;
            }
            let (moved, turned) = (motion.velocity * self.seconds, motion.spin * self.seconds);
            let Some(end) = body.pose_at(body.center + moved, S::turned_by(body.turn, turned)) else {
                continue;
            };
            let start = self.world.get(body.key).map(S::pose_of);
            if let Some(motion) = start.and_then(|start| S::motion(start, &end)) {
                let _ = self.world.set_motion(body.key, motion);
            }
            if body.is_bullet && travel > 0.5 * body.matter.reach {
                self.flights.push(number, moved, turned);
            }
        }
    }

    /// A bullet stops where it will hit something; the contact that is there by then does the rest.
    fn note_hits(&mut self) {
        for hit in self.world.impacts().iter().filter(|hit| !hit.sensor) {
            let (Some(&number), Some(&met)) = (self.numbers.get(hit.bullet), self.numbers.get(hit.other))
            else {
                continue;
            };
            // What it touches already is that contact's business.
            let contact = self.world.contact(hit.bullet, hit.other);
            let is_contact = contact.is_some_and(|contact| !contact.speculative);
            let other = &self.bodies[met as usize];
            // Two bullets both stop where they meet.
            let goes_on = !other.is_bullet || other.state == State::Driven;
            let along = if goes_on {
                self.motions[met as usize].velocity * self.seconds
            } else {
                S::Vector::default()
            };
            self.flights.note(number, (S::fraction(&hit.impact), along), is_contact);
        }
    }

    /// Collects the contact points that matter: of bodies that move.
    fn gather(&mut self) {
        self.touches.clear();
        let (bodies, motions) = (&self.bodies, &self.motions);
        for contact in self.world.contacts() {
            let (Some(&a), Some(&b)) = (self.numbers.get(contact.a), self.numbers.get(contact.b)) else {
                continue;
            };
            let [of_a, of_b] = [a, b].map(|number| &bodies[number as usize]);
            let is_wanted = match [of_a.state, of_b.state] {
                [State::Awake, _] | [_, State::Awake] => true,
                [State::Driven, State::Asleep] => is_moving(&motions[a as usize]),
                [State::Asleep, State::Driven] => is_moving(&motions[b as usize]),
                _ => false,
            };
            // Of bullets the world says more: what they hit, and when.
            let is_flying = contact.speculative && (of_a.is_bullet || of_b.is_bullet);
            if is_wanted && !is_flying {
                self.touches.extend(S::touches(contact, [a, b]));
            }
        }
    }

    /// Wakes the islands that something which moves touches, or will touch in the next step: to be hit while asleep
    /// is to be hit as a wall.
    fn wake(&mut self) -> bool {
        let Self { bodies, motions, islands, seconds, .. } = self;
        for touch in &self.touches {
            let [a, b] = touch.bodies.map(|number| &motions[number as usize]);
            let closing = approach(touch, [a, b]) * *seconds;
            if touch.separation - closing.max(0.0) > JOINED {
                continue;
            }
            let [a, b] = touch.bodies;
            match touch.bodies.map(|number| bodies[number as usize].state) {
                [State::Awake | State::Driven, State::Asleep] => islands.rouse(b),
                [State::Asleep, State::Awake | State::Driven] => islands.rouse(a),
                _ => {}
            }
        }
        islands.wake(&mut self.awake, |number| bodies[number as usize].state = State::Awake)
    }

    fn note_depths(&mut self) {
        let deepest = self.touches.iter().map(|touch| -touch.separation).fold(0.0, f64::max);
        let share = self.touches.iter().map(|touch| self.share_of(touch)).fold(0.0, f64::max);
        let counts = &mut self.counts;
        counts.deepest = counts.deepest.max(deepest);
        if f64::from(self.steps) * self.seconds > SETTLED {
            counts.deepest_settled = counts.deepest_settled.max(deepest);
            counts.deepest_share = counts.deepest_share.max(share);
        }
    }
}

fn is_moving<S: Physics>(motion: &Motion<S>) -> bool {
    motion.velocity != S::Vector::default() || motion.spin != S::Spin::default()
}
