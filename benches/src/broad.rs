//! Broad phase: all overlapping pairs of a frame.
//!
//! Ours is the sorted list, filtered by layers; its two parts, sweep and order, are reported apart. parry3d's is the
//! unsorted list of the best of its ways to bring a tree up to date:
//! *incremental*, as rapier drives it (leaves in place, `optimize_incremental`, `refit`, whole traversal); *rebuild*
//! (binned, from scratch); and *changes* (as incremental, but only pairs of changed leaves are looked for, and the rest
//! of last frame's list is kept), where less than half of the boxes move.

use crate::clock::{Effort, Samples, time};
use crate::parry;
use crate::row::Row;
use asunder_broad::{PairId, Sweep};
use asunder_geometry::Aabb3;
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use core::ops::ControlFlow;
use parry3d::bounding_volume::Aabb;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};
use std::time::Instant;

/// The cases: every scene at every size, the small sizes first.
///
/// ```
/// use asunder_benches::{broad, clock::Effort};
/// let cases = broad::cases(&Effort::full(), false);
/// assert_eq!(broad::name(&cases[0]), "gas/1k");
/// assert!(cases.len() == 30 && broad::cases(&Effort::full(), true).len() == 40);
/// ```
pub fn cases(effort: &Effort, with_million: bool) -> Vec<(BoxScene, usize)> {
    let mut sizes = vec![1000, 10_000];
    if !effort.is_quick {
        sizes.push(100_000);
    }
    if with_million {
        sizes.push(1_000_000);
    }
    BoxScene::ALL.into_iter().flat_map(|scene| sizes.clone().into_iter().map(move |n| (scene, n))).collect()
}

/// The name of a case, as `gas/10k`.
///
/// ```
/// use asunder_scenes::boxes::BoxScene;
/// assert_eq!(asunder_benches::broad::name(&(BoxScene::Pile, 1_000_000)), "pile/1M");
/// ```
pub fn name(&(scene, count): &(BoxScene, usize)) -> String {
    let size = match count {
        1_000_000.. => format!("{}M", count / 1_000_000),
        1000.. => format!("{}k", count / 1000),
        _ => count.to_string(),
    };
    format!("{}/{size}", scene.name())
}

/// Measures one case. Cost: about a second a variant.
///
/// ```
/// use asunder_benches::{broad, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let row = broad::measure(&(BoxScene::City, 500), &Effort { rounds: 3, ..Effort::quick() });
/// assert!(row.ratio.is_some() && row.done == 3, "{row:?}");
/// ```
pub fn measure(case: &(BoxScene, usize), effort: &Effort) -> Row {
    let &(scene, count) = case;
    let mut row = Row::new(name(case), "frame", count);
    let mut moving = MovingBoxes::new(scene, count, 1);
    let mut ours = Ours::new(count);
    let converted: Vec<Aabb> = moving.boxes.iter().map(parry::bounds).collect();
    let mut peers = vec![Peer::new(Mode::Incremental, &converted), Peer::new(Mode::Rebuild, &converted)];
    if moving.moved().len() * 2 < count {
        peers.push(Peer::new(Mode::Changes, &converted));
    }
    let limit = effort.nanoseconds();
    for frame in 0..effort.rounds {
        moving.step();
        let moved: Vec<(u32, Aabb)> =
            moving.moved().iter().map(|&i| (i, parry::bounds(&moving.boxes[i as usize]))).collect();
        let mut found: Option<usize> = None;
        for peer in peers.iter_mut().filter(|peer| peer.samples.spent() < limit) {
            let count = peer.frame(&moved);
            if *found.get_or_insert(count) != count {
                row.remark(&format!("PAIRS DIFFER in frame {frame}: {} has {count}", peer.mode.name()));
            }
        }
        if ours.spent() < limit {
            ours.frame(&moving.boxes, found, effort, &mut row);
            if found.is_some_and(|found| found != ours.pairs.len()) && !ours.was_cut {
                row.remark(&format!("PAIRS DIFFER in frame {frame}: ours {}", ours.pairs.len()));
            }
        }
        let peers_are_done = peers.iter().all(|peer| peer.samples.spent() >= limit);
        if ours.spent() >= limit && peers_are_done {
            break;
        }
    }
    report(&mut row, &ours, &peers);
    row
}

fn report(row: &mut Row, ours: &Ours, peers: &[Peer]) {
    row.done = ours.total.len();
    row.ours_ns = ours.total.median();
    row.sweep_ns = ours.sweep.median();
    row.order_ns = match (row.ours_ns, row.sweep_ns, ours.was_cut) {
        (Some(total), Some(sweep), false) => Some((total - sweep).max(0.0)),
        _ => None,
    };
    let times = peers.iter().filter_map(|peer| Some((peer.samples.median()?, peer.mode)));
    if let Some((ns, mode)) = times.min_by(|a, b| a.0.total_cmp(&b.0)) {
        (row.peer, row.peer_ns) = (Some(mode.name()), Some(ns));
    }
    if !ours.was_cut {
        row.remark(&format!("{} pairs", ours.pairs.len()));
    }
    row.finish();
}

/// Every box is in one layer and meets it: the filter costs what it costs and drops nothing.
fn admits(layers: &[u32], a: u32, b: u32) -> bool {
    layers[a as usize] & layers[b as usize] != 0
}

struct Ours {
    engine: Sweep,
    layers: Vec<u32>,
    pairs: Vec<PairId>,
    sweep: Samples,
    total: Samples,
    /// The sweep took longer than a row may, and was broken off.
    was_cut: bool,
}

impl Ours {
    fn new(count: usize) -> Self {
        Self {
            engine: Sweep::new(),
            layers: vec![1; count],
            pairs: Vec::new(),
            sweep: Samples::default(),
            total: Samples::default(),
            was_cut: false,
        }
    }

    fn spent(&self) -> f64 {
        self.sweep.spent() + self.total.spent()
    }

    /// One frame: the sweep alone, and the whole, in turns as to which is first and finds cold caches.
    fn frame(&mut self, boxes: &[Aabb3], expected: Option<usize>, effort: &Effort, row: &mut Row) {
        let whole_first = self.total.len() % 2 == 1;
        if whole_first {
            self.whole(boxes);
        }
        let (ns, done) = self.visit(boxes, effort);
        if self.was_cut {
            let all = expected.unwrap_or(done).max(1);
            let estimate = ns * all as f64 / done.max(1) as f64;
            self.sweep.push(estimate, effort.nanoseconds());
            self.total.push(estimate, effort.nanoseconds());
            let percent = 100.0 * done as f64 / all as f64;
            row.remark(&format!(
                "stopped after {:.1} s at {percent:.0} % of {all} pairs: our time is extrapolated, without order",
                ns * 1e-9
            ));
            return;
        }
        self.sweep.push(ns, ns);
        if !whole_first {
            self.whole(boxes);
        }
    }

    /// What a user calls: sweep, filter, order.
    fn whole(&mut self, boxes: &[Aabb3]) {
        let (layers, pairs) = (&self.layers, &mut self.pairs);
        let (ns, _) = time(|| self.engine.pairs(boxes, |a, b| admits(layers, a, b), usize::MAX, pairs));
        self.total.push(ns, ns);
    }

    /// The sweep alone, into a list without order, broken off when its time is up.
    fn visit(&mut self, boxes: &[Aabb3], effort: &Effort) -> (f64, usize) {
        let start = Instant::now();
        let (layers, pairs) = (&self.layers, &mut self.pairs);
        pairs.clear();
        // Twice the time of a variant: so much more than that would not fit a second frame anyhow.
        let limit = 2.0 * effort.seconds;
        let (ns, flow) = time(|| {
            self.engine.visit(
                boxes,
                |a, b| admits(layers, a, b),
                |pair| {
                    pairs.push(pair);
                    let is_late = pairs.len() % 1024 == 0 && start.elapsed().as_secs_f64() > limit;
                    if is_late { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                },
            )
        });
        self.was_cut = flow.is_break();
        (ns, pairs.len())
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mode {
    Incremental,
    Rebuild,
    Changes,
}

impl Mode {
    const fn name(self) -> &'static str {
        match self {
            Self::Incremental => "parry3d Bvh, incremental",
            Self::Rebuild => "parry3d Bvh, rebuild",
            Self::Changes => "parry3d Bvh, changes",
        }
    }
}

struct Peer {
    mode: Mode,
    tree: Bvh,
    workspace: BvhWorkspace,
    layers: Vec<u32>,
    /// Frame in which a box last moved.
    moved_in: Vec<u32>,
    frame: u32,
    pairs: Vec<(u32, u32)>,
    samples: Samples,
}

impl Peer {
    fn new(mode: Mode, boxes: &[Aabb]) -> Self {
        let mut peer = Self {
            mode,
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, boxes),
            workspace: BvhWorkspace::default(),
            layers: vec![1; boxes.len()],
            moved_in: vec![0; boxes.len()],
            frame: 0,
            pairs: Vec::new(),
            samples: Samples::default(),
        };
        peer.traverse::<false>();
        peer
    }

    /// One frame; returns the number of pairs.
    fn frame(&mut self, moved: &[(u32, Aabb)]) -> usize {
        self.frame += 1;
        let (ns, ()) = time(|| match self.mode {
            Mode::Incremental => {
                self.move_leaves(moved, 0.0);
                self.tree.optimize_incremental(&mut self.workspace);
                self.tree.refit(&mut self.workspace);
                self.pairs.clear();
                self.traverse::<false>();
            }
            Mode::Rebuild => {
                self.move_leaves(moved, 0.0);
                self.tree.rebuild(&mut self.workspace, BvhBuildStrategy::Binned);
                self.pairs.clear();
                self.traverse::<false>();
            }
            Mode::Changes => self.follow_changes(moved),
        });
        self.samples.push(ns, ns);
        self.pairs.len()
    }

    fn move_leaves(&mut self, moved: &[(u32, Aabb)], margin: f32) {
        for (i, bounds) in moved {
            self.tree.insert_or_update_partially(*bounds, *i, margin);
        }
    }

    /// A margin that is lost in rounding marks leaves as changed without making them larger.
    fn follow_changes(&mut self, moved: &[(u32, Aabb)]) {
        self.move_leaves(moved, f32::MIN_POSITIVE);
        self.tree.optimize_incremental(&mut self.workspace);
        self.tree.refit(&mut self.workspace);
        for (i, _) in moved {
            self.moved_in[*i as usize] = self.frame;
        }
        let (moved_in, frame) = (&self.moved_in, self.frame);
        self.pairs.retain(|&(a, b)| moved_in[a as usize] != frame && moved_in[b as usize] != frame);
        self.traverse::<true>();
    }

    fn traverse<const CHANGES_ONLY: bool>(&mut self) {
        let (layers, pairs) = (&self.layers, &mut self.pairs);
        self.tree.traverse_bvtt_single_tree::<CHANGES_ONLY>(&mut self.workspace, &mut |a, b| {
            if admits(layers, a, b) {
                pairs.push((a.min(b), a.max(b)));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_variants_find_the_same_pairs_in_every_scene() {
        let effort = Effort { rounds: 8, seconds: 10.0, ..Effort::quick() };
        for scene in BoxScene::ALL {
            let row = measure(&(scene, 1500), &effort);
            assert!(!row.note.contains("DIFFER"), "{row:?}");
            assert_eq!(row.done, 8);
        }
    }

    #[test]
    fn a_sweep_that_takes_too_long_is_cut_and_says_so() {
        let effort = Effort { rounds: 1, seconds: 1e-9, ..Effort::quick() };
        let row = measure(&(BoxScene::Pile, 5000), &effort);
        assert!(row.note.contains("extrapolated") && row.order_ns.is_none(), "{row:?}");
    }
}
