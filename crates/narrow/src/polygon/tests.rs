//! Searched supports against a linear scan, kernels against the plain definition, and the number of steps of both.

use super::distance::{Reached, Until, distance};
use super::few;
use super::outline::{Outline, Turn};
use super::sat::{Axes, Outcome, Sides, Wanted, doubt, plain, separating_axes, sides};
use super::search;
use crate::Pair2;
use crate::counted::steps_of;
use crate::feature::Hint;
use crate::precision::{IN_PLANE, Precision};
use asunder_geometry::glam::{DVec2, Vec2};
use asunder_geometry::{Circle, Polygon, Pose2, Rotation2, Segment2, Shape2};
use oorandom::Rand64;

const U: f64 = f64::EPSILON / 2.0;

struct Random(Rand64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0.rand_float()
    }

    fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn angle(&mut self) -> f64 {
        core::f64::consts::TAU * self.unit()
    }

    fn turn(&mut self) -> Turn {
        let turn = [self.signed(), self.signed()].map(|value| value as f32);
        Turn::of([Rotation2::new(turn[0], turn[1] + 2.0), Rotation2::new(1.0, 0.0)][self.below(2)].unwrap())
    }
}

/// The vector from the origin at an angle: a rational point of the unit circle, so that no trigonometry is needed.
fn on_circle(angle: f64) -> DVec2 {
    let (quarter, rest) =
        ((angle / core::f64::consts::FRAC_PI_2).floor(), angle % core::f64::consts::FRAC_PI_2);
    let t = rest / core::f64::consts::FRAC_PI_2;
    let point = DVec2::new(1.0 - t * t, 2.0 * t) / (1.0 + t * t);
    (0..quarter as i64).fold(point, |point, _| point.perp())
}

/// Polygons that are hard for a search by angles: round, needles, shrinking steps, edges that are almost parallel, far
/// from their origin.
fn outlines(random: &mut Random) -> Vec<Vec2> {
    let count = [17, 20, 33, 64, 300, 4096][random.below(6)];
    let angle = |i: usize| core::f64::consts::TAU * i as f64 / count as f64;
    let points: Vec<DVec2> = match random.below(6) {
        0 => (0..count).map(|i| on_circle(angle(i))).collect(),
        1 => (0..count).map(|_| on_circle(random.angle())).collect(),
        2 => {
            let thin = [1e-3, 1e-6, 1e-12, 1e-30, 1e-42][random.below(5)];
            (0..count).map(|i| on_circle(angle(i)) * DVec2::new(1.0, thin)).collect()
        }
        3 => (0..count.min(90))
            .map(|i| on_circle(core::f64::consts::PI * (0..i).fold(1.0, |share, _| 0.8 * share)))
            .collect(),
        4 => {
            // All edges but one within some 1e-6 rad of each other.
            let flat = [1e-4, 1e-7, 1e-20][random.below(3)];
            (0..count)
                .map(|i| i as f64 / count as f64)
                .map(|x| DVec2::new(x, flat * x * x))
                .chain([DVec2::new(0.3, random.unit())])
                .collect()
        }
        _ => (0..count).map(|i| on_circle(angle(i)) + DVec2::new(1000.0, -3000.0)).collect(),
    };
    let turn = on_circle([0.0, random.angle()][random.below(2)]);
    points.into_iter().map(|point| turn.rotate(point).as_vec2()).collect()
}

/// A polygon whose supports are searched.
fn polygon(random: &mut Random) -> Shape2 {
    loop {
        if let Ok(polygon) = Polygon::hull_of(&outlines(random))
            && polygon.vertices().len() > 16
        {
            return polygon.into();
        }
    }
}

/// Directions along which neighbours tie or nearly do, and others.
fn directions(random: &mut Random, outline: &Outline) -> Vec<DVec2> {
    let mut directions = vec![DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y];
    for _ in 0..20 {
        let normal = outline.normal(random.below(outline.edge_count()));
        let beside = normal + DVec2::new(random.signed(), random.signed()) * 1e-16;
        directions.extend([normal, -normal, beside, on_circle(random.angle()) * 1e-6]);
    }
    directions
}

#[test]
fn a_searched_support_is_as_far_as_the_furthest_vertex() {
    let mut random = Random(Rand64::new(41));
    let (mut worst, mut ties) = (0.0_f64, 0);
    for _ in 0..600 {
        let shape = polygon(&mut random);
        let core = shape.core();
        let outline = Outline::new(&shape, &core, random.turn(), DVec2::new(0.5, -3.0));
        let furthest_out = core.vertices().iter().map(|v| v.as_dvec2().length()).fold(0.0, f64::max);
        for direction in directions(&mut random, &outline) {
            let near = random.below(core.vertices().len());
            for near in [None, Some(near)] {
                let (found, steps) = steps_of(|| outline.support_near(direction, near));
                let reach = |vertex: usize| direction.dot(outline.point(vertex));
                let furthest = (0..core.vertices().len()).map(reach).fold(f64::NEG_INFINITY, f64::max);
                let short = furthest - reach(found.vertex);
                // What a search may lose, and this comparison's own rounding.
                let size = f64::from(shape.outer_radius());
                let bound = U * direction.length() * (4.0 * size + 8.0 * (furthest_out + 4.0));
                assert!(short <= bound, "{short:e} above {bound:e}: {direction:?}, {shape:?}");
                assert!(steps <= 15, "{steps} steps");
                let again = steps_of(|| outline.support_near(direction, Some(found.vertex)));
                assert!(again.0.vertex == found.vertex && again.1 <= 2, "it knows that it is the furthest");
                (worst, ties) = (worst.max(short / bound), ties + usize::from(short != 0.0));
            }
        }
    }
    assert!(ties > 0, "no direction was hard: {worst}");
}

fn precision(a: &Shape2, b: &Shape2, offset: DVec2) -> Precision {
    let center = |shape: &Shape2| shape.center().as_dvec2().length();
    let size = f64::from(a.outer_radius() + b.outer_radius());
    let reach = size + center(a) + center(b) + 1.5 * offset.length();
    Precision { size, reach, planarity: 0.0, roundings: IN_PLANE.of_bodies + 4.0 }
}

/// Two polygons of up to `most` vertices, with B's centre at some share of both radii.
fn pair(random: &mut Random, most: usize) -> ([Shape2; 2], [Turn; 2], DVec2) {
    let mut shape = || loop {
        let points = outlines(random);
        let few = &points[..points.len().min(most)];
        if let Ok(polygon) = Polygon::hull_of(few) {
            return Shape2::from(polygon);
        }
    };
    let shapes = [shape(), shape()];
    let turns = [random.turn(), random.turn()];
    let way = on_circle(random.angle())
        * random.unit()
        * f64::from(shapes[0].outer_radius() + shapes[1].outer_radius());
    let center = |i: usize| turns[i].turn(shapes[i].center().as_dvec2());
    let offset = center(0) - center(1) + way;
    (shapes, turns, offset)
}

/// Whichever kernel runs, the best axis is the plain definition's up to rounding, and nothing within the band is
/// missing.
#[test]
fn kernels_find_the_best_axis_of_all() {
    let mut random = Random(Rand64::new(42));
    let (mut deep, mut apart, mut gaps) = (0, 0, 0);
    for round in 0..3000 {
        let most = [8, 16, 40, 200][round % 4];
        let ([shape_a, shape_b], [turn_a, turn_b], offset) = pair(&mut random, most);
        let (core_a, core_b) = (shape_a.core(), shape_b.core());
        let a = Outline::new(&shape_a, &core_a, turn_a, DVec2::ZERO);
        let b = Outline::new(&shape_b, &core_b, turn_b, offset);
        let precision = precision(&shape_a, &shape_b, offset);
        let doubt = doubt(&precision);
        let truth = plain(&a, &b);
        let towards_b = random.signed() * DVec2::X + random.signed() * DVec2::Y;
        let limit = [0.0, f64::INFINITY][round / 4 % 2];
        let band = [doubt, 0.01 * precision.size][round / 8 % 2].max(doubt);
        let wanted = Wanted { limit, band, hint: Hint::NONE, towards_b, precision: &precision };
        let check = |found: &Axes| {
            let (best, known) = (found.best().separation, truth.best().separation);
            assert!((best - known).abs() <= doubt, "{best} is not {known}: {shape_a:?} {shape_b:?}");
            assert!(found.short >= known - best, "{found:?}, {known}");
            for (found, known) in [(&found.edge_a, &truth.edge_a), (&found.edge_b, &truth.edge_b)] {
                if known.separation >= best - band + doubt {
                    assert!(
                        (found.separation - known.separation).abs() <= doubt,
                        "{found:?} is not {known:?}"
                    );
                }
            }
        };
        for outcome in [separating_axes(&a, &b, &wanted), search::separating_axes(&a, &b, None, &wanted)] {
            match outcome {
                Outcome::Within(axes) => {
                    check(&axes);
                    deep += 1;
                }
                Outcome::Beyond(separation, _) => {
                    assert!(separation > limit && truth.best().separation > -doubt);
                    apart += 1;
                }
                Outcome::Gap(separation, normal) => {
                    let shown = -b.support(-normal).reach - a.support(normal).reach;
                    assert!((shown - separation).abs() <= doubt && separation > 0.0);
                    let reached = distance(&a, &b, normal, &Until::met(&precision));
                    // The distance is known up to 1e-12 of size; the band must be wider.
                    if let Reached::Between(witness) = reached
                        && band > 1e-3 * precision.size
                    {
                        check(&search::beside(&a, &b, witness.normal, truth.best().separation - band));
                        gaps += 1;
                    }
                }
            }
        }
        for found in [sides(&a, &b, towards_b, doubt), search::sides(&a, &b, towards_b, doubt)] {
            match found {
                Sides::Apart => assert!(truth.best().separation > 0.0),
                Sides::Overlapping => assert!(truth.best().separation < 0.0),
                Sides::Unclear => assert!(truth.best().separation.abs() <= 2.0 * doubt),
            }
        }
        if most <= 8 {
            let found =
                [few::sides([&a.few::<8>(), &b.few()], doubt), few::sides([&a.few::<16>(), &b.few()], doubt)];
            assert_eq!(found[0], found[1]);
        }
    }
    assert!(deep > 1000 && apart > 500 && gaps > 200, "{deep} {apart} {gaps}");
}

fn round(count: usize) -> Shape2 {
    let points: Vec<Vec2> =
        (0..count).map(|i| on_circle(core::f64::consts::TAU * i as f64 / count as f64).as_vec2()).collect();
    Polygon::hull_of(&points).unwrap().into()
}

/// Steps of a yes or no, and of a best axis, for two round polygons whose centres are `offset` apart.
fn steps(count: usize, offset: DVec2) -> [usize; 2] {
    let shape = round(count);
    assert_eq!(shape.core().vertices().len(), count);
    let core = shape.core();
    let turn = Turn::of(Rotation2::new(0.8, 0.6).unwrap());
    let a = Outline::new(&shape, &core, turn, DVec2::ZERO);
    let b = Outline::new(&shape, &core, Turn::of(Rotation2::IDENTITY), offset);
    let precision = precision(&shape, &shape, offset);
    let doubt = doubt(&precision);
    let towards_b = DVec2::new(1.0, 0.3);
    let wanted = Wanted { limit: 0.0, band: doubt, hint: Hint::NONE, towards_b, precision: &precision };
    let (_, one) = steps_of(|| sides(&a, &b, towards_b, doubt));
    let (_, other) = steps_of(|| separating_axes(&a, &b, &wanted));
    [one, other]
}

/// Counted, not timed: for pairs apart or lightly overlapping, sixteen times the vertices cost at most twice the steps;
/// on one centre, where no edge is better than another, a best axis costs in proportion to them.
#[test]
fn cost_grows_as_the_logarithm_apart_and_as_the_vertices_deep_inside() {
    for offset in [DVec2::new(2.1, 0.3), DVec2::new(1.9, 0.2), DVec2::new(1.2, -0.7), DVec2::new(5.0, 9.0)] {
        let [few, many] = [256, 4096].map(|count| steps(count, offset));
        assert!(many[0] <= 2 * few[0] && many[0] < 300, "yes or no at {offset:?}: {few:?}, {many:?}");
        assert!(many[1] <= 2 * few[1] && many[1] < 1000, "best axis at {offset:?}: {few:?}, {many:?}");
    }
    for offset in [DVec2::ZERO, DVec2::new(1e-9, 0.0), DVec2::new(1e-4, 1e-4)] {
        let [few, many] = [256, 4096].map(|count| steps(count, offset));
        assert!(many[0] < 200, "yes or no at {offset:?}: {few:?}, {many:?}");
        assert!(many[1] <= 20 * few[1] && many[1] < 8 * 4096, "best axis at {offset:?}: {few:?}, {many:?}");
    }
}

/// No pair of the largest polygons, however thin, flat, uneven or deep, costs the product of the vertex counts.
#[test]
fn no_pair_of_large_polygons_is_quadratic() {
    let mut random = Random(Rand64::new(43));
    let (mut most, mut large) = (0.0_f64, 0);
    for _ in 0..400 {
        let ([shape_a, shape_b], [turn_a, turn_b], offset) = pair(&mut random, usize::MAX);
        let edges = shape_a.core().vertices().len() + shape_b.core().vertices().len();
        let (core_a, core_b) = (shape_a.core(), shape_b.core());
        let a = Outline::new(&shape_a, &core_a, turn_a, DVec2::ZERO);
        let precision = precision(&shape_a, &shape_b, offset);
        for offset in [offset, offset * 0.1, DVec2::ZERO] {
            let b = Outline::new(&shape_b, &core_b, turn_b, offset);
            let band = doubt(&precision);
            let wanted = Wanted {
                limit: f64::INFINITY,
                band,
                hint: Hint::NONE,
                towards_b: DVec2::Y,
                precision: &precision,
            };
            let (_, steps) = steps_of(|| separating_axes(&a, &b, &wanted));
            assert!(steps <= 8 * edges + 200, "{steps} steps for {edges} edges");
            most = most.max(steps as f64 / edges as f64);
        }
        large += usize::from(edges > 600);
    }
    assert!(large > 50, "{large} large ones, {most} steps an edge");
}

/// Asks every question there is, with no limit on the distance: the whole outlines lie within the margin.
#[test]
fn no_question_about_large_polygons_is_quadratic() {
    let mut random = Random(Rand64::new(44));
    let (mut large, mut worst) = (0, 0.0_f64);
    for round in 0..300 {
        let (shape_a, shape_b) = (polygon(&mut random), polygon(&mut random));
        let edges = shape_a.core().vertices().len() + shape_b.core().vertices().len();
        let reach = f64::from(shape_a.outer_radius() + shape_b.outer_radius());
        let centers = shape_a.center().as_dvec2() - shape_b.center().as_dvec2();
        let turn = Rotation2::new(1.0, [0.0, 1e-4][round / 2 % 2]).unwrap();
        let away = on_circle(random.angle()) * reach * [0.0, 1e-5, 0.3, 1.0, 3.0][round % 5];
        let (here, there) = (Pose2::IDENTITY, Pose2::new(centers + away, turn).unwrap());
        let pair = Pair2::new(&shape_a, &here, &shape_b, &there);
        let (apart, of_distance) = steps_of(|| pair.distance().is_some());
        let steps = [
            of_distance,
            steps_of(|| pair.separation(f32::INFINITY)).1,
            steps_of(|| pair.manifold(1e6)).1,
            steps_of(|| pair.overlaps()).1,
        ];
        let most = steps.into_iter().max().unwrap();
        assert!(most <= 30 * edges + 2000, "{steps:?} steps for {edges} edges, apart: {apart}");
        worst = worst.max(most as f64 / edges as f64);
        large += usize::from(edges > 2000);
    }
    assert!(large > 10, "{large} large ones, {worst} steps an edge");
}

/// An axis that separated them still does: two supports show it, however large the polygons.
#[test]
fn the_hint_of_a_pair_apart_saves_its_search() {
    let mut random = Random(Rand64::new(45));
    let (mut cases, mut searched, mut hinted) = (0, 0, 0);
    for _ in 0..2000 {
        let ([shape_a, shape_b], [turn_a, turn_b], offset) = pair(&mut random, usize::MAX);
        let (core_a, core_b) = (shape_a.core(), shape_b.core());
        let a = Outline::new(&shape_a, &core_a, turn_a, DVec2::ZERO);
        let b = Outline::new(&shape_b, &core_b, turn_b, offset);
        let precision = precision(&shape_a, &shape_b, offset);
        let towards_b = on_circle(random.angle());
        let band = doubt(&precision);
        let wanted = Wanted { limit: band, band, hint: Hint::NONE, towards_b, precision: &precision };
        let (first, steps) = steps_of(|| separating_axes(&a, &b, &wanted));
        let Outcome::Beyond(separation, hint) = first else { continue };
        // A stored direction is rounded to f32, which turns the reach by as much.
        if separation < 1e-6 * precision.reach {
            continue;
        }
        let (again, steps_again) = steps_of(|| separating_axes(&a, &b, &Wanted { hint, ..wanted }));
        assert!(matches!(again, Outcome::Beyond(_, kept) if kept == hint), "{shape_a:?}, {shape_b:?}");
        assert!(steps_again <= 4 * 13, "{steps_again} steps");
        cases += 1;
        (searched, hinted) = (searched + steps, hinted + steps_again);
    }
    assert!(cases > 200 && 2 * hinted < searched, "{cases} cases: {searched} steps, {hinted} with a hint");
}

/// The best edge, one edge and one vertex after the other: the definition that the lanes must match.
fn one_by_one(a: &Outline, b: &Outline) -> (f64, usize) {
    let separation = |edge: usize| {
        let normal = a.outward(edge);
        let along = (0..b.vertices.len()).map(|vertex| normal.dot(b.point(vertex)));
        along.fold(f64::INFINITY, f64::min) - normal.dot(a.point(edge))
    };
    let separations = (0..a.edge_count()).map(|edge| (separation(edge), edge));
    separations.fold((f64::NEG_INFINITY, 0), |best, next| if next.0 > best.0 { next } else { best })
}

#[test]
fn lanes_give_the_bits_of_one_edge_after_the_other() {
    let mut random = Random(Rand64::new(46));
    for round in 0..4000 {
        let ([mut shape_a, shape_b], [turn_a, turn_b], offset) = pair(&mut random, [8, 16][round % 2]);
        if round % 5 == 0 {
            let from = Vec2::new(random.unit() as f32, 0.25);
            shape_a = Segment2::new(from, -from).unwrap().into();
        } else if round % 5 == 1 {
            shape_a = Circle::new(0.5).unwrap().into();
        }
        let (core_a, core_b) = (shape_a.core(), shape_b.core());
        let a = Outline::new(&shape_a, &core_a, turn_a, DVec2::ZERO);
        let b = Outline::new(&shape_b, &core_b, turn_b, offset);
        let expected = [one_by_one(&a, &b), one_by_one(&b, &a)];
        let (wide_a, wide_b) = (a.few::<16>(), b.few::<16>());
        assert_eq!([wide_a.best(&wide_b), wide_b.best(&wide_a)], expected, "{shape_a:?}, {shape_b:?}");
        if a.vertices.len().max(b.vertices.len()) <= 8 {
            let (narrow_a, narrow_b) = (a.few::<8>(), b.few::<8>());
            assert_eq!([narrow_a.best(&narrow_b), narrow_b.best(&narrow_a)], expected);
        }
    }
}

/// Symptom: a pebble hundreds of thousands of kilometres away was reported 1e-45 m from another, with NaN for closest
/// points. Cause: out there both ends of an edge of 28 nm round to one point, and a place along it was zero over zero.
#[test]
fn an_edge_that_rounds_to_a_point_far_out_is_no_place_to_be() {
    let outline = [[-0.552, -0.674], [-0.526, -0.684], [0.258, -0.666], [0.556, -0.364], [-1.0, 1.0]];
    let pebble: Shape2 = Polygon::new(&outline.map(|point| Vec2::from(point) * 1e-6)).unwrap().into();
    let other: Shape2 = Circle::new(1e-6).unwrap().into();
    let mut random = Random(Rand64::new(47));
    for _ in 0..2000 {
        // Along the short edge's normal, where it is the best axis.
        let offset = DVec2::new(0.01 + 1e-3 * random.signed(), 0.026) * (1e10 * (2.0 + random.unit()));
        let (here, there) = (Pose2::IDENTITY, Pose2::at(offset).unwrap());
        for (one, two) in [(&pebble, &other), (&other, &pebble), (&pebble, &pebble)] {
            let closest = Pair2::new(one, &here, two, &there).distance().unwrap();
            let distance = f64::from(closest.distance);
            assert!((distance - offset.length()).abs() <= f64::from(closest.error) + 4e-6, "{closest:?}");
            assert!(closest.anchor_a.is_finite() && closest.anchor_b.is_finite(), "{closest:?}");
        }
    }
}
