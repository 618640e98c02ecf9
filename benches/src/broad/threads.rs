//! Several threads over one, by the clock on the wall: the time of one thread would miss the others.

use super::figures::Figures;
use super::ours::{Engine, Variant};
use super::{Case, Frame, Stage, forget, frames, name, nanoseconds, object};
use crate::clock::Effort;
use crate::row::Row;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::time::Instant;

/// Measures our broad phase on one thread and on several, in turns, frame by frame. No peer takes part.
///
/// The row's time is that of our best mode on all threads. Cost: about a second a mode and number of threads.
///
/// # Errors
/// The system gives no threads.
///
/// ```
/// use asunder_benches::{broad::threads, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let row = threads::measure(&(BoxScene::City, 500), 2, &Effort { rounds: 1, ..Effort::quick() })?;
/// assert!(row.ours_ns.is_some() && !row.note.contains("DIFFER"), "{row:?}");
/// let figures = row.broad.unwrap_or_default();
/// assert!(figures.threads == Some(2) && figures.speedup.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, threads: usize, effort: &Effort) -> Result<Row, ThreadPoolBuildError> {
    let &(_, count) = case;
    let mut row = Row::new(format!("{}/{threads} threads", name(case)), "frame", count);
    let sides = run(case, threads, effort, &mut row)?;
    report(&mut row, threads, &sides);
    Ok(row)
}

/// What both numbers of threads took; where their lists differ, the row says so.
pub(super) fn run(
    case: &Case,
    threads: usize,
    effort: &Effort,
    row: &mut Row,
) -> Result<[Side; 2], ThreadPoolBuildError> {
    let &(_, count) = case;
    let mut stage = Stage::new(case);
    let mut sides = [Side::new(1, stage.few_move)?, Side::new(threads, stage.few_move)?];
    let limit = nanoseconds(count, effort);
    for number in 0..=frames(count, effort) {
        stage.step();
        // In turns as to which is first and finds cold caches.
        let turn = number % 2;
        sides[turn].frame(&stage.now());
        sides[1 - turn].frame(&stage.now());
        if !Side::agree(&sides) {
            object(row, &format!("LISTS DIFFER in frame {number}"));
        }
        if number == 0 {
            sides.iter_mut().for_each(|side| side.forget_samples(limit));
        }
        if sides.iter().any(|side| side.spent() >= limit) {
            break;
        }
    }
    Ok(sides)
}

fn report(row: &mut Row, threads: usize, [one, many]: &[Side; 2]) {
    let (Some((one_ns, _)), Some((ns, best))) = (one.best(), many.best()) else { return };
    let mut figures = Figures { mode: best.engine.name(), threads: Some(threads), ..Figures::default() };
    row.tell(&best.samples);
    row.done = best.samples.len();
    (figures.one_thread_ns, figures.speedup) = (Some(one_ns), Some(one_ns / ns));
    figures.pairs = Some(best.pairs.len());
    figures.ns_per_box = Some(ns / row.n.max(1) as f64);
    row.broad = Some(figures);
}

/// One number of threads: a pool, and our modes in it.
pub(super) struct Side {
    pool: ThreadPool,
    variants: Vec<Variant>,
}

impl Side {
    fn new(threads: usize, few_move: bool) -> Result<Self, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        Ok(Self { pool, variants: Engine::all(few_move).into_iter().map(Variant::new).collect() })
    }

    /// The clock runs within the pool: what it takes to enter one is not ours.
    fn frame(&mut self, frame: &Frame) {
        for Variant { engine, pairs, samples, .. } in &mut self.variants {
            let ns = self.pool.install(|| wall(|| engine.list(frame, pairs)));
            samples.push(ns, ns);
        }
    }

    fn agree([one, many]: &[Self; 2]) -> bool {
        let first = &one.variants[0].pairs;
        one.variants.iter().chain(&many.variants).all(|variant| variant.pairs == *first)
    }

    fn forget_samples(&mut self, limit: f64) {
        self.variants.iter_mut().for_each(|variant| forget(&mut variant.samples, limit));
    }

    /// Time of the slowest mode.
    fn spent(&self) -> f64 {
        self.variants.iter().map(|variant| variant.samples.spent()).fold(0.0, f64::max)
    }

    pub(super) fn best(&self) -> Option<(f64, &Variant)> {
        let medians = self.variants.iter().filter_map(|one| Some((one.samples.median()?, one)));
        medians.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// Nanoseconds that a call takes by the clock on the wall.
fn wall(call: impl FnOnce()) -> f64 {
    let start = Instant::now();
    call();
    start.elapsed().as_nanos() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_scenes::boxes::BoxScene;

    #[test]
    fn any_number_of_threads_gives_the_list_of_one() -> Result<(), ThreadPoolBuildError> {
        let effort = Effort { rounds: 2, seconds: 10.0, ..Effort::quick() };
        for scene in BoxScene::ALL {
            for threads in [2, 3] {
                let row = measure(&(scene, 40_000), threads, &effort)?;
                assert!(!row.note.contains("DIFFER"), "{row:?}");
            }
        }
        Ok(())
    }
}
