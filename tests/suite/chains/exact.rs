//! Queries about a chain as a set of points.

use asunder_geometry::{Chain, Pose2, Shape2};
use asunder_narrow::{Pair2, Separation2};
use asunder_tests::answers::Asked;
use asunder_tests::bodies::Bodies2;
use asunder_tests::cases::Random;
use asunder_tests::cores::segments;
use asunder_tests::precise;
use asunder_tests::shapes::{CHAINS, KINDS2, PLACES, pair2};
use glam::{DVec2, Vec2};

/// Calls `check` with each chain against every other kind and every chain, in every kind of pose, in both orders.
fn for_all(rounds: usize, seed: u128, mut check: impl FnMut(&Bodies2)) {
    for (a, chain) in CHAINS.iter().enumerate() {
        for (b, other) in KINDS2.iter().chain(&CHAINS).enumerate() {
            for round in 0..rounds {
                let mut random = Random::new(seed + ((a * 100 + b) * 1000 + round) as u128);
                let [first, second] = if round % 2 == 0 { [chain, other] } else { [other, chain] };
                check(&pair2(&mut random, first, second, round % PLACES));
            }
        }
    }
}

fn shapes(bodies: &Bodies2) -> ((&Shape2, &Pose2), (&Shape2, &Pose2)) {
    let case = bodies.case();
    ((&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b))
}

/// The exact simplex oracle cannot handle rounded shapes and half-planes; for those, numbers decide where they are
/// clear.
#[test]
fn yes_or_no_is_exact() {
    let (mut counts, mut asked) = ([0; 2], 0);
    for_all(2 * PLACES, 8100, |bodies| {
        let overlaps = bodies.overlaps();
        let (a, b) = shapes(bodies);
        let truth = precise::separation2(a, b);
        let is_sharp = |shape: &Shape2| {
            matches!(shape, Shape2::Chain(_) | Shape2::Segment(_))
                || matches!(shape, Shape2::Rect(_) | Shape2::Polygon(_)) && shape.radius() == 0.0
        };
        let is_judged = if is_sharp(a.0) && is_sharp(b.0) {
            assert_eq!(overlaps, bodies.exactly_overlaps(), "{truth:?} {bodies:?}");
            true
        } else {
            let is_clear = truth.separation.abs() > truth.bound;
            assert!(!is_clear || overlaps == (truth.separation < 0.0), "{truth:?} {bodies:?}");
            is_clear
        };
        asked += usize::from(is_judged);
        counts[usize::from(overlaps)] += 1;
    });
    assert!(counts.iter().all(|&count| count > 200) && asked > 900, "{counts:?} {asked}");
}

#[test]
fn numbers_are_right_within_their_errors_and_go_with_the_yes_or_no() {
    for_all(PLACES, 8200, |bodies| {
        let (a, b) = shapes(bodies);
        let truth = precise::separation2(a, b);
        let found = bodies.separation(f32::INFINITY).unwrap();
        let off = (found.separation - truth.separation).abs();
        assert!(
            off <= found.error + truth.bound || found.separation == truth.separation,
            "{found:?} {truth:?} {bodies:?}"
        );
        assert_eq!(found.separation <= 0.0, bodies.overlaps(), "{bodies:?}");
        let distance = bodies.distance();
        assert_eq!(distance.is_none(), bodies.overlaps(), "{bodies:?}");
        if let Some(nearest) = distance {
            assert!(
                (nearest.measured.separation - truth.separation).abs()
                    <= nearest.measured.error + truth.bound,
                "{nearest:?} {truth:?}"
            );
        }
    });
}

/// A limit never hides anything within it.
#[test]
fn a_limit_hides_only_what_is_beyond_it() {
    let mut counts = [0; 2];
    for_all(PLACES, 8300, |bodies| {
        let (a, b) = shapes(bodies);
        let pair = Pair2::new(a.0, a.1, b.0, b.1);
        let Separation2::Measured(full) = pair.separation(f32::INFINITY) else { panic!("without a limit") };
        for limit in [0.0, full.separation * 0.5, full.separation * 2.0, 0.1] {
            match pair.separation(limit) {
                Separation2::Measured(found) => {
                    assert!(
                        (found.separation - full.separation).abs() <= found.error + full.error,
                        "{bodies:?}"
                    );
                    counts[0] += 1;
                }
                Separation2::AtLeast(least) => {
                    assert!(
                        full.separation > limit.max(0.0) && least <= full.separation + full.error,
                        "{least} {full:?}"
                    );
                    assert!(least >= limit.max(0.0) * (1.0 - 1e-6), "{least} {limit}");
                    counts[1] += 1;
                }
            }
        }
    });
    assert!(counts.iter().all(|&count| count > 300), "{counts:?}");
}

/// The index finds what a loop over all segments finds.
#[test]
fn a_long_chain_is_the_least_of_its_segments() {
    let mut random = Random::new(8400);
    let mut near = 0;
    for round in 0..40 {
        let vertices: Vec<Vec2> = (0..400)
            .map(|i| DVec2::new(f64::from(i) * 0.3 + random.signed() * 0.4, random.signed() * 2.0).as_vec2())
            .collect();
        let chain = if round % 2 == 0 { Chain::open(vertices) } else { Chain::closed(vertices) }.unwrap();
        let ground = Shape2::from(chain.clone());
        let here = Pose2::new(random.direction2() * 300.0, random.rotation2()).unwrap();
        for kind in &KINDS2 {
            let shape = kind.1(&mut asunder_tests::shapes::Clay::thick(&mut random));
            let local = DVec2::new(random.between(-5.0, 125.0), random.between(-6.0, 6.0));
            let there = Pose2::new(here.transform(local), random.rotation2()).unwrap();
            let pair = Pair2::new(&ground, &here, &shape, &there);
            let each: Vec<Shape2> = segments(&chain).collect();
            let all = || each.iter().map(|segment| Pair2::new(segment, &here, &shape, &there));
            let overlaps = all().any(|pair| pair.overlaps());
            assert_eq!(pair.overlaps(), overlaps, "{}", kind.0);
            near += usize::from(overlaps);
            let least = all()
                .map(|pair| match pair.separation(f32::INFINITY) {
                    Separation2::Measured(found) => found.separation,
                    Separation2::AtLeast(_) => panic!("without a limit"),
                })
                .fold(f32::INFINITY, f32::min);
            let Separation2::Measured(found) = pair.separation(f32::INFINITY) else {
                panic!("without a limit")
            };
            assert!((found.separation - least).abs() <= 2.0 * found.error, "{} {found:?} {least}", kind.0);
            let swapped = Pair2::new(&shape, &there, &ground, &here);
            assert_eq!(swapped.overlaps(), overlaps, "{}", kind.0);
        }
    }
    assert!((80..300).contains(&near), "{near} of 440 overlap");
}

#[test]
fn a_two_sided_chain_that_is_overlapped_always_has_a_point_and_points_lie_on_both() {
    let mut counts = [0; 2];
    for_all(2 * PLACES, 8500, |bodies| {
        let (a, b) = shapes(bodies);
        let is_chain = |shape: &Shape2| matches!(shape, Shape2::Chain(_));
        let has_sides =
            [a.0, b.0].iter().any(|shape| matches!(shape, Shape2::Chain(chain) if chain.is_one_sided()));
        let manifolds = Pair2::new(a.0, a.1, b.0, b.1).manifolds(0.0);
        if is_chain(a.0) && is_chain(b.0) {
            assert!(manifolds.is_empty(), "ground does not stand on ground");
            return;
        }
        let size = bodies.reach();
        if bodies.overlaps() && !has_sides {
            assert!(manifolds.iter().any(|manifold| manifold.separation <= 0.0), "{bodies:?}");
            counts[0] += 1;
        } else if !has_sides {
            assert!(
                manifolds.is_empty() || manifolds.iter().all(|manifold| manifold.separation > 0.0),
                "{bodies:?}"
            );
        }
        for manifold in &manifolds {
            assert!((manifold.normal.length() - 1.0).abs() < 1e-6 && manifold.error.is_finite());
            assert!(!manifold.points.is_empty());
            for point in &manifold.points {
                let (on_a, on_b) = (point.anchor_a.as_dvec2(), point.anchor_b.as_dvec2());
                let between = on_b + (b.1.position() - a.1.position()) - on_a;
                let along = between.dot(manifold.normal.as_dvec2());
                // Anchors are f32: for a pair of very different sizes, they round as the larger one does.
                let slack = 1e-5 * size;
                assert!((along - f64::from(point.separation)).abs() < slack, "{point:?} {bodies:?}");
                counts[1] += 1;
            }
        }
    });
    assert!(counts[0] > 150 && counts[1] > 300, "{counts:?}");
}
