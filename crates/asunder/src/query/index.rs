//! The boxes that queries look up first, kept while few bodies move.
//!
//! ```text
//! rest     a tree of all boxes, as they were when it was made
//! moved    a tree of those that changed since
//! recent   a list of those that changed since that one was made, each computed by the first query after the change
//! ```
//! A body counts in the last of the three that contains it. Trees are built by the first query that needs them, behind
//! `&World`, and not at all in a world that is never queried. When the list has grown too long, the second tree is
//! dropped, and the next one takes in the list; when too many boxes have changed, both trees are dropped.
//!
//! 1. Two trees instead of one and a list: where a twentieth of all bodies moves every frame, every query would have to
//!    scan a list of them, or a tree of all would have to be rebuilt every frame.
//! 2. A list besides the two trees: a game that moves one body, queries, and moves the next would otherwise rebuild the
//!    second tree for every query.
//! 3. The list keeps boxes, so that the queries between two changes compute each only once.
//!
//! No answer depends on which of them a body is in: see [`walk`](super::walk).

use crate::space::Space;
use crate::world::World;
use asunder_broad::Index;
use asunder_geometry::Bounds;
use core::fmt;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Where a body's box is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Level {
    #[default]
    Rest,
    Moved,
    /// In the list, at this index.
    Recent(u32),
}

/// A box in the list.
struct Recent<B> {
    slot: u32,
    /// Computed by the first query since the body changed.
    bounds: OnceLock<B>,
}

/// The trees and the list of bodies' boxes; they influence no answer.
pub(crate) struct Boxes<S: Space> {
    rest: Tree<S::Aabb>,
    moved: Tree<S::Aabb>,
    /// Which of the three each slot is in; slots beyond the end are at rest.
    levels: Vec<Level>,
    /// Slots that are not at rest, in the order in which they changed: the second tree's numbers index this list.
    changed: Vec<u32>,
    recent: Vec<Recent<S::Aabb>>,
}

impl<S: Space> Boxes<S> {
    /// Notes that a body's box has changed, or will: the body was moved, inserted or removed. Cost: constant.
    #[inline]
    pub(crate) fn told(&mut self, slot: u32) {
        if self.rest.made.get().is_some() {
            self.take_note(slot);
        }
    }

    fn take_note(&mut self, slot: u32) {
        let index = slot as usize;
        if index >= self.levels.len() {
            self.levels.resize(index + 1, Level::Rest);
        }
        match self.levels[index] {
            Level::Recent(at) => {
                self.recent[at as usize].bounds.take();
                return;
            }
            Level::Moved => {}
            Level::Rest => self.changed.push(slot),
        }
        if self.moved.made.get().is_some() {
            self.levels[index] = Level::Recent(self.recent.len() as u32);
            self.recent.push(Recent { slot, bounds: OnceLock::new() });
        } else {
            self.levels[index] = Level::Moved;
        }
        let at_rest = self.rest.made.get().map_or(0, |made| made.index.len());
        if self.changed.len() > most_changed(at_rest) {
            self.forget();
        } else if self.recent.len() > most_recent(self.changed.len()) {
            self.moved.forget();
            self.recent.drain(..).for_each(|recent| self.levels[recent.slot as usize] = Level::Moved);
        }
    }

    fn forget(&mut self) {
        self.rest.forget();
        self.moved.forget();
        self.changed.drain(..).for_each(|slot| self.levels[slot as usize] = Level::Rest);
        self.recent.clear();
    }
}

/// Most boxes in the second tree before both are rebuilt. A box costs as much in the first as in the second.
const fn most_changed(at_rest: usize) -> usize {
    64 + at_rest / 4
}

/// Most boxes in the list before the second tree is rebuilt. Whether there is one query per move or many, a square root
/// keeps the costs of both small. The numbers are the best for a thousand and for five thousand characters, each of
/// which is moved before the next one queries (2026-11-30; three times as many: up to 30 % slower).
const fn most_recent(changed: usize) -> usize {
    8 + (changed / 2).isqrt()
}

/// A tree that is built when it is needed, and the memory of the last one.
struct Tree<B: Bounds> {
    made: OnceLock<Made<B>>,
    last: Mutex<Option<Made<B>>>,
}

struct Made<B> {
    index: Index<B>,
    boxes: Vec<B>,
}

impl<B: Bounds> Tree<B> {
    /// The tree, built now if it is missing. Threads that query meanwhile wait for it.
    fn get(&self, make: impl FnOnce(&mut Made<B>)) -> &Index<B> {
        let made = self.made.get_or_init(|| {
            // Even in a poisoned lock it is only memory for reuse, whatever its contents.
            let last = self.last.lock().unwrap_or_else(PoisonError::into_inner).take();
            let mut made = last.unwrap_or_else(|| Made { index: Index::new(), boxes: Vec::new() });
            make(&mut made);
            made
        });
        &made.index
    }

    fn forget(&mut self) {
        if let Some(made) = self.made.take() {
            *self.last.get_mut().unwrap_or_else(PoisonError::into_inner) = Some(made);
        }
    }
}

/// All bodies' boxes as they are now.
pub(super) struct Sight<'w, S: Space> {
    world: &'w World<S>,
    rest: &'w Index<S::Aabb>,
    moved: &'w Index<S::Aabb>,
}

impl<S: Space> World<S> {
    /// Builds the trees that are missing.
    pub(super) fn sight(&self) -> Sight<'_, S> {
        let boxes = &self.questions;
        let rest = boxes.rest.get(|Made { index, boxes }| {
            if self.dirty.is_empty() {
                return index.build(&self.boxes);
            }
            boxes.clear();
            boxes.extend((0..self.keys.len() as u32).map(|slot| self.box_now(slot)));
            index.build(boxes);
        });
        let moved = boxes.moved.get(|made| {
            made.boxes.clear();
            made.boxes.extend(boxes.changed.iter().map(|&slot| self.box_now(slot)));
            made.index.build(&made.boxes);
        });
        Sight { world: self, rest, moved }
    }

    /// A box around the body in a slot: that of the last update, which may be larger than necessary, if the body has
    /// not changed since.
    fn box_now(&self, slot: u32) -> S::Aabb {
        let index = slot as usize;
        if !self.is_dirty[index] {
            return self.boxes[index];
        }
        let body = self.bodies.get(self.keys[index]);
        body.map_or(S::Aabb::NOTHING, |body| S::bounds(&body.shape, &body.pose, 0.0))
    }
}

impl<'w, S: Space> Sight<'w, S> {
    /// The slots whose current boxes are in no tree, and these boxes.
    pub(super) fn recent(&self) -> impl Iterator<Item = (u32, &'w S::Aabb)> {
        let world = self.world;
        let listed = world.questions.recent.iter();
        listed.map(|recent| (recent.slot, recent.bounds.get_or_init(|| world.box_now(recent.slot))))
    }

    /// Both trees.
    pub(super) fn trees(&self) -> [Branch<'w, S>; 2] {
        let boxes = &self.world.questions;
        [
            Branch { tree: self.rest, boxes, level: Level::Rest },
            Branch { tree: self.moved, boxes, level: Level::Moved },
        ]
    }
}

/// One of the two trees.
pub(super) struct Branch<'w, S: Space> {
    pub(super) tree: &'w Index<S::Aabb>,
    boxes: &'w Boxes<S>,
    level: Level,
}

impl<S: Space> Branch<'_, S> {
    /// The slot that a number in the tree stands for, if the body still counts in this tree.
    #[inline]
    pub(super) fn slot(&self, number: u32) -> Option<u32> {
        let Boxes { levels, changed, .. } = self.boxes;
        let slot = if self.level == Level::Rest { number } else { *changed.get(number as usize)? };
        let now = levels.get(slot as usize).copied().unwrap_or_default();
        (now == self.level).then_some(slot)
    }
}

impl<S: Space> Default for Boxes<S> {
    fn default() -> Self {
        Self {
            rest: Tree { made: OnceLock::new(), last: Mutex::new(None) },
            moved: Tree { made: OnceLock::new(), last: Mutex::new(None) },
            levels: Vec::new(),
            changed: Vec::new(),
            recent: Vec::new(),
        }
    }
}

impl<S: Space> Clone for Boxes<S> {
    /// A world's clone builds its own trees when it is queried.
    fn clone(&self) -> Self {
        Self::default()
    }

    /// Keeps only the memory: the trees are of other bodies.
    fn clone_from(&mut self, _: &Self) {
        self.forget();
    }
}

impl<S: Space> fmt::Debug for Boxes<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Boxes").finish_non_exhaustive()
    }
}
