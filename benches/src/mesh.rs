//! Bodies, queries, rays and casts on triangle meshes, beside parry3d's `TriMesh`.
//!
//! The ground is hills in cells of a metre, or a plane with the same triangulation. Bodies are apart from each other,
//! so that all contacts are with the ground; both sides keep contacts with gaps of up to 2 cm, and parry3d keeps its
//! manifolds from frame to frame.

mod asked;

use crate::clock::Effort;
use crate::lean::{Lean, LeanBody};
use crate::parry::{self, Shapes};
use crate::race::Race;
use crate::row::Row;
use crate::world::play::{Ours3, Play};
use crate::world::{MARGIN, peer_frame};
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Cuboid, Hull, Pose3, Shape3, Sphere, TriMesh};
use asunder_narrow::Pair3;
use asunder_scenes::random::Random;
use asunder_scenes::terrain::Terrain;
use asunder_scenes::worlds::Body3;
use parry3d::math::Pose;
use std::error::Error;

/// What a row measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A frame with bodies almost at rest: each moves by a tenth of a millimetre.
    Rest(Bodies),
    /// The same on a plane.
    Flat(Bodies),
    /// A frame with bodies that move by two centimetres, straight: over hills they sink by up to a centimetre, or leave
    /// the ground.
    Roll(Bodies),
    /// A frame with bodies that roll by two centimetres, a millimetre deep in the ground all the way.
    Tumble(Bodies),
    /// A slanted ray from above.
    Rays,
    /// A query for one body and the ground.
    Asked(Question, Bodies),
    /// Building the mesh; the time is per triangle.
    Build,
}

/// The bodies on the ground, or in queries with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bodies {
    /// Cuboids with a side of 0.8 m.
    Boxes,
    /// Hulls of 32 points, of the same size.
    Hulls,
    /// Spheres of the same size.
    Spheres,
}

impl Bodies {
    const ALL: [Self; 3] = [Self::Boxes, Self::Hulls, Self::Spheres];

    const fn name(self) -> &'static str {
        match self {
            Self::Boxes => "box",
            Self::Hulls => "hull32",
            Self::Spheres => "sphere",
        }
    }
}

/// A query for a body and the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Where it touches the ground as it flies down at a slant.
    Cast,
    /// Whether they touch; half of the bodies do.
    Overlap,
    /// How far they are apart, up to 3 m.
    Distance,
}

impl Question {
    const ALL: [Self; 3] = [Self::Cast, Self::Overlap, Self::Distance];

    const fn name(self) -> &'static str {
        match self {
            Self::Cast => "casts",
            Self::Overlap => "overlap",
            Self::Distance => "distance",
        }
    }
}

/// One row: what is measured, and on how many triangles.
pub type Case = (Kind, usize);

/// Bodies per row.
const BODIES: usize = 1000;

/// Every row.
///
/// ```
/// use asunder_benches::{clock::Effort, mesh};
/// let names: Vec<String> = mesh::cases(&Effort::full()).iter().map(mesh::name).collect();
/// assert!(names.contains(&"rest/box/20k".into()) && names.contains(&"rays/1000k".into()));
/// ```
pub fn cases(effort: &Effort) -> Vec<Case> {
    let frames = Bodies::ALL
        .into_iter()
        .flat_map(|bodies| [Kind::Rest, Kind::Flat, Kind::Roll, Kind::Tumble].map(|kind| kind(bodies)));
    let of_question = |question| Bodies::ALL.map(|bodies| Kind::Asked(question, bodies));
    let asked = Question::ALL.into_iter().flat_map(of_question);
    let kinds: Vec<Kind> = frames.chain([Kind::Rays]).chain(asked).chain([Kind::Build]).collect();
    let sizes: &[usize] = if effort.is_quick { &[20_000] } else { &[20_000, 1_000_000] };
    sizes.iter().flat_map(|&size| kinds.iter().map(move |&kind| (kind, size))).collect()
}

/// The name of a row, as `rest/box/20k`.
///
/// ```
/// use asunder_benches::mesh::{self, Bodies, Kind};
/// assert_eq!(mesh::name(&(Kind::Roll(Bodies::Hulls), 20_000)), "roll/hull32/20k");
/// ```
pub fn name(&(kind, triangles): &Case) -> String {
    let kind = match kind {
        Kind::Rest(bodies) => format!("rest/{}", bodies.name()),
        Kind::Flat(bodies) => format!("flat/{}", bodies.name()),
        Kind::Roll(bodies) => format!("roll/{}", bodies.name()),
        Kind::Tumble(bodies) => format!("tumble/{}", bodies.name()),
        Kind::Rays => "rays".into(),
        Kind::Asked(question, bodies) => format!("{}/{}", question.name(), bodies.name()),
        Kind::Build => "build".into(),
    };
    format!("{kind}/{}k", triangles / 1000)
}

/// Measures one row, on one thread. Cost: about a second per variant, and building the mesh.
///
/// # Errors
/// A shape or mesh that either side rejects.
///
/// ```
/// use asunder_benches::{clock::Effort, mesh::{self, Bodies, Kind, Question}};
/// let effort = Effort { rounds: 2, ..Effort::quick() };
/// let distance = Kind::Asked(Question::Distance, Bodies::Spheres);
/// for kind in [Kind::Rest(Bodies::Boxes), Kind::Rays, distance, Kind::Build] {
///     let row = mesh::measure(&(kind, 2000), &effort)?;
///     assert!(row.ratio.is_some(), "{row:?}");
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Result<Row, Box<dyn Error>> {
    let (kind, triangles) = *case;
    let terrain = match kind {
        Kind::Flat(_) => Terrain::flat(triangles, 1.0),
        _ => Terrain::new(triangles, 1.0, 20),
    };
    let row = |per, n| Row::new(name(case), per, n);
    match kind {
        Kind::Build => asked::build(&terrain, effort, row("triangle", triangles)),
        Kind::Rays => asked::rays(&terrain, effort, row("ray", triangles)),
        Kind::Asked(question, bodies) => {
            let body = shape_of(bodies, &mut Random::new(23))?;
            asked::bodies(&terrain, (question, &body), effort, row("question", triangles))
        }
        Kind::Rest(bodies) | Kind::Flat(bodies) => {
            let standing = Standing::new(&terrain, bodies, 1e-4)?;
            frames(&standing, effort, row("frame", BODIES))
        }
        Kind::Roll(bodies) => frames(&Standing::new(&terrain, bodies, 0.02)?, effort, row("frame", BODIES)),
        Kind::Tumble(bodies) => {
            let standing = Standing::new(&terrain, bodies, 0.02)?.tumbling(&terrain)?;
            frames(&standing, effort, row("frame", BODIES))
        }
    }
}

fn mesh_of(terrain: &Terrain) -> Result<Shape3, Box<dyn Error>> {
    Ok(TriMesh::new(terrain.vertices(), terrain.triangles())?.into())
}

fn frames(standing: &Standing, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    let mut ours = Ours3::new(&standing.bodies)?;
    let mut shapes = Shapes::default();
    let convert = |body: &Body3| {
        let shape = shapes.convert(&body.shape)?;
        Some(LeanBody { shape, pose: parry::pose(&body.pose), fixed: body.fixed, owner: None })
    };
    let lean: Option<Vec<LeanBody>> = standing.bodies.iter().map(convert).collect();
    let mut peer = Lean::new(lean.ok_or("parry3d refuses a shape")?, MARGIN);
    ours.update();
    peer.update();
    let mut race = Race::default();
    while !race.is_over(effort) {
        let frame = race.ours.len() + 1;
        let poses = standing.poses(frame)?;
        let converted: Vec<(u32, Pose)> = poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
        let (walked, peer_walked) = race.turn(1, || ours.frame(&poses), || peer_frame(&mut peer, &converted));
        if frame == 1 {
            row.remark(&format!("{} contacts, {} points", walked.contacts, walked.points));
            row.remark(&format!("peer: {} contacts, {} points", peer_walked.contacts, peer_walked.points));
        }
    }
    race.tell(&mut row, "lean parry3d");
    Ok(row)
}

/// Frames after which bodies turn back.
const THERE: usize = 20;

/// Bodies on the ground, which move back and forth.
struct Standing {
    /// All bodies, the ground first.
    bodies: Vec<Body3>,
    /// The direction in which each of them moves, along the ground.
    ways: Vec<DVec3>,
    /// How far they move in a frame, in metres.
    step: f64,
    /// The poses of each body on its way there; none if it moves straight.
    paths: Vec<Vec<Pose3>>,
}

impl Standing {
    fn new(terrain: &Terrain, bodies: Bodies, step: f64) -> Result<Self, Box<dyn Error>> {
        let mut random = Random::new(21);
        let ground = mesh_of(terrain)?;
        let body = |shape: Shape3, pose, fixed| Body3 {
            shape,
            pose,
            velocity: Vec3::ZERO,
            fixed,
            sensor: false,
            owner: None,
        };
        let floor = body(ground.clone(), Pose3::IDENTITY, true);
        let mut standing = Self { bodies: vec![floor], ways: Vec::new(), step, paths: Vec::new() };
        let across = (BODIES as f64).sqrt().ceil() as usize;
        let spacing = (terrain.side() - 4.0) / across as f64;
        for number in 0..BODIES {
            let cell = [number % across, number / across].map(|i| (i as f64 + 0.5) * spacing + 2.0);
            let shape = shape_of(bodies, &mut random)?;
            let (_, normal) = terrain.under(cell);
            let pose = set_down((terrain, &ground), &shape, cell, Quat::IDENTITY)?;
            let any = random.direction();
            standing
                .ways
                .push((any - normal * any.dot(normal)).normalize_or(normal.any_orthonormal_vector()));
            standing.bodies.push(body(shape, pose, false));
        }
        Ok(standing)
    }

    /// The same bodies, which roll, and follow the ground.
    fn tumbling(mut self, terrain: &Terrain) -> Result<Self, Box<dyn Error>> {
        let ground = mesh_of(terrain)?;
        let movers = self.bodies.iter().skip(1).zip(&self.ways);
        let path = |(body, along): (&Body3, &DVec3)| {
            let from = body.pose.position();
            let pose = |frame: usize| {
                let way = self.step * frame as f64;
                let [x, z] = [from.x + along.x * way, from.z + along.z * way];
                // As far as it moves, over the radius of a ball of its size.
                let half = DVec3::Y.cross(*along) * (0.5 * way / f64::from(HALF));
                let [a, b, c] = half.as_vec3().to_array();
                set_down((terrain, &ground), &body.shape, [x, z], Quat::from_xyzw(a, b, c, 1.0).normalize())
            };
            (0..=THERE).map(pose).collect()
        };
        self.paths = movers.map(path).collect::<Result<_, _>>()?;
        Ok(self)
    }

    /// The poses of the bodies in a frame: back and forth, within a metre of where they began.
    fn poses(&self, frame: usize) -> Result<Vec<(u32, Pose3)>, Box<dyn Error>> {
        let turn = frame % (2 * THERE);
        let there = if turn < THERE { turn } else { 2 * THERE - turn };
        let moved = self.bodies.iter().skip(1).zip(&self.ways).zip(1..);
        moved
            .map(|((body, along), number)| {
                let pose = match self.paths.get(number as usize - 1) {
                    Some(path) => path[there],
                    None => body.pose.shifted(*along * (self.step * there as f64))?,
                };
                Ok((number, pose))
            })
            .collect()
    }
}

/// The pose of a body over a place that stands on the ground there, turned from upright: it is let down until it
/// touches, and a millimetre further.
fn set_down(
    (terrain, ground): (&Terrain, &Shape3),
    shape: &Shape3,
    cell: [f64; 2],
    turn: Quat,
) -> Result<Pose3, Box<dyn Error>> {
    let (height, normal) = terrain.under(cell);
    let upright = Quat::from_rotation_arc(Vec3::Y, normal.as_vec3());
    let above = Pose3::new(DVec3::new(cell[0], height, cell[1]) + normal, turn * upright)?;
    let down = normal * -2.0;
    let fraction = Pair3::new(shape, &above, ground, &Pose3::IDENTITY)
        .cast(down.as_vec3())
        .map_or(0.5, |impact| impact.fraction);
    Ok(above.shifted(down * fraction - normal * 1e-3)?)
}

/// Half the width of every body, in metres.
const HALF: f32 = 0.4;

fn shape_of(bodies: Bodies, random: &mut Random) -> Result<Shape3, Box<dyn Error>> {
    Ok(match bodies {
        Bodies::Boxes => Cuboid::from_half_extents(Vec3::splat(HALF))?.into(),
        Bodies::Spheres => Sphere::new(HALF)?.into(),
        Bodies::Hulls => {
            let points: Vec<Vec3> =
                (0..32).map(|_| (random.direction() * f64::from(HALF)).as_vec3()).collect();
            Hull::from_points(&points)?.into()
        }
    })
}
