mod clouds;
mod holding;
mod large;
#[cfg(feature = "serde")]
mod restored;

use super::*;
use crate::tolerance::{COPLANAR, MIN_RADIUS};
use clouds::{KINDS, Random, cloud, nasty};

/// Checks that the hull passes its own check, and that its bounds hold.
fn examine(points: &[Vec3], hull: &Hull) {
    if let Err(fault) = hull.check(points) {
        panic!("{fault}: {hull:?} of {points:?}");
    }
    let size = f64::from(hull.outer_radius());
    assert!(f64::from(hull.planarity_error()) <= 8.0 * COPLANAR * size, "{hull:?}");
    assert!(hull.dimension() == 3 || hull.inner_radius() == 0.0);
    assert_eq!(hull.normals().len(), if hull.dimension() < 2 { 0 } else { hull.topology().face_count() });
}

fn places(hull: &Hull) -> Vec<[u32; 3]> {
    let mut places: Vec<[u32; 3]> =
        hull.vertices().iter().map(|v| v.to_array().map(|c| (c + 0.0).to_bits())).collect();
    places.sort_unstable();
    places
}

#[test]
fn random_clouds_are_valid_hulls() {
    for seed in 1..60 {
        let count = 4 + (seed as usize * 7) % 80;
        let points = cloud(count, seed, |v| v);
        examine(&points, &Hull::from_points(&points).unwrap());
        let sphere = cloud(count, seed + 100, |v| v.normalize_or(Vec3::X) * 3.0 + Vec3::splat(10.0));
        examine(&sphere, &Hull::from_points(&sphere).unwrap());
    }
}

#[test]
fn lattices_merge_into_a_cuboid() {
    let lattice: Vec<Vec3> =
        (0..125).map(|i| Vec3::new((i % 5) as f32, (i / 5 % 5) as f32, (i / 25) as f32)).collect();
    let hull = Hull::from_points(&lattice).unwrap();
    examine(&lattice, &hull);
    assert_eq!((hull.vertices().len(), hull.topology().face_count()), (8, 6));
    assert_eq!((hull.planarity_error(), hull.error()), (0.0, 0.0));
    assert_eq!(hull.center(), Vec3::splat(2.0));
    assert_eq!(hull.inner_radius(), 2.0_f32.next_down(), "rounded down by the guard");
}

#[test]
fn faces_that_rounding_split_are_merged_again() {
    // A rotated lattice: its faces are flat only up to f32 rounding, and inner points of faces stick out.
    let pose = Pose3::new(Vec3::ZERO, glam::Quat::from_xyzw(0.1, 0.7, -0.3, 0.6)).unwrap();
    let turned: Vec<Vec3> = (0..64)
        .map(|i| pose.transform(Vec3::new((i % 4) as f32, (i / 4 % 4) as f32, (i / 16) as f32)).as_vec3())
        .collect();
    let hull = Hull::from_points(&turned).unwrap();
    examine(&turned, &hull);
    assert_eq!(hull.topology().face_count(), 6);
    assert!(hull.error() > 0.0 && hull.error() < 1e-6, "{}", hull.error());
}

#[test]
fn needles_plates_and_thin_clouds_are_valid() {
    for seed in 1..20 {
        for stretch in [Vec3::new(1.0, 1e-6, 1e-6), Vec3::new(1.0, 1.0, 1e-6), Vec3::new(1.0, 1.0, 1e-7)] {
            let points = cloud(30, seed, |v| v * stretch);
            let hull = Hull::from_points(&points).unwrap();
            examine(&points, &hull);
            assert!(hull.inner_radius() < 1e-3 * hull.outer_radius());
        }
    }
}

/// The area of a loop no wider than rounding depends on the corner from which it is computed, so the check must start
/// at the same corner as the builder.
#[test]
fn what_is_thinner_than_rounding_is_valid_in_any_order() {
    let points = [
        (4.498_428e-5, 8.349_41e-40, 0.0),
        (0.0, 1.175_494_4e-38, -6.080_35e-39),
        (0.0, 0.0, 1e-45),
        (-7.607_564e-39, 1.0, 0.0),
    ];
    examine(&points.map(Vec3::from), &Hull::from_points(&points.map(Vec3::from)).unwrap());
    for seed in 0..5000 {
        let points = clouds::thinner_than_rounding(seed);
        if let Ok(hull) = Hull::of_any_dimension(&points) {
            examine(&points, &hull);
        }
    }
}

#[test]
fn clouds_without_volume_name_their_dimension() {
    let flat = |shape: fn(Vec3) -> Vec3| Hull::from_points(&cloud(20, 3, shape)).unwrap_err();
    assert_eq!(flat(|_| Vec3::ONE), HullError::Flat { dimension: 0 });
    assert_eq!(flat(|v| Vec3::new(v.x, v.x * 2.0, 0.5)), HullError::Flat { dimension: 1 });
    assert_eq!(flat(|v| Vec3::new(v.x, v.y, 0.25)), HullError::Flat { dimension: 2 });
}

#[test]
fn bad_clouds_are_refused_by_every_builder() {
    type Build = fn(&[Vec3]) -> Result<Hull, HullError>;
    let builders: [Build; 3] =
        [Hull::from_points, Hull::of_any_dimension, |points| Hull::simplify(points, 20)];
    for build in builders {
        let refused = |points: &[Vec3]| build(points).unwrap_err();
        let mut points = cloud(10, 5, |v| v);
        assert_eq!(refused(&[]), HullError::TooFewPoints { count: 0 });
        for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            points[7].y = value;
            assert_eq!(refused(&points), HullError::NotFinite { index: 7 });
        }
        for value in [1.000_001e6, -3e38] {
            points[7].y = value;
            assert_eq!(refused(&points), HullError::TooLarge { index: 7 });
        }
        assert!(matches!(refused(&cloud(10, 5, |v| v * 1e-8)), HullError::TooSmall { .. }));
        assert!(matches!(refused(&cloud(10, 5, |v| v * 1e-40)), HullError::TooSmall { .. }));
        let many = cloud(70_000, 5, |v| v);
        assert_eq!(refused(&many), HullError::TooManyPoints { count: 70_000 });
    }
    let round = cloud(2000, 5, |v| v.normalize_or(Vec3::X));
    for build in &builders[..2] {
        assert!(matches!(build(&round).unwrap_err(), HullError::TooManyVertices { .. }));
        assert!(build(&round).unwrap_err().to_string().contains("Hull::simplify"));
    }
    assert_eq!(Hull::from_points(&round[..3]).unwrap_err(), HullError::TooFewPoints { count: 3 });
    for max_vertices in [0, 3, 257, usize::MAX] {
        assert_eq!(
            Hull::simplify(&round, max_vertices).unwrap_err(),
            HullError::VertexLimit { max_vertices }
        );
    }
    let flat = cloud(20, 3, |v| Vec3::new(v.x, v.y, 0.25));
    assert!(Hull::from_points(&flat).unwrap_err().to_string().contains("Hull::of_any_dimension"));
}

#[test]
fn the_builder_finds_the_very_facets_that_wrapping_finds() {
    let mut solid = 0;
    for seed in 1..4000 {
        let points = cloud::Cloud::new(&nasty(seed), 1).unwrap().points;
        let (quick, wrapped) = (quick::hull_facets(&points), wrap::enumerate_facets(&points));
        assert_eq!(quick, wrapped, "seed {seed}");
        solid += usize::from(quick.is_ok());
    }
    assert!(solid > 3000, "only {solid} clouds had a volume");
}

#[test]
fn nasty_clouds_are_valid_hulls_of_their_dimension() {
    let mut of_dimension = [0; 4];
    let mut kinds_with_volume = std::collections::BTreeSet::new();
    for seed in 1..10_500 {
        let points = nasty(seed);
        let (solid, any) = (Hull::from_points(&points), Hull::of_any_dimension(&points));
        match (&solid, &any) {
            (Ok(hull), Ok(same)) => assert_eq!(hull, same, "seed {seed}"),
            (Err(HullError::Flat { dimension }), Ok(hull)) => assert_eq!(hull.dimension(), *dimension),
            (Err(HullError::TooSmall { .. }), Err(HullError::TooSmall { .. })) => continue,
            (Err(HullError::Flat { .. }), Err(HullError::TooSmall { .. })) => continue,
            other => panic!("seed {seed}: {other:?}"),
        }
        let hull = any.unwrap();
        examine(&points, &hull);
        of_dimension[usize::from(hull.dimension())] += 1;
        if hull.dimension() == 3 {
            kinds_with_volume.insert(seed % KINDS);
        }
    }
    assert!(of_dimension[3] > 8000 && of_dimension.iter().all(|&count| count > 20), "{of_dimension:?}");
    assert!(kinds_with_volume.len() as u64 > KINDS - 5, "{kinds_with_volume:?}");
}

#[test]
fn nasty_clouds_are_simplified_within_their_error() {
    let mut smaller = 0;
    for seed in 1..10_500 {
        let (points, most) = (nasty(seed), 4 + seed as usize % 13);
        let Ok(whole) = Hull::from_points(&points) else { continue };
        let hull = Hull::simplify(&points, most).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert!(hull.vertices().len() <= most);
        examine(&points, &hull);
        if whole.vertices().len() <= most {
            assert_eq!(hull, whole);
        } else {
            smaller += 1;
        }
    }
    assert!(smaller > 4000, "{smaller}");
}

#[test]
fn the_order_of_the_points_does_not_matter() {
    for seed in 1..3000 {
        let (mut points, mut random) = (nasty(seed), Random::new(seed));
        let build = |points: &[Vec3]| [Hull::of_any_dimension(points), Hull::simplify(points, 9)];
        let before = build(&points);
        random.shuffle(&mut points);
        for (before, after) in before.into_iter().zip(build(&points)) {
            match (before, after) {
                (Ok(before), Ok(after)) => {
                    assert_eq!(places(&before), places(&after), "seed {seed}");
                    let numbers = |hull: &Hull| {
                        let radii = (hull.center(), hull.outer_radius(), hull.inner_radius());
                        (hull.topology().face_count(), radii, hull.planarity_error(), hull.error())
                    };
                    assert_eq!(numbers(&before), numbers(&after), "seed {seed}");
                }
                (before, after) => assert_eq!(before, after),
            }
        }
    }
}

/// A lower bound on a point's distance from the hull of vertices, by Gilbert's algorithm (1966): independent of faces.
fn least_distance(point: DVec3, vertices: &[Vec3]) -> f64 {
    let arm = |v: &Vec3| v.as_dvec3() - point;
    let (mut nearest, mut least) = (arm(&vertices[0]), 0.0_f64);
    for _ in 0..3000 {
        let Some(support) = vertices.iter().map(arm).min_by(|a, b| a.dot(nearest).total_cmp(&b.dot(nearest)))
        else {
            break;
        };
        let length = nearest.length();
        least = least.max(support.dot(nearest) / length);
        let along = support - nearest;
        if length < 1e-12 || length - least < 1e-3 * length || along.length_squared() == 0.0 {
            break;
        }
        nearest += along * (-nearest.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    }
    least
}

#[test]
fn the_error_of_a_simplified_hull_is_a_bound_and_a_tight_one() {
    for (seed, most) in [(1, 4), (2, 8), (3, 20), (4, 60), (5, 150)] {
        let points = cloud(300, seed, |v| v.normalize_or(Vec3::X) * Vec3::new(1.0, 2.0, 0.5));
        let hull = Hull::simplify(&points, most).unwrap();
        let truth = points.iter().map(|p| least_distance(p.as_dvec3(), hull.vertices())).fold(0.0, f64::max);
        let error = f64::from(hull.error());
        assert!(truth <= error && error <= 1.02 * truth, "{most} vertices: {error}, but {truth}");
        assert_eq!(hull.vertices().len(), most);
    }
}

#[test]
fn more_vertices_leave_less_outside() {
    let points = cloud(65_535, 77, |v| v.normalize_or(Vec3::X));
    let error = |most| Hull::simplify(&points, most).unwrap().error();
    // A polyhedron of n vertices differs from a unit sphere by about 4.8 / n at best, if its facets are alike.
    for most in [16_u8, 64, 255] {
        let best = 4.8 / f32::from(most);
        assert!(error(most.into()) < 2.5 * best, "{most} vertices: {}", error(most.into()));
    }
}

#[test]
fn a_flat_hull_has_two_faces_back_to_back() {
    let points = [(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (0.0, 0.0)]
        .map(|(x, y)| Vec3::new(x, y, x + y));
    let hull = Hull::of_any_dimension(&points).unwrap();
    examine(&points, &hull);
    assert_eq!(hull.vertices().len(), 4);
    let around: Vec<usize> = hull.topology().face_vertices(0).collect();
    let back: Vec<usize> = hull.topology().face_vertices(1).collect();
    assert_eq!((around, back), (vec![0, 1, 2, 3], vec![3, 2, 1, 0]));
    assert_eq!(hull.center(), Vec3::new(1.0, 1.0, 2.0));
    assert_eq!((hull.inner_radius(), hull.error()), (0.0, 0.0));
    assert!((hull.normals()[0].dot(DVec3::new(1.0, 1.0, -1.0)).abs() - 3.0_f64.sqrt()).abs() < 1e-14);
    assert!(hull.contains(DVec3::new(0.25, 1.75, 2.0)) && hull.contains(DVec3::new(2.0, 1.0, 3.0)));
    assert!(
        !hull.contains(DVec3::new(0.25, 1.75, 2.0_f64.next_up()))
            && !hull.contains(DVec3::new(2.25, 1.0, 3.25))
    );
    let rounded = hull.rounded(0.5).unwrap();
    assert!(rounded.contains(DVec3::new(1.0, 1.0, 2.8)) && !rounded.contains(DVec3::new(1.0, 1.0, 2.9)));
    assert_eq!(rounded.inner_radius(), 0.5);
}

#[test]
fn a_segment_and_a_point_are_hulls_too() {
    let line: Vec<Vec3> = [3, 1, 9, 4, -2].map(|i| Vec3::new(1.0, 2.0, -3.0) * i as f32).to_vec();
    let segment = Hull::of_any_dimension(&line).unwrap();
    examine(&line, &segment);
    assert_eq!((segment.dimension(), segment.vertices()), (1, &[line[2], line[4]][..]));
    assert_eq!(segment.center(), Vec3::new(3.5, 7.0, -10.5));
    assert!(segment.contains(DVec3::new(0.5, 1.0, -1.5)) && !segment.contains(DVec3::new(0.5, 1.0, -1.25)));
    assert!(!segment.contains(DVec3::new(9.5, 19.0, -28.5)), "on the line, beyond its end");
    let capsule = segment.rounded(1.0).unwrap();
    assert!(capsule.contains(DVec3::new(0.0, 0.0, 0.99)) && capsule.contains(DVec3::new(9.2, 18.4, -27.6)));
    assert!(!capsule.contains(DVec3::new(9.3, 18.7, -28.0)));

    let one = [Vec3::new(0.1, 0.2, 0.3); 5];
    let point = Hull::of_any_dimension(&one).unwrap();
    examine(&one, &point);
    assert_eq!((point.dimension(), point.vertices(), point.outer_radius()), (0, &one[..1], MIN_RADIUS));
    assert!(point.contains(one[0].as_dvec3()) && !point.contains(DVec3::new(0.1, 0.2, 0.3)));
    assert!(point.rounded(1e-3).unwrap().contains(DVec3::new(0.1, 0.2, 0.3)));
    let close = [Vec3::ZERO, Vec3::X * 1e-7];
    assert!(matches!(Hull::of_any_dimension(&close), Err(HullError::TooSmall { .. })));
    assert!(Hull::of_any_dimension(&[Vec3::splat(1e-40)]).is_ok());
}

#[test]
fn a_flat_hull_of_too_many_corners_is_refused() {
    let ring = |count: usize| -> Vec<Vec3> {
        // On a parabola, exactly: every point is a corner.
        (0..count).map(|i| Vec3::new(i as f32, (i * i) as f32, 7.0)).collect()
    };
    assert_eq!(Hull::of_any_dimension(&ring(256)).unwrap().vertices().len(), 256);
    assert_eq!(Hull::of_any_dimension(&ring(257)).unwrap_err(), HullError::TooManyVertices { at_least: 257 });
}

#[test]
fn a_tampered_hull_is_found_out() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, Vec3::new(1.0, 1.0, 0.0)];
    let tampered = |tamper: fn(&mut HullData)| {
        let hull = Hull::from_points(&points).unwrap();
        let mut data = Arc::into_inner(hull.data).unwrap();
        tamper(&mut data);
        Hull { data: Arc::new(data), radius: 0.0 }.check(&points)
    };
    assert_eq!(tampered(|_| {}), Ok(()));
    assert!(matches!(
        tampered(|data| data.normals[2] = -data.normals[2]),
        Err(HullFault::BadNormal { face: 2 })
    ));
    assert!(matches!(
        tampered(|data| data.vertices[4] *= 0.5),
        Err(HullFault::NotConvex { .. } | HullFault::BadNormal { .. })
    ));
    assert!(matches!(tampered(|data| data.outer_radius *= 0.9), Err(HullFault::BadRadius)));
    assert!(matches!(tampered(|data| data.inner_radius = data.outer_radius), Err(HullFault::BadRadius)));
    let loops = |loops: &[&[u16]]| Topology::from_loops(loops.iter().copied());
    assert_eq!(loops(&[&[0, 1, 2]]).face_count(), 1);
    assert!(matches!(
        tampered(|data| data.topology = Topology::from_loops([[0_u16, 1, 2].as_slice()].into_iter())),
        Err(HullFault::Open { half_edge: 0 })
    ));
    let square = Hull::from_points(&points[..5]).unwrap();
    assert!(matches!(square.check(&points), Err(HullFault::PointOutside { index: 5, .. })));
}
