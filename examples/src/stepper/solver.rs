//! The contact solver: impulses at contact points change the velocities of bodies.
//!
//! Sequential impulses in short substeps with soft contacts (Catto, "Solver2D", 2024, where it is called "soft step";
//! the solver of Box2D 3). Each substep
//! - pushes every contact point once with a spring that removes overlap,
//! - moves the bodies,
//! - pushes once more without the spring, so that the removal of overlap leaves no velocity behind.
//!
//! The contacts are those of one update; in the substeps their separations are advanced by the motions of the bodies.
//! At the end, restitution gives back a share of the approach speed where that was high enough.

use super::body::Body;
use asunder::glam::DVec3;
use asunder::slotmap::KeyData;
use core::f64::consts::TAU;

/// Frequency of the contact springs, as a share of the substep rate. A stack at rest sinks in by its weight over the
/// springs' stiffness, which grows with the square of this and of the number of substeps. (Tried 0.25: the lowest rows
/// of a pyramid a hundred boxes high rattle for ever. More substeps, and not stiffer springs, hold it still.)
const SPRING_SHARE: f64 = 0.125;
/// Damping ratio of the contact springs. (Tried 10, as in Box2D: stacks of 20 boxes bounce for seconds. Tried to push
/// without springs from the last point to the first: towers of boxes sway.)
const SPRING_DAMPING: f64 = 5.0;
/// The greatest speed at which overlap is removed, in m/s: a body that starts deep inside another is not shot out.
const PUSH_SPEED: f64 = 3.0;
/// Contacts that close slower than this, in m/s, do not bounce, or nothing would ever come to rest.
const BOUNCE_SPEED: f64 = 1.0;

/// A contact point of two bodies, and the impulses at it.
#[derive(Clone, Debug, Default)]
pub struct Point {
    /// The keys of both bodies in the world, in its order.
    pub(super) keys: [KeyData; 2],
    /// The numbers of both bodies, in the same order.
    pub bodies: [usize; 2],
    /// What identifies the point from frame to frame: the parts of both bodies, and the bits of its feature id.
    pub feature: (u32, u32, u64),
    /// From the first body to the second.
    pub normal: DVec3,
    /// In metres; negative where they overlap.
    pub separation: f64,
    /// From the centres of mass to the point.
    pub arms: [DVec3; 2],
    /// The effective mass of both bodies along the normal; zero where no push moves either.
    pub(super) mass: f64,
    /// The accumulated impulses along the normal and of friction, kept as the first guess of the next step.
    pub(super) apart: f64,
    pub(super) aside: DVec3,
    /// The separation speed before the step, in m/s (negative: they approach), and the largest normal impulse of any
    /// substep.
    pub(super) speed_before: f64,
    pub(super) hardest: f64,
}

/// What all points share in one pass of a substep.
pub(super) struct Pass {
    /// In seconds.
    substep: f64,
    friction: f64,
    /// The speed that the spring asks for per metre of overlap.
    rate: f64,
    mass_share: f64,
    push_share: f64,
}

impl Pass {
    /// With springs, which remove overlap.
    pub(super) fn soft(substep: f64, friction: f64) -> Self {
        let omega = TAU * SPRING_SHARE / substep;
        let (damping, stiffness) = (2.0 * SPRING_DAMPING + substep * omega, substep * omega);
        let push_share = 1.0 / (1.0 + stiffness * damping);
        let (rate, mass_share) = (omega / damping, stiffness * damping * push_share);
        Self { substep, friction, rate, mass_share, push_share }
    }

    /// Without springs: all that is asked is that the bodies do not come closer.
    pub(super) fn stiff(&self) -> Self {
        Self { rate: 0.0, mass_share: 1.0, push_share: 0.0, ..*self }
    }
}

/// Starts each point with the impulses of the last step. Both lists are in the world's order of pairs, so one walk
/// along both finds the last points of each pair.
pub(super) fn warm_start(points: &mut [Point], last: &[Point]) {
    let mut start = 0;
    for point in points {
        while last.get(start).is_some_and(|last| last.keys < point.keys) {
            start += 1;
        }
        let mut of_pair = last[start..].iter().take_while(|last| last.keys == point.keys);
        if let Some(last) = of_pair.find(|last| last.feature == point.feature) {
            // The friction impulse must stay perpendicular to the new normal.
            point.apart = last.apart;
            point.aside = last.aside.reject_from_normalized(point.normal);
        }
    }
}

impl Point {
    /// Computes what stays the same in all substeps.
    pub(super) fn prepare(&mut self, bodies: &[Body]) {
        let yielding = self.yielding(bodies, self.normal);
        self.mass = if yielding > 0.0 { 1.0 / yielding } else { 0.0 };
        self.speed_before = self.speed(bodies);
    }

    /// Applies an impulse to B, and the opposite one to A.
    pub(super) fn apply(&self, bodies: &mut [Body], push: DVec3) {
        let ([a, b], [arm_a, arm_b]) = (self.bodies, self.arms);
        bodies[a].push(arm_a, -push);
        bodies[b].push(arm_b, push);
    }

    /// The velocity of B's point relative to A's.
    fn drift(&self, bodies: &[Body]) -> DVec3 {
        let [a, b] = self.bodies.map(|number| &bodies[number]);
        b.velocity_at(self.arms[1]) - a.velocity_at(self.arms[0])
    }

    /// How fast the bodies separate along the normal, in m/s.
    pub(super) fn speed(&self, bodies: &[Body]) -> f64 {
        self.drift(bodies).dot(self.normal)
    }

    fn yielding(&self, bodies: &[Body], direction: DVec3) -> f64 {
        let [a, b] = self.bodies.map(|number| &bodies[number]);
        a.yielding(self.arms[0], direction) + b.yielding(self.arms[1], direction)
    }

    /// Friction is solved first, as in Box2D 2.4, so that non-penetration has the last word. (The other way round, a
    /// pyramid with a base of 60 settles 7 mm off its middle along its rows, and not 1.)
    pub(super) fn push(&mut self, bodies: &mut [Body], pass: &Pass) {
        self.push_aside(bodies, pass.friction);
        let ([a, b], [arm_a, arm_b]) = (self.bodies.map(|number| &bodies[number]), self.arms);
        let carried = b.moved + b.turned.cross(arm_b) - a.moved - a.turned.cross(arm_a);
        let separation = self.separation + carried.dot(self.normal);
        let speed = self.speed(bodies);
        let push = if separation > 0.0 {
            // In a gap (speculative): the speed that just closes it in this substep is allowed.
            -self.mass * (speed + separation / pass.substep)
        } else {
            let wanted = (pass.rate * separation).max(-PUSH_SPEED);
            -self.mass * pass.mass_share * (speed + wanted) - pass.push_share * self.apart
        };
        self.set_apart(bodies, self.apart + push);
    }

    fn set_apart(&mut self, bodies: &mut [Body], wanted: f64) {
        let apart = wanted.max(0.0);
        self.apply(bodies, self.normal * (apart - self.apart));
        self.apart = apart;
        self.hardest = self.hardest.max(apart);
    }

    /// Friction: stops sliding, with an impulse of at most `friction` times the normal impulse.
    fn push_aside(&mut self, bodies: &mut [Body], friction: f64) {
        let most = friction * self.apart;
        if most == 0.0 && self.aside == DVec3::ZERO {
            return;
        }
        let slide = self.drift(bodies).reject_from_normalized(self.normal);
        let speed = slide.length();
        let mut aside = self.aside;
        if speed > 1e-12 {
            let direction = slide * (1.0 / speed);
            let yielding = self.yielding(bodies, direction);
            if yielding > 0.0 {
                aside -= direction * (speed / yielding);
            }
        }
        let size = aside.length();
        if size > most {
            aside *= most / size;
        }
        self.apply(bodies, aside - self.aside);
        self.aside = aside;
    }

    /// Restitution: gives back a share of the approach speed, where the point did push.
    pub(super) fn bounce(&mut self, bodies: &mut [Body], restitution: f64) {
        if self.speed_before > -BOUNCE_SPEED || self.hardest == 0.0 {
            return;
        }
        let push = -self.mass * (self.speed(bodies) + restitution * self.speed_before);
        self.set_apart(bodies, self.apart + push);
    }
}
