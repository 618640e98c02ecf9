//! Push-apart response: contacts in, velocities and displacements out.
//!
//! Sequential impulses in short substeps with soft contacts (Catto, "Solver2D", 2024; "soft step" there, and the
//! solver of Box2D 3): a step is cut into substeps; each one pushes every contact point once with a spring that
//! removes overlap, moves the bodies, and pushes once more without the spring, so that removing overlap leaves no
//! speed behind. Contacts are those of one update; between substeps their separations are carried along by what the
//! bodies moved. At the end, what came fast enough is given the share of its speed that bounces back.

use crate::physics::{Linear, Physics, Touch, TouchId};
use asunder_scenes::stages::Feel;
use core::f64::consts::TAU;

/// Of the contact springs, as a share of the substeps' own rate. A stack at rest sinks in by its weight over the
/// springs' stiffness, which grows with the square of this and of the number of substeps. (Tried 0.25: the lowest rows
/// of a pyramid a hundred boxes high rattle for ever. More substeps, and not stiffer springs, hold it still.)
const SPRING_SHARE: f64 = 0.125;
/// (Tried 10, as Box2D has it: stacks of 20 boxes bounce for seconds. Tried to push without springs from the last point
/// to the first: towers of boxes sway.)
const SPRING_DAMPING: f64 = 5.0;
/// The fastest that overlap is removed, in m/s: a body that starts deep inside another is not shot out.
const PUSH_SPEED: f64 = 3.0;
/// What comes slower than this, in m/s, does not bounce, or nothing would ever come to rest.
const BOUNCE_SPEED: f64 = 1.0;

/// What the response knows and changes of a body.
pub(crate) struct Motion<S: Physics> {
    pub(crate) velocity: S::Vector,
    pub(crate) spin: S::Spin,
    /// Zero for what no contact moves.
    pub(crate) inverse_mass: f64,
    pub(crate) inverse_inertia: S::Inertia,
    /// From the body's position to its centre of mass, in world axes.
    pub(crate) offset: S::Vector,
    /// During this step.
    pub(crate) moved: S::Vector,
    /// During this step.
    pub(crate) turned: S::Spin,
}

struct Point<S: Physics> {
    id: TouchId<S::Key>,
    bodies: [usize; 2],
    /// From their centres of mass.
    arms: [S::Vector; 2],
    normal: S::Vector,
    separation: f64,
    /// Of both bodies, as a push along the normal feels it; zero where it moves neither.
    mass: f64,
    /// What it has pushed so far, kept from step to step as the first guess of the next.
    apart: f64,
    aside: S::Vector,
    /// How fast both came together before the step, in m/s, and the hardest push of any substep.
    speed_before: f64,
    hardest: f64,
}

/// A spring's coefficients over one substep.
struct Spring {
    /// Speed asked for per metre of overlap.
    rate: f64,
    mass_share: f64,
    push_share: f64,
}

/// The contact points of this step and the last, in the world's order of pairs.
pub(crate) struct Response<S: Physics> {
    points: Vec<Point<S>>,
    last: Vec<Point<S>>,
}

/// What acts on all bodies.
pub(crate) struct Forces<S: Physics> {
    pub(crate) gravity: S::Vector,
    pub(crate) feel: Feel,
    pub(crate) seconds: f64,
}

impl<S: Physics> Motion<S> {
    pub(crate) fn new(velocity: S::Vector, spin: S::Spin, offset: S::Vector) -> Self {
        let (moved, turned) = (S::Vector::default(), S::Spin::default());
        Self { velocity, spin, inverse_mass: 0.0, inverse_inertia: S::IMMOVABLE, offset, moved, turned }
    }

    /// Holds the body where it is, whatever pushes it.
    pub(crate) fn rest(&mut self) {
        *self = Self::new(S::Vector::default(), S::Spin::default(), self.offset);
    }

    #[inline]
    fn push(&mut self, arm: S::Vector, push: S::Vector) {
        self.velocity += push * self.inverse_mass;
        self.spin += self.inverse_inertia * S::torque(arm, push);
    }

    #[inline]
    fn velocity_at(&self, arm: S::Vector) -> S::Vector {
        self.velocity + S::sweep(self.spin, arm)
    }

    /// How much speed along a direction a unit push along it gives the end of an arm.
    #[inline]
    fn yielding(&self, arm: S::Vector, direction: S::Vector) -> f64 {
        let spin = self.inverse_inertia * S::torque(arm, direction);
        self.inverse_mass + direction.dot(S::sweep(spin, arm))
    }
}

/// How fast two bodies come together at a contact point, in m/s; negative where they part.
pub(crate) fn approach<S: Physics>(touch: &Touch<S>, [a, b]: [&Motion<S>; 2]) -> f64 {
    let [anchor_a, anchor_b] = touch.anchors;
    (a.velocity_at(anchor_a - a.offset) - b.velocity_at(anchor_b - b.offset)).dot(touch.normal)
}

impl<S: Physics> Response<S> {
    pub(crate) const NONE: Self = Self { points: Vec::new(), last: Vec::new() };

    /// Moves bodies for one step under gravity and contact points. `free` are the numbers of those that pushes move,
    /// `driven` of those that go their own way.
    pub(crate) fn respond(
        &mut self,
        touches: &[Touch<S>],
        motions: &mut [Motion<S>],
        [free, driven]: [&[u32]; 2],
        forces: &Forces<S>,
    ) {
        self.prepare(touches, motions);
        let substep = forces.seconds / f64::from(forces.feel.substeps.max(1));
        let (spring, friction) = (Spring::new(substep), forces.feel.friction);
        let spin_kept = 1.0 / (1.0 + substep * forces.feel.spin_damping);
        let points = &mut self.points;
        for _ in 0..forces.feel.substeps.max(1) {
            for &body in free {
                let motion = &mut motions[body as usize];
                motion.velocity += forces.gravity * substep;
                motion.spin = motion.spin * spin_kept;
            }
            points.iter().for_each(|point| point.repeat(motions));
            points.iter_mut().for_each(|point| point.push(motions, substep, Some(&spring), friction));
            for &body in free.iter().chain(driven) {
                let motion = &mut motions[body as usize];
                motion.moved += motion.velocity * substep;
                motion.turned += motion.spin * substep;
            }
            points.iter_mut().for_each(|point| point.push(motions, substep, None, friction));
        }
        if forces.feel.restitution > 0.0 {
            points.iter_mut().for_each(|point| point.bounce(motions, forces.feel.restitution));
        }
    }

    /// Both lists are in the world's order of pairs, so what each pair pushed last is found by walking along.
    fn prepare(&mut self, touches: &[Touch<S>], motions: &[Motion<S>]) {
        core::mem::swap(&mut self.points, &mut self.last);
        self.points.clear();
        let mut start = 0;
        for touch in touches {
            while self.last.get(start).is_some_and(|last| last.id.keys < touch.id.keys) {
                start += 1;
            }
            let of_pair = self.last[start..].iter().take_while(|last| last.id.keys == touch.id.keys);
            let mut point = Point::new(touch, motions);
            if let Some(last) = of_pair.into_iter().find(|last| last.id == touch.id) {
                // It pushes as it did; sideways only as far as the new normal agrees.
                point.apart = last.apart;
                point.aside = last.aside - point.normal * last.aside.dot(point.normal);
            }
            self.points.push(point);
        }
    }
}

impl Spring {
    fn new(substep: f64) -> Self {
        let omega = TAU * SPRING_SHARE / substep;
        let (damping, stiffness) = (2.0 * SPRING_DAMPING + substep * omega, substep * omega);
        let softness = 1.0 / (1.0 + stiffness * damping);
        Self { rate: omega / damping, mass_share: stiffness * damping * softness, push_share: softness }
    }
}

impl<S: Physics> Point<S> {
    fn new(touch: &Touch<S>, motions: &[Motion<S>]) -> Self {
        let Touch { id, normal, separation, .. } = *touch;
        let bodies = touch.bodies.map(|body| body as usize);
        let [a, b] = bodies.map(|body| &motions[body]);
        let arms = [touch.anchors[0] - a.offset, touch.anchors[1] - b.offset];
        let yielding = a.yielding(arms[0], normal) + b.yielding(arms[1], normal);
        let mass = if yielding > 0.0 { 1.0 / yielding } else { 0.0 };
        let speed_before = -approach(touch, [a, b]);
        let (apart, aside, hardest) = (0.0, S::Vector::default(), 0.0);
        Self { id, bodies, arms, normal, separation, mass, apart, aside, speed_before, hardest }
    }

    fn repeat(&self, motions: &mut [Motion<S>]) {
        self.apply(motions, self.normal * self.apart + self.aside);
    }

    #[inline]
    fn apply(&self, motions: &mut [Motion<S>], push: S::Vector) {
        let ([a, b], [arm_a, arm_b]) = (self.bodies, self.arms);
        motions[a].push(arm_a, push * -1.0);
        motions[b].push(arm_b, push);
    }

    /// The velocity of B's point, as seen from A's.
    #[inline]
    fn drift(&self, motions: &[Motion<S>]) -> S::Vector {
        let [a, b] = self.bodies.map(|body| &motions[body]);
        b.velocity_at(self.arms[1]) - a.velocity_at(self.arms[0])
    }

    /// Friction first, as in Box2D 2.4: what keeps bodies apart has the last word. (The other way round, a pyramid with
    /// a base of 60 settles 7 mm off its middle along its rows, and not 1.)
    fn push(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>, friction: f64) {
        self.push_aside(motions, friction);
        self.push_apart(motions, substep, spring);
    }

    fn push_apart(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>) {
        let ([a, b], [arm_a, arm_b]) = (self.bodies.map(|body| &motions[body]), self.arms);
        let carried = b.moved + S::sweep(b.turned, arm_b) - a.moved - S::sweep(a.turned, arm_a);
        let separation = self.separation + carried.dot(self.normal);
        let speed = self.drift(motions).dot(self.normal);
        let push = match spring {
            // In a gap: allow as much speed as closes it.
            _ if separation > 0.0 => -self.mass * (speed + separation / substep),
            Some(spring) => {
                let wanted = (spring.rate * separation).max(-PUSH_SPEED);
                -self.mass * spring.mass_share * (speed + wanted) - spring.push_share * self.apart
            }
            None => -self.mass * speed,
        };
        self.set_apart(motions, self.apart + push);
    }

    #[inline]
    fn set_apart(&mut self, motions: &mut [Motion<S>], wanted: f64) {
        let apart = wanted.max(0.0);
        self.apply(motions, self.normal * (apart - self.apart));
        self.apart = apart;
        self.hardest = self.hardest.max(apart);
    }

    /// Friction: stops sliding, with at most a share of what pushes apart.
    fn push_aside(&mut self, motions: &mut [Motion<S>], friction: f64) {
        let most = friction * self.apart;
        if most == 0.0 && self.aside == S::Vector::default() {
            return;
        }
        let velocity = self.drift(motions);
        let slide = velocity - self.normal * velocity.dot(self.normal);
        let speed = slide.length();
        let mut aside = self.aside;
        if speed > 1e-12 {
            let direction = slide * (1.0 / speed);
            let [a, b] = self.bodies.map(|body| &motions[body]);
            let yielding = a.yielding(self.arms[0], direction) + b.yielding(self.arms[1], direction);
            if yielding > 0.0 {
                aside -= direction * (speed / yielding);
            }
        }
        let size = aside.length();
        if size > most {
            aside = aside * (most / size);
        }
        self.apply(motions, aside - self.aside);
        self.aside = aside;
    }

    /// Gives back a share of the speed that both came with, where they did meet.
    fn bounce(&mut self, motions: &mut [Motion<S>], restitution: f64) {
        if self.speed_before > -BOUNCE_SPEED || self.hardest == 0.0 {
            return;
        }
        let speed = self.drift(motions).dot(self.normal);
        let push = -self.mass * (speed + restitution * self.speed_before);
        self.set_apart(motions, self.apart + push);
    }
}
