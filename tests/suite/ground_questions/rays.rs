//! Rays over ground.

use super::{beside, level, mesh, sheet, triangles};
use asunder_geometry::glam::{DVec3, Vec3};
use asunder_geometry::{Ground, Pose3, Ray3, Shape3, TriMesh};
use asunder_narrow::{RayHit3, cast_ray3};
use asunder_tests::cases::Random;

/// The nearest hit over all triangles; of equal ones, the lowest number.
fn slowly(ground: &Shape3, at: &Pose3, ray: &Ray3, limit: f64) -> Option<RayHit3> {
    let is_one_sided = Ground::of(ground).is_some_and(Ground::is_one_sided);
    let mut first: Option<RayHit3> = None;
    for (number, triangle) in triangles(ground) {
        let Shape3::Triangle(flat) = &triangle else { unreachable!() };
        if is_one_sided && at.turn(flat.normals()[0]).dot(ray.direction().as_dvec3()) > 0.0 {
            continue;
        }
        if let Some(hit) = cast_ray3(&triangle, at, ray, limit)
            && first.is_none_or(|known| hit.distance < known.distance)
        {
            first = Some(RayHit3 { part: number, ..hit });
        }
    }
    first
}

fn one_sided(ground: &Shape3) -> Shape3 {
    match ground.clone() {
        Shape3::TriMesh(mesh) => mesh.one_sided().into(),
        Shape3::HeightField(field) => field.one_sided().into(),
        other => other,
    }
}

/// Counts of hits and misses, and of hits that differ in some bit from those of the triangles one by one.
#[derive(Default)]
struct Tally {
    hits: usize,
    misses: usize,
    differ: usize,
}

impl Tally {
    /// Casts against ground, and against all of its triangles one by one. Both give the same bits, since the triangle
    /// that is hit computes its answer alone; except for ties, within this many errors.
    fn check(&mut self, (ground, at): (&Shape3, &Pose3), ray: &Ray3, limit: f64, errors: f64) {
        for ground in [ground, &one_sided(ground)] {
            let (found, slow) = (cast_ray3(ground, at, ray, limit), slowly(ground, at, ray, limit));
            self.hits += usize::from(slow.is_some());
            self.misses += usize::from(slow.is_none());
            if found != slow {
                self.differ += 1;
                let (found, slow) = (found.unwrap(), slow.unwrap());
                let pace = f64::from(ray.direction().length());
                let slack = (found.error + slow.error) as f64 * errors;
                assert!(
                    (found.distance - slow.distance).abs() * pace <= slack,
                    "{ray:?}: {found:?} {slow:?}"
                );
            }
        }
    }
}

#[test]
fn a_ray_meets_the_nearest_of_all_triangles() {
    let mut tally = Tally::default();
    for seed in 0..3000 {
        let mut random = Random::new(seed as u128);
        let (ground, at) = level(&mut random, seed);
        let away = random.pick(&[0.0, 0.1, 1.0, 4.0, 1e3]);
        let from = beside(&mut random, (&ground, &at), away);
        let direction = match random.below(3) {
            0 => random.direction(),
            _ => beside(&mut random, (&ground, &at), 0.1) - from,
        };
        let direction = direction * random.pick(&[1e-3, 1.0, 1.0, 1e4]);
        let ray = Ray3::new(from, direction.as_vec3()).unwrap();
        let limit = random.pick(&[f64::INFINITY, f64::INFINITY, 1.0, 0.3, 0.0]);
        tally.check((&ground, &at), &ray, limit, 1.0);
    }
    let Tally { hits, misses, differ } = tally;
    assert!(hits > 1500 && misses > 500, "{hits} {misses}");
    assert!(differ * 500 < hits, "{differ} of {hits}");
}

#[test]
fn thin_triangles_at_any_slant_place_and_scale_are_met_as_one_by_one() {
    let mut tally = Tally::default();
    for seed in 0..1500 {
        let mut random = Random::new(120_000 + seed as u128);
        let scale = random.pick(&[1e-3, 0.1, 1.0, 30.0, 1e3]);
        let thin = random.pick(&[1.0, 1e-1, 1e-3]);
        let (vertices, faces) = sheet(
            [12, 12],
            [scale, scale * thin],
            |_, _| (random.between(-0.2, 0.2) * f64::from(scale * thin)) as f32,
            |_, _| false,
        );
        let ground = mesh((vertices, faces));
        let far = random.pick(&[0.0, 1.0, 1e3, 1e6]);
        let at = Pose3::new(random.direction() * far, random.quaternion()).unwrap();
        let within = Ground::of(&ground).unwrap();
        let [a, b, c] = within.corners(random.below(288) as u32).map(|corner| corner.as_dvec3());
        // Aimed at a vertex, an edge, a point inside, or far beside; at angles down to a millionth.
        let share = random.between(0.0, 1.0);
        let aim =
            random.pick(&[a, a + (b - a) * 0.5, b + (c - b) * share, (a + b + c) / 3.0, a + (b - c) * 30.0]);
        let along = random.pick(&[(b - a).normalize(), (c - b).normalize(), DVec3::new(0.6, 0.0, 0.8)]);
        let rise = random.pick(&[3.0, 0.1, 1e-3, 1e-6]);
        let way = at.turn((along + DVec3::Y * rise) * -random.pick(&[1e-3, 1.0, 1e3]));
        // The direction is rounded before the origin is moved back along it, so that the aim is exact to the last bit.
        let direction = way.as_vec3();
        let back = direction.as_dvec3().normalize() * f64::from(scale) * random.between(0.0, 20.0);
        let ray = Ray3::new(at.transform(aim) - back, direction).unwrap();
        // At a sharp corner, a point within rounding of both edges may lie further beyond it the sharper it is: outside
        // the triangle's AABB, which the loop over triangles does not test.
        tally.check((&ground, &at), &ray, f64::INFINITY, 4.0 / f64::from(thin));
    }
    let Tally { hits, misses, differ } = tally;
    assert!(hits > 1500 && misses > 50, "{hits} {misses}");
    assert!(differ * 100 < hits, "{differ} of {hits}");
}

#[test]
fn no_ray_slips_through_between_triangles() {
    for seed in 0..600 {
        let mut random = Random::new(50_000 + seed as u128);
        // A closed shell, rotated and far away, seen from inside: rays through its edges, its vertices and past them by
        // a rounding.
        let (ground, at) = level(&mut random, 3 * seed + 2);
        let mesh = Ground::of(&ground).unwrap();
        let inside = at.transform(random.vector().as_vec3() * 0.2);
        let number = random.below(mesh.triangle_count() as usize) as u32;
        let [a, b, _] = mesh.corners(number).map(|corner| at.transform(corner));
        let aim = match seed % 3 {
            0 => a,
            1 => (a + b) * 0.5,
            _ => a + (b - a) * random.between(0.0, 1.0),
        };
        let ray = Ray3::new(inside, (aim - inside).as_vec3()).unwrap();
        let hit = cast_ray3(&ground, &at, &ray, f64::INFINITY);
        let hit = hit.unwrap_or_else(|| panic!("{seed}: it slipped through"));
        // Within what is left by the f32 direction, the f64 position and the shell's distortion.
        assert!(hit.distance > 0.2 && hit.distance < 5.0, "{seed}: {hit:?}");
    }
}

#[test]
fn a_ray_down_a_grid_of_any_size_lands_on_every_edge_and_vertex() {
    let ground = mesh(sheet([12, 12], [0.1, 0.3], |x, z| x * 0.37 - z * 0.11, |_, _| false));
    let at =
        Pose3::new([1e4, -3.0, 2e3], asunder_geometry::glam::Quat::from_xyzw(0.1, 0.2, -0.3, 0.9)).unwrap();
    let Shape3::TriMesh(inner) = &ground else { unreachable!() };
    let down = at.turn(DVec3::NEG_Y);
    for (i, &one) in inner.vertices().iter().enumerate() {
        for &other in &inner.vertices()[i..] {
            // Points on edges and their extensions, all within the grid.
            for share in [0.0, 0.5, 0.3] {
                let place = at.transform(one.as_dvec3() * (1.0 - share) + other.as_dvec3() * share);
                let ray = Ray3::new(place - down * 5.0, down.as_vec3()).unwrap();
                let on_rim = (one.x.abs() > 0.59) || (one.z.abs() > 1.79);
                if on_rim {
                    continue;
                }
                let hit = cast_ray3(&ground, &at, &ray, 20.0).unwrap();
                assert!((hit.distance - 5.0).abs() < 1e-5, "{hit:?}");
            }
        }
    }
}

#[test]
fn one_sided_ground_is_seen_from_its_front() {
    let floor = TriMesh::new(
        [Vec3::ZERO, Vec3::X * 4.0, Vec3::Z * 4.0, Vec3::new(4.0, 0.0, 4.0)],
        [[0, 2, 1], [1, 2, 3]],
    )
    .unwrap();
    let both = Shape3::from(floor.clone());
    let one = Shape3::from(floor.one_sided());
    let pose = Pose3::IDENTITY;
    let down = Ray3::new([1.0, 2.0, 1.0], Vec3::NEG_Y).unwrap();
    let up = Ray3::new([1.0, -2.0, 1.0], Vec3::Y).unwrap();
    for ground in [&both, &one] {
        let hit = cast_ray3(ground, &pose, &down, 9.0).unwrap();
        assert_eq!((hit.distance, hit.normal, hit.part, hit.inside), (2.0, Vec3::Y, 0, false));
    }
    let hit = cast_ray3(&both, &pose, &up, 9.0).unwrap();
    assert_eq!((hit.distance, hit.normal), (2.0, Vec3::NEG_Y));
    assert_eq!(cast_ray3(&one, &pose, &up, 9.0), None);
    // The other triangle, and a tie on the edge between them.
    let far = Ray3::new([3.0, 2.0, 3.0], Vec3::NEG_Y).unwrap();
    assert_eq!(cast_ray3(&one, &pose, &far, 9.0).unwrap().part, 1);
    let middle = Ray3::new([2.0, 2.0, 2.0], Vec3::NEG_Y).unwrap();
    assert_eq!(cast_ray3(&one, &pose, &middle, 9.0).unwrap().part, 0);
    // From a point on the surface itself, and along it.
    let on = Ray3::new([1.0, 0.0, 1.0], Vec3::NEG_Y).unwrap();
    let hit = cast_ray3(&one, &pose, &on, 9.0).unwrap();
    assert_eq!((hit.distance, hit.inside), (0.0, true));
    let along = Ray3::new([-1.0, 0.0, 1.0], Vec3::X).unwrap();
    let hit = cast_ray3(&both, &pose, &along, 9.0).unwrap();
    assert!((hit.distance - 1.0).abs() < 1e-9 && hit.part == 0, "{hit:?}");
}

#[test]
fn rays_without_measure_bring_no_number_that_is_none() {
    let mut hits = 0;
    for seed in 0..300 {
        let mut random = Random::new(80_000 + seed as u128);
        let (ground, at) = level(&mut random, seed);
        let scale = random.pick(&[1e-38, 1e-30, 1.0, 1e30, 1e38]);
        let direction = (random.direction() * scale).as_vec3();
        let from = beside(&mut random, (&ground, &at), [0.0, 1.0, 1e8][seed % 3]);
        let Ok(ray) = Ray3::new(from, direction) else { continue };
        for limit in [f64::NAN, f64::INFINITY, -1.0, f64::MAX, 1e300] {
            if let Some(hit) = cast_ray3(&ground, &at, &ray, limit) {
                assert!(hit.distance.is_finite() && hit.distance >= 0.0 && !hit.error.is_nan(), "{hit:?}");
                assert!(hit.normal.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-5, "{hit:?}");
                hits += 1;
            }
        }
    }
    assert!(hits > 100, "{hits}");
}

#[test]
fn of_triangles_met_at_once_the_lowest_number_is_told() {
    let ground = mesh(sheet([12, 12], [0.5, 0.5], |_, _| 0.0, |_, _| false));
    let mut shared = 0;
    for i in 0..=24 {
        for j in 0..=24 {
            let from = DVec3::new(f64::from(i) * 0.25 - 3.0, 2.0, f64::from(j) * 0.25 - 3.0);
            for aside in [Vec3::ZERO, Vec3::X * 0.25, Vec3::new(-0.5, 0.0, 0.25)] {
                let ray = Ray3::new(from, Vec3::NEG_Y * 2.0 + aside).unwrap();
                let found = cast_ray3(&ground, &Pose3::IDENTITY, &ray, f64::INFINITY);
                assert_eq!(found, slowly(&ground, &Pose3::IDENTITY, &ray, f64::INFINITY), "{from} {aside}");
                shared += usize::from(found.is_some());
            }
        }
    }
    assert!(shared > 1500, "{shared}");
}
