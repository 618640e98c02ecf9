//! A small rigid-body solver, to find out whether bodies can stand on our manifolds.
//!
//! Sequential impulses with warm starting (Catto, "Iterative dynamics with temporal coherence", 2005), substeps, and
//! soft contacts with a relaxing pass (Catto, "Solver2D", 2024): what games use, and no more than that.
//!
//! ```text
//! once a step     update the world; one constraint per contact point, warm-started from last step by its feature id
//! each substep    gravity; warm start; solve with soft contacts that push out of overlap as a damped spring does;
//!                 integrate positions; solve again without the push (relax), so that no body keeps the speed that it
//!                 was pushed out with
//! ```
//! A point that is still apart by s may close by s in a substep, and no more (a speculative contact). Nothing sleeps,
//! and nothing is damped except by contacts.

use asunder::{BodyKey3, Collider3, FeatureId, Pose3, Shape3, World3};
use glam::{DMat3, DQuat, DVec2, DVec3};
use std::collections::BTreeMap;

/// Seconds per step.
pub const STEP: f64 = 1.0 / 60.0;

const GRAVITY: DVec3 = DVec3::new(0.0, -9.81, 0.0);

/// Ten times critical damping, as Catto has it: contacts must not bounce.
const DAMPING_RATIO: f64 = 10.0;

/// The spring's frequency in hertz, at most; and at most a quarter of the substep rate, beyond which Catto found it to
/// shake.
const STIFFNESS: f64 = 60.0;

/// The greatest speed at which bodies are pushed out of each other, in metres per second.
const PUSH: f64 = 3.0;

/// The solver's settings.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Substeps per step: 4 to 8 in games.
    pub substeps: usize,
    /// Coulomb's coefficient, the same for all bodies.
    pub friction: f64,
    /// Each body's share of the distance at which contacts appear, in metres.
    pub margin: f32,
    /// What happens to the feature ids of contact points.
    pub names: Names,
}

/// What happens to the feature ids of contact points on their way to the solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// They are used as they are.
    Kept,
    /// They differ in every step, so that no impulse is ever found again.
    Lost,
    /// Within a manifold they are shifted by one place in every step, so that impulses come from a neighbour.
    Swapped,
}

impl Default for Settings {
    fn default() -> Self {
        Self { substeps: 8, friction: 0.6, margin: 0.01, names: Names::Kept }
    }
}

/// A body: its mass properties and motion.
#[derive(Clone, Debug)]
pub struct Body {
    /// Centre of mass, in metres.
    pub center: DVec3,
    /// Rotation.
    pub rotation: DQuat,
    /// Metres per second.
    pub velocity: DVec3,
    /// Radians per second.
    pub spin: DVec3,
    key: BodyKey3,
    local_center: DVec3,
    inverse_mass: f64,
    inverse_inertia: DMat3,
    /// Its pose when contacts were found.
    start: (DVec3, DQuat),
}

/// A contact point's key in the world: both bodies, both parts, both features.
type Name = (usize, usize, u32, u32, u64);

/// One contact point.
struct Point {
    name: Name,
    normal: DVec3,
    tangents: [DVec3; 2],
    /// From each centre of mass.
    arms: [DVec3; 2],
    /// The separation, less the part of it that follows from the arms.
    offset: f64,
    /// Accumulated impulse along the normal.
    push: f64,
    /// Accumulated impulse along both tangents.
    rub: DVec2,
    /// Effective masses along the normal and both tangents.
    masses: [f64; 3],
}

/// Statistics of the contact points of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Seen {
    /// Their number.
    pub points: usize,
    /// How many of them have a key of the previous step.
    pub kept: usize,
}

/// Bodies under gravity.
pub struct Solver {
    /// The collision world, as of the last step.
    pub world: World3,
    /// In the order in which they were added.
    pub bodies: Vec<Body>,
    settings: Settings,
    impulses: BTreeMap<Name, (f64, DVec3)>,
    steps: u64,
}

impl Solver {
    /// An empty scene.
    pub fn new(settings: Settings) -> Self {
        Self { world: World3::new(), bodies: Vec::new(), settings, impulses: BTreeMap::new(), steps: 0 }
    }

    /// Adds a body with the density of water; a fixed one does not move.
    pub fn add(&mut self, shape: impl Into<Shape3>, pose: Pose3, fixed: bool) {
        let shape = shape.into();
        let collider = Collider3::new(shape.clone()).at(pose).user_data(self.bodies.len() as u64);
        let collider = collider.margin(self.settings.margin).unwrap();
        let key = self.world.insert(if fixed { collider.fixed() } else { collider });
        let mass = (!fixed).then(|| shape.mass_properties(1000.0).unwrap());
        let local_center = mass.map_or(DVec3::ZERO, |mass| mass.center);
        self.bodies.push(Body {
            center: pose.transform(local_center),
            rotation: pose.rotation().as_dquat().normalize(),
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            key,
            local_center,
            inverse_mass: mass.map_or(0.0, |mass| 1.0 / mass.mass),
            inverse_inertia: mass.map_or(DMat3::ZERO, |mass| mass.inertia.inverse()),
            start: (DVec3::ZERO, DQuat::IDENTITY),
        });
    }

    /// Advances all bodies by one step of [`STEP`] seconds.
    pub fn step(&mut self) -> Seen {
        self.world.update();
        self.steps += 1;
        for body in &mut self.bodies {
            body.start = (body.center, body.rotation);
        }
        let mut points = self.points();
        let kept = points.iter().filter(|point| self.impulses.contains_key(&point.name)).count();
        let h = STEP / self.settings.substeps as f64;
        for _ in 0..self.settings.substeps {
            for body in self.bodies.iter_mut().filter(|body| body.inverse_mass > 0.0) {
                body.velocity += GRAVITY * h;
            }
            for point in &points {
                let rub = point.tangents[0] * point.rub.x + point.tangents[1] * point.rub.y;
                push(&mut self.bodies, point, point.normal * point.push + rub);
            }
            points.iter_mut().for_each(|point| self.solve(point, h, true));
            self.bodies.iter_mut().for_each(|body| body.advance(h));
            points.iter_mut().for_each(|point| self.solve(point, h, false));
        }
        let impulse = |p: &Point| (p.push, p.tangents[0] * p.rub.x + p.tangents[1] * p.rub.y);
        self.impulses = points.iter().map(|point| (point.name, impulse(point))).collect();
        for body in &self.bodies {
            self.world.set_pose(body.key, body.pose()).unwrap();
        }
        Seen { points: points.len(), kept }
    }

    /// All contact points, each warm-started by its key.
    fn points(&self) -> Vec<Point> {
        let mut points = Vec::new();
        for contact in self.world.contacts() {
            let [a, b] = [contact.a, contact.b]
                .map(|key| self.world.get(key).map_or(0, |body| body.get_user_data() as usize));
            for manifold in contact.manifolds {
                let features: Vec<FeatureId> = manifold.points.iter().map(|point| point.feature).collect();
                for (place, found) in manifold.points.iter().enumerate() {
                    let feature = self.feature(&features, place);
                    let arms = [
                        found.anchor_a.as_dvec3() - self.bodies[a].lever(),
                        found.anchor_b.as_dvec3() - self.bodies[b].lever(),
                    ];
                    let name = (a, b, manifold.part_a, manifold.part_b, feature);
                    let seen = (manifold.normal.as_dvec3().normalize(), f64::from(found.separation));
                    points.push(self.point(name, seen, arms));
                }
            }
        }
        points
    }

    fn feature(&self, features: &[FeatureId], place: usize) -> u64 {
        match self.settings.names {
            Names::Kept => features[place].to_bits(),
            Names::Lost => features[place].to_bits() ^ (self.steps << 20),
            Names::Swapped => features[(place + self.steps as usize) % features.len()].to_bits(),
        }
    }

    fn point(&self, name: Name, (normal, separation): (DVec3, f64), arms: [DVec3; 2]) -> Point {
        let first = normal.any_orthonormal_vector();
        let tangents = [first, normal.cross(first)];
        let (push, rub) = self.impulses.get(&name).copied().unwrap_or((0.0, DVec3::ZERO));
        let (a, b) = (&self.bodies[name.0], &self.bodies[name.1]);
        let mass = |axis: DVec3| 1.0 / (a.yields(arms[0], axis) + b.yields(arms[1], axis));
        Point {
            name,
            normal,
            tangents,
            arms,
            offset: separation - (arms[1] - arms[0]).dot(normal),
            push,
            rub: DVec2::new(rub.dot(tangents[0]), rub.dot(tangents[1])),
            masses: [normal, tangents[0], tangents[1]].map(mass),
        }
    }

    fn solve(&mut self, point: &mut Point, h: f64, leans: bool) {
        let [a, b] = [point.name.0, point.name.1];
        let most = self.settings.friction * point.push;
        let speed = self.speed(point);
        let wanted = DVec2::new(
            point.rub.x - point.masses[1] * speed.dot(point.tangents[0]),
            point.rub.y - point.masses[2] * speed.dot(point.tangents[1]),
        );
        let change = wanted.clamp_length_max(most) - point.rub;
        point.rub += change;
        push(&mut self.bodies, point, point.tangents[0] * change.x + point.tangents[1] * change.y);

        let arms = self.bodies[b].moved(point.arms[1]) - self.bodies[a].moved(point.arms[0]);
        let separation = point.offset + arms.dot(point.normal);
        let (bias, mass, ease) = if separation > 0.0 {
            (separation / h, 1.0, 0.0)
        } else if leans {
            let omega = core::f64::consts::TAU * STIFFNESS.min(0.25 / h);
            let damped = 2.0 * DAMPING_RATIO + h * omega;
            let soft = h * omega * damped;
            ((omega / damped * separation).max(-PUSH), soft / (1.0 + soft), 1.0 / (1.0 + soft))
        } else {
            (0.0, 1.0, 0.0)
        };
        let closing = self.speed(point).dot(point.normal) + bias;
        let wanted = (point.push * (1.0 - ease) - point.masses[0] * mass * closing).max(0.0);
        let change = wanted - point.push;
        point.push = wanted;
        push(&mut self.bodies, point, point.normal * change);
    }

    /// The velocity of B's point relative to A's.
    fn speed(&self, point: &Point) -> DVec3 {
        let speed = |body: &Body, arm: DVec3| body.velocity + body.spin.cross(arm);
        speed(&self.bodies[point.name.1], point.arms[1]) - speed(&self.bodies[point.name.0], point.arms[0])
    }
}

/// Applies an impulse to B, and its opposite to A.
fn push(bodies: &mut [Body], point: &Point, impulse: DVec3) {
    for (index, arm, impulse) in
        [(point.name.0, point.arms[0], -impulse), (point.name.1, point.arms[1], impulse)]
    {
        let body = &mut bodies[index];
        body.velocity += impulse * body.inverse_mass;
        body.spin += body.turned_inverse(arm.cross(impulse));
    }
}

impl Body {
    /// The body's pose in the world.
    pub fn pose(&self) -> Pose3 {
        Pose3::new(self.center - self.rotation * self.local_center, self.rotation.as_quat()).unwrap()
    }

    /// From the body's position to its centre of mass.
    fn lever(&self) -> DVec3 {
        self.rotation * self.local_center
    }

    /// The inverse of its inertia in world axes, times a vector.
    fn turned_inverse(&self, v: DVec3) -> DVec3 {
        self.rotation * (self.inverse_inertia * (self.rotation.inverse() * v))
    }

    /// The speed along an axis that a unit impulse along it causes at the end of an arm.
    fn yields(&self, arm: DVec3, axis: DVec3) -> f64 {
        self.inverse_mass + axis.dot(self.turned_inverse(arm.cross(axis)).cross(arm))
    }

    /// How far a point has moved since contacts were found: the body's translation plus the arm's present vector.
    fn moved(&self, arm: DVec3) -> DVec3 {
        self.center - self.start.0 + self.rotation * (self.start.1.inverse() * arm)
    }

    fn advance(&mut self, h: f64) {
        self.center += self.velocity * h;
        let spin = DQuat::from_xyzw(self.spin.x, self.spin.y, self.spin.z, 0.0) * self.rotation;
        self.rotation = (self.rotation + spin * (0.5 * h)).normalize();
    }
}
