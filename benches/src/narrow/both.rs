//! A pair in our types and in parry3d's, and every query on either side.

use super::Operation;
use crate::accuracy::Said;
use crate::parry::{self, Shapes};
use asunder_geometry::Pose3;
use asunder_narrow::{Answer, Batch3, Hint, Job3, Manifold3, Pair3, Separation3, collide3, separations3};
use asunder_scenes::pairs::PosedPair3;
use core::hint::black_box;
use glam::Vec3;
use parry3d::math::Pose;
use parry3d::query::{self, ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher};
use parry3d::shape::SharedShape;

/// A pair, in our types and in parry3d's.
pub(crate) struct Both {
    ours: PosedPair3,
    shapes: [SharedShape; 2],
    poses: [Pose; 2],
}

/// parry3d's manifolds, in memory that is reused.
pub(super) type Manifolds = Vec<ContactManifold<(), ()>>;

impl Both {
    /// The pairs in both types; `None` where parry3d rejects a hull.
    pub(crate) fn all(pairs: &[PosedPair3], shapes: &mut Shapes) -> Option<Vec<Self>> {
        let both = pairs.iter().map(|pair| {
            Some(Self {
                shapes: [shapes.convert(&pair.shape_a)?, shapes.convert(&pair.shape_b)?],
                poses: [parry::pose(&pair.pose_a), parry::pose(&pair.pose_b)],
                ours: pair.clone(),
            })
        });
        both.collect()
    }

    pub(crate) fn pair(&self) -> Pair3<'_> {
        Pair3::new(&self.ours.shape_a, &self.ours.pose_a, &self.ours.shape_b, &self.ours.pose_b)
    }

    pub(super) fn job(&self, hint: Hint, sensor: bool) -> Job3<'_> {
        let PosedPair3 { shape_a, pose_a, shape_b, pose_b } = &self.ours;
        Job3 { shape_a, pose_a, shape_b, pose_b, margin: 0.0, hint, ahead: 0.0, sensor }
    }

    pub(super) fn poses(&self) -> [Pose3; 2] {
        [self.ours.pose_a, self.ours.pose_b]
    }

    /// Shapes and poses in parry3d's types.
    pub(crate) fn of_peer(&self) -> (&[SharedShape; 2], &[Pose; 2]) {
        (&self.shapes, &self.poses)
    }

    /// Our answer: returns a number from it, so that none of it can be optimised away.
    pub(crate) fn ask(&self, operation: Operation) -> f32 {
        let pair = self.pair();
        match operation {
            Operation::Boolean => f32::from(u8::from(pair.overlaps())),
            Operation::Separation => match pair.separation(0.0) {
                Separation3::Measured(found) => found.separation + found.normal.x,
                Separation3::AtLeast(bound) => bound,
            },
            Operation::Distance => pair.distance().map_or(0.0, |closest| closest.distance),
            Operation::Manifold | Operation::Cached => {
                let manifold = black_box(pair.manifold(0.0));
                manifold.map_or(0.0, |manifold| manifold.points.iter().map(|point| point.separation).sum())
            }
        }
    }

    /// Our answer, to be judged.
    pub(crate) fn said(&self, operation: Operation) -> Said {
        let pair = self.pair();
        match operation {
            Operation::Boolean => Said { touching: pair.overlaps(), separation: None },
            Operation::Separation => of_separation(&pair.separation(0.0)),
            Operation::Distance => {
                let found = pair.distance();
                Said { touching: found.is_none(), separation: found.map(|closest| closest.distance.into()) }
            }
            Operation::Manifold | Operation::Cached => of_manifolds(&pair.manifolds(0.0)),
        }
    }
}

/// Our answers to many pairs at once, to be judged.
pub(super) fn said_at_once(operation: Operation, pairs: &[&Both]) -> Vec<Said> {
    if operation == Operation::Separation {
        let ours: Vec<Pair3<'_>> = pairs.iter().map(|both| both.pair()).collect();
        let mut found = Vec::new();
        separations3(&ours, 0.0, &mut found);
        return found.iter().map(of_separation).collect();
    }
    let is_sensor = operation == Operation::Boolean;
    let jobs: Vec<Job3<'_>> = pairs.iter().map(|both| both.job(Hint::NONE, is_sensor)).collect();
    let mut batch = Batch3::default();
    collide3(&jobs, &mut batch);
    batch.answers.iter().map(|answer| of_answer(answer, is_sensor, &batch.manifolds)).collect()
}

fn of_separation(found: &Separation3) -> Said {
    match found {
        Separation3::Measured(found) => {
            Said { touching: found.separation <= 0.0, separation: Some(found.separation.into()) }
        }
        Separation3::AtLeast(_) => Said { touching: false, separation: None },
    }
}

/// An answer of a batch, to be judged.
pub(super) fn of_answer(answer: &Answer, is_sensor: bool, manifolds: &[Manifold3]) -> Said {
    match answer {
        Answer::Apart { .. } => Said { touching: false, separation: None },
        Answer::Contact { overlapping, .. } if is_sensor => Said { touching: *overlapping, separation: None },
        Answer::Contact { manifolds: range, .. } => {
            of_manifolds(&manifolds[range.start as usize..range.end as usize])
        }
    }
}

/// The depth of manifolds, to be judged.
pub(super) fn of_manifolds(manifolds: &[Manifold3]) -> Said {
    of_depths(manifolds.iter().map(|manifold| manifold.separation))
}

/// The separation of the deepest of them.
fn of_depths(separations: impl Iterator<Item = f32>) -> Said {
    let deepest = separations.map(f64::from).reduce(f64::min);
    Said { touching: deepest.is_some(), separation: deepest }
}

/// parry3d, with manifolds whose memory is reused from pair to pair.
#[derive(Default)]
pub(crate) struct Peer {
    manifolds: Manifolds,
}

impl Peer {
    /// Its answer: returns a number from it, so that none of it can be optimised away.
    pub(crate) fn ask(&mut self, operation: Operation, both: &Both) -> f32 {
        let ([a, b], [pose_a, pose_b]) = (&both.shapes, &both.poses);
        let (a, b) = (&*a.0, &*b.0);
        match operation {
            Operation::Boolean => f32::from(u8::from(both.peer_overlaps())),
            Operation::Separation => match query::contact(pose_a, a, pose_b, b, 0.0) {
                Ok(Some(contact)) => contact.dist + contact.normal1.x,
                _ => 0.0,
            },
            Operation::Distance => query::distance(pose_a, a, pose_b, b).map_or(0.0, |found| found.distance),
            Operation::Manifold | Operation::Cached => {
                self.forget();
                both.peer_manifolds(&mut self.manifolds)
            }
        }
    }

    /// Its answer, to be judged.
    pub(crate) fn said(&mut self, operation: Operation, both: &Both) -> Said {
        let ([a, b], [pose_a, pose_b]) = (&both.shapes, &both.poses);
        let (a, b) = (&*a.0, &*b.0);
        match operation {
            Operation::Boolean => Said { touching: both.peer_overlaps(), separation: None },
            Operation::Separation => match query::contact(pose_a, a, pose_b, b, 0.0) {
                Ok(Some(contact)) => Said { touching: true, separation: Some(contact.dist.into()) },
                _ => Said { touching: false, separation: None },
            },
            Operation::Distance => {
                let found = query::distance(pose_a, a, pose_b, b).map_or(0.0, |found| found.distance);
                let touching = found == 0.0;
                Said { touching, separation: (!touching).then_some(found.into()) }
            }
            Operation::Manifold | Operation::Cached => {
                self.forget();
                both.peer_manifolds(&mut self.manifolds);
                of_peer(&self.manifolds)
            }
        }
    }

    /// Without points and normal a manifold holds nothing from before; its allocation may stay.
    fn forget(&mut self) {
        for manifold in &mut self.manifolds {
            manifold.points.clear();
            (manifold.local_n1, manifold.local_n2) = (Vec3::ZERO, Vec3::ZERO);
        }
    }
}

/// The depth of parry3d's manifolds, to be judged.
pub(super) fn of_peer(manifolds: &Manifolds) -> Said {
    of_depths(manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.dist))
}

impl Both {
    fn peer_overlaps(&self) -> bool {
        let ([a, b], [pose_a, pose_b]) = (&self.shapes, &self.poses);
        // Unsupported combinations do not occur: all shapes are convex.
        query::intersection_test(pose_a, &*a.0, pose_b, &*b.0).is_ok_and(|found| found.intersecting)
    }

    /// Updates parry3d's manifolds from their last state.
    pub(super) fn peer_manifolds(&self, manifolds: &mut Manifolds) -> f32 {
        let ([a, b], [pose_a, pose_b]) = (&self.shapes, &self.poses);
        let relative = pose_a.inv_mul(pose_b);
        // Both shapes are convex, which parry3d supports in every combination.
        let _ = DefaultQueryDispatcher.contact_manifolds(&relative, &*a.0, &*b.0, 0.0, manifolds, &mut None);
        manifolds.iter().flat_map(|manifold| &manifold.points).map(|point| point.dist).sum()
    }
}
