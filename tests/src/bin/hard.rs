//! Prints what we and parry3d get wrong on hard cases, family by family: `hard [--cases N] [--out DIR] [--only NAME]`.
//!
//! Writes `hard.json` and `hard.md` into a folder. Every count depends on the seed alone; the times do not.

use asunder_scenes::hard::{FAMILIES2, FAMILIES3};
use asunder_tests::report::{
    FaultKind, Hard, Row, Scope, Tally, header, markdown, shares, tally, times, weight,
};
use clap::Parser;
use std::error::Error;
use std::path::{Path, PathBuf};

/// What we and parry3d get wrong on hard cases, by how much, and at what cost.
#[derive(Parser)]
#[command(name = "hard")]
struct Cli {
    /// Total number of cases, shared out among the families; those with very many vertices get fewer.
    #[arg(long, default_value_t = 1_000_000)]
    cases: usize,
    /// Separations are judged on every k-th case of a level, since that takes far longer than overlap; this is k.
    #[arg(long, default_value_t = 10)]
    truth_every: usize,
    /// The folder for `hard.json` and `hard.md`.
    #[arg(long, value_name = "DIR", default_value = "target/hard")]
    out: PathBuf,
    /// Only families whose title contains this.
    #[arg(long, value_name = "NAME", default_value = "")]
    only: String,
    /// The first seed of every family.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The date of the run, to be printed.
    #[arg(long)]
    date: Option<String>,
    /// Without parry3d.
    #[arg(long)]
    alone: bool,
    /// Cases of a family that are timed; 0 for no times.
    #[arg(long, default_value_t = 960)]
    timed: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let cli = Cli::parse();
    // Panics are counted, and ours are reported with the case that caused them.
    std::panic::set_hook(Box::new(|_| {}));
    let wanted = |title: &str| title.contains(&cli.only);
    let in_space: Vec<_> = FAMILIES3.iter().filter(|family| wanted(&family.title())).collect();
    let in_plane: Vec<_> = FAMILIES2.iter().filter(|family| wanted(&family.title())).collect();
    let weights = in_space.iter().map(|family| weight(*family));
    let weights: Vec<f64> = weights.chain(in_plane.iter().map(|family| weight(*family))).collect();
    let mut shares = shares(&weights, cli.cases).into_iter();
    let mut scope = || {
        let cases = shares.next().unwrap_or(0);
        Scope { cases, truth_every: cli.truth_every, seed: cli.seed, peers: !cli.alone }
    };
    println!("{}", header(cli.truth_every));
    let mut rows = Vec::new();
    let mut complaints = Vec::new();
    for family in in_space {
        report(family, &scope(), cli.timed, &mut rows, &mut complaints);
    }
    for family in in_plane {
        report(family, &scope(), cli.timed, &mut rows, &mut complaints);
    }
    for complaint in &complaints {
        println!("{complaint}");
    }
    write(&cli, &rows)
}

/// Runs one family, prints its line, and keeps what was found.
fn report<H: Hard>(
    family: &H,
    scope: &Scope,
    timed: usize,
    rows: &mut Vec<Row>,
    complaints: &mut Vec<String>,
) {
    let found: Tally = tally(family, scope);
    let row = Row::new(&found, &times(family, timed, scope.seed));
    println!("{}", row.to_line());
    complaints.extend(FaultKind::ALL.into_iter().filter_map(|kind| found.complaint(kind)));
    rows.push(row);
}

fn write(cli: &Cli, rows: &[Row]) -> Result<(), Box<dyn Error>> {
    std::fs::create_dir_all(&cli.out)?;
    let path = |name: &str| -> PathBuf { Path::new(&cli.out).join(name) };
    let lines: Result<Vec<String>, _> = rows.iter().map(serde_json::to_string).collect();
    std::fs::write(path("hard.json"), format!("[\n{}\n]\n", lines?.join(",\n")))?;
    std::fs::write(path("hard.md"), markdown(rows, cli.truth_every, &how_made(cli)))?;
    println!("\nwritten: {} and {}", path("hard.json").display(), path("hard.md").display());
    Ok(())
}

/// The command, the machine and the date, as far as they are known.
fn how_made(cli: &Cli) -> Vec<String> {
    let Cli { cases, truth_every, only, seed, timed, .. } = cli;
    let only = if only.is_empty() { String::new() } else { format!(" --only {only}") };
    let mut made = vec![format!(
        "`cargo run --release -p asunder-tests --bin hard -- --cases {cases} --truth-every {truth_every} --seed {seed} \
         --timed {timed}{only}`"
    )];
    made.push(format!("{}, {}", machine(), std::env::consts::ARCH));
    made.extend(cli.date.clone());
    made
}

/// The processor's name where the system gives it, and the number of threads.
fn machine() -> String {
    let told = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = told.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{}, {threads} threads", name.unwrap_or("processor unknown"))
}
