//! Opens a scene as a game: stages by name, and scene files.

use crate::game::Game;
use crate::playable::{InSpace, Playable};
use crate::stepper::MARGIN;
use asunder::{Collider, Collider2, Collider3, Layers, Plane, Space, Volume};
use asunder_scenes::level::{Level, LevelBody, LevelLayers};
use asunder_scenes::stages::{Path2, Path3, Scene, Scene2, Scene3, SceneOf, Stage};
use std::error::Error;
use std::path::Path;

/// The seed of every stage opened by name.
pub const SEED: u64 = 20_260;

/// A game of either dimension.
///
/// ```
/// use asunder_examples::opened::{AnyGame, scene};
/// use asunder_scenes::stages::Stage;
/// let AnyGame::Volume(mut game) = AnyGame::of(&scene("stack", Some(5))?)? else { unreachable!() };
/// game.update();
/// (0..10).for_each(|_| game.step(1.0 / 60.0));
/// assert_eq!((game.len(), game.counts.left), (6, 0));
/// assert!(scene("no such stage", None).is_err_and(|error| error.to_string().contains("no such stage")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub enum AnyGame {
    /// A game in the plane.
    Plane(Game<Plane>),
    /// A game in space.
    Volume(Game<Volume>),
}

impl AnyGame {
    /// The game of a scene, not updated yet.
    ///
    /// # Errors
    /// A body that moves and has no mass.
    pub fn of(scene: &Scene) -> Result<Self, Box<dyn Error>> {
        Ok(match scene {
            Scene::Plane(scene) => Self::Plane(plane(scene)?),
            Scene::Volume(scene) => Self::Volume(volume(scene)?),
        })
    }
}

/// The stage of that name, with the given size or its usual one; or the scene of a file, which has its own size.
///
/// # Errors
/// A name that is neither a stage nor a file, or what is wrong with the file.
pub fn scene(name: &str, size: Option<usize>) -> Result<Scene, Box<dyn Error>> {
    if let Some(stage) = Stage::by_name(name) {
        return Ok(stage.build(size.unwrap_or_else(|| stage.usual_size()), SEED));
    }
    let file = Path::new(name);
    if !file.exists() && file.extension().is_none() {
        return Err(format!("{name}: no such stage (--list names them), and no such file").into());
    }
    let json = std::fs::read(file).map_err(|error| format!("{name}: {error}"))?;
    match Level::from_json(json).map_err(|error| format!("{name}: {error}"))? {
        Level::Plane(level) => Ok(Scene::Plane(level.into())),
        Level::Volume(level) => Ok(Scene::Volume(level.into())),
    }
}

/// The game of a scene in the plane.
///
/// # Errors
/// A body that moves and has no mass.
pub fn plane(scene: &Scene2) -> Result<Game<Plane>, Box<dyn Error>> {
    game(scene, |shape, pose| Collider2::new(shape).at(pose), Path2::pose_at)
}

/// The game of a scene in space.
///
/// # Errors
/// A body that moves and has no mass.
pub fn volume(scene: &Scene3) -> Result<Game<Volume>, Box<dyn Error>> {
    game(scene, |shape, pose| Collider3::new(shape).at(pose), Path3::pose_at)
}

type Body<S, Vector, Spin> = LevelBody<<S as Space>::Shape, <S as Space>::Pose, Vector, Spin>;

fn game<S: Playable, Vector: InSpace, Spin: InSpace, P: Clone + Send + 'static>(
    scene: &SceneOf<Vector, Body<S, Vector, Spin>, P>,
    collider: fn(S::Shape, S::Pose) -> Collider<S>,
    pose_at: fn(&P, u32) -> S::Pose,
) -> Result<Game<S>, Box<dyn Error>> {
    let mut game = Game::new(scene.level.gravity.in_space());
    game.stepper.feel = scene.feel;
    for (number, body) in scene.level.bodies.iter().enumerate() {
        let collider = collider(body.shape.clone(), body.pose).margin(margin(body.sensor))?;
        let flags = [body.fixed, body.sensor, scene.bullets.binary_search(&(number as u32)).is_ok()];
        let collider = with_flags(collider, flags, body.layers).user_data(body.user_data);
        let collider = owned(collider, &scene.owners, number);
        game.add(collider, body.linear_velocity.in_space(), body.angular_velocity.in_space())
            .map_err(|error| format!("bodies[{number}].shape: {error}"))?;
    }
    for driver in &scene.drivers {
        let path = driver.path.clone();
        game.drive(driver.body as usize, move |frame| pose_at(&path, frame));
    }
    Ok(game)
}

/// Sensors have no margin: their events then say exactly when something is inside.
fn margin(is_sensor: bool) -> f32 {
    if is_sensor { 0.0 } else { MARGIN }
}

fn owned<S: Space>(collider: Collider<S>, owners: &[(u32, u64)], number: usize) -> Collider<S> {
    match owners.binary_search_by_key(&(number as u32), |owner| owner.0) {
        Ok(index) => collider.owner(owners[index].1),
        Err(_) => collider,
    }
}

fn with_flags<S: Space>(
    mut collider: Collider<S>,
    [is_fixed, is_sensor, is_bullet]: [bool; 3],
    layers: Option<LevelLayers>,
) -> Collider<S> {
    if is_fixed {
        collider = collider.fixed();
    }
    if is_sensor {
        collider = collider.sensor();
    }
    if is_bullet {
        collider = collider.bullet();
    }
    match layers {
        Some(LevelLayers { member_of, collides_with }) => {
            collider.layers(Layers { member_of, collides_with })
        }
        None => collider,
    }
}
