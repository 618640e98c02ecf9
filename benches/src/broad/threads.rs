//! Several threads compared with one, in wall-clock time, since CPU time of one thread would miss the others.

use super::figures::Figures;
use super::ours::{Engine, Variant};
use super::{Case, Stage, frames, name, nanoseconds, object};
use crate::blocks::{Block, blocks, spread};
use crate::clock::Effort;
use crate::row::Row;
use asunder_broad::PairId;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::time::Instant;

/// Measures our broad phase on one thread and on several, in turns, in [`blocks`](crate::blocks) of frames. There is no
/// peer.
///
/// The row's time is that of our best mode on all threads. Cost: about a second per mode and number of threads.
///
/// # Errors
/// The system cannot start the threads.
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

/// The samples of both numbers of threads; notes in the row where their lists differ.
pub(super) fn run(
    case: &Case,
    threads: usize,
    effort: &Effort,
    row: &mut Row,
) -> Result<[Side; 2], ThreadPoolBuildError> {
    let &(_, count) = case;
    let mut sides = [Side::new(1, case)?, Side::new(threads, case)?];
    let limit = nanoseconds(count, effort);
    for block in blocks(frames(count, effort)) {
        // Which side comes first also alternates.
        for who in [0, 1].map(|turn| (block.number + turn) % 2) {
            sides[who].play(&block);
        }
        if let Some(frame) =
            block.frames.clone().find(|&frame| !Side::agree(&sides, frame - block.frames.start))
        {
            object(row, &format!("LISTS DIFFER in frame {frame}"));
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

/// One number of threads: a pool, the scene, and our modes.
pub(super) struct Side {
    pool: ThreadPool,
    stage: Stage,
    variants: Vec<Variant>,
    /// For each frame of the last block, a digest of each mode's list.
    found: Vec<Vec<u64>>,
}

impl Side {
    fn new(threads: usize, case: &Case) -> Result<Self, ThreadPoolBuildError> {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let stage = Stage::new(case);
        let variants = Engine::all(stage.few_move).into_iter().map(Variant::new).collect();
        Ok(Self { pool, stage, variants, found: Vec::new() })
    }

    /// The clock runs inside the pool: entering a pool is not our cost.
    fn play(&mut self, block: &Block) {
        spread(&self.pool);
        self.found.clear();
        for frame in block.frames.clone() {
            self.stage.step();
            let now = self.stage.now();
            for Variant { engine, pairs, samples, .. } in &mut self.variants {
                let ns = self.pool.install(|| wall(|| engine.list(&now, pairs)));
                if block.counts(frame) {
                    samples.push(ns, ns);
                }
            }
            self.found.push(self.variants.iter().map(|variant| digest(&variant.pairs)).collect());
        }
    }

    /// Whether all modes of both sides found the same in a frame of the last block.
    fn agree([one, many]: &[Self; 2], frame: usize) -> bool {
        let first = one.found[frame][0];
        one.found[frame].iter().chain(&many.found[frame]).all(|&found| found == first)
    }

    /// The time of the slowest mode.
    fn spent(&self) -> f64 {
        self.variants.iter().map(|variant| variant.samples.spent()).fold(0.0, f64::max)
    }

    pub(super) fn best(&self) -> Option<(f64, &Variant)> {
        let medians = self.variants.iter().filter_map(|one| Some((one.samples.median()?, one)));
        medians.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// A digest of a list and its order: FNV-1a, word by word.
fn digest(pairs: &[PairId]) -> u64 {
    pairs.iter().fold(0xcbf2_9ce4_8422_2325, |hash, pair| {
        (hash ^ (u64::from(pair.a) << 32 | u64::from(pair.b))).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The wall-clock time of a call, in nanoseconds.
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
