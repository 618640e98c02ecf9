//! Whole frames: from setting poses to having walked every contact point, beside the [`lean`](crate::lean) pipeline.
//!
//! Both sides keep contacts up to 2 cm apart. Rows that start with `plane/` are in the plane and have no peer.

pub mod rows;
mod stages;
pub mod threads;

use crate::clock::{Effort, Samples, time};
use crate::lean::{Lean, LeanBody, Walked};
use crate::parry::{self, Shapes};
use crate::race::Race;
use crate::row::Row;
use asunder::{BodyKey2, BodyKey3, Collider2, Collider3, MarginError, World2, World3};
use asunder_geometry::Pose3;
use asunder_scenes::worlds::{Body3, Replay2, Replay3, WorldScene};
use parry3d::math::Pose;
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
    let mut replay = Replay3::new(scene, count, 1);
    row.n = replay.bodies.len();
    let mut ours = Ours::new(&replay.bodies)?;
    let Some(mut peer) = lean_of(&replay.bodies) else {
        row.remark("parry3d refuses a hull");
        return Ok(row);
    };
    ours.world.update();
    peer.update();
    let (mut race, mut stages) = (Race::default(), Stages::default());
    let (mut found, mut peer_found) = (Walked::default(), Walked::default());
    while !race.is_over(effort) {
        let poses = poses_at(&mut replay, race.ours.len() as u32 + 1);
        let converted: Vec<(u32, Pose)> = poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
        (found, peer_found) = race.turn(1, || ours.frame(&poses), || peer_frame(&mut peer, &converted));
        stages.push(ours.world.stats());
    }
    race.tell(&mut row, "lean parry3d");
    let stats = ours.world.stats();
    row.world = Some(stages.figures(stats));
    row.remark(&format!(
        "{} candidates, {} touching, {} contacts, {} points",
        stats.candidates, stats.touching, found.contacts, found.points
    ));
    row.remark(&format!(
        "peer: {} candidates, {} contacts, {} points",
        peer.candidates(),
        peer_found.contacts,
        peer_found.points
    ));
    Ok(row)
}

/// Where the bodies that move are at a frame.
fn poses_at(replay: &mut Replay3, frame: u32) -> Vec<(u32, Pose3)> {
    replay.advance(frame);
    replay.movers().iter().map(|&i| (i, replay.bodies[i as usize].pose)).collect()
}

#[derive(Clone)]
pub(crate) struct Ours {
    pub(crate) world: World3,
    keys: Vec<BodyKey3>,
}

impl Ours {
    pub(crate) fn new(bodies: &[Body3]) -> Result<Self, MarginError> {
        let mut world = World3::new();
        let mut keys = Vec::with_capacity(bodies.len());
        for body in bodies {
            let mut collider = Collider3::new(body.shape.clone()).at(body.pose).margin(MARGIN * 0.5)?;
            if body.fixed {
                collider = collider.fixed();
            }
            if body.sensor {
                collider = collider.sensor();
            }
            if let Some(owner) = body.owner {
                collider = collider.owner(owner);
            }
            keys.push(world.insert(collider));
        }
        Ok(Self { world, keys })
    }

    pub(crate) fn frame(&mut self, poses: &[(u32, Pose3)]) -> Walked {
        for (i, pose) in poses {
            // No key is stale: no body is ever removed.
            let _ = self.world.set_pose(self.keys[*i as usize], *pose);
        }
        self.world.update();
        let mut walked = Walked::default();
        for contact in self.world.contacts() {
            walked.contacts += 1;
            for manifold in contact.manifolds {
                for point in &manifold.points {
                    walked.points += 1;
                    walked.checksum +=
                        point.separation + point.anchor_a.x + point.anchor_b.x + manifold.normal.x;
                }
            }
        }
        walked
    }
}

fn lean_of(bodies: &[Body3]) -> Option<Lean> {
    Some(Lean::new(lean_bodies(bodies)?, MARGIN))
}

fn lean_bodies(bodies: &[Body3]) -> Option<Vec<LeanBody>> {
    let mut shapes = Shapes::default();
    let convert = |body: &Body3| {
        let shape = shapes.convert(&body.shape)?;
        Some(LeanBody { shape, pose: parry::pose(&body.pose), fixed: body.fixed, owner: body.owner })
    };
    bodies.iter().map(convert).collect()
}

pub(crate) fn peer_frame(peer: &mut Lean, poses: &[(u32, Pose)]) -> Walked {
    for (i, pose) in poses {
        peer.set_pose(*i, *pose);
    }
    peer.update();
    peer.walk()
}

fn measure_plane(scene: WorldScene, count: usize, effort: &Effort, mut row: Row) -> Result<Row, MarginError> {
    let mut replay = Replay2::new(scene, count, 1);
    row.n = replay.bodies.len();
    let mut world = World2::new();
    let mut keys: Vec<BodyKey2> = Vec::with_capacity(replay.bodies.len());
    for body in &replay.bodies {
        let collider = Collider2::new(body.shape.clone()).at(body.pose).margin(MARGIN * 0.5)?;
        keys.push(world.insert(if body.fixed { collider.fixed() } else { collider }));
    }
    world.update();
    let (mut samples, mut stages, mut points) = (Samples::default(), Stages::default(), 0);
    for frame in 1..=effort.rounds as u32 {
        replay.advance(frame);
        let (ns, count) = time(|| {
            for &i in replay.movers() {
                // No key is stale: no body is ever removed.
                let _ = world.set_pose(keys[i as usize], replay.bodies[i as usize].pose);
            }
            world.update();
            let manifolds = world.contacts().flat_map(|contact| contact.manifolds);
            manifolds.flat_map(|manifold| &manifold.points).filter(|point| point.separation < 1.0).count()
        });
        samples.push(ns, ns);
        stages.push(world.stats());
        points = count;
        if samples.spent() > effort.nanoseconds() {
            break;
        }
    }
    row.done = samples.len();
    row.ours_ns = samples.median();
    let stats = world.stats();
    row.world = Some(stages.figures(stats));
    row.remark(&format!("{} candidates, {} touching, {points} points", stats.candidates, stats.touching));
    row.finish();
    Ok(row)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_sides_see_the_same_world() {
        for scene in WorldScene::ALL {
            let mut replay = Replay3::new(scene, 1500, 1);
            let (mut ours, mut peer) = (Ours::new(&replay.bodies).unwrap(), lean_of(&replay.bodies).unwrap());
            for frame in 0..4 {
                replay.advance(frame * 7);
                let poses: Vec<(u32, Pose3)> =
                    replay.movers().iter().map(|&i| (i, replay.bodies[i as usize].pose)).collect();
                let converted: Vec<(u32, Pose)> =
                    poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect();
                ours.frame(&poses);
                peer_frame(&mut peer, &converted);
                // Boxes rounded outwards may meet where parry3d's do not, within a few of a thousand.
                let (ours, peer) = (ours.world.stats().candidates as f64, peer.candidates() as f64);
                assert!((ours - peer).abs() <= 2.0 + 0.003 * peer, "{}: {ours} and {peer}", scene.name());
            }
        }
    }
}
