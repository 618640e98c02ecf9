//! Tests of merged lists, of filters that are asked about many pairs at a time, and of sweeps cloned over others.

use super::{AT_ONCE, CoherentSweep, merge};
use crate::{Index, LooseSweep, Moved, PairId, PlainSweep, Sweep, TooManyPairs};
use asunder_geometry::glam::Vec3;
use asunder_geometry::{Aabb3, Bounds};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use std::sync::Mutex;

#[test]
fn a_merge_is_the_sorted_union() {
    let pairs = |step: u32, count: u32| -> Vec<PairId> {
        (0..count).map(|i| PairId { a: i * step / 7, b: 100 + i * step }).collect()
    };
    for (kept, fresh) in [(0, 0), (0, 5), (5, 0), (1, 1), (400, 3), (3, 400), (400, 400)] {
        let (kept, fresh) = (pairs(3, kept), pairs(5, fresh));
        let mut merged = vec![PairId { a: 9, b: 10 }];
        merge(&kept, &fresh, &mut merged);
        let mut sorted = [kept, fresh].concat();
        sorted.sort_unstable();
        assert_eq!(merged, sorted);
    }
}

const RESTING: u32 = 1000;
const MOVERS: u32 = 100;

/// Boxes in a row, of which a box in the middle overlaps forty.
fn row() -> Vec<Aabb3> {
    let unit = |x: f32| Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0));
    let resting = (0..RESTING).map(|i| unit(i as f32 * 0.05));
    resting.chain((0..MOVERS).map(|i| unit(1000.0 + 2.0 * i as f32))).collect()
}

/// A sweep that has kept the boxes at rest, and the boxes after all movers have moved among them.
fn crowd() -> (CoherentSweep<Aabb3>, Vec<Aabb3>, Vec<u32>) {
    let (mut boxes, mut sweep, mut pairs) = (row(), CoherentSweep::new(), Vec::new());
    for _ in 0..3 {
        sweep.update(&boxes, &[], |_, _| true, usize::MAX, &mut pairs).unwrap();
    }
    let moved: Vec<u32> = (RESTING..RESTING + MOVERS).collect();
    for &mover in &moved {
        boxes[mover as usize] = boxes[(mover - RESTING) as usize * 7];
    }
    (sweep, boxes, moved)
}

fn admit(a: u32, b: u32) -> bool {
    !(a ^ b).is_multiple_of(2)
}

fn all_of(boxes: &[Aabb3], admit: impl Fn(u32, u32) -> bool + Sync) -> Vec<PairId> {
    let mut pairs = Vec::new();
    PlainSweep::new().pairs(boxes, admit, usize::MAX, &mut pairs).unwrap();
    pairs
}

#[test]
fn of_many_pairs_each_is_asked_about_once() {
    let (mut sweep, boxes, moved) = crowd();
    let (asked, mut pairs) = (Mutex::new(Vec::new()), Vec::new());
    let admit = |a: u32, b: u32| {
        asked.lock().unwrap().push(PairId { a, b });
        admit(a, b)
    };
    sweep.update(&boxes, &moved, admit, usize::MAX, &mut pairs).unwrap();
    let mut asked = asked.into_inner().unwrap();
    asked.sort_unstable();
    let of_movers: Vec<PairId> =
        all_of(&boxes, |_, _| true).into_iter().filter(|pair| pair.b >= RESTING).collect();
    assert!(of_movers.len() > 3 * AT_ONCE, "{} pairs of movers", of_movers.len());
    assert_eq!(asked, of_movers);
    // Pairs at rest were kept with another filter.
    let at_rest = all_of(&boxes[..RESTING as usize], |_, _| true);
    let admitted = of_movers.into_iter().filter(|pair| self::admit(pair.a, pair.b));
    let mut expected: Vec<PairId> = at_rest.into_iter().chain(admitted).collect();
    expected.sort_unstable();
    assert_eq!(pairs, expected);
}

#[test]
fn limits_hold_wherever_they_are_passed() {
    let expected = {
        let (mut sweep, boxes, moved) = crowd();
        let mut pairs = Vec::new();
        sweep.update(&boxes, &moved, |_, _| true, usize::MAX, &mut pairs).unwrap();
        assert_eq!(pairs, all_of(&boxes, |_, _| true));
        pairs
    };
    let kept = expected.iter().filter(|pair| pair.b < RESTING).count();
    // The limit is exceeded within the kept pairs, the first batch of others, a later batch, and the last.
    for limit in [kept - 1, kept, kept + AT_ONCE - 1, kept + 2 * AT_ONCE, expected.len() - 1, expected.len()]
    {
        let (mut sweep, boxes, moved) = crowd();
        let mut pairs = vec![PairId { a: 0, b: 1 }];
        let outcome = sweep.update(&boxes, &moved, |_, _| true, limit, &mut pairs);
        if limit == expected.len() {
            assert!(outcome == Ok(()) && pairs == expected);
        } else {
            assert_eq!((outcome, pairs.len()), (Err(TooManyPairs { limit }), 0));
            sweep.update(&boxes, &[], |_, _| true, usize::MAX, &mut pairs).unwrap();
            assert!(pairs == expected, "after {limit}: {} pairs", pairs.len());
        }
    }
}

/// Movers that go among boxes at rest, all to one place, far from everything the columns were laid out for, or some of
/// each.
#[test]
fn movers_meet_each_other_where_they_look_or_are_swept() {
    let many = MOVERS as f32;
    let ways: [(&dyn Fn(f32) -> Vec3, bool); 4] = [
        (&|i| Vec3::X * 0.4 * i, false),
        (&|i| Vec3::X * 1e-3 * i, true),
        (&|i| Vec3::splat(1e6 + 3.0 * i), true),
        (&|i| if i < 0.9 * many { Vec3::X * 0.4 * i } else { Vec3::splat(1e6 + 0.25 * i) }, false),
    ];
    for (way, are_swept) in ways {
        let (mut sweep, mut boxes, moved) = crowd();
        for (i, &mover) in moved.iter().enumerate() {
            let low = way(i as f32);
            boxes[mover as usize] = Aabb3::new(low, low + Vec3::ONE);
        }
        let mut pairs = Vec::new();
        sweep.update(&boxes, &moved, |_, _| true, usize::MAX, &mut pairs).unwrap();
        let expected = all_of(&boxes, |_, _| true);
        assert!(pairs == expected, "{} pairs of {}", pairs.len(), expected.len());
        assert!(sweep.is_kept && sweep.movers == moved);
        assert_eq!(!sweep.moving.is_empty(), are_swept);
        let are_all_at_rest = expected.iter().all(|pair| pair.a < RESTING);
        assert!(!are_all_at_rest || way(1.0).x > 1e5, "movers meet");
    }
}

/// Sweeps of every kind, with a history.
struct Past {
    moving: MovingBoxes,
    swept: Sweep,
    coherent: CoherentSweep<Aabb3>,
    loose: LooseSweep<Aabb3>,
    index: Index<Aabb3>,
}

impl Past {
    fn new(scene: BoxScene, count: usize, frames: usize) -> Self {
        let mut past = Self {
            moving: MovingBoxes::new(scene, count, 7),
            swept: Sweep::new(),
            coherent: CoherentSweep::new(),
            loose: LooseSweep::new(),
            index: Index::new(),
        };
        past.go_on(frames);
        past
    }

    /// Checks that all four give the pairs of the plain sweep, frame by frame.
    fn go_on(&mut self, frames: usize) {
        for frame in 0..frames {
            self.moving.step();
            let Self { moving, swept, coherent, loose, index } = self;
            let (boxes, moved) = (&moving.boxes, moving.moved());
            let (expected, mut pairs) = (all_of(boxes, admit), Vec::new());
            swept.pairs(boxes, admit, usize::MAX, &mut pairs).unwrap();
            assert!(pairs == expected, "frame {frame}");
            coherent.update(boxes, moved, admit, usize::MAX, &mut pairs).unwrap();
            assert!(pairs == expected, "frame {frame}, coherent");
            let places = Moved { places: moved, has_changed: |_| false };
            loose.update(boxes, places, admit, usize::MAX, &mut pairs).unwrap();
            assert!(pairs == expected, "frame {frame}, loose");
            index.build(boxes);
        }
    }

    /// These sweeps, cloned into the memory of others.
    fn written_over(&self, mut other: Self) -> Self {
        other.moving = self.moving.clone();
        other.swept.clone_from(&self.swept);
        other.coherent.clone_from(&self.coherent);
        other.loose.clone_from(&self.loose);
        other.index.clone_from(&self.index);
        other
    }
}

#[test]
fn sweeps_that_are_written_over_others_go_on_alike() {
    // Scenes that move all boxes, a few, or none, with various numbers of boxes.
    let scenes = [BoxScene::Pile, BoxScene::Static5, BoxScene::Static1, BoxScene::Still, BoxScene::Gas];
    for scene in scenes {
        for (other, count) in [(BoxScene::Static5, 900), (BoxScene::Gas, 300), (BoxScene::Still, 600)] {
            for frames in [1, 5, 12] {
                let one = Past::new(scene, 600, frames);
                let mut copy = one.written_over(Past::new(other, count, 6));
                let (column, columns) = (one.swept.columns(), copy.swept.columns());
                assert!(column.eq(columns), "columns for debug views");
                let (mut here, mut there) = (Vec::new(), Vec::new());
                for bounds in one.moving.boxes.iter().step_by(50) {
                    one.index.overlapping(&bounds.widened(0.5), &mut here);
                    copy.index.overlapping(&bounds.widened(0.5), &mut there);
                    assert_eq!(here, there);
                }
                copy.go_on(8);
            }
        }
    }
}

/// Boxes that tremble stay in their loose boxes for many frames, so their pairs are kept.
#[test]
fn loose_boxes_that_are_written_over_others_go_on_alike() {
    let homes = |count: usize| MovingBoxes::new(BoxScene::Pile, count, 3).boxes;
    let trembling = |homes: &[Aabb3], frame: usize| -> Vec<Aabb3> {
        let by = |i: usize| Vec3::splat(1e-3 * ((i * 7 + frame * 5) % 3) as f32);
        homes.iter().enumerate().map(|(i, home)| Aabb3::new(home.min + by(i), home.max + by(i))).collect()
    };
    let play = |sweep: &mut LooseSweep<Aabb3>, homes: &[Aabb3], frames: core::ops::Range<usize>| {
        let places: Vec<u32> = (0..homes.len() as u32).collect();
        let mut pairs = Vec::new();
        for frame in frames {
            let boxes = trembling(homes, frame);
            let moved = Moved { places: &places, has_changed: |_| false };
            sweep.update(&boxes, moved, admit, usize::MAX, &mut pairs).unwrap();
            assert!(pairs == all_of(&boxes, admit), "frame {frame}");
        }
    };
    for frames in 1..20 {
        let (homes, others) = (homes(500), homes(800));
        let (mut one, mut other) = (LooseSweep::new(), LooseSweep::new());
        play(&mut one, &homes, 0..frames);
        play(&mut other, &others, 0..12);
        other.clone_from(&one);
        play(&mut other, &homes, frames..frames + 6);
    }
}

/// Columns that several threads sorted are in parts.
#[cfg(feature = "parallel")]
#[test]
fn what_a_team_swept_is_written_over_others() {
    rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap().install(|| {
        let one = Past::new(BoxScene::Gas, 6000, 2);
        for (scene, count) in [(BoxScene::Static5, 300), (BoxScene::Gas, 7000)] {
            let mut copy = one.written_over(Past::new(scene, count, 2));
            assert!(one.swept.columns().eq(copy.swept.columns()) && one.swept.columns().count() > 1);
            copy.go_on(2);
        }
    });
}
