//! Whole frames on several threads, beside one thread and beside the peer on one, in wall-clock time.
//!
//! Each side plays a block of frames before it is the next one's turn; the reasons are in [`blocks`](crate::blocks).

use super::play::{Play, Replay};
use super::stages::Stages;
use super::tally::Tally;
use super::{Case, Opened, lean_of, name, peer_frame};
use crate::blocks::{blocks, spread};
use crate::clock::{Effort, Samples};
use crate::lean::{Lean, Walked};
use crate::row::Row;
use asunder::Stats;
use parry3d::math::Pose;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::error::Error;
use std::time::{Duration, Instant};

/// Measures our frames on one thread and on several, and the peer's, in turns, block by block; in the plane there is no
/// peer. The row's time is that on several threads.
///
/// # Errors
/// The system cannot start the threads.
///
/// ```
/// use asunder_benches::{clock::Effort, world::{Case, threads}};
/// use asunder_scenes::worlds::WorldScene;
/// let effort = Effort { rounds: 2, ..Effort::quick() };
/// let row = threads::measure(&Case::Volume(WorldScene::Mixed), 300, 2, &effort)?;
/// let figures = row.world.unwrap_or_default();
/// assert!(figures.threads == Some(2) && figures.speedup.is_some() && !row.note.contains("DIFFER"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, count: usize, threads: usize, effort: &Effort) -> Result<Row, Box<dyn Error>> {
    let mut row = Row::new(format!("{}/{threads} threads", name(case)), "frame", count);
    let effort = case.effort(effort);
    let run = match case.open(count)? {
        Opened::Plane(replay) => run(replay, threads, &effort)?,
        Opened::Volume(replay) => run(replay, threads, &effort)?,
    };
    if let Some(frame) = run.differ_in {
        row.remark(&format!("CONTACTS DIFFER in frame {frame}"));
    }
    let [one, many] = &run.ours;
    row.n = run.bodies;
    row.tell(&many.samples);
    row.done = many.samples.len();
    if let Some(peer) = &run.peer {
        row.tell_peer("lean parry3d, one thread", &peer.samples);
    }
    let mut figures = many.stages.figures(many.found.mean().candidates, run.bodies);
    (figures.threads, figures.one_thread_ns) = (Some(threads), one.samples.median());
    figures.speedup = one.samples.median().zip(many.samples.median()).map(|(one, many)| one / many.max(1.0));
    row.world = Some(figures);
    row.finish();
    Ok(row)
}

/// The times and findings of one side.
#[derive(Default)]
pub(super) struct Side {
    pub(super) samples: Samples,
    pub(super) stages: Stages,
    /// The findings of its frames.
    pub(super) found: Tally,
}

/// Frames of one world: ours on one thread and on several, the peer's.
pub(super) struct Run {
    pub(super) bodies: usize,
    pub(super) ours: [Side; 2],
    /// `None` in the plane, or if it rejects a hull.
    pub(super) peer: Option<Side>,
    /// The first frame in which our two sides differ.
    pub(super) differ_in: Option<u32>,
}

/// Measures all three sides in turns; every side plays every frame.
pub(super) fn run<R: Replay>(mut replay: R, threads: usize, effort: &Effort) -> Result<Run, Box<dyn Error>> {
    let mut first = replay.ours()?;
    let mut peer = lean_of(&replay).map(|peer| (peer, Side::default()));
    first.update();
    if let Some((peer, _)) = &mut peer {
        peer.update();
    }
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let (pools, mut worlds) = ([pool(1)?, pool(threads)?], [first.clone(), first]);
    let (mut ours, mut differ_in) = ([Side::default(), Side::default()], None);
    for block in blocks(effort.rounds) {
        let mut found: [Vec<Walked>; 2] = [Vec::new(), Vec::new()];
        // Which side comes first also alternates.
        for who in [0, 1, 2].map(|turn| (block.number + turn) % 3) {
            if let Some(pool) = pools.get(who) {
                spread(pool);
            }
            for frame in block.frames.clone() {
                let poses = replay.poses_at(frame as u32);
                let is_counted = block.counts(frame);
                match (ours.get_mut(who), &mut peer) {
                    (Some(side), _) => {
                        let world = &mut worlds[who];
                        let (ns, walked) = timed(&pools[who], || world.frame(&poses));
                        found[who].push(walked);
                        if is_counted {
                            side.push(ns, walked, world.stats());
                        }
                    }
                    (None, Some((peer, side))) => side.push_peer(is_counted, peer, &R::converted(&poses)),
                    (None, None) => {}
                }
            }
        }
        let [one, many] = &found;
        let differs = block.frames.zip(one.iter().zip(many)).find(|(_, (one, many))| one != many);
        differ_in = differ_in.or(differs.map(|(frame, _)| frame as u32));
        let mut sides = ours.iter().chain(peer.as_ref().map(|(_, side)| side));
        if sides.any(|side| side.samples.spent() > effort.nanoseconds()) {
            break;
        }
    }
    let peer = peer.map(|(_, side)| side);
    Ok(Run { bodies: replay.count(), ours, peer, differ_in })
}

impl Side {
    /// Adds one counted frame.
    fn push(&mut self, ns: f64, found: Walked, stats: &Stats) {
        self.samples.push(ns, ns);
        self.stages.push(stats);
        self.found.push(stats, found);
    }

    /// Plays one frame of the peer's, and adds it if it is counted.
    fn push_peer(&mut self, is_counted: bool, peer: &mut Lean, poses: &[(u32, Pose)]) {
        let start = Instant::now();
        let found = core::hint::black_box(peer_frame(peer, poses));
        let ns = start.elapsed().as_nanos() as f64;
        if is_counted {
            let [refit, sweep, merge, collide] = peer.times();
            self.samples.push(ns, ns);
            self.stages.push_times([refit, sweep, collide, merge, Duration::ZERO]);
            self.found.push_peer(peer, found);
        }
    }
}

/// The time of a frame in nanoseconds, and its result. The clock runs inside the pool: entering one is not our cost.
fn timed(pool: &ThreadPool, frame: impl FnOnce() -> Walked + Send) -> (f64, Walked) {
    pool.install(|| {
        let start = Instant::now();
        let walked = core::hint::black_box(frame());
        (start.elapsed().as_nanos() as f64, walked)
    })
}
