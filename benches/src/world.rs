//! Whole frames: from setting poses to visiting every contact point, beside the [`lean`](crate::lean) pipeline.
//!
//! Both sides keep contacts with gaps of up to 2 cm. Rows that start with `plane/` are in the plane and have no peer.
//! Rows that end with `/falling` replay poses that the examples' stepper made at the start of the run, the same for
//! both sides.

pub(crate) mod play;
pub mod rows;
mod stages;
mod tally;
pub mod threads;

use crate::clock::{Effort, Samples, time};
use crate::lean::{Lean, Walked};
use crate::race::Race;
use crate::row::Row;
use asunder_examples::falling::recorded;
use asunder_scenes::stages::Falling;
use asunder_scenes::worlds::{Replay2, Replay3, WorldScene};
use parry3d::math::Pose;
use play::{Play, Replay};
use stages::Stages;
pub use stages::{Figures, heading};
use std::error::Error;
use tally::Tally;

/// The gap within which two bodies are a contact, in metres: half of it is each body's margin.
pub(crate) const MARGIN: f32 = 0.02;

/// One row: a world, and the source of its poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Case {
    /// Simple motion in space.
    Volume(WorldScene),
    /// Simple motion in the plane.
    Plane(WorldScene),
    /// Poses recorded from a stepper, in space.
    Falling(Falling),
}

impl Case {
    /// The number of bodies it is usually measured with.
    ///
    /// ```
    /// use asunder_benches::world::Case;
    /// use asunder_scenes::stages::Falling;
    /// assert_eq!(Case::Falling(Falling::Boxes).usual_count(), 8005);
    /// ```
    pub const fn usual_count(&self) -> usize {
        match self {
            Self::Volume(scene) | Self::Plane(scene) => scene.usual_count(),
            Self::Falling(heap) => heap.at_rest().usual_count(),
        }
    }

    /// Its bodies. Cost: for a heap that falls, stepping it.
    fn open(&self, count: usize) -> Result<Opened, Box<dyn Error>> {
        Ok(match self {
            Self::Volume(scene) => Opened::Volume(Replay3::new(*scene, count, 1)),
            Self::Plane(scene) => Opened::Plane(Replay2::new(*scene, count, 1)),
            Self::Falling(heap) => Opened::Volume(recorded(*heap, count, 1)?),
        })
    }

    /// The frames of a fall all differ: all of them are played, whatever time they take.
    fn effort(&self, effort: &Effort) -> Effort {
        let seconds = if matches!(self, Self::Falling(_)) { f64::INFINITY } else { effort.seconds };
        Effort { seconds, ..*effort }
    }
}

/// A scene, ready to be played.
enum Opened {
    Volume(Replay3),
    Plane(Replay2),
}

/// Every row.
///
/// ```
/// use asunder_benches::world;
/// let names: Vec<String> = world::cases().iter().map(world::name).collect();
/// assert!(names.contains(&"many_pyramids".into()) && names.contains(&"plane/mixed".into()));
/// assert!(names.contains(&"boxes_pile/falling".into()) && names.contains(&"convex_pile/falling".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let flat = [WorldScene::ManyPyramids, WorldScene::Mixed];
    let mut cases = Vec::new();
    for scene in WorldScene::ALL {
        let heaps = Falling::ALL.into_iter().filter(|heap| heap.at_rest() == scene);
        cases.extend(heaps.map(Case::Falling));
        cases.push(Case::Volume(scene));
    }
    cases.extend(flat.map(Case::Plane));
    cases
}

/// The name of a row, as `boxes_pile`.
///
/// ```
/// use asunder_benches::world::{Case, name};
/// use asunder_scenes::worlds::WorldScene;
/// assert_eq!(name(&Case::Volume(WorldScene::Crowd)), "crowd");
/// ```
pub fn name(case: &Case) -> String {
    match case {
        Case::Volume(scene) => scene.name().to_string(),
        Case::Plane(scene) => format!("plane/{}", scene.name()),
        Case::Falling(heap) => heap.name().to_string(),
    }
}

/// Measures one row, on one thread. Cost: about a second per variant; for a heap that falls, all of the effort's
/// frames, and some seconds for stepping it.
///
/// Must run where the library finds no second thread, as in a pool of one: thread time would miss the other.
///
/// # Errors
/// The library rejects the margin or a shape's mass, which it does not at present.
///
/// ```
/// use asunder_benches::{clock::Effort, world::{self, Case}};
/// use asunder_scenes::worlds::WorldScene;
/// let effort = Effort { rounds: 2, ..Effort::quick() };
/// let row = world::measure(&Case::Volume(WorldScene::ManyPyramids), 500, &effort)?;
/// assert!(row.ratio.is_some() && row.note.contains("points"), "{row:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(case: &Case, count: usize, effort: &Effort) -> Result<Row, Box<dyn Error>> {
    let (effort, row) = (case.effort(effort), Row::new(name(case), "frame", count));
    match case.open(count)? {
        Opened::Plane(replay) => measure_plane(replay, &effort, row),
        Opened::Volume(replay) => measure_volume(replay, &effort, row),
    }
}

fn measure_volume(mut replay: Replay3, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    row.n = replay.count();
    let mut ours = replay.ours()?;
    let Some(mut peer) = lean_of(&replay) else {
        row.remark("parry3d refuses a hull");
        return Ok(row);
    };
    ours.update();
    peer.update();
    let (mut race, mut stages) = (Race::default(), Stages::default());
    let (mut found, mut peer_found) = (Tally::default(), Tally::default());
    while !race.is_over(effort) {
        let poses = replay.poses_at(race.ours.len() as u32 + 1);
        let converted = Replay3::converted(&poses);
        let (walked, peer_walked) = race.turn(1, || ours.frame(&poses), || peer_frame(&mut peer, &converted));
        stages.push(ours.stats());
        found.push(ours.stats(), walked);
        peer_found.push_peer(&peer, peer_walked);
    }
    race.tell(&mut row, "lean parry3d");
    told(&mut row, &stages, &found);
    let peer = peer_found.mean();
    row.remark(&format!(
        "peer: {} candidates, {} contacts, {} points",
        peer.candidates, peer.contacts, peer.points
    ));
    Ok(row)
}

/// Fills in the stages of our frames, and their average findings.
fn told(row: &mut Row, stages: &Stages, found: &Tally) {
    let found = found.mean();
    row.world = Some(stages.figures(found.candidates, row.n));
    row.remark(&format!(
        "{} candidates, {} touching, {} contacts, {} points",
        found.candidates, found.touching, found.contacts, found.points
    ));
}

fn lean_of<R: Replay>(replay: &R) -> Option<Lean> {
    Some(Lean::new(replay.lean_bodies()?, MARGIN))
}

pub(crate) fn peer_frame(peer: &mut Lean, poses: &[(u32, Pose)]) -> Walked {
    for (i, pose) in poses {
        peer.set_pose(*i, *pose);
    }
    peer.update();
    peer.walk()
}

fn measure_plane(mut replay: Replay2, effort: &Effort, mut row: Row) -> Result<Row, Box<dyn Error>> {
    row.n = replay.count();
    let mut ours = replay.ours()?;
    ours.update();
    let (mut samples, mut stages, mut found) = (Samples::default(), Stages::default(), Tally::default());
    for frame in 1..=effort.rounds as u32 {
        let poses = replay.poses_at(frame);
        let (ns, walked) = time(|| ours.frame(&poses));
        samples.push(ns, ns);
        stages.push(ours.stats());
        found.push(ours.stats(), walked);
        if samples.spent() > effort.nanoseconds() {
            break;
        }
    }
    row.tell(&samples);
    row.done = samples.len();
    told(&mut row, &stages, &found);
    row.finish();
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_see_the_same_world() {
        for case in cases() {
            // A falling heap must be stepped first, which takes longer than all else here.
            let count = if matches!(case, Case::Falling(_)) { 305 } else { 1500 };
            let Opened::Volume(mut replay) = case.open(count).unwrap() else { continue };
            let (mut ours, mut peer) = (replay.ours().unwrap(), lean_of(&replay).unwrap());
            for frame in 0..4 {
                let poses = replay.poses_at(frame * 7);
                ours.frame(&poses);
                peer_frame(&mut peer, &Replay3::converted(&poses));
                // Our boxes are rounded outwards and may overlap where parry3d's do not, in a few of a thousand pairs.
                let (ours, peer) = (ours.stats().candidates as f64, peer.candidates() as f64);
                assert!((ours - peer).abs() <= 2.0 + 0.003 * peer, "{}: {ours} and {peer}", name(&case));
            }
        }
    }

    #[test]
    fn heaps_that_fall_are_rows_of_json_with_a_ratio_and_all_their_frames() {
        // As little time as possible; all frames are played nevertheless.
        let effort = Effort { seconds: 0.0, rounds: 5, ..Effort::quick() };
        for heap in Falling::ALL {
            let row = measure(&Case::Falling(heap), 130, &effort).unwrap();
            let json: serde_json::Value = serde_json::from_str(&row.to_json()).unwrap();
            assert_eq!((json["row"].as_str(), json["n"].as_u64()), (Some(heap.name()), Some(130)));
            assert!(json["ratio"].as_f64().is_some_and(|ratio| ratio > 0.0), "{json}");
            assert_eq!(json["done"].as_u64(), Some(5), "{json}");
        }
    }
}
