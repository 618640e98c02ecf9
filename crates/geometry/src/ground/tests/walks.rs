//! Tests of the three traversals against all boxes.

use super::meshes::{Named, all, grid};
use super::{Dice, fields, mesh_of};
use crate::aabb::Aabb3;
use crate::ground::Ground;
use crate::shape::Shape3;
use crate::triangle::Triangle3;
use core::ops::ControlFlow;
use glam::{DVec3, Vec3};

fn shapes() -> Vec<(String, Shape3)> {
    let mut shapes: Vec<(String, Shape3)> =
        all().iter().map(|given: &Named| (given.name.clone(), mesh_of(given).into())).collect();
    for (columns, rows, seed) in [(2, 2, 1), (3, 9, 2), (30, 21, 3), (70, 5, 4)] {
        shapes.push((format!("field {seed}"), fields::random(columns, rows, seed).into()));
    }
    shapes.push((
        "large".to_owned(),
        mesh_of(&grid("large", 70, |column, row| (column * row % 7) as f32)).into(),
    ));
    // So many vertices per triangle that the tree holds only boxes.
    let mut spare = grid("spare", 40, |column, row| (column * row % 5) as f32);
    spare.vertices.resize(3 * spare.triangles.len(), Vec3::ZERO);
    shapes.push(("spare".to_owned(), mesh_of(&spare).into()));
    shapes
}

#[test]
fn corners_that_are_handed_over_are_those_of_the_number() {
    let mut count = 0;
    for (name, shape) in shapes() {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let mut dice = Dice::new(17);
        for _ in 0..40 {
            let ((from, _), (to, _)) = (somewhere(&mut dice, &shape), somewhere(&mut dice, &shape));
            let (mut found, mut read) = (vec![], vec![]);
            let (from, along) = (from.as_dvec3(), (to - from).as_dvec3());
            ground.visit_along(from, along, Vec3::ZERO, 2.0, |number| {
                found.push(number);
                2.0
            });
            ground.read_along(from, along, Vec3::ZERO, 2.0, |number, corners| {
                assert_eq!(corners, ground.corners(number), "{name} {number}");
                assert_eq!(Some(Triangle3::known(corners)), ground.triangle(number), "{name} {number}");
                read.push(number);
                2.0
            });
            assert_eq!(found, read, "{name}");
            count += read.len();
        }
    }
    assert!(count > 1000, "{count}");
}

fn box_of(ground: Ground<'_>, number: u32) -> Option<Aabb3> {
    let [a, b, c] = ground.triangle(number)?.vertices();
    Some(Aabb3::new(a.min(b).min(c), a.max(b).max(c)))
}

fn boxes(ground: Ground<'_>) -> Vec<(u32, Aabb3)> {
    (0..ground.triangle_count()).filter_map(|number| Some((number, box_of(ground, number)?))).collect()
}

/// A point near the ground, and a size.
fn somewhere(dice: &mut Dice, shape: &Shape3) -> (Vec3, f32) {
    let size = shape.outer_radius();
    let mut part = || dice.between(-1.2, 1.2) * size;
    (shape.center() + Vec3::new(part(), part() * 0.3, part()), size)
}

#[test]
fn what_is_near_is_what_a_loop_over_all_boxes_finds() {
    let (mut met, mut missed) = (0, 0);
    for (name, shape) in shapes() {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let (boxes, mut dice) = (boxes(ground), Dice::new(11));
        for round in 0..120 {
            let (low, size) = somewhere(&mut dice, &shape);
            let mut bounds = Aabb3::new(low, low + size * [0.0, 0.02, 0.3, 2.0][round % 4]);
            if round % 5 == 0 {
                // Sides that touch exactly.
                let other = boxes[dice.below(boxes.len() as u32) as usize].1;
                bounds = [Aabb3::new(other.max, other.max), other][round / 5 % 2];
            }
            if round % 17 == 0 {
                bounds = [
                    Aabb3::new(Vec3::NEG_INFINITY, Vec3::INFINITY),
                    Aabb3::new(Vec3::ONE, Vec3::ZERO),
                    Aabb3::new(Vec3::NAN, Vec3::INFINITY),
                ][round / 17 % 3];
            }
            let mut found = vec![];
            let _ = ground.visit_near(&bounds, |number| {
                found.push(number);
                ControlFlow::Continue(())
            });
            found.sort_unstable();
            let near = boxes.iter().filter(|(_, one)| one.overlaps(&bounds));
            assert_eq!(found, near.map(|one| one.0).collect::<Vec<_>>(), "{name} {bounds:?}");
            met += found.len();
            missed += boxes.len() - found.len();
            if !found.is_empty() {
                let mut count = 0;
                let ended = ground.visit_near(&bounds, |_| {
                    count += 1;
                    ControlFlow::Break(())
                });
                assert!(ended.is_break() && count == 1, "{name}: it was told to break off");
            }
        }
    }
    assert!(met > 10_000 && missed > 10_000, "{met} {missed}");
}

/// When a moving box meets another, by slab tests; `None` if it does not. `slack` is some rounding, up or down.
fn meets(one: &Aabb3, [from, along, grown]: [DVec3; 3], slack: f64) -> Option<f64> {
    let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
    for axis in 0..3 {
        let slack = slack
            * (from[axis].abs() + grown[axis] + f64::from(one.max[axis].abs().max(one.min[axis].abs())));
        let low = f64::from(one.min[axis]) - grown[axis] - slack - from[axis];
        let high = f64::from(one.max[axis]) + grown[axis] + slack - from[axis];
        if along[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
        } else {
            let [first, last] = [low / along[axis], high / along[axis]];
            (enter, leave) = (enter.max(first.min(last)), leave.min(first.max(last)));
        }
    }
    (enter <= leave).then_some(enter)
}

#[test]
fn what_is_in_the_way_is_what_a_loop_over_all_boxes_finds() {
    let (mut met, mut missed, mut late) = (0, 0, 0);
    for (name, shape) in shapes() {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let (boxes, mut dice) = (boxes(ground), Dice::new(12));
        for round in 0..150 {
            let ((from, size), (to, _)) = (somewhere(&mut dice, &shape), somewhere(&mut dice, &shape));
            let mut along = (to - from).as_dvec3() * [1.0, 1e-3, 1e9, 1e-60][round % 4];
            if round % 5 == 0 {
                // Along an axis, and within the plane of a side.
                along[round % 3] = 0.0;
                along[(round + 1) % 3] = -0.0;
            }
            let from =
                if round % 7 == 0 { boxes[dice.below(boxes.len() as u32) as usize].1.min } else { from };
            let from = from.as_dvec3() + if round % 11 == 0 { DVec3::X * 1e8 } else { DVec3::ZERO };
            let grown = if round % 2 == 0 { Vec3::ZERO } else { Vec3::new(0.02, 0.1, 0.05) * size };
            let limit = [f64::INFINITY, f64::from(to.x.abs()) / (1e-300 + along.length()), 0.0][round % 3];
            let mut found = vec![];
            ground.visit_along(from, along, grown, limit, |number| {
                found.push(number);
                limit
            });
            let asked = [from, along, grown.as_dvec3()];
            let mut sorted = found.clone();
            sorted.sort_unstable();
            sorted.windows(2).for_each(|two| assert!(two[0] < two[1], "{name}: handed over twice"));
            for (number, one) in &boxes {
                let is_found = sorted.binary_search(number).is_ok();
                let surely = meets(one, asked, 0.0).is_some_and(|enter| enter * (1.0 + 1e-12) <= limit);
                // Rounded to f32 once for the start, and thrice in between.
                let perhaps = meets(one, asked, 1e-6).is_some_and(|enter| enter * (1.0 - 1e-6) <= limit);
                assert!(!surely || is_found, "{name} {number}: lost, {asked:?} {limit}");
                assert!(!is_found || perhaps, "{name} {number}: far away, {asked:?} {limit}");
                met += usize::from(is_found);
                missed += usize::from(!is_found);
            }
            // The first box under any limit is also found with a limit that shrinks to it.
            let first =
                boxes.iter().filter_map(|(_, one)| meets(one, asked, 0.0)).fold(f64::INFINITY, f64::min);
            if first <= limit {
                let (mut best, mut seen) = (limit, 0);
                ground.visit_along(from, along, grown, limit, |number| {
                    seen += 1;
                    let enter = box_of(ground, number).and_then(|one| meets(&one, asked, 0.0));
                    best = enter.unwrap_or(best).min(best);
                    best
                });
                assert_eq!(best, first, "{name} {asked:?}");
                assert!(seen <= found.len());
                late += found.len() - seen;
            }
        }
    }
    assert!(met > 10_000 && missed > 10_000 && late > 5_000, "{met} {missed} {late}");
}

fn gap(one: &Aabb3, other: &Aabb3) -> f64 {
    let (below, above) =
        (one.min.as_dvec3() - other.max.as_dvec3(), other.min.as_dvec3() - one.max.as_dvec3());
    below.max(above).max(DVec3::ZERO).length()
}

#[test]
fn what_is_nearest_is_what_a_loop_over_all_boxes_finds() {
    let (mut met, mut missed, mut spared) = (0, 0, 0);
    for (name, shape) in shapes() {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let (boxes, mut dice) = (boxes(ground), Dice::new(13));
        for round in 0..100 {
            let (low, size) = somewhere(&mut dice, &shape);
            let bounds = Aabb3::new(low, low + size * [0.0, 0.02, 0.3][round % 3]);
            let limit = [f64::INFINITY, f64::from(size) * 0.3, 0.0][round / 3 % 3];
            let mut found = vec![];
            ground.visit_nearest(&bounds, limit, |number| {
                found.push(number);
                // Neither a greater limit nor NaN may change the limit.
                if round % 2 == 0 { f64::INFINITY } else { f64::NAN }
            });
            found.sort_unstable();
            found.windows(2).for_each(|two| assert!(two[0] < two[1], "{name}: handed over twice"));
            for (number, one) in &boxes {
                let is_found = found.binary_search(number).is_ok();
                let gap = gap(one, &bounds);
                if round % 2 == 0 {
                    assert!(gap > limit || is_found, "{name} {number}: lost at {gap} of {limit}");
                }
                assert!(
                    !is_found || gap * (1.0 - 1e-6) <= limit.max(1e-18),
                    "{name} {number}: {gap} of {limit}"
                );
                met += usize::from(is_found);
                missed += usize::from(!is_found);
            }
            let least = boxes.iter().map(|(_, one)| gap(one, &bounds)).fold(f64::INFINITY, f64::min);
            let (mut best, mut seen) = (f64::INFINITY, 0);
            ground.visit_nearest(&bounds, f64::INFINITY, |number| {
                seen += 1;
                best = box_of(ground, number).map_or(best, |one| gap(&one, &bounds)).min(best);
                best
            });
            assert_eq!(best, least, "{name} {bounds:?}");
            spared += boxes.len() - seen;
        }
    }
    assert!(met > 10_000 && missed > 10_000 && spared > 100_000, "{met} {missed} {spared}");
}

#[test]
fn questions_that_are_none_find_nothing() {
    for (name, shape) in shapes().into_iter().filter(|(name, _)| name == "rough" || name == "field 3") {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let never = |number: u32| -> f64 { panic!("{name}: {number} was handed over") };
        let (nan, center) = (f64::NAN, shape.center().as_dvec3());
        let wide = Vec3::splat(shape.outer_radius());
        for (from, along, grown, limit) in [
            (DVec3::splat(nan), DVec3::X, wide, 1.0),
            (center, DVec3::new(0.0, nan, 0.0), wide, 1.0),
            (center, DVec3::X * f64::INFINITY, wide, 1.0),
            (center, DVec3::X, -wide, 1.0),
            (center, DVec3::X, Vec3::NAN, 1.0),
            (center, DVec3::X, wide, nan),
            (center, DVec3::X, wide, -1.0),
        ] {
            ground.visit_along(from, along, grown, limit, never);
        }
        let here = Aabb3::new(shape.center() - wide, shape.center() + wide);
        for (bounds, limit) in [(here, nan), (here, -1.0), (Aabb3::new(here.max, here.min), 1e9)] {
            ground.visit_nearest(&bounds, limit, never);
        }
        // With direction zero, overlapping boxes are met at once.
        let mut count = 0;
        ground.visit_along(center, DVec3::ZERO, wide, 0.0, |_| {
            count += 1;
            0.0
        });
        assert!(count > 0, "{name}");
    }
}

#[test]
fn the_limit_ends_a_walk_at_once() {
    for (name, shape) in shapes() {
        let Some(ground) = Ground::of(&shape) else { panic!("{name}") };
        let wide = Vec3::splat(shape.outer_radius());
        let mut count = 0;
        ground.visit_nearest(&Aabb3::new(shape.center() - wide, shape.center() + wide), 1.0, |_| {
            count += 1;
            -1.0
        });
        ground.visit_along(shape.center().as_dvec3(), DVec3::X, wide, 1.0, |_| {
            count += 1;
            -1.0
        });
        assert_eq!(count, 2, "{name}");
    }
}
