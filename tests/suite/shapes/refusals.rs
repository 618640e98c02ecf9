//! Invalid round, flat, unbounded and compound shapes are rejected, with their data and what to do.

use asunder_geometry::{
    Capsule2, Capsule3, CapsuleError, Circle, Compound2, Compound3, CompoundError, Cuboid, DirectionError,
    HalfPlane, HalfSpace, Hull, HullError, Polygon, Pose2, Pose3, RadiusError, Ray2, Ray3, RayError, Rect,
    Segment2, Segment3, Shape2, Shape3, Sphere, Triangle3, VertexError,
};
use core::error::Error;
use glam::{DVec2, DVec3, Vec2, Vec3};

const BAD: [f32; 3] = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];

fn same(one: f32, other: f32) -> bool {
    one.to_bits() == other.to_bits()
}

#[test]
fn radii_that_are_none() {
    let round = [
        |radius| Sphere::new(radius).err(),
        |radius| Circle::new(radius).err(),
        |radius| match Capsule3::from_half_height(1.0, radius).err() {
            Some(CapsuleError::Radius(error)) => Some(error),
            other => panic!("{other:?}"),
        },
        |radius| match Capsule2::from_half_height(1.0, radius).err() {
            Some(CapsuleError::Radius(error)) => Some(error),
            other => panic!("{other:?}"),
        },
    ];
    for refused in round {
        for bad in BAD {
            assert!(matches!(refused(bad), Some(RadiusError::NotFinite { value }) if same(value, bad)));
        }
        assert_eq!(refused(-0.5), Some(RadiusError::Negative { value: -0.5 }));
        for small in [0.0, 9e-7, f32::MIN_POSITIVE] {
            assert_eq!(refused(small), Some(RadiusError::TooSmall { value: small }));
        }
        assert!(matches!(refused(1.1e6), Some(RadiusError::TooLarge { reach }) if reach >= 1.1e6));
        assert!(matches!(refused(f32::MAX), Some(RadiusError::TooLarge { .. })));
    }
    assert!(Sphere::new(1e-6).is_ok() && Sphere::new(1e6).is_ok() && Circle::new(1e6).is_ok());
}

#[test]
fn roundings_that_are_none() {
    let cube = Cuboid::from_half_extents(Vec3::ONE).unwrap();
    let square = Rect::from_half_extents(Vec2::ONE).unwrap();
    let hull = Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z]).unwrap();
    let polygon = Polygon::new(&[Vec2::ZERO, Vec2::X, Vec2::Y]).unwrap();
    let refused = |radius: f32| {
        [
            cube.rounded(radius).err(),
            square.rounded(radius).err(),
            hull.clone().rounded(radius).err(),
            polygon.clone().rounded(radius).err(),
        ]
    };
    for bad in BAD {
        for error in refused(bad) {
            assert!(matches!(error, Some(RadiusError::NotFinite { value }) if same(value, bad)));
        }
    }
    assert_eq!(refused(-1e-9), [Some(RadiusError::Negative { value: -1e-9 }); 4]);
    assert_eq!(refused(0.0), [None; 4], "zero takes the rounding away");
    assert_eq!(refused(1e-30), [None; 4], "a core may be rounded by as little as one likes");
    for error in refused(1e6) {
        assert!(matches!(error, Some(RadiusError::TooLarge { reach }) if reach > 1e6), "{error:?}");
    }
}

#[test]
fn ends_and_corners_that_are_none() {
    for bad in BAD {
        let (spoilt, flat) = (Vec3::new(0.0, bad, 0.0), Vec2::new(bad, 0.0));
        assert_eq!(Segment3::new(Vec3::X, spoilt), Err(VertexError::NotFinite { index: 1 }));
        assert_eq!(Segment2::new(flat, Vec2::X), Err(VertexError::NotFinite { index: 0 }));
        assert_eq!(Triangle3::new(Vec3::X, Vec3::Y, spoilt), Err(VertexError::NotFinite { index: 2 }));
        let capsule = Capsule3::new(spoilt, Vec3::X, 1.0);
        assert_eq!(capsule, Err(CapsuleError::Ends(VertexError::NotFinite { index: 0 })));
        let capsule = Capsule2::new(Vec2::X, flat, 1.0);
        assert_eq!(capsule, Err(CapsuleError::Ends(VertexError::NotFinite { index: 1 })));
        assert!(Capsule3::from_half_height(bad, 1.0).is_err());
    }
    let far = Vec3::X * 1.1e6;
    assert_eq!(Segment3::new(Vec3::ZERO, far), Err(VertexError::TooLarge { index: 1 }));
    assert_eq!(Segment2::new(far.truncate(), Vec2::ZERO), Err(VertexError::TooLarge { index: 0 }));
    assert_eq!(Triangle3::new(Vec3::ZERO, Vec3::Y, far), Err(VertexError::TooLarge { index: 2 }));
    assert_eq!(Segment2::new(Vec2::Y, Vec2::Y), Err(VertexError::Repeated { first: 0, second: 1 }));
    let zeros = Segment3::new(Vec3::ZERO, -Vec3::ZERO);
    assert_eq!(
        zeros,
        Err(VertexError::Repeated { first: 0, second: 1 }),
        "zero and minus zero are one place"
    );
    assert_eq!(Triangle3::new(Vec3::X, Vec3::Y, Vec3::X), Err(VertexError::Repeated { first: 0, second: 2 }));
    assert_eq!(Triangle3::new(Vec3::ZERO, Vec3::X, Vec3::X * 3.0), Err(VertexError::Collinear));
    let sliver = Vec3::new(0.5, 1e-9, 0.0);
    assert_eq!(Triangle3::new(Vec3::ZERO, Vec3::X, sliver), Err(VertexError::Collinear));
    let tiny = |v: Vec3| v * 1e-7;
    assert!(
        matches!(Segment3::new(Vec3::ZERO, tiny(Vec3::X)), Err(VertexError::TooSmall { radius }) if radius < 1e-6)
    );
    assert!(matches!(
        Triangle3::new(Vec3::ZERO, tiny(Vec3::X), tiny(Vec3::Y)),
        Err(VertexError::TooSmall { .. })
    ));
    let reach = Capsule3::new(Vec3::ZERO, Vec3::X * 9e5, 2e5);
    assert!(matches!(reach, Err(CapsuleError::Radius(RadiusError::TooLarge { reach })) if reach >= 1.1e6));
    let no_points = Hull::of_any_dimension(&[]);
    assert!(matches!(no_points, Err(HullError::TooFewPoints { count: 0 })), "{no_points:?}");
}

#[test]
fn directions_and_rays_that_lead_nowhere() {
    for bad in BAD {
        let refused = HalfSpace::new(Vec3::new(0.0, 0.0, bad)).unwrap_err();
        assert!(matches!(refused, DirectionError::NotFinite { axis: 2, value } if same(value, bad)));
        let refused = HalfPlane::new(Vec2::new(bad, 0.0)).unwrap_err();
        assert!(matches!(refused, DirectionError::NotFinite { axis: 0, value } if same(value, bad)));
        let refused = Ray3::new(DVec3::new(0.0, bad.into(), 0.0), Vec3::X).unwrap_err();
        assert!(refused.to_string().contains("not finite"), "{refused}");
        assert!(Ray2::new(DVec2::ZERO, Vec2::new(bad, 1.0)).is_err());
    }
    assert_eq!(HalfSpace::new(-Vec3::ZERO), Err(DirectionError::Zero));
    assert_eq!(HalfPlane::new(Vec2::ZERO), Err(DirectionError::Zero));
    assert!(HalfSpace::new(Vec3::splat(1e-45)).is_ok(), "however short, it points somewhere");
    assert!((HalfSpace::new(Vec3::X * 1e-45).unwrap().unit_normal() - DVec3::X).length() == 0.0);
    let long = HalfSpace::new(Vec3::splat(f32::MAX)).unwrap().unit_normal();
    assert!((long.length() - 1.0).abs() < 1e-15, "and however long");
    let nowhere: RayError = Ray3::new(DVec3::ZERO, Vec3::ZERO).unwrap_err();
    assert!(nowhere.to_string().contains("zero"), "{nowhere}");
    assert!(Ray2::new(DVec2::new(2e9, 0.0), Vec2::X).is_err(), "from beyond the world");
}

#[test]
fn parts_that_make_no_compound() {
    let ball = Shape3::from(Sphere::new(1.0).unwrap());
    let disc = Shape2::from(Circle::new(1.0).unwrap());
    assert_eq!(Compound3::new([]), Err(CompoundError::NoParts));
    assert_eq!(Compound2::new([]), Err(CompoundError::NoParts));
    let many = || (0..4097).map(|_| (Pose3::IDENTITY, ball.clone()));
    assert_eq!(Compound3::new(many()), Err(CompoundError::TooManyParts { count: 4097 }));
    assert_eq!(Compound3::new(many().skip(1)).unwrap().parts().len(), 4096);
    let nested = Shape3::from(Compound3::new([(Pose3::IDENTITY, ball.clone())]).unwrap());
    let refused = Compound3::new([(Pose3::IDENTITY, ball.clone()), (Pose3::IDENTITY, nested)]);
    assert_eq!(refused, Err(CompoundError::Nested { index: 1 }));
    let nested = Shape2::from(Compound2::new([(Pose2::IDENTITY, disc.clone())]).unwrap());
    assert_eq!(Compound2::new([(Pose2::IDENTITY, nested)]), Err(CompoundError::Nested { index: 0 }));
    let floor = Shape3::from(HalfSpace::new(Vec3::Y).unwrap());
    assert_eq!(Compound3::new([(Pose3::IDENTITY, floor)]), Err(CompoundError::Unbounded { index: 0 }));
    let line = Shape2::from(HalfPlane::new(Vec2::Y).unwrap());
    assert_eq!(
        Compound2::new([(Pose2::IDENTITY, disc.clone()), (Pose2::IDENTITY, line)]),
        Err(CompoundError::Unbounded { index: 1 })
    );
    let far = Pose3::at([999_999.5, 0.0, 0.0]).unwrap();
    assert_eq!(Compound3::new([(far, ball.clone())]), Err(CompoundError::TooLarge { index: 0 }));
    let far = Pose2::at([0.0, -1e9]).unwrap();
    assert_eq!(Compound2::new([(far, disc)]), Err(CompoundError::TooLarge { index: 0 }));
    assert!(Compound3::new([(Pose3::at([999_998.5, 0.0, 0.0]).unwrap(), ball)]).is_ok());
}

/// Errors are for people, too: each says what to do about it, and which number or index was wrong.
#[test]
fn messages_say_what_to_do() {
    let messages: [(Box<dyn Error>, [&str; 2]); 14] = [
        (Box::new(RadiusError::NotFinite { value: f32::NAN }), ["NaN", "give"]),
        (Box::new(RadiusError::Negative { value: -0.5 }), ["-0.5", "give"]),
        (Box::new(RadiusError::TooSmall { value: 1e-9 }), ["0.000001 m", "use smaller units"]),
        (Box::new(RadiusError::TooLarge { reach: 2e6 }), ["2000000", "split"]),
        (Box::new(VertexError::NotFinite { index: 2 }), ["2", "finite"]),
        (Box::new(VertexError::TooLarge { index: 1 }), ["1", "split"]),
        (Box::new(VertexError::Repeated { first: 0, second: 2 }), ["0 and 2", "use"]),
        (Box::new(VertexError::Collinear), ["line", "use a segment"]),
        (Box::new(VertexError::TooSmall { radius: 1e-8 }), ["0.00000001", "use smaller units"]),
        (Box::new(DirectionError::NotFinite { axis: 1, value: f32::INFINITY }), ["axis 1", "check"]),
        (Box::new(DirectionError::Zero), ["zero", "give"]),
        (Box::new(CompoundError::TooManyParts { count: 5000 }), ["5000", "several bodies"]),
        (Box::new(CompoundError::Nested { index: 3 }), ["3", "give those instead"]),
        (Box::new(CompoundError::Unbounded { index: 4 }), ["4", "body of its own"]),
    ];
    for (error, parts) in messages {
        let message = error.to_string();
        assert!(parts.iter().all(|part| message.contains(part)), "{message:?} lacks one of {parts:?}");
    }
}
