//! Whole frames as plain rows, for the report.

use super::threads::{Run, Side, run};
use super::{Case, MARGIN, Ours, lean_bodies, name, peer_frame, poses_at};
use crate::clock::{Effort, Spread};
use crate::lean::{Lean, Walked};
use crate::parry;
use asunder_geometry::Pose3;
use asunder_scenes::worlds::Replay3;
use asunder_tests::counting::{allocations, counted, live_bytes};
use parry3d::math::Pose;
use serde::{Deserialize, Serialize};
use std::error::Error;

/// One way through a frame, by the clock on the wall. What the stages leave of the whole is setting poses and walking
/// contacts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameRow {
    /// The scene's name.
    pub scene: String,
    /// `asunder`, or `parry3d`: the [`lean`](crate::lean) pipeline.
    pub method: String,
    /// Threads that worked.
    pub threads: u64,
    /// Bodies in the scene.
    pub bodies: u64,
    /// Pairs that the broad phase hands over, in the last frame.
    pub candidates: u64,
    /// Pairs with contact points, within the margin.
    pub contacts: u64,
    /// Contact points.
    pub points: u64,
    /// Frames that were measured.
    pub frames: u64,
    /// Median time of a frame, in nanoseconds.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
    /// Median time from poses to boxes, in nanoseconds; the peer's trees.
    pub refit_ns: f64,
    /// From boxes to pairs.
    pub sweep_ns: f64,
    /// From pairs to contacts.
    pub collide_ns: f64,
    /// This frame's pairs beside the last one's.
    pub merge_ns: f64,
    /// Events, and the index by body; the peer has none.
    pub report_ns: f64,
    /// Calls of the allocator in a steady frame; less than 0 where nobody counted.
    pub allocations: f64,
    /// Bytes held a body, without its shape's own data; less than 0 where nobody counted.
    pub bytes_per_body: f64,
    /// Whether one thread and several found different contacts.
    pub note: String,
}

/// Measures one scene in space: ours on one thread and on several, the peer's on one. Memory is counted where the
/// program's allocator is [`Counting`](asunder_tests::counting::Counting).
///
/// # Errors
/// The system gives no threads.
///
/// ```
/// use asunder_benches::{clock::Effort, world::rows};
/// use asunder_scenes::worlds::WorldScene;
/// let rows = rows::frames(&(WorldScene::Mixed, false), 300, 2, &Effort { rounds: 2, ..Effort::quick() })?;
/// let threads: Vec<u64> = rows.iter().map(|row| row.threads).collect();
/// assert_eq!(threads, [1, 2, 1]);
/// assert!(rows.iter().all(|row| row.note.is_empty() && row.allocations < 0.0), "nobody counts here: {rows:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn frames(
    case: &Case,
    count: usize,
    threads: usize,
    effort: &Effort,
) -> Result<Vec<FrameRow>, Box<dyn Error>> {
    let Some(run) = run(case, count, threads, effort)? else { return Ok(Vec::new()) };
    let [ours, peer] = memory(case, count)?;
    let [one, many] = &run.ours;
    let rows = [
        row(case, &run, (one, "asunder", 1), ours),
        row(case, &run, (many, "asunder", threads), None),
        row(case, &run, (&run.peer, "parry3d", 1), peer),
    ];
    Ok(rows.into_iter().flatten().collect())
}

fn row(
    case: &Case,
    run: &Run,
    (side, method, threads): (&Side, &str, usize),
    memory: Held,
) -> Option<FrameRow> {
    let Spread { low: ns_low, median: ns, high: ns_high } = side.samples.spread()?;
    let [refit_ns, sweep_ns, collide_ns, merge_ns, report_ns] = side.stages.medians();
    let candidates = if method == "parry3d" { run.peer_candidates } else { run.stats.candidates };
    let (allocations, bytes_per_body) = memory.unwrap_or((-1.0, -1.0));
    let note = run.differ_in.map_or_else(String::new, |frame| format!("CONTACTS DIFFER in frame {frame}"));
    Some(FrameRow {
        scene: name(case),
        method: method.to_string(),
        threads: threads as u64,
        bodies: run.bodies as u64,
        candidates: candidates as u64,
        contacts: side.found.contacts as u64,
        points: side.found.points as u64,
        frames: side.samples.len() as u64,
        ns,
        ns_low,
        ns_high,
        refit_ns,
        sweep_ns,
        collide_ns,
        merge_ns,
        report_ns,
        allocations,
        bytes_per_body,
        note,
    })
}

/// Allocations a frame and bytes a body, if they are counted.
type Held = Option<(f64, f64)>;

/// Frames after which the scene begins anew.
const CYCLE: u32 = 20;

/// What our world and the peer's hold, and what a frame of theirs asks the allocator for once all buffers have grown:
/// the third round of the same frames.
fn memory(case: &Case, count: usize) -> Result<[Held; 2], Box<dyn Error>> {
    let is_counted = counted(1, || {
        let before = allocations();
        core::hint::black_box(vec![1_u8; 100]);
        allocations() > before
    });
    if !is_counted {
        return Ok([None, None]);
    }
    let replay = Replay3::new(case.0, count, 1);
    let ours = counted(1, || -> Result<(f64, f64), String> {
        let (replay, before) = (replay.clone(), live_bytes());
        let mut ours = Ours::new(&replay.bodies).map_err(|error| error.to_string())?;
        Ok(steady((replay, before), |poses, _| ours.frame(poses)))
    })?;
    // Shapes are made beforehand: their data is not the pipeline's, here as there.
    let peer = lean_bodies(&replay.bodies).map(|bodies| {
        counted(1, || {
            let (replay, before) = (replay.clone(), live_bytes());
            let mut peer = Lean::new(bodies.clone(), MARGIN);
            steady((replay, before), |_, poses| peer_frame(&mut peer, poses))
        })
    });
    Ok([Some(ours), peer])
}

/// Plays three rounds: allocations a frame of the last one, and bytes a body at its end.
fn steady(
    (mut replay, before): (Replay3, i64),
    mut frame: impl FnMut(&[(u32, Pose3)], &[(u32, Pose)]) -> Walked,
) -> (f64, f64) {
    let mut calls = 0;
    for number in 0..3 * CYCLE {
        let poses = poses_at(&mut replay, number % CYCLE);
        let converted: Vec<(u32, Pose)> = poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
        let start = allocations();
        core::hint::black_box(frame(&poses, &converted));
        if number >= 2 * CYCLE {
            calls += allocations() - start;
        }
    }
    (calls as f64 / f64::from(CYCLE), (live_bytes() - before) as f64 / replay.bodies.len().max(1) as f64)
}
