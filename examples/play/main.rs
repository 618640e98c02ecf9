//! Plays a scene and says what it cost: `cargo run --release --example play -- --help`.
//!
//! The engine answers what touches; the game around it, here, gives bodies mass and lets contacts push them apart.
//! The default scene drops crates, rocks, prisms, balls, capsules and hammers on a floor. Scene files are described
//! in `asunder_scenes::level`.

mod heap;

use asunder::{Collider, Collider2, Collider3, Layers, Plane, Space, Volume};
use asunder_examples::game::{Game, MARGIN};
use asunder_examples::{picture, report};
use asunder_scenes::level::{Level, Level2, Level3, LevelLayers};
use clap::Parser;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

const SEED: u64 = 20_260;

/// Steps a scene with the asunder collision engine, then prints what each stage cost and what touches.
#[derive(Parser)]
#[command(name = "play")]
struct Options {
    /// How many steps of 1/60 s to play
    #[arg(long, value_name = "N", default_value_t = 300)]
    steps: u32,
    /// How many bodies the default scene drops, up to 100,000
    #[arg(long, value_name = "N", default_value_t = 2000, conflicts_with = "scene",
          value_parser = clap::value_parser!(u32).range(0..=100_000))]
    bodies: u32,
    /// A scene file to play instead, in 2D or 3D
    #[arg(long, value_name = "FILE.json")]
    scene: Option<PathBuf>,
    /// Where to put a picture of the last frame
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

fn main() -> ExitCode {
    // Wrong options end here, with a message and exit code 2.
    let options = Options::parse();
    match play(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("play: {error}");
            ExitCode::from(2)
        }
    }
}

fn play(options: &Options) -> Result<(), Box<dyn Error>> {
    let level = match &options.scene {
        Some(file) => read_level(file)?,
        None => Level::Volume(heap::heap(options.bodies as usize, SEED)?),
    };
    let picture = match level {
        Level::Plane(level) => {
            let mut game = plane_game(&level)?;
            report::run(&mut game, &level.name, options.steps);
            options.svg.as_ref().map(|_| picture::plane::draw(&game.world))
        }
        Level::Volume(level) => {
            let mut game = volume_game(&level)?;
            report::run(&mut game, &level.name, options.steps);
            options.svg.as_ref().map(|_| picture::volume::draw(&game.world))
        }
    };
    if let (Some(file), Some(picture)) = (&options.svg, picture) {
        picture::save(file, &picture)?;
    }
    Ok(())
}

fn read_level(file: &Path) -> Result<Level, Box<dyn Error>> {
    let json = std::fs::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(Level::from_json(json).map_err(|error| format!("{}: {error}", file.display()))?)
}

fn plane_game(level: &Level2) -> Result<Game<Plane>, Box<dyn Error>> {
    let mut game = Game::new(level.gravity);
    for (number, body) in level.bodies.iter().enumerate() {
        let collider = Collider2::new(body.shape.clone()).at(body.pose).margin(margin(body.sensor))?;
        let collider = with_flags(collider, body.fixed, body.sensor, body.layers).user_data(body.user_data);
        game.add(collider, &body.shape, &body.pose, body.linear_velocity, body.angular_velocity)
            .map_err(|error| format!("bodies[{number}].shape: {error}"))?;
    }
    Ok(game)
}

fn volume_game(level: &Level3) -> Result<Game<Volume>, Box<dyn Error>> {
    let mut game = Game::new(level.gravity);
    for (number, body) in level.bodies.iter().enumerate() {
        let collider = Collider3::new(body.shape.clone()).at(body.pose).margin(margin(body.sensor))?;
        let collider = with_flags(collider, body.fixed, body.sensor, body.layers).user_data(body.user_data);
        game.add(collider, &body.shape, &body.pose, body.linear_velocity, body.angular_velocity)
            .map_err(|error| format!("bodies[{number}].shape: {error}"))?;
    }
    Ok(game)
}

/// Sensors have none: their events say exactly when something is inside.
fn margin(is_sensor: bool) -> f32 {
    if is_sensor { 0.0 } else { MARGIN }
}

fn with_flags<S: Space>(
    mut collider: Collider<S>,
    fixed: bool,
    sensor: bool,
    layers: Option<LevelLayers>,
) -> Collider<S> {
    if fixed {
        collider = collider.fixed();
    }
    if sensor {
        collider = collider.sensor();
    }
    match layers {
        Some(LevelLayers { member_of, collides_with }) => {
            collider.layers(Layers { member_of, collides_with })
        }
        None => collider,
    }
}
