//! Hulls of points: the same as parry3d's, as near as they say, and never slow.

use asunder_geometry::{Hull, HullError, Pose3, Shape3};
use asunder_narrow::Pair3;
use asunder_tests::cases::Random;
use glam::{DVec3, Vec3};
use std::time::Instant;

fn ball(random: &mut Random, count: usize) -> Vec<Vec3> {
    let place = |random: &mut Random| random.direction() * random.between(0.0, 1.0).cbrt();
    (0..count).map(|_| place(random).as_vec3()).collect()
}

fn sphere(random: &mut Random, count: usize) -> Vec<Vec3> {
    (0..count).map(|_| random.direction().as_vec3()).collect()
}

fn bits(points: &[Vec3]) -> Vec<[u32; 3]> {
    let mut bits: Vec<[u32; 3]> = points.iter().map(|v| v.to_array().map(f32::to_bits)).collect();
    bits.sort_unstable();
    bits
}

#[test]
fn parry_finds_the_same_vertices() {
    let mut random = Random::new(3001);
    for round in 0..60 {
        let count = [8, 20, 60, 150, 1000][round % 5];
        let points = if count < 200 { sphere(&mut random, count) } else { ball(&mut random, count) };
        let hull = Hull::from_points(&points).unwrap();
        let (vertices, triangles) = parry3d::transformation::try_convex_hull(&points).unwrap();
        assert_eq!(bits(hull.vertices()), bits(&vertices), "{count} points, round {round}");
        assert_eq!(
            hull.topology().face_count(),
            triangles.len(),
            "no two facets of a random cloud are coplanar"
        );
        hull.check(&points).unwrap();
    }
}

#[test]
fn no_point_is_further_from_a_simplified_hull_than_its_error() {
    let (mut random, mut furthest) = (Random::new(3002), 0.0_f64);
    for round in 0..40 {
        let stretch =
            random.pick(&[DVec3::ONE, DVec3::new(1.0, 0.1, 3.0), DVec3::new(1.0, 1.0, 1e-3)]).as_vec3();
        let points: Vec<Vec3> = sphere(&mut random, 300).into_iter().map(|v| v * stretch).collect();
        let most = 4 + random.below(60);
        let hull = Hull::simplify(&points, most).unwrap();
        assert!(hull.vertices().len() <= most);
        hull.check(&points).unwrap();
        let (error, origin) = (f64::from(hull.error()), Pose3::IDENTITY);
        let mut most_seen = 0.0_f64;
        let shape = Shape3::from(hull);
        for &point in &points {
            let point = Shape3::from(Hull::of_any_dimension(&[point]).unwrap());
            let Some(closest) = Pair3::new(&shape, &origin, &point, &origin).distance() else { continue };
            let (distance, slack) = (f64::from(closest.distance), f64::from(closest.error));
            assert!(distance - slack <= error, "round {round}: {distance} beyond an error of {error}");
            most_seen = most_seen.max(distance + slack);
        }
        assert!(
            error <= 1.02 * most_seen,
            "round {round}: an error of {error}, but nothing is beyond {most_seen}"
        );
        furthest = furthest.max(most_seen);
    }
    assert!(furthest > 0.1, "some hulls left much out: {furthest}");
}

/// The largest clouds allowed, of kinds that make hull builders quadratic.
fn large_clouds(random: &mut Random) -> Vec<(&'static str, Vec<Vec3>)> {
    const COUNT: usize = 65_535;
    let turn = Pose3::new(DVec3::ZERO, random.quaternion()).unwrap();
    let turned = |v: Vec3| turn.transform(v).as_vec3();
    let all = |place: &mut dyn FnMut(usize) -> Vec3| -> Vec<Vec3> { (0..COUNT).map(place).collect() };
    let grid = |i: usize| Vec3::new((i % 256) as f32, (i / 256) as f32, 0.0);
    let lattice = |i: usize| Vec3::new((i % 40) as f32, (i / 40 % 40) as f32, (i / 1600) as f32);
    let share = |i: usize| i as f32 / COUNT as f32;
    // A rational circle: no trigonometry.
    let around = |i: usize| {
        let (t, half) =
            (f64::from(share(i % (COUNT / 2))) * 4.0 - 1.0, if i < COUNT / 2 { 1.0 } else { -1.0 });
        (DVec3::new(2.0 * t, 1.0 - t * t, 0.0) / (1.0 + t * t) * half).as_vec3()
    };
    vec![
        ("sphere", sphere(random, COUNT)),
        ("ball", ball(random, COUNT)),
        ("lattice", all(&mut |i| lattice(i))),
        ("turned lattice", all(&mut |i| turned(lattice(i)))),
        ("sheet", all(&mut |i| grid(i))),
        ("turned sheet", all(&mut |i| turned(grid(i)))),
        ("rough sheet", all(&mut |i| grid(i) + Vec3::Z * random.signed() as f32 * 1e-4)),
        ("ring", all(&mut |i| turned(around(i)))),
        ("cone", all(&mut |i| if i == 0 { Vec3::Z } else { around(i) })),
        ("paraboloid", all(&mut |i| grid(i) + Vec3::Z * grid(i).length_squared())),
        ("shallow paraboloid", all(&mut |i| grid(i) + Vec3::Z * grid(i).length_squared() * 1e-7)),
        ("curve", all(&mut |i| Vec3::new(share(i), share(i) * share(i), share(i) * share(i) * share(i)))),
        ("turned line", all(&mut |i| turned(Vec3::X * i as f32))),
        ("one place", vec![Vec3::ONE; COUNT]),
    ]
}

#[test]
fn the_largest_clouds_take_no_longer_than_sorting_would_explain() {
    for (name, points) in large_clouds(&mut Random::new(3003)) {
        let start = Instant::now();
        let built = [Hull::of_any_dimension(&points), Hull::simplify(&points, 256)];
        // A quadratic step costs 4e9 operations. What is measured is half a second, in a build with assertions, on
        // a slow core.
        assert!(start.elapsed().as_secs_f64() < 8.0, "{name}: {:?}", start.elapsed());
        // Where both are the same hull, once is enough.
        let are_same = built[0].is_ok() && built[0] == built[1];
        for hull in built.into_iter().skip(usize::from(are_same)) {
            match hull {
                Ok(hull) => hull.check(&points).unwrap_or_else(|fault| panic!("{name}: {fault}")),
                Err(HullError::TooManyVertices { at_least }) => assert!(at_least > 256, "{name}"),
                Err(HullError::Flat { .. }) => {}
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
}
