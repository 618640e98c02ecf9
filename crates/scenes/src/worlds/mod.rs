//! Whole worlds: bodies with known poses in every frame, to measure a whole frame from poses to contacts.
//!
//! A [`WorldScene`] needs no solver: a body sways about its place, or flies straight and turns back at a wall, as a
//! function of the frame's number alone. To an engine, a heap at rest therefore looks like one held by a solver: nearly
//! the same pairs each frame, and every pose a little different. A heap that falls does need a solver: step
//! [`Falling`](crate::stages::Falling) once, and [`Replay3::recorded`] replays the poses.
//!
//! ```
//! use asunder_scenes::worlds::{Replay2, Replay3, WorldScene};
//! let mut heap = Replay3::new(WorldScene::BoxesPile, 500, 1);
//! let before = heap.bodies[heap.movers()[3] as usize].pose;
//! heap.advance(30);
//! assert_ne!(heap.bodies[heap.movers()[3] as usize].pose, before);
//! let mut flat = Replay2::new(WorldScene::ManyPyramids, 500, 1);
//! flat.advance(1);
//! assert!(flat.bodies.len() >= 400);
//! ```

mod city;
mod crowd;
pub(crate) mod motion;
pub(crate) mod piles;
mod plane;

use crate::pairs::pose3;
use asunder_geometry::{Pose2, Pose3, Shape2, Shape3};
use glam::{Vec2, Vec3};
use motion::{Motion2, Motion3};
use std::sync::Arc;

/// The named worlds.
///
/// ```
/// use asunder_scenes::worlds::WorldScene;
/// assert_eq!(WorldScene::by_name("crowd"), Some(WorldScene::Crowd));
/// assert!(WorldScene::ALL.iter().all(|&scene| WorldScene::by_name(scene.name()) == Some(scene)));
/// assert_eq!(WorldScene::Crowd.usual_count(), 3801);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum WorldScene {
    /// Boxes on boxes in a pit, at rest but awake.
    BoxesPile,
    /// Hulls of 32 points in a pit, at rest but awake.
    ConvexPile,
    /// Pyramids twenty boxes high on a floor, at rest but awake.
    ManyPyramids,
    /// Boxes and hulls of 8, 16 and 32 points in the air; every other one rotates and drifts.
    Mixed,
    /// Walking characters of 19 parts each; parts of one character do not collide.
    Crowd,
    /// A city of fixed boxes in which one body of a hundred moves.
    MostlyStatic,
    /// A far larger city in which one body of ten thousand moves.
    World1m,
    /// Loosely spread shapes that could all move; one of a hundred does.
    Spread1,
}

impl WorldScene {
    /// Every world, in the order in which results are listed.
    pub const ALL: [Self; 8] = [
        Self::BoxesPile,
        Self::ConvexPile,
        Self::ManyPyramids,
        Self::Mixed,
        Self::Crowd,
        Self::MostlyStatic,
        Self::World1m,
        Self::Spread1,
    ];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BoxesPile => "boxes_pile",
            Self::ConvexPile => "convex_pile",
            Self::ManyPyramids => "many_pyramids",
            Self::Mixed => "mixed",
            Self::Crowd => "crowd",
            Self::MostlyStatic => "mostly_static",
            Self::World1m => "world1m",
            Self::Spread1 => "spread1",
        }
    }

    /// The world of that name, if there is one.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scene| scene.name() == name)
    }

    /// The number of bodies it is usually measured with.
    pub const fn usual_count(self) -> usize {
        match self {
            Self::BoxesPile => 8005,
            Self::ConvexPile => 5125,
            Self::ManyPyramids => 10_081,
            Self::Mixed => 10_000,
            Self::Crowd => 3801,
            Self::MostlyStatic => 101_001,
            Self::World1m => 1_000_101,
            Self::Spread1 => 10_000,
        }
    }
}

/// A body in space.
///
/// ```
/// use asunder_scenes::worlds::{Body3, Replay3, WorldScene};
/// let floor: Body3 = Replay3::new(WorldScene::ManyPyramids, 300, 1).bodies.remove(0);
/// assert!(floor.fixed && !floor.sensor);
/// ```
#[derive(Clone, Debug)]
pub struct Body3 {
    /// Its shape; clones share data.
    pub shape: Shape3,
    /// Where it is in this frame.
    pub pose: Pose3,
    /// Its drift at the start, in m/s; swaying about a place does not count.
    pub velocity: Vec3,
    /// Whether it never moves. Two fixed bodies are no pair.
    pub fixed: bool,
    /// Whether it is a sensor, which detects but does not collide.
    pub sensor: bool,
    /// Two bodies with the same owner are no pair.
    pub owner: Option<u64>,
}

/// A body in the plane.
///
/// ```
/// use asunder_scenes::worlds::{Body2, Replay2, WorldScene};
/// let floor: Body2 = Replay2::new(WorldScene::ManyPyramids, 300, 1).bodies.remove(0);
/// assert!(floor.fixed && !floor.sensor);
/// ```
#[derive(Clone, Debug)]
pub struct Body2 {
    /// Its shape; clones share data.
    pub shape: Shape2,
    /// Where it is in this frame.
    pub pose: Pose2,
    /// Its drift at the start, in m/s; swaying about a place does not count.
    pub velocity: Vec2,
    /// Whether it never moves. Two fixed bodies are no pair.
    pub fixed: bool,
    /// Whether it is a sensor, which detects but does not collide.
    pub sensor: bool,
    /// Two bodies with the same owner are no pair.
    pub owner: Option<u64>,
}

/// A world in space at one frame. See the [module](self) on its motion.
#[derive(Clone, Debug, Default)]
pub struct Replay3 {
    /// All bodies, in this frame's poses.
    pub bodies: Vec<Body3>,
    movers: Vec<u32>,
    motions: Vec<Motion3>,
    /// The poses of the movers, frame by frame, if recorded: they replace the motions.
    recording: Option<Arc<[Vec<Pose3>]>>,
}

impl Replay3 {
    /// The world at frame 0, with `count` bodies or a few less so that pyramids and characters are whole.
    pub fn new(scene: WorldScene, count: usize, seed: u64) -> Self {
        let mut replay = match scene {
            WorldScene::BoxesPile => piles::boxes(count, seed),
            WorldScene::ConvexPile => piles::hulls(count, seed),
            WorldScene::ManyPyramids => piles::pyramids(count, seed),
            WorldScene::Mixed => piles::mixed(count, seed),
            WorldScene::Crowd => crowd::walkers(count, seed),
            WorldScene::MostlyStatic => city::streets(count, 101, seed),
            WorldScene::World1m => city::streets(count, 10_001, seed),
            WorldScene::Spread1 => piles::spread(count, seed),
        };
        replay.advance(0);
        replay
    }

    /// Bodies that follow a recording: for each frame, the poses of all bodies that are not fixed, in their order.
    /// After the last frame they go back the way they came, and so on. Clones share the poses.
    ///
    /// ```
    /// use asunder_geometry::Pose3;
    /// use asunder_scenes::worlds::{Replay3, WorldScene};
    /// let bodies = Replay3::new(WorldScene::ManyPyramids, 211, 1).bodies;
    /// let at = |height: f64| vec![Pose3::at([0.0, height, 0.0]).unwrap(); 210];
    /// let mut replay = Replay3::recorded(bodies, vec![at(3.0), at(2.0), at(1.0)]);
    /// let heights = [0, 1, 2, 3, 4, 5].map(|frame| {
    ///     replay.advance(frame);
    ///     replay.bodies[7].pose.position().y
    /// });
    /// assert_eq!(heights, [3.0, 2.0, 1.0, 2.0, 3.0, 2.0]);
    /// ```
    pub fn recorded(bodies: Vec<Body3>, frames: Vec<Vec<Pose3>>) -> Self {
        let movers = (0..).zip(&bodies).filter(|(_, body)| !body.fixed).map(|(i, _)| i).collect();
        let mut replay = Self { bodies, movers, motions: Vec::new(), recording: Some(frames.into()) };
        replay.advance(0);
        replay
    }

    /// Sets the poses of all moving bodies to those at frame number `frame`, of 1/60 s. Cost: some 100 ns per moving
    /// body, and less where poses were recorded.
    pub fn advance(&mut self, frame: u32) {
        if let Some(frames) = &self.recording {
            let poses = to_and_fro(frame as usize, frames.len()).and_then(|place| frames.get(place));
            for (&i, pose) in self.movers.iter().zip(poses.into_iter().flatten()) {
                self.bodies[i as usize].pose = *pose;
            }
            return;
        }
        for (&i, motion) in self.movers.iter().zip(&self.motions) {
            let (position, turn) = motion.at(frame);
            self.bodies[i as usize].pose = pose3(position, turn);
        }
    }

    /// The bodies that move, ascending: the same in all frames.
    pub fn movers(&self) -> &[u32] {
        &self.movers
    }

    /// The motions of the movers, in the same order.
    pub(crate) fn motions(&self) -> &[Motion3] {
        &self.motions
    }

    fn fixed(&mut self, shape: Shape3, motion: Motion3) {
        self.resting(shape, motion);
        if let Some(body) = self.bodies.last_mut() {
            body.fixed = true;
        }
    }

    /// A body that could move but does not.
    fn resting(&mut self, shape: Shape3, motion: Motion3) {
        let (position, turn) = motion.at(0);
        let pose = pose3(position, turn);
        self.bodies.push(Body3 {
            shape,
            pose,
            velocity: Vec3::ZERO,
            fixed: false,
            sensor: false,
            owner: None,
        });
    }

    fn moving(&mut self, shape: Shape3, motion: Motion3, owner: Option<u64>) {
        let (position, turn) = motion.at(0);
        let (pose, velocity) = (pose3(position, turn), motion.velocity.as_vec3());
        self.movers.push(self.bodies.len() as u32);
        self.motions.push(motion);
        self.bodies.push(Body3 { shape, pose, velocity, fixed: false, sensor: false, owner });
    }
}

/// The index of the frame to show, out of `count` frames that are played back and forth; `None` if there are none.
fn to_and_fro(frame: usize, count: usize) -> Option<usize> {
    let last = count.checked_sub(1)?;
    let place = frame % (2 * last).max(1);
    Some(place.min(2 * last - place.min(2 * last)))
}

/// A world in the plane at one frame. See the [module](self) on its motion.
#[derive(Clone, Debug, Default)]
pub struct Replay2 {
    /// All bodies, in this frame's poses.
    pub bodies: Vec<Body2>,
    movers: Vec<u32>,
    motions: Vec<Motion2>,
}

impl Replay2 {
    /// The world at frame 0, with `count` bodies or a few less so that pyramids are whole.
    ///
    /// Only [`WorldScene::ManyPyramids`] and [`WorldScene::Mixed`] have twins in the plane; any other scene gives the
    /// latter.
    pub fn new(scene: WorldScene, count: usize, seed: u64) -> Self {
        let mut replay = match scene {
            WorldScene::ManyPyramids => plane::pyramids(count, seed),
            _ => plane::mixed(count, seed),
        };
        replay.advance(0);
        replay
    }

    /// Sets the poses of all moving bodies to those at frame number `frame`, of 1/60 s.
    pub fn advance(&mut self, frame: u32) {
        for (&i, motion) in self.movers.iter().zip(&self.motions) {
            self.bodies[i as usize].pose = motion.pose_at(frame);
        }
    }

    /// The bodies that move, ascending: the same in all frames.
    pub fn movers(&self) -> &[u32] {
        &self.movers
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn worlds_have_as_many_bodies_as_usual() {
        for scene in WorldScene::ALL {
            let replay = Replay3::new(scene, scene.usual_count(), 1);
            assert_eq!(replay.bodies.len(), scene.usual_count(), "{}", scene.name());
            assert!(replay.movers().iter().all(|&i| !replay.bodies[i as usize].fixed));
        }
        assert_eq!(Replay3::new(WorldScene::MostlyStatic, 101_001, 1).movers().len(), 1000);
        assert_eq!(Replay3::new(WorldScene::World1m, 1_000_101, 1).movers().len(), 100);
        assert_eq!(Replay3::new(WorldScene::Spread1, 10_000, 1).movers().len(), 100);
        assert_eq!(Replay3::new(WorldScene::Mixed, 1000, 1).movers().len(), 500);
    }

    #[test]
    fn frames_depend_on_their_number_alone() {
        for scene in WorldScene::ALL {
            let mut one = Replay3::new(scene, 1000, 1);
            let mut other = one.clone();
            one.advance(3);
            one.advance(40);
            other.advance(40);
            assert!(one.bodies.iter().zip(&other.bodies).all(|(a, b)| a.pose == b.pose), "{}", scene.name());
        }
    }

    #[test]
    fn worlds_in_the_plane_have_whole_pyramids_and_move() {
        let mut pyramids = Replay2::new(WorldScene::ManyPyramids, 10_081, 1);
        assert_eq!((pyramids.bodies.len(), pyramids.movers().len()), (10_081, 10_080));
        let before = pyramids.bodies[7].pose;
        pyramids.advance(9);
        assert_ne!(pyramids.bodies[7].pose, before);
        assert_eq!(Replay2::new(WorldScene::Mixed, 1000, 1).movers().len(), 500);
    }
}
