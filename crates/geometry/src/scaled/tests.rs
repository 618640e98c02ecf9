use crate::*;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use oorandom::Rand32;

fn number(random: &mut Rand32) -> f32 {
    random.rand_float() * 2.0 - 1.0
}

fn corner(random: &mut Rand32) -> Vec3 {
    Vec3::new(number(random), number(random), number(random))
}

/// Shapes of every kind in space that any factors can scale.
fn polyhedra(random: &mut Rand32) -> Vec<Shape3> {
    let points: Vec<Vec3> = (0..24).map(|_| corner(random)).collect();
    let turn = Quat::from_xyzw(0.5, 0.1, -0.4, 0.6);
    let cuboid = Shape3::from(Cuboid::from_half_extents(Vec3::new(0.5, 1.0, 0.25)).unwrap());
    let hull = Shape3::from(Hull::from_points(&points).unwrap());
    let parts = [
        (Pose3::at([1.0, 0.5, 0.0]).unwrap(), hull.clone()),
        (Pose3::new([-1.0, 0.0, 0.5], turn).unwrap(), cuboid.clone()),
    ];
    vec![
        cuboid,
        hull,
        Hull::of_any_dimension(&[Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::new(0.75, 0.0, 0.75)]).unwrap().into(),
        Triangle3::new(points[0], points[1], points[2]).unwrap().into(),
        Segment3::new(points[3], points[4]).unwrap().into(),
        Compound3::new(parts).unwrap().into(),
        TriMesh::new(points.as_slice(), [[0, 1, 2], [3, 5, 4], [6, 6, 7]]).unwrap().into(),
    ]
}

/// A point is in the scaled shape exactly if its preimage is in the old one: for random points, none of which is within
/// rounding of a surface.
#[test]
fn a_scaled_shape_holds_what_it_held() {
    let mut random = Rand32::new(31);
    let mut held = [0, 0];
    for _ in 0..20 {
        for shape in polyhedra(&mut random) {
            let factors = Vec3::new(number(&mut random) * 3.0, -0.25 + number(&mut random) * 0.125, 4.0);
            let scaled = shape.scaled(factors).unwrap();
            for _ in 0..100 {
                let point = corner(&mut random).as_dvec3() * 1.25;
                let is_held = shape.contains(point);
                assert_eq!(is_held, scaled.contains(point * factors.as_dvec3()), "{shape:?} {factors}");
                held[usize::from(is_held)] += 1;
            }
        }
    }
    assert!(held[0] > 5000 && held[1] > 300, "{held:?}");
}

/// The same for support points, as flat shapes contain no random points.
#[test]
fn a_scaled_shape_reaches_as_far() {
    let mut random = Rand32::new(32);
    for _ in 0..20 {
        for shape in polyhedra(&mut random) {
            let factors = Vec3::new(number(&mut random) * 3.0, -0.25 + number(&mut random) * 0.125, 4.0);
            let scaled = shape.scaled(factors).unwrap();
            for _ in 0..20 {
                let along = corner(&mut random).as_dvec3();
                // The direction in scaled space, mapped to the old shape.
                let before =
                    shape.support(along * factors.as_dvec3()).map(|point| point * factors.as_dvec3());
                let [is, was] =
                    [scaled.support(along).unwrap(), before.unwrap()].map(|point| point.dot(along));
                assert!((is - was).abs() < 2e-6, "{shape:?} {factors} {is} {was}");
            }
        }
    }
}

#[test]
fn powers_of_two_are_exact_and_leave_every_number_in_its_place() {
    let mut random = Rand32::new(33);
    let double = Vec3::splat(2.0);
    for _ in 0..20 {
        let points: Vec<Vec3> = (0..40).map(|_| corner(&mut random)).collect();
        let doubled: Vec<Vec3> = points.iter().map(|&point| point * 2.0).collect();
        let hull = Hull::simplify(&points, 12).unwrap();
        assert!(hull.error() > 0.0);
        let Shape3::Hull(scaled) = Shape3::from(hull.clone()).scaled(double).unwrap() else { unreachable!() };
        assert_eq!(scaled, Hull::simplify(&doubled, 12).unwrap());
        let back = Shape3::from(scaled).scaled(Vec3::splat(0.5)).unwrap();
        assert_eq!(back, Shape3::from(hull));
    }
    let ball = Shape3::from(Sphere::new(0.5).unwrap());
    let turned = Pose3::new([1.0, 2.0, 3.0], Quat::from_xyzw(0.5, 0.1, -0.4, 0.6)).unwrap();
    let pair = Compound3::new([(turned, ball.clone()), (Pose3::IDENTITY, ball)]).unwrap();
    let Shape3::Compound(scaled) = Shape3::from(pair).scaled(double).unwrap() else { unreachable!() };
    assert_eq!(scaled.parts()[0].pose(), &Pose3::new([2.0, 4.0, 6.0], turned.rotation()).unwrap());
    assert_eq!(scaled.parts()[0].shape(), &Shape3::from(Sphere::new(1.0).unwrap()));
}

#[test]
fn a_mirrored_mesh_is_seen_from_the_same_side() {
    let mesh = TriMesh::new([Vec3::ZERO, Vec3::Z, Vec3::X], [[0, 1, 2]]).unwrap().one_sided();
    for factors in
        [Vec3::ONE, Vec3::new(-1.0, 1.0, 1.0), Vec3::new(-1.0, 2.0, -3.0), Vec3::new(1.0, -1.0, 1.0)]
    {
        let Shape3::TriMesh(scaled) = Shape3::from(mesh.clone()).scaled(factors).unwrap() else {
            unreachable!()
        };
        assert!(scaled.is_one_sided());
        let [a, b, c] = scaled.triangles()[0].map(|number| scaled.vertices()[number as usize]);
        // Its front was up; a mirror that flips up and down flips it, too.
        let up = (b - a).cross(c - a).y.signum();
        assert_eq!(up, factors.y.signum(), "{factors}");
    }
}

#[test]
fn what_is_round_wants_one_factor() {
    let capsule = Shape3::from(Capsule3::from_half_height(1.0, 0.5).unwrap());
    assert_eq!(capsule.scaled(Vec3::new(1.0, 2.0, 1.0)), Err(ScaleError::Round));
    let mirrored = Shape3::from(Capsule3::new(Vec3::ZERO, Vec3::NEG_X, 1.0).unwrap());
    let rod = Shape3::from(Capsule3::new(Vec3::ZERO, Vec3::X, 0.5).unwrap());
    assert_eq!(rod.scaled(Vec3::new(-2.0, 2.0, 2.0)).unwrap().radius(), 1.0);
    assert_eq!(
        rod.scaled(Vec3::new(-1.0, 1.0, 1.0)).unwrap().support(DVec3::NEG_X),
        Some(DVec3::NEG_X * 1.5)
    );
    assert_eq!(mirrored.support(DVec3::X), Some(DVec3::X));
    let unit = Cuboid::from_half_extents(Vec3::ONE).unwrap();
    assert_eq!(
        Shape3::from(unit.rounded(0.5).unwrap()).scaled(Vec3::new(1.0, 1.0, 2.0)),
        Err(ScaleError::Round)
    );
    assert!(Shape3::from(unit).scaled(Vec3::new(1.0, 1.0, 2.0)).is_ok());
}

#[test]
fn planes_keep_their_side_under_any_factors() {
    let slope = Shape3::from(HalfSpace::new(Vec3::new(1.0, 2.0, 0.0)).unwrap());
    for factors in [Vec3::new(2.0, 1.0, 1.0), Vec3::new(-0.5, 3.0, 1e-20), Vec3::new(1e-30, -1.0, 1.0)] {
        let scaled = slope.scaled(factors).unwrap();
        for point in [DVec3::new(1.0, -0.75, 1.0), DVec3::new(-1.0, 0.25, 5.0), DVec3::new(1.0, -0.25, 0.0)] {
            assert_eq!(
                slope.contains(point),
                scaled.contains(point * factors.as_dvec3()),
                "{factors} {point}"
            );
        }
    }
    let slope = Shape2::from(HalfPlane::new(Vec2::new(1.0, 2.0)).unwrap());
    let steep = slope.scaled(Vec2::new(-0.25, 1.0)).unwrap();
    assert!(steep.contains(DVec2::new(-0.25, -0.75)) && !steep.contains(DVec2::new(-0.25, -0.25)));
}

/// Symptom: the normal was divided by its largest component, and so rounded even by a factor of one.
#[test]
fn a_plane_keeps_its_bits_under_one_factor() {
    let mut random = Rand32::new(35);
    for _ in 0..200 {
        let normal = corner(&mut random);
        let slope = Shape3::from(HalfSpace::new(normal).unwrap());
        for factor in [1.0, 2.0, 0.3, 1e-30] {
            assert_eq!(slope.scaled(Vec3::splat(factor)).unwrap(), slope);
        }
        let mirrored = Shape3::from(HalfSpace::new(normal * Vec3::new(-1.0, 1.0, 1.0)).unwrap());
        assert_eq!(slope.scaled(Vec3::new(-3.0, 3.0, 3.0)).unwrap(), mirrored);
        let halved = Shape3::from(HalfSpace::new(normal * Vec3::new(1.0, 0.5, 1.0)).unwrap());
        let Shape3::HalfSpace(scaled) = slope.scaled(Vec3::new(1.0, 2.0, 1.0)).unwrap() else {
            unreachable!()
        };
        let Shape3::HalfSpace(halved) = halved else { unreachable!() };
        // Exact up to a common power of two.
        let share = scaled.normal().x / halved.normal().x;
        assert_eq!(halved.normal() * share, scaled.normal());
        let slope = Shape2::from(HalfPlane::new(normal.truncate()).unwrap());
        assert_eq!(slope.scaled(Vec2::splat(7.0)).unwrap(), slope);
    }
}

#[test]
fn points_stay_points_and_no_dimension_is_lost_unsaid() {
    let (ball, disc) = (Shape3::from(Sphere::POINT), Shape2::from(Circle::POINT));
    assert_eq!(
        (ball.scaled(Vec3::new(1.0, 2.0, 3.0)), disc.scaled(Vec2::ONE)),
        (Ok(ball.clone()), Ok(disc.clone()))
    );
    let square = [Vec3::ZERO, Vec3::X, Vec3::Z, Vec3::new(1.0, 0.0, 1.0)];
    let square = Shape3::from(Hull::of_any_dimension(&square).unwrap());
    let refused =
        square.scaled(Vec3::new(1.0, 1.0, 1e-45)).and_then(|thin| thin.scaled(Vec3::new(1.0, 1.0, 0.25)));
    assert_eq!(refused, Err(ScaleError::Hull(HullError::Flat { dimension: 1 })));
    let thread = Shape3::from(Hull::of_any_dimension(&[Vec3::ZERO, Vec3::X * 0.25]).unwrap());
    assert_eq!(
        thread.scaled(Vec3::new(1e-45, 1.0, 1.0)),
        Err(ScaleError::Hull(HullError::Flat { dimension: 0 }))
    );
}

#[test]
fn a_field_keeps_its_holes_and_is_not_mirrored() {
    let heights: Vec<f32> = (0..12_u8).map(f32::from).collect();
    let field =
        HeightField::new(4, 3, heights, Vec2::new(1.0, 2.0)).unwrap().with_hole(2, 1).unwrap().one_sided();
    let shape = Shape3::from(field);
    let Shape3::HeightField(scaled) = shape.scaled(Vec3::new(2.0, 0.5, 3.0)).unwrap() else { unreachable!() };
    assert_eq!((scaled.cell(), scaled.heights()[11]), (Vec2::new(2.0, 6.0), 5.5));
    assert!(scaled.is_one_sided() && scaled.is_hole(2, 1) && !scaled.is_hole(1, 1));
    for factors in [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, -1.0, 1.0), Vec3::new(1.0, 1.0, -1.0)] {
        assert_eq!(shape.scaled(factors), Err(ScaleError::Mirrored));
    }
}

#[test]
fn shapes_in_the_plane_hold_what_they_held() {
    let mut random = Rand32::new(34);
    let mut held = [0, 0];
    for _ in 0..50 {
        let mut point = || Vec2::new(number(&mut random), number(&mut random));
        let points: Vec<Vec2> = (0..12).map(|_| point()).collect();
        let (rect, polygon) = (
            Shape2::from(Rect::from_half_extents(Vec2::new(0.5, 0.25)).unwrap()),
            Shape2::from(Polygon::hull_of(&points).unwrap()),
        );
        let turn = Rotation2::from_angle(0.7).unwrap();
        let parts = [
            (Pose2::new([0.5, 1.0], turn).unwrap(), rect.clone()),
            (Pose2::new([0.5, -1.0], turn).unwrap(), polygon.clone()),
        ];
        let factors = point() * 3.0;
        for shape in [rect, polygon, Compound2::new(parts).unwrap().into()] {
            let scaled = shape.scaled(factors).unwrap();
            for _ in 0..50 {
                let point = DVec2::new(number(&mut random).into(), number(&mut random).into()) * 1.5;
                let is_held = shape.contains(point);
                assert_eq!(is_held, scaled.contains(point * factors.as_dvec2()), "{shape:?} {factors}");
                held[usize::from(is_held)] += 1;
            }
        }
    }
    assert!(held[0] > 1000 && held[1] > 1000, "{held:?}");
}

#[test]
fn a_mirrored_polygon_and_chain_stay_as_they_are_seen() {
    let outline = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 3.0)].map(Vec2::from);
    let polygon = Shape2::from(Polygon::new(&outline).unwrap());
    let flip = Vec2::new(-1.0, 1.0);
    let Shape2::Polygon(flipped) = polygon.scaled(flip).unwrap() else { unreachable!() };
    assert_eq!(flipped.vertices(), [(0.0, 0.0), (0.0, 3.0), (-2.0, 1.0), (-2.0, 0.0)].map(Vec2::from));
    let Shape2::Polygon(turned) = polygon.scaled(-Vec2::ONE).unwrap() else { unreachable!() };
    assert_eq!(turned.vertices(), outline.map(|corner| -corner));
    // It leads to the left, so its front, on the right, is up.
    let ground = Chain::open([Vec2::X, Vec2::ZERO, Vec2::new(-1.0, 0.5)]).unwrap().one_sided();
    let Shape2::Chain(flipped) = Shape2::from(ground).scaled(flip).unwrap() else { unreachable!() };
    assert_eq!(flipped.vertices(), [Vec2::new(1.0, 0.5), Vec2::ZERO, Vec2::NEG_X]);
    assert!(flipped.is_one_sided() && !flipped.is_closed());
    let ring = Shape2::from(Chain::closed(outline).unwrap());
    let Shape2::Chain(ring) = ring.scaled(Vec2::splat(3.0)).unwrap() else { unreachable!() };
    assert!(ring.is_closed() && ring.vertices()[1] == Vec2::new(6.0, 0.0));
}

#[test]
fn what_is_out_of_range_is_refused_with_its_reason() {
    let ball = Shape3::from(Sphere::new(1.0).unwrap());
    for value in [0.0, f32::NAN, f32::INFINITY] {
        let refused = ball.scaled(Vec3::new(1.0, 1.0, value)).unwrap_err();
        assert!(matches!(refused, ScaleError::Factor { axis: 2, .. }), "{refused:?}");
    }
    assert!(matches!(ball.scaled(Vec3::splat(1e-9)), Err(ScaleError::Radius(_))));
    let hull = Shape3::from(Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]).unwrap());
    assert!(matches!(hull.scaled(Vec3::splat(1e9)), Err(ScaleError::Hull(_))));
    assert!(matches!(hull.scaled(Vec3::splat(f32::MAX)), Err(ScaleError::Hull(_))));
    assert!(matches!(hull.scaled(Vec3::new(1.0, 1.0, 1e-45)), Ok(_) | Err(ScaleError::Hull(_))));
    let far = Compound3::new([(Pose3::IDENTITY, ball.clone()), (Pose3::at([1e5, 0.0, 0.0]).unwrap(), hull)]);
    let far = Shape3::from(far.unwrap());
    let refused = far.scaled(Vec3::splat(1e5)).unwrap_err();
    let ScaleError::Part { part: 1, error } = &refused else { panic!("{refused}") };
    assert!(refused.to_string().contains("part 1 ") && refused.to_string().ends_with(&error.to_string()));
    assert!(core::error::Error::source(&refused).is_none(), "the text says it already: {refused}");
    let flattened = far.scaled(Vec3::new(1.0, 2.0, 1.0));
    assert_eq!(flattened, Err(ScaleError::Part { part: 0, error: Box::new(ScaleError::Round) }));
}
