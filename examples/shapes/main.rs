//! Draws every shape in contact with every other: `cargo run --release --example shapes`.
//!
//! The second body of a pair is lowered on the first until they overlap by a few centimetres, and the engine finds
//! their contact points. Each of these is then checked against both surfaces: a point that is off a surface, or no
//! point at all where bodies touch, ends the program with an error. `--docs` also draws the small pictures for the
//! documentation of the shapes.

mod camera;
mod canvas;
mod flat;
mod kinds;
mod matrix;
mod order;
mod pages;
mod round;
mod solid;
mod surface;
mod tint;
mod touch;

use asunder_examples::output::write;
use clap::Parser;
use kinds::Kind;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use touch::Attitude::{Across, Edge, Flat, Over, Vertex};
use touch::{Attitude, Touch, TouchError, touch2, touch3};

/// Draws every shape in contact with every other, with contact points and normals, and lists the pairs.
#[derive(Parser)]
#[command(name = "shapes")]
struct Options {
    /// Where to put the picture
    #[arg(long, value_name = "FILE", default_value = "target/shapes.svg")]
    svg: PathBuf,
    /// Where to put a small picture of each shape as well
    #[arg(long, value_name = "DIR")]
    docs: Option<PathBuf>,
}

/// How B lies on A: a row for each A in the order of [`kinds::solids`], which begins with A itself.
const ATTITUDES3: [&[Attitude]; 10] = [
    &[Over, Over, Flat, Flat, Edge, Flat, Flat, Flat, Flat, Flat],
    &[Over, Edge, Edge, Vertex, Edge, Flat, Flat, Flat, Edge],
    &[Flat, Flat, Edge, Edge, Flat, Flat, Edge, Edge],
    &[Edge, Flat, Vertex, Flat, Flat, Vertex, Flat],
    &[Flat, Edge, Flat, Flat, Edge, Edge],
    &[Vertex, Edge, Flat, Flat, Edge],
    &[Across, Flat, Flat, Across],
    &[Flat, Flat, Flat],
    &[Edge, Edge],
    &[Across],
];

/// The same for [`kinds::flats`].
const ATTITUDES2: [&[Attitude]; 9] = [
    &[Over, Over, Flat, Edge, Flat, Edge, Flat, Flat, Edge],
    &[Over, Edge, Edge, Flat, Edge, Flat, Flat, Flat],
    &[Flat, Flat, Edge, Edge, Edge, Flat, Edge],
    &[Edge, Flat, Edge, Flat, Edge, Edge],
    &[Flat, Edge, Flat, Flat, Edge],
    &[Edge, Flat, Flat, Edge],
    &[Flat, Flat, Flat],
    &[Flat, Edge],
    &[Edge],
];

fn main() -> ExitCode {
    // Wrong options end here, with a message and exit code 2.
    let options = Options::parse();
    match run(&options) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("shapes: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let (solids, flats) = (kinds::solids()?, kinds::flats()?);
    let touches3 = all_pairs(&solids, &ATTITUDES3, touch3)?;
    let touches2 = all_pairs(&flats, &ATTITUDES2, touch2)?;
    write(&options.svg, &matrix::draw(&touches3, &touches2))?;
    if let Some(folder) = &options.docs {
        for (name, text) in pages::pages()? {
            write(&folder.join(name), &text)?;
        }
    }
    println!("A               on B             separation   points");
    let (in_space, in_plane) = (print(&touches3), print(&touches2));
    println!("picture         {}", options.svg.display());
    in_space?;
    in_plane?;
    Ok(())
}

/// Each kind with itself and all later kinds.
fn all_pairs<'a, S, P>(
    kinds: &'a [Kind<S>],
    attitudes: &[&[Attitude]],
    touch: impl Fn(&'a Kind<S>, &'a Kind<S>, Attitude) -> Result<Touch<'a, S, P>, TouchError>,
) -> Result<Vec<Vec<Touch<'a, S, P>>>, TouchError> {
    let rows = kinds.iter().enumerate().zip(attitudes).map(|((row, a), attitudes)| {
        let pairs = kinds.iter().skip(row).zip(*attitudes);
        pairs.map(|(b, &attitude)| touch(a, b, attitude)).collect()
    });
    rows.collect()
}

/// Prints a line for each pair. Returns the first pair that is not as it should be, after all are listed.
fn print<S, P>(touches: &[Vec<Touch<'_, S, P>>]) -> Result<(), TouchError> {
    let mut result = Ok(());
    for touch in touches.iter().flatten() {
        let (a, b, points) = (touch.a.name, touch.b.name, touch.marks.len());
        println!("{a:<15} {b:<15} {:>9.4} m {points:>8}", touch.separation);
        if let Err(error) = touch.check() {
            println!("    {error}");
            result = result.and(Err(error));
        }
    }
    result
}
