//! The judge of whole frames: a pipeline over parry3d that does nothing a frame does not need.
//!
//! - Fixed bodies are in a tree of their own, built once: pairs of them cost nothing.
//! - Leaves of bodies that moved are set without margin, then `optimize_incremental` and `refit`, as rapier does.
//! - A pair's manifold is kept from frame to frame, so that parry3d can update it in place; a pair of which neither
//!   body moved is not queried again.
//! - Pairs are records in one vector, found by parry3d's own fast hash map; no events, no sorting, no layers.

use parry3d::bounding_volume::{Aabb, BoundingVolume};
use parry3d::math::Pose;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhNode, BvhWorkspace};

use parry3d::query::{
    ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher, PersistentQueryDispatcher,
};
use parry3d::shape::SharedShape;
use parry3d::utils::hashmap::HashMap;
use std::time::{Duration, Instant};

/// A body of the pipeline.
#[derive(Clone)]
pub struct LeanBody {
    /// Its shape.
    pub shape: SharedShape,
    /// Where it is.
    pub pose: Pose,
    /// Whether it never moves.
    pub fixed: bool,
    /// Two bodies with the same owner are no pair.
    pub owner: Option<u64>,
}

/// Bodies, trees, and the records of pairs.
///
/// ```
/// use asunder_benches::lean::{Lean, LeanBody};
/// use parry3d::{math::{Pose, Vector}, shape::SharedShape};
/// let body = |y: f32, fixed| LeanBody {
///     shape: SharedShape::cuboid(0.5, 0.5, 0.5),
///     pose: Pose::from_translation(Vector::new(0.0, y, 0.0)),
///     fixed,
///     owner: None,
/// };
/// let mut lean = Lean::new(vec![body(0.0, true), body(0.99, false)], 0.02);
/// lean.update();
/// assert_eq!((lean.candidates(), lean.walk().contacts), (1, 1));
/// lean.set_pose(1, Pose::from_translation(Vector::new(0.0, 2.0, 0.0)));
/// lean.update();
/// assert_eq!(lean.candidates(), 0);
/// ```
pub struct Lean {
    bodies: Vec<LeanBody>,
    /// The AABBs of this frame, grown by half the prediction.
    bounds: Vec<Aabb>,
    fixed: Bvh,
    moving: Bvh,
    workspace: BvhWorkspace,
    /// For each body, the frame in which it last moved.
    moved_in: Vec<u32>,
    moved: Vec<u32>,
    frame: u32,
    found: Vec<(u32, u32)>,
    places: HashMap<(u32, u32), u32>,
    records: Vec<Record>,
    prediction: f32,
    times: [Duration; 4],
}

struct Record {
    pair: (u32, u32),
    /// The frame in which the AABBs last overlapped.
    seen_in: u32,
    manifolds: Vec<ContactManifold<(), ()>>,
    workspace: Option<ContactManifoldsWorkspace>,
}

/// What a walk over all contact points found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Walked {
    /// Pairs with at least one point.
    pub contacts: usize,
    /// Contact points.
    pub points: usize,
    /// The sum of what was read, so that nothing is optimised away.
    pub checksum: f32,
}

impl Lean {
    /// A pipeline that keeps points with gaps of up to `prediction` metres.
    pub fn new(bodies: Vec<LeanBody>, prediction: f32) -> Self {
        let bounds: Vec<Aabb> = bodies.iter().map(|body| grown(body, prediction)).collect();
        let leaves = |fixed: bool| -> Vec<(usize, Aabb)> {
            let chosen = (0..bodies.len()).filter(|&i| bodies[i].fixed == fixed);
            chosen.map(|i| (i, bounds[i])).collect()
        };
        Self {
            fixed: tree(&leaves(true)),
            moving: tree(&leaves(false)),
            moved_in: vec![0; bodies.len()],
            bounds,
            bodies,
            workspace: BvhWorkspace::default(),
            moved: Vec::new(),
            frame: 0,
            found: Vec::new(),
            places: HashMap::default(),
            records: Vec::new(),
            prediction,
            times: [Duration::ZERO; 4],
        }
    }

    /// Moves a body that is not fixed.
    pub fn set_pose(&mut self, index: u32, pose: Pose) {
        self.bodies[index as usize].pose = pose;
        self.moved.push(index);
    }

    /// Updates all contacts.
    pub fn update(&mut self) {
        self.frame += 1;
        let stages = [Self::refit, Self::find_pairs, Self::keep_records, Self::collide];
        for (i, stage) in stages.into_iter().enumerate() {
            let start = Instant::now();
            stage(self);
            self.times[i] = start.elapsed();
        }
    }

    /// Wall-clock times of the last update: updating the trees, finding pairs, keeping records, computing contacts.
    pub fn times(&self) -> [Duration; 4] {
        self.times
    }

    /// Pairs whose AABBs overlapped at the last update.
    pub fn candidates(&self) -> usize {
        self.records.len()
    }

    /// Reads every contact point.
    pub fn walk(&self) -> Walked {
        let mut walked = Walked::default();
        for record in &self.records {
            let mut has_points = false;
            for manifold in &record.manifolds {
                for point in &manifold.points {
                    walked.points += 1;
                    walked.checksum += point.dist + point.local_p1.x + point.local_p2.x + manifold.local_n1.x;
                    has_points = true;
                }
            }
            walked.contacts += usize::from(has_points);
        }
        walked
    }

    fn refit(&mut self) {
        for &i in &self.moved {
            let bounds = grown(&self.bodies[i as usize], self.prediction);
            self.bounds[i as usize] = bounds;
            self.moved_in[i as usize] = self.frame;
            self.moving.insert_or_update_partially(bounds, i, 0.0);
        }
        if !self.moved.is_empty() {
            self.moving.optimize_incremental(&mut self.workspace);
            self.moving.refit(&mut self.workspace);
        }
        self.moved.clear();
    }

    fn find_pairs(&mut self) {
        self.found.clear();
        let (bodies, found) = (&self.bodies, &mut self.found);
        let admits = |a: u32, b: u32| {
            let owner = bodies[a as usize].owner;
            owner.is_none() || owner != bodies[b as usize].owner
        };
        self.moving.traverse_bvtt_single_tree::<false>(&mut self.workspace, &mut |a, b| {
            if admits(a, b) {
                found.push((a.min(b), a.max(b)));
            }
        });
        for (a, b) in self.moving.leaf_pairs(&self.fixed, BvhNode::intersects) {
            // The roots' first children are reported without a test.
            if self.bounds[a as usize].intersects(&self.bounds[b as usize]) && admits(a, b) {
                found.push((a.min(b), a.max(b)));
            }
        }
    }

    /// Adds records for new pairs, and removes those whose AABBs no longer overlap.
    fn keep_records(&mut self) {
        for &pair in &self.found {
            let place = *self.places.entry(pair).or_insert(self.records.len() as u32) as usize;
            if place == self.records.len() {
                self.records.push(Record { pair, seen_in: 0, manifolds: Vec::new(), workspace: None });
            }
            self.records[place].seen_in = self.frame;
        }
        let mut place = 0;
        while place < self.records.len() {
            if self.records[place].seen_in == self.frame {
                place += 1;
                continue;
            }
            let gone = self.records.swap_remove(place);
            self.places.remove(&gone.pair);
            if let Some(filler) = self.records.get(place) {
                self.places.insert(filler.pair, place as u32);
            }
        }
    }

    fn collide(&mut self) {
        for record in &mut self.records {
            let (a, b) = (record.pair.0 as usize, record.pair.1 as usize);
            let is_known = !record.manifolds.is_empty();
            if is_known && self.moved_in[a] != self.frame && self.moved_in[b] != self.frame {
                continue;
            }
            let (a, b) = (&self.bodies[a], &self.bodies[b]);
            // Convex shapes, and one mesh under all others: parry3d supports these in every combination.
            let _ = DefaultQueryDispatcher.contact_manifolds(
                &a.pose.inv_mul(&b.pose),
                &*a.shape.0,
                &*b.shape.0,
                self.prediction,
                &mut record.manifolds,
                &mut record.workspace,
            );
        }
    }
}

/// Works around parry3d 0.31.1, whose construction assumes that one or two leaves are numbered 0 and 1.
fn tree(leaves: &[(usize, Aabb)]) -> Bvh {
    if leaves.len() > 2 {
        return Bvh::from_iter(BvhBuildStrategy::Binned, leaves.iter().copied());
    }
    let mut tree = Bvh::new();
    for &(i, bounds) in leaves {
        tree.insert(bounds, i as u32);
    }
    tree
}

fn grown(body: &LeanBody, prediction: f32) -> Aabb {
    body.shape.compute_aabb(&body.pose).loosened(prediction * 0.5)
}
