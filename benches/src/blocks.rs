//! Frames in blocks, for threads that take turns.
//!
//! Who plays one frame and then waits for the others begins every frame with the caches full of what they left there,
//! as no game does, and two threads lose more of their gain by it than one does: of heaps and pyramids they were 1.00
//! to 1.04 times as fast frame by frame, and 1.08 to 1.26 block by block (AMD EPYC, Zen 4, 2 virtual cores,
//! 2026-11-22). So each side plays some frames in a row, and the first of them are not counted.
//!
//! Threads that slept while others took their turn are woken on one processor, and moved apart by the system after some
//! tens of milliseconds: of two threads the first 2 to 11 frames of a block took as long as one thread's (AMD EPYC, Zen
//! 5, 2 virtual cores, Linux 6.18, 2026-11-25); the figures above hold that, too. Where one frame follows the other at
//! once it does not happen, so threads are [`spread`] before each block. What a game can do about it stands in the
//! guide's page on game loops.

use core::ops::Range;
use rayon::ThreadPool;
use std::time::{Duration, Instant};

/// How long all threads of a pool are kept busy until each has a processor of its own: some ticks of the system's
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

/// Frames at the start of a block that are not counted. At the very start, buffers grow in them, and a million bodies
/// at rest are sorted in once.
const WARM: usize = 2;

/// Most frames of a block that are counted.
const LENGTH: usize = 10;

/// Frames that one side after the other plays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Blocks before it.
    pub number: usize,
    /// All its frames, the uncounted ones first.
    pub frames: Range<usize>,
}

impl Block {
    /// Whether one of its frames is counted.
    pub fn counts(&self, frame: usize) -> bool {
        frame >= self.frames.start + WARM
    }
}

/// Blocks of about equal length with so many counted frames in all, at least; frames are numbered from 1 on.
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
