//! Queries to a structure of resting boxes: our index beside parry3d's `Bvh`, both built once.
//!
//! A row is a thousand queries; its time is per query. Both sides must give the same answers.

use super::size_name;
use crate::clock::{Effort, time};
use crate::parry;
use crate::race::Race;
use crate::row::Row;
use asunder_broad::{self as broad, Cast, Index, Queue};
use asunder_geometry::{Aabb3, Ray3};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_scenes::random::Random;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};
use parry3d::bounding_volume::Aabb;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhNode, TraversalAction};
use parry3d::query::{PointQuery, Ray, RayCast};

/// Queries per row.
const QUESTIONS: usize = 1000;

/// The kind of query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// The first box hit by a ray.
    RayFirst,
    /// All boxes crossed by a ray, in order of distance.
    RayAll,
    /// All boxes that overlap a box with sides of 1 to 5 m, in no order.
    Overlap,
    /// The box nearest to a point.
    Nearest,
}

impl Question {
    /// Every query, in the order in which results are listed.
    pub const ALL: [Self; 4] = [Self::RayFirst, Self::RayAll, Self::Overlap, Self::Nearest];

    /// The name used in result rows.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RayFirst => "ray first",
            Self::RayAll => "ray all",
            Self::Overlap => "overlap",
            Self::Nearest => "nearest",
        }
    }
}

/// One row: the boxes, and the query.
pub type Case = (BoxScene, usize, Question);

/// Every row.
///
/// ```
/// use asunder_benches::{broad::queries, clock::Effort};
/// let names: Vec<String> = queries::cases(&Effort::full()).iter().map(queries::name).collect();
/// assert!(names.contains(&"query/gas/100k/ray first".into()) && names.len() == 8);
/// ```
pub fn cases(effort: &Effort) -> Vec<Case> {
    let count = if effort.is_quick { 10_000 } else { 100_000 };
    let scenes = [BoxScene::Gas, BoxScene::City];
    scenes.into_iter().flat_map(|scene| Question::ALL.map(|question| (scene, count, question))).collect()
}

/// The name of a row, as `query/city/100k/nearest`.
///
/// ```
/// use asunder_benches::broad::queries::{Question, name};
/// use asunder_scenes::boxes::BoxScene;
/// assert_eq!(name(&(BoxScene::City, 10_000, Question::Nearest)), "query/city/10k/nearest");
/// ```
pub fn name(&(scene, count, question): &Case) -> String {
    format!("query/{}/{}/{}", scene.name(), size_name(count), question.name())
}

/// Measures one row, on one thread. Cost: about a second per side, and the building of both structures.
///
/// ```
/// use asunder_benches::{broad::queries::{Question, measure}, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let row = measure(&(BoxScene::Gas, 500, Question::RayAll), &Effort { rounds: 2, ..Effort::quick() });
/// assert!(row.peer_ns.is_some() && row.ours_ns.is_some() && !row.note.contains("DIFFER"), "{row:?}");
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let &(scene, count, question) = case;
    let mut row = Row::new(name(case), "question", count);
    let boxes = MovingBoxes::new(scene, count, 1).boxes;
    let asked = Asked::new(&boxes);
    let (mut ours, mut peer) = (Ours::new(&boxes), Peer::new(&boxes));
    let (mut race, mut answers, mut differ) = (Race::default(), Found::default(), false);
    while !race.is_over(effort) {
        let ours = || ours.ask(question, &asked);
        let (found, found_by_peer) = race.turn(QUESTIONS, ours, || peer.ask(question, &asked));
        differ |= found != found_by_peer;
        answers = found;
    }
    race.tell(&mut row, "parry3d Bvh");
    row.remark(&format!("{:.2} found a question", answers.count as f64 / QUESTIONS as f64));
    row.remark(&format!("built in {:.0} ns a box, peer {:.0}", ours.built_ns, peer.built_ns));
    if differ {
        row.remark("ANSWERS DIFFER");
    }
    row
}

/// The queries, at random places all over the boxes.
struct Asked {
    rays: Vec<Ray>,
    regions: Vec<Aabb>,
    points: Vec<Vec3>,
}

impl Asked {
    fn new(boxes: &[Aabb3]) -> Self {
        let whole = boxes.iter().copied().reduce(|all, one| all.union(&one));
        let whole = whole.unwrap_or(Aabb3::new(Vec3::ZERO, Vec3::ONE));
        let (low, high) = (whole.min.as_dvec3(), whole.max.as_dvec3());
        let mut random = Random::new(17);
        let mut place = move || (random.within(low, high), random.direction(), random.unit());
        let mut places = || (0..QUESTIONS).map(|_| place()).collect::<Vec<_>>();
        let region = |at: DVec3, size: f64| {
            let half = DVec3::splat(0.5 + 2.0 * size);
            Aabb::new((at - half).as_vec3(), (at + half).as_vec3())
        };
        Self {
            rays: places().iter().map(|(at, along, _)| Ray::new(at.as_vec3(), along.as_vec3())).collect(),
            regions: places().iter().map(|&(at, _, size)| region(at, size)).collect(),
            points: places().iter().map(|(at, _, _)| at.as_vec3()).collect(),
        }
    }
}

/// The sum of all answers of a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Found {
    /// Boxes.
    count: usize,
    /// A checksum that reads every answer, so that nothing is optimised away and both sides can be compared: the sum of
    /// the boxes' numbers, each times its place in the answer where there is an order.
    checksum: u64,
}

impl Found {
    fn push(&mut self, number: u32, place: usize) {
        self.count += 1;
        self.checksum = self.checksum.wrapping_add(u64::from(number) * (place as u64 + 1));
    }
}

impl Found {
    /// If several boxes are at distance 0, any of them may come first.
    fn push_first(&mut self, number: u32, distance: f64) {
        self.push(if distance > 0.0 { number } else { 0 }, 0);
    }
}

struct Ours {
    index: Index<Aabb3>,
    built_ns: f64,
    queue: Queue,
    hits: Vec<broad::Found>,
    nearest: Vec<broad::Found>,
}

impl Ours {
    fn new(boxes: &[Aabb3]) -> Self {
        let mut index = Index::new();
        // The second build is timed: memory is allocated by then.
        index.build(boxes);
        let (ns, ()) = time(|| index.build(boxes));
        let built_ns = ns / boxes.len().max(1) as f64;
        Self { index, built_ns, queue: Queue::new(), hits: Vec::new(), nearest: Vec::new() }
    }

    fn ask(&mut self, question: Question, asked: &Asked) -> Found {
        let mut found = Found::default();
        let casts = asked.rays.iter().map(|ray| Ray3::new(ray.origin.as_dvec3(), ray.dir).map(Cast::from));
        match question {
            Question::RayFirst => casts.flatten().for_each(|cast| {
                self.index.crossed_in_order(&cast, f64::INFINITY, &mut self.queue, |first| {
                    found.push_first(first.number, first.distance);
                    -1.0
                });
            }),
            Question::RayAll => casts.flatten().for_each(|cast| {
                self.index.crossed(&cast, f64::INFINITY, &mut self.hits);
                self.hits.iter().enumerate().for_each(|(place, hit)| found.push(hit.number, place));
            }),
            Question::Overlap => asked.regions.iter().for_each(|region| {
                let region = Aabb3::new(region.mins, region.maxs);
                let _ = self.index.visit_overlapping(&region, |number| {
                    found.push(number, 0);
                    ControlFlow::Continue(())
                });
            }),
            Question::Nearest => asked.points.iter().for_each(|&point| {
                self.index.nearest(&Aabb3::new(point, point), 1, &mut self.queue, &mut self.nearest);
                self.nearest.iter().for_each(|first| found.push_first(first.number, first.distance));
            }),
        }
        found
    }
}

struct Peer {
    boxes: Vec<Aabb>,
    tree: Bvh,
    built_ns: f64,
    hits: Vec<(f32, u32)>,
}

impl Peer {
    fn new(boxes: &[Aabb3]) -> Self {
        let boxes: Vec<Aabb> = boxes.iter().map(parry::bounds).collect();
        let (ns, tree) = time(|| Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes));
        Self { built_ns: ns / boxes.len().max(1) as f64, boxes, tree, hits: Vec::new() }
    }

    fn ask(&mut self, question: Question, asked: &Asked) -> Found {
        let mut found = Found::default();
        match question {
            Question::RayFirst => asked.rays.iter().for_each(|ray| self.ray_first(ray, &mut found)),
            Question::RayAll => asked.rays.iter().for_each(|ray| self.ray_all(ray, &mut found)),
            Question::Overlap => {
                let overlapping = asked.regions.iter().flat_map(|region| self.tree.intersect_aabb(region));
                overlapping.for_each(|number| found.push(number, 0));
            }
            Question::Nearest => asked.points.iter().for_each(|&point| self.nearest(point, &mut found)),
        }
        found
    }

    fn ray_first(&self, ray: &Ray, found: &mut Found) {
        let meets = |i: u32, best: f32| self.boxes[i as usize].cast_local_ray(ray, best, true);
        if let Some((number, distance)) = self.tree.cast_ray(ray, f32::MAX, meets) {
            found.push_first(number, f64::from(distance));
        }
    }

    /// A leaf is its box, so the test of nodes is also the test of boxes.
    fn ray_all(&mut self, ray: &Ray, found: &mut Found) {
        let hits = &mut self.hits;
        hits.clear();
        self.tree.traverse(|node| {
            let distance = node.cast_ray(ray, f32::MAX);
            if distance == f32::MAX {
                return TraversalAction::Prune;
            }
            if let Some(number) = node.leaf_data() {
                hits.push((distance, number));
            }
            TraversalAction::Continue
        });
        hits.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        hits.iter().enumerate().for_each(|(place, &(_, number))| found.push(number, place));
    }

    fn nearest(&self, point: Vec3, found: &mut Found) {
        let to_node = |node: &BvhNode, _| node.aabb().distance_to_local_point(point, true);
        let to_box = |i: u32, _| Some(self.boxes[i as usize].distance_to_local_point(point, true));
        if let Some((number, distance)) = self.tree.find_best(f32::MAX, to_node, to_box) {
            found.push_first(number, f64::from(distance));
        }
    }
}
