//! The exact oracle: fast against slow, rounded shapes against closed forms in integers, compounds against their parts.

use asunder_geometry::{
    Capsule2, Capsule3, Circle, Compound2, Compound3, Cuboid, HalfPlane, HalfSpace, Hull, Polygon, Pose2,
    Pose3, Rect, Rotation2, Segment3, Shape2, Shape3, Sphere, Triangle3,
};
use asunder_tests::cases::Random;
use asunder_tests::exact::distance::distance_to_radius;
use asunder_tests::exact::place::{Cores, Piece, pieces3};
use asunder_tests::exact::share::{Guess, share_point};
use asunder_tests::exact_overlap::{
    Relation, exact_overlap2, exact_overlap3, exact_relation2, exact_relation3, full_program2, full_program3,
};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};
use std::cmp::Ordering;

fn lattice_point(random: &mut Random, below: usize) -> Vec3 {
    Vec3::from_array([0; 3].map(|_| random.below(below) as f32))
}

fn lattice_hull(random: &mut Random) -> Shape3 {
    loop {
        let count = 4 + random.below(5);
        let points: Vec<Vec3> = (0..count).map(|_| lattice_point(random, 5)).collect();
        if let Ok(hull) = Hull::from_points(&points) {
            return hull.into();
        }
    }
}

/// A rotation by a quaternion of small integers: a rational one.
fn lattice_turn(random: &mut Random) -> Quat {
    loop {
        let q = [0; 4].map(|_| random.below(4) as f32 - 1.0);
        if q != [0.0; 4] {
            return Quat::from_array(q);
        }
    }
}

/// The expected relation, given how a distance compares with a limit.
fn relation_of(order: Ordering) -> Relation {
    match order {
        Ordering::Greater => Relation::Apart,
        Ordering::Equal => Relation::Touching,
        Ordering::Less => Relation::Overlapping,
    }
}

#[test]
fn guesses_that_are_proved_agree_with_the_full_program() {
    let mut random = Random::new(901);
    let mut touching = [0; 2];
    for round in 0..2000 {
        let (a, b) = (lattice_hull(&mut random), lattice_hull(&mut random));
        let at = lattice_point(&mut random, 9).as_dvec3() - 4.0;
        // The same rotation for both keeps their lattices aligned, so that they often touch.
        let turn = lattice_turn(&mut random);
        let other = if round % 2 == 0 { turn } else { lattice_turn(&mut random) };
        let (pose_a, pose_b) = (Pose3::new(DVec3::ZERO, turn).unwrap(), Pose3::new(at, other).unwrap());
        let full = full_program3((&a, &pose_a), (&b, &pose_b));
        assert_eq!(
            exact_overlap3((&a, &pose_a), (&b, &pose_b)),
            full,
            "{round}: {a:?} {pose_a:?} {b:?} {pose_b:?}"
        );
        let relation = exact_relation3((&a, &pose_a), (&b, &pose_b));
        assert_eq!(relation != Relation::Apart, full);
        touching[0] += usize::from(relation == Relation::Touching);

        let mut polygon = || loop {
            let points: Vec<Vec2> = (0..6).map(|_| lattice_point(&mut random, 6).truncate()).collect();
            if let Ok(polygon) = Polygon::hull_of(&points) {
                return Shape2::from(polygon);
            }
        };
        let (a, b) = (polygon(), polygon());
        let (pose_a, pose_b) = (Pose2::IDENTITY, Pose2::at(at.truncate()).unwrap());
        let full = full_program2((&a, &pose_a), (&b, &pose_b));
        assert_eq!(exact_overlap2((&a, &pose_a), (&b, &pose_b)), full, "{round}: {a:?} {b:?} {pose_b:?}");
        let relation = exact_relation2((&a, &pose_a), (&b, &pose_b));
        assert_eq!(relation != Relation::Apart, full);
        touching[1] += usize::from(relation == Relation::Touching);
    }
    assert!(touching[0] > 25 && touching[1] > 100, "{touching:?}");
}

/// Random touching places, and one or two ulps beside them: the guess is useless, and integers find the answer alone.
#[test]
fn guesses_that_fail_are_replaced_by_integers() {
    let mut random = Random::new(902);
    let mut both = [0; 2];
    for round in 0..300 {
        let mut case = random.near_case3(0.0);
        for step in 0..3 {
            let [a, b] = [(&case.shape_a, &case.pose_a), (&case.shape_b, &case.pose_b)];
            let full = full_program3(a, b);
            assert_eq!(exact_overlap3(a, b), full, "{round} {step}: {case:?}");
            both[usize::from(full)] += 1;
            let at = case.pose_b.position();
            case.pose_b = Pose3::new(DVec3::new(at.x.next_up(), at.y, at.z), case.pose_b.rotation()).unwrap();
        }
    }
    assert!(both.iter().all(|&count| count > 100), "{both:?}");
}

/// The integer cores of two bounded convex shapes.
fn cores(a: (&Shape3, &Pose3), b: (&Shape3, &Pose3)) -> Cores {
    match pieces3(a, b).map(|pieces| pieces[0].clone()) {
        [
            Piece::Round { points, denominator, radius },
            Piece::Round { points: others, denominator: other, radius: more },
        ] => Cores::new((&points, &denominator, &radius), (&others, &other, &more)),
        _ => panic!("of bounded shapes only"),
    }
}

/// Boxes judged with the guess of another pair of boxes: slower, with the same result.
#[test]
fn no_answer_rests_on_a_guess() {
    let mut random = Random::new(906);
    let mut seen = [0; 3];
    let mut before = None;
    for round in 0..400 {
        let [p, q] = [0, 1].map(|_| lattice_point(&mut random, 3) + 1.0);
        let at = lattice_point(&mut random, 9) - 4.0;
        let rounded = round / 4 % 2 == 0;
        let shape = |half: Vec3, radius: f32| -> Shape3 {
            let cuboid = Cuboid::from_half_extents(half).unwrap();
            if rounded { cuboid.rounded(radius).unwrap().into() } else { cuboid.into() }
        };
        let pose = Pose3::at(at.as_dvec3()).unwrap();
        let cores = cores((&shape(p, 2.0), &Pose3::IDENTITY), (&shape(q, 1.0), &pose));
        let guess = Guess::new(&cores);
        let wrong = before.replace(guess).unwrap_or_else(|| Guess::new(&cores));
        let gaps = at.abs() - p - q;
        let shares = gaps.max_element() <= 0.0;
        assert_eq!(share_point(&cores, &wrong), shares, "{round}: {p} {q} {at}");
        let distance = gaps.max(Vec3::ZERO).length_squared();
        let expected = match rounded {
            true if shares => Ordering::Less,
            true => distance.total_cmp(&9.0),
            false => distance.total_cmp(&0.0),
        };
        assert_eq!(distance_to_radius(&cores, &wrong), expected, "{round}: {p} {q} {at}");
        seen[relation_of(expected) as usize] += 1;
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

#[test]
fn relations_of_boxes_on_a_grid_are_those_of_their_intervals() {
    let mut random = Random::new(903);
    let mut seen = [0; 3];
    for _ in 0..1000 {
        let [p, q] = [0, 1].map(|_| lattice_point(&mut random, 3) + 1.0);
        let at = lattice_point(&mut random, 11) - 5.0;
        let (a, b) =
            (Cuboid::from_half_extents(p).unwrap().into(), Cuboid::from_half_extents(q).unwrap().into());
        let gap = (at.abs() - p - q).max_element();
        let expected = relation_of(gap.total_cmp(&0.0));
        let pose = Pose3::at(at.as_dvec3()).unwrap();
        assert_eq!(exact_relation3((&a, &Pose3::IDENTITY), (&b, &pose)), expected, "{p} {q} {at}");
        seen[expected as usize] += 1;

        let [p, q, at] = [p, q, at].map(Vec3::truncate);
        let (a, b) = (Rect::from_half_extents(p).unwrap().into(), Rect::from_half_extents(q).unwrap().into());
        let gap = (at.abs() - p - q).max_element();
        let pose = Pose2::at(at.as_dvec2()).unwrap();
        let expected = relation_of(gap.total_cmp(&0.0));
        assert_eq!(exact_relation2((&a, &Pose2::IDENTITY), (&b, &pose)), expected, "{p} {q} {at}");
    }
    assert!(seen.iter().all(|&count| count > 50), "{seen:?}");
}

/// How the distance from the origin to a segment compares with a radius, in integers.
fn segment_to_radius(from: [i64; 3], to: [i64; 3], radius: i64) -> Ordering {
    let dot = |p: [i64; 3], q: [i64; 3]| p.iter().zip(q).map(|(p, q)| p * q).sum::<i64>();
    let along = [0, 1, 2].map(|i| to[i] - from[i]);
    let (length, share) = (dot(along, along), -dot(from, along));
    let limit = radius * radius;
    if length == 0 || share <= 0 {
        return dot(from, from).cmp(&limit);
    }
    if share >= length {
        return dot(to, to).cmp(&limit);
    }
    // |from|^2 - share^2 / length, times length.
    (dot(from, from) * length - share * share).cmp(&(limit * length))
}

#[test]
fn spheres_and_capsules_are_judged_as_a_closed_form_in_integers_says() {
    let mut random = Random::new(904);
    let mut touching = [0; 2];
    for _ in 0..4000 {
        let [from, to, at] = [0; 3].map(|_| lattice_point(&mut random, 9) - 4.0);
        let (r, s) = (1 + random.below(3), 1 + random.below(3));
        let whole = |v: Vec3| v.to_array().map(|c| c as i64);
        if let Ok(capsule) = Capsule3::new(from, to, r as f32) {
            let sphere = Shape3::from(Sphere::new(s as f32).unwrap());
            let expected = relation_of(segment_to_radius(whole(from - at), whole(to - at), (r + s) as i64));
            let pose = Pose3::at(at.as_dvec3()).unwrap();
            let found = exact_relation3((&capsule.into(), &Pose3::IDENTITY), (&sphere, &pose));
            assert_eq!(found, expected, "{from} {to} {r} {at} {s}");
            touching[0] += usize::from(found == Relation::Touching);
        }
        let [from, to, at] = [from, to, at].map(Vec3::truncate);
        if let Ok(capsule) = Capsule2::new(from, to, r as f32) {
            let whole = |v: Vec2| whole(v.extend(0.0));
            let expected = relation_of(segment_to_radius(whole(from - at), whole(to - at), (r + s) as i64));
            let pose = Pose2::at(at.as_dvec2()).unwrap();
            let circle = Shape2::from(Circle::new(s as f32).unwrap());
            let found = exact_relation2((&capsule.into(), &Pose2::IDENTITY), (&circle, &pose));
            assert_eq!(found, expected, "{from} {to} {r} {at} {s}");
            touching[1] += usize::from(found == Relation::Touching);
        }
    }
    assert!(touching.iter().all(|&count| count > 30), "{touching:?}");
}

/// Asserts that the two touch at `at`, and that with x an ulp larger they are apart, an ulp smaller in overlap.
fn is_on_the_edge3(a: (&Shape3, &Pose3), b: &Shape3, at: DVec3, turn: Quat) {
    let relation = |x: f64| exact_relation3(a, (b, &Pose3::new(DVec3::new(x, at.y, at.z), turn).unwrap()));
    assert_eq!(relation(at.x), Relation::Touching, "{at} {b:?}");
    assert_eq!(relation(at.x.next_up()), Relation::Apart, "{at} {b:?}");
    assert_eq!(relation(at.x.next_down()), Relation::Overlapping, "{at} {b:?}");
}

/// Distances that are integers along slanted lines.
#[test]
fn rounded_shapes_touch_in_pythagorean_places() {
    let ball = |radius: f32| Shape3::from(Sphere::new(radius).unwrap());
    let cube: Shape3 = Cuboid::from_half_extents(Vec3::ONE).unwrap().into();
    let plain = Pose3::IDENTITY;
    is_on_the_edge3((&ball(3.0), &plain), &ball(2.0), DVec3::new(3.0, 4.0, 0.0), Quat::IDENTITY);
    is_on_the_edge3((&ball(6.5), &plain), &ball(0.5), DVec3::new(2.0, 3.0, 6.0), Quat::IDENTITY);
    // A corner (2, 3, 6) away from the ball's centre, and an edge (3, 4) away.
    is_on_the_edge3((&cube, &plain), &ball(7.0), DVec3::new(3.0, 4.0, 7.0), Quat::IDENTITY);
    is_on_the_edge3((&cube, &plain), &ball(5.0), DVec3::new(4.0, 5.0, 0.25), Quat::IDENTITY);
    // Corner to corner, both rounded: 7 = 3 + 4.
    let rounded =
        |radius: f32| Shape3::from(Cuboid::from_half_extents(Vec3::ONE).unwrap().rounded(radius).unwrap());
    is_on_the_edge3((&rounded(3.0), &plain), &rounded(4.0), DVec3::new(4.0, 5.0, 8.0), Quat::IDENTITY);
    // Rotated by a rational rotation, cos 3/5 and sin 4/5: a face at height 1.5, a ball of 3.5, and 5 between.
    let tilted = Pose3::new(DVec3::ZERO, Quat::from_xyzw(0.0, 0.0, 1.0, 2.0)).unwrap();
    is_on_the_edge3((&rounded(0.5), &tilted), &ball(3.5), DVec3::new(3.0, 4.0, 0.25), Quat::IDENTITY);
    // A capsule along x below, one along y above it; and a flat triangle beside a ball.
    let capsule = |to: Vec3, radius: f32| Shape3::from(Capsule3::new(-to, to, radius).unwrap());
    let level = (&capsule(Vec3::Y * 4.0, 0.75), &plain);
    is_on_the_edge3(level, &capsule(Vec3::Z * 3.0, 1.25), DVec3::new(2.0, 1.0, 0.5), Quat::IDENTITY);
    let [p, q, r] = [Vec3::ZERO, Vec3::Y * 8.0, Vec3::Z * 8.0];
    let triangle: Shape3 = Triangle3::new(p, q, r).unwrap().into();
    is_on_the_edge3((&triangle, &plain), &ball(1.5), DVec3::new(1.5, 2.0, 2.0), Quat::IDENTITY);
    // A half-space with a slope of 3 in 4, moved from the origin.
    let slope: Shape3 = HalfSpace::new(Vec3::new(4.0, 3.0, 0.0) * 7.0).unwrap().into();
    let there = Pose3::at(DVec3::new(8.0, 6.0, 3.0)).unwrap();
    is_on_the_edge3((&slope, &there), &ball(5.0), DVec3::new(12.0, 9.0, -3.0), Quat::IDENTITY);
    is_on_the_edge3((&slope, &there), &cube, DVec3::new(9.0, 7.0, 9.0), Quat::IDENTITY);
}

#[test]
fn rounded_shapes_in_the_plane_touch_in_pythagorean_places() {
    let rect =
        |radius: f32| Shape2::from(Rect::from_half_extents(Vec2::ONE).unwrap().rounded(radius).unwrap());
    let circle = |radius: f32| Shape2::from(Circle::new(radius).unwrap());
    let slope: Shape2 = HalfPlane::new(Vec2::new(3.0, 4.0)).unwrap().into();
    let cases = [
        (rect(2.0), circle(3.0), DVec2::new(4.0, 5.0)),
        (rect(2.0), rect(3.0), DVec2::new(5.0, 6.0)),
        (circle(12.0), circle(1.0), DVec2::new(5.0, 12.0)),
        (slope, circle(2.5), DVec2::new(1.5, 2.0)),
    ];
    for (a, b, at) in &cases {
        let relation =
            |x: f64| exact_relation2((a, &Pose2::IDENTITY), (b, &Pose2::at(DVec2::new(x, at.y)).unwrap()));
        assert_eq!(relation(at.x), Relation::Touching, "{a:?} {b:?}");
        assert_eq!(relation(at.x.next_up()), Relation::Apart, "{a:?} {b:?}");
        assert_eq!(relation(at.x.next_down()), Relation::Overlapping, "{a:?} {b:?}");
    }
}

#[test]
fn half_spaces_part_only_where_they_look_exactly_away() {
    let up: Shape3 = HalfSpace::new(Vec3::new(1.0, 2.0, 3.0)).unwrap().into();
    let down: Shape3 = HalfSpace::new(Vec3::new(-2.0, -4.0, -6.0)).unwrap().into();
    let askew: Shape3 = HalfSpace::new(Vec3::new(-2.0, -4.0, (-6.0_f32).next_up())).unwrap().into();
    let at = |height: f64| Pose3::at(DVec3::new(height, 0.0, 0.0)).unwrap();
    let relation = |b: &Shape3, height: f64| exact_relation3((&up, &Pose3::IDENTITY), (b, &at(height)));
    let heights = [5e-324, 0.0, -5e-324];
    assert_eq!(
        heights.map(|h| relation(&down, h)),
        [Relation::Apart, Relation::Touching, Relation::Overlapping]
    );
    assert_eq!(heights.map(|h| relation(&askew, h)), [Relation::Overlapping; 3]);
    assert_eq!(heights.map(|h| relation(&up, h)), [Relation::Overlapping; 3]);
}

/// A part rotated and moved inside its body, both by rational rotations, against the same pose composed by hand.
#[test]
fn compounds_are_their_parts_where_both_poses_put_them() {
    let mut random = Random::new(905);
    let mut touching = 0;
    for round in 0..400 {
        let (shape, other) = (lattice_hull(&mut random), lattice_hull(&mut random));
        // Quarter turns about two axes, so that the composed rotation has an exact quaternion, too.
        let turns =
            [Quat::IDENTITY, Quat::from_xyzw(1.0, 0.0, 0.0, 1.0), Quat::from_xyzw(0.0, 2.0, 0.0, 2.0)];
        let (inner, outer) = (random.pick(&turns), random.pick(&turns));
        let [at, moved, away] = [0; 3].map(|_| lattice_point(&mut random, 5).as_dvec3() - 2.0);
        let body = Pose3::new(moved, outer).unwrap();
        let composed = Pose3::new(body.transform(at).round(), product(outer, inner)).unwrap();
        // A second part, far away, changes nothing.
        let far = (Pose3::at(DVec3::splat(1e3)).unwrap(), other.clone());
        let compound = Compound3::new([(Pose3::new(at, inner).unwrap(), shape.clone()), far]).unwrap().into();
        let pose = Pose3::at(away).unwrap();
        let expected = exact_relation3((&shape, &composed), (&other, &pose));
        let found = exact_relation3((&compound, &body), (&other, &pose));
        assert_eq!(found, expected, "{round}: {inner} {outer}");
        assert_eq!(
            exact_relation3((&other, &pose), (&compound, &body)),
            expected,
            "{round}: the other way round"
        );
        touching += usize::from(found == Relation::Touching);
    }
    assert!(touching > 10, "{touching}");
    let plane: Shape2 = Rect::from_half_extents(Vec2::new(2.0, 1.0)).unwrap().into();
    let quarter = Rotation2::new(0.0, 1.0).unwrap();
    let part = (Pose2::new(DVec2::new(3.0, 0.0), quarter).unwrap(), plane.clone());
    let compound: Shape2 = Compound2::new([part]).unwrap().into();
    let body = Pose2::new(DVec2::new(0.0, 5.0), quarter).unwrap();
    // Two quarter turns: the part lies along x again, its centre at (0, 8).
    for (y, expected) in [(10.0, Relation::Touching), (10.5, Relation::Apart), (9.5, Relation::Overlapping)] {
        let pose = Pose2::at(DVec2::new(3.5, y)).unwrap();
        assert_eq!(exact_relation2((&compound, &body), (&plane, &pose)), expected, "{y}");
    }
}

/// The product of quaternions, by hand.
fn product(p: Quat, q: Quat) -> Quat {
    let ([a, b, c, d], [e, f, g, h]) = (p.to_array(), q.to_array());
    Quat::from_xyzw(
        d * e + a * h + b * g - c * f,
        d * f - a * g + b * h + c * e,
        d * g + a * f - b * e + c * h,
        d * h - a * e - b * f - c * g,
    )
}

/// Numbers from the ends of the ranges, next to each other.
#[test]
fn extreme_numbers_are_judged_like_any() {
    let tiny = f64::from_bits(1);
    let cube: Shape3 = Cuboid::from_half_extents(Vec3::ONE).unwrap().into();
    let ball: Shape3 = Sphere::new(1.0).unwrap().into();
    let faint = Quat::from_xyzw(1e-45, 0.0, 0.0, 1e-45);
    for shape in [&cube, &ball] {
        let at = |x: f64, y: f64| Pose3::new(DVec3::new(x, y, 0.0), faint).unwrap();
        let relation = |a: Pose3, b: Pose3| exact_relation3((shape, &a), (&cube, &b));
        assert_eq!(relation(at(-1e9, tiny), at(-1e9 + 2.0, -tiny)), Relation::Touching);
        // Apart by a subnormal, which only a position at zero can represent.
        assert_eq!(relation(at(0.0, 0.0), at(2.0, 1.0)), Relation::Touching);
        assert_eq!(relation(at(-tiny, 0.0), at(2.0, 0.5)), Relation::Apart);
        assert_eq!(relation(at(tiny, 0.0), at(2.0, 0.5)), Relation::Overlapping);
    }
    // The end of a segment 1e-45 above a plate of a hundred kilometres.
    let plate: Shape3 = Cuboid::from_half_extents(Vec3::new(1e5, 1.0, 1e5)).unwrap().into();
    let needle = |low: f32| Shape3::from(Segment3::new(Vec3::new(0.0, low, 0.0), Vec3::Y).unwrap());
    let pose = Pose3::at(DVec3::Y).unwrap();
    let relation = |low: f32| exact_relation3((&plate, &Pose3::IDENTITY), (&needle(low), &pose));
    assert_eq!(
        [1e-45, 0.0, -1e-45].map(relation),
        [Relation::Apart, Relation::Touching, Relation::Overlapping]
    );
}
