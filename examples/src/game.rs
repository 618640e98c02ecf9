//! A game on the stepper: bodies that follow paths, bodies that leave the level, bullets, and counts of all of these.

mod flights;
mod tally;

use crate::playable::Playable;
use crate::stepper::{MARGIN, Point, Stepper};
use asunder::glam::{DQuat, DVec3};
use asunder::{AnyWorld, Collider, Event};
use flights::Flights;

/// Makes this thread one of rayon's global pool, so that it shares the work of updates (see the guide's page on game
/// loops). Does nothing if there is a pool already.
///
/// ```
/// asunder_examples::game::share_work();
/// asunder_examples::game::share_work();
/// assert!(rayon::current_thread_index() == Some(0), "this thread is one of the pool");
/// ```
pub fn share_work() {
    let _ = rayon::ThreadPoolBuilder::new().use_current_thread().build_global();
}

/// A body this far from where it started, in metres, has left the level.
const LEFT: f64 = 1000.0;

/// After this many seconds a scene is taken to have settled.
const SETTLED: f64 = 2.0;

/// The bodies of a stepper, by the same numbers, and what a game adds to them.
pub struct Game<S: Playable> {
    /// What moves the bodies.
    pub stepper: Stepper<S>,
    /// What has happened so far.
    pub counts: Counts,
    /// Whether bodies that are at rest fall asleep.
    pub sleeps: bool,
    actors: Vec<Actor>,
    /// The numbers of driven bodies, in the order in which they were driven, and their paths.
    driven: Vec<usize>,
    paths: Vec<Path<S>>,
    flights: Flights,
    steps: u32,
    /// The length of the last step, used as an estimate of the next.
    seconds: f64,
}

/// The pose of a driven body as a function of the frame.
type Path<S> = Box<dyn Fn(u32) -> <S as asunder::Space>::Pose + Send>;

/// What the game knows of a body beyond the stepper.
struct Actor {
    start: DVec3,
    /// The edge of the cube (in the plane, square) of the same mass, in metres; infinite for a body without mass.
    size: f64,
    is_bullet: bool,
    is_sensor: bool,
    is_driven: bool,
}

/// What has happened since the start.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    /// Contacts that began.
    pub began: usize,
    /// Contacts that ended.
    pub ended: usize,
    /// Those of them in which a sensor took part.
    pub sensed: usize,
    /// Bodies that have left the level.
    pub left: usize,
    /// The deepest overlap in any step, in metres.
    pub deepest: f64,
    /// The deepest overlap in any step after the first two seconds, in metres.
    pub deepest_settled: f64,
    /// The same as a share of the smaller body's size: the edge of the cube, or square, of the same mass.
    pub deepest_share: f64,
}

/// The error of a moving shape without mass: it has no volume or no end, or is so thin that its mass rounds to zero.
#[derive(Debug)]
pub struct NoMass;

impl std::error::Error for NoMass {}

impl std::fmt::Display for NoMass {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the shape has no mass to move: make it thicker, or the body fixed")
    }
}

/// The places of all bodies at one time, to measure later how far they have moved.
pub struct Places(Vec<(DVec3, DQuat)>);

impl<S: Playable> Game<S> {
    /// An empty game, with gravity in m/s^2.
    pub fn new(gravity: DVec3) -> Self {
        Self {
            stepper: Stepper::new(gravity),
            counts: Counts::default(),
            sleeps: true,
            actors: Vec::new(),
            driven: Vec::new(),
            paths: Vec::new(),
            flights: Flights::default(),
            steps: 0,
            seconds: 1.0 / 60.0,
        }
    }

    /// Adds a body, with speeds in m/s and rad/s, and returns its number.
    ///
    /// # Errors
    /// A shape without mass.
    pub fn add(&mut self, collider: Collider<S>, velocity: DVec3, spin: DVec3) -> Result<usize, NoMass> {
        let (is_bullet, is_sensor) = (collider.is_bullet(), collider.is_sensor());
        let number = self.stepper.add(collider, velocity, spin).ok_or(NoMass)?;
        let body = &self.stepper.bodies()[number];
        let (start, size) = (body.center, S::size(1.0 / body.mass.inverse));
        self.actors.push(Actor { start, size, is_bullet, is_sensor, is_driven: false });
        Ok(number)
    }

    /// Drives a body from now on: after n steps it is where `path(n)` says, whatever is in its way. It pushes and
    /// carries others with the speed of that motion. Does nothing if there is no such body.
    pub fn drive(&mut self, number: usize, path: impl Fn(u32) -> S::Pose + Send + 'static) {
        let Some(actor) = self.actors.get_mut(number) else { return };
        actor.is_driven = true;
        self.stepper.drive(number);
        self.driven.push(number);
        self.paths.push(Box::new(path));
    }

    /// One step of the stepper, with the game's own work in between.
    pub fn step(&mut self, seconds: f64) {
        self.seconds = seconds;
        self.steps += 1;
        let targets = self.aim();
        self.stepper.solve(seconds);
        self.shorten_flights();
        self.take_out_far();
        self.stepper.advance();
        for (&number, pose) in self.driven.iter().zip(targets) {
            self.stepper.place(number, pose);
        }
        if self.sleeps {
            self.stepper.settle();
        }
        self.update();
    }

    /// Updates the world's contacts, and counts events and overlaps.
    pub fn update(&mut self) {
        self.look_ahead();
        self.stepper.update();
        self.note_hits();
        self.count_events();
        self.note_depths();
    }

    /// Gives driven bodies the velocities that take them to their next poses.
    fn aim(&mut self) -> Vec<S::Pose> {
        let rate = 1.0 / self.seconds;
        let targets: Vec<S::Pose> = self.paths.iter().map(|path| path(self.steps)).collect();
        for (&number, pose) in self.driven.iter().zip(&targets) {
            let (body, (position, turn)) = (&mut self.stepper.bodies_mut()[number], S::place(pose));
            body.velocity = (position - body.center) * rate;
            body.spin = spin_between(body.turn, turn) * rate;
        }
        targets
    }

    fn shorten_flights(&mut self) {
        for flight in self.flights.iter() {
            let body = &mut self.stepper.bodies_mut()[flight.number];
            (body.moved, body.turned) = flight.limited(body);
        }
    }

    /// Removes the bodies that would be out of the level after this step.
    fn take_out_far(&mut self) {
        let is_far = |&number: &usize| {
            let body = &self.stepper.bodies()[number];
            let travelled = (body.center + body.moved - self.actors[number].start).length_squared();
            travelled >= LEFT * LEFT || travelled.is_nan()
        };
        let far: Vec<usize> = self.stepper.awake().iter().copied().filter(is_far).collect();
        self.counts.left += far.len();
        far.into_iter().for_each(|number| self.stepper.remove(number));
    }

    /// Sets the motions of bodies that will move so far that contacts must exist before they arrive.
    fn look_ahead(&mut self) {
        let Self { stepper, actors, flights, seconds, .. } = self;
        flights.clear();
        // The impacts of a bullet follow from the motions of both bodies: with a bullet about, all that moves needs
        // one.
        let everybody = stepper.awake().iter().any(|&number| actors[number].is_bullet);
        for number in stepper.awake().to_vec() {
            let body = &stepper.bodies()[number];
            let travel = body.speed_squared().sqrt() * *seconds;
            if travel < f64::from(MARGIN) + 0.05 * body.mass.reach && !(everybody && travel > 0.0) {
                continue;
            }
            let (moved, turned) = (body.velocity * *seconds, body.spin * *seconds);
            let Some(end) = body.pose::<S>(body.after(moved, turned)) else { continue };
            let key = body.key.into();
            if actors[number].is_bullet && travel > 0.5 * body.mass.reach {
                flights.push(number, moved, turned);
            }
            let start = stepper.world.get(key).map(S::pose_of);
            if let Some(motion) = start.and_then(|start| S::motion(start, &end)) {
                // A stale key is a body that has left the level.
                let _ = stepper.world.set_motion(key, motion);
            }
        }
    }

    /// Lets a bullet stop at its first impact; the contact that exists once it is there does the rest.
    fn note_hits(&mut self) {
        let (stepper, actors) = (&self.stepper, &self.actors);
        for hit in stepper.world.impacts().iter().filter(|hit| !hit.sensor) {
            let numbers = (stepper.number(hit.bullet), stepper.number(hit.other));
            let (Some(number), Some(met)) = numbers else { continue };
            // If they touch already, that contact decides, not the impact.
            let contact = stepper.world.contact(hit.bullet, hit.other);
            let is_contact = contact.is_some_and(|contact| !contact.speculative);
            // Two bullets both stop where they meet; anything else goes on.
            let goes_on = !actors[met].is_bullet || actors[met].is_driven;
            let speed = if goes_on { stepper.bodies()[met].velocity } else { DVec3::ZERO };
            self.flights.note(number, (S::fraction(&hit.impact), speed * self.seconds), is_contact);
        }
    }

    fn count_events(&mut self) {
        for event in self.stepper.world.events() {
            match event {
                Event::Began { .. } => self.counts.began += 1,
                Event::Ended { .. } => self.counts.ended += 1,
            }
            let is_sensor =
                |key| self.stepper.number(key).is_some_and(|number| self.actors[number].is_sensor);
            let (a, b) = event.bodies();
            self.counts.sensed += usize::from(is_sensor(a) || is_sensor(b));
        }
    }

    fn note_depths(&mut self) {
        let points = self.stepper.points();
        let deepest = points.iter().map(|point| -point.separation).fold(0.0, f64::max);
        let share = points.iter().map(|point| self.share_of(point)).fold(0.0, f64::max);
        let counts = &mut self.counts;
        counts.deepest = counts.deepest.max(deepest);
        if f64::from(self.steps) * self.seconds > SETTLED {
            counts.deepest_settled = counts.deepest_settled.max(deepest);
            counts.deepest_share = counts.deepest_share.max(share);
        }
    }

    /// The depth of a point as a share of the smaller body's size.
    fn share_of(&self, point: &Point) -> f64 {
        let [a, b] = point.bodies.map(|number| self.actors[number].size);
        -point.separation / a.min(b)
    }
}

/// The rotation vector that turns one rotation into another one near it.
fn spin_between(from: DQuat, to: DQuat) -> DVec3 {
    let by = to * from.conjugate();
    // The shorter way round. Over a step the angle is small, and nearly equal to its sine.
    let (half, w) = if by.w < 0.0 { (-by.xyz(), -by.w) } else { (by.xyz(), by.w) };
    let sine = half.length();
    if sine > 0.0 { half * (2.0 * libm::atan2(sine, w) / sine) } else { DVec3::ZERO }
}
