//! Reads a level from a Wavefront OBJ file and drops things onto it: `cargo run --release --example level`.
//!
//! The level is one `TriMesh`, in one fixed body. Things roll and slide over its triangles as if there were no seams.

mod obj;

use asunder::glam::DVec3;
use asunder::{Collider3, MeshError, Pose3, Shape3, TriMesh, Volume};
use asunder_examples::game::{Game, share_work};
use asunder_examples::stepper::MARGIN;
use asunder_examples::{picture, report, things};
use asunder_scenes::random::Random;
use clap::Parser;
use core::convert::Infallible;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

const SEED: u64 = 20_261;
/// The number of different shapes; bodies share them.
const VARIANTS: usize = 96;
/// Metres between things before they fall.
const SPACING: f64 = 1.1;
/// The file that is used if none is given.
const VILLAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/levels/village.obj");

/// Drops things onto a level that is read from a Wavefront OBJ file, then prints what each stage cost.
#[derive(Parser)]
#[command(name = "level")]
struct Options {
    /// The level: metres, y up, faces counter-clockwise as seen from where one walks
    #[arg(value_name = "FILE.obj", default_value = VILLAGE, hide_default_value = true)]
    file: PathBuf,
    /// How many things to drop, up to 100,000
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(0..=100_000))]
    bodies: u32,
    /// How many steps of 1/60 s to play
    #[arg(long, value_name = "N", default_value_t = 600)]
    steps: u32,
    /// Let things pass through the backs of faces
    #[arg(long)]
    one_sided: bool,
    /// Where to put a picture of the last frame
    #[arg(long, value_name = "FILE", default_value = "target/level.svg")]
    svg: PathBuf,
}

fn main() -> ExitCode {
    // Wrong options end here, with a message and exit code 2.
    let options = Options::parse();
    share_work();
    match play(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("level: {error}");
            ExitCode::from(2)
        }
    }
}

fn play(options: &Options) -> Result<(), Box<dyn Error>> {
    let of_file = |error: &dyn Error| format!("{}: {error}", options.file.display());
    let soup = obj::read(&options.file).map_err(|error| of_file(&error))?;
    let mesh = mesh_of(soup, options.one_sided).map_err(|error| of_file(&error))?;
    let dropped = mesh.dropped();
    println!(
        "level          {}: {} vertices, {} triangles ({} without area and {} repeated left out)",
        options.file.display(),
        mesh.vertices().len(),
        mesh.triangles().len(),
        dropped.degenerate,
        dropped.duplicate
    );
    let mut game = Game::<Volume>::new(DVec3::NEG_Y * 9.81);
    let floor = Shape3::from(mesh);
    game.add(Collider3::new(floor.clone()).fixed(), DVec3::ZERO, DVec3::ZERO)?;
    drop_things(&mut game, &floor, options.bodies as usize)?;
    let Ok(times) = report::timed(&mut game, options.steps, |_| Ok::<(), Infallible>(()));
    // Bodies that fell off the level or through it may not be far enough yet to count as having left.
    report::print(&game, "level", &times, game.outside(above(&floor)));
    picture::save(&options.svg, &picture::volume::draw(&game.stepper.world))
}

fn mesh_of(soup: obj::Soup, is_one_sided: bool) -> Result<TriMesh, MeshError> {
    let mesh = TriMesh::new(soup.vertices, soup.triangles)?;
    Ok(if is_one_sided { mesh.one_sided() } else { mesh })
}

/// The level's own bounding box, open at the top.
fn above(floor: &Shape3) -> (DVec3, DVec3) {
    let bounds = floor.bounds(&Pose3::IDENTITY, 0.0);
    (bounds.min.as_dvec3(), DVec3 { y: f64::INFINITY, ..bounds.max.as_dvec3() })
}

/// Puts things in layers above the middle two thirds of the level, each way.
fn drop_things(game: &mut Game<Volume>, floor: &Shape3, count: usize) -> Result<(), Box<dyn Error>> {
    let mut random = Random::new(SEED);
    let shapes: Vec<Shape3> =
        (0..VARIANTS).map(|number| things::shape(number, &mut random)).collect::<Result<_, _>>()?;
    let bounds = floor.bounds(&Pose3::IDENTITY, 0.0);
    let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
    let (middle, reach) = ((low + high) / 2.0, (high - low) / 3.0);
    let across = |reach: f64| (2.0 * reach / SPACING).floor().max(1.0);
    let (columns, rows) = (across(reach.x) as usize, across(reach.z) as usize);
    // Only a third of the places in each layer is taken, so that the things spread as they fall.
    let places = 3 * count;
    let mut free: Vec<usize> = (0..places).collect();
    for number in 0..count {
        let place = free.swap_remove(random.below(free.len()));
        let (column, row, layer) = (place % columns, place / columns % rows, place / (columns * rows));
        let from_middle = |index: usize, count: usize| (index as f64 - (count as f64 - 1.0) / 2.0) * SPACING;
        let height = high.y + 1.0 + layer as f64 * SPACING;
        let position =
            DVec3::new(middle.x + from_middle(column, columns), height, middle.z + from_middle(row, rows));
        let pose = Pose3::new(position, random.rotation())?;
        let collider = Collider3::new(shapes[number % VARIANTS].clone()).at(pose).margin(MARGIN)?;
        game.add(collider, DVec3::ZERO, DVec3::ZERO)?;
    }
    Ok(())
}
