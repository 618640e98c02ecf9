//! What a run cost and found, in words.

use crate::game::Game;
use crate::physics::Physics;
use asunder::Stats;
use core::time::Duration;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Instant;

/// One step, in seconds.
const STEP: f64 = 1.0 / 60.0;

/// Times summed over the steps of a run.
#[derive(Default)]
struct Times {
    stages: [Duration; 5],
    worst_update: Duration,
    all: Duration,
}

impl Times {
    /// Adds what a step takes.
    fn measure<S: Physics>(&mut self, game: &mut Game<S>, step: impl FnOnce(&mut Game<S>)) {
        let start = Instant::now();
        step(game);
        self.all += start.elapsed();
        let stats = game.world.stats();
        for (sum, (_, stage)) in self.stages.iter_mut().zip(stages(stats)) {
            *sum += stage;
        }
        self.worst_update = self.worst_update.max(stats.total());
    }
}

fn stages(stats: &Stats) -> [(&'static str, Duration); 5] {
    let Stats { refit, sweep, collide, merge, report, .. } = *stats;
    [("refit", refit), ("sweep", sweep), ("collide", collide), ("merge", merge), ("report", report)]
}

/// Plays so many steps of 1/60 s behind a progress bar, then prints what they cost and what touches.
pub fn run<S: Physics>(game: &mut Game<S>, name: &str, steps: u32) {
    let bar = ProgressBar::new(u64::from(steps));
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left  {msg}") {
        bar.set_style(style);
    }
    let mut times = Times::default();
    game.update();
    for _ in 0..steps {
        times.measure(game, |game| game.step(STEP));
        bar.set_message(format!("{} contacts", game.world.stats().contacts));
        bar.inc(1);
    }
    bar.finish_and_clear();
    print(game, name, steps, &times);
}

/// Prints what a run cost and what touches at its end.
fn print<S: Physics>(game: &Game<S>, name: &str, steps: u32, times: &Times) {
    let (stats, counts) = (game.world.stats(), game.counts);
    let mean = |sum: Duration| sum.as_secs_f64() * 1e3 / f64::from(steps.max(1));
    let name = if name.is_empty() { "unnamed" } else { name };
    println!("scene          {name}: {steps} steps in {:.2} s", times.all.as_secs_f64());
    println!("stage          mean ms    last ms");
    for ((stage, last), sum) in stages(stats).into_iter().zip(times.stages) {
        println!("  {stage:<10} {:>9.3}  {:>9.3}", mean(sum), last.as_secs_f64() * 1e3);
    }
    let update: Duration = times.stages.iter().sum();
    println!("  {:<10} {:>9.3}  {:>9.3}", "update", mean(update), stats.total().as_secs_f64() * 1e3);
    println!("  {:<10} {:>9.3}", "worst", times.worst_update.as_secs_f64() * 1e3);
    println!("  {:<10} {:>9.3}", "response", mean(times.all.saturating_sub(update)));
    println!("bodies         {} ({} left the level)", stats.bodies, counts.left);
    println!("candidates     {} pairs", stats.candidates);
    println!(
        "contacts       {} ({} touching, {} manifolds)",
        stats.contacts, stats.touching, stats.manifolds
    );
    println!(
        "deepest        {:.2} mm (at any step: {:.2} mm)",
        game.deepest_now() * 1e3,
        counts.deepest * 1e3
    );
    println!("fastest        {:.2} m/s", game.fastest_now());
    println!("events         {} began, {} ended, {} of sensors", counts.began, counts.ended, counts.sensed);
    println!("digest         {:016x} (equal runs print equal digests)", game.digest());
    if stats.overflow {
        println!("the last update made more pairs than the world allows: its contacts are out of date");
    }
}
