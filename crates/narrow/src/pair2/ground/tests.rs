//! Queries about a chain take steps only for what is near, however long the chain is; points are in order all along it;
//! and where nothing overlaps, no point is deep.

use crate::counted::steps_of;
use crate::{Batch2, Hint, Job2, Manifold2, Pair2, cast_ray2, collide2};
use asunder_geometry::glam::Vec2;
use asunder_geometry::{Capsule2, Chain, Circle, HalfPlane, Pose2, Ray2, Rect, Rotation2, Shape2};

/// Hills of half-metre segments around x = 0, as many as asked for.
fn hills(count: i32) -> Shape2 {
    let height = |i: i32| [0.0, 0.125, 0.1875, 0.25, 0.125, 0.0625, 0.0, -0.125][i.rem_euclid(8) as usize];
    let vertices = (-count / 2..=count / 2).rev().map(|i| Vec2::new(i as f32 * 0.5, height(i)));
    Chain::open(vertices).unwrap().into()
}

#[test]
fn a_million_segments_cost_what_a_thousand_do() {
    let (short, long) = (hills(1_000), hills(1_000_000));
    let bodies: [Shape2; 4] = [
        Rect::from_half_extents(Vec2::new(1.0, 0.5)).unwrap().into(),
        Circle::new(0.5).unwrap().into(),
        Capsule2::from_half_height(0.5, 0.5).unwrap().into(),
        Rect::from_half_extents(Vec2::new(0.5, 0.25)).unwrap().rounded(0.25).unwrap().into(),
    ];
    for body in &bodies {
        for height in [0.4, 0.6, 1.5] {
            let pose = Pose2::at([3.3, height]).unwrap();
            let count = |ground: &Shape2| {
                let job = Job2 {
                    shape_a: ground,
                    pose_a: &Pose2::IDENTITY,
                    shape_b: body,
                    pose_b: &pose,
                    margin: 0.02,
                    hint: Hint::NONE,
                    ahead: 0.0,
                    sensor: false,
                };
                let mut batch = Batch2::default();
                let pair = Pair2::new(ground, &Pose2::IDENTITY, body, &pose);
                let contact = steps_of(|| collide2(&[job], &mut batch)).1;
                let overlap = steps_of(|| pair.overlaps()).1;
                let separation = steps_of(|| pair.separation(f32::INFINITY)).1;
                let cast = steps_of(|| pair.cast(Vec2::Y * 2.0)).1;
                [contact, overlap, separation, cast]
            };
            let (of_short, of_long) = (count(&short), count(&long));
            // Which four segments share a box depends on where the chain begins.
            for (short, long) in of_short.into_iter().zip(of_long) {
                assert!(long <= short + 8 && long < 200, "{body:?} {height}: {of_short:?} {of_long:?}");
            }
        }
    }
    let ray = Ray2::new([7.1, 30.0], Vec2::new(0.2, -1.0)).unwrap();
    let (hit, steps) = steps_of(|| cast_ray2(&long, &Pose2::IDENTITY, &ray, f64::INFINITY));
    assert!(hit.is_some() && steps < 40, "{steps}");
    // Against a half-plane below the whole chain, the depth is that of the lowest vertex, and few segments are visited.
    let pit: Shape2 = HalfPlane::new(Vec2::Y).unwrap().into();
    let lowest =
        Chain::open((0..100_000).map(|i| Vec2::new(i as f32, if i == 77_777 { -2.0 } else { 1.0 }))).unwrap();
    let lowest = Shape2::from(lowest);
    let pair = Pair2::new(&pit, &Pose2::IDENTITY, &lowest, &Pose2::IDENTITY);
    let (found, steps) = steps_of(|| pair.separation(f32::INFINITY));
    let crate::Separation2::Measured(found) = found else { panic!("without a limit") };
    assert!(found.separation == -2.0 && steps < 40, "{found:?} {steps}");
}

#[test]
fn where_a_closed_chain_comes_back_to_its_first_vertex_points_are_in_order_as_elsewhere() {
    let corners = [
        (-1.297_922_1e-4, -1.762_594_8e-4),
        (8.834_482e-5, -1.762_594_8e-4),
        (-4.213_126e-5, 4.976_397e-5),
        (-1.005_423_4e-4, -5.137_813e-5),
    ];
    let turned = Pose2::new([0.0, 0.0], Rotation2::new(0.983_723_3, 0.179_689_97).unwrap()).unwrap();
    let plank = Rect::from_half_extents(Vec2::new(0.101_131_156, 0.120_154_18)).unwrap();
    let plank = Shape2::from(plank.rounded(0.003_544_812).unwrap());
    let rotation = Rotation2::new(1.0, 4.437_033_6e-7).unwrap();
    let pose = Pose2::new([0.073_797_001_298_480_38, 0.057_728_919_841_969_525], rotation).unwrap();
    for first in 0..4 {
        let mut corners = corners.map(Vec2::from);
        corners.rotate_left(first);
        let island = Shape2::from(Chain::closed(corners).unwrap());
        for found in [
            Pair2::new(&island, &turned, &plank, &pose).manifolds(0.0),
            Pair2::new(&plank, &pose, &island, &turned).manifolds(0.0),
        ] {
            let is_in_order = |it: &Manifold2| it.points.is_sorted_by_key(|point| point.feature);
            assert!(found.len() == 2 && found.iter().all(|it| it.points.len() == 2), "{first}: {found:?}");
            assert!(found.iter().all(is_in_order), "{first}: {found:?}");
        }
    }
}

#[test]
fn what_an_uneven_run_is_not_touched_by_lies_in_none_of_its_faces() {
    // To and fro along one line: the segments differ from their run by rounding alone.
    let heights = [0.462_495_57, 0.630_679_3, 0.924_028_46, 0.508_104_56, 0.789_357_1];
    let wall = heights.map(|height| Vec2::new(0.600_275_5, height));
    let ground = Chain::open(wall.into_iter().chain([Vec2::new(0.265_088_74, 0.789_357_1)])).unwrap();
    let turned = Pose2::new([0.0, 0.0], Rotation2::new(0.0, 1.0).unwrap()).unwrap();
    // Past the end of the wall by less than that rounding, and behind its face.
    let ends = [Vec2::new(0.939_055_44, 0.402_789), Vec2::new(0.260_933_85, -0.372_778_24)];
    let rod = Shape2::from(Capsule2::new(ends[0], ends[1], 0.001_911_163_4).unwrap());
    let rotation = Rotation2::new(-0.642_431_2, -0.766_343_36).unwrap();
    let pose = Pose2::new([-0.569_277_857_243_340_3, 1.180_493_777_575_731_6], rotation).unwrap();
    for ground in [Shape2::from(ground.clone().one_sided()), Shape2::from(ground)] {
        for pair in [Pair2::new(&ground, &turned, &rod, &pose), Pair2::new(&rod, &pose, &ground, &turned)] {
            assert!(!pair.overlaps());
            for found in pair.manifolds(0.04) {
                let least = found.points.iter().map(|point| point.separation).fold(f32::INFINITY, f32::min);
                assert!(least >= -found.error, "{found:?}");
            }
        }
    }
}
