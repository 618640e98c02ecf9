//! Whole frames: from setting poses to having walked every contact point, beside the [`lean`](crate::lean) pipeline.
//!
//! Both sides keep contacts up to 2 cm apart. Rows that start with `plane/` are in the plane and have no peer.

pub(crate) mod play;
pub mod rows;
mod stages;
pub mod threads;

use crate::clock::{Effort, Samples, time};
use crate::lean::{Lean, Walked};
use crate::race::Race;
use crate::row::Row;
use asunder::{MarginError, Stats};
use asunder_scenes::worlds::{Replay2, Replay3, WorldScene};
use parry3d::math::Pose;
use play::{Play, Replay};
use stages::Stages;
pub use stages::{Figures, heading};

/// Gap within which two bodies are a contact, in metres: half of it is each body's margin.
pub(crate) const MARGIN: f32 = 0.02;

/// One row: a world, and whether it is in the plane.
pub type Case = (WorldScene, bool);

/// Every row.
///
/// ```
/// use asunder_benches::world;
/// let names: Vec<String> = world::cases().iter().map(world::name).collect();
/// assert!(names.contains(&"many_pyramids".into()) && names.contains(&"plane/mixed".into()));
/// ```
pub fn cases() -> Vec<Case> {
    let flat = [WorldScene::ManyPyramids, WorldScene::Mixed];
    WorldScene::ALL
        .into_iter()
        .map(|scene| (scene, false))
        .chain(flat.into_iter().map(|scene| (scene, true)))
        .collect()
}

/// The name of a row, as `boxes_pile`.
///
/// ```
/// use asunder_scenes::worlds::WorldScene;
/// assert_eq!(asunder_benches::world::name(&(WorldScene::Crowd, false)), "crowd");
/// ```
pub fn name(&(scene, in_plane): &Case) -> String {
    format!("{}{}", if in_plane { "plane/" } else { "" }, scene.name())
}

/// Measures one row, on one thread. Cost: about a second a variant.
///
/// Must run where the library finds no second thread, as in a pool of one: thread time would miss it.
///
/// # Errors
/// The margin, if the library came to refuse it.
///
/// ```
/// use asunder_benches::{clock::Effort, world};
/// use asunder_scenes::worlds::WorldScene;
/// let row = world::measure(&(WorldScene::ManyPyramids, false), 500, &Effort { rounds: 2, ..Effort::quick() })?;
/// assert!(row.ratio.is_some() && row.note.contains("points"), "{row:?}");
/// # Ok::<(), asunder::MarginError>(())
/// ```
pub fn measure(case: &Case, count: usize, effort: &Effort) -> Result<Row, MarginError> {
    match case {
        (scene, true) => measure_plane(*scene, count, effort, Row::new(name(case), "frame", count)),
        (scene, false) => measure_volume(*scene, count, effort, Row::new(name(case), "frame", count)),
    }
}

fn measure_volume(
    scene: WorldScene,
    count: usize,
    effort: &Effort,
    mut row: Row,
) -> Result<Row, MarginError> {
    let mut replay = Replay3::of(scene, count);
    row.n = replay.count();
    let mut ours = replay.ours()?;
    let Some(mut peer) = lean_of(&replay) else {
        row.remark("parry3d refuses a hull");
        return Ok(row);
    };
    ours.update();
    peer.update();
    let (mut race, mut stages) = (Race::default(), Stages::default());
    let (mut found, mut peer_found) = (Walked::default(), Walked::default());
    while !race.is_over(effort) {
        let poses = replay.poses_at(race.ours.len() as u32 + 1);
        let converted = Replay3::converted(&poses);
        (found, peer_found) = race.turn(1, || ours.frame(&poses), || peer_frame(&mut peer, &converted));
        stages.push(ours.stats());
    }
    race.tell(&mut row, "lean parry3d");
    told(&mut row, ours.stats(), &stages, found);
    row.remark(&format!(
        "peer: {} candidates, {} contacts, {} points",
        peer.candidates(),
        peer_found.contacts,
        peer_found.points
    ));
    Ok(row)
}

/// What our frames were made of, and what the last one found.
fn told(row: &mut Row, stats: &Stats, stages: &Stages, found: Walked) {
    row.world = Some(stages.figures(stats));
    row.remark(&format!(
        "{} candidates, {} touching, {} contacts, {} points",
        stats.candidates, stats.touching, found.contacts, found.points
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

fn measure_plane(scene: WorldScene, count: usize, effort: &Effort, mut row: Row) -> Result<Row, MarginError> {
    let mut replay = Replay2::of(scene, count);
    row.n = replay.count();
    let mut ours = replay.ours()?;
    ours.update();
    let (mut samples, mut stages, mut found) = (Samples::default(), Stages::default(), Walked::default());
    for frame in 1..=effort.rounds as u32 {
        let poses = replay.poses_at(frame);
        let ns;
        (ns, found) = time(|| ours.frame(&poses));
        samples.push(ns, ns);
        stages.push(ours.stats());
        if samples.spent() > effort.nanoseconds() {
            break;
        }
    }
    row.tell(&samples);
    row.done = samples.len();
    told(&mut row, ours.stats(), &stages, found);
    row.finish();
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_see_the_same_world() {
        for scene in WorldScene::ALL {
            let mut replay = Replay3::of(scene, 1500);
            let (mut ours, mut peer) = (replay.ours().unwrap(), lean_of(&replay).unwrap());
            for frame in 0..4 {
                let poses = replay.poses_at(frame * 7);
                ours.frame(&poses);
                peer_frame(&mut peer, &Replay3::converted(&poses));
                // Boxes rounded outwards may meet where parry3d's do not, within a few of a thousand.
                let (ours, peer) = (ours.stats().candidates as f64, peer.candidates() as f64);
                assert!((ours - peer).abs() <= 2.0 + 0.003 * peer, "{}: {ours} and {peer}", scene.name());
            }
        }
    }
}
