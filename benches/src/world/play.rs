//! Worlds that are played, in space and in the plane: what a measurement of frames needs of either.

use super::MARGIN;
use crate::lean::{LeanBody, Walked};
use crate::parry::{self, Shapes};
use asunder::{BodyKey2, BodyKey3, Collider2, Collider3, MarginError, Stats, World2, World3};
use asunder_geometry::{Pose2, Pose3};
use asunder_scenes::worlds::{Body2, Body3, Replay2, Replay3};
use parry3d::math::Pose;

/// A scene whose poses are a function of the frame's number.
pub(crate) trait Replay: Clone + Send + Sync {
    /// The pose of a body.
    type Pose: Sync;
    /// Our world for it.
    type Ours: Play<Self::Pose>;

    /// The number of bodies.
    fn count(&self) -> usize;

    /// Builds our world of its bodies.
    fn ours(&self) -> Result<Self::Ours, MarginError>;

    /// The poses of the moving bodies at a frame.
    fn poses_at(&mut self, frame: u32) -> Vec<(u32, Self::Pose)>;

    /// The peer's bodies; `None` in the plane, or if it rejects a hull.
    fn lean_bodies(&self) -> Option<Vec<LeanBody>>;

    /// The same poses in the peer's types; none in the plane.
    fn converted(poses: &[(u32, Self::Pose)]) -> Vec<(u32, Pose)>;
}

/// A world of ours.
pub(crate) trait Play<P>: Clone + Send {
    /// One frame without any motion.
    fn update(&mut self);

    /// Sets poses, updates, and visits every contact point.
    fn frame(&mut self, poses: &[(u32, P)]) -> Walked;

    /// The stats of the last frame.
    fn stats(&self) -> &Stats;
}

/// Our world in space.
#[derive(Clone)]
pub(crate) struct Ours3 {
    world: World3,
    keys: Vec<BodyKey3>,
}

impl Ours3 {
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
}

impl Play<Pose3> for Ours3 {
    fn update(&mut self) {
        self.world.update();
    }

    fn frame(&mut self, poses: &[(u32, Pose3)]) -> Walked {
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

    fn stats(&self) -> &Stats {
        self.world.stats()
    }
}

impl Replay for Replay3 {
    type Pose = Pose3;
    type Ours = Ours3;

    fn count(&self) -> usize {
        self.bodies.len()
    }

    fn ours(&self) -> Result<Ours3, MarginError> {
        Ours3::new(&self.bodies)
    }

    fn poses_at(&mut self, frame: u32) -> Vec<(u32, Pose3)> {
        self.advance(frame);
        self.movers().iter().map(|&i| (i, self.bodies[i as usize].pose)).collect()
    }

    fn lean_bodies(&self) -> Option<Vec<LeanBody>> {
        let mut shapes = Shapes::default();
        let convert = |body: &Body3| {
            let shape = shapes.convert(&body.shape)?;
            Some(LeanBody { shape, pose: parry::pose(&body.pose), fixed: body.fixed, owner: body.owner })
        };
        self.bodies.iter().map(convert).collect()
    }

    fn converted(poses: &[(u32, Pose3)]) -> Vec<(u32, Pose)> {
        poses.iter().map(|(i, pose)| (*i, parry::pose(pose))).collect()
    }
}

/// Our world in the plane.
#[derive(Clone)]
pub(crate) struct Ours2 {
    world: World2,
    keys: Vec<BodyKey2>,
}

impl Ours2 {
    fn new(bodies: &[Body2]) -> Result<Self, MarginError> {
        let mut world = World2::new();
        let mut keys = Vec::with_capacity(bodies.len());
        for body in bodies {
            let collider = Collider2::new(body.shape.clone()).at(body.pose).margin(MARGIN * 0.5)?;
            keys.push(world.insert(if body.fixed { collider.fixed() } else { collider }));
        }
        Ok(Self { world, keys })
    }
}

impl Play<Pose2> for Ours2 {
    fn update(&mut self) {
        self.world.update();
    }

    fn frame(&mut self, poses: &[(u32, Pose2)]) -> Walked {
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

    fn stats(&self) -> &Stats {
        self.world.stats()
    }
}

impl Replay for Replay2 {
    type Pose = Pose2;
    type Ours = Ours2;

    fn count(&self) -> usize {
        self.bodies.len()
    }

    fn ours(&self) -> Result<Ours2, MarginError> {
        Ours2::new(&self.bodies)
    }

    fn poses_at(&mut self, frame: u32) -> Vec<(u32, Pose2)> {
        self.advance(frame);
        self.movers().iter().map(|&i| (i, self.bodies[i as usize].pose)).collect()
    }

    fn lean_bodies(&self) -> Option<Vec<LeanBody>> {
        None
    }

    fn converted(_: &[(u32, Pose2)]) -> Vec<(u32, Pose)> {
        Vec::new()
    }
}
