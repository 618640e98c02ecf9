//! Invalid shapes and poses are rejected on construction, with an error that says which and where.

mod limits;

use asunder_geometry::{
    Cuboid, ExtentError, Hull, HullError, Polygon, PolygonError, Pose2, Pose3, PoseError, Rect, Rotation2,
};
use asunder_tests::cases::Random;
use core::error::Error;
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

fn outline(points: &[(f32, f32)]) -> Vec<Vec2> {
    points.iter().copied().map(Vec2::from).collect()
}

#[test]
fn outlines_that_are_no_convex_polygon() {
    let refused = |points: &[(f32, f32)]| Polygon::new(&outline(points)).unwrap_err();
    let (nan, infinite) = (f32::NAN, f32::INFINITY);
    assert_eq!(refused(&[]), PolygonError::TooFewPoints { count: 0 });
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0)]), PolygonError::TooFewPoints { count: 2 });
    assert_eq!(
        refused(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.5)]),
        PolygonError::Concave { vertex: 3 },
        "a dart"
    );
    assert_eq!(
        refused(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]),
        PolygonError::Concave { vertex: 1 },
        "a bow tie turns both ways"
    );
    assert_eq!(refused(&[(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)]), PolygonError::Clockwise);
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]), PolygonError::Collinear);
    assert_eq!(
        refused(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (1.0, 0.0)]),
        PolygonError::Repeated { first: 1, second: 3 }
    );
    assert_eq!(refused(&[(0.0, 0.0), (1.0, nan), (0.0, 1.0)]), PolygonError::NotFinite { index: 1 });
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0), (infinite, 1.0)]), PolygonError::NotFinite { index: 2 });
    assert_eq!(refused(&[(0.0, 0.0), (1.1e6, 0.0), (0.0, 1.0)]), PolygonError::TooLarge { index: 1 });
    assert!(matches!(refused(&[(0.0, 0.0), (1e-7, 0.0), (0.0, 1e-7)]), PolygonError::TooSmall { .. }));
    // A star of five points turns left at each, and goes around twice.
    let star = [(0.0, 1.0), (-0.6, -0.8), (0.95, 0.3), (-0.95, 0.3), (0.6, -0.8)];
    assert_eq!(refused(&star), PolygonError::WindsRepeatedly);
    let line = Polygon::hull_of(&outline(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0), (2.0, 2.0)]));
    assert_eq!(line.unwrap_err(), PolygonError::Collinear);
}

/// Any outline that `new` accepts is convex by an independent test, and any convex one is accepted.
#[test]
fn random_outlines_are_refused_exactly_when_they_are_not_convex() {
    let mut random = Random::new(1000);
    let (mut accepted, mut refused) = (0, 0);
    for _ in 0..20_000 {
        // On a lattice of small integers every determinant is exact in f64.
        let points: Vec<DVec2> = (0..3 + random.below(3))
            .map(|_| DVec2::new(random.below(5) as f64, random.below(5) as f64))
            .collect();
        let count = points.len();
        // Convex and counter-clockwise: every other vertex is to the left of every side, or on it between its ends.
        let sides = (0..count).all(|i| {
            let (from, to) = (points[i], points[(i + 1) % count]);
            (0..count).filter(|&k| k != i && k != (i + 1) % count).all(|k| {
                let turn = (to - from).perp_dot(points[k] - from);
                let outside = (points[k] - from).dot(points[k] - to) > 0.0;
                points[k] != from && points[k] != to && from != to && (turn > 0.0 || turn == 0.0 && outside)
            })
        });
        let any_area = (2..count).any(|k| (points[1] - points[0]).perp_dot(points[k] - points[0]) != 0.0);
        let polygon = Polygon::new(&points.iter().map(|p| p.as_vec2()).collect::<Vec<_>>());
        assert_eq!(polygon.is_ok(), sides && any_area, "{points:?}: {polygon:?}");
        *if polygon.is_ok() { &mut accepted } else { &mut refused } += 1;
    }
    assert!(accepted > 500 && refused > 5000, "{accepted} accepted, {refused} refused");
}

#[test]
fn clouds_that_span_no_space() {
    let flat = |shape: fn(DVec3) -> DVec3| {
        let mut random = Random::new(1001);
        let points: Vec<Vec3> = (0..12).map(|_| shape(random.vector()).as_vec3()).collect();
        Hull::from_points(&points).unwrap_err()
    };
    assert_eq!(flat(|_| DVec3::ONE), HullError::Flat { dimension: 0 });
    assert_eq!(flat(|v| DVec3::new(v.x, 2.0 * v.x, -v.x)), HullError::Flat { dimension: 1 });
    assert_eq!(flat(|v| DVec3::new(v.x, v.y, 0.25)), HullError::Flat { dimension: 2 });
    assert_eq!(flat(|v| DVec3::new(v.x, v.y, f64::NAN)), HullError::NotFinite { index: 0 });
    assert_eq!(flat(|v| DVec3::new(2e6, v.y, v.z)), HullError::TooLarge { index: 0 });
    assert!(matches!(flat(|v| v * 1e-8), HullError::TooSmall { .. }));
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y];
    assert_eq!(Hull::from_points(&points).unwrap_err(), HullError::TooFewPoints { count: 3 });
    // Four coplanar corners, and the same with the fourth a rounding off the plane: the second is a hull, however thin.
    let lid = |z: f32| Hull::from_points(&[Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, z)]);
    assert_eq!(lid(0.0).unwrap_err(), HullError::Flat { dimension: 2 });
    assert_eq!(lid(1e-30).unwrap().vertices().len(), 4);
}

#[test]
fn extents_that_enclose_nothing() {
    let cuboid = |x, y, z| Cuboid::from_half_extents(Vec3::new(x, y, z)).unwrap_err();
    let rect = |x, y| Rect::from_half_extents(Vec2::new(x, y)).unwrap_err();
    assert_eq!(cuboid(1.0, 0.0, 1.0), ExtentError::NotPositive { axis: 1, value: 0.0 });
    assert_eq!(cuboid(1.0, 1.0, -2.0), ExtentError::NotPositive { axis: 2, value: -2.0 });
    assert_eq!(cuboid(f32::INFINITY, 1.0, 1.0), ExtentError::NotFinite { axis: 0, value: f32::INFINITY });
    assert!(
        matches!(cuboid(1.0, f32::NAN, 1.0), ExtentError::NotFinite { axis: 1, value } if value.is_nan())
    );
    assert!(matches!(cuboid(1e-8, 1e-8, 1e-8), ExtentError::TooSmall { .. }));
    assert!(matches!(cuboid(1e6, 1.0, 1.0), ExtentError::TooLarge { .. }), "its corners lie beyond");
    assert_eq!(rect(-1.0, 1.0), ExtentError::NotPositive { axis: 0, value: -1.0 });
    assert!(matches!(rect(1.0, f32::NAN), ExtentError::NotFinite { axis: 1, value } if value.is_nan()));
    assert!(matches!(rect(1e-8, 1e-8), ExtentError::TooSmall { .. }));
    assert!(matches!(rect(1e6, 1e6), ExtentError::TooLarge { .. }));
}

#[test]
fn poses_that_are_nowhere() {
    let at = |x: f64, y: f64, z: f64| Pose3::at([x, y, z]);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = |axis: usize, found: PoseError| match found {
            PoseError::PositionNotFinite { axis: found, value } => {
                found == axis && value.to_bits() == bad.to_bits()
            }
            _ => false,
        };
        assert!(refused(0, at(bad, 0.0, 0.0).unwrap_err()));
        assert!(refused(2, at(0.0, 0.0, bad).unwrap_err()));
        assert!(refused(1, Pose2::at([0.0, bad]).unwrap_err()));
    }
    assert_eq!(at(0.0, 1.1e9, 0.0).unwrap_err(), PoseError::PositionTooFar { axis: 1, value: 1.1e9 });
    assert_eq!(Pose2::at([-1.1e9, 0.0]).unwrap_err(), PoseError::PositionTooFar { axis: 0, value: -1.1e9 });
    assert!(at(1e9, -1e9, 1e9).is_ok(), "the limit itself is allowed");

    let turned = |q: [f32; 4]| Pose3::new(Vec3::ZERO, Quat::from_array(q));
    assert_eq!(turned([0.0, -0.0, 0.0, 0.0]).unwrap_err(), PoseError::ZeroRotation);
    let spoilt = turned([0.0, 0.0, f32::NAN, 1.0]).unwrap_err();
    assert!(matches!(spoilt, PoseError::RotationNotFinite { component: 2, value } if value.is_nan()));
    let infinite = PoseError::RotationNotFinite { component: 3, value: f32::INFINITY };
    assert_eq!(turned([0.0, 0.0, 0.0, f32::INFINITY]).unwrap_err(), infinite);
    assert!(turned([1e-45, 0.0, 0.0, 0.0]).is_ok(), "however short, it points somewhere");

    assert_eq!(Rotation2::new(0.0, -0.0).unwrap_err(), PoseError::ZeroRotation);
    let infinite = PoseError::RotationNotFinite { component: 1, value: f32::INFINITY };
    assert_eq!(Rotation2::new(1.0, f32::INFINITY).unwrap_err(), infinite);
    assert!(matches!(Rotation2::from_angle(f32::NAN), Err(PoseError::RotationNotFinite { .. })));
}

/// Errors are for people, too: each says what was wrong with a number, or at which index.
#[test]
fn messages_name_the_place() {
    let messages: [(Box<dyn Error>, &str); 5] = [
        (Box::new(PolygonError::Concave { vertex: 3 }), "3"),
        (Box::new(HullError::NotFinite { index: 12 }), "12"),
        (Box::new(HullError::Flat { dimension: 2 }), "plane"),
        (Box::new(ExtentError::NotPositive { axis: 1, value: -4.5 }), "-4.5"),
        (Box::new(PoseError::PositionTooFar { axis: 2, value: 2e9 }), "2000000000"),
    ];
    for (error, part) in messages {
        assert!(error.to_string().contains(part), "{error}");
    }
}
