//! Polygons made from points: hulls, hulls with fewer vertices, and concave outlines split into convex parts, each
//! judged by exact arithmetic over all pairs.

use asunder_geometry::{DecomposeError, Polygon, PolygonError, Shape2, decompose};
use asunder_tests::cases::Random;
use asunder_tests::exact_plane::ExactPlane;
use asunder_tests::fuzzed::{check_decomposition, check_polygons};
use asunder_tests::outlines::{comb, nasty_points, spiral, star, untangled};
use glam::{DVec2, Vec2};

fn outline(points: &[(f32, f32)]) -> Vec<Vec2> {
    points.iter().copied().map(Vec2::from).collect()
}

#[test]
fn hulls_of_nasty_points_are_those_of_gift_wrapping() {
    let mut random = Random::new(3100);
    let (mut hulls, mut spoilt) = (0, 0);
    for _ in 0..6000 {
        let count = 3 + random.below(28);
        let mut points = nasty_points(&mut random, count);
        if random.below(8) == 0 {
            let place = random.below(count);
            points[place].y = random.pick(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1.1e6]);
            assert!(Polygon::hull_of(&points).is_err());
            spoilt += 1;
        }
        check_polygons(&points, 3 + random.below(8));
        hulls += usize::from(Polygon::hull_of(&points).is_ok());
    }
    assert!(hulls > 4000 && spoilt > 500, "{hulls} hulls, {spoilt} spoilt");
}

/// The greatest distance of a hull's vertices from the hull of a subset of them, measured to every side.
fn error_of(hull: &[Vec2], kept: &[usize]) -> f64 {
    let to_side = |p: DVec2, a: DVec2, b: DVec2| {
        let place = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        (p - a - (b - a) * place).length()
    };
    let sides = || (0..kept.len()).map(|i| [kept[i], kept[(i + 1) % kept.len()]].map(|k| hull[k].as_dvec2()));
    let outside = |p: DVec2| {
        if sides().all(|[a, b]| (b - a).perp_dot(p - a) >= 0.0) {
            return 0.0;
        }
        sides().map(|[a, b]| to_side(p, a, b)).fold(f64::INFINITY, f64::min)
    };
    (0..hull.len()).filter(|i| !kept.contains(i)).map(|i| outside(hull[i].as_dvec2())).fold(0.0, f64::max)
}

/// No choice of vertices has much less error, and the stated bound is the error up to rounding.
#[test]
fn simplified_hulls_are_as_good_as_the_best_of_all_choices() {
    let mut random = Random::new(3101);
    let (mut cases, mut worst) = (0, 1.0_f64);
    while cases < 1500 {
        let count = 5 + random.below(25);
        let points = nasty_points(&mut random, count);
        let Ok(hull) = Polygon::hull_of(&points) else { continue };
        let n = hull.vertices().len();
        let limit = 3 + random.below(4);
        if n <= limit || n > 12 {
            continue;
        }
        let Ok(simple) = Polygon::simplify(&points, limit) else { continue };
        let choices = (0_u32..1 << n).filter(|bits| bits.count_ones() as usize == limit);
        let least = choices
            .map(|bits| {
                error_of(hull.vertices(), &(0..n).filter(|i| bits >> i & 1 == 1).collect::<Vec<usize>>())
            })
            .fold(f64::INFINITY, f64::min);
        let kept: Vec<usize> = (0..n).filter(|&i| simple.vertices().contains(&hull.vertices()[i])).collect();
        let found = error_of(hull.vertices(), &kept);
        let extent = points.iter().map(|p| p.as_dvec2().length()).fold(0.0, f64::max);
        let rounding = 1e-13 * extent;
        let bound = f64::from(simple.error());
        assert!(bound >= found - rounding && bound <= found * (1.0 + 2e-7) + rounding + 1e-44, "{points:?}");
        assert!(found <= 1.42 * least + rounding, "{found} is far above {least}: {points:?}, {limit}");
        if found > least + rounding {
            worst = worst.max(found / least);
        }
        cases += 1;
    }
    assert!(worst >= 1.0);
}

/// On a circle of n vertices some chord must span n / k of them, rounded up: nothing better is possible.
#[test]
fn circles_are_simplified_evenly() {
    for (count, limit) in [(1024_usize, 16_usize), (1024, 31), (1000, 7), (4000, 333), (100, 99)] {
        let tips = count / 2;
        let mut random = Random::new(1);
        // The tips of a star lie on a circle; the dents between them do not.
        let circle: Vec<Vec2> = star(&mut random, count).into_iter().step_by(2).take(2 * tips).collect();
        let hull = Polygon::simplify(&circle, 4096).unwrap();
        assert_eq!((hull.vertices().len(), hull.error()), (count, 0.0));
        let simple = Polygon::simplify(&circle, limit).unwrap();
        assert_eq!(simple.vertices().len(), limit);
        let steps = count.div_ceil(limit);
        // The arc's height over a chord that spans this many steps is that of its highest vertex, in the middle or
        // beside it.
        let half = |steps: usize| std::f64::consts::PI * steps as f64 / count as f64;
        let height = |steps: usize| {
            let off_middle = if steps.is_multiple_of(2) { 0.0 } else { half(1) };
            cosine(off_middle) - cosine(half(steps))
        };
        let error = f64::from(simple.error());
        assert!(error >= height(steps) - 1e-6, "{count}, {limit}: {error} is below {}", height(steps));
        assert!(error <= height(steps) * 1.02 + 1e-6, "{count}, {limit}: {error}, not {}", height(steps));
    }
}

fn cosine(angle: f64) -> f64 {
    // Enough terms for angles up to pi.
    let mut term = 1.0;
    (0..24).fold(0.0, |sum, k| {
        let next = sum + term;
        term *= -angle * angle / f64::from((2 * k + 1) * (2 * k + 2));
        next
    })
}

#[test]
fn a_million_points_are_simplified() {
    let mut random = Random::new(3102);
    let disc: Vec<Vec2> = (0..1_000_000).map(|_| (random.direction2() * 100.0).as_vec2()).collect();
    assert!(matches!(Polygon::hull_of(&disc), Err(PolygonError::TooManyVertices { count }) if count > 4096));
    for limit in [4096, 64, 3] {
        let simple = Polygon::simplify(&disc, limit).unwrap();
        assert_eq!(simple.vertices().len(), limit);
        // An arc of 1/k of the circle has this height over its chord; points are dense, so hardly anything better is
        // possible.
        let height = 100.0 * (1.0 - cosine(std::f64::consts::PI / limit as f64));
        let error = f64::from(simple.error());
        assert!(
            error >= 0.9 * height - 1e-4 && error <= 1.1 * height + 1e-4,
            "{limit}: {error}, not {height}"
        );
    }
}

#[test]
fn limits_that_no_polygon_meets_are_refused() {
    let corners = outline(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    for max_vertices in [0, 1, 2, 4097, usize::MAX] {
        let refused = Polygon::simplify(&corners, max_vertices).unwrap_err();
        assert_eq!(refused, PolygonError::LimitOutOfRange { max_vertices });
    }
    assert_eq!(Polygon::simplify(&corners, 3).unwrap(), Polygon::hull_of(&corners).unwrap());
    let message = PolygonError::TooManyVertices { count: 5000 }.to_string();
    assert!(message.contains("5000") && message.contains("Polygon::simplify"), "{message}");
}

/// Slivers have areas and centres that f64 cannot resolve: nothing may become NaN, and the radii stay in order.
#[test]
fn slivers_have_finite_centres() {
    let mut random = Random::new(3103);
    let mut slivers = 0;
    for _ in 0..3000 {
        let width = random.pick(&[1e-7, 1e-12, 1e-20, 1e-38, 1e-45]);
        let length = random.pick(&[1.0, 1e-5, 5e5]);
        let slope = random.pick(&[0.0, 0.5]);
        let points: Vec<Vec2> = (0..3 + random.below(6))
            .map(|_| DVec2::new(length * random.signed(), width * random.signed()))
            .map(|p| DVec2::new(p.x, p.y + slope * p.x).as_vec2())
            .collect();
        check_polygons(&points, 3);
        slivers += usize::from(Polygon::hull_of(&points).is_ok());
    }
    assert!(slivers > 1500, "{slivers}");
}

#[test]
fn the_faults_of_an_outline_are_named() {
    let refused = |points: &[(f32, f32)]| decompose(&outline(points)).unwrap_err();
    let bow_tie = [(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)];
    assert_eq!(refused(&bow_tie), DecomposeError::Crossing { first: 0, second: 2 });
    let on_edge = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 0.0), (0.0, 4.0)];
    assert_eq!(refused(&on_edge), DecomposeError::Touching { vertex: 3, edge: 0 });
    let spike = [(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (2.0, 2.0)];
    assert_eq!(refused(&spike), DecomposeError::Overlapping { first: 0, second: 1 });
    let doubled = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (3.0, 0.0), (1.0, 0.0), (0.0, 2.0)];
    assert!(matches!(
        refused(&doubled),
        DecomposeError::Overlapping { first: 0, second: 3 }
            | DecomposeError::Touching { vertex: 3 | 4, edge: 0 }
    ));
    let pinched = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (2.0, 2.0), (1.0, 1.0), (0.0, 2.0)];
    assert_eq!(refused(&pinched), DecomposeError::Repeated { first: 1, second: 4 });
    assert!(matches!(refused(&[(0.0, 0.0), (1.0, 1.0), (3.0, 3.0)]), DecomposeError::Overlapping { .. }));
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0)]), DecomposeError::TooFewVertices { count: 2 });
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0), (f32::NAN, 1.0)]), DecomposeError::NotFinite { vertex: 2 });
    assert_eq!(refused(&[(0.0, 0.0), (1.0, 0.0), (1e6, 1.0)]), DecomposeError::TooLarge { vertex: 2 });
    assert!(matches!(
        refused(&[(0.0, 0.0), (1e-7, 0.0), (0.0, 1e-7)]),
        DecomposeError::TooSmall { radius } if radius < 1e-6
    ));
    assert_eq!(decompose(&vec![Vec2::ZERO; 4097]), Err(DecomposeError::TooManyVertices { count: 4097 }));
}

/// One ulp is the difference between an outline that touches itself and one that does not.
#[test]
fn one_ulp_decides_between_simple_and_not() {
    let dented = |y: f32| outline(&[(0.0, 0.0), (2.0, 2.0), (2.0, 3.0), (1.0, y), (0.0, 3.0)]);
    assert_eq!(decompose(&dented(1.0)), Err(DecomposeError::Touching { vertex: 3, edge: 0 }));
    // Both sides of the dent turn inwards even without the sliver below it: three parts are the minimum.
    assert_eq!(decompose(&dented(1.0_f32.next_up())).unwrap().parts().len(), 3);
    assert!(matches!(
        decompose(&dented(1.0_f32.next_down())),
        Err(DecomposeError::Crossing { first: 0, .. })
    ));
}

/// Every random outline is rejected exactly when two of its edges meet, and for a true reason.
#[test]
fn outlines_are_refused_exactly_when_they_are_not_simple() {
    let mut random = Random::new(3104);
    let (mut split, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let count = 3 + random.below(5);
        let points = nasty_points(&mut random, count);
        *if check_decomposition(&points).is_ok() { &mut split } else { &mut refused } += 1;
    }
    assert!(split > 2000 && refused > 2000, "{split} split, {refused} refused");
}

#[test]
fn untangled_outlines_are_split_without_gap_or_overlap() {
    let mut random = Random::new(3105);
    let (mut split, mut most) = (0, 0);
    for _ in 0..4000 {
        let count = 4 + random.below(36);
        let mut points = untangled(nasty_points(&mut random, count));
        if random.below(2) == 0 {
            points.reverse();
        }
        if let Ok(parts) = check_decomposition(&points) {
            split += 1;
            most = most.max(parts);
        }
    }
    assert!(split > 2000 && most > 10, "{split} split, {most} parts at the most");
}

#[test]
fn combs_stars_and_spirals_fall_into_few_parts() {
    let mut random = Random::new(3106);
    for teeth in [1, 2, 3, 10, 40] {
        // A convex part reaches into one tooth only, and the bar is one part: at least one part per tooth is needed.
        let parts = check_decomposition(&comb(teeth)).unwrap();
        assert!(parts >= teeth && parts <= 2 * teeth, "{parts} parts for {teeth} teeth");
    }
    for tips in [3, 5, 17, 60] {
        let parts = check_decomposition(&star(&mut random, tips)).unwrap();
        assert!(parts >= tips.div_ceil(2) && parts <= 2 * tips, "{parts} parts for {tips} tips");
    }
    for steps in [10, 50, 90] {
        let parts = check_decomposition(&spiral(steps)).unwrap();
        assert!(parts > steps / 16 && parts <= steps, "{parts} parts for {steps} steps");
    }
}

/// The largest outlines: the parts' areas add up exactly, and each is convex by our own count.
#[test]
fn outlines_of_4096_vertices_are_split() {
    let mut random = Random::new(3107);
    let round: Vec<Vec2> = star(&mut random, 4096).into_iter().step_by(2).collect();
    let saw = {
        let tooth = |i: usize| Vec2::new(i as f32 * 0.01 + (i % 2) as f32 * 20.0, (i % 2) as f32 * 20.0);
        let mut saw: Vec<Vec2> = (0..4095).map(tooth).collect();
        saw.push(Vec2::new(60.0, -20.0));
        saw
    };
    for points in [comb(1024), star(&mut random, 2048), spiral(2048), round, saw] {
        assert!(points.len() > 4080 && points.len() <= 4096);
        let parts = decompose(&points).unwrap();
        let exact = ExactPlane::new(points.iter().map(|p| p.as_dvec2()));
        let all: Vec<usize> = (0..points.len()).collect();
        let signed = exact.doubled_area(&all);
        let mut area = if signed < 0.into() { -signed } else { signed };
        for part in parts.parts() {
            let Shape2::Polygon(polygon) = part.shape() else { panic!("{part:?}") };
            let number = |v: &Vec2| points.iter().position(|p| p == v).unwrap();
            let round: Vec<usize> = polygon.vertices().iter().map(number).collect();
            assert!(round.len() > 500 || exact.is_strictly_convex(&round));
            area -= exact.doubled_area(&round);
        }
        assert_eq!(area, 0.into());
    }
}

/// A bump too small for a shape is left out beside a part that is large enough; a chain of them is rejected.
#[test]
fn parts_too_small_for_a_shape() {
    let step = 1.0 / 8_388_608.0;
    let bump = outline(&[
        (-1.0, 0.0),
        (0.0, 0.0),
        (0.0, -step),
        (2.0 * step, -step),
        (2.0 * step, 0.0),
        (1.0, 0.0),
        (0.0, 1.0),
    ]);
    let parts = decompose(&bump).unwrap();
    assert_eq!(parts.parts().len(), 1, "the bump's radius is 2e-7");
    assert!(parts.contains(Vec2::new(0.0, 0.5)) && !parts.contains(Vec2::new(step, -0.5 * step)));
    // A tail of bends, 4e-7 m each, on a triangle of a metre.
    let mut tail = outline(&[(-1.0, 0.0), (0.0, 0.0)]);
    let bend = |i: i32, side: i32| Vec2::new((i % 2 + side) as f32, -i as f32) * (2.0 * step);
    tail.extend((1..12).map(|i| bend(i, 0)));
    tail.extend((1..12).rev().map(|i| bend(i, 1)));
    tail.extend(outline(&[(2.0 * step, 0.0), (1.0, 0.0), (0.0, 1.0)]));
    let refused = decompose(&tail).unwrap_err();
    assert!(
        matches!(refused, DecomposeError::TooFine { vertex } if (2..24).contains(&vertex)),
        "{refused:?}"
    );
    check_decomposition(&bump).unwrap();
    assert_eq!(check_decomposition(&tail), Err(refused));
}

#[test]
fn what_reaches_too_far_is_refused() {
    // Each vertex is near enough; but the circle about the centre of the whole reaches 1.4e6 m.
    let far = outline(&[(9.9e5, 0.0), (0.0, 9.9e5), (-9.9e5, 0.0)]);
    assert!(Polygon::new(&far).is_ok());
    assert_eq!(check_decomposition(&far), Err(DecomposeError::TooLarge { vertex: 0 }));
    let near: Vec<Vec2> = far.iter().map(|&p| p * 0.5).collect();
    assert_eq!(check_decomposition(&near), Ok(1));
    let message = DecomposeError::Crossing { first: 17, second: 40 }.to_string();
    assert!(message.contains("17") && message.contains("40"), "{message}");
}
