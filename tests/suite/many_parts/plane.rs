//! The same in the plane.

use asunder_geometry::glam::{DVec2, DVec3, Vec2};
use asunder_geometry::{
    Aabb2, Capsule2, Circle, Compound2, HalfPlane, Motion2, Polygon, Pose2, Ray2, Rect, Rotation2, Shape2,
};
use asunder_narrow::{Impact2, Manifold2, Pair2, Separation2, cast_ray2};
use asunder_scenes::random::Random;
use core::ops::ControlFlow;

/// Parts of a small compound.
const FEW: usize = 7;

fn direction(random: &mut Random) -> DVec2 {
    loop {
        if let Some(unit) = random.direction().truncate().try_normalize() {
            break unit;
        }
    }
}

fn rotation(random: &mut Random) -> Rotation2 {
    let unit = direction(random).as_vec2();
    Rotation2::new(unit.x, unit.y).unwrap()
}

fn part(random: &mut Random) -> Shape2 {
    let kind = random.below(4);
    let mut half = || random.range(0.05, 0.6) as f32;
    match kind {
        0 => Circle::new(random.range(0.1, 0.6) as f32).unwrap().into(),
        1 => Rect::from_half_extents(Vec2::new(half(), half())).unwrap().into(),
        2 => Capsule2::new(Vec2::new(half(), 0.0), Vec2::new(-half(), half()), 0.2).unwrap().into(),
        _ => loop {
            let points: Vec<Vec2> = (0..7).map(|_| (direction(random) * 0.5).as_vec2()).collect();
            if let Ok(polygon) = Polygon::hull_of(&points) {
                break polygon.into();
            }
        },
    }
}

fn anywhere(random: &mut Random, reach: f64) -> DVec2 {
    random.within(DVec3::splat(-reach), DVec3::splat(reach)).truncate()
}

/// `count` parts at random poses within `reach`.
fn parts(random: &mut Random, count: usize, reach: f64) -> Vec<(Pose2, Shape2)> {
    let mut place = || {
        let rotation = if random.below(3) == 0 { Rotation2::IDENTITY } else { rotation(random) };
        (Pose2::new(anywhere(random, reach), rotation).unwrap(), part(random))
    };
    (0..count).map(|_| place()).collect()
}

/// A body, and the same body in pieces, each with the number of its first part.
struct Body {
    whole: Shape2,
    pieces: Vec<(u32, Shape2)>,
    pose: Pose2,
}

fn body(parts: &[(Pose2, Shape2)], pose: Pose2) -> Body {
    let compound = |parts: &[(Pose2, Shape2)]| Shape2::from(Compound2::new(parts.iter().cloned()).unwrap());
    let pieces = (0..).step_by(FEW).zip(parts.chunks(FEW).map(compound)).collect();
    Body { whole: compound(parts), pieces, pose }
}

fn alone(shape: Shape2, pose: Pose2) -> Body {
    Body { whole: shape.clone(), pieces: vec![(0, shape)], pose }
}

/// Two bodies in either order, one of which has many parts.
fn bodies(random: &mut Random) -> [Body; 2] {
    let count = 32 + random.below(60);
    let far = [DVec2::ZERO, DVec2::new(1e5, -3e4)][random.below(2)];
    let many = parts(random, count, 3.0);
    let one = body(&many, Pose2::new(far, rotation(random)).unwrap());
    let at = far + direction(random) * random.range(0.0, 12.0);
    let pose = Pose2::new(at, rotation(random)).unwrap();
    let other = match random.below(5) {
        0 => {
            let count = 32 + random.below(40);
            body(&parts(random, count, 2.0), pose)
        }
        1 => {
            let count = 1 + random.below(12);
            body(&parts(random, count, 2.0), pose)
        }
        2 => alone(HalfPlane::new(direction(random).as_vec2()).unwrap().into(), pose),
        _ => alone(part(random), pose),
    };
    if random.below(2) == 0 { [one, other] } else { [other, one] }
}

/// Collects a result for each pair of the two bodies' pieces.
fn piecewise<T>([a, b]: &[Body; 2], mut ask: impl FnMut(&Pair2, [u32; 2]) -> T) -> Vec<T> {
    let mut all = vec![];
    for (from_a, piece_a) in &a.pieces {
        for (from_b, piece_b) in &b.pieces {
            all.push(ask(&Pair2::new(piece_a, &a.pose, piece_b, &b.pose), [*from_a, *from_b]));
        }
    }
    all
}

fn measured(separation: Separation2) -> Option<(f64, f64)> {
    match separation {
        Separation2::Measured(measured) => Some((measured.separation.into(), measured.error.into())),
        Separation2::AtLeast(_) => None,
    }
}

#[test]
fn a_tree_of_parts_leaves_out_nothing_that_counts() {
    let mut random = Random::new(8500);
    let (mut touching, mut apart, mut met) = (0, 0, 0);
    for round in 0..1500 {
        let both = bodies(&mut random);
        let [a, b] = &both;
        let pair = Pair2::new(&a.whole, &a.pose, &b.whole, &b.pose);
        let overlaps = piecewise(&both, |pair, _| pair.overlaps()).contains(&true);
        assert_eq!(pair.overlaps(), overlaps, "{round}");

        // The least of all pieces' separations; with a limit, that or a bound.
        let all = piecewise(&both, |pair, _| measured(pair.separation(f32::INFINITY)).unwrap());
        let least = all.iter().fold(f64::INFINITY, |least, (separation, _)| least.min(*separation));
        let (separation, error) = measured(pair.separation(f32::INFINITY)).unwrap();
        let largest = all.iter().fold(0.0, |largest: f64, (_, error)| largest.max(*error));
        assert!((separation - least).abs() <= error + largest, "{round}: {separation} for {least}");
        assert!(error <= 2.0 * largest + 1e-12, "{round}: {error} for {largest}");
        let limit = random.range(0.0, 4.0) as f32;
        match pair.separation(limit) {
            Separation2::Measured(found) => {
                assert!((f64::from(found.separation) - least).abs() <= error + largest)
            }
            Separation2::AtLeast(bound) => {
                assert!(f64::from(bound) <= least + largest && least > f64::from(limit) - largest, "{round}");
            }
        }
        if let Some(closest) = pair.distance() {
            assert!(
                !overlaps && (closest.distance - separation as f32).abs() <= closest.error + error as f32
            );
            apart += 1;
        }

        // All manifolds, in order, bit for bit.
        let margin = [0.0, 0.05, 0.5][round % 3];
        let mut expected: Vec<Manifold2> = vec![];
        piecewise(&both, |pair, [from_a, from_b]| {
            expected.extend(pair.manifolds(margin).into_iter().map(|mut manifold| {
                (manifold.part_a, manifold.part_b) = (manifold.part_a + from_a, manifold.part_b + from_b);
                manifold
            }));
        });
        expected.sort_by_key(|manifold| (manifold.part_a, manifold.part_b));
        let found = pair.manifolds(margin);
        assert_eq!(found.len(), expected.len(), "{round}");
        for (found, expected) in found.iter().zip(&expected) {
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{round}");
        }
        touching += usize::from(!found.is_empty());
        met += check_motions(&mut random, &both, round);
    }
    assert!(touching > 300 && apart > 300 && met > 300, "{touching} {apart} {met}");
}

/// Casts and impacts of whole bodies come at the first time of all pieces'. Returns how many hit.
fn check_motions(random: &mut Random, both: &[Body; 2], round: usize) -> usize {
    let [a, b] = both;
    let pair = Pair2::new(&a.whole, &a.pose, &b.whole, &b.pose);
    let towards = (b.pose.position() - a.pose.position()) * random.range(0.2, 1.5);
    let drift = towards + anywhere(random, 2.0);
    let mut motion = || {
        let far = random.below(2) == 0;
        let turned = if far { rotation(random) } else { Rotation2::from_angle(0.03).unwrap() };
        Motion2::new(DVec2::ZERO, turned).unwrap()
    };
    let still = Motion2::STILL;
    let turning = [motion(), motion()];
    let slide = Motion2::shift(drift).unwrap();
    let turned = Motion2::new(drift, turning[0].rotation().unwrap()).unwrap();
    let beside = Motion2::new(-drift * 0.5, turning[1].rotation().unwrap()).unwrap();
    let mut met = 0;
    for motions in [
        [&slide, &still],
        [&turning[0], &still],
        [&still, &slide],
        [&turned, &still],
        [&slide, &turning[1]],
        [&turned, &beside],
    ] {
        let expected: Vec<Impact2> =
            piecewise(both, |pair, _| pair.impact(motions[0], motions[1])).into_iter().flatten().collect();
        let first = expected.iter().fold(f64::INFINITY, |first, impact| first.min(impact.fraction));
        let found = pair.impact(motions[0], motions[1]);
        let overlap = expected.iter().any(|impact| impact.overlapping);
        assert_eq!(found.is_some_and(|found| found.overlapping), overlap, "{round}");
        let at = found.map_or(f64::INFINITY, |found| found.fraction);
        // A search ends within 1e-6 of the size; where exactly depends on how far it has to search.
        assert!(at == first || (at - first).abs() < 3e-6, "{round}: {at} for {first}");
        met += usize::from(found.is_some_and(|found| !found.overlapping));
    }
    met
}

#[test]
fn rays_meet_the_first_of_many_parts() {
    let mut random = Random::new(8600);
    let (mut hits, mut inside) = (0, 0);
    for round in 0..400 {
        let count = 32 + random.below(100);
        let far = [DVec2::ZERO, DVec2::new(-4e5, 7.0)][round % 2];
        let body = body(&parts(&mut random, count, 3.0), Pose2::new(far, rotation(&mut random)).unwrap());
        for _ in 0..20 {
            let from = far + anywhere(&mut random, 6.0);
            let towards = far + anywhere(&mut random, 3.0) - from;
            let way = towards * random.range(0.1, 2.0);
            let ray = Ray2::new(from, way.as_vec2()).unwrap();
            let limit = [f64::INFINITY, 1.0][random.below(2)];
            let each = body.pieces.iter().filter_map(|(first, piece)| {
                let hit = cast_ray2(piece, &body.pose, &ray, limit)?;
                Some((
                    hit.distance,
                    hit.part + first,
                    format!("{:?} {} {}", hit.normal, hit.error, hit.inside),
                ))
            });
            let expected = each.min_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
            let found = cast_ray2(&body.whole, &body.pose, &ray, limit);
            inside += usize::from(found.is_some_and(|hit| hit.inside));
            hits += usize::from(found.is_some());
            let told = |hit: asunder_narrow::RayHit2| {
                (hit.distance, hit.part, format!("{:?} {} {}", hit.normal, hit.error, hit.inside))
            };
            assert_eq!(found.map(told), expected, "{round}");
        }
    }
    assert!(hits > 2000 && inside > 50, "{hits} {inside}");
}

#[test]
fn walks_over_parts_find_what_a_loop_over_their_boxes_finds() {
    let mut random = Random::new(8700);
    for round in 0..200 {
        let parts = parts(&mut random, 1 + round, 4.0);
        let compound = Compound2::new(parts.iter().cloned()).unwrap();
        let boxes: Vec<Aabb2> = parts.iter().map(|(pose, shape)| shape.bounds(pose, 0.0)).collect();
        let low = anywhere(&mut random, 5.0).as_vec2();
        let bounds = Aabb2::new(low, low + Vec2::splat([0.0, 0.3, 3.0][round % 3]));
        let (mut near, mut far) = (vec![], vec![]);
        let _ = compound.visit_near(&bounds, |part| {
            near.push(part);
            ControlFlow::Continue(())
        });
        near.sort_unstable();
        let meets = |part: &u32| boxes[*part as usize].overlaps(&bounds);
        let expected: Vec<u32> = (0..parts.len() as u32).filter(meets).collect();
        assert_eq!(near, expected, "{round}");
        compound.visit_nearest(&bounds, f64::INFINITY, |part| {
            far.push(part);
            f64::INFINITY
        });
        let gap = |part: u32| {
            let one = &boxes[part as usize];
            (one.min - bounds.max).max(bounds.min - one.max).max(Vec2::ZERO).length()
        };
        far.sort_unstable();
        assert_eq!(far, (0..parts.len() as u32).collect::<Vec<_>>(), "{round}");
        // All parts that are as near as the nearest, and none that is much further.
        let least = far.iter().map(|&part| gap(part)).fold(f32::INFINITY, f32::min);
        let mut nearest = vec![];
        compound.visit_nearest(&bounds, least.into(), |part| {
            nearest.push(part);
            least.into()
        });
        assert!(nearest.iter().any(|&part| gap(part) == least), "{round}");
        assert!(nearest.iter().all(|&part| gap(part) <= least * 1.000_01 + 1e-12), "{round}");
    }
}

/// Skipped parts reach no further than those that are tested, bit for bit.
#[test]
fn the_box_around_many_parts_is_that_around_them_one_by_one() {
    let mut random = Random::new(0xB0C6);
    let square: Shape2 = Rect::from_half_extents(Vec2::splat(0.25)).unwrap().into();
    let cell = |i: u32| Pose2::at([i % 16, i / 16].map(|i| 0.5 * f64::from(i) - 4.0)).unwrap();
    let grid: Vec<(Pose2, Shape2)> = (0..256).map(|i| (cell(i), square.clone())).collect();
    let mut scenes = vec![grid.clone(), parts(&mut random, 16, 1e-3), parts(&mut random, 40, 5e5)];
    scenes.extend((0..30).map(|i| parts(&mut random, 16 + 40 * i, 6.0)));
    // Many parts that reach nearly equally far.
    let ball: Shape2 = Circle::new(0.25).unwrap().into();
    for jitter in [1e-7, 1e-6, 1e-5, 1e-4, 1e-3].repeat(40) {
        let near = |at: &Pose2, random: &mut Random| {
            (Pose2::at(at.position() + anywhere(random, jitter)).unwrap(), ball.clone())
        };
        scenes.push(grid.iter().map(|(at, _)| near(at, &mut random)).collect());
    }
    for scene in scenes {
        let body = body(&scene, Pose2::IDENTITY);
        for far in [0.0, 1.0, 1e3, 1e6, 9e8] {
            let turn = match random.below(3) {
                0 => Rotation2::IDENTITY,
                1 => Rotation2::from_angle(random.range(-1e-7, 1e-7) as f32).unwrap(),
                _ => rotation(&mut random),
            };
            let pose = Pose2::new(anywhere(&mut random, far), turn).unwrap();
            for margin in [0.0, 0.02, 1e3, -0.1, f32::INFINITY] {
                let one_by_one = body.pieces.iter().map(|(_, piece)| piece.bounds(&pose, margin));
                let expected = one_by_one.reduce(|all, piece| all.union(&piece)).unwrap();
                assert_eq!(body.whole.bounds(&pose, margin), expected, "{} at {pose:?}", scene.len());
            }
        }
    }
}

#[test]
fn a_point_is_held_by_any_part() {
    let mut random = Random::new(34);
    let (mut held, mut free) = (0, 0);
    for count in [2, FEW, 17, 60, 400] {
        for far in [0.0, 3e4] {
            let mut parts = parts(&mut random, count, (count as f64).sqrt());
            for (pose, _) in &mut parts {
                *pose = pose.shifted([far, 0.0]).unwrap();
            }
            let compound = Compound2::new(parts.iter().cloned()).unwrap();
            // Of a part alone, `shapes::extents` compares it with overlap tests.
            let alone: Vec<Compound2> =
                parts.iter().map(|part| Compound2::new([part.clone()]).unwrap()).collect();
            for round in 0..1000 {
                let (pose, shape) = &parts[round % parts.len()];
                let way = direction(&mut random);
                // On the surface of a part, beside it, or anywhere.
                let point = match round % 3 {
                    0 => pose.transform(shape.support(way).unwrap()),
                    1 => pose.transform(shape.support(way).unwrap() * random.range(0.8, 1.2)),
                    _ => DVec2::X * far + anywhere(&mut random, 1.2 * (count as f64).sqrt()),
                };
                let expected = alone.iter().any(|part| part.contains(point));
                assert_eq!(compound.contains(point), expected, "{point} in {count} parts");
                held += u32::from(expected);
                free += u32::from(!expected);
            }
            assert!(!compound.contains(DVec2::NAN) && !compound.contains(DVec2::INFINITY));
        }
    }
    assert!(held > 3000 && free > 1500, "{held} held, {free} free");
}
