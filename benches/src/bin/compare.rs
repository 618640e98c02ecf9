//! Prints our times beside parry3d's: `compare broad|narrow|world|certain [--json] [--quick]`.

use asunder_benches::clock::Effort;
use asunder_benches::judge::Judge;
use asunder_benches::row::{Row, heading, heading_with_accuracy};
use asunder_benches::{broad, certain, flat, narrow, world};
use clap::{Args, Parser, Subcommand};
use std::error::Error;

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
    Broad(Options),
    /// One question about many pairs of shapes.
    Narrow(Options),
    /// Whole frames, from poses to contact points.
    World(Options),
    /// What certainty costs: yes or no that is never wrong, beside the first tier alone.
    Certain(Options),
}

#[derive(Args, Clone)]
struct Options {
    /// One line of JSON a row instead of a table.
    #[arg(long)]
    json: bool,
    /// Some tenths of a second a row and smaller sets: a look, no figure to quote.
    #[arg(long)]
    quick: bool,
    /// Broad phase: also a million boxes.
    #[arg(long)]
    large: bool,
    /// Only rows whose name contains this.
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let cli = Cli::parse();
    // One thread, so that its CPU time is all the time there is.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    pool.install(|| compare(&cli.part)).map_err(|error| error.to_string().into())
}

fn compare(part: &Part) -> Result<(), asunder::MarginError> {
    let (Part::Broad(options) | Part::Narrow(options) | Part::World(options) | Part::Certain(options)) = part;
    let effort = if options.quick { Effort::quick() } else { Effort::full() };
    let wanted = |name: &str| name.contains(&options.only);
    if !options.json {
        let heading = match part {
            Part::Certain(_) => certain::heading(),
            Part::Narrow(_) => heading_with_accuracy(),
            Part::Broad(_) | Part::World(_) => heading(),
        };
        println!("{heading}");
    }
    match part {
        Part::Broad(_) => {
            let cases = broad::cases(&effort, options.large);
            for case in cases.iter().filter(|case| wanted(&broad::name(case))) {
                show(&broad::measure(case, &effort), options);
            }
        }
        Part::Narrow(_) => {
            let mut judge = Judge::default();
            for case in narrow::cases().iter().filter(|case| wanted(&narrow::name(case))) {
                show(&narrow::measure(case, &effort, &mut judge), options);
            }
            for case in flat::cases().iter().filter(|case| wanted(&flat::name(case))) {
                show(&flat::measure(case, &effort), options);
            }
        }
        Part::Certain(_) => {
            for case in certain::cases().iter().filter(|case| wanted(&certain::name(case))) {
                let row = certain::measure(case, &effort);
                println!("{}", if options.json { row.to_json() } else { row.to_text() });
            }
        }
        Part::World(_) => {
            for case in world::cases().iter().filter(|case| wanted(&world::name(case))) {
                show(&world::measure(case, case.0.usual_count(), &effort)?, options);
            }
        }
    }
    Ok(())
}

fn show(row: &Row, options: &Options) {
    println!("{}", if options.json { row.to_json() } else { row.to_text() });
}
