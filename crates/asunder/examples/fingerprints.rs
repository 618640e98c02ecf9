//! One line per scene: everything that sixty frames say, as one number. Two machines, builds or platforms that print
//! the same lines agree in every bit: compare a phone, a browser and a server with it.
//!
//! ```text
//! cargo run --release -p asunder --example fingerprints | diff - crates/asunder/examples/fingerprints.txt
//!
//! rustup target add wasm32-wasip1
//! cargo build --release -p asunder --example fingerprints --target wasm32-wasip1
//! node crates/asunder/examples/wasi.mjs target/wasm32-wasip1/release/examples/fingerprints.wasm | diff - crates/asunder/examples/fingerprints.txt
//! ```
//!
//! The golden table of `tests` holds more scenes, but stands on packages that cannot be built everywhere; this needs
//! only the engine and its scenes. The file was made by `cargo run --release -p asunder --example fingerprints >
//! crates/asunder/examples/fingerprints.txt`, and is to be made again only where an output is meant to change.

use asunder::glam::{DVec3, Vec3};
use asunder::{
    AnyWorld, BodyKey3, Capsule3, Collider, Collider2, Collider3, Cuboid, Filter3, Hull, MarginError,
    Motion3, Pose3, Ray3, Shape3, Space, Sphere, StaleKey, TriMesh, Walk3, World, World3,
};
use asunder_scenes::random::Random;
use asunder_scenes::terrain::Terrain;
use asunder_scenes::worlds::{Body2, Body3, Replay2, Replay3, WorldScene};
use std::error::Error;
use std::fmt::{Debug, Write};

const BODIES: usize = 301;
const FRAMES: u32 = 60;

/// The hash of Fowler, Noll and Vo, variant 1a, of text. A float's text has all its bits: `Debug` writes as many digits
/// as it takes to read the same number back.
struct Fingerprint(u64);

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> std::fmt::Result {
        for byte in text.bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        Ok(())
    }
}

impl Fingerprint {
    const START: Self = Self(0xcbf2_9ce4_8422_2325);

    fn add(&mut self, said: &impl Debug) -> std::fmt::Result {
        write!(self, "{said:?};")
    }

    fn hear<S: Space>(&mut self, world: &World<S>) -> std::fmt::Result {
        self.add(&AnyWorld::events(world))?;
        AnyWorld::contacts(world).try_for_each(|contact| self.add(&contact))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    for scene in WorldScene::ALL {
        println!("{}: {:016x}", scene.name(), in_space(scene)?);
    }
    for scene in [WorldScene::ManyPyramids, WorldScene::Mixed] {
        println!("plane/{}: {:016x}", scene.name(), in_plane(scene)?);
    }
    println!("hills: {:016x}", on_hills()?);
    Ok(())
}

fn in_space(scene: WorldScene) -> Result<u64, Box<dyn Error>> {
    let mut replay = Replay3::new(scene, BODIES, 1);
    let collider = |body: &Body3| {
        let collider = Collider3::new(body.shape.clone()).at(body.pose).margin(0.01)?;
        let collider = if body.fixed { collider.fixed() } else { collider };
        Ok::<_, MarginError>(if let Some(owner) = body.owner { collider.owner(owner) } else { collider })
    };
    let colliders = replay.bodies.iter().map(collider).collect::<Result<Vec<_>, _>>()?;
    play(colliders, |frame| {
        replay.advance(frame);
        replay.movers().iter().map(|&i| (i, replay.bodies[i as usize].pose)).collect()
    })
}

fn in_plane(scene: WorldScene) -> Result<u64, Box<dyn Error>> {
    let mut replay = Replay2::new(scene, BODIES, 1);
    let collider = |body: &Body2| {
        let collider = Collider2::new(body.shape.clone()).at(body.pose).margin(0.01)?;
        Ok::<_, MarginError>(if body.fixed { collider.fixed() } else { collider })
    };
    let colliders = replay.bodies.iter().map(collider).collect::<Result<Vec<_>, _>>()?;
    play(colliders, |frame| {
        replay.advance(frame);
        replay.movers().iter().map(|&i| (i, replay.bodies[i as usize].pose)).collect()
    })
}

/// A world of these bodies, posed frame by frame: which of them, and where.
fn play<S: Space>(
    bodies: Vec<Collider<S>>,
    mut poses: impl FnMut(u32) -> Vec<(u32, S::Pose)>,
) -> Result<u64, Box<dyn Error>> {
    let mut world = World::new();
    let keys: Vec<S::Key> = bodies.into_iter().map(|body| AnyWorld::insert(&mut world, body)).collect();
    let mut said = Fingerprint::START;
    for frame in 0..FRAMES {
        for (body, pose) in poses(frame) {
            AnyWorld::set_pose(&mut world, keys[body as usize], pose)?;
        }
        world.update();
        said.hear(&world)?;
    }
    Ok(said.0)
}

/// Bodies that roll over a mesh and are bullets, rays and casts down to it, and somebody who walks there.
fn on_hills() -> Result<u64, Box<dyn Error>> {
    let terrain = Terrain::new(800, 1.0, 3);
    let mut random = Random::new(4);
    let mut world = World3::new();
    world.insert(Collider3::new(TriMesh::new(terrain.vertices(), terrain.triangles())?).fixed());
    let mut movers: Vec<(BodyKey3, DVec3)> = Vec::new();
    for number in 0..60_u8 {
        let points: Vec<Vec3> = (0..20).map(|_| (random.direction() * 0.4).as_vec3()).collect();
        let shape: Shape3 = match number % 4 {
            0 => Sphere::new(0.4)?.into(),
            1 => Cuboid::from_half_extents(Vec3::new(0.3, 0.2, 0.4))?.into(),
            2 => Capsule3::from_half_height(0.3, 0.2)?.into(),
            _ => Hull::from_points(&points)?.into(),
        };
        let place = [2.0 + f64::from(number % 8) * 2.0, 2.0 + f64::from(number / 8) * 2.0];
        let at = Pose3::at([place[0], terrain.under(place).0 + 0.3, place[1]])?;
        movers.push((
            world.insert(Collider3::new(shape).at(at).margin(0.02)?.bullet()),
            random.direction() * 0.03,
        ));
    }
    let walker = Shape3::from(Capsule3::from_half_height(0.5, 0.3)?);
    let walk = Walk3::new(&walker, Vec3::Y)?;
    let mut walks = Pose3::at([9.0, terrain.under([9.0, 9.0]).0 + 1.0, 9.0])?;
    let mut said = Fingerprint::START;
    for frame in 0..FRAMES {
        for (key, way) in &mut movers {
            let pose = *world.pose(*key).ok_or(StaleKey)?;
            world.set_pose(*key, pose.shifted(*way)?)?;
            world.set_motion(*key, Motion3::shift((*way * 20.0).as_vec3())?)?;
            *way = if frame % 20 == 19 { -*way } else { *way };
        }
        world.update();
        said.hear(&world)?;
        said.add(&world.impacts())?;
        let slide =
            world.move_and_slide((&walker, &walks), Vec3::new(0.05, -0.02, 0.03), &walk, &Filter3::new());
        said.add(&slide)?;
        walks = slide.pose;
        let down = Ray3::new(walks.position() + DVec3::Y, Vec3::new(0.3, -1.0, 0.1))?;
        said.add(&world.cast_ray(&down, 50.0, &Filter3::new()))?;
        said.add(&world.cast_shape((&walker, &walks), Vec3::new(3.0, -2.0, 1.0), &Filter3::new()))?;
        said.add(&world.closest(walks.position(), 2.0, &Filter3::new()))?;
    }
    Ok(said.0)
}
