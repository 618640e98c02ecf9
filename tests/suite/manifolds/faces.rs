//! The points that are kept of the patch shared by two faces, against the exact patch: its corners by another method,
//! and the best four of them by brute force.

use super::{check_manifold, pair3};
use asunder_geometry::tolerance::{EVEN_AREA, EVEN_DEPTH};
use asunder_geometry::{Cuboid, Pose3, Shape3};
use asunder_narrow::{ContactPoint3, FeatureId, Manifold3};
use asunder_tests::answers::{Asked, Asked3};
use asunder_tests::cases::{Case3, Random, prism};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3};

/// Rounding of poses and anchors, which are f32, as a share of areas of about 1.
const ROUNDING: f64 = 2e-6;

/// Share of the best area that must be reached: up to three times, the first of equally good choices is taken.
const ALL: f64 = 1.0 - 3.0 * EVEN_AREA;

/// A strictly convex, counter-clockwise outline: sorted angles on an ellipse.
fn outline(random: &mut Random, corners: usize, size: f64) -> Vec<Vec2> {
    let stretch = DVec2::new(size, size * random.between(0.3, 1.0));
    let step = core::f64::consts::TAU / corners as f64;
    let angle = |i: usize, random: &mut Random| (i as f64 + random.between(-0.35, 0.35)) * step;
    (0..corners).map(|i| (DVec2::from_angle(angle(i, random)) * stretch).as_vec2()).collect()
}

/// The corners of the intersection of two convex outlines: corners of each inside the other, and crossings of their
/// edges. In no particular order.
fn shared(p: &[DVec2], q: &[DVec2]) -> Vec<DVec2> {
    let edges = |outline: &[DVec2]| -> Vec<[DVec2; 2]> {
        (0..outline.len()).map(|i| [outline[i], outline[(i + 1) % outline.len()]]).collect()
    };
    let is_in = |at: DVec2, outline: &[DVec2]| {
        edges(outline).iter().all(|[from, to]| (to - from).perp_dot(at - from) >= 0.0)
    };
    let mut corners: Vec<DVec2> = p.iter().copied().filter(|&at| is_in(at, q)).collect();
    corners.extend(q.iter().copied().filter(|&at| is_in(at, p)));
    for [a, b] in edges(p) {
        for [c, d] in edges(q) {
            let (along, other) = (b - a, d - c);
            let cross = along.perp_dot(other);
            let (s, t) = ((c - a).perp_dot(other) / cross, (c - a).perp_dot(along) / cross);
            if s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0 {
                corners.push(a + along * s);
            }
        }
    }
    corners
}

/// Corners in order around their middle.
fn around(mut corners: Vec<DVec2>) -> Vec<DVec2> {
    let middle = corners.iter().sum::<DVec2>() / corners.len() as f64;
    corners.sort_by(|p, q| (p - middle).to_angle().total_cmp(&(q - middle).to_angle()));
    corners
}

fn area(corners: Vec<DVec2>) -> f64 {
    let corners = around(corners);
    (0..corners.len()).map(|i| corners[i].perp_dot(corners[(i + 1) % corners.len()])).sum::<f64>() / 2.0
}

/// The greatest area of four corners, one of which is in `among`; with four corners or fewer, the whole area.
fn best_four(corners: &[DVec2], among: impl Fn(DVec2) -> bool) -> f64 {
    if corners.len() <= 4 {
        return area(corners.to_vec());
    }
    let mut best: f64 = 0.0;
    for a in 0..corners.len() {
        for b in 0..a {
            for c in 0..b {
                for d in 0..c {
                    let four = [a, b, c, d].map(|i| corners[i]);
                    if four.iter().any(|&corner| among(corner)) {
                        best = best.max(area(four.to_vec()));
                    }
                }
            }
        }
    }
    best
}

/// Two prisms whose end faces face each other across z: B is sunk into A by `sunk`, or above it if that is negative.
fn face_to_face(
    random: &mut Random,
    corners: [usize; 2],
    sunk: f64,
    tilt: DVec3,
) -> (Case3, [Vec<DVec2>; 2]) {
    let sizes = [random.between(0.5, 1.5), random.between(0.5, 1.5)];
    let outlines = [outline(random, corners[0], sizes[0]), outline(random, corners[1], sizes[1])];
    let shapes: [Shape3; 2] = [prism(&outlines[0], 0.5), prism(&outlines[1], 0.25)];
    let aside = DVec2::new(random.signed(), random.signed()) * 0.4 * (sizes[0] + sizes[1]);
    let turn = random.direction2();
    let rotation = Quat::from_xyzw(tilt.x as f32, tilt.y as f32, turn.y as f32, turn.x as f32);
    let pose_b = Pose3::new(aside.extend(0.75 - sunk), rotation).unwrap();
    let of_a = outlines[0].iter().map(|v| v.as_dvec2()).collect();
    // Uses the rotation as stored: its quaternion has been normalised.
    let seen = |v: &Vec2| (pose_b.basis().turn(v.as_dvec2().extend(-0.25)) + pose_b.position()).truncate();
    let of_b = outlines[1].iter().map(seen).collect();
    let [shape_a, shape_b] = shapes;
    (Case3 { shape_a, pose_a: Pose3::IDENTITY, shape_b, pose_b }, [of_a, of_b])
}

/// The points on A, projected along z.
pub(super) fn places(manifold: &Manifold3) -> Vec<DVec2> {
    manifold.points.iter().map(|point| point.anchor_a.as_dvec3().truncate()).collect()
}

#[test]
fn four_points_keep_nineteen_parts_in_twenty_of_what_faces_share() {
    let mut random = Random::new(320);
    let (mut whole, mut reduced) = (0, 0);
    for round in 0..1500 {
        let corners = [3 + random.below(10), 3 + random.below(10)];
        let sunk = [0.02, 1e-4, -1e-4, -0.01][round % 4];
        let (case, [of_a, of_b]) = face_to_face(&mut random, corners, sunk, DVec3::ZERO);
        let exact = shared(&of_a, &of_b);
        let best = if exact.len() >= 3 { best_four(&exact, |_| true) } else { 0.0 };
        if best < 0.01 {
            continue;
        }
        let manifold = pair3(&case).manifold(0.015).unwrap();
        let found = area(places(&manifold));
        let least = if exact.len() <= 4 { best } else { 0.95 * best };
        assert!(found >= least - ROUNDING, "{found} of {best}, {} corners: {case:?}", exact.len());
        assert!(found <= best + ROUNDING, "no more than the faces share: {found} of {best}: {case:?}");
        for point in &manifold.points {
            assert!((f64::from(point.separation) + sunk).abs() < 1e-6, "as deep as the faces: {manifold:?}");
        }
        if exact.len() > 4 { reduced += 1 } else { whole += 1 }
    }
    assert!(whole > 100 && reduced > 500, "patches of both kinds: {whole}, {reduced}");
}

/// Of a tilted body one corner is the deepest; it is kept, and the others span the largest area possible. Symptom: a
/// chip on the corner of a floor 140 km wide stood on four points that covered 63 % of what four can. Cause: areas were
/// compared in f32, from positions as far from the floor's centre as its corner.
#[test]
fn a_chip_on_the_corner_of_a_huge_floor_stands_on_as_much_from_either_side() {
    let floor = Cuboid::from_half_extents(Vec3::new(7e4, 0.5, 7e4)).unwrap();
    let chip = Cuboid::from_half_extents(Vec3::new(0.004_558_057_5, 0.006, 0.007_028_738)).unwrap();
    let at = [69_999.998_516_099_57, 0.505_990_000_052_154_1, 69_999.996_171_156_79];
    let pose_b = Pose3::new(at, Quat::from_rotation_y(0.911_600_8)).unwrap();
    let case = Case3 { shape_a: floor.into(), pose_a: Pose3::IDENTITY, shape_b: chip.into(), pose_b };
    let [one, other] = [&case, &case.swapped()].map(|case| pair3(case).manifold(0.0).unwrap());
    let seen = |anchor: Vec3| DVec2::new(anchor.x.into(), anchor.z.into());
    let one = area(one.points.iter().map(|point| seen(point.anchor_b)).collect());
    let other = area(other.points.iter().map(|point| seen(point.anchor_a)).collect());
    assert!(
        (one - other).abs() < 0.01 * other.abs() && other.abs() > 2e-5,
        "{one} and {other} square metres"
    );
}

#[test]
fn over_the_corner_of_a_huge_floor_four_points_cover_as_much() {
    let mut random = Random::new(321);
    let mut reduced = 0;
    for round in 0..6000 {
        let wide = [70.0, 7e4, 7e4][round % 3];
        let size = [0.006, 0.01, 0.4][random.below(3)] * random.between(0.5, 1.0);
        let mut half = |least: f64| (size * random.between(least, 1.0)) as f32;
        let half = Vec3::new(half(0.3), half(0.3), half(0.3));
        let floor = Cuboid::from_half_extents(Vec3::new(wide as f32, wide as f32, 0.5)).unwrap();
        let chip = Cuboid::from_half_extents(half).unwrap();
        let aside = DVec2::new(random.signed(), random.signed()) * 0.7 * size;
        let turn = random.direction2();
        let rotation = Quat::from_xyzw(0.0, 0.0, turn.y as f32, turn.x as f32);
        let height = 0.5 + f64::from(half.z) - 1e-3 * size;
        let pose_b = Pose3::new((DVec2::splat(wide) + aside).extend(height), rotation).unwrap();
        // In the chip's axes.
        let corner = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let seen = |[x, y]: [f64; 2]| {
            let at = DVec3::new(x * f64::from(half.x), y * f64::from(half.y), 0.0);
            pose_b.basis().turn(at).truncate()
        };
        let of_floor = corner.map(|[x, y]| DVec2::new(x - 1.0, y - 1.0) * 5.0 * size - aside);
        let exact = shared(&of_floor, &corner.map(seen));
        let best = if exact.len() > 4 { best_four(&exact, |_| true) } else { 0.0 };
        if best < 0.01 * size * size {
            continue;
        }
        reduced += 1;
        let case = Case3 { shape_a: floor.into(), pose_a: Pose3::IDENTITY, shape_b: chip.into(), pose_b };
        let [one, other] = [&case, &case.swapped()].map(|case| pair3(case).manifold(0.0).unwrap());
        let seen_from_b = |point: &ContactPoint3| point.anchor_b.as_dvec3().truncate();
        let seen_from_a = |point: &ContactPoint3| point.anchor_a.as_dvec3().truncate();
        for found in [
            area(one.points.iter().map(seen_from_b).collect()),
            area(other.points.iter().map(seen_from_a).collect()),
        ] {
            assert!((0.95 * best..=best * (1.0 + ROUNDING)).contains(&found), "{found} of {best}: {case:?}");
        }
    }
    assert!(reduced > 300, "{reduced} of more than four corners");
}

#[test]
fn of_tilted_faces_the_deepest_corner_is_kept_with_the_best_three_others() {
    let mut random = Random::new(321);
    let mut judged = 0;
    for _ in 0..600 {
        let corners = [4 + random.below(8), 4 + random.below(8)];
        let tilt = DVec3::new(random.signed(), random.signed(), 0.0) * 4e-4;
        let (case, [of_a, of_b]) = face_to_face(&mut random, corners, 0.05, tilt);
        let exact = shared(&of_a, &of_b);
        if exact.len() < 5 || best_four(&exact, |_| true) < 0.05 {
            continue;
        }
        let asked = Asked3::new(case);
        let case = asked.case();
        let manifold = pair3(case).manifold(0.0).unwrap();
        let towards = case.pose_b.basis().turn(DVec3::NEG_Z);
        let depth = |at: DVec2| {
            // Height of B's end face over A's at a place, along z: both are flat.
            let center = case.pose_b.position() + towards * 0.25;
            center.z - (at - center.truncate()).dot(towards.truncate()) / towards.z
        };
        // Corners that may be exchanged count as equally deep: 5e-5 here, where depths differ by up to 2e-3.
        let even = EVEN_DEPTH * 2.0 * f64::from(case.shape_a.outer_radius().min(case.shape_b.outer_radius()));
        let least = exact.iter().map(|&corner| depth(corner)).fold(f64::INFINITY, f64::min) + even + 2e-6;
        let deepest: Vec<DVec2> = exact.iter().copied().filter(|&corner| depth(corner) <= least).collect();
        let with = |corner: &DVec2| best_four(&exact, |other| other == *corner);
        let best = deepest.iter().map(with).fold(f64::INFINITY, f64::min);
        let found = area(places(&manifold));
        // The crossing of edges at a small angle is uncertain along them.
        let is_kept = |at: &DVec2| deepest.iter().any(|corner| (at - corner).length() < 2e-3);
        assert!(places(&manifold).iter().any(is_kept), "{deepest:?} of {manifold:?}: {case:?}");
        // A normal tilted by up to 1.2e-3 shifts what is sunk in by 0.05 by up to 6e-5, along an outline of up to 5.
        assert!(found >= best * ALL - 3e-4, "{found} of {best}: {case:?}");
        check_manifold(&asked, &asked.manifold(0.0).unwrap(), 0.0);
        judged += 1;
    }
    assert!(judged > 200, "only {judged}");
}

/// The feature ids of the points with their separations, in the order of the unswapped pair.
fn named(manifold: &Manifold3, is_swapped: bool) -> Vec<(FeatureId, f32)> {
    let name = |point: &ContactPoint3| {
        let id = point.feature;
        (if is_swapped { FeatureId::new(id.b(), id.a()) } else { id }, point.separation)
    };
    let mut named: Vec<_> = manifold.points.iter().map(name).collect();
    named.sort_by_key(|&(id, _)| id);
    named
}

fn assert_alike(one: &[(FeatureId, f32)], other: &[(FeatureId, f32)], slack: f64, case: &Case3) {
    let ids = |named: &[(FeatureId, f32)]| named.iter().map(|&(id, _)| id).collect::<Vec<_>>();
    assert_eq!(ids(one), ids(other), "{one:?} and {other:?}: {case:?}");
    for ((_, one), (_, other)) in one.iter().zip(other) {
        assert!((f64::from(*one) - f64::from(*other)).abs() <= slack, "{one} and {other}: {case:?}");
    }
}

/// Slightly tilted faces, and bodies that penetrate in any way: with margins and without.
fn any_case(random: &mut Random, round: usize) -> (Case3, f32) {
    let margin = [0.0, 0.02][round / 2 % 2];
    if !round.is_multiple_of(2) {
        return (random.case3(), margin);
    }
    let corners = [3 + random.below(8), 3 + random.below(8)];
    let tilt = DVec3::new(random.signed(), random.signed(), 0.0) * 0.02;
    let sunk = random.between(-0.01, 0.05);
    (face_to_face(random, corners, sunk, tilt).0, margin)
}

/// With A and B swapped, the same points have the same feature ids, mirrored.
#[test]
fn the_manifold_of_b_and_a_mirrors_that_of_a_and_b() {
    let mut random = Random::new(322);
    let mut points = [0; 5];
    for round in 0..4000 {
        let (case, margin) = any_case(&mut random, round);
        let Some(one) = pair3(&case).manifold(margin) else { continue };
        let other = pair3(&case.swapped()).manifold(margin).unwrap();
        let slack = 1e-6 * case.size();
        assert_alike(&named(&one, false), &named(&other, true), slack, &case);
        assert!((one.normal + other.normal).length() < 1e-5, "{} and {}: {case:?}", one.normal, other.normal);
        points[one.points.len()] += 1;
    }
    assert!(points[1..].iter().all(|&count| count > 50), "manifolds of every size: {points:?}");
}

/// Rotated together, the two have the same points with the same feature ids; only the rounding of the quaternions,
/// which are f32, differs.
#[test]
fn a_turn_of_both_changes_no_name_of_a_point() {
    let mut random = Random::new(323);
    let mut points = [0; 5];
    for round in 0..4000 {
        let (case, margin) = any_case(&mut random, round);
        let Some(one) = pair3(&case).manifold(margin) else { continue };
        if f64::from(one.separation - margin).abs() < 1e-5 {
            continue;
        }
        let turn = random.quaternion();
        let turned = |pose: &Pose3| {
            let rotation = turn.as_dquat() * pose.rotation().as_dquat();
            Pose3::new(turn.as_dquat().normalize() * pose.position(), rotation.as_quat()).unwrap()
        };
        let other = Case3 { pose_a: turned(&case.pose_a), pose_b: turned(&case.pose_b), ..case.clone() };
        let other = pair3(&other).manifold(margin).unwrap();
        let (one_named, other_named) = (named(&one, false), named(&other, false));
        // A point exactly at the margin may or may not be included.
        let is_at_margin = |named: &(FeatureId, f32)| (named.1 - margin).abs() < 1e-5;
        if one_named.iter().chain(&other_named).any(is_at_margin) {
            continue;
        }
        assert_alike(&one_named, &other_named, 2e-6 * case.size(), &case);
        points[one.points.len()] += 1;
    }
    assert!(points[1..].iter().all(|&count| count > 50), "manifolds of every size: {points:?}");
}
