//! The same on ground that nobody would walk on.

use super::{Stand, bodies, check_heights, moved};
use asunder_geometry::{Ground, Pose3, Shape3, TriMesh};
use asunder_narrow::{Feature, Manifold3, Pair3};
use asunder_scenes::random::Random;
use glam::{DVec3, Quat, Vec3};

/// On spikes and knives, deep and shallow, two-sided or one-sided: the overlap decision is certain, and corners are at
/// the reported heights.
#[test]
fn what_is_moved_along_on_spikes_overlaps_or_not_for_certain() {
    let mut random = Random::new(92);
    let (mut carried, mut overlapping, mut of_fronts, mut on_corners) = (0, 0, 0, 0);
    for round in 0..40 {
        // A grid of half metres with random heights; every other one folds back over itself.
        let place = |i: u32| f64::from(i) * 0.5;
        let vertices: Vec<Vec3> = (0..8_u32)
            .flat_map(|z| (0..8_u32).map(move |x| (x, z)))
            .map(|(x, z)| {
                let aside = if round % 2 == 0 { 0.05 } else { 0.6 };
                let by = DVec3::new(
                    random.range(-aside, aside),
                    random.range(-0.4, 0.4),
                    random.range(-aside, aside),
                );
                (DVec3::new(place(x), 0.0, place(z)) + by).as_vec3()
            })
            .collect();
        let corner = |x: u32, z: u32| z * 8 + x;
        let triangles: Vec<[u32; 3]> = (0..7)
            .flat_map(|z| (0..7).map(move |x| (x, z)))
            .flat_map(|(x, z)| {
                let [a, b, c, d] = [corner(x, z), corner(x, z + 1), corner(x + 1, z), corner(x + 1, z + 1)];
                [[a, b, c], [c, b, d]]
            })
            .collect();
        let mesh = TriMesh::new(vertices, triangles).unwrap();
        let is_front_alone = round % 4 > 1;
        let ground = Shape3::from(if is_front_alone { mesh.one_sided() } else { mesh });
        for number in 0..60 {
            let body = bodies(&mut random)[number % 5].clone();
            let any = random.direction();
            let rotation = Quat::from_xyzw(any.x as f32, any.y as f32, any.z as f32, 0.7).normalize();
            let above = DVec3::new(random.range(0.5, 3.0), 2.0, random.range(0.5, 3.0));
            let start = Pose3::new(above, rotation).unwrap();
            let hit = Pair3::new(&body, &start, &ground, &Pose3::IDENTITY).cast(Vec3::NEG_Y * 4.0);
            let Some(hit) = hit else { continue };
            let depth = [-1e-4, 1e-5, 1e-3, 0.1, 0.38][number / 5 % 5];
            let pose = Pose3::new(above + DVec3::NEG_Y * (4.0 * hit.fraction + depth), rotation).unwrap();
            let is_turned = number % 2 == 0;
            let stand = Stand { body, pose, ground: ground.clone(), field: Pose3::IDENTITY, is_turned };
            let (.., Some(kept)) = stand.made(&pose) else { continue };
            for way in 0..8 {
                let far = f64::from(kept.reach()) * if way < 4 { 0.99 } else { random.range(0.0, 1.0) };
                let now = moved(&pose, random.direction() * far, DVec3::ZERO);
                let Some(found) = stand.carried(&kept, &now) else { continue };
                let story = format!("{round} {number} {way}");
                let overlaps = Pair3::new(&stand.body, &now, &ground, &Pose3::IDENTITY).overlaps();
                assert_eq!(kept.overlapping(), overlaps, "{story}: {found:?}");
                found.iter().for_each(|manifold| check_heights(&stand, &now, manifold, &story));
                check_ball(&stand, &now, &found, &story);
                carried += 1;
                overlapping += usize::from(overlaps);
                of_fronts += usize::from(overlaps && is_front_alone);
                on_corners += usize::from(found.iter().flat_map(|manifold| &manifold.points).any(|point| {
                    !matches!(point.feature.a(), Feature::Face(_))
                        && !matches!(point.feature.b(), Feature::Face(_))
                }));
            }
        }
    }
    assert!(carried > 4000 && overlapping > 2000, "{carried} {overlapping}");
    assert!(of_fronts > 500 && on_corners > 500, "{of_fronts} {on_corners}");
}

/// Asserts that a ball beside an edge or a corner of ground is at the reported distance, up to the error.
fn check_ball(stand: &Stand, now: &Pose3, found: &[Manifold3], story: &str) {
    let Shape3::Sphere(sphere) = &stand.body else { return };
    let ground = Ground::of(&stand.ground).unwrap();
    let center = stand.field.transform_back(now.position());
    for manifold in found {
        let point = &manifold.points[0];
        let of_ground = if stand.is_turned { point.feature.a() } else { point.feature.b() };
        let distance = match of_ground {
            Feature::Vertex(vertex) => (0..ground.triangle_count()).find_map(|triangle| {
                let corner = ground.vertex_numbers(triangle).iter().position(|&number| number == vertex)?;
                Some((ground.corners(triangle)[corner].as_dvec3() - center).length())
            }),
            Feature::Edge(edge) => {
                let corners = ground.corners(edge / 3);
                let (from, to) = (corners[edge as usize % 3], corners[(edge as usize + 1) % 3]);
                let (from, to) = (from.as_dvec3(), to.as_dvec3());
                Some((to - from).normalize().cross(center - from).length())
            }
            Feature::Face(_) => None,
        };
        let Some(distance) = distance else { continue };
        let off = (distance - f64::from(sphere.radius()) - f64::from(point.separation)).abs();
        assert!(
            off <= f64::from(manifold.error) + 1e-6 * stand.size(),
            "{story}: off by {off}, {manifold:?}"
        );
    }
}
