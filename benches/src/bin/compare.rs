//! Prints our times beside parry3d's: `compare broad|narrow|shapes|world|mesh|certain [--json] [--quick]
//! [--save]`.

use asunder_benches::broad::growth::{self, GrowthRow};
use asunder_benches::broad::queries;
use asunder_benches::clock::Effort;
use asunder_benches::judge::Judge;
use asunder_benches::report::cpu::Processor;
use asunder_benches::report::{Data, KeptRow, kept};
use asunder_benches::row::{Row, heading, heading_with_accuracy, heading_with_figures};
use asunder_benches::{broad, certain, flat, mesh, narrow, shapes, world};
use clap::{Args, Parser, Subcommand};
use std::error::Error;
use std::path::Path;

/// Our time beside parry3d's in the same run: thread CPU time, variants in turns, medians. Only the ratios count.
#[derive(Parser)]
#[command(name = "compare")]
struct Cli {
    #[command(subcommand)]
    part: Part,
}

#[derive(Subcommand)]
enum Part {
    /// All overlapping pairs of moving boxes.
    Broad(BroadOptions),
    /// One question about many pairs of shapes.
    Narrow(Options),
    /// Every pair of shapes, and what is asked of one alone.
    Shapes(Options),
    /// Whole frames, from poses to contact points.
    World(WorldOptions),
    /// Bodies, questions, rays and casts on triangle meshes, and making one.
    Mesh(Options),
    /// What certainty costs: yes or no that is never wrong, beside the first tier alone.
    Certain(Options),
}

#[derive(Args)]
struct BroadOptions {
    #[command(flatten)]
    all: Options,
    /// Also a million boxes: some minutes more.
    #[arg(long)]
    large: bool,
    /// Our own wall-clock time on so many threads beside one, in place of the peer.
    #[arg(long, value_parser = at_least_one, value_name = "COUNT")]
    threads: Option<usize>,
    /// Boxes laid out to hurt, without the peer: how our time a box grows with their number.
    #[arg(long, conflicts_with_all = ["threads", "save"])]
    hurt: bool,
}

#[derive(Args)]
struct WorldOptions {
    #[command(flatten)]
    all: Options,
    /// Our wall-clock time on so many threads beside one, and in space beside the peer on one.
    #[arg(long, value_parser = at_least_one, value_name = "COUNT")]
    threads: Option<usize>,
}

#[derive(Args)]
struct Options {
    /// One line of JSON a row instead of a table.
    #[arg(long)]
    json: bool,
    /// Some tenths of a second a row and smaller sets: a look, no figure to quote.
    #[arg(long)]
    quick: bool,
    /// Only rows whose name contains this.
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
    /// Keep the rows in `benches/results/<cpu>/compare.csv`, in place of those of the same names: README shows some.
    /// Those of `certain`, and of several threads, are not kept.
    #[arg(long, conflicts_with = "quick")]
    save: bool,
}

impl Part {
    const fn options(&self) -> &Options {
        match self {
            Self::Broad(broad) => &broad.all,
            Self::World(world) => &world.all,
            Self::Narrow(options) | Self::Shapes(options) | Self::Mesh(options) | Self::Certain(options) => {
                options
            }
        }
    }

    const fn name(&self) -> &'static str {
        match self {
            Self::Broad(_) => "broad",
            Self::Narrow(_) => "narrow",
            Self::Shapes(_) => "shapes",
            Self::World(_) => "world",
            Self::Mesh(_) => "mesh",
            Self::Certain(_) => "certain",
        }
    }

    /// The names of all its rows.
    fn row_names(&self) -> Vec<String> {
        let effort = self.options().effort();
        match self {
            Self::Broad(BroadOptions { hurt: true, large, .. }) => {
                growth::cases(*large).iter().map(growth::name).collect()
            }
            Self::Broad(BroadOptions { threads, large, .. }) => {
                let cases = broad::cases(&effort, *large);
                let queries = if threads.is_none() { queries::cases(&effort) } else { Vec::new() };
                cases.iter().map(broad::name).chain(queries.iter().map(queries::name)).collect()
            }
            Self::Narrow(_) => {
                narrow::cases().iter().map(narrow::name).chain(flat::cases().iter().map(flat::name)).collect()
            }
            Self::Shapes(_) => shapes::cases().iter().map(shapes::name).collect(),
            Self::World(_) => world::cases().iter().map(world::name).collect(),
            Self::Mesh(_) => mesh::cases(&effort).iter().map(mesh::name).collect(),
            Self::Certain(_) => certain::cases().iter().map(certain::name).collect(),
        }
    }

    fn heading(&self) -> String {
        match self {
            Self::Certain(_) => certain::heading(),
            Self::Narrow(_) | Self::Shapes(_) => heading_with_accuracy(),
            Self::Broad(_) => heading_with_figures(),
            Self::World(_) => world::heading(),
            Self::Mesh(_) => heading(),
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let part = Cli::parse().part;
    let options = part.options();
    let names = part.row_names();
    if !names.iter().any(|name| name.contains(&options.only)) {
        return Err(
            format!("no row has {:?} in its name; there are {}", options.only, names.join(", ")).into()
        );
    }
    // One thread, so that its CPU time is all the time spent.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    if let Part::Broad(BroadOptions { hurt: true, large, .. }) = part {
        pool.install(|| compare_growth(large, options));
        return Ok(());
    }
    if !options.json {
        println!("{}", part.heading());
    }
    if let Part::Broad(BroadOptions { threads: Some(threads), large, .. }) = part {
        return compare_threads(threads, large, options);
    }
    if let Part::World(WorldOptions { threads: Some(threads), .. }) = part {
        return compare_frames_on_threads(threads, options);
    }
    pool.install(|| compare(&part).map_err(|error| error.to_string())).map_err(Into::into)
}

/// A number of threads, of which there must be at least one.
fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse::<usize>() {
        Ok(0) => Err("there is no work without a thread: give 1 or more".to_string()),
        other => other.map_err(|error: core::num::ParseIntError| error.to_string()),
    }
}

/// Rows of the broad phase with several threads.
fn compare_threads(threads: usize, large: bool, options: &Options) -> Result<(), Box<dyn Error>> {
    for case in broad::cases(&options.effort(), large) {
        if broad::name(&case).contains(&options.only) {
            show(&broad::threads::measure(&case, threads, &options.effort())?, options);
        }
    }
    Ok(())
}

/// Rows of boxes laid out to make a broad phase slow.
fn compare_growth(large: bool, options: &Options) {
    if !options.json {
        println!("{}", GrowthRow::heading());
    }
    for case in growth::cases(large).iter().filter(|case| growth::name(case).contains(&options.only)) {
        let row = growth::measure(case, &options.effort());
        println!("{}", if options.json { row.to_json() } else { row.to_text() });
    }
}

/// Rows of whole frames with several threads.
fn compare_frames_on_threads(threads: usize, options: &Options) -> Result<(), Box<dyn Error>> {
    for case in world::cases().into_iter().filter(|case| world::name(case).contains(&options.only)) {
        show(&world::threads::measure(&case, case.usual_count(), threads, &options.effort())?, options);
    }
    Ok(())
}

impl Options {
    const fn effort(&self) -> Effort {
        if self.quick { Effort::quick() } else { Effort::full() }
    }
}

fn compare(part: &Part) -> Result<(), Box<dyn Error>> {
    let options = part.options();
    let mut rows = Vec::new();
    let mut tell = |row: Row| {
        show(&row, options);
        rows.push(KeptRow::new(part.name(), &row));
    };
    measure(part, &mut tell)?;
    if options.save { save(rows) } else { Ok(()) }
}

/// Puts rows among those that are stored for this processor.
fn save(rows: Vec<KeptRow>) -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("results").join(Processor::here().folder());
    let mut data = Data::read(&folder)?;
    kept::put(&mut data.kept, rows);
    data.write(&folder)
}

fn measure(part: &Part, tell: &mut impl FnMut(Row)) -> Result<(), Box<dyn Error>> {
    let options = part.options();
    let effort = options.effort();
    let wanted = |name: &str| name.contains(&options.only);
    match part {
        Part::Broad(BroadOptions { large, .. }) => {
            let cases = broad::cases(&effort, *large);
            for case in cases.iter().filter(|case| wanted(&broad::name(case))) {
                tell(broad::measure(case, &effort));
            }
            for case in queries::cases(&effort).iter().filter(|case| wanted(&queries::name(case))) {
                tell(queries::measure(case, &effort));
            }
        }
        Part::Narrow(_) => {
            let mut judge = Judge::default();
            for case in narrow::cases().iter().filter(|case| wanted(&narrow::name(case))) {
                tell(narrow::measure(case, &effort, &mut judge));
            }
            for case in flat::cases().iter().filter(|case| wanted(&flat::name(case))) {
                tell(flat::measure(case, &effort));
            }
        }
        Part::Shapes(_) => {
            let mut judge = Judge::default();
            for case in shapes::cases().iter().filter(|case| wanted(&shapes::name(case))) {
                tell(shapes::measure(case, &effort, &mut judge)?);
            }
        }
        Part::Certain(_) => {
            for case in certain::cases().iter().filter(|case| wanted(&certain::name(case))) {
                let row = certain::measure(case, &effort);
                println!("{}", if options.json { row.to_json() } else { row.to_text() });
            }
        }
        Part::Mesh(_) => {
            for case in mesh::cases(&effort).iter().filter(|case| wanted(&mesh::name(case))) {
                tell(mesh::measure(case, &effort)?);
            }
        }
        Part::World(_) => {
            for case in world::cases().iter().filter(|case| wanted(&world::name(case))) {
                tell(world::measure(case, case.usual_count(), &effort)?);
            }
        }
    }
    Ok(())
}

fn show(row: &Row, options: &Options) {
    println!("{}", if options.json { row.to_json() } else { row.to_text() });
}
