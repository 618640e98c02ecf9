//! Hulls of points: the same as parry3d's, and within their stated errors.

use asunder_geometry::{Hull, Pose3, Shape3};
use asunder_narrow::Pair3;
use asunder_tests::cases::Random;
use glam::{DVec3, Vec3};

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
