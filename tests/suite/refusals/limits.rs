//! Every field of every constructor: NaN and infinities are rejected anywhere, and so are values just beyond a limit.

use asunder::{Collider2, Collider3, MarginError};
use asunder_geometry::tolerance::{MAX_POSITION, MAX_RADIUS, MIN_RADIUS};
use asunder_geometry::{
    Capsule2, Capsule3, Circle, Cuboid, ExtentError, HalfPlane, HalfSpace, Hull, HullError, Polygon,
    PolygonError, Pose2, Pose3, PoseError, RadiusError, Ray2, Ray3, RayError, Rect, Rotation2, Segment2,
    Segment3, Shape2, Shape3, Sphere, Triangle3, VertexError,
};
use core::fmt::Display;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

const BAD: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// A constructor: its name, valid fields, and a function that applies it to any others.
type Constructor = (&'static str, &'static [f64], fn(&[f64]) -> Result<(), String>);

fn told<T, E: Display>(made: Result<T, E>) -> Result<(), String> {
    made.map(drop).map_err(|error| error.to_string())
}

fn v3(fields: &[f64]) -> Vec3 {
    DVec3::from_slice(fields).as_vec3()
}

fn v2(fields: &[f64]) -> Vec2 {
    DVec2::from_slice(fields).as_vec2()
}

fn points3(fields: &[f64]) -> Vec<Vec3> {
    fields.chunks(3).map(v3).collect()
}

fn points2(fields: &[f64]) -> Vec<Vec2> {
    fields.chunks(2).map(v2).collect()
}

fn cube() -> Cuboid {
    Cuboid::from_half_extents(Vec3::ONE).unwrap()
}

fn square() -> Rect {
    Rect::from_half_extents(Vec2::ONE).unwrap()
}

const TETRAHEDRON: &[f64] = &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
const TRIANGLE: &[f64] = &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0];

const CONSTRUCTORS: [Constructor; 32] = [
    ("Sphere", &[1.0], |f| told(Sphere::new(f[0] as f32))),
    ("Circle", &[1.0], |f| told(Circle::new(f[0] as f32))),
    ("Cuboid", &[1.0, 2.0, 3.0], |f| told(Cuboid::from_half_extents(v3(f)))),
    ("Rect", &[1.0, 2.0], |f| told(Rect::from_half_extents(v2(f)))),
    ("Cuboid::rounded", &[0.1], |f| told(cube().rounded(f[0] as f32))),
    ("Rect::rounded", &[0.1], |f| told(square().rounded(f[0] as f32))),
    ("Capsule3", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 0.5], |f| {
        told(Capsule3::new(v3(f), v3(&f[3..]), f[6] as f32))
    }),
    ("Capsule2", &[0.0, 1.0, 2.0, 3.0, 0.5], |f| told(Capsule2::new(v2(f), v2(&f[2..]), f[4] as f32))),
    ("Capsule3::from_half_height", &[1.0, 0.5], |f| {
        told(Capsule3::from_half_height(f[0] as f32, f[1] as f32))
    }),
    ("Capsule2::from_half_height", &[1.0, 0.5], |f| {
        told(Capsule2::from_half_height(f[0] as f32, f[1] as f32))
    }),
    ("Segment3", &[0.0, 1.0, 2.0, 3.0, 4.0, 5.0], |f| told(Segment3::new(v3(f), v3(&f[3..])))),
    ("Segment2", &[0.0, 1.0, 2.0, 3.0], |f| told(Segment2::new(v2(f), v2(&f[2..])))),
    ("Triangle3", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0], |f| {
        told(Triangle3::new(v3(f), v3(&f[3..]), v3(&f[6..])))
    }),
    ("HalfSpace", &[1.0, 2.0, 3.0], |f| told(HalfSpace::new(v3(f)))),
    ("HalfPlane", &[1.0, 2.0], |f| told(HalfPlane::new(v2(f)))),
    ("Hull::from_points", TETRAHEDRON, |f| told(Hull::from_points(&points3(f)))),
    ("Hull::of_any_dimension", TETRAHEDRON, |f| told(Hull::of_any_dimension(&points3(f)))),
    ("Hull::simplify", TETRAHEDRON, |f| told(Hull::simplify(&points3(f), 4))),
    ("Hull::rounded", &[0.1], |f| {
        told(Hull::from_points(&points3(TETRAHEDRON)).unwrap().rounded(f[0] as f32))
    }),
    ("Polygon", TRIANGLE, |f| told(Polygon::new(&points2(f)))),
    ("Polygon::hull_of", TRIANGLE, |f| told(Polygon::hull_of(&points2(f)))),
    ("Polygon::simplify", TRIANGLE, |f| told(Polygon::simplify(&points2(f), 3))),
    ("Polygon::rounded", &[0.1], |f| told(Polygon::new(&points2(TRIANGLE)).unwrap().rounded(f[0] as f32))),
    ("Pose3", &[1.0, 2.0, 3.0, 0.5, 0.5, 0.5, 0.5], |f| {
        told(Pose3::new(DVec3::from_slice(f), Quat::from_array([3, 4, 5, 6].map(|i| f[i] as f32))))
    }),
    ("Pose2", &[1.0, 2.0], |f| told(Pose2::at(DVec2::from_slice(f)))),
    ("Rotation2", &[1.0, 2.0], |f| told(Rotation2::new(f[0] as f32, f[1] as f32))),
    ("Rotation2::from_angle", &[1.0], |f| told(Rotation2::from_angle(f[0] as f32))),
    ("Ray3", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], |f| told(Ray3::new(DVec3::from_slice(f), v3(&f[3..])))),
    ("Ray2", &[1.0, 2.0, 3.0, 4.0], |f| told(Ray2::new(DVec2::from_slice(f), v2(&f[2..])))),
    ("Collider3::margin", &[0.1], |f| told(Collider3::new(cube()).margin(f[0] as f32))),
    ("Collider2::margin", &[0.1], |f| told(Collider2::new(square()).margin(f[0] as f32))),
    ("mass_properties", &[1.0], |f| {
        told(Shape3::from(cube()).mass_properties(f[0] as f32))?;
        told(Shape2::from(square()).mass_properties(f[0] as f32))
    }),
];

#[test]
fn nothing_that_is_no_number_passes_in_any_field() {
    let mut refused = 0;
    for (name, fields, make) in CONSTRUCTORS {
        assert_eq!(make(fields), Ok(()), "{name}");
        for index in 0..fields.len() {
            for bad in BAD {
                let mut spoilt = fields.to_vec();
                spoilt[index] = bad;
                let message = make(&spoilt).expect_err(&format!("{name} takes {bad} as field {index}"));
                // Two messages say which values are allowed instead, and name the one given.
                let is_told =
                    ["finite", "check", "NaN", "inf", "-inf"].iter().any(|word| message.contains(word));
                assert!(is_told, "{name}, field {index}, {bad}: {message}");
                refused += 1;
            }
        }
    }
    assert!(refused > 300, "{refused}");
}

/// All fields at once, and in pairs with extreme values: nothing panics and nothing invalid passes.
#[test]
fn nothing_extreme_panics_and_what_passes_is_within_the_limits() {
    let extremes = [
        0.0,
        -0.0,
        1e-45,
        -1e-38,
        1e-7,
        9.99e-7,
        1e6,
        1.01e6,
        -1e9,
        1.01e9,
        3e38,
        1e300,
        f64::NAN,
        f64::INFINITY,
    ];
    let (mut passed, mut refused) = (0, 0);
    for (name, fields, make) in CONSTRUCTORS {
        for index in 0..fields.len() {
            for other in 0..fields.len() {
                for one in extremes {
                    for two in extremes {
                        let mut odd = fields.to_vec();
                        (odd[index], odd[other]) = (one, two);
                        let made = make(&odd);
                        let is_number = odd.iter().all(|v| v.is_finite());
                        assert!(is_number || made.is_err(), "{name} takes {odd:?}");
                        assert!(made.as_ref().err().is_none_or(|m| m.len() > 10), "{name}: {made:?}");
                        *if made.is_ok() { &mut passed } else { &mut refused } += 1;
                    }
                }
            }
        }
    }
    assert!(passed > 1000 && refused > 10_000, "{passed} passed, {refused} refused");
}

#[test]
fn a_radius_a_hair_beyond_the_limits_is_refused() {
    assert_eq!((MIN_RADIUS, MAX_RADIUS, MAX_POSITION), (1e-6, 1e6, 1e9), "as the documentation has them");
    let (below, above) = (MIN_RADIUS.next_down(), MAX_RADIUS.next_up());
    for (made, radius) in [MIN_RADIUS, MAX_RADIUS, below, above].map(|r| (Sphere::new(r), r)) {
        assert_eq!(made.is_ok(), (MIN_RADIUS..=MAX_RADIUS).contains(&radius), "{radius}: {made:?}");
    }
    assert_eq!(Sphere::new(below), Err(RadiusError::TooSmall { value: below }));
    assert_eq!(Circle::new(above), Err(RadiusError::TooLarge { reach: above }));
    assert_eq!(Circle::new(below), Err(RadiusError::TooSmall { value: below }));
    // For a rounded core the total reach counts: the corner's distance plus the radius.
    let cube = Cuboid::from_half_extents(Vec3::new(3.0, 4.0, 12.0)).unwrap();
    let most = MAX_RADIUS - 13.0;
    // The bounding radius is rounded up, so that a little is lost below the limit, and nothing gained above it.
    assert!(cube.rounded(most.next_down()).is_ok());
    assert!(
        matches!(cube.rounded(most.next_up()), Err(RadiusError::TooLarge { reach }) if reach > MAX_RADIUS)
    );
    let negative = (-f32::MIN_POSITIVE, Err(RadiusError::Negative { value: -f32::MIN_POSITIVE }));
    assert_eq!(cube.rounded(negative.0), negative.1);
}

#[test]
fn a_corner_a_hair_beyond_the_limits_is_refused() {
    let far = MAX_RADIUS.next_up();
    // 3-4-5: corners exactly at the limit, up to which a bounding radius is rounded.
    let (rect, cuboid) = (Vec2::new(6e5, 8e5), Vec3::new(6e5, 8e5, 1.0));
    assert!(Rect::from_half_extents(rect - Vec2::splat(0.125)).is_ok());
    for axis in 0..2 {
        let mut larger = rect;
        larger[axis] = larger[axis].next_up();
        assert!(matches!(Rect::from_half_extents(larger), Err(ExtentError::TooLarge { .. })), "{larger}");
    }
    assert!(matches!(Cuboid::from_half_extents(cuboid), Err(ExtentError::TooLarge { .. })));
    assert!(Cuboid::from_half_extents(Vec3::new(6e5, 7.9e5, 1.0)).is_ok());
    let small = MIN_RADIUS * 0.577;
    assert!(matches!(Cuboid::from_half_extents(Vec3::splat(small)), Err(ExtentError::TooSmall { .. })));
    assert!(Cuboid::from_half_extents(Vec3::splat(MIN_RADIUS * 0.578)).is_ok());

    let rod = |x: f32| Segment3::new(Vec3::ZERO, Vec3::X * x);
    assert!(rod(MAX_RADIUS).is_ok());
    assert_eq!(rod(far), Err(VertexError::TooLarge { index: 1 }));
    let hull = |x: f32| Hull::from_points(&[Vec3::ZERO, Vec3::Y, Vec3::X * x, Vec3::Z]);
    assert!(hull(-MAX_RADIUS).is_ok());
    assert_eq!(hull(far).unwrap_err(), HullError::TooLarge { index: 2 });
    let polygon = |x: f32| Polygon::new(&[Vec2::ZERO, Vec2::X * x, Vec2::Y]);
    assert!(polygon(MAX_RADIUS).is_ok());
    assert_eq!(polygon(far).unwrap_err(), PolygonError::TooLarge { index: 1 });
    let triangle = Triangle3::new(Vec3::ZERO, Vec3::Y * far, Vec3::X);
    assert_eq!(triangle, Err(VertexError::TooLarge { index: 1 }));
    // Coordinates within the limit are not enough: the distance counts.
    assert_eq!(Segment2::new(Vec2::splat(8e5), Vec2::ZERO), Err(VertexError::TooLarge { index: 0 }));
}

#[test]
fn a_position_a_hair_beyond_the_limit_is_refused() {
    for limit in [MAX_POSITION, -MAX_POSITION] {
        let beyond = if limit > 0.0 { limit.next_up() } else { limit.next_down() };
        for axis in 0..3 {
            let at = |value: f64| {
                let mut place = [0.0; 3];
                place[axis] = value;
                DVec3::from_array(place)
            };
            let refused = PoseError::PositionTooFar { axis, value: beyond };
            assert!(Pose3::at(at(limit)).is_ok() && Ray3::new(at(limit), Vec3::X).is_ok());
            assert_eq!(Pose3::at(at(beyond)), Err(refused));
            assert_eq!(Ray3::new(at(beyond), Vec3::X), Err(RayError::Origin(refused)));
            if axis < 2 {
                assert!(Pose2::at(at(limit).truncate()).is_ok());
                assert_eq!(Pose2::at(at(beyond).truncate()), Err(refused));
                assert_eq!(Ray2::new(at(beyond).truncate(), Vec2::X), Err(RayError::Origin(refused)));
            }
        }
    }
    let cube = || Collider3::new(cube());
    assert!(cube().margin(0.0).is_ok() && cube().margin(MAX_RADIUS).is_ok());
    for bad in [-1e-45, MAX_RADIUS.next_up()] {
        assert_eq!(cube().margin(bad).unwrap_err(), MarginError { value: bad });
    }
}
