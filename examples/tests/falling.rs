//! Recorded heaps: they are the same each time, and their bodies fall into the pit, tumble and stay in it.
#![allow(clippy::unwrap_used, reason = "helpers of tests stop the test, as tests do")]

use asunder::Pose3;
use asunder_examples::falling::{FRAMES, recorded};
use asunder_scenes::stages::Falling;
use asunder_scenes::worlds::Replay3;

/// The bodies of a heap that is small, yet five deep: a pit of 5 m, with 125 bodies in it.
const COUNT: usize = 130;

/// The poses of all moving bodies, frame by frame.
fn frames(mut replay: Replay3) -> Vec<Vec<Pose3>> {
    let at = |frame| {
        replay.advance(frame);
        replay.movers().iter().map(|&i| replay.bodies[i as usize].pose).collect()
    };
    (0..=FRAMES).map(at).collect()
}

fn bits(frames: &[Vec<Pose3>]) -> Vec<[u64; 7]> {
    let of = |pose: &Pose3| {
        let ([x, y, z], turn) = (pose.position().to_array(), pose.rotation().to_array());
        let [a, b, c, d] = turn.map(|number| u64::from(number.to_bits()));
        [x.to_bits(), y.to_bits(), z.to_bits(), a, b, c, d]
    };
    frames.iter().flatten().map(of).collect()
}

fn mean_height(poses: &[Pose3]) -> f64 {
    poses.iter().map(|pose| pose.position().y).sum::<f64>() / poses.len() as f64
}

#[test]
fn a_heap_that_is_stepped_twice_has_the_same_poses_to_the_bit() {
    for heap in Falling::ALL {
        let [once, again] = [1, 1].map(|seed| bits(&frames(recorded(heap, COUNT, seed).unwrap())));
        assert_eq!(once.len(), 125 * (FRAMES as usize + 1));
        assert!(once == again, "{}", heap.name());
        let other = bits(&frames(recorded(heap, COUNT, 2).unwrap()));
        assert!(once != other, "{}: another seed is another heap", heap.name());
    }
}

#[test]
fn bodies_fall_and_tumble_and_no_frame_is_like_the_last() {
    for heap in Falling::ALL {
        let frames = frames(recorded(heap, COUNT, 1).unwrap());
        let heights: Vec<f64> = frames.iter().map(|poses| mean_height(poses)).collect();
        // From so low a start nearly all have landed after half a second, and then they settle.
        assert!(heights[..25].windows(2).all(|two| two[1] < two[0]), "{}: {heights:?}", heap.name());
        assert!(heights[0] - heights[FRAMES as usize] > 0.4, "{}: {heights:?}", heap.name());
        for two in frames.windows(2) {
            assert!(two[0].iter().zip(&two[1]).all(|(before, after)| before != after), "{}", heap.name());
        }
        // Half of them turn by 9 degrees or more: the dot product is the cosine of half the angle.
        let turned = frames[0].iter().zip(&frames[FRAMES as usize]);
        let turned = turned.filter(|(a, b)| a.rotation().dot(b.rotation()).abs() < 0.9969);
        assert!(turned.count() > 62, "{}", heap.name());
    }
}

#[test]
fn nobody_leaves_the_pit_nor_is_faster_than_a_fall_makes_it() {
    for heap in Falling::ALL {
        let (low, high) = heap.above_pit(COUNT, 1).room;
        // A fall from the top of the room, and the removal of overlap: 3 m/s at most, from two sides.
        let fastest = (2.0 * 9.81 * high.y).sqrt() + 6.0;
        let frames = frames(recorded(heap, COUNT, 1).unwrap());
        for poses in &frames {
            for place in poses.iter().map(Pose3::position) {
                assert!(place.cmpgt(low).all() && place.cmplt(high).all(), "{}: {place}", heap.name());
            }
        }
        for two in frames.windows(2) {
            for (before, after) in two[0].iter().zip(&two[1]) {
                let way = (after.position() - before.position()).length();
                assert!(way < fastest / 60.0, "{}: {way} m in a frame", heap.name());
            }
        }
    }
}
