//! parry3d's side of the broad phase: all overlapping pairs by its `Bvh`.
//!
//! - *incremental*: leaves in place, `optimize_incremental`, `refit`, whole traversal, as rapier does when many move.
//! - *rebuild*: leaves in place, then the whole tree rebuilt (binned), and the whole traversal.
//! - *changes*: as incremental, but only pairs of changed leaves are searched; the rest of the last frame's list is
//!   kept.
//! - *reinsert*: moved leaves are removed and reinserted, `refit_partial`; pairs as in changes. As rapier does when few
//!   move.
//! - *split*: fixed boxes in a tree of their own, which every moving box queries.
//!
//! With *4 cm*, leaves are enlarged by rapier's usual margin, and stay as they are while their boxes stay inside. Such
//! a tree returns candidates, whose boxes are tested once more, so that every way has the same pairs.

use super::Filter;
use super::figures::PeerTime;
use crate::clock::{Samples, time};
use asunder_scenes::boxes::BoxScene;
use parry3d::bounding_volume::{Aabb, BoundingVolume};
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhLeafUpdateStatus, BvhWorkspace};

/// `CHANGE_DETECTION_FACTOR` of rapier 0.35 and later, times its length unit of a metre.
const USUAL_MARGIN: f32 = 0.04;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Update {
    Incremental,
    Rebuild,
    Changes,
    Reinsert,
    Split,
}

use Update::{Changes, Incremental, Rebuild, Reinsert, Split};

/// The ways where anything may move, and those added where few do; each with the usual margin or without.
///
/// Tried where all move, on gas, city, pile, islands and tower of 1k and 10k: changes is 3 to 19 % slower than
/// incremental, changes with a margin 15 to 36 %, reinsert two to nine times (AMD EPYC, 2026-11-21).
const ALWAYS: [(Update, bool); 4] =
    [(Incremental, false), (Incremental, true), (Rebuild, false), (Rebuild, true)];
const WHERE_FEW_MOVE: [(Update, bool); 4] =
    [(Changes, false), (Changes, true), (Reinsert, false), (Reinsert, true)];
/// For a tenth of a million boxes that jump to random places. Ways that repair the tree in place do not finish there: a
/// frame of 100,000 boxes takes them 1.5 to 2.2 s, thirty times as long as rebuilding, and one of 10,000 a twentieth of
/// that (AMD EPYC (Zen 4), 2026-11-22).
const WHERE_MANY_JUMP: [(Update, bool); 4] =
    [(Rebuild, false), (Rebuild, true), (Reinsert, false), (Reinsert, true)];
/// Whole traversals of a million boxes are pointless where a hundred move.
const WHERE_MOST_ARE_FIXED: [(Update, bool); 5] =
    [(Changes, false), (Changes, true), (Reinsert, false), (Reinsert, true), (Split, false)];

/// The remark of a row on ways that are left out because they would not finish.
pub(super) fn leaves_out(scene: BoxScene, count: usize) -> Option<&'static str> {
    (scene == BoxScene::Teleport && count >= 1_000_000).then_some(
        "parry3d by rebuilding and by reinserting alone: to mend its tree in place takes minutes a frame",
    )
}

pub(super) struct Peer {
    update: Update,
    has_margin: bool,
    tree: Bvh,
    /// Fixed boxes, if they have a tree of their own.
    fixed: Bvh,
    workspace: BvhWorkspace,
    /// For each leaf, the frame in which it last changed.
    changed_in: Vec<u32>,
    /// Leaves that changed in this frame, and in the previous one.
    changed: [Vec<u32>; 2],
    frame: u32,
    /// Pairs of leaves, if leaves are larger than boxes.
    candidates: Vec<(u32, u32)>,
    pairs: Vec<(u32, u32)>,
    pub(super) samples: Samples,
}

impl Peer {
    /// Every way that might be the best.
    pub(super) fn all(scene: BoxScene, boxes: &[Aabb], filter: &Filter, few_move: bool) -> Vec<Self> {
        let ways: Vec<(Update, bool)> = match (scene, few_move) {
            (BoxScene::Still, _) => WHERE_MOST_ARE_FIXED.to_vec(),
            _ if leaves_out(scene, boxes.len()).is_some() => WHERE_MANY_JUMP.to_vec(),
            (_, true) => [ALWAYS, WHERE_FEW_MOVE].concat(),
            (_, false) => ALWAYS.to_vec(),
        };
        ways.into_iter().map(|way| Self::new(way, boxes, filter)).collect()
    }

    fn new((update, has_margin): (Update, bool), boxes: &[Aabb], filter: &Filter) -> Self {
        let leaves = |fixed: bool| {
            let chosen = (0..boxes.len()).filter(move |&i| filter.is_fixed(i as u32) == fixed);
            chosen.map(|i| (i, boxes[i]))
        };
        let (tree, fixed) = if update == Split {
            (
                Bvh::from_iter(BvhBuildStrategy::Binned, leaves(false)),
                Bvh::from_iter(BvhBuildStrategy::Binned, leaves(true)),
            )
        } else {
            (Bvh::from_leaves(BvhBuildStrategy::Binned, boxes), Bvh::new())
        };
        let mut peer = Self {
            update,
            has_margin,
            tree,
            fixed,
            workspace: BvhWorkspace::default(),
            changed_in: vec![0; boxes.len()],
            changed: [Vec::new(), Vec::new()],
            frame: 0,
            candidates: Vec::new(),
            pairs: Vec::new(),
            samples: Samples::default(),
        };
        peer.traverse::<false>(filter);
        // New leaves count as changed until the next refit.
        peer.tree.refit(&mut peer.workspace);
        if has_margin {
            peer.candidates.clone_from(&peer.pairs);
        }
        peer
    }

    pub(super) const fn name(&self) -> &'static str {
        match (self.update, self.has_margin) {
            (Incremental, false) => "parry3d incremental",
            (Incremental, true) => "parry3d incremental, 4 cm",
            (Rebuild, false) => "parry3d rebuild",
            (Rebuild, true) => "parry3d rebuild, 4 cm",
            (Changes, false) => "parry3d changes",
            (Changes, true) => "parry3d changes, 4 cm",
            (Reinsert, false) => "parry3d reinsert",
            (Reinsert, true) => "parry3d reinsert, 4 cm",
            (Split, _) => "parry3d split",
        }
    }

    pub(super) fn time(&self) -> Option<PeerTime> {
        self.samples.median().map(|ns| PeerTime { mode: self.name(), ns })
    }

    /// One frame; returns the number of pairs.
    pub(super) fn frame(&mut self, moved: &[u32], boxes: &[Aabb], filter: &Filter) -> usize {
        self.frame += 1;
        let (ns, ()) = time(|| match self.update {
            Incremental => {
                self.move_leaves(moved, boxes, 0.0);
                self.tree.optimize_incremental(&mut self.workspace);
                self.tree.refit(&mut self.workspace);
                self.find_all(boxes, filter);
            }
            Rebuild => {
                self.move_leaves(moved, boxes, 0.0);
                self.tree.rebuild(&mut self.workspace, BvhBuildStrategy::Binned);
                self.find_all(boxes, filter);
            }
            Changes => {
                // A margin that is lost in rounding: it marks leaves as changed without enlarging them.
                self.move_leaves(moved, boxes, f32::MIN_POSITIVE);
                self.tree.optimize_incremental(&mut self.workspace);
                self.tree.refit(&mut self.workspace);
                self.follow_changes(boxes, filter);
            }
            Reinsert => {
                self.reinsert_leaves(moved, boxes);
                let [now, before] = &self.changed;
                self.tree.refit_partial(before, now);
                self.follow_changes(boxes, filter);
            }
            Split => self.ask_fixed(moved, boxes, filter),
        });
        self.samples.push(ns, ns);
        self.pairs.len()
    }

    /// Moves leaves in place: with the usual margin if this way has one, else with the given one.
    fn move_leaves(&mut self, moved: &[u32], boxes: &[Aabb], least: f32) {
        let margin = if self.has_margin { USUAL_MARGIN } else { least };
        for &i in moved {
            let status = self.tree.insert_or_update_partially(boxes[i as usize], i, margin);
            if status != BvhLeafUpdateStatus::Unchanged {
                self.changed_in[i as usize] = self.frame;
            }
        }
    }

    fn reinsert_leaves(&mut self, moved: &[u32], boxes: &[Aabb]) {
        let margin = if self.has_margin { USUAL_MARGIN } else { 0.0 };
        self.changed.swap(0, 1);
        self.changed[0].clear();
        for &i in moved {
            let status = self.tree.reinsert_or_update_with_change_detection(boxes[i as usize], i, margin);
            if status != BvhLeafUpdateStatus::Unchanged {
                self.changed_in[i as usize] = self.frame;
                self.changed[0].push(i);
            }
        }
    }

    fn find_all(&mut self, boxes: &[Aabb], filter: &Filter) {
        self.pairs.clear();
        if !self.has_margin {
            return self.traverse::<false>(filter);
        }
        let pairs = &mut self.pairs;
        self.tree.traverse_bvtt_single_tree::<false>(&mut self.workspace, &mut |a, b| {
            if filter.admits(a, b) && boxes[a as usize].intersects(&boxes[b as usize]) {
                pairs.push((a.min(b), a.max(b)));
            }
        });
    }

    /// Keeps the pairs of unchanged leaves, and finds those of changed leaves.
    fn follow_changes(&mut self, boxes: &[Aabb], filter: &Filter) {
        if self.has_margin {
            core::mem::swap(&mut self.pairs, &mut self.candidates);
        }
        let (changed_in, frame) = (&self.changed_in, self.frame);
        self.pairs.retain(|&(a, b)| changed_in[a as usize] != frame && changed_in[b as usize] != frame);
        self.traverse::<true>(filter);
        if self.has_margin {
            core::mem::swap(&mut self.pairs, &mut self.candidates);
            self.pairs.clear();
            let touching = |&&(a, b): &&(u32, u32)| boxes[a as usize].intersects(&boxes[b as usize]);
            self.pairs.extend(self.candidates.iter().filter(touching));
        }
    }

    fn ask_fixed(&mut self, moved: &[u32], boxes: &[Aabb], filter: &Filter) {
        self.move_leaves(moved, boxes, 0.0);
        self.tree.refit(&mut self.workspace);
        self.pairs.clear();
        self.traverse::<false>(filter);
        for &i in moved {
            let found = self.fixed.intersect_aabb(&boxes[i as usize]).filter(|&j| filter.admits(i, j));
            self.pairs.extend(found.map(|j| (i.min(j), i.max(j))));
        }
    }

    fn traverse<const CHANGES_ONLY: bool>(&mut self, filter: &Filter) {
        let pairs = &mut self.pairs;
        self.tree.traverse_bvtt_single_tree::<CHANGES_ONLY>(&mut self.workspace, &mut |a, b| {
            if filter.admits(a, b) {
                pairs.push((a.min(b), a.max(b)));
            }
        });
    }
}
