//! Whole frames on several threads beside one, and beside the peer on its one: by the clock on the wall.

use super::stages::Stages;
use super::{Case, Ours, lean_of, name, peer_frame, poses_at};
use crate::clock::{Effort, Samples};
use crate::lean::Walked;
use crate::parry;
use crate::row::Row;
use asunder::Stats;
use asunder_scenes::worlds::Replay3;
use parry3d::math::Pose;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::error::Error;
use std::time::{Duration, Instant};

/// Measures our frames on one thread and on several, and the peer's, in turns. In space; the row's time is that of
/// the threads.
///
/// # Errors
/// The system gives no threads.
///
/// ```
/// use asunder_benches::{clock::Effort, world::threads};
/// use asunder_scenes::worlds::WorldScene;
/// let row = threads::measure(&(WorldScene::Mixed, false), 300, 2, &Effort { rounds: 2, ..Effort::quick() })?;
/// let figures = row.world.unwrap_or_default();
/// assert!(figures.threads == Some(2) && figures.speedup.is_some() && !row.note.contains("DIFFER"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, count: usize, threads: usize, effort: &Effort) -> Result<Row, Box<dyn Error>> {
    let mut row = Row::new(format!("{}/{threads} threads", name(case)), "frame", count);
    let Some(run) = run(case, count, threads, effort)? else {
        row.remark("parry3d refuses a hull");
        return Ok(row);
    };
    if let Some(frame) = run.differ_in {
        row.remark(&format!("CONTACTS DIFFER in frame {frame}"));
    }
    let [one, many] = &run.ours;
    row.n = run.bodies;
    (row.ours_ns, row.done) = (many.samples.median(), many.samples.len());
    (row.peer, row.peer_ns) = (Some("lean parry3d, one thread"), run.peer.samples.median());
    let mut figures = many.stages.figures(&run.stats);
    (figures.threads, figures.one_thread_ns) = (Some(threads), one.samples.median());
    figures.speedup = one.samples.median().zip(many.samples.median()).map(|(one, many)| one / many.max(1.0));
    row.world = Some(figures);
    row.finish();
    Ok(row)
}

/// What one way to a frame took.
#[derive(Default)]
pub(super) struct Side {
    pub(super) samples: Samples,
    pub(super) stages: Stages,
    /// What its last frame found.
    pub(super) found: Walked,
}

/// Frames of one world: ours on one thread and on several, the peer's.
pub(super) struct Run {
    pub(super) bodies: usize,
    pub(super) ours: [Side; 2],
    pub(super) peer: Side,
    /// Our last frame.
    pub(super) stats: Stats,
    pub(super) peer_candidates: usize,
    /// The first frame in which our two differ.
    pub(super) differ_in: Option<u32>,
}

/// Frames at the start that are not counted: a million bodies at rest are sorted in once.
const WARM: u32 = 2;

/// Measures all three in turns. Nothing if the peer refuses a hull.
pub(super) fn run(
    case: &Case,
    count: usize,
    threads: usize,
    effort: &Effort,
) -> Result<Option<Run>, Box<dyn Error>> {
    let mut replay = Replay3::new(case.0, count, 1);
    let mut first = Ours::new(&replay.bodies)?;
    let Some(mut peer) = lean_of(&replay.bodies) else { return Ok(None) };
    first.world.update();
    peer.update();
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let (pools, mut worlds) = ([pool(1)?, pool(threads)?], [first.clone(), first]);
    let (mut ours, mut of_peer, mut differ_in) = ([Side::default(), Side::default()], Side::default(), None);
    for frame in 1..=effort.rounds as u32 + WARM {
        let poses = poses_at(&mut replay, frame);
        let converted: Vec<(u32, Pose)> = poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
        // In turns as to which is first and finds cold caches.
        let turn = frame as usize % 2;
        for i in [turn, 1 - turn] {
            let (side, world) = (&mut ours[i], &mut worlds[i]);
            side.found = timed(&pools[i], &mut side.samples, || world.frame(&poses));
            side.stages.push(world.world.stats());
        }
        if ours[0].found != ours[1].found {
            differ_in = differ_in.or(Some(frame));
        }
        let start = Instant::now();
        of_peer.found = core::hint::black_box(peer_frame(&mut peer, &converted));
        let ns = start.elapsed().as_nanos() as f64;
        of_peer.samples.push(ns, ns);
        let [refit, sweep, merge, collide] = peer.times();
        of_peer.stages.push_times([refit, sweep, collide, merge, Duration::ZERO]);
        if frame == WARM {
            // Buffers have grown, and what rests is known.
            ours.iter_mut().chain([&mut of_peer]).for_each(|side| *side = Side::default());
        }
        let spent = ours.iter().map(|side| side.samples.spent()).fold(of_peer.samples.spent(), f64::max);
        if frame > WARM && spent > effort.nanoseconds() {
            break;
        }
    }
    let (bodies, stats, peer_candidates) = (replay.bodies.len(), *worlds[1].world.stats(), peer.candidates());
    Ok(Some(Run { bodies, ours, peer: of_peer, stats, peer_candidates, differ_in }))
}

/// The clock runs within the pool: what it takes to enter one is not ours.
fn timed(pool: &ThreadPool, samples: &mut Samples, frame: impl FnOnce() -> Walked + Send) -> Walked {
    let (ns, walked) = pool.install(|| {
        let start = Instant::now();
        let walked = core::hint::black_box(frame());
        (start.elapsed().as_nanos() as f64, walked)
    });
    samples.push(ns, ns);
    walked
}
