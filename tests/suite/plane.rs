//! Polygons of many edges, and hints in the plane: numbers against all edges and all vertices, A and B swapped, what a
//! hint may change and what it may not.

use asunder_geometry::{Polygon, Pose2, Rect, Rotation2, Shape2};
use asunder_narrow::{Answer, Batch2, FeatureId, Hint, Job2, Manifold2, Pair2, collide2};
use asunder_scenes::pairs::{FRAMES, PairSet, PlaneKind, PosedPair2, pairs2};
use asunder_tests::answers::{Asked, Asked2, Manifold};
use asunder_tests::cases::{Case2, Random};
use asunder_tests::exhaustive_distance::exhaustive_distance2;
use glam::{DVec2, Vec2};

/// As for manifolds of few corners: a face is preferred within 5e-7 of the size, and anchors are f32.
const ON_SHAPE: f64 = 2e-6;

/// An ellipse of random points, an even circle, a needle, one flat side under an arc, and steps that shrink from edge
/// to edge: more edges than are tested one by one.
fn many_edges(random: &mut Random) -> Shape2 {
    let count = random.pick(&[17, 24, 40, 100, 250]);
    let middle = random.vector().truncate() * random.pick(&[0.0, 0.3, 10.0]);
    loop {
        let family = random.below(5);
        let turn = random.direction2();
        let circle = |share: f64| {
            // Half a turn either way, without trigonometry: the inverse stereographic projection of a line.
            let t = 2.0 * share - 1.0;
            DVec2::new(1.0 - t * t, 2.0 * t) / (1.0 + t * t)
        };
        let mut point = |i: usize| {
            let share = (i as f64 + 0.5) / count as f64;
            match family {
                0 => random.direction2() * DVec2::new(1.0, 0.6),
                1 => circle(share) * if i.is_multiple_of(2) { 1.0 } else { -1.0 },
                2 => random.direction2() * DVec2::new(1.0, 1e-3),
                3 => circle(share),
                _ => circle(0.5 + 0.5 * (0..i % 60).fold(1.0, |step, _| 0.8 * step)),
            }
        };
        let points: Vec<Vec2> = (0..count).map(|i| (turn.rotate(point(i)) + middle).as_vec2()).collect();
        if let Ok(polygon) = Polygon::hull_of(&points)
            && polygon.vertices().len() > 16
        {
            return polygon.into();
        }
    }
}

/// The outward unit normal of each edge and the gap along it, from stored vertices: edge vectors are exact before they
/// are rotated, so that short ones have accurate normals.
fn gaps(of: &Shape2, pose: &Pose2, other: &Shape2, other_pose: &Pose2) -> impl Iterator<Item = (f64, DVec2)> {
    let turned = |pose: &Pose2, v: DVec2| {
        let (c, s) = (f64::from(pose.rotation().cos()), f64::from(pose.rotation().sin()));
        DVec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
    };
    let vertices: Vec<DVec2> = of.core().vertices().iter().map(|v| v.as_dvec2()).collect();
    let between = other_pose.position() - pose.position();
    let others: Vec<DVec2> =
        other.core().vertices().iter().map(|v| turned(other_pose, v.as_dvec2()) + between).collect();
    let pose = *pose;
    (0..vertices.len()).map(move |i| {
        let (from, to) = (vertices[i], vertices[(i + 1) % vertices.len()]);
        let normal = -turned(&pose, to - from).perp().normalize();
        let from = turned(&pose, from);
        (others.iter().map(|v| normal.dot(*v - from)).fold(f64::INFINITY, f64::min), normal)
    })
}

/// The separation and its axis from every edge and, in a gap, every vertex. Cost: the product of the vertex counts.
fn truth(case: &Case2) -> (f64, DVec2) {
    let Case2 { shape_a, pose_a, shape_b, pose_b } = case;
    let of_b = gaps(shape_b, pose_b, shape_a, pose_a).map(|(gap, normal)| (gap, -normal));
    let all = gaps(shape_a, pose_a, shape_b, pose_b).chain(of_b);
    let best = all.reduce(|best, next| if next.0 > best.0 { next } else { best }).unwrap();
    if best.0 <= 0.0 {
        return best;
    }
    let (a, b) = case.placed();
    let nearest = exhaustive_distance2(&a, &b);
    (nearest.distance, (nearest.on_b - nearest.on_a) / nearest.distance)
}

const GAPS: [f64; 10] = [0.15, 1e-2, 1e-4, 1e-6, 1e-9, -1e-9, -1e-6, -1e-4, -1e-2, -0.2];

/// Two polygons of many edges, or one and a rectangle, with a random gap as a share of their size.
fn case(random: &mut Random, round: usize) -> Case2 {
    let shape_a = many_edges(random);
    let shape_b = if random.below(3) == 0 { random.shape2() } else { many_edges(random) };
    let [pose_a, pose_b] =
        [0.0, 1.0].map(|way| Pose2::new(random.direction2() * way, random.rotation2()).unwrap());
    let mut case = Case2 { shape_a, pose_a, shape_b, pose_b };
    for _ in 0..3 {
        let (separation, axis) = truth(&case);
        let step = axis * (GAPS[round % GAPS.len()] * case.size() - separation);
        case.pose_b = Pose2::new(case.pose_b.position() + step, case.pose_b.rotation()).unwrap();
    }
    case
}

/// The length of the vectors from which an answer is computed.
fn reach(case: &Case2) -> f64 {
    let off = |shape: &Shape2| shape.center().as_dvec2().length();
    case.size()
        + off(&case.shape_a)
        + off(&case.shape_b)
        + (case.pose_b.position() - case.pose_a.position()).length()
}

fn check_points(asked: &Asked2, manifold: &Manifold, separation: f64, margin: f64) {
    let slack = ON_SHAPE * asked.size() + 2e-7 * reach(asked.case());
    let contacts = &manifold.contacts;
    assert!(!contacts.is_empty() && contacts.len() <= 2, "{manifold:?} of {asked:?}");
    for contact in contacts {
        let points = contact.points;
        let is_right = points.beyond_a <= slack
            && points.beyond_b <= slack
            && points.across_normal <= slack
            && (points.along_normal - contact.separation).abs() <= slack
            && contact.separation <= margin + slack;
        assert!(is_right, "{contact:?} of {asked:?}");
    }
    let deepest = contacts.iter().map(|contact| contact.separation).fold(f64::INFINITY, f64::min);
    assert!((deepest - separation).abs() <= slack, "{manifold:?}, true {separation}: {asked:?}");
}

#[test]
fn polygons_of_many_edges_are_as_far_apart_as_all_edges_and_vertices_say() {
    let mut random = Random::new(2701);
    let (mut apart, mut points) = (0, [0; 3]);
    for round in 0..1500 {
        let asked = Asked2::new(case(&mut random, round));
        let (separation, _) = truth(asked.case());
        let rounding = 1e-14 * reach(asked.case());
        let found = asked.separation(f32::INFINITY).unwrap();
        assert!(
            (found.separation - separation).abs() <= found.error + rounding,
            "{found:?}, true {separation}: {asked:?}"
        );
        assert!(found.error <= 1e-6 * asked.size() + 1e-6 * separation.abs(), "{found:?}: {asked:?}");
        assert!(found.gap_along_normal >= separation - 4e-7 * reach(asked.case()), "{found:?}: {asked:?}");
        if separation.abs() > rounding {
            assert_eq!(asked.overlaps(), separation < 0.0, "{separation}: {asked:?}");
        }
        assert_eq!(asked.overlaps(), found.separation <= 0.0, "{asked:?}");
        assert_eq!(
            asked.distance().map(|d| d.measured.separation),
            (!asked.overlaps()).then_some(found.separation)
        );
        assert_eq!(asked.manifold(0.0).is_some(), asked.overlaps());
        let margin = 2e-2 * asked.size() as f32;
        if let Some(manifold) = asked.manifold(margin) {
            check_points(&asked, &manifold, separation, margin.into());
            points[manifold.contacts.len()] += 1;
        } else {
            assert!(separation > f64::from(margin) * (1.0 - 1e-6), "{separation}: {asked:?}");
        }
        apart += usize::from(!asked.overlaps());
    }
    assert!(apart > 500 && points[1] > 100 && points[2] > 100, "{apart} apart, {points:?}");
}

#[test]
fn polygons_of_many_edges_overlap_as_exact_arithmetic_says() {
    let mut random = Random::new(2702);
    let mut touching = 0;
    for round in 0..150 {
        // Half of them closer to touching than f64 resolves.
        let mut case = case(&mut random, round);
        if round.is_multiple_of(2) {
            let (separation, axis) = truth(&case);
            let at = case.pose_b.position() - axis * separation;
            case.pose_b = Pose2::new(at, case.pose_b.rotation()).unwrap();
            touching += 1;
        }
        let asked = Asked2::new(case);
        let exactly = asked.exactly_overlaps();
        assert_eq!(asked.overlaps(), exactly, "{asked:?}");
        assert_eq!(asked.swapped().overlaps(), exactly, "swapped: {asked:?}");
    }
    assert!(touching > 70);
}

/// With A and B swapped, the same points result.
#[test]
fn the_manifold_of_b_and_a_is_that_of_a_and_b_in_a_mirror() {
    let mut random = Random::new(2703);
    let (mut compared, mut tied) = (0, 0);
    for round in 0..1500 {
        let one = if round % 3 == 0 { random.near_case2(GAPS[round % 10]) } else { case(&mut random, round) };
        let other = one.swapped();
        let [one, other] = [&one, &other].map(|case| {
            let pair = Pair2::new(&case.shape_a, &case.pose_a, &case.shape_b, &case.pose_b);
            pair.manifold(0.02 * case.size() as f32)
        });
        let (Some(one), Some(other)) = (one, other) else { continue };
        let difference = f64::from((one.separation - other.separation).abs());
        assert!(difference <= f64::from(one.error) + f64::from(other.error), "{one:?}, {other:?}");
        // Axes that tie within the preference for A's edges may differ completely.
        if (one.normal + other.normal).length() > 1e-3 {
            tied += 1;
            continue;
        }
        assert_eq!(one.points.len(), other.points.len(), "{one:?}, {other:?}");
        for point in &one.points {
            let is_mirrored = other.points.iter().any(|mirrored| {
                let size = (point.anchor_a.length() + point.anchor_b.length()).max(1.0);
                (point.anchor_a - mirrored.anchor_b).length() <= 4e-6 * size
                    && (point.anchor_b - mirrored.anchor_a).length() <= 4e-6 * size
                    && (point.separation - mirrored.separation).abs() <= 4e-6 * size
            });
            assert!(is_mirrored, "{one:?}, {other:?}");
        }
        compared += 1;
    }
    assert!(compared > 900 && tied < compared / 20, "{compared} compared, {tied} tied");
}

/// A pair's overlap, hint and manifolds.
fn ask(pair: &PosedPair2, hint: Hint, margin: f32) -> (Option<bool>, Hint, Vec<Manifold2>) {
    let PosedPair2 { shape_a, pose_a, shape_b, pose_b } = pair;
    let job = Job2 { shape_a, pose_a, shape_b, pose_b, margin, hint, ahead: 0.0, sensor: false };
    let mut batch = Batch2::default();
    collide2(&[job], &mut batch);
    let (overlapping, hint) = match batch.answers[0] {
        Answer::Apart { hint, .. } => (None, hint),
        Answer::Contact { overlapping, hint, .. } => (Some(overlapping), hint),
    };
    (overlapping, hint, batch.manifolds)
}

/// Sixty frames with the hints of the previous frames, with none, and with those of other pairs.
#[test]
fn hints_true_and_false_change_no_boolean_and_no_depth() {
    let mut stale = vec![Hint::NONE];
    let (mut apart, mut overlapping) = (0, 0);
    for (kind, set) in PlaneKind::ALL.into_iter().flat_map(|kind| {
        [PairSet::Slide, PairSet::Tumble, PairSet::Touch, PairSet::Far].map(move |set| (kind, set))
    }) {
        let tracks = if kind == PlaneKind::Poly4096 { 2 } else { 8 };
        let frames = pairs2(kind, set, tracks * FRAMES, 27);
        let mut hints = vec![Hint::NONE; tracks];
        for (i, pair) in frames.iter().enumerate() {
            let margin = [0.0, 0.02][i % 2];
            let without = ask(pair, Hint::NONE, margin);
            let known = ask(pair, hints[i % tracks], margin);
            let misled = ask(pair, stale[i * 7 % stale.len()], margin);
            let is = Pair2::new(&pair.shape_a, &pair.pose_a, &pair.shape_b, &pair.pose_b).overlaps();
            assert_eq!(without.0 == Some(true), is, "{pair:?}");
            for hinted in [&known, &misled] {
                assert_eq!(hinted.0, without.0, "{pair:?}");
                let numbers = |m: &[Manifold2]| m.iter().map(|m| m.separation).collect::<Vec<f32>>();
                // Other edges may be used; where the search starts affects only the last bits.
                for (one, other) in numbers(&hinted.2).into_iter().zip(numbers(&without.2)) {
                    let error = hinted.2[0].error + without.2[0].error;
                    assert!((one - other).abs() <= error, "{one}, {other}: {pair:?}");
                }
            }
            hints[i % tracks] = known.1;
            if i % 11 == 0 {
                stale.push(known.1);
            }
            if is {
                overlapping += 1;
            } else {
                apart += 1;
            }
        }
    }
    assert!(apart > 1000 && overlapping > 1000, "{apart} apart, {overlapping} overlapping");
}

/// A pair that stays apart keeps a hint whose axis separates it.
#[test]
fn a_pair_apart_leaves_a_hint_that_parts_it_in_the_next_frame() {
    for kind in PlaneKind::ALL {
        let tracks = if kind == PlaneKind::Poly4096 { 4 } else { 40 };
        let pairs = pairs2(kind, PairSet::Touch, tracks, 28);
        let mut apart = 0;
        for pair in &pairs {
            let (contact, hint, _) = ask(pair, Hint::NONE, 0.0);
            if contact.is_none() {
                assert_ne!(hint, Hint::NONE, "{pair:?}");
                let (again, kept, _) = ask(pair, hint, 0.0);
                assert_eq!((again, kept), (None, hint), "the hinted axis parts them still: {pair:?}");
                apart += 1;
            }
        }
        assert!(apart > 0, "{}", kind.name());
    }
}

/// A body with a flat side of one metre below, and this many corners.
fn flat_below(corners: usize) -> Shape2 {
    let arc = (1..corners - 1).map(|i| {
        let t = i as f32 / (corners - 1) as f32;
        Vec2::new(0.5 - t, 0.8 * t * (1.0 - t))
    });
    let points: Vec<Vec2> = [Vec2::new(-0.5, 0.0), Vec2::new(0.5, 0.0)].into_iter().chain(arc).collect();
    let polygon = Polygon::hull_of(&points).unwrap();
    assert_eq!(polygon.vertices().len(), corners);
    polygon.into()
}

/// A body that rests on a floor and sways so little that now its own side is the better reference and now the floor's:
/// without a hint the normal flips from frame to frame; with one it stays, until the other is better by far.
#[test]
fn the_reference_edge_of_a_body_that_sways_stays_what_it_was() {
    let rect = Shape2::from(Rect::from_half_extents(Vec2::new(0.5, 0.5)).unwrap());
    let wide = Shape2::from(Rect::from_half_extents(Vec2::new(4.0, 1.0)).unwrap());
    let many = {
        let points: Vec<Vec2> = (0..50)
            .map(|i| Vec2::new(4.0 - 8.0 * i as f32 / 49.0, -2.0 * (i * (49 - i)) as f32 / 2401.0))
            .collect();
        Shape2::from(Polygon::hull_of(&points).unwrap())
    };
    for (body, low) in [(rect, -0.5), (flat_below(8), 0.0), (flat_below(13), 0.0), (flat_below(40), 0.0)] {
        for (floor, top) in [(&wide, 1.0), (&many, 0.0)] {
            let smaller = f64::from(body.outer_radius());
            // The depth along A's edge is less than along B's by 4 m times the sine; B's must be better by 5e-7 of the
            // smaller diameter.
            let preference = 5e-7 * 2.0 * smaller;
            let lean = |preferences: f64| (preference * preferences / 3.5) as f32;
            // The floor's normal is upright, the body's is not. Feature ids are those of the same corners with either.
            let is_on_body = |pair: &PosedPair2, hint: Hint| {
                let (_, hint, manifolds) = ask(pair, hint, 0.01);
                assert_eq!(manifolds[0].points.len(), 2, "{manifolds:?}");
                let names: Vec<FeatureId> = manifolds[0].points.iter().map(|point| point.feature).collect();
                ((manifolds[0].normal.x != 0.0, names), hint)
            };
            let posed = |sine: f32| PosedPair2 {
                shape_a: body.clone(),
                pose_a: Pose2::new(DVec2::new(0.0, top - low - 1e-3), Rotation2::new(1.0, sine).unwrap())
                    .unwrap(),
                shape_b: floor.clone(),
                pose_b: Pose2::IDENTITY,
            };
            let (first, mut hint) = is_on_body(&posed(lean(0.5)), Hint::NONE);
            assert!(first.0, "equals go to A");
            let mut flips = 0;
            for frame in 0..60 {
                let pair = posed(lean([0.5, 1.5, -1.5][frame % 3]));
                flips += usize::from(!is_on_body(&pair, Hint::NONE).0.0);
                let (kept, next) = is_on_body(&pair, hint);
                assert_eq!(kept, first, "frame {frame}: {pair:?}");
                hint = next;
            }
            assert_eq!(flips, 40, "without hints");
            let far = posed(lean(9.0));
            assert!(!is_on_body(&far, hint).0.0, "a hint holds on to nothing that is worse: {far:?}");
        }
    }
}
