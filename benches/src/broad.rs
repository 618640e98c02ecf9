//! Broad phase: all overlapping pairs of a frame.
//!
//! Our time is that of the sorted list, filtered by layers, in the better of our modes; the two stages of the mode that
//! starts from scratch, sweep and sort, are also reported. parry3d's time is that of its unsorted list, by the best of
//! its ways to update a tree (`peer.rs` lists them). In every frame all must find the same number of pairs, and ours
//! must be equal lists.
//!
//! [`rows`] returns the same as data, [`threads`] compares several threads with one, [`queries`] queries a structure of
//! resting boxes, [`growth`] measures the cost of boxes laid out to make a broad phase slow.

pub mod figures;
pub mod growth;
mod memory;
mod ours;
mod peer;
pub mod queries;
pub mod rows;
pub mod threads;

use crate::clock::{Effort, Samples};
use crate::parry;
use crate::row::Row;
use asunder_geometry::Aabb3;
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use figures::{Figures, PeerTime};
use ours::Ours;
use parry3d::bounding_volume::Aabb;
use peer::Peer;

/// One row: a scene, and its number of boxes.
pub type Case = (BoxScene, usize);

/// Sizes of every scene; the last is left out of quick runs, and a million is added on request.
const SIZES: [usize; 3] = [1000, 10_000, 100_000];

/// The cases: every scene at every size, the small sizes first.
///
/// ```
/// use asunder_benches::{broad, clock::Effort};
/// let cases = broad::cases(&Effort::full(), false);
/// assert_eq!(broad::name(&cases[0]), "gas/1k");
/// assert!(cases.len() == 33 && broad::cases(&Effort::full(), true).len() == 44);
/// ```
pub fn cases(effort: &Effort, with_million: bool) -> Vec<Case> {
    let sizes = if effort.is_quick { &SIZES[..2] } else { &SIZES };
    let mut cases = Vec::new();
    for scene in BoxScene::ALL {
        cases.extend(sizes.iter().map(|&count| (scene, count)));
        if with_million {
            cases.push((scene, 1_000_000));
        }
    }
    cases
}

/// The name of a case, as `gas/10k`.
///
/// ```
/// use asunder_benches::broad;
/// use asunder_scenes::boxes::BoxScene;
/// assert_eq!(broad::name(&(BoxScene::Pile, 1_000_000)), "pile/1M");
/// assert_eq!(broad::name(&(BoxScene::Still, 1_000_000)), "world1m");
/// ```
pub fn name(&(scene, count): &Case) -> String {
    if (scene, count) == (BoxScene::Still, 1_000_000) {
        return "world1m".to_string();
    }
    format!("{}/{}", scene.name(), size_name(count))
}

/// A count in a few letters, as `10k`.
fn size_name(count: usize) -> String {
    match count {
        1_000_000.. => format!("{}M", count / 1_000_000),
        1000.. => format!("{}k", count / 1000),
        _ => count.to_string(),
    }
}

/// Measures one case on one thread. Cost: about a second per variant, of which there are up to ten.
///
/// Must run where the library finds no second thread, as in a pool of one: thread time would miss the other.
///
/// ```
/// use asunder_benches::{broad, clock::Effort};
/// use asunder_scenes::boxes::BoxScene;
/// let row = broad::measure(&(BoxScene::City, 500), &Effort { rounds: 3, ..Effort::quick() });
/// assert!(row.ratio.is_some() && row.done == 60, "{row:?}");
/// ```
pub fn measure(case: &Case, effort: &Effort) -> Row {
    let (mut row, ours, peers) = run(case, effort);
    report(&mut row, &ours, &peers);
    row
}

/// The samples of every variant, and a row that only notes where they differ.
fn run(case: &Case, effort: &Effort) -> (Row, Ours, Vec<Peer>) {
    let &(_, count) = case;
    let mut row = Row::new(name(case), "frame", count);
    if let Some(text) = peer::leaves_out(case.0, count) {
        row.remark(text);
    }
    let mut stage = Stage::new(case);
    let mut ours = Ours::new(stage.few_move);
    let mut peers = Peer::all(case.0, &stage.converted, &stage.filter, stage.few_move);
    let limit = nanoseconds(count, effort);
    for number in 0..=frames(count, effort) {
        stage.step();
        let mut found: Option<usize> = None;
        for peer in peers.iter_mut().filter(|peer| peer.samples.spent() < limit) {
            let count = peer.frame(stage.moving.moved(), &stage.converted, &stage.filter);
            if *found.get_or_insert(count) != count {
                object(&mut row, &format!("PAIRS DIFFER: {} has {count} in frame {number}", peer.name()));
            }
        }
        ours.frame(&stage.now(), found, limit, &mut row);
        if number == 0 {
            // Buffers have grown: no later frame allocates.
            ours.forget_samples(limit);
            peers.iter_mut().for_each(|peer| forget(&mut peer.samples, limit));
        }
        if ours.is_done(limit) && peers.iter().all(|peer| peer.samples.spent() >= limit) {
            break;
        }
    }
    (row, ours, peers)
}

/// Frames of a row: small worlds take so little time that more frames are needed for a median.
fn frames(count: usize, effort: &Effort) -> usize {
    effort.rounds * (100_000 / count.max(1)).clamp(1, 20)
}

/// The time for one variant, in nanoseconds: a frame of a million boxes may take a second.
fn nanoseconds(count: usize, effort: &Effort) -> f64 {
    effort.nanoseconds() * if count >= 1_000_000 { 3.0 } else { 1.0 }
}

/// Notes that two variants differ; once per row is enough.
fn object(row: &mut Row, text: &str) {
    if !row.note.contains("DIFFER") {
        row.remark(text);
    }
}

/// Discards warm-up samples, if there is time for more.
fn forget(samples: &mut Samples, limit: f64) {
    if samples.spent() < limit {
        *samples = Samples::default();
    }
}

fn report(row: &mut Row, ours: &Ours, peers: &[Peer]) {
    let mut figures = Figures::default();
    let mut times: Vec<PeerTime> = peers.iter().filter_map(Peer::time).collect();
    times.sort_by(|a, b| a.ns.total_cmp(&b.ns));
    if let Some(best) = times.first() {
        (row.peer, row.peer_ns) = (Some(best.mode), Some(best.ns));
    }
    figures.peers = times;
    ours.report(row, &mut figures);
    row.finish();
    remark_on_older_ways(row, &figures);
    row.broad = Some(figures);
}

/// Goals were set before the peer could remove and reinsert leaves: without those ways the ratio is different.
fn remark_on_older_ways(row: &mut Row, figures: &Figures) {
    let is_new = |mode: &str| mode.contains("reinsert") || mode.contains("split");
    let older = figures.peers.iter().find(|peer| !is_new(peer.mode));
    if let (true, Some(older), Some(ours)) = (row.peer.is_some_and(is_new), older, row.ours_ns) {
        row.remark(&format!("{:.2} against {}", older.ns / ours, older.mode));
    }
}

/// The pairs that a frame wants: each box has layers, and a mask of layers that it collides with.
///
/// Where nothing is fixed, every box is in one layer and collides with it: the filter has its cost, but drops nothing.
#[derive(Clone, Debug)]
struct Filter {
    layers: Vec<[u32; 2]>,
}

impl Filter {
    fn new(moving: &MovingBoxes, scene: BoxScene) -> Self {
        let [all, fixed, mobile] = [[1, 1], [1, 2], [2, 3]];
        let mut layers = vec![if scene == BoxScene::Still { fixed } else { all }; moving.boxes.len()];
        if scene == BoxScene::Still {
            moving.moved().iter().for_each(|&i| layers[i as usize] = mobile);
        }
        Self { layers }
    }

    fn admits(&self, a: u32, b: u32) -> bool {
        self.layers[a as usize][0] & self.layers[b as usize][1] != 0
    }

    fn is_fixed(&self, i: u32) -> bool {
        self.layers[i as usize] == [1, 2]
    }
}

/// A scene in the form of both sides.
struct Stage {
    moving: MovingBoxes,
    converted: Vec<Aabb>,
    filter: Filter,
    /// Whether keeping data from frame to frame may pay.
    few_move: bool,
}

/// The data of one frame for our side.
struct Frame<'a> {
    boxes: &'a [Aabb3],
    moved: &'a [u32],
    filter: &'a Filter,
}

impl Stage {
    fn new(&(scene, count): &Case) -> Self {
        let mut moving = MovingBoxes::new(scene, count, 1);
        let filter = Filter::new(&moving, scene);
        moving.step();
        let converted = moving.boxes.iter().map(parry::bounds).collect();
        let few_move = moving.moved().len() * 2 < count;
        Self { moving, converted, filter, few_move }
    }

    fn step(&mut self) {
        self.moving.step();
        for &i in self.moving.moved() {
            self.converted[i as usize] = parry::bounds(&self.moving.boxes[i as usize]);
        }
    }

    fn now(&self) -> Frame<'_> {
        Frame { boxes: &self.moving.boxes, moved: self.moving.moved(), filter: &self.filter }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_variants_find_the_same_pairs_in_every_scene() {
        let effort = Effort { rounds: 1, seconds: 10.0, ..Effort::quick() };
        for scene in BoxScene::ALL {
            let row = measure(&(scene, 1500), &effort);
            assert!(!row.note.contains("DIFFER"), "{row:?}");
            assert_eq!(row.done, 20);
            let peers = row.broad.map_or(0, |figures| figures.peers.len());
            assert!(peers >= 4, "{scene:?}: {peers} ways of the peer");
        }
    }

    #[test]
    fn a_still_world_has_only_the_pairs_of_what_moves() {
        let stage = Stage::new(&(BoxScene::Still, 2000));
        let mut fixed = 0;
        for (a, one) in stage.moving.boxes.iter().enumerate() {
            for (b, other) in stage.moving.boxes.iter().enumerate().take(a) {
                let (a, b) = (a as u32, b as u32);
                let moves = |i| stage.moving.moved().contains(&i);
                assert_eq!(stage.filter.admits(b, a), moves(a) || moves(b));
                fixed += usize::from(!stage.filter.admits(b, a) && one.overlaps(other));
            }
        }
        assert!(fixed > 500, "{fixed} pairs are dropped");
    }

    #[test]
    fn a_sweep_that_takes_too_long_is_cut_and_says_so() {
        let effort = Effort { rounds: 1, seconds: 1e-9, ..Effort::quick() };
        let row = measure(&(BoxScene::Pile, 5000), &effort);
        let order = row.broad.as_ref().and_then(|figures| figures.order_ns);
        assert!(row.note.contains("extrapolated") && order.is_none(), "{row:?}");
    }
}
