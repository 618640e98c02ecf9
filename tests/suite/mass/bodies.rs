//! What must hold for any body: plausible values, symmetries, compounds, shapes without volume, rejections.

use super::{ROUNDING, both, check_possible, check2, check3, cloud, hull, least_spread, of2, of3, points};
use asunder_geometry::{
    Capsule3, Circle, Compound2, Compound3, Cuboid, HalfPlane, HalfSpace, Hull, MassError, MassProperties2,
    MassProperties3, Polygon, Pose2, Pose3, Rect, Rotation2, Segment2, Segment3, Shape2, Shape3, Sphere,
    Triangle3,
};
use glam::{DMat3, DVec2, DVec3, Quat, Vec2, Vec3};
use oorandom::Rand64;

fn unit(random: &mut Rand64) -> f32 {
    random.rand_float() as f32 * 2.0 - 1.0
}

/// Points in a box of any proportions up to a million to one, rotated or not, near the origin or far from it.
fn any_points(random: &mut Rand64) -> Vec<Vec3> {
    let count = 4 + random.rand_range(0..40) as usize;
    let extents: Vec3 =
        core::array::from_fn(|_| [1e-3, 0.03, 1.0, 30.0, 1e3][random.rand_range(0..5) as usize]).into();
    let turn = match random.rand_range(0..2) {
        0 => Quat::IDENTITY,
        _ => Quat::from_xyzw(unit(random), unit(random), unit(random), unit(random)).normalize(),
    };
    let far = if random.rand_range(0..4) == 0 { Vec3::splat(500.0) * unit(random) } else { Vec3::ZERO };
    (0..count)
        .map(|_| turn * (extents * Vec3::from_array(core::array::from_fn(|_| unit(random)))) + far)
        .collect()
}

#[test]
fn no_hull_has_an_impossible_inertia() {
    let mut random = Rand64::new(20);
    let (mut built, mut thin) = (0, 0);
    while built < 500 {
        let Ok(hull) = Hull::from_points(&any_points(&mut random)) else { continue };
        built += 1;
        thin += usize::from(hull.inner_radius() < 1e-3 * hull.outer_radius());
        let sharp = of3(hull.clone());
        check_possible(&sharp);
        assert!(sharp.mass > 0.0);
        assert!((sharp.center - hull.center().as_dvec3()).length() <= f64::from(hull.outer_radius()));
        let mut known = sharp.mass;
        for radius in [1e-40, 1e-9, 1e-3, 1.0, 1e3] {
            let round = of3(hull.clone().rounded(radius).unwrap());
            check_possible(&round);
            assert!(round.mass >= known, "{} is lighter than {known}", round.mass);
            known = round.mass;
        }
    }
    assert!(thin > 50, "{thin} thin hulls");
}

#[test]
fn extreme_bodies_have_no_impossible_inertia_either() {
    let mut random = Rand64::new(21);
    let sphere: Vec<Vec3> = (0..256)
        .map(|_| Vec3::new(unit(&mut random), unit(&mut random), unit(&mut random)).normalize())
        .collect();
    let ball = of3(hull(&sphere, 0.0));
    check_possible(&ball);
    assert!((least_spread(&ball.inertia) - 1.0 / 3.0).abs() < 0.02, "nearly a ball");
    for radius in [1e-6_f32, 1.0, 9e5] {
        check_possible(&of3(hull(&sphere, radius)));
        check_possible(&of3(Sphere::new(radius).unwrap()));
        for length in [2e-6, 1.0, 9e4] {
            let ends = [-0.6, 0.5, 0.3].map(|x| x * length);
            check_possible(&of3(Capsule3::new(Vec3::from(ends), Vec3::from(ends) * -0.4, radius).unwrap()));
        }
    }
    for extents in [Vec3::new(1e5, 0.05, 0.1), Vec3::new(1e-6, 1.0, 1e-6), Vec3::new(9e5, 1e-20, 1e-38)] {
        for radius in [0.0, 1e-30, 1e-3] {
            let cuboid = Cuboid::from_half_extents(extents).unwrap().rounded(radius).unwrap();
            check_possible(&of3(cuboid));
            check3(&of3(hull(&cuboid.vertices(), radius)), &of3(cuboid), ROUNDING);
        }
    }
}

#[test]
fn units_and_names_of_axes_do_not_matter() {
    let mut random = Rand64::new(22);
    for radius in [0.0, 0.3, 40.0] {
        let cloud = points(&cloud(&mut random, 12, [300, 200, 100]), 0.03);
        let found = of3(hull(&cloud, radius));
        // Twice as large: exact in every number of the computation.
        let doubled = of3(hull(&cloud.iter().map(|&p| p * 2.0).collect::<Vec<_>>(), radius * 2.0));
        let inertia = found.inertia * 32.0;
        assert_eq!(doubled, MassProperties3 { mass: found.mass * 8.0, center: found.center * 2.0, inertia });
        let dense = Shape3::from(hull(&cloud, radius)).mass_properties(4.0).unwrap();
        assert_eq!((dense.mass, dense.center), (found.mass * 4.0, found.center));
        assert_eq!(dense.inertia, found.inertia * 4.0);
        // Cycles the axes: x to y to z to x.
        let turned = of3(hull(&cloud.iter().map(|p| Vec3::new(p.z, p.x, p.y)).collect::<Vec<_>>(), radius));
        let pose = Pose3::new(DVec3::ZERO, Quat::from_xyzw(1.0, 1.0, 1.0, 1.0)).unwrap();
        check3(&turned, &found.posed(&pose), 1e-14);
        let mirrored =
            of3(hull(&cloud.iter().map(|p| Vec3::new(-p.x, p.y, p.z)).collect::<Vec<_>>(), radius));
        let mirror = DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0));
        let inertia = mirror * found.inertia * mirror;
        check3(&mirrored, &MassProperties3 { center: mirror * found.center, inertia, ..found }, 1e-14);
    }
}

#[test]
fn a_little_rounding_changes_little() {
    let mut random = Rand64::new(23);
    let cloud = points(&cloud(&mut random, 10, [100; 3]), 0.01);
    let sharp = of3(hull(&cloud, 0.0));
    // The surface of a shape that fits a box of 2 m is below 24 m^2, all within 2 m of the centre.
    for radius in [1e-45_f32, 1e-20, 1e-9, 1e-5] {
        let round = of3(hull(&cloud, radius));
        let bound = 25.0 * f64::from(radius) + 1e-14 * sharp.mass;
        assert!(round.mass >= sharp.mass && round.mass - sharp.mass <= bound);
        let change = (round.inertia - sharp.inertia).to_cols_array();
        assert!(change.iter().all(|v| v.abs() <= 8.0 * bound), "{change:?}");
    }
}

#[test]
fn a_cuboid_in_two_pieces_is_the_cuboid() {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let cuboid = of3(Cuboid::from_half_extents(at(2.0, 1.0, 0.5)).unwrap());
    let piece = |side: f32| {
        let mut corners = Vec::new();
        for (y, z) in [(-1.0, -0.5), (1.0, -0.5), (-1.0, 0.5), (1.0, 0.5)] {
            corners.extend([at(2.0 * side, y, z), at(0.75 * y + 0.25 * z, y, z)]);
        }
        Shape3::from(hull(&corners, 0.0))
    };
    check3(&both(&of3(piece(-1.0)), &of3(piece(1.0))), &cuboid, 1e-15);
    let parts = [(Pose3::IDENTITY, piece(-1.0)), (Pose3::IDENTITY, piece(1.0))];
    check3(&of3(Compound3::new(parts).unwrap()), &cuboid, 1e-15);
}

#[test]
fn a_posed_part_weighs_what_the_posed_shape_does() {
    let mut random = Rand64::new(24);
    let lattice = cloud(&mut random, 9, [20; 3]);
    // A rotation by integers over 15, for points that are multiples of 15; the quaternion has any length.
    let turn = [[11, -2, 10], [10, 5, -10], [-2, 14, 5]];
    let moved: Vec<[i64; 3]> = lattice
        .iter()
        .map(|p| turn.map(|row: [i64; 3]| row[0] * p[0] + row[1] * p[1] + row[2] * p[2]))
        .map(|p| [p[0] + 1000, p[1], p[2] - 300])
        .collect();
    for radius in [0.0, 7.0] {
        let shape = Shape3::from(hull(&points(&lattice, 15.0), radius));
        let pose = Pose3::new([1000.0, 0.0, -300.0], Quat::from_xyzw(2.0, 1.0, 1.0, 3.0)).unwrap();
        let part = of3(Compound3::new([(pose, shape.clone())]).unwrap());
        check_possible(&part);
        check3(&part, &of3(hull(&points(&moved, 1.0), radius)), ROUNDING);
        // The same part twice has twice the mass in one place.
        let twice = of3(Compound3::new([(pose, shape.clone()), (pose, shape)]).unwrap());
        let inertia = part.inertia * 2.0;
        check3(&twice, &MassProperties3 { mass: part.mass * 2.0, inertia, ..part }, 1e-15);
    }
}

#[test]
fn a_dumbbell_is_two_balls_by_the_parallel_axis_theorem() {
    let ball: Shape3 = Sphere::new(0.5).unwrap().into();
    let place = DVec3::new(3.0, -4.0, 12.0);
    let parts = [place, -place].map(|place| (Pose3::at(place).unwrap(), ball.clone()));
    let (found, one) = (of3(Compound3::new(parts).unwrap()), of3(ball));
    // Each has 0.4 m r^2 along the line through both, and m d^2 more across it.
    let along = found.inertia * place;
    assert!((along - place * (0.8 * one.mass * 0.25)).length() < 1e-12 * along.length() * 1e3);
    let across = place.cross(DVec3::X);
    let wanted = across * (2.0 * one.mass * (0.4 * 0.25 + 169.0));
    assert!((found.inertia * across - wanted).length() < 1e-14 * wanted.length());
    assert_eq!((found.mass, found.center), (2.0 * one.mass, DVec3::ZERO));
    let about = one.inertia_about(place);
    assert!(((about * across) - wanted / 2.0).length() < 1e-14 * wanted.length());
}

#[test]
fn a_part_in_the_plane_is_stretched_as_its_stored_matrix_says() {
    let shape: Shape2 = Polygon::new(&[(0.0, 0.0), (2.0, 0.0), (0.0, 1.0)].map(Vec2::from)).unwrap().into();
    let rotation = Rotation2::from_angle(0.7).unwrap();
    let (c, s) = (f64::from(rotation.cos()), f64::from(rotation.sin()));
    assert!(c * c + s * s != 1.0);
    let pose = Pose2::new([5.0, 6.0], rotation).unwrap();
    let found = of2(Compound2::new([(pose, shape)]).unwrap());
    // Area b h / 2; about the right angle's corner b h (b^2 + h^2) / 12; the centroid at a third of both legs.
    let stretch = c * c + s * s;
    let center = DVec2::new(5.0 + c * 2.0 / 3.0 - s / 3.0, 6.0 + s * 2.0 / 3.0 + c / 3.0);
    let inertia = (10.0 / 12.0 - 5.0 / 9.0) * stretch * stretch;
    check2(&found, &MassProperties2 { mass: stretch, center, inertia }, 1e-15);
}

#[test]
fn round_polygons_and_their_cut_add_up() {
    // As in space: whole + cut = one piece + other piece.
    let mut random = Rand64::new(25);
    for _ in 0..200 {
        let mut near = |x: f32, y: f32| Vec2::new(x + unit(&mut random) * 0.4, y + unit(&mut random) * 0.4);
        let outline = [near(-4.0, 0.0), near(0.0, -3.0), near(3.0, -2.0), near(4.0, 1.0), near(0.0, 3.0)];
        let piece = |from: &[Vec2]| of2(Polygon::new(from).unwrap().rounded(0.5).unwrap());
        let [a, b, c, d, e] = outline;
        let cut = of2(asunder_geometry::Capsule2::new(b, e, 0.5).unwrap());
        let whole = MassProperties2::combined(&[piece(&outline), cut]);
        check2(&whole, &MassProperties2::combined(&[piece(&[a, b, e]), piece(&[b, c, d, e])]), ROUNDING);
    }
}

#[test]
fn what_is_thin_without_rounding_has_a_centroid_but_no_mass() {
    let weightless = |center: DVec3| MassProperties3 { mass: 0.0, center, inertia: DMat3::ZERO };
    let [a, b, c] = [Vec3::new(100.0, 0.0, 0.0), Vec3::new(103.0, 0.0, 3.0), Vec3::new(100.0, 6.0, 0.0)];
    assert_eq!(of3(Segment3::new(a, b).unwrap()), weightless(DVec3::new(101.5, 0.0, 1.5)));
    let triangle = of3(Triangle3::new(a, b, c).unwrap());
    assert!((triangle.center - DVec3::new(101.0, 2.0, 1.0)).length() < 1e-13);
    assert_eq!(triangle, weightless(triangle.center));
    let mut random = Rand64::new(26);
    let mut skew = || Vec3::new(unit(&mut random), unit(&mut random), unit(&mut random));
    for triangle in (0..100).map(|_| [skew(), skew(), skew()]) {
        let [a, b, c] = triangle.map(|corner| corner.as_dvec3());
        let found = of3(Triangle3::new(triangle[0], triangle[1], triangle[2]).unwrap());
        assert!(found.mass == 0.0 && (found.center - (a + b + c) / 3.0).length() < 1e-14);
    }
    // A house: a square of 2 with a roof of 1 has its centroid at (4 * 1 + 1 * (2 + 1/3)) / 5.
    let house =
        [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 3.0), (0.0, 2.0)].map(|(x, y)| Vec3::new(x, y, 7.0));
    let house = of3(hull(&house, 0.0));
    assert!((house.center - DVec3::new(1.0, (4.0 + 7.0 / 3.0) / 5.0, 7.0)).length() < 1e-14);
    assert_eq!(house, weightless(house.center));
    assert_eq!(of3(hull(&[a], 0.0)), weightless(a.as_dvec3()));
    let parts = [(Pose3::IDENTITY, Segment3::new(a, b).unwrap().into())];
    assert_eq!(of3(Compound3::new(parts).unwrap()), weightless(DVec3::new(101.5, 0.0, 1.5)));

    let segment = of2(Segment2::new(Vec2::new(1.0, 2.0), Vec2::new(2.0, 7.0)).unwrap());
    assert_eq!(segment, MassProperties2 { mass: 0.0, center: DVec2::new(1.5, 4.5), inertia: 0.0 });
    assert_eq!(MassProperties2::combined(&[]), MassProperties2::default());
    assert_eq!(MassProperties3::combined(&[]), weightless(DVec3::ZERO));
}

#[test]
fn what_has_no_mass_to_speak_of_is_refused() {
    let (disc, ball) = (Shape2::from(Circle::new(1.0).unwrap()), Shape3::from(Sphere::new(1.0).unwrap()));
    for value in [0.0, -0.0, -1.0, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(disc.mass_properties(value), Err(MassError::Density { value }));
        assert_eq!(ball.mass_properties(value), Err(MassError::Density { value }));
    }
    assert!(matches!(ball.mass_properties(f32::NAN), Err(MassError::Density { .. })));
    assert_eq!(
        Shape2::from(HalfPlane::new(Vec2::Y).unwrap()).mass_properties(1.0),
        Err(MassError::Unbounded)
    );
    assert_eq!(
        Shape3::from(HalfSpace::new(Vec3::Y).unwrap()).mass_properties(1.0),
        Err(MassError::Unbounded)
    );
    // The extremes of f32 are valid densities.
    for density in [f32::MIN_POSITIVE, f32::MAX] {
        let largest = Shape2::from(Rect::from_half_extents(Vec2::splat(7e5)).unwrap());
        let found = largest.mass_properties(density).unwrap();
        assert!(found.mass > 0.0 && found.inertia.is_finite());
    }
}
