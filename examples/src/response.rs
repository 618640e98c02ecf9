//! Push-apart response: contacts in, velocities and displacements out.
//!
//! Sequential impulses in short substeps with soft contacts (Catto, "Solver2D", 2024): a step is cut into
//! [`SUBSTEPS`]; each one pushes every contact point once with a spring that removes overlap, moves the bodies, and
//! pushes once more without the spring, so that removing overlap leaves no speed behind. Contacts are those of one
//! update; between substeps their separations are carried along by what the bodies moved.

use crate::physics::{Physics, Touch, TouchId};
use core::f64::consts::TAU;

const SUBSTEPS: usize = 4;
const FRICTION: f64 = 0.8;
/// Of the contact springs: a fraction of the substeps' own rate, well damped, so that nothing rings.
const SPRING_HERTZ: f64 = 30.0;
const SPRING_DAMPING: f64 = 10.0;
/// The fastest that overlap is removed, in m/s: a body that starts deep inside another is not shot out.
const PUSH_SPEED: f64 = 3.0;
/// Per second: what air and rolling resistance take of a spin.
const SPIN_DAMPING: f64 = 1.5;

/// What the response knows and changes of a body.
pub(crate) struct Motion<S: Physics> {
    pub(crate) velocity: S::Vector,
    pub(crate) spin: S::Spin,
    /// Zero for what no contact moves.
    pub(crate) inverse_mass: f64,
    /// During this step.
    pub(crate) moved: S::Vector,
    /// During this step.
    pub(crate) turned: S::Spin,
    inverse_inertia: S::Inertia,
}

/// What a contact point has pushed so far, kept from step to step as the first guess of the next.
pub(crate) struct Pushes<S: Physics> {
    apart: f64,
    aside: S::Vector,
}

struct Point<S: Physics> {
    a: usize,
    b: usize,
    arm_a: S::Vector,
    arm_b: S::Vector,
    normal: S::Vector,
    separation: f64,
    mass: f64,
    pushes: Pushes<S>,
}

/// A spring's coefficients over one substep.
struct Spring {
    /// Speed asked for per metre of overlap.
    rate: f64,
    mass_share: f64,
    push_share: f64,
}

impl<S: Physics> Motion<S> {
    pub(crate) fn new(velocity: S::Vector, spin: S::Spin, inverse_mass: f64) -> Self {
        let (moved, turned) = (S::Vector::default(), S::Spin::default());
        Self { velocity, spin, inverse_mass, moved, turned, inverse_inertia: S::IMMOVABLE }
    }

    pub(crate) fn start_step(&mut self, inverse_inertia: S::Inertia) {
        self.inverse_inertia = inverse_inertia;
        (self.moved, self.turned) = (S::Vector::default(), S::Spin::default());
    }

    fn push(&mut self, arm: S::Vector, push: S::Vector) {
        self.velocity += push * self.inverse_mass;
        self.spin += S::respond(&self.inverse_inertia, S::torque(arm, push));
    }

    fn velocity_at(&self, arm: S::Vector) -> S::Vector {
        self.velocity + S::sweep(self.spin, arm)
    }

    /// How much speed along a direction a unit push along it gives the end of an arm.
    fn yielding(&self, arm: S::Vector, direction: S::Vector) -> f64 {
        let spin = S::respond(&self.inverse_inertia, S::torque(arm, direction));
        self.inverse_mass + S::dot(direction, S::sweep(spin, arm))
    }
}

/// Moves bodies for one step under gravity and the given contact points, each with its two bodies' numbers and the
/// arms from their centres of mass. Returns the points' pushes, sorted, as the next step's first guess.
pub(crate) fn respond<'a, S: Physics>(
    touches: impl Iterator<Item = (&'a Touch<S>, (usize, S::Vector), (usize, S::Vector))>,
    motions: &mut [Motion<S>],
    last: &[(TouchId<S::Key>, Pushes<S>)],
    gravity: S::Vector,
    seconds: f64,
) -> Vec<(TouchId<S::Key>, Pushes<S>)> {
    let (mut ids, mut points) = (Vec::new(), Vec::new());
    for (touch, (a, arm_a), (b, arm_b)) in touches {
        ids.push(touch.id);
        let yielding = motions[a].yielding(arm_a, touch.normal) + motions[b].yielding(arm_b, touch.normal);
        let mass = if yielding > 0.0 { 1.0 / yielding } else { 0.0 };
        let pushes = first_guess(last, &touch.id, touch.normal);
        let (normal, separation) = (touch.normal, touch.separation);
        points.push(Point { a, b, arm_a, arm_b, normal, separation, mass, pushes });
    }
    let substep = seconds / SUBSTEPS as f64;
    let spring = Spring::new(substep);
    let spin_kept = 1.0 / (1.0 + substep * SPIN_DAMPING);
    for _ in 0..SUBSTEPS {
        for motion in motions.iter_mut().filter(|motion| motion.inverse_mass > 0.0) {
            motion.velocity += gravity * substep;
            motion.spin = motion.spin * spin_kept;
        }
        points.iter().for_each(|point| point.repeat(motions));
        points.iter_mut().for_each(|point| point.push(motions, substep, Some(&spring)));
        for motion in motions.iter_mut() {
            motion.moved += motion.velocity * substep;
            motion.turned += motion.spin * substep;
        }
        points.iter_mut().for_each(|point| point.push(motions, substep, None));
    }
    let mut pushes: Vec<_> = ids.into_iter().zip(points.into_iter().map(|point| point.pushes)).collect();
    pushes.sort_by_key(|(id, _)| *id);
    pushes
}

/// A point that was there last step pushes as it did then; sideways only as far as the new normal agrees.
fn first_guess<S: Physics>(
    last: &[(TouchId<S::Key>, Pushes<S>)],
    id: &TouchId<S::Key>,
    normal: S::Vector,
) -> Pushes<S> {
    match last.binary_search_by_key(id, |(id, _)| *id) {
        Ok(index) => {
            let Pushes { apart, aside } = last[index].1;
            Pushes { apart, aside: aside - normal * S::dot(aside, normal) }
        }
        Err(_) => Pushes { apart: 0.0, aside: S::Vector::default() },
    }
}

impl Spring {
    fn new(substep: f64) -> Self {
        let omega = TAU * SPRING_HERTZ;
        let (damping, stiffness) = (2.0 * SPRING_DAMPING + substep * omega, substep * omega);
        let softness = 1.0 / (1.0 + stiffness * damping);
        Self { rate: omega / damping, mass_share: stiffness * damping * softness, push_share: softness }
    }
}

impl<S: Physics> Point<S> {
    fn repeat(&self, motions: &mut [Motion<S>]) {
        self.apply(motions, self.normal * self.pushes.apart + self.pushes.aside);
    }

    fn apply(&self, motions: &mut [Motion<S>], push: S::Vector) {
        motions[self.a].push(self.arm_a, push * -1.0);
        motions[self.b].push(self.arm_b, push);
    }

    fn push(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>) {
        self.push_apart(motions, substep, spring);
        self.push_aside(motions);
    }

    fn push_apart(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>) {
        let (a, b) = (&motions[self.a], &motions[self.b]);
        let carried = b.moved + S::sweep(b.turned, self.arm_b) - a.moved - S::sweep(a.turned, self.arm_a);
        let separation = self.separation + S::dot(carried, self.normal);
        let speed = S::dot(b.velocity_at(self.arm_b) - a.velocity_at(self.arm_a), self.normal);
        let push = match spring {
            // In a gap: allow as much speed as closes it.
            _ if separation > 0.0 => -self.mass * (speed + separation / substep),
            Some(spring) => {
                let wanted = (spring.rate * separation).max(-PUSH_SPEED);
                -self.mass * spring.mass_share * (speed + wanted) - spring.push_share * self.pushes.apart
            }
            None => -self.mass * speed,
        };
        let apart = (self.pushes.apart + push).max(0.0);
        self.apply(motions, self.normal * (apart - self.pushes.apart));
        self.pushes.apart = apart;
    }

    /// Friction: stops sliding, with at most a share of what pushes apart.
    fn push_aside(&mut self, motions: &mut [Motion<S>]) {
        let (a, b) = (&motions[self.a], &motions[self.b]);
        let velocity = b.velocity_at(self.arm_b) - a.velocity_at(self.arm_a);
        let slide = velocity - self.normal * S::dot(velocity, self.normal);
        let speed = S::dot(slide, slide).sqrt();
        let mut aside = self.pushes.aside;
        if speed > 1e-12 {
            let direction = slide * (1.0 / speed);
            let yielding = a.yielding(self.arm_a, direction) + b.yielding(self.arm_b, direction);
            if yielding > 0.0 {
                aside -= direction * (speed / yielding);
            }
        }
        let (most, size) = (FRICTION * self.pushes.apart, S::dot(aside, aside).sqrt());
        if size > most {
            aside = aside * (most / size);
        }
        self.apply(motions, aside - self.pushes.aside);
        self.pushes.aside = aside;
    }
}
