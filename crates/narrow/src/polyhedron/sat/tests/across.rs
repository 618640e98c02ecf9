//! The gap found from last frame's axis is the one that the iteration finds, whatever a hint named.

use super::super::super::distance::{Reached, Until, Witness, distance};
use super::*;

/// Hulls and boxes, face on face, edge on edge, on corners, and in any other way, a little apart.
fn placed(random: &mut Random, case: u64) -> ([Shape3; 2], [Pose3; 2]) {
    let mut shape = |kind: u64| match kind % 3 {
        0 => random.round_hull(24),
        1 => asunder_geometry::Cuboid::from_half_extents(random.vector().abs() + 0.2).unwrap().into(),
        _ => random.hull(kind / 3),
    };
    let shapes = [shape(case), shape(case / 3)];
    let turns = [random.turn(case / 2), random.turn(case / 5)];
    let towards = random.vector().normalize_or(Vec3::X).as_dvec3();
    let posed =
        |at: f64| [(0.0, turns[0]), (at, turns[1])].map(|(at, turn)| Pose3::new(towards * at, turn).unwrap());
    let out = parted(&shapes, [1e-7, 1e-4, 0.02, 0.5][case as usize % 4], posed);
    (shapes, posed(out))
}

/// How far out B must be for this gap to A.
fn parted(shapes: &[Shape3; 2], gap: f64, posed: impl Fn(f64) -> [Pose3; 2]) -> f64 {
    let (mut near, mut far) = (0.0, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (near + far);
        let poses = posed(middle);
        let pair = crate::Pair3::new(&shapes[0], &poses[0], &shapes[1], &poses[1]);
        let is_wider = pair.distance().is_some_and(|found| f64::from(found.distance) > gap);
        if is_wider { far = middle } else { near = middle }
    }
    far
}

/// What the iteration finds.
fn iterated(pair: &Convex, a: &Solid, b: &Solid) -> Option<Witness> {
    match distance(a, b, DVec3::X, &Until::met(&pair.precision)) {
        Reached::Between(witness) => Some(witness),
        Reached::Origin(_) => None,
    }
}

/// Checks a gap that a hint found against the one that the iteration finds.
fn check(case: u64, pair: &Convex, (a, b): (&Solid, &Solid), truth: &Witness, witness: &Witness) {
    let rounding = 8.0 * pair.precision.projection() + 2e-12 * pair.precision.size;
    let (low, high) = (truth.at_least - rounding, truth.distance + rounding);
    assert!(witness.at_least <= high && witness.distance >= low, "{case}: {witness:?}, {truth:?}");
    // On a merged face the point may lie at the height of its lowest corner, which is off its plane by no more than
    // rounding.
    assert!(witness.distance - witness.at_least <= rounding, "{case}: {witness:?}");
    let apart = (witness.point_b - witness.point_a).length();
    assert!((apart - witness.distance).abs() <= rounding, "{case}: {witness:?}");
    // The points are the solids' own: none of them lies further out than its solid reaches.
    for normal in [witness.normal, DVec3::X, DVec3::Y, DVec3::Z] {
        for normal in [normal, -normal] {
            assert!(normal.dot(witness.point_a) <= a.support(normal).reach + rounding, "{case}");
            assert!(normal.dot(witness.point_b) <= b.support(normal).reach + rounding, "{case}");
        }
    }
}

#[test]
fn a_gap_is_as_wide_as_by_the_iteration_or_not_found() {
    let mut random = Random(0x8EBC_6AF0_9C88_C6E3);
    let (mut by_face, mut by_edges, mut by_direction, mut not_found, mut never) = (0, 0, 0, 0, 0);
    for case in 0..300_u64 {
        let ([shape_a, shape_b], [pose_a, pose_b]) = placed(&mut random, case);
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| {
            let Some(truth) = iterated(&pair, a, b) else { return };
            let check = |witness: &Witness| check(case, &pair, (a, b), &truth, witness);
            let mut is_found = false;
            let edges = |solid: &Solid| solid.topology.edges().to_vec();
            let pairs = edges(a).into_iter().flat_map(|edge_a| {
                edges(b).into_iter().map(move |edge_b| AxisOf::Edges(edge_a.into(), edge_b.into()))
            });
            let faces = (0..a.face_count()).map(AxisOf::FaceA).chain((0..b.face_count()).map(AxisOf::FaceB));
            for of in faces.chain(pairs) {
                let Some(hinted) = Hinted::new((a, b), hint_to(of), &pair.precision) else { continue };
                let Some((_, witness)) = hinted.across((a, b), &pair.precision) else {
                    not_found += 1;
                    continue;
                };
                check(&witness);
                is_found = true;
                if matches!(of, AxisOf::Edges(..)) { by_edges += 1 } else { by_face += 1 }
            }
            // From the right direction, and from unrelated ones.
            for direction in [truth.normal, DVec3::X, random.vector().normalize_or(Vec3::X).as_dvec3()] {
                if let Some((_, witness)) = across_edges((a, b), direction, &pair.precision) {
                    check(&witness);
                    is_found = true;
                    by_direction += 1;
                }
            }
            never += usize::from(!is_found);
        });
    }
    let counts = [by_face, by_edges, by_direction, not_found, never];
    assert!(
        by_face > 40 && by_edges > 40 && by_direction > 20 && not_found > 50_000 && never < 30,
        "{counts:?}"
    );
}

#[test]
fn a_face_finds_the_gap_of_upright_solids_wherever_its_edges_end() {
    let mut random = Random(0x2127_599B_F432_5C37);
    let (mut by_face, mut not_found) = (0, 0);
    for case in 0..300_u64 {
        let (shapes, turns, at) = upright(&mut random, case);
        let posed = |out: f64| {
            [(DVec3::ZERO, turns[0]), (at(out), turns[1])].map(|(at, turn)| Pose3::new(at, turn).unwrap())
        };
        let [pose_a, pose_b] = posed(parted(&shapes, [1e-7, 1e-4, 0.02, 0.5][case as usize % 4], posed));
        let pair = convex(&shapes[0], pose_a, &shapes[1], pose_b);
        pair.with_solids(|a, b| {
            let Some(truth) = iterated(&pair, a, b) else { return };
            let mut is_found = false;
            let faces = (0..a.face_count()).map(AxisOf::FaceA).chain((0..b.face_count()).map(AxisOf::FaceB));
            for of in faces {
                let hinted = Hinted::new((a, b), hint_to(of), &pair.precision);
                if let Some((_, witness)) = hinted.and_then(|hinted| hinted.across((a, b), &pair.precision)) {
                    check(case, &pair, (a, b), &truth, &witness);
                    is_found = true;
                }
            }
            if is_found { by_face += 1 } else { not_found += 1 }
        });
    }
    // Where corners are nearest, as seen from above, no face finds the gap.
    assert!(by_face > 240 && not_found < 50, "{by_face}, {not_found}");
}
