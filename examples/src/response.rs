//! Push-apart response: contacts in, velocities and displacements out.
//!
//! Sequential impulses in short substeps with soft contacts (Catto, "Solver2D", 2024; "soft step" there, and the
//! solver of Box2D 3): a step is cut into [`SUBSTEPS`]; each one pushes every contact point once with a spring that
//! removes overlap, moves the bodies, and pushes once more without the spring, so that removing overlap leaves no
//! speed behind. Contacts are those of one update; between substeps their separations are carried along by what the
//! bodies moved. At the end, what came fast enough is given the share of its speed that bounces back.

use crate::physics::{Physics, Touch, TouchId};
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

/// What a contact point has pushed so far, kept from step to step as the first guess of the next.
struct Pushes<S: Physics> {
    apart: f64,
    aside: S::Vector,
}

struct Point<S: Physics> {
    id: TouchId<S::Key>,
    a: usize,
    b: usize,
    arm_a: S::Vector,
    arm_b: S::Vector,
    normal: S::Vector,
    separation: f64,
    mass: f64,
    pushes: Pushes<S>,
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
    pub(crate) fn new(velocity: S::Vector, spin: S::Spin) -> Self {
        let (nowhere, still) = (S::Vector::default(), S::Spin::default());
        Self {
            velocity,
            spin,
            inverse_mass: 0.0,
            inverse_inertia: S::IMMOVABLE,
            offset: nowhere,
            moved: nowhere,
            turned: still,
        }
    }

    /// Holds the body where it is, whatever pushes it.
    pub(crate) fn rest(&mut self) {
        let offset = self.offset;
        *self = Self::new(S::Vector::default(), S::Spin::default());
        self.offset = offset;
    }

    #[inline]
    fn push(&mut self, arm: S::Vector, push: S::Vector) {
        self.velocity += push * self.inverse_mass;
        self.spin += S::respond(&self.inverse_inertia, S::torque(arm, push));
    }

    #[inline]
    fn velocity_at(&self, arm: S::Vector) -> S::Vector {
        self.velocity + S::sweep(self.spin, arm)
    }

    /// How much speed along a direction a unit push along it gives the end of an arm.
    #[inline]
    fn yielding(&self, arm: S::Vector, direction: S::Vector) -> f64 {
        let spin = S::respond(&self.inverse_inertia, S::torque(arm, direction));
        self.inverse_mass + S::dot(direction, S::sweep(spin, arm))
    }
}

/// How fast two bodies come together at a contact point, in m/s; negative where they part.
pub(crate) fn approach<S: Physics>(touch: &Touch<S>, [a, b]: [&Motion<S>; 2]) -> f64 {
    let (at_a, at_b) = (a.velocity_at(touch.anchor_a - a.offset), b.velocity_at(touch.anchor_b - b.offset));
    S::dot(at_a - at_b, touch.normal)
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
            let (a, b) = (touch.bodies[0] as usize, touch.bodies[1] as usize);
            while self.last.get(start).is_some_and(|last| last.id.keys < touch.id.keys) {
                start += 1;
            }
            let of_pair = self.last[start..].iter().take_while(|last| last.id.keys == touch.id.keys);
            let mut point = Point::new(touch, [&motions[a], &motions[b]]);
            if let Some(last) = of_pair.into_iter().find(|last| last.id == touch.id) {
                // It pushes as it did; sideways only as far as the new normal agrees.
                let Pushes { apart, aside } = last.pushes;
                point.pushes = Pushes { apart, aside: aside - point.normal * S::dot(aside, point.normal) };
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
    fn new(touch: &Touch<S>, [a, b]: [&Motion<S>; 2]) -> Self {
        let (arm_a, arm_b, normal) = (touch.anchor_a - a.offset, touch.anchor_b - b.offset, touch.normal);
        let yielding = a.yielding(arm_a, normal) + b.yielding(arm_b, normal);
        let mass = if yielding > 0.0 { 1.0 / yielding } else { 0.0 };
        Self {
            id: touch.id,
            a: touch.bodies[0] as usize,
            b: touch.bodies[1] as usize,
            arm_a,
            arm_b,
            normal,
            separation: touch.separation,
            mass,
            pushes: Pushes { apart: 0.0, aside: S::Vector::default() },
            speed_before: -approach(touch, [a, b]),
            hardest: 0.0,
        }
    }

    fn repeat(&self, motions: &mut [Motion<S>]) {
        self.apply(motions, self.normal * self.pushes.apart + self.pushes.aside);
    }

    #[inline]
    fn apply(&self, motions: &mut [Motion<S>], push: S::Vector) {
        motions[self.a].push(self.arm_a, push * -1.0);
        motions[self.b].push(self.arm_b, push);
    }

    /// The velocity of B's point, as seen from A's.
    #[inline]
    fn drift(&self, motions: &[Motion<S>]) -> S::Vector {
        motions[self.b].velocity_at(self.arm_b) - motions[self.a].velocity_at(self.arm_a)
    }

    /// Friction first, as in Box2D 2.4: what keeps bodies apart has the last word. (The other way round, a pyramid with
    /// a base of 60 settles 7 mm off its middle along its rows, and not 1.)
    fn push(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>, friction: f64) {
        self.push_aside(motions, friction);
        self.push_apart(motions, substep, spring);
    }

    fn push_apart(&mut self, motions: &mut [Motion<S>], substep: f64, spring: Option<&Spring>) {
        let (a, b) = (&motions[self.a], &motions[self.b]);
        let carried = b.moved + S::sweep(b.turned, self.arm_b) - a.moved - S::sweep(a.turned, self.arm_a);
        let separation = self.separation + S::dot(carried, self.normal);
        let speed = S::dot(self.drift(motions), self.normal);
        let push = match spring {
            // In a gap: allow as much speed as closes it.
            _ if separation > 0.0 => -self.mass * (speed + separation / substep),
            Some(spring) => {
                let wanted = (spring.rate * separation).max(-PUSH_SPEED);
                -self.mass * spring.mass_share * (speed + wanted) - spring.push_share * self.pushes.apart
            }
            None => -self.mass * speed,
        };
        self.set_apart(motions, self.pushes.apart + push);
    }

    #[inline]
    fn set_apart(&mut self, motions: &mut [Motion<S>], wanted: f64) {
        let apart = wanted.max(0.0);
        self.apply(motions, self.normal * (apart - self.pushes.apart));
        self.pushes.apart = apart;
        self.hardest = self.hardest.max(apart);
    }

    /// Friction: stops sliding, with at most a share of what pushes apart.
    fn push_aside(&mut self, motions: &mut [Motion<S>], friction: f64) {
        let most = friction * self.pushes.apart;
        if most == 0.0 && self.pushes.aside == S::Vector::default() {
            return;
        }
        let velocity = self.drift(motions);
        let slide = velocity - self.normal * S::dot(velocity, self.normal);
        let speed = S::dot(slide, slide).sqrt();
        let mut aside = self.pushes.aside;
        if speed > 1e-12 {
            let direction = slide * (1.0 / speed);
            let (a, b) = (&motions[self.a], &motions[self.b]);
            let yielding = a.yielding(self.arm_a, direction) + b.yielding(self.arm_b, direction);
            if yielding > 0.0 {
                aside -= direction * (speed / yielding);
            }
        }
        let size = S::dot(aside, aside).sqrt();
        if size > most {
            aside = aside * (most / size);
        }
        self.apply(motions, aside - self.pushes.aside);
        self.pushes.aside = aside;
    }

    /// Gives back a share of the speed that both came with, where they did meet.
    fn bounce(&mut self, motions: &mut [Motion<S>], restitution: f64) {
        if self.speed_before > -BOUNCE_SPEED || self.hardest == 0.0 {
            return;
        }
        let speed = S::dot(self.drift(motions), self.normal);
        let push = -self.mass * (speed + restitution * self.speed_before);
        self.set_apart(motions, self.pushes.apart + push);
    }
}
