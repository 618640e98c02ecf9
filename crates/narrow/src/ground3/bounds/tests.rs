//! What bounds and landings prove, beside separations and casts of bare triangles.

use super::*;
use crate::Pair3;
use crate::answer::Separation3;
use crate::numbers::Numbers;
use asunder_geometry::glam::Quat;
use asunder_geometry::{Capsule3, Cuboid, Hull, Pose3, TriMesh, Triangle3};

fn body(numbers: &mut Numbers, size: f64, round: usize) -> Shape3 {
    let half = ((numbers.vector().abs() + 0.1) * size).as_vec3();
    let radius = if round.is_multiple_of(3) { 0.2 * size } else { 0.0 } as f32;
    let cuboid = Cuboid::from_half_extents(half).unwrap();
    let mut hull = |count: usize| {
        let points: Vec<Vec3> = (0..count).map(|_| (numbers.vector() * size).as_vec3()).collect();
        Shape3::from(Hull::from_points(&points).unwrap())
    };
    match round % 6 {
        0..3 => cuboid.rounded(radius).unwrap().into(),
        3 => Capsule3::from_half_height(half.y, half.x).unwrap().into(),
        4 => hull(7),
        _ => hull(20),
    }
}

fn pose(numbers: &mut Numbers, size: f64) -> Pose3 {
    let turn = Quat::from_xyzw(0.3, numbers.number() as f32, numbers.number() as f32, -0.4);
    Pose3::new(numbers.vector() * size, turn.normalize()).unwrap()
}

#[test]
fn what_is_proved_of_a_triangle_holds_for_its_separation() {
    let mut numbers = Numbers::new(77);
    let (mut apart, mut tight, mut held, mut overlapping) = (0, 0, 0, 0);
    for round in 0..20_000 {
        let size = [1e-3, 1.0, 1e3][round % 5 % 3];
        let body = body(&mut numbers, size, round);
        let corners = [0, 1, 2].map(|_| (numbers.vector() * size * 2.0).as_vec3());
        let (at, under) = (pose(&mut numbers, 2.0 * size), pose(&mut numbers, size));
        let mesh: Shape3 = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap().into();
        let [a, b, c] = corners;
        let triangle = Shape3::from(Triangle3::new(a, b, c).unwrap());
        let Separation3::Measured(truth) =
            Pair3::new(&body, &at, &triangle, &under).separation(f32::INFINITY)
        else {
            panic!("no limit was given");
        };
        let (separation, error) = (f64::from(truth.separation), f64::from(truth.error));
        let pair = Pair3::new(&body, &at, &mesh, &under);
        let on = OnGround::of(&pair).unwrap();
        on.for_body_parts(0.0, |part| {
            let placed = Corners::of(&on, part);
            let beside = placed.beside(corners);
            for beside in [beside, placed.narrowed(&beside)] {
                let gap = placed.gap(&beside, f64::INFINITY);
                assert!(gap <= separation.max(0.0) + error, "round {round}: {gap} of {separation}");
                let at_most = placed.at_most(&beside);
                assert!(at_most >= separation - error, "round {round}: {at_most} of {separation}");
                let is_cuboid = matches!(body, Shape3::Cuboid(_));
                tight += usize::from(is_cuboid && separation > 0.0 && at_most - gap < 1e-3 * size);
                if placed.holds_some(&beside) {
                    assert!(separation <= 0.0, "round {round}: {separation}");
                    held += 1;
                }
            }
            false
        });
        if separation > 0.0 { apart += 1 } else { overlapping += 1 }
    }
    assert!(
        apart > 8000 && overlapping > 3000 && tight > 3000 && held > 2000,
        "{apart} {overlapping} {tight} {held}"
    );
}

/// A body above a triangle, and a way along which it may come down on it, or not.
fn dropped(numbers: &mut Numbers, round: usize) -> (Shape3, Pose3, [Vec3; 3], Pose3, Vec3) {
    let size = [1e-3, 1.0, 1e3][round % 5 % 3];
    let body = body(numbers, size, round);
    // Far from the origin now and then, where rounding is coarse.
    let far = if round.is_multiple_of(7) { DVec3::new(3e5, -2e5, 1e5) } else { DVec3::ZERO };
    let corners = [0, 1, 2].map(|_| (numbers.vector() * size * 3.0).as_vec3());
    let (at, under) = (pose(numbers, 3.0 * size), pose(numbers, size));
    let moved = |pose: &Pose3| Pose3::new(pose.position() + far, pose.rotation()).unwrap();
    // Towards the triangle, by and large.
    let towards = under.position() - at.position() + numbers.vector() * size;
    (body, moved(&at), corners, moved(&under), (towards * 2.0).as_vec3())
}

#[test]
fn what_is_proved_of_a_motion_holds_for_its_cast() {
    let mut numbers = Numbers::new(78);
    let (mut landings, mut passed, mut at_once) = (0, 0, 0);
    for round in 0..20_000 {
        let (body, mut at, corners, under, mut way) = dropped(&mut numbers, round);
        let mesh: Shape3 = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap().into();
        let [a, b, c] = corners;
        let triangle = Shape3::from(Triangle3::new(a, b, c).unwrap());
        // By steps: a bare triangle has no landing.
        let first = Pair3::new(&body, &at, &triangle, &under).cast(way);
        if let (2, Some(hit)) = (round % 4, &first) {
            // From just before they touch.
            at = at.shifted(way.as_dvec3() * hit.fraction).unwrap();
            way *= 0.1;
        }
        let cast = Pair3::new(&body, &at, &triangle, &under).cast(way);
        let pair = Pair3::new(&body, &at, &mesh, &under);
        let on = OnGround::of(&pair).unwrap();
        let local = on.basis.turn_back(way.as_dvec3());
        let lost = f64::EPSILON * (at.position().abs().element_sum() + way.as_dvec3().abs().element_sum());
        on.for_body_parts(0.0, |part| {
            let placed = Corners::of(&on, part);
            if placed.passes(corners, local, lost) {
                // Those that pass each other within the error of a cast may count as touching.
                let is_near = |hit: &crate::Impact3| {
                    let there = at.shifted(way.as_dvec3() * hit.fraction).unwrap();
                    Pair3::new(&body, &there, &triangle, &under).overlaps()
                };
                assert!(!cast.as_ref().is_some_and(is_near), "round {round}: {cast:?}");
                passed += 1;
            }
            let Some(landing) = placed.landing(part, corners, (local, 1.0, lost)) else { return false };
            let hit = cast.unwrap_or_else(|| panic!("round {round}: it passes"));
            let length = way.as_dvec3().length();
            // The error of a cast is along the normal.
            let slope = -landing.up.dot(local) / length;
            let off = (hit.fraction - landing.fraction).abs() * length * slope;
            let error = f64::from(hit.error) + landing.gap;
            assert!(off <= error, "round {round}: {off}, {error}");
            let there = at.shifted(way.as_dvec3() * landing.fraction).unwrap();
            let landed = Pair3::new(&body, &there, &triangle, &under);
            assert!(!landed.overlaps(), "round {round} at {}", landing.fraction);
            let Separation3::Measured(gap) = landed.separation(f32::INFINITY) else {
                panic!("no limit was given");
            };
            let (gap, error) = (f64::from(gap.separation), f64::from(gap.error) + lost);
            assert!(gap <= landing.gap + error, "round {round}: {gap} of {}", landing.gap);
            landings += 1;
            at_once += usize::from(landing.fraction < 1e-3);
            false
        });
    }
    assert!(landings > 2500 && passed > 4000 && at_once > 300, "{landings} {passed} {at_once}");
}
