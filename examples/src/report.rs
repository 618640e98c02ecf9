//! Reports what a run cost and found, as text or as one line of JSON.

use crate::game::Game;
use crate::playable::Playable;
use asunder::{Stats, World};
use core::convert::Infallible;
use core::fmt::Write;
use core::time::Duration;
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Instant;

/// One step, in seconds.
pub const STEP: f64 = 1.0 / 60.0;

/// Times summed over the steps of a run.
#[derive(Clone, Copy, Default)]
pub struct Times {
    /// The number of steps.
    pub steps: u32,
    /// The stages of an update, in the order of [`stages`].
    pub stages: [Duration; STAGES],
    /// The longest update.
    pub worst_update: Duration,
    /// The whole time of all steps, the solver included.
    pub all: Duration,
}

/// How many stages are timed.
pub const STAGES: usize = 6;

/// The stages of the last update: their names and times.
pub fn stages(stats: &Stats) -> [(&'static str, Duration); STAGES] {
    let Stats { refit, sweep, collide, merge, impacts, report, .. } = *stats;
    [
        ("refit", refit),
        ("sweep", sweep),
        ("collide", collide),
        ("merge", merge),
        ("impacts", impacts),
        ("report", report),
    ]
}

impl Times {
    /// Times a step that ends with an update of the world.
    pub fn measure<T>(&mut self, game: &mut T, stats: fn(&T) -> &Stats, step: impl FnOnce(&mut T)) {
        let start = Instant::now();
        step(game);
        self.all += start.elapsed();
        self.steps += 1;
        let stats = stats(game);
        for (sum, (_, stage)) in self.stages.iter_mut().zip(stages(stats)) {
            *sum += stage;
        }
        self.worst_update = self.worst_update.max(stats.total());
    }

    /// Milliseconds a step.
    pub fn mean(&self, sum: Duration) -> f64 {
        sum.as_secs_f64() * 1e3 / f64::from(self.steps.max(1))
    }

    /// The time of all updates.
    pub fn updates(&self) -> Duration {
        self.stages.iter().sum()
    }
}

/// A progress bar for a run of so many steps.
pub fn bar(steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left  {msg}") {
        bar.set_style(style);
    }
    bar
}

/// Plays so many steps of 1/60 s behind a progress bar, calls `tell` after each, and returns what they cost.
///
/// # Errors
/// What `tell` returns.
pub fn timed<S: Playable, E>(
    game: &mut Game<S>,
    steps: u32,
    mut tell: impl FnMut(&Game<S>) -> Result<(), E>,
) -> Result<Times, E> {
    let bar = bar(u64::from(steps));
    let mut times = Times::default();
    game.update();
    for _ in 0..steps {
        times.measure(game, |game| game.stepper.world.stats(), |game| game.step(STEP));
        tell(game)?;
        bar.set_message(format!("{} contacts", game.stepper.world.stats().contacts));
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(times)
}

/// Plays some steps untimed, then so many more, and returns what the latter cost.
pub fn timed_after<S: Playable>(game: &mut Game<S>, after: u32, steps: u32) -> Times {
    let Ok(_) = timed(game, after, |_| Ok::<(), Infallible>(()));
    let Ok(times) = timed(game, steps, |_| Ok::<(), Infallible>(()));
    times
}

/// Plays so many steps of 1/60 s behind a progress bar, then prints what they cost and what touches at the end.
pub fn run<S: Playable>(game: &mut Game<S>, name: &str, steps: u32) {
    let Ok(times) = timed(game, steps, |_| Ok::<(), Infallible>(()));
    print(game, name, &times, game.counts.left);
}

/// The share of candidate pairs that are no contacts: the false positives of the broad phase.
pub fn false_pairs(stats: &Stats) -> f64 {
    let wasted = stats.candidates.saturating_sub(stats.contacts);
    wasted as f64 / stats.candidates.max(1) as f64
}

/// Prints what a run cost, what touches at its end, and how many bodies are outside the scene's room.
pub fn print<S: Playable>(game: &Game<S>, name: &str, times: &Times, outside: usize) {
    let (stats, counts) = (game.stepper.world.stats(), game.counts);
    print_times(name, times, stats, "response");
    let (awake, asleep) = game.awake_and_asleep();
    println!(
        "bodies         {} ({awake} awake, {asleep} asleep, {} left the level)",
        stats.bodies, counts.left
    );
    if outside > counts.left {
        println!("outside        {} of the scene's room", outside - counts.left);
    }
    print_pairs(stats);
    println!(
        "deepest        {:.2} mm (at any step: {:.2} mm; after two seconds: {:.2} mm, {:.2} % of size)",
        game.deepest_now() * 1e3,
        counts.deepest * 1e3,
        counts.deepest_settled * 1e3,
        counts.deepest_share * 1e2,
    );
    println!("fastest        {:.2} m/s, all together {:.3e} J", game.fastest_now(), game.energy());
    println!("events         {} began, {} ended, {} of sensors", counts.began, counts.ended, counts.sensed);
    println!("digest         {:016x} (equal runs print equal digests)", game.digest());
    print_overflow(stats);
}

/// Prints what a replay cost, which only sets poses, and what touches at its end.
pub fn print_replay<S: Playable>(world: &World<S>, name: &str, times: &Times) {
    print_times(name, times, world.stats(), "set poses");
    println!("bodies         {}", world.stats().bodies);
    print_pairs(world.stats());
    print_overflow(world.stats());
}

fn print_times(name: &str, times: &Times, stats: &Stats, rest: &str) {
    let name = if name.is_empty() { "unnamed" } else { name };
    println!("scene          {name}: {} steps in {:.2} s", times.steps, times.all.as_secs_f64());
    println!("stage          mean ms    last ms");
    for ((stage, last), sum) in stages(stats).into_iter().zip(times.stages) {
        println!("  {stage:<10} {:>9.3}  {:>9.3}", times.mean(sum), last.as_secs_f64() * 1e3);
    }
    let update = times.updates();
    println!("  {:<10} {:>9.3}  {:>9.3}", "update", times.mean(update), stats.total().as_secs_f64() * 1e3);
    println!("  {:<10} {:>9.3}", "worst", times.worst_update.as_secs_f64() * 1e3);
    println!("  {rest:<10} {:>9.3}", times.mean(times.all.saturating_sub(update)));
}

fn print_pairs(stats: &Stats) {
    println!(
        "candidates     {} pairs ({:.1} % of them no contact)",
        stats.candidates,
        false_pairs(stats) * 1e2
    );
    println!(
        "contacts       {} ({} overlapping, {} manifolds)",
        stats.contacts, stats.overlapping, stats.manifolds
    );
}

fn print_overflow(stats: &Stats) {
    if stats.overflow {
        println!("the last update made more pairs than the world allows: its contacts are out of date");
    }
}

/// One line of JSON: times in milliseconds a step, and counts of the last step.
pub fn json(name: &str, times: &Times, stats: &Stats) -> String {
    let mut line = String::from("{");
    // Writing to a string cannot fail; `serde_json` escapes the name.
    let _ = write!(line, "\"scene\":{},\"steps\":{}", serde_json::Value::from(name), times.steps);
    for ((stage, _), sum) in stages(stats).into_iter().zip(times.stages) {
        let _ = write!(line, ",\"{stage}_ms\":{:.4}", times.mean(sum));
    }
    let (update, all) = (times.updates(), times.all);
    let _ = write!(line, ",\"update_ms\":{:.4},\"step_ms\":{:.4}", times.mean(update), times.mean(all));
    let _ = write!(line, ",\"worst_update_ms\":{:.4}", times.worst_update.as_secs_f64() * 1e3);
    let Stats { bodies, candidates, contacts, overlapping, .. } = *stats;
    let _ = write!(line, ",\"bodies\":{bodies},\"candidates\":{candidates}");
    let _ = write!(line, ",\"contacts\":{contacts},\"overlapping\":{overlapping}}}");
    line
}
