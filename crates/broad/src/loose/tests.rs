//! Tests of what loose boxes cost, and that results do not depend on them.

use super::{LooseSweep, Moved, PACE, State};
use crate::sweep::trial::{Way, steps_of};
use crate::{PairId, Sweep, TooManyPairs};
use asunder_geometry::glam::Vec3;
use asunder_geometry::{Aabb2, Aabb3, Bounds};
use asunder_scenes::boxes::{BoxScene, MovingBoxes};
use asunder_scenes::random::Random;

/// The box, moved by a random vector of at most this length.
fn beside(of: &Aabb3, metres: f64, random: &mut Random) -> Aabb3 {
    let by = (random.direction() * metres * random.unit()).as_vec3();
    Aabb3::new(of.min + by, of.max + by)
}

fn flat(of: &Aabb3) -> Aabb2 {
    Aabb2::new(of.min.truncate(), of.max.truncate())
}

/// A loose sweep, and one without history for comparison.
struct Twins<B> {
    loose: LooseSweep<B>,
    pairs: Vec<PairId>,
    fresh: Vec<PairId>,
}

impl<B: Bounds> Twins<B> {
    fn new() -> Self {
        Self { loose: LooseSweep::new(), pairs: Vec::new(), fresh: Vec::new() }
    }

    /// Updates with a limit of `fewer` pairs less than there are, and compares.
    fn check(&mut self, boxes: &[B], moved: &[u32], changed: &[u32], (groups, fewer): (&[u32], usize)) {
        let admit = |a: u32, b: u32| groups[a as usize] != groups[b as usize];
        Sweep::new().pairs(boxes, admit, usize::MAX, &mut self.fresh).unwrap();
        let limit = self.fresh.len().saturating_sub(fewer);
        let moved = Moved { places: moved, has_changed: |place| changed.contains(&place) };
        let outcome = self.loose.update(boxes, moved, admit, limit, &mut self.pairs);
        if limit < self.fresh.len() {
            assert_eq!((outcome, self.pairs.len()), (Err(TooManyPairs { limit }), 0));
        } else {
            assert_eq!(outcome, Ok(()));
            assert!(self.pairs == self.fresh, "{} pairs, not {}", self.pairs.len(), self.fresh.len());
        }
    }
}

/// Boxes tremble in place, fly, rest, are added and removed, change their identity, and are invalid for a while.
#[test]
fn a_loose_sweep_has_the_pairs_of_a_fresh_one_whatever_came_before() {
    let mut random = Random::new(811);
    let (mut in_space, mut in_plane) = (0, 0);
    let (mut met_all, mut looked_up, mut lists) = (0, 0, 0);
    for round in 0..12 {
        let homes: Vec<Aabb3> = MovingBoxes::new(BoxScene::Pile, 400, 7 + round).boxes;
        let mut boxes = homes.clone();
        let mut groups: Vec<u32> = (0..boxes.len() as u32).collect();
        let (mut space, mut plane) = (Twins::new(), Twins::new());
        for frame in 0..150_u32 {
            // Trembling for a long time, then a mix of trembling, flying, resting and changing.
            let wild = if frame % 50 < 30 { 0.0 } else { [0.0, 0.002, 0.01, 0.4][random.below(4)] };
            let share = if frame % 50 < 45 { 1.0 } else { [0.0, 0.1, 0.3][random.below(3)] };
            let (mut moved, mut changed) = (Vec::new(), Vec::new());
            for place in 0..homes.len().min(boxes.len()) {
                if random.unit() >= share {
                    continue;
                }
                moved.push(place as u32);
                boxes[place] = if random.unit() >= wild {
                    beside(&homes[place], 0.003, &mut random)
                } else {
                    match random.below(5) {
                        0 => Aabb3::NOTHING,
                        // Inverted, and in the middle of where it was.
                        1 => {
                            let middle = 0.5 * (homes[place].min + homes[place].max);
                            Aabb3::new(middle + 1e-3, middle - 1e-3)
                        }
                        2 => {
                            groups[place] = random.below(3) as u32;
                            changed.push(place as u32);
                            beside(&homes[place], 0.003, &mut random)
                        }
                        _ => beside(&homes[place], 2.0, &mut random),
                    }
                };
            }
            if frame % 50 == 20 {
                boxes.push(beside(&homes[random.below(homes.len())], 0.5, &mut random));
                groups.push(u32::MAX);
            }
            if frame == 90 && round % 3 == 0 {
                boxes.truncate(380);
                groups.truncate(380);
            }
            moved.extend([boxes.len() as u32 - 1, boxes.len() as u32, u32::MAX]);
            let fewer = usize::from(random.below(10) == 0);
            let near = space.loose.near.len();
            space.check(&boxes, &moved, &changed, (&groups, fewer));
            plane.check(&boxes.iter().map(flat).collect::<Vec<_>>(), &moved, &changed, (&groups, fewer));
            let is_loose = |state| matches!(state, State::Loose { frames } if frames > 0);
            in_space += u32::from(is_loose(space.loose.state));
            in_plane += u32::from(is_loose(plane.loose.state));
            if is_loose(space.loose.state) {
                met_all += u32::from(space.loose.strays.is_empty());
                looked_up += u32::from(!space.loose.strays.is_empty());
                lists += u32::from(space.fresh.len() < near);
            }
        }
    }
    // Every path was taken, often.
    assert!(in_space > 500 && in_plane > 300, "{in_space} and {in_plane} frames with loose boxes");
    assert!(met_all > 200 && looked_up > 100, "{met_all} frames without strays, {looked_up} with some");
    assert!(lists > 200, "{lists} frames in which a pair of loose boxes was none of boxes");
}

/// The steps of each frame, for the loose and the plain sweep, and the state; `go` moves the boxes each frame.
fn steps(frames: u32, boxes: &mut [Aabb3], mut go: impl FnMut(&mut [Aabb3])) -> Vec<([usize; 2], State)> {
    let (mut loose, mut plain, mut pairs) = (LooseSweep::new(), Sweep::new(), Vec::new());
    let places: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut counted = Vec::new();
    for _ in 0..frames {
        go(boxes);
        let moved = Moved { places: &places, has_changed: |_| false };
        let all = |_, _| true;
        let counts = [
            steps_of(Way::ByCounts, || loose.update(boxes, moved, all, usize::MAX, &mut pairs).unwrap()),
            steps_of(Way::ByCounts, || plain.pairs(boxes, all, usize::MAX, &mut pairs).unwrap()),
        ];
        counted.push((counts, loose.state));
    }
    counted
}

fn sum(counted: &[([usize; 2], State)]) -> [usize; 2] {
    counted.iter().fold([0, 0], |sum, ([loose, plain], _)| [sum[0] + loose, sum[1] + plain])
}

#[test]
fn boxes_that_tremble_are_hardly_ever_swept() {
    let mut random = Random::new(812);
    let homes = MovingBoxes::new(BoxScene::Pile, 3000, 1).boxes;
    let mut boxes = homes.clone();
    let counted = steps(200, &mut boxes, |boxes| {
        for (one, home) in boxes.iter_mut().zip(&homes) {
            *one = beside(home, 0.002, &mut random);
        }
    });
    let [loose, plain] = sum(&counted[20..]);
    assert!(plain > 180 * 3000 && loose * 50 < plain, "{loose} steps, {plain} of sweeps");
}

/// Symptom: one frame in which no box moved ended loose boxes, and counted as their failure, so that a game which moves
/// its bodies in every second frame swept all boxes again and again.
#[test]
fn frames_in_which_none_moves_do_not_end_loose_boxes_until_they_are_many() {
    let mut random = Random::new(813);
    let homes = MovingBoxes::new(BoxScene::Pile, 1000, 1).boxes;
    let (mut boxes, places) = (homes.clone(), (0..1000).collect::<Vec<u32>>());
    let mut twins = Twins::new();
    let mut frame = |twins: &mut Twins<Aabb3>, does_move: bool| {
        let moved = if does_move { places.as_slice() } else { &[] };
        for &place in moved {
            boxes[place as usize] = beside(&homes[place as usize], 0.002, &mut random);
        }
        twins.check(&boxes, moved, &[], (&places, 0));
        matches!(twins.loose.state, State::Loose { .. })
    };
    let loose = (0..200).filter(|at| frame(&mut twins, at % 2 == 0)).count();
    assert!(loose > 150, "loose in {loose} of 200 frames");
    (0..10).for_each(|_| _ = frame(&mut twins, true));
    let rested = (0..40).filter(|_| frame(&mut twins, false)).count();
    assert!(rested < 10, "loose in {rested} frames of rest");
    let again = (0..10).position(|_| frame(&mut twins, true));
    assert!(again.is_some_and(|at| at < 6), "loose again after {again:?} frames");
}

#[test]
fn boxes_that_fly_cost_little_more_than_sweeping_them() {
    let mut moving = MovingBoxes::new(BoxScene::Gas, 3000, 1);
    let mut boxes = moving.boxes.clone();
    let counted = steps(400, &mut boxes, |boxes| {
        moving.step();
        boxes.copy_from_slice(&moving.boxes);
    });
    let [loose, plain] = sum(&counted);
    assert!(loose * 10 < plain * 11, "{loose} steps, {plain} of sweeps");
    let is_slow = |([loose, plain], _): &([usize; 2], State)| *loose >= 3 * plain;
    assert!(!counted.iter().any(is_slow), "a frame that takes three times as many");
    let tried = counted.iter().filter(|(_, state)| matches!(state, State::Loose { .. })).count();
    assert!((5..40).contains(&tried), "loose in {tried} of 400 frames");
}

/// With one giant, and a plate without height: the margin of a loose box depends only on its own box.
#[test]
fn loose_boxes_are_as_wide_as_their_own_box_allows() {
    let at = |x: f32| {
        let small =
            (0..100_u8).map(|i| Aabb3::new(Vec3::splat(f32::from(i)), Vec3::splat(f32::from(i) + 0.9)));
        let odd = [
            Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1e6, 1e6, 1e6)),
            Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 5.0, 0.0, 5.0)),
            Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 8.0, 8.0, 8.0)),
            Aabb3::new(Vec3::splat(f32::NEG_INFINITY), Vec3::new(f32::INFINITY, x, f32::INFINITY)),
        ];
        odd.into_iter().chain(small).collect::<Vec<_>>()
    };
    let places: Vec<u32> = (0..104).collect();
    let mut twins = Twins::new();
    for frame in 0..20_u8 {
        let x = if frame % 2 == 0 { 0.0 } else { 0.01 };
        twins.check(&at(x), &places, &[], (&places, 0));
    }
    assert!(matches!(twins.loose.state, State::Loose { frames } if frames > 5));
    let widths = &twins.loose.widths;
    let paces = |metres: f32| 0.9 * PACE * metres..1.1 * PACE * metres;
    // A coordinate near a million is rounded to a sixteenth.
    assert!(widths[0] < PACE * 0.1 && paces(0.01).contains(&widths[2]), "{widths:?}");
    assert!(0.0 < widths[1] && widths[1] < 0.1 && widths[3].is_finite(), "{widths:?}");
}
