//! The oracles, compared with each other and with cases whose answer is known beforehand.

mod exact;
mod numbers;
mod precise;

use asunder_geometry::{Cuboid, Pose2, Pose3, Rect, Shape2, Shape3};
use asunder_tests::cases::{Case2, Case3, Random};
use asunder_tests::exact_overlap::{exact_overlap2, exact_overlap3};
use asunder_tests::exhaustive_distance::{exhaustive_distance2, exhaustive_distance3};
use asunder_tests::exhaustive_sat::{exhaustive_sat2, exhaustive_sat3, gap2, gap3};
use asunder_tests::solid::Solid;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// Rounding of f64 for a pair about a metre in size: forty or so roundings of 1.1e-16 each.
const ROUNDING: f64 = 1e-14;

/// The same for a gap along the line between two points: the closer they are, the less certain is its direction.
fn rounding_along_line(distance: f64) -> f64 {
    ROUNDING * (1.0 + 0.1 / distance)
}

fn exact3(case: &Case3) -> bool {
    exact_overlap3((&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b))
}

fn exact2(case: &Case2) -> bool {
    exact_overlap2((&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b))
}

#[test]
fn a_solid_obeys_eulers_formula() {
    let mut random = Random::new(1);
    for _ in 0..300 {
        let shape = random.shape3();
        let solid = Solid::of(&shape);
        let (vertices, edges, facets) = (solid.vertices.len(), solid.edges.len(), solid.facets.len());
        assert_eq!(vertices + facets, edges + 2, "{shape:?}");
        let corners: usize = solid.facets.iter().map(|facet| facet.corners.len()).sum();
        assert_eq!(corners, 2 * edges, "each edge bounds two facets: {shape:?}");
        for facet in &solid.facets {
            let reach = |v: &Vec3| facet.normal.dot(v.as_dvec3());
            let plane = reach(&solid.vertices[facet.corners[0]]);
            assert!(solid.vertices.iter().all(|v| reach(v) <= plane + ROUNDING), "normals point out");
        }
    }
}

#[test]
fn distance_and_separation_prove_each_other() {
    let mut random = Random::new(2);
    let (mut apart, mut overlapping) = (0, 0);
    for round in 0..3000 {
        let case = random.case3();
        let (a, b) = case.placed();
        let best = exhaustive_sat3(&a, &b);
        for _ in 0..20 {
            let tried = gap3(&a, &b, random.direction());
            assert!(
                best.gap > 0.0 || tried <= best.gap + ROUNDING,
                "{round}: no axis parts more than the best"
            );
        }
        if best.gap > 0.0 {
            apart += 1;
            let nearest = exhaustive_distance3(&a, &b);
            // The two points bound the distance from above, the gap along their line from below.
            let below = gap3(&a, &b, (nearest.on_b - nearest.on_a) / nearest.distance);
            assert!(
                (nearest.distance - below).abs() <= rounding_along_line(nearest.distance),
                "{round}: {} {below}",
                nearest.distance
            );
            assert!(best.gap <= nearest.distance + ROUNDING, "{round}");
        } else {
            overlapping += 1;
        }
    }
    assert!(apart > 500 && overlapping > 500, "{apart} apart, {overlapping} in overlap");
}

#[test]
fn distance_and_separation_prove_each_other_in_the_plane() {
    let mut random = Random::new(3);
    let (mut apart, mut overlapping) = (0, 0);
    for round in 0..3000 {
        let case = random.case2();
        let (a, b) = case.placed();
        let best = exhaustive_sat2(&a, &b);
        for _ in 0..20 {
            let tried = gap2(&a, &b, random.direction2());
            assert!(
                best.gap > 0.0 || tried <= best.gap + ROUNDING,
                "{round}: no axis parts more than the best"
            );
        }
        if best.gap > 0.0 {
            apart += 1;
            let nearest = exhaustive_distance2(&a, &b);
            let below = gap2(&a, &b, (nearest.on_b - nearest.on_a) / nearest.distance);
            assert!(
                (nearest.distance - below).abs() <= rounding_along_line(nearest.distance),
                "{round}: {} {below}",
                nearest.distance
            );
        } else {
            overlapping += 1;
        }
    }
    assert!(apart > 500 && overlapping > 500, "{apart} apart, {overlapping} in overlap");
}

#[test]
fn a_least_translation_parts_and_a_shorter_one_does_not() {
    let mut random = Random::new(4);
    for round in 0..300 {
        let case = random.near_case3(-0.05);
        let (a, b) = case.placed();
        let best = exhaustive_sat3(&a, &b);
        let moved = |by: DVec3| {
            let pose_b = Pose3::new(case.pose_b.position() + by, case.pose_b.rotation()).unwrap();
            exact3(&Case3 { pose_b, ..case.clone() })
        };
        assert!(!moved(best.normal * (1e-9 - best.gap)), "{round}: apart beyond the depth");
        let shorter = random.direction() * (-best.gap - 1e-9);
        assert!(moved(shorter), "{round}: no shorter translation parts them");
    }
}

#[test]
fn exact_overlap_agrees_wherever_f64_can_tell() {
    let mut random = Random::new(5);
    let mut told = [0; 2];
    for round in 0..600 {
        let gap = random.pick(&[0.0, 1e-3, -1e-3, 1e-7, -1e-7, 1e-11, -1e-11]);
        let case = if round % 3 == 0 { random.case3() } else { random.near_case3(gap) };
        let separation = case.truth().separation;
        if separation.abs() > ROUNDING {
            assert_eq!(exact3(&case), separation < 0.0, "{round}: {separation}");
            told[usize::from(separation < 0.0)] += 1;
        }
        let case = if round % 3 == 0 { random.case2() } else { random.near_case2(gap) };
        let separation = case.truth().separation;
        if separation.abs() > ROUNDING {
            assert_eq!(exact2(&case), separation < 0.0, "{round}: {separation}");
            told[usize::from(separation < 0.0)] += 1;
        }
    }
    assert!(told.iter().all(|&told| told > 200), "{told:?}");
}

#[test]
fn exact_overlap_knows_one_unit_in_the_last_place() {
    let half = Vec3::new(1.0, 0.5, 0.25);
    let cuboid = Shape3::from(Cuboid::from_half_extents(half).unwrap());
    let rect = Shape2::from(Rect::from_half_extents(half.truncate()).unwrap());
    let quarter_turn = Quat::from_xyzw(0.0, 0.0, 3.0, 3.0);
    // A quarter turn about z swaps the half extents in x and y exactly.
    for (rotation, touching) in [(Quat::IDENTITY, 2.0), (quarter_turn, 1.5)] {
        let shares = |x: f64| {
            let pose = Pose3::new(DVec3::new(x, 0.25, 0.5), rotation).unwrap();
            exact_overlap3((&cuboid, &Pose3::IDENTITY), (&cuboid, &pose))
        };
        assert!(shares(touching), "an edge on an edge still touches");
        assert!(!shares(f64::next_up(touching)) && shares(f64::next_down(touching)));
    }
    let shares = |x: f64| {
        let pose = Pose2::at(DVec2::new(x, 1.0)).unwrap();
        exact_overlap2((&rect, &Pose2::IDENTITY), (&rect, &pose))
    };
    assert!(shares(2.0) && !shares(2.0_f64.next_up()) && shares(2.0_f64.next_down()));
}

#[test]
fn separations_of_axis_aligned_boxes_are_plain_differences() {
    let mut random = Random::new(6);
    for _ in 0..1000 {
        let [p, q] = [0, 1].map(|_| Vec3::from_array([0.0; 3].map(|_: f64| random.between(0.2, 1.0) as f32)));
        let away = random.vector() * 2.5;
        let case = Case3 {
            shape_a: Cuboid::from_half_extents(p).unwrap().into(),
            pose_a: Pose3::IDENTITY,
            shape_b: Cuboid::from_half_extents(q).unwrap().into(),
            pose_b: Pose3::at(away).unwrap(),
        };
        let gaps = away.abs() - (p.as_dvec3() + q.as_dvec3());
        let separation =
            if gaps.max_element() > 0.0 { gaps.max(DVec3::ZERO).length() } else { gaps.max_element() };
        assert!((case.truth().separation - separation).abs() <= ROUNDING);
        let flat = Case2 {
            shape_a: Rect::from_half_extents(Vec2::new(p.x, p.y)).unwrap().into(),
            pose_a: Pose2::IDENTITY,
            shape_b: Rect::from_half_extents(Vec2::new(q.x, q.y)).unwrap().into(),
            pose_b: Pose2::at(away.truncate()).unwrap(),
        };
        let gaps = gaps.truncate();
        let separation =
            if gaps.max_element() > 0.0 { gaps.max(DVec2::ZERO).length() } else { gaps.max_element() };
        assert!((flat.truth().separation - separation).abs() <= ROUNDING);
    }
}
