//! Plays a scene and prints what it cost: `cargo run --release --example play -- --help`.
//!
//! The engine finds what touches. The stepper around it (`asunder_examples::stepper`) gives bodies mass and lets
//! contacts push them apart; `asunder_examples::game` drives bodies, counts events and handles bullets. The default
//! scene drops crates, rocks, prisms, balls, capsules and hammers on a floor. Named scenes are described in
//! `asunder_scenes::stages`, scene files in `asunder_scenes::level`, recordings in `asunder_examples::recording`.

mod heap;

use asunder_examples::game::{Game, share_work};
use asunder_examples::opened::{AnyGame, SEED, scene};
use asunder_examples::playable::{InSpace, Playable};
use asunder_examples::recording::{Head, read_head};
use asunder_examples::replay::{Recorder, replay};
use asunder_examples::report::Times;
use asunder_examples::{output, picture, report};
use asunder_scenes::stages::{Scene, Stage};
use clap::Parser;
use std::error::Error;
use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The name of the default scene.
const HEAP: &str = "heap";
const HEAP_SIZE: u32 = 2000;
/// The most bodies that a named scene may be asked for.
const MAX_SIZE: u32 = 2_000_000;

/// Steps a scene with the asunder collision engine, then prints what each stage cost and what touches.
#[derive(Parser)]
#[command(name = "play")]
struct Options {
    /// How many steps of 1/60 s to play
    #[arg(long, value_name = "N", default_value_t = 300)]
    steps: u32,
    /// How many bodies a named scene has, up to 2,000,000: its usual number at first
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=i64::from(MAX_SIZE)))]
    bodies: Option<u32>,
    /// The scene: a name that --list knows, or a scene file, in 2D or 3D
    #[arg(long, value_name = "NAME|FILE.json", default_value = HEAP)]
    scene: String,
    /// Names the scenes, and their usual numbers of bodies
    #[arg(long)]
    list: bool,
    /// Where to put a picture of the last frame
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Where to write the poses of each step
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Plays a recording: its scene, its poses, no solver
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "bodies", "record"])]
    replay: Option<PathBuf>,
    /// Prints one line of JSON in place of the summary
    #[arg(long)]
    json: bool,
}

fn main() -> ExitCode {
    // Wrong options end here, with a message and exit code 2.
    let options = Options::parse();
    share_work();
    let outcome = match &options.replay {
        _ if options.list => {
            list();
            Ok(())
        }
        Some(file) => play_again(file, &options),
        None => play(&options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("play: {error}");
            ExitCode::from(2)
        }
    }
}

fn list() {
    println!("{HEAP:<18} {HEAP_SIZE:>9}  crates, rocks, prisms, balls, capsules and hammers fall on a floor");
    for stage in Stage::ALL {
        println!("{:<18} {:>9}  {}", stage.name(), stage.usual_size(), stage.about());
    }
}

/// The scene of a name, and its size.
fn open(name: &str, size: Option<u32>) -> Result<(Scene, u64), Box<dyn Error>> {
    if name == HEAP {
        let size = size.unwrap_or(HEAP_SIZE);
        return Ok((Scene::Volume(heap::heap(size as usize, SEED)?.into()), u64::from(size)));
    }
    let usual = Stage::by_name(name).map_or(0, |stage| stage.usual_size() as u64);
    Ok((scene(name, size.map(|size| size as usize))?, size.map_or(usual, u64::from)))
}

fn play(options: &Options) -> Result<(), Box<dyn Error>> {
    if Path::new(&options.scene).extension().is_some() && options.bodies.is_some() {
        return Err("a scene file says itself how many bodies there are: leave out --bodies".into());
    }
    let (scene, size) = open(&options.scene, options.bodies)?;
    let head = |dimension, bodies: usize| Head {
        dimension,
        size,
        bodies: bodies as u32,
        name: options.scene.clone(),
    };
    let picture = match (&scene, AnyGame::of(&scene)?) {
        (Scene::Plane(scene), AnyGame::Plane(mut game)) => {
            let times = step(&mut game, options, &head(2, scene.level.bodies.len()))?;
            tell(&game, &scene.level.name, &times, (options, scene.room));
            options.svg.as_ref().map(|_| picture::plane::draw(&game.stepper.world))
        }
        (Scene::Volume(scene), AnyGame::Volume(mut game)) => {
            let times = step(&mut game, options, &head(3, scene.level.bodies.len()))?;
            tell(&game, &scene.level.name, &times, (options, scene.room));
            options.svg.as_ref().map(|_| picture::volume::draw(&game.stepper.world))
        }
        _ => None,
    };
    save(options, picture)
}

fn step<S: Playable>(game: &mut Game<S>, options: &Options, head: &Head) -> Result<Times, Box<dyn Error>> {
    let Some(file) = &options.record else {
        return report::timed(game, options.steps, |_| Ok(()));
    };
    let at = |error: &dyn Error| format!("{}: {error}", file.display());
    let to = BufWriter::new(output::create(file)?);
    let mut recorder = Recorder::new(to, head, game).map_err(|error| at(&error))?;
    let times =
        report::timed(game, options.steps, |game| recorder.record(game)).map_err(|error| at(&error))?;
    recorder.finish().map_err(|error| at(&error))?;
    if !options.json {
        println!("recording      {}", file.display());
    }
    Ok(times)
}

fn tell<S: Playable, V: InSpace>(
    game: &Game<S>,
    name: &str,
    times: &Times,
    (options, room): (&Options, (V, V)),
) {
    if options.json {
        println!("{}", report::json(name, times, game.stepper.world.stats()));
    } else {
        report::print(game, name, times, game.outside(room));
    }
}

fn play_again(file: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let at = |error: &dyn Error| format!("{}: {error}", file.display());
    let mut from = BufReader::new(File::open(file).map_err(|error| at(&error))?);
    let head = read_head(&mut from).map_err(|error| at(&error))?;
    let is_named = head.name == HEAP || Stage::by_name(&head.name).is_some();
    let size = u32::try_from(head.size).ok().filter(|&size| size <= MAX_SIZE);
    if is_named && size.is_none() {
        return Err(format!("{}: a scene of {} bodies: at most {MAX_SIZE}", file.display(), head.size).into());
    }
    let size = size.filter(|_| is_named);
    let (scene, _) =
        open(&head.name, size).map_err(|error| format!("{}: its scene: {error}", file.display()))?;
    let told = |times: &Times, stats| {
        if options.json {
            println!("{}", report::json(&head.name, times, stats));
        }
    };
    let picture = match (AnyGame::of(&scene)?, head.dimension) {
        (AnyGame::Plane(mut game), 2) => {
            let times = replay(&mut game, &mut from, &head, options.steps).map_err(|error| at(&*error))?;
            told(&times, game.stepper.world.stats());
            if !options.json {
                report::print_replay(&game.stepper.world, &head.name, &times);
            }
            options.svg.as_ref().map(|_| picture::plane::draw(&game.stepper.world))
        }
        (AnyGame::Volume(mut game), 3) => {
            let times = replay(&mut game, &mut from, &head, options.steps).map_err(|error| at(&*error))?;
            told(&times, game.stepper.world.stats());
            if !options.json {
                report::print_replay(&game.stepper.world, &head.name, &times);
            }
            options.svg.as_ref().map(|_| picture::volume::draw(&game.stepper.world))
        }
        _ => return Err(format!("{}: its scene has another dimension than it says", file.display()).into()),
    };
    save(options, picture)
}

fn save(options: &Options, picture: Option<String>) -> Result<(), Box<dyn Error>> {
    match (&options.svg, picture) {
        (Some(file), Some(picture)) => picture::save(file, &picture),
        _ => Ok(()),
    }
}
