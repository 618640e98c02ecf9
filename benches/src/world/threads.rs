//! Whole frames on several threads beside one, and beside the peer on its one: by the clock on the wall.

use super::stages::Stages;
use super::{Case, Ours, lean_of, name, peer_frame, poses_at};
use crate::clock::{Effort, Samples};
use crate::lean::Walked;
use crate::parry;
use crate::row::Row;
use asunder_scenes::worlds::Replay3;
use parry3d::math::Pose;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::error::Error;
use std::time::Instant;

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
    let mut replay = Replay3::new(case.0, count, 1);
    let mut row = Row::new(format!("{}/{threads} threads", name(case)), "frame", replay.bodies.len());
    let mut ours = Ours::new(&replay.bodies)?;
    let Some(mut peer) = lean_of(&replay.bodies) else {
        row.remark("parry3d refuses a hull");
        return Ok(row);
    };
    ours.world.update();
    peer.update();
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let mut sides =
        [(pool(1)?, ours.clone(), Samples::default()), (pool(threads)?, ours, Samples::default())];
    let (mut peer_samples, mut stages) = (Samples::default(), Stages::default());
    for frame in 1..=effort.rounds as u32 {
        let poses = poses_at(&mut replay, frame);
        let converted: Vec<(u32, Pose)> = poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
        // In turns as to which is first and finds cold caches.
        let turn = frame as usize % 2;
        let found = [turn, 1 - turn].map(|side| {
            let (pool, ours, samples) = &mut sides[side];
            timed(pool, samples, || ours.frame(&poses))
        });
        if found[0] != found[1] {
            row.remark(&format!("CONTACTS DIFFER in frame {frame}"));
        }
        stages.push(sides[1].1.world.stats());
        let start = Instant::now();
        core::hint::black_box(peer_frame(&mut peer, &converted));
        let ns = start.elapsed().as_nanos() as f64;
        peer_samples.push(ns, ns);
        let spent = sides.iter().map(|side| side.2.spent()).fold(peer_samples.spent(), f64::max);
        if spent > effort.nanoseconds() {
            break;
        }
    }
    let [(_, _, one), (_, many, samples)] = &sides;
    (row.ours_ns, row.done) = (samples.median(), samples.len());
    (row.peer, row.peer_ns) = (Some("lean parry3d, one thread"), peer_samples.median());
    let mut figures = stages.figures(many.world.stats());
    (figures.threads, figures.one_thread_ns) = (Some(threads), one.median());
    figures.speedup = one.median().zip(samples.median()).map(|(one, many)| one / many.max(1.0));
    row.world = Some(figures);
    row.finish();
    Ok(row)
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
