//! Poses relative to others, against points that are transformed by one after the other.

use asunder::glam::{DVec2, DVec3, Quat};
use asunder::{Pose2, Pose3, PoseError, Rotation2};
use asunder_tests::cases::Random;

/// Error of rotations and of rotated points, per metre.
const ROUNDED: f64 = 4.0 / 8_388_608.0;

#[test]
fn a_pose_in_a_pose_takes_points_where_one_after_the_other_does() {
    for seed in 0..20_000 {
        let mut random = Random::new(seed);
        // Quaternions of any length denote rotations, and far from the origin only the precision of f64 is lost.
        let length = random.pick(&[1e-18, 1e-3, 1.0, 1e3, 1e18]);
        let far = random.pick(&[1.0, 1e3, 1e8]);
        let outer = Pose3::new(random.vector() * far, random.quaternion() * length).unwrap();
        let inner = Pose3::new(random.vector(), random.quaternion()).unwrap();
        let point = random.vector();
        let lost = ROUNDED + 8.0 * f64::EPSILON * far;
        let both = outer.compose(&inner).unwrap();
        let off = (both.transform(point) - outer.transform(inner.transform(point))).length();
        assert!(off <= lost, "{seed}: {off}, {outer:?} {inner:?}");
        assert!((5e-4..5e3).contains(&both.rotation().length()), "{seed}: {both:?}");
        let again = both.relative_to(&outer).unwrap();
        let off = (again.transform(point) - inner.transform(point)).length();
        assert!(off <= 2.0 * lost, "{seed}: {off}, {outer:?} {inner:?}");
        let back = Pose3::IDENTITY.relative_to(&outer).unwrap();
        let off = (back.transform(outer.transform(point)) - point).length();
        assert!(off <= ROUNDED * (far + 1.0) + lost, "{seed}: {off}, {outer:?}");
        assert_eq!(outer.relative_to(&outer).unwrap().basis(), Pose3::IDENTITY.basis(), "{seed}");
        assert_eq!(inner.compose(&Pose3::IDENTITY), Ok(inner), "{seed}");
        assert_eq!(Pose3::IDENTITY.compose(&inner), Ok(inner), "{seed}");

        let flat = |random: &mut Random, far: f64| {
            Pose2::new(random.vector().truncate() * far, random.rotation2()).unwrap()
        };
        let (outer, inner) = (flat(&mut random, far), flat(&mut random, 1.0));
        let (both, point) = (outer.compose(&inner).unwrap(), point.truncate());
        let off = (both.transform(point) - outer.transform(inner.transform(point))).length();
        assert!(off <= lost, "{seed}: {off}, {outer:?} {inner:?}");
        let again = both.relative_to(&outer).unwrap();
        let off = (again.transform(point) - inner.transform(point)).length();
        assert!(off <= 2.0 * lost, "{seed}: {off}, {outer:?} {inner:?}");
        assert_eq!(
            (inner.compose(&Pose2::IDENTITY), inner.relative_to(&Pose2::IDENTITY)),
            (Ok(inner), Ok(inner))
        );
    }
}

#[test]
fn a_long_row_of_poses_stretches_nothing() {
    let (mut space, mut plane) = (Pose3::IDENTITY, Pose2::IDENTITY);
    let step = Pose3::new([0.1, 0.0, 0.0], Quat::from_xyzw(0.3, -0.7, 0.2, 1.9)).unwrap();
    let flat = Pose2::new([0.1, 0.0], Rotation2::new(0.8, 0.6).unwrap()).unwrap();
    for _ in 0..100_000 {
        (space, plane) = (space.compose(&step).unwrap(), plane.compose(&flat).unwrap());
    }
    let lengths = [space.turn(DVec3::X).length(), plane.turn(DVec2::X).length()];
    assert!(lengths.iter().all(|length| (length - 1.0).abs() <= ROUNDED), "{lengths:?}");
}

#[test]
fn what_ends_out_of_range_is_refused() {
    let far = Pose3::at([9e8, 0.0, 0.0]).unwrap();
    assert_eq!(far.compose(&far).unwrap_err(), PoseError::PositionTooFar { axis: 0, value: 18e8 });
    let other = Pose3::at([-9e8, 0.0, 0.0]).unwrap();
    assert_eq!(far.relative_to(&other).unwrap_err(), PoseError::PositionTooFar { axis: 0, value: 18e8 });
    let [far, other] = [9e8, -9e8].map(|x| Pose2::at([x, 0.0]).unwrap());
    assert_eq!(far.compose(&far).unwrap_err(), PoseError::PositionTooFar { axis: 0, value: 18e8 });
    assert_eq!(far.relative_to(&other).unwrap_err(), PoseError::PositionTooFar { axis: 0, value: 18e8 });
    // The longest and the shortest quaternions.
    let long = Pose3::new(DVec3::ZERO, Quat::from_array([f32::MAX; 4])).unwrap();
    let short = Pose3::new(DVec3::ZERO, Quat::from_array([f32::from_bits(1); 4])).unwrap();
    for pair in [[long, long], [long, short], [short, short]] {
        let both = pair[0].compose(&pair[1]).unwrap();
        let truth = pair[0].turn(pair[1].turn(DVec3::X));
        assert!((both.turn(DVec3::X) - truth).length() <= ROUNDED, "{pair:?}");
    }
}
