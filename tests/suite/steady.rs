//! Resting bodies whose pose changes by one ulp, and bodies in the same place as their like.
//!
//! A solver that gets another number of points each frame, or depths that jump, shakes. The effect of a pose's last
//! bits on an answer is compared with their effect on the shapes' vertices.

mod rests;

use asunder_geometry::{Pose2, Pose3, Shape3};
use asunder_narrow::{Manifold3, Pair2, Pair3, Separation2, Separation3};
use asunder_tests::cases::Random;
use asunder_tests::precise::{along3, separation2, separation3};
use asunder_tests::shapes::{Clay, KINDS2, KINDS3};
use glam::{DVec3, Quat, Vec3};
use rests::{Rest, rest};

const RESTS: usize = 2400;

fn manifold(rest: &Rest, there: &Pose3) -> Manifold3 {
    let found = Pair3::new(&rest.ground, &rest.here, &rest.body, there).manifold(0.0);
    found.unwrap_or_else(|| panic!("it does not touch: {rest:?}"))
}

fn moved(pose: &Pose3, axis: usize, value: f64) -> Pose3 {
    let mut position = pose.position();
    position[axis] = value;
    Pose3::new(position, pose.rotation()).unwrap()
}

/// The pose with each of its three f64 coordinates an ulp up and down.
fn moved_by_bits(pose: &Pose3) -> Vec<Pose3> {
    let values = |axis: usize| [pose.position()[axis].next_up(), pose.position()[axis].next_down()];
    (0..3).flat_map(|axis| values(axis).map(|value| moved(pose, axis, value))).collect()
}

/// The pose as an engine that uses f32 would change it: a coordinate, or one of the four numbers of the rotation, by
/// one f32 ulp.
fn changed_by_f32_bits(pose: &Pose3) -> Vec<Pose3> {
    let mut poses = Vec::new();
    for axis in 0..3 {
        let value = pose.position()[axis];
        let step = f64::from((value as f32).abs().next_up()) - f64::from((value as f32).abs());
        poses.extend([value + step, value - step].map(|value| moved(pose, axis, value)));
    }
    for component in 0..4 {
        let q = pose.rotation().to_array();
        for value in [q[component].next_up(), q[component].next_down()] {
            let mut turned = q;
            turned[component] = value;
            poses.push(Pose3::new(pose.position(), Quat::from_array(turned)).unwrap());
        }
    }
    poses
}

fn neighbours(pose: &Pose3) -> Vec<Pose3> {
    [moved_by_bits(pose), changed_by_f32_bits(pose)].concat()
}

/// The furthest that a vertex moves between two poses, in metres. Computed relative to the body's position, so that the
/// result does not drown in rounding.
fn furthest_move(body: &Shape3, one: &Pose3, other: &Pose3) -> f64 {
    let (from, to) = (one.basis(), other.basis());
    let shift = other.position() - one.position();
    let moved = |v: &Vec3| (to.turn(v.as_dvec3()) - from.turn(v.as_dvec3()) + shift).length();
    body.core().vertices().iter().map(moved).fold(0.0, f64::max)
}

#[test]
fn a_bit_of_a_pose_changes_no_count_of_points() {
    let mut random = Random::new(1600);
    let (mut changed, mut compared, mut shaky, mut counts) = (0, 0, 0, [0; 5]);
    for round in 0..RESTS {
        let rest = rest(&mut random, round);
        let count = manifold(&rest, &rest.there).points.len();
        counts[count] += 1;
        let others = neighbours(&rest.there);
        let differ = others.iter().filter(|pose| manifold(&rest, pose).points.len() != count).count();
        (compared, changed) = (compared + others.len(), changed + differ);
        shaky += usize::from(differ > 0);
    }
    eprintln!(
        "{changed} of {compared} changes of a bit change the count of points, at {shaky} of {RESTS} rests: {counts:?}"
    );
    assert!(counts[1] > 50 && counts[2] > 50 && counts[3] + counts[4] > RESTS / 2, "{counts:?}");
    assert!(1000 * changed <= compared, "{changed} of {compared}");
}

/// How much the depth changes between two answers, in metres, beyond the last bit of its f32.
fn change(one: &Manifold3, other: &Manifold3) -> f64 {
    let change = (f64::from(other.separation) - f64::from(one.separation)).abs();
    (change - f64::from(f32::EPSILON) * f64::from(one.separation.abs())).max(0.0)
}

#[test]
fn a_bit_of_a_pose_changes_no_depth_by_more_than_it_moves_a_vertex() {
    let mut random = Random::new(1601);
    let (mut worst, mut jump, mut jumps) = (0.0_f64, 0.0_f64, 0);
    for round in 0..RESTS {
        let rest = rest(&mut random, round);
        let base = manifold(&rest, &rest.there);
        for there in changed_by_f32_bits(&rest.there) {
            let other = manifold(&rest, &there);
            let share = change(&base, &other) / furthest_move(&rest.body, &rest.there, &there);
            assert!(share <= 30.0, "{share} times what a vertex moves: {base:?} {other:?} {rest:?}");
            worst = worst.max(share);
        }
        // One bit of an f64 position is negligible; what shows is two axes that tie, equally deep within the errors.
        for there in moved_by_bits(&rest.there) {
            let other = manifold(&rest, &there);
            let (change, error) = (change(&base, &other), f64::from(base.error) + f64::from(other.error));
            assert!(change <= error.min(1e-8 * rest.size), "{change} m: {base:?} {other:?} {rest:?}");
            (jump, jumps) = (jump.max(change / rest.size), jumps + usize::from(change > 0.0));
        }
    }
    eprintln!("a depth changes by at most {worst} of what a vertex moves");
    eprintln!("a bit of an f64 position changes a depth {jumps} times, at most by {jump} of size");
    assert!(worst > 0.1, "{worst}: a bit of a quaternion must show");
}

#[test]
fn the_normal_of_a_resting_body_is_the_best_there_is() {
    let mut random = Random::new(1602);
    let mut worst = 0.0_f64;
    for round in 0..RESTS / 4 {
        let rest = rest(&mut random, round);
        for there in [rest.there, neighbours(&rest.there)[round % 20]] {
            let (a, b) = ((&rest.ground, &rest.here), (&rest.body, &there));
            let (truth, found) = (separation3(a, b), manifold(&rest, &there));
            let regret = (truth.separation - along3(a, b, found.normal)) / rest.size;
            assert!(regret <= 1e-6, "regret {regret} of size: {rest:?}");
            worst = worst.max(regret);
            let miss = (f64::from(found.separation) - truth.separation).abs();
            assert!(miss <= f64::from(found.error) + truth.bound, "{found:?}, true {truth:?}: {rest:?}");
        }
    }
    eprintln!("the worst normal loses {worst} of size");
}

/// Every kind of solid against itself in one pose: no axis is better than its opposite, and the centres coincide.
#[test]
fn a_solid_in_its_own_place_is_as_deep_as_it_is_thin() {
    let mut random = Random::new(1603);
    for (name, make) in KINDS3.iter().filter(|(name, _)| *name != "half-space") {
        for round in 0..40 {
            let mut clay = if round % 4 == 0 { Clay::short(&mut random) } else { Clay::thick(&mut random) };
            let (shape, turn) = (make(&mut clay), random.quaternion());
            let place = [DVec3::ZERO, random.vector() * 1e3][round % 2];
            let pose = Pose3::new(place, turn).unwrap();
            let pair = Pair3::new(&shape, &pose, &shape, &pose);
            let Separation3::Measured(found) = pair.separation(0.0) else {
                panic!("{name} is beyond itself")
            };
            let truth = separation3((&shape, &pose), (&shape, &pose));
            let miss = (f64::from(found.separation) - truth.separation).abs();
            assert!(
                miss <= f64::from(found.error) + truth.bound,
                "{name}: {found:?}, true {truth:?}: {shape:?}"
            );
            let size = 2.0 * f64::from(shape.outer_radius());
            assert!(f64::from(found.error) <= 1e-6 * size, "{name}: {found:?}");
            let regret = truth.separation - along3((&shape, &pose), (&shape, &pose), found.normal);
            assert!(regret <= 1e-6 * size, "{name}: a normal that loses {regret} m: {shape:?}");
            let points = pair.manifold(0.0).map_or(0, |manifold| manifold.points.len());
            assert!(pair.overlaps() && points > 0 && pair.distance().is_none(), "{name}: {shape:?}");
        }
    }
}

#[test]
fn a_shape_in_its_own_place_in_the_plane_is_as_deep_as_it_is_thin() {
    let mut random = Random::new(1604);
    for (name, make) in KINDS2.iter().filter(|(name, _)| *name != "half-plane") {
        for round in 0..80 {
            let mut clay = if round % 4 == 0 { Clay::short(&mut random) } else { Clay::thick(&mut random) };
            let (shape, turn) = (make(&mut clay), random.rotation2());
            let place = [DVec3::ZERO, random.vector() * 1e3][round % 2].truncate();
            let pose = Pose2::new(place, turn).unwrap();
            let pair = Pair2::new(&shape, &pose, &shape, &pose);
            let Separation2::Measured(found) = pair.separation(0.0) else {
                panic!("{name} is beyond itself")
            };
            let truth = separation2((&shape, &pose), (&shape, &pose));
            let miss = (f64::from(found.separation) - truth.separation).abs();
            assert!(
                miss <= f64::from(found.error) + truth.bound,
                "{name}: {found:?}, true {truth:?}: {shape:?}"
            );
            let points = pair.manifold(0.0).map_or(0, |manifold| manifold.points.len());
            assert!(pair.overlaps() && points > 0 && pair.distance().is_none(), "{name}: {shape:?}");
        }
    }
}
