//! Bodies that roll, fall, hop and creep over ground: over a mesh and a height field in space, over a chain in the
//! plane.
//!
//! There is no solver: a body's pose depends on the frame's number alone. It follows the ground under its centre a few
//! millimetres deep, so that broad or long bodies reach in deeper, and rolling ones run into their neighbours. Angles
//! become rotations by the library's own trigonometry, and quaternions are computed in f64 one component after the
//! other: the script has equal bits on every machine.

use crate::cases::Random;
use crate::recorded::{MARGIN, Replay};
use asunder::{
    Capsule2, Capsule3, Chain, Circle, Collider2, Collider3, Compound2, Compound3, Cuboid, HeightField, Hull,
    Plane, Polygon, Pose2, Pose3, Rect, Rotation2, Shape2, Shape3, Sphere, TriMesh, Volume,
};
use asunder_scenes::terrain::Terrain;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// Seconds per frame.
const STEP: f64 = 1.0 / 60.0;

/// How a body moves.
#[derive(Clone, Copy)]
enum Gait {
    /// Continuously, turning as it goes.
    Rolls,
    /// From above, and then it lies still.
    Falls,
    /// In arcs, turning as it goes.
    Hops,
    /// A tenth of a millimetre per frame, flat on the ground.
    Creeps,
}

const GAITS: [Gait; 4] = [Gait::Rolls, Gait::Falls, Gait::Hops, Gait::Creeps];

impl Gait {
    /// Metres per second along the ground.
    fn speed(self) -> f64 {
        match self {
            Self::Rolls => 2.5,
            Self::Falls => 0.0,
            Self::Hops => 1.5,
            Self::Creeps => 0.006,
        }
    }

    fn turns(self) -> bool {
        matches!(self, Self::Rolls | Self::Hops)
    }

    /// Height above its place on the ground, in metres; the phase is from 0 to 1.
    fn lift(self, time: f64, phase: f64) -> f64 {
        match self {
            Self::Rolls | Self::Creeps => 0.0,
            Self::Falls => (phase - 4.905 * time * time).max(0.0),
            Self::Hops => {
                let bow = 2.0 * time + phase;
                let bow = bow - bow.floor();
                bow * (1.0 - bow)
            }
        }
    }
}

/// A body's path; `P` is a place on the ground.
struct Way<P> {
    gait: Gait,
    start: P,
    /// Metres per second.
    velocity: P,
    phase: f64,
    /// Height of its position when it lies on the ground, less a few millimetres.
    height: f64,
}

/// Hills in two halves: a mesh on the left, and on the right a one-sided height field with holes.
pub struct Hills {
    halves: [Terrain; 2],
    /// Those of the bodies after both halves, alternating between the two.
    ways: Vec<Way<DVec2>>,
}

/// The number of grounds that [`Hills::open`] puts before all other bodies.
pub const GROUNDS: usize = 2;

/// Width of a cell of the hills, in metres.
const CELL: f64 = 0.5;

impl Hills {
    /// `count` bodies including both halves of the ground, which are the first two. Seed 1.
    pub fn open(count: usize) -> (Self, Vec<Collider3>) {
        let count = count - GROUNDS;
        // Slightly more than a square metre per body.
        let halves = [20, 21].map(|seed| Terrain::new(5 * count, CELL, seed));
        let (mut random, side) = (Random::new(1), halves[0].side());
        let kinds = kinds3();
        let mut colliders = grounds(&halves);
        let mut ways = Vec::new();
        for number in 0..count {
            let (shape, height) = &kinds[number / 8 % kinds.len()];
            colliders.push(body3(shape, colliders.len()));
            let gait = GAITS[number / 2 % 4];
            ways.push(Way {
                gait,
                start: DVec2::new(random.between(0.1, 0.9), random.between(0.1, 0.9)) * side,
                velocity: random.direction2() * gait.speed(),
                phase: random.between(0.0, 1.0),
                height: height - random.between(0.0, 0.004),
            });
        }
        let hills = Self { halves, ways };
        hills.poses(0).for_each(|(body, pose)| colliders[body] = colliders[body].clone().at(pose));
        (hills, colliders)
    }

    fn poses(&self, frame: u32) -> impl Iterator<Item = (usize, Pose3)> {
        let time = f64::from(frame) * STEP;
        self.ways.iter().enumerate().map(move |(number, way)| {
            let half = &self.halves[number % 2];
            let place = way.start + way.velocity * time;
            let (ground, normal) = half.under(place);
            let up = if way.gait.turns() { DVec3::Y } else { normal };
            let left = if number % 2 == 0 { half.side() } else { 0.0 };
            let at = DVec3::new(place.x - left, ground, place.y) + up * way.height;
            let rotation = if way.gait.turns() {
                let across = DVec3::new(way.velocity.y, 0.0, -way.velocity.x).normalize();
                about(across, way.phase + way.velocity.length() * time / way.height)
            } else {
                upright(normal)
            };
            let lift = DVec3::Y * way.gait.lift(time, way.phase);
            (GROUNDS + number, Pose3::new(at + lift, rotation).unwrap())
        })
    }
}

impl Replay<Volume> for Hills {
    fn advance(&mut self, frame: u32, mut set: impl FnMut(usize, Pose3)) {
        self.poses(frame).for_each(|(body, pose)| set(body, pose));
    }
}

/// Both halves of the hills.
fn grounds([left, right]: &[Terrain; 2]) -> Vec<Collider3> {
    let mesh = TriMesh::new(left.vertices(), left.triangles()).unwrap();
    let (heights, side) = (right.vertices().iter().map(|vertex| vertex.y).collect::<Vec<_>>(), right.cells());
    let field = HeightField::new(side + 1, side + 1, heights, Vec2::splat(CELL as f32)).unwrap().one_sided();
    let holes = (0..side).map(|row| (row * 5 % side, row));
    let aside = Pose3::at([-left.side(), 0.0, 0.0]).unwrap();
    vec![
        Collider3::new(mesh).at(aside).user_data(0),
        Collider3::new(field.with_holes(holes).unwrap()).user_data(1),
    ]
}

fn body3(shape: &Shape3, number: usize) -> Collider3 {
    Collider3::new(shape.clone()).user_data(number as u64).margin(0.5 * MARGIN).unwrap()
}

/// Shapes, and the height of their positions when they lie flat.
fn kinds3() -> Vec<(Shape3, f64)> {
    let cuboid = |half| Cuboid::from_half_extents(half).unwrap();
    let corners: Vec<Vec3> = (0..8)
        .flat_map(|i| {
            let corner = Vec3::new([-0.3, 0.3][i & 1], [-0.2, 0.2][i >> 1 & 1], [-0.25, 0.25][i >> 2]);
            [corner, Vec3::new(corner.x * 1.3, corner.y * 0.6, corner.z * 1.2)]
        })
        .collect();
    let dumbbell = [-0.25, 0.25].map(|x| {
        let end: Shape3 =
            if x < 0.0 { cuboid(Vec3::splat(0.2)).into() } else { Sphere::new(0.2).unwrap().into() };
        (Pose3::at([x, 0.0, 0.0]).unwrap(), end)
    });
    vec![
        (cuboid(Vec3::new(0.35, 0.2, 0.3)).into(), 0.2),
        (Hull::from_points(&corners).unwrap().into(), 0.2),
        (Sphere::new(0.3).unwrap().into(), 0.3),
        (Capsule3::new(Vec3::Z * -0.25, Vec3::Z * 0.25, 0.2).unwrap().into(), 0.2),
        (Compound3::new(dumbbell).unwrap().into(), 0.2),
        (cuboid(Vec3::new(0.25, 0.15, 0.2)).rounded(0.05).unwrap().into(), 0.2),
    ]
}

/// The rotation about a unit axis by an angle in radians.
fn about(axis: DVec3, angle: f64) -> Quat {
    let half = Rotation2::from_angle((0.5 * angle) as f32).unwrap();
    let axis = axis.as_vec3();
    Quat::from_xyzw(axis.x * half.sin(), axis.y * half.sin(), axis.z * half.sin(), half.cos())
}

/// The shortest rotation from upright to a unit normal that points up. Poses normalise it.
fn upright(normal: DVec3) -> Quat {
    Quat::from_xyzw(normal.z as f32, 0.0, -normal.x as f32, (1.0 + normal.y) as f32)
}

/// A hilly path, with level stretches that are cut into pieces, as one chain.
pub struct Track {
    vertices: Vec<Vec2>,
    ways: Vec<Way<f64>>,
}

/// Metres from one vertex of the track to the next, along x.
const PIECE: f64 = 0.25;

impl Track {
    /// `count` bodies including the chain, which is the first. Seed 1.
    pub fn open(count: usize) -> (Self, Vec<Collider2>) {
        let count = count - 1;
        let length = 5.0 + 0.7 * count as f64;
        let vertices: Vec<Vec2> = (0..=(length / PIECE) as usize).map(vertex).collect();
        let chain = Collider2::new(Chain::open(vertices.iter().copied()).unwrap());
        let mut random = Random::new(1);
        let kinds = kinds2();
        let mut colliders = vec![chain];
        let mut ways = Vec::new();
        for number in 0..count {
            let (shape, height) = &kinds[number / 4 % kinds.len()];
            let body = Collider2::new(shape.clone()).user_data(1 + number as u64);
            colliders.push(body.margin(0.5 * MARGIN).unwrap());
            let gait = GAITS[number % 4];
            ways.push(Way {
                gait,
                start: random.between(2.5, length - 2.5),
                velocity: random.pick(&[-1.0, 1.0]) * gait.speed(),
                phase: random.between(0.0, 1.0),
                height: height - random.between(0.0, 0.004),
            });
        }
        let track = Self { vertices, ways };
        track.poses(0).for_each(|(body, pose)| colliders[body] = colliders[body].clone().at(pose));
        (track, colliders)
    }

    fn poses(&self, frame: u32) -> impl Iterator<Item = (usize, Pose2)> {
        let time = f64::from(frame) * STEP;
        (1..).zip(&self.ways).map(move |(body, way)| {
            let x = way.start + way.velocity * time;
            let from = ((x / PIECE) as usize).min(self.vertices.len() - 2);
            let [from, to] = [from, from + 1].map(|vertex| self.vertices[vertex].as_dvec2());
            let along = (to - from).normalize();
            let up = if way.gait.turns() { DVec2::Y } else { along.perp() };
            let ground = DVec2::new(x, from.y + (x - from.x) * along.y / along.x);
            let rotation = if way.gait.turns() {
                Rotation2::from_angle((way.phase - way.velocity * time / way.height) as f32)
            } else {
                Rotation2::new(along.x as f32, along.y as f32)
            };
            let lift = DVec2::Y * way.gait.lift(time, way.phase);
            (body, Pose2::new(ground + up * way.height + lift, rotation.unwrap()).unwrap())
        })
    }
}

impl Replay<Plane> for Track {
    fn advance(&mut self, frame: u32, mut set: impl FnMut(usize, Pose2)) {
        self.poses(frame).for_each(|(body, pose)| set(body, pose));
    }
}

/// Waves of 31 and 7 m, clamped from below at half a metre under zero.
fn vertex(number: usize) -> Vec2 {
    let x = number as f64 * PIECE;
    let wave =
        |length: f64| Rotation2::from_angle((x * core::f64::consts::TAU / length) as f32).unwrap().sin();
    Vec2::new(x as f32, (wave(31.0) + 0.2 * wave(7.0)).max(-0.5))
}

/// Shapes, and the height of their positions when they lie flat.
fn kinds2() -> Vec<(Shape2, f64)> {
    let rect = |x, y| Rect::from_half_extents(Vec2::new(x, y)).unwrap();
    let corners = [(-0.3, -0.2), (0.3, -0.2), (0.4, 0.1), (0.0, 0.35), (-0.4, 0.1)].map(Vec2::from);
    let parts: [(Pose2, Shape2); 2] = [
        (Pose2::at([-0.25, 0.0]).unwrap(), rect(0.2, 0.2).into()),
        (Pose2::at([0.25, 0.0]).unwrap(), Circle::new(0.2).unwrap().into()),
    ];
    vec![
        (rect(0.35, 0.2).into(), 0.2),
        (Polygon::new(&corners).unwrap().into(), 0.2),
        (Circle::new(0.3).unwrap().into(), 0.3),
        (Capsule2::new(Vec2::X * -0.25, Vec2::X * 0.25, 0.2).unwrap().into(), 0.2),
        (Compound2::new(parts).unwrap().into(), 0.2),
        (rect(0.25, 0.15).rounded(0.05).unwrap().into(), 0.2),
    ]
}
