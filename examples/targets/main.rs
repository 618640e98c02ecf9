//! Checks the stepper's targets, one a line: `cargo run --release --example targets`.
//!
//! Stacks stand, a fast ball does not pass a thin wall, no body is lost, and equal runs are equal. A missed target ends
//! the program with exit code 1. With `--csv FILE` it times scenes instead, stage by stage.

use asunder_examples::opened::{AnyGame, SEED};
use asunder_examples::output;
use asunder_examples::report::{self, Times, stages};
use asunder_examples::trials::{Figure, digest, keep, shoot, stand};
use asunder_scenes::stages::Stage;
use clap::Parser;
use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;

/// Checks what the contacts must be good enough for, and times scenes
#[derive(Parser)]
#[command(name = "targets")]
struct Options {
    /// Smaller scenes, and shorter: some seconds in all
    #[arg(long)]
    quick: bool,
    /// Only targets whose name contains this
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
    /// Times scenes in place of checking targets, and writes a table of milliseconds
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Steps before the first that is timed
    #[arg(long, value_name = "N", default_value_t = 120)]
    after: u32,
    /// Steps for each time
    #[arg(long, value_name = "N", default_value_t = 60)]
    steps: u32,
}

fn main() -> ExitCode {
    let options = Options::parse();
    let outcome = match &options.csv {
        Some(file) => write_times(file, &options).map(|()| true),
        None => check_all(&options),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("targets: {error}");
            ExitCode::from(2)
        }
    }
}

/// Whether all targets are met; prints each as soon as it is known.
fn check_all(options: &Options) -> Result<bool, Box<dyn Error>> {
    let mut is_met = true;
    let mut check = |name: &str, trial: &dyn Fn() -> Result<Vec<Figure>, Box<dyn Error>>| {
        if !name.contains(&options.only) {
            return Ok::<(), Box<dyn Error>>(());
        }
        let start = Instant::now();
        for figure in trial()? {
            let verdict = if figure.is_met() { "pass" } else { "MISS" };
            is_met &= figure.is_met();
            let Figure { what, is, most } = figure;
            let seconds = start.elapsed().as_secs_f64();
            println!("{verdict}  {name:<31} {is:>9.5} (at most {most})  {what}, {seconds:.1} s");
        }
        Ok(())
    };
    let (seconds, base) = if options.quick { (6.0, 20) } else { (20.0, 100) };
    check("stack", &|| Ok(stand((Stage::Stack, 20), seconds)?.to_vec()))?;
    if !options.quick {
        check("pyramid of base 40", &|| Ok(stand((Stage::Pyramid, 820), seconds)?.to_vec()))?;
    }
    check(&format!("pyramid of base {base}"), &|| {
        Ok(stand((Stage::Pyramid, base * (base + 1) / 2), seconds)?.to_vec())
    })?;
    check("card_house", &|| Ok(stand((Stage::CardHouse, 40), seconds)?.to_vec()))?;
    check("brick_wall", &|| Ok(stand((Stage::BrickWall, 200), seconds)?.to_vec()))?;
    check("ball at 500 m/s", &|| Ok(vec![shoot(500.0, 100)?]))?;
    for stage in [Stage::Washer, Stage::Junkyard] {
        let (size, seconds) = if options.quick { (500, 4.0) } else { (stage.usual_size(), 10.0) };
        check(stage.name(), &|| Ok(vec![keep(stage, size, seconds)?]))?;
    }
    for stage in Stage::ALL {
        check(&format!("equal {}", stage.name()), &|| Ok(vec![differing(stage)?]))?;
    }
    println!("{}", if is_met { "all targets are met" } else { "a target is missed" });
    Ok(is_met)
}

/// Of runs at 1, 1, 2 and 8 threads, how many end otherwise than the first.
fn differing(stage: Stage) -> Result<Figure, Box<dyn Error>> {
    let size = stage.usual_size().min(600);
    let mut digests = Vec::new();
    for threads in [1, 1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
        // The error is not `Send`; its text is.
        digests.push(pool.install(|| digest(stage, size, 90).map_err(|error| error.to_string()))?);
    }
    let others = digests.iter().filter(|&&digest| digest != digests[0]).count();
    Ok(Figure { what: "runs at 1, 1, 2 and 8 threads that differ", is: others as f64, most: 0.0 })
}

/// Times every stage at its usual size, after some untimed steps.
fn write_times(file: &Path, options: &Options) -> Result<(), Box<dyn Error>> {
    let mut table = String::from("scene,bodies,steps");
    for (stage, _) in stages(&Default::default()) {
        write!(table, ",{stage}_ms")?;
    }
    table.push_str(",update_ms,worst_update_ms,response_ms,step_ms,candidates,contacts\n");
    for stage in Stage::ALL.into_iter().filter(|stage| stage.name().contains(&options.only)) {
        let size = if options.quick { stage.usual_size().min(500) } else { stage.usual_size() };
        let (times, stats) = match AnyGame::of(&stage.build(size, SEED))? {
            AnyGame::Plane(mut game) => {
                let times = report::timed_after(&mut game, options.after, options.steps);
                (times, *game.stepper.world.stats())
            }
            AnyGame::Volume(mut game) => {
                let times = report::timed_after(&mut game, options.after, options.steps);
                (times, *game.stepper.world.stats())
            }
        };
        let Times { stages, worst_update, all, steps } = times;
        write!(table, "{},{},{steps}", stage.name(), stats.bodies)?;
        for sum in stages {
            write!(table, ",{:.4}", times.mean(sum))?;
        }
        let update = times.updates();
        let response = times.mean(all.saturating_sub(update));
        let worst = worst_update.as_secs_f64() * 1e3;
        write!(table, ",{:.4},{worst:.4},{response:.4},{:.4}", times.mean(update), times.mean(all))?;
        writeln!(table, ",{},{}", stats.candidates, stats.contacts)?;
        println!(
            "{:<18} {:>9.3} ms a step, {:>8.3} of it the update",
            stage.name(),
            times.mean(all),
            times.mean(update)
        );
    }
    output::write(file, &table)?;
    println!("times          {}", file.display());
    Ok(())
}
