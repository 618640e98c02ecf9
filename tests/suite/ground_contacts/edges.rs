//! Which normals edges and corners of ground give: convex ones those between the adjacent faces' normals, flat and
//! concave ones none of their own; one-sided ground gives none from behind.

use super::scenes::{BODIES, Random, body, grid, mesh};
use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{Cuboid, HalfSpace, Pose3, Shape3, Sphere, TriMesh};
use asunder_narrow::{Feature, Manifold3, Pair3};

fn cuboid(x: f32, y: f32, z: f32) -> Shape3 {
    Cuboid::from_half_extents(Vec3::new(x, y, z)).unwrap().into()
}

fn at(x: f64, y: f64, z: f64) -> Pose3 {
    Pose3::at([x, y, z]).unwrap()
}

/// A profile in x and y, extruded along z in pieces; its front is to the left of its direction.
fn profile(points: &[[f32; 2]], pieces: usize) -> TriMesh {
    let count = points.len();
    let vertices: Vec<Vec3> = (0..=pieces)
        .flat_map(|piece| points.iter().map(move |&[x, y]| (x, y, piece)))
        .map(|(x, y, piece)| Vec3::new(x, y, 4.0 * piece as f32 / pieces as f32 - 2.0))
        .collect();
    let mut triangles = Vec::new();
    for piece in 0..pieces {
        for point in 0..count - 1 {
            let [a, b] = [piece * count + point, piece * count + point + 1].map(|i| i as u32);
            let [c, d] = [a + count as u32, b + count as u32];
            triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    mesh((vertices, triangles))
}

fn manifolds(body: &Shape3, pose: &Pose3, ground: &TriMesh, margin: f32) -> Vec<Manifold3> {
    Pair3::new(body, pose, &ground.clone().into(), &Pose3::IDENTITY).manifolds(margin)
}

/// Normals from the ground to the body, which is A.
fn normals(manifolds: &[Manifold3]) -> Vec<Vec3> {
    manifolds.iter().map(|manifold| -manifold.normal).collect()
}

fn assert_near(found: Vec3, expected: Vec3) {
    assert!((found - expected.normalize()).length() < 1e-5, "{found} and not {expected}");
}

#[test]
fn a_box_that_bridges_a_ridge_stands_on_its_edge() {
    for pieces in [1, 2, 7] {
        let roof = profile(&[[-2.0, -1.0], [0.0, 0.0], [2.0, -1.0]], pieces);
        for ground in [roof.clone(), roof.one_sided()] {
            let found = manifolds(&cuboid(0.8, 0.3, 0.5), &at(0.1, 0.29, 0.2), &ground, 0.0);
            assert_eq!(found.len(), 1, "{found:?}");
            assert_near(-found[0].normal, Vec3::Y);
            assert_eq!(found[0].points.len(), 2, "{pieces} pieces: {found:?}");
            for point in &found[0].points {
                assert!((point.separation + 0.01).abs() < 1e-6 && point.anchor_b.x.abs() < 1e-6);
                assert!((point.anchor_b.z - 0.2).abs() - 0.5 < 1e-6);
            }
        }
    }
}

#[test]
fn a_box_over_a_ridge_may_lean_between_both_roofs_and_no_further() {
    let roof = profile(&[[-2.0, -1.0], [0.0, 0.0], [2.0, -1.0]], 3);
    let limit = Vec3::new(1.0, 2.0, 0.0).normalize();
    for step in -20..=20_i32 {
        let tangent = f64::from(step) / 20.0;
        let pose =
            Pose3::new(DVec3::new(0.0, 0.32, 0.1), Quat::from_xyzw(0.0, 0.0, tangent as f32, 1.0)).unwrap();
        for (manifold, normal) in
            manifolds(&cuboid(0.8, 0.3, 0.5), &pose, &roof, 0.05).iter().map(|m| (m, -m.normal))
        {
            assert!(normal.y >= limit.y - 1e-5, "{tangent}: {normal} of {manifold:?}");
            assert!(normal.z.abs() < 1e-5, "{tangent}: {normal}");
        }
    }
}

#[test]
fn a_spike_under_a_box_pushes_along_the_face_of_the_box() {
    // A four-sided pyramid.
    let ring = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, z]| Vec3::new(x, -2.0, z));
    let vertices: Vec<Vec3> = ring.into_iter().chain([Vec3::new(0.1, 0.0, 0.1)]).collect();
    let spike = mesh((vertices, vec![[0, 4, 1], [1, 4, 2], [2, 4, 3], [3, 4, 0]]));
    for ground in [spike.clone(), spike.one_sided()] {
        let found = manifolds(&cuboid(0.5, 0.2, 0.5), &at(0.0, 0.19, 0.0), &ground, 0.0);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_near(-found[0].normal, Vec3::Y);
        assert_eq!(found[0].points.len(), 1);
        assert_eq!(found[0].points[0].feature.b(), Feature::Vertex(4));
        assert!((found[0].separation + 0.01).abs() < 1e-6);
        // A ball beside its tip touches the edge or the corner between the faces.
        let ball: Shape3 = Sphere::new(0.25).unwrap().into();
        let found = manifolds(&ball, &at(0.15, 0.235, 0.05), &ground, 0.0);
        assert_near(-found[0].normal, Vec3::new(0.05, 0.235, -0.05));
    }
}

#[test]
fn a_box_on_a_cliff_gets_no_push_from_the_inner_edges_of_the_top() {
    let cliff = profile(&[[-2.0, 0.0], [-1.0, 0.0], [0.0, 0.0], [0.0, -3.0]], 5);
    for ground in [cliff.clone(), cliff.one_sided()] {
        // The box stands across the rim.
        let found = manifolds(&cuboid(0.5, 0.3, 0.5), &at(-0.3, 0.295, 0.1), &ground, 0.0);
        assert_eq!(normals(&found), [Vec3::Y], "{found:?}");
        assert_eq!(found[0].points.len(), 4);
        let furthest = found[0].points.iter().map(|p| p.anchor_b.x).fold(f32::MIN, f32::max);
        assert!(furthest.abs() < 1e-6, "it rests up to the rim, not {furthest}");
        // It leans against the wall from outside: the top gives no contact.
        let found = manifolds(&cuboid(0.5, 0.3, 0.5), &at(0.495, -0.1, 0.1), &ground, 0.0);
        assert_eq!(normals(&found), [Vec3::X], "{found:?}");
        // A ball rolls over the rim: the normal turns from the top's to the wall's.
        let ball: Shape3 = Sphere::new(0.5).unwrap().into();
        let found = manifolds(&ball, &at(0.3, 0.395, 0.0), &ground, 0.0);
        assert_eq!(found.len(), 1);
        assert_near(-found[0].normal, Vec3::new(0.3, 0.395, 0.0));
        assert!(matches!(found[0].points[0].feature.b(), Feature::Edge(_)));
    }
}

#[test]
fn in_a_groove_and_in_a_corner_each_wall_pushes_along_its_own_normal() {
    let groove = profile(&[[-2.0, 2.0], [0.0, 0.0], [2.0, 2.0]], 3);
    let bottom = 0.5 * core::f64::consts::SQRT_2;
    let ball: Shape3 = Sphere::new(0.5).unwrap().into();
    let mut found = normals(&manifolds(&ball, &at(0.0, bottom - 0.01, 0.3), &groove, 0.0));
    found.sort_by(|a, b| a.x.total_cmp(&b.x));
    assert_eq!(found.len(), 2, "{found:?}");
    assert_near(found[0], Vec3::new(-1.0, 1.0, 0.0));
    assert_near(found[1], Vec3::new(1.0, 1.0, 0.0));
    // A box that stands on an edge.
    let turn = Quat::from_xyzw(0.0, 0.0, 0.414_213_56, 1.0);
    let pose = Pose3::new(DVec3::new(0.0, bottom - 0.01, 0.3), turn).unwrap();
    let mut found = normals(&manifolds(&cuboid(0.5, 0.5, 0.5), &pose, &groove, 0.0));
    found.sort_by(|a, b| a.x.total_cmp(&b.x));
    assert_eq!(found.len(), 2, "{found:?}");
    assert_near(found[0], Vec3::new(-1.0, 1.0, 0.0));
    assert_near(found[1], Vec3::new(1.0, 1.0, 0.0));
}

/// Three squares that face (1, 1, 1), each cut into `pieces` a side.
fn room(pieces: usize) -> TriMesh {
    let (vertices, triangles) = grid([pieces; 2], 2.0 / pieces as f32, |_, _| Vec3::ZERO);
    let mut all = (Vec::new(), Vec::new());
    for turn in 0..3 {
        let first = all.0.len() as u32;
        all.0.extend(vertices.iter().map(|v| {
            let [x, z] = [v.x + 1.0, v.z + 1.0];
            [Vec3::new(x, 0.0, z), Vec3::new(z, x, 0.0), Vec3::new(0.0, z, x)][turn]
        }));
        all.1.extend(triangles.iter().map(|corners| corners.map(|v| v + first)));
    }
    mesh(all)
}

#[test]
fn in_the_corner_of_a_room_there_are_three_manifolds() {
    for pieces in [1, 3] {
        for ground in [room(pieces), room(pieces).one_sided()] {
            for body in [cuboid(0.3, 0.3, 0.3), Sphere::new(0.3).unwrap().into()] {
                let mut found = manifolds(&body, &at(0.29, 0.28, 0.295), &ground, 0.0);
                found.sort_by(|a, b| a.separation.total_cmp(&b.separation));
                assert_eq!(normals(&found), [Vec3::Y, Vec3::X, Vec3::Z], "{pieces} pieces: {found:?}");
                for (manifold, depth) in found.iter().zip([0.02, 0.01, 0.005]) {
                    assert!((manifold.separation + depth).abs() <= manifold.error + 1e-7, "{manifold:?}");
                    let count = if matches!(body, Shape3::Sphere(_)) { 1 } else { 4 };
                    assert_eq!(manifold.points.len(), count);
                }
            }
        }
    }
}

#[test]
fn a_body_on_the_floor_slides_into_a_wall_by_the_walls_own_normal() {
    let ground = room(4);
    for kind in 0..6 {
        let body = body(kind);
        for step in 0..60 {
            let place = DVec3::new(1.0 - f64::from(step) * 0.01, 0.25, 1.0 - f64::from(step) * 0.007);
            for normal in normals(&manifolds(&body, &Pose3::at(place).unwrap(), &ground, 0.02)) {
                let is_a_walls = [Vec3::X, Vec3::Y, Vec3::Z].iter().any(|n| (*n - normal).length() < 1e-5);
                assert!(is_a_walls, "body {kind} at {place}: {normal}");
            }
        }
    }
}

#[test]
fn one_sided_ground_says_nothing_from_behind_and_two_sided_pushes_back() {
    let floor = mesh(grid([4, 4], 1.0, |_, _| Vec3::ZERO));
    for kind in 0..7 {
        let body = body(kind);
        let below = at(0.1, -0.1, 0.2);
        assert_eq!(manifolds(&body, &below, &floor.clone().one_sided(), 0.1), [], "body {kind}");
        let found = manifolds(&body, &below, &floor, 0.0);
        assert!(!found.is_empty());
        for normal in normals(&found) {
            assert_near(normal, Vec3::NEG_Y);
        }
        let shape = floor.clone().one_sided().into();
        let pair = Pair3::new(&body, &below, &shape, &Pose3::IDENTITY);
        assert!(pair.manifold(0.1).is_none());
    }
}

#[test]
fn through_a_thin_wall_a_body_is_pushed_to_the_side_of_its_centre() {
    let wall = profile(&[[0.0, -2.0], [0.0, 2.0]], 4);
    for x in [-0.2, -0.05, 0.05, 0.2] {
        for kind in [0, 1, 4] {
            let found = manifolds(&body(kind), &at(x, 0.1, 0.2), &wall, 0.0);
            assert_eq!(found.len(), 1);
            assert_near(-found[0].normal, Vec3::X * x.signum() as f32);
        }
    }
}

#[test]
fn a_half_space_touches_the_corners_of_ground_that_reach_furthest_into_it() {
    let half_space: Shape3 = HalfSpace::new(Vec3::Y).unwrap().into();
    let bumps = mesh(grid([6, 6], 1.0, |x, z| Vec3::Y * (((x * 5 + z * 3) % 7) as f32 * 0.1)));
    let pose = at(0.0, 0.05, 0.0);
    let found = manifolds(&half_space, &pose, &bumps, 0.0);
    assert_eq!(normals(&found), [Vec3::NEG_Y]);
    assert_eq!(found[0].points.len(), 4);
    assert!((found[0].separation + 0.05).abs() < 1e-6);
    assert!(found[0].points.iter().all(|point| matches!(point.feature.b(), Feature::Vertex(_))));
    assert_eq!(manifolds(&half_space, &at(0.0, -0.05, 0.0), &bumps, 0.0), []);
}

#[test]
fn one_sided_ground_sees_a_half_space_by_its_direction_wherever_its_position_is() {
    let rim = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]].map(|[x, z]| Vec3::new(x, -1.0, z));
    let vertices = [&[Vec3::ZERO], &rim[..]].concat();
    let pyramid = mesh((vertices, vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])).one_sided();
    let from_above: Shape3 = HalfSpace::new(Vec3::NEG_Y).unwrap().into();
    let from_below: Shape3 = HalfSpace::new(Vec3::Y).unwrap().into();
    let ground: Shape3 = pyramid.clone().into();
    for x in [0.0, 0.05, 0.5, 1.0, 50.0, 1e6] {
        for depth in [0.0, 1e-6, 0.1, 3.0] {
            let found = manifolds(&from_above, &at(x, -depth, -0.5 * x), &pyramid, 0.0);
            assert_eq!(normals(&found), [Vec3::Y], "{depth} deep, position at {x}");
            assert!((f64::from(found[0].separation) + depth).abs() < 1e-6);
            assert_eq!(manifolds(&from_below, &at(x, depth, x), &pyramid, 0.0), [], "{depth} from {x}");
        }
        let cast = |from: f64, by: f32| {
            let pose = at(x, from, -0.5 * x);
            Pair3::new(&from_above, &pose, &ground, &Pose3::IDENTITY).cast(Vec3::Y * by).map(|it| it.fraction)
        };
        assert_eq!(cast(-0.25, 0.0), Some(0.0), "touching at {x}");
        assert!((cast(1.0, -2.0).unwrap() - 0.5).abs() < 1e-6, "falling at {x}");
    }
}

/// A wall perpendicular to a half-space's plane collides from either side, turned or not, in casts as well.
#[test]
fn a_one_sided_wall_is_seen_by_a_half_space_that_it_stands_square_to() {
    let wall = mesh((vec![Vec3::ZERO, Vec3::Y, Vec3::Z], vec![[0, 1, 2]])).one_sided();
    let (ground, below): (Shape3, Shape3) = (wall.into(), HalfSpace::new(Vec3::Y).unwrap().into());
    for turn in
        [Quat::IDENTITY, Quat::from_xyzw(0.16, 0.27, 0.38, 0.85), Quat::from_xyzw(0.7, -0.1, 0.2, 0.3)]
    {
        let under = Pose3::new([0.0; 3], turn).unwrap();
        for x in [-1e3, -1.0, 0.0, 1.0, 1e3] {
            let pose = Pose3::new(under.turn(DVec3::new(x, 0.5, 0.0)), turn).unwrap();
            let pair = Pair3::new(&below, &pose, &ground, &under);
            assert_eq!(pair.manifolds(0.0).len(), 1, "position at {x}");
            assert_eq!(pair.cast(Vec3::ZERO).map(|impact| impact.fraction), Some(0.0), "position at {x}");
        }
    }
}

/// Symptom: a plank over the edge of a step, turned by a few ten-thousandths and a millimetre deep in the tread, was to
/// be pushed half a metre sideways, out of the riser. Cause: the tread's normal was rejected as its axis, so the tread
/// was not considered when testing whether a lift also frees the plank from the riser; and that test used the plank's
/// lowest corner, which lay beside all ground.
#[test]
fn a_plank_over_the_edge_of_a_step_is_lifted_off() {
    let step = profile(&[[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]], 2);
    let plank = cuboid(1.0, 0.05, 2.5);
    let small = |axis: Vec3, angle: f32| Quat::from_xyzw(axis.x, axis.y, axis.z, 2.0 / angle);
    let mut sunk = 0;
    for ground in [step.clone(), step.one_sided()] {
        let solid = Shape3::from(ground.clone());
        for lean in [1e-5, 5e-5, 1e-4, 1.1e-4, 1.2e-4, 1.5e-4, 2e-4, 3e-4, 1e-3] {
            for (roll, yaw) in [(2e-5, 0.0), (-2e-5, 3e-5), (1e-9, 3e-5), (1e-4, 1e-4)] {
                let turn =
                    small(Vec3::NEG_Z, lean) * small(Vec3::X, roll) * Quat::from_xyzw(0.0, yaw, 0.0, 1.0);
                for (along, depth) in
                    [-0.6, -0.3, 0.3].into_iter().flat_map(|x| [2e-5, 1e-4, 1e-3].map(|depth| (x, depth)))
                {
                    let pose = |height: f64| Pose3::new([along, height, 0.0], turn).unwrap();
                    let above = pose(2.0);
                    // Depths are relative to what the plank hits first on its way down: a lift by more than that frees
                    // it.
                    let cast = Pair3::new(&plank, &above, &solid, &Pose3::IDENTITY).cast(Vec3::NEG_Y);
                    let on = 2.0 - cast.unwrap().fraction;
                    for manifold in manifolds(&plank, &pose(on - depth), &ground, 0.01) {
                        let told = f64::from(manifold.separation);
                        assert!(told > -1.5 * depth - 1e-6, "{lean} {roll} {along} {depth}: {manifold:?}");
                        sunk += usize::from(told < 0.0);
                    }
                }
            }
        }
    }
    assert!(sunk > 600, "{sunk}");
}

#[test]
fn a_riser_is_not_told_from_inside_the_step() {
    let stairs = profile(&[[-1.0, 0.8], [0.0, 0.8], [0.0, 0.4], [0.5, 0.4], [0.5, 0.0], [2.0, 0.0]], 3);
    let mut random = Random::new(128);
    let mut told = 0;
    for round in 0..6000 {
        let half = [0; 3].map(|_| random.between(0.05, 0.2) as f32);
        let shape = match round % 3 {
            0 => cuboid(half[0], half[1], half[2]),
            1 => Cuboid::from_half_extents(Vec3::from(half)).unwrap().rounded(0.02).unwrap().into(),
            _ => body(round / 3 % BODIES),
        };
        let lean = random.vector() * [1e-6, 1e-3, 0.01][round % 3];
        let turn = Quat::from_xyzw(lean.x as f32, lean.y as f32, lean.z as f32, 1.0);
        let place = |height: f64, x: f64| Pose3::new([x, height, 0.3], turn).unwrap();
        // On either tread, up to its edge.
        let (level, from, to) = [(0.8, -0.9, 0.0), (0.4, 0.0, 0.5)][round % 2];
        let bounds = shape.bounds(&place(0.0, 0.0), 0.0);
        let x = random.between(from - f64::from(bounds.min.x), to - f64::from(bounds.max.x));
        if bounds.max.x - bounds.min.x > (to - from) as f32 {
            continue;
        }
        let depth = [1e-5, 1e-4, 1e-3][round / 2 % 3];
        let pose = place(level - f64::from(bounds.min.y) - depth, x);
        for manifold in manifolds(&shape, &pose, &stairs, [0.02, 0.1, 0.3][round % 3]) {
            assert!(-manifold.normal.x > -0.05, "{shape:?} at {pose:?}: {manifold:?}");
            told += 1;
        }
    }
    assert!(told > 4000, "{told}");
}
