//! The depth that an expanding polytope finds is true, whatever was known before.

use super::proofs::{exhaustive, placed};
use super::*;
use crate::polyhedron::convex::{Probe, Query, Wanted};
use crate::polyhedron::sat::grow::{Bound, Met, grow};

/// Rings of `sides` corners at several heights, of different widths: prisms, frustums, cones, drums.
fn rimmed(random: &mut Random, sides: usize) -> Shape3 {
    let step = Quat::from_xyzw(0.0, (core::f32::consts::PI / sides as f32).min(1.0), 0.0, 1.0).normalize();
    let around: Vec<Vec3> =
        (0..sides).scan(Vec3::X, |at, _| Some(core::mem::replace(at, step * *at))).collect();
    let high = 0.2 + random.number().abs();
    let upper = [1.0, 1.0, 0.7, 0.0][(random.number().abs() * 4.0) as usize % 4];
    let ring = |wide: f32, y: f32| around.iter().map(move |at| at * wide + Vec3::Y * y).collect::<Vec<_>>();
    let middle = if upper == 1.0 && high > 0.7 { ring(1.2, 0.0) } else { Vec::new() };
    let points = [ring(1.0, -high), ring(upper, high), middle].concat();
    Hull::from_points(&points).unwrap().into()
}

fn shape(random: &mut Random, case: u64) -> Shape3 {
    match case % 4 {
        0 => random.hull(case / 4),
        1 => random.round_hull(5 + case as usize % 40),
        _ => rimmed(random, 3 + case as usize % 20),
    }
}

/// Two rimmed hulls, one deep inside the other.
fn rimmed_pair(random: &mut Random, sides: [usize; 2], case: u64) -> ([Shape3; 2], [Pose3; 2]) {
    let shapes = sides.map(|sides| rimmed(random, sides));
    // `placed` puts every fifth case there.
    let poses = placed(random, [&shapes[0], &shapes[1]], 5 * case);
    (shapes, poses)
}

#[test]
fn depths_are_bounded_from_both_sides_whatever_was_known() {
    let mut random = Random(0x60BE_E2BE_E120_FC15);
    let (mut found, mut tested, mut settled) = (0, 0, 0);
    for case in 0..900_u64 {
        let (shape_a, shape_b) = (shape(&mut random, case), shape(&mut random, case / 3));
        let [pose_a, pose_b] = placed(&mut random, [&shape_a, &shape_b], case);
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| {
            let depth = -exhaustive(a, b);
            let rounding = 2.0 * pair.precision.projection();
            let slack = 64.0 * pair.precision.projection();
            for known in [f64::INFINITY, 1.5 * depth, depth, 0.7 * depth] {
                let Some(Bound { at_least, met }) = grow((a, b), (known, slack), &pair.precision) else {
                    continue;
                };
                assert!(at_least <= depth + rounding, "case {case}: {at_least}, and it is {depth}");
                match met {
                    Some(Met { direction, .. }) => {
                        let shown = a.project(direction).1 - b.project(direction).0;
                        let is_unit = (direction.length() - 1.0).abs() < 1e-12;
                        assert!(
                            is_unit && shown <= at_least + slack + rounding,
                            "case {case}: {shown}, {at_least}"
                        );
                    }
                    None => assert!(at_least >= known - slack, "case {case}: {at_least}, known {known}"),
                }
                found += usize::from(met.is_some());
                settled += usize::from(met.is_none());
            }
            // Flat hulls have no inside, and what overlaps by less than rounding is left alone.
            tested += 4 * usize::from(a.inner_radius > 0.05 && b.inner_radius > 0.05 && depth > 1e-5);
        });
    }
    assert!(tested > 2000 && (found + settled) * 100 > tested * 90, "{found} and {settled} of {tested}");
    assert!(found > 500 && settled > 500, "{found} and {settled} of {tested}");
}

#[test]
fn the_best_axis_of_hulls_with_large_faces_is_that_of_all_axes() {
    let mut random = Random(0x3C79_AC49_2BA7_B653);
    let (mut by_edges, mut by_faces) = (0, 0);
    for case in 0..150_u64 {
        let sides = [16, 14 + case as usize % 6];
        let ([shape_a, shape_b], [pose_a, pose_b]) = rimmed_pair(&mut random, sides, case);
        let pair = convex(&shape_a, pose_a, &shape_b, pose_b);
        pair.with_solids(|a, b| {
            let axes = pair.all_axes(a, b, f64::NEG_INFINITY);
            let (best, truth) = (axes.best(), exhaustive(a, b));
            let error = f64::from(pair.precision.of_separation(best.separation, axes.short()));
            assert!((best.separation - truth).abs() <= error, "case {case}: {best:?}, {truth}");
            assert!(error < 1e-6, "case {case}: {error}");
            let shown = b.project(best.normal).0 - a.project(best.normal).1;
            assert!((best.separation - shown).abs() <= pair.precision.projection(), "case {case}: {shown}");
            if matches!(best.of, AxisOf::Edges(..)) { by_edges += 1 } else { by_faces += 1 }
        });
    }
    assert!(by_edges > 20 && by_faces > 20, "{by_edges} by edges, {by_faces} by faces");
}

/// An axis that was not proved to be the best leaves out all faces that show less.
#[test]
fn an_answer_is_as_good_whatever_axis_was_the_best_before() {
    let mut random = Random(0xD1B5_4A32_D192_ED03);
    let (mut tested, mut left_out) = (0, 0);
    for case in 0..250_u64 {
        let ([shape_a, shape_b], [pose_a, pose_b]) = rimmed_pair(&mut random, [16; 2], case);
        let before = convex(&shape_a, pose_a, &shape_b, pose_b);
        let hint = before.with_solids(|a, b| hint_to(before.all_axes(a, b, f64::NEG_INFINITY).best().of));
        for step in [1e-3, 1e-2, 3e-2] {
            let turn = (random.vector() * step).extend(1.0);
            let turned = (pose_b.rotation() * Quat::from_vec4(turn)).normalize();
            let moved =
                Pose3::new(pose_b.position() + (random.vector() * step * 0.3).as_dvec3(), turned).unwrap();
            let pair = convex(&shape_a, pose_a, &shape_b, moved);
            pair.with_solids(|a, b| {
                let query = Query { limit: 0.0, hint, wanted: Wanted::Number };
                let Probe::Near(near) = pair.probe(query) else { panic!("case {case}: apart") };
                let truth = exhaustive(a, b);
                let off = (f64::from(near.separation) - truth).abs();
                assert!(off <= near.error.into(), "case {case}: {} and {truth}", near.separation);
                assert!(near.error < 1e-6, "case {case}: {}", near.error);
                let faces = face_axes(a, b, &search_of(&pair));
                let best_face = faces.face_a.separation.max(faces.face_b.separation);
                let hinted = Hinted::new((a, b), hint, &pair.precision);
                tested += 1;
                left_out += usize::from(hinted.is_some_and(|of| of.axis.separation > best_face));
            });
        }
    }
    assert!(tested == 750 && left_out > 50, "{left_out} of {tested}");
}

fn search_of<'a>(pair: &'a Convex) -> Search<'a> {
    Search { known: f64::NEG_INFINITY, unproved: f64::NEG_INFINITY, slack: 1e-6, precision: &pair.precision }
}
