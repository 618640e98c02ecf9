//! Shapes whose centre, rounded to f32, lies outside them.

use asunder_geometry::{Capsule2, Circle, Polygon, Pose2, Segment2, Shape2};
use asunder_narrow::{Pair2, Separation2};
use asunder_tests::cases::Random;
use asunder_tests::exact_overlap::exact_overlap2;
use glam::{DVec2, Vec2};

/// Symptom: `overlaps` of a capsule and a circle returned true across a gap of 1e-5 m, and no query agreed with the
/// world. Cause: a circle of the capsule's radius about its centre was taken to lie inside it; for a capsule a hundred
/// metres from its own origin, the centre is rounded by 4e-6 m.
#[test]
fn a_capsule_that_lies_far_from_its_origin_is_not_met_beside_it() {
    let mut random = Random::new(1127);
    let (mut apart, mut touching) = (0, 0);
    for round in 0..30_000 {
        let radius = [0.01, 0.05, 1.0][round % 3];
        let far = [8.0, 70.0, 200.0, 3e4][round / 3 % 4];
        let from = DVec2::new(random.signed(), random.signed()) * far;
        let along = DVec2::new(random.signed(), random.signed()) * [0.5, 2.0][round % 2];
        let (from, to) = (from.as_vec2(), (from + along).as_vec2());
        let (Ok(segment), Ok(capsule)) = (Segment2::new(from, to), Capsule2::new(from, to, radius)) else {
            continue;
        };
        let (shape, thick): (Shape2, f64) =
            if round % 5 == 0 { (segment.into(), 0.0) } else { (capsule.into(), radius.into()) };
        let ball: Shape2 = Circle::new(radius).unwrap().into();
        // Beside the true centre, closer to touching than the centre's rounding.
        let middle = (from.as_dvec2() + to.as_dvec2()) * 0.5;
        let side = (to - from).as_dvec2().perp().normalize();
        let gap = random.signed() * 2e-8 * far;
        let there = Pose2::at(middle + side * (thick + f64::from(radius) + gap)).unwrap();
        let exact = exact_overlap2((&shape, &Pose2::IDENTITY), (&ball, &there));
        let pair = Pair2::new(&shape, &Pose2::IDENTITY, &ball, &there);
        assert_eq!(pair.overlaps(), exact, "{shape:?} {there:?}");
        assert_eq!(pair.distance().is_none(), exact, "{shape:?} {there:?}");
        let Separation2::Measured(found) = pair.separation(f32::INFINITY) else { panic!("no limit") };
        assert_eq!(found.separation <= 0.0, exact, "{found:?}");
        *if exact { &mut touching } else { &mut apart } += 1;
    }
    assert!(apart > 10_000 && touching > 10_000, "{apart}, {touching}");
}

/// Symptom: the same for a rounded sliver. Cause: where the centre lay outside, the inscribed circle was given the size
/// of the rounding.
#[test]
fn a_rounded_sliver_is_not_met_beside_it() {
    let ulp = 8.0 * f32::EPSILON;
    let mut outside = 0;
    for step in 1..400_u16 {
        let [x, y] = [8.0 + f32::from(step % 20) * 0.37, 8.0 + f32::from(step / 20) * 0.41];
        let corners =
            [(x, y), (x + 1.0 + 3.0 * ulp, y + 1.0), (x + 1.0 + 2.0 * ulp, y + 1.0)].map(Vec2::from);
        let Ok(sharp) = Polygon::hull_of(&corners) else { continue };
        let is_beside = !sharp.contains(sharp.center());
        outside += usize::from(is_beside);
        let sliver = sharp.rounded(0.01).unwrap();
        let (center, inner) = (sliver.center().as_dvec2(), f64::from(sliver.inner_radius()));
        assert!(inner < 0.01 || !is_beside, "{sliver:?}");
        for way in 0..16 {
            // Eighths of a turn, and the directions between as sums of two neighbours.
            let ring = [DVec2::X, DVec2::ONE, DVec2::Y, DVec2::new(-1.0, 1.0)];
            let way = (ring[way % 4] + ring[(way + 1) % 4] * f64::from(u8::from(way > 7))).normalize()
                * if way / 4 % 2 == 0 { 1.0 } else { -1.0 };
            assert!(sliver.contains(center + way * (inner * (1.0 - 1e-12))), "{sliver:?} {way}");
            let ball: Shape2 = Circle::new(0.01).unwrap().into();
            for gap in [-3e-7, -1e-7, 1e-7, 3e-7] {
                let there = Pose2::at(center + way * (0.02 + gap)).unwrap();
                let shape: Shape2 = sliver.clone().into();
                let pair = Pair2::new(&shape, &Pose2::IDENTITY, &ball, &there);
                let exact = exact_overlap2((&shape, &Pose2::IDENTITY), (&ball, &there));
                assert_eq!(pair.overlaps(), exact, "{sliver:?} {there:?}");
            }
        }
    }
    assert!(outside > 100, "{outside}");
}
