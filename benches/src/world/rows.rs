//! Whole frames as plain rows, for the report.

use super::play::{Play, Replay};
use super::threads::{Run, Side, run};
use super::{Case, MARGIN, Opened, name, peer_frame};
use crate::clock::{Effort, Spread};
use crate::lean::{Lean, Walked};
use asunder_tests::counting::{allocations, counted, live_bytes};
use parry3d::math::Pose;
use serde::{Deserialize, Serialize};
use std::error::Error;

/// One way to play a frame, in wall-clock time. The part of the whole that is in no stage is setting poses and visiting
/// contacts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrameRow {
    /// The scene's name.
    pub scene: String,
    /// `asunder`, or `parry3d`: the [`lean`](crate::lean) pipeline.
    pub method: String,
    /// How many threads worked.
    pub threads: u64,
    /// How many bodies the scene has.
    pub bodies: u64,
    /// Pairs that the broad phase reports per frame, on average; contacts and points are averages too.
    pub candidates: u64,
    /// Pairs with contact points, within the margin.
    pub contacts: u64,
    /// Contact points.
    pub points: u64,
    /// How many frames were measured.
    pub frames: u64,
    /// Median time of a frame, in nanoseconds.
    pub ns: f64,
    /// Its lower quartile.
    pub ns_low: f64,
    /// Its upper quartile.
    pub ns_high: f64,
    /// Median time from poses to boxes, in nanoseconds; for the peer, updating the trees.
    pub refit_ns: f64,
    /// From boxes to pairs.
    pub sweep_ns: f64,
    /// From pairs to contacts.
    pub collide_ns: f64,
    /// Matching this frame's pairs with the last frame's.
    pub merge_ns: f64,
    /// Events, and the index by body; the peer has none.
    pub report_ns: f64,
    /// Allocations in a steady frame; less than 0 if not counted.
    pub allocations: f64,
    /// Bytes held per body, without the data of its shape; less than 0 if not counted.
    pub bytes_per_body: f64,
    /// Notes that one thread and several found different contacts.
    pub note: String,
}

impl FrameRow {
    /// The share of candidates without a contact point: boxes overlap, but shapes do not touch. Margins are included on
    /// both sides.
    ///
    /// ```
    /// use asunder_benches::world::rows::FrameRow;
    /// let row = FrameRow { candidates: 4, contacts: 1, ..FrameRow::default() };
    /// assert_eq!((row.false_pairs(), FrameRow::default().false_pairs()), (0.75, 0.0));
    /// ```
    pub fn false_pairs(&self) -> f64 {
        let candidates = self.candidates.max(self.contacts).max(1) as f64;
        (self.candidates.max(self.contacts) - self.contacts) as f64 / candidates
    }
}

/// Measures one scene: ours on one thread and on several, and in space the peer's on one. Memory is counted if the
/// program's allocator is [`Counting`](asunder_tests::counting::Counting).
///
/// # Errors
/// The system cannot start the threads.
///
/// ```
/// use asunder_benches::{clock::Effort, world::{Case, rows}};
/// use asunder_scenes::worlds::WorldScene;
/// let effort = Effort { rounds: 2, ..Effort::quick() };
/// let rows = rows::frames(&Case::Volume(WorldScene::Mixed), 300, 2, &effort)?;
/// let threads: Vec<u64> = rows.iter().map(|row| row.threads).collect();
/// assert_eq!(threads, [1, 2, 1]);
/// assert!(rows.iter().all(|row| row.note.is_empty() && row.allocations < 0.0), "nobody counts here: {rows:?}");
/// let rows = rows::frames(&Case::Plane(WorldScene::Mixed), 300, 2, &effort)?;
/// assert_eq!(rows.iter().map(|row| row.threads).collect::<Vec<_>>(), [1, 2], "no peer in the plane");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn frames(
    case: &Case,
    count: usize,
    threads: usize,
    effort: &Effort,
) -> Result<Vec<FrameRow>, Box<dyn Error>> {
    match case.open(count)? {
        Opened::Plane(replay) => frames_of(case, replay, threads, effort),
        Opened::Volume(replay) => frames_of(case, replay, threads, effort),
    }
}

fn frames_of<R: Replay>(
    case: &Case,
    replay: R,
    threads: usize,
    effort: &Effort,
) -> Result<Vec<FrameRow>, Box<dyn Error>> {
    let run = run(replay.clone(), threads, &case.effort(effort))?;
    let [ours, peer] = memory(&replay)?;
    let [one, many] = &run.ours;
    let rows = [
        row(case, &run, (one, "asunder", 1), ours),
        row(case, &run, (many, "asunder", threads), None),
        run.peer.as_ref().and_then(|side| row(case, &run, (side, "parry3d", 1), peer)),
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
    let found = side.found.mean();
    let (allocations, bytes_per_body) = memory.unwrap_or((-1.0, -1.0));
    let note = run.differ_in.map_or_else(String::new, |frame| format!("CONTACTS DIFFER in frame {frame}"));
    Some(FrameRow {
        scene: name(case),
        method: method.to_string(),
        threads: threads as u64,
        bodies: run.bodies as u64,
        candidates: found.candidates as u64,
        contacts: found.contacts as u64,
        points: found.points as u64,
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

/// Allocations per frame and bytes per body, if they are counted.
type Held = Option<(f64, f64)>;

/// Frames after which the scene starts again, without a transition: a heap that falls is then up in the air again.
const CYCLE: u32 = 20;

/// The memory held by our world and by the peer's, and their allocations per frame once all buffers have grown, in the
/// third round of the same frames.
fn memory<R: Replay>(replay: &R) -> Result<[Held; 2], Box<dyn Error>> {
    let is_counted = counted(1, || {
        let before = allocations();
        core::hint::black_box(vec![1_u8; 100]);
        allocations() > before
    });
    if !is_counted {
        return Ok([None, None]);
    }
    let ours = counted(1, || -> Result<(f64, f64), String> {
        let (replay, before) = (replay.clone(), live_bytes());
        let mut ours = replay.ours().map_err(|error| error.to_string())?;
        Ok(steady((replay, before), |poses, _| ours.frame(poses)))
    })?;
    // Shapes are made beforehand, so that on both sides their data does not count for the pipeline.
    let peer = replay.lean_bodies().map(|bodies| {
        counted(1, || {
            let (replay, before) = (replay.clone(), live_bytes());
            let mut peer = Lean::new(bodies.clone(), MARGIN);
            steady((replay, before), |_, poses| peer_frame(&mut peer, poses))
        })
    });
    Ok([Some(ours), peer])
}

/// Plays three rounds; returns the allocations per frame of the last one, and the bytes per body at its end.
fn steady<R: Replay>(
    (mut replay, before): (R, i64),
    mut frame: impl FnMut(&[(u32, R::Pose)], &[(u32, Pose)]) -> Walked,
) -> (f64, f64) {
    let mut calls = 0;
    for number in 0..3 * CYCLE {
        let poses = replay.poses_at(number % CYCLE);
        let converted = R::converted(&poses);
        let start = allocations();
        core::hint::black_box(frame(&poses, &converted));
        if number >= 2 * CYCLE {
            calls += allocations() - start;
        }
    }
    (calls as f64 / f64::from(CYCLE), (live_bytes() - before) as f64 / replay.count().max(1) as f64)
}
