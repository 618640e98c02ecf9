//! Frames in blocks, for variants that take turns.
//!
//! A variant that plays one frame and then waits for the others begins every frame with the caches full of their data,
//! as no game does, and two threads lose more of their gain by this than one does: for heaps and pyramids they were
//! 1.00 to 1.04 times as fast frame by frame, and 1.08 to 1.26 block by block (AMD EPYC, Zen 4, 2 virtual cores,
//! 2026-11-22). So each side plays some frames in a row, and the first of them are not counted.
//!
//! Threads that slept while others took their turn are woken on one processor, and the system moves them apart after
//! some tens of milliseconds: with two threads the first 2 to 11 frames of a block took as long as with one (AMD EPYC,
//! Zen 5, 2 virtual cores, Linux 6.18, 2026-11-25); this is also in the figures above. It does not happen where frames
//! follow each other at once, so threads are [`spread`] before each block. What a game can do about it is in the
//! guide's page on game loops.

use core::ops::Range;
use rayon::ThreadPool;
use std::time::{Duration, Instant};

/// For how long all threads of a pool are kept busy, until each has a processor of its own: some ticks of the system's
/// clock.
const SPREAD: Duration = Duration::from_millis(60);

/// Keeps all threads of a pool busy for some ticks of the system's clock, so that each has a processor of its own, if
/// there is one.
///
/// ```
/// let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
/// let start = std::time::Instant::now();
/// asunder_benches::blocks::spread(&pool);
/// assert!(start.elapsed().as_millis() >= 60);
/// # Ok::<(), rayon::ThreadPoolBuildError>(())
/// ```
pub fn spread(pool: &ThreadPool) {
    pool.broadcast(|_| {
        let start = Instant::now();
        while start.elapsed() < SPREAD {
            core::hint::spin_loop();
        }
    });
}

/// Frames at the start of a block that are not counted. In the very first ones buffers grow, and a million bodies at
/// rest are inserted once.
const WARM: usize = 2;

/// The most frames of a block that are counted.
const LENGTH: usize = 10;

/// Frames that each side plays in turn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The number of blocks before it.
    pub number: usize,
    /// All its frames, beginning with those that are not counted.
    pub frames: Range<usize>,
}

impl Block {
    /// Whether a frame of the block is counted.
    pub fn counts(&self, frame: usize) -> bool {
        frame >= self.frames.start + WARM
    }
}

/// Blocks of about equal length, with at least `counted` counted frames in all; frames are numbered from 1.
///
/// ```
/// let blocks: Vec<_> = asunder_benches::blocks::blocks(12).collect();
/// assert_eq!(blocks.iter().map(|block| block.frames.clone()).collect::<Vec<_>>(), [1..9, 9..17]);
/// let counted = |block: &asunder_benches::blocks::Block| block.frames.clone().filter(|&i| block.counts(i)).count();
/// assert_eq!(blocks.iter().map(counted).sum::<usize>(), 12);
/// ```
pub fn blocks(counted: usize) -> impl Iterator<Item = Block> {
    let count = counted.div_ceil(LENGTH);
    let length = WARM + counted.div_ceil(count.max(1));
    (0..count).map(move |number| Block { number, frames: 1 + number * length..1 + (number + 1) * length })
}
